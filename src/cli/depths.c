/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/depths.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/option_rows.h"
#include "report/number.h"

static const double infinite_far_ratio = 1e6; /* the default depths end at this many nears when far is infinite */

double depths_get(const depths *d, size_t i) {
    if (d->kind == DEPTHS_LIST)
        return d->list[i];
    if (i == 0)
        return d->lo;
    if (i + 1 >= d->count)
        return d->hi;
    double share = (double)i / (double)(d->count - 1);
    double z = d->kind == DEPTHS_LOG ? d->lo * pow(d->hi / d->lo, share) : d->lo + (d->hi - d->lo) * share;
    return fmin(fmax(z, d->lo), d->hi);
}

depths depths_spaced(depths_kind kind, double lo, double hi, size_t count) {
    return (depths){.kind = kind, .lo = lo, .hi = hi, .count = count};
}

static int wrong_form(const char *text) {
    return option_error(OPTION_AT, "must be Z[,Z...] or LO:HI:log|lin:COUNT, got '%s'", text);
}

/* LO:HI:log|lin:COUNT. */
static int parse_spaced(const char *text, depths *out) {
    static const char *const ends[] = {"LO", "HI"};
    const char *part = text;
    size_t length = strcspn(part, ":");
    unsigned long count;
    double z[2];
    for (int i = 0; i < 2; i++, part += length + 1, length = strcspn(part, ":")) {
        if (part[length] == '\0')
            return wrong_form(text);
        if (!number_parse_part(part, length, NUMBER_FINITE, &z[i]))
            return option_error(OPTION_AT, "%s must be a number, got '%.*s' in '%s'", ends[i], (int)length, part, text);
    }
    const bool log = length == 3 && memcmp(part, "log", 3) == 0;
    if (part[length] == '\0')
        return wrong_form(text);
    if (!log && (length != 3 || memcmp(part, "lin", 3) != 0))
        return option_error(OPTION_AT, "spacing must be log or lin, got '%.*s' in '%s'", (int)length, part, text);
    part += length + 1;
    if (!number_parse_count(part, DEPTHS_MAX, &count) || count < 2)
        return option_error(OPTION_AT, "COUNT must be a whole number from 2 to %d, got '%s'", DEPTHS_MAX, part);
    if (!(z[0] < z[1]))
        return option_error(OPTION_AT, "LO must be less than HI, got '%s'", text);
    *out = depths_spaced(log ? DEPTHS_LOG : DEPTHS_LIN, z[0], z[1], count);
    return EXIT_FINE;
}

static int parse_list(const char *text, depths *out) {
    depths d = {.kind = DEPTHS_LIST, .lo = (double)INFINITY, .hi = -(double)INFINITY};
    size_t count = 1;
    for (const char *c = text; *c != '\0'; c++)
        count += *c == ',';
    if (count > DEPTHS_MAX)
        return option_error(OPTION_AT, "must be at most %d depths, got %zu", DEPTHS_MAX, count);
    d.list = malloc(count * sizeof *d.list);
    if (d.list == NULL)
        return option_error(OPTION_AT, "no memory for %zu depths", count);
    for (const char *item = text; d.count < count; d.count++) {
        size_t length = strcspn(item, ",");
        double z;
        if (!number_parse_part(item, length, NUMBER_FINITE, &z)) {
            free(d.list);
            return option_error(OPTION_AT, "must be Z[,Z...] or LO:HI:log|lin:COUNT, got '%.*s'%s%s%s", (int)length,
                                item, count > 1 ? " in '" : "", count > 1 ? text : "", count > 1 ? "'" : "");
        }
        d.list[d.count] = z;
        d.lo = fmin(d.lo, z);
        d.hi = fmax(d.hi, z);
        item += length + 1;
    }
    *out = d;
    return EXIT_FINE;
}

int parse_at(options *o, option_id id, const char *value) {
    (void)id;
    free(o->at.list); /* of an earlier --at: the last one counts */
    o->at = (depths){.kind = DEPTHS_LIST};
    return strchr(value, ':') != NULL ? parse_spaced(value, &o->at) : parse_list(value, &o->at);
}

static int outside(const options *o, option_id id, double z) {
    return option_error(id, "depths must lie in [near, far] = [%s, %s%c, got %s", number_full(o->znear).text,
                        number_full(o->zfar).text, isinf(o->zfar) ? ')' : ']', number_full(z).text);
}

int depths_resolve(const options *o, size_t count, depths *out) {
    *out = o->at;
    if (o->at.count == 0)
        *out = depths_spaced(DEPTHS_LOG, o->znear, isinf(o->zfar) ? o->znear * infinite_far_ratio : o->zfar, count);
    if (out->lo < o->znear)
        return outside(o, OPTION_AT, out->lo);
    if (out->hi > o->zfar)
        return outside(o, OPTION_AT, out->hi);
    return EXIT_FINE;
}

int depths_in_binary32(const depths *d) {
    if (!isinf((float)d->hi))
        return EXIT_FINE;
    return option_error(OPTION_AT, "depths in binary32 must be at most 3.4028235e+38, its largest number, got %s",
                        number_full(d->hi).text);
}

int parse_range(options *o, option_id id, const char *value) {
    const int split = (int)strcspn(value, ":");
    if (value[split] == '\0')
        return option_error(id, "must be LO:HI, got '%s'", value);
    if (!number_parse_part(value, (size_t)split, NUMBER_FINITE, &o->range_lo))
        return option_error(id, "LO must be a number, got '%.*s' in '%s'", split, value, value);
    if (!number_parse(value + split + 1, NUMBER_FINITE, &o->range_hi))
        return option_error(id, "HI must be a number, got '%s' in '%s'", value + split + 1, value);
    return o->range_lo < o->range_hi ? EXIT_FINE : option_error(id, "LO must be less than HI, got '%s'", value);
}

int range_resolve(const options *o, double *lo, double *hi) {
    bool asked = option_given(o, OPTION_RANGE);
    *lo = asked ? o->range_lo : o->znear;
    *hi = asked ? o->range_hi : o->zfar;
    if (*lo < o->znear)
        return outside(o, OPTION_RANGE, *lo);
    if (*hi > o->zfar)
        return outside(o, OPTION_RANGE, *hi);
    return EXIT_FINE;
}
