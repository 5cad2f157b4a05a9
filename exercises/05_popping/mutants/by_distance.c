// by_distance.c - splats are ordered by their distance from the camera: 3DGS goes by z, the distance along its axis. By
// distance, turning on the spot would never change the order.
#include "exercises/exercise.h"

REAL pop_delta(REAL a1, REAL a2, const REAL c1[3], const REAL c2[3], REAL T) {
    REAL sum = 0;
    for (int c = 0; c < 3; c++) sum += (c1[c] - c2[c]) * (c1[c] - c2[c]);
    return T * a1 * a2 * sqrt(sum);
}

static REAL depth_of(const Cam *c, const REAL p[3]) {
    REAL q[3], sum = 0;
    for (int i = 0; i < 3; i++) {
        q[i] = c->R[3 * i] * p[0] + c->R[3 * i + 1] * p[1] + c->R[3 * i + 2] * p[2] + c->t[i];
        sum += q[i] * q[i];
    }
    return q[2] > 0 ? sqrt(sum) : -1;
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
