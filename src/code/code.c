/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "code/code.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "core/append.h"
#include "core/bits.h"
#include "report/number.h"
#include "shader/position.h"

/* ---- What a language has ----------------------------------------------------------------------------------------- */

static bool calls(const method_row *row, const dp_setup *setup, const char *name) {
    return strstr(row->bound->steps[bound_variant(setup)], name) != NULL;
}

const char *code_lacks(const code_language *l, const method_row *row, const dp_setup *setup) {
    if (row->bound == NULL)
        return "is no formula of floating-point operations";
    if (row->bound->steps[0] == NULL)
        return "is no short formula";
    if (row->bound->steps[bound_variant(setup)] == NULL)
        return "knows the depth range 0 to 1 alone";
    if (calls(row, setup, "whole(") && l->whole == NULL)
        return "gives a whole number";
    if (isinf(setup->spec.zfar) && (row->domain & METHOD_INFINITE) == 0)
        return "needs a finite far plane";
    if (row->bound->wide && l->literal[1] == NULL)
        return "computes in binary64";
    if (calls(row, setup, "estimate("))
        return "begins with an instruction of x86 processors";
    if (calls(row, setup, "magic(") && l->magic == NULL)
        return "begins with the bits of a number";
    return calls(row, setup, "fma(") && l->fused == NULL ? "needs a product and a sum that are rounded once" : NULL;
}

/* The claim of a format, whose part above half a step, or a truncated code's above one, is of roundings to
 * nearest: see depthprec-code(1). */
static double encode_bound(const bound_arithmetic *how, const method_row *row, const dp_setup *setup) {
    size_t i = 0;
    while (i < encode_family.case_count && strcmp(encode_family.cases[i].format, setup->spec.format.name) != 0)
        i++;
    const bool speaks = i < encode_family.case_count && method_speaks(row, i);
    const double worst = speaks ? row->claims[i].worst : (double)NAN, own = worst < 1 ? 0.5 : 1;
    return own + how->rounding * (worst - own);
}

double code_bound(const code_language *l, const method_row *row, const dp_setup *setup) {
    return row->family == METHOD_ENCODE ? encode_bound(&l->how, row, setup) : bound_over(row->bound, setup, &l->how);
}

const method_row *code_best(const code_language *l, const method_family_row *family, const dp_setup *setup) {
    const method_row *best = NULL, *some = NULL;
    double least = (double)INFINITY;
    for (size_t i = 0; i < *family->method_count; i++) {
        const method_row *row = &family->methods[i];
        if (code_lacks(l, row, setup) != NULL)
            continue;
        const double bound = code_bound(l, row, setup);
        some = row;
        if (bound < least) {
            best = row;
            least = bound;
        }
    }
    return best != NULL ? best : some;
}

/* ---- Comments ---------------------------------------------------------------------------------------------------- */

enum { DIGITS_END = 9 }; /* of a binary32 number */

static void say_encode(output *out, const code_language *l, const method_row *row, const dp_setup *setup) {
    const double bound = code_bound(l, row, setup);
    code_say_rules(out, l, false);
    if (isnan(bound))
        code_say(out, l, "No bound is proven for this format.");
    else
        code_say(out, l, "So the code is off by at most %s of its steps, for any d from 0 to 1.",
                 number_up(bound, 6).text);
}

static void say_bound(output *out, const code_language *l, const method_row *row, const dp_setup *setup) {
    const double bound = code_bound(l, row, setup), nearest = bound_over(row->bound, setup, &bound_nearest);
    const double n = setup->spec.znear, least = l->how.flushes ? 0x1p-125 : 0x1p-149,
                 most = l->how.flushes ? 0x1p125 : 0x1p127;
    const bool infinite = isinf(setup->spec.zfar), same = l->how.rounding == 1;
    const steps_given given = bound_given(setup);
    char where[2 * NUMBER_SIZE + 32];
    snprintf(where, sizeof where, "for any d from %s to %s", number_of(given.lo, DIGITS_END).text,
             number_of(given.hi, DIGITS_END).text);
    if (infinite && setup->reversed && given.lo == 0.0)
        snprintf(where, sizeof where, "up to a depth of %s", number_down(fmin(n * given.hi / least, most), 3).text);
    else if (infinite && setup->reversed)
        snprintf(where, sizeof where, "for any d above %s, to %s", number_of(given.lo, DIGITS_END).text,
                 number_of(given.hi, DIGITS_END).text);
    else if (infinite && given.lo > 0.0)
        snprintf(where, sizeof where, "for any d from %s on, below %s", number_of(given.lo, DIGITS_END).text,
                 number_of(given.hi, DIGITS_END).text);
    else if (infinite)
        snprintf(where, sizeof where, "for any d below %s", number_of(given.hi, DIGITS_END).text);
    code_say_rules(out, l, false);
    if (isinf(bound))
        code_say(out, l, "No bound: where its divisor comes to 0 no digit is left.");
    else if (same || isinf(nearest))
        code_say(out, l, "So it is off by at most %s of the depth, %s.", number_up(bound, 3).text, where);
    else
        code_say(out, l, "So it is off by at most %s of the depth, %s; by %s where all are rounded to nearest.",
                 number_up(bound, 3).text, where, number_up(nearest, 3).text);
}

code_said code_function(output *out, const code_language *l, const method_row *row, const dp_setup *setup,
                        bool uniforms) {
    const int variant = bound_variant(setup);
    const bool whole = row->family == METHOD_ENCODE;
    code_body f = {.l = l,
                   .name = whole ? "depth_code" : "eye_depth",
                   .inputs = {"d"},
                   .given = bound_given(setup),
                   .type = whole ? CODE_COUNT : CODE_REAL,
                   .wide = row->bound->wide,
                   .uniforms = uniforms};
    if (whole)
        f.given.n = setup->spec.format.code_max;
    steps_read(row->bound->constants[variant], &f.constants);
    steps_read(row->bound->steps[variant], &f.steps);
    code_import(out, l);
    if (row->family == METHOD_ENCODE)
        code_say(out, l, "Code of a window depth: %s", setup->spec.format.name);
    else
        code_say_camera(out, l, setup, "Eye depth of a window depth");
    code_say(out, l, "%s: %s", row->name, row->note);
    (row->family == METHOD_ENCODE ? say_encode : say_bound)(out, l, row, setup);
    code_say_depth(out, l, setup);
    code_function_of(out, &f, setup);
    return (code_said){
        .count = 1,
        .claims = {{f.name, code_bound(l, row, setup),
                    whole ? encode_bound(&bound_nearest, row, setup) : bound_over(row->bound, setup, &bound_nearest),
                    whole ? "steps" : "depth"}}};
}

/* ---- Places ------------------------------------------------------------------------------------------------------ */

/* Twice a pixel's centre less the size is exact; the constant is rounded to nearest, `products` as may be. */
static double place_bound(double depth, const bound_arithmetic *how, int products) {
    const double each = 1 + how->rounding * DP_UNIT;
    return ((1 + depth) * (1 + DP_UNIT) * (products > 1 ? each * each : each) - 1) * DP_OUTWARD;
}

double code_place_bound(const code_language *l, const method_row *row, const dp_setup *setup) {
    return place_bound(code_bound(l, row, setup), &l->how, 2);
}

static void put_side(output *out, const code_language *l, const texture_camera *camera, bool across, bool uniforms) {
    const char size = across ? 'W' : 'H', scale = across ? 'X' : 'Y', name = across ? 'x' : 'y';
    char constants[64] = "", text[64] = "";
    code_body f = {.l = l,
                   .name = across ? "view_x" : "view_y",
                   .inputs = {across ? "column" : "row", camera->ortho ? NULL : "z"},
                   .given = {.n = across ? camera->width : camera->height, .f = camera->half[!across]},
                   .uniforms = uniforms};
    append(constants, sizeof constants, "%c = pixels; %c = half/pixels", size, scale);
    append(text, sizeof text, across ? "a = 2*column - W; " : "a = H - 2*row; ");
    if (camera->ortho)
        append(text, sizeof text, "%c = a*%c", name, scale);
    else
        append(text, sizeof text, "b = a*%c; %c = b*z", scale, name);
    steps_read(constants, &f.constants);
    steps_read(text, &f.steps);
    code_infix(out, &f);
}

code_said code_places(output *out, const code_language *l, const method_row *row, const texture_camera *camera,
                      bool uniforms) {
    const dp_setup *setup = &camera->setup;
    const bool relative = row != NULL;
    code_said said =
        row != NULL ? code_function(out, l, row, setup, uniforms) : code_curve(out, l, setup, false, uniforms);
    const double depth = relative ? said.claims[0].bound : 0, nearest = relative ? said.claims[0].nearest : 0;
    const int products = camera->ortho ? 1 : 2;
    const double bound = place_bound(depth, &l->how, products);
    said.claims[said.count++] = (code_claim){"view_x, view_y", bound, place_bound(nearest, &bound_nearest, products),
                                             relative ? "distance" : "place"};
    code_part(out, l);
    code_say(
        out, l,
        "Place in view space of the pixel whose centre is at (column, row) from the top left, with z = eye_depth(d): "
        "(view_x(column%s), view_y(row%s), -z), x to the right and y up.",
        camera->ortho ? "" : ", z", camera->ortho ? "" : ", z");
    if (isfinite(bound))
        code_say(out, l,
                 relative ? "So it is off by at most %s of its distance%s."
                          : "So x and y are off by at most %s of themselves%s.",
                 number_up(bound, 3).text,
                 isinf(setup->spec.zfar)       ? ", while it is finite"
                 : !relative && !camera->ortho ? ", for the z that they are given"
                                               : "");
    put_side(out, l, camera, true, uniforms);
    code_part(out, l);
    put_side(out, l, camera, false, uniforms);
    return said;
}

/* ---- Projection -------------------------------------------------------------------------------------------------- */

static void put_entries(output *out, const code_language *l, const double m[16], bool by_rows, bool comment) {
    char text[CODE_TEXT_SIZE];
    for (int i = 0; i < 16; i++) {
        const int entry = by_rows ? i : 4 * (i % 4) + i / 4;
        text[0] = '\0';
        if (comment || l->import != NULL)
            code_number(m[entry], false, text);
        else
            code_literal(text, l, m[entry], false);
        output_format(out, "%s%s%s%s", i % 4 == 0 ? comment ? l->comment : "   " : "",
                      i % 4 == 0 && comment ? "  " : " ", text,
                      comment && i % 4 < 3 ? ""
                      : i < 15 && !comment ? ","
                                           : "");
        output_text(out, i % 4 == 3 ? "\n" : "");
    }
}

code_said code_projection(output *out, const code_language *l, const texture_camera *camera) {
    double m[16];
    position_matrix(camera, m);
    for (int i = 0; i < 16; i += 4)
        m[i + 2] = -m[i + 2]; /* the camera looks along -z, and has the world's axes */
    for (int i = 0; i < 16; i++)
        m[i] += 0.0; /* no -0 */
    code_import(out, l);
    code_say_camera(out, l, &camera->setup, "Projection matrix");
    code_say(out, l, "The camera looks along -z; of one that looks along z the third column has the other sign.");
    code_say(out, l, "Each entry is rounded once to binary32: off by at most 5.97e-8 of itself.");
    code_say_depth(out, l, &camera->setup);
    code_say(out, l, "%s:", l->by_rows ? "Column by column, as memory has it" : "Row by row");
    put_entries(out, l, m, !l->by_rows, true);
    code_say(out, l, "%s:", l->by_rows ? "Row by row" : "Column by column");
    output_text(out, l->matrix);
    put_entries(out, l, m, l->by_rows, false);
    output_text(out, l->end);
    return (code_said){.count = 1, .claims = {{"projection", DP_UNIT, DP_UNIT, "entry"}}};
}
