/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reference values, and results of the literature that the library must reproduce; each names its source. */
#include "depthprec/depthprec.h"
#include "support.h"

/* ---- helpers ---- */

/* One unit of the last digit that is written: "9.7e-5" gives 1e-6. */
static double printed_unit(const char *text) {
    const char *point = strchr(text, '.'), *exponent = strpbrk(text, "eE");
    int places = 0, power = exponent ? atoi(exponent + 1) : 0;
    for (const char *p = point ? point + 1 : ""; *p >= '0' && *p <= '9'; p++)
        places++;
    return pow(10, power - places);
}

/* Fails unless got is the written figure to within `units` of its last digit. */
static void as_printed(const vector_row *row, int column, double got, double units) {
    double want = vector_number(row, column), unit = printed_unit(vector_text(row, column));
    if (!(fabs(got - want) <= units * unit * (1 + 1e-6)))
        fail_msg("%s:%d: column %d: %.15g, published %s", row->file, row->line, column + 1, got, row->field[column]);
}

static int is_given(const vector_row *row, int column) {
    return strcmp(vector_text(row, column), "-") != 0;
}

static dp_setup make(const char *format, const char *mapping, double znear, double zfar) {
    dp_format formats[2];
    dp_spec spec = dp_spec_default();
    dp_setup setup;
    if (dp_format_parse(format, formats) == 0)
        fail_msg("no format %s", format);
    spec.format = formats[0];
    assert_int_equal(dp_mapping_parse(mapping, &spec.mapping), DP_OK);
    spec.znear = znear;
    spec.zfar = zfar;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    return setup;
}

static dp_sample sample(const dp_setup *setup, double z) {
    dp_sample s;
    assert_int_equal(dp_sample_at(setup, z, &s), DP_OK);
    return s;
}

static dp_worst worst(const dp_setup *setup) {
    dp_worst w;
    assert_int_equal(dp_worst_over(setup, setup->spec.znear, setup->spec.zfar, &w), DP_OK);
    return w;
}

/* ---- reference values ---- */

static void reference_row(const vector_row *row, void *context) {
    (void)context;
    dp_setup setup = make(vector_text(row, 0), vector_text(row, 1), 0.1, 1000);
    dp_sample s = sample(&setup, vector_number(row, 2));
    assert_codes(s.code, (uint32_t)vector_number(row, 3));
    as_printed(row, 4, s.error, 0.5);
    as_printed(row, 5, s.interval, 0.5);
}

static void worst_row(const vector_row *row, void *context) {
    (void)context;
    dp_setup setup = make(vector_text(row, 0), vector_text(row, 1), 0.1, 1000);
    dp_worst w = worst(&setup);
    as_printed(row, 2, w.error, 0.5);
    as_printed(row, 4, w.interval, 0.5);
    if (is_given(row, 3))
        assert_codes(w.error_code, (uint32_t)vector_number(row, 3));
    if (is_given(row, 5))
        assert_codes(w.interval_code, (uint32_t)vector_number(row, 5));
    if (is_given(row, 6))
        as_printed(row, 6, w.interval_lo, 0.5);
}

TEST(reference_values) {
    vectors_read("reference.txt", reference_row, NULL);
    vectors_read("worst.txt", worst_row, NULL);
}

/* The example of depthprec.h. */
TEST(header_example) {
    dp_setup setup = make("unorm24", "d3d", 0.1, 1000);
    dp_sample s = sample(&setup, 10);
    assert_codes(s.code, 16611104);
    assert_scene(s.interval, 5.96e-05, 0.005e-05);
}

/* ---- literature ---- */

static void outerra_row(const vector_row *row, void *context) {
    (void)context;
    dp_setup setup = make("unorm24", "log", 0.1, 1e7);
    setup.spec.log_c = vector_number(row, 0);
    assert_int_equal(dp_setup_init(&setup, &setup.spec), DP_OK);
    as_printed(row, 2, dp_separation(&setup, vector_number(row, 1)), 1);
}

TEST(outerra_log_depth) {
    vectors_read("outerra.txt", outerra_row, NULL);
}

/*
 * "Quantitative Analysis of Z-Buffer Precision", 2020, https://zero-radiance.github.io/post/z-buffer/: reversed,
 * near 0.1 m, far 10 km.
 */
TEST(zero_radiance) {
    dp_setup fp32 = make("fp32", "reversed", 0.1, 1e4), unorm24 = make("unorm24", "reversed", 0.1, 1e4);
    assert_scene(dp_format_value(&fp32.spec.format, 700000000), 8.22242e-14, 0.000005e-14);
    assert_scene(dp_stored(&fp32, 700000000), 9999.9999, 0.00005);
    /* over 90 % of the codes of 24 bits lie within the first metre */
    double share = (double)(unorm24.spec.format.code_max - dp_code(&unorm24, 1)) / unorm24.spec.format.code_max;
    assert_true(share > 0.9);
    assert_scene(share, 0.9, 0.0001);
    /* below a millimetre everywhere */
    dp_worst w = worst(&fp32);
    assert_scene(w.interval, 0.2926e-3, 0.00005e-3);
    assert_scene(w.interval_lo, 5672, 0.5);
}

static void count_row(const vector_row *row, void *context) {
    (void)context;
    dp_format format[2];
    assert_true(dp_format_parse(vector_text(row, 0), format) == 1);
    uint32_t lo = dp_format_encode(format, DP_ROUND_NEAREST, vector_number(row, 1));
    uint32_t hi = dp_format_encode(format, DP_ROUND_NEAREST, vector_number(row, 2));
    assert_true(dp_format_value(format, lo) == vector_number(row, 1));
    assert_true(dp_format_value(format, hi) == vector_number(row, 2));
    assert_codes(hi - lo, (uint32_t)vector_number(row, 4)); /* the same whichever end is open */
}

TEST(counts) {
    vectors_read("counts.txt", count_row, NULL);
}

/* The greatest error near z: the widest distance from a stored depth within the cell, in percent of far. */
static double percent_of_far(const dp_setup *setup, double z) {
    dp_cell cell = dp_cell_of(setup, dp_code(setup, z));
    return 100 / setup->spec.zfar *
           fmax(fabs(dp_error(setup, cell.code, cell.lo)), fabs(dp_error(setup, cell.code, cell.hi)));
}

static void pettineo_row(const vector_row *row, void *context) {
    (void)context;
    dp_setup setup = make("fp16", "linear", 1, 101);
    setup.spec.rounding = DP_ROUND_ZERO;
    assert_int_equal(dp_setup_init(&setup, &setup.spec), DP_OK);
    double z = vector_number(row, 0), truncated = percent_of_far(&setup, z);
    as_printed(row, 1, truncated, 0.5);
    setup.spec.rounding = DP_ROUND_NEAREST;
    assert_int_equal(dp_setup_init(&setup, &setup.spec), DP_OK);
    assert_relative(percent_of_far(&setup, z), truncated / 2, 1e-9);
}

TEST(pettineo_linear) {
    vectors_read("pettineo.txt", pettineo_row, NULL);
    /* 16 bit UNORM: half a step is 0.000763 %, published as a bound of 0.00076 */
    dp_setup setup = make("unorm16", "linear", 1, 101);
    assert_scene(100 / 101.0 * worst(&setup).error, 0.00076, 0.000005);
}

/* ---- statements that do not hold ---- */

/* "98 % of the range is spent on the first 2 %" at far/near = 1000: it is 95.1 %. */
TEST(not_98_percent) {
    dp_setup setup = make("fp32", "d3d", 1, 1000);
    double share = dp_window(&setup, 20);
    assert_true(share < 0.98);
    assert_scene(share, 0.951, 0.0005);
    assert_true(dp_eye(&setup, 0.98, 0.02) > 40); /* 98 % reaches 4.8 % of the way */
}

/* "The last 10 % of codes cover 90 % of the range" for the camera of zero_radiance(): they reach 6 % of it. */
TEST(not_90_percent) {
    dp_setup setup = make("fp32", "reversed", 0.1, 1e4);
    double max = setup.spec.format.code_max, normal = 0x800000; /* the first code that is not subnormal */
    double with = dp_stored(&setup, (uint32_t)(max * 0.9));
    double without = dp_stored(&setup, (uint32_t)(normal + (max - normal) * 0.9));
    assert_true(with < 0.1 * 1e4);
    assert_scene(with, 593, 0.5);
    assert_scene(without, 553, 0.5);
}

/* A shadow map of D16 from 0 to 500 has one step everywhere: 500/65535. */
TEST(shadow_map) {
    dp_spec spec = make("unorm16", "d3d", 0.1, 500).spec;
    dp_setup setup;
    spec.ortho = 1;
    spec.znear = 0;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    for (int z = 10; z < 500; z += 10) {
        dp_sample sample;
        assert_int_equal(dp_sample_at(&setup, z, &sample), DP_OK);
        assert_relative(sample.interval, 500.0 / 65535.0, 1e-13);
        assert_relative(sample.separation, 500.0 / 65535.0, 1e-12);
    }
    dp_worst worst;
    assert_int_equal(dp_worst_over(&setup, 0, 500, &worst), DP_OK);
    assert_relative(worst.error, 250.0 / 65535.0, 1e-12);
}
