// fit2d_folder.c - names, and the comparison.
#include "lab/app/fit2d_folder.h"

#include "lab/app/fit_views.h"
#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/io/file.h"
#include "lab/io/image_io.h"
#include "splat2d/scene2d_json.h"

#include <stddef.h>

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

static bool save_comparison(const char *path, const ImageF *photo, const ImageF *picture, const Scene2d *scene) {
    int right = photo->width + GAP_PX, below = photo->height + GAP_PX;
    ImageF error = fit_view_error(photo, picture), discs = fit_view_discs(scene);
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
