// pocl.h - POCL_ON_CPU is defined where the compiler is PoCL's, which is clang, for a CPU: its built-ins may be used (OpenCL C).
#ifndef SPLATLAB_KERNELS_POCL_H
#define SPLATLAB_KERNELS_POCL_H

#if defined(POCL_DEVICE_ADDRESS_BITS) && !defined(__NVPTX__)
#define POCL_ON_CPU
#endif

#endif
