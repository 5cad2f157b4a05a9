// reference_model.c - the model in double.
#include "splat3d/reference.h"

#include "lab/base/mem.h"

static size_t field_numbers(int count, GaussianFieldId id) { return (size_t)count * GAUSSIAN_FIELDS[id].width; }

GaussiansD gaussiansd_create(int count, int sh_degree) {
    GaussiansD g = {.count = count, .sh_degree = sh_degree};
    for (GaussianFieldId id = 0; id < FIELD_COUNT; id++)
        if (GAUSSIAN_FIELDS[id].sh_degree <= sh_degree)
            g.field[id] = mem_alloc(field_numbers(count, id), sizeof(double));
    return g;
}

GaussiansD gaussiansd_from(const Gaussians *g) {
    GaussiansD copy = gaussiansd_create(g->count, g->sh_degree);
    for (GaussianFieldId id = 0; id < FIELD_COUNT; id++)
        for (size_t k = 0; copy.field[id] && k < field_numbers(g->count, id); k++) copy.field[id][k] = g->field[id][k];
    return copy;
}

Gaussians gaussiansd_to_float(const GaussiansD *g) {
    Gaussians copy = gaussians_create(g->count, g->sh_degree);
    for (GaussianFieldId id = 0; id < FIELD_COUNT; id++)
        for (size_t k = 0; copy.field[id] && k < field_numbers(g->count, id); k++)
            copy.field[id][k] = (float)g->field[id][k];
    return copy;
}

void gaussiansd_destroy(GaussiansD *g) {
    for (GaussianFieldId id = 0; id < FIELD_COUNT; id++) mem_free(g->field[id]);
    *g = (GaussiansD){0};
}
