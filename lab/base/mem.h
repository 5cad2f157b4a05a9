// mem.h - memory that is there or the program ends: one clear message, exit code 1, nothing half-written.
//
// Sizes of what a file asks for are checked against the file before they come here.
#ifndef SPLATLAB_LAB_BASE_MEM_H
#define SPLATLAB_LAB_BASE_MEM_H

#include <stddef.h>

enum { MEM_ALIGN = 128 }; // bytes; a cache line pair, and what OpenCL wants of a host pointer

// Zeroed, aligned to MEM_ALIGN. count * size may be 0 (a valid pointer results). Never returns NULL.
void *mem_alloc(size_t count, size_t size);

// Grows or shrinks to new_count elements; the added part is zeroed. p may be NULL with old_count 0.
void *mem_resize(void *p, size_t old_count, size_t new_count, size_t size);

// Accepts NULL.
void mem_free(void *p);

// A copy of the text, to be freed with mem_free(); printf style for the second.
char *mem_text(const char *text);
char *mem_format(const char *format, ...) __attribute__((format(printf, 1, 2)));

// Largest resident set of this process so far, in bytes (getrusage).
size_t mem_peak_bytes(void);

#endif
