/* SPDX-License-Identifier: MIT */
/*
 * Every operation below is one binary32 operation of the hardware, in its order: float in, float out, no operation
 * contracted into another and none kept in a wider register. The build must say -ffp-contract=off; a caller that
 * compiles this file with x87 arithmetic is stopped here.
 */
#include "depthprec/pipeline.h"

#include <float.h>
#include <math.h>

#include "core/bits.h"
#include "core/clip.h"
#include "core/engine.h"

_Static_assert(FLT_EVAL_METHOD == 0, "binary32 operations must be rounded to binary32");

/* ---- The matrix: entries in double, rounded once ------------------------------------------------------------- */

typedef struct entries {
    double a, b;
} entries;

static entries perspective(double n, double f, int ndc_signed, int reversed) {
    if (isinf(f)) {
        if (ndc_signed)
            return reversed ? (entries){-1.0, 2.0 * n} : (entries){1.0, -2.0 * n};
        return reversed ? (entries){0.0, n} : (entries){1.0, -n};
    }
    if (ndc_signed) {
        const entries gl = {(f + n) / (f - n), -2.0 * n * f / (f - n)};
        return reversed ? (entries){-gl.a, -gl.b} : gl;
    }
    return reversed ? (entries){n / (n - f), n * f / (f - n)} : (entries){f / (f - n), -n * f / (f - n)};
}

static entries orthographic(double n, double f, int ndc_signed, int reversed) {
    if (ndc_signed) {
        const entries gl = {2.0 / (f - n), -(f + n) / (f - n)};
        return reversed ? (entries){-gl.a, -gl.b} : gl;
    }
    return reversed ? (entries){1.0 / (n - f), f / (f - n)} : (entries){1.0 / (f - n), -n / (f - n)};
}

static entries entries_of(const dp_spec *spec) {
    const dp_mapping_row *row = dp_mapping_get(spec->mapping);
    return (spec->ortho ? orthographic : perspective)(spec->znear, spec->zfar, row->ndc_signed, row->reversed);
}

void dp_pipeline_rounded(const dp_setup *setup, double *a, double *b) {
    const entries e = entries_of(&setup->spec);
    *a = (double)setup->matrix[0] - e.a;
    *b = (double)setup->matrix[1] - e.b;
}

void dp_pipeline_prepare(dp_setup *setup) {
    const dp_spec *spec = &setup->spec;
    const entries e = entries_of(spec);
    setup->matrix[0] = (float)e.a;
    setup->matrix[1] = (float)e.b;
    setup->inside[0] = dp_float_up(spec->znear); /* no plane is stepped over */
    setup->inside[1] = dp_float_down(spec->zfar);
}

dp_status dp_pipeline_init(dp_pipeline *pipeline, const dp_setup *setup) {
    if (pipeline == NULL || setup == NULL)
        return DP_ERROR_NULL;
    const dp_spec *spec = &setup->spec;
    const dp_mapping_row *row = dp_mapping_get(spec->mapping);
    const dp_arith_row *arith = dp_arith_get(spec->arith);
    if (row == NULL || arith == NULL || row->curve != DP_CURVE_PERSPECTIVE)
        return DP_ERROR_MODEL;
    const int is_signed = row->ndc_signed && !arith->remap;
    const double *range = spec->depth_range;
    const double lo = (double)(float)range[0], hi = (double)(float)range[1];
    *pipeline = (dp_pipeline){.format = spec->format,
                              .rounding = spec->rounding,
                              .arith = arith,
                              .a = setup->matrix[0],
                              .b = setup->matrix[1],
                              .scale = (float)(is_signed ? 0.5 * (hi - lo) : hi - lo),
                              .offset = (float)(is_signed ? 0.5 * (lo + hi) : lo),
                              .reversed = setup->reversed,
                              .clip_reversed = row->reversed,
                              .moved = is_signed || setup->ranged,
                              .ndc_signed = row->ndc_signed,
                              .ortho = spec->ortho != 0,
                              .znear = setup->inside[0],
                              .zfar = setup->inside[1]};
    return DP_OK;
}

/* ---- One depth ----------------------------------------------------------------------------------------------- */

static float clip_w(const dp_pipeline *p, float z) {
    return p->ortho ? 1.0f : z;
}

float dp_pipeline_clip(const dp_pipeline *p, float z) {
    return dp_clip_remap(p, dp_clip_project(p, z), clip_w(p, z));
}

float dp_pipeline_divide(const dp_pipeline *p, float z, float w) {
    return dp_clip_window(p, dp_clip_remap(p, z, w), w);
}

float dp_pipeline_window(const dp_pipeline *p, float z) {
    return dp_pipeline_divide(p, dp_clip_project(p, z), clip_w(p, z));
}

/*
 * For 16 bits 2^20 d and 16 d are cut to whole numbers, sixteenths of a code, and 7 of them round the difference. For
 * 24 bits nothing is taken off below 1/16; from there on depths of binary32 are too coarse to show how 16 d is cut, and
 * the exact product gives the same codes.
 */
static uint32_t convert_sixteenths(const dp_format *format, double d) {
    const double top = ldexp(1.0, format->bits);
    if (format->bits <= 16)
        return (uint32_t)floor((floor(16.0 * top * d) - floor(16.0 * d) + 7.0) / 16.0);
    return d < 1.0 / 16.0 ? (uint32_t)floor(top * d + 0.5) : dp_format_encode(format, DP_ROUND_NEAREST, d);
}

uint32_t dp_pipeline_convert(const dp_pipeline *p, float window) {
    const float d = window > 0.0f ? (window < 1.0f ? window : 1.0f) : 0.0f; /* NaN becomes 0 */
    if (p->format.kind == DP_FORMAT_FLOAT || p->arith->conversion == DP_CONVERT_EXACT)
        return dp_format_encode(&p->format, p->rounding, (double)d);
    if (p->arith->conversion == DP_CONVERT_SIXTEENTHS)
        return convert_sixteenths(&p->format, (double)d);
    /* Above 24 bits the factor itself is rounded, to 2^N, so the product may pass the last code. */
    const float product = d * (float)p->format.code_max;
    const double whole =
        p->arith->conversion == DP_CONVERT_PRODUCT_ZERO ? trunc((double)product) : rint((double)product);
    return whole < (double)p->format.code_max ? (uint32_t)whole : p->format.code_max;
}

uint32_t dp_pipeline_code(const dp_pipeline *p, float z) {
    return dp_pipeline_convert(p, dp_pipeline_window(p, z));
}

/* ---- Clipping ------------------------------------------------------------------------------------------------ */

static int above_lower(const dp_pipeline *p, float z) {
    return dp_pipeline_clip(p, z) >= (dp_clip_is_signed(p) ? -clip_w(p, z) : 0.0f);
}

static int below_upper(const dp_pipeline *p, float z) {
    return dp_pipeline_clip(p, z) <= clip_w(p, z);
}

int dp_pipeline_drawn(const dp_pipeline *p, float z) {
    return above_lower(p, z) && below_upper(p, z);
}

/* Depths are walked as integers, their ranks. */
static int near_keeps(const dp_pipeline *p, uint32_t rank) {
    return p->clip_reversed ? below_upper(p, dp_ranked32(rank)) : above_lower(p, dp_ranked32(rank));
}

static int far_keeps(const dp_pipeline *p, uint32_t rank) {
    return p->clip_reversed ? above_lower(p, dp_ranked32(rank)) : below_upper(p, dp_ranked32(rank));
}

/* z, fl(A z) and z_clip stay in one binade each, so that all three have one step throughout lo..hi. */
static int same_steps(const dp_pipeline *p, uint32_t lo, uint32_t hi) {
    const float z[2] = {dp_ranked32(lo), dp_ranked32(hi)};
    return ilogbf(z[0]) == ilogbf(z[1]) && ilogbf(p->a * z[0]) == ilogbf(p->a * z[1]) &&
           ilogbf(dp_pipeline_clip(p, z[0])) == ilogbf(dp_pipeline_clip(p, z[1]));
}

/*
 * The farthest depth in lo..hi that the far plane keeps, or 0, which is the rank of no depth.
 *
 * Where w is constant or grows against z_clip, keeping is monotone in z: the nearest decides for all. Not so for the
 * standard perspective, where z_clip <= z compares two growing numbers. But while the binades stay, z_clip - z in steps
 * is a non-decreasing whole number plus at most one step that depends on whether z is even (rounding ties): a depth
 * that is lost, and its neighbour lost too, lose all that follow in the binade. So halving finds the last one without
 * looking at each.
 */
static uint32_t farthest_kept(const dp_pipeline *p, uint32_t lo, uint32_t hi) {
    if (p->ortho && lo <= hi && !far_keeps(p, lo))
        return 0;
    while (lo <= hi) {
        if (far_keeps(p, hi))
            return hi;
        if (hi - lo < 4) {
            hi--;
            continue;
        }
        if (same_steps(p, lo, hi) && !far_keeps(p, lo) && !far_keeps(p, lo + 1))
            return 0;
        const uint32_t middle = lo + (hi - lo) / 2;
        const uint32_t found = farthest_kept(p, middle, hi - 1);
        if (found != 0)
            return found;
        hi = middle - 1;
    }
    return 0;
}

/* The nearest depth that the near plane keeps: that condition is monotone in z for every row. */
static uint32_t nearest_kept(const dp_pipeline *p, uint32_t lo, uint32_t hi) {
    while (lo < hi) {
        const uint32_t middle = lo + (hi - lo) / 2;
        if (near_keeps(p, middle))
            hi = middle;
        else
            lo = middle + 1;
    }
    return lo;
}

void dp_pipeline_planes(const dp_pipeline *p, float *znear, float *zfar) {
    const uint32_t lo = dp_rank32(p->znear);
    const uint32_t hi = dp_rank32(isinf(p->zfar) ? FLT_MAX : p->zfar);
    uint32_t first = nearest_kept(p, lo, hi);
    uint32_t last = farthest_kept(p, first, hi);
    /* Planes that nearly touch leave a few thousand depths, where the two conditions may interfere: look at each. */
    while (first <= last && !dp_pipeline_drawn(p, dp_ranked32(first)))
        first++;
    while (first <= last && !dp_pipeline_drawn(p, dp_ranked32(last)))
        last--;
    const int drawn = first <= last;
    *znear = drawn ? dp_ranked32(first) : NAN;
    *zfar = drawn ? (last == hi ? p->zfar : dp_ranked32(last)) : NAN;
}
