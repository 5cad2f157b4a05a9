// sphere.c - the product rule on the sphere, and the globe.
#include "exercises/harness/sphere.h"

// Abramowitz and Stegun, table 25.4, n = 4.
static const double RING_Z[SPHERE_RINGS] = {-0.861136311594052575, -0.339981043584856265, 0.339981043584856265,
                                            0.861136311594052575};
static const double RING_WEIGHT[SPHERE_RINGS] = {0.347854845137453857, 0.652145154862546143, 0.652145154862546143,
                                                 0.347854845137453857};

SphereNode sphere_node(int i) {
    int ring = i / SPHERE_STEPS;
    double z = RING_Z[ring], r = sqrt(1 - z * z), phi = 2 * M_PI * (i % SPHERE_STEPS) / SPHERE_STEPS;
    return (SphereNode){vec3(r * cos(phi), r * sin(phi), z), RING_WEIGHT[ring] * 2 * M_PI / SPHERE_STEPS};
}

bool sphere_globe(int side, int x, int y, Vec3 *direction) {
    double u = 2 * (x + 0.5) / side - 1, v = 2 * (y + 0.5) / side - 1, rest = 1 - u * u - v * v;
    if (!(rest > 0)) return false;
    *direction = vec3(u, v, sqrt(rest));
    return true;
}
