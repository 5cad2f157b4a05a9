#include "splat3d/frame_record.h"

#include "lab/base/fail.h"

enum { PICTURE_SIDE_MAX = 32768 }; // px; half pixels stay exact in float, and indices within int

static bool check(const Camera *camera, const RenderSettings *settings) {
    if (settings->stop_rule != STOP_AFTER_BLEND)
        return fail("the OpenCL kernels know one stop rule, after blending; render with the C reference for the other");
    if (!(settings->alpha_max >= ALPHA_MIN && settings->alpha_max < 1))
        return fail("alpha_max is %g, the kernels want 1/255 <= alpha_max < 1; the usual value is %g",
                    settings->alpha_max, ALPHA_MAX);
    if (!(settings->near_depth > 0) || !(settings->low_pass_px2 >= 0))
        return fail("near_depth is %g and low_pass_px2 %g, want > 0 and >= 0; the usual values are %g and %g",
                    settings->near_depth, settings->low_pass_px2, NEAR_DEPTH, LOW_PASS_PX2);
    if (camera->width < 1 || camera->height < 1 || camera->width > PICTURE_SIDE_MAX ||
        camera->height > PICTURE_SIDE_MAX)
        return fail("a picture of %d x %d cannot be rendered, want 1 to %d pixels a side; check the camera's size",
                    camera->width, camera->height, PICTURE_SIDE_MAX);
    if (!(camera->fx > 0 && camera->fy > 0))
        return fail("focal lengths are %g, %g px, want > 0; check the camera", camera->fx, camera->fy);
    return true;
}

// Where x/z is clamped for the Jacobian: the picture's edges, seen from the camera, and a margin.
static void ratio_range(double pixels, double focal, double centre, float *low, float *high) {
    const double margin = FRUSTUM_MARGIN * pixels / (2 * focal);
    *low = (float)(-centre / focal - margin);
    *high = (float)((pixels - centre) / focal + margin);
}

bool frame_record_make(const Camera *camera, const RenderSettings *settings, int splat_count, int model_sh_degree,
                       FrameRecord *frame) {
    if (!check(camera, settings)) return false;
    const Vec3 position = camera_position(camera);
    const int tiles_x = (camera->width + TILE_SIZE - 1) / TILE_SIZE;
    const int tiles_y = (camera->height + TILE_SIZE - 1) / TILE_SIZE;
    *frame = (FrameRecord){
        .translation = {(float)camera->translation.x, (float)camera->translation.y, (float)camera->translation.z},
        .position = {(float)position.x, (float)position.y, (float)position.z},
        .focal = {(float)camera->fx, (float)camera->fy},
        .centre = {(float)camera->cx, (float)camera->cy},
        .near_depth = settings->near_depth,
        .low_pass_px2 = settings->low_pass_px2,
        .alpha_max = settings->alpha_max,
        .width = camera->width,
        .height = camera->height,
        .stride = tiles_x * TILE_SIZE,
        .rows = tiles_y * TILE_SIZE,
        .tiles_x = tiles_x,
        .tiles_y = tiles_y,
        .splat_count = splat_count,
        .sh_degree = settings->sh_degree < model_sh_degree ? settings->sh_degree : model_sh_degree,
        .is_depth = settings->what == RENDER_DEPTH,
    };
    for (int k = 0; k < 9; k++) frame->rotation[k] = (float)camera->rotation.m[k];
    for (int c = 0; c < 3; c++) frame->background[c] = settings->background[c];
    ratio_range(camera->width, camera->fx, camera->cx, &frame->ratio_low[0], &frame->ratio_high[0]);
    ratio_range(camera->height, camera->fy, camera->cy, &frame->ratio_low[1], &frame->ratio_high[1]);
    return true;
}
