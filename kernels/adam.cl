// adam.cl - one step of Adam on one field of all splats (Kingma & Ba 2015, algorithm 1), and unit quaternions.
//
//     m <- beta1 m + (1 - beta1) g          v <- beta2 v + (1 - beta2) g^2
//     x <- x - rate (m / (1 - beta1^t)) / (sqrt(v / (1 - beta2^t)) + epsilon)
// in this order of roundings, each line one operation or one fma:
//     m' = fma(beta1, m, one_minus_beta1 * g)
//     v' = fma(beta2, v, (one_minus_beta2 * g) * g)
//     x' = fma(-rate, m' / fma(sqrt(v'), over_root_v_part, epsilon), x)
// with the bias corrections of t inside rate and over_root_v_part. Gradients of splats are tiny: g = 1e-15 still has a v' of
// 1e-33, well inside float; below 1e-19 v' vanishes, but there epsilon, 1e-15, has long taken its place.
//
// With only_in_view the splats that the frame does not show stay as they are, their moments too, so that groups of them are not even read
// ("sparse" Adam: Mallick et al. 2024).
//
// A number whose gradient, or whose new value or moment, is not finite stays as it is, with its moments, and the lowest such
// (splat, field) is noted; an integer minimum comes out the same in any order.
//
//     box (N): from project_forward.cl; looked at where only splats in view are stepped
//     gradient, value, m, v (N x width): one field, in groups of sixteen splats (SPLAT_GROUP in shared.h), the last one whole as well
//     not_finite (1): ADAM_ALL_FINITE, or splat << ADAM_FIELD_BITS | field
// One work-item: a whole vector, one number of each splat of a group, so that the rare case costs one test for sixteen numbers and
// compilers have nothing to guess. It runs at the speed of memory: 28 bytes a number. Local memory: none.
// Reference: splat2d/adam.c. Test: tests/splat3d/test_opencl_adam.c.
#include "adam_lanes.h"

__kernel void adam(const AdamRecord a, __global const TileBox *box, __global const float *gradient,
                   __global float *value, __global float *m, __global float *v, __global volatile uint *not_finite) {
    const int first = (int)get_global_id(0) * ADAM_LANES, splat = first / (ADAM_LANES * a.width) * ADAM_LANES;
    if (splat >= a.splats) return;
    const int16 stepped = stepped_splats(a.only_in_view, splat, a.splats, box);
    if (!any_of(stepped)) return;
    adam_vector(&a, *(__global const float16 *)(gradient + first), first, stepped, value, m, v, not_finite);
}

// quat (N, 4). One work-item: a group of sixteen splats.
__kernel void normalize_quaternions(const int splats, const int only_in_view, __global const TileBox *box,
                                    __global float *quat) {
    const int first = (int)get_global_id(0) * ADAM_LANES;
    if (first < splats) normalize_group(quat + 4 * first, stepped_splats(only_in_view, first, splats, box));
}
