#include "splat3d/ray_texture.h"

#include "lab/base/mem.h"
#include "lab/base/parallel.h"

#include <assert.h>

enum { PROBES_MAX = 6 }; // along the longer axis

typedef struct {
    RayTexture *texture;
    RayPainter *painter;
    const void *context;
} Painting;

static uint8_t to_byte(double x) { return (uint8_t)(fmin(fmax(x, 0), 1) * 255 + 0.5); }

static void paint_row(void *context, int row) {
    const Painting *p = context;
    int size = p->texture->size;
    uint8_t *out = p->texture->texel[0] + (size_t)row * (size_t)size * 4;
    for (int x = 0; x < size; x++, out += 4) {
        RayTexel t = p->painter(p->context, (x + 0.5) / size, (row + 0.5) / size);
        out[0] = to_byte(sqrt(t.colour.x)), out[1] = to_byte(sqrt(t.colour.y)), out[2] = to_byte(sqrt(t.colour.z));
        out[3] = to_byte(t.height);
    }
}

// Each texel of the smaller level is the mean of four, of light rather than of stored square roots.
static void halve(const uint8_t *from, int side, uint8_t *to) {
    for (int y = 0; y < side; y++)
        for (int x = 0; x < side; x++, to += 4) {
            const uint8_t *a = from + ((size_t)(2 * y) * (size_t)(2 * side) + (size_t)(2 * x)) * 4;
            const uint8_t *b = a + (size_t)(2 * side) * 4;
            for (int c = 0; c < 3; c++) {
                double sum = a[c] * a[c] + a[c + 4] * a[c + 4] + b[c] * b[c] + b[c + 4] * b[c + 4];
                to[c] = (uint8_t)(sqrt(sum / 4) + 0.5);
            }
            to[3] = (uint8_t)((a[3] + a[7] + b[3] + b[7] + 2) / 4);
        }
}

RayTexture ray_texture_paint(int size, RayPainter *painter, const void *context) {
    assert(size >= 1 && size <= 2048 && (size & (size - 1)) == 0);
    RayTexture t = {.size = size};
    for (int side = size; side >= 1; side /= 2) t.texel[t.levels++] = mem_alloc((size_t)side * (size_t)side, 4);
    Painting painting = {&t, painter, context};
    parallel_for(size, paint_row, &painting);
    for (int level = 1; level < t.levels; level++) halve(t.texel[level - 1], size >> level, t.texel[level]);
    return t;
}

void ray_texture_destroy(RayTexture *texture) {
    for (int i = 0; i < texture->levels; i++) mem_free(texture->texel[i]);
    *texture = (RayTexture){0};
}

// The four texels round (u, v) of one level and their weights.
typedef struct {
    const uint8_t *texel[4];
    double weight[4];
} Neighbours;

static inline Neighbours neighbours_at(const RayTexture *t, int level, double u, double v) {
    int side = t->size >> level, mask = side - 1;
    double x = u * side - 0.5, y = v * side - 0.5, fx = floor(x), fy = floor(y);
    int x0 = (int)fx & mask, y0 = (int)fy & mask, x1 = (x0 + 1) & mask, y1 = (y0 + 1) & mask;
    const uint8_t *texels = t->texel[level];
    x -= fx, y -= fy;
    return (Neighbours){{texels + 4 * (y0 * side + x0), texels + 4 * (y0 * side + x1), texels + 4 * (y1 * side + x0),
                         texels + 4 * (y1 * side + x1)},
                        {(1 - x) * (1 - y), x * (1 - y), (1 - x) * y, x * y}};
}

// Adds weight * the bilinear value at (u, v) of one level: squares of the stored roots, and the height.
static void add_bilinear(const RayTexture *t, int level, double u, double v, double weight, double sum[4]) {
    Neighbours n = neighbours_at(t, level, u, v);
    for (int k = 0; k < 4; k++) {
        double w = weight * n.weight[k];
        const uint8_t *p = n.texel[k];
        sum[0] += w * (p[0] * p[0]), sum[1] += w * (p[1] * p[1]), sum[2] += w * (p[2] * p[2]), sum[3] += w * p[3];
    }
}

RayTexel ray_texture_read(const RayTexture *texture, double u, double v, RayFootprint f) {
    double longer = sqrt(f.long_u * f.long_u + f.long_v * f.long_v) * texture->size;
    double shorter = sqrt(f.short_u * f.short_u + f.short_v * f.short_v) * texture->size;
    if (shorter > longer) {
        double swap = longer;
        longer = shorter, shorter = swap;
        f.long_u = f.short_u, f.long_v = f.short_v;
    }
    int probes = (int)ceil(fmin(longer / fmax(shorter, 1), PROBES_MAX));
    if (probes < 1) probes = 1;
    double level = log2(fmax(fmax(shorter, longer / probes), 1));
    level = fmin(level, texture->levels - 1);
    int fine = (int)level;
    double coarse_part = fine + 1 < texture->levels ? level - fine : 0, sum[4] = {0, 0, 0, 0};
    for (int i = 0; i < probes; i++) {
        double along = (i + 0.5) / probes - 0.5, pu = u + along * f.long_u, pv = v + along * f.long_v;
        add_bilinear(texture, fine, pu, pv, (1 - coarse_part) / probes, sum);
        if (coarse_part > 0) add_bilinear(texture, fine + 1, pu, pv, coarse_part / probes, sum);
    }
    const double unit = 1.0 / (255 * 255);
    return (RayTexel){vec3(sum[0] * unit, sum[1] * unit, sum[2] * unit), sum[3] / 255};
}

double ray_texture_height(const RayTexture *texture, double u, double v, double width) {
    int level = 0;
    for (double texels = width * texture->size; texels > 1.5 && level < texture->levels - 1; texels /= 2) level++;
    Neighbours n = neighbours_at(texture, level, u, v);
    double sum = 0;
    for (int k = 0; k < 4; k++) sum += n.weight[k] * n.texel[k][3];
    return sum / 255;
}

Vec3 ray_texture_mean(const RayTexture *texture) {
    const uint8_t *p = texture->texel[texture->levels - 1];
    return vec3(p[0] * p[0] / 65025.0, p[1] * p[1] / 65025.0, p[2] * p[2] / 65025.0);
}
