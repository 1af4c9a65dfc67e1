/* SPDX-License-Identifier: GPL-3.0-or-later */
/* plot scene: the figure of what scene finds. */
#include "scene/cmd_scene/drawing.h"
#include "scene/cmd_scene/request.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/append.h"
#include "draw/notes.h"
#include "report/number.h"
#include "system/posix.h"

enum { WITHIN_DIGITS = 4 };

int scene_figure_begin(scene *s, const scene_request *o) {
    scene_request view = *o;
    const int status = slant_view(&view.camera);
    return status == EXIT_FINE ? scene_begin(s, &view, o->line->operands[1]) : status;
}

/* The depth from which a pair can fight; NaN: at every one. */
static double fights_from(const scene *s, const scene_finding *f) {
    return s->eyes.count > 0 ? f->sight.fights_from : f->verdict.certain_to;
}

static void describe(const scene *s, const fights_asked *a, chart *c) {
    char label[SETUP_LABEL_SIZE], subtitle[sizeof c->subtitle], name[61]; /* cut between characters */
    snprintf(subtitle, sizeof subtitle, "%s: ", notes_clean(name, sizeof name, path_name(s->file)));
    if (a->count == 0)
        append(subtitle, sizeof subtitle, "no surfaces z-fight");
    else
        append(subtitle, sizeof subtitle, "%zu pair%s of surfaces may z-fight", a->count, a->count == 1 ? "" : "s");
    append(subtitle, sizeof subtitle, " up to %s",
           number_in(number_brief(number_of(s->within, WITHIN_DIGITS)), s->unit).text);
    if (a->count > 0 && isnan(a->item[0].from))
        append(subtitle, sizeof subtitle, ", the darkest at every depth");
    append(subtitle, sizeof subtitle, "; %s", setup_label(&s->setup, true, label));
    if (s->eyes.count > 0)
        append(subtitle, sizeof subtitle, ", seen from %s", s->eyes.count > 1 ? "the worst of the eyes" : "the eye");
    else if (s->setup.spec.triangles.width > 0)
        append(subtitle, sizeof subtitle, ", %s at %d x %d", surfaces_words(&s->setup.spec.triangles).text,
               s->setup.spec.triangles.width, s->setup.spec.triangles.height);
    if (s->unit != NULL)
        append(subtitle, sizeof subtitle, ", lengths in %s", s->unit);
    notes_clean(c->subtitle, sizeof c->subtitle, subtitle);
}

bool scene_figure_take(const scene *s, fights_asked *out, chart *c) {
    fights_item *items = chart_memory(c, s->found.findings + 1, sizeof *items);
    *out = (fights_asked){
        .m = &s->model, .found = &s->found, .item = items, .gap = s->gap, .eye = s->eyes.eye, .eyes = s->eyes.count};
    if (items == NULL)
        return false;
    while (out->count < scene_fighting(s)) {
        const scene_finding *f = &s->findings[out->count];
        items[out->count++] = (fights_item){f->of, fights_from(s, f)};
    }
    c->unit = s->unit;
    describe(s, out, c);
    return true;
}

int scene_figure_height(const chart *c, int width) {
    enum { BESIDE = 150, ABOVE = 150, BETWEEN = 40, LEAST = 300, MOST = 1600 };
    const double scale = width / 800.0, views = (width / scale - BESIDE) / c->shape;
    return (int)fmin(fmax((fmin(views, 1000) + BETWEEN + ABOVE) * scale, LEAST), fmax(MOST, width));
}
