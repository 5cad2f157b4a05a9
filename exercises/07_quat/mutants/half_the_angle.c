// half_the_angle.c - the turn is by the angle whose cosine is w: a quaternion holds the cosine of half the angle, since it acts twice, as
// q v q*.
#include "exercises/exercise.h"

#define quat_to_R solution_quat_to_R
#include "exercises/solutions/quat.c"
#undef quat_to_R

void quat_to_R(const REAL q[4], REAL R[9]) {
    REAL s = sqrt(q[1] * q[1] + q[2] * q[2] + q[3] * q[3]), half = atan2(s, q[0]) / 2;
    REAL part = s > 0 ? sin(half) / s : 0;
    const REAL slower[4] = {cos(half), part * q[1], part * q[2], part * q[3]};
    solution_quat_to_R(slower, R);
}
