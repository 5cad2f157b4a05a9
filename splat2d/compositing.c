// compositing.c - one pixel from front to back.
#include "splat2d/compositing.h"

#include "kernels/shared.h"

#include <math.h>

CompositeRule composite_rule_default(void) {
    return (CompositeRule){
        .alpha_max = ALPHA_MAX, .alpha_min = ALPHA_MIN, .stop = TRANSMITTANCE_STOP, .rule = STOP_AFTER_BLEND};
}

Composite composite_begin(void) { return (Composite){.rgb = {0, 0, 0}, .transmittance = 1, .opaque = false}; }

double composite_blend(Composite *pixel, const CompositeRule *rule, double alpha, const double rgb[3]) {
    if (pixel->opaque || alpha < rule->alpha_min) return 0;
    alpha = fmin(alpha, rule->alpha_max);
    double behind = pixel->transmittance * (1 - alpha);
    pixel->opaque = behind < rule->stop;
    if (pixel->opaque && rule->rule == STOP_BEFORE_BLEND) return 0;

    double weight = pixel->transmittance * alpha;
    for (int c = 0; c < 3; c++) pixel->rgb[c] += weight * rgb[c];
    pixel->transmittance = behind;
    return weight;
}

void composite_end(Composite *pixel, const double background[3]) {
    for (int c = 0; c < 3; c++) pixel->rgb[c] += pixel->transmittance * background[c];
}
