// standing.c - {"01_cov2": {"passed": ["matrix"], "solved": false, "runs": 3, "hints": 1}, ...}
#include "exercises/harness/standing.h"

#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/io/file.h"
#include "lab/io/json_io.h"

#include <string.h>

static char *key_of(const Exercise *e) { return mem_format("%02d_%s", e->number, e->name); }

static bool take(const json_t *entry, const Exercise *e, const char *where, Standing *standing) {
    double runs, hints;
    const json_t *passed = json_object_get(entry, "passed"), *solved = json_object_get(entry, "solved");
    if (!json_is_array(passed) || !json_is_boolean(solved))
        return fail("%s: want \"passed\": [names] and \"solved\": true or false", where);
    if (!json_get_number(entry, "runs", where, &runs) || !json_get_number(entry, "hints", where, &hints)) return false;
    standing->solved = json_is_true(solved);
    standing->runs = runs > 0 && runs < 1e9 ? (int)runs : 0;
    standing->hints = hints > 0 && hints < 100 ? (int)hints : 0;
    for (size_t i = 0; i < json_array_size(passed); i++) {
        const char *name = json_string_value(json_array_get(passed, i));
        for (int r = 0; name && r < e->rung_count; r++)
            if (strcmp(name, e->rungs[r].name) == 0) standing->passed[r] = true;
    }
    return true;
}

bool standing_load(const char *root, Standing all[EXERCISE_COUNT]) {
    char *path = file_join(root, "progress.json");
    memset(all, 0, EXERCISE_COUNT * sizeof *all);
    json_t *file = NULL;
    bool good = !file_exists(path) || json_read(path, &file);
    for (int i = 0; good && file && i < EXERCISE_COUNT; i++) {
        char *key = key_of(EXERCISES[i]), *where = mem_format("%s, %s", path, key);
        const json_t *entry = json_object_get(file, key);
        good = !entry || take(entry, EXERCISES[i], where, &all[i]);
        mem_free(key);
        mem_free(where);
    }
    if (!good) fail_context("your progress; mend the file, or remove it to begin anew");
    json_decref(file);
    mem_free(path);
    return good;
}

bool standing_save(const char *root, const Standing all[EXERCISE_COUNT]) {
    char *path = file_join(root, "progress.json");
    json_t *file = json_object();
    for (int i = 0; i < EXERCISE_COUNT; i++) {
        if (all[i].runs == 0 && all[i].hints == 0) continue;
        char *key = key_of(EXERCISES[i]);
        json_t *passed = json_array();
        for (int r = 0; r < EXERCISES[i]->rung_count; r++)
            if (all[i].passed[r]) json_array_append_new(passed, json_string(EXERCISES[i]->rungs[r].name));
        json_object_set_new(file, key,
                            json_pack("{so sb si si}", "passed", passed, "solved", all[i].solved, "runs", all[i].runs,
                                      "hints", all[i].hints));
        mem_free(key);
    }
    bool good = json_write(path, file);
    json_decref(file);
    mem_free(path);
    return good;
}

void standing_note(Standing *standing, const Verdict *v) {
    standing->runs++;
    for (int r = 0; r < RUNGS_MAX; r++) standing->passed[r] = v->rungs[r].passed;
    standing->solved |= v->passed;
}

int standing_rungs(const Standing *standing, const Exercise *exercise) {
    int count = 0;
    for (int r = 0; r < exercise->rung_count; r++) count += standing->passed[r];
    return count;
}
