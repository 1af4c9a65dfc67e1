/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdio.h>

#include "plot/figure.h"
#include "plot/refine.h"

/* Each point of a curve stands for so many pixel columns, and each depth in it is an image of its own: how its pixels
 * meet the codes is chance, so the worst of some is shown. */
enum { COLUMNS_EACH = 16, DEPTHS_EACH = 4 };

static double worst_of(const figure_request *request, const chart_axis *x, size_t setup, size_t surface, size_t method,
                       int slice, int slices) {
    double worst = NAN;
    for (int i = 0; i < DEPTHS_EACH; i++) {
        const double z = refine_edge(x->scale, x->lo, x->hi, slice * DEPTHS_EACH + i, slices * DEPTHS_EACH - 1);
        worst = fmax(worst, request->normals->error(&request->setups[setup], surface, method, z)); /* fmax drops NaN */
    }
    return worst;
}

static void add_curve(const figure_request *request, chart *out, chart_panel *panel, size_t setup, size_t surface,
                      size_t method) {
    const figure_normals *n = request->normals;
    const bool bound = method == n->method_count;
    const int slices = request->columns / COLUMNS_EACH;
    chart_series *s = chart_add_series(out, panel, CHART_LINE, (size_t)slices);
    if (s == NULL)
        return;
    s->style = bound ? (chart_style){.colour = -1, .stroke = 1, .marker = -1, .thin = true}
                     : (chart_style){.colour = (int)method, .stroke = (int)method, .marker = (int)method};
    snprintf(s->name, sizeof s->name, "%s", bound ? n->bound : n->methods[method]);
    for (int k = 0; k < slices; k++) {
        const double error = worst_of(request, &panel->x, setup, surface, method, k, slices);
        s->x[k] = refine_edge(CHART_LOG, panel->x.lo, panel->x.hi, 2 * k + 1, 2 * slices);
        s->y[k] = error > 0 ? error : (double)NAN; /* a log axis has no 0 */
    }
}

const char *normals_build(const figure_request *request, chart *out) {
    const figure_normals *n = request->normals;
    double lo, hi;
    if (n == NULL)
        return "no normals to show";
    figure_range(request, &lo, &hi);
    for (size_t i = 0; i < request->count; i++)
        for (size_t surface = 0; surface < n->surface_count; surface++) {
            chart_panel *panel = chart_add_panel(out);
            if (panel == NULL)
                return NULL;
            panel->x = figure_depth_axis(CHART_LOG, lo, hi);
            panel->y = (chart_axis){.scale = CHART_LOG, .label = "angular error", .key = "error", .unit = "degrees"};
            const bool alone = request->count == 1; /* then the subtitle names it */
            snprintf(panel->title, sizeof panel->title, "%s%s%s", alone ? "" : request->names[i], alone ? "" : ": ",
                     n->surfaces[surface]);
            for (size_t method = 0; method < n->method_count; method++)
                add_curve(request, out, panel, i, surface, method);
            if (surface == 0)
                add_curve(request, out, panel, i, surface, n->method_count);
        }
    chart_fit(out);
    return NULL;
}
