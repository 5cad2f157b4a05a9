// help_page.c - two columns over a dimmed window, as large as there is room for.
#include "lab/app/help_page.h"

#include "lab/app/gui.h"
#include "lab/app/palette.h"

#include <GLFW/glfw3.h>
#include <math.h>

static const double WIDTH_EMS = 40, KEYS_EMS = 14, LINE_EMS = 1.5, FRAME_EMS = 5.2;

void help_page(bool *shown, const HelpLine *lines, int count) {
    if (*shown && (gui_mouse().pressed[GUI_LEFT] || gui_key(GLFW_KEY_ESCAPE, GUI_PLAIN))) *shown = false;
    if (gui_key(GLFW_KEY_F1, GUI_PLAIN) % 2) *shown = !*shown;
    if (!*shown) return;
    GuiRect whole = gui_screen();
    double em = gui_em(), line = fmin(LINE_EMS * em, (whole.height - FRAME_EMS * em) / count);
    double width = fmin(WIDTH_EMS * em, whole.width), height = line * count + FRAME_EMS * em;
    gui_overlay_begin("dim", whole, 0x000000b0, 0, true);
    gui_panel_end();
    GuiRect box = {(whole.width - width) / 2, (whole.height - height) / 2, width, height};
    gui_overlay_begin("help", box, CARD, 1.6, true);
    gui_text(GUI_TITLE, INK, "Mouse and keys");
    GuiRect list = gui_take(gui_width_left(), 0);
    for (int i = 0; i < count; i++) {
        double y = list.y + 0.3 * em + i * line;
        gui_draw_text(GUI_BOLD, list.x, y, ACCENT, "%s", lines[i].keys);
        gui_draw_text(GUI_BODY, list.x + KEYS_EMS * em, y, INK, "%s", lines[i].does);
    }
    gui_panel_end();
}
