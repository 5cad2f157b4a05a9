// prefetch.h - asks for a line of memory that will be needed soon, where the hardware does not foresee it.
//
// Only a hint: results are the same without. OpenCL's prefetch() does nothing on PoCL, whose compiler is clang; elsewhere it
// knows numbers but no records, so the pointer goes in as one of words.
#ifndef SPLATLAB_KERNELS_PREFETCH_H
#define SPLATLAB_KERNELS_PREFETCH_H

#include "pocl.h"

#ifdef POCL_ON_CPU
#define PREFETCH(pointer) __builtin_prefetch(pointer)
#else
#define PREFETCH(pointer) prefetch((__global const int *)(pointer), 1)
#endif

#endif
