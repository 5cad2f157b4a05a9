// cut_draws.c - counts draws until enough of them lie inside the cut.
#include "exercises/harness/cut_draws.h"

#include "exercises/exercise.h"
#include "splat3d/ewa_error.h"

CutDraws cut_draws(unsigned long seed, int n) {
    double sum[3] = {0}, square = 0;
    int kept = 0;
    for (unsigned long i = 0; kept < n; i++) {
        double z[3];
        draw_normals(seed, i, z);
        double z2 = z[0] * z[0] + z[1] * z[1] + z[2] * z[2];
        if (z2 > EWA_CUT * EWA_CUT) continue;
        for (int k = 0; k < 3; k++) sum[k] += z[k] / n;
        square += z2 / n;
        kept++;
    }
    double mean2 = sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2];
    return (CutDraws){mean2, square - mean2};
}
