/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The words around the tables of shadow. */
#include <math.h>
#include <stdio.h>

#include "core/append.h"
#include "report/number.h"
#include "shadow/cmd_shadow/report.h"

static void say_place(page *p, const shadow *s) {
    const shadow_light *l = &s->maps.whole;
    const bool distance = shadow_holds_distance(l);
    shadow_need need;
    shadow_need_of(l, &need);
    page_title(p, "%s light, %s%s degrees, near %s, far %s, texel %s at %s 1",
               l->kind == SHADOW_SPOT ? "spot" : "point", l->kind == SHADOW_SPOT ? "" : "six faces of ",
               number_full(l->fov).text, number_full(l->setup.spec.znear).text, number_full(l->setup.spec.zfar).text,
               number_of(need.per_offset, DIGITS).text, distance ? "distance" : "depth");
    page_title(p, "receivers at %s from %s to %s%s", distance ? "distances" : "depths",
               number_up(l->receiver_lo, DIGITS).text, number_down(l->receiver_hi, DIGITS).text,
               distance ? "; a fragment shader writes (distance - near)/(far - near)" : "");
}

static void say_maps(page *p, void *item) {
    const shadow *s = item;
    const shadow_request *o = &s->o;
    const shadow_split *v = &s->maps.view;
    const dp_triangles *t = &o->camera.triangles;
    p->unit = s->unit;
    page_title(p, "%s %s, %ux%u texels, filter %ux%u, angles up to %s degrees%s%s", s->format, s->mapping,
               o->shadow.size[0], o->shadow.size[1], o->shadow.kernel, o->shadow.kernel,
               number_full(o->shadow.angle).text, p->unit != NULL ? ", in " : "", p->unit != NULL ? p->unit : "");
    if (v->count > 0) {
        page_title(p, "view near %s, far %s, fov %s, %dx%d", number_full(v->znear).text, number_full(v->zfar).text,
                   number_of(v->fov_y, DIGITS).text, t->width, t->height);
        page_title(p, "%d cascade%s, lambda %s, casters up to %s towards the light", v->count, v->count == 1 ? "" : "s",
                   number_full(v->lambda).text, number_full(v->casters).text);
        if (option_given(o->line, "camera-depth"))
            page_title(p, "receivers rebuilt from the camera's depth, %s", option_text(o->line, "camera-depth"));
    } else if (s->maps.whole.kind != SHADOW_SUN) {
        say_place(p, s);
    } else {
        const double texel =
            fmax(o->shadow.light_box[0] / o->shadow.size[0], o->shadow.light_box[1] / o->shadow.size[1]);
        page_title(p, "box %s x %s, %s deep along the light, texel %s", number_full(o->shadow.light_box[0]).text,
                   number_full(o->shadow.light_box[1]).text, number_full(o->shadow.light_box[2]).text,
                   number_of(texel, DIGITS).text);
        if (s->lit.lo > 0.0 || s->lit.hi < o->shadow.light_box[2])
            page_title(p, "receivers from %s to %s along the light%s", number_up(s->lit.lo, DIGITS).text,
                       number_down(s->lit.hi, DIGITS).text,
                       option_given(o->line, "range") ? "" : ": units have no effect at depth 0");
    }
    page_title(p, "%d subpixel bit%s, triangles from 1 to %s texels, aspect ratio at most %s:1, %s", t->subpixel,
               t->subpixel == 1 ? "" : "s", number_full(t->pixels).text, number_full(t->slim).text, s->arith);
    if (option_given(o->line, "curvature"))
        page_title(p, "receivers curve away with a radius of at least %s, triangles of circumradius %s",
                   number_full(o->shadow.curvature).text, number_full(o->shadow.facet).text);
}

static bool writes_distance(const shadow *s) {
    return s->o.shadow.distance;
}

/* One API: what to write. All: what follows is a table of them. */
void shadow_say_answer(page *p, void *item) {
    const shadow *s = item;
    const char *where = s->maps.view.count > 1 ? " in any cascade" : "";
    say_maps(p, item);
    shadow_say_given(p, &s->o, &s->maps);
    if (s->api == NULL && !writes_distance(s)) {
        page_text(p, "No acne%s with the constant U, with F and its U, or with the offset and its U:", where);
        return;
    }
    const shadow_whole w = shadow_whole_of(&s->maps, shadow_asked_api(&s->o, 0));
    page_text(p, "No acne%s with any one of these:", where);
    for (int k = 0; k < SHADOW_WAY_COUNT; k++)
        page_note(p, shadow_way_name((shadow_way)k), "%s",
                  !isnan(w.way[k].units)   ? w.way[k].call
                  : writes_distance(s)     ? "no API biases a depth that a fragment shader writes"
                  : isnan(w.way[k].factor) ? "no bias suffices: the smallest triangles may lose half of their slope"
                                           : "no bias suffices");
}

void shadow_say_heads(page *p, void *item) {
    const shadow *s = item;
    const int split = s->maps.view.count > 0 || s->maps.whole.kind != SHADOW_SUN ? 8 : 0;
    output_char(p->out, '\n');
    if (p->fitted && p->width < 68 + split) {
        page_text(p, "constant bias: units, gap; slope-scaled: factor, units, gap; normal offset: offset, units, gap");
        return;
    }
    output_format(p->out, "%s%*s%18s%25s%25s%s\n", p->soft, split, "", "constant bias", "slope-scaled", "normal offset",
                  p->plain);
}

/* The largest cause in words, and how to make it smaller. */
static const char *why(const double cause[SHADOW_CAUSE_COUNT]) {
    static const char filter[] =
        "steep receivers within the filter: smaller texels, a smaller kernel or angle need less";
    static const char position[] = "positions in binary32: a box that is less deep, nearer the origin, needs less";
    static const char *const words[SHADOW_CAUSE_COUNT] = {
        [SHADOW_CAUSE_TEXEL] = filter,
        [SHADOW_CAUSE_KERNEL] = filter,
        [SHADOW_CAUSE_LOOKUP] = "texture coordinates are rounded: a map of fewer texels needs less",
        [SHADOW_CAUSE_SNAPPING] = "vertices move to the subpixel grid: more --subpixel bits need less",
        [SHADOW_CAUSE_SETUP] = "planes of thin triangles in binary32: a --triangle-class of stouter ones needs less",
        [SHADOW_CAUSE_POSITION] = position,
        [SHADOW_CAUSE_RECEIVER] = "receivers come from the camera's depth: a finer format or a nearer far needs less",
        [SHADOW_CAUSE_FORMAT] = "codes of the format: more bits, or a box that is less deep, need less"};
    double of[SHADOW_CAUSE_COUNT];
    size_t most = 0;
    for (size_t k = 0; k < SHADOW_CAUSE_COUNT; k++) /* the filter's radius is one thing */
        of[k] = k == SHADOW_CAUSE_TEXEL ? cause[k] + cause[SHADOW_CAUSE_KERNEL] : cause[k];
    for (size_t k = 1; k < SHADOW_CAUSE_COUNT; k++)
        most = of[k] > of[most] ? k : most;
    return words[most];
}

/* Says the causes in the map where the least share of the constant bias is needed by any reckoning. */
static void say_causes(page *p, const shadow *s) {
    char text[256] = "";
    shadow_row least = shadow_row_of(&s->maps, 0, shadow_asked_api(&s->o, 0));
    for (size_t i = 1; i < s->maps.count; i++) {
        const shadow_row r = shadow_row_of(&s->maps, i, shadow_asked_api(&s->o, 0));
        if (r.way[SHADOW_CONSTANT].share < least.way[SHADOW_CONSTANT].share)
            least = r;
    }
    double sum = 0.0;
    for (int k = 0; k < SHADOW_CAUSE_COUNT; k++)
        sum += least.cause[k];
    for (int k = 0; k < SHADOW_CAUSE_COUNT; k++)
        if (least.cause[k] >= 0.0005 * sum)
            append(text, sizeof text, "%s%s %s %%", text[0] != '\0' ? ", " : "", shadow_cause_name((shadow_cause)k),
                   number_of(100.0 * least.cause[k] / sum, 3).text);
    page_note(p, "why", "%s", why(least.cause));
    if (s->maps.view.count > 1)
        page_note(p, "causes", "cascade %d: %s", least.cascade, text);
    else if (s->maps.whole.kind != SHADOW_SUN)
        page_note(p, "causes", "at %s: %s", number_of(least.z, DIGITS_Z).text, text);
    else
        page_note(p, "causes", "%s", text);
}

/* How much wider than needed the constant bias is where a unit is worth most. */
static double worth(const shadow *s) {
    double most = 1.0;
    for (size_t i = 0; i < s->maps.count; i++) {
        const shadow_row r = shadow_row_of(&s->maps, i, s->api);
        most = fmax(most, r.way[SHADOW_CONSTANT].gap / (r.way[SHADOW_CONSTANT].window * r.depth));
    }
    return most;
}

static number_text percent_text(double share) {
    number_text out = number_down(100.0 * share, 2);
    if (!isnan(share))
        append(out.text, sizeof out.text, " %%");
    return out;
}

static const char *offset_words(const shadow *s) {
    return s->maps.whole.kind == SHADOW_SUN ? "in texels, times the sine of the angle, along the surface normal"
           : writes_distance(s)
               ? "in texels at the point's distance, times the sine of the angle, along the surface normal"
               : "in texels at the point's depth, at any angle, along the surface normal";
}

/* A light that has a place. */
static void say_of_place(page *p, const shadow *s, const shadow_whole *w) {
    const double angle = s->o.shadow.angle;
    page_note(p, "on axis", "of a plane at %s degrees there, steepest along a row of texels, by the filter alone",
              number_full(angle).text);
    page_note(p, "rows", "units that are needed at that %s; the gap there of those that are enough at all",
              writes_distance(s) ? "distance" : "depth");
    if (s->o.shadow.point && s->o.shadow.kernel > 1)
        page_note(p, "seam", "%s",
                  writes_distance(s)
                      ? "distances are the same in both faces: nothing more is needed"
                      : "constant and offset cover lookups across the edges of faces; slope-scaled bias only "
                        "those that stay in a face, as the next one slopes otherwise");
    if (w->hidden)
        page_note(p, "far plane", "a bias reaches to it: nothing there is in shadow");
    else if (w->limited)
        page_note(p, "far plane", "a gap reaches beyond it: casters there cast no shadow");
}

void shadow_say_engines(page *p, void *item) {
    shadow *s = item;
    shadow_engine_row r;
    page_note(p, "least", "bias that is enough beside that normal bias, and the other way round; -: none is");
    for (size_t i = 0; shadow_engine_row_of(&s->o, &s->maps, i, &r); i++)
        if (r.unconfirmed != NULL)
            page_note(p, r.engine, "not confirmed: %s", r.unconfirmed);
}

void shadow_say_notes(page *p, void *item) {
    const shadow *s = item;
    const bool place = s->maps.whole.kind != SHADOW_SUN;
    const shadow_whole w = shadow_whole_of(&s->maps, shadow_asked_api(&s->o, 0));
    const bool real = s->maps.items[0].light.setup.spec.format.kind == DP_FORMAT_FLOAT;
    const double wide = place ? 1.0 : worth(s);
    page_note(p, "gap", "largest from a caster to its shadow, along the light; %s, %s and %s facing it",
              number_up(w.way[0].gap_facing, DIGITS_GAP).text, number_up(w.way[1].gap_facing, DIGITS_GAP).text,
              number_up(w.way[2].gap_facing, DIGITS_GAP).text);
    page_note(p, "offset", "%s", offset_words(s));
    say_causes(p, s);
    page_note(p, "needed", "%s, %s and %s of these by slope times filter radius alone",
              percent_text(w.way[0].share).text, percent_text(w.way[1].share).text, percent_text(w.way[2].share).text);
    if (isnan(w.way[SHADOW_CONSTANT].units) && w.way[SHADOW_CONSTANT].window < 1.0 && real)
        page_note(p, "units", "have no effect at window depth 0 of a float format: %s",
                  s->view != NULL ? "--casters keeps surfaces away from it" : "--range LO:HI says where receivers lie");
    if (wide > 1.5)
        page_note(p, "units", "%s: the gap is up to %s times what is needed",
                  real ? "grow with the depth in a float format" : "may be larger than assumed",
                  number_up(wide, 2).text);
    if (place)
        say_of_place(p, s, &w);
    else if (w.hidden)
        page_note(p, "far plane", "a bias is as large as the box is deep: nothing is in shadow");
    else if (option_given(s->o.line, "range") && w.limited)
        page_note(p, "far plane", "a gap reaches beyond it: casters there cast no shadow");
}

void shadow_say_trials(page *p, void *item) {
    const shadow *s = item;
    if (s->trials > 0)
        shadow_say_trial(p, s->trial);
}

void shadow_say_calls(page *p, void *item) {
    const shadow *s = item;
    page_line(p, "offset: %s", offset_words(s));
    output_char(p->out, '\n');
    const bias_api *api;
    for (size_t i = 0; (api = bias_asked_api(&s->o.bias, i)) != NULL; i++)
        page_note(p, api->name, "%s%s", api->call, api->sloped);
}
