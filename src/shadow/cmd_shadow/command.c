/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * shadow: the bias that keeps lit surfaces free of acne, in three ways of which each is enough, and the gap that it
 * opens between a shadow and what casts it: for one map, or for the cascades of a view.
 */
#include <math.h>
#include <stdio.h>

#include "shadow/cmd_shadow/report.h"

/* ---- Lists ------------------------------------------------------------------------------------------------------- */

static size_t api_count(const shadow *s) {
    size_t count = 0;
    while (shadow_asked_api(&s->o, count) != NULL)
        count++;
    return count;
}

static void *next_row(void *of, size_t i) {
    shadow *s = of;
    const size_t apis = api_count(s);
    if (i / apis >= s->maps.count)
        return NULL;
    s->row = shadow_row_of(&s->maps, i / apis, shadow_asked_api(&s->o, i % apis));
    return &s->row;
}

static void *next_whole(void *of, size_t i) {
    shadow *s = of;
    const bias_api *api = shadow_asked_api(&s->o, i);
    if (api == NULL)
        return NULL;
    s->whole = shadow_whole_of(&s->maps, api);
    return &s->whole;
}

static void *next_engine(void *of, size_t i) {
    shadow *s = of;
    const bool is = shadow_engine_row_of(&s->o, &s->maps, i, &s->engine);
    s->missed = s->missed || (is && i == 0 && !s->engine.enough);
    return is ? &s->engine : NULL;
}

static void *next_trial(void *of, size_t i) {
    shadow *s = of;
    if (i == 0 && s->status == EXIT_FINE)
        s->status = shadow_try(&s->o, &s->maps, s->trial, &s->trials);
    return s->status == EXIT_FINE && i < s->trials ? &s->trial[i] : NULL;
}

static void *next_setup(void *of, size_t i) {
    shadow *s = of;
    const shadow_request *o = &s->o;
    if (i == s->setup_count)
        return NULL;
    const dp_format *format = &o->camera.formats[i / o->camera.mapping_count];
    const dp_mapping mapping = o->camera.mappings[i % o->camera.mapping_count];
    shadow_maps_make(o, format, mapping, &s->maps); /* cannot fail: cmd_shadow() has tried */
    s->format = format->name;
    s->mapping = dp_mapping_get(mapping)->name;
    const shadow_light *light = s->maps.whole.kind != SHADOW_SUN ? &s->maps.whole : &s->maps.items[0].light;
    s->lit.lo = s->maps.view.count == 0 ? light->receiver_lo : (double)NAN;
    s->lit.hi = s->maps.view.count == 0 ? light->receiver_hi : (double)NAN;
    return s;
}

static void say_blank(page *p, void *item) {
    (void)item;
    output_char(p->out, '\n');
}

/* ---- Columns ----------------------------------------------------------------------------------------------------- */

enum { ONE_API = 1, ALL_APIS = 2, SPLIT = 4, BOXED = 8, PLACED = 16, ENGINES = 32, DRAWN = 64 };

/* The columns of a way in JSON and CSV, behind the name of the way. */
#define NUMBERS(name, k)                                                                                               \
    {FIELD(shadow_row, way[k].window, name "_bias", "")}, {FIELD(shadow_row, way[k].units, name "_units", "")},        \
        {FIELD(shadow_row, way[k].gap, name "_gap", "scene")},                                                         \
        {FIELD(shadow_row, way[k].gap_normal, name "_gap_normal", "scene")}, {                                         \
        FIELD(shadow_row, way[k].share, name "_share", "")                                                             \
    }
#define FACING(name, k)                                                                                                \
    { FIELD(shadow_row, way[k].gap_facing, name "_gap_facing", "scene") }

static const column cause_columns[] = {{FIELD(shadow_row, cause[SHADOW_CAUSE_TEXEL], "texel", "scene")},
                                       {FIELD(shadow_row, cause[SHADOW_CAUSE_KERNEL], "kernel", "scene")},
                                       {FIELD(shadow_row, cause[SHADOW_CAUSE_LOOKUP], "lookup", "scene")},
                                       {FIELD(shadow_row, cause[SHADOW_CAUSE_SNAPPING], "snapping", "scene")},
                                       {FIELD(shadow_row, cause[SHADOW_CAUSE_SETUP], "set-up", "scene")},
                                       {FIELD(shadow_row, cause[SHADOW_CAUSE_POSITION], "position", "scene")},
                                       {FIELD(shadow_row, cause[SHADOW_CAUSE_RECEIVER], "receiver", "scene")},
                                       {FIELD(shadow_row, cause[SHADOW_CAUSE_FORMAT], "format", "scene")},
                                       {.kind = COLUMN_END}};

static const column row_columns[] = {
    {FIELD(shadow_row, api, "api", "")},
    {FIELD(shadow_row, cascade, "cascade", ""), SHOWN("cascade", 8, 0), .when = SPLIT},
    {FIELD(shadow_row, from, "from", "scene"), .when = SPLIT},
    {FIELD(shadow_row, to, "to", "scene"), .when = SPLIT},
    {FIELD(shadow_row, radius, "radius", "scene"), .when = SPLIT},
    {FIELD(shadow_row, width, "width", "scene"), .when = BOXED},
    {FIELD(shadow_row, height, "height", "scene"), .when = BOXED},
    {FIELD(shadow_row, depth, "depth", "scene"), .when = BOXED},
    {FIELD(shadow_row, z, "z", "scene"), SHOWN("z", 8, DIGITS), .when = PLACED},
    {FIELD(shadow_row, texel, "texel_size", "scene")},
    {FIELD(shadow_row, axis, "axis_bias", ""), .when = PLACED},
    {FIELD(shadow_row, axis_codes, "axis_codes", ""), .when = PLACED},
    NUMBERS("constant", SHADOW_CONSTANT),
    {FIELD(shadow_row, way[SHADOW_SLOPE].factor, "slope_factor", "")},
    NUMBERS("slope", SHADOW_SLOPE),
    FACING("slope", SHADOW_SLOPE),
    {FIELD(shadow_row, way[SHADOW_NORMAL].offset, "normal_offset", "scene")},
    {FIELD(shadow_row, way[SHADOW_NORMAL].texels, "normal_texels", "")},
    NUMBERS("normal", SHADOW_NORMAL),
    FACING("normal", SHADOW_NORMAL),
    {FIELD(shadow_row, limited, "limited", "")},
    {TEXT_FIELD(shadow_row, way[SHADOW_CONSTANT].units_text, "units", 10, 0)},
    {TEXT_FIELD(shadow_row, way[SHADOW_CONSTANT].gap, "gap", 8, DIGITS_GAP), .upward = true, .brief = true},
    {TEXT_FIELD(shadow_row, way[SHADOW_SLOPE].factor_text, "factor", 8, 0)},
    {TEXT_FIELD(shadow_row, way[SHADOW_SLOPE].units_text, "units", 9, 0)},
    {TEXT_FIELD(shadow_row, way[SHADOW_SLOPE].gap, "gap", 8, DIGITS_GAP), .upward = true, .brief = true},
    {TEXT_FIELD(shadow_row, way[SHADOW_NORMAL].texels, "offset", 8, DIGITS), .upward = true, .brief = true},
    {TEXT_FIELD(shadow_row, way[SHADOW_NORMAL].units_text, "units", 9, 0)},
    {TEXT_FIELD(shadow_row, way[SHADOW_NORMAL].gap, "gap", 8, DIGITS_GAP), .upward = true, .brief = true},
    {GROUP("causes", cause_columns)},
    {.kind = COLUMN_END}};

static const column place_columns[] = {{TEXT_FIELD(shadow_row, cascade, "cascade", 8, 0)},
                                       {TEXT_FIELD(shadow_row, from, "from", 11, DIGITS_Z)},
                                       {TEXT_FIELD(shadow_row, to, "to", 11, DIGITS_Z)},
                                       {TEXT_FIELD(shadow_row, texel, "texel", 11, DIGITS)},
                                       {TEXT_FIELD(shadow_row, width, "box", 11, DIGITS)},
                                       {TEXT_FIELD(shadow_row, depth, "depth", 11, DIGITS)},
                                       {.kind = COLUMN_END}};

static const column depth_columns[] = {
    {TEXT_FIELD(shadow_row, z, "z", 11, DIGITS_Z)},
    {TEXT_FIELD(shadow_row, texel, "texel", 11, DIGITS)},
    {TEXT_FIELD(shadow_row, way[SHADOW_CONSTANT].window, "bias", 11, DIGITS), .upward = true},
    {TEXT_FIELD(shadow_row, axis, "on axis", 11, DIGITS)},
    {TEXT_FIELD(shadow_row, axis_codes, "in codes", 11, DIGITS)},
    {.kind = COLUMN_END}};

#define ANSWER(name, k)                                                                                                \
    {FIELD(shadow_whole, way[k].units, name "_units", "")}, {                                                          \
        FIELD(shadow_whole, way[k].call, name "_call", "")                                                             \
    }

static const column whole_columns[] = {
    {FIELD(shadow_whole, api, "api", ""), SHOWN("api", -14, 0)},
    ANSWER("constant", SHADOW_CONSTANT),
    {FIELD(shadow_whole, way[SHADOW_SLOPE].factor, "slope_factor", "")},
    ANSWER("slope", SHADOW_SLOPE),
    {FIELD(shadow_whole, way[SHADOW_NORMAL].texels, "normal_texels", "")},
    ANSWER("normal", SHADOW_NORMAL),
    {TEXT_FIELD(shadow_whole, way[SHADOW_CONSTANT].units_text, "constant U", 12, 0)},
    {TEXT_FIELD(shadow_whole, way[SHADOW_SLOPE].factor_text, "slope F", 10, 0)},
    {TEXT_FIELD(shadow_whole, way[SHADOW_SLOPE].units_text, "with U", 12, 0)},
    {TEXT_FIELD(shadow_whole, way[SHADOW_NORMAL].texels, "offset", 10, DIGITS), .upward = true, .brief = true},
    {TEXT_FIELD(shadow_whole, way[SHADOW_NORMAL].units_text, "with U", 12, 0)},
    {.kind = COLUMN_END}};

static const column setup_report[] = {
    {FIELD(shadow, format, "format", "")},
    {FIELD(shadow, mapping, "mapping", "")},
    {FIELD(shadow, unit, "unit", ""), .only = AS_JSON},
    {FIELD(shadow, lit.lo, "lit_from", "scene"), .only = AS_JSON},
    {FIELD(shadow, lit.hi, "lit_to", "scene"), .only = AS_JSON},
    {LIST("engines", shadow_engine_columns, next_engine), .only = AS_JSON, .when = ENGINES},
    {LIST("drawn", shadow_trial_columns, next_trial), .only = AS_JSON, .when = DRAWN},
    {LIST("answers", whole_columns, next_whole), .only = AS_JSON},
    {LIST(NULL, shadow_engine_columns, next_engine), .only = AS_TEXT, .when = ENGINES, .head = say_blank,
     .notes = shadow_say_engines},
    {LIST(NULL, shadow_trial_columns, next_trial), .only = AS_TEXT, .when = DRAWN, .head = say_blank,
     .notes = shadow_say_trials},
    {LIST(NULL, whole_columns, next_whole), .only = AS_TEXT, .when = ALL_APIS, .notes = shadow_say_calls},
    {LIST(NULL, place_columns, next_row), .only = AS_TEXT, .when = ONE_API | SPLIT, .head = say_blank},
    {LIST(NULL, depth_columns, next_row), .only = AS_TEXT, .when = ONE_API | PLACED, .head = say_blank},
    {LIST("rows", row_columns, next_row), .only = AS_JSON | AS_CSV},
    {LIST(NULL, row_columns, next_row), .only = AS_TEXT, .when = ONE_API, .head = shadow_say_heads,
     .notes = shadow_say_notes},
    {.kind = COLUMN_END}};

static const column size_columns[] = {{FIELD(shadow, o.shadow.size[0], "width", "")},
                                      {FIELD(shadow, o.shadow.size[1], "height", "")},
                                      {.kind = COLUMN_END}};

static const column view_columns[] = {
    {FIELD(shadow_split, znear, "near", "scene")},      {FIELD(shadow_split, zfar, "far", "scene")},
    {FIELD(shadow_split, fov_y, "fov", "degrees")},     {FIELD(shadow_split, aspect, "aspect", "")},
    {FIELD(shadow_split, count, "cascades", "")},       {FIELD(shadow_split, lambda, "lambda", "")},
    {FIELD(shadow_split, casters, "casters", "scene")}, {.kind = COLUMN_END}};

static const column place_light_columns[] = {{FIELD(shadow, place.kind, "kind", "")},
                                             {FIELD(shadow, maps.whole.fov, "fov", "degrees")},
                                             {FIELD(shadow, maps.whole.setup.spec.znear, "near", "scene")},
                                             {FIELD(shadow, maps.whole.setup.spec.zfar, "far", "scene")},
                                             {FIELD(shadow, o.shadow.distance, "distance", "")},
                                             {.kind = COLUMN_END}};

static const column columns[] = {{FIELD(shadow, api_name, "api", ""), .only = AS_JSON},
                                 {GROUP("size", size_columns), .only = AS_JSON},
                                 {FIELD(shadow, o.shadow.kernel, "kernel", "texels"), .only = AS_JSON},
                                 {FIELD(shadow, o.shadow.angle, "angle", "degrees"), .only = AS_JSON},
                                 {FIELD(shadow, o.camera.triangles.subpixel, "subpixel", ""), .only = AS_JSON},
                                 {FIELD(shadow, o.camera.triangles.pixels, "pixels", ""), .only = AS_JSON},
                                 {FIELD(shadow, o.camera.triangles.slim, "slim", ""), .only = AS_JSON},
                                 {FIELD(shadow, arith, "arith", ""), .only = AS_JSON},
                                 {FIELD(shadow, o.shadow.world, "from_origin", "scene"), .only = AS_JSON},
                                 {FIELD(shadow, o.shadow.curvature, "curvature", "scene"), .only = AS_JSON},
                                 {FIELD(shadow, o.shadow.facet, "facet", "scene"), .only = AS_JSON},
                                 {FIELD(shadow, camera_depth, "camera_depth", ""), .only = AS_JSON},
                                 {GROUP("light", place_light_columns), .only = AS_JSON, .when = PLACED},
                                 {PART(shadow, view, "view", view_columns), .only = AS_JSON, .pointed = true},
                                 {LIST("setups", setup_report, next_setup), .head = shadow_say_answer},
                                 {.kind = COLUMN_END}};

/* ---- The command ------------------------------------------------------------------------------------------------- */

int cmd_shadow(void *request) {
    const shadow_request *given = request;
    output out;
    shadow s = {.o = *given,
                .api = given->bias.api,
                .unit = camera_unit(&given->camera),
                .arith = dp_arith_get(given->camera.arith)->name};
    const shadow_request *o = &s.o;
    s.place.kind = o->shadow.point ? "point" : "spot";
    s.api_name = o->shadow.distance ? NULL : s.api != NULL ? s.api->name : option_text(o->line, "api");
    s.camera_depth = option_text(o->line, "camera-depth");
    s.setup_count = o->camera.format_count * o->camera.mapping_count;
    int status = EXIT_FINE;
    for (size_t i = 0; i < s.setup_count && status == EXIT_FINE; i++)
        status = shadow_maps_make(o, &o->camera.formats[i / o->camera.mapping_count],
                                  o->camera.mappings[i % o->camera.mapping_count], &s.maps);
    if (status == EXIT_FINE)
        status = shadow_check_trial(o);
    if (status == EXIT_FINE)
        status = output_start(&o->out, &o->camera, &out);
    if (status != EXIT_FINE)
        return status;
    s.view = s.maps.view.count > 0 ? &s.maps.view : NULL;
    const bool one = s.api != NULL || o->shadow.distance;
    const unsigned when = (one ? ONE_API : ALL_APIS) | (s.view != NULL ? SPLIT : 0) |
                          (s.maps.whole.kind != SHADOW_SUN ? PLACED : BOXED) |
                          (o->shadow.engine != NULL ? ENGINES : 0) | (o->shadow.drawn ? DRAWN : 0);
    report_write(&(report_spec){"shadow", columns, &s, .when = when, .label = 14}, &out, o->out.form);
    status = output_close(&out);
    status = status == EXIT_FINE ? s.status : status;
    if (status != EXIT_FINE || !o->shadow.checked)
        return status;
    for (size_t i = 0; i < s.setup_count && o->out.form == FORM_CSV; i++) { /* which has no engines */
        next_setup(&s, i);
        next_engine(&s, 0);
    }
    return s.missed ? EXIT_FAILED : EXIT_FINE;
}
