/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdio.h>

#include "core/append.h"
#include "draw/heat.h"
#include "plot/envelope.h"

/* Set-ups computed for the whole figure, shared between its panels. */
enum { GRID_COLUMNS = 400, GRID_ROWS = 300 };

/* How far the axes reach round the camera, as a factor. */
static const double around = 100, infinite_from = 10, infinite_to = 1e7;

/* The interval at the depth asked about, by a cheaper way where its claim is good enough for this camera. */
static double interval_at(const figure_request *request, const dp_setup *setup, bool *by_way) {
    way cheaper;
    *by_way = request->at >= setup->spec.znear && request->at <= setup->spec.zfar &&
              !envelope_is_cut(setup, request->at) && envelope_way(setup, request->tolerance, &cheaper);
    if (*by_way)
        return way_interval(&cheaper, setup, request->at);
    return quantity_get(QUANTITY_INTERVAL)->at(setup, request->at);
}

/* The number coloured for one camera; NaN when there is no such camera, or it does not see what was asked. */
static double cell_value(const dp_setup *like, const figure_request *request, double znear, double zfar, bool *by_way) {
    dp_setup setup;
    dp_spec spec = like->spec;
    *by_way = false;
    spec.znear = znear;
    spec.zfar = zfar;
    if (dp_setup_init(&setup, &spec) != DP_OK)
        return NAN;
    if (!isnan(request->at))
        return interval_at(request, &setup, by_way);
    double lo = isnan(request->lo) ? znear : request->lo, hi = isnan(request->hi) ? zfar : request->hi;
    return quantity_bound(QUANTITY_INTERVAL, &setup, lo, hi);
}

/* Returns how many fields were computed by another way than the exact cell. */
static size_t fill(chart_map *m, const dp_setup *like, const figure_request *request) {
    size_t by_way = 0;
#pragma omp parallel for schedule(dynamic, 4) reduction(+ : by_way)
    for (int row = 0; row < m->rows; row++)
        for (int column = 0; column < m->columns; column++) {
            bool other;
            *chart_field(m, row, column) = cell_value(like, request, m->x[column], m->y[row], &other);
            by_way += other;
        }
    return by_way;
}

static void add_camera(chart *out, chart_panel *panel, const dp_spec *spec) {
    chart_series *s = chart_add_series(out, panel, CHART_POINTS, 1);
    if (s == NULL)
        return;
    s->style = (chart_style){.colour = -1};
    snprintf(s->name, sizeof s->name, "camera");
    s->x[0] = spec->znear;
    s->y[0] = isinf(spec->zfar) ? panel->y.hi : spec->zfar;
    snprintf(s->note, sizeof s->note, " asked about: near %.4g, far %.4g", spec->znear, spec->zfar);
}

static void add_panel(const figure_request *request, chart *out, size_t i, double shrink) {
    const dp_setup *like = &request->setups[i];
    const dp_spec *spec = &like->spec;
    const bool infinite = isinf(spec->zfar), any_sign = spec->znear <= 0;
    const chart_scale scale = any_sign ? CHART_LINEAR : CHART_LOG;
    const double half =
        (spec->zfar - spec->znear) / 2; /* of what linear axes show: where the planes meet is a corner */
    chart_panel *panel = chart_add_panel(out);
    panel->x = (chart_axis){.scale = scale, .label = "near plane", .key = "near", .unit = "scene units"};
    panel->x.lo = fmax(any_sign ? spec->znear - half : spec->znear / around, any_sign ? -1e12 : 1e-12);
    panel->x.hi = fmin(any_sign ? spec->znear + half : spec->znear * around, 1e12);
    panel->y = (chart_axis){.scale = scale, .label = "far plane", .key = "far", .unit = "scene units"};
    panel->y.lo = any_sign ? spec->zfar - half : infinite ? spec->znear * infinite_from : spec->zfar / around;
    panel->y.hi = fmin(any_sign   ? spec->zfar + half
                       : infinite ? spec->znear * infinite_to
                                  : spec->zfar * around,
                       infinite ? 1e18 : fmax(spec->zfar, 1e18));
    if (request->count > 1)
        snprintf(panel->title, sizeof panel->title, "%s", request->names[i]);
    if (!chart_add_map(out, panel, (int)(GRID_COLUMNS * shrink), (int)(GRID_ROWS * shrink)))
        return;
    panel->map.by_way = fill(&panel->map, like, request);
    add_camera(out, panel, spec);
}

const char *map_build(const figure_request *request, chart *out) {
    out->value = envelope_axis(QUANTITY_INTERVAL);
    if (isnan(request->at))
        out->value.label = "worst z-fighting interval";
    if (!isnan(request->at) && out->title[0] == '\0')
        snprintf(out->title, sizeof out->title, "Z-fighting interval at depth %.6g for each near and far plane",
                 request->at);
    out->contours = true;
    for (size_t i = 0; i < request->count; i++)
        add_panel(request, out, i, 1 / sqrt((double)request->count));
    if (heat_has_holes(&out->panels[0].map))
        append(out->subtitle, sizeof out->subtitle, ". Hatched: %s",
               !isnan(request->at)   ? "does not see that depth"
               : !isnan(request->lo) ? "does not see those depths"
                                     : "far is not behind near");
    chart_fit(out);
    return NULL;
}
