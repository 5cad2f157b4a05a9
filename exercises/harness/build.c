// build.c - the compiler as a child process; results lie in the cache folder under the hash of all they were made from.
#include "exercises/harness/build.h"

#include "exercises/harness/worker_process.h"
#include "lab/base/cache_path.h"
#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/base/parallel.h"
#include "lab/io/file.h"

#include <errno.h>
#include <fcntl.h>
#include <sha256.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

extern char **environ;

const char *const PRECISION_NAMES[PRECISION_COUNT] = {"float", "double"};

enum { KEEP_DAYS = 3, FLAG_COUNT = 9 };
static const char *const FLAGS[FLAG_COUNT] = {
    "-std=c17", "-O1", "-g", "-fPIC", "-shared", "-Wall", "-Wextra", "-D_GNU_SOURCE", "-ffp-contract=off"};

// Where compiled exercises are kept, made when it is not there; owned by the caller.
static bool cache_folder(char **folder) {
    const char *scratch = getenv("TMPDIR");
    *folder = cache_path("exercises");
    if (!*folder)
        *folder = mem_format("%s/splatlab-%u/exercises", scratch && scratch[0] ? scratch : "/tmp", (unsigned)getuid());
    if (file_make_folder(*folder) && file_can_write_in(*folder)) return true;
    mem_free(*folder);
    *folder = NULL;
    return fail_context("compiled exercises are kept there; set XDG_CACHE_HOME to a folder that can be written");
}

// What was built of texts that have long changed.
static void remove_old(const char *folder) {
    char **names;
    int count;
    if (!file_list(folder, &names, &count)) return;
    for (int i = 0; i < count; i++) {
        char *path = file_join(folder, names[i]);
        struct stat entry;
        if (stat(path, &entry) == 0 && time(NULL) - entry.st_mtime > KEEP_DAYS * 86400) unlink(path);
        mem_free(path);
    }
    file_list_free(names, count);
}

static bool hash_file(SHA2_CTX *hash, const char *path) {
    char *text;
    size_t size;
    if (!file_read(path, &text, &size)) return false;
    SHA256Update(hash, (const uint8_t *)text, size + 1);
    mem_free(text);
    return true;
}

static bool hash_folder(SHA2_CTX *hash, const char *folder, const char *ending) {
    char **names;
    int count;
    if (!file_list(folder, &names, &count)) return false;
    bool good = true;
    for (int i = 0; good && i < count; i++) {
        char *path = file_join(folder, names[i]);
        good = !file_has_ending(names[i], ending) || hash_file(hash, path);
        mem_free(path);
    }
    file_list_free(names, count);
    return good;
}

// ---- what it is made from ----

static bool is_kernel(const BuildJob *job) { return file_has_ending(job->source, ".cl"); }

// What an answer includes of the exercises, such as one's own answer to an earlier one. A file that is not there is left to the
// compiler's message.
static bool hash_included(SHA2_CTX *hash, const BuildJob *job) {
    static const char BEGIN[] = "#include \"";
    char *text, *name;
    size_t size;
    if (!file_read(job->source, &text, &size)) return false;
    bool good = true;
    for (name = text; good && (name = strstr(name, BEGIN));) {
        name += strlen(BEGIN);
        char *path = mem_format("%s/../%.*s", job->root, (int)strcspn(name, "\"\n"), name);
        if (file_exists(path)) good = hash_file(hash, path);
        mem_free(path);
    }
    mem_free(text);
    return good;
}

// Everything that the result depends on: the texts (wrong variants include our solutions), the compiler and its flags.
static bool job_hash(const BuildJob *job, const char *compiler, char hex[SHA256_DIGEST_STRING_LENGTH]) {
    SHA2_CTX hash;
    SHA256Init(&hash);
    char *head = file_join(job->root, is_kernel(job) ? "kernel_layer.cl" : "exercise.h"),
         *calls = file_join(job->root, "calls.h"), *solutions = file_join(job->root, "solutions"),
         *beside = file_folder_of(job->calls);
    bool good = hash_file(&hash, job->source) && hash_file(&hash, head);
    if (!is_kernel(job))
        good = good && hash_file(&hash, job->calls) && hash_file(&hash, calls) && hash_included(&hash, job) &&
               hash_folder(&hash, solutions, ".c") && hash_folder(&hash, beside, ".h");
    char *how = mem_format("%s %s %s", compiler, PRECISION_NAMES[job->precision], job->source);
    SHA256Update(&hash, (const uint8_t *)how, strlen(how));
    for (int i = 0; i < FLAG_COUNT; i++) SHA256Update(&hash, (const uint8_t *)FLAGS[i], strlen(FLAGS[i]) + 1);
    mem_free(how);
    mem_free(head);
    mem_free(calls);
    mem_free(solutions);
    mem_free(beside);
    SHA256End(&hash, hex);
    return good;
}

// ---- the compilers ----

// Runs a program; what it prints goes to `printed`, its exit code (-1: a signal) to *code. False when it cannot be started.
static bool run_program(const char *const *argv, const char *printed, int *code) {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, 1, printed, O_WRONLY | O_CREAT | O_TRUNC, 0600);
    posix_spawn_file_actions_adddup2(&actions, 1, 2);
    pid_t child;
    int error = posix_spawnp(&child, argv[0], &actions, NULL, (char *const *)argv, environ), status = 0;
    posix_spawn_file_actions_destroy(&actions);
    if (error) return fail("%s", strerror(error));
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
    *code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return true;
}

static bool compile_c(const BuildJob *job, const char *compiler, const char *library, const char *printed, bool *made) {
    char *parent = file_join(job->root, ".."), *real = mem_format("-DREAL=%s", PRECISION_NAMES[job->precision]);
    const char *argv[FLAG_COUNT + 10] = {compiler};
    int n = 1, code;
    for (int i = 0; i < FLAG_COUNT; i++) argv[n++] = FLAGS[i];
    const char *more[] = {real, "-I", parent, job->source, job->calls, "-o", library, "-lm"};
    for (size_t i = 0; i < sizeof more / sizeof *more; i++) argv[n++] = more[i];
    bool good = run_program(argv, printed, &code);
    mem_free(parent);
    mem_free(real);
    if (!good) return fail_context("cannot start the C compiler '%s'; install gcc, or set CC to a compiler", compiler);
    *made = code == 0;
    return true;
}

// The text that OpenCL gets, behind marks that keep the person's file and lines.
static bool write_kernels(const BuildJob *job, const char *path) {
    char *layer_path = file_join(job->root, "kernel_layer.cl"), *layer = NULL, *own = NULL;
    size_t size;
    bool good = file_read(layer_path, &layer, &size) && file_read(job->source, &own, &size);
    if (good) {
        char *text = mem_format("#define REAL %s\n#line 1 \"kernel_layer.cl\"\n%s\n#line 1 \"%s\"\n%s",
                                PRECISION_NAMES[job->precision], layer, job->source, own);
        good = file_write(path, text, strlen(text));
        mem_free(text);
    }
    mem_free(layer_path);
    mem_free(layer);
    mem_free(own);
    return good;
}

// The result is the text itself; the worker only looks whether it compiles.
static bool compile_kernels(const BuildJob *job, const char *library, const char *printed, bool *made) {
    char *worker, *said;
    size_t size;
    int code;
    if (!worker_program_find(true, &worker)) return false;
    const char *argv[] = {worker, "check", library, NULL};
    bool good = write_kernels(job, library) && run_program(argv, printed, &code);
    *made = good && code == 0;
    if (good && code != 0 && code != 1) {
        good = file_read(printed, &said, &size);
        if (good) {
            good = fail("cannot compile kernels: %s", said);
            mem_free(said);
        }
    }
    mem_free(worker);
    return good;
}

// The library at `path` and the compiler's words beside it, made anew unless both are there.
static bool make(BuildJob *job, const char *compiler, const char *path) {
    const char *ending = is_kernel(job) ? ".cl" : ""; // OpenCL's worker goes by it
    char *words = mem_format("%s.txt", path), *temporary = mem_format("%s.tmp-%d%s", path, (int)getpid(), ending),
         *printed = mem_format("%s.txt.tmp-%d", path, (int)getpid());
    bool made = file_exists(path), good = true;
    size_t size;
    if (!made) {
        good = is_kernel(job) ? compile_kernels(job, temporary, printed, &made)
                              : compile_c(job, compiler, temporary, printed, &made);
        if (good) rename(printed, words); // first: who finds the library finds the words too
        if (good && made) made = rename(temporary, path) == 0;
    }
    if (good && !file_read(words, &job->diagnostics, &size)) job->diagnostics = mem_text("");
    if (good && made) job->object = mem_text(path);
    unlink(temporary);
    unlink(printed);
    mem_free(words);
    mem_free(temporary);
    mem_free(printed);
    return good;
}

typedef struct {
    BuildJob *jobs;
    const char *folder, *compiler;
} BuildAll;

static bool build_one(void *context, int index) {
    BuildAll *all = context;
    BuildJob *job = &all->jobs[index];
    char hex[SHA256_DIGEST_STRING_LENGTH];
    if (!job_hash(job, all->compiler, hex)) return false;
    char *path = mem_format("%s/%.32s.%s", all->folder, hex, is_kernel(job) ? "cl" : "so");
    bool good = make(job, all->compiler, path);
    mem_free(path);
    return good;
}

bool build_all(BuildJob *jobs, int count) {
    const char *compiler = getenv("CC");
    BuildAll all = {.jobs = jobs, .compiler = compiler && compiler[0] ? compiler : "cc"};
    char *folder;
    if (!cache_folder(&folder)) return false;
    all.folder = folder;
    remove_old(folder);
    bool good = parallel_try(count, build_one, &all);
    mem_free(folder);
    return good;
}

void build_free(BuildJob *job) {
    mem_free(job->object);
    mem_free(job->diagnostics);
    *job = (BuildJob){0};
}
