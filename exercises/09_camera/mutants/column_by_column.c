// column_by_column.c - J is written column by column: it is stored row by row, first the three derivatives of u.
#include "exercises/exercise.h"

#define project_jac solution_project_jac
#include "exercises/solutions/camera.c"
#undef project_jac

void project_jac(const Cam *c, const REAL t[3], REAL J[6]) {
    REAL j[6];
    solution_project_jac(c, t, j);
    J[0] = j[0], J[1] = j[3], J[2] = j[1], J[3] = j[4], J[4] = j[2], J[5] = j[5];
}
