// parallel.c - threads that take indices from one counter until none is left.
#include "lab/base/parallel.h"

#include "lab/base/fail.h"
#include "lab/base/mem.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <unistd.h>

enum { THREADS_MAX = 256 };

int parallel_threads(void) {
    const char *text = getenv("SPLATLAB_THREADS");
    if (text) {
        char *end;
        long wanted = strtol(text, &end, 10);
        if (end != text && *end == 0 && wanted >= 1 && wanted <= THREADS_MAX) return (int)wanted;
    }
    long cores = sysconf(_SC_NPROCESSORS_ONLN);
    return cores < 1 ? 1 : cores > THREADS_MAX ? THREADS_MAX : (int)cores;
}

typedef struct {
    int count;
    ParallelTask *task;
    void *context;
    atomic_int next;        // the index to be taken next
    atomic_int failed_from; // no index from here on needs to run: a lower one, or this one, failed
    pthread_mutex_t lock;   // guards the two below
    int failed_index;       // lowest index that failed so far, or `count`
    int failed_exit_code;
    char *failed_text; // its message
} Job;

static void note_failure(Job *job, int index) {
    pthread_mutex_lock(&job->lock);
    if (index < job->failed_index) {
        job->failed_index = index;
        job->failed_exit_code = fail_exit_code();
        mem_free(job->failed_text);
        job->failed_text = mem_text(fail_text());
        atomic_store(&job->failed_from, index);
    }
    pthread_mutex_unlock(&job->lock);
}

// Indices are taken in order, so every index below a failed one has been taken before it and is still run to its end:
// the lowest failure is found with any number of threads.
static void *work(void *argument) {
    Job *job = argument;
    for (;;) {
        int index = atomic_fetch_add(&job->next, 1);
        if (index >= job->count || index >= atomic_load(&job->failed_from)) return NULL;
        if (!job->task(job->context, index)) note_failure(job, index);
    }
}

bool parallel_try(int count, ParallelTask *task, void *context) {
    Job job = {.count = count, .task = task, .context = context, .failed_index = count};
    atomic_init(&job.next, 0);
    atomic_init(&job.failed_from, count);
    pthread_mutex_init(&job.lock, NULL);

    int wanted = parallel_threads() < count ? parallel_threads() : count;
    pthread_t threads[THREADS_MAX];
    int started = 0;
    // The calling thread works too. Where no further thread can be had, fewer do.
    while (started < wanted - 1 && pthread_create(&threads[started], NULL, work, &job) == 0) started++;
    work(&job);
    for (int i = 0; i < started; i++) pthread_join(threads[i], NULL);

    pthread_mutex_destroy(&job.lock);
    if (job.failed_index == count) return true;
    if (job.failed_exit_code == 2)
        fail_usage("%s", job.failed_text);
    else
        fail("%s", job.failed_text);
    mem_free(job.failed_text);
    return false;
}

typedef struct {
    ParallelBody *body;
    void *context;
} Body;

static bool run_body(void *context, int index) {
    Body *body = context;
    body->body(body->context, index);
    return true;
}

void parallel_for(int count, ParallelBody *body, void *context) {
    Body wrapped = {body, context};
    parallel_try(count, run_body, &wrapped);
}
