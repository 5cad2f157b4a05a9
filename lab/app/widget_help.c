// widget_help.c - the overlay of F1: everything the mouse and the keyboard do, on one page.
#include "lab/app/palette.h"
#include "lab/app/widget.h"

#include <stddef.h>

static const struct {
    const char *keys, *does;
} LINES[] = {
    {"drag a blob", "move it"},
    {"drag its squares", "stretch σx or σy"},
    {"drag its round handle", "turn θ; Shift snaps to 15°"},
    {"click, Tab, 1 … 9", "choose a blob"},
    {"wheel, [ ], PgUp PgDn", "one place to the front or to the back"},
    {"Ctrl wheel, + −, 0", "zoom; all of the canvas"},
    {"right or middle drag", "pan"},
    {"arrows", "move by 1 px, with Shift by 10"},
    {"X Y T O", "σx σy θ opacity up; with Shift down"},
    {"N  D  Delete", "new, duplicate, delete"},
    {"Ctrl Z, Ctrl Y", "undo, redo; a whole drag is one step"},
    {"Ctrl R", "reset the scene"},
    {"B", "background as the lesson's script adds it, or right"},
    {"G  H  L", "discs; outlines; colour, T or blobs read"},
    {"P", "hold the pixel that is explained"},
    {"M", "the other page: the PSD trap (Space runs it)"},
    {"Ctrl S  Ctrl O  Ctrl E", "save, load, export as PNG"},
    {"Ctrl +  Ctrl −  Ctrl 0", "size of the text"},
    {"F11, F1, Ctrl Q", "full screen, this page, quit"},
};
enum { LINE_COUNT = sizeof LINES / sizeof LINES[0] };

void widget_help(Widget *widget) {
    if (gui_mouse().pressed[GUI_LEFT]) widget->shows_help = false;
    double em = gui_em(), width = 38 * em, height = (1.5 * LINE_COUNT + 5.5) * em;
    GuiRect whole = gui_screen();
    gui_overlay_begin("dim", whole, 0x000000b0, 0, true);
    gui_panel_end();
    GuiRect box = {(whole.width - width) / 2, (whole.height - height) / 2, width, height};
    gui_overlay_begin("help", box, CARD, 1.6, true);
    gui_text(GUI_TITLE, INK, "Mouse and keys");
    gui_gap(0.2);
    for (int i = 0; i < LINE_COUNT; i++) {
        GuiRect row = gui_take(gui_width_left(), 1.1 * em);
        gui_draw_text(GUI_BOLD, row.x, row.y, ACCENT, "%s", LINES[i].keys);
        gui_draw_text(GUI_BODY, row.x + 13.5 * em, row.y, INK, "%s", LINES[i].does);
    }
    gui_panel_end();
}
