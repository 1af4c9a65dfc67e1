/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Depth bias: the rule of each API, the conformance rows of WebGPU, the way into the scene and back, and whether as
 * many units as are said to be enough are enough for every binary32 depth.
 */
#include <float.h>

#include "bias/bias.h"
#include "bias/cmd_bias/call.h"
#include "cli/option/names.h"
#include "printed.h"
#include "support.h"

static dp_format format_of(const char *name) {
    dp_format found[2];
    assert_true(dp_format_parse(name, found) >= 1);
    return found[0];
}

static dp_setup setup_of(double znear, double zfar, dp_mapping mapping, const char *format) {
    dp_spec spec = dp_spec_default();
    dp_setup setup;
    spec.znear = znear;
    spec.zfar = zfar;
    spec.mapping = mapping;
    spec.format = format_of(format);
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    return setup;
}

static double held(double d) { /* as the hardware holds a depth */
    return (double)(float)d;
}

/* The window depth that a rasterizer stores: the sum in binary32, clamped. */
static double biased(double d, double o) {
    return fmin(fmax(held(d + o), 0.0), 1.0);
}

/* ---- The rules --------------------------------------------------------------------------------------------------- */

/* WebGPU conformance, depth_bias.spec.ts: a flat quad at 0.25, or one from 0 to 0.5 across one pixel. */
TEST(test_webgpu_rows) {
    static const struct {
        double d, most, m, units, factor, clamp, want;
    } rows[] = {
        {0.25, 0.25, 0.0, 8388608.0, 0.0, 0.0, 0.5},    {0.25, 0.25, 0.0, 8388608.0, 0.0, 0.125, 0.375},
        {0.25, 0.25, 0.0, -8388608.0, 0.0, 0.125, 0.0}, {0.25, 0.25, 0.0, -8388608.0, 0.0, -0.125, 0.125},
        {0.25, 0.5, 0.5, 0.0, 0.0, 0.0, 0.25},          {0.25, 0.5, 0.5, 0.0, 1.0, 0.0, 0.75},
        {0.25, 0.5, 0.5, 0.0, -0.5, 0.0, 0.0},
    };
    static const char *const apis[] = {"webgpu", "d3d11", "d3d12", "vulkan", "vulkan-exact", "gl", "metal"};
    const dp_format fp32 = format_of("depth32float");
    for (size_t a = 0; a < sizeof apis / sizeof apis[0]; a++)
        for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
            const bias_state s = {bias_api_find(apis[a]), rows[i].units, rows[i].factor, rows[i].clamp};
            const double o = bias_offset(&s, bias_unit_at(s.api, &fp32, rows[i].most).least, rows[i].m);
            assert_codes(dp_format_encode(&fp32, DP_ROUND_NEAREST, biased(rows[i].d, o)),
                         dp_format_encode(&fp32, DP_ROUND_NEAREST, rows[i].want));
        }
}

/* Its rows for depth24plus: drawn over a depth of 0.4 where greater, whichever format stands behind it. */
TEST(test_webgpu_depth24plus) {
    static const struct {
        double most, m, factor, clamp;
        int drawn;
    } rows[] = {{0.25, 0.0, 0.0, 0.0, 1}, {0.5, 0.5, 1.0, 0.0, 1}, {0.25, 0.0, 0.0, 0.1, 0}};
    dp_format both[2];
    assert_int_equal(dp_format_parse("depth24plus", both), 2);
    for (size_t f = 0; f < 2; f++)
        for (size_t i = 0; i < 3; i++) {
            const bias_state s = {bias_api_find("webgpu"), 0.25 * (1 << 25), rows[i].factor, rows[i].clamp};
            const double o = bias_offset(&s, bias_unit_at(s.api, &both[f], rows[i].most).least, rows[i].m);
            assert_int_equal(biased(0.25, o) > 0.4, rows[i].drawn);
        }
}

TEST(test_units) {
    static const struct {
        const char *api, *format;
        double d, least, most;
    } rows[] = {
        {"d3d11", "unorm24", 0.3, 0x1.000002p-24, 0x1.000002p-24}, /* 1/(2^24 - 1) lies just above a tie */
        {"webgpu", "unorm16", 0.3, 0x1.0001p-16, 0x1.0001p-16},
        {"metal", "unorm16", 0.3, 0x1.0001p-16, 0x1.0001p-16}, /* the smallest positive value */
        {"metal", "fp32", 0.3, 0x1p-25, 0x1p-25},
        {"vulkan", "unorm24", 0.3, 0x1p-24, 0x1p-23},
        {"vulkan-exact", "unorm24", 0.3, 0x1p-24, 0x1p-24},
        {"vulkan-unorm", "fp32", 0.3, 0x1p-24, 0x1p-24},
        {"vulkan-unorm", "unorm16", 0.3, 0x1p-16, 0x1p-16},
        {"vulkan-float", "fp32", 0.3, 1.0, 1.0},
        {"d3d9", "unorm16", 0.3, 1.0, 1.0},
        {"gl", "unorm16", 0.3, 0x1p-16, INFINITY},
        {"gl", "fp32", 1.0, 0x1p-23, 0x1p-22}, /* n or n + 1: specification and drivers differ */
        {"d3d11", "fp32", 0.5, 0x1p-24, 0x1p-24},
        {"d3d11", "fp32", 0x1.fffffep-2, 0x1p-25, 0x1p-25},
        {"d3d11", "fp32", 0x1.ffffffffp-2, 0x1p-24, 0x1p-24}, /* held as 0.5 */
        {"vulkan", "fp32", 0x1p-130, 0x1p-149, 0x1p-148},
        {"webgpu", "fp32", 0.0, 0x1p-149, 0x1p-149},
        {"vulkan", "fp16", 0.3, 0x1p-12, 0x1p-11},
        {"vulkan-exact", "fp32", 0.3, 0x1p-25, 0x1p-24},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const dp_format format = format_of(rows[i].format);
        const bias_unit unit = bias_unit_at(bias_api_find(rows[i].api), &format, rows[i].d);
        assert_ulp(unit.least, rows[i].least, 0.0);
        assert_true(unit.most == rows[i].most);
    }
}

TEST(test_names) {
    const dp_setup fp32 = setup_of(1e-7, 1e9, DP_MAPPING_REVERSED, "fp32"); /* more units than 2^24 */
    assert_true(bias_needed(&fp32, &(bias_goal){.api = bias_api_find("metal"), .gap = 4.9}, 5.0) > 0x1p24);
    for (size_t i = 0; bias_api_get(i) != NULL; i++) {
        const bias_api *row = bias_api_get(i);
        assert_true(bias_api_find(row->name) == row);
        assert_true(row->note[0] != '\0' && row->source[0] != '\0' && row->call[0] != '\0');
        for (int k = 0; k < 2; k++) {
            const double units = bias_needed(&fp32, &(bias_goal){.api = row, .gap = k == 0 ? 1.0 / 3 : 4.9}, 5.0);
            assert_true(row->whole || units == held(units));
        }
        char names[128];
        strcpy(names, row->aliases);
        for (char *name = strtok(names, " "); name != NULL; name = strtok(NULL, " "))
            assert_true(bias_api_find(name) == row);
    }
    assert_true(bias_api_find("Direct3D12") == bias_api_find("d3d12") &&
                bias_api_find("D3D10") == bias_api_find("d3d11"));
    assert_null(bias_api_find("metal2"));
    assert_null(bias_api_find(""));
    assert_null(bias_api_find("d3d1"));
}

TEST(test_clamp) {
    const bias_api *d3d11 = bias_api_find("d3d11");
    const bias_state up = {d3d11, 100.0, 2.0, 0x1p-20};
    const bias_state down = {d3d11, -100.0, -2.0, -0x1p-20};
    const bias_state other = {d3d11, -100.0, -2.0, 0x1p-20}; /* a positive clamp does not hold a negative bias */
    assert_true(bias_offset(&up, 0x1p-24, 0.5) == 0x1p-20);
    assert_true(bias_offset(&down, 0x1p-24, 0.5) == -0x1p-20);
    assert_true(bias_offset(&other, 0x1p-24, 0.5) < -1.0);
    /* All in binary32: the small term is lost beside the large one. */
    const bias_state lost = {d3d11, 1.0, 1.0, 0.0};
    const bias_state kept = {bias_api_find("webgpu"), 1.0, 1.0, 0.0};
    assert_true(bias_offset(&lost, 0x1p-24, 4.0) == 4.0);
    assert_true(bias_offset(&kept, 0x1p-24, 4.0) > 4.0);
}

/* ---- Into the scene ---------------------------------------------------------------------------------------------- */

enum { KINDS = 6 };

static dp_setup any_setup(rng *r, const char *format, double *lo, double *hi) {
    const dp_mapping mapping = (dp_mapping)rng_below(r, KINDS);
    const double znear = rng_log(r, 1e-3, 10.0);
    const int infinite = dp_mapping_get(mapping)->far_infinite && rng_below(r, 4) == 0;
    const double zfar = infinite ? INFINITY : znear * rng_log(r, 2.0, 1e6);
    *lo = znear;
    *hi = infinite ? znear * 1e6 : zfar;
    return setup_of(znear, zfar, mapping, format);
}

/* Where long double has 113 bits, __float128 has no name. */
#if LDBL_MANT_DIG >= 113
typedef long double quadruple;
#else
typedef __float128 quadruple;
#endif

/* z' - z in quadruple precision, from the definition of each curve; the logarithm to first and second order. */
static double shift_reference(const dp_setup *setup, double z, double o) {
    const quadruple n = setup->spec.znear;
    const quadruple f = setup->spec.zfar;
    const quadruple t = setup->reversed ? -(quadruple)o : (quadruple)o;
    switch (setup->spec.mapping) {
    case DP_MAPPING_LINEAR:
        return (double)(t * f);
    case DP_MAPPING_LOG: {
        const double top = log1p(setup->spec.zfar);
        return (1.0 + z) * expm1(o * top);
    }
    default:
        break;
    }
    const quadruple kappa = 1 / n - (isinf(setup->spec.zfar) ? 0 : 1 / f);
    return (double)(1 / (1 / (quadruple)z - t * kappa) - z);
}

TEST(test_shift) {
    rng r = rng_make("bias shift");
    tally t = {.name = "shift"};
    for (uint64_t i = 0; i < test_cases(2000, 100000, 1000000); i++) {
        double lo, hi;
        const dp_setup setup = any_setup(&r, rng_below(&r, 2) ? "unorm24" : "fp32", &lo, &hi);
        const bias_state s = {bias_api_find("vulkan-float"), 0.0, 0.0, 0.0};
        bias_state one = s;
        const double z = rng_log(&r, lo, hi);
        const double d = dp_window(&setup, z);
        one.units = rng_log(&r, 1e-12, 1e-3) * (rng_below(&r, 2) ? 1.0 : -1.0) * (setup.reversed ? d : 1.0 - d);
        const bias_effect e = bias_at(&setup, &one, 0.0, z);
        if (e.limited) {
            t.skipped++;
            continue;
        }
        const double want = shift_reference(&setup, z, one.units);
        TALLY(&t, fabs(e.shift - want) <= 1e-12 * fabs(want), "near %a far %a %s z %a o %a: %a, %a", setup.spec.znear,
              setup.spec.zfar, dp_mapping_get(setup.spec.mapping)->name, z, one.units, e.shift, want);
        TALLY(&t, (e.shift < 0.0) == (one.units * bias_sign(&setup) > 0.0), "sign at z %a", z);
        TALLY(&t, fabs(dp_window(&setup, e.to) - e.depth) <= 0x1p-44 * fmax(e.depth, 0x1p-6), "depth at z %a", z);
        TALLY(&t, e.code == dp_code(&setup, z), "code at z %a", z);
    }
    tally_end(&t);
}

/* The derivative of the window depth, against a difference quotient. */
TEST(test_slope) {
    rng r = rng_make("bias slope");
    tally t = {.name = "slope"};
    for (uint64_t i = 0; i < test_cases(1000, 20000, 100000); i++) {
        double lo, hi;
        const dp_setup setup = any_setup(&r, "fp32", &lo, &hi);
        const double z = rng_log(&r, lo, hi);
        const double m = bias_window_slope(&setup, z, 3.0);
        const double o = 1e-7 * m; /* three tenths of a millionth of a scene unit */
        const bias_state s = {bias_api_find("d3d9"), o, 0.0, 0.0};
        const double shift = bias_at(&setup, &s, 0.0, z).shift;
        if (bias_at(&setup, &s, 0.0, z).limited) {
            t.skipped++;
            continue;
        }
        TALLY(&t, fabs(fabs(shift) - 3e-7) <= 3e-7 * (1e-9 + 6e-7 / z), "z %a: %a", z, shift);
    }
    tally_end(&t);
}

TEST(test_limited) {
    const dp_setup d3d = setup_of(0.1, INFINITY, DP_MAPPING_D3D, "fp32");
    const dp_setup reversed = setup_of(0.1, 1000.0, DP_MAPPING_REVERSED, "unorm24");
    const bias_state plus = {bias_api_find("d3d9"), 0.5, 0.0, 0.0};
    const bias_state minus = {bias_api_find("d3d9"), -0.5, 0.0, 0.0};
    bias_effect e = bias_at(&d3d, &plus, 0.0, 100.0);
    assert_true(e.limited && isinf(e.to) && isinf(e.shift) && e.moved == d3d.spec.format.code_max);
    e = bias_at(&d3d, &minus, 0.0, 0.11);
    assert_true(e.limited && e.to == 0.1 && e.moved == 0);
    e = bias_at(&reversed, &plus, 0.0, 0.11);
    assert_true(e.limited && e.to == 0.1 && e.moved == 0xffffff);
    e = bias_at(&reversed, &minus, 0.0, 100.0);
    assert_true(e.limited && e.to == 1000.0 && e.moved == 0);
}

/* ---- How much is enough ------------------------------------------------------------------------------------------ */

/* d(z) = z - 1, or 2 - z. */
static dp_setup flat_setup(dp_mapping mapping, const char *format) {
    dp_setup setup = setup_of(1.0, 2.0, mapping, format);
    dp_spec spec = setup.spec;
    spec.ortho = 1;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    return setup;
}

static uint32_t stored(const dp_setup *setup, double d) {
    return dp_format_encode(&setup->spec.format, setup->spec.rounding, d);
}

/* One unit of r = code 1 is not always enough for an integer buffer: 0.5 and the next number store the same code. */
TEST(test_one_unit_can_fail) {
    static const char *const formats[] = {"unorm16", "unorm24"};
    const bias_api *api = bias_api_find("d3d11");
    for (size_t i = 0; i < 2; i++) {
        const dp_setup setup = setup_of(0.1, 1000.0, DP_MAPPING_REVERSED, formats[i]);
        const double r = bias_unit_at(api, &setup.spec.format, 0.5).least;
        const bias_goal goal = {.api = api};
        assert_codes(stored(&setup, biased(0.5, r)), stored(&setup, 0.5));
        assert_true(stored(&setup, biased(0.5, 2.0 * r)) > stored(&setup, 0.5));
        assert_true(bias_needed(&setup, &goal, dp_eye(&setup, 0.5, 0.5)) == 2.0);
    }
    const dp_setup setup = setup_of(0.1, 1000.0, DP_MAPPING_REVERSED, "fp32"); /* a binary32 step is a code */
    const bias_goal goal = {.api = api};
    double worst;
    assert_true(bias_needed_over(&setup, &goal, 0.1, 999.0, &worst) == 1.0);
    /* At d = 0 r is 2^-149, which is 0 where subnormal numbers are flushed: then nothing is added, however many. */
    assert_true(bias_unit_at(api, &setup.spec.format, 0.0).least == 0x1p-149);
    assert_true(isinf(bias_needed(&setup, &goal, 1000.0)) && isinf(bias_units(api, &setup.spec.format, 0.0, 0x1p-149)));
    assert_true(isinf(bias_needed_over(&setup, &goal, 0.1, 1000.0, &worst)) && worst == 1000.0);
}

/*
 * Two layers, up to one pixel apart where there is a slope: the one that the bias brings nearer is stored in front.
 * Depths are drawn anywhere, at powers of two and at rounding boundaries of the format.
 */
static double any_depth(rng *r, const dp_format *format) {
    switch (rng_below(r, 4)) {
    case 0:
        return held(rng_unit(r));
    case 1: /* about a power of two */
        return held(ldexp(1.0, -(int)rng_below(r, 20)) * (1.0 + 0x1p-23 * (rng_unit(r) - 0.5) * 8.0));
    case 2:
        return held(exp2(-rng_uniform(r, 0.0, 40.0)));
    default:
        return held(((double)rng_below(r, format->code_max) + 0.5) / (double)format->code_max);
    }
}

TEST(test_enough) {
    static const char *const formats[] = {"unorm16", "unorm24", "fp32", "fp16"};
    rng r = rng_make("bias enough");
    tally t = {.name = "told apart"};
    for (uint64_t i = 0; i < test_cases(20000, 1000000, 20000000); i++) {
        const int reversed = (int)rng_below(&r, 2);
        const char *format = formats[rng_below(&r, 4)];
        const dp_setup setup = setup_of(0.1, 1000.0, reversed ? DP_MAPPING_REVERSED : DP_MAPPING_D3D, format);
        bias_goal goal = {.api = bias_api_get(rng_below(&r, 11))};
        if (goal.api->guaranteed && setup.spec.format.kind == DP_FORMAT_UNORM) {
            t.skipped++; /* there r is what the implementation found to be enough */
            continue;
        }
        if (goal.api->guaranteed && strcmp(format, "fp16") == 0)
            continue;
        const double sign = bias_sign(&setup);
        const double drawn = fmin(any_depth(&r, &setup.spec.format), 1.0);
        const double z = dp_eye(&setup, drawn, 1.0 - drawn);
        const double d = held(dp_window(&setup, z)); /* beside the near plane a double holds few window depths */
        if (rng_below(&r, 2)) {
            goal.slope = rng_log(&r, 1e-9, 1.0) * z;
            goal.factor = (double)rng_below(&r, 5) / 4.0;
        }
        const double m = bias_window_slope(&setup, z, goal.slope);
        const double other =
            d - sign * m * (rng_below(&r, 2) ? 1.0 : rng_unit(&r)); /* the other sample of the same plane */
        const bias_state s = {goal.api, sign * bias_needed(&setup, &goal, z), sign * goal.factor, 0.0};
        const double unit = bias_unit_at(goal.api, &setup.spec.format, d).least;
        const double o = bias_offset(&s, unit, m);
        if (!(fmin(other, d) + fmin(o, 0.0) > 0.0 && fmax(other, d) + fmax(o, 0.0) < 1.0) || fabs(s.units) > 0x1p24) {
            t.skipped++;
            continue;
        }
        /* The layer brought nearer is sampled farther away, the other one at d: other lies behind d by at most m. */
        const double front = biased(held(other), o);
        const double back = held(d);
        const int ok =
            sign > 0.0 ? stored(&setup, front) > stored(&setup, back) : stored(&setup, front) < stored(&setup, back);
        TALLY(&t, ok, "%s %s %s d %a other %a m %a factor %g units %g", goal.api->name, format,
              reversed ? "reversed" : "d3d", d, other, m, goal.factor, s.units);
    }
    tally_end(&t);
}

/* The gap is reached at every depth of the range with as many units, and with one fewer it is not everywhere. */
TEST(test_gap) {
    rng r = rng_make("bias gap");
    tally t = {.name = "gap"};
    for (uint64_t i = 0; i < test_cases(200, 5000, 50000); i++) {
        double lo, hi, worst;
        const dp_setup setup = any_setup(&r, rng_below(&r, 2) ? "unorm24" : "fp32", &lo, &hi);
        bias_goal goal = {.api = bias_api_get(rng_below(&r, 11)), .gap = lo * rng_log(&r, 1e-4, 1.0)};
        lo += goal.gap;
        if (!(lo * 1.01 < hi))
            continue;
        const double from = rng_log(&r, lo, hi / 1.01);
        const double to = rng_log(&r, from * 1.005, hi);
        const double units = bias_needed_over(&setup, &goal, from, to, &worst);
        if (isinf(units)) {
            t.skipped++;
            continue;
        }
        TALLY(&t, worst >= from && worst <= to, "worst %a in [%a, %a]", worst, from, to);
        const bias_state s = {goal.api, units * bias_sign(&setup), 0.0, 0.0};
        double most = 0.0;
        for (int k = 0; k < 40; k++) {
            const double z = k == 0   ? from
                             : k == 1 ? to
                             : k == 2 ? fmin(worst * (1.0 + 2e-7), to)
                             : k == 3 ? fmax(worst * (1.0 - 2e-7), from)
                             : k == 4 ? worst
                                      : rng_log(&r, from, to);
            const bias_effect e = bias_at(&setup, &s, 0.0, fmin(fmax(z, from), to));
            TALLY(&t, -e.shift >= goal.gap || e.to <= setup.spec.znear, "%s %s z %a gap %a shift %a units %g",
                  goal.api->name, dp_mapping_get(setup.spec.mapping)->name, z, goal.gap, e.shift, units);
            TALLY(&t, bias_needed(&setup, &goal, e.z) <= units, "z %a needs more than the range", e.z);
            most = fmax(most, bias_needed(&setup, &goal, e.z));
        }
        TALLY(&t, most * (1.0 + 1e-5) + 1.0 >= units, "%s %s from %a to %a gap %a: %.9g, only %.9g needed",
              goal.api->name, dp_mapping_get(setup.spec.mapping)->name, from, to, goal.gap, units, most);
    }
    tally_end(&t);
}

/* Where a bias is enough it is at every depth, and just beyond the ends none is; a far plane has no unit at all. */
TEST(test_enough_over) {
    rng r = rng_make("bias enough over");
    tally t = {.name = "enough over"};
    uint64_t up_to = 0, onwards = 0;
    for (uint64_t i = 0; i < test_cases(300, 3000, 30000); i++) {
        double lo, hi, from, to;
        const dp_setup setup = any_setup(&r, rng_below(&r, 2) ? "unorm24" : "fp32", &lo, &hi);
        bias_goal goal = {.api = bias_api_get(rng_below(&r, 11)), .gap = rng_below(&r, 2) ? lo * 0.01 : 0};
        goal.slope = rng_below(&r, 2) ? rng_log(&r, 1e-4, 1e4) : 0;
        lo += goal.gap;
        if (!(lo * 1.01 < hi))
            continue;
        if (isinf(setup.spec.zfar) && rng_below(&r, 2))
            hi = INFINITY;
        bias_enough_over(&setup, &goal, INFINITY, lo, hi, &from, &to);
        if (isnan(from)) {
            t.skipped++;
            continue;
        }
        TALLY(&t, from >= lo && from <= to && to <= hi, "from %a to %a", from, to);
        for (int k = 0; k <= 20; k++) {
            const double share = isinf(to) ? 1e6 : to / from;
            const double z = k == 0 ? from : k == 20 ? to : fmin(from * pow(share, k / 20.0), to);
            TALLY(&t, isfinite(bias_needed(&setup, &goal, z)), "%s: none at %a of %a to %a", goal.api->name, z, from,
                  to);
        }
        if (to < hi)
            TALLY(&t, isinf(bias_needed(&setup, &goal, fmin(to * (1 + 0x1p-40), hi))), "%s: enough beyond %a of %a",
                  goal.api->name, to, hi);
        if (from > lo)
            TALLY(&t, isinf(bias_needed(&setup, &goal, fmax(from * (1 - 0x1p-40), lo))), "%s: enough before %a of %a",
                  goal.api->name, from, lo);
        TALLY(&t, from == lo || isinf(bias_needed(&setup, &goal, lo)), "%s: enough at %a, but from %a on",
              goal.api->name, lo, from);
        up_to += to < hi;
        onwards += from > lo;
    }
    TALLY(&t, up_to > 0 && onwards > 0, "%d, %d", (int)up_to, (int)onwards);
    tally_end(&t);
}

TEST(test_enough_by_hand) {
    /* Without a far plane a surface so steep has a bias only far off: a change of s n/z^2, for a unit of n/z 2^-23 or
     * half of that, at most 2^31 of them. */
    dp_spec open = dp_spec_default();
    dp_setup setup;
    double from, to;
    open.zfar = INFINITY;
    open.mapping = DP_MAPPING_REVERSED;
    open.format = format_of("fp32");
    assert_int_equal(dp_setup_init(&setup, &open), DP_OK);
    bias_enough_over(&setup, &(bias_goal){.api = bias_api_find("metal"), .slope = 1e4}, INFINITY, 0.1, INFINITY, &from,
                     &to);
    assert_true(from >= 1e4 / 256 && from <= 1e4 / 128 && to > 1e10);
    /* Orthographic depths below 0: the near plane has the depth 0, whose unit is nothing beside a slope. */
    dp_spec spec = dp_spec_default();
    spec.ortho = 1;
    spec.znear = -5.0;
    spec.zfar = 50.0;
    spec.format = format_of("fp32");
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    const bias_goal goal = {.api = bias_api_find("metal"), .slope = 0.01};
    bias_enough_over(&setup, &goal, INFINITY, -5.0, 50.0, &from, &to);
    assert_true(from > -5.0 && from < -4.99 && to == 50.0);
    assert_true(isfinite(bias_needed(&setup, &goal, from)) && isinf(bias_needed(&setup, &goal, from - 1e-9)));
}

/* The fewest units that store a layer sampled at `front` before one sampled at `back`, both real window depths. */
static double fewest(const dp_setup *setup, const bias_goal *goal, double back, double front, double m) {
    const double sign = bias_sign(setup), r = bias_unit_at(goal->api, &setup->spec.format, fmax(back, front)).least;
    for (double units = 0;; units++) {
        const bias_state s = {goal->api, sign * units, sign * goal->factor, 0.0};
        const uint32_t moved = stored(setup, biased(held(front), bias_offset(&s, r, m)));
        if (setup->reversed ? moved > stored(setup, held(back)) : moved < stored(setup, held(back)))
            return units;
    }
}

/*
 * Layers that are sampled a pixel apart, at every alignment of both samples to binary32 within a quarter of its step:
 * what is said to be needed is enough, and one unit fewer is not always, where a unit is about a step of the format.
 */
TEST(test_sampled_apart) {
    static const char *const formats[] = {"unorm24", "fp32"}, *const apis[] = {"d3d11", "vulkan-exact"};
    tally t = {.name = "sampled apart"};
    uint64_t tight = 0;
    for (int i = 0; i < 8; i++) {
        const dp_setup setup = flat_setup(i & 1 ? DP_MAPPING_REVERSED : DP_MAPPING_D3D, formats[i >> 1 & 1]);
        for (int eighths = 1; eighths <= 40; eighths++) { /* of a step of binary32 below 1 */
            const double m = eighths * 0x1p-27;
            const bias_goal goal = {.api = bias_api_find(apis[i >> 2]), .slope = m};
            double most = 0.0, needed = 0.0;
            for (int k = -64; k <= 64; k++) {
                const double d = 0.5 + k * 0x1p-27, front = d - bias_sign(&setup) * m;
                const double z = setup.reversed ? 2.0 - d : 1.0 + d;
                const double units = bias_needed(&setup, &goal, z), least = fewest(&setup, &goal, d, front, m);
                TALLY(&t, least <= units, "%s %s m %a d %a: %g units, %g needed", goal.api->name, formats[i >> 1 & 1],
                      m, d, units, least);
                most = fmax(most, least);
                needed = fmax(needed, units);
            }
            tight += most == needed;
        }
    }
    TALLY(&t, tight >= 20, "only %llu of 320 are tight", (unsigned long long)tight);
    tally_end(&t);
}

/*
 * Where every rounding goes the wrong way. A cell of unorm16 holds 256 binary32 numbers, or 257 where it lies just so;
 * the layer behind is rounded to the end of such a cell, the other one away from it, and so is the sum.
 */
TEST(test_longest_cells) {
    tally t = {.name = "longest cells"};
    for (int i = 0; i < 4; i++) {
        const int reversed = i & 1;
        const dp_setup setup = flat_setup(reversed ? DP_MAPPING_REVERSED : DP_MAPPING_D3D, "unorm16");
        const double u = 0x1p-24, m = (i & 2 ? 3.0 : 1.0) * u, sign = bias_sign(&setup);
        const bias_goal goal = {.api = bias_api_find("d3d9"), .slope = m};
        for (uint32_t code = 33000; code < 65000; code++) {
            const double middle = floor(dp_format_value(&setup.spec.format, code) / u) * u;
            double end = middle - sign * 127.0 * u; /* the last number of the cell away from the camera's side */
            while (stored(&setup, end - sign * u) == code)
                end -= sign * u;
            const double back = end - sign * u / 2.0, front = back - sign * m; /* halfway to the next cell's */
            if (held(back) != end || held(front) != end - sign * (m + u))
                continue; /* a tie to the other side */
            const double z = reversed ? 2.0 - back : 1.0 + back;
            const bias_state s = {goal.api, sign * bias_needed(&setup, &goal, z), 0.0, 0.0};
            const uint32_t moved = stored(&setup, biased(held(front), bias_offset(&s, 1.0, m)));
            TALLY(&t, reversed ? moved > code : moved < code, "%d code %u m %a: %a", reversed, code, m, s.units);
        }
    }
    assert_true(t.cases > 10000);
    tally_end(&t);
}

TEST(test_impossible) {
    const dp_setup setup = setup_of(1.0, 1000.0, DP_MAPPING_D3D, "unorm24");
    const bias_goal past = {.api = bias_api_find("d3d11"), .gap = 2.0};
    double worst;
    assert_true(isinf(bias_needed(&setup, &past, 2.5)));
    assert_true(isfinite(bias_needed(&setup, &past, 3.0)));
    assert_true(isinf(bias_needed_over(&setup, &past, 2.5, 100.0, &worst)));
    assert_true(worst == 2.5);
}

/* An orthographic bias is as long everywhere, on both sides of 0, and ends at a plane behind the camera. */
TEST(test_either_sign) {
    static const double places[] = {-99.0, -1.0, 0.0, 1.0, 400.0};
    const bias_state three = {.api = bias_api_find("d3d11"), .units = -3.0};
    const bias_goal goal = {.api = bias_api_find("d3d11"), .gap = 0.5};
    dp_spec spec = dp_spec_default();
    dp_setup setup;
    spec.ortho = 1;
    spec.znear = -100.0;
    spec.zfar = 500.0;
    spec.format = format_of("unorm16");
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    const double unit = (double)(float)(1.0 / 65535.0) * 600.0; /* r is code 1 in binary32 */
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++) {
        const bias_effect e = bias_at(&setup, &three, 0.0, places[i]);
        assert_relative(e.shift, -3.0 * unit, 1e-14);
        assert_scene(e.to, places[i] - 3.0 * unit, 1e-12);
        const double units = bias_needed(&setup, &goal, places[i]);
        assert_true(units * unit >= 0.5 && (units - 1.0) * unit < 0.5);
    }
    const bias_effect at_near = bias_at(&setup, &three, 0.0, -100.0);
    assert_true(at_near.limited && at_near.to == -100.0);
}

/* A bias is lost where the row says that the fragment shader writes depth; an orthographic depth is always
 * interpolated. */
TEST(is_lost_in_fragments) {
    int lost = 0;
    for (int i = 0; i < 2 * DP_MAPPING_COUNT; i++) {
        const dp_mapping_row *row = dp_mapping_get((dp_mapping)(i / 2));
        const bool written = i % 2 == 0 && strstr(row->effort, "the fragment shader writes depth") != NULL;
        printed p = print_of("bias --api d3d11 -m %s -F unorm24 --at 10%s", row->name, i % 2 == 0 ? "" : " --ortho");
        const bool said = strstr(p.out, "no API biases a depth that a fragment shader writes") != NULL;
        if (p.status == 0 ? said != written : i % 2 == 0)
            fail_msg("%s: %s%s", row->name, p.out, p.errors);
        lost += said;
        printed_free(&p);
    }
    assert_int_equal(lost, 5); /* linear, log, three.js twice, Cesium */
}

/* What a slope changes window depth by from a pixel to the next: the difference of two depths, in every mapping. */
TEST(slope_in_the_window) {
    rng r = rng_make("window slope");
    tally t = {.name = "slopes"};
    for (uint64_t n = test_cases(300, 3000, 100000); n > 0; n--) {
        dp_spec spec = dp_spec_default();
        dp_setup setup;
        spec.mapping = (dp_mapping)(n % DP_MAPPING_COUNT);
        spec.znear = rng_log(&r, 0.01, 20.0);
        spec.zfar = spec.znear * rng_log(&r, 3.0, 1e4);
        spec.log_c = rng_log(&r, 0.1, 10.0);
        spec.ortho = rng_below(&r, 4) == 0;
        if (dp_setup_init(&setup, &spec) != DP_OK)
            continue;
        const double z = rng_uniform(&r, 0.1, 0.9) * (spec.zfar - spec.znear) + spec.znear, step = 1e-4 * z;
        const double change = (dp_window(&setup, z + step) - dp_window(&setup, z - step)) / (2.0 * step);
        const double slope = rng_log(&r, 1e-3, 1.0), m = bias_window_slope(&setup, z, slope);
        TALLY(&t, fabs(m - fabs(change) * slope) <= 1e-5 * m, "%s near %g far %g at %g: %g, not %g",
              dp_mapping_get(spec.mapping)->name, spec.znear, spec.zfar, z, m, fabs(change) * slope);
    }
    tally_end(&t);
}
