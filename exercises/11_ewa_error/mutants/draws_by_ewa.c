// draws_by_ewa.c - the draws are projected by J, the linear map at the mean: that is EWA once more, and a Gaussian stays a
// Gaussian. Perspective divides each point by its own depth.
#define mc_project solution_mc_project
#include "exercises/solutions/ewa_error.c"
#undef mc_project

static void linear_pixel(const Cam *c, const REAL mu[3], const REAL p[3], const REAL centre[2], REAL uv[2]) {
    REAL x[3], m[3];
    for (int i = 0; i < 3; i++) {
        const REAL *row = c->R + 3 * i;
        x[i] = row[0] * (p[0] - mu[0]) + row[1] * (p[1] - mu[1]) + row[2] * (p[2] - mu[2]);
        m[i] = row[0] * mu[0] + row[1] * mu[1] + row[2] * mu[2] + c->t[i];
    }
    uv[0] = centre[0] + c->fx / m[2] * (x[0] - m[0] / m[2] * x[2]);
    uv[1] = centre[1] + c->fy / m[2] * (x[1] - m[1] / m[2] * x[2]);
}

void mc_project(const Cam *c, const REAL mu[3], const REAL S3[6], int n, unsigned long seed, REAL mean[2],
                REAL cov[3]) {
    REAL L[3][3], centre[2], sum[2] = {0, 0}, square[3] = {0, 0, 0};
    root_of(S3, L);
    pixel_of(c, mu, centre);
    int kept = 0;
    for (unsigned long i = 0; kept < n; i++) {
        REAL z[3], p[3], uv[2];
        draw_normals(seed, i, z);
        if (!is_kept(z)) continue;
        for (int k = 0; k < 3; k++) p[k] = mu[k] + L[k][0] * z[0] + L[k][1] * z[1] + L[k][2] * z[2];
        linear_pixel(c, mu, p, centre, uv);
        REAL dx = uv[0] - centre[0], dy = uv[1] - centre[1];
        sum[0] += dx, sum[1] += dy;
        square[0] += dx * dx, square[1] += dx * dy, square[2] += dy * dy;
        kept++;
    }
    REAL x = sum[0] / n, y = sum[1] / n;
    mean[0] = centre[0] + x;
    mean[1] = centre[1] + y;
    cov[0] = (square[0] / n - x * x) / (REAL)CUT_FACTOR;
    cov[1] = (square[1] / n - x * y) / (REAL)CUT_FACTOR;
    cov[2] = (square[2] / n - y * y) / (REAL)CUT_FACTOR;
}
