/* SPDX-License-Identifier: MIT */
/*
 * Batch kernels: how they are named, found and called.
 *
 * A kernel turns `count` elements into as many others. Where it yields codes that are only proven at a distance from
 * rounding boundaries, it returns the least distance that it met, in its own units; the caller compares it with
 * batch->doubt. Kernels that cannot be wrong return INT32_MAX.
 *
 * General kernels read and write double and uint32_t; conversions stand before and behind them. Direct ones read and
 * write the caller's types.
 */
#ifndef CORE_BATCH_PLAN_H
#define CORE_BATCH_PLAN_H

#include "depthprec/batch.h"

/* clang-format off */
#define DP_BATCH_KERNELS(X)                                                                                            \
    /* general: double to uint32_t */                                                                                  \
    X(CODE_PERSPECTIVE_UNORM) X(CODE_PERSPECTIVE_FLOAT) X(CODE_LINEAR_UNORM) X(CODE_LINEAR_FLOAT)                      \
    X(ENCODE_UNORM) X(ENCODE_FLOAT)                                                                                    \
    /* general: uint32_t to double */                                                                                  \
    X(DECODE_UNORM) X(DECODE_UNORM_WIDE) X(DECODE_FLOAT)                                                               \
    X(EYE_PERSPECTIVE_UNORM) X(EYE_PERSPECTIVE_FLOAT) X(EYE_LINEAR_UNORM) X(EYE_LINEAR_FLOAT)                          \
    X(WIDTH_PERSPECTIVE_UNORM) X(WIDTH_PERSPECTIVE_FLOAT) X(WIDTH_LINEAR_UNORM) X(WIDTH_LINEAR_FLOAT)                  \
    X(LO_PERSPECTIVE_UNORM) X(LO_PERSPECTIVE_FLOAT) X(LO_LINEAR_UNORM) X(LO_LINEAR_FLOAT)                              \
    X(HI_PERSPECTIVE_UNORM) X(HI_PERSPECTIVE_FLOAT) X(HI_LINEAR_UNORM) X(HI_LINEAR_FLOAT)                              \
    /* conversions */                                                                                                  \
    X(WIDEN_REAL) X(NARROW_REAL) X(NARROW_DOWN) X(NARROW_UP) X(WIDEN_CODE) X(NARROW_CODE)                              \
    /* direct */                                                                                                       \
    X(STANDARD_16) X(STANDARD_32) X(REVERSED_16) X(REVERSED_32)                                                        \
    X(UNORM_OF_FLOAT_16) X(UNORM_OF_FLOAT_32) X(UNORM24_OF_FLOAT)                                                      \
    X(FLOAT_OF_UNORM_16) X(FLOAT_OF_UNORM_32)                                                                          \
    X(HALF_OF_FLOAT) X(FLOAT_OF_HALF) X(BITS_OF_FLOAT) X(FLOAT_OF_BITS) X(FAST_EYE_16) X(FAST_EYE_32)                  \
    X(BINARY32_STANDARD) X(BINARY32_REVERSED)
/* clang-format on */

#define DP_BATCH_NAME(K) DP_KERNEL_##K,
enum { DP_BATCH_KERNELS(DP_BATCH_NAME) DP_KERNEL_COUNT, DP_KERNEL_NONE = DP_KERNEL_COUNT };

/* The constants of a prepared task. They stand in the public struct's opaque words, as if declared there. */
#define DP_BATCH_ALIAS __attribute__((may_alias))
typedef struct DP_BATCH_ALIAS dp_batch_numbers {
    double lo, hi, from, slope, scale, magic;
    uint64_t half;
    int shift, cut, mantissa, bias, reversed, truncates;
    uint32_t rebias, code_max;
    double least_normal, top, to_near, to_far, den, steps, rest, width, first, last, before_width, first_width,
        last_width, after_width;
    double value, value_rest;
    float z_lo, z_hi, reach, reach_rest, reach_inverse, offset;
    int32_t whole;
    float unit, unit_rest, split, eye_top, eye_slope, eye_base;
    float offset_rest, unsure, beyond;
    uint32_t near_code, far_code;
} dp_batch_numbers;

typedef struct DP_BATCH_ALIAS dp_batch_own {
    int kernel, direct;
    int32_t doubt;
    const void *kept; /* by dp_batch_keep(), or null */
    dp_batch_numbers numbers;
} dp_batch_own;

_Static_assert(sizeof(dp_batch_own) <= sizeof((dp_batch){0}.opaque), "dp_batch is too small");

static inline const dp_batch_own *dp_batch_read(const dp_batch *batch) {
    return (const dp_batch_own *)(const void *)batch->opaque;
}

static inline dp_batch_own *dp_batch_write(dp_batch *batch) {
    return (dp_batch_own *)(void *)batch->opaque;
}

typedef int32_t dp_batch_kernel(const dp_batch *batch, const void *in, void *out, size_t count);

/* The kernels of a path by name; null where a path has no direct one. Null tables: compiled for another processor. */
extern dp_batch_kernel *const dp_batch_baseline[DP_KERNEL_COUNT];
extern dp_batch_kernel *const dp_batch_avx2[DP_KERNEL_COUNT];
extern dp_batch_kernel *const dp_batch_avx512[DP_KERNEL_COUNT];

/* Fills in everything behind `out_size`, by the kernels that there are. */
void dp_batch_plan(dp_batch *batch, dp_batch_kernel *const *table);

/* The numerators of FAST_EYE: none has a divisor by which batch_avx512.c could round wrongly (test_quotient.c).
 */
enum { DP_BATCH_TOPS = 4096, DP_BATCH_TOP_FIRST = 20480 };

static inline double dp_batch_top(int i) {
    return (DP_BATCH_TOP_FIRST + i) * 0x1p-14;
}

static inline int dp_task_reads_code(dp_task task) {
    return task == DP_TASK_EYE || task == DP_TASK_WIDTH || task == DP_TASK_DECODE || task == DP_TASK_LO ||
           task == DP_TASK_HI;
}

static inline int dp_task_writes_code(dp_task task) {
    return task == DP_TASK_CODE || task == DP_TASK_ENCODE;
}

#endif
