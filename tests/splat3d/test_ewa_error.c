#include "splat3d/ewa_error.h"

#include "lab/base/fail.h"
#include "tests/support/support.h"

#include <gsl/gsl_integration.h>
#include <gsl/gsl_sf_gamma.h>
#include <math.h>
#include <string.h>

enum { POINTS = 400000 };
static const double FOCAL_PX = 300;

static EwaCloud cloud;

static int make_cloud(void **state) {
    (void)state;
    cloud = ewa_cloud_create(POINTS, 1);
    return 0;
}

static int drop_cloud(void **state) {
    (void)state;
    ewa_cloud_destroy(&cloud);
    return 0;
}

static EwaError ball(double angle_deg, double ratio) {
    EwaError error;
    assert_true(ewa_error_of_ball(&cloud, angle_deg * M_PI / 180, ratio, FOCAL_PX, &error));
    return error;
}

static void the_cut_takes_from_the_variance_what_chi_squared_says(void **state) {
    (void)state;
    for (double k = 0.5; k < 8; k += 0.25) {
        double expected = gsl_sf_gamma_inc_P(2.5, k * k / 2) / gsl_sf_gamma_inc_P(1.5, k * k / 2);
        support_near(ewa_cut_factor(k), expected, 1e-10, "cut factor");
    }
    support_near(cloud.variance, ewa_cut_factor(EWA_CUT), 0.02, "variance of the cloud"); // 16,667 free points
}

static void the_cloud_lies_within_the_cut_and_has_no_chance_in_its_first_two_moments(void **state) {
    (void)state;
    EwaCloud odd = ewa_cloud_create(25, 3);
    assert_int_equal(odd.count, 48);
    ewa_cloud_destroy(&odd);
    ewa_cloud_destroy(&odd);
    double sum[9] = {0};
    for (int i = 0; i < cloud.count; i++) {
        Vec3 p = cloud.points[i];
        assert_true(vec3_length(p) <= EWA_CUT * (1 + 1e-15));
        const double moments[9] = {p.x, p.y, p.z, p.x * p.y, p.x * p.z, p.y * p.z, p.x * p.x, p.y * p.y, p.z * p.z};
        for (int k = 0; k < 9; k++) sum[k] += moments[k] / cloud.count;
    }
    for (int k = 0; k < 9; k++) support_near(sum[k], k < 6 ? 0 : cloud.variance, 1e-11, "moment");
}

static void far_away_the_camera_is_linear_and_ewa_is_right(void **state) {
    (void)state;
    EwaError error;
    assert_true(ewa_error_of_ball(&cloud, 0.9, 1e-6, FOCAL_PX, &error));
    support_near(error.covariance_error, 0, 1e-9, "covariance error");
    support_near(error.shift, 0, 1e-5, "shift");
}

// On the axis: u = f a / (1 + r b), the variance of which over the cut ball is an integral over b alone.
static double variance_integrand(double b, void *parameters) {
    double ratio = *(double *)parameters, free = EWA_CUT * EWA_CUT - b * b; // a^2 + c^2 < free
    double over_disc = 1 - exp(-free / 2) * (1 + free / 2);                 // E[a^2; in the disc], two dimensions
    return exp(-b * b / 2) / sqrt(2 * M_PI) * over_disc / pow(1 + ratio * b, 2);
}

static double variance_on_axis(double ratio) {
    double result, error;
    gsl_function function = {variance_integrand, &ratio};
    gsl_integration_workspace *work = gsl_integration_workspace_alloc(200);
    gsl_integration_qag(&function, -EWA_CUT, EWA_CUT, 1e-12, 1e-10, 200, GSL_INTEG_GAUSS61, work, &result, &error);
    gsl_integration_workspace_free(work);
    double mass = gsl_sf_gamma_inc_P(1.5, EWA_CUT * EWA_CUT / 2);
    return result / mass / ewa_cut_factor(EWA_CUT);
}

static void on_the_axis_the_variance_is_that_of_an_integral(void **state) {
    (void)state;
    for (int i = 1; i <= 5; i++) {
        double ratio = 0.05 * i;
        EwaError error = ball(0, ratio);
        double sigma2 = pow(FOCAL_PX * ratio, 2), expected = variance_on_axis(ratio);
        support_near(error.covariance.xx / sigma2, expected, 0.012 * expected, "variance on the axis");
        support_near(error.splat.covariance.xx / sigma2, 1, 1e-12, "EWA");
        support_near(error.shift, 0, 1e-12, "no shift on the axis");
    }
}

static void a_ball_off_the_axis_is_an_ellipse_by_ewa(void **state) {
    (void)state;
    for (double angle = 0; angle < 75; angle += 15) {
        Sym2 s = ball(angle, 0.1).splat.covariance;
        support_near(sqrt(s.xx), FOCAL_PX * 0.1 / cos(angle * M_PI / 180), 1e-9, "radial");
        support_near(sqrt(s.yy), FOCAL_PX * 0.1, 1e-9, "tangential");
    }
}

static double slope(double low, double high, double ratio) { return log(high / low) / log(ratio); }

static void the_shift_grows_as_r_and_the_covariance_error_as_r_squared(void **state) {
    (void)state;
    for (double angle = 30; angle <= 60; angle += 15) {
        EwaError few = ball(angle, 0.02), many = ball(angle, 0.08);
        support_near(slope(few.shift, many.shift, 4), 1, 0.03, "order of the shift");
        support_near(slope(few.covariance_error, many.covariance_error, 4), 2, 0.06, "order of the covariance error");
        double predicted = 0.02 * sin(angle * M_PI / 180) * ewa_cut_factor(EWA_CUT);
        support_near(few.shift / predicted, 1, 0.02, "r sin(theta), cut");
        assert_true(many.skew > few.skew && few.skew > 0);
    }
}

static void the_focal_length_does_not_matter(void **state) {
    (void)state;
    EwaError near, far;
    assert_true(ewa_error_of_ball(&cloud, 0.7, 0.15, 100, &near));
    assert_true(ewa_error_of_ball(&cloud, 0.7, 0.15, 5000, &far));
    support_near(near.shift, far.shift, 1e-9, "shift");
    support_near(near.covariance_error, far.covariance_error, 1e-9, "covariance error");
}

static void a_stretched_and_turned_splat_is_measured_like_a_ball(void **state) {
    (void)state;
    Camera camera;
    EwaError error;
    GaussiansD g = ewa_ball(0.4, 0.01, FOCAL_PX, &camera);
    double *log_scale = gaussiansd_at(&g, FIELD_LOG_SCALE, 0), *quat = gaussiansd_at(&g, FIELD_QUAT, 0);
    log_scale[0] += 1, log_scale[1] -= 1;
    quat[1] = 0.5, quat[2] = -0.3, quat[3] = 0.8;
    assert_true(ewa_error_measure(&cloud, &g, 0, &camera, &error));
    assert_true(error.covariance_error < 0.01); // small against its distance: EWA holds, whatever the shape
    gaussiansd_destroy(&g);
}

static void what_reaches_behind_the_camera_has_no_moments(void **state) {
    (void)state;
    EwaError error;
    assert_false(ewa_error_of_ball(&cloud, 0, 0.4, FOCAL_PX, &error));
    assert_non_null(strstr(fail_text(), "behind the camera"));
    Camera camera;
    GaussiansD g = ewa_ball(0, 0.1, FOCAL_PX, &camera);
    gaussiansd_at(&g, FIELD_MEAN, 0)[2] = -1;
    assert_false(ewa_error_measure(&cloud, &g, 0, &camera, &error));
    assert_non_null(strstr(fail_text(), "not visible"));
    gaussiansd_destroy(&g);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_cut_takes_from_the_variance_what_chi_squared_says),
        cmocka_unit_test(the_cloud_lies_within_the_cut_and_has_no_chance_in_its_first_two_moments),
        cmocka_unit_test(far_away_the_camera_is_linear_and_ewa_is_right),
        cmocka_unit_test(on_the_axis_the_variance_is_that_of_an_integral),
        cmocka_unit_test(a_ball_off_the_axis_is_an_ellipse_by_ewa),
        cmocka_unit_test(the_shift_grows_as_r_and_the_covariance_error_as_r_squared),
        cmocka_unit_test(the_focal_length_does_not_matter),
        cmocka_unit_test(a_stretched_and_turned_splat_is_measured_like_a_ball),
        cmocka_unit_test(what_reaches_behind_the_camera_has_no_moments),
    };
    return cmocka_run_group_tests(tests, make_cloud, drop_cloud);
}
