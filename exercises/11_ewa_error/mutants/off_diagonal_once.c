// off_diagonal_once.c - |cov - S2| counts xy once: the stored number stands for two entries of the matrix, so its square counts
// twice.
#define ewa_error solution_ewa_error
#include "exercises/solutions/ewa_error.c"
#undef ewa_error

static REAL length_without_twin(REAL xx, REAL xy, REAL yy) { return sqrt(xx * xx + xy * xy + yy * yy); }

void ewa_error(const REAL mean[2], const REAL cov[3], const REAL centre[2], const REAL S2[3], REAL *shift,
               REAL *relative) {
    REAL dx = mean[0] - centre[0], dy = mean[1] - centre[1], det = S2[0] * S2[2] - S2[1] * S2[1];
    *shift = sqrt((dx * dx * S2[2] - 2 * dx * dy * S2[1] + dy * dy * S2[0]) / det);
    *relative =
        length_without_twin(cov[0] - S2[0], cov[1] - S2[1], cov[2] - S2[2]) / length_without_twin(S2[0], S2[1], S2[2]);
}
