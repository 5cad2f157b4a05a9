// widget_mine.c - `splatlab widget --mine`: a person's own functions draw the picture; V swaps them with the reference.
#include "lab/app/palette.h"
#include "lab/app/widget.h"
#include "lab/base/clock.h"

#include <GLFW/glfw3.h>
#include <stdio.h>
#include <string.h>

static const double LOOK_EVERY_S = 1; // for saved files

void widget_mine_keys(Widget *widget) {
    if (!widget->mine) return;
    if (gui_key(GLFW_KEY_V, GUI_PLAIN) % 2) {
        widget->shows_mine = !widget->shows_mine;
        widget->is_stale = true;
        widget_say(widget, false, widget->shows_mine ? "Drawn by your functions" : "Drawn by the reference");
    }
    if (clock_seconds() < widget->mine_looked_s + LOOK_EVERY_S) return;
    if (mine_refresh(widget->mine)) {
        widget->is_stale = true;
        widget_say(widget, false, "Your files were tried again");
    }
    widget->mine_looked_s = clock_seconds();
}

// A function may break on what it meets here only: then the reference has drawn its part, and the reason is shown.
static void say_what_broke(Widget *widget, const bool *before) {
    for (MinePart i = 0; i < MINE_PLANE_COUNT; i++) {
        char text[MINE_STATE_BYTES];
        if (!before[i] || mine_is_used(widget->mine, i)) continue;
        mine_state(widget->mine, i, text);
        widget_say(widget, true, "%.240s", text);
    }
}

void widget_mine_draw(Widget *widget, View2d view) {
    bool before[MINE_PLANE_COUNT];
    for (MinePart i = 0; i < MINE_PLANE_COUNT; i++) before[i] = mine_is_used(widget->mine, i);
    widget->mine_block = mine_picture2d(widget->mine, &widget->scene, view, &widget->settings.rule, &widget->picture,
                                        widget->maps.transmittance);
    memset(widget->maps.visits, 0,
           (size_t)widget->picture.width * (size_t)widget->picture.height * sizeof *widget->maps.visits);
    say_what_broke(widget, before);
}

void widget_mine_panel(Widget *widget) {
    if (!widget->mine) return;
    gui_gap(0.15);
    gui_text(GUI_SMALL, INK_QUIET, "Your code");
    if (gui_switch("Draw with it", &widget->shows_mine)) widget->is_stale = true;
    gui_hint("V: yours or the reference. What you save is tried again within a second.");
    for (MinePart i = 0; i < MINE_PLANE_COUNT; i++) {
        char text[MINE_STATE_BYTES];
        mine_state(widget->mine, i, text);
        gui_paragraph(GUI_SMALL, mine_is_used(widget->mine, i) ? GOOD : INK_QUIET, text);
    }
    if (widget->shows_mine && widget->mine_block > 1)
        gui_text(GUI_SMALL, INK_FAINT, "in blocks of %d px: it runs in a process of its own", widget->mine_block);
    gui_rule();
}
