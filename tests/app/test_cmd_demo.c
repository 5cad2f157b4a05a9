#include "lab/app/demo.h"
#include "lab/base/fail.h"
#include "lab/io/file.h"
#include "lab/io/image_io.h"
#include "lab/io/json_io.h"
#include "tests/support/command.h"
#include "tests/support/golden.h"
#include "tests/support/session.h"
#include "tests/support/support.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

static const char *const NAMES[] = {"popping", "anisotropy", "psd", "opacity", "transmittance", "early-stop"};
enum { NAME_COUNT = sizeof NAMES / sizeof NAMES[0] };

// Runs the demo once for all tests; its steps.json, and its folder.
static json_t *steps_of(const char *name, const char **folder) {
    static json_t *roots[NAME_COUNT];
    static char folders[NAME_COUNT][4096];
    int i = 0;
    while (strcmp(NAMES[i], name) != 0) i++;
    if (!roots[i]) {
        snprintf(folders[i], sizeof folders[i], "%s/%s", support_scratch(), name);
        CommandResult r = command_run("demo", name, "--headless", "-o", folders[i], "--size", "960x600", NULL);
        command_expect(&r, 0);
        char path[4200];
        snprintf(path, sizeof path, "%s/steps.json", folders[i]);
        if (!json_read(path, &roots[i])) fail_msg("%s", fail_text());
    }
    if (folder) *folder = folders[i];
    return json_object_get(roots[i], "steps");
}

static double number(json_t *steps, int step, const char *key) {
    return json_number_value(json_object_get(json_array_get(steps, (size_t)step), key));
}

static double item(json_t *steps, int step, const char *key, int i) {
    return json_number_value(json_array_get(json_object_get(json_array_get(steps, (size_t)step), key), (size_t)i));
}

static double walk_number(json_t *steps, int step, const char *walk, const char *key) {
    return json_number_value(json_object_get(json_object_get(json_array_get(steps, (size_t)step), walk), key));
}

static void every_step_of_every_demo_looks_as_it_did(void **state) {
    (void)state;
    int others = 0;
    for (int i = 0; i < NAME_COUNT; i++) {
        Demo demo;
        const char *folder;
        assert_true(demo_load(NAMES[i], &demo));
        json_t *steps = steps_of(NAMES[i], &folder);
        assert_int_equal(json_array_size(steps), demo.count);
        for (int step = 0; step < demo.count; step++) {
            char path[4300], name[64];
            snprintf(path, sizeof path, "%s/step_%02d.png", folder, step + 1);
            snprintf(name, sizeof name, "demo_%s_%d", NAMES[i], step + 1);
            others += !golden_matches(path, name);
        }
        demo_free(&demo);
    }
    if (others) fail_msg("%d pictures differ; if they are better than before: make golden", others);
}

static void the_same_demo_gives_the_same_bytes(void **state) {
    (void)state;
    const char *first, *again = support_path(support_scratch(), "again");
    size_t count = json_array_size(steps_of("popping", &first));
    CommandResult r = command_run("demo", "popping", "--headless", "-o", again, "--size", "960x600", NULL);
    command_expect(&r, 0);
    for (size_t i = 1; i <= count; i++) {
        char a[4300], b[4300], a_sum[65], b_sum[65];
        snprintf(a, sizeof a, "%s/step_%02zu.png", first, i);
        snprintf(b, sizeof b, "%s/step_%02zu.png", again, i);
        assert_true(file_sha256(a, a_sum) && file_sha256(b, b_sum));
        assert_string_equal(a_sum, b_sum);
    }
}

// Swapping two blobs changes the pixel by a1 a2 (c1 - c2); T stays.
static void popping_jumps_by_the_product_of_the_alphas(void **state) {
    (void)state;
    json_t *steps = steps_of("popping", NULL);
    static const double teal[3] = {0.08, 0.7, 0.68}, orange[3] = {0.98, 0.48, 0.16};
    for (int pair = 0; pair < 2; pair++) { // steps 0 -> 1 opaque, 2 -> 3 faint and back
        int from = 2 * pair, sign = pair ? -1 : 1;
        double opacity = pair ? 0.25 : 0.9;
        // alpha' of both at the probe, from the demo's means and sigmas
        double alphas[2];
        for (int i = 0; i < 2; i++) {
            double theta = i ? -0.5 : 0.5, dx = 480.5 - (i ? 530 : 430), dy = 0.5;
            double u = (dx * cos(theta) + dy * sin(theta)) / 130, v = (dy * cos(theta) - dx * sin(theta)) / 80;
            alphas[i] = opacity * exp(-(u * u + v * v) / 2);
        }
        for (int c = 0; c < 3; c++)
            support_near(item(steps, from + 1, "rgb", c) - item(steps, from, "rgb", c),
                         sign * alphas[0] * alphas[1] * (orange[c] - teal[c]), 1e-12, "jump");
        support_near(number(steps, from + 1, "transmittance"), (1 - alphas[0]) * (1 - alphas[1]), 1e-12, "T");
    }
}

static void more_round_blobs_come_nearer_to_the_stretched_one(void **state) {
    (void)state;
    json_t *steps = steps_of("anisotropy", NULL);
    static const double counts[] = {1, 3, 6, 12}, least_psnr[] = {98, 25, 29, 37};
    for (int i = 0; i < 4; i++) {
        assert_true(number(steps, i, "gaussians") == counts[i]);
        assert_true(number(steps, i, "psnr") > least_psnr[i]);
    }
    assert_true(number(steps, 4, "psnr") < 23); // one round one
}

static void the_raw_walk_leaves_the_cone_in_the_demo(void **state) {
    (void)state;
    json_t *steps = steps_of("psd", NULL);
    assert_true(walk_number(steps, 1, "raw", "eigenvalue_minor") > 0);
    assert_true(walk_number(steps, 2, "raw", "eigenvalue_minor") < 0);
    assert_true(walk_number(steps, 2, "raw", "eigenvalue_major") > 0);
    assert_true(walk_number(steps, 3, "raw", "eigenvalue_major") < 0);
    double ratio = walk_number(steps, 2, "raw", "loss") / walk_number(steps, 0, "raw", "loss");
    assert_true(ratio > 8 && ratio < 10); // "nine times", says the caption
    assert_true(walk_number(steps, 4, "factored", "loss") < 1e-5);
}

static void weights_and_transmittance_add_up_to_one(void **state) {
    (void)state;
    static const char *const names[] = {"popping", "opacity", "transmittance", "early-stop"};
    for (int i = 0; i < 4; i++) {
        json_t *steps = steps_of(names[i], NULL);
        for (size_t step = 0; step < json_array_size(steps); step++)
            support_near(number(steps, (int)step, "weights") + number(steps, (int)step, "transmittance"), 1, 1e-12,
                         names[i]);
    }
}

// The unattenuated background adds (1 - T) times itself too much.
static void the_unattenuated_background_is_too_bright_by_what_is_hidden(void **state) {
    (void)state;
    json_t *steps = steps_of("transmittance", NULL);
    static const double wall[3] = {0.35, 0.38, 0.45};
    for (int c = 0; c < 3; c++)
        support_near(item(steps, 4, "rgb", c) - item(steps, 3, "rgb", c),
                     (1 - number(steps, 3, "transmittance")) * wall[c], 1e-12, "excess");
}

static void stopping_earlier_reads_less_within_the_bound(void **state) {
    (void)state;
    json_t *steps = steps_of("early-stop", NULL);
    assert_true(number(steps, 2, "mean_blobs_read") < number(steps, 1, "mean_blobs_read"));
    assert_true(number(steps, 5, "mean_blobs_read") < 0.7 * number(steps, 1, "mean_blobs_read"));
    for (int c = 0; c < 3; c++) {
        assert_true(fabs(item(steps, 2, "rgb", c) - item(steps, 0, "rgb", c)) < 0.01);
        assert_true(fabs(item(steps, 4, "rgb", c) - item(steps, 0, "rgb", c)) < 0.3);
    }
}

static void what_is_seen_through_follows_the_opacity(void **state) {
    (void)state;
    json_t *steps = steps_of("opacity", NULL);
    assert_true(item(steps, 0, "rgb", 2) > item(steps, 1, "rgb", 2)); // less violet
    support_near(number(steps, 1, "transmittance"), number(steps, 2, "transmittance"), 1e-12, "T in another order");
}

static void a_step_looks_the_same_from_both_sides(void **state) {
    (void)state;
    Demo demo;
    assert_true(demo_load("popping", &demo));
    assert_true(demo.steps[1].scene.blobs[1].depth == 0.9);
    assert_true(demo.steps[2].scene.blobs[1].depth == 0.9); // kept
    assert_true(demo.steps[2].scene.blobs[0].opacity == 0.25);
    assert_true(demo.steps[1].scene.blobs[0].opacity == 0.9); // not touched by the later step
    demo_free(&demo);
}

// ---- as a lecturer uses it; all tests share one window ----

static void start_lecture(void) {
    session_need_screen();
    if (!session_is_alive()) {
        char *demos = realpath("lab/app/demos", NULL); // the session runs elsewhere
        setenv("SPLATLAB_DEMOS", demos, 1);
        free(demos);
        session_start("demo", "popping", NULL);
    }
    session_do("key 1"); // popping, from its first step
}

static int end_lecture(void **state) {
    (void)state;
    session_end();
    return 0;
}

static void the_arrows_step_and_g_films(void **state) {
    (void)state;
    start_lecture();
    session_do("key Right");
    assert_true(session_scene()->blobs[1].depth == 0.9);
    session_do("key x; key g; key Right; key g");
    assert_true(session_scene()->blobs[0].opacity == 0.25);
    assert_true(session_scene()->blobs[1].sigma_x == 130); // what was done by hand before is gone
    assert_true(file_exists(support_path(support_scratch(), "demo.gif")));
    session_do("key x; key r");
    assert_true(session_scene()->blobs[1].sigma_x == 130); // anew
    session_do("key Left key Left key Left");
    assert_true(session_scene()->blobs[1].depth == 1.1);
}

static void digits_choose_the_demo(void **state) {
    (void)state;
    start_lecture();
    for (int i = 0; i < NAME_COUNT; i++) {
        Demo demo;
        assert_true(demo_load(NAMES[i], &demo));
        session_do("key Right; key %d", i + 1);
        assert_true(session_number("step") == 0);
        assert_int_equal(session_scene()->count, demo.steps[0].scene.count);
        demo_free(&demo);
    }
}

static void the_audience_is_asked_before_it_is_answered(void **state) {
    (void)state;
    start_lecture();
    session_do("key a; key Right");
    assert_true(session_number("step") == 0 && session_number("asking") == 1);
    assert_true(session_scene()->blobs[1].depth == 1.1); // nothing is given away
    session_do("key Left");
    assert_true(session_number("step") == 0 && session_number("asking") == 0);
    session_do("key Right; key Right");
    assert_true(session_number("step") == 1 && session_number("asking") == 0);
    assert_true(session_scene()->blobs[1].depth == 0.9);
    session_do("key a; key Left; key Right");
    assert_true(session_number("step") == 1); // at once
}

static void space_plays_and_freezes(void **state) {
    (void)state;
    start_lecture();
    session_do("key space");
    assert_true(session_number("playing") == 1);
    session_do("key space");
    assert_true(session_number("playing") == 0 && session_number("step") == 0);
}

static void b_hides_the_panel_and_plus_enlarges_the_text(void **state) {
    (void)state;
    start_lecture();
    double middle[2], small[2], large[2];
    session_place("canvas", middle, small);
    assert_true(session_has_place("Add"));
    session_do("key b");
    assert_false(session_has_place("Add"));
    session_place("canvas", middle, large);
    assert_true(large[0] == SESSION_WIDTH && small[0] < large[0]);
    session_do("key b");
    session_place("Add", middle, small);
    session_do("key plus key plus; mousemove 3 3"); // glyphs are made anew for the next frame
    session_place("Add", middle, large);
    assert_true(large[1] > 1.1 * small[1]);
    session_do("key minus key minus; mousemove 4 4");
    session_place("Add", middle, large);
    assert_true(large[1] == small[1]);
}

static void p_pins_the_pixel(void **state) {
    (void)state;
    start_lecture();
    double middle[2], size[2];
    session_place("canvas", middle, size);
    assert_true(session_number("probe x") == 480.5); // the step pins it
    session_do("mousemove %.0f %.0f; mousemove %.0f %.0f", middle[0] - 50, middle[1], middle[0] - 60, middle[1]);
    assert_true(session_number("probe x") == 480.5);
    session_do("key p; mousemove %.0f %.0f", middle[0] - 50, middle[1]);
    assert_true(session_number("probe x") < 450);
    double pinned = session_number("probe x");
    session_do("key p; mousemove %.0f %.0f", middle[0] + 50, middle[1]);
    assert_true(session_number("probe x") == pinned);
}

// Its lines need more vertices than sixteen bits count.
static void a_walk_of_two_thousand_steps_is_drawn(void **state) {
    (void)state;
    const char *path = support_path(support_scratch(), "long_walk.json");
    static const char text[] =
        "{\"title\": \"x\", \"steps\": [{\"caption\": \"a\", \"page\": \"psd\", \"rate\": 0.04, \"walk\": 2000}]}";
    assert_true(file_write(path, text, strlen(text)));
    CommandResult r = command_run("demo", path, "--headless", "-o", support_scratch(), NULL);
    command_expect(&r, 0);
}

static void broken_files_are_named(void **state) {
    (void)state;
    static const struct {
        const char *text, *says;
    } files[] = {
        {"{\"title\": \"x\", \"steps\": []}", "\"steps\" holds 0"},
        {"{\"title\": \"x\", \"steps\": [{\"caption\": \"a\", \"colour\": 1}]}",
         "step 0: there is no field \"colour\""},
        {"{\"title\": \"x\", \"steps\": [{}]}", "\"caption\""},
        {"{\"title\": \"x\", \"steps\": [{\"caption\": \"a\", \"set\": [{\"blob\": 0}]}]}", "\"blob\" is 0"},
        {"{\"title\": \"x\", \"steps\": [{\"caption\": \"a\", \"stop\": 2}]}", "\"stop\" is 2"},
        {"{\"title\": \"x\", \"steps\": [{\"caption\": \"a\", \"page\": \"psb\"}]}", "\"psb\""},
        {"{\"title\": \"x\", \"steps\": [{\"caption\": \"a\", \"outlines\": 1}]}", "neither true nor false"},
        {"{\"title\": \"x\"", "line 1"},
    };
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++) {
        const char *path = support_path(support_scratch(), "broken.json");
        assert_true(file_write(path, files[i].text, strlen(files[i].text)));
        CommandResult r = command_run("demo", path, "--headless", "-o", support_scratch(), NULL);
        command_expect_error(&r, 1, "broken.json", files[i].says, NULL);
    }
}

static void wrong_usage_ends_with_exit_code_2(void **state) {
    (void)state;
    CommandResult r = command_run("demo", NULL);
    command_expect_error(&r, 2, "popping", NULL);
    r = command_run("demo", "poping", "--headless", "-o", "x", NULL);
    command_expect_error(&r, 2, "did you mean popping?", NULL);
    r = command_run("demo", "popping", "--headless", NULL);
    command_expect_error(&r, 2, "-o DIR", NULL);
    r = command_run("demo", "popping", "-o", "x", NULL);
    command_expect_error(&r, 2, "--headless", NULL);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_step_of_every_demo_looks_as_it_did),
        cmocka_unit_test(the_same_demo_gives_the_same_bytes),
        cmocka_unit_test(popping_jumps_by_the_product_of_the_alphas),
        cmocka_unit_test(more_round_blobs_come_nearer_to_the_stretched_one),
        cmocka_unit_test(the_raw_walk_leaves_the_cone_in_the_demo),
        cmocka_unit_test(weights_and_transmittance_add_up_to_one),
        cmocka_unit_test(the_unattenuated_background_is_too_bright_by_what_is_hidden),
        cmocka_unit_test(stopping_earlier_reads_less_within_the_bound),
        cmocka_unit_test(what_is_seen_through_follows_the_opacity),
        cmocka_unit_test(a_step_looks_the_same_from_both_sides),
        cmocka_unit_test(the_arrows_step_and_g_films),
        cmocka_unit_test(digits_choose_the_demo),
        cmocka_unit_test(the_audience_is_asked_before_it_is_answered),
        cmocka_unit_test(space_plays_and_freezes),
        cmocka_unit_test(b_hides_the_panel_and_plus_enlarges_the_text),
        cmocka_unit_test(p_pins_the_pixel),
        cmocka_unit_test(a_walk_of_two_thousand_steps_is_drawn),
        cmocka_unit_test(broken_files_are_named),
        cmocka_unit_test(wrong_usage_ends_with_exit_code_2),
    };
    return cmocka_run_group_tests(tests, NULL, end_lecture);
}
