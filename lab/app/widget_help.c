// widget_help.c - what the mouse and the keyboard do in the widget and in a demo.
#include "lab/app/help_page.h"
#include "lab/app/widget.h"
#include "lab/app/window_keys.h"

#include <string.h>

static const HelpLine WIDGET_LINES[] = {
    {"click  Tab  1 … 9", "choose a blob"},
    {"arrows", "move it by 1 px, with Shift by 10"},
};
static const HelpLine DEMO_LINES[] = {
    {"→  ←", "the next step, the one before"},
    {"1 … 6", "another demo: popping, anisotropy, psd, opacity …"},
    {"R", "the step anew"},
    {"A", "ask the audience: → first the question, then the answer"},
    {"Space", "play the steps, and freeze"},
    {"click  Tab", "choose a blob"},
};
static const HelpLine LINES[] = {
    {"drag a blob", "move it"},
    {"drag its squares", "stretch σx or σy"},
    {"drag its round handle", "turn θ; Shift snaps to 15°"},
    {"wheel  [ ]  PgUp PgDn", "one place to the front or to the back"},
    {"X  Y  T  O", "σx σy θ opacity up; with Shift down"},
    {"N  D  Delete", "new, duplicate, delete"},
    {"Ctrl Z  Ctrl Y  Ctrl R", "undo, redo; the scene as it was at the start"},
    {"S", "stop at a larger T; with Shift at a smaller one"},
    {"P", "hold the pixel that is explained"},
    {"U", "background as the lesson's script adds it, or right"},
    {"H  E  L", "outlines; ellipses as discs; colour, T or blobs read"},
    {"M", "the other page: the PSD trap"},
    {"there  Space  Return  V", "run and freeze; one step; the rate"},
    {"there  I J K  X Y T", "Σ xx xy yy; σx σy θ up; with Shift down"},
    {"Ctrl wheel  Ctrl + −  0", "zoom; all of the canvas"},
    {"right or middle drag", "pan"},
    {"B", "no panel: the picture alone"},
    {"V", "with --mine: your own functions, or the reference"},
    {"G", "begin and end a film, an animated GIF"},
    {"Ctrl S  Ctrl O  Ctrl E", "save, load, export as PNG"},
    WINDOW_KEYS_HELP,
};
#define COUNT(lines) (int)(sizeof(lines) / sizeof(lines)[0])

void widget_help(Widget *widget) {
    HelpLine lines[COUNT(DEMO_LINES) + COUNT(LINES)];
    const HelpLine *first = widget->demo ? DEMO_LINES : WIDGET_LINES;
    int count = widget->demo ? COUNT(DEMO_LINES) : COUNT(WIDGET_LINES);
    memcpy(lines, first, (size_t)count * sizeof *lines);
    memcpy(lines + count, LINES, sizeof LINES);
    help_page(&widget->shows_help, lines, count + COUNT(LINES));
}
