/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * table: what each depth becomes in each set-up, the certified worst case over the range, and which model is enough.
 * The interval is that of the exact cell; with --tolerance, by the cheapest method that is claimed to be good enough.
 * Rows are computed and written one by one, so a million of them need no more memory than nine.
 */
#include <math.h>

#include "camera/cmd/each_setup.h"
#include "camera/cmd/slant.h"
#include "core/append.h"
#include "core/engine.h"
#include "method/ways.h"
#include "quantity/cmd/choice.h"
#include "quantity/cmd/resolved.h"
#include "quantity/cmd_table/compare.h"
#include "quantity/cmd_table/constants.h"
#include "quantity/cmd_table/levels.h"
#include "quantity/cmd_table/lookup.h"
#include "quantity/cmd_table/per_vertex.h"
#include "quantity/cmd_table/request.h"
#include "report/number.h"

/* Beyond fifteen digits a decimal shows its own rounding (0.10000000000000001). */
enum {
    DIGITS_SHORT = 5,
    DIGITS_FEW = 6,
    DIGITS_Z = 8,
    DIGITS_USUAL = 9,
    DIGITS_DEPTH = 7,
    DIGITS_DEPTH_MOST = 10,
    DIGITS_MOST = 15
};

/* A depth, and in text as many digits of it as tell it from its neighbours. */
typedef struct row {
    dp_sample sample;
    double slanted;             /* the guaranteed one at any slant that is asked for */
    per_vertex written;         /* what depth written per vertex is off by in such triangles */
    double lattice, guaranteed; /* the separation in the model exact, and in the fullest that there is */
    bool certain;               /* what is guaranteed ends before far */
    int depth_digits, stored_digits, cell_digits;
} row;

/* With --range: the separation that can be relied on all over it, in the fullest model that the set-up has. */
typedef struct guarantee {
    const char *model;
    dp_separation_worst worst;
} guarantee;

/* The state of a table; the fields below the range are of the set-up at hand. */
typedef struct table {
    each_setup each;
    const table_request *o;
    double lo, hi;
    way interval;                /* without a row, the exact cell */
    dp_setup setup, exact, full; /* of surfaces that face the camera: as asked for, and in two models */
    dp_setup slanted;            /* `full` with triangles */
    row row;
    dp_worst worst_case;
    const dp_worst *worst; /* null in a model without cells */
    guarantee over_range, slanted_over_range;
    slant_fields slant;
    const slant_fields *triangles;                  /* null: surfaces face the camera */
    const guarantee *guarantee, *guarantee_slanted; /* null where there is none, or none is asked for */
    clipping planes;
    const clipping *drawn; /* null where there is no pipeline */
    per_vertex_worst written;
    double uncertain; /* the nearest depth shown before far whose guarantee is more than is left up to far; NaN: none */
    choosing choice;
    choice_fields chosen;
} table;

/* Are there depths among those asked about whose cell a plane cuts? */
static bool has_cut_cells(const table *t, const dp_setup *setup) {
    const uint32_t first = dp_code(setup, setup->spec.znear), last = dp_code(setup, setup->spec.zfar);
    for (size_t i = 0; i < t->each.at.count; i++) {
        const uint32_t code = dp_code(setup, depths_get(&t->each.at, i));
        if (code == first || code == last)
            return true;
    }
    return false;
}

static int digits_to_see(double at, double step) {
    return number_digits_within(at, step, DIGITS_USUAL, DIGITS_MOST);
}

/* ---- What is reported -------------------------------------------------------------------------------------------- */

/* The separation of a row in another model, or in its own. */
static double separation_in(const dp_setup *other, const dp_setup *setup, const dp_sample *here) {
    return other->spec.model == setup->spec.model && other->shader == setup->shader ? here->separation
                                                                                    : dp_separation(other, here->z);
}

/* NaN where there is no pipeline, or no slant is asked for. */
static double slanted_at(const table *t, double z) {
    return t->triangles != NULL && t->full.spec.model == DP_MODEL_FLOAT ? dp_separation(&t->slanted, z) : (double)NAN;
}

static void set_digits(row *r) {
    const dp_sample *s = &r->sample;
    /* A depth just short of 1 should not look like the far plane's. */
    r->depth_digits = number_digits_within(s->depth, 1.0 - s->depth, DIGITS_DEPTH, DIGITS_DEPTH_MOST);
    r->stored_digits = digits_to_see(s->z, s->error);
    r->cell_digits = digits_to_see(s->lo, s->interval);
}

static void *next_row(void *of, size_t i) {
    table *t = of;
    row *r = &t->row;
    double z;
    if (!each_setup_depth(&t->each, i, &z)) {
        choosing_finish(&t->choice);
        choice_fields_of(&t->choice, &t->chosen);
        return NULL;
    }
    dp_sample_at(&t->setup, z, &r->sample); /* cannot fail: depths_resolve() has seen to it */
    r->lattice = separation_in(&t->exact, &t->setup, &r->sample);
    r->guaranteed = separation_in(&t->full, &t->setup, &r->sample);
    r->certain = dp_is_certain(&t->full, z, r->guaranteed);
    if (!(t->uncertain <= z) && z < t->full.spec.zfar && !r->certain)
        t->uncertain = z;
    r->slanted = slanted_at(t, z);
    r->written = per_vertex_at(&t->setup, z, t->slant.triangles.depth, r->guaranteed); /* no depth of 0 is one */
    per_vertex_add(&t->written, &r->written, z);
    if (t->interval.row != NULL)
        r->sample.interval = way_interval(&t->interval, &t->setup, z);
    if (t->o->out.form == FORM_TEXT)
        set_digits(r);
    if (t->o->out.form != FORM_CSV)
        choosing_add(&t->choice, z);
    return r;
}

static const guarantee *guarantee_over(const table *t, const dp_setup *full, guarantee *g) {
    g->model = dp_model_name(setup_model(full));
    return option_given(t->o->line, "range") && dp_separation_over(full, t->lo, t->hi, 0.0, &g->worst) == DP_OK ? g
                                                                                                                : NULL;
}

static void *next_setup(void *of, size_t i) {
    table *t = of;
    if (!each_setup_go(&t->each, i))
        return NULL;
    const dp_setup *setup = &t->setup;
    const table_request *o = t->o;
    t->triangles = slant_fields_of(t->each.here, &t->slant);
    t->setup = dp_setup_facing(t->each.setup);
    t->slanted = dp_setup_guaranteed(t->each.setup);
    range_resolve(t->each.here, &t->lo, &t->hi);
    t->exact = resolved_in(setup, DP_MODEL_EXACT);
    t->full = dp_setup_guaranteed(setup);
    t->uncertain = (double)NAN;
    t->written = per_vertex_none();
    t->choice = choosing_start(setup, o->camera.tolerance);
    if (option_given(o->line, "tolerance"))
        t->interval = way_choose(setup, o->camera.tolerance, has_cut_cells(t, setup));
    if (o->out.form == FORM_CSV)
        return t;
    t->worst_case = (dp_worst){0};
    dp_worst_over(setup, t->lo, t->hi, &t->worst_case);
    t->worst = isnan(t->worst_case.error) ? NULL : &t->worst_case;
    t->guarantee = guarantee_over(t, &t->full, &t->over_range);
    const bool has_slanted = t->triangles != NULL && t->slanted.spec.model == DP_MODEL_FLOAT;
    t->guarantee_slanted = has_slanted ? guarantee_over(t, &t->slanted, &t->slanted_over_range) : NULL;
    t->planes = clipping_of(setup);
    t->drawn = setup->spec.model == DP_MODEL_FLOAT ? &t->planes : NULL;
    return t;
}

/* ---- Text -------------------------------------------------------------------------------------------------------- */

/* The answer first: how far one can trust the set-up. */
static void say_reach_of(page *p, const dp_setup *full, const unit_row *unit, const char *which) {
    char text[RESOLVED_TEXT_SIZE], sentence[RESOLVED_TEXT_SIZE] = "";
    double up_to[RESOLVED_LIMITS];
    resolved_up_to(full, unit, up_to);
    /* A separation wider than one that holds everywhere goes without saying. */
    for (size_t i = 0; i < RESOLVED_LIMITS && (i == 0 || !(up_to[i - 1] >= full->spec.zfar)); i++)
        if (!isnan(up_to[i]))
            append(sentence, sizeof sentence, "%s %s up to %s%s", *sentence != '\0' ? "," : "",
                   resolved_limit_text(i, unit).text, up_to[i] < full->spec.zfar ? "z = " : "",
                   resolved_text(full->spec.zfar, up_to[i], unit, text));
    if (*sentence != '\0')
        page_text(p, "Guaranteed to be resolved%s:%s.", which, sentence);
    else
        page_text(p, "%s is not guaranteed to be resolved%s, even at the near plane.",
                  resolved_limit_text(RESOLVED_LIMITS - 1, unit).text, which);
}

static void say_reach(page *p, void *item) {
    const table *t = item;
    const unit_row *unit = t->each.here->lengths.unit;
    each_setup_title(p, item);
    slant_say(p, page_title, t->each.here, &t->full);
    if (t->each.all.count > 1)
        return;
    say_reach_of(p, &t->full, unit, t->triangles != NULL ? ", facing the camera" : "");
    char slanted[NUMBER_SIZE + 8];
    snprintf(slanted, sizeof slanted, ", at %s", slant_words(&t->slanted.spec.triangles).text);
    if (t->triangles != NULL && t->slanted.spec.model == DP_MODEL_FLOAT)
        say_reach_of(p, &t->slanted, unit, slanted);
}

static void say_worst(page *p, const dp_worst *w) {
    if (w == NULL)
        return;
    if (isinf(w->error))
        page_note(p, "worst error", "unbounded, code %u", w->error_code);
    else
        page_note(p, "worst error", "%s at z = %s, code %u", number_in(number_of(w->error, DIGITS_FEW), p->unit).text,
                  number_in(number_of(w->error_z, DIGITS_USUAL), p->unit).text, w->error_code);
    const int digits = digits_to_see(w->interval_lo, w->interval);
    const number_text lo = number_in(number_of(w->interval_lo, digits), p->unit);
    if (isinf(w->interval))
        page_note(p, "worst interval", "unbounded, from %s on, code %u", lo.text, w->interval_code);
    else
        page_note(p, "worst interval", "%s from %s to %s, code %u",
                  number_in(number_of(w->interval, DIGITS_FEW), p->unit).text, lo.text,
                  number_in(number_of(w->interval_hi, digits), p->unit).text, w->interval_code);
    if (!isnan(w->blind_from))
        page_note(p, "blind", "from z = %s: nothing beyond is resolved",
                  number_in(number_of(w->blind_from, DIGITS_USUAL), p->unit).text);
}

static void say_drawn(page *p, const clipping *c) {
    if (isnan(c->znear) && c->loses)
        page_note(p, "clip range", "empty: clipping removes all depths");
    else if (!isnan(c->znear))
        page_note(p, "clip range", "effectively %s to %s%s", number_in(number_of(c->znear, DIGITS_USUAL), p->unit).text,
                  number_in(number_of(c->zfar, DIGITS_USUAL), p->unit).text,
                  c->loses ? ": clipping removes the rest" : "");
}

static void say_way(page *p, const way *w, double tolerance) {
    const number_text allowed = number_of(tolerance, 3);
    if (w->name == NULL)
        page_line(p, "interval: no method's bound is within %s of it in this set-up", allowed.text);
    else if (w->claim == 0)
        page_line(p, "interval by %s, exact", w->name);
    else
        page_line(p, "interval by %s, the cheapest within %s of it: bound %s", w->name, allowed.text,
                  number_of(w->claim, 3).text);
}

static void say_guarantee(page *p, const guarantee *g, const char *label, const char *what) {
    if (g != NULL)
        page_note(p, label, "%s at z = %s, %s", number_in(number_up(g->worst.bound, DIGITS_FEW), p->unit).text,
                  number_in(number_of(g->worst.z, DIGITS_USUAL), p->unit).text, what);
}

static void say_notes(page *p, void *item) {
    const table *t = item;
    say_worst(p, t->worst);
    if (!isnan(t->uncertain) && isfinite(t->full.spec.zfar))
        page_note(p, "no room", "at z = %s nothing behind it up to far is certain",
                  number_in(number_of(t->uncertain, DIGITS_USUAL), p->unit).text);
    say_guarantee(p, t->guarantee, "worst separation",
                  t->full.shader             ? "guaranteed for every log2 that a shader may use"
                  : dp_is_computed(&t->full) ? "guaranteed in binary32 (model float)"
                                             : "in model staged");
    char slanted[NUMBER_SIZE + 8];
    snprintf(slanted, sizeof slanted, "at %s", slant_words(&t->slanted.spec.triangles).text);
    say_guarantee(p, t->guarantee_slanted, slanted, "of the farther surface");
    setups_say_rg(p, &t->setup, 1);
    say_drawn(p, &t->planes);
    per_vertex_say(p, &t->written, t->slant.triangles.depth);
    page_line(p, "%s", choice_sentence(&t->choice, p->unit).text);
    if (option_given(t->o->line, "tolerance"))
        say_way(p, &t->interval, t->o->camera.tolerance);
    if (t->each.all.count == 1)
        setup_say_code(p, &t->each.setup->spec);
}

/* ---- Columns ----------------------------------------------------------------------------------------------------- */

enum {
    WITH_TOLERANCE = 1,
    WITH_ARITH = 2,
    VERBOSE = 4,
    WITH_PRESETS = 8,
    WITH_TRIANGLES = 16,
    ONE_CAMERA = 32,
    PER_VERTEX = 64
};

static const column row_columns[] = {
    {FIELD(row, sample.z, "z", "scene"), SHOWN("z", 11, DIGITS_Z)},
    {FIELD(row, sample.code, "code", ""), SHOWN("code", 11, 0)},
    {FIELD(row, sample.depth, "depth", ""), SHOWN("depth", 13, 0), .digits_at = offsetof(row, depth_digits),
     .spare = 2},
    {FIELD(row, sample.stored, "z_stored", "scene"), SHOWN("stored", 15, 0), .digits_at = offsetof(row, stored_digits),
     .spare = 4},
    {FIELD(row, sample.error, "error", "scene"), SHOWN("error", 12, DIGITS_SHORT), .spare = 3},
    {FIELD(row, sample.lo, "cell_lo", "scene")},
    {FIELD(row, sample.hi, "cell_hi", "scene")},
    {FIELD(row, sample.interval, "interval", "scene"), SHOWN("interval", 11, DIGITS_SHORT), .spare = 1},
    {FIELD(row, sample.separation, "separation", "scene")},
    {FIELD(row, lattice, "lattice", "scene"), SHOWN("lattice", 11, DIGITS_SHORT), .upward = true,
     .only = AS_TEXT | AS_JSON},
    {FIELD(row, guaranteed, "guaranteed", "scene"), SHOWN("guaranteed", 11, DIGITS_SHORT), .upward = true},
    {FIELD(row, guaranteed, "guarantee_facing", "scene"), .when = WITH_TRIANGLES},
    {FIELD(row, slanted, "guarantee_slanted", "scene"), SHOWN("slanted", 11, DIGITS_SHORT), .upward = true,
     .when = WITH_TRIANGLES},
    {FIELD(row, written.error, "per_vertex", "scene"), SHOWN("per vertex", 11, DIGITS_SHORT), .upward = true,
     .when = WITH_TRIANGLES | PER_VERTEX},
    {FIELD(row, written.depth, "per_vertex_depth", ""), .when = WITH_TRIANGLES | PER_VERTEX},
    {FIELD(row, certain, "certain", "")},
    {TEXT_FIELD(row, sample.lo, "cell from", 18, 0), .digits_at = offsetof(row, cell_digits), .when = VERBOSE},
    {TEXT_FIELD(row, sample.hi, "to", 18, 0), .digits_at = offsetof(row, cell_digits), .when = VERBOSE},
    {.kind = COLUMN_END}};

static const column worst_columns[] = {{FIELD(dp_worst, lo, "lo", "scene")},
                                       {FIELD(dp_worst, hi, "hi", "scene")},
                                       {FIELD(dp_worst, error, "error", "scene")},
                                       {FIELD(dp_worst, error_z, "error_z", "scene")},
                                       {FIELD(dp_worst, error_code, "error_code", "")},
                                       {FIELD(dp_worst, interval, "interval", "scene")},
                                       {FIELD(dp_worst, interval_lo, "interval_lo", "scene")},
                                       {FIELD(dp_worst, interval_hi, "interval_hi", "scene")},
                                       {FIELD(dp_worst, interval_code, "interval_code", "")},
                                       {FIELD(dp_worst, blind_from, "blind_from", "scene")},
                                       {.kind = COLUMN_END}};

static const column guarantee_columns[] = {{FIELD(guarantee, model, "model", "")},
                                           {FIELD(guarantee, worst.lo, "lo", "scene")},
                                           {FIELD(guarantee, worst.hi, "hi", "scene")},
                                           {FIELD(guarantee, worst.bound, "bound", "scene")},
                                           {FIELD(guarantee, worst.separation, "separation", "scene")},
                                           {FIELD(guarantee, worst.z, "z", "scene")},
                                           {.kind = COLUMN_END}};

static const column drawn_columns[] = {{FIELD(clipping, znear, "near_effective", "scene")},
                                       {FIELD(clipping, zfar, "far_effective", "scene")},
                                       {.kind = COLUMN_END}};

static const column setup_report[] = {
    {PART(table, each.fields, NULL, setup_columns)},
    {PART(table, triangles, "triangles", slant_columns), .only = AS_JSON, .pointed = true, .optional = true,
     .when = WITH_PRESETS},
    {FIELD(table, each.fields.arith, "arith", ""), .only = AS_CSV, .when = WITH_ARITH},
    {FIELD(table, interval.name, "method", ""), .only = AS_JSON, .when = WITH_TOLERANCE},
    {FIELD(table, interval.claim, "claim", ""), .only = AS_JSON, .when = WITH_TOLERANCE},
    {LIST("rows", row_columns, next_row)},
    {FIELD(table, interval.name, "method", ""), .only = AS_CSV, .when = WITH_TOLERANCE},
    {FIELD(table, each.fields.preset, "preset", ""), .only = AS_CSV, .when = WITH_PRESETS},
    {FIELD(table, each.fields.unit, "unit", ""), .only = AS_CSV, .when = WITH_PRESETS},
    {PART(table, worst, "worst", worst_columns), .only = AS_JSON, .pointed = true},
    {PART(table, guarantee, "worst_separation", guarantee_columns), .only = AS_JSON, .pointed = true, .optional = true},
    {PART(table, guarantee_slanted, "worst_separation_slanted", guarantee_columns), .only = AS_JSON, .pointed = true,
     .optional = true},
    {PART(table, drawn, NULL, drawn_columns), .only = AS_JSON, .pointed = true},
    {PART(table, chosen, "auto", choice_columns), .only = AS_JSON},
    {.kind = COLUMN_END}};

static const column columns[] = {{PART(table, triangles, "triangles", slant_columns), .only = AS_JSON, .pointed = true,
                                  .optional = true, .when = ONE_CAMERA},
                                 {LIST("setups", setup_report, next_setup), .head = say_reach, .notes = say_notes},
                                 {.kind = COLUMN_END}};

/* The columns of these set-ups: the variant of arithmetic only where some set-up has that model. */
static unsigned conditions(const table *t) {
    unsigned when = (option_given(t->o->line, "tolerance") ? WITH_TOLERANCE : 0) | (t->o->out.full ? VERBOSE : 0) |
                    (t->o->camera.preset_count > 1 ? WITH_PRESETS : ONE_CAMERA) |
                    (t->triangles != NULL ? WITH_TRIANGLES : 0);
    for (size_t i = 0; i < t->each.all.count; i++) {
        when |= t->each.all.items[i].spec.model == DP_MODEL_FLOAT ? WITH_ARITH : 0;
        when |= per_vertex_matters(&t->each.all.items[i]) ? PER_VERTEX : 0;
    }
    return when;
}

int cmd_table(void *request) {
    const table_request *o = request;
    if (levels_wanted(o))
        return levels_write(o);
    if (o->constants)
        return constants_write(o);
    if (lookup_wanted(o))
        return lookup_write(o);
    table t = {.o = o};
    t.triangles = slant_fields_of(&o->camera, &t.slant);
    int status = each_setup_start(&t.each, &o->camera, &o->out);
    for (size_t i = 0; status == EXIT_FINE && each_setup_go(&t.each, i); i++) {
        status = range_resolve(t.each.here, &t.lo, &t.hi);
        if (status == EXIT_FINE && (o->camera.model == DP_MODEL_FLOAT || o->camera.model_auto))
            status = depths_in_binary32(&t.each.at);
        if (status == EXIT_FINE)
            setup_choose(&o->camera, &t.each.at, &t.each.all.items[i]);
    }
    if (status == EXIT_FINE && compare_suits(&t.each, o))
        return compare_write(&t.each, o);
    const report_spec spec = {"table", columns, &t, .when = conditions(&t), .label = 16};
    return each_setup_write(&t.each, &spec, status);
}
