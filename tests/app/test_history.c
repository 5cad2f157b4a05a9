#include "lab/app/history.h"
#include "lab/base/rng.h"
#include "tests/support/support.h"

enum { EDITS = 40 };

static void edit(Scene2d *scene, Rng *rng) {
    uint32_t kind = scene->count == 0 ? 0 : rng_below(rng, 4);
    Blob blob = {.sigma_x = rng_range(rng, 1, 9), .sigma_y = 2, .depth = rng_range(rng, 0, 9)};
    int index = scene->count > 0 ? (int)rng_below(rng, (uint32_t)scene->count) : 0;
    if (kind == 0) scene2d_add(scene, &blob);
    if (kind == 1) scene2d_remove(scene, index);
    if (kind == 2) scene->blobs[index].theta_rad += rng_range(rng, 0.1, 1);
    if (kind == 3) scene->background[0] = rng_uniform(rng);
}

static void undo_and_redo_give_back_every_scene(void **state) {
    (void)state;
    static History history;
    Scene2d scenes[EDITS + 1], scene = scene2d_default();
    Rng rng = rng_at(1, RNG_TEST, 0, 0);
    int active;
    history_begin(&history, &scene, 0);
    scenes[0] = scene2d_copy(&scene);
    for (int i = 1; i <= EDITS; i++) {
        edit(&scene, &rng);
        history_record(&history, &scene, i);
        scenes[i] = scene2d_copy(&scene);
    }
    for (int i = EDITS - 1; i >= 0; i--) {
        assert_true(history_undo(&history, &scene, &active));
        assert_true(scene_equals(&scene, &scenes[i]));
        assert_int_equal(active, i);
    }
    assert_false(history_undo(&history, &scene, &active));
    for (int i = 1; i <= EDITS; i++) {
        assert_true(history_redo(&history, &scene, &active));
        assert_true(scene_equals(&scene, &scenes[i]));
    }
    assert_false(history_redo(&history, &scene, &active));
    for (int i = 0; i <= EDITS; i++) scene2d_destroy(&scenes[i]);
    scene2d_destroy(&scene);
    history_end(&history);
}

static void a_new_edit_forgets_what_was_undone(void **state) {
    (void)state;
    static History history;
    Scene2d scene = scene2d_default();
    int active;
    Blob first[2] = {scene.blobs[0], scene.blobs[1]};
    history_begin(&history, &scene, 0);
    scene.blobs[0].opacity = 0.5;
    history_record(&history, &scene, 0);
    assert_true(history_undo(&history, &scene, &active));
    scene.blobs[1].opacity = 0.25;
    history_record(&history, &scene, 0);
    assert_false(history_redo(&history, &scene, &active));
    assert_true(history_undo(&history, &scene, &active));
    assert_memory_equal(scene.blobs, first, sizeof first);
    scene2d_destroy(&scene);
    history_end(&history);
}

static void the_same_scene_is_no_step(void **state) {
    (void)state;
    static History history;
    Scene2d scene = scene2d_default();
    int active;
    history_begin(&history, &scene, 0);
    history_record(&history, &scene, 3); // another choice is no edit
    assert_false(history_undo(&history, &scene, &active));
    scene2d_destroy(&scene);
    history_end(&history);
}

static void the_oldest_steps_are_dropped(void **state) {
    (void)state;
    static History history;
    Scene2d scene = scene2d_create(100, 100);
    Blob blob = {.sigma_x = 1, .sigma_y = 1};
    int active, undone = 0;
    scene2d_add(&scene, &blob);
    history_begin(&history, &scene, 0);
    for (int i = 1; i <= HISTORY_STEPS_MAX + 50; i++) {
        scene.blobs[0].depth = i;
        history_record(&history, &scene, 0);
    }
    while (history_undo(&history, &scene, &active)) undone++;
    assert_int_equal(undone, HISTORY_STEPS_MAX - 1);
    assert_true(scene.blobs[0].depth == 51);
    scene2d_destroy(&scene);
    history_end(&history);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(undo_and_redo_give_back_every_scene),
        cmocka_unit_test(a_new_edit_forgets_what_was_undone),
        cmocka_unit_test(the_same_scene_is_no_step),
        cmocka_unit_test(the_oldest_steps_are_dropped),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
