// check.c - E06: what density, alpha and the sum over samples must fulfil.
#include "exercises/harness/catalogue.h"
#include "splat2d/compositing.h"
#include "splat2d/fog.h"
#include "splat2d/volume_ray.h"

#include <math.h>

static double call_alpha(Trial *t, double sigma, double delta) {
    double returned;
    CALL(trial_call, t, "alpha_from_sigma", IN(sigma), IN(delta), OUT(returned));
    return returned;
}

static double call_sigma(Trial *t, double a, double delta) {
    double returned;
    CALL(trial_call, t, "sigma_from_alpha", IN(a), IN(delta), OUT(returned));
    return returned;
}

static double log_uniform(Rng *rng, double low, double high) { return exp(rng_range(rng, log(low), log(high))); }

static double relative_to(double expected) { return expected > 0 ? expected : 1; }

// ---- one piece of the ray: rungs on alpha and sigma ----

// sigma, delta; sigma delta from 1e-8 to 20.
static void draw_piece(Rng *rng, int k, double *in) {
    in[1] = log_uniform(rng, 1e-2, 10);
    in[0] = k == 0 ? 0 : log_uniform(rng, 1e-8, 20) / in[1];
    if (k == 1) in[1] = 0;
}

static bool allows_piece(const double *in) { return in[0] >= 0 && in[1] >= 0 && in[0] * in[1] <= 80; }

static void alpha(Trial *t, const double *in) {
    double want = fog_alpha(in[0], in[1]);
    trial_near1(t, "alpha, of a piece of length delta; the error is taken relative to it", call_alpha(t, in[0], in[1]),
                want, relative_to(want));
}

// alpha, delta; alpha from 1e-8 to nearly 1.
static void draw_alpha(Rng *rng, int k, double *in) {
    in[0] = k == 0 ? 0 : k % 2 ? log_uniform(rng, 1e-8, 0.1) : rng_range(rng, 0.1, 0.999);
    in[1] = log_uniform(rng, 1e-2, 10);
}

static bool allows_alpha(const double *in) { return in[0] >= 0 && in[0] <= 0.9999 && in[1] > 1e-3 && in[1] < 1e3; }

static void sigma(Trial *t, const double *in) {
    double want = fog_sigma(in[0], in[1]);
    trial_near1(t, "sigma, of a piece that hides alpha; the error is taken relative to it", call_sigma(t, in[0], in[1]),
                want, relative_to(want));
}

static void round_trip(Trial *t, const double *in) {
    double back = call_alpha(t, call_sigma(t, in[0], in[1]), in[1]);
    trial_near1(t, "alpha of the density that was made from alpha", back, in[0], relative_to(in[0]));
}

// sigma, delta, k: the piece, cut into k.
static void draw_cut(Rng *rng, int k, double *in) {
    draw_piece(rng, k + 2, in);
    in[2] = 1 + rng_below(rng, 12);
}

static bool allows_cut(const double *in) {
    return allows_piece(in) && in[2] >= 1 && in[2] <= 100 && in[2] == floor(in[2]);
}

// What k pieces one behind the other let through, (1 - alpha)^k, is what the whole lets through.
static void cut(Trial *t, const double *in) {
    double piece = call_alpha(t, in[0], in[1] / in[2]), whole = call_alpha(t, in[0], in[1]);
    trial_near1(t, "1 - (1 - alpha of the k-th part)^k: alpha of the whole piece", -expm1(in[2] * log1p(-piece)), whole,
                1);
}

// opacity o, m: a splat's alpha were it a volume. Its density scales with G, not its alpha.
static void draw_splat(Rng *rng, int k, double *in) {
    in[0] = k < 3 ? (double[]){0.1, 0.5, 0.95}[k] : rng_range(rng, 0.01, 0.98);
    in[1] = rng_range(rng, 0, 2.5);
}

static bool allows_splat(const double *in) { return in[0] >= 0 && in[0] < 0.99 && in[1] >= 0 && in[1] <= 3; }

static void volume(Trial *t, const double *in) {
    double G = exp(-in[1] * in[1] / 2), want = -expm1(G * log1p(-in[0]));
    double yours = call_alpha(t, call_sigma(t, in[0], 1) * G, 1);
    trial_near1(t, "alpha of a cloud that hides o in the middle, at m standard deviations: 1 - (1 - o)^G, and not o G",
                yours, want, 1);
}

// ---- the ray: near, far, bumps of centre, width, density, r, g, b; then n ----

enum { NEAR, FAR, BUMPS, BUMP_NUMBERS = 6, BUMP_COUNT = 3, SAMPLES = BUMPS + BUMP_NUMBERS * BUMP_COUNT, RAY_NUMBERS };
enum { CENTRE, WIDTH, DENSITY, RGB };

static VolumeRay ray_of(const double *in) {
    VolumeRay ray = {.near = in[NEAR], .far = in[FAR], .count = BUMP_COUNT};
    for (int i = 0; i < BUMP_COUNT; i++) {
        const double *b = in + BUMPS + BUMP_NUMBERS * i;
        ray.bumps[i] = (VolumeBump){b[CENTRE], b[WIDTH], b[DENSITY], {b[RGB], b[RGB + 1], b[RGB + 2]}};
    }
    return ray;
}

static void draw_ray(Rng *rng, int k, double *in) {
    in[NEAR] = rng_range(rng, 0.5, 2);
    in[FAR] = in[NEAR] + rng_range(rng, 1, 5);
    double length = in[FAR] - in[NEAR];
    for (int i = 0; i < BUMP_COUNT; i++) {
        double *b = in + BUMPS + BUMP_NUMBERS * i;
        b[CENTRE] = rng_range(rng, in[NEAR], in[FAR]);
        b[WIDTH] = rng_range(rng, 0.12, 0.4) * length;
        b[DENSITY] = k == 1 ? 0 : rng_range(rng, 0.2, 4) / length;
        for (int c = 0; c < 3; c++) b[RGB + c] = rng_uniform(rng);
    }
    in[SAMPLES] = k == 0 ? 1 : 1 + rng_below(rng, 40);
}

static bool allows_ray(const double *in) {
    double length = in[FAR] - in[NEAR];
    if (!(in[NEAR] >= 0 && length >= 0.5 && length <= 10 && in[SAMPLES] >= 1 && in[SAMPLES] <= 100)) return false;
    for (int i = 0; i < BUMP_COUNT; i++) {
        const double *b = in + BUMPS + BUMP_NUMBERS * i;
        if (b[WIDTH] < 0.1 * length || b[WIDTH] > length || b[DENSITY] < 0 || b[DENSITY] * length > 10) return false;
        for (int c = 0; c < 3; c++)
            if (b[RGB + c] < 0 || b[RGB + c] > 1) return false;
    }
    return in[SAMPLES] == floor(in[SAMPLES]);
}

static void call_render(Trial *t, const double *in, double samples, double out[3]) {
    double n = samples;
    const double *f = in;
    CALL(trial_call, t, "render_quadrature", IN_ARRAY(f, SAMPLES), IN(n), OUT_ARRAY(out, 3));
}

// One piece: nothing lies in front of it.
static void draw_one(Rng *rng, int k, double *in) {
    draw_ray(rng, k + 1, in);
    in[SAMPLES] = 1;
}

static bool allows_one(const double *in) { return in[SAMPLES] == 1 && allows_ray(in); }

// The piece's alpha is asked for as well: whether the sum has it from there shows when both are compared with a wrong variant's.
static void one_piece(Trial *t, const double *in) {
    VolumeRay ray = ray_of(in);
    double out[3], want[3], rgb[3], delta = ray.far - ray.near;
    double piece = call_alpha(t, volume_ray_at(&ray, ray.near + delta / 2, rgb), delta);
    call_render(t, in, 1, out);
    double transmittance = volume_ray_quadrature(&ray, VOLUME_EXPONENTIAL, 1, want, NULL);
    trial_near1(t, "alpha_from_sigma() of the middle", piece, 1 - transmittance, 1);
    trial_near(t, "out = r, g, b: that alpha times the colour of the middle", out, want, 3, 1);
}

static void weights(Trial *t, const double *in) {
    VolumeRay ray = ray_of(in);
    double out[3], want[3];
    call_render(t, in, in[SAMPLES], out);
    volume_ray_quadrature(&ray, VOLUME_EXPONENTIAL, (int)in[SAMPLES], want, NULL);
    trial_near(t, "out = r, g, b: the samples as hits of E04", out, want, 3, 1);
}

// The smooth truth, and how fast the sum comes near it.
enum { COARSE = 48, FINE = 4 * COARSE };
static const double ORDER_MIN = 1.8;

static void draw_smooth(Rng *rng, int k, double *in) {
    draw_ray(rng, k + 2, in);
    in[SAMPLES] = COARSE;
}

static double distance_from_truth(const VolumeRay *ray, const double rgb[3]) {
    double truth[3], sum = 0;
    volume_ray_integral(ray, truth);
    for (int c = 0; c < 3; c++) sum += (rgb[c] - truth[c]) * (rgb[c] - truth[c]);
    return sqrt(sum);
}

static double error_with(Trial *t, const double *in, double n) {
    VolumeRay ray = ray_of(in);
    double out[3];
    call_render(t, in, n, out);
    return distance_from_truth(&ray, out);
}

// Where the coarse sum is right by chance there is nothing to divide: such cases are not drawn.
static bool allows_smooth(const double *in) {
    if (in[SAMPLES] != COARSE || !allows_ray(in)) return false;
    VolumeRay ray = ray_of(in);
    double out[3];
    volume_ray_quadrature(&ray, VOLUME_EXPONENTIAL, COARSE, out, NULL);
    double error = distance_from_truth(&ray, out);
    return error > 1e-5 && error < 1;
}

static void draw_measurable(Rng *rng, int k, double *in) {
    do draw_smooth(rng, k, in);
    while (!allows_smooth(in));
}

static void order(Trial *t, const double *in) {
    double coarse = error_with(t, in, COARSE), fine = error_with(t, in, FINE);
    trial_at_most(
        t,
        "the distance from the true integral with 192 pieces, over that with 48: 4^-p for an order p of at least 1.8",
        fine / coarse, pow((double)COARSE / FINE, ORDER_MIN));
}

// ---- pictures ----

// Columns: above the colour with 1, 2, ... pieces, below that of the true integral.
enum { STRIP_PIECES = 40, COLUMN = 8, STRIP_ROWS = 60 };

static void paint(ImageF *image, int column, int row_from, int rows, const double rgb[3]) {
    for (int y = row_from; y < row_from + rows; y++)
        for (int x = column * COLUMN; x < (column + 1) * COLUMN; x++)
            for (int c = 0; c < 3; c++) image->values[(y * image->width + x) * 3 + c] = (float)rgb[c];
}

static bool picture(Subject *subject, const double *in, ImageF *yours, ImageF *reference) {
    VolumeRay ray = ray_of(in);
    double out[3], want[3], truth[3];
    const double *f = in;
    bool good = true;
    volume_ray_integral(&ray, truth);
    *yours = imagef_create(STRIP_PIECES * COLUMN, 2 * STRIP_ROWS, 3);
    *reference = imagef_create(STRIP_PIECES * COLUMN, 2 * STRIP_ROWS, 3);
    for (int k = 0; good && k < STRIP_PIECES; k++) {
        double n = k + 1;
        good = CALL(subject_call, subject, "render_quadrature", IN_ARRAY(f, SAMPLES), IN(n), OUT_ARRAY(out, 3));
        volume_ray_quadrature(&ray, VOLUME_EXPONENTIAL, k + 1, want, NULL);
        paint(yours, k, 0, STRIP_ROWS, out);
        paint(reference, k, 0, STRIP_ROWS, want);
        paint(yours, k, STRIP_ROWS, STRIP_ROWS, truth);
        paint(reference, k, STRIP_ROWS, STRIP_ROWS, truth);
    }
    return good;
}

static const Rung RUNGS[] = {
    {.name = "alpha",
     .claim = "alpha = 1 - exp(-sigma delta), with all its digits where it is tiny",
     .count = 2,
     .draw = draw_piece,
     .allows = allows_piece,
     .check = alpha},
    {.name = "cut",
     .claim = "a piece hides as much as its k parts one behind the other",
     .count = 3,
     .draw = draw_cut,
     .allows = allows_cut,
     .check = cut},
    {.name = "sigma",
     .claim = "sigma = -log(1 - alpha) / delta, with all its digits where alpha is tiny",
     .count = 2,
     .draw = draw_alpha,
     .allows = allows_alpha,
     .check = sigma},
    {.name = "round_trip",
     .claim = "from alpha to sigma and back nothing is lost",
     .count = 2,
     .draw = draw_alpha,
     .allows = allows_alpha,
     .check = round_trip},
    {.name = "volume",
     .claim = "were a splat a cloud, its alpha would be 1 - (1 - o)^G",
     .count = 2,
     .draw = draw_splat,
     .allows = allows_splat,
     .check = volume},
    {.name = "one_piece",
     .claim = "one piece shows alpha times the colour of its middle",
     .count = RAY_NUMBERS,
     .draw = draw_one,
     .allows = allows_one,
     .check = one_piece},
    {.name = "order",
     .claim = "four times the pieces leave a sixteenth of the error",
     .cases = 4,
     .count = RAY_NUMBERS,
     .draw = draw_measurable,
     .allows = allows_smooth,
     .double_only = true,
     .check = order,
     .picture = picture},
    {.name = "weights",
     .claim = "the pieces blend as the hits of E04 do: NeRF and splats share the sum",
     .count = RAY_NUMBERS,
     .draw = draw_ray,
     .allows = allows_ray,
     .check = weights,
     .picture = picture},
};

const Exercise EXERCISE_NERF = {
    .number = 6,
    .name = "nerf",
    .title = "a ray through a cloud, with the sum of E04",
    .minutes = 60,
    .unlocks = "the lesson of NeRF's sum, whose sums you can now take: docs/nerf.md",
    .rungs = RUNGS,
    .rung_count = sizeof RUNGS / sizeof *RUNGS,
};
