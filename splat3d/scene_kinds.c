#include "splat3d/scene_kinds.h"

int scene_cells(const SceneRequest *request, int finest, int least) {
    int cells = (int)(finest * request->detail + 0.5);
    return cells > least ? cells : least;
}

int scene_painted(const SceneRequest *request, RayScene *scene, RayPainter *painter, Paint paint, int smaller,
                  RayMaterial material) {
    int size = request->texture_size >> smaller;
    paint.seed += (uint32_t)request->seed * 1000u;
    material.texture = ray_scene_add_texture(scene, size < 32 ? 32 : size, painter, &paint);
    if (vec3_length(material.tint) == 0) material.tint = vec3(1, 1, 1);
    return ray_scene_add_material(scene, material);
}
