#include "splat3d/rasterizer.h"

RenderSettings render_settings_default(void) {
    return (RenderSettings){
        .sh_degree = SH_DEGREE_MAX,
        .what = RENDER_COLOUR,
        .alpha_max = ALPHA_MAX,
        .near_depth = NEAR_DEPTH,
        .low_pass_px2 = LOW_PASS_PX2,
        .stop_rule = STOP_AFTER_BLEND,
    };
}

void picture_destroy(Picture *picture) {
    imagef_destroy(&picture->rgb);
    imagef_destroy(&picture->alpha);
}

bool rasterizer_render(Rasterizer *r, const Gaussians *model, const Camera *camera, const RenderSettings *settings,
                       Picture *picture) {
    *picture = (Picture){0};
    return r->api->render(r, model, camera, settings, picture);
}

bool rasterizer_backward(Rasterizer *r, const Gaussians *model, const Camera *camera, const RenderSettings *settings,
                         const ImageF *d_rgb, Gaussians *d_model) {
    *d_model = (Gaussians){0};
    return r->api->backward(r, model, camera, settings, d_rgb, d_model);
}

bool rasterizer_hold(Rasterizer *r, const Gaussians *model) { return !r->api->hold || r->api->hold(r, model); }

void rasterizer_destroy(Rasterizer *r) {
    if (r) r->api->destroy(r);
}
