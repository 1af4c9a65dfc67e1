/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bias/unit.h"

#include <math.h>

enum { BINARY32_LOWEST = -126 };

int bias_exponent_of(const dp_format *format, double d) {
    const bool is_float = format->kind == DP_FORMAT_FLOAT;
    const int lowest = is_float ? 1 - format->bias : BINARY32_LOWEST;
    const double held = (double)(float)d;
    int e = lowest + 1;
    if (held > 0.0)
        (void)frexp(held, &e);
    return e - 1 > lowest ? e - 1 : lowest;
}

double bias_worth(const bias_api *api, const dp_format *format, int e) {
    const bool is_float = format->kind == DP_FORMAT_FLOAT;
    switch (is_float ? api->real : api->unorm) {
    case BIAS_CODE:
        return (double)(float)(1.0 / (double)format->code_max);
    case BIAS_POWER:
    case BIAS_BOUND:
    case BIAS_FREE:
        return ldexp(1.0, -format->bits);
    case BIAS_EXPONENT:
        return ldexp(1.0, e + (api->exponent == BIAS_EXPONENT_NEXT) - format->mantissa_bits);
    case BIAS_MANTISSA:
        return ldexp(1.0, -(format->mantissa_bits + 1));
    case BIAS_ONE:
        break;
    }
    return 1.0;
}

double bias_unit_least(const bias_api *api, const dp_format *format, int e) {
    return bias_worth(api, format, e) * (api->scale_least > 0.0 ? api->scale_least : 1.0);
}

bool bias_is_open(const bias_api *api, const dp_format *format) {
    return format->kind == DP_FORMAT_FLOAT && api->real == BIAS_EXPONENT && api->exponent == BIAS_EXPONENT_OPEN;
}

bias_unit bias_unit_at(const bias_api *api, const dp_format *format, double d) {
    const double least = bias_unit_least(api, format, bias_exponent_of(format, d));
    const bool is_unorm = format->kind == DP_FORMAT_UNORM;
    double most = least;
    if (is_unorm && api->unorm == BIAS_BOUND)
        most = 2.0 * least;
    else if (is_unorm && api->unorm == BIAS_FREE)
        most = (double)INFINITY;
    else if (bias_is_open(api, format))
        most = 2.0 * least;
    return (bias_unit){least, api->scale_least > 0.0 ? most * (api->scale_most / api->scale_least) : most};
}
