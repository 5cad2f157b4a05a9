// worker_guard.h - what happens to code that crashes or asks for too much, inside the worker.
#ifndef SPLATLAB_EXERCISES_HARNESS_WORKER_GUARD_H
#define SPLATLAB_EXERCISES_HARNESS_WORKER_GUARD_H

#include <stdbool.h>
#include <stdint.h>

// Processor time and address space of this process, and the size of a file that it writes; no core files.
void worker_guard_limits(int seconds, int megabytes, int file_megabytes);

// From now on SIGSEGV, SIGBUS, SIGFPE, SIGILL and SIGABRT answer the current request with ANSWER_CRASHED and the place, then
// end the process.
void worker_guard_signals(void);

// Any address in the student's library: places are told from its start. NULL: there is none.
void worker_guard_library(const void *address);

// The request that is being worked on.
void worker_guard_ticket(uint64_t ticket);

#endif
