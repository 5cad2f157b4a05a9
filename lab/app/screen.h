// screen.h - where a command shows its pictures: a window, or an image in memory (headless); the loop over its frames.
//
//     Screen *screen = screen_open(&options);
//     while (screen_begin(screen, false)) {
//         ... gui.h ...
//         if (!screen_end(screen)) break;
//         screen_show(screen);
//     }
//     screen_close(screen);
#ifndef SPLATLAB_LAB_APP_SCREEN_H
#define SPLATLAB_LAB_APP_SCREEN_H

#include "lab/base/image.h"

#include <stdbool.h>

typedef struct {
    const char *title;
    int size[2];            // points; 0 0: chosen for the display
    double density;         // px per point; 0: what the display says, 1 when headless
    bool headless;          // no window; needs a size
    int frames;             // end after so many; 0: when the person ends it
    const char *screenshot; // the last frame is written there; "" for none
} ScreenOptions;

typedef struct Screen Screen;

// NULL with a message when there is no display.
Screen *screen_open(const ScreenOptions *options);
void screen_close(Screen *screen); // accepts NULL

// Begins the next frame; false when the person closed the window or all frames were shown. A window without events waits a
// moment unless something moves by itself (is_moving).
bool screen_begin(Screen *screen, bool is_moving);
bool screen_end(Screen *screen);  // completes the frame; false when the screenshot could not be written
void screen_show(Screen *screen); // it appears

bool screen_is_window(const Screen *screen);
double screen_unit(const Screen *screen); // what the window system counts (px, or points), per point
long screen_marks(
    const Screen
        *screen); // how often F12 went down, with whatever is held: a script's question whether all before it is done
double screen_work_ms(const Screen *screen); // from begin to shown, mean of the last frames, without waiting
void screen_zoom(Screen *screen,
                 int steps); // larger (1) or smaller (-1) text, for the last row of the hall; 0: as it was
void screen_toggle_full(Screen *screen);
void screen_quit(Screen *screen); // the next screen_begin() returns false

// The frame that was completed and is not yet shown, in px; *image owned by the caller. Write it: screen_save().
bool screen_read(Screen *screen, Image8 *image);
bool screen_save(Screen *screen, const char *path);

#endif
