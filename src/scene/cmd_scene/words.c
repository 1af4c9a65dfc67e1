/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The findings of `scene` as text. */
#include "scene/cmd_scene/request.h"
#include "scene/cmd_scene/scene.h"

#include <math.h>
#include <stdio.h>

#include "bias/cmd_bias/call.h"
#include "core/append.h"
#include "draw/notes.h"
#include "report/number.h"
#include "report/page.h"

enum { DIGITS = 4, SHOWN_MOST = 20, WORD_SIZE = 41, NAME_SIZE = 128, LINE_SIZE = 2 * NAME_SIZE + 8, TOOK_SIZE = 40 };

static number_text length(const page *p, double value) {
    return number_in(number_brief(number_of(value, DIGITS)), p->unit);
}

/* A length in words: one that was typed, as it was. */
static number_text asked(const page *p, const scene *s, double value) {
    const number_text typed = camera_length(&s->o.camera, value, DIGITS),
                      plain = number_in(number_of(value, DIGITS), p->unit);
    return strcmp(typed.text, plain.text) == 0 ? length(p, value) : typed;
}

static const char *called(const scene_named *n, char out[NAME_SIZE]) {
    const char *name = n->node != NULL ? n->node : n->mesh != NULL ? n->mesh : "(no name)";
    char word[WORD_SIZE]; /* cut between characters */
    snprintf(out, NAME_SIZE, "'%s'", notes_clean(word, sizeof word, name));
    if (n->material != NULL)
        append(out, NAME_SIZE, " (%s)", notes_clean(word, sizeof word, n->material));
    return out;
}

char *scene_surfaces(const scene_finding *f, char *out, size_t size) {
    char a[NAME_SIZE], b[NAME_SIZE];
    snprintf(out, size, "%s and %s", called(&f->a, a), called(&f->b, b));
    return out;
}

size_t scene_fighting(const scene *s) {
    size_t n = 0;
    while (n < s->found.findings &&
           (s->eyes.count > 0 ? !isnan(s->findings[n].sight.fights_from) : s->findings[n].fights))
        n++;
    return n;
}

/* How many more, from an eye, are told apart only if their triangles are cut; they come next. */
static size_t uncovered(const scene *s) {
    const size_t fights = scene_fighting(s);
    size_t n = fights;
    while (n < s->found.findings && !s->findings[n].sight.covered)
        n++;
    return n - fights;
}

static void say_eyes(page *p, const scene *s) {
    const scene_eyes *e = &s->eyes;
    if (e->count == 0)
        return;
    if (e->count > 1)
        page_title(p, "from the worst of the %zu eyes of %s", e->count, e->path);
    else
        page_title(p, "from %s%s%s%s %s %s, looking along %s %s %s", e->camera != NULL ? "camera '" : "",
                   e->camera != NULL ? e->camera : "", e->camera != NULL ? "' at " : "",
                   number_of(e->from.x, DIGITS).text, number_of(e->from.y, DIGITS).text,
                   number_of(e->from.z, DIGITS).text, number_of(e->ahead.x, DIGITS).text,
                   number_of(e->ahead.y, DIGITS).text, number_of(e->ahead.z, DIGITS).text);
}

/* The condition of what is not covered; a mapping not affine on the screen guarantees no slanted triangles. */
static const char *condition_of(const scene *s) {
    return s->setup.spec.model == DP_MODEL_FLOAT ? "if cut into the triangles above" : "facing the camera";
}

/* "none", "3" or "all" of those seen. */
static number_text how_many(size_t fights, size_t of) {
    number_text out;
    snprintf(out.text, sizeof out.text, fights == 0 ? "none" : fights == of && of > 1 ? "all" : "%zu", fights);
    return out;
}

static void say_seen(page *p, const scene *s) {
    const size_t count = s->found.findings, fights = scene_fighting(s), cut = uncovered(s);
    size_t seen = 0;
    for (size_t i = 0; i < count; i++)
        seen += isnan(s->findings[i].sight.seen_from) ? 0 : 1;
    page_text(p, "%zu pair%s of surfaces lie%s within %s of each other: %zu visible, %s may z-fight.", count,
              count == 1 ? "" : "s", count == 1 ? "s" : "", asked(p, s, s->gap).text, seen,
              how_many(fights, seen).text);
    if (cut > 0)
        page_text(p, "%zu more %s resolved only %s.", cut, cut == 1 ? "is" : "are", condition_of(s));
}

/* From every place: of surfaces that face the camera, unless slants were asked about. */
static void say_everywhere(page *p, const scene *s) {
    const size_t count = s->found.findings;
    char also[SLANT_ASSUMED_SIZE + 64] = "", view[SLANT_ASSUMED_SIZE];
    if (s->assumed != NULL && s->assumed->fights > 0)
        snprintf(also, sizeof also, ", at least %zu at any slant (%s)", (size_t)s->assumed->fights,
                 slant_assumed(&s->view, view));
    else if (s->assumed != NULL)
        snprintf(also, sizeof also, ", none of them at any slant (%s)", slant_assumed(&s->view, view));
    page_text(p, "%zu pair%s of surfaces lie%s within %s of each other: %s may z-fight%s up to %s%s.", count,
              count == 1 ? "" : "s", count == 1 ? "s" : "", asked(p, s, s->gap).text,
              how_many(scene_fighting(s), count).text, s->triangles == NULL ? " " SLANT_FACING : "",
              asked(p, s, s->within).text, also);
}

/* " (0.012 ms)" with --full, else nothing. */
static const char *took(const scene *s, const scene_simpler *m, char out[TOOK_SIZE]) {
    out[0] = '\0';
    if (s->o.out.full)
        snprintf(out, TOOK_SIZE, " (%s ms)", number_of(1e3 * m->seconds, 2).text);
    return out;
}

/* Which model decided, and whether a simpler one would have: the simplest that does, else in how many none does. */
static void say_models(page *p, const scene *s) {
    char said[LINE_SIZE] = "", time[TOOK_SIZE];
    const bool slanted = s->setup.spec.triangles.width > 0, shader = s->setup.shader;
    for (size_t i = 0; i < s->model_count; i++) {
        const scene_simpler *m = &s->models[i];
        const char *const which = strcmp(m->model, "float") == 0 ? " " SLANT_FACING : "";
        if (m->differs == 0) {
            snprintf(said, sizeof said, "; %s%s decides alike%s", m->model, which, took(s, m, time));
            break;
        }
        append(said, sizeof said, i == 0 ? "; %s%s differs in %zu%s" : ", %s%s in %zu%s", m->model, which,
               (size_t)m->differs, took(s, m, time));
    }
    page_text(p, "Decided in %s, %s%s%s%s.", shader ? "float, of the shader" : s->decided.model, slanted ? "at " : "",
              slanted ? s->decided.surfaces.text : SLANT_FACING, took(s, &s->decided, time), said);
}

void scene_say_head(page *p, void *of) {
    const scene *s = of;
    const model_notes *n = &s->model.notes;
    const size_t count = s->found.findings;
    p->unit = s->unit;
    page_title(p, "%s: %zu triangle%s, %zu surface%s, %s across; judged up to %s", s->file, s->model.triangles,
               s->model.triangles == 1 ? "" : "s", s->model.surfaces, s->model.surfaces == 1 ? "" : "s",
               length(p, s->extent).text, asked(p, s, s->within).text);
    setup_title(p, &s->setup, &s->fields);
    slant_say(p, page_title, &s->o.camera, &s->setup);
    say_eyes(p, s);
    if (n->skinned + n->morphed + n->animated > 0)
        page_title(p, "in the rest pose: %zu skinned and %zu morphed meshes, %zu animated nodes", n->skinned,
                   n->morphed, n->animated);
    if (count == 0)
        page_text(p, "No surfaces lie within %s of each other.", asked(p, s, s->gap).text);
    else if (s->eyes.count > 0)
        say_seen(p, s);
    else
        say_everywhere(p, s);
    if (count > 0)
        say_models(p, s);
    if (s->required)
        page_text(p, "%s%s%s  %s nearer than %s.", s->passed ? p->good : p->bad, s->passed ? "pass" : "FAIL", p->plain,
                  s->passed ? "no surfaces z-fight" : "surfaces may z-fight", asked(p, s, s->within).text);
}

static number_text safe_length(const page *p, double value, bool upward) {
    return number_in(number_brief(upward ? number_up(value, DIGITS) : number_down(value, DIGITS)), p->unit);
}

/* A gap is measured to 1e-12 of the extent: below that it is none. */
static void add_gap(const page *p, const scene *s, const scene_finding *f, char *text, size_t size) {
    const double none = SCENE_NO_GAP * s->extent;
    const number_text lo = length(p, f->gap_min > none ? f->gap_min : 0.0);
    const number_text hi = length(p, f->gap_max > none ? f->gap_max : 0.0);
    if (f->gap_max <= none) {
        append(text, size, "coplanar");
        return;
    }
    if (strcmp(lo.text, hi.text) != 0)
        append(text, size, "%s to ", number_brief(number_of(f->gap_min > none ? f->gap_min : 0.0, DIGITS)).text);
    append(text, size, "%s apart", hi.text);
}

/* "seen from 3 m to 9 m: may z-fight from 5 m on". */
static void add_sight(const page *p, const scene *s, const scene_finding *f, char *out, size_t size) {
    const scene_sight *e = &f->sight;
    append(out, size, "seen from %s to %s: ", safe_length(p, e->seen_from, false).text,
           safe_length(p, e->seen_to, true).text);
    if (isnan(e->fights_from))
        append(out, size, "resolved only %s", condition_of(s));
    else if (e->fights_from > e->seen_from)
        append(out, size, "may z-fight from %s on", safe_length(p, e->fights_from, false).text);
    else
        append(out, size, "may z-fight");
    if (!isnan(f->line))
        append(out, size, ", worst at line %.0f", f->line);
}

static void add_verdict(const page *p, const scene_verdict *v, char *out, size_t size) {
    if (isnan(v->certain_to))
        append(out, size, "never safe");
    else
        append(out, size, "safe up to %s", safe_length(p, v->certain_to, false).text);
    if (!isnan(v->ties_from))
        append(out, size, ", z-fights from %s on", safe_length(p, v->ties_from, true).text);
}

static char *sentence(const scene *s, const scene_finding *f, char *out, size_t size) {
    const page p = {.unit = s->unit};
    out[0] = '\0';
    if (s->eyes.count > 0)
        add_sight(&p, s, f, out, size);
    else
        add_verdict(&p, &f->verdict, out, size);
    append(out, size, "; ");
    add_gap(&p, s, f, out, size);
    return out;
}

static void add_place(const scene_finding *f, char *out, size_t size) {
    append(out, size, "area %s, near %s %s %s", number_brief(number_of(f->area, DIGITS)).text,
           number_of(f->place.x, DIGITS).text, number_of(f->place.y, DIGITS).text, number_of(f->place.z, DIGITS).text);
}

/* Nothing where that is enough as it is, or no distance is. */
static void add_lift(const page *p, const scene *s, const scene_finding *f, char *out, size_t size) {
    const double lift = f->verdict.lift;
    if (lift > 0.0 && isfinite(lift))
        append(out, size, "separate by another %s: safe %sup to %s", safe_length(p, lift, true).text,
               s->eyes.count > 1 ? "from there " : "", asked(p, s, s->within).text);
}

char *scene_message(const scene *s, const scene_finding *f, char *out, size_t size) {
    const page p = {.unit = s->unit};
    char lift[LINE_SIZE] = "";
    sentence(s, f, out, size);
    append(out, size, "; ");
    add_place(f, out, size);
    add_lift(&p, s, f, lift, sizeof lift);
    append(out, size, "%s%s", *lift != '\0' ? "; " : "", lift);
    return out;
}

static void say_finding(page *p, const scene *s, size_t i) {
    const scene_finding *f = &s->findings[i];
    char label[16], text[LINE_SIZE], place[LINE_SIZE] = "", lift[LINE_SIZE] = "";
    snprintf(label, sizeof label, "%zu", i + 1);
    page_note(p, label, "%s", scene_surfaces(f, text, sizeof text));
    page_note(p, "", "%s", sentence(s, f, text, sizeof text));
    add_place(f, place, sizeof place);
    page_note(p, "", "%s", place);
    if (f->wrong_pixels > 0.0)
        page_note(p, "", "%.0f pixel%s wrong", f->wrong_pixels, f->wrong_pixels == 1.0 ? "" : "s");
    add_lift(p, s, f, lift, sizeof lift);
    if (*lift != '\0')
        page_note(p, "", "%s", lift);
}

void scene_bias_take(scene *s) {
    const dp_setup *setup = &s->setup;
    const double least = bias_factor_least(setup), znear = setup->spec.znear;
    const bias_api api = profile_bias(&s->o.camera.gpu, s->o.camera.platform, s->o.bias.api, &setup->spec.format);
    const bias_goal goal = {.api = &api, .factor = least};
    double units = HUGE_VAL, z;
    if (isfinite(least) && s->within > znear)
        units = bias_needed_over(setup, &goal, znear, s->within, &z);
    units = bias_signed(setup, units);
    s->bias = (scene_bias){s->o.bias.api->name, units, isnan(units) ? units : least * bias_sign(setup)};
}

static void say_bias(page *p, const scene *s) {
    if (isnan(s->bias.units))
        page_text(p, "No depth bias of %s keeps either surface in front up to %s.", s->bias.api,
                  asked(p, s, s->within).text);
    else
        page_text(p, "Or bias what is drawn second: %s; suffices up to %s%s.",
                  bias_call(s->o.bias.api, s->bias.units, s->bias.factor).text, asked(p, s, s->within).text,
                  s->triangles != NULL ? " in triangles as above"
                                       : " where they face the camera; --viewport includes slants");
}

static void say_picture(page *p, const scene *s) {
    const scene_rendered *r = s->picture;
    char others[64] = "", from[128] = "";
    if (r->wrong_found < r->wrong_pixels)
        snprintf(others, sizeof others, ", %llu of them of no pair above",
                 (unsigned long long)(r->wrong_pixels - r->wrong_found));
    if (s->eyes.count == 0) /* else it stands above */
        snprintf(from, sizeof from, "; from %s %s %s", number_of(r->eye.x, DIGITS).text,
                 number_of(r->eye.y, DIGITS).text, number_of(r->eye.z, DIGITS).text);
    page_text(p, "%s: %d x %d pixels as %s draws them, %llu wrong%s%s.", r->file, r->width, r->height, r->raster,
              (unsigned long long)r->wrong_pixels, others, from);
}

void scene_say_notes(page *p, void *of) {
    const scene *s = of;
    const size_t fights = scene_fighting(s) + (s->eyes.count > 0 ? uncovered(s) : 0);
    const size_t shown = fights < SHOWN_MOST ? fights : SHOWN_MOST;
    for (size_t i = 0; i < shown; i++)
        say_finding(p, s, i);
    if (fights > shown)
        page_text(p, "%zu more: --json and --csv list all.", fights - shown);
    if (scene_fighting(s) > 0)
        say_bias(p, s);
    if (s->picture != NULL)
        say_picture(p, s);
    for (size_t k = 0; k < FINDER_FILTERS; k++)
        if (s->found.left_out[k] > 0)
            page_line(p, "left out: %zu pairs of triangles %s (--also %s)", s->found.left_out[k],
                      finder_filter_get(k)->note, finder_filter_get(k)->name);
    if (s->found.degenerate > 0)
        page_line(p, "left out: %zu triangles without area", s->found.degenerate);
    if (s->found.cut)
        page_line(p, "incomplete: too many triangles lie in one place, and not all pairs were judged");
}
