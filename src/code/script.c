/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A function for tools that prove: FPCore, and a script of Gappa. */
#include <math.h>
#include <string.h>

#include "code/write.h"
#include "core/append.h"

enum { PIECES_IN_LINE = 5 };

/* The eye depth exactly, of the planes as they are. */
static const char *exact(const dp_setup *setup) {
    const bool reversed = setup->reversed != 0;
    return setup->spec.ortho                 ? reversed ? "z = f - (f - n)*d" : "z = n + (f - n)*d"
           : setup->curve == DP_CURVE_LINEAR ? "z = f*d"
           : isinf(setup->spec.zfar)         ? reversed ? "z = n/d" : "z = n/(1 - d)"
           : reversed                        ? "z = n*f/(n + (f - n)*d)"
                                             : "z = n*f/(n + (f - n)*(1 - d))";
}

static void put_prefix(output *out, const code_body *f, const dp_setup *setup) {
    char n[CODE_TEXT_SIZE], far[CODE_TEXT_SIZE], text[CODE_TEXT_SIZE] = "", formula[CODE_TEXT_SIZE];
    const dp_spec *s = &setup->spec;
    const bool infinite = isinf(s->zfar);
    steps spec = {.count = 0};
    steps_read(exact(setup), &spec);
    code_expression(&(code_writer){.l = f->l, .steps = &spec, .wide = true}, spec.step[0].is, 0, text);
    code_number(s->znear, true, n);
    code_number(infinite ? 0 : s->zfar, true, far);
    output_format(out, "(FPCore %s (%s)\n  :precision %s\n  :pre (%s 0 d 1)\n", f->name,
                  f->wide ? "(! :precision binary32 d)" : "d", f->wide ? "binary64" : "binary32",
                  infinite ? "<" : "<=");
    output_format(out, infinite ? "  :spec (let ((n %s)) %s)\n" : "  :spec (let ((n %s) (f %s)) %s)\n", n,
                  infinite ? text : far, text);
    output_text(out, "  (let* (");
    for (int i = 0; i < f->constants.count; i++) {
        code_constant(f, i, text, formula);
        output_format(out, "(%s %s)\n         ", f->constants.step[i].name, text);
    }
    for (int i = 0; i < f->steps.count; i++) {
        text[0] = '\0';
        code_expression(&(code_writer){.l = f->l, .steps = &f->steps, .wide = f->wide}, f->steps.step[i].is, 0, text);
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

/* Writes a step in exact arithmetic; at an infinite far plane one that is 0 has no f. */
static void put_exact(output *out, const steps *s, int i, bool infinite, bool zero) {
    char text[CODE_TEXT_SIZE] = "";
    code_expression(&(code_writer){.steps = s, .exact = infinite ? EXACT_INFINITE : EXACT}, s->step[i].is, 0, text);
    output_format(out, "%s_exact = %s;\n", s->step[i].name, zero ? "0" : text);
}

static void put_proof(output *out, const code_body *f, const dp_setup *setup) {
    const dp_spec *s = &setup->spec;
    char value[CODE_TEXT_SIZE], formula[CODE_TEXT_SIZE];
    const bool infinite = isinf(s->zfar), reversed = setup->reversed != 0;
    output_text(out, "@rnd = float<ieee_32, ne>;\n@dbl = float<ieee_64, ne>;\nd = rnd(any);\n");
    for (int i = 0; i < f->constants.count; i++) {
        code_constant(f, i, value, formula);
        output_format(out, "%s = %s; # %s\n", f->constants.step[i].name, value, formula);
    }
    for (int i = 0; i < f->steps.count; i++) {
        char text[CODE_TEXT_SIZE] = "", last[CODE_TEXT_SIZE] = "";
        const bool is_last = i + 1 == f->steps.count;
        code_expression(&(code_writer){.l = f->l, .steps = &f->steps, .wide = f->wide}, f->steps.step[i].is, 0, text);
        append(last, sizeof last, f->wide && is_last ? "rnd(dbl(%s))" : "%s", text);
        code_put(out, strncmp(text, "rnd(", 4) == 0 || (f->wide && is_last) ? "@ = @;\n" : f->l->step[f->wide],
                 f->steps.step[i].name, last, "");
    }
    output_format(out, "n = dbl(%s);\n", code_number(s->znear, true, value));
    if (!infinite)
        output_format(out, "f = dbl(%s);\n", code_number(s->zfar, true, value));
    for (int i = 0; i < f->constants.count; i++)
        put_exact(out, &f->constants, i, infinite, steps_value(&f->constants, f->constants.step[i].is, &f->given) == 0);
    for (int i = 0; i < f->steps.count; i++)
        put_exact(out, &f->steps, i, infinite, false);
    output_format(out, "{ d in %s -> z %s z_exact in ? }\n",
                  !infinite  ? "[0, 1]"
                  : reversed ? "[1b-24, 1]"
                             : "[0, 16777215b-24]",
                  setup->curve == DP_CURVE_LINEAR ? "-" : "-/");
    put_pieces(out);
}

static void put_infix(output *out, const code_body *f, const dp_setup *setup) {
    (void)setup;
    code_infix(out, f);
}

void code_function_of(output *out, const code_body *f, const dp_setup *setup) {
    if (f->l->advice != NULL)
        code_say(out, f->l, "%s", f->l->advice);
    (f->l->form == CODE_PREFIX ? put_prefix : f->l->form == CODE_PROOF ? put_proof : put_infix)(out, f, setup);
}
