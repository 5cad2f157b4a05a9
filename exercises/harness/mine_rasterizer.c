// mine_rasterizer.c - all splats through one stage after the other, each stage one request; then row by row.
//
// It begins with the reference's splats. A stage that is the person's replaces its numbers in them, and what follows from those
// numbers is computed again.
#include "exercises/harness/mine_rasterizer.h"

#include "exercises/harness/hit_row.h"
#include "exercises/harness/mine_order.h"
#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/base/progress.h"
#include "splat3d/reference.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { CAM_NUMBERS = MINE_CAM_NUMBERS };

// The splats that the reference sees, and what the stages make of them.
typedef struct {
    Mine *mine;
    const GaussiansD *model;
    const Camera *camera;
    const RenderSettings *settings;
    int count;
    int *index;     // (count) in the model
    Splat2 *splats; // (count)
    double *cam;    // (count, 18): the same for each, as requests want it
} Stage;

// ---- the reference's splats ----

static void camera_numbers(const Camera *c, double cam[CAM_NUMBERS]) {
    const double head[6] = {c->width, c->height, c->fx, c->fy, c->cx, c->cy};
    memcpy(cam, head, sizeof head);
    memcpy(cam + 6, c->rotation.m, sizeof c->rotation.m);
    cam[15] = c->translation.x, cam[16] = c->translation.y, cam[17] = c->translation.z;
}

static void stage_begin(Stage *s) {
    int all = s->model->count;
    double cam[CAM_NUMBERS];
    s->index = mem_alloc((size_t)all, sizeof *s->index);
    s->splats = mem_alloc((size_t)all, sizeof *s->splats);
    for (int i = 0; i < all; i++) {
        reference_project_forward(s->model, i, s->camera, s->settings, &s->splats[s->count]);
        if (s->splats[s->count].visible) s->index[s->count++] = i;
    }
    s->cam = mem_alloc((size_t)s->count * CAM_NUMBERS, sizeof *s->cam);
    camera_numbers(s->camera, cam);
    for (int k = 0; k < s->count; k++) memcpy(s->cam + (size_t)k * CAM_NUMBERS, cam, sizeof cam);
}

static void stage_end(Stage *s) {
    mem_free(s->index);
    mem_free(s->splats);
    mem_free(s->cam);
}

// (count, width) of one field of the visible splats; owned by the caller.
static double *field_of(const Stage *s, GaussianFieldId id) {
    int width = GAUSSIAN_FIELDS[id].width;
    double *numbers = mem_alloc((size_t)s->count * (size_t)width, sizeof *numbers);
    for (int k = 0; k < s->count; k++)
        memcpy(numbers + (size_t)k * (size_t)width, gaussiansd_at(s->model, id, s->index[k]),
               (size_t)width * sizeof *numbers);
    return numbers;
}

static Vec3 mean_of(const Stage *s, int k) {
    const double *mean = gaussiansd_at(s->model, FIELD_MEAN, s->index[k]);
    return vec3(mean[0], mean[1], mean[2]);
}

// ---- stages ----

// A request for all splats, in parts of a bearable size.
static bool call_splats(Stage *s, MinePart part, const char *function, const Arg *args, int count) {
    enum { ARGS_MAX = 8 };
    int numbers = 0;
    for (int k = 0; k < count; k++) numbers += args[k].count;
    int at_once = mine_sets(numbers);
    for (int from = 0; from < s->count; from += at_once) {
        Arg some[ARGS_MAX];
        for (int k = 0; k < count; k++) {
            some[k] = args[k];
            some[k].numbers += (size_t)from * (size_t)args[k].count;
        }
        int sets = s->count - from < at_once ? s->count - from : at_once;
        if (!mine_call(s->mine, part, function, some, count, sets)) return false;
    }
    return true;
}

// E08, or the reference. (count, 6): xx xy xz yy yz zz; owned by the caller.
static double *covariances(Stage *s) {
    double *q = field_of(s, FIELD_QUAT), *logs = field_of(s, FIELD_LOG_SCALE);
    double *S = mem_alloc((size_t)s->count * 6, sizeof *S);
    const Arg args[] = {ARG_IN("q", q, 4), ARG_IN("logs", logs, 3), ARG_OUT("S", S, 6)};
    if (!call_splats(s, MINE_COV3, "cov3", args, 3))
        for (int k = 0; k < s->count; k++) {
            Sym3 a = reference_covariance_forward(logs + 3 * k, q + 4 * k);
            memcpy(S + 6 * k, (double[]){a.xx, a.xy, a.xz, a.yy, a.yz, a.zz}, 6 * sizeof *S);
        }
    mem_free(q);
    mem_free(logs);
    return S;
}

// E09: where the means fall. (What it does not see stays where the reference saw it.)
static void project(Stage *s) {
    double *p = field_of(s, FIELD_MEAN), *uv = mem_alloc((size_t)s->count * 4, sizeof *uv), *z = uv + 2 * s->count,
           *returned = uv + 3 * s->count;
    const Arg args[] = {ARG_IN("c", s->cam, CAM_NUMBERS), ARG_IN("p", p, 3), ARG_OUT("uv", uv, 2), ARG_OUT("z", z, 1),
                        ARG_OUT("returned", returned, 1)};
    bool is_mine = call_splats(s, MINE_CAMERA, "project", args, 5);
    for (int k = 0; is_mine && k < s->count; k++) {
        if (returned[k] == 0) continue;
        s->splats[k].mean_px[0] = uv[2 * k];
        s->splats[k].mean_px[1] = uv[2 * k + 1];
        s->splats[k].depth = z[k];
    }
    mem_free(p);
    mem_free(uv);
}

// E10, or the reference, of what E08 or the reference made.
static void flatten(Stage *s, double *S3) {
    double *t = mem_alloc((size_t)s->count * 6, sizeof *t), *S2 = t + 3 * s->count;
    for (int k = 0; k < s->count; k++) {
        Vec3 c = camera_point(s->camera, mean_of(s, k));
        memcpy(t + 3 * k, (double[]){c.x, c.y, c.z}, 3 * sizeof *t);
    }
    const Arg args[] = {ARG_IN("c", s->cam, CAM_NUMBERS), ARG_IN("t", t, 3), ARG_IN("S3", S3, 6), ARG_OUT("S2", S2, 3)};
    bool is_mine = call_splats(s, MINE_EWA, "cov2_project", args, 4);
    for (int k = 0; k < s->count; k++) {
        const double *a = S3 + 6 * k, *b = S2 + 3 * k;
        Sym3 shape = {a[0], a[1], a[2], a[3], a[4], a[5]};
        Sym2 flat = reference_ewa_forward(s->camera, vec3(t[3 * k], t[3 * k + 1], t[3 * k + 2]), shape);
        s->splats[k].covariance =
            is_mine ? (Sym2){b[0], b[1], b[2]} : sym2_add_diagonal(flat, (double)s->settings->low_pass_px2);
    }
    mem_free(t);
}

// E02: Sigma'^-1, or the reference's of what E10 made; and how far each splat reaches.
static void invert(Stage *s) {
    double *S = mem_alloc((size_t)s->count * 7, sizeof *S), *K = S + 3 * s->count, *returned = S + 6 * s->count;
    for (int k = 0; k < s->count; k++) {
        Sym2 a = s->splats[k].covariance;
        memcpy(S + 3 * k, (double[]){a.xx, a.xy, a.yy}, 3 * sizeof *S);
    }
    const Arg args[] = {ARG_IN("S", S, 3), ARG_OUT("K", K, 3), ARG_OUT("returned", returned, 1)};
    bool is_mine = call_splats(s, MINE_CONIC, "conic_from_cov2", args, 3);
    for (int k = 0; k < s->count; k++) {
        Splat2 *splat = &s->splats[k];
        if (is_mine)
            splat->conic = (Sym2){K[3 * k], K[3 * k + 1], K[3 * k + 2]}, splat->visible = returned[k] != 0;
        else
            splat->visible = covariance_conic(splat->covariance, &splat->conic);
        double reach = sqrt(2 * log(splat->opacity / (double)ALPHA_MIN));
        covariance_box(splat->covariance, reach, &splat->reach_px[0], &splat->reach_px[1]);
    }
    mem_free(S);
}

// The coefficients as E12 takes them: (count, (degree + 1)^2, 3), degree 0 first.
static double *coefficients(const Stage *s, int degree) {
    static const GaussianFieldId fields[] = {FIELD_SH0, FIELD_SH1, FIELD_SH2, FIELD_SH3};
    size_t width = 3 * (size_t)((degree + 1) * (degree + 1));
    double *all = mem_alloc((size_t)s->count * width, sizeof *all);
    for (int k = 0; k < s->count; k++) {
        double *to = all + (size_t)k * width;
        for (int l = 0; l <= degree; l++) {
            size_t numbers = (size_t)GAUSSIAN_FIELDS[fields[l]].width;
            memcpy(to, gaussiansd_at(s->model, fields[l], s->index[k]), numbers * sizeof *to);
            to += numbers;
        }
    }
    return all;
}

static void colour(Stage *s) {
    int degree = s->model->sh_degree < s->settings->sh_degree ? s->model->sh_degree : s->settings->sh_degree;
    double *numbers = mem_alloc((size_t)s->count * 10, sizeof *numbers), *deg = numbers, *d = numbers + s->count,
           *rgb = numbers + 4 * s->count, *clamped = numbers + 7 * s->count, *k_all = coefficients(s, degree);
    Vec3 eye = camera_position(s->camera);
    for (int k = 0; k < s->count; k++) {
        Vec3 direction = vec3_normalize(vec3_sub(mean_of(s, k), eye));
        deg[k] = degree;
        d[3 * k] = direction.x, d[3 * k + 1] = direction.y, d[3 * k + 2] = direction.z;
    }
    const Arg args[] = {ARG_IN("deg", deg, 1), ARG_IN("d", d, 3), ARG_IN("k", k_all, 3 * (degree + 1) * (degree + 1)),
                        ARG_OUT("rgb", rgb, 3), ARG_OUT("clamped", clamped, 3)};
    bool is_mine = call_splats(s, MINE_SH, "sh_color", args, 5);
    for (int k = 0; is_mine && k < s->count; k++) memcpy(s->splats[k].rgb, rgb + 3 * k, 3 * sizeof *rgb);
    mem_free(numbers);
    mem_free(k_all);
}

// ---- the picture ----

static int by_depth(const void *a, const void *b) {
    const Splat2 *x = *(const Splat2 *const *)a, *y = *(const Splat2 *const *)b;
    if (x->depth != y->depth) return x->depth < y->depth ? -1 : 1;
    return x < y ? -1 : 1; // they lie in the order of their indices
}

// E05: order holds the splats by index, and afterwards from front to back.
static bool sort_mine(const Stage *s, const Splat2 **order, int count) {
    const Splat2 **before = mem_alloc((size_t)count, sizeof *before);
    int *rank = mem_alloc((size_t)count, sizeof *rank);
    double *mu = mem_alloc((size_t)count * 3, sizeof *mu);
    for (int k = 0; k < count; k++) {
        Vec3 mean = mean_of(s, (int)(order[k] - s->splats));
        before[k] = order[k];
        memcpy(mu + 3 * k, (double[]){mean.x, mean.y, mean.z}, 3 * sizeof *mu);
    }
    bool good = mine_order(s->mine, s->cam, mu, count, rank);
    for (int k = 0; good && k < count; k++) order[k] = before[rank[k]];
    mem_free(mu);
    mem_free(rank);
    mem_free(before);
    return good;
}

static const Splat2 **front_to_back(const Stage *s, int *count) {
    const Splat2 **order = mem_alloc((size_t)s->count, sizeof *order);
    *count = 0;
    for (int k = 0; k < s->count; k++)
        if (s->splats[k].visible && !isnan(s->splats[k].depth)) order[(*count)++] = &s->splats[k];
    if (!sort_mine(s, order, *count)) qsort(order, (size_t)*count, sizeof *order, by_depth);
    return order;
}

// Within 0..pixels, wherever a person's functions have put the splat; 0 for NaN.
static int column(const HitRow *row, double x) { return (int)fmin(row->pixels, fmax(0, x)); }

static void gather(HitRow *row, const Splat2 *splat, int y) {
    double dy = y + 0.5 - splat->mean_px[1];
    if (fabs(dy) > splat->reach_px[1]) return;
    int from = column(row, splat->mean_px[0] - splat->reach_px[0] - 0.5);
    int to = column(row, splat->mean_px[0] + splat->reach_px[0] + 1.5);
    for (int x = from; x < to; x++) {
        double m2 = conic_mahalanobis2(splat->conic, x + 0.5 - splat->mean_px[0], dy);
        double alpha = splat->opacity * exp(-m2 / 2);
        if (alpha >= (double)ALPHA_MIN) hit_row_add(row, x, alpha, splat->rgb);
    }
}

static void blend(const Stage *s, Picture *picture) {
    int width = s->camera->width, height = s->camera->height, count;
    const Splat2 **order = front_to_back(s, &count);
    const double background[3] = {s->settings->background[0], s->settings->background[1], s->settings->background[2]};
    CompositeRule rule = composite_rule_default();
    double *rgb = mem_alloc((size_t)width * 4, sizeof *rgb), *T = rgb + 3 * width;
    HitRow row = {0};
    Progress progress = progress_begin("render", 0, height);
    for (int y = 0; y < height; y++) {
        hit_row_begin(&row, width);
        for (int k = 0; k < count; k++) gather(&row, order[k], y);
        hit_row_composite(&row, s->mine, &rule, background, rgb, T);
        for (int i = 0; i < 3 * width; i++)
            picture->rgb.values[3 * (size_t)width * (size_t)y + (size_t)i] = (float)rgb[i];
        for (int x = 0; x < width; x++)
            picture->alpha.values[(size_t)width * (size_t)y + (size_t)x] = (float)(1 - T[x]);
        progress_update(&progress, y + 1, NULL);
    }
    progress_end(&progress, NULL);
    hit_row_end(&row);
    mem_free(rgb);
    mem_free(order);
}

// ---- the filler ----

typedef struct {
    Rasterizer base;
    Mine *mine;
} MineRasterizer;

static bool table_render(Rasterizer *self, const Gaussians *model, const Camera *camera, const RenderSettings *settings,
                         Picture *picture) {
    if (settings->what != RENDER_COLOUR)
        return fail_usage("your functions make colour pictures; for depth and alpha leave --mine away");
    GaussiansD g = gaussiansd_from(model);
    Stage s = {.mine = ((MineRasterizer *)self)->mine, .model = &g, .camera = camera, .settings = settings};
    picture->rgb = imagef_create(camera->width, camera->height, 3);
    picture->alpha = imagef_create(camera->width, camera->height, 1);
    stage_begin(&s);
    double *S3 = covariances(&s);
    project(&s);
    flatten(&s, S3);
    invert(&s);
    colour(&s);
    blend(&s, picture);
    mem_free(S3);
    stage_end(&s);
    gaussiansd_destroy(&g);
    return true;
}

static bool table_backward(Rasterizer *self, const Gaussians *model, const Camera *camera,
                           const RenderSettings *settings, const ImageF *d_rgb, Gaussians *d_model) {
    (void)self, (void)model, (void)camera, (void)settings, (void)d_rgb, (void)d_model;
    return fail("your functions have no backward pass yet");
}

static void table_destroy(Rasterizer *self) { mem_free(self); }

Rasterizer *mine_rasterizer_create(Mine *mine) {
    static const RasterizerApi api = {"mine", table_render, table_backward, NULL, table_destroy};
    MineRasterizer *rasterizer = mem_alloc(1, sizeof *rasterizer);
    rasterizer->base.api = &api;
    rasterizer->mine = mine;
    return &rasterizer->base;
}
