/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Formats: names, values of codes, rounding, and the claimed errors. */
#include <ctype.h>

#include "oracle.h"
#include "support.h"

/* ---- names ---- */

static void check_parse(const char *name, const char *want) {
    dp_format got[2];
    size_t count = dp_format_parse(name, got);
    for (size_t i = 0; i < count; i++) {
        if (strcmp(got[i].name, want) == 0)
            return;
    }
    fail_msg("'%s' gives %zu formats, none of them %s", name, count, want);
}

TEST(names_of_rows) {
    static const char *const want[] = {"fp16", "fp32", "unorm16", "unorm24"};
    assert_true(dp_format_count() >= 4);
    for (size_t i = 0; i < 4; i++)
        check_parse(want[i], want[i]);
    for (size_t i = 0; i < dp_format_count(); i++) {
        const dp_format_row *row = dp_format_get(i);
        assert_non_null(row);
        assert_non_null(row->note);
        assert_non_null(row->source);
        assert_true(strlen(row->source) > 0);
        char list[1024], lower[1024], upper[1024];
        snprintf(list, sizeof list, "%s %s", row->format.name, row->aliases ? row->aliases : "");
        assert_null(strstr(list, "  "));
        for (size_t k = 0; k <= strlen(list); k++) {
            lower[k] = (char)tolower((unsigned char)list[k]);
            upper[k] = (char)toupper((unsigned char)list[k]);
        }
        char *const spellings[] = {list, lower, upper};
        for (int k = 0; k < 3; k++) {
            char *rest = NULL;
            for (char *name = strtok_r(spellings[k], " ", &rest); name; name = strtok_r(NULL, " ", &rest))
                check_parse(name, row->format.name);
        }
    }
    assert_null(dp_format_get(dp_format_count()));
    assert_null(dp_format_get((size_t)-1));
}

/* Depth of a colour target: no row, and of no set-up but its own. */
TEST(rg_is_linear_and_nearest) {
    static const char *const names[] = {"rg", "EncodeFloatRG", "depthnormals", "_CameraDepthNormalsTexture"};
    dp_spec spec = dp_spec_default();
    dp_setup setup;
    dp_format found[2];
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        check_parse(names[i], "rg");
    for (size_t i = 0; i < dp_format_count(); i++)
        assert_string_not_equal(dp_format_get(i)->format.name, "rg");
    assert_int_equal(dp_format_parse("rg", found), 1);
    spec.format = found[0];
    for (int m = 0; m < DP_MAPPING_COUNT; m++)
        for (int r = 0; r < DP_ROUNDING_COUNT; r++) {
            spec.mapping = (dp_mapping)m;
            spec.rounding = (dp_rounding)r;
            const int fits = m == DP_MAPPING_LINEAR && r == DP_ROUND_NEAREST;
            assert_int_equal(dp_setup_init(&setup, &spec), fits ? DP_OK : DP_ERROR_FORMAT);
        }
}

static const char *const interface_names[][2] = {
    {"D16_UNORM", "unorm16"},
    {"D24_UNORM_S8_UINT", "unorm24"},
    {"X8_D24_UNORM_PACK32", "unorm24"},
    {"D32_SFLOAT", "fp32"},
    {"DXGI_FORMAT_D32_FLOAT", "fp32"},
    {"DEPTH_COMPONENT24", "unorm24"},
    {"depth32float", "fp32"},
    {"d16_unorm", "unorm16"},
    {"Depth32Float", "fp32"},
    {"d24_unorm_s8_uint", "unorm24"},
    {"FP16", "fp16"},
    {"d32", "fp32"},
    /* The depth formats of the headers of each API, but for depths of 15 and 32 bits and floats of 24. */
    {"VK_FORMAT_D16_UNORM", "unorm16"},
    {"VK_FORMAT_X8_D24_UNORM_PACK32", "unorm24"},
    {"VK_FORMAT_D32_SFLOAT", "fp32"},
    {"VK_FORMAT_D16_UNORM_S8_UINT", "unorm16"},
    {"VK_FORMAT_D24_UNORM_S8_UINT", "unorm24"},
    {"VK_FORMAT_D32_SFLOAT_S8_UINT", "fp32"},
    {"DXGI_FORMAT_D16_UNORM", "unorm16"},
    {"DXGI_FORMAT_D24_UNORM_S8_UINT", "unorm24"},
    {"DXGI_FORMAT_D32_FLOAT_S8X24_UINT", "fp32"},
    {"DXGI_FORMAT_R24G8_TYPELESS", "unorm24"},
    {"DXGI_FORMAT_R24_UNORM_X8_TYPELESS", "unorm24"},
    {"DXGI_FORMAT_R32G8X24_TYPELESS", "fp32"},
    {"DXGI_FORMAT_R32_FLOAT_X8X24_TYPELESS", "fp32"},
    {"D3DFMT_D16", "unorm16"},
    {"D3DFMT_D16_LOCKABLE", "unorm16"},
    {"D3DFMT_D24S8", "unorm24"},
    {"D3DFMT_D24X8", "unorm24"},
    {"D3DFMT_D24X4S4", "unorm24"},
    {"D3DFMT_D32F_LOCKABLE", "fp32"},
    {"MTLPixelFormatDepth16Unorm", "unorm16"},
    {"MTLPixelFormatDepth32Float", "fp32"},
    {"MTLPixelFormatDepth24Unorm_Stencil8", "unorm24"},
    {"MTLPixelFormatDepth32Float_Stencil8", "fp32"},
    {"depth24Unorm_stencil8", "unorm24"},
    {"depth32Float_stencil8", "fp32"},
    {"depth16unorm", "unorm16"},
    {"depth32float-stencil8", "fp32"},
    {"Depth32FloatStencil8", "fp32"},
    {"WGPUTextureFormat_Depth16Unorm", "unorm16"},
    {"WGPUTextureFormat_Depth32Float", "fp32"},
    {"WGPUTextureFormat_Depth32FloatStencil8", "fp32"},
    {"GL_DEPTH_COMPONENT16", "unorm16"},
    {"GL_DEPTH_COMPONENT24", "unorm24"},
    {"GL_DEPTH_COMPONENT32F", "fp32"},
    {"GL_DEPTH24_STENCIL8", "unorm24"},
    {"GL_DEPTH32F_STENCIL8", "fp32"},
    {"GL_DEPTH_COMPONENT24_OES", "unorm24"},
    {"GL_DEPTH24_STENCIL8_OES", "unorm24"},
    {"Unorm24", "unorm24"},
};

TEST(names_of_interfaces) {
    for (size_t i = 0; i < sizeof interface_names / sizeof *interface_names; i++) {
        dp_format got[2];
        assert_int_equal(dp_format_parse(interface_names[i][0], got), 1);
        assert_string_equal(got[0].name, interface_names[i][1]);
    }
    static const char *const choice[] = {"depth24plus",
                                         "DEPTH24PLUS",
                                         "Depth24Plus",
                                         "depth24plus-stencil8",
                                         "Depth24PlusStencil8",
                                         "WGPUTextureFormat_Depth24Plus",
                                         "WGPUTextureFormat_Depth24PlusStencil8"};
    for (size_t i = 0; i < sizeof choice / sizeof choice[0]; i++) {
        dp_format got[2];
        assert_int_equal(dp_format_parse(choice[i], got), 2);
        check_parse(choice[i], "unorm24");
        check_parse(choice[i], "fp32");
        assert_string_not_equal(got[0].name, got[1].name);
    }
}

static void same_format(const dp_format *got, const dp_format *want) {
    if (got->kind == want->kind && got->bits == want->bits && got->exponent_bits == want->exponent_bits &&
        got->mantissa_bits == want->mantissa_bits && got->bias == want->bias && got->code_max == want->code_max)
        return;
    fail_msg("%s has the numbers of another format than %s", got->name, want->name);
}

TEST(parametric_names) {
    char name[32];
    dp_format got[2], again[2], want;
    for (int bits = 1; bits <= 32; bits++) {
        snprintf(name, sizeof name, "unorm%d", bits);
        want = oracle_unorm(bits);
        assert_int_equal(dp_format_parse(name, got), 1);
        same_format(&got[0], &want);
        assert_string_equal(got[0].name, name);
    }
    for (int e = 2; e <= 8; e++) {
        for (int m = 1; m <= 23; m++) {
            for (int bias = 0; bias < 1 << e; bias++) {
                int written = snprintf(name, sizeof name, "float%d.%d", e, m);
                if (bias > 0)
                    snprintf(name + written, sizeof name - (size_t)written, "b%d", bias);
                want = oracle_float(e, m, bias > 0 ? bias : (1 << (e - 1)) - 1);
                assert_int_equal(dp_format_parse(name, got), 1);
                same_format(&got[0], &want);
                assert_int_equal(dp_format_parse(got[0].name, again), 1); /* the canonical name names it again */
                same_format(&again[0], &want);
            }
        }
    }
    assert_int_equal(dp_format_parse("UNORM8", got), 1);
    assert_int_equal(dp_format_parse("Float3.3B5", got), 1);
    assert_int_equal(got[0].code_max, 40);
}

TEST(rejected_names) {
    static const char *const name[] = {
        "",
        " ",
        "unorm",
        "unorm0",
        "unorm33",
        "unorm-1",
        "unorm24x",
        "unorm24 ",
        " unorm24",
        "unorm2.4",
        "unorm+8",
        "floaty",
        "float3",
        "float3.",
        "float1.3",
        "float9.3",
        "float3.0",
        "float3.24",
        "float3.3b0",
        "float3.3b8",
        "float3.3b",
        "float3.3b5x",
        "float3.3 ",
        "float.3",
        "float-3.3",
        "float3.-3",
        "float3.3b-1",
        "float8.23b256",
        "fp",
        "fp8",
        "fp33",
        "fp16 fp32",
        "d3d",
        "depth",
        "unorm99999999999",
        "float3.99999999999999",
        "float3.3b4294967301",
        "unorm4294967312",
        "D16_UNORM D24",
        "f",
        "fp1",
        "fp161",
    };
    for (size_t i = 0; i < sizeof name / sizeof *name; i++) {
        dp_format got[2];
        if (dp_format_parse(name[i], got) != 0)
            fail_msg("'%s' was taken for %s", name[i], got[0].name);
    }
    char lengthy[5000];
    memset(lengthy, '1', sizeof lengthy - 1);
    lengthy[sizeof lengthy - 1] = 0;
    memcpy(lengthy, "unorm", 5);
    dp_format got[2];
    assert_int_equal(dp_format_parse(lengthy, got), 0);
    assert_int_equal(dp_format_parse(NULL, got), 0);
    assert_int_equal(dp_format_parse("fp32", NULL), 0);
    assert_int_equal(dp_format_parse(NULL, NULL), 0);
}

TEST(rounding_names) {
    assert_string_equal(dp_rounding_name(DP_ROUND_NEAREST), "nearest");
    assert_string_equal(dp_rounding_name(DP_ROUND_EVEN), "even");
    assert_string_equal(dp_rounding_name(DP_ROUND_ZERO), "zero");
    assert_null(dp_rounding_name(DP_ROUNDING_COUNT));
    assert_null(dp_rounding_name((dp_rounding)-1));
}

/* ---- values ---- */

/* Whether v is the double nearest to code/m: |v m - code| <= m ulp/2, in integers. */
static int unorm_value_right(double v, uint64_t code, uint64_t m) {
    if (code == 0)
        return v == 0;
    int exponent;
    unsigned __int128 mantissa = (uint64_t)ldexp(frexp(v, &exponent), 53);
    int shift = 53 - exponent; /* v = mantissa 2^-shift */
    if (shift > 90)
        return 0;
    unsigned __int128 left = mantissa * m, right = (unsigned __int128)code << shift;
    unsigned __int128 apart = left > right ? left - right : right - left;
    return 2 * apart <= m;
}

static void check_codes(const dp_format *format, uint32_t from, uint32_t to, uint32_t stride, tally *values,
                        tally *trips) {
    mpq_t exact;
    mpq_init(exact);
    double before = -1;
    for (uint64_t c = from; c <= to; c += stride) {
        uint32_t code = (uint32_t)c;
        double v = dp_format_value(format, code);
        int right;
        if (format->kind == DP_FORMAT_UNORM) {
            right = unorm_value_right(v, code, format->code_max);
        } else if (format->exponent_bits == 8 && format->mantissa_bits == 23 && format->bias == 127) {
            float bits;
            memcpy(&bits, &code, sizeof bits);
            right = (double)bits == v;
        } else {
            oracle_value(exact, format, code);
            right = oracle_distance(v, exact) == 0;
        }
        TALLY(values, right && v > before, "%s value(%u) = %a after %a", format->name, code, v, before);
        before = v;
        for (int r = 0; r < DP_ROUNDING_COUNT; r++) {
            uint32_t got = dp_format_encode(format, (dp_rounding)r, v), want = code;
            if (r == DP_ROUND_ZERO && format->kind == DP_FORMAT_UNORM) /* v may have been rounded down below code/M */
                want = oracle_encode(format, DP_ROUND_ZERO, v);
            TALLY(trips, got == want && want + 1 >= code, "%s %s encode(value(%u)) = %u, should be %u", format->name,
                  dp_rounding_name((dp_rounding)r), code, got, want);
        }
    }
    mpq_clear(exact);
}

TEST(values) {
    tally right = {.name = "values"}, trips = {.name = "encode(value(code))"};
    dp_format format[2];
    static const char *const small[] = {"fp16",     "unorm16",    "unorm1",       "unorm2",       "unorm8",
                                        "float2.1", "float3.3b5", "float5.10b31", "float8.4b255", "float2.9b1"};
    for (size_t i = 0; i < sizeof small / sizeof *small; i++) {
        assert_int_equal(dp_format_parse(small[i], format), 1);
        check_codes(format, 0, format->code_max, 1, &right, &trips);
        assert_true(dp_format_value(format, 0) == 0);
        assert_true(dp_format_value(format, format->code_max) == 1);
    }
    assert_int_equal(dp_format_parse("unorm24", format), 1);
    check_codes(format, 0, format->code_max, (uint32_t)test_cases(4099, 13, 1), &right, &trips);
    assert_int_equal(dp_format_parse("unorm32", format), 1);
    check_codes(format, 0, format->code_max - 0x10000, 0xFFF1, &right, &trips);
    check_codes(format, format->code_max - 1000, format->code_max - 1, 1, &right, &trips);
    assert_int_equal(dp_format_parse("fp32", format), 1);
    check_codes(format, 0, format->code_max, (uint32_t)test_cases(1000003, 997, 1), &right, &trips);
    check_codes(format, 0, 20000, 1, &right, &trips);
    check_codes(format, 0x00800000 - 1000, 0x00800000 + 1000, 1, &right, &trips);
    check_codes(format, format->code_max - 20000, format->code_max, 1, &right, &trips);
    tally_end(&right);
    tally_end(&trips);
}

/* ---- rounding ---- */

static void check_encode(const dp_format *format, double d, tally *t) {
    for (int r = 0; r < DP_ROUNDING_COUNT; r++) {
        uint32_t got = dp_format_encode(format, (dp_rounding)r, d);
        uint32_t want = oracle_encode(format, (dp_rounding)r, d);
        TALLY(t, got == want, "%s %s encode(%a) = %u, should be %u", format->name, dp_rounding_name((dp_rounding)r), d,
              got, want);
    }
}

static void check_around(const dp_format *format, double d, tally *t) {
    check_encode(format, nextafter(nextafter(d, -1), -1), t);
    check_encode(format, nextafter(d, -1), t);
    check_encode(format, d, t);
    check_encode(format, nextafter(d, 2), t);
    check_encode(format, nextafter(nextafter(d, 2), 2), t);
}

TEST(encode) {
    static const char *const name[] = {"fp16",    "fp32",       "unorm16",  "unorm24",     "unorm1",       "unorm32",
                                       "unorm10", "float3.3b5", "float2.1", "float8.23b1", "float8.1b255", "float5.11"};
    static const double special[] = {
        0.0,      -0.0,     1.0,        0.5,       -1.0,    -0x1p-1074, 0x1p-1074, 0x1p-1022, 0x1.fffffffffffffp-1023,
        0x1p-149, 0x1p-150, 0x1.8p-150, 0x1p-151,  0x1p-24, 0x1p-25,    0x1.8p-25, 0x1p-126,  1.5,
        2.0,      1e300,    INFINITY,   -INFINITY, NAN,     0x1p-277,
    };
    rng random = rng_make("encode");
    tally t = {.name = "encode"};
    mpq_t boundary;
    mpq_init(boundary);
    for (size_t i = 0; i < sizeof name / sizeof *name; i++) {
        dp_format format[2];
        assert_true(dp_format_parse(name[i], format) >= 1);
        for (size_t k = 0; k < sizeof special / sizeof *special; k++)
            check_around(format, special[k], &t);
        uint64_t cases = test_cases(300, 20000, 200000);
        for (uint64_t k = 0; k < cases; k++) {
            uint32_t code = 1 + (uint32_t)rng_below(&random, format->code_max);
            /* boundaries of nearest: ties of a float are doubles; and values themselves, the boundaries of zero */
            oracle_boundary(boundary, format, DP_ROUND_NEAREST, code);
            check_around(format, oracle_double(boundary), &t);
            check_around(format, dp_format_value(format, code), &t);
            check_encode(format, rng_unit(&random), &t);
            check_encode(format, exp2(-200 * rng_unit(&random)), &t);
        }
    }
    mpq_clear(boundary);
    tally_end(&t);
}

/* ---- claims ---- */

/*
 * |value - d| against the claim, at the boundaries between codes, where it is largest, and at random. Some depth must
 * reach 0.9 of the claim, both where the relative part rules and where the absolute part does.
 */
TEST(claims) {
    rng random = rng_make("claims");
    mpq_t boundary, value, error;
    mpq_inits(boundary, value, error, NULL);
    for (size_t i = 0; i < dp_format_count(); i++) {
        const dp_format_row *row = dp_format_get(i);
        const dp_format *format = &row->format;
        double worst = 0, worst_relative = 0, worst_absolute = 0;
        uint64_t cases = test_cases(2000, 100000, 1000000);
        int all = format->code_max < 100000;
        for (uint64_t k = 1; k <= (all ? format->code_max : cases); k++) {
            uint32_t code = all ? (uint32_t)k : 1 + (uint32_t)rng_below(&random, format->code_max);
            if (!all && k < 1000)
                code = (uint32_t)k;
            oracle_boundary(boundary, format, DP_ROUND_NEAREST, code);
            double d = k & 1 ? oracle_double(boundary) : nextafter(oracle_double(boundary), 0);
            oracle_value(value, format, dp_format_encode(format, DP_ROUND_NEAREST, d));
            double off = oracle_distance(d, value);
            worst = fmax(worst, off / (row->claim_absolute + row->claim_relative * d));
            if (row->claim_relative * d > 1000 * row->claim_absolute)
                worst_relative = fmax(worst_relative, off / (row->claim_relative * d));
            if (row->claim_relative * d < 0.001 * row->claim_absolute)
                worst_absolute = fmax(worst_absolute, off / row->claim_absolute);
        }
        if (!(worst <= 1 + 0x1p-50))
            fail_msg("%s: error is %.6f of the claim", format->name, worst);
        if (!(worst >= 0.9))
            fail_msg("%s: the claim is far too big: only %.3f of it is reached", format->name, worst);
        if (row->claim_relative > 0 && !(worst_relative >= 0.9))
            fail_msg("%s: only %.3f of the relative claim is reached", format->name, worst_relative);
        if (row->claim_absolute > 0 && !(worst_absolute >= 0.9))
            fail_msg("%s: only %.3f of the absolute claim is reached", format->name, worst_absolute);
    }
    mpq_clears(boundary, value, error, NULL);
}
