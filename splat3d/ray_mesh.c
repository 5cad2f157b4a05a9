#include "splat3d/ray_mesh.h"

#include "lab/base/mem.h"

void ray_mesh_destroy(RayMesh *mesh) {
    mem_free(mesh->position);
    mem_free(mesh->normal);
    mem_free(mesh->uv);
    mem_free(mesh->light);
    mem_free(mesh->light_from);
    mem_free(mesh->corner);
    mem_free(mesh->material);
    *mesh = (RayMesh){0};
}

static void grow_vertices(RayMesh *mesh) {
    size_t old = (size_t)mesh->vertex_room, room = old ? 2 * old : 1024;
    mesh->position = mem_resize(mesh->position, 3 * old, 3 * room, sizeof(float));
    mesh->normal = mem_resize(mesh->normal, 3 * old, 3 * room, sizeof(float));
    mesh->uv = mem_resize(mesh->uv, 2 * old, 2 * room, sizeof(float));
    mesh->light = mem_resize(mesh->light, 3 * old, 3 * room, sizeof(float));
    mesh->light_from = mem_resize(mesh->light_from, old, room, sizeof(int));
    mesh->vertex_room = (int)room;
}

int ray_mesh_vertex(RayMesh *mesh, Vec3 position, Vec3 normal, double u, double v) {
    if (mesh->vertex_count == mesh->vertex_room) grow_vertices(mesh);
    int i = mesh->vertex_count++;
    float *p = mesh->position + 3 * i, *n = mesh->normal + 3 * i;
    p[0] = (float)position.x, p[1] = (float)position.y, p[2] = (float)position.z;
    n[0] = (float)normal.x, n[1] = (float)normal.y, n[2] = (float)normal.z;
    mesh->uv[2 * i] = (float)u, mesh->uv[2 * i + 1] = (float)v;
    mesh->light_from[i] = i;
    return i;
}

void ray_mesh_triangle(RayMesh *mesh, int a, int b, int c, int material) {
    if (mesh->triangle_count == mesh->triangle_room) {
        size_t old = (size_t)mesh->triangle_room, room = old ? 2 * old : 1024;
        mesh->corner = mem_resize(mesh->corner, 3 * old, 3 * room, sizeof(int));
        mesh->material = mem_resize(mesh->material, old, room, 1);
        mesh->triangle_room = (int)room;
    }
    int i = mesh->triangle_count++;
    mesh->corner[3 * i] = a, mesh->corner[3 * i + 1] = b, mesh->corner[3 * i + 2] = c;
    mesh->material[i] = (uint8_t)material;
}

Vec3 ray_mesh_position(const RayMesh *mesh, int vertex) {
    const float *p = mesh->position + 3 * vertex;
    return vec3(p[0], p[1], p[2]);
}

Vec3 ray_mesh_normal(const RayMesh *mesh, int vertex) {
    const float *n = mesh->normal + 3 * vertex;
    return vec3(n[0], n[1], n[2]);
}
