#include "splat3d/scene_foliage.h"

#include "lab/base/rng.h"
#include "splat3d/ray_shapes.h"

static const double PI = 3.14159265358979323846;

enum { PLANT_KIND = 100 }; // of random numbers

static Rng plant_rng(const Foliage *f) { return rng_at(f->seed, RNG_SCENE_LAYOUT, PLANT_KIND, f->id); }

static Vec3 random_direction(Rng *rng) {
    double z = rng_range(rng, -1, 1), angle = rng_range(rng, 0, 2 * PI), r = sqrt(1 - z * z);
    return vec3(r * cos(angle), r * sin(angle), z);
}

// One leaf at a place, turned roughly outwards.
static void add_leaf(RayMesh *mesh, const Foliage *f, Vec3 place, Vec3 outward, Rng *rng) {
    Vec3 along = vec3_add(vec3_scale(outward, 0.5), vec3_add(random_direction(rng), vec3(0, 0, 0.15)));
    along = vec3_scale(vec3_normalize(along), f->length * rng_range(rng, 0.7, 1.25));
    Vec3 face = vec3_add(vec3_add(outward, vec3(0, 0, 0.7)), vec3_scale(random_direction(rng), 0.8));
    int material = f->material[rng_below(rng, (uint32_t)f->materials)];
    ray_shape_leaf(mesh, place, along, face, f->width * rng_range(rng, 0.8, 1.2), material);
}

static void add_leaves(RayMesh *mesh, const Foliage *f, Vec3 centre, Vec3 half_axes, int leaves, Rng *rng) {
    for (int i = 0; i < leaves; i++) {
        Vec3 outward = random_direction(rng);
        double lump = 0.85 + 0.15 * sin(5 * outward.x + 3) * sin(4 * outward.y) + 0.1 * sin(7 * outward.z);
        double r = lump * pow(rng_uniform(rng), 0.3);
        Vec3 place = vec3_add(centre, vec3_mul(vec3_scale(outward, r), half_axes));
        add_leaf(mesh, f, place, outward, rng);
    }
}

void foliage_bush(RayMesh *mesh, const Foliage *foliage, Vec3 centre, Vec3 half_axes) {
    Rng rng = plant_rng(foliage);
    add_leaves(mesh, foliage, centre, half_axes, foliage->leaves, &rng);
}

void foliage_grass(RayMesh *mesh, const Foliage *foliage, Vec3 low, Vec3 high) {
    Rng rng = plant_rng(foliage);
    for (int i = 0; i < foliage->leaves; i++) {
        Vec3 foot = vec3(rng_range(&rng, low.x, high.x), rng_range(&rng, low.y, high.y), low.z);
        Vec3 along = vec3(0.35 * rng_normal(&rng), 0.35 * rng_normal(&rng), 1);
        along = vec3_scale(vec3_normalize(along), foliage->length * rng_range(&rng, 0.5, 1.2));
        double turn = rng_range(&rng, 0, 2 * PI);
        int material = foliage->material[rng_below(&rng, (uint32_t)foliage->materials)];
        ray_shape_leaf(mesh, foot, along, vec3(cos(turn), sin(turn), 0.3), foliage->width, material);
    }
}

void foliage_tree(RayMesh *mesh, const Foliage *foliage, Vec3 foot, double height, double spread, int branches,
                  int bark) {
    Rng rng = plant_rng(foliage);
    double lean_x = 0.06 * height * rng_normal(&rng), lean_y = 0.06 * height * rng_normal(&rng);
    Vec3 fork = vec3_add(foot, vec3(lean_x, lean_y, 0.55 * height));
    Vec3 trunk[3] = {foot, vec3_add(foot, vec3(0.7 * lean_x, -0.2 * lean_y, 0.3 * height)), fork};
    ray_shape_rod(mesh, trunk, 3, 0.035 * height, 10, 12, 2, bark);
    Vec3 lobe = vec3(0.62 * spread, 0.62 * spread, 0.5 * spread);
    int each = foliage->leaves / (branches + 1);
    for (int i = 0; i <= branches; i++) {
        double angle = 2 * PI * (i + 0.3 * rng_uniform(&rng)) / branches, out = i < branches ? 0.62 * spread : 0;
        double up = height + (i < branches ? rng_range(&rng, -0.15, 0.25) * spread : 0.5 * spread);
        Vec3 end = vec3_add(foot, vec3(lean_x + out * cos(angle), lean_y + out * sin(angle), up));
        Vec3 middle = vec3_add(vec3_lerp(fork, end, 0.5), vec3(0, 0, 0.05 * height));
        Vec3 limb[3] = {fork, middle, end};
        ray_shape_rod(mesh, limb, 3, 0.014 * height, 8, 7, 2, bark);
        add_leaves(mesh, foliage, end, lobe, each, &rng);
    }
}

void foliage_vine(RayMesh *mesh, const Foliage *foliage, const Vec3 *points, int count, double reach, int bark) {
    Rng rng = plant_rng(foliage);
    ray_shape_rod(mesh, points, count, 0.008, 12 * count, 6, 4, bark);
    for (int i = 0; i < foliage->leaves; i++) {
        double place = rng_uniform(&rng) * (count - 1);
        int segment = (int)place;
        Vec3 on_curve = vec3_lerp(points[segment], points[segment + 1], place - segment);
        Vec3 outward = random_direction(&rng);
        add_leaf(mesh, foliage, vec3_add(on_curve, vec3_scale(outward, reach * rng_uniform(&rng))), outward, &rng);
    }
}
