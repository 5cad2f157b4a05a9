// front_forgotten.c - the jump leaves T out: two splats behind something nearly opaque may change places unseen.
#include "exercises/exercise.h"

REAL pop_delta(REAL a1, REAL a2, const REAL c1[3], const REAL c2[3], REAL T) {
    REAL sum = 0;
    for (int c = 0; c < 3; c++) sum += (c1[c] - c2[c]) * (c1[c] - c2[c]);
    (void)T;
    return a1 * a2 * sqrt(sum);
}

static REAL depth_of(const Cam *c, const REAL p[3]) {
    return c->R[6] * p[0] + c->R[7] * p[1] + c->R[8] * p[2] + c->t[2];
}

int order_by_depth(const Cam *c, const REAL (*mu)[3], int n, unsigned *idx) {
    int count = 0;
    for (int i = 0; i < n; i++) {
        REAL z = depth_of(c, mu[i]);
        if (!(z > 0)) continue;
        int at = count++;
        for (; at > 0 && depth_of(c, mu[idx[at - 1]]) > z; at--) idx[at] = idx[at - 1];
        idx[at] = (unsigned)i;
    }
    return count;
}
