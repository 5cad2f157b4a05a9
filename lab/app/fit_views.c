// fit_views.c - the error, and the blobs as discs.
#include "lab/app/fit_views.h"

#include "splat2d/raster2d.h"

#include <math.h>
#include <stddef.h>

ImageF fit_view_error(const ImageF *photo, const ImageF *picture) {
    ImageF error = imagef_create(photo->width, photo->height, 3);
    ptrdiff_t values = (ptrdiff_t)photo->width * photo->height * 3;
    for (ptrdiff_t i = 0; i < values; i++)
        error.values[i] = FIT_ERROR_GAIN * fabsf(photo->values[i] - picture->values[i]);
    return error;
}

ImageF fit_view_discs(const Scene2d *scene) {
    ImageF discs = imagef_create(scene->width, scene->height, 3);
    RasterSettings settings = raster_settings_default();
    settings.discs = true;
    Raster2d raster = {0};
    raster2d_load(&raster, scene, view2d_whole());
    raster2d_draw(&raster, &settings, &discs, NULL);
    raster2d_destroy(&raster);
    return discs;
}
