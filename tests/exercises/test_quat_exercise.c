// test_quat_exercise.c - the gradient of a rotation with which E07 compares, against GSL's numerical derivative.
#include "lab/base/rng.h"
#include "splat3d/reference.h"
#include "tests/support/support.h"

#include <gsl/gsl_deriv.h>
#include <math.h>

enum { SEEDS = 50 };

typedef struct {
    double quat[4];
    int part, entry; // the part of quat that is varied, the entry of R that is looked at
} Variation;

static double entry_of(double value, void *context) {
    Variation v = *(Variation *)context;
    v.quat[v.part] = value;
    return reference_rotation_forward(v.quat).m[v.entry];
}

static void each_entry_of_a_rotation_has_the_gradient_that_gsl_finds(void **state) {
    (void)state;
    for (uint32_t seed = 1; seed <= SEEDS; seed++) {
        Rng rng = rng_at(seed, RNG_TEST, 0, 0);
        Variation v;
        double factor = exp(rng_range(&rng, -2, 2)), length = 0;
        for (int k = 0; k < 4; k++) v.quat[k] = factor * rng_normal(&rng), length += v.quat[k] * v.quat[k];
        length = sqrt(length);
        for (v.entry = 0; v.entry < 9; v.entry++) {
            Mat3 d_rotation = {{0}};
            double d_quat[4] = {0};
            d_rotation.m[v.entry] = 1;
            reference_rotation_backward(v.quat, &d_rotation, d_quat);
            for (v.part = 0; v.part < 4; v.part++) {
                gsl_function f = {.function = entry_of, .params = &v};
                double found, error;
                gsl_deriv_central(&f, v.quat[v.part], 1e-3 * length, &found, &error);
                support_near(d_quat[v.part], found, 1e-9 / length, "d R / d q");
            }
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_entry_of_a_rotation_has_the_gradient_that_gsl_finds),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
