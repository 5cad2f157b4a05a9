// Sample scenes, small: the same files each time, true depth, points where structure from motion would put them, clean folders.
#include "splat3d/sample_scene.h"

#include "lab/base/fail.h"
#include "lab/base/log.h"
#include "lab/io/file.h"
#include "lab/io/image_io.h"
#include "splat3d/dataset.h"
#include "tests/support/support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 64, HEIGHT = 48, VIEWS = 12 };

typedef struct {
    char path[4096];
} Folder;

// Of a scene in the scratch folder; a copy, because support_path() soon uses its buffer again.
static Folder folder_of(const char *name) {
    Folder folder;
    snprintf(folder.path, sizeof folder.path, "%s", support_path(support_scratch(), name));
    return folder;
}

static const char *const NAMES[] = {"studio", "fence", "courtyard"};

static SampleSceneOptions small_options(void) { return (SampleSceneOptions){{WIDTH, HEIGHT}, VIEWS, 3}; }

static int write_once(void **state) {
    (void)state;
    const SampleSceneOptions options = small_options();
    log_set_quiet(true);
    setenv("SPLATLAB_THREADS", "1", 1);
    for (int i = 0; i < 3; i++)
        if (!sample_scene_write(NAMES[i], &options, support_path(support_scratch(), NAMES[i]))) {
            print_error("%s\n", fail_text());
            return 1;
        }
    return 0;
}

// A scene as it stands on disk, with its depth.
typedef struct {
    Dataset dataset;
    ImageF depth[VIEWS];
} Loaded;

static Loaded load(const char *name) {
    Loaded l = {0};
    const Folder folder = folder_of(name);
    if (!dataset_open(folder.path, 1, &l.dataset)) fail_msg("%s", fail_text());
    assert_int_equal(l.dataset.view_count, VIEWS);
    for (int i = 0; i < VIEWS; i++) {
        char file[32];
        snprintf(file, sizeof file, "depth/view_%04d.exr", i);
        if (!image_loadf(support_path(folder.path, file), &l.depth[i])) fail_msg("%s", fail_text());
        assert_int_equal(l.depth[i].width, WIDTH);
        assert_int_equal(l.depth[i].channels, 1);
    }
    return l;
}

static void unload(Loaded *l) {
    for (int i = 0; i < VIEWS; i++) imagef_destroy(&l->depth[i]);
    dataset_destroy(&l->dataset);
}

static double depth_at(const Loaded *l, int view, double x, double y) {
    return l->depth[view].values[(int)y * WIDTH + (int)x];
}

// The depth nearest to the expected one in the 3 x 3 pixels round a place: at an outline, one pixel's centre may see past the edge.
static double nearest_depth(const Loaded *l, int view, double x, double y, double expected) {
    double best = 1e9;
    for (int j = -1; j <= 1; j++)
        for (int i = -1; i <= 1; i++) {
            double px = fmin(fmax(x + i, 0), WIDTH - 1), py = fmin(fmax(y + j, 0), HEIGHT - 1);
            double depth = depth_at(l, view, px, py);
            if (depth > 0 && fabs(depth - expected) < fabs(best - expected)) best = depth;
        }
    return best;
}

static Vec3 unprojected(const Camera *camera, int x, int y, double depth) {
    Vec3 p = vec3((x + 0.5 - camera->cx) / camera->fx * depth, (y + 0.5 - camera->cy) / camera->fy * depth, depth);
    Mat3 back = mat3_transpose(&camera->rotation);
    return mat3_apply(&back, vec3_sub(p, camera->translation));
}

static void the_scene_reads_as_a_dataset(void **state) {
    (void)state;
    for (int i = 0; i < 3; i++) {
        Loaded l = load(NAMES[i]);
        assert_string_equal(l.dataset.views[0].name, "view_0000.png");
        assert_int_equal(dataset_held_out_count(&l.dataset), 2);
        assert_true(l.dataset.points.count > 40);
        const char *json = support_path(support_path(support_scratch(), NAMES[i]), "transforms.json");
        assert_true(file_exists(json));
        Dataset other = {0}; // the same cameras, by the other format
        if (!transforms_open(support_path(support_scratch(), NAMES[i]), &other)) fail_msg("%s", fail_text());
        assert_int_equal(other.view_count, VIEWS);
        for (int v = 0; v < VIEWS; v++) {
            Vec3 a = camera_position(&l.dataset.views[v].camera), b = camera_position(&other.views[v].camera);
            support_near(vec3_length(vec3_sub(a, b)), 0, 1e-9, "camera position");
        }
        dataset_destroy(&other);
        unload(&l);
    }
}

static bool same_file(const char *a, const char *b, const char *name) {
    char first[65], second[65];
    if (!file_sha256(support_path(a, name), first) || !file_sha256(support_path(b, name), second))
        fail_msg("%s", fail_text());
    return strcmp(first, second) == 0;
}

static void the_same_command_gives_the_same_bytes_with_any_number_of_threads(void **state) {
    (void)state;
    SampleSceneOptions options = small_options();
    static const char *const files[] = {"images/view_0003.png",
                                        "depth/view_0003.exr",
                                        "sparse/0/cameras.bin",
                                        "sparse/0/images.bin",
                                        "sparse/0/points3D.bin",
                                        "transforms.json",
                                        "README.md"};
    setenv("SPLATLAB_THREADS", "2", 1);
    for (int i = 0; i < 3; i++) {
        char name[32];
        snprintf(name, sizeof name, "%s-again", NAMES[i]);
        const Folder first = folder_of(NAMES[i]), again = folder_of(name);
        assert_true(sample_scene_write(NAMES[i], &options, again.path));
        for (size_t k = 0; k < sizeof files / sizeof files[0]; k++)
            if (!same_file(first.path, again.path, files[k])) fail_msg("%s differs with 2 threads", files[k]);
    }
    options.seed++;
    const Folder first = folder_of("fence"), other = folder_of("other-seed");
    assert_true(sample_scene_write("fence", &options, other.path));
    assert_false(same_file(first.path, other.path, "images/view_0003.png"));
}

// A place seen in one view appears in the next at the depth that camera_project() says, wherever nothing is before it.
static void depth_agrees_between_views(void **state) {
    (void)state;
    for (int i = 0; i < 3; i++) {
        Loaded l = load(NAMES[i]);
        int agree = 0, behind = 0, before = 0;
        for (int v = 0; v < VIEWS; v++)
            for (int y = 0; y < HEIGHT; y++)
                for (int x = 0; x < WIDTH; x++) {
                    double z = depth_at(&l, v, x, y), px, py, expected;
                    int next = (v + 1) % VIEWS;
                    const Camera *here = &l.dataset.views[v].camera, *there = &l.dataset.views[next].camera;
                    if (z <= 0 || !camera_project(there, unprojected(here, x, y, z), &px, &py, &expected)) continue;
                    if (!(px >= 0 && py >= 0 && px < WIDTH && py < HEIGHT)) continue;
                    double found = nearest_depth(&l, next, px, py, expected);
                    if (found <= 0 || found > 1.03 * expected)
                        before++; // nothing there although something was seen
                    else if (found < 0.97 * expected)
                        behind++;
                    else
                        agree++;
                }
        // What is left are leaves and wires thinner than a pixel.
        if (agree < 1000 || before > 0.08 * (agree + before))
            fail_msg("%s: %d agree, %d hidden, %d contradict", NAMES[i], agree, behind, before);
        unload(&l);
    }
}

// Smallest relative difference of depth between a point and what the views see in its place.
static double nearest_surface(const Loaded *l, Vec3 point) {
    double best = 1e9;
    for (int v = 0; v < VIEWS; v++) {
        double x, y, z;
        if (!camera_project(&l->dataset.views[v].camera, point, &x, &y, &z)) continue;
        if (!(x >= 0 && y >= 0 && x < WIDTH && y < HEIGHT)) continue;
        double seen = depth_at(l, v, x, y);
        if (seen > 0) best = fmin(best, fabs(seen - z) / z);
    }
    return best;
}

static void points_lie_near_surfaces_but_for_a_few_outliers(void **state) {
    (void)state;
    int points = 0, off = 0;
    for (int i = 0; i < 3; i++) {
        Loaded l = load(NAMES[i]);
        points += l.dataset.points.count;
        for (int k = 0; k < l.dataset.points.count; k++) {
            const double *p = l.dataset.points.xyz + 3 * k;
            off += nearest_surface(&l, vec3(p[0], p[1], p[2])) > 0.15;
        }
        unload(&l);
    }
    double part = (double)off / points;
    if (part < 0.003 || part > 0.04) fail_msg("%d of %d points are off every surface", off, points);
    print_message("%d of %d points are off every surface\n", off, points);
}

static void points_are_noisy(void **state) {
    (void)state;
    Loaded l = load("courtyard");
    double sum = 0;
    int count = 0;
    for (int k = 0; k < l.dataset.points.count; k++) {
        const double *p = l.dataset.points.xyz + 3 * k;
        double off = nearest_surface(&l, vec3(p[0], p[1], p[2]));
        if (off < 0.05) sum += off, count++;
    }
    assert_true(sum / count > 1e-4);
    unload(&l);
}

static void colours_of_points_are_those_of_the_pictures(void **state) {
    (void)state;
    Loaded l = load("fence");
    assert_true(dataset_load_images(&l.dataset));
    double mean[2][3] = {{0}};
    for (int k = 0; k < l.dataset.points.count; k++)
        for (int c = 0; c < 3; c++) mean[0][c] += l.dataset.points.rgb[3 * k + c] / (double)l.dataset.points.count;
    for (int v = 0; v < VIEWS; v++)
        for (int i = 0; i < WIDTH * HEIGHT; i++)
            for (int c = 0; c < 3; c++)
                mean[1][c] += l.dataset.views[v].image.bytes[3 * i + c] / (double)(VIEWS * WIDTH * HEIGHT);
    for (int c = 0; c < 3; c++) support_near(mean[0][c], mean[1][c], 40, "mean colour");
    unload(&l);
}

static void bad_requests_are_refused_with_a_hint(void **state) {
    (void)state;
    SampleSceneOptions o = small_options();
    const Folder folder = folder_of("refused");
    assert_false(sample_scene_write("stadium", &o, folder.path));
    assert_non_null(strstr(fail_text(), "studio, fence, courtyard"));
    assert_int_equal(fail_exit_code(), 2);
    o.views = 2;
    assert_false(sample_scene_write("studio", &o, folder.path));
    assert_non_null(strstr(fail_text(), "2 views"));
    o = small_options();
    o.size[1] = 8;
    assert_false(sample_scene_write("studio", &o, folder.path));
    assert_non_null(strstr(fail_text(), "64x8"));
    assert_false(file_is_folder(folder.path));
}

static void a_folder_with_other_things_is_left_alone(void **state) {
    (void)state;
    SampleSceneOptions o = small_options();
    const Folder folder = folder_of("holiday");
    const char *photo = support_path(folder.path, "beach.jpg");
    assert_true(file_make_folder(folder.path) && file_write(photo, "x", 1));
    assert_false(sample_scene_write("studio", &o, folder.path));
    assert_non_null(strstr(fail_text(), "beach.jpg"));
    char **names;
    int count;
    assert_true(file_list(folder.path, &names, &count));
    assert_int_equal(count, 1);
    file_list_free(names, count);
}

static void an_older_scene_is_replaced_as_a_whole(void **state) {
    (void)state;
    SampleSceneOptions o = small_options();
    const Folder folder = folder_of("fence-again"); // twelve views stand there
    o.views = 4;
    assert_true(sample_scene_write("fence", &o, folder.path));
    assert_false(file_exists(support_path(folder.path, "images/view_0004.png")));
    assert_true(file_exists(support_path(folder.path, "images/view_0003.png")));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_scene_reads_as_a_dataset),
        cmocka_unit_test(the_same_command_gives_the_same_bytes_with_any_number_of_threads),
        cmocka_unit_test(depth_agrees_between_views),
        cmocka_unit_test(points_lie_near_surfaces_but_for_a_few_outliers),
        cmocka_unit_test(points_are_noisy),
        cmocka_unit_test(colours_of_points_are_those_of_the_pictures),
        cmocka_unit_test(bad_requests_are_refused_with_a_hint),
        cmocka_unit_test(a_folder_with_other_things_is_left_alone),
        cmocka_unit_test(an_older_scene_is_replaced_as_a_whole),
    };
    return cmocka_run_group_tests(tests, write_once, NULL);
}
