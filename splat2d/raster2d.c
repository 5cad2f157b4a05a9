// raster2d.c - blobs into picture coordinates, then rows in parallel.
#include "splat2d/raster2d.h"

#include "lab/base/mem.h"
#include "lab/base/parallel.h"
#include "splat2d/lanes.h"

#include <assert.h>
#include <math.h>
#include <stddef.h>
#include <string.h>

// Even a rule without alpha_min ends here: a smaller alpha' changes no float, and products of ever smaller ones are slow.
static const double ALPHA_UNSEEN = 1e-12;

enum { STRIP = 256 }; // px of a row that are worked on at a time, so that their state stays in the nearest cache

// ---- views ----

View2d view2d_whole(void) { return (View2d){.left = 0, .top = 0, .zoom = 1}; }

View2d view2d_fit(const Scene2d *scene, int width, int height) {
    double zoom = fmin((double)width / scene->width, (double)height / scene->height);
    return (View2d){
        .left = (scene->width - width / zoom) / 2, .top = (scene->height - height / zoom) / 2, .zoom = zoom};
}

// ---- shapes ----

Shape shape_of(Sym2 covariance) {
    double determinant = sym2_determinant(covariance);
    if (!isfinite(determinant) || determinant == 0) return SHAPE_FLAT;
    if (determinant < 0) return SHAPE_INDEFINITE;
    return covariance.xx > 0 ? SHAPE_VALID : SHAPE_NEGATIVE;
}

static void set_axes(RasterBlob *blob, double theta_rad, double sigma_u, double sigma_v) {
    double c = cos(theta_rad), s = sin(theta_rad);
    blob->axis_u[0] = c / sigma_u, blob->axis_u[1] = s / sigma_u;
    blob->axis_v[0] = -s / sigma_v, blob->axis_v[1] = c / sigma_v;
    blob->sign_u = blob->sign_v = 1;
}

Shape raster2d_set_covariance(Raster2d *raster, int index, Sym2 covariance) {
    RasterBlob *blob = raster->blobs;
    while (blob < raster->blobs + raster->count && blob->index != index) blob++;
    assert(blob < raster->blobs + raster->count);
    blob->shape = shape_of(covariance);
    if (blob->shape == SHAPE_FLAT) return SHAPE_FLAT;
    // The inverse has the same axes and 1 / eigenvalue along them, whatever their signs.
    Eigen2 eigen = sym2_eigen(covariance);
    set_axes(blob, eigen.angle_rad, sqrt(fabs(eigen.major)) * raster->zoom, sqrt(fabs(eigen.minor)) * raster->zoom);
    blob->sign_u = eigen.major > 0 ? 1 : -1;
    blob->sign_v = eigen.minor > 0 ? 1 : -1;
    return blob->shape;
}

// ---- load ----

static RasterBlob place_blob(const Blob *blob, int index, View2d view) {
    RasterBlob placed = {.index = index, .opacity = blob->opacity, .depth = blob->depth, .shape = SHAPE_FLAT};
    memcpy(placed.rgb, blob->rgb, sizeof placed.rgb);
    placed.mean[0] = (blob->mean[0] - view.left) * view.zoom;
    placed.mean[1] = (blob->mean[1] - view.top) * view.zoom;
    Sym2 conic;
    if (!blob_conic(blob, &conic)) return placed;
    placed.shape = SHAPE_VALID;
    set_axes(&placed, blob->theta_rad, blob->sigma_x * view.zoom, blob->sigma_y * view.zoom);
    return placed;
}

void raster2d_load(Raster2d *raster, const Scene2d *scene, View2d view) {
    if (raster->capacity < scene->count) {
        mem_free(raster->blobs);
        mem_free(raster->order);
        raster->capacity = scene->capacity;
        raster->blobs = mem_alloc((size_t)raster->capacity, sizeof *raster->blobs);
        raster->order = mem_alloc((size_t)raster->capacity, sizeof *raster->order);
    }
    memcpy(raster->background, scene->background, sizeof raster->background);
    raster->zoom = view.zoom;
    raster->count = scene->count;
    scene2d_order(scene, raster->order);
    for (int i = 0; i < scene->count; i++)
        raster->blobs[i] = place_blob(&scene->blobs[raster->order[i]], raster->order[i], view);
}

void raster2d_destroy(Raster2d *raster) {
    mem_free(raster->blobs);
    mem_free(raster->order);
    mem_free(raster->row_sums);
    *raster = (Raster2d){0};
}

// ---- draw ----

RasterSettings raster_settings_default(void) { return (RasterSettings){.rule = composite_rule_default()}; }

RasterSettings raster_settings_lesson(void) {
    return (RasterSettings){.rule = {.alpha_max = 1, .alpha_min = 0, .stop = 0.003, .rule = STOP_AFTER_BLEND},
                            .background_unattenuated = true};
}

double raster_blob_mahalanobis2(const RasterBlob *blob, double x, double y) {
    double dx = x - blob->mean[0], dy = y - blob->mean[1];
    double u = blob->axis_u[0] * dx + blob->axis_u[1] * dy, v = blob->axis_v[0] * dx + blob->axis_v[1] * dy;
    return blob->sign_u * u * u + blob->sign_v * v * v;
}

// alpha' = opacity exp(-m^2 / 2) >= alpha_min where m^2 <= 2 ln(opacity / alpha_min); negative: nowhere.
static double reach2_of(const RasterBlob *blob, const RasterSettings *settings) {
    if (blob->shape == SHAPE_FLAT || !(blob->opacity > 0)) return -1;
    if (settings->discs) return 1;
    if (blob->shape != SHAPE_VALID) return INFINITY;
    return 2 * log(blob->opacity / fmax(settings->rule.alpha_min, ALPHA_UNSEEN));
}

// Where the ellipse m^2 = reach2 meets the row at height y: x in [*from, *to). With d = (dx, dy) and the conic a, b, c,
//     a dx^2 + 2 b dx dy + c dy^2 = r   has the roots   dx = (-b dy +- sqrt(a r - det dy^2)) / a.
// Both ends are rounded outwards; what is too faint there is skipped by the blending rule.
static bool row_span(const RasterBlob *blob, double y, int first, int end, int *from, int *to) {
    *from = first, *to = end;
    if (blob->reach2 == INFINITY) return true;
    const double *u = blob->axis_u, *v = blob->axis_v;
    double a = u[0] * u[0] + v[0] * v[0], b = u[0] * u[1] + v[0] * v[1],
           root = u[0] * v[1] - u[1] * v[0]; // root^2 = det
    double dy = y - blob->mean[1];
    double room = a * blob->reach2 - root * root * dy * dy;
    if (!(blob->reach2 >= 0 && room >= 0)) return false;
    double middle = blob->mean[0] - b * dy / a, half = sqrt(room) / a;
    if (middle - half - 1 > first) *from = (int)fmin(end, middle - half - 1);
    if (middle + half + 1 < end) *to = (int)fmax(first, middle + half + 1);
    return *from < *to;
}

// What the rows of one picture have in common.
typedef struct {
    Raster2d *raster;
    const RasterSettings *settings;
    ImageF *picture;
    RasterMaps maps;
} Drawing;

// Some neighbouring pixels of a row on their way from front to back.
typedef struct {
    Real rgb[3][STRIP]; // sums so far, without background
    Real transmittance[STRIP];
    Real open[STRIP];   // 1 where blobs are still blended, 0 behind an opaque pixel
    Real visits[STRIP]; // blobs evaluated
} Strip;

// What blending needs to know, as numbers of the pixels' kind.
typedef struct {
    Real alpha_max, alpha_min, stop;
    bool stop_before;
    Real rgb[3];
} Blend;

// composite_blend() for the pixels i, i + 1, ... of the strip. inside: those among them that the blob reaches.
static inline void blend_lanes(Strip *strip, int i, const Blend *blend, Lanes alpha, Mask inside) {
    Lanes before = lanes_load(&strip->transmittance[i]), open = lanes_load(&strip->open[i]);
    alpha = lanes_only((open > 0) & (alpha >= blend->alpha_min), lanes_min(alpha, lanes_all(blend->alpha_max)));
    Lanes behind = before * (1 - alpha);
    Mask ends = behind < blend->stop;
    if (blend->stop_before) {
        alpha = lanes_only(~ends, alpha);
        behind = lanes_where(ends, before, behind);
    }
    Lanes weight = before * alpha;
    for (int c = 0; c < 3; c++) lanes_store(&strip->rgb[c][i], lanes_load(&strip->rgb[c][i]) + weight * blend->rgb[c]);
    lanes_store(&strip->transmittance[i], behind);
    lanes_store(&strip->visits[i], lanes_load(&strip->visits[i]) + lanes_only(inside, open));
    lanes_store(&strip->open[i], lanes_only(~ends, open));
}

// Blends one blob behind pixels from..to-1 of the strip, whose pixel 0 has its centre at (x, y).
static void blend_blob(Strip *strip, const RasterBlob *blob, const RasterSettings *settings, double x, double y,
                       int from, int to) {
    const CompositeRule *rule = &settings->rule;
    const Blend blend = {(Real)rule->alpha_max,
                         (Real)rule->alpha_min,
                         (Real)rule->stop,
                         rule->rule == STOP_BEFORE_BLEND,
                         {(Real)blob->rgb[0], (Real)blob->rgb[1], (Real)blob->rgb[2]}};
    const double *axis_u = blob->axis_u, *axis_v = blob->axis_v;
    double dx = x - blob->mean[0], dy = y - blob->mean[1];
    const Real u_step = (Real)axis_u[0], u_first = (Real)(axis_u[0] * dx + axis_u[1] * dy);
    const Real v_step = (Real)axis_v[0], v_first = (Real)(axis_v[0] * dx + axis_v[1] * dy);
    const Real scale_u = (Real)(-blob->sign_u * M_LOG2E / 2), scale_v = (Real)(-blob->sign_v * M_LOG2E / 2);
    const Real opacity = (Real)blob->opacity, disc_edge = (Real)(-M_LOG2E / 2);
    const bool discs = settings->discs;
    const Real first = (Real)from, end = (Real)to;
    from -= from % LANES;
    Lanes column = lanes_count_from((Real)from);
    for (int i = from; i < to; i += LANES, column += (Real)LANES) {
        if (!lanes_any(lanes_load(&strip->open[i]) > 0)) continue;
        Lanes u = u_first + u_step * column, v = v_first + v_step * column;
        Lanes log2_g = scale_u * u * u + scale_v * v * v;
        Lanes alpha = discs ? lanes_only(log2_g >= disc_edge, lanes_all(opacity)) : opacity * lanes_exp2(log2_g);
        blend_lanes(strip, i, &blend, alpha, (column >= first) & (column < end));
    }
}

// Takes pixel i of the strip over to pixel `at` of the picture; returns its accumulated opacity.
static double end_pixel(const Drawing *drawing, const Strip *strip, int i, ptrdiff_t at) {
    double transmittance = strip->transmittance[i],
           seen = drawing->settings->background_unattenuated ? 1 : transmittance;
    for (int c = 0; c < 3; c++)
        drawing->picture->values[3 * at + c] = (float)(strip->rgb[c][i] + seen * drawing->raster->background[c]);
    if (drawing->maps.transmittance) drawing->maps.transmittance[at] = (float)transmittance;
    if (drawing->maps.visits) drawing->maps.visits[at] = (int)strip->visits[i];
    return 1 - transmittance;
}

// Pixels x..x+count-1 of a row; returns the sum of their accumulated opacity.
static double draw_strip(const Drawing *drawing, int row, int x, int count) {
    const Raster2d *raster = drawing->raster;
    Strip strip = {0};
    for (int i = 0; i < STRIP; i++) strip.transmittance[i] = strip.open[i] = 1;
    for (const RasterBlob *blob = raster->blobs; blob < raster->blobs + raster->count; blob++) {
        int from, to;
        if (row_span(blob, row + 0.5, x, x + count, &from, &to))
            blend_blob(&strip, blob, drawing->settings, x + 0.5, row + 0.5, from - x, to - x);
    }
    double opacity = 0;
    for (int i = 0; i < count; i++)
        opacity += end_pixel(drawing, &strip, i, (ptrdiff_t)row * drawing->picture->width + x + i);
    return opacity;
}

static void draw_row(void *context, int row) {
    const Drawing *drawing = context;
    int width = drawing->picture->width;
    double opacity = 0;
    for (int x = 0; x < width; x += STRIP)
        opacity += draw_strip(drawing, row, x, width - x < STRIP ? width - x : STRIP);
    drawing->raster->row_sums[row] = opacity;
}

double raster2d_draw(Raster2d *raster, const RasterSettings *settings, ImageF *picture, const RasterMaps *maps) {
    assert(picture->channels == 3);
    if (raster->row_capacity < picture->height) {
        mem_free(raster->row_sums);
        raster->row_sums = mem_alloc((size_t)picture->height, sizeof *raster->row_sums);
        raster->row_capacity = picture->height;
    }
    for (int i = 0; i < raster->count; i++) raster->blobs[i].reach2 = reach2_of(&raster->blobs[i], settings);
    Drawing drawing = {raster, settings, picture, maps ? *maps : (RasterMaps){0}};
    parallel_for(picture->height, draw_row, &drawing);
    double sum = 0;
    for (int row = 0; row < picture->height; row++) sum += raster->row_sums[row];
    return sum / ((double)picture->width * picture->height);
}
