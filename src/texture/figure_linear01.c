/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Window depth and the two linear ones that shaders make of it, each from 0 to 1, for each far plane. */
#include <math.h>
#include <stdio.h>

#include "core/append.h"
#include "draw/theme.h"
#include "draw/ticks.h"
#include "plot/envelope.h"

typedef enum quantity { FROM_CAMERA, FROM_NEAR, WINDOW } quantity;

typedef struct curve {
    dp_setup setup;
    quantity what;
} curve;

static void sample(const void *context, double from, double to, refine_sample *out) {
    const curve *c = context;
    const double n = c->setup.spec.znear, f = c->setup.spec.zfar;
    (void)to;
    *out = (refine_sample){.y = {c->what == WINDOW        ? dp_window(&c->setup, from)
                                 : c->what == FROM_CAMERA ? from / f
                                                          : (from - n) / (f - n)}};
}

/* Colours part the far planes, or of a single one the curves; strokes part the curves. */
static void add_curve(const figure_request *request, chart *out, chart_panel *panel, const dp_setup *setup, size_t far,
                      size_t index) {
    static const char *const names[] = {"Linear01Depth, z/far", "Linear01DepthFromNear"};
    const bool several = request->far_count > 1, window = index >= WINDOW;
    char text[TICKS_TEXT];
    curve *c = chart_memory(out, 1, sizeof *c);
    if (c == NULL)
        return;
    *c = (curve){*setup, window ? WINDOW : (quantity)index};
    refine_request q = envelope_request(request, setup, out, panel, sample, c);
    q.knot_count = 0; /* it is smooth */
    q.hi = fmin(q.hi, setup->spec.zfar);
    q.every = q.every && !several; /* each ends at its own far plane */
    chart_series *s = q.hi > q.lo ? envelope_curve(out, panel, &q) : NULL;
    if (s == NULL)
        return;
    s->style = (chart_style){(int)(several ? far : index),
                             !window           ? THEME_DOTTED * (int)index
                             : setup->reversed ? THEME_REVERSED
                                               : THEME_SPARSE,
                             -1, false};
    ticks_label(setup->spec.zfar, setup->spec.zfar >= 1e6, text);
    if (several)
        snprintf(s->name, sizeof s->name, "far %s: ", text);
    append(s->name, sizeof s->name, "%s%s", window ? "window depth, " : names[index],
           window ? dp_mapping_get(setup->spec.mapping)->name : "");
}

const char *linear01_build(const figure_request *request, chart *out) {
    const chart_axis y = {CHART_LINEAR, 0, 1, "depth from 0 to 1", "share", "", NULL};
    chart_panel *panel = figure_panel(request, out, y);
    const double own = request->setups[0].spec.zfar, *fars = request->far_count > 0 ? request->fars : &own;
    const size_t far_count = request->far_count > 0 ? request->far_count : 1;
    const bool several = far_count > 1;
    char near[TICKS_TEXT], to[TICKS_TEXT];
    for (size_t far = 0; far < far_count; far++)
        if (isinf(fars[far]))
            return "--far: must be finite in the figure linear01, got inf";
    panel->x.scale = CHART_LINEAR;
    ticks_label(request->setups[0].spec.znear, false, near);
    ticks_label(fars[0], fars[0] >= 1e6, to);
    snprintf(out->subtitle, sizeof out->subtitle, several ? "near %s" : "near %s, far %s", near, to);
    for (size_t far = 0; far < far_count; far++) {
        dp_spec spec = request->setups[0].spec;
        dp_setup setup;
        spec.zfar = fars[far];
        for (size_t i = 0; i < request->count; i++) {
            spec.mapping = request->setups[i].spec.mapping;
            if (i > 0 && spec.mapping == request->setups[0].spec.mapping)
                break; /* of another format */
            if (dp_setup_init(&setup, &spec) != DP_OK)
                return "--far: each must lie beyond near by at least 1e-6 of it";
            add_curve(request, out, panel, &setup, far, WINDOW + i);
        }
        add_curve(request, out, panel, &setup, far, FROM_CAMERA);
        add_curve(request, out, panel, &setup, far, FROM_NEAR);
    }
    chart_fit(out);
    return NULL;
}
