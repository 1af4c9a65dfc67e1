/* SPDX-License-Identifier: GPL-3.0-or-later */
/* zfight: what fights in the binary32 pipeline, by visiting every depth or, where asked, by a seeded sample. */
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>

#include "census/census.h"
#include "cli/options.h"
#include "cli/progress.h"
#include "cli/setups.h"
#include "report/csv.h"
#include "report/json.h"
#include "report/number.h"

int cmd_zfight(const options *o);

typedef struct zfight {
    const options *o;
    output *out;
    setups all;
    census_result *results; /* one a set-up */
    double lo, hi;
    uint64_t before; /* depths of the set-ups that are finished */
    progress progress;
} zfight;

/* ---- Work, and how it is interrupted ----------------------------------------------------------------------------- */

static volatile sig_atomic_t interrupted;

static void interrupt(int number) {
    interrupted = number;
}

static int tick(void *context, uint64_t done) {
    zfight *z = context;
    progress_step(&z->progress, z->before + done);
    return interrupted != 0;
}

static uint64_t visits(const zfight *z) {
    return z->o->sample > 0 ? z->o->sample : census_count(z->lo, z->hi);
}

static census_status work(zfight *z, const dp_setup *setup, census_result *result) {
    const census_sample_request q = {.common = {.setup = setup,
                                                .lo = z->lo,
                                                .hi = z->hi,
                                                .threads = z->o->threads,
                                                .bound = dp_separation,
                                                .progress = tick,
                                                .context = z},
                                     .count = z->o->sample,
                                     .seed = z->o->seed,
                                     .gap = z->o->gap};
    if (z->o->sample > 0 || z->o->gap > 0.0)
        return census_sample(&q, result);
    return census_run(&q.common, result);
}

static int work_all(zfight *z) {
    for (size_t i = 0; i < z->all.count; i++) {
        switch (work(z, &z->all.items[i], &z->results[i])) {
        case CENSUS_DONE:
            break;
        case CENSUS_NO_MEMORY:
            return usage_error("no memory for the census");
        default: /* interrupted: what else there is was refused before */
            return EXIT_FAILED;
        }
        z->before += visits(z);
    }
    return EXIT_FINE;
}

/* ---- Text -------------------------------------------------------------------------------------------------------- */

enum { DIGITS = 6, PLANE_DIGITS = 9 };

static double percent(uint64_t part, uint64_t whole) {
    return whole > 0 ? 100.0 * (double)part / (double)whole : 0.0;
}

/* Right-aligned; a dash for what does not exist. */
static void cell(output *out, int width, double value, int digits) {
    char text[NUMBER_SIZE] = "-";
    if (!isnan(value))
        number_digits(value, digits, text);
    output_format(out, " %*s", width, text);
}

/* A range that ends on a power of two leaves its last depth alone in a band, and a sample may miss a band. */
static int is_empty(const census_band *b) {
    return b->pairs == 0;
}

static int with_intervals(const options *o) {
    return o->gap <= 0.0;
}

static void text_band(const zfight *z, const census_band *b) {
    cell(z->out, 9, b->lo, DIGITS);
    cell(z->out, 9, b->hi, DIGITS);
    output_format(z->out, " %11llu", (unsigned long long)b->pairs);
    output_format(z->out, " %8.4f %8.4f", percent(b->ties, b->pairs), percent(b->swaps, b->pairs));
    if (with_intervals(z->o)) {
        cell(z->out, 12, b->longest, DIGITS);
        cell(z->out, 10, b->longest_z, DIGITS);
    }
    char bound[NUMBER_SIZE] = "-";
    if (!isnan(b->bound)) /* it holds as it is printed */
        number_bound(b->bound, DIGITS, true, bound);
    output_format(z->out, " %12s", bound);
    if (with_intervals(z->o))
        output_format(z->out, " %7.3f", b->slack);
    output_char(z->out, '\n');
}

static void text_setup(const zfight *z, const dp_setup *setup, const census_result *r) {
    char label[SETUP_LABEL_SIZE];
    char znear[NUMBER_SIZE];
    char zfar[NUMBER_SIZE];
    output_format(z->out, "%s\n", setup_label(setup, true, label));
    output_format(z->out, "%10s%10s%12s%9s%9s", "from", "to", "pairs", "ties %", "swaps %");
    output_format(z->out, with_intervals(z->o) ? "%13s%11s%13s%8s\n" : "%13s\n",
                  with_intervals(z->o) ? "longest" : "bound", "at", "bound", "used");
    for (int i = 0; i < r->band_count; i++)
        if (!is_empty(&r->bands[i]))
            text_band(z, &r->bands[i]);
    text_band(z, &r->all);
    number_digits(r->near_effective, PLANE_DIGITS, znear);
    number_digits(r->far_effective, PLANE_DIGITS, zfar);
    if (isnan(r->near_effective))
        output_text(z->out, "  clipping loses everything\n");
    else
        output_format(z->out, "  drawn from %s to %s\n", znear, zfar);
}

static void write_text(zfight *z) {
    for (size_t i = 0; i < z->all.count; i++) {
        if (i > 0)
            output_char(z->out, '\n');
        text_setup(z, &z->all.items[i], &z->results[i]);
    }
}

/* ---- JSON -------------------------------------------------------------------------------------------------------- */

static const char *method_name(const options *o) {
    return o->sample > 0 ? "sample" : "census";
}

static void json_counts(json *j, const zfight *z, const census_band *b) {
    json_integer(j, "pairs", b->pairs);
    json_integer(j, "ties", b->ties);
    json_integer(j, "swaps", b->swaps);
    json_number(j, "longest", with_intervals(z->o) ? b->longest : (double)NAN);
    json_number(j, "longest_z", b->longest_z);
    json_number(j, "bound", b->bound);
    json_number(j, "used", with_intervals(z->o) ? b->slack : (double)NAN);
}

/* A sample does not count clipped depths: it would only count those that it drew. */
static int counts_clipped(const zfight *z) {
    return z->o->sample == 0 && with_intervals(z->o);
}

static void json_setup(json *j, const zfight *z, const dp_setup *setup, const census_result *r) {
    json_object(j, NULL);
    setup_json(j, setup);
    json_string(j, "method", method_name(z->o));
    if (z->o->sample > 0)
        json_integer(j, "seed", z->o->seed);
    if (z->o->gap > 0.0)
        json_number(j, "gap", z->o->gap);
    json_number(j, "lo", z->lo);
    json_number(j, "hi", z->hi);
    json_counts(j, z, &r->all);
    if (counts_clipped(z)) {
        json_integer(j, "clipped", r->all.clipped);
        json_integer(j, "holes", r->holes);
    }
    json_number(j, "near_effective", r->near_effective);
    json_number(j, "far_effective", r->far_effective);
    json_array(j, "bands");
    for (int i = 0; i < r->band_count; i++) {
        if (is_empty(&r->bands[i]))
            continue;
        json_object(j, NULL);
        json_number(j, "lo", r->bands[i].lo);
        json_number(j, "hi", r->bands[i].hi);
        json_counts(j, z, &r->bands[i]);
        json_end(j);
    }
    json_end(j);
    json_end(j);
}

static void write_json(zfight *z) {
    json j = json_start(z->out, "zfight");
    json_array(&j, "setups");
    for (size_t i = 0; i < z->all.count; i++)
        json_setup(&j, z, &z->all.items[i], &z->results[i]);
    json_finish(&j);
}

/* ---- CSV: a line a band ------------------------------------------------------------------------------------------ */

static void csv_band(csv *c, const zfight *z, const dp_setup *setup, const census_result *r, const census_band *b) {
    setup_csv(c, setup);
    csv_string(c, dp_arith_get(setup->spec.arith)->name);
    csv_string(c, method_name(z->o));
    csv_integer(c, z->o->seed);
    csv_number(c, z->o->gap);
    csv_number(c, b->lo);
    csv_number(c, b->hi);
    csv_integer(c, b->pairs);
    csv_integer(c, b->ties);
    csv_integer(c, b->swaps);
    csv_number(c, with_intervals(z->o) ? b->longest : (double)NAN);
    csv_number(c, b->longest_z);
    csv_number(c, b->bound);
    csv_number(c, with_intervals(z->o) ? b->slack : (double)NAN);
    csv_number(c, counts_clipped(z) ? (double)b->clipped : (double)NAN);
    csv_number(c, r->near_effective);
    csv_number(c, r->far_effective);
    csv_end(c);
}

static void write_csv(zfight *z) {
    static const char *const heads[] = {"arith",
                                        "method",
                                        "seed",
                                        "gap [scene]",
                                        "lo [scene]",
                                        "hi [scene]",
                                        "pairs",
                                        "ties",
                                        "swaps",
                                        "longest [scene]",
                                        "longest_z [scene]",
                                        "bound [scene]",
                                        "used",
                                        "clipped",
                                        "near_effective [scene]",
                                        "far_effective [scene]"};
    csv c = csv_start(z->out);
    setup_csv_head(&c);
    for (size_t i = 0; i < sizeof heads / sizeof heads[0]; i++)
        csv_string(&c, heads[i]);
    csv_end(&c);
    for (size_t i = 0; i < z->all.count; i++)
        for (int b = 0; b < z->results[i].band_count; b++)
            if (!is_empty(&z->results[i].bands[b]))
                csv_band(&c, z, &z->all.items[i], &z->results[i], &z->results[i].bands[b]);
}

/* ---- The command ------------------------------------------------------------------------------------------------- */

/* Geometry that the user asked about and the hardware would not draw: worth a line, whatever the form of the data. */
static void warn(const zfight *z) {
    for (size_t i = 0; i < z->all.count && !z->o->quiet; i++) {
        const census_result *r = &z->results[i];
        char label[SETUP_LABEL_SIZE];
        char from[NUMBER_SIZE];
        char to[NUMBER_SIZE];
        uint64_t kept = isnan(r->near_effective) ? 0 : census_count(r->near_effective, r->far_effective);
        if (kept == census_count(z->lo, z->hi) && r->holes == 0)
            continue;
        setup_label(&z->all.items[i], false, label);
        number_digits(r->near_effective, PLANE_DIGITS, from);
        number_digits(r->far_effective, PLANE_DIGITS, to);
        if (kept == census_count(z->lo, z->hi))
            fprintf(stderr, "depthprec: warning: %s: clipping in binary32 loses %llu depths between %s and %s\n", label,
                    (unsigned long long)r->holes, from, to);
        else if (kept == 0)
            fprintf(stderr, "depthprec: warning: %s: clipping in binary32 loses everything\n", label);
        else
            fprintf(stderr, "depthprec: warning: %s: clipping in binary32 keeps only %s to %s%s\n", label, from, to,
                    r->holes > 0 ? ", with holes" : "");
    }
}

static int check(zfight *z) {
    const options *o = z->o;
    for (size_t i = 0; i < o->mapping_count; i++)
        if (dp_mapping_get(o->mappings[i])->curve != DP_CURVE_PERSPECTIVE)
            return option_error(OPTION_MAPPING, "zfight needs d3d, gl, reversed or gl-reversed, got '%s'",
                                dp_mapping_get(o->mappings[i])->name);
    if (option_given(o, OPTION_SEED) && o->sample == 0)
        return option_error(OPTION_SEED, "needs --sample");
    options fp32 = *o;
    fp32.model = DP_MODEL_FP32;
    int status = setups_make(&fp32, &z->all);
    if (status == EXIT_FINE)
        status = range_resolve(o, &z->lo, &z->hi);
    if (status == EXIT_FINE && isinf(z->hi))
        status = option_error(OPTION_RANGE, "must be given when far is inf: every depth up to infinity is too many");
    if (status == EXIT_FINE && census_count(z->lo, z->hi) < 2)
        status = option_error(OPTION_RANGE, "must hold at least two binary32 depths");
    if (status == EXIT_FINE && o->gap >= z->hi - z->lo)
        status = option_error(OPTION_GAP, "must be less than the range is wide");
    return status;
}

static int run(zfight *z) {
    static void (*const writers[])(zfight *) = {
        [FORM_TEXT] = write_text, [FORM_JSON] = write_json, [FORM_CSV] = write_csv};
    struct sigaction action = {.sa_handler = interrupt};
    struct sigaction before;
    sigemptyset(&action.sa_mask);
    if (sigaction(SIGINT, NULL, &before) == 0 && before.sa_handler != SIG_IGN)
        sigaction(SIGINT, &action, NULL);
    z->progress = progress_start("depths", z->all.count * visits(z), z->o->quiet);
    int status = work_all(z);
    progress_end(&z->progress);
    if (interrupted) {
        output_abandon(z->out);
        fprintf(stderr, "depthprec: interrupted: nothing was written\n");
        signal(SIGINT, SIG_DFL); /* the shell should see what ended us */
        raise(SIGINT);
    }
    if (status != EXIT_FINE) {
        output_abandon(z->out);
        return status;
    }
    writers[z->o->form](z);
    warn(z);
    return output_close(z->out);
}

int cmd_zfight(const options *o) {
    output out;
    zfight z = {.o = o, .out = &out};
    int status = check(&z);
    if (status == EXIT_FINE) {
        z.results = calloc(z.all.count, sizeof *z.results);
        if (z.results == NULL)
            status = usage_error("no memory for %zu set-ups", z.all.count);
    }
    if (status == EXIT_FINE)
        status = output_open(&out, o->output);
    if (status == EXIT_FINE)
        status = run(&z);
    free(z.results);
    setups_release(&z.all);
    return status;
}
