// figure.h - the figures of the lesson pages and exercises: drawn by the program from what its own code computes.
//
// A figure is a drawing of fixed size and the numbers that it shows; cmd_figure.c lists them.
#ifndef SPLATLAB_LAB_APP_FIGURE_H
#define SPLATLAB_LAB_APP_FIGURE_H

#include "lab/app/gui.h"

#include <jansson.h>

typedef struct {
    const char *name, *summary;
    int width, height; // px
    // Draws into a panel of that size that is open, once; adds what it shows to `numbers`. False with a message.
    bool (*draw)(GuiRect place, json_t *numbers);
} Figure;

extern const Figure FIGURE_COV2, FIGURE_CONIC, FIGURE_PSD, FIGURE_COMPOSITE, FIGURE_POPPING, FIGURE_NERF, FIGURE_QUAT,
    FIGURE_COV3, FIGURE_CAMERA, FIGURE_EWA, FIGURE_EWA_ERROR, FIGURE_SH;

#endif
