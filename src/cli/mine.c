/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/mine.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "code/code.h"

enum { SEEN_MOST = 4 * STABILITY_STEPS_MAX + 32 };

/* What a function gave for the windows of a camera. */
typedef struct seen {
    double znear, zfar;
    size_t inputs;
    const float *values;
    float *block; /* of several, to be freed */
} seen;

typedef struct function {
    mine *of;
    const char *operand;
    shader code;
    judgement found;
    bench_times time;
    seen seen[SEEN_MOST];
    size_t count;
} function;

/* The last function is the loop alone. */
struct mine {
    const options *o;
    dp_setup setup;
    bool on_device;
    int status;
    method_family_row family;
    method_row rows[BENCH_METHODS_MAX];
    function functions[BENCH_METHODS_MAX + 1];
    size_t count;
};

/* ---- Values ------------------------------------------------------------------------------------------------------ */

static const seen *find(const function *f, const dp_setup *setup, size_t inputs) {
    for (size_t i = 0; i < f->count; i++)
        if (f->seen[i].znear == setup->spec.znear && f->seen[i].zfar == setup->spec.zfar && f->seen[i].inputs == inputs)
            return &f->seen[i];
    return NULL;
}

/* What is given nothing of a camera is not asked about others. */
static bool is_asked(const function *f, const dp_setup *setup) {
    const dp_spec *own = &f->of->setup.spec;
    return f->code.camera || (setup->spec.znear == own->znear && setup->spec.zfar == own->zfar);
}

static void expect(const method_row *row, const dp_setup *cameras, size_t count, size_t inputs) {
    function *f = row->own;
    dp_setup fresh[SEEN_MOST];
    size_t n = 0;
    for (size_t i = 0; i < count && f->count + n < SEEN_MOST; i++)
        if (is_asked(f, &cameras[i]) && find(f, &cameras[i], inputs) == NULL)
            fresh[n++] = cameras[i];
    if (n == 0 || f->of->status != EXIT_FINE)
        return;
    float *in = malloc(n * inputs * sizeof *in), *values = malloc(n * inputs * sizeof *values);
    for (size_t i = 0; i < n && in != NULL; i++)
        linearize_family.fill(&fresh[i], &(method_inputs){.count = inputs, .d = in + i * inputs});
    f->of->status =
        in != NULL && values != NULL ? shader_values(&f->code, fresh, n, in, inputs, values) : usage_error("no memory");
    for (size_t i = 0; i < n; i++)
        f->seen[f->count++] =
            (seen){fresh[i].spec.znear, fresh[i].spec.zfar, inputs, values + i * inputs, i == 0 ? values : NULL};
    free(in);
}

/* What it is judged to give; as eye depth where that is not known. */
static const judge_output *gives(const function *f) {
    const judgement *j = &f->found;
    return j->named && j->found.trap == NULL ? j->found.output : judge_output_get(0);
}

static bool is_measured(const function *f) {
    const judgement *j = &f->found;
    return gives(f)->eye != NULL && !(j->named && j->found.input == judge_input_get(JUDGE_EYE));
}

static void run(const method_call *c) {
    function *f = c->row->own;
    expect(c->row, c->setup, 1, c->in->count);
    const seen *s = find(f, c->setup, c->in->count);
    for (size_t i = 0; i < c->in->count; i++)
        c->out->value[i] = s != NULL && f->of->status == EXIT_FINE && is_measured(f)
                               ? gives(f)->eye(c->setup, (double)s->values[i])
                               : (double)NAN;
}

/* ---- Rows -------------------------------------------------------------------------------------------------------- */

static const char *name_of(const mine *m, const char *operand) {
    const char *colon = strrchr(operand, ':'), *slash = strrchr(operand, '/');
    const char *name = colon != NULL ? colon + 1 : slash != NULL ? slash + 1 : operand;
    for (size_t i = 0; i < m->count; i++)
        if (strcmp(m->rows[i].name, name) == 0)
            return operand;
    return name;
}

static int open_ours(mine *m, const method_row *row) {
    static output text; /* short: it never leaves its buffer */
    const code_language *glsl = code_language_get(0);
    function *f = &m->functions[m->count];
    const bool lacks = code_lacks(glsl, row, &m->setup) != NULL;
    if (lacks && m->on_device)
        return EXIT_FINE;
    m->rows[m->count++] = *row;
    if (lacks)
        return EXIT_FINE;
    text.used = 0;
    code_function(&text, glsl, row, &m->setup, false);
    text.buffer[text.used] = '\0';
    if (m->on_device) {
        m->rows[m->count - 1].own = f;
        m->rows[m->count - 1].run = run;
    }
    return shader_write(m->o, &m->setup, text.buffer, "eye_depth", true, &f->code);
}

static int open_mine(mine *m, const char *operand, size_t which) {
    function *f = &m->functions[m->count];
    judge_pairs pairs = {0};
    f->operand = operand;
    method_row row = {METHOD_LINEARIZE,
                      name_of(m, operand),
                      "",
                      .own = f,
                      .run = run,
                      .expect = expect,
                      .asked = option_given(m->o, OPTION_TOLERANCE) ? m->o->wanted.tolerance : 0.5};
    row.claims[which] = (method_claim)UNCLAIMED;
    m->rows[m->count++] = row;
    int status = shader_open(m->o, &m->setup, operand, true, &f->code);
    if (status == EXIT_FINE)
        status = shader_judge(&f->code, &m->setup, 1, false, &pairs, &f->found);
    shader_excuse(&f->code, &f->found);
    judge_pairs_free(&pairs);
    return status;
}

int mine_open(const options *o, methods_asked *asked, bool on_device, mine **out) {
    mine *m = *out = calloc(1, sizeof *m);
    int status = m != NULL ? EXIT_FINE : usage_error("no memory");
    if (status != EXIT_FINE)
        return status;
    m->o = o;
    m->setup = asked->setup;
    m->on_device = on_device;
    for (size_t i = 0; i <= BENCH_METHODS_MAX; i++)
        m->functions[i].of = m;
    for (size_t i = 0; i < *linearize_family.method_count && status == EXIT_FINE; i++)
        status = open_ours(m, &linearize_family.methods[i]);
    for (size_t i = 0; i < o->judge.mine_count && status == EXIT_FINE; i++)
        status = open_mine(m, o->judge.mine[i], asked->which);
    if (status == EXIT_FINE)
        status =
            shader_write(o, &m->setup, "float loop(float d) { return d; }", "loop", true, &m->functions[m->count].code);
    m->family = linearize_family;
    m->family.methods = m->rows;
    m->family.method_count = &m->count;
    asked->family = &m->family;
    return status;
}

/* ---- Times ------------------------------------------------------------------------------------------------------- */

static bool is_timed(const function *f) {
    return f->code.text != NULL;
}

static int time_all(mine *m) {
    shader *all[BENCH_METHODS_MAX + 1];
    bench_times times[BENCH_METHODS_MAX + 1];
    size_t n = 0;
    for (size_t i = 0; i <= m->count; i++)
        if (is_timed(&m->functions[i]))
            all[n++] = &m->functions[i].code;
    m->status = shader_times(all, n, times);
    for (size_t i = m->count + 1; i-- > 0;) {
        const bool timed = is_timed(&m->functions[i]) && m->status == EXIT_FINE;
        m->functions[i].time = timed ? times[--n] : (bench_times){(double)NAN, (double)NAN};
    }
    return m->status;
}

/* Nothing is said of what it is at another camera. */
static void forget_walk(stability_result *w) {
    for (int k = 0; k < w->steps; k++)
        w->error[k] = (double)NAN;
    w->inside = w->infinite = (double)NAN;
    w->breaks = (double)INFINITY;
}

int mine_end(mine *m, bench_result *results, stability_result *walked, size_t count) {
    if (m->status == EXIT_FINE)
        time_all(m);
    for (size_t i = 0; i < count; i++) {
        bench_result *r = &results[i];
        const function *f = r->row->own;
        if (m->on_device) {
            r->ns = mine_of(m, r->row).ns;
            r->spread = mine_of(m, r->row).spread;
            r->bound = r->row->bound != NULL ? code_bound(code_language_get(0), r->row, &m->setup) : (double)NAN;
        }
        if (f == NULL || f->operand == NULL)
            continue;
        if (walked != NULL && (!f->code.camera || !is_measured(f)))
            forget_walk(&walked[i]);
        if (walked != NULL)
            walked[i].claim = (double)NAN;
        if (!is_measured(f))
            r->measured.worst = (method_error){(double)NAN, (double)NAN, (double)NAN};
    }
    if (m->on_device)
        bench_mark_front(&m->family, results, count);
    return m->status;
}

int mine_status(const mine *m) {
    return m->status;
}

mine_row mine_of(const mine *m, const method_row *row) {
    const function *f = &m->functions[row - m->rows];
    return (mine_row){f->operand, f->operand != NULL ? &f->found : NULL, &f->code, f->time.median, f->time.spread};
}

const char *mine_device(const mine *m, double *loop) {
    *loop = m->functions[m->count].time.median;
    return m->functions[m->count - 1].code.device;
}

void mine_close(mine *m) {
    for (size_t i = 0; m != NULL && i <= BENCH_METHODS_MAX; i++) {
        function *f = &m->functions[i];
        for (size_t k = 0; k < f->count; k++)
            free(f->seen[k].block);
        shader_close(&f->code);
    }
    free(m);
}
