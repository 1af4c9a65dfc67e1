/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every claim holds in its whole span, is not modest, and breaks where the row says it does. */
#include "method/stability.h"
#include "named.h"
#include "support.h"

static stability_result results[STABILITY_MAX];

static void check_family(const char *name) {
    const method_family_row *family = method_family_find(name);
    size_t count = stability_run(family, STABILITY_ALL, results);
    tally t = {.name = name};
    assert_true(count > 0);
    for (size_t i = 0; i < count; i++) {
        const stability_result *r = &results[i];
        const method_claim *c = &r->row->claims[r->which];
        const char *where = family->cases[r->which].name;
        for (int k = 0; k < r->steps && !isnan(c->worst); k++)
            if (r->ratio[k] <= c->ratio_hi * (1 + 1e-9))
                TALLY(&t, r->error[k] <= method_claim_at(c, r->ratio[k]), "%s, %s: error %g above %g at far/near %g",
                      r->row->name, where, r->error[k], method_claim_at(c, r->ratio[k]), r->ratio[k]);
        /* A formula is near the error all the way, not at its best place alone. */
        for (int k = 0; k < r->steps && c->formula != NULL && r->ratio[k] <= c->ratio_hi; k++)
            if ((r->row->domain & (METHOD_PIPELINE | METHOD_BELOW)) == 0)
                TALLY(&t, r->error[k] >= 0.1 * method_claim_at(c, r->ratio[k]), "%s, %s: error %g far below %g at %g",
                      r->row->name, where, r->error[k], method_claim_at(c, r->ratio[k]), r->ratio[k]);
        TALLY(&t, r->verdict == STABILITY_HOLDS || r->verdict == STABILITY_UNCLAIMED,
              "%s, %s: %s: claim %g to %g, worst %g, breaks at %g, infinite %g, ortho %g", r->row->name, where,
              stability_verdict_name(r->verdict), r->claim, c->ratio_hi, r->inside, r->breaks, r->infinite, r->ortho);
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
        const size_t count = stability_run(family, STABILITY_ALL, results);
        for (size_t i = 0; i < count; i++) {
            const stability_result *r = &results[i];
            method_inputs in;
            method_outputs out;
            dp_setup setup;
            measured m;
            assert_int_equal(method_setup(family, r->which, r->inside_near, r->inside_far, false, &setup), DP_OK);
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
