// paint.c - edge functions over each triangle's box (Pineda, "A parallel algorithm for polygon rasterization", 1988).
#include "lab/app/paint.h"

#include <math.h>
#include <stddef.h>

// Places are rounded to 1 / SUBPIXELS px and taken as whole numbers: then what is on an edge is so for both triangles
// that share it, whatever else they are made of.
enum { SUBPIXELS = 256 };
static const double PLACE_MAX = 1e6; // px

typedef struct {
    int64_t x, y;
} Place;

static int64_t fixed(double px) { return llround(SUBPIXELS * fmin(PLACE_MAX, fmax(-PLACE_MAX, px))); }

static Place place_of(const PaintVertex *vertex) { return (Place){fixed(vertex->x), fixed(vertex->y)}; }

// Twice the signed area of p, q, r: positive when r lies to the right of the way from p to q (y points down).
static int64_t area2(Place p, Place q, Place r) { return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x); }

// A point exactly on the edge from p to q belongs to the triangle on its right only when it is a left or a top edge.
static bool owns_edge(Place p, Place q) { return q.y < p.y || (q.y == p.y && q.x > p.x); }

static void fetch(const Image8 *image, int x, int y, double rgba[4]) {
    x = x < 0 ? 0 : x >= image->width ? image->width - 1 : x;
    y = y < 0 ? 0 : y >= image->height ? image->height - 1 : y;
    const uint8_t *bytes = image->bytes + ((ptrdiff_t)y * image->width + x) * image->channels;
    for (int c = 0; c < 3; c++) rgba[c] = bytes[c] / 255.0;
    rgba[3] = image->channels == 4 ? bytes[3] / 255.0 : 1;
}

static void sample(PaintTexture texture, double u, double v, double rgba[4]) {
    double x = u * texture.image->width, y = v * texture.image->height;
    if (!texture.smooth) {
        fetch(texture.image, (int)floor(x), (int)floor(y), rgba);
        return;
    }
    x -= 0.5, y -= 0.5;
    int left = (int)floor(x), top = (int)floor(y);
    double part_x = x - left, part_y = y - top, corner[4];
    for (int c = 0; c < 4; c++) rgba[c] = 0;
    for (int i = 0; i < 4; i++) {
        double weight = (i & 1 ? part_x : 1 - part_x) * (i & 2 ? part_y : 1 - part_y);
        if (weight == 0) continue;
        fetch(texture.image, left + (i & 1), top + (i >> 1), corner);
        for (int c = 0; c < 4; c++) rgba[c] += weight * corner[c];
    }
}

static void blend(uint8_t *pixel, const PaintVertex *const corners[3], const double weights[3], PaintTexture texture) {
    double u = 0, v = 0, rgba[4], tint[4] = {0};
    for (int i = 0; i < 3; i++) {
        u += weights[i] * corners[i]->u;
        v += weights[i] * corners[i]->v;
        for (int c = 0; c < 4; c++) tint[c] += weights[i] * corners[i]->rgba[c] / 255;
    }
    sample(texture, u, v, rgba);
    double alpha = rgba[3] * tint[3];
    for (int c = 0; c < 3; c++)
        pixel[c] = (uint8_t)lround(fmin(255, 255 * rgba[c] * tint[c] * alpha + pixel[c] * (1 - alpha)));
}

static int box_start(double low, int clip_low) { return low > clip_low ? (int)floor(low) : clip_low; }
static int box_end(double high, int clip_high) { return high < clip_high ? (int)ceil(high) + 1 : clip_high; }

static void paint_triangle(Image8 *to, const int clip[4], PaintTexture texture, const PaintVertex *const corners[3]) {
    const PaintVertex *v[3] = {corners[0], corners[1], corners[2]};
    Place p[3] = {place_of(v[0]), place_of(v[1]), place_of(v[2])};
    int64_t whole = area2(p[0], p[1], p[2]);
    if (whole == 0) return;
    if (whole < 0) { // the other way round
        const PaintVertex *kept = v[1];
        v[1] = v[2], v[2] = kept;
        p[1] = place_of(v[1]), p[2] = place_of(v[2]);
        whole = -whole;
    }
    int left = box_start(fmin(v[0]->x, fmin(v[1]->x, v[2]->x)), clip[0]);
    int right = box_end(fmax(v[0]->x, fmax(v[1]->x, v[2]->x)), clip[2]);
    int top = box_start(fmin(v[0]->y, fmin(v[1]->y, v[2]->y)), clip[1]);
    int bottom = box_end(fmax(v[0]->y, fmax(v[1]->y, v[2]->y)), clip[3]);
    for (int y = top; y < bottom && y < clip[3]; y++)
        for (int x = left; x < right && x < clip[2]; x++) {
            Place centre = {(int64_t)x * SUBPIXELS + SUBPIXELS / 2, (int64_t)y * SUBPIXELS + SUBPIXELS / 2};
            double weights[3];
            bool inside = true;
            for (int i = 0; i < 3 && inside; i++) { // weight of corner i: the part of the triangle that lies opposite
                Place from = p[(i + 1) % 3], end = p[(i + 2) % 3];
                int64_t part = area2(from, end, centre);
                inside = part > 0 || (part == 0 && owns_edge(from, end));
                weights[i] = (double)part / (double)whole;
            }
            if (inside) blend(to->bytes + ((ptrdiff_t)y * to->width + x) * 3, v, weights, texture);
        }
}

void paint_triangles(Image8 *to, const int clip[4], PaintTexture texture, const PaintVertex *vertices,
                     const uint16_t *indices, int count) {
    const int inner[4] = {clip[0] > 0 ? clip[0] : 0, clip[1] > 0 ? clip[1] : 0,
                          clip[2] < to->width ? clip[2] : to->width, clip[3] < to->height ? clip[3] : to->height};
    for (int i = 0; i + 2 < count; i += 3) {
        const PaintVertex *const corners[3] = {&vertices[indices[i]], &vertices[indices[i + 1]],
                                               &vertices[indices[i + 2]]};
        paint_triangle(to, inner, texture, corners);
    }
}
