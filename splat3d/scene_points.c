#include "splat3d/scene_points.h"

#include "lab/base/mem.h"
#include "lab/base/parallel.h"
#include "lab/base/rng.h"

#include <string.h>

enum {
    CELLS_ACROSS = 30, // the picture is divided into cells; each gives at most one corner and takes at most one point
    CELL_MIN_PX = 4,
    WINDOW_PX = 2, // half width of the window in which a corner must show
};

static const double CORNER_MIN = 40;         // smaller eigenvalue of the mean gradient tensor, (8-bit steps / px)^2
static const double SAME_DEPTH = 0.01;       // two views see the same place when depths agree to this part
static const double ANGLE_COSINE_MIN = 0.64; // a place seen from a more different direction is not recognised
static const double RECOGNISED = 0.75;       // chance that a view that sees a place also finds it
static const double CORNER_ERROR_PX = 0.5;   // standard deviation of where a corner is found
static const double DEPTH_ERROR_MAX = 0.05;  // of the depth; less certain points are thrown away

typedef struct {
    int x, y; // px; x < 0: the cell has no corner
} Corner;

typedef struct {
    const View *views;
    const ImageF *depth;
    int view_count;
    uint64_t seed;
    int cell_px, columns, rows;
    Corner *corner; // (views, rows, columns)
    bool *taken;    // (views, rows, columns): a point of an earlier view falls here
} Search;

static double grey(const Image8 *image, int x, int y) {
    const uint8_t *p = image->bytes + ((size_t)y * (size_t)image->width + (size_t)x) * (size_t)image->channels;
    return 0.299 * p[0] + 0.587 * p[1] + 0.114 * p[2];
}

// The smaller eigenvalue of the mean of gradient gradient^T over the window: large only where brightness changes in two directions.
static double corner_score(const Image8 *image, int x, int y) {
    double xx = 0, xy = 0, yy = 0;
    for (int j = y - WINDOW_PX; j <= y + WINDOW_PX; j++)
        for (int i = x - WINDOW_PX; i <= x + WINDOW_PX; i++) {
            double gx = 0.5 * (grey(image, i + 1, j) - grey(image, i - 1, j));
            double gy = 0.5 * (grey(image, i, j + 1) - grey(image, i, j - 1));
            xx += gx * gx, xy += gx * gy, yy += gy * gy;
        }
    const double count = (2 * WINDOW_PX + 1) * (2 * WINDOW_PX + 1);
    return (0.5 * (xx + yy) - sqrt(0.25 * (xx - yy) * (xx - yy) + xy * xy)) / count;
}

static float depth_at(const Search *s, int view, int x, int y) {
    return s->depth[view].values[(size_t)y * (size_t)s->depth[view].width + (size_t)x];
}

// The best corner of each cell of one row of cells of one view.
static void find_corners(void *context, int index) {
    const Search *s = context;
    int view = index / s->rows, row = index % s->rows, border = WINDOW_PX + 1;
    const Image8 *image = &s->views[view].image;
    Corner *corner = s->corner + (size_t)index * (size_t)s->columns;
    for (int column = 0; column < s->columns; column++) {
        double best = CORNER_MIN;
        corner[column] = (Corner){-1, -1};
        for (int y = row * s->cell_px; y < (row + 1) * s->cell_px && y < image->height - border; y++)
            for (int x = column * s->cell_px; x < (column + 1) * s->cell_px && x < image->width - border; x++) {
                if (x < border || y < border || depth_at(s, view, x, y) <= 0) continue;
                double score = corner_score(image, x, y);
                if (score > best) best = score, corner[column] = (Corner){x, y};
            }
    }
}

// Depth between the centres of four pixels: 1 / z is linear on a plane. 0 at the border and beside the sky.
static double depth_between(const Search *s, int view, double x_px, double y_px) {
    const Camera *camera = &s->views[view].camera;
    double fx = floor(x_px - 0.5), fy = floor(y_px - 0.5), u = x_px - 0.5 - fx, v = y_px - 0.5 - fy, inverse = 0;
    int x = (int)fx, y = (int)fy;
    if (x < 0 || y < 0 || x + 1 >= camera->width || y + 1 >= camera->height) return 0;
    for (int k = 0; k < 4; k++) {
        double depth = depth_at(s, view, x + (k & 1), y + (k >> 1));
        if (depth <= 0) return 0;
        inverse += (k & 1 ? u : 1 - u) * (k >> 1 ? v : 1 - v) / depth;
    }
    return 1 / inverse;
}

// Where a point falls in a view: false when it is outside, hidden, or in the sky.
static bool seen_in(const Search *s, int view, Vec3 point, int *x, int *y) {
    double x_px, y_px, depth;
    const Camera *camera = &s->views[view].camera;
    if (!camera_project(camera, point, &x_px, &y_px, &depth)) return false;
    if (!(x_px >= 0 && y_px >= 0 && x_px < camera->width && y_px < camera->height)) return false;
    *x = (int)x_px, *y = (int)y_px;
    return fabs(depth_at(s, view, *x, *y) - depth) < SAME_DEPTH * depth ||
           fabs(depth_between(s, view, x_px, y_px) - depth) < SAME_DEPTH * depth;
}

static bool *cell_of(const Search *s, int view, int x, int y) {
    return s->taken + ((size_t)view * (size_t)s->rows + (size_t)(y / s->cell_px)) * (size_t)s->columns + x / s->cell_px;
}

// The views that recognise the point, and the farthest distance between them and the first one.
typedef struct {
    int views;
    double baseline;
} Track;

static Track follow(const Search *s, int first, Vec3 point, Rng *rng) {
    Track track = {1, 0};
    Vec3 eye = camera_position(&s->views[first].camera), ray = vec3_normalize(vec3_sub(point, eye));
    for (int v = 0; v < s->view_count; v++) {
        int x, y;
        if (v == first || !seen_in(s, v, point, &x, &y) || rng_uniform(rng) > RECOGNISED) continue;
        Vec3 other = camera_position(&s->views[v].camera);
        if (vec3_dot(ray, vec3_normalize(vec3_sub(point, other))) < ANGLE_COSINE_MIN) continue;
        track.views++;
        track.baseline = fmax(track.baseline, vec3_length(vec3_sub(other, eye)));
    }
    return track;
}

// Where triangulation puts the point: off across the ray by the corner's error, and along it by more, the smaller the angle between the
// rays; the mean over the track's views is better than one. False when it would not be trusted.
static bool triangulate(const Camera *camera, const Track *track, double depth, Vec3 *point, Rng *rng) {
    double across = CORNER_ERROR_PX * depth / camera->fx / sqrt(track->views);
    double along = across * fmax(depth / track->baseline, 1);
    if (along > DEPTH_ERROR_MAX * depth) return false;
    Vec3 eye = camera_position(camera), ray = vec3_normalize(vec3_sub(*point, eye));
    Vec3 error = vec3_scale(vec3(rng_normal(rng), rng_normal(rng), rng_normal(rng)), across);
    error = vec3_add(error, vec3_scale(ray, along * rng_normal(rng)));
    if (rng_uniform(rng) < SCENE_OUTLIER_PART) { // a false match
        double factor = exp(rng_range(rng, -0.9, 0.9));
        *point = vec3_add(eye, vec3_scale(vec3_sub(*point, eye), factor));
    }
    *point = vec3_add(*point, error);
    return true;
}

static void mark_taken(const Search *s, Vec3 point) {
    for (int v = 0, x, y; v < s->view_count; v++)
        if (seen_in(s, v, point, &x, &y)) *cell_of(s, v, x, y) = true;
}

static void add_point(Points *points, Vec3 p, const Image8 *image, Corner corner) {
    size_t i = (size_t)points->count++;
    size_t pixel = (size_t)corner.y * (size_t)image->width + (size_t)corner.x;
    points->xyz[3 * i] = p.x, points->xyz[3 * i + 1] = p.y, points->xyz[3 * i + 2] = p.z;
    memcpy(points->rgb + 3 * i, image->bytes + pixel * (size_t)image->channels, 3);
}

static void points_of_view(const Search *s, int view, Points *points) {
    const Camera *camera = &s->views[view].camera;
    int cells = s->rows * s->columns;
    for (int i = 0; i < cells; i++) {
        Corner corner = s->corner[(size_t)view * (size_t)cells + (size_t)i];
        if (corner.x < 0 || *cell_of(s, view, corner.x, corner.y)) continue;
        Vec3 eye = camera_position(camera), ray = camera_ray(camera, corner.x + 0.5, corner.y + 0.5);
        double depth = depth_at(s, view, corner.x, corner.y);
        Vec3 point =
            vec3_add(eye, vec3_scale(ray, depth / vec3_dot(ray, vec3(camera->rotation.m[6], camera->rotation.m[7],
                                                                     camera->rotation.m[8]))));
        Rng rng = rng_at(s->seed, RNG_SCENE_POINTS, (uint32_t)view, (uint32_t)i);
        Track track = follow(s, view, point, &rng);
        Vec3 found = point;
        if (track.views < SCENE_TRACK_MIN || !triangulate(camera, &track, depth, &found, &rng)) continue;
        mark_taken(s, point);
        add_point(points, found, &s->views[view].image, corner);
    }
}

Points scene_points_find(const View *views, const ImageF *depth, int view_count, uint64_t seed) {
    int width = views[0].camera.width, height = views[0].camera.height;
    Search s = {.views = views, .depth = depth, .view_count = view_count, .seed = seed};
    s.cell_px = width / CELLS_ACROSS > CELL_MIN_PX ? width / CELLS_ACROSS : CELL_MIN_PX;
    s.columns = (width + s.cell_px - 1) / s.cell_px;
    s.rows = (height + s.cell_px - 1) / s.cell_px;
    size_t cells = (size_t)view_count * (size_t)s.rows * (size_t)s.columns;
    s.corner = mem_alloc(cells, sizeof(Corner));
    s.taken = mem_alloc(cells, sizeof(bool));
    parallel_for(view_count * s.rows, find_corners, &s);
    Points room = points_create((int)cells);
    room.count = 0;
    for (int v = 0; v < view_count; v++) points_of_view(&s, v, &room);
    Points points = points_create(room.count);
    memcpy(points.xyz, room.xyz, 3 * (size_t)room.count * sizeof(double));
    memcpy(points.rgb, room.rgb, 3 * (size_t)room.count);
    points_destroy(&room);
    mem_free(s.corner);
    mem_free(s.taken);
    return points;
}
