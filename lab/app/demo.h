// demo.h - a demo for a lecture: one text file with a scene and steps, each a caption, a question, and what it changes.
//
//     { "title": "Popping",
//       "scene": { as in scene2d_json.h },
//       "steps": [
//         { "caption": "...", "question": "..." (optional; the next step answers it),
//           "scene": { ... }                    another scene from here on
//           "set": [ {"blob": 0, "depth": 3} ]  changes of blobs, counted from 0, with the keys of a scene's blob
//           "active": 0, "probe": [480, 360],   the chosen blob (-1: none), the pixel that is explained
//           "layer": "colour" | "transmittance" | "blobs read",
//           "outlines": true, "discs": false, "unattenuated": false, "stop": 1e-4,
//           "page": "blobs" | "psd", "rate": 0.04, "walk": 40,   steps of the optimiser from its start
//           "compare_to": 0 } ] }               the picture of that step is the photograph of a PSNR; -1: none
// A step keeps from the one before it what it does not name, so it looks the same however one comes to it.
#ifndef SPLATLAB_LAB_APP_DEMO_H
#define SPLATLAB_LAB_APP_DEMO_H

#include "splat2d/scene2d.h"

#include <stdbool.h>

enum { DEMO_STEPS_MAX = 32, DEMO_COUNT = 6 };

extern const char *const DEMO_NAMES[DEMO_COUNT]; // "popping", ...: those that come with the program

typedef enum { DEMO_BLOBS, DEMO_PSD } DemoPage;

typedef struct {
    char *caption;
    char *question; // NULL: none
    Scene2d scene;
    int active;
    double probe[2]; // px of the canvas
    int layer;       // WidgetLayer
    bool outlines, discs, unattenuated;
    double stop; // transmittance of the early stop
    int page;    // DemoPage
    double rate;
    int walk;
    int compare_to;
} DemoStep;

typedef struct {
    char *title;
    int count;
    DemoStep steps[DEMO_STEPS_MAX];
} Demo;

// name: "popping" for demos/popping.json ($SPLATLAB_DEMOS, beside the program, in the source tree, installed), or the
// path of a .json file.
bool demo_load(const char *name, Demo *demo);
void demo_free(Demo *demo); // accepts a zeroed one

#endif
