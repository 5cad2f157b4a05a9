// oclgrind_report.h - what Oclgrind has written about a kernel, as one sentence.
#ifndef SPLATLAB_EXERCISES_HARNESS_OCLGRIND_REPORT_H
#define SPLATLAB_EXERCISES_HARNESS_OCLGRIND_REPORT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

// Reads the rest of the log: "Read-write data race, work-items (2,0,0) and (3,0,0), line 10 of adam.cl". False when there is
// nothing new in it.
bool oclgrind_report_read(FILE *log, char *text, size_t size);

#endif
