/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Options of slanted triangles. */
#include <string.h>

#include "cli/option/rows.h"
#include "report/number.h"

enum { VIEWPORT_MAX = 32768 };

int parse_viewport(options *o, const option_row *row, const char *value) {
    uint64_t sides[2];
    const int status = option_read_sides(row, value, VIEWPORT_MAX, false, sides);
    if (status != EXIT_FINE)
        return status;
    o->camera.triangles.width = (int)sides[0];
    o->camera.triangles.height = (int)sides[1];
    return EXIT_FINE;
}

int parse_slant(options *o, const option_row *row, const char *value) {
    const size_t split = strcspn(value, ":");
    double lo, hi;
    if (value[split] == '\0' || !number_parse_part(value, split, NUMBER_FINITE, &lo) ||
        !number_parse(value + split + 1, NUMBER_FINITE, &hi) || !(lo >= 0.0 && lo <= hi && hi <= 90.0))
        return option_refuse(row, "must be LO:HI, from 0 to 90 degrees, got '%s'", value);
    o->camera.triangles.slant_lo = lo;
    o->camera.triangles.slant_hi = hi;
    return EXIT_FINE;
}

/* A range, or one plane. */
int parse_slant_or_plane(options *o, const option_row *row, const char *value) {
    const size_t split = strcspn(value, ",");
    double slant, azimuth;
    if (value[split] == '\0')
        return parse_slant(o, row, value);
    if (!number_parse_part(value, split, NUMBER_FINITE, &slant) ||
        !number_parse(value + split + 1, NUMBER_FINITE, &azimuth) || !(slant >= 0.0 && slant <= 90.0) ||
        !(azimuth >= -360.0 && azimuth <= 360.0))
        return option_refuse(row, "must be SLANT,AZIMUTH, from 0 to 90 and from -360 to 360 degrees, got '%s'", value);
    o->camera.triangles.slant_lo = o->camera.triangles.slant_hi = slant;
    o->camera.azimuth = azimuth;
    return EXIT_FINE;
}

static const struct {
    const char *name;
    size_t place;
} class_rows[] = {{"depth", offsetof(dp_triangles, depth)},
                  {"pixels", offsetof(dp_triangles, pixels)},
                  {"slim", offsetof(dp_triangles, slim)}};

enum { CLASS_ROWS = sizeof class_rows / sizeof class_rows[0] };

/* One NAME=NUMBER, of `length`, in the range that the library gives it, of a name that is not yet among `seen`. */
static bool read_class(dp_triangles *t, const char *text, size_t length, bool seen[CLASS_ROWS]) {
    for (size_t i = 0; i < CLASS_ROWS; i++) {
        const size_t name = strlen(class_rows[i].name);
        double number;
        if (length <= name || strncmp(text, class_rows[i].name, name) != 0 || text[name] != '=')
            continue;
        if (seen[i] || !number_parse_part(text + name + 1, length - name - 1, NUMBER_FINITE, &number))
            return false;
        seen[i] = true;
        memcpy((char *)t + class_rows[i].place, &number, sizeof number);
        return dp_triangles_check(t) == DP_OK;
    }
    return false;
}

int parse_triangle(options *o, const option_row *row, const char *value) {
    bool seen[CLASS_ROWS] = {false};
    for (const char *at = value;; at++) {
        const size_t length = strcspn(at, ",");
        if (!read_class(&o->camera.triangles, at, length, seen))
            return option_refuse(row,
                                 "must be depth=K from 1 to 1e6, pixels=P from 1 to 65536 and slim=Q from 2 to 1024, "
                                 "each at most once, separated by commas, got '%s'",
                                 value);
        at += length;
        if (*at == '\0')
            return EXIT_FINE;
    }
}
