#include "splat3d/schedule.h"

#include "lab/base/rng.h"

#include <math.h>

void schedule_learning_rates(const TrainOptions *o, int step, double scene_extent, float rate[FIELD_COUNT]) {
    double done = (double)(step - 1) / o->iterations;
    double mean = o->lr_mean > 0 ? exp((1 - done) * log(o->lr_mean) + done * log(o->lr_mean_end)) : 0;
    rate[FIELD_MEAN] = (float)(mean * scene_extent);
    rate[FIELD_LOG_SCALE] = (float)o->lr_log_scale;
    rate[FIELD_QUAT] = (float)o->lr_quat;
    rate[FIELD_OPACITY_LOGIT] = (float)o->lr_opacity;
    rate[FIELD_SH0] = (float)o->lr_sh0;
    rate[FIELD_SH1] = rate[FIELD_SH2] = rate[FIELD_SH3] = (float)o->lr_sh_rest;
}

int schedule_sizes(const TrainOptions *o, int width, int height) {
    int shorter = width < height ? width : height, sizes = 1;
    while (sizes <= o->coarse_levels && shorter >> sizes >= o->coarse_least) sizes++;
    return sizes;
}

int schedule_coarse_level(const TrainOptions *o, int step) {
    double coarse_steps = o->coarse_until * o->iterations;
    if (step > coarse_steps) return 0;
    return o->coarse_levels - (int)((step - 1) * o->coarse_levels / coarse_steps);
}

int schedule_sh_degree(const TrainOptions *o, int step) {
    int degree = step / o->sh_every;
    return degree < o->sh_degree ? degree : o->sh_degree;
}

bool schedule_density_is_on(const TrainOptions *o, int step) { return step < o->densify_until * o->iterations; }

bool schedule_density_is_due(const TrainOptions *o, int step) {
    return schedule_density_is_on(o, step) && step > o->densify_from && step % o->densify_every == 0;
}

bool schedule_prunes_large(const TrainOptions *o, int step) { return step > o->reset_every; }

bool schedule_reset_is_due(const TrainOptions *o, int step, bool white_background) {
    if (!schedule_density_is_on(o, step)) return false;
    return step % o->reset_every == 0 || (white_background && step == o->densify_from);
}

int schedule_view(const TrainOptions *o, int step, int count, int *order, int *epoch) {
    int now = (step - 1) / count;
    if (now != *epoch) { // Fisher-Yates (Durstenfeld 1964)
        Rng rng = rng_at(o->seed, RNG_VIEW_ORDER, (uint32_t)now, 0);
        for (int i = 0; i < count; i++) order[i] = i;
        for (int i = count - 1; i > 0; i--) {
            int j = (int)rng_below(&rng, (uint32_t)i + 1), swap = order[i];
            order[i] = order[j];
            order[j] = swap;
        }
        *epoch = now;
    }
    return order[(step - 1) % count];
}
