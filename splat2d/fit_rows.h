// fit_rows.h - what a fit does with one row of pixels: forward to colours, and back from their gradients to sums per blob.
//
// One blob, d = (dx, dy) from its mean, u and v along its axes:
//     u = c dx + s dy,  v = -s dx + c dy,   ln alpha = ln opacity - (u^2 / sx^2 + v^2 / sy^2) / 2.
// Every parameter of shape and place reaches the picture through ln alpha alone, and ln alpha is a polynomial in dx, dy.
// So six sums over the pixels, of W = d loss / d ln alpha times 1, dx, dy, dx^2, dx dy, dy^2, hold all that its gradient
// needs; blob_backward() turns them into derivatives once per blob instead of once per pixel.
//
// Back to front: with T before a blob and B the colour of all behind it (background included), C = T (alpha c +
// (1 - alpha) B) + what is in front, so d loss / d alpha = T (c - B) . d loss / d C. T before it is T behind it divided by
// 1 - alpha; alpha <= 0.99, so nothing is lost.
//
// This header is code, compiled twice: with floats for fitting, with doubles for the test of its gradients.
#ifndef SPLATLAB_SPLAT2D_FIT_ROWS_H
#define SPLATLAB_SPLAT2D_FIT_ROWS_H

#include "kernels/shared.h"
#include "splat2d/lanes.h"

// The numbers that a fit moves, per blob, as adam_step() wants them: each field of all blobs in a row.
enum {
    FIT_MEAN_X,
    FIT_MEAN_Y,
    FIT_LOG_SX,
    FIT_LOG_SY,
    FIT_THETA,
    FIT_OPACITY_LOGIT,
    FIT_RGB,
    FIT_FIELDS = FIT_RGB + 3
};

// A blob ready to be drawn.
typedef struct {
    double mean[2];                  // px
    double conic_xx, conic_xy;       // 1 / px^2
    double determinant;              // of the conic
    double reach2;                   // alpha >= ALPHA_MIN where m^2 <= reach2; < 0: nowhere
    int row_from, row_to;            // rows that it can touch
    Real along_x, along_xy, along_y; // log2 alpha = along_x dx^2 + along_xy dx dy + along_y dy^2 + log2_opacity
    Real log2_opacity;
    Real rgb[3];
} FitBlob;

enum { SUM_1, SUM_X, SUM_Y, SUM_XX, SUM_XY, SUM_YY, SUM_RGB, FIT_SUMS = SUM_RGB + 3 };

// What one blob has collected from the pixels; still a number per lane.
typedef struct {
    Lanes sum[FIT_SUMS];
} FitSums;

// A row of pixels: pointers to where it begins in planes whose rows are padded to whole Lanes.
typedef struct {
    Real *rgb[3];         // with background
    Real *transmittance;  // T_end
    Real *last;           // 1 + position of the last blended blob in the list, 0: none
    const Real *d_rgb[3]; // backward only: d loss / d rgb
    Real *behind[3];      // backward only: scratch of a row
} FitRow;

static inline FitBlob blob_forward(const double p[FIT_FIELDS], int height) {
    double c = cos(p[FIT_THETA]), s = sin(p[FIT_THETA]);
    double x2 = exp(-2 * p[FIT_LOG_SX]), y2 = exp(-2 * p[FIT_LOG_SY]); // 1 / sigma^2
    double opacity = 1 / (1 + exp(-p[FIT_OPACITY_LOGIT]));
    double yy = s * s * x2 + c * c * y2;
    FitBlob blob = {.mean = {p[FIT_MEAN_X], p[FIT_MEAN_Y]},
                    .conic_xx = c * c * x2 + s * s * y2,
                    .conic_xy = c * s * (x2 - y2),
                    .determinant = x2 * y2,
                    .reach2 = 2 * log(opacity / (double)ALPHA_MIN),
                    .log2_opacity = (Real)log2(opacity)};
    blob.along_x = (Real)(-M_LOG2E / 2 * blob.conic_xx);
    blob.along_xy = (Real)(-M_LOG2E * blob.conic_xy);
    blob.along_y = (Real)(-M_LOG2E / 2 * yy);
    for (int k = 0; k < 3; k++) blob.rgb[k] = (Real)p[FIT_RGB + k];
    if (blob.reach2 <= 0) return blob;
    double half = sqrt(blob.reach2 * blob.conic_xx / blob.determinant);
    double from = fmax(0, blob.mean[1] - half - 1), to = fmin(height, blob.mean[1] + half + 1);
    if (from < to) blob.row_from = (int)from, blob.row_to = (int)to;
    return blob;
}

// The pixels of a row that the blob can touch: from (a multiple of LANES) up to below *to.
static inline bool fit_span(const FitBlob *blob, int row, int width, int *from, int *to) {
    double dy = row + 0.5 - blob->mean[1];
    double room = blob->conic_xx * blob->reach2 - blob->determinant * dy * dy;
    if (row < blob->row_from || row >= blob->row_to || !(room >= 0)) return false;
    double middle = blob->mean[0] - blob->conic_xy * dy / blob->conic_xx, half = sqrt(room) / blob->conic_xx;
    *from = (int)fmin(width, fmax(0, middle - half - 1)) / LANES * LANES;
    *to = (int)fmax(0, fmin(width, middle + half + 1));
    return *from < *to;
}

// alpha of pixels i, i + 1, ... before clamping, and their dx; the same bits forward and backward.
static inline Lanes fit_alpha(const FitBlob *blob, Real dy, Lanes dx) {
    return lanes_exp2((blob->along_x * dx + blob->along_xy * dy) * dx + (blob->along_y * dy * dy + blob->log2_opacity));
}

static inline void row_begin(FitRow *row, int width) {
    for (int i = 0; i < width; i++) {
        row->rgb[0][i] = row->rgb[1][i] = row->rgb[2][i] = row->last[i] = 0;
        row->transmittance[i] = 1;
    }
}

// Blends the blob, at that position of the row's list, behind what is there.
static inline void row_forward(FitRow *row, int y, int width, const FitBlob *blob, int position) {
    int from, to;
    if (!fit_span(blob, y, width, &from, &to)) return;
    const Real dy = (Real)(y + 0.5 - blob->mean[1]), r = blob->rgb[0], g = blob->rgb[1], b = blob->rgb[2];
    const FitBlob own = *blob;
    const FitRow at = *row;
    Lanes dx = lanes_count_from((Real)(from + 0.5 - blob->mean[0]));
    for (int i = from; i < to; i += LANES, dx += (Real)LANES) {
        Lanes before = lanes_load(at.transmittance + i);
        Lanes alpha = fit_alpha(&own, dy, dx);
        Mask blended = (alpha >= ALPHA_MIN) & (before >= TRANSMITTANCE_STOP);
        alpha = lanes_only(blended, lanes_min(alpha, lanes_all(ALPHA_MAX)));
        Lanes weight = before * alpha;
        lanes_store(at.rgb[0] + i, lanes_load(at.rgb[0] + i) + weight * r);
        lanes_store(at.rgb[1] + i, lanes_load(at.rgb[1] + i) + weight * g);
        lanes_store(at.rgb[2] + i, lanes_load(at.rgb[2] + i) + weight * b);
        lanes_store(at.transmittance + i, before * (1 - alpha));
        lanes_store(at.last + i, lanes_where(blended, lanes_all((Real)(position + 1)), lanes_load(at.last + i)));
    }
}

// Adds T_end background.
static inline void row_end(FitRow *row, int width, const double background[3]) {
    for (int c = 0; c < 3; c++)
        for (int i = 0; i < width; i++) row->rgb[c][i] += row->transmittance[i] * (Real)background[c];
}

// To be called before the row's blobs go back; width as in row_begin().
static inline void row_begin_backward(FitRow *row, int width, const double background[3]) {
    for (int c = 0; c < 3; c++)
        for (int i = 0; i < width; i++) row->behind[c][i] = (Real)background[c];
}

// Takes the blob off the row again, from the back: transmittance becomes T before it, `behind` gets its colour.
static inline void row_backward(FitRow *row, int y, int width, const FitBlob *blob, int position, FitSums *sums) {
    int from, to;
    if (!fit_span(blob, y, width, &from, &to)) return;
    const Real dy = (Real)(y + 0.5 - blob->mean[1]);
    const FitBlob own = *blob;
    const FitRow at = *row;
    FitSums own_sums = *sums;
    Lanes dx = lanes_count_from((Real)(from + 0.5 - blob->mean[0]));
    for (int i = from; i < to; i += LANES, dx += (Real)LANES) {
        Lanes alpha = fit_alpha(&own, dy, dx);
        Mask blended = (alpha >= ALPHA_MIN) & (lanes_load(at.last + i) > (Real)position);
        if (!lanes_any(blended)) continue;
        Mask free = blended & (alpha < ALPHA_MAX); // a clamped alpha does not move
        alpha = lanes_only(blended, lanes_min(alpha, lanes_all(ALPHA_MAX)));
        Lanes before = lanes_load(at.transmittance + i) / (1 - alpha);
        lanes_store(at.transmittance + i, before);
        Lanes d_alpha = lanes_all(0);
        for (int c = 0; c < 3; c++) {
            Lanes d = lanes_load(at.d_rgb[c] + i) * before, behind = lanes_load(at.behind[c] + i);
            Lanes step = own.rgb[c] - behind;
            d_alpha += d * step;
            own_sums.sum[SUM_RGB + c] += d * alpha;
            lanes_store(at.behind[c] + i, behind + alpha * step);
        }
        Lanes w = lanes_only(free, alpha * d_alpha), wx = w * dx, wy = w * dy;
        own_sums.sum[SUM_1] += w;
        own_sums.sum[SUM_X] += wx;
        own_sums.sum[SUM_Y] += wy;
        own_sums.sum[SUM_XX] += wx * dx;
        own_sums.sum[SUM_XY] += wx * dy;
        own_sums.sum[SUM_YY] += wy * dy;
    }
    *sums = own_sums;
}

// From the sums over all pixels to the derivatives of the loss by the blob's parameters. The derivatives of ln alpha are
//     by the mean: conic d;   by log sx: u^2 / sx^2;   by log sy: v^2 / sy^2;   by theta: u v (1 / sy^2 - 1 / sx^2);
//     by the opacity's logit: 1 - opacity.
static inline void blob_backward(const double p[FIT_FIELDS], const double sum[FIT_SUMS], double d_p[FIT_FIELDS]) {
    double c = cos(p[FIT_THETA]), s = sin(p[FIT_THETA]);
    double x2 = exp(-2 * p[FIT_LOG_SX]), y2 = exp(-2 * p[FIT_LOG_SY]);
    double xx = c * c * x2 + s * s * y2, xy = c * s * (x2 - y2), yy = s * s * x2 + c * c * y2;
    double uu = c * c * sum[SUM_XX] + 2 * c * s * sum[SUM_XY] + s * s * sum[SUM_YY];
    double vv = s * s * sum[SUM_XX] - 2 * c * s * sum[SUM_XY] + c * c * sum[SUM_YY];
    double uv = c * s * (sum[SUM_YY] - sum[SUM_XX]) + (c * c - s * s) * sum[SUM_XY];
    d_p[FIT_MEAN_X] = xx * sum[SUM_X] + xy * sum[SUM_Y];
    d_p[FIT_MEAN_Y] = xy * sum[SUM_X] + yy * sum[SUM_Y];
    d_p[FIT_LOG_SX] = uu * x2;
    d_p[FIT_LOG_SY] = vv * y2;
    d_p[FIT_THETA] = uv * (y2 - x2);
    d_p[FIT_OPACITY_LOGIT] = sum[SUM_1] / (1 + exp(p[FIT_OPACITY_LOGIT]));
    for (int k = 0; k < 3; k++) d_p[FIT_RGB + k] = sum[SUM_RGB + k];
}

#endif
