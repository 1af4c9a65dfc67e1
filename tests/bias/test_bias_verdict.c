/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Verdicts on random biases, of every API, format and mapping, against a model of the hardware that is written here:
 * a binary32 depth, the bias of the API's specification added in binary32, and the code of the sum, by whole numbers.
 * What is said to be enough fails at no depth that is tried, at the ends of codes and of binades and anywhere; what is
 * said not to be fails where the witness lies.
 */
#include "bias/verdict.h"
#include "core/bits.h"
#include "printed.h"

enum { APIS = 11 };

/* ---- The hardware ------------------------------------------------------------------------------------------------ */

/* A code, or of a float the place of its value: depths a and b are stored apart, a nearer to 0, where code a < code b.
 */
static uint64_t code_of(const dp_format *format, dp_rounding rounding, double d) {
    int e;
    const uint64_t m = (uint64_t)ldexp(frexp(d, &e), 24); /* d = m 2^(e - 24) exactly: a binary32 number */
    e -= 24;
    if (d <= 0.0 || (format->kind == DP_FORMAT_UNORM && e < -90))
        return 0;
    if (format->kind == DP_FORMAT_UNORM) {
        const unsigned __int128 product = (unsigned __int128)m * format->code_max;
        const unsigned __int128 half = rounding == DP_ROUND_ZERO || e >= 0 ? 0 : (unsigned __int128)1 << (-e - 1);
        return e >= 0 ? (uint64_t)(product << e) : (uint64_t)((product + half) >> -e);
    }
    const int lowest = 1 - format->bias, top = e + 23 > lowest ? e + 23 : lowest;
    const double steps = ldexp(d, format->mantissa_bits - top); /* above 2^mantissa_bits where it is no subnormal */
    const double held = rounding == DP_ROUND_ZERO ? floor(steps) : nearbyint(steps);
    return dp_bits64(ldexp(held, top - format->mantissa_bits));
}

/* r, the worth of one unit, by the name of the API; `most`, the greatest depth of the polygon. */
static double unit_of(const char *api, const dp_format *format, double most, bool proof) {
    const bool real = format->kind == DP_FORMAT_FLOAT;
    int e;
    if (strcmp(api, "d3d9") == 0 || strcmp(api, "vulkan-float") == 0)
        return 1.0;
    if (real && strcmp(api, "vulkan-unorm") == 0)
        return ldexp(1.0, -format->mantissa_bits - 1);
    if (real) {
        (void)frexp(most, &e);
        if (!(most > 0.0) || e - 1 < 1 - format->bias)
            e = 2 - format->bias;
        return ldexp(1.0, e - 1 - format->mantissa_bits);
    }
    /* Where the implementation finds r it is a difference that no two depths lose. */
    if (proof && (strcmp(api, "vulkan") == 0 || strcmp(api, "gl") == 0 || strcmp(api, "three") == 0))
        return fmax(1.0 / (double)format->code_max, 0x1p-24) + 0x1p-24;
    if (strncmp(api, "vulkan", 6) == 0 || strcmp(api, "gl") == 0 || strcmp(api, "three") == 0)
        return ldexp(1.0, -format->bits);
    return (double)(float)(1.0 / (double)format->code_max);
}

static double offset_of(const bias_state *s, double r, double m) {
    const double o = (double)(float)((double)(float)s->units * r) + (double)(float)((double)(float)s->factor * m);
    const double clamp = (double)(float)s->clamp;
    return (double)(float)(clamp > 0.0 ? fmin(o, clamp) : clamp < 0.0 ? fmax(o, clamp) : o);
}

/* How far a layer is brought nearer by what the API takes: floats, or an integer, of which webgpu rounds nothing. */
static double brought(const dp_setup *setup, const bias_state *s, double slope, double z) {
    const double units = s->api->whole ? s->units : (double)(float)s->units;
    const bias_state taken = {s->api, units, (double)(float)s->factor, (double)(float)s->clamp};
    return -bias_at(setup, &taken, slope, z).shift;
}

/* Whether a layer sampled at `front` is stored nearer than one at `back`. */
static bool is_apart(const dp_setup *setup, const bias_state *s, double back, double front, double m, bool proof) {
    const dp_format *format = &setup->spec.format;
    const double r = unit_of(s->api->name, format, fmax(back, front), proof);
    const double sum = fmin(fmax((double)(float)(front + offset_of(s, r, m)), 0.0), 1.0);
    const uint64_t a = code_of(format, setup->spec.rounding, sum), b = code_of(format, setup->spec.rounding, back);
    return setup->reversed ? a > b : a < b;
}

/* ---- Random verdicts --------------------------------------------------------------------------------------------- */

typedef struct asked {
    dp_setup setup;
    bias_state state;
    bias_goal goal;
    double lo, hi;
} asked;

static const char *const formats[] = {"unorm16", "unorm24", "fp32", "unorm20", "fp16", "float5.20"};
enum { FORMATS = sizeof formats / sizeof formats[0] };

static bool draw_setup(rng *r, asked *a, int *format) {
    dp_spec spec = dp_spec_default();
    dp_format found[2];
    *format = (int)rng_below(r, FORMATS);
    assert_true(dp_format_parse(formats[*format], found) >= 1);
    spec.format = found[0];
    spec.znear = rng_log(r, 1e-3, 10.0);
    spec.zfar = rng_below(r, 8) == 0 ? (double)INFINITY : spec.znear * rng_log(r, 2.0, 1e6);
    spec.mapping = (dp_mapping)rng_below(r, DP_MAPPING_COUNT);
    spec.ortho = rng_below(r, 4) == 0;
    spec.rounding = rng_below(r, 4) == 0 ? DP_ROUND_ZERO : DP_ROUND_NEAREST;
    if (dp_setup_init(&a->setup, &spec) != DP_OK)
        return false;
    const double last = isinf(spec.zfar) ? 1e6 * spec.znear : spec.zfar;
    a->lo = rng_below(r, 3) == 0 ? spec.znear : rng_log(r, spec.znear, last);
    a->hi = rng_below(r, 3) == 0 ? last : rng_log(r, a->lo, last);
    return true;
}

/* About as many units as are needed, fewer, more, none, or with the wrong sign. */
static void draw_bias(rng *r, asked *a, size_t api) {
    const bias_api *row = bias_api_get(api);
    const double sign = bias_sign(&a->setup);
    double worst;
    a->goal = (bias_goal){.api = row};
    if (rng_below(r, 3) == 0)
        a->goal.slope = rng_log(r, 1e-6, 1.0) * a->lo;
    if (rng_below(r, 4) == 0)
        a->goal.gap = rng_log(r, 1e-6, 0.5) * a->lo;
    a->state = (bias_state){.api = row};
    if (rng_below(r, 2) == 0)
        a->state.factor = sign * rng_uniform(r, -0.5, 2.0);
    bias_goal needed = a->goal;
    needed.factor = sign * a->state.factor;
    double units = bias_needed_over(&a->setup, &needed, a->lo, a->hi, &worst);
    if (!isfinite(units) || rng_below(r, 4) == 0)
        units = rng_log(r, 0.5, 1e5) * (bias_unit_at(row, &a->setup.spec.format, 0.5).least == 1.0 ? 1e-7 : 1.0);
    units *= rng_below(r, 3) == 0 ? 1.0 : rng_log(r, 0.2, 3.0);
    if (row->whole)
        units = fmin(nearbyint(units), 0x1p30);
    a->state.units = rng_below(r, 20) == 0 ? 0.0 : units * (rng_below(r, 12) == 0 ? -sign : sign);
    if (row->clamps && rng_below(r, 5) == 0)
        a->state.clamp = sign * rng_log(r, 1e-8, 1e-1) * (rng_below(r, 5) == 0 ? -1.0 : 1.0);
}

static double held(double d) {
    return (double)(float)d;
}

/* The last binary32 number on its way away from the camera that has the code of d. */
static double end_of(const dp_setup *setup, double d) {
    const dp_format *format = &setup->spec.format;
    float least = 0.0F, most = 1.0F;
    if (setup->reversed)
        most = (float)d;
    else
        least = (float)d;
    const uint64_t code = code_of(format, setup->spec.rounding, d);
    for (uint32_t lo = dp_bits32(least), hi = dp_bits32(most);
         ;) { /* of either the numbers with the code are at d's end */
        if (hi - lo <= 1)
            return (double)dp_float32(setup->reversed ? hi : lo);
        const uint32_t middle = lo + (hi - lo) / 2;
        const bool same = code_of(format, setup->spec.rounding, (double)dp_float32(middle)) == code;
        *(same != (setup->reversed != 0) ? &lo : &hi) = middle;
    }
}

static double tried_depth(rng *r, const dp_setup *setup, double nearest, double farthest) {
    const double a = fmin(nearest, farthest), b = fmax(nearest, farthest);
    double d = rng_below(r, 2) == 0 || a == 0.0 ? rng_uniform(r, a, b) : rng_log(r, a, b);
    if (rng_below(r, 4) == 0)
        d = ldexp(1.0, (int)floor(log2(fmax(d, 0x1p-126)))) * (1.0 + 0x1p-23 * ((double)rng_below(r, 9) - 4.0));
    d = held(fmin(fmax(d, a), b));
    if (rng_below(r, 3) == 0)
        d = end_of(setup, d);
    d = (double)dp_ranked32(dp_rank32((float)d) + (uint32_t)rng_below(r, 3) - 1U);
    return fmin(fmax(d, a), b);
}

/* Enough: at depths of the range that is judged, whatever is drawn. */
static void check_enough(rng *r, const asked *a, const bias_verdict *v, tally *t) {
    const dp_setup *setup = &a->setup;
    const double nearest = held(dp_window(setup, v->lo)), farthest = held(dp_window(setup, v->hi));
    for (int i = 0; i < 200; i++) {
        const double d = tried_depth(r, setup, nearest, farthest);
        const double z = fmin(fmax(dp_eye(setup, d, 1.0 - d), v->lo), v->hi);
        const double m = bias_window_slope(setup, z, a->goal.slope);
        const double off = m * (rng_below(r, 2) == 0 ? 1.0 : rng_unit(r));
        const double front = held(d - bias_sign(setup) * off);
        const double move = brought(setup, &a->state, a->goal.slope, z);
        if (!(front >= 0.0 && front <= 1.0))
            continue;
        TALLY(t, is_apart(setup, &a->state, d, front, m, true) && move >= a->goal.gap * (1.0 - 1e-12),
              "%s %s %s ortho %d: units %.17g factor %g clamp %g slope %g gap %g, d %a front %a: said to be enough, %g",
              a->state.api->name, setup->spec.format.name, dp_mapping_get(setup->spec.mapping)->name, setup->spec.ortho,
              a->state.units, a->state.factor, a->state.clamp, a->goal.slope, a->goal.gap, d, front, move);
    }
}

/* Not enough: the witness fails, in this model too. Its depth is one of the few that are stored so and lie at its z, of
 * which a double beside the near plane tells but few. */
static void check_witness(const asked *a, const bias_verdict *v, tally *t) {
    const dp_setup *setup = &a->setup;
    const dp_format *format = &setup->spec.format;
    const double m = bias_window_slope(setup, v->z, a->goal.slope), value = dp_format_value(format, (uint32_t)v->code);
    const double about[3] = {held(dp_window(setup, v->z)), held(value), end_of(setup, held(value))};
    bool fails = v->short_of_gap && brought(setup, &a->state, a->goal.slope, v->z) < a->goal.gap;
    for (int i = 0; i < 27 && !fails; i++) {
        const double d = (double)dp_ranked32(dp_rank32((float)about[i / 9]) + (uint32_t)(i % 9 - 4));
        const double front = held(d - bias_sign(setup) * m), off = fabs(dp_eye(setup, d, 1.0 - d) - v->z);
        if (d >= 0.0 && d <= 1.0 && front >= 0.0 && front <= 1.0 && (i < 9 || off <= 1e-6 * fabs(v->z)) &&
            dp_format_encode(format, setup->spec.rounding, d) == (uint32_t)v->code)
            fails = !is_apart(setup, &a->state, d, front, m, false);
    }
    TALLY(t, fails && v->z >= a->lo && v->z <= a->hi,
          "%s %s %s: units %.17g factor %g clamp %g slope %g gap %g, z %a of %a to %a, codes %.0f and %.0f",
          a->state.api->name, format->name, dp_mapping_get(setup->spec.mapping)->name, a->state.units, a->state.factor,
          a->state.clamp, a->goal.slope, a->goal.gap, v->z, a->lo, a->hi, v->code, v->moved);
}

TEST(random_verdicts) {
    rng r = rng_make("bias verdicts");
    tally enough = {.name = "enough"}, witness = {.name = "not enough"};
    uint64_t answers[3] = {0}, by_api[APIS][3] = {{0}}, by_format[FORMATS] = {0}, by_mapping[DP_MAPPING_COUNT] = {0};
    const uint64_t count = test_cases(1500, 10000, 200000);
    for (uint64_t i = 0; i < count;) {
        asked a;
        int format;
        const size_t api = (size_t)rng_below(&r, APIS);
        if (!draw_setup(&r, &a, &format))
            continue;
        draw_bias(&r, &a, api);
        const bias_verdict v = bias_judge(&a.setup, &a.state, &a.goal, a.lo, a.hi);
        i++;
        /* r of an implementation may be more than is assumed of it, not less; and a colour target has no bias. */
        const bool skipped = a.state.api->guaranteed && format >= 4;
        if (v.answer == BIAS_ENOUGH && !skipped)
            check_enough(&r, &a, &v, &enough);
        else if (v.answer == BIAS_NOT_ENOUGH)
            check_witness(&a, &v, &witness);
        assert_true(v.answer == BIAS_NOT_ENOUGH || (isnan(v.z) && isnan(v.code) && isnan(v.moved)));
        answers[v.answer]++;
        by_api[api][v.answer]++;
        by_format[format]++;
        by_mapping[a.setup.spec.mapping]++;
    }
    for (size_t i = 0; i < APIS; i++)
        print_message("# %s: %llu enough, %llu not, %llu not proven\n", bias_api_get(i)->name,
                      (unsigned long long)by_api[i][BIAS_ENOUGH], (unsigned long long)by_api[i][BIAS_NOT_ENOUGH],
                      (unsigned long long)by_api[i][BIAS_NOT_PROVEN]);
    for (size_t i = 0; i < APIS; i++)
        assert_true(by_api[i][BIAS_ENOUGH] > 0 && by_api[i][BIAS_NOT_ENOUGH] > 0);
    for (size_t i = 0; i < FORMATS; i++)
        assert_true(by_format[i] > 0);
    for (size_t i = 0; i < DP_MAPPING_COUNT; i++)
        assert_true(by_mapping[i] > 0);
    assert_true(answers[BIAS_NOT_PROVEN] * 4 < count);
    assert_null(bias_api_get(APIS));
    tally_end(&enough);
    tally_end(&witness);
}

/* A bias that is told to be set is enough, of integers beyond 2^24 too, of which binary32 has only some. */
TEST(told_and_judged) {
    tally t = {.name = "told"};
    rng r = rng_make("bias told");
    dp_spec spec = dp_spec_default();
    uint64_t between = 0;
    spec.ortho = true;
    spec.mapping = DP_MAPPING_REVERSED;
    spec.znear = 1.0;
    spec.zfar = 100.0;
    for (int i = 0; i < 200; i++) {
        dp_setup setup;
        const bias_goal goal = {.api = bias_api_find("webgpu"), .gap = rng_uniform(&r, 0.1, 5.0)};
        const double z = spec.zfar - rng_log(&r, 1e-3, 0.1);
        assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
        const bias_state told = {.api = goal.api, .units = bias_needed(&setup, &goal, z)};
        TALLY(&t, !isfinite(told.units) || bias_judge(&setup, &told, &goal, z, z).answer == BIAS_ENOUGH,
              "%.0f units at %.17g for %.17g: not said to be enough", told.units, z, goal.gap);
        between += isfinite(told.units) && told.units != held(told.units);
    }
    assert_true(between >= 50);
    tally_end(&t);
}

/* The exit status is that of the strictest question, and of all set-ups; 1 with --check alone. */
TEST(checked) {
    static const char line[] = "bias --api gl -m gl -F d24 --viewport 1920x1080 --fov 90 --factor -1 --at 1,10";
    check_says(0, "Enough facing the camera, not", "%s --units -2", line);
    check_says(1, "Enough facing the camera, not", "%s --units -2 --check", line);
    check_says(0, "Enough facing the camera and at any slant\n", "%s --units -11 --check", line);
    check_says(0, "Not enough facing the camera, enough at the slope\n",
               "bias -F fp32 -m d3d --units 0 --factor -4 --slope 0.1 --range 1:2"); /* which moves by 0.4 there */
    check_says(1, "Enough facing the camera\n", "bias -F fp32 -m d3d,reversed --units -1 --check");
    check_says(0, "Enough facing the camera\n", "bias --api three --polygonOffsetUnits -1 --at 1 --check");
    check_says(1, "the clamp holds it", "bias --api d3d12 -m d3d -F d24 --DepthBias=-5 --DepthBiasClamp=-1e-8 --check");
    /* A polygon offset of a texel and a half at 10, as an angle: 1/z' = 1/z + o/0.1 (1 - 1e-4). */
    json_t *root = json_printed(0, "%s --units -16777216e-5", line);
    const double near = 0.1, z = number_at(root, "setups[0].push.z"), o = ldexp(-number_at(root, "units"), -24);
    const double to = 1 / (1 / z + o * (1 / near - 1 / 1000.0)), degrees = atan((z - to) / (2 * z / 1080)) * 180 / M_PI;
    assert_true(z == 10);
    assert_relative(number_at(root, "setups[0].push.shift"), z - to, 1e-9);
    assert_relative(number_at(root, "setups[0].push.degrees"), degrees, 1e-9);
    json_decref(root);
}

/* The words of engines are the same numbers as the options; what is no bias is answered with a sentence. */
TEST(words_of_engines) {
    static const char *const units[] = {"polygonOffsetUnits", "depthBias",  "depthBiasConstantFactor",
                                        "DepthBias",          "depth_bias", "zOffsetUnits"};
    static const char *const factors[] = {
        "polygonOffsetFactor", "depthBiasSlopeScale", "depthBiasSlopeFactor", "SlopeScaledDepthBias",
        "slopeDepthBias",      "slopeScale",          "slope_scale",          "zOffset"};
    static const char *const clamps[] = {"depthBiasClamp", "DepthBiasClamp"};
    static const char *const orders[] = {"sortPriority", "sortingOrder",   "renderOrder", "render_priority",
                                         "drawOrder",    "RENDERPRIORITY", "zIndex",      "alphaIndex"};
    static const char line[] = "bias -m gl -F d24 --at 1";
    enum { COUNT = 8 };
    for (size_t i = 0; i < COUNT; i++) {
        json_t *root = json_printed(0, "%s --%s=-3 --%s=-2 --%s=-0.5", line, units[i % 6], factors[i], clamps[i % 2]);
        assert_true(number_at(root, "units") == -3 && number_at(root, "factor") == -2);
        assert_true(number_at(root, "clamp") == -0.5);
        json_decref(root);
        check_says(2, "moves no depth", "%s --%s 3", line, orders[i]);
        check_says(2, "unknown option", "table --at 1 --%s 3", orders[i]);
    }
    check_says(2, "'--polygonOffset' is no option: it has two numbers", "%s --polygonOffset=-1,-2", line);
    check_says(2, "unknown option", "%s --sortPriorit 3", line);
    check_says(2, "unknown option", "%s --sort 3", line);
}
