/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Options that are lengths, and lists of them. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "camera/cmd/depths.h"
#include "cli/option/option.h"
#include "core/append.h"
#include "report/output.h"
#include "system/input.h"

number_text lengths_text(const lengths *l, double value, int digits) {
    for (size_t i = 0; i < l->typed_count; i++)
        if (l->typed[i].value == value)
            return number_in(number_full(l->typed[i].number), l->typed[i].unit->name);
    return number_in(digits > 0 ? number_of(value, digits) : number_full(value), lengths_unit(l));
}

static bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (unsigned char)c >= 0x80;
}

/*
 * A number of scene units, or one with a unit right behind it or behind one blank; a hexadecimal one takes no unit,
 * which could be digits of it. A unit where nothing has said what a scene unit is makes that the metre.
 */
bool length_read(length_reader *seen, const char *text, size_t length, number_kind kind, double *out) {
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
    lengths *const in = seen->in;
    if (in->unit == NULL)
        in->unit = unit_find("m");
    *out = unit_convert(number, unit, in->unit);
    seen->named = true;
    if (in->typed_count < LENGTHS_TYPED_MAX)
        in->typed[in->typed_count++] = (typed_length){*out, number, unit};
    return isfinite(*out) && (*out != 0.0) == (number != 0.0);
}

#define UNITS_ARE "a unit is " UNIT_NAMES

const unit_row *option_unit(const asked_line *line, const char *name) {
    const char *text = option_text(line, name), *end = text != NULL ? text + strlen(text) : "";
    while (text != NULL && end > text && is_letter(end[-1]))
        end--;
    return *end != '\0' && unit_find(end) != NULL ? unit_find(end) : line->lengths->unit;
}

/* Letters behind digits make one expect a unit; those of 1e400, 0x10 and 0X1p9 do not. */
const char *length_hint(const char *text, size_t length) {
    const size_t digits = strcspn(text, "0123456789");
    bool letter = false;
    for (size_t i = digits; i < length; i++)
        letter = letter || (is_letter(text[i]) && strchr("eExXpP", text[i]) == NULL);
    return letter ? "; " UNITS_ARE : "";
}

/* "1,5m" is no length, and which depths would be meant is not clear. */
int length_check_mixed(const length_reader *seen, const option_row *row, const char *value) {
    if (!seen->named || !seen->bare)
        return EXIT_FINE;
    return option_refuse(row, "must have a unit in all places or in none, got '%s'; " UNITS_ARE, value);
}

int parse_length(asked_line *line, const option_row *row, const char *value, void *group) {
    char limits[OPTION_TEXT_SIZE], names[NAMES_SIZE] = "";
    const bool limited = row->least < row->most;
    length_reader seen = {.in = line->lengths};
    double length;
    const bool read = length_read(&seen, value, strlen(value), NUMBER_FINITE, &length);
    if (limited && (!read || !(length >= row->least && length <= row->most)))
        return option_refuse(row, "must be a number from %s%s%s, got '%s'%s", option_limits(row, limits),
                             row->names != NULL ? ", " : "",
                             row->names != NULL ? names_join(row->names, ", ", " or ", names) : "", value,
                             length_hint(value, strlen(value)));
    if (!read || (!limited && !(length > 0.0)))
        return option_refuse(row, "must be a positive number of scene units, got '%s'%s", value,
                             length_hint(value, strlen(value)));
    *(double *)option_field(row, group) = length;
    return EXIT_FINE;
}

/* Surfaces may be in one place. */
int parse_length_or_0(asked_line *line, const option_row *row, const char *value, void *group) {
    double length;
    if (!number_parse(value, NUMBER_FINITE, &length) || length != 0.0)
        return parse_length(line, row, value, group);
    *(double *)option_field(row, group) = 0.0;
    return EXIT_FINE;
}

/* Three lengths with a sign in between. */
static int parse_triple(asked_line *line, const option_row *row, const char *value, const char *sign, double least,
                        double *out) {
    const char *at = value;
    length_reader seen = {.in = line->lengths};
    for (int i = 0; i < 3; i++) {
        const size_t length = strcspn(at, sign);
        if (!length_read(&seen, at, length, NUMBER_FINITE, &out[i]) || !(out[i] >= least && out[i] <= 1e12) ||
            (at[length] == '\0') != (i == 2))
            return option_refuse(row, "must be %s, each from %s to 1e12, got '%s'%s", row->argument,
                                 least > 0.0 ? "1e-12" : "-1e12", value, length_hint(value, strlen(value)));
        at += length + 1;
    }
    return length_check_mixed(&seen, row, value);
}

int parse_origin(asked_line *line, const option_row *row, const char *value, void *group) {
    return parse_triple(line, row, value, ",", -1e12, option_field(row, group));
}

int parse_box(asked_line *line, const option_row *row, const char *value, void *group) {
    return parse_triple(line, row, value, "x", 1e-12, option_field(row, group));
}

/* Numbers with commas between them, each within its limits. @return how many, 0 where one is wrong */
int option_read_numbers(const char *text, int most, const double limits[][2], double *out) {
    for (int i = 0; i < most; i++) {
        const size_t length = strcspn(text, ",");
        if (!number_parse_part(text, length, NUMBER_FINITE, &out[i]) ||
            !(out[i] >= limits[i][0] && out[i] <= limits[i][1]))
            return 0;
        if (text[length] == '\0')
            return i + 1;
        text += length + 1;
    }
    return 0;
}

/* ---- Depths ------------------------------------------------------------------------------------------------------ */

static int wrong_form(const option_row *row, const char *text) {
    return option_refuse(row, "must be %s, got '%s'",
                         row->parse == parse_depths ? "Z[,Z...] or LO:HI:log|lin:COUNT" : row->argument, text);
}

/* A number of LO:HI: a length, or one within the row's limits, of codes a whole one. */
static bool read_end(length_reader *seen, const option_row *row, const char *text, size_t length, double *out) {
    if (seen != NULL)
        return length_read(seen, text, length, NUMBER_FINITE, out);
    return number_parse_part(text, length, NUMBER_FINITE, out) && *out >= row->least && *out <= row->most &&
           (row->parse != parse_codes || *out == floor(*out));
}

/* LO:HI:log|lin:COUNT; of codes LO:HI are all of them. */
static int parse_spaced(length_reader *seen, const option_row *row, const char *text, depths *out) {
    static const char *const ends[] = {"LO", "HI"};
    const char *part = text;
    size_t length = strcspn(part, ":");
    uint64_t count;
    double z[2];
    for (int i = 0; i < 2; i++, part += length + 1, length = strcspn(part, ":")) {
        const bool alone = part[length] == '\0' && i == 1 && row->parse == parse_codes;
        if (part[length] == '\0' && !alone)
            return wrong_form(row, text);
        if (!read_end(seen, row, part, length, &z[i]))
            return seen == NULL ? wrong_form(row, text)
                                : option_refuse(row, "%s must be a number, got '%.*s' in '%s'%s", ends[i], (int)length,
                                                part, text, length_hint(part, length));
        if (alone && z[0] < z[1] && z[1] - z[0] < DEPTHS_MAX) {
            *out = (depths){.kind = DEPTHS_LIN, .lo = z[0], .hi = z[1], .count = (size_t)(z[1] - z[0]) + 1};
            return EXIT_FINE;
        }
        if (alone)
            return option_refuse(row, "LO:HI must rise, by less than %d codes, got '%s'", DEPTHS_MAX, text);
    }
    const bool log = length == 3 && memcmp(part, "log", 3) == 0;
    if (part[length] == '\0')
        return wrong_form(row, text);
    if (!log && (length != 3 || memcmp(part, "lin", 3) != 0))
        return option_refuse(row, "spacing must be log or lin, got '%.*s' in '%s'", (int)length, part, text);
    part += length + 1;
    if (!number_parse_count(part, DEPTHS_MAX, &count) || count < 2)
        return option_refuse(row, "COUNT must be a whole number from 2 to %d, got '%s'", DEPTHS_MAX, part);
    if (!(z[0] < z[1]))
        return option_refuse(row, "LO must be less than HI, got '%s'", text);
    if (log && seen == NULL && !(z[0] > 0))
        return option_refuse(row, "log spacing needs LO greater than 0, got '%s'", text);
    *out = (depths){.kind = log ? DEPTHS_LOG : DEPTHS_LIN, .lo = z[0], .hi = z[1], .count = count};
    return EXIT_FINE;
}

/* Numbers separated by commas, what is `said` of them: lengths where `seen` notes them; from least to most where the
 * row has limits. */
static int parse_listed(asked_line *line, length_reader *seen, const option_row *row, const char *text,
                        const char *said, depths *out) {
    depths d = {.kind = DEPTHS_LIST, .lo = (double)INFINITY, .hi = -(double)INFINITY};
    const bool paired = row->parse == parse_pixels, whole = paired || row->parse == parse_codes;
    const bool limited = row->least < row->most;
    size_t count = 1;
    for (const char *c = text; *c != '\0'; c++)
        count += *c == ',' || (paired && *c == ';');
    if (count > DEPTHS_MAX)
        return option_refuse(row, "must be at most %d depths, got %zu", DEPTHS_MAX, count);
    d.list = asked_allocate(line, count * sizeof *d.list);
    if (d.list == NULL)
        return option_refuse(row, "no memory for %zu depths", count);
    for (const char *item = text; d.count < count; d.count++) {
        const size_t length = strcspn(item, paired ? ",;" : ",");
        const bool ends = !paired || (d.count % 2 == 0 ? item[length] == ',' : item[length] != ',');
        double z;
        const bool read = seen != NULL ? length_read(seen, item, length, NUMBER_FINITE, &z)
                                       : number_parse_part(item, length, NUMBER_FINITE, &z);
        if (!read || !ends || (limited && !(z >= row->least && z <= row->most)) || (whole && z != floor(z)))
            return option_refuse(row, "must be %s, got '%.*s'%s%s%s%s", said, (int)length, item,
                                 count > 1 ? " in '" : "", count > 1 ? text : "", count > 1 ? "'" : "",
                                 seen != NULL ? length_hint(item, length) : "");
        d.list[d.count] = z + 0.0; /* no -0 */
        d.lo = fmin(d.lo, z);
        d.hi = fmax(d.hi, z);
        item += length + 1;
    }
    *out = d;
    return EXIT_FINE;
}

int parse_list(asked_line *line, const option_row *row, const char *value, void *group) {
    char limits[OPTION_TEXT_SIZE], said[OPTION_TEXT_SIZE + 64];
    depths *out = option_field(row, group);
    snprintf(said, sizeof said, "%s, %snumbers from %s", row->argument, row->parse != parse_list ? "whole " : "",
             option_limits(row, limits));
    return strchr(value, ':') != NULL && strchr(row->argument, ':') != NULL
               ? parse_spaced(NULL, row, value, out)
               : parse_listed(line, NULL, row, value, said, out);
}

int parse_codes(asked_line *line, const option_row *row, const char *value, void *group) {
    return parse_list(line, row, value, group);
}

int parse_pixels(asked_line *line, const option_row *row, const char *value, void *group) {
    return parse_list(line, row, value, group);
}

/* ---- Depths of a file ---------------------------------------------------------------------------------------------
 */

enum { WORD_MOST = 64, ROOM_FIRST = 1024 };

/* Goes on to the next word. @return its length, 0 behind the last; of one that is too long, WORD_MOST */
static size_t next_word(FILE *in, size_t *lines, char word[WORD_MOST]) {
    size_t length = 0;
    bool comment = false;
    for (int c; (c = getc(in)) != EOF;) {
        comment = (comment || c == '#') && c != '\n';
        const bool between = comment || strchr(" ,;\t\r\n", c) != NULL;
        if (!between && length < WORD_MOST)
            word[length++] = (char)c;
        if (between && length > 0) {
            ungetc(c, in);
            break;
        }
        *lines += c == '\n';
    }
    word[length < WORD_MOST ? length : WORD_MOST - 1] = '\0';
    for (char *c = word; *c != '\0'; c++)
        *c = (char)(*c > ' ' && *c < 0x7f ? *c : '?'); /* of a file that is no text */
    return length;
}

static double *more_room(asked_line *line, const double *list, size_t count) {
    double *more = asked_allocate(line, 2 * count * sizeof *more);
    if (more != NULL)
        memcpy(more, list, count * sizeof *more);
    return more;
}

static int read_all(asked_line *line, length_reader *seen, const option_row *row, const char *path, FILE *in,
                    depths *out) {
    char word[WORD_MOST];
    size_t room = ROOM_FIRST, lines = 1;
    depths d = {.kind = DEPTHS_LIST, .lo = (double)INFINITY, .hi = -(double)INFINITY};
    double *list = asked_allocate(line, room * sizeof *list);
    for (size_t length; list != NULL && (length = next_word(in, &lines, word)) > 0;) {
        double z;
        if (length == WORD_MOST || !length_read(seen, word, length, NUMBER_FINITE, &z))
            return option_refuse(row, "%s: line %zu: must be a depth, got '%.20s'%s", path, lines, word,
                                 length_hint(word, strlen(word)));
        if (d.count == DEPTHS_MAX)
            return option_refuse(row, "%s: must hold at most %d depths", path, DEPTHS_MAX);
        if (d.count == room) {
            list = more_room(line, list, room);
            room *= 2;
        }
        if (list != NULL)
            list[d.count++] = z + 0.0; /* no -0 */
        d.lo = fmin(d.lo, z);
        d.hi = fmax(d.hi, z);
    }
    if (list == NULL)
        return option_refuse(row, "no memory for the depths of %s", path);
    if (ferror(in))
        return option_unreadable(row->name, path, errno);
    if (d.count == 0)
        return option_refuse(row, "%s: holds no depth", path);
    d.list = list;
    *out = d;
    return EXIT_FINE;
}

/* Depths that a file holds, as others wrote them: by white space or commas, # begins a comment. */
static int parse_file(asked_line *line, length_reader *seen, const option_row *row, const char *path, depths *out) {
    errno = 0;
    FILE *in = input_open(path);
    if (in == NULL)
        return option_unreadable(row->name, path, errno);
    const int status = read_all(line, seen, row, path, in, out);
    input_close(in);
    return status;
}

int parse_depths(asked_line *line, const option_row *row, const char *value, void *group) {
    length_reader seen = {.in = line->lengths};
    const int status =
        *value == '@' ? parse_file(line, &seen, row, value + 1, option_field(row, group))
        : strchr(value, ':') != NULL
            ? parse_spaced(&seen, row, value, option_field(row, group))
            : parse_listed(line, &seen, row, value, "Z[,Z...] or LO:HI:log|lin:COUNT", option_field(row, group));
    return status == EXIT_FINE ? length_check_mixed(&seen, row, value) : status;
}

/* LO:HI, of so many characters. */
int option_read_range(asked_line *line, const option_row *row, const char *value, size_t length, double out[2]) {
    const size_t split = strcspn(value, ":");
    const char *const hi = value + split + 1;
    const int low = (int)split, high = (int)length - low - 1;
    length_reader seen = {.in = line->lengths};
    if (split >= length)
        return option_refuse(row, "must be %s, got '%s'", row->argument, value);
    if (!length_read(&seen, value, split, NUMBER_FINITE, &out[0]))
        return option_refuse(row, "LO must be a number, got '%.*s' in '%s'%s", low, value, value,
                             length_hint(value, split));
    if (!length_read(&seen, hi, (size_t)high, NUMBER_FINITE, &out[1]))
        return option_refuse(row, "HI must be a number, got '%.*s' in '%s'%s", high, hi, value,
                             length_hint(hi, (size_t)high));
    const int status = length_check_mixed(&seen, row, value);
    return status != EXIT_FINE || out[0] < out[1] ? status
                                                  : option_refuse(row, "LO must be less than HI, got '%s'", value);
}
