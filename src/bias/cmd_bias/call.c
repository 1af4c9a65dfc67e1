/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bias/cmd_bias/call.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/append.h"
#include "report/number.h"

enum { DIGITS_UNITS = 9, DIGITS_SHORT = 4 };

double bias_signed(const dp_setup *setup, double units) {
    return isinf(units) ? (double)NAN : units * bias_sign(setup) + 0.0; /* no -0 */
}

/* The letters U and F where they are words. */
static void fill_in(bias_call_text *out, const char *form, const char *units, const char *factor) {
    for (const char *c = form; *c != '\0'; c++) {
        const bool word = (c == form || !isalnum((unsigned char)c[-1])) && !isalnum((unsigned char)c[1]);
        if (word && (*c == 'U' || *c == 'F'))
            append(out->text, BIAS_CALL_SIZE, "%s", *c == 'U' ? units : factor);
        else
            append(out->text, BIAS_CALL_SIZE, "%c", *c);
    }
}

bias_call_text bias_call_of(const bias_api *api, const char *units, const char *factor) {
    bias_call_text out = {""};
    fill_in(&out, api->call, units, factor);
    if (strcmp(factor, "0") != 0)
        fill_in(&out, api->sloped, units, factor);
    return out;
}

/* Whole numbers in all their digits; a window depth as a float needs it. */
bias_call_text bias_call(const bias_api *api, double units, double factor) {
    const number_text text = units == nearbyint(units) ? number_full(units) : number_outward(units, DIGITS_UNITS);
    return bias_call_of(api, text.text, number_full(factor).text);
}

number_text bias_short(double units) {
    const bool whole = units == nearbyint(units) && fabs(units) < 1e9;
    return whole ? number_full(units) : number_outward(units, DIGITS_SHORT);
}
