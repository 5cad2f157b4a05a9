// clamp_at_edge.c - the ratio is clamped at the edge of the picture, without the margin of 0.3 half pictures: splats that are
// seen in part would be drawn with another J than the same splats a little further in.
#include "exercises/exercise.h"

// What J W is made of: its rows, and x/z, y/z as they are used in J.
typedef struct {
    REAL ratio[2];
    int is_free[2]; // 0: the ratio was clamped, so it does not move with the mean
    REAL row[2][3]; // of J W, px per world unit
} Map;

static REAL clamped(REAL ratio, REAL size, REAL focal, REAL centre, int *is_free) {
    REAL low = -centre / focal, high = (size - centre) / focal;
    *is_free = low <= ratio && ratio <= high;
    return ratio < low ? low : ratio > high ? high : ratio;
}

static Map map_at(const Cam *c, const REAL t[3]) {
    Map m;
    REAL x = t[0], y = t[1], z = t[2];
    m.ratio[0] = clamped(x / z, c->width, c->fx, c->cx, &m.is_free[0]);
    m.ratio[1] = clamped(y / z, c->height, c->fy, c->cy, &m.is_free[1]);
    for (int k = 0; k < 3; k++) {
        m.row[0][k] = c->fx / z * (c->R[k] - m.ratio[0] * c->R[6 + k]);
        m.row[1][k] = c->fy / z * (c->R[3 + k] - m.ratio[1] * c->R[6 + k]);
    }
    return m;
}

static void times(const REAL S[6], const REAL v[3], REAL out[3]) {
    out[0] = S[0] * v[0] + S[1] * v[1] + S[2] * v[2];
    out[1] = S[1] * v[0] + S[3] * v[1] + S[4] * v[2];
    out[2] = S[2] * v[0] + S[4] * v[1] + S[5] * v[2];
}

static REAL dot(const REAL a[3], const REAL b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// The rows a, b of J W give J W S W^T J^T = (a.Sa, a.Sb, b.Sb).
void cov2_project(const Cam *c, const REAL t[3], const REAL S3[6], REAL S2[3]) {
    Map m = map_at(c, t);
    REAL Sa[3], Sb[3];
    times(S3, m.row[0], Sa);
    times(S3, m.row[1], Sb);
    S2[0] = dot(m.row[0], Sa) + (REAL)0.3;
    S2[1] = dot(m.row[0], Sb);
    S2[2] = dot(m.row[1], Sb) + (REAL)0.3;
}

// From back to front: S2 -> rows of J W -> rows of J = f/z (1, 0, -u) and f/z (0, 1, -v) -> z, and u = x/z, v = y/z where
// they are free.
void cov2_project_vjp(const Cam *c, const REAL t[3], const REAL S3[6], const REAL dS2[3], REAL dt[3]) {
    Map m = map_at(c, t);
    const REAL focal[2] = {c->fx, c->fy};
    REAL z = t[2], S_row[2][3];
    for (int i = 0; i < 2; i++) times(S3, m.row[i], S_row[i]);
    dt[0] = dt[1] = dt[2] = 0;
    for (int i = 0; i < 2; i++) {
        REAL own = i == 0 ? dS2[0] : dS2[2], d_row[3];
        for (int k = 0; k < 3; k++) d_row[k] = 2 * own * S_row[i][k] + dS2[1] * S_row[1 - i][k];
        REAL d_first = focal[i] / z * dot(c->R + 3 * i, d_row); // by the row of J: its 1, and its -u
        REAL d_last = focal[i] / z * dot(c->R + 6, d_row);
        dt[2] -= (d_first - m.ratio[i] * d_last) / z;
        if (!m.is_free[i]) continue;
        dt[i] -= d_last / z;
        dt[2] += d_last * m.ratio[i] / z;
    }
}
