// window_keys.h - the keys that every window of this program has.
#ifndef SPLATLAB_LAB_APP_WINDOW_KEYS_H
#define SPLATLAB_LAB_APP_WINDOW_KEYS_H

#include "lab/app/help_page.h"
#include "lab/app/screen.h"

// + and - size of the text, Ctrl 0 as it was; F11 full screen; Ctrl Q quit. F1 is help_page()'s.
void window_keys(Screen *screen);

// How often + (or -) went down, whichever key it is on; modifiers as gui_key()'s.
int window_keys_plus(int modifiers);
int window_keys_minus(int modifiers);

// For help_page(): the lines of these keys, to end a window's own list with.
#define WINDOW_KEYS_HELP                                                                                               \
    {"+  −  Ctrl 0", "size of the text, for the last row"}, { "F11  F1  Ctrl Q", "full screen, this page, quit" }

#endif
