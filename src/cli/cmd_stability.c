/* SPDX-License-Identifier: GPL-3.0-or-later */
/* stability: where the methods of a family lose what they claim. */
#include <math.h>

#include "cli/methods.h"
#include "report/report.h"

/* A method in a case, and a step of its walk. */
typedef struct line {
    stability_result of;
    const char *name, *of_case, *verdict;
    double claim_to;              /* NaN where nothing is claimed */
    double breaks;                /* NaN: never */
    double ratio, error, claimed; /* NaN beyond the claim's span */
} line;

typedef struct walking {
    const method_family_row *family;
    const char *name, *measure;
    stability_result results[STABILITY_MAX];
    size_t count;
    line line;
} walking;

static void *next_step(void *of, size_t k) {
    line *l = of;
    const stability_result *r = &l->of;
    const method_claim *claim = &r->row->claims[r->which];
    if ((int)k == r->steps)
        return NULL;
    l->ratio = r->ratio[k];
    l->error = r->error[k];
    l->claimed = l->ratio <= claim->ratio_hi * (1 + 1e-9) ? method_claim_at(claim, l->ratio) : (double)NAN;
    return l;
}

static void *next_method(void *of, size_t i) {
    walking *w = of;
    if (i == w->count)
        return NULL;
    const stability_result *r = &w->results[i];
    const method_claim *claim = &r->row->claims[r->which];
    w->line = (line){.of = *r,
                     .name = r->row->name,
                     .of_case = w->family->cases[r->which].name,
                     .verdict = stability_verdict_name(r->verdict),
                     .claim_to = isnan(claim->worst) ? (double)NAN : claim->ratio_hi,
                     .breaks = isinf(r->breaks) ? (double)NAN : r->breaks};
    return &w->line;
}

static void say_family(page *p, void *item) {
    const method_family_row *f = ((const walking *)item)->family;
    page_title(p, "%s: %s; worst %s for far/near from 10 to 1e12", f->name, f->summary, f->measure);
    page_line(p, "worst: the error nearest to its claim; claim: at that far/near, where 'list methods' "
                 "has the claim at 10000");
}

static const column step_columns[] = {{FIELD(line, ratio, "ratio", "")},
                                      {FIELD(line, error, "error", "")},
                                      {FIELD(line, claimed, "claim", ""), .only = AS_JSON},
                                      {.kind = COLUMN_END}};

/* In CSV a line is a step. */
static const column line_columns[] = {
    {FIELD(line, name, "name", ""), SHOWN("method", -18, 0), .only = AS_JSON | AS_TEXT},
    {FIELD(line, name, "method", ""), .only = AS_CSV},
    {FIELD(line, of_case, "case", ""), SHOWN("case", -13, 0)},
    {FIELD(line, of.claim, "claim", ""), SHOWN("claim", 9, 3), .only = AS_JSON | AS_TEXT},
    {FIELD(line, claimed, "claim", ""), .only = AS_CSV},
    {FIELD(line, claim_to, "claim_to", ""), SHOWN("up to", 9, 3)},
    {FIELD(line, of.inside, "worst", ""), SHOWN("worst", 9, 3), .only = AS_JSON | AS_TEXT},
    {FIELD(line, of.inside_near, "worst_near", ""), .only = AS_JSON},
    {FIELD(line, of.inside_far, "worst_far", ""), .only = AS_JSON},
    {FIELD(line, of.inside_at, "worst_at", ""), .only = AS_JSON},
    {FIELD(line, breaks, "breaks", ""), SHOWN("breaks at", 10, 3), .only = AS_JSON | AS_TEXT},
    {FIELD(line, of.infinite, "infinite", ""), SHOWN("far inf", 10, 3), .only = AS_JSON | AS_TEXT, .spare = 2},
    {FIELD(line, of.ortho, "ortho", ""), SHOWN("ortho", 10, 3), .only = AS_JSON | AS_TEXT, .spare = 1},
    {FIELD(line, verdict, "verdict", ""), SHOWN("verdict", -8, 0)},
    {LIST("walk", step_columns, next_step)},
    {.kind = COLUMN_END}};

static const column columns[] = {{FIELD(walking, name, "family", "")},
                                 {FIELD(walking, measure, "measure", ""), .only = AS_JSON},
                                 {LIST("methods", line_columns, next_method)},
                                 {.kind = COLUMN_END}};

/* A claim that does not hold, or holds far too easily, is a check that failed. */
static bool all_hold(const walking *w) {
    for (size_t i = 0; i < w->count; i++)
        if (w->results[i].verdict == STABILITY_BROKEN || w->results[i].verdict == STABILITY_MODEST)
            return false;
    return true;
}

int cmd_stability(const options *o) {
    output out;
    walking w = {.family = o->operand_row};
    int status = options_open(o, &out);
    if (status != EXIT_FINE)
        return status;
    w.count = stability_run(w.family, w.results);
    if (w.count == 0) {
        output_abandon(&out);
        return usage_error("no memory for the methods");
    }
    w.name = w.family->name;
    w.measure = w.family->measure;
    report_write(&(report_spec){"stability", columns, &w, .head = say_family}, &out, o->form);
    status = output_close(&out);
    return status == EXIT_FINE && !all_hold(&w) ? EXIT_FAILED : status;
}
