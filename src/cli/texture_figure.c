/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cli/figure_file.h"
#include "cli/progress.h"
#include "cli/setups.h"
#include "cli/texture.h"
#include "core/append.h"
#include "plot/notes.h"
#include "plot/picture.h"
#include "report/number.h"
#include "texture/survey.h"

enum { WIDTH = 800, BESIDE = 150, ABOVE = 130, HEIGHT_MIN = 240, HEIGHT_MAX = 1200 };

typedef struct drawing {
    picture shown;
    progress bar;
    uint64_t done;
} drawing;

static bool take(void *context, uint32_t row, uint32_t count, const float *values) {
    drawing *d = context;
    picture_take(&d->shown, row, count, values);
    progress_step(&d->bar, d->done += count);
    return true;
}

static void words_of(const options *o, const texture_source *s, const texture_product *p, const picture *shown,
                     chart *c) {
    char label[SETUP_LABEL_SIZE], title[sizeof c->title], reduced[96] = "", missing[64] = "",
                                                          subtitle[sizeof c->subtitle];
    const char *slash = s->path != NULL ? strrchr(s->path, '/') : NULL;
    snprintf(title, sizeof title, "%s", p->name);
    if (p->made.kind == FRAME_EFFECT) {
        const int wanted = p->made.effect->wanted;
        append(title, sizeof title, ", %s %s", p->made.effect->parameters[wanted].name,
               number_full(p->made.effect_settings[wanted]).text);
    }
    if (title[0] >= 'a' && title[0] <= 'z')
        title[0] = (char)(title[0] - 'a' + 'A');
    if (shown->columns < (int)s->camera.width)
        snprintf(reduced, sizeof reduced,
                 shown->magnitudes ? "; a point is the largest of %.3g pixels" : "; one of %.3g pixels",
                 (double)s->camera.width / shown->columns * s->camera.height / shown->rows);
    if (shown->missing > 0)
        snprintf(missing, sizeof missing, "; hatched: no value, %llu pixels", (unsigned long long)shown->missing);
    const char *unit = options_unit(o);
    c->unit = unit;
    setup_label(&s->setup, true, label);
    if (o->metric > 0)
        snprintf(label, sizeof label, "metric depth, %g %s a unit", o->metric, unit != NULL ? unit : "scene units");
    else if (unit != NULL)
        append(label, sizeof label, ", lengths in %s", unit);
    snprintf(subtitle, sizeof subtitle, "%s%.100s, %u x %u; %s%s%s", s->path != NULL ? "" : "scene ",
             s->path == NULL ? s->frame.scene->name
             : slash != NULL ? slash + 1
                             : s->path,
             s->camera.width, s->camera.height, label, reduced, missing);
    notes_clean(c->title, sizeof c->title, o->title != NULL ? o->title : title);
    notes_clean(c->subtitle, sizeof c->subtitle, subtitle);
}

/* Surfaces of a scene that fight; more than can be told apart are not marked. */
static void mark_ties(const frame *f, chart *c) {
    enum { MOST = 256 };
    double at[MOST][2];
    const size_t count = survey_ties(f, MOST, at);
    if (count <= MOST)
        picture_mark(c, count, at, "stored as one code with what is behind: they fight");
}

/* Fills the page: the picture in its shape, words above, axes around. */
static int height_of(const options *o, const texture_source *s, int width, bool stacked) {
    if (o->height > 0)
        return o->height;
    const double shape = (double)s->camera.height / s->camera.width, scale = width / (double)WIDTH;
    const double height = ((WIDTH - BESIDE) * shape * (stacked ? 0.37 : 1) + ABOVE) * scale;
    return (int)fmin(fmax(height, HEIGHT_MIN), fmax(HEIGHT_MAX, width));
}

int texture_figure_draw(const options *o, const texture_source *s, const texture_product *p) {
    static const char *const axes[] = {"x (world)", "y (world)", "z (world)"};
    const int width = o->width > 0 ? o->width : WIDTH;
    const bool is_error = p->made.error, directions = p->made.kind == FRAME_NORMAL && !is_error;
    const bool stacked = frame_channels(&p->made) == 3 && !directions;
    drawing d = {.shown = {.width = s->camera.width,
                           .height = s->camera.height,
                           .channels = frame_channels(&p->made),
                           .directions = directions,
                           .magnitudes = is_error,
                           .shares = p->made.kind == FRAME_EFFECT && !is_error && p->made.effect->kind != EFFECT_GAIN,
                           .label = is_error                         ? "error"
                                    : p->made.kind == FRAME_POSITION ? "coordinate"
                                                                     : p->name,
                           .unit = p->unit,
                           .names = stacked ? axes : NULL}};
    output out;
    const int status = output_open(&out, o->figure);
    if (status != EXIT_FINE)
        return status;
    chart *c = chart_new();
    const int fields = stacked ? width / 3 : width; /* no more than a panel has room for */
    bool good = c != NULL && picture_open(&d.shown, fields > WIDTH ? fields : WIDTH, c);
    if (good) {
        d.bar = progress_start("rows", s->camera.height, o->quiet);
        good = frame_run(&s->frame, &p->made, false, take, &d);
        progress_end(&d.bar);
    }
    if (good) {
        words_of(o, s, p, &d.shown, c);
        picture_build(&d.shown, c);
        mark_ties(&s->frame, c);
        good = !chart_failed(c) && figure_file_write(o, o->figure, c, width, height_of(o, s, width, stacked), &out);
    }
    chart_free(c);
    if (good)
        return output_close(&out);
    output_abandon(&out);
    return usage_error("texture: no memory for the figure");
}
