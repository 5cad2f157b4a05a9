// fit_loss.c - L1 + D-SSIM in four passes over rows, because a blur along columns needs its neighbours' blur along rows
// to be done. The formulas are those of loss.c, where they are derived:
//     1  along rows:     w * x, w * x^2, w * (x y)
//     2  along columns:  the same finished; SSIM and its derivatives a, b, c by the three
//     3  along rows:     w * a, w * b, w * c
//     4  along columns:  d SSIM / d x = w * a + 2 x (w * b) + y (w * c); L1 and its sign
#include "splat2d/fit_loss.h"

#include "kernels/shared.h"
#include "lab/base/mem.h"
#include "lab/base/parallel.h"
#include "splat2d/lanes.h"

#include <assert.h>

enum {
    CHANNELS = PLANES3_CHANNELS,
    TAPS = SSIM_RADIUS + 1, // the window is symmetric: tap k stands for -k and k
    ROWS_A_TASK = 16,
};

struct FitLoss {
    int width, height;
    double lambda;
    float window[TAPS];
    Planes3 photo;             // y
    Planes3 mean_y, square_y;  // w * y, w * y^2
    Planes3 blurred[3];        // along rows only: of x, x^2, x y; later of a, b, c
    Planes3 derivatives[3];    // a, b, c
    double *row_l1, *row_ssim; // (height * CHANNELS)
    const Planes3 *picture;    // of this evaluation
    Planes3 *d_picture;
};

static void fill_window(float window[TAPS]) {
    double sum = 0, taps[TAPS];
    for (int k = 0; k < TAPS; k++) {
        taps[k] = exp(-k * k / (2.0 * (double)SSIM_SIGMA * (double)SSIM_SIGMA));
        sum += k ? 2 * taps[k] : taps[k];
    }
    for (int k = 0; k < TAPS; k++) window[k] = (float)(taps[k] / sum);
}

// The window over neighbours at distance `stride` of pixels at, at + 1, ...
static inline Lanes blur(const float window[TAPS], const float *at, ptrdiff_t stride) {
    Lanes sum = window[0] * lanes_load(at);
    for (int k = 1; k < TAPS; k++) sum += window[k] * (lanes_load(at - k * stride) + lanes_load(at + k * stride));
    return sum;
}

static void pass_along_rows(FitLoss *loss, int channel, int row) {
    const float *x = planes3_row(loss->picture, channel, row), *y = planes3_row(&loss->photo, channel, row);
    float *hx = planes3_row(&loss->blurred[0], channel, row), *hxx = planes3_row(&loss->blurred[1], channel, row),
          *hxy = planes3_row(&loss->blurred[2], channel, row);
    for (int i = 0; i < loss->width; i += LANES) {
        Lanes sum = loss->window[0] * lanes_load(x + i);
        Lanes squares = sum * lanes_load(x + i), products = sum * lanes_load(y + i);
        for (int k = 1; k < TAPS; k++) {
            Lanes left = lanes_load(x + i - k), right = lanes_load(x + i + k);
            sum += loss->window[k] * (left + right);
            squares += loss->window[k] * (left * left + right * right);
            products += loss->window[k] * (left * lanes_load(y + i - k) + right * lanes_load(y + i + k));
        }
        lanes_store(hx + i, sum);
        lanes_store(hxx + i, squares);
        lanes_store(hxy + i, products);
    }
}

// SSIM of pixels i, i + 1, ... and its derivatives by mx, xx and xy; see ssim_at() in loss.c.
static inline Lanes ssim_lanes(Lanes mx, Lanes xx, Lanes xy, Lanes my, Lanes yy, Lanes d[3]) {
    Lanes light = 2 * mx * my + SSIM_C1, light_norm = mx * mx + my * my + SSIM_C1;
    Lanes structure = 2 * (xy - mx * my) + SSIM_C2, structure_norm = (xx - mx * mx) + (yy - my * my) + SSIM_C2;
    Lanes inverse = 1 / (light_norm * structure_norm);
    Lanes ssim = light * structure * inverse;
    Lanes d_light_norm = -ssim / light_norm, d_structure_norm = -ssim / structure_norm;
    d[0] = 2 * my * inverse * (structure - light) + 2 * mx * (d_light_norm - d_structure_norm);
    d[1] = d_structure_norm;
    d[2] = 2 * light * inverse;
    return ssim;
}

static void pass_ssim(FitLoss *loss, int channel, int row) {
    const float *h[3], *my = planes3_row(&loss->mean_y, channel, row), *yy = planes3_row(&loss->square_y, channel, row);
    float *d_row[3];
    for (int k = 0; k < 3; k++) {
        h[k] = planes3_row(&loss->blurred[k], channel, row);
        d_row[k] = planes3_row(&loss->derivatives[k], channel, row);
    }
    ptrdiff_t stride = loss->photo.stride;
    double sum = 0;
    for (int i = 0; i < loss->width; i += LANES) {
        Lanes d[3], ssim = ssim_lanes(blur(loss->window, h[0] + i, stride), blur(loss->window, h[1] + i, stride),
                                      blur(loss->window, h[2] + i, stride), lanes_load(my + i), lanes_load(yy + i), d);
        for (int lane = 0; lane < LANES && i + lane < loss->width; lane++) sum += (double)ssim[lane];
        for (int k = 0; k < 3; k++) lanes_store(d_row[k] + i, d[k]);
    }
    loss->row_ssim[channel * loss->height + row] = sum;
    for (int k = 0; k < 3; k++) planes3_clear_margin(&loss->derivatives[k], channel, row);
}

static void pass_derivatives_along_rows(FitLoss *loss, int channel, int row) {
    for (int k = 0; k < 3; k++) {
        const float *from = planes3_row(&loss->derivatives[k], channel, row);
        float *to = planes3_row(&loss->blurred[k], channel, row);
        for (int i = 0; i < loss->width; i += LANES) lanes_store(to + i, blur(loss->window, from + i, 1));
    }
}

static void pass_gradient(FitLoss *loss, int channel, int row) {
    const float *x = planes3_row(loss->picture, channel, row), *y = planes3_row(&loss->photo, channel, row);
    const float *h[3];
    for (int k = 0; k < 3; k++) h[k] = planes3_row(&loss->blurred[k], channel, row);
    float *d_row = planes3_row(loss->d_picture, channel, row);
    ptrdiff_t stride = loss->photo.stride;
    double values = (double)CHANNELS * loss->width * loss->height, sum = 0;
    const float l1_share = (float)((1 - loss->lambda) / values), ssim_share = (float)(loss->lambda / values);
    for (int i = 0; i < loss->width; i += LANES) {
        Lanes at_x = lanes_load(x + i), at_y = lanes_load(y + i), difference = at_x - at_y;
        Lanes d_ssim = blur(loss->window, h[0] + i, stride) + 2 * at_x * blur(loss->window, h[1] + i, stride) +
                       at_y * blur(loss->window, h[2] + i, stride);
        Lanes sign = lanes_only(difference > 0, lanes_all(1)) - lanes_only(difference < 0, lanes_all(1));
        lanes_store(d_row + i, l1_share * sign - ssim_share * d_ssim);
        sum += (double)lanes_sum(lanes_where(difference < 0, -difference, difference)); // 0 in the margin
    }
    loss->row_l1[channel * loss->height + row] = sum;
    planes3_clear_margin(loss->d_picture, channel, row);
}

// ---- passes over all rows ----

typedef void RowPass(FitLoss *loss, int channel, int row);

typedef struct {
    FitLoss *loss;
    RowPass *pass;
} Pass;

static void run_task(void *context, int task) {
    const Pass *pass = context;
    int height = pass->loss->height, tasks = (height + ROWS_A_TASK - 1) / ROWS_A_TASK;
    int from = task % tasks * ROWS_A_TASK, to = from + ROWS_A_TASK < height ? from + ROWS_A_TASK : height;
    for (int row = from; row < to; row++) pass->pass(pass->loss, task / tasks, row);
}

static void run_pass(FitLoss *loss, RowPass *function) {
    Pass pass = {loss, function};
    parallel_for(CHANNELS * ((loss->height + ROWS_A_TASK - 1) / ROWS_A_TASK), run_task, &pass);
}

static void pass_photo(FitLoss *loss, int channel, int row) {
    float *my = planes3_row(&loss->mean_y, channel, row), *yy = planes3_row(&loss->square_y, channel, row);
    ptrdiff_t stride = loss->photo.stride;
    for (int i = 0; i < loss->width; i += LANES) {
        lanes_store(my + i, blur(loss->window, planes3_row(&loss->blurred[0], channel, row) + i, stride));
        lanes_store(yy + i, blur(loss->window, planes3_row(&loss->blurred[1], channel, row) + i, stride));
    }
}

FitLoss *fit_loss_create(const ImageF *photo, double lambda) {
    assert(photo->channels == CHANNELS);
    FitLoss *loss = mem_alloc(1, sizeof *loss);
    int width = loss->width = photo->width, height = loss->height = photo->height;
    loss->lambda = lambda;
    fill_window(loss->window);
    Planes3 *planes[] = {&loss->photo, &loss->mean_y, &loss->square_y};
    for (int k = 0; k < 3; k++) {
        *planes[k] = planes3_create(width, height);
        loss->blurred[k] = planes3_create(width, height);
        loss->derivatives[k] = planes3_create(width, height);
    }
    loss->row_l1 = mem_alloc((size_t)height * CHANNELS, sizeof(double));
    loss->row_ssim = mem_alloc((size_t)height * CHANNELS, sizeof(double));
    planes3_from_image(&loss->photo, photo);
    loss->picture = &loss->photo;
    run_pass(loss, pass_along_rows);
    run_pass(loss, pass_photo);
    return loss;
}

void fit_loss_destroy(FitLoss *loss) {
    if (!loss) return;
    Planes3 *planes[] = {&loss->photo, &loss->mean_y, &loss->square_y};
    for (int k = 0; k < 3; k++) {
        planes3_destroy(planes[k]);
        planes3_destroy(&loss->blurred[k]);
        planes3_destroy(&loss->derivatives[k]);
    }
    mem_free(loss->row_l1);
    mem_free(loss->row_ssim);
    mem_free(loss);
}

Loss fit_loss_evaluate(FitLoss *loss, const Planes3 *picture, Planes3 *d_picture) {
    assert(picture->width == loss->width && picture->height == loss->height);
    loss->picture = picture;
    loss->d_picture = d_picture;
    run_pass(loss, pass_along_rows);
    run_pass(loss, pass_ssim);
    run_pass(loss, pass_derivatives_along_rows);
    run_pass(loss, pass_gradient);
    Loss result = {0};
    double values = (double)CHANNELS * loss->width * loss->height;
    for (int i = 0; i < CHANNELS * loss->height; i++) {
        result.l1 += loss->row_l1[i] / values;
        result.ssim += loss->row_ssim[i] / values;
    }
    result.total = (1 - loss->lambda) * result.l1 + loss->lambda * (1 - result.ssim);
    return result;
}
