// report.h - how a verdict speaks: to a person, and as JSON.
#ifndef SPLATLAB_EXERCISES_HARNESS_REPORT_H
#define SPLATLAB_EXERCISES_HARNESS_REPORT_H

#include "exercises/harness/page.h"
#include "exercises/harness/verdict.h"

#include <jansson.h>

// In this order: what was asked, the smallest failing case, yours against expected with error and tolerance, what is right already,
// the mistake it looks like, and one next action.
void report_text(const char *root, const Verdict *verdict, const Page *page);

// passed, rungs[{name claim passed ran expected actual error tolerance suspicion seed ...}]; owned by the caller.
json_t *report_json(const char *root, const Verdict *verdict);

#endif
