/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "method/cmd_methods/mine.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "code/code.h"
#include "method/cmd_methods/request.h"

/* The values of a function for the windows of a camera. */
typedef struct seen {
    double znear, zfar;
    size_t inputs;
    const float *values;
    float *block; /* of several, to be freed */
} seen;

enum { SEEN_MOST = 4 * STABILITY_STEPS_MAX + 32 };

/* ---- Values ------------------------------------------------------------------------------------------------------ */

static const seen *find(const mine_row *f, const dp_setup *setup, size_t inputs) {
    for (const seen *s = f->seen; s < f->seen + f->seen_count; s++)
        if (s->znear == setup->spec.znear && s->zfar == setup->spec.zfar && s->inputs == inputs)
            return s;
    return NULL;
}

/* Runs the function for cameras not yet seen; one that is given no camera runs for the chart's alone. */
static void expect(const method_row *row, const dp_setup *cameras, size_t count, size_t inputs) {
    mine_row *f = row->own;
    dp_setup fresh[SEEN_MOST];
    size_t n = 0;
    for (size_t i = 0; i < count && f->seen_count + n < SEEN_MOST; i++)
        if ((f->code.camera || inputs == f->of->family.inputs) && find(f, &cameras[i], inputs) == NULL)
            fresh[n++] = cameras[i];
    if (n == 0 || f->of->status != EXIT_FINE)
        return;
    float *in = malloc(n * inputs * sizeof *in), *values = malloc(n * inputs * sizeof *values);
    for (size_t i = 0; i < n && in != NULL; i++)
        f->of->family.fill(&fresh[i], &(method_inputs){.count = inputs, .d = in + i * inputs});
    f->of->status =
        in != NULL && values != NULL ? shader_values(&f->code, fresh, n, in, inputs, values) : usage_error("no memory");
    for (size_t i = 0; i < n; i++)
        f->seen[f->seen_count++] =
            (seen){fresh[i].spec.znear, fresh[i].spec.zfar, inputs, values + i * inputs, i == 0 ? values : NULL};
    free(in);
}

/* As the eye depth that it stands for in what it is judged to give, else as one. What gives none is not measured. */
static void run(const method_call *c) {
    const mine_row *f = c->row->own;
    const judgement *j = &f->judged;
    const bool known = j->named && j->found.trap == NULL;
    const judge_output *gives = known ? j->found.output : judge_output_get(0);
    expect(c->row, c->setup, 1, c->in->count);
    const seen *s = find(f, c->setup, c->in->count);
    const bool good = s != NULL && f->of->status == EXIT_FINE && gives->eye != NULL &&
                      !(known && j->found.input == judge_input_get(JUDGE_EYE));
    for (size_t i = 0; i < c->in->count; i++) {
        c->out->eye[i] = good ? 0 : (float)NAN;
        c->out->value[i] = good ? gives->eye(c->setup, (double)s->values[i]) : 0;
    }
}

/* The code of each depth, which the device gave as a number; a number that is none is no code. */
static void run_codes(const method_call *c) {
    const mine_row *f = c->row->own;
    expect(c->row, c->setup, 1, c->in->count);
    const seen *s = find(f, c->setup, c->in->count);
    for (size_t i = 0; i < c->in->count; i++) {
        const double code = s != NULL && f->of->status == EXIT_FINE ? (double)s->values[i] : -1;
        c->out->code[i] = code >= 0 && code <= (double)UINT32_MAX ? (uint32_t)code : UINT32_MAX;
    }
}

/* ---- Rows -------------------------------------------------------------------------------------------------------- */

/* The function's, or all that was typed where another has that name. In figures, which have no room for more, with what
 * it is judged to be. */
static void name_it(mine *m, mine_row *f, method_row *row) {
    const char *colon = strrchr(f->operand, ':'), *slash = strrchr(f->operand, '/');
    const char *name = colon != NULL ? colon + 1 : slash != NULL ? slash + 1 : f->operand;
    const bool told = m->o->line->command != &command_methods && f->judged.verdict != JUDGE_RIGHT;
    for (size_t i = 0; i < m->count; i++)
        if (strcmp(m->rows[i].name, name) == 0)
            name = f->operand;
    snprintf(f->name, sizeof f->name, told ? "%s (%s)" : "%s", name, judge_verdict_name(f->judged.verdict));
    row->name = f->name;
}

static int open_ours(mine *m, const method_row *row, bool on_device) {
    static const char number[] = "float code_number(float d) { return float(depth_code(d)); }\n";
    static output text; /* short: it never leaves its buffer */
    const bool codes = row->family == METHOD_ENCODE;
    const code_language *glsl = code_language_get(0);
    mine_row *f = &m->more[m->count];
    const bool has = code_lacks(glsl, row, &m->setup) == NULL;
    if (has || !on_device)
        m->rows[m->count++] = *row;
    if (!has)
        return EXIT_FINE;
    if (on_device) {
        method_row *here = &m->rows[m->count - 1];
        here->own = f;
        here->run = codes ? run_codes : run;
        here->known = code_bound(glsl, row, &m->setup);
    }
    text.used = 0;
    code_function(&text, glsl, row, &m->setup, false);
    if (codes)
        output_text(&text, number);
    text.buffer[text.used] = '\0';
    return shader_write(m->o, &m->setup, text.buffer, codes ? "code_number" : "eye_depth", on_device, &f->code);
}

static int open_mine(mine *m, const char *operand, size_t which) {
    mine_row *f = &m->more[m->count];
    method_row *row = &m->rows[m->count];
    judge_pairs pairs = {0};
    f->operand = operand;
    int status = shader_open(m->o, &m->setup, operand, true, &f->code);
    if (status == EXIT_FINE)
        status = shader_judge(&f->code, &m->setup, 1, false, &pairs, &f->judged);
    judge_pairs_free(&pairs);
    *row = (method_row){.family = METHOD_LINEARIZE,
                        .own = f,
                        .run = run,
                        .expect = expect,
                        .known = (double)NAN,
                        .asked = option_given(m->o->line, "tolerance") ? m->o->camera.tolerance : 0.5};
    row->claims[which] = (method_claim)UNCLAIMED;
    name_it(m, f, row);
    m->count++;
    return status;
}

/* Times the functions: a row shows the time on its own machine, the least, because what disturbs a driver that shares
 * its processor with others makes it slower alone. */
static int time_all(mine *m, bool on_device) {
    shader *all[BENCH_METHODS_MAX + 1];
    double ns[BENCH_METHODS_MAX + 1][COMPUTE_TIMES];
    size_t n = 0;
    for (size_t i = 0; i <= m->count; i++)
        if (m->more[i].code.text != NULL)
            all[n++] = &m->more[i].code;
    const int status = shader_times(all, n, ns);
    for (size_t i = m->count + 1; i-- > 0 && status == EXIT_FINE;) {
        const bench_times times =
            m->more[i].code.text != NULL ? bench_statistics(ns[--n], COMPUTE_TIMES) : (bench_times){(double)NAN, 0};
        m->more[i].ns = times.least;
        if (i < m->count && m->rows[i].own != NULL) {
            m->rows[i].cost = on_device ? times.least : (double)NAN;
            m->rows[i].spread = times.spread;
        }
    }
    return status;
}

int mine_open(const judge_request *o, methods_asked *asked, bool on_device, mine **out) {
    mine *m = *out = calloc(1, sizeof *m);
    int status = m != NULL ? EXIT_FINE : usage_error("no memory");
    if (status != EXIT_FINE)
        return status;
    m->o = o;
    m->setup = asked->setup;
    m->family = *asked->family;
    const method_family_row *ours = asked->family;
    for (size_t i = 0; i <= BENCH_METHODS_MAX && status == EXIT_FINE; i++) {
        m->more[i].of = m;
        m->more[i].seen = calloc(SEEN_MOST, sizeof(seen));
        status = m->more[i].seen != NULL ? EXIT_FINE : usage_error("no memory");
    }
    for (size_t i = 0; i < *ours->method_count && status == EXIT_FINE; i++)
        status = open_ours(m, &ours->methods[i], on_device);
    for (size_t i = 0; i < o->judge.mine_count && status == EXIT_FINE; i++)
        status = open_mine(m, o->judge.mine[i], asked->which);
    if (status == EXIT_FINE)
        status =
            shader_write(o, &m->setup, "float loop(float d) { return d; }", "loop", false, &m->more[m->count].code);
    if (status == EXIT_FINE)
        status = time_all(m, on_device);
    m->family.methods = m->rows;
    m->family.method_count = &m->count;
    asked->family = &m->family;
    return status;
}

const char *mine_device(const mine *m) {
    return m->more[m->count].code.device; /* the loop is timed last */
}

void mine_close(mine *m) {
    for (mine_row *f = m != NULL ? m->more : NULL; f != NULL && f <= &m->more[BENCH_METHODS_MAX]; f++) {
        for (size_t k = 0; k < f->seen_count; k++)
            free(f->seen[k].block);
        free(f->seen);
        shader_close(&f->code);
    }
    free(m);
}
