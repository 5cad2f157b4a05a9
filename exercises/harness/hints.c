// hints.c - cuts hints.md at its headings.
#include "exercises/harness/hints.h"

#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/io/file.h"

#include <string.h>

static const char HEADING[] = "\n## ";

bool hints_read(const char *root, const Exercise *exercise, int index, char **text) {
    char *path = exercise_path(root, exercise, "hints.md"), *content = NULL;
    size_t size;
    *text = NULL;
    bool good = file_read(path, &content, &size);
    int count = 0;
    for (char *from = good ? strstr(content, HEADING) : NULL; from; count++) {
        char *next = strstr(from + 1, HEADING);
        if (count == index)
            *text = mem_format("%.*s", (int)(next ? next - from - 1 : (long)strlen(from + 1)), from + 1);
        from = next;
    }
    if (good && count != HINT_COUNT) {
        good = fail("%s has %d hints, want %d sections that begin with '## '", path, count, HINT_COUNT);
        mem_free(*text);
        *text = NULL;
    }
    mem_free(content);
    mem_free(path);
    return good;
}
