// figure_popping.c - the same two blobs in both orders, and where the picture jumps.
#include "lab/app/figure.h"
#include "lab/app/figure_draw.h"
#include "lab/app/palette.h"
#include "splat2d/raster2d.h"

#include <math.h>

enum { SIDE = 240, DIFFERENCE = 2, TONES = 85 }; // fewer tones, smaller file

static Scene2d scene_of(bool swapped) {
    Scene2d scene = scene2d_create(200, 200);
    scene2d_add(&scene, &(Blob){.mean = {84, 100},
                                .sigma_x = 46,
                                .sigma_y = 20,
                                .theta_rad = 0.7,
                                .rgb = {0.1, 0.75, 0.7},
                                .opacity = 0.9,
                                .depth = 1});
    scene2d_add(&scene, &(Blob){.mean = {116, 100},
                                .sigma_x = 46,
                                .sigma_y = 20,
                                .theta_rad = -0.7,
                                .rgb = {0.98, 0.55, 0.2},
                                .opacity = 0.9,
                                .depth = swapped ? 0.9 : 1.1});
    return scene;
}

static ImageF picture_of(bool swapped) {
    Scene2d scene = scene_of(swapped);
    RasterSettings settings = raster_settings_default();
    Raster2d raster = {0};
    ImageF picture = imagef_create(SIDE, SIDE, 3);
    raster2d_load(&raster, &scene, (View2d){.zoom = SIDE / 200.0});
    raster2d_draw(&raster, &settings, &picture, NULL);
    raster2d_destroy(&raster);
    for (int k = 0; k < SIDE * SIDE * 3; k++) picture.values[k] = roundf(picture.values[k] * TONES) / TONES;
    scene2d_destroy(&scene);
    return picture;
}

static void show(GuiRect place, int i, const ImageF *picture, const char *name) {
    double side = SIDE, x = place.x + 20 + i * (side + 20), y = place.y + 44;
    Image8 bytes = image8_from_float(picture);
    gui_picture_fill(i, &bytes, true);
    gui_draw_picture(i, (GuiRect){x, y, side, side});
    gui_draw_frame((GuiRect){x, y, side, side}, LINE, 0, 1);
    figure_label(GUI_BOLD, x + side / 2, place.y + 14, INK, name);
    image8_destroy(&bytes);
}

static bool draw(GuiRect place, json_t *numbers) {
    ImageF pictures[3] = {picture_of(false), picture_of(true), imagef_create(SIDE, SIDE, 3)};
    double largest = 0;
    for (int k = 0; k < SIDE * SIDE * 3; k++) {
        float jump = fabsf(pictures[0].values[k] - pictures[1].values[k]);
        pictures[DIFFERENCE].values[k] = jump;
        largest = fmax(largest, (double)jump);
    }
    show(place, 0, &pictures[0], "teal first: 1.0 < 1.1");
    show(place, 1, &pictures[1], "orange first: 0.9 < 1.0");
    show(place, 2, &pictures[2], "the jump");
    figure_label(
        GUI_SMALL, place.x + place.width / 2, place.y + 296, INK_QUIET,
        "Nothing moved on the screen. The jump is T α₁ α₂ |c₁ − c₂|: only the overlap changes, and all of it at once.");
    json_object_set_new(numbers, "largest_jump", json_real(largest));
    for (int i = 0; i < 3; i++) imagef_destroy(&pictures[i]);
    return true;
}

const Figure FIGURE_POPPING = {"popping", "two blobs in both orders, and the jump between them", 800, 330, draw};
