// reference_blend.c - from splats on the screen to pixels, and back.
//
// Pixel (i, j) looks at its centre (x, y) = (i + 0.5, j + 0.5):
//
//     (1) m_k^2 = (d_x, d_y) conic_k (d_x, d_y)^T,  d = (x, y) - mean_k
//     (2) alpha_k = min(alpha_max, o_k exp(-m_k^2 / 2)), skipped below ALPHA_MIN
//     (3) C = sum_k T_k alpha_k c_k + T_end b,  T_k = prod_{j<k} (1 - alpha_j)     (Kerbl et al. 2023, eq. 3)
//
// For the way back, call what one would see behind splat k, with nothing in front of it,
//     (4) B_k = alpha_{k+1} c_{k+1} + (1 - alpha_{k+1}) B_{k+1},  B_last = b (the background).
// Then C = (what is in front of k) + T_k (alpha_k c_k + (1 - alpha_k) B_k), so
//     (5) dC / dc_k = T_k alpha_k,   dC / dalpha_k = T_k (c_k - B_k):
// a splat's alpha is worth the difference between its own colour and all it hides. Walking from back to front, (4)
// needs one colour as its whole memory, no division and no difference of large sums.
//
// Tiles only save time: the list of a tile holds every splat that can reach one of its pixels. They are independent of
// each other and may run on many threads; gradients are first summed per tile, then over the tiles in their order, so
// the sum does not depend on the threads.
#include "splat3d/reference.h"

#include "lab/base/mem.h"
#include "lab/base/parallel.h"

#include <math.h>
#include <stdlib.h>

typedef struct {
    double depth;
    int index;
} DepthKey;

// One tile: its pixels x0 <= i < x1, y0 <= j < y1 and the splats that can reach them, front to back.
typedef struct {
    int x0, y0, x1, y1;
    int count;
    int *list;                // (count) indices of splats
    Splat2Gradient *d_splats; // (count) gradients from this tile's pixels; backward only
} Tile;

// What all tiles share.
typedef struct {
    const Splat2 *splats;
    DepthKey *order; // (visible) front to back
    int visible;
    CompositeRule rule;
    double background[3];
    int width, height, tiles_x, tiles_y;
    PictureD *picture;   // forward only
    const double *d_rgb; // backward only
    Tile *tiles;         // backward only: (tiles_x * tiles_y)
} Frame;

static int by_depth_then_index(const void *a, const void *b) {
    const DepthKey *p = a, *q = b;
    if (p->depth != q->depth) return p->depth < q->depth ? -1 : 1;
    return (p->index > q->index) - (p->index < q->index);
}

static Frame frame_create(const Splat2 *splats, int count, const RenderSettings *settings, int width, int height) {
    Frame frame = {.splats = splats, .width = width, .height = height, .rule = composite_rule_default()};
    frame.rule.alpha_max = (double)settings->alpha_max;
    frame.rule.rule = settings->stop_rule;
    for (int c = 0; c < 3; c++) frame.background[c] = (double)settings->background[c];
    frame.tiles_x = (width + TILE_SIZE - 1) / TILE_SIZE;
    frame.tiles_y = (height + TILE_SIZE - 1) / TILE_SIZE;
    frame.order = mem_alloc((size_t)count, sizeof(DepthKey));
    for (int i = 0; i < count; i++)
        if (splats[i].visible) frame.order[frame.visible++] = (DepthKey){splats[i].depth, i};
    qsort(frame.order, (size_t)frame.visible, sizeof(DepthKey), by_depth_then_index);
    return frame;
}

static void frame_destroy(Frame *frame) { mem_free(frame->order); }

// Tile edges lie half a pixel outside of the outermost pixel centres, so rounding of the reach never leaves a splat
// out.
static bool reaches_tile(const Splat2 *s, const Tile *tile) {
    return s->mean_px[0] + s->reach_px[0] > tile->x0 && s->mean_px[0] - s->reach_px[0] < tile->x1 &&
           s->mean_px[1] + s->reach_px[1] > tile->y0 && s->mean_px[1] - s->reach_px[1] < tile->y1;
}

static int smaller(int a, int b) { return a < b ? a : b; }

static Tile tile_create(const Frame *frame, int number) {
    Tile tile = {.x0 = number % frame->tiles_x * TILE_SIZE, .y0 = number / frame->tiles_x * TILE_SIZE};
    tile.x1 = smaller(tile.x0 + TILE_SIZE, frame->width);
    tile.y1 = smaller(tile.y0 + TILE_SIZE, frame->height);
    tile.list = mem_alloc((size_t)frame->visible, sizeof(int));
    for (int k = 0; k < frame->visible; k++)
        if (reaches_tile(&frame->splats[frame->order[k].index], &tile)) tile.list[tile.count++] = frame->order[k].index;
    tile.list = mem_resize(tile.list, (size_t)frame->visible, (size_t)tile.count, sizeof(int));
    return tile;
}

static void tile_destroy(Tile *tile) {
    mem_free(tile->list);
    mem_free(tile->d_splats);
}

// ---- forward ----

// (1) and (2) without the clamp: exp(-m^2 / 2) at a pixel centre.
static double gaussian_at(const Splat2 *splat, double x, double y) {
    double m2 = conic_mahalanobis2(splat->conic, x - splat->mean_px[0], y - splat->mean_px[1]);
    return exp(-m2 / 2);
}

// (3)
static Composite pixel_forward(const Frame *frame, const Tile *tile, double x, double y) {
    Composite pixel = composite_begin();
    for (int k = 0; k < tile->count && !pixel.opaque; k++) {
        const Splat2 *splat = &frame->splats[tile->list[k]];
        composite_blend(&pixel, &frame->rule, splat->opacity * gaussian_at(splat, x, y), splat->rgb);
    }
    composite_end(&pixel, frame->background);
    return pixel;
}

static void tile_forward(void *context, int number) {
    Frame *frame = context;
    Tile tile = tile_create(frame, number);
    for (int j = tile.y0; j < tile.y1; j++)
        for (int i = tile.x0; i < tile.x1; i++) {
            Composite pixel = pixel_forward(frame, &tile, i + 0.5, j + 0.5);
            size_t at = (size_t)j * (size_t)frame->width + (size_t)i;
            for (int c = 0; c < 3; c++) frame->picture->rgb[3 * at + (size_t)c] = pixel.rgb[c];
            frame->picture->transmittance[at] = pixel.transmittance;
        }
    tile_destroy(&tile);
}

void reference_blend_forward(const Splat2 *splats, int count, const RenderSettings *settings, PictureD *picture) {
    Frame frame = frame_create(splats, count, settings, picture->width, picture->height);
    frame.picture = picture;
    parallel_for(frame.tiles_x * frame.tiles_y, tile_forward, &frame);
    frame_destroy(&frame);
}

// ---- backward ----

// A splat that was blended into the pixel at hand.
typedef struct {
    int k;                // place in the tile's list
    double gaussian;      // exp(-m^2 / 2)
    double transmittance; // T_k, before it
} Layer;

// As pixel_forward(), but notes what was blended, front to back; returns how many.
static int pixel_layers(const Frame *frame, const Tile *tile, double x, double y, Layer *layers) {
    Composite pixel = composite_begin();
    int count = 0;
    for (int k = 0; k < tile->count && !pixel.opaque; k++) {
        const Splat2 *splat = &frame->splats[tile->list[k]];
        Layer layer = {k, gaussian_at(splat, x, y), pixel.transmittance};
        double weight = composite_blend(&pixel, &frame->rule, splat->opacity * layer.gaussian, splat->rgb);
        if (weight > 0) layers[count++] = layer;
    }
    return count;
}

// Through (2) and (1), for an alpha that was not clamped: d alpha / d o = exp(-m^2 / 2), d alpha / d m^2 = -alpha / 2.
static void alpha_backward(const Splat2 *splat, double x, double y, double gaussian, double d_alpha,
                           Splat2Gradient *d_splat) {
    d_splat->opacity += gaussian * d_alpha;
    double d_m2 = -splat->opacity * gaussian / 2 * d_alpha;
    double dx = x - splat->mean_px[0], dy = y - splat->mean_px[1];
    d_splat->conic.xx += d_m2 * dx * dx;
    d_splat->conic.xy += d_m2 * 2 * dx * dy;
    d_splat->conic.yy += d_m2 * dy * dy;
    d_splat->mean_px[0] -= d_m2 * 2 * (splat->conic.xx * dx + splat->conic.xy * dy);
    d_splat->mean_px[1] -= d_m2 * 2 * (splat->conic.xy * dx + splat->conic.yy * dy);
}

// (4) and (5), from the last layer to the first.
static void pixel_backward(const Frame *frame, Tile *tile, double x, double y, const double d_rgb[3],
                           const Layer *layers, int count) {
    double behind[3] = {frame->background[0], frame->background[1], frame->background[2]}; // B_k
    for (int n = count - 1; n >= 0; n--) {
        const Layer *layer = &layers[n];
        const Splat2 *splat = &frame->splats[tile->list[layer->k]];
        Splat2Gradient *d_splat = &tile->d_splats[layer->k];
        double unclamped = splat->opacity * layer->gaussian;
        double alpha = fmin(unclamped, frame->rule.alpha_max);
        double d_alpha = 0;
        for (int c = 0; c < 3; c++) {
            d_splat->rgb[c] += layer->transmittance * alpha * d_rgb[c];
            d_alpha += layer->transmittance * (splat->rgb[c] - behind[c]) * d_rgb[c];
            behind[c] = alpha * splat->rgb[c] + (1 - alpha) * behind[c];
        }
        if (unclamped <= frame->rule.alpha_max) alpha_backward(splat, x, y, layer->gaussian, d_alpha, d_splat);
    }
}

static void tile_backward(void *context, int number) {
    Frame *frame = context;
    Tile tile = tile_create(frame, number);
    tile.d_splats = mem_alloc((size_t)tile.count, sizeof(Splat2Gradient));
    Layer *layers = mem_alloc((size_t)tile.count, sizeof(Layer));
    for (int j = tile.y0; j < tile.y1; j++)
        for (int i = tile.x0; i < tile.x1; i++) {
            int count = pixel_layers(frame, &tile, i + 0.5, j + 0.5, layers);
            const double *d_rgb = frame->d_rgb + 3 * ((size_t)j * (size_t)frame->width + (size_t)i);
            pixel_backward(frame, &tile, i + 0.5, j + 0.5, d_rgb, layers, count);
        }
    mem_free(layers);
    frame->tiles[number] = tile;
}

static void add_gradient(Splat2Gradient *sum, const Splat2Gradient *part) {
    for (int k = 0; k < 2; k++) sum->mean_px[k] += part->mean_px[k];
    sum->conic.xx += part->conic.xx;
    sum->conic.xy += part->conic.xy;
    sum->conic.yy += part->conic.yy;
    sum->opacity += part->opacity;
    for (int c = 0; c < 3; c++) sum->rgb[c] += part->rgb[c];
}

void reference_blend_backward(const Splat2 *splats, int count, const RenderSettings *settings, int width, int height,
                              const double *d_rgb, Splat2Gradient *d_splats) {
    Frame frame = frame_create(splats, count, settings, width, height);
    int tiles = frame.tiles_x * frame.tiles_y;
    frame.d_rgb = d_rgb;
    frame.tiles = mem_alloc((size_t)tiles, sizeof(Tile));
    parallel_for(tiles, tile_backward, &frame);
    for (int t = 0; t < tiles; t++) {
        for (int k = 0; k < frame.tiles[t].count; k++)
            add_gradient(&d_splats[frame.tiles[t].list[k]], &frame.tiles[t].d_splats[k]);
        tile_destroy(&frame.tiles[t]);
    }
    mem_free(frame.tiles);
    frame_destroy(&frame);
}
