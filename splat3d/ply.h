// ply.h - splats as PLY, as every 3DGS program writes them, and point clouds as PLY.
//
// Reading goes by the header's names, in any order, ascii or binary (little or big endian), any number type; as many f_rest
// columns as the SH degree has (0, 9, 24, 45), channel-major. Writing: 62 little-endian floats a splat for degree 3: x y z nx ny nz f_dc_0..2
// f_rest_* opacity (logit) scale_0..2 (log) rot_0..3 (w x y z).
#ifndef SPLATLAB_SPLAT3D_PLY_H
#define SPLATLAB_SPLAT3D_PLY_H

#include "splat3d/gaussians.h"
#include "splat3d/points.h"

#include <stdbool.h>

// Fails on a truncated file, missing columns, NaN or Inf, naming file and place.
bool ply_load(const char *path, Gaussians *gaussians);

// Atomic; the same model gives the same bytes.
bool ply_save(const char *path, const Gaussians *gaussians);

bool ply_load_points(const char *path, Points *points); // x y z and red green blue (grey 128 without)
bool ply_is_splats(const char *path, bool *is_splats);  // has opacity and scale_0 columns

#endif
