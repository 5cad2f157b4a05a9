// font_files.h - where the fonts of the windows are on this machine.
#ifndef SPLATLAB_LAB_APP_FONT_FILES_H
#define SPLATLAB_LAB_APP_FONT_FILES_H

#ifdef __cplusplus
extern "C" {
#endif

// The path of a font file ("DejaVuSans.ttf") in the folders where systems keep it, owned by the caller (mem_free); NULL
// when it is not installed, which is said once.
char *font_file_find(const char *name);

#ifdef __cplusplus
}
#endif
#endif
