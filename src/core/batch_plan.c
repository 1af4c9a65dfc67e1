/* SPDX-License-Identifier: MIT */
/* Which kernel does a task, and with which numbers. batch_loops.h has the kernels. */
#include "core/batch_plan.h"

#include <math.h>

#include "core/lattice.h"
#include "depthprec/depth.h"

/* ---- Numbers ----------------------------------------------------------------------------------------------------- */

static void plan_format(dp_batch *b) {
    const dp_format *f = &b->setup.spec.format;
    dp_batch_numbers *k = &dp_batch_write(b)->numbers;
    k->code_max = f->code_max;
    k->reversed = b->setup.reversed;
    k->truncates = b->setup.spec.rounding == DP_ROUND_ZERO;
    k->den = dp_point_den(f);
    if (f->kind == DP_FORMAT_FLOAT) {
        k->mantissa = f->mantissa_bits;
        k->bias = f->bias;
        k->least_normal = dp_power2(1 - f->bias);
        return;
    }
    /* 1/M as a sum whose first part times a code is exact: the codes' values then take one rounding. */
    const double top = (double)f->code_max;
    k->value = dp_float64(dp_bits64(1.0 / top) & ~(((uint64_t)1 << f->bits) - 1U));
    k->value_rest = fma(-k->value, top, 1.0) / top;
}

/*
 * Depth to code through double: d = (from + slope z) [/ z] scale, 6 roundings.
 *
 * UNORM: t = d M stands in units of 2^-20 above 2^32, off by at most 1/2 + 6 M 2^-33 of them. FLOAT: d is off by less
 * than 16 units in the last place of a double, which are less than one of the 2^-20 steps that are looked at. Adding
 * `slack` to what is rounded down makes floor(t) wrong only where less than twice the slack is left above it.
 */
static void plan_code(dp_batch *b) {
    const dp_setup *s = &b->setup;
    const dp_format *f = &s->spec.format;
    dp_batch_numbers *k = &dp_batch_write(b)->numbers;
    const int nearest = s->spec.rounding != DP_ROUND_ZERO;
    const double n = s->spec.znear;
    const double z_far = s->spec.zfar;
    if (b->task == DP_TASK_ENCODE) {
        k->hi = 1.0;
        k->z_hi = 1.0F;
        k->scale = 1.0;
    } else {
        k->lo = n;
        k->hi = z_far < 1e300 ? z_far : 1e300;
        k->slope = s->reversed ? -1.0 : 1.0;
        k->from = s->curve == DP_CURVE_LINEAR ? -s->anchor : -n;
        k->scale = s->curve == DP_CURVE_LINEAR ? 1.0 / s->kappa : s->scale;
        if (s->reversed) {
            k->from = isinf(z_far) ? n : z_far;
            k->slope = isinf(z_far) ? 0.0 : -1.0;
        }
    }
    if (f->kind == DP_FORMAT_UNORM) {
        const int slack = 2 + (int)ceil((double)f->code_max * 0x1p-30);
        k->scale *= (double)f->code_max;
        k->magic = 0x1p32 + (nearest ? 0.5 : 0.0) + slack * 0x1p-20;
        k->shift = 20;
        dp_batch_write(b)->doubt = 2 * slack;
        return;
    }
    k->shift = 52 - f->mantissa_bits;
    k->cut = k->shift - 20;
    k->rebias = (uint32_t)(1023 - f->bias) << f->mantissa_bits;
    k->half = ((uint64_t)2 << k->cut) + (nearest ? (uint64_t)1 << (k->shift - 1) : 0);
    dp_batch_write(b)->doubt = 4;
}

/*
 * A cell of UNORM between shares s - 1/2 and s + 1/2 of M towards the near plane is n f M/(f - n) / (v^2 - 1/4) wide,
 * where v = s + n M/(f - n); truncated, the middle is half a step away. Both constants are sums of two doubles until
 * their last rounding: 15 roundings in all, those of dp_cell_of() among them.
 */
static void plan_cells(dp_batch *b) {
    const dp_setup *s = &b->setup;
    dp_batch_numbers *k = &dp_batch_write(b)->numbers;
    const double n = s->spec.znear;
    const double f = s->spec.zfar;
    const double middle = s->spec.rounding != DP_ROUND_ZERO ? 0.0 : s->reversed ? 0.5 : -0.5;
    const double range = f - n;
    const double range_rest = f - range - n;
    const double product = n * k->steps;
    const double product_rest = fma(n, k->steps, -product);
    const double q = isinf(f) ? 0.0 : product / range;
    const double q_rest = isinf(f) ? 0.0 : (fma(-q, range, product) + product_rest - q * range_rest) / range;
    const double sum = q + middle;
    k->rest = sum + (fabs(q) < 0.5 ? middle - sum + q : q - sum + middle) + q_rest;
    k->width = fma(n, q, product) + (product_rest + n * q_rest);
}

static void plan_width(dp_batch *b) {
    const dp_setup *s = &b->setup;
    dp_batch_numbers *k = &dp_batch_write(b)->numbers;
    const int unorm = s->spec.format.kind == DP_FORMAT_UNORM;
    const uint32_t first = s->code_near < s->code_far ? s->code_near : s->code_far;
    uint32_t last = s->code_near < s->code_far ? s->code_far : s->code_near;
    if (last > first && unorm && s->spec.rounding == DP_ROUND_ZERO)
        last--; /* a plane alone has the last code, and the other side of the cell before it is that plane */
    k->first = (double)first;
    k->last = (double)last;
    k->before_width = dp_cell_of(s, 0).width;
    k->first_width = dp_cell_of(s, first).width;
    k->last_width = dp_cell_of(s, last).width;
    k->after_width = dp_cell_of(s, s->spec.format.code_max).width;
    k->steps = (double)s->spec.format.code_max;
    if (s->curve == DP_CURVE_LINEAR)
        k->width = unorm ? 2.0 / k->den * s->kappa : s->kappa;
    else if (unorm)
        plan_cells(b);
    else
        k->width = k->top * (k->top * s->kappa);
}

/* Codes are counted from the near plane on. */
static void plan_ends(dp_batch *b) {
    const dp_setup *s = &b->setup;
    dp_batch_numbers *k = &dp_batch_write(b)->numbers;
    k->slope = s->reversed ? -1.0 : 1.0;
    k->first = k->slope * (double)s->code_near;
    k->last = k->slope * (double)s->code_far;
    k->lo = s->spec.znear;
    k->hi = s->spec.zfar;
}

static void plan_depth(dp_batch *b) {
    const dp_setup *s = &b->setup;
    dp_batch_numbers *k = &dp_batch_write(b)->numbers;
    const double n = s->spec.znear;
    const double f = s->spec.zfar;
    if (s->curve == DP_CURVE_LINEAR) {
        k->to_near = s->anchor;
        k->to_far = f;
    } else {
        k->top = (isinf(f) ? n : n * f) * k->den;
        k->to_near = isinf(f) ? 1.0 : f;
        k->to_far = isinf(f) ? 0.0 : n;
    }
    if (b->task == DP_TASK_WIDTH)
        plan_width(b);
    else if (b->task != DP_TASK_EYE)
        plan_ends(b);
}

/* ---- Conditions of the direct kernels, each filling in its numbers ----------------------------------------------- */

static int nearest_unorm(dp_batch *b) {
    const dp_format *f = &b->setup.spec.format;
    dp_batch_write(b)->numbers.unit = (float)f->code_max;
    dp_batch_write(b)->numbers.split = (float)dp_power2(f->bits);
    return f->bits >= 2 && f->bits < 24 && !dp_format_is_rg(f) && b->setup.spec.rounding != DP_ROUND_ZERO;
}

static int nearest_unorm24(dp_batch *b) {
    return b->setup.spec.format.bits == 24 && b->setup.spec.rounding != DP_ROUND_ZERO;
}

/*
 * t = s - p/z (or p/z - s) for N <= 24 and f >= 16 n, so that p/z < 1.07 2^24. With u = 2^-24: the quotient's remainder
 * is exact, the rest of p adds one rounding, and the inverse is within 4 u of 1/z; so the small part, at most 2.2, is
 * off by 1.2 2^-45 p/z < 0.7 steps of 2^-20. Three roundings into [8, 16) add 1/2 step each: 2.2 steps in all.
 */
static int quotient_unorm(dp_batch *b) {
    enum { SLACK = 3 };
    const dp_spec *spec = &b->setup.spec;
    dp_batch_numbers *k = &dp_batch_write(b)->numbers;
    const double n = spec->znear;
    const double f = spec->zfar;
    if (spec->format.bits > 24 || !(f >= 16.0 * n))
        return 0;
    /* Beyond 1e24 nothing changes: p/z is below 2e-5 there. Codes of depths between the planes and the nearest floats
       inside are those of the planes, or it is left to the general kernel. */
    k->z_lo = dp_float_up(n);
    k->z_hi = dp_float_down(f < 1e24 ? f : 1e24);
    if (dp_code(&b->setup, (double)k->z_lo) != b->setup.code_near ||
        dp_code(&b->setup, (double)k->z_hi) != b->setup.code_far)
        return 0;
    const double top = (double)spec->format.code_max;
    const double far_scale = isinf(f) ? 1.0 : f / (f - n);
    const double p = top * (n * far_scale);
    const double s = b->setup.reversed ? isinf(f) ? 0.0 : -top * (n / (f - n)) : top * far_scale;
    const double sum = s + (spec->rounding == DP_ROUND_ZERO ? 0.0 : 0.5) + SLACK * 0x1p-20;
    const double whole = floor(sum) + (b->setup.reversed ? 1.0 : 0.0);
    k->reach = (float)p;
    k->reach_rest = (float)(p - (double)k->reach);
    k->reach_inverse = (float)(1.0 / p);
    k->offset = (float)(sum - whole + 12.0);
    /* the bits of a float in [8, 16) shifted by 20 are 1040 at 8 */
    k->whole = (int32_t)whole - 12 - (1040 - 8);
    dp_batch_write(b)->doubt = 2 * SLACK + 1;
    return 1;
}

static int quotient_standard(dp_batch *b) {
    return !b->setup.reversed && quotient_unorm(b);
}

static int quotient_reversed(dp_batch *b) {
    return b->setup.reversed && quotient_unorm(b);
}

/*
 * d = s - p/z (or p/z - s) for f >= 2 n. In units of u^2 = 2^-48 of the larger term, what is left of s and p is off by
 * 1 each, the quotient's remainder by 2, its sum by 3, its product with 1/z by 3, and the sums of what is below d, at
 * most 5 u, by 2, 5 and 5: 22, and the error that is reckoned with is 32. Subnormal numbers are off by 2^-150 each.
 */
static int binary32(dp_batch *b) {
    const dp_spec *spec = &b->setup.spec;
    dp_batch_numbers *k = &dp_batch_write(b)->numbers;
    const double n = spec->znear, f = spec->zfar;
    if (!dp_format_is_ieee(&spec->format, 23, 127) || spec->rounding == DP_ROUND_ZERO || !(f >= 2.0 * n))
        return 0;
    const double far_scale = isinf(f) ? 1.0 : f / (f - n), p = n * far_scale;
    const double s = !b->setup.reversed ? far_scale : isinf(f) ? 0.0 : n / (f - n);
    k->z_lo = dp_float_up(n);
    k->beyond = dp_float_up(f);
    k->near_code = b->setup.code_near;
    k->far_code = b->setup.code_far;
    k->reach = (float)p;
    k->reach_rest = (float)(b->setup.reversed ? p - (double)k->reach : (double)k->reach - p);
    k->offset = (float)s;
    k->offset_rest = (float)(b->setup.reversed ? (double)k->offset - s : s - (double)k->offset);
    k->unsure = (float)s * 0x1p-43F;
    dp_batch_write(b)->doubt = 1;
    return 1;
}

static int binary32_standard(dp_batch *b) {
    return !b->setup.reversed && binary32(b);
}

static int binary32_reversed(dp_batch *b) {
    return b->setup.reversed && binary32(b);
}

/* c/M = c 2^-N + c (1/M - 2^-N): right in binary32 for every code of these formats (test_batch.c tries all). */
static int value_unorm(dp_batch *b) {
    const int bits = b->setup.spec.format.bits;
    if (bits < 16 || bits > 24 || dp_format_is_rg(&b->setup.spec.format))
        return 0;
    const double unit = dp_power2(-bits);
    dp_batch_write(b)->numbers.unit = (float)unit;
    dp_batch_write(b)->numbers.unit_rest =
        (float)(unit / (double)b->setup.spec.format.code_max); /* 1/M - 2^-N = 2^-N / M */
    return 1;
}

/*
 * z = l/(G s + H), with s steps towards the near plane, G = l (1/n - 1/f)/M and H = l/f: the product, the sum and the
 * quotient are rounded, and l is chosen so that G and H are off by less than a sixteenth of u = 2^-24: 3.1 u in all.
 */
static int fast_eye(dp_batch *b) {
    const dp_spec *spec = &b->setup.spec;
    dp_batch_numbers *k = &dp_batch_write(b)->numbers;
    if (spec->format.bits > 24)
        return 0;
    const double top = (double)spec->format.code_max;
    const double span = isinf(spec->zfar) ? 1.0 : (spec->zfar - spec->znear) / spec->zfar;
    const double slope = span / (spec->znear * top);
    const double base = 1.0 / spec->zfar;
    for (int i = 0; i < DP_BATCH_TOPS; i++) {
        const double l = dp_batch_top(i);
        const float a = (float)(l * slope);
        const float c = (float)(l * base);
        if (fabs((double)a - l * slope) <= 0x1p-28 * l * slope && fabs((double)c - l * base) <= 0x1p-28 * l * base) {
            k->unit = (float)top;
            k->eye_top = (float)l;
            k->eye_slope = a;
            k->eye_base = c;
            return 1;
        }
    }
    return 0;
}

static int half_float(dp_batch *b) {
    return dp_format_is_ieee(&b->setup.spec.format, 10, 15);
}

static int single_float(dp_batch *b) {
    return dp_format_is_ieee(&b->setup.spec.format, 23, 127);
}

/* ---- Rows -------------------------------------------------------------------------------------------------------- */

enum { UNORM = DP_FORMAT_UNORM, FLOAT = DP_FORMAT_FLOAT, PERSPECTIVE = DP_CURVE_PERSPECTIVE, ANY = -1 };

typedef struct direct_row {
    int task, kind, curve, word, kernel; /* all of them between float and codes */
    int (*fits)(dp_batch *batch);
} direct_row;

static const direct_row direct_rows[] = {
    {DP_TASK_CODE, UNORM, PERSPECTIVE, DP_WORD_16, DP_KERNEL_STANDARD_16, quotient_standard},
    {DP_TASK_CODE, UNORM, PERSPECTIVE, DP_WORD_32, DP_KERNEL_STANDARD_32, quotient_standard},
    {DP_TASK_CODE, UNORM, PERSPECTIVE, DP_WORD_16, DP_KERNEL_REVERSED_16, quotient_reversed},
    {DP_TASK_CODE, UNORM, PERSPECTIVE, DP_WORD_32, DP_KERNEL_REVERSED_32, quotient_reversed},
    {DP_TASK_CODE, FLOAT, PERSPECTIVE, DP_WORD_32, DP_KERNEL_BINARY32_STANDARD, binary32_standard},
    {DP_TASK_CODE, FLOAT, PERSPECTIVE, DP_WORD_32, DP_KERNEL_BINARY32_REVERSED, binary32_reversed},
    {DP_TASK_EYE, UNORM, PERSPECTIVE, DP_WORD_16, DP_KERNEL_FAST_EYE_16, fast_eye},
    {DP_TASK_EYE, UNORM, PERSPECTIVE, DP_WORD_32, DP_KERNEL_FAST_EYE_32, fast_eye},
    {DP_TASK_ENCODE, UNORM, ANY, DP_WORD_16, DP_KERNEL_UNORM_OF_FLOAT_16, nearest_unorm},
    {DP_TASK_ENCODE, UNORM, ANY, DP_WORD_32, DP_KERNEL_UNORM_OF_FLOAT_32, nearest_unorm},
    {DP_TASK_ENCODE, UNORM, ANY, DP_WORD_32, DP_KERNEL_UNORM24_OF_FLOAT, nearest_unorm24},
    {DP_TASK_DECODE, UNORM, ANY, DP_WORD_16, DP_KERNEL_FLOAT_OF_UNORM_16, value_unorm},
    {DP_TASK_DECODE, UNORM, ANY, DP_WORD_32, DP_KERNEL_FLOAT_OF_UNORM_32, value_unorm},
    {DP_TASK_ENCODE, FLOAT, ANY, DP_WORD_16, DP_KERNEL_HALF_OF_FLOAT, half_float},
    {DP_TASK_DECODE, FLOAT, ANY, DP_WORD_16, DP_KERNEL_FLOAT_OF_HALF, half_float},
    {DP_TASK_ENCODE, FLOAT, ANY, DP_WORD_32, DP_KERNEL_BITS_OF_FLOAT, single_float},
    {DP_TASK_DECODE, FLOAT, ANY, DP_WORD_32, DP_KERNEL_FLOAT_OF_BITS, single_float},
};

/* [task][curve][kind]; ENCODE and DECODE have no curve. */
static const int general[DP_TASK_HI + 1][2][2] = {
    [DP_TASK_CODE] = {{DP_KERNEL_CODE_PERSPECTIVE_UNORM, DP_KERNEL_CODE_PERSPECTIVE_FLOAT},
                      {DP_KERNEL_CODE_LINEAR_UNORM, DP_KERNEL_CODE_LINEAR_FLOAT}},
    [DP_TASK_EYE] = {{DP_KERNEL_EYE_PERSPECTIVE_UNORM, DP_KERNEL_EYE_PERSPECTIVE_FLOAT},
                     {DP_KERNEL_EYE_LINEAR_UNORM, DP_KERNEL_EYE_LINEAR_FLOAT}},
    [DP_TASK_WIDTH] = {{DP_KERNEL_WIDTH_PERSPECTIVE_UNORM, DP_KERNEL_WIDTH_PERSPECTIVE_FLOAT},
                       {DP_KERNEL_WIDTH_LINEAR_UNORM, DP_KERNEL_WIDTH_LINEAR_FLOAT}},
    [DP_TASK_ENCODE] = {{DP_KERNEL_ENCODE_UNORM, DP_KERNEL_ENCODE_FLOAT},
                        {DP_KERNEL_ENCODE_UNORM, DP_KERNEL_ENCODE_FLOAT}},
    [DP_TASK_DECODE] = {{DP_KERNEL_DECODE_UNORM, DP_KERNEL_DECODE_FLOAT},
                        {DP_KERNEL_DECODE_UNORM, DP_KERNEL_DECODE_FLOAT}},
    [DP_TASK_LO] = {{DP_KERNEL_LO_PERSPECTIVE_UNORM, DP_KERNEL_LO_PERSPECTIVE_FLOAT},
                    {DP_KERNEL_LO_LINEAR_UNORM, DP_KERNEL_LO_LINEAR_FLOAT}},
    [DP_TASK_HI] = {{DP_KERNEL_HI_PERSPECTIVE_UNORM, DP_KERNEL_HI_PERSPECTIVE_FLOAT},
                    {DP_KERNEL_HI_LINEAR_UNORM, DP_KERNEL_HI_LINEAR_FLOAT}},
};

static int general_kernel(const dp_batch *b) {
    const dp_setup *s = &b->setup;
    const int by_format = b->task == DP_TASK_ENCODE || b->task == DP_TASK_DECODE;
    const int ends = b->task == DP_TASK_LO || b->task == DP_TASK_HI;
    if (b->task > DP_TASK_HI || (!by_format && s->curve == DP_CURVE_LOG))
        return DP_KERNEL_NONE;
    if (!by_format && s->ranged)
        return DP_KERNEL_NONE;
    if ((b->task == DP_TASK_EYE || ends) && s->spans_zero)
        return DP_KERNEL_NONE;
    if ((b->task == DP_TASK_CODE || b->task == DP_TASK_WIDTH || ends) && s->spec.model != DP_MODEL_EXACT)
        return DP_KERNEL_NONE;
    if (b->task == DP_TASK_DECODE && s->spec.format.kind == DP_FORMAT_UNORM && s->spec.format.bits > 24)
        return DP_KERNEL_DECODE_UNORM_WIDE;
    return general[b->task][by_format ? 0 : s->curve][s->spec.format.kind];
}

void dp_batch_plan(dp_batch *b, dp_batch_kernel *const *table) {
    plan_format(b);
    dp_batch_write(b)->doubt = 0;
    dp_batch_write(b)->direct = 0;
    dp_batch_write(b)->kept = NULL;
    dp_batch_write(b)->kernel = general_kernel(b);
    if (dp_batch_write(b)->kernel == DP_KERNEL_NONE)
        return;
    if (b->task == DP_TASK_CODE || b->task == DP_TASK_ENCODE)
        plan_code(b);
    else if (b->task != DP_TASK_DECODE)
        plan_depth(b);
    for (size_t i = 0; i < sizeof direct_rows / sizeof direct_rows[0] && b->real == DP_REAL_FLOAT; i++) {
        const direct_row *r = &direct_rows[i];
        if (r->task == (int)b->task && r->kind == (int)b->setup.spec.format.kind && r->word == (int)b->word &&
            (r->curve == ANY || r->curve == (int)b->setup.curve) && table[r->kernel] != NULL && r->fits(b)) {
            dp_batch_write(b)->kernel = r->kernel;
            dp_batch_write(b)->direct = 1;
            if (b->task != DP_TASK_CODE)
                dp_batch_write(b)->doubt = 0;
            return;
        }
    }
}
