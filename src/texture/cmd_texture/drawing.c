/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "camera/cmd/setups.h"
#include "cli/progress.h"
#include "core/append.h"
#include "draw/notes.h"
#include "plot/cmd_plot/figure_data.h"
#include "plot/cmd_plot/figure_file.h"
#include "report/number.h"
#include "system/posix.h"
#include "texture/cmd_texture/request.h"
#include "texture/cmd_texture/texture.h"
#include "texture/figure_histogram.h"
#include "texture/figure_picture.h"
#include "texture/survey.h"

enum { WIDTH = 800, HISTOGRAM_HEIGHT = 500, BESIDE = 150, ABOVE = 130, HEIGHT_MIN = 240, HEIGHT_MAX = 1200 };

typedef struct drawing {
    picture shown;
    bool beside;            /* of window depth: `second` is what Linear01Depth makes of it */
    picture second;         /* with --overlay the error of eye depth */
    uint64_t known, beyond; /* pixels whose error is known, and those of them in colour */
    progress bar;
    uint64_t done;
} drawing;

static bool draw_rows(void *context, uint32_t row, uint32_t count, const float *values) {
    drawing *d = context;
    picture_take(&d->shown, row, count, values);
    progress_step(&d->bar, d->done += count);
    return true;
}

static bool draw_both(void *context, uint32_t row, uint32_t count, const float *const *values) {
    drawing *d = context;
    picture_take(&d->second, row, count, values[1]);
    for (size_t i = 0; i < (size_t)count * d->second.width; i++) {
        d->known += isnan(values[1][i]) ? 0 : 1;
        d->beyond += (double)values[1][i] > d->second.above ? 1 : 0;
    }
    return draw_rows(context, row, count, values[0]);
}

/* The product, and what stands on it or beside it. */
static bool run(const texture_request *o, const texture_source *s, const texture_product *p, drawing *d) {
    const frame_product error = {.kind = FRAME_EYE, .error = true, .radial = p->made.radial};
    const frame_product linear01 = {.kind = FRAME_LINEAR01}, both[] = {p->made, d->beside ? linear01 : error};
    d->bar = progress_start("rows", s->camera.height, o->out.quiet);
    const bool good = o->image.overlay > 0 || d->beside ? frame_run_all(&s->frame, both, 2, false, draw_both, d)
                                                        : frame_run(&s->frame, &p->made, false, draw_rows, d);
    progress_end(&d->bar);
    return good;
}

/* Builds the chart; with --overlay the grey picture lies under the coloured one. */
static void build(const texture_request *o, drawing *d, chart *c) {
    if (!(o->image.overlay > 0)) {
        picture_build(&d->shown, c);
        if (d->beside)
            picture_put_beside(&d->second, "eye depth over far", c);
        return;
    }
    picture_build(&d->second, c);
    picture_lay_under(&d->shown, c);
    if (d->shown.missing < (uint64_t)d->shown.width * d->shown.height)
        append(c->subtitle, sizeof c->subtitle, "; grey from %s, light, to %s, dark%s", number_of(c->ground.lo, 4).text,
               number_of(c->ground.hi, 4).text, c->ground.scale == CHART_LOG ? ", logarithmic" : "");
    if (d->known > 0)
        append(c->subtitle, sizeof c->subtitle, "; %s %% of the pixels with a depth are in colour",
               number_of(100 * (double)d->beyond / (double)d->known, 3).text);
}

/* Title and subtitle: what holds for all of a source, and more. */
static void words_of(const texture_request *o, const texture_source *s, const char *title, const char *more, chart *c) {
    char label[SETUP_LABEL_SIZE], subtitle[sizeof c->subtitle];
    const char *unit = camera_unit(&o->camera);
    c->unit = unit;
    const setup_fields fields = setup_fields_asked(&s->setup, &o->camera);
    setup_label_as(&s->setup, &fields, label);
    if (o->image.stereo.focal > 0)
        snprintf(label, sizeof label, "disparity, focal length %g pixels, baseline %g %s", o->image.stereo.focal,
                 o->image.stereo.baseline, unit != NULL ? unit : "scene units");
    else if (o->image.metric > 0)
        snprintf(label, sizeof label, "metric depth, %g %s a unit", o->image.metric,
                 unit != NULL ? unit : "scene units");
    else if (unit != NULL)
        append(label, sizeof label, ", lengths in %s", unit);
    snprintf(subtitle, sizeof subtitle, "%s%.100s, %u x %u; %s%s", s->path != NULL ? "" : "synthetic ",
             s->path == NULL ? s->frame.synthetic->name : path_name(s->path), s->camera.width, s->camera.height, label,
             more);
    notes_clean(c->title, sizeof c->title, o->figure.title != NULL ? o->figure.title : title);
    notes_clean(c->subtitle, sizeof c->subtitle, subtitle);
}

/* "eye depth, error" as "error of eye depth", and "normals by high" as "normals, method high". */
static void name_quantity(const char *name, char *out, size_t size) {
    const char *const what = strstr(name, ", "), *const by = strstr(name, " by ");
    const int length = what != NULL ? (int)(what - name) : (int)strlen(name);
    const int base = by != NULL ? (int)(by - name) : length;
    snprintf(out, size, "%s%s%.*s", what != NULL ? what + 2 : "", what != NULL ? " of " : "", base, name);
    if (by != NULL)
        append(out, size, ", method %.*s", length - base - 4, by + 4);
}

static void describe(const texture_request *o, const texture_source *s, const texture_product *p, const drawing *d,
                     chart *c) {
    const picture *shown = &d->shown;
    const uint64_t missing = d->beside ? d->second.missing : shown->missing;
    char title[sizeof c->title], more[160] = "";
    const char *unit = camera_unit(&o->camera);
    name_quantity(p->name, title, sizeof title);
    if (d->beside)
        append(title, sizeof title, " beside eye depth over far, Linear01Depth");
    if (p->made.kind == FRAME_EFFECT) {
        const int wanted = p->made.effect->wanted;
        append(title, sizeof title, ", %s %s", p->made.effect->parameters[wanted].name,
               number_full(p->made.effect_settings[wanted]).text);
    }
    if (o->image.overlay > 0)
        append(title, sizeof title, ", in colour where %s %s off by more than %s", p->made.radial ? "it" : "eye depth",
               s->path != NULL ? "can be" : "is",
               number_in(number_full(o->image.overlay), unit != NULL ? unit : "scene units").text);
    if (title[0] >= 'a' && title[0] <= 'z')
        title[0] = (char)(title[0] - 'a' + 'A');
    if (shown->columns < (int)s->camera.width || shown->rows < (int)s->camera.height)
        append(more, sizeof more,
               shown->magnitudes      ? "; a point is the largest of %.3g pixels"
               : o->image.overlay > 0 ? "; a colour is the largest error of %.3g pixels"
                                      : "; one of %.3g pixels",
               (double)s->camera.width / shown->columns * s->camera.height / shown->rows);
    if (missing > 0)
        append(more, sizeof more, "; hatched: no value, %llu pixels", (unsigned long long)missing);
    words_of(o, s, title, more, c);
}

/* Surfaces of a synthetic image that fight; more than can be told apart are not marked. */
static void mark_ties(const frame *f, chart *c) {
    enum { MOST = 256 };
    double at[MOST][2];
    const size_t count = survey_ties(f, MOST, at);
    if (count <= MOST)
        picture_mark(c, count, at, "stored as one code with what is behind: they z-fight");
}

/* Fills the page: the picture in its shape, words above, axes around. */
static int height_of(const texture_request *o, const texture_source *s, int width, int panels) {
    static const double shares[] = {1, 0.53, 0.37}; /* of the width, for each panel */
    if (o->figure.height > 0)
        return o->figure.height;
    const double shape = (double)s->camera.height / s->camera.width, scale = width / (double)WIDTH;
    const double height = ((WIDTH - BESIDE) * shape * shares[panels - 1] + ABOVE) * scale;
    return (int)fmin(fmax(height, HEIGHT_MIN), fmax(HEIGHT_MAX, width));
}

/* From 0 to 1 by nature. Grey under errors is no picture of its own: there it tells the depths apart. */
static bool is_share(const texture_request *o, const texture_product *p) {
    const frame_kind kind = p->made.kind;
    return !p->made.error && ((kind == FRAME_EFFECT && p->made.effect->kind != EFFECT_GAIN) ||
                              ((kind == FRAME_RAW || kind == FRAME_LINEAR01) && !(o->image.overlay > 0)));
}

/* As articles show them: window depth beside eye depth over far, where there is a far plane. */
static bool has_beside(const texture_request *o, const texture_source *s, const texture_product *p) {
    const frame_product linear = {.kind = FRAME_LINEAR01};
    return p->made.kind == FRAME_RAW && is_share(o, p) && s->setup.spec.mapping != DP_MAPPING_LINEAR &&
           frame_refuses(&s->frame, &linear) == NULL;
}

int texture_figure_draw(const texture_request *o, const texture_source *s, const texture_product *p) {
    static const char *const axes[][3] = {{"x (world)", "y (world)", "z (world)"}, {"to the right", "up", "length"}};
    static const char *const raw[] = {"window depth"};
    const int width = o->figure.width > 0 ? o->figure.width : WIDTH;
    const bool is_error = p->made.error, directions = p->made.kind == FRAME_NORMAL && !is_error;
    const bool stacked = frame_channels(&p->made) == 3 && !directions;
    const bool beside = has_beside(o, s, p), overlay = o->image.overlay > 0;
    const bool grey = is_share(o, p) && p->made.kind != FRAME_EFFECT;
    drawing d = {.beside = beside,
                 .shown = {.width = s->camera.width,
                           .height = s->camera.height,
                           .channels = frame_channels(&p->made),
                           .directions = directions,
                           .magnitudes = is_error,
                           .shares = is_share(o, p),
                           .grey = grey,
                           .label = is_error                         ? "error"
                                    : p->made.kind == FRAME_POSITION ? "coordinate"
                                    : beside                         ? "depth"
                                                                     : p->name,
                           .unit = p->unit,
                           .names = stacked  ? axes[p->made.vector]
                                    : beside ? raw
                                             : NULL},
                 .second = {.width = s->camera.width,
                            .height = s->camera.height,
                            .channels = 1,
                            .magnitudes = overlay,
                            .above = o->image.overlay,
                            .label = p->made.radial ? "error of the distance" : "error of eye depth",
                            .unit = "scene units"}};
    output out;
    const int status = output_open(&out, o->image.figure);
    if (status != EXIT_FINE)
        return status;
    chart *c = chart_new();
    const int panels = stacked  ? 3
                       : beside ? 2
                                : 1,
              room = width / panels, fields = room > WIDTH ? room : WIDTH; /* as a panel has room for */
    bool good =
        c != NULL && picture_open(&d.shown, fields, c) && (!(overlay || beside) || picture_open(&d.second, fields, c));
    if (good)
        good = run(o, s, p, &d);
    if (good) {
        describe(o, s, p, &d, c);
        build(o, &d, c);
        mark_ties(&s->frame, c);
        good = !chart_failed(c) &&
               figure_file_write(o->line, &o->figure, o->image.figure, c, width, height_of(o, s, width, panels), &out);
    }
    chart_free(c);
    if (good)
        return output_close(&out);
    output_abandon(&out);
    return usage_error("texture: no memory for the figure");
}

/* The figure and, with --json or --csv, its numbers. */
static int write_histogram(const texture_request *o, const chart *c, output *out) {
    output numbers;
    int status = EXIT_FINE;
    if (!figure_file_write(o->line, &o->figure, o->image.histogram, c, o->figure.width > 0 ? o->figure.width : WIDTH,
                           o->figure.height > 0 ? o->figure.height : HISTOGRAM_HEIGHT, out)) {
        output_abandon(out);
        return usage_error("texture: no memory for the figure");
    }
    if (o->out.form != FORM_TEXT) {
        status = output_start(&o->out, &o->camera, &numbers);
        if (status == EXIT_FINE) {
            figure_data_write(&numbers, o->out.form, "texture", "histogram", c);
            status = output_close(&numbers);
        }
    }
    if (status == EXIT_FINE)
        return output_close(out);
    output_abandon(out);
    return status;
}

int texture_histogram_draw(const texture_request *o, const texture_source *s) {
    const uint64_t pixels = (uint64_t)s->camera.width * s->camera.height;
    uint64_t counted = 0;
    char more[96] = "";
    output out;
    canvas_format type;
    if (s->camera.oblique.on)
        return option_error("histogram", "needs planes that all pixels share, which %s does not have", s->matrix.path);
    int status = figure_file_type(o->line, &o->figure, "histogram", o->image.histogram, &type);
    if (status == EXIT_FINE)
        status = output_open(&out, o->image.histogram);
    if (status != EXIT_FINE)
        return status;
    chart *c = chart_new();
    const bool good =
        c != NULL && histogram_build(&s->frame, texture_is_window(o) || o->image.stereo.focal > 0, c, &counted);
    if (good && counted > 0) {
        if (counted < pixels)
            snprintf(more, sizeof more, "; %llu pixels of sky or holes are left out",
                     (unsigned long long)(pixels - counted));
        words_of(o, s, s->camera.radial ? "Pixels over distance from the camera" : "Pixels over eye depth", more, c);
        status = write_histogram(o, c, &out);
    } else {
        output_abandon(&out);
        status = usage_error(good ? "texture: no pixel has a depth" : "texture: no memory for the figure");
    }
    chart_free(c);
    return status;
}
