/* SPDX-License-Identifier: MIT */
#include "core/boundary.h"

/* The next binary32 number, by its bits: nextafterf() is a call, and these are the steps of every search below. */
static float step_away(float x) {
    return dp_float32(dp_bits32(x) + 1);
}

static float step_to_zero(float x) {
    return dp_float32(dp_bits32(x) - 1);
}

static float next_up(float x) {
    return x < 0.0F ? step_to_zero(x) : step_away(x == 0.0F ? 0.0F : x);
}

static float next_down(float x) {
    return x > 0.0F ? step_to_zero(x) : -step_away(x == 0.0F ? 0.0F : -x);
}

static int ndc_signed(const dp_setup *setup) {
    return dp_mapping_get(setup->spec.mapping)->ndc_signed;
}

/* EncodeFloatRG: whole numbers of a rounded 255 w in one channel, and what is left, exactly, in the other. */
static uint32_t code_of_window(const dp_setup *setup, float w) {
    if (dp_format_is_rg(&setup->spec.format))
        return (uint32_t)(255.0 * (double)(255.0F * (w > 0.0F ? w : 0.0F)) + 0.5);
    return dp_format_encode(&setup->spec.format, setup->spec.rounding, (double)w);
}

static float window_of_ndc(const dp_setup *setup, float x) {
    return ndc_signed(setup) ? 0.5F * x + 0.5F : x;
}

uint32_t dp_staged_code(const dp_setup *setup, double d) {
    const float x = (float)(ndc_signed(setup) ? 2.0 * d - 1.0 : d);
    return code_of_window(setup, window_of_ndc(setup, x));
}

float dp_staged_window(const dp_setup *setup, uint32_t code) {
    const dp_point p = dp_point_below(&setup->spec.format, setup->spec.rounding, code);
    float w = (float)(p.num / p.den); /* within one step of the answer, because rounding is monotone */
    while (w > 0.0F && code_of_window(setup, w) >= code)
        w = next_down(w);
    while (code_of_window(setup, w) < code)
        w = next_up(w);
    return w;
}

float dp_staged_ndc(const dp_setup *setup, float window) {
    if (!ndc_signed(setup))
        return window;
    /* x/2 + 1/2 rounds to window or above from the midpoint below it upwards, give or take the tie and x's own step. */
    const double middle = 0.5 * ((double)next_down(window) + (double)window);
    float x = (float)(2.0 * middle - 1.0);
    while (window_of_ndc(setup, x) >= window)
        x = next_down(x);
    while (window_of_ndc(setup, x) < window)
        x = next_up(x);
    return x;
}

static dp_boundary staged_below(const dp_setup *setup, uint32_t code) {
    const float x = dp_staged_ndc(setup, dp_staged_window(setup, code));
    const float before = next_down(x);
    const double middle = 0.5 * ((double)before + (double)x);
    /* With signed NDC d = (1 + middle)/2. The sum is exact: |middle| is at least 2^-26 and has 25 significant bits. */
    dp_point point = ndc_signed(setup) ? (dp_point){1.0 + middle, 1.0 - middle, 2.0} : dp_point_make(middle, 1.0);
    return (dp_boundary){.point = point,
                         .ties_up = (dp_bits32(x) & 1U) == 0,
                         .below = code_of_window(setup, window_of_ndc(setup, before)),
                         .above = code_of_window(setup, window_of_ndc(setup, x))};
}

int dp_staged_is_exact(const dp_setup *setup) {
    return dp_format_is_ieee(&setup->spec.format, 23, 127) && !ndc_signed(setup) &&
           setup->spec.rounding != DP_ROUND_ZERO;
}

dp_boundary dp_boundary_below(const dp_setup *setup, uint32_t code) {
    const dp_spec *spec = &setup->spec;
    if (spec->model != DP_MODEL_EXACT)
        return staged_below(setup, code);
    return (dp_boundary){.point = dp_point_below(&spec->format, spec->rounding, code),
                         .ties_up = dp_ties_up(&spec->format, spec->rounding) || (code & 1U) == 0,
                         .below = code - 1,
                         .above = code};
}

static double step_at(double d) {
    return d < 0x1p-126 ? 0x1p-149 : dp_power2(dp_exponent(d) - 23);
}

int dp_staged_twice(const dp_setup *setup) {
    return ndc_signed(setup) || dp_format_is_rg(&setup->spec.format);
}

/* 255 d lies in the 8th binade above that of d, or in the one below it: a step over 255 is 256/255 of d's at most. */
double dp_staged_window_step(const dp_setup *setup, double d) {
    return dp_format_is_rg(&setup->spec.format) ? step_at(d) * (256.0 / 255.0) : step_at(d);
}

double dp_staged_ndc_step(const dp_setup *setup, double d) {
    return ndc_signed(setup) ? 0.5 * step_at(fabs(2.0 * d - 1.0)) : step_at(d);
}
