/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "texture/figure_histogram.h"

#include <math.h>
#include <stdio.h>

#include "depthprec/batch.h"
#include "draw/theme.h"

enum { BINS = 96 };

/* Depths farther apart than this are shown in equal ratios. */
static const double wide = 50;

typedef struct bins {
    chart_axis x;
    uint32_t width;
    double pixels[BINS], codes[BINS], samples[BINS];
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

/* The farthest depth ends the last bin; what lies outside of all has numbers of its own. */
static int bin_of(const chart_axis *x, double z) {
    if (!(z >= x->lo && z <= x->hi))
        return z < x->lo ? -1 : BINS;
    const int bin = (int)floor(chart_axis_share(x, z) * BINS);
    return bin < BINS ? bin : BINS - 1;
}

static bool count_rows(void *context, uint32_t row, uint32_t count, const float *values) {
    bins *b = context;
    (void)row;
    for (size_t i = 0; i < (size_t)count * b->width; i++)
        if (isfinite(values[i]))
            b->pixels[bin_of(&b->x, (double)values[i])]++;
    return true;
}

/* The first rank in a bin or behind it. */
static uint32_t rank_from(const dp_batch *eye, const dp_setup *setup, const chart_axis *x, int bin, uint32_t end) {
    uint32_t first = 0;
    while (first < end) {
        const uint32_t middle = first + (end - first) / 2, code = frame_code(setup, middle);
        float z;
        dp_batch_run(eye, &code, &z, 1);
        if (bin_of(x, (double)z) < bin)
            first = middle + 1;
        else
            end = middle;
    }
    return first;
}

/* A code counts where a pixel that holds it does: by the same eye depth. */
static bool count_codes(const frame *f, bins *b) {
    const dp_setup *setup = &f->camera->setup;
    const uint32_t sky = frame_sky_rank(f);
    dp_batch eye;
    if (dp_batch_init(&eye, setup, DP_TASK_EYE, DP_REAL_FLOAT, DP_WORD_32, dp_path_best()) != DP_OK)
        return false;
    uint32_t first = rank_from(&eye, setup, &b->x, 0, sky);
    for (int i = 0; i < BINS; i++) {
        const uint32_t end = rank_from(&eye, setup, &b->x, i + 1, sky);
        b->codes[i] = (double)(end - first);
        first = end;
    }
    return true;
}

/* Levels of metric depth, between the edges of the bins, and what the file itself could hold there. */
static void count_levels(const frame *f, bins *b) {
    const double end = f->camera->setup.spec.zfar;
    for (int i = 0; i < BINS; i++) {
        const double lo = chart_axis_at(&b->x, (double)i / BINS), hi = chart_axis_at(&b->x, (double)(i + 1) / BINS);
        b->codes[i] = fmax(sensor_levels(f->sensor, lo, hi), 0);
        b->samples[i] = grain_numbers_below(f->grain, hi / end) - grain_numbers_below(f->grain, lo / end);
    }
}

/* A step for each bin; 0 lies below all that a logarithmic axis shows. */
static void add_steps(chart *out, chart_panel *panel, const double *counts, int look, const char *name) {
    chart_series *s = chart_add_series(out, panel, CHART_LINE, 2 * BINS);
    if (s == NULL)
        return;
    s->style = (chart_style){.colour = look, .stroke = THEME_DOTTED * look, .marker = -1};
    snprintf(s->name, sizeof s->name, "%s", name);
    for (size_t i = 0; i < 2 * BINS; i++) {
        s->x[i] = chart_axis_at(&panel->x, (double)((i + 1) / 2) / BINS);
        s->y[i] = counts[i / 2];
    }
}

bool histogram_build(const frame *given, bool codes, chart *out, uint64_t *counted) {
    texture_camera camera;
    const frame along = frame_along(given, &camera), *f = &along;
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
    if (given->camera->radial) {
        b.x.label = "distance from the camera";
        b.x.key = "distance";
    }
    if (!frame_run(f, &eye, false, count_rows, &b))
        return false;
    const bool levels = f->sensor != NULL && f->sensor->row->levels != GRAIN_FINE;
    if (levels)
        count_levels(f, &b);
    else if (codes && !count_codes(f, &b))
        return false;
    for (int i = 0; i < BINS; i++)
        most = fmax(fmax(most, b.samples[i]), fmax(b.pixels[i], b.codes[i]));
    chart_panel *panel = chart_add_panel(out);
    panel->x = b.x;
    panel->y = (chart_axis){CHART_LOG, 0.5, 2 * most, "count in each of 96 bins", "count", "", NULL};
    add_steps(out, panel, b.pixels, 0, "pixels");
    if (codes || levels)
        add_steps(out, panel, b.codes, 1, levels ? "levels available" : "codes available");
    if (levels)
        add_steps(out, panel, b.samples, 2, "samples of the file");
    return !chart_failed(out);
}
