/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/option/rows.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "api/unit.h"
#include "core/append.h"
#include "plot/draw.h"
#include "report/number.h"
#include "scene/find.h"
#include "system/input.h"

const char *option_argument(const option_row *row, char out[OPTION_TEXT_SIZE]) {
    out[0] = '\0';
    if (row->argument == NULL && row->names != NULL)
        return names_join(row->names, "|", "|", out);
    append(out, OPTION_TEXT_SIZE, "%s", row->argument != NULL ? row->argument : "");
    return out;
}

int option_refuse(const option_row *row, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    const int status = named_error(row->name, format, arguments);
    va_end(arguments);
    return status;
}

/* ---- Kinds ------------------------------------------------------------------------------------------------------- */

void *option_field(options *o, const option_row *row) {
    return (char *)o + row->place;
}

/* Flags, counts and enumerations are as wide as their fields. */
static void set_whole(options *o, const option_row *row, uint64_t whole) {
    const bool flag = whole != 0;
    const unsigned narrow = (unsigned)whole;
    const size_t size = row->size;
    const void *const from = size == sizeof flag     ? (const void *)&flag
                             : size == sizeof narrow ? &narrow
                                                     : (void *)&whole;
    memcpy(option_field(o, row), from, size);
}

int parse_flag(options *o, const option_row *row, const char *value) {
    (void)value;
    set_whole(o, row, 1);
    return EXIT_FINE;
}

int parse_text(options *o, const option_row *row, const char *value) {
    *(const char **)option_field(o, row) = value;
    return EXIT_FINE;
}

int parse_some(options *o, const option_row *row, const char *value) {
    return *value != '\0' ? parse_text(o, row, value) : option_refuse(row, "must not be empty, got ''");
}

int parse_written(options *o, const option_row *row, const char *value) {
    return *value != '\0' ? parse_text(o, row, value) : option_refuse(row, "must be a file name, got ''");
}

int parse_read(options *o, const option_row *row, const char *value) {
    if (*value != '\0')
        input_expect(value);
    return parse_written(o, row, value);
}

/* 1e12 and 1e-9, where printf writes 1e+12 and 1e-09; no power of ten in whole numbers, which are read without. */
static number_text limit_text(double limit, bool whole) {
    number_text out = number_of(limit, 6);
    if (whole || strtod(out.text, NULL) != limit)
        snprintf(out.text, sizeof out.text, "%.0f", limit);
    char *exponent = strchr(out.text, 'e');
    if (exponent != NULL)
        snprintf(exponent, 8, "e%ld", strtol(exponent + 1, NULL, 10));
    return out;
}

const char *option_limits(const option_row *row, char out[OPTION_TEXT_SIZE]) {
    const bool whole = row->parse == parse_whole;
    snprintf(out, OPTION_TEXT_SIZE, "%s to %s%s%s", limit_text(row->least, whole).text,
             limit_text(row->most, whole).text, row->unit != NULL ? " " : "", row->unit != NULL ? row->unit : "");
    return out;
}

int parse_number(options *o, const option_row *row, const char *value) {
    char limits[OPTION_TEXT_SIZE];
    double number;
    if (!number_parse(value, NUMBER_FINITE, &number) || !(number >= row->least && number <= row->most))
        return option_refuse(row, "must be a number from %s, got '%s'", option_limits(row, limits), value);
    *(double *)option_field(o, row) = number;
    return EXIT_FINE;
}

/* Some engines set an infinite one, of either sign. */
int parse_units(options *o, const option_row *row, const char *value) {
    double endless;
    if (!number_parse(*value == '-' ? value + 1 : value, NUMBER_FAR, &endless) || !isinf(endless))
        return parse_number(o, row, value);
    *(double *)option_field(o, row) = *value == '-' ? -endless : endless;
    return EXIT_FINE;
}

/* None is below 0. */
int parse_sky(options *o, const option_row *row, const char *value) {
    char limits[OPTION_TEXT_SIZE];
    o->image.sky = -1;
    if (strcmp(value, "none") == 0 ||
        (number_parse(value, NUMBER_FINITE, &o->image.sky) && o->image.sky >= row->least && o->image.sky <= row->most))
        return EXIT_FINE;
    return option_refuse(row, "must be a number from %s, or none, got '%s'", option_limits(row, limits), value);
}

int parse_whole(options *o, const option_row *row, const char *value) {
    char limits[OPTION_TEXT_SIZE];
    uint64_t whole;
    if (!number_parse_count(value, (uint64_t)row->most, &whole) || (double)whole < row->least)
        return option_refuse(row, "must be a whole number from %s, got '%s'", option_limits(row, limits), value);
    set_whole(o, row, whole);
    return EXIT_FINE;
}

static int unknown_name(const option_row *row, const char *name) {
    char text[NAMES_SIZE];
    return option_refuse(row, "%s", names_refuse(row->names, name, text));
}

int parse_unit(options *o, const option_row *row, const char *value) {
    o->camera.unit = unit_find(value);
    return o->camera.unit != NULL ? EXIT_FINE : option_refuse(row, "must be " UNIT_NAMES ", got '%s'", value);
}

int parse_word(options *o, const option_row *row, const char *value) {
    size_t index;
    if (!names_find(row->names, value, &index, NULL))
        return unknown_name(row, value);
    set_whole(o, row, index);
    return EXIT_FINE;
}

int parse_row(options *o, const option_row *row, const char *value) {
    list_item item;
    if (!names_find(row->names, value, NULL, &item))
        return unknown_name(row, value);
    memcpy(option_field(o, row), &item.row, sizeof item.row); /* whatever it points to */
    return EXIT_FINE;
}

/* ---- Languages of their own -------------------------------------------------------------------------------------- */

int parse_names(options *o, const option_row *row, const char *value, option_parser *add) {
    char name[64];
    const size_t length = strlen(value);
    if (length == 0 || *value == ',' || value[length - 1] == ',' || strstr(value, ",,") != NULL)
        return option_refuse(row, "must be %s, got '%s'", row->argument, value);
    for (const char *at = value; *at != '\0'; at += *at == ',') {
        const size_t part = strcspn(at, ",");
        snprintf(name, sizeof name, "%.*s", (int)part, at);
        const int status = part < sizeof name ? add(o, row, name) : unknown_name(row, at);
        if (status != EXIT_FINE)
            return status;
        at += part;
    }
    return EXIT_FINE;
}

static int add_one_format(options *o, const option_row *row, const dp_format *format) {
    for (size_t i = 0; i < o->camera.format_count; i++)
        if (strcmp(o->camera.formats[i].name, format->name) == 0)
            return EXIT_FINE;
    if (o->camera.format_count == OPTIONS_FORMATS_MAX)
        return option_refuse(row, "must be at most %d formats, got '%s' too", OPTIONS_FORMATS_MAX, format->name);
    o->camera.formats[o->camera.format_count++] = *format;
    return EXIT_FINE;
}

static int add_format(options *o, const option_row *row, const char *name) {
    dp_format found[2];
    const size_t count = dp_format_parse(name, found);
    const bool all = strcmp(name, "all") == 0;
    int status = count > 0 || all ? EXIT_FINE : unknown_name(row, name);
    for (size_t i = 0; i < (all ? dp_format_count() : count) && status == EXIT_FINE; i++)
        status = add_one_format(o, row, all ? &dp_format_get(i)->format : &found[i]);
    return status;
}

int parse_formats(options *o, const option_row *row, const char *value) {
    o->camera.format_count = 0;
    return parse_names(o, row, value, add_format);
}

static int add_mapping(options *o, const option_row *row, const char *name) {
    dp_mapping mapping;
    if (strcmp(name, "all") == 0)
        return add_mapping(o, row, "d3d") != EXIT_FINE ? EXIT_USAGE : add_mapping(o, row, "reversed");
    if (dp_mapping_parse(name, &mapping) != DP_OK)
        return unknown_name(row, name);
    for (size_t i = 0; i < o->camera.mapping_count; i++)
        if (o->camera.mappings[i] == mapping)
            return EXIT_FINE;
    o->camera.mappings[o->camera.mapping_count++] = mapping;
    return EXIT_FINE;
}

int parse_mappings(options *o, const option_row *row, const char *value) {
    o->camera.mapping_count = 0;
    return parse_names(o, row, value, add_mapping);
}

static int add_preset(options *o, const option_row *row, const char *name) {
    list_item found;
    if (!names_find(row->names, name, NULL, &found))
        return unknown_name(row, name);
    for (size_t i = 0; i < o->camera.preset_count; i++)
        if (o->camera.presets[i] == found.row)
            return EXIT_FINE;
    if (o->camera.preset_count == OPTIONS_PRESETS_MAX)
        return option_refuse(row, "must be at most %d presets, got '%s' too", OPTIONS_PRESETS_MAX, name);
    o->camera.presets[o->camera.preset_count++] = found.row;
    return EXIT_FINE;
}

int parse_preset(options *o, const option_row *row, const char *value) {
    const size_t commas = strcspn(value, ",");
    return value[commas] == '\0' ? add_preset(o, row, value)
                                 : option_refuse(row, "must be one preset for %s, got '%s'", o->command->name, value);
}

int parse_presets(options *o, const option_row *row, const char *value) {
    return parse_names(o, row, value, add_preset);
}

static int add_api(options *o, const option_row *row, const char *name) {
    list_item found;
    if (!names_find(row->names, name, NULL, &found))
        return unknown_name(row, name);
    for (size_t i = 0; bias_api_get(i) != NULL; i++)
        if (found.row == NULL || found.row == bias_api_get(i))
            o->bias.apis |= 1U << i;
    return EXIT_FINE;
}

/* One is named, however often; of several there is no one. */
int parse_apis(options *o, const option_row *row, const char *value) {
    o->bias.apis = 0;
    const int status = parse_names(o, row, value, add_api);
    o->bias.api = options_api(o, 1) == NULL ? options_api(o, 0) : NULL;
    return status;
}

static int add_program(options *o, const option_row *row, const char *name) {
    list_item found;
    if (!names_find(row->names, name, NULL, &found))
        return unknown_name(row, name);
    for (size_t i = 0; found.row == NULL && vertex_program_get(i) != NULL; i++)
        add_program(o, row, vertex_program_get(i)->name);
    for (size_t i = 0; i < o->census.against_count; i++)
        if (o->census.against[i] == found.row)
            return EXIT_FINE;
    if (found.row != NULL)
        o->census.against[o->census.against_count++] = found.row; /* there is room for every row */
    return EXIT_FINE;
}

int parse_against(options *o, const option_row *row, const char *value) {
    o->census.against_count = 0;
    return parse_names(o, row, value, add_program);
}

/* NAME, or NAME:SIZE. */
static int add_scheme(options *o, const option_row *row, const char *text) {
    char name[64];
    list_item found;
    const size_t length = strcspn(text, ":");
    snprintf(name, sizeof name, "%.*s", (int)length, text);
    if (!names_find(row->names, name, NULL, &found))
        return unknown_name(row, name);
    if (found.row == NULL && text[length] == '\0') {
        for (size_t i = 0; i < WORLD_ROWS; i++)
            add_scheme(o, row, world_get(i)->name);
        return EXIT_FINE;
    }
    world_scheme s = {.row = found.row};
    if (s.row != NULL)
        s.size = s.row->metres ? unit_convert(s.row->standard, unit_find("m"), o->camera.unit) : s.row->standard;
    if (text[length] != '\0' &&
        (s.row == NULL || !number_parse(text + length + 1, NUMBER_FINITE, &s.size) || !world_size_fits(s.row, s.size)))
        return option_refuse(
            row,
            s.row == NULL || s.row->size == NULL ? "%s has no size, got '%s'"
            : s.row->power2 ? "%s:SIZE must be a power of two from 1e-3 to 1e12 scene units, got '%s'"
                            : "%s:SIZE must be a number of scene units from 1e-3 to 1e12, without a unit, got '%s'",
            name, text);
    for (size_t i = 0; i < o->world.scheme_count; i++)
        if (o->world.schemes[i].row == s.row && o->world.schemes[i].size == s.size)
            return EXIT_FINE;
    if (o->world.scheme_count == OPTIONS_SCHEMES_MAX)
        return option_refuse(row, "must be at most %d schemes", OPTIONS_SCHEMES_MAX);
    o->world.schemes[o->world.scheme_count++] = s;
    return EXIT_FINE;
}

int parse_schemes(options *o, const option_row *row, const char *value) {
    o->world.scheme_count = 0;
    return parse_names(o, row, value, add_scheme);
}

static int add_filter(options *o, const option_row *row, const char *name) {
    list_item found;
    if (!names_find(row->names, name, NULL, &found))
        return unknown_name(row, name);
    for (size_t i = 0; finder_filter_get(i) != NULL; i++)
        if (found.row == NULL || found.row == finder_filter_get(i))
            o->scene.filters_off |= 1U << i;
    return EXIT_FINE;
}

int parse_also(options *o, const option_row *row, const char *value) {
    o->scene.filters_off = 0;
    return parse_names(o, row, value, add_filter);
}

/* A share, or a percentage with its sign. */
int parse_tolerance(options *o, const option_row *row, const char *value) {
    const size_t length = strlen(value);
    const bool percent = length > 0 && value[length - 1] == '%';
    double share;
    if (!number_parse_part(value, length - percent, NUMBER_FINITE, &share) || !(share >= 0.0))
        return option_refuse(row, "must be a share such as 0.05, or 5%%, not negative, got '%s'", value);
    o->wanted.tolerance = percent ? share / 100.0 : share;
    return EXIT_FINE;
}

int option_read_sides(const option_row *row, const char *value, unsigned most, bool square, uint64_t sides[2]) {
    const size_t length = strcspn(value, "x");
    const char *const height = square ? value : value + length + 1;
    char width[16];
    snprintf(width, sizeof width, "%.*s", (int)length, value);
    if (length >= sizeof width || (value[length] == '\0' && !square) || !number_parse_count(width, most, &sides[0]) ||
        !number_parse_count(height, most, &sides[1]) || sides[0] < 1 || sides[1] < 1)
        return option_refuse(row, "must be %sWIDTHxHEIGHT, each from 1 to %u pixels, got '%s'", square ? "N or " : "",
                             most, value);
    return EXIT_FINE;
}

static int read_size(options *o, const option_row *row, const char *value, bool square) {
    uint64_t sides[2];
    const int status = option_read_sides(row, value, IMAGE_SIDE_MAX, square, sides);
    if (status != EXIT_FINE)
        return status;
    if (sides[0] * sides[1] > IMAGE_PIXELS_MAX)
        return option_refuse(row, "must be at most %u pixels in all, got '%s'", (unsigned)IMAGE_PIXELS_MAX, value);
    o->view.spec.width = (uint32_t)sides[0];
    o->view.spec.height = (uint32_t)sides[1];
    return EXIT_FINE;
}

int parse_size(options *o, const option_row *row, const char *value) {
    return read_size(o, row, value, false);
}

int parse_size_or_n(options *o, const option_row *row, const char *value) {
    return read_size(o, row, value, strchr(value, 'x') == NULL);
}

/* The width alone, or both. */
int parse_figure_size(options *o, const option_row *row, const char *value) {
    const size_t length = strcspn(value, "x");
    char width[8];
    uint64_t sides[2] = {0};
    snprintf(width, sizeof width, "%.*s", (int)length, value);
    if (length >= sizeof width || !number_parse_count(width, DRAW_SIZE_MAX, &sides[0]) || sides[0] < DRAW_WIDTH_MIN ||
        (value[length] != '\0' &&
         (!number_parse_count(value + length + 1, DRAW_SIZE_MAX, &sides[1]) || sides[1] < DRAW_HEIGHT_MIN)))
        return option_refuse(row, "must be W or WxH, W from %d to %d and H from %d to %d pixels, got '%s'",
                             DRAW_WIDTH_MIN, DRAW_SIZE_MAX, DRAW_HEIGHT_MIN, DRAW_SIZE_MAX, value);
    o->figure.width = (int)sides[0];
    o->figure.height = (int)sides[1];
    return EXIT_FINE;
}

int parse_link(options *o, const option_row *row, const char *value) {
    o->out.link = value != NULL ? value : "depthprec.html";
    if (*o->out.link == '\0' || o->out.link[strcspn(o->out.link, "# \n")] != '\0')
        return option_refuse(row, "must be a URL without '#' and blanks, got '%s'", value);
    return EXIT_FINE;
}

int parse_form(options *o, const option_row *row, const char *value) {
    const output_form form = (output_form)row->least;
    (void)value;
    if (o->out.form != FORM_TEXT && o->out.form != form)
        return option_refuse(row, "conflicts with --%s", form == FORM_JSON ? "csv" : "json");
    o->out.form = form;
    return EXIT_FINE;
}
