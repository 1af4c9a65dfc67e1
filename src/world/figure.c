/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Large worlds: the separation that is safe and the jitter of a picture, against the distance from the world's
 * origin, a curve for each scheme. One panel each.
 */
#include <math.h>
#include <stdio.h>

#include "camera/unit.h"
#include "core/append.h"
#include "core/elementary.h"
#include "core/engine.h"
#include "draw/theme.h"
#include "plot/figure.h"
#include "world/reach.h"

enum { POINTS = 241 };

static const double ahead = 10.0; /* metres, where it is known what a scene unit is */
static const double nearest = 100.0, farthest = 1e8;

/* A length in metres, in scene units; as it is where nobody says what they are. */
static double of_metres(const chart *c, double length) {
    return c->unit != NULL ? unit_convert(length, unit_find("m"), unit_find(c->unit)) : length;
}

/* The separation ends where nothing is certain behind the depth that it is of. */
static void end_line(chart_series *line, const world_asked *a) {
    bool ends = false;
    for (size_t i = 0; i < line->count && isfinite(a->setup->spec.zfar); i++) {
        if (!ends && !dp_is_certain(a->setup, a->z, line->y[i]))
            line->certain_to = line->x[i > 0 ? i - 1 : 0];
        ends = !isnan(line->certain_to);
        line->y[i] = ends ? (double)NAN : line->y[i];
    }
}

static void add_schemes(chart *out, chart_panel *panel, const world_asked *a, world_loss *loss) {
    for (size_t k = 0; k < WORLD_ROWS; k++) {
        const world_row *row = world_get(k);
        const world_scheme s = {row, row->metres ? of_metres(out, row->standard) : row->standard};
        chart_series *line = chart_add_series(out, panel, CHART_LINE, POINTS);
        if (line == NULL)
            return;
        line->style = (chart_style){(int)(k % 4), THEME_DOTTED * (int)(k / 4), -1, false};
        snprintf(line->name, sizeof line->name, "%s", s.row->name);
        if (s.row->size != NULL)
            append(line->name, sizeof line->name, ":%.7g", s.size);
        for (int i = 0; i < POINTS; i++) {
            line->x[i] = nearest * dp_pow(farthest / nearest, i / (double)(POINTS - 1));
            line->y[i] = loss(&s, a, line->x[i]);
        }
        if (loss == world_separation)
            end_line(line, a);
    }
}

static chart_panel *add_panel(chart *out, const char *title) {
    chart_panel *panel = chart_add_panel(out);
    panel->x = (chart_axis){.scale = CHART_LOG,
                            .lo = nearest,
                            .hi = farthest,
                            .label = "distance of the camera from the origin",
                            .key = "distance",
                            .unit = "scene units"};
    /* One scale, whose labels stand beside the first: what each counts stands in its title. */
    panel->y = (chart_axis){.scale = CHART_LOG, .lo = 1e-6, .hi = 1e4, .label = "at most", .key = "most", .unit = ""};
    snprintf(panel->title, sizeof panel->title, "%s", title);
    return panel;
}

const char *world_build(const figure_request *request, chart *out) {
    const dp_triangles view = dp_triangles_default();
    const dp_setup facing = dp_setup_facing(&request->setups[0]);
    const double half = dp_half_tangent(view.fov_y), z = isnan(request->at) ? of_metres(out, ahead) : request->at;
    const world_asked a = {.setup = &facing,
                           .z = z,
                           .ray_ratio = dp_hypot(1.0, half * dp_hypot(1.0, (double)view.width / view.height)),
                           .pixels = 0.5 * view.height / half};
    char in_units[64];
    snprintf(in_units, sizeof in_units, "Separation that is safe, %s", out->unit != NULL ? out->unit : "scene units");
    if (!isnan(request->lo))
        return "plot world: --range does not apply: distances are from 100 to 1e8 scene units";
    if (facing.spec.ortho)
        return "plot world: --ortho has no perspective";
    if (!(z >= facing.spec.znear && z <= facing.spec.zfar))
        return isnan(request->at) ? "plot world: needs --at: 10 m ahead, the default, is not between near and far"
                                  : "plot world: --at must lie between near and far";
    chart_panel *gap = add_panel(out, in_units);
    add_schemes(out, gap, &a, world_separation);
    chart_panel *jitter = add_panel(out, "Jitter, pixels");
    add_schemes(out, jitter, &a, world_jitter);
    if (isnan(request->at)) /* else it is said */
        append(out->subtitle, sizeof out->subtitle, ", %.4g ahead", z);
    append(out->subtitle, sizeof out->subtitle, "; %dx%d, fov %.4g, meshes with origins of their own", view.width,
           view.height, view.fov_y);
    chart_fit(out);
    return NULL;
}
