/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What follows from other options: what presets, platforms and rasterizers give where the user did not. */
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "cli/depth24plus.h"
#include "cli/option/rows.h"
#include "core/engine.h"
#include "plot/figure.h"
#include "report/number.h"

/* The rule under which the bias is written. */
static void take_api(options *o, const char *api) {
    if (!option_given(o, OPTION_API))
        parse_apis(o, &option_rows[OPTION_API], api);
}

/* three.js has one word for the logarithms of two renderers. */
static void take_logarithm(options *o, const preset *p) {
    static const char word[] = "logarithmicDepthBuffer";
    const char *given =
        option_given(o, OPTION_MAPPING) && strcmp(p->api, "webgpu") == 0 ? o->given[OPTION_MAPPING] : "";
    while (*given != '\0' && strncasecmp(given, word, sizeof word - 1) != 0)
        given++;
    for (size_t i = 0; i < o->camera.mapping_count && *given != '\0'; i++)
        if (o->camera.mappings[i] == DP_MAPPING_THREE_WEBGL)
            o->camera.mappings[i] = DP_MAPPING_THREE_WEBGPU;
}

/* A preset gives what the user did not. */
static void take_preset(options *o, const preset *p) {
    static const option_id chosen[] = {OPTION_NEAR, OPTION_FAR, OPTION_FORMAT, OPTION_MAPPING};
    const unit_row *own = unit_find(p->unit);
    option_chosen(o, OPTION_PRESET, p->name, chosen, sizeof chosen / sizeof chosen[0]);
    if (!option_given(o, OPTION_NEAR))
        o->camera.znear = unit_convert(p->znear, own, o->camera.unit);
    if (!option_given(o, OPTION_FAR))
        o->camera.zfar = unit_convert(p->zfar, own, o->camera.unit);
    if (!option_given(o, OPTION_LOG_C)) /* 1 for a depth in the preset's own unit */
        o->camera.log_c /= unit_convert(1.0, own, o->camera.unit);
    if (!option_given(o, OPTION_FORMAT))
        parse_formats(o, &option_rows[OPTION_FORMAT], p->format);
    if (!option_given(o, OPTION_MAPPING))
        parse_mappings(o, &option_rows[OPTION_MAPPING], dp_mapping_get(p->mapping)->name);
    take_logarithm(o, p);
    take_api(o, p->api);
    slant_take_preset(o, p);
}

/* What is stored; a preset's format and rasterizer give way to it, its mapping stays. */
static void take_platform(options *o) {
    const platform *p = o->camera.platform;
    if (p == NULL)
        return;
    const bool webgl = strcmp(p->api, "gl") == 0;
    static const option_id chosen[] = {OPTION_FORMAT, OPTION_MAPPING};
    const char *stored = depth24plus_on(p, o->given[OPTION_FORMAT]);
    option_chosen(o, OPTION_PLATFORM, p->name, chosen,
                  o->camera.preset_count == 0 ? 2 : 1); /* a preset's mapping stays */
    if (!option_given(o, OPTION_FORMAT) || stored != NULL)
        parse_formats(o, &option_rows[OPTION_FORMAT], stored != NULL ? stored : p->stored);
    if (!option_given(o, OPTION_MAPPING) && o->camera.preset_count == 0)
        parse_mappings(o, &option_rows[OPTION_MAPPING], webgl ? "gl" : "d3d");
    bool remapped = false;
    for (size_t i = 0; i < o->camera.mapping_count && p->remap != PLATFORM_REMAPS_NOT; i++)
        remapped = remapped || dp_mapping_get(o->camera.mappings[i])->ndc_signed;
    if (!option_given(o, OPTION_ARITH) && remapped)
        dp_arith_parse("ieee-remap", &o->camera.arith);
    take_api(o, p->api);
    slant_take_raster(o, p->raster);
}

/* Of a rasterizer that is known its own arithmetic, with the remap of the platform. */
static int take_arith(options *o) {
    const bool known = o->camera.has_raster_arith || (o->camera.raster != NULL && o->camera.raster->model != NULL);
    if (!known || option_given(o, OPTION_ARITH))
        return EXIT_FINE;
    const bool remapped = dp_arith_get(o->camera.arith)->remap;
    if (o->camera.has_raster_arith && dp_arith_get(o->camera.raster_arith)->remap == remapped)
        o->camera.arith = o->camera.raster_arith;
    else if (o->camera.raster->model != NULL && !raster_arith(o->camera.raster, remapped, &o->camera.arith))
        return option_error(OPTION_RASTER,
                            "%s was not measured with [-1, 1] remapped in the vertex shader, as on %s: name its "
                            "arithmetic with --arith",
                            o->camera.raster->name,
                            o->camera.platform != NULL ? o->camera.platform->name : "the platform");
    return EXIT_FINE;
}

/* The options as they would be with that preset alone, all lengths in its own unit where that is known and --unit was
 * not given. */
static options with_preset(const options *o, const preset *p) {
    options out = *o;
    options_camera *c = &out.camera;
    const unit_row *own = option_given(o, OPTION_UNIT) ? NULL : unit_find(p->unit), *from = c->unit;
    double *const lengths[] = {&c->znear, &c->zfar, &c->range_lo, &c->range_hi, &c->at.lo, &c->at.hi};
    c->unit = own != NULL ? own : from;
    c->typed_count = 0; /* none of them is converted */
    for (size_t i = 0; i < sizeof lengths / sizeof lengths[0]; i++)
        *lengths[i] = unit_convert(*lengths[i], from, c->unit);
    c->at.from = from;
    c->at.to = c->unit;
    take_preset(&out, p);
    take_platform(&out);
    take_arith(&out); /* not refused: of the same rasterizer and platform it was asked before */
    return out;
}

/* Several presets are resolved once. */
static int resolve_each(options *o) {
    const size_t count = o->camera.preset_count;
    options *each = malloc(count * sizeof *each);
    if (each == NULL)
        return usage_error("no memory for %zu presets", count);
    for (size_t i = 0; i < count; i++)
        each[i] = with_preset(o, o->camera.presets[i]);
    o->each = each;
    return EXIT_FINE;
}

int options_check_stored(const options *o, const dp_format *format) {
    char names[PROFILE_FORMATS_SIZE];
    if (profile_stores(&o->camera.gpu, format))
        return EXIT_FINE;
    return option_error(OPTION_FORMAT, "must be %s with a profile of a GPU that stores no other depth, got %s",
                        profile_formats(&o->camera.gpu, names), format->name);
}

/* Of formats that nobody named those that the GPUs of the profiles store; one that was named has to be among them. */
static int keep_stored(options *o) {
    const bool given = option_given(o, OPTION_FORMAT);
    const bool any =
        given ? strcmp(o->given[OPTION_FORMAT], "all") == 0 : o->camera.preset_count == 0 && o->camera.platform == NULL;
    size_t kept = 0;
    for (size_t i = 0; i < o->camera.format_count; i++) {
        if (profile_stores(&o->camera.gpu, &o->camera.formats[i]))
            o->camera.formats[kept++] = o->camera.formats[i];
        else if (!any || (i + 1 == o->camera.format_count && kept == 0))
            return options_check_stored(o, &o->camera.formats[i]);
    }
    o->camera.format_count = kept;
    return EXIT_FINE;
}

/* An orthographic camera may begin at its place or behind it. */
static int check_near(const options *o) {
    const option_row *row = &option_rows[OPTION_NEAR];
    const number_text given = number_full(o->camera.znear);
    char limits[OPTION_TEXT_SIZE];
    if (o->camera.znear > 0.0)
        return EXIT_FINE;
    if (!o->camera.ortho)
        return option_error(OPTION_NEAR, "must be a number from %s, got '%s'", option_limits(row, limits), given.text);
    if (o->camera.znear != 0.0 && !(-o->camera.znear >= row->least && -o->camera.znear <= row->most))
        return option_error(OPTION_NEAR, "must be 0, or a number from %s or its negative, got '%s'",
                            option_limits(row, limits), given.text);
    if (o->image.effect != NULL && o->image.effect->eye01 && o->camera.znear < 0.0)
        return option_error(OPTION_PRODUCT,
                            "effect:%s sees eye depth as a share of far, which needs near not less than 0, got '%s'",
                            o->image.effect->name, given.text);
    return EXIT_FINE;
}

/* A colour target's depth is compared with a buffer's, and stands for none. */
static int check_rg(const options *o) {
    const figure_row *figure = o->command->id == CMD_PLOT ? o->operand_row : NULL;
    const bool shown = o->command->id == CMD_TABLE || (figure != NULL && (figure->takes & FIGURE_SETUPS) != 0);
    for (size_t i = 0; i < o->camera.format_count; i++) {
        const bool rg = dp_format_is_rg(&o->camera.formats[i]);
        if (rg && !shown)
            return option_error(OPTION_FORMAT,
                                "rg is no depth buffer: table and figures of set-ups show it, and texture "
                                "has it as a packing");
        if (rg && o->camera.rounding != DP_ROUND_NEAREST)
            return option_error(OPTION_ROUNDING, "must be nearest with rg, got %s",
                                dp_rounding_name(o->camera.rounding));
    }
    return EXIT_FINE;
}

int options_complete(options *o) {
    o->camera.model_auto = o->camera.model == DP_MODEL_COUNT;
    if (o->camera.model_auto)
        o->camera.model = DP_MODEL_EXACT;
    for (size_t i = 0; i < o->camera.preset_count && o->camera.unit != NULL && !option_given(o, OPTION_UNIT); i++)
        if (strcmp(o->camera.presets[i]->unit, "extents") == 0)
            return option_error(OPTION_UNIT, "must be given: %s measures in %s", o->camera.presets[i]->name,
                                o->camera.presets[i]->unit);
    if (o->camera.platform != NULL && o->camera.platform->remap == PLATFORM_SPREADS)
        return option_error(
            OPTION_PLATFORM,
            "has no guarantee for %s, whose vertex shader spreads [0, 1] to [-1, 1] by 2 z - w: a small "
            "z loses its digits; -F %s tells of the format alone",
            o->camera.platform->name, o->camera.platform->stored);
    int status = check_rg(o);
    if (status == EXIT_FINE)
        status = slant_complete(o);
    if (o->camera.preset_count == 1)
        take_preset(o, o->camera.presets[0]);
    take_platform(o);
    if (status == EXIT_FINE)
        status = take_arith(o);
    if (!option_given(o, OPTION_SCHEME)) /* sizes in what a scene unit is, now that it is known */
        parse_schemes(o, &option_rows[OPTION_SCHEME], option_rows[OPTION_SCHEME].standard);
    if (status == EXIT_FINE)
        status = o->camera.preset_count < 2 ? keep_stored(o) : resolve_each(o);
    return status == EXIT_FINE ? check_near(o) : status;
}
