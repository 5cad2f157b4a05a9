// exercise_help.c - hints one by one, a fresh start, and our solution when it is open.
#include "lab/app/exercise_options.h"

#include "exercises/harness/hints.h"
#include "exercises/harness/ledger.h"
#include "exercises/harness/page.h"
#include "exercises/harness/standing.h"
#include "lab/app/command_line.h"
#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/io/file.h"

#include <errno.h>
#include <sha256.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

// ---- hints ----

int exercise_hint(const char *root, const Exercise *e, const ExerciseOptions *o) {
    Standing standings[EXERCISE_COUNT], *mine = &standings[exercise_index(e)];
    char *text;
    (void)o;
    if (!standing_load(root, standings)) return command_failed();
    Page page = page_for(STDOUT_FILENO, stdout);
    int index = mine->hints < HINT_COUNT ? mine->hints : HINT_COUNT - 1;
    for (int i = 0; i <= index; i++) {
        if (!hints_read(root, e, i, &text)) return command_failed();
        page_markdown(&page, text);
        putchar('\n');
        mem_free(text);
    }
    printf("(hint %d of %d)\n", index + 1, HINT_COUNT);
    mine->hints = index + 1;
    return standing_save(root, standings) ? 0 : command_failed();
}

// ---- reset ----

// The first "cov2.c.before-N" that is free; owned by the caller.
static char *backup_path(const char *source) {
    for (int n = 1;; n++) {
        char *path = mem_format("%s.before-%d", source, n);
        if (!file_exists(path)) return path;
        mem_free(path);
    }
}

int exercise_reset(const char *root, const Exercise *e, const ExerciseOptions *o) {
    char *source = exercise_source(root, e);
    (void)o;
    bool good = true;
    if (file_exists(source)) {
        char *backup = backup_path(source);
        good = rename(source, backup) == 0 || fail("cannot rename %s to %s: %s", source, backup, strerror(errno));
        if (good) printf("Your file is kept as %s\n", backup);
        mem_free(backup);
    }
    good = good && exercise_lay_out(root, e);
    if (good) printf("%s is as at the beginning\n", source);
    mem_free(source);
    return good ? 0 : command_failed();
}

// ---- solution ----

bool exercise_key_check(const char *root, const char *key) {
    char *path = file_join(root, "instructor.sha256"), *wanted = NULL, hex[SHA256_DIGEST_STRING_LENGTH];
    size_t size;
    bool good = file_read(path, &wanted, &size);
    if (!good) fail("no instructor's key is set here; to set one: printf %%s KEY | sha256sum >%s", path);
    SHA256Data((const uint8_t *)key, strlen(key), hex);
    if (good && strncmp(wanted, hex, SHA256_DIGEST_STRING_LENGTH - 1) != 0)
        good = fail("--key: that is not the key of %s", path);
    mem_free(wanted);
    mem_free(path);
    return good;
}

static bool is_open(const char *root, const Exercise *e, const ExerciseOptions *o) {
    Standing standings[EXERCISE_COUNT];
    if (o->key[0]) return exercise_key_check(root, o->key);
    if (!standing_load(root, standings)) return false;
    if (standings[exercise_index(e)].solved) return true;
    return fail("the solution of exercise %d opens when yours has passed; four hints: splatlab exercise hint %d",
                e->number, e->number);
}

int exercise_solution_show(const char *root, const Exercise *e, const ExerciseOptions *o) {
    char *path = exercise_solution(root, e), *text = NULL;
    size_t size;
    bool good = is_open(root, e, o) && file_read(path, &text, &size);
    if (good) fputs(text, stdout);
    mem_free(text);
    mem_free(path);
    return good ? 0 : command_failed();
}
