// gui.h - controls, text and drawing on a screen, as C functions; gui_imgui.cpp fills them with Dear ImGui, and nobody
// else knows that library.
//
// Immediate mode: between gui_frame_begin() and gui_frame_end() every frame says anew what is on the screen; a control
// writes into the caller's variable. A screen is a window, or (headless) an image that gui_frame_paint() fills with the
// same triangles. Lengths are in points; on a screen of high resolution a point is several px (gui_density()). Text grows with
// gui_em(), so layouts are written in ems.
#ifndef SPLATLAB_LAB_APP_GUI_H
#define SPLATLAB_LAB_APP_GUI_H

#include "lab/base/image.h"

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct Window Window;
typedef uint32_t GuiColour; // 0xRRGGBBAA, straight alpha

typedef enum { GUI_BODY, GUI_BOLD, GUI_TITLE, GUI_SMALL, GUI_MONO, GUI_MONO_SMALL, GUI_STYLE_COUNT } GuiStyle;

typedef struct {
    double x, y, width, height;
} GuiRect;

// ---- life ----

// window: NULL for headless. Warns where the fonts are not installed.
void gui_open(Window *window);
void gui_close(void);
void gui_set_scale(double scale, double density); // from the next frame on; density: px per point, 1 at first
double gui_density(void);

// ---- a frame ----

// width, height: of the screen, points.
void gui_frame_begin(int width, int height);
void gui_frame_end(void);         // with a window: draws into it
void gui_frame_paint(Image8 *to); // headless, after gui_frame_end(): 3 channels, the screen's size in px
GuiRect gui_screen(void);         // the whole screen
double gui_em(void);              // height of a line of GUI_BODY text

// ---- mouse and keys ----

enum { GUI_LEFT, GUI_RIGHT, GUI_MIDDLE, GUI_BUTTON_COUNT };
typedef struct {
    double x, y;
    double moved_x, moved_y; // since the frame before
    double wheel;            // notches, away from the person is positive
    bool down[GUI_BUTTON_COUNT], pressed[GUI_BUTTON_COUNT], released[GUI_BUTTON_COUNT];
} GuiMouse;

GuiMouse gui_mouse(void);
// How often a GLFW_KEY_... went down (or repeated) with exactly these modifiers; 0 while a text field has the keyboard.
enum { GUI_PLAIN = 0, GUI_SHIFT = 1, GUI_CTRL = 2 }; // as GLFW_MOD_...
int gui_key(int key, int modifiers);
bool gui_key_pressed(void); // did any key go down, not counting repetitions of one that is held?
bool gui_ctrl(void);        // is held
bool gui_shift(void);       // is held
bool gui_is_holding(void);  // a mouse button or a key is down, or a control is being changed

// ---- where controls go ----

// A rectangle of the screen with controls in it, from top to bottom. padding: inside, ems.
void gui_panel_begin(const char *name, GuiRect place, GuiColour background, double padding);
// The same above all panels; ends with gui_panel_end() too. takes_mouse: else what lies below gets the mouse.
void gui_overlay_begin(const char *name, GuiRect place, GuiColour background, double padding, bool takes_mouse);
void gui_panel_end(void);
double gui_width_left(void);                   // to the panel's right edge, from the left one or behind gui_same_line()
GuiRect gui_take(double width, double height); // keeps a place free for drawing, as if it were a control
void gui_same_line(double gap_em);
void gui_gap(double ems);
void gui_rule(void); // a thin line across

// ---- controls; true when the value changed in this frame. The label is also the name in gui_place(). ----

void gui_text(GuiStyle style, GuiColour colour, const char *format, ...) __attribute__((format(printf, 3, 4)));
void gui_paragraph(GuiStyle style, GuiColour colour, const char *text); // broken into lines at the panel's width
bool gui_slider(const char *label, double *value, double low, double high, const char *format, bool logarithmic);
bool gui_switch(const char *label, bool *value);
bool gui_button(const char *label, double width);                                    // width 0: as wide as the label
bool gui_choice(const char *label, int *value, const char *const *names, int count); // buttons side by side
bool gui_colour(const char *label, double rgb[3]);
bool gui_text_field(const char *label, char *text, int size);
void gui_hint(const char *text); // shown while the mouse rests on the control before

// A place that takes the mouse: for a canvas. Drags that begin in it stay with it.
typedef struct {
    GuiRect place;
    bool hovered, held;
} GuiArea;
GuiArea gui_area(const char *name, double width, double height);

// Where each control of this frame is so far, as the window system counts (where a mouse would have to go); false behind
// the last one. i: 0, 1, ...
bool gui_place(int i, const char **label, GuiRect *place);

// ---- drawing, in the panel that is open; clipped to it ----

void gui_draw_line(double x0, double y0, double x1, double y1, GuiColour colour, double width);
void gui_draw_curve(const double *xy, int count, bool closed, GuiColour colour, double width); // xy: (count, 2)
void gui_draw_shape(const double *xy, int count, GuiColour colour);                            // convex, filled
void gui_draw_rect(GuiRect place, GuiColour colour, double radius);
void gui_draw_frame(GuiRect place, GuiColour colour, double radius, double width);
void gui_draw_disc(double x, double y, double radius, GuiColour colour);
void gui_draw_ring(double x, double y, double radius, GuiColour colour, double width);
void gui_draw_text(GuiStyle style, double x, double y, GuiColour colour, const char *format, ...)
    __attribute__((format(printf, 5, 6)));
double gui_text_width(GuiStyle style, const char *text);
double gui_text_height(GuiStyle style);

// A picture on the screen. fill: 3 or 4 channels, copied. GUI_PICTURE_COUNT of them, numbered from 0.
enum { GUI_PICTURE_COUNT = 4 };
void gui_picture_fill(int picture, const Image8 *image, bool smooth);
void gui_draw_picture(int picture, GuiRect place);

#ifdef __cplusplus
}
#endif
#endif
