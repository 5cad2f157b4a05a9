// check.c - E04: what front-to-back compositing must fulfil.
#include "exercises/harness/catalogue.h"
#include "splat2d/compositing.h"

#include <math.h>

// A case is n, Tmin, the background, and room for HITS hits of alpha, r, g, b, of which the first n count.
enum { N, TMIN, BG, HITS_AT = BG + 3, HITS = 40, NUMBERS = HITS_AT + 4 * HITS };

static const double ALPHA_HIGHEST = 0.99, ALPHA_LOWEST = 1.0 / 255;
static const double COLOUR_MAX = 1.5; // spherical harmonics may exceed 1; nothing here cuts it
static const double MARGIN = 1e-3; // kept away from thresholds, relative: float and double must fall on the same side

static CompositeRule rule_of(double Tmin) {
    return (CompositeRule){
        .alpha_max = ALPHA_HIGHEST, .alpha_min = ALPHA_LOWEST, .stop = Tmin, .rule = STOP_AFTER_BLEND};
}

typedef struct {
    double out[3], Tend, returned;
} Seen;

// The reference: every hit handed to composite_blend(), and a count of those that came before the pixel was opaque.
static Seen reference(const double *in, int n) {
    CompositeRule rule = rule_of(in[TMIN]);
    Composite pixel = composite_begin();
    int looked_at = 0;
    for (; looked_at < n && !pixel.opaque; looked_at++) {
        const double *hit = in + HITS_AT + 4 * looked_at;
        composite_blend(&pixel, &rule, hit[0], hit + 1);
    }
    Seen seen = {.Tend = pixel.transmittance, .returned = looked_at};
    composite_end(&pixel, in + BG);
    for (int c = 0; c < 3; c++) seen.out[c] = pixel.rgb[c];
    return seen;
}

static Seen call(Trial *t, const double *in, double Tmin, const double bg[3]) {
    Seen seen = {.Tend = 0};
    double n = in[N], *out = seen.out, Tend, returned;
    const double *h = in + HITS_AT;
    CALL(trial_call, t, "composite", IN_ARRAY(h, 4 * (int)n), IN(n), IN(Tmin), IN_ARRAY(bg, 3), OUT_ARRAY(out, 3),
         OUT(Tend), OUT(returned));
    seen.Tend = Tend;
    seen.returned = returned;
    return seen;
}

// ---- cases ----

static void draw_hits(Rng *rng, double *in, int n, double alpha_low, double alpha_high) {
    in[N] = n;
    for (int c = 0; c < 3; c++) in[BG + c] = rng_uniform(rng);
    for (int i = 0; i < n; i++) {
        double *hit = in + HITS_AT + 4 * i;
        hit[0] = rng_range(rng, alpha_low, alpha_high);
        for (int c = 1; c < 4; c++) hit[c] = rng_range(rng, 0, COLOUR_MAX);
    }
}

static bool is_near(double a, double b) { return fabs(a - b) <= MARGIN * b; }

// Whole n; alphas in [0, 1], none of them at the edge of being skipped; T never at the edge of Tmin.
static bool allows(const double *in) {
    if (in[N] != floor(in[N]) || in[N] < 0 || in[N] > HITS || in[TMIN] < 0 || in[TMIN] >= 1) return false;
    double T = 1;
    for (int i = 0; i < (int)in[N]; i++) {
        const double *hit = in + HITS_AT + 4 * i;
        if (hit[0] < 0 || hit[0] > 1 || is_near(hit[0], ALPHA_LOWEST) || is_near(T, in[TMIN])) return false;
        if (hit[0] > ALPHA_LOWEST) T *= 1 - fmin(hit[0], ALPHA_HIGHEST);
        for (int c = 0; c < 3; c++)
            if (hit[1 + c] < 0 || in[BG + c] < 0) return false;
    }
    return !is_near(T, in[TMIN]);
}

static bool allows_visible(const double *in) { // no cap, no skip, no stop
    if (in[TMIN] != 0 || !allows(in)) return false;
    for (int i = 0; i < (int)in[N]; i++) {
        double alpha = in[HITS_AT + 4 * i];
        if (alpha < ALPHA_LOWEST || alpha > ALPHA_HIGHEST) return false;
    }
    return true;
}

static void draw_single(Rng *rng, int k, double *in) { draw_hits(rng, in, k == 0 ? 0 : 1, 0.05, 0.95); }

static bool allows_single(const double *in) { return in[N] <= 1 && allows_visible(in); }

static void draw_visible(Rng *rng, int k, double *in) {
    draw_hits(rng, in, k < 4 ? k : 1 + (int)rng_below(rng, HITS), 0.005, k % 2 ? 0.2 : 0.98);
}

static void draw_faint(Rng *rng, int k, double *in) {
    double low = k == 1 ? 0.997 : 0.5; // 1/256 is 0.9961 / 255
    do {
        draw_hits(rng, in, 3 + (int)rng_below(rng, 20), 0.005, 0.3);
        for (int i = 0; i < (int)in[N]; i++)
            if (rng_uniform(rng) < 0.5) in[HITS_AT + 4 * i] = k == 0 ? 0 : rng_range(rng, low, 0.998) * ALPHA_LOWEST;
    } while (!allows(in));
}

static bool allows_unstopped(const double *in) { return in[TMIN] == 0 && allows(in); }

static void draw_opaque(Rng *rng, int k, double *in) {
    draw_hits(rng, in, 1 + (int)rng_below(rng, 6), 0.3, 1);
    in[HITS_AT + 4 * (int)rng_below(rng, (uint32_t)in[N])] = k < 3 ? 1 : rng_range(rng, 0.991, 1);
}

// Long enough that the walk stops, with faint hits on the way.
static void draw_stop(Rng *rng, int k, double *in) {
    do {
        draw_faint(rng, k, in);
        for (int i = 0; i < (int)in[N]; i += 2) in[HITS_AT + 4 * i] = rng_range(rng, 0.1, 1);
        in[TMIN] = (float)exp(rng_range(rng, log(1e-4), log(0.5)));
    } while (!allows(in));
}

// T comes down to just under 100 Tmin, then a white hit of 0.99 and above brings it below; behind it all is black. In every third
// case T is above 100 Tmin, and the walk goes on.
static void draw_bound(Rng *rng, int k, double *in) {
    double Tmin = (float)exp(rng_range(rng, log(1e-3), log(9e-3)));
    double T = (k % 3 == 2 ? rng_range(rng, 1.01, 1.1) : rng_range(rng, 0.5, 0.998)) * Tmin / (1 - ALPHA_HIGHEST);
    draw_hits(rng, in, 3 + (int)rng_below(rng, 6), 0.05, 0.4);
    in[TMIN] = Tmin;
    in[HITS_AT] = 1 - T;
    in[HITS_AT + 4] = rng_range(rng, 0.995, 1);
    for (int i = 0; i < (int)in[N]; i++)
        for (int c = 1; c < 4; c++) in[HITS_AT + 4 * i + c] = i == 1;
    for (int c = 0; c < 3; c++) in[BG + c] = 0;
}

static bool allows_unit_colours(const double *in) {
    for (int i = 0; i < 3 + 4 * (int)in[N]; i++)
        if (in[BG + i] > 1) return false;
    return in[TMIN] >= 1e-3 && allows(in);
}

// ---- rungs ----

static void compare(Trial *t, const Seen *yours, const Seen *want) {
    trial_near(t, "out = r, g, b", yours->out, want->out, 3, 1);
    trial_near1(t, "Tend, what is left of the light", yours->Tend, want->Tend, 1);
}

// The other way to say it: lay each hit over what is behind it, from the back.
static void over(Trial *t, const double *in) {
    Seen yours = call(t, in, in[TMIN], in + BG), want = {.Tend = 0};
    long double rgb[3] = {in[BG], in[BG + 1], in[BG + 2]}, T = 1;
    for (int i = (int)in[N] - 1; i >= 0; i--) {
        const double *hit = in + HITS_AT + 4 * i;
        for (int c = 0; c < 3; c++) rgb[c] = hit[0] * (long double)hit[1 + c] + (1 - (long double)hit[0]) * rgb[c];
        T *= 1 - (long double)hit[0];
    }
    for (int c = 0; c < 3; c++) want.out[c] = (double)rgb[c];
    want.Tend = (double)T;
    compare(t, &yours, &want);
}

// With white hits on black, the picture is the sum of the weights.
static void weights(Trial *t, const double *in) {
    double white[NUMBERS], black[3] = {0};
    for (int i = 0; i < NUMBERS; i++) white[i] = i < HITS_AT || (i - HITS_AT) % 4 == 0 ? in[i] : 1;
    Seen yours = call(t, white, in[TMIN], black);
    double sum = yours.out[0] + yours.Tend;
    trial_near1(t, "out + Tend of white splats on black: all weights and what is left", sum, 1, 1);
}

static void same_walk(Trial *t, const double *in) {
    Seen yours = call(t, in, in[TMIN], in + BG), want = reference(in, (int)in[N]);
    compare(t, &yours, &want);
}

static void looked_at(Trial *t, const double *in) {
    Seen yours = call(t, in, in[TMIN], in + BG), want = reference(in, (int)in[N]);
    compare(t, &yours, &want);
    trial_equal(t, "the returned count: hits looked at, skipped ones too", yours.returned, want.returned);
}

static void bound(Trial *t, const double *in) {
    Seen full = call(t, in, 0, in + BG), stopped = call(t, in, in[TMIN], in + BG); // the message shows the last one
    double off = 0;
    for (int c = 0; c < 3; c++) off = fmax(off, fabs(stopped.out[c] - full.out[c]));
    trial_at_most(t, "how far the picture is from the one with Tmin = 0; colours are in [0, 1]", isnan(off) ? NAN : off,
                  in[TMIN]);
}

// ---- picture: the walk ----

enum { STRIP_WIDTH = 328, STRIP_ROWS = 80 };

// A column for each number of hits, from none to n: above what the pixel would be if the list ended there, below the
// transmittance as a bar: a staircase, whose steps are the weights.
static void draw_column(ImageF *image, int column, int columns, const Seen *seen) {
    int from = column * STRIP_WIDTH / columns, to = (column + 1) * STRIP_WIDTH / columns;
    for (int y = 0; y < 2 * STRIP_ROWS; y++)
        for (int x = from; x < to; x++) {
            float *rgb = &image->values[(y * STRIP_WIDTH + x) * 3];
            bool is_bar = 2 * STRIP_ROWS - y <= seen->Tend * STRIP_ROWS;
            for (int c = 0; c < 3; c++) rgb[c] = y < STRIP_ROWS ? (float)seen->out[c] : is_bar ? 0.9f : 0.15f;
        }
}

static bool picture(Subject *subject, const double *in, ImageF *yours, ImageF *want) {
    int columns = (int)in[N] + 1;
    bool good = true;
    *yours = imagef_create(STRIP_WIDTH, 2 * STRIP_ROWS, 3);
    *want = imagef_create(STRIP_WIDTH, 2 * STRIP_ROWS, 3);
    for (int k = 0; good && k < columns; k++) {
        Seen seen = {.Tend = 0}, expected = reference(in, k);
        const double *h = in + HITS_AT, *bg = in + BG;
        double n = k, Tmin = in[TMIN], returned, *out = seen.out;
        good = CALL(subject_call, subject, "composite", IN_ARRAY(h, 4 * k), IN(n), IN(Tmin), IN_ARRAY(bg, 3),
                    OUT_ARRAY(out, 3), OUT(seen.Tend), OUT(returned));
        draw_column(yours, k, columns, &seen);
        draw_column(want, k, columns, &expected);
    }
    return good;
}

static const Rung RUNGS[] = {
    {.name = "single",
     .claim = "no splat shows the background; one covers its alpha of it",
     .count = NUMBERS,
     .draw = draw_single,
     .allows = allows_single,
     .check = same_walk,
     .picture = picture},
    {.name = "over",
     .claim = "front to back gives what laying each over the next gives from the back",
     .count = NUMBERS,
     .draw = draw_visible,
     .allows = allows_visible,
     .check = over,
     .picture = picture},
    {.name = "weights",
     .claim = "the weights and what is left add up to 1",
     .count = NUMBERS,
     .draw = draw_visible,
     .allows = allows_visible,
     .check = weights,
     .picture = picture},
    {.name = "faint",
     .claim = "an alpha below 1/255 is skipped",
     .count = NUMBERS,
     .draw = draw_faint,
     .allows = allows_unstopped,
     .check = same_walk,
     .picture = picture},
    {.name = "cap",
     .claim = "an alpha above 0.99 counts as 0.99",
     .count = NUMBERS,
     .draw = draw_opaque,
     .allows = allows_unstopped,
     .check = same_walk,
     .picture = picture},
    {.name = "bound",
     .claim = "stopping leaves at most Tmin unseen",
     .count = NUMBERS,
     .draw = draw_bound,
     .allows = allows_unit_colours,
     .check = bound,
     .picture = picture},
    {.name = "stop",
     .claim = "a hit is blended while T >= Tmin before it, and no later one is looked at",
     .count = NUMBERS,
     .draw = draw_stop,
     .allows = allows,
     .check = looked_at,
     .picture = picture},
};

const Exercise EXERCISE_COMPOSITE = {
    .number = 4,
    .name = "composite",
    .title = "what a pixel sees of a sorted list of splats",
    .minutes = 40,
    .unlocks = "the picture of the widget by your own walk, and its map of T: splatlab widget --mine",
    .rungs = RUNGS,
    .rung_count = sizeof RUNGS / sizeof *RUNGS,
};
