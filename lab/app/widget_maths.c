// widget_maths.c - the active blob's Sigma, and what follows from it.
#include "lab/app/formula.h"
#include "lab/app/palette.h"
#include "lab/app/widget.h"

#include <math.h>

void widget_maths(const Blob *blob) {
    Sym2 covariance = blob_covariance(blob), conic = {0};
    Eigen2 eigen = sym2_eigen(covariance);
    char major[32], minor[32], determinant[32];
    gui_text(GUI_SMALL, INK_QUIET, "Σ = R(θ) diag(σx², σy²) R(θ)ᵀ");
    formula_matrix("Σ", covariance, "px²", INK);
    if (blob_conic(blob, &conic)) formula_matrix("Σ⁻¹", conic, "px⁻²", INK);
    bool valid = eigen.minor > 0;
    formula_number(eigen.major, major, sizeof major);
    formula_number(eigen.minor, minor, sizeof minor);
    // The product of the squared scales: the difference of two large products would lose the digits of a thin blob.
    formula_number(pow(blob->sigma_x * blob->sigma_y, 2), determinant, sizeof determinant);
    gui_text(GUI_SMALL, INK_QUIET, "λ");
    gui_same_line(0.4);
    gui_text(GUI_MONO_SMALL, valid ? INK : BAD, "%s, %s", major, minor);
    gui_same_line(1);
    gui_text(GUI_SMALL, INK_QUIET, "det Σ");
    gui_same_line(0.4);
    gui_text(GUI_MONO_SMALL, valid ? INK : BAD, "%s", determinant);
    gui_text(GUI_SMALL, valid ? GOOD : BAD,
             valid ? "✓ positive definite: both λ > 0, √λ are the axes" : "✗ no area: an eigenvalue is 0");
}
