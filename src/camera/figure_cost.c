/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The costs of set-ups against the separation that each gives at a depth: a row each, the closest on top. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "camera/cost.h"
#include "core/append.h"
#include "draw/ticks.h"
#include "plot/figure.h"

typedef struct priced {
    const char *name; /* of the set-up */
    cost cost;
    double separation; /* INFINITY: nothing is certain */
    bool front;        /* none that costs no more gives less */
    size_t row;
} priced;

static int closer(const void *a, const void *b) {
    const priced *x = a, *y = b;
    if (x->separation != y->separation)
        return x->separation < y->separation ? -1 : 1;
    const int cheaper = cost_compare(&x->cost, &y->cost);
    return cheaper != 0 ? cheaper : strcmp(x->name, y->name);
}

static void mark_front(priced *all, size_t count) {
    for (size_t i = 0; i < count; i++) {
        all[i].row = count - 1 - i;
        all[i].front = isfinite(all[i].separation);
        for (size_t k = 0; k < count && all[i].front; k++) {
            const int dearer = cost_compare(&all[i].cost, &all[k].cost);
            all[i].front = !(dearer >= 0 && all[k].separation <= all[i].separation &&
                             (dearer > 0 || all[k].separation < all[i].separation));
        }
    }
}

/* The price in memory and in tests that are lost: those that pay alike are a series. The test of what no API has as
 * a depth buffer is that of a buffer beside it. */
static bool pays_alike(const priced *a, const priced *b) {
    return a->cost.buffer == b->cost.buffer && a->cost.bytes == b->cost.bytes &&
           (a->cost.early == b->cost.early || a->cost.buffer == 0);
}

static void name_series(const cost *c, chart_series *s) {
    const bool buffer = c->buffer != 0;
    snprintf(s->name, sizeof s->name, "%d byte%s, %s", c->bytes, c->bytes == 1 ? "" : "s",
             !buffer    ? c->available
             : c->early ? "early z"
                        : "no early z");
    if (buffer)
        append(s->name, sizeof s->name, ": shades %.2g of %d", ceil(10 * c->shaded) / 10, COST_SURFACES);
    s->style = (chart_style){!buffer ? 2 : c->early ? 0 : 1, 0, !buffer ? 2 : c->bytes < 4 ? 1 : 0, false};
}

static void add_series(const priced *all, size_t count, size_t first, chart *out, chart_panel *panel) {
    size_t alike = 0;
    for (size_t i = 0; i < count; i++)
        alike += pays_alike(&all[i], &all[first]);
    chart_series *s = chart_add_series(out, panel, CHART_POINTS, alike);
    if (s == NULL)
        return;
    s->labels = chart_memory(out, alike, sizeof *s->labels);
    s->unwritten = true; /* the axis has the names */
    name_series(&all[first].cost, s);
    for (size_t i = 0, k = 0; i < count && s->labels != NULL; i++) {
        if (!pays_alike(&all[i], &all[first]))
            continue;
        s->x[k] = all[i].separation;
        s->y[k] = (double)all[i].row + 0.5;
        snprintf(s->labels[k++], sizeof *s->labels, "%s", all[i].name);
    }
}

/* A tenth of far where no depth is asked: far itself has nothing behind it. */
static double depth_of(const figure_request *request) {
    double lo, hi;
    figure_range(request, &lo, &hi);
    return isnan(request->at) ? fmax(lo, hi / 10) : request->at;
}

/* From a third of the least to three times the most that is certain. */
static void widen(chart_axis *axis, const priced *all, size_t count) {
    axis->lo = all[0].separation / 3;
    for (size_t i = 0; i < count && isfinite(all[i].separation); i++)
        axis->hi = 3 * all[i].separation;
}

/* Behind what is guaranteed nothing may be certain, either. */
static double certain(const dp_setup *setup, double z) {
    const double s = dp_separation(setup, z);
    return isinf(setup->spec.zfar) || dp_is_certain(setup, z, s) ? s : (double)INFINITY;
}

const char *cost_build(const figure_request *request, chart *out) {
    const dp_spec *planes = &request->setups[0].spec;
    const double at = depth_of(request);
    priced *all = chart_memory(out, request->count, sizeof *all);
    const char **names = chart_memory(out, request->count, sizeof *names);
    chart_panel *panel = all != NULL && names != NULL ? chart_add_panel(out) : NULL;
    char depth[TICKS_TEXT];
    bool late = false;
    if (!(at >= planes->znear && at < planes->zfar))
        return "--at: must be a depth in front of the far plane in the figure cost";
    if (panel == NULL)
        return NULL;
    for (size_t i = 0; i < request->count; i++)
        all[i] = (priced){.name = request->names[i],
                          .cost = cost_of(&request->setups[i].spec.format, request->setups[i].spec.mapping),
                          .separation = certain(&request->setups[i], at)};
    qsort(all, request->count, sizeof *all, closer);
    if (!isfinite(all[0].separation))
        return "--at: no set-up of the figure cost is certain to tell depths apart there";
    mark_front(all, request->count);
    for (size_t i = 0; i < request->count; i++) {
        char *name = chart_memory(out, CHART_TEXT, 1);
        if (name != NULL)
            snprintf(name, CHART_TEXT, "%s%s", all[i].front ? "* " : "", all[i].name);
        names[all[i].row] = name;
    }
    panel->x = (chart_axis){
        .scale = CHART_LOG, .label = "separation that is certain", .key = "separation", .unit = "scene units"};
    panel->y = (chart_axis){.hi = (double)request->count, .names = names, .label = "", .key = "row", .unit = ""};
    for (size_t i = 0; i < request->count; i++) {
        size_t before = 0;
        while (!pays_alike(&all[before], &all[i]))
            before++;
        late = late || !all[i].cost.early;
        if (before == i)
            add_series(all, request->count, i, out, panel);
    }
    widen(&panel->x, all, request->count);
    ticks_about(at, depth);
    append(out->subtitle, sizeof out->subtitle, "%s%s. * None that costs no more gives less%s%s",
           isnan(request->at) ? ", at depth " : "", isnan(request->at) ? depth : "",
           late ? ". No early z: the fragment shader writes depth" : "",
           isinf(all[request->count - 1].separation) ? ". Without a mark: nothing is certain" : "");
    append(out->subtitle, sizeof out->subtitle, ". Shades: of %d surfaces at a pixel, in random order", COST_SURFACES);
    return NULL;
}
