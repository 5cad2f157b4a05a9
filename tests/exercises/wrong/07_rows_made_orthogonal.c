// 07_rows_made_orthogonal.c - nine entries from the raw q, then Gram and Schmidt: a rotation for every q, but another one.
#include "exercises/exercise.h"

#define quat_to_R solution_quat_to_R
#include "exercises/solutions/quat.c"
#undef quat_to_R

void quat_to_R(const REAL q[4], REAL R[9]) {
    REAL w = q[0], x = q[1], y = q[2], z = q[3], a = 0, b = 0, ab = 0;
    R[0] = 1 - 2 * (y * y + z * z), R[1] = 2 * (x * y - w * z), R[2] = 2 * (x * z + w * y);
    R[3] = 2 * (x * y + w * z), R[4] = 1 - 2 * (x * x + z * z), R[5] = 2 * (y * z - w * x);
    for (int i = 0; i < 3; i++) a += R[i] * R[i];
    for (int i = 0; i < 3; i++) R[i] /= sqrt(a);
    for (int i = 0; i < 3; i++) ab += R[i] * R[3 + i];
    for (int i = 0; i < 3; i++) R[3 + i] -= ab * R[i];
    for (int i = 0; i < 3; i++) b += R[3 + i] * R[3 + i];
    for (int i = 0; i < 3; i++) R[3 + i] /= sqrt(b);
    R[6] = R[1] * R[5] - R[2] * R[4], R[7] = R[2] * R[3] - R[0] * R[5], R[8] = R[0] * R[4] - R[1] * R[3];
}
