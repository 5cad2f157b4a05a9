// compositing.h - front-to-back alpha blending, the equation that 3D Gaussian Splatting shares with NeRF:
//     C = sum_i T_i alpha_i c_i + T_end background,   T_i = prod_{j<i} (1 - alpha_j).
// (Max 1995; Mildenhall et al. 2020, eq. 3; Kerbl et al. 2023, eq. 3.)
#ifndef SPLATLAB_SPLAT2D_COMPOSITING_H
#define SPLATLAB_SPLAT2D_COMPOSITING_H

#include <stdbool.h>

// When a pixel is opaque. AFTER: blend while T >= stop before the splat (ours: less than `stop` is left unseen).
// BEFORE: do not blend the splat that would bring T below stop (the original code's; leaves up to
// stop / (1 - alpha_max) unseen: 1e-2 with the values of kernels/shared.h).
typedef enum { STOP_AFTER_BLEND, STOP_BEFORE_BLEND } StopRule;

typedef struct {
    double alpha_max; // larger alphas are clamped to it
    double alpha_min; // smaller alphas are skipped
    double stop;      // transmittance at which a pixel counts as opaque
    StopRule rule;
} CompositeRule;

CompositeRule composite_rule_default(void); // the values of kernels/shared.h

// One pixel on its way from front to back; begins with composite_begin().
typedef struct {
    double rgb[3];        // sum so far, without background
    double transmittance; // T
    bool opaque;          // nothing behind is blended any more
} Composite;

Composite composite_begin(void);

// Blends one splat of that alpha and colour behind what is there; returns its weight T alpha (0 when it was skipped or
// the pixel is opaque).
double composite_blend(Composite *pixel, const CompositeRule *rule, double alpha, const double rgb[3]);

// Adds T_end * background.
void composite_end(Composite *pixel, const double background[3]);

#endif
