/* SPDX-License-Identifier: GPL-3.0-or-later */
/* check: the requirements of files, judged: exit 1 with the depth at which one fails. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/option/names.h"
#include "cli/progress.h"
#include "solve/cmd_check/check_report.h"
#include "solve/cmd_check/request.h"
#include "zfight/census.h"

int check_read(const char *path, need_file *file) {
    need_error e;
    char where[32] = "", text[NAMES_SIZE];
    if (need_read(path, file, &e))
        return EXIT_FINE;
    const name_list known = {.words = (const char *const[]){e.known, NULL}};
    if (e.line > 0)
        snprintf(where, sizeof where, ":%d", e.line);
    const int status = usage_error("%s%s: %s%s", path, where, e.text, names_nearest(&known, "", e.given, 2, text));
    return e.unreadable ? EXIT_IO : status;
}

/* The census tells how many depths it has done; a census of some seconds shows a bar. */
static int advance(void *context, uint64_t done) {
    progress_step(context, done);
    return 0;
}

/* A check_counter that runs a census or a sample; context is the options. */
static bool count_ties(void *context, const dp_setup *setup, double lo, double hi, bool sample, double *share,
                       double *z) {
    const checks_request *o = context;
    census_result *result = malloc(sizeof *result);
    if (result == NULL)
        return false;
    progress bar = progress_start("depths", sample ? (uint64_t)CHECK_SAMPLE : census_count(lo, hi), o->out.quiet);
    census_sample_request request = {
        .common = {.setup = setup, .lo = lo, .hi = hi, .threads = o->out.threads, .progress = advance, .context = &bar},
        .count = CHECK_SAMPLE,
        .seed = CHECK_SEED};
    const census_status status = sample ? census_sample(&request, result) : census_run(&request.common, result);
    progress_end(&bar);
    double worst = -1.0;
    *share = 0.0;
    *z = lo;
    for (int i = 0; status == CENSUS_DONE && i < result->band_count; i++) {
        const census_band *b = &result->bands[i];
        const double of_band = b->pairs > 0 ? (double)(b->ties + b->swaps) / (double)b->pairs : 0.0;
        if (of_band > worst) {
            worst = of_band;
            *z = b->lo;
        }
    }
    if (status == CENSUS_DONE && result->all.pairs > 0)
        *share = (double)(result->all.ties + result->all.swaps) / (double)result->all.pairs;
    free(result);
    return status == CENSUS_DONE || status == CENSUS_RANGE; /* a range of one depth has no pair to tie */
}

static int check_cameras(const checks_request *o, check_file *f) {
    const check_request request = {.file = &f->file, .count = count_ties, .context = (void *)(uintptr_t)o};
    f->count = check_count(&f->file);
    f->verdicts = calloc(f->count, sizeof *f->verdicts);
    if (f->verdicts == NULL)
        return usage_error("%s: no memory for %zu verdicts", f->file.path, f->count);
    f->failed = check_all(&request, f->verdicts);
    if (f->failed < 0)
        return usage_error("%s: no memory to count ties", f->file.path);
    return EXIT_FINE;
}

static int judge_all(const checks_request *o, check_file *files, size_t count, long *failed) {
    int status = EXIT_FINE;
    for (size_t i = 0; i < count && status == EXIT_FINE; i++) /* a mistake in the last file is told at once */
        status = check_read(o->line->operands[i], &files[i].file);
    for (size_t i = 0; i < count && status == EXIT_FINE; i++) {
        status = check_cameras(o, &files[i]);
        *failed += files[i].failed;
    }
    return status;
}

int cmd_check(void *request) {
    const checks_request *o = request;
    const size_t count = (size_t)o->line->operand_count;
    long failed = 0;
    output out;
    if (o->out.report != REPORT_TEXT && o->out.form != FORM_TEXT)
        return option_error("report", "conflicts with --json or --csv");
    int status = output_start(&o->out, NULL, &out);
    if (status != EXIT_FINE)
        return status;
    check_file *files = calloc(count, sizeof *files);
    if (files == NULL)
        status = usage_error("no memory for %zu files", count);
    if (status == EXIT_FINE)
        status = judge_all(o, files, count, &failed);
    if (status == EXIT_FINE) {
        check_report(o, &out, files, count, failed == 0);
        status = output_close(&out);
        if (failed > 0 && o->out.file != NULL && strcmp(o->out.file, "-") != 0)
            check_say_failures(o, files, count);
    } else {
        output_abandon(&out);
    }
    for (size_t i = 0; i < count && files != NULL; i++) {
        need_release(&files[i].file);
        free(files[i].verdicts);
    }
    free(files);
    return status == EXIT_FINE && failed > 0 ? EXIT_FAILED : status;
}
