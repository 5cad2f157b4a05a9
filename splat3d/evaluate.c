// evaluate.c - renders held-out views, scores them, and lays some of them out for the eye.
#include "splat3d/evaluate.h"

#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/base/parallel.h"
#include "lab/base/progress.h"
#include "splat2d/loss.h"

#include <math.h>
#include <stdio.h>

const char *const EVALUATION_PROTOCOL =
    "held-out views at the size they were read in; display-referred RGB, photographs with alpha over the background; "
    "PSNR = -10 log10(mean squared error over pixels and channels) of the unrounded render clipped to [0, 1]; SSIM "
    "with "
    "an 11x11 Gaussian window, sigma 1.5, zero padded, per channel; means are over views";

enum { ERROR_GAIN = 4, SHEET_GAP_PX = 4, SCORED_AT_ONCE_MAX = 4 };

// Indices of the views to look at: those held out, or all when there is none. Owned by the caller.
static int *list_views(const Dataset *dataset, int *count) {
    int *indices = mem_alloc((size_t)dataset->view_count, sizeof *indices);
    bool all = dataset_held_out_count(dataset) == 0;
    *count = 0;
    for (int i = 0; i < dataset->view_count; i++)
        if (all || dataset->views[i].held_out) indices[(*count)++] = i;
    return indices;
}

// The view's photograph over the background, (H, W, 3).
static bool load_photo(const Dataset *dataset, const View *view, const float background[3], ImageF *photo) {
    Image8 read = {0};
    if (!view->image.bytes && !dataset_read_image(dataset, view, &read)) return false;
    *photo = imagef_over(view->image.bytes ? &view->image : &read, background);
    image8_destroy(&read);
    return true;
}

static void clip(ImageF *image) {
    size_t count = (size_t)image->width * (size_t)image->height * (size_t)image->channels;
    for (size_t i = 0; i < count; i++) image->values[i] = fminf(fmaxf(image->values[i], 0), 1);
}

// What the model shows there, clipped to [0, 1]: (H, W, 3), owned by the caller.
static bool render_view(Rasterizer *rasterizer, const Gaussians *model, const View *view,
                        const RenderSettings *settings, ImageF *render) {
    Picture picture;
    if (!rasterizer_render(rasterizer, model, &view->camera, settings, &picture))
        return fail_context("view %s", view->name);
    *render = picture.rgb;
    picture.rgb = (ImageF){0}; // the caller's now
    picture_destroy(&picture);
    clip(render);
    return true;
}

// The photograph of a view and what the model shows there, both owned by the caller.
static bool show_view(Rasterizer *rasterizer, const Gaussians *model, const Dataset *dataset, const View *view,
                      const RenderSettings *settings, ImageF *photo, ImageF *render) {
    if (!load_photo(dataset, view, settings->background, photo)) return false;
    if (render_view(rasterizer, model, view, settings, render)) return true;
    imagef_destroy(photo);
    return false;
}

static ViewScore score_view(const char *name, const ImageF *photo, const ImageF *render) {
    Image8 bytes = image8_from_float(render);
    ImageF rounded = imagef_from_8(&bytes);
    ViewScore score = {.name = name,
                       .psnr = metric_psnr(render, photo),
                       .ssim = metric_ssim(render, photo),
                       .psnr8 = metric_psnr(&rounded, photo)};
    imagef_destroy(&rounded);
    image8_destroy(&bytes);
    return score;
}

static void take_means(Evaluation *e) {
    for (int i = 0; i < e->count; i++) {
        e->psnr += e->views[i].psnr / e->count;
        e->ssim += e->views[i].ssim / e->count;
        e->psnr8 += e->views[i].psnr8 / e->count;
    }
}

// Some views that are read and compared at the same time, one a thread; they are rendered one after the other.
typedef struct {
    const Dataset *dataset;
    const float *background;
    int count;
    const View *views[SCORED_AT_ONCE_MAX];
    ImageF renders[SCORED_AT_ONCE_MAX];
    ViewScore scores[SCORED_AT_ONCE_MAX];
} Batch;

static bool score_one(void *context, int index) {
    Batch *batch = context;
    const View *view = batch->views[index];
    ImageF photo;
    if (!load_photo(batch->dataset, view, batch->background, &photo)) return false;
    batch->scores[index] = score_view(view->name, &photo, &batch->renders[index]);
    imagef_destroy(&photo);
    return true;
}

int evaluate_views_at_once(const Dataset *dataset) {
    int held_out = dataset_held_out_count(dataset), scored = held_out ? held_out : dataset->view_count;
    int threads = parallel_threads(), most = threads < SCORED_AT_ONCE_MAX ? threads : SCORED_AT_ONCE_MAX;
    return scored < most ? scored : most;
}

// The next views from indices (count) on, as many as there are threads.
static bool score_batch(Rasterizer *rasterizer, const Gaussians *model, const Dataset *dataset,
                        const RenderSettings *settings, const int *indices, int count, Evaluation *evaluation) {
    Batch batch = {.dataset = dataset, .background = settings->background};
    int most = evaluate_views_at_once(dataset);
    bool good = true;
    while (good && batch.count < most && batch.count < count) {
        batch.views[batch.count] = &dataset->views[indices[batch.count]];
        good = render_view(rasterizer, model, batch.views[batch.count], settings, &batch.renders[batch.count]);
        batch.count += good;
    }
    good = good && parallel_try(batch.count, score_one, &batch);
    for (int i = 0; i < batch.count; i++) {
        if (good) evaluation->views[evaluation->count++] = batch.scores[i];
        imagef_destroy(&batch.renders[i]);
    }
    return good;
}

bool evaluate_model(Rasterizer *rasterizer, const Gaussians *model, const Dataset *dataset,
                    const RenderSettings *settings, bool show_progress, Evaluation *evaluation) {
    int count;
    int *indices = list_views(dataset, &count);
    *evaluation = (Evaluation){.views = mem_alloc((size_t)count, sizeof(ViewScore))};
    Progress progress = progress_begin("evaluate", 0, count);
    bool good = rasterizer_hold(rasterizer, model);
    while (good && evaluation->count < count) {
        int done = evaluation->count;
        good = score_batch(rasterizer, model, dataset, settings, indices + done, count - done, evaluation);
        if (good && show_progress) progress_update(&progress, evaluation->count, NULL);
    }
    if (show_progress) progress_end(&progress, NULL);
    rasterizer_hold(rasterizer, NULL);
    mem_free(indices);
    if (good)
        take_means(evaluation);
    else
        evaluation_destroy(evaluation);
    return good;
}

void evaluation_destroy(Evaluation *evaluation) {
    mem_free(evaluation->views);
    *evaluation = (Evaluation){0};
}

// |render - photo| x 4, clipped: black is right.
static ImageF error_picture(const ImageF *photo, const ImageF *render) {
    ImageF error = imagef_create(photo->width, photo->height, 3);
    size_t count = (size_t)photo->width * (size_t)photo->height * 3;
    for (size_t i = 0; i < count; i++) error.values[i] = ERROR_GAIN * fabsf(render->values[i] - photo->values[i]);
    clip(&error);
    return error;
}

// White, with room for each chosen view three times side by side, one row a view.
static ImageF blank_sheet(const Dataset *dataset, const int *rows, int count) {
    int widest = 0, height = SHEET_GAP_PX * (count - 1);
    for (int i = 0; i < count; i++) {
        const Camera *camera = &dataset->views[rows[i]].camera;
        if (camera->width > widest) widest = camera->width;
        height += camera->height;
    }
    ImageF sheet = imagef_create(3 * widest + 2 * SHEET_GAP_PX, height, 3);
    size_t values = (size_t)sheet.width * (size_t)sheet.height * 3;
    for (size_t i = 0; i < values; i++) sheet.values[i] = 1;
    return sheet;
}

bool evaluate_contact_sheet(Rasterizer *rasterizer, const Gaussians *model, const Dataset *dataset,
                            const RenderSettings *settings, int max_rows, ImageF *sheet) {
    int candidates;
    int *rows = list_views(dataset, &candidates);
    int count = candidates < max_rows ? candidates : max_rows;
    for (int i = 0; i < count; i++) rows[i] = rows[(long)i * candidates / count]; // never ahead of what is read
    *sheet = (ImageF){0};
    if (count < 1) {
        mem_free(rows);
        return fail("no views for a contact sheet");
    }
    *sheet = blank_sheet(dataset, rows, count);
    int column = (sheet->width + SHEET_GAP_PX) / 3, y = 0;
    bool good = true;
    for (int i = 0; i < count && good; i++) {
        ImageF photo, render;
        good = show_view(rasterizer, model, dataset, &dataset->views[rows[i]], settings, &photo, &render);
        if (!good) break;
        ImageF error = error_picture(&photo, &render);
        imagef_paste(sheet, &photo, 0, y);
        imagef_paste(sheet, &render, column, y);
        imagef_paste(sheet, &error, 2 * column, y);
        y += photo.height + SHEET_GAP_PX;
        imagef_destroy(&photo);
        imagef_destroy(&render);
        imagef_destroy(&error);
    }
    if (!good) imagef_destroy(sheet);
    mem_free(rows);
    return good;
}
