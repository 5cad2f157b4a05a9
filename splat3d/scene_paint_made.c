#include "splat3d/ray_noise.h"
#include "splat3d/scene_paint.h"

static const double PI = 3.14159265358979323846;

// 1 inside a band of this half width round 0, soft at its edge.
static double band(double x, double half_width) { return 1 - noise_step(0.8 * half_width, 1.2 * half_width, fabs(x)); }

// Distance from the nearest border of the unit square.
static double border_distance(double u, double v) { return fmin(fmin(u, 1 - u), fmin(v, 1 - v)); }

// A little wear on everything that people make.
static Vec3 worn(Vec3 colour, double u, double v, uint32_t seed) {
    double wear = noise_fbm(vec3(24 * u, 24 * v, 0), 24, 4, seed + 77);
    return vec3_scale(colour, 1 + 0.28 * wear);
}

RayTexel paint_checker(const void *context, double u, double v) {
    const Paint *p = context;
    double fields = sin(PI * p->count * u) * sin(PI * p->count * v);
    double scratch = noise_fbm(vec3(10 * u, 10 * v, 1), 10, 5, p->seed);
    Vec3 colour = vec3_lerp(p->base, p->second, noise_step(-0.04, 0.04, fields));
    return (RayTexel){vec3_scale(colour, 1 + 0.5 * scratch), 0};
}

// Petals round the middle of each of count fields, between two rings of dots.
RayTexel paint_ceramic(const void *context, double u, double v) {
    const Paint *p = context;
    double field = u * p->count, x = field - floor(field) - 0.5, y = (v - 0.52) * 4.4;
    double radius = hypot(x, y), angle = atan2(y, x);
    double petals = 0.3 + 0.13 * cos(8 * angle), ink = 0;
    ink = fmax(ink, noise_step(0.02, 0, radius - petals) * noise_step(0, 0.03, radius - petals + 0.1));
    ink = fmax(ink, noise_step(0.09, 0.06, radius));
    ink = fmax(ink, band(radius - 0.155, 0.018));
    ink = fmax(ink, band(hypot(fabs(x) - 0.5, fabs(y) - 0.45) - 0.16, 0.035));
    for (int k = 0; k < 4; k++) {
        static const double ring[4] = {0.16, 0.25, 0.8, 0.9};
        ink = fmax(ink, band(v - ring[k], 0.006));
    }
    double dots = 4 * field - floor(4 * field) - 0.5;
    ink = fmax(ink, noise_step(0.26, 0.18, hypot(dots, (v - 0.205) * 16)));
    ink = fmax(ink, noise_step(0.26, 0.18, hypot(dots, (v - 0.85) * 16)));
    ink *= 0.85 + 0.3 * noise_fbm(vec3(30 * u, 30 * v, 0), 30, 3, p->seed);
    double glaze = 1 + 0.06 * noise_fbm(vec3(12 * u, 12 * v, 3), 12, 4, p->seed + 1);
    return (RayTexel){vec3_scale(vec3_lerp(p->base, p->second, fmin(ink, 1)), glaze), 0};
}

RayTexel paint_book(const void *context, double u, double v) {
    const Paint *p = context;
    double edge = border_distance(u, v), ink = band(edge - 0.06, 0.008) + band(edge - 0.085, 0.004);
    double letters = noise_gradient(vec3(60 * u, 3, 0), 60, p->seed);
    for (int line = 0; line < 3; line++) { // rows of print
        double in_row = band(v - (0.8 - 0.075 * line), 0.026) * (fabs(u - 0.5) < 0.34 - 0.07 * line);
        double stroke = noise_gradient(vec3(44 * u, 6 * v, line), 44, p->seed + 3) + 0.25 * letters;
        ink += in_row * noise_step(-0.05, 0.1, stroke);
    }
    double radius = hypot(u - 0.5, (v - 0.34) * 1.3), angle = atan2(v - 0.34, u - 0.5);
    double star = 0.13 + 0.05 * cos(p->count * angle);
    ink += noise_step(0.01, 0, radius - star) * noise_step(0, 0.01, radius - 0.05) + band(radius - 0.21, 0.007);
    Vec3 linen = vec3_scale(p->base, 1 + 0.3 * noise_gradient(vec3(120 * u, 120 * v, 0), 120, p->seed + 9));
    Vec3 cover = vec3_lerp(linen, p->second, noise_step(0.05, 0.045, edge));
    return (RayTexel){worn(vec3_lerp(cover, p->accent, fmin(ink, 1)), u, v, p->seed), 0};
}

RayTexel paint_pages(const void *context, double u, double v) {
    const Paint *p = context;
    double sheets =
        noise_gradient(vec3(2 * u, 60 * v, 0), 0, p->seed) + 0.5 * noise_gradient(vec3(5 * u, 130 * v, 4), 0, p->seed);
    return (RayTexel){vec3_scale(p->base, 0.85 + 0.4 * sheets), 0};
}

RayTexel paint_wallpaper(const void *context, double u, double v) {
    const Paint *p = context;
    double a = p->count * (u + v), b = p->count * (u - v);
    double x = a - floor(a) - 0.5, y = b - floor(b) - 0.5, radius = hypot(x, y), angle = atan2(y, x);
    double line = fmax(band(fabs(x) - 0.5, 0.018), band(fabs(y) - 0.5, 0.018));
    double petals = 0.2 + 0.09 * cos(4 * angle);
    double flower = noise_step(0.02, 0, radius - petals) * noise_step(0, 0.03, radius - 0.07);
    double leaf = noise_step(0.02, 0, hypot(fabs(x) - 0.33, fabs(y) - 0.33) - 0.07);
    Vec3 paper = vec3_scale(p->base, 1 + 0.25 * noise_fbm(vec3(48 * u, 48 * v, 0), 48, 4, p->seed));
    paper = vec3_lerp(paper, p->second, 0.9 * fmax(line, leaf));
    return (RayTexel){vec3_lerp(paper, p->accent, 0.9 * fmax(flower, noise_step(0.05, 0.03, radius))), 0};
}

RayTexel paint_panel(const void *context, double u, double v) {
    const Paint *p = context;
    double board = u * p->count, x = board - floor(board);
    double groove = noise_step(0, 0.03, fmin(x, 1 - x));
    double brush = noise_gradient(vec3(90 * u, 3 * v, 0), 0, p->seed),
           stain = noise_fbm(vec3(5 * u, 5 * v, 2), 5, 5, p->seed);
    double tone = 0.97 + 0.06 * noise_cell((int)board % p->count, 0, 0, p->seed);
    double knock = noise_step(0.35, 0.5, noise_fbm(vec3(17 * u, 17 * v, 7), 17, 3, p->seed + 8));
    Vec3 paint = vec3_scale(vec3_lerp(p->base, p->second, fmin(fmax(0.3 + 0.7 * stain, 0), 1)), tone + 0.08 * brush);
    paint = vec3_lerp(paint, p->accent, 0.35 * knock);
    return (RayTexel){vec3_scale(paint, 0.45 + 0.55 * groove), groove};
}

RayTexel paint_cloth(const void *context, double u, double v) {
    const Paint *p = context;
    double warp = u * p->count, weft = v * p->count;
    double x = warp - floor(warp), y = weft - floor(weft);
    double wide_x = band(x - 0.5, 0.16), wide_y = band(y - 0.5, 0.16);
    double thin = fmax(band(x - 0.12, 0.025), band(y - 0.12, 0.025));
    double thread = sin(2 * PI * 128 * u) * sin(2 * PI * 128 * v),
           fuzz = noise_fbm(vec3(64 * u, 64 * v, 0), 64, 3, p->seed);
    Vec3 colour = vec3_lerp(p->base, p->second, 0.5 * (wide_x + wide_y));
    colour = vec3_lerp(colour, p->accent, 0.85 * thin);
    return (RayTexel){vec3_scale(colour, 0.92 + 0.1 * thread + 0.3 * fuzz), 0.5 + 0.5 * thread};
}

// Borders within borders, and a medallion whose rays have steps.
RayTexel paint_rug(const void *context, double u, double v) {
    const Paint *p = context;
    double knots = 160, ku = (floor(u * knots) + 0.5) / knots,
           kv = (floor(v * knots) + 0.5) / knots; // knotted: no curve is smooth
    double edge = border_distance(ku, kv), radius = hypot(ku - 0.5, kv - 0.5), angle = atan2(kv - 0.5, ku - 0.5);
    Vec3 colour = p->base;
    if (sin(2 * PI * 9 * ku) * sin(2 * PI * 9 * kv) > 0.62) colour = p->accent;
    if (radius < 0.3 + 0.035 * cos(16 * angle)) colour = p->second;
    if (radius < 0.24 + 0.05 * cos(8 * angle)) colour = p->accent;
    if (radius < 0.19 + 0.04 * cos(8 * angle)) colour = p->base;
    if (radius < 0.1 + 0.03 * cos(8 * angle + PI)) colour = p->second;
    if (edge < 0.13) colour = p->second;
    if (edge > 0.035 && edge < 0.115 && sin(2 * PI * 14 * ku) * sin(2 * PI * 14 * kv) > 0.1) colour = p->accent;
    if (edge < 0.03 || fabs(edge - 0.122) < 0.006) colour = p->base;
    double fuzz = noise_fbm(vec3(90 * u, 90 * v, 0), 90, 3, p->seed);
    return (RayTexel){vec3_scale(colour, 0.95 + 0.5 * fuzz), 0};
}

RayTexel paint_canvas(const void *context, double u, double v) {
    const Paint *p = context;
    double bend = 0.12 * noise_fbm(vec3(3 * u, 3 * v, 1), 0, 3, p->seed + 4);
    double hills = 0.45 + 0.2 * noise_gradient(vec3(2.5 * u, 0.5, 3), 0, p->seed);
    double stroke = noise_fbm(vec3(14 * u + 8 * bend, 50 * v, 0), 0, 4, p->seed + 1);
    Vec3 colour = vec3_lerp(p->base, vec3(0.8, 0.78, 0.7), fmin(fmax(1.6 * (v - hills), 0), 1));
    if (v + bend < hills) colour = vec3_lerp(p->second, vec3_scale(p->accent, 0.5), noise_step(-0.3, 0.3, stroke));
    if (v + bend < 0.6 * hills) colour = vec3_lerp(p->accent, p->second, noise_step(0, 0.5, stroke));
    if (hypot(u - 0.68, 1.1 * (v - 0.75)) < 0.09 + 0.1 * bend) colour = p->accent;
    return (RayTexel){vec3_scale(colour, 0.9 + 0.45 * stroke), 0.5 + 0.5 * stroke};
}

RayTexel paint_block(const void *context, double u, double v) {
    const Paint *p = context;
    double edge = border_distance(u, v), x = fabs(u - 0.5), y = fabs(v - 0.5);
    double figure = noise_step(0.01, 0, fmin(fmax(x - 0.09, y - 0.27), fmax(x - 0.27, y - 0.09)));
    figure = fmax(figure, band(hypot(x, y) - 0.31, 0.02));
    double fibre = noise_gradient(vec3(6 * u, 70 * v, 0), 0, p->seed);
    Vec3 wood = vec3_scale(p->base, 1 + 0.35 * fibre);
    Vec3 colour = vec3_lerp(wood, p->second, fmax(figure, noise_step(0.1, 0.09, edge) * noise_step(0.02, 0.03, edge)));
    return (RayTexel){worn(colour, u, v, p->seed), 0};
}
