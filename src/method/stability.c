/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "method/stability.h"

#include <math.h>

#include "core/elementary.h"

/* Near planes: tiny units, common ones, and the hugest for which 1e12 times as far is still a far plane. */
static const double units[] = {1e-12, 0.1, 1e6};
static const double ortho_ratio = 1e4;
enum { UNITS = sizeof units / sizeof units[0], PIPELINE_WALKED = 24, BISECTIONS = 6 };

const char *stability_verdict_name(stability_verdict verdict) {
    static const char *const names[STABILITY_VERDICTS] = {"holds", "broken", "too modest", "no claim"};
    return verdict < STABILITY_VERDICTS ? names[verdict] : NULL;
}

typedef struct walk {
    const method_family_row *family;
    stability_result *result;
    method_inputs in;
    method_outputs out;
    bool failed;
} walk;

/* The error of one set-up; *at is the input that reaches it. */
static double error_of(walk *w, const dp_setup *setup, double *at) {
    measured m;
    w->family->fill(setup, &w->in);
    if (!method_measure(w->family, w->result->row, setup, &w->in, &w->out, &m)) {
        w->failed = true;
        return (double)NAN;
    }
    size_t i = w->family->steps ? m.ulp_at : m.relative_at;
    *at = w->family->windows ? (double)w->in.d[i] : w->in.z[i];
    return measured_error(w->family, &m);
}

/* Worst over the units (one of them in turn where a family is slow), planes and input of the worst in *where. */
typedef struct place {
    double znear, zfar, at;
} place;

static double error_at(walk *w, double ratio, int step, bool ortho, place *where) {
    double worst = (double)NAN;
    for (int u = 0; u < UNITS; u++) {
        dp_setup setup;
        double at = (double)NAN;
        if (w->family->per_decade == 1 && u != step % UNITS)
            continue;
        if (method_setup(w->family, w->result->which, units[u], units[u] * ratio, ortho, &setup) != DP_OK)
            continue;
        double error = error_of(w, &setup, &at);
        if (isnan(worst) || error > worst) {
            worst = error;
            *where = (place){units[u], setup.spec.zfar, at};
        }
    }
    return worst;
}

/* A claim; beyond its span the last of it, which is what breaks there. */
static double claim_beyond(const method_claim *c, double ratio) {
    return method_claim_at(c, fmin(ratio, c->ratio_hi));
}

/* Between a far/near where the claim holds and one where it does not: the geometric middle decides. */
static double bisect(walk *w, double holds, double breaks, int step) {
    const method_claim *c = &w->result->row->claims[w->result->which];
    for (int i = 0; i < BISECTIONS; i++) {
        place where;
        double middle = sqrt(holds) * sqrt(breaks);
        if (error_at(w, middle, step, false, &where) <= claim_beyond(c, middle))
            holds = middle;
        else
            breaks = middle;
    }
    return sqrt(holds) * sqrt(breaks);
}

bool stability_must_break(const method_claim *c) {
    return c->ratio_hi < METHOD_RATIO_HI && method_claim_at(c, c->ratio_hi) < 1;
}

static void judge_claim(stability_result *r) {
    const method_claim *c = &r->row->claims[r->which];
    bool infinite = (r->row->domain & METHOD_INFINITE) != 0, ortho = (r->row->domain & METHOD_ORTHO) != 0;
    double worst = 0;
    for (int k = 0; k < r->steps; k++)
        worst = fmax(worst, r->error[k]);
    if (isnan(c->worst))
        r->verdict = worst > 0.5 ? STABILITY_UNCLAIMED : STABILITY_MODEST;
    else if (!(r->inside <= r->claim) ||
             (infinite && c->ratio_hi >= METHOD_RATIO_HI && !isnan(r->infinite) &&
              !(r->infinite <= method_claim_at(c, (double)INFINITY))) ||
             (ortho && !isnan(r->ortho) && !(r->ortho <= method_claim_at(c, ortho_ratio))))
        r->verdict = STABILITY_BROKEN;
    else if ((r->claim > METHOD_ROUNDING && r->inside < METHOD_MODEST * r->claim) ||
             (stability_must_break(c) && !(r->breaks <= STABILITY_SLACK * c->ratio_hi)))
        r->verdict = STABILITY_MODEST;
    else
        r->verdict = STABILITY_HOLDS;
}

static void walk_ratios(walk *w) {
    stability_result *r = w->result;
    const method_claim *c = &r->row->claims[r->which];
    const int per_decade = w->family->per_decade;
    const double decades = dp_log10(METHOD_RATIO_HI / METHOD_RATIO_LO);
    place where;
    double most = -1; /* of the share of a claim that an error takes */
    r->breaks = (double)INFINITY;
    r->steps = (int)(decades * per_decade + 0.5) + 1;
    for (int k = 0; k < r->steps; k++) {
        r->ratio[k] = fmin(METHOD_RATIO_LO * dp_pow(10, (double)k / per_decade), METHOD_RATIO_HI);
        r->error[k] = error_at(w, r->ratio[k], k, false, &where);
        const double claim = claim_beyond(c, r->ratio[k]);
        const double share = isinf(claim) ? 0 : r->error[k] / (isnan(claim) ? 1 : claim);
        if (r->ratio[k] >= c->ratio_lo * (1 - 1e-9) && r->ratio[k] <= c->ratio_hi * (1 + 1e-9) && !(share <= most)) {
            most = share;
            r->claim = claim;
            r->inside = r->error[k];
            r->inside_near = where.znear;
            r->inside_far = where.zfar;
            r->inside_at = where.at;
        }
        if (isinf(r->breaks) && !isnan(c->worst) && !(r->error[k] <= claim))
            r->breaks = k > 0 ? bisect(w, r->ratio[k - 1], r->ratio[k], k) : r->ratio[0];
    }
}

static void walk_one(const method_family_row *family, stability_result *r, bool *failed) {
    walk w = {.family = family, .result = r};
    place where;
    size_t count = (r->row->domain & METHOD_PIPELINE) != 0 ? PIPELINE_WALKED : family->walked;
    r->infinite = r->ortho = (double)NAN;
    if (!method_arrays(count, &w.in, &w.out)) {
        *failed = true;
        return;
    }
    walk_ratios(&w);
    r->infinite = error_at(&w, (double)INFINITY, 1, false, &where);
    if (family->ortho)
        r->ortho = error_at(&w, ortho_ratio, 1, true, &where);
    judge_claim(r);
    method_arrays_free(&w.in, &w.out);
    *failed = *failed || w.failed;
}

size_t stability_run(const method_family_row *family, unsigned cases, stability_result *results) {
    size_t count = 0;
    bool failed = false;
    for (size_t i = 0; i < *family->method_count; i++)
        for (size_t k = 0; k < family->case_count; k++)
            if ((cases >> k & 1) != 0 && method_speaks(&family->methods[i], k) && method_available(&family->methods[i]))
                results[count++] = (stability_result){.row = &family->methods[i], .which = k};
#pragma omp parallel for schedule(dynamic) reduction(|| : failed)
    for (size_t i = 0; i < count; i++)
        walk_one(family, &results[i], &failed);
    return failed ? 0 : count;
}
