/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * methods: the ways to a quantity on the same inputs, their times and their worst errors, and from which far/near on
 * each errs more than it claims; without a family, which method of each to use (families.c).
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "camera/cmd/setups.h"
#include "core/append.h"
#include "method/choose.h"
#include "method/cmd_methods/families.h"
#include "method/cmd_methods/methods.h"
#include "method/cmd_methods/mine.h"
#include "method/cmd_methods/request.h"
#include "method/estimate.h"
#include "probe/compute.h"
#include "report/number.h"
#include "report/report.h"

/* A method, as it is shown; below `front`, what its walk over far/near found. */
typedef struct line {
    bench_result of;
    const char *name;
    char label[64]; /* "*>rcp24", with the marks that the notes explain */
    double limits, percent, error;
    double setup;      /* NaN where there is nothing to prepare */
    int front, chosen; /* 0 or 1 */
    stability_result walked;
    const char *of_case, *verdict;
    double breaks, lost;                     /* NaN: never */
    double ratio, wrong, claimed;            /* a step; the last is NaN beyond the claim's span */
    double device;                           /* ns there */
    const char *function, *computes, *given; /* of a function of the user's */
} line;

typedef struct measuring {
    const judge_request *o;
    methods_asked asked;
    setup_fields fields;
    const char *family, *measure;
    bench_result results[BENCH_METHODS_MAX];
    stability_result walked[BENCH_METHODS_MAX]; /* of the same methods */
    size_t count;
    size_t order[BENCH_METHODS_MAX], shown; /* those that are shown, in that order */
    const method_row *choice;               /* with --tolerance; null when no claim covers it */
    const char *choice_name;
    double tolerance; /* NaN when not given */
    double limit;     /* ns */
    char machine[192];
    line line;
    mine *mine; /* null: there are none */
    const char *device;
    double loop;    /* ns */
    struct absent { /* a method that is not measured, and why */
        const char *name, *because;
    } absent;
} measuring;

static const mine_row *mine_of(const measuring *b, const method_row *row) {
    return &b->mine->more[row - b->mine->rows];
}

static void take_mine(const measuring *b, const method_row *row, line *l) {
    const mine_row *m = b->mine != NULL ? mine_of(b, row) : NULL;
    if (m != NULL)
        l->device = m->ns;
    if (m == NULL || m->operand == NULL)
        return;
    l->verdict = judge_verdict_name(m->judged.verdict);
    l->function = m->operand;
    l->computes = m->judged.named ? m->judged.found.output->name : NULL;
    l->given = m->code.defines;
}

static void *next_method(void *of, size_t i) {
    measuring *b = of;
    line *l = &b->line;
    if (i == b->shown)
        return NULL;
    const bench_result *r = &b->results[b->order[i]];
    const stability_result *w = &b->walked[b->order[i]];
    *l = (line){.of = *r,
                .walked = *w,
                .of_case = b->asked.family->cases[b->asked.which].name,
                .verdict = stability_verdict_name(w->verdict),
                .breaks = isinf(w->breaks) ? (double)NAN : w->breaks,
                .lost = isinf(w->lost) ? (double)NAN : w->lost,
                .name = r->row->name,
                .limits = r->ns / r->limit,
                .percent = rint(1000 * r->spread) / 10,
                .error = measured_error(b->asked.family, &r->measured),
                .setup = r->setup > 0 ? r->setup : (double)NAN,
                .front = r->front,
                .chosen = r->row == b->choice};
    take_mine(b, r->row, l);
    snprintf(l->label, sizeof l->label, "%c%c%s", r->front ? '*' : ' ', l->chosen ? '>' : ' ', l->name);
    return l;
}

static void *next_absent(void *of, size_t i) {
    measuring *b = of;
    const method_family_row *f = b->asked.family;
    for (size_t k = 0; k < *f->method_count; k++) {
        const char *because = method_lacks(&f->methods[k], b->asked.which, &b->asked.setup);
        if (because == NULL || i-- > 0)
            continue;
        b->absent = (struct absent){f->methods[k].name, because};
        return &b->absent;
    }
    return NULL;
}

static void *next_step(void *of, size_t k) {
    line *l = of;
    const method_claim *claim = &l->walked.row->claims[l->walked.which];
    if ((int)k == l->walked.steps)
        return NULL;
    l->ratio = l->walked.ratio[k];
    l->wrong = l->walked.error[k];
    l->claimed = l->ratio <= claim->ratio_hi * (1 + 1e-9) ? method_claim_at(claim, l->ratio) : (double)NAN;
    return l;
}

static void say_inputs(page *p, void *item) {
    const measuring *b = item;
    const method_family_row *f = b->asked.family;
    page_title(p, "%s: %s", f->name, f->summary);
    page_text(p, "%s%s, near %s, far %s; %s", f->cases[b->asked.which].name, b->o->camera.ortho ? ", orthographic" : "",
              number_full(b->o->camera.znear).text, number_full(b->o->camera.zfar).text, b->machine);
}

/* Families count in steps of a code or in units in the last place, and of some methods bounds are proven. */
enum {
    IN_STEPS = 1 << 0,
    IN_ULP = 1 << 1,
    BOUNDED = 1 << 2,
    ON_DEVICE = 1 << 3,
    OURS_ALONE = 1 << 4,
    OF_PLANES = 1 << 5, /* the walk is over far/near, */
    OF_DEPTHS = 1 << 6, /* or over window depths, */
    OF_OTHERS = 1 << 7, /* and what is for perspective was tried on other depth */
    IN_SHARES = 1 << 8, /* what is not in steps is relative, */
    IN_RADIANS = 1 << 9 /* or an angle */
};

static unsigned conditions(const measuring *b) {
    const method_family_row *f = b->asked.family;
    unsigned when = (f->steps ? IN_STEPS : IN_ULP) | (b->mine != NULL ? ON_DEVICE : OURS_ALONE) |
                    (f->magnitudes ? OF_DEPTHS : OF_PLANES) |
                    ((f->besides & METHOD_BESIDE_OBLIQUE) != 0 ? OF_OTHERS : 0) |
                    (strcmp(f->measure, "radians") == 0 ? IN_RADIANS
                     : f->steps                         ? 0
                                                        : IN_SHARES);
    for (size_t i = 0; i < b->count; i++)
        when |= isnan(b->results[i].bound) ? 0 : BOUNDED;
    return when;
}

/* Says what each of the user's functions is judged to be. */
static void say_mine(page *p, const measuring *b) {
    page_line(p,
              "device: ns a call on %s, the least of %d; the loop round the calls takes %.2g of it; what depends on "
              "the camera alone is computed once",
              b->device, COMPUTE_TIMES, b->loop);
    for (size_t i = 0; i < b->count; i++) {
        const mine_row *m = mine_of(b, b->results[i].row);
        const judgement *j = &m->judged;
        char text[SETUP_LABEL_SIZE] = "";
        if (m->operand == NULL)
            continue;
        if (j->named)
            shader_say(b->o, &j->found, text);
        page_line(p, "%s: %s: %s%s%s; %s", m->operand, judge_verdict_name(j->verdict),
                  j->because != NULL ? j->because : text, *m->code.defines != '\0' ? "; given " : "", m->code.defines,
                  isnan(b->results[i].measured.worst.relative) ? "gives no eye depth of a window depth: not measured"
                  : !m->code.camera                            ? "knows one camera alone, and is not run for others"
                                                               : "no bound is known");
    }
    if (b->o->judge.mine_count > 0 && b->o->out.full)
        page_line(p, "fails from, of yours: the far/near from which its error exceeds %s",
                  number_of(b->results[b->count - 1].row->asked, 3).text);
}

static void say_losses(page *p, const measuring *b) {
    const bool codes = b->asked.family->magnitudes;
    const char *of = codes ? "window depth" : "far/near", *most = codes ? "" : " up to 1e12";
    if (b->o->out.full)
        page_line(p, "fails from: the %s from which its error exceeds its claim; -: none%s", of, most);
    page_line(p, "lost from, to: the %s from which %s; -: none%s", of,
              codes ? "codes are wrong by more than one, and why" : "its fourth digit is lost, and to what", most);
}

/* Names the methods that are not measured, those of the same reason in a line. */
static void say_absent(page *p, measuring *b) {
    char names[NAMES_SIZE] = "";
    const char *because = NULL;
    for (size_t i = 0; next_absent(b, i) != NULL; i++) {
        if (because != NULL && strcmp(because, b->absent.because) != 0) {
            page_line(p, "left out, %s: %s", because, names);
            names[0] = '\0';
        }
        because = b->absent.because;
        append(names, sizeof names, "%s%s", *names != '\0' ? ", " : "", b->absent.name);
    }
    if (because != NULL)
        page_line(p, "left out, %s: %s", because, names);
}

static void say_marks(page *p, void *item) {
    measuring *b = item;
    const bool full = b->o->out.full; /* else columns are left out, of which nothing is said */
    page_line(
        p, "ns: per element, the least of %d turns; +- %%: of which a quarter took at most so much more; %s %.3g ns",
        BENCH_REPETITIONS,
        full ? "x memory: multiple of the time to move the same bytes," : "moving the same bytes takes", b->limit);
    if (full && (conditions(b) & BOUNDED) != 0)
        page_line(p, "bound: proven for any depth of this camera");
    if (full || b->mine == NULL)
        page_line(p, "claim: for any %s", b->asked.family->magnitudes ? "depth" : "camera with this far/near");
    say_losses(p, b);
    page_line(p, "* Pareto front: keeps its claim, and no other that does is faster and more accurate; of two as fast, "
                 "within 10 %% or their spread, the more accurate one");
    for (size_t i = 0; i < b->count; i++)
        if (b->results[i].row->timed != NULL)
            page_line(p,
                      "%s: timed with this processor's estimate; its errors are those of a model, and every processor "
                      "stays within the guarantee of %s and the method within its claim",
                      b->results[i].row->name, number_up(ESTIMATE_WORST, 3).text);
    if (b->mine != NULL)
        say_mine(p, b);
    if (b->shown < b->count)
        page_line(p, "--full: %zu more, each beaten by another in both speed and accuracy", b->count - b->shown);
    say_absent(p, b);
    if (b->choice != NULL)
        page_line(p, "> %s is the cheapest whose claim is within the tolerance", b->choice_name);
    else if (!isnan(b->tolerance))
        page_line(p, "no method's claim is within the tolerance here");
}

/* Text is for a reader who wants the fastest that is exact enough. */
static void order(measuring *b) {
    const bool text = b->o->out.form == FORM_TEXT;
    for (size_t i = 0; i < b->count; i++) {
        size_t at = b->shown;
        if (text && b->results[i].row->behind && !b->o->out.full)
            continue;
        for (; text && at > 0 && b->results[i].ns < b->results[b->order[at - 1]].ns; at--)
            b->order[at] = b->order[at - 1];
        b->order[at] = i;
        b->shown++;
    }
}

static const column step_columns[] = {{FIELD(line, ratio, "ratio", "")},
                                      {FIELD(line, wrong, "error", "")},
                                      {FIELD(line, claimed, "claim", "")},
                                      {.kind = COLUMN_END}};

static const column walked_columns[] = {
    {FIELD(line, of_case, "case", "")},
    {FIELD(line, walked.claim, "claim", ""), .only = AS_JSON},
    {FIELD(line, walked.claim_to, "claim_to", ""), .only = AS_JSON | AS_CSV},
    {TEXT_FIELD(line, walked.claim_to, "claimed to", 11, 3), .downward = true, .when = OF_PLANES, .spare = 6},
    {FIELD(line, walked.inside, "worst", ""), .only = AS_JSON},
    {FIELD(line, walked.inside_near, "worst_near", ""), .only = AS_JSON},
    {FIELD(line, walked.inside_far, "worst_far", ""), .only = AS_JSON},
    {FIELD(line, walked.inside_at, "worst_at", ""), .only = AS_JSON},
    {FIELD(line, breaks, "breaks", ""), SHOWN("fails from", 11, 3), .downward = true, .spare = 2},
    {FIELD(line, lost, "lost", ""), SHOWN("lost from", 11, 3), .downward = true},
    {FIELD(line, walked.infinite, "infinite", ""), .only = AS_JSON | AS_CSV},
    {FIELD(line, walked.ortho, "ortho", ""), .only = AS_JSON | AS_CSV},
    {FIELD(line, walked.oblique, "oblique", ""), .only = AS_JSON | AS_CSV},
    {FIELD(line, walked.log, "log", ""), .only = AS_JSON | AS_CSV},
    {FIELD(line, walked.subnormal, "subnormal", ""), .only = AS_JSON | AS_CSV},
    {TEXT_FIELD(line, walked.infinite, "far inf", 10, 3), .upward = true, .when = OF_PLANES, .spare = 8},
    {TEXT_FIELD(line, walked.ortho, "ortho", 10, 3), .upward = true, .when = OF_PLANES, .spare = 7},
    {TEXT_FIELD(line, walked.oblique, "oblique", 10, 3), .upward = true, .when = OF_OTHERS, .spare = 9},
    {TEXT_FIELD(line, walked.log, "log", 10, 3), .upward = true, .when = OF_OTHERS, .spare = 9},
    {TEXT_FIELD(line, walked.subnormal, "subnormal", 10, 3), .upward = true, .when = OF_DEPTHS, .spare = 8},
    {FIELD(line, verdict, "verdict", ""), SHOWN("verdict", -11, 0)},
    {FIELD(line, walked.cause, "cause", ""), SHOWN("lost to", -13, 0)},
    {LIST("walk", step_columns, next_step), .only = AS_JSON},
    {.kind = COLUMN_END}};

static const column line_columns[] = {
    {FIELD(line, name, "name", ""), .only = AS_JSON},
    {FIELD(line, name, "method", ""), .only = AS_CSV},
    {TEXT_FIELD(line, label, "  method", -21, 0)},
    {FIELD(line, of.ns, "ns", ""), SHOWN("ns", 8, 3)},
    {FIELD(line, limits, "limits", ""), SHOWN("x memory", 10, 3), .only = AS_JSON | AS_TEXT, .spare = 5},
    {FIELD(line, of.spread, "spread", "")},
    {TEXT_FIELD(line, percent, "+- %", 6, 2)},
    {FIELD(line, of.setup, "setup_ns", ""), .only = AS_JSON},
    {FIELD(line, of.setup, "setup", "ns"), .only = AS_CSV},
    {TEXT_FIELD(line, setup, "set-up ns", 10, 3), .spare = 1},
    {FIELD(line, of.inputs, "inputs", "")},
    {FIELD(line, error, "error", "")},
    {FIELD(line, of.measured.worst.relative, "relative", "")},
    {TEXT_FIELD(line, of.measured.worst.relative, "relative", 10, 3), .upward = true, .when = IN_STEPS, .spare = 5},
    {TEXT_FIELD(line, of.measured.worst.relative, "relative", 10, 3), .upward = true, .when = IN_SHARES},
    {TEXT_FIELD(line, of.measured.worst.relative, "radians", 10, 3), .upward = true, .when = IN_RADIANS},
    {FIELD(line, of.at_relative, "relative_at", "")},
    {FIELD(line, of.measured.worst.absolute, "absolute", ""), SHOWN("absolute", 10, 3), .upward = true, .spare = 4},
    {FIELD(line, of.at_absolute, "absolute_at", "")},
    {FIELD(line, of.measured.worst.ulp, "ulp", "")},
    {TEXT_FIELD(line, of.measured.worst.ulp, "steps", 10, 3), .upward = true, .when = IN_STEPS},
    {TEXT_FIELD(line, of.at_ulp, "worst at", 14, 9), .when = IN_STEPS, .spare = 3},
    {TEXT_FIELD(line, of.measured.worst.ulp, "ulp", 10, 3), .upward = true, .when = IN_ULP, .spare = 5},
    {TEXT_FIELD(line, of.at_relative, "worst at", 14, 9), .when = IN_ULP, .spare = 3},
    {FIELD(line, of.at_ulp, "ulp_at", "")},
    {TEXT_FIELD(line, device, "device", 8, 3), .when = ON_DEVICE},
    {TEXT_FIELD(line, of.bound, "bound", 10, 3), .upward = true, .when = BOUNDED, .spare = 1},
    {FIELD(line, of.claim, "claim", "")},
    {TEXT_FIELD(line, of.claim, "claim", 10, 3), .upward = true, .when = OURS_ALONE},
    {TEXT_FIELD(line, of.claim, "claim", 10, 3), .upward = true, .when = ON_DEVICE, .spare = 1},
    {FIELD(line, of.bound, "bound", ""), .only = AS_JSON},
    {FIELD(line, of.front, "pareto", ""), .only = AS_JSON},
    {FIELD(line, front, "pareto", ""), .only = AS_CSV},
    {FIELD(line, chosen, "chosen", ""), .only = AS_CSV},
    {FIELD(line, of.limit, "limit", "ns"), .only = AS_CSV},
    {FIELD(line, of.bound, "bound", ""), .only = AS_CSV},
    {GROUP("stability", walked_columns)},
    {FIELD(line, device, "device_ns", ""), .when = ON_DEVICE},
    {FIELD(line, function, "function", ""), .when = ON_DEVICE},
    {FIELD(line, computes, "computes", ""), .when = ON_DEVICE},
    {FIELD(line, given, "defines", ""), .when = ON_DEVICE},
    {.kind = COLUMN_END}};

static const column absent_columns[] = {
    {FIELD(struct absent, name, "name", "")}, {FIELD(struct absent, because, "because", "")}, {.kind = COLUMN_END}};

static const column columns[] = {{FIELD(measuring, family, "family", "")},
                                 {FIELD(measuring, measure, "measure", ""), .only = AS_JSON},
                                 {FIELD(measuring, machine, "machine", ""), .only = AS_JSON},
                                 {PART(measuring, fields, NULL, setup_columns), .only = AS_JSON},
                                 {FIELD(measuring, tolerance, "tolerance", ""), .only = AS_JSON},
                                 {FIELD(measuring, choice_name, "choice", ""), .only = AS_JSON},
                                 {FIELD(measuring, limit, "limit_ns", ""), .only = AS_JSON},
                                 {FIELD(measuring, device, "device", ""), .only = AS_JSON, .when = ON_DEVICE},
                                 {FIELD(measuring, loop, "loop_ns", ""), .only = AS_JSON, .when = ON_DEVICE},
                                 {LIST("methods", line_columns, next_method)},
                                 {LIST("absent", absent_columns, next_absent), .only = AS_JSON},
                                 {.kind = COLUMN_END}};

/* ---- The command ------------------------------------------------------------------------------------------------- */

/* Refuses options of a camera where no family is named. */
static int check_family(const judge_request *o) {
    static const char *const of_family[] = {"format", "mapping", "ortho", "tolerance", "mine", "device"};
    char text[NAMES_SIZE];
    for (size_t i = 0; i < sizeof of_family / sizeof of_family[0] && o->line->operand_row == NULL; i++)
        if (option_given(o->line, of_family[i]))
            return option_error(of_family[i], "needs FAMILY: %s",
                                names_join(o->line->command->names, ", ", " or ", text));
    dp_setup setup;
    const dp_status wrong = method_setup(method_family_get(0), 0, o->camera.znear, o->camera.zfar, false, &setup);
    if (o->line->operand_row == NULL && wrong != DP_OK)
        return option_error(wrong == DP_ERROR_NEAR ? "near" : "far", "%s", dp_status_text(wrong));
    return EXIT_FINE;
}

/* The times first, while nothing else runs. */
static int measure(measuring *b) {
    b->count = bench_run(b->asked.family, b->asked.which, &b->asked.setup, BENCH_REPETITIONS, b->results);
    if (b->count == 0 || stability_run(b->asked.family, 1U << b->asked.which, b->walked) < b->count)
        return usage_error("no memory for the methods");
    for (size_t i = 0, k = 0; i < b->count; i++, k++) { /* those of other projections are walked, too */
        while (b->walked[k].row != b->results[i].row)
            k++;
        b->walked[i] = b->walked[k];
    }
    return b->mine != NULL ? b->mine->status : EXIT_FINE;
}

static void describe(measuring *b) {
    const judge_request *o = b->o;
    const double ratio = o->camera.zfar / o->camera.znear;
    const method_wish wish = {.tolerance = o->camera.tolerance,
                              .ratio_lo = fmin(ratio, METHOD_RATIO_HI),
                              .ratio_hi = ratio,
                              .ortho = o->camera.ortho};
    if (!isnan(b->tolerance))
        b->choice = method_choose(b->asked.family, b->asked.which, &wish);
    methods_machine(b->machine, sizeof b->machine);
    b->choice_name = b->choice != NULL ? b->choice->name : NULL;
    if (b->mine != NULL) {
        b->device = mine_device(b->mine);
        b->loop = b->mine->more[b->mine->count].ns;
    }
    b->family = b->asked.family->name;
    b->measure = b->asked.family->measure;
    b->fields = setup_fields_asked(&b->asked.setup, &o->camera);
    b->limit = b->results[0].limit;
    order(b);
}

/* A claim that does not hold, or holds far too easily, is a check that failed. */
static bool all_hold(const measuring *b) {
    for (size_t i = 0; i < b->count; i++)
        if (b->walked[i].verdict == STABILITY_BROKEN || b->walked[i].verdict == STABILITY_MODEST)
            return false;
    return true;
}

int cmd_methods(void *request) {
    const judge_request *o = request;
    output out;
    measuring b = {.o = o, .tolerance = option_given(o->line, "tolerance") ? o->camera.tolerance : (double)NAN};
    int status = check_family(o);
    if (status == EXIT_FINE && o->line->operand_row != NULL)
        status = methods_resolve(o, o->line->operand_row, &b.asked);
    if (status == EXIT_FINE && o->line->operand_row != NULL)
        status = methods_single(o, &b.asked);
    if (status == EXIT_FINE)
        status = output_start(&o->out, &o->camera, &out);
    if (status != EXIT_FINE)
        return status;
    if (o->line->operand_row == NULL)
        return families_write(o, &out);
    if (o->judge.mine_count > 0 || o->judge.device != NULL)
        status = mine_open(o, &b.asked, false, &b.mine);
    if (status == EXIT_FINE)
        status = measure(&b);
    if (status == EXIT_FINE) {
        describe(&b);
        report_write(
            &(report_spec){"methods", columns, &b, .when = conditions(&b), .head = say_inputs, .notes = say_marks},
            &out, o->out.form);
        status = output_close(&out);
    } else {
        output_abandon(&out);
    }
    mine_close(b.mine);
    return status == EXIT_FINE && !all_hold(&b) ? EXIT_FAILED : status;
}
