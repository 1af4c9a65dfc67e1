/* SPDX-License-Identifier: MIT */
/* The kernels for AVX-512. */
#include "core/batch_plan.h"
#include "core/bits.h"

#if defined(__x86_64__) && defined(__GNUC__)
#include <immintrin.h>
#include <math.h>
#include <string.h>

#define TARGET            __attribute__((target("avx512f,avx512bw,avx512dq,avx512vl,avx2,fma,f16c")))
#define FUSED             1
#define TABLE             dp_batch_avx512
#define HALF_BY_HARDWARE  1
#define QUOTIENTS_BY_HAND 1

TARGET static inline __mmask16 tail_mask(size_t left) {
    return (__mmask16)(left < 16 ? (1U << left) - 1U : 0xFFFFU);
}

/* The second argument to max is taken for NaN; what is above 1 is a larger code, and less work to clamp as one. */
TARGET static int32_t kernel_HALF_OF_FLOAT(const dp_batch *batch, const void *in, void *out, size_t count) {
    const int nearest = batch->setup.spec.rounding != DP_ROUND_ZERO;
    const float *from = in;
    uint16_t *to = out;
    const __m256i top = _mm256_set1_epi16(0x3C00);
    for (size_t i = 0; i < count; i += 16) {
        const __mmask16 mask = tail_mask(count - i);
        const __m512 d = _mm512_maskz_loadu_ps(mask, from + i);
        const __m512 unit = _mm512_max_ps(d, _mm512_setzero_ps());
        const __m256i half = nearest ? _mm512_cvtps_ph(unit, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC)
                                     : _mm512_cvtps_ph(unit, _MM_FROUND_TO_ZERO | _MM_FROUND_NO_EXC);
        _mm256_mask_storeu_epi16(to + i, mask, _mm256_min_epu16(half, top));
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

/* ---- Quotients ---------------------------------------------------------------------------------------------------
 *
 * The divider is busy for as long as the rest of such a kernel takes. So every other vector goes without it: a
 * reciprocal estimate, Newton's steps, and a last step by the exact remainder, which rounds as the divide does.
 * test_quotient.c has the proofs.
 *
 * float: the estimate is within 2^-14, so y within half a step and 2^-28 of 1/b. That rounds q rightly, but where the
 * mantissa of b is in the last 32nd of its range and divides the one of a, shifted, but for 1. No numerator of
 * dp_batch_top() has such a divisor that matters.
 */
TARGET DP_INLINE __m512 quotient(__m512 a, __m512 b) {
    const __m512 estimate = _mm512_rcp14_ps(b);
    const __m512 y = _mm512_fmadd_ps(_mm512_fnmadd_ps(b, estimate, _mm512_set1_ps(1.0F)), estimate, estimate);
    const __m512 q = _mm512_mul_ps(a, y);
    return _mm512_fmadd_ps(_mm512_fnmadd_ps(b, q, a), y, q);
}

/*
 * double: the third step makes y the rounded reciprocal, and then q is the rounded quotient (Markstein 1990). A
 * mantissa of ones alone is excepted, and matters only where a is a power of two.
 */
TARGET DP_INLINE __m512d quotient64(__m512d a, __m512d b) {
    const __m512d one = _mm512_set1_pd(1.0);
    __m512d y = _mm512_rcp14_pd(b);
    y = _mm512_fmadd_pd(_mm512_fnmadd_pd(b, y, one), y, y);
    y = _mm512_fmadd_pd(_mm512_fnmadd_pd(b, y, one), y, y);
    y = _mm512_fmadd_pd(_mm512_fnmadd_pd(b, y, one), y, y);
    const __m512d q = _mm512_mul_pd(a, y);
    return _mm512_fmadd_pd(_mm512_fnmadd_pd(b, q, a), y, q);
}

static int power_of_two(double x) {
    return dp_bits64(x) << 12 == 0;
}

TARGET DP_INLINE __m512i codes_at(const void *in, size_t i, __mmask16 mask, int word) {
    if (word == DP_WORD_16)
        return _mm512_cvtepu16_epi32(_mm256_maskz_loadu_epi16(mask, (const uint16_t *)in + i));
    return _mm512_maskz_loadu_epi32(mask, (const uint32_t *)in + i);
}

TARGET DP_INLINE void fast_eye_vector(const dp_batch_numbers *k, const void *in, float *to, size_t i, __mmask16 mask,
                                      int word, int reversed, int divide) {
    const __m512i code = _mm512_min_epu32(codes_at(in, i, mask, word), _mm512_set1_epi32((int32_t)k->code_max));
    const __m512 c = _mm512_cvtepi32_ps(code);
    const __m512 steps = reversed ? c : _mm512_sub_ps(_mm512_set1_ps(k->unit), c);
    const __m512 divisor =
        _mm512_add_ps(_mm512_mul_ps(_mm512_set1_ps(k->eye_slope), steps), _mm512_set1_ps(k->eye_base));
    const __m512 top = _mm512_set1_ps(k->eye_top);
    _mm512_mask_storeu_ps(to + i, mask, divide ? _mm512_div_ps(top, divisor) : quotient(top, divisor));
}

/* The quotient at infinity is 1/0, which the divider alone can do. */
TARGET DP_INLINE int32_t fast_eye(const dp_batch *batch, const void *in, float *to, size_t count, int word,
                                  int reversed) {
    const dp_batch_numbers k = dp_batch_read(batch)->numbers;
    size_t i = 0;
    for (; i + 32 <= count && k.eye_base > 0.0F; i += 32) {
        fast_eye_vector(&k, in, to, i, 0xFFFF, word, reversed, 1);
        fast_eye_vector(&k, in, to, i + 16, 0xFFFF, word, reversed, 0);
    }
    for (; i < count; i += 16)
        fast_eye_vector(&k, in, to, i, tail_mask(count - i), word, reversed, 1);
    return INT32_MAX;
}

#define FAST_EYE(NAME, WORD)                                                                                           \
    TARGET static int32_t kernel_##NAME(const dp_batch *batch, const void *in, void *out, size_t count) {              \
        return batch->setup.reversed ? fast_eye(batch, in, out, count, WORD, 1)                                        \
                                     : fast_eye(batch, in, out, count, WORD, 0);                                       \
    }
FAST_EYE(FAST_EYE_16, DP_WORD_16)
FAST_EYE(FAST_EYE_32, DP_WORD_32)

TARGET DP_INLINE __m512d half_of_codes(__m512i codes, int upper) {
    return _mm512_cvtepu32_pd(upper ? _mm512_extracti32x8_epi32(codes, 1) : _mm512_castsi512_si256(codes));
}

/* The two halves of 16 quotients: by the divider, and without it unless `divide`. */
TARGET DP_INLINE void store_quotients(double *to, __mmask16 mask, __m512d top, const __m512d *divisor, int divide) {
    _mm512_mask_storeu_pd(to, (__mmask8)mask, _mm512_div_pd(top, divisor[0]));
    _mm512_mask_storeu_pd(to + 8, (__mmask8)(mask >> 8),
                          divide ? _mm512_div_pd(top, divisor[1]) : quotient64(top, divisor[1]));
}

/* The value of FLOAT codes, as value_float() of batch_loops.h. */
TARGET DP_INLINE __m512d float_values(const dp_batch_numbers *k, __m512i codes, int upper) {
    const __m256i half = upper ? _mm512_extracti32x8_epi32(codes, 1) : _mm512_castsi512_si256(codes);
    const __m512d least = _mm512_set1_pd(k->least_normal);
    const __m512i shifted = _mm512_sll_epi64(_mm512_cvtepu32_epi64(half), _mm_cvtsi32_si128(52 - k->mantissa));
    const __m512i bits = _mm512_add_epi64(shifted, _mm512_set1_epi64((int64_t)(1023 - k->bias) << 52));
    const __m512d normal = _mm512_castsi512_pd(bits);
    const __m512d raised = _mm512_castsi512_pd(_mm512_add_epi64(bits, _mm512_set1_epi64((int64_t)1 << 52)));
    return _mm512_mask_sub_pd(normal, _mm512_cmp_pd_mask(normal, least, _CMP_LT_OQ), raised, least);
}

TARGET DP_INLINE int32_t eye_depths(const dp_batch *batch, const void *in, double *to, size_t count, int is_float) {
    const dp_batch_numbers *k = &dp_batch_read(batch)->numbers;
    const int divide = k->to_far == 0.0 || power_of_two(k->top);
    const __m512i code_max = _mm512_set1_epi32((int32_t)k->code_max);
    const __m512d den = _mm512_set1_pd(k->den);
    const __m512d to_num = _mm512_set1_pd(batch->setup.reversed ? k->to_near : k->to_far);
    const __m512d to_comp = _mm512_set1_pd(batch->setup.reversed ? k->to_far : k->to_near);
    for (size_t i = 0; i < count; i += 16) {
        const __mmask16 mask = tail_mask(count - i);
        const __m512i codes = _mm512_min_epu32(codes_at(in, i, mask, DP_WORD_32), code_max);
        __m512d divisor[2];
        for (int h = 0; h < 2; h++) {
            const __m512d value = is_float ? float_values(k, codes, h) : half_of_codes(codes, h);
            const __m512d num = is_float ? value : _mm512_add_pd(value, value);
            const __m512d comp = _mm512_sub_pd(den, num);
            divisor[h] = _mm512_add_pd(_mm512_mul_pd(to_num, num), _mm512_mul_pd(to_comp, comp));
        }
        store_quotients(to + i, mask, _mm512_set1_pd(k->top), divisor, divide);
    }
    return INT32_MAX;
}

TARGET static int32_t kernel_EYE_PERSPECTIVE_UNORM(const dp_batch *batch, const void *in, void *out, size_t count) {
    return eye_depths(batch, in, out, count, 0);
}

TARGET static int32_t kernel_EYE_PERSPECTIVE_FLOAT(const dp_batch *batch, const void *in, void *out, size_t count) {
    return eye_depths(batch, in, out, count, 1);
}

/* The cells at the planes are rare. */
static void mend_ends(const dp_batch *batch, const uint32_t *from, double *to, size_t count) {
    const dp_batch_numbers *k = &dp_batch_read(batch)->numbers;
    for (size_t i = 0; i < count; i++) {
        const double c = (double)(from[i] < k->code_max ? from[i] : k->code_max);
        if (c <= k->first)
            to[i] = c < k->first ? k->before_width : k->first_width;
        else if (c >= k->last)
            to[i] = c > k->last ? k->after_width : k->last_width;
    }
}

/* v is taken with the sign that the sense of the depths gives it. */
TARGET static int32_t kernel_WIDTH_PERSPECTIVE_UNORM(const dp_batch *batch, const void *in, void *out, size_t count) {
    const dp_batch_numbers *k = &dp_batch_read(batch)->numbers;
    const uint32_t *from = in;
    double *to = out;
    const int divide = power_of_two(k->width);
    const __m512i code_max = _mm512_set1_epi32((int32_t)k->code_max);
    const __m512i first = _mm512_set1_epi32((int32_t)(uint32_t)k->first + 1);
    const __m512i inner =
        _mm512_set1_epi32(k->last > k->first ? (int32_t)((uint32_t)k->last - (uint32_t)k->first - 1U) : 0);
    const __m512d steps = _mm512_set1_pd(batch->setup.reversed ? 0.0 : k->steps);
    const __m512d rest = _mm512_set1_pd(batch->setup.reversed ? -k->rest : k->rest);
    for (size_t i = 0; i < count; i += 16) {
        const __mmask16 mask = tail_mask(count - i);
        const __m512i codes = _mm512_min_epu32(codes_at(from, i, mask, DP_WORD_32), code_max);
        const __mmask16 ends = _mm512_cmpge_epu32_mask(_mm512_sub_epi32(codes, first), inner);
        __m512d divisor[2];
        for (int h = 0; h < 2; h++) {
            const __m512d v = _mm512_add_pd(_mm512_sub_pd(steps, half_of_codes(codes, h)), rest);
            divisor[h] = _mm512_sub_pd(_mm512_mul_pd(v, v), _mm512_set1_pd(0.25));
        }
        store_quotients(to + i, mask, _mm512_set1_pd(k->width), divisor, divide);
        if (ends != 0)
            mend_ends(batch, from + i, to + i, count - i < 16 ? count - i : 16);
    }
    return INT32_MAX;
}

#include "core/batch_loops.h"
#else
dp_batch_kernel *const dp_batch_avx512[DP_KERNEL_COUNT] = {0};
#endif
