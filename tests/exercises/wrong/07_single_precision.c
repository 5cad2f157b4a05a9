// 07_single_precision.c - the length is computed with sqrtf() in either precision.
#include "exercises/exercise.h"

#define quat_to_R solution_quat_to_R
#include "exercises/solutions/quat.c"
#undef quat_to_R

void quat_to_R(const REAL q[4], REAL R[9]) {
    float length = sqrtf((float)(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]));
    const REAL shorter[4] = {q[0] / length, q[1] / length, q[2] / length, q[3] / length};
    REAL w = shorter[0], x = shorter[1], y = shorter[2], z = shorter[3];
    R[0] = 1 - 2 * (y * y + z * z), R[1] = 2 * (x * y - w * z), R[2] = 2 * (x * z + w * y);
    R[3] = 2 * (x * y + w * z), R[4] = 1 - 2 * (x * x + z * z), R[5] = 2 * (y * z - w * x);
    R[6] = 2 * (x * z - w * y), R[7] = 2 * (y * z + w * x), R[8] = 1 - 2 * (x * x + y * y);
}
