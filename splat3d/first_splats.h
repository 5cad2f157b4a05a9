// first_splats.h - the model before the first step: one round splat for each point of structure from motion.
//
// Kerbl et al. 2023, section 5.1: mean at the point, sigma = root mean squared distance to the 3 nearest points, no rotation,
// opacity 0.1, the point's colour in SH degree 0, nothing in the higher degrees.
#ifndef SPLATLAB_SPLAT3D_FIRST_SPLATS_H
#define SPLATLAB_SPLAT3D_FIRST_SPLATS_H

#include "splat3d/dataset.h"
#include "splat3d/gaussians.h"

#include <stdint.h>

// The splats come in Morton order of their points (morton_order.h). points: at least 1. sh_degree: of the model, 0..3. first_opacity: in
// (0, 1).
Gaussians first_splats_from_points(const Points *points, int sh_degree, double first_opacity);

// `count` points drawn evenly from the cube that the data set names, all near-grey: for scenes that bring none.
Points first_splats_random_points(const Dataset *dataset, int count, uint64_t seed);

#endif
