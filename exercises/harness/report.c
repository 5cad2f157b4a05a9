// report.c - the text and the JSON of a verdict.
#include "exercises/harness/report.h"

#include "exercises/harness/pictures.h"
#include "lab/base/mem.h"
#include "lab/io/json_io.h"

#include <math.h>
#include <string.h>

// ---- text ----

typedef struct {
    const char *good, *bad, *strong, *end;
} Colours;

static Colours colours(bool has_colour) {
    return has_colour ? (Colours){"\033[32m", "\033[31m", "\033[1m", "\033[0m"} : (Colours){"", "", "", ""};
}

static void print_number(FILE *out, double value) {
    if (number_is_unwritten(value))
        fprintf(out, " %12s", "(unwritten)");
    else
        fprintf(out, " %12.6g", value);
}

static void print_row(FILE *out, const char *label, const double *values, int count) {
    fprintf(out, "  %-11s", label);
    for (int i = 0; i < count && i < TRIAL_SHOWN_MAX; i++) print_number(out, values[i]);
    if (count > TRIAL_SHOWN_MAX) fprintf(out, "  (%d of %d)", TRIAL_SHOWN_MAX, count);
    fputc('\n', out);
}

static void print_numbers(FILE *out, const Failure *f) {
    print_row(out, "yours", f->yours, f->count);
    print_row(out, f->is_limit ? "at most" : "expected", f->expected, f->count);
    for (int i = 0; i < f->count && i < TRIAL_SHOWN_MAX; i++)
        if (number_is_unwritten(f->yours[i])) {
            fprintf(out, "  %-11sno line of yours wrote the number that is marked\n", "note");
            return;
        }
    if (f->is_limit) return;
    if (isinf(f->error))
        fprintf(out, "  %-11snumber %d is not a number\n", "off by", f->worst + 1);
    else
        fprintf(out, "  %-11s%.3g of the scale, at number %d; tolerance %.1e\n", "off by", f->error, f->worst + 1,
                f->tolerance);
}

static void print_right(FILE *out, const Verdict *v, int r) {
    const RungResult *result = &v->rungs[r];
    fprintf(out, "  %-11s", "right");
    int before = 0;
    for (int i = 0; i < v->exercise->rung_count; i++)
        if (v->rungs[i].passed) fprintf(out, "%s%s", before++ ? ", " : "", v->exercise->rungs[i].name);
    if (before) fputs("; ", out);
    fprintf(out, "%d of %d cases of this one", result->cases - result->failed_cases, result->cases);
    if (result->precision == PRECISION_FLOAT && !v->exercise->rungs[r].double_only)
        fputs(", all that were tried in double: digits are lost in float", out);
    fputc('\n', out);
}

static void print_pictures(FILE *out, const char *root, const Verdict *v) {
    char *paths[PICTURE_COUNT];
    for (int k = 0; k < PICTURE_COUNT; k++) paths[k] = pictures_path(root, v->exercise, (PictureKind)k);
    fprintf(out, "  %-11s%s, %s, %s   (splatlab exercise show %d)\n", "pictures", paths[0], paths[1], paths[2],
            v->exercise->number);
    for (int k = 0; k < PICTURE_COUNT; k++) mem_free(paths[k]);
}

static void print_failure(FILE *out, const char *root, const Verdict *v, int r, Colours c) {
    const Exercise *e = v->exercise;
    const RungResult *result = &v->rungs[r];
    const Failure *f = &result->failure;
    fprintf(out, "%sE%02d %s%s  rung %d of %d: %s  (%s)\n", c.strong, e->number, e->name, c.end, r + 1, e->rung_count,
            e->rungs[r].claim, PRECISION_NAMES[result->precision]);
    if (f->trouble.kind == TROUBLE_NOT_STARTED) {
        fprintf(out, "  %s%s%s\n", c.bad, f->trouble.text, c.end);
    } else {
        fprintf(out, "  %-11s%s\n", "case", f->call);
        if (f->trouble.kind != TROUBLE_NONE) {
            fprintf(out, "  %-11s%s%s%s\n", "happened", c.bad, f->trouble.text, c.end);
        } else {
            fprintf(out, "  %-11s%s\n", "compared", f->claim);
            print_numbers(out, f);
        }
        print_right(out, v, r);
    }
    if (v->suspicions[r].found)
        fprintf(out, "  %-11s%s  (%d of %d cases agree)\n", "looks like", v->suspicions[r].text,
                v->suspicions[r].matched, v->suspicions[r].cases);
    if (v->pictured >= 0) print_pictures(out, root, v);
    if (f->trouble.kind == TROUBLE_NOT_STARTED)
        fprintf(out, "  %-11sread %s/%02d_%s/README.md, then write it; hints: splatlab exercise hint %d\n", "next",
                root, e->number, e->name, e->number);
    else
        fprintf(out, "  %-11ssplatlab exercise hint %d     replay: splatlab exercise run %d --seed %llu\n", "next",
                e->number, e->number, (unsigned long long)result->seed);
}

static void print_rungs(FILE *out, const Verdict *v, Colours c) {
    for (int r = 0; r < v->exercise->rung_count; r++) {
        const RungResult *result = &v->rungs[r];
        bool is_open = !result->ran || result->failure.trouble.kind == TROUBLE_NOT_STARTED;
        const char *mark = is_open ? "-" : result->passed ? "ok" : "FAIL";
        const char *colour = is_open ? "" : result->passed ? c.good : c.bad;
        fprintf(out, "  %s%-4s%s %-14s %s\n", colour, mark, c.end, v->exercise->rungs[r].name,
                v->exercise->rungs[r].claim);
    }
}

void report_text(const char *root, const Verdict *v, FILE *out, bool has_colour) {
    Colours c = colours(has_colour);
    const Exercise *e = v->exercise;
    if (v->diagnostics[0]) fputs(v->diagnostics, out);
    if (!v->compiled) {
        fprintf(out, "%sE%02d %s%s does not compile yet: the first message above is the one to read\n", c.bad,
                e->number, e->name, c.end);
        return;
    }
    if (v->printed[0]) fprintf(out, "-- printed by your code --\n%s\n--\n", v->printed);
    int failed = verdict_first_failed(v);
    print_rungs(out, v, c);
    if (failed >= 0) {
        print_failure(out, root, v, failed, c);
        return;
    }
    fprintf(out, "%sE%02d %s: passed%s, all %d rungs in float and double, 17 seeds (%.1f s)\n", c.good, e->number,
            e->name, c.end, e->rung_count, v->seconds);
    fprintf(out, "  %-11s%s\n  %-11ssplatlab exercise solution %d shows ours\n", "unlocked", e->unlocks, "compare",
            e->number);
}

// ---- JSON ----

static json_t *numbers_json(const double *values, int count) {
    json_t *list = json_array();
    for (int i = 0; i < count && i < TRIAL_SHOWN_MAX; i++)
        json_array_append_new(list, isfinite(values[i]) ? json_real(values[i]) : json_null());
    return list;
}

static json_t *real_or_null(double value) { return isfinite(value) ? json_real(value) : json_null(); }

static json_t *rung_json(const Verdict *v, int r) {
    const RungResult *result = &v->rungs[r];
    const Failure *f = &result->failure;
    json_t *o = json_pack("{ss ss sb sb si si}", "name", v->exercise->rungs[r].name, "claim",
                          v->exercise->rungs[r].claim, "passed", result->passed, "ran", result->ran, "cases",
                          result->cases, "failed_cases", result->failed_cases);
    if (!result->ran || result->passed) return o;
    bool is_wrong = f->trouble.kind == TROUBLE_NONE;
    json_object_set_new(o, "seed", json_integer((json_int_t)result->seed));
    json_object_set_new(o, "precision", json_string(PRECISION_NAMES[result->precision]));
    json_object_set_new(o, "case", json_text(f->call));
    json_object_set_new(o, "compared", json_text(f->claim));
    json_object_set_new(o, "expected", numbers_json(f->expected, f->count));
    json_object_set_new(o, "actual", numbers_json(f->yours, f->count));
    json_object_set_new(o, "error", is_wrong ? real_or_null(f->error) : json_null());
    json_object_set_new(o, "tolerance", is_wrong ? real_or_null(f->tolerance) : json_null());
    json_object_set_new(o, "happened", is_wrong ? json_null() : json_text(f->trouble.text));
    json_object_set_new(o, "suspicion", v->suspicions[r].found ? json_text(v->suspicions[r].name) : json_null());
    if (v->suspicions[r].found) json_object_set_new(o, "suspicion_text", json_text(v->suspicions[r].text));
    return o;
}

json_t *report_json(const char *root, const Verdict *v) {
    json_t *rungs = json_array();
    for (int r = 0; r < v->exercise->rung_count; r++) json_array_append_new(rungs, rung_json(v, r));
    json_t *o = json_pack("{si ss sb sb sb sf so}", "exercise", v->exercise->number, "name", v->exercise->name,
                          "passed", v->passed, "compiled", v->compiled, "not_started", v->not_started, "seconds",
                          v->seconds, "rungs", rungs);
    json_object_set_new(o, "compiler", json_text(v->diagnostics));
    for (int k = 0; v->pictured >= 0 && k < PICTURE_COUNT; k++) {
        static const char *const KEYS[PICTURE_COUNT] = {"picture_yours", "picture_reference", "picture_difference"};
        char *path = pictures_path(root, v->exercise, (PictureKind)k);
        json_object_set_new(o, KEYS[k], json_text(path));
        mem_free(path);
    }
    return o;
}
