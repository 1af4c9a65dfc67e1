/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The door for a depth image that a person drops on the page. It is opened by the words of `texture`, with that
 * command's own reading; what is said of it, of a pixel and of each pixel's error comes from here. image.js is the
 * other side.
 */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "camera/cmd/setups.h"
#include "core/append.h"
#include "core/elementary.h"
#include "report/number.h"
#include "texture/cmd_texture/texture.h"
#include "texture/image_depths.h"
#include "texture/units.h"
#include "web/page.h"

enum { DIGITS = 4, TEXT_SIZE = 1536, NONE = 0, HOLE_COLOUR = 0 };

static asked_line line;
static texture_source source;
static const char *unit; /* null where nothing says what a scene unit is */

/* The sum over all pixels. */
static struct {
    uint64_t holes, sky, seen;
    double lo, hi; /* eye depths */
} all;

static uint32_t code_at(uint32_t x, uint32_t y) {
    uint32_t code;
    image_codes(&source.picture, &source.setup.spec.format, y, x, 1, &code);
    return code;
}

/* As the command counts it: window depth within a share of the far plane's, cleared or far away. */
static bool is_sky(const texture_request *o, uint32_t code) {
    const double depth = dp_format_value(&source.setup.spec.format, code);
    return o->image.metric == 0 && fabs(depth - (source.setup.reversed ? 0.0 : 1.0)) <= o->image.sky;
}

static bool count_all(const texture_request *o) {
    const uint32_t width = source.picture.width;
    const bool codes_alone = source.setup.spec.format.kind == DP_FORMAT_UNORM;
    uint32_t *codes = malloc(width * sizeof *codes), least = UINT32_MAX, most = 0;
    for (uint32_t y = 0; codes != NULL && y < source.picture.height; y++) {
        image_codes(&source.picture, &source.setup.spec.format, y, 0, width, codes);
        for (uint32_t x = 0; x < width; x++) {
            const uint32_t code = codes[x];
            const bool within = codes_alone && code >= least && code <= most; /* sky lies at one end */
            const bool hole = code == UINT32_MAX, sky = !hole && !within && is_sky(o, code);
            all.holes += hole;
            all.sky += sky;
            if (hole || sky)
                continue;
            all.seen++;
            least = code < least ? code : least;
            most = code > most ? code : most;
        }
    }
    const double a = all.seen > 0 ? dp_stored(&source.setup, least) : 0,
                 b = all.seen > 0 ? dp_stored(&source.setup, most) : 0;
    all.lo = fmin(a, b);
    all.hi = fmax(a, b);
    free(codes);
    return codes != NULL;
}

/* ---- What is said ------------------------------------------------------------------------------------------------ */

static number_text length(double z) {
    return number_in(number_of(z, DIGITS), unit);
}

static void say_scale(const texture_request *o, char out[TEXT_SIZE]) {
    const bool assumed = source.metric_from == ORIGIN_ASSUMED;
    if (o->image.stereo.focal > 0)
        append(out, TEXT_SIZE, "Disparities, from which depths are made. ");
    else
        append(out, TEXT_SIZE, "Lengths: 1 in a sample is %s%s. ", length(o->image.metric).text,
               assumed ? ", which is assumed" : "");
}

static void say_levels(char out[TEXT_SIZE]) {
    const sensor *s = &source.metric.sensor;
    const double gap = all.seen > 0 && s->row != NULL ? sensor_gap(s, all.hi) : (double)NAN;
    if (s->row != NULL && (s->found || s->given) && isfinite(gap))
        append(out, TEXT_SIZE, "They lie on levels%s, %s apart at %s. ",
               s->row->levels == GRAIN_INVERSE ? " that are even in 1/z, as a sensor's are"
               : s->row->levels == GRAIN_EVEN  ? " that are even"
                                               : "",
               length(gap).text, length(all.hi).text);
}

static void say_depths(char out[TEXT_SIZE]) {
    const unsigned long long holes = all.holes, sky = all.sky, seen = all.seen;
    if (holes > 0)
        append(out, TEXT_SIZE, "%llu pixels are holes. ", holes);
    if (sky > 0)
        append(out, TEXT_SIZE, "%llu pixels are sky, or were cleared. ", sky);
    if (seen == 0)
        append(out, TEXT_SIZE, "No pixel holds a depth.");
    else if (all.lo == all.hi)
        append(out, TEXT_SIZE, "All others hold one depth, %s: nothing shows what it is.", length(all.lo).text);
    else
        append(out, TEXT_SIZE, "Depths from %s to %s.", length(all.lo).text, length(all.hi).text);
}

static void print_string(const char *name, const char *text) {
    printf("\"%s\": \"", name);
    for (; *text != '\0'; text++)
        printf("%s%c", *text == '"' || *text == '\\' ? "\\" : "", *text);
    printf("\", ");
}

/* Units in which whole numbers would be the depths of a camera that is known, where nobody has said what they are. */
static size_t print_units(const texture_request *o) {
    unit_reading readings[UNITS_MAX];
    const bool open = o->image.metric == 0 && o->image.packing == NULL && texture_may_be_metric(&source);
    const size_t count = open ? units_find(&source.picture, readings) : 0;
    printf("\"units\": [");
    for (size_t i = 0; i < count; i++)
        printf("%s{\"option\": \"%s\", \"text\": \"%s to %s m\"}", i > 0 ? ", " : "", readings[i].option,
               number_of(readings[i].lo, 3).text, number_of(readings[i].hi, 3).text);
    printf("], ");
    return count;
}

static void print_facts(const texture_request *o) {
    char text[TEXT_SIZE] = "";
    const dp_spec *spec = &source.setup.spec;
    const bool window = texture_is_window(o);
    printf("{\"width\": %u, \"height\": %u, \"window\": %s, \"direction\": %s, \"reversed\": %s, ",
           source.picture.width, source.picture.height, window ? "true" : "false",
           source.found.reversed >= 0 ? "true" : "false", source.found.reversed > 0 ? "true" : "false");
    print_string("format", spec->format.name);
    const bool asks = print_units(o) > 0;
    if (asks)
        append(text, TEXT_SIZE, "%samples may be lengths: what are they?",
               all.lo == all.hi ? "All its samples are the same: nothing shows what they are. Such s" : "Its s");
    else if (o->image.metric > 0) {
        say_scale(o, text);
        say_levels(text);
    } else {
        append(text, TEXT_SIZE, "%s: %s. ", window ? "Window depth" : "Eye depth over far", source.why);
    }
    if (!asks)
        say_depths(text);
    print_string("says", text);
    printf("\"differ\": %s, \"seen\": %s}\n", all.lo < all.hi ? "true" : "false", all.seen > 0 ? "true" : "false");
}

/** Opens the file that was dropped by the words of a `texture` line. @return its exit status; EXIT_FINE: stdout says
 * what is known of it, as JSON */
PAGE_EXPORT("image_open") int image_open(int n) {
    char **words;
    const int argc = page_words(n, &words);
    int status = argc > 0 ? options_parse(&line, argc, words) : usage_error("too many words");
    if (status == EXIT_FINE)
        status = texture_source_open(line.request, &source);
    if (status == EXIT_FINE) {
        const texture_request *o = line.request;
        unit = camera_unit(&o->camera);
        status = count_all(o) ? EXIT_FINE : usage_error("texture: no memory");
    }
    if (status == EXIT_FINE)
        print_facts(line.request);
    fflush(NULL);
    return status;
}

/** Says what a pixel holds, and how far off it may be. */
PAGE_EXPORT("image_pixel") void image_pixel(unsigned x, unsigned y) {
    const uint32_t code = code_at(x, y);
    const dp_setup *setup = &source.setup;
    printf("Pixel %u,%u", x, y);
    if (code == UINT32_MAX)
        printf(" is a hole.");
    else {
        const grain_range range = grain_range_of(setup, &source.grain, code);
        const double z = dp_stored(setup, code), interval = range.hi - range.lo;
        const int digits = number_digits_within(z, interval, DIGITS, 15);
        printf(is_sky(line.request, code) ? " is sky, or was cleared: code %u, from %s on."
                                          : ": code %u, eye depth %s, which may be %s to %s: off by at most %s.",
               code, number_in(number_of(z, digits), unit).text, number_in(number_down(range.lo, digits), unit).text,
               number_in(number_up(range.hi, digits), unit).text, number_in(number_up(range.reach, DIGITS), unit).text);
    }
    fflush(NULL);
}

/* ---- The picture ------------------------------------------------------------------------------------------------- */

/* The number that is drawn of each pixel: its depth, or how far that may be off; NaN of none. */
static double drawn_of(const texture_request *o, uint32_t x, uint32_t y, bool error) {
    const uint32_t code = code_at(x, y);
    if (code == UINT32_MAX || is_sky(o, code))
        return (double)NAN;
    return error ? grain_range_of(&source.setup, &source.grain, code).reach : dp_stored(&source.setup, code);
}

/** Paints the image in so many pixels, grey by the logarithm of depth, or of error, and says which are black and white.
 * @return red, green, blue and alpha of each; null when out of memory */
PAGE_EXPORT("image_paint") uint32_t *image_paint(unsigned width, unsigned height, int error) {
    const size_t count = (size_t)width * height;
    uint32_t *pixels = malloc(count * sizeof *pixels);
    double *values = malloc(count * sizeof *values), lo = (double)INFINITY, hi = 0;
    for (size_t i = 0; pixels != NULL && values != NULL && i < count; i++) {
        const uint64_t x = (2 * (i % width) + 1) * source.picture.width / (2 * width);
        const uint64_t y = (2 * (i / width) + 1) * source.picture.height / (2 * height);
        const double v = values[i] = drawn_of(line.request, (uint32_t)x, (uint32_t)y, error != 0);
        lo = v > 0 && v < lo ? v : lo;
        hi = isfinite(v) && v > hi ? v : hi;
    }
    const double all_of = hi > lo ? dp_log(hi / lo) : 1;
    for (size_t i = 0; pixels != NULL && values != NULL && i < count; i++) {
        const double v = values[i], share = v > lo ? fmin(isfinite(v) ? dp_log(v / lo) / all_of : 1, 1) : 0;
        pixels[i] = isnan(v) ? HOLE_COLOUR : 0xff000000 | (uint32_t)(255 * share) * 0x10101;
    }
    if (hi > 0)
        printf("Black: %s%s, white: %s.", length(lo).text, error != 0 ? " off at most" : "", length(hi).text);
    fflush(NULL);
    free(values);
    return pixels;
}
