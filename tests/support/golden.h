// golden.h - pictures as they were when somebody looked at them and found them good: tests/golden/NAME.png.
#ifndef SPLATLAB_TESTS_SUPPORT_GOLDEN_H
#define SPLATLAB_TESTS_SUPPORT_GOLDEN_H

#include <stdbool.h>

// A golden picture is small: each of its pixels is the mean of GOLDEN_SHRINK x GOLDEN_SHRINK of the picture's.
enum { GOLDEN_SHRINK = 4 };

// The same program gives the same bytes, so these are for another machine's rounding and another release of the fonts: of
// 255, the most that one number may differ, and the mean over all of them. A blob that is moved by one px differs by more.
static const double GOLDEN_MOST = 6, GOLDEN_MEAN = 0.25;

// Is the picture at `path` the golden one? If not, it is said where yours, the expected and their difference (8 times as large)
// were written. With SPLATLAB_GOLDEN=write in the environment the picture becomes the golden one: look at it first.
bool golden_matches(const char *path, const char *name);

// Is the text tests/golden/NAME, to the byte? Likewise.
bool golden_text_matches(const char *text, const char *name);

#endif
