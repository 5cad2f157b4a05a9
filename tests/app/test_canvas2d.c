#include "lab/app/canvas2d.h"
#include "lab/base/rng.h"
#include "tests/support/support.h"

#include <math.h>

enum { ROUNDS = 200 };

static Canvas2d some_canvas(Rng *rng) {
    Canvas2d canvas = {.x = rng_range(rng, 0, 300),
                       .y = rng_range(rng, 0, 300),
                       .width = rng_range(rng, 200, 2000),
                       .height = rng_range(rng, 200, 2000)};
    canvas.view = (View2d){rng_range(rng, -500, 500), rng_range(rng, -500, 500), exp(rng_range(rng, -2, 2))};
    return canvas;
}

static Blob some_blob(Rng *rng) {
    return (Blob){.mean = {rng_range(rng, 0, 900), rng_range(rng, 0, 700)},
                  .sigma_x = rng_range(rng, 20, 100),
                  .sigma_y = rng_range(rng, 20, 100),
                  .theta_rad = rng_range(rng, -3, 3),
                  .opacity = 0.5};
}

static void a_point_goes_to_the_window_and_back(void **state) {
    (void)state;
    Rng rng = rng_at(1, RNG_TEST, 0, 0);
    for (int i = 0; i < ROUNDS; i++) {
        Canvas2d canvas = some_canvas(&rng);
        double point[2] = {rng_range(&rng, -100, 900), rng_range(&rng, -100, 900)}, window[2], back[2];
        canvas2d_to_window(&canvas, point, window);
        canvas2d_from_window(&canvas, window[0], window[1], back);
        for (int c = 0; c < 2; c++) support_near(back[c], point[c], 1e-9, "coordinate");
    }
}

static void zooming_keeps_the_point_under_the_mouse(void **state) {
    (void)state;
    Rng rng = rng_at(2, RNG_TEST, 0, 0);
    for (int i = 0; i < ROUNDS; i++) {
        Canvas2d canvas = some_canvas(&rng);
        double x = rng_range(&rng, 0, 1000), y = rng_range(&rng, 0, 1000), before[2], after[2];
        canvas2d_from_window(&canvas, x, y, before);
        canvas2d_zoom(&canvas, x, y, exp(rng_range(&rng, -8, 8))); // often beyond the limits
        canvas2d_from_window(&canvas, x, y, after);
        for (int c = 0; c < 2; c++) support_near(after[c], before[c], 1e-6, "point under the mouse");
        assert_true(canvas.view.zoom >= CANVAS_ZOOM_MIN && canvas.view.zoom <= CANVAS_ZOOM_MAX);
    }
}

static void fitting_shows_the_whole_canvas_in_the_middle(void **state) {
    (void)state;
    Scene2d scene = scene2d_create(960, 720);
    Canvas2d canvas = {.x = 10, .y = 20, .width = 1000, .height = 500};
    double low[2], high[2];
    canvas2d_fit(&canvas, &scene);
    canvas2d_to_window(&canvas, (double[2]){0, 0}, low);
    canvas2d_to_window(&canvas, (double[2]){960, 720}, high);
    support_near(low[1], 20, 1e-9, "top");
    support_near(high[1], 520, 1e-9, "bottom");
    support_near(low[0] - 10, 1010 - high[0], 1e-9, "margins");
}

static void a_new_place_keeps_what_is_in_the_middle(void **state) {
    (void)state;
    Canvas2d canvas = {.width = 400, .height = 300, .view = {.left = 5, .top = 6, .zoom = 2}};
    double before[2], after[2];
    canvas2d_from_window(&canvas, 200, 150, before);
    canvas2d_place(&canvas, 50, 60, 800, 500);
    canvas2d_from_window(&canvas, 50 + 400, 60 + 250, after);
    for (int c = 0; c < 2; c++) support_near(after[c], before[c], 1e-12, "middle");
}

static void each_handle_is_found_where_it_is_drawn(void **state) {
    (void)state;
    Rng rng = rng_at(3, RNG_TEST, 0, 0);
    for (int i = 0; i < ROUNDS; i++) {
        Canvas2d canvas = some_canvas(&rng);
        Blob blob = some_blob(&rng);
        canvas.view.zoom = 2; // handles stand further apart than the reach
        for (Grip grip = GRIP_X; grip <= GRIP_TURN; grip++) {
            double at[2];
            canvas2d_grip(&canvas, &blob, grip, 30, at);
            assert_int_equal(canvas2d_grip_at(&canvas, &blob, at[0] + 2, at[1] - 2, 30, 8), grip);
        }
    }
}

static void the_inside_is_the_body_and_the_outside_is_nothing(void **state) {
    (void)state;
    Canvas2d canvas = {.width = 900, .height = 900, .view = {0, 0, 1}};
    Blob blob = {.mean = {400, 400}, .sigma_x = 100, .sigma_y = 20, .theta_rad = 0};
    assert_int_equal(canvas2d_grip_at(&canvas, &blob, 450, 405, 30, 8), GRIP_BODY);
    assert_int_equal(canvas2d_grip_at(&canvas, &blob, 400, 445, 30, 8), GRIP_NONE); // 2.25 sigma
    blob.sigma_y = 0;
    assert_int_equal(canvas2d_grip_at(&canvas, &blob, 450, 405, 30, 8), GRIP_NONE); // has no area
}

static void a_drag_of_the_body_moves_it_by_the_mouse(void **state) {
    (void)state;
    Canvas2d canvas = {.width = 900, .height = 900, .view = {0, 0, 2}};
    Drag2d drag = {GRIP_BODY, 100, 100, {.mean = {50, 50}, .sigma_x = 9, .sigma_y = 9}};
    Blob blob = drag2d_blob(&drag, &canvas, 130, 90, false);
    support_near(blob.mean[0], 65, 1e-12, "x");
    support_near(blob.mean[1], 45, 1e-12, "y");
}

// A handle that is dragged to a point of its axis is drawn there afterwards.
static void a_handle_follows_the_mouse_along_its_axis(void **state) {
    (void)state;
    Rng rng = rng_at(4, RNG_TEST, 0, 0);
    for (int i = 0; i < ROUNDS; i++) {
        Canvas2d canvas = some_canvas(&rng);
        Blob blob = some_blob(&rng);
        Grip grip = GRIP_X + (Grip)rng_below(&rng, 4);
        double mean[2], at[2], there[2];
        canvas2d_to_window(&canvas, blob.mean, mean);
        canvas2d_grip(&canvas, &blob, grip, 30, at);
        double k = rng_range(&rng, 1, 3);
        Drag2d drag = {grip, at[0], at[1], blob};
        double x = mean[0] + k * (at[0] - mean[0]), y = mean[1] + k * (at[1] - mean[1]);
        Blob stretched = drag2d_blob(&drag, &canvas, x, y, false);
        canvas2d_grip(&canvas, &stretched, grip, 30, there);
        support_near(there[0], x, 1e-6, "x of the handle");
        support_near(there[1], y, 1e-6, "y of the handle");
    }
}

static void a_scale_never_becomes_negative(void **state) {
    (void)state;
    Canvas2d canvas = {.width = 900, .height = 900, .view = {0, 0, 1}};
    Drag2d drag = {GRIP_Y, 0, 0, {.sigma_x = 9, .sigma_y = 9}};
    assert_true(drag2d_blob(&drag, &canvas, 0, -500, false).sigma_y == CANVAS_SIGMA_MIN);
    assert_true(drag2d_blob(&drag, &canvas, 0, 1e9, false).sigma_y == CANVAS_SIGMA_MAX);
}

static void turning_follows_the_mouse_round_the_mean(void **state) {
    (void)state;
    Canvas2d canvas = {.width = 900, .height = 900, .view = {0, 0, 1}};
    Drag2d drag = {GRIP_TURN, 200, 100, {.mean = {100, 100}, .sigma_x = 50, .sigma_y = 20, .theta_rad = 0}};
    support_near(drag2d_blob(&drag, &canvas, 100, 170, false).theta_rad, M_PI / 2, 1e-12, "a quarter");
    support_near(drag2d_blob(&drag, &canvas, 100 + 200, 100 + 60, true).theta_rad, M_PI / 12, 1e-12, "snapped");
    drag.blob.theta_rad = 3;
    support_near(drag2d_blob(&drag, &canvas, 100, 170, false).theta_rad, 3 + M_PI / 2 - 2 * M_PI, 1e-12, "wrapped");
}

static void an_angle_is_wrapped_into_one_turn(void **state) {
    (void)state;
    support_near(angle_wrap(7), 7 - 2 * M_PI, 1e-12, "7");
    support_near(angle_wrap(-M_PI), M_PI, 0, "-pi");
    support_near(angle_wrap(M_PI), M_PI, 0, "pi");
    support_near(angle_wrap(0.25), 0.25, 0, "0.25");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_point_goes_to_the_window_and_back),
        cmocka_unit_test(zooming_keeps_the_point_under_the_mouse),
        cmocka_unit_test(fitting_shows_the_whole_canvas_in_the_middle),
        cmocka_unit_test(a_new_place_keeps_what_is_in_the_middle),
        cmocka_unit_test(each_handle_is_found_where_it_is_drawn),
        cmocka_unit_test(the_inside_is_the_body_and_the_outside_is_nothing),
        cmocka_unit_test(a_drag_of_the_body_moves_it_by_the_mouse),
        cmocka_unit_test(a_handle_follows_the_mouse_along_its_axis),
        cmocka_unit_test(a_scale_never_becomes_negative),
        cmocka_unit_test(turning_follows_the_mouse_round_the_mean),
        cmocka_unit_test(an_angle_is_wrapped_into_one_turn),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
