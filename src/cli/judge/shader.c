/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/judge/shader.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/elementary.h"
#include "judge/written.h"
#include "probe/compute.h"
#include "system/input.h"
#include "system/sandbox.h"

enum { FILE_MOST = 1 << 24, ALL_MOST = 1 << 26, PORTION = 1 << 20 };

/* ---- The file ---------------------------------------------------------------------------------------------------- */

/* Its bytes, and a 0 behind them. */
static int read_file(const char *path, char **out, size_t *size) {
    FILE *in = input_open(path);
    *out = in != NULL ? malloc(FILE_MOST + 1) : NULL;
    *size = *out != NULL ? fread(*out, 1, FILE_MOST, in) : 0;
    const bool good = *out != NULL && ferror(in) == 0 && feof(in) != 0;
    if (*out != NULL)
        (*out)[*size] = '\0';
    if (!good)
        usage_error("%s: %s", path, in == NULL || ferror(in) != 0 ? strerror(errno) : "does not fit into memory");
    if (in != NULL)
        input_close(in);
    return good ? EXIT_FINE : EXIT_IO;
}

static bool ends_with(const char *text, const char *ending) {
    const size_t length = strlen(text), end = strlen(ending);
    return length > end && strcmp(text + length - end, ending) == 0;
}

static bool is_hlsl(const char *path) {
    static const char *const endings[] = {".hlsl", ".hlsli", ".fx", ".cginc", ".usf", ".ush"};
    for (size_t i = 0; i < sizeof endings / sizeof endings[0]; i++)
        if (ends_with(path, endings[i]))
            return true;
    return false;
}

static int compile(shader *s, const dp_setup *setup, const char *path, const char *function, const char *text) {
    compute_run *run = s->run;
    written w = {0};
    char error[COMPUTE_ERROR_SIZE];
    unsigned line = 0;
    int status = EXIT_FINE;
    const options_judge *j = &s->o->judge;
    if (!written_make(text, function, is_hlsl(path), setup, j->defines, j->define_count, &w, error))
        status = usage_error("%s: %s %s", path, function, error);
    else if (!compute_compile(w.text, is_hlsl(path), run, &line, error) && (line == 0 || line > w.lines + 1))
        status = usage_error("%s: %s: %s", path, function, error);
    else if (run->code == NULL)
        status = usage_error("%s:%u: %s%s", path, line, error,
                             strstr(error, "undeclared") != NULL ? " (--define gives a uniform its value)" : "");
    memcpy(run->constants, w.constants, sizeof run->constants);
    snprintf(s->defines, sizeof s->defines, "%s", w.defines);
    if (w.open[0] != '\0')
        snprintf(s->open, sizeof s->open, "a condition asks for %s: --define %s=1 defines it, %s=0 does not", w.open,
                 w.open, w.open);
    s->camera = w.camera;
    free(w.text);
    return status;
}

int shader_open(const options *o, const dp_setup *setup, shader *out) {
    const char *operand = o->operands[0], *colon = strrchr(operand, ':');
    const bool spirv = ends_with(operand, ".spv");
    char *text = NULL, *path = strdup(operand), error[COMPUTE_ERROR_SIZE];
    compute_run *run = calloc(1, sizeof *run);
    *out = (shader){.o = o, .run = run};
    int status = run != NULL && path != NULL ? EXIT_FINE : EXIT_IO;
    if (status == EXIT_FINE && !spirv && (colon == NULL || colon == operand || colon[1] == '\0'))
        status = usage_error("judge: must be FILE:FUNCTION, or FILE.spv, got '%s'", operand);
    if (status == EXIT_FINE && spirv && o->judge.define_count > 0)
        status = option_error(OPTION_DEFINE, "is not for SPIR-V, which has its constants in it");
    if (status == EXIT_FINE && !spirv)
        path[colon - operand] = '\0';
    if (status == EXIT_FINE)
        status = read_file(path, &text, &run->size);
    if (status == EXIT_FINE && !spirv) {
        status = compile(out, setup, path, colon + 1, text);
    } else if (status == EXIT_FINE) {
        run->code = (uint32_t *)(void *)text;
        text = NULL;
        status = compute_look(run, error) ? EXIT_FINE : usage_error("%s: %s", path, error);
    }
    free(text);
    free(path);
    return status;
}

void shader_close(shader *s) {
    compute_run *run = s->run;
    if (run != NULL)
        free(run->code);
    free(run);
}

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

int shader_pairs(shader *s, const float *in, size_t count, size_t kinds, judge_pairs out[]) {
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
    const all_depths all = {&found, codes < ALL_MOST ? codes : ALL_MOST};
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
