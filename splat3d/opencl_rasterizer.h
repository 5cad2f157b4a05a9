// opencl_rasterizer.h - the rasterizer on an OpenCL device: project, sort, bin, blend, and all the way back.
//
// A frame is begun by opencl_render(), which leaves the picture on the device; opencl_backward() turns the gradient that a loss left
// there into gradients of every parameter. Nothing is allocated in a warm step, nothing is copied on a CPU device,
// and the result is the same, bit by bit, however many threads the device has.
#ifndef SPLATLAB_SPLAT3D_OPENCL_RASTERIZER_H
#define SPLATLAB_SPLAT3D_OPENCL_RASTERIZER_H

#include "lab/gpu/gpu.h"
#include "splat3d/opencl_project.h"
#include "splat3d/rasterizer.h"

// The shape of the kernels that have two: blend, projection, loss. AUTO: by the device's type.
typedef enum { BLEND_AUTO, BLEND_CPU, BLEND_GPU } BlendKernels;

typedef struct OpenclRasterizer OpenclRasterizer;

bool opencl_rasterizer_create(Gpu *gpu, BlendKernels blend, OpenclRasterizer **rasterizer);
void opencl_rasterizer_destroy(OpenclRasterizer *rasterizer);          // accepts NULL
Rasterizer *opencl_rasterizer_interface(OpenclRasterizer *rasterizer); // the table; destroying either destroys both

// Forward: leaves the picture on the device. Waits twice on its way, for the depth sort and for the lengths of the tile lists, which the host
// computes; the blend itself is only enqueued. Fails on settings that the kernels do not know (STOP_BEFORE_BLEND, alpha_max >= 1).
bool opencl_render(OpenclRasterizer *r, const DeviceGaussians *model, const Camera *camera,
                   const RenderSettings *settings);

// The picture of the last opencl_render(), and the gradient by it, to be filled before opencl_backward(): three planes r g b, each rows of
// `stride` floats; width and height padded to multiples of TILE_SIZE. Padding pixels of the gradient must be zero.
typedef struct {
    int width, height; // px, of the camera
    int stride, rows;  // padded to multiples of TILE_SIZE
    GpuBuffer *rgb;    // (3, rows, stride)
    GpuBuffer *d_rgb;  // (3, rows, stride)
} DevicePicture;
DevicePicture opencl_picture(OpenclRasterizer *r);
bool opencl_read_picture(OpenclRasterizer *r, Picture *picture); // to the host

// Backward of the last opencl_render() of this model, unchanged since: *gradient gets every number written (zero for splats that were not
// seen), except that fields above the rendered SH degree are left as they are. statistics may be NULL.
bool opencl_backward(OpenclRasterizer *r, const DeviceGaussians *model, DeviceGaussians *gradient,
                     const DensityStatistics *statistics);

// Backward and a step of Adam: what opencl_backward() and opencl_adam_step() do one after the other, bit by bit the same, but on a
// CPU device in one kernel. model is that of the last opencl_render().
bool opencl_backward_step(OpenclRasterizer *r, OpenclAdam *adam, int step, const float learning_rate[FIELD_COUNT],
                          DeviceGaussians *model, DeviceGaussians *m, DeviceGaussians *v,
                          const DensityStatistics *statistics);

// (N) TileBox of the last opencl_render(): which splats are in view. Borrowed; the next one writes over it.
GpuBuffer *opencl_boxes(const OpenclRasterizer *r);

// Counts of the last opencl_render(): splats in view, (tile, splat) pairs.
typedef struct {
    int visible;
    long pairs;
} FrameCounts;
FrameCounts opencl_frame_counts(const OpenclRasterizer *r);

#endif
