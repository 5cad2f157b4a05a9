// widget_demo.c - a demo's steps in the widget: the strip above the picture, the keys of a lecturer, the film.
#include "lab/app/palette.h"
#include "lab/app/widget.h"
#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/io/image_io.h"
#include "splat2d/loss.h"

#include <GLFW/glfw3.h>
#include <stdio.h>
#include <string.h>

enum { FILM_DELAY_MS = 80, FILM_WIDTH_MAX = 800 };
static const char FILM_PATH[] = "demo.gif";

void widget_show_step(Widget *widget, int step) {
    const DemoStep *s = &widget->demo->steps[step];
    widget->step = step;
    scene2d_destroy(&widget->compared);
    widget_set_scene(widget, scene2d_copy(&s->scene));
    widget->active = s->active;
    widget->layer = (WidgetLayer)s->layer;
    widget->shows_outlines = s->outlines;
    widget->settings.discs = s->discs;
    widget->settings.background_unattenuated = s->unattenuated;
    widget->settings.rule.stop = s->stop;
    memcpy(widget->probe, s->probe, sizeof widget->probe);
    widget->probe_frozen = true;
    widget_show_page(widget, s->page == DEMO_PSD ? PAGE_TRAP : PAGE_BLOBS);
    if (s->page != DEMO_PSD) return;
    widget->trap->trap.learning_rate = s->rate;
    trap_page_restart(widget->trap);
    trap_page_advance(widget->trap, s->walk);
}

// ---- PSNR against another step's picture ----

static ImageF picture_of(const Widget *widget, const Scene2d *scene) {
    Raster2d raster = {0};
    ImageF picture = imagef_create(scene->width, scene->height, 3);
    raster2d_load(&raster, scene, view2d_whole());
    raster2d_draw(&raster, &widget->settings, &picture, NULL);
    raster2d_destroy(&raster);
    return picture;
}

static bool compares(Widget *widget) {
    int other = widget->demo->steps[widget->step].compare_to;
    if (other < 0 || other >= widget->demo->count) return false;
    const Scene2d *target = &widget->demo->steps[other].scene;
    if (target->width != widget->scene.width || target->height != widget->scene.height) return false;
    if (scene_equals(&widget->compared, &widget->scene)) return true;
    ImageF picture = picture_of(widget, &widget->scene), photo = picture_of(widget, target);
    widget->psnr = metric_psnr(&picture, &photo);
    imagef_destroy(&picture);
    imagef_destroy(&photo);
    scene2d_destroy(&widget->compared);
    widget->compared = scene2d_copy(&widget->scene);
    return true;
}

// ---- film ----

static void end_film(Widget *widget) {
    widget->is_filming = false;
    if (widget->film_count == 0) return;
    if (image_save_gif(FILM_PATH, widget->film, widget->film_count, FILM_DELAY_MS))
        widget_say(widget, false, "%s: %d frames", FILM_PATH, widget->film_count);
    else
        widget_say(widget, true, "%s", fail_text());
    for (int i = 0; i < widget->film_count; i++) image8_destroy(&widget->film[i]);
    widget->film_count = 0;
}

void widget_keep_frame(Widget *widget) {
    if (!widget->is_filming) return;
    Image8 frame = {0};
    if (!screen_read(widget->screen, &frame)) return;
    if (!widget->film) widget->film = mem_alloc(FILM_FRAMES_MAX, sizeof *widget->film);
    int k = (frame.width + FILM_WIDTH_MAX - 1) / FILM_WIDTH_MAX;
    bool same = widget->film_count == 0 || widget->film[0].width == frame.width / k;
    if (same) widget->film[widget->film_count++] = image8_downscale(&frame, k);
    image8_destroy(&frame);
    if (!same || widget->film_count == FILM_FRAMES_MAX) end_film(widget);
}

// ---- keys and strip ----

void widget_demo_keys(Widget *widget) {
    int forward = gui_key(GLFW_KEY_RIGHT, GUI_PLAIN) - gui_key(GLFW_KEY_LEFT, GUI_PLAIN);
    int step = widget->step + forward, last = widget->demo->count - 1;
    if (forward) widget_show_step(widget, step < 0 ? 0 : step > last ? last : step);
    if (gui_key(GLFW_KEY_R, GUI_PLAIN)) widget_show_step(widget, widget->step);
    if (gui_key(GLFW_KEY_G, GUI_PLAIN) % 2 == 0) return;
    if (widget->is_filming)
        end_film(widget);
    else
        widget->is_filming = true;
}

static void dots(const Widget *widget) {
    double em = gui_em();
    GuiRect row = gui_take((widget->demo->count + 1) * 1.1 * em, 1.5 * em);
    for (int i = 0; i < widget->demo->count; i++)
        gui_draw_disc(row.x + (i + 0.5) * 1.1 * em, row.y + 0.85 * em, (i == widget->step ? 0.34 : 0.22) * em,
                      i == widget->step  ? ACCENT
                      : i < widget->step ? INK_QUIET
                                         : INK_FAINT);
}

void widget_demo_strip(Widget *widget, GuiRect place) {
    const DemoStep *step = &widget->demo->steps[widget->step];
    gui_panel_begin("demo", place, CARD, 0.9);
    gui_text(GUI_TITLE, INK, "%s", widget->demo->title);
    gui_same_line(1.2);
    dots(widget);
    if (compares(widget)) {
        gui_same_line(1);
        gui_text(GUI_BOLD, ACCENT, "%d Gaussian%s   PSNR %.1f dB", widget->scene.count,
                 widget->scene.count == 1 ? "" : "s", widget->psnr);
    }
    if (widget->is_filming) {
        gui_same_line(1);
        gui_text(GUI_BOLD, BAD, "● %d", widget->film_count);
    }
    gui_paragraph(GUI_BODY, INK, step->caption);
    if (step->question) gui_paragraph(GUI_BOLD, ACCENT_WARM, step->question);
    gui_panel_end();
}
