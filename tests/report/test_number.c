/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers in and out: what is read, and that the quick shortest digits are those of printf and strtod. */
#include <float.h>

#include "report/number.h"
#include "support.h"

static const char *reference(double value, char out[64]) {
    for (int digits = 15; digits <= 17; digits++) {
        snprintf(out, 64, "%.*g", digits, value);
        if (strtod(out, NULL) == value)
            break;
    }
    return out;
}

static void same_as_reference(double value) {
    char got[NUMBER_SIZE];
    char want[64];
    size_t length = number_shortest(value, got);
    assert_string_equal(got, reference(value, want));
    assert_int_equal(length, strlen(got));
}

/* xorshift: the same numbers in every run. */
static uint64_t next(uint64_t *word) {
    *word ^= *word << 13;
    *word ^= *word >> 7;
    *word ^= *word << 17;
    return *word;
}

TEST(random_bits) {
    uint64_t word = 20140611;
    long quick = 0;
    long inside = 0;
    for (uint64_t i = test_cases(30000, 300000, 1000000); i > 0; i--) {
        uint64_t bits = next(&word);
        if (i % 2 == 0) /* half of them where the quick way works */
            bits = (bits & 0x800FFFFFFFFFFFFFU) | (897 + (bits >> 52) % 180) << 52;
        double value;
        char text[NUMBER_SIZE];
        memcpy(&value, &bits, sizeof value);
        if (!isfinite(value))
            continue;
        same_as_reference(value);
        inside += fabs(value) >= 1e-38 && fabs(value) < 1e17;
        quick += number_quick(value, text) > 0;
    }
    printf("# seed 20140611; the quick way served %ld of %ld\n", quick, inside);
    assert_true(quick > inside / 2);
}

/* Decimals as people type them, which need few digits, and their neighbours, which need seventeen. */
TEST(short_decimals) {
    uint64_t word = 7;
    for (uint64_t i = test_cases(10000, 100000, 400000); i > 0; i--) {
        char text[64];
        snprintf(text, sizeof text, "%de%d", (int)(next(&word) % 100000), (int)(next(&word) % 50) - 38);
        double value = strtod(text, NULL);
        same_as_reference(value);
        same_as_reference(nextafter(value, INFINITY));
        same_as_reference(0.0 - value); /* a zero stays without sign */
    }
}

TEST(edges) {
    for (int e = -320; e <= 308; e++) {
        char text[16];
        snprintf(text, sizeof text, "1e%d", e);
        double power = strtod(text, NULL);
        same_as_reference(power);
        same_as_reference(nextafter(power, 0.0));
        same_as_reference(nextafter(power, INFINITY));
    }
    for (int e = -1074; e < 1024; e++)
        same_as_reference(ldexp(1.0, e));
    same_as_reference(0.0);
    same_as_reference(DBL_MAX);
    same_as_reference(999999999.0);
    same_as_reference(1000000000.0);
    char text[NUMBER_SIZE];
    number_shortest(INFINITY, text);
    assert_string_equal(text, "inf");
}

TEST(reading) {
    static const struct {
        const char *text;
        number_kind kind;
        int good;
        double value;
    } cases[] = {
        {"1", NUMBER_FINITE, 1, 1.0},          {"+0.5", NUMBER_FINITE, 1, 0.5},
        {".5", NUMBER_FINITE, 1, 0.5},         {"-2e3", NUMBER_FINITE, 1, -2000.0},
        {"0x1p-3", NUMBER_FINITE, 1, 0.125},   {"0", NUMBER_FINITE, 1, 0.0},
        {"4e-320", NUMBER_FINITE, 1, 4e-320},  {"inf", NUMBER_FAR, 1, INFINITY},
        {"INFINITY", NUMBER_FAR, 1, INFINITY}, {"+inf", NUMBER_FAR, 1, INFINITY},
        {"inf", NUMBER_FINITE, 0, 0.0},        {"-inf", NUMBER_FAR, 0, 0.0},
        {"nan", NUMBER_FAR, 0, 0.0},           {"", NUMBER_FAR, 0, 0.0},
        {" 1", NUMBER_FINITE, 0, 0.0},         {"1 ", NUMBER_FINITE, 0, 0.0},
        {"1,5", NUMBER_FINITE, 0, 0.0},        {"1e400", NUMBER_FAR, 0, 0.0},
        {"1e-400", NUMBER_FINITE, 0, 0.0},     {"--1", NUMBER_FINITE, 0, 0.0},
        {"1e", NUMBER_FINITE, 0, 0.0},         {".", NUMBER_FINITE, 0, 0.0},
        {"0x", NUMBER_FINITE, 0, 0.0},         {"infx", NUMBER_FAR, 0, 0.0},
        {"- 1", NUMBER_FINITE, 0, 0.0},        {"+", NUMBER_FINITE, 0, 0.0},
        {"1\n", NUMBER_FINITE, 0, 0.0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        double value = -7.0;
        assert_int_equal(number_parse(cases[i].text, cases[i].kind, &value), cases[i].good);
        assert_true(value == (cases[i].good ? cases[i].value : -7.0));
    }
    uint64_t count = 0;
    assert_true(number_parse_count("1000000", 1000000, &count) && count == 1000000);
    assert_false(number_parse_count("1000001", 1000000, &count));
    assert_false(number_parse_count("99999999999999999999999999", 1000000, &count));
    assert_false(number_parse_count("", 10, &count));
    assert_false(number_parse_count("-1", 10, &count));
    assert_true(number_parse_count("007", 10, &count) && count == 7);
}

/* Digits of a value that is rounded up, or down: never on its other side, and no further off than a unit. */
TEST(rounded) {
    uint64_t word = 1965;
    for (uint64_t i = test_cases(10000, 100000, 400000); i > 0; i--) {
        const double value = ldexp((double)(next(&word) >> 11), (int)(next(&word) % 200) - 150);
        char nearest[64];
        snprintf(nearest, sizeof nearest, "%.4g", value); /* 9.9996 is 10, whose unit is the larger */
        const double unit = pow(10.0, floor(log10(strtod(nearest, NULL))) - 3);
        const double own = pow(10.0, floor(log10(value)) - 3);
        const double up = strtod(number_up(value, 4).text, NULL), down = strtod(number_down(value, 4).text, NULL);
        assert_true(up >= value && up <= value + 1.001 * unit);
        assert_true(down <= value && down >= value - 1.001 * own);
        assert_true(strlen(number_up(value, 4).text) <= strlen("1.234e-123"));
        assert_true(strtod(number_up(-value, 4).text, NULL) == -down &&
                    strtod(number_down(-value, 4).text, NULL) == -up);
    }
    assert_string_equal(number_outward(1.2301, 3).text, "1.24");
    assert_string_equal(number_outward(-1.2301, 3).text, "-1.24");
    assert_string_equal(number_outward(0.0, 3).text, "0");
    static const struct {
        double value;
        const char *up, *down, *nearest;
    } cases[] = {{1.2301, "1.24", "1.23", "1.23"},
                 {1.2399, "1.24", "1.23", "1.24"},
                 {9.999, "10", "9.99", "10"},
                 {1.25, "1.25", "1.25", "1.25"},
                 {0.0, "0", "0", "0"},
                 {-0.0, "0", "0", "0"},
                 {-1.2399, "-1.23", "-1.24", "-1.24"},
                 {INFINITY, "inf", "inf", "inf"},
                 {-INFINITY, "-inf", "-inf", "-inf"},
                 {NAN, "-", "-", "-"}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        assert_string_equal(number_up(cases[i].value, 3).text, cases[i].up);
        assert_string_equal(number_down(cases[i].value, 3).text, cases[i].down);
        assert_string_equal(number_of(cases[i].value, 3).text, cases[i].nearest);
    }
    assert_string_equal(number_in(number_of(1.25, 3), "cm").text, "1.25 cm");
    assert_string_equal(number_in(number_of(0, 3), "m").text, "0 m");
    assert_string_equal(number_in(number_of(1.25, 3), NULL).text, "1.25");
    assert_string_equal(number_in(number_of((double)INFINITY, 3), "cm").text, "inf");
    assert_string_equal(number_in(number_of((double)NAN, 3), "cm").text, "-");
    assert_string_equal(number_in(number_full(-2.2250738585072014e-308), "km").text, "-2.2250738585072014e-308 km");
}

/* Two that a sentence compares never have one text, or one that is in the other order, unless they are equal. */
TEST(compared) {
    uint64_t word = 1729;
    for (uint64_t i = test_cases(10000, 100000, 400000); i > 0; i--) {
        const double a = ldexp((double)(next(&word) >> 11), (int)(next(&word) % 200) - 150);
        const double b = a * (1 + ldexp((double)(next(&word) % 3) - 1, -(int)(next(&word) % 54)));
        const number_two two = number_compared(a, b, 6);
        const double x = strtod(two.value.text, NULL), y = strtod(two.limit.text, NULL);
        assert_true((x > y) - (x < y) == (a > b) - (a < b));
        assert_true(x >= a * (1 - 0x1p-50) && y >= b * (1 - 0x1p-50)); /* to 16 digits, themselves rounded */
    }
    const number_two near = number_compared(0.0090027845, 0.0090027849, 6), far = number_compared(1.5, 0.01, 6);
    assert_string_equal(near.value.text, "0.0090027845");
    assert_string_equal(near.limit.text, "0.0090027849");
    assert_string_equal(far.value.text, "1.5");
    assert_string_equal(far.limit.text, "0.01");
    assert_string_equal(number_compared((double)INFINITY, 0.01, 6).value.text, "inf");
    assert_string_equal(number_compared(0.25, (double)NAN, 6).value.text, "0.25");
}

/* Digits that show two of a step, and no more; at most so many, and so many where there is nothing to show. */
TEST(digits_within) {
    rng r = rng_make("digits within");
    for (int i = 0; i < 1000; i++) {
        const double at = rng_log(&r, 1e-6, 1e9), step = -at * rng_log(&r, 1e-12, 1);
        const int digits = number_digits_within(at, step, 1, 17);
        const double last = pow(10, floor(log10(at)) - digits + 1);
        if (!(10 * last <= -step * (1 + 1e-9) && 100 * last >= -step * (1 - 1e-9)))
            fail_msg("%d digits of %.17g, step %.17g", digits, at, -step);
    }
    assert_int_equal(number_digits_within(1, 1e-12, 3, 9), 9);
    assert_int_equal(number_digits_within(1, 10, 3, 9), 3);
    assert_int_equal(number_digits_within(0, 1, 3, 9), 3);
    assert_int_equal(number_digits_within(1, 0, 3, 9), 3);
    assert_int_equal(number_digits_within(INFINITY, 1, 3, 9), 3);
}
