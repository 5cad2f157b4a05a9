// morton_order.h - splats that are near each other in space, near each other in memory.
//
// Splats of one tile are then read from a few places, and groups of sixteen are in view or out of it together. The order
// is that of the Morton code: the bits of x, y and z in turn, which walks through space from cell to cell, cells of all sizes
// (Morton 1966):
//
//      y  2 - 3   6 - 7
//           /   /   /
//         0 - 1   4 - 5        x
#ifndef SPLATLAB_SPLAT3D_MORTON_ORDER_H
#define SPLATLAB_SPLAT3D_MORTON_ORDER_H

#include "splat3d/gaussians.h"

// order (count): order[rank] is the index of the point that comes there; points of one cell (2^-21 of the largest extent) keep their order. xyz (count, 3):
// finite, any units. count >= 0.
void morton_order(int count, const float *xyz, uint32_t *order);

// Puts the splats in the order of their means.
void morton_arrange(Gaussians *g);

#endif
