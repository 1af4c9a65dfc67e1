/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * world: how far from the origin a world may reach: what each scheme costs in view z, in the separation that is safe
 * and in pixels of jitter, how far that suffices, and which is enough.
 */
#include <math.h>
#include <stdio.h>

#include "camera/cmd/setups.h"
#include "core/append.h"
#include "core/elementary.h"
#include "report/number.h"
#include "world/cmd_world/request.h"
#include "world/reach.h"

enum { DIGITS = 3 };
enum { AT_DISTANCE = 1, LABEL_SIZE = 48 };

static const double one_pixel = 1.0;

/* A scheme, at the distance at hand where there is one. */
typedef struct line {
    char label[LABEL_SIZE]; /* "split:65536" */
    const char *name;
    double size;              /* NaN: it has none */
    double off, gap, jitter;  /* NaN: no distance was asked about */
    bool safe, still;         /* the gap; less than a pixel */
    const char *verdict;      /* null: no distance */
    double safe_to, still_to; /* scene units; INFINITY: as far as is asked */
} line;

/* The question, completed. */
typedef struct world {
    world_request o; /* camera, view, gap and depth filled in */
    double wanted, z;
    depths distances; /* count is 0 when not asked about any */
    setups all;
    const dp_setup *setup; /* the one at hand */
    setup_fields fields;
    world_asked asked;
    double distance;   /* the one at hand; NaN: none */
    bool fails;        /* a scheme does, there */
    const char *least; /* the first scheme that is enough there; null: none, or no distance */
    char least_label[LABEL_SIZE];
    int width, height;
    double fov;
    line line;
} world;

/* ---- What is measured -------------------------------------------------------------------------------------------- */

static void label_of(const world_scheme *s, char out[LABEL_SIZE]) {
    snprintf(out, LABEL_SIZE, "%s%s%s", s->row->name, s->row->size != NULL ? ":" : "",
             s->row->size != NULL ? number_full(s->size).text : "");
}

static bool is_enough(const world *w, const world_scheme *s) {
    return world_separation(s, &w->asked, w->distance) <= w->wanted &&
           world_jitter(s, &w->asked, w->distance) < one_pixel;
}

static double reach_or_inf(world_loss *loss, const world_scheme *s, const world_asked *a, double limit) {
    const double to = world_reach(loss, s, a, limit);
    return to >= WORLD_FARTHEST ? (double)INFINITY : to;
}

static void fill_line(world *w, const world_scheme *s) {
    static const char *const verdicts[2][2] = {{"z-fights, jitters", "z-fights"}, {"jitters", "holds"}};
    line *l = &w->line;
    *l = (line){.name = s->row->name, .size = s->row->size != NULL ? s->size : (double)NAN};
    label_of(s, l->label);
    l->safe_to = reach_or_inf(world_separation, s, &w->asked, w->wanted);
    l->still_to = reach_or_inf(world_jitter, s, &w->asked, one_pixel);
    l->off = l->gap = l->jitter = (double)NAN;
    if (isnan(w->distance))
        return;
    l->off = world_off(s, &w->asked, w->distance);
    l->gap = world_separation(s, &w->asked, w->distance);
    l->jitter = world_jitter(s, &w->asked, w->distance);
    l->safe = l->gap <= w->wanted;
    l->still = l->jitter < one_pixel;
    w->fails = w->fails || !l->safe || !l->still;
    l->verdict = verdicts[l->safe][l->still];
}

static void *next_setup(void *of, size_t i) {
    world *w = of;
    if (i == w->all.count)
        return NULL;
    w->setup = &w->all.items[i];
    w->asked.setup = w->setup;
    w->fields = setup_fields_asked(w->setup, &w->o.camera);
    return w;
}

static void *next_distance(void *of, size_t i) {
    world *w = of;
    if (i == (w->distances.count > 0 ? w->distances.count : 1))
        return NULL;
    w->distance = w->distances.count > 0 ? depths_get(&w->distances, i) : (double)NAN;
    w->least = NULL;
    w->fails = false;
    for (size_t k = 0; k < w->o.origin.scheme_count && w->distances.count > 0 && w->least == NULL; k++)
        if (is_enough(w, &w->o.origin.schemes[k])) {
            label_of(&w->o.origin.schemes[k], w->least_label);
            w->least = w->least_label;
        }
    return w;
}

static void *next_line(void *of, size_t i) {
    world *w = of;
    if (i == w->o.origin.scheme_count)
        return NULL;
    fill_line(w, &w->o.origin.schemes[i]);
    return &w->line;
}

/* ---- Text -------------------------------------------------------------------------------------------------------- */

static void say_setup(page *p, void *item) {
    world *w = item;
    setup_title(p, w->setup, &w->fields);
    page_text(p, "%s apart and %s ahead, %s; a view of %dx%d pixels, fov %s",
              camera_length(&w->o.camera, w->wanted, 0).text, camera_length(&w->o.camera, w->z, 0).text,
              w->asked.shared_origin ? "meshes with one origin" : "meshes with their own origins", w->width, w->height,
              number_of(w->fov, 4).text);
}

static void say_distance(page *p, void *item) {
    const world *w = item;
    if (isnan(w->distance))
        return;
    output_char(p->out, '\n');
    page_title(p, "%s from the origin: %s%s", camera_length(&w->o.camera, w->distance, 0).text,
               w->least != NULL ? w->least : "none", w->least != NULL ? " suffices" : " of them suffices");
}

/* How far apart the numbers are that a coordinate there may be. */
static void say_why(page *p, const world *w) {
    const float at = (float)w->distance;
    const double step = (double)(nextafterf(at, HUGE_VALF) - at);
    const number_text apart = number_in(number_of(step, DIGITS), p->unit);
    if (step > w->wanted)
        page_line(p,
                  "why: binary32 numbers %s from the origin are %s apart, %s times the %s that is asked for: a scheme "
                  "holds only where none of its numbers is so large",
                  camera_length(&w->o.camera, w->distance, 0).text, apart.text,
                  number_of(step / w->wanted, DIGITS).text, camera_length(&w->o.camera, w->wanted, 0).text);
    else
        page_line(p,
                  "why: binary32 numbers %s from the origin are %s apart; matrices and sums in which they occur round "
                  "several times",
                  camera_length(&w->o.camera, w->distance, 0).text, apart.text);
}

/* Says the reach; for a single scheme and no distance the answer is a sentence. */
static void say_reach(page *p, void *item) {
    world *w = item;
    if (w->fails)
        say_why(p, w);
    if (!isnan(w->distance) || w->o.origin.scheme_count != 1)
        return;
    const line *l = &w->line;
    const number_text gap = camera_length(&w->o.camera, w->wanted, 0);
    if (isinf(l->safe_to))
        page_text(p, "%s: %s is safe everywhere", l->label, gap.text);
    else
        page_text(p, "%s: %s is safe to %s", l->label, gap.text,
                  number_in(number_brief(number_down(l->safe_to, DIGITS)), p->unit).text);
    if (isfinite(l->still_to))
        page_text(p, "Jitter of a pixel at %s from %s on", camera_length(&w->o.camera, w->z, 0).text,
                  number_in(number_brief(number_down(l->still_to, DIGITS)), p->unit).text);
}

static const column line_columns[] = {
    {FIELD(line, name, "scheme", "")},
    {FIELD(line, size, "size", "scene")},
    {TEXT_FIELD(line, label, "scheme", -14, 0)},
    {FIELD(line, off, "view_z_error", "scene"), SHOWN("z off", 9, DIGITS), .upward = true, .brief = true,
     .when = AT_DISTANCE},
    {FIELD(line, gap, "safe_gap", "scene"), SHOWN("safe gap", 9, DIGITS), .upward = true, .brief = true,
     .when = AT_DISTANCE},
    {FIELD(line, jitter, "jitter", "pixels"), SHOWN("jitter", 8, DIGITS), .upward = true, .brief = true,
     .when = AT_DISTANCE},
    {FIELD(line, safe_to, "safe_to", "scene"), SHOWN("safe to", 9, DIGITS), .downward = true, .brief = true},
    {FIELD(line, still_to, "still_to", "scene"), SHOWN("1 px from", 10, DIGITS), .downward = true, .brief = true},
    {FIELD(line, verdict, "verdict", ""), SHOWN("  verdict", -19, 0), .when = AT_DISTANCE},
    {.kind = COLUMN_END}};

static const column distance_columns[] = {{FIELD(world, distance, "distance", "scene"), .when = AT_DISTANCE},
                                          {FIELD(world, least, "enough", ""), .when = AT_DISTANCE},
                                          {LIST("schemes", line_columns, next_line), .notes = say_reach, .indent = 2},
                                          {.kind = COLUMN_END}};

static const column setup_report[] = {{PART(world, fields, NULL, setup_columns)},
                                      {FIELD(world, fields.arith, "arith", ""), .only = AS_CSV},
                                      {LIST("distances", distance_columns, next_distance), .head = say_distance},
                                      {.kind = COLUMN_END}};

static const column columns[] = {{FIELD(world, wanted, "gap", "scene")},
                                 {FIELD(world, z, "z", "scene")},
                                 {FIELD(world, asked.shared_origin, "share", "")},
                                 {FIELD(world, width, "width", "pixels"), .only = AS_JSON},
                                 {FIELD(world, height, "height", "pixels"), .only = AS_JSON},
                                 {FIELD(world, fov, "fov", "degrees"), .only = AS_JSON},
                                 {LIST("setups", setup_report, next_setup), .head = say_setup},
                                 {.kind = COLUMN_END}};

/* ---- The command ------------------------------------------------------------------------------------------------- */

/* A length; one not given counts as typed in the unit `name`, or in metres where no scene unit is known. */
static double length_or(bool given, double value, world_request *o, double standard, const char *name) {
    const unit_row *unit = unit_find(name);
    lengths *in = &o->camera.lengths;
    const double metres = unit_convert(standard, unit, unit_find("m"));
    if (given || in->unit == NULL)
        return given ? value : metres;
    const double length = unit_convert(standard, unit, in->unit);
    if (in->typed_count < LENGTHS_TYPED_MAX)
        in->typed[in->typed_count++] = (typed_length){length, standard, unit};
    return length;
}

static int complete(world *w, const world_request *o) {
    world_request *c = &w->o;
    *c = *o;
    c->camera.model = DP_MODEL_FLOAT;
    for (size_t m = 0; m < c->camera.mapping_count; m++)
        if (dp_mapping_get(c->camera.mappings[m])->curve != DP_CURVE_PERSPECTIVE)
            return option_error("mapping", "must be one of " DP_MAPPING_NAMES_PERSPECTIVE ", got %s",
                                dp_mapping_get(c->camera.mappings[m])->name);
    if (o->camera.at.count > 1)
        return option_error("at", "must be one depth, got %zu", o->camera.at.count);
    w->z = length_or(o->camera.at.count > 0, o->camera.at.lo, c, 10.0, "m");
    w->wanted = length_or(option_given(o->line, "separation"), o->separation, c, 1.0, "cm");
    w->distances = o->distances;
    if (w->distances.count > 0 && !(w->distances.lo >= 0.0 && w->distances.hi <= WORLD_FARTHEST))
        return option_error("from-origin", "must be from 0 to 1e12 scene units, got %s",
                            number_full(w->distances.lo < 0.0 ? w->distances.lo : w->distances.hi).text);
    if (w->distances.kind == DEPTHS_LOG && w->distances.count > 0 && !(w->distances.lo > 0.0))
        return option_error("from-origin", "log spacing needs LO greater than 0, got %s: lin has equal steps",
                            number_full(w->distances.lo).text);
    return EXIT_FINE;
}

/* Surfaces face the camera; of the view there is left how many pixels it has and how far its corners are. */
static void take_view(world *w) {
    const dp_triangles standard = dp_triangles_default();
    dp_triangles *t = &w->o.camera.triangles;
    w->width = t->width > 0 ? t->width : standard.width;
    w->height = t->width > 0 ? t->height : standard.height;
    w->fov = t->width > 0 ? t->fov_y : standard.fov_y;
    *t = (dp_triangles){0};
    const double half = dp_half_tangent(w->fov);
    w->asked = (world_asked){.z = w->z,
                             .ray_ratio = dp_hypot(1.0, half * dp_hypot(1.0, (double)w->width / w->height)),
                             .pixels = 0.5 * w->height / half,
                             .shared_origin = w->o.origin.shared_origin};
}

/* The default is in metres, near and far may be of scene units: who gave no depth is told both. */
static int refuse_depth(const world *w) {
    const number_text z = camera_length(&w->o.camera, w->z, 0), lo = camera_length(&w->o.camera, w->o.camera.znear, 0);
    const number_text hi = camera_length(&w->o.camera, w->o.camera.zfar, 0);
    if (option_given(w->o.line, "at"))
        return option_error("at", "must lie between near and far, %s and %s, got %s", lo.text, hi.text, z.text);
    return option_error("at", "must be given: 10 m ahead, %s here, is not between near and far, %s and %s",
                        number_in(number_full(w->z), camera_unit(&w->o.camera)).text, lo.text, hi.text);
}

int cmd_world(void *request) {
    const world_request *o = request;
    output out;
    world w = {.distance = (double)NAN};
    int status = complete(&w, o);
    if (status != EXIT_FINE)
        return status;
    take_view(&w);
    status = setups_make(&w.o.camera, &w.all);
    if (status == EXIT_FINE && !(w.z >= w.o.camera.znear && w.z <= w.o.camera.zfar))
        status = refuse_depth(&w);
    if (status == EXIT_FINE)
        status = output_start(&o->out, &o->camera, &out);
    if (status == EXIT_FINE) {
        const unsigned when = w.distances.count > 0 ? AT_DISTANCE : 0;
        report_write(&(report_spec){"world", columns, &w, .when = when, .label = 10}, &out, o->out.form);
        status = output_close(&out);
    }
    setups_release(&w.all);
    return status;
}
