// native_lanes_avx2.h - sixteen floats in two AVX2 registers, under the names that native_ellipse.h and native_tile_*.h use.
#ifndef SPLATLAB_LAB_APP_NATIVE_LANES_AVX2_H
#define SPLATLAB_LAB_APP_NATIVE_LANES_AVX2_H

#if defined(__x86_64__)
#pragma GCC target("avx2,fma,lzcnt,bmi")

#include <immintrin.h>
#include <stdbool.h>
#include <stdint.h>

typedef struct {
    __m256 low, high;
} Lanes;
typedef Lanes LaneMask; // all bits of a lane, or none
typedef struct {
    __m256i low, high;
} LaneBits; // 32 bits a lane

#define LANES_BOTH(FUNCTION, ...)  ((Lanes){FUNCTION(low, __VA_ARGS__), FUNCTION(high, __VA_ARGS__)})
#define LANES_ADD(half, a, b)      _mm256_add_ps((a).half, (b).half)
#define LANES_SUB(half, a, b)      _mm256_sub_ps((a).half, (b).half)
#define LANES_MUL(half, a, b)      _mm256_mul_ps((a).half, (b).half)
#define LANES_DIV(half, a, b)      _mm256_div_ps((a).half, (b).half)
#define LANES_MIN(half, a, b)      _mm256_min_ps((a).half, (b).half)
#define LANES_AND(half, a, b)      _mm256_and_ps((a).half, (b).half)
#define LANES_GE(half, a, b)       _mm256_cmp_ps((a).half, (b).half, _CMP_GE_OQ)
#define LANES_FMA(half, a, b, c)   _mm256_fmadd_ps((a).half, (b).half, (c).half)
#define LANES_FMS(half, a, b, c)   _mm256_fmsub_ps((a).half, (b).half, (c).half)
#define LANES_FNMA(half, a, b, c)  _mm256_fnmadd_ps((a).half, (b).half, (c).half)
#define LANES_BLEND(half, m, a, b) _mm256_blendv_ps((b).half, (a).half, (m).half)

static inline Lanes lanes_all(float x) { return (Lanes){_mm256_set1_ps(x), _mm256_set1_ps(x)}; }
static inline Lanes lanes_load(const float *p) { return (Lanes){_mm256_loadu_ps(p), _mm256_loadu_ps(p + 8)}; }
static inline void lanes_store(float *p, Lanes v) {
    _mm256_storeu_ps(p, v.low);
    _mm256_storeu_ps(p + 8, v.high);
}
static inline Lanes lanes_add(Lanes a, Lanes b) { return LANES_BOTH(LANES_ADD, a, b); }
static inline Lanes lanes_sub(Lanes a, Lanes b) { return LANES_BOTH(LANES_SUB, a, b); }
static inline Lanes lanes_mul(Lanes a, Lanes b) { return LANES_BOTH(LANES_MUL, a, b); }
static inline Lanes lanes_div(Lanes a, Lanes b) { return LANES_BOTH(LANES_DIV, a, b); }
static inline Lanes lanes_fma(Lanes a, Lanes b, Lanes c) { return LANES_BOTH(LANES_FMA, a, b, c); }
static inline Lanes lanes_fms(Lanes a, Lanes b, Lanes c) { return LANES_BOTH(LANES_FMS, a, b, c); }   // a b - c
static inline Lanes lanes_fnma(Lanes a, Lanes b, Lanes c) { return LANES_BOTH(LANES_FNMA, a, b, c); } // c - a b
static inline Lanes lanes_min(Lanes a, Lanes b) { return LANES_BOTH(LANES_MIN, a, b); }
static inline float lanes_sum(Lanes v) {
    const __m256 a = _mm256_add_ps(v.low, v.high);
    const __m128 b = _mm_add_ps(_mm256_castps256_ps128(a), _mm256_extractf128_ps(a, 1));
    const __m128 c = _mm_add_ps(b, _mm_movehl_ps(b, b));
    return _mm_cvtss_f32(_mm_add_ss(c, _mm_movehdup_ps(c)));
}
// out[0..7]: the sums of eight vectors.
static inline void lanes_sum8(float *out, Lanes a, Lanes b, Lanes c, Lanes d, Lanes e, Lanes f, Lanes g, Lanes h) {
    const Lanes all[8] = {a, b, c, d, e, f, g, h};
    __m256 half[8];
    for (int k = 0; k < 8; k++) half[k] = _mm256_add_ps(all[k].low, all[k].high);
    const __m256 ab_cd = _mm256_hadd_ps(_mm256_hadd_ps(half[0], half[1]), _mm256_hadd_ps(half[2], half[3]));
    const __m256 ef_gh = _mm256_hadd_ps(_mm256_hadd_ps(half[4], half[5]), _mm256_hadd_ps(half[6], half[7]));
    _mm256_storeu_ps(
        out, _mm256_add_ps(_mm256_permute2f128_ps(ab_cd, ef_gh, 0x20), _mm256_permute2f128_ps(ab_cd, ef_gh, 0x31)));
}
static inline float lanes_max(Lanes v) {
    const __m256 a = _mm256_max_ps(v.low, v.high);
    const __m128 b = _mm_max_ps(_mm256_castps256_ps128(a), _mm256_extractf128_ps(a, 1));
    const __m128 c = _mm_max_ps(b, _mm_movehl_ps(b, b));
    return _mm_cvtss_f32(_mm_max_ss(c, _mm_movehdup_ps(c)));
}
static inline void lanes_store_int(int32_t *p, Lanes v) {
    _mm256_storeu_si256((__m256i *)p, _mm256_cvtps_epi32(v.low));
    _mm256_storeu_si256((__m256i *)(p + 8), _mm256_cvtps_epi32(v.high));
}
static inline Lanes lanes_load_int(const int32_t *p) {
    return (Lanes){_mm256_cvtepi32_ps(_mm256_loadu_si256((const __m256i *)p)),
                   _mm256_cvtepi32_ps(_mm256_loadu_si256((const __m256i *)(p + 8)))};
}

static inline LaneMask lanes_ge(Lanes a, Lanes b) { return LANES_BOTH(LANES_GE, a, b); }
static inline LaneMask lane_mask_and(LaneMask a, LaneMask b) { return LANES_BOTH(LANES_AND, a, b); }
static inline bool lane_mask_any(LaneMask m) { return _mm256_movemask_ps(_mm256_or_ps(m.low, m.high)) != 0; }
// a where the mask is set, else b; or else 0
static inline Lanes lanes_choose(LaneMask m, Lanes a, Lanes b) { return LANES_BOTH(LANES_BLEND, m, a, b); }
static inline Lanes lanes_keep(LaneMask m, Lanes a) { return LANES_BOTH(LANES_AND, m, a); }

#define LANES_FRACTION(half, x) _mm256_sub_ps((x).half, _mm256_floor_ps((x).half))
static inline Lanes lanes_fraction(Lanes x) { return LANES_BOTH(LANES_FRACTION, x); } // x - floor(x)
// 2^floor(x) times p where the mask is set, else 0.
#define LANES_SCALE(half, p, x)                                                                                        \
    _mm256_castsi256_ps(_mm256_add_epi32(_mm256_castps_si256((p).half),                                                \
                                         _mm256_slli_epi32(_mm256_cvtps_epi32(_mm256_floor_ps((x).half)), 23)))
static inline Lanes lanes_scale(LaneMask m, Lanes p, Lanes x) { return lanes_keep(m, LANES_BOTH(LANES_SCALE, p, x)); }

static inline LaneBits lane_bits_none(void) { return (LaneBits){_mm256_setzero_si256(), _mm256_setzero_si256()}; }
// Shifts every lane left by one and puts bit k of `mask` into lane k.
static inline LaneBits lane_bits_push(LaneBits bits, uint16_t mask) {
    const __m256i all = _mm256_set1_epi32(mask), one = _mm256_set1_epi32(1);
    const __m256i lane = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
    const __m256i low = _mm256_and_si256(_mm256_srlv_epi32(all, lane), one);
    const __m256i high = _mm256_and_si256(_mm256_srlv_epi32(_mm256_srli_epi32(all, 8), lane), one);
    return (LaneBits){_mm256_or_si256(_mm256_slli_epi32(bits.low, 1), low),
                      _mm256_or_si256(_mm256_slli_epi32(bits.high, 1), high)};
}
static inline void lane_bits_store(uint32_t *p, LaneBits bits) {
    _mm256_storeu_si256((__m256i *)p, bits.low);
    _mm256_storeu_si256((__m256i *)(p + 8), bits.high);
}

#endif
#endif
