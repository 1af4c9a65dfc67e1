/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * bias: what a depth bias of an API moves in the scene; or, when no bias is given, how much of it is enough to tell
 * coplanar layers apart, or to bring one nearer by a gap.
 */
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "api/bias.h"
#include "cli/options.h"
#include "cli/progress.h"
#include "cli/setups.h"
#include "report/csv.h"
#include "report/json.h"
#include "report/number.h"

int cmd_bias(const struct options *o);

enum { DEFAULT_ROWS = 9, DIGITS = 6, DIGITS_Z = 9 };

typedef struct report {
    const options *o;
    output *out;
    setups all;
    depths at;
    bias_state state;
    bias_goal goal;
    bool inverse; /* no bias was given: one is asked for */
    progress progress;
    uint64_t done;
} report;

/* One line: what the bias does, or what one unit does and how many are enough. */
typedef struct bias_row {
    bias_effect effect; /* of the bias given, or of one unit that brings a layer nearer */
    double apart;       /* inverse: the units that tell layers apart, with their sign; NaN when none do */
    double gap;         /* inverse: the units that bring a layer nearer by the gap */
} bias_row;

/* Inverse: the same over the range. */
typedef struct bias_range {
    double lo, hi, gap_lo;
    double apart, apart_z;
    double gap, gap_z;
    double shift_lo, shift_hi; /* what the units of the gap do at the ends, or those that tell apart without a gap */
} bias_range;

/* ---- What is asked ----------------------------------------------------------------------------------------------- */

static double with_sign(const dp_setup *setup, double units) {
    return isinf(units) ? (double)NAN : units * bias_sign(setup) + 0.0; /* no -0 */
}

/* What is asked of this set-up: the factor is written with the sign that the API takes, the goal counts nearer as +. */
static bias_goal goal_of(const report *r, const dp_setup *setup, double gap) {
    bias_goal goal = r->goal;
    goal.factor = r->state.factor * bias_sign(setup);
    goal.gap = gap;
    return goal;
}

static bias_row row_at(const report *r, const dp_setup *setup, double z) {
    bias_state state = r->state;
    if (!r->inverse)
        return (bias_row){.effect = bias_at(setup, &state, r->goal.slope, z)};
    state.units = bias_sign(setup);
    state.factor = 0.0;
    const bias_goal apart = goal_of(r, setup, 0.0);
    const bias_goal gap = goal_of(r, setup, r->goal.gap);
    return (bias_row){.effect = bias_at(setup, &state, r->goal.slope, z),
                      .apart = with_sign(setup, bias_needed(setup, &apart, z)),
                      .gap = with_sign(setup, bias_needed(setup, &gap, z))};
}

static double shift_with(const report *r, const dp_setup *setup, double units, double z) {
    bias_state state = r->state;
    state.units = units;
    return isnan(units) || isinf(z) ? (double)NAN : bias_at(setup, &state, r->goal.slope, z).shift;
}

static bias_range over_range(const report *r, const dp_setup *setup, double lo, double hi) {
    bias_range range = {.lo = lo, .hi = hi, .gap_lo = fmax(lo, setup->spec.znear + r->goal.gap)};
    const bias_goal apart = goal_of(r, setup, 0.0);
    const bias_goal gap = goal_of(r, setup, r->goal.gap);
    range.apart = with_sign(setup, bias_needed_over(setup, &apart, lo, hi, &range.apart_z));
    range.gap = range.gap_z = (double)NAN;
    if (r->goal.gap > 0.0 && range.gap_lo < hi)
        range.gap = with_sign(setup, bias_needed_over(setup, &gap, range.gap_lo, hi, &range.gap_z));
    const double units = r->goal.gap > 0.0 ? range.gap : range.apart;
    range.shift_lo = shift_with(r, setup, units, range.gap_lo);
    range.shift_hi = shift_with(r, setup, units, hi);
    return range;
}

static void each_row(report *r, const dp_setup *setup,
                     void (*emit)(void *, const report *, const dp_setup *, const bias_row *), void *to) {
    for (size_t i = 0; i < r->at.count && !output_failed(r->out); i++) {
        const bias_row row = row_at(r, setup, depths_get(&r->at, i));
        emit(to, r, setup, &row);
        progress_step(&r->progress, ++r->done);
    }
}

/* ---- Text -------------------------------------------------------------------------------------------------------- */

static void put_number(output *out, int width, int digits, double value) {
    char text[NUMBER_SIZE];
    number_digits(value, digits, text);
    output_format(out, "%*s", width, isnan(value) ? "-" : text);
}

static void text_row(void *to, const report *r, const dp_setup *setup, const bias_row *row) {
    const bias_effect *e = &row->effect;
    bool *limited = to;
    (void)setup;
    put_number(r->out, 12, DIGITS_Z, e->z);
    put_number(r->out, 13, DIGITS, e->r.least);
    if (r->goal.slope > 0.0)
        put_number(r->out, 13, DIGITS, e->m);
    if (r->inverse) {
        put_number(r->out, 13, DIGITS, e->limited ? (double)NAN : fabs(e->shift));
        put_number(r->out, 17, DIGITS_Z, row->apart);
        if (r->goal.gap > 0.0)
            put_number(r->out, 17, DIGITS_Z, row->gap);
    } else {
        *limited = *limited || e->limited;
        put_number(r->out, 13, DIGITS, e->offset);
        output_format(r->out, " %10u %10u", e->code, e->moved);
        put_number(r->out, 18, DIGITS_Z + 1, e->to);
        put_number(r->out, 13, DIGITS, e->shift);
    }
    output_text(r->out, r->o->verbose && e->limited ? "  held at a plane\n" : "\n");
}

static void text_head(const report *r) {
    output_format(r->out, "%12s %12s", "z", "r");
    if (r->goal.slope > 0.0)
        output_format(r->out, " %12s", "slope");
    if (r->inverse)
        output_format(r->out, " %12s %16s", "one unit", "told apart");
    else
        output_format(r->out, " %12s %10s %10s %17s %12s", "bias", "code", "moved to", "stands for", "shift");
    if (r->inverse && r->goal.gap > 0.0)
        output_format(r->out, " %16s", "the gap");
    output_char(r->out, '\n');
}

/* "  told apart  -2 units from 0.1 to 1000 (needed at z = 0.1)" */
static void text_needed(output *out, const char *what, double units, double lo, double hi, double z) {
    output_format(out, "  %-12s", what);
    if (isnan(units))
        output_text(out, "no bias is enough");
    else
        put_number(out, 0, DIGITS_Z, units);
    output_text(out, isnan(units) ? " from " : fabs(units) == 1.0 ? " unit from " : " units from ");
    put_number(out, 0, DIGITS_Z, lo);
    output_text(out, " to ");
    put_number(out, 0, DIGITS_Z, hi);
    if (!isnan(units)) {
        output_text(out, " (needed at z = ");
        put_number(out, 0, DIGITS_Z, z);
        output_text(out, ")");
    }
    output_char(out, '\n');
}

static void text_range(const report *r, const bias_range *range) {
    text_needed(r->out, "told apart", range->apart, range->lo, range->hi, range->apart_z);
    if (r->goal.gap == 0.0)
        return;
    text_needed(r->out, "the gap", range->gap, range->gap_lo, range->hi, range->gap_z);
    if (isnan(range->shift_hi))
        return;
    output_text(r->out, "              the same units bring a layer nearer by ");
    put_number(r->out, 0, DIGITS, fabs(range->shift_hi));
    output_text(r->out, " at z = ");
    put_number(r->out, 0, DIGITS_Z, range->hi);
    output_char(r->out, '\n');
}

static void text_notes(const report *r, const dp_setup *setup, bool limited) {
    const bias_api *api = r->state.api;
    const bias_unit unit = bias_unit_at(api, &setup->spec.format, 1.0);
    const double nearer = bias_sign(setup);
    if (!r->inverse)
        output_format(r->out, "  %s bias brings a layer nearer\n", nearer < 0.0 ? "a negative" : "a positive");
    if (limited)
        output_text(r->out, "  a biased depth that leaves [0, 1] is held at the plane\n");
    if (isinf(unit.most))
        output_text(r->out, "  r is the implementation's choice: the one shown is an assumption\n");
    else if (unit.most > unit.least)
        output_text(r->out, "  r is the implementation's choice: it may be up to twice the one shown\n");
}

static void text_states(const report *r) {
    static const char *const names[] = {"units", "factor", "clamp"};
    const double values[] = {r->state.units, r->state.factor, r->state.clamp};
    char text[NUMBER_SIZE];
    output_text(r->out, r->state.api->name);
    for (int i = 0; i < 3; i++) {
        if (r->inverse ? i != 1 || values[i] == 0.0 : i > 0 && values[i] == 0.0)
            continue;
        number_shortest(values[i], text);
        output_format(r->out, ", %s %s", names[i], text);
    }
    if (r->goal.slope > 0.0) {
        number_shortest(r->goal.slope, text);
        output_format(r->out, ", slope %s a pixel", text);
    }
    output_char(r->out, '\n');
}

static int write_text(report *r) {
    double lo, hi;
    int status = range_resolve(r->o, &lo, &hi);
    for (size_t i = 0; i < r->all.count && status == EXIT_FINE; i++) {
        const dp_setup *setup = &r->all.items[i];
        char label[SETUP_LABEL_SIZE];
        bool limited = false;
        output_format(r->out, "%s%s\n", i > 0 ? "\n" : "", setup_label(setup, true, label));
        text_states(r);
        text_head(r);
        each_row(r, setup, text_row, &limited);
        if (r->inverse) {
            const bias_range range = over_range(r, setup, lo, hi);
            text_range(r, &range);
        }
        text_notes(r, setup, limited);
    }
    return status;
}

/* ---- JSON -------------------------------------------------------------------------------------------------------- */

static void json_row(void *to, const report *r, const dp_setup *setup, const bias_row *row) {
    const bias_effect *e = &row->effect;
    json *j = to;
    (void)setup;
    json_object(j, NULL);
    json_number(j, "z", e->z);
    json_number(j, "r", e->r.least);
    json_number(j, "r_most", e->r.most);
    json_number(j, "slope", e->m);
    if (r->inverse) {
        json_number(j, "one_unit", e->limited ? (double)NAN : fabs(e->shift));
        json_number(j, "units_apart", row->apart);
        if (r->goal.gap > 0.0)
            json_number(j, "units_gap", row->gap);
    } else {
        json_number(j, "bias", e->offset);
        json_number(j, "depth", e->depth);
        json_integer(j, "code", e->code);
        json_integer(j, "code_moved", e->moved);
        json_number(j, "z_moved", e->to);
        json_number(j, "shift", e->shift);
        json_bool(j, "limited", e->limited);
    }
    json_end(j);
}

static void json_range(json *j, const report *r, const bias_range *range) {
    json_object(j, "range");
    json_number(j, "lo", range->lo);
    json_number(j, "hi", range->hi);
    json_number(j, "units_apart", range->apart);
    json_number(j, "units_apart_z", range->apart_z);
    if (r->goal.gap > 0.0) {
        json_number(j, "gap_lo", range->gap_lo);
        json_number(j, "units_gap", range->gap);
        json_number(j, "units_gap_z", range->gap_z);
    }
    json_number(j, "shift_lo", range->shift_lo);
    json_number(j, "shift_hi", range->shift_hi);
    json_end(j);
}

static int write_json(report *r) {
    double lo, hi;
    const int status = range_resolve(r->o, &lo, &hi);
    json j = json_start(r->out, "bias");
    json_string(&j, "api", r->state.api->name);
    json_number(&j, "units", r->inverse ? (double)NAN : r->state.units);
    json_number(&j, "factor", r->state.factor);
    json_number(&j, "clamp", r->state.clamp);
    json_number(&j, "slope", r->goal.slope);
    json_number(&j, "gap", r->inverse ? r->goal.gap : (double)NAN);
    json_array(&j, "setups");
    for (size_t i = 0; i < r->all.count; i++) {
        const dp_setup *setup = &r->all.items[i];
        json_object(&j, NULL);
        setup_json(&j, setup);
        json_array(&j, "rows");
        each_row(r, setup, json_row, &j);
        json_end(&j);
        if (r->inverse) {
            const bias_range range = over_range(r, setup, lo, hi);
            json_range(&j, r, &range);
        }
        json_end(&j);
    }
    json_finish(&j);
    return status;
}

/* ---- CSV --------------------------------------------------------------------------------------------------------- */

static void csv_row(void *to, const report *r, const dp_setup *setup, const bias_row *row) {
    const bias_effect *e = &row->effect;
    csv *c = to;
    setup_csv(c, setup);
    csv_string(c, r->state.api->name);
    csv_number(c, e->z);
    csv_number(c, e->r.least);
    csv_number(c, e->r.most);
    csv_number(c, e->m);
    if (r->inverse) {
        csv_number(c, e->limited ? (double)NAN : fabs(e->shift));
        csv_number(c, row->apart);
        csv_number(c, row->gap);
    } else {
        csv_number(c, e->offset);
        csv_number(c, e->depth);
        csv_integer(c, e->code);
        csv_integer(c, e->moved);
        csv_number(c, e->to);
        csv_number(c, e->shift);
    }
    csv_end(c);
}

static int write_csv(report *r) {
    static const char *const both[] = {"api", "z [scene]", "r", "r_most", "slope [per pixel]", NULL};
    static const char *const needs[] = {"one_unit [scene]", "units_apart", "units_gap", NULL};
    static const char *const does[] = {"bias", "depth", "code", "code_moved", "z_moved [scene]", "shift [scene]", NULL};
    csv c = csv_start(r->out);
    setup_csv_head(&c);
    for (int i = 0; both[i] != NULL; i++)
        csv_string(&c, both[i]);
    for (const char *const *head = r->inverse ? needs : does; *head != NULL; head++)
        csv_string(&c, *head);
    csv_end(&c);
    for (size_t i = 0; i < r->all.count; i++)
        each_row(r, &r->all.items[i], csv_row, &c);
    return EXIT_FINE;
}

/* ---- The command ------------------------------------------------------------------------------------------------- */

static int check_states(const options *o, const bias_api *api) {
    char text[NUMBER_SIZE];
    const bool given = option_given(o, OPTION_UNITS);
    if (given && option_given(o, OPTION_GAP))
        return option_error(OPTION_UNITS, "must not be given together with --gap, which asks for them");
    if (given && api->whole && !(o->units == nearbyint(o->units) && fabs(o->units) <= 0x1.fffffffcp30)) {
        number_shortest(o->units, text);
        return option_error(OPTION_UNITS, "must be a whole number from -2147483647 to 2147483647 for %s, got %s",
                            api->name, text);
    }
    if (option_given(o, OPTION_CLAMP) && !api->clamps)
        return option_error(OPTION_CLAMP, "must not be given for %s, which has no clamp", api->name);
    if (option_given(o, OPTION_CLAMP) && !given)
        return option_error(OPTION_CLAMP, "must be given together with --units");
    return EXIT_FINE;
}

/* No API biases what is written to a colour target, so fp16 is not among the formats when none are asked for. */
static void drop_fp16(options *o) {
    size_t kept = 0;
    for (size_t i = 0; i < o->format_count; i++)
        if (strcmp(o->formats[i].name, "fp16") != 0)
            o->formats[kept++] = o->formats[i];
    o->format_count = kept;
}

int cmd_bias(const options *given) {
    static int (*const writers[])(report *) = {
        [FORM_TEXT] = write_text, [FORM_JSON] = write_json, [FORM_CSV] = write_csv};
    options o = *given;
    output out;
    const bias_api *api = o.api != NULL ? o.api : bias_api_get(0);
    report r = {.o = &o,
                .out = &out,
                .state = {api, o.units, o.factor, o.clamp},
                .goal = {.api = api, .slope = o.slope, .gap = o.gap},
                .inverse = !option_given(&o, OPTION_UNITS)};
    double lo, hi;
    if (!option_given(&o, OPTION_FORMAT) && o.preset == NULL)
        drop_fp16(&o);
    int status = check_states(&o, api);
    if (status == EXIT_FINE)
        status = setups_make(&o, &r.all);
    if (status == EXIT_FINE)
        status = depths_resolve(&o, DEFAULT_ROWS, &r.at);
    if (status == EXIT_FINE)
        status = range_resolve(&o, &lo, &hi);
    if (status == EXIT_FINE)
        status = output_open(&out, o.output);
    if (status == EXIT_FINE) {
        r.progress = progress_start("rows", (uint64_t)r.all.count * r.at.count, o.quiet || isatty(out.fd));
        writers[o.form](&r);
        progress_end(&r.progress);
        status = output_close(&out);
    }
    setups_release(&r.all);
    return status;
}
