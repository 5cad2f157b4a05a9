// widget_files.c - scenes and pictures on disk; what scripts read while the window is open.
#include "lab/app/widget.h"
#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/io/file.h"
#include "lab/io/image_io.h"
#include "splat2d/scene2d_json.h"

#include <stdio.h>
#include <stdlib.h>
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

bool widget_write_state(Widget *widget) {
    if (!widget->state_path[0] || scene_equals(&widget->written, &widget->scene)) return true;
    if (!scene2d_save(widget->state_path, &widget->scene)) return false;
    scene2d_destroy(&widget->written);
    widget->written = scene2d_copy(&widget->scene);
    return true;
}

// { "canvas": [x, y, width, height], ... } in points of the window, how many of them a canvas px has, and the marks.
bool widget_write_places(Widget *widget) {
    if (!widget->places_path[0]) return true;
    char *text = NULL;
    const char *label;
    size_t size = 0;
    GuiRect r;
    FILE *out = open_memstream(&text, &size);
    if (!out) return fail("cannot note where the controls are: out of memory");
    fprintf(out, "{\n  \"zoom\": %.17g,\n  \"marks\": %ld", widget->canvas.view.zoom, screen_marks(widget->screen));
    for (int i = 0; gui_place(i, &label, &r); i++)
        if (!strpbrk(label, "\"\\"))
            fprintf(out, ",\n  \"%s\": [%.9g, %.9g, %.9g, %.9g]", label, r.x, r.y, r.width, r.height);
    fprintf(out, "\n}\n");
    fclose(out);
    bool is_new = !widget->places || strcmp(text, widget->places) != 0;
    bool good = !is_new || file_write(widget->places_path, text, size);
    if (is_new) {
        mem_free(widget->places);
        widget->places = mem_text(text);
    }
    free(text);
    return good;
}
