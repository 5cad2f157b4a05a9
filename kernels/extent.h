// extent.h - how much wider a splat is taken to be when its tiles and blocks are chosen, px.
//
// Rounding must never lose a pixel that the blend would keep; a block too many only costs time. Coordinates of a splat that
// is large or far outside round in proportion to their size.
#ifndef SPLATLAB_KERNELS_EXTENT_H
#define SPLATLAB_KERNELS_EXTENT_H

// A macro: for one splat or, as vectors, for several.
#define EXTENT_MARGIN_PX(centre, half_extent) (0.01f + 1e-6f * (fabs(centre) + (half_extent)))

#endif
