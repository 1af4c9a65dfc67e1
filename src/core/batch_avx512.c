/* SPDX-License-Identifier: MIT */
/* The kernels for AVX-512. */
#include "core/batch_plan.h"

#if defined(__x86_64__) && defined(__GNUC__)
#include <immintrin.h>
#include <math.h>

#define TARGET           __attribute__((target("avx512f,avx512bw,avx512dq,avx512vl,avx2,fma,f16c")))
#define FUSED            1
#define TABLE            dp_batch_avx512
#define HALF_BY_HARDWARE 1

TARGET static inline __mmask16 tail_mask(size_t left) {
    return (__mmask16)(left < 16 ? (1U << left) - 1U : 0xFFFFU);
}

/* The second argument to max and min is taken for NaN. */
TARGET static int32_t kernel_HALF_OF_FLOAT(const dp_batch *batch, const void *in, void *out, size_t count) {
    const int nearest = batch->setup.spec.rounding != DP_ROUND_ZERO;
    const float *from = in;
    uint16_t *to = out;
    const __m512 one = _mm512_set1_ps(1.0F);
    for (size_t i = 0; i < count; i += 16) {
        const __mmask16 mask = tail_mask(count - i);
        const __m512 d = _mm512_maskz_loadu_ps(mask, from + i);
        const __m512 unit = _mm512_min_ps(_mm512_max_ps(d, _mm512_setzero_ps()), one);
        const __m256i half = nearest ? _mm512_cvtps_ph(unit, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC)
                                     : _mm512_cvtps_ph(unit, _MM_FROUND_TO_ZERO | _MM_FROUND_NO_EXC);
        _mm256_mask_storeu_epi16(to + i, mask, half);
    }
    return INT32_MAX;
}

TARGET static int32_t kernel_FLOAT_OF_HALF(const dp_batch *batch, const void *in, void *out, size_t count) {
    const uint16_t *from = in;
    float *to = out;
    const __m256i top = _mm256_set1_epi16(0x3C00);
    (void)batch;
    for (size_t i = 0; i < count; i += 16) {
        const __mmask16 mask = tail_mask(count - i);
        const __m256i code = _mm256_min_epu16(_mm256_maskz_loadu_epi16(mask, from + i), top);
        _mm512_mask_storeu_ps(to + i, mask, _mm512_cvtph_ps(code));
    }
    return INT32_MAX;
}

#include "core/batch_loops.h"
#else
dp_batch_kernel *const dp_batch_avx512[DP_KERNEL_COUNT] = {0};
#endif
