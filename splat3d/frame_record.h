// frame_record.h - camera and settings as the kernels take them (FrameRecord in kernels/shared.h).
#ifndef SPLATLAB_SPLAT3D_FRAME_RECORD_H
#define SPLATLAB_SPLAT3D_FRAME_RECORD_H

#include "kernels/shared.h"
#include "splat3d/rasterizer.h"

// For a model of that many splats and that SH degree. Fails on what the kernels cannot do, naming the value.
bool frame_record_make(const Camera *camera, const RenderSettings *settings, int splat_count, int model_sh_degree,
                       FrameRecord *frame);

#endif
