// catalogue.c - the list of exercises, and their folders.
#include "exercises/harness/catalogue.h"

#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/io/file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

extern const Exercise EXERCISE_COV2, EXERCISE_CONIC, EXERCISE_PSD, EXERCISE_COMPOSITE, EXERCISE_POPPING, EXERCISE_NERF,
    EXERCISE_QUAT, EXERCISE_COV3, EXERCISE_CAMERA, EXERCISE_EWA, EXERCISE_EWA_ERROR, EXERCISE_SH, EXERCISE_ADAM;

const Exercise *const EXERCISES[EXERCISE_COUNT] = {
    &EXERCISE_COV2,      &EXERCISE_CONIC, &EXERCISE_PSD,  &EXERCISE_COMPOSITE, &EXERCISE_POPPING,
    &EXERCISE_NERF,      &EXERCISE_QUAT,  &EXERCISE_COV3, &EXERCISE_CAMERA,    &EXERCISE_EWA,
    &EXERCISE_EWA_ERROR, &EXERCISE_SH,    &EXERCISE_ADAM};

static char *folder_name(const Exercise *e) { return mem_format("%02d_%s", e->number, e->name); }

static bool is_called(const Exercise *e, const char *text) {
    char *folder = folder_name(e), *end;
    bool same = strcmp(text, e->name) == 0 || strcmp(text, folder) == 0;
    mem_free(folder);
    const char *digits = text[0] == 'E' || text[0] == 'e' ? text + 1 : text;
    long number = strtol(digits, &end, 10);
    return same || (end != digits && !*end && number == e->number);
}

bool exercise_find(const char *text, const Exercise **exercise) {
    for (int i = 0; i < EXERCISE_COUNT; i++) {
        *exercise = EXERCISES[i];
        if (is_called(*exercise, text)) return true;
    }
    return fail_usage("there is no exercise '%s'; `splatlab exercise` lists them, by number and name", text);
}

bool exercises_root(char **root) {
    char program[4096];
    ssize_t length = readlink("/proc/self/exe", program, sizeof program - 1);
    program[length > 0 ? length : 0] = 0;
    char *slash = strrchr(program, '/');
    if (slash) *slash = 0;
    const char *set = getenv("SPLATLAB_EXERCISES");
    char *places[] = {mem_text(set ? set : ""), mem_text("exercises"), mem_format("%s/exercises", program),
                      mem_text(SPLATLAB_INSTALLED_KERNELS "/../exercises")};
    enum { PLACES = sizeof places / sizeof *places, INSTALLED = PLACES - 1 };
    *root = NULL;
    for (int i = 0; i < PLACES && !*root; i++) {
        char *page = mem_format("%s/exercise.h", places[i]);
        char *plain = places[i][0] && file_exists(page) ? realpath(places[i], NULL) : NULL;
        if (plain) *root = mem_text(i == INSTALLED ? plain : places[i]); // without the ".." of where kernels are
        free(plain);
        mem_free(page);
    }
    if (!*root)
        fail("cannot find the folder of the exercises in %s, %s or %s; set SPLATLAB_EXERCISES to it", places[1],
             places[2], places[3]);
    for (int i = 0; i < PLACES; i++) mem_free(places[i]);
    return *root != NULL;
}

char *exercise_path(const char *root, const Exercise *e, const char *file) {
    char *folder = folder_name(e), *path = mem_format("%s/%s/%s", root, folder, file);
    mem_free(folder);
    return path;
}

static const char *ending(const Exercise *e) { return e->is_kernel ? ".cl" : ".c"; }

char *exercise_file_name(const Exercise *e) { return mem_format("%s%s", e->name, ending(e)); }

char *exercise_stub(const char *root, const Exercise *e) {
    return exercise_path(root, e, e->is_kernel ? "stub.cl" : "stub.c");
}

char *exercise_source(const char *root, const Exercise *e) {
    char *file = exercise_file_name(e), *path = exercise_path(root, e, file);
    mem_free(file);
    return path;
}

char *exercise_solution(const char *root, const Exercise *e) {
    char *file = exercise_file_name(e), *path = mem_format("%s/solutions/%s", root, file);
    mem_free(file);
    return path;
}

bool exercise_lay_out(const char *root, const Exercise *e) {
    char *source = exercise_source(root, e), *stub = exercise_stub(root, e), *text = NULL;
    size_t size;
    bool good = file_exists(source) || (file_read(stub, &text, &size) && file_write(source, text, size));
    if (!good)
        fail_context("your file of exercise %d cannot be laid out; to work elsewhere, copy the folder %s there",
                     e->number, root);
    mem_free(text);
    mem_free(source);
    mem_free(stub);
    return good;
}

bool exercise_mutants(const char *root, const Exercise *e, char ***paths, int *count) {
    char *folder = exercise_path(root, e, "mutants");
    bool good = file_list(folder, paths, count);
    int kept = 0;
    for (int i = 0; good && i < *count; i++) {
        char *name = (*paths)[i];
        if (file_has_ending(name, ending(e))) (*paths)[kept++] = file_join(folder, name);
        mem_free(name);
    }
    if (good) *count = kept;
    mem_free(folder);
    return good;
}
