// transforms_write.c - a scene as nerfstudio's transforms.json: OpenGL camera-to-world, intrinsics with each frame.
#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/io/file.h"
#include "lab/io/json_io.h"
#include "splat3d/dataset.h"

#include <string.h>

// The path as seen from the folder of the file, where it stands below it.
static const char *relative(const char *path, const char *folder) {
    size_t length = strlen(folder);
    return strncmp(path, folder, length) == 0 && path[length] == '/' ? path + length + 1 : path;
}

static json_t *matrix_rows(const double m[16]) {
    json_t *rows = json_array();
    for (int i = 0; i < 4; i++)
        json_array_append_new(rows, json_pack("[f,f,f,f]", m[4 * i], m[4 * i + 1], m[4 * i + 2], m[4 * i + 3]));
    return rows;
}

static json_t *frame_of(const View *view, const char *folder) {
    const Camera *camera = &view->camera;
    double matrix[16];
    camera_pose_to_opengl(camera, matrix);
    return json_pack("{s:s, s:i, s:i, s:f, s:f, s:f, s:f, s:o}", "file_path", relative(view->path, folder), "w",
                     camera->width, "h", camera->height, "fl_x", camera->fx, "fl_y", camera->fy, "cx", camera->cx, "cy",
                     camera->cy, "transform_matrix", matrix_rows(matrix));
}

bool transforms_write(const char *path, const Dataset *dataset) {
    char *folder = file_folder_of(path);
    json_t *frames = json_array();
    bool ok = true;
    for (int i = 0; ok && i < dataset->view_count; i++)
        if (json_array_append_new(frames, frame_of(&dataset->views[i], folder)) != 0)
            ok = fail("cannot write %s: view %s has a name that is no UTF-8 or a camera that is not finite", path,
                      dataset->views[i].name);
    json_t *root = json_pack("{s:s, s:o}", "camera_model", "PINHOLE", "frames", frames);
    ok = ok && json_write(path, root);
    json_decref(root);
    mem_free(folder);
    return ok;
}
