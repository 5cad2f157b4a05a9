#include "splat3d/reference.h"

#include "lab/base/rng.h"
#include "tests/support/difference.h"
#include "tests/support/support.h"

#include <gsl/gsl_integration.h>
#include <gsl/gsl_sf_legendre.h>

enum { DEGREE = SH_DEGREE_MAX, COUNT = SH_COEFFICIENTS_MAX };

static Vec3 random_direction(Rng *rng) {
    return vec3_normalize(vec3(rng_normal(rng), rng_normal(rng), rng_normal(rng)));
}

// Gauss-Legendre in z, equal steps round it: exact for polynomials up to degree 15 in z and 15 waves.
static void the_basis_is_orthonormal_on_the_sphere(void **state) {
    (void)state;
    enum { RINGS = 8, STEPS = 16 };
    double product[COUNT][COUNT] = {0};
    gsl_integration_glfixed_table *table = gsl_integration_glfixed_table_alloc(RINGS);
    for (size_t ring = 0; ring < RINGS; ring++)
        for (int step = 0; step < STEPS; step++) {
            double z, weight, phi = 2 * M_PI * step / STEPS, basis[COUNT];
            gsl_integration_glfixed_point(-1, 1, ring, &z, &weight, table);
            double r = sqrt(1 - z * z), d[3] = {r * cos(phi), r * sin(phi), z};
            reference_sh_basis(DEGREE, d, basis);
            for (int i = 0; i < COUNT; i++)
                for (int j = 0; j < COUNT; j++) product[i][j] += weight * 2 * M_PI / STEPS * basis[i] * basis[j];
        }
    gsl_integration_glfixed_table_free(table);
    for (int i = 0; i < COUNT; i++)
        for (int j = 0; j < COUNT; j++) support_near(product[i][j], i == j, 1e-13, "integral of Y_i Y_j");
}

// From associated Legendre functions: sqrt(2) P_l^|m| times cos(m phi) or sin(|m| phi), the sign (-1)^m in P.
static void the_basis_has_the_usual_order_and_signs(void **state) {
    (void)state;
    Rng rng = rng_at(1, RNG_TEST, 0, 0);
    for (int n = 0; n < 50; n++) {
        Vec3 v = random_direction(&rng);
        double basis[COUNT], phi = atan2(v.y, v.x);
        reference_sh_basis(DEGREE, (const double[3]){v.x, v.y, v.z}, basis);
        for (int l = 0; l <= DEGREE; l++)
            for (int m = -l; m <= l; m++) {
                double expected = gsl_sf_legendre_sphPlm(l, abs(m), v.z);
                if (m > 0) expected *= sqrt(2) * cos(m * phi);
                if (m < 0) expected *= sqrt(2) * sin(-m * phi);
                support_near(basis[l * l + l + m], expected, 1e-14, "Y_lm");
            }
    }
}

static void a_lower_degree_is_the_beginning_of_a_higher_one(void **state) {
    (void)state;
    const double d[3] = {0.48, -0.64, 0.6};
    double all[COUNT];
    reference_sh_basis(DEGREE, d, all);
    for (int degree = 0; degree < DEGREE; degree++) {
        double some[COUNT];
        for (int k = 0; k < COUNT; k++) some[k] = 1234;
        reference_sh_basis(degree, d, some);
        for (int k = 0; k < COUNT; k++)
            support_near(some[k], k < (degree + 1) * (degree + 1) ? all[k] : 1234, 0, "beginning, and no more");
    }
}

typedef struct {
    double d[3];
    int k;
} BasisAt;

static double basis_at(void *context) {
    const BasisAt *at = context;
    double basis[COUNT];
    reference_sh_basis(DEGREE, at->d, basis);
    return basis[at->k];
}

static void the_jacobian_of_the_basis_agrees_with_central_differences(void **state) {
    (void)state;
    Rng rng = rng_at(2, RNG_TEST, 0, 0);
    for (int n = 0; n < 20; n++) {
        Vec3 v = random_direction(&rng);
        BasisAt at = {.d = {v.x, v.y, v.z}};
        double jacobian[COUNT][3];
        reference_sh_basis_jacobian(DEGREE, at.d, jacobian);
        for (at.k = 0; at.k < COUNT; at.k++)
            for (int axis = 0; axis < 3; axis++)
                support_near(jacobian[at.k][axis], difference_central(&at.d[axis], 1e-3, basis_at, &at), 1e-11,
                             "dY/dd");
    }
}

// One splat before one camera, and a weighted sum of its colour as the loss.
typedef struct {
    GaussiansD model;
    Camera camera;
    RenderSettings settings;
    double weight[3];
} Scene;

static Scene scene_create(int degree) {
    Scene scene = {.model = gaussiansd_create(1, degree), .settings = render_settings_default(), .weight = {1, -2, 3}};
    scene.camera = camera_look_at(vec3(1, -2, -5), vec3(0.2, 0.1, 0.3), vec3(0, -1, 0), 1, 40, 30);
    Rng rng = rng_at(3, RNG_TEST, (uint32_t)degree, 0);
    for (int k = 0; k < 3; k++) scene.model.field[FIELD_MEAN][k] = rng_range(&rng, -0.5, 0.5);
    for (int l = 0; l <= degree; l++)
        for (int k = 0; k < 3 * (2 * l + 1); k++)
            scene.model.field[FIELD_SH0 + l][k] = rng_range(&rng, -0.15, 0.15); // no channel comes near the clamp
    return scene;
}

static double weighted_colour(void *context) {
    const Scene *scene = context;
    double rgb[3];
    reference_colour_forward(&scene->model, 0, &scene->camera, &scene->settings, rgb);
    return scene->weight[0] * rgb[0] + scene->weight[1] * rgb[1] + scene->weight[2] * rgb[2];
}

static void the_gradient_of_the_colour_reaches_coefficients_and_mean(void **state) {
    (void)state;
    for (int degree = 0; degree <= DEGREE; degree++) {
        Scene scene = scene_create(degree);
        GaussiansD d = gaussiansd_create(1, degree);
        reference_colour_backward(&scene.model, 0, &scene.camera, &scene.settings, scene.weight, &d);
        for (GaussianFieldId id = 0; id < FIELD_COUNT; id++) {
            double expected[21] = {0};
            if (!d.field[id]) continue;
            for (int k = 0; k < GAUSSIAN_FIELDS[id].width; k++)
                expected[k] = difference_central(&scene.model.field[id][k], 1e-3, weighted_colour, &scene);
            difference_compare(GAUSSIAN_FIELDS[id].width, d.field[id], expected, 1e-8, 1e-8, GAUSSIAN_FIELDS[id].name);
        }
        gaussiansd_destroy(&d);
        gaussiansd_destroy(&scene.model);
    }
}

static void degree_0_looks_the_same_from_everywhere(void **state) {
    (void)state;
    Scene scene = scene_create(DEGREE);
    double front[3], back[3];
    scene.settings.sh_degree = 0; // the model has more
    reference_colour_forward(&scene.model, 0, &scene.camera, &scene.settings, front);
    scene.camera = camera_look_at(vec3(4, 1, 9), vec3(0, 0, 0), vec3(0, -1, 0), 1, 40, 30);
    reference_colour_forward(&scene.model, 0, &scene.camera, &scene.settings, back);
    for (int c = 0; c < 3; c++) {
        support_near(front[c], back[c], 0, "colour");
        support_near(front[c], 0.5 + scene.model.field[FIELD_SH0][c] / sqrt(4 * M_PI), 1e-15, "from its coefficient");
    }
    scene.settings.sh_degree = DEGREE;
    reference_colour_forward(&scene.model, 0, &scene.camera, &scene.settings, back);
    assert_true(fabs(front[0] - back[0]) > 1e-3);
    gaussiansd_destroy(&scene.model);
}

static void a_channel_below_0_is_black_and_has_no_gradient(void **state) {
    (void)state;
    Scene scene = scene_create(DEGREE);
    scene.model.field[FIELD_SH0][1] = -4;
    double rgb[3];
    reference_colour_forward(&scene.model, 0, &scene.camera, &scene.settings, rgb);
    assert_true(rgb[0] > 0 && rgb[1] == 0 && rgb[2] > 0);

    const double only_green[3] = {0, 1, 0}, only_red[3] = {1, 0, 0};
    GaussiansD d = gaussiansd_create(1, DEGREE);
    reference_colour_backward(&scene.model, 0, &scene.camera, &scene.settings, only_green, &d);
    for (GaussianFieldId id = 0; id < FIELD_COUNT; id++)
        for (int k = 0; k < GAUSSIAN_FIELDS[id].width; k++) support_near(d.field[id][k], 0, 0, "green");
    reference_colour_backward(&scene.model, 0, &scene.camera, &scene.settings, only_red, &d);
    assert_true(d.field[FIELD_SH0][0] != 0 && d.field[FIELD_MEAN][0] != 0);
    gaussiansd_destroy(&d);
    gaussiansd_destroy(&scene.model);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_basis_is_orthonormal_on_the_sphere),
        cmocka_unit_test(the_basis_has_the_usual_order_and_signs),
        cmocka_unit_test(a_lower_degree_is_the_beginning_of_a_higher_one),
        cmocka_unit_test(the_jacobian_of_the_basis_agrees_with_central_differences),
        cmocka_unit_test(the_gradient_of_the_colour_reaches_coefficients_and_mean),
        cmocka_unit_test(degree_0_looks_the_same_from_everywhere),
        cmocka_unit_test(a_channel_below_0_is_black_and_has_no_gradient),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
