// check.c - E05: what the order of splats, and the jump when two change places, must fulfil.
#include "exercises/harness/catalogue.h"
#include "splat2d/compositing.h"
#include "splat3d/camera.h"

#include <math.h>

// ---- the jump: a case is a1, a2, c1, c2, T ----

enum { A1, A2, C1, C2 = C1 + 3, T_FRONT = C2 + 3, JUMP_NUMBERS };

static void draw_jump(Rng *rng, int k, double *in) {
    in[A1] = rng_range(rng, 0.01, 0.98);
    in[A2] = rng_range(rng, 0.01, 0.98);
    for (int c = 0; c < 6; c++) in[C1 + c] = rng_uniform(rng);
    in[T_FRONT] = rng_range(rng, 0.01, 1);
    if (k == 0)
        for (int c = 0; c < 3; c++) in[C2 + c] = in[C1 + c];
    if (k == 1 || k == 2) in[k == 1 ? A1 : A2] = 0;
}

static bool allows_jump(const double *in) {
    for (int i = 0; i < JUMP_NUMBERS; i++)
        if (in[i] < 0 || in[i] > 1) return false;
    return in[A1] <= 0.99 && in[A2] <= 0.99;
}

// The two splats laid over each other by composite_blend(), in either order, behind what leaves T.
static void blend_both(const double *in, bool second_first, double rgb[3]) {
    CompositeRule rule = {.alpha_max = 1, .alpha_min = 0, .stop = 0, .rule = STOP_AFTER_BLEND};
    Composite pixel = composite_begin();
    pixel.transmittance = in[T_FRONT];
    for (int k = 0; k < 2; k++) {
        bool is_second = (k == 1) != second_first;
        composite_blend(&pixel, &rule, in[is_second ? A2 : A1], in + (is_second ? C2 : C1));
    }
    for (int c = 0; c < 3; c++) rgb[c] = pixel.rgb[c];
}

static void jump(Trial *t, const double *in) {
    double a1 = in[A1], a2 = in[A2], T = in[T_FRONT], returned, one[3], other[3], sum = 0;
    const double *c1 = in + C1, *c2 = in + C2;
    CALL(trial_call, t, "pop_delta", IN(a1), IN(a2), IN_ARRAY(c1, 3), IN_ARRAY(c2, 3), IN(T), OUT(returned));
    blend_both(in, false, one);
    blend_both(in, true, other);
    for (int c = 0; c < 3; c++) sum += (one[c] - other[c]) * (one[c] - other[c]);
    trial_near1(t, "the length of the difference between the two pictures, as they are composited", returned, sqrt(sum),
                1);
}

// ---- the order: a case is n, three angles of the camera, t, and room for means ----

enum { N, ANGLES, TRANSLATION = ANGLES + 3, MEANS = TRANSLATION + 3, SPLATS = 12, ORDER_NUMBERS = MEANS + 3 * SPLATS };

static const double DEPTH_GAP = 1e-3; // depths closer than this could change places in float

// First about y (yaw), then x, then z; an angle of zero leaves the numbers exact.
static Mat3 rotation_of(const double angles[3]) {
    double c[3], s[3];
    for (int i = 0; i < 3; i++) c[i] = cos(angles[i]), s[i] = sin(angles[i]);
    Mat3 yaw = {{c[0], 0, -s[0], 0, 1, 0, s[0], 0, c[0]}}, pitch = {{1, 0, 0, 0, c[1], -s[1], 0, s[1], c[1]}},
         roll = {{c[2], -s[2], 0, s[2], c[2], 0, 0, 0, 1}};
    Mat3 both = mat3_multiply(&pitch, &yaw);
    return mat3_multiply(&roll, &both);
}

static Camera camera_of(const double *in) {
    return (Camera){.width = 160,
                    .height = 120,
                    .fx = 100,
                    .fy = 100,
                    .cx = 80,
                    .cy = 60,
                    .rotation = rotation_of(in + ANGLES),
                    .translation = vec3(in[TRANSLATION], in[TRANSLATION + 1], in[TRANSLATION + 2])};
}

static double depth_of(const Camera *camera, const double *mean) {
    return camera_point(camera, vec3(mean[0], mean[1], mean[2])).z;
}

// The Cam of exercise.h as numbers.
enum { CAM_NUMBERS = 18 };
static void cam_numbers(const Camera *camera, double numbers[CAM_NUMBERS]) {
    const double head[6] = {camera->width, camera->height, camera->fx, camera->fy, camera->cx, camera->cy};
    for (int i = 0; i < 6; i++) numbers[i] = head[i];
    for (int i = 0; i < 9; i++) numbers[6 + i] = camera->rotation.m[i];
    numbers[15] = camera->translation.x, numbers[16] = camera->translation.y, numbers[17] = camera->translation.z;
}

static double call_order(Trial *t, const Camera *camera, const double *means, int count, double *idx) {
    double c[CAM_NUMBERS], n = count, returned;
    const double *mu = means;
    cam_numbers(camera, c);
    CALL(trial_call, t, "order_by_depth", IN_ARRAY(c, CAM_NUMBERS), IN_ARRAY(mu, 3 * count), IN(n),
         OUT_ARRAY(idx, count), OUT(returned));
    return returned;
}

// The reference: of those in front that are not taken yet, the nearest, and of equal ones the first.
static int reference_order(const Camera *camera, const double *means, int n, double *idx) {
    bool taken[SPLATS] = {false};
    for (int count = 0;; count++) {
        int best = -1;
        for (int i = 0; i < n; i++) {
            double z = depth_of(camera, means + 3 * i);
            if (!taken[i] && z > 0 && (best < 0 || z < depth_of(camera, means + 3 * best))) best = i;
        }
        if (best < 0) return count;
        taken[best] = true;
        idx[count] = best;
    }
}

// Depths are well apart, and away from the camera's plane; or exactly equal, where the camera is not turned and numbers are whole.
static bool is_clear(const double *in, bool ties) {
    Camera camera = camera_of(in);
    int n = (int)in[N];
    for (int i = 0; i < n; i++) {
        double z = depth_of(&camera, in + MEANS + 3 * i);
        if (fabs(z) < DEPTH_GAP) return false;
        for (int j = 0; j < i; j++) {
            double gap = fabs(z - depth_of(&camera, in + MEANS + 3 * j));
            if (gap < DEPTH_GAP && !(ties && gap == 0)) return false;
        }
    }
    return true;
}

static bool allows_count(const double *in) {
    if (in[N] != floor(in[N]) || in[N] < 0 || in[N] > SPLATS) return false;
    for (int i = 1; i < ORDER_NUMBERS; i++)
        if (fabs(in[i]) > 100) return false;
    return true;
}

static bool allows_clear(const double *in) { return allows_count(in) && is_clear(in, false); }

static bool allows_in_front(const double *in) {
    if (!allows_clear(in)) return false;
    Camera camera = camera_of(in);
    for (int i = 0; i < (int)in[N]; i++)
        if (depth_of(&camera, in + MEANS + 3 * i) <= 0) return false;
    return true;
}

static void draw_around(Rng *rng, int n, double *in) {
    in[N] = n;
    for (int i = 0; i < 3; i++) in[ANGLES + i] = rng_range(rng, -M_PI, M_PI);
    for (int i = 0; i < 3; i++) in[TRANSLATION + i] = (float)rng_range(rng, -3, 3);
    for (int i = 0; i < 3 * n; i++) in[MEANS + i] = (float)rng_range(rng, -4, 4);
}

// Means in a box before the camera: points in its axes, taken back to the world.
static void draw_in_front(Rng *rng, int k, double *in) {
    do {
        draw_around(rng, k < 2 ? k : 2 + (int)rng_below(rng, SPLATS - 1), in);
        Mat3 R = rotation_of(in + ANGLES), back = mat3_transpose(&R);
        for (int i = 0; i < (int)in[N]; i++) {
            Vec3 seen = vec3(rng_range(rng, -3, 3), rng_range(rng, -3, 3), rng_range(rng, 0.5, 5));
            Vec3 mean =
                mat3_apply(&back, vec3_sub(seen, vec3(in[TRANSLATION], in[TRANSLATION + 1], in[TRANSLATION + 2])));
            in[MEANS + 3 * i] = (float)mean.x, in[MEANS + 3 * i + 1] = (float)mean.y,
                           in[MEANS + 3 * i + 2] = (float)mean.z;
        }
    } while (!allows_in_front(in));
}

static void draw_all_round(Rng *rng, int k, double *in) {
    do draw_around(rng, k < 2 ? 1 + k : 2 + (int)rng_below(rng, SPLATS - 1), in);
    while (!allows_clear(in));
}

// Whole numbers and no turn: depths are exact, and only 1, 2 or 3.
static void draw_ties(Rng *rng, int k, double *in) {
    draw_around(rng, 3 + (int)rng_below(rng, SPLATS - 2), in);
    for (int i = 0; i < 3; i++) in[ANGLES + i] = 0, in[TRANSLATION + i] = i < 2 ? (double)rng_below(rng, 3) : 0;
    for (int i = 0; i < (int)in[N]; i++) {
        for (int c = 0; c < 2; c++) in[MEANS + 3 * i + c] = (double)rng_below(rng, 7) - 3;
        in[MEANS + 3 * i + 2] = 1 + (double)rng_below(rng, k == 0 ? 1 : 3);
    }
}

static bool allows_ties(const double *in) {
    if (!allows_count(in) || !is_clear(in, true)) return false;
    for (int i = 0; i < 3; i++)
        if (in[ANGLES + i] != 0) return false;
    for (int i = 0; i < ORDER_NUMBERS; i++)
        if (in[i] != rint(in[i])) return false;
    return true;
}

static void order(Trial *t, const double *in) {
    Camera camera = camera_of(in);
    double idx[SPLATS], want[SPLATS];
    int n = (int)in[N], expected = reference_order(&camera, in + MEANS, n, want);
    double returned = call_order(t, &camera, in + MEANS, n, idx);
    trial_equal(t, "the returned value: how many splats are in front of the camera", returned, expected);
    trial_within(t, "idx: the indices, nearest first", idx, want, expected, 0);
}

// ---- turning on the spot: two splats and a camera at the origin change places when it turns ----

// A case is x1, y1, z1, x2, y2, z2: one on either side.
static void draw_pair(Rng *rng, int k, double *in) {
    (void)k;
    for (int i = 0; i < 2; i++) {
        in[3 * i] = (i ? 1 : -1) * rng_range(rng, 0.5, 2);
        in[3 * i + 1] = rng_range(rng, -1, 1);
        in[3 * i + 2] = rng_range(rng, 3, 4);
    }
}

static bool allows_pair(const double *in) {
    return in[0] <= -0.5 && in[3] >= 0.5 && in[2] >= 3 && in[5] >= 3 && in[2] <= 4 && in[5] <= 4 && fabs(in[0]) <= 2 &&
           in[3] <= 2;
}

static double first_of(Trial *t, const double *in, double yaw) {
    double angles[3] = {yaw, 0, 0}, idx[2];
    Camera camera = {
        .width = 160, .height = 120, .fx = 100, .fy = 100, .cx = 80, .cy = 60, .rotation = rotation_of(angles)};
    call_order(t, &camera, in, 2, idx);
    return idx[0];
}

static const double TURN = 0.9; // rad to either side; both splats stay in front
enum { HALVINGS = 25 };         // 1.8 / 2^25 = 5e-8 rad

// z = sin(yaw) x + cos(yaw) z0 is equal for both at tan(yaw) = (z1 - z2) / (x2 - x1).
static void flip(Trial *t, const double *in) {
    double low = -TURN, high = TURN, at_low = first_of(t, in, low), at_high = first_of(t, in, high);
    trial_equal(t, "who is first when the camera has turned by -0.9 rad on the spot", at_low, 1);
    trial_equal(t, "who is first when it has turned by 0.9 rad: they have changed places", at_high, 0);
    for (int i = 0; i < HALVINGS; i++) {
        double middle = (low + high) / 2;
        if (first_of(t, in, middle) == 1)
            low = middle;
        else
            high = middle;
    }
    double found = (low + high) / 2, want = atan2(in[2] - in[5], in[3] - in[0]);
    trial_within(t, "the yaw at which your order flips, rad, found by halving: where both have the same z", &found,
                 &want, 1, 1e-6);
}

// ---- picture: the splats as discs, the first of the order on top ----

static void paint_disc(ImageF *image, double x, double y, double radius, int index) {
    static const float COLOURS[6][3] = {{0.9f, 0.3f, 0.2f},  {0.2f, 0.7f, 0.9f}, {0.95f, 0.8f, 0.2f},
                                        {0.4f, 0.8f, 0.35f}, {0.7f, 0.4f, 0.9f}, {0.9f, 0.9f, 0.9f}};
    float dim = index < 6 ? 1 : 0.55f;
    for (int j = 0; j < image->height; j++)
        for (int i = 0; i < image->width; i++) {
            double r = hypot(i + 0.5 - x, j + 0.5 - y) / radius;
            for (int c = 0; r <= 1 && c < 3; c++)
                image->values[(j * image->width + i) * 3 + c] = r > 0.9 ? 0 : dim * COLOURS[index % 6][c];
        }
}

static ImageF order_picture(const Camera *camera, const double *means, int n, const double *idx, double count) {
    static const double RADIUS = 0.8; // world units
    ImageF image = imagef_create(camera->width, camera->height, 3);
    for (int k = (int)fmin(count, n) - 1; k >= 0; k--) {
        double x, y, z;
        if (!(idx[k] >= 0 && idx[k] < n)) continue;
        const double *m = means + 3 * (int)idx[k];
        if (camera_project(camera, vec3(m[0], m[1], m[2]), &x, &y, &z) && z > 0.1)
            paint_disc(&image, x, y, RADIUS * camera->fx / z, (int)idx[k]);
    }
    return image;
}

static bool picture(Subject *subject, const double *in, ImageF *yours, ImageF *reference) {
    Camera camera = camera_of(in);
    double c[CAM_NUMBERS], n = in[N], returned, idx[SPLATS], want[SPLATS];
    const double *mu = in + MEANS;
    cam_numbers(&camera, c);
    if (!CALL(subject_call, subject, "order_by_depth", IN_ARRAY(c, CAM_NUMBERS), IN_ARRAY(mu, 3 * (int)n), IN(n),
              OUT_ARRAY(idx, (int)n), OUT(returned)))
        return false;
    int count = reference_order(&camera, mu, (int)n, want);
    *yours = order_picture(&camera, mu, (int)n, idx, returned);
    *reference = order_picture(&camera, mu, (int)n, want, count);
    return true;
}

static const Rung RUNGS[] = {
    {.name = "jump",
     .claim = "the jump is that between the two pictures, and nothing for equal colours or an alpha of 0",
     .count = JUMP_NUMBERS,
     .draw = draw_jump,
     .allows = allows_jump,
     .check = jump},
    {.name = "order",
     .claim = "splats come by their z in the camera's axes, nearest first",
     .count = ORDER_NUMBERS,
     .draw = draw_in_front,
     .allows = allows_in_front,
     .check = order,
     .picture = picture},
    {.name = "behind",
     .claim = "what is behind the camera is left out",
     .count = ORDER_NUMBERS,
     .draw = draw_all_round,
     .allows = allows_clear,
     .check = order,
     .picture = picture},
    {.name = "ties",
     .claim = "equal depths keep the order of their indices",
     .count = ORDER_NUMBERS,
     .draw = draw_ties,
     .allows = allows_ties,
     .check = order,
     .picture = picture},
    {.name = "flip",
     .claim = "a camera that turns on the spot flips two splats where their z is equal",
     .cases = 2,
     .count = 6,
     .draw = draw_pair,
     .allows = allows_pair,
     .double_only = true,
     .check = flip},
};

const Exercise EXERCISE_POPPING = {
    .number = 5,
    .name = "popping",
    .title = "the order of splats, and the jump when two change places",
    .minutes = 40,
    .unlocks = "your order of the blobs: splatlab widget --mine; and the jump of splatlab demo popping, predicted",
    .rungs = RUNGS,
    .rung_count = sizeof RUNGS / sizeof *RUNGS,
};
