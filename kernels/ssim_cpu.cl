// ssim_cpu.cl - the loss (1 - lambda) L1 + lambda (1 - SSIM) and its gradient by the picture in one pass, for devices that are CPUs.
//
// The equations, arguments and sums of ssim_forward_gpu.cl and ssim_backward_gpu.cl (which a GPU runs one after the other), but the maps of
// derivatives never leave the cache. A work-item walks along its panel sixteen columns, a block, at a time, then along the next sixteen
// rows. Every window is a sum of whole vectors: vectors that lie along x are blurred down, then turned (16 x 16 numbers transposed) and
// blurred across; the maps go the same way back.
//
//     rows                   block v-1           block v
//                        |- 16 columns -|    |- 16 columns -|
//     y    .. y+25                           picture, photo     1  read, but the first ten rows, kept from the walk above; products
//     y+5  .. y+20                              moments         2  blurred down, turned
//     y+5  .. y+20              |- 5 ... - maps - ... 10 -|     3  moments blurred across; SSIM and its three derivatives
//     y+5  .. y+20            maps                              4  blurred across, turned back
//     y    .. y+15          gradient                            5  maps blurred down, with ten rows from the walk above
//
// So what one step works on fits into the first-level cache (30 KB), and what the walk along the next rows needs of this one into the
// second (3 KB a block). Only a panel's edges are computed twice: 5 rows and columns of maps, 10 of pictures.
//
//     picture (3, rows, stride), photo (height, stride) RGBA bytes
//     sums (work-items, SSIM_SUMS): of the work-item's own pixels
//     d_picture (3, rows, stride): written everywhere, 0 right of width and below height
//
// One work-item: one panel of one channel; item (panel row * panels in a row + panel column) * 3 + channel. Local memory: none; 240 KB
// of private arrays.
// Reference: splat2d/loss.c. Test: tests/splat3d/test_opencl_loss.c.
#include "ssim_formula.h"
#include "ssim_row.h"

#define SIDE    SSIM_STRIP_WIDTH  // rows and columns of a block
#define WINDOW  (2 * SSIM_RADIUS) // how many more rows or columns a window reads than it gives
#define MOMENTS 4                 // x, y, x^2 + y^2, x y: Moments of ssim_formula.h, plane by plane

// What a work-item does.
typedef struct {
    __global const float *picture; // of its channel
    __global const uint *photo;
    __global float *d_picture; // of its channel
    int channel;
    int begin, end;     // blocks
    int y_begin, y_end; // rows
} Panel;

// What two steps share. Rings of two hold block v at v & 1.
typedef struct {
    float16 colour[2][2][WINDOW + SIDE]; // ring; picture and photo less SSIM_SHIFT
    float16 product[2][WINDOW + SIDE];   // the other two planes of block v
    float16 moment[2][MOMENTS][SIDE];    // ring; blurred down, turned
    float16 map[2][SSIM_MAPS][SIDE];     // ring; turned; 5 columns left of the block
    float16 blurred[SSIM_MAPS][SIDE];    // maps of block v-1, blurred across
} Work;

// Last rows of a block, for the walk below.
typedef struct {
    float16 colour[2][WINDOW];
    float16 blurred[SSIM_MAPS][WINDOW];
} Kept;

typedef struct {
    float16 absolute, square, ssim;
} Sums;

// Vectors that follow each other, in two pieces.
typedef struct {
    const float16 *head, *tail;
    int split; // vectors of head
} Line;

// Inlined and unrolled, so that a line's pieces cost nothing; compilers deem these two functions too long for that.
#define INLINED __attribute__((always_inline)) static

static void copy(const float16 *from, int count, float16 *to) {
    for (int i = 0; i < count; i++) to[i] = from[i];
}

static void fill(float value, int count, float16 *to) {
    for (int i = 0; i < count; i++) to[i] = (float16)(value);
}

// Four neighbouring vectors of a blur, from i on; each of the fourteen that they need is read once. w: weight by distance. Small
// weights first, so that little is rounded away.
INLINED void blur4(const float *w, Line in, int i, float16 *out) {
    float16 v[4 + WINDOW];
#pragma unroll
    for (int k = 0; k < 4 + WINDOW; k++) v[k] = i + k < in.split ? in.head[i + k] : in.tail[i + k - in.split];
#pragma unroll
    for (int k = 0; k < 4; k++) {
        float16 sum = w[5] * (v[k] + v[k + 10]);
        sum = fma(w[4], v[k + 1] + v[k + 9], sum);
        sum = fma(w[3], v[k + 2] + v[k + 8], sum);
        sum = fma(w[2], v[k + 3] + v[k + 7], sum);
        sum = fma(w[1], v[k + 4] + v[k + 6], sum);
        out[k] = fma(w[0], v[k + 5], sum);
    }
}

// Numbers, pairs and quadruples of two vectors in turn, each one instruction.
#define ZIP_LOW(a, b)                                                                                                  \
    as_ulong8((float16)((a).s0, (b).s0, (a).s1, (b).s1, (a).s4, (b).s4, (a).s5, (b).s5, (a).s8, (b).s8, (a).s9,        \
                        (b).s9, (a).sc, (b).sc, (a).sd, (b).sd))
#define ZIP_HIGH(a, b)                                                                                                 \
    as_ulong8((float16)((a).s2, (b).s2, (a).s3, (b).s3, (a).s6, (b).s6, (a).s7, (b).s7, (a).sa, (b).sa, (a).sb,        \
                        (b).sb, (a).se, (b).se, (a).sf, (b).sf))
#define ZIP_EVEN(a, b)   as_float16((ulong8)((a).s0, (b).s0, (a).s2, (b).s2, (a).s4, (b).s4, (a).s6, (b).s6))
#define ZIP_ODD(a, b)    as_float16((ulong8)((a).s1, (b).s1, (a).s3, (b).s3, (a).s5, (b).s5, (a).s7, (b).s7))
#define QUADS_EVEN(a, b) ((float16)((a).s0123, (a).s89ab, (b).s0123, (b).s89ab))
#define QUADS_ODD(a, b)  ((float16)((a).s4567, (a).scdef, (b).s4567, (b).scdef))

// Sixteen vectors of a blur, turned: out[j] has number j of each.
INLINED void blur_and_turn(const float *w, Line in, float16 *out) {
    float16 part[4][4]; // [c][i]: columns c, c+4, c+8, c+12 of vectors 4i .. 4i+3
#pragma unroll
    for (int i = 0; i < 4; i++) {
        float16 v[4];
        blur4(w, in, 4 * i, v);
        const ulong8 a = ZIP_LOW(v[0], v[1]), b = ZIP_HIGH(v[0], v[1]);
        const ulong8 c = ZIP_LOW(v[2], v[3]), d = ZIP_HIGH(v[2], v[3]);
        part[0][i] = ZIP_EVEN(a, c);
        part[1][i] = ZIP_ODD(a, c);
        part[2][i] = ZIP_EVEN(b, d);
        part[3][i] = ZIP_ODD(b, d);
    }
    for (int i = 0; i < 4; i++) {
        const float16 *v = part[i];
        const float16 a = QUADS_EVEN(v[0], v[1]), b = QUADS_ODD(v[0], v[1]);
        const float16 c = QUADS_EVEN(v[2], v[3]), d = QUADS_ODD(v[2], v[3]);
        out[i] = QUADS_EVEN(a, c);
        out[i + 4] = QUADS_EVEN(b, d);
        out[i + 8] = QUADS_ODD(a, c);
        out[i + 12] = QUADS_ODD(b, d);
    }
}

static void put_colours(float16 p, float16 q, int row, int newest, Work *work) {
    work->colour[newest][0][row] = p;
    work->colour[newest][1][row] = q;
    work->product[0][row] = fma(p, p, q * q);
    work->product[1][row] = p * q;
}

// Step 1 for block v, from row y on; row: how many rows are kept.
static void read_block(const SsimRecord *s, const Panel *panel, int v, int y, int row, Kept *kept, Work *work) {
    const int x = v * SIDE, newest = v & 1;
    for (int i = 0; i < row; i++) put_colours(kept->colour[0][i], kept->colour[1][i], i, newest, work);
    for (; row < WINDOW + SIDE; row++) {
        float16 p = (float16)(0.0f), q = (float16)(0.0f); // outside the picture
        if (y + row >= 0 && y + row < s->height) {
            __global const float *picture = panel->picture + (y + row) * s->stride;
            __global const uint *photo = panel->photo + (y + row) * s->stride;
            PREFETCH(picture + x + SSIM_COLUMNS_AHEAD);
            PREFETCH(photo + x + SSIM_COLUMNS_AHEAD);
            p = ssim_picture16(picture, x, s);
            q = ssim_photo16(photo, x, s, panel->channel);
        }
        put_colours(p - SSIM_SHIFT, q - SSIM_SHIFT, row, newest, work);
    }
    for (int k = 0; k < 2; k++) copy(work->colour[newest][k] + SIDE, WINDOW, kept->colour[k]);
}

// Step 2 for block v.
static void make_moments(const SsimRecord *s, int v, Work *work) {
    const float outside[MOMENTS] = {-SSIM_SHIFT, -SSIM_SHIFT, 2 * SSIM_SHIFT * SSIM_SHIFT, SSIM_SHIFT * SSIM_SHIFT};
    for (int k = 0; k < MOMENTS; k++) {
        const float16 *plane = k < 2 ? work->colour[v & 1][k] : work->product[k - 2];
        const Line line = {plane, plane, WINDOW + SIDE};
        if (v >= 0 && v < s->stride / SIDE)
            blur_and_turn(s->window, line, work->moment[v & 1][k]);
        else
            fill(outside[k], SIDE, work->moment[v & 1][k]);
    }
}

// Step 3 for the sixteen columns that block v completes, of the rows from y on.
static void make_maps(const SsimRecord *s, const Panel *panel, int v, int y, Work *work, Sums *sums) {
    const int newest = v & 1;
    const int16 row = ssim_columns(y); // lanes are rows here
    const float16 zero = (float16)(0.0f), one = (float16)(1.0f);
    const float16 row_inside = select(zero, one, row >= 0 && row < s->height);
    float16 sum = zero;
#pragma unroll
    for (int i = 0; i < SIDE; i += 4) {
        float16 blurred[MOMENTS][4];
        for (int k = 0; k < MOMENTS; k++) {
            const Line line = {work->moment[!newest][k] + SIDE - WINDOW, work->moment[newest][k], WINDOW};
            blur4(s->window, line, i, blurred[k]);
        }
        for (int j = 0; j < 4; j++) {
            const int x = v * SIDE - SSIM_RADIUS + i + j;
            const float16 inside = x >= 0 && x < s->width ? row_inside : zero;
            const Moments m = {blurred[0][j], blurred[1][j], blurred[2][j], blurred[3][j]};
            float16(*map)[SIDE] = work->map[newest];
            const float16 ssim = ssim_at(m, inside, &map[0][i + j], &map[1][i + j], &map[2][i + j]);
            if (x >= panel->begin * SIDE && x < panel->end * SIDE) sum += ssim;
        }
    }
    sums->ssim += select(zero, sum, row >= panel->y_begin && row < panel->y_end);
}

// Step 5 for sixteen rows of block v from row y on.
static void make_gradient(const SsimRecord *s, const Panel *panel, int v, int y, const Kept *kept, const Work *work,
                          Sums *sums) {
    const int16 inside = ssim_columns(v * SIDE) < s->width;
#pragma unroll
    for (int i = 0; i < SIDE; i += 4) {
        float16 map[SSIM_MAPS][4];
        for (int k = 0; k < SSIM_MAPS; k++) {
            const Line line = {kept->blurred[k], work->blurred[k], WINDOW};
            blur4(s->window, line, i, map[k]);
        }
        for (int j = 0; j < 4; j++) {
            const int row = y + i + j;
            if (row < panel->y_begin || row >= panel->y_end) continue;
            __global float *out = panel->d_picture + row * s->stride + v * SIDE;
            PREFETCH(out + SSIM_COLUMNS_AHEAD);
            float16 gradient = (float16)(0.0f);
            if (row < s->height) {
                const float16 p = work->colour[v & 1][0][i + j], q = work->colour[v & 1][1][i + j];
                const float16 clipped = clamp(p, 0.0f - SSIM_SHIFT, 1.0f - SSIM_SHIFT) - q;
                sums->absolute += fabs(p - q);
                sums->square = fma(clipped, clipped, sums->square);
                gradient = select(gradient, ssim_gradient(s, map[0][j], map[1][j], map[2][j], p, q), inside);
            }
            *(__global float16 *)out = gradient;
        }
    }
}

// One walk along the panel; y: first row of its windows.
static void walk(const SsimRecord *s, const Panel *panel, int y, Kept *kept, Work *work, Sums *sums) {
    const int rows_kept = y < panel->y_begin ? 0 : WINDOW;
    for (int v = panel->begin - 1; v <= panel->end; v++) {
        if (v >= 0 && v < s->stride / SIDE) read_block(s, panel, v, y, rows_kept, &kept[v - panel->begin + 1], work);
        make_moments(s, v, work);
        if (v < panel->begin) continue;
        make_maps(s, panel, v, y + SSIM_RADIUS, work, sums);
        if (v == panel->begin) continue;
        Kept *above = &kept[v - panel->begin];
        for (int k = 0; k < SSIM_MAPS; k++) {
            const Line line = {work->map[(v - 1) & 1][k], work->map[v & 1][k], SIDE};
            blur_and_turn(s->window, line, work->blurred[k]); // step 4
        }
        make_gradient(s, panel, v - 1, y, above, work, sums);
        for (int k = 0; k < SSIM_MAPS; k++) copy(work->blurred[k] + SIDE - WINDOW, WINDOW, above->blurred[k]);
    }
}

__kernel void ssim_cpu(const SsimRecord s, __global const float *picture, __global const uint *photo,
                       __global float *sums, __global float *d_picture) {
    const int item = (int)get_global_id(0), channel = item % 3;
    const int blocks = s.stride / SIDE, most = SSIM_PANEL_WIDTH / SIDE;
    const int across = (blocks + most - 1) / most, width = (blocks + across - 1) / across; // panels; blocks of each
    const int begin = item / 3 % across * width, y_begin = item / 3 / across * SSIM_PANEL_HEIGHT;
    if (y_begin >= s.rows) return;
    const size_t plane = (size_t)channel * s.rows * s.stride;
    const Panel panel = {.picture = picture + plane,
                         .photo = photo,
                         .d_picture = d_picture + plane,
                         .channel = channel,
                         .begin = begin,
                         .end = min(begin + width, blocks),
                         .y_begin = y_begin,
                         .y_end = min(y_begin + SSIM_PANEL_HEIGHT, s.rows)};
    Work work;
    Kept kept[SSIM_PANEL_WIDTH / SIDE + 2]; // blocks begin-1 .. end
    for (int i = 0; i < width + 2; i++)
        for (int k = 0; k < SSIM_MAPS; k++) fill(0.0f, WINDOW, kept[i].blurred[k]);
    Sums sum = {(float16)(0.0f), (float16)(0.0f), (float16)(0.0f)};
    for (int y = y_begin - WINDOW; y < panel.y_end; y += SIDE) walk(&s, &panel, y, kept, &work, &sum);
    sums[item * SSIM_SUMS] = ssim_lane_sum(sum.absolute);
    sums[item * SSIM_SUMS + 1] = ssim_lane_sum(sum.square);
    sums[item * SSIM_SUMS + 2] = ssim_lane_sum(sum.ssim);
}
