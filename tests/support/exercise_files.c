#include "tests/support/exercise_files.h"

#include "lab/base/mem.h"
#include "lab/io/file.h"
#include "tests/support/support.h"

#include <stdlib.h>
#include <string.h>

static char root[4096];

const char *exercise_files_fresh(void) {
    const char *build = getenv("BUILD");
    snprintf(root, sizeof root, "%s/exercises", support_scratch());
    char *command =
        mem_format("rm -rf '%s' && cp -r exercises '%s' && cd '%s' && rm -f progress.json instructor.sha256 "
                   "*/*.before-* */*.png && for f in */stub.*; do d=${f%%/*}; rm -f $d/${d#*_}.*; done",
                   root, root, root);
    assert_int_equal(system(command), 0);
    mem_free(command);
    setenv("SPLATLAB_EXERCISES", root, 1);
    setenv("SPLATLAB_WORKERS", build ? build : "build/release", 1);
    return root;
}

void exercise_files_write(const char *name, const char *text) {
    char *path = file_join(root, name);
    assert_true(file_write(path, text, strlen(text)));
    mem_free(path);
}

const char *exercise_files_text(const char *name) {
    static char *text;
    size_t size;
    char *path = file_join(root, name);
    mem_free(text);
    text = NULL;
    if (!file_read(path, &text, &size)) fail_msg("there is no %s", path);
    mem_free(path);
    return text;
}

void exercise_files_copy(const char *from, const char *to) { exercise_files_write(to, exercise_files_text(from)); }
