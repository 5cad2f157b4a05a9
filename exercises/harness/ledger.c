// ledger.c - one line a claim: "01_cov2 matrix float 1.1e-07 double 2.2e-16".
#include "exercises/harness/ledger.h"

#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/io/file.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double FACTOR = 10, LAST_PLACES = 64;

int exercise_index(const Exercise *exercise) {
    int i = 0;
    while (EXERCISES[i] != exercise) i++;
    return i;
}

double ledger_tolerance(double own_error, Precision precision) {
    if (own_error < 0) return INFINITY;
    return fmax(FACTOR * own_error, LAST_PLACES * (precision == PRECISION_FLOAT ? FLT_EPSILON : DBL_EPSILON));
}

bool ledger_agrees(double own_error, double measured, Precision precision) {
    double smallest = ledger_tolerance(0, precision);
    if (FACTOR * own_error <= smallest && FACTOR * measured <= smallest) return true;
    return own_error <= FACTOR * measured && measured <= FACTOR * own_error;
}

void ledger_clear(Ledger *ledger) {
    for (int e = 0; e < EXERCISE_COUNT; e++)
        for (int r = 0; r < RUNGS_MAX; r++)
            for (int p = 0; p < PRECISION_COUNT; p++) ledger->own_error[e][r][p] = -1;
}

static bool take_line(const char *line, Ledger *ledger) {
    char name[64], rung[64];
    double error[PRECISION_COUNT];
    int number;
    if (sscanf(line, "%d_%63s %63s float %lf double %lf", &number, name, rung, &error[0], &error[1]) != 5) return false;
    for (int e = 0; e < EXERCISE_COUNT; e++)
        for (int r = 0; r < EXERCISES[e]->rung_count; r++)
            if (strcmp(EXERCISES[e]->name, name) == 0 && strcmp(EXERCISES[e]->rungs[r].name, rung) == 0)
                memcpy(ledger->own_error[e][r], error, sizeof error);
    return true;
}

static bool is_complete(const Ledger *ledger, const char *path) {
    for (int e = 0; e < EXERCISE_COUNT; e++)
        for (int r = 0; r < EXERCISES[e]->rung_count; r++)
            if (ledger->own_error[e][r][PRECISION_DOUBLE] < 0)
                return fail("%s has no line for %02d_%s %s; run `splatlab exercise selftest --write-ledger`", path,
                            EXERCISES[e]->number, EXERCISES[e]->name, EXERCISES[e]->rungs[r].name);
    return true;
}

bool ledger_load(const char *root, Ledger *ledger) {
    char *path = file_join(root, "ledger.txt"), *text = NULL;
    size_t size;
    ledger_clear(ledger);
    bool good = file_read(path, &text, &size);
    int number = 0;
    for (char *line = text, *end; good && line && *line; line = end) {
        end = line + strcspn(line, "\n");
        if (*end) *end++ = 0;
        number++;
        if (line[0] && line[0] != '#' && !take_line(line, ledger))
            good = fail("%s, line %d: want `01_cov2 matrix float 1e-7 double 1e-16`", path, number);
    }
    good = good && is_complete(ledger, path);
    mem_free(text);
    mem_free(path);
    return good;
}

bool ledger_save(const char *root, const Ledger *ledger) {
    char *path = file_join(root, "ledger.txt");
    FileWriter writer;
    bool good = file_begin(&writer, path);
    if (good) {
        fprintf(writer.stream,
                "# What our own solution misses each claim by, over its scale. Tolerances are ten times this.\n"
                "# Written by `splatlab exercise selftest --write-ledger`.\n");
        for (int e = 0; e < EXERCISE_COUNT; e++)
            for (int r = 0; r < EXERCISES[e]->rung_count; r++)
                fprintf(writer.stream, "%02d_%s %s float %.2e double %.2e\n", EXERCISES[e]->number, EXERCISES[e]->name,
                        EXERCISES[e]->rungs[r].name, fmax(0, ledger->own_error[e][r][PRECISION_FLOAT]),
                        fmax(0, ledger->own_error[e][r][PRECISION_DOUBLE]));
        good = file_commit(&writer);
    }
    mem_free(path);
    return good;
}
