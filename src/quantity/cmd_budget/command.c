/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * budget: the separation that binary32 arithmetic guarantees at each depth, and which cause takes how much of it; then
 * what to do about the largest part, and whether a simpler model would have said the same.
 */
#include <math.h>
#include <stdio.h>

#include "camera/cmd/each_setup.h"
#include "camera/cmd/slant.h"
#include "core/elementary.h"
#include "core/engine.h"
#include "quantity/cmd/choice.h"
#include "quantity/cmd_budget/remedy.h"
#include "quantity/cmd_budget/request.h"
#include "report/sentence.h"
#include "world/reach.h"

enum { DIGITS_PART = 2, DIGITS = 4, DIGITS_MORE = 6, DIGITS_Z = 9 };

typedef struct row {
    double z;
    dp_budget parts;
    double facing;                               /* the separation of surfaces that face the camera */
    bool certain;                                /* that one ends before far */
    char cause[DP_CAUSE_COUNT][NUMBER_SIZE + 8]; /* "0.00149  50 %" */
} row;

/* The largest separation that is finite, what takes most of it and what would help. */
typedef struct worst {
    double z; /* NaN while there is none */
    double separation;
    const char *cause;
    double share, percent, step; /* step: of binary32 depths */
    remedy_result remedy;
    double remedy_separation; /* NaN where nothing helps */
} worst;

/* The state of a budget; the fields below `linearize` are of the set-up at hand. */
typedef struct budget {
    each_setup each;
    const budget_request *o;
    dp_budget_terms terms;
    const char *composition;    /* how positions are composed; null where eye depth is given, or a scheme */
    const world_scheme *scheme; /* how they come before the camera; null where view and projection are composed */
    const char *scheme_name;
    const char *log2; /* what a shader's log2 may be off by */
    bool linearize;
    dp_setup facing; /* without the triangles */
    row row, largest;
    double hopeless; /* the nearest depth where no separation is certain; NaN when there is none such */
    worst found;
    const worst *worst; /* null where there is none */
    bool shader; /* of a logarithmic mapping, which has no model to choose: what it adds to the model staged is said */
    double staged_times, staged_z;
    choosing choice;
    choice_fields chosen_fields;
    const choice_fields *chosen; /* null of a shader */
} budget;

enum {
    WITH_WORLD = 1,
    WITH_INTERPOLATION = 2,
    WITH_LINEARIZE = 4,
    WITH_TRIANGLES = 8,
    COMPOSED = 16,
    WITH_SCHEME = 32,
    WITH_LOG = 64,
    WITH_MATRIX = 128, /* some set-up has a projection matrix */
    WITH_DIVIDE = 256  /* or is written as clip z */
};

/* The conditions of columns that the set-ups fulfil. */
static unsigned conditions_of_setups(const setups *all) {
    unsigned when = 0;
    for (size_t i = 0; i < all->count; i++) {
        const bool shader = all->items[i].curve == DP_CURVE_LOG;
        const bool divided = !shader || dp_mapping_get(all->items[i].spec.mapping)->ndc_signed;
        when |= (shader ? WITH_LOG : WITH_MATRIX) | (divided ? WITH_DIVIDE : 0);
    }
    return when;
}

/* The terms that are asked for. */
static unsigned conditions(const budget *b) {
    return (b->terms.world > 0.0 ? WITH_WORLD : 0) | (b->scheme != NULL ? WITH_SCHEME : COMPOSED) |
           (b->terms.interpolation > 0.0 ? WITH_INTERPOLATION : 0) | (b->linearize ? WITH_LINEARIZE : 0) |
           (b->each.triangles != NULL ? WITH_TRIANGLES : 0) | conditions_of_setups(&b->each.all);
}

/* ---- Schemes ----------------------------------------------------------------------------------------------------- */

/* No place is farther from the camera than this times its eye depth: within 60 degrees of the axis, and all vertices of
 * triangles that the picture shows some of. */
static double ray_ratio_of(const dp_triangles *t) {
    const double pixel = t->width > 0 ? 2.0 * dp_half_tangent(t->fov_y) / t->height : 0.0;
    return fmax(2.0, dp_hypot(1.0, pixel * dp_hypot(0.5 * t->width + t->pixels, 0.5 * t->height + t->pixels)));
}

/* No coordinate exceeds the world's size: no place is farther from the origin than a corner of that box. */
static void budget_by(const budget *b, const world_scheme *scheme, const dp_setup *setup, double z,
                      dp_budget_terms *terms, dp_budget *out) {
    static const double root3 = 1.7320508075688774;
    const world_asked a = {.setup = setup,
                           .z = z,
                           .ray_ratio = ray_ratio_of(&setup->spec.triangles),
                           .shared_origin = b->o->origin.shared_origin};
    *terms = b->terms;
    if (scheme != NULL)
        world_budget(scheme, &a, root3 * b->terms.world, terms, out);
    else
        dp_budget_at(setup, z, terms, out); /* cannot fail: depths_resolve() has seen to it */
}

/* Another scheme, where positions take most. */
static remedy_result remedy_by_scheme(const budget *b, double z, const remedy_result *other) {
    static const double about_as_well = 0.95;
    const world_scheme best = {world_get(WORLD_ROWS - 1), 0.0};
    dp_budget_terms terms;
    dp_budget out;
    budget_by(b, &best, b->each.setup, z, &terms, &out);
    return out.separation < about_as_well * other->separation ? (remedy_result){"camera-double", out.separation}
                                                              : *other;
}

/* ---- What is reported -------------------------------------------------------------------------------------------- */

static double share_of(const row *r, int cause) {
    return r->parts.cause[cause] / r->parts.separation;
}

/* How much more the shader needs than the model staged says, which leaves it out. */
static void note_staged(budget *b, const row *r) {
    dp_setup staged;
    if (!dp_setup_in(b->each.setup, DP_MODEL_STAGED, &staged))
        return;
    const double times = r->parts.separation / dp_separation(&staged, r->z);
    if (!(times <= b->staged_times)) {
        b->staged_times = times;
        b->staged_z = r->z;
    }
}

static void note(budget *b, const row *r) {
    if (isinf(r->parts.separation))
        b->hopeless = fmin(b->hopeless, r->z); /* the other one where one is NaN */
    else if (!(r->parts.separation <= b->largest.parts.separation))
        b->largest = *r;
    if (b->shader)
        note_staged(b, r);
    else
        choosing_add(&b->choice, r->z);
}

static const worst *find_worst(budget *b) {
    const row *r = &b->largest;
    int cause = 0;
    for (int i = 1; i < DP_CAUSE_COUNT; i++)
        if (r->parts.cause[i] > r->parts.cause[cause])
            cause = i;
    if (isnan(r->z))
        return NULL;
    const bool position = b->scheme != NULL && cause == DP_CAUSE_COMPOSITION;
    dp_budget_terms terms;
    dp_budget again;
    budget_by(b, b->scheme, b->each.setup, r->z, &terms, &again);
    remedy_result remedy = remedy_find(b->each.setup, &terms, r->z, (dp_cause)cause);
    if (position)
        remedy = remedy_by_scheme(b, r->z, &remedy);
    b->found = (worst){.z = r->z,
                       .separation = r->parts.separation,
                       .cause = position ? "position" : dp_cause_name((dp_cause)cause),
                       .share = share_of(r, cause),
                       .percent = 100.0 * share_of(r, cause),
                       .step = remedy_step(r->z),
                       .remedy = remedy,
                       .remedy_separation = remedy.text != NULL ? remedy.separation : (double)NAN};
    return &b->found;
}

static void write_cause(row *r, int i) {
    const double share = share_of(r, i);
    const number_text part = number_brief(number_of(r->parts.cause[i], DIGITS_PART));
    if (isinf(r->parts.separation)) /* no parts of what does not exist */
        snprintf(r->cause[i], sizeof r->cause[i], "- %4s", "-");
    else
        snprintf(r->cause[i], sizeof r->cause[i], share > 0.0 && share < 0.005 ? "%s  <1%%" : "%s %3.0f%%", part.text,
                 100.0 * share);
}

static void *next_row(void *of, size_t index) {
    budget *b = of;
    row *r = &b->row;
    if (!each_setup_depth(&b->each, index, &r->z)) {
        if (!b->shader) {
            choosing_finish(&b->choice);
            choice_fields_of(&b->choice, &b->chosen_fields);
        }
        b->worst = find_worst(b);
        return NULL;
    }
    dp_budget_terms terms;
    budget_by(b, b->scheme, b->each.setup, r->z, &terms, &r->parts);
    r->facing = r->parts.separation;
    if (b->each.triangles != NULL) {
        dp_budget facing = {0};
        budget_by(b, b->scheme, &b->facing, r->z, &terms, &facing);
        r->facing = facing.separation;
    }
    r->certain = dp_is_certain(&b->facing, r->z, r->facing);
    for (int i = 0; i < DP_CAUSE_COUNT && b->o->out.form == FORM_TEXT; i++)
        write_cause(r, i);
    note(b, r);
    return r;
}

static void *next_setup(void *of, size_t i) {
    budget *b = of;
    if (!each_setup_go(&b->each, i))
        return NULL;
    setup_fields_budget(b->each.setup, &b->each.fields);
    b->shader = b->each.setup->curve == DP_CURVE_LOG;
    b->chosen = b->shader ? NULL : &b->chosen_fields;
    b->staged_times = (double)NAN;
    b->facing = dp_setup_facing(b->each.setup);
    b->choice = choosing_start(&b->facing, b->o->camera.tolerance);
    b->hopeless = b->largest.z = b->largest.parts.separation = (double)NAN;
    return b;
}

/* ---- Text -------------------------------------------------------------------------------------------------------- */

static void say_setup(page *p, void *item) {
    const budget *b = item;
    each_setup_title(p, item);
    if (b->scheme != NULL)
        page_title(p, "from origin %s, scheme %s%s%s", camera_length(b->each.here, b->terms.world, 0).text,
                   b->scheme_name, b->scheme->row->size != NULL ? ":" : "",
                   b->scheme->row->size != NULL ? number_full(b->scheme->size).text : "");
    else if (b->composition != NULL)
        page_title(p, "from origin %s, composition %s", camera_length(b->each.here, b->terms.world, 0).text,
                   b->composition);
    if (b->shader)
        page_title(p, "log2 %s: %s", dp_log2_get(b->terms.log2)->name, dp_log2_get(b->terms.log2)->note);
    slant_say(p, page_title, &b->o->camera, b->each.setup);
}

/* ---- Columns ----------------------------------------------------------------------------------------------------- */

/* Text has the causes that there can be. */
#define CAUSE(id, name, needed, its_spare)                                                                             \
    {FIELD(row, parts.cause[id], name, "scene")}, {                                                                    \
        TEXT_FIELD(row, cause[id], name, 14, 0), .when = (needed), .spare = (its_spare)                                \
    }
#define SLANT_CAUSE(id, name)                                                                                          \
    {FIELD(row, parts.cause[id], name, "scene"), .when = WITH_TRIANGLES}, {                                            \
        TEXT_FIELD(row, cause[id], name, 14, 0), .when = WITH_TRIANGLES                                                \
    }
#define LOG_CAUSE(id, name, its_spare)                                                                                 \
    {FIELD(row, parts.cause[id], name, "scene"), .when = WITH_LOG}, {                                                  \
        TEXT_FIELD(row, cause[id], name, 14, 0), .when = WITH_LOG, .spare = (its_spare)                                \
    }
static const column cause_columns[] = {
    CAUSE(DP_CAUSE_EYE, "eye", 0, 3),
    {FIELD(row, parts.cause[DP_CAUSE_COMPOSITION], "composition", "scene"), .when = COMPOSED},
    {TEXT_FIELD(row, cause[DP_CAUSE_COMPOSITION], "composition", 14, 0), .when = COMPOSED | WITH_WORLD},
    {FIELD(row, parts.cause[DP_CAUSE_COMPOSITION], "position", "scene"), .when = WITH_SCHEME},
    {TEXT_FIELD(row, cause[DP_CAUSE_COMPOSITION], "position", 14, 0), .when = WITH_SCHEME},
    CAUSE(DP_CAUSE_PROJECTION, "projection", WITH_MATRIX, 4),
    LOG_CAUSE(DP_CAUSE_ARGUMENT, "argument", 0),
    LOG_CAUSE(DP_CAUSE_LOG2, "log2", 0),
    LOG_CAUSE(DP_CAUSE_SCALE, "scale", 5),
    CAUSE(DP_CAUSE_NDC, "ndc", WITH_DIVIDE, 1),
    SLANT_CAUSE(DP_CAUSE_SNAPPING, "snapping"),
    SLANT_CAUSE(DP_CAUSE_SETUP, "set-up"),
    CAUSE(DP_CAUSE_INTERPOLATION, "interpolation", WITH_INTERPOLATION, 0),
    CAUSE(DP_CAUSE_FORMAT, "format", 0, 2),
    CAUSE(DP_CAUSE_LINEARIZATION, "linearization", WITH_LINEARIZE, 0),
    {.kind = COLUMN_END}};

static const column row_columns[] = {
    {FIELD(row, z, "z", "scene"), SHOWN("z", 11, DIGITS_Z)},
    {FIELD(row, parts.separation, "separation", "scene"), SHOWN("guaranteed", 12, DIGITS_MORE), .upward = true},
    {FIELD(row, facing, "guarantee_facing", "scene"), .when = WITH_TRIANGLES},
    {FIELD(row, parts.separation, "guarantee_slanted", "scene"), .when = WITH_TRIANGLES},
    {FIELD(row, parts.window, "window", "")},
    {GROUP("causes", cause_columns)},
    {FIELD(row, certain, "certain", "")},
    {.kind = COLUMN_END}};

static const column worst_columns[] = {
    {FIELD(worst, z, "z", "scene"), .digits = DIGITS_MORE},
    {FIELD(worst, separation, "separation", "scene"), .digits = DIGITS, .upward = true},
    {FIELD(worst, cause, "cause", "")},
    {FIELD(worst, share, "share", "")},
    {FIELD(worst, percent, "percent", ""), .fixed = true, .only = AS_TEXT},
    {FIELD(worst, remedy.text, "remedy", "")},
    {FIELD(worst, remedy_separation, "remedy_separation", "scene"), .digits = DIGITS, .upward = true},
    {FIELD(worst, step, "step", "scene"), .digits = DIGITS, .only = AS_TEXT},
    {.kind = COLUMN_END}};

static const column setup_report[] = {
    {PART(budget, each.fields, NULL, setup_columns)},
    {FIELD(budget, each.fields.arith, "arith", ""), .only = AS_CSV},
    {LIST("rows", row_columns, next_row)},
    {FIELD(budget, composition, "composition", ""), .only = AS_CSV},
    {FIELD(budget, scheme_name, "scheme", ""), .only = AS_CSV, .when = WITH_SCHEME},
    {FIELD(budget, log2, "log2", ""), .only = AS_CSV, .when = WITH_LOG},
    {PART(budget, worst, "worst", worst_columns), .only = AS_JSON, .pointed = true},
    {PART(budget, chosen, "auto", choice_columns), .only = AS_JSON, .pointed = true},
    {FIELD(budget, hopeless, "hopeless", "scene"), .digits = DIGITS_MORE, .only = AS_TEXT},
    {FIELD(budget, staged_times, "staged_times", ""), .digits = 3, .upward = true, .only = AS_TEXT},
    {FIELD(budget, staged_z, "staged_z", "scene"), .digits = DIGITS_MORE, .only = AS_TEXT},
    {.kind = COLUMN_END}};

enum { NO_GAIN = 512 };

#define TAKEN "at z = {worst.z} {worst.cause} takes {worst.percent} %: "
static const sentence words[] = {
    LINE("at z = {hopeless} no separation is guaranteed: everything nearer may share its code", WITH_TRIANGLES),
    ELSE("at z = {hopeless} no separation is guaranteed: everything farther may share its code", 0),
    LINE(TAKEN "{worst.remedy} would need {worst.remedy_separation} in place of {worst.separation}", 0),
    ELSE(TAKEN "nothing to gain: binary32 depths themselves are {worst.step} apart there", NO_GAIN),
    ELSE(TAKEN "no other format or mapping helps", 0),
    LINE("model staged leaves the shader out: with it the guarantee is {staged_times} times as large at z = {staged_z}",
         0),
    SENTENCE_END};

static void say_notes(page *p, void *item) {
    const budget *b = item;
    const unsigned added = conditions(b) & ~(unsigned)(COMPOSED | WITH_LOG | WITH_MATRIX | WITH_DIVIDE);
    page_say(p, words, setup_report, item,
             conditions(b) | (b->worst != NULL && b->worst->separation < 2.0 * b->worst->step ? NO_GAIN : 0));
    if (!b->shader && b->worst != NULL) /* where nothing is guaranteed no model changes that */
        choice_say(p, &b->choice, added != 0 ? "without the added terms " : "");
}

static const column term_columns[] = {{FIELD(budget, terms.interpolation, "interpolation", "")},
                                      {FIELD(budget, terms.world, "from_origin", "scene")},
                                      {FIELD(budget, composition, "composition", "")},
                                      {FIELD(budget, scheme_name, "scheme", ""), .when = WITH_SCHEME},
                                      {FIELD(budget, linearize, "linearize", "")},
                                      {FIELD(budget, log2, "log2", ""), .when = WITH_LOG},
                                      {.kind = COLUMN_END}};

static const column columns[] = {
    {GROUP("terms", term_columns), .only = AS_JSON},
    {PART(budget, each.triangles, "triangles", slant_columns), .only = AS_JSON, .pointed = true, .optional = true},
    {LIST("setups", setup_report, next_setup), .head = say_setup, .notes = say_notes},
    {.kind = COLUMN_END}};

/* One scheme; `absolute` is what --from-origin means without. */
static int take_scheme(budget *b, const budget_request *o) {
    if (!(o->origin.terms.world > 0.0))
        return option_error("scheme", "needs --from-origin: eye depth is given");
    if (o->origin.scheme_count != 1)
        return option_error("scheme", "must be one scheme for budget, got %zu", o->origin.scheme_count);
    if (o->origin.schemes[0].row == world_get(0))
        return EXIT_FINE;
    if (o->camera.ortho)
        return option_error("scheme", "conflicts with --ortho; --composition does not");
    if (option_given(o->line, "composition"))
        return option_error("composition", "conflicts with --scheme %s", o->origin.schemes[0].row->name);
    b->scheme = &o->origin.schemes[0];
    b->scheme_name = b->scheme->row->name;
    return EXIT_FINE;
}

int cmd_budget(void *request) {
    const budget_request *o = request;
    budget b = {.o = o,
                .terms = o->origin.terms,
                .log2 = dp_log2_get(o->origin.terms.log2)->name,
                .linearize = o->origin.terms.linearize != 0};
    budget_request in_binary32 = *o;
    in_binary32.camera.model = DP_MODEL_FLOAT;
    in_binary32.camera.budgeted = true;
    int status = EXIT_FINE;
    if (option_given(o->line, "scheme"))
        status = take_scheme(&b, o);
    if (status != EXIT_FINE)
        return status;
    if (o->origin.terms.world > 0.0 && b.scheme == NULL)
        b.composition = dp_composition_get(o->origin.terms.composition)->name;
    else if (option_given(o->line, "composition") && b.scheme == NULL)
        return option_error("composition", "needs --from-origin: eye depth is given");
    status = each_setup_start(&b.each, &in_binary32.camera, &in_binary32.out);
    if (status == EXIT_FINE)
        status = depths_in_binary32(&b.each.at);
    const report_spec spec = {"budget", columns, &b, .when = conditions(&b)};
    return each_setup_write(&b.each, &spec, status);
}
