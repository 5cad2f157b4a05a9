// ray_mesh.h - the triangles of a sample scene: everything that stands in it, as one growing list.
//
// Each corner has a position, a normal for smooth shading, texture coordinates, and the light that falls on it,
// which ray_light.h computes once for all views.
#ifndef SPLATLAB_SPLAT3D_RAY_MESH_H
#define SPLATLAB_SPLAT3D_RAY_MESH_H

#include "lab/base/vec.h"

#include <stdint.h>

typedef struct {
    int vertex_count, vertex_room;
    float *position; // (V,3) world
    float *normal;   // (V,3) unit, on the lit side
    float *uv;       // (V,2) texture coordinates; 1 is one repeat
    float *light;    // (V,3) irradiance / pi that is not traced per pixel: times albedo it is the radiance
    int *light_from; // (V) the vertex whose light this one shares (small things are lit in one place); mostly itself
    int triangle_count, triangle_room;
    int *corner;       // (T,3) vertices
    uint8_t *material; // (T) index into the scene's materials
} RayMesh;

void ray_mesh_destroy(RayMesh *mesh); // accepts a zeroed one, which is the empty mesh

// Returns the index of the new vertex, which has a light of its own.
int ray_mesh_vertex(RayMesh *mesh, Vec3 position, Vec3 normal, double u, double v);
void ray_mesh_triangle(RayMesh *mesh, int a, int b, int c, int material);

Vec3 ray_mesh_position(const RayMesh *mesh, int vertex);
Vec3 ray_mesh_normal(const RayMesh *mesh, int vertex);

#endif
