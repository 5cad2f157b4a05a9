// window.h - a window with an OpenGL 3.3 core context, by GLFW; window.c is the only file that calls OpenGL itself.
//
// Lengths are in points, except where px is said: on a screen of high resolution a point is more than one px. Some window
// systems count the window and the mouse in points, some in px.
#ifndef SPLATLAB_LAB_APP_WINDOW_H
#define SPLATLAB_LAB_APP_WINDOW_H

#include "lab/base/image.h"

#include <stdbool.h>

typedef struct Window Window;
struct GLFWwindow;

// NULL with a message where there is no display or no OpenGL 3.3. One window at a time. density: px per point; 0: what the
// display says.
Window *window_create(const char *title, int width, int height, double density);
void window_destroy(Window *window); // accepts NULL

struct GLFWwindow *window_handle(const Window *window); // for the layer that draws controls
void window_size(const Window *window, int *width, int *height);
double window_density(const Window *window); // px per point
double window_unit(const Window *window);    // what the window system counts, per point
bool window_is_closing(const Window *window);
void window_poll(Window *window, double wait_s); // takes events; waits that long for one if there is none

// How often the key (GLFW_KEY_...) went down or repeated in the last poll with exactly these modifiers held
// (GLFW_MOD_SHIFT | GLFW_MOD_CONTROL). Events are counted, so that a key that is down for less than a frame is not lost.
int window_key_count(const Window *window, int key, int modifiers);

bool window_key_pressed(const Window *window); // did any key go down in the last poll, not counting repetitions?

void window_toggle_full_screen(Window *window);

void window_begin(Window *window, const float rgb[3]); // clears the whole window
void window_show(Window *window);                      // what was drawn since then appears
bool window_read(const Window *window, Image8 *image); // what was drawn last, px; *image owned by the caller

// A picture that can be drawn; ends with the window.
unsigned window_texture_create(Window *window);
// image: 3 or 4 channels. smooth: blended where it is enlarged, else each pixel is a square.
void window_texture_fill(Window *window, unsigned texture, const Image8 *image, bool smooth);

#endif
