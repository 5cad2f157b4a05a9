#include "exercises/harness/sphere.h"

#include "lab/base/rng.h"
#include "splat3d/reference.h"
#include "tests/support/support.h"

#include <gsl/gsl_integration.h>
#include <gsl/gsl_sf_gamma.h>
#include <gsl/gsl_sf_legendre.h>
#include <math.h>

static void the_rings_are_those_of_gauss_and_legendre(void **state) {
    (void)state;
    gsl_integration_glfixed_table *table = gsl_integration_glfixed_table_alloc(SPHERE_RINGS);
    for (int ring = 0; ring < SPHERE_RINGS; ring++) {
        double z, weight;
        gsl_integration_glfixed_point(-1, 1, (size_t)ring, &z, &weight, table);
        SphereNode node = sphere_node(ring * SPHERE_STEPS + 3);
        support_near(node.direction.z, z, 1e-15, "z");
        support_near(node.weight, weight * 2 * M_PI / SPHERE_STEPS, 1e-15, "weight");
        support_near(vec3_length(node.direction), 1, 1e-15, "length");
    }
    gsl_integration_glfixed_table_free(table);
}

// The integral of x^a y^b z^c over the sphere is 2 times a product of gamma functions, and 0 where an exponent is odd.
static double monomial_integral(int a, int b, int c) {
    if (a % 2 || b % 2 || c % 2) return 0;
    return 2 * gsl_sf_gamma((a + 1) / 2.0) * gsl_sf_gamma((b + 1) / 2.0) * gsl_sf_gamma((c + 1) / 2.0) /
           gsl_sf_gamma((a + b + c + 3) / 2.0);
}

static void polynomials_of_degree_7_are_integrated_exactly(void **state) {
    (void)state;
    for (int a = 0; a <= 7; a++)
        for (int b = 0; a + b <= 7; b++)
            for (int c = 0; a + b + c <= 7; c++) {
                double sum = 0;
                for (int i = 0; i < SPHERE_NODES; i++) {
                    SphereNode node = sphere_node(i);
                    Vec3 d = node.direction;
                    sum += node.weight * pow(d.x, a) * pow(d.y, b) * pow(d.z, c);
                }
                support_near(sum, monomial_integral(a, b, c), 1e-14, "integral of x^a y^b z^c");
            }
}

static void basis_at(Vec3 d, double basis[SH_COEFFICIENTS_MAX]) {
    reference_sh_basis(SH_DEGREE_MAX, (const double[3]){d.x, d.y, d.z}, basis);
}

// What the rung `orthonormal` of exercise 12 asks for is true of the house's own harmonics.
static void the_harmonics_are_orthonormal_by_these_nodes(void **state) {
    (void)state;
    double product[SH_COEFFICIENTS_MAX][SH_COEFFICIENTS_MAX] = {0};
    for (int n = 0; n < SPHERE_NODES; n++) {
        SphereNode node = sphere_node(n);
        double basis[SH_COEFFICIENTS_MAX];
        basis_at(node.direction, basis);
        for (int i = 0; i < SH_COEFFICIENTS_MAX; i++)
            for (int j = 0; j < SH_COEFFICIENTS_MAX; j++) product[i][j] += node.weight * basis[i] * basis[j];
    }
    for (int i = 0; i < SH_COEFFICIENTS_MAX; i++)
        for (int j = 0; j < SH_COEFFICIENTS_MAX; j++) support_near(product[i][j], i == j, 1e-14, "integral of Y_i Y_j");
}

// And so is the addition theorem of the rung `bands`, with GSL's Legendre polynomials.
static void a_band_knows_only_the_angle_between_two_directions(void **state) {
    (void)state;
    Rng rng = rng_at(5, RNG_TEST, 0, 0);
    for (int n = 0; n < 100; n++) {
        Vec3 a = vec3_normalize(vec3(rng_normal(&rng), rng_normal(&rng), rng_normal(&rng)));
        Vec3 b = vec3_normalize(vec3(rng_normal(&rng), rng_normal(&rng), rng_normal(&rng)));
        double Y_a[SH_COEFFICIENTS_MAX], Y_b[SH_COEFFICIENTS_MAX];
        basis_at(a, Y_a);
        basis_at(b, Y_b);
        for (int l = 0; l <= SH_DEGREE_MAX; l++) {
            double sum = 0, cosine = fmax(-1, fmin(1, vec3_dot(a, b)));
            for (int i = l * l; i < (l + 1) * (l + 1); i++) sum += Y_a[i] * Y_b[i];
            support_near(sum, (2 * l + 1) / (4 * M_PI) * gsl_sf_legendre_Pl(l, cosine), 1e-14, "sum over a band");
        }
    }
}

static void the_globe_is_seen_from_its_near_side(void **state) {
    (void)state;
    enum { SIDE = 11 };
    Vec3 d;
    assert_true(sphere_globe(SIDE, 5, 5, &d));
    support_near(d.z, 1, 1e-15, "middle");
    assert_false(sphere_globe(SIDE, 0, 0, &d));
    for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++)
            if (sphere_globe(SIDE, x, y, &d)) {
                support_near(vec3_length(d), 1, 1e-15, "length");
                assert_true(d.z > 0 && (d.x > 0) == (x > 5) && (d.y > 0) == (y > 5));
            }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_rings_are_those_of_gauss_and_legendre),
        cmocka_unit_test(polynomials_of_degree_7_are_integrated_exactly),
        cmocka_unit_test(the_harmonics_are_orthonormal_by_these_nodes),
        cmocka_unit_test(a_band_knows_only_the_angle_between_two_directions),
        cmocka_unit_test(the_globe_is_seen_from_its_near_side),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
