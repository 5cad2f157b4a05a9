// fit2d.c - start, step, growth.
#include "splat2d/fit2d.h"

#include "lab/base/mem.h"
#include "splat2d/adam.h"
#include "splat2d/fit_loss.h"
#include "splat2d/fit_pass.h"
#include "splat2d/fit_sample.h"

#include <assert.h>
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

// As fit_pass.h wants them.
enum { MEAN_X, MEAN_Y, LOG_SX, LOG_SY, THETA, LOGIT, RED, FIELDS = FIT_PARAMETERS };

// Learning rates at the start; they fall to LAST_RATE of it, evenly in the logarithm.
static const double RATES[FIELDS] = {0.4, 0.4, 0.03, 0.03, 0.03, 0.05, 0.012, 0.012, 0.012};
static const double LAST_RATE = 0.1;

static const double SIGMA_MIN = 0.35;   // px; a smaller blob falls between the pixels' centres
static const double LOGIT_MAX = 6;      // opacity 0.0025 .. 0.9975
static const double START_LOGIT = 0.4;  // opacity 0.6
static const double START_SIGMA = 0.45; // of the distance to the neighbours

enum { GROW_FIRST_SHARE = 8, GROW_ROUNDS = 12 }; // begins with 1 / 8 of the blobs, adds the rest in 12 rounds

struct Fit2d {
    Fit2dOptions options;
    ImageF photo;
    double background[3]; // the photograph's median colour
    FitLoss *loss;
    FitPass *pass;
    Planes3 picture, d_picture;
    int step;  // done so far
    int count; // blobs
    // (FIELDS, count) each
    double *parameters, *d_parameters, *m, *v;
};

// ---- options ----

static const Fit2dOptions DEFAULTS = {.gaussians = 500, .iterations = 1000, .lambda = 0.2, .rate = 1};

Fit2dOptions fit2d_options_default(void) { return DEFAULTS; }

static const OptionField FIELDS_OF_OPTIONS[] = {
    {.name = "gaussians",
     .letter = 'n',
     .type = OPTION_INT,
     .offset = offsetof(Fit2dOptions, gaussians),
     .low = 1,
     .high = SCENE2D_BLOBS_MAX,
     .help = "how many blobs",
     .section = "The fit"},
    {.name = "iterations",
     .type = OPTION_INT,
     .offset = offsetof(Fit2dOptions, iterations),
     .low = 1,
     .high = 1e7,
     .unit = "steps",
     .help = "how long to descend"},
    {.name = "seed",
     .type = OPTION_U64,
     .offset = offsetof(Fit2dOptions, seed),
     .high = 18446744073709551615.0,
     .help = "of all random numbers: same seed, same result, byte for byte"},
    {.name = "isotropic",
     .type = OPTION_FLAG,
     .offset = offsetof(Fit2dOptions, isotropic),
     .help = "round blobs only, to see what stretched ones are worth"},
    {.name = "grow",
     .type = OPTION_FLAG,
     .offset = offsetof(Fit2dOptions, grow),
     .help = "begin with 1/8 of the blobs and add the others where the error is largest"},
    {.name = "lambda",
     .type = OPTION_DOUBLE,
     .offset = offsetof(Fit2dOptions, lambda),
     .low = 0,
     .high = 1,
     .help = "share of 1 - SSIM in the loss; the rest is L1"},
    {.name = "rate",
     .type = OPTION_DOUBLE,
     .offset = offsetof(Fit2dOptions, rate),
     .low = 0.01,
     .high = 100,
     .help = "factor on all learning rates"},
};
const OptionTable FIT2D_OPTIONS = {FIELDS_OF_OPTIONS, sizeof FIELDS_OF_OPTIONS / sizeof FIELDS_OF_OPTIONS[0],
                                   &DEFAULTS};

// ---- blobs ----

static double *field(double *parameters, int count, int k) { return parameters + (ptrdiff_t)k * count; }

static double clamp(double value, double low, double high) { return fmin(fmax(value, low), high); }

static void start_blob(const Fit2d *fit, const FitPlace *place, double spacing_px, double theta_rad, double p[FIELDS]) {
    const ImageF *photo = &fit->photo;
    int x = (int)clamp(place->x, 0, photo->width - 1), y = (int)clamp(place->y, 0, photo->height - 1);
    double side = fmax(photo->width, photo->height);
    p[MEAN_X] = place->x;
    p[MEAN_Y] = place->y;
    p[LOG_SX] = p[LOG_SY] = log(clamp(START_SIGMA * spacing_px, 2 * SIGMA_MIN, side / 4));
    p[THETA] = fit->options.isotropic ? 0 : theta_rad;
    p[LOGIT] = START_LOGIT;
    for (int c = 0; c < 3; c++) p[RED + c] = (double)photo->values[((ptrdiff_t)y * photo->width + x) * 3 + c];
}

static int compare_spacing(const void *a, const void *b) {
    const FitPlace *left = a, *right = b;
    if (left->spacing_px != right->spacing_px) return left->spacing_px < right->spacing_px ? -1 : 1;
    if (left->x != right->x) return left->x < right->x ? -1 : 1;
    return (left->y > right->y) - (left->y < right->y);
}

// `added` blobs come in front of those there are; their moments begin at zero.
static void put_in_front(Fit2d *fit, int added, double *const *first) {
    int count = fit->count + added;
    double **arrays[] = {&fit->parameters, &fit->d_parameters, &fit->m, &fit->v};
    for (int k = 0; k < 4; k++) {
        double *larger = mem_alloc((size_t)count * FIELDS, sizeof *larger);
        for (int f = 0; f < FIELDS; f++) {
            if (fit->count > 0)
                memcpy(field(larger, count, f) + added, field(*arrays[k], fit->count, f),
                       (size_t)fit->count * sizeof *larger);
            if (k == 0) memcpy(field(larger, count, f), first[f], (size_t)added * sizeof *larger);
        }
        mem_free(*arrays[k]);
        *arrays[k] = larger;
    }
    fit->count = count;
}

// Draws places by the weights and puts a blob at each, the smallest in front.
static void add_blobs(Fit2d *fit, const double *weights, RngPurpose purpose, int added) {
    FitPlace *places = mem_alloc((size_t)added, sizeof *places);
    double *values = mem_alloc((size_t)added * FIELDS, sizeof *values), *first[FIELDS];
    fit_sample(weights, fit->photo.width, fit->photo.height, fit->options.seed, purpose, (uint32_t)fit->step, added,
               places);
    qsort(places, (size_t)added, sizeof *places, compare_spacing);
    for (int f = 0; f < FIELDS; f++) first[f] = values + (ptrdiff_t)f * added;
    double crowding = sqrt((double)added / (fit->count + added)); // the neighbours include those there are
    for (int i = 0; i < added; i++) {
        double p[FIELDS];
        // Angles spread evenly (golden ratio): blobs that start in one direction would prefer edges of that direction.
        start_blob(fit, &places[i], crowding * places[i].spacing_px, fmod(i * 0.6180339887498949, 1) * M_PI, p);
        for (int f = 0; f < FIELDS; f++) first[f][i] = p[f];
    }
    put_in_front(fit, added, first);
    mem_free(values);
    mem_free(places);
}

// ---- create, destroy ----

static int compare_numbers(const void *a, const void *b) {
    double left = *(const double *)a, right = *(const double *)b;
    return (left > right) - (left < right);
}

// Of all constants the median is nearest in L1.
static void median_colour(const ImageF *photo, double rgb[3]) {
    ptrdiff_t pixels = (ptrdiff_t)photo->width * photo->height;
    double *values = mem_alloc((size_t)pixels, sizeof *values);
    for (int c = 0; c < 3; c++) {
        for (ptrdiff_t i = 0; i < pixels; i++) values[i] = (double)photo->values[3 * i + c];
        qsort(values, (size_t)pixels, sizeof *values, compare_numbers);
        rgb[c] = clamp(values[pixels / 2], 0, 1);
    }
    mem_free(values);
}

Fit2d *fit2d_create(const ImageF *photo, const Fit2dOptions *options) {
    assert(photo->channels == 3 && options->gaussians >= 1 && options->iterations >= 1);
    Fit2d *fit = mem_alloc(1, sizeof *fit);
    fit->options = *options;
    fit->photo = imagef_create(photo->width, photo->height, 3);
    imagef_paste(&fit->photo, photo, 0, 0);
    median_colour(photo, fit->background);
    fit->loss = fit_loss_create(photo, options->lambda);
    fit->pass = fit_pass_create(photo->width, photo->height);
    fit->picture = planes3_create(photo->width, photo->height);
    fit->d_picture = planes3_create(photo->width, photo->height);
    double *weights = fit_weights_of_edges(photo);
    int first = options->grow ? (options->gaussians + GROW_FIRST_SHARE - 1) / GROW_FIRST_SHARE : options->gaussians;
    add_blobs(fit, weights, RNG_INIT_POINTS, first);
    mem_free(weights);
    return fit;
}

void fit2d_destroy(Fit2d *fit) {
    if (!fit) return;
    imagef_destroy(&fit->photo);
    fit_loss_destroy(fit->loss);
    fit_pass_destroy(fit->pass);
    planes3_destroy(&fit->picture);
    planes3_destroy(&fit->d_picture);
    double *arrays[] = {fit->parameters, fit->d_parameters, fit->m, fit->v};
    for (int k = 0; k < 4; k++) mem_free(arrays[k]);
    mem_free(fit);
}

// ---- step ----

// Round r of GROW_ROUNDS comes behind r / GROW_ROUNDS of the first half; then there are as many blobs as a straight line says.
static void grow(Fit2d *fit) {
    const Fit2dOptions *o = &fit->options;
    int first = (o->gaussians + GROW_FIRST_SHARE - 1) / GROW_FIRST_SHARE, half = o->iterations / 2;
    int round = half > 0 ? (int)((int64_t)GROW_ROUNDS * fit->step / half) : GROW_ROUNDS;
    if (round > GROW_ROUNDS) round = GROW_ROUNDS;
    int wanted = first + (int)((int64_t)(o->gaussians - first) * round / GROW_ROUNDS);
    if (wanted <= fit->count) return;
    ImageF picture = imagef_create(fit->photo.width, fit->photo.height, 3);
    fit2d_picture(fit, &picture);
    double *weights = fit_weights_of_error(&picture, &fit->photo);
    add_blobs(fit, weights, RNG_SPLIT, wanted - fit->count);
    mem_free(weights);
    imagef_destroy(&picture);
}

// A round blob has one scale: what moves it is the sum of both derivatives, and its angle means nothing.
static void make_round(double *d_parameters, int count) {
    double *d_sx = field(d_parameters, count, LOG_SX), *d_sy = field(d_parameters, count, LOG_SY);
    for (int i = 0; i < count; i++) {
        d_sx[i] = d_sy[i] = d_sx[i] + d_sy[i];
        field(d_parameters, count, THETA)[i] = 0;
    }
}

// Back into the ranges of a scene.
static void clamp_blobs(Fit2d *fit) {
    double side = fmax(fit->photo.width, fit->photo.height);
    const double low[FIELDS] = {-side, -side, log(SIGMA_MIN), log(SIGMA_MIN), -HUGE_VAL, -LOGIT_MAX, 0, 0, 0};
    const double high[FIELDS] = {2 * side, 2 * side, log(side), log(side), HUGE_VAL, LOGIT_MAX, 1, 1, 1};
    for (int f = 0; f < FIELDS; f++) {
        double *values = field(fit->parameters, fit->count, f);
        for (int i = 0; i < fit->count; i++) values[i] = clamp(values[i], low[f], high[f]);
    }
}

Loss fit2d_step(Fit2d *fit) {
    const Fit2dOptions *o = &fit->options;
    if (o->grow) grow(fit);
    int count = fit->count;
    fit_pass_forward(fit->pass, count, fit->parameters, fit->background, &fit->picture);
    Loss loss = fit_loss_evaluate(fit->loss, &fit->picture, &fit->d_picture);
    fit_pass_backward(fit->pass, fit->parameters, &fit->d_picture, fit->d_parameters);
    if (o->isotropic) make_round(fit->d_parameters, count);

    double gone = fmin(1, (double)fit->step / o->iterations), factor = o->rate * pow(LAST_RATE, gone);
    fit->step++;
    for (int f = 0; f < FIELDS; f++) {
        AdamRule rule = adam_rule_default(RATES[f] * factor);
        adam_step(&rule, fit->step, count, field(fit->d_parameters, count, f), field(fit->parameters, count, f),
                  field(fit->m, count, f), field(fit->v, count, f));
    }
    clamp_blobs(fit);
    return loss;
}

// ---- what there is ----

int fit2d_steps_done(const Fit2d *fit) { return fit->step; }
int fit2d_count(const Fit2d *fit) { return fit->count; }

void fit2d_picture(Fit2d *fit, ImageF *picture) {
    fit_pass_forward(fit->pass, fit->count, fit->parameters, fit->background, &fit->picture);
    planes3_to_image(&fit->picture, picture);
}

Scene2d fit2d_scene(const Fit2d *fit) {
    Scene2d scene = scene2d_create(fit->photo.width, fit->photo.height);
    memcpy(scene.background, fit->background, sizeof scene.background);
    for (int i = 0; i < fit->count; i++) {
        double p[FIELDS];
        for (int f = 0; f < FIELDS; f++) p[f] = fit->parameters[(ptrdiff_t)f * fit->count + i];
        Blob blob = {.mean = {p[MEAN_X], p[MEAN_Y]},
                     .sigma_x = exp(p[LOG_SX]),
                     .sigma_y = exp(p[LOG_SY]),
                     .theta_rad = remainder(p[THETA], M_PI), // a blob turned by half a turn is itself
                     .rgb = {p[RED], p[RED + 1], p[RED + 2]},
                     .opacity = 1 / (1 + exp(-p[LOGIT])),
                     .depth = i};
        scene2d_add(&scene, &blob);
    }
    return scene;
}
