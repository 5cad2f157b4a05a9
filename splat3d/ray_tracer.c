#include "splat3d/ray_tracer.h"

#include "lab/base/mem.h"
#include "lab/base/parallel.h"
#include "splat3d/ray_shade.h"

enum { PARTS = 2 };                     // a side of a pixel; each round of refinement sends one ray through each part
static const double SAME_COLOUR = 0.08; // largest difference of a channel, linear

// What the ray through a pixel's centre found; the refinement rule reads it.
typedef struct {
    float position[3], normal[3];
    float plain;
    int material; // -1: sky or lamp
} Probe;

typedef struct {
    const RayScene *scene;
    const Camera *camera;
    uint64_t seed;
    int view;
    Vec3 eye, forward;
    double width_per_unit; // of a pixel
    Probe *probe;          // (H, W)
    ImageF *rgb, *depth;
} Job;

// Highlights are rolled off instead of cut: the identity up to the knee, then towards 1.
static double roll_off(double x) {
    const double knee = 0.7;
    return x <= knee ? x : knee + (1 - knee) * (1 - exp(-(x - knee) / (1 - knee)));
}

// IEC 61966-2-1.
static double encode_srgb(double x) { return x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1 / 2.4) - 0.055; }

static void store_pixel(const Job *job, int x, int y, Vec3 sum, double count) {
    float *out = job->rgb->values + 3 * ((size_t)y * (size_t)job->camera->width + (size_t)x);
    out[0] = (float)encode_srgb(sum.x / count);
    out[1] = (float)encode_srgb(sum.y / count);
    out[2] = (float)encode_srgb(sum.z / count);
}

static Vec3 rolled_off(Vec3 radiance) { return vec3(roll_off(radiance.x), roll_off(radiance.y), roll_off(radiance.z)); }

static void trace_centres(void *context, int y) {
    Job *job = context;
    for (int x = 0; x < job->camera->width; x++) {
        size_t pixel = (size_t)y * (size_t)job->camera->width + (size_t)x;
        Rng rng = rng_at(job->seed, RNG_SCENE_PIXEL, (uint32_t)job->view, (uint32_t)pixel);
        Ray ray = {job->eye, camera_ray(job->camera, x + 0.5, y + 0.5), 1e9};
        RayShade s = ray_shade(job->scene, &ray, job->width_per_unit, &rng);
        store_pixel(job, x, y, rolled_off(s.radiance), 1);
        if (s.material >= 0) job->depth->values[pixel] = (float)(s.distance * vec3_dot(ray.direction, job->forward));
        job->probe[pixel] = (Probe){{(float)s.position.x, (float)s.position.y, (float)s.position.z},
                                    {(float)s.normal.x, (float)s.normal.y, (float)s.normal.z},
                                    (float)sqrt(s.plain),
                                    s.material};
    }
}

// Does something else than texture change between two neighbouring pixels? Other material, a step off the tangent plane, a crease, or other
// light.
static bool differ(const Probe *a, const Probe *b, double plane_tolerance) {
    if (a->material != b->material) return true;
    if (a->material < 0) return a->plain != b->plain;
    double off_plane = 0, cosine = 0;
    for (int k = 0; k < 3; k++) {
        off_plane += a->normal[k] * (double)(b->position[k] - a->position[k]);
        cosine += a->normal[k] * (double)b->normal[k];
    }
    return fabs(off_plane) > plane_tolerance || cosine < 0.9 || fabsf(a->plain - b->plain) > 0.05f;
}

static bool needs_refinement(const Job *job, int x, int y) {
    int width = job->camera->width, height = job->camera->height;
    const Probe *here = &job->probe[(size_t)y * (size_t)width + (size_t)x];
    Vec3 away = vec3_sub(vec3(here->position[0], here->position[1], here->position[2]), job->eye);
    double plane_tolerance = 2 * job->width_per_unit * vec3_length(away);
    for (int j = y > 0 ? y - 1 : 0; j <= y + 1 && j < height; j++)
        for (int i = x > 0 ? x - 1 : 0; i <= x + 1 && i < width; i++)
            if (differ(here, &job->probe[(size_t)j * (size_t)width + (size_t)i], plane_tolerance)) return true;
    return false;
}

typedef struct {
    Vec3 sum, low, high; // of the rays' colours
    int count;
} Colours;

static void add_colour(Colours *c, Vec3 colour) {
    c->sum = vec3_add(c->sum, colour);
    c->low = vec3(fmin(c->low.x, colour.x), fmin(c->low.y, colour.y), fmin(c->low.z, colour.z));
    c->high = vec3(fmax(c->high.x, colour.x), fmax(c->high.y, colour.y), fmax(c->high.z, colour.z));
    c->count++;
}

// One round of refinement: a ray at a random place of each part of the pixel.
static void trace_parts(const Job *job, int x, int y, Rng *rng, Colours *colours) {
    for (int k = 0; k < PARTS * PARTS; k++) {
        double px = x + (k % PARTS + rng_uniform(rng)) / PARTS, py = y + (k / PARTS + rng_uniform(rng)) / PARTS;
        Ray ray = {job->eye, camera_ray(job->camera, px, py), 1e9};
        RayShade s = ray_shade(job->scene, &ray, 0.5 * job->width_per_unit, rng);
        add_colour(colours, rolled_off(s.radiance));
    }
}

static void refine_row(void *context, int y) {
    Job *job = context;
    for (int x = 0; x < job->camera->width; x++) {
        if (!needs_refinement(job, x, y)) continue;
        uint32_t pixel = (uint32_t)(y * job->camera->width + x) | 0x80000000u; // apart from the numbers of the centres
        Rng rng = rng_at(job->seed, RNG_SCENE_PIXEL, (uint32_t)job->view, pixel);
        Colours colours = {.low = {1, 1, 1}};
        trace_parts(job, x, y, &rng, &colours);
        Vec3 range = vec3_sub(colours.high, colours.low);
        if (range.x > SAME_COLOUR || range.y > SAME_COLOUR || range.z > SAME_COLOUR)
            trace_parts(job, x, y, &rng, &colours);
        store_pixel(job, x, y, colours.sum, colours.count);
    }
}

void ray_tracer_picture(const RayScene *scene, const Camera *camera, uint64_t seed, int view, ImageF *rgb,
                        ImageF *depth) {
    *rgb = imagef_create(camera->width, camera->height, 3);
    *depth = imagef_create(camera->width, camera->height, 1);
    const double *r = camera->rotation.m;
    Job job = {.scene = scene,
               .camera = camera,
               .seed = seed,
               .view = view,
               .eye = camera_position(camera),
               .forward = vec3(r[6], r[7], r[8]),
               .width_per_unit = 1 / camera->fx,
               .probe = mem_alloc((size_t)camera->width * (size_t)camera->height, sizeof(Probe)),
               .rgb = rgb,
               .depth = depth};
    parallel_for(camera->height, trace_centres, &job);
    parallel_for(camera->height, refine_row, &job);
    mem_free(job.probe);
}
