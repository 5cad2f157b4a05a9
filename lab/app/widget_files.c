// widget_files.c - scenes and pictures on disk; what scripts read while the window is open.
#include "lab/app/places.h"
#include "lab/app/widget.h"
#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/io/image_io.h"
#include "splat2d/scene2d_json.h"

#include <string.h>

void widget_save(Widget *widget) {
    if (scene2d_save(widget->path, &widget->scene))
        widget_say(widget, false, "Saved %s", widget->path);
    else
        widget_say(widget, true, "%s", fail_text());
}

void widget_load(Widget *widget) {
    Scene2d scene;
    if (!scene2d_load(widget->path, &scene)) {
        widget_say(widget, true, "%s", fail_text());
        return;
    }
    widget_set_scene(widget, scene);
    widget_say(widget, false, "Loaded %s", widget->path);
}

// "folder/scene.json" -> "folder/scene.png"
static char *picture_path(const char *path) {
    const char *name = strrchr(path, '/');
    const char *dot = strrchr(name ? name : path, '.');
    return mem_format("%.*s.png", dot ? (int)(dot - path) : (int)strlen(path), path);
}

void widget_export(Widget *widget) {
    char *path = picture_path(widget->path);
    ImageF image = imagef_create(widget->scene.width, widget->scene.height, 3);
    raster2d_load(&widget->raster, &widget->scene, view2d_whole());
    raster2d_draw(&widget->raster, &widget->settings, &image, NULL);
    if (image_savef(path, &image))
        widget_say(widget, false, "Exported %s, %d × %d px", path, image.width, image.height);
    else
        widget_say(widget, true, "%s", fail_text());
    imagef_destroy(&image);
    mem_free(path);
}

void widget_toggle_film(Widget *widget) {
    const char *path = widget->demo ? "demo.gif" : "widget.gif";
    if (!widget->film.is_on) {
        widget_film_begin(&widget->film);
        return;
    }
    int count = widget->film.count;
    if (widget_film_save(&widget->film, path))
        widget_say(widget, false, "%s: %d frames", path, count);
    else
        widget_say(widget, true, "%s", fail_text());
}

bool widget_write_state(Widget *widget) {
    if (!widget->state_path[0] || scene_equals(&widget->written, &widget->scene)) return true;
    if (!scene2d_save(widget->state_path, &widget->scene)) return false;
    scene2d_destroy(&widget->written);
    widget->written = scene2d_copy(&widget->scene);
    return true;
}

bool widget_write_places(Widget *widget) {
    double minor[PSD_WAY_COUNT] = {0, 0}; // the smaller eigenvalue of either walk
    for (int way = 0; widget->trap && way < PSD_WAY_COUNT; way++)
        minor[way] = sym2_eigen(psd_walk_covariance(&widget->trap->trap.walks[way])).minor;
    const PlacesNumber numbers[] = {{"zoom", screen_unit(widget->screen) * widget->canvas.view.zoom},
                                    {"probe x", widget->probe[0]},
                                    {"probe y", widget->probe[1]},
                                    {"active", widget->active},
                                    {"step", widget->step},
                                    {"playing", widget->is_playing},
                                    {"asking", widget->is_asking},
                                    {"raw minor", minor[PSD_RAW]},
                                    {"factored minor", minor[PSD_FACTORED]}};
    return places_write(widget->places_path, &widget->places, widget->screen, numbers,
                        sizeof numbers / sizeof numbers[0]);
}
