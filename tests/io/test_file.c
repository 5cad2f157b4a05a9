// test_file.c - atomic writes, failures that leave the old file alone, folders.
#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/io/file.h"
#include "tests/support/support.h"

#include <errno.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

static char *make_folder(const char *name) {
    char *folder = file_join(support_scratch(), name);
    assert_true(file_make_folder(folder));
    return folder;
}

static void assert_content(const char *path, const char *content) {
    char *data;
    size_t size;
    if (!file_read(path, &data, &size)) fail_msg("%s", fail_text());
    assert_int_equal(size, strlen(content));
    assert_memory_equal(data, content, size + 1);
    mem_free(data);
}

static int count_entries(const char *folder) {
    char **names;
    int count;
    assert_true(file_list(folder, &names, &count));
    file_list_free(names, count);
    return count;
}

static void what_is_written_is_read_back(void **state) {
    (void)state;
    char *folder = make_folder("round");
    const char *path = support_path(folder, "a.bin");
    assert_true(file_write(path, "x\0y", 3));
    char *data;
    size_t size;
    assert_true(file_read(path, &data, &size));
    assert_int_equal(size, 3);
    assert_memory_equal(data, "x\0y", 4);
    mem_free(data);
    assert_true(file_write(path, "", 0));
    assert_content(path, "");
    assert_int_equal(count_entries(folder), 1);
    mem_free(folder);
}

static void a_pipe_of_unknown_length_is_read_whole(void **state) {
    (void)state;
    char *path = file_join(support_scratch(), "pipe");
    assert_int_equal(mkfifo(path, 0600), 0);
    char *command = mem_format("head -c 300000 /dev/zero > '%s' &", path);
    assert_int_equal(system(command), 0);
    char *data;
    size_t size;
    assert_true(file_read(path, &data, &size));
    assert_int_equal(size, 300000);
    mem_free(data);
    mem_free(command);
    mem_free(path);
}

static void a_missing_file_is_named(void **state) {
    (void)state;
    char *data;
    size_t size;
    assert_false(file_read("no/such/file.bin", &data, &size));
    assert_non_null(strstr(fail_text(), "no/such/file.bin"));
    assert_non_null(strstr(fail_text(), "is the path right?"));
    assert_false(file_read(support_scratch(), &data, &size));
    assert_non_null(strstr(fail_text(), "folder"));
}

static void an_abandoned_write_leaves_the_old_file(void **state) {
    (void)state;
    char *folder = make_folder("abandon");
    char *path = file_join(folder, "a.txt");
    assert_true(file_write(path, "old", 3));
    FileWriter writer;
    assert_true(file_begin(&writer, path));
    fputs("new", writer.stream);
    fflush(writer.stream);
    assert_content(path, "old");
    assert_int_equal(count_entries(folder), 2);
    file_abandon(&writer);
    file_abandon(&writer);
    assert_content(path, "old");
    assert_int_equal(count_entries(folder), 1);
    mem_free(path);
    mem_free(folder);
}

static void a_full_disk_is_an_error_and_leaves_the_old_file(void **state) {
    (void)state;
    char *folder = make_folder("full");
    char *path = file_join(folder, "a.txt");
    assert_true(file_write(path, "old", 3));
    for (int large = 0; large <= 1; large++) { // noticed when the stream is flushed at the end, or long before
        FileWriter writer;
        assert_true(file_begin(&writer, path));
        assert_non_null(freopen("/dev/full", "wb", writer.stream));
        for (int i = 0; i < (large ? 100000 : 1); i++) fputs("new", writer.stream);
        assert_false(file_commit(&writer));
        assert_non_null(strstr(fail_text(), path));
        assert_content(path, "old");
        assert_int_equal(count_entries(folder), 1);
    }
    mem_free(path);
    mem_free(folder);
}

static void a_size_limit_is_an_error_and_leaves_the_old_file(void **state) {
    (void)state;
    char *folder = make_folder("limit");
    char *path = file_join(folder, "a.txt");
    assert_true(file_write(path, "old", 3));
    struct rlimit old, tiny;
    getrlimit(RLIMIT_FSIZE, &old);
    tiny = old;
    tiny.rlim_cur = 1000;
    signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &tiny);
    char *zeros = mem_alloc(5000, 1);
    bool written = file_write(path, zeros, 5000);
    setrlimit(RLIMIT_FSIZE, &old);
    assert_false(written);
    assert_non_null(strstr(fail_text(), "a.txt"));
    assert_content(path, "old");
    assert_int_equal(count_entries(folder), 1);
    mem_free(zeros);
    mem_free(path);
    mem_free(folder);
}

static void a_folder_or_device_is_never_replaced(void **state) {
    (void)state;
    assert_false(file_write(support_scratch(), "x", 1));
    assert_non_null(strstr(fail_text(), "folder"));
    assert_false(file_write("/dev/null", "x", 1));
    assert_non_null(strstr(fail_text(), "/dev/null"));
}

static void a_folder_that_cannot_be_written_is_noticed(void **state) {
    (void)state;
    assert_true(file_can_write_in(support_scratch()));
    assert_false(file_can_write_in("no/such/folder"));
    assert_non_null(strstr(fail_text(), "no/such/folder"));
    assert_false(file_can_write_in("/proc")); // not even for root
    assert_non_null(strstr(fail_text(), "/proc"));
    assert_false(file_write("no/such/folder/a.txt", "x", 1));
    assert_non_null(strstr(fail_text(), "no/such/folder/a.txt"));
}

static void folders_are_made_with_their_parents(void **state) {
    (void)state;
    char *deep = file_join(support_scratch(), "p//q/r/");
    assert_true(file_make_folder(deep));
    assert_true(file_make_folder(deep));
    assert_true(file_is_folder(deep));
    const char *file = support_path(deep, "file");
    assert_true(file_write(file, "", 0));
    assert_true(file_exists(file));
    assert_false(file_is_folder(file));
    assert_false(file_make_folder(support_path(file, "sub")));
    assert_non_null(strstr(fail_text(), "file"));
    // The reason told is why it could not be made, not that it is not there.
    assert_false(file_make_folder("/sys/nobody makes folders here"));
    assert_null(strstr(fail_text(), strerror(ENOENT)));
    mem_free(deep);
}

static void assert_text(char *actual, const char *expected) {
    assert_string_equal(actual, expected);
    mem_free(actual);
}

static void names_are_joined_and_split(void **state) {
    (void)state;
    assert_text(file_join("a", "b"), "a/b");
    assert_text(file_join("a/", "b"), "a/b");
    assert_text(file_join("a", "/b"), "/b");
    assert_text(file_folder_of("a/b.ply"), "a");
    assert_text(file_folder_of("b.ply"), ".");
    assert_text(file_folder_of("/b.ply"), "/");
    assert_true(file_has_ending("a/B.PLY", ".ply"));
    assert_false(file_has_ending("ply", ".ply"));
}

static void a_folder_is_listed_sorted_by_bytes(void **state) {
    (void)state;
    char *folder = make_folder("list");
    const char *names[] = {"b", "a", "B", "a0", ".hidden"};
    for (int i = 0; i < 5; i++) assert_true(file_write(support_path(folder, names[i]), "", 0));
    char **found;
    int count;
    assert_true(file_list(folder, &found, &count));
    const char *sorted[] = {".hidden", "B", "a", "a0", "b"};
    assert_int_equal(count, 5);
    for (int i = 0; i < 5; i++) assert_string_equal(found[i], sorted[i]);
    file_list_free(found, count);
    assert_false(file_list(support_path(folder, "none"), &found, &count));
    mem_free(folder);
}

static void sha256_gives_the_known_answer(void **state) {
    (void)state;
    char *path = file_join(support_scratch(), "abc");
    assert_true(file_write(path, "abc", 3));
    char hex[65];
    assert_true(file_sha256(path, hex)); // FIPS 180-2, appendix B.1
    assert_string_equal(hex, "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    assert_false(file_sha256("no/such/file", hex));
    mem_free(path);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_written_is_read_back),
        cmocka_unit_test(a_pipe_of_unknown_length_is_read_whole),
        cmocka_unit_test(a_missing_file_is_named),
        cmocka_unit_test(an_abandoned_write_leaves_the_old_file),
        cmocka_unit_test(a_full_disk_is_an_error_and_leaves_the_old_file),
        cmocka_unit_test(a_size_limit_is_an_error_and_leaves_the_old_file),
        cmocka_unit_test(a_folder_or_device_is_never_replaced),
        cmocka_unit_test(a_folder_that_cannot_be_written_is_noticed),
        cmocka_unit_test(folders_are_made_with_their_parents),
        cmocka_unit_test(names_are_joined_and_split),
        cmocka_unit_test(a_folder_is_listed_sorted_by_bytes),
        cmocka_unit_test(sha256_gives_the_known_answer),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
