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
//         the model; degrees above frame.sh_degree are not read
//     screen (N): the splat; not written when it is not visible
//     box (N): its tiles, all zero when it is not visible
//     depth (N): camera z, world units; not written when it is not visible
//
// One work-item: one Gaussian. Local memory: none. Reference: reference_project_forward(). Test: tests/splat3d/test_opencl_project.c.
#include "shared.h"

#include "extent.h"
#include "projection.h"
#include "sh_basis.h"

static float3 sh_sum(int count, const float *basis, __global const float *sh) {
    float3 sum = 0;
    for (int k = 0; k < count; k++) sum += basis[k] * vload3(k, sh);
    return sum;
}

// Tiles of pixels whose centres lie in centre +- half, in one direction; false when there is none.
static bool tile_range(float centre, float half_extent, int pixels, int *first, int *end) {
    const float reach = half_extent + extent_margin_px(centre, half_extent);
    const float low = centre - reach - 0.5f, high = centre + reach - 0.5f;
    if (!(high >= 0 && low <= (float)(pixels - 1))) return false;
    // Rounded by truncating numbers >= 0: ceil() and floor() are slow calls on some devices.
    const float from = low > 0 ? low : 0, to = high < pixels - 1 ? high : pixels - 1;
    const int first_pixel = (int)from + ((float)(int)from < from), last_pixel = (int)to;
    *first = first_pixel / TILE_SIZE;
    *end = last_pixel / TILE_SIZE + 1;
    return first_pixel <= last_pixel;
}

__kernel void project_forward(const FrameRecord frame, __global const float *mean, __global const float *log_scale,
                              __global const float *quat, __global const float *opacity_logit,
                              __global const float *sh0, __global const float *sh1, __global const float *sh2,
                              __global const float *sh3, __global ScreenSplat *screen, __global TileBox *box,
                              __global float *depth) {
    const int i = (int)get_global_id(0);
    if (i >= frame.splat_count) return;
    const TileBox nowhere = {0, 0, 0, 0};
    box[i] = nowhere;

    const float3 mean_world = vload3(i, mean);
    const float log2_opacity = -log2(1.0f + exp(-opacity_logit[i]));
    const float reach2 = 2.0f / LOG2_E * (log2_opacity - LOG2_ALPHA_MIN); // m^2 where alpha = ALPHA_MIN
    Projection p;
    if (!(reach2 >= 0) || !projection_compute(&frame, mean_world, vload3(i, log_scale), vload4(i, quat), &p)) return;

    ScreenSplat splat;
    splat.x = frame.focal[0] * (p.point.x / p.point.z) + frame.centre[0];
    splat.y = frame.focal[1] * (p.point.y / p.point.z) + frame.centre[1];
    splat.along_u = -0.5f * LOG2_E * p.inv_var_u;
    splat.along_v = -0.5f * LOG2_E * p.inv_var_v;
    splat.shear = p.shear;
    splat.log2_opacity = log2_opacity;
    splat.half_width = sqrt(reach2 * p.xx);
    splat.half_height = sqrt(reach2 * p.yy);
    splat.widest_dy = p.xy / p.xx * splat.half_width;

    TileBox tiles;
    if (!tile_range(splat.x, splat.half_width, frame.width, &tiles.x0, &tiles.x1)) return;
    if (!tile_range(splat.y, splat.half_height, frame.height, &tiles.y0, &tiles.y1)) return;

    float3 colour = (float3)(p.point.z, 1, 0);
    if (!frame.is_depth) {
        const float3 position = (float3)(frame.position[0], frame.position[1], frame.position[2]);
        const float3 offset = mean_world - position;
        const float3 direction = offset / sqrt(dot(offset, offset));
        float basis[7];
        colour = SH_C0 * vload3(i, sh0) + 0.5f;
        if (frame.sh_degree >= 1) {
            sh_basis1(direction, basis);
            colour += sh_sum(3, basis, sh1 + 9 * i);
        }
        if (frame.sh_degree >= 2) {
            sh_basis2(direction, basis);
            colour += sh_sum(5, basis, sh2 + 15 * i);
        }
        if (frame.sh_degree >= 3) {
            sh_basis3(direction, basis);
            colour += sh_sum(7, basis, sh3 + 21 * i);
        }
    }
    splat.r = max(colour.x, 0.0f);
    splat.g = max(colour.y, 0.0f);
    splat.b = max(colour.z, 0.0f);
    screen[i] = splat;
    box[i] = tiles;
    depth[i] = p.point.z;
}
