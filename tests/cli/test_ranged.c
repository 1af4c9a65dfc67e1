/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * --depth-range, in each command that takes it, by random viewports: codes and cells against exact fractions, what is
 * guaranteed and counted against a viewport's multiply and add written here, what is solved for and biased against the
 * formulas of one step. And who refuses it.
 */
#include "oracle.h"
#include "printed.h"

typedef struct viewport {
    dp_spec spec;
    char words[320]; /* the options that ask for it */
} viewport;

static const char *const mappings[] = {[DP_MAPPING_D3D] = "d3d",
                                       [DP_MAPPING_GL] = "gl",
                                       [DP_MAPPING_REVERSED] = "reversed",
                                       [DP_MAPPING_GL_REVERSED] = "gl-reversed"};

static bool is_signed(const dp_spec *s) {
    return s->mapping == DP_MAPPING_GL || s->mapping == DP_MAPPING_GL_REVERSED;
}

static bool is_turned(const dp_spec *s) {
    return s->mapping == DP_MAPPING_REVERSED || s->mapping == DP_MAPPING_GL_REVERSED;
}

/* Window depth falls with distance. */
static bool falls(const dp_spec *s) {
    return is_turned(s) != (s->depth_range[1] < s->depth_range[0]);
}

/* Ends that binary32 holds, so that words and numbers are the same. */
static viewport any_viewport(rng *r, const dp_format *formats, size_t count) {
    viewport v = {.spec = dp_spec_default()};
    dp_spec *s = &v.spec;
    s->mapping = (dp_mapping)rng_below(r, DP_MAPPING_GL_REVERSED + 1);
    s->format = formats[rng_below(r, count)];
    s->znear = rng_log(r, 0.01, 10);
    s->zfar = s->znear * rng_log(r, 10, 1e5);
    do {
        rng_range(r, s->depth_range);
        for (int i = 0; i < 2; i++)
            s->depth_range[i] = (double)(float)s->depth_range[i];
    } while (
        !(fabs(s->depth_range[1] - s->depth_range[0]) >= 2e-6 && fmin(s->depth_range[0], s->depth_range[1]) > 2e-6));
    snprintf(v.words, sizeof v.words, "-n %.17g -f %.17g -m %s -F %s --depth-range %.17g:%.17g", s->znear, s->zfar,
             mappings[s->mapping], s->format.name, s->depth_range[0], s->depth_range[1]);
    return v;
}

/* 1/z moves by this where window depth moves by 1. */
static double reciprocals_per_depth(const dp_spec *s) {
    return (1 / s->znear - 1 / s->zfar) / fabs(s->depth_range[1] - s->depth_range[0]);
}

/* ---- table ------------------------------------------------------------------------------------------------------- */

static void check_cell(const json_t *root, oracle *o, double z, const char *words, tally *t) {
    oracle_cell cell;
    mpq_t d;
    mpq_init(d);
    oracle_cell_init(&cell);
    oracle_window(o, d, z);
    const uint32_t code = oracle_code(o, z);
    oracle_cell_of(o, &cell, code);
    const double interval = oracle_double(cell.hi) - oracle_double(cell.lo);
    TALLY(t, number_at(root, "setups[0].rows[0].code") == code, "%s: code at %.17g", words, z);
    TALLY(t, oracle_relative(number_at(root, "setups[0].rows[0].depth"), d) <= 1e-14, "%s: depth at %.17g", words, z);
    TALLY(t, fabs(number_at(root, "setups[0].rows[0].interval") - interval) <= 1e-12 * interval + 1e-15 * z,
          "%s: interval at %.17g", words, z);
    TALLY(t,
          oracle_distance(number_at(root, "setups[0].rows[0].z_stored"), cell.stored) <= 1e-12 * interval + 1e-14 * z,
          "%s: stored at %.17g", words, z);
    oracle_cell_clear(&cell);
    mpq_clear(d);
}

/* The way back: window depths of both sides of an end, and between. */
static void check_back(const viewport *v, double share, oracle *o, tally *t) {
    const double *e = v->spec.depth_range, d = fmin(fmax(e[0] + (e[1] - e[0]) * share, 0), 1);
    mpq_t asked, z;
    mpq_inits(asked, z, NULL);
    mpq_set_d(asked, d);
    json_t *root = json_printed(0, "table %s --depth %.17g", v->words, d);
    const double got = number_at(root, "setups[0].rows[0].z");
    const double want = share <= 0                ? (is_turned(&v->spec) ? v->spec.zfar : v->spec.znear)
                        : share >= 1              ? (is_turned(&v->spec) ? v->spec.znear : v->spec.zfar)
                        : oracle_eye(o, z, asked) ? oracle_double(z)
                                                  : NAN;
    const double off = want * want * reciprocals_per_depth(&v->spec) * 0x1p-52;
    TALLY(t, fabs(got - want) <= 1e-14 * want + off, "%s: depth %.17g is at %.17g, should be %.17g", v->words, d, got,
          want);
    json_decref(root);
    mpq_clears(asked, z, NULL);
}

TEST(table) {
    const dp_format formats[] = {oracle_unorm(16), oracle_unorm(24), oracle_float(8, 23, 127)};
    rng r = rng_make("ranged table");
    tally t = {.name = "table --depth-range"};
    for (uint64_t i = test_cases(10, 60, 240); i > 0; i--) {
        const viewport v = any_viewport(&r, formats, 3);
        const double z = rng_log(&r, v.spec.znear * 1.001, v.spec.zfar * 0.999);
        oracle o;
        oracle_init(&o, &v.spec);
        json_t *root = json_printed(0, "table %s --at %.17g%s", v.words, z, i % 2 ? "" : " --tolerance 5%");
        check_cell(root, &o, z, v.words, &t);
        TALLY(&t,
              number_at(root, "setups[0].depth_range.lo") == v.spec.depth_range[0] &&
                  number_at(root, "setups[0].depth_range.hi") == v.spec.depth_range[1],
              "%s: the range is not said", v.words);
        json_decref(root);
        check_back(&v, rng_unit(&r), &o, &t);
        check_back(&v, rng_below(&r, 2) ? -1e-6 : 1 + 1e-6, &o, &t);
        oracle_clear(&o);
    }
    tally_end(&t);
}

/* The model staged, which a range has not, is not chosen. */
TEST(chosen) {
    json_t *root = json_printed(0, "table --depth-range 0:.1 -F fp32 -m d3d --model auto --at 10");
    assert_string_equal(text_at(root, "setups[0].auto.model"), "float");
    assert_null(node_at(root, "setups[0].auto.neglected.staged"));
    json_decref(root);
}

/* ---- Several ranges ---------------------------------------------------------------------------------------------- */

/* Of each code, whether some depth of the range is rounded to it. @return how many are */
static uint32_t mark_codes(const dp_spec *s, bool *is_code) {
    const dp_format *format = &s->format;
    const float one = (float)s->depth_range[0], other = (float)s->depth_range[1];
    const double lo = (double)fminf(one, other), hi = (double)fmaxf(one, other);
    uint32_t count = 0;
    mpq_t below, above, from, to;
    mpq_inits(below, above, from, to, NULL);
    mpq_set_d(from, lo);
    mpq_set_d(to, hi);
    for (uint32_t code = 0; code <= format->code_max; code++) {
        if (code > 0)
            oracle_boundary(below, format, DP_ROUND_NEAREST, code);
        if (code < format->code_max)
            oracle_boundary(above, format, DP_ROUND_NEAREST, code + 1);
        is_code[code] =
            ((code == 0 || mpq_cmp(below, to) < 0) && (code == format->code_max || mpq_cmp(above, from) > 0));
        is_code[code] = is_code[code] || code == oracle_encode(format, DP_ROUND_NEAREST, lo) ||
                        code == oracle_encode(format, DP_ROUND_NEAREST, hi);
        count += is_code[code];
    }
    mpq_clears(below, above, from, to, NULL);
    return count;
}

/* The depths of a range that are stored as codes from one to another. */
static void check_span(const dp_spec *s, uint32_t from, uint32_t to, const json_t *span, const char *words, tally *t) {
    oracle o;
    oracle_cell first, last;
    oracle_init(&o, s);
    oracle_cell_init(&first);
    oracle_cell_init(&last);
    oracle_cell_of(&o, &first, falls(s) ? to : from);
    oracle_cell_of(&o, &last, falls(s) ? from : to);
    const double lo = oracle_double(first.lo), hi = oracle_double(last.hi), per = reciprocals_per_depth(s) * 0x1p-50;
    TALLY(t, fabs(number_at(span, "z_lo") - lo) <= lo * (1e-12 + lo * per), "%s: from %.17g", words, lo);
    TALLY(t, fabs(number_at(span, "z_hi") - hi) <= hi * (1e-12 + hi * per), "%s: to %.17g", words, hi);
    TALLY(t, number_at(span, "lo") == s->depth_range[0] && number_at(span, "hi") == s->depth_range[1],
          "%s: the range is not said", words);
    oracle_cell_clear(&first);
    oracle_cell_clear(&last);
    oracle_clear(&o);
}

/* Another range, half of the time one that begins where the first ends. */
static viewport beside(const viewport *v, rng *r) {
    viewport other = *v;
    double *e = other.spec.depth_range;
    do {
        rng_range(r, e);
        if (rng_below(r, 2))
            e[0] = v->spec.depth_range[1];
        for (int i = 0; i < 2; i++)
            e[i] = (double)(float)e[i];
    } while (!(fabs(e[1] - e[0]) >= 2e-6 && fmin(e[0], e[1]) > 2e-6) ||
             memcmp(e, v->spec.depth_range, sizeof v->spec.depth_range) == 0);
    const size_t length = strlen(v->words);
    snprintf(other.words + length, sizeof other.words - length, ",%.17g:%.17g", e[0], e[1]);
    return other;
}

TEST(slices) {
    enum { CODES_MOST = 1 << 15 };
    static bool one[CODES_MOST], other[CODES_MOST];
    const dp_format formats[] = {oracle_unorm(10), oracle_unorm(13), oracle_float(5, 6, 15), oracle_float(4, 8, 7)};
    rng r = rng_make("slices");
    tally t = {.name = "codes of several depth ranges"};
    for (uint64_t i = test_cases(12, 80, 400); i > 0; i--) {
        const viewport v = any_viewport(&r, formats, 4), w = beside(&v, &r);
        const uint32_t counts[] = {mark_codes(&v.spec, one), mark_codes(&w.spec, other)};
        uint32_t both = 0, from = 0, to = 0;
        for (uint32_t code = 0; code <= v.spec.format.code_max; code++)
            if (one[code] && other[code]) {
                from = both++ == 0 ? code : from;
                to = code;
            }
        json_t *root = json_printed(0, "table %s", w.words);
        for (int k = 0; k < 2; k++)
            TALLY(&t, number_at(root, "setups[%d].worst.codes", k) == counts[k], "%s: %u codes of range %d", w.words,
                  counts[k], k);
        const json_t *pair = node_at(root, "shared[0]");
        TALLY(&t, (pair != NULL) == (both > 0), "%s: %u codes are shared", w.words, both);
        if (pair != NULL && both > 0) {
            TALLY(&t,
                  number_at(pair, "codes") == both && number_at(pair, "code_from") == from &&
                      number_at(pair, "code_to") == to,
                  "%s: %u codes from %u to %u are shared", w.words, both, from, to);
            check_span(&v.spec, from, to, node_at(pair, "first"), w.words, &t);
            check_span(&w.spec, from, to, node_at(pair, "second"), w.words, &t);
        }
        json_decref(root);
    }
    tally_end(&t);
}

/* In text, beside each other, each with what it keeps; and each alone as it is without the other. */
TEST(compared) {
    check_says(0, "unorm16 d3d 0:0.1          6555     10", "table --depth-range 0:.1,.1:1 -F d16 -m d3d");
    check_says(0, "fp16 d3d 0.1:1             3483   22.7", "table --depth-range 0:.1,.1:1 -F fp16 -m d3d");
    check_says(0, "code 6554 is stored for", "table --depth-range 0:.1,.1:1 -F d16 -m d3d");
    check_says(0, "6554 codes, 6554 to 13107,", "table --depth-range 0:.2,.1:1 -F d16 -m d3d");
    check_says(0, "No two of these ranges share a code", "table --depth-range 0:.1,.2:1 -F d16 -m d3d");
    check_says(0, "unorm16 d3d 1:0", "table --depth-range 1:0,0:1 -F d16 -m d3d");
    static const struct {
        const char *ranges, *others;
    } more[] = {{"0:.5,.1:.6,.2:.7,.3:.8", "2 other pairs of ranges share codes: --json has them."},
                {"0:.5,.1:.6,.2:.7,.3:.8,.4:.9", "6 other pairs of ranges share codes: --json has them."},
                {"0:.5,.1:.6,.2:.7,.55:.8", "1 other pair of ranges shares codes: --json has it."},
                {"0:.5,.1:.6,.2:.7", NULL},
                {"0:.5,.1:.6,.2:.7,.65:.8", NULL}};
    for (size_t i = 0; i < sizeof more / sizeof more[0]; i++) {
        json_t *root = json_printed(0, "table --depth-range %s -F d16 -m d3d", more[i].ranges);
        const size_t pairs = json_array_size(node_at(root, "shared"));
        assert_int_equal(pairs, more[i].others != NULL ? 4 + atoi(more[i].others) : 3 + (int)(i == 4));
        check_says(0, more[i].others != NULL ? more[i].others : "!other pair", "table --depth-range %s -F d16 -m d3d",
                   more[i].ranges);
        json_decref(root);
    }
    json_t *both = json_printed(0, "table --depth-range 0:.1,.1:1 -F d16 -m d3d,reversed --at 5");
    for (int i = 0; i < 4; i++) {
        json_t *alone = json_printed(0, "table --depth-range %s -F d16 -m %s --at 5", i % 2 == 0 ? "0:.1" : ".1:1",
                                     i < 2 ? "d3d" : "reversed");
        assert_true(json_equal(node_at(both, "setups[%d]", i), node_at(alone, "setups[0]")));
        json_decref(alone);
    }
    assert_string_equal(text_at(both, "shared[1].mapping"), "reversed");
    assert_null(node_at(both, "shared[2]"));
    json_decref(both);
    printed text = print_of("table --depth-range 0:.1,.1:1 -F d16 -m d3d --at 5 --csv");
    assert_non_null(strstr(text.out, ",depth_range_lo,depth_range_hi,"));
    assert_non_null(strstr(text.out, ",0.1,1,5,"));
    printed_free(&text);
}

/* ---- The guarantee ----------------------------------------------------------------------------------------------- */

/* The matrix in binary32 and the viewport's factor and offset. */
typedef struct machine {
    const dp_spec *spec;
    float a, b, scale, offset;
} machine;

static machine machine_of(const dp_spec *s) {
    const long double n = s->znear, f = s->zfar, sign = is_turned(s) ? -1 : 1;
    const double lo = s->depth_range[0], hi = s->depth_range[1];
    machine m = {.spec = s};
    if (is_signed(s)) {
        m.a = (float)(sign * (f + n) / (f - n));
        m.b = (float)(-sign * 2 * n * f / (f - n));
        m.scale = (float)(0.5 * (hi - lo));
        m.offset = (float)(0.5 * (lo + hi));
    } else {
        m.a = (float)(is_turned(s) ? n / (n - f) : f / (f - n));
        m.b = (float)(-sign * n * f / (f - n));
        m.scale = (float)(hi - lo);
        m.offset = (float)lo;
    }
    return m;
}

static uint32_t machine_code(const machine *m, float z) {
    const float product = m->a * z, clip = product + m->b, ndc = clip / z, moved = m->scale * ndc;
    return oracle_encode(&m->spec->format, DP_ROUND_NEAREST, (double)(moved + m->offset));
}

/* The codes of two depths, the nearer first, are apart and in their order. */
static bool told_apart(const machine *m, float nearer, float farther) {
    const uint32_t one = machine_code(m, nearer), other = machine_code(m, farther);
    return falls(m->spec) ? one > other : one < other;
}

TEST(guarantee) {
    const dp_format formats[] = {oracle_unorm(16), oracle_unorm(24), oracle_float(8, 23, 127), oracle_float(5, 10, 15)};
    rng r = rng_make("ranged guarantee");
    tally t = {.name = "what table guarantees in a depth range"}, codes = {.name = "codes of a viewport"};
    for (uint64_t i = test_cases(20, 150, 1000); i > 0; i--) {
        const viewport v = any_viewport(&r, formats, 4);
        const machine m = machine_of(&v.spec);
        const float z = (float)rng_log(&r, v.spec.znear * 1.001, v.spec.zfar * 0.9);
        json_t *root = json_printed(0, "table %s --model float --at %.9g", v.words, (double)z);
        const double apart = number_at(root, "setups[0].rows[0].guaranteed");
        TALLY(&codes, number_at(root, "setups[0].rows[0].code") == machine_code(&m, z), "%s: code at %.9g", v.words,
              (double)z);
        json_decref(root);
        for (int k = 0; k < 200; k++) {
            const double behind = (double)z + apart * (k == 0 ? 1 : rng_uniform(&r, 1, 1.5));
            const float other = nextafterf((float)behind, HUGE_VALF);
            if (behind < v.spec.zfar)
                TALLY(&t, told_apart(&m, z, other), "%s: %.9g and %.9g, %g apart", v.words, (double)z, (double)other,
                      apart);
        }
    }
    tally_end(&t);
    tally_end(&codes);
}

/* Every neighbour of some thousand depths. */
TEST(zfight) {
    const dp_format formats[] = {oracle_unorm(24), oracle_float(8, 23, 127)};
    rng r = rng_make("ranged zfight");
    tally t = {.name = "zfight --depth-range"};
    for (uint64_t i = test_cases(5, 25, 100); i > 0; i--) {
        const viewport v = any_viewport(&r, formats, 2);
        const machine m = machine_of(&v.spec);
        const float lo = (float)rng_log(&r, v.spec.znear * 1.01, v.spec.zfar * 0.9), hi = lo * 1.0005F;
        uint32_t ties = 0, swaps = 0;
        for (float z = lo; z < hi; z = nextafterf(z, HUGE_VALF)) {
            const float next = nextafterf(z, HUGE_VALF);
            ties += machine_code(&m, z) == machine_code(&m, next);
            swaps += machine_code(&m, z) != machine_code(&m, next) && !told_apart(&m, z, next);
        }
        json_t *root = json_printed(0, "zfight %s --range %.17g:%.17g", v.words, (double)lo, (double)hi);
        TALLY(&t, number_at(root, "setups[0].ties") == ties && number_at(root, "setups[0].swaps") == swaps,
              "%s from %.9g: %g and %g, should be %u and %u", v.words, (double)lo, number_at(root, "setups[0].ties"),
              number_at(root, "setups[0].swaps"), ties, swaps);
        TALLY(&t, number_at(root, "setups[0].used") <= 1, "%s: the guarantee is broken", v.words);
        json_decref(root);
    }
    tally_end(&t);
}

/* Pairs of slanted planes, drawn: none at what is guaranteed is wrong, and it is what table says at that slant. */
TEST(rasterized) {
    static const char *const rasters[] = {"llvmpipe", "lavapipe", "swiftshader"};
    dp_format formats[3];
    rng r = rng_make("ranged rasterize");
    assert_int_equal(dp_format_parse("unorm16", &formats[0]) + dp_format_parse("fp32", &formats[1]), 2);
    tally t = {.name = "zfight --rasterize --depth-range"};
    for (uint64_t i = test_cases(4, 20, 80); i > 0; i--) {
        const viewport v = any_viewport(&r, formats, 2);
        const char *raster = rasters[rng_below(&r, 3)];
        const double lo = rng_log(&r, v.spec.znear * 1.1, v.spec.znear * 4);
        json_t *root = json_printed(0, "zfight %s --rasterize --raster %s --range %.17g:%.17g --sample 20", v.words,
                                    raster, lo, 2 * lo);
        const double used = number_at(root, "setups[0].used"), z = number_at(root, "setups[0].z"),
                     slant = number_at(root, "setups[0].slant"), bound = number_at(root, "setups[0].bound");
        json_decref(root);
        TALLY(&t, isnan(used) || (used > 0 && used <= 1), "%s, %s: %g of the guarantee", v.words, raster, used);
        if (isnan(used))
            continue;
        root =
            json_printed(0, "table %s --model float%s --viewport 1920x1080 --raster %s --slant %.17g:%.17g --at %.17g",
                         v.words, is_signed(&v.spec) ? " --arith mesa-remap" : "", raster, slant, slant, z);
        const double said = number_at(root, "setups[0].rows[0].guarantee_slanted");
        TALLY(&t, fabs(said - bound) <= 1e-6 * bound, "%s, %s: %g is guaranteed at %g, %g drawn", v.words, raster, said,
              z, bound);
        json_decref(root);
    }
    tally_end(&t);
}

/* A wall and a decal: pixels are wrong nearer than is guaranteed, and none is wrong there. */
TEST(fight) {
    rng r = rng_make("ranged fight");
    tally t = {.name = "plot fight --depth-range"};
    for (uint64_t i = test_cases(2, 8, 30); i > 0; i--) {
        viewport v;
        dp_format formats[3];
        assert_int_equal(dp_format_parse("unorm24", &formats[0]), 1);
        do
            v = any_viewport(&r, formats, 1);
        while (fabs(v.spec.depth_range[1] - v.spec.depth_range[0]) < 0.01);
        const double at = v.spec.znear * 5;
        json_t *root = json_printed(0, "plot fight %s --at %.17g --raster llvmpipe --json", v.words, at);
        const char *near_one = text_at(root, "panels[0].title"), *far_one = text_at(root, "panels[1].title");
        TALLY(&t, strstr(near_one, " 0 % wrong") == NULL && strstr(far_one, "the guarantee: 0 % wrong") != NULL,
              "%s: %s; %s", v.words, near_one, far_one);
        TALLY(&t, strstr(text_at(root, "subtitle"), "depth range") != NULL, "%s: the range is not said", v.words);
        json_decref(root);
    }
    tally_end(&t);
}

/* ---- solve and check: one step of an integer buffer moves 1/z by as much everywhere -------------------------------
 */

static double step_of(const dp_spec *s) {
    return reciprocals_per_depth(s) / (double)s->format.code_max;
}

/* The near plane that makes surfaces so far apart at z one step apart. */
static double near_for(const dp_spec *s, double z, double apart) {
    const double span = fabs(s->depth_range[1] - s->depth_range[0]);
    return 1 / (apart / z / (z + apart) * span * (double)s->format.code_max + 1 / s->zfar);
}

TEST(solved) {
    const dp_format formats[] = {oracle_unorm(16), oracle_unorm(24)};
    rng r = rng_make("ranged solve");
    tally t = {.name = "solve --depth-range"};
    for (uint64_t i = test_cases(10, 60, 200); i > 0; i--) {
        const viewport v = any_viewport(&r, formats, 2);
        const dp_spec *s = &v.spec;
        const double z = rng_log(&r, s->znear * 1.1, s->zfar / 1.1), left = 1 / z - step_of(s), apart = 1 / left - z;
        if (!(left > 1 / s->zfar))
            continue;
        json_t *root = json_printed(0, "solve --for distance %s --separation %.17g --model exact", v.words, apart);
        const double distance = number_at(root, "answer.distance");
        TALLY(&t, fabs(distance - z) <= 1e-9 * z, "%s: %.17g holds up to %.17g, should be %.17g", v.words, apart,
              distance, z);
        json_decref(root);
        const double least = near_for(s, z, apart);
        char words[256];
        snprintf(words, sizeof words, "%s", strstr(v.words, "-f "));
        root = json_printed(0, "solve --for near %s --separation %.17g --at %.17g --model exact", words, apart, z);
        TALLY(&t, fabs(number_at(root, "answer.near") - least) <= 1e-9 * least, "%s: near %.17g, should be %.17g",
              words, number_at(root, "answer.near"), least);
        json_decref(root);
    }
    tally_end(&t);
}

TEST(checked) {
    const dp_format formats[] = {oracle_unorm(16), oracle_unorm(24)};
    rng r = rng_make("ranged check");
    tally t = {.name = "check of depth ranges"};
    for (uint64_t i = test_cases(6, 30, 100); i > 0; i--) {
        const viewport v = any_viewport(&r, formats, 2);
        const dp_spec *s = &v.spec;
        const double z = rng_log(&r, s->znear * 1.1, s->zfar / 1.1), left = 1 / z - step_of(s), apart = 1 / left - z;
        if (!(left > 1 / s->zfar))
            continue;
        for (int passes = 0; passes < 2; passes++) {
            const char *path =
                scratch_text("ranged.need",
                             "cameras = { c = { near = %.17g; far = %.17g; mapping = \"%s\"; format = \"%s\"; "
                             "depth_range = (%.17g, %.17g); model = \"exact\"; }; };\n"
                             "requirements = { r = { camera = \"c\"; separation = %.17g; at = %.17g; }; };\n",
                             s->znear, s->zfar, mappings[s->mapping], s->format.name, s->depth_range[0],
                             s->depth_range[1], apart * (passes ? 1 + 1e-6 : 1 - 1e-6), z);
            printed p = print_of("check %s", path);
            TALLY(&t, p.status == !passes, "%s: check %g at %g gave %d: %s", v.words, apart, z, p.status, p.errors);
            printed_free(&p);
        }
    }
    tally_end(&t);
}

/* ---- texture ------------------------------------------------------------------------------------------------------
 */

enum { SIDE = 8, PIXELS = SIDE * SIDE };

/* A PGM of codes of 16 bits. */
static const char *image_of(const uint32_t codes[PIXELS]) {
    const char *path = scratch_file("ranged.pgm");
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    fprintf(file, "P5 %d %d 65535\n", SIDE, SIDE);
    for (int i = 0; i < PIXELS; i++) {
        fputc((int)(codes[i] >> 8), file);
        fputc((int)(codes[i] & 255), file);
    }
    assert_int_equal(fclose(file), 0);
    return path;
}

/* LinearEyeDepth of a depth from 0 to 1 by constants in binary32, as Unity has them. */
static double linear_eye(const dp_spec *s, float d) {
    const long double n = s->znear, f = s->zfar;
    const float z = (float)(is_turned(s) ? 1 / n - 1 / f : 1 / f - 1 / n), w = (float)(is_turned(s) ? 1 / f : 1 / n);
    const float sum = z * d + w;
    return (double)(1 / sum);
}

/* The eye depth of a binary32 window depth; beyond an end that plane's. */
static double eye_of(const dp_spec *s, float d) {
    const long double lo = s->depth_range[0], q = ((long double)d - lo) / (s->depth_range[1] - lo);
    const long double share = fminl(fmaxl(is_turned(s) ? 1 - q : q, 0), 1);
    return (double)(1 / ((1 - share) / s->znear + share / s->zfar));
}

/* The largest relative error of that, of depths as they are or brought to 0 to 1 first. */
static double decoded_off(const dp_spec *s, const double *z, const uint32_t *codes, bool undone) {
    const float lo = (float)s->depth_range[0], span = (float)s->depth_range[1] - lo;
    double most = 0;
    for (int i = 0; i < PIXELS; i++) {
        const float d = (float)((double)codes[i] / 65535), moved = d - lo;
        const double want = eye_of(s, d);
        if (!isnan(z[i]))
            most = fmax(most, fabs(linear_eye(s, undone ? moved / span : d) - want) / want);
    }
    return most;
}

static double named_error(const json_t *root, const char *name) {
    size_t i = 0;
    while (node_at(root, "errors[%zu]", i) != NULL && strcmp(text_at(root, "errors[%zu].name", i), name) != 0)
        i++;
    return number_at(root, "errors[%zu].max", i);
}

static void check_pixels(const viewport *v, const char *path, const uint32_t *codes, double *z, double *reach,
                         oracle *o, tally *t) {
    oracle_cell cell;
    oracle_cell_init(&cell);
    const uint32_t first = oracle_code(o, v->spec.znear), last = oracle_code(o, v->spec.zfar);
    for (int i = 0; i < PIXELS; i += 1) {
        oracle_cell_of(o, &cell, codes[i]);
        z[i] = (falls(&v->spec) ? codes[i] > first : codes[i] < first) ? NAN : oracle_double(cell.stored);
        if (!isnan(z[i]) && codes[i] != last)
            *reach = fmax(*reach, fmax(oracle_double(cell.hi) - z[i], z[i] - oracle_double(cell.lo)));
        if (i % 9 != 0)
            continue;
        json_t *root = json_printed(0, "texture %s %s --sky 0 --pixel %d,%d", path, v->words, i % SIDE, i / SIDE);
        const char *state = text_at(root, "pixels[0].state");
        const double got = number_at(root, "pixels[0].z");
        TALLY(t, strcmp(state, isnan(z[i]) ? "hole" : "depth") == 0 || codes[i] == last, "%s: code %u is a %s",
              v->words, codes[i], state);
        TALLY(t, (isnan(got) && isnan(z[i])) || fabs(got - z[i]) <= 1e-12 * z[i],
              "%s: code %u at %.17g, should be %.17g", v->words, codes[i], got, z[i]);
        if (!isnan(z[i]))
            TALLY(t,
                  oracle_distance(number_at(root, "pixels[0].lo"), cell.lo) <= 1e-12 * z[i] &&
                      oracle_distance(number_at(root, "pixels[0].hi"), cell.hi) <= 1e-12 * z[i],
                  "%s: code %u may be %.17g to %.17g", v->words, codes[i], number_at(root, "pixels[0].lo"),
                  number_at(root, "pixels[0].hi"));
        json_decref(root);
    }
    oracle_cell_clear(&cell);
}

/* Pixels of the range, and of a layer before it, which are holes here; and what a shader makes of them. */
TEST(texture) {
    const dp_format formats[] = {oracle_unorm(16)};
    rng r = rng_make("ranged texture");
    tally t = {.name = "texture --depth-range"};
    for (uint64_t i = test_cases(3, 15, 60); i > 0; i--) {
        viewport v = any_viewport(&r, formats, 1);
        while (fabs(v.spec.depth_range[1] - v.spec.depth_range[0]) < 1e-3) /* few codes look like those of fewer bits */
            v = any_viewport(&r, formats, 1);
        uint32_t codes[PIXELS];
        double z[PIXELS], reach = 0;
        oracle o;
        oracle_init(&o, &v.spec);
        for (int k = 0; k < PIXELS; k++)
            codes[k] = oracle_code(&o, rng_log(&r, v.spec.znear, v.spec.zfar * 0.99));
        codes[9] = falls(&v.spec) ? 65535 : 0;
        const char *path = image_of(codes);
        check_pixels(&v, path, codes, z, &reach, &o, &t);
        check_says(0, "recognised", "texture %s %s", path, v.words);
        check_says(0, "!direction", "texture %s %s", path, v.words);
        check_says(0, "!likely", "texture %s %s", path, v.words);
        json_t *root = json_printed(0, "texture %s %s --sky 0", path, v.words);
        const double bound = named_error(root, "eye depth");
        TALLY(&t, bound >= reach * (1 - 1e-12) && bound <= reach * 1.0001 + v.spec.zfar * 0x1p-22,
              "%s: off by %g, said %g", v.words, reach, bound);
        for (int k = 0; k < PIXELS; k++)
            z[k] = codes[k] == oracle_code(&o, v.spec.zfar) ? NAN : z[k];
        const double raw = decoded_off(&v.spec, z, codes, false), undone = decoded_off(&v.spec, z, codes, true);
        TALLY(&t, isinf(raw) || fabs(named_error(root, "decode linear-eye") - raw) <= 1e-6 * raw + 1e-12,
              "%s: %g, should be %g", v.words, named_error(root, "decode linear-eye"), raw);
        TALLY(&t, isinf(undone) || fabs(named_error(root, "undone linear-eye") - undone) <= 1e-6 * undone + 1e-12,
              "%s: undone %g, should be %g", v.words, named_error(root, "undone linear-eye"), undone);
        json_decref(root);
        oracle_clear(&o);
    }
    tally_end(&t);
}

/* ---- plot -------------------------------------------------------------------------------------------------------- */

/* Every code of four bits that the range keeps, at the depth that it is read as: that of its window depth, or a plane.
 */
TEST(staircase) {
    static const double ranges[][2] = {{0.25, 1}, {0, 0.5}, {1, 0.125}, {0.75, 0.25}};
    tally t = {.name = "plot distribution --depth-range"};
    for (size_t i = 0; i < 2 * sizeof ranges / sizeof ranges[0]; i++) {
        const double *e = ranges[i / 2], low = fmin(e[0], e[1]), high = fmax(e[0], e[1]);
        const bool turned = i % 2 == 1;
        json_t *root = json_printed(0, "plot distribution -F unorm4 -m %s -n 1 -f 8 --depth-range %g:%g",
                                    turned ? "reversed" : "d3d", e[0], e[1]);
        const uint32_t first = (uint32_t)floor(low * 15 + 0.5), last = (uint32_t)floor(high * 15 + 0.5);
        const json_t *points = node_at(root, "panels[0].series[0].points");
        char title[64];
        snprintf(title, sizeof title, "unorm4 %s, %s%u%s codes", turned ? "reversed" : "d3d", "", last - first + 1,
                 last - first < 15 ? " of 16" : "");
        TALLY(&t, strcmp(text_at(root, "panels[0].title"), title) == 0, "%s", text_at(root, "panels[0].title"));
        TALLY(&t, json_array_size(points) == last - first + 1, "%g:%g: %zu codes, should be %u", e[0], e[1],
              json_array_size(points), last - first + 1);
        for (uint32_t code = first; code <= last; code++) {
            const double d = fmin(fmax(code / 15.0, low), high), part = (d - e[0]) / (e[1] - e[0]),
                         way = turned ? 1 - part : part, z = 8 / (8 - 7 * way);
            TALLY(&t, fabs(number_at(points, "[%u].depth", code - first) - code / 15.0) <= 1e-15, "code %u", code);
            TALLY(&t, fabs(number_at(points, "[%u].z", code - first) - z) <= 1e-13 * z, "%g:%g: code %u is at %.17g",
                  e[0], e[1], code, z);
        }
        json_decref(root);
    }
    tally_end(&t);
}

/* Codes in a unit of depth are the slope of window depth times the steps, where cells are narrow. */
TEST(density) {
    const dp_format formats[] = {oracle_unorm(24)};
    rng r = rng_make("ranged density");
    tally t = {.name = "codes along z in a depth range"};
    for (uint64_t i = test_cases(6, 30, 100); i > 0; i--) {
        const viewport v = any_viewport(&r, formats, 1);
        const double per = reciprocals_per_depth(&v.spec) * 0x1p-24;
        json_t *root = json_printed(0, "plot distribution %s", v.words);
        const json_t *points = node_at(root, "panels[0].series[0].points");
        TALLY(&t, json_array_size(points) > 1, "%s: no curve", v.words);
        for (size_t k = 0; k < json_array_size(points); k++) {
            const double z = number_at(points, "[%zu].z", k), width = z * z * per;
            if (width < 1e-4 * z && z > v.spec.znear * 1.01 && z < v.spec.zfar * 0.99)
                TALLY(&t, fabs(number_at(points, "[%zu].density", k) * width - 1) <= 0.02, "%s: %g codes a unit at %g",
                      v.words, number_at(points, "[%zu].density", k), z);
        }
        json_decref(root);
    }
    tally_end(&t);
}

/* ---- bias -------------------------------------------------------------------------------------------------------- */

/* A unit more or less in binary32, as OpenGL moves it: r is assumed to be 2^-N. */
TEST(biased) {
    const dp_format formats[] = {oracle_unorm(16), oracle_unorm(24)};
    rng r = rng_make("ranged bias");
    tally t = {.name = "bias --depth-range"}, enough = {.name = "biases that are enough in a depth range"};
    for (uint64_t i = test_cases(10, 80, 300); i > 0; i--) {
        const viewport v = any_viewport(&r, formats, 2);
        const dp_spec *s = &v.spec;
        const double sign = falls(s) ? 1 : -1, units = sign * (double)(1 + rng_below(&r, 3)),
                     unit = ldexp(1, -s->format.bits);
        const double lo = rng_log(&r, s->znear * 1.0001, s->zfar * 0.5), hi = rng_uniform(&r, lo, s->zfar);
        const double low = fmin(s->depth_range[0], s->depth_range[1]),
                     high = fmax(s->depth_range[0], s->depth_range[1]);
        oracle o;
        mpq_t d;
        mpq_init(d);
        oracle_init(&o, s);
        oracle_window(&o, d, lo);
        json_t *root =
            json_printed(0, "bias %s --api gl --units=%g --at %.17g --range %.17g:%.17g", v.words, units, lo, lo, hi);
        const double depth = oracle_double(d) + units * unit, kept = fmin(fmax(depth, low), high);
        const double back = number_at(root, "setups[0].rows[0].depth");
        TALLY(&t, fabs(back - kept) <= 1e-15, "%s: moved to %.17g, should be %.17g", v.words, back, kept);
        TALLY(&t, flag_at(root, "setups[0].rows[0].limited") == (kept != depth), "%s: %.17g", v.words, depth);
        if (kept == depth) {
            const double to = 1 / (1 / lo + fabs(units) * unit * reciprocals_per_depth(s));
            TALLY(&t, fabs(number_at(root, "setups[0].rows[0].shift") - (to - lo)) <= 1e-11 * (lo - to) + 0x1p-50 * lo,
                  "%s: shift at %.17g", v.words, lo);
        } else {
            TALLY(&t, fabs(number_at(root, "setups[0].rows[0].shift") - (s->znear - lo)) <= 1e-14 * lo, "%s: held",
                  v.words);
        }
        /* Every depth that a rasterizer may hand over is brought nearer by a code, and is left in the range. */
        const bool said = strcmp(text_at(root, "setups[0].facing.answer"), "enough") == 0;
        double ends[2] = {NAN, NAN};
        for (int k = 0; k < 2 && said; k++) {
            oracle_window(&o, d, number_at(root, k == 0 ? "setups[0].facing.from" : "setups[0].facing.to"));
            ends[k] = oracle_double(d);
        }
        for (int k = 0; said && k < 300; k++) {
            const float at = (float)rng_uniform(&r, fmin(ends[0], ends[1]), fmax(ends[0], ends[1])),
                        sum = at + (float)(units * unit);
            const uint32_t was = oracle_encode(&s->format, DP_ROUND_NEAREST, (double)at),
                           is = oracle_encode(&s->format, DP_ROUND_NEAREST, fmin(fmax((double)sum, low), high));
            TALLY(&enough, sign > 0 ? is > was : is < was, "%s: %g is not enough at depth %.9g", v.words, units,
                  (double)at);
        }
        json_decref(root);
        oracle_clear(&o);
        mpq_clear(d);
    }
    tally_end(&t);
    tally_end(&enough);
}

/* Next to the near plane a bias leads out of the range, where Direct3D holds it: that is never enough. */
TEST(held) {
    check_says(0, "Not proven", "bias -F d24 -m gl --api gl --units -1 --at .1 --depth-range .1:1");
    check_says(0, "Not enough", "bias -F d24 -m gl --api gl --units -1 --at .1 --depth-range 0:.1");
    check_says(0, "Enough", "bias -F d24 -m gl --api gl --units -1 --at .11 --depth-range .1:1");
}

/* ---- Refusals ---------------------------------------------------------------------------------------------------- */

TEST(refusals) {
    static const refused_row rows[] = {
        {"--depth-range .5", "must be LO:HI", 2},
        {"--depth-range .5:", "must be LO:HI", 2},
        {"--depth-range .5:x", "must be LO:HI", 2},
        {"--depth-range 0:1.1", "must be two window depths, each 0 or from 1e-6 to 1, and at least 1e-6 apart", 2},
        {"--depth-range -1:1", "must be two window depths", 2},
        {"--depth-range 0:0", "must be LO:HI", 2},
        {"--depth-range .5:.5000001", "must be two window depths", 2},
        {"--depth-range 5e-7:1", "must be two window depths", 2},
        {"--depth-range 0:.5,", "must be LO:HI, got '0:.5,'", 2},
        {"--depth-range 0:.5,.5", "must be LO:HI, two window depths from 0 to 1, got '.5'", 2},
        {"--depth-range 0:.5,.5:2", "must be two window depths", 2},
        {"--depth-range 0:1,1:0 --preset unity", "must not fall in d3d11", 2},
        {"--depth-range 0:1,1:0 --platform chrome-d3d", "must not fall in webgpu", 2},
        {"--depth-range 0:1,0:.5 -m log", "needs one of the mappings d3d, gl, reversed, gl-reversed, got log", 2},
        {"--depth-range 0:.5 -m log", "needs one of the mappings d3d, gl, reversed, gl-reversed, got log", 2},
        {"--depth-range 0:.5 -m linear", "got linear, whose depth a shader writes", 2},
        {"--depth-range 0:.5 -m d3d --model staged", "must be exact, float or auto", 2},
        {"--depth-range 0:.5 --link", "--depth-range: conflicts with --link", 2},
        {"--depth-range 0:.5 --constants", "does not apply with --constants", 2},
        {"--depth-range 1:0 --preset unity", "must not fall in d3d11", 2},
        {"--depth-range 1:0 --platform chrome-d3d", "must not fall in webgpu", 2},
    };
    static const char *const lines[] = {"world",
                                        "scene tests/models/street.obj",
                                        "shadow",
                                        "methods position",
                                        "judge --pairs tests/pairs/reversed.csv",
                                        "prepass"};
    const char *made = scratch_file("made.npy");
    CHECK_REFUSED("table", rows);
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++)
        check_says(2, "(d - LO)/(HI - LO)", "%s --depth-range 0:.5", lines[i]);
    check_says(2, "must be one range for bias, got '0:.5,.5:1': table compares several",
               "bias --depth-range 0:.5,.5:1");
    check_says(2, "--depth-range", "plot share -F d24 --depth-range 0:.5");
    check_says(2, "--depth-range", "plot map -F d24 --depth-range 0:.5");
    check_says(0, "", "plot error -F d24 -m gl --depth-range 0:.5 --csv");
    check_says(2, "must not fall in d3d12", "bias --api d3d12 --depth-range 1:0");
    check_says(0, "", "bias --api vulkan --depth-range 1:0");
    check_says(2, "--depth-range: conflicts with --remedy", "bias --remedy ndc:1e-5 --depth-range 0:.5");
    check_says(2, "--depth-range: conflicts with --from-origin", "budget --from-origin 1e4 --depth-range 0:.5");
    check_says(2, "conflicts with --metric: metric depth", "texture a.png --metric mm --depth-range 0:.5");
    check_says(2, "only with FILE or --synthetic", "texture --product effect:edge -F d16 -m d3d --depth-range 0:.5");
    check_says(2, "undo the range",
               "texture --synthetic plane --size 8x8 --product effect:edge -o %s --depth-range 0:.5", made);
    check_says(2, "undo the range",
               "texture --synthetic plane --size 8x8 --product position:view -o %s --depth-range 0:.5", made);
    check_says(0, "", "texture --synthetic plane --size 8x8 --product position:exact -o %s --depth-range 0:.5", made);
    check_says(0, "", "table -m log --depth-range 0:1 --viewport 640x480");
}

TEST(code) {
    check_says(2, "it knows the depth range 0 to 1 alone; there are unity, complement-unity",
               "code textbook -m d3d --depth-range 0:.5");
    check_says(2, "must be glsl, hlsl, wgsl, msl, c or numpy with --depth-range, got gappa",
               "code -m d3d --language gappa --depth-range 0:.5");
    check_says(2, "conflicts with --ortho", "code -m d3d --ortho --depth-range 0:.5");
    check_says(2, "has no effect with --what projection", "code --what projection --depth-range 0:.5");
    check_says(2, "has no effect with --what encode", "code --what encode --depth-range 0:.5");
    check_says(0, "for any d from 0 to 0.5;", "code -m d3d --depth-range 0:.5");
    check_says(0, "for any d from 0.5 on,", "code -m d3d -f inf --depth-range .5:1");
    check_says(0, "for any d above 0.5, to 1;", "code -m reversed -f inf --depth-range .5:1");
    check_says(0, "up to a depth of 2.12e+36;", "code -m reversed -f inf --depth-range 0:.5");
}

TEST(refused_files) {
    static const struct {
        const char *camera, *need, *said;
    } rows[] = {
        {"depth_range = \"0:1\";", "", "depth_range: must be (LO, HI)"},
        {"depth_range = (0, 2);", "", "depth_range: must be (LO, HI)"},
        {"depth_range = (0, 0);", "", "got 0 twice"},
        {"depth_range = (0.5, 0.5000001);", "", "must be two window depths"},
        {"depth_range = (0, 0.5); from_origin = 1e5; scheme = \"split\";", "", "not with depth_range"},
        {"depth_range = (1, 0);", "bias = { api = \"d3d11\"; units = 1; }; range = [1, 2];", "must not fall in d3d11"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const char *path =
            scratch_text("refused.need",
                         "cameras = { c = { near = 1; far = 9; mapping = \"d3d\"; format = \"d24\"; %s }; };\n"
                         "requirements = { r = { camera = \"c\"; %s }; };\n",
                         rows[i].camera, *rows[i].need != '\0' ? rows[i].need : "separation = 1; at = 2;");
        check_says(2, rows[i].said, "check %s", path);
    }
}

/* Sky begins where the depth from 0 to 1 is within 0.0001 of far's, in every range: 1/z = 0.0001/n + 0.9999/f, within a
 * cell. */
TEST(sky_of_ranges) {
    rng r = rng_make("sky of ranges");
    tally t = {.name = "sky of ranges"};
    for (uint64_t n = test_cases(10, 60, 1000); n > 0; n--) {
        const char *mapping = mappings[rng_below(&r, 4)];
        const double z = 1 / (0.0001 / 0.1 + 0.9999 / 1000);
        double e[2];
        rng_range(&r, e);
        const double cell = z * z / 0.1 / ((1 << 24) * fabs(e[1] - e[0]));
        if (cell > z / 4)
            continue;
        json_t *root = json_printed(0,
                                    "texture --synthetic plane --size 8x8 -F d24 -m %s -n 0.1 -f 1000 --depth-range "
                                    "%.17g:%.17g",
                                    mapping, e[0], e[1]);
        const double from = number_at(root, "sky.from");
        TALLY(&t, fabs(from - z) <= 1.1 * cell, "%s %g:%g: from %g, not %g", mapping, e[0], e[1], from, z);
        TALLY(&t, number_at(root, "sky.pixels") == 0, "%s %g:%g: a plane at 10 is sky", mapping, e[0], e[1]);
        json_decref(root);
    }
    tally_end(&t);
}
