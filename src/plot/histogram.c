/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "plot/histogram.h"

#include <math.h>
#include <stdio.h>

enum { BINS = 96 };

/* Depths farther apart than this are shown in equal ratios. */
static const double wide = 50;

typedef struct bins {
    chart_axis x;
    uint32_t width;
    double pixels[BINS], codes[BINS];
} bins;

static chart_axis axis_of(const frame_summary *s) {
    chart_axis x = {.lo = s->lo, .hi = s->hi, .label = "eye depth", .key = "z", .unit = "scene units"};
    if (x.lo > 0 && x.hi > wide * x.lo)
        x.scale = CHART_LOG;
    if (x.lo == x.hi) {
        x.lo -= fmax(fabs(x.lo), 1e-30) / 2;
        x.hi += fmax(fabs(x.hi), 1e-30) / 2;
    }
    return x;
}

static bool take(void *context, uint32_t row, uint32_t count, const float *values) {
    bins *b = context;
    (void)row;
    for (size_t i = 0; i < (size_t)count * b->width; i++)
        if (isfinite(values[i])) {
            const int bin = (int)floor(chart_axis_share(&b->x, (double)values[i]) * BINS);
            b->pixels[bin < 0 ? 0 : bin < BINS ? bin : BINS - 1]++; /* the farthest depth ends the last one */
        }
    return true;
}

/* From the first code at or behind one end to that at the other. */
static void count_codes(const dp_setup *setup, bins *b) {
    uint32_t before = dp_code(setup, b->x.lo);
    for (int i = 0; i < BINS; i++) {
        const uint32_t end = dp_code(setup, chart_axis_at(&b->x, (i + 1.0) / BINS));
        b->codes[i] = fabs((double)end - (double)before);
        before = end;
    }
}

/* A step for each bin; 0 lies below all that a logarithmic axis shows. */
static void add_steps(chart *out, chart_panel *panel, const double *counts, int look, const char *name) {
    chart_series *s = chart_add_series(out, panel, CHART_LINE, 2 * BINS);
    if (s == NULL)
        return;
    s->style = (chart_style){.colour = look, .stroke = look, .marker = -1};
    snprintf(s->name, sizeof s->name, "%s", name);
    for (size_t i = 0; i < 2 * BINS; i++) {
        s->x[i] = chart_axis_at(&panel->x, (double)((i + 1) / 2) / BINS);
        s->y[i] = counts[i / 2];
    }
}

bool histogram_build(const frame *f, bool codes, chart *out, uint64_t *counted) {
    const frame_product eye = {.kind = FRAME_EYE};
    bins b = {.width = f->camera->width};
    frame_summary sum;
    double most = 1;
    if (!frame_summarise(f, &eye, &sum))
        return false;
    *counted = sum.count;
    if (sum.count == 0)
        return true;
    b.x = axis_of(&sum);
    if (!frame_run(f, &eye, false, take, &b))
        return false;
    if (codes)
        count_codes(&f->camera->setup, &b);
    for (int i = 0; i < BINS; i++)
        most = fmax(most, fmax(b.pixels[i], b.codes[i]));
    chart_panel *panel = chart_add_panel(out);
    panel->x = b.x;
    panel->y = (chart_axis){CHART_LOG, 0.5, 2 * most, "count in each of 96 bins", "count", "", NULL};
    add_steps(out, panel, b.pixels, 0, "pixels");
    if (codes)
        add_steps(out, panel, b.codes, 1, "codes available");
    return !chart_failed(out);
}
