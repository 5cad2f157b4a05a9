#include "lab/app/fit_film.h"

#include "lab/base/fail.h"
#include "lab/io/image_io.h"
#include "tests/support/support.h"

// Plays a fit of that many steps; returns how many frames are kept.
static int frames_of(int total) {
    ImageF picture = imagef_create(4, 4, 3);
    FitFilm film = fit_film_begin(total);
    for (int step = 0; step <= total; step++)
        if (fit_film_wants(&film, step)) fit_film_add(&film, &picture);
    int count = film.count;
    fit_film_destroy(&film);
    imagef_destroy(&picture);
    return count;
}

static void a_film_is_never_too_long_and_has_start_and_end(void **state) {
    (void)state;
    assert_int_equal(frames_of(1), 2);
    assert_int_equal(frames_of(5), 6);
    assert_int_equal(frames_of(100000), FIT_FILM_FRAMES + 1);
    for (int total = 1; total < 3000; total += 97) assert_in_range(frames_of(total), 2, FIT_FILM_FRAMES + 1);
    FitFilm film = fit_film_begin(1000);
    assert_true(fit_film_wants(&film, 0));
    assert_true(fit_film_wants(&film, 1000));
    assert_false(fit_film_wants(&film, 999));
}

static void a_frame_is_not_larger_than_a_frame_may_be(void **state) {
    (void)state;
    ImageF picture = imagef_create(4 * FIT_FILM_SIDE, FIT_FILM_SIDE, 3);
    FitFilm film = fit_film_begin(1);
    fit_film_add(&film, &picture);
    assert_int_equal(film.frames[0].width, FIT_FILM_SIDE);
    assert_int_equal(film.frames[0].height, FIT_FILM_SIDE / 4);
    const char *path = support_path(support_scratch(), "film.gif");
    if (!fit_film_save(&film, path)) fail_msg("%s", fail_text());
    Image8 first;
    assert_true(image_load8(path, &first));
    assert_int_equal(first.width, FIT_FILM_SIDE);
    image8_destroy(&first);
    fit_film_destroy(&film);
    imagef_destroy(&picture);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_film_is_never_too_long_and_has_start_and_end),
        cmocka_unit_test(a_frame_is_not_larger_than_a_frame_may_be),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
