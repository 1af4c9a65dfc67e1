/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Depth ranges of viewports: cells, depths read back and separations against exact fractions, the guarantee against
 * every pair of a census, and published numbers.
 */
#include "core/engine.h"
#include "oracle.h"
#include "support.h"
#include "zfight/census.h"

static const double bound = 1e-12;

typedef struct view {
    const char *name;
    double range[2];
    dp_mapping mapping;
    int ortho;
    double znear, zfar;
    dp_rounding rounding;
} view;

static const view views[] = {
    {"view model", {0, 0.1}, DP_MAPPING_D3D, 0, 0.01, 10, DP_ROUND_NEAREST},
    {"world behind it", {0.1, 1}, DP_MAPPING_D3D, 0, 0.1, 1000, DP_ROUND_NEAREST},
    {"last hundredth", {0.99, 1}, DP_MAPPING_GL, 0, 0.1, 1000, DP_ROUND_EVEN},
    {"turned", {1, 0}, DP_MAPPING_D3D, 0, 0.1, 1000, DP_ROUND_NEAREST},
    {"turned back", {0.8, 0.2}, DP_MAPPING_REVERSED, 0, 0.3, 700, DP_ROUND_ZERO},
    {"slice, truncated", {0.25, 0.625}, DP_MAPPING_REVERSED, 0, 0.5, 1e5, DP_ROUND_ZERO},
    {"one code or two", {0.5, 0.500003}, DP_MAPPING_D3D, 0, 1, 100, DP_ROUND_NEAREST},
    {"infinite", {0.3, 0.9}, DP_MAPPING_REVERSED, 0, 0.1, HUGE_VAL, DP_ROUND_NEAREST},
    {"infinite, turned", {0.7, 0.1}, DP_MAPPING_GL, 0, 0.1, HUGE_VAL, DP_ROUND_NEAREST},
    {"orthographic", {0.1, 0.6}, DP_MAPPING_GL, 1, 0.1, 1000, DP_ROUND_NEAREST},
    {"orthographic, about 0", {0.9, 0.35}, DP_MAPPING_REVERSED, 1, -50, 200, DP_ROUND_NEAREST},
};
enum { VIEWS = sizeof views / sizeof views[0] };

static dp_spec spec_of(const view *v, dp_format format) {
    dp_spec spec = dp_spec_default();
    spec.znear = v->znear;
    spec.zfar = v->zfar;
    spec.mapping = v->mapping;
    spec.ortho = v->ortho;
    spec.rounding = v->rounding;
    spec.depth_range[0] = v->range[0];
    spec.depth_range[1] = v->range[1];
    spec.format = format;
    return spec;
}

static void check_cell(const dp_setup *setup, oracle *o, oracle_cell *want, uint32_t code, const char *name, tally *t) {
    const dp_cell got = dp_cell_of(setup, code);
    mpq_t width;
    mpq_init(width);
    oracle_cell_of(o, want, code);
    if (!want->lo_infinite && !want->hi_infinite)
        mpq_sub(width, want->hi, want->lo);
    const double size = want->lo_infinite || want->hi_infinite ? oracle_double(want->lo) : oracle_double(width);
    TALLY(t, oracle_distance(got.lo, want->lo) <= 1e-15 * fabs(got.lo) + bound * size, "%s: cell %u from %.17g", name,
          code, got.lo);
    if (want->hi_infinite)
        TALLY(t, isinf(got.hi) && isinf(got.width), "%s: cell %u ends at %g", name, code, got.hi);
    else
        TALLY(t,
              oracle_distance(got.hi, want->hi) <= 1e-15 * fabs(got.hi) + bound * size &&
                  oracle_relative(got.width, width) <= bound,
              "%s: cell %u to %.17g, %.17g wide, should be %.17g, %.17g", name, code, got.hi, got.width,
              oracle_double(want->hi), oracle_double(width));
    if (want->stored_infinite)
        TALLY(t, isinf(got.stored), "%s: code %u gives %g", name, code, got.stored);
    else
        TALLY(t, oracle_distance(got.stored, want->stored) <= 0x1p-49 * fabs(got.stored) + bound * size,
              "%s: code %u gives %.17g, should be %.17g", name, code, got.stored, oracle_double(want->stored));
    if (!isinf(got.lo) && !want->stored_infinite) {
        mpq_set_d(width, got.lo);
        mpq_sub(width, want->stored, width);
        TALLY(t,
              oracle_distance(dp_error(setup, code, got.lo), width) <=
                  bound * size + 0x1p-48 * fabs(oracle_double(width)),
              "%s: error of code %u at %.17g", name, code, got.lo);
    }
    mpq_clear(width);
}

/* Every `step`-th code that is stored, and those at either end. */
static void check_codes(const view *v, dp_format format, uint32_t step, tally *t) {
    const dp_spec spec = spec_of(v, format);
    dp_setup setup;
    oracle o;
    oracle_cell cell;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    oracle_init(&o, &spec);
    oracle_cell_init(&cell);
    const uint32_t one = oracle_code(&o, spec.znear), other = oracle_code(&o, spec.zfar);
    TALLY(t, dp_code(&setup, spec.znear) == one && dp_code(&setup, spec.zfar) == other, "%s: planes are %u and %u",
          v->name, dp_code(&setup, spec.znear), dp_code(&setup, spec.zfar));
    const uint32_t first = one < other ? one : other, last = one < other ? other : one;
    for (uint32_t code = first; code <= last; code += code - first < 3 || last - code <= 3 ? 1
                                                      : last - code - 3 < step             ? last - code - 3
                                                                                           : step) {
        check_cell(&setup, &o, &cell, code, v->name, t);
        const double middle = 0.5 * (dp_cell_of(&setup, code).lo + dp_cell_of(&setup, code).hi);
        if (!isinf(middle))
            TALLY(t, dp_code(&setup, middle) == oracle_code(&o, middle), "%s: code of %.17g", v->name, middle);
    }
    oracle_cell_clear(&cell);
    oracle_clear(&o);
}

TEST(all_codes) {
    tally t = {.name = "codes of depth ranges"};
    for (int i = 0; i < VIEWS; i++) {
        check_codes(&views[i], oracle_unorm(16), (uint32_t)test_cases(97, 1, 1), &t);
        check_codes(&views[i], oracle_unorm(24), (uint32_t)test_cases(65537, 257, 17), &t);
        check_codes(&views[i], oracle_float(5, 10, 15), (uint32_t)test_cases(97, 1, 1), &t);
        check_codes(&views[i], oracle_float(8, 23, 127), (uint32_t)test_cases(7000001, 70001, 7001), &t);
    }
    tally_end(&t);
}

/* Random cameras and ranges: depth before it is stored, one step of the format behind it, and back. */
TEST(depths) {
    rng r = rng_make("moved depths");
    tally t = {.name = "depths of depth ranges"};
    mpq_t want, most;
    mpq_inits(want, most, NULL);
    for (uint64_t i = test_cases(300, 4000, 100000); i > 0; i--) {
        view v = views[rng_below(&r, VIEWS)];
        v.mapping = (dp_mapping)rng_below(&r, DP_MAPPING_GL_REVERSED + 1);
        rng_range(&r, v.range);
        const dp_spec spec = spec_of(&v, rng_below(&r, 2) ? oracle_unorm(24) : oracle_float(8, 23, 127));
        dp_setup setup;
        oracle o;
        int infinite;
        assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
        oracle_init(&o, &spec);
        const double z =
            v.znear < 0 ? rng_depth(&r, v.znear, v.zfar) : rng_log(&r, v.znear, isinf(v.zfar) ? 1e4 * v.znear : v.zfar);
        char text[256];
        oracle_describe(&spec, text, sizeof text);
        oracle_window(&o, want, z);
        const double d = dp_window(&setup, z);
        TALLY(&t, oracle_relative(d, want) <= 0x1p-49, "%s: d(%.17g) = %.17g, should be %.17g", text, z, d,
              oracle_double(want));
        const double apart = dp_separation(&setup, z);
        if (oracle_separation(&o, z, want, most, &infinite) == ORACLE_SEPARATION_ONE)
            TALLY(&t, apart >= oracle_double(want) * (1 - 1e-15) && oracle_relative(apart, want) <= 2 * bound,
                  "%s: separation at %.17g is %.17g, should be %.17g", text, z, apart, oracle_double(want));
        const double back = dp_eye(&setup, d, 1 - d);
        const double step = dp_curve_ahead(&setup, 0x1p-48 * d, 1, z);
        TALLY(&t, isinf(step) || fabs(back - z) <= 4 * step + 1e-14 * fabs(z), "%s: %.17g comes back as %.17g", text, z,
              back);
        oracle_clear(&o);
    }
    mpq_clears(want, most, NULL);
    tally_end(&t);
}

/* ---- The door ---------------------------------------------------------------------------------------------------- */

TEST(refusals) {
    static const struct {
        double range[2];
        dp_mapping mapping;
        dp_model model;
        dp_status want;
    } rows[] = {
        {{0, 0}, DP_MAPPING_D3D, DP_MODEL_EXACT, DP_OK},
        {{0, 1}, DP_MAPPING_LOG, DP_MODEL_STAGED, DP_OK},
        {{-0.0, 1}, DP_MAPPING_LINEAR, DP_MODEL_EXACT, DP_OK},
        {{1, 0}, DP_MAPPING_GL, DP_MODEL_FLOAT, DP_OK},
        {{1e-6, 0}, DP_MAPPING_GL_REVERSED, DP_MODEL_EXACT, DP_OK},
        {{1, 1 - 1.1e-6}, DP_MAPPING_REVERSED, DP_MODEL_FLOAT, DP_OK},
        {{1, 1}, DP_MAPPING_D3D, DP_MODEL_EXACT, DP_ERROR_WINDOW},
        {{0.5, 0.5 + 0.9e-6}, DP_MAPPING_D3D, DP_MODEL_EXACT, DP_ERROR_WINDOW},
        {{0.9e-6, 1}, DP_MAPPING_D3D, DP_MODEL_EXACT, DP_ERROR_WINDOW},
        {{-0.1, 1}, DP_MAPPING_D3D, DP_MODEL_EXACT, DP_ERROR_WINDOW},
        {{0, 1.0000001}, DP_MAPPING_D3D, DP_MODEL_EXACT, DP_ERROR_WINDOW},
        {{0.5, INFINITY}, DP_MAPPING_D3D, DP_MODEL_EXACT, DP_ERROR_WINDOW},
        {{NAN, 1}, DP_MAPPING_D3D, DP_MODEL_EXACT, DP_ERROR_WINDOW},
        {{0, NAN}, DP_MAPPING_D3D, DP_MODEL_FLOAT, DP_ERROR_WINDOW},
        {{0, 0.5}, DP_MAPPING_LINEAR, DP_MODEL_EXACT, DP_ERROR_WINDOW},
        {{1, 0}, DP_MAPPING_LOG, DP_MODEL_EXACT, DP_ERROR_WINDOW},
        {{0, 0.5}, DP_MAPPING_D3D, DP_MODEL_STAGED, DP_ERROR_MODEL},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        dp_spec spec = dp_spec_default();
        dp_setup setup;
        spec.mapping = rows[i].mapping;
        spec.model = rows[i].model;
        memcpy(spec.depth_range, rows[i].range, sizeof spec.depth_range);
        const dp_status got = dp_setup_init(&setup, &spec);
        if (got != rows[i].want)
            fail_msg("%g:%g of %s: %s", rows[i].range[0], rows[i].range[1], dp_mapping_get(spec.mapping)->name,
                     dp_status_text(got));
    }
}

/* ---- Arrays ------------------------------------------------------------------------------------------------------ */

/* An array gets what one depth or code gets. */
TEST(arrays) {
    enum { COUNT = 300 };
    rng r = rng_make("moved arrays");
    tally t = {.name = "arrays in depth ranges"};
    for (int i = 0; i < VIEWS; i++)
        for (int path = 0; path < DP_PATH_COUNT; path++) {
            if (!dp_path_available((dp_path)path))
                continue;
            const dp_spec spec = spec_of(&views[i], i % 2 ? oracle_unorm(16) : oracle_float(8, 23, 127));
            dp_setup setup;
            dp_batch code, eye, width;
            double z[COUNT], back[COUNT], wide[COUNT];
            uint32_t codes[COUNT];
            assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
            assert_int_equal(dp_batch_init(&code, &setup, DP_TASK_CODE, DP_REAL_DOUBLE, DP_WORD_32, (dp_path)path),
                             DP_OK);
            assert_int_equal(dp_batch_init(&eye, &setup, DP_TASK_EYE, DP_REAL_DOUBLE, DP_WORD_32, (dp_path)path),
                             DP_OK);
            assert_int_equal(dp_batch_init(&width, &setup, DP_TASK_WIDTH, DP_REAL_DOUBLE, DP_WORD_32, (dp_path)path),
                             DP_OK);
            for (int k = 0; k < COUNT; k++)
                z[k] = rng_uniform(&r, spec.znear, isinf(spec.zfar) ? 1e3 * spec.znear : spec.zfar);
            dp_batch_run(&code, z, codes, COUNT);
            dp_batch_run(&eye, codes, back, COUNT);
            dp_batch_run(&width, codes, wide, COUNT);
            for (int k = 0; k < COUNT; k++)
                TALLY(&t,
                      codes[k] == dp_code(&setup, z[k]) && back[k] == dp_stored(&setup, codes[k]) &&
                          wide[k] == dp_cell_of(&setup, codes[k]).width,
                      "%s: %.17g is stored as %u, read as %.17g", views[i].name, z[k], codes[k], back[k]);
        }
    tally_end(&t);
}

/* Window depths of no code: what lies beyond an end is that plane, and each lies in its cell. */
TEST(windows) {
    enum { COUNT = 200 };
    rng r = rng_make("moved windows");
    tally t = {.name = "window depths in depth ranges"};
    for (int i = 0; i < VIEWS; i++)
        for (int real = 0; real < 2; real++) {
            const dp_spec spec = spec_of(&views[i], real ? oracle_float(8, 23, 127) : oracle_unorm(24));
            const double *ends = spec.depth_range;
            const bool reversed = (views[i].mapping == DP_MAPPING_REVERSED) != (ends[1] < ends[0]);
            double d[COUNT], eye[COUNT], lo[COUNT], hi[COUNT];
            dp_setup setup;
            assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
            for (int k = 0; k < COUNT; k++)
                d[k] = k % 2 ? rng_uniform(&r, 0, 1) : rng_uniform(&r, ends[0], ends[1]);
            assert_int_equal(dp_batch_windows(&setup, DP_REAL_DOUBLE, d, eye, lo, hi, COUNT), DP_OK);
            for (int k = 0; k < COUNT; k++) {
                const bool above = d[k] > fmax(ends[0], ends[1]) + 0x1p-20,
                           below = d[k] < fmin(ends[0], ends[1]) - 0x1p-20;
                TALLY(&t, lo[k] <= eye[k] && eye[k] <= hi[k], "%s: %.17g in %.17g to %.17g", views[i].name, eye[k],
                      lo[k], hi[k]);
                if (above || below)
                    TALLY(&t, eye[k] == (above == reversed ? spec.znear : spec.zfar), "%s: %.17g beyond an end: %.17g",
                          views[i].name, d[k], eye[k]);
            }
        }
    tally_end(&t);
}

/* ---- Over a range of eye depths ---------------------------------------------------------------------------------- */

/* Of a float camera exact is enough or float, but never staged, which none has. */
static void check_choice(const dp_setup *setup, const view *v, const double z[2], tally *t) {
    for (int i = 0; i < 2; i++) {
        dp_choice choice;
        assert_int_equal(dp_model_choose(setup, z, 2, i == 0 ? 1e9 : 0.0, &choice), DP_OK);
        TALLY(t,
              isnan(choice.share[DP_MODEL_STAGED]) && choice.share[DP_MODEL_FLOAT] == 0.0 &&
                  choice.model == (i == 0 || choice.share[DP_MODEL_EXACT] == 0.0 ? DP_MODEL_EXACT : DP_MODEL_FLOAT),
              "%s: model %d", v->name, (int)choice.model);
    }
}

TEST(over_depths) {
    enum { SEEN = 100 };
    rng r = rng_make("moved over depths");
    tally t = {.name = "worst cases in depth ranges"}, chosen = {.name = "models of depth ranges"};
    for (int i = 0; i < 20 * VIEWS; i++) {
        const view *v = &views[i % VIEWS];
        dp_spec spec = spec_of(v, i % 3 ? oracle_unorm(16) : oracle_float(8, 23, 127));
        const double end = isinf(v->zfar) ? 1e4 * v->znear : v->zfar;
        const double z[2] = {rng_uniform(&r, v->znear, end), rng_uniform(&r, v->znear, end)};
        const double lo = fmin(z[0], z[1]), hi = fmax(z[0], z[1]);
        for (int computed = 0; computed < 2; computed++) {
            dp_setup setup;
            dp_worst worst;
            dp_separation_worst far;
            spec.model = computed ? DP_MODEL_FLOAT : DP_MODEL_EXACT;
            assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
            assert_int_equal(dp_worst_over(&setup, lo, hi, &worst), DP_OK);
            assert_int_equal(dp_separation_over(&setup, lo, hi, INFINITY, &far), DP_OK);
            for (int k = 0; k < SEEN; k++) {
                const double at = rng_uniform(&r, lo, hi), by = fmin(at * (1 + 1e-4), hi);
                const double error = fabs(dp_stored(&setup, dp_code(&setup, at)) - at);
                double run;
                TALLY(&t, computed || error <= worst.error * (1 + 1e-12), "%s: error %g, worst %g", v->name, error,
                      worst.error);
                TALLY(&t, dp_separation(&setup, at) <= far.bound, "%s: separation %g, worst %g", v->name,
                      dp_separation(&setup, at), far.bound);
                if (at <= by && dp_separation_runs(&setup, &at, &by, &run, 1) == DP_OK)
                    TALLY(&t, dp_separation(&setup, at) <= run && dp_separation(&setup, by) <= run,
                          "%s: separation in a run", v->name);
            }
            check_choice(&setup, v, z, &chosen);
        }
    }
    tally_end(&t);
    tally_end(&chosen);
}

/* ---- The pipeline ------------------------------------------------------------------------------------------------ */

/* The viewport's product and sum by hand, or one rounding of both. */
TEST(viewport_in_binary32) {
    rng r = rng_make("viewport");
    tally t = {.name = "viewport"};
    for (int i = 0; i < 20000; i++) {
        view v = views[rng_below(&r, VIEWS)];
        v.mapping = (dp_mapping)rng_below(&r, DP_MAPPING_GL_REVERSED + 1);
        rng_range(&r, v.range);
        dp_spec spec = spec_of(&v, oracle_float(8, 23, 127));
        spec.arith = rng_below(&r, dp_arith_count());
        dp_setup setup;
        dp_pipeline p;
        assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
        assert_int_equal(dp_pipeline_init(&p, &setup), DP_OK);
        spec.depth_range[0] = 0;
        spec.depth_range[1] = 1;
        assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
        const dp_arith_row *arith = dp_arith_get(spec.arith);
        const int half = !arith->remap && (v.mapping == DP_MAPPING_GL || v.mapping == DP_MAPPING_GL_REVERSED);
        dp_pipeline plain;
        assert_int_equal(dp_pipeline_init(&plain, &setup), DP_OK);
        plain.moved = 0; /* NDC as it is divided */
        const float z = (float)(v.znear < 0 ? rng_depth(&r, v.znear, v.zfar) : rng_log(&r, v.znear, 1e3 * v.znear));
        const float ndc = dp_pipeline_window(&plain, z), lo = (float)v.range[0], hi = (float)v.range[1];
        const float scale = half ? 0.5F * (hi - lo) : hi - lo,
                    offset = half ? (float)(0.5 * ((double)lo + (double)hi)) : lo;
        const float product = scale * ndc;
        const float want = arith->fused ? (float)fma((double)scale, (double)ndc, (double)offset) : product + offset;
        const float got = dp_pipeline_window(&p, z);
        /* A product of two binary32 numbers is exact in double; its sum with a third may be rounded twice. */
        TALLY(&t, got == want || (arith->fused && fabsf(got - want) <= 0x1p-24F * want), "%s, %g:%g: %a becomes %a",
              arith->name, v.range[0], v.range[1], (double)ndc, (double)got);
    }
    tally_end(&t);
}

/* The largest separation of a band, but for depths whose interval reaches into the next one, as test_guarantee has it.
 */
static double band_separation(const dp_setup *setup, double lo, double hi) {
    double most = 0;
    for (int i = 0; i <= 64; i++) {
        const double z = (double)(float)(lo + (hi - lo) * i / 64);
        const double s = z >= lo && z < hi ? dp_separation(setup, z) : 0;
        if (z + s < hi && s > most)
            most = s;
    }
    return most;
}

static double most_slack;

/* Every pair of depths from lo to hi. */
static void check_guarantee(const dp_setup *setup, double lo, double hi, bool whole, tally *violated, tally *loose) {
    census_result result;
    const census_request request = {.setup = setup, .lo = lo, .hi = hi, .bound = dp_separation};
    if (census_run(&request, &result) != CENSUS_DONE)
        return;
    for (int i = 0; i < result.band_count; i++) {
        const census_band *band = &result.bands[i];
        char text[256];
        oracle_describe(&setup->spec, text, sizeof text);
        TALLY(violated, !(band->slack > 1), "%s, %s: %.6g of the bound in %g..%g",
              dp_arith_get(setup->spec.arith)->name, text, band->slack, band->lo, band->hi);
        const double s = whole ? band_separation(setup, band->lo, band->hi) : 0;
        if (s == 0 || band->hi - band->lo < 4 * s)
            continue;
        const double step = (double)nextafterf((float)band->lo, HUGE_VALF) - (double)(float)band->lo;
        const double ratio = s / fmax(band->longest, step);
        most_slack = fmax(most_slack, ratio);
        TALLY(loose, ratio <= 4 * (1 + 1e-9), "%s, %s: %.6g is %.2f x %.6g in %g..%g",
              dp_arith_get(setup->spec.arith)->name, text, s, ratio, band->longest, band->lo, band->hi);
    }
}

static const char *const formats[] = {"unorm16", "unorm24", "fp32", "fp16"};

/* Random ranges, in stretches of some hundred thousand depths, and of some cameras every pair up to 8 near. */
TEST(guarantee) {
    rng r = rng_make("moved guarantee");
    tally violated = {.name = "guarantee in depth ranges"}, loose = {.name = "slack in depth ranges"};
    const uint64_t count = test_cases(30, 250, 1000);
    for (uint64_t i = 0; i < count; i++) {
        view v = views[rng_below(&r, VIEWS)];
        v.mapping = (dp_mapping)rng_below(&r, DP_MAPPING_GL_REVERSED + 1);
        rng_range(&r, v.range);
        dp_format f[2];
        dp_format_parse(formats[rng_below(&r, 4)], f);
        dp_spec spec = spec_of(&v, f[0]);
        spec.model = DP_MODEL_FLOAT;
        spec.arith = rng_below(&r, dp_arith_count());
        dp_setup setup;
        assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
        const bool whole = i % 20 == 0 && v.znear > 0;
        const double end = isinf(v.zfar) ? 1e4 * v.znear : v.zfar;
        const double lo = whole          ? v.znear
                          : v.znear <= 0 ? rng_depth(&r, v.znear, 0.999 * v.zfar)
                          : i % 3 == 0   ? v.znear
                                         : fmin(rng_log(&r, v.znear, end), 0.999 * end);
        const double stretch = whole ? 7 * lo : fmin(fabs(lo) * 0x1p-23 * 100000, end - lo);
        check_guarantee(&setup, lo, fmin(lo + stretch, end), whole, &violated, &loose);
    }
    printf("# at most %.2f times the longest pair that is not told apart\n", most_slack);
    tally_end(&violated);
    tally_end(&loose);
}
