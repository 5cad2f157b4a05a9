// worker_number.c - the bytes of each type of number, of its guard word, and of its poison.
#include "exercises/harness/worker_number.h"

#include "exercises/harness/wire.h"

#include <string.h>

static const float GUARD_FLOAT = -7.1234567e33f;
static const double GUARD_DOUBLE = -7.123456789012345e303;
static const int32_t GUARD_INT = -2023406815;

static const uint32_t POISON_FLOAT = 0x7fc0beefU;
static const int32_t POISON_INT = -2147401265;

size_t number_bytes(NumberType type) { return type == NUMBER_DOUBLE ? 8 : 4; }

void number_set(void *at, size_t index, NumberType type, double value, bool is_guard) {
    switch (type) {
    case NUMBER_FLOAT:
        ((float *)at)[index] = is_guard ? GUARD_FLOAT : (float)value;
        break;
    case NUMBER_DOUBLE:
        ((double *)at)[index] = is_guard ? GUARD_DOUBLE : value;
        break;
    case NUMBER_INT:
        ((int32_t *)at)[index] = is_guard ? GUARD_INT : (int32_t)value;
    }
}

static const void *poison_of(NumberType type) {
    if (type == NUMBER_DOUBLE) return &WIRE_UNWRITTEN;
    return type == NUMBER_FLOAT ? (const void *)&POISON_FLOAT : (const void *)&POISON_INT;
}

void number_poison(void *at, size_t index, NumberType type) {
    memcpy((char *)at + index * number_bytes(type), poison_of(type), number_bytes(type));
}

double number_get(const void *at, size_t index, NumberType type) {
    double unwritten;
    memcpy(&unwritten, &WIRE_UNWRITTEN, sizeof unwritten);
    if (memcmp((const char *)at + index * number_bytes(type), poison_of(type), number_bytes(type)) == 0)
        return unwritten;
    if (type == NUMBER_DOUBLE) return ((const double *)at)[index];
    return type == NUMBER_FLOAT ? (double)((const float *)at)[index] : (double)((const int32_t *)at)[index];
}

bool number_is(const void *at, size_t index, NumberType type, double value, bool is_guard) {
    double wanted[1];
    number_set(wanted, 0, type, value, is_guard);
    return memcmp((const char *)at + index * number_bytes(type), wanted, number_bytes(type)) == 0;
}
