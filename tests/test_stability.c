/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every claim holds in its whole span, is not modest, and breaks where the row says it does. */
#include <math.h>
#include <string.h>

#include "method/stability.h"
#include "support.h"

static stability_result results[STABILITY_MAX];

static void check_family(const char *name) {
    const method_family_row *family = method_family_find(name);
    size_t count = stability_run(family, results);
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

static void interval_claims(void **state) {
    (void)state;
    check_family("interval");
}

static void linearize_claims(void **state) {
    (void)state;
    check_family("linearize");
}

static void encode_claims(void **state) {
    (void)state;
    check_family("encode");
}

static void worst_claims(void **state) {
    (void)state;
    check_family("worst");
}

static void position_claims(void **state) {
    (void)state;
    check_family("position");
}

static void normal_claims(void **state) {
    (void)state;
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
    forged.claims[1] = (method_claim){0, 0, 0, NULL};
    forgery = *family;
    forgery.methods = &forged;
    forgery.method_count = &one;
    assert_int_equal(stability_run(&forgery, results), 1);
    return results[0].verdict;
}

static stability_verdict verdict_of(const char *name, double worst, double ratio_hi) {
    return verdict_by(name, (method_claim){worst, METHOD_RATIO_LO, ratio_hi, NULL});
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

static void false_claims_are_found(void **state) {
    (void)state;
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

/* A claim that fails in an orthographic projection alone, or at an infinite far plane alone, is broken just where it is
 * claimed there. */
static stability_verdict verdict_in(const char *family_name, const char *name, size_t which, unsigned domain) {
    const method_family_row *family = method_family_find(family_name);
    for (size_t i = 0; i < *family->method_count; i++)
        if (strcmp(family->methods[i].name, name) == 0)
            forged = family->methods[i];
    for (size_t k = 0; k < METHOD_CASES; k++)
        if (k != which)
            forged.claims[k] = (method_claim){0, 0, 0, NULL};
    forged.domain = domain;
    forgery = *family;
    forgery.methods = &forged;
    forgery.method_count = &one;
    assert_int_equal(stability_run(&forgery, results), 1);
    return results[0].verdict;
}

static void claims_hold_where_they_say(void **state) {
    (void)state;
    assert_int_equal(verdict_in("position", "extents", 1, METHOD_INFINITE), STABILITY_HOLDS);
    assert_true(results[0].ortho > 100 * results[0].claim);
    assert_int_equal(verdict_in("position", "extents", 1, METHOD_INFINITE | METHOD_ORTHO), STABILITY_BROKEN);
    assert_int_equal(verdict_in("linearize", "complement", 1, 0), STABILITY_HOLDS);
    assert_true(isinf(results[0].infinite));
    assert_int_equal(verdict_in("linearize", "complement", 1, METHOD_INFINITE), STABILITY_BROKEN);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(interval_claims),        cmocka_unit_test(linearize_claims),
        cmocka_unit_test(encode_claims),          cmocka_unit_test(worst_claims),
        cmocka_unit_test(position_claims),        cmocka_unit_test(normal_claims),
        cmocka_unit_test(false_claims_are_found), cmocka_unit_test(claims_hold_where_they_say),
    };
    return run_tap(tests);
}
