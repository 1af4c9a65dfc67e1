/* SPDX-License-Identifier: GPL-3.0-or-later */
/* code: a method, a projection matrix, or a packing, for the camera at hand, in a language, to take away. */
#include <string.h>

#include "camera/cmd/setups.h"
#include "code/cmd_code/request.h"
#include "code/code.h"
#include "core/append.h"

/* The parts of code that --what names, in its order. */
enum { WHAT_LINEARIZE, WHAT_PROJECTION, WHAT_ENCODE, WHAT_POSITION, WHAT_PACK, WHAT_NORMAL };

typedef struct wanted_code {
    const code_request *o;
    const code_language *language;
    const method_family_row *family;
    const method_row *row;
    const packing *packing;
    const pack_row *encoding;
    const char *method, *source; /* of either; null: there is one way */
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

enum {
    MATRIX = 1 << WHAT_PROJECTION,
    PLACES = 1 << WHAT_POSITION,
    CODES = 1 << WHAT_ENCODE,
    WRITTEN = 1 << 15, /* the window depth of --what encode where a shader writes it */
    CAMERA = MATRIX | PLACES | WRITTEN | 1 << WHAT_LINEARIZE
};

static unsigned part_of(const wanted_code *w) {
    return w->o->what == WHAT_ENCODE && is_written(&w->setup) ? WRITTEN : 1U << w->o->what;
}

/* Refuses the first option given that a part has no use for. */
static int check_needless(const wanted_code *w) {
    static const struct {
        const char *id;
        unsigned parts;
    } rows[] = {{"near", CAMERA},           {"far", CAMERA},
                {"format", CODES},          {"mapping", CAMERA | CODES},
                {"ortho", CAMERA},          {"unit", CAMERA},
                {"preset", CAMERA | CODES}, {"platform", CAMERA | CODES},
                {"log-c", CAMERA},          {"fov", MATRIX | PLACES},
                {"hfov", MATRIX | PLACES},  {"viewport", MATRIX | PLACES},
                {"rounding", CODES},        {"depth-range", PLACES | 1 << WHAT_LINEARIZE}};
    const unsigned what = w->o->what;
    const bool encode = what == WHAT_ENCODE;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        if (option_given(w->o->line, rows[i].id) && (rows[i].parts & part_of(w)) == 0)
            return option_error(rows[i].id, "has no effect with --what %s%s%s", option_word("what", what),
                                encode ? " of --mapping " : "",
                                encode ? dp_mapping_get(w->setup.spec.mapping)->name : "");
    return EXIT_FINE;
}

/* Scripts hold one function of one camera, without logarithms. */
static int check_language(const wanted_code *w) {
    const unsigned what = w->o->what;
    const char *word = option_word("what", what), *mapping = dp_mapping_get(w->setup.spec.mapping)->name;
    const bool script = w->language->form != CODE_INFIX, uniforms = w->o->uniforms;
    const bool whole = what == WHAT_LINEARIZE || what == WHAT_ENCODE; /* but not of each mapping */
    if (w->setup.ranged && w->setup.spec.ortho)
        return option_error("depth-range", "conflicts with --ortho: bring depths to 0 to 1 by (d - LO)/(HI - LO)");
    if (w->setup.ranged && script)
        return option_error("language", "must be glsl, hlsl, wgsl, msl, c or numpy with --depth-range, got %s",
                            w->language->name);
    if (script && (!whole || (what == WHAT_ENCODE ? is_written(&w->setup) : w->setup.curve == DP_CURVE_LOG)))
        return option_error("language", "must be glsl, hlsl, wgsl, msl, c or numpy with --%s %s, got %s",
                            whole ? "mapping" : "what", whole ? mapping : word, w->language->name);
    if (uniforms && script)
        return option_error("uniforms", "conflicts with %s, which is about one camera", w->language->name);
    if (uniforms && (what == WHAT_PROJECTION || what == WHAT_PACK || what == WHAT_NORMAL))
        return option_error("uniforms", "conflicts with --what %s, all of which is constants", word);
    return EXIT_FINE;
}

static int take_names(wanted_code *w) {
    w->method = w->row->name;
    w->source = w->row->source;
    return EXIT_FINE;
}

static int find_method(wanted_code *w) {
    const code_request *o = w->o;
    const dp_format *format = &w->setup.spec.format;
    const bool encode = o->what == WHAT_ENCODE;
    if (encode ? is_written(&w->setup) : w->setup.curve != DP_CURVE_PERSPECTIVE)
        return o->line->operand_count == 0
                   ? EXIT_FINE
                   : usage_error("code: there is one way for --mapping %s%s, and no METHOD, got '%s'",
                                 dp_mapping_get(w->setup.spec.mapping)->name,
                                 w->setup.spec.ortho ? " with --ortho" : "", o->line->operands[0]);
    w->family = encode ? code_encoders(w->setup.spec.rounding) : &linearize_family;
    if (encode && (format->kind != DP_FORMAT_UNORM || format->code_max > 0xffffff))
        return option_error("format", "must be unormN of at most 24 bits with --what encode, got %s", format->name);
    if (o->line->operand_count == 0) {
        w->row = code_best(w->language, w->family, &w->setup);
        return w->row != NULL ? take_names(w)
                              : usage_error("code: %s has no method of %s", w->language->name, w->family->name);
    }
    for (size_t i = 0; i < *w->family->method_count; i++) {
        const method_row *row = &w->family->methods[i];
        if (strcmp(row->name, o->line->operands[0]) != 0)
            continue;
        const char *lacks = code_lacks(w->language, row, &w->setup);
        w->row = row;
        return lacks == NULL ? take_names(w) : refuse_method(w, row->name, lacks);
    }
    return refuse_method(w, o->line->operands[0], NULL);
}

/* Finds the packing: without a name the one with the least error. */
static int find_packed(wanted_code *w) {
    const bool depth = w->o->what == WHAT_PACK, given = w->o->line->operand_count > 0;
    const bound_arithmetic *how = &w->language->how;
    double least = (double)INFINITY;
    char all[NAMES_SIZE] = "";
    for (size_t i = 0; depth ? packing_get(i) != NULL : pack_get(i) != NULL; i++) {
        const packing *p = depth ? packing_get(i) : NULL;
        const pack_row *row = depth ? NULL : pack_get(i);
        const char *name = depth ? p->name : row->name;
        if (depth ? p->steps == 0 : row->kind != PACK_NORMAL)
            continue;
        const double error = depth ? code_pack_bound(p, how) / p->steps : code_normal_bound(row, how);
        append(all, sizeof all, "%s%s", all[0] != '\0' ? ", " : "", name);
        if (given ? strcmp(name, w->o->line->operands[0]) != 0 : error >= least)
            continue;
        w->packing = p;
        w->encoding = row;
        w->method = name;
        w->source = depth ? p->source : row->source;
        least = error;
    }
    return w->method != NULL ? EXIT_FINE
                             : usage_error("code: METHOD must be one of %s, got '%s'", all, w->o->line->operands[0]);
}

/* How wide it sees. */
static int find_view(wanted_code *w) {
    const code_request *o = w->o;
    const int width = (int)o->camera.spec.width, height = (int)o->camera.spec.height;
    camera_spec view = o->camera.spec;
    if (view_vertical(&o->camera, width, height, &view.fov_y) != EXIT_FINE)
        return EXIT_USAGE;
    const char *wrong = camera_init(&w->camera, &w->setup, &view);
    return wrong == NULL ? EXIT_FINE : usage_error("code: %s", wrong);
}

static int find_matrix(wanted_code *w) {
    if (is_written(&w->setup))
        return option_error("mapping", "must be one of " DP_MAPPING_NAMES_PERSPECTIVE " with --what projection, got %s",
                            dp_mapping_get(w->setup.spec.mapping)->name);
    if (w->o->line->operand_count > 0)
        return usage_error("code: a projection matrix has no METHOD, got '%s'", w->o->line->operands[0]);
    return EXIT_FINE;
}

/* One camera: set-ups that differ in their formats alone are one where no code of theirs is printed. */
static int find_setup(wanted_code *w) {
    setups all = {0};
    const int status = setups_make(&w->o->camera, &all);
    size_t differ = 0;
    if (all.count > 0)
        w->setup = all.items[0];
    for (size_t i = 1; i < all.count; i++)
        differ += (part_of(w) & CODES) != 0 || all.items[i].spec.mapping != w->setup.spec.mapping;
    const size_t count = all.count;
    setups_release(&all);
    if (status != EXIT_FINE)
        return status;
    if (differ > 0)
        return option_error("mapping", "and --format must be one each, got %zu set-ups", count);
    return EXIT_FINE;
}

/* ---- What is printed --------------------------------------------------------------------------------------------- */

static code_said write_code(const wanted_code *w, output *out) {
    const bool uniforms = w->o->uniforms;
    const unsigned what = w->o->what;
    const char *unit = camera_unit(&w->o->camera);
    if (unit != NULL && (part_of(w) & CAMERA) != 0)
        code_say(out, w->language, "Lengths are in %s.", unit);
    return what == WHAT_PROJECTION ? code_projection(out, w->language, &w->camera)
           : what == WHAT_POSITION ? code_places(out, w->language, w->row, &w->camera, uniforms)
           : w->packing != NULL    ? code_packing(out, w->language, w->packing)
           : w->encoding != NULL   ? code_normal(out, w->language, w->encoding)
           : w->row != NULL        ? code_function(out, w->language, w->row, &w->setup, uniforms)
                                   : code_curve(out, w->language, &w->setup, what == WHAT_ENCODE, uniforms);
}

/* The same for programs. */
typedef struct printed {
    const char *language, *what, *method, *method_source, *source, *comparison, *code;
    int clear;
    char rules[2 * CODE_RULES_SIZE];
    code_said said;
} printed;

static void *next_claim(void *of, size_t i) {
    code_said *said = &((printed *)of)->said;
    return i < said->count ? &said->claims[i] : NULL;
}

/* clang-format off */
static const column claim_columns[] = {
    {FIELD(code_claim, function, "function", "")}, {FIELD(code_claim, bound, "bound", "")},
    {FIELD(code_claim, nearest, "nearest", "")}, {FIELD(code_claim, of, "of", "")}, {.kind = COLUMN_END}};
static const column printed_columns[] = {
    {FIELD(printed, language, "language", "")}, {FIELD(printed, what, "what", "")},
    {FIELD(printed, method, "method", "")}, {FIELD(printed, method_source, "method_source", "")},
    {FIELD(printed, clear, "clear", "")}, {FIELD(printed, comparison, "comparison", "")},
    {FIELD(printed, rules, "rules", "")}, {FIELD(printed, source, "source", "")}, {FIELD(printed, code, "code", "")},
    {LIST("bounds", claim_columns, next_claim)}, {.kind = COLUMN_END}};
/* clang-format on */

static void write_json(const wanted_code *w, const code_said *said, const char *code, output *out) {
    const bool reversed = w->setup.reversed != 0;
    const bool powers = w->setup.curve == DP_CURVE_LOG && w->language->powers != NULL;
    char rules[CODE_RULES_SIZE];
    printed p = {.language = w->language->name,
                 .what = option_word("what", w->o->what),
                 .method = w->method,
                 .method_source = w->source,
                 .clear = reversed ? 0 : 1,
                 .comparison = reversed ? "greater" : "less",
                 .source = w->language->source,
                 .code = code,
                 .said = *said};
    append(p.rules, sizeof p.rules, "%s: %s%s%s", w->language->rules, code_language_rules(w->language, rules),
           powers ? "; " : "", powers ? w->language->powers : "");
    report_write(&(report_spec){"code", printed_columns, &p, .when = 0}, out, FORM_JSON);
}

int cmd_code(void *request) {
    const code_request *o = request;
    static output out, text = {.fd = -1}; /* the code is shorter than the buffer */
    const unsigned what = o->what;
    wanted_code w = {.o = o, .language = o->language};
    int status = find_setup(&w);
    if (status == EXIT_FINE)
        status = check_needless(&w);
    if (status == EXIT_FINE)
        status = check_language(&w);
    if (status == EXIT_FINE)
        status = (what == WHAT_PROJECTION                    ? find_matrix
                  : what == WHAT_PACK || what == WHAT_NORMAL ? find_packed
                                                             : find_method)(&w);
    if (status == EXIT_FINE && (what == WHAT_PROJECTION || what == WHAT_POSITION))
        status = find_view(&w);
    if (status == EXIT_FINE)
        status = output_start(&o->out, &o->camera, &out);
    if (status != EXIT_FINE)
        return status;
    const code_said said = write_code(&w, &text);
    output_char(&text, '\0');
    if (o->out.form == FORM_JSON)
        write_json(&w, &said, text.buffer, &out);
    else
        output_text(&out, text.buffer);
    return output_close(&out);
}
