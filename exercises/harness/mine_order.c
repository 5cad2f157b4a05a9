// mine_order.c - one request, and a look whether each splat comes once.
#include "exercises/harness/mine_order.h"

#include "lab/base/mem.h"

#include <string.h>

static bool is_order(const double *idx, int n) {
    bool *seen = mem_alloc((size_t)n, sizeof *seen), good = true;
    for (int i = 0; good && i < n; i++) {
        good = idx[i] >= 0 && idx[i] < n && !seen[(int)idx[i]];
        if (good) seen[(int)idx[i]] = true;
    }
    mem_free(seen);
    return good;
}

bool mine_order(Mine *mine, const double cam[MINE_CAM_NUMBERS], const double *mu, int n, int *order) {
    double *idx = mem_alloc((size_t)n + 1, sizeof *idx), *returned = idx + n, count = n;
    const Arg args[] = {ARG_IN("c", cam, MINE_CAM_NUMBERS), ARG_IN("mu", mu, 3 * n), ARG_IN("n", &count, 1),
                        ARG_OUT("idx", idx, n), ARG_OUT("returned", returned, 1)};
    bool good = n > 0 && mine_call(mine, MINE_POPPING, "order_by_depth", args, sizeof args / sizeof *args, 1) &&
                *returned == n && is_order(idx, n);
    for (int i = 0; good && i < n; i++) order[i] = (int)idx[i];
    mem_free(idx);
    return good;
}
