/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The guaranteed separation against a second pipeline: random set-ups and windows, and each pair of real depths in
 * them; and how much of it is used over whole binades of z. Many set-ups with small windows find more than the same
 * number of depths in large ones.
 *
 * Environment, for hunting: REFERENCE_SETUPS, REFERENCE_BANDS numbers; REFERENCE_DEPTHS in a window; REFERENCE_VERBOSE
 * prints every set-up whose promise is broken, worst first, and every band whose slack is above 2.
 */
#include "reference.h"

static uint64_t number(const char *name, uint64_t otherwise) {
    const char *text = getenv(name);
    return text && *text ? strtoull(text, NULL, 0) : otherwise;
}

/* Set-up i of a run has numbers of its own, so threads and counts do not change it. */
static rng numbers_of(const rng *base, uint64_t i) {
    rng r = {base->state + i * 0xD1B54A32D192ED03U};
    r.state = rng_next(&r);
    return r;
}

/* ---- Windows ----------------------------------------------------------------------------------------------------- */

static bool matters(const reference_pipe *p, const reference_window_plan *plan) {
    for (int k = 0; k < plan->count; k++)
        if (reference_subnormal(p, plan->run[k].first) ||
            reference_subnormal(p, plan->run[k].first + plan->run[k].count - 1))
            return true;
    return false;
}

/*
 * Flushed, 1/w is 0 beyond 2^126, and what a reciprocal makes of it is stored as if it were near: the promise to nearer
 * depths ends there. So a window across is judged up to there alone.
 */
static reference_window_plan up_to_normal_reciprocals(reference_window_plan plan) {
    const uint32_t last = reference_rank(0x1p126);
    if (plan.run[0].first > last)
        return plan;
    while (plan.run[plan.count - 1].first > last)
        plan.count--;
    const uint32_t left = last - plan.run[plan.count - 1].first + 1;
    if (plan.run[plan.count - 1].count > left)
        plan.run[plan.count - 1].count = left;
    return plan;
}

/* With subnormal numbers and, where there are any, with hardware that makes zeros of them. */
static void judge_place(const dp_setup *setup, double place, uint32_t depths, reference_result *result) {
    const reference_pipe p = reference_pipe_make(setup, false);
    const reference_window_plan plan = reference_plan(setup, &p, place, depths);
    reference_judge(setup, &p, &plan, result);
    if (matters(&p, &plan)) {
        const reference_pipe flushing = reference_pipe_make(setup, true);
        const reference_window_plan cut = up_to_normal_reciprocals(plan);
        reference_judge(setup, &flushing, dp_arith_get(setup->spec.arith)->reciprocal ? &cut : &plan, result);
    }
}

/* A bound over a range is a promise for each of its depths. */
static bool range_holds(const reference_pair *pair, rng *r) {
    const reference_range range = reference_range_of(&pair->setup);
    dp_separation_worst over;
    const double size = range.znear > 0.0 ? pair->z1 : (range.zfar - range.znear) * rng_log(r, 1e-9, 1.0);
    const double lo = fmax(range.znear, pair->z1 - size * rng_log(r, 1e-7, 0.5));
    const double hi = fmin(range.zfar, pair->z1 + size * rng_log(r, 1e-7, 1.0));
    return pair->ratio <= 0.0 || dp_separation_over(&pair->setup, lo, hi, 0.0, &over) != DP_OK ||
           !reference_beyond(pair->z1, over.bound, pair->z2);
}

enum { WINDOWS = 4 };

typedef struct outcome {
    reference_result all;
    bool range_holds, lattice_holds;
    double place;
} outcome;

typedef dp_setup drawing(rng *r);

static outcome judge_setup(drawing *draw, rng *r, uint32_t depths) {
    const dp_setup setup = draw(r);
    const reference_pipe p = reference_pipe_make(&setup, false);
    const reference_range range = reference_range_of(&setup);
    dp_setup exact = setup;
    exact.spec.model = DP_MODEL_EXACT;
    outcome o = {.range_holds = true, .lattice_holds = true};
    o.all.worst.setup = setup;
    for (int i = 0; i < WINDOWS; i++) {
        const double place = reference_place(r, &p, &range);
        judge_place(&setup, place, depths, &o.all);
        if (reference_bound(&setup, place) < dp_separation(&exact, place))
            o.lattice_holds = false, o.place = place;
    }
    o.range_holds = range_holds(&o.all.worst, r);
    return o;
}

/* ---- What is said of them ---------------------------------------------------------------------------------------- */

static int by_ratio(const void *a, const void *b) {
    const reference_pair *x = a;
    const reference_pair *y = b;
    return (x->ratio < y->ratio) - (x->ratio > y->ratio);
}

typedef struct report {
    reference_pair *broken;
    size_t count;
    uint64_t depths, setups, ranges, lattices;
    bool present[DP_CAUSE_COUNT], noticed[DP_CAUSE_COUNT];
    char lattice[512], range[512];
} report;

static void add(report *t, const outcome *o) {
    t->setups++;
    t->depths += o->all.depths;
    for (int c = 0; c < DP_CAUSE_COUNT; c++) {
        t->present[c] |= o->all.present[c];
        t->noticed[c] |= o->all.noticed[c];
    }
    if (o->all.worst.broken) {
        if ((t->count & (t->count - 1)) == 0) { /* full: twice as many */
            t->broken = realloc(t->broken, (t->count > 0 ? 2 * t->count : 1) * sizeof *t->broken);
            assert_non_null(t->broken);
        }
        t->broken[t->count++] = o->all.worst;
    }
    if (!o->range_holds && t->ranges++ == 0)
        reference_line(&o->all.worst, t->range, sizeof t->range);
    if (!o->lattice_holds && t->lattices++ == 0) {
        const reference_pair at = {.setup = o->all.worst.setup, .z1 = o->place, .x1 = 1, .x2 = 1};
        reference_line(&at, t->lattice, sizeof t->lattice);
        *strchr(t->lattice, '#') = 0;
    }
}

enum { CLASSES_MAX = 32 };

static void print_classes(const report *t) {
    const char *names[CLASSES_MAX] = {NULL};
    size_t counts[CLASSES_MAX] = {0};
    size_t worst[CLASSES_MAX] = {0};
    for (size_t i = 0; i < t->count; i++) { /* worst first */
        const char *name = reference_class(&t->broken[i]);
        int c = 0;
        while (c < CLASSES_MAX - 1 && names[c] && strcmp(names[c], name) != 0)
            c++;
        names[c] = name;
        if (counts[c]++ == 0)
            worst[c] = i;
    }
    for (int c = 0; c < CLASSES_MAX && counts[c] > 0; c++) {
        char line[512];
        reference_line(&t->broken[worst[c]], line, sizeof line);
        printf("# %zu set-ups: %s; the worst: %s\n", counts[c], names[c], line);
    }
}

static void print_report(report *t) {
    if (t->count > 0)
        qsort(t->broken, t->count, sizeof *t->broken, by_ratio);
    printf("# %llu set-ups, %llu depths: the promise is broken in %zu set-ups, over a range in %llu, below the lattice "
           "in %llu\n",
           (unsigned long long)t->setups, (unsigned long long)t->depths, t->count, (unsigned long long)t->ranges,
           (unsigned long long)t->lattices);
    print_classes(t);
    if (t->ranges > 0)
        printf("# over a range, the first: %s\n", t->range);
    if (t->lattices > 0)
        printf("# below the lattice, the first: %s\n", t->lattice);
    for (size_t i = 0; i < t->count && number("REFERENCE_VERBOSE", 0) > 0; i++) {
        char line[512];
        reference_line(&t->broken[i], line, sizeof line);
        printf("%s\n", line);
    }
    for (int c = 0; c < DP_CAUSE_COUNT; c++)
        if (t->present[c])
            printf("# half of the cause %s: %s\n", dp_cause_name((dp_cause)c),
                   t->noticed[c] ? "noticed" : "NOT NOTICED");
    fflush(stdout);
}

/* @return how many depths were judged */
static uint64_t judge_set_ups(const char *name, drawing *draw, uint64_t setups) {
    const uint32_t depths = (uint32_t)number("REFERENCE_DEPTHS", test_cases(1000, 1150, 2200));
    const rng base = rng_make(name);
    report t = {.broken = NULL};
#pragma omp parallel for schedule(dynamic, 8)
    for (uint64_t i = 0; i < setups; i++) {
        rng r = numbers_of(&base, i);
        const outcome o = judge_setup(draw, &r, i % 32 ? depths : 8 * depths);
#pragma omp critical
        add(&t, &o);
    }
    print_report(&t);
    const size_t broken = t.count;
    free(t.broken);
    assert_int_equal(broken, 0);
    assert_int_equal(t.ranges, 0);
    assert_int_equal(t.lattices, 0);
    for (int c = 0; c < DP_CAUSE_COUNT && test_effort() != EFFORT_QUICK; c++)
        assert_int_equal(t.noticed[c], t.present[c]);
    return t.depths;
}

TEST(random_set_ups) {
    const uint64_t setups = number("REFERENCE_SETUPS", test_cases(60, 20000, 1000000));
    const uint64_t depths = judge_set_ups("promise", reference_draw, setups);
    if (test_effort() != EFFORT_QUICK && !getenv("REFERENCE_SETUPS") && !getenv("REFERENCE_DEPTHS"))
        assert_true(depths >= test_cases(0, 100000000, 10000000000));
}

TEST(depths_of_either_sign) {
    judge_set_ups("promise, either sign", reference_draw_signed,
                  number("REFERENCE_SETUPS", test_cases(60, 6000, 300000)));
}

/* ---- Set-ups that have been a trap ------------------------------------------------------------------------------- */

typedef struct trap {
    double znear, zfar;
    const char *format, *mapping, *arith;
    int ortho;
    dp_rounding rounding;
    double z;
} trap;

static const double infinite = (double)__builtin_inff();

static const trap traps[] = {
    {2, 10, "unorm24", "d3d", "ieee", 1, DP_ROUND_NEAREST, 9.9},
    {0.1, 1000, "fp32", "reversed", "ieee", 0, DP_ROUND_NEAREST, 50},
    {149.012, infinite, "unorm24", "d3d", "ieee", 0, DP_ROUND_NEAREST, 4995},
    {0.1, infinite, "fp32", "reversed", "ieee", 0, DP_ROUND_NEAREST, 98000},
    {0.05, 10, "unorm24", "reversed", "ieee", 0, DP_ROUND_NEAREST, 0.06},
    {0.1, 1000, "float2.23", "d3d", "ieee", 0, DP_ROUND_NEAREST, 700},
    {0.1, 1000, "float3.23", "d3d", "ieee", 0, DP_ROUND_NEAREST, 700},
    {0.1, 1000, "float3.23", "reversed", "ieee", 0, DP_ROUND_NEAREST, 700},
    {70, 100, "unorm24", "reversed", "fused", 1, DP_ROUND_NEAREST, 100},
    {74.961907103809182, 157206512, "unorm16", "reversed", "fused", 1, DP_ROUND_ZERO, 157204112},
    {23.106353759765625, 4369900.7264844337, "fp16", "gl-reversed", "mesa-remap", 0, DP_ROUND_ZERO, 4265000.5},
    {3.4521243572235107, 3.4745354652404785, "unorm16", "d3d", "fused-reciprocal", 0, DP_ROUND_NEAREST, 3.47453499},
    {0.7, 1000, "unorm24", "d3d", "ieee", 0, DP_ROUND_NEAREST, 0.7},
    {0.7, 1000, "fp32", "reversed", "ieee", 0, DP_ROUND_NEAREST, 0.7},
    {0.7, 1.7, "unorm24", "gl", "fused", 1, DP_ROUND_NEAREST, 0.7},
    {10, infinite, "fp32", "reversed", "mesa-remap", 0, DP_ROUND_NEAREST, 3.40240829e+38},
    {10, infinite, "fp32", "reversed", "mesa", 0, DP_ROUND_NEAREST, 3.4e38},
    {10, infinite, "fp32", "reversed", "ieee", 0, DP_ROUND_NEAREST, 3.4e38},
    {1e-12, infinite, "fp32", "reversed", "ieee", 0, DP_ROUND_NEAREST, 1e26},
    {1, infinite, "fp32", "d3d", "reciprocal", 0, DP_ROUND_NEAREST, 1.5},
    {216, 140000, "unorm24", "gl-reversed", "ieee", 0, DP_ROUND_NEAREST, 4095.934},
    {0.1, infinite, "float6.9", "gl-reversed", "ieee", 0, DP_ROUND_NEAREST, 2000},
};

static dp_setup setup_of(const trap *t) {
    dp_spec spec = dp_spec_default();
    dp_format found[2];
    dp_setup setup;
    assert_int_not_equal(dp_format_parse(t->format, found), 0);
    spec.znear = t->znear;
    spec.zfar = t->zfar;
    spec.format = found[0];
    assert_int_equal(dp_mapping_parse(t->mapping, &spec.mapping), DP_OK);
    assert_int_equal(dp_arith_parse(t->arith, &spec.arith), DP_OK);
    spec.ortho = t->ortho;
    spec.rounding = t->rounding;
    spec.model = DP_MODEL_FLOAT;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    return setup;
}

TEST(known_traps) {
    const uint32_t depths = (uint32_t)test_cases(2000, 200000, 4000000);
    int broken = 0;
    for (size_t i = 0; i < sizeof traps / sizeof traps[0]; i++) {
        reference_result result = {.depths = 0};
        const dp_setup setup = setup_of(&traps[i]);
        dp_budget budget;
        if (isinf(setup.spec.zfar)) /* whose reciprocal is a normal number */
            assert_int_equal(dp_budget_at(&setup, 0x1p126, NULL, &budget), DP_OK);
        judge_place(&setup, traps[i].z, depths, &result);
        char line[512];
        reference_line(&result.worst, line, sizeof line);
        if (result.worst.broken)
            print_error("%s\n", line);
        broken += result.worst.broken;
    }
    assert_int_equal(broken, 0);
}

/* ---- The two pipelines ------------------------------------------------------------------------------------------- */

TEST(pipelines_agree) {
    tally t = {.name = "codes of the two pipelines"};
    rng r = rng_make("pipelines");
    for (uint64_t i = test_cases(200, 6000, 150000); i > 0; i--) {
        const dp_setup setup = i % 3 ? reference_draw(&r) : reference_draw_signed(&r);
        const reference_pipe p = reference_pipe_make(&setup, false);
        const reference_range range = reference_range_of(&setup);
        dp_pipeline library;
        assert_int_equal(dp_pipeline_init(&library, &setup), DP_OK);
        for (int k = 0; k < 16; k++) {
            const uint32_t x = reference_rank(reference_place(&r, &p, &range));
            const uint32_t want = reference_code(&p, reference_key(&p, x));
            const uint32_t got = dp_pipeline_code(&library, (float)reference_depth(x));
            TALLY(&t, got == want, "-n %.17g -f %.17g -F %s mapping %d ortho %d arith %zu rounding %d at %.9g: %u, %u",
                  setup.spec.znear, setup.spec.zfar, setup.spec.format.name, (int)setup.spec.mapping, setup.spec.ortho,
                  setup.spec.arith, (int)setup.spec.rounding, reference_depth(x), got, want);
        }
    }
    tally_end(&t);
}

/* ---- Tightness --------------------------------------------------------------------------------------------------- */

/* A binade that z has in the range; now and then the first or the last. */
static reference_band draw_band(rng *r) {
    const dp_setup setup = reference_draw(r);
    const reference_range range = reference_range_of(&setup);
    const double end = fmin(range.zfar, range.znear * 0x1p40);
    const uint64_t kind = rng_below(r, 8);
    const double z = kind == 0 ? range.znear : kind < 3 ? end : rng_log(r, range.znear, end);
    return reference_measure_band(&setup, z);
}

/* A binade of an orthographic camera with depths of either sign. Most lie so close to 0 that they are within a code. */
static reference_band draw_band_signed(rng *r) {
    const dp_setup setup = reference_draw_signed(r);
    const reference_range range = reference_range_of(&setup);
    const double most = fmax(fabs(range.znear), fabs(range.zfar));
    const double size = most * (rng_below(r, 4) ? 1.0 - rng_unit(r) : rng_log(r, 1e-9, 1.0));
    const double z = rng_below(r, 2) ? size : -size;
    return reference_measure_band(&setup, z >= range.znear && z <= range.zfar ? z : -z);
}

static int by_slack(const void *a, const void *b) {
    const reference_band *x = a;
    const reference_band *y = b;
    return (x->slack_lattice < y->slack_lattice) - (x->slack_lattice > y->slack_lattice);
}

static void print_band(const reference_band *b) {
    const dp_spec *s = &b->setup.spec;
    const char *const roundings[] = {"nearest", "even", "zero"};
    printf("# slack %.3f, %.3f up to far, %.3f against the lattice's own; longest %.9g at %.9g, bound %.9g at %.9g%s: "
           "depthprec zfight -n "
           "%.17g -f %.17g -F %s -m %s%s --arith %s --rounding %s --range %.17g:%.17g\n",
           b->slack, b->slack_held, b->slack_lattice, b->longest, b->longest_z, b->bound, b->bound_z,
           b->cut ? ", cut" : "", s->znear, s->zfar, s->format.name, dp_mapping_get(s->mapping)->name,
           s->ortho ? " --ortho" : "", dp_arith_get(s->arith)->name, roundings[s->rounding], b->lo, b->hi);
}

typedef struct shares {
    size_t above_2, above_4;
} shares;

/* The pairs of the bands that break the promise; the first few lines. */
static size_t print_broken(const reference_band *bands, size_t count) {
    size_t broken = 0;
    for (size_t i = 0; i < count; i++) {
        char line[512];
        if (!bands[i].worst.broken)
            continue;
        reference_line(&bands[i].worst, line, sizeof line);
        if (broken++ < 5 || number("REFERENCE_VERBOSE", 0) > 0)
            printf("# in a band: %s\n", line);
    }
    return broken;
}

/* Which causes the bound is made of. */
static void print_causes(const reference_band *b) {
    dp_budget budget;
    if (dp_budget_at(&b->setup, b->bound_z, NULL, &budget) != DP_OK)
        return;
    printf("#    ");
    for (int c = 0; c < DP_CAUSE_COUNT; c++)
        if (budget.cause[c] > 0.0)
            printf(" %s %.1f %%", dp_cause_name((dp_cause)c), 100.0 * budget.cause[c] / budget.separation);
    printf("\n");
}

static shares share_of(const char *what, const reference_band *bands, size_t count, size_t offset) {
    double sum = 0.0;
    shares n = {0, 0};
    for (size_t i = 0; i < count; i++) {
        double slack;
        memcpy(&slack, (const char *)&bands[i] + offset, sizeof slack);
        n.above_2 += slack > 2.0;
        n.above_4 += slack > 4.0;
        sum += slack;
    }
    printf("# slack %s: mean %.3f, above 2 in %.2f %%, above 4 in %zu\n", what, sum / (double)count,
           100.0 * (double)n.above_2 / (double)count, n.above_4);
    return n;
}

/* The codes may happen to lie so that the lattice's own separation is not used; no bound may be below that. */
static shares print_bands(reference_band *bands, size_t count) {
    size_t cut = 0;
    qsort(bands, count, sizeof *bands, by_slack);
    const size_t lines = number("REFERENCE_VERBOSE", 0) > 0 ? count : 5;
    for (size_t i = 0; i < count; i++) {
        cut += bands[i].cut;
        if (i < lines && (i < 5 || bands[i].slack_held > 2.0))
            print_band(&bands[i]), print_causes(&bands[i]);
    }
    printf("# %zu bands, %zu of them cut by far\n", count, cut);
    share_of("as it is", bands, count, offsetof(reference_band, slack));
    share_of("with no bound beyond far", bands, count, offsetof(reference_band, slack_held));
    return share_of("and against the lattice's own", bands, count, offsetof(reference_band, slack_lattice));
}

static void judge_bands(const char *name, reference_band (*draw)(rng *), uint64_t count) {
    const rng base = rng_make(name);
    reference_band *bands = calloc(count, sizeof *bands);
    assert_non_null(bands);
    size_t measured = 0;
    size_t unmeasured = 0;
#pragma omp parallel for schedule(dynamic, 1)
    for (uint64_t i = 0; i < count; i++) {
        rng r = numbers_of(&base, i);
        const reference_band b = draw(&r);
#pragma omp critical
        if (isnan(b.slack))
            unmeasured++;
        else
            bands[measured++] = b;
    }
    printf("# %zu bands not measured: no bound, or one that spans more than three binades\n", unmeasured);
    const shares n = measured > 0 ? print_bands(bands, measured) : (shares){0, 0};
    const size_t broken = print_broken(bands, measured);
    free(bands);
    assert_true(measured > 0 || test_effort() == EFFORT_QUICK);
    assert_int_equal(broken, 0);
    assert_int_equal(n.above_4, 0);
    const double expected = 0.02 * (double)measured; /* three standard deviations are left to chance */
    assert_true((double)n.above_2 <= expected + 3.0 * sqrt(expected));
}

/*
 * Far from the camera NDC in [-1, 1] keeps only multiples of 2^-24, so window depths those of 2^-25, and the format may
 * tell all of these apart.
 */
TEST(tight_where_the_format_takes_nothing) {
    static const trap bands[] = {
        {0.8002, infinite, "unorm25", "gl-reversed", "ieee", 0, DP_ROUND_EVEN, 3e6},
        {0.1, infinite, "float6.9", "gl-reversed", "ieee", 0, DP_ROUND_NEAREST, 1e4},
        /* B lies in the middle of two multiples of the sum's last place, and z is an even multiple of it. */
        {0.25977790328044997, infinite, "unorm32", "gl-reversed", "ieee-remap", 0, DP_ROUND_NEAREST, 8.2},
    };
    for (size_t i = 0; i < sizeof bands / sizeof bands[0]; i++) {
        const dp_setup setup = setup_of(&bands[i]);
        const reference_band b = reference_measure_band(&setup, bands[i].z);
        assert_true(!b.worst.broken && b.slack < 1.2501);
    }
}

/*
 * Where few steps of the sums are left up to far, or to the end of a binade: how many times the longest interval a
 * bound is at most. In the last one every other depth of the binade behind is stored as 0.
 */
TEST(tight_where_few_steps_are_left) {
    static const struct {
        trap at;
        double slack;
    } bands[] = {
        {{6.9666, 5752049, "unorm32", "gl-reversed", "mesa-remap", 0, DP_ROUND_NEAREST, 5e6}, 1.05},
        {{2.0825179943214525, 29010897.834892903, "unorm26", "gl-reversed", "mesa-remap", 0, DP_ROUND_NEAREST, 1e7},
         1.4},
        {{0.0096342519566148185, 156459.45100418956, "unorm27", "gl-reversed", "ieee", 0, DP_ROUND_ZERO, 5e4}, 2.05},
        {{0.19704260516447461, 536000.27520803595, "unorm31", "gl-reversed", "ieee-remap", 0, DP_ROUND_ZERO, 3e5},
         1.05},
        {{2.3483806882457872, 7141038.2083351221, "unorm26", "d3d", "ieee", 0, DP_ROUND_NEAREST, 7e6}, 2.5},
        {{0.2107493440571, 17921369.822514407, "fp32", "gl-reversed", "mesa-remap", 0, DP_ROUND_ZERO, 7e6}, 2.3},
    };
    for (size_t i = 0; i < sizeof bands / sizeof bands[0]; i++) {
        const dp_setup setup = setup_of(&bands[i].at);
        const reference_band b = reference_measure_band(&setup, bands[i].at.z);
        dp_separation_worst over;
        printf("# %zu: slack %.3f\n", i, b.slack_lattice);
        assert_true(!b.worst.broken && b.slack_lattice <= bands[i].slack);
        assert_int_equal(dp_separation_over(&setup, b.lo, b.hi, 0.0, &over), DP_OK);
        assert_true(over.bound >= b.bound && over.bound <= over.separation * (1.0 + 0x1p-9));
    }
}

/* Cameras that climb to the loosest bound there: each is the best one so far, a little changed, or a new one. */
TEST(climb_where_few_steps_are_left) {
    static const char *const formats[] = {"unorm24", "unorm26", "unorm29", "unorm32", "fp32"};
    static const char *const mappings[] = {"d3d", "gl", "gl-reversed", "gl-reversed"};
    rng r = rng_make("few steps");
    trap best = {.znear = 0.0};
    double most[2] = {0.0, 0.0};
    for (uint64_t i = test_cases(3, 24, 900); i > 0; i--) {
        trap t = {.rounding = (dp_rounding)rng_below(&r, DP_ROUNDING_COUNT)};
        t.format = formats[rng_below(&r, 5)];
        t.mapping = mappings[rng_below(&r, 4)];
        t.arith = dp_arith_get(rng_below(&r, dp_arith_count()))->name;
        t.znear = rng_log(&r, 1e-3, 1e2);
        t.zfar = rng_below(&r, 8) ? t.znear * rng_log(&r, 1e5, 4e8) : infinite;
        t.z = (isinf(t.zfar) ? 1e8 * t.znear : t.zfar) * rng_log(&r, 0.2, 1.0);
        if (best.znear > 0.0 && rng_below(&r, 2)) {
            t = best;
            t.znear *= 1.0 + 1e-3 * rng_unit(&r);
        }
        const dp_setup setup = setup_of(&t);
        const reference_band b = reference_measure_band(&setup, t.z);
        if (isnan(b.slack_lattice))
            continue;
        if (b.worst.broken || b.slack_lattice > 4.0)
            print_band(&b);
        assert_true(!b.worst.broken && b.slack_lattice <= 4.0);
        if (b.slack_lattice > fmax(most[0], most[1]))
            best = t;
        most[b.cut] = fmax(most[b.cut], b.slack_lattice);
    }
    printf("# slack at most %.3f; of bands cut by far %.3f\n", most[0], most[1]);
}

TEST(tight) {
    judge_bands("bands", draw_band, number("REFERENCE_BANDS", test_cases(1, 300, 6000)));
}

TEST(tight_with_either_sign) {
    judge_bands("bands, either sign", draw_band_signed, number("REFERENCE_BANDS", test_cases(4, 150, 3000)));
}
