/* SPDX-License-Identifier: GPL-3.0-or-later */
/* bench: the methods of a family on the same inputs, their times and their worst errors. */
#include <math.h>
#include <stdio.h>

#include "cli/methods.h"
#include "cli/setups.h"
#include "method/choose.h"
#include "method/estimate.h"
#include "report/csv.h"
#include "report/json.h"
#include "report/number.h"

int cmd_bench(const options *o);

typedef struct benching {
    const options *o;
    output *out;
    methods_asked asked;
    bench_result results[BENCH_METHODS_MAX];
    size_t count;
    const method_row *choice; /* with --tolerance; null when no claim covers it */
    char machine[192];
} benching;

static bool is_choice(const benching *b, size_t i) {
    return b->choice != NULL && b->results[i].row == b->choice;
}

static double error_of(const benching *b, size_t i) {
    return measured_error(b->asked.family, &b->results[i].measured);
}

static void cell(output *out, int width, double value, int digits) {
    char text[NUMBER_SIZE] = "-";
    if (!isnan(value))
        number_digits(value, digits, text);
    output_format(out, " %*s", width, text);
}

static void write_text(benching *b) {
    const method_family_row *f = b->asked.family;
    char znear[NUMBER_SIZE], zfar[NUMBER_SIZE];
    number_shortest(b->o->znear, znear);
    number_shortest(b->o->zfar, zfar);
    output_format(b->out, "%s: %s\n%s, near %s, far %s; %s\n", f->name, f->summary, f->cases[b->asked.which].name,
                  znear, zfar, b->machine);
    output_format(b->out, "  %-20s %9s %7s %7s %9s %10s %10s %10s %13s %9s\n", "method", "ns", "limits", "+- %",
                  "set-up ns", "relative", "absolute", f->steps ? "steps" : "ulp", "worst at", "claim");
    for (size_t i = 0; i < b->count; i++) {
        const bench_result *r = &b->results[i];
        output_format(b->out, "%c%c%-20s", r->front ? '*' : ' ', is_choice(b, i) ? '>' : ' ', r->row->name);
        cell(b->out, 9, r->ns, 3);
        cell(b->out, 7, r->ns / r->limit, 3);
        cell(b->out, 7, 100 * r->spread, 2);
        cell(b->out, 9, r->setup > 0 ? r->setup : (double)NAN, 3);
        cell(b->out, 10, r->measured.worst.relative, 3);
        cell(b->out, 10, r->measured.worst.absolute, 3);
        cell(b->out, 10, r->measured.worst.ulp, 3);
        cell(b->out, 13, f->steps ? r->at_ulp : r->at_relative, 9);
        cell(b->out, 9, r->claim, 3);
        output_char(b->out, '\n');
    }
    output_format(b->out, "  a limit is %.3g ns: a loop that moves the same bytes\n", b->results[0].limit);
    output_text(b->out, "  * no other is both faster and more exact\n");
    for (size_t i = 0; i < b->count; i++)
        if (b->results[i].row->timed != NULL)
            output_format(b->out,
                          "  %s: the time is of this processor's estimate, the errors of a model of it; any\n"
                          "    processor's is within its guarantee, %.3g, and the method within its claim\n",
                          b->results[i].row->name, ESTIMATE_WORST);
    if (b->choice != NULL)
        output_format(b->out, "  > %s is the cheapest whose claim is within the tolerance\n", b->choice->name);
    else if (option_given(b->o, OPTION_TOLERANCE))
        output_text(b->out, "  no method claims the tolerance here\n");
}

static void write_json(benching *b) {
    const method_family_row *f = b->asked.family;
    json j = json_start(b->out, "bench");
    json_string(&j, "family", f->name);
    json_string(&j, "measure", f->measure);
    json_string(&j, "machine", b->machine);
    setup_json(&j, &b->asked.setup);
    json_number(&j, "tolerance", option_given(b->o, OPTION_TOLERANCE) ? b->o->tolerance : (double)NAN);
    json_string(&j, "choice", b->choice != NULL ? b->choice->name : NULL);
    json_number(&j, "limit_ns", b->results[0].limit);
    json_array(&j, "methods");
    for (size_t i = 0; i < b->count; i++) {
        const bench_result *r = &b->results[i];
        json_object(&j, NULL);
        json_string(&j, "name", r->row->name);
        json_number(&j, "ns", r->ns);
        json_number(&j, "limits", r->ns / r->limit);
        json_number(&j, "spread", r->spread);
        json_number(&j, "setup_ns", r->setup);
        json_integer(&j, "inputs", r->inputs);
        json_number(&j, "error", error_of(b, i));
        json_number(&j, "relative", r->measured.worst.relative);
        json_number(&j, "relative_at", r->at_relative);
        json_number(&j, "absolute", r->measured.worst.absolute);
        json_number(&j, "absolute_at", r->at_absolute);
        json_number(&j, "ulp", r->measured.worst.ulp);
        json_number(&j, "ulp_at", r->at_ulp);
        json_number(&j, "claim", r->claim);
        json_bool(&j, "pareto", r->front);
        json_end(&j);
    }
    json_finish(&j);
}

static void write_csv(benching *b) {
    static const char *const heads[] = {"family", "method",   "ns",          "spread",   "setup [ns]",  "inputs",
                                        "error",  "relative", "relative_at", "absolute", "absolute_at", "ulp",
                                        "ulp_at", "claim",    "pareto",      "chosen",   "limit [ns]"};
    csv c = csv_start(b->out);
    for (size_t i = 0; i < sizeof heads / sizeof heads[0]; i++)
        csv_string(&c, heads[i]);
    csv_end(&c);
    for (size_t i = 0; i < b->count; i++) {
        const bench_result *r = &b->results[i];
        csv_string(&c, b->asked.family->name);
        csv_string(&c, r->row->name);
        csv_number(&c, r->ns);
        csv_number(&c, r->spread);
        csv_number(&c, r->setup);
        csv_integer(&c, r->inputs);
        csv_number(&c, error_of(b, i));
        csv_number(&c, r->measured.worst.relative);
        csv_number(&c, r->at_relative);
        csv_number(&c, r->measured.worst.absolute);
        csv_number(&c, r->at_absolute);
        csv_number(&c, r->measured.worst.ulp);
        csv_number(&c, r->at_ulp);
        csv_number(&c, r->claim);
        csv_integer(&c, r->front);
        csv_integer(&c, is_choice(b, i));
        csv_number(&c, r->limit);
        csv_end(&c);
    }
}

int cmd_bench(const options *o) {
    static void (*const writers[])(benching *) = {
        [FORM_TEXT] = write_text, [FORM_JSON] = write_json, [FORM_CSV] = write_csv};
    output out;
    benching b = {.o = o, .out = &out};
    int status = methods_resolve(o, o->operand_row, &b.asked);
    if (status == EXIT_FINE)
        status = output_open(&out, o->output);
    if (status != EXIT_FINE)
        return status;
    b.count = bench_run(b.asked.family, b.asked.which, &b.asked.setup, BENCH_REPETITIONS, b.results);
    if (b.count == 0) {
        output_abandon(&out);
        return usage_error("no memory for the methods");
    }
    const double ratio = o->zfar / o->znear;
    const method_wish wish = {.tolerance = o->tolerance, .ratio_lo = fmin(ratio, METHOD_RATIO_HI), .ratio_hi = ratio};
    if (option_given(o, OPTION_TOLERANCE))
        b.choice = method_choose(b.asked.family, b.asked.which, &wish);
    methods_machine(b.machine, sizeof b.machine);
    writers[o->form](&b);
    return output_close(&out);
}
