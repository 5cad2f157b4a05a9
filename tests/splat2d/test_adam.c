#include "splat2d/adam.h"

#include "tests/support/support.h"

#include <math.h>

static void the_first_step_is_the_learning_rate_against_the_sign(void **state) {
    (void)state;
    AdamRule rule = adam_rule_default(0.01);
    const double gradient[3] = {1e-7, -5, 0};
    double value[3] = {1, 2, 3}, m[3] = {0}, v[3] = {0};
    adam_step(&rule, 1, 3, gradient, value, m, v);
    support_near(value[0], 1 - 0.01, 1e-9, "tiny gradient, full step");
    support_near(value[1], 2 + 0.01, 1e-9, "large gradient, the same step");
    support_near(value[2], 3, 0, "no gradient, no step");
    support_near(m[1], -0.5, 1e-15, "m");
    support_near(v[1], 0.025, 1e-15, "v");
}

static void two_steps_by_hand(void **state) {
    (void)state;
    AdamRule rule = {.learning_rate = 0.1, .beta1 = 0.5, .beta2 = 0.75, .epsilon = 0.5};
    double value = 1, m = 0, v = 0, gradient = 2;
    adam_step(&rule, 1, 1, &gradient, &value, &m, &v); // m 1 -> 2, v 1 -> 4: step 0.1 * 2 / (2 + 0.5)
    support_near(value, 1 - 0.08, 1e-15, "first");
    gradient = -1;
    adam_step(&rule, 2, 1, &gradient, &value, &m, &v); // m 0, v 1 -> 1 / (1 - 0.5625)
    support_near(m, 0, 1e-15, "m");
    support_near(v, 1, 1e-15, "v");
    support_near(value, 0.92, 1e-15, "second: momentum and gradient cancel");
    gradient = 3;
    adam_step(&rule, 3, 1, &gradient, &value, &m, &v); // m 1.5 / 0.875, v 3 / (1 - 0.421875)
    support_near(value, 0.92 - 0.1 * (1.5 / 0.875) / (sqrt(3 / 0.578125) + 0.5), 1e-15, "third");
}

static void a_step_scales_with_the_learning_rate_and_not_with_the_gradient(void **state) {
    (void)state;
    const double gradients[4] = {0.3, -0.1, 0.7, 0.2};
    double travelled[3];
    for (int variant = 0; variant < 3; variant++) {
        AdamRule rule = adam_rule_default(variant == 1 ? 0.02 : 0.01);
        double value = 0, m = 0, v = 0;
        for (int step = 1; step <= 4; step++) {
            double gradient = gradients[step - 1] * (variant == 2 ? 1e-6 : 1);
            adam_step(&rule, step, 1, &gradient, &value, &m, &v);
        }
        travelled[variant] = value;
    }
    support_near(travelled[1], 2 * travelled[0], 1e-15, "double learning rate");
    support_near(travelled[2], travelled[0], 1e-8, "gradient a million times smaller");
}

static void it_finds_the_bottom_of_a_narrow_valley(void **state) {
    (void)state;
    AdamRule rule = adam_rule_default(0.05);
    double at[2] = {-3, 4}, m[2] = {0}, v[2] = {0};
    for (int step = 1; step <= 2000; step++) {
        double gradient[2] = {2 * (at[0] - 1), 200 * (at[1] + 2)}; // (x - 1)^2 + 100 (y + 2)^2
        adam_step(&rule, step, 2, gradient, at, m, v);
    }
    support_near(at[0], 1, 1e-3, "x");
    support_near(at[1], -2, 1e-3, "y");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_first_step_is_the_learning_rate_against_the_sign),
        cmocka_unit_test(two_steps_by_hand),
        cmocka_unit_test(a_step_scales_with_the_learning_rate_and_not_with_the_gradient),
        cmocka_unit_test(it_finds_the_bottom_of_a_narrow_valley),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
