// png_check.h - is a PNG file whole? Asked before decoding, because libpng reports damage past us, on stderr.
#ifndef SPLATLAB_LAB_IO_PNG_CHECK_H
#define SPLATLAB_LAB_IO_PNG_CHECK_H

#include <stdbool.h>

// Walks the chunks to the end mark and compares their check sums. A file that does not begin as a PNG passes:
// it is for the decoder to say what it is.
bool png_check(const char *path);

#endif
