/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/option_rows.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "api/unit.h"
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

const struct option_exception *option_exception_of(const option_row *row, const verb *v) {
    for (int i = 0; i < OPTION_EXCEPTIONS; i++)
        if ((row->except[i].commands & v->bit) != 0)
            return &row->except[i];
    return NULL;
}

const char *option_takers(const option_row *row, char out[OPTION_TEXT_SIZE]) {
    return option_takers_of(row->commands, out);
}

const char *option_takers_of(unsigned commands, char out[OPTION_TEXT_SIZE]) {
    out[0] = '\0';
    for (size_t i = 0; i < verb_count; i++)
        if ((commands & verb_rows[i].bit) != 0)
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

/* What the lengths of one argument have: some a unit, and some, other than 0, none. */
typedef struct lengths {
    options *o;
    bool named, bare;
} lengths;

static bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (unsigned char)c >= 0x80;
}

/*
 * A number of scene units, or one with a unit right behind it or behind one blank; a hexadecimal one takes no unit,
 * which could be digits of it. A unit where nothing has said what a scene unit is makes that the metre.
 */
static bool read_length(lengths *seen, const char *text, size_t length, number_kind kind, double *out) {
    char name[8] = "";
    size_t end = length;
    double number;
    if (number_parse_part(text, length, kind, out)) {
        seen->bare = seen->bare || *out != 0.0;
        return true;
    }
    while (end > 0 && is_letter(text[end - 1]))
        end--;
    append(name, sizeof name, "%.*s", (int)(length - end), text + end);
    const unit_row *unit = length - end < sizeof name ? unit_find(name) : NULL;
    end -= end > 0 && text[end - 1] == ' ';
    if (unit == NULL || memchr(text, 'x', end) != NULL || memchr(text, 'X', end) != NULL ||
        !number_parse_part(text, end, NUMBER_FINITE, &number))
        return false;
    if (seen->o->unit == NULL)
        seen->o->unit = unit_find("m");
    *out = unit_convert(number, unit, seen->o->unit);
    seen->named = true;
    return isfinite(*out) && (*out != 0.0) == (number != 0.0);
}

#define UNITS_ARE "a unit is " UNIT_NAMES

/* What a refusal adds where letters behind digits make one expect a unit; not those of 1e400 and 0x10. */
static const char *unit_hint(const char *text, size_t length) {
    const size_t digits = strcspn(text, "0123456789");
    bool letter = false;
    for (size_t i = digits; i < length; i++)
        letter = letter || (is_letter(text[i]) && strchr("eEx", text[i]) == NULL);
    return letter ? "; " UNITS_ARE : "";
}

/* "1,5m" is no length, and which depths would be meant is not clear. */
static int check_mixed(const lengths *seen, const option_row *row, const char *value) {
    if (!seen->named || !seen->bare)
        return EXIT_FINE;
    return refuse(row, "must have a unit in all places or in none, got '%s'; " UNITS_ARE, value);
}

int parse_length(options *o, const option_row *row, const char *value) {
    char limits[OPTION_TEXT_SIZE];
    const bool limited = row->least < row->most;
    lengths seen = {.o = o};
    double length;
    const bool read = read_length(&seen, value, strlen(value), NUMBER_FINITE, &length);
    if (limited && (!read || !(length >= row->least && length <= row->most)))
        return refuse(row, "must be a number from %s, got '%s'%s", option_limits(row, limits), value,
                      unit_hint(value, strlen(value)));
    if (!read || (!limited && !(length > 0.0)))
        return refuse(row, "must be a positive number of scene units, got '%s'%s", value,
                      unit_hint(value, strlen(value)));
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

int parse_unit(options *o, const option_row *row, const char *value) {
    o->unit = unit_find(value);
    return o->unit != NULL ? EXIT_FINE : refuse(row, "must be " UNIT_NAMES ", got '%s'", value);
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
    if (!read_length(&(lengths){.o = o}, value, strlen(value), NUMBER_FINITE, &o->znear) || o->znear > 0.0)
        return parse_length(o, row, value);
    o->znear += 0.0; /* -0 is 0 */
    return EXIT_FINE;
}

int parse_far(options *o, const option_row *row, const char *value) {
    if (!read_length(&(lengths){.o = o}, value, strlen(value), NUMBER_FAR, &o->zfar))
        return refuse(row, "must be a number greater than near and at most 1e18, or inf, got '%s'%s", value,
                      unit_hint(value, strlen(value)));
    return EXIT_FINE;
}

/* NAME[,NAME...]: one after the other to `add`. */
static int parse_names(options *o, const option_row *row, const char *value,
                       int (*add)(options *, const option_row *, const char *)) {
    char name[64];
    const size_t length = strlen(value);
    if (length == 0 || *value == ',' || value[length - 1] == ',' || strstr(value, ",,") != NULL)
        return refuse(row, "must be %s, got '%s'", row->argument, value);
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

static int add_preset(options *o, const option_row *row, const char *name) {
    list_item found;
    if (!names_find(row->names, name, NULL, &found))
        return unknown_name(row, name);
    for (size_t i = 0; i < o->preset_count; i++)
        if (o->presets[i] == found.row)
            return EXIT_FINE;
    if (o->preset_count == OPTIONS_PRESETS_MAX)
        return refuse(row, "must be at most %d presets, got '%s' too", OPTIONS_PRESETS_MAX, name);
    o->presets[o->preset_count++] = found.row;
    return EXIT_FINE;
}

int parse_presets(options *o, const option_row *row, const char *value) {
    return parse_names(o, row, value, add_preset);
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
    lengths seen = {.o = o};
    for (int i = 0; i < 3; i++) {
        const size_t length = strcspn(at, ",");
        double *x = &o->camera.origin[i];
        if (!read_length(&seen, at, length, NUMBER_FINITE, x) || !(*x >= -1e12 && *x <= 1e12) ||
            (at[length] == '\0') != (i == 2))
            return refuse(row, "must be X,Y,Z, each from -1e12 to 1e12, got '%s'%s", value,
                          unit_hint(value, strlen(value)));
        at += length + 1;
    }
    return check_mixed(&seen, row, value);
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
    if (i < o->parameter_count)
        return refuse(row, "must not be given twice for '%s', got '%s' too", given.name, value);
    if (i == OPTIONS_PARAMETERS_MAX)
        return refuse(row, "must not be more than %d, got '%s' too", OPTIONS_PARAMETERS_MAX, value);
    o->parameters[o->parameter_count++] = given;
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
static int parse_spaced(lengths *seen, const option_row *row, const char *text, depths *out) {
    static const char *const ends[] = {"LO", "HI"};
    const char *part = text;
    size_t length = strcspn(part, ":");
    unsigned long count;
    double z[2];
    for (int i = 0; i < 2; i++, part += length + 1, length = strcspn(part, ":")) {
        if (part[length] == '\0')
            return wrong_form(row, text);
        if (!read_length(seen, part, length, NUMBER_FINITE, &z[i]))
            return refuse(row, "%s must be a number, got '%.*s' in '%s'%s", ends[i], (int)length, part, text,
                          unit_hint(part, length));
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

/* Numbers separated by commas, what is `said` of them: lengths where `seen` notes them; from least to most where the
 * row has limits. */
static int parse_listed(lengths *seen, const option_row *row, const char *text, const char *said, depths *out) {
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
        const bool read = seen != NULL ? read_length(seen, item, length, NUMBER_FINITE, &z)
                                       : number_parse_part(item, length, NUMBER_FINITE, &z);
        if (!read || !ends || (limited && !(z >= row->least && z <= row->most)) || (whole && z != floor(z))) {
            free(d.list);
            return refuse(row, "must be %s, got '%.*s'%s%s%s%s", said, (int)length, item, count > 1 ? " in '" : "",
                          count > 1 ? text : "", count > 1 ? "'" : "", seen != NULL ? unit_hint(item, length) : "");
        }
        d.list[d.count] = z + 0.0; /* no -0 */
        d.lo = fmin(d.lo, z);
        d.hi = fmax(d.hi, z);
        item += length + 1;
    }
    free(out->list); /* --depth and --code are one field, and refused together later */
    *out = d;
    return EXIT_FINE;
}

int parse_list(options *o, const option_row *row, const char *value) {
    char limits[OPTION_TEXT_SIZE], said[OPTION_TEXT_SIZE + 64];
    depths *out = field(o, row);
    snprintf(said, sizeof said, "%s, %snumbers from %s", row->argument, row->parse != parse_list ? "whole " : "",
             option_limits(row, limits));
    return parse_listed(NULL, row, value, said, out);
}

int parse_codes(options *o, const option_row *row, const char *value) {
    return parse_list(o, row, value);
}

int parse_pixels(options *o, const option_row *row, const char *value) {
    return parse_list(o, row, value);
}

int parse_at(options *o, const option_row *row, const char *value) {
    lengths seen = {.o = o};
    const int status = strchr(value, ':') != NULL
                           ? parse_spaced(&seen, row, value, &o->at)
                           : parse_listed(&seen, row, value, "Z[,Z...] or LO:HI:log|lin:COUNT", &o->at);
    return status == EXIT_FINE ? check_mixed(&seen, row, value) : status;
}

int parse_range(options *o, const option_row *row, const char *value) {
    const size_t split = strcspn(value, ":");
    const char *const hi = value + split + 1;
    lengths seen = {.o = o};
    if (value[split] == '\0')
        return refuse(row, "must be LO:HI, got '%s'", value);
    if (!read_length(&seen, value, split, NUMBER_FINITE, &o->range_lo))
        return refuse(row, "LO must be a number, got '%.*s' in '%s'%s", (int)split, value, value,
                      unit_hint(value, split));
    if (!read_length(&seen, hi, strlen(hi), NUMBER_FINITE, &o->range_hi))
        return refuse(row, "HI must be a number, got '%s' in '%s'%s", hi, value, unit_hint(hi, strlen(hi)));
    const int status = check_mixed(&seen, row, value);
    return status != EXIT_FINE || o->range_lo < o->range_hi ? status
                                                            : refuse(row, "LO must be less than HI, got '%s'", value);
}
