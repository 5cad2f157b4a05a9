#include "splat3d/reference.h"

#include "lab/base/rng.h"
#include "tests/support/difference.h"
#include "tests/support/support.h"

#include <gsl/gsl_eigen.h>
#include <string.h>

enum { SEEDS = 100 };

typedef struct {
    char seed[32];
    double log_scale[3], quat[4];
    Sym3 weight; // the loss is weight . Sigma by the stored numbers, so d_Sigma = weight
} Shape;

static Shape random_shape(uint32_t seed) {
    Shape shape;
    snprintf(shape.seed, sizeof shape.seed, "seed %u", seed);
    Rng rng = rng_at(seed, RNG_TEST, 0, 0);
    for (int k = 0; k < 3; k++) shape.log_scale[k] = rng_range(&rng, -1.5, 1);
    for (int k = 0; k < 4; k++) shape.quat[k] = rng_normal(&rng); // of any length
    double *weight = &shape.weight.xx;
    for (int k = 0; k < 6; k++) weight[k] = rng_normal(&rng);
    return shape;
}

static double weighted_covariance(void *context) {
    const Shape *shape = context;
    Sym3 sigma = reference_covariance_forward(shape->log_scale, shape->quat), w = shape->weight;
    return w.xx * sigma.xx + w.xy * sigma.xy + w.xz * sigma.xz + w.yy * sigma.yy + w.yz * sigma.yz + w.zz * sigma.zz;
}

static void a_quaternion_of_any_length_gives_a_rotation(void **state) {
    (void)state;
    for (uint32_t seed = 1; seed <= SEEDS; seed++) {
        Shape shape = random_shape(seed);
        Mat3 r = reference_rotation_forward(shape.quat), t = mat3_transpose(&r), product = mat3_multiply(&r, &t);
        for (int k = 0; k < 9; k++) support_near(product.m[k], k % 4 == 0, 1e-14, shape.seed);
        Vec3 x = vec3(r.m[0], r.m[1], r.m[2]), y = vec3(r.m[3], r.m[4], r.m[5]), z = vec3(r.m[6], r.m[7], r.m[8]);
        support_near(vec3_dot(vec3_cross(x, y), z), 1, 1e-14, "determinant");
    }
}

static void a_quaternion_turns_counter_clockwise_about_its_axis(void **state) {
    (void)state;
    const double quarter_about_z[4] = {3 * sqrt(0.5), 0, 0, 3 * sqrt(0.5)};
    Mat3 r = reference_rotation_forward(quarter_about_z);
    Vec3 turned = mat3_apply(&r, vec3(1, 0, 0));
    support_near(turned.x, 0, 1e-15, "x");
    support_near(turned.y, 1, 1e-15, "y");
    const double quarter_about_x[4] = {1, 1, 0, 0};
    r = reference_rotation_forward(quarter_about_x);
    support_near(mat3_apply(&r, vec3(0, 1, 0)).z, 1, 1e-15, "z");
}

static void the_eigenvalues_of_sigma_are_the_squared_scales(void **state) {
    (void)state;
    gsl_vector *values = gsl_vector_alloc(3);
    gsl_eigen_symm_workspace *work = gsl_eigen_symm_alloc(3);
    for (uint32_t seed = 1; seed <= SEEDS; seed++) {
        Shape shape = random_shape(seed);
        Sym3 s = reference_covariance_forward(shape.log_scale, shape.quat);
        double entries[9] = {s.xx, s.xy, s.xz, s.xy, s.yy, s.yz, s.xz, s.yz, s.zz};
        gsl_matrix_view matrix = gsl_matrix_view_array(entries, 3, 3);
        gsl_eigen_symm(&matrix.matrix, values, work);
        double found[3] = {0}, expected[3] = {0}; // trace, trace of the square, determinant: free of any order
        for (int k = 0; k < 3; k++) {
            double e = gsl_vector_get(values, (size_t)k), squared = exp(2 * shape.log_scale[k]);
            found[0] += e, found[1] += e * e, found[2] += log(e);
            expected[0] += squared, expected[1] += squared * squared, expected[2] += log(squared);
        }
        for (int k = 0; k < 3; k++) support_near(found[k], expected[k], 1e-11 * (1 + expected[1]), shape.seed);
    }
    gsl_eigen_symm_free(work);
    gsl_vector_free(values);
}

static void the_gradient_of_sigma_agrees_with_central_differences(void **state) {
    (void)state;
    for (uint32_t seed = 1; seed <= SEEDS; seed++) {
        Shape shape = random_shape(seed);
        double d_log_scale[3] = {0}, d_quat[4] = {0}, expected_scale[3], expected_quat[4];
        reference_covariance_backward(shape.log_scale, shape.quat, shape.weight, d_log_scale, d_quat);
        for (int k = 0; k < 3; k++)
            expected_scale[k] = difference_central(&shape.log_scale[k], 1e-3, weighted_covariance, &shape);
        for (int k = 0; k < 4; k++)
            expected_quat[k] = difference_central(&shape.quat[k], 1e-4, weighted_covariance, &shape);
        difference_compare(3, d_log_scale, expected_scale, 1e-8, 1e-8, shape.seed);
        difference_compare(4, d_quat, expected_quat, 1e-8, 1e-8, shape.seed);
        double along = 0; // a longer quaternion is the same rotation
        for (int k = 0; k < 4; k++) along += d_quat[k] * shape.quat[k];
        support_near(along, 0, 1e-12, shape.seed);
    }
}

static void a_ball_has_no_gradient_by_its_rotation(void **state) {
    (void)state;
    Shape shape = random_shape(7);
    for (int k = 0; k < 3; k++) shape.log_scale[k] = 0.3;
    double d_log_scale[3] = {0}, d_quat[4] = {0};
    reference_covariance_backward(shape.log_scale, shape.quat, shape.weight, d_log_scale, d_quat);
    for (int k = 0; k < 4; k++) support_near(d_quat[k], 0, 1e-14, "quaternion");
}

static void backward_adds_to_what_is_there(void **state) {
    (void)state;
    Shape shape = random_shape(8);
    double once_scale[3] = {0}, once_quat[4] = {0}, scale[3] = {1, 1, 1}, quat[4] = {1, 1, 1, 1};
    reference_covariance_backward(shape.log_scale, shape.quat, shape.weight, once_scale, once_quat);
    reference_covariance_backward(shape.log_scale, shape.quat, shape.weight, scale, quat);
    for (int k = 0; k < 3; k++) support_near(scale[k], once_scale[k] + 1, 1e-14, "log-scale");
    for (int k = 0; k < 4; k++) support_near(quat[k], once_quat[k] + 1, 1e-14, "quaternion");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_quaternion_of_any_length_gives_a_rotation),
        cmocka_unit_test(a_quaternion_turns_counter_clockwise_about_its_axis),
        cmocka_unit_test(the_eigenvalues_of_sigma_are_the_squared_scales),
        cmocka_unit_test(the_gradient_of_sigma_agrees_with_central_differences),
        cmocka_unit_test(a_ball_has_no_gradient_by_its_rotation),
        cmocka_unit_test(backward_adds_to_what_is_there),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
