/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file measured.h  In place of the measuring of methods: numbers that are all different. Included by one
 * file of a test program; the linker then leaves the real ones out.
 */
#ifndef TESTS_MEASURED_H
#define TESTS_MEASURED_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "method/choose.h"
#include "method/cmd_methods/methods.h"
#include "printed.h"

int cmd_methods(void *request);
int cmd_plot(void *request);

/* ---- In place of the measuring ----------------------------------------------------------------------------------- */

static bench_result timed[BENCH_METHODS_MAX];
static stability_result walked[STABILITY_MAX];
static stability_verdict verdicts[STABILITY_MAX]; /* for the results in turn */
static size_t walked_count;
static dp_setup asked; /* that was timed last */
static size_t asked_which;
static struct { /* of each family what was timed last */
    bench_result timed[BENCH_METHODS_MAX];
    size_t count, which;
} all_timed[METHOD_FAMILY_COUNT];
static bool none_on_front; /* of any first case */

/* A new number each time, over some decades. */
static double next_number(void) {
    static int count;
    count = (count + 1) % 997;
    return pow(10, -4 + 7 * fmod(count * 0.6180339887498949, 1));
}

double measured_error(const method_family_row *family, const measured *m) {
    return family->steps ? m->worst.ulp : m->worst.relative;
}

double method_claimed(const method_row *row, size_t which, const dp_setup *setup) {
    (void)row, (void)which, (void)setup;
    return NAN;
}

bool method_measure(const method_family_row *family, const method_row *row, const dp_setup *setup,
                    const method_inputs *in, const method_outputs *out, measured *m) {
    (void)family, (void)row, (void)setup, (void)in, (void)out, (void)m;
    return false;
}

size_t bench_run(const method_family_row *family, size_t which, const dp_setup *setup, int repetitions,
                 bench_result results[BENCH_METHODS_MAX]) {
    size_t count = 0;
    const double limit = next_number();
    assert_int_equal(repetitions, BENCH_REPETITIONS);
    asked = *setup;
    asked_which = which;
    for (size_t i = 0; i < *family->method_count; i++) {
        if (!method_speaks(&family->methods[i], which) || !method_suits(&family->methods[i], setup))
            continue;
        results[count] = (bench_result){.row = &family->methods[i],
                                        .inputs = 100 + 7 * count,
                                        .ns = next_number(),
                                        .spread = next_number(),
                                        .limit = limit,
                                        .setup = count % 3 == 1 ? 0 : next_number(),
                                        .measured = {.worst = {next_number(), next_number(), next_number()}},
                                        .at_absolute = next_number(),
                                        .at_relative = next_number(),
                                        .at_ulp = next_number(),
                                        .claim = count % 4 == 2 ? NAN : next_number(),
                                        .bound = count % 4 == 1 ? NAN : next_number(),
                                        .front = count % 2 == 0 && !(none_on_front && which == 0)};
        timed[count] = results[count];
        all_timed[family->methods->family].timed[count] = results[count];
        count++;
    }
    all_timed[family->methods->family].count = count;
    all_timed[family->methods->family].which = which;
    return count;
}

bool stability_must_break(const method_claim *c) {
    return c->ratio_hi < METHOD_RATIO_HI;
}

const char *stability_verdict_name(stability_verdict verdict) {
    static const char *const names[STABILITY_VERDICTS] = {"fine", "not so", "too little", "none"};
    return names[verdict];
}

size_t stability_run(const method_family_row *family, unsigned cases, stability_result *results) {
    size_t count = 0;
    for (size_t i = 0; i < *family->method_count; i++)
        for (size_t k = 0; k < family->case_count; k++) {
            if ((cases >> k & 1) == 0 || !method_speaks(&family->methods[i], k))
                continue;
            stability_result *r = &results[count];
            *r = (stability_result){.row = &family->methods[i],
                                    .which = k,
                                    .steps = 4,
                                    .inside = next_number(),
                                    .claim = count % 5 == 3 ? NAN : next_number(),
                                    .inside_near = next_number(),
                                    .inside_far = next_number(),
                                    .inside_at = next_number(),
                                    .claim_to = count % 5 == 3 ? NAN : next_number(),
                                    .breaks = count % 3 == 0 ? INFINITY : next_number(),
                                    .lost = count % 3 == 1 ? INFINITY : next_number(),
                                    .cause = count % 3 == 1   ? NULL
                                             : count % 3 == 0 ? "cracks"
                                                              : "sleep",
                                    .oblique = count % 4 == 1 ? NAN : next_number(),
                                    .log = count % 4 == 2 ? NAN : next_number(),
                                    .subnormal = count % 4 == 3 ? NAN : next_number(),
                                    .infinite = count % 3 == 1 ? NAN : next_number(),
                                    .ortho = count % 3 == 2 ? NAN : next_number(),
                                    .verdict = verdicts[count]};
            for (int s = 0; s < r->steps; s++) {
                r->ratio[s] = 10 * pow(1000, s);
                r->error[s] = s == 2 && count == 1 ? INFINITY : next_number();
            }
            walked[count++] = *r;
        }
    return walked_count = count;
}

/* A command of this program, its output from the file that it writes. */
static char *command_output(int (*command)(void *request), int status, const char *line) {
    static char words[256], file[512];
    char *argv[24];
    int argc = 0;
    asked_line o;
    snprintf(words, sizeof words, "depthprec %s", line);
    snprintf(file, sizeof file, "%s", scratch_file("output"));
    for (char *word = strtok(words, " "); word != NULL; word = strtok(NULL, " "))
        argv[argc++] = word;
    argv[argc++] = "-o";
    argv[argc++] = file;
    argv[argc] = NULL;
    remove(file);
    assert_int_equal(options_parse(&o, argc, argv), EXIT_FINE);
    assert_int_equal(command(o.request), status);
    options_release(&o);
    return text_of_file(file);
}

#endif
