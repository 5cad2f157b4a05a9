// shift_in_px.c - the shift is given in px: small on the screen does not mean accurate. Away from the splat's own size a pixel
// says nothing; the focal length changes it, but not the error.
#define ewa_error solution_ewa_error
#include "exercises/solutions/ewa_error.c"
#undef ewa_error

void ewa_error(const REAL mean[2], const REAL cov[3], const REAL centre[2], const REAL S2[3], REAL *shift,
               REAL *relative) {
    REAL dx = mean[0] - centre[0], dy = mean[1] - centre[1];
    *shift = sqrt(dx * dx + dy * dy);
    *relative = length_of(cov[0] - S2[0], cov[1] - S2[1], cov[2] - S2[2]) / length_of(S2[0], S2[1], S2[2]);
}
