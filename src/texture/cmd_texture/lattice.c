/* SPDX-License-Identifier: GPL-3.0-or-later */
/* --lattice: what metric depth was rounded to, where somebody knows. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cli/list.h"
#include "cli/option/names.h"
#include "core/append.h"
#include "report/message.h"
#include "report/number.h"
#include "texture/cmd_texture/texture.h"
#include "texture/device.h"

enum { NUMBERS = 3, LATTICE_SIZE = 128 };

/* The step, and the offset of a level; NaN where it is not said. */
typedef void lattice_maker(const double numbers[NUMBERS], sensor *out);

static void make_stereo(const double n[NUMBERS], sensor *out) {
    out->step = (isnan(n[2]) ? 1 : n[2]) / (n[0] * n[1]);
}

static void make_inverse(const double n[NUMBERS], sensor *out) {
    out->step = 1 / n[0];
    out->offset = -n[1] / n[0];
}

static void make_even(const double n[NUMBERS], sensor *out) {
    out->step = n[0];
    out->offset = n[1];
}

static void make_levels(const double n[NUMBERS], sensor *out) {
    out->levels = n[0];
}

static void make_alone(const double n[NUMBERS], sensor *out) {
    (void)n, (void)out;
}

static const struct way {
    const char *name, *numbers;
    size_t least, most;
    grain_levels levels;
    lattice_maker *make;
} ways[] = {
    {"stereo", ":FOCAL,BASELINE[,PIXELS]", 2, 3, GRAIN_INVERSE, make_stereo},
    {"inverse", ":A[,B]", 1, 2, GRAIN_INVERSE, make_inverse},
    {"even", ":STEP[,FROM]", 1, 2, GRAIN_EVEN, make_even},
    {"inverse-levels", ":N", 1, 1, GRAIN_INVERSE, make_levels},
    {"levels", ":N", 1, 1, GRAIN_EVEN, make_levels},
    {"binary16", "", 0, 0, GRAIN_HALF, make_alone},
    {"fp16", "", 0, 0, GRAIN_HALF, make_alone},
    {"file", "", 0, 0, GRAIN_FINE, make_alone},
};
enum { WAYS = sizeof ways / sizeof ways[0] };

static bool read_numbers(const char *text, const struct way *way, double out[NUMBERS]) {
    size_t count = 0;
    for (size_t i = 0; i < NUMBERS; i++)
        out[i] = (double)NAN;
    for (const char *at = text; at != NULL && count < NUMBERS; count++) {
        const size_t length = strcspn(at, ",");
        if (!number_parse_part(at, length, NUMBER_FINITE, &out[count]) || !(count > 0 || out[0] > 0))
            return false;
        at = at[length] == ',' ? at + length + 1 : NULL;
        if (at != NULL && count + 1 == NUMBERS)
            return false;
    }
    return count >= way->least && count <= way->most;
}

/* Reads behind "@" the step to which levels were rounded before the file was written. @return whether it is right */
static bool read_again(char *text, const char *id, sensor *out) {
    char *const at = strchr(text, '@');
    if (at == NULL)
        return true;
    *at = '\0';
    return option_is(id, "lattice") && number_parse(at + 1, NUMBER_FINITE, &out->again) && out->again >= 0 &&
           out->again <= 1e12;
}

/* Takes the lattice of a data sheet. @return whether there is one of that name */
static bool find_device(const unit_row *unit, const char *text, sensor *out) {
    const name_list devices = {.get = list_device};
    const double again = out->again;
    list_item item;
    if (!names_find(&devices, text, NULL, &item))
        return false;
    *out = device_sensor(item.row);
    const double metres = unit != NULL ? unit->nanometres / 1e9 : 1;
    const double per = out->row->levels == GRAIN_INVERSE ? metres : 1 / metres;
    out->step *= per;
    out->again = again;
    return true;
}

int texture_lattice(const unit_row *unit, const char *id, const char *given, sensor *out) {
    const double none = (double)NAN;
    char room[LATTICE_SIZE], *const text = given != NULL ? room : NULL;
    *out = (sensor){.step = none, .offset = none, .levels = none, .again = none};
    snprintf(room, sizeof room, "%s", given != NULL ? given : "");
    const bool good_again = read_again(room, id, out) && (given == NULL || strlen(given) < sizeof room);
    if (good_again && find_device(unit, room, out))
        return out->row->levels != GRAIN_FINE
                   ? EXIT_FINE
                   : option_error(id, "%s has no lattice that is published; 'depthprec list sensors' has its sheet",
                                  room);
    const size_t length = strcspn(room, ":");
    for (const struct way *way = ways; text != NULL && way < ways + WAYS; way++) {
        double numbers[NUMBERS];
        if (!good_again || strlen(way->name) != length || strncmp(way->name, text, length) != 0)
            continue;
        if (!read_numbers(text[length] == ':' ? text + length + 1 : NULL, way, numbers))
            break;
        way->make(numbers, out);
        const bool good = way->levels == GRAIN_FINE  ? isnan(out->again)
                          : way->make == make_levels ? out->levels >= 2 && out->levels <= 0x1p32
                          : way->make == make_alone  ? true
                                                     : out->step >= 1e-12 && out->step <= 1e12;
        if (!good)
            break;
        for (size_t i = 0; sensor_get(i) != NULL; i++)
            if (sensor_get(i)->levels == way->levels)
                out->row = sensor_get(i);
        return EXIT_FINE;
    }
    char known[320] = "";
    for (size_t i = 0; i < WAYS; i++)
        append(known, sizeof known, "%s%s%s",
               i == 0         ? "a name of 'depthprec list sensors', "
               : i + 1 < WAYS ? ", "
                              : " or ",
               ways[i].name, ways[i].numbers);
    return text == NULL ? EXIT_FINE
                        : option_error(id, "must be %s, of numbers above 0%s, got '%s'", known,
                                       option_is(id, "lattice") ? ", and @STEP behind it" : "", given);
}

void texture_lattice_warn(const texture_request *o, const texture_source *s) {
    const sensor *given = &s->metric.sensor, *seen = &s->metric.seen;
    const double all = s->metric.depths;
    if (o->out.quiet || o->image.lattice == NULL)
        return;
    if (seen->found && (seen->row != given->row || fabs(seen->step - given->step) > 0.01 * given->step))
        message("depthprec: %s: --lattice %s is taken, but the samples lie on another: %s%s%s", s->path,
                o->image.lattice, seen->row->name, isnan(seen->step) ? "" : ", in steps of ",
                isnan(seen->step) ? "" : number_of(seen->step, 6).text);
    else if (given->off_pixels > (1 - SENSOR_SHARE) * all)
        message("depthprec: %s: --lattice %s is taken, but %s of %s pixels are on none of its levels", s->path,
                o->image.lattice, number_of(given->off_pixels, 9).text, number_of(all, 9).text);
}
