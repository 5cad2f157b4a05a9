// clamp_forgotten_in_gradient.c - M6: the gradient passes through x/z and y/z as if they were never clamped: a clamped ratio is
// a constant, it moves neither with x and y nor with z.
#define cov2_project_vjp solution_cov2_project_vjp
#include "exercises/solutions/ewa.c"
#undef cov2_project_vjp

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
        dt[i] -= d_last / z;
        dt[2] += d_last * m.ratio[i] / z;
    }
}
