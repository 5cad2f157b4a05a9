// kernels_compile.c - compiles every kernel file of kernels/ on the default device, with warnings as errors.
//
// Prints "kernels/FILE:LINE: what" for each that does not compile, and exits 1 if there is one.
#include "lab/base/fail.h"
#include "lab/gpu/gpu.h"
#include "lab/io/file.h"

#include <stdio.h>
#include <string.h>

// PoCL's log holds lines "error: kernels/FILE:LINE:COLUMN: what"; another driver's log is shown whole.
static void print_log(const char *name, const char *log) {
    const char *line = strstr(log, "error: kernels/");
    if (!line) printf("kernels/%s:1: %s\n", name, log);
    for (; line; line = strstr(line, "error: kernels/")) {
        line += strlen("error: ");
        printf("%.*s\n", (int)strcspn(line, "\n"), line);
    }
}

static bool compiles(Gpu *gpu, const char *name, const char *options) {
    GpuProgram *program = NULL;
    bool good = gpu_program_create(gpu, name, options, &program);
    if (!good) print_log(name, fail_text());
    gpu_program_destroy(program);
    return good;
}

// As a GPU has it; and what a CPU has in lanes, too.
static bool kernel_compiles(Gpu *gpu, const char *name) {
    return compiles(gpu, name, "-Werror") &&
           (strncmp(name, "project_", 8) != 0 || compiles(gpu, name, "-Werror -D LANES=16")) &&
           (strcmp(name, "project_backward.cl") != 0 || compiles(gpu, name, "-Werror -D LANES=16 -D ADAM_STEP"));
}

int main(void) {
    Gpu *gpu = NULL;
    char **names = NULL;
    int count = 0, kernels = 0, broken = 0;

    if (!gpu_open("", &gpu) || !file_list("kernels", &names, &count)) {
        printf("kernels:1: %s\n", fail_text());
        return 1;
    }
    gpu_set_kernel_folder("kernels");
    for (int i = 0; i < count; i++) {
        if (!file_has_ending(names[i], ".cl")) continue;
        kernels++;
        broken += !kernel_compiles(gpu, names[i]);
    }
    fprintf(stderr, "lint: %d kernel files compiled on %s, %d broken\n", kernels, gpu_info(gpu)->name, broken);
    file_list_free(names, count);
    gpu_close(gpu);
    return broken > 0;
}
