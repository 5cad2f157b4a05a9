// fit2d_folder.c - names, and the comparison.
#include "lab/app/fit2d_folder.h"

#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/io/file.h"
#include "lab/io/image_io.h"
#include "splat2d/raster2d.h"
#include "splat2d/scene2d_json.h"

#include <math.h>
#include <stddef.h>

static const float ERROR_GAIN = 4;
enum { GAP_PX = 4 }; // between the panels

bool fit2d_folder_begin(const char *folder, Fit2dFolder *names) {
    static const char *const files[] = {".png", ".jpg", ".jpeg", ".gif", ".json"};
    *names = (Fit2dFolder){0};
    if (!folder[0]) return fail_usage("where to? -o FOLDER");
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++)
        if (file_has_ending(folder, files[i]))
            return fail_usage("--output %s: give the name of a folder; the picture will be fit.png in it", folder);
    if (!file_make_folder(folder) || !file_can_write_in(folder)) return false;
    *names = (Fit2dFolder){.folder = mem_text(folder),
                           .picture = file_join(folder, "fit.png"),
                           .scene = file_join(folder, "fit.json"),
                           .comparison = file_join(folder, "comparison.png"),
                           .film = file_join(folder, "fit.gif")};
    return true;
}

void fit2d_folder_forget(Fit2dFolder *names) {
    char *all[] = {names->folder, names->picture, names->scene, names->comparison, names->film};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) mem_free(all[i]);
    *names = (Fit2dFolder){0};
}

static ImageF error_picture(const ImageF *photo, const ImageF *picture) {
    ImageF error = imagef_create(photo->width, photo->height, 3);
    ptrdiff_t values = (ptrdiff_t)photo->width * photo->height * 3;
    for (ptrdiff_t i = 0; i < values; i++) error.values[i] = ERROR_GAIN * fabsf(photo->values[i] - picture->values[i]);
    return error;
}

// Each blob as its ellipse of one standard deviation.
static ImageF disc_picture(const Scene2d *scene) {
    ImageF discs = imagef_create(scene->width, scene->height, 3);
    RasterSettings settings = raster_settings_default();
    settings.discs = true;
    Raster2d raster = {0};
    raster2d_load(&raster, scene, view2d_whole());
    raster2d_draw(&raster, &settings, &discs, NULL);
    raster2d_destroy(&raster);
    return discs;
}

static bool save_comparison(const char *path, const ImageF *photo, const ImageF *picture, const Scene2d *scene) {
    int right = photo->width + GAP_PX, below = photo->height + GAP_PX;
    ImageF error = error_picture(photo, picture), discs = disc_picture(scene);
    ImageF sheet = imagef_create(right + photo->width, below + photo->height, 3);
    imagef_paste(&sheet, photo, 0, 0);
    imagef_paste(&sheet, picture, right, 0);
    imagef_paste(&sheet, &discs, 0, below);
    imagef_paste(&sheet, &error, right, below);
    bool good = image_savef(path, &sheet);
    imagef_destroy(&sheet);
    imagef_destroy(&discs);
    imagef_destroy(&error);
    return good;
}

bool fit2d_folder_save(const Fit2dFolder *names, const ImageF *photo, const ImageF *picture, const Scene2d *scene) {
    return image_savef(names->picture, picture) && scene2d_save(names->scene, scene) &&
           save_comparison(names->comparison, photo, picture, scene);
}
