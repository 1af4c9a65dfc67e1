/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The doors: what is refused, with which status, and that nothing is written then. */
#include <ctype.h>

#include "oracle.h"
#include "support.h"

static void refuse(const dp_spec *spec, dp_status want, int line) {
    unsigned char before[sizeof(dp_setup)];
    dp_setup setup;
    memset(&setup, 0xA5, sizeof setup);
    memcpy(before, &setup, sizeof setup);
    dp_status got = dp_setup_init(&setup, spec);
    char text[256];
    if (got != want)
        fail_msg("line %d: status %d (%s), should be %d (%s): %s", line, got, dp_status_text(got), want,
                 dp_status_text(want), spec ? oracle_describe(spec, text, sizeof text) : "null");
    if (memcmp(before, &setup, sizeof setup) != 0)
        fail_msg("line %d: the set-up was written to in spite of %s", line, dp_status_text(got));
}

static void accept_spec(const dp_spec *spec, int line) {
    dp_setup setup;
    dp_status got = dp_setup_init(&setup, spec);
    char text[256];
    if (got != DP_OK)
        fail_msg("line %d: refused: %s: %s", line, dp_status_text(got), oracle_describe(spec, text, sizeof text));
    assert_memory_equal(&setup.spec.znear, &spec->znear, sizeof spec->znear);
    assert_memory_equal(&setup.spec.zfar, &spec->zfar, sizeof spec->zfar);
}

#define REFUSE(want, ...)                                                                                              \
    do {                                                                                                               \
        dp_spec spec = dp_spec_default();                                                                              \
        __VA_ARGS__;                                                                                                   \
        refuse(&spec, want, __LINE__);                                                                                 \
    } while (0)
#define ACCEPT(...)                                                                                                    \
    do {                                                                                                               \
        dp_spec spec = dp_spec_default();                                                                              \
        __VA_ARGS__;                                                                                                   \
        accept_spec(&spec, __LINE__);                                                                                  \
    } while (0)

TEST(defaults) {
    dp_spec spec = dp_spec_default();
    assert_true(spec.znear == 0.1 && spec.zfar == 1000 && spec.ortho == 0 && spec.log_c == 1);
    assert_true(spec.mapping == DP_MAPPING_D3D && spec.rounding == DP_ROUND_NEAREST && spec.model == DP_MODEL_EXACT);
    assert_string_equal(spec.format.name, "fp32");
    accept_spec(&spec, __LINE__);
}

TEST(near_plane) {
    static const double bad[] = {0.0, -0.0, -0.1, -INFINITY, INFINITY, NAN, 1e-13, 1e13, -1e300, 0x1p-1074};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        REFUSE(DP_ERROR_NEAR, spec.znear = bad[i]; spec.zfar = INFINITY);
    REFUSE(DP_ERROR_NEAR, spec.znear = nextafter(1e-12, 0));
    REFUSE(DP_ERROR_NEAR, spec.znear = nextafter(1e12, INFINITY); spec.zfar = 1e18);
    ACCEPT(spec.znear = 1e-12);
    ACCEPT(spec.znear = 1e12; spec.zfar = 1e18);
}

TEST(far_plane) {
    static const double bad[] = {0.0, -1.0, -INFINITY, NAN, 0.05, 0.1, 1e29, 0x1p-1074};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        REFUSE(DP_ERROR_FAR, spec.zfar = bad[i]);
    REFUSE(DP_ERROR_FAR, spec.zfar = nextafter(1e28, INFINITY));
    ACCEPT(spec.zfar = 1e28);
    REFUSE(DP_ERROR_FAR, spec.znear = 1e12; spec.zfar = nextafter(1e18, INFINITY));
    REFUSE(DP_ERROR_FAR, spec.znear = 1e6; spec.zfar = 1.01e24);
    ACCEPT(spec.znear = 1e6; spec.zfar = 0.99e24);
    REFUSE(DP_ERROR_FAR, spec.mapping = DP_MAPPING_LOG; spec.log_c = 1e3; spec.zfar = 1.01e27);
    ACCEPT(spec.mapping = DP_MAPPING_LOG; spec.log_c = 1e3; spec.zfar = 0.99e27);
    REFUSE(DP_ERROR_FAR, spec.mapping = DP_MAPPING_THREE_WEBGPU; spec.znear = 1e-6; spec.zfar = 1.01e24);
    ACCEPT(spec.mapping = DP_MAPPING_THREE_WEBGPU; spec.znear = 1e-6; spec.zfar = 0.99e24);
    REFUSE(DP_ERROR_ORTHO_FAR, spec.ortho = 1; spec.zfar = nextafter(1e18, INFINITY));
    REFUSE(DP_ERROR_FAR, spec.zfar = 1.7976931348623157e308);
    ACCEPT(spec.zfar = 1e18);
    ACCEPT(spec.zfar = INFINITY);
    ACCEPT(spec.znear = 1e-12; spec.zfar = 1e18);
}

TEST(too_close) {
    REFUSE(DP_ERROR_PLANES, spec.znear = 1; spec.zfar = nextafter(1, 2));
    REFUSE(DP_ERROR_PLANES, spec.znear = 1; spec.zfar = 1 + 0.99e-6);
    REFUSE(DP_ERROR_PLANES, spec.znear = 1e-12; spec.zfar = 1e-12 * (1 + 0.99e-6));
    REFUSE(DP_ERROR_PLANES, spec.znear = 1e12; spec.zfar = 1e12 * (1 + 0.99e-6));
    ACCEPT(spec.znear = 1; spec.zfar = 1 + 1.01e-6);
    ACCEPT(spec.znear = 1e-12; spec.zfar = 1e-12 * (1 + 1.01e-6));
    ACCEPT(spec.znear = 1e12; spec.zfar = 1e12 * (1 + 1.01e-6));
}

TEST(infinite_far) {
    static const dp_mapping perspective[] = {DP_MAPPING_D3D, DP_MAPPING_GL, DP_MAPPING_REVERSED,
                                             DP_MAPPING_GL_REVERSED};
    for (int i = 0; i < 4; i++) {
        ACCEPT(spec.mapping = perspective[i]; spec.zfar = INFINITY);
        ACCEPT(spec.mapping = perspective[i]; spec.ortho = 1);
        REFUSE(DP_ERROR_INFINITE, spec.mapping = perspective[i]; spec.zfar = INFINITY; spec.ortho = 1);
    }
    REFUSE(DP_ERROR_INFINITE, spec.mapping = DP_MAPPING_LINEAR; spec.zfar = INFINITY);
    REFUSE(DP_ERROR_INFINITE, spec.mapping = DP_MAPPING_LOG; spec.zfar = INFINITY);
    ACCEPT(spec.mapping = DP_MAPPING_LINEAR);
    ACCEPT(spec.mapping = DP_MAPPING_LOG);
}

TEST(orthographic) {
    REFUSE(DP_ERROR_ORTHO, spec.mapping = DP_MAPPING_LINEAR; spec.ortho = 1);
    REFUSE(DP_ERROR_ORTHO, spec.mapping = DP_MAPPING_LOG; spec.ortho = 1);
    ACCEPT(spec.ortho = -1);
}

/* What a refusal recommends is accepted, and it leaves out nothing that is. */
TEST(mappings_that_are_named) {
    static const dp_status refused[] = {DP_ERROR_ORTHO, DP_ERROR_INFINITE, DP_ERROR_WINDOW};
    for (size_t i = 0; i < sizeof refused / sizeof refused[0]; i++)
        for (int m = 0; m < DP_MAPPING_COUNT; m++) {
            const char *const name = dp_mapping_get((dp_mapping)m)->name, *const text = dp_status_text(refused[i]);
            dp_spec spec = dp_spec_default();
            dp_setup setup;
            bool named = false;
            spec.mapping = (dp_mapping)m;
            spec.ortho = refused[i] == DP_ERROR_ORTHO;
            spec.zfar = refused[i] == DP_ERROR_INFINITE ? (double)INFINITY : 1000;
            spec.depth_range[1] = refused[i] == DP_ERROR_WINDOW ? 0.5 : 1;
            for (const char *at = text; (at = strstr(at, name)) != NULL; at++)
                named = named || (at[-1] == ' ' && strchr(",", at[strlen(name)]) != NULL);
            const dp_status status = dp_setup_init(&setup, &spec);
            assert_true(status == DP_OK || status == refused[i]);
            if (named != (status == DP_OK))
                fail_msg("%s is %snamed in: %s", name, named ? "" : "not ", text);
        }
}

/* Near and far of an orthographic camera: 0 or of either sign, but not so small that exact products lose bits. */
TEST(orthographic_planes) {
    static const double near_bad[] = {-INFINITY, INFINITY, NAN, 1e-13, -1e-13, 0x1p-1074, -0x1p-1074, -1.1e12, 1.1e12};
    static const double far_bad[] = {-INFINITY, NAN, -100, -101, 1e-13, -1e-13, 0x1p-1074, 1.1e18};
    static const double far_good[] = {-99, -1, -1e-12, 0, 1e-12, 1, 100, 1e18};
    for (size_t i = 0; i < sizeof near_bad / sizeof *near_bad; i++)
        REFUSE(DP_ERROR_ORTHO_NEAR, spec.ortho = 1; spec.znear = near_bad[i]; spec.zfar = 1e18);
    for (size_t i = 0; i < sizeof far_bad / sizeof *far_bad; i++)
        REFUSE(DP_ERROR_ORTHO_FAR, spec.ortho = 1; spec.znear = -100; spec.zfar = far_bad[i]);
    for (size_t i = 0; i < sizeof far_good / sizeof *far_good; i++)
        ACCEPT(spec.ortho = 1; spec.znear = -100; spec.zfar = far_good[i]);
    REFUSE(DP_ERROR_INFINITE, spec.ortho = 1; spec.znear = -100; spec.zfar = INFINITY);
    REFUSE(DP_ERROR_INFINITE, spec.ortho = 1; spec.znear = 0; spec.zfar = INFINITY);
    REFUSE(DP_ERROR_PLANES, spec.ortho = 1; spec.znear = -1; spec.zfar = -1 + 0.99e-6);
    ACCEPT(spec.ortho = 1; spec.znear = -1; spec.zfar = -1 + 1.01e-6);
    REFUSE(DP_ERROR_ORTHO_FAR, spec.ortho = 1; spec.znear = 0; spec.zfar = nextafter(1e-12, 0));
    REFUSE(DP_ERROR_ORTHO_FAR, spec.ortho = 1; spec.znear = 0; spec.zfar = 0);
    ACCEPT(spec.ortho = 1; spec.znear = 0; spec.zfar = 1e-12);
    ACCEPT(spec.ortho = 1; spec.znear = -1e12; spec.zfar = -1e11);
    ACCEPT(spec.ortho = 1; spec.znear = -1e-12; spec.zfar = 1e18);
    REFUSE(DP_ERROR_ORTHO, spec.ortho = 1; spec.znear = -1; spec.mapping = DP_MAPPING_LOG);
    REFUSE(DP_ERROR_NEAR, spec.znear = -1);
    /* -0 is 0, in what is printed too */
    dp_spec zeros = dp_spec_default();
    dp_setup setup;
    zeros.ortho = 1;
    zeros.znear = -0.0;
    assert_int_equal(dp_setup_init(&setup, &zeros), DP_OK);
    assert_false(signbit(setup.spec.znear));
    zeros.znear = -1;
    zeros.zfar = -0.0;
    assert_int_equal(dp_setup_init(&setup, &zeros), DP_OK);
    assert_false(signbit(setup.spec.zfar));
}

TEST(log_constant) {
    static const double bad[] = {0.0, -1.0, 1e-13, 1e13, NAN, INFINITY, -INFINITY};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        REFUSE(DP_ERROR_LOG_C, spec.mapping = DP_MAPPING_LOG; spec.log_c = bad[i]);
        ACCEPT(spec.log_c = bad[i]); /* read for log only */
    }
    ACCEPT(spec.mapping = DP_MAPPING_LOG; spec.log_c = 1e-12);
    ACCEPT(spec.mapping = DP_MAPPING_LOG; spec.log_c = 1e12);
}

TEST(bad_rows) {
    REFUSE(DP_ERROR_MAPPING, spec.mapping = DP_MAPPING_COUNT);
    REFUSE(DP_ERROR_MAPPING, spec.mapping = (dp_mapping)-1);
    REFUSE(DP_ERROR_ROUNDING, spec.rounding = DP_ROUNDING_COUNT);
    REFUSE(DP_ERROR_ROUNDING, spec.rounding = (dp_rounding)-1);
    REFUSE(DP_ERROR_MODEL, spec.model = DP_MODEL_COUNT);
    REFUSE(DP_ERROR_MODEL, spec.model = (dp_model)-1);
    REFUSE(DP_ERROR_ARITH, spec.arith = (dp_arith)-1);
    REFUSE(DP_ERROR_ARITH, spec.arith = (dp_arith)1000000);
    REFUSE(DP_ERROR_MODEL, spec.model = DP_MODEL_FLOAT; spec.mapping = DP_MAPPING_LINEAR);
    REFUSE(DP_ERROR_MODEL, spec.model = DP_MODEL_FLOAT; spec.mapping = DP_MAPPING_LOG);
    REFUSE(DP_ERROR_FORMAT, memset(&spec.format, 0, sizeof spec.format));
    REFUSE(DP_ERROR_FORMAT, memset(&spec.format, 0xFF, sizeof spec.format));
    REFUSE(DP_ERROR_FORMAT, spec.format.kind = (dp_format_kind)2);
    REFUSE(DP_ERROR_FORMAT, spec.format = oracle_unorm(16); spec.format.bits = 0);
    REFUSE(DP_ERROR_FORMAT, spec.format = oracle_unorm(16); spec.format.bits = 33);
    REFUSE(DP_ERROR_FORMAT, spec.format = oracle_unorm(16); spec.format.code_max = 65536);
    REFUSE(DP_ERROR_FORMAT, spec.format.mantissa_bits = 24);
    REFUSE(DP_ERROR_FORMAT, spec.format.exponent_bits = 9);
    REFUSE(DP_ERROR_FORMAT, spec.format.bias = 0);
    REFUSE(DP_ERROR_FORMAT, spec.format.code_max++);
    /* 1 has the exponent field `bias`, which `exponent_bits` bits must hold. */
    for (int e = 2; e <= 8; e++)
        for (int bias = (1 << e) - 2; bias <= (1 << e) + 1; bias++) {
            dp_spec spec = dp_spec_default();
            spec.format = oracle_unorm(16);
            spec.format.kind = DP_FORMAT_FLOAT;
            spec.format.bits = e + 10;
            spec.format.exponent_bits = e;
            spec.format.mantissa_bits = 10;
            spec.format.bias = bias;
            spec.format.code_max = (uint32_t)bias << 10;
            if (bias < 1 << e)
                accept_spec(&spec, __LINE__);
            else
                refuse(&spec, DP_ERROR_FORMAT, __LINE__);
        }
}

TEST(null_pointers) {
    dp_setup setup;
    dp_spec spec = dp_spec_default();
    refuse(NULL, DP_ERROR_NULL, __LINE__);
    assert_int_equal(dp_setup_init(NULL, &spec), DP_ERROR_NULL);
    assert_int_equal(dp_setup_init(NULL, NULL), DP_ERROR_NULL);
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    dp_sample sample;
    dp_worst worst;
    assert_int_equal(dp_sample_at(NULL, 1, &sample), DP_ERROR_NULL);
    assert_int_equal(dp_sample_at(&setup, 1, NULL), DP_ERROR_NULL);
    assert_int_equal(dp_worst_over(NULL, 1, 2, &worst), DP_ERROR_NULL);
    assert_int_equal(dp_worst_over(&setup, 1, 2, NULL), DP_ERROR_NULL);
}

TEST(depths) {
    static const double bad[] = {0.0, -1.0, NAN, INFINITY, -INFINITY, 0x1p-1074, 1e300};
    dp_setup setup;
    dp_spec spec = dp_spec_default();
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    double more[] = {nextafter(0.1, 0), nextafter(1000, INFINITY)};
    for (size_t i = 0; i < 9; i++) {
        double z = i < 7 ? bad[i] : more[i - 7];
        dp_sample sample;
        unsigned char before[sizeof sample];
        memset(&sample, 0x5A, sizeof sample);
        memcpy(before, &sample, sizeof sample);
        assert_int_equal(dp_sample_at(&setup, z, &sample), DP_ERROR_DEPTH);
        assert_memory_equal(before, &sample, sizeof sample);
    }
    dp_sample sample;
    assert_int_equal(dp_sample_at(&setup, 0.1, &sample), DP_OK);
    assert_int_equal(dp_sample_at(&setup, 1000, &sample), DP_OK);
}

TEST(ranges) {
    double below = nextafter(0.1, 0), above = nextafter(1000, INFINITY);
    const double bad[][2] = {{2, 1},         {below, 1},    {1, above},    {NAN, 1},   {1, NAN},
                             {NAN, NAN},     {1, INFINITY}, {INFINITY, 1}, {-1, 1},    {0, 1},
                             {-INFINITY, 1}, {2000, 3000},  {0.01, 0.02},  {1000, 0.1}};
    dp_setup setup;
    dp_spec spec = dp_spec_default();
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        dp_worst worst;
        unsigned char before[sizeof worst];
        memset(&worst, 0x5A, sizeof worst);
        memcpy(before, &worst, sizeof worst);
        dp_status got = dp_worst_over(&setup, bad[i][0], bad[i][1], &worst);
        if (got != DP_ERROR_RANGE)
            fail_msg("range %g .. %g gives status %d", bad[i][0], bad[i][1], got);
        assert_memory_equal(before, &worst, sizeof worst);
    }
    dp_worst worst;
    assert_int_equal(dp_worst_over(&setup, 0.1, 1000, &worst), DP_OK);
    assert_int_equal(dp_worst_over(&setup, 5, 5, &worst), DP_OK);
}

TEST(texts) {
    for (int i = 0; i < DP_STATUS_COUNT; i++) {
        const char *text = dp_status_text((dp_status)i);
        assert_non_null(text);
        size_t length = strlen(text);
        assert_true(length > 0);
        assert_true(text[length - 1] != '.');
        assert_null(strchr(text, '\n'));
        for (int k = 0; k < i; k++)
            assert_string_not_equal(text, dp_status_text((dp_status)k));
    }
    assert_non_null(dp_status_text(DP_STATUS_COUNT));
    assert_non_null(dp_status_text((dp_status)-1));
    assert_non_null(dp_status_text((dp_status)1000000));
    assert_string_equal(dp_model_name(DP_MODEL_EXACT), "exact");
    for (int i = 0; i < DP_MODEL_COUNT; i++)
        assert_non_null(dp_model_name((dp_model)i));
    assert_null(dp_model_name(DP_MODEL_COUNT));
    assert_null(dp_model_name((dp_model)-1));
    char numbers[32];
    snprintf(numbers, sizeof numbers, "%d.%d.%d", DP_VERSION_MAJOR, DP_VERSION_MINOR, DP_VERSION_PATCH);
    assert_string_equal(numbers, DP_VERSION);
    assert_string_equal(dp_version(), DP_VERSION);
}

/* The numbers that a sentence names are where the door is: they pass, and what lies just beyond does not. */
TEST(limits_in_sentences) {
    double least, most, share;
    assert_int_equal(sscanf(dp_status_text(DP_ERROR_NEAR), "near must be from %lf to %lf", &least, &most), 2);
    ACCEPT(spec.znear = least);
    ACCEPT(spec.znear = most; spec.zfar = 2 * most);
    REFUSE(DP_ERROR_NEAR, spec.znear = nextafter(least, 0));
    REFUSE(DP_ERROR_NEAR, spec.znear = nextafter(most, INFINITY); spec.zfar = 2 * most);
    double always, product;
    assert_int_equal(sscanf(strstr(dp_status_text(DP_ERROR_FAR), "at most"),
                            "at most %lf, or %lf with near x far and C x far at most %lf", &always, &most, &product),
                     3);
    ACCEPT(spec.znear = product / always; spec.zfar = always);
    REFUSE(DP_ERROR_FAR, spec.znear = product / always; spec.zfar = nextafter(always, INFINITY));
    ACCEPT(spec.zfar = most);
    REFUSE(DP_ERROR_FAR, spec.zfar = nextafter(most, INFINITY));
    assert_int_equal(sscanf(strstr(dp_status_text(DP_ERROR_PLANES), "at least"), "at least %lf", &share), 1);
    ACCEPT(spec.znear = 1; spec.zfar = 1 + share * (1 + 1e-9));
    REFUSE(DP_ERROR_PLANES, spec.znear = 1; spec.zfar = 1 + share * (1 - 1e-9));
    assert_int_equal(sscanf(strstr(dp_status_text(DP_ERROR_LOG_C), "from"), "from %lf to %lf", &least, &most), 2);
    ACCEPT(spec.mapping = DP_MAPPING_LOG; spec.log_c = least);
    ACCEPT(spec.mapping = DP_MAPPING_LOG; spec.log_c = most);
    REFUSE(DP_ERROR_LOG_C, spec.mapping = DP_MAPPING_LOG; spec.log_c = nextafter(least, 0));
    REFUSE(DP_ERROR_LOG_C, spec.mapping = DP_MAPPING_LOG; spec.log_c = nextafter(most, INFINITY));
}
