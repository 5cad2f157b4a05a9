// ewa_error.c - moments of projected points, in two passes.
#include "splat3d/ewa_error.h"

#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/base/rng.h"

#include <math.h>

static const double FIELD_OF_VIEW_RAD = 160 * M_PI / 180; // of the standard case

// ---- points ----

// The 24 images of a point under sign changes and cyclic order.
static void images_of(Vec3 p, Vec3 images[EWA_GROUP]) {
    for (int i = 0; i < EWA_GROUP; i++) {
        Vec3 q = vec3(i & 1 ? -p.x : p.x, i & 2 ? -p.y : p.y, i & 4 ? -p.z : p.z);
        images[i] = i < 8 ? q : i < 16 ? vec3(q.y, q.z, q.x) : vec3(q.z, q.x, q.y);
    }
}

EwaCloud ewa_cloud_create(int count, uint64_t seed) {
    int groups = (count + EWA_GROUP - 1) / EWA_GROUP;
    EwaCloud cloud = {.count = groups * EWA_GROUP};
    cloud.points = mem_alloc((size_t)cloud.count, sizeof *cloud.points);
    Rng rng = rng_at(seed, RNG_EWA_CLOUD, 0, 0);
    for (int i = 0; i < groups; i++) {
        Vec3 p;
        do p = vec3(rng_normal(&rng), rng_normal(&rng), rng_normal(&rng));
        while (vec3_dot(p, p) > EWA_CUT * EWA_CUT);
        images_of(p, cloud.points + (size_t)i * EWA_GROUP);
        cloud.variance += vec3_dot(p, p) / 3 / groups;
    }
    return cloud;
}

void ewa_cloud_destroy(EwaCloud *cloud) {
    mem_free(cloud->points);
    *cloud = (EwaCloud){0};
}

// E[|p|^2 / 3 given |p| < k] = P5(k^2) / P3(k^2), with Pn the distribution of chi squared with n degrees of freedom;
// P3(k^2) = erf(k / sqrt 2) - sqrt(2 / pi) k exp(-k^2 / 2), and P5 is smaller by k^2 / 3 times that last term.
double ewa_cut_factor(double k) {
    double tail = sqrt(2 / M_PI) * k * exp(-k * k / 2), inside = erf(k / M_SQRT2) - tail;
    return 1 - tail * k * k / 3 / inside;
}

// ---- moments ----

// The matrix that makes a point of the splat of one of the unit Gaussian: R S.
static Mat3 stretch_of(const GaussiansD *g, int i) {
    Mat3 m = reference_rotation_forward(gaussiansd_at(g, FIELD_QUAT, i));
    const double *log_scale = gaussiansd_at(g, FIELD_LOG_SCALE, i);
    for (int k = 0; k < 9; k++) m.m[k] *= exp(log_scale[k % 3]);
    return m;
}

static bool throw_points(const EwaCloud *cloud, const GaussiansD *g, int i, const Camera *camera, double *pixels) {
    Mat3 stretch = stretch_of(g, i);
    const double *mean = gaussiansd_at(g, FIELD_MEAN, i);
    double depth;
    for (int k = 0; k < cloud->count; k++) {
        Vec3 p = vec3_add(vec3(mean[0], mean[1], mean[2]), mat3_apply(&stretch, cloud->points[k]));
        if (!camera_project(camera, p, &pixels[2 * k], &pixels[2 * k + 1], &depth))
            return fail("splat %d reaches behind the camera within %g standard deviations; its picture has no moments",
                        i, EWA_CUT);
    }
    return true;
}

static void moments(const double *pixels, const EwaCloud *cloud, EwaError *error) {
    int count = cloud->count;
    double x = 0, y = 0, xx = 0, xy = 0, yy = 0;
    for (int k = 0; k < count; k++) x += pixels[2 * k], y += pixels[2 * k + 1];
    error->mean_px[0] = x / count, error->mean_px[1] = y / count;
    for (int k = 0; k < count; k++) {
        double dx = pixels[2 * k] - error->mean_px[0], dy = pixels[2 * k + 1] - error->mean_px[1];
        xx += dx * dx, xy += dx * dy, yy += dy * dy;
    }
    double n = count * cloud->variance;
    error->covariance = (Sym2){xx / n, xy / n, yy / n};
}

static double skew_along(const double *pixels, int count, const double mean_px[2], double angle_rad) {
    double c = cos(angle_rad), s = sin(angle_rad), second = 0, third = 0;
    for (int k = 0; k < count; k++) {
        double d = c * (pixels[2 * k] - mean_px[0]) + s * (pixels[2 * k + 1] - mean_px[1]);
        second += d * d / count, third += d * d * d / count;
    }
    return third / pow(second, 1.5);
}

static void compare(EwaError *error) {
    Sym2 ewa = error->splat.covariance, conic = error->splat.conic, is = error->covariance;
    double dx = error->mean_px[0] - error->splat.mean_px[0], dy = error->mean_px[1] - error->splat.mean_px[1];
    error->shift = sqrt(conic_mahalanobis2(conic, dx, dy));
    Sym2 difference = {is.xx - ewa.xx, is.xy - ewa.xy, is.yy - ewa.yy};
    error->covariance_error = sym2_length(difference) / sym2_length(ewa);
}

bool ewa_error_measure(const EwaCloud *cloud, const GaussiansD *g, int i, const Camera *camera, EwaError *error) {
    RenderSettings settings = render_settings_default();
    settings.low_pass_px2 = 0;
    *error = (EwaError){0};
    reference_project_forward(g, i, camera, &settings, &error->splat);
    if (!error->splat.visible) return fail("splat %d is not visible to this camera", i);
    double *pixels = mem_alloc((size_t)cloud->count * 2, sizeof *pixels);
    bool good = throw_points(cloud, g, i, camera, pixels);
    if (good) {
        moments(pixels, cloud, error);
        compare(error);
        double longer_rad = sym2_eigen(error->splat.covariance).angle_rad;
        error->skew = skew_along(pixels, cloud->count, error->mean_px, longer_rad);
    }
    mem_free(pixels);
    return good;
}

// ---- the standard case ----

GaussiansD ewa_ball(double angle_rad, double ratio, double focal_px, Camera *camera) {
    int side = 2 * (int)ceil(focal_px * tan(FIELD_OF_VIEW_RAD / 2));
    *camera = (Camera){.width = side,
                       .height = side,
                       .fx = focal_px,
                       .fy = focal_px,
                       .cx = side / 2.0,
                       .cy = side / 2.0,
                       .rotation = {{1, 0, 0, 0, 1, 0, 0, 0, 1}}};
    GaussiansD g = gaussiansd_create(1, 0);
    double *mean = gaussiansd_at(&g, FIELD_MEAN, 0), *log_scale = gaussiansd_at(&g, FIELD_LOG_SCALE, 0);
    mean[0] = tan(angle_rad), mean[2] = 1;
    for (int k = 0; k < 3; k++) log_scale[k] = log(ratio);
    *gaussiansd_at(&g, FIELD_QUAT, 0) = 1;
    return g;
}

bool ewa_error_of_ball(const EwaCloud *cloud, double angle_rad, double ratio, double focal_px, EwaError *error) {
    Camera camera;
    GaussiansD g = ewa_ball(angle_rad, ratio, focal_px, &camera);
    bool good = ewa_error_measure(cloud, &g, 0, &camera, error);
    gaussiansd_destroy(&g);
    return good;
}
