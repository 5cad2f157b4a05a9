#include "splat3d/scene_folder.h"

#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/io/file.h"

#include <string.h>
#include <unistd.h>

static const char TITLE[] = "# A sample scene of splatlab\n"; // tells our folders from those of others

static bool write_readme(const char *folder, const char *text) {
    char *path = file_join(folder, "README.md"), *whole = mem_format("%s\n%s", TITLE, text);
    bool ok = file_write(path, whole, strlen(whole));
    mem_free(whole);
    mem_free(path);
    return ok;
}

static bool is_ours(const char *folder) {
    char *path = file_join(folder, "README.md"), *text = NULL;
    size_t size;
    bool ours = file_exists(path) && file_read(path, &text, &size) && strncmp(text, TITLE, strlen(TITLE)) == 0;
    mem_free(text);
    mem_free(path);
    return ours;
}

static void remove_in(const char *folder, const char *name) {
    char *path = file_join(folder, name);
    remove(path);
    mem_free(path);
}

// The files view_*ENDING of a folder, then the folder if that was all.
static void remove_views(const char *folder, const char *inner, const char *ending) {
    char *path = file_join(folder, inner), **names;
    int count;
    if (file_is_folder(path) && file_list(path, &names, &count)) {
        for (int i = 0; i < count; i++)
            if (strncmp(names[i], "view_", 5) == 0 && file_has_ending(names[i], ending)) remove_in(path, names[i]);
        file_list_free(names, count);
    }
    rmdir(path);
    mem_free(path);
}

void scene_folder_remove(const char *folder) {
    static const char *const files[] = {
        "sparse/0/cameras.bin", "sparse/0/images.bin", "sparse/0/points3D.bin", "sparse/0", "sparse",
        "transforms.json"};
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++) remove_in(folder, files[i]);
    remove_views(folder, "images", ".png");
    remove_views(folder, "depth", ".exr");
    remove_in(folder, "README.md"); // last: without it the rest is no longer recognised as ours
    rmdir(folder);
}

static bool check_empty(const char *folder) {
    char **names;
    int count;
    if (!file_list(folder, &names, &count)) return false;
    bool empty = count == 0;
    if (!empty)
        fail("%s holds other things (%s): a sample scene needs an empty folder; give another one with -o", folder,
             names[0]);
    file_list_free(names, count);
    return empty;
}

static bool make_inner(const char *folder, const char *name) {
    char *path = file_join(folder, name);
    bool ok = file_make_folder(path);
    mem_free(path);
    return ok;
}

bool scene_folder_begin(const char *folder) {
    if (!file_make_folder(folder)) return false;
    if (is_ours(folder))
        scene_folder_remove(folder);
    else if (!check_empty(folder))
        return false;
    return file_make_folder(folder) &&
           write_readme(folder, "Unfinished: it is being written, or writing was broken off.\n") &&
           make_inner(folder, "images") && make_inner(folder, "depth");
}

bool scene_folder_finish(const char *folder, const char *text) { return write_readme(folder, text); }
