// trap_page.h - the page that shows why Sigma is not optimised by its raw entries: the cone of valid matrices, a walk that
// leaves it through its wall, and beside it the walk that has no wall (splat2d/psd_trap.h has the mathematics).
#ifndef SPLATLAB_LAB_APP_TRAP_PAGE_H
#define SPLATLAB_LAB_APP_TRAP_PAGE_H

#include "lab/app/gui.h"
#include "splat2d/psd_trap.h"

#include <stdbool.h>

enum { TRAP_PICTURE_COUNT = 3 }; // the photograph, the raw walk, the factored walk

typedef struct {
    PsdTrap trap;
    bool is_running; // its owner takes one step of the optimiser a frame
    double turn_rad; // of the cone, about its axis
    bool is_stale;   // the pictures are of an earlier step
    Image8 pictures[TRAP_PICTURE_COUNT];
} TrapPage;

TrapPage *trap_page_create(void);
void trap_page_destroy(TrapPage *page); // accepts NULL

void trap_page_advance(TrapPage *page, int steps);
void trap_page_restart(TrapPage *page);

// One frame: sliders and buttons in the panel that is open, everything that is looked at in `stage`. first_picture: of
// gui_picture_fill(), from where TRAP_PICTURE_COUNT are used.
void trap_page_panel(TrapPage *page);
void trap_page_stage(TrapPage *page, GuiRect stage, int first_picture);

// Space runs and freezes, Return steps; I J K move the raw entries, X Y T the factored numbers, V the rate: up, with Shift down.
void trap_page_keys(TrapPage *page);

// The parts of the stage: trap_cone.c, trap_plot.c
void trap_cone(TrapPage *page, GuiRect place);
void trap_plot(const TrapPage *page, GuiRect place);

#endif
