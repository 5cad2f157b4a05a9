#include "lab/base/mem.h"
#include "tests/support/support.h"

#include <stdint.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

static void memory_is_zeroed_and_aligned(void **state) {
    (void)state;
    for (size_t count = 0; count < 300; count += 7) {
        unsigned char *p = mem_alloc(count, 3);
        assert_non_null(p);
        assert_int_equal((uintptr_t)p % MEM_ALIGN, 0);
        for (size_t i = 0; i < 3 * count; i++) assert_int_equal(p[i], 0);
        memset(p, 0xAB, 3 * count); // so that a later block shows when it is not zeroed
        mem_free(p);
    }
}

static void resizing_keeps_the_content_and_zeroes_the_rest(void **state) {
    (void)state;
    int *p = mem_resize(NULL, 0, 3, sizeof *p);
    for (int i = 0; i < 3; i++) p[i] = i + 1;
    p = mem_resize(p, 3, 1000, sizeof *p);
    for (int i = 0; i < 1000; i++) assert_int_equal(p[i], i < 3 ? i + 1 : 0);
    p = mem_resize(p, 1000, 2, sizeof *p);
    assert_int_equal(p[0], 1);
    assert_int_equal(p[1], 2);
    mem_free(p);
}

static void texts_are_copied_and_formatted(void **state) {
    (void)state;
    char *copy = mem_text("abc"), *made = mem_format("%s/%d", copy, 12);
    assert_string_equal(copy, "abc");
    assert_string_equal(made, "abc/12");
    mem_free(copy);
    mem_free(made);
    mem_free(NULL);
}

// What a child does that asks for count x size bytes: its exit code, and what it said.
static int exit_code_of_alloc(size_t count, size_t size, char *said, size_t said_bytes) {
    int ends[2];
    assert_int_equal(pipe(ends), 0);
    pid_t child = fork();
    if (child == 0) {
        dup2(ends[1], STDERR_FILENO);
        mem_alloc(count, size);
        _exit(99);
    }
    close(ends[1]);
    ssize_t length = read(ends[0], said, said_bytes - 1);
    said[length > 0 ? length : 0] = 0;
    close(ends[0]);
    int status;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

static void an_impossible_request_ends_the_program_with_a_message(void **state) {
    (void)state;
    char said[512];
    assert_int_equal(exit_code_of_alloc(SIZE_MAX / 2, 4, said, sizeof said), 1); // the product overflows
    assert_non_null(strstr(said, "no memory"));
    assert_int_equal(exit_code_of_alloc(SIZE_MAX - 5, 1, said, sizeof said), 1); // rounding up would overflow
    assert_non_null(strstr(said, "no memory"));
}

static void the_peak_counts_what_was_touched(void **state) {
    (void)state;
    enum { BYTES = 32 << 20 };
    char *p = mem_alloc(BYTES, 1);
    assert_true(mem_peak_bytes() >= BYTES);
    mem_free(p);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(memory_is_zeroed_and_aligned),
        cmocka_unit_test(resizing_keeps_the_content_and_zeroes_the_rest),
        cmocka_unit_test(texts_are_copied_and_formatted),
        cmocka_unit_test(an_impossible_request_ends_the_program_with_a_message),
        cmocka_unit_test(the_peak_counts_what_was_touched),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
