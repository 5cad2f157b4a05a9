// The lists of every tile against each splat's alpha at each pixel, in double.

#include "splat3d/opencl_binning.h"

#include "lab/base/mem.h"
#include "splat3d/frame_record.h"
#include "tests/support/random_scene.h"
#include "tests/support/support.h"

#include <math.h>
#include <string.h>

// Everything that a binned frame holds, on the host.
typedef struct {
    FrameRecord frame;
    int visible;
    long slots, pairs;
    ScreenSplat *screen;
    TileBox *box;
    float *depth;
    uint32_t *offset, *order, *start, *list_splat, *list_slot;
    uint16_t *mask, *list_mask;
} Binned;

static int open_device(void **state) {
    Gpu *gpu;
    if (!gpu_open("", &gpu)) return -1;
    *state = gpu;
    return 0;
}

static int close_device(void **state) {
    gpu_close(*state);
    return 0;
}

static void *copy_of(GpuBuffer *buffer) {
    void *copy = mem_alloc(gpu_buffer_bytes(buffer), 1);
    assert_true(gpu_buffer_read(buffer, copy, gpu_buffer_bytes(buffer)));
    return copy;
}

static Binned bin(Gpu *gpu, const Gaussians *model, const Camera *camera) {
    const RenderSettings settings = render_settings_default();
    OpenclProject project;
    OpenclBinning binning;
    DeviceGaussians device;
    Binned b;
    assert_true(opencl_project_create(gpu, gpu_info(gpu)->is_cpu, &project));
    assert_true(opencl_binning_create(gpu, &binning));
    assert_true(device_gaussians_create(gpu, "model", 0, model->sh_degree, &device));
    assert_true(device_gaussians_write(&device, model));
    assert_true(frame_record_make(camera, &settings, model->count, model->sh_degree, &b.frame));
    assert_true(opencl_project_forward(&project, &b.frame, &device));
    assert_true(opencl_binning_sort(&binning, &b.frame, &project));
    assert_true(opencl_binning_lists(&binning, &b.frame, &project));
    b.visible = binning.visible, b.slots = binning.slots, b.pairs = binning.pairs;
    b.screen = copy_of(project.screen), b.box = copy_of(project.box), b.depth = copy_of(project.depth);
    b.offset = copy_of(binning.offset), b.order = copy_of(binning.order), b.start = copy_of(binning.start);
    b.list_splat = copy_of(binning.list_splat), b.list_slot = copy_of(binning.list_slot);
    b.mask = copy_of(binning.mask), b.list_mask = copy_of(binning.list_mask);
    device_gaussians_destroy(&device);
    opencl_binning_destroy(&binning);
    opencl_project_destroy(&project);
    return b;
}

static void binned_destroy(Binned *b) {
    void *const all[] = {b->screen, b->box,        b->depth,     b->offset, b->order,
                         b->start,  b->list_splat, b->list_slot, b->mask,   b->list_mask};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) mem_free(all[k]);
}

// ln(alpha / ALPHA_MIN) of a splat at the nearest point of [x0, x1] x [y0, y1] that the search finds; the corners and
// a fine grid are enough, since the ellipse is convex and the rectangle small.
static double best_in_rectangle(const ScreenSplat *s, double x0, double y0, double x1, double y1) {
    enum { STEPS = 12 };
    double best = -INFINITY;
    for (int i = 0; i <= STEPS; i++)
        for (int j = 0; j <= STEPS; j++) {
            const double dx = x0 + (x1 - x0) * i / STEPS - s->x, dy = y0 + (y1 - y0) * j / STEPS - s->y;
            const double u = dx + s->shear * dy;
            const double log2_alpha = s->along_u * u * u + s->along_v * dy * dy + s->log2_opacity;
            best = fmax(best, log2_alpha + log2(255));
        }
    return best * M_LN2;
}

// The mask that tile (tx, ty) has for the splat, 0 outside of its box.
static int mask_of(const Binned *b, int i, int tx, int ty) {
    const TileBox box = b->box[i];
    if (tx < box.x0 || tx >= box.x1 || ty < box.y0 || ty >= box.y1) return 0;
    return b->mask[b->offset[i] + (uint32_t)((ty - box.y0) * (box.x1 - box.x0) + tx - box.x0)];
}

static void check_masks(const Binned *b, int splat_count) {
    long set = 0, too_many = 0;
    for (int i = 0; i < splat_count; i++) {
        if (b->box[i].x0 >= b->box[i].x1) continue;
        for (int by = 0; by < b->frame.height; by += BLOCK_SIZE)
            for (int bx = 0; bx < b->frame.width; bx += BLOCK_SIZE) {
                const int bit = by % TILE_SIZE / BLOCK_SIZE * 4 + bx % TILE_SIZE / BLOCK_SIZE;
                const bool is_set = mask_of(b, i, bx / TILE_SIZE, by / TILE_SIZE) >> bit & 1;
                // Only pixels of the picture count: a box may leave out tiles that are touched in the padding alone.
                const double x1 = fmin(bx + 3.5, b->frame.width - 0.5), y1 = fmin(by + 3.5, b->frame.height - 0.5);
                const double inside = best_in_rectangle(&b->screen[i], bx + 0.5, by + 0.5, x1, y1);
                if (inside > 1e-4 && !is_set)
                    fail_msg("splat %d, block at (%d, %d): not set, but ln(alpha / min) is %g", i, bx, by, inside);
                set += is_set;
                too_many += is_set && best_in_rectangle(&b->screen[i], bx + 0.4, by + 0.4, bx + 3.6, by + 3.6) < -0.1;
            }
    }
    if (set == 0 || too_many * 500 > set) fail_msg("%ld of %ld blocks are set without need", too_many, set);
}

static void check_lists(const Binned *b) {
    const int tiles = b->frame.tiles_x * b->frame.tiles_y;
    assert_int_equal(b->start[0], 0);
    assert_int_equal(b->start[tiles], b->pairs);
    long nonzero = 0;
    for (long slot = 0; slot < b->slots; slot++) nonzero += b->mask[slot] != 0;
    assert_int_equal(nonzero, b->pairs);
    for (int tile = 0; tile < tiles; tile++)
        for (uint32_t k = b->start[tile]; k < b->start[tile + 1]; k++) {
            const uint32_t i = b->list_splat[k];
            const TileBox box = b->box[i];
            const int tx = tile % b->frame.tiles_x, ty = tile / b->frame.tiles_x;
            assert_int_equal(b->list_slot[k],
                             b->offset[i] + (uint32_t)((ty - box.y0) * (box.x1 - box.x0) + tx - box.x0));
            assert_int_equal(b->list_mask[k], b->mask[b->list_slot[k]]);
            assert_int_not_equal(b->list_mask[k], 0);
            if (k == b->start[tile]) continue;
            const uint32_t before = b->list_splat[k - 1];
            assert_true(b->depth[before] < b->depth[i] || (b->depth[before] == b->depth[i] && before < i));
        }
}

static void lists_hold_what_the_ellipses_reach_nearest_first(void **state) {
    for (uint32_t seed = 1; seed <= 4; seed++) {
        print_message("seed %u\n", seed);
        RandomScene scene = random_scene_default(seed);
        scene.size_px = seed == 4 ? 40 : 3 * seed;
        scene.spread = 1;
        const Camera camera = random_scene_camera(seed, 64 + 13 * (int)seed, 50 + 7 * (int)seed);
        Gaussians model = random_scene_gaussians(&scene, &camera);
        for (int i = 0; i < model.count; i += 3) // equal depths, so that stability shows
            memcpy(gaussians_at(&model, FIELD_MEAN, i), gaussians_at(&model, FIELD_MEAN, i / 2), 3 * sizeof(float));
        Binned b = bin(*state, &model, &camera);
        assert_true(b.visible > 100 && b.visible < model.count);
        check_masks(&b, model.count);
        check_lists(&b);
        binned_destroy(&b);
        gaussians_destroy(&model);
    }
}

static void needles_across_the_picture_touch_only_the_tiles_on_their_way(void **state) {
    RandomScene scene = random_scene_default(9);
    scene.count = 40;
    scene.outside = 1;
    const Camera camera = random_scene_camera(9, 160, 120);
    Gaussians model = random_scene_gaussians(&scene, &camera);
    for (int i = 0; i < model.count; i++) {
        float *log_scale = gaussians_at(&model, FIELD_LOG_SCALE, i);
        log_scale[0] = 0.5f, log_scale[1] = log_scale[2] = -9;
    }
    Binned b = bin(*state, &model, &camera);
    check_masks(&b, model.count);
    check_lists(&b);
    assert_true(b.pairs * 2 < b.slots); // the box of a slanted needle is mostly empty
    binned_destroy(&b);
    gaussians_destroy(&model);
}

static void no_splats_give_empty_lists(void **state) {
    Gaussians model = gaussians_create(0, 0);
    const Camera camera = random_scene_camera(9, 40, 20);
    Binned b = bin(*state, &model, &camera);
    assert_int_equal(b.visible, 0);
    assert_int_equal(b.pairs, 0);
    for (int tile = 0; tile <= b.frame.tiles_x * b.frame.tiles_y; tile++) assert_int_equal(b.start[tile], 0);
    binned_destroy(&b);
    gaussians_destroy(&model);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lists_hold_what_the_ellipses_reach_nearest_first),
        cmocka_unit_test(needles_across_the_picture_touch_only_the_tiles_on_their_way),
        cmocka_unit_test(no_splats_give_empty_lists),
    };
    return cmocka_run_group_tests(tests, open_device, close_device);
}
