// facts.c - counts, ranges and quantiles of scenes and models.
#include "lab/app/facts.h"

#include "lab/base/mem.h"

#include <math.h>
#include <stdlib.h>

static json_t *number_list(const double *values, int count) {
    json_t *list = json_array();
    for (int i = 0; i < count; i++) json_array_append_new(list, json_real(values[i]));
    return list;
}

static json_t *vec3_list(Vec3 v) { return number_list((const double[]){v.x, v.y, v.z}, 3); }

// ---- scenes ----

// {"640x426": 15, ...}: how many views have each size.
static json_t *resolutions(const Dataset *dataset) {
    json_t *sizes = json_object();
    for (int i = 0; i < dataset->view_count; i++) {
        char size[32];
        snprintf(size, sizeof size, "%dx%d", dataset->views[i].camera.width, dataset->views[i].camera.height);
        json_t *known = json_object_get(sizes, size);
        json_object_set_new(sizes, size, json_integer(1 + (known ? json_integer_value(known) : 0)));
    }
    return sizes;
}

static bool has_alpha(const Dataset *dataset) {
    for (int i = 0; i < dataset->view_count; i++)
        if (dataset->views[i].channels == 4) return true;
    return false;
}

json_t *facts_of_scene(const Dataset *dataset) {
    json_t *facts = json_object();
    json_object_set_new(facts, "kind", json_string("scene"));
    json_object_set_new(facts, "format", json_string(dataset->kind));
    json_object_set_new(facts, "views", json_integer(dataset->view_count));
    json_object_set_new(facts, "train", json_integer(dataset_train_count(dataset)));
    json_object_set_new(facts, "held_out", json_integer(dataset_held_out_count(dataset)));
    json_object_set_new(facts, "resolutions_px", resolutions(dataset));
    json_object_set_new(facts, "alpha", json_boolean(has_alpha(dataset)));
    json_object_set_new(facts, "points", json_integer(dataset->points.count));
    json_object_set_new(facts, "extent_world", json_real(dataset->extent));
    json_object_set_new(facts, "centre_world", vec3_list(dataset->centre));
    return facts;
}

// ---- models and points ----

static int compare(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

// {"min": .., "5%": .., "50%": .., "95%": .., "max": ..}; sorts the values.
static json_t *quantiles(double *values, size_t count) {
    static const struct {
        const char *name;
        double share;
    } wanted[] = {{"min", 0}, {"5%", 0.05}, {"50%", 0.5}, {"95%", 0.95}, {"max", 1}};
    json_t *object = json_object();
    qsort(values, count, sizeof *values, compare);
    for (size_t i = 0; i < sizeof wanted / sizeof wanted[0] && count; i++)
        json_object_set_new(object, wanted[i].name,
                            json_real(values[(size_t)lround(wanted[i].share * (double)(count - 1))]));
    return object;
}

// {"min": [x y z], "max": [x y z]} of points at(context, i, axis).
typedef double Coordinate(const void *context, int i, int axis);

static json_t *bounds(const void *context, int count, Coordinate *at) {
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (int i = 0; i < count; i++)
        for (int axis = 0; axis < 3; axis++) {
            low[axis] = fmin(low[axis], at(context, i, axis));
            high[axis] = fmax(high[axis], at(context, i, axis));
        }
    json_t *object = json_object();
    if (count == 0) return object; // nothing has no bounds
    json_object_set_new(object, "min", number_list(low, 3));
    json_object_set_new(object, "max", number_list(high, 3));
    return object;
}

static double mean_of_splat(const void *model, int i, int axis) { return gaussians_at(model, FIELD_MEAN, i)[axis]; }

static double place_of_point(const void *points, int i, int axis) {
    return ((const Points *)points)->xyz[3 * i + axis];
}

static json_t *opacities(const Gaussians *model) {
    size_t count = (size_t)model->count;
    double *values = mem_alloc(count, sizeof *values);
    for (size_t i = 0; i < count; i++) values[i] = 1 / (1 + exp(-(double)model->field[FIELD_OPACITY_LOGIT][i]));
    json_t *object = quantiles(values, count);
    mem_free(values);
    return object;
}

// Of all three axes of all splats.
static json_t *scales(const Gaussians *model) {
    size_t count = 3 * (size_t)model->count;
    double *values = mem_alloc(count, sizeof *values);
    for (size_t i = 0; i < count; i++) values[i] = exp((double)model->field[FIELD_LOG_SCALE][i]);
    json_t *object = quantiles(values, count);
    mem_free(values);
    return object;
}

json_t *facts_of_model(const Gaussians *model, size_t file_bytes) {
    json_t *facts = json_object();
    int floats = gaussians_floats_per_splat(model->sh_degree);
    json_object_set_new(facts, "kind", json_string("model"));
    json_object_set_new(facts, "splats", json_integer(model->count));
    json_object_set_new(facts, "sh_degree", json_integer(model->sh_degree));
    json_object_set_new(facts, "floats_per_splat", json_integer(floats));
    json_object_set_new(facts, "file_bytes", json_integer((json_int_t)file_bytes));
    json_object_set_new(facts, "bounds_world", bounds(model, model->count, mean_of_splat));
    json_object_set_new(facts, "opacity", opacities(model));
    json_object_set_new(facts, "scale_world", scales(model));
    return facts;
}

json_t *facts_of_points(const Points *points, size_t file_bytes) {
    json_t *facts = json_object();
    json_object_set_new(facts, "kind", json_string("points"));
    json_object_set_new(facts, "points", json_integer(points->count));
    json_object_set_new(facts, "file_bytes", json_integer((json_int_t)file_bytes));
    json_object_set_new(facts, "bounds_world", bounds(points, points->count, place_of_point));
    return facts;
}
