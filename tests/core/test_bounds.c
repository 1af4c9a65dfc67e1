/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Certified worst cases against the exhaustive sweep of all codes. */
#include "oracle.h"
#include "support.h"
#include "sweep.h"

static const double bound = 1e-12;

static int above_by_little(double got, const mpq_t want) {
    if (!isfinite(got))
        return 0;
    mpq_t x;
    mpq_init(x);
    mpq_set_d(x, got);
    int right = mpq_cmp(x, want) >= 0 && oracle_relative(got, want) <= bound;
    mpq_clear(x);
    return right;
}

/*
 * Whether the exact value of what the library named lies within the bound of the greatest without reaching it: worst
 * values that differ by less than the bound may change places. An exact tie may not: there the nearest is to be named.
 */
static int nearly_tied(const mpq_t value, const sweep_best *best) {
    mpq_t apart;
    mpq_init(apart);
    mpq_sub(apart, best->value, value);
    int tied = mpq_sgn(apart) > 0 && oracle_double(apart) <= bound * oracle_double(best->value);
    mpq_clear(apart);
    return tied;
}

/* The exact error of the code named at the depth named: the end of the cell or of the range that it stands for. */
static int error_nearly_tied(oracle *o, const dp_worst *got, const sweep_best *best) {
    oracle_cell cell;
    mpq_t end[4], value;
    oracle_cell_init(&cell);
    mpq_inits(end[0], end[1], end[2], end[3], value, NULL);
    oracle_cell_of(o, &cell, got->error_code);
    mpq_set(end[0], cell.lo);
    mpq_set(end[1], cell.hi);
    mpq_set_d(end[2], got->lo);
    mpq_set_d(end[3], isinf(got->hi) ? got->lo : got->hi);
    int tied = 0;
    for (int i = 0; i < 4; i++) {
        mpq_sub(value, cell.stored, end[i]);
        mpq_abs(value, value);
        tied |= oracle_relative(got->error_z, end[i]) <= bound && nearly_tied(value, best);
    }
    mpq_clears(end[0], end[1], end[2], end[3], value, NULL);
    oracle_cell_clear(&cell);
    return tied;
}

static void check_error(oracle *o, const dp_worst *got, const sweep_best *want, const char *text, tally *t) {
    if (want->infinite) {
        TALLY(t, isinf(got->error) && got->error > 0, "%s: error %g, should be infinite", text, got->error);
        TALLY(t, got->error_z >= oracle_double(want->z) * (1 - bound), "%s: error_z %g, nearer than %g", text,
              got->error_z, oracle_double(want->z));
        return;
    }
    double value = oracle_double(want->value);
    TALLY(t, above_by_little(got->error, want->value), "%s: error %.17g, should be %.17g (%.3g relative)", text,
          got->error, value, got->error / value - 1);
    int named = oracle_relative(got->error_z, want->z) <= bound &&
                (got->error_code == want->code || got->error_code == want->other);
    TALLY(t, named || error_nearly_tied(o, got, want), "%s: error of code %u at %.17g, should be of %u at %.17g", text,
          got->error_code, got->error_z, want->code, oracle_double(want->z));
}

static void check_interval(oracle *o, const dp_worst *got, const sweep *all, const char *text, tally *t) {
    const sweep_best *want = &all->interval;
    oracle_cell cell;
    mpq_t width;
    oracle_cell_init(&cell);
    mpq_init(width);
    oracle_cell_of(o, &cell, got->interval_code);
    TALLY(t, oracle_relative(got->interval_lo, cell.lo) <= bound, "%s: interval of code %u from %.17g, should be %.17g",
          text, got->interval_code, got->interval_lo, oracle_double(cell.lo));
    if (want->infinite) {
        TALLY(t, isinf(got->interval) && isinf(got->interval_hi), "%s: interval %g to %g, should be infinite", text,
              got->interval, got->interval_hi);
        TALLY(t, got->interval_code == want->code, "%s: interval code %u, should be %u", text, got->interval_code,
              want->code);
    } else {
        double value = oracle_double(want->value);
        TALLY(t, oracle_relative(got->interval_hi, cell.hi) <= bound,
              "%s: interval of code %u to %.17g, should be %.17g", text, got->interval_code, got->interval_hi,
              oracle_double(cell.hi));
        TALLY(t, above_by_little(got->interval, want->value), "%s: interval %.17g, should be %.17g (%.3g relative)",
              text, got->interval, value, got->interval / value - 1);
        mpq_sub(width, cell.hi, cell.lo);
        TALLY(t, got->interval_code == want->code || nearly_tied(width, want),
              "%s: interval of code %u at %.17g, should be of %u at %.17g", text, got->interval_code, got->interval_lo,
              want->code, oracle_double(want->z));
    }
    if (all->blind)
        TALLY(t, oracle_relative(got->blind_from, all->blind_from) <= bound, "%s: blind from %.17g, should be %.17g",
              text, got->blind_from, oracle_double(all->blind_from));
    else
        TALLY(t, isnan(got->blind_from), "%s: blind from %g, but no cell is unbounded", text, got->blind_from);
    mpq_clear(width);
    oracle_cell_clear(&cell);
}

static void check_worst(const dp_spec *spec, double lo, double hi, tally *t) {
    char camera_text[256], text[400];
    snprintf(text, sizeof text, "%s over %a .. %a", oracle_describe(spec, camera_text, sizeof camera_text), lo, hi);
    dp_setup setup;
    dp_worst got = {0};
    dp_status status = dp_setup_init(&setup, spec);
    if (status == DP_OK)
        status = dp_worst_over(&setup, lo, hi, &got);
    if (status != DP_OK)
        fail_msg("%s: %s", text, dp_status_text(status));
    oracle o;
    sweep want;
    oracle_init(&o, spec);
    sweep_init(&want);
    sweep_over(&want, &o, lo, hi);
    TALLY(t, got.lo == lo && got.hi == hi, "%s: the range comes back as %a .. %a", text, got.lo, got.hi);
    check_error(&o, &got, &want.error, text, t);
    check_interval(&o, &got, &want, text, t);
    sweep_clear(&want);
    oracle_clear(&o);
}

/* ---- fixed cameras: every kind ---- */

typedef struct camera {
    dp_mapping mapping;
    int ortho;
    double znear, zfar, log_c;
    dp_rounding rounding;
    double lo, hi; /* 0, 0: the whole range */
} camera;

static const camera cameras[] = {
    {DP_MAPPING_D3D, 0, 0.1, 1000, 1, DP_ROUND_NEAREST, 0, 0},
    {DP_MAPPING_REVERSED, 0, 0.1, 1000, 1, DP_ROUND_NEAREST, 0, 0},
    {DP_MAPPING_GL, 0, 0.01, 10000, 1, DP_ROUND_EVEN, 0.5, 432.1},
    {DP_MAPPING_GL_REVERSED, 0, 1, 1e9, 1, DP_ROUND_NEAREST, 17, 3e6},
    {DP_MAPPING_D3D, 0, 0.3, 77.7, 1, DP_ROUND_ZERO, 0, 0},
    {DP_MAPPING_D3D, 1, 0.1, 1000, 1, DP_ROUND_NEAREST, 0, 0},
    {DP_MAPPING_REVERSED, 1, 0.7, 333.3, 1, DP_ROUND_NEAREST, 1, 300},
    {DP_MAPPING_LINEAR, 0, 0.1, 1000, 1, DP_ROUND_NEAREST, 0, 0},
    {DP_MAPPING_LOG, 0, 0.1, 1e7, 1, DP_ROUND_NEAREST, 0, 0},
    {DP_MAPPING_LOG, 0, 1e-3, 1e5, 0.001, DP_ROUND_NEAREST, 0.7, 5e4},
    {DP_MAPPING_THREE_WEBGPU, 0, 0.1, 1e6, 1, DP_ROUND_NEAREST, 0, 0},
    {DP_MAPPING_CESIUM, 0, 2, 1e7, 1, DP_ROUND_NEAREST, 0, 0},
    {DP_MAPPING_CESIUM, 0, 1e12, 1e15, 1, DP_ROUND_NEAREST, 0, 0},
    {DP_MAPPING_CESIUM, 0, 1e12, 1.000001e12, 1000, DP_ROUND_EVEN, 0, 0},
    {DP_MAPPING_D3D, 0, 0.1, INFINITY, 1, DP_ROUND_NEAREST, 0.1, 5000},
    {DP_MAPPING_REVERSED, 0, 0.25, INFINITY, 1, DP_ROUND_NEAREST, 0.25, 1e6},
    {DP_MAPPING_D3D, 0, 1e-12, 1e18, 1, DP_ROUND_NEAREST, 1e-11, 1e-3},
    {DP_MAPPING_REVERSED, 0, 1e12, 1.00001e12, 1, DP_ROUND_NEAREST, 0, 0},
    {DP_MAPPING_REVERSED, 0, 100, 1e28, 1, DP_ROUND_NEAREST, 1e20, 1e28},
    {DP_MAPPING_D3D, 0, 1e-12, 1e28, 1, DP_ROUND_NEAREST, 0, 0},
    {DP_MAPPING_THREE_WEBGL, 0, 1e-6, 1e24, 1, DP_ROUND_NEAREST, 0, 0},
    {DP_MAPPING_CESIUM, 0, 0.1, 1e27, 1, DP_ROUND_NEAREST, 1e19, 1e27},
    {DP_MAPPING_LOG, 0, 1e-3, 1e28, 100, DP_ROUND_NEAREST, 0, 0},
};
enum { CAMERAS = sizeof cameras / sizeof *cameras };

static dp_spec spec_of(const camera *c, const dp_format *format) {
    dp_spec spec = dp_spec_default();
    spec.mapping = c->mapping;
    spec.ortho = c->ortho;
    spec.znear = c->znear;
    spec.zfar = c->zfar;
    spec.log_c = c->log_c;
    spec.rounding = c->rounding;
    spec.format = *format;
    return spec;
}

static void sweep_format(const dp_format *format, tally *t) {
    for (int i = 0; i < CAMERAS; i++) {
        const camera *c = &cameras[i];
        dp_spec spec = spec_of(c, format);
        check_worst(&spec, c->lo > 0 ? c->lo : c->znear, c->hi > 0 ? c->hi : c->zfar, t);
    }
}

TEST(sweep_small) {
    tally t = {.name = "fp16, unorm16 and small formats"};
    const dp_format formats[] = {oracle_float(5, 10, 15), oracle_unorm(16),       oracle_unorm(1),
                                 oracle_unorm(4),         oracle_float(3, 3, 5),  oracle_float(3, 3, 3),
                                 oracle_float(2, 1, 1),   oracle_float(8, 4, 200)};
    for (size_t i = 0; i < sizeof formats / sizeof *formats; i++)
        sweep_format(&formats[i], &t);
    tally_end(&t);
}

static void sweep_unorm24(void **state) {
    (void)state;
    tally t = {.name = "unorm24"};
    dp_format format = oracle_unorm(24);
    sweep_format(&format, &t);
    tally_end(&t);
}

static void sweep_fp32(void **state) {
    (void)state;
    tally t = {.name = "fp32"};
    dp_format format = oracle_float(8, 23, 127);
    sweep_format(&format, &t);
    tally_end(&t);
}

/* ---- random cameras and ranges ---- */

TEST(random_ranges) {
    rng r = rng_make("bounds");
    tally t = {.name = "random cameras and ranges"};
    uint64_t count = test_cases(60, 600, 10000);
    for (uint64_t i = 0; i < count; i++) {
        dp_spec spec = dp_spec_default();
        int kind = (int)rng_below(&r, DP_MAPPING_COUNT + 8) - 8; /* all mappings, 4 orthographic, 4 infinite */
        spec.mapping = (dp_mapping)(kind >= 0 ? kind : kind >= -4 ? kind + 4 : kind + 8);
        spec.ortho = kind < -4;
        spec.rounding = (dp_rounding)rng_below(&r, DP_ROUNDING_COUNT);
        spec.znear = rng_below(&r, 2) ? rng_log(&r, 0.01, 10) : rng_log(&r, 1e-12, 1e12);
        spec.zfar =
            rng_below(&r, 2) ? spec.znear * rng_log(&r, 2, 1e6) : spec.znear * (1 + rng_log(&r, 1.0001e-6, 1e30));
        if (kind >= -4 && kind < 0)
            spec.zfar = INFINITY;
        if (spec.ortho && rng_below(&r, 2))
            rng_planes(&r, &spec.znear, &spec.zfar);
        const int either_sign = spec.znear <= 0;
        if (spec.mapping <= DP_MAPPING_GL_REVERSED && rng_below(&r, 3) == 0)
            rng_range(&r, spec.depth_range);
        spec.log_c = rng_below(&r, 2) ? 1 : rng_log(&r, 1e-6, 1e6);
        spec.zfar = isinf(spec.zfar) ? INFINITY : fmin(spec.zfar, most_far(&spec));
        int e = 2 + (int)rng_below(&r, 7), pick = (int)rng_below(&r, 6);
        if (pick < 2)
            spec.format = oracle_unorm(pick == 0 ? 16 : 1 + (int)rng_below(&r, 20));
        else if (pick < 4)
            spec.format = oracle_float(5, 10, 15);
        else if (pick == 4)
            spec.format = oracle_float(e, 1 + (int)rng_below(&r, 12), 1 + (int)rng_below(&r, (1u << e) - 1));
        else
            spec.format = oracle_float(8, 23, 127);
        double zfar = isinf(spec.zfar) ? spec.znear * 1e9 : spec.zfar;
        double lo = either_sign ? rng_depth(&r, spec.znear, zfar) : rng_log(&r, spec.znear, zfar);
        double hi = either_sign ? rng_depth(&r, spec.znear, zfar) : rng_log(&r, spec.znear, zfar);
        const double size = either_sign ? zfar - spec.znear : lo;
        if (spec.format.bits > 24) { /* a short range of a long format */
            hi = fmin(zfar, lo + size * rng_log(&r, 1e-9, either_sign ? 1e-6 : 1e-2));
        } else {
            switch (rng_below(&r, 6)) {
            case 0:
                lo = spec.znear;
                hi = zfar;
                break;
            case 1:
                hi = lo;
                break;
            case 2: /* within a cell or a few */
                hi = fmin(zfar, lo + size * rng_log(&r, 1e-15, 1e-3));
                break;
            case 3:
                hi = spec.zfar;
                break;
            default:
                break;
            }
        }
        if (either_sign && lo == hi && (lo == spec.znear || lo == spec.zfar))
            continue; /* nothing is off there, and the sweep names no place */
        check_worst(&spec, fmin(lo, hi), fmax(lo, hi), &t);
    }
    tally_end(&t);
}

TEST(infinite_range) {
    tally t = {.name = "infinite range"};
    const dp_format formats[] = {oracle_float(5, 10, 15), oracle_unorm(16), oracle_unorm(24), oracle_float(8, 23, 127)};
    for (int i = 0; i < 4; i++) {
        for (int m = DP_MAPPING_D3D; m <= DP_MAPPING_GL_REVERSED; m++) {
            dp_setup setup;
            dp_worst got;
            dp_spec spec = dp_spec_default();
            spec.mapping = (dp_mapping)m;
            spec.format = formats[i];
            spec.zfar = INFINITY;
            assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
            assert_int_equal(dp_worst_over(&setup, spec.znear, INFINITY, &got), DP_OK);
            uint32_t last = m >= DP_MAPPING_REVERSED ? 0 : formats[i].code_max;
            oracle o;
            oracle_cell cell;
            oracle_init(&o, &spec);
            oracle_cell_init(&cell);
            oracle_cell_of(&o, &cell, last);
            TALLY(&t, isinf(got.error) && isinf(got.interval) && isinf(got.interval_hi), "%s %d: not infinite",
                  formats[i].name, m);
            TALLY(&t, got.error_code == last && got.interval_code == last, "%s %d: codes %u and %u", formats[i].name, m,
                  got.error_code, got.interval_code);
            TALLY(&t, oracle_relative(got.blind_from, cell.lo) <= bound && got.interval_lo == got.blind_from,
                  "%s %d: blind from %g, cell from %g", formats[i].name, m, got.blind_from, got.interval_lo);
            oracle_cell_clear(&cell);
            oracle_clear(&o);
        }
    }
    tally_end(&t);
}

int main(void) {
    if (test_effort() != EFFORT_QUICK)
        list_test((struct CMUnitTest)cmocka_unit_test(sweep_unorm24));
    if (test_effort() == EFFORT_FULL)
        list_test((struct CMUnitTest)cmocka_unit_test(sweep_fp32));
    return run_listed(NULL, NULL);
}
