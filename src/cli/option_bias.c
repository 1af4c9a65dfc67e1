/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/option_bias.h"

#include <math.h>

#include "cli/suggest.h"
#include "report/number.h"

static int unknown_preset(const char *name) {
    suggestion s = suggest_start(name);
    char text[SUGGEST_TEXT_SIZE];
    for (size_t i = 0; preset_get(i) != NULL; i++)
        suggest_offer(&s, preset_get(i)->name);
    return option_error(OPTION_PRESET, "must be a name from 'depthprec list presets', got '%s'%s", name,
                        suggest_text(&s, "", text));
}

int parse_preset(options *o, const char *value) {
    o->preset = preset_find(value);
    return o->preset != NULL ? EXIT_FINE : unknown_preset(value);
}

static int unknown_api(const char *name) {
    suggestion s = suggest_start(name);
    char text[SUGGEST_TEXT_SIZE];
    for (size_t i = 0; bias_api_get(i) != NULL; i++) {
        suggest_offer(&s, bias_api_get(i)->name);
        suggest_offer(&s, bias_api_get(i)->aliases);
    }
    return option_error(OPTION_API, "must be a name from 'depthprec list apis', got '%s'%s", name,
                        suggest_text(&s, "", text));
}

int parse_api(options *o, const char *value) {
    o->api = bias_api_find(value);
    return o->api != NULL ? EXIT_FINE : unknown_api(value);
}

/* Bias states are binary32 numbers or integers in every API. */
static int parse_state(option_id id, const char *value, double *out) {
    if (!number_parse(value, NUMBER_FINITE, out) || fabs(*out) > 1e12)
        return option_error(id, "must be a number from -1e12 to 1e12, got '%s'", value);
    return EXIT_FINE;
}

int parse_units(options *o, const char *value) {
    return parse_state(OPTION_UNITS, value, &o->units);
}

int parse_factor(options *o, const char *value) {
    return parse_state(OPTION_FACTOR, value, &o->factor);
}

int parse_clamp(options *o, const char *value) {
    return parse_state(OPTION_CLAMP, value, &o->clamp);
}

int parse_slope(options *o, const char *value) {
    if (!number_parse(value, NUMBER_FINITE, &o->slope) || !(o->slope >= 0.0 && o->slope <= 1e12))
        return option_error(OPTION_SLOPE, "must be from 0 to 1e12 scene units per pixel, got '%s'", value);
    return EXIT_FINE;
}
