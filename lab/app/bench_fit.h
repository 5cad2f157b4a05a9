// bench_fit.h - the laws that the rows of a scaling run follow: how the cost of the blends depends on the work.
#ifndef SPLATLAB_LAB_APP_BENCH_FIT_H
#define SPLATLAB_LAB_APP_BENCH_FIT_H

#include <jansson.h>

// rows: of bench_scaling_run(); those of that thread count are used (at least three, of different size). The caller owns
//     {"threads",
//      "evaluated_pairs": {"exponent", "scatter"}, "pixels_times_splats": {"exponent", "scatter"},
//      "law": {"ns_per_evaluated_pair", "ns_per_tile_pair", "ns_per_pixel", "scatter", "worst"}}
// The first two are cost = constant * work^exponent, by least squares of the logarithms; scatter is the standard deviation of ln(cost).
// The law is cost = a * evaluated pairs + b * tile pairs + c * pixels, CPU nanoseconds, by least squares of the relative errors; scatter is
// their root mean square, worst the largest.
json_t *bench_fit_rows(const json_t *rows, int threads);

#endif
