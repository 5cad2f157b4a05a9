// normalisation_has_no_gradient.c - M3: the step d -> d / |d| has no gradient: a step along d does not turn it, so the part
// along d has to be taken out.
#define sh_color_vjp solution_sh_color_vjp
#include "exercises/solutions/sh.c"
#undef sh_color_vjp

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
    for (int axis = 0; axis < 3; axis++) dd[axis] = dn[axis] / r;
}
