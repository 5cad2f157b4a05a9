// reference.c - the whole picture, forward and back, and the filler of the Rasterizer table.
#include "splat3d/reference.h"

#include "lab/base/mem.h"

PictureD pictured_create(int width, int height) {
    size_t pixels = (size_t)width * (size_t)height;
    return (PictureD){.width = width,
                      .height = height,
                      .rgb = mem_alloc(3 * pixels, sizeof(double)),
                      .transmittance = mem_alloc(pixels, sizeof(double))};
}

void pictured_destroy(PictureD *p) {
    mem_free(p->rgb);
    mem_free(p->transmittance);
    *p = (PictureD){0};
}

static Splat2 *project_all(const GaussiansD *g, const Camera *camera, const RenderSettings *settings) {
    Splat2 *splats = mem_alloc((size_t)g->count, sizeof(Splat2));
    for (int i = 0; i < g->count; i++) reference_project_forward(g, i, camera, settings, &splats[i]);
    return splats;
}

void reference_render_forward(const GaussiansD *g, const Camera *camera, const RenderSettings *settings,
                              PictureD *picture) {
    *picture = pictured_create(camera->width, camera->height);
    Splat2 *splats = project_all(g, camera, settings);
    reference_blend_forward(splats, g->count, settings, picture);
    mem_free(splats);
}

void reference_render_backward(const GaussiansD *g, const Camera *camera, const RenderSettings *settings,
                               const double *d_rgb, GaussiansD *d_model) {
    *d_model = gaussiansd_create(g->count, g->sh_degree);
    Splat2 *splats = project_all(g, camera, settings);
    Splat2Gradient *d_splats = mem_alloc((size_t)g->count, sizeof(Splat2Gradient));
    reference_blend_backward(splats, g->count, settings, camera->width, camera->height, d_rgb, d_splats);
    for (int i = 0; i < g->count; i++) reference_project_backward(g, i, camera, settings, &d_splats[i], d_model);
    mem_free(d_splats);
    mem_free(splats);
}

// ---- the filler of the Rasterizer table: floats at both ends, doubles between ----

static bool table_render(Rasterizer *self, const Gaussians *model, const Camera *camera, const RenderSettings *settings,
                         Picture *picture) {
    (void)self;
    GaussiansD g = gaussiansd_from(model);
    PictureD precise;
    reference_render_forward(&g, camera, settings, &precise);
    size_t pixels = (size_t)precise.width * (size_t)precise.height;
    picture->rgb = imagef_create(precise.width, precise.height, 3);
    picture->alpha = imagef_create(precise.width, precise.height, 1);
    for (size_t k = 0; k < 3 * pixels; k++) picture->rgb.values[k] = (float)precise.rgb[k];
    for (size_t k = 0; k < pixels; k++) picture->alpha.values[k] = (float)(1 - precise.transmittance[k]);
    pictured_destroy(&precise);
    gaussiansd_destroy(&g);
    return true;
}

static bool table_backward(Rasterizer *self, const Gaussians *model, const Camera *camera,
                           const RenderSettings *settings, const ImageF *d_rgb, Gaussians *d_model) {
    (void)self;
    size_t numbers = 3 * (size_t)camera->width * (size_t)camera->height;
    double *d_precise = mem_alloc(numbers, sizeof(double));
    for (size_t k = 0; k < numbers; k++) d_precise[k] = d_rgb->values[k];
    GaussiansD g = gaussiansd_from(model), d_g;
    reference_render_backward(&g, camera, settings, d_precise, &d_g);
    *d_model = gaussiansd_to_float(&d_g);
    gaussiansd_destroy(&d_g);
    gaussiansd_destroy(&g);
    mem_free(d_precise);
    return true;
}

static void table_destroy(Rasterizer *self) { mem_free(self); }

Rasterizer *reference_rasterizer_create(void) {
    static const RasterizerApi api = {"reference", table_render, table_backward, NULL, table_destroy};
    Rasterizer *rasterizer = mem_alloc(1, sizeof *rasterizer);
    rasterizer->api = &api;
    return rasterizer;
}
