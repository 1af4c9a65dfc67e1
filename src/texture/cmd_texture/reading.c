/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Readings that an image leaves open: how coarse it is against its buffer, and what was assumed about it. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "core/append.h"
#include "report/message.h"
#include "report/number.h"
#include "texture/cmd_texture/request.h"
#include "texture/cmd_texture/texture.h"
#include "texture/image_depths.h"
#include "texture/units.h"

/* ---- How the samples were rounded -------------------------------------------------------------------------------- */

/* Beyond the numbers of a finer buffer lie half of its cells: of 24 bits, or of binary32 below 1. */
static const double FINER = 0x1p-24;

/* Steps of 1/65535 and 1/65536 are as fine as 16 bits. */
static const double COARSER = 0.75;

static bool is_half(const dp_format *format) {
    return strcmp(format->name, "fp16") == 0;
}

/* Whether all numbers are of binary16, in a file of such or in one that could hold more. */
static bool are_halves(const texture_source *s) {
    const dp_recognised *found = &s->found;
    return s->picture.type == IMAGE_F16 ||
           (s->picture.type > IMAGE_F16 && found->depth && found->distinct > 0 && is_half(&found->format));
}

static int number_bits(const texture_source *s) {
    return are_halves(s) ? 11 : s->picture.type == IMAGE_F32 ? 24 : 53;
}

/* Whether each half may be a code of 16 bits that was rounded or cut off: halves above 1/32 all may be. */
static bool may_be_words(const texture_source *s) {
    const size_t count = (size_t)s->picture.width * s->picture.height;
    const grain halves = {.kind = GRAIN_FLOATS, .bits = 11, .least = 0x1p-24};
    for (size_t i = 0; i < count; i++) {
        const double x = image_sample(&s->picture, i), unit = grain_number_gap(&halves, x);
        if (x >= 0 && x <= 1 && floor((x + unit) * 65535) < (x - 0.5 * unit) * 65535)
            return false;
    }
    return true;
}

static grain_rounding rounding_of(const texture_request *o) {
    return !option_given(o->line, "rounding")    ? GRAIN_ANY
           : o->camera.rounding == DP_ROUND_ZERO ? GRAIN_ZERO
                                                 : GRAIN_NEAREST;
}

/* Steps that every file of this type has, as shares of 1; 0 where its samples are codes. */
static double type_steps(const texture_source *s) {
    const image_type type = s->picture.type;
    const bool codes = image_are_codes(&s->picture, &s->setup.spec.format);
    if (type == IMAGE_U8)
        return codes ? 0 : 255;
    if (type == IMAGE_U16)
        return codes && (s->format_from == ORIGIN_GIVEN || s->setup.spec.format.kind == DP_FORMAT_FLOAT) ? 0 : 65535;
    return 0;
}

/* The steps that all samples are multiples of: those found, or the codes of a format coarser than the set-up's. */
static double found_steps(const texture_source *s) {
    const dp_format *looks_like = &s->found.format;
    if (s->found.steps > 0)
        return s->found.steps;
    const bool codes = s->picture.type >= IMAGE_F16 && s->found.depth && s->found.certain;
    const bool coarser = looks_like->code_max < COARSER * s->setup.spec.format.code_max;
    return codes && coarser && looks_like->kind == DP_FORMAT_UNORM ? looks_like->code_max : 0;
}

/* The whole steps below steps that are not whole, as bits that were shifted up make them; else 0. */
static double whole_steps(double steps) {
    return steps == floor(steps) ? 0 : floor(steps);
}

/* Integers of the file, or what all samples are multiples of besides; the format behind that may be only assumed. */
static grain steps_grain(const texture_source *s, double found, double own) {
    const dp_format *format = &s->setup.spec.format;
    const double steps = found > 0 ? found : own;
    const bool coarse = steps < COARSER * format->code_max || format->kind == DP_FORMAT_FLOAT;
    const bool buffer = coarse && s->format_from != ORIGIN_ASSUMED;
    const bool numbers = s->picture.type >= IMAGE_F16;
    return (grain){.kind = GRAIN_STEPS,
                   .steps = steps,
                   .own = steps != own ? own : 0,
                   .whole = whole_steps(steps),
                   .buffer = buffer,
                   .margin = buffer   ? 0
                             : coarse ? FINER + 0.5 / 65535
                                      : FINER,
                   .bits = numbers ? number_bits(s) : 0,
                   .least = are_halves(s) ? 0x1p-24 : 0x1p-149};
}

static void find_grain(const texture_request *o, texture_source *s) {
    const dp_format *format = &s->setup.spec.format;
    const image_type type = s->picture.type;
    const double own = type_steps(s), found = o->image.metric > 0 ? 0 : found_steps(s);
    const bool half = is_half(format), assumed = s->format_from != ORIGIN_GIVEN;
    s->grain = (grain){.kind = GRAIN_CODES};
    if (o->image.metric > 0)
        s->grain = s->metric.grain;
    else if (o->image.packing != NULL && s->format_from != ORIGIN_GIVEN)
        s->grain = s->unpacked.grain;
    else if (found > 0 || own > 0)
        s->grain = steps_grain(s, found, own);
    else if (are_halves(s) && (assumed || !half))
        s->grain = (grain){.kind = GRAIN_FLOATS,
                           .buffer = !half,
                           .margin = !half             ? 0
                                     : may_be_words(s) ? FINER + 0.5 / 65535
                                                       : FINER,
                           .bits = 11,
                           .least = 0x1p-24};
    else if (type >= IMAGE_F32 && format->kind == DP_FORMAT_UNORM)
        s->grain = (grain){.kind = GRAIN_FLOATS, .buffer = true, .bits = number_bits(s), .least = 0x1p-149};
    if (option_given(o->line, "rounding"))
        s->grain.rounding = rounding_of(o);
}

bool texture_coarser(const texture_source *s) {
    const grain *g = &s->grain;
    return (g->kind == GRAIN_STEPS && g->steps < COARSER * s->setup.spec.format.code_max) ||
           (g->kind == GRAIN_FLOATS && g->bits == 11);
}

/* ---- How else a pixel may be read -------------------------------------------------------------------------------- */

/* The pixel nearest to the middle, counted along rows, that is neither a hole nor at an end of window depth. */
static bool find_pixel(texture_source *s, double *d) {
    const dp_format *format = &s->setup.spec.format;
    const uint64_t width = s->picture.width, count = width * s->picture.height;
    const uint64_t middle = s->picture.height / 2 * width + width / 2;
    for (uint64_t i = 0; i < 2 * count; i++) {
        const uint64_t off = (i + 1) / 2;
        if (i % 2 == 1 ? off > middle : middle + off >= count)
            continue;
        const uint64_t at = i % 2 == 1 ? middle - off : middle + off;
        s->column = (uint32_t)(at % width);
        s->row = (uint32_t)(at / width);
        image_depths(&s->picture, format, s->row, s->column, 1, d);
        if (*d > 0 && *d < 1)
            return true;
    }
    return false;
}

static void add_reading(texture_source *s, const char *what, const char *name, const dp_spec *spec, double d) {
    dp_setup setup;
    if (s->reading_count < READINGS_MAX && dp_setup_init(&setup, spec) == DP_OK)
        s->readings[s->reading_count++] = (texture_reading){what, name, dp_eye(&setup, d, 1 - d)};
}

/* Readings by other mappings: three-webgl and osgearth have the depths of log; those from near on are not read. */
static void mappings_of(texture_source *s, double d) {
    static const dp_mapping others[] = {DP_MAPPING_D3D, DP_MAPPING_REVERSED, DP_MAPPING_LINEAR, DP_MAPPING_LOG};
    dp_spec spec = s->setup.spec;
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++) {
        spec.mapping = others[i];
        add_reading(s, "mapping", dp_mapping_get(spec.mapping)->name, &spec, d);
    }
}

/* Whether no integer of the image is beyond the last code. */
static bool codes_fit(const image *picture, uint32_t code_max) {
    const size_t count = (size_t)picture->width * picture->height;
    for (size_t i = 0; i < count; i++) {
        const size_t at = i * picture->channels;
        const uint32_t code =
            picture->type == IMAGE_U16 ? ((const uint16_t *)picture->data)[at] : ((const uint32_t *)picture->data)[at];
        if (code > code_max)
            return false;
    }
    return true;
}

/* Integers are codes of one format or the bits of another; numbers are what they are in all. */
static void formats_of(texture_source *s) {
    static const char *const others[] = {"unorm16", "unorm24", "fp16"};
    dp_spec spec = s->setup.spec;
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++) {
        dp_format formats[2];
        double d;
        dp_format_parse(others[i], formats);
        const bool wide = s->picture.type == IMAGE_U32;
        const bool fits = wide ? formats[0].kind == DP_FORMAT_UNORM : formats[0].bits <= 16;
        if (!fits || !image_are_codes(&s->picture, &formats[0]) || !codes_fit(&s->picture, formats[0].code_max))
            continue;
        image_depths(&s->picture, &formats[0], s->row, s->column, 1, &d);
        if (!(d >= 0 && d <= 1))
            continue;
        spec.format = formats[0];
        add_reading(s, "format", others[i], &spec, d);
    }
    if (s->reading_count > 0 && strcmp(s->readings[s->reading_count - 1].what, "format") == 0 &&
        (s->reading_count == 1 || strcmp(s->readings[s->reading_count - 2].what, "format") != 0))
        s->reading_count--; /* no choice */
}

static void find_readings(const texture_request *o, texture_source *s) {
    double d;
    s->reading_count = 0;
    if (o->image.metric > 0 || !find_pixel(s, &d))
        return;
    if (s->mapping_from == ORIGIN_ASSUMED && o->camera.matrix.count != MATRIX_ENTRIES)
        mappings_of(s, d);
    if (s->format_from == ORIGIN_ASSUMED && !s->camera.oblique.on &&
        (s->picture.type == IMAGE_U16 || s->picture.type == IMAGE_U32))
        formats_of(s);
}

const char *texture_readings_of(const texture_source *s, const char *what, char out[READINGS_SIZE]) {
    out[0] = '\0';
    for (const texture_reading *r = s->readings; r < s->readings + s->reading_count; r++) {
        if (strcmp(r->what, what) != 0)
            continue;
        if (out[0] == '\0')
            append(out, READINGS_SIZE, "%u,%u is at z = ", s->column, s->row);
        else
            append(out, READINGS_SIZE, ", ");
        append(out, READINGS_SIZE, "%s as %s", number_of(r->z, 6).text, r->name);
    }
    return out;
}

static void warn_of(const texture_source *s, const char *what) {
    char text[READINGS_SIZE];
    if (*texture_readings_of(s, what, text) != '\0')
        message("depthprec: %s: the %s is assumed: pixel %s; --%s sets it", s->path, what, text, what);
}

const char *texture_zeros_of(const texture_request *o, const texture_source *s, char out[READINGS_SIZE]) {
    const dp_spec *planes = &s->setup.spec;
    const double half = s->grain.rounding == GRAIN_ZERO ? 1 : 0.5;
    const double end = planes->zfar * (half / s->grain.steps + s->grain.margin);
    snprintf(out, READINGS_SIZE, "%llu pixels hold 0, a clear to black or the far plane after frac",
             (unsigned long long)s->unpacked.zeros);
    if (planes->znear < end)
        append(out, READINGS_SIZE, ", or depths up to %s", number_in(number_up(end, 3), camera_unit(&o->camera)).text);
    append(out, READINGS_SIZE,
           o->image.sky > 0   ? ": they count as sky; --sky 0 makes them holes"
           : o->image.sky < 0 ? ": they lie at the far plane"
                              : ": they are holes");
    return out;
}

/* Whole numbers that are larger than millimetres are may be of a finer unit, where nobody says that they are codes.
 * Some are holes; or nothing of them shows a buffer, neither sky at an end nor mass near 1. */
bool texture_may_be_metric(const texture_source *s) {
    const dp_recognised *r = &s->found;
    const bool open = s->mapping_from == ORIGIN_ASSUMED && s->format_from == ORIGIN_ASSUMED;
    const bool some = r->at_zero > r->samples / 1000, plain = r->at_zero == 0 && r->sky < 0 && r->mass != 0;
    return r->metric || (open && s->type == IMAGE_U16 && s->channels == 1 && r->at_one == 0 && (some || plain));
}

static void warn(const texture_request *o, const texture_source *s) {
    char text[READINGS_SIZE], units[UNITS_TEXT_SIZE];
    if (o->out.quiet)
        return;
    if (s->unpacked.zeros > 0)
        message("depthprec: %s: %s", s->path, texture_zeros_of(o, s, text));
    warn_of(s, "mapping");
    warn_of(s, "format");
    if (s->reading_count == 0 && o->image.metric == 0 && s->mapping_from == ORIGIN_ASSUMED)
        message("depthprec: %s: the mapping is assumed; --mapping sets it", s->path);
    if (o->image.metric != 0 || !texture_may_be_metric(s))
        return;
    units_say(&s->picture, units);
    message("depthprec: %s: may be metric depth, whole numbers with%s%s%s", s->path,
            s->found.at_zero > 0 ? " 0 for holes" : "out holes", *units != '\0' ? ": " : "", units);
}

void texture_read_on(const texture_request *o, texture_source *s) {
    find_grain(o, s);
    find_readings(o, s);
    warn(o, s);
}
