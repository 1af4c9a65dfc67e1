/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Options that are lengths, and lists of them. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "api/unit.h"
#include "cli/option/rows.h"
#include "core/append.h"
#include "frame/device.h"
#include "report/number.h"

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
    if (seen->o->camera.unit == NULL)
        seen->o->camera.unit = unit_find("m");
    *out = unit_convert(number, unit, seen->o->camera.unit);
    seen->named = true;
    if (seen->o->camera.typed_count < OPTIONS_TYPED_MAX)
        seen->o->camera.typed[seen->o->camera.typed_count++] = (typed_length){*out, number, unit};
    return isfinite(*out) && (*out != 0.0) == (number != 0.0);
}

#define UNITS_ARE "a unit is " UNIT_NAMES

const unit_row *options_unit_of(const options *o, option_id id) {
    const char *text = option_given(o, id) ? o->given[id] : "", *end = text + strlen(text);
    while (end > text && is_letter(end[-1]))
        end--;
    return *end != '\0' && unit_find(end) != NULL ? unit_find(end) : o->camera.unit;
}

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
    return option_refuse(row, "must have a unit in all places or in none, got '%s'; " UNITS_ARE, value);
}

int parse_length(options *o, const option_row *row, const char *value) {
    char limits[OPTION_TEXT_SIZE], names[NAMES_SIZE] = "";
    const bool limited = row->least < row->most;
    lengths seen = {.o = o};
    double length;
    const bool read = read_length(&seen, value, strlen(value), NUMBER_FINITE, &length);
    if (limited && (!read || !(length >= row->least && length <= row->most)))
        return option_refuse(row, "must be a number from %s%s%s, got '%s'%s", option_limits(row, limits),
                             row->names != NULL ? ", " : "",
                             row->names != NULL ? names_join(row->names, ", ", " or ", names) : "", value,
                             unit_hint(value, strlen(value)));
    if (!read || (!limited && !(length > 0.0)))
        return option_refuse(row, "must be a positive number of scene units, got '%s'%s", value,
                             unit_hint(value, strlen(value)));
    *(double *)option_field(o, row) = length;
    return EXIT_FINE;
}

/* What 1 in a sample of metric depth is. */
static const struct sample_unit {
    const char *name, *length, *moved; /* moved: a row of moved_get(), or null */
} sample_units[] = {
    {"mm", "1mm", NULL},         {"tum", "0.2mm", NULL},         {"kitti", "3.90625mm", NULL},
    {"sun3d", "1mm", "rotated"}, {"nyu-raw", "1m", "disparity"},
};

bool list_samples(size_t index, list_item *item) {
    return index < sizeof sample_units / sizeof sample_units[0] &&
           list_fill(item, (list_item){.name = sample_units[index].name, .row = &sample_units[index]});
}

int parse_metric(options *o, const option_row *row, const char *value) {
    list_item item;
    char unit[32];
    const size_t length = strcspn(value, ",");
    snprintf(unit, sizeof unit, "%.*s", (int)length, value);
    const bool named = names_find(row->names, unit, NULL, &item);
    const struct sample_unit *const known = named ? item.row : NULL;
    const char *const way = value[length] == ',' ? value + length + 1 : named ? known->moved : NULL;
    char ways[OPTION_TEXT_SIZE] = "";
    o->image.moved = NULL;
    for (size_t i = 0; moved_get(i) != NULL; i++) {
        if (moved_get(i)->reading == NULL || moved_get(i)->lattice != NULL)
            continue;
        append(ways, sizeof ways, "%s%s", ways[0] != '\0' ? ", " : "", moved_get(i)->name);
        if (way != NULL && strcmp(moved_get(i)->name, way) == 0)
            o->image.moved = moved_get(i);
    }
    if (value[length] == ',' && (o->image.moved == NULL || (named && known->moved != NULL)))
        return option_refuse(row, "must have one of %s behind the comma of a unit, got '%s'", ways, value);
    for (size_t i = 0; named && known->moved != NULL && moved_get(i) != NULL; i++)
        if (strcmp(moved_get(i)->name, known->moved) == 0)
            o->image.moved = moved_get(i);
    return parse_length(o, row, named ? known->length : length < sizeof unit ? unit : value);
}

bool list_stereo(size_t index, list_item *item) {
    size_t left = index;
    for (size_t i = 0; device_get(i) != NULL; i++)
        if (device_get(i)->focal > 0 && left-- == 0)
            return list_fill(item, (list_item){.name = device_get(i)->name, .row = device_get(i)});
    return false;
}

static int take_device(lengths *seen, const device_row *d, stereo_spec *out) {
    const unit_row *metre = unit_find("m");
    if (seen->o->camera.unit == NULL)
        seen->o->camera.unit = metre;
    *out = (stereo_spec){d->focal, unit_convert(d->baseline, metre, seen->o->camera.unit), d->offset, d->step};
    return EXIT_FINE;
}

/* A number, or a quotient of two. */
static bool read_quotient(const char *text, size_t length, double *out) {
    const char *const over = memchr(text, '/', length);
    const size_t whole = over != NULL ? (size_t)(over - text) : length;
    double divisor = 1;
    const bool good =
        number_parse_part(text, whole, NUMBER_FINITE, out) &&
        (over == NULL || (number_parse_part(over + 1, length - whole - 1, NUMBER_FINITE, &divisor) && divisor != 0.0));
    *out /= divisor;
    return good;
}

/* Numbers in this order, or behind their names in any. */
static const struct stereo_part {
    const char *name, *limits;
    double least, most;
    size_t place;
} stereo_parts[] = {
    {"focal", "a number from 0.001 to 1e9", 1e-3, 1e9, offsetof(stereo_spec, focal)},
    {"baseline", "a length from 1e-9 to 1e9", 1e-9, 1e9, offsetof(stereo_spec, baseline)},
    {"offset", "a number from -1e6 to 1e6", -1e6, 1e6, offsetof(stereo_spec, offset)},
    {"step", "a number from -1e6 to 1e6, and not within 1e-6 of 0", -1e6, 1e6, offsetof(stereo_spec, step)}};
enum { STEREO_PARTS = sizeof stereo_parts / sizeof stereo_parts[0], STEREO_BASELINE = 1, STEREO_STEP = 3 };
static const double STEREO_STEP_LEAST = 1e-6;

static int stereo_part_set(lengths *seen, const option_row *row, const char *text, size_t length, size_t place,
                           stereo_spec *out) {
    const char *const equals = memchr(text, '=', length);
    const size_t name = equals != NULL ? (size_t)(equals - text) : 0, from = equals != NULL ? name + 1 : 0;
    for (size_t i = 0; equals != NULL && (place = i) < STEREO_PARTS; i++)
        if (strlen(stereo_parts[i].name) == name && memcmp(stereo_parts[i].name, text, name) == 0)
            break;
    char names[NAMES_SIZE];
    if (place >= STEREO_PARTS || (place == 0 && equals == NULL && is_letter(text[0])))
        return option_refuse(row, "must be focal=F,baseline=B[,offset=O][,step=S], or begin with %s, got '%.*s'",
                             names_join(row->names, ", ", " or ", names), (int)length, text);
    const struct stereo_part *p = &stereo_parts[place];
    double value;
    const bool read = place == STEREO_BASELINE ? read_length(seen, text + from, length - from, NUMBER_FINITE, &value)
                                               : read_quotient(text + from, length - from, &value);
    if (!read || !(value >= p->least && value <= p->most) || (place == STEREO_STEP && fabs(value) < STEREO_STEP_LEAST))
        return option_refuse(row, "%s must be %s, got '%.*s'%s", p->name, p->limits, (int)(length - from), text + from,
                             place == STEREO_BASELINE ? unit_hint(text + from, length - from) : "");
    *(double *)((char *)out + p->place) = value;
    return EXIT_FINE;
}

int parse_stereo(options *o, const option_row *row, const char *value) {
    lengths seen = {.o = o};
    stereo_spec *out = option_field(o, row);
    int status = EXIT_FINE;
    *out = (stereo_spec){.step = 1};
    o->image.metric = 1; /* of scene units */
    for (size_t place = 0; status == EXIT_FINE; place++) {
        const size_t length = strcspn(value, ",");
        char name[32];
        list_item item;
        snprintf(name, sizeof name, "%.*s", (int)length, value);
        if (place == 0 && length < sizeof name && names_find(row->names, name, NULL, &item))
            status = take_device(&seen, item.row, out);
        else
            status = stereo_part_set(&seen, row, value, length, place, out);
        if (value[length] == '\0')
            break;
        value += length + 1;
    }
    if (status == EXIT_FINE && !(out->focal > 0 && out->baseline > 0))
        return option_refuse(row, "needs focal=F and baseline=B, got '%s'", o->given[OPTION_STEREO]);
    return status;
}

/* Surfaces of a model may be in one place. */
int parse_separation_or_0(options *o, const option_row *row, const char *value) {
    double apart;
    if (!number_parse(value, NUMBER_FINITE, &apart) || apart != 0.0)
        return parse_length(o, row, value);
    o->wanted.separation = 0.0;
    return EXIT_FINE;
}

/* What is not positive needs --ortho, which may come later: check_near() of options.c. */
int parse_near(options *o, const option_row *row, const char *value) {
    if (!read_length(&(lengths){.o = o}, value, strlen(value), NUMBER_FINITE, &o->camera.znear) ||
        o->camera.znear > 0.0)
        return parse_length(o, row, value);
    o->camera.znear += 0.0; /* -0 is 0 */
    return EXIT_FINE;
}

int parse_far(options *o, const option_row *row, const char *value) {
    if (!read_length(&(lengths){.o = o}, value, strlen(value), NUMBER_FAR, &o->camera.zfar))
        return option_refuse(row, "must be a number greater than near and at most 1e28, or inf, got '%s'%s", value,
                             unit_hint(value, strlen(value)));
    return EXIT_FINE;
}

static int add_far(options *o, const option_row *row, const char *name) {
    const int status = parse_far(o, row, name);
    if (o->camera.far_count == OPTIONS_FARS_MAX)
        return option_refuse(row, "must be at most %d far planes, got '%s' too", OPTIONS_FARS_MAX, name);
    o->camera.fars[o->camera.far_count++] = o->camera.zfar;
    return status;
}

int parse_fars(options *o, const option_row *row, const char *value) {
    o->camera.far_count = 0;
    const int status = parse_names(o, row, value, add_far);
    for (size_t i = 0; i < o->camera.far_count; i++)
        if (o->camera.fars[i] > o->camera.zfar)
            o->camera.zfar = o->camera.fars[i];
    return status;
}

/* Three lengths with a sign in between. */
static int parse_triple(options *o, const option_row *row, const char *value, const char *sign, double least,
                        double *out) {
    const char *at = value;
    lengths seen = {.o = o};
    for (int i = 0; i < 3; i++) {
        const size_t length = strcspn(at, sign);
        if (!read_length(&seen, at, length, NUMBER_FINITE, &out[i]) || !(out[i] >= least && out[i] <= 1e12) ||
            (at[length] == '\0') != (i == 2))
            return option_refuse(row, "must be %s, each from %s to 1e12, got '%s'%s", row->argument,
                                 least > 0.0 ? "1e-12" : "-1e12", value, unit_hint(value, strlen(value)));
        at += length + 1;
    }
    return check_mixed(&seen, row, value);
}

int parse_origin(options *o, const option_row *row, const char *value) {
    return parse_triple(o, row, value, ",", -1e12, option_field(o, row));
}

int parse_light_box(options *o, const option_row *row, const char *value) {
    return parse_triple(o, row, value, "x", 1e-12, o->shadow.light_box);
}

/* Numbers with commas between them, each within its limits. @return how many, 0 where one is wrong */
static int numbers_of(const char *text, int most, const double limits[][2], double *out) {
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

int parse_intrinsics(options *o, const option_row *row, const char *value) {
    static const double limits[][2] = {{1, 1e9}, {1, 1e9}, {-1e6, 1e6}, {-1e6, 1e6}};
    return numbers_of(value, 4, limits, option_field(o, row)) == 4
               ? EXIT_FINE
               : option_refuse(row, "must be %s, the first two from 1 to 1e9, the others from -1e6 to 1e6, got '%s'",
                               row->argument, value);
}

int parse_tint(options *o, const option_row *row, const char *value) {
    static const double limits[][2] = {{0, 1}, {0, 1}, {0, 1}, {0, 1}};
    o->image.tint[3] = 1;
    return numbers_of(value, 4, limits, o->image.tint) >= 3
               ? EXIT_FINE
               : option_refuse(row, "must be %s, each from 0 to 1, got '%s'", row->argument, value);
}

/* ---- Depths ------------------------------------------------------------------------------------------------------ */

static int wrong_form(const option_row *row, const char *text) {
    return option_refuse(row, "must be Z[,Z...] or LO:HI:log|lin:COUNT, got '%s'", text);
}

/* LO:HI:log|lin:COUNT. */
static int parse_spaced(lengths *seen, const option_row *row, const char *text, depths *out) {
    static const char *const ends[] = {"LO", "HI"};
    const char *part = text;
    size_t length = strcspn(part, ":");
    uint64_t count;
    double z[2];
    for (int i = 0; i < 2; i++, part += length + 1, length = strcspn(part, ":")) {
        if (part[length] == '\0')
            return wrong_form(row, text);
        if (!read_length(seen, part, length, NUMBER_FINITE, &z[i]))
            return option_refuse(row, "%s must be a number, got '%.*s' in '%s'%s", ends[i], (int)length, part, text,
                                 unit_hint(part, length));
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
        return option_refuse(row, "must be at most %d depths, got %zu", DEPTHS_MAX, count);
    d.list = malloc(count * sizeof *d.list);
    if (d.list == NULL)
        return option_refuse(row, "no memory for %zu depths", count);
    for (const char *item = text; d.count < count; d.count++) {
        const size_t length = strcspn(item, paired ? ",;" : ",");
        const bool ends = !paired || (d.count % 2 == 0 ? item[length] == ',' : item[length] != ',');
        double z;
        const bool read = seen != NULL ? read_length(seen, item, length, NUMBER_FINITE, &z)
                                       : number_parse_part(item, length, NUMBER_FINITE, &z);
        if (!read || !ends || (limited && !(z >= row->least && z <= row->most)) || (whole && z != floor(z))) {
            free(d.list);
            return option_refuse(row, "must be %s, got '%.*s'%s%s%s%s", said, (int)length, item,
                                 count > 1 ? " in '" : "", count > 1 ? text : "", count > 1 ? "'" : "",
                                 seen != NULL ? unit_hint(item, length) : "");
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
    depths *out = option_field(o, row);
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

static int read_depths(options *o, const option_row *row, const char *value, depths *out) {
    lengths seen = {.o = o};
    const int status = strchr(value, ':') != NULL
                           ? parse_spaced(&seen, row, value, out)
                           : parse_listed(&seen, row, value, "Z[,Z...] or LO:HI:log|lin:COUNT", out);
    return status == EXIT_FINE ? check_mixed(&seen, row, value) : status;
}

int parse_at(options *o, const option_row *row, const char *value) {
    return read_depths(o, row, value, option_field(o, row));
}

/* In place of a bound of coordinates, whose limits are not theirs. */
int parse_distances(options *o, const option_row *row, const char *value) {
    option_row free = *row;
    free.least = free.most = 0.0;
    return read_depths(o, &free, value, &o->world.distances);
}

/* LO:HI, of so many characters. */
static int read_range(options *o, const option_row *row, const char *value, size_t length, double out[2]) {
    const size_t split = strcspn(value, ":");
    const char *const hi = value + split + 1;
    const int low = (int)split, high = (int)length - low - 1;
    lengths seen = {.o = o};
    if (split >= length)
        return option_refuse(row, "must be %s, got '%s'", row->argument, value);
    if (!read_length(&seen, value, split, NUMBER_FINITE, &out[0]))
        return option_refuse(row, "LO must be a number, got '%.*s' in '%s'%s", low, value, value,
                             unit_hint(value, split));
    if (!read_length(&seen, hi, (size_t)high, NUMBER_FINITE, &out[1]))
        return option_refuse(row, "HI must be a number, got '%.*s' in '%s'%s", high, hi, value,
                             unit_hint(hi, (size_t)high));
    const int status = check_mixed(&seen, row, value);
    return status != EXIT_FINE || out[0] < out[1] ? status
                                                  : option_refuse(row, "LO must be less than HI, got '%s'", value);
}

int parse_range(options *o, const option_row *row, const char *value) {
    double range[2] = {0};
    const int status = read_range(o, row, value, strlen(value), range);
    o->camera.range_lo = range[0];
    o->camera.range_hi = range[1];
    return status;
}

int parse_axes(options *o, const option_row *row, const char *value) {
    const size_t split = strcspn(value, ",");
    if (value[split] == '\0')
        return option_refuse(row, "must be %s, got '%s'", row->argument, value);
    const int status = read_range(o, row, value, split, o->figure.axes);
    return status != EXIT_FINE ? status
                               : read_range(o, row, value + split + 1, strlen(value + split + 1), o->figure.axes + 2);
}

/* Half the height of what an image shows stands behind "=". */
int parse_ortho(options *o, const option_row *row, const char *value) {
    option_row half = *row;
    half.place = offsetof(options, view.spec.half_height);
    half.least = 1e-12;
    half.most = 1e12;
    half.unit = "scene units";
    const int status = value != NULL ? parse_length(o, &half, value) : EXIT_FINE;
    return status == EXIT_FINE ? parse_flag(o, row, NULL) : status;
}

/* N, or N:LAMBDA. */
int parse_cascades(options *o, const option_row *row, const char *value) {
    enum { MOST = 8 }; /* as many as a figure has panels */
    const size_t length = strcspn(value, ":");
    char number[8];
    uint64_t count;
    snprintf(number, sizeof number, "%.*s", (int)length, value);
    if (length >= sizeof number || !number_parse_count(number, MOST, &count) || count < 1 ||
        (value[length] != '\0' && (!number_parse(value + length + 1, NUMBER_FINITE, &o->shadow.lambda) ||
                                   !(o->shadow.lambda >= 0.0 && o->shadow.lambda <= 1.0))))
        return option_refuse(row, "must be N or N:LAMBDA, N a whole number from 1 to %d, LAMBDA from 0 to 1, got '%s'",
                             MOST, value);
    o->shadow.cascades = (unsigned)count;
    return EXIT_FINE;
}

/* Z, or Z:FACET. */
int parse_curvature(options *o, const option_row *row, const char *value) {
    const size_t split = strcspn(value, ":");
    lengths seen = {.o = o};
    const bool faceted = value[split] != '\0';
    double radius, facet = 0.0;
    if (!read_length(&seen, value, split, NUMBER_FINITE, &radius) || !(radius >= 1e-12 && radius <= 1e18) ||
        (faceted && (!read_length(&seen, value + split + 1, strlen(value + split + 1), NUMBER_FINITE, &facet) ||
                     !(facet >= 0.0 && facet <= 1e18))))
        return option_refuse(row, "must be Z or Z:FACET, Z from 1e-12 and FACET from 0 to 1e18 scene units, got '%s'%s",
                             value, unit_hint(value, split));
    o->shadow.curvature = radius;
    o->shadow.facet = facet;
    return check_mixed(&seen, row, value);
}
