// bench_ceiling.h - what this machine could do at best at a stage's work: native vector code for the blends, memcpy for what waits
// for memory.
#ifndef SPLATLAB_LAB_APP_BENCH_CEILING_H
#define SPLATLAB_LAB_APP_BENCH_CEILING_H

#include "lab/app/bench_stages.h"

typedef struct BenchCeiling BenchCeiling;

BenchCeiling *bench_ceiling_create(const Gpu *gpu, BenchStages *stages);
void bench_ceiling_destroy(BenchCeiling *ceiling); // accepts NULL

// Is there a ceiling for this stage? The blends have one on CPU devices with AVX2 or AVX-512.
bool bench_ceiling_exists(const BenchCeiling *ceiling, BenchStage stage);

// Does the stage's work, or copies as many bytes as the stage has to move, and gives the time. The stages have been run.
bool bench_ceiling_run(BenchCeiling *ceiling, BenchStage stage, double *ms);

// Do native blend and kernels agree? Both have been run on the same frame. Fails with the difference.
bool bench_ceiling_check(BenchCeiling *ceiling);

#endif
