/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * texture --effect NAME without an image: what the stored depth does to an effect, depth by depth, and from which (or
 * up to which) value of its parameter on that is no more than a level of 8 bits.
 */
#include "cli/texture_effect.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "cli/names.h"
#include "cli/options.h"
#include "cli/progress.h"
#include "cli/setups.h"
#include "report/csv.h"
#include "report/json.h"
#include "report/number.h"

enum { DEFAULT_ROWS = 9, DIGITS = 6, DIGITS_Z = 9 };

static const double ONE_LEVEL = 1;

/* ---- Which effect ------------------------------------------------------------------------------------------------ */

static int unknown_parameter(const effect_row *row, const char *name) {
    const char *words[EFFECT_PARAMETERS_MAX + 1] = {NULL};
    const name_list known = {.words = words};
    char text[NAMES_SIZE];
    for (int i = 0; i < EFFECT_PARAMETERS_MAX; i++)
        words[i] = row->parameters[i].name;
    return option_error(OPTION_PARAMETER, "of %s %s", row->name, names_refuse(&known, name, text));
}

static int set_parameter(const effect_row *row, const named_number *given, double *parameters) {
    const int index = effect_parameter_find(row, given->name);
    if (index < 0)
        return unknown_parameter(row, given->name);
    const effect_parameter *p = &row->parameters[index];
    if (!(given->value >= p->lo && given->value <= p->hi)) {
        char value[NUMBER_SIZE], lo[NUMBER_SIZE], hi[NUMBER_SIZE];
        number_shortest(given->value, value);
        number_digits(p->lo, DIGITS, lo);
        number_digits(p->hi, DIGITS, hi);
        return option_error(OPTION_PARAMETER, "%s must be from %s to %s, got %s", p->name, lo, hi, value);
    }
    parameters[index] = given->value;
    return EXIT_FINE;
}

int texture_effect_resolve(const options *o, const effect_row **row, double parameters[EFFECT_PARAMETERS_MAX]) {
    int status = EXIT_FINE;
    *row = o->effect;
    effect_defaults(*row, parameters);
    for (size_t i = 0; i < o->parameter_count && status == EXIT_FINE; i++)
        status = set_parameter(*row, &o->parameters[i], parameters);
    return status;
}

/* ---- The table --------------------------------------------------------------------------------------------------- */

typedef struct report {
    const options *o;
    output *out;
    setups all;
    depths at;
    const effect_row *effect;
    const effect_parameter *wanted;
    double parameters[EFFECT_PARAMETERS_MAX];
    progress progress;
    uint64_t done;
} report;

typedef struct row {
    dp_sample sample;
    double levels, usable;
} row;

/* What is usable at all depths shown, and the depth that decides; NaN when at one of them nothing is. */
typedef struct summary {
    double usable, z;
    bool begun;
} summary;

static void summary_add(summary *s, const report *r, const row *x) {
    const bool decides = isnan(x->usable) || (r->effect->smallest ? x->usable > s->usable : x->usable < s->usable);
    if (s->begun && (isnan(s->usable) || !decides))
        return;
    *s = (summary){x->usable, x->sample.z, true};
}

static summary each_row(report *r, const dp_setup *setup,
                        void (*emit)(void *, const report *, const dp_setup *, const row *), void *to) {
    summary s = {.begun = false};
    for (size_t i = 0; i < r->at.count && !output_failed(r->out); i++) {
        const double z = depths_get(&r->at, i);
        row x = {.levels = effect_error(r->effect, setup, r->parameters, z),
                 .usable = effect_usable(r->effect, setup, r->parameters, z, ONE_LEVEL)};
        dp_sample_at(setup, z, &x.sample); /* depths_resolve() has seen to it */
        emit(to, r, setup, &x);
        summary_add(&s, r, &x);
        progress_step(&r->progress, ++r->done);
    }
    return s;
}

static const char *direction(const report *r) {
    return r->effect->smallest ? "from" : "up to";
}

/* ---- Text -------------------------------------------------------------------------------------------------------- */

static void put_number(output *out, int width, int digits, double value) {
    char text[NUMBER_SIZE];
    number_digits(value, digits, text);
    output_format(out, "%*s", width, isnan(value) ? "-" : text);
}

static void text_row(void *to, const report *r, const dp_setup *setup, const row *x) {
    (void)to, (void)setup;
    put_number(r->out, 12, DIGITS_Z, x->sample.z);
    output_format(r->out, " %10u", x->sample.code);
    put_number(r->out, 16, DIGITS_Z, x->sample.stored);
    put_number(r->out, 14, DIGITS, x->sample.interval);
    put_number(r->out, 13, DIGITS, x->levels);
    put_number(r->out, 21, DIGITS, x->usable);
    output_char(r->out, '\n');
}

static void text_head(const report *r) {
    char usable[64];
    output_text(r->out, r->effect->name);
    for (int i = 0; r->effect->parameters[i].name != NULL; i++) {
        char value[NUMBER_SIZE];
        number_digits(r->parameters[i], DIGITS_Z, value);
        output_format(r->out, ", %s %s", r->effect->parameters[i].name, value);
    }
    if (r->effect->reference != NULL)
        output_format(r->out, "; %s is where it is worst", r->effect->reference);
    snprintf(usable, sizeof usable, "%s %s", r->wanted->name, direction(r));
    output_format(r->out, "\n%12s %10s %15s %13s %12s %20s\n", "z", "code", "stored", "interval", "levels", usable);
}

static void text_summary(const report *r, const summary *s) {
    if (isnan(s->usable)) {
        output_format(r->out, "  no %s is usable at z = ", r->wanted->name);
    } else {
        output_format(r->out, "  %s %s ", r->wanted->name, direction(r));
        put_number(r->out, 0, DIGITS, s->usable);
        output_format(r->out, "%s keeps the error at most one level at every depth shown; what decides is z = ",
                      r->effect->smallest ? " up" : "");
    }
    put_number(r->out, 0, DIGITS_Z, s->z);
    output_char(r->out, '\n');
}

static void write_text(report *r) {
    for (size_t i = 0; i < r->all.count; i++) {
        const dp_setup *setup = &r->all.items[i];
        char label[SETUP_LABEL_SIZE];
        output_format(r->out, "%s%s\n", i > 0 ? "\n" : "", setup_label(setup, true, label));
        text_head(r);
        const summary s = each_row(r, setup, text_row, NULL);
        text_summary(r, &s);
    }
}

/* ---- JSON -------------------------------------------------------------------------------------------------------- */

static void json_row(void *to, const report *r, const dp_setup *setup, const row *x) {
    json *j = to;
    (void)r, (void)setup;
    json_object(j, NULL);
    json_number(j, "z", x->sample.z);
    json_integer(j, "code", x->sample.code);
    json_number(j, "z_stored", x->sample.stored);
    json_number(j, "interval", x->sample.interval);
    json_number(j, "levels", x->levels);
    json_number(j, "usable", x->usable);
    json_end(j);
}

static void write_json(report *r) {
    json j = json_start(r->out, "texture");
    json_string(&j, "effect", r->effect->name);
    json_array(&j, "parameters");
    for (int i = 0; r->effect->parameters[i].name != NULL; i++) {
        json_object(&j, NULL);
        json_string(&j, "name", r->effect->parameters[i].name);
        json_string(&j, "unit", r->effect->parameters[i].unit);
        json_number(&j, "value", r->parameters[i]);
        json_end(&j);
    }
    json_end(&j);
    json_string(&j, "wanted", r->wanted->name);
    json_string(&j, "direction", direction(r));
    json_array(&j, "setups");
    for (size_t i = 0; i < r->all.count; i++) {
        json_object(&j, NULL);
        setup_json(&j, &r->all.items[i]);
        json_array(&j, "rows");
        const summary s = each_row(r, &r->all.items[i], json_row, &j);
        json_end(&j);
        json_object(&j, "all");
        json_number(&j, "usable", s.usable);
        json_number(&j, "z", s.z);
        json_end(&j);
        json_end(&j);
    }
    json_finish(&j);
}

/* ---- CSV --------------------------------------------------------------------------------------------------------- */

static void csv_row(void *to, const report *r, const dp_setup *setup, const row *x) {
    csv *c = to;
    setup_csv(c, setup);
    csv_string(c, r->effect->name);
    csv_number(c, x->sample.z);
    csv_integer(c, x->sample.code);
    csv_number(c, x->sample.stored);
    csv_number(c, x->sample.interval);
    csv_number(c, x->levels);
    csv_number(c, x->usable);
    csv_end(c);
}

static void write_csv(report *r) {
    static const char *const heads[] = {"effect",           "z [scene]",        "code",
                                        "z_stored [scene]", "interval [scene]", "levels [1/255]"};
    char usable[64];
    csv c = csv_start(r->out);
    setup_csv_head(&c);
    for (size_t i = 0; i < sizeof heads / sizeof heads[0]; i++)
        csv_string(&c, heads[i]);
    snprintf(usable, sizeof usable, "%s %s [%s]", r->wanted->name, direction(r), r->wanted->unit);
    csv_string(&c, usable);
    csv_end(&c);
    for (size_t i = 0; i < r->all.count; i++)
        each_row(r, &r->all.items[i], csv_row, &c);
}

int texture_effect_table(const options *o) {
    static void (*const writers[])(report *) = {
        [FORM_TEXT] = write_text, [FORM_JSON] = write_json, [FORM_CSV] = write_csv};
    output out;
    report r = {.o = o, .out = &out};
    int status = texture_effect_resolve(o, &r.effect, r.parameters);
    if (status == EXIT_FINE && r.effect->eye01 && isinf(o->zfar))
        status = option_error(OPTION_FAR, "must be finite for %s, which uses z/far, got inf", r.effect->name);
    if (status == EXIT_FINE)
        status = setups_make(o, &r.all);
    if (status == EXIT_FINE)
        status = depths_resolve(o, DEFAULT_ROWS, &r.at);
    if (status == EXIT_FINE)
        status = output_open(&out, o->output);
    if (status == EXIT_FINE) {
        r.wanted = &r.effect->parameters[r.effect->wanted];
        r.progress = progress_start("rows", (uint64_t)r.all.count * r.at.count, o->quiet || isatty(out.fd));
        writers[o->form](&r);
        progress_end(&r.progress);
        status = output_close(&out);
    }
    setups_release(&r.all);
    return status;
}
