/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "texture/figure_picture.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "draw/heat.h"

/* A scale over more than this is a logarithmic one; that of errors goes no further down than `deepest` of the largest.
 */
static const double wide = 50, deepest = 1e-4;

/* Pixels `first` to `end`. */
typedef struct span {
    uint32_t first, end;
} span;

static uint32_t start_of(uint32_t pixels, int fields, int i) {
    return (uint32_t)((uint64_t)pixels * (uint64_t)i / (uint64_t)fields);
}

/* The pixels of a field along one direction: all where they are errors, else the one in its middle. */
static span looks_at(const picture *p, uint32_t pixels, int fields, int i) {
    const span all = {start_of(pixels, fields, i), start_of(pixels, fields, i + 1)};
    const uint32_t middle = (all.first + all.end - 1) / 2;
    return p->magnitudes ? all : (span){middle, middle + 1};
}

/* Never wider than a pixel where the image is small. */
static int fields_of(uint32_t pixels, double factor) {
    return (int)fmax(1, floor(pixels * factor));
}

bool picture_open(picture *p, int most, chart *memory) {
    const double factor = fmin(1, (double)most / fmax(p->width, p->height));
    p->columns = fields_of(p->width, factor);
    p->rows = fields_of(p->height, factor);
    const size_t count = (size_t)p->columns * (size_t)p->rows * (size_t)p->channels;
    p->values = chart_memory(memory, count, sizeof *p->values);
    for (size_t i = 0; i < count && p->values != NULL; i++)
        p->values[i] = NAN;
    return p->values != NULL;
}

/* A number rather than NaN. */
static void keep_largest(float *field, float value) {
    if (!(value <= *field) && !isnan(value))
        *field = value;
}

static void take_row(picture *p, uint32_t row, const float *values) {
    const size_t channels = (size_t)p->channels;
    int j = (int)((uint64_t)row * (uint64_t)p->rows / p->height);
    while (start_of(p->height, p->rows, j + 1) <= row)
        j++;
    const span rows = looks_at(p, p->height, p->rows, j);
    float *field = p->values + (size_t)j * (size_t)p->columns * channels;
    uint32_t missing = 0;
    for (size_t x = 0; x < p->width; x++)
        missing += isnan(values[x * channels]) ? 1 : 0;
    p->missing += missing;
    if (p->columns == (int)p->width && p->rows == (int)p->height) {
        memcpy(field, values, p->width * channels * sizeof *field);
        return;
    }
    for (int i = 0; i < p->columns && row >= rows.first && row < rows.end; i++, field += channels) {
        const span columns = looks_at(p, p->width, p->columns, i);
        for (size_t k = columns.first * channels; k < columns.end * channels; k++)
            keep_largest(&field[k % channels], values[k]);
    }
}

void picture_take(picture *p, uint32_t row, uint32_t count, const float *values) {
    for (uint32_t i = 0; i < count; i++)
        take_row(p, row + i, values + (size_t)i * p->width * (size_t)p->channels);
}

static double field(const picture *in, const float *at, int channel) {
    if (in->above > 0 && !((double)at[0] > in->above))
        return NAN;
    if (!in->directions)
        return (double)at[channel];
    return isnan(at[0]) ? (double)NAN : heat_direction((double)at[0], (double)at[1], (double)at[2]);
}

/* A map's rows begin at the bottom. */
static void make_row(const void *of, int channel, int row, double *out) {
    const picture *in = of;
    const size_t channels = (size_t)in->channels;
    const float *from = in->values + (size_t)(in->rows - 1 - row) * (size_t)in->columns * channels;
    for (int column = 0; column < in->columns; column++)
        out[column] = field(in, from + (size_t)column * channels, channel);
}

static chart_rows rows_of(const picture *in, int channel) {
    return (chart_rows){.make = make_row, .of = in, .channel = channel};
}

static void add_panel(const picture *in, chart *out, int channel) {
    chart_panel *panel = chart_add_panel(out);
    panel->x = (chart_axis){.hi = in->width, .label = "column", .key = "column", .unit = "px"};
    panel->y = (chart_axis){.scale = CHART_DOWN, .hi = in->height, .label = "row", .key = "row", .unit = "px"};
    if (in->names != NULL)
        snprintf(panel->title, sizeof panel->title, "%s", in->names[channel]);
    chart_add_rows(out, panel, in->columns, in->rows, rows_of(in, channel));
}

/* The least and greatest finite number; of magnitudes the least above 0. */
static void extent(const picture *in, double *lo, double *hi) {
    const float *const values = in->values, left_out = in->magnitudes ? 0 : INFINITY;
    float least = INFINITY, most = -INFINITY;
    const size_t count = (size_t)in->rows * (size_t)in->columns * (size_t)in->channels;
#pragma omp simd reduction(min : least) reduction(max : most)
    for (size_t i = 0; i < count; i++) {
        const bool counts = fabsf(values[i]) < INFINITY && values[i] != left_out;
        least = counts && values[i] < least ? values[i] : least;
        most = counts && values[i] > most ? values[i] : most;
    }
    *lo = (double)least;
    *hi = (double)most;
}

static chart_axis scale_of(const picture *in) {
    double lo, hi;
    chart_axis axis = {.label = in->label, .key = "value", .unit = in->unit};
    extent(in, &lo, &hi);
    const bool nothing = !(lo <= hi); /* or errors that are all 0 */
    if (nothing) {
        lo = 0;
        hi = 1;
    } else if (in->magnitudes) {
        lo = fmax(lo, deepest * hi);
    }
    if (in->above > 0) {
        lo = in->above;
        hi = fmax(hi, 2 * lo);
    }
    if (in->shares) {
        lo = fmin(lo, 0);
        hi = fmax(hi, 1);
    }
    if (lo > 0 && hi > wide * lo)
        axis.scale = CHART_LOG;
    else if (in->magnitudes && !(in->above > 0))
        lo = 0;
    if (lo == hi) {
        lo -= fmax(fabs(lo), 1e-30) / 2;
        hi += fmax(fabs(hi), 1e-30) / 2;
    }
    axis.lo = lo;
    axis.hi = hi;
    return axis;
}

void picture_build(const picture *in, chart *out) {
    out->shape = (double)in->width / in->height;
    out->colours = in->directions;
    out->grey = in->grey;
    if (!in->directions)
        out->value = scale_of(in);
    const int panels = in->directions ? 1 : in->channels;
    for (int i = 0; i < panels; i++)
        add_panel(in, out, i);
}

void picture_lay_under(const picture *ground, chart *out) {
    out->panels[0].map.grounds = rows_of(ground, 0);
    out->ground = scale_of(ground);
}

void picture_put_beside(const picture *other, const char *title, chart *out) {
    add_panel(other, out, 0);
    snprintf(out->panels[out->panel_count - 1].title, CHART_TEXT, "%s", title);
}

void picture_mark(chart *out, size_t count, const double (*at)[2], const char *name) {
    for (size_t i = 0; i < out->panel_count && count > 0; i++) {
        chart_series *s = chart_add_series(out, &out->panels[i], CHART_POINTS, count);
        if (s == NULL)
            return;
        s->style = (chart_style){.colour = -1, .stroke = 1, .marker = 2, .thin = out->panel_count > 1};
        snprintf(s->name, sizeof s->name, "%s", name);
        for (size_t k = 0; k < count; k++) {
            s->x[k] = at[k][0];
            s->y[k] = at[k][1];
        }
    }
}
