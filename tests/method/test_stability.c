/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every claim holds in its whole span, is not modest, and breaks where the row says it does. */
#include "method/stability.h"
#include "named.h"
#include "support.h"

static stability_result results[STABILITY_MAX];

/* A family is measured once for all tests that look at it as it is. */
static const stability_result *results_of(const method_family_row *family, size_t *count) {
    enum { FAMILIES = 8 };
    static struct {
        const method_family_row *family;
        size_t count;
        stability_result results[STABILITY_MAX];
    } had[FAMILIES];
    int i = 0;
    while (i < FAMILIES - 1 && had[i].family != NULL && had[i].family != family)
        i++;
    if (had[i].family != family) {
        had[i].family = family;
        had[i].count = stability_run(family, STABILITY_ALL, had[i].results);
    }
    *count = had[i].count;
    return had[i].results;
}

/* A word where more is lost than said, and none elsewhere; it is lost between two steps; a digit that is claimed is. */
static void check_losses(tally *t, const method_family_row *family, const stability_result *r) {
    const method_claim *c = &r->row->claims[r->which];
    int k = 0;
    while (k < r->steps && !(r->error[k] > (family->steps ? 1 : 1e-4)))
        k++;
    TALLY(t, (r->cause == NULL) == (k == r->steps) && !isinf(r->lost) == (k < r->steps), "%s: %s at %g", r->row->name,
          r->cause, r->lost);
    TALLY(t, k == r->steps || (r->lost <= r->ratio[k] && (k == 0 || r->lost >= r->ratio[k - 1])),
          "%s: %g, not before %g", r->row->name, r->lost, r->ratio[k]);
    TALLY(t, isnan(r->claim_to) || (method_claim_at(c, r->claim_to) <= 0.1 && r->claim_to <= c->ratio_hi),
          "%s: claims %g at %g", r->row->name, method_claim_at(c, r->claim_to), r->claim_to);
    TALLY(t,
          isnan(r->claim_to) || r->claim_to == c->ratio_hi ||
              method_claim_at(c, fmin(r->claim_to * 1.06, c->ratio_hi)) > 0.1,
          "%s: claims more than %g", r->row->name, r->claim_to);
    TALLY(t, !isnan(r->claim_to) || family->magnitudes || isnan(c->worst) || method_claim_at(c, 1e4) > 0.1,
          "%s: claims something", r->row->name);
}

static void check_family(const char *name) {
    const method_family_row *family = method_family_find(name);
    size_t count;
    const stability_result *found = results_of(family, &count);
    tally t = {.name = name};
    assert_true(count > 0);
    for (size_t i = 0; i < count; i++) {
        const stability_result *r = &found[i];
        const method_claim *c = &r->row->claims[r->which];
        const char *where = family->cases[r->which].name;
        for (int k = 0; k < r->steps && !isnan(c->worst); k++)
            if (family->magnitudes || r->ratio[k] <= c->ratio_hi * (1 + 1e-9))
                TALLY(&t, r->error[k] <= method_claim_at(c, r->ratio[k]), "%s, %s: error %g above %g at far/near %g",
                      r->row->name, where, r->error[k], method_claim_at(c, r->ratio[k]), r->ratio[k]);
        /* What is said to be the worst is that of all that is claimed, both ends included. */
        for (int k = 0; k < r->steps && !isnan(c->worst); k++)
            if (family->magnitudes ||
                (r->ratio[k] >= c->ratio_lo * (1 - 1e-9) && r->ratio[k] <= c->ratio_hi * (1 + 1e-9)))
                TALLY(&t,
                      r->error[k] * r->claim <=
                          r->inside * method_claim_at(c, fmin(r->ratio[k], c->ratio_hi)) * (1 + 1e-9),
                      "%s, %s: the worst is %g of %g, and %g of %g at %g", r->row->name, where, r->inside, r->claim,
                      r->error[k], method_claim_at(c, r->ratio[k]), r->ratio[k]);
        /* A formula is near the error all the way, not at its best place alone. */
        for (int k = 0; k < r->steps && c->formula != NULL && r->ratio[k] <= c->ratio_hi; k++)
            if ((r->row->domain & (METHOD_PIPELINE | METHOD_BELOW)) == 0)
                TALLY(&t, r->error[k] >= 0.1 * method_claim_at(c, r->ratio[k]), "%s, %s: error %g far below %g at %g",
                      r->row->name, where, r->error[k], method_claim_at(c, r->ratio[k]), r->ratio[k]);
        TALLY(&t, r->verdict == STABILITY_HOLDS || r->verdict == STABILITY_UNCLAIMED,
              "%s, %s: %s: claim %g to %g, worst %g, breaks at %g, infinite %g, ortho %g", r->row->name, where,
              stability_verdict_name(r->verdict), r->claim, c->ratio_hi, r->inside, r->breaks, r->infinite, r->ortho);
        check_losses(&t, family, r);
        if (!isnan(c->worst) && stability_must_break(c))
            TALLY(&t, r->breaks >= c->ratio_hi && r->breaks <= STABILITY_SLACK * c->ratio_hi,
                  "%s, %s: claimed to %g, breaks at %g", r->row->name, where, c->ratio_hi, r->breaks);
    }
    tally_end(&t);
}

TEST(interval_claims) {
    check_family("interval");
}

TEST(linearize_claims) {
    check_family("linearize");
}

TEST(encode_claims) {
    check_family("encode");
}

TEST(worst_claims) {
    check_family("worst");
}

TEST(position_claims) {
    check_family("position");
}

TEST(normal_claims) {
    check_family("normal");
}

/* The walk can tell: a method with another's claim is called broken or modest. */
static method_row forged;
static method_family_row forgery;
static const size_t one = 1;

static stability_verdict verdict_by(const char *name, method_claim claim) {
    const method_family_row *family = method_family_find("linearize");
    for (size_t i = 0; i < *family->method_count; i++)
        if (strcmp(family->methods[i].name, name) == 0)
            forged = family->methods[i];
    forged.claims[0] = claim;
    forged.claims[1] = (method_claim)NOWHERE;
    forgery = *family;
    forgery.methods = &forged;
    forgery.method_count = &one;
    assert_int_equal(stability_run(&forgery, STABILITY_ALL, results), 1);
    return results[0].verdict;
}

static stability_verdict verdict_of(const char *name, double worst, double ratio_hi) {
    return verdict_by(name, (method_claim){worst, METHOD_RATIO_LO, ratio_hi, NULL, 0, 0});
}

/* Its own formula, times a factor. */
static stability_verdict verdict_times(const char *name, double factor) {
    const method_family_row *family = method_family_find("linearize");
    method_claim claim = {0};
    for (size_t i = 0; i < *family->method_count; i++)
        if (strcmp(family->methods[i].name, name) == 0)
            claim = family->methods[i].claims[0];
    claim.worst *= factor;
    return verdict_by(name, claim);
}

TEST(false_claims_are_found) {
    assert_int_equal(verdict_of("textbook", 1e-3, 1e4), STABILITY_HOLDS);
    assert_int_equal(verdict_of("textbook", 1e-3, 1e5), STABILITY_BROKEN);
    assert_int_equal(verdict_of("textbook", 1e-4, 1e4), STABILITY_BROKEN);
    assert_int_equal(verdict_of("textbook", 1e-2, 1e4), STABILITY_MODEST);
    assert_int_equal(verdict_of("textbook", 1e-3, 1e3), STABILITY_MODEST);
    assert_int_equal(verdict_of("phi-double", 6e-8, 1e6), STABILITY_MODEST);
    assert_int_equal(verdict_of("complement", (double)NAN, 1e12), STABILITY_MODEST);
    assert_int_equal(verdict_of("textbook", (double)NAN, 1e12), STABILITY_UNCLAIMED);
    assert_int_equal(verdict_times("textbook", 1), STABILITY_HOLDS);
    assert_int_equal(verdict_times("textbook", 0.5), STABILITY_BROKEN);
    assert_int_equal(verdict_times("textbook", 4), STABILITY_MODEST);
    assert_int_equal(verdict_times("chebyshev", 0.9), STABILITY_BROKEN);
    assert_int_equal(verdict_times("table-nearest", 0.95), STABILITY_BROKEN);
}

/* The worst error is found again at the planes and the input that are named. */
TEST(worst_is_where_it_is_said) {
    static const char *const names[] = {"interval", "linearize", "encode"};
    tally t = {.name = "places"};
    for (size_t f = 0; f < 3; f++) {
        const method_family_row *family = method_family_find(names[f]);
        size_t count;
        const stability_result *found = results_of(family, &count);
        for (size_t i = 0; i < count; i++) {
            const stability_result *r = &found[i];
            method_inputs in;
            method_outputs out;
            dp_setup setup;
            measured m;
            const bool flat = (r->row->domain & METHOD_FLAT) != 0;
            assert_int_equal(method_setup(family, r->which, r->inside_near, r->inside_far, flat, &setup), DP_OK);
            assert_true(method_arrays(1, &in, &out));
            if (family->windows)
                in.d[0] = (float)r->inside_at;
            else
                in.z[0] = r->inside_at;
            assert_true(method_measure(family, r->row, &setup, &in, &out, &m));
            const double error = measured_error(family, &m);
            TALLY(&t, error == r->inside || (isnan(error) && isnan(r->inside)), "%s, %s: %g, not %g", r->row->name,
                  family->cases[r->which].name, r->inside, error);
            method_arrays_free(&in, &out);
        }
    }
    tally_end(&t);
}

/* A method that is exact but where `wrong` says otherwise: there it is off by half. */
static bool (*wrong)(const dp_spec *spec);

static void sometimes(const method_call *call) {
    const dp_setup *setup = call->setup;
    for (size_t i = 0; i < call->in->count; i++)
        call->out->value[i] = dp_cell_of(setup, dp_code(setup, call->in->z[i])).width * (wrong(&setup->spec) ? 1.5 : 1);
}

static bool in_ortho(const dp_spec *spec) {
    return spec->ortho != 0;
}

static bool beyond_all(const dp_spec *spec) {
    return !spec->ortho && isinf(spec->zfar);
}

static bool nowhere(const dp_spec *spec) {
    (void)spec;
    return false;
}

static stability_verdict verdict_where(bool (*is_wrong)(const dp_spec *), unsigned domain) {
    const method_family_row *family = method_family_find("interval");
    forged = family->methods[0];
    forged.run = sometimes;
    forged.open = NULL;
    forged.close = NULL;
    forged.domain = domain;
    wrong = is_wrong;
    forged.claims[0] = (method_claim)FULL(METHOD_ROUNDING);
    for (size_t i = 1; i < METHOD_CASES; i++)
        forged.claims[i] = (method_claim)NOWHERE;
    forgery = *family;
    forgery.methods = &forged;
    forgery.method_count = &one;
    assert_int_equal(stability_run(&forgery, STABILITY_ALL, results), 1);
    return results[0].verdict;
}

/* A claim that reaches an orthographic projection, or an infinite far plane, is broken there; one that does not is not.
 */
TEST(claims_beyond_the_walk) {
    assert_int_equal(verdict_where(nowhere, METHOD_INFINITE | METHOD_ORTHO), STABILITY_HOLDS);
    assert_int_equal(verdict_where(in_ortho, METHOD_INFINITE | METHOD_ORTHO), STABILITY_BROKEN);
    assert_true(results[0].ortho > 0.4 && results[0].inside <= METHOD_ROUNDING);
    assert_int_equal(verdict_where(in_ortho, METHOD_INFINITE), STABILITY_HOLDS);
    assert_int_equal(verdict_where(beyond_all, METHOD_INFINITE | METHOD_ORTHO), STABILITY_BROKEN);
    assert_true(results[0].infinite > 0.4 && results[0].ortho <= METHOD_ROUNDING);
    assert_int_equal(verdict_where(beyond_all, METHOD_ORTHO), STABILITY_HOLDS);
}

/* ---- Other cameras ----------------------------------------------------------------------------------------------- */

static const long double others_far = 1e4L, tangent = 0.57735026918962576451L; /* of 30 degrees */

/* The worst error of n f/(f - d (f - n)), or of d's complement, for depths that are those of other cameras. */
static double worst_of_perspective(int camera, bool reversed) {
    static const double nears[] = {1e-12, 0.1, 1e6, 0.74408};
    long double worst = 0;
    for (size_t u = 0; u < sizeof nears / sizeof nears[0]; u++) {
        const method_family_row *family = method_family_find("linearize");
        const long double n = (long double)nears[u], f = (long double)(nears[u] * (double)others_far);
        method_inputs in;
        method_outputs out;
        dp_setup setup;
        assert_int_equal(method_setup(family, 0, (double)n, (double)f, false, &setup), DP_OK);
        assert_true(method_arrays(family->walked, &in, &out));
        method_windows(&setup, &in);
        for (size_t i = 0; i < in.count; i++) {
            const long double d = (long double)in.d[i], away = reversed ? 1 - d : d;
            const long double got = n * f / (f - away * (f - n));
            const long double want = camera == 0   ? n + (f - n) * away
                                     : camera == 1 ? n / (1 - away * (1 - n / f + tangent))
                                                   : expm1l(d * log1pl(f));
            if (want >= (camera == 1 ? 0 : n * (1 - 1e-12L)) && want <= f * (1 + 1e-12L))
                worst = fmaxl(worst, fabsl(got - want) / want);
        }
        method_arrays_free(&in, &out);
    }
    return (double)worst;
}

TEST(perspective_functions_elsewhere) {
    const method_family_row *family = method_family_find("linearize");
    size_t count;
    const stability_result *found = results_of(family, &count);
    tally t = {.name = "other cameras"};
    size_t seen = 0;
    for (size_t i = 0; i < count; i++) {
        const stability_result *r = &found[i];
        const bool reversed = r->which == 1;
        if (strcmp(r->row->name, "complement") != 0 && strcmp(r->row->name, "phi-double") != 0)
            continue;
        const double got[] = {r->ortho, r->oblique, r->log};
        for (int camera = 0; camera < (reversed ? 2 : 3); camera++, seen++) {
            const double want = worst_of_perspective(camera, reversed);
            TALLY(&t, fabs(got[camera] - want) <= 1e-5 * want && want > 0.5, "%s %d, camera %d: %g, not %g",
                  r->row->name, reversed, camera, got[camera], want);
        }
        TALLY(&t, !reversed || isnan(r->log), "%s: reversed logarithm", r->row->name);
    }
    assert_int_equal(seen, 10);
    tally_end(&t);
}

/* ---- What is lost, and to what ----------------------------------------------------------------------------------- */

/* The error at far/near r of what is named: of a formula by mathematics, of roundings the least and the most. */
static double nearest(double r) {
    return 0.5 * (r - 1) / 65535;
}
static double chord(double r) {
    const double g = (r - 1) / 65535;
    return g * g / (4 * (1 + g));
}
static double rounded(double r) {
    return r * 0x1p-24;
}

TEST(what_takes_the_fourth_digit) {
    static const struct {
        const char *name, *cause;
        double (*error)(double);
        double least, most;
    } rows[] = {
        {"table-nearest", "table", nearest, 0.95, 1.05}, {"table-linear", "table", chord, 0.95, 1.05},
        {"unity", "cancellation", rounded, 0.5, 3},      {"textbook", "cancellation", rounded, 0.5, 3},
        {"fused", "cancellation", rounded, 0.5, 2},      {"ortho-eye", "cancellation", rounded, 0.5, 3},
    };
    const method_family_row *family = method_family_find("linearize");
    size_t count;
    const stability_result *found = results_of(family, &count);
    size_t seen = 0;
    for (size_t i = 0; i < count; i++)
        for (size_t k = 0; k < sizeof rows / sizeof rows[0]; k++) {
            const stability_result *r = &found[i];
            if (strcmp(r->row->name, rows[k].name) != 0 || isinf(r->lost))
                continue;
            const double share = 1e-4 / rows[k].error(r->lost);
            if (!(share >= rows[k].least && share <= rows[k].most))
                fail_msg("%s: lost from %g on, %g of what is reckoned", r->row->name, r->lost, share);
            assert_string_equal(r->cause, rows[k].cause);
            seen++;
        }
    assert_int_equal(seen, 2 + 2 + 4);
}

/* Roundings are not taken for a formula's error, though the row has a word for that. */
TEST(roundings_are_told_from_formulas) {
    const method_family_row *family = method_family_find("linearize");
    for (size_t i = 0; i < *family->method_count; i++)
        if (strcmp(family->methods[i].name, "textbook") == 0)
            forged = family->methods[i];
    forged.coarse = "formula";
    forged.claims[1] = (method_claim)NOWHERE;
    forgery = *family;
    forgery.methods = &forged;
    forgery.method_count = &one;
    assert_int_equal(stability_run(&forgery, STABILITY_ALL, results), 1);
    assert_string_equal(results[0].cause, "cancellation");
}

/* ---- Encoders ---------------------------------------------------------------------------------------------------- */

enum { BINADES = 24 };
static float least_seen[BINADES], most_seen[BINADES];
static size_t binades_seen;

static void watch(const method_call *call) {
    float lo = 2, hi = -1;
    for (size_t i = 0; i < call->in->count; i++) {
        lo = fminf(lo, call->in->d[i]);
        hi = fmaxf(hi, call->in->d[i]);
        call->out->code[i] = (uint32_t)floorl((long double)call->in->d[i] * 0xffffff + 0.5L);
    }
    least_seen[binades_seen] = lo;
    most_seen[binades_seen++] = hi;
}

/* A binade at a step, its ends included, up to 1; then what lies below the normal numbers. */
TEST(encoders_walk_over_binades) {
    const method_family_row *family = method_family_find("encode");
    forged = (method_row){.family = METHOD_ENCODE, .name = "exact", .run = watch};
    for (size_t k = 0; k < family->case_count; k++)
        if (strcmp(family->cases[k].format, "unorm24") == 0)
            forged.claims[k] = (method_claim)FULL(0.5);
    forgery = *family;
    forgery.methods = &forged;
    forgery.method_count = &one;
    binades_seen = 0;
    assert_int_equal(stability_run(&forgery, STABILITY_ALL, results), 1);
    assert_int_equal(binades_seen, BINADES);
    for (int k = 0; k + 1 < BINADES; k++) {
        assert_true(least_seen[k] == ldexpf(1, k - 23) && most_seen[k] == ldexpf(1, k - 22));
        assert_true(results[0].ratio[k] > (double)least_seen[k] && results[0].ratio[k] < (double)most_seen[k]);
        assert_true(results[0].error[k] <= 0.5);
    }
    assert_true(least_seen[BINADES - 1] == 0 && most_seen[BINADES - 1] == 0x1p-126f);
    assert_int_equal(results[0].verdict, STABILITY_HOLDS);
    assert_true(isinf(results[0].lost) && isnan(results[0].claim_to));
}

/* 24 bits of a product and 2^23 more do not fit into binary32 from a half on. */
TEST(encoders_lose_the_last_binade) {
    const method_family_row *family = method_family_find("encode");
    size_t count;
    const stability_result *found = results_of(family, &count);
    size_t seen = 0;
    for (size_t i = 0; i < count; i++) {
        const stability_result *r = &found[i];
        const bool wide = strcmp(family->cases[r->which].format, "unorm24") == 0;
        const bool lost = wide && (strcmp(r->row->name, "magic") == 0 || strcmp(r->row->name, "floor") == 0);
        assert_true(lost ? r->lost == 0.5 : isinf(r->lost));
        assert_true(r->subnormal <= 1);
        seen += lost;
    }
    assert_int_equal(seen, 2);
}

/* As depthprec-methods(1) has them. */
TEST(verdicts_have_their_names) {
    static const char *const names[STABILITY_VERDICTS] = {[STABILITY_HOLDS] = "holds",
                                                          [STABILITY_BROKEN] = "broken",
                                                          [STABILITY_MODEST] = "too modest",
                                                          [STABILITY_UNCLAIMED] = "no claim"};
    for (int i = 0; i < STABILITY_VERDICTS; i++)
        assert_string_equal(stability_verdict_name((stability_verdict)i), names[i]);
    assert_null(stability_verdict_name(STABILITY_VERDICTS));
}
