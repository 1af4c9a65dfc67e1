/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Kinds of options. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/option/option.h"
#include "core/append.h"
#include "image/image.h"
#include "report/output.h"
#include "system/input.h"

const char *option_argument(const option_row *row, char out[OPTION_TEXT_SIZE]) {
    out[0] = '\0';
    if (row->argument == NULL && row->names != NULL)
        return names_join(row->names, "|", "|", out);
    append(out, OPTION_TEXT_SIZE, "%s", row->argument != NULL ? row->argument : "");
    return out;
}

/* Flags, counts and enumerations are as wide as their fields. */
static void set_whole(const option_row *row, void *group, uint64_t whole) {
    const bool flag = whole != 0;
    const unsigned narrow = (unsigned)whole;
    const size_t size = row->size;
    const void *const from = size == sizeof flag     ? (const void *)&flag
                             : size == sizeof narrow ? &narrow
                                                     : (void *)&whole;
    memcpy(option_field(row, group), from, size);
}

int parse_flag(asked_line *line, const option_row *row, const char *value, void *group) {
    (void)line;
    (void)value;
    set_whole(row, group, 1);
    return EXIT_FINE;
}

int parse_text(asked_line *line, const option_row *row, const char *value, void *group) {
    (void)line;
    *(const char **)option_field(row, group) = value;
    return EXIT_FINE;
}

int parse_some(asked_line *line, const option_row *row, const char *value, void *group) {
    return *value != '\0' ? parse_text(line, row, value, group) : option_refuse(row, "must not be empty, got ''");
}

int parse_written(asked_line *line, const option_row *row, const char *value, void *group) {
    return *value != '\0' ? parse_text(line, row, value, group) : option_refuse(row, "must be a file name, got ''");
}

int parse_read(asked_line *line, const option_row *row, const char *value, void *group) {
    if (*value != '\0')
        input_expect(value);
    return parse_written(line, row, value, group);
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

int parse_number(asked_line *line, const option_row *row, const char *value, void *group) {
    (void)line;
    char limits[OPTION_TEXT_SIZE];
    double number;
    if (!number_parse(value, NUMBER_FINITE, &number) || !(number >= row->least && number <= row->most))
        return option_refuse(row, "must be a number from %s, got '%s'", option_limits(row, limits), value);
    *(double *)option_field(row, group) = number;
    return EXIT_FINE;
}

int parse_whole(asked_line *line, const option_row *row, const char *value, void *group) {
    (void)line;
    char limits[OPTION_TEXT_SIZE];
    uint64_t whole;
    if (!number_parse_count(value, (uint64_t)row->most, &whole) || (double)whole < row->least)
        return option_refuse(row, "must be a whole number from %s, got '%s'", option_limits(row, limits), value);
    set_whole(row, group, whole);
    return EXIT_FINE;
}

int option_unknown(const option_row *row, const char *name) {
    char text[NAMES_SIZE];
    return option_refuse(row, "%s", names_refuse(row->names, name, text));
}

int parse_word(asked_line *line, const option_row *row, const char *value, void *group) {
    (void)line;
    size_t index;
    if (!names_find(row->names, value, &index, NULL))
        return option_unknown(row, value);
    set_whole(row, group, index);
    return EXIT_FINE;
}

int parse_row(asked_line *line, const option_row *row, const char *value, void *group) {
    (void)line;
    list_item item;
    if (!names_find(row->names, value, NULL, &item))
        return option_unknown(row, value);
    memcpy(option_field(row, group), &item.row, sizeof item.row); /* whatever it points to */
    return EXIT_FINE;
}

int parse_names(asked_line *line, const option_row *row, const char *value, void *group, option_parser *add) {
    char name[64];
    const size_t length = strlen(value);
    if (length == 0 || *value == ',' || value[length - 1] == ',' || strstr(value, ",,") != NULL)
        return option_refuse(row, "must be %s, got '%s'", row->argument, value);
    for (const char *at = value; *at != '\0'; at += *at == ',') {
        const size_t part = strcspn(at, ",");
        snprintf(name, sizeof name, "%.*s", (int)part, at);
        const int status = part < sizeof name ? add(line, row, name, group) : option_unknown(row, at);
        if (status != EXIT_FINE)
            return status;
        at += part;
    }
    return EXIT_FINE;
}

int option_read_named(const option_row *row, const char *value, list_item *found, const char **x) {
    const size_t length = strcspn(value, ":");
    char name[64];
    snprintf(name, sizeof name, "%.*s", (int)length, value);
    *x = value[length] == ':' ? value + length + 1 : NULL;
    return length < sizeof name && names_find(row->names, name, NULL, found) ? EXIT_FINE : option_unknown(row, name);
}

/* A share, or a percentage with its sign. */
int parse_share(asked_line *line, const option_row *row, const char *value, void *group) {
    (void)line;
    const size_t length = strlen(value);
    const bool percent = length > 0 && value[length - 1] == '%';
    double share;
    if (!number_parse_part(value, length - percent, NUMBER_FINITE, &share) || !(share >= 0.0))
        return option_refuse(row, "must be a share such as 0.05, or 5%%, not negative, got '%s'", value);
    *(double *)option_field(row, group) = percent ? share / 100.0 : share;
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

static int read_size(const option_row *row, const char *value, void *group, bool square) {
    uint64_t sides[2];
    uint32_t *const out = option_field(row, group);
    const int status = option_read_sides(row, value, IMAGE_SIDE_MAX, square, sides);
    if (status != EXIT_FINE)
        return status;
    if (sides[0] * sides[1] > IMAGE_PIXELS_MAX)
        return option_refuse(row, "must be at most %u pixels in all, got '%s'", (unsigned)IMAGE_PIXELS_MAX, value);
    out[0] = (uint32_t)sides[0];
    out[1] = (uint32_t)sides[1];
    return EXIT_FINE;
}

int parse_size(asked_line *line, const option_row *row, const char *value, void *group) {
    (void)line;
    return read_size(row, value, group, false);
}

int parse_size_or_n(asked_line *line, const option_row *row, const char *value, void *group) {
    (void)line;
    return read_size(row, value, group, strchr(value, 'x') == NULL);
}
