/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The browser's GPU in place of probe/vulkan.c: what to draw comes from the probe's plan, what was stored goes to its
 * judges; and functions of a shader's source. gpu.js is the other side.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/bits.h"
#include "judge/cmd_judge/shader.h"
#include "probe/compute.h"
#include "probe/judge.h"
#include "probe/spirv.h"
#include "system/sandbox.h"
#include "web/gpu.h"
#include "web/page.h"

enum { MOST = 1 << 20 };

/** Does what is asked. @return 0; else `text` says why not */
PAGE_IMPORT("gpu") int page_gpu(gpu_request *r);

const char *const gpu_formats[SHOT_FORMATS] = {"DEPTH_COMPONENT16", "DEPTH_COMPONENT24", "DEPTH_COMPONENT32F"};

bool gpu_ask(gpu_request *r, char text[GPU_TEXT_SIZE]) {
    r->text = text;
    snprintf(text, GPU_TEXT_SIZE, "the page has no GPU here");
    return page_gpu(r) == 0;
}

/* ---- The probe --------------------------------------------------------------------------------------------------- */

static bool spreads; /* clip z is from -w to w */

static bool describe(shot_machine *m, char *text) {
    shot_device *d = &m->device[0];
    gpu_request r = {.what = GPU_OPEN};
    if (!gpu_ask(&r, text))
        return false;
    spreads = r.passed != 0;
    const size_t length = strcspn(text, "\n");
    *d = (shot_device){.subpixel_bits = (int)r.count, .api = "WebGL 2"};
    snprintf(d->name, sizeof d->name, "%.*s", (int)length, text);
    snprintf(d->driver, sizeof d->driver, "%s", text + length + 1);
    for (int f = 0; f < SHOT_FORMATS; f++)
        snprintf(d->format[f], sizeof d->format[f], "%s", gpu_formats[f]);
    m->count = 1;
    m->counts = true;
    return true;
}

static bool draw(shot *s, char *text) {
    gpu_request r = {.what = GPU_DRAW,
                     .source = probe_glsl,
                     .a = s->a,
                     .b = s->b,
                     .format = s->format,
                     .program = s->program,
                     .other = s->other,
                     .triangles = s->triangles,
                     .constant = s->constant,
                     .slope = s->slope,
                     .count = s->count,
                     .in = s->vertex,
                     .second = s->second,
                     .out = s->code};
    s->drawn = gpu_ask(&r, text);
    s->passed = r.passed;
    return s->drawn;
}

/* Clip z from -w to w, of a browser that has no other; what that makes too coarse to tell is not drawn. */
static void spread(shot *s) {
    const double scale = plan_scale(s->format);
    s->ndc_signed = true;
    s->a = 2.0F * s->a - 1.0F;
    s->b *= 2.0F;
    for (uint32_t i = 0; i < s->count; i++) {
        float *v = s->vertex[i], *second = s->again ? s->second[i] : v;
        v[2] = s->program == SHOT_PASS ? 2.0F * v[2] - v[3] : v[2];
        if (s->again && s->program == SHOT_PASS) {
            memcpy(second, v, sizeof *s->second);
            second[2] = nextafterf(v[2], 1.0F);
            if (rint((double)judge_clip(s, v) * scale) != rint((double)judge_clip(s, second) * scale))
                second[2] = v[2]; /* another code */
        }
    }
}

/* Whether a buffer that was asked to hold codes gives back what was drawn, bit for bit. */
static bool is_real(const shot *s) {
    bool same = s->again && plan_scale(s->format) > 0.0;
    for (uint32_t i = 0; same && i < s->count; i++)
        same = s->code[i] == dp_bits32(judge_clip(s, s->vertex[i]));
    return same;
}

/* The codes whose numbers a texture gives: the nearest one, other numbers for other codes in 24 bits, too. */
static void find_codes(shot *s) {
    const double scale = plan_scale(s->format);
    for (int i = 0; i < SHOT_PIXELS && scale > 0.0; i++)
        s->code[i] = (uint32_t)rint((double)dp_float32(s->code[i]) * scale);
}

bool probe_run(const char *device, uint64_t seed, probe_result *r, char error[SHOT_ERROR_SIZE]) {
    bool real[SHOT_FORMATS] = {false};
    char text[GPU_TEXT_SIZE] = "there is no memory for it";
    (void)device;
    *r = (probe_result){0};
    bool good = plan_make(&r->plan, seed) && describe(&r->machine, text);
    for (size_t i = 0; good && i < r->plan.count; i++) {
        shot *s = &r->plan.shot[i];
        if (real[s->format] || (spreads && (s->program >= SHOT_LOG2 || strcmp(s->name, "planes") == 0)))
            continue; /* what it is is drawn as such */
        if (spreads)
            spread(s);
        good = draw(s, text);
        real[s->format] = is_real(s);
        if (!real[s->format])
            find_codes(s);
    }
    if (good)
        probe_judge(r);
    snprintf(error, SHOT_ERROR_SIZE, "%.*s", SHOT_ERROR_SIZE - 1, text);
    return good;
}

void probe_free(probe_result *r) {
    plan_free(&r->plan);
}

/* ---- Functions --------------------------------------------------------------------------------------------------- */

/* The operand is the source itself: no file is in the page. */
int shader_open(const judge_request *o, const dp_setup *setup, const char *operand, bool timed, shader *out) {
    char text[GPU_TEXT_SIZE];
    gpu_request r = {
        .what = GPU_COMPILE, .source = operand, .a = (float)setup->spec.znear, .b = (float)setup->spec.zfar};
    (void)timed;
    *out = (shader){.o = o, .run = calloc(1, sizeof(compute_run)), .most = MOST};
    if (out->run == NULL || !gpu_ask(&r, text))
        return usage_error("judge: %s", text);
    snprintf(out->defines, sizeof out->defines, "%s", text);
    out->camera = text[0] != '\0';
    return EXIT_FINE;
}

void shader_close(shader *s) {
    free(s->run);
}

bool compute_values(const char *device, const compute_run *run, size_t runs, shot_machine *machine, FILE **values,
                    bool *endless, char error[COMPUTE_ERROR_SIZE]) {
    static float *all;
    (void)device, (void)runs;
    *endless = false;
    free(all);
    all = malloc(run->count * sizeof *all);
    for (uint64_t i = 0; all != NULL && i < run->count; i++)
        all[i] = run->depth(run->of, i);
    gpu_request r = {.what = GPU_VALUES, .count = (uint32_t)run->count, .in = all, .out = (uint32_t *)(void *)all};
    if (all == NULL || !describe(machine, error) || !gpu_ask(&r, error))
        return false;
    *values = fmemopen(all, run->count * sizeof *all, "r");
    return *values != NULL;
}

void sandbox_close(FILE *made) {
    if (made != NULL)
        fclose(made);
}
