/* SPDX-License-Identifier: MIT */
/* The kernels for AVX2 with fused operations and binary16 conversions. */
#include "core/batch_plan.h"

#if defined(__x86_64__) && defined(__GNUC__)
#include <immintrin.h>
#include <math.h>
#include <string.h>

#define TARGET           __attribute__((target("avx2,fma,f16c")))
#define FUSED            1
#define TABLE            dp_batch_avx2
#define HALF_BY_HARDWARE 1

/* The second argument to max is taken for NaN; what is above 1 is a larger code, and less work to clamp as one. */
TARGET static inline __m128i half_of(__m256 d, int nearest) {
    const __m256 unit = _mm256_max_ps(d, _mm256_setzero_ps());
    const __m128i half =
        nearest ? _mm256_cvtps_ph(unit, _MM_FROUND_TO_NEAREST_INT) : _mm256_cvtps_ph(unit, _MM_FROUND_TO_ZERO);
    return _mm_min_epu16(half, _mm_set1_epi16(0x3C00));
}

TARGET static int32_t kernel_HALF_OF_FLOAT(const dp_batch *batch, const void *in, void *out, size_t count) {
    const int nearest = batch->setup.spec.rounding != DP_ROUND_ZERO;
    const float *from = in;
    uint16_t *to = out;
    size_t i = 0;
    for (; i + 8 <= count; i += 8)
        _mm_storeu_si128((__m128i *)(void *)(to + i), half_of(_mm256_loadu_ps(from + i), nearest));
    if (i < count) {
        float tail[8] = {0};
        __m128i half;
        memcpy(tail, from + i, (count - i) * sizeof *from);
        half = half_of(_mm256_loadu_ps(tail), nearest);
        memcpy(to + i, &half, (count - i) * sizeof *to);
    }
    return INT32_MAX;
}

TARGET static inline __m256 of_half(__m128i code) {
    return _mm256_cvtph_ps(_mm_min_epu16(code, _mm_set1_epi16(0x3C00)));
}

TARGET static int32_t kernel_FLOAT_OF_HALF(const dp_batch *batch, const void *in, void *out, size_t count) {
    const uint16_t *from = in;
    float *to = out;
    size_t i = 0;
    (void)batch;
    for (; i + 8 <= count; i += 8)
        _mm256_storeu_ps(to + i, of_half(_mm_loadu_si128((const __m128i *)(const void *)(from + i))));
    if (i < count) {
        __m128i half = _mm_setzero_si128();
        memcpy(&half, from + i, (count - i) * sizeof *from);
        const __m256 value = of_half(half);
        memcpy(to + i, &value, (count - i) * sizeof *to);
    }
    return INT32_MAX;
}

#include "core/batch_loops.h"
#else
dp_batch_kernel *const dp_batch_avx2[DP_KERNEL_COUNT] = {0};
#endif
