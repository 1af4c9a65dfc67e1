/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/number.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "report/shortest.h"

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

bool number_parse_count(const char *text, unsigned long max, unsigned long *out) {
    unsigned long value = 0;
    if (*text == '\0')
        return false;
    for (; *text != '\0'; text++) {
        if (*text < '0' || *text > '9')
            return false;
        unsigned long digit = (unsigned long)(*text - '0');
        if (digit > max || value > (max - digit) / 10)
            return false;
        value = 10 * value + digit;
    }
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

size_t number_shortest(double value, char out[NUMBER_SIZE]) {
    if (!isfinite(value))
        return (size_t)snprintf(out, NUMBER_SIZE, "%g", value);
    /* Small whole numbers are common (near, far, codes given as depths) and need no search. */
    if (fabs(value) < 1e9 && value == trunc(value)) {
        const size_t sign = value < 0.0;
        out[0] = '-';
        return sign + number_count((uint64_t)fabs(value), out + sign);
    }
    size_t quick = shortest_quick(value, out);
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

static number_text bound_of(double value, int digits, bool upward) {
    const number_text out = number_of(value, digits);
    if (!isfinite(value) || value <= 0.0)
        return out;
    const double shown = strtod(out.text, NULL);
    const double unit = pow(10.0, floor(log10(shown)) - (digits - 1));
    return (upward ? shown < value : shown > value) ? number_of(shown + (upward ? unit : -unit), digits) : out;
}

number_text number_up(double value, int digits) {
    return bound_of(value, digits, true);
}

number_text number_down(double value, int digits) {
    return bound_of(value, digits, false);
}

number_text number_full(double value) {
    number_text out = {""};
    number_shortest(value, out.text);
    return out;
}
