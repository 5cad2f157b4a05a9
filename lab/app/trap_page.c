// trap_page.c - the three pictures, the sliders, and the buttons of the optimiser.
#include "lab/app/trap_page.h"

#include "lab/app/formula.h"
#include "lab/app/palette.h"
#include "lab/base/mem.h"

#include <GLFW/glfw3.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { PICTURE_SIDE = 220 };
static const double SLIDER_MAX = 3; // units^2
static const double RATE_MIN = 0.002, RATE_MAX = 0.2;
static const double RAW_STEP = 0.05, TURN_STEP_RAD = M_PI / 36, LOG_STEP = 0.05; // of a key

TrapPage *trap_page_create(void) {
    TrapPage *page = mem_alloc(1, sizeof *page);
    psd_trap_begin(&page->trap);
    page->turn_rad = -1.45; // the walk leaves through the side that is seen edge-on
    page->is_stale = true;
    for (int i = 0; i < TRAP_PICTURE_COUNT; i++) page->pictures[i] = image8_create(PICTURE_SIDE, PICTURE_SIDE, 3);
    return page;
}

void trap_page_destroy(TrapPage *page) {
    if (!page) return;
    for (int i = 0; i < TRAP_PICTURE_COUNT; i++) image8_destroy(&page->pictures[i]);
    mem_free(page);
}

void trap_page_advance(TrapPage *page, int steps) {
    for (int i = 0; i < steps; i++) psd_trap_step(&page->trap);
    page->is_stale = true;
}

void trap_page_restart(TrapPage *page) {
    psd_trap_restart(&page->trap);
    page->is_running = false;
    page->is_stale = true;
}

// ---- pictures ----

static void fill(Image8 *picture, double opacity, Sym2 covariance) {
    static const double blob[3] = {1.00, 0.76, 0.22}, behind[3] = {0.055, 0.065, 0.10};
    for (int y = 0; y < PICTURE_SIDE; y++)
        for (int x = 0; x < PICTURE_SIDE; x++) {
            double dx = PSD_HALF_SIDE * ((2 * x + 1.0) / PICTURE_SIDE - 1);
            double dy = PSD_HALF_SIDE * ((2 * y + 1.0) / PICTURE_SIDE - 1);
            double alpha = psd_trap_alpha(opacity, covariance, dx, dy);
            for (int c = 0; c < 3; c++)
                picture->bytes[3 * (y * PICTURE_SIDE + x) + c] =
                    (uint8_t)lround(255 * (alpha * blob[c] + (1 - alpha) * behind[c]));
        }
}

static void refresh(TrapPage *page, int first_picture) {
    if (!page->is_stale) return;
    const PsdTrap *trap = &page->trap;
    fill(&page->pictures[0], trap->opacity, trap->target);
    fill(&page->pictures[1], trap->opacity, psd_walk_covariance(&trap->walks[PSD_RAW]));
    fill(&page->pictures[2], trap->opacity, psd_walk_covariance(&trap->walks[PSD_FACTORED]));
    for (int i = 0; i < TRAP_PICTURE_COUNT; i++) gui_picture_fill(first_picture + i, &page->pictures[i], true);
    page->is_stale = false;
}

static bool is_valid(const PsdWalk *walk) { return sym2_eigen(psd_walk_covariance(walk)).minor > 0; }

static void one_picture(const TrapPage *page, int i, int picture, double x, double y, double side) {
    static const char *const titles[] = {"The photograph", "Raw entries xx, xy, yy", "θ, ln σx, ln σy"};
    double em = gui_em();
    const PsdWalk *walk = i > 0 ? &page->trap.walks[i - 1] : NULL;
    bool bad = walk && !is_valid(walk);
    gui_draw_text(GUI_BOLD, x, y, bad ? BAD : INK, "%s", titles[i]);
    GuiRect place = {x, y + 1.5 * em, side, side};
    gui_draw_picture(picture, place);
    gui_draw_frame(place, bad ? BAD : LINE, 0, bad ? 3 : 1);
    if (!walk) return;
    double loss = walk->loss[walk->step];
    gui_draw_text(GUI_SMALL, x, y + 1.8 * em + side, bad ? BAD : INK_QUIET, "step %d   loss %.5f%s", walk->step, loss,
                  bad ? "   no Gaussian any more" : "");
}

void trap_page_stage(TrapPage *page, GuiRect stage, int first_picture) {
    double em = gui_em(), gap = 1.4 * em, top = stage.y + 1.1 * em;
    double side = fmin((stage.width - 4 * gap) / 3, stage.height * 0.42);
    refresh(page, first_picture);
    gui_panel_begin("trap stage", stage, PANEL_DEEP, 0);
    double left = stage.x + (stage.width - 3 * side - 2 * gap) / 2;
    for (int i = 0; i < TRAP_PICTURE_COUNT; i++)
        one_picture(page, i, first_picture + i, left + i * (side + gap), top, side);
    double below = top + side + 4 * em;
    GuiRect cone = {stage.x + gap, below, stage.width * 0.5 - 1.5 * gap, stage.y + stage.height - below - em};
    GuiRect plot = cone;
    plot.x += cone.width + gap;
    trap_cone(page, cone);
    gui_draw_text(GUI_SMALL, cone.x, cone.y + cone.height - gui_em(), INK_FAINT, "drag to turn");
    trap_plot(page, plot);
    gui_panel_end();
}

// ---- keys and panel ----

static int steps_of(int key) { return gui_key(key, GUI_PLAIN) - gui_key(key, GUI_SHIFT); }

static void raw_keys(TrapPage *page) {
    static const int keys[3] = {GLFW_KEY_I, GLFW_KEY_J, GLFW_KEY_K};
    double moved[3];
    bool any = false;
    for (int i = 0; i < 3; i++) {
        int steps = steps_of(keys[i]);
        moved[i] = page->trap.walks[PSD_RAW].values[i] + RAW_STEP * steps;
        any = any || steps;
    }
    if (!any) return;
    psd_trap_set(&page->trap, PSD_RAW, moved);
    page->is_stale = true;
}

static void factored_keys(TrapPage *page) {
    const double *v = page->trap.walks[PSD_FACTORED].values;
    int turns = steps_of(GLFW_KEY_T), x = steps_of(GLFW_KEY_X), y = steps_of(GLFW_KEY_Y);
    if (!turns && !x && !y) return;
    psd_trap_set(&page->trap, PSD_FACTORED,
                 (double[3]){v[0] + TURN_STEP_RAD * turns, v[1] + LOG_STEP * x, v[2] + LOG_STEP * y});
    page->is_stale = true;
}

void trap_page_keys(TrapPage *page) {
    if (gui_key(GLFW_KEY_SPACE, GUI_PLAIN) % 2) page->is_running = !page->is_running;
    int steps = gui_key(GLFW_KEY_ENTER, GUI_PLAIN), rates = steps_of(GLFW_KEY_V);
    if (steps) trap_page_advance(page, steps);
    if (rates) page->trap.learning_rate = fmin(RATE_MAX, fmax(RATE_MIN, page->trap.learning_rate * pow(1.25, rates)));
    raw_keys(page);
    factored_keys(page);
}

static void raw_sliders(TrapPage *page) {
    static const char *const labels[3] = {"Σ xx", "Σ xy", "Σ yy"};
    static const char *const keys[3] = {"I, Shift I", "J, Shift J", "K, Shift K"};
    double moved[3];
    bool changed = false;
    memcpy(moved, page->trap.walks[PSD_RAW].values, sizeof moved);
    for (int i = 0; i < 3; i++) {
        changed |= gui_slider(labels[i], &moved[i], -SLIDER_MAX, SLIDER_MAX, "%.3f", false);
        gui_hint(keys[i]);
    }
    if (!changed) return;
    psd_trap_set(&page->trap, PSD_RAW, moved);
    page->is_stale = true;
}

static void factored_sliders(TrapPage *page) {
    const double *v = page->trap.walks[PSD_FACTORED].values;
    double theta = v[0] * 180 / M_PI, sigma_x = exp(v[1]), sigma_y = exp(v[2]);
    bool changed = gui_slider("θ", &theta, -180, 180, "%.1f°", false);
    changed |= gui_slider("σx", &sigma_x, 0.05, 3, "%.3f", true);
    changed |= gui_slider("σy", &sigma_y, 0.05, 3, "%.3f", true);
    if (!changed) return;
    sigma_x = fmax(1e-3, sigma_x), sigma_y = fmax(1e-3, sigma_y); // typed
    psd_trap_set(&page->trap, PSD_FACTORED, (double[3]){theta * M_PI / 180, log(sigma_x), log(sigma_y)});
    page->is_stale = true;
}

static void matrix_of(const PsdWalk *walk) {
    Sym2 covariance = psd_walk_covariance(walk);
    Eigen2 eigen = sym2_eigen(covariance);
    bool valid = eigen.minor > 0;
    char major[32], minor[32], determinant[32];
    formula_matrix("Σ", covariance, "", valid ? INK : BAD);
    gui_text(GUI_MONO_SMALL, eigen.major > 0 ? GOOD : BAD, "λ₁ %s", formula_number(eigen.major, major, sizeof major));
    gui_same_line(1);
    gui_text(GUI_MONO_SMALL, valid ? GOOD : BAD, "λ₂ %s", formula_number(eigen.minor, minor, sizeof minor));
    gui_same_line(1);
    gui_text(GUI_MONO_SMALL, INK_QUIET, "det %s",
             formula_number(sym2_determinant(covariance), determinant, sizeof determinant));
    gui_text(GUI_SMALL, valid ? GOOD : BAD,
             valid             ? "✓ inside the cone: positive definite"
             : eigen.major > 0 ? "✗ outside: grows without bound along one axis"
                               : "✗ outside: grows without bound everywhere");
}

static void optimiser(TrapPage *page) {
    double third = (gui_width_left() - 0.5 * gui_em()) / 3;
    if (gui_button(page->is_running ? "Pause" : "Run", third)) page->is_running = !page->is_running;
    gui_hint("Space");
    gui_same_line(0.25);
    if (gui_button("Step", third)) trap_page_advance(page, 1);
    gui_hint("Return");
    gui_same_line(0.25);
    if (gui_button("Restart", third)) trap_page_restart(page);
    gui_slider("rate", &page->trap.learning_rate, RATE_MIN, RATE_MAX, "%.3f", true);
    page->trap.learning_rate = fmin(1, fmax(1e-6, page->trap.learning_rate));
    gui_hint("Adam's learning rate, the same for both walks");
}

void trap_page_panel(TrapPage *page) {
    gui_text(GUI_TITLE, INK, "The PSD trap");
    gui_paragraph(
        GUI_SMALL, INK_QUIET,
        "Two blobs descend towards the photograph, by the same optimiser at the same rate. One moves the entries "
        "of Σ, the other θ and the logarithms of the scales.");
    optimiser(page);
    gui_rule();
    gui_text(GUI_BOLD, INK, "Raw entries");
    raw_sliders(page);
    matrix_of(&page->trap.walks[PSD_RAW]);
    gui_rule();
    gui_text(GUI_BOLD, INK, "Factored: Σ = R S Sᵀ Rᵀ");
    factored_sliders(page);
    matrix_of(&page->trap.walks[PSD_FACTORED]);
    gui_rule();
    gui_paragraph(
        GUI_SMALL, INK_QUIET,
        "vᵀ Σ v = |Sᵀ Rᵀ v|² ≥ 0: whatever the numbers are, the factored Σ is valid. The raw one is valid only while "
        "xx yy > xy²; nothing in the loss knows of that wall. At some rates it gets through by luck: try 0.08.");
}
