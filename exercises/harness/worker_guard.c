// worker_guard.c - limits, the last words of a crash, and a malloc that remembers what it refused.
#include "exercises/harness/worker_guard.h"

#include "exercises/harness/wire.h"

#include <dlfcn.h>
#include <execinfo.h>
#include <signal.h>
#include <stddef.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <unistd.h>

static uint64_t current_ticket, largest_refused;
static const char *library_start;

void worker_guard_ticket(uint64_t ticket) { current_ticket = ticket; }

void worker_guard_library(const void *address) {
    Dl_info info;
    if (address && dladdr(address, &info)) library_start = info.dli_fbase;
    void *frame[1];
    backtrace(frame, 1); // loads what it needs now: a signal handler must not
}

static void limit(int what, rlim_t value) { setrlimit(what, &(struct rlimit){value, value}); }

void worker_guard_limits(int seconds, int megabytes, int file_megabytes) {
    limit(RLIMIT_CPU, (rlim_t)seconds);
    limit(RLIMIT_AS, (rlim_t)megabytes << 20);
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_FSIZE, (rlim_t)file_megabytes << 20);
}

// ---- signals ----

// The innermost frame that lies in the student's library.
static uint64_t offset_in_library(void) {
    void *frames[32];
    int count = backtrace(frames, 32);
    for (int i = 0; i < count; i++) {
        Dl_info info;
        if (library_start && dladdr(frames[i], &info) && info.dli_fbase == library_start)
            return (uint64_t)((const char *)frames[i] - library_start);
    }
    return 0;
}

static void last_words(int signal_number, siginfo_t *info, void *context) {
    (void)context;
    static WireAnswer head;
    head.ticket = current_ticket;
    head.outcome = ANSWER_CRASHED;
    head.signal = signal_number;
    head.address = (uint64_t)(uintptr_t)info->si_addr;
    head.refused_bytes = largest_refused;
    head.offset = offset_in_library();
    ssize_t sent = write(WIRE_FD, &head, sizeof head);
    _exit(sent == (ssize_t)sizeof head ? 1 : 2);
}

void worker_guard_signals(void) {
    static char stack[1 << 16]; // of its own: the other one may be what overflowed
    sigaltstack(&(stack_t){.ss_sp = stack, .ss_size = sizeof stack}, NULL);
    const int caught[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};
    for (size_t i = 0; i < sizeof caught / sizeof *caught; i++)
        sigaction(caught[i], &(struct sigaction){.sa_sigaction = last_words, .sa_flags = SA_SIGINFO | SA_ONSTACK},
                  NULL);
}

// ---- malloc: glibc's own, which the library finds here first ----

extern void *__libc_malloc(size_t size);
extern void *__libc_calloc(size_t count, size_t size);
extern void *__libc_realloc(void *old, size_t size);

static void *noted(void *p, size_t size) {
    if (!p && size > largest_refused) largest_refused = size;
    return p;
}

void *malloc(size_t size) { return noted(__libc_malloc(size), size); }
void *calloc(size_t count, size_t size) { return noted(__libc_calloc(count, size), count * size); }
void *realloc(void *old, size_t size) { return noted(__libc_realloc(old, size), size); }
