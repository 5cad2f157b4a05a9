// transposed.c - R is transposed, written column by column or turned the other way: a rotation still, but the inverse of the one asked
// for.
#include "exercises/exercise.h"

#define quat_to_R solution_quat_to_R
#include "exercises/solutions/quat.c"
#undef quat_to_R

void quat_to_R(const REAL q[4], REAL R[9]) {
    REAL T[9];
    solution_quat_to_R(q, T);
    for (int row = 0; row < 3; row++)
        for (int column = 0; column < 3; column++) R[3 * row + column] = T[3 * column + row];
}
