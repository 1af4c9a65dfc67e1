/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Linear and logarithmic depth as code: one way each, there and back. What is proven: see depthprec-code(1). */
#include <math.h>
#include <string.h>

#include "code/code.h"
#include "core/append.h"
#include "core/bits.h"
#include "report/number.h"

/* ---- Rows -------------------------------------------------------------------------------------------------------- */

typedef struct curve_row {
    const char *back[2], *there[2]; /* constants, steps */
    const char *span;
} curve_row;

enum { ORTHO, ORTHO_REVERSED, LINEAR, LOG, LOG_FROM_NEAR, LOG_OVER_NEAR };

static const curve_row rows[] = {
    [ORTHO] = {.back = {"B = n; S = f - n", "z = B + S*d"}},
    [ORTHO_REVERSED] = {.back = {"B = f; S = n - f", "z = B + S*d"}},
    [LINEAR] = {.back = {"F = f", "z = F*d"}, .there = {"S = 1/f", "d = z*S"}},
    [LOG] = {.back = {"L = span; I = 1/scale", "x = d*L; e = exp2(x); z = (e - 1)*I"},
             .there = {"C = scale; K = 1/span", "y = C*z + 1; d = log2(y)*K"},
             .span = "log2(C*far + 1)"},
    [LOG_FROM_NEAR] = {.back = {"N = n; L = span; I = 1/scale", "x = d*L; e = exp2(x); z = N + (e - 1)*I"},
                       .there = {"N = n; C = scale; K = 1/span", "y = C*(z - N) + 1; d = log2(y)*K"},
                       .span = "log2(C*(far - near) + 1)"},
    [LOG_OVER_NEAR] = {.back = {"N = n; L = span", "x = d*L; e = exp2(x); z = N*e"},
                       .there = {"I = 1/n; K = 1/span", "y = z*I; d = log2(y)*K"},
                       .span = "log2(far/near)"},
};

static int kind_of(const dp_setup *setup) {
    const dp_mapping_row *mapping = dp_mapping_get(setup->spec.mapping);
    return setup->spec.ortho                 ? (setup->reversed ? ORTHO_REVERSED : ORTHO)
           : setup->curve == DP_CURVE_LINEAR ? LINEAR
           : mapping->log_over_near          ? LOG_OVER_NEAR
           : mapping->log_from_near          ? LOG_FROM_NEAR
                                             : LOG;
}

/* ---- Bounds ------------------------------------------------------------------------------------------------------ */

/* Over all window depths at once: what is absolute is largest where numbers are. */
static double linear_bound(const curve_row *row, const dp_setup *setup, const bound_arithmetic *how) {
    const bound_steps own = {.constants = {row->back[0], row->back[0]}, .steps = {row->back[1], row->back[1]}};
    bound_piece p = {.d = term_any(0, 1)};
    bound_walk w;
    dp_setup standard = *setup;
    standard.reversed = 0;
    if (how->flushes)
        p.d.off = (range){-0x1p-126, 0};
    bound_begin(&own, &standard, how, &w);
    const term z = bound_run(&w, &p);
    return fmax(-z.off.lo, z.off.hi) * DP_OUTWARD;
}

/* A product of factors 1 + e is at most 1 + t + t^2 for t the sum of the e, which is below 1; and what is flushed. */
static double together(double t) {
    return t * (1 + t) + 0x1p-100;
}

static double span_of(const dp_setup *setup) {
    return setup->log_hi / M_LN2;
}

double code_curve_back(const dp_setup *setup, const bound_arithmetic *how) {
    const double each = (how->rounding + 1) * DP_UNIT, span = span_of(setup);
    const int kind = kind_of(setup);
    const double power = M_LN2 * each * span + how->exp2[0] + how->exp2[1] * span + each;
    return kind < LOG              ? linear_bound(&rows[kind], setup, how)
           : how->exp2[0] == 0     ? (double)NAN
           : kind == LOG_OVER_NEAR ? together(power)
           : kind == LOG_FROM_NEAR ? together(power + each + how->rounding * DP_UNIT)
                                   : together(power + how->rounding * DP_UNIT);
}

double code_curve_there(const dp_setup *setup, const bound_arithmetic *how) {
    const double r = how->rounding, span = span_of(setup);
    const int kind = kind_of(setup);
    const double inside = kind == LOG             ? 1 + 2 * r
                          : kind == LOG_OVER_NEAR ? 1 + r
                                                  : 1 + 3 * r + setup->log_c * setup->spec.znear;
    if (kind == LINEAR)
        return together((1 + r) * DP_UNIT);
    return how->log2[0] == 0 ? (double)NAN
                             : together(inside * DP_UNIT * (1 + 0x1p-10) / (M_LN2 * span) +
                                        fmax(how->log2[0] / span, how->log2[1]) + (1 + r) * DP_UNIT);
}

/* ---- Functions --------------------------------------------------------------------------------------------------- */

code_said code_curve(output *out, const code_language *l, const dp_setup *setup, bool there, bool uniforms) {
    const int kind = kind_of(setup);
    const curve_row *row = &rows[kind];
    const code_claim claim = {there ? "window_depth" : "eye_depth",
                              (there ? code_curve_there : code_curve_back)(setup, &l->how),
                              (there ? code_curve_there : code_curve_back)(setup, &bound_nearest),
                              there                   ? "the range from 0 to 1"
                              : kind < LOG            ? "a scene unit"
                              : kind == LOG_OVER_NEAR ? "the depth"
                                                      : "the depth + 1/C"};
    code_body f = {
        .l = l,
        .name = claim.function,
        .inputs = {there ? "z" : "d"},
        .given = {.n = setup->spec.znear, .f = setup->spec.zfar, .scale = setup->log_c, .span = span_of(setup)},
        .span = row->span,
        .uniforms = uniforms};
    steps_read((there ? row->there : row->back)[0], &f.constants);
    steps_read((there ? row->there : row->back)[1], &f.steps);
    code_import(out, l);
    code_say_camera(out, l, setup, there ? "Window depth that a shader writes" : "Eye depth of a window depth");
    code_say_rules(out, l, kind >= LOG && l->powers != NULL);
    if (isnan(claim.bound))
        code_say(out, l, "It promises nothing of exp2 and log2: no bound.");
    else
        code_say(out, l, "So it is off by at most %s of %s.", number_up(claim.bound, 3).text, claim.of);
    code_say_depth(out, l, setup);
    code_function_of(out, &f, setup);
    return (code_said){.count = 1, .claims = {claim}};
}
