/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/option_rows.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/append.h"
#include "report/number.h"

const char *option_argument(const option_row *row, char out[OPTION_TEXT_SIZE]) {
    out[0] = '\0';
    if (row->argument == NULL && row->names != NULL)
        return names_join(row->names, "|", "|", out);
    append(out, OPTION_TEXT_SIZE, "%s", row->argument != NULL ? row->argument : "");
    return out;
}

/* As option_error(), which knows the rows; the rows know what is here. */
static int __attribute__((format(printf, 2, 3))) refuse(const option_row *row, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    const int status = named_error(row->name, format, arguments);
    va_end(arguments);
    return status;
}

/* ---- Kinds ------------------------------------------------------------------------------------------------------- */

static void *field(options *o, const option_row *row) {
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
    memcpy(field(o, row), from, size);
}

int parse_flag(options *o, const option_row *row, const char *value) {
    (void)value;
    set_whole(o, row, 1);
    return EXIT_FINE;
}

int parse_text(options *o, const option_row *row, const char *value) {
    *(const char **)field(o, row) = value;
    return EXIT_FINE;
}

int parse_file(options *o, const option_row *row, const char *value) {
    return *value != '\0' ? parse_text(o, row, value) : refuse(row, "must be a file name, got ''");
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

const char *option_takers(const option_row *row, char out[OPTION_TEXT_SIZE]) {
    out[0] = '\0';
    for (size_t i = 0; i < verb_count; i++)
        if ((row->commands & verb_rows[i].bit) != 0)
            append(out, OPTION_TEXT_SIZE, "%s%s", out[0] != '\0' ? ", " : "", verb_rows[i].name);
    return out;
}

const char *option_limits(const option_row *row, char out[OPTION_TEXT_SIZE]) {
    const bool whole = row->parse == parse_whole || row->parse == parse_codes;
    snprintf(out, OPTION_TEXT_SIZE, "%s to %s%s%s", limit_text(row->least, whole).text,
             limit_text(row->most, whole).text, row->unit != NULL ? " " : "", row->unit != NULL ? row->unit : "");
    return out;
}

int parse_number(options *o, const option_row *row, const char *value) {
    char limits[OPTION_TEXT_SIZE];
    double number;
    if (!number_parse(value, NUMBER_FINITE, &number) || !(number >= row->least && number <= row->most))
        return refuse(row, "must be a number from %s, got '%s'", option_limits(row, limits), value);
    *(double *)field(o, row) = number;
    return EXIT_FINE;
}

int parse_length(options *o, const option_row *row, const char *value) {
    double length;
    if (!number_parse(value, NUMBER_FINITE, &length) || !(length > 0.0))
        return refuse(row, "must be a positive number of scene units, got '%s'", value);
    *(double *)field(o, row) = length;
    return EXIT_FINE;
}

int parse_whole(options *o, const option_row *row, const char *value) {
    char limits[OPTION_TEXT_SIZE];
    unsigned long whole;
    if (!number_parse_count(value, (unsigned long)row->most, &whole) || (double)whole < row->least)
        return refuse(row, "must be a whole number from %s, got '%s'", option_limits(row, limits), value);
    set_whole(o, row, whole);
    return EXIT_FINE;
}

static int unknown_name(const option_row *row, const char *name) {
    char text[NAMES_SIZE];
    return refuse(row, "%s", names_refuse(row->names, name, text));
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
    memcpy(field(o, row), &item.row, sizeof item.row); /* whatever it points to */
    return EXIT_FINE;
}

/* ---- Languages of their own -------------------------------------------------------------------------------------- */

/* What is not positive needs --ortho, which may come later: check_near() of options.c. */
int parse_near(options *o, const option_row *row, const char *value) {
    if (!number_parse(value, NUMBER_FINITE, &o->znear) || o->znear > 0.0)
        return parse_number(o, row, value);
    o->znear += 0.0; /* -0 is 0 */
    return EXIT_FINE;
}

int parse_far(options *o, const option_row *row, const char *value) {
    if (!number_parse(value, NUMBER_FAR, &o->zfar))
        return refuse(row, "must be a number greater than near and at most 1e18, or inf, got '%s'", value);
    return EXIT_FINE;
}

/* NAME[,NAME...]: one after the other to `add`. */
static int parse_names(options *o, const option_row *row, const char *value,
                       int (*add)(options *, const option_row *, const char *)) {
    char name[64];
    const size_t length = strlen(value);
    if (length == 0 || *value == ',' || value[length - 1] == ',' || strstr(value, ",,") != NULL)
        return refuse(row, "must be NAME[,NAME...] or all, got '%s'", value);
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
    for (size_t i = 0; i < o->format_count; i++)
        if (strcmp(o->formats[i].name, format->name) == 0)
            return EXIT_FINE;
    if (o->format_count == OPTIONS_FORMATS_MAX)
        return refuse(row, "must be at most %d formats, got '%s' too", OPTIONS_FORMATS_MAX, format->name);
    o->formats[o->format_count++] = *format;
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
    o->format_count = 0;
    return parse_names(o, row, value, add_format);
}

static int add_mapping(options *o, const option_row *row, const char *name) {
    dp_mapping mapping;
    if (strcmp(name, "all") == 0)
        return add_mapping(o, row, "d3d") != EXIT_FINE ? EXIT_USAGE : add_mapping(o, row, "reversed");
    if (dp_mapping_parse(name, &mapping) != DP_OK)
        return unknown_name(row, name);
    for (size_t i = 0; i < o->mapping_count; i++)
        if (o->mappings[i] == mapping)
            return EXIT_FINE;
    o->mappings[o->mapping_count++] = mapping;
    return EXIT_FINE;
}

int parse_mappings(options *o, const option_row *row, const char *value) {
    o->mapping_count = 0;
    return parse_names(o, row, value, add_mapping);
}

/* A share, or a percentage with its sign. */
int parse_tolerance(options *o, const option_row *row, const char *value) {
    const size_t length = strlen(value);
    const bool percent = length > 0 && value[length - 1] == '%';
    double share;
    if (!number_parse_part(value, length - percent, NUMBER_FINITE, &share) || !(share >= 0.0))
        return refuse(row, "must be a share such as 0.05, or 5%%, not negative, got '%s'", value);
    o->tolerance = percent ? share / 100.0 : share;
    return EXIT_FINE;
}

int parse_origin(options *o, const option_row *row, const char *value) {
    const char *at = value;
    for (int i = 0; i < 3; i++) {
        const size_t length = strcspn(at, ",");
        double *x = &o->camera.origin[i];
        if (!number_parse_part(at, length, NUMBER_FINITE, x) || !(*x >= -1e12 && *x <= 1e12) ||
            (at[length] == '\0') != (i == 2))
            return refuse(row, "must be X,Y,Z, each from -1e12 to 1e12, got '%s'", value);
        at += length + 1;
    }
    return EXIT_FINE;
}

int parse_size(options *o, const option_row *row, const char *value) {
    char width[16];
    unsigned long w, h;
    const size_t length = strcspn(value, "x");
    snprintf(width, sizeof width, "%.*s", (int)length, value);
    if (length >= sizeof width || value[length] == '\0' || !number_parse_count(width, TEXTURE_SIDE_MAX, &w) ||
        !number_parse_count(value + length + 1, TEXTURE_SIDE_MAX, &h) || w < 1 || h < 1)
        return refuse(row, "must be WIDTHxHEIGHT, each from 1 to %u pixels, got '%s'", TEXTURE_SIDE_MAX, value);
    if ((uint64_t)w * h > TEXTURE_PIXELS_MAX)
        return refuse(row, "must be at most %u pixels in all, got '%s'", (unsigned)TEXTURE_PIXELS_MAX, value);
    o->camera.width = (uint32_t)w;
    o->camera.height = (uint32_t)h;
    return EXIT_FINE;
}

/* The last of a name counts, as with every option. */
int parse_parameter(options *o, const option_row *row, const char *value) {
    const size_t length = strcspn(value, "=");
    named_number given = {{0}, 0};
    if (value[length] == '\0' || length == 0 || length >= sizeof given.name ||
        !number_parse(value + length + 1, NUMBER_FINITE, &given.value))
        return refuse(row, "must be NAME=NUMBER, got '%s'", value);
    memcpy(given.name, value, length);
    size_t i = 0;
    while (i < o->parameter_count && strcmp(o->parameters[i].name, given.name) != 0)
        i++;
    if (i == OPTIONS_PARAMETERS_MAX)
        return refuse(row, "must not be more than %d, got '%s' too", OPTIONS_PARAMETERS_MAX, value);
    o->parameters[i] = given;
    o->parameter_count += i == o->parameter_count;
    return EXIT_FINE;
}

int parse_form(options *o, const option_row *row, const char *value) {
    const output_form form = (output_form)row->least;
    (void)value;
    if (o->form != FORM_TEXT && o->form != form)
        return refuse(row, "must not be given together with --%s", form == FORM_JSON ? "csv" : "json");
    o->form = form;
    return EXIT_FINE;
}

/* ---- Depths ------------------------------------------------------------------------------------------------------ */

static int wrong_form(const option_row *row, const char *text) {
    return refuse(row, "must be Z[,Z...] or LO:HI:log|lin:COUNT, got '%s'", text);
}

/* LO:HI:log|lin:COUNT. */
static int parse_spaced(const option_row *row, const char *text, depths *out) {
    static const char *const ends[] = {"LO", "HI"};
    const char *part = text;
    size_t length = strcspn(part, ":");
    unsigned long count;
    double z[2];
    for (int i = 0; i < 2; i++, part += length + 1, length = strcspn(part, ":")) {
        if (part[length] == '\0')
            return wrong_form(row, text);
        if (!number_parse_part(part, length, NUMBER_FINITE, &z[i]))
            return refuse(row, "%s must be a number, got '%.*s' in '%s'", ends[i], (int)length, part, text);
    }
    const bool log = length == 3 && memcmp(part, "log", 3) == 0;
    if (part[length] == '\0')
        return wrong_form(row, text);
    if (!log && (length != 3 || memcmp(part, "lin", 3) != 0))
        return refuse(row, "spacing must be log or lin, got '%.*s' in '%s'", (int)length, part, text);
    part += length + 1;
    if (!number_parse_count(part, DEPTHS_MAX, &count) || count < 2)
        return refuse(row, "COUNT must be a whole number from 2 to %d, got '%s'", DEPTHS_MAX, part);
    if (!(z[0] < z[1]))
        return refuse(row, "LO must be less than HI, got '%s'", text);
    *out = (depths){.kind = log ? DEPTHS_LOG : DEPTHS_LIN, .lo = z[0], .hi = z[1], .count = count};
    return EXIT_FINE;
}

/* Numbers separated by commas, what is `said` of them; from least to most where the row has limits. */
static int parse_listed(const option_row *row, const char *text, const char *said, depths *out) {
    depths d = {.kind = DEPTHS_LIST, .lo = (double)INFINITY, .hi = -(double)INFINITY};
    const bool paired = row->parse == parse_pixels, whole = paired || row->parse == parse_codes;
    const bool limited = row->least < row->most;
    size_t count = 1;
    for (const char *c = text; *c != '\0'; c++)
        count += *c == ',' || (paired && *c == ';');
    if (count > DEPTHS_MAX)
        return refuse(row, "must be at most %d depths, got %zu", DEPTHS_MAX, count);
    d.list = malloc(count * sizeof *d.list);
    if (d.list == NULL)
        return refuse(row, "no memory for %zu depths", count);
    for (const char *item = text; d.count < count; d.count++) {
        const size_t length = strcspn(item, paired ? ",;" : ",");
        const bool ends = !paired || (d.count % 2 == 0 ? item[length] == ',' : item[length] != ',');
        double z;
        if (!number_parse_part(item, length, NUMBER_FINITE, &z) || !ends ||
            (limited && !(z >= row->least && z <= row->most)) || (whole && z != floor(z))) {
            free(d.list);
            return refuse(row, "must be %s, got '%.*s'%s%s%s", said, (int)length, item, count > 1 ? " in '" : "",
                          count > 1 ? text : "", count > 1 ? "'" : "");
        }
        d.list[d.count] = z + 0.0; /* no -0 */
        d.lo = fmin(d.lo, z);
        d.hi = fmax(d.hi, z);
        item += length + 1;
    }
    *out = d;
    return EXIT_FINE;
}

int parse_list(options *o, const option_row *row, const char *value) {
    char limits[OPTION_TEXT_SIZE], said[OPTION_TEXT_SIZE + 64];
    depths *out = field(o, row);
    snprintf(said, sizeof said, "%s, %snumbers from %s", row->argument, row->parse != parse_list ? "whole " : "",
             option_limits(row, limits));
    free(out->list); /* of an earlier one: the last one counts */
    *out = (depths){.kind = DEPTHS_LIST};
    return parse_listed(row, value, said, out);
}

int parse_codes(options *o, const option_row *row, const char *value) {
    return parse_list(o, row, value);
}

int parse_pixels(options *o, const option_row *row, const char *value) {
    return parse_list(o, row, value);
}

int parse_at(options *o, const option_row *row, const char *value) {
    free(o->at.list); /* of an earlier --at: the last one counts */
    o->at = (depths){.kind = DEPTHS_LIST};
    return strchr(value, ':') != NULL ? parse_spaced(row, value, &o->at)
                                      : parse_listed(row, value, "Z[,Z...] or LO:HI:log|lin:COUNT", &o->at);
}

int parse_range(options *o, const option_row *row, const char *value) {
    const int split = (int)strcspn(value, ":");
    if (value[split] == '\0')
        return refuse(row, "must be LO:HI, got '%s'", value);
    if (!number_parse_part(value, (size_t)split, NUMBER_FINITE, &o->range_lo))
        return refuse(row, "LO must be a number, got '%.*s' in '%s'", split, value, value);
    if (!number_parse(value + split + 1, NUMBER_FINITE, &o->range_hi))
        return refuse(row, "HI must be a number, got '%s' in '%s'", value + split + 1, value);
    return o->range_lo < o->range_hi ? EXIT_FINE : refuse(row, "LO must be less than HI, got '%s'", value);
}
