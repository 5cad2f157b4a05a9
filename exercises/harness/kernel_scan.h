// kernel_scan.h - finds NOT_STARTED in the text of kernels: no kernel can stop by itself and say where.
#ifndef SPLATLAB_EXERCISES_HARNESS_KERNEL_SCAN_H
#define SPLATLAB_EXERCISES_HARNESS_KERNEL_SCAN_H

#include <stdbool.h>

// Does NOT_STARTED stand in that kernel, or in a function that is none (and that the kernel may call)? *line: of the first, from 1.
bool kernel_scan_not_started(const char *text, const char *kernel, int *line);

#endif
