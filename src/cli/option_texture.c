/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/option_texture.h"

#include <string.h>

#include "report/number.h"
#include "texture/metric.h"

static int parse_within(option_id id, const char *value, double lo, double hi, const char *allowed, double *out) {
    double number;
    if (!number_parse(value, NUMBER_FINITE, &number) || !(number >= lo && number <= hi))
        return option_error(id, "must be %s, got '%s'", allowed, value);
    *out = number;
    return EXIT_FINE;
}

int parse_fov(options *o, const char *value) {
    return parse_within(OPTION_FOV, value, 0.01, 179, "from 0.01 to 179 degrees", &o->camera.fov_y);
}

int parse_half_height(options *o, const char *value) {
    return parse_within(OPTION_HALF_HEIGHT, value, 1e-12, 1e12, "from 1e-12 to 1e12 scene units",
                        &o->camera.half_height);
}

int parse_yaw(options *o, const char *value) {
    return parse_within(OPTION_YAW, value, -360, 360, "from -360 to 360 degrees", &o->camera.yaw);
}

int parse_pitch(options *o, const char *value) {
    return parse_within(OPTION_PITCH, value, -90, 90, "from -90 to 90 degrees", &o->camera.pitch);
}

int parse_sky(options *o, const char *value) {
    return parse_within(OPTION_SKY, value, 0, 0.5, "a window depth from 0 to 0.5", &o->sky);
}

int parse_metric(options *o, const char *value) {
    return parse_within(OPTION_METRIC, value, METRIC_SCALE_MIN, METRIC_SCALE_MAX, "from 1e-9 to 1e6 scene units",
                        &o->metric);
}

int parse_origin(options *o, const char *value) {
    const char *at = value;
    for (int i = 0; i < 3; i++) {
        const size_t length = strcspn(at, ",");
        double *x = &o->camera.origin[i];
        if (!number_parse_part(at, length, NUMBER_FINITE, x) || !(*x >= -1e12 && *x <= 1e12) ||
            (at[length] == '\0') != (i == 2))
            return option_error(OPTION_ORIGIN, "must be X,Y,Z, each from -1e12 to 1e12, got '%s'", value);
        at += length + 1;
    }
    return EXIT_FINE;
}

int parse_size(options *o, const char *value) {
    const char *x = strchr(value, 'x');
    char width[16];
    unsigned long w, h;
    if (x == NULL || (size_t)(x - value) >= sizeof width)
        return option_error(OPTION_SIZE, "must be WIDTHxHEIGHT in pixels, such as 640x360, got '%s'", value);
    memcpy(width, value, (size_t)(x - value));
    width[x - value] = '\0';
    if (!number_parse_count(width, TEXTURE_SIDE_MAX, &w) || !number_parse_count(x + 1, TEXTURE_SIDE_MAX, &h) || w < 1 ||
        h < 1)
        return option_error(OPTION_SIZE, "must be WIDTHxHEIGHT, each from 1 to %u pixels, got '%s'", TEXTURE_SIDE_MAX,
                            value);
    if ((uint64_t)w * h > TEXTURE_PIXELS_MAX)
        return option_error(OPTION_SIZE, "must be at most %u pixels in all, got '%s'", (unsigned)TEXTURE_PIXELS_MAX,
                            value);
    o->camera.width = (uint32_t)w;
    o->camera.height = (uint32_t)h;
    return EXIT_FINE;
}

/* The last of a name counts, as with every option. */
int parse_parameter(options *o, const char *value) {
    const size_t length = strcspn(value, "=");
    named_number given = {{0}, 0};
    if (value[length] == '\0' || length == 0 || length >= sizeof given.name ||
        !number_parse(value + length + 1, NUMBER_FINITE, &given.value))
        return option_error(OPTION_PARAMETER, "must be NAME=NUMBER, got '%s'", value);
    memcpy(given.name, value, length);
    size_t i = 0;
    while (i < o->parameter_count && strcmp(o->parameters[i].name, given.name) != 0)
        i++;
    if (i == OPTIONS_PARAMETERS_MAX)
        return option_error(OPTION_PARAMETER, "must not be more than %d, got '%s' too", OPTIONS_PARAMETERS_MAX, value);
    o->parameters[i] = given;
    o->parameter_count += i == o->parameter_count;
    return EXIT_FINE;
}

int parse_scene(options *o, const char *value) {
    o->scene = value;
    return EXIT_FINE;
}

int parse_eye(options *o, const char *value) {
    (void)value;
    o->eye = true;
    return EXIT_FINE;
}

int parse_radial(options *o, const char *value) {
    (void)value;
    o->radial = true;
    return EXIT_FINE;
}

int parse_position(options *o, const char *value) {
    o->position = value;
    return EXIT_FINE;
}

int parse_normal(options *o, const char *value) {
    o->normal = value;
    return EXIT_FINE;
}

int parse_effect(options *o, const char *value) {
    o->effect = value;
    return EXIT_FINE;
}

int parse_error_map(options *o, const char *value) {
    (void)value;
    o->error_map = true;
    return EXIT_FINE;
}

int parse_figure(options *o, const char *value) {
    if (*value == '\0')
        return option_error(OPTION_FIGURE, "must be a file name, got ''");
    o->figure = value;
    return EXIT_FINE;
}
