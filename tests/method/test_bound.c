/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Bounds of linearizations for one camera, from both sides: no depth that is found by climbing has a greater error
 * than the bound, and what is found comes near to it. The truth is the definition in long double.
 */
#include "method/bench.h"
#include "named.h"
#include "support.h"

enum { BATCH = 4096, ROUNDS = 6 };

typedef struct finding {
    double worst;
    float at;
} finding;

static long double truth(const dp_setup *setup, float d) {
    const long double n = setup->spec.znear, f = setup->spec.zfar, at = d, q = setup->reversed ? at : 1 - at;
    return isinf(setup->spec.zfar) ? n / q : n * f / (n + (f - n) * q);
}

static void look(const method_row *row, const dp_setup *setup, method_run *run, const method_inputs *in,
                 const method_outputs *out, finding *f) {
    const method_call call = {row, setup, NULL, in, out};
    run(&call);
    for (size_t i = 0; i < in->count; i++) {
        const long double z = truth(setup, in->d[i]);
        const double error = (double)(fabsl((long double)out->eye[i] - z) / z);
        if (z <= 0x1p127L && !(error <= f->worst))
            *f = (finding){error, in->d[i]};
    }
}

/* The depths of the family's walk, then depths around the worst so far, nearer and nearer. */
static finding worst_found(rng *r, const method_row *row, const dp_setup *setup, method_run *run,
                           const method_inputs *in, const method_outputs *out) {
    finding f = {-1, 0};
    method_windows(setup, (method_inputs *)in);
    look(row, setup, run, in, out, &f);
    for (int round = 0; round < ROUNDS; round++) {
        const uint32_t middle = dp_rank32(f.at), first = dp_rank32(0.0f), last = dp_rank32(1.0f);
        const int64_t width = (int64_t)1 << (23 - 2 * round);
        for (size_t i = 0; i < in->count; i++) {
            const int64_t rank = (int64_t)middle + (int64_t)rng_below(r, (uint64_t)(2 * width)) - width;
            in->d[i] = dp_ranked32((uint32_t)(rank < first ? first : rank > last ? last : rank));
        }
        look(row, setup, run, in, out, &f);
    }
    return f;
}

/* The greatest of all that was tried. */
typedef struct sums {
    double least, most, logs;
    int count;
} sums;

static void try_row(tally *t, rng *r, const method_row *row, size_t which, const dp_setup *setup,
                    const method_inputs *in, const method_outputs *out, sums *s) {
    const double bound = method_bound(row, setup);
    if (isnan(bound))
        return;
    finding f = worst_found(r, row, setup, row->run, in, out);
    if (row->timed != NULL && method_available(row)) {
        const finding timed = worst_found(r, row, setup, row->timed, in, out);
        f = timed.worst > f.worst ? timed : f;
    }
    TALLY(t, f.worst <= bound, "%s %zu, near %.17g, far %.17g: %g at %a, bound %g", row->name, which, setup->spec.znear,
          setup->spec.zfar, f.worst, (double)f.at, bound);
    const double claim = method_claimed(row, which, setup); /* of all cameras, to second order */
    TALLY(t, !(bound > claim * (1 + 1e-6)), "%s %zu, near %.17g, far %.17g: %g where %g is claimed of all", row->name,
          which, setup->spec.znear, setup->spec.zfar, bound, claim);
    if (bound > 0.1)
        return; /* little is left, and no two depths are alike */
    s->least = fmin(s->least, bound / f.worst);
    s->most = fmax(s->most, bound / f.worst);
    s->logs += log(bound / f.worst);
    s->count++;
}

TEST(no_depth_is_beyond_the_bound) {
    rng r = rng_make("bounds");
    tally t = {.name = "bounds"};
    method_inputs in;
    method_outputs out;
    sums all[2][BENCH_METHODS_MAX];
    for (int which = 0; which < 2; which++)
        for (int i = 0; i < BENCH_METHODS_MAX; i++)
            all[which][i] = (sums){INFINITY, 0, 0, 0};
    assert_true(method_arrays(BATCH, &in, &out));
    for (uint64_t k = 0; k < test_cases(10, 60, 2000); k++) {
        const double near = k % 2 == 0 ? rng_log(&r, 1e-12, 1e12)
                                       : ldexp(1 + 0.125 * (double)rng_below(&r, 8), (int)rng_below(&r, 40) - 20);
        const double to = rng_log(&r, 1.001, k % 3 == 0 ? 1e14 : 1e5),
                     far = k % 8 == 7 ? INFINITY : fmin(near * to, 1e18);
        for (size_t which = 0; which < 2; which++) {
            dp_setup setup;
            if (method_setup(&linearize_family, which, near, far, false, &setup) != DP_OK)
                continue;
            for (size_t i = 0; i < *linearize_family.method_count; i++)
                try_row(&t, &r, &linearize_family.methods[i], which, &setup, &in, &out, &all[which][i]);
        }
    }
    method_arrays_free(&in, &out);
    for (size_t which = 0; which < 2; which++)
        for (size_t i = 0; i < *linearize_family.method_count; i++) {
            const sums *s = &all[which][i];
            /* an estimate is seldom as bad as the processors' makers allow */
            const double most = strstr(linearize_family.methods[i].name, "newton") != NULL ? 1.6 : 1.4;
            if (s->count > 0)
                TALLY(&t, exp(s->logs / s->count) <= most || test_effort() == EFFORT_QUICK, "%s: slack",
                      linearize_family.methods[i].name); /* quickly it is an average of few */
            if (s->count > 0)
                printf("# %s, %s: bound over found %.3f on average, %.3f to %.3f\n", linearize_family.methods[i].name,
                       linearize_family.cases[which].name, exp(s->logs / s->count), s->least, s->most);
        }
    tally_end(&t);
}

/* Tables, splines and series are judged by their claims alone, and so are methods of other cases. */
TEST(every_algebraic_method_has_one) {
    tally t = {.name = "rows"};
    dp_setup setup;
    assert_int_equal(method_setup(&linearize_family, 0, 0.1, 1000, false, &setup), DP_OK);
    for (size_t i = 0; i < *linearize_family.method_count; i++) {
        const method_row *row = &linearize_family.methods[i];
        const bool interpolates = row->open != NULL;
        if ((row->domain & METHOD_FLAT) == 0 && method_speaks(row, 0))
            TALLY(&t, isnan(method_bound(row, &setup)) == interpolates, "%s", row->name);
    }
    tally_end(&t);
}
