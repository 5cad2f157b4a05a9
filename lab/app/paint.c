// paint.c - edge functions over each triangle's box (Pineda, "A parallel algorithm for polygon rasterization", 1988).
#include "lab/app/paint.h"

#include <math.h>
#include <stddef.h>

// a x + b y + c is the weight of one corner at (x, y): 1 there, 0 on the opposite edge.
typedef struct {
    double a, b, c;
    bool owns_edge; // a point exactly on the edge is inside
} Edge;

// The edge from p to q, with the third corner on its positive side; area2 is twice the triangle's signed area.
static Edge edge_between(const PaintVertex *p, const PaintVertex *q, double area2) {
    double a = (p->y - q->y) / area2, b = (q->x - p->x) / area2;
    bool owns = a > 0 || (a == 0 && b > 0); // left edges, and top ones
    return (Edge){.a = a, .b = b, .c = -(a * p->x + b * p->y), .owns_edge = owns};
}

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

static void paint_triangle(Image8 *to, const int clip[4], PaintTexture texture, const PaintVertex *const p[3]) {
    double area2 = ((double)p[1]->x - p[0]->x) * ((double)p[2]->y - p[0]->y) -
                   ((double)p[1]->y - p[0]->y) * ((double)p[2]->x - p[0]->x);
    if (area2 == 0) return;
    const Edge edges[3] = {edge_between(p[1], p[2], area2), edge_between(p[2], p[0], area2),
                           edge_between(p[0], p[1], area2)};
    int left = box_start(fmin(p[0]->x, fmin(p[1]->x, p[2]->x)), clip[0]);
    int right = box_end(fmax(p[0]->x, fmax(p[1]->x, p[2]->x)), clip[2]);
    int top = box_start(fmin(p[0]->y, fmin(p[1]->y, p[2]->y)), clip[1]);
    int bottom = box_end(fmax(p[0]->y, fmax(p[1]->y, p[2]->y)), clip[3]);
    for (int y = top; y < bottom && y < clip[3]; y++)
        for (int x = left; x < right && x < clip[2]; x++) {
            double weights[3];
            bool inside = true;
            for (int i = 0; i < 3 && inside; i++) {
                weights[i] = edges[i].a * (x + 0.5) + edges[i].b * (y + 0.5) + edges[i].c;
                inside = weights[i] > 0 || (weights[i] == 0 && edges[i].owns_edge);
            }
            if (inside) blend(to->bytes + ((ptrdiff_t)y * to->width + x) * 3, p, weights, texture);
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
