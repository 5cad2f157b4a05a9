// Rays against triangles, light, textures and whole pictures of small scenes with known answers.
#include "splat3d/ray_tracer.h"

#include "lab/base/rng.h"
#include "splat3d/ray_light.h"
#include "splat3d/ray_shapes.h"
#include "splat3d/ray_surface.h"
#include "tests/support/support.h"

#include <stdlib.h>
#include <string.h>

static const double PI = 3.14159265358979323846;

static int plain_material(RayScene *scene, Vec3 tint) {
    return ray_scene_add_material(scene, (RayMaterial){.texture = -1, .tint = tint});
}

static Vec3 random_unit(Rng *rng) { return vec3_normalize(vec3(rng_normal(rng), rng_normal(rng), rng_normal(rng))); }

// A soup of triangles of very different sizes.
static RayMesh random_soup(uint64_t seed, int triangles) {
    RayMesh mesh = {0};
    Rng rng = rng_at(seed, RNG_TEST, 0, 0);
    for (int i = 0; i < triangles; i++) {
        Vec3 centre = vec3(rng_range(&rng, -2, 2), rng_range(&rng, -2, 2), rng_range(&rng, -2, 2));
        double size = exp(rng_range(&rng, -4, 0.5));
        int first = mesh.vertex_count;
        for (int k = 0; k < 3; k++)
            ray_mesh_vertex(&mesh, vec3_add(centre, vec3_scale(random_unit(&rng), size)), vec3(0, 0, 1), 0, 0);
        ray_mesh_triangle(&mesh, first, first + 1, first + 2, 0);
    }
    return mesh;
}

// The plain way, in double: every triangle, by the signed volumes that the ray makes with its edges.
static double nearest_by_hand(const RayMesh *mesh, const Ray *ray) {
    double nearest = ray->far;
    for (int t = 0; t < mesh->triangle_count; t++) {
        Vec3 p[3];
        for (int k = 0; k < 3; k++) p[k] = vec3_sub(ray_mesh_position(mesh, mesh->corner[3 * t + k]), ray->origin);
        double a = vec3_dot(ray->direction, vec3_cross(p[0], p[1])),
               b = vec3_dot(ray->direction, vec3_cross(p[1], p[2]));
        double c = vec3_dot(ray->direction, vec3_cross(p[2], p[0]));
        if (!((a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0)) || a + b + c == 0) continue;
        double distance = (b * vec3_dot(p[0], ray->direction) + c * vec3_dot(p[1], ray->direction) +
                           a * vec3_dot(p[2], ray->direction)) /
                          (a + b + c);
        if (distance > 0 && distance < nearest) nearest = distance;
    }
    return nearest;
}

static void the_tree_finds_what_trying_every_triangle_finds(void **state) {
    (void)state;
    const uint64_t seed = 20;
    RayMesh mesh = random_soup(seed, 700);
    RayBvh bvh = ray_bvh_build(&mesh);
    int hits = 0, odd = 0; // float may decide otherwise where a ray grazes an edge
    for (int i = 0; i < 4000; i++) {
        Rng rng = rng_at(seed, RNG_TEST, 1, (uint32_t)i);
        Ray ray = {vec3_scale(random_unit(&rng), 4), random_unit(&rng), 100};
        RayHit hit;
        double expected = nearest_by_hand(&mesh, &ray);
        bool found = ray_bvh_nearest(&bvh, &ray, &hit);
        double actual = found ? hit.distance : ray.far;
        hits += found;
        odd += fabs(actual - expected) > 1e-3;
        assert_int_equal(ray_bvh_blocked(&bvh, &ray), found);
        if (!found) continue;
        ray.far = 0.999 * hit.distance; // nothing stands before the nearest
        assert_false(ray_bvh_blocked(&bvh, &ray));
    }
    if (hits < 500 || odd > 4) fail_msg("seed %d: %d hits, %d of 4000 rays disagree", (int)seed, hits, odd);
    ray_bvh_destroy(&bvh);
    ray_mesh_destroy(&mesh);
}

static void nothing_is_hit_in_an_empty_scene(void **state) {
    (void)state;
    RayMesh mesh = {0};
    RayBvh bvh = ray_bvh_build(&mesh);
    Ray ray = {vec3(0, 0, 0), vec3(0, 0, 1), 1e9};
    RayHit hit;
    assert_false(ray_bvh_nearest(&bvh, &ray, &hit));
    ray_bvh_destroy(&bvh);
    ray_mesh_destroy(&mesh);
}

static void many_triangles_in_one_place_are_no_trouble(void **state) {
    (void)state;
    RayMesh mesh = {0};
    for (int i = 0; i < 300; i++)
        ray_shape_patch(&mesh, vec3(-1, -1, 1), vec3(2, 0, 0), vec3(0, 2, 0), (RayGrid){1, 1, 1, 1, 0});
    RayBvh bvh = ray_bvh_build(&mesh);
    Ray ray = {vec3(0.3, 0.2, 5), vec3(0, 0, -1), 1e9};
    RayHit hit;
    assert_true(ray_bvh_nearest(&bvh, &ray, &hit));
    support_near(hit.distance, 4, 1e-5, "distance");
    ray_bvh_destroy(&bvh);
    ray_mesh_destroy(&mesh);
}

// A closed shape, seen from inside, has no gap at its seams; normals look outwards.
static void a_ball_and_a_box_are_closed_and_face_outwards(void **state) {
    (void)state;
    for (int shape = 0; shape < 2; shape++) {
        RayMesh mesh = {0};
        RayFrame frame = ray_frame_along(vec3(1, 2, 3), vec3(0.3, -0.5, 0.8));
        if (shape == 0) ray_shape_ball(&mesh, frame, 0.5, 48, 0);
        if (shape == 1) ray_shape_box(&mesh, frame, vec3(0.5, 0.4, 0.3), 0.13, 0, 0);
        RayBvh bvh = ray_bvh_build(&mesh);
        for (int i = 0; i < 5000; i++) {
            Rng rng = rng_at(21, RNG_TEST, (uint32_t)shape, (uint32_t)i);
            Ray ray = {frame.origin, random_unit(&rng), 1e9};
            RayHit hit;
            if (!ray_bvh_nearest(&bvh, &ray, &hit)) fail_msg("shape %d: ray %d escapes", shape, i);
            assert_true(vec3_dot(ray_mesh_normal(&mesh, mesh.corner[3 * hit.triangle]), ray.direction) > 0);
            if (shape == 0) support_near(hit.distance, 0.5, 0.0022, "radius");
        }
        ray_bvh_destroy(&bvh);
        ray_mesh_destroy(&mesh);
    }
}

static void a_turned_form_has_sharp_edges_where_points_are_doubled(void **state) {
    (void)state;
    static const RayOutline can[] = {{0.5, 0}, {0.5, 1}, {0.5, 1}, {0, 1}};
    RayMesh mesh = {0};
    ray_shape_turned(&mesh, ray_frame_turned(vec3(0, 0, 0), 0), can, 4, (RayGrid){32, 9, 1, 1, 0});
    for (int i = 0; i < mesh.vertex_count; i++) {
        Vec3 n = ray_mesh_normal(&mesh, i), p = ray_mesh_position(&mesh, i);
        double outwards = hypot(p.x, p.y) > 0 ? (n.x * p.x + n.y * p.y) / hypot(p.x, p.y) : 0;
        assert_true(fabs(n.z) < 1e-3 || fabs(n.z - 1) < 1e-3); // wall or lid, nothing between
        if (n.z < 0.5) support_near(outwards, 1, 1e-3, "a wall's normal");
    }
    ray_mesh_destroy(&mesh);
}

static RayTexel stripes(const void *context, double u, double v) {
    (void)context, (void)v;
    double x = 0.5 + 0.5 * sin(2 * PI * 16 * u);
    return (RayTexel){vec3(x, x, x), x};
}

static void a_far_texture_is_its_mean_and_a_near_one_is_sharp(void **state) {
    (void)state;
    RayTexture t = ray_texture_paint(256, stripes, NULL);
    RayFootprint near = {0.002, 0, 0, 0.002}, far = {0.7, 0, 0, 0.7}, along = {0, 0.02, 0.002, 0};
    const double crest = 0.25 / 16, valley = 0.75 / 16;
    assert_true(ray_texture_read(&t, crest, 0.4, near).colour.x > 0.95);
    assert_true(ray_texture_read(&t, valley, 0.4, near).colour.x < 0.05);
    support_near(ray_texture_read(&t, crest, 0.4, far).colour.x, 0.5, 0.03, "far");
    assert_true(ray_texture_read(&t, crest, 0.4, along).colour.x >
                0.8); // a long footprint along the stripes does not blur them
    support_near(ray_texture_mean(&t).y, 0.5, 0.03, "mean");
    assert_true(ray_texture_height(&t, crest, 0.1, 0.001) > 0.95);
    ray_texture_destroy(&t);
}

// A small lamp of area A at height h, straight above: irradiance / pi = L A / (pi h^2); half of it where a plate hides half of the lamp.
static void a_lamp_gives_the_light_of_the_inverse_square_law(void **state) {
    (void)state;
    for (int hidden = 0; hidden < 2; hidden++) {
        RayScene *scene = calloc(1, sizeof *scene);
        int grey = plain_material(scene, vec3(0, 0, 0)); // black, so that nothing bounces
        ray_shape_patch(&scene->mesh, vec3(-1, -1, 0), vec3(2, 0, 0), vec3(0, 2, 0), (RayGrid){2, 2, 1, 1, grey});
        if (hidden)
            ray_shape_patch(&scene->mesh, vec3(0, -1, 1), vec3(1, 0, 0), vec3(0, 2, 0), (RayGrid){1, 1, 1, 1, grey});
        ray_scene_add_lamp(scene, (RayLamp){vec3(-0.1, -0.1, 2), vec3(0, 0.2, 0), vec3(0.2, 0, 0), vec3(3, 3, 3)});
        scene->bvh = ray_bvh_build(&scene->mesh);
        assert_true(ray_light_store(scene, 10, 1));
        double middle = scene->mesh.light[3 * 4];
        support_near(middle, (hidden ? 0.5 : 1) * 3 * 0.04 / (PI * 4), hidden ? 0.0015 : 2e-4, "irradiance");
        double corner = scene->mesh.light[0]; // farther away, and slanting at both ends
        if (!hidden) support_near(corner, 3 * 0.04 * (4 / 6.0) / (PI * 6), 2e-4, "irradiance at the corner");
        ray_scene_destroy(scene);
        free(scene);
    }
}

// Under open sky of radiance 1 the light is 1; none of it comes into a closed room, not even at its corners.
static void open_sky_lights_a_plane_with_its_radiance(void **state) {
    (void)state;
    RayScene *scene = calloc(1, sizeof *scene);
    scene->sky = (RaySky){vec3(1, 1, 1), vec3(1, 1, 1), vec3(1, 1, 1), 0, 1, 0};
    int white = plain_material(scene, vec3(0.8, 0.8, 0.8));
    ray_shape_patch(&scene->mesh, vec3(-1, -1, 0), vec3(2, 0, 0), vec3(0, 2, 0), (RayGrid){4, 4, 1, 1, white});
    int first_of_box = scene->mesh.vertex_count;
    ray_shape_box(&scene->mesh, ray_frame_turned(vec3(0, 0, -5), 0), vec3(1, 1, 1), 0.5, 0, white);
    for (int i = first_of_box; i < scene->mesh.vertex_count; i++) // turned inside out: a closed room
        for (int k = 0; k < 3; k++) scene->mesh.normal[3 * i + k] *= -1;
    scene->bvh = ray_bvh_build(&scene->mesh);
    assert_true(ray_light_store(scene, 4, 1));
    for (int i = 0; i < first_of_box; i++) support_near(scene->mesh.light[3 * i], 1, 1e-5, "open sky");
    for (int i = first_of_box; i < scene->mesh.vertex_count; i++) assert_true(scene->mesh.light[3 * i] < 0.01);
    ray_scene_destroy(scene);
    free(scene);
}

// A ball on a plane under the sun.
static RayScene *ball_scene(void) {
    RayScene *scene = calloc(1, sizeof *scene);
    scene->sky = (RaySky){vec3(0.3, 0.5, 0.9), vec3(0.7, 0.8, 0.9), vec3(0.2, 0.2, 0.2), 0.5, 1, 0};
    scene->sun = (RaySun){vec3_normalize(vec3(-1, -1, 1)), vec3(2, 2, 2), 0.01};
    int ground = plain_material(scene, vec3(0.6, 0.6, 0.6));
    int shiny = ray_scene_add_material(scene, (RayMaterial){.texture = -1, .tint = {0.8, 0.1, 0.1}, .coat = 0.06});
    ray_shape_patch(&scene->mesh, vec3(-4, -4, 0), vec3(8, 0, 0), vec3(0, 8, 0), (RayGrid){24, 24, 1, 1, ground});
    ray_shape_ball(&scene->mesh, ray_frame_turned(vec3(0, 0, 0.5), 0), 0.5, 48, shiny);
    scene->bvh = ray_bvh_build(&scene->mesh);
    assert_true(ray_light_store(scene, 4, 1));
    return scene;
}

static void depth_is_camera_z_and_pictures_show_ball_shadow_and_sky(void **state) {
    (void)state;
    RayScene *scene = ball_scene();
    Camera camera = camera_look_at(vec3(0, -4, 0.5), vec3(0, 0, 0.5), vec3(0, 0, 1), 1.0, 64, 48);
    ImageF rgb, depth;
    ray_tracer_picture(scene, &camera, 1, 0, &rgb, &depth);
    support_near(depth.values[24 * 64 + 32], 3.5, 0.01, "ball"); // near the middle: the ball's front
    assert_true(depth.values[32] == 0);                          // top: sky
    const float *ball = rgb.values + 3 * (24 * 64 + 32), *sky = rgb.values + 3 * 32;
    assert_true(ball[0] > 1.5 * ball[2] && sky[2] > sky[0]);
    for (int y = 0; y < 48; y++)
        for (int x = 0; x < 64; x++) { // where the plane is seen, its depth follows from the ray
            Vec3 ray = camera_ray(&camera, x + 0.5, y + 0.5), eye = vec3(0, -4, 0.5);
            double to_plane = ray.z < 0 ? -eye.z / ray.z : 0, z = depth.values[y * 64 + x];
            if (ray.z < 0 && z > to_plane * ray.y - 1e-3) support_near(z, to_plane * ray.y, 1e-4 * z, "plane");
        }
    double shadow[2], place[2][2] = {{0.6, 0.6}, {-1.2, 0.6}}; // behind the ball as seen from the sun, and beside it
    for (int k = 0; k < 2; k++) {
        double px, py, z;
        Camera above = camera_look_at(vec3(0, 0, 5), vec3(0, 0, 0), vec3(0, 1, 0), 1.0, 64, 64);
        ImageF top, ignored;
        ray_tracer_picture(scene, &above, 1, 1, &top, &ignored);
        assert_true(camera_project(&above, vec3(place[k][0], place[k][1], 0), &px, &py, &z));
        shadow[k] = top.values[3 * ((int)py * 64 + (int)px)];
        imagef_destroy(&top);
        imagef_destroy(&ignored);
    }
    assert_true(shadow[0] < 0.75 * shadow[1]);
    imagef_destroy(&rgb);
    imagef_destroy(&depth);
    ray_scene_destroy(scene);
    free(scene);
}

static void a_picture_is_the_same_with_one_thread_and_with_two(void **state) {
    (void)state;
    ImageF rgb[2], depth[2];
    float *light[2];
    size_t lights = 0;
    for (int k = 0; k < 2; k++) {
        setenv("SPLATLAB_THREADS", k ? "2" : "1", 1);
        RayScene *scene = ball_scene();
        Camera camera = camera_look_at(vec3(1, -3, 1), vec3(0, 0, 0.5), vec3(0, 0, 1), 1.0, 64, 48);
        ray_tracer_picture(scene, &camera, 5, 3, &rgb[k], &depth[k]);
        lights = 3 * (size_t)scene->mesh.vertex_count;
        light[k] = malloc(lights * sizeof(float));
        memcpy(light[k], scene->mesh.light, lights * sizeof(float));
        ray_scene_destroy(scene);
        free(scene);
    }
    unsetenv("SPLATLAB_THREADS");
    assert_memory_equal(light[0], light[1], lights * sizeof(float));
    assert_memory_equal(rgb[0].values, rgb[1].values, 64 * 48 * 3 * sizeof(float));
    assert_memory_equal(depth[0].values, depth[1].values, 64 * 48 * sizeof(float));
    for (int k = 0; k < 2; k++) {
        imagef_destroy(&rgb[k]);
        imagef_destroy(&depth[k]);
        free(light[k]);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_tree_finds_what_trying_every_triangle_finds),
        cmocka_unit_test(nothing_is_hit_in_an_empty_scene),
        cmocka_unit_test(many_triangles_in_one_place_are_no_trouble),
        cmocka_unit_test(a_ball_and_a_box_are_closed_and_face_outwards),
        cmocka_unit_test(a_turned_form_has_sharp_edges_where_points_are_doubled),
        cmocka_unit_test(a_far_texture_is_its_mean_and_a_near_one_is_sharp),
        cmocka_unit_test(a_lamp_gives_the_light_of_the_inverse_square_law),
        cmocka_unit_test(open_sky_lights_a_plane_with_its_radiance),
        cmocka_unit_test(depth_is_camera_z_and_pictures_show_ball_shadow_and_sky),
        cmocka_unit_test(a_picture_is_the_same_with_one_thread_and_with_two),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
