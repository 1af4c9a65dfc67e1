/* SPDX-License-Identifier: GPL-3.0-or-later */
/* code: a method or a projection matrix for the camera at hand, in a language, to take away. */
#include <string.h>

#include "cli/option/rows.h"
#include "cli/setups.h"
#include "code/code.h"
#include "core/append.h"

/* What --what names, in its order. */
enum { WHAT_LINEARIZE, WHAT_PROJECTION, WHAT_ENCODE, WHAT_POSITION };

typedef struct wanted_code {
    const options *o;
    const code_language *language;
    const method_family_row *family;
    const method_row *row;
    dp_setup setup;
    texture_camera camera;
} wanted_code;

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

static int find_method(wanted_code *w) {
    const options *o = w->o;
    const dp_format *format = &w->setup.spec.format;
    w->family = o->code.what == WHAT_ENCODE ? &encode_family : &linearize_family;
    if (o->code.what == WHAT_ENCODE && (format->kind != DP_FORMAT_UNORM || format->code_max > 0xffffff))
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

/* How wide it sees. */
static int find_view(wanted_code *w) {
    const options *o = w->o;
    const int width = (int)o->view.spec.width, height = (int)o->view.spec.height;
    camera_spec view = o->view.spec;
    if (w->language->matrix == NULL)
        return option_error(OPTION_LANGUAGE, "must be glsl, hlsl, wgsl, msl, c or numpy with --what %s, got %s",
                            option_word(OPTION_WHAT, o->code.what), w->language->name);
    if (o->camera.preset_count > 0 && !option_given(o, OPTION_FOV) && !option_given(o, OPTION_HFOV))
        view.fov_y = preset_fov_y(o->camera.presets[0], width, height);
    else if (view_vertical(o, width, height, &view.fov_y) != EXIT_FINE)
        return EXIT_USAGE;
    const char *wrong = camera_init(&w->camera, &w->setup, &view);
    return wrong == NULL ? EXIT_FINE : usage_error("code: %s", wrong);
}

static int find_matrix(wanted_code *w) {
    if (w->o->operand_count > 0)
        return usage_error("code: a projection matrix has no METHOD, got '%s'", w->o->operands[0]);
    if (w->o->code.uniforms)
        return option_error(OPTION_UNIFORMS, "conflicts with --what projection, all of which is constants");
    return find_view(w);
}

/* One camera whose depth a matrix makes. */
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
    if (w->setup.curve != DP_CURVE_PERSPECTIVE)
        return option_error(OPTION_MAPPING, "must be one of " DP_MAPPING_NAMES_PERSPECTIVE ", got %s",
                            dp_mapping_get(w->setup.spec.mapping)->name);
    return EXIT_FINE;
}

int cmd_code(const options *o) {
    output out;
    wanted_code w = {.o = o, .language = o->code.language};
    const bool projection = o->code.what == WHAT_PROJECTION, position = o->code.what == WHAT_POSITION;
    int status = find_setup(&w);
    if (status == EXIT_FINE)
        status = projection ? find_matrix(&w) : find_method(&w);
    if (status == EXIT_FINE && position)
        status = find_view(&w);
    if (status == EXIT_FINE && o->code.uniforms && w.language->form != CODE_INFIX)
        status = option_error(OPTION_UNIFORMS, "conflicts with %s, which is about one camera", w.language->name);
    if (status == EXIT_FINE)
        status = options_open(o, &out);
    if (status != EXIT_FINE)
        return status;
    if (projection)
        code_projection(&out, w.language, &w.camera);
    else if (position)
        code_places(&out, w.language, w.row, &w.camera, o->code.uniforms);
    else
        code_function(&out, w.language, w.row, &w.setup, o->code.uniforms);
    return output_close(&out);
}
