// in_view.h - which of sixteen splats the frame shows, for kernels that take sixteen at once (OpenCL C).
#ifndef SPLATLAB_KERNELS_IN_VIEW_H
#define SPLATLAB_KERNELS_IN_VIEW_H

#include "shared.h"

// -1 for splat first + lane where it touches a tile, 0 where it does not or where there is none (splats: N).
static int16 splats_in_view(int first, int splats, __global const TileBox *box) {
    int width[SPLAT_GROUP];
    for (int lane = 0; lane < SPLAT_GROUP; lane++)
        width[lane] = first + lane < splats ? box[first + lane].x1 - box[first + lane].x0 : 0;
    return vload16(0, width) > 0;
}

#endif
