#include "lab/app/bench_fit.h"

#include "lab/base/vec.h"

#include <math.h>
#include <stdbool.h>

static double number(const json_t *row, const char *key) { return json_number_value(json_object_get(row, key)); }

static double cost_ns(const json_t *row) { return 1e6 * number(row, "blend_cpu_ms"); }
static double evaluated(const json_t *row) { return number(row, "evaluated_pairs"); }
static double pixels(const json_t *row) { return number(row, "width") * number(row, "height"); }
static double pixels_times_splats(const json_t *row) { return pixels(row) * number(row, "splats"); }

static bool counts(const json_t *row, int threads) { return number(row, "threads") == threads; }

static json_t *fit_power(const json_t *rows, int threads, double (*work)(const json_t *)) {
    double n = 0, sum_x = 0, sum_y = 0, sum_xx = 0, sum_xy = 0, sum_yy = 0;
    size_t i;
    const json_t *row;
    json_array_foreach((json_t *)rows, i, row) {
        if (!counts(row, threads)) continue;
        const double x = log(work(row)), y = log(cost_ns(row));
        n++, sum_x += x, sum_y += y, sum_xx += x * x, sum_xy += x * y, sum_yy += y * y;
    }
    const double xx = sum_xx - sum_x * sum_x / n, xy = sum_xy - sum_x * sum_y / n, yy = sum_yy - sum_y * sum_y / n;
    return json_pack("{sf sf}", "exponent", xy / xx, "scatter", sqrt(fmax(yy - xy * xy / xx, 0) / n));
}

// What the law multiplies by its three constants, each divided by the cost: their sum should be 1.
static Vec3 terms(const json_t *row) {
    return vec3_scale(vec3(evaluated(row), number(row, "tile_pairs"), pixels(row)), 1 / cost_ns(row));
}

// The normal equations, sum of t t^T times the constants = sum of t, by Cramer's rule; the matrix is symmetric.
static json_t *fit_law(const json_t *rows, int threads) {
    Vec3 column[3] = {0}, right = {0};
    double n = 0, squares = 0, worst = 0;
    size_t i;
    const json_t *row;
    json_array_foreach((json_t *)rows, i, row) {
        if (!counts(row, threads)) continue;
        const Vec3 t = terms(row);
        column[0] = vec3_add(column[0], vec3_scale(t, t.x));
        column[1] = vec3_add(column[1], vec3_scale(t, t.y));
        column[2] = vec3_add(column[2], vec3_scale(t, t.z));
        right = vec3_add(right, t);
    }
    const double determinant = vec3_dot(column[0], vec3_cross(column[1], column[2]));
    const Vec3 law = vec3(vec3_dot(right, vec3_cross(column[1], column[2])) / determinant,
                          vec3_dot(column[0], vec3_cross(right, column[2])) / determinant,
                          vec3_dot(column[0], vec3_cross(column[1], right)) / determinant);
    json_array_foreach((json_t *)rows, i, row) {
        if (!counts(row, threads)) continue;
        const double error = vec3_dot(law, terms(row)) - 1;
        n++, squares += error * error;
        worst = fmax(worst, fabs(error));
    }
    return json_pack("{sf sf sf sf sf}", "ns_per_evaluated_pair", law.x, "ns_per_tile_pair", law.y, "ns_per_pixel",
                     law.z, "scatter", sqrt(squares / n), "worst", worst);
}

json_t *bench_fit_rows(const json_t *rows, int threads) {
    return json_pack("{si so so so}", "threads", threads, "evaluated_pairs", fit_power(rows, threads, evaluated),
                     "pixels_times_splats", fit_power(rows, threads, pixels_times_splats), "law",
                     fit_law(rows, threads));
}
