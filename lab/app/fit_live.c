// fit_live.c - the loop, the layout and the keys of a fit's window.
#include "lab/app/fit_live.h"

#include "lab/app/fit_trace.h"
#include "lab/app/fit_views.h"
#include "lab/app/gui.h"
#include "lab/app/palette.h"
#include "lab/app/places.h"
#include "lab/app/readout.h"
#include "lab/app/window_keys.h"
#include "lab/base/clock.h"
#include "lab/base/mem.h"

#include <GLFW/glfw3.h>
#include <math.h>

// How fast it goes: few enough steps a second to talk about each, one a frame, or as many as a lively window can have.
typedef enum { PACE_SLOW, PACE_FRAME, PACE_FAST } Pace;
static const double SLOW_STEP_S = 0.4, FAST_FRAME_S = 0.03;

typedef enum { VIEW_PHOTO, VIEW_FIT, VIEW_DISCS, VIEW_ERROR, VIEW_COUNT } View;

// Ems of the panel, of a curve in it, between pictures, of the name above one.
static const double PANEL_EMS = 23, CURVE_EMS = 13, GAP_EMS = 1, TITLE_EMS = 1.5;

typedef struct {
    FitJob *job; // borrowed, as the screen
    Screen *screen;
    const WindowOptions *options;
    FitTrace trace;
    double psnr;
    int pace;
    bool is_paused, is_saved, is_stale, shows_help;
    double stepped_s;         // when the last step was
    double frame_s, frame_ms; // when the last frame began; mean time from one to the next
    char *state, *places;     // what stands in the files, owned
} FitLive;

// ---- steps ----

static void take_steps(FitLive *live, int count) {
    for (int i = 0; i < count && !fit_job_is_done(live->job); i++) fit_job_step(live->job);
    live->stepped_s = clock_seconds();
    live->is_stale = true;
}

static void go_on(FitLive *live) {
    double began_s = clock_seconds();
    if (live->is_paused || fit_job_is_done(live->job)) return;
    if (live->pace == PACE_SLOW && began_s - live->stepped_s < SLOW_STEP_S) return;
    do take_steps(live, 1);
    while (live->pace == PACE_FAST && clock_seconds() - began_s < FAST_FRAME_S && !fit_job_is_done(live->job));
}

static void restart(FitLive *live) {
    fit_job_restart(live->job);
    live->trace.count = 0;
    live->is_saved = false;
    live->is_stale = true;
}

static bool save(FitLive *live) {
    live->is_saved = true;
    return fit_job_save(live->job);
}

// ---- what is shown ----

static void show_image(View view, const ImageF *picture) {
    Image8 bytes = image8_from_float(picture);
    gui_picture_fill(view, &bytes, true);
    image8_destroy(&bytes);
}

// Pictures and figures of the blobs as they are now.
static void refresh(FitLive *live) {
    FitJob *job = live->job;
    if (!live->is_stale) return;
    live->psnr = fit_job_score(job);
    Scene2d scene = fit2d_scene(job->fit);
    ImageF error = fit_view_error(&job->photo, &job->picture), discs = fit_view_discs(&scene);
    show_image(VIEW_FIT, &job->picture);
    show_image(VIEW_DISCS, &discs);
    show_image(VIEW_ERROR, &error);
    imagef_destroy(&error);
    imagef_destroy(&discs);
    scene2d_destroy(&scene);
    int steps = fit2d_steps_done(job->fit);
    if (steps > 0) fit_trace_add(&live->trace, steps, (double[]){job->loss.total, live->psnr, fit2d_count(job->fit)});
    live->is_stale = false;
}

static void show_view(View view, GuiRect place) {
    static const char *const names[VIEW_COUNT] = {"Photograph", "Gaussians", "Where they lie: 1σ", "Error × 4"};
    gui_draw_text(GUI_BOLD, place.x, place.y - TITLE_EMS * gui_em(), INK, "%s", names[view]);
    gui_draw_picture(view, place);
    gui_draw_frame(place, LINE, 0, 1);
}

// Two by two in the middle, as large as there is room for.
static void show_stage(const FitLive *live, GuiRect stage) {
    double em = gui_em(), gap = GAP_EMS * em, title = TITLE_EMS * em;
    const ImageF *photo = &live->job->photo;
    double zoom =
        fmin((stage.width - 3 * gap) / 2 / photo->width, (stage.height - 2.5 * gap - 2 * title) / 2 / photo->height);
    double width = photo->width * zoom, height = photo->height * zoom;
    double left = stage.x + (stage.width - 2 * width - gap) / 2;
    double top = stage.y + (stage.height - 2 * (height + title) - gap) / 2;
    gui_panel_begin("fit stage", stage, PANEL_DEEP, 0);
    for (int view = 0; view < VIEW_COUNT; view++)
        show_view(view, (GuiRect){left + view % 2 * (width + gap), top + title + view / 2 * (height + title + gap),
                                  width, height});
    gui_panel_end();
}

// ---- panel ----

static void progress_bar(const FitLive *live) {
    double em = gui_em(), share = (double)fit2d_steps_done(live->job->fit) / live->job->options.iterations;
    GuiRect place = gui_take(gui_width_left(), 0.5 * em);
    gui_draw_rect(place, 0x262b38ff, 0.25 * em);
    place.width *= share;
    if (share > 0) gui_draw_rect(place, live->is_saved ? GOOD : ACCENT, 0.25 * em);
}

static void controls(FitLive *live) {
    static const char *const paces[] = {"Slow", "A step a frame", "Fast"};
    double third = (gui_width_left() - 0.5 * gui_em()) / 3;
    if (gui_button(live->is_paused ? "Go on" : "Pause", third)) live->is_paused = !live->is_paused;
    gui_hint("Space");
    gui_same_line(0.25);
    if (gui_button("Step", third)) take_steps(live, 1);
    gui_hint("S");
    gui_same_line(0.25);
    if (gui_button("Restart", third)) restart(live);
    gui_hint("R: the same fit from its first step");
    gui_choice("pace", &live->pace, paces, 3);
    gui_hint("1, 2, 3");
}

static void figures(const FitLive *live) {
    const FitJob *job = live->job;
    int steps = fit2d_steps_done(job->fit);
    readout("Step", INK, "%d of %d", steps, job->options.iterations);
    readout("Gaussians", INK, "%d %s", fit2d_count(job->fit), job->options.isotropic ? "round" : "stretched");
    readout("PSNR", GOOD, "%.2f dB", live->psnr);
    gui_rule();
    gui_text(GUI_SMALL, INK_QUIET, "Loss = (1 − λ) L1 + λ (1 − SSIM),  λ = %g", job->options.lambda);
    readout("Loss", ACCENT_WARM, "%.5f", job->loss.total);
    readout("L1", INK, "%.5f", job->loss.l1);
    readout("SSIM", INK, "%.4f", job->loss.ssim);
    gui_rule();
    readout("Photograph", INK, "%d × %d px", job->photo.width, job->photo.height);
    if (!screen_is_window(live->screen)) return;
    readout("One step", INK, "%.1f ms", steps > 0 ? 1e3 * job->seconds / steps : 0.0);
    readout("Frames a second", INK, "%.0f", live->frame_ms > 0 ? 1e3 / live->frame_ms : 0.0);
}

// The curves fill what is left of the panel. The number of blobs is one only where they are added on the way.
static void curves(const FitLive *live, GuiRect panel) {
    double em = gui_em();
    GuiRect rest = gui_take(gui_width_left(), 0);
    int count = live->job->options.grow ? FIT_CURVE_COUNT : FIT_BLOBS;
    double height = fmin(CURVE_EMS * em, (panel.y + panel.height - rest.y - 0.3 * em) / count);
    for (int curve = 0; curve < count; curve++)
        fit_trace_plot(&live->trace, curve, live->job->options.iterations,
                       (GuiRect){rest.x, rest.y + curve * height, rest.width, height});
}

static void show_panel(FitLive *live, GuiRect place) {
    gui_panel_begin("panel", place, PANEL, 0.9);
    gui_text(GUI_TITLE, INK, "Fitting a picture");
    gui_paragraph(GUI_SMALL, INK_QUIET,
                  "Draw the blobs, compare with the photograph, ask how each of their numbers should move, move it: "
                  "mean, two log-scales, angle, opacity, colour.");
    gui_gap(0.1);
    progress_bar(live);
    controls(live);
    bool done = fit_job_is_done(live->job);
    gui_text(GUI_SMALL, done ? GOOD : INK_QUIET, done ? "✓ Done, and saved in" : "Closing saves what there is, in");
    gui_same_line(0.4);
    gui_text(GUI_MONO_SMALL, done ? GOOD : INK_QUIET, "%s", live->job->folder.folder);
    gui_rule();
    figures(live);
    gui_rule();
    curves(live, place);
    gui_panel_end();
}

// ---- a frame ----

static void use_keys(FitLive *live) {
    window_keys(live->screen);
    if (gui_key(GLFW_KEY_SPACE, GUI_PLAIN) % 2) live->is_paused = !live->is_paused;
    if (gui_key(GLFW_KEY_R, GUI_PLAIN)) restart(live);
    int steps = gui_key(GLFW_KEY_S, GUI_PLAIN);
    if (steps) take_steps(live, steps);
    for (int pace = PACE_SLOW; pace <= PACE_FAST; pace++)
        if (gui_key(GLFW_KEY_1 + pace, GUI_PLAIN)) live->pace = pace;
}

static void count_frame(FitLive *live) {
    double now_s = clock_seconds(), ms = 1e3 * (now_s - live->frame_s);
    if (live->frame_s > 0) live->frame_ms = live->frame_ms > 0 ? 0.9 * live->frame_ms + 0.1 * ms : ms;
    live->frame_s = now_s;
}

static bool write_files(FitLive *live) {
    const FitJob *job = live->job;
    char *state =
        mem_format("{\n  \"step\": %d,\n  \"iterations\": %d,\n  \"gaussians\": %d,\n  \"loss\": %.9g,\n"
                   "  \"psnr\": %.9g,\n  \"paused\": %s,\n  \"saved\": %s\n}\n",
                   fit2d_steps_done(job->fit), job->options.iterations, fit2d_count(job->fit), job->loss.total,
                   live->psnr, live->is_paused ? "true" : "false", live->is_saved ? "true" : "false");
    bool good = places_write_text(live->options->state_file, &live->state, state) &&
                places_write(live->options->places_file, &live->places, live->screen, NULL, 0);
    mem_free(state);
    return good;
}

static bool show_frame(FitLive *live) {
    static const HelpLine help[] = {{"Space", "pause, and go on"},
                                    {"S", "one step"},
                                    {"R", "the same fit from its first step"},
                                    {"1  2  3", "slow, a step a frame, fast"},
                                    WINDOW_KEYS_HELP};
    GuiRect whole = gui_screen();
    double panel = fmin(PANEL_EMS * gui_em(), whole.width / 2);
    use_keys(live);
    go_on(live);
    bool good = live->is_saved || !fit_job_is_done(live->job) || save(live);
    refresh(live);
    show_stage(live, (GuiRect){0, 0, whole.width - panel, whole.height});
    show_panel(live, (GuiRect){whole.width - panel, 0, panel, whole.height});
    help_page(&live->shows_help, help, sizeof help / sizeof help[0]);
    return write_files(live) && good;
}

static bool run(FitLive *live) {
    bool good = true;
    show_image(VIEW_PHOTO, &live->job->photo);
    while (good && screen_begin(live->screen, !live->is_paused && !fit_job_is_done(live->job))) {
        count_frame(live);
        good = show_frame(live);
        good = screen_end(live->screen) && good;
        screen_show(live->screen);
    }
    return good && (live->is_saved || save(live));
}

bool fit_live(FitJob *job, const WindowOptions *options) {
    ScreenOptions screen_options = window_options_screen(options, "splatlab - fitting a picture");
    FitLive *live = mem_alloc(1, sizeof *live);
    *live = (FitLive){.job = job, .options = options, .pace = PACE_FAST, .is_stale = true};
    live->screen = screen_open(&screen_options);
    bool good = live->screen && run(live);
    screen_close(live->screen);
    mem_free(live->state);
    mem_free(live->places);
    mem_free(live);
    return good;
}
