/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "method/stability.h"

#include <math.h>

#include "core/elementary.h"
#include "core/search.h"

/* Near planes: tiny units, common ones, the hugest for which 1e12 times as far is still a far plane, and one with whose
 * multiples the sums of a pipeline are rounded to either side. */
static const double units[] = {1e-12, 0.1, 1e6, 0.74408};
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

static size_t setups_at(const walk *w, double ratio, int step, bool ortho, dp_setup out[UNITS]) {
    size_t count = 0;
    for (int u = 0; u < UNITS; u++)
        if ((w->family->per_decade > 1 || u == step % UNITS) &&
            method_setup(w->family, w->result->which, units[u], units[u] * ratio, ortho, &out[count]) == DP_OK)
            count++;
    return count;
}

static double error_at(walk *w, double ratio, int step, bool ortho, place *where) {
    dp_setup setups[UNITS];
    const size_t count = setups_at(w, ratio, step, ortho, setups);
    double worst = (double)NAN;
    if (w->result->row->expect != NULL)
        w->result->row->expect(w->result->row, setups, count, w->in.count);
    for (size_t u = 0; u < count; u++) {
        double at = (double)NAN;
        double error = error_of(w, &setups[u], &at);
        if (isnan(worst) || error > worst) {
            worst = error;
            *where = (place){setups[u].spec.znear, setups[u].spec.zfar, at};
        }
    }
    return worst;
}

static double ratio_of(const walk *w, int step) {
    return fmin(METHOD_RATIO_LO * dp_pow(10, (double)step / w->family->per_decade), METHOD_RATIO_HI);
}

/* All set-ups of the walk, and those without a far plane. */
static void expect_all(const walk *w) {
    dp_setup all[(STABILITY_STEPS_MAX + 1) * UNITS];
    size_t count = setups_at(w, (double)INFINITY, 1, false, all);
    for (int k = 0; k < w->result->steps; k++)
        count += setups_at(w, ratio_of(w, k), k, false, all + count);
    w->result->row->expect(w->result->row, all, count, w->in.count);
}

/* A claim; beyond its span the last of it, which is what breaks there. What claims nothing may be asked for something.
 */
static double claim_beyond(const stability_result *r, double ratio) {
    const method_claim *c = &r->row->claims[r->which];
    return r->row->asked > 0 ? r->row->asked : method_claim_at(c, fmin(ratio, c->ratio_hi));
}

/* Between a far/near where the claim holds and one where it does not: the geometric middle decides. */
static double bisect(walk *w, double holds, double breaks, int step) {
    dp_edge e = {.holds = holds, .fails = breaks};
    place where;
    double ratio;
    for (int i = 0; i < BISECTIONS && dp_edge_between(&e, &ratio); i++)
        *(error_at(w, ratio, step, false, &where) <= claim_beyond(w->result, ratio) ? &e.holds : &e.fails) = ratio;
    return sqrt(e.holds) * sqrt(e.fails);
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
        r->verdict = worst > 0.5 || r->row->asked > 0 ? STABILITY_UNCLAIMED : STABILITY_MODEST;
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
    const bool asked = !isnan(c->worst) || r->row->asked > 0;
    place where;
    double most = -1; /* of the share of a claim that an error takes */
    r->breaks = (double)INFINITY;
    r->steps = (int)(decades * per_decade + 0.5) + 1;
    if (r->row->expect != NULL)
        expect_all(w);
    for (int k = 0; k < r->steps; k++) {
        r->ratio[k] = ratio_of(w, k);
        r->error[k] = error_at(w, r->ratio[k], k, false, &where);
        const double claim = claim_beyond(r, r->ratio[k]);
        const double share = isinf(claim) ? 0 : r->error[k] / (isnan(claim) ? 1 : claim);
        if (r->ratio[k] >= c->ratio_lo * (1 - 1e-9) && r->ratio[k] <= c->ratio_hi * (1 + 1e-9) && !(share <= most)) {
            most = share;
            r->claim = isnan(c->worst) ? (double)NAN : claim;
            r->inside = r->error[k];
            r->inside_near = where.znear;
            r->inside_far = where.zfar;
            r->inside_at = where.at;
        }
        if (isinf(r->breaks) && asked && r->error[k] > claim)
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
        if (results[i].row->own == NULL)
            walk_one(family, &results[i], &failed);
    for (size_t i = 0; i < count; i++) /* each of these starts processes */
        if (results[i].row->own != NULL)
            walk_one(family, &results[i], &failed);
    return failed ? 0 : count;
}
