// adam.h - the Adam optimiser (Kingma & Ba 2015, algorithm 1) on an array of doubles; the reference for
// kernels/adam.cl.
#ifndef SPLATLAB_SPLAT2D_ADAM_H
#define SPLATLAB_SPLAT2D_ADAM_H

typedef struct {
    double learning_rate;
    double beta1, beta2; // 0.9, 0.999
    double epsilon;      // 1e-15: gradients of splats are tiny, a larger one would change the step
} AdamRule;

AdamRule adam_rule_default(double learning_rate);

// One step, number `step` (1 is the first): updates value, m and v, each of `count` numbers.
void adam_step(const AdamRule *rule, int step, int count, const double *gradient, double *value, double *m, double *v);

#endif
