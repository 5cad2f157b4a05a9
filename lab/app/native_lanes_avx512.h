// native_lanes_avx512.h - sixteen floats in one AVX-512 register, under the names that native_ellipse.h and native_tile_*.h use.
#ifndef SPLATLAB_LAB_APP_NATIVE_LANES_AVX512_H
#define SPLATLAB_LAB_APP_NATIVE_LANES_AVX512_H

#if defined(__x86_64__)
#pragma GCC target("avx512f,avx512dq,fma,lzcnt,bmi")

#include <immintrin.h>
#include <stdbool.h>
#include <stdint.h>

typedef __m512 Lanes;
typedef __mmask16 LaneMask;
typedef __m512i LaneBits; // 32 bits a lane

static inline Lanes lanes_all(float x) { return _mm512_set1_ps(x); }
static inline Lanes lanes_load(const float *p) { return _mm512_loadu_ps(p); }
static inline void lanes_store(float *p, Lanes v) { _mm512_storeu_ps(p, v); }
static inline Lanes lanes_add(Lanes a, Lanes b) { return _mm512_add_ps(a, b); }
static inline Lanes lanes_sub(Lanes a, Lanes b) { return _mm512_sub_ps(a, b); }
static inline Lanes lanes_mul(Lanes a, Lanes b) { return _mm512_mul_ps(a, b); }
static inline Lanes lanes_div(Lanes a, Lanes b) { return _mm512_div_ps(a, b); }
static inline Lanes lanes_fma(Lanes a, Lanes b, Lanes c) { return _mm512_fmadd_ps(a, b, c); }
static inline Lanes lanes_fms(Lanes a, Lanes b, Lanes c) { return _mm512_fmsub_ps(a, b, c); }   // a b - c
static inline Lanes lanes_fnma(Lanes a, Lanes b, Lanes c) { return _mm512_fnmadd_ps(a, b, c); } // c - a b
static inline Lanes lanes_min(Lanes a, Lanes b) { return _mm512_min_ps(a, b); }
static inline float lanes_sum(Lanes v) { return _mm512_reduce_add_ps(v); }
// out[0..7]: the sums of eight vectors, added up together, halving their lanes each time.
static inline void lanes_sum8(float *out, Lanes a, Lanes b, Lanes c, Lanes d, Lanes e, Lanes f, Lanes g, Lanes h) {
    const Lanes ab = _mm512_add_ps(_mm512_shuffle_f32x4(a, b, 0x44), _mm512_shuffle_f32x4(a, b, 0xee));
    const Lanes cd = _mm512_add_ps(_mm512_shuffle_f32x4(c, d, 0x44), _mm512_shuffle_f32x4(c, d, 0xee));
    const Lanes ef = _mm512_add_ps(_mm512_shuffle_f32x4(e, f, 0x44), _mm512_shuffle_f32x4(e, f, 0xee));
    const Lanes gh = _mm512_add_ps(_mm512_shuffle_f32x4(g, h, 0x44), _mm512_shuffle_f32x4(g, h, 0xee));
    const Lanes abcd = _mm512_add_ps(_mm512_shuffle_f32x4(ab, cd, 0x88), _mm512_shuffle_f32x4(ab, cd, 0xdd));
    const Lanes efgh = _mm512_add_ps(_mm512_shuffle_f32x4(ef, gh, 0x88), _mm512_shuffle_f32x4(ef, gh, 0xdd));
    const Lanes two = _mm512_add_ps(_mm512_shuffle_ps(abcd, efgh, 0x44), _mm512_shuffle_ps(abcd, efgh, 0xee));
    const Lanes one = _mm512_add_ps(_mm512_shuffle_ps(two, two, 0x88), _mm512_shuffle_ps(two, two, 0xdd));
    const __m512i places = _mm512_setr_epi32(0, 4, 8, 12, 1, 5, 9, 13, 0, 0, 0, 0, 0, 0, 0, 0);
    _mm256_storeu_ps(out, _mm512_castps512_ps256(_mm512_permutexvar_ps(places, one)));
}
static inline float lanes_max(Lanes v) { return _mm512_reduce_max_ps(v); }
static inline void lanes_store_int(int32_t *p, Lanes v) { _mm512_storeu_si512(p, _mm512_cvtps_epi32(v)); }
static inline Lanes lanes_load_int(const int32_t *p) { return _mm512_cvtepi32_ps(_mm512_loadu_si512(p)); }

static inline LaneMask lanes_ge(Lanes a, Lanes b) { return _mm512_cmp_ps_mask(a, b, _CMP_GE_OQ); }
static inline LaneMask lane_mask_and(LaneMask a, LaneMask b) { return (LaneMask)(a & b); }
static inline bool lane_mask_any(LaneMask m) { return m != 0; }
// a where the mask is set, else b; or else 0
static inline Lanes lanes_choose(LaneMask m, Lanes a, Lanes b) { return _mm512_mask_mov_ps(b, m, a); }
static inline Lanes lanes_keep(LaneMask m, Lanes a) { return _mm512_maskz_mov_ps(m, a); }

static inline Lanes lanes_fraction(Lanes x) { return _mm512_reduce_ps(x, 1); } // x - floor(x)
// 2^floor(x) times p where the mask is set, else 0.
static inline Lanes lanes_scale(LaneMask m, Lanes p, Lanes x) { return _mm512_maskz_scalef_ps(m, p, x); }

static inline LaneBits lane_bits_none(void) { return _mm512_setzero_si512(); }
// Shifts every lane left by one and puts bit k of `mask` into lane k.
static inline LaneBits lane_bits_push(LaneBits bits, uint16_t mask) {
    const LaneBits shifted = _mm512_slli_epi32(bits, 1);
    return _mm512_mask_or_epi32(shifted, mask, shifted, _mm512_set1_epi32(1));
}
static inline void lane_bits_store(uint32_t *p, LaneBits bits) { _mm512_storeu_si512(p, bits); }

#endif
#endif
