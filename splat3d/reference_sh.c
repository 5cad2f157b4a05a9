// reference_sh.c - view-dependent colour, and its gradients.
//
// Real spherical harmonics of degree 0 to 3, as polynomials in the direction (Sloan 2008, "Stupid
// spherical harmonics tricks", appendix A2; with the sign (-1)^m, as all 3D Gaussian Splatting files have it).
//
// Each is a homogeneous polynomial of its degree times a factor k, such that the integral of Y_i Y_j over the sphere is
// 1 for i = j and else 0. Order: degree l at l^2 .. (l + 1)^2 - 1, in it m = -l .. l.
#include "splat3d/reference.h"

typedef struct {
    double value, gradient[3];
} Harmonic;

// k times a polynomial, given by its value and its gradient (dx, dy, dz).
static Harmonic harmonic(double k, double value, double dx, double dy, double dz) {
    return (Harmonic){.value = k * value, .gradient = {k * dx, k * dy, k * dz}};
}

static void harmonics(int degree, const double d[3], Harmonic y_of[SH_COEFFICIENTS_MAX]) {
    double x = d[0], y = d[1], z = d[2], xx = x * x, yy = y * y, zz = z * z;
    y_of[0] = harmonic(sqrt(1 / (4 * M_PI)), 1, 0, 0, 0);
    if (degree < 1) return;

    double k1 = sqrt(3 / (4 * M_PI));
    y_of[1] = harmonic(-k1, y, 0, 1, 0);
    y_of[2] = harmonic(k1, z, 0, 0, 1);
    y_of[3] = harmonic(-k1, x, 1, 0, 0);
    if (degree < 2) return;

    double k2 = sqrt(15 / (4 * M_PI)), k20 = sqrt(5 / (16 * M_PI));
    y_of[4] = harmonic(k2, x * y, y, x, 0);
    y_of[5] = harmonic(-k2, y * z, 0, z, y);
    y_of[6] = harmonic(k20, 2 * zz - xx - yy, -2 * x, -2 * y, 4 * z);
    y_of[7] = harmonic(-k2, x * z, z, 0, x);
    y_of[8] = harmonic(k2 / 2, xx - yy, 2 * x, -2 * y, 0);
    if (degree < 3) return;

    double k30 = sqrt(7 / (16 * M_PI)), k31 = sqrt(21 / (32 * M_PI)), k32 = sqrt(105 / (4 * M_PI));
    double k33 = sqrt(35 / (32 * M_PI));
    y_of[9] = harmonic(-k33, y * (3 * xx - yy), 6 * x * y, 3 * xx - 3 * yy, 0);
    y_of[10] = harmonic(k32, x * y * z, y * z, x * z, x * y);
    y_of[11] = harmonic(-k31, y * (4 * zz - xx - yy), -2 * x * y, 4 * zz - xx - 3 * yy, 8 * y * z);
    y_of[12] = harmonic(k30, z * (2 * zz - 3 * xx - 3 * yy), -6 * x * z, -6 * y * z, 6 * zz - 3 * xx - 3 * yy);
    y_of[13] = harmonic(-k31, x * (4 * zz - xx - yy), 4 * zz - 3 * xx - yy, -2 * x * y, 8 * x * z);
    y_of[14] = harmonic(k32 / 2, z * (xx - yy), 2 * x * z, -2 * y * z, xx - yy);
    y_of[15] = harmonic(-k33, x * (xx - 3 * yy), 3 * xx - 3 * yy, -6 * x * y, 0);
}

static int coefficients_of(int degree) { return (degree + 1) * (degree + 1); }

void reference_sh_basis(int degree, const double d[3], double basis[SH_COEFFICIENTS_MAX]) {
    Harmonic y_of[SH_COEFFICIENTS_MAX];
    harmonics(degree, d, y_of);
    for (int k = 0; k < coefficients_of(degree); k++) basis[k] = y_of[k].value;
}

void reference_sh_basis_jacobian(int degree, const double d[3], double jacobian[SH_COEFFICIENTS_MAX][3]) {
    Harmonic y_of[SH_COEFFICIENTS_MAX];
    harmonics(degree, d, y_of);
    for (int k = 0; k < coefficients_of(degree); k++)
        for (int axis = 0; axis < 3; axis++) jacobian[k][axis] = y_of[k].gradient[axis];
}

// From the camera to splat i; length 1, and *distance.
static Vec3 view_direction(const GaussiansD *g, int i, const Camera *camera, double *distance) {
    const double *mean = gaussiansd_at(g, FIELD_MEAN, i);
    Vec3 ray = vec3_sub(vec3(mean[0], mean[1], mean[2]), camera_position(camera));
    *distance = vec3_length(ray);
    return vec3_normalize(ray);
}

static int degree_in_use(const GaussiansD *g, const RenderSettings *settings) {
    return settings->sh_degree < g->sh_degree ? settings->sh_degree : g->sh_degree;
}

// The three numbers (r g b) of coefficient k of splat i.
static double *coefficient(const GaussiansD *g, int i, int k) {
    int degree = (int)sqrt(k);
    return gaussiansd_at(g, FIELD_SH0 + degree, i) + 3 * (k - degree * degree);
}

// What stands before the clamp: 0.5 + sum_k Y_k coefficient_k.
static void unclamped_colour(const GaussiansD *g, int i, int degree, const Harmonic *y_of, double rgb[3]) {
    for (int c = 0; c < 3; c++) rgb[c] = 0.5;
    for (int k = 0; k < coefficients_of(degree); k++)
        for (int c = 0; c < 3; c++) rgb[c] += y_of[k].value * coefficient(g, i, k)[c];
}

void reference_colour_forward(const GaussiansD *g, int i, const Camera *camera, const RenderSettings *settings,
                              double rgb[3]) {
    int degree = degree_in_use(g, settings);
    double distance;
    Vec3 direction = view_direction(g, i, camera, &distance);
    Harmonic y_of[SH_COEFFICIENTS_MAX] = {0};
    harmonics(degree, (const double[3]){direction.x, direction.y, direction.z}, y_of);
    unclamped_colour(g, i, degree, y_of, rgb);
    for (int c = 0; c < 3; c++) rgb[c] = fmax(rgb[c], 0);
}

// A channel that was clamped passes no gradient. The direction is ray / |ray|; like every normalisation it passes on
// only the part across itself: d_ray = (d_direction - direction (direction . d_direction)) / |ray|.
void reference_colour_backward(const GaussiansD *g, int i, const Camera *camera, const RenderSettings *settings,
                               const double d_rgb[3], GaussiansD *d_model) {
    int degree = degree_in_use(g, settings);
    double distance, rgb[3];
    Vec3 direction = view_direction(g, i, camera, &distance), d_direction = {0};
    Harmonic y_of[SH_COEFFICIENTS_MAX] = {0};
    harmonics(degree, (const double[3]){direction.x, direction.y, direction.z}, y_of);
    unclamped_colour(g, i, degree, y_of, rgb);

    for (int k = 0; k < coefficients_of(degree); k++) {
        double d_value = 0; // by Y_k
        for (int c = 0; c < 3; c++) {
            if (rgb[c] < 0) continue;
            coefficient(d_model, i, k)[c] += y_of[k].value * d_rgb[c];
            d_value += coefficient(g, i, k)[c] * d_rgb[c];
        }
        const double *gradient = y_of[k].gradient;
        d_direction = vec3_add(d_direction, vec3_scale(vec3(gradient[0], gradient[1], gradient[2]), d_value));
    }

    Vec3 along = vec3_scale(direction, vec3_dot(direction, d_direction));
    Vec3 d_ray = vec3_scale(vec3_sub(d_direction, along), 1 / distance);
    double *d_mean = gaussiansd_at(d_model, FIELD_MEAN, i);
    d_mean[0] += d_ray.x, d_mean[1] += d_ray.y, d_mean[2] += d_ray.z;
}
