#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/base/rng.h"
#include "lab/io/file.h"
#include "splat3d/training_state.h"
#include "tests/support/support.h"

#include <string.h>

static TrainingState random_state(int count, int degree) {
    TrainingState s = training_state_from_model(gaussians_create(count, degree));
    Gaussians *parts[3] = {&s.model, &s.m, &s.v};
    Rng rng = rng_at(5, RNG_TEST, 0, 0);
    for (int p = 0; p < 3; p++)
        for (GaussianFieldId f = 0; f < FIELD_COUNT; f++)
            for (int i = 0; parts[p]->field[f] && i < count * GAUSSIAN_FIELDS[f].width; i++)
                parts[p]->field[f][i] = (float)rng_normal(&rng);
    for (int i = 0; i < count; i++) s.id[i] = rng_u32(&rng), s.gradient_sum[i] = (float)i, s.seen[i] = 2 * i;
    s.next_id = 77, s.steps_done = 123, s.seconds = 4.5, s.scene = 1ull << 63 | 5;
    return s;
}

static void a_state_comes_back_byte_for_byte(void **state) {
    (void)state;
    for (int degree = 0; degree <= SH_DEGREE_MAX; degree++) {
        TrainingState a = random_state(17 * degree, degree), b;
        const char *path = support_path(support_scratch(), "a.bin"), *again = support_path(support_scratch(), "b.bin");
        assert_true(training_state_save(&a, path));
        assert_true(training_state_load(path, &b));
        assert_true(training_state_save(&b, again));
        char *x, *y;
        size_t nx, ny;
        assert_true(file_read(path, &x, &nx) && file_read(again, &y, &ny));
        assert_int_equal(nx, ny);
        assert_memory_equal(x, y, nx);
        assert_int_equal(b.steps_done, 123);
        assert_int_equal(b.next_id, 77);
        assert_true(b.scene == (1ull << 63 | 5));
        assert_memory_equal(a.seen, b.seen, (size_t)a.model.count * sizeof *a.seen);
        mem_free(x);
        mem_free(y);
        training_state_destroy(&a);
        training_state_destroy(&b);
    }
}

// Every single damaged byte and every cut is noticed.
static void a_damaged_checkpoint_is_refused(void **state) {
    (void)state;
    TrainingState a = random_state(3, 1), b;
    const char *path = support_path(support_scratch(), "damaged.bin");
    assert_true(training_state_save(&a, path));
    char *data;
    size_t size;
    assert_true(file_read(path, &data, &size));
    for (size_t i = 0; i < size; i += 7) {
        data[i] ^= 0x10;
        assert_true(file_write(path, data, size));
        if (training_state_load(path, &b)) fail_msg("a flipped bit in byte %zu was not noticed", i);
        assert_non_null(strstr(fail_text(), "damaged.bin"));
        data[i] ^= 0x10;
    }
    for (size_t cut = 0; cut < size; cut += 11) {
        assert_true(file_write(path, data, cut));
        if (training_state_load(path, &b)) fail_msg("a file cut at byte %zu was accepted", cut);
    }
    mem_free(data);
    training_state_destroy(&a);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_state_comes_back_byte_for_byte),
        cmocka_unit_test(a_damaged_checkpoint_is_refused),
    };
    return cmocka_run_group_tests_name("training_state", tests, NULL, NULL);
}
