// screen.c - frames one after another, in a window or in memory.
#include "lab/app/screen.h"

#include "lab/app/gui.h"
#include "lab/app/window.h"
#include "lab/base/clock.h"
#include "lab/base/fail.h"
#include "lab/base/interrupt.h"
#include "lab/base/mem.h"
#include "lab/io/image_io.h"

#include <GLFW/glfw3.h>
#include <math.h>
#include <string.h>

// The size for which layouts are made; text keeps its share of larger and smaller screens.
enum { DESIGN_WIDTH = 1600, DESIGN_HEIGHT = 1000 };
static const double SCALE_LOW = 0.55, SCALE_HIGH = 4, ZOOM_STEP = 1.1;
static const double IDLE_WAIT_S = 0.2;
enum { SETTLING_FRAMES = 2, LIVELY_FRAMES = 4 }; // drawn after an event, so that controls settle
static const float BACKDROP[3] = {0.05f, 0.06f, 0.08f};

struct Screen {
    ScreenOptions options;
    Window *window; // NULL when headless
    int frame;      // shown so far
    int lively;     // frames that are drawn without waiting
    int zoom;       // steps
    long marks;
    bool quit;
    double began_s, work_ms;
};

Screen *screen_open(const ScreenOptions *options) {
    Screen *screen = mem_alloc(1, sizeof *screen);
    screen->options = *options;
    screen->lively = LIVELY_FRAMES;
    if (options->size[0] == 0) screen->options.size[0] = DESIGN_WIDTH, screen->options.size[1] = DESIGN_HEIGHT;
    if (!options->headless) {
        screen->window =
            window_create(options->title, screen->options.size[0], screen->options.size[1], options->density);
        if (!screen->window) {
            mem_free(screen);
            return NULL;
        }
    }
    interrupt_install();
    gui_open(screen->window);
    return screen;
}

void screen_close(Screen *screen) {
    if (!screen) return;
    gui_close();
    window_destroy(screen->window);
    mem_free(screen);
}

bool screen_is_window(const Screen *screen) { return screen->window != NULL; }

double screen_unit(const Screen *screen) { return screen->window ? window_unit(screen->window) : 1; }

long screen_marks(const Screen *screen) { return screen->marks; }

double screen_work_ms(const Screen *screen) { return screen->work_ms; }

static void wait_for_events(Screen *screen, bool is_moving) {
    bool waits = screen->lively == 0 && !is_moving && screen->options.frames == 0;
    double asked_s = clock_seconds();
    window_poll(screen->window, waits ? IDLE_WAIT_S : 0);
    bool was_event = waits && clock_seconds() - asked_s < IDLE_WAIT_S * 0.98;
    if (was_event || gui_is_holding())
        screen->lively = LIVELY_FRAMES;
    else if (screen->lively > 0)
        screen->lively--;
}

static double screen_density(const Screen *screen) {
    if (screen->window) return window_density(screen->window);
    return screen->options.density > 0 ? screen->options.density : 1;
}

// In steps, since each new size makes all glyphs anew.
static void follow_size(const Screen *screen, double width, double height) {
    double fits = fmin(width / DESIGN_WIDTH, height / DESIGN_HEIGHT);
    double scale = round(fits * 16) / 16 * pow(ZOOM_STEP, screen->zoom);
    gui_set_scale(fmin(SCALE_HIGH, fmax(SCALE_LOW, scale)), screen_density(screen));
}

bool screen_begin(Screen *screen, bool is_moving) {
    if (screen->options.frames > 0 && screen->frame >= screen->options.frames) return false;
    if (screen->quit || interrupt_requested()) return false;
    int width = screen->options.size[0], height = screen->options.size[1];
    if (screen->window) {
        wait_for_events(screen, is_moving);
        if (window_is_closing(screen->window)) return false;
        window_begin(screen->window, BACKDROP);
        window_size(screen->window, &width, &height);
    }
    screen->began_s = clock_seconds();
    follow_size(screen, width, height);
    gui_frame_begin(width, height);
    for (int held = 0; screen->window && held <= (GUI_SHIFT | GUI_CTRL); held++)
        screen->marks += window_key_count(screen->window, GLFW_KEY_F12, held);
    return true;
}

bool screen_read(Screen *screen, Image8 *image) {
    if (screen->window) return window_read(screen->window, image);
    double density = screen_density(screen);
    *image = image8_create((int)(screen->options.size[0] * density), (int)(screen->options.size[1] * density), 3);
    for (int i = 0; i < image->width * image->height * 3; i++)
        image->bytes[i] = (uint8_t)lroundf(255 * BACKDROP[i % 3]);
    gui_frame_paint(image);
    return true;
}

bool screen_save(Screen *screen, const char *path) {
    Image8 image = {0};
    bool good = screen_read(screen, &image) && image_save8(path, &image);
    image8_destroy(&image);
    return good;
}

bool screen_end(Screen *screen) {
    bool good = true;
    gui_frame_end();
    screen->frame++;
    bool is_last = screen->frame == screen->options.frames;
    if (is_last && screen->options.screenshot && screen->options.screenshot[0])
        good = screen_save(screen, screen->options.screenshot);
    double work_ms = 1e3 * (clock_seconds() - screen->began_s);
    if (screen->frame <= SETTLING_FRAMES) return good; // glyphs and shaders are made
    screen->work_ms = screen->work_ms > 0 ? 0.9 * screen->work_ms + 0.1 * work_ms : work_ms;
    return good;
}

void screen_show(Screen *screen) {
    if (screen->window) window_show(screen->window);
}

void screen_zoom(Screen *screen, int steps) { screen->zoom = steps == 0 ? 0 : screen->zoom + steps; }

void screen_toggle_full(Screen *screen) {
    if (screen->window) window_toggle_full_screen(screen->window);
}

void screen_quit(Screen *screen) { screen->quit = true; }
