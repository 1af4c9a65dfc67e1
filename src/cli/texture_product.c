/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "cli/figure_file.h"
#include "cli/texture.h"
#include "core/append.h"
#include "texture/frame_normals.h"

bool texture_normals_compared(const options *o) {
    return o->normal != NULL && o->effect != NULL && (o->effect->needs & EFFECT_NORMALS) != 0;
}

bool texture_product_wanted(const options *o) {
    const bool described = option_given(o, OPTION_PIXEL);
    return o->eye || o->linear01 || o->raw || option_given(o, OPTION_POSITION) ||
           (o->normal != NULL && !texture_normals_compared(o)) || (o->effect != NULL && !described) ||
           o->figure != NULL;
}

int texture_effect_normals(const options *o, texture_source *s) {
    if (o->effect == NULL || (o->effect->needs & EFFECT_NORMALS) == 0 || (s->path == NULL && o->normal == NULL))
        return EXIT_FINE;
    if (o->normal == NULL && s->unpacked.normals != NULL)
        s->normals =
            (frame_normals){.texels = s->unpacked.normals, .truncated = s->unpacked.grain.rounding == GRAIN_ZERO};
    else if (!frame_normals_make(&s->frame, o->normal != NULL ? o->normal : normal_get(NORMAL_PROJECTIVE),
                                 option_given(o, OPTION_ERROR_MAP) || option_given(o, OPTION_PIXEL), &s->normals))
        return usage_error("texture: no memory");
    s->frame.normals = &s->normals;
    return EXIT_FINE;
}

/* The parameters that are not the synthetic image's are the effect's, but for the depth that it compares with. */
int texture_product_effect(const options *o, texture_product *p) {
    options rest = *o;
    bool compared = false;
    rest.parameter_count = 0;
    for (size_t i = 0; i < o->parameter_count; i++) {
        if (o->effect->given && strcmp(o->parameters[i].name, "reference") == 0) {
            p->made.reference = o->parameters[i].value;
            compared = true;
        } else if (!texture_scene_takes(o, o->parameters[i].name)) {
            rest.parameters[rest.parameter_count++] = o->parameters[i];
        }
    }
    int status = texture_effect_resolve(&rest, true, &p->made.effect, p->settings);
    if (status != EXIT_FINE)
        return status;
    const effect_row *row = p->made.effect;
    p->made.kind = FRAME_EFFECT;
    p->made.effect_settings = p->settings;
    if (row->given && (compared || !o->error_map) && !(p->made.reference > 0))
        return option_error(OPTION_PARAMETER, "%s needs reference=Z, %s, a positive eye depth%s", row->name,
                            row->reference, compared ? "" : "; it was not given");
    return EXIT_FINE;
}

static const struct {
    frame_kind kind;
    option_id option;
    const char *by, *unit, *unit_of_error;
} kinds[] = {{FRAME_EYE, OPTION_EYE, "", "scene units", "scene units"},
             {FRAME_LINEAR01, OPTION_LINEAR01, "", "", ""},
             {FRAME_RAW, OPTION_RAW, "", "", ""},
             {FRAME_POSITION, OPTION_POSITION, "positions by ", "scene units", "scene units"},
             {FRAME_NORMAL, OPTION_NORMAL, "normals by ", "", "degrees"},
             {FRAME_EFFECT, OPTION_EFFECT, "", "", "levels of 1/255"}};

static int check_files(const options *o) {
    image_file file = IMAGE_FILE_COUNT;
    if (o->output == NULL && o->figure == NULL)
        return usage_error("texture: a product needs -o FILE that ends in .png, .pfm or .npy, or --figure FILE");
    if (o->output != NULL && !image_file_of(o->output, &file))
        return option_error(OPTION_OUTPUT, "must end in .png, .pfm or .npy for a product, got '%s'", o->output);
    if (o->error_file != NULL && !image_file_of(o->error_file, &file))
        return option_error(OPTION_ERROR_MAP, "must end in .png, .pfm or .npy, got '%s'", o->error_file);
    if (o->error_file != NULL && o->output == NULL)
        return option_error(OPTION_ERROR_MAP, "needs -o FILE for the product beside it, got '%s'", o->error_file);
    canvas_format type;
    if (o->figure != NULL && figure_file_type(o, OPTION_FIGURE, o->figure, &type) != EXIT_FINE)
        return EXIT_USAGE;
    if (o->form == FORM_CSV || (o->form == FORM_JSON && o->output == NULL))
        return option_error(o->form == FORM_JSON ? OPTION_JSON : OPTION_CSV,
                            "is for statistics, which a product does not have%s",
                            o->form == FORM_JSON ? "; with -o FILE it says what the numbers in FILE are" : "");
    if (option_given(o, OPTION_NORMAL_FORMAT) && (o->output == NULL || file != IMAGE_PNG || o->error_map))
        return option_error(OPTION_NORMAL_FORMAT, "is for the normals in a PNG");
    return EXIT_FINE;
}

int texture_product_resolve(const options *o, texture_product *p) {
    size_t chosen = 0; /* eye depth, where --figure is all that was said */
    const char *const names[] = {[FRAME_EYE] = o->radial ? "distance from the camera" : "eye depth",
                                 [FRAME_LINEAR01] = "eye depth over far",
                                 [FRAME_RAW] = "window depth",
                                 [FRAME_POSITION] = o->position != NULL ? o->position->name : "exact",
                                 [FRAME_NORMAL] = o->normal != NULL ? o->normal->name : "",
                                 [FRAME_EFFECT] = o->effect != NULL ? o->effect->name : ""};
    *p = (texture_product){.made = {.error = o->error_map, .radial = o->radial}};
    int status = EXIT_FINE;
    for (size_t i = 0, found = 0; i < sizeof kinds / sizeof kinds[0] && status == EXIT_FINE; i++)
        if (option_given(o, kinds[i].option) && !(kinds[i].kind == FRAME_NORMAL && texture_normals_compared(o))) {
            if (found++ > 0)
                status =
                    option_error(kinds[i].option, "cannot be combined with --%s", option_name(kinds[chosen].option));
            chosen = i;
        }
    if (status == EXIT_FINE && o->radial && kinds[chosen].kind != FRAME_EYE)
        status = option_error(OPTION_RADIAL, "does not apply with --%s", option_name(kinds[chosen].option));
    p->made.kind = kinds[chosen].kind;
    if (status == EXIT_FINE && o->overlay > 0 && (o->error_map || p->made.kind >= FRAME_POSITION))
        status = option_error(OPTION_OVERLAY, "does not apply with --%s, only with --eye, --linear01 and --raw",
                              option_name(o->error_map ? OPTION_ERROR_MAP : kinds[chosen].option));
    p->made.position = o->position;
    p->made.normal = o->normal;
    p->made.effect_settings = p->settings;
    p->unit = o->error_map ? kinds[chosen].unit_of_error : kinds[chosen].unit;
    snprintf(p->name, sizeof p->name, "%s%s", kinds[chosen].by, names[p->made.kind]);
    if (status == EXIT_FINE && p->made.kind == FRAME_EFFECT)
        status = texture_product_effect(o, p);
    p->error = p->made;
    p->error.error = true;
    p->unit_of_error = kinds[chosen].unit_of_error;
    if (status == EXIT_FINE)
        status = check_files(o);
    return status;
}

int texture_product_check(const options *o, const texture_source *s, texture_product *p) {
    static const char *const truths[][2] = {
        [FRAME_EYE] = {"half of each cell", "error"},
        [FRAME_LINEAR01] = {"half of each cell", "error"},
        [FRAME_RAW] = {"half of each cell", "error"},
        [FRAME_POSITION] = {"largest possible error", "error"},
        [FRAME_NORMAL] = {"bound of the error on planes", "error"},
        [FRAME_EFFECT] = {"largest possible error", "largest possible error"},
    };
    if (p->made.kind == FRAME_LINEAR01 && !texture_far_known(o))
        return option_error(OPTION_LINEAR01, "needs --far with --metric, which has none");
    const char *wrong = frame_refuses(&s->frame, o->error_file != NULL ? &p->error : &p->made);
    if (wrong != NULL)
        return usage_error("texture: %s: %s", p->name, wrong);
    if (p->made.error)
        append(p->name, sizeof p->name, ", %s", truths[p->made.kind][s->path == NULL]);
    return EXIT_FINE;
}
