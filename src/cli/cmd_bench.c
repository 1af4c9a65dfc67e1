/* SPDX-License-Identifier: GPL-3.0-or-later */
/* bench: the methods of a family on the same inputs, their times and their worst errors. */
#include <math.h>
#include <stdio.h>

#include "cli/methods.h"
#include "cli/setups.h"
#include "method/choose.h"
#include "method/estimate.h"
#include "report/number.h"
#include "report/report.h"

/* A method, as it is shown. */
typedef struct line {
    bench_result of;
    const char *name;
    char label[64]; /* "*>rcp24", with the marks that the notes explain */
    double limits, percent, error;
    double setup;      /* NaN where there is nothing to prepare */
    int front, chosen; /* 0 or 1 */
} line;

typedef struct benching {
    const options *o;
    methods_asked asked;
    setup_fields fields;
    const char *family, *measure;
    bench_result results[BENCH_METHODS_MAX];
    size_t count;
    size_t order[BENCH_METHODS_MAX]; /* in which they are shown */
    const method_row *choice;        /* with --tolerance; null when no claim covers it */
    const char *choice_name;
    double tolerance; /* NaN when not given */
    double limit;     /* ns */
    char machine[192];
    line line;
} benching;

static void *next_method(void *of, size_t i) {
    benching *b = of;
    line *l = &b->line;
    if (i == b->count)
        return NULL;
    const bench_result *r = &b->results[b->order[i]];
    *l = (line){.of = *r,
                .name = r->row->name,
                .limits = r->ns / r->limit,
                .percent = 100 * r->spread,
                .error = measured_error(b->asked.family, &r->measured),
                .setup = r->setup > 0 ? r->setup : (double)NAN,
                .front = r->front,
                .chosen = r->row == b->choice};
    snprintf(l->label, sizeof l->label, "%c%c%s", r->front ? '*' : ' ', l->chosen ? '>' : ' ', l->name);
    return l;
}

static void say_inputs(page *p, void *item) {
    const benching *b = item;
    const method_family_row *f = b->asked.family;
    page_title(p, "%s: %s", f->name, f->summary);
    page_text(p, "%s, near %s, far %s; %s", f->cases[b->asked.which].name, number_full(b->o->znear).text,
              number_full(b->o->zfar).text, b->machine);
}

/* Families count in steps of a code or in units in the last place, and of some methods bounds are proven. */
enum { IN_STEPS = 1, IN_ULP = 2, BOUNDED = 4 };

static unsigned shown(const benching *b) {
    unsigned when = b->asked.family->steps ? IN_STEPS : IN_ULP;
    for (size_t i = 0; i < b->count; i++)
        when |= isnan(b->results[i].bound) ? 0 : BOUNDED;
    return when;
}

static void say_marks(page *p, void *item) {
    const benching *b = item;
    page_line(p, "ns: per element, the median; x memory: multiple of the %.3g ns that moving the same bytes takes",
              b->limit);
    if ((shown(b) & BOUNDED) != 0)
        page_line(p, "bound: of any depth of this camera, proven; claim: of any camera with this far/near");
    page_line(p, "* Pareto front: no other method is both faster and more exact");
    for (size_t i = 0; i < b->count; i++)
        if (b->results[i].row->timed != NULL)
            page_line(p,
                      "%s: timed with this processor's estimate; its errors are those of a model, and every processor "
                      "stays within the guarantee of %.3g and the method within its claim",
                      b->results[i].row->name, ESTIMATE_WORST);
    if (b->choice != NULL)
        page_line(p, "> %s is the cheapest whose claim is within the tolerance", b->choice_name);
    else if (!isnan(b->tolerance))
        page_line(p, "no method claims to be within the tolerance here");
}

/* Text is for a reader who wants the fastest that is exact enough. */
static void order(benching *b) {
    for (size_t i = 0; i < b->count; i++) {
        size_t at = i;
        for (; b->o->form == FORM_TEXT && at > 0 && b->results[i].ns < b->results[b->order[at - 1]].ns; at--)
            b->order[at] = b->order[at - 1];
        b->order[at] = i;
    }
}

static const column line_columns[] = {
    {FIELD(line, name, "name", ""), .only = AS_JSON},
    {FIELD(line, name, "method", ""), .only = AS_CSV},
    {TEXT_FIELD(line, label, "  method", -21, 0)},
    {FIELD(line, of.ns, "ns", ""), SHOWN("ns", 8, 3)},
    {FIELD(line, limits, "limits", ""), SHOWN("x memory", 10, 3), .only = AS_JSON | AS_TEXT},
    {FIELD(line, of.spread, "spread", "")},
    {TEXT_FIELD(line, percent, "+- %", 8, 2), .spare = 2},
    {FIELD(line, of.setup, "setup_ns", ""), .only = AS_JSON},
    {FIELD(line, of.setup, "setup", "ns"), .only = AS_CSV},
    {TEXT_FIELD(line, setup, "set-up ns", 10, 3), .spare = 1},
    {FIELD(line, of.inputs, "inputs", "")},
    {FIELD(line, error, "error", "")},
    {FIELD(line, of.measured.worst.relative, "relative", ""), SHOWN("relative", 10, 3)},
    {FIELD(line, of.at_relative, "relative_at", "")},
    {FIELD(line, of.measured.worst.absolute, "absolute", ""), SHOWN("absolute", 10, 3), .spare = 4},
    {FIELD(line, of.at_absolute, "absolute_at", "")},
    {FIELD(line, of.measured.worst.ulp, "ulp", "")},
    {TEXT_FIELD(line, of.measured.worst.ulp, "steps", 10, 3), .when = IN_STEPS},
    {TEXT_FIELD(line, of.at_ulp, "worst at", 14, 9), .when = IN_STEPS, .spare = 3},
    {TEXT_FIELD(line, of.measured.worst.ulp, "ulp", 10, 3), .when = IN_ULP},
    {TEXT_FIELD(line, of.at_relative, "worst at", 14, 9), .when = IN_ULP, .spare = 3},
    {FIELD(line, of.at_ulp, "ulp_at", "")},
    {TEXT_FIELD(line, of.bound, "bound", 10, 3), .when = BOUNDED},
    {FIELD(line, of.claim, "claim", ""), SHOWN("claim", 10, 3)},
    {FIELD(line, of.bound, "bound", ""), .only = AS_JSON},
    {FIELD(line, of.front, "pareto", ""), .only = AS_JSON},
    {FIELD(line, front, "pareto", ""), .only = AS_CSV},
    {FIELD(line, chosen, "chosen", ""), .only = AS_CSV},
    {FIELD(line, of.limit, "limit", "ns"), .only = AS_CSV},
    {FIELD(line, of.bound, "bound", ""), .only = AS_CSV},
    {.kind = COLUMN_END}};

static const column columns[] = {{FIELD(benching, family, "family", "")},
                                 {FIELD(benching, measure, "measure", ""), .only = AS_JSON},
                                 {FIELD(benching, machine, "machine", ""), .only = AS_JSON},
                                 {PART(benching, fields, NULL, setup_columns), .only = AS_JSON},
                                 {FIELD(benching, tolerance, "tolerance", ""), .only = AS_JSON},
                                 {FIELD(benching, choice_name, "choice", ""), .only = AS_JSON},
                                 {FIELD(benching, limit, "limit_ns", ""), .only = AS_JSON},
                                 {LIST("methods", line_columns, next_method)},
                                 {.kind = COLUMN_END}};

int cmd_bench(const options *o) {
    output out;
    benching b = {.o = o, .tolerance = option_given(o, OPTION_TOLERANCE) ? o->tolerance : (double)NAN};
    int status = methods_resolve(o, o->operand_row, &b.asked);
    if (status == EXIT_FINE)
        status = options_open(o, &out);
    if (status != EXIT_FINE)
        return status;
    b.count = bench_run(b.asked.family, b.asked.which, &b.asked.setup, BENCH_REPETITIONS, b.results);
    if (b.count == 0) {
        output_abandon(&out);
        return usage_error("no memory for the methods");
    }
    const double ratio = o->zfar / o->znear;
    const method_wish wish = {.tolerance = o->tolerance, .ratio_lo = fmin(ratio, METHOD_RATIO_HI), .ratio_hi = ratio};
    if (!isnan(b.tolerance))
        b.choice = method_choose(b.asked.family, b.asked.which, &wish);
    methods_machine(b.machine, sizeof b.machine);
    b.choice_name = b.choice != NULL ? b.choice->name : NULL;
    b.family = b.asked.family->name;
    b.measure = b.asked.family->measure;
    b.fields = setup_fields_of(&b.asked.setup, options_unit(o));
    b.limit = b.results[0].limit;
    order(&b);
    report_write(&(report_spec){"bench", columns, &b, .when = shown(&b), .head = say_inputs, .notes = say_marks}, &out,
                 o->form);
    return output_close(&out);
}
