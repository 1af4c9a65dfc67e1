/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * What check passes, zfight --separation must find in order: random requirements on a separation, as short as check
 * lets them be; then each binary32 depth of the range and the surface that far behind it.
 */
#include "reference.h"
#include "solve/check.h"
#include "zfight/census.h"

static const char *const roundings[] = {"nearest", "even", "zero"};

/* Everything but the requirement's limit. */
typedef struct asked {
    dp_setup setup;
    const char *model;
    double lo, hi; /* equal: a single depth */
} asked;

static bool never_counts(void *context, const dp_setup *setup, double lo, double hi, bool sample, double *share,
                         double *z) {
    (void)context, (void)setup, (void)lo, (void)hi, (void)sample, (void)share, (void)z;
    fail_msg("a separation needs no count of ties");
    return false;
}

/* Whether check passes a separation of `limit`; *value is the one that it found. */
static bool passes(const asked *a, double limit, double *value) {
    const dp_spec *s = &a->setup.spec;
    char text[1024];
    char zfar[64] = "\"inf\"";
    char where[128];
    if (isfinite(s->zfar))
        snprintf(zfar, sizeof zfar, "%.17e", s->zfar);
    if (a->lo == a->hi)
        snprintf(where, sizeof where, "at = %.17e", a->lo);
    else
        snprintf(where, sizeof where, "range = [%.17e, %.17e]", a->lo, a->hi);
    snprintf(text, sizeof text,
             "cameras = { c = { near = %.17e; far = %s; mapping = \"%s\"; format = \"%s\"; model = \"%s\"; arith = "
             "\"%s\"; rounding = \"%s\"; ortho = %s; }; };\n"
             "requirements = { r = { camera = \"c\"; %s; separation = %.17e; }; };",
             s->znear, zfar, dp_mapping_get(s->mapping)->name, s->format.name, a->model, dp_arith_get(s->arith)->name,
             roundings[s->rounding], s->ortho ? "true" : "false", where, limit);
    need_file file;
    need_error error;
    if (!need_parse("promise.need", text, strlen(text), &file, &error))
        fail_msg("line %d: %s\n%s", error.line, error.text, text);
    check_verdict verdict;
    const check_request request = {&file, never_counts, NULL};
    assert_int_equal(check_count(&file), 1);
    check_all(&request, &verdict);
    *value = verdict.value;
    need_release(&file);
    return verdict.passed;
}

/* The shortest separation that check was made to pass; 0 if none was found. */
static double shortest(const asked *a) {
    double value;
    double limit = 4.0 * fmax(reference_bound(&a->setup, a->lo), reference_bound(&a->setup, a->hi));
    if (!(limit > 0.0) || isinf(limit))
        limit = a->lo;
    if (!passes(a, limit, &value))
        return 0.0;
    if (value <= 0.0) /* then anything must do */
        value = 0x1p-30 * a->lo;
    static const double steps[] = {1.0, 1.0 + 0x1p-40, 1.0 + 0x1p-10, 1.0 + 0x1p-5};
    for (size_t i = 0; i < sizeof steps / sizeof steps[0]; i++) {
        double ignored;
        if (passes(a, value * steps[i], &ignored))
            return value * steps[i];
    }
    return limit;
}

static void describe(const asked *a, double gap, char *text, size_t size) {
    const dp_spec *s = &a->setup.spec;
    snprintf(text, size,
             "depthprec zfight -n %.17g -f %.17g -F %s -m %s%s --arith %s --rounding %s --separation %.17g --range "
             "%.17g:%.17g (model %s)",
             s->znear, s->zfar, s->format.name, dp_mapping_get(s->mapping)->name, s->ortho ? " --ortho" : "",
             dp_arith_get(s->arith)->name, roundings[s->rounding], gap, a->lo, a->hi, a->model);
}

enum { DEPTHS_MAX = 1 << 21 };

/* A range that holds at least two separations and not too many depths; false if there is none. */
static bool draw_range(rng *r, asked *a) {
    const reference_pipe p = reference_pipe_make(&a->setup, false);
    const reference_range range = reference_range_of(&a->setup);
    a->lo = reference_place(r, &p, &range);
    const double s = reference_bound(&a->setup, a->lo);
    const double least = a->lo + 3.0 * fmax(s, 16.0 * (reference_depth(reference_rank(a->lo) + 1) - a->lo));
    a->hi = fmin(range.zfar, least * (1.0 + rng_log(r, 1e-6, 1e-2)));
    return a->hi > a->lo && reference_rank(a->hi) - reference_rank(a->lo) < DEPTHS_MAX;
}

static asked draw(rng *r) {
    asked a;
    do {
        a.setup = reference_draw(r);
        a.model = rng_below(r, 4) ? "float" : "auto";
    } while (!draw_range(r, &a));
    return a;
}

TEST(what_passes_shows_no_fight) {
    tally ranges = {.name = "ranges that pass without a tie or a swap"};
    rng r = rng_make("promise check");
    census_result *result = malloc(sizeof *result);
    uint64_t pairs = 0;
    assert_non_null(result);
    for (uint64_t i = test_cases(10, 600, 20000); i > 0; i--) {
        const asked a = draw(&r);
        const double gap = shortest(&a);
        const census_sample_request request = {.common = {.setup = &a.setup, .lo = a.lo, .hi = a.hi}, .gap = gap};
        char text[512];
        if (gap <= 0.0 || gap >= a.hi - a.lo || census_sample(&request, result) != CENSUS_DONE) {
            ranges.skipped++;
            continue;
        }
        describe(&a, gap, text, sizeof text);
        pairs += result->all.pairs;
        TALLY(&ranges, result->all.ties + result->all.swaps == 0, "%llu ties, %llu swaps of %llu: %s",
              (unsigned long long)result->all.ties, (unsigned long long)result->all.swaps,
              (unsigned long long)result->all.pairs, text);
    }
    printf("# %llu pairs of %llu requirements that pass, %llu more could not be counted\n", (unsigned long long)pairs,
           (unsigned long long)ranges.cases, (unsigned long long)ranges.skipped);
    free(result);
    tally_end(&ranges);
    assert_true(pairs > 0);
}

/* A single depth: the surface that far behind it, and others behind that one. */
TEST(a_single_depth) {
    tally depths = {.name = "single depths that pass, with a surface behind"};
    rng r = rng_make("promise check at");
    for (uint64_t i = test_cases(100, 5000, 100000); i > 0; i--) {
        asked a = draw(&r);
        const reference_range range = reference_range_of(&a.setup);
        const reference_pipe p = reference_pipe_make(&a.setup, false);
        a.lo = a.hi = rng_below(&r, 2) ? a.lo : rng_uniform(&r, a.lo, a.hi);
        const double gap = shortest(&a);
        char text[512];
        if (gap <= 0.0) {
            depths.skipped++;
            continue;
        }
        describe(&a, gap, text, sizeof text);
        bool in_order = true;
        double z2 = 0.0;
        for (int k = 0; k < 20 && in_order; k++) {
            z2 = a.lo + gap * (1.0 + (k < 2 ? 0.0 : rng_log(&r, 1e-9, 1.0)));
            while (!reference_beyond(a.lo, gap, z2))
                z2 = nextafter(z2, HUGE_VAL);
            in_order =
                z2 > range.zfar || reference_key(&p, reference_rank(a.lo)) < reference_key(&p, reference_rank(z2));
        }
        TALLY(&depths, in_order, "%.17g and %.17g: %s", a.lo, z2, text);
    }
    tally_end(&depths);
}
