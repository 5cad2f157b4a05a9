// demo.c - demo files: found, read, and checked to the last key before a lecture meets them.
#include "lab/app/demo.h"

#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/base/nearest.h"
#include "lab/io/file.h"
#include "lab/io/json_io.h"
#include "splat2d/scene2d_json.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

const char *const DEMO_NAMES[DEMO_COUNT] = {"popping", "anisotropy", "psd", "opacity", "transmittance", "early-stop"};

// ---- where ----

// The folder of the running program, or "."; owned by the caller.
static char *program_folder(void) {
    char program[4096];
    ssize_t length = readlink("/proc/self/exe", program, sizeof program - 1);
    if (length <= 0) return mem_text(".");
    program[length] = 0;
    return file_folder_of(program);
}

static bool find(const char *name, char **path) {
    if (file_has_ending(name, ".json")) {
        *path = mem_text(name);
        return true;
    }
    char *beside = program_folder();
    char *tree = mem_format("%s/lab/app/demos", beside);
    const char *folders[] = {getenv("SPLATLAB_DEMOS"), tree, "lab/app/demos", SPLATLAB_INSTALLED_KERNELS "/../demos"};
    *path = NULL;
    for (size_t i = 0; i < sizeof folders / sizeof *folders && !*path; i++) {
        if (!folders[i] || !folders[i][0]) continue;
        char *candidate = mem_format("%s/%s.json", folders[i], name);
        if (file_exists(candidate))
            *path = candidate;
        else
            mem_free(candidate);
    }
    mem_free(beside);
    mem_free(tree);
    if (*path) return true;
    int best;
    for (int i = 0; i < DEMO_COUNT; i++)
        if (strcmp(name, DEMO_NAMES[i]) == 0)
            return fail("cannot find the demo file %s.json; set SPLATLAB_DEMOS to the folder that holds it", name);
    if (nearest_find(name, DEMO_NAMES, DEMO_COUNT, &best, 1))
        return fail_usage("there is no demo '%s'; did you mean %s?", name, DEMO_NAMES[best]);
    return fail_usage(
        "there is no demo '%s'; want popping, anisotropy, psd, opacity, transmittance, early-stop, or a .json "
        "file",
        name);
}

// ---- read ----

static bool get_flag(const json_t *step, const char *key, const char *where, bool *value) {
    const json_t *found = json_object_get(step, key);
    if (!found) return true;
    if (!json_is_boolean(found)) return fail("%s: \"%s\" is neither true nor false", where, key);
    *value = json_is_true(found);
    return true;
}

static bool get_number(const json_t *step, const char *key, const char *where, double low, double high, double *value) {
    if (!json_has(step, key)) return true;
    if (!json_get_number(step, key, where, value)) return false;
    if (*value >= low && *value <= high) return true;
    return fail("%s: \"%s\" is %g, want %g to %g", where, key, *value, low, high);
}

static bool get_whole(const json_t *step, const char *key, const char *where, int low, int high, int *value) {
    double number = *value;
    if (!get_number(step, key, where, low, high, &number)) return false;
    *value = (int)number;
    return *value == number || fail("%s: \"%s\" is %g, want a whole number", where, key, number);
}

static bool get_choice(const json_t *step, const char *key, const char *where, const char *const *names, int count,
                       int *value) {
    const char *text;
    if (!json_has(step, key)) return true;
    if (!json_get_text(step, key, where, &text)) return false;
    for (int i = 0; i < count; i++)
        if (strcmp(text, names[i]) == 0) {
            *value = i;
            return true;
        }
    return fail("%s: \"%s\" is \"%s\", want %s or %s", where, key, text, names[0], names[count - 1]);
}

static bool get_scene(const json_t *object, const char *where, Scene2d *scene) {
    const json_t *found = json_object_get(object, "scene");
    if (!found) return true;
    scene2d_destroy(scene);
    return scene2d_from_json(found, where, scene);
}

static bool get_changes(const json_t *step, const char *where, Scene2d *scene) {
    const json_t *list = json_object_get(step, "set");
    if (list && !json_is_array(list)) return fail("%s: \"set\" is no list", where);
    for (size_t i = 0; i < json_array_size(list); i++) {
        json_t *change = json_array_get(list, i);
        int blob = -1;
        if (!json_has(change, "blob")) return fail("%s: change %zu of \"set\" names no \"blob\"", where, i);
        if (!get_whole(change, "blob", where, 0, scene->count - 1, &blob)) return false;
        json_t *fields = json_copy(change);
        json_object_del(fields, "blob");
        bool good = blob_change_from_json(fields, where, &scene->blobs[blob]);
        json_decref(fields);
        if (!good) return false;
    }
    return scene2d_check(scene, where);
}

static bool check_keys(const json_t *object, const char *where, const char *const *known, int count) {
    const char *key;
    json_t *value;
    json_object_foreach((json_t *)object, key, value) {
        bool found = false;
        for (int i = 0; i < count; i++) found = found || strcmp(key, known[i]) == 0;
        if (!found) return fail("%s: there is no field \"%s\"", where, key);
    }
    return true;
}

static bool get_look(const json_t *json, const char *where, DemoStep *step) {
    static const char *const layers[] = {"colour", "transmittance", "blobs read"}, *const pages[] = {"blobs", "psd"};
    if (json_has(json, "probe") && !json_get_numbers(json, "probe", where, step->probe, 2)) return false;
    for (int c = 0; c < 2; c++) step->probe[c] = floor(step->probe[c]) + 0.5;
    return get_whole(json, "active", where, -1, step->scene.count - 1, &step->active) &&
           get_choice(json, "layer", where, layers, 3, &step->layer) &&
           get_choice(json, "page", where, pages, 2, &step->page) &&
           get_flag(json, "outlines", where, &step->outlines) && get_flag(json, "discs", where, &step->discs) &&
           get_flag(json, "unattenuated", where, &step->unattenuated) &&
           get_number(json, "stop", where, 0, 1, &step->stop) &&
           get_number(json, "rate", where, 1e-6, 1, &step->rate) &&
           get_whole(json, "walk", where, 0, 2000, &step->walk) &&
           get_whole(json, "compare_to", where, -1, DEMO_STEPS_MAX - 1, &step->compare_to);
}

static bool get_step(const json_t *json, const char *where, DemoStep *step) {
    static const char *const known[] = {"caption", "question", "scene",    "set",   "active",
                                        "probe",   "layer",    "outlines", "discs", "unattenuated",
                                        "stop",    "page",     "rate",     "walk",  "compare_to"};
    const char *text;
    if (!check_keys(json, where, known, sizeof known / sizeof *known)) return false;
    if (!json_get_text(json, "caption", where, &text)) return false;
    step->caption = mem_text(text);
    step->question = NULL;
    if (json_has(json, "question")) {
        if (!json_get_text(json, "question", where, &text)) return false;
        step->question = mem_text(text);
    }
    return get_scene(json, where, &step->scene) && get_changes(json, where, &step->scene) &&
           get_look(json, where, step);
}

static bool read_steps(const json_t *list, const char *path, const Scene2d *scene, Demo *demo) {
    DemoStep next = {.scene = *scene,
                     .outlines = true,
                     .stop = 1e-4,
                     .rate = 0.04,
                     .compare_to = -1,
                     .probe = {scene->width / 2.0, scene->height / 2.0}};
    for (size_t i = 0; i < json_array_size(list); i++) {
        char where[4200];
        DemoStep *step = &demo->steps[demo->count++];
        snprintf(where, sizeof where, "%s, step %zu", path, i);
        *step = next;
        step->caption = step->question = NULL;
        step->scene = scene2d_copy(&next.scene);
        if (!get_step(json_array_get(list, i), where, step)) return false;
        next = *step;
    }
    return true;
}

static bool read_demo(const json_t *root, const char *path, Demo *demo) {
    static const char *const known[] = {"title", "scene", "steps"};
    const char *title;
    const json_t *steps = json_object_get(root, "steps");
    Scene2d scene = scene2d_create(960, 720);
    if (!check_keys(root, path, known, 3) || !json_get_text(root, "title", path, &title)) return false;
    demo->title = mem_text(title);
    size_t count = json_array_size(steps);
    if (count < 1 || count > DEMO_STEPS_MAX)
        return fail("%s: \"steps\" holds %zu, want 1 to %d", path, count, DEMO_STEPS_MAX);
    bool good = get_scene(root, path, &scene) && read_steps(steps, path, &scene, demo);
    scene2d_destroy(&scene);
    return good;
}

bool demo_load(const char *name, Demo *demo) {
    char *path;
    json_t *root = NULL;
    *demo = (Demo){0};
    if (!find(name, &path)) return false;
    bool good = json_read(path, &root) && read_demo(root, path, demo);
    json_decref(root);
    mem_free(path);
    if (!good) demo_free(demo);
    return good;
}

void demo_free(Demo *demo) {
    for (int i = 0; i < demo->count; i++) {
        mem_free(demo->steps[i].caption);
        mem_free(demo->steps[i].question);
        scene2d_destroy(&demo->steps[i].scene);
    }
    mem_free(demo->title);
    *demo = (Demo){0};
}
