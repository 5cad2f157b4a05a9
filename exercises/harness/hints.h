// hints.h - the hints of an exercise: hints.md, one section ("## ...") each, from a question to the line.
#ifndef SPLATLAB_EXERCISES_HARNESS_HINTS_H
#define SPLATLAB_EXERCISES_HARNESS_HINTS_H

#include "exercises/harness/catalogue.h"

enum { HINT_COUNT = 4 }; // a question, the formula, where to look, the line

// The text of hint `index` (0..3), owned by the caller. False with a message when the file does not have four.
bool hints_read(const char *root, const Exercise *exercise, int index, char **text);

#endif
