// help_page.c - two columns over a dimmed window, as large as there is room for.
#include "lab/app/help_page.h"

#include "lab/app/gui.h"
#include "lab/app/palette.h"

#include <GLFW/glfw3.h>
#include <math.h>

static const double LINE_EMS = 1.5, FRAME_EMS = 5.2, PADDING_EMS = 1.6, GAP_EMS = 1.5;

static double widest(GuiStyle style, const HelpLine *lines, int count) {
    double width = 0;
    for (int i = 0; i < count; i++)
        width = fmax(width, gui_text_width(style, style == GUI_BOLD ? lines[i].keys : lines[i].does));
    return width;
}

void help_page(bool *shown, const HelpLine *lines, int count) {
    if (*shown && (gui_mouse().pressed[GUI_LEFT] || gui_key(GLFW_KEY_ESCAPE, GUI_PLAIN))) *shown = false;
    if (gui_key(GLFW_KEY_F1, GUI_PLAIN) % 2) *shown = !*shown;
    if (!*shown) return;
    GuiRect whole = gui_screen();
    double em = gui_em(), line = fmin(LINE_EMS * em, (whole.height - FRAME_EMS * em) / count);
    double column = widest(GUI_BOLD, lines, count) + GAP_EMS * em;
    double width = fmin(column + widest(GUI_BODY, lines, count) + 2 * PADDING_EMS * em + 1, whole.width);
    double height = line * count + FRAME_EMS * em;
    gui_overlay_begin("dim", whole, 0x000000b0, 0, true);
    gui_panel_end();
    GuiRect box = {(whole.width - width) / 2, (whole.height - height) / 2, width, height};
    gui_overlay_begin("help", box, CARD, PADDING_EMS, true);
    gui_text(GUI_TITLE, INK, "Mouse and keys");
    GuiRect list = gui_take(gui_width_left(), 0);
    for (int i = 0; i < count; i++) {
        double y = list.y + 0.3 * em + i * line;
        gui_draw_text(GUI_BOLD, list.x, y, ACCENT, "%s", lines[i].keys);
        gui_draw_text(GUI_BODY, list.x + column, y, INK, "%s", lines[i].does);
    }
    gui_panel_end();
}
