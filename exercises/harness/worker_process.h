// worker_process.h - starting and ending the worker program, and hearing from it with a time limit.
#ifndef SPLATLAB_EXERCISES_HARNESS_WORKER_PROCESS_H
#define SPLATLAB_EXERCISES_HARNESS_WORKER_PROCESS_H

#include <stdbool.h>
#include <stddef.h>
#include <sys/types.h>

// What a worker may use.
enum {
    WORKER_CALL_MS = 2000,        // for one request
    WORKER_KERNEL_MS = 3000,      // of kernels: OpenCL compiles at the first one
    WORKER_OCLGRIND_MS = 20000,   // under Oclgrind
    WORKER_WAKE_MS = 30000,       // until a worker for kernels has compiled them
    WORKER_CPU_SECONDS = 30,      // of one worker's life
    WORKER_MEGABYTES = 1024,      // address space
    WORKER_PRINTED_MAX = 1 << 20, // bytes on stdout and stderr together
    WORKER_PRINTED_KEPT = 4096,
};

typedef struct {
    pid_t pid; // 0: none
    int socket, output;
    double until_s, hard_until_s, cpu_until_s; // of worker_process_grant()
    size_t printed_bytes;
    char printed[WORKER_PRINTED_KEPT + 1]; // the beginning of it
} WorkerProcess;

// program arguments...: as execv() takes them, NULL at the end. Fails with a message when it cannot be started.
bool worker_process_start(WorkerProcess *worker, const char *const *argv);

// Ends it, and everything it has started; returns its wait status. Accepts one that is not running (0).
int worker_process_stop(WorkerProcess *worker);

typedef enum { HEARD, HEARD_END, HEARD_TIMEOUT, HEARD_FLOOD } Heard;

// So many seconds for what is sent and received from now on. On a busy machine they count as processor time, as long as they are
// not over three times by the clock: code must not fail because others compute, too.
void worker_process_grant(WorkerProcess *worker, double seconds);

// Sends all bytes, reading meanwhile what the worker prints.
Heard worker_process_send(WorkerProcess *worker, const void *data, size_t size);
Heard worker_process_receive(WorkerProcess *worker, void *data, size_t size);

// The path of the worker program (for kernels: splatlab-kernel-worker), owned by the caller: in $SPLATLAB_WORKERS, beside this program, in its build folder, or where it
// was installed. False with a message that names them.
bool worker_program_find(bool for_kernels, char **path);

#endif
