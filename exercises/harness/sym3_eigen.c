// sym3_eigen.c - Jacobi's method: turn the largest off-diagonal entry away until none is left (Golub and Van Loan, "Matrix
// Computations", chapter 8). Slow beside a closed formula, but every step is a rotation, so nothing is lost to cancellation.
#include "exercises/harness/sym3_eigen.h"

#include <float.h>
#include <math.h>

enum { SWEEPS_MAX = 30 };

// a <- J^T a J with the rotation J in the plane (p, q) that makes a[p][q] zero; r is the third index.
static void turn(double a[3][3], int p, int q) {
    if (a[p][q] == 0) return;
    int r = 3 - p - q;
    double tau = (a[q][q] - a[p][p]) / (2 * a[p][q]);
    double t = copysign(1, tau) / (fabs(tau) + hypot(1, tau)); // the tangent of the smaller angle
    double c = 1 / hypot(1, t), s = t * c, rp = a[r][p], rq = a[r][q];
    a[p][p] -= t * a[p][q];
    a[q][q] += t * a[p][q];
    a[p][q] = a[q][p] = 0;
    a[r][p] = a[p][r] = c * rp - s * rq;
    a[r][q] = a[q][r] = s * rp + c * rq;
}

static void sort3(double v[3]) {
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 2 - i; k++)
            if (v[k] > v[k + 1]) {
                double larger = v[k];
                v[k] = v[k + 1];
                v[k + 1] = larger;
            }
}

void sym3_eigenvalues(Sym3 s, double values[3]) {
    double a[3][3] = {{s.xx, s.xy, s.xz}, {s.xy, s.yy, s.yz}, {s.xz, s.yz, s.zz}}, sum = 0;
    for (int i = 0; i < 9; i++) sum += fabs(a[i / 3][i % 3]);
    if (!isfinite(sum)) {
        values[0] = values[1] = values[2] = NAN;
        return;
    }
    for (int sweep = 0; sweep < SWEEPS_MAX; sweep++) {
        if (fabs(a[0][1]) + fabs(a[0][2]) + fabs(a[1][2]) <= DBL_EPSILON * DBL_EPSILON * sum) break;
        turn(a, 0, 1);
        turn(a, 0, 2);
        turn(a, 1, 2);
    }
    for (int i = 0; i < 3; i++) values[i] = a[i][i];
    sort3(values);
}
