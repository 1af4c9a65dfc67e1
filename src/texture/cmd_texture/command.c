/* SPDX-License-Identifier: GPL-3.0-or-later */
/* texture: a depth image, or a synthetic image in its place. */
#include <stdio.h>
#include <string.h>

#include "report/message.h"
#include "texture/cmd_texture/request.h"
#include "texture/cmd_texture/texture.h"

/* Options that need a product, or a figure of one. */
static int check_alone(const texture_request *o) {
    static const char *const drawn[] = {"overlay", "type", "theme", "figure-size", "title"};
    if (o->image.error_map && o->image.effect != NULL && option_given(o->line, "pixel"))
        return option_error("error-map", "conflicts with --pixel, which says the error");
    if (option_given(o->line, "error-map") && !texture_product_wanted(o))
        return option_error("error-map", "needs --product");
    if (o->image.as != NULL && !texture_product_wanted(o))
        return option_error("as", "needs --product eye");
    if (option_given(o->line, "range") && !texture_product_wanted(o))
        return option_error("range", "needs --product effect");
    if (o->image.picture != NULL && !texture_product_wanted(o))
        return option_error("picture", "needs --product effect");
    if (o->image.sky < 0 && !texture_product_wanted(o) && !option_given(o->line, "pixel"))
        return option_error("sky", "none is for --product and --pixel");
    if (option_given(o->line, "normal-format") && o->image.normal == NULL)
        return option_error("normal-format", "needs --product normal or packed-normal");
    if (option_given(o->line, "pixel") && texture_product_wanted(o))
        return option_error("pixel", "describes single pixels, and makes no image or figure");
    for (size_t i = 0; i < sizeof drawn / sizeof drawn[0]; i++)
        if (option_given(o->line, drawn[i]) && o->image.figure == NULL &&
            (o->image.histogram == NULL || option_is(drawn[i], "overlay")))
            return option_error(drawn[i], "needs --figure%s", option_is(drawn[i], "overlay") ? "" : " or --histogram");
    if (option_given(o->line, "histogram") && o->out.file != NULL && o->out.form == FORM_TEXT)
        return option_error("histogram", "conflicts with --output");
    if (option_given(o->line, "histogram") && o->out.form != FORM_TEXT && strcmp(o->image.histogram, "-") == 0)
        return option_error("histogram", "must be a file with --json and --csv, got '-'");
    if (option_given(o->line, "histogram") && texture_product_wanted(o))
        return option_error("histogram", "shows the depths, not a product");
    return EXIT_FINE;
}

static int make_product(const texture_request *o, const texture_source *source, texture_product *product) {
    int status = texture_product_check(o, source, product);
    if (status == EXIT_FINE && source->path != NULL && source->found.invalid > 0 && !o->out.quiet)
        message("depthprec: %s: %zu pixels hold no window depth and become NaN", source->path, source->found.invalid);
    if (status == EXIT_FINE && o->out.file != NULL)
        status = texture_product_write(o, source, product);
    if (status == EXIT_FINE && o->image.figure != NULL)
        status = texture_figure_draw(o, source, product);
    return status;
}

int cmd_texture(void *request) {
    texture_request *o = request;
    texture_product product = {0};
    if (o->image.picture != NULL && !option_given(o->line, "sky"))
        o->image.sky = -1;
    if (o->image.packing != NULL && o->image.packing->steps == 0 && o->image.normal != NULL)
        for (size_t i = 0; !o->image.product->packed; i++) /* of no depth, there are no other normals */
            o->image.product = product_get(i);
    const bool beside = o->image.product != NULL && o->image.product->packed, packed = o->image.pack != NULL || beside;
    const bool described = option_given(o->line, "pixel") && o->image.effect != NULL;
    const bool made = !packed && texture_product_wanted(o);
    if (o->image.effect != NULL && o->line->operand_count == 0 && o->image.synthetic == NULL)
        return texture_effect_table(o);
    texture_source source = {0};
    const bool reduced = option_given(o->line, "hi-z");
    int status = reduced ? texture_hi_z_check(o) : packed ? texture_pack_check(o) : check_alone(o);
    if (status == EXIT_FINE && made)
        status = texture_product_resolve(o, &product);
    else if (status == EXIT_FINE && described)
        status = texture_product_effect(o, &product);
    if (status == EXIT_FINE)
        status = texture_source_open(o, &source);
    if (status == EXIT_FINE && (made || described))
        status = texture_effect_normals(o, &source);
    if (status == EXIT_FINE && made && !reduced)
        status = texture_picture_open(o, &source);
    if (status == EXIT_FINE && reduced)
        status = texture_hi_z_write(o, &source);
    else if (status == EXIT_FINE && made)
        status = make_product(o, &source, &product);
    else if (status == EXIT_FINE && o->image.pack != NULL)
        status = texture_pack_write(o, &source);
    else if (status == EXIT_FINE && beside)
        status = texture_packed_normal_write(o, &source);
    else if (status == EXIT_FINE && option_given(o->line, "pixel"))
        status = texture_pixel_write(o, &source, described ? &product.made : NULL);
    else if (status == EXIT_FINE && o->image.histogram != NULL)
        status = texture_histogram_draw(o, &source);
    else if (status == EXIT_FINE && o->image.synthetic != NULL && o->out.file != NULL && o->out.form == FORM_TEXT)
        status = texture_depth_write(o, &source, &source.setup.spec.format, NULL);
    else if (status == EXIT_FINE)
        status = texture_report_write(o, &source);
    texture_source_close(&source);
    return status;
}
