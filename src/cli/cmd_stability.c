/* SPDX-License-Identifier: GPL-3.0-or-later */
/* stability: where the methods of a family lose what they claim. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "cli/methods.h"
#include "report/csv.h"
#include "report/json.h"
#include "report/number.h"

int cmd_stability(const options *o);

typedef struct walking {
    output *out;
    const method_family_row *family;
    stability_result results[STABILITY_MAX];
    size_t count;
} walking;

static const method_claim *claim_of(const stability_result *r) {
    return &r->row->claims[r->which];
}

static double claimed_to(const stability_result *r) {
    return isnan(claim_of(r)->worst) ? (double)NAN : claim_of(r)->ratio_hi;
}

/* NaN beyond the claim's span. */
static double claimed_at(const stability_result *r, int k) {
    return r->ratio[k] <= claim_of(r)->ratio_hi * (1 + 1e-9) ? method_claim_at(claim_of(r), r->ratio[k]) : (double)NAN;
}

static void cell(output *out, int width, double value) {
    char text[NUMBER_SIZE] = "-";
    if (!isnan(value))
        number_digits(value, 3, text);
    output_format(out, " %*s", width, text);
}

static void write_text(walking *w) {
    output_format(w->out, "%s: %s; worst %s for far/near from 10 to 1e12\n", w->family->name, w->family->summary,
                  w->family->measure);
    output_format(w->out, "%-20s %-14s %8s %8s %9s %9s %9s %9s  %s\n", "method", "case", "claim", "up to", "worst",
                  "breaks at", "far inf", "ortho", "verdict");
    for (size_t i = 0; i < w->count; i++) {
        const stability_result *r = &w->results[i];
        output_format(w->out, "%-20s %-14s", r->row->name, w->family->cases[r->which].name);
        cell(w->out, 8, r->claim);
        cell(w->out, 8, claimed_to(r));
        cell(w->out, 9, r->inside);
        cell(w->out, 9, isinf(r->breaks) ? (double)NAN : r->breaks);
        cell(w->out, 9, r->infinite);
        cell(w->out, 9, r->ortho);
        output_format(w->out, "  %s\n", stability_verdict_name(r->verdict));
    }
}

static void write_json(walking *w) {
    json j = json_start(w->out, "stability");
    json_string(&j, "family", w->family->name);
    json_string(&j, "measure", w->family->measure);
    json_array(&j, "methods");
    for (size_t i = 0; i < w->count; i++) {
        const stability_result *r = &w->results[i];
        json_object(&j, NULL);
        json_string(&j, "name", r->row->name);
        json_string(&j, "case", w->family->cases[r->which].name);
        json_number(&j, "claim", r->claim);
        json_number(&j, "claim_to", claimed_to(r));
        json_number(&j, "worst", r->inside);
        json_number(&j, "worst_near", r->inside_near);
        json_number(&j, "worst_far", r->inside_far);
        json_number(&j, "worst_at", r->inside_at);
        json_number(&j, "breaks", r->breaks);
        json_number(&j, "infinite", r->infinite);
        json_number(&j, "ortho", r->ortho);
        json_string(&j, "verdict", stability_verdict_name(r->verdict));
        json_array(&j, "walk");
        for (int k = 0; k < r->steps; k++) {
            json_object(&j, NULL);
            json_number(&j, "ratio", r->ratio[k]);
            json_number(&j, "error", r->error[k]);
            json_number(&j, "claim", claimed_at(r, k));
            json_end(&j);
        }
        json_end(&j);
        json_end(&j);
    }
    json_finish(&j);
}

static void write_csv(walking *w) {
    static const char *const heads[] = {"family", "method", "case", "claim", "claim_to", "verdict", "ratio", "error"};
    csv c = csv_start(w->out);
    for (size_t i = 0; i < sizeof heads / sizeof heads[0]; i++)
        csv_string(&c, heads[i]);
    csv_end(&c);
    for (size_t i = 0; i < w->count; i++) {
        const stability_result *r = &w->results[i];
        for (int k = 0; k < r->steps; k++) {
            csv_string(&c, w->family->name);
            csv_string(&c, r->row->name);
            csv_string(&c, w->family->cases[r->which].name);
            csv_number(&c, claimed_at(r, k));
            csv_number(&c, claimed_to(r));
            csv_string(&c, stability_verdict_name(r->verdict));
            csv_number(&c, r->ratio[k]);
            csv_number(&c, r->error[k]);
            csv_end(&c);
        }
    }
}

/* A claim that does not hold, or holds far too easily, is a check that failed. */
static bool all_hold(const walking *w) {
    for (size_t i = 0; i < w->count; i++)
        if (w->results[i].verdict == STABILITY_BROKEN || w->results[i].verdict == STABILITY_MODEST)
            return false;
    return true;
}

int cmd_stability(const options *o) {
    static void (*const writers[])(walking *) = {
        [FORM_TEXT] = write_text, [FORM_JSON] = write_json, [FORM_CSV] = write_csv};
    output out;
    walking *w = calloc(1, sizeof *w);
    if (w == NULL)
        return usage_error("no memory for the methods");
    w->out = &out;
    w->family = o->operand_row;
    int status = output_open(&out, o->output);
    if (status == EXIT_FINE) {
        w->count = stability_run(w->family, w->results);
        if (w->count > 0) {
            writers[o->form](w);
            status = output_close(&out);
        } else {
            output_abandon(&out);
            status = usage_error("no memory for the methods");
        }
        if (status == EXIT_FINE && !all_hold(w))
            status = EXIT_FAILED;
    }
    free(w);
    return status;
}
