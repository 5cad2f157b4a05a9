// line_picture.c - a line is a row of soft dots.
#include "exercises/harness/line_picture.h"

#include <math.h>
#include <stddef.h>

const float LINE_RED[3] = {1, 0.35f, 0.3f}, LINE_GREEN[3] = {0.35f, 0.9f, 0.4f}, LINE_BLUE[3] = {0.4f, 0.6f, 1},
            LINE_GREY[3] = {0.4f, 0.4f, 0.42f}, LINE_YELLOW[3] = {1, 0.85f, 0.3f};

static const float GROUND = 0.08f;
static const double FAR_PX = 1e4, DOT_STEP_PX = 0.5, DOT_RADIUS_PX = 1.2, HEAD_PX = 8;

ImageF line_picture_create(int width, int height) {
    ImageF image = imagef_create(width, height, 3);
    for (size_t i = 0; i < (size_t)width * (size_t)height * 3; i++) image.values[i] = GROUND;
    return image;
}

static void dot(ImageF *image, double x, double y, const float rgb[3]) {
    for (int row = (int)floor(y - 1.5); row <= (int)floor(y + 1.5); row++)
        for (int column = (int)floor(x - 1.5); column <= (int)floor(x + 1.5); column++) {
            if (row < 0 || row >= image->height || column < 0 || column >= image->width) continue;
            double away = hypot(column + 0.5 - x, row + 0.5 - y);
            float cover = (float)fmax(0, 1 - away / DOT_RADIUS_PX);
            float *at = &image->values[((size_t)row * (size_t)image->width + (size_t)column) * 3];
            for (int c = 0; c < 3; c++) at[c] = fmaxf(at[c], cover * rgb[c] + (1 - cover) * GROUND);
        }
}

void line_picture_line(ImageF *image, const double from[2], const double to[2], const float rgb[3]) {
    double length = hypot(to[0] - from[0], to[1] - from[1]);
    if (!(length < FAR_PX && hypot(from[0], from[1]) < FAR_PX)) return;
    int steps = (int)(length / DOT_STEP_PX) + 1;
    for (int i = 0; i <= steps; i++) {
        double part = (double)i / steps;
        dot(image, from[0] + part * (to[0] - from[0]), from[1] + part * (to[1] - from[1]), rgb);
    }
}

void line_picture_arrow(ImageF *image, const double from[2], const double to[2], const float rgb[3]) {
    double dx = to[0] - from[0], dy = to[1] - from[1], length = hypot(dx, dy);
    line_picture_line(image, from, to, rgb);
    if (!(length > 1)) return;
    double head = fmin(HEAD_PX, length / 2) / length;
    for (int side = -1; side <= 1; side += 2) {
        double barb[2] = {to[0] - head * (dx + side * 0.6 * dy), to[1] - head * (dy - side * 0.6 * dx)};
        line_picture_line(image, to, barb, rgb);
    }
}

void line_picture_cross(ImageF *image, const double at[2], double half_size, const float rgb[3]) {
    line_picture_line(image, (double[]){at[0] - half_size, at[1]}, (double[]){at[0] + half_size, at[1]}, rgb);
    line_picture_line(image, (double[]){at[0], at[1] - half_size}, (double[]){at[0], at[1] + half_size}, rgb);
}

void line_picture_box(ImageF *image, const double low[2], const double high[2], const float rgb[3]) {
    const double corner[4][2] = {{low[0], low[1]}, {high[0], low[1]}, {high[0], high[1]}, {low[0], high[1]}};
    for (int i = 0; i < 4; i++) line_picture_line(image, corner[i], corner[(i + 1) % 4], rgb);
}
