// colmap_text.c - cameras.txt, images.txt, points3D.txt: fields between blanks, # begins a comment, an image has two lines.
#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/io/file.h"
#include "splat3d/colmap_model.h"

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// A file in memory, cut into lines as it is read.
typedef struct {
    char *path, *data;
    char *rest;       // what is not read yet; NULL at the end
    char *line;       // the current line, ended by a zero byte
    int number;       // of the current line, from 1
    long announced;   // "# Number of images: 12" in a comment, or -1
    char where[1200]; // "PATH, line 12": for messages
} Reader;

static bool open_reader(const char *folder, const char *name, Reader *r) {
    size_t size;
    *r = (Reader){.path = file_join(folder, name), .announced = -1};
    if (!file_read(r->path, &r->data, &size)) return false;
    if (memchr(r->data, 0, size)) return fail("cannot read %s: it holds zero bytes; is it a text file?", r->path);
    r->rest = r->data;
    return true;
}

static void close_reader(Reader *r) {
    mem_free(r->path);
    mem_free(r->data);
}

static bool next_line(Reader *r) {
    if (!r->rest || !*r->rest) return false;
    r->line = r->rest;
    char *end = strchr(r->line, '\n');
    r->rest = end ? end + 1 : NULL;
    if (!end) end = r->line + strlen(r->line);
    while (end > r->line && (end[-1] == '\r' || end[-1] == ' ' || end[-1] == '\t')) end--;
    *end = 0;
    r->number++;
    snprintf(r->where, sizeof r->where, "%s, line %d", r->path, r->number);
    return true;
}

// The next line that is neither empty nor a comment. COLMAP's own comments say how many records follow.
static bool next_record(Reader *r) {
    while (next_line(r)) {
        r->line += strspn(r->line, " \t");
        if (*r->line == '#')
            sscanf(r->line, "# Number of %*[a-z]: %ld", &r->announced);
        else if (*r->line)
            return true;
    }
    return false;
}

static bool check_announced(const Reader *r, int count, const char *what) {
    if (r->announced < 0 || r->announced == count) return true;
    return fail("cannot read %s: its comment says %ld %ss, and it holds %d; is the file complete?", r->path,
                r->announced, what, count);
}

// ---- fields of a line ----

static bool take_number(const Reader *r, char **text, const char *name, double *value) {
    char *end;
    *value = strtod(*text, &end);
    if (end == *text || (*end && !strchr(" \t", *end)))
        return fail("%s: no number for %s at \"%.20s\"; is the file complete?", r->where, name, *text);
    *text = end;
    return true;
}

static bool take_whole(const Reader *r, char **text, const char *name, long low, long high, long *value) {
    char *end;
    errno = 0;
    *value = strtol(*text, &end, 10);
    if (end == *text || (*end && !strchr(" \t", *end)) || errno || *value < low || *value > high)
        return fail("%s: no whole number from %ld to %ld for %s at \"%.20s\"; is the file complete?", r->where, low,
                    high, name, *text);
    *text = end;
    return true;
}

// The next field as a text of its own, in place.
static char *take_word(char **text) {
    char *word = *text + strspn(*text, " \t");
    char *end = word + strcspn(word, " \t");
    *text = *end ? end + 1 : end;
    *end = 0;
    return word;
}

static bool read_camera(Reader *r, ColmapModel *model) {
    char *text = r->line;
    long id, width, height;
    int kind, parameter_count;
    double parameters[COLMAP_PARAMETERS_MAX];
    if (!take_whole(r, &text, "CAMERA_ID", 0, UINT32_MAX, &id)) return false;
    if (!colmap_model_number(take_word(&text), r->where, &kind) ||
        !take_whole(r, &text, "WIDTH", 1, CAMERA_SIDE_MAX, &width) ||
        !take_whole(r, &text, "HEIGHT", 1, CAMERA_SIDE_MAX, &height) ||
        !colmap_parameter_count(kind, r->where, &parameter_count))
        return false;
    for (int k = 0; k < parameter_count; k++)
        if (!take_number(r, &text, "PARAMS", &parameters[k])) return false;
    if (*take_word(&text)) return fail("%s: more than the %d parameters of the model", r->where, parameter_count);
    return colmap_model_add_camera(model, (uint32_t)id, kind, (double)width, (double)height, parameters, r->where);
}

// The second line of an image: X Y POINT3D_ID, any number of times. Only their number is looked at: it tells a lost line.
static bool read_points2d(Reader *r) {
    if (!next_line(r)) return true; // an editor may have cut the empty line at the end
    int words = 0;
    for (char *text = r->line; *(text += strspn(text, " \t")); words++) text += strcspn(text, " \t");
    if (words % 3 == 0) return true;
    return fail("%s: %d fields, want triples X Y POINT3D_ID; each image has two lines, of which the second may be "
                "empty",
                r->where, words);
}

static bool read_image(Reader *r, ColmapModel *model) {
    char *text = r->line;
    ColmapImage image;
    long id, camera_id;
    if (!take_whole(r, &text, "IMAGE_ID", 0, UINT32_MAX, &id)) return false;
    for (int k = 0; k < 4; k++)
        if (!take_number(r, &text, "QW QX QY QZ", &image.quaternion[k])) return false;
    for (int k = 0; k < 3; k++)
        if (!take_number(r, &text, "TX TY TZ", &image.translation[k])) return false;
    if (!take_whole(r, &text, "CAMERA_ID", 0, UINT32_MAX, &camera_id)) return false;
    image.camera_id = (uint32_t)camera_id;
    image.name = text + strspn(text, " \t"); // to the end of the line: a name may have blanks
    return colmap_model_add_image(model, &image, r->where) && read_points2d(r);
}

static bool read_point(Reader *r, int index, ColmapModel *model) {
    char *text = r->line;
    long id, colour;
    double xyz[3], error;
    int rgb[3];
    if (!take_whole(r, &text, "POINT3D_ID", 0, LONG_MAX, &id)) return false;
    for (int k = 0; k < 3; k++)
        if (!take_number(r, &text, "X Y Z", &xyz[k])) return false;
    for (int k = 0; k < 3; k++) {
        if (!take_whole(r, &text, "R G B", 0, 255, &colour)) return false;
        rgb[k] = (int)colour;
    }
    if (!take_number(r, &text, "ERROR", &error)) return false;
    return colmap_model_set_point(model, index, xyz, rgb, r->where);
}

static bool read_cameras(Reader *r, ColmapModel *model) {
    while (next_record(r))
        if (!read_camera(r, model)) return false;
    return check_announced(r, model->camera_count, "camera");
}

static bool read_images(Reader *r, ColmapModel *model) {
    while (next_record(r))
        if (!read_image(r, model)) return false;
    return check_announced(r, model->image_count, "image");
}

static int count_lines(const char *text) {
    int lines = 1;
    for (const char *c = text; (c = strchr(c, '\n')); c++) lines++;
    return lines;
}

static bool read_points(Reader *r, ColmapModel *model) {
    model->points = points_create(count_lines(r->data)); // as many as there can be
    int count = 0;
    for (; next_record(r); count++)
        if (!read_point(r, count, model)) return false;
    model->points.count = count;
    return check_announced(r, count, "point");
}

static bool read_file(const char *folder, const char *name, bool (*read)(Reader *, ColmapModel *), ColmapModel *model) {
    Reader r;
    bool ok = open_reader(folder, name, &r) && read(&r, model);
    close_reader(&r);
    return ok;
}

bool colmap_text_read(const char *folder, bool has_points, ColmapModel *model) {
    return read_file(folder, "cameras.txt", read_cameras, model) &&
           read_file(folder, "images.txt", read_images, model) &&
           (!has_points || read_file(folder, "points3D.txt", read_points, model));
}
