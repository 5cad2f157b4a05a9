// gaussians.c - the field table and the memory that follows from it.
#include "splat3d/gaussians.h"

#include "lab/base/mem.h"

#include <assert.h>
#include <math.h>
#include <string.h>

const GaussianField GAUSSIAN_FIELDS[FIELD_COUNT] = {
    [FIELD_MEAN] = {"mean", 3, 0}, [FIELD_LOG_SCALE] = {"log_scale", 3, 0},
    [FIELD_QUAT] = {"quat", 4, 0}, [FIELD_OPACITY_LOGIT] = {"opacity_logit", 1, 0},
    [FIELD_SH0] = {"sh0", 3, 0},   [FIELD_SH1] = {"sh1", 9, 1},
    [FIELD_SH2] = {"sh2", 15, 2},  [FIELD_SH3] = {"sh3", 21, 3},
};

static size_t field_bytes(GaussianFieldId id, int count) {
    return (size_t)count * (size_t)GAUSSIAN_FIELDS[id].width * sizeof(float);
}

Gaussians gaussians_create(int count, int sh_degree) {
    assert(count >= 0 && sh_degree >= 0 && sh_degree <= SH_DEGREE_MAX);
    Gaussians g = {.count = count, .sh_degree = sh_degree};
    for (GaussianFieldId id = 0; id < FIELD_COUNT; id++)
        if (GAUSSIAN_FIELDS[id].sh_degree <= sh_degree) g.field[id] = mem_alloc(field_bytes(id, count), 1);
    return g;
}

void gaussians_destroy(Gaussians *g) {
    for (int id = 0; id < FIELD_COUNT; id++) mem_free(g->field[id]);
    *g = (Gaussians){0};
}

Gaussians gaussians_copy(const Gaussians *g) {
    Gaussians copy = gaussians_create(g->count, g->sh_degree);
    for (GaussianFieldId id = 0; id < FIELD_COUNT; id++)
        if (g->field[id]) memcpy(copy.field[id], g->field[id], field_bytes(id, g->count));
    return copy;
}

void gaussians_gather(Gaussians *g, int count, const uint32_t *source) {
    for (GaussianFieldId id = 0; id < FIELD_COUNT; id++) {
        if (!g->field[id]) continue;
        size_t width = (size_t)GAUSSIAN_FIELDS[id].width;
        float *gathered = mem_alloc(field_bytes(id, count), 1);
        for (size_t k = 0; k < (size_t)count; k++)
            if (source[k] != GAUSSIANS_GATHER_NOTHING)
                memcpy(gathered + k * width, gaussians_at(g, id, (int)source[k]), width * sizeof *gathered);
        mem_free(g->field[id]);
        g->field[id] = gathered;
    }
    g->count = count;
}

int gaussians_floats_per_splat(int sh_degree) {
    int floats = 0;
    for (int id = 0; id < FIELD_COUNT; id++)
        if (GAUSSIAN_FIELDS[id].sh_degree <= sh_degree) floats += GAUSSIAN_FIELDS[id].width;
    return floats;
}

bool gaussians_are_finite(const Gaussians *g, int *splat, GaussianFieldId *id) {
    size_t first = (size_t)g->count;
    for (GaussianFieldId field = 0; field < FIELD_COUNT; field++) {
        size_t width = (size_t)GAUSSIAN_FIELDS[field].width;
        if (!g->field[field]) continue;
        for (size_t i = 0; i < first * width; i++)
            if (!isfinite(g->field[field][i])) {
                first = i / width;
                *splat = (int)first;
                *id = field;
            }
    }
    return first == (size_t)g->count;
}
