// scene2d_json.c - the scene's fields by name, there and back.
#include "splat2d/scene2d_json.h"

#include "lab/base/fail.h"
#include "lab/base/nearest.h"
#include "lab/io/json_io.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

// The blob's fields in the order in which they are written; `count` numbers each, 1 as a bare number.
static const struct {
    const char *key;
    size_t offset;
    int count;
} FIELDS[] = {
    {"mean", offsetof(Blob, mean), 2},       {"sigma_x", offsetof(Blob, sigma_x), 1},
    {"sigma_y", offsetof(Blob, sigma_y), 1}, {"theta_rad", offsetof(Blob, theta_rad), 1},
    {"rgb", offsetof(Blob, rgb), 3},         {"opacity", offsetof(Blob, opacity), 1},
    {"depth", offsetof(Blob, depth), 1},
};
enum { FIELD_COUNT = sizeof FIELDS / sizeof FIELDS[0], WHERE_BYTES = 4096 + 64 };

static const char *const SCENE_KEYS[] = {"width", "height", "background", "gaussians"};
enum { SCENE_KEY_COUNT = sizeof SCENE_KEYS / sizeof SCENE_KEYS[0] };

// ---- load ----

static bool check_keys(const json_t *object, const char *where, const char *const *known, int count) {
    const char *key;
    json_t *value;
    json_object_foreach((json_t *)object, key, value) {
        bool found = false;
        for (int i = 0; i < count; i++) found = found || strcmp(key, known[i]) == 0;
        if (found) continue;
        int best;
        bool near = nearest_find(key, known, count, &best, 1) == 1;
        return fail("%s: there is no field \"%s\"%s%s%s", where, key, near ? "; did you mean \"" : "",
                    near ? known[best] : "", near ? "\"?" : "");
    }
    return true;
}

static bool load_field(const json_t *object, int field, const char *where, Blob *blob) {
    double *values = (double *)((char *)blob + FIELDS[field].offset);
    if (FIELDS[field].count == 1) return json_get_number(object, FIELDS[field].key, where, values);
    return json_get_numbers(object, FIELDS[field].key, where, values, FIELDS[field].count);
}

static bool check_blob_keys(const json_t *object, const char *where) {
    const char *keys[FIELD_COUNT];
    for (int i = 0; i < FIELD_COUNT; i++) keys[i] = FIELDS[i].key;
    return check_keys(object, where, keys, FIELD_COUNT);
}

static bool load_blob(const json_t *object, const char *where, Blob *blob) {
    for (int i = 0; i < FIELD_COUNT; i++)
        if (!load_field(object, i, where, blob)) return false;
    return check_blob_keys(object, where);
}

bool blob_change_from_json(const json_t *object, const char *where, Blob *blob) {
    for (int i = 0; i < FIELD_COUNT; i++)
        if (json_has(object, FIELDS[i].key) && !load_field(object, i, where, blob)) return false;
    return check_blob_keys(object, where);
}

static bool load_side(const json_t *root, const char *key, const char *path, int *side) {
    double value;
    if (!json_get_number(root, key, path, &value)) return false;
    if (!(value >= 1 && value <= SCENE2D_SIDE_MAX && value == floor(value)))
        return fail("%s: \"%s\" is %g, want a whole number of pixels, 1 to %d", path, key, value, SCENE2D_SIDE_MAX);
    *side = (int)value;
    return true;
}

static bool load_blobs(const json_t *root, const char *path, Scene2d *scene) {
    const json_t *list = json_object_get(root, "gaussians");
    if (!list) return fail("%s: \"gaussians\" is missing", path);
    if (!json_is_array(list)) return fail("%s: \"gaussians\" is no list", path);
    if (json_array_size(list) > SCENE2D_BLOBS_MAX)
        return fail("%s: %zu blobs, want at most %d", path, json_array_size(list), SCENE2D_BLOBS_MAX);
    for (size_t i = 0; i < json_array_size(list); i++) {
        char where[WHERE_BYTES];
        Blob blob;
        snprintf(where, sizeof where, "%s, blob %zu", path, i);
        if (!load_blob(json_array_get(list, i), where, &blob) || scene2d_add(scene, &blob) < 0) return false;
    }
    return true;
}

static bool load_scene(const json_t *root, const char *path, Scene2d *scene) {
    return load_side(root, "width", path, &scene->width) && load_side(root, "height", path, &scene->height) &&
           json_get_numbers(root, "background", path, scene->background, 3) && load_blobs(root, path, scene) &&
           check_keys(root, path, SCENE_KEYS, SCENE_KEY_COUNT) && scene2d_check(scene, path);
}

bool scene2d_from_json(const json_t *root, const char *where, Scene2d *scene) {
    *scene = (Scene2d){0};
    bool good = load_scene(root, where, scene);
    if (!good) scene2d_destroy(scene);
    return good;
}

bool scene2d_load(const char *path, Scene2d *scene) {
    json_t *root;
    *scene = (Scene2d){0};
    if (!json_read(path, &root)) return false;
    bool good = scene2d_from_json(root, path, scene);
    json_decref(root);
    return good;
}

// ---- save ----

static json_t *number_list(const double *values, int count) {
    json_t *list = json_array();
    for (int i = 0; i < count; i++) json_array_append_new(list, json_real(values[i]));
    return list;
}

static json_t *blob_object(const Blob *blob) {
    json_t *object = json_object();
    for (int i = 0; i < FIELD_COUNT; i++) {
        const double *values = (const double *)((const char *)blob + FIELDS[i].offset);
        json_object_set_new(object, FIELDS[i].key,
                            FIELDS[i].count == 1 ? json_real(*values) : number_list(values, FIELDS[i].count));
    }
    return object;
}

bool scene2d_save(const char *path, const Scene2d *scene) {
    if (!scene2d_check(scene, path)) return fail_context("cannot save the scene");
    json_t *blobs = json_array();
    for (int i = 0; i < scene->count; i++) json_array_append_new(blobs, blob_object(&scene->blobs[i]));
    json_t *root = json_pack("{si si so so}", "width", scene->width, "height", scene->height, "background",
                             number_list(scene->background, 3), "gaussians", blobs);
    bool good = json_write(path, root);
    json_decref(root);
    return good;
}
