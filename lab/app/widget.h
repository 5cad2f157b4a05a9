// widget.h - the 2-D lesson in a window: its state, and the parts that each draw a piece of a frame and act on it.
//
// One frame: widget_frame() lays the screen out, then each part shows its piece and changes the scene at once. At the end
// of a frame in which nothing is held, or the mouse lets go, and before a key acts, a changed scene becomes a step of the
// history: a whole drag is one, and so is a key, however long it is held.
#ifndef SPLATLAB_LAB_APP_WIDGET_H
#define SPLATLAB_LAB_APP_WIDGET_H

#include "exercises/harness/mine_picture2d.h"
#include "lab/app/canvas2d.h"
#include "lab/app/demo.h"
#include "lab/app/gui.h"
#include "lab/app/history.h"
#include "lab/app/screen.h"
#include "lab/app/trap_page.h"
#include "lab/app/widget_film.h"
#include "splat2d/pixel_walk.h"

#include <stdbool.h>

// What the canvas shows of each pixel.
typedef enum { LAYER_COLOUR, LAYER_TRANSMITTANCE, LAYER_VISITS } WidgetLayer;

// Which page is shown: the blobs, or the PSD trap.
typedef enum { PAGE_BLOBS, PAGE_TRAP } WidgetPage;

enum { WIDGET_PATH_BYTES = 1024 };

typedef struct {
    Screen *screen; // borrowed
    WidgetPage page;
    TrapPage *trap; // owned, made when its page is first shown
    Scene2d scene;
    Scene2d first; // where "reset" goes back to
    int active;    // the chosen blob, -1: none
    History history;
    RasterSettings settings;

    Canvas2d canvas;
    bool is_moved; // by hand, zoomed or panned; else all of the canvas is shown, however large its place is
    Drag2d drag;   // grip GRIP_NONE: nothing is dragged

    // The picture, and what it was made of.
    Raster2d raster; // of the whole canvas, one to one, after each widget_picture()
    ImageF picture;
    Image8 picture8;
    RasterMaps maps;     // owned, of the picture's size
    double mean_opacity; // of 1 - T_end over the canvas
    double raster_ms;    // of the picture
    bool is_stale;       // something changed since it was made
    WidgetLayer layer;
    bool shows_outlines;
    bool hides_panel;

    // The pixel that is explained.
    double probe[2]; // px of the canvas
    bool probe_frozen;
    WalkStep *walk; // (walk_capacity), owned
    int walk_capacity;
    WalkResult walked;

    char path[WIDGET_PATH_BYTES]; // where the scene is saved
    const char *state_path;       // the scene is written there after each change; "" for nowhere
    const char *places_path;      // likewise where the controls are on the screen
    Scene2d written;              // what stands at state_path
    char *places;                 // what stands at places_path
    char note[256];               // the last message
    bool note_is_bad;
    double note_until_s;
    bool shows_help;

    // A person's own functions.
    Mine *mine; // borrowed; NULL without --mine
    bool shows_mine;
    int mine_block;       // px: side of the blocks that they draw
    double mine_looked_s; // when their files were last looked at

    // A lecture.
    Demo *demo;         // borrowed, and filled anew when another is chosen; NULL: none
    int step;           // of the demo
    Scene2d compared;   // for which psnr was computed
    double psnr;        // dB, of the scene against the step that the demo compares to
    bool asks_audience; // a step's question fills the picture before the next step answers it
    bool is_asking;     // the question is shown
    bool is_playing;    // the steps follow by themselves
    double stepped_s;   // when the step was shown
    WidgetFilm film;
} Widget;

// scene: becomes the widget's own.
void widget_begin(Widget *widget, Screen *screen, Scene2d scene, const char *path);
void widget_end(Widget *widget); // accepts a zeroed one

// One frame; false with a message when a file that a script asked for could not be written.
bool widget_frame(Widget *widget);

// Frames until the person ends it, or all that the screen was asked for are shown.
bool widget_loop(Widget *widget);

// Replaces the scene, as one step of the history.
void widget_set_scene(Widget *widget, Scene2d scene);
void widget_say(Widget *widget, bool is_bad, const char *format, ...) __attribute__((format(printf, 3, 4)));
Blob *widget_active(Widget *widget); // NULL when none is chosen

// ---- parts ----

void widget_keys(Widget *widget);                           // widget_keys.c
void widget_canvas(Widget *widget, GuiRect place);          // widget_canvas.c: picture, handles, mouse
void widget_picture(Widget *widget, int width, int height); // widget_picture.c: rasterizes when stale
void widget_heat(double t, double rgb[3]);                  // of LAYER_VISITS: t is the part of all blobs
void widget_panel(Widget *widget, GuiRect place);           // widget_panel.c: sliders and switches
void widget_page_choice(Widget *widget);                    // widget_panel.c: which page
void widget_maths(const Blob *blob);                        // widget_maths.c: Sigma and what follows from it
void widget_pixel(Widget *widget, GuiRect place);           // widget_pixel.c: one pixel's walk, and T along it
void widget_help(Widget *widget);                           // widget_help.c: the overlay of F1
void widget_demo_strip(Widget *widget, GuiRect place);      // widget_demo.c: caption, question, steps
void widget_demo_question(Widget *widget, GuiRect place);   // widget_demo.c: what the audience is asked
void widget_demo_keys(Widget *widget);                      // widget_demo.c: arrows, digits, R, A, Space

// ---- a person's own functions: widget_mine.c; the first and the last do nothing without them ----

void widget_mine_keys(Widget *widget);
void widget_mine_draw(Widget *widget, View2d view); // into picture and maps
void widget_mine_panel(Widget *widget);

// ---- actions that buttons and keys share: widget_edit.c ----

void widget_add(Widget *widget); // where the mouse is, or in the middle
void widget_duplicate(Widget *widget);
void widget_remove(Widget *widget);
void widget_reset(Widget *widget);
void widget_fit(Widget *widget);         // all of the canvas is shown
void widget_toggle_film(Widget *widget); // begins one, or ends it and writes it
void widget_undo(Widget *widget);
void widget_redo(Widget *widget);
void widget_raise(Widget *widget, int steps); // towards the front by that many ranks; negative: to the back
void widget_select(Widget *widget, int index);

// ---- demos: widget_demo.c ----

void widget_show_step(Widget *widget, int step); // as the demo's file has it, whatever was changed by hand before
void widget_show_page(Widget *widget, WidgetPage page);
bool widget_demo_plays(Widget *widget); // the next step when it is time; is something moving by itself?

// ---- files: widget_files.c ----

void widget_save(Widget *widget);
void widget_load(Widget *widget);
void widget_export(Widget *widget);      // the canvas as PNG, one to one, beside the scene's file
bool widget_write_state(Widget *widget); // for scripts, when something changed
bool widget_write_places(Widget *widget);

#endif
