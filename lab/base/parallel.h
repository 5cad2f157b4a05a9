// parallel.h - run a function for each index on all cores (POSIX threads), for host work that OpenCL does not do:
// decoding images, tracing sample scenes, nearest neighbours.
//
// The work of one index must not depend on any other, so that results are the same with one thread or many.
#ifndef SPLATLAB_LAB_BASE_PARALLEL_H
#define SPLATLAB_LAB_BASE_PARALLEL_H

#include <stdbool.h>

typedef void ParallelBody(void *context, int index);

// Calls body(context, i) for i = 0..count-1 on up to parallel_threads() threads, indices handed out one by one.
void parallel_for(int count, ParallelBody *body, void *context);

// As parallel_for for work that can fail; the first failure by *index* (not by time) becomes this thread's fail_text().
// Indices after a failed one may be left out.
typedef bool ParallelTask(void *context, int index);
bool parallel_try(int count, ParallelTask *task, void *context);

// How many threads: the machine's cores, or SPLATLAB_THREADS when that is set to 1..256.
int parallel_threads(void);

#endif
