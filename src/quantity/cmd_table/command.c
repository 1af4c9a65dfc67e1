/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * table: what each depth becomes in each set-up, the certified worst case over the range, and which model is enough.
 * The interval is that of the exact cell; with --tolerance, by the cheapest method that is claimed to be good enough.
 * Rows are computed and written one by one, so a million of them need no more memory than nine.
 */
#include <math.h>

#include "camera/cmd/each_setup.h"
#include "camera/cmd/slant.h"
#include "core/engine.h"
#include "method/ways.h"
#include "quantity/cmd/choice.h"
#include "quantity/cmd_table/compare.h"
#include "quantity/cmd_table/constants.h"
#include "quantity/cmd_table/in_preset.h"
#include "quantity/cmd_table/levels.h"
#include "quantity/cmd_table/lookup.h"
#include "quantity/cmd_table/per_vertex.h"
#include "quantity/cmd_table/reach.h"
#include "quantity/cmd_table/request.h"
#include "quantity/cmd_table/slices.h"
#include "report/number.h"
#include "report/sentence.h"

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
    double lattice; /* the separation in the model exact */
    guarantee guarantee;
    per_vertex written; /* what depth written per vertex is off by in slanted triangles */
    int depth_digits, stored_digits, cell_digits;
} row;

/* With --range: the separation that can be relied on all over it, in the fullest model that the set-up has. */
typedef struct promise {
    const char *model;
    dp_separation_worst worst;
} promise;

typedef struct worst {
    dp_worst of;
    double codes; /* that depths of the range have */
    int digits;   /* that show where the interval ends */
} worst;

/* The state of a table; the fields below the range are of the set-up at hand. */
typedef struct table {
    each_setup each;
    const table_request *o;
    double lo, hi;
    way interval;          /* without a row, the exact cell */
    dp_setup setup, exact; /* of surfaces that face the camera: as asked for, and as a lattice */
    row row;
    worst worst_case;
    const worst *worst; /* null in a model without cells */
    promise over_range, slanted_over_range;
    const promise *guarantee, *guarantee_slanted; /* null where there is none, or none is asked for */
    clipping planes;
    const clipping *drawn; /* null where there is no pipeline */
    per_vertex_worst written;
    char at_slant[sizeof(surfaces_text) + 4]; /* "at any slant" */
    double uncertain; /* the nearest depth shown before far whose guarantee is more than is left up to far; NaN: none */
    reached reached;
    in_preset in_preset;
    const dp_triangles *assumed; /* the view of those at a slant; null where it was given, or there is none */
    choosing choice;
    choice_fields chosen;
    slice_pair shared; /* by two depth ranges */
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
    r->lattice = t->setup.spec.model == DP_MODEL_EXACT ? r->sample.separation : dp_separation(&t->exact, z);
    r->guarantee = each_setup_guarantee(&t->each, z);
    if (!(t->uncertain <= z) && z < t->each.full.spec.zfar && !r->guarantee.certain)
        t->uncertain = z;
    r->written = per_vertex_at(&t->setup, z, t->each.slant.triangles.depth, r->guarantee.facing); /* no 0 is a depth */
    per_vertex_add(&t->written, &r->written, z);
    if (t->interval.row != NULL)
        r->sample.interval = way_interval(&t->interval, &t->setup, z);
    if (t->o->out.form == FORM_TEXT)
        set_digits(r);
    if (t->o->out.form != FORM_CSV)
        choosing_add(&t->choice, z);
    return r;
}

static const promise *guarantee_over(const table *t, const dp_setup *full, promise *g) {
    g->model = dp_model_name(setup_model(full));
    return option_given(t->o->line, "range") && dp_separation_over(full, t->lo, t->hi, 0.0, &g->worst) == DP_OK ? g
                                                                                                                : NULL;
}

/* For surfaces at any slant that was asked about, or is assumed; null where nothing is guaranteed to them. */
static const dp_setup *any_slant(const table *t) {
    return each_setup_slanted(&t->each)               ? &t->each.slanted
           : t->each.assumed.spec.triangles.width > 0 ? &t->each.assumed
                                                      : NULL;
}

static void *next_reach(void *of, size_t i) {
    table *t = of;
    return i < RESOLVED_LIMITS ? &t->reached.of[i] : NULL;
}

static void *next_setup(void *of, size_t i) {
    table *t = of;
    if (!each_setup_go(&t->each, i))
        return NULL;
    const dp_setup *setup = &t->setup;
    const table_request *o = t->o;
    t->setup = dp_setup_facing(t->each.setup);
    snprintf(t->at_slant, sizeof t->at_slant, "at %s", surfaces_words(&t->each.slanted.spec.triangles).text);
    range_resolve(t->each.here, &t->lo, &t->hi);
    dp_setup_in(setup, DP_MODEL_EXACT, &t->exact); /* which all mappings have */
    t->uncertain = (double)NAN;
    t->written = per_vertex_none(t->each.slant.triangles.depth);
    t->choice = choosing_start(setup, o->camera.tolerance);
    if (option_given(o->line, "tolerance"))
        t->interval = way_choose(setup, o->camera.tolerance, has_cut_cells(t, setup));
    if (o->out.form == FORM_CSV)
        return t;
    reach_find(&t->each.full, any_slant(t), t->each.here->lengths.unit, &t->in_preset, &t->reached);
    t->assumed = t->each.assumed.spec.triangles.width > 0 ? &t->each.assumed.spec.triangles : NULL;
    t->worst_case = (worst){.digits = 0};
    dp_worst_over(setup, t->lo, t->hi, &t->worst_case.of);
    t->worst_case.codes = fabs((double)dp_code(setup, t->hi) - (double)dp_code(setup, t->lo)) + 1.0;
    t->worst_case.digits = digits_to_see(t->worst_case.of.interval_lo, t->worst_case.of.interval);
    t->worst = isnan(t->worst_case.of.error) ? NULL : &t->worst_case;
    t->guarantee = guarantee_over(t, &t->each.full, &t->over_range);
    t->guarantee_slanted =
        each_setup_slanted(&t->each) ? guarantee_over(t, &t->each.slanted, &t->slanted_over_range) : NULL;
    t->planes = clipping_of(setup);
    t->drawn = setup->spec.model == DP_MODEL_FLOAT ? &t->planes : NULL;
    return t;
}

/* ---- Text -------------------------------------------------------------------------------------------------------- */

/* The answer first: at any slant, then of surfaces that face the camera, which the columns are of. */
static void say_reach(page *p, void *item) {
    const table *t = item;
    char view[SLANT_ASSUMED_SIZE], where[SLANT_ASSUMED_SIZE + 32];
    each_setup_title(p, item);
    slant_say(p, page_title, t->each.here, &t->each.full);
    if (t->each.all.count > 1)
        return;
    snprintf(where, sizeof where, "at any slant (%s)", slant_assumed(&t->each.assumed.spec.triangles, view));
    if (any_slant(t) != NULL)
        reach_say(p, &t->reached, false, each_setup_slanted(&t->each) ? t->at_slant : where, NULL);
    reach_say(p, &t->reached, true, SLANT_FACING ", " SLANT_AS_WALL,
              any_slant(t) != NULL ? "Facing the camera, " SLANT_AS_WALL : NULL);
    if (t->in_preset.parameter != NULL)
        page_text(p, "Where %s looks, %s: %s.", t->o->camera.presets[0]->name,
                  each_setup_slanted(&t->each) ? t->at_slant : SLANT_FACING,
                  *t->in_preset.text != '\0' ? t->in_preset.text : "none of these separations at any number");
}

/* ---- Columns ----------------------------------------------------------------------------------------------------- */

enum {
    WITH_TOLERANCE = 1,
    WITH_ARITH = 2,
    VERBOSE = 4,
    WITH_TRIANGLES = 16,
    ONE_CAMERA = 32,
    PER_VERTEX = 64,
    IN_PRESET = 128
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
    {FIELD(row, guarantee.facing, "guaranteed", "scene"), SHOWN("guaranteed", 11, DIGITS_SHORT), .upward = true},
    GUARANTEES(row, guarantee.facing, guarantee.slanted, 11, DIGITS_SHORT, WITH_TRIANGLES),
    {FIELD(row, written.error, "per_vertex", "scene"), SHOWN("per vertex", 11, DIGITS_SHORT), .upward = true,
     .when = WITH_TRIANGLES | PER_VERTEX},
    {FIELD(row, written.depth, "per_vertex_depth", ""), .when = WITH_TRIANGLES | PER_VERTEX},
    {FIELD(row, guarantee.certain, "certain", "")},
    {TEXT_FIELD(row, sample.lo, "cell from", 18, 0), .digits_at = offsetof(row, cell_digits), .downward = true,
     .when = VERBOSE},
    {TEXT_FIELD(row, sample.hi, "to", 18, 0), .digits_at = offsetof(row, cell_digits), .upward = true, .when = VERBOSE},
    {.kind = COLUMN_END}};

static const column reach_columns[] = {{FIELD(reach, separation, "separation", "scene")},
                                       {FIELD(reach, facing, "facing_to", "scene")},
                                       {FIELD(reach, any_slant, "slanted_to", "scene")},
                                       {FIELD(reach, from, "parameter_from", ""), .when = IN_PRESET},
                                       {FIELD(reach, to, "parameter_to", ""), .when = IN_PRESET},
                                       {.kind = COLUMN_END}};

#define CELL_END .digits_at = offsetof(worst, digits)
static const column worst_columns[] = {
    {FIELD(worst, of.lo, "lo", "scene")},
    {FIELD(worst, of.hi, "hi", "scene")},
    {FIELD(worst, codes, "codes", "")},
    {FIELD(worst, of.error, "error", "scene"), .digits = DIGITS_FEW, .upward = true},
    {FIELD(worst, of.error_z, "error_z", "scene"), .digits = DIGITS_USUAL},
    {FIELD(worst, of.error_code, "error_code", "")},
    {FIELD(worst, of.interval, "interval", "scene"), .digits = DIGITS_FEW, .upward = true},
    {FIELD(worst, of.interval_lo, "interval_lo", "scene"), CELL_END, .downward = true},
    {FIELD(worst, of.interval_hi, "interval_hi", "scene"), CELL_END, .upward = true},
    {FIELD(worst, of.interval_code, "interval_code", "")},
    {FIELD(worst, of.blind_from, "blind_from", "scene"), .digits = DIGITS_USUAL, .downward = true},
    {.kind = COLUMN_END}};

static const column guarantee_columns[] = {
    {FIELD(promise, model, "model", "")},
    {FIELD(promise, worst.lo, "lo", "scene")},
    {FIELD(promise, worst.hi, "hi", "scene")},
    {FIELD(promise, worst.bound, "bound", "scene"), .digits = DIGITS_FEW, .upward = true},
    {FIELD(promise, worst.separation, "separation", "scene")},
    {FIELD(promise, worst.z, "z", "scene"), .digits = DIGITS_USUAL},
    {.kind = COLUMN_END}};

static const column drawn_columns[] = {
    {FIELD(clipping, znear, "near_effective", "scene"), .digits = DIGITS_USUAL, .upward = true},
    {FIELD(clipping, zfar, "far_effective", "scene"), .digits = DIGITS_USUAL, .downward = true},
    {.kind = COLUMN_END}};

static const column setup_report[] = {
    {PART(table, each.fields, NULL, setup_columns)},
    {PART(table, each.triangles, "triangles", slant_columns), .only = AS_JSON, .pointed = true, .optional = true,
     .when = EACH_OF_PRESETS},
    {FIELD(table, each.fields.arith, "arith", ""), .only = AS_CSV, .when = WITH_ARITH},
    EACH_RANGE_COLUMNS(table),
    {FIELD(table, interval.name, "method", ""), .only = AS_JSON, .when = WITH_TOLERANCE},
    {FIELD(table, interval.claim, "claim", ""), .digits = 3, .upward = true, .only = AS_JSON, .when = WITH_TOLERANCE},
    {LIST("rows", row_columns, next_row)},
    {FIELD(table, interval.name, "method", ""), .only = AS_CSV, .when = WITH_TOLERANCE},
    EACH_PRESET_COLUMNS(table),
    {FIELD(table, in_preset.parameter, "parameter", ""), .only = AS_JSON, .when = IN_PRESET},
    {LIST("resolved", reach_columns, next_reach), .only = AS_JSON},
    {PART(table, assumed, "assumed", slant_view_columns), .only = AS_JSON, .pointed = true, .optional = true},
    {PART(table, worst, "worst", worst_columns), .only = AS_JSON, .pointed = true},
    {PART(table, guarantee, "worst_separation", guarantee_columns), .only = AS_JSON, .pointed = true, .optional = true},
    {PART(table, guarantee_slanted, "worst_separation_slanted", guarantee_columns), .only = AS_JSON, .pointed = true,
     .optional = true},
    {PART(table, drawn, NULL, drawn_columns), .only = AS_JSON, .pointed = true},
    {PART(table, chosen, "auto", choice_columns), .only = AS_JSON},
    {FIELD(table, uncertain, "uncertain", "scene"), .digits = DIGITS_USUAL, .only = AS_TEXT},
    {FIELD(table, at_slant, "at_slant", ""), .only = AS_TEXT},
    {PART(table, written, "written", per_vertex_columns), .only = AS_TEXT},
    {.kind = COLUMN_END}};

/* Conditions of sentences. */
enum {
    NO_ERROR_BOUND = 1,
    NO_INTERVAL_BOUND = 2,
    FAR_IS_FINITE = 4,
    IS_SHADER = 8,
    IS_COMPUTED = 16,
    IS_RG = 32,
    LOSES = 64,
    BELOW_SEPARATION = 128,
    TOLERANCE = 256,
    EXACTLY = 512,
    OF_RANGE = 1024
};

#define GUARANTEED "{worst_separation.bound} at z = {worst_separation.z}, "
#define TOO_FAR    "{written.error} too far at z = {written.z} " IN_CLASS
#define IN_CLASS   "in triangles from z/{written.class} to {written.class} z: "
static const sentence words[] = {
    NOTE("codes", "{worst.codes} from {worst.lo} to {worst.hi}", OF_RANGE),
    NOTE("worst error", "unbounded, code {worst.error_code}", NO_ERROR_BOUND),
    ELSE("{worst.error} at z = {worst.error_z}, code {worst.error_code}", 0),
    NOTE("worst interval", "unbounded, from {worst.interval_lo} on, code {worst.interval_code}", NO_INTERVAL_BOUND),
    ELSE("{worst.interval} from {worst.interval_lo} to {worst.interval_hi}, code {worst.interval_code}", 0),
    NOTE("blind", "from z = {worst.blind_from}: nothing beyond is resolved", 0),
    NOTE("no room", "at z = {uncertain} nothing behind it up to far is certain", FAR_IS_FINITE),
    NOTE("worst separation", GUARANTEED "guaranteed for every log2 that a shader may use", IS_SHADER),
    ELSE(GUARANTEED "guaranteed in binary32 (model float)", IS_COMPUTED),
    ELSE(GUARANTEED "in model staged", 0),
    NOTE("{at_slant}", "{worst_separation_slanted.bound} at z = {worst_separation_slanted.z}, of the farther surface",
         0),
    PROSE(RG_NOTE, IS_RG),
    NOTE("clip range", "effectively {near_effective} to {far_effective}: clipping removes the rest", LOSES),
    ELSE("effectively {near_effective} to {far_effective}", 0),
    ELSE("empty: clipping removes all depths", LOSES),
    LINE("written per vertex, depth is at most " TOO_FAR "less than the separation", BELOW_SEPARATION),
    ELSE("written per vertex, depth is up to " TOO_FAR
         "write it per fragment, unless all triangles lie within z/k and k z, k = 1 + {written.beyond}",
         0),
    SENTENCE_END};
static const sentence words_of_interval[] = {
    LINE("interval by {method}, exact", TOLERANCE | EXACTLY),
    ELSE("interval by {method}, the cheapest within {auto.tolerance:3} of it: bound {claim}", TOLERANCE),
    ELSE("interval: no method's bound is within {auto.tolerance:3} of it in this set-up", TOLERANCE), SENTENCE_END};

static unsigned conditions_of_words(const table *t) {
    return (isinf(t->worst_case.of.error) ? NO_ERROR_BOUND : 0) |
           (isinf(t->worst_case.of.interval) ? NO_INTERVAL_BOUND : 0) |
           (isfinite(t->each.full.spec.zfar) ? FAR_IS_FINITE : 0) | (t->each.full.shader ? IS_SHADER : 0) |
           (dp_is_computed(&t->each.full) ? IS_COMPUTED : 0) | (dp_format_is_rg(&t->setup.spec.format) ? IS_RG : 0) |
           (t->planes.loses ? LOSES : 0) | (t->written.class <= t->written.depth ? BELOW_SEPARATION : 0) |
           (option_given(t->o->line, "tolerance") ? TOLERANCE : 0) | (t->interval.claim == 0 ? EXACTLY : 0) |
           (option_given(t->o->line, "range") || t->o->camera.range_count > 1 ? OF_RANGE : 0);
}

static void say_notes(page *p, void *item) {
    const table *t = item;
    page_say(p, words, setup_report, item, conditions_of_words(t));
    choice_say(p, &t->choice, "");
    page_say(p, words_of_interval, setup_report, item, conditions_of_words(t));
    if (t->each.all.count == 1)
        setup_say_code(p, &t->each.setup->spec);
}

static void *next_shared(void *of, size_t i) {
    table *t = of;
    return slices_shared(&t->each.all, i, &t->shared) ? &t->shared : NULL;
}

static const column columns[] = {{PART(table, each.triangles, "triangles", slant_columns), .only = AS_JSON,
                                  .pointed = true, .optional = true, .when = ONE_CAMERA},
                                 {LIST("setups", setup_report, next_setup), .head = say_reach, .notes = say_notes},
                                 {LIST("shared", slice_columns, next_shared), .only = AS_JSON, .when = EACH_OF_RANGES},
                                 {.kind = COLUMN_END}};

/* The columns of these set-ups: the variant of arithmetic only where some set-up has that model. */
static unsigned conditions(const table *t) {
    unsigned when = (option_given(t->o->line, "tolerance") ? WITH_TOLERANCE : 0) | (t->o->out.full ? VERBOSE : 0) |
                    (t->o->camera.preset_count > 1 ? 0 : ONE_CAMERA) |
                    (t->each.triangles != NULL ? WITH_TRIANGLES : 0) | (t->in_preset.parameter != NULL ? IN_PRESET : 0);
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
    if (status == EXIT_FINE && o->out.form != FORM_CSV)
        in_preset_find(o, &t.in_preset);
    const report_spec spec = {"table", columns, &t, .when = conditions(&t), .label = 16};
    return each_setup_write(&t.each, &spec, status);
}
