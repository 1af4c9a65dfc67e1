/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/figure_file.h"
#include "cli/progress.h"
#include "cli/setups.h"
#include "cli/texture_product.h"
#include "plot/notes.h"
#include "plot/picture.h"

enum { WIDTH = 800, BESIDE = 150, ABOVE = 130, HEIGHT_MIN = 240, HEIGHT_MAX = 1200 };

/* A product made smaller: a field is the largest of its pixels where they are errors, else the one in its middle. */
typedef struct shrinking {
    picture shown;
    bool largest;
    float *fields;
    uint64_t missing; /* pixels without a value: holes, sky, and what has too few neighbours */
    progress bar;
    uint64_t done;
} shrinking;

/* Fields are never wider than a pixel where the image is small, nor more than the figure has room for. */
static int fields_of(uint32_t pixels, uint32_t width, uint32_t height, int most) {
    const double factor = fmin(1, (double)most / fmax(width, height));
    return (int)fmax(1, floor(pixels * factor));
}

static uint32_t field_start(uint32_t pixels, int fields, int i) {
    return (uint32_t)((uint64_t)pixels * (uint64_t)i / (uint64_t)fields);
}

static int field_at(uint32_t pixels, int fields, uint32_t at) {
    int i = (int)((uint64_t)at * (uint64_t)fields / pixels);
    while (field_start(pixels, fields, i + 1) <= at)
        i++;
    return i;
}

static uint32_t middle(uint32_t pixels, int fields, int i) {
    return (field_start(pixels, fields, i) + field_start(pixels, fields, i + 1) - 1) / 2;
}

static void take_row(shrinking *s, uint32_t row, const float *values) {
    const picture *p = &s->shown;
    const int j = field_at(p->height, p->rows, row);
    if (!s->largest && row != middle(p->height, p->rows, j))
        return;
    for (int i = 0; i < p->columns; i++) {
        float *field = s->fields + ((size_t)j * (size_t)p->columns + (size_t)i) * (size_t)p->channels;
        if (!s->largest) {
            memcpy(field, values + middle(p->width, p->columns, i) * (size_t)p->channels,
                   (size_t)p->channels * sizeof *field);
            continue;
        }
        for (uint32_t x = field_start(p->width, p->columns, i); x < field_start(p->width, p->columns, i + 1); x++)
            *field = fmaxf(*field, values[x]); /* a number rather than NaN */
    }
}

static bool take(void *context, uint32_t row, uint32_t count, const float *values) {
    shrinking *s = context;
    const size_t row_values = (size_t)s->shown.width * (size_t)s->shown.channels;
    for (uint32_t i = 0; i < count; i++)
        take_row(s, row + i, values + i * row_values);
    for (size_t i = 0; i < count * row_values; i += (size_t)s->shown.channels)
        s->missing += isnan(values[i]) ? 1 : 0;
    progress_step(&s->bar, s->done += count);
    return true;
}

static void words_of(const options *o, const texture_source *s, const texture_product *p, const shrinking *f,
                     chart *c) {
    char label[SETUP_LABEL_SIZE], title[sizeof c->title], reduced[96] = "", missing[64] = "",
                                                          subtitle[sizeof c->subtitle];
    const char *slash = s->path != NULL ? strrchr(s->path, '/') : NULL;
    snprintf(title, sizeof title, "%s", p->name);
    if (title[0] >= 'a' && title[0] <= 'z')
        title[0] = (char)(title[0] - 'a' + 'A');
    if (f->shown.columns < (int)s->camera.width)
        snprintf(reduced, sizeof reduced,
                 f->largest ? "; a point is the largest of %.3g pixels" : "; one of %.3g pixels",
                 (double)s->camera.width / f->shown.columns * s->camera.height / f->shown.rows);
    if (f->missing > 0)
        snprintf(missing, sizeof missing, "; hatched: no value, %llu pixels", (unsigned long long)f->missing);
    setup_label(&s->setup, true, label);
    if (o->metric > 0)
        snprintf(label, sizeof label, "metric depth, %g scene units a unit", o->metric);
    snprintf(subtitle, sizeof subtitle, "%s%.100s, %u x %u; %s%s%s", s->path != NULL ? "" : "scene ",
             s->path == NULL ? s->frame.scene->name
             : slash != NULL ? slash + 1
                             : s->path,
             s->camera.width, s->camera.height, label, reduced, missing);
    notes_clean(c->title, sizeof c->title, o->title != NULL ? o->title : title);
    notes_clean(c->subtitle, sizeof c->subtitle, subtitle);
}

/* Fills the page: the picture in its shape, words above, axes around. */
static int height_of(const options *o, const texture_source *s, int width, bool stacked) {
    if (o->height > 0)
        return o->height;
    const double shape = (double)s->camera.height / s->camera.width, scale = width / (double)WIDTH;
    const double height = ((WIDTH - BESIDE) * shape * (stacked ? 0.37 : 1) + ABOVE) * scale;
    return (int)fmin(fmax(height, HEIGHT_MIN), fmax(HEIGHT_MAX, width));
}

static int draw(const options *o, const texture_source *s, const texture_product *p, shrinking *f, chart *c) {
    static const char *const axes[] = {"x (world)", "y (world)", "z (world)"};
    char label[PRODUCT_NAME_SIZE];
    output out;
    int status = output_open(&out, o->figure);
    if (status != EXIT_FINE)
        return status;
    snprintf(label, sizeof label, "%s",
             p->made.error                    ? "error"
             : p->made.kind == FRAME_POSITION ? "coordinate"
                                              : p->name);
    f->shown.label = label;
    f->shown.unit = p->unit;
    f->shown.names = f->shown.channels == 3 && !f->shown.directions ? axes : NULL;
    f->shown.values = f->fields;
    f->bar = progress_start("rows", s->camera.height, o->quiet);
    bool good = frame_run(&s->frame, &p->made, false, take, f);
    progress_end(&f->bar);
    words_of(o, s, p, f, c);
    picture_build(&f->shown, c);
    const int width = o->width > 0 ? o->width : WIDTH, height = height_of(o, s, width, f->shown.names != NULL);
    good = good && !chart_failed(c) && figure_file_write(o, o->figure, c, width, height, &out);
    if (!good) {
        output_abandon(&out);
        return usage_error("texture: no memory for the figure");
    }
    return output_close(&out);
}

int texture_figure_draw(const options *o, const texture_source *s, const texture_product *p) {
    const int most = o->width > WIDTH ? o->width : WIDTH;
    shrinking f = {
        .largest = p->made.error,
        .shown = {.width = s->camera.width,
                  .height = s->camera.height,
                  .columns = fields_of(s->camera.width, s->camera.width, s->camera.height, most),
                  .rows = fields_of(s->camera.height, s->camera.width, s->camera.height, most),
                  .channels = frame_channels(&p->made),
                  .directions = p->made.kind == FRAME_NORMAL && !p->made.error,
                  .magnitudes = p->made.error},
    };
    const size_t count = (size_t)f.shown.columns * (size_t)f.shown.rows * (size_t)f.shown.channels;
    f.fields = malloc(count * sizeof *f.fields);
    chart *c = chart_new();
    for (size_t i = 0; i < count && f.fields != NULL; i++)
        f.fields[i] = NAN;
    const int status =
        f.fields != NULL && c != NULL ? draw(o, s, p, &f, c) : usage_error("texture: no memory for the figure");
    free(f.fields);
    chart_free(c);
    return status;
}
