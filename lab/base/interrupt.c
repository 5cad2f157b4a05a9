// interrupt.c - SIGINT and SIGTERM set a flag; the second SIGINT means it.
#include "lab/base/interrupt.h"

#include <signal.h>
#include <string.h>
#include <unistd.h>

static volatile sig_atomic_t requested;
static volatile sig_atomic_t interrupts;

enum { EXIT_INTERRUPTED = 128 + SIGINT }; // what a shell reports for a program that SIGINT ended

static void note_signal(int number) {
    requested = 1;
    if (number == SIGINT && ++interrupts >= 2) _exit(EXIT_INTERRUPTED);
}

void interrupt_install(void) {
    requested = 0;
    interrupts = 0;
    struct sigaction action;
    memset(&action, 0, sizeof action);
    action.sa_handler = note_signal;
    action.sa_flags = SA_RESTART; // a file that is being read or written is not disturbed
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
}

bool interrupt_requested(void) { return requested != 0; }
