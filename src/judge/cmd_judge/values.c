/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The values of a function for depths, few and all. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/elementary.h"
#include "judge/cmd_judge/request.h"
#include "judge/cmd_judge/shader.h"
#include "judge/written.h"
#include "probe/compute.h"
#include "report/number.h"
#include "system/sandbox.h"

enum { PORTION = 1 << 20, ASKED = 512, FACTOR_DIGITS = 6 };

/* ---- Running ----------------------------------------------------------------------------------------------------- */

static int fail_io(const shader *s, const char *error) {
    usage_error("%s: %s", s->o->line->command->name, error);
    return EXIT_IO;
}

static int damaged(const shader *s) {
    return fail_io(s, "what the driver made is damaged");
}

/* A processor's times are none of a GPU. */
static void name_device(shader *s, const shot_machine *machine) {
    const shot_device *d = &machine->device[machine->chosen];
    snprintf(s->device, sizeof s->device, "%s; %s%s", d->name, d->driver, d->software ? "; in software" : "");
}

static int start(shader *s, FILE **values) {
    shot_machine machine = {0};
    char error[COMPUTE_ERROR_SIZE];
    const bool few = s->device[0] == '\0'; /* the first time */
    if (!compute_values(s->o->judge.device, s->run, 0, &machine, values, &s->too_long, error))
        return s->too_long && !few ? EXIT_FINE : fail_io(s, error);
    name_device(s, &machine);
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
    return damaged(s);
}

/* Depths in, so many of each kind: pairs of each kind, without NaN. */
static int shader_pairs(shader *s, const float *in, size_t count, size_t kinds, judge_pairs out[]) {
    compute_run *run = s->run;
    FILE *values = NULL;
    s->count = count;
    run->count = kinds * count;
    run->depth = listed;
    run->of = in;
    int status = start(s, &values);
    for (size_t k = 0; k < kinds && status == EXIT_FINE; k++) {
        out[k] = (judge_pairs){.nan_at = (double)NAN, .pairs = malloc(count * sizeof *out->pairs)};
        status = out[k].pairs != NULL ? run_pairs(s, k * count, count, values, &out[k]) : EXIT_IO;
        judge_pairs_look(&out[k]);
    }
    sandbox_close(values);
    return status;
}

double shader_asked(unsigned i, unsigned count) {
    const unsigned ends = count < 48 ? count / 3 : 16, k = i / 2 + 1;
    const double even = (double)(i - 2 * ends) / (count - 2 * ends - 1);
    return (double)(float)(i >= 2 * ends ? even : i % 2 == 0 ? ldexp(1, -(int)k) : 1 - ldexp(1, -(int)k - 1));
}

/* Window depths, eye depths and view z go in. Nobody is accused by what they do not take: the first that is right
 * counts, else the first that has a name, else what is right but at an end, where packed depths wrap: all depths will
 * show it. */
static int ask(shader *s, const dp_setup *asked, size_t count, judge_open open, judge_pairs *out, judgement *best) {
    static const size_t kinds[] = {JUDGE_WINDOW, JUDGE_EYE, JUDGE_VIEW};
    enum { KINDS = sizeof kinds / sizeof kinds[0] };
    const dp_spec *spec = &asked[0].spec;
    const double far = isinf(spec->zfar) ? 1e6 * spec->znear : spec->zfar;
    judge_pairs pairs[KINDS] = {{0}};
    float depth[KINDS * ASKED];
    size_t of = 0;
    for (unsigned i = 0; i < KINDS * ASKED; i++) {
        const double metric = judge_input_get(kinds[i / ASKED])->metric, t = shader_asked(i % ASKED, ASKED);
        depth[i] = (float)(metric != 0 ? metric * fmin(far, spec->znear + (far - spec->znear) * t * t * t) : t);
    }
    const size_t tried = open == JUDGE_OPEN ? 1 : KINDS;
    const int status = shader_pairs(s, depth, ASKED, tried, pairs);
    for (size_t i = 0; i < 2 * tried && status == EXIT_FINE && !(i >= tried && best->named); i++) {
        const bool inside = i >= tried && pairs[i % tried].count > 2;
        judge_pairs p = pairs[i % tried];
        judgement found;
        p.pairs += inside;
        p.count -= inside ? 2 : 0;
        judge_function(&p, asked, count, open, &found);
        if (i == 0 || (found.named && !best->named && !inside) ||
            (found.verdict == JUDGE_RIGHT && best->verdict != JUDGE_RIGHT)) {
            *best = found;
            of = i % tried;
        }
    }
    for (size_t k = 0; k < KINDS; k++)
        if (k != of)
            judge_pairs_free(&pairs[k]);
    *out = pairs[of];
    return status;
}

/* Nothing is told of what hangs on a macro that nobody defines. */
static void excuse(const shader *s, judgement *out) {
    if (s->open[0] != '\0' && (out->verdict == JUDGE_OTHER || out->verdict == JUDGE_WRONG)) {
        out->verdict = JUDGE_UNKNOWN;
        out->because = s->open;
    }
}

int shader_judge(shader *s, const dp_setup *asked, size_t count, judge_open open, judge_pairs *pairs, judgement *out) {
    const int status = ask(s, asked, count, s->camera ? JUDGE_OPEN_NONE : open, pairs, out);
    if (status == EXIT_FINE)
        excuse(s, out);
    return status;
}

void shader_say(const judge_request *o, const judge_candidate *c, char out[SETUP_LABEL_SIZE]) {
    const dp_spec *s = &c->setup.spec;
    const bool planes = c->output->planes != JUDGE_PLANES_NONE || c->input->window == NULL || c->output->window == NULL;
    int used = snprintf(out, SETUP_LABEL_SIZE, "%s%s%s", c->trap != NULL ? c->trap->name : "",
                        c->trap != NULL ? ", as " : "", c->output->name);
    if (c->factor != 1)
        used += snprintf(out + used, SETUP_LABEL_SIZE - (size_t)used, " times %s,",
                         number_of(c->factor, FACTOR_DIGITS).text);
    used += snprintf(out + used, SETUP_LABEL_SIZE - (size_t)used, " from %s", c->input->name);
    used += snprintf(out + used, SETUP_LABEL_SIZE - (size_t)used, ": %s%s", dp_mapping_get(s->mapping)->name,
                     s->ortho ? ", orthographic" : "");
    if (planes)
        snprintf(out + used, SETUP_LABEL_SIZE - (size_t)used, ", near %s, far %s",
                 number_in(number_full(s->znear), camera_unit(&o->camera)).text,
                 number_in(number_full(s->zfar), camera_unit(&o->camera)).text);
}

/* ---- In the chart ------------------------------------------------------------------------------------------------ */

int shader_values(shader *s, const dp_setup *cameras, size_t count, const float *in, size_t each, float *out) {
    compute_run *run = s->run;
    float(*constants)[COMPUTE_CONSTANTS] = calloc(count, sizeof *constants);
    char error[COMPUTE_ERROR_SIZE];
    FILE *values = NULL;
    int status = constants != NULL ? EXIT_FINE : EXIT_IO;
    for (size_t i = 0; i < count && status == EXIT_FINE; i++) {
        const judge_asked *j = &s->o->judge;
        written w = {0};
        if (s->camera &&
            written_make(s->text, s->function, s->hlsl, &cameras[i], j->defines, j->define_count, 0, &w, error))
            memcpy(constants[i], w.constants, sizeof w.constants);
        else
            memcpy(constants[i], run->constants, sizeof run->constants);
        free(w.text);
    }
    run->count = count * each;
    run->each = each;
    run->cameras = (const float(*)[COMPUTE_CONSTANTS])constants;
    run->depth = listed;
    run->of = in;
    if (status == EXIT_FINE)
        status = start(s, &values);
    if (status == EXIT_FINE && (values == NULL || fread(out, sizeof *out, run->count, values) != run->count))
        status = damaged(s); /* or did not come to an end, with some camera */
    sandbox_close(values);
    free(constants);
    run->each = 0;
    run->cameras = NULL;
    return status;
}

int shader_times(shader *const *all, size_t count, double (*out)[COMPUTE_TIMES]) {
    const judge_request *o = all[0]->o;
    compute_run runs[COMPUTE_TIMED_MOST] = {{0}};
    shot_machine machine = {0};
    char error[COMPUTE_ERROR_SIZE];
    FILE *times = NULL;
    bool endless, good = true;
    for (size_t i = 0; i < count; i++)
        runs[i] = *(const compute_run *)all[i]->timed;
    if (!compute_values(o->judge.device, runs, count, &machine, &times, &endless, error))
        return fail_io(all[0], error);
    for (size_t k = 0; k < COMPUTE_TIMES * count && good; k++)
        good = fread(&out[k % count][k / count], sizeof out[0][0], 1, times) == 1;
    sandbox_close(times);
    name_device(all[count - 1], &machine);
    return good ? EXIT_FINE : damaged(all[0]);
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
    if (a->c->input->metric != 0) {
        const double n = spec->znear, z = isinf(spec->zfar) ? 1e6 * n : spec->zfar;
        const double t = (double)i / (double)(a->count - 1);
        return (float)(a->c->input->metric * (spec->ortho ? n + (z - n) * t : n * dp_pow(z / n, t)));
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
