// report.c - the text and the JSON of a verdict.
#include "exercises/harness/report.h"

#include "exercises/harness/pictures.h"
#include "lab/base/mem.h"
#include "lab/io/json_io.h"

#include <math.h>
#include <string.h>

// ---- text ----

enum { NUMBER_WIDTH = 13 };

static void print_row(const Page *page, const char *label, const double *values, int count) {
    fprintf(page->out, "  %-*s", PAGE_LABEL - 2, label);
    for (int i = 0; i < count; i++)
        if (number_is_unwritten(values[i]))
            fprintf(page->out, "%*s", NUMBER_WIDTH, "(unwritten)");
        else
            fprintf(page->out, "%*.6g", NUMBER_WIDTH, values[i] + 0.0); // no -0
    fputc('\n', page->out);
}

static bool has_unwritten(const Failure *f) {
    for (int i = 0; i < f->count && i < TRIAL_SHOWN_MAX; i++)
        if (number_is_unwritten(f->yours[i])) return true;
    return false;
}

// Yours above expected, as many to a line as there is room for, and a mark under the worst.
static void print_numbers(const Page *page, const Failure *f) {
    int shown = f->count < TRIAL_SHOWN_MAX ? f->count : TRIAL_SHOWN_MAX;
    int of_line = (page->columns - PAGE_LABEL) / NUMBER_WIDTH;
    for (int from = 0; from < shown; from += of_line) {
        int count = shown - from < of_line ? shown - from : of_line;
        print_row(page, "yours", f->yours + from, count);
        print_row(page, f->is_limit ? "at most" : "expected", f->expected + from, count);
        if (shown > 1 && f->worst >= from && f->worst < from + count)
            fprintf(page->out, "%*s\n", PAGE_LABEL + (f->worst - from + 1) * NUMBER_WIDTH, "^");
    }
    if (f->count > shown) page_paragraph(page, "", PAGE_PLAIN, "(%d of %d numbers)", shown, f->count);
    if (has_unwritten(f))
        page_paragraph(page, "note", PAGE_BAD,
                       "no line of yours set what is called (unwritten); += needs something to add to: set it first");
    else if (isinf(f->error))
        page_paragraph(page, "off by", PAGE_BAD, "number %d is not a number", f->worst + 1);
    else if (!f->is_limit)
        page_paragraph(page, "off by", PAGE_PLAIN, "%.3g of the scale; tolerance %.1e", f->error, f->tolerance);
}

static void print_right(const Page *page, const Verdict *v, int r) {
    const RungResult *result = &v->rungs[r];
    char *names = mem_text("");
    for (int i = 0; i < v->exercise->rung_count; i++) {
        if (!v->rungs[i].passed || v->rungs[i].skipped) continue;
        char *longer = mem_format("%s%s%s", names, names[0] ? ", " : "", v->exercise->rungs[i].name);
        mem_free(names);
        names = longer;
    }
    bool is_lost = result->precision == PRECISION_FLOAT && !v->exercise->rungs[r].double_only;
    page_paragraph(page, "right", PAGE_PLAIN, "%s%s%d of %d cases of this one%s", names, names[0] ? "; " : "",
                   result->cases - result->failed_cases, result->cases,
                   is_lost ? ", all that were tried in double: digits are lost in float" : "");
    mem_free(names);
}

static void print_pictures(const Page *page, const char *root, const Verdict *v) {
    char *paths[PICTURE_COUNT];
    for (int k = 0; k < PICTURE_COUNT; k++) paths[k] = pictures_path(root, v->exercise, (PictureKind)k);
    page_paragraph(page, "pictures", PAGE_PLAIN, "%s %s %s (splatlab exercise show %d)", paths[0], paths[1], paths[2],
                   v->exercise->number);
    for (int k = 0; k < PICTURE_COUNT; k++) mem_free(paths[k]);
}

static void print_next(const Page *page, const char *root, const Verdict *v, const RungResult *result) {
    const Exercise *e = v->exercise;
    if (result->failure.trouble.kind == TROUBLE_NOT_STARTED)
        page_paragraph(page, "next", PAGE_PLAIN,
                       "read %s/%02d_%s/README.md, then write it; hints: splatlab exercise hint %d", root, e->number,
                       e->name, e->number);
    else
        page_paragraph(page, "next", PAGE_PLAIN,
                       "splatlab exercise hint %d; replay: splatlab exercise run %d --seed %llu", e->number, e->number,
                       (unsigned long long)result->seed);
}

static void print_failure(const Page *page, const char *root, const Verdict *v, int r) {
    const Exercise *e = v->exercise;
    const RungResult *result = &v->rungs[r];
    const Failure *f = &result->failure;
    fputc('\n', page->out);
    page_colour(page, PAGE_STRONG);
    char *head = mem_format("E%02d %s  rung %d of %d: %s  (%s)", e->number, e->name, r + 1, e->rung_count,
                            e->rungs[r].claim, PRECISION_NAMES[result->precision]);
    page_wrap(page, 0, 4, head);
    mem_free(head);
    page_colour(page, PAGE_PLAIN);
    if (f->trouble.kind == TROUBLE_NOT_STARTED) {
        page_paragraph(page, "", PAGE_BAD, "%s", f->trouble.text);
    } else {
        page_paragraph(page, "case", PAGE_PLAIN, "%s", f->call);
        if (f->trouble.kind != TROUBLE_NONE) {
            page_paragraph(page, "happened", PAGE_BAD, "%s", f->trouble.text);
        } else {
            page_paragraph(page, "compared", PAGE_PLAIN, "%s", f->claim);
            print_numbers(page, f);
        }
        print_right(page, v, r);
    }
    if (v->suspicions[r].found)
        page_paragraph(page, "looks like", PAGE_STRONG, "%s  (%d of %d cases agree)", v->suspicions[r].text,
                       v->suspicions[r].matched, v->suspicions[r].cases);
    if (v->pictured >= 0) print_pictures(page, root, v);
    print_next(page, root, v, result);
}

static void print_rungs(const Page *page, const Verdict *v) {
    for (int r = 0; r < v->exercise->rung_count; r++) {
        const RungResult *result = &v->rungs[r];
        bool is_open = !result->ran || result->skipped || result->failure.trouble.kind == TROUBLE_NOT_STARTED;
        fputs("  ", page->out);
        page_colour(page, is_open ? PAGE_PLAIN : result->passed ? PAGE_GOOD : PAGE_BAD);
        fprintf(page->out, "%-4s", is_open ? "-" : result->passed ? "ok" : "FAIL");
        page_colour(page, PAGE_PLAIN);
        fprintf(page->out, " %-14s ", v->exercise->rungs[r].name);
        char *claim = mem_format("%s%s%s", v->exercise->rungs[r].claim, result->skipped ? ": " : "",
                                 result->skipped ? result->skipped : "");
        page_wrap(page, 22, 22, claim);
        mem_free(claim);
    }
}

static void print_passed(const Page *page, const Verdict *v) {
    const Exercise *e = v->exercise;
    page_colour(page, PAGE_GOOD);
    fprintf(page->out, "\nE%02d %s: passed", e->number, e->name);
    page_colour(page, PAGE_PLAIN);
    fprintf(page->out, ", all %d rungs in float and double, %d seed%s (%.1f s)\n", e->rung_count, v->seed_count,
            v->seed_count == 1 ? "" : "s", v->seconds);
    page_paragraph(page, "unlocked", PAGE_PLAIN, "%s", e->unlocks);
    page_paragraph(page, "compare", PAGE_PLAIN, "splatlab exercise solution %d shows ours", e->number);
}

void report_text(const char *root, const Verdict *v, const Page *page) {
    const Exercise *e = v->exercise;
    if (v->diagnostics[0]) fputs(v->diagnostics, page->out);
    if (!v->compiled) {
        page_colour(page, PAGE_BAD);
        fprintf(page->out, "E%02d %s", e->number, e->name);
        page_colour(page, PAGE_PLAIN);
        fprintf(page->out, " does not compile yet: the first message above is the one to read\n");
        return;
    }
    if (v->printed[0]) fprintf(page->out, "-- printed by your code --\n%s\n--\n", v->printed);
    int failed = verdict_first_failed(v);
    print_rungs(page, v);
    if (failed >= 0)
        print_failure(page, root, v, failed);
    else
        print_passed(page, v);
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
    if (result->skipped) json_object_set_new(o, "skipped", json_string(result->skipped));
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
