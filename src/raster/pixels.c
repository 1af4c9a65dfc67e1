/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Pixels of one row: each rasterizer's operations in its order, compiled for each path. Blocks of 16, the last of which
 * overlaps the one before: a pixel depends on its place alone.
 */
#include <float.h>
#include <math.h>

#include "raster/model.h"

enum { BLOCK = 16 };

typedef float fused(float a, float b, float c);

DP_INLINE float by_hardware(float a, float b, float c) {
    return __builtin_fmaf(a, b, c);
}

DP_INLINE float unit(float d) {
    const float low = d > 0.0F ? d : 0.0F;
    return low < 1.0F ? low : 1.0F;
}

DP_INLINE float llvmpipe(const raster_plane *p, float x, float y, int odd_x, int odd_y, fused *fma32) {
    (void)odd_x, (void)odd_y;
    return unit(fma32(p->b, y, fma32(p->a, x, p->c)));
}

/* A quad of two by two pixels is one evaluation; it leaves the depth as it comes. */
DP_INLINE float softpipe(const raster_plane *p, float x, float y, int odd_x, int odd_y, fused *fma32) {
    (void)fma32;
    const float quad = p->c + p->a * (x - (float)odd_x) + p->b * (y - (float)odd_y);
    const float right = odd_x != 0 ? quad + p->a : quad;
    return odd_y != 0 ? right + p->b : right;
}

DP_INLINE float swiftshader(const raster_plane *p, float x, float y, int odd_x, int odd_y, fused *fma32) {
    (void)odd_x, (void)odd_y, (void)fma32;
    return unit(p->c + (y - p->y) * p->b + (x - p->x) * p->a);
}

/* The loop of one rasterizer for one instruction set. Narrow spans are a block whose rest is left out. */
#define LOOP(TARGET, PIXEL, NAME, FMA32)                                                                               \
    DP_INLINE void NAME##_block(const raster_plane *p, int y, int x, int count, float *depth) {                        \
        for (int i = 0; i < BLOCK; i++)                                                                                \
            if (i < count)                                                                                             \
                depth[i] = PIXEL(p, (float)(x + i), (float)y, (x + i) & 1, y & 1, FMA32);                              \
    }                                                                                                                  \
    TARGET static void NAME(const raster_plane *p, int y, int from, int to, float *depth) {                            \
        const raster_plane plane = *p;                                                                                 \
        if (to - from < BLOCK) {                                                                                       \
            NAME##_block(&plane, y, from, to - from, depth);                                                           \
            return;                                                                                                    \
        }                                                                                                              \
        for (int x = from; x < to; x += BLOCK) {                                                                       \
            x = x < to - BLOCK ? x : to - BLOCK;                                                                       \
            NAME##_block(&plane, y, x, BLOCK, depth + (x - from));                                                     \
        }                                                                                                              \
    }

/* Without the instruction: where double holds all sums exactly it rounds them as the fused operation does. */
DP_INLINE float by_double(float a, float b, float c) {
    return (float)((double)a * (double)b + (double)c);
}
LOOP(, llvmpipe, llvmpipe_quick, by_double)
LOOP(, llvmpipe, llvmpipe_careful, raster_fma)

static float least_of(float least, float x) {
    return x != 0.0F && fabsf(x) < least ? fabsf(x) : least;
}

/* All sums are multiples of 2^-24 of the least term, and at most the sum of the greatest: 53 bits hold them. */
static void llvmpipe_baseline(const raster_plane *p, int y, int from, int to, float *depth) {
    const float least = least_of(least_of(least_of(FLT_MAX, p->a), p->b), p->c);
    const float most = fabsf(p->a) * (float)to + fabsf(p->b) * (float)y + fabsf(p->c);
    (most < least * 0x1p27F ? llvmpipe_quick : llvmpipe_careful)(p, y, from, to, depth);
}
LOOP(, softpipe, softpipe_baseline, by_hardware)
LOOP(, swiftshader, swiftshader_baseline, by_hardware)

#if defined(__x86_64__) && defined(__GNUC__)
#define PATHS(TARGET, PATH)                                                                                            \
    LOOP(TARGET, llvmpipe, llvmpipe_##PATH, by_hardware)                                                               \
    LOOP(TARGET, softpipe, softpipe_##PATH, by_hardware)                                                               \
    LOOP(TARGET, swiftshader, swiftshader_##PATH, by_hardware)
PATHS(__attribute__((target("avx2,fma"))), avx2)
PATHS(__attribute__((target("avx512f,avx512bw,avx512dq,avx512vl,fma"))), avx512)
#define TABLE(ROW)                                                                                                     \
    raster_depth_loop *const raster_##ROW##_depths[DP_PATH_COUNT] = {ROW##_baseline, ROW##_avx2, ROW##_avx512};
#else
#define TABLE(ROW) raster_depth_loop *const raster_##ROW##_depths[DP_PATH_COUNT] = {ROW##_baseline};
#endif
TABLE(llvmpipe)
TABLE(softpipe)
TABLE(swiftshader)

bool raster_plane_finite(const raster_target *target, const raster_plane *p) {
    const double x = (double)target->width + BLOCK + fabs((double)p->x);
    const double y = (double)target->height + BLOCK + fabs((double)p->y);
    return fabs((double)p->a) * x + fabs((double)p->b) * y + fabs((double)p->c) < (double)FLT_MAX;
}

/* Adding 1.5 x 2^52 rounds a double to whole numbers, ties to even, and leaves them in its lowest bits. */
void raster_unorm_even(const float *depth, int count, float scale, uint32_t *code) {
    for (int i = 0; i < count; i++)
        code[i] = (uint32_t)dp_bits64((double)(depth[i] * scale) + 0x1.8p52);
}

/* Depths a little outside 0 to 1 wrap, as the processor's conversion to 64 bits leaves them. */
void raster_unorm_zero(const float *depth, int count, float scale, uint32_t *code) {
    for (int i = 0; i < count; i++) {
        const float value = depth[i] * scale;
        code[i] = fabsf(value) < 0x1p62F ? (uint32_t)(int64_t)value & (uint32_t)scale : 0U;
    }
}
