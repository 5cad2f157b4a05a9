// support.h - what many tests need: cmocka with its prerequisites, data of others where it is at hand, scratch folders.
#ifndef SPLATLAB_TESTS_SUPPORT_SUPPORT_H
#define SPLATLAB_TESTS_SUPPORT_SUPPORT_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

// The path of a file or folder of the data that others made ($SPLATLAB_DATA, else ../shared/data), in a buffer that the
// next call overwrites; where it is absent, says so and skips the calling test.
const char *support_data(const char *name);

// A fresh empty folder under $TMPDIR; removed with its content when the program ends. Valid for the program's life.
const char *support_scratch(void);

// scratch folder + "/" + name, in one of 8 buffers that rotate.
const char *support_path(const char *folder, const char *name);

// The folder in which programs keep what is compiled ($XDG_CACHE_HOME); NULL: the one that the test was started with.
void support_set_cache(const char *folder);

// Fails the test unless |actual - expected| <= tolerance; prints the three with `what`.
void support_near(double actual, double expected, double tolerance, const char *what);

// |a - b|_2 / |b|_2 of two arrays, and the cosine of the angle between them.
double support_relative_l2(const double *a, const double *b, size_t count);
double support_cosine(const double *a, const double *b, size_t count);

#endif
