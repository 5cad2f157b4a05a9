// project_forward.cl - every Gaussian of the model becomes one splat on the screen, with its colour and the tiles it may touch.
//
//     mean2d = (fx x/z + cx, fy y/z + cy)                        p = R m + t in camera axes
//     Sigma' = J W Sigma W^T J^T + low_pass I                    projection.h (Kerbl et al. 2023, eq. 5)
//     colour = max(0, sum_k sh_k Y_k(direction) + 1/2)           direction from the camera to the mean (section 4)
//     opacity = 1 / (1 + exp(-logit)), kept as log2
// The splat ends where alpha falls below ALPHA_MIN, so the box is as large as its opacity lets it be:
//     m^2 <= 2 ln(opacity / ALPHA_MIN),   half width = m sqrt(Sigma'_xx),   half height = m sqrt(Sigma'_yy)
//
//     mean (N,3), log_scale (N,3), quat (N,4), opacity_logit (N), sh0 (N,1,3), sh1 (N,3,3), sh2 (N,5,3), sh3 (N,7,3):
//         the model, in groups of sixteen splats (splat_lanes.h); degrees above frame.sh_degree are not read
//     screen (N): the splat; without meaning when it is not visible
//     box (N): its tiles, all zero when it is not visible
//     depth (N): camera z, world units; without meaning when it is not visible
//
// One work-item: LANES Gaussians (splat_lanes.h): one on a GPU, sixteen on a CPU. Local memory: none.
// Reference: reference_project_forward(). Test: tests/splat3d/test_opencl_project.c.
#include "shared.h"

#include "extent.h"
#include "projection.h"
#include "sh_basis.h"
#include "sh_field.h"

// Tiles of pixels whose centres lie in centre +- half, in one direction; false when there is none.
static Int tile_range(Real centre, Real half_extent, int pixels, Int *first, Int *end) {
    const Real reach = half_extent + EXTENT_MARGIN_PX(centre, half_extent);
    const Real low = centre - reach - 0.5f, high = centre + reach - 0.5f;
    const Real zero = (Real)(0.0f), last = (Real)((float)(pixels - 1));
    const Int touches = high >= zero && low <= last;
    // Rounded by truncating numbers >= 0: ceil() and floor() are slow calls on some devices.
    const Real from = select(zero, low, low > zero), to = select(last, high, high < last);
    const Int down = INT_OF(from), last_pixel = INT_OF(to);
    const Int first_pixel = select(down, down + 1, REAL_OF(down) < from);
    *first = first_pixel / TILE_SIZE;
    *end = last_pixel / TILE_SIZE + 1;
    return touches && first_pixel <= last_pixel;
}

// Of splats in view; their covariance is in p.
static Vec3 colour_of(const FrameRecord *frame, const Projection *p, Vec3 mean_world, __global const float *sh0,
                      __global const float *sh1, __global const float *sh2, __global const float *sh3) {
    const Real zero = (Real)(0.0f);
    if (frame->is_depth) return vec3(p->point.z, zero + 1.0f, zero);
    const Vec3 offset = vec3_sub(mean_world, vec3_all(frame->position));
    Real basis[SH_BASIS];
    sh_basis(frame->sh_degree, vec3_scale(offset, 1.0f / sqrt(vec3_dot(offset, offset))), basis);
    const Vec3 higher = sh_colour(frame->sh_degree, basis, sh1, sh2, sh3);
    const Vec3 dc = lanes_load3(sh0, 0);
    return vec3(max(SH_C0 * dc.x + 0.5f + higher.x, zero), max(SH_C0 * dc.y + 0.5f + higher.y, zero),
                max(SH_C0 * dc.z + 0.5f + higher.z, zero));
}

#define NUMBERS (int)(sizeof(ScreenSplat) / sizeof(float))

#if LANES == 1

static void store_splats(const Real *splat, const Int *tiles, int i, __global ScreenSplat *screen,
                         __global TileBox *box) {
    const TileBox range = {tiles[0], tiles[1], tiles[2], tiles[3]};
    __global float *out = (__global float *)(screen + i);
    box[i] = range;
    if (range.x0 == range.x1) return;
    for (int k = 0; k < NUMBERS; k++) out[k] = splat[k];
}

#else

// Twelve numbers and four tile bounds of each splat: one square of sixteen.
static void store_splats(const Real *splat, const Int *tiles, int first, __global ScreenSplat *screen,
                         __global TileBox *box) {
    float16 rows[LANES];
    for (int k = 0; k < NUMBERS; k++) rows[k] = splat[k];
    for (int k = 0; k < 4; k++) rows[NUMBERS + k] = as_float16(tiles[k]);
    transpose16(rows);
    for (int lane = 0; lane < LANES; lane++) {
        vstore8(rows[lane].lo, 0, (__global float *)(screen + first + lane));
        vstore4(rows[lane].s89ab, 2, (__global float *)(screen + first + lane));
        vstore4(rows[lane].scdef, 0, (__global float *)(box + first + lane));
    }
}

#endif

__kernel void project_forward(const FrameRecord frame, __global const float *mean, __global const float *log_scale,
                              __global const float *quat, __global const float *opacity_logit,
                              __global const float *sh0, __global const float *sh1, __global const float *sh2,
                              __global const float *sh3, __global ScreenSplat *screen, __global TileBox *box,
                              __global float *depth) {
    const int first = (int)get_global_id(0) * LANES;
    if (first >= frame.splat_count) return;
    Real splat[NUMBERS]; // in the record's order
    Int tiles[4] = {(Int)(0), (Int)(0), (Int)(0), (Int)(0)};
    for (int k = 0; k < NUMBERS; k++) splat[k] = (Real)(0.0f);

    const Vec3 mean_world = lanes_load3(mean + lanes_at(first, 3), 0);
    const Real log2_opacity = -log2(1.0f + exp(-lanes_load(opacity_logit + first, 0)));
    const Real reach2 = 2.0f / LOG2_E * (log2_opacity - LOG2_ALPHA_MIN); // m^2 where alpha = ALPHA_MIN
    Projection p;
    Int visible = projection_compute(&frame, mean_world, log_scale + lanes_at(first, 3), quat + lanes_at(first, 4), &p);
    visible = visible && reach2 >= 0 && LANE_NUMBERS + first < (Int)(frame.splat_count);
    if (ANY(visible)) {
        const Real inv_z = 1.0f / p.point.z;
        splat[0] = frame.focal[0] * (p.point.x * inv_z) + frame.centre[0];
        splat[1] = frame.focal[1] * (p.point.y * inv_z) + frame.centre[1];
        splat[2] = -0.5f * LOG2_E * p.inv_var_u;
        splat[3] = -0.5f * LOG2_E * p.inv_var_v;
        splat[4] = p.shear;
        splat[5] = log2_opacity;
        const Real half_width = sqrt(reach2 * p.xx), half_height = sqrt(reach2 * p.yy);
        splat[9] = half_width;
        splat[10] = half_height;
        splat[11] = p.xy / p.xx * half_width;
        const Int in_columns = tile_range(splat[0], half_width, frame.width, &tiles[0], &tiles[2]);
        const Int in_rows = tile_range(splat[1], half_height, frame.height, &tiles[1], &tiles[3]);
        visible = visible && in_columns && in_rows;
        for (int k = 0; k < 4; k++) tiles[k] = select((Int)(0), tiles[k], visible);
    }
    if (ANY(visible)) {
        const Vec3 colour = colour_of(&frame, &p, mean_world, sh0 + lanes_at(first, 3), sh1 + lanes_at(first, 9),
                                      sh2 + lanes_at(first, 15), sh3 + lanes_at(first, 21));
        splat[6] = colour.x, splat[7] = colour.y, splat[8] = colour.z;
        lanes_store(p.point.z, depth + first, 0);
    }
    store_splats(splat, tiles, first, screen, box);
}
