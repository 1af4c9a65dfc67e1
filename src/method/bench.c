/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "method/bench.h"

#include <math.h>
#include <stdlib.h>
#include <time.h>

#include "method/bound.h"

/* How long one timing should last: long enough for the clock, short enough that the machine stays in one mood. */
static const double slice = 4e5; /* ns */
enum { REPETITIONS_MAX = 99 };

double measured_error(const method_family_row *family, const measured *m) {
    return family->steps ? m->worst.ulp : m->worst.relative;
}

static void keep(double value, size_t i, double *worst, size_t *at) {
    if (value > *worst || (isnan(value) && !isnan(*worst))) {
        *worst = value;
        *at = i;
    }
}

static void judge_all(const method_family_row *family, const method_call *call, measured *m) {
    *m = (measured){.worst = {-1, -1, -1}};
    for (size_t i = 0; i < call->in->count; i++) {
        method_error e;
        if (!family->judge(call, i, &e))
            continue;
        m->count++;
        keep(e.absolute, i, &m->worst.absolute, &m->absolute_at);
        keep(e.relative, i, &m->worst.relative, &m->relative_at);
        keep(e.ulp, i, &m->worst.ulp, &m->ulp_at);
    }
    if (m->count == 0)
        m->worst = (method_error){(double)NAN, (double)NAN, (double)NAN};
}

bool method_measure(const method_family_row *family, const method_row *row, const dp_setup *setup,
                    const method_inputs *in, const method_outputs *out, measured *m) {
    void *state = row->open != NULL ? row->open(setup) : NULL;
    if (row->open != NULL && state == NULL)
        return false;
    const method_call call = {row, setup, state, in, out};
    row->run(&call);
    if (row->open != NULL)
        row->close(state);
    judge_all(family, &call, m);
    return true;
}

double method_claimed(const method_row *row, size_t which, const dp_setup *setup) {
    const method_claim *c = &row->claims[which];
    double ratio = setup->spec.zfar / setup->spec.znear;
    bool covered = isinf(ratio) ? (row->domain & METHOD_INFINITE) != 0 && c->ratio_hi >= METHOD_RATIO_HI
                                : ratio >= c->ratio_lo && ratio <= c->ratio_hi * (1 + 1e-12);
    if (setup->spec.ortho)
        covered = covered && (row->domain & METHOD_ORTHO) != 0;
    return method_speaks(row, which) && covered ? method_claim_at(c, ratio) : (double)NAN;
}

double method_bound(const method_row *row, const dp_setup *setup) {
    if (row->own != NULL)
        return row->known;
    const bool covered = !isinf(setup->spec.zfar) || (row->domain & METHOD_INFINITE) != 0;
    return row->family == METHOD_LINEARIZE && row->bound != NULL && covered && !setup->spec.ortho
               ? bound_over(row->bound, setup, &bound_nearest)
               : (double)NAN;
}

/* ---- Times ------------------------------------------------------------------------------------------------------- */

static double now(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return 1e9 * (double)t.tv_sec + (double)t.tv_nsec;
}

static double once(method_run *run, const method_call *call, size_t rounds) {
    double start = now();
    for (size_t i = 0; i < rounds; i++)
        run(call);
    return (now() - start) / (double)rounds / (double)call->in->count;
}

typedef struct contestant {
    method_run *run; /* null: not timed here */
    void *state;
    size_t rounds;
    method_inputs in;
    method_call call; /* of state and in */
    double times[REPETITIONS_MAX];
} contestant;

/* Takes turns, so that what disturbs the machine disturbs all alike. */
static void time_all(contestant *all, size_t count, int repetitions) {
    for (size_t i = 0; i < count; i++) { /* warm-up, and how long one round lasts */
        if (all[i].run == NULL)
            continue;
        double ns = once(all[i].run, &all[i].call, 1) * (double)all[i].in.count;
        if (ns > 10 * slice) /* a few inputs say as much */
            all[i].in.count = (size_t)fmax(1, (double)all[i].in.count * 10 * slice / ns);
        all[i].rounds = (size_t)fmax(1, slice / fmax(ns, 1));
    }
    for (int r = 0; r < repetitions; r++)
        for (size_t i = 0; i < count; i++)
            all[i].times[r] = all[i].run != NULL ? once(all[i].run, &all[i].call, all[i].rounds) : (double)NAN;
}

/* The limit takes its turn behind the methods. */
static void time_methods(contestant *all, bench_result *results, size_t count, int repetitions) {
    time_all(all, count + 1, repetitions);
    const bench_times limit = bench_statistics(all[count].times, (size_t)repetitions);
    for (size_t i = 0; i < count; i++) {
        results[i].limit = limit.least;
        if (all[i].run == NULL) {
            results[i].ns = all[i].call.row->cost;
            results[i].spread = all[i].call.row->spread;
            continue;
        }
        const bench_times times = bench_statistics(all[i].times, (size_t)repetitions);
        results[i].ns = times.least;
        results[i].spread = times.spread;
    }
}

/* Is what the row claims there, and kept? Of a function of somebody's nothing is claimed but what it is asked for. */
static bool keeps_claim(const method_family_row *family, const bench_result *r) {
    const double error = measured_error(family, &r->measured);
    return error <= (r->row->asked > 0 ? r->row->asked : r->claim);
}

/* Do the two differ by no more than two runs of one of them may? A busy machine does not make all alike. */
static bool as_fast(const bench_result *a, const bench_result *b) {
    static const double least = 0.1, most = 0.25;
    return fmax(a->ns, b->ns) <= fmin(a->ns, b->ns) * (1 + fmin(fmax(fmax(a->spread, b->spread), least), most));
}

/* Between two that are as fast the more exact one wins; if they are as exact, too, neither does. */
static bool is_beaten(const method_family_row *family, const bench_result *r, const bench_result *by) {
    const double error = measured_error(family, &r->measured), other = measured_error(family, &by->measured);
    return keeps_claim(family, by) && (as_fast(r, by) ? other < error : by->ns < r->ns && other <= error);
}

static void mark_front(const method_family_row *family, bench_result *results, size_t count) {
    for (size_t i = 0; i < count; i++) {
        bench_result *r = &results[i];
        r->front = keeps_claim(family, r) && !isnan(r->ns);
        for (size_t k = 0; k < count && r->front; k++)
            if ((results[k].row->domain & METHOD_PIPELINE) == (r->row->domain & METHOD_PIPELINE))
                r->front = !is_beaten(family, r, &results[k]);
    }
}

static double input_at(const method_family_row *family, const method_inputs *in, size_t i) {
    return family->windows ? (double)in->d[i] : in->z[i];
}

static bool prepare(const method_family_row *family, size_t which, const dp_setup *setup, const method_inputs *in,
                    const method_outputs *out, bench_result *result, contestant *c) {
    const method_row *row = result->row;
    *c = (contestant){.run = row->own != NULL ? NULL : row->timed != NULL ? row->timed : row->run, .in = *in};
    if (row->limit > 0 && row->limit < in->count)
        c->in.count = row->limit;
    double start = now();
    if (row->open != NULL && (c->state = row->open(setup)) == NULL)
        return false;
    result->setup = row->open != NULL ? now() - start : 0;
    c->call = (method_call){row, setup, c->state, &c->in, out};
    row->run(&c->call);
    judge_all(family, &c->call, &result->measured);
    result->inputs = c->in.count;
    result->at_absolute = input_at(family, in, result->measured.absolute_at);
    result->at_relative = input_at(family, in, result->measured.relative_at);
    result->at_ulp = input_at(family, in, result->measured.ulp_at);
    result->claim = method_claimed(row, which, setup);
    result->bound = method_bound(row, setup);
    result->ns = result->spread = result->limit = (double)NAN;
    return true;
}

size_t bench_run(const method_family_row *family, size_t which, const dp_setup *setup, int repetitions,
                 bench_result results[BENCH_METHODS_MAX]) {
    method_inputs in;
    method_outputs out;
    contestant *all = calloc(BENCH_METHODS_MAX + 1, sizeof *all);
    size_t count = 0;
    bool good = all != NULL && method_arrays(family->inputs, &in, &out);
    if (good) {
        family->fill(setup, &in);
        for (size_t i = 0; i < *family->method_count && good; i++) {
            const method_row *row = &family->methods[i];
            if (method_lacks(row, which, setup) != NULL)
                continue;
            results[count] = (bench_result){.row = row};
            good = prepare(family, which, setup, &in, &out, &results[count], &all[count]);
            count++;
        }
        if (good && repetitions > 0) {
            all[count] =
                (contestant){.run = family->limit, .in = in, .call = {NULL, setup, NULL, &all[count].in, &out}};
            time_methods(all, results, count, repetitions < REPETITIONS_MAX ? repetitions : REPETITIONS_MAX);
            mark_front(family, results, count);
        }
        for (size_t i = 0; i < count; i++)
            if (all[i].state != NULL)
                results[i].row->close(all[i].state);
        method_arrays_free(&in, &out);
    }
    free(all);
    return good ? count : 0;
}
