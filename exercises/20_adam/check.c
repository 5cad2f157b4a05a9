// check.c - E20: what one step of Adam must do to each number, whatever the order of the work-items.
#include "exercises/harness/catalogue.h"
#include "splat2d/adam.h"

#include <math.h>
#include <string.h>

enum { N_MAX = 1000, FEW = 5 };

typedef struct {
    double p[N_MAX], g[N_MAX], m[N_MAX], v[N_MAX];
} State;

// One step of both: `mine` by the answer, `ours` by the reference.
static void step(Trial *trial, int count, State *mine, State *ours, const AdamRule *rule, int step_number) {
    double n = count, lr = rule->learning_rate, b1 = rule->beta1, b2 = rule->beta2, eps = rule->epsilon,
           t = step_number;
    double *p = mine->p, *g = mine->g, *m = mine->m, *v = mine->v;
    CALL(trial_call, trial, "adam", IN(n), UPDATED_ARRAY(p, count), IN_ARRAY(g, count), UPDATED_ARRAY(m, count),
         UPDATED_ARRAY(v, count), IN(lr), IN(b1), IN(b2), IN(eps), IN(t));
    adam_step(rule, step_number, count, ours->g, ours->p, ours->m, ours->v);
}

static double largest(const double *x, int count) {
    double most = 1e-30;
    for (int i = 0; i < count; i++) most = fmax(most, fabs(x[i]));
    return most;
}

static double log_range(Rng *rng, double low, double high) { return exp(rng_range(rng, log(low), log(high))); }

static double sign_of(Rng *rng) { return rng_range(rng, -1, 1) < 0 ? -1 : 1; }

// ---- the moments ----

// A case is lr, b1, b2, eps, t and then p, g, m, v of a few numbers.
enum { RULE = 5, COUNT = RULE + 4 * FEW };

static void draw(Rng *rng, int k, double *in) {
    in[0] = log_range(rng, 1e-4, 1);
    in[1] = rng_range(rng, 0.5, 0.95);
    in[2] = rng_range(rng, 0.9, 0.999);
    in[3] = 1e-15;
    in[4] = 1 + floor(rng_range(rng, 0, k == 0 ? 1 : 30));
    for (int i = 0; i < FEW; i++) {
        double size = log_range(rng, 1e-3, 1e3);
        in[RULE + i] = rng_range(rng, -2, 2);
        in[RULE + FEW + i] = sign_of(rng) * size;
        in[RULE + 2 * FEW + i] = rng_range(rng, -1, 1) * size;
        in[RULE + 3 * FEW + i] = rng_range(rng, 0.1, 2) * size * size;
    }
}

static bool allows(const double *in) {
    bool good = in[0] > 0 && in[1] > 0.4 && in[1] < 1 && in[2] > 0.4 && in[2] < 1 && in[3] >= 0 && in[4] >= 1 &&
                in[4] == floor(in[4]);
    for (int i = 0; i < FEW; i++) good = good && fabs(in[RULE + FEW + i]) > 1e-6 && in[RULE + 3 * FEW + i] > 1e-9;
    return good;
}

static AdamRule rule_of(const double *in) {
    return (AdamRule){.learning_rate = in[0], .beta1 = in[1], .beta2 = in[2], .epsilon = in[3]};
}

static State state_of(const double *in) {
    State s = {0};
    memcpy(s.p, in + RULE, FEW * sizeof *in);
    memcpy(s.g, in + RULE + FEW, FEW * sizeof *in);
    memcpy(s.m, in + RULE + 2 * FEW, FEW * sizeof *in);
    memcpy(s.v, in + RULE + 3 * FEW, FEW * sizeof *in);
    return s;
}

static void moments(Trial *t, const double *in) {
    State mine = state_of(in), ours = mine;
    AdamRule rule = rule_of(in);
    double scale = largest(mine.g, FEW) + largest(mine.m, FEW);
    step(t, FEW, &mine, &ours, &rule, (int)in[4]);
    trial_near(t, "m, the running mean of the gradient", mine.m, ours.m, FEW, scale);
    trial_near(t, "v, the running mean of its square", mine.v, ours.v, FEW, scale * scale);
}

// ---- the first step ----

static void draw_first(Rng *rng, int k, double *in) {
    draw(rng, k, in);
    in[3] = 1e-20;
    in[4] = 1;
    for (int i = 0; i < FEW; i++) {
        in[RULE + FEW + i] = sign_of(rng) * log_range(rng, 1e-8, 1e4);
        in[RULE + 2 * FEW + i] = in[RULE + 3 * FEW + i] = 0;
    }
}

static bool allows_first(const double *in) {
    bool good = in[0] > 0 && in[1] > 0.4 && in[1] < 1 && in[2] > 0.4 && in[2] < 1 && in[3] == 1e-20f && in[4] == 1;
    for (int i = 0; i < FEW; i++)
        good = good && fabs(in[RULE + FEW + i]) >= 1e-8 && in[RULE + 2 * FEW + i] == 0 && in[RULE + 3 * FEW + i] == 0;
    return good;
}

static void first_step(Trial *t, const double *in) {
    State mine = state_of(in), ours = mine;
    AdamRule rule = rule_of(in);
    double want[FEW];
    for (int i = 0; i < FEW; i++) want[i] = mine.p[i] - (mine.g[i] > 0 ? in[0] : -in[0]);
    step(t, FEW, &mine, &ours, &rule, 1);
    trial_near(t, "p after the first step: p - lr times the sign of g, however large g is", mine.p, want, FEW,
               largest(mine.p, FEW) < 10 ? in[0] + 2 : in[0] + largest(want, FEW));
}

// ---- later steps, eps, rest ----

static void later(Trial *t, const double *in) {
    State mine = state_of(in), ours = mine;
    AdamRule rule = rule_of(in);
    step(t, FEW, &mine, &ours, &rule, (int)in[4]);
    trial_near(t, "p after the step", mine.p, ours.p, FEW, largest(ours.p, FEW));
}

static void draw_floor(Rng *rng, int k, double *in) {
    draw(rng, k, in);
    in[3] = log_range(rng, 1e-3, 1e-1);
    for (int i = 0; i < FEW; i++) {
        in[RULE + FEW + i] = sign_of(rng) * log_range(rng, 1e-3, 1);
        in[RULE + 2 * FEW + i] = rng_range(rng, -0.1, 0.1);
        in[RULE + 3 * FEW + i] = log_range(rng, 1e-6, 1e-1);
    }
}

static void draw_rest(Rng *rng, int k, double *in) {
    draw(rng, k, in);
    for (int i = 0; i < FEW; i++) in[RULE + FEW + i] = in[RULE + 2 * FEW + i] = in[RULE + 3 * FEW + i] = 0;
}

static bool allows_rest(const double *in) {
    bool good = in[0] > 0 && in[1] > 0.4 && in[1] < 1 && in[2] > 0.4 && in[2] < 1 && in[3] == 1e-15f && in[4] >= 1 &&
                in[4] == floor(in[4]);
    for (int i = FEW; i < 4 * FEW; i++) good = good && in[RULE + i] == 0;
    return good;
}

static void rest(Trial *t, const double *in) {
    State mine = state_of(in), ours = mine;
    AdamRule rule = rule_of(in);
    step(t, FEW, &mine, &ours, &rule, (int)in[4]);
    for (int i = 0; i < FEW; i++)
        trial_equal(t, "p where the gradient has always been 0: as it was", mine.p[i], ours.p[i]);
}

// ---- sizes ----

// A case is n and a start for the numbers, which follow from it.
static void draw_sizes(Rng *rng, int k, double *in) {
    static const int SIZES[] = {0, 1, 63, 64, 65, N_MAX};
    in[0] = SIZES[k % 6];
    in[1] = floor(rng_range(rng, 0, 1000));
}

static bool allows_sizes(const double *in) { return in[0] >= 0 && in[0] <= N_MAX && in[0] == floor(in[0]); }

static State many(const double *in) {
    Rng rng = rng_at((uint64_t)in[1], RNG_EXERCISE, 20, 0);
    State s = {0};
    for (int i = 0; i < (int)in[0]; i++) {
        s.p[i] = (float)rng_range(&rng, -1, 1);
        s.g[i] = (float)rng_range(&rng, -1, 1);
        s.m[i] = (float)rng_range(&rng, -1, 1);
        s.v[i] = (float)rng_range(&rng, 0.2, 1);
    }
    return s;
}

static void sizes(Trial *t, const double *in) {
    int n = (int)in[0];
    State mine = many(in), ours = mine;
    AdamRule rule = {.learning_rate = 0.5, .beta1 = 0.875, .beta2 = 0.96875, .epsilon = 0};
    step(t, n, &mine, &ours, &rule, 3);
    if (n > 0) trial_near(t, "p after the step", mine.p, ours.p, n, 2);
}

// ---- a run ----

enum { RUN_STEPS = 40 };

// A case is lr and, for each number, where it begins and how steep its valley is.
static void draw_run(Rng *rng, int k, double *in) {
    (void)k;
    in[0] = rng_range(rng, 0.01, 0.1);
    for (int i = 0; i < FEW; i++) {
        in[1 + i] = rng_range(rng, 1, 4) * sign_of(rng);
        in[1 + FEW + i] = log_range(rng, 0.1, 100);
    }
}

static bool allows_run(const double *in) {
    bool good = in[0] > 1e-3 && in[0] <= 0.1;
    for (int i = 0; i < FEW; i++) good = good && fabs(in[1 + i]) >= 1 && in[1 + FEW + i] > 0.01;
    return good;
}

// Down p^2 steep / 2, both with gradients of the reference's path, so that roundings do not feed on themselves.
static void run(Trial *t, const double *in) {
    State mine = {0}, ours;
    AdamRule rule = {.learning_rate = in[0], .beta1 = 0.875, .beta2 = 0.96875, .epsilon = 0};
    memcpy(mine.p, in + 1, FEW * sizeof *in);
    ours = mine;
    for (int number = 1; number <= RUN_STEPS && !t->failed; number++) {
        for (int i = 0; i < FEW; i++) mine.g[i] = ours.g[i] = (float)(ours.p[i] * in[1 + FEW + i]);
        step(t, FEW, &mine, &ours, &rule, number);
    }
    trial_near(t, "p after 40 steps down a valley", mine.p, ours.p, FEW, 4);
}

// ---- under Oclgrind ----

static void draw_watched(Rng *rng, int k, double *in) {
    static const int SIZES[] = {65, 0, 3};
    draw_sizes(rng, k, in);
    in[0] = SIZES[k % 3];
}

static const Rung RUNGS[] = {
    {.name = "moments",
     .claim = "m and v are running means of the gradient and of its square",
     .cases = 4,
     .count = COUNT,
     .draw = draw,
     .allows = allows,
     .check = moments},
    {.name = "first_step",
     .claim = "the first step has the length lr, however large the gradient is",
     .cases = 4,
     .count = COUNT,
     .draw = draw_first,
     .allows = allows_first,
     .check = first_step},
    {.name = "later",
     .claim = "a later step divides the corrected mean by the root of the corrected square",
     .cases = 4,
     .count = COUNT,
     .draw = draw,
     .allows = allows,
     .check = later},
    {.name = "floor",
     .claim = "eps is added to the root",
     .cases = 4,
     .count = COUNT,
     .draw = draw_floor,
     .allows = allows,
     .check = later},
    {.name = "rest",
     .claim = "without a gradient nothing moves",
     .cases = 2,
     .count = COUNT,
     .draw = draw_rest,
     .allows = allows_rest,
     .check = rest},
    {.name = "sizes",
     .claim = "n may be 0, 1, 63, 64, 65 or 1000, in any order of work-items",
     .cases = 6,
     .count = 2,
     .draw = draw_sizes,
     .allows = allows_sizes,
     .check = sizes},
    {.name = "run",
     .claim = "40 steps lead down a valley as they should",
     .cases = 1,
     .count = 1 + 2 * FEW,
     .draw = draw_run,
     .allows = allows_run,
     .check = run},
    {.name = "oclgrind",
     .claim = "Oclgrind sees no data race and no wrong address",
     .cases = 3,
     .count = 2,
     .double_only = true,
     .is_watched = true,
     .draw = draw_watched,
     .allows = allows_sizes,
     .check = sizes},
};

const Exercise EXERCISE_ADAM = {
    .number = 20,
    .name = "adam",
    .title = "one step of Adam, as a kernel",
    .minutes = 40,
    .unlocks = "the form of every kernel: guard, work-item, race",
    .rungs = RUNGS,
    .rung_count = sizeof RUNGS / sizeof *RUNGS,
    .is_kernel = true,
};
