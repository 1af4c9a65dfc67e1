/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/number.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/elementary.h"

/*
 * strtod and printf follow LC_NUMERIC, which stays "C" in a program that never calls setlocale. strtod alone is too
 * kind: it skips leading space, stops at the first thing it does not know, and reads "nan".
 */
bool number_parse(const char *text, number_kind kind, double *out) {
    const char *first = text + (*text == '+' || *text == '-');
    bool digit = (*first >= '0' && *first <= '9') || *first == '.';
    bool infinite = *first == 'i' || *first == 'I';
    if (!digit && !(infinite && kind == NUMBER_FAR && *text != '-'))
        return false;
    char *end;
    errno = 0;
    double value = strtod(text, &end);
    if (end == text || *end != '\0')
        return false;
    /* Too large, or too small for a double; a subnormal is fine although some C libraries flag it. */
    if (errno == ERANGE && (isinf(value) || value == 0.0))
        return false;
    *out = value;
    return true;
}

bool number_parse_part(const char *text, size_t length, number_kind kind, double *out) {
    char part[128]; /* no double needs more characters to be told apart from its neighbours */
    if (length >= sizeof part)
        return false;
    memcpy(part, text, length);
    part[length] = '\0';
    return number_parse(part, kind, out);
}

bool number_parse_count(const char *text, uint64_t max, uint64_t *out) {
    const size_t digits = strspn(text, "0123456789");
    errno = 0;
    const uint64_t value = strtoull(text, NULL, 10);
    if (digits == 0 || text[digits] != '\0' || errno == ERANGE || value > max)
        return false;
    *out = value;
    return true;
}

size_t number_count(uint64_t value, char out[NUMBER_SIZE]) {
    char reversed[20];
    size_t digits = 0;
    size_t length = 0;
    do
        reversed[digits++] = (char)('0' + value % 10);
    while ((value /= 10) > 0);
    while (digits > 0)
        out[length++] = reversed[--digits];
    out[length] = '\0';
    return length;
}

/*
 * The value is scaled by a power of ten to x in [1e16, 1e17), in fixed point with seven bits behind the point: its
 * 17 digits and a little more. The error of x is bounded (SLACK), so a decision is either certain or left to printf.
 * All errors are truncations: x lies in [scaled, scaled + SLACK].
 */
__extension__ typedef unsigned __int128 wide;

enum { POINT_BITS = 7, SLACK = 2 };

/*
 * m 2^e 10^k in fixed point, m < 2^53 and k <= 55: less than 2 below the truth, 1 for the last truncation and less than
 * 2^-50 for the others, each of 2^-121 relative.
 */
static uint64_t scale(uint64_t m, int e, int k) {
    wide product = m;
    for (; k > 0; k--, e++) {
        product *= 5;
        if (product >> 124 != 0) {
            product >>= 3;
            e += 3;
        }
    }
    const int shift = -(e + POINT_BITS);
    return shift >= 0 && shift < 128 ? (uint64_t)(product >> shift) : 0;
}

/* Like %g: the first digit of n, which has as many as are wanted, stands for 10^exponent; one more, a 0, is dropped. */
static size_t write_general(uint64_t n, int exponent, bool negative, char *out) {
    char text[NUMBER_SIZE];
    char *start = out;
    const int digits = (int)number_count(n, text);
    const bool scientific = exponent < -4 || exponent >= digits;
    int kept = digits;
    while (text[kept - 1] == '0')
        kept--;
    if (negative)
        *out++ = '-';
    /* Places left of the point first, from the first digit or from the 0 before it; a point only when more follow. */
    int place = scientific || exponent < 0 ? 0 : exponent;
    for (int i = scientific ? 0 : exponent - place; place >= 0 || i < kept; place--, i++) {
        if (place == -1)
            *out++ = '.';
        *out++ = i < 0 || i >= kept ? '0' : text[i];
    }
    *out = '\0';
    return (size_t)(out - start) + (scientific ? (size_t)snprintf(out, 8, "e%+03d", exponent) : 0);
}

size_t number_quick(double value, char out[NUMBER_SIZE]) {
    static const uint64_t least = 10000000000000000U; /* 1e16 */
    const double magnitude = fabs(value);
    if (!(magnitude >= 1e-38 && magnitude < 1e17))
        return 0;
    int exponent2;
    const uint64_t m = (uint64_t)ldexp(frexp(magnitude, &exponent2), 53);
    if ((m & (m - 1)) == 0) /* a power of two: its neighbour below is nearer, which the test below does not know */
        return 0;
    /* Next to a power of ten maybe wrong: then x is out of range. */
    const int exponent = (int)floor(dp_log10(magnitude));
    const uint64_t scaled = scale(m, exponent2 - 53, 16 - exponent);
    if (scaled < least << POINT_BITS || scaled + SLACK >= (least * 10) << POINT_BITS)
        return 0;
    const uint64_t half_ulp = scaled / (2 * m);
    uint64_t unit = (uint64_t)100 << POINT_BITS, limit = least / 10;
    for (int digits = 15; digits <= 17; digits++, unit /= 10, limit *= 10) {
        const uint64_t rest = scaled % unit, half = unit / 2;
        if (rest + SLACK >= half && rest <= half + SLACK)
            return 0; /* which way it rounds is not certain */
        const uint64_t n = scaled / unit + (rest > half);
        const uint64_t off = rest > half ? unit - rest : rest;
        const bool carried = n == limit; /* 9.99... became 10 */
        if (digits == 17 || off + SLACK < half_ulp)
            return write_general(n, exponent + carried, value < 0.0, out);
        if (off <= half_ulp + 1 + SLACK)
            return 0; /* whether it reads back is not certain */
    }
    return 0;
}

size_t number_shortest(double value, char out[NUMBER_SIZE]) {
    if (!isfinite(value))
        return (size_t)snprintf(out, NUMBER_SIZE, "%g", value);
    /* Small whole numbers are common (near, far, codes given as depths) and need no search. */
    if (fabs(value) < 1e9 && value == trunc(value)) {
        const size_t sign = value < 0.0;
        out[0] = '-';
        return sign + number_count((uint64_t)fabs(value), out + sign);
    }
    size_t quick = number_quick(value, out);
    if (quick > 0)
        return quick;
    for (int digits = 15;; digits++) {
        int length = snprintf(out, NUMBER_SIZE, "%.*g", digits, value);
        if (digits == 17 || strtod(out, NULL) == value)
            return (size_t)length;
    }
}

number_text number_of(double value, int digits) {
    number_text out = {"-"};
    if (!isnan(value))
        snprintf(out.text, sizeof out.text, "%.*g", digits, value + 0.0); /* -0 becomes 0 */
    return out;
}

number_text number_in(number_text number, const char *unit) {
    const size_t length = strlen(number.text);
    if (unit != NULL && strpbrk(number.text, "0123456789") != NULL) /* neither "inf" nor "-" */
        snprintf(number.text + length, sizeof number.text - length, " %s", unit);
    return number;
}

static number_text bound_of(double value, int digits, bool upward) {
    number_text out = number_of(value, digits);
    if (!isfinite(value) || value == 0.0)
        return out;
    if (value < 0.0) {
        snprintf(out.text, sizeof out.text, "-%.*s", NUMBER_SIZE - 2, bound_of(-value, digits, !upward).text);
        return out;
    }
    const double shown = strtod(out.text, NULL);
    /* Below a power of ten to which it was rounded, the last digit is that of the value. */
    const double unit = dp_pow(10.0, floor(dp_log10(upward ? shown : value)) - (digits - 1));
    return (upward ? shown < value : shown > value) ? number_of(shown + (upward ? unit : -unit), digits) : out;
}

number_text number_up(double value, int digits) {
    return bound_of(value, digits, true);
}

number_text number_down(double value, int digits) {
    return bound_of(value, digits, false);
}

number_text number_outward(double value, int digits) {
    return bound_of(value, digits, value > 0.0);
}

number_two number_compared(double value, double limit, int digits) {
    for (; digits < 17; digits++) {
        const number_two out = {number_up(value, digits), number_up(limit, digits)};
        if (!(value != limit && isfinite(value) && isfinite(limit)) || strcmp(out.value.text, out.limit.text) != 0)
            return out;
    }
    return (number_two){number_full(value), number_full(limit)}; /* by which any two doubles differ */
}

int number_digits_within(double at, double step, int least, int most) {
    if (!isfinite(at) || !isfinite(step) || at == 0.0 || step == 0.0)
        return least;
    const double digits = floor(dp_log10(fabs(at))) - floor(dp_log10(fabs(step))) + 2.0;
    return (int)fmin(fmax(digits, least), most);
}

number_text number_full(double value) {
    number_text out = {""};
    number_shortest(value, out.text);
    return out;
}

number_text number_brief(number_text number) {
    const double value = strtod(number.text, NULL);
    if (strncmp(number.text, "0.000", 5) == 0)
        snprintf(number.text, sizeof number.text, "%.*e", (int)strlen(number.text + strspn(number.text, "0.")) - 1,
                 value);
    char *exponent = strchr(number.text, 'e');
    const long power = exponent != NULL ? strtol(exponent + 1, NULL, 10) : 0;
    if (power > 0 && power < 6)
        snprintf(number.text, sizeof number.text, "%.0f", value);
    else if (exponent != NULL)
        snprintf(exponent, 8, "e%ld", power);
    return number;
}
