/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdio.h>

#include "core/append.h"
#include "plot/cmd_plot/figure_file.h"
#include "texture/cmd_texture/request.h"
#include "texture/cmd_texture/texture.h"
#include "texture/cmd_texture/writing.h"
#include "texture/normals.h"

bool texture_product_wanted(const texture_request *o) {
    const bool described = o->image.effect != NULL && option_given(o->line, "pixel");
    return (o->image.product != NULL && !o->image.product->packed && o->image.pack == NULL && !described) ||
           o->image.figure != NULL;
}

int texture_effect_normals(const texture_request *o, texture_source *s) {
    if (o->image.effect == NULL || (o->image.effect->needs & EFFECT_NORMALS) == 0 ||
        (s->path == NULL && o->image.normals_by == NULL))
        return EXIT_FINE;
    if (o->image.normals_by == NULL && s->unpacked.normals != NULL)
        s->normals =
            (frame_normals){.texels = s->unpacked.normals, .truncated = s->unpacked.grain.rounding == GRAIN_ZERO};
    else if (!frame_normals_make(&s->frame,
                                 o->image.normals_by != NULL ? o->image.normals_by : normal_get(NORMAL_PROJECTIVE),
                                 option_given(o->line, "error-map") || option_given(o->line, "pixel"), &s->normals))
        return usage_error("texture: no memory");
    s->frame.normals = &s->normals;
    return EXIT_FINE;
}

int texture_picture_open(const texture_request *o, texture_source *s) {
    const image *p = &s->colours;
    image_error error;
    if (o->image.picture == NULL)
        return EXIT_FINE;
    if (!image_read(o->image.picture, &s->colours, &error)) {
        usage_error("%s: %s", o->image.picture, error.text);
        return error.unreadable ? EXIT_IO : EXIT_USAGE;
    }
    if (p->file != IMAGE_PNG || p->channels < 3)
        return option_error("picture", "must be a PNG with three channels, or four, got %s of %u",
                            image_file_name(p->file), p->channels);
    if (p->width != s->camera.width || p->height != s->camera.height)
        return option_error("picture", "must be as large as the depths, %u x %u pixels, got %u x %u", s->camera.width,
                            s->camera.height, p->width, p->height);
    return EXIT_FINE;
}

/* The parameters that are not the synthetic image's are the effect's. */
int texture_product_effect(const texture_request *o, texture_product *p) {
    texture_request rest = *o;
    rest.image.parameter_count = 0;
    for (size_t i = 0; i < o->image.parameter_count; i++)
        if (!texture_scene_takes(o, o->image.parameters[i].name))
            rest.image.parameters[rest.image.parameter_count++] = o->image.parameters[i];
    int status = texture_effect_resolve(&rest, true, &p->made.effect, p->settings);
    if (status != EXIT_FINE)
        return status;
    const effect_row *row = p->made.effect;
    p->made.kind = FRAME_EFFECT;
    p->made.effect_settings = p->settings;
    const int at = parameter_find(row->parameters, "reference"), share = parameter_find(row->parameters, "reference01");
    if (share >= 0 && !isnan(p->settings[at]) && !isnan(p->settings[share]))
        return option_error("parameter", "reference01 conflicts with reference");
    if (row->given && !o->image.error_map && isnan(effect_reference(row, p->settings, 1)))
        return option_error("parameter", "%s needs reference=Z, the %s%s; it was not given", row->name,
                            row->parameters[at].note, row->eye01 ? ", or reference01=V, the same over far" : "");
    return EXIT_FINE;
}

static int check_files(const texture_request *o) {
    image_file file = IMAGE_FILE_COUNT, other;
    if (o->out.file == NULL && o->image.figure == NULL)
        return usage_error("texture: a product needs -o FILE that ends in .png, .pfm or .npy, or --figure FILE");
    if (o->out.file != NULL && !image_file_of(o->out.file, &file))
        return option_error("output", "must end in .png, .pfm or .npy for a product, got '%s'", o->out.file);
    if (o->image.error_file != NULL && !image_file_of(o->image.error_file, &other))
        return option_error("error-map", "must end in .png, .pfm or .npy, got '%s'", o->image.error_file);
    if (o->image.error_file != NULL && o->out.file == NULL)
        return option_error("error-map", "needs -o FILE for the product beside it, got '%s'", o->image.error_file);
    canvas_format type;
    if (o->image.figure != NULL && figure_file_type(o->line, &o->figure, "figure", o->image.figure, &type) != EXIT_FINE)
        return EXIT_USAGE;
    if (o->out.form == FORM_CSV || (o->out.form == FORM_JSON && o->out.file == NULL))
        return option_error(o->out.form == FORM_JSON ? "json" : "csv",
                            "is for statistics, which a product does not have%s",
                            o->out.form == FORM_JSON ? "; with -o FILE it says what the numbers in FILE are" : "");
    if (o->image.picture != NULL && (o->out.file == NULL || file != IMAGE_PNG || o->image.effect == NULL ||
                                     o->image.error_map || o->image.figure != NULL || option_given(o->line, "range")))
        return option_error("picture", "is for --product effect and a PNG of -o, without --error-map, --figure "
                                       "and --range; --error-map=FILE says what the effect is off by");
    if (option_given(o->line, "range") &&
        (o->out.file == NULL || file != IMAGE_PNG || o->image.error_map || o->image.effect == NULL))
        return option_error("range", "is for the values of an effect in a PNG");
    if (option_given(o->line, "normal-format") && (o->out.file == NULL || file != IMAGE_PNG || o->image.error_map))
        return option_error("normal-format", "is for the normals in a PNG");
    return EXIT_FINE;
}

static const char *method_of(const texture_request *o) {
    return o->image.effect != NULL ? o->image.effect->name : o->image.normal != NULL ? o->image.normal->name : "exact";
}

int texture_product_resolve(const texture_request *o, texture_product *p) {
    const product_row *row =
        o->image.product != NULL ? o->image.product : product_get(0); /* where --figure is all that was said */
    int status = EXIT_FINE;
    *p = (texture_product){.made = {.kind = row->kind,
                                    .error = o->image.error_map,
                                    .radial = row->radial,
                                    .position = o->image.position,
                                    .normal = o->image.normal,
                                    .effect_settings = p->settings},
                           .unit = o->image.error_map ? row->unit_of_error : row->unit,
                           .unit_of_error = row->unit_of_error};
    snprintf(p->name, sizeof p->name, "%s%s", row->by,
             row->methods == NULL        ? ""
             : o->image.position != NULL ? o->image.position->name
                                         : method_of(o));
    if (o->image.overlay > 0 && (o->image.error_map || row->kind >= FRAME_POSITION))
        return option_error("overlay", "does not apply with --%s%s, only with --product eye, radial, linear01 and raw",
                            o->image.error_map ? "error-map" : "product ", o->image.error_map ? "" : row->name);
    if (row->kind == FRAME_EFFECT)
        status = texture_product_effect(o, p);
    p->made.vector = status == EXIT_FINE && row->kind == FRAME_EFFECT &&
                     (p->made.effect->wide || (o->image.picture != NULL && p->made.effect->mix == EFFECT_SMEARS));
    if (o->image.as != NULL && (row->kind != FRAME_EYE || row->radial))
        return option_error("as", "is for --product eye");
    if (status == EXIT_FINE)
        status = texture_lattice(o->camera.lengths.unit, "as", o->image.as, &p->as);
    if (o->image.as != NULL)
        p->made.as = &p->as;
    p->made.hides = o->image.picture != NULL && row->kind == FRAME_EFFECT && p->made.effect->surface;
    p->error = p->made;
    p->error.error = true;
    return status == EXIT_FINE ? check_files(o) : status;
}

/* Levels that begin at 0, or are as many between the nearest and the farthest depth. */
static bool find_levels(const texture_source *s, texture_product *p) {
    const frame_product eye = {.kind = FRAME_EYE};
    frame_summary sum = {0};
    if (!isnan(p->as.levels) && !frame_summarise(&s->frame, &eye, &sum))
        return false;
    sensor_between(sum.lo, sum.hi, &p->as);
    p->as.offset = isnan(p->as.offset) ? 0 : p->as.offset;
    return true;
}

/* A PNG of multiples of a step holds 65534 of them: 65535 is a hole to many readers. */
static int check_steps(const texture_request *o, const texture_source *s, const texture_product *p) {
    const double step = writing_step(&p->made);
    image_file file;
    frame_summary sum;
    if (!(step > 0) || o->out.file == NULL || !image_file_of(o->out.file, &file) || file != IMAGE_PNG)
        return EXIT_FINE;
    if (!frame_summarise(&s->frame, &p->made, &sum))
        return usage_error("texture: no memory for the levels of --as");
    return sum.count == 0 || sum.hi <= step * (GREYS - 0.5)
               ? EXIT_FINE
               : option_error("as",
                              "is in steps of %s, of which a PNG holds 65534, up to %s, and the farthest depth is %s: "
                              "take a larger step, or write .npy",
                              number_full(step).text, number_full(step * (GREYS - 1)).text, number_full(sum.hi).text);
}

int texture_product_check(const texture_request *o, const texture_source *s, texture_product *p) {
    static const char *const truths[][2] = {
        [FRAME_EYE] = {"half of each cell", "error"},
        [FRAME_LINEAR01] = {"half of each cell", "error"},
        [FRAME_RAW] = {"half of each cell", "error"},
        [FRAME_POSITION] = {"largest possible error", "error"},
        [FRAME_NORMAL] = {"bound of the error on planes", "error"},
        [FRAME_EFFECT] = {"largest possible error", "largest possible error"},
    };
    if (p->made.kind == FRAME_LINEAR01 && !texture_far_known(o))
        return option_error("product", "linear01 needs --far with --metric and --stereo, which have none");
    if (o->image.as != NULL && !find_levels(s, p))
        return usage_error("texture: no memory for the levels of --as");
    const char *wrong = frame_refuses(&s->frame, o->image.error_file != NULL ? &p->error : &p->made);
    if (wrong != NULL)
        return usage_error("texture: %s: %s", p->name, wrong);
    if (p->made.error)
        append(p->name, sizeof p->name, ", %s", truths[p->made.kind][s->path == NULL]);
    return p->made.error || o->image.as == NULL ? EXIT_FINE : check_steps(o, s, p);
}
