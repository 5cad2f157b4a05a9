// ray_shapes.h - the shapes that sample scenes are built of, as triangles: patches, boxes, balls, turned and drawn-out forms, leaves.
//
// Triangles are small where light changes quickly, because light is stored at their corners: `cells` and `segments`
// are those of the finest picture.
#ifndef SPLATLAB_SPLAT3D_RAY_SHAPES_H
#define SPLATLAB_SPLAT3D_RAY_SHAPES_H

#include "splat3d/ray_mesh.h"

// A place with axes of length 1 that are perpendicular to each other; z = x cross y.
typedef struct {
    Vec3 origin, x, y, z;
} RayFrame;

// At a point, with the axes of the world turned about z by angle_rad (counter-clockwise seen from above).
RayFrame ray_frame_turned(Vec3 origin, double angle_rad);
// With z along `axis`; x and y are any that fit.
RayFrame ray_frame_along(Vec3 origin, Vec3 axis);
Vec3 ray_frame_point(const RayFrame *frame, double x, double y, double z); // in the world

// A point of a surface; u and v run over [0, 1]. d/du cross d/dv points to the lit side.
typedef Vec3 RaySurface(const void *context, double u, double v);

// The surface as nu x nv cells; texture coordinates are (u repeat_u, v repeat_v).
typedef struct {
    int nu, nv;
    double repeat_u, repeat_v;
    int material;
} RayGrid;
void ray_shape_surface(RayMesh *mesh, RaySurface *surface, const void *context, RayGrid grid);

// A flat parallelogram: corner + u edge_u + v edge_v; lit side: edge_u cross edge_v.
void ray_shape_patch(RayMesh *mesh, Vec3 corner, Vec3 edge_u, Vec3 edge_v, RayGrid grid);

// A box centred on frame.origin. cell: largest edge of a cell, world units. One texture repeat measures `repeat` world units; 0: each
// face shows the texture once.
void ray_shape_box(RayMesh *mesh, RayFrame frame, Vec3 half_size, double cell, double repeat, int material);

// A ball; u runs round frame.z, v from its south to its north pole. segments: round the equator.
void ray_shape_ball(RayMesh *mesh, RayFrame frame, double radius, int segments, int material);

// A turned form: the outline (radius, height) from the bottom up, smooth through its points (Catmull-Rom), turned about frame.z.
// A point given twice makes a sharp edge; each smooth run between such edges carries the texture once over (repeat_v times). Outside
// is lit; an outline that runs back down inside makes a vessel. grid.nv: cells along the whole outline.
typedef struct {
    double radius, height;
} RayOutline;
void ray_shape_turned(RayMesh *mesh, RayFrame frame, const RayOutline *outline, int points, RayGrid grid);

// A rod along a smooth curve through the points. u runs round, v along. sides >= 3.
void ray_shape_rod(RayMesh *mesh, const Vec3 *points, int count, double radius, int steps, int sides, double repeat_v,
                   int material);

// A leaf: four triangles folded along its middle, from `foot` in direction `along` (length in it), lit from `face`.
void ray_shape_leaf(RayMesh *mesh, Vec3 foot, Vec3 along, Vec3 face, double width, int material);

#endif
