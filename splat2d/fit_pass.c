// fit_pass.c - bands of rows, and the lists of blobs that touch them.
#include "splat2d/fit_pass.h"

#include "lab/base/mem.h"
#include "lab/base/parallel.h"
#include "splat2d/fit_rows.h"

#include <assert.h>
#include <string.h>

enum { BAND_ROWS = 16 };
_Static_assert((int)FIT_PARAMETERS == (int)FIT_FIELDS, "the header names the fields that fit_rows.h defines");

struct FitPass {
    int width, height, bands;
    Planes3 state;            // of each pixel: T in plane 0, `last` in plane 1
    Planes3 behind;           // backward: the colour behind
    int count;                // blobs of the pass that is under way
    FitBlob *blobs;           // (blob_capacity)
    double (*sums)[FIT_SUMS]; // (blob_capacity)
    int blob_capacity;
    int *band_start;    // (bands + 1): where the list of each band begins in pair_blob
    int *pair_blob;     // (pair_capacity) front to back within a band
    FitSums *pair_sums; // (pair_capacity)
    int pair_capacity;
    double background[3];
    Planes3 *picture;
    const Planes3 *d_picture;
};

FitPass *fit_pass_create(int width, int height) {
    FitPass *pass = mem_alloc(1, sizeof *pass);
    pass->width = width;
    pass->height = height;
    pass->bands = (height + BAND_ROWS - 1) / BAND_ROWS;
    pass->state = planes3_create(width, height);
    pass->behind = planes3_create(width, height);
    pass->band_start = mem_alloc((size_t)pass->bands + 1, sizeof *pass->band_start);
    return pass;
}

void fit_pass_destroy(FitPass *pass) {
    if (!pass) return;
    planes3_destroy(&pass->state);
    planes3_destroy(&pass->behind);
    mem_free(pass->blobs);
    mem_free(pass->sums);
    mem_free(pass->band_start);
    mem_free(pass->pair_blob);
    mem_free(pass->pair_sums);
    mem_free(pass);
}

// ---- lists ----

static void reserve_blobs(FitPass *pass, int count) {
    if (count <= pass->blob_capacity) return;
    mem_free(pass->blobs);
    mem_free(pass->sums);
    pass->blobs = mem_alloc((size_t)count, sizeof *pass->blobs);
    pass->sums = mem_alloc((size_t)count, sizeof *pass->sums);
    pass->blob_capacity = count;
}

static void reserve_pairs(FitPass *pass, int count) {
    if (count <= pass->pair_capacity) return;
    mem_free(pass->pair_blob);
    mem_free(pass->pair_sums);
    pass->pair_capacity = count + count / 4;
    pass->pair_blob = mem_alloc((size_t)pass->pair_capacity, sizeof *pass->pair_blob);
    pass->pair_sums = mem_alloc((size_t)pass->pair_capacity, sizeof *pass->pair_sums);
}

// A counting sort of (band, blob) pairs by band; blobs go in from the front, so each list comes out in that order.
static void list_pairs(FitPass *pass) {
    int *start = pass->band_start;
    for (int band = 0; band <= pass->bands; band++) start[band] = 0;
    for (const FitBlob *blob = pass->blobs; blob < pass->blobs + pass->count; blob++)
        for (int band = blob->row_from / BAND_ROWS; band * BAND_ROWS < blob->row_to; band++) start[band + 1]++;
    for (int band = 0; band < pass->bands; band++) start[band + 1] += start[band];
    reserve_pairs(pass, start[pass->bands]);
    for (int i = 0; i < pass->count; i++) {
        const FitBlob *blob = &pass->blobs[i];
        for (int band = blob->row_from / BAND_ROWS; band * BAND_ROWS < blob->row_to; band++)
            pass->pair_blob[start[band]++] = i;
    }
    for (int band = pass->bands; band > 0; band--) start[band] = start[band - 1]; // each was moved on to its end
    start[0] = 0;
}

// ---- rows ----

static FitRow row_at(const FitPass *pass, int y) {
    FitRow row = {.transmittance = planes3_row(&pass->state, 0, y), .last = planes3_row(&pass->state, 1, y)};
    for (int c = 0; c < 3; c++) {
        row.rgb[c] = planes3_row(pass->picture, c, y);
        row.behind[c] = planes3_row(&pass->behind, c, y);
        row.d_rgb[c] = pass->d_picture ? planes3_row(pass->d_picture, c, y) : NULL;
    }
    return row;
}

static int band_end(const FitPass *pass, int band) {
    int end = (band + 1) * BAND_ROWS;
    return end < pass->height ? end : pass->height;
}

static void band_forward(void *context, int band) {
    const FitPass *pass = context;
    const int *list = pass->pair_blob + pass->band_start[band];
    int length = pass->band_start[band + 1] - pass->band_start[band], lanes_width = planes3_lanes_width(pass->picture);
    for (int y = band * BAND_ROWS; y < band_end(pass, band); y++) {
        FitRow row = row_at(pass, y);
        row_begin(&row, lanes_width);
        for (int k = 0; k < length; k++) row_forward(&row, y, pass->width, &pass->blobs[list[k]], k);
        row_end(&row, pass->width, pass->background);
        for (int c = 0; c < 3; c++) planes3_clear_margin(pass->picture, c, y);
    }
}

static void band_backward(void *context, int band) {
    const FitPass *pass = context;
    const int *list = pass->pair_blob + pass->band_start[band];
    FitSums *sums = pass->pair_sums + pass->band_start[band];
    int length = pass->band_start[band + 1] - pass->band_start[band], lanes_width = planes3_lanes_width(pass->picture);
    for (int k = 0; k < length; k++) sums[k] = (FitSums){0};
    for (int y = band * BAND_ROWS; y < band_end(pass, band); y++) {
        FitRow row = row_at(pass, y);
        row_begin_backward(&row, lanes_width, pass->background);
        for (int k = length - 1; k >= 0; k--) row_backward(&row, y, pass->width, &pass->blobs[list[k]], k, &sums[k]);
    }
}

// ---- the pass ----

static void gather(const double *from, int count, int blob, double p[FIT_FIELDS]) {
    for (int field = 0; field < FIT_FIELDS; field++) p[field] = from[field * (ptrdiff_t)count + blob];
}

void fit_pass_forward(FitPass *pass, int count, const double *parameters, const double background[3],
                      Planes3 *picture) {
    assert(picture->width == pass->width && picture->height == pass->height);
    reserve_blobs(pass, count);
    pass->count = count;
    for (int i = 0; i < count; i++) {
        double p[FIT_FIELDS];
        gather(parameters, count, i, p);
        pass->blobs[i] = blob_forward(p, pass->height);
    }
    list_pairs(pass);
    for (int c = 0; c < 3; c++) pass->background[c] = background[c];
    pass->picture = picture;
    pass->d_picture = NULL;
    parallel_for(pass->bands, band_forward, pass);
}

void fit_pass_backward(FitPass *pass, const double *parameters, const Planes3 *d_picture, double *d_parameters) {
    pass->d_picture = d_picture;
    parallel_for(pass->bands, band_backward, pass);

    // Each blob's sums over the bands, in their order; the pairs' lists are not sorted by blob, so each pair adds to its blob's.
    int count = pass->count;
    double(*sums)[FIT_SUMS] = pass->sums;
    memset(sums, 0, (size_t)count * sizeof *sums);
    for (int pair = 0; pair < pass->band_start[pass->bands]; pair++)
        for (int k = 0; k < FIT_SUMS; k++)
            sums[pass->pair_blob[pair]][k] += (double)lanes_sum(pass->pair_sums[pair].sum[k]);
    for (int i = 0; i < count; i++) {
        double p[FIT_FIELDS], d_p[FIT_FIELDS];
        gather(parameters, count, i, p);
        blob_backward(p, sums[i], d_p);
        for (int field = 0; field < FIT_FIELDS; field++) d_parameters[field * (ptrdiff_t)count + i] = d_p[field];
    }
}
