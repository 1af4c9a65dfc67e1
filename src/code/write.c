/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "code/write.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/append.h"
#include "report/number.h"

/* ---- Pieces of text ---------------------------------------------------------------------------------------------- */

/* The template with each '@' in turn replaced, the third and what is behind it alike, as every '$' is. */
static void fill(char *out, const char *template, const char *a, const char *b, const char *c) {
    const char *with[] = {a, b, c};
    size_t next = 0;
    for (; *template != '\0'; template ++)
        if (*template == '@' || *template == '$')
            append(out, CODE_TEXT_SIZE, "%s", with[*template == '@' && next < 2 ? next++ : 2]);
        else
            append(out, CODE_TEXT_SIZE, "%c", *template);
}

void code_put(output *out, const char *template, const char *a, const char *b, const char *c) {
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

void code_literal(char *out, const code_language *l, double value, bool wide) {
    char digits[CODE_TEXT_SIZE];
    fill(out, l->literal[wide], code_number(value, wide, digits), "", "");
}

/* ---- Expressions ------------------------------------------------------------------------------------------------- */

static void put_name(const code_writer *w, const char *name, bool inner, char *out) {
    const char *const words[][3] = {{"n", "near", "near"},
                                    {"f", "far", "far"},
                                    {"lo", "LO", "LO"},
                                    {"hi", "HI", "HI"},
                                    {"scale", "C of the mapping", "C"},
                                    {"span", w->span, w->span},
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

enum { COMMENT_WIDTH = 74 };
enum { OF_SUM = 1, OF_PRODUCT, OF_SIGN };
static const struct {
    const char *sign;
    int precedence;
} operators[] = {[STEPS_SUM] = {"+", OF_SUM},
                 [STEPS_DIFFERENCE] = {"-", OF_SUM},
                 [STEPS_PRODUCT] = {"*", OF_PRODUCT},
                 [STEPS_QUOTIENT] = {"/", OF_PRODUCT}};

enum { CALL_SIZE = 32 };

/* Functions that all languages have are named as in shaders, but for what C and numpy put around them. */
static const char *template_of(const code_language *l, const char *name, char common[CALL_SIZE]) {
    const struct {
        const char *name, *template;
    } own[] = {{"fma", l->fused}, {"whole", l->whole}, {"even", l->even}, {"magic", l->magic}, {"signed", l->sign}};
    for (size_t i = 0; i < sizeof own / sizeof own[0]; i++)
        if (strcmp(own[i].name, name) == 0)
            return own[i].template;
    const bool real = (*l->before != '\0' || *l->behind != '\0') &&
                      (strcmp(name, "abs") == 0 || strcmp(name, "min") == 0 || strcmp(name, "max") == 0);
    const bool two = strncmp(name, "m", 1) == 0;
    snprintf(common, CALL_SIZE, "%s%s%s%s(%s)", l->before, real ? "f" : "", name, l->behind, two ? "@, @" : "@");
    return common;
}

/* y (2 - x y) is written out. */
static void call(const code_writer *w, const steps_node *of, char *out) {
    char arguments[STEPS_ARGUMENTS][CODE_TEXT_SIZE] = {"", "", ""}, two[CODE_TEXT_SIZE] = "", common[CALL_SIZE];
    for (int i = 0; i < STEPS_ARGUMENTS && of->of[i] >= 0; i++)
        code_expression(w, of->of[i], 0, arguments[i]);
    if (strcmp(of->name, "newton") == 0) {
        code_literal(two, w->l, 2, false);
        append(out, CODE_TEXT_SIZE, w->l->form == CODE_PREFIX ? "(* %s (- %s (* %s %s)))" : "%s * (%s - %s * %s)",
               arguments[1], two, arguments[0], arguments[1]);
    } else if (!w->exact && w->l->form == CODE_PREFIX) {
        append(out, CODE_TEXT_SIZE, "(fma %s %s %s)", arguments[0], arguments[1], arguments[2]);
    } else if (w->exact) {
        append(out, CODE_TEXT_SIZE, "%s*%s + %s", arguments[0], arguments[1], arguments[2]);
    } else {
        fill(out, template_of(w->l, of->name, common), arguments[0], arguments[1], arguments[2]);
    }
}

void code_expression(const code_writer *w, int index, int outer, char *out) {
    const steps_node *of = &w->steps->node[index];
    const bool prefix = w->l != NULL && w->l->form == CODE_PREFIX, tight = w->l == NULL;
    if (of->kind == STEPS_NUMBER && w->l != NULL && w->l->form != CODE_PROOF) {
        code_literal(out, w->l, of->value, w->wide);
    } else if (of->kind == STEPS_NUMBER) {
        append(out, CODE_TEXT_SIZE, "%g", of->value);
    } else if (of->kind == STEPS_NAME) {
        put_name(w, of->name, outer > 0, out);
    } else if (of->kind == STEPS_CALL) {
        call(w, of, out);
    } else if (of->kind == STEPS_NEGATIVE) {
        append(out, CODE_TEXT_SIZE, "-");
        code_expression(w, of->of[0], OF_SIGN, out);
    } else {
        const int own = operators[of->kind].precedence;
        const bool inside = prefix || own < outer;
        append(out, CODE_TEXT_SIZE, "%s", inside ? "(" : "");
        if (prefix)
            append(out, CODE_TEXT_SIZE, "%s ", operators[of->kind].sign);
        code_expression(w, of->of[0], own, out);
        append(out, CODE_TEXT_SIZE,
               prefix                       ? " "
               : tight && own == OF_PRODUCT ? "%s"
                                            : " %s ",
               operators[of->kind].sign);
        code_expression(w, of->of[1], own + 1, out); /* a sum of other order is rounded otherwise */
        append(out, CODE_TEXT_SIZE, inside ? ")" : "");
    }
}

/* ---- Comments ---------------------------------------------------------------------------------------------------- */

void code_say(output *out, const code_language *l, const char *format, ...) {
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

void code_import(output *out, const code_language *l) {
    if (l->import != NULL)
        output_text(out, l->import);
}

void code_say_rules(output *out, const code_language *l, bool powers) {
    char rules[CODE_RULES_SIZE];
    code_say(out, l, "%s: %s%s%s.", l->rules, code_language_rules(l, rules), powers ? "; " : "",
             powers ? l->powers : "");
}

void code_say_camera(output *out, const code_language *l, const dp_setup *setup, const char *what) {
    const dp_spec *s = &setup->spec;
    const bool scaled = setup->curve == DP_CURVE_LOG && !dp_mapping_get(s->mapping)->log_over_near;
    char ends[2 * NUMBER_SIZE + 16] = "";
    if (setup->ranged)
        snprintf(ends, sizeof ends, ", depth range %s:%s", number_full(s->depth_range[0]).text,
                 number_full(s->depth_range[1]).text);
    code_say(out, l, "%s: %s%s, near %s, far %s%s%s%s", what, dp_mapping_get(s->mapping)->name,
             s->ortho ? ", orthographic" : "", number_full(s->znear).text, number_full(s->zfar).text,
             scaled ? ", C " : "", scaled ? number_full(s->log_c).text : "", ends);
}

void code_say_depth(output *out, const code_language *l, const dp_setup *setup) {
    const bool reversed = setup->reversed != 0;
    code_say(out, l, "Clear depth to %d; nearer is %s.", reversed ? 0 : 1, reversed ? "GREATER" : "LESS");
}

/* ---- Functions --------------------------------------------------------------------------------------------------- */

const char *code_type_name(const code_language *l, code_type type, int members, char out[CODE_TEXT_SIZE]) {
    char count[CODE_TEXT_SIZE];
    out[0] = '\0';
    snprintf(count, sizeof count, "%d", members);
    fill(out, l->type[type], count, "", "");
    return out;
}

void code_constant(const code_body *f, int i, char value[CODE_TEXT_SIZE], char formula[CODE_TEXT_SIZE]) {
    value[0] = formula[0] = '\0';
    code_literal(value, f->l, steps_value(&f->constants, f->constants.step[i].is, &f->given), f->wide);
    code_expression(&(code_writer){.steps = &f->constants, .wide = f->wide, .span = f->span}, f->constants.step[i].is,
                    0, formula);
}

static void put_head(output *out, const code_body *f) {
    const code_language *l = f->l;
    char type[CODE_TEXT_SIZE], parameters[CODE_TEXT_SIZE] = "", value[CODE_TEXT_SIZE], formula[CODE_TEXT_SIZE];
    for (int i = 0; i < CODE_INPUTS && f->inputs[i] != NULL; i++) {
        append(parameters, CODE_TEXT_SIZE, i > 0 ? ", " : "");
        fill(parameters, l->parameter[0], f->inputs[i], "", "");
    }
    for (int i = 0; f->uniforms && i < f->constants.count; i++) {
        append(parameters, CODE_TEXT_SIZE, ", ");
        fill(parameters, l->parameter[f->wide], f->constants.step[i].name, "", "");
        code_constant(f, i, value, formula);
        code_say(out, l, "%s = %s = %s", f->constants.step[i].name, formula, value);
    }
    code_put(out, l->function, f->name, parameters, code_type_name(l, f->type, f->results, type));
    for (int i = 0; l->input[f->wide] != NULL && i < CODE_INPUTS && f->inputs[i] != NULL; i++)
        code_put(out, l->input[f->wide], f->inputs[i], f->inputs[i], "");
    for (int i = 0; !f->uniforms && i < f->constants.count; i++) {
        code_constant(f, i, value, formula);
        code_put(out, l->constant[f->wide], f->constants.step[i].name, value, "");
        output_format(out, "%s%s %s\n", l->form == CODE_INFIX && strcmp(l->comment, "#") == 0 ? "  " : " ", l->comment,
                      formula);
    }
}

/* A whole number is returned as it is computed. */
void code_infix(output *out, const code_body *f) {
    const code_language *l = f->l;
    char type[CODE_TEXT_SIZE], given[CODE_TEXT_SIZE] = "";
    put_head(out, f);
    for (int i = 0; i < f->steps.count; i++) {
        const char *name = f->steps.step[i].name;
        char text[CODE_TEXT_SIZE] = "";
        code_expression(&(code_writer){.l = l, .steps = &f->steps, .wide = f->wide}, f->steps.step[i].is, 0, text);
        if (f->type != CODE_COUNT)
            code_put(out, l->step[f->wide], name, text, "");
        if (i + (f->results > 0 ? f->results : 1) >= f->steps.count)
            append(given, sizeof given, "%s%s", given[0] != '\0' ? ", " : "", f->type == CODE_COUNT ? text : name);
    }
    code_put(out, f->type == CODE_VECTOR ? l->members : l->result[f->type == CODE_REAL && f->wide], given, "",
             code_type_name(l, f->type, f->results, type));
}

void code_part(output *out, const code_language *l) {
    output_text(out, l->import != NULL ? "\n\n" : "\n");
}
