// scene2d_json.h - 2-D scenes as JSON files.
//
//     { "width": 960, "height": 720, "background": [0.06, 0.07, 0.1],
//       "gaussians": [ { "mean": [480, 360], "sigma_x": 90, "sigma_y": 30, "theta_rad": 0.5,
//                        "rgb": [1, 0.5, 0.2], "opacity": 0.9, "depth": 1 }, ... ] }
// Units and ranges are those of scene2d.h. All keys are required, and no others are known: a misspelt one is an error.
// Numbers are written with 17 digits, so that a scene that is loaded and saved again gives the same bytes.
#ifndef SPLATLAB_SPLAT2D_SCENE2D_JSON_H
#define SPLATLAB_SPLAT2D_SCENE2D_JSON_H

#include "splat2d/scene2d.h"

#include <jansson.h>

// On failure *scene is empty and the message names file, blob (counted from 0) and field.
bool scene2d_load(const char *path, Scene2d *scene);

// The same of a document in memory; `where` begins the messages. And what of a blob's keys the object has, into *blob:
// the others stay as they are.
bool scene2d_from_json(const json_t *root, const char *where, Scene2d *scene);
bool blob_change_from_json(const json_t *object, const char *where, Blob *blob);

// Refuses to write what could not be read back.
bool scene2d_save(const char *path, const Scene2d *scene);

#endif
