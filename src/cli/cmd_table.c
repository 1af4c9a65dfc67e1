/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * table: what each depth becomes in each set-up, the certified worst case over the range, and which model is enough.
 * The interval is that of the exact cell; with --tolerance, by the cheapest method that is claimed to be good enough.
 * Rows are computed and written one by one, so a million of them need no more memory than nine.
 */
#include <math.h>
#include <unistd.h>

#include "cli/choice.h"
#include "cli/clipping.h"
#include "cli/options.h"
#include "cli/progress.h"
#include "cli/setups.h"
#include "cli/table_text.h"
#include "method/ways.h"
#include "report/csv.h"
#include "report/json.h"

int cmd_table(const options *o);

enum { DEFAULT_ROWS = 9 };

/* What a table is made of, and where it goes. */
typedef struct table {
    const options *o;
    output *out;
    setups all;
    depths at;
    way interval; /* of the set-up at hand; without a row, the exact cell */
    double lo, hi;
    progress progress;
    uint64_t done;
} table;

/* One row: a sample, and beside it the separation in binary32 arithmetic, NaN where that is not modelled. */
typedef struct row {
    dp_sample sample;
    double binary32;
} row;

static double separation_in_binary32(const dp_setup *setup, const dp_sample *sample) {
    dp_budget budget;
    if (setup->spec.model == DP_MODEL_FP32)
        return sample->separation;
    return dp_budget_at(setup, sample->z, NULL, &budget) == DP_OK ? budget.separation : (double)NAN;
}

/* Are there depths among those asked about whose cell a plane cuts? */
static bool has_cut_cells(const table *t, const dp_setup *setup) {
    const uint32_t first = dp_code(setup, setup->spec.znear), last = dp_code(setup, setup->spec.zfar);
    for (size_t i = 0; i < t->at.count; i++) {
        const uint32_t code = dp_code(setup, depths_get(&t->at, i));
        if (code == first || code == last)
            return true;
    }
    return false;
}

static void choose_way(table *t, const dp_setup *setup) {
    if (option_given(t->o, OPTION_TOLERANCE))
        t->interval = way_choose(setup, t->o->tolerance, has_cut_cells(t, setup));
}

/* Writes the rows; gathers for the choice of a model on the way, where one is asked for. */
static void each_row(table *t, const dp_setup *setup, void (*emit)(void *, const dp_setup *, const row *), void *to,
                     choosing *choice) {
    for (size_t i = 0; i < t->at.count && !output_failed(t->out); i++) {
        row r;
        double z = depths_get(&t->at, i);
        if (dp_sample_at(setup, z, &r.sample) == DP_OK) { /* depths_resolve() has seen to it */
            r.binary32 = separation_in_binary32(setup, &r.sample);
            if (t->interval.row != NULL)
                r.sample.interval = way_interval(&t->interval, setup, z);
            emit(to, setup, &r);
            if (choice != NULL)
                choosing_add(choice, z);
        }
        progress_step(&t->progress, ++t->done);
    }
    if (choice != NULL)
        choosing_finish(choice);
}

static dp_worst worst_of(const table *t, const dp_setup *setup) {
    dp_worst worst = {0};
    dp_worst_over(setup, t->lo, t->hi, &worst);
    return worst;
}

/* With --range: the separation that can be relied on all over it, in the fullest model that the set-up has. */
static bool separation_over(const table *t, const dp_setup *setup, dp_model *model, dp_separation_worst *out) {
    dp_setup full;
    dp_spec spec = setup->spec;
    spec.model = *model = dp_mapping_get(spec.mapping)->curve == DP_CURVE_PERSPECTIVE ? DP_MODEL_FP32 : DP_MODEL_STAGED;
    return option_given(t->o, OPTION_RANGE) && dp_setup_init(&full, &spec) == DP_OK &&
           dp_separation_over(&full, t->lo, t->hi, 0.0, out) == DP_OK;
}

/* ---- text ---- */

typedef struct text_target {
    output *out;
    table_style style;
} text_target;

static void text_row(void *to, const dp_setup *setup, const row *r) {
    text_target *target = to;
    (void)setup;
    table_text_row(target->out, &target->style, &r->sample, r->binary32);
}

static void write_text(table *t) {
    text_target target = {t->out, table_style_of(t->o, t->out)};
    for (size_t i = 0; i < t->all.count; i++) {
        const dp_setup *setup = &t->all.items[i];
        dp_worst worst = worst_of(t, setup);
        clipping planes = clipping_of(setup);
        choosing choice = choosing_start(setup, t->o->tolerance);
        choose_way(t, setup);
        char sentence[CHOICE_SENTENCE_SIZE];
        if (i > 0)
            output_char(t->out, '\n');
        table_text_head(t->out, &target.style, setup);
        each_row(t, setup, text_row, &target, &choice);
        dp_model model;
        dp_separation_worst separation;
        table_text_worst(t->out, &target.style, &worst);
        if (separation_over(t, setup, &model, &separation))
            table_text_separation(t->out, &target.style, model, &separation);
        table_text_clipping(t->out, &target.style, &planes);
        output_format(t->out, "  %s\n", choice_sentence(&choice, sentence));
        if (option_given(t->o, OPTION_TOLERANCE))
            table_text_way(t->out, t->interval.name, t->interval.claim, t->o->tolerance);
    }
}

/* ---- JSON ---- */

static void json_row(void *to, const dp_setup *setup, const row *r) {
    const dp_sample *s = &r->sample;
    json *j = to;
    (void)setup;
    json_object(j, NULL);
    json_number(j, "z", s->z);
    json_integer(j, "code", s->code);
    json_number(j, "depth", s->depth);
    json_number(j, "z_stored", s->stored);
    json_number(j, "error", s->error);
    json_number(j, "cell_lo", s->lo);
    json_number(j, "cell_hi", s->hi);
    json_number(j, "interval", s->interval);
    json_number(j, "separation", s->separation);
    json_number(j, "separation_fp32", r->binary32);
    json_end(j);
}

static void json_worst(json *j, const dp_worst *w) {
    if (isnan(w->error)) { /* a model without cells */
        json_null(j, "worst");
        return;
    }
    json_object(j, "worst");
    json_number(j, "lo", w->lo);
    json_number(j, "hi", w->hi);
    json_number(j, "error", w->error);
    json_number(j, "error_z", w->error_z);
    json_integer(j, "error_code", w->error_code);
    json_number(j, "interval", w->interval);
    json_number(j, "interval_lo", w->interval_lo);
    json_number(j, "interval_hi", w->interval_hi);
    json_integer(j, "interval_code", w->interval_code);
    json_number(j, "blind_from", w->blind_from);
    json_end(j);
}

static void json_separation(json *j, dp_model model, const dp_separation_worst *w) {
    json_object(j, "worst_separation");
    json_string(j, "model", dp_model_name(model));
    json_number(j, "lo", w->lo);
    json_number(j, "hi", w->hi);
    json_number(j, "bound", w->bound);
    json_number(j, "separation", w->separation);
    json_number(j, "z", w->z);
    json_end(j);
}

static void write_json(table *t) {
    json j = json_start(t->out, "table");
    json_array(&j, "setups");
    for (size_t i = 0; i < t->all.count; i++) {
        const dp_setup *setup = &t->all.items[i];
        dp_worst worst = worst_of(t, setup);
        clipping planes = clipping_of(setup);
        choosing choice = choosing_start(setup, t->o->tolerance);
        choose_way(t, setup);
        json_object(&j, NULL);
        setup_json(&j, setup);
        if (option_given(t->o, OPTION_TOLERANCE)) {
            json_string(&j, "method", t->interval.name);
            json_number(&j, "claim", t->interval.claim);
        }
        json_array(&j, "rows");
        each_row(t, setup, json_row, &j, &choice);
        json_end(&j);
        json_worst(&j, &worst);
        dp_model model;
        dp_separation_worst separation;
        if (separation_over(t, setup, &model, &separation))
            json_separation(&j, model, &separation);
        if (setup->spec.model == DP_MODEL_FP32) {
            json_number(&j, "near_effective", planes.znear);
            json_number(&j, "far_effective", planes.zfar);
        }
        choice_json(&j, &choice);
        json_end(&j);
    }
    json_finish(&j);
}

/* ---- CSV ---- */

typedef struct csv_target {
    csv lines;
    bool with_arith;  /* a column that only fp32 fills, so there only when some set-up has that model */
    bool with_method; /* and one that is asked for */
    const char *method;
} csv_target;

static void csv_row(void *to, const dp_setup *setup, const row *r) {
    const dp_sample *s = &r->sample;
    csv_target *target = to;
    csv *c = &target->lines;
    setup_csv(c, setup);
    if (target->with_arith)
        csv_string(c, setup->spec.model == DP_MODEL_FP32 ? dp_arith_get(setup->spec.arith)->name : "");
    csv_number(c, s->z);
    csv_integer(c, s->code);
    csv_number(c, s->depth);
    csv_number(c, s->stored);
    csv_number(c, s->error);
    csv_number(c, s->lo);
    csv_number(c, s->hi);
    csv_number(c, s->interval);
    csv_number(c, s->separation);
    csv_number(c, r->binary32);
    if (target->with_method)
        csv_string(c, target->method);
    csv_end(c);
}

static void write_csv(table *t) {
    static const char *const heads[] = {"z [scene]",
                                        "code",
                                        "depth",
                                        "z_stored [scene]",
                                        "error [scene]",
                                        "cell_lo [scene]",
                                        "cell_hi [scene]",
                                        "interval [scene]",
                                        "separation [scene]",
                                        "separation_fp32 [scene]"};
    csv_target c = {.lines = csv_start(t->out)};
    for (size_t i = 0; i < t->all.count; i++)
        c.with_arith = c.with_arith || t->all.items[i].spec.model == DP_MODEL_FP32;
    setup_csv_head(&c.lines);
    if (c.with_arith)
        csv_string(&c.lines, "arith");
    for (size_t i = 0; i < sizeof heads / sizeof heads[0]; i++)
        csv_string(&c.lines, heads[i]);
    c.with_method = option_given(t->o, OPTION_TOLERANCE);
    if (c.with_method)
        csv_string(&c.lines, "method");
    csv_end(&c.lines);
    for (size_t i = 0; i < t->all.count; i++) {
        choose_way(t, &t->all.items[i]);
        c.method = t->interval.name != NULL ? t->interval.name : "";
        each_row(t, &t->all.items[i], csv_row, &c, NULL);
    }
}

int cmd_table(const options *o) {
    static void (*const writers[])(table *) = {
        [FORM_TEXT] = write_text, [FORM_JSON] = write_json, [FORM_CSV] = write_csv};
    output out;
    table t = {.o = o, .out = &out};
    int status = setups_make(o, &t.all);
    if (status == EXIT_FINE)
        status = range_resolve(o, &t.lo, &t.hi);
    if (status == EXIT_FINE)
        status = depths_resolve(o, DEFAULT_ROWS, &t.at);
    if (status == EXIT_FINE && (o->model == DP_MODEL_FP32 || o->model_auto))
        status = depths_in_binary32(&t.at);
    if (status == EXIT_FINE)
        status = output_open(&out, o->output);
    if (status == EXIT_FINE) {
        setups_choose(o, &t.at, &t.all);
        /* Rows on the same terminal are progress enough. */
        bool silent = o->quiet || isatty(out.fd);
        t.progress = progress_start("rows", (uint64_t)t.all.count * t.at.count, silent);
        writers[o->form](&t);
        progress_end(&t.progress);
        status = output_close(&out);
        if (status == EXIT_FINE && !o->quiet)
            clipping_warn(&t.all);
    }
    setups_release(&t.all);
    return status;
}
