/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "code/code.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/append.h"
#include "core/bits.h"
#include "report/number.h"
#include "shader/position.h"

/* ---- Pieces of text ---------------------------------------------------------------------------------------------- */

/* The template with each '@' in turn replaced, the third and what is behind it alike. */
static void fill(char *out, const char *template, const char *a, const char *b, const char *c) {
    const char *with[] = {a, b, c};
    size_t next = 0;
    for (; *template != '\0'; template ++)
        if (*template == '@')
            append(out, CODE_TEXT_SIZE, "%s", with[next < 2 ? next++ : 2]);
        else
            append(out, CODE_TEXT_SIZE, "%c", *template);
}

static void put(output *out, const char *template, const char *a, const char *b, const char *c) {
    char text[CODE_TEXT_SIZE] = "";
    fill(text, template, a, b, c);
    output_text(out, text);
}

const char *code_number(double value, bool wide, char out[CODE_TEXT_SIZE]) {
    const double to = wide ? value : (double)(float)value;
    int count = 1;
    do
        snprintf(out, CODE_TEXT_SIZE, "%.*e", count - 1, to);
    while ((wide ? strtod(out, NULL) : (double)strtof(out, NULL)) != to && count++ < 17);
    const int places = count - 1 - atoi(strchr(out, 'e') + 1);
    if (to == 0 || (fabs(to) >= 1e-4 && fabs(to) < 1e9))
        snprintf(out, CODE_TEXT_SIZE, "%.*f", places > 1 ? places : 1, to);
    return out;
}

static void put_literal(char *out, const code_language *l, double value, bool wide) {
    char digits[CODE_TEXT_SIZE];
    fill(out, l->literal[wide], code_number(value, wide, digits), "", "");
}

/* ---- Expressions ------------------------------------------------------------------------------------------------- */

/* What is written: a row's steps in a language; without one a formula for people, in near and far, or the same steps in
 * exact arithmetic for Gappa. */
typedef struct writer {
    const code_language *l;
    const steps *steps;
    bool wide;
    enum { AS_COMPUTED = 0, EXACT, EXACT_INFINITE } exact;
} writer;

static void put_name(const writer *w, const char *name, bool inner, char *out) {
    static const char *const words[][3] = {{"n", "near", "near"},
                                           {"f", "far", "far"},
                                           {"across", "1/near - 1/far", "(1/near - 1/far)"},
                                           {"excess", "far/near - 1", "(far/near - 1)"}};
    if (w->exact != AS_COMPUTED && (strcmp(name, "across") == 0 || strcmp(name, "excess") == 0)) {
        append(out, CODE_TEXT_SIZE, *name == 'e' ? "((f - n)/n)" : w->exact == EXACT ? "(1/n - 1/f)" : "1/n");
        return;
    }
    const bool given = strcmp(name, "d") == 0 || strcmp(name, "n") == 0 || strcmp(name, "f") == 0;
    for (size_t i = 0; w->l == NULL && !w->exact && i < sizeof words / sizeof words[0]; i++)
        if (strcmp(words[i][0], name) == 0)
            name = words[i][1 + inner];
    append(out, CODE_TEXT_SIZE, "%s%s", name, w->exact && !given ? "_exact" : "");
}

enum { COMMENT_WIDTH = 74, PIECES_IN_LINE = 5 };
enum { OF_SUM = 1, OF_PRODUCT, OF_SIGN };
static const struct {
    const char *sign;
    int precedence;
} operators[] = {[STEPS_SUM] = {"+", OF_SUM},
                 [STEPS_DIFFERENCE] = {"-", OF_SUM},
                 [STEPS_PRODUCT] = {"*", OF_PRODUCT},
                 [STEPS_QUOTIENT] = {"/", OF_PRODUCT}};

static void expression(const writer *w, int index, int outer, char *out);

/* y (2 - x y) is written out. */
static void call(const writer *w, const steps_node *of, char *out) {
    char arguments[STEPS_ARGUMENTS][CODE_TEXT_SIZE] = {"", "", ""}, two[CODE_TEXT_SIZE] = "";
    for (int i = 0; i < STEPS_ARGUMENTS && of->of[i] >= 0; i++)
        expression(w, of->of[i], 0, arguments[i]);
    if (strcmp(of->name, "newton") == 0) {
        put_literal(two, w->l, 2, false);
        append(out, CODE_TEXT_SIZE, w->l->form == CODE_PREFIX ? "(* %s (- %s (* %s %s)))" : "%s * (%s - %s * %s)",
               arguments[1], two, arguments[0], arguments[1]);
    } else if (!w->exact && w->l->form == CODE_PREFIX) {
        append(out, CODE_TEXT_SIZE, "(fma %s %s %s)", arguments[0], arguments[1], arguments[2]);
    } else if (w->exact) {
        append(out, CODE_TEXT_SIZE, "%s*%s + %s", arguments[0], arguments[1], arguments[2]);
    } else {
        fill(out,
             strcmp(of->name, "fma") == 0     ? w->l->fused
             : strcmp(of->name, "whole") == 0 ? w->l->whole
             : strcmp(of->name, "even") == 0  ? w->l->even
                                              : w->l->magic,
             arguments[0], arguments[1], arguments[2]);
    }
}

static void expression(const writer *w, int index, int outer, char *out) {
    const steps_node *of = &w->steps->node[index];
    const bool prefix = w->l != NULL && w->l->form == CODE_PREFIX, tight = w->l == NULL;
    if (of->kind == STEPS_NUMBER && w->l != NULL && w->l->form != CODE_PROOF) {
        put_literal(out, w->l, of->value, w->wide);
    } else if (of->kind == STEPS_NUMBER) {
        append(out, CODE_TEXT_SIZE, "%g", of->value);
    } else if (of->kind == STEPS_NAME) {
        put_name(w, of->name, outer > 0, out);
    } else if (of->kind == STEPS_CALL) {
        call(w, of, out);
    } else if (of->kind == STEPS_NEGATIVE) {
        append(out, CODE_TEXT_SIZE, "-");
        expression(w, of->of[0], OF_SIGN, out);
    } else {
        const int own = operators[of->kind].precedence;
        const bool inside = prefix || own < outer;
        append(out, CODE_TEXT_SIZE, "%s", inside ? "(" : "");
        if (prefix)
            append(out, CODE_TEXT_SIZE, "%s ", operators[of->kind].sign);
        expression(w, of->of[0], own, out);
        append(out, CODE_TEXT_SIZE,
               prefix                       ? " "
               : tight && own == OF_PRODUCT ? "%s"
                                            : " %s ",
               operators[of->kind].sign);
        expression(w, of->of[1], own + (of->kind == STEPS_DIFFERENCE || of->kind == STEPS_QUOTIENT), out);
        append(out, CODE_TEXT_SIZE, inside ? ")" : "");
    }
}

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

/* A comment, in lines that a terminal holds. */
static void say(output *out, const code_language *l, const char *format, ...) __attribute__((format(printf, 3, 4)));
static void say(output *out, const code_language *l, const char *format, ...) {
    char text[CODE_TEXT_SIZE];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    for (const char *at = text; *at != '\0';) {
        size_t length = strlen(at);
        for (size_t i = length; length > COMMENT_WIDTH && i > 0; i--)
            if (at[i - 1] == ' ' && i - 1 <= COMMENT_WIDTH) {
                length = i - 1;
                break;
            }
        output_format(out, "%s %.*s\n", l->comment, (int)length, at);
        at += length + (at[length] == ' ');
    }
}

static void say_camera(output *out, const code_language *l, const dp_setup *setup, const char *what) {
    const dp_spec *s = &setup->spec;
    say(out, l, "%s: %s, near %s, far %s", what, dp_mapping_get(s->mapping)->name, number_full(s->znear).text,
        number_full(s->zfar).text);
}

static void say_depth(output *out, const code_language *l, const dp_setup *setup) {
    const bool reversed = setup->reversed != 0;
    say(out, l, "Clear depth to %d; nearer is %s.", reversed ? 0 : 1, reversed ? "GREATER" : "LESS");
}

static void say_encode(output *out, const code_language *l, const method_row *row, const dp_setup *setup) {
    const double bound = code_bound(l, row, setup);
    char rules[CODE_RULES_SIZE];
    say(out, l, "%s: %s.", l->rules, code_language_rules(l, rules));
    if (isnan(bound))
        say(out, l, "No bound is proven for this format.");
    else
        say(out, l, "So the code is off by at most %s of its steps, for any d from 0 to 1.", number_up(bound, 6).text);
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
    say(out, l, "%s: %s.", l->rules, code_language_rules(l, rules));
    if (isinf(bound))
        say(out, l, "No bound: where its divisor comes to 0 no digit is left.");
    else if (same || isinf(nearest))
        say(out, l, "So it is off by at most %s of the depth, %s.", number_up(bound, 3).text, where);
    else
        say(out, l, "So it is off by at most %s of the depth, %s; by %s where all are rounded to nearest.",
            number_up(bound, 3).text, where, number_up(nearest, 3).text);
}

/* ---- Linearize --------------------------------------------------------------------------------------------------- */

/* A function, as it is written. */
typedef struct function {
    const code_language *l;
    const dp_setup *setup;
    const char *name, *inputs[2]; /* the second may be null */
    double first, second;         /* what its constants are formed of, see steps.h */
    steps constants, steps;
    bool wide, uniforms, whole;
} function;

static void constant_of(const function *f, int i, char value[CODE_TEXT_SIZE], char formula[CODE_TEXT_SIZE]) {
    value[0] = formula[0] = '\0';
    put_literal(value, f->l, steps_value(&f->constants, f->constants.step[i].is, f->first, f->second), f->wide);
    expression(&(writer){NULL, &f->constants, f->wide, AS_COMPUTED}, f->constants.step[i].is, 0, formula);
}

static void put_infix(output *out, const function *f) {
    const code_language *l = f->l;
    char parameters[CODE_TEXT_SIZE] = "", value[CODE_TEXT_SIZE], formula[CODE_TEXT_SIZE];
    for (int i = 0; i < 2 && f->inputs[i] != NULL; i++) {
        append(parameters, CODE_TEXT_SIZE, i > 0 ? ", " : "");
        fill(parameters, l->parameter[0], f->inputs[i], "", "");
    }
    for (int i = 0; f->uniforms && i < f->constants.count; i++) {
        append(parameters, CODE_TEXT_SIZE, ", ");
        fill(parameters, l->parameter[f->wide], f->constants.step[i].name, "", "");
        constant_of(f, i, value, formula);
        say(out, l, "%s = %s = %s", f->constants.step[i].name, formula, value);
    }
    put(out, (f->whole ? l->code : l->function)[f->wide], f->name, parameters, f->inputs[0]);
    for (int i = 0; !f->uniforms && i < f->constants.count; i++) {
        constant_of(f, i, value, formula);
        put(out, l->constant[f->wide], f->constants.step[i].name, value, "");
        output_format(out, "%s%s %s\n", l->form == CODE_INFIX && strcmp(l->comment, "#") == 0 ? "  " : " ", l->comment,
                      formula);
    }
    for (int i = 0; i < f->steps.count; i++) {
        char text[CODE_TEXT_SIZE] = "";
        expression(&(writer){l, &f->steps, f->wide, AS_COMPUTED}, f->steps.step[i].is, 0, text);
        if (f->whole) {
            put(out, l->result[0], text, "", "");
            return;
        }
        put(out, l->step[f->wide], f->steps.step[i].name, text, "");
    }
    put(out, l->result[f->wide], f->steps.step[f->steps.count - 1].name, "", "");
}

/* The eye depth exactly, of the planes as they are. */
static const char *exact(const dp_setup *setup) {
    const bool reversed = setup->reversed != 0;
    return isinf(setup->spec.zfar) ? reversed ? "z = n/d" : "z = n/(1 - d)"
           : reversed              ? "z = n*f/(n + (f - n)*d)"
                                   : "z = n*f/(n + (f - n)*(1 - d))";
}

static void put_prefix(output *out, const function *f) {
    char n[CODE_TEXT_SIZE], far[CODE_TEXT_SIZE], text[CODE_TEXT_SIZE] = "", formula[CODE_TEXT_SIZE];
    const dp_spec *s = &f->setup->spec;
    const bool infinite = isinf(s->zfar);
    steps spec = {.count = 0};
    steps_read(exact(f->setup), &spec);
    expression(&(writer){f->l, &spec, true, AS_COMPUTED}, spec.step[0].is, 0, text);
    code_number(s->znear, true, n);
    code_number(infinite ? 0 : s->zfar, true, far);
    output_format(out, "(FPCore %s (%s)\n  :precision %s\n  :pre (%s 0 d 1)\n", f->name,
                  f->wide ? "(! :precision binary32 d)" : "d", f->wide ? "binary64" : "binary32",
                  infinite ? "<" : "<=");
    output_format(out, infinite ? "  :spec (let ((n %s)) %s)\n" : "  :spec (let ((n %s) (f %s)) %s)\n", n,
                  infinite ? text : far, text);
    output_text(out, "  (let* (");
    for (int i = 0; i < f->constants.count; i++) {
        constant_of(f, i, text, formula);
        output_format(out, "(%s %s)\n         ", f->constants.step[i].name, text);
    }
    for (int i = 0; i < f->steps.count; i++) {
        text[0] = '\0';
        expression(&(writer){f->l, &f->steps, f->wide, AS_COMPUTED}, f->steps.step[i].is, 0, text);
        output_format(out, "(%s %s)%s", f->steps.step[i].name, text, i + 1 < f->steps.count ? "\n         " : ")\n");
    }
    output_text(out, f->wide ? "    (! :precision binary32 (cast z))))\n" : "    z))\n");
}

/* The octaves of d and those of 1 - d, which Gappa looks at one by one. */
static void put_pieces(output *out) {
    output_text(out, "$ d in (");
    for (int k = 0; k < 46; k++)
        output_format(out, "%ldb-%d,%s", k < 23 ? 1L : (1L << (k - 22)) - 1, k < 23 ? 24 - k : k - 22,
                      k % PIECES_IN_LINE == PIECES_IN_LINE - 1 ? "\n        " : " ");
    output_text(out, "16777215b-24);\n");
}

/* What is 0 at an infinite far plane has no f. */
static void put_exact(output *out, const steps *s, int i, bool infinite, bool zero) {
    char text[CODE_TEXT_SIZE] = "";
    expression(&(writer){NULL, s, false, infinite ? EXACT_INFINITE : EXACT}, s->step[i].is, 0, text);
    output_format(out, "%s_exact = %s;\n", s->step[i].name, zero ? "0" : text);
}

static void put_proof(output *out, const function *f) {
    const dp_spec *s = &f->setup->spec;
    char value[CODE_TEXT_SIZE], formula[CODE_TEXT_SIZE];
    const bool infinite = isinf(s->zfar), reversed = f->setup->reversed != 0;
    output_text(out, "@rnd = float<ieee_32, ne>;\n@dbl = float<ieee_64, ne>;\nd = rnd(any);\n");
    for (int i = 0; i < f->constants.count; i++) {
        constant_of(f, i, value, formula);
        output_format(out, "%s = %s; # %s\n", f->constants.step[i].name, value, formula);
    }
    for (int i = 0; i < f->steps.count; i++) {
        char text[CODE_TEXT_SIZE] = "", last[CODE_TEXT_SIZE] = "";
        const bool is_last = i + 1 == f->steps.count;
        expression(&(writer){f->l, &f->steps, f->wide, AS_COMPUTED}, f->steps.step[i].is, 0, text);
        append(last, sizeof last, f->wide && is_last ? "rnd(dbl(%s))" : "%s", text);
        put(out, strncmp(text, "rnd(", 4) == 0 || (f->wide && is_last) ? "@ = @;\n" : f->l->step[f->wide],
            f->steps.step[i].name, last, "");
    }
    output_format(out, "n = dbl(%s);\n", code_number(s->znear, true, value));
    if (!infinite)
        output_format(out, "f = dbl(%s);\n", code_number(s->zfar, true, value));
    for (int i = 0; i < f->constants.count; i++)
        put_exact(out, &f->constants, i, infinite,
                  steps_value(&f->constants, f->constants.step[i].is, s->znear, s->zfar) == 0);
    for (int i = 0; i < f->steps.count; i++)
        put_exact(out, &f->steps, i, infinite, false);
    output_format(out, "{ d in %s -> z -/ z_exact in ? }\n",
                  !infinite  ? "[0, 1]"
                  : reversed ? "[1b-24, 1]"
                             : "[0, 16777215b-24]");
    put_pieces(out);
}

void code_function(output *out, const code_language *l, const method_row *row, const dp_setup *setup, bool uniforms) {
    const bool reversed = setup->reversed != 0;
    const bool whole = row->family == METHOD_ENCODE;
    function f = {.l = l,
                  .setup = setup,
                  .name = whole ? "depth_code" : "eye_depth",
                  .inputs = {"d", NULL},
                  .first = whole ? setup->spec.format.code_max : setup->spec.znear,
                  .second = setup->spec.zfar,
                  .wide = row->bound->wide,
                  .uniforms = uniforms,
                  .whole = whole};
    steps_read(row->bound->constants[reversed], &f.constants);
    steps_read(row->bound->steps[reversed], &f.steps);
    if (l->import != NULL)
        output_text(out, l->import);
    if (row->family == METHOD_ENCODE)
        say(out, l, "Code of a window depth: %s", setup->spec.format.name);
    else
        say_camera(out, l, setup, "Eye depth of a window depth");
    say(out, l, "%s: %s", row->name, row->note);
    (row->family == METHOD_ENCODE ? say_encode : say_bound)(out, l, row, setup);
    say_depth(out, l, setup);
    if (l->advice != NULL)
        say(out, l, "%s", l->advice);
    (l->form == CODE_INFIX ? put_infix : l->form == CODE_PREFIX ? put_prefix : put_proof)(out, &f);
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
    say(out, l,
        "Place in view space of the pixel whose centre is at (column, row) from the top left, with z = eye_depth(d): "
        "(view_x(column, z), view_y(row, z), -z), x to the right and y up.");
    if (isfinite(bound))
        say(out, l, "So it is off by at most %s of its distance%s.", number_up(bound, 3).text,
            isinf(camera->setup.spec.zfar) ? ", while it is finite" : "");
    for (int i = 0; i < 2; i++) {
        function f = {.l = l,
                      .setup = &camera->setup,
                      .name = sides[i].name,
                      .inputs = {sides[i].input, "z"},
                      .first = size[i],
                      .second = camera->half[i],
                      .uniforms = uniforms};
        steps_read(sides[i].constants, &f.constants);
        steps_read(sides[i].steps, &f.steps);
        output_text(out, i == 0 ? "" : l->import != NULL ? "\n\n" : "\n");
        put_infix(out, &f);
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
            put_literal(text, l, m[entry], false);
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
    say(out, l, "The camera looks along -z; of one that looks along z the third column has the other sign.");
    say(out, l, "Each entry is rounded once to binary32: off by at most 5.97e-8 of itself.");
    say_depth(out, l, &camera->setup);
    say(out, l, "%s:", l->by_rows ? "Column by column, as memory has it" : "Row by row");
    put_entries(out, l, m, !l->by_rows, true);
    say(out, l, "%s:", l->by_rows ? "Row by row" : "Column by column");
    output_text(out, l->matrix);
    put_entries(out, l, m, l->by_rows, false);
    output_text(out, l->end);
}
