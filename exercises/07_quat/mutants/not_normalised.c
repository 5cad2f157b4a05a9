// not_normalised.c - q is used as it is, as if it had length 1: an optimiser changes its length at every step, so R has to normalise it
// itself.
#include "exercises/exercise.h"

#define quat_to_R solution_quat_to_R
#include "exercises/solutions/quat.c"
#undef quat_to_R

void quat_to_R(const REAL q[4], REAL R[9]) {
    REAL w = q[0], x = q[1], y = q[2], z = q[3];
    R[0] = 1 - 2 * (y * y + z * z), R[1] = 2 * (x * y - w * z), R[2] = 2 * (x * z + w * y);
    R[3] = 2 * (x * y + w * z), R[4] = 1 - 2 * (x * x + z * z), R[5] = 2 * (y * z - w * x);
    R[6] = 2 * (x * z - w * y), R[7] = 2 * (y * z + w * x), R[8] = 1 - 2 * (x * x + y * y);
}
