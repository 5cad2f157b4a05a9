// formula.h - matrices as one writes them: a name, brackets, two rows of numbers.
#ifndef SPLATLAB_LAB_APP_FORMULA_H
#define SPLATLAB_LAB_APP_FORMULA_H

#include "lab/app/gui.h"
#include "splat2d/covariance.h"

// Draws "name = [xx xy; xy yy] unit" as a control of the panel's width.
void formula_matrix(const char *name, Sym2 matrix, const char *unit, GuiColour colour);

// A number in the form that suits its size: 1936.0, 0.0005165, 5.17e-12. Returns buffer.
const char *formula_number(double value, char *buffer, int size);

#endif
