// cmd_exercise.c - `splatlab exercise`: functions to write, and the tests that try them.
#include "lab/app/commands.h"
#include "lab/app/exercise_options.h"
#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/base/nearest.h"

#include <string.h>

static const OptionField FIELDS[] = {
    {.name = "seed",
     .type = OPTION_TEXT,
     .offset = offsetof(ExerciseOptions, seed),
     .help = "run: only the cases of this seed, as a failed run prints it; without, 16 fixed ones and a fresh one",
     .section = "A run"},
    {.name = "answer",
     .type = OPTION_TEXT,
     .offset = offsetof(ExerciseOptions, answer),
     .help = "run: this file in place of exercises/NN_name/name.c; progress is not noted"},
    {.name = "key",
     .type = OPTION_TEXT,
     .offset = offsetof(ExerciseOptions, key),
     .help = "the instructor's key: opens the solution before a pass; run: adds eight secret seeds"},
    {.name = "write-ledger",
     .type = OPTION_FLAG,
     .offset = offsetof(ExerciseOptions, write_ledger),
     .help = "selftest: measure what our solutions miss each claim by, from which the tolerances come"},
    {OPTION_JSON_OF(ExerciseOptions, "the result"), .section = "Output"},
};
enum {
    FIELD_COUNT = sizeof FIELDS / sizeof *FIELDS,
    WINDOW_FIELDS = 4
}; // of a window: size, scale, frames, screenshot

typedef struct {
    const char *name;
    ExerciseAction *action;
    bool needs_exercise, takes_exercise;
} Verb;

static const Verb VERBS[] = {
    {"list", exercise_list, false, false},
    {"run", exercise_run, true, true},
    {"watch", exercise_watch, false, true},
    {"show", exercise_show, true, true},
    {"hint", exercise_hint, true, true},
    {"reset", exercise_reset, true, true},
    {"solution", exercise_solution_show, true, true},
    {"selftest", exercise_selftest, false, true},
};
enum { VERB_COUNT = sizeof VERBS / sizeof *VERBS };

static bool find_verb(const char *text, const Verb **verb) {
    const char *names[VERB_COUNT];
    int best;
    for (int i = 0; i < VERB_COUNT; i++) {
        *verb = &VERBS[i];
        names[i] = VERBS[i].name;
        if (strcmp(text, VERBS[i].name) == 0) return true;
    }
    if (nearest_find(text, names, VERB_COUNT, &best, 1))
        return fail_usage("exercise: there is no action '%s'; did you mean '%s'?", text, names[best]);
    return fail_usage("exercise: there is no action '%s'; --help lists them", text);
}

static bool understand(const char *const *words, int count, const Verb **verb, const Exercise **exercise) {
    *verb = &VERBS[0];
    *exercise = NULL;
    if (count >= 1 && !find_verb(words[0], verb)) return false;
    if (count >= 2 && !(*verb)->takes_exercise) return fail_usage("exercise %s takes no number", words[0]);
    if (count >= 2 && !exercise_find(words[1], exercise)) return false;
    if (count < 2 && (*verb)->needs_exercise)
        return fail_usage("exercise %s: which one? splatlab exercise %s 1", words[0], words[0]);
    return true;
}

static int cmd_exercise(int argc, char **argv) {
    const ExerciseOptions defaults = {0};
    OptionField window[WINDOW_OPTION_COUNT], fields[FIELD_COUNT + WINDOW_FIELDS];
    const OptionTable table = {fields, FIELD_COUNT + WINDOW_FIELDS, &defaults};
    ExerciseOptions options = defaults;
    const char *words[2];
    int count, exit_code;
    const Verb *verb;
    const Exercise *exercise;
    char *root;
    memcpy(fields, FIELDS, sizeof FIELDS);
    window_options_fields(offsetof(ExerciseOptions, window), window);
    memcpy(fields + FIELD_COUNT, window, WINDOW_FIELDS * sizeof *fields);
    if (!command_line_parse(&CMD_EXERCISE, &table, argc, argv, &options, words, 2, &count, &exit_code))
        return exit_code;
    if (!understand(words, count, &verb, &exercise) || !exercises_root(&root)) return command_failed();
    exit_code = verb->action(root, exercise, &options);
    mem_free(root);
    return exit_code;
}

const Command CMD_EXERCISE = {
    .name = "exercise",
    .arguments = "[ACTION [N]]",
    .summary = "functions to write yourself, and the tests that try them",
    .details = "N is a number (7), a name (quat) or a folder (07_quat). Actions:\n"
               "  list         all exercises, with what you have reached (the default)\n"
               "  run N        tries your exercises/NN_name/name.c; exit code 0 when all of it holds, else 1\n"
               "  watch [N]    tries it at each save, one after the other; keys stand below the verdict\n"
               "  show N       pictures of the last wrong answer: yours, the reference, the difference\n"
               "  hint N       the next of four hints\n"
               "  reset N      back to the beginning; your file is kept beside it\n"
               "  solution N   ours, when yours has passed\n"
               "  selftest [N] tries the exercises themselves: stubs, solutions, wrong variants",
    .run = cmd_exercise,
};
