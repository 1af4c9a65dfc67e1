/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "code/code.h"

#include <math.h>
#include <string.h>

#include "core/append.h"
#include "core/bits.h"
#include "report/number.h"
#include "shader/position.h"

/* ---- What a language has ----------------------------------------------------------------------------------------- */

static bool calls(const method_row *row, const dp_setup *setup, const char *name) {
    return strstr(row->bound->steps[setup->reversed != 0], name) != NULL;
}

const char *code_lacks(const code_language *l, const method_row *row, const dp_setup *setup) {
    if (row->bound == NULL)
        return "is no formula of floating-point operations";
    if (row->bound->steps[0] == NULL)
        return "is no short formula";
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

/* What is claimed of a format, whose part above half a step is of roundings to nearest: see depthprec-code(1). */
static double encode_bound(const code_language *l, const method_row *row, const dp_setup *setup) {
    size_t i = 0;
    while (i < encode_family.case_count && strcmp(encode_family.cases[i].format, setup->spec.format.name) != 0)
        i++;
    return i == encode_family.case_count ? (double)NAN : 0.5 + l->how.rounding * (row->claims[i].worst - 0.5);
}

double code_bound(const code_language *l, const method_row *row, const dp_setup *setup) {
    return row->family == METHOD_ENCODE ? encode_bound(l, row, setup) : bound_over(row->bound, setup, &l->how);
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

static void say_camera(output *out, const code_language *l, const dp_setup *setup, const char *what) {
    const dp_spec *s = &setup->spec;
    code_say(out, l, "%s: %s, near %s, far %s", what, dp_mapping_get(s->mapping)->name, number_full(s->znear).text,
             number_full(s->zfar).text);
}

static void say_depth(output *out, const code_language *l, const dp_setup *setup) {
    const bool reversed = setup->reversed != 0;
    code_say(out, l, "Clear depth to %d; nearer is %s.", reversed ? 0 : 1, reversed ? "GREATER" : "LESS");
}

static void say_encode(output *out, const code_language *l, const method_row *row, const dp_setup *setup) {
    const double bound = code_bound(l, row, setup);
    char rules[CODE_RULES_SIZE];
    code_say(out, l, "%s: %s.", l->rules, code_language_rules(l, rules));
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
    char rules[CODE_RULES_SIZE];
    char where[NUMBER_SIZE + 32] = "for any d from 0 to 1";
    if (infinite && setup->reversed)
        snprintf(where, sizeof where, "up to a depth of %s", number_down(fmin(n / least, most), 3).text);
    else if (infinite)
        snprintf(where, sizeof where, "for any d below 1");
    code_say(out, l, "%s: %s.", l->rules, code_language_rules(l, rules));
    if (isinf(bound))
        code_say(out, l, "No bound: where its divisor comes to 0 no digit is left.");
    else if (same || isinf(nearest))
        code_say(out, l, "So it is off by at most %s of the depth, %s.", number_up(bound, 3).text, where);
    else
        code_say(out, l, "So it is off by at most %s of the depth, %s; by %s where all are rounded to nearest.",
                 number_up(bound, 3).text, where, number_up(nearest, 3).text);
}

void code_function(output *out, const code_language *l, const method_row *row, const dp_setup *setup, bool uniforms) {
    const bool reversed = setup->reversed != 0;
    const bool whole = row->family == METHOD_ENCODE;
    code_body f = {.l = l,
                   .name = whole ? "depth_code" : "eye_depth",
                   .inputs = {"d"},
                   .given = {.n = whole ? setup->spec.format.code_max : setup->spec.znear, .f = setup->spec.zfar},
                   .type = whole ? CODE_COUNT : CODE_REAL,
                   .wide = row->bound->wide,
                   .uniforms = uniforms};
    steps_read(row->bound->constants[reversed], &f.constants);
    steps_read(row->bound->steps[reversed], &f.steps);
    if (l->import != NULL)
        output_text(out, l->import);
    if (row->family == METHOD_ENCODE)
        code_say(out, l, "Code of a window depth: %s", setup->spec.format.name);
    else
        say_camera(out, l, setup, "Eye depth of a window depth");
    code_say(out, l, "%s: %s", row->name, row->note);
    (row->family == METHOD_ENCODE ? say_encode : say_bound)(out, l, row, setup);
    say_depth(out, l, setup);
    if (l->advice != NULL)
        code_say(out, l, "%s", l->advice);
    if (l->form == CODE_INFIX)
        code_infix(out, &f);
    else
        code_script(out, &f, setup);
}

/* ---- Places ------------------------------------------------------------------------------------------------------ */

/* Twice a pixel's centre less the size is exact; the constant is rounded to nearest, both products as may be. */
double code_place_bound(const code_language *l, const method_row *row, const dp_setup *setup) {
    const double each = 1 + l->how.rounding * DP_UNIT;
    return ((1 + code_bound(l, row, setup)) * (1 + DP_UNIT) * each * each - 1) * (1 + 0x1p-40);
}

void code_places(output *out, const code_language *l, const method_row *row, const texture_camera *camera,
                 bool uniforms) {
    static const struct {
        const char *name, *input, *constants, *steps;
    } sides[] = {{"view_x", "column", "W = pixels; X = half/pixels", "a = 2*column - W; b = a*X; x = b*z"},
                 {"view_y", "row", "H = pixels; Y = half/pixels", "a = H - 2*row; b = a*Y; y = b*z"}};
    const double size[] = {camera->width, camera->height}, bound = code_place_bound(l, row, &camera->setup);
    code_function(out, l, row, &camera->setup, uniforms);
    output_text(out, l->import != NULL ? "\n\n" : "\n");
    code_say(
        out, l,
        "Place in view space of the pixel whose centre is at (column, row) from the top left, with z = eye_depth(d): "
        "(view_x(column, z), view_y(row, z), -z), x to the right and y up.");
    if (isfinite(bound))
        code_say(out, l, "So it is off by at most %s of its distance%s.", number_up(bound, 3).text,
                 isinf(camera->setup.spec.zfar) ? ", while it is finite" : "");
    for (int i = 0; i < 2; i++) {
        code_body f = {.l = l,
                       .name = sides[i].name,
                       .inputs = {sides[i].input, "z"},
                       .given = {.n = size[i], .f = camera->half[i]},
                       .uniforms = uniforms};
        steps_read(sides[i].constants, &f.constants);
        steps_read(sides[i].steps, &f.steps);
        output_text(out, i == 0 ? "" : l->import != NULL ? "\n\n" : "\n");
        code_infix(out, &f);
    }
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

void code_projection(output *out, const code_language *l, const texture_camera *camera) {
    double m[16];
    position_matrix(camera, m);
    for (int i = 0; i < 16; i += 4)
        m[i + 2] = -m[i + 2]; /* the camera looks along -z, and has the world's axes */
    for (int i = 0; i < 16; i++)
        m[i] += 0.0; /* no -0 */
    if (l->import != NULL)
        output_text(out, l->import);
    say_camera(out, l, &camera->setup, "Projection matrix");
    code_say(out, l, "The camera looks along -z; of one that looks along z the third column has the other sign.");
    code_say(out, l, "Each entry is rounded once to binary32: off by at most 5.97e-8 of itself.");
    say_depth(out, l, &camera->setup);
    code_say(out, l, "%s:", l->by_rows ? "Column by column, as memory has it" : "Row by row");
    put_entries(out, l, m, !l->by_rows, true);
    code_say(out, l, "%s:", l->by_rows ? "Row by row" : "Column by column");
    output_text(out, l->matrix);
    put_entries(out, l, m, l->by_rows, false);
    output_text(out, l->end);
}
