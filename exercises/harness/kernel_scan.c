// kernel_scan.c - words, braces and comments of OpenCL C; enough to know in which function a word stands.
#include "exercises/harness/kernel_scan.h"

#include <ctype.h>
#include <stddef.h>
#include <string.h>

enum { WORD_BYTES = 64 };

typedef struct {
    const char *at;
    int line, depth;            // of braces
    char before[WORD_BYTES];    // the last word in front of a '(' outside of functions
    char function[WORD_BYTES];  // in which we are
    bool saw_kernel, is_kernel; // the word stood before this function; this function is one
} Scan;

static void take_word(Scan *s, char word[WORD_BYTES]) {
    size_t length = 0;
    for (; isalnum((unsigned char)*s->at) || *s->at == '_'; s->at++)
        if (length + 1 < WORD_BYTES) word[length++] = *s->at;
    word[length] = 0;
}

static void skip_comment(Scan *s) {
    bool is_line = s->at[1] == '/';
    for (s->at += 2; *s->at; s->at++) {
        if (is_line && *s->at == '\n') return;
        if (*s->at == '\n') s->line++;
        if (!is_line && s->at[0] == '*' && s->at[1] == '/') {
            s->at += 2;
            return;
        }
    }
}

static void take_sign(Scan *s) {
    char c = *s->at++;
    if (c == '\n') s->line++;
    if (c == '{' && s->depth++ == 0) {
        memcpy(s->function, s->before, sizeof s->function);
        s->is_kernel = s->saw_kernel;
    }
    if (c == '}' && s->depth > 0) s->depth--;
    if (s->depth == 0 && (c == '}' || c == ';')) s->saw_kernel = false;
}

bool kernel_scan_not_started(const char *text, const char *kernel, int *line) {
    Scan s = {.at = text, .line = 1};
    while (*s.at) {
        if (s.at[0] == '/' && (s.at[1] == '/' || s.at[1] == '*')) {
            skip_comment(&s);
        } else if (isalpha((unsigned char)*s.at) || *s.at == '_') {
            char word[WORD_BYTES];
            take_word(&s, word);
            if (strcmp(word, "kernel") == 0 || strcmp(word, "__kernel") == 0) s.saw_kernel = true;
            if (s.depth == 0 && s.at[strspn(s.at, " \n")] == '(') memcpy(s.before, word, sizeof word);
            *line = s.line;
            if (s.depth > 0 && strcmp(word, "NOT_STARTED") == 0 && (!s.is_kernel || strcmp(s.function, kernel) == 0))
                return true;
        } else {
            take_sign(&s);
        }
    }
    return false;
}
