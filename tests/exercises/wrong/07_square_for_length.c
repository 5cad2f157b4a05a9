// 07_square_for_length.c - divides by |q|^2: the root is forgotten.
#include "exercises/exercise.h"

#define quat_to_R solution_quat_to_R
#include "exercises/solutions/quat.c"
#undef quat_to_R

void quat_to_R(const REAL q[4], REAL R[9]) {
    REAL square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
    REAL w = q[0] / square, x = q[1] / square, y = q[2] / square, z = q[3] / square;
    R[0] = 1 - 2 * (y * y + z * z), R[1] = 2 * (x * y - w * z), R[2] = 2 * (x * z + w * y);
    R[3] = 2 * (x * y + w * z), R[4] = 1 - 2 * (x * x + z * z), R[5] = 2 * (y * z - w * x);
    R[6] = 2 * (x * z - w * y), R[7] = 2 * (y * z + w * x), R[8] = 1 - 2 * (x * x + y * y);
}
