// bench_scaling.h - how the cost of the blends grows with the work: crowds of several sizes in pictures of several sizes, by one
// thread and by several.
#ifndef SPLATLAB_LAB_APP_BENCH_SCALING_H
#define SPLATLAB_LAB_APP_BENCH_SCALING_H

#include "splat3d/opencl_rasterizer.h"

#include <jansson.h>
#include <stdbool.h>
#include <stdint.h>

// device, kernels, blend: as the options of these names give them. most_threads: the second thread count, besides 1. *root gets "rows", one for each
// run, and "fits", the laws for each thread count (bench_fit.h).
// Call it before any device is opened: the number of a CPU device's threads is fixed when the first one is, so each count has a process of its own.
bool bench_scaling_run(const char *device, const char *kernels, BlendKernels blend, uint64_t seed, int rounds,
                       int most_threads, json_t **root);
void bench_scaling_print(const json_t *root);

// Sets how many threads the device and the native code use; before a device is opened.
void bench_set_threads(int threads);

#endif
