/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * table: what each depth becomes in each set-up, and the certified worst case over the range. Rows are computed and
 * written one by one, so a million of them need no more memory than nine.
 */
#include <math.h>
#include <unistd.h>

#include "cli/csv.h"
#include "cli/json.h"
#include "cli/options.h"
#include "cli/progress.h"
#include "cli/setups.h"
#include "cli/table_text.h"

int cmd_table(const options *o);

enum { DEFAULT_ROWS = 9 };

/* What a table is made of, and where it goes. */
typedef struct table {
    const options *o;
    output *out;
    setups all;
    depths at;
    double lo, hi;
    progress progress;
    uint64_t done;
} table;

static void each_row(table *t, const dp_setup *setup, void (*emit)(void *, const dp_setup *, const dp_sample *),
                     void *to) {
    for (size_t i = 0; i < t->at.count && !output_failed(t->out); i++) {
        dp_sample sample;
        if (dp_sample_at(setup, depths_get(&t->at, i), &sample) == DP_OK) /* depths_resolve() has seen to it */
            emit(to, setup, &sample);
        progress_step(&t->progress, ++t->done);
    }
}

static dp_worst worst_of(const table *t, const dp_setup *setup) {
    dp_worst worst = {0};
    dp_worst_over(setup, t->lo, t->hi, &worst);
    return worst;
}

/* ---- text ---- */

typedef struct text_target {
    output *out;
    table_style style;
} text_target;

static void text_row(void *to, const dp_setup *setup, const dp_sample *sample) {
    text_target *target = to;
    (void)setup;
    table_text_row(target->out, &target->style, sample);
}

static void write_text(table *t) {
    text_target target = {t->out, table_style_of(t->o, t->out)};
    for (size_t i = 0; i < t->all.count; i++) {
        const dp_setup *setup = &t->all.items[i];
        dp_worst worst = worst_of(t, setup);
        if (i > 0)
            output_char(t->out, '\n');
        table_text_head(t->out, &target.style, setup);
        each_row(t, setup, text_row, &target);
        table_text_worst(t->out, &target.style, &worst);
    }
}

/* ---- JSON ---- */

static void json_row(void *to, const dp_setup *setup, const dp_sample *s) {
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
    json_end(j);
}

static void json_worst(json *j, const dp_worst *w) {
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

static void write_json(table *t) {
    json j = json_start(t->out, "table");
    json_array(&j, "setups");
    for (size_t i = 0; i < t->all.count; i++) {
        const dp_setup *setup = &t->all.items[i];
        dp_worst worst = worst_of(t, setup);
        json_object(&j, NULL);
        setup_json(&j, setup);
        json_array(&j, "rows");
        each_row(t, setup, json_row, &j);
        json_end(&j);
        json_worst(&j, &worst);
        json_end(&j);
    }
    json_finish(&j);
}

/* ---- CSV ---- */

static void csv_row(void *to, const dp_setup *setup, const dp_sample *s) {
    csv *c = to;
    setup_csv(c, setup);
    csv_number(c, s->z);
    csv_integer(c, s->code);
    csv_number(c, s->depth);
    csv_number(c, s->stored);
    csv_number(c, s->error);
    csv_number(c, s->lo);
    csv_number(c, s->hi);
    csv_number(c, s->interval);
    csv_number(c, s->separation);
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
                                        "separation [scene]"};
    csv c = csv_start(t->out);
    setup_csv_head(&c);
    for (size_t i = 0; i < sizeof heads / sizeof heads[0]; i++)
        csv_string(&c, heads[i]);
    csv_end(&c);
    for (size_t i = 0; i < t->all.count; i++)
        each_row(t, &t->all.items[i], csv_row, &c);
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
    if (status == EXIT_FINE)
        status = output_open(&out, o->output);
    if (status == EXIT_FINE) {
        /* Rows on the same terminal are progress enough. */
        bool silent = o->quiet || isatty(out.fd);
        t.progress = progress_start("rows", (uint64_t)t.all.count * t.at.count, silent);
        writers[o->form](&t);
        progress_end(&t.progress);
        status = output_close(&out);
    }
    setups_release(&t.all);
    return status;
}
