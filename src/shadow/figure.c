/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Shadow maps: a panel for each, in it the gap that each of the three biases opens on surfaces at each angle to the
 * light, and what the causes of acne take there; of a light that has a place where receivers are nearest. With an
 * engine its bias stands beside what is needed: where it is less there may be acne. All are lengths along the light.
 * Another shows the same of the greatest angle against the distance.
 */
#include <math.h>
#include <stdio.h>

#include "core/append.h"
#include "core/elementary.h"
#include "draw/theme.h"
#include "draw/ticks.h"
#include "plot/figure.h"
#include "shadow/engine.h"
#include "shadow/ground.h"

enum { POINTS = 181 };

/* A map, and what it needs. */
typedef struct mapped {
    const shadow_light *light;
    shadow_need need;
    shadow_bias added[SHADOW_WAY_COUNT]; /* as the engine's API adds them */
    double depth;                        /* scene units that are all of window depth there */
    const figure_request *request;
} mapped;

static mapped mapped_of(const figure_request *request, const shadow_light *light) {
    mapped m = {.light = light, .request = request};
    shadow_need_of(light, &m.need);
    for (int k = 0; k < SHADOW_WAY_COUNT; k++)
        m.added[k] = request->api != NULL ? shadow_as_added(light, &m.need.bias[k], request->api) : m.need.bias[k];
    m.depth = shadow_ground_at(light, light->receiver_lo).depth;
    return m;
}

static double angle_at(const mapped *m, int i) {
    return m->light->triangles.slant_hi * i / (POINTS - 1);
}

/* Causes that are near to each other share a line. */
static const struct {
    const char *name;
    unsigned causes; /* bits */
} groups[] = {
    {"texel, kernel, lookup", 1u << SHADOW_CAUSE_TEXEL | 1u << SHADOW_CAUSE_KERNEL | 1u << SHADOW_CAUSE_LOOKUP},
    {"snapping, set-up", 1u << SHADOW_CAUSE_SNAPPING | 1u << SHADOW_CAUSE_SETUP},
    {"position", 1u << SHADOW_CAUSE_POSITION | 1u << SHADOW_CAUSE_RECEIVER},
    {"format", 1u << SHADOW_CAUSE_FORMAT},
};

enum { GROUPS = sizeof groups / sizeof groups[0] };

static double group_at(const mapped *m, int group, double angle) {
    double sum = 0.0;
    for (int k = 0; k < SHADOW_CAUSE_COUNT; k++)
        if ((groups[group].causes >> k & 1) != 0)
            sum += shadow_part_at(m->light, &m->need.part[k], angle) * m->depth;
    return sum;
}

static shadow_given gives(const mapped *m) {
    const figure_request *r = m->request;
    return shadow_engine_gives(r->engine, m->light, r->api, r->bias, r->normal_bias);
}

/* The lengths that an engine's bias gives there: along the ray, by the slope, and along the normal. */
static double given_at(const mapped *m, int which, double angle) {
    const shadow_given given = gives(m);
    const ground g = shadow_ground_at(m->light, m->light->receiver_lo);
    const double slant = shadow_radians(angle);
    (void)which;
    return given.level * m->depth + given.ray_share * (m->light->kind == SHADOW_SUN ? 1.0 : g.z) +
           given.factor * shadow_lean(m->light, &g, slant) * fmax(g.texel_x, g.texel_y) +
           shadow_given_offset(&given, angle) / dp_cos(slant);
}

/* All causes together; beside an engine on the ray where its bias lacks most, so that the curves cross where its
 * verdict of these receivers does. */
static double needed_at(const mapped *m, int which, double angle) {
    double sum = 0.0;
    if (m->request->engine != NULL) {
        const shadow_given given = gives(m);
        return given_at(m, which, angle) + shadow_lacking(m->light, &given, angle);
    }
    for (int k = 0; k < GROUPS; k++)
        sum += group_at(m, k, angle);
    return sum;
}

static double gap_at(const mapped *m, int way, double angle) {
    double along_light, along_normal;
    shadow_gap_at(m->light, &m->added[way], angle, &along_light, &along_normal);
    return along_light;
}

typedef double value_at(const mapped *m, int which, double angle);

static chart_series *add_curve(chart *out, chart_panel *panel, const mapped *m, value_at *value, int which,
                               chart_style style, const char *prefix, const char *name) {
    chart_series *s = chart_add_series(out, panel, CHART_LINE, POINTS);
    if (s == NULL)
        return NULL;
    s->style = style;
    snprintf(s->name, sizeof s->name, "%s%s", prefix, name);
    for (int i = 0; i < POINTS; i++) {
        s->x[i] = angle_at(m, i);
        const double y = value(m, which, s->x[i]);
        s->y[i] = isfinite(y) && y > 0.0 ? y : (double)NAN; /* a log axis has no 0 */
    }
    return s;
}

static void name_given(const figure_request *request, char *name, size_t size) {
    snprintf(name, size, "given, %.24s", request->engine->name);
}

/* A log axis has no place for a curve without a point above 0: its name says what it is. */
static void name_hidden(chart_series *given, bool below) {
    bool shown = false;
    for (size_t i = 0; i < given->count; i++)
        shown = shown || !isnan(given->y[i]);
    if (!shown)
        append(given->name, sizeof given->name, below ? ": below 0, not drawn" : ": 0, not drawn");
}

/* In place of the causes, one by one. */
static void add_given(chart *out, chart_panel *panel, const mapped *m) {
    char name[32];
    name_given(m->request, name, sizeof name);
    add_curve(out, panel, m, needed_at, 0, (chart_style){0, 0, 0, false}, "", "needed");
    chart_series *given = add_curve(out, panel, m, given_at, 0, (chart_style){1, 0, 1, false}, "", name);
    if (given != NULL)
        name_hidden(given, given_at(m, 0, 0.0) < 0.0);
}

static void add_panel(chart *out, const figure_request *request, size_t i) {
    const shadow_cascade *c = &request->maps[i];
    shadow_light light = c->light;
    if (light.kind != SHADOW_SUN)
        light.receiver_hi = light.receiver_lo;
    const mapped m = mapped_of(request, &light);
    chart_panel *panel = chart_add_panel(out);
    panel->x = (chart_axis){.hi = m.light->triangles.slant_hi,
                            .label = "angle between the surface's normal and the light",
                            .key = "angle",
                            .unit = "degrees"};
    panel->y = (chart_axis){.scale = CHART_LOG, .label = "along the light", .key = "length", .unit = "scene units"};
    char from[TICKS_TEXT], to[TICKS_TEXT];
    ticks_about(request->map_count > 1 ? c->from : light.receiver_lo, from);
    ticks_about(c->to, to);
    if (request->map_count > 1)
        snprintf(panel->title, sizeof panel->title, "Cascade %zu: %s to %s, texel %.3g", i + 1, from, to, m.need.texel);
    else if (light.kind != SHADOW_SUN)
        snprintf(panel->title, sizeof panel->title, "At z = %s, texel %.3g", from, m.need.texel);
    for (int k = 0; k < GROUPS && request->engine == NULL; k++)
        add_curve(out, panel, &m, group_at, k, (chart_style){k, 0, k, false}, "", groups[k].name);
    if (request->engine != NULL)
        add_given(out, panel, &m);
    for (int k = 0; k < SHADOW_WAY_COUNT; k++)
        if (isfinite(gap_at(&m, k, panel->x.hi)))
            add_curve(out, panel, &m, gap_at, k, (chart_style){-1, THEME_DOTTED * k, -1, false}, "gap, ",
                      shadow_way_name((shadow_way)k));
}

/* ---- Against the distance ---------------------------------------------------------------------------------------- */

enum { DEPTHS = 65 };

typedef struct curve_row {
    const char *name;
    value_at *value;
    int which;
    chart_style style;
} curve_row;

static const char *add_distances(const figure_request *request, chart *out) {
    static const curve_row rows[] = {
        {"needed", needed_at, 0, {0, 0, 0, false}},
        {"", given_at, 0, {1, 0, 1, false}}, /* where an engine is named */
        {"gap, constant", gap_at, SHADOW_CONSTANT, {-1, 0, -1, false}},
        {"gap, normal offset", gap_at, SHADOW_NORMAL, {-1, THEME_DOTTED * SHADOW_NORMAL, -1, false}}};
    const shadow_light *whole = &request->maps[0].light;
    const double lo = whole->receiver_lo, hi = whole->receiver_hi, most = whole->triangles.slant_hi;
    chart_panel *panel = chart_add_panel(out);
    panel->x =
        (chart_axis){.scale = CHART_LOG,
                     .lo = lo,
                     .hi = hi,
                     .label = shadow_holds_distance(whole) ? "distance from the light" : "depth before the light",
                     .key = "z",
                     .unit = "scene units"};
    panel->y = (chart_axis){.scale = CHART_LOG, .label = "along the light", .key = "length", .unit = "scene units"};
    snprintf(panel->title, sizeof panel->title, "At %.3g degrees", most);
    for (size_t k = 0; k < sizeof rows / sizeof rows[0]; k++) {
        chart_series *s = rows[k].value == given_at && request->engine == NULL
                              ? NULL
                              : chart_add_series(out, panel, CHART_LINE, DEPTHS);
        if (s == NULL)
            continue;
        bool below = false;
        s->style = rows[k].style;
        snprintf(s->name, sizeof s->name, "%s", rows[k].name);
        if (rows[k].value == given_at)
            name_given(request, s->name, sizeof s->name);
        for (int i = 0; i < DEPTHS; i++) {
            shadow_light light = *whole;
            const double z = i == 0 ? lo : i == DEPTHS - 1 ? hi : lo * dp_pow(hi / lo, (double)i / (DEPTHS - 1));
            light.receiver_lo = light.receiver_hi = z;
            const mapped m = mapped_of(request, &light);
            const double y = rows[k].value(&m, rows[k].which, most);
            s->x[i] = z;
            s->y[i] = isfinite(y) && y > 0.0 ? y : (double)NAN;
            below = below || y < 0.0;
        }
        if (rows[k].value == given_at)
            name_hidden(s, below);
    }
    chart_fit(out);
    return NULL;
}

const char *shadow_distance_build(const figure_request *request, chart *out) {
    const shadow_light *whole = &request->maps[0].light;
    if (whole->kind == SHADOW_SUN)
        return "plot shadow-distance: needs --spot or --point, for the sun is as far from all";
    if (!(whole->receiver_lo < whole->receiver_hi))
        return "plot shadow-distance: receivers must lie at more than one depth";
    return add_distances(request, out);
}

static double texel_of(const figure_request *request, size_t map) {
    shadow_need need;
    shadow_need_of(&request->maps[map].light, &need);
    return need.texel;
}

/* Cascades are alike: of many the two ends are shown. */
const char *shadow_build(const figure_request *request, chart *out) {
    if (!(request->maps[0].light.triangles.slant_hi > 0.0))
        return "plot shadow: --angle must be above 0";
    size_t least = 0, most = 0;
    for (size_t i = 1; i < request->map_count; i++) {
        least = texel_of(request, i) < texel_of(request, least) ? i : least;
        most = texel_of(request, i) > texel_of(request, most) ? i : most;
    }
    for (size_t i = 0; i < request->map_count; i++)
        if (request->map_count <= 2 || i == least || i == most)
            add_panel(out, request, i);
    if (request->map_count > 2)
        append(out->subtitle, sizeof out->subtitle, "; of %zu cascades the finest and the coarsest",
               request->map_count);
    chart_fit(out);
    return NULL;
}
