// no_gradient_of_the_length.c - M3: the step q -> q / |q| has no gradient. Without it dq has a part along q, and q grows at each step of an
// optimiser while R stays where it is; look at q . dq, which must be 0.
#include "exercises/exercise.h"

#define quat_to_R_vjp solution_quat_to_R_vjp
#include "exercises/solutions/quat.c"
#undef quat_to_R_vjp

void quat_to_R_vjp(const REAL q[4], const REAL dR[9], REAL dq[4]) {
    REAL unit[4];
    unit_of(q, unit);
    unit_vjp(unit, dR, dq);
}
