/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "method/stability.h"

#include <math.h>

#include "core/elementary.h"
#include "core/search.h"

/* Near planes: tiny units, common ones, the hugest for which 1e12 times as far is still a far plane, and one with whose
 * multiples the sums of a pipeline are rounded to either side. */
static const double units[] = {1e-12, 0.1, 1e6, 0.74408};
static const double tilt = 0.57735026918962576; /* of a near plane at 45 degrees in a picture 60 degrees high */
static const double ALIKE = 1.25;
enum { UNITS = sizeof units / sizeof units[0], PIPELINE_WALKED = 24, BISECTIONS = 6, NEARS = 8 };

const char *stability_verdict_name(stability_verdict verdict) {
    static const char *const names[STABILITY_VERDICTS] = {"holds", "broken", "too modest", "no claim"};
    return verdict < STABILITY_VERDICTS ? names[verdict] : NULL;
}

/* The cameras that are taken to a method: those of the walk, or others besides. */
typedef enum beside { WALKED, FLAT, OBLIQUE, LOGARITHMIC, TINY } beside;

typedef struct walk {
    const method_family_row *family;
    stability_result *result;
    method_inputs in;
    method_outputs out;
    bool failed;
} walk;

/* Is a function of perspective depth shown depths that it was not written for? */
static bool is_foreign(const walk *w, beside as) {
    const unsigned own = as == FLAT ? METHOD_BESIDE_OBLIQUE : 0; /* families of perspective depth */
    return as == OBLIQUE || as == LOGARITHMIC ||
           ((w->family->besides & own) != 0 && (w->result->row->domain & METHOD_ORTHO) == 0);
}

static dp_status camera_of(const walk *w, double znear, double zfar, beside as, dp_setup *out) {
    const bool flat = as == FLAT || (w->result->row->domain & METHOD_FLAT) != 0;
    const dp_status status = method_setup(w->family, w->result->which, znear, zfar, flat, out);
    if (as != LOGARITHMIC || status != DP_OK)
        return status;
    dp_spec spec = out->spec;
    spec.mapping = DP_MAPPING_LOG;
    return dp_setup_init(out, &spec);
}

/* The window depths of a binade, both ends, then by chance, in turn with those half-way between codes; of step -1
 * those below all binades of binary32. */
static void fill_binade(const dp_setup *setup, int step, method_inputs *in) {
    const double top = step < 0 ? 0x1p-126 : ldexp(1.0, step + 1 - STABILITY_STEPS_MAX), least = step < 0 ? 0 : top / 2;
    const dp_format *f = &setup->spec.format;
    for (size_t i = 0; i < in->count; i++) {
        const double d = least + (top - least) * method_unit(31, i);
        const uint32_t code = dp_format_encode(f, DP_ROUND_ZERO, d), next = code + (code < f->code_max);
        const float between = (float)((dp_format_value(f, code) + dp_format_value(f, next)) / 2);
        const float ends[] = {(float)least, nextafterf((float)least, 1), nextafterf((float)top, 0), (float)top};
        const bool inside = (double)between > least && (double)between <= top;
        in->d[i] = i < 4 ? ends[i] : i % 2 == 0 && inside ? between : (float)d;
    }
}

/* The error of one set-up; *at is the input that reaches it. Foreign depths are decoded as those of the planes. */
static double error_of(walk *w, const dp_setup *setup, int step, beside as, double *at) {
    dp_setup own = *setup;
    measured m;
    if (w->family->magnitudes)
        fill_binade(setup, as == TINY ? -1 : step, &w->in);
    else
        w->family->fill(setup, &w->in);
    if (is_foreign(w, as)) {
        method_setup(w->family, w->result->which, setup->spec.znear, setup->spec.zfar, false, &own);
        w->in.seen = setup;
        w->in.tilt = as == OBLIQUE ? tilt : 0;
    }
    const bool good = method_measure(w->family, w->result->row, &own, &w->in, &w->out, &m);
    w->in.seen = NULL;
    w->in.tilt = 0;
    if (!good) {
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

static size_t setups_at(const walk *w, double ratio, int step, beside as, dp_setup out[UNITS]) {
    const bool one = w->family->per_decade == 1 || w->family->magnitudes;
    size_t count = 0;
    if (w->family->magnitudes)
        ratio = STABILITY_BESIDE; /* which does not matter */
    for (int u = 0; u < UNITS; u++)
        if ((!one || u == step % UNITS) && camera_of(w, units[u], units[u] * ratio, as, &out[count]) == DP_OK)
            count++;
    return count;
}

static double error_at(walk *w, double ratio, int step, beside as, place *where) {
    dp_setup setups[UNITS];
    const size_t count = setups_at(w, ratio, step, as, setups);
    double worst = (double)NAN;
    if (w->result->row->expect != NULL)
        w->result->row->expect(w->result->row, setups, count, w->in.count);
    for (size_t u = 0; u < count; u++) {
        double at = (double)NAN;
        double error = error_of(w, &setups[u], step, as, &at);
        if (isnan(worst) || error > worst) {
            worst = error;
            *where = (place){setups[u].spec.znear, setups[u].spec.zfar, at};
        }
    }
    return worst;
}

static double ratio_of(const walk *w, int step) {
    if (w->family->magnitudes)
        return M_SQRT2 * ldexp(1.0, step - STABILITY_STEPS_MAX);
    return fmin(METHOD_RATIO_LO * dp_pow(10, (double)step / w->family->per_decade), METHOD_RATIO_HI);
}

/* All set-ups of the walk, and those without a far plane. */
static void expect_all(const walk *w) {
    dp_setup all[(STABILITY_STEPS_MAX + 1) * UNITS];
    size_t count = setups_at(w, (double)INFINITY, 1, WALKED, all);
    for (int k = 0; k < w->result->steps; k++)
        count += setups_at(w, ratio_of(w, k), k, WALKED, all + count);
    w->result->row->expect(w->result->row, all, count, w->in.count);
}

/* A claim; beyond its span the last of it, which is what breaks there. What claims nothing may be asked for something.
 */
static double claim_beyond(const stability_result *r, double ratio) {
    const method_claim *c = &r->row->claims[r->which];
    return r->row->asked > 0 ? r->row->asked : method_claim_at(c, fmin(ratio, c->ratio_hi));
}

static double lost_at(const walk *w) {
    return w->family->steps ? STABILITY_LOST_STEPS : STABILITY_LOST;
}

/* Between a far/near where the error is within a claim, or within what is lost with the fourth digit, and one where it
 * is not: the geometric middle decides. */
static double bisect(walk *w, int step, bool lost) {
    const stability_result *r = w->result;
    if (w->family->magnitudes)
        return r->ratio[step] / M_SQRT2; /* where the binade begins */
    if (step == 0)
        return r->ratio[0];
    dp_edge e = {.holds = r->ratio[step - 1], .fails = r->ratio[step]};
    place where;
    double ratio;
    for (int i = 0; i < BISECTIONS && dp_edge_between(&e, &ratio); i++) {
        const double most = lost ? lost_at(w) : claim_beyond(r, ratio);
        *(error_at(w, ratio, step, WALKED, &where) <= most ? &e.holds : &e.fails) = ratio;
    }
    return sqrt(e.holds) * sqrt(e.fails);
}

/* The error of a formula is that of far/near, whichever the planes; that of roundings hangs on their last bits, as does
 * what comes of depths that were rounded before. */
static const char *cause_of(walk *w, double ratio) {
    const method_row *row = w->result->row;
    const bool alone = w->family->magnitudes || (row->domain & METHOD_PIPELINE) != 0 || row->normal != NULL;
    double least = (double)INFINITY, most = 0, at;
    dp_setup setup;
    if (row->coarse == NULL)
        return "cancellation";
    if (alone)
        return row->coarse;
    for (int i = 0; i < NEARS; i++) {
        const double znear = 0.1 * (1 + (double)i / NEARS);
        if (camera_of(w, znear, znear * ratio, WALKED, &setup) != DP_OK)
            continue;
        const double error = error_of(w, &setup, 0, WALKED, &at);
        least = fmin(least, error);
        most = fmax(most, error);
    }
    return most <= ALIKE * least ? row->coarse : "cancellation";
}

/* A claim has one span in which it is small: see method_claim. */
static double claimed_to(const method_claim *c) {
    enum { STEPS = 440, HALVINGS = 20 };
    const double digit = 0.1, step = dp_pow(c->ratio_hi / c->ratio_lo, 1.0 / STEPS);
    double ratio;
    int k = STEPS;
    if (method_claim_at(c, c->ratio_hi) <= digit)
        return c->ratio_hi;
    while (k >= 0 && !(method_claim_at(c, c->ratio_lo * dp_pow(step, k)) <= digit))
        k--;
    if (k < 0)
        return (double)NAN;
    dp_edge e = {.holds = c->ratio_lo * dp_pow(step, k), .fails = c->ratio_lo * dp_pow(step, k + 1)};
    for (int i = 0; i < HALVINGS && dp_edge_between(&e, &ratio); i++)
        *(method_claim_at(c, ratio) <= digit ? &e.holds : &e.fails) = ratio;
    return e.holds;
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
             (ortho && !isnan(r->ortho) && !(r->ortho <= method_claim_at(c, STABILITY_BESIDE))))
        r->verdict = STABILITY_BROKEN;
    else if ((r->claim > METHOD_ROUNDING && r->inside < METHOD_MODEST * r->claim) ||
             (stability_must_break(c) && !(r->breaks <= STABILITY_SLACK * c->ratio_hi)))
        r->verdict = STABILITY_MODEST;
    else
        r->verdict = STABILITY_HOLDS;
}

/* Is far/near within what is claimed? Encoders claim the same of every depth. */
static bool is_claimed(const walk *w, double ratio) {
    const method_claim *c = &w->result->row->claims[w->result->which];
    return w->family->magnitudes || (ratio >= c->ratio_lo * (1 - 1e-9) && ratio <= c->ratio_hi * (1 + 1e-9));
}

/* Keeps what step k found: the share of a claim that it takes, where claims break, where digits are lost. */
static void look_at(walk *w, int k, const place *where, double *most) {
    stability_result *r = w->result;
    const method_claim *c = &r->row->claims[r->which];
    const bool asked = !isnan(c->worst) || r->row->asked > 0;
    const double claim = claim_beyond(r, r->ratio[k]);
    const double share = isinf(claim) ? 0 : r->error[k] / (isnan(claim) ? 1 : claim);
    if (is_claimed(w, r->ratio[k]) && !(share <= *most)) {
        *most = share;
        r->claim = isnan(c->worst) ? (double)NAN : claim;
        r->inside = r->error[k];
        r->inside_near = where->znear;
        r->inside_far = where->zfar;
        r->inside_at = where->at;
    }
    if (isinf(r->breaks) && asked && r->error[k] > claim)
        r->breaks = bisect(w, k, false);
    if (isinf(r->lost) && r->row->own == NULL && r->error[k] > lost_at(w)) {
        r->lost = bisect(w, k, true);
        r->cause = cause_of(w, r->ratio[k]);
    }
}

static void walk_ratios(walk *w) {
    stability_result *r = w->result;
    const int per_decade = w->family->per_decade;
    const double decades = dp_log10(METHOD_RATIO_HI / METHOD_RATIO_LO);
    place where;
    double most = -1; /* of the share of a claim that an error takes */
    r->breaks = r->lost = (double)INFINITY;
    r->claim_to = w->family->magnitudes ? (double)NAN : claimed_to(&r->row->claims[r->which]);
    r->steps = w->family->magnitudes ? STABILITY_STEPS_MAX : (int)(decades * per_decade + 0.5) + 1;
    if (r->row->expect != NULL)
        expect_all(w);
    for (int k = 0; k < r->steps; k++) {
        r->ratio[k] = ratio_of(w, k);
        r->error[k] = error_at(w, r->ratio[k], k, WALKED, &where);
        look_at(w, k, &where, &most);
    }
}

/* Logarithmic depth is shown to what reads near as 0. */
static void look_besides(walk *w) {
    stability_result *r = w->result;
    const unsigned besides = r->row->own == NULL ? w->family->besides : 0;
    const dp_mapping_row *mapping = dp_mapping_get(w->family->cases[r->which].mapping);
    const bool straight = mapping->curve == DP_CURVE_PERSPECTIVE && (r->row->domain & METHOD_FLAT) == 0;
    place where;
    r->infinite = r->ortho = r->oblique = r->log = r->subnormal = (double)NAN;
    if (w->family->magnitudes) {
        r->subnormal = error_at(w, STABILITY_BESIDE, 1, TINY, &where);
        return;
    }
    r->infinite = error_at(w, (double)INFINITY, 1, WALKED, &where);
    if ((besides & METHOD_BESIDE_ORTHO) != 0)
        r->ortho = error_at(w, STABILITY_BESIDE, 1, FLAT, &where);
    if ((besides & METHOD_BESIDE_OBLIQUE) != 0 && straight)
        r->oblique = error_at(w, STABILITY_BESIDE, 1, OBLIQUE, &where);
    if ((besides & METHOD_BESIDE_LOG) != 0 && !mapping->reversed && (straight || mapping->curve == DP_CURVE_LOG))
        r->log = error_at(w, STABILITY_BESIDE, 1, straight ? LOGARITHMIC : WALKED, &where);
}

static void walk_one(const method_family_row *family, stability_result *r, bool *failed) {
    walk w = {.family = family, .result = r};
    size_t count = (r->row->domain & METHOD_PIPELINE) != 0 ? PIPELINE_WALKED : family->walked;
    if (!method_arrays(count, &w.in, &w.out)) {
        *failed = true;
        return;
    }
    walk_ratios(&w);
    look_besides(&w);
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
