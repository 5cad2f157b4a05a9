// order_xyz.c - degree 1 is taken in the order x, y, z: the order is m = -1, 0, 1, which is y, z, x.
#include "exercises/exercise.h"

enum { COEFFICIENTS_MAX = 16 };

// The harmonics at a unit direction: Y[i], and dY[i][] by x, y, z as three free numbers.
typedef struct {
    REAL Y[COEFFICIENTS_MAX], dY[COEFFICIENTS_MAX][3];
} Basis;

// Y_i is `factor` times a polynomial, which is given with its gradient.
static void set(Basis *b, int i, double factor, REAL value, REAL dx, REAL dy, REAL dz) {
    REAL f = (REAL)factor;
    b->Y[i] = f * value;
    b->dY[i][0] = f * dx, b->dY[i][1] = f * dy, b->dY[i][2] = f * dz;
}

static Basis basis(int deg, REAL x, REAL y, REAL z) {
    Basis b;
    REAL xx = x * x, yy = y * y, zz = z * z;
    set(&b, 0, sqrt(1 / (4 * M_PI)), 1, 0, 0, 0);
    if (deg < 1) return b;
    double k1 = sqrt(3 / (4 * M_PI));
    set(&b, 1, -k1, x, 1, 0, 0);
    set(&b, 2, -k1, y, 0, 1, 0);
    set(&b, 3, k1, z, 0, 0, 1);
    if (deg < 2) return b;
    double k2 = sqrt(15 / (4 * M_PI));
    set(&b, 4, k2, x * y, y, x, 0);
    set(&b, 5, -k2, y * z, 0, z, y);
    set(&b, 6, sqrt(5 / (16 * M_PI)), 2 * zz - xx - yy, -2 * x, -2 * y, 4 * z);
    set(&b, 7, -k2, x * z, z, 0, x);
    set(&b, 8, k2 / 2, xx - yy, 2 * x, -2 * y, 0);
    if (deg < 3) return b;
    double k31 = sqrt(21 / (32 * M_PI)), k32 = sqrt(105 / (4 * M_PI)), k33 = sqrt(35 / (32 * M_PI));
    set(&b, 9, -k33, y * (3 * xx - yy), 6 * x * y, 3 * (xx - yy), 0);
    set(&b, 10, k32, x * y * z, y * z, x * z, x * y);
    set(&b, 11, -k31, y * (4 * zz - xx - yy), -2 * x * y, 4 * zz - xx - 3 * yy, 8 * y * z);
    set(&b, 12, sqrt(7 / (16 * M_PI)), z * (2 * zz - 3 * xx - 3 * yy), -6 * x * z, -6 * y * z,
        6 * zz - 3 * xx - 3 * yy);
    set(&b, 13, -k31, x * (4 * zz - xx - yy), 4 * zz - 3 * xx - yy, -2 * x * y, 8 * x * z);
    set(&b, 14, k32 / 2, z * (xx - yy), 2 * x * z, -2 * y * z, xx - yy);
    set(&b, 15, -k33, x * (xx - 3 * yy), 3 * (xx - yy), -6 * x * y, 0);
    return b;
}

static REAL length_of(const REAL d[3]) { return sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]); }

void sh_color(int deg, const REAL d[3], const REAL (*k)[3], REAL rgb[3], int clamped[3]) {
    REAL r = length_of(d);
    Basis b = basis(deg, d[0] / r, d[1] / r, d[2] / r);
    for (int c = 0; c < 3; c++) {
        REAL sum = (REAL)0.5;
        for (int i = 0; i < (deg + 1) * (deg + 1); i++) sum += b.Y[i] * k[i][c];
        clamped[c] = sum < 0;
        rgb[c] = clamped[c] ? 0 : sum;
    }
}

// Through n = d / |d| only the part of the gradient across n comes back, over |d|.
void sh_color_vjp(int deg, const REAL d[3], const REAL (*k)[3], const int clamped[3], const REAL drgb[3], REAL (*dk)[3],
                  REAL dd[3]) {
    REAL r = length_of(d), n[3] = {d[0] / r, d[1] / r, d[2] / r}, dn[3] = {0, 0, 0};
    Basis b = basis(deg, n[0], n[1], n[2]);
    for (int i = 0; i < (deg + 1) * (deg + 1); i++)
        for (int c = 0; c < 3; c++) {
            REAL from = clamped[c] ? 0 : drgb[c];
            dk[i][c] = b.Y[i] * from;
            for (int axis = 0; axis < 3; axis++) dn[axis] += k[i][c] * b.dY[i][axis] * from;
        }
    REAL along = n[0] * dn[0] + n[1] * dn[1] + n[2] * dn[2];
    for (int axis = 0; axis < 3; axis++) dd[axis] = (dn[axis] - along * n[axis]) / r;
}
