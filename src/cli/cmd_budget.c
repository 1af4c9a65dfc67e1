/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * budget: the separation that binary32 arithmetic guarantees at each depth, and which cause takes how much of it; then
 * what to do about the largest part, and whether a simpler model would have said the same.
 */
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "cli/choice.h"
#include "cli/clipping.h"
#include "cli/options.h"
#include "cli/progress.h"
#include "cli/remedy.h"
#include "cli/setups.h"
#include "report/csv.h"
#include "report/json.h"
#include "report/number.h"

int cmd_budget(const options *o);

enum { DEFAULT_ROWS = 9, DIGITS = 4, DIGITS_MORE = 6, DIGITS_Z = 9 };

typedef struct budget_row {
    double z;
    dp_budget parts;
} budget_row;

typedef struct report {
    const options *o;
    output *out;
    setups all;
    depths at;
    progress progress;
    uint64_t done;
} report;

/* What is gathered of a set-up while its rows go by. */
typedef struct summary {
    choosing choice;
    budget_row worst; /* the largest separation that is finite; z is NaN while there is none */
    double hopeless;  /* the nearest depth where none is; NaN when there is none such */
    dp_cause cause;   /* the largest part of the worst */
    remedy_result remedy;
} summary;

static dp_cause largest_part(const dp_budget *b) {
    int largest = 0;
    for (int i = 1; i < DP_CAUSE_COUNT; i++)
        if (b->cause[i] > b->cause[largest])
            largest = i;
    return (dp_cause)largest;
}

static void note(summary *s, const budget_row *row) {
    if (isinf(row->parts.separation))
        s->hopeless = fmin(s->hopeless, row->z); /* the other one where one is NaN */
    else if (!(row->parts.separation <= s->worst.parts.separation))
        s->worst = *row;
    choosing_add(&s->choice, row->z);
}

static summary each_row(report *r, const dp_setup *setup,
                        void (*emit)(void *, const report *, const dp_setup *, const budget_row *), void *to) {
    summary s = {.choice = choosing_start(setup, r->o->tolerance), .hopeless = (double)NAN};
    s.worst.z = s.worst.parts.separation = (double)NAN;
    for (size_t i = 0; i < r->at.count && !output_failed(r->out); i++) {
        budget_row row = {.z = depths_get(&r->at, i)};
        if (dp_budget_at(setup, row.z, &r->o->terms, &row.parts) == DP_OK) { /* depths_resolve() has seen to it */
            emit(to, r, setup, &row);
            note(&s, &row);
        }
        progress_step(&r->progress, ++r->done);
    }
    choosing_finish(&s.choice);
    s.cause = largest_part(&s.worst.parts);
    if (!isnan(s.worst.z))
        s.remedy = remedy_find(setup, &r->o->terms, s.worst.z, s.cause);
    return s;
}

static double share_of(const budget_row *row, int cause) {
    return row->parts.cause[cause] / row->parts.separation;
}

/* How positions are composed; null where eye depth is given. */
static const char *composition_of(const options *o) {
    return o->terms.world > 0.0 ? dp_composition_get(o->terms.composition)->name : NULL;
}

/* ---- Text: the causes that there can be -------------------------------------------------------------------------- */

static bool is_asked(const options *o, int cause) {
    switch (cause) {
    case DP_CAUSE_COMPOSITION:
        return o->terms.world > 0.0;
    case DP_CAUSE_INTERPOLATION:
        return o->terms.interpolation > 0.0;
    case DP_CAUSE_LINEARIZATION:
        return o->terms.linearize != 0;
    default:
        return true;
    }
}

static void text_row(void *to, const report *r, const dp_setup *setup, const budget_row *row) {
    (void)to, (void)setup;
    char text[NUMBER_SIZE];
    number_digits(row->z, DIGITS_Z, text);
    output_format(r->out, "%12s", text);
    number_bound(row->parts.separation, DIGITS_MORE, true, text);
    output_format(r->out, " %12s", text);
    for (int i = 0; i < DP_CAUSE_COUNT; i++) {
        const double share = share_of(row, i);
        if (!is_asked(r->o, i))
            continue;
        if (isinf(row->parts.separation)) { /* no parts of what does not exist */
            output_format(r->out, " %12s %5s", "-", "-");
            continue;
        }
        number_digits(row->parts.cause[i], DIGITS, text);
        output_format(r->out, share > 0.0 && share < 0.005 ? " %12s  <1 %%" : " %12s %3.0f %%", text, 100.0 * share);
    }
    output_char(r->out, '\n');
}

static void text_advice(const report *r, const summary *s) {
    char z[NUMBER_SIZE];
    char now[NUMBER_SIZE];
    char then[NUMBER_SIZE];
    char step[NUMBER_SIZE];
    if (!isnan(s->hopeless)) {
        number_digits(s->hopeless, DIGITS_MORE, z);
        output_format(r->out, "  at z = %s no separation is certain: what lies behind may share its code\n", z);
    }
    if (isnan(s->worst.z))
        return;
    number_digits(s->worst.z, DIGITS_MORE, z);
    number_bound(s->worst.parts.separation, DIGITS, true, now);
    number_bound(s->remedy.separation, DIGITS, true, then);
    number_digits(remedy_step(s->worst.z), DIGITS, step);
    output_format(r->out, "  at z = %s %s takes %.0f %%: ", z, dp_cause_name(s->cause),
                  100.0 * share_of(&s->worst, (int)s->cause));
    if (s->remedy.text != NULL)
        output_format(r->out, "%s would need %s in place of %s\n", s->remedy.text, then, now);
    else if (s->worst.parts.separation < 2.0 * remedy_step(s->worst.z))
        output_format(r->out, "nothing to gain, binary32 depths themselves are %s apart there\n", step);
    else
        output_text(r->out, "nothing that could be chosen otherwise helps against it\n");
}

static void write_text(report *r) {
    for (size_t i = 0; i < r->all.count; i++) {
        const dp_setup *setup = &r->all.items[i];
        char label[SETUP_LABEL_SIZE];
        char sentence[CHOICE_SENTENCE_SIZE];
        if (i > 0)
            output_char(r->out, '\n');
        output_text(r->out, setup_label(setup, true, label));
        if (composition_of(r->o) != NULL) {
            char world[NUMBER_SIZE];
            number_shortest(r->o->terms.world, world);
            output_format(r->out, ", world %s, composition %s", world, composition_of(r->o));
        }
        output_format(r->out, "\n%12s %12s", "z", "separation");
        for (int c = 0; c < DP_CAUSE_COUNT; c++)
            if (is_asked(r->o, c))
                output_format(r->out, " %18s", dp_cause_name((dp_cause)c));
        output_char(r->out, '\n');
        const summary s = each_row(r, setup, text_row, NULL);
        text_advice(r, &s);
        output_format(r->out, "  %s\n", choice_sentence(&s.choice, sentence));
    }
}

/* ---- JSON -------------------------------------------------------------------------------------------------------- */

static void json_row(void *to, const report *r, const dp_setup *setup, const budget_row *row) {
    (void)r, (void)setup;
    json *j = to;
    json_object(j, NULL);
    json_number(j, "z", row->z);
    json_number(j, "separation", row->parts.separation);
    json_number(j, "window", row->parts.window);
    json_object(j, "causes");
    for (int i = 0; i < DP_CAUSE_COUNT; i++)
        json_number(j, dp_cause_name((dp_cause)i), row->parts.cause[i]);
    json_end(j);
    json_end(j);
}

static void json_worst(json *j, const summary *s) {
    if (isnan(s->worst.z)) {
        json_null(j, "worst");
        return;
    }
    json_object(j, "worst");
    json_number(j, "z", s->worst.z);
    json_number(j, "separation", s->worst.parts.separation);
    json_string(j, "cause", dp_cause_name(s->cause));
    json_number(j, "share", share_of(&s->worst, (int)s->cause));
    json_string(j, "remedy", s->remedy.text);
    json_number(j, "remedy_separation", s->remedy.text != NULL ? s->remedy.separation : (double)NAN);
    json_end(j);
}

static void write_json(report *r) {
    json j = json_start(r->out, "budget");
    json_object(&j, "terms");
    json_number(&j, "interpolation", r->o->terms.interpolation);
    json_number(&j, "world", r->o->terms.world);
    json_string(&j, "composition", composition_of(r->o));
    json_bool(&j, "linearize", r->o->terms.linearize != 0);
    json_end(&j);
    json_array(&j, "setups");
    for (size_t i = 0; i < r->all.count; i++) {
        json_object(&j, NULL);
        setup_json(&j, &r->all.items[i]);
        json_array(&j, "rows");
        const summary s = each_row(r, &r->all.items[i], json_row, &j);
        json_end(&j);
        json_worst(&j, &s);
        choice_json(&j, &s.choice);
        json_end(&j);
    }
    json_finish(&j);
}

/* ---- CSV --------------------------------------------------------------------------------------------------------- */

static void csv_row(void *to, const report *r, const dp_setup *setup, const budget_row *row) {
    csv *c = to;
    setup_csv(c, setup);
    csv_string(c, dp_arith_get(setup->spec.arith)->name);
    csv_number(c, row->z);
    csv_number(c, row->parts.separation);
    csv_number(c, row->parts.window);
    for (int i = 0; i < DP_CAUSE_COUNT; i++)
        csv_number(c, row->parts.cause[i]);
    csv_string(c, composition_of(r->o) != NULL ? composition_of(r->o) : "");
    csv_end(c);
}

static void write_csv(report *r) {
    static const char *const heads[] = {"arith", "z [scene]", "separation [scene]", "window"};
    csv c = csv_start(r->out);
    setup_csv_head(&c);
    for (size_t i = 0; i < sizeof heads / sizeof heads[0]; i++)
        csv_string(&c, heads[i]);
    for (int i = 0; i < DP_CAUSE_COUNT; i++) {
        char head[64];
        snprintf(head, sizeof head, "%s [scene]", dp_cause_name((dp_cause)i));
        csv_string(&c, head);
    }
    csv_string(&c, "composition");
    csv_end(&c);
    for (size_t i = 0; i < r->all.count; i++)
        each_row(r, &r->all.items[i], csv_row, &c);
}

int cmd_budget(const options *o) {
    static void (*const writers[])(report *) = {
        [FORM_TEXT] = write_text, [FORM_JSON] = write_json, [FORM_CSV] = write_csv};
    output out;
    report r = {.o = o, .out = &out};
    options in_binary32 = *o;
    in_binary32.model = DP_MODEL_FP32;
    if (option_given(o, OPTION_COMPOSITION) && composition_of(o) == NULL)
        return option_error(OPTION_COMPOSITION, "needs --world: eye depth is given");
    int status = setups_make(&in_binary32, &r.all);
    if (status == EXIT_FINE)
        status = depths_resolve(o, DEFAULT_ROWS, &r.at);
    if (status == EXIT_FINE)
        status = depths_in_binary32(&r.at);
    if (status == EXIT_FINE)
        status = output_open(&out, o->output);
    if (status == EXIT_FINE) {
        bool silent = o->quiet || isatty(out.fd);
        r.progress = progress_start("rows", (uint64_t)r.all.count * r.at.count, silent);
        writers[o->form](&r);
        progress_end(&r.progress);
        status = output_close(&out);
        if (status == EXIT_FINE && !o->quiet)
            clipping_warn(&r.all);
    }
    setups_release(&r.all);
    return status;
}
