// facts.h - what `splatlab info` has to say of a scene, a model or a cloud of points, as JSON objects.
//
// One source for both outputs: --json prints the object, facts_print() prints the same as text. Keys carry their unit.
#ifndef SPLATLAB_LAB_APP_FACTS_H
#define SPLATLAB_LAB_APP_FACTS_H

#include "splat3d/dataset.h"
#include "splat3d/gaussians.h"

#include <jansson.h>

// Each returns a new object, owned by the caller (json_decref).
json_t *facts_of_scene(const Dataset *dataset);
json_t *facts_of_model(const Gaussians *model, size_t file_bytes);
json_t *facts_of_points(const Points *points, size_t file_bytes);

// What training that many splats of that SH degree takes, and of what it consists; dataset: the pictures, or NULL.
json_t *facts_of_memory(int splats, int sh_degree, const Dataset *dataset);

// The object as lines "name   value" on stdout; "_" in names becomes a blank, bytes are also shown as MiB.
void facts_print(const json_t *object);

#endif
