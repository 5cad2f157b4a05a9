// worker_number.h - numbers in the memory that a student's code sees: set, marked as unwritten, as a guard, and read back.
#ifndef SPLATLAB_EXERCISES_HARNESS_WORKER_NUMBER_H
#define SPLATLAB_EXERCISES_HARNESS_WORKER_NUMBER_H

#include <stdbool.h>
#include <stddef.h>

typedef enum { NUMBER_FLOAT, NUMBER_DOUBLE, NUMBER_INT } NumberType;

size_t number_bytes(NumberType type);

// Number `index` of the array `at`: the value, or the guard word, which nobody computes.
void number_set(void *at, size_t index, NumberType type, double value, bool is_guard);

void number_poison(void *at, size_t index, NumberType type); // nobody has written it yet

// WIRE_UNWRITTEN where it is still poisoned.
double number_get(const void *at, size_t index, NumberType type);

// Are its bytes those that number_set() would write?
bool number_is(const void *at, size_t index, NumberType type, double value, bool is_guard);

#endif
