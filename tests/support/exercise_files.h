// exercise_files.h - a copy of the exercises in the scratch folder, in which a test can write answers and progress.
#ifndef SPLATLAB_TESTS_SUPPORT_EXERCISE_FILES_H
#define SPLATLAB_TESTS_SUPPORT_EXERCISE_FILES_H

// Its path, made anew as at the beginning, without anybody's answers; the program and the harness find it and the workers
// ($BUILD).
const char *exercise_files_fresh(void);

// Writes folder/name in it: ("01_cov2/cov2.c", text).
void exercise_files_write(const char *name, const char *text);
void exercise_files_copy(const char *from, const char *to); // within it: a solution as an answer

// The content of one of its files, valid until the next call; fails the test where there is none.
const char *exercise_files_text(const char *name);

#endif
