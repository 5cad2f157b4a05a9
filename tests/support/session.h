// session.h - the program in a window on a screen of its own (Xvfb), driven by real mouse and key events (xdotool).
#ifndef SPLATLAB_TESTS_SUPPORT_SESSION_H
#define SPLATLAB_TESTS_SUPPORT_SESSION_H

#include "splat2d/scene2d.h"

#include <stdbool.h>

enum { SESSION_WIDTH = 1280, SESSION_HEIGHT = 800, SESSION_ARGUMENTS_MAX = 16 };

// Starts a screen for this program's tests, once; where Xvfb or xdotool are not installed, says so and skips the test.
void session_need_screen(void);

// Starts `splatlab COMMAND --size ... --state-file ... --places-file ... ARGUMENTS` (NULL ends them) in the scratch folder
// and waits for its window.
void session_start(const char *command, ...) __attribute__((sentinel));
int session_wait(void); // until it ends by itself, 10 s at most; the exit code, -1 after a crash
int session_end(void);  // as if the person pressed Ctrl-C; the exit code, -1 after a crash
bool session_is_alive(void);

// Runs xdotool with this script, printf style. At each ";" it waits until the window has shown a frame with what was done:
// "mousemove 10 10; click 1". Without one, events may fall into the same frame.
void session_do(const char *format, ...) __attribute__((format(printf, 1, 2)));

// Moves, holds, moves in steps, releases: window px.
void session_drag(double x0, double y0, double x1, double y1);

// The scene as the state file has it (the same object until the next call).
const Scene2d *session_scene(void);
const char *session_bytes(void); // the state file itself, likewise

// Where a control is, by its label: the middle, px of the window. And the value under that name: "zoom".
void session_place(const char *label, double middle[2], double size[2]);
bool session_has_place(const char *label);
double session_number(const char *name);
double session_state(const char *name);                       // a number of the state file, where that holds no scene
void session_point(const double canvas[2], double window[2]); // a point of the canvas, in the first view

#endif
