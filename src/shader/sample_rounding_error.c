/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How far depths can be off in 1/z or z: one by one for any grain, in closed form where cells are even in these. */
#include "shader/sample_rounding.h"

enum { BLOCK = 256 };

double grain_range_error(const dp_setup *setup, double stored, double lo, double hi, double reading) {
    if (setup->spec.ortho)
        return fmax(stored - lo, hi - stored) + reading * fabs(stored);
    const double w = 1 / stored; /* 0 at an infinite far plane */
    return fmax(1 / lo - w, w - 1 / hi) + reading * w;
}

double grain_error_of(const dp_setup *setup, const grain *g, double z, double reading) {
    const grain_range own = grain_range_of(setup, g, dp_code(setup, z));
    const double at[3] = {z, own.lo, own.hi};
    double worst = 0;
    for (int i = 0; i < 3; i++) {
        const uint32_t code = dp_code(setup, at[i]);
        const grain_range range = grain_range_of(setup, g, code);
        worst = fmax(worst, grain_range_error(setup, dp_stored(setup, code), range.lo, range.hi, reading));
    }
    return worst;
}

/* ---- In closed form ---------------------------------------------------------------------------------------------- */

/* Half a cell of window depths from 2^-k up. */
static double half_of(const dp_spec *spec, const grain *g, int k) {
    const dp_format *format = &spec->format;
    const double own = spec->rounding == DP_ROUND_ZERO ? 1 : 0.5;
    if (format->kind == DP_FORMAT_FLOAT)
        return own * ldexp(1, (k < format->bias ? -k : 1 - format->bias) - format->mantissa_bits);
    return (own + (g != NULL ? grain_quotient_codes(g, format, ldexp(1, -k)) : 0)) / format->code_max;
}

bool grain_bound_init(grain_bound *out, const dp_setup *setup, const grain *g, double reading) {
    const dp_spec *spec = &setup->spec;
    const bool codes = g == NULL || g->kind == GRAIN_CODES;
    const bool numbers = !codes && g->kind == GRAIN_FLOATS && g->buffer && spec->format.kind == DP_FORMAT_UNORM;
    if (!(codes || numbers) || setup->ranged || !(setup->curve == DP_CURVE_PERSPECTIVE || spec->ortho))
        return false;
    const double start = spec->ortho ? setup->anchor : 1 / spec->znear, end = spec->ortho ? spec->zfar : 1 / spec->zfar;
    const double zero = setup->reversed ? end : start, one = setup->reversed ? start : end;
    const double least = spec->ortho ? spec->znear : end, most = spec->ortho ? spec->zfar : start;
    const double width = copysign(setup->kappa, one - zero);
    const double slack = DP_ROUNDINGS_6; /* outweighs the roundings of quantities and of window depths */
    *out = (grain_bound){.zero = zero,
                         .per = 1 / width,
                         .least = least - slack * fabs(least),
                         .most = most + slack * fabs(most),
                         .reading = reading,
                         .stretch = 1 + slack,
                         .more = slack * fabs(zero / width)};
    if (spec->format.kind == DP_FORMAT_FLOAT)
        out->stretch += ldexp(1, -1 - spec->format.mantissa_bits);
    if (numbers) { /* v <= depth + (1 + 1/2)/M + what grain_quotient_codes() has, of which v 2^(1 - bits) is a part */
        out->stretch += 2 * grain_quotient_units(g) * ldexp(1, 1 - g->bits);
        out->more += 2 * (1.5 / spec->format.code_max + grain_quotient_units(g) * g->least);
    }
    for (int k = 0; k < GRAIN_BINADES; k++)
        out->half[k] = half_of(spec, numbers ? g : NULL, k) * setup->kappa * GRAIN_OUTWARD;
    return true;
}

/* ---- One by one -------------------------------------------------------------------------------------------------- */

/* A depth's error is its code's. */
static void one_by_one(const dp_setup *setup, const grain *g, const double *z, const uint32_t *codes, size_t count,
                       double reading, grain_memo *memo, double *out) {
    for (size_t i = 0; i < count; i++) {
        const size_t slot = codes[i] % GRAIN_MEMO;
        if (!(z[i] >= setup->spec.znear && z[i] <= setup->spec.zfar))
            continue; /* many are beyond the planes at borders */
        if (memo == NULL || memo->code[slot] != codes[i] + 1) {
            out[i] = grain_error_of(setup, g, z[i], reading);
            if (memo == NULL)
                continue;
            memo->code[slot] = codes[i] + 1;
            memo->error[slot] = out[i];
        }
        out[i] = memo->error[slot];
    }
}

void grain_errors_of(const dp_setup *setup, const grain *g, const double *z, size_t count, double reading,
                     grain_memo *memo, double *out) {
    dp_batch batch;
    dp_batch_init(&batch, setup, DP_TASK_CODE, DP_REAL_DOUBLE, DP_WORD_32, dp_path_best()); /* a checked set-up */
    for (size_t first = 0; first < count; first += BLOCK) {
        const size_t some = count - first < BLOCK ? count - first : BLOCK;
        uint32_t codes[BLOCK];
        dp_batch_run(&batch, z + first, codes, some);
        one_by_one(setup, g, z + first, codes, some, reading, memo, out + first);
    }
}
