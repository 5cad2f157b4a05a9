// mine_picture2d.c - shapes of all blobs in one request, then row by row what each block meets.
#include "exercises/harness/mine_picture2d.h"

#include "exercises/harness/hit_row.h"
#include "exercises/harness/mine_order.h"
#include "lab/base/mem.h"

#include <math.h>
#include <stddef.h>

// Hits that take some 30 ms: sent to another process, or blended here.
enum { HITS_SENT = 200000, HITS_HERE = 2000000, BLOCK_MAX = 16 };

// Sigma of each blob: E01, or the reference.
static Sym2 *covariances(Mine *mine, const Scene2d *scene) {
    int count = scene->count;
    double *numbers = mem_alloc((size_t)count * 6 + 1, sizeof *numbers);
    double *theta = numbers, *sx = numbers + count, *sy = numbers + 2 * count, *S = numbers + 3 * count;
    Sym2 *shapes = mem_alloc((size_t)count, sizeof *shapes);
    for (int i = 0; i < count; i++) {
        theta[i] = scene->blobs[i].theta_rad;
        sx[i] = scene->blobs[i].sigma_x;
        sy[i] = scene->blobs[i].sigma_y;
    }
    const Arg args[] = {ARG_IN("theta", theta, 1), ARG_IN("sx", sx, 1), ARG_IN("sy", sy, 1), ARG_OUT("S", S, 3)};
    bool is_mine = mine_call(mine, MINE_COV2, "cov2_from_rs", args, sizeof args / sizeof *args, count);
    for (int i = 0; i < count; i++)
        shapes[i] = is_mine ? (Sym2){S[3 * i], S[3 * i + 1], S[3 * i + 2]} : blob_covariance(&scene->blobs[i]);
    mem_free(numbers);
    return shapes;
}

// In place: from Sigma to its inverse, by E02 or the reference. What has none is not drawn: a conic of NaN.
static void conics(Mine *mine, int count, Sym2 *shapes) {
    double *numbers = mem_alloc((size_t)count * 7 + 1, sizeof *numbers);
    double *S = numbers, *K = numbers + 3 * count, *returned = numbers + 6 * count;
    for (int i = 0; i < count; i++) S[3 * i] = shapes[i].xx, S[3 * i + 1] = shapes[i].xy, S[3 * i + 2] = shapes[i].yy;
    const Arg args[] = {ARG_IN("S", S, 3), ARG_OUT("K", K, 3), ARG_OUT("returned", returned, 1)};
    bool is_mine = mine_call(mine, MINE_CONIC, "conic_from_cov2", args, sizeof args / sizeof *args, count);
    for (int i = 0; i < count; i++) {
        Sym2 conic = {NAN, NAN, NAN};
        if (!is_mine)
            covariance_conic(shapes[i], &conic);
        else if (returned[i] != 0)
            conic = (Sym2){K[3 * i], K[3 * i + 1], K[3 * i + 2]};
        shapes[i] = conic;
    }
    mem_free(numbers);
}

// E05, or the reference. Depths are put in front of a camera that looks along them: their differences are what counts.
static void order_blobs(Mine *mine, const Scene2d *scene, int *order) {
    static const double cam[MINE_CAM_NUMBERS] = {1, 1, 1, 1, 0, 0, /* R */ 1, 0, 0, 0, 1, 0, 0, 0, 1, /* t */ 0, 0, 0};
    double *mu = mem_alloc((size_t)scene->count * 3, sizeof *mu), nearest = INFINITY;
    for (int i = 0; i < scene->count; i++) nearest = fmin(nearest, scene->blobs[i].depth);
    for (int i = 0; i < scene->count; i++) mu[3 * i + 2] = scene->blobs[i].depth - nearest + 1;
    if (!mine_order(mine, cam, mu, scene->count, order)) scene2d_order(scene, order);
    mem_free(mu);
}

static int block_side(int width, int height, int count, int hits_all) {
    int side = (int)ceil(sqrt((double)width * height * (count > 0 ? count : 1) / hits_all));
    return side < 1 ? 1 : side > BLOCK_MAX ? BLOCK_MAX : side;
}

static void gather(HitRow *row, const Scene2d *scene, const int *order, const Sym2 *conic, View2d view, int side,
                   int top) {
    for (int k = 0; k < scene->count; k++) {
        const Blob *blob = &scene->blobs[order[k]];
        double dy = view.top + (top + side / 2.0) / view.zoom - blob->mean[1];
        for (int x = 0; x < row->pixels; x++) {
            double dx = view.left + (x + 0.5) * side / view.zoom - blob->mean[0];
            double alpha = blob->opacity * exp(-conic_mahalanobis2(conic[order[k]], dx, dy) / 2);
            if (isfinite(alpha)) hit_row_add(row, x, alpha, blob->rgb);
        }
    }
}

static void fill(ImageF *picture, float *transmittance, int top, int side, const double *rgb, const double *T) {
    for (int y = top; y < top + side && y < picture->height; y++)
        for (int x = 0; x < picture->width; x++) {
            ptrdiff_t at = (ptrdiff_t)y * picture->width + x;
            for (int c = 0; c < 3; c++) picture->values[3 * at + c] = (float)rgb[3 * (x / side) + c];
            if (transmittance) transmittance[at] = (float)T[x / side];
        }
}

int mine_picture2d(Mine *mine, const Scene2d *scene, View2d view, const CompositeRule *rule, ImageF *picture,
                   float *transmittance) {
    int hits_all = mine_is_used(mine, MINE_COMPOSITE) ? HITS_SENT : HITS_HERE;
    int side = block_side(picture->width, picture->height, scene->count, hits_all);
    int blocks = (picture->width + side - 1) / side;
    int *order = mem_alloc((size_t)scene->count, sizeof *order);
    double *rgb = mem_alloc((size_t)blocks * 4, sizeof *rgb), *T = rgb + 3 * blocks;
    HitRow row = {0};
    Sym2 *shapes = covariances(mine, scene);
    conics(mine, scene->count, shapes);
    order_blobs(mine, scene, order);
    for (int top = 0; top < picture->height; top += side) {
        hit_row_begin(&row, blocks);
        gather(&row, scene, order, shapes, view, side, top);
        hit_row_composite(&row, mine, rule, scene->background, rgb, T);
        fill(picture, transmittance, top, side, rgb, T);
    }
    hit_row_end(&row);
    mem_free(shapes);
    mem_free(rgb);
    mem_free(order);
    return side;
}
