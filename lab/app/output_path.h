// output_path.h - where a result is to be written, checked before long work starts.
#ifndef SPLATLAB_LAB_APP_OUTPUT_PATH_H
#define SPLATLAB_LAB_APP_OUTPUT_PATH_H

#include <stdbool.h>

// Has the path one of the endings (NULL-terminated, with their dots), and can a file be made there? option: "output", named in
// the message. A wrong ending is wrong usage, a folder that cannot be written a failure.
bool output_path_check(const char *option, const char *path, const char *const *endings);

// "out/a.png", 12 -> "out/a_0012.png"; owned by the caller.
char *output_path_numbered(const char *path, int number);

#endif
