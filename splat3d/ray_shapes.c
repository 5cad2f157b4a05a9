#include "splat3d/ray_shapes.h"

#include <assert.h>

static const double PI = 3.14159265358979323846;

RayFrame ray_frame_turned(Vec3 origin, double angle_rad) {
    double c = cos(angle_rad), s = sin(angle_rad);
    return (RayFrame){origin, vec3(c, s, 0), vec3(-s, c, 0), vec3(0, 0, 1)};
}

RayFrame ray_frame_along(Vec3 origin, Vec3 axis) {
    Vec3 z = vec3_normalize(axis);
    Vec3 side = fabs(z.x) < 0.7 ? vec3(1, 0, 0) : vec3(0, 1, 0);
    Vec3 y = vec3_normalize(vec3_cross(z, side));
    return (RayFrame){origin, vec3_cross(y, z), y, z};
}

Vec3 ray_frame_point(const RayFrame *frame, double x, double y, double z) {
    Vec3 p = vec3_add(frame->origin, vec3_scale(frame->x, x));
    return vec3_add(vec3_add(p, vec3_scale(frame->y, y)), vec3_scale(frame->z, z));
}

// Normal by central differences, kept off the borders, where a pole has no normal.
static Vec3 surface_normal(RaySurface *surface, const void *context, double u, double v) {
    const double step = 1e-4;
    u = fmin(fmax(u, 2 * step), 1 - 2 * step);
    v = fmin(fmax(v, 2 * step), 1 - 2 * step);
    Vec3 du = vec3_sub(surface(context, u + step, v), surface(context, u - step, v));
    Vec3 dv = vec3_sub(surface(context, u, v + step), surface(context, u, v - step));
    return vec3_normalize(vec3_cross(du, dv));
}

void ray_shape_surface(RayMesh *mesh, RaySurface *surface, const void *context, RayGrid grid) {
    int first = mesh->vertex_count, row = grid.nu + 1;
    for (int j = 0; j <= grid.nv; j++)
        for (int i = 0; i <= grid.nu; i++) {
            double u = (double)i / grid.nu, v = (double)j / grid.nv;
            ray_mesh_vertex(mesh, surface(context, u, v), surface_normal(surface, context, u, v), u * grid.repeat_u,
                            v * grid.repeat_v);
        }
    for (int j = 0; j < grid.nv; j++)
        for (int i = 0; i < grid.nu; i++) {
            int a = first + j * row + i, b = a + 1, c = a + row, d = c + 1;
            ray_mesh_triangle(mesh, a, b, d, grid.material);
            ray_mesh_triangle(mesh, a, d, c, grid.material);
        }
}

typedef struct {
    Vec3 corner, edge_u, edge_v;
} Patch;

static Vec3 patch_point(const void *context, double u, double v) {
    const Patch *p = context;
    return vec3_add(p->corner, vec3_add(vec3_scale(p->edge_u, u), vec3_scale(p->edge_v, v)));
}

void ray_shape_patch(RayMesh *mesh, Vec3 corner, Vec3 edge_u, Vec3 edge_v, RayGrid grid) {
    Patch patch = {corner, edge_u, edge_v};
    ray_shape_surface(mesh, patch_point, &patch, grid);
}

static int cells_along(double length, double cell) {
    int n = (int)ceil(length / cell);
    return n < 1 ? 1 : n;
}

// One face: centre + normal, spanned by a and b with a cross b along the normal.
static void box_face(RayMesh *mesh, Vec3 centre, Vec3 half_a, Vec3 half_b, double cell, double repeat, int material) {
    double length_a = 2 * vec3_length(half_a), length_b = 2 * vec3_length(half_b);
    RayGrid grid = {cells_along(length_a, cell), cells_along(length_b, cell), repeat > 0 ? length_a / repeat : 1,
                    repeat > 0 ? length_b / repeat : 1, material};
    ray_shape_patch(mesh, vec3_sub(centre, vec3_add(half_a, half_b)), vec3_scale(half_a, 2), vec3_scale(half_b, 2),
                    grid);
}

void ray_shape_box(RayMesh *mesh, RayFrame frame, Vec3 half_size, double cell, double repeat, int material) {
    Vec3 x = vec3_scale(frame.x, half_size.x), y = vec3_scale(frame.y, half_size.y),
         z = vec3_scale(frame.z, half_size.z), o = frame.origin, none = {0, 0, 0};
    Vec3 minus_x = vec3_sub(none, x), minus_y = vec3_sub(none, y);
    box_face(mesh, vec3_add(o, x), y, z, cell, repeat, material);
    box_face(mesh, vec3_sub(o, x), minus_y, z, cell, repeat, material);
    box_face(mesh, vec3_add(o, y), minus_x, z, cell, repeat, material);
    box_face(mesh, vec3_sub(o, y), x, z, cell, repeat, material);
    box_face(mesh, vec3_add(o, z), x, y, cell, repeat, material);
    box_face(mesh, vec3_sub(o, z), minus_x, y, cell, repeat, material);
}

typedef struct {
    RayFrame frame;
    double radius;
} Ball;

static Vec3 ball_point(const void *context, double u, double v) {
    const Ball *b = context;
    double longitude = 2 * PI * u, latitude = PI * (v - 0.5), ring = b->radius * cos(latitude);
    return ray_frame_point(&b->frame, ring * cos(longitude), ring * sin(longitude), b->radius * sin(latitude));
}

void ray_shape_ball(RayMesh *mesh, RayFrame frame, double radius, int segments, int material) {
    Ball ball = {frame, radius};
    ray_shape_surface(mesh, ball_point, &ball, (RayGrid){segments, (segments + 1) / 2, 1, 1, material});
}

// The value at t in [0, 1] between b and c of a curve through a b c d.
static double catmull_rom(double a, double b, double c, double d, double t) {
    return b + 0.5 * t * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a)));
}

// Splits v in [0, 1] over count points into a segment and the place in it.
static int curve_segment(double v, int count, double *t) {
    double place = v * (count - 1);
    int i = (int)place;
    if (i > count - 2) i = count - 2;
    *t = place - i;
    return i;
}

typedef struct {
    RayFrame frame;
    const RayOutline *outline; // of one smooth run
    int points;
} Turned;

static double chord(RayOutline a, RayOutline b) { return hypot(b.radius - a.radius, b.height - a.height); }

static double run_length(const RayOutline *outline, int points) {
    double length = 0;
    for (int i = 0; i + 1 < points; i++) length += chord(outline[i], outline[i + 1]);
    return length;
}

// v goes along the chords, so that a texture is not stretched where points are far apart.
static Vec3 turned_point(const void *context, double u, double v) {
    const Turned *s = context;
    double left = v * run_length(s->outline, s->points), angle = 2 * PI * u;
    int i = 0;
    while (i < s->points - 2 && left > chord(s->outline[i], s->outline[i + 1]))
        left -= chord(s->outline[i], s->outline[i + 1]), i++;
    const RayOutline *b = s->outline + i, *c = b + 1;
    const RayOutline *a = i > 0 ? b - 1 : b, *d = i + 2 < s->points ? c + 1 : c;
    double t = left / chord(*b, *c);
    double radius = fmax(catmull_rom(a->radius, b->radius, c->radius, d->radius, t), 0);
    double height = catmull_rom(a->height, b->height, c->height, d->height, t);
    return ray_frame_point(&s->frame, radius * cos(angle), radius * sin(angle), height);
}

void ray_shape_turned(RayMesh *mesh, RayFrame frame, const RayOutline *outline, int points, RayGrid grid) {
    assert(points >= 2);
    double whole = run_length(outline, points);
    for (int first = 0, last; first < points - 1; first = last + 1) {
        for (last = first + 1; last < points - 1; last++)
            if (chord(outline[last], outline[last + 1]) == 0) break;
        Turned run = {frame, outline + first, last - first + 1};
        RayGrid part = grid;
        part.nv = (int)ceil(grid.nv * run_length(run.outline, run.points) / whole);
        ray_shape_surface(mesh, turned_point, &run, part);
    }
}

typedef struct {
    const Vec3 *points;
    int count;
    double radius;
} Rod;

static Vec3 rod_centre(const Rod *rod, double v) {
    double t;
    int i = curve_segment(v, rod->count, &t);
    const Vec3 *b = rod->points + i, *c = b + 1, *a = i > 0 ? b - 1 : b, *d = i + 2 < rod->count ? c + 1 : c;
    return vec3(catmull_rom(a->x, b->x, c->x, d->x, t), catmull_rom(a->y, b->y, c->y, d->y, t),
                catmull_rom(a->z, b->z, c->z, d->z, t));
}

static Vec3 rod_point(const void *context, double u, double v) {
    const Rod *rod = context;
    double ahead = fmin(v + 1e-3, 1), behind = fmax(v - 1e-3, 0), angle = 2 * PI * u;
    RayFrame frame = ray_frame_along(rod_centre(rod, v), vec3_sub(rod_centre(rod, ahead), rod_centre(rod, behind)));
    return ray_frame_point(&frame, rod->radius * cos(angle), rod->radius * sin(angle), 0);
}

void ray_shape_rod(RayMesh *mesh, const Vec3 *points, int count, double radius, int steps, int sides, double repeat_v,
                   int material) {
    assert(count >= 2);
    Rod rod = {points, count, radius};
    ray_shape_surface(mesh, rod_point, &rod, (RayGrid){sides, steps, 1, repeat_v, material});
}

//        tip
//       /|\        .
//  left  middle right     the two halves are folded a little towards `face`, and the tip hangs
//       \|/
//       foot
void ray_shape_leaf(RayMesh *mesh, Vec3 foot, Vec3 along, Vec3 face, double width, int material) {
    Vec3 side = vec3_scale(vec3_normalize(vec3_cross(along, face)), 0.5 * width);
    Vec3 normal = vec3_normalize(vec3_cross(side, along));
    if (vec3_dot(normal, face) < 0) normal = vec3_scale(normal, -1);
    Vec3 fold = vec3_scale(normal, 0.15 * width);
    Vec3 waist = vec3_add(foot, vec3_scale(along, 0.45));
    Vec3 tip = vec3_sub(vec3_add(foot, along), fold);
    int a = ray_mesh_vertex(mesh, foot, normal, 0.5, 0);
    int m = ray_mesh_vertex(mesh, waist, normal, 0.5, 0.45);
    int t = ray_mesh_vertex(mesh, tip, normal, 0.5, 1);
    int l = ray_mesh_vertex(mesh, vec3_add(vec3_sub(waist, side), fold), normal, 0, 0.45);
    int r = ray_mesh_vertex(mesh, vec3_add(vec3_add(waist, side), fold), normal, 1, 0.45);
    mesh->light_from[a] = mesh->light_from[t] = mesh->light_from[l] = mesh->light_from[r] = m;
    ray_mesh_triangle(mesh, a, m, l, material);
    ray_mesh_triangle(mesh, a, r, m, material);
    ray_mesh_triangle(mesh, m, t, l, material);
    ray_mesh_triangle(mesh, m, r, t, material);
}
