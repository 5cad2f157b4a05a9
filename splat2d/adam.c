// adam.c - the step, with the correction of its slow start.
#include "splat2d/adam.h"

#include <math.h>

AdamRule adam_rule_default(double learning_rate) {
    return (AdamRule){.learning_rate = learning_rate, .beta1 = 0.9, .beta2 = 0.999, .epsilon = 1e-15};
}

// m and v begin at zero and are therefore too small at first, by the factor 1 - beta^step; dividing corrects that.
void adam_step(const AdamRule *rule, int step, int count, const double *gradient, double *value, double *m, double *v) {
    double m_part = 1 - pow(rule->beta1, step);
    double v_part = 1 - pow(rule->beta2, step);
    for (int i = 0; i < count; i++) {
        double g = gradient[i];
        m[i] = rule->beta1 * m[i] + (1 - rule->beta1) * g;
        v[i] = rule->beta2 * v[i] + (1 - rule->beta2) * g * g;
        value[i] -= rule->learning_rate * (m[i] / m_part) / (sqrt(v[i] / v_part) + rule->epsilon);
    }
}
