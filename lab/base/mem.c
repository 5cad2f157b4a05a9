// mem.c - aligned, zeroed memory; the one place that decides what happens when there is none.
#include "lab/base/mem.h"

#include <assert.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

static _Noreturn void out_of_memory(size_t count, size_t size) {
    fprintf(stderr,
            "splatlab: no memory for %zu x %zu bytes; close other programs, or take smaller pictures (--downscale) or "
            "fewer splats (--max-splats)\n",
            count, size);
    exit(1);
}

void *mem_alloc(size_t count, size_t size) {
    size_t bytes;
    if (__builtin_mul_overflow(count, size, &bytes) || bytes > SIZE_MAX - MEM_ALIGN) out_of_memory(count, size);
    // aligned_alloc wants a multiple of the alignment; at least one, so that an empty array has an address too.
    size_t rounded = bytes == 0 ? MEM_ALIGN : (bytes + MEM_ALIGN - 1) / MEM_ALIGN * MEM_ALIGN;
    void *p = aligned_alloc(MEM_ALIGN, rounded);
    if (!p) out_of_memory(count, size);
    memset(p, 0, rounded);
    return p;
}

void *mem_resize(void *p, size_t old_count, size_t new_count, size_t size) {
    void *fresh = mem_alloc(new_count, size);
    size_t kept = old_count < new_count ? old_count : new_count;
    if (p && kept) memcpy(fresh, p, kept * size);
    free(p);
    return fresh;
}

void mem_free(void *p) { free(p); }

char *mem_text(const char *text) {
    size_t bytes = strlen(text) + 1;
    char *copy = mem_alloc(bytes, 1);
    memcpy(copy, text, bytes);
    return copy;
}

char *mem_format(const char *format, ...) {
    assert(format);
    va_list arguments;
    va_start(arguments, format);
    int length = vsnprintf(NULL, 0, format, arguments);
    va_end(arguments);
    if (length < 0) return mem_text("");
    char *text = mem_alloc((size_t)length + 1, 1);
    va_start(arguments, format);
    vsnprintf(text, (size_t)length + 1, format, arguments);
    va_end(arguments);
    return text;
}

size_t mem_peak_bytes(void) {
    struct rusage usage;
    return getrusage(RUSAGE_SELF, &usage) == 0 ? (size_t)usage.ru_maxrss * 1024 : 0; // ru_maxrss counts KiB
}
