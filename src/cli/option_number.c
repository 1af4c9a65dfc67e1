/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/option_number.h"

#include <string.h>

#include "report/number.h"

int parse_near(options *o, const char *value) {
    if (!number_parse(value, NUMBER_FINITE, &o->znear))
        return option_error(OPTION_NEAR, "must be a number from 1e-12 to 1e12, got '%s'", value);
    return EXIT_FINE;
}

int parse_far(options *o, const char *value) {
    if (!number_parse(value, NUMBER_FAR, &o->zfar))
        return option_error(OPTION_FAR, "must be a number greater than near and at most 1e18, or inf, got '%s'", value);
    return EXIT_FINE;
}

int parse_log_c(options *o, const char *value) {
    if (!number_parse(value, NUMBER_FINITE, &o->log_c))
        return option_error(OPTION_LOG_C, "must be a number from 1e-12 to 1e12, got '%s'", value);
    return EXIT_FINE;
}

static int parse_length(option_id id, const char *value, double *out) {
    if (!number_parse(value, NUMBER_FINITE, out) || !(*out > 0.0))
        return option_error(id, "must be a positive number of scene units, got '%s'", value);
    return EXIT_FINE;
}

int parse_separation(options *o, const char *value) {
    return parse_length(OPTION_SEPARATION, value, &o->wanted_separation);
}

int parse_error(options *o, const char *value) {
    return parse_length(OPTION_ERROR, value, &o->wanted_error);
}

/* A share, or a percentage with its sign. */
int parse_tolerance(options *o, const char *value) {
    size_t length = strlen(value);
    bool percent = length > 0 && value[length - 1] == '%';
    double share;
    if (!number_parse_part(value, length - percent, NUMBER_FINITE, &share) || !(share >= 0.0))
        return option_error(OPTION_TOLERANCE, "must be a share such as 0.05, or 5%%, not negative, got '%s'", value);
    o->tolerance = percent ? share / 100.0 : share;
    return EXIT_FINE;
}

int parse_interpolation(options *o, const char *value) {
    double *units = &o->terms.interpolation;
    if (!number_parse(value, NUMBER_FINITE, units) || !(*units >= 0.0 && *units <= 0x1p24))
        return option_error(OPTION_INTERPOLATION, "must be from 0 to 16777216 units of 2^-24, got '%s'", value);
    return EXIT_FINE;
}

int parse_world(options *o, const char *value) {
    double *radius = &o->terms.world;
    if (!number_parse(value, NUMBER_FINITE, radius) || !(*radius >= 0.0 && *radius <= 1e18))
        return option_error(OPTION_WORLD, "must be from 0 to 1e18 scene units, got '%s'", value);
    return EXIT_FINE;
}

int parse_gap(options *o, const char *value) {
    if (!number_parse(value, NUMBER_FINITE, &o->gap) || !(o->gap > 0.0))
        return option_error(OPTION_GAP, "must be a positive number of scene units, got '%s'", value);
    return EXIT_FINE;
}

/* A whole number from least to most. */
static int parse_whole(option_id id, const char *value, unsigned long least, unsigned long most, unsigned long *out) {
    if (!number_parse_count(value, most, out) || *out < least)
        return option_error(id, "must be a whole number from %lu to %lu, got '%s'", least, most, value);
    return EXIT_FINE;
}

int parse_sample(options *o, const char *value) {
    unsigned long count = 0;
    int status = parse_whole(OPTION_SAMPLE, value, 1, 1000000000000ul, &count);
    o->sample = count;
    return status;
}

int parse_seed(options *o, const char *value) {
    unsigned long seed = 0;
    int status = parse_whole(OPTION_SEED, value, 0, 1ul << 53, &seed); /* JSON holds it exactly */
    o->seed = seed;
    return status;
}

int parse_threads(options *o, const char *value) {
    unsigned long threads = 0;
    int status = parse_whole(OPTION_THREADS, value, 1, 1024, &threads);
    o->threads = (int)threads;
    return status;
}

static int parse_pixels(option_id id, const char *value, int *out) {
    unsigned long pixels;
    if (!number_parse_count(value, OPTIONS_PIXELS_MAX, &pixels) || pixels < OPTIONS_PIXELS_MIN)
        return option_error(id, "must be a whole number of pixels from %d to %d, got '%s'", OPTIONS_PIXELS_MIN,
                            OPTIONS_PIXELS_MAX, value);
    *out = (int)pixels;
    return EXIT_FINE;
}

int parse_width(options *o, const char *value) {
    return parse_pixels(OPTION_WIDTH, value, &o->width);
}

int parse_height(options *o, const char *value) {
    return parse_pixels(OPTION_HEIGHT, value, &o->height);
}
