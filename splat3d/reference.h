// reference.h - the whole forward and backward pass in readable double-precision C: the lesson and the oracle.
//
// Every stage is a function of one splat or one pixel, in the order in which a picture comes about:
//   reference_project.c   Sigma from log-scale and quaternion, EWA projection, and their gradients
//   reference_sh.c        colour from spherical harmonics and the viewing direction
//   reference_blend.c     tiles, depth order, compositing, and its gradient back to front
//   reference.c           the whole picture, and the filler of the Rasterizer table
// It is written independently of the kernels: the records are shared, the formulas are not.
#ifndef SPLATLAB_SPLAT3D_REFERENCE_H
#define SPLATLAB_SPLAT3D_REFERENCE_H

#include "splat2d/covariance.h"
#include "splat3d/rasterizer.h"

// The model in double: finite differences need it.
typedef struct {
    int count, sh_degree;
    double *field[FIELD_COUNT]; // (N, width); NULL above sh_degree
} GaussiansD;

GaussiansD gaussiansd_create(int count, int sh_degree);
GaussiansD gaussiansd_from(const Gaussians *g);
Gaussians gaussiansd_to_float(const GaussiansD *g);
void gaussiansd_destroy(GaussiansD *g);

// One splat on the screen.
typedef struct {
    bool visible; // in front of the near plane, with extent and on the picture
    double mean_px[2];
    double depth;    // camera z
    Sym2 covariance; // Sigma' with the low-pass
    Sym2 conic;      // its inverse
    double opacity;  // after the sigmoid
    double rgb[3];   // SH colour + 0.5, clamped at 0 from below
} Splat2;

typedef struct {
    double mean_px[2];
    Sym2 conic; // by the stored numbers
    double opacity;
    double rgb[3];
    double depth; // RENDER_DEPTH only
} Splat2Gradient;

void reference_project_forward(const GaussiansD *g, int i, const Camera *camera, const RenderSettings *settings,
                               Splat2 *splat);
// Adds to d_model's numbers of splat i.
void reference_project_backward(const GaussiansD *g, int i, const Camera *camera, const RenderSettings *settings,
                                const Splat2Gradient *d_splat, GaussiansD *d_model);

// The real SH basis of degree 0..3 at unit direction d: basis[(degree+1)^2]; jacobian[k][3]: derivative by d (not projected to the sphere).
void reference_sh_basis(int degree, const double d[3], double basis[SH_COEFFICIENTS_MAX]);
void reference_sh_basis_jacobian(int degree, const double d[3], double jacobian[SH_COEFFICIENTS_MAX][3]);

// The whole picture in double: rgb (H, W, 3), transmittance (H, W).
typedef struct {
    int width, height;
    double *rgb, *transmittance; // owned
} PictureD;
void pictured_destroy(PictureD *p);

void reference_render_forward(const GaussiansD *g, const Camera *camera, const RenderSettings *settings,
                              PictureD *picture);
// d_model is created. d_rgb: (H, W, 3).
void reference_render_backward(const GaussiansD *g, const Camera *camera, const RenderSettings *settings,
                               const double *d_rgb, GaussiansD *d_model);

// A Rasterizer that renders by this reference.
Rasterizer *reference_rasterizer_create(void);

#endif
