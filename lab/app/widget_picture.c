// widget_picture.c - the scene as pixels on the screen, made anew only when something changed.
#include "lab/app/widget.h"
#include "lab/base/clock.h"
#include "lab/base/mem.h"
#include "lab/base/parallel.h"

#include <math.h>
#include <stddef.h>

// The mean opacity is taken on a grid of every MEAN_STEPth pixel of the canvas: blobs are smooth.
enum { MEAN_STEP = 4 };

static void fit_buffers(Widget *widget, int width, int height) {
    if (widget->picture.width == width && widget->picture.height == height) return;
    size_t pixels = (size_t)width * (size_t)height;
    imagef_destroy(&widget->picture);
    image8_destroy(&widget->picture8);
    mem_free(widget->maps.transmittance);
    mem_free(widget->maps.visits);
    widget->picture = imagef_create(width, height, 3);
    widget->picture8 = image8_create(width, height, 3);
    widget->maps = (RasterMaps){mem_alloc(pixels, sizeof(float)), mem_alloc(pixels, sizeof(int))};
}

// Dark blue over violet and orange to pale yellow, t in [0, 1]: ordered in brightness, so that grey projectors show it too.
// Few are told apart better than many.
void widget_heat(double t, double rgb[3]) {
    static const double stops[5][3] = {
        {0.04, 0.05, 0.12}, {0.29, 0.10, 0.42}, {0.72, 0.22, 0.33}, {0.96, 0.55, 0.20}, {0.99, 0.95, 0.72}};
    double place = 4 * sqrt(fmin(1, fmax(0, t)));
    int i = place >= 4 ? 3 : (int)place;
    for (int c = 0; c < 3; c++) rgb[c] = stops[i][c] + (place - i) * (stops[i + 1][c] - stops[i][c]);
}

static uint8_t byte_of(float value) { return (uint8_t)(255 * (value > 0 ? value < 1 ? value : 1 : 0) + 0.5f); }

static void colours_to_bytes(const float *values, int count, uint8_t *bytes) {
    for (int i = 0; i < count; i++) bytes[i] = byte_of(values[i]);
}

static void row_to_bytes(void *context, int row) {
    const Widget *widget = context;
    ptrdiff_t first = (ptrdiff_t)row * widget->picture.width;
    uint8_t *bytes = widget->picture8.bytes + 3 * first;
    int most = widget->scene.count > 0 ? widget->scene.count : 1;
    if (widget->layer == LAYER_COLOUR) {
        colours_to_bytes(widget->picture.values + 3 * first, 3 * widget->picture.width, bytes);
        return;
    }
    for (int x = 0; x < widget->picture.width; x++) {
        double rgb[3];
        if (widget->layer == LAYER_TRANSMITTANCE)
            rgb[0] = rgb[1] = rgb[2] = widget->maps.transmittance[first + x];
        else
            widget_heat((double)widget->maps.visits[first + x] / most, rgb);
        for (int c = 0; c < 3; c++) bytes[3 * x + c] = byte_of((float)rgb[c]);
    }
}

static double mean_opacity(Widget *widget) {
    int width = (widget->scene.width + MEAN_STEP - 1) / MEAN_STEP;
    int height = (widget->scene.height + MEAN_STEP - 1) / MEAN_STEP;
    ImageF grid = imagef_create(width, height, 3);
    raster2d_load(&widget->raster, &widget->scene, (View2d){.left = 0, .top = 0, .zoom = 1.0 / MEAN_STEP});
    double mean = raster2d_draw(&widget->raster, &widget->settings, &grid, NULL);
    imagef_destroy(&grid);
    return mean;
}

void widget_picture(Widget *widget, int width, int height) {
    if (!widget->is_stale && widget->picture.width == width && widget->picture.height == height) return;
    fit_buffers(widget, width, height);
    double began_s = clock_seconds();
    View2d view = widget->canvas.view;
    view.zoom *= gui_density(); // the picture is made for px
    raster2d_load(&widget->raster, &widget->scene, view);
    if (widget->shows_mine)
        widget_mine_draw(widget, view);
    else
        raster2d_draw(&widget->raster, &widget->settings, &widget->picture, &widget->maps);
    widget->raster_ms = 1e3 * (clock_seconds() - began_s);
    parallel_for(height, row_to_bytes, widget);
    gui_picture_fill(0, &widget->picture8, true);
    widget->mean_opacity = mean_opacity(widget);
    raster2d_load(&widget->raster, &widget->scene, view2d_whole());
    widget->is_stale = false;
}
