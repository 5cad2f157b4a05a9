// record_sizes.cl - how large the device's compiler makes the records that host and device share, for a test that compares them with
// the host's.
//
// One work-item writes everything: sizes (6): bytes of FrameRecord, ScreenSplat, TileBox, PairGradient, FrameRecord's last member,
// and bytes of AdamStepRecord. Local memory: none. Test: tests/splat3d/test_frame_record.c.
#include "shared.h"

#include "adam_record.h"

__kernel void record_sizes(const FrameRecord frame, __global int *sizes) {
    if (get_global_id(0) != 0) return;
    sizes[0] = (int)sizeof(FrameRecord);
    sizes[1] = (int)sizeof(ScreenSplat);
    sizes[2] = (int)sizeof(TileBox);
    sizes[3] = (int)sizeof(PairGradient);
    sizes[4] = frame.is_depth;
    sizes[5] = (int)sizeof(AdamStepRecord);
}
