/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The findings of solve in columns: JSON, CSV and the table of alternatives. */
#include <math.h>
#include <string.h>

#include "camera/cmd/setups.h"
#include "camera/cmd/slant.h"
#include "solve/cmd_solve/report.h"
#include "solve/cmd_solve/request.h"

/* All from the answer to `until` pass. */
typedef struct plane_fields {
    double until;
    bool proven, certain;
} plane_fields;

/* The same question answered of surfaces at any slant, in the view that is assumed. */
typedef struct any_slant {
    solve_candidate found;
    dp_triangles view;
    double plane, distance; /* NaN where there is none */
    const double *near, *far;
} any_slant;

/* The findings about a candidate; parts that are not asked for or do not exist are null. */
typedef struct candidate {
    solve_candidate found;
    setup_fields setup;
    const char *model;
    double guaranteed, slanted;
    plane_fields fields;
    const plane_fields *plane;                /* where one was found */
    const double *lattice_near, *lattice_far; /* where it was solved for */
    double distance, lattice_distance;        /* NaN where it does not hold at all */
    char plane_text[NUMBER_SIZE], ideal_text[NUMBER_SIZE], slanted_text[NUMBER_SIZE];
    any_slant slanted_too;
    const any_slant *assumed; /* null where no view is */
    const char *role;
    double from, to;
} candidate;

typedef struct solving {
    solve_report report;
    const char *target, *measure;
    slant_fields slant;
    const slant_fields *triangles; /* null: surfaces face the camera */
    dp_setup setup;                /* of the candidate: the answer, or the one at hand */
    candidate candidate;
} solving;

static void take_slanted(candidate *x, const solve_candidate *c) {
    any_slant *a = &x->slanted_too;
    *a = (any_slant){.found = *c,
                     .view = c->spec.triangles,
                     .plane = c->possible ? c->plane.value : (double)NAN,
                     .distance = c->possible ? c->distance.value : (double)NAN};
    *(c->unknown == SOLVE_NEAR ? &a->near : &a->far) = c->solved ? &a->plane : NULL;
    x->assumed = c->spec.triangles.width > 0 ? a : NULL;
}

static void take_candidate(solving *s, const solve_candidate *c) {
    candidate *x = &s->candidate;
    const bool solved = c->solved && c->possible;
    *x = (candidate){.found = *c,
                     .guaranteed = solve_in_binary32(&s->report, c, false),
                     .slanted = solve_in_binary32(&s->report, c, true),
                     .distance = c->possible ? c->distance.value : (double)NAN,
                     .lattice_distance = c->lattice.possible ? c->lattice.value : (double)NAN};
    x->fields = (plane_fields){.until = solved ? c->plane.until : (double)NAN,
                               .proven = solved || c->plane.certain,
                               .certain = c->plane.certain};
    x->plane = c->solved ? &x->fields : NULL;
    *(c->unknown == SOLVE_NEAR ? &x->lattice_near : &x->lattice_far) = c->solved ? &x->found.lattice.value : NULL;
    take_slanted(x, &s->report.slanted[c - s->report.items]);
    s->setup = (dp_setup){.spec = c->spec};
    x->setup = setup_fields_asked(&s->setup, &s->report.o->camera);
    x->model = option_word("model", c->spec.model);
}

/* ---- The table of alternatives ----------------------------------------------------------------------------------- */

/* Its plane or distance; "none" where there is none. */
static number_text plane_cell(const solve_report *r, const solve_candidate *c) {
    number_text plane = {"none"};
    if (c->possible && r->target == SOLVE_FOR_DISTANCE)
        plane = number_down(c->distance.value, SOLVE_DIGITS);
    else if (c->possible && c->solved)
        plane = solve_safe_digits(r, c, solve_plane_of(c), c->plane.until);
    else if (c->possible)
        plane = number_of(r->target == SOLVE_FOR_FAR ? c->spec.zfar : c->spec.znear, SOLVE_DIGITS);
    return plane;
}

/* Its plane or distance, or what it reaches; and the same in the lattice, and at any slant. */
static void write_cells(const solve_report *r, candidate *x) {
    const solve_candidate *c = &x->found;
    const bool by_plane = r->target == SOLVE_FOR_NEAR || r->target == SOLVE_FOR_FAR || r->target == SOLVE_FOR_DISTANCE;
    const double ideal = by_plane ? c->lattice.value : c->lattice.reached.value;
    const bool upward = !by_plane || r->target == SOLVE_FOR_NEAR;
    number_text lattice = {"none"};
    if (c->lattice.possible || !by_plane)
        lattice = upward ? number_up(ideal, SOLVE_DIGITS) : number_down(ideal, SOLVE_DIGITS);
    strcpy(x->plane_text, plane_cell(r, c).text);
    number_text slanted = {"none"};
    if (x->assumed != NULL)
        slanted = r->target == SOLVE_FOR_SEPARATION ? number_up(x->assumed->found.reached.value, SOLVE_DIGITS)
                                                    : plane_cell(r, &x->assumed->found);
    strcpy(x->slanted_text, slanted.text);
    strcpy(x->ideal_text, lattice.text);
}

static void *next_alternative(void *of, size_t i) {
    solving *s = of;
    if (i + 1 >= s->report.count)
        return NULL;
    take_candidate(s, &s->report.items[i + 1]);
    if (s->report.o->out.form == FORM_TEXT)
        write_cells(&s->report, &s->candidate);
    return &s->candidate;
}

static void say_others(page *p, void *item) {
    const solve_report *r = item;
    if (r->count > 1)
        output_format(p->out, "\n%s%s%s\n",
                      r->target == SOLVE_FOR_SEPARATION ? "Others" : "Alternatives, cheapest first",
                      r->o->camera.lengths.unit != NULL ? ", lengths in " : "",
                      r->o->camera.lengths.unit != NULL ? r->o->camera.lengths.unit->name : "");
}

/* The first possible alternative with its format, so that a caution is said once. */
static bool is_first_of_format(const solve_report *r, size_t index) {
    for (size_t i = 1; i < index; i++)
        if (r->items[i].possible && strcmp(r->items[i].spec.format.name, r->items[index].spec.format.name) == 0)
            return false;
    return true;
}

static void say_cautions(page *p, void *item) {
    const solve_report *r = item;
    for (size_t i = 1; i < r->count && r->target != SOLVE_FOR_SEPARATION; i++)
        if (is_first_of_format(r, i) && r->items[i].possible && r->items[i].price.caution[0] != '\0')
            page_line(p, "%s", r->items[i].price.caution);
}

static void *next_again(void *of, size_t i) {
    solve_report *r = of;
    return i < r->again_count ? &r->again[i] : NULL;
}

/* ---- CSV --------------------------------------------------------------------------------------------------------- */

static void *next_island(void *of, size_t i) {
    solve_candidate *c = &((solve_report *)of)->items[0];
    return i == 0 && c->solved && c->lattice.possible ? &c->island : NULL;
}

static void *next_line(void *of, size_t i) {
    solving *s = of;
    const solve_report *r = &s->report;
    candidate *x = &s->candidate;
    if (i == r->count)
        return NULL;
    take_candidate(s, &r->items[i]);
    x->role = i == 0 ? "answer" : "alternative";
    const bool holds = r->target == SOLVE_FOR_DISTANCE && x->found.possible;
    const double a = x->plane != NULL ? (x->found.possible ? x->found.plane.value : (double)NAN)
                     : holds          ? r->lo
                                      : (double)NAN;
    const double b = x->plane != NULL ? x->plane->until : holds ? x->distance : a;
    x->from = fmin(a, b);
    x->to = fmax(a, b);
    return s;
}

/* ---- Columns ----------------------------------------------------------------------------------------------------- */

enum {
    OF_SEPARATION = 1,
    OF_OTHERS = 2,
    OF_DISTANCE = 4,
    WITH_TRIANGLES = 8,
    WITH_ASSUMED = 16,
    WITH_MODELS = 32,
    NO_DISTANCE = 64
};

static const column plane_columns[] = {{FIELD(plane_fields, until, "until", "scene")},
                                       {FIELD(plane_fields, proven, "proven", "")},
                                       {FIELD(plane_fields, certain, "certain", "")},
                                       {.kind = COLUMN_END}};

static const column line_columns[] = {
    {FIELD(solving, candidate.role, "role", "")},
    {PART(solving, candidate.setup, NULL, setup_columns)},
    {FIELD(solving, target, "for", "")},
    {FIELD(solving, candidate.found.possible, "possible", "")},
    {FIELD(solving, measure, "measure", "")},
    {FIELD(solving, report.limit, "limit", "scene")},
    {FIELD(solving, candidate.found.reached.value, "value", "scene")},
    {FIELD(solving, candidate.found.reached.z, "z", "scene")},
    {FIELD(solving, candidate.from, "from", "scene")},
    {FIELD(solving, candidate.to, "to", "scene")},
    {FIELD(solving, candidate.found.price.bytes, "bytes", "")},
    {FIELD(solving, candidate.found.price.available, "available", "")},
    {FIELD(solving, candidate.found.lattice.value, "lattice", "scene")},
    {FIELD(solving, candidate.found.lattice.reached.value, "lattice value", "scene")},
    GUARANTEES(solving, candidate.guaranteed, candidate.slanted, 0, 0, WITH_TRIANGLES),
    {.kind = COLUMN_END}};

static const column span_columns[] = {
    {FIELD(distance_span, lo, "lo", "scene")}, {FIELD(distance_span, hi, "hi", "scene")}, {.kind = COLUMN_END}};

static const column fight_columns[] = {{FIELD(solve_fight, first, "first", "scene")},
                                       {FIELD(solve_fight, searched, "searched_to", "scene")},
                                       {.kind = COLUMN_END}};

/* The model is told where it is not the same of all, or nothing is told of slants. */
static unsigned conditions(const solve_report *r) {
    bool assumed = false, alike = true;
    for (size_t i = 0; i < r->count; i++) {
        assumed = assumed || r->slanted[i].spec.triangles.width > 0;
        alike = alike && r->items[i].spec.model == r->items[0].spec.model;
    }
    return (r->target == SOLVE_FOR_SEPARATION ? OF_SEPARATION : OF_OTHERS) |
           (r->target == SOLVE_FOR_DISTANCE ? OF_DISTANCE : NO_DISTANCE) |
           (r->o->camera.triangles.width > 0 ? WITH_TRIANGLES : 0) | (assumed ? WITH_ASSUMED : 0) |
           (assumed && alike ? 0 : WITH_MODELS);
}

static const column any_columns[] = {{PART(any_slant, view, NULL, slant_view_columns)},
                                     {FIELD(any_slant, found.possible, "possible", "")},
                                     {FIELD(any_slant, near, "near", "scene"), .optional = true},
                                     {FIELD(any_slant, far, "far", "scene"), .optional = true},
                                     {FIELD(any_slant, distance, "distance", "scene"), .when = OF_DISTANCE},
                                     {FIELD(any_slant, found.reached.value, "separation", "scene")},
                                     {FIELD(any_slant, found.reached.z, "z", "scene"), .when = NO_DISTANCE},
                                     {.kind = COLUMN_END}};

/* By target. */
static const char *const heads[] = {"least near", "largest far", "near", "near", "", "distance"};

/* Writes the report; the quantities measured and solved for name columns. */
void solve_report_write(const solve_report *r, output *out) {
    solving s = {.report = *r, .target = option_word("for", r->target), .measure = solve_measure_name(r)};
    const column lattice[] = {{FIELD(candidate, found.lattice.possible, "possible", "")},
                              {FIELD(candidate, lattice_near, "near", "scene"), .optional = true},
                              {FIELD(candidate, lattice_far, "far", "scene"), .optional = true},
                              {FIELD(candidate, lattice_distance, "distance", "scene"), .when = OF_DISTANCE},
                              {FIELD(candidate, found.lattice.reached.value, s.measure, "scene")},
                              {FIELD(candidate, found.lattice.reached.z, "z", "scene")},
                              {.kind = COLUMN_END}};
    const column about[] = {{PART(candidate, setup, NULL, setup_columns)},
                            {FIELD(candidate, found.possible, "possible", "")},
                            {FIELD(candidate, found.reached.value, s.measure, "scene")},
                            {FIELD(candidate, found.reached.z, "z", "scene")},
                            {FIELD(candidate, guaranteed, "guaranteed", "scene")},
                            GUARANTEES(candidate, guaranteed, slanted, 0, 0, WITH_TRIANGLES),
                            {PART(candidate, plane, NULL, plane_columns), .pointed = true},
                            {FIELD(candidate, distance, "distance", "scene"), .when = OF_DISTANCE},
                            {FIELD(candidate, found.distance.throughout, "throughout", ""), .when = OF_DISTANCE},
                            {FIELD(candidate, found.distance.fails, "fails_from", "scene"), .when = OF_DISTANCE},
                            {GROUP("lattice", lattice)},
                            {PART(candidate, assumed, "any_slant", any_columns), .pointed = true, .optional = true},
                            {FIELD(candidate, found.price.bytes, "bytes", "")},
                            {FIELD(candidate, found.price.available, "available", "")},
                            {FIELD(candidate, found.price.caution, "caution", "")},
                            {FIELD(candidate, found.price.effort, "effort", "")},
                            {.kind = COLUMN_END}};
    const column beside[] = {
        {TEXT_FIELD(candidate, setup.format, "format", -9, 0)},
        {TEXT_FIELD(candidate, setup.mapping, "mapping", -12, 0)},
        {TEXT_FIELD(candidate, model, "model", -6, 0), .when = WITH_MODELS, .spare = 1},
        {TEXT_FIELD(candidate, plane_text, heads[r->target], 12, 0), .when = OF_OTHERS},
        {TEXT_FIELD(candidate, slanted_text, "any slant", 12, 0), .when = OF_OTHERS | WITH_ASSUMED},
        {TEXT_FIELD(candidate, ideal_text, "lattice", 12, 0), .when = OF_OTHERS},
        {TEXT_FIELD(candidate, found.reached.value, s.measure, 12, SOLVE_DIGITS), .upward = true},
        {TEXT_FIELD(candidate, slanted_text, "any slant", 12, 0), .when = OF_SEPARATION | WITH_ASSUMED},
        {TEXT_FIELD(candidate, ideal_text, "lattice", 12, 0), .when = OF_SEPARATION},
        {TEXT_FIELD(candidate, found.price.bytes, "bytes", 7, 0), .when = OF_OTHERS},
        {TEXT_FIELD(candidate, found.price.available, "availability", -42, 0), .when = OF_OTHERS, .spare = 2},
        {.kind = COLUMN_END}};
    const column columns[] = {
        {FIELD(solving, target, "for", ""), .only = AS_JSON},
        {FIELD(solving, measure, "measure", ""), .only = AS_JSON},
        {FIELD(solving, report.limit, "limit", ""), .only = AS_JSON},
        {FIELD(solving, report.lo, "lo", "scene"), .only = AS_JSON},
        {FIELD(solving, report.hi, "hi", "scene"), .only = AS_JSON},
        {FIELD(solving, candidate.found.possible, "possible", ""), .only = AS_JSON},
        {PART(solving, triangles, "triangles", slant_columns), .only = AS_JSON, .pointed = true, .optional = true},
        {PART(solving, candidate, "answer", about), .only = AS_JSON},
        {PART(solving, report.fight, "fight", fight_columns), .only = AS_JSON, .when = OF_DISTANCE},
        {LIST("again", span_columns, next_again), .only = AS_JSON, .when = OF_DISTANCE},
        {LIST("islands", span_columns, next_island), .only = AS_JSON},
        {LIST("alternatives", about, next_alternative), .only = AS_JSON},
        {LIST(NULL, beside, next_alternative), .only = AS_TEXT, .indent = 2, .head = say_others, .notes = say_cautions},
        {LIST(NULL, line_columns, next_line), .only = AS_CSV},
        {.kind = COLUMN_END}};
    const report_spec spec = {
        "solve", columns, &s, .when = conditions(r), .label = 15, .head = solve_report_answer, .verdict = true};
    s.triangles = slant_fields_of(&r->o->camera, &s.slant);
    take_candidate(&s, &r->items[0]);
    report_write(&spec, out, r->o->out.form);
}
