// progress.h - one line on stderr that says how far a long work is and when it will be done.
//
// On a terminal the line is rewritten at most ten times a second; elsewhere a plain line is printed at most every ten
// seconds and at the end; with log_set_quiet(true) nothing. Work that ends within half a second prints nothing.
#ifndef SPLATLAB_LAB_BASE_PROGRESS_H
#define SPLATLAB_LAB_BASE_PROGRESS_H

typedef struct {
    const char *what; // "train", "render"; borrowed
    long total;       // units of work
    long start;       // units already done when it began (a resumed run); they do not count for the ETA
    double began_s;   // clock_seconds() at the start
    double printed_s; // when the line was last printed
} Progress;

Progress progress_begin(const char *what, long start, long total);

// done: units done so far. note: what else to show ("loss 0.031  psnr 27.1  12034 splats"), or NULL.
void progress_update(Progress *progress, long done, const char *note);

// Ends the line.
void progress_end(Progress *progress, const char *note);

// For log.c: a line that stands on the terminal gets its newline before a message is printed.
void progress_leave_line(void);

#endif
