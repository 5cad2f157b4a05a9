// facts_memory.c - what training takes in memory, counted from the sizes of what it holds.
#include "lab/app/facts.h"

#include "kernels/shared.h"
#include "splat3d/evaluate.h"
#include "splat3d/schedule.h"

#include <stdint.h>

// An expectation: 100,000 splats of 3 px spread over 640 x 480 touch 5 tiles each; the boxes round them a few more.
enum { TILES_PER_SPLAT = 5 };

// Per splat: parameters and Adam's two moments. (A GPU has the gradients in memory as well.)
static size_t learned_bytes(int sh_degree) { return 3 * sizeof(float) * (size_t)gaussians_floats_per_splat(sh_degree); }

// Per splat: its place on the screen, its depth, the keys it is sorted by and its rank, id and density statistics; and a gradient
// record, a mask and a list entry (splat, slot, mask) for each tile that it touches.
static size_t working_bytes(void) {
    const size_t screen = sizeof(ScreenSplat) + sizeof(TileBox) + sizeof(float);
    const size_t sorting = 2 * sizeof(uint64_t) + 2 * sizeof(uint32_t);
    const size_t statistics = 3 * sizeof(float);
    const size_t tile = sizeof(PairGradient) + 2 * sizeof(uint16_t) + 2 * sizeof(uint32_t);
    return screen + sorting + statistics + TILES_PER_SPLAT * tile;
}

// Per splat: what density control copies: parameters and moments on the host with id and statistics, and the widest field once more
// while splats are put into their new order. Saving copies less.
static size_t copied_bytes(int sh_degree) {
    int widest = 0;
    for (int f = 0; f < FIELD_COUNT; f++)
        if (GAUSSIAN_FIELDS[f].sh_degree <= sh_degree && GAUSSIAN_FIELDS[f].width > widest)
            widest = GAUSSIAN_FIELDS[f].width;
    return (3 * (size_t)gaussians_floats_per_splat(sh_degree) + (size_t)widest) * sizeof(float) + 3 * sizeof(int);
}

// Per splat: what scoring copies: the parameters, to the host and once more to the device.
static size_t scored_bytes(int sh_degree) { return 2 * sizeof(float) * (size_t)gaussians_floats_per_splat(sh_degree); }

// The program itself with the OpenCL driver and its compiler, as measured with PoCL.
static const size_t PROGRAM_BYTES = (size_t)220 << 20;

// Photographs stand on the device as RGBA bytes, in all the sizes that training uses; those held out wait on the host as they
// were read.
static size_t photo_bytes(const Dataset *dataset) {
    const TrainOptions options = train_options_default();
    size_t bytes = 0;
    for (int i = 0; i < dataset->view_count; i++) {
        const View *view = &dataset->views[i];
        const int width = view->camera.width, height = view->camera.height;
        const int sizes = view->held_out ? 1 : schedule_sizes(&options, width, height);
        for (int level = 0; level < sizes; level++)
            bytes +=
                (size_t)(width >> level) * (size_t)(height >> level) * (size_t)(view->held_out ? view->channels : 4);
    }
    return bytes;
}

static size_t pixels_of_largest(const Dataset *dataset) {
    size_t most = 0;
    for (int i = 0; i < dataset->view_count; i++) {
        const Camera *camera = &dataset->views[i].camera;
        size_t pixels = (size_t)camera->width * (size_t)camera->height;
        if (pixels > most) most = pixels;
    }
    return most;
}

// Picture and gradient, transmittance and last index. (A GPU has the loss's maps as well, three for each colour.)
static size_t picture_bytes(const Dataset *dataset) { return (3 * 2 + 2) * sizeof(float) * pixels_of_largest(dataset); }

static size_t scoring_bytes(const Dataset *dataset) {
    return (size_t)evaluate_views_at_once(dataset) * EVALUATE_BYTES_PER_PIXEL * pixels_of_largest(dataset);
}

static void set_bytes(json_t *facts, const char *key, size_t bytes) {
    json_object_set_new(facts, key, json_integer((json_int_t)bytes));
}

json_t *facts_of_memory(int splats, int sh_degree, const Dataset *dataset) {
    json_t *facts = json_object();
    size_t learned = learned_bytes(sh_degree), working = working_bytes(), copied = copied_bytes(sh_degree);
    size_t n = (size_t)splats, total = PROGRAM_BYTES + n * (learned + working);
    size_t changing = n * copied, scoring = n * scored_bytes(sh_degree); // one after the other
    json_object_set_new(facts, "splats", json_integer(splats));
    json_object_set_new(facts, "sh_degree", json_integer(sh_degree));
    set_bytes(facts, "per_splat_bytes", learned + working + copied);
    set_bytes(facts, "learned_per_splat_bytes", learned);
    set_bytes(facts, "working_per_splat_bytes", working);
    set_bytes(facts, "copied_per_splat_bytes", copied);
    set_bytes(facts, "program_bytes", PROGRAM_BYTES);
    if (dataset) {
        set_bytes(facts, "per_photograph_bytes", photo_bytes(dataset) / (size_t)dataset->view_count);
        set_bytes(facts, "photographs_bytes", photo_bytes(dataset));
        set_bytes(facts, "picture_bytes", picture_bytes(dataset));
        set_bytes(facts, "scoring_bytes", scoring_bytes(dataset));
        total += photo_bytes(dataset) + picture_bytes(dataset);
        scoring += scoring_bytes(dataset);
    }
    total += changing > scoring ? changing : scoring;
    set_bytes(facts, "total_bytes", total);
    return facts;
}
