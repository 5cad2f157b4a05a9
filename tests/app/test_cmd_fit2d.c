// test_cmd_fit2d.c - `splatlab fit2d` as a person calls it.
#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/io/file.h"
#include "lab/io/image_io.h"
#include "splat2d/loss.h"
#include "splat2d/raster2d.h"
#include "splat2d/scene2d_json.h"
#include "tests/support/command.h"
#include "tests/support/session.h"
#include "tests/support/support.h"

#include <jansson.h>
#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

static const char *scratch(const char *name) { return support_path(support_scratch(), name); }

// A picture with something in it: the lesson's scene.
static const char *photo_path(void) {
    const char *path = scratch("photo.png");
    if (file_exists(path)) return path;
    Scene2d scene = scene2d_default();
    ImageF photo = imagef_create(96, 72, 3);
    Raster2d raster = {0};
    RasterSettings settings = raster_settings_default();
    raster2d_load(&raster, &scene, view2d_fit(&scene, 96, 72));
    raster2d_draw(&raster, &settings, &photo, NULL);
    assert_true(image_savef(path, &photo));
    raster2d_destroy(&raster);
    scene2d_destroy(&scene);
    imagef_destroy(&photo);
    return path;
}

static double number(const json_t *root, const char *key) {
    const json_t *value = json_object_get(root, key);
    if (!json_is_number(value)) fail_msg("no number \"%s\"", key);
    return json_number_value(value);
}

static void a_fit_leaves_picture_scene_comparison_and_film(void **state) {
    (void)state;
    const char *photo = photo_path(), *out = scratch("out");
    CommandResult r = command_run("fit2d", photo, "-n", "30", "--iterations", "60", "-o", out, "--gif", "--json", NULL);
    command_expect(&r, 0);
    json_t *root = json_loads(r.out, 0, NULL);
    assert_non_null(root);
    double psnr = number(root, "psnr");
    assert_true(psnr > 30 && number(root, "ssim") > 0.8 && number(root, "seconds") > 0);
    assert_int_equal(number(root, "gaussians"), 30);
    assert_int_equal(number(root, "iterations"), 60);
    assert_true(json_is_false(json_object_get(root, "interrupted")));
    json_decref(root);

    Scene2d scene;
    ImageF original, fitted, comparison;
    Image8 first_frame;
    if (!scene2d_load(support_path(out, "fit.json"), &scene) || !image_loadf(photo, &original) ||
        !image_loadf(support_path(out, "fit.png"), &fitted) ||
        !image_load8(support_path(out, "fit.gif"), &first_frame) ||
        !image_loadf(support_path(out, "comparison.png"), &comparison))
        fail_msg("%s", fail_text());
    assert_int_equal(scene.count, 30);
    assert_int_equal(scene.width, 96);
    support_near(metric_psnr(&fitted, &original), psnr, 0.1, "what is saved is what was scored");
    assert_int_equal(first_frame.width, 96);
    assert_true(comparison.width >= 2 * 96 && comparison.height >= 2 * 72);
    image8_destroy(&first_frame);
    imagef_destroy(&comparison);
    imagef_destroy(&original);
    imagef_destroy(&fitted);
    scene2d_destroy(&scene);
}

static void the_same_seed_writes_the_same_bytes_with_any_number_of_threads(void **state) {
    (void)state;
    const char *photo = photo_path(), *files[] = {"fit.json", "fit.png", "comparison.png"};
    char outs[3][4096]; // support_path() has few buffers
    for (int k = 0; k < 3; k++) snprintf(outs[k], sizeof outs[k], "%s/same_%d", support_scratch(), k);
    for (int k = 0; k < 3; k++) {
        setenv("SPLATLAB_THREADS", k == 0 ? "1" : "2", 1);
        CommandResult r = command_run("fit2d", photo, "-n", "20", "--iterations", "20", "--seed", k == 2 ? "5" : "4",
                                      "-q", "-o", outs[k], NULL);
        command_expect(&r, 0);
        assert_string_equal(r.err, "");
    }
    unsetenv("SPLATLAB_THREADS");
    for (int f = 0; f < 3; f++) {
        char sums[3][65];
        for (int k = 0; k < 3; k++) assert_true(file_sha256(support_path(outs[k], files[f]), sums[k]));
        assert_string_equal(sums[0], sums[1]);
        assert_string_not_equal(sums[0], sums[2]);
    }
}

static void the_photograph_is_made_smaller(void **state) {
    (void)state;
    static const struct {
        const char *option, *value;
        int width, height;
    } cases[] = {{"--size", "50x50", 50, 38}, {"--size", "500x36", 48, 36}, {"--downscale", "3", 32, 24}};
    for (int i = 0; i < 3; i++) {
        CommandResult r = command_run("fit2d", photo_path(), "-n", "5", "--iterations", "2", "-q", "--json", "-o",
                                      scratch("small"), cases[i].option, cases[i].value, NULL);
        command_expect(&r, 0);
        json_t *root = json_loads(r.out, 0, NULL);
        assert_int_equal(number(root, "width"), cases[i].width);
        assert_int_equal(number(root, "height"), cases[i].height);
        json_decref(root);
    }
}

static void wrong_usage_is_told(void **state) {
    (void)state;
    const char *photo = photo_path();
    CommandResult r = command_run("fit2d", NULL);
    command_expect_error(&r, 2, "which photograph", NULL);
    r = command_run("fit2d", photo, NULL);
    command_expect_error(&r, 2, "-o", NULL);
    r = command_run("fit2d", photo, "-o", scratch("x.png"), NULL);
    command_expect_error(&r, 2, "x.png", "folder", NULL);
    r = command_run("fit2d", photo, "-o", scratch("y"), "-n", "0", NULL);
    command_expect_error(&r, 2, "--gaussians 0", NULL);
    r = command_run("fit2d", photo, "-o", scratch("y"), "--size", "0x40", NULL);
    command_expect_error(&r, 2, "0x40", NULL);
    r = command_run("fit2d", scratch("absent.png"), "-o", scratch("y"), NULL);
    command_expect_error(&r, 1, "absent.png", NULL);
    r = command_run("fit2d", photo, "-o", scratch("y"), "--downscale", "64", NULL);
    command_expect(&r, 0); // 1 x 1 px
    r = command_run("fit2d", photo, "-o", "/proc/none", NULL);
    command_expect_error(&r, 1, "/proc/none", NULL);
}

// A fit that would take hours is interrupted: it saves, says so, and ends well.
static void ctrl_c_saves_and_ends_well(void **state) {
    (void)state;
    const char *program = getenv("SPLATLAB") ? getenv("SPLATLAB") : "./splatlab";
    const char *photo = photo_path(), *out = scratch("stopped"), *err = scratch("stopped.txt");
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        if (!freopen(err, "w", stderr) || !freopen("/dev/null", "w", stdout)) _exit(99);
        execl(program, program, "fit2d", photo, "-n", "20", "--iterations", "9999999", "-o", out, (char *)NULL);
        _exit(99);
    }
    // The first message is written before the first step; the signal handler is in place by then or soon after.
    char *text = NULL;
    size_t size = 0;
    for (int i = 0; i < 100 && size == 0; i++) {
        usleep(100000);
        mem_free(text);
        text = NULL;
        if (file_exists(err) && !file_read(err, &text, &size)) fail_msg("%s", fail_text());
    }
    mem_free(text);
    usleep(300000);
    kill(child, SIGINT);
    int status;
    assert_int_equal(waitpid(child, &status, 0), child);
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) fail_msg("ended with status %#x", status);
    assert_true(file_read(err, &text, &size));
    assert_non_null(strstr(text, "saved"));
    mem_free(text);
    Scene2d scene;
    if (!scene2d_load(support_path(out, "fit.json"), &scene)) fail_msg("%s", fail_text());
    assert_int_equal(scene.count, 20);
    scene2d_destroy(&scene);
}

// ---- in a window ----

static void same_files(const char *a, const char *b) {
    static const char *const files[] = {"fit.json", "fit.png", "comparison.png", "fit.gif"};
    for (int f = 0; f < 4; f++) {
        char sums[2][65];
        assert_true(file_sha256(support_path(a, files[f]), sums[0]) && file_sha256(support_path(b, files[f]), sums[1]));
        assert_string_equal(sums[0], sums[1]);
    }
}

static void a_window_gives_the_same_bytes(void **state) {
    (void)state;
    session_need_screen();
    const char *photo = photo_path();
    char outs[2][4096], shot[4096], report[4096]; // support_path() has few buffers
    for (int k = 0; k < 2; k++) snprintf(outs[k], sizeof outs[k], "%s/live_%d", support_scratch(), k);
    snprintf(shot, sizeof shot, "%s/live.png", support_scratch());
    snprintf(report, sizeof report, "%s/live.json", support_scratch());
    CommandResult r = command_run("fit2d", photo, "-n", "20", "--iterations", "40", "--seed", "3", "--grow", "--gif",
                                  "-q", "-o", outs[0], NULL);
    command_expect(&r, 0);
    r = command_run("fit2d", photo, "-n", "20", "--iterations", "40", "--seed", "3", "--grow", "--gif", "-q", "-o",
                    outs[1], "--live", "--frames", "50", "--window-size", "900x600", "--screenshot", shot,
                    "--state-file", report, "--json", NULL);
    command_expect(&r, 0);
    json_t *root = json_loads(r.out, 0, NULL);
    assert_true(json_is_false(json_object_get(root, "interrupted")));
    assert_int_equal(number(root, "iterations"), 40);
    json_decref(root);
    same_files(outs[0], outs[1]);
    Image8 image;
    assert_true(image_load8(shot, &image));
    assert_int_equal(image.width, 900);
    image8_destroy(&image);
    root = json_load_file(report, 0, NULL);
    assert_int_equal(number(root, "step"), 40);
    assert_true(json_is_true(json_object_get(root, "saved")) && number(root, "psnr") > 20);
    json_decref(root);
}

static void space_pauses_s_steps_and_closing_saves(void **state) {
    (void)state;
    session_need_screen();
    double middle[2], size[2];
    session_start("fit2d", photo_path(), "-n", "20", "--iterations", "9999999", "-o", scratch("closed"), "--live",
                  NULL);
    session_do("key space");
    double step = session_state("step");
    session_do("mousemove 5 5");
    assert_true(session_state("step") == step); // it stands
    session_do("key s; key s");
    assert_true(session_state("step") == step + 2);
    session_place("Step", middle, size);
    session_do("mousemove %.0f %.0f; mousedown 1; mouseup 1", middle[0], middle[1]);
    assert_true(session_state("step") == step + 3);
    session_do("key r");
    assert_true(session_state("step") == 0);
    session_do("key s");
    assert_true(session_state("step") == 1);
    session_do("key 2; key space; mousemove 9 9; key space");
    step = session_state("step");
    assert_true(step > 1);
    session_do("key ctrl+q");
    assert_int_equal(session_wait(), 0);
    Scene2d scene;
    if (!scene2d_load(support_path(scratch("closed"), "fit.json"), &scene)) fail_msg("%s", fail_text());
    assert_int_equal(scene.count, 20);
    scene2d_destroy(&scene);
}

static void ctrl_c_in_a_window_saves(void **state) {
    (void)state;
    session_need_screen();
    const char *out = scratch("signalled");
    session_start("fit2d", photo_path(), "-n", "20", "--iterations", "9999999", "-o", out, "--live", NULL);
    assert_int_equal(session_end(), 0);
    assert_true(file_exists(support_path(out, "fit.png")) && file_exists(support_path(out, "fit.json")));
}

static void options_of_a_window_need_one(void **state) {
    (void)state;
    CommandResult r = command_run("fit2d", photo_path(), "-o", scratch("y"), "--frames", "3", NULL);
    command_expect_error(&r, 2, "--live", NULL);
    r = command_run("fit2d", photo_path(), "-o", scratch("y"), "--live", "--screenshot", "a.png", NULL);
    command_expect_error(&r, 2, "--frames", NULL);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_fit_leaves_picture_scene_comparison_and_film),
        cmocka_unit_test(the_same_seed_writes_the_same_bytes_with_any_number_of_threads),
        cmocka_unit_test(the_photograph_is_made_smaller),
        cmocka_unit_test(wrong_usage_is_told),
        cmocka_unit_test(ctrl_c_saves_and_ends_well),
        cmocka_unit_test(a_window_gives_the_same_bytes),
        cmocka_unit_test(space_pauses_s_steps_and_closing_saves),
        cmocka_unit_test(ctrl_c_in_a_window_saves),
        cmocka_unit_test(options_of_a_window_need_one),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
