// widget_speed.c - frames against the clock.
#include "lab/app/widget_speed.h"

#include "lab/app/widget.h"
#include "lab/base/clock.h"
#include "lab/base/mem.h"
#include "lab/base/parallel.h"
#include "lab/base/rng.h"
#include "lab/io/json_io.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { FRAMES = 60, WARM_FRAMES = 5, MANY_BLOBS = 200, ROWS_MAX = 4 };
static const double TURN_RAD = M_PI / 180; // of the first blob, from frame to frame

// Medians, ms.
typedef struct {
    int blobs;
    bool is_window;
    double raster_ms, frame_ms;
    double cpu_ms;     // of a frame, on all cores: what other programs take does not count
    double blobs_read; // per pixel
} Speed;

// About as large as those of a lecture, a dozen over each pixel.
static Scene2d many_blobs(int width, int height) {
    Scene2d scene = scene2d_create(width, height);
    for (int i = 0; i < MANY_BLOBS; i++) {
        Rng rng = rng_at(1, RNG_TEST, (uint32_t)i, 0);
        Blob blob = {.depth = i};
        blob.mean[0] = rng_range(&rng, 0, width), blob.mean[1] = rng_range(&rng, 0, height);
        blob.sigma_x = exp(rng_range(&rng, log(20), log(110)));
        blob.sigma_y = exp(rng_range(&rng, log(15), log(60)));
        blob.theta_rad = rng_range(&rng, -M_PI, M_PI);
        blob.opacity = rng_range(&rng, 0.3, 0.9);
        for (int c = 0; c < 3; c++) blob.rgb[c] = rng_range(&rng, 0.1, 1);
        scene2d_add(&scene, &blob);
    }
    return scene;
}

static int compare_numbers(const void *a, const void *b) {
    double left = *(const double *)a, right = *(const double *)b;
    return (left > right) - (left < right);
}

static double median(double *values, int count) {
    qsort(values, (size_t)count, sizeof *values, compare_numbers);
    return values[count / 2];
}

static double mean_read(const Widget *widget) {
    double sum = 0, pixels = (double)widget->picture.width * widget->picture.height;
    for (int i = 0; i < pixels; i++) sum += widget->maps.visits[i];
    return sum / pixels;
}

static bool one_frame(Widget *widget) {
    screen_begin(widget->screen, true);
    Blob *blob = widget_active(widget);
    if (blob) blob->theta_rad = angle_wrap(blob->theta_rad + TURN_RAD);
    widget->is_stale = true;
    bool good = widget_frame(widget) && screen_end(widget->screen);
    screen_show(widget->screen);
    return good;
}

static bool measure(Widget *widget, Speed *speed) {
    double raster_ms[FRAMES], frame_ms[FRAMES], cpu_ms[FRAMES];
    for (int i = 0; i < WARM_FRAMES; i++)
        if (!one_frame(widget)) return false;
    for (int i = 0; i < FRAMES; i++) {
        double began_s = clock_seconds(), cpu_began_s = clock_cpu_seconds();
        if (!one_frame(widget)) return false;
        frame_ms[i] = 1e3 * (clock_seconds() - began_s);
        cpu_ms[i] = 1e3 * (clock_cpu_seconds() - cpu_began_s);
        raster_ms[i] = widget->raster_ms;
    }
    speed->raster_ms = median(raster_ms, FRAMES);
    speed->frame_ms = median(frame_ms, FRAMES);
    speed->cpu_ms = median(cpu_ms, FRAMES);
    speed->blobs_read = mean_read(widget);
    return true;
}

// Both scenes on one screen, into two rows.
static bool measure_screen(const ScreenOptions *options, const Scene2d *scene, Speed rows[2]) {
    Screen *screen = screen_open(options);
    if (!screen) return false;
    bool good = true;
    for (int many = 0; many < 2 && good; many++) {
        Widget *widget = mem_alloc(1, sizeof *widget);
        widget_begin(widget, screen, many ? many_blobs(scene->width, scene->height) : scene2d_copy(scene), "");
        rows[many] = (Speed){.blobs = widget->scene.count, .is_window = screen_is_window(screen)};
        good = measure(widget, &rows[many]);
        widget_end(widget);
        mem_free(widget);
    }
    screen_close(screen);
    return good;
}

static void print_table(const Speed *rows, int count) {
    printf("%d threads; medians of %d frames\n\n", parallel_threads(), FRAMES);
    printf("%-20s%8s%14s%12s%12s%12s%14s\n", "", "blobs", "read a pixel", "raster, ms", "frame, ms", "cpu, ms",
           "frames a s");
    for (int i = 0; i < count; i++)
        printf("%-20s%8d%14.1f%12.2f%12.2f%12.2f%14.0f\n", rows[i].is_window ? "in a window" : "the widget's own",
               rows[i].blobs, rows[i].blobs_read, rows[i].raster_ms, rows[i].frame_ms, rows[i].cpu_ms,
               1e3 / rows[i].frame_ms);
}

static void print_json(const Speed *rows, int count) {
    json_t *list = json_array();
    for (int i = 0; i < count; i++)
        json_array_append_new(list, json_pack("{sb si sf sf sf sf sf}", "window", rows[i].is_window, "gaussians",
                                              rows[i].blobs, "blobs_read", rows[i].blobs_read, "raster_ms",
                                              rows[i].raster_ms, "frame_ms", rows[i].frame_ms, "cpu_ms", rows[i].cpu_ms,
                                              "frames_per_second", 1e3 / rows[i].frame_ms));
    json_t *root = json_pack("{si so}", "threads", parallel_threads(), "speeds", list);
    json_print(root);
    json_decref(root);
}

bool widget_speed(const Scene2d *scene, const ScreenOptions *options, bool as_json) {
    Speed rows[ROWS_MAX];
    int count = 2;
    ScreenOptions own = *options;
    own.headless = true;
    own.frames = 0;
    if (own.size[0] == 0) own.size[0] = WIDGET_SPEED_WIDTH, own.size[1] = WIDGET_SPEED_HEIGHT;
    if (!measure_screen(&own, scene, rows)) return false;
    own.headless = false;
    if (getenv("DISPLAY") || getenv("WAYLAND_DISPLAY")) {
        if (!measure_screen(&own, scene, rows + 2)) return false;
        count = ROWS_MAX;
    }
    if (as_json)
        print_json(rows, count);
    else
        print_table(rows, count);
    return true;
}
