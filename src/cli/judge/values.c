/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a function gives for depths, few and all. */
#include <math.h>
#include <stdlib.h>

#include "cli/judge/shader.h"
#include "core/elementary.h"
#include "probe/compute.h"
#include "system/sandbox.h"

enum { PORTION = 1 << 20 };

/* ---- Running ----------------------------------------------------------------------------------------------------- */

static int start(shader *s, FILE **values) {
    shot_machine machine = {0};
    char error[COMPUTE_ERROR_SIZE];
    const bool few = s->device[0] == '\0'; /* the first time */
    if (!compute_values(s->o->probe.device, s->run, &machine, values, &s->too_long, error)) {
        if (s->too_long && !few)
            return EXIT_FINE;
        usage_error("judge: %s", error);
        return EXIT_IO;
    }
    const shot_device *d = &machine.device[machine.chosen];
    snprintf(s->device, sizeof s->device, "%s; %s", d->name, d->driver);
    return EXIT_FINE;
}

/* The next pairs of a run: false where the file ends before. */
static bool take(const compute_run *run, uint64_t from, size_t count, FILE *values, judge_pairs *out) {
    out->count = 0;
    for (size_t i = 0; i < count; i++) {
        const double in = (double)run->depth(run->of, from + i);
        float value;
        if (fread(&value, sizeof value, 1, values) != 1)
            return false;
        if (!isnan(value))
            out->pairs[out->count++] = (judge_pair){in, (double)value};
        else if (out->nan_count++ == 0)
            out->nan_at = in;
    }
    return true;
}

static float listed(const void *of, uint64_t i) {
    return ((const float *)of)[i];
}

static int run_pairs(shader *s, uint64_t from, size_t count, FILE *values, judge_pairs *out) {
    if (take(s->run, from, count, values, out))
        return EXIT_FINE;
    usage_error("judge: what the driver made is damaged");
    return EXIT_IO;
}

int shader_pairs(shader *s, const float *in, size_t count, judge_pairs *out) {
    compute_run *run = s->run;
    FILE *values = NULL;
    *out = (judge_pairs){.nan_at = (double)NAN, .pairs = malloc(count * sizeof *out->pairs)};
    run->count = s->count = count;
    run->depth = listed;
    run->of = in;
    int status = out->pairs != NULL ? start(s, &values) : EXIT_IO;
    if (values != NULL)
        status = run_pairs(s, 0, count, values, out);
    sandbox_close(values);
    judge_pairs_look(out);
    return status;
}

/* ---- All depths -------------------------------------------------------------------------------------------------- */

typedef struct all_depths {
    const judge_candidate *c;
    uint64_t count;
} all_depths;

/* Codes as even as they are, window depths of them; eye depths by their logarithm. */
static float one_of_all(const void *of, uint64_t i) {
    const all_depths *a = of;
    const dp_spec *spec = &a->c->setup.spec;
    const dp_format *f = &spec->format;
    if (a->c->input == judge_input_get(JUDGE_EYE)) {
        const double n = spec->znear, z = isinf(spec->zfar) ? 1e6 * n : spec->zfar;
        const double t = (double)i / (double)(a->count - 1);
        return (float)(spec->ortho ? n + (z - n) * t : n * dp_pow(z / n, t));
    }
    const uint32_t code = (uint32_t)(i * f->code_max / (a->count - 1));
    if (a->c->input == judge_input_get(JUDGE_CODES))
        return (float)code;
    const double d = dp_format_value(f, code);
    return (float)(a->c->input == judge_input_get(JUDGE_NDC) ? 2 * d - 1 : d);
}

int shader_all(shader *s, judge_pairs *pairs, judgement *out) {
    compute_run *run = s->run;
    const uint64_t codes = (uint64_t)out->found.setup.spec.format.code_max + 1;
    const judge_candidate found = out->found;
    const all_depths all = {&found, codes < s->most ? codes : s->most};
    judge_pairs portion = *pairs;
    FILE *values = NULL;
    run->count = all.count;
    run->depth = one_of_all;
    run->of = &all;
    portion.pairs = malloc(PORTION * sizeof *portion.pairs);
    portion.nan_count = 0;
    int status = portion.pairs != NULL ? start(s, &values) : EXIT_IO;
    for (uint64_t from = 0; values != NULL && from < all.count && status == EXIT_FINE; from += PORTION) {
        const uint64_t left = all.count - from;
        status = run_pairs(s, from, (size_t)(left < PORTION ? left : PORTION), values, &portion);
        judge_more(&portion, out);
    }
    if (values != NULL) {
        s->count = all.count;
        pairs->nan_count = portion.nan_count;
        pairs->nan_at = portion.nan_at;
    }
    sandbox_close(values);
    free(portion.pairs);
    return status;
}
