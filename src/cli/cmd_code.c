/* SPDX-License-Identifier: GPL-3.0-or-later */
/* code: a method, a projection matrix, or a packing, for the camera at hand, in a language, to take away. */
#include <string.h>

#include "cli/option/rows.h"
#include "cli/setups.h"
#include "code/code.h"
#include "core/append.h"

/* What --what names, in its order. */
enum { WHAT_LINEARIZE, WHAT_PROJECTION, WHAT_ENCODE, WHAT_POSITION, WHAT_PACK, WHAT_NORMAL };

typedef struct wanted_code {
    const options *o;
    const code_language *language;
    const method_family_row *family;
    const method_row *row;
    const packing *packing;
    const pack_row *encoding;
    dp_setup setup;
    texture_camera camera;
} wanted_code;

/* No matrix makes the depth: a shader writes it. */
static bool is_written(const dp_setup *setup) {
    return setup->curve != DP_CURVE_PERSPECTIVE && !setup->spec.ortho;
}

/* "glsl has no table-linear, which looks numbers up; it has unity, ..." */
static int refuse_method(const wanted_code *w, const char *given, const char *lacks) {
    char all[NAMES_SIZE] = "";
    for (size_t i = 0; i < *w->family->method_count; i++)
        if (code_lacks(w->language, &w->family->methods[i], &w->setup) == NULL)
            append(all, sizeof all, "%s%s", all[0] != '\0' ? ", " : "", w->family->methods[i].name);
    return lacks != NULL
               ? usage_error("code: %s is not in %s: it %s; there are %s", given, w->language->name, lacks, all)
               : usage_error("code: METHOD must be one of %s, got '%s'", all, given);
}

static int find_infix(const wanted_code *w) {
    return w->language->form == CODE_INFIX
               ? EXIT_FINE
               : option_error(OPTION_LANGUAGE, "must be glsl, hlsl, wgsl, msl, c or numpy with --what %s, got %s",
                              option_word(OPTION_WHAT, w->o->code.what), w->language->name);
}

static int find_constants(const wanted_code *w) {
    const int status = find_infix(w);
    return status == EXIT_FINE && w->o->code.uniforms
               ? option_error(OPTION_UNIFORMS, "conflicts with --what %s, all of which is constants",
                              option_word(OPTION_WHAT, w->o->code.what))
               : status;
}

/* Linear and logarithmic depth, for which there is one way. */
static int find_curve(const wanted_code *w) {
    if (w->o->operand_count > 0)
        return usage_error("code: --mapping %s%s has no METHOD, got '%s'", dp_mapping_get(w->setup.spec.mapping)->name,
                           w->setup.spec.ortho ? " with --ortho" : "", w->o->operands[0]);
    if (w->setup.curve == DP_CURVE_LOG && w->language->form != CODE_INFIX)
        return option_error(OPTION_LANGUAGE, "must be glsl, hlsl, wgsl, msl, c or numpy with --mapping %s, got %s",
                            dp_mapping_get(w->setup.spec.mapping)->name, w->language->name);
    return EXIT_FINE;
}

static int find_method(wanted_code *w) {
    const options *o = w->o;
    const dp_format *format = &w->setup.spec.format;
    const bool encode = o->code.what == WHAT_ENCODE;
    if (encode ? is_written(&w->setup) : w->setup.curve != DP_CURVE_PERSPECTIVE)
        return encode && find_infix(w) != EXIT_FINE ? EXIT_USAGE : find_curve(w);
    w->family = encode ? &encode_family : &linearize_family;
    if (encode && (format->kind != DP_FORMAT_UNORM || format->code_max > 0xffffff))
        return option_error(OPTION_FORMAT, "must be unormN of at most 24 bits with --what encode, got %s",
                            format->name);
    if (o->operand_count == 0) {
        w->row = code_best(w->language, w->family, &w->setup);
        return w->row != NULL ? EXIT_FINE
                              : usage_error("code: %s has no method of %s", w->language->name, w->family->name);
    }
    for (size_t i = 0; i < *w->family->method_count; i++) {
        const method_row *row = &w->family->methods[i];
        if (strcmp(row->name, o->operands[0]) != 0)
            continue;
        const char *lacks = code_lacks(w->language, row, &w->setup);
        w->row = row;
        return lacks == NULL ? EXIT_FINE : refuse_method(w, row->name, lacks);
    }
    return refuse_method(w, o->operands[0], NULL);
}

/* Without a name the one with the least error. */
static int find_packed(wanted_code *w) {
    const options *o = w->o;
    const bool depth = o->code.what == WHAT_PACK;
    double least = (double)INFINITY;
    char all[NAMES_SIZE] = "";
    for (size_t i = 0; depth ? packing_get(i) != NULL : pack_get(i) != NULL; i++) {
        const packing *p = depth ? packing_get(i) : NULL;
        const pack_row *row = depth ? NULL : pack_get(i);
        const char *name = depth ? p->name : row->name;
        if (depth ? p->steps == 0 : row->kind != PACK_NORMAL)
            continue;
        const double error = o->operand_count > 0 ? strcmp(name, o->operands[0]) == 0 ? 0 : (double)INFINITY
                             : depth              ? code_pack_bound(p, &w->language->how) / p->steps
                                                  : code_normal_bound(row, &w->language->how);
        append(all, sizeof all, "%s%s", all[0] != '\0' ? ", " : "", name);
        if (error < least) {
            w->packing = p;
            w->encoding = row;
            least = error;
        }
    }
    return isfinite(least) ? find_constants(w)
                           : usage_error("code: METHOD must be one of %s, got '%s'", all, o->operands[0]);
}

/* How wide it sees. */
static int find_view(wanted_code *w) {
    const options *o = w->o;
    const int width = (int)o->view.spec.width, height = (int)o->view.spec.height;
    camera_spec view = o->view.spec;
    if (o->camera.preset_count > 0 && !option_given(o, OPTION_FOV) && !option_given(o, OPTION_HFOV))
        view.fov_y = preset_fov_y(o->camera.presets[0], width, height);
    else if (view_vertical(o, width, height, &view.fov_y) != EXIT_FINE)
        return EXIT_USAGE;
    const char *wrong = camera_init(&w->camera, &w->setup, &view);
    return wrong == NULL ? EXIT_FINE : usage_error("code: %s", wrong);
}

static int find_matrix(wanted_code *w) {
    if (is_written(&w->setup))
        return option_error(OPTION_MAPPING,
                            "must be one of " DP_MAPPING_NAMES_PERSPECTIVE " with --what projection, got %s",
                            dp_mapping_get(w->setup.spec.mapping)->name);
    if (w->o->operand_count > 0)
        return usage_error("code: a projection matrix has no METHOD, got '%s'", w->o->operands[0]);
    const int status = find_constants(w);
    return status == EXIT_FINE ? find_view(w) : status;
}

static int find_places(wanted_code *w) {
    int status = find_infix(w);
    if (status == EXIT_FINE)
        status = find_method(w);
    return status == EXIT_FINE ? find_view(w) : status;
}

/* One camera. */
static int find_setup(wanted_code *w) {
    setups all = {0};
    const int status = setups_make(w->o, &all);
    const size_t count = all.count;
    if (count > 0)
        w->setup = all.items[0];
    setups_release(&all);
    if (status != EXIT_FINE)
        return status;
    if (count > 1)
        return option_error(OPTION_MAPPING, "and --format must be one each, got %zu set-ups", count);
    return EXIT_FINE;
}

/* ---- What is printed --------------------------------------------------------------------------------------------- */

static code_said write_function(const wanted_code *w, output *out) {
    const bool there = w->o->code.what == WHAT_ENCODE, uniforms = w->o->code.uniforms;
    return w->row != NULL ? code_function(out, w->language, w->row, &w->setup, uniforms)
                          : code_curve(out, w->language, &w->setup, there, uniforms);
}

static code_said write_places(const wanted_code *w, output *out) {
    return code_places(out, w->language, w->row, &w->camera, w->o->code.uniforms);
}

static code_said write_matrix(const wanted_code *w, output *out) {
    return code_projection(out, w->language, &w->camera);
}

static code_said write_packed(const wanted_code *w, output *out) {
    return w->packing != NULL ? code_packing(out, w->language, w->packing) : code_normal(out, w->language, w->encoding);
}

static const struct {
    int (*find)(wanted_code *w);
    code_said (*write)(const wanted_code *w, output *out);
} whats[] = {[WHAT_LINEARIZE] = {find_method, write_function}, [WHAT_PROJECTION] = {find_matrix, write_matrix},
             [WHAT_ENCODE] = {find_method, write_function},    [WHAT_POSITION] = {find_places, write_places},
             [WHAT_PACK] = {find_packed, write_packed},        [WHAT_NORMAL] = {find_packed, write_packed}};

/* The same for programs. */
typedef struct printed {
    const char *language, *what, *method, *method_source, *rules, *source, *comparison, *code;
    int clear;
    char arithmetic[CODE_RULES_SIZE];
    code_said said;
} printed;

static void *next_claim(void *of, size_t i) {
    code_said *said = &((printed *)of)->said;
    return i < said->count ? &said->claims[i] : NULL;
}

static const column claim_columns[] = {{FIELD(code_claim, function, "function", "")},
                                       {FIELD(code_claim, bound, "bound", "")},
                                       {FIELD(code_claim, nearest, "nearest", "")},
                                       {FIELD(code_claim, of, "of", "")},
                                       {.kind = COLUMN_END}};
static const column printed_columns[] = {
    {FIELD(printed, language, "language", "")},  {FIELD(printed, what, "what", "")},
    {FIELD(printed, method, "method", "")},      {FIELD(printed, method_source, "method_source", "")},
    {FIELD(printed, clear, "clear", "")},        {FIELD(printed, comparison, "comparison", "")},
    {FIELD(printed, rules, "rules", "")},        {FIELD(printed, arithmetic, "arithmetic", "")},
    {FIELD(printed, source, "source", "")},      {FIELD(printed, code, "code", "")},
    {LIST("bounds", claim_columns, next_claim)}, {.kind = COLUMN_END}};

static printed printed_of(const wanted_code *w, const code_said *said, const char *code) {
    const code_language *l = w->language;
    const bool reversed = w->setup.reversed != 0;
    printed p = {.language = l->name,
                 .what = option_word(OPTION_WHAT, w->o->code.what),
                 .clear = reversed ? 0 : 1,
                 .comparison = reversed ? "greater" : "less",
                 .rules = l->rules,
                 .source = l->source,
                 .code = code,
                 .said = *said};
    p.method = w->row != NULL        ? w->row->name
               : w->packing != NULL  ? w->packing->name
               : w->encoding != NULL ? w->encoding->name
                                     : NULL;
    p.method_source = w->row != NULL        ? w->row->source
                      : w->packing != NULL  ? w->packing->source
                      : w->encoding != NULL ? w->encoding->source
                                            : NULL;
    code_language_rules(l, p.arithmetic);
    return p;
}

int cmd_code(const options *o) {
    static output out, text = {.fd = -1}; /* the code is shorter than the buffer */
    wanted_code w = {.o = o, .language = o->code.language};
    int status = find_setup(&w);
    if (status == EXIT_FINE)
        status = whats[o->code.what].find(&w);
    if (status == EXIT_FINE && o->code.uniforms && w.language->form != CODE_INFIX)
        status = option_error(OPTION_UNIFORMS, "conflicts with %s, which is about one camera", w.language->name);
    if (status == EXIT_FINE)
        status = options_open(o, &out);
    if (status != EXIT_FINE)
        return status;
    const code_said said = whats[o->code.what].write(&w, &text);
    output_char(&text, '\0');
    printed p = printed_of(&w, &said, text.buffer);
    if (o->out.form == FORM_JSON)
        report_write(&(report_spec){"code", printed_columns, &p, .when = 0}, &out, FORM_JSON);
    else
        output_text(&out, text.buffer);
    return output_close(&out);
}
