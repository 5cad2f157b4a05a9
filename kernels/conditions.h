// conditions.h - any() and all() of sixteen lanes, which PoCL makes chains of branches (OpenCL C).
#ifndef SPLATLAB_KERNELS_CONDITIONS_H
#define SPLATLAB_KERNELS_CONDITIONS_H

static inline bool any_of(int16 condition) {
    const int8 a = condition.lo | condition.hi;
    const int4 b = a.lo | a.hi;
    const int2 c = b.lo | b.hi;
    return (c.x | c.y) < 0;
}

static inline bool all_of(int16 condition) { return !any_of(~condition); }

#endif
