// exercise_show.c - the pictures of the last wrong answer, side by side in a window.
#include "lab/app/exercise_options.h"

#include "exercises/harness/pictures.h"
#include "lab/app/command_line.h"
#include "lab/app/gui.h"
#include "lab/app/palette.h"
#include "lab/app/screen.h"
#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/io/file.h"
#include "lab/io/image_io.h"

#include <GLFW/glfw3.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const char *const TITLES[PICTURE_COUNT] = {"yours", "reference", "difference, 8 times as bright"};

static bool load(const char *root, const Exercise *e, Image8 images[PICTURE_COUNT]) {
    for (int k = 0; k < PICTURE_COUNT; k++) {
        char *path = pictures_path(root, e, (PictureKind)k);
        bool good = file_exists(path) && image_load8(path, &images[k]);
        if (!good)
            fail("exercise %d has no picture %s; a wrong answer with a picture leaves one: splatlab exercise run %d",
                 e->number, path, e->number);
        mem_free(path);
        if (!good) return false;
    }
    return true;
}

static void print_paths(const char *root, const Exercise *e) {
    for (int k = 0; k < PICTURE_COUNT; k++) {
        char *path = pictures_path(root, e, (PictureKind)k);
        printf("%-10s %s\n", k == PICTURE_DIFFERENCE ? "difference" : TITLES[k], path);
        mem_free(path);
    }
}

// As large as the place allows, whole, in its middle.
static GuiRect fitted(const Image8 *image, GuiRect place) {
    double scale = fmin(place.width / image->width, place.height / image->height);
    double width = image->width * scale, height = image->height * scale;
    return (GuiRect){place.x + (place.width - width) / 2, place.y + (place.height - height) / 2, width, height};
}

static void draw(const Image8 images[PICTURE_COUNT], const Exercise *e) {
    GuiRect all = gui_screen();
    double em = gui_em(), column = (all.width - 2 * em) / PICTURE_COUNT;
    gui_panel_begin("pictures", all, PANEL, 0);
    gui_draw_text(GUI_TITLE, all.x + em, all.y + 0.8 * em, INK, "E%02d %s", e->number, e->name);
    for (int k = 0; k < PICTURE_COUNT; k++) {
        GuiRect place = {all.x + em + k * column, all.y + 5 * em, column - em, all.height - 6 * em};
        GuiRect picture = fitted(&images[k], place);
        gui_draw_text(GUI_BODY, picture.x, picture.y - 1.7 * em, INK_QUIET, "%s", TITLES[k]);
        gui_draw_picture(k, picture);
    }
    gui_panel_end();
}

static bool loop(Screen *screen, const Image8 images[PICTURE_COUNT], const Exercise *e) {
    for (int k = 0; k < PICTURE_COUNT; k++) gui_picture_fill(k, &images[k], false);
    while (screen_begin(screen, false)) {
        draw(images, e);
        if (gui_key(GLFW_KEY_ESCAPE, GUI_PLAIN) || gui_key(GLFW_KEY_Q, GUI_PLAIN)) screen_quit(screen);
        if (!screen_end(screen)) return false;
        screen_show(screen);
    }
    return true;
}

static bool has_display(void) {
    const char *x = getenv("DISPLAY"), *wayland = getenv("WAYLAND_DISPLAY");
    return (x && x[0]) || (wayland && wayland[0]);
}

int exercise_show(const char *root, const Exercise *e, const ExerciseOptions *o) {
    Image8 images[PICTURE_COUNT] = {{0}};
    bool good = window_options_check(&o->window, "exercise show") && load(root, e, images);
    // A screenshot with a size needs no window.
    ScreenOptions options = window_options_screen(&o->window, "splatlab - a wrong answer");
    options.headless = !has_display() && o->window.screenshot[0] && o->window.size[0];
    if (good && !options.headless && !has_display()) {
        print_paths(root, e);
    } else if (good) {
        Screen *screen = screen_open(&options);
        good = screen && loop(screen, images, e);
        screen_close(screen);
    }
    for (int k = 0; k < PICTURE_COUNT; k++) image8_destroy(&images[k]);
    return good ? 0 : command_failed();
}
