#include "splat3d/density.h"

#include "lab/base/mem.h"
#include "lab/base/rng.h"
#include "splat3d/morton_order.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef enum { ORIGIN_KEPT, ORIGIN_CLONE, ORIGIN_CHILD } Origin;

// The model after the round, as where each of its splats comes from.
typedef struct {
    int count;
    uint32_t *source; // (count) index in the model before
    Origin *origin;   // (count)
} Plan;

static void plan_destroy(Plan *plan) {
    mem_free(plan->source);
    mem_free(plan->origin);
}

typedef enum { GROW_NOT, GROW_CLONE, GROW_SPLIT } Growth;

typedef struct {
    float gradient; // mean over the views that saw it
    int splat;
} Candidate;

static double largest_scale(const Gaussians *g, int i) {
    const float *log_scale = gaussians_at(g, FIELD_LOG_SCALE, i);
    return exp(fmax(log_scale[0], fmax(log_scale[1], log_scale[2])));
}

static int steeper_first(const void *a, const void *b) {
    const Candidate *x = a, *y = b;
    if (x->gradient != y->gradient) return x->gradient > y->gradient ? -1 : 1;
    return (x->splat > y->splat) - (x->splat < y->splat);
}

// Which splats grow, and how: growth (N). Each adds one splat to the model (a split replaces one by two).
static void choose_growth(const TrainOptions *o, double scene_extent, const TrainingState *s, Growth *growth,
                          DensityChange *change) {
    int n = s->model.count, found = 0;
    Candidate *candidates = mem_alloc((size_t)n, sizeof *candidates);
    for (int i = 0; i < n; i++) {
        float mean = s->seen[i] ? s->gradient_sum[i] / (float)s->seen[i] : 0;
        if (mean >= o->densify_gradient && s->seen[i]) candidates[found++] = (Candidate){mean, i};
    }
    int room = o->max_splats > n ? o->max_splats - n : 0;
    if (found > room) {
        qsort(candidates, (size_t)found, sizeof *candidates, steeper_first);
        found = room;
    }
    for (int c = 0; c < found; c++) {
        int i = candidates[c].splat;
        bool large = largest_scale(&s->model, i) > o->densify_scale * scene_extent;
        growth[i] = large ? GROW_SPLIT : GROW_CLONE;
        change->split += large;
        change->cloned += !large;
    }
    mem_free(candidates);
}

// Is a splat that has the numbers of splat i, its scales divided by `shrink`, worth keeping?
static bool survives(const TrainOptions *o, double scene_extent, bool prune_large, const Gaussians *g, int i,
                     double shrink) {
    double opacity = 1 / (1 + exp(-(double)*gaussians_at(g, FIELD_OPACITY_LOGIT, i)));
    if (opacity < o->prune_opacity) return false;
    return !prune_large || largest_scale(g, i) / shrink <= o->prune_scale * scene_extent;
}

static void plan_add(Plan *plan, int source, Origin origin, bool alive, DensityChange *change) {
    if (!alive) {
        change->pruned++;
        return;
    }
    plan->source[plan->count] = (uint32_t)source;
    plan->origin[plan->count++] = origin;
}

// Splats as near each other in memory as they are in space; those that come from one place keep their order.
static void arrange_plan(Plan *plan, const Gaussians *g) {
    size_t n = (size_t)plan->count;
    float *mean = mem_alloc(n, 3 * sizeof *mean);
    uint32_t *order = mem_alloc(n, sizeof *order);
    Plan arranged = {plan->count, mem_alloc(n, sizeof *plan->source), mem_alloc(n, sizeof *plan->origin)};
    for (size_t i = 0; i < n; i++)
        memcpy(mean + 3 * i, gaussians_at(g, FIELD_MEAN, (int)plan->source[i]), 3 * sizeof *mean);
    morton_order(plan->count, mean, order);
    for (size_t i = 0; i < n; i++) {
        arranged.source[i] = plan->source[order[i]];
        arranged.origin[i] = plan->origin[order[i]];
    }
    mem_free(mean);
    mem_free(order);
    plan_destroy(plan);
    *plan = arranged;
}

static Plan make_plan(const TrainOptions *o, double scene_extent, bool prune_large, const TrainingState *s,
                      DensityChange *change) {
    int n = s->model.count;
    Growth *growth = mem_alloc((size_t)n, sizeof *growth);
    choose_growth(o, scene_extent, s, growth, change);
    size_t most = (size_t)n + (size_t)change->cloned + (size_t)change->split;
    Plan plan = {.source = mem_alloc(most, sizeof *plan.source), .origin = mem_alloc(most, sizeof *plan.origin)};
    for (int i = 0; i < n; i++)
        if (growth[i] != GROW_SPLIT)
            plan_add(&plan, i, ORIGIN_KEPT, survives(o, scene_extent, prune_large, &s->model, i, 1), change);
    for (int i = 0; i < n; i++)
        if (growth[i] == GROW_CLONE)
            plan_add(&plan, i, ORIGIN_CLONE, survives(o, scene_extent, prune_large, &s->model, i, 1), change);
    for (int i = 0; i < n; i++)
        for (int child = 0; growth[i] == GROW_SPLIT && child < SPLIT_CHILDREN; child++)
            plan_add(&plan, i, ORIGIN_CHILD, survives(o, scene_extent, prune_large, &s->model, i, SPLIT_SHRINK),
                     change);
    mem_free(growth);
    arrange_plan(&plan, &s->model);
    return plan;
}

// v rotated by the quaternion q = w x y z (any length): v + 2 u x (u x v + w v) / |q|^2.
static void rotate(const float q[4], const double v[3], double out[3]) {
    double w = q[0], x = q[1], y = q[2], z = q[3], scale = 2 / (w * w + x * x + y * y + z * z);
    double a = y * v[2] - z * v[1] + w * v[0], b = z * v[0] - x * v[2] + w * v[1], c = x * v[1] - y * v[0] + w * v[2];
    out[0] = v[0] + scale * (y * c - z * b);
    out[1] = v[1] + scale * (z * a - x * c);
    out[2] = v[2] + scale * (x * b - y * a);
}

// The child at index `i` of `after`, a copy of its parent so far: its mean is drawn from the parent, its scales shrink.
static void make_child(const TrainOptions *o, int step, Gaussians *after, int i) {
    Rng rng = rng_at(o->seed, RNG_SPLIT, (uint32_t)step, (uint32_t)i);
    float *mean = gaussians_at(after, FIELD_MEAN, i), *log_scale = gaussians_at(after, FIELD_LOG_SCALE, i);
    double local[3], world[3];
    for (int a = 0; a < 3; a++) local[a] = exp(log_scale[a]) * rng_normal(&rng);
    rotate(gaussians_at(after, FIELD_QUAT, i), local, world);
    for (int a = 0; a < 3; a++) {
        mean[a] = (float)(mean[a] + world[a]);
        log_scale[a] = (float)(log_scale[a] - log(SPLIT_SHRINK));
    }
}

// Puts the plan's splats in the place of those of the state; Adam's moments of fresh ones are zero.
static void carry_out(const Plan *plan, TrainingState *s) {
    uint32_t *kept = mem_alloc((size_t)plan->count, sizeof *kept);
    for (int i = 0; i < plan->count; i++)
        kept[i] = plan->origin[i] == ORIGIN_KEPT ? plan->source[i] : GAUSSIANS_GATHER_NOTHING;
    gaussians_gather(&s->model, plan->count, plan->source);
    gaussians_gather(&s->m, plan->count, kept);
    gaussians_gather(&s->v, plan->count, kept);
    mem_free(kept);
}

DensityChange density_control(const TrainOptions *o, int step, double scene_extent, bool prune_large,
                              TrainingState *s) {
    DensityChange change = {0};
    Plan plan = make_plan(o, scene_extent, prune_large, s, &change);
    carry_out(&plan, s);
    size_t n = (size_t)plan.count;
    uint32_t *id = mem_alloc(n, sizeof *id);
    for (size_t i = 0; i < n; i++) {
        id[i] = plan.origin[i] == ORIGIN_KEPT ? s->id[plan.source[i]] : s->next_id++;
        if (plan.origin[i] == ORIGIN_CHILD) make_child(o, step, &s->model, (int)i);
    }
    mem_free(s->id);
    mem_free(s->gradient_sum);
    mem_free(s->seen);
    s->id = id;
    s->gradient_sum = mem_alloc(n, sizeof *s->gradient_sum);
    s->seen = mem_alloc(n, sizeof *s->seen);
    plan_destroy(&plan);
    return change;
}

void density_reset_opacity(const TrainOptions *o, TrainingState *s) {
    float cut = (float)log(o->reset_opacity / (1 - o->reset_opacity));
    for (int i = 0; i < s->model.count; i++) {
        float *logit = gaussians_at(&s->model, FIELD_OPACITY_LOGIT, i);
        if (*logit > cut) *logit = cut;
        *gaussians_at(&s->m, FIELD_OPACITY_LOGIT, i) = 0;
        *gaussians_at(&s->v, FIELD_OPACITY_LOGIT, i) = 0;
    }
}
