// gaussians.h - the model: N Gaussians as structure of arrays, driven by one field table.
//
// The table GAUSSIAN_FIELDS names every learnable number of a splat once. It drives allocation, gradients, Adam's moments,
// device buffers, PLY columns and the checkpoint: a new field is a new line there. Spherical harmonics stand apart by degree, so that
// a degree that is not in use yet costs no memory traffic.
#ifndef SPLATLAB_SPLAT3D_GAUSSIANS_H
#define SPLATLAB_SPLAT3D_GAUSSIANS_H

#include "kernels/shared.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef enum {
    FIELD_MEAN,          // world units
    FIELD_LOG_SCALE,     // ln of the standard deviations along the own axes, world units
    FIELD_QUAT,          // w x y z; normalised inside the forward pass
    FIELD_OPACITY_LOGIT, // opacity = 1 / (1 + exp(-logit))
    FIELD_SH0,           // (1, 3): coefficient, then r g b
    FIELD_SH1,           // (3, 3)
    FIELD_SH2,           // (5, 3)
    FIELD_SH3,           // (7, 3)
    FIELD_COUNT
} GaussianFieldId;

typedef struct {
    const char *name; // "mean", ...: in checkpoints and messages
    int width;        // floats per splat
    int sh_degree;    // the field exists in models of at least this SH degree; 0 for all that are no SH
} GaussianField;

extern const GaussianField GAUSSIAN_FIELDS[FIELD_COUNT];

typedef struct {
    int count;                 // N
    int sh_degree;             // 0..3
    float *field[FIELD_COUNT]; // (N, width) each; NULL above sh_degree
} Gaussians;

// N splats, all numbers zero.
Gaussians gaussians_create(int count, int sh_degree);
void gaussians_destroy(Gaussians *g); // accepts a zeroed or destroyed one
Gaussians gaussians_copy(const Gaussians *g);

// Splat k becomes what splat source[k] was, or all zeros for GAUSSIANS_GATHER_NOTHING. source (count): indices of the model before, each
// any number of times. Field by field, so that only one of them is in memory twice.
#define GAUSSIANS_GATHER_NOTHING UINT32_MAX
void gaussians_gather(Gaussians *g, int count, const uint32_t *source);

// Floats per splat of a model of that SH degree: 11 + 3 (d + 1)^2, 59 for degree 3.
int gaussians_floats_per_splat(int sh_degree);

// The numbers of splat i in one field.
static inline float *gaussians_at(const Gaussians *g, GaussianFieldId id, int i) {
    return g->field[id] + (size_t)i * GAUSSIAN_FIELDS[id].width;
}

// Is every number finite? Else *splat and *id say where the first one is that is not.
bool gaussians_are_finite(const Gaussians *g, int *splat, GaussianFieldId *id);

#endif
