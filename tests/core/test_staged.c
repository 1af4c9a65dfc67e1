/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Model `staged` against MPFR: NDC depth, then window depth, each rounded once to binary32, then the format. */
#include "oracle.h"
#include "support.h"

/* Binary32 as MPFR sees it: 24 bits, subnormals down to 2^-149. */
static float to_binary32(const mpq_t x) {
    mpfr_t r;
    mpfr_init2(r, 24);
    const mpfr_exp_t emin = mpfr_get_emin();
    mpfr_set_emin(-148);
    const int ternary = mpfr_set_q(r, x, MPFR_RNDN);
    mpfr_subnormalize(r, ternary, MPFR_RNDN);
    const float result = mpfr_get_flt(r, MPFR_RNDN);
    mpfr_set_emin(emin);
    mpfr_clear(r);
    return result;
}

static int is_signed(const dp_spec *spec) {
    return spec->mapping == DP_MAPPING_GL || spec->mapping == DP_MAPPING_GL_REVERSED ||
           spec->mapping == DP_MAPPING_OSGEARTH; /* gl_Position.z = (2 d - 1) w */
}

static uint32_t staged_code(oracle *o, double z) {
    mpq_t d, half;
    mpq_inits(d, half, NULL);
    oracle_window(o, d, z);
    float w;
    if (is_signed(&o->spec)) {
        mpq_set_si(half, -1, 1);
        mpq_add(d, d, d);
        mpq_add(d, d, half);
        mpq_set_d(d, (double)to_binary32(d));
        mpq_set_si(half, 1, 2);
        mpq_mul(d, d, half);
        mpq_add(d, d, half);
        w = to_binary32(d);
    } else {
        w = to_binary32(d);
    }
    if (strcmp(o->spec.format.name, "rg") == 0) { /* two channels: the whole part k of y = 255 w, and the rest */
        mpq_set_d(d, (double)w);
        mpq_set_si(half, 255, 1);
        mpq_mul(d, d, half);
        const double y = (double)to_binary32(d), k = floor(y);
        mpq_clears(d, half, NULL);
        return (uint32_t)(255 * k + floor(255 * (y - k) + 0.5));
    }
    mpq_clears(d, half, NULL);
    return oracle_encode(&o->spec.format, o->spec.rounding, (double)w);
}

static const char *const format_names[] = {"fp16",    "unorm16", "unorm24",   "fp32",
                                           "unorm32", "unorm10", "float5.20", "rg"};
enum { FORMAT_NAMES = sizeof format_names / sizeof format_names[0] };

/* A random set-up of the model; 0 when the combination is not allowed. */
static int random_setup(rng *r, dp_spec *spec, dp_setup *setup) {
    dp_format format[2];
    *spec = dp_spec_default();
    dp_format_parse(format_names[rng_below(r, FORMAT_NAMES)], format);
    spec->format = format[0];
    spec->mapping = (dp_mapping)rng_below(r, DP_MAPPING_COUNT);
    spec->rounding = (dp_rounding)rng_below(r, DP_ROUNDING_COUNT);
    if (strcmp(format[0].name, "rg") == 0) {
        spec->mapping = DP_MAPPING_LINEAR;
        spec->rounding = DP_ROUND_NEAREST;
    }
    spec->ortho = rng_below(r, 4) == 0;
    spec->znear = rng_log(r, 1e-3, 1e2);
    spec->zfar = rng_below(r, 4) == 0 ? HUGE_VAL : spec->znear * rng_log(r, 1.01, 1e6);
    spec->model = DP_MODEL_STAGED;
    return dp_setup_init(setup, spec) == DP_OK;
}

/* The same with every other orthographic near plane at 0 or behind the camera. */
static int random_setup_signed(rng *r, dp_spec *spec, dp_setup *setup) {
    const int made = random_setup(r, spec, setup);
    if (!spec->ortho || rng_below(r, 2))
        return made;
    rng_planes(r, &spec->znear, &spec->zfar);
    return dp_setup_init(setup, spec) == DP_OK;
}

static double range_end(const dp_spec *spec) {
    return isinf(spec->zfar) ? 1e6 * spec->znear : spec->zfar;
}

static double random_depth(rng *r, const dp_spec *spec) {
    if (spec->znear <= 0.0)
        return rng_depth(r, spec->znear, spec->zfar);
    return fmin(fmax(rng_log(r, spec->znear, range_end(spec)), spec->znear), spec->zfar);
}

TEST(codes_match_mpfr) {
    tally t = {.name = "staged codes"};
    rng r = rng_make("staged codes");
    for (uint64_t i = test_cases(2000, 15000, 1000000); i > 0; i--) {
        dp_spec spec;
        dp_setup setup;
        if (!random_setup_signed(&r, &spec, &setup))
            continue;
        oracle o;
        oracle_init(&o, &spec);
        const double z0 = random_depth(&r, &spec);
        const dp_cell cell = dp_cell_of(&setup, dp_code(&setup, z0));
        /* A random depth, and the doubles around both ends of its cell. */
        double z[7] = {z0,
                       cell.lo,
                       nextafter(cell.lo, -HUGE_VAL),
                       nextafter(cell.lo, HUGE_VAL),
                       cell.hi,
                       nextafter(cell.hi, -HUGE_VAL),
                       nextafter(cell.hi, HUGE_VAL)};
        for (int k = 0; k < 7; k++) {
            if (!(z[k] >= spec.znear && z[k] <= spec.zfar) || isinf(z[k]))
                continue;
            const uint32_t want = staged_code(&o, z[k]);
            const uint32_t got = dp_code(&setup, z[k]);
            char text[256];
            TALLY(&t, got == want, "z = %a: code %u, MPFR %u; %s", z[k], got, want,
                  oracle_describe(&spec, text, sizeof text));
        }
        /* The cell ends where the code changes. */
        const double size = fmax(fabs(cell.lo), fabs(cell.hi));
        if (cell.lo > spec.znear && cell.hi < spec.zfar && cell.width > 1e-13 * size) {
            const double inside_lo = cell.lo + 0.25 * cell.width;
            const double inside_hi = cell.hi - 0.25 * cell.width;
            TALLY(&t, staged_code(&o, inside_lo) == cell.code && staged_code(&o, inside_hi) == cell.code, "cell of %u",
                  cell.code);
            const double before = cell.lo - size * 1e-14;
            const double after = cell.hi + size * 1e-14;
            TALLY(&t, staged_code(&o, before) != cell.code && staged_code(&o, after) != cell.code,
                  "cell of %u is larger than [%a, %a]", cell.code, cell.lo, cell.hi);
        }
        oracle_clear(&o);
    }
    tally_end(&t);
}

TEST(separation_is_safe) {
    tally t = {.name = "staged separation"};
    rng r = rng_make("staged separation");
    for (uint64_t i = test_cases(2000, 15000, 1000000); i > 0; i--) {
        dp_spec spec;
        dp_setup setup;
        if (!random_setup_signed(&r, &spec, &setup))
            continue;
        oracle o;
        oracle_init(&o, &spec);
        double z = random_depth(&r, &spec);
        if (rng_below(&r, 2) == 0)
            z = fmax(dp_cell_of(&setup, dp_code(&setup, z)).lo, spec.znear);
        const double behind = nextafter(z + dp_separation(&setup, z), HUGE_VAL);
        if (behind <= spec.zfar && !isinf(behind)) {
            const uint32_t a = staged_code(&o, z);
            const uint32_t b = staged_code(&o, behind);
            char text[256];
            TALLY(&t, setup.reversed ? b < a : b > a, "z = %a: codes %u and %u; %s", z, a, b,
                  oracle_describe(&spec, text, sizeof text));
        } else {
            t.skipped++;
        }
        oracle_clear(&o);
    }
    tally_end(&t);
}

/* The code next to `code` that is stored at all, towards far. */
static uint32_t next_code(const dp_setup *setup, const dp_cell *cell) {
    const double z = cell->hi + 1e-13 * cell->hi;
    uint32_t code = dp_code(setup, z);
    return code;
}

/*
 * The certified worst case against a walk over every cell of the 16-bit formats (their cells are checked above):
 * never below; above only with unorm, by less than one step of window depth and one of NDC depth.
 */
TEST(worst_is_certified) {
    static const double cameras[][2] = {{0.1, 1000}, {0.3, 77}, {1, 1.5},  {0.01, 1e6}, {5, 5000},      {0.05, 4000},
                                        {0.25, 128}, {1, 2},    {10, 1e5}, {2, 65536},  {0.1, HUGE_VAL}};
    static const char *const formats[] = {"fp16", "unorm16", "unorm10", "rg"};
    tally t = {.name = "staged worst case"};
    const uint64_t count = test_cases(2, 11, 11);
    for (uint64_t c = 0; c < count; c++)
        for (int f = 0; f < 4; f++)
            for (int m = 0; m < DP_MAPPING_COUNT; m++)
                for (int k = 0; k < 2; k++) {
                    dp_spec spec = dp_spec_default();
                    dp_format format[2];
                    dp_format_parse(formats[f], format);
                    spec.format = format[0];
                    spec.mapping = (dp_mapping)m;
                    spec.rounding = k ? DP_ROUND_ZERO : DP_ROUND_NEAREST;
                    spec.znear = cameras[c][0];
                    spec.zfar = cameras[c][1];
                    spec.model = DP_MODEL_STAGED;
                    dp_setup setup;
                    if (dp_setup_init(&setup, &spec) != DP_OK)
                        continue;
                    const double end = isinf(spec.zfar) ? 100.0 : spec.zfar;
                    double interval = 0.0;
                    double step_there = 0.0;
                    dp_cell cell = dp_cell_of(&setup, dp_code(&setup, spec.znear));
                    for (;;) {
                        if (cell.width > interval) {
                            interval = cell.width;
                            /* the largest step of window depth and that of NDC depth, 2^-24 and 2^-25, at the far end
                             * of the cell */
                            step_there = dp_separation(&setup, fmin(cell.hi, end)) * 0x1.8p-24 *
                                         (spec.format.kind == DP_FORMAT_UNORM ? (double)spec.format.code_max : 8192.0);
                        }
                        if (cell.hi >= end)
                            break;
                        cell = dp_cell_of(&setup, next_code(&setup, &cell));
                    }
                    dp_worst worst;
                    assert_int_equal(dp_worst_over(&setup, spec.znear, end, &worst), DP_OK);
                    TALLY(&t, worst.interval >= interval, "%s: %.17g below %.17g", formats[f], worst.interval,
                          interval);
                    const int is_float = spec.format.kind == DP_FORMAT_FLOAT;
                    TALLY(&t, worst.interval <= interval + (is_float ? 1e-9 * interval : step_there),
                          "%s, mapping %d: %.17g far above %.17g", formats[f], m, worst.interval, interval);
                    TALLY(&t, worst.interval_hi - worst.interval_lo <= interval * (1.0 + 1e-9),
                          "the named cell is one");
                }
    tally_end(&t);
}

/*
 * Error and width over windows of up to 1500 cells, walked one by one, where the format's steps are wider than those of
 * binary32, alike and finer: in each class of set-ups never below, and the found one comes near the stated one, so that
 * no part of it can be halved or doubled.
 */
typedef struct near_worst {
    uint64_t cases;
    double error, interval;             /* the largest share found of what is stated */
    double error_least, interval_least; /* the least */
} near_worst;

static double error_of_cell(const dp_setup *setup, const dp_cell *cell, double lo, double hi) {
    return fmax(fabs(dp_error(setup, cell->code, fmax(cell->lo, lo))),
                fabs(dp_error(setup, cell->code, fmin(cell->hi, hi))));
}

/* Walks the cells from lo on; *hi is where it stopped. @return 0 when a cell has no end */
static int walk_cells(const dp_setup *setup, double lo, uint64_t most, double *hi, double *error, double *interval) {
    double begin = lo;
    dp_cell cell = dp_cell_of(setup, dp_code(setup, lo));
    *hi = *error = *interval = 0;
    for (uint64_t i = 0; i < most; i++) {
        if (!(cell.hi < range_end(&setup->spec)))
            break;
        begin = cell.hi - fabs(cell.hi) * 1e-13;
        *error = fmax(*error, error_of_cell(setup, &cell, lo, begin));
        *interval = fmax(*interval, cell.width);
        *hi = begin;
        const uint32_t code = next_code(setup, &cell);
        if (code == cell.code)
            return 0;
        cell = dp_cell_of(setup, code);
    }
    return *hi > lo;
}

/* Never below what is found. */
static void check_above(tally *t, const dp_setup *setup, double lo, double hi, double error, double interval,
                        const dp_worst *worst) {
    const dp_spec *spec = &setup->spec;
    TALLY(t, error <= worst->error * (1 + 1e-12) + 1e-15 * hi && interval <= worst->interval * (1 + 1e-9),
          "%s, mapping %d, rounding %d, near %.17g, far %.17g, %.17g to %.17g: error %.17g above %.17g, or width %.17g "
          "above %.17g",
          spec->format.name, (int)spec->mapping, (int)spec->rounding, spec->znear, spec->zfar, lo, hi, error,
          worst->error, interval, worst->interval);
}

/* A window whose only cell of one step more is the last that is not visited. */
TEST(one_wide_cell_counts) {
    tally t = {.name = "one wide cell"};
    dp_spec spec = dp_spec_default();
    dp_format format[2];
    dp_setup setup;
    dp_worst worst;
    double hi, error, interval;
    dp_format_parse("unorm16", format);
    spec.format = format[0];
    spec.mapping = DP_MAPPING_GL;
    spec.model = DP_MODEL_STAGED;
    spec.znear = 4.1917741036798537;
    spec.zfar = 34.906464165649126;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    const double lo = 6.153554731899189;
    assert_true(walk_cells(&setup, lo, 68, &hi, &error, &interval));
    assert_int_equal(dp_worst_over(&setup, lo, hi, &worst), DP_OK);
    check_above(&t, &setup, lo, hi, error, interval, &worst);
    tally_end(&t);
}

TEST(worst_is_near_in_each_class) {
    static const char *const formats[] = {"unorm16", "unorm20",   "unorm23",   "unorm24", "unorm25", "unorm28",
                                          "fp32",    "float5.18", "float8.21", "fp16",    "rg"};
    static const char *const kinds[] = {"unorm", "float"};
    near_worst seen[2][2][2][2] = {{{{{0}}}}}; /* float, signed NDC, truncated, finer than 23 bits */
    tally t = {.name = "staged worst, by class"};
    rng r = rng_make("staged worst by class");
    for (uint64_t i = test_cases(100, 900, 60000); i > 0; i--) {
        dp_spec spec;
        dp_setup setup;
        dp_format format[2];
        double hi, error, interval;
        dp_worst worst;
        const size_t f = rng_below(&r, sizeof formats / sizeof formats[0]);
        if (!random_setup(&r, &spec, &setup))
            continue;
        dp_format_parse(formats[f], format);
        spec.format = format[0];
        if (strcmp(formats[f], "rg") == 0)
            spec.mapping = DP_MAPPING_LINEAR;
        if (dp_setup_init(&setup, &spec) != DP_OK || setup.curve == DP_CURVE_LOG)
            continue;
        const double lo = random_depth(&r, &spec);
        if (!walk_cells(&setup, lo, 1 + rng_below(&r, 1500), &hi, &error, &interval) ||
            dp_worst_over(&setup, lo, hi, &worst) != DP_OK)
            continue;
        check_above(&t, &setup, lo, hi, error, interval, &worst);
        near_worst *n = &seen[spec.format.kind == DP_FORMAT_FLOAT][is_signed(&spec)][spec.rounding == DP_ROUND_ZERO]
                             [format[0].bits > 23];
        const double share = error / worst.error, width = interval / worst.interval;
        n->error_least = n->cases == 0 ? share : fmin(n->error_least, share);
        n->interval_least = n->cases == 0 ? width : fmin(n->interval_least, width);
        n->error = fmax(n->error, share);
        n->interval = fmax(n->interval, width);
        n->cases++;
    }
    for (int k = 0; k < 16; k++) {
        const near_worst *n = &seen[k >> 3][k >> 2 & 1][k >> 1 & 1][k & 1];
        print_message("# %s, NDC %s, %s, %s: %llu, error %.3f to %.3f, width %.3f to %.3f of the stated\n",
                      kinds[k >> 3], k >> 2 & 1 ? "signed" : "plain", k >> 1 & 1 ? "truncated" : "nearest",
                      k & 1 ? "fine" : "coarse", (unsigned long long)n->cases, n->error_least, n->error,
                      n->interval_least, n->interval);
        /* A window of few cells may miss the worst place in the pattern of steps: a third of a truncated error. */
        const int few = n->cases == 0 || test_effort() == EFFORT_QUICK;
        TALLY(&t, few || (n->error >= 0.99 && n->error_least >= 0.3 && n->interval_least >= 0.85),
              "class %d: far above what is found", k);
        TALLY(&t, k >> 3 == 0 || n->cases == 0 || (n->error_least >= 0.999 && n->interval_least >= 1 - 1e-6),
              "class %d: a float's worst cell is not the one found", k);
    }
    tally_end(&t);
}

/* numerics: with NDC in [-1, 1] reversed-Z loses its advantage: window depths below 1/2 are multiples of 2^-25. */
TEST(gl_reversed_is_spoilt) {
    dp_spec spec = dp_spec_default();
    spec.mapping = DP_MAPPING_GL_REVERSED;
    spec.model = DP_MODEL_STAGED;
    dp_setup gl, reversed;
    assert_int_equal(dp_setup_init(&gl, &spec), DP_OK);
    spec.mapping = DP_MAPPING_REVERSED;
    assert_int_equal(dp_setup_init(&reversed, &spec), DP_OK);
    rng r = rng_make("gl-reversed");
    for (int i = 0; i < 10000; i++) {
        const double z = rng_log(&r, 0.21, 999.0);
        const double d = dp_format_value(&spec.format, dp_code(&gl, z));
        assert_true(fmod(d, 0x1p-25) == 0.0);
    }
    dp_worst a, b;
    dp_worst_over(&gl, 0.1, 1000.0, &a);
    dp_worst_over(&reversed, 0.1, 1000.0, &b);
    assert_true(a.interval > 1e4 * b.interval);
    assert_relative(b.interval, 2.95082468e-05, 1e-8); /* NDC is the window depth: as exact */
}
