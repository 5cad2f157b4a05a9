// worker_fence.h - what a student's code cannot do from inside the worker: start or signal processes, write files, use the network.
//
// It has the rights of the person who runs it. Without a fence it could kill the judge, or write tolerances, progress and the
// answers of others into the exercises' folder. The kernel's system call filter (seccomp) refuses that; where there is none, the
// worker runs without.
#ifndef SPLATLAB_EXERCISES_HARNESS_WORKER_FENCE_H
#define SPLATLAB_EXERCISES_HARNESS_WORKER_FENCE_H

#include <stdbool.h>

// From now on, for good. False when this kernel has no such filter.
bool worker_fence_raise(void);

#endif
