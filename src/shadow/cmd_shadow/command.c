/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * shadow: the bias that keeps lit surfaces free of acne, in three ways of which each is enough, and the gap that it
 * opens between a shadow and what casts it: for one map, or for the cascades of a view.
 */
#include <math.h>
#include <stdio.h>

#include "core/append.h"
#include "report/number.h"
#include "report/report.h"
#include "shadow/cmd_shadow/given.h"
#include "shadow/cmd_shadow/request.h"
#include "shadow/cmd_shadow/rows.h"
#include "shadow/cmd_shadow/trial.h"

enum { DIGITS_GAP = 3, DIGITS = 4, DIGITS_Z = 6 };

typedef struct shadow {
    shadow_request o;    /* with what stands for options that were not given */
    const bias_api *api; /* null for several */
    const char *api_name, *unit, *camera_depth;
    const shadow_split *view; /* null where there is a box */
    size_t setup_count;
    struct {
        double lo, hi; /* of the box: what is lit */
    } lit;
    struct {
        const char *kind;
    } place;
    const char *format, *mapping, *arith;
    shadow_maps maps;
    shadow_row row;
    shadow_whole whole;
    shadow_engine_row engine;
    bool missed; /* in some set-up the first engine's bias is not enough */
    shadow_trial trial[SHADOW_TRIALS];
    size_t trials;
    int status; /* of what was drawn */
} shadow;

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

/* ---- Text -------------------------------------------------------------------------------------------------------- */

static void say_place(page *p, const shadow *s) {
    const shadow_light *l = &s->maps.whole;
    const bool distance = shadow_holds_distance(l);
    shadow_need need;
    shadow_need_of(l, &need);
    page_title(p, "%s light, %s%s degrees, near %s, far %s, texel %s at %s 1",
               l->kind == SHADOW_SPOT ? "spot" : "point", l->kind == SHADOW_SPOT ? "" : "six faces of ",
               number_full(l->fov).text, number_full(l->setup.spec.znear).text, number_full(l->setup.spec.zfar).text,
               number_of(need.per_offset, DIGITS).text, distance ? "distance" : "depth");
    page_title(p, "receivers at %s from %s to %s%s", distance ? "distances" : "depths",
               number_up(l->receiver_lo, DIGITS).text, number_down(l->receiver_hi, DIGITS).text,
               distance ? "; a fragment shader writes (distance - near)/(far - near)" : "");
}

static void say_maps(page *p, void *item) {
    const shadow *s = item;
    const shadow_request *o = &s->o;
    const shadow_split *v = &s->maps.view;
    const dp_triangles *t = &o->camera.triangles;
    p->unit = s->unit;
    page_title(p, "%s %s, %ux%u texels, filter %ux%u, angles up to %s degrees%s%s", s->format, s->mapping,
               o->shadow.size[0], o->shadow.size[1], o->shadow.kernel, o->shadow.kernel,
               number_full(o->shadow.angle).text, p->unit != NULL ? ", in " : "", p->unit != NULL ? p->unit : "");
    if (v->count > 0) {
        page_title(p, "view near %s, far %s, fov %s, %dx%d", number_full(v->znear).text, number_full(v->zfar).text,
                   number_of(v->fov_y, DIGITS).text, t->width, t->height);
        page_title(p, "%d cascade%s, lambda %s, casters up to %s towards the light", v->count, v->count == 1 ? "" : "s",
                   number_full(v->lambda).text, number_full(v->casters).text);
        if (option_given(o->line, "camera-depth"))
            page_title(p, "receivers rebuilt from the camera's depth, %s", option_text(o->line, "camera-depth"));
    } else if (s->maps.whole.kind != SHADOW_SUN) {
        say_place(p, s);
    } else {
        const double texel =
            fmax(o->shadow.light_box[0] / o->shadow.size[0], o->shadow.light_box[1] / o->shadow.size[1]);
        page_title(p, "box %s x %s, %s deep along the light, texel %s", number_full(o->shadow.light_box[0]).text,
                   number_full(o->shadow.light_box[1]).text, number_full(o->shadow.light_box[2]).text,
                   number_of(texel, DIGITS).text);
        if (s->lit.lo > 0.0 || s->lit.hi < o->shadow.light_box[2])
            page_title(p, "receivers from %s to %s along the light%s", number_up(s->lit.lo, DIGITS).text,
                       number_down(s->lit.hi, DIGITS).text,
                       option_given(o->line, "range") ? "" : ": units have no effect at depth 0");
    }
    page_title(p, "%d subpixel bit%s, triangles from 1 to %s texels, aspect ratio at most %s:1, %s", t->subpixel,
               t->subpixel == 1 ? "" : "s", number_full(t->pixels).text, number_full(t->slim).text, s->arith);
    if (option_given(o->line, "curvature"))
        page_title(p, "receivers curve away with a radius of at least %s, triangles of circumradius %s",
                   number_full(o->shadow.curvature).text, number_full(o->shadow.facet).text);
}

static bool writes_distance(const shadow *s) {
    return s->o.shadow.distance;
}

/* One API: what to write. All: what follows is a table of them. */
static void say_answer(page *p, void *item) {
    const shadow *s = item;
    const char *where = s->maps.view.count > 1 ? " in any cascade" : "";
    say_maps(p, item);
    shadow_say_given(p, &s->o, &s->maps);
    if (s->api == NULL && !writes_distance(s)) {
        page_text(p, "No acne%s with the constant U, with F and its U, or with the offset and its U:", where);
        return;
    }
    const shadow_whole w = shadow_whole_of(&s->maps, shadow_asked_api(&s->o, 0));
    page_text(p, "No acne%s with any one of these:", where);
    for (int k = 0; k < SHADOW_WAY_COUNT; k++)
        page_note(p, shadow_way_name((shadow_way)k), "%s",
                  !isnan(w.way[k].units)   ? w.way[k].call
                  : writes_distance(s)     ? "no API biases a depth that a fragment shader writes"
                  : isnan(w.way[k].factor) ? "no bias suffices: the smallest triangles may lose half of their slope"
                                           : "no bias suffices");
}

static void say_blank(page *p, void *item) {
    (void)item;
    output_char(p->out, '\n');
}

static void say_heads(page *p, void *item) {
    const shadow *s = item;
    const int split = s->maps.view.count > 0 || s->maps.whole.kind != SHADOW_SUN ? 8 : 0;
    output_char(p->out, '\n');
    if (p->fitted && p->width < 68 + split) {
        page_text(p, "constant bias: units, gap; slope-scaled: factor, units, gap; normal offset: offset, units, gap");
        return;
    }
    output_format(p->out, "%s%*s%18s%25s%25s%s\n", p->soft, split, "", "constant bias", "slope-scaled", "normal offset",
                  p->plain);
}

/* The largest cause in words, and how to make it smaller. */
static const char *why(const double cause[SHADOW_CAUSE_COUNT]) {
    static const char filter[] =
        "steep receivers within the filter: smaller texels, a smaller kernel or angle need less";
    static const char position[] = "positions in binary32: a box that is less deep, nearer the origin, needs less";
    static const char *const words[SHADOW_CAUSE_COUNT] = {
        [SHADOW_CAUSE_TEXEL] = filter,
        [SHADOW_CAUSE_KERNEL] = filter,
        [SHADOW_CAUSE_LOOKUP] = "texture coordinates are rounded: a map of fewer texels needs less",
        [SHADOW_CAUSE_SNAPPING] = "vertices move to the subpixel grid: more --subpixel bits need less",
        [SHADOW_CAUSE_SETUP] = "planes of thin triangles in binary32: a --triangle-class of stouter ones needs less",
        [SHADOW_CAUSE_POSITION] = position,
        [SHADOW_CAUSE_RECEIVER] = "receivers come from the camera's depth: a finer format or a nearer far needs less",
        [SHADOW_CAUSE_FORMAT] = "codes of the format: more bits, or a box that is less deep, need less"};
    double of[SHADOW_CAUSE_COUNT];
    size_t most = 0;
    for (size_t k = 0; k < SHADOW_CAUSE_COUNT; k++) /* the filter's radius is one thing */
        of[k] = k == SHADOW_CAUSE_TEXEL ? cause[k] + cause[SHADOW_CAUSE_KERNEL] : cause[k];
    for (size_t k = 1; k < SHADOW_CAUSE_COUNT; k++)
        most = of[k] > of[most] ? k : most;
    return words[most];
}

/* Says the causes in the map where the least share of the constant bias is needed by any reckoning. */
static void say_causes(page *p, const shadow *s) {
    char text[256] = "";
    shadow_row least = shadow_row_of(&s->maps, 0, shadow_asked_api(&s->o, 0));
    for (size_t i = 1; i < s->maps.count; i++) {
        const shadow_row r = shadow_row_of(&s->maps, i, shadow_asked_api(&s->o, 0));
        if (r.way[SHADOW_CONSTANT].share < least.way[SHADOW_CONSTANT].share)
            least = r;
    }
    double sum = 0.0;
    for (int k = 0; k < SHADOW_CAUSE_COUNT; k++)
        sum += least.cause[k];
    for (int k = 0; k < SHADOW_CAUSE_COUNT; k++)
        if (least.cause[k] >= 0.0005 * sum)
            append(text, sizeof text, "%s%s %s %%", text[0] != '\0' ? ", " : "", shadow_cause_name((shadow_cause)k),
                   number_of(100.0 * least.cause[k] / sum, 3).text);
    page_note(p, "why", "%s", why(least.cause));
    if (s->maps.view.count > 1)
        page_note(p, "causes", "cascade %d: %s", least.cascade, text);
    else if (s->maps.whole.kind != SHADOW_SUN)
        page_note(p, "causes", "at %s: %s", number_of(least.z, DIGITS_Z).text, text);
    else
        page_note(p, "causes", "%s", text);
}

/* How much wider than needed the constant bias is where a unit is worth most. */
static double worth(const shadow *s) {
    double most = 1.0;
    for (size_t i = 0; i < s->maps.count; i++) {
        const shadow_row r = shadow_row_of(&s->maps, i, s->api);
        most = fmax(most, r.way[SHADOW_CONSTANT].gap / (r.way[SHADOW_CONSTANT].window * r.depth));
    }
    return most;
}

static number_text percent_text(double share) {
    number_text out = number_down(100.0 * share, 2);
    if (!isnan(share))
        append(out.text, sizeof out.text, " %%");
    return out;
}

static const char *offset_words(const shadow *s) {
    return s->maps.whole.kind == SHADOW_SUN ? "in texels, times the sine of the angle, along the surface normal"
           : writes_distance(s)
               ? "in texels at the point's distance, times the sine of the angle, along the surface normal"
               : "in texels at the point's depth, at any angle, along the surface normal";
}

/* A light that has a place. */
static void say_of_place(page *p, const shadow *s, const shadow_whole *w) {
    const double angle = s->o.shadow.angle;
    page_note(p, "on axis", "of a plane at %s degrees there, steepest along a row of texels, by the filter alone",
              number_full(angle).text);
    page_note(p, "rows", "units that are needed at that %s; the gap there of those that are enough at all",
              writes_distance(s) ? "distance" : "depth");
    if (s->o.shadow.point && s->o.shadow.kernel > 1)
        page_note(p, "seam", "%s",
                  writes_distance(s)
                      ? "distances are the same in both faces: nothing more is needed"
                      : "constant and offset cover lookups across the edges of faces; slope-scaled bias only "
                        "those that stay in a face, as the next one slopes otherwise");
    if (w->hidden)
        page_note(p, "far plane", "a bias reaches to it: nothing there is in shadow");
    else if (w->limited)
        page_note(p, "far plane", "a gap reaches beyond it: casters there cast no shadow");
}

static void say_engines(page *p, void *item) {
    shadow *s = item;
    shadow_engine_row r;
    page_note(p, "least", "bias that is enough beside that normal bias, and the other way round; -: none is");
    for (size_t i = 0; shadow_engine_row_of(&s->o, &s->maps, i, &r); i++)
        if (r.unconfirmed != NULL)
            page_note(p, r.engine, "not confirmed: %s", r.unconfirmed);
}

static void say_notes(page *p, void *item) {
    const shadow *s = item;
    const bool place = s->maps.whole.kind != SHADOW_SUN;
    const shadow_whole w = shadow_whole_of(&s->maps, shadow_asked_api(&s->o, 0));
    const bool real = s->maps.items[0].light.setup.spec.format.kind == DP_FORMAT_FLOAT;
    const double wide = place ? 1.0 : worth(s);
    page_note(p, "gap", "largest from a caster to its shadow, along the light; %s, %s and %s facing it",
              number_up(w.way[0].gap_facing, DIGITS_GAP).text, number_up(w.way[1].gap_facing, DIGITS_GAP).text,
              number_up(w.way[2].gap_facing, DIGITS_GAP).text);
    page_note(p, "offset", "%s", offset_words(s));
    say_causes(p, s);
    page_note(p, "needed", "%s, %s and %s of these by slope times filter radius alone",
              percent_text(w.way[0].share).text, percent_text(w.way[1].share).text, percent_text(w.way[2].share).text);
    if (isnan(w.way[SHADOW_CONSTANT].units) && w.way[SHADOW_CONSTANT].window < 1.0 && real)
        page_note(p, "units", "have no effect at window depth 0 of a float format: %s",
                  s->view != NULL ? "--casters keeps surfaces away from it" : "--range LO:HI says where receivers lie");
    if (wide > 1.5)
        page_note(p, "units", "%s: the gap is up to %s times what is needed",
                  real ? "grow with the depth in a float format" : "may be larger than assumed",
                  number_up(wide, 2).text);
    if (place)
        say_of_place(p, s, &w);
    else if (w.hidden)
        page_note(p, "far plane", "a bias is as large as the box is deep: nothing is in shadow");
    else if (option_given(s->o.line, "range") && w.limited)
        page_note(p, "far plane", "a gap reaches beyond it: casters there cast no shadow");
}

static void say_trials(page *p, void *item) {
    const shadow *s = item;
    if (s->trials > 0)
        shadow_say_trial(p, s->trial);
}

static void say_calls(page *p, void *item) {
    const shadow *s = item;
    page_line(p, "offset: %s", offset_words(s));
    output_char(p->out, '\n');
    const bias_api *api;
    for (size_t i = 0; (api = bias_asked_api(&s->o.bias, i)) != NULL; i++)
        page_note(p, api->name, "%s%s", api->call, api->sloped);
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
     .notes = say_engines},
    {LIST(NULL, shadow_trial_columns, next_trial), .only = AS_TEXT, .when = DRAWN, .head = say_blank,
     .notes = say_trials},
    {LIST(NULL, whole_columns, next_whole), .only = AS_TEXT, .when = ALL_APIS, .notes = say_calls},
    {LIST(NULL, place_columns, next_row), .only = AS_TEXT, .when = ONE_API | SPLIT, .head = say_blank},
    {LIST(NULL, depth_columns, next_row), .only = AS_TEXT, .when = ONE_API | PLACED, .head = say_blank},
    {LIST("rows", row_columns, next_row), .only = AS_JSON | AS_CSV},
    {LIST(NULL, row_columns, next_row), .only = AS_TEXT, .when = ONE_API, .head = say_heads, .notes = say_notes},
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
                                 {LIST("setups", setup_report, next_setup), .head = say_answer},
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
