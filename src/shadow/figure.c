/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Shadow maps: a panel for each, in it the gap that each of the three biases opens on surfaces at each angle to the
 * light, and what the causes of acne take there. All are lengths along the light.
 */
#include <math.h>
#include <stdio.h>

#include "core/append.h"
#include "draw/theme.h"
#include "plot/figure.h"
#include "shadow/shadow.h"

enum { POINTS = 181 };

/* A map, and what it needs. */
typedef struct mapped {
    const shadow_light *light;
    shadow_need need;
    double depth; /* of the box, scene units */
} mapped;

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

static double gap_at(const mapped *m, int way, double angle) {
    double along_light, along_normal;
    shadow_gap_at(m->light, &m->need.bias[way], angle, &along_light, &along_normal);
    return along_light;
}

typedef double value_at(const mapped *m, int which, double angle);

static void add_curve(chart *out, chart_panel *panel, const mapped *m, value_at *value, int which, chart_style style,
                      const char *prefix, const char *name) {
    chart_series *s = chart_add_series(out, panel, CHART_LINE, POINTS);
    if (s == NULL)
        return;
    s->style = style;
    snprintf(s->name, sizeof s->name, "%s%s", prefix, name);
    for (int i = 0; i < POINTS; i++) {
        s->x[i] = angle_at(m, i);
        const double y = value(m, which, s->x[i]);
        s->y[i] = isfinite(y) && y > 0.0 ? y : (double)NAN; /* a log axis has no 0 */
    }
}

static void add_panel(chart *out, const figure_request *request, size_t i) {
    const shadow_cascade *c = &request->maps[i];
    const dp_spec *spec = &c->light.setup.spec;
    mapped m = {.light = &c->light};
    shadow_need_of(m.light, &m.need);
    m.depth = spec->zfar - spec->znear;
    chart_panel *panel = chart_add_panel(out);
    panel->x = (chart_axis){.hi = m.light->triangles.slant_hi,
                            .label = "angle between the surface's normal and the light",
                            .key = "angle",
                            .unit = "degrees"};
    panel->y = (chart_axis){.scale = CHART_LOG, .label = "along the light", .key = "length", .unit = "scene units"};
    if (request->map_count > 1)
        snprintf(panel->title, sizeof panel->title, "Cascade %zu: %.3g to %.3g, texel %.3g", i + 1, c->from, c->to,
                 m.need.texel);
    for (int k = 0; k < GROUPS; k++)
        add_curve(out, panel, &m, group_at, k, (chart_style){k, 0, k, false}, "", groups[k].name);
    for (int k = 0; k < SHADOW_WAY_COUNT; k++)
        if (isfinite(gap_at(&m, k, panel->x.hi)))
            add_curve(out, panel, &m, gap_at, k, (chart_style){-1, THEME_DOTTED * k, -1, false}, "gap, ",
                      shadow_way_name((shadow_way)k));
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
