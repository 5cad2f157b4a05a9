#include "splat3d/first_splats.h"

#include "lab/base/mem.h"
#include "lab/base/rng.h"
#include "splat3d/kd_tree.h"
#include "splat3d/morton_order.h"

#include <math.h>

static const double SH_CONSTANT = 0.28209479177387814; // Y_00 = 1 / (2 sqrt(pi))
static const double DISTANCE2_MIN = 1e-7;              // world units^2; points at one place still get an extent

Gaussians first_splats_from_points(const Points *points, int sh_degree, double first_opacity) {
    Gaussians g = gaussians_create(points->count, sh_degree);
    double *distance2 = mem_alloc((size_t)points->count, sizeof *distance2);
    KdTree tree = kd_tree_create(points->xyz, points->count);
    kd_tree_mean_distance2(&tree, 3, distance2);
    float logit = (float)log(first_opacity / (1 - first_opacity));
    for (int i = 0; i < g.count; i++) {
        float log_scale = (float)(0.5 * log(fmax(distance2[i], DISTANCE2_MIN)));
        for (int a = 0; a < 3; a++) {
            gaussians_at(&g, FIELD_MEAN, i)[a] = (float)points->xyz[3 * (size_t)i + a];
            gaussians_at(&g, FIELD_LOG_SCALE, i)[a] = log_scale;
            gaussians_at(&g, FIELD_SH0, i)[a] = (float)((points->rgb[3 * (size_t)i + a] / 255.0 - 0.5) / SH_CONSTANT);
        }
        gaussians_at(&g, FIELD_QUAT, i)[0] = 1;
        gaussians_at(&g, FIELD_OPACITY_LOGIT, i)[0] = logit;
    }
    kd_tree_destroy(&tree);
    mem_free(distance2);
    morton_arrange(&g);
    return g;
}

Points first_splats_random_points(const Dataset *dataset, int count, uint64_t seed) {
    Points points = points_create(count);
    const double centre[3] = {dataset->init_centre.x, dataset->init_centre.y, dataset->init_centre.z};
    for (int i = 0; i < count; i++) {
        Rng rng = rng_at(seed, RNG_INIT_POINTS, (uint32_t)i, 0);
        for (int a = 0; a < 3; a++) {
            double offset = rng_range(&rng, -dataset->init_half_width, dataset->init_half_width);
            points.xyz[3 * (size_t)i + a] = centre[a] + offset;
        }
        for (int a = 0; a < 3; a++) points.rgb[3 * (size_t)i + a] = (uint8_t)(124 + rng_below(&rng, 8));
    }
    return points;
}
