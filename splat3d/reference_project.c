// reference_project.c - one splat onto the screen, and its gradients.
//
// The EWA projection (Zwicker et al. 2001, "EWA volume splatting"; Kerbl et al. 2023, eq. 5):
//
//     (1) c = W p + t                                   the mean in the camera, c = (x, y, z); W is the rotation
//     (2) mean_px = (fx x / z + cx, fy y / z + cy)
//     (3) u = clamp(x / z), v = clamp(y / z)            to a little more than the picture, see frustum()
//     (4) j_x = (fx / z, 0, -fx u / z)                  the rows of J: how the pixel moves with the camera point;
//         j_y = (0, fy / z, -fy v / z)                  this is d(2) / d c, taken at the clamped point
//     (5) t_x = W^T j_x, t_y = W^T j_y                  the rows of J W: how it moves with the world point
//     (6) Sigma' = [t_x . Sigma t_x, t_x . Sigma t_y, t_y . Sigma t_y] + low pass on the diagonal
//
// A perspective picture of an ellipsoid is not quite an ellipse; (6) takes the projection as the linear map it is near
// the mean. That goes wrong far outside of the picture, where J grows without bound and a splat would smear over
// everything: hence the clamp in (3). The mean itself is never clamped.
// The gradients follow line by line from the last to the first (derivations: Ye et al. 2024, "gsplat", appendix).
#include "splat3d/reference.h"

typedef struct {
    double low, high;
} Interval;

// The values of (3) that are left as they are: from the left edge of the picture to the right, and FRUSTUM_MARGIN
// times half its width beyond them on both sides. Likewise for y with height, fy, cy.
static Interval frustum(double size_px, double focal_px, double centre_px) {
    double beyond = FRUSTUM_MARGIN * size_px / 2;
    return (Interval){(-centre_px - beyond) / focal_px, (size_px - centre_px + beyond) / focal_px};
}

static double clamp(double value, Interval to) { return fmin(fmax(value, to.low), to.high); }
static bool inside(double value, Interval of) { return of.low <= value && value <= of.high; }

static Vec3 sym3_apply(Sym3 a, Vec3 v) {
    return vec3(a.xx * v.x + a.xy * v.y + a.xz * v.z, a.xy * v.x + a.yy * v.y + a.yz * v.z,
                a.xz * v.x + a.yz * v.y + a.zz * v.z);
}

// (5) from (3) and (4).
typedef struct {
    Vec3 t_x, t_y; // rows of J W, px per world unit
} EwaMap;

static EwaMap ewa_map_forward(const Camera *camera, Vec3 c) {
    double u = clamp(c.x / c.z, frustum(camera->width, camera->fx, camera->cx));
    double v = clamp(c.y / c.z, frustum(camera->height, camera->fy, camera->cy));
    Vec3 j_x = vec3(camera->fx / c.z, 0, -camera->fx * u / c.z);
    Vec3 j_y = vec3(0, camera->fy / c.z, -camera->fy * v / c.z);
    Mat3 to_world = mat3_transpose(&camera->rotation);
    return (EwaMap){mat3_apply(&to_world, j_x), mat3_apply(&to_world, j_y)};
}

// Returns the gradient by c. With u and z as the variables of (4), d j_x.z / d z = fx u / z^2; u itself depends on x
// and z where it is not clamped: d u / d x = 1 / z, d u / d z = -u / z.
static Vec3 ewa_map_backward(const Camera *camera, Vec3 c, EwaMap d_map) {
    Interval range_x = frustum(camera->width, camera->fx, camera->cx);
    Interval range_y = frustum(camera->height, camera->fy, camera->cy);
    double u = clamp(c.x / c.z, range_x), v = clamp(c.y / c.z, range_y);
    Vec3 d_j_x = mat3_apply(&camera->rotation, d_map.t_x);
    Vec3 d_j_y = mat3_apply(&camera->rotation, d_map.t_y);

    double d_u = -camera->fx / c.z * d_j_x.z;
    double d_v = -camera->fy / c.z * d_j_y.z;
    Vec3 d_c = {0};
    d_c.z = camera->fx / (c.z * c.z) * (u * d_j_x.z - d_j_x.x) + camera->fy / (c.z * c.z) * (v * d_j_y.z - d_j_y.y);
    if (inside(c.x / c.z, range_x)) d_c.x += d_u / c.z, d_c.z -= d_u * u / c.z;
    if (inside(c.y / c.z, range_y)) d_c.y += d_v / c.z, d_c.z -= d_v * v / c.z;
    return d_c;
}

// (6) without the low pass.
static Sym2 ewa_covariance_forward(EwaMap map, Sym3 sigma) {
    Vec3 sigma_t_x = sym3_apply(sigma, map.t_x), sigma_t_y = sym3_apply(sigma, map.t_y);
    return (Sym2){vec3_dot(map.t_x, sigma_t_x), vec3_dot(map.t_x, sigma_t_y), vec3_dot(map.t_y, sigma_t_y)};
}

// Sigma is symmetric, so t_x . Sigma t_x moves with t_x by 2 Sigma t_x, and t_x . Sigma t_y by Sigma t_y with t_x and
// by Sigma t_x with t_y. A stored off-diagonal number of Sigma stands for two entries, hence its two products of t's.
// Sets *d_map, and adds to *d_sigma.
static void ewa_covariance_backward(EwaMap map, Sym3 sigma, Sym2 d, EwaMap *d_map, Sym3 *d_sigma) {
    Vec3 x = map.t_x, y = map.t_y;
    Vec3 sigma_x = sym3_apply(sigma, x), sigma_y = sym3_apply(sigma, y);
    d_map->t_x = vec3_add(vec3_scale(sigma_x, 2 * d.xx), vec3_scale(sigma_y, d.xy));
    d_map->t_y = vec3_add(vec3_scale(sigma_x, d.xy), vec3_scale(sigma_y, 2 * d.yy));
    d_sigma->xx += d.xx * x.x * x.x + d.xy * x.x * y.x + d.yy * y.x * y.x;
    d_sigma->yy += d.xx * x.y * x.y + d.xy * x.y * y.y + d.yy * y.y * y.y;
    d_sigma->zz += d.xx * x.z * x.z + d.xy * x.z * y.z + d.yy * y.z * y.z;
    d_sigma->xy += 2 * d.xx * x.x * x.y + d.xy * (x.x * y.y + x.y * y.x) + 2 * d.yy * y.x * y.y;
    d_sigma->xz += 2 * d.xx * x.x * x.z + d.xy * (x.x * y.z + x.z * y.x) + 2 * d.yy * y.x * y.z;
    d_sigma->yz += 2 * d.xx * x.y * x.z + d.xy * (x.y * y.z + x.z * y.y) + 2 * d.yy * y.y * y.z;
}

Sym2 reference_ewa_forward(const Camera *camera, Vec3 mean_cam, Sym3 covariance) {
    return ewa_covariance_forward(ewa_map_forward(camera, mean_cam), covariance);
}

void reference_ewa_backward(const Camera *camera, Vec3 mean_cam, Sym3 covariance, Sym2 d_projected, Vec3 *d_mean_cam,
                            Sym3 *d_covariance) {
    EwaMap d_map;
    ewa_covariance_backward(ewa_map_forward(camera, mean_cam), covariance, d_projected, &d_map, d_covariance);
    *d_mean_cam = vec3_add(*d_mean_cam, ewa_map_backward(camera, mean_cam, d_map));
}

static Vec3 mean_of(const GaussiansD *g, int i) {
    const double *mean = gaussiansd_at(g, FIELD_MEAN, i);
    return vec3(mean[0], mean[1], mean[2]);
}

static double sigmoid(double logit) { return 1 / (1 + exp(-logit)); }

// alpha = opacity exp(-m^2 / 2) >= ALPHA_MIN holds within m^2 <= 2 ln(opacity / ALPHA_MIN). False when nowhere on the
// picture.
static bool reaches_picture(Splat2 *splat, const Camera *camera) {
    if (!(splat->opacity > (double)ALPHA_MIN)) return false;
    double k = sqrt(2 * log(splat->opacity / (double)ALPHA_MIN));
    covariance_box(splat->covariance, k, &splat->reach_px[0], &splat->reach_px[1]);
    double x = splat->mean_px[0], y = splat->mean_px[1];
    return x + splat->reach_px[0] > 0 && x - splat->reach_px[0] < camera->width && //
           y + splat->reach_px[1] > 0 && y - splat->reach_px[1] < camera->height;
}

void reference_project_forward(const GaussiansD *g, int i, const Camera *camera, const RenderSettings *settings,
                               Splat2 *splat) {
    *splat = (Splat2){0};
    Vec3 c = camera_point(camera, mean_of(g, i)); // (1)
    if (!(c.z >= (double)settings->near_depth && c.z > 0)) return;

    Splat2 s = {.visible = true, .depth = c.z};
    s.mean_px[0] = camera->fx * c.x / c.z + camera->cx; // (2)
    s.mean_px[1] = camera->fy * c.y / c.z + camera->cy;
    Sym3 sigma = reference_covariance_forward(gaussiansd_at(g, FIELD_LOG_SCALE, i), gaussiansd_at(g, FIELD_QUAT, i));
    s.covariance = sym2_add_diagonal(reference_ewa_forward(camera, c, sigma), (double)settings->low_pass_px2);
    s.opacity = sigmoid(*gaussiansd_at(g, FIELD_OPACITY_LOGIT, i));
    if (!covariance_conic(s.covariance, &s.conic) || !reaches_picture(&s, camera)) return;

    if (settings->what == RENDER_DEPTH)
        s.rgb[0] = s.depth, s.rgb[1] = 1;
    else
        reference_colour_forward(g, i, camera, settings, s.rgb);
    *splat = s;
}

void reference_project_backward(const GaussiansD *g, int i, const Camera *camera, const RenderSettings *settings,
                                const Splat2Gradient *d_splat, GaussiansD *d_model) {
    Splat2 splat;
    reference_project_forward(g, i, camera, settings, &splat);
    if (!splat.visible) return;
    const double *log_scale = gaussiansd_at(g, FIELD_LOG_SCALE, i), *quat = gaussiansd_at(g, FIELD_QUAT, i);
    Vec3 c = camera_point(camera, mean_of(g, i));

    // The shape: conic, Sigma', then Sigma and J W.
    Sym3 sigma = reference_covariance_forward(log_scale, quat), d_sigma = {0};
    Sym2 d_covariance = covariance_conic_backward(splat.conic, d_splat->conic);
    Vec3 d_c = {0};
    reference_ewa_backward(camera, c, sigma, d_covariance, &d_c, &d_sigma);
    reference_covariance_backward(log_scale, quat, d_sigma, gaussiansd_at(d_model, FIELD_LOG_SCALE, i),
                                  gaussiansd_at(d_model, FIELD_QUAT, i));

    // The mean: through J (above), through (2), and as the depth that RENDER_DEPTH shows.
    double d_x = camera->fx / c.z * d_splat->mean_px[0], d_y = camera->fy / c.z * d_splat->mean_px[1];
    d_c = vec3_add(d_c, vec3(d_x, d_y, -(d_x * c.x + d_y * c.y) / c.z));
    if (settings->what == RENDER_DEPTH) d_c.z += d_splat->rgb[0];
    Mat3 to_world = mat3_transpose(&camera->rotation);
    Vec3 d_p = mat3_apply(&to_world, d_c);
    double *d_mean = gaussiansd_at(d_model, FIELD_MEAN, i);
    d_mean[0] += d_p.x, d_mean[1] += d_p.y, d_mean[2] += d_p.z;

    *gaussiansd_at(d_model, FIELD_OPACITY_LOGIT, i) += splat.opacity * (1 - splat.opacity) * d_splat->opacity;
    if (settings->what == RENDER_COLOUR) reference_colour_backward(g, i, camera, settings, d_splat->rgb, d_model);
}
