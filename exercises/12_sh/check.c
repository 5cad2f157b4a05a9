// check.c - E12: what a colour from spherical harmonics, and its gradients, must fulfil.
#include "exercises/harness/catalogue.h"
#include "exercises/harness/sphere.h"
#include "splat3d/reference.h"

#include "lab/base/mem.h"

#include <math.h>
#include <string.h>

// A case as numbers, in this order.
typedef struct {
    double deg, d[3], k[3 * SH_COEFFICIENTS_MAX], drgb[3];
} ShCase;

enum { CASE_NUMBERS = sizeof(ShCase) / sizeof(double) };

static ShCase case_of(const double *in) {
    ShCase c;
    memcpy(&c, in, sizeof c);
    return c;
}

static int numbers_of(const ShCase *c) { return 3 * ((int)c->deg + 1) * ((int)c->deg + 1); }

// ---- the reference: one splat at d, seen from the origin ----

static GaussiansD model_of(ShCase *c, double *mean) {
    GaussiansD g = {.count = 1, .sh_degree = (int)c->deg};
    g.field[FIELD_MEAN] = mean;
    for (int l = 0; l <= g.sh_degree; l++) g.field[FIELD_SH0 + l] = c->k + 3 * l * l;
    return g;
}

static Camera camera_at_origin(void) { return (Camera){.rotation = {{1, 0, 0, 0, 1, 0, 0, 0, 1}}}; }

static void expected_colour(const ShCase *c, double rgb[3], double clamped[3]) {
    ShCase copy = *c;
    Camera camera = camera_at_origin();
    RenderSettings settings = render_settings_default();
    settings.sh_degree = (int)c->deg;
    GaussiansD g = model_of(&copy, copy.d);
    reference_colour_forward(&g, 0, &camera, &settings, rgb);
    for (int channel = 0; channel < 3; channel++) clamped[channel] = rgb[channel] == 0;
}

static void expected_gradient(const ShCase *c, double *dk, double dd[3]) {
    ShCase copy = *c, d_copy = {.deg = c->deg};
    Camera camera = camera_at_origin();
    RenderSettings settings = render_settings_default();
    settings.sh_degree = (int)c->deg;
    GaussiansD g = model_of(&copy, copy.d), d = model_of(&d_copy, d_copy.d);
    reference_colour_backward(&g, 0, &camera, &settings, c->drgb, &d);
    memcpy(dk, d_copy.k, sizeof d_copy.k);
    memcpy(dd, d_copy.d, sizeof d_copy.d);
}

// ---- calls ----

static void call(Trial *t, const ShCase *in, double rgb[3], double clamped[3]) {
    double deg = in->deg;
    const double *d = in->d, *k = in->k;
    CALL(trial_call, t, "sh_color", IN(deg), IN_ARRAY(d, 3), IN_ARRAY(k, numbers_of(in)), OUT_ARRAY(rgb, 3),
         OUT_ARRAY(clamped, 3));
}

static void call_vjp(Trial *t, const ShCase *in, double *dk, double dd[3]) {
    double deg = in->deg, rgb[3], clamped[3];
    const double *d = in->d, *k = in->k, *drgb = in->drgb;
    expected_colour(in, rgb, clamped);
    CALL(trial_call, t, "sh_color_vjp", IN(deg), IN_ARRAY(d, 3), IN_ARRAY(k, numbers_of(in)), IN_ARRAY(clamped, 3),
         IN_ARRAY(drgb, 3), OUT_ARRAY(dk, numbers_of(in)), OUT_ARRAY(dd, 3));
}

// ---- cases ----

static const double CLEAR = 1e-3; // no channel is nearer to the clamp, where the gradient jumps

static void draw_of_degree(Rng *rng, int deg, double *in) {
    ShCase c = {.deg = deg};
    double length = exp(rng_range(rng, log(0.1), log(10)));
    Vec3 d = vec3_normalize(vec3(rng_normal(rng), rng_normal(rng), rng_normal(rng)));
    c.d[0] = length * d.x, c.d[1] = length * d.y, c.d[2] = length * d.z;
    // No direction brings these below 0: 0.28 * 1.5 + 0.5 > 0.2 * sqrt(15 * 15 / (4 pi)).
    for (int i = 0; i < 3; i++) c.k[i] = rng_range(rng, 1.5, 4);
    for (int i = 3; i < numbers_of(&c); i++) c.k[i] = rng_range(rng, -0.2, 0.2);
    for (int i = 0; i < 3; i++) c.drgb[i] = rng_normal(rng);
    memcpy(in, &c, sizeof c);
}

static void draw_constant(Rng *rng, int k, double *in) {
    (void)k;
    draw_of_degree(rng, 0, in);
}

static void draw_linear(Rng *rng, int k, double *in) {
    (void)k;
    draw_of_degree(rng, 1, in);
}

static void draw_quadratic(Rng *rng, int k, double *in) {
    (void)k;
    draw_of_degree(rng, 2, in);
}

static void draw_cubic(Rng *rng, int k, double *in) {
    (void)k;
    draw_of_degree(rng, 3, in);
}

static void draw_any(Rng *rng, int k, double *in) { draw_of_degree(rng, k % 4, in); }

// The sums before the clamp.
static void sums_of(const ShCase *c, double sums[3]) {
    double basis[SH_COEFFICIENTS_MAX];
    Vec3 n = vec3_normalize(vec3(c->d[0], c->d[1], c->d[2]));
    reference_sh_basis((int)c->deg, (const double[3]){n.x, n.y, n.z}, basis);
    for (int channel = 0; channel < 3; channel++) {
        sums[channel] = 0.5;
        for (int i = 0; 3 * i < numbers_of(c); i++) sums[channel] += basis[i] * c->k[3 * i + channel];
    }
}

static bool is_case(const double *in) {
    double deg = in[0], d2 = in[1] * in[1] + in[2] * in[2] + in[3] * in[3];
    return deg >= 0 && deg <= SH_DEGREE_MAX && deg == floor(deg) && d2 > 1e-12 && d2 < 1e12;
}

static bool allows(const double *in) {
    if (!is_case(in)) return false;
    ShCase c = case_of(in);
    double sums[3];
    sums_of(&c, sums);
    for (int channel = 0; channel < 3; channel++)
        if (fabs(sums[channel]) < CLEAR) return false;
    return true;
}

static bool allows_unclamped(const double *in) {
    if (!allows(in)) return false;
    ShCase c = case_of(in);
    double sums[3];
    sums_of(&c, sums);
    return sums[0] > 0 && sums[1] > 0 && sums[2] > 0;
}

static bool allows_clamped(const double *in) { return allows(in) && !allows_unclamped(in); }

// At least one channel below 0; with all three, two or one of them in turn.
static void draw_clamped(Rng *rng, int k, double *in) {
    do {
        draw_of_degree(rng, k % 4, in);
        for (int c = 0; c < 3; c++)
            if ((k / 4 + c) % 3 != 0 || k == 1) in[4 + c] = rng_range(rng, -6, 0);
    } while (!allows_clamped(in));
}

// ---- rungs ----

static void colour(Trial *t, const double *in) {
    ShCase c = case_of(in);
    double rgb[3], clamped[3], want[3], flags[3];
    call(t, &c, rgb, clamped);
    expected_colour(&c, want, flags);
    trial_near(t, "rgb", rgb, want, 3, fmax(1, fmax(want[0], fmax(want[1], want[2]))));
    for (int channel = 0; channel < 3; channel++)
        trial_equal(t,
                    channel == 0   ? "clamped[0]: was red below 0?"
                    : channel == 1 ? "clamped[1]: was green below 0?"
                                   : "clamped[2]: was blue below 0?",
                    clamped[channel], flags[channel]);
}

static const double ONE_HOT = 0.5; // small enough that 0.5 + Y ONE_HOT stays above 0

// Y_i of three i at a time, as the answer has them: a colour for each.
static void functions_of(Trial *t, const int index[3], Vec3 d, double values[3]) {
    ShCase c = {.deg = 3, .d = {d.x, d.y, d.z}};
    double rgb[3], clamped[3];
    for (int channel = 0; channel < 3; channel++) c.k[3 * index[channel] + channel] = ONE_HOT;
    call(t, &c, rgb, clamped);
    for (int channel = 0; channel < 3; channel++) values[channel] = (rgb[channel] - 0.5) / ONE_HOT;
}

static void draw_indices(Rng *rng, int k, double *in) {
    in[0] = k % SH_COEFFICIENTS_MAX;
    in[1] = rng_below(rng, SH_COEFFICIENTS_MAX);
    in[2] = rng_below(rng, SH_COEFFICIENTS_MAX);
}

static bool allows_indices(const double *in) {
    for (int i = 0; i < 3; i++)
        if (in[i] < 0 || in[i] >= SH_COEFFICIENTS_MAX || in[i] != floor(in[i])) return false;
    return true;
}

static void orthonormal(Trial *t, const double *in) {
    const int index[3] = {(int)in[0], (int)in[1], (int)in[2]};
    double integral[6] = {0}, want[6];
    for (int node = 0; node < SPHERE_NODES; node++) {
        SphereNode at = sphere_node(node);
        double Y[3];
        functions_of(t, index, at.direction, Y);
        for (int i = 0, n = 0; i < 3; i++)
            for (int j = i; j < 3; j++) integral[n++] += at.weight * Y[i] * Y[j];
    }
    for (int i = 0, n = 0; i < 3; i++)
        for (int j = i; j < 3; j++) want[n++] = index[i] == index[j];
    trial_near(
        t, "the integrals of Y_i Y_j over all directions, of the three harmonics whose coefficients are not 0: 1 or 0",
        integral, want, 6, 1);
}

static void draw_two(Rng *rng, int k, double *in) {
    for (int i = 0; i < 6; i++) in[i] = rng_normal(rng);
    for (int i = 0; i < 3; i++)
        if (k < 2) in[3 + i] = k ? -in[i] : in[i];
}

static bool allows_two(const double *in) {
    return vec3_length(vec3(in[0], in[1], in[2])) > 1e-3 && vec3_length(vec3(in[3], in[4], in[5])) > 1e-3;
}

// P_0 .. P_3.
static double legendre(int l, double x) {
    return l == 0 ? 1 : l == 1 ? x : l == 2 ? (3 * x * x - 1) / 2 : (5 * x * x - 3) * x / 2;
}

// The addition theorem: sum over m of Y_lm(a) Y_lm(b) = (2 l + 1) / (4 pi) P_l(a . b).
static void bands(Trial *t, const double *in) {
    Vec3 a = vec3(in[0], in[1], in[2]), b = vec3(in[3], in[4], in[5]);
    double sum[SH_DEGREE_MAX + 1] = {0}, want[SH_DEGREE_MAX + 1];
    double cosine = vec3_dot(vec3_normalize(a), vec3_normalize(b));
    for (int i = 0; i < SH_COEFFICIENTS_MAX; i += 3) {
        int index[3];
        double Y_a[3], Y_b[3];
        for (int n = 0; n < 3; n++) index[n] = i + n < SH_COEFFICIENTS_MAX ? i + n : 0;
        functions_of(t, index, a, Y_a);
        functions_of(t, index, b, Y_b);
        for (int n = 0; n < 3 && i + n < SH_COEFFICIENTS_MAX; n++) sum[(int)sqrt(i + n)] += Y_a[n] * Y_b[n];
    }
    for (int l = 0; l <= SH_DEGREE_MAX; l++) want[l] = (2 * l + 1) / (4 * M_PI) * legendre(l, cosine);
    trial_near(t, "the sums over m of Y_lm(a) Y_lm(b) for l = 0, 1, 2, 3: they know the angle between a and b alone",
               sum, want, SH_DEGREE_MAX + 1, 1);
}

static double largest_of(const double *numbers, int count) {
    double largest = 0;
    for (int i = 0; i < count; i++) largest = fmax(largest, fabs(numbers[i]));
    return largest > 0 ? largest : 1;
}

static void by_coefficients(Trial *t, const double *in) {
    ShCase c = case_of(in);
    double dk[3 * SH_COEFFICIENTS_MAX], dd[3], want_dk[3 * SH_COEFFICIENTS_MAX], want_dd[3];
    call_vjp(t, &c, dk, dd);
    expected_gradient(&c, want_dk, want_dd);
    trial_near(t, "dk: the gradient by the coefficients, r g b of each in turn", dk, want_dk, numbers_of(&c),
               largest_of(c.drgb, 3));
}

static double direction_scale(const ShCase *c) {
    return largest_of(c->drgb, 3) * largest_of(c->k, numbers_of(c)) * (1 + c->deg) /
           vec3_length(vec3(c->d[0], c->d[1], c->d[2]));
}

static void by_direction(Trial *t, const double *in) {
    ShCase c = case_of(in);
    double dk[3 * SH_COEFFICIENTS_MAX], dd[3], want_dk[3 * SH_COEFFICIENTS_MAX], want_dd[3];
    call_vjp(t, &c, dk, dd);
    expected_gradient(&c, want_dk, want_dd);
    trial_near(t, "dd: the gradient by d, as it came (not of length 1)", dd, want_dd, 3, direction_scale(&c));
}

// Moving along d does not turn it.
static void across(Trial *t, const double *in) {
    ShCase c = case_of(in);
    double dk[3 * SH_COEFFICIENTS_MAX], dd[3], length = vec3_length(vec3(c.d[0], c.d[1], c.d[2]));
    call_vjp(t, &c, dk, dd);
    trial_near1(t, "dd . d: a step along d does not turn it",
                (dd[0] * c.d[0] + dd[1] * c.d[1] + dd[2] * c.d[2]) / length, 0, direction_scale(&c));
}

static void blocked(Trial *t, const double *in) {
    by_coefficients(t, in);
    by_direction(t, in);
}

// d (drgb . rgb) / d number, from the answer's own sh_color(), by central differences of fourth order.
static double slope(Trial *t, ShCase *c, double *number, double h) {
    static const double WEIGHTS[4] = {1.0 / 12, -8.0 / 12, 8.0 / 12, -1.0 / 12};
    static const int STEPS[4] = {-2, -1, 1, 2};
    double sum = 0, keep = *number;
    for (int i = 0; i < 4; i++) {
        double rgb[3], clamped[3];
        *number = keep + h * STEPS[i];
        call(t, c, rgb, clamped);
        sum += WEIGHTS[i] * (c->drgb[0] * rgb[0] + c->drgb[1] * rgb[1] + c->drgb[2] * rgb[2]);
    }
    *number = keep;
    return sum / h;
}

static void own(Trial *t, const double *in) {
    ShCase c = case_of(in);
    double length = vec3_length(vec3(c.d[0], c.d[1], c.d[2])), dk[3 * SH_COEFFICIENTS_MAX], dd[3], want[3];
    for (int axis = 0; axis < 3; axis++) want[axis] = slope(t, &c, &c.d[axis], 1e-3 * length);
    int last = numbers_of(&c) - 1;
    double want_last = slope(t, &c, &c.k[last], 1e-3);
    call_vjp(t, &c, dk, dd);
    trial_near(t, "dd, against central differences of your own sh_color()", dd, want, 3, direction_scale(&c));
    trial_near1(t, "the last number of dk, against central differences of your own sh_color()", dk[last], want_last,
                largest_of(c.drgb, 3));
}

// ---- the picture: the colour by direction, on a globe ----

enum { SIDE = 96 };

static int directions_of(Vec3 directions[SIDE * SIDE], int pixels[SIDE * SIDE]) {
    int count = 0;
    for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++) {
            Vec3 d;
            if (!sphere_globe(SIDE, x, y, &d)) continue;
            directions[count] = d;
            pixels[count++] = y * SIDE + x;
        }
    return count;
}

static bool picture(Subject *subject, const double *in, ImageF *yours, ImageF *reference) {
    enum { PIXELS = SIDE * SIDE };
    ShCase c = case_of(in);
    size_t numbers = (size_t)numbers_of(&c);
    Vec3 *directions = mem_alloc(PIXELS, sizeof *directions);
    int *pixels = mem_alloc(PIXELS, sizeof *pixels);
    double *deg = mem_alloc(PIXELS, sizeof *deg), *k = mem_alloc(PIXELS * numbers, sizeof *k),
           *rgb = mem_alloc(PIXELS * 3, sizeof *rgb), *clamped = mem_alloc(PIXELS * 3, sizeof *clamped);
    int count = directions_of(directions, pixels);
    for (int i = 0; i < count; i++) deg[i] = c.deg, memcpy(k + (size_t)i * numbers, c.k, numbers * sizeof *k);
    const Arg args[] = {ARG_IN("deg", deg, 1), ARG_IN("d", &directions[0].x, 3), ARG_IN("k", k, (int)numbers),
                        ARG_OUT("rgb", rgb, 3), ARG_OUT("clamped", clamped, 3)};
    bool good = subject_call_sets(subject, "sh_color", args, 5, count);
    if (good) *yours = imagef_create(SIDE, SIDE, 3), *reference = imagef_create(SIDE, SIDE, 3);
    for (int i = 0; good && i < count; i++) {
        double want[3], flags[3];
        c.d[0] = directions[i].x, c.d[1] = directions[i].y, c.d[2] = directions[i].z;
        expected_colour(&c, want, flags);
        for (int channel = 0; channel < 3; channel++) {
            yours->values[3 * pixels[i] + channel] = (float)rgb[3 * i + channel];
            reference->values[3 * pixels[i] + channel] = (float)want[channel];
        }
    }
    mem_free(directions);
    mem_free(pixels);
    mem_free(deg);
    mem_free(k);
    mem_free(rgb);
    mem_free(clamped);
    return good;
}

static const Rung RUNGS[] = {
    {.name = "constant",
     .claim = "degree 0 is one colour from everywhere: 0.5 + 0.2821 k, with no upper limit",
     .count = CASE_NUMBERS,
     .draw = draw_constant,
     .allows = allows_unclamped,
     .check = colour,
     .picture = picture},
    {.name = "linear",
     .claim = "degree 1 adds a slope in the order -y, z, -x of the unit direction",
     .count = CASE_NUMBERS,
     .draw = draw_linear,
     .allows = allows_unclamped,
     .check = colour,
     .picture = picture},
    {.name = "quadratic",
     .claim = "degree 2 adds five harmonics, m = -2 to 2",
     .count = CASE_NUMBERS,
     .draw = draw_quadratic,
     .allows = allows_unclamped,
     .check = colour,
     .picture = picture},
    {.name = "cubic",
     .claim = "degree 3 adds seven harmonics, m = -3 to 3",
     .count = CASE_NUMBERS,
     .draw = draw_cubic,
     .allows = allows_unclamped,
     .check = colour,
     .picture = picture},
    {.name = "clamp",
     .claim = "a channel below 0 is black and marked, each channel for itself",
     .count = CASE_NUMBERS,
     .draw = draw_clamped,
     .allows = allows_clamped,
     .check = colour,
     .picture = picture},
    {.name = "orthonormal",
     .claim = "the integral of Y_i Y_j over all directions is 1 for i = j and else 0",
     .cases = 2,
     .count = 3,
     .draw = draw_indices,
     .allows = allows_indices,
     .check = orthonormal},
    {.name = "bands",
     .claim = "turned as a whole, a band stays the same: its sum over m knows only the angle between two directions",
     .cases = 4,
     .count = 6,
     .draw = draw_two,
     .allows = allows_two,
     .check = bands},
    {.name = "coefficients",
     .claim = "the gradient by a coefficient is its harmonic",
     .count = CASE_NUMBERS,
     .double_only = true,
     .draw = draw_any,
     .allows = allows_unclamped,
     .check = by_coefficients},
    {.name = "across",
     .claim = "the gradient by d has no part along d",
     .count = CASE_NUMBERS,
     .double_only = true,
     .draw = draw_any,
     .allows = allows_unclamped,
     .check = across},
    {.name = "direction",
     .claim = "the gradient by d goes through the normalisation",
     .count = CASE_NUMBERS,
     .double_only = true,
     .draw = draw_any,
     .allows = allows_unclamped,
     .check = by_direction},
    {.name = "blocked",
     .claim = "a clamped channel passes no gradient",
     .count = CASE_NUMBERS,
     .double_only = true,
     .draw = draw_clamped,
     .allows = allows_clamped,
     .check = blocked},
    {.name = "own",
     .claim = "the gradient is the derivative of your own colour",
     .cases = 4,
     .count = CASE_NUMBERS,
     .double_only = true,
     .draw = draw_any,
     .allows = allows_unclamped,
     .check = own},
};

const Exercise EXERCISE_SH = {
    .number = 12,
    .name = "sh",
    .title = "a colour that depends on where it is seen from",
    .minutes = 60,
    .unlocks = "your colours in the picture: splatlab render --mine",
    .rungs = RUNGS,
    .rung_count = sizeof RUNGS / sizeof *RUNGS,
};
