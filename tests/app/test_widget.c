#include "lab/base/rng.h"
#include "lab/io/file.h"
#include "lab/io/image_io.h"
#include "splat2d/pixel_walk.h"
#include "splat2d/scene2d_json.h"
#include "tests/support/command.h"
#include "tests/support/golden.h"
#include "tests/support/session.h"
#include "tests/support/support.h"

#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { EVENTS = 1000 };

// The lesson's scene in a window, its first blob chosen; skips the test where there is no screen to be had. All tests share
// one window: it is slow to open.
static void start_widget(void) {
    session_need_screen();
    if (session_is_alive())
        session_do("key Escape key ctrl+r key 1");
    else
        session_start("widget", NULL);
}

static int end_widget(void **state) {
    (void)state;
    session_end();
    return 0;
}

static void a_drag_moves_the_mean_by_what_the_mouse_moved(void **state) {
    (void)state;
    start_widget();
    double zoom = session_number("zoom"), at[2];
    Blob before = session_scene()->blobs[0];
    session_point(before.mean, at);
    session_drag(round(at[0]), round(at[1]), round(at[0]) + 64, round(at[1]) - 40);
    Blob after = session_scene()->blobs[0];
    support_near((after.mean[0] - before.mean[0]) * zoom, 64, 1e-9, "x moved, window px");
    support_near((after.mean[1] - before.mean[1]) * zoom, -40, 1e-9, "y moved, window px");
    after.mean[0] = before.mean[0], after.mean[1] = before.mean[1];
    assert_memory_equal(&after, &before, sizeof after); // and nothing else
}

static void a_handle_stretches_its_axis(void **state) {
    (void)state;
    start_widget();
    double zoom = session_number("zoom"), at[2];
    Blob before = session_scene()->blobs[0];
    session_point((double[2]){before.mean[0] + before.sigma_x, before.mean[1]}, at);
    session_drag(round(at[0]), round(at[1]), round(at[0]) + 50, round(at[1]) + 7);
    Blob after = session_scene()->blobs[0];
    support_near((after.sigma_x - before.sigma_x) * zoom, 50, 1e-9, "sigma_x, window px");
    after.sigma_x = before.sigma_x;
    assert_memory_equal(&after, &before, sizeof after);
}

static void the_round_handle_turns_the_blob_about_its_mean(void **state) {
    (void)state;
    start_widget();
    double mean[2], slider[2], size[2];
    Blob before = session_scene()->blobs[0];
    session_point(before.mean, mean);
    session_place("θ", slider, size);
    double reach = before.sigma_x * session_number("zoom") + 1.7 * 14; // the arm is 1.7 ems of 14 px in this window
    session_drag(round(mean[0] + reach), round(mean[1]), round(mean[0]), round(mean[1] + reach));
    Blob after = session_scene()->blobs[0];
    support_near(after.theta_rad, M_PI / 2, 0.03, "theta");
    assert_true(after.mean[0] == before.mean[0] && after.sigma_x == before.sigma_x);
}

static void the_theta_slider_turns_sigma(void **state) {
    (void)state;
    start_widget();
    double middle[2], size[2];
    session_do("key 4"); // the teal one, which is not round
    Blob before = session_scene()->blobs[3];
    session_place("θ", middle, size);
    session_drag(middle[0], middle[1], middle[0] + size[0] / 4, middle[1]);
    Blob after = session_scene()->blobs[3];
    support_near(after.theta_rad, M_PI / 2, 0.1, "theta, three quarters along a slider from -pi to pi");
    Eigen2 old_axes = sym2_eigen(blob_covariance(&before)), new_axes = sym2_eigen(blob_covariance(&after));
    support_near(new_axes.major, old_axes.major, 1e-6, "major eigenvalue");
    support_near(new_axes.minor, old_axes.minor, 1e-6, "minor eigenvalue");
    support_near(new_axes.angle_rad, after.theta_rad, 1e-9, "angle of the major axis");
}

// Where teal (3) and orange (4) overlap: the first is in front until it is moved one place back.
static void another_depth_order_changes_the_pixel(void **state) {
    (void)state;
    start_widget();
    WalkStep steps[16];
    Raster2d raster = {0};
    RasterSettings settings = raster_settings_default();
    raster2d_load(&raster, session_scene(), view2d_whole());
    WalkResult before = pixel_walk(&raster, &settings, 660.5, 330.5, steps);
    session_do("key 4; key bracketright");
    const Scene2d *scene = session_scene();
    assert_int_equal(scene2d_rank(scene, 3), 2);
    assert_int_equal(scene2d_rank(scene, 4), 1);
    raster2d_load(&raster, scene, view2d_whole());
    WalkResult after = pixel_walk(&raster, &settings, 660.5, 330.5, steps);
    assert_true(after.rgb[0] > before.rgb[0] + 0.1); // more orange
    support_near(after.transmittance, before.transmittance, 1e-12, "T does not depend on the order");
    raster2d_destroy(&raster);
}

static void the_wheel_changes_the_depth_rank(void **state) {
    (void)state;
    start_widget();
    double at[2];
    session_point((double[2]){480, 100}, at);
    int before = scene2d_rank(session_scene(), 0);
    session_do("mousemove %.0f %.0f; click 4", at[0], at[1]);
    assert_int_equal(scene2d_rank(session_scene(), 0), before - 1);
    session_do("click 5; click 5");
    assert_int_equal(scene2d_rank(session_scene(), 0), before + 1);
}

static void a_whole_drag_is_one_step(void **state) {
    (void)state;
    start_widget();
    double at[2], middle[2], size[2];
    char *first = strdup(session_bytes());
    session_point(session_scene()->blobs[0].mean, at);
    session_drag(round(at[0]), round(at[1]), round(at[0]) + 31, round(at[1]) + 17);
    char *dragged = strdup(session_bytes());
    session_place("opacity", middle, size);
    session_drag(middle[0] + size[0] * 0.4, middle[1], middle[0], middle[1]);
    char *faint = strdup(session_bytes());
    assert_string_not_equal(first, dragged);
    assert_string_not_equal(dragged, faint);
    session_do("key ctrl+z");
    assert_string_equal(session_bytes(), dragged);
    session_do("key ctrl+z");
    assert_string_equal(session_bytes(), first);
    session_do("key ctrl+y; key ctrl+shift+z");
    assert_string_equal(session_bytes(), faint);
    free(first);
    free(dragged);
    free(faint);
}

// Each key is a step.
static void undo_restores_the_bytes(void **state) {
    (void)state;
    start_widget();
    char *first = strdup(session_bytes());
    session_do("key x; key d; key Delete; key Delete");
    assert_int_equal(session_scene()->count, 5);
    char *last = strdup(session_bytes());
    session_do("key ctrl+z; key ctrl+z; key ctrl+z");
    assert_string_not_equal(session_bytes(), first);
    session_do("key ctrl+z");
    assert_string_equal(session_bytes(), first);
    session_do("key ctrl+y; key ctrl+y; key ctrl+y; key ctrl+y");
    assert_string_equal(session_bytes(), last);
    free(first);
    free(last);
}

static void a_saved_scene_is_loaded_again(void **state) {
    (void)state;
    start_widget();
    double middle[2], size[2];
    session_do("key n; key ctrl+s");
    char *saved = strdup(session_bytes());
    assert_true(file_exists(support_path(support_scratch(), "scene.json")));
    session_place("Delete", middle, size);
    session_do("mousemove %.0f %.0f; mousedown 1; mouseup 1", middle[0], middle[1]);
    assert_int_equal(session_scene()->count, 6);
    session_do("key ctrl+o; key ctrl+e");
    assert_string_equal(session_bytes(), saved);
    Image8 picture = {0};
    assert_true(image_load8(support_path(support_scratch(), "scene.png"), &picture));
    assert_int_equal(picture.width, 960);
    image8_destroy(&picture);
    free(saved);
}

static void zoom_and_pan_move_the_view_and_nothing_else(void **state) {
    (void)state;
    start_widget();
    double middle[2], size[2], fitted = session_number("zoom");
    char *first = strdup(session_bytes());
    session_place("canvas", middle, size);
    session_do("mousemove %.0f %.0f; keydown ctrl click 4; keyup ctrl", middle[0], middle[1]);
    support_near(session_number("zoom"), 1.15 * fitted, 1e-9, "a notch of the wheel");
    session_do("key ctrl+plus");
    support_near(session_number("zoom"), 1.15 * 1.25 * fitted, 1e-9, "a press of the key");
    // What is dragged 70 px to the right is found there.
    double before = session_number("probe x"), zoom = session_number("zoom");
    session_do("mousedown 3; mousemove %.0f %.0f; mouseup 3; mousemove %.0f %.0f", middle[0] + 70, middle[1],
               middle[0] + 1, middle[1]);
    support_near(session_number("probe x"), before + (1 - 70) / zoom, 1.01, "the pixel under the mouse");
    session_do("key 0; mousemove 2 2");
    support_near(session_number("zoom"), fitted, 1e-9, "all of the canvas");
    assert_string_equal(session_bytes(), first);
    free(first);
}

static void hiding_the_panel_and_full_screen_come_back(void **state) {
    (void)state;
    start_widget();
    double middle[2], size[2], fitted = session_number("zoom");
    session_do("key b");
    session_place("canvas", middle, size);
    support_near(size[0], SESSION_WIDTH, 1e-9, "as wide as the window");
    session_do("key b");
    support_near(session_number("zoom"), fitted, 1e-9, "as it was");
    session_do("key F11; mousemove 2 2; key F11; mousemove 3 3");
    support_near(session_number("zoom"), fitted, 1e-9, "as it was");
}

static void a_colour_is_dragged_and_undone(void **state) {
    (void)state;
    start_widget();
    double middle[2], size[2];
    double before = session_scene()->blobs[0].rgb[0];
    session_place("colour", middle, size);
    session_drag(middle[0] - size[0] / 2 + 40, middle[1], middle[0] - size[0] / 2 - 60, middle[1]); // red's field
    double after = session_scene()->blobs[0].rgb[0];
    assert_true(after < before);
    session_do("key ctrl+z");
    assert_true(session_scene()->blobs[0].rgb[0] == before);
}

// X Y T O and the brackets: every slider has its key.
static void every_slider_has_a_key(void **state) {
    (void)state;
    start_widget();
    Blob before = session_scene()->blobs[0];
    int rank = scene2d_rank(session_scene(), 0);
    session_do("key x; key y; key t; key shift+o; key bracketleft");
    Blob after = session_scene()->blobs[0];
    support_near(after.sigma_x, 1.05 * before.sigma_x, 1e-9, "X");
    support_near(after.sigma_y, 1.05 * before.sigma_y, 1e-9, "Y");
    support_near(after.theta_rad, before.theta_rad + M_PI / 36, 1e-9, "T");
    support_near(after.opacity, before.opacity - 0.05, 1e-9, "Shift O");
    assert_int_equal(scene2d_rank(session_scene(), 0), rank - 1);
    session_do("key shift+x; key shift+y; key shift+t; key o; key bracketright");
    after = session_scene()->blobs[0];
    support_near(after.sigma_x, before.sigma_x, 1e-9, "Shift X");
    support_near(after.theta_rad, before.theta_rad, 1e-9, "Shift T");
    assert_int_equal(scene2d_rank(session_scene(), 0), rank);
}

static void a_click_chooses_the_blob_in_front(void **state) {
    (void)state;
    start_widget();
    double at[2];
    session_point(session_scene()->blobs[3].mean, at); // teal, in front of orange
    session_do("mousemove %.0f %.0f; mousedown 1; mouseup 1", at[0], at[1]);
    assert_true(session_number("active") == 3);
    session_do("key Tab");
    assert_true(session_number("active") == 4);
}

static void the_trap_page_walks_and_is_moved_by_keys(void **state) {
    (void)state;
    start_widget();
    session_do("key m; mousemove 3 3");
    double start = session_number("raw minor");
    assert_true(start > 0 && session_number("factored minor") == start);
    for (int i = 0; i < 25; i++) session_do("key Return");
    assert_true(session_number("raw minor") < 0); // through the wall
    assert_true(session_number("factored minor") > 0);
    session_do("key shift+x; key shift+x");
    assert_true(session_number("factored minor") > 0);
    double before = session_number("raw minor");
    session_do("key i; key k");
    support_near(session_number("raw minor"), before + 0.05, 1e-9, "both diagonal entries raised");
    session_do("key m");
}

// All that was done, in the file, to the byte: tests/golden/widget_session.json.
static void a_scripted_session_leaves_the_expected_scene(void **state) {
    (void)state;
    start_widget();
    session_do("key 4; key x; key x; key shift+y; key t; key t; key shift+o; key bracketright");
    session_do("key d; key Right; key shift+Down; key bracketleft; key bracketleft");
    session_do("key 2; key Delete; key 1; key o; key Left; key shift+Up; key shift+x");
    session_do("key d; key t; key ctrl+z; key ctrl+z; key ctrl+y; key Next; key Prior; key Prior");
    assert_true(golden_text_matches(session_bytes(), "widget_session.json"));
}

// ---- anything goes ----

static const char *const KEYS[] = {"x",       "shift+x",   "y",          "shift+y", "t",      "shift+t", "o",
                                   "shift+o", "n",         "d",          "Delete",  "Tab",    "1",       "7",
                                   "b",       "e",         "u",          "g",       "h",      "l",       "p",
                                   "m",       "F1",        "Escape",     "0",       "plus",   "minus",   "bracketleft",
                                   "F11",     "Up",        "Left",       "Next",    "ctrl+z", "ctrl+y",  "ctrl+r",
                                   "ctrl+s",  "ctrl+plus", "ctrl+minus", "ctrl+o",  "space",  "Return",  "ctrl+e"};
enum { KEY_COUNT = sizeof KEYS / sizeof KEYS[0] };

static void write_event(FILE *script, Rng *rng) {
    uint32_t kind = rng_below(rng, 10);
    if (kind < 4)
        fprintf(script, "mousemove %u %u\n", rng_below(rng, SESSION_WIDTH), rng_below(rng, SESSION_HEIGHT));
    else if (kind < 6)
        fprintf(script, "%s 1\n", rng_below(rng, 2) ? "mousedown" : "mouseup");
    else if (kind < 7)
        fprintf(script, "click --delay 5 %u\n", 1 + rng_below(rng, 5)); // without it, each takes 100 ms
    else
        fprintf(script, "key --delay 5 %s\n", KEYS[rng_below(rng, KEY_COUNT)]);
    if (rng_below(rng, 4) == 0) fprintf(script, "sleep 0.02\n");
}

static void a_thousand_random_events_do_not_end_it(void **state) {
    (void)state;
    start_widget();
    const char *text = getenv("SPLATLAB_TEST_SEED");
    uint64_t seed = text ? strtoull(text, NULL, 10) : 20;
    Rng rng = rng_at(seed, RNG_TEST, 0, 0);
    char *events = NULL;
    size_t size;
    FILE *script = open_memstream(&events, &size);
    for (int i = 0; i < EVENTS; i++) write_event(script, &rng);
    fprintf(script, "mouseup 1\n");
    fclose(script);
    print_message("random events of seed %llu (set SPLATLAB_TEST_SEED for others)\n", (unsigned long long)seed);
    session_do("%s", events);
    free(events);
    assert_true(session_is_alive());
    assert_true(scene2d_check(session_scene(), "state")); // what it wrote can be read
    assert_int_equal(session_end(), 0);
}

// ---- a screen of high resolution ----

static void with_two_px_a_point_the_mouse_is_where_it_points(void **state) {
    (void)state;
    session_need_screen();
    session_end();
    session_start("widget", "--ui-scale", "2", NULL);
    double zoom = session_number("zoom"), at[2], middle[2], size[2];
    Blob before = session_scene()->blobs[0];
    session_point(before.mean, at);
    session_drag(round(at[0]), round(at[1]), round(at[0]) + 64, round(at[1]) - 40);
    Blob after = session_scene()->blobs[0];
    support_near((after.mean[0] - before.mean[0]) * zoom, 64, 1e-9, "x moved, px");
    support_near((after.mean[1] - before.mean[1]) * zoom, -40, 1e-9, "y moved, px");
    session_place("σx", middle, size);
    session_drag(middle[0], middle[1], middle[0] + size[0] / 4, middle[1]);
    assert_true(session_scene()->blobs[0].sigma_x > before.sigma_x);
    assert_int_equal(session_end(), 0);
}

// The same picture with four times as many px: shrunk, it is nearly the one of a plain screen.
static void two_px_a_point_are_the_same_picture_sharper(void **state) {
    (void)state;
    double sum = 0;
    Image8 pictures[2];
    for (int k = 0; k < 2; k++) {
        char folder[4096];
        snprintf(folder, sizeof folder, "%s/density_%d", support_scratch(), k);
        CommandResult r = command_run("demo", "popping", "--headless", "-o", folder, "--size", "1600x1000",
                                      "--ui-scale", k ? "2" : "1", NULL);
        command_expect(&r, 0);
        assert_true(image_load8(support_path(folder, "step_01.png"), &pictures[k]));
        assert_int_equal(pictures[k].width, k ? 3200 : 1600);
    }
    Image8 small = image8_downscale(&pictures[1], 8), plain = image8_downscale(&pictures[0], 4);
    for (int i = 0; i < plain.width * plain.height * 3; i++) sum += abs(small.bytes[i] - plain.bytes[i]);
    support_near(sum / (plain.width * plain.height * 3), 0, 1, "mean difference, of 255");
    image8_destroy(&small);
    image8_destroy(&plain);
    for (int k = 0; k < 2; k++) image8_destroy(&pictures[k]);
}

// ---- the command ----

static void a_screenshot_shows_the_picture(void **state) {
    (void)state;
    session_need_screen();
    const char *path = support_path(support_scratch(), "shot.png");
    CommandResult r = command_run("widget", "--frames", "5", "--size", "1200x800", "--screenshot", path, NULL);
    command_expect(&r, 0);
    Image8 shot = {0};
    assert_true(image_load8(path, &shot));
    assert_int_equal(shot.width, 1200);
    assert_int_equal(shot.height, 800);
    double sum = 0, squares = 0, count = 1200 * 800 * 3;
    for (int i = 0; i < 1200 * 800 * 3; i++) sum += shot.bytes[i], squares += shot.bytes[i] * shot.bytes[i];
    assert_true(sqrt(squares / count - sum / count * sum / count) > 10);
    image8_destroy(&shot);
}

static void without_a_display_it_says_what_to_do(void **state) {
    (void)state;
    char *display = getenv("DISPLAY"), *kept = display ? strdup(display) : NULL;
    unsetenv("DISPLAY");
    unsetenv("WAYLAND_DISPLAY");
    CommandResult r = command_run("widget", "--frames", "1", NULL);
    if (kept) setenv("DISPLAY", kept, 1);
    free(kept);
    command_expect_error(&r, 1, "no display", "xvfb-run", NULL);
}

static void the_speed_is_told(void **state) {
    (void)state;
    char *display = getenv("DISPLAY"), *kept = display ? strdup(display) : NULL;
    unsetenv("DISPLAY");
    CommandResult r = command_run("widget", "--speed", "--json", "--size", "800x500", NULL);
    if (kept) setenv("DISPLAY", kept, 1);
    free(kept);
    command_expect(&r, 0);
    json_t *root = json_loads(r.out, 0, NULL), *speeds = json_object_get(root, "speeds");
    assert_int_equal(json_array_size(speeds), 2);
    for (size_t i = 0; i < 2; i++) {
        json_t *speed = json_array_get(speeds, i);
        double raster_ms = json_number_value(json_object_get(speed, "raster_ms"));
        assert_int_equal(json_integer_value(json_object_get(speed, "gaussians")), i ? 200 : 6);
        assert_true(raster_ms > 0 && raster_ms <= json_number_value(json_object_get(speed, "frame_ms")));
    }
    json_decref(root);
    r = command_run("widget", "--json", NULL);
    command_expect_error(&r, 2, "--speed", NULL);
    r = command_run("widget", "--speed", "--frames", "3", NULL);
    command_expect_error(&r, 2, "--speed", NULL);
    r = command_run("widget", "--ui-scale", "0.1", "--frames", "1", NULL);
    command_expect_error(&r, 2, "--ui-scale", NULL);
}

static void a_scene_that_is_wrong_is_named(void **state) {
    (void)state;
    CommandResult r = command_run("widget", "none.json", NULL);
    command_expect_error(&r, 1, "none.json", NULL);
    r = command_run("widget", "--screenshot", "a.png", NULL);
    command_expect_error(&r, 2, "--frames", NULL);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_drag_moves_the_mean_by_what_the_mouse_moved),
        cmocka_unit_test(a_handle_stretches_its_axis),
        cmocka_unit_test(the_round_handle_turns_the_blob_about_its_mean),
        cmocka_unit_test(the_theta_slider_turns_sigma),
        cmocka_unit_test(another_depth_order_changes_the_pixel),
        cmocka_unit_test(the_wheel_changes_the_depth_rank),
        cmocka_unit_test(a_whole_drag_is_one_step),
        cmocka_unit_test(undo_restores_the_bytes),
        cmocka_unit_test(a_saved_scene_is_loaded_again),
        cmocka_unit_test(zoom_and_pan_move_the_view_and_nothing_else),
        cmocka_unit_test(hiding_the_panel_and_full_screen_come_back),
        cmocka_unit_test(a_colour_is_dragged_and_undone),
        cmocka_unit_test(every_slider_has_a_key),
        cmocka_unit_test(a_click_chooses_the_blob_in_front),
        cmocka_unit_test(the_trap_page_walks_and_is_moved_by_keys),
        cmocka_unit_test(a_scripted_session_leaves_the_expected_scene),
        cmocka_unit_test(a_thousand_random_events_do_not_end_it),
        cmocka_unit_test(with_two_px_a_point_the_mouse_is_where_it_points),
        cmocka_unit_test(two_px_a_point_are_the_same_picture_sharper),
        cmocka_unit_test(a_screenshot_shows_the_picture),
        cmocka_unit_test(without_a_display_it_says_what_to_do),
        cmocka_unit_test(the_speed_is_told),
        cmocka_unit_test(a_scene_that_is_wrong_is_named),
    };
    return cmocka_run_group_tests(tests, NULL, end_widget);
}
