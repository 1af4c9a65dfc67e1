/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Values that follow from other options: those of presets, platforms and rasterizers where the user gave none. */
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "camera/cmd/camera.h"
#include "camera/cmd/depth24plus.h"
#include "core/engine.h"
#include "report/number.h"
#include "report/output.h"

const char *camera_api(const camera_asked *c) {
    return c->platform != NULL ? c->platform->api : c->preset_count == 1 ? c->presets[0]->api : NULL;
}

const char *camera_language(const camera_asked *c) {
    return c->preset_count == 1  ? c->presets[0]->language
           : c->platform != NULL ? bias_api_find(c->platform->api)->language
                                 : NULL;
}

/* Gives an option its value as if it had been typed. */
static void take(camera_asked *c, const char *name, const char *value) {
    const option_row *row = option_find(c->line->command, name);
    row->parse(c->line, row, value, c);
}

/* three.js has one word for the logarithms of two renderers. */
static void take_logarithm(camera_asked *c, const preset *p) {
    static const char word[] = "logarithmicDepthBuffer";
    const char *given =
        option_given(c->line, "mapping") && strcmp(p->api, "webgpu") == 0 ? option_text(c->line, "mapping") : "";
    while (*given != '\0' && strncasecmp(given, word, sizeof word - 1) != 0)
        given++;
    for (size_t i = 0; i < c->mapping_count && *given != '\0'; i++)
        if (c->mappings[i] == DP_MAPPING_THREE_WEBGL)
            c->mappings[i] = DP_MAPPING_THREE_WEBGPU;
}

/* A preset gives what the user did not. */
static void take_preset(camera_asked *c, const preset *p) {
    static const char *const chosen[] = {"near", "far", "format", "mapping", NULL};
    double znear, zfar, log_c;
    option_chosen(c->line, "preset", p->name, chosen);
    preset_planes(p, c->lengths.unit, &znear, &zfar, &log_c);
    if (!option_given(c->line, "near"))
        c->znear = znear;
    if (!option_given(c->line, "far"))
        c->zfar = zfar;
    if (!option_given(c->line, "log-c"))
        c->log_c = log_c;
    if (!option_given(c->line, "format"))
        take(c, "format", p->format);
    if (!option_given(c->line, "mapping"))
        take(c, "mapping", dp_mapping_get(p->mapping)->name);
    take_logarithm(c, p);
    slant_take_preset(c, p);
}

/* Takes what a platform stores; a preset's format and rasterizer give way to it, its mapping stays. */
static void take_platform(camera_asked *c) {
    const platform *p = c->platform;
    if (p == NULL)
        return;
    const bool webgl = strcmp(p->api, "gl") == 0;
    static const char *const chosen[] = {"mapping", "format", NULL};
    const char *stored = depth24plus_on(p, option_text(c->line, "format"));
    option_chosen(c->line, "platform", p->name, chosen + (c->preset_count > 0)); /* a preset's mapping stays */
    if (!option_given(c->line, "format") || stored != NULL)
        take(c, "format", stored != NULL ? stored : p->stored);
    if (!option_given(c->line, "mapping") && c->preset_count == 0)
        take(c, "mapping", webgl ? "gl" : "d3d");
    bool remapped = false;
    for (size_t i = 0; i < c->mapping_count && p->remap != PLATFORM_REMAPS_NOT; i++)
        remapped = remapped || dp_mapping_get(c->mappings[i])->ndc_signed;
    if (!option_given(c->line, "arith") && remapped)
        dp_arith_parse("ieee-remap", &c->arith);
    slant_take_raster(c, p->raster);
}

/* Takes the arithmetic of a known rasterizer, with the remap of the platform. */
static int take_arith(camera_asked *c) {
    const bool known = c->has_raster_arith || (c->raster != NULL && c->raster->model != NULL);
    if (!known || option_given(c->line, "arith"))
        return EXIT_FINE;
    const bool remapped = dp_arith_get(c->arith)->remap;
    if (c->has_raster_arith && dp_arith_get(c->raster_arith)->remap == remapped)
        c->arith = c->raster_arith;
    else if (c->raster->model != NULL && !raster_arith(c->raster, remapped, &c->arith))
        return option_error("raster",
                            "%s was not measured with [-1, 1] remapped in the vertex shader, as on %s: name its "
                            "arithmetic with --arith",
                            c->raster->name, c->platform != NULL ? c->platform->name : "the platform");
    return EXIT_FINE;
}

/* The camera as it would be with that preset alone, all lengths in its own unit where that is known and --unit was not
 * given. */
static camera_asked with_preset(const camera_asked *c, const preset *p) {
    camera_asked out = *c;
    const unit_row *own = option_given(c->line, "unit") ? NULL : unit_find(p->unit), *from = c->lengths.unit;
    double *const converted[] = {&out.znear, &out.zfar, &out.range_lo, &out.range_hi, &out.at.lo, &out.at.hi};
    out.lengths.unit = own != NULL ? own : from;
    out.lengths.typed_count = 0; /* none of them is converted */
    for (size_t i = 0; i < sizeof converted / sizeof converted[0]; i++)
        *converted[i] = unit_convert(*converted[i], from, out.lengths.unit);
    out.at.from = from;
    out.at.to = out.lengths.unit;
    take_preset(&out, p);
    take_platform(&out);
    take_arith(&out); /* not refused: of the same rasterizer and platform it was asked before */
    return out;
}

/* Several presets are resolved once. */
static int resolve_each(camera_asked *c) {
    const size_t count = c->preset_count;
    camera_asked *each = asked_allocate(c->line, count * sizeof *each);
    if (each == NULL)
        return usage_error("no memory for %zu presets", count);
    for (size_t i = 0; i < count; i++)
        each[i] = with_preset(c, c->presets[i]);
    c->each = each;
    return EXIT_FINE;
}

int camera_check_stored(const camera_asked *c, const dp_format *format) {
    camera_fault fault = {.key = NULL};
    return camera_stored(&c->gpu, format, &fault) ? EXIT_FINE : camera_refuse(&fault);
}

/* Keeps formats that the GPUs of the profiles store; one that the user named has to be among them. */
static int keep_stored(camera_asked *c) {
    const bool given = option_given(c->line, "format");
    const bool any =
        given ? strcmp(option_text(c->line, "format"), "all") == 0 : c->preset_count == 0 && c->platform == NULL;
    size_t kept = 0;
    for (size_t i = 0; i < c->format_count; i++) {
        if (profile_stores(&c->gpu, &c->formats[i]))
            c->formats[kept++] = c->formats[i];
        else if (!any || (i + 1 == c->format_count && kept == 0))
            return camera_check_stored(c, &c->formats[i]);
    }
    c->format_count = kept;
    return EXIT_FINE;
}

/* An orthographic camera may begin at its place or behind it. */
static int check_near(const camera_asked *c) {
    const option_row *row = option_find(c->line->command, "near");
    const number_text given = number_full(c->znear);
    char limits[OPTION_TEXT_SIZE];
    if (c->znear > 0.0)
        return EXIT_FINE;
    if (!c->ortho)
        return option_error("near", "must be a number from %s, got '%s'", option_limits(row, limits), given.text);
    if (c->znear != 0.0 && !(-c->znear >= row->least && -c->znear <= row->most))
        return option_error("near", "must be 0, or a number from %s or its negative, got '%s'",
                            option_limits(row, limits), given.text);
    return EXIT_FINE;
}

/* A colour target's depth is compared with a buffer's, and stands for none. */
static int check_rg(const camera_asked *c) {
    for (size_t i = 0; i < c->format_count; i++) {
        const bool rg = dp_format_is_rg(&c->formats[i]);
        if (rg && !c->use.compared)
            return option_error("format", "rg is no depth buffer: table and figures of set-ups show it, and texture "
                                          "has it as a packing");
        if (rg && c->rounding != DP_ROUND_NEAREST)
            return option_error("rounding", "must be nearest with rg, got %s", dp_rounding_name(c->rounding));
    }
    return EXIT_FINE;
}

int camera_complete(camera_asked *c, const camera_use *use) {
    c->use = *use;
    c->model_auto = c->model == DP_MODEL_COUNT;
    if (c->model_auto)
        c->model = DP_MODEL_EXACT;
    for (size_t i = 0; i < c->preset_count && c->lengths.unit != NULL && !option_given(c->line, "unit"); i++)
        if (strcmp(c->presets[i]->unit, "extents") == 0)
            return option_error("unit", "must be given: %s measures in %s", c->presets[i]->name, c->presets[i]->unit);
    if (c->platform != NULL && c->platform->remap == PLATFORM_SPREADS)
        return option_error(
            "platform",
            "has no guarantee for %s, whose vertex shader spreads [0, 1] to [-1, 1] by 2 z - w: a small "
            "z loses its digits; -F %s tells of the format alone",
            c->platform->name, c->platform->stored);
    int status = check_rg(c);
    if (status == EXIT_FINE)
        status = slant_complete(c);
    if (c->preset_count == 1)
        take_preset(c, c->presets[0]);
    take_platform(c);
    if (status == EXIT_FINE)
        status = take_arith(c);
    if (status == EXIT_FINE)
        status = c->preset_count < 2 ? keep_stored(c) : resolve_each(c);
    return status == EXIT_FINE ? check_near(c) : status;
}

bool camera_names_arith(const camera_asked *c) {
    const option_row *row = option_find(c->line->command, "arith");
    return option_given(c->line, "arith") && names_find(row->names, option_text(c->line, "arith"), NULL, NULL);
}
