// mine_order.h - the order of splats by E05's order_by_depth().
#ifndef SPLATLAB_EXERCISES_HARNESS_MINE_ORDER_H
#define SPLATLAB_EXERCISES_HARNESS_MINE_ORDER_H

#include "exercises/harness/mine.h"

enum { MINE_CAM_NUMBERS = 18 }; // of a Cam, as exercise.h has it

// order[0..n-1]: the splats from front to back. cam: 18 numbers; mu: (n, 3), means in the world, all in front of the camera. False (and
// order as it was) when E05 does not pass, or gave what is no order of all n: the reference has to do it.
bool mine_order(Mine *mine, const double cam[MINE_CAM_NUMBERS], const double *mu, int n, int *order);

#endif
