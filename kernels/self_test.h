// self_test.h - sizes that self_test.cl and lab/gpu/self_test.c share.
#ifndef SPLATLAB_KERNELS_SELF_TEST_H
#define SPLATLAB_KERNELS_SELF_TEST_H

#define SELF_TEST_ITEMS   64
#define SELF_TEST_ANSWERS 5 // words per work-item

#endif
