// bench_stages.h - the stages of a training step, each to be run alone and waited for, as often as one likes.
//
// Every stage leaves what the next one reads, and running it again gives the same: Adam's learning rates are 0.
#ifndef SPLATLAB_LAB_APP_BENCH_STAGES_H
#define SPLATLAB_LAB_APP_BENCH_STAGES_H

#include "lab/app/native_blend.h"
#include "lab/base/image.h"
#include "splat3d/opencl_rasterizer.h"

typedef enum {
    BENCH_PROJECT,
    BENCH_SORT,
    BENCH_BIN,
    BENCH_BLEND_FORWARD,
    BENCH_LOSS,
    BENCH_BLEND_BACKWARD,
    BENCH_PROJECT_BACKWARD,
    BENCH_ADAM,
    BENCH_UPDATE, // project_backward and adam at once, as a step has them on a CPU
    BENCH_FRAME,  // one picture: project to blend forward
    BENCH_STEP,   // one step of training, as the trainer does it
    BENCH_STAGE_COUNT
} BenchStage;

extern const char *const BENCH_STAGE_NAMES[BENCH_STAGE_COUNT + 1]; // "project", ...; NULL at the end

typedef struct BenchStages BenchStages;

// model and photo are copied to the device; the photo has the camera's size.
bool bench_stages_create(Gpu *gpu, BlendKernels blend, const Gaussians *model, const Camera *camera,
                         const Image8 *photo, BenchStages **stages);
void bench_stages_destroy(BenchStages *stages); // accepts NULL

// Runs one stage and waits for it. The stages from BENCH_PROJECT to BENCH_ADAM must have been run once in their order.
bool bench_stages_run(BenchStages *stages, BenchStage stage);

// Bytes that the stage has to read and write at least, where memory is what it waits for; 0 for the others.
size_t bench_stages_bytes(const BenchStages *stages, BenchStage stage);

// How much there is to do.
typedef struct {
    int visible;       // splats in view
    long pairs;        // (tile, splat) pairs that are listed
    long pairs_box;    // tiles of the boxes round the ellipses alpha = 1/255
    long pairs_square; // tiles of the squares of three standard deviations, that Kerbl et al. 2023 list
    double evaluated;  // (pixel, splat) pairs: list entries that a pixel passes until it is opaque
} BenchWork;
bool bench_stages_work(BenchStages *stages, BenchWork *work);

// The arrays of the last frame, mapped for the native blend; the device does nothing until they are given back.
bool bench_stages_map(BenchStages *stages, NativeBlend *blend);
bool bench_stages_unmap(BenchStages *stages);

#endif
