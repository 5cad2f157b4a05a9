#include "tests/support/support.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

const char *support_data(const char *name) {
    static char path[4096];
    const char *root = getenv("SPLATLAB_DATA");
    if (!root) root = "../shared/data";
    snprintf(path, sizeof path, "%s/%s", root, name);
    if (access(path, R_OK) != 0) {
        print_message("skipped: no %s (set SPLATLAB_DATA to the folder with the shared data)\n", path);
        skip();
    }
    return path;
}

static char scratch[4096];

static void remove_scratch(void) {
    char command[4200];
    snprintf(command, sizeof command, "rm -rf '%s'", scratch);
    if (system(command) != 0) fprintf(stderr, "cannot remove %s\n", scratch);
}

const char *support_scratch(void) {
    if (!scratch[0]) {
        const char *root = getenv("TMPDIR");
        snprintf(scratch, sizeof scratch, "%s/splatlab-test-XXXXXX", root ? root : "/tmp");
        if (!mkdtemp(scratch)) fail_msg("cannot make %s", scratch);
        atexit(remove_scratch);
    }
    return scratch;
}

void support_set_cache(const char *folder) {
    static char first[4096];
    static bool is_known;
    const char *now = getenv("XDG_CACHE_HOME");
    if (!is_known) snprintf(first, sizeof first, "%s", now ? now : "");
    is_known = true;
    if (!folder) folder = first;
    folder[0] ? setenv("XDG_CACHE_HOME", folder, 1) : unsetenv("XDG_CACHE_HOME");
}

const char *support_path(const char *folder, const char *name) {
    static char paths[8][4096];
    static int next;
    char *path = paths[next++ % 8];
    snprintf(path, sizeof paths[0], "%s/%s", folder, name);
    return path;
}

void support_near(double actual, double expected, double tolerance, const char *what) {
    if (!(fabs(actual - expected) <= tolerance))
        fail_msg("%s: %.12g, expected %.12g within %.3g", what, actual, expected, tolerance);
}

double support_relative_l2(const double *a, const double *b, size_t count) {
    double difference = 0, size = 0;
    for (size_t i = 0; i < count; i++) {
        difference += (a[i] - b[i]) * (a[i] - b[i]);
        size += b[i] * b[i];
    }
    return size > 0 ? sqrt(difference / size) : sqrt(difference);
}

double support_cosine(const double *a, const double *b, size_t count) {
    double ab = 0, aa = 0, bb = 0;
    for (size_t i = 0; i < count; i++) {
        ab += a[i] * b[i];
        aa += a[i] * a[i];
        bb += b[i] * b[i];
    }
    return aa > 0 && bb > 0 ? ab / sqrt(aa * bb) : (aa == bb);
}
