// scene2d.c - the list of blobs and what can be done to it.
#include "splat2d/scene2d.h"

#include "lab/base/fail.h"
#include "lab/base/mem.h"

#include <assert.h>
#include <math.h>
#include <string.h>

// ---- create, copy, destroy ----

Scene2d scene2d_create(int width, int height) { return (Scene2d){.width = width, .height = height}; }

// Makes room for `count` blobs.
static void reserve(Scene2d *scene, int count) {
    if (count <= scene->capacity) return;
    int capacity = count < 8 ? 8 : 2 * count;
    scene->blobs = mem_resize(scene->blobs, (size_t)scene->capacity, (size_t)capacity, sizeof *scene->blobs);
    scene->capacity = capacity;
}

Scene2d scene2d_copy(const Scene2d *scene) {
    Scene2d copy = *scene;
    copy.blobs = NULL;
    copy.capacity = 0;
    reserve(&copy, scene->count);
    if (scene->count > 0) memcpy(copy.blobs, scene->blobs, (size_t)scene->count * sizeof *copy.blobs);
    return copy;
}

void scene2d_destroy(Scene2d *scene) {
    mem_free(scene->blobs);
    *scene = (Scene2d){0};
}

// What each is for. Three golden beads lie on a diagonal; the rose blob between them is the one to stretch and turn until
// it covers the streak alone. Teal and orange overlap at neighbouring depths: swapped, the overlap pops. The violet needle
// lies in front of everything and is half transparent: its opacity blends or hides what is behind it.
Scene2d scene2d_default(void) {
    static const double gold[3] = {1.00, 0.76, 0.22}, rose[3] = {0.95, 0.25, 0.42}, teal[3] = {0.08, 0.70, 0.68},
                        orange[3] = {0.98, 0.48, 0.16}, violet[3] = {0.56, 0.44, 0.98};
    static const struct {
        double x, y, sigma_x, sigma_y, theta_rad, opacity, depth;
        const double *rgb;
    } rows[] = {
        {345, 345, 44, 44, 0.00, 0.92, 3, rose}, // stands first: it is the one a window begins with
        {185, 505, 38, 38, 0.00, 0.92, 4, gold},     {265, 425, 38, 38, 0.00, 0.92, 5, gold},
        {640, 270, 118, 58, 0.55, 0.94, 1, teal},    {690, 385, 112, 60, -0.60, 0.94, 2, orange},
        {560, 560, 210, 26, -0.22, 0.60, 0, violet},
    };
    Scene2d scene = scene2d_create(960, 720);
    const double night[3] = {0.055, 0.065, 0.100};
    memcpy(scene.background, night, sizeof night);
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        Blob blob = {.mean = {rows[i].x, rows[i].y},
                     .sigma_x = rows[i].sigma_x,
                     .sigma_y = rows[i].sigma_y,
                     .theta_rad = rows[i].theta_rad,
                     .opacity = rows[i].opacity,
                     .depth = rows[i].depth};
        memcpy(blob.rgb, rows[i].rgb, sizeof blob.rgb);
        scene2d_add(&scene, &blob);
    }
    return scene;
}

// ---- ranges ----

static bool in_range(double value, double low, double high) { return value >= low && value <= high; } // NaN is not

static bool check_value(const char *where, int index, const char *field, double value, double low, double high) {
    if (in_range(value, low, high)) return true;
    return fail("%s, blob %d: \"%s\" is %g, want %g to %g", where, index, field, value, low, high);
}

static bool check_blob(const Blob *blob, const char *where, int index) {
    for (int c = 0; c < 2; c++)
        if (!check_value(where, index, "mean", blob->mean[c], -SCENE2D_MEAN_MAX, SCENE2D_MEAN_MAX)) return false;
    for (int c = 0; c < 3; c++)
        if (!check_value(where, index, "rgb", blob->rgb[c], 0, 1)) return false;
    return check_value(where, index, "sigma_x", blob->sigma_x, 0, SCENE2D_SIGMA_MAX) &&
           check_value(where, index, "sigma_y", blob->sigma_y, 0, SCENE2D_SIGMA_MAX) &&
           check_value(where, index, "theta_rad", blob->theta_rad, -SCENE2D_THETA_MAX, SCENE2D_THETA_MAX) &&
           check_value(where, index, "opacity", blob->opacity, 0, 1) &&
           check_value(where, index, "depth", blob->depth, -SCENE2D_DEPTH_MAX, SCENE2D_DEPTH_MAX);
}

bool scene2d_check(const Scene2d *scene, const char *where) {
    if (!in_range(scene->width, 1, SCENE2D_SIDE_MAX) || !in_range(scene->height, 1, SCENE2D_SIDE_MAX))
        return fail("%s: the canvas is %d x %d px, want 1 to %d each", where, scene->width, scene->height,
                    SCENE2D_SIDE_MAX);
    for (int c = 0; c < 3; c++)
        if (!in_range(scene->background[c], 0, 1))
            return fail("%s: \"background\" holds %g, want 0 to 1", where, scene->background[c]);
    if (!in_range(scene->count, 0, SCENE2D_BLOBS_MAX))
        return fail("%s: %d blobs, want at most %d", where, scene->count, SCENE2D_BLOBS_MAX);
    for (int i = 0; i < scene->count; i++)
        if (!check_blob(&scene->blobs[i], where, i)) return false;
    return true;
}

// ---- shape ----

Sym2 blob_covariance(const Blob *blob) { return covariance_from_angle(blob->theta_rad, blob->sigma_x, blob->sigma_y); }

bool blob_conic(const Blob *blob, Sym2 *conic) {
    if (!(blob->sigma_x > 0 && blob->sigma_y > 0)) return false;
    *conic = covariance_from_angle(blob->theta_rad, 1 / blob->sigma_x, 1 / blob->sigma_y);
    return isfinite(conic->xx) && isfinite(conic->xy) && isfinite(conic->yy);
}

// ---- edits ----

int scene2d_add(Scene2d *scene, const Blob *blob) {
    if (scene->count >= SCENE2D_BLOBS_MAX) {
        fail("a scene holds at most %d blobs; remove one first", SCENE2D_BLOBS_MAX);
        return -1;
    }
    Blob added = *blob; // which may stand in the array that moves
    reserve(scene, scene->count + 1);
    scene->blobs[scene->count] = added;
    return scene->count++;
}

int scene2d_duplicate(Scene2d *scene, int index) {
    assert(index >= 0 && index < scene->count);
    int copy = scene2d_add(scene, &scene->blobs[index]);
    if (copy >= 0) scene2d_set_rank(scene, copy, scene2d_rank(scene, index) + 1);
    return copy;
}

void scene2d_remove(Scene2d *scene, int index) {
    assert(index >= 0 && index < scene->count);
    size_t behind = (size_t)(scene->count - index - 1);
    memmove(&scene->blobs[index], &scene->blobs[index + 1], behind * sizeof *scene->blobs);
    scene->count--;
}

// ---- depth order ----

// No two blobs are equal in this order.
static bool lies_behind(const Scene2d *scene, int a, int b) {
    double depth_a = scene->blobs[a].depth, depth_b = scene->blobs[b].depth;
    return depth_a != depth_b ? depth_a > depth_b : a > b;
}

// Lets the index at `place` of the heap sink until both below it lie in front of it.
static void sink(const Scene2d *scene, int *heap, int count, int place) {
    for (int below = 2 * place + 1; below < count; below = 2 * place + 1) {
        if (below + 1 < count && lies_behind(scene, heap[below + 1], heap[below])) below++;
        if (!lies_behind(scene, heap[below], heap[place])) return;
        int index = heap[place];
        heap[place] = heap[below];
        heap[below] = index;
        place = below;
    }
}

// Heap sort: in place, because a window asks at every frame, and qsort() may allocate.
void scene2d_order(const Scene2d *scene, int *order) {
    for (int i = 0; i < scene->count; i++) order[i] = i;
    for (int place = scene->count / 2 - 1; place >= 0; place--) sink(scene, order, scene->count, place);
    for (int end = scene->count - 1; end > 0; end--) {
        int hindmost = order[0];
        order[0] = order[end];
        order[end] = hindmost;
        sink(scene, order, end, 0);
    }
}

int scene2d_rank(const Scene2d *scene, int index) {
    assert(index >= 0 && index < scene->count);
    int rank = 0;
    for (int i = 0; i < scene->count; i++) rank += lies_behind(scene, index, i);
    return rank;
}

// A depth strictly between those of the two neighbours (order[rank - 1] and order[rank + 1]); false when there is none.
static bool depth_between(const Scene2d *scene, const int *order, int rank, double *depth) {
    bool is_first = rank == 0, is_last = rank == scene->count - 1;
    double front = is_first ? 0 : scene->blobs[order[rank - 1]].depth;
    double back = is_last ? 0 : scene->blobs[order[rank + 1]].depth;
    if (is_first && is_last) return false;
    *depth = is_first ? back - 1 : is_last ? front + 1 : (front + back) / 2;
    return fabs(*depth) <= SCENE2D_DEPTH_MAX && (is_first || *depth > front) && (is_last || *depth < back);
}

void scene2d_set_rank(Scene2d *scene, int index, int rank) {
    int from = scene2d_rank(scene, index);
    rank = rank < 0 ? 0 : rank >= scene->count ? scene->count - 1 : rank;
    if (rank == from) return;
    int *order = mem_alloc((size_t)scene->count, sizeof *order);
    scene2d_order(scene, order);
    int step = rank > from ? 1 : -1;
    for (int i = from; i != rank; i += step) order[i] = order[i + step];
    order[rank] = index;
    double depth;
    if (depth_between(scene, order, rank, &depth))
        scene->blobs[index].depth = depth;
    else
        for (int i = 0; i < scene->count; i++) scene->blobs[order[i]].depth = i + 1;
    mem_free(order);
}

int scene2d_pick(const Scene2d *scene, double x, double y, double k) {
    int best = -1;
    for (int i = 0; i < scene->count; i++) {
        const Blob *blob = &scene->blobs[i];
        Sym2 conic;
        if (!blob_conic(blob, &conic)) continue;
        bool covered = conic_mahalanobis2(conic, x - blob->mean[0], y - blob->mean[1]) <= k * k;
        if (covered && (best < 0 || blob->depth < scene->blobs[best].depth)) best = i;
    }
    return best;
}
