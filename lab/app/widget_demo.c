// widget_demo.c - a demo's steps in the widget: the strip above the picture, the keys of a lecturer, the question.
#include "lab/app/palette.h"
#include "lab/app/widget.h"
#include "lab/base/clock.h"
#include "lab/base/fail.h"
#include "splat2d/loss.h"

#include <GLFW/glfw3.h>
#include <math.h>
#include <string.h>

static const double PLAY_S = 6;                       // a step is shown while they follow by themselves
static const double QUESTION_EMS = 34, ROW_EMS = 1.6; // of the card with the question, of a line on it

void widget_show_step(Widget *widget, int step) {
    const DemoStep *s = &widget->demo->steps[step];
    widget->step = step;
    widget->is_asking = false;
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

// ---- keys ----

static void go_to(Widget *widget, int step) {
    int last = widget->demo->count - 1;
    widget_show_step(widget, step < 0 ? 0 : step > last ? last : step);
}

static void go_forward(Widget *widget) {
    bool has_question = widget->demo->steps[widget->step].question != NULL;
    if (widget->asks_audience && has_question && !widget->is_asking && widget->step < widget->demo->count - 1)
        widget->is_asking = true;
    else
        go_to(widget, widget->step + 1);
}

static void go_back(Widget *widget) {
    if (widget->is_asking)
        widget->is_asking = false;
    else
        go_to(widget, widget->step - 1);
}

bool widget_demo_plays(Widget *widget) {
    if (!widget->is_playing || clock_seconds() - widget->stepped_s < PLAY_S) return widget->is_playing;
    widget->stepped_s = clock_seconds();
    go_forward(widget);
    if (widget->step == widget->demo->count - 1) widget->is_playing = false;
    return true;
}

static void choose_demo(Widget *widget, int i) {
    Demo fresh;
    if (!demo_load(DEMO_NAMES[i], &fresh)) {
        widget_say(widget, true, "%s", fail_text());
        return;
    }
    demo_free(widget->demo);
    *widget->demo = fresh;
    widget_show_step(widget, 0);
}

static void play(Widget *widget) {
    widget->is_playing = !widget->is_playing;
    widget->stepped_s = clock_seconds();
    widget_say(widget, false, widget->is_playing ? "Playing; Space freezes" : "Frozen; Space plays");
}

void widget_demo_keys(Widget *widget) {
    for (int i = gui_key(GLFW_KEY_RIGHT, GUI_PLAIN); i > 0; i--) go_forward(widget);
    for (int i = gui_key(GLFW_KEY_LEFT, GUI_PLAIN); i > 0; i--) go_back(widget);
    for (int i = 0; i < DEMO_COUNT; i++)
        if (gui_key(GLFW_KEY_1 + i, GUI_PLAIN)) choose_demo(widget, i);
    if (gui_key(GLFW_KEY_R, GUI_PLAIN)) widget_show_step(widget, widget->step);
    if (widget->page != PAGE_TRAP && gui_key(GLFW_KEY_SPACE, GUI_PLAIN) % 2) play(widget);
    if (gui_key(GLFW_KEY_A, GUI_PLAIN) % 2 == 0) return;
    widget->asks_audience = !widget->asks_audience;
    widget->is_asking = false;
    widget_say(widget, false, widget->asks_audience ? "Audience: → asks, → again answers" : "Audience: off");
}

// ---- strip and question ----

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
    gui_paragraph(GUI_BODY, INK, step->caption);
    if (step->question && !widget->asks_audience) gui_paragraph(GUI_BOLD, ACCENT_WARM, step->question);
    gui_panel_end();
}

void widget_demo_question(Widget *widget, GuiRect place) {
    const char *question = widget->demo->steps[widget->step].question;
    double em = gui_em(), width = fmin(QUESTION_EMS * em, place.width - 2 * em);
    double lines = ceil(1.1 * gui_text_width(GUI_TITLE, question) / (width - 4 * em));
    double height = (lines * ROW_EMS + 6) * em;
    gui_overlay_begin("dim the picture", place, 0x0a0c12d0, 0, false);
    gui_panel_end();
    gui_overlay_begin(
        "question",
        (GuiRect){place.x + (place.width - width) / 2, place.y + (place.height - height) / 2, width, height}, CARD, 2,
        false);
    gui_paragraph(GUI_TITLE, ACCENT_WARM, question);
    gui_gap(0.4);
    gui_text(GUI_BODY, INK_QUIET, "What do you expect?   → shows it");
    gui_panel_end();
}
