// window_keys.c - text size, full screen, quit.
#include "lab/app/window_keys.h"

#include "lab/app/gui.h"

#include <GLFW/glfw3.h>

// + stands above = on some keyboards.
int window_keys_plus(int modifiers) {
    return gui_key(GLFW_KEY_EQUAL, modifiers) + gui_key(GLFW_KEY_EQUAL, modifiers | GUI_SHIFT) +
           gui_key(GLFW_KEY_KP_ADD, modifiers);
}

int window_keys_minus(int modifiers) {
    return gui_key(GLFW_KEY_MINUS, modifiers) + gui_key(GLFW_KEY_KP_SUBTRACT, modifiers);
}

void window_keys(Screen *screen) {
    int larger = window_keys_plus(GUI_PLAIN) - window_keys_minus(GUI_PLAIN);
    if (larger) screen_zoom(screen, larger);
    if (gui_key(GLFW_KEY_0, GUI_CTRL)) screen_zoom(screen, 0);
    if (gui_key(GLFW_KEY_F11, GUI_PLAIN) % 2) screen_toggle_full(screen);
    if (gui_key(GLFW_KEY_Q, GUI_CTRL)) screen_quit(screen);
}
