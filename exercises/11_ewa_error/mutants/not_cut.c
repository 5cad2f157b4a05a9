// not_cut.c - nothing is cut: a Gaussian has no end, so some draws reach the plane of the camera, where x/z has no bound. One
// of them spoils mean and covariance; more draws make it worse.
#include "exercises/exercise.h"

// S = L L^T with L lower triangular (Cholesky). Where there is no variance left, the column is 0.
static void root_of(const REAL S[6], REAL L[3][3]) {
    const REAL a[3][3] = {{S[0], S[1], S[2]}, {S[1], S[3], S[4]}, {S[2], S[4], S[5]}};
    for (int j = 0; j < 3; j++) {
        REAL left = a[j][j];
        for (int k = 0; k < j; k++) left -= L[j][k] * L[j][k];
        L[j][j] = left > 0 ? sqrt(left) : 0;
        for (int i = 0; i < 3; i++) {
            if (i == j) continue;
            REAL rest = a[i][j];
            for (int k = 0; k < j; k++) rest -= L[i][k] * L[j][k];
            L[i][j] = i > j && L[j][j] > 0 ? rest / L[j][j] : 0;
        }
    }
}

static void pixel_of(const Cam *c, const REAL p[3], REAL uv[2]) {
    REAL x[3];
    for (int i = 0; i < 3; i++) x[i] = c->R[3 * i] * p[0] + c->R[3 * i + 1] * p[1] + c->R[3 * i + 2] * p[2] + c->t[i];
    uv[0] = c->fx * x[0] / x[2] + c->cx;
    uv[1] = c->fy * x[1] / x[2] + c->cy;
}

// Sums are of distances from where mu itself falls: squares of pixel coordinates would swallow a small spread in float.
void mc_project(const Cam *c, const REAL mu[3], const REAL S3[6], int n, unsigned long seed, REAL mean[2],
                REAL cov[3]) {
    REAL L[3][3], centre[2], sum[2] = {0, 0}, square[3] = {0, 0, 0};
    root_of(S3, L);
    pixel_of(c, mu, centre);
    int kept = 0;
    for (unsigned long i = 0; kept < n; i++) {
        REAL z[3], p[3], uv[2];
        draw_normals(seed, i, z);
        for (int k = 0; k < 3; k++) p[k] = mu[k] + L[k][0] * z[0] + L[k][1] * z[1] + L[k][2] * z[2];
        pixel_of(c, p, uv);
        REAL dx = uv[0] - centre[0], dy = uv[1] - centre[1];
        sum[0] += dx, sum[1] += dy;
        square[0] += dx * dx, square[1] += dx * dy, square[2] += dy * dy;
        kept++;
    }
    REAL x = sum[0] / n, y = sum[1] / n;
    mean[0] = centre[0] + x;
    mean[1] = centre[1] + y;
    cov[0] = square[0] / n - x * x;
    cov[1] = square[1] / n - x * y;
    cov[2] = square[2] / n - y * y;
}

// The length of a symmetric matrix: all four entries count.
static REAL length_of(REAL xx, REAL xy, REAL yy) { return sqrt(xx * xx + 2 * xy * xy + yy * yy); }

void ewa_error(const REAL mean[2], const REAL cov[3], const REAL centre[2], const REAL S2[3], REAL *shift,
               REAL *relative) {
    REAL dx = mean[0] - centre[0], dy = mean[1] - centre[1], det = S2[0] * S2[2] - S2[1] * S2[1];
    *shift = sqrt((dx * dx * S2[2] - 2 * dx * dy * S2[1] + dy * dy * S2[0]) / det);
    *relative = length_of(cov[0] - S2[0], cov[1] - S2[1], cov[2] - S2[2]) / length_of(S2[0], S2[1], S2[2]);
}
