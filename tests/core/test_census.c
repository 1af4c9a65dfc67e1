/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The census against a plain one that stores every code, against published counts, and against itself. */
#include "depthprec/depthprec.h"
#include "support.h"
#include "zfight/census.h"

/* ---- A plain census ---------------------------------------------------------------------------------------------- */

static double toy_bound(const dp_setup *setup, double z) {
    return 3e-5 * z * z / setup->spec.znear + 1e-6 * z;
}

/* The farthest of equally long intervals takes the greatest share of it: the census meets that one first. */
static double falling_bound(const dp_setup *setup, double z) {
    return 1e-3 * setup->spec.znear / z;
}

/* As guarantees are next to a power of two: half as long from one depth to the next. */
static double jumping_bound(const dp_setup *setup, double z) {
    return toy_bound(setup, z) * (dp_bits32((float)z) >> 12 & 1 ? 0.5 : 1.0);
}

/* Positive on either side of 0. */
static double tent_bound(const dp_setup *setup, double z) {
    return 1e-4 * fabs(z) + 1e-7 * (setup->spec.zfar - setup->spec.znear);
}

/* Does a band begin at a depth? At powers of two, and at 0, where those near 0 are not one band. */
static int begins(const census_request *r, float z) {
    int exponent;
    const double farthest = fmax(-r->lo, r->hi), together = r->lo > 0.0 ? 0.0 : ldexp(1.0, ilogb(farthest) - 10);
    if (fabs((double)z) < fmax(together, 0x1p-126))
        return z == 0.0f && together <= 0x1p-126;
    return fabsf(frexpf(z, &exponent)) == 0.5f && (z < 0.0f || (double)z >= together);
}

/* Half of the greater step beside a depth: how far a surface may be from the binary32 number that it rounds to. */
static double half_step(float z) {
    return 0.5 * fmax((double)nextafterf(z, HUGE_VALF) - (double)z, (double)z - (double)nextafterf(z, -HUGE_VALF));
}

/* Two arrays: the keys, and the least key from each depth on. Long: the whole census in one place, to be read at once.
 */
static void plain_census(const census_request *r, census_result *result) {
    dp_pipeline p;
    assert_int_equal(dp_pipeline_init(&p, r->setup), DP_OK);
    const uint64_t count = census_count(r->lo, r->hi);
    float first = (float)r->lo;
    if ((double)first < r->lo)
        first = nextafterf(first, INFINITY);
    int64_t *key = malloc(count * sizeof *key);
    int64_t *least = malloc(count * sizeof *least);
    float *depth = malloc(count * sizeof *depth);
    assert_non_null(depth);
    assert_non_null(key);
    assert_non_null(least);
    memset(result, 0, sizeof *result);
    for (uint64_t i = 0; i < count; i++) {
        depth[i] = i == 0 ? first : nextafterf(depth[i - 1], HUGE_VALF);
        const int64_t code = (int64_t)dp_pipeline_code(&p, depth[i]);
        key[i] = p.reversed ? -code : code;
    }
    for (uint64_t i = count; i-- > 0;)
        least[i] = i + 1 < count && least[i + 1] < key[i] ? least[i + 1] : key[i];
    double drawn_lo = (double)NAN, drawn_hi = (double)NAN;
    for (uint64_t i = 0; i < count; i++) {
        const float z = depth[i];
        result->band_count += i == 0 || begins(r, z);
        census_band *b = &result->bands[result->band_count - 1];
        if (dp_pipeline_drawn(&p, z)) {
            drawn_lo = isnan(drawn_lo) ? (double)z : drawn_lo;
            drawn_hi = (double)z;
        } else {
            b->clipped++;
        }
        if (i + 1 < count) {
            b->pairs++;
            b->ties += key[i] == key[i + 1];
            b->swaps += key[i] > key[i + 1];
        }
        uint64_t j = i; /* the farthest depth that key[i] reaches */
        for (uint64_t behind = count - 1; j < behind;) {
            const uint64_t middle = behind - (behind - j) / 2;
            if (least[middle] <= key[i])
                j = middle;
            else
                behind = middle - 1;
        }
        const double length = (double)depth[j] - (double)z;
        if (length > b->longest) {
            b->longest = length;
            b->longest_z = (double)z;
        }
        /* The surfaces that are stored as the two ends may be half a step farther apart at either. */
        if (length == 0.0 || r->bound == NULL)
            continue;
        const float other = depth[j];
        b->slack = fmax(b->slack, (length + half_step(z) + half_step(other)) / r->bound(r->setup, (double)z));
    }
    result->near_effective = drawn_lo;
    result->far_effective = drawn_hi;
    uint64_t inside = 0;
    for (uint64_t i = 0; i < count; i++) {
        const float z = depth[i];
        inside += (double)z >= drawn_lo && (double)z <= drawn_hi && !dp_pipeline_drawn(&p, z);
    }
    result->holes = inside;
    free(key);
    free(least);
    free(depth);
}

static int same_band(const census_band *a, const census_band *b) {
    return a->pairs == b->pairs && a->ties == b->ties && a->swaps == b->swaps && a->clipped == b->clipped &&
           a->longest == b->longest && (a->longest <= 0.0 || a->longest_z == b->longest_z);
}

static int same_number(double a, double b) {
    return a == b || (isnan(a) && isnan(b));
}

static int same_result(const census_result *a, const census_result *b) {
    if (a->band_count != b->band_count || a->holes != b->holes || !same_number(a->near_effective, b->near_effective) ||
        !same_number(a->far_effective, b->far_effective))
        return 0;
    for (int i = 0; i < a->band_count; i++)
        if (!same_band(&a->bands[i], &b->bands[i]))
            return 0;
    return 1;
}

/* A set-up of any kind that has a pipeline. */
static dp_setup random_setup(rng *r, bool either_sign) {
    static const char *const formats[] = {"fp32",    "unorm24", "unorm16", "fp16",     "unorm8",     "unorm20",
                                          "unorm28", "unorm32", "unorm23", "float5.9", "float3.3b5", "float8.20b130"};
    for (;;) {
        dp_spec spec = dp_spec_default();
        dp_format format[2];
        dp_setup setup;
        const double chance = rng_unit(r);
        dp_format_parse(formats[rng_below(r, rng_below(r, 2) ? 4 : sizeof formats / sizeof formats[0])], format);
        spec.format = format[0];
        spec.znear = rng_log(r, 1e-3, 1e2);
        spec.zfar = spec.znear * (1.0 + (chance < 0.5 ? rng_log(r, 1.0, 1e6) : rng_log(r, 1e-4, 100.0)));
        if (chance > 0.9)
            spec.zfar = (double)INFINITY;
        if (either_sign)
            rng_planes(r, &spec.znear, &spec.zfar);
        spec.mapping = (dp_mapping)rng_below(r, 4);
        spec.ortho = either_sign || rng_below(r, 4) == 0;
        spec.rounding = (dp_rounding)rng_below(r, DP_ROUNDING_COUNT);
        spec.arith = rng_below(r, dp_arith_count());
        if (dp_setup_init(&setup, &spec) == DP_OK)
            return setup;
    }
}

/* The same where depths may be negative: about 0, across a power of two, or anywhere. */
static void signed_range(rng *r, const dp_setup *setup, double count, double *lo, double *hi) {
    const dp_spec *spec = &setup->spec;
    double from = rng_depth(r, spec->znear, spec->zfar);
    if (rng_below(r, 2) == 0)
        from = copysign(ldexp(1.0, ilogb(from)), from);
    from *= 1.0 - 0x1p-24 * count * rng_unit(r);
    if (rng_below(r, 4) == 0) /* subnormals, where 0 is near */
        from = -0x1p-149 * count * rng_unit(r);
    *lo = fmin(fmax(from, spec->znear), spec->zfar);
    const double step = (double)nextafterf((float)*lo, -HUGE_VALF) - *lo;
    *hi = fmin(*lo + fmax(fabs(step), 0x1p-149) * count, spec->zfar);
}

/* A range of about `count` depths inside the camera's. */
static void random_range(rng *r, const dp_setup *setup, double count, double *lo, double *hi) {
    if (setup->spec.znear <= 0.0) {
        signed_range(r, setup, count, lo, hi);
        return;
    }
    const double far_end = isinf(setup->spec.zfar) ? 1e5 * setup->spec.znear : setup->spec.zfar;
    const double part = count / 8388608.0; /* of a binade */
    *lo = rng_below(r, 8) == 0 ? setup->spec.znear : rng_log(r, setup->spec.znear, far_end);
    *hi = fmin(*lo * exp2(part), far_end);
    if (rng_below(r, 8) == 0) {
        *hi = far_end;
        *lo = fmax(far_end * exp2(-part), setup->spec.znear);
    }
}

static void describe(char out[256], const census_request *r) {
    const dp_spec *s = &r->setup->spec;
    snprintf(out, 256, "near %a far %a %s %s%s %s %s, %a:%a segment %u", s->znear, s->zfar, s->format.name,
             dp_mapping_get(s->mapping)->name, s->ortho ? " ortho" : "", dp_rounding_name(s->rounding),
             dp_arith_get(s->arith)->name, r->lo, r->hi, (unsigned)r->segment);
}

static void compare_plain(tally *t, rng *r, uint64_t cases, double count, bool either_sign) {
    static double (*const bounds[])(const dp_setup *, double) = {toy_bound, falling_bound, jumping_bound, NULL};
    for (uint64_t n = 0; n < cases; n++) {
        const dp_setup setup = random_setup(r, either_sign);
        census_request q = {.setup = &setup, .bound = bounds[rng_below(r, sizeof bounds / sizeof bounds[0])]};
        if (either_sign && q.bound != NULL)
            q.bound = tent_bound;
        if (rng_below(r, 4) > 0) /* borders between segments, far more than usual */
            q.segment = (uint32_t)rng_log(r, 1.0, 20000.0);
        static census_result want, got;
        char text[256];
        random_range(r, &setup, count * rng_unit(r), &q.lo, &q.hi);
        if (census_count(q.lo, q.hi) == 0 || census_count(q.lo, q.hi) > 1U << 22)
            continue;
        plain_census(&q, &want);
        assert_int_equal(census_run(&q, &got), CENSUS_DONE);
        describe(text, &q);
        TALLY(t, same_result(&want, &got), "%s", text);
        for (int i = 0; q.bound != NULL && i < got.band_count; i++)
            TALLY(t, fabs(got.bands[i].slack - want.bands[i].slack) <= 1e-3 * want.bands[i].slack,
                  "%s band %d: slack %.17g, want %.17g", text, i, got.bands[i].slack, want.bands[i].slack);
    }
}

TEST(matches_plain) {
    tally t = {.name = "census against plain census"};
    rng r = rng_make("census");
    compare_plain(&t, &r, test_cases(30, 400, 4000), 200.0, false);
    compare_plain(&t, &r, test_cases(20, 300, 3000), 5000.0, false);
    compare_plain(&t, &r, test_cases(2, 8, 400), 1.5e6, false);
    tally_end(&t);
}

/* An orthographic camera, whose depths may be 0 and negative. */
TEST(matches_plain_of_either_sign) {
    tally t = {.name = "census of either sign against plain census"};
    rng r = rng_make("census of either sign");
    compare_plain(&t, &r, test_cases(60, 800, 8000), 200.0, true);
    compare_plain(&t, &r, test_cases(20, 300, 3000), 5000.0, true);
    compare_plain(&t, &r, test_cases(2, 8, 400), 1.5e6, true);
    assert_true(t.cases > test_cases(60, 900, 9000));
    tally_end(&t);
}

static dp_setup setup_of(double znear, double zfar, const char *format, dp_mapping mapping, const char *arith) {
    dp_spec spec = dp_spec_default();
    dp_format found[2];
    dp_setup setup;
    assert_int_not_equal(dp_format_parse(format, found), 0);
    spec.znear = znear;
    spec.zfar = zfar;
    spec.format = found[0];
    spec.mapping = mapping;
    assert_int_equal(dp_arith_parse(arith, &spec.arith), DP_OK);
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    return setup;
}

/* Where it was met a key may have had the guarantee of either end of its block. */
TEST(a_guarantee_rises_within_a_block) {
    static census_result want, got;
    const double zfar = 0x1.4135070aae935p-3;
    const dp_setup setup = setup_of(0x1.6cb7bcbf44f15p-9, zfar, "float5.9", DP_MAPPING_GL, "fused");
    const census_request q = {.setup = &setup, .lo = 0x1.30cb2de8b6fbfp-3, .hi = zfar, .bound = jumping_bound};
    plain_census(&q, &want);
    assert_int_equal(census_run(&q, &got), CENSUS_DONE);
    assert_true(same_result(&want, &got) && got.bands[0].slack == want.bands[0].slack);
}

static dp_setup ortho_of(double znear, double zfar, const char *format) {
    dp_spec spec = setup_of(1.0, 2.0, format, DP_MAPPING_D3D, "ieee").spec;
    dp_setup setup;
    spec.ortho = true;
    spec.znear = znear;
    spec.zfar = zfar;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    return setup;
}

/* Depths next to 0 are one band, which has what the bands have that a census of them alone shows. */
static double stepped_bound(const dp_setup *setup, double z) {
    (void)setup;
    return z < -4.0 ? 1.0 : 2.0;
}

/* A band ends before the power of two, also below 0, where that is nearer to 0. */
TEST(a_band_has_its_own_guarantee) {
    static census_result found;
    const dp_setup shadow = ortho_of(-10.0, 500.0, "unorm16");
    const census_sample_request q = {.common = {.setup = &shadow, .lo = -8.0, .hi = -2.0, .bound = stepped_bound},
                                     .count = 100};
    assert_int_equal(census_sample(&q, &found), CENSUS_DONE);
    assert_true(found.bands[0].lo == -8.0 && found.bands[0].hi == -4.0 && found.bands[0].bound == 1.0);
    assert_true(found.bands[1].bound == 2.0 && found.all.bound == 2.0);
}

TEST(near_0_is_one_band) {
    static census_result whole, part;
    const dp_setup shadow = ortho_of(-10.0, 500.0, "unorm16"), tiny = ortho_of(0.0, 1e-12, "fp32");
    const census_sample_request q = {.common = {.setup = &shadow, .lo = -10.0, .hi = 500.0}, .count = 10000};
    assert_int_equal(census_sample(&q, &whole), CENSUS_DONE);
    assert_int_equal(whole.band_count, 18);
    for (int i = 0; i < whole.band_count; i++)
        assert_true(i == 0 ? whole.bands[i].lo == -10.0 : whole.bands[i].lo == whole.bands[i - 1].hi);
    assert_true(whole.bands[1].lo == -8.0 && whole.bands[6].lo == -0.25 && whole.bands[6].hi == 0.25);
    assert_true(whole.bands[7].hi == 0.5 && whole.bands[17].lo == 256.0 && whole.bands[17].hi == 500.0);
    assert_true(whole.bands[6].pairs > 9000 && whole.all.pairs == 10000);

    census_request all = {.setup = &tiny, .lo = 0.0, .hi = 0x1p-115};
    assert_int_equal(census_run(&all, &whole), CENSUS_DONE);
    all.hi = 0x1p-125;
    assert_int_equal(census_run(&all, &part), CENSUS_DONE);
    assert_int_equal(whole.band_count, 12);
    assert_int_equal(part.band_count, 3);
    assert_true(whole.bands[0].lo == 0.0 && whole.bands[0].hi == 0x1p-125);
    assert_true(whole.bands[0].pairs == part.all.pairs && whole.bands[0].ties == part.all.ties);
    assert_true(part.all.ties > 0 && part.all.ties < part.all.pairs && whole.bands[0].swaps == part.all.swaps);
    assert_true(whole.bands[0].longest == part.all.longest && whole.bands[0].longest_z == part.all.longest_z);
}

/* Across a power of two: one code on both sides of it, in segments that are shorter than the interval. */
TEST(matches_plain_across_bands) {
    tally t = {.name = "two bands"};
    for (int mapping = 0; mapping < 4; mapping++) {
        static census_result want, got;
        const dp_setup setup = setup_of(1.0, 100.0, "unorm8", (dp_mapping)mapping, "ieee");
        const census_request q = {.setup = &setup, .lo = 63.99, .hi = 64.01, .bound = toy_bound, .segment = 300};
        plain_census(&q, &want);
        assert_int_equal(census_run(&q, &got), CENSUS_DONE);
        assert_int_equal(got.band_count, 2);
        TALLY(&t, same_result(&want, &got), "mapping %d: %g and %g, want %g and %g", mapping, got.bands[0].longest,
              got.bands[1].longest, want.bands[0].longest, want.bands[1].longest);
    }
    tally_end(&t);
}

/* Next to the near plane most blocks have no tie at all, and the sweep takes its other turns. */
TEST(matches_plain_where_ties_are_rare) {
    static const char *const ariths[] = {"ieee", "mesa", "fused"};
    for (size_t i = 0; i < 3; i++)
        for (int mapping = 0; mapping < 2; mapping++) {
            static census_result want, got;
            const dp_setup setup = setup_of(0.1, 1000.0, "fp32", (dp_mapping)mapping, ariths[i]);
            census_request q = {.setup = &setup, .lo = 0.1, .hi = 0.104, .bound = toy_bound, .segment = 50000};
            plain_census(&q, &want);
            assert_int_equal(census_run(&q, &got), CENSUS_DONE);
            assert_true(same_result(&want, &got));
            assert_true(got.all.ties < got.all.pairs / 10);
        }
}

/* Many intervals are as long as the longest. Where the guarantee is no smaller for the nearer ones, the sweep itself
 * looks at the farthest alone. */
TEST(names_the_nearest_of_equally_long) {
    static census_result want, got;
    const dp_setup setup = setup_of(1.0, 1.5, "unorm16", DP_MAPPING_REVERSED, "ieee");
    const census_request q = {.setup = &setup, .lo = 1.49, .hi = 1.5, .bound = dp_separation};
    plain_census(&q, &want);
    assert_int_equal(census_run(&q, &got), CENSUS_DONE);
    assert_true(same_result(&want, &got));
    assert_true(got.all.longest_z == want.bands[0].longest_z);
}

/* ---- Published counts: design values from an independent census -------------------------------------------------- */

TEST(counts) {
    static const struct {
        double zfar;
        const char *format;
        dp_mapping mapping;
        uint64_t pairs, ties, swaps;
        double longest, z;
    } rows[] = {
        {100, "fp32", DP_MAPPING_D3D, 83571507, 59869153, 3832031, 0.00762176513671875, 83.1954},
        {100, "unorm24", DP_MAPPING_GL, 83571507, 63438822, 2166983, 0.0114288330078125, 94.4394},
        {100, "fp32", DP_MAPPING_REVERSED, 83571507, 6247993, 0, 3.814697265625e-06, 33.1221},
        {100, "unorm24", DP_MAPPING_REVERSED, 83571507, 67580360, 0, 0.005950927734375, 99.9732},
        {1000, "fp32", DP_MAPPING_REVERSED, 112014131, 8764268, 0, 6.103515625e-05, 704.554},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        if (test_effort() == EFFORT_QUICK && i != 2)
            continue;
        const dp_setup setup = setup_of(0.1, rows[i].zfar, rows[i].format, rows[i].mapping, "ieee");
        const census_request q = {.setup = &setup, .lo = 0.1, .hi = rows[i].zfar};
        static census_result got;
        assert_int_equal(census_run(&q, &got), CENSUS_DONE);
        assert_true(got.all.pairs == rows[i].pairs);
        assert_true(got.all.ties == rows[i].ties);
        assert_true(got.all.swaps == rows[i].swaps);
        assert_true(got.all.longest == rows[i].longest);
        assert_relative(got.all.longest_z, rows[i].z, 2e-6);
        uint64_t sum = 0;
        for (int b = 0; b < got.band_count; b++)
            sum += got.bands[b].pairs;
        assert_true(sum == rows[i].pairs);
    }
}

TEST(clipped) {
    const dp_setup setup = setup_of(1.0, 10.0, "fp32", DP_MAPPING_D3D, "ieee");
    const census_request q = {.setup = &setup, .lo = 1.0, .hi = 10.0};
    static census_result got;
    assert_int_equal(census_run(&q, &got), CENSUS_DONE);
    assert_true(got.far_effective == 10.0);
    assert_true(got.holes > 0 && got.all.clipped == got.holes); /* 10 is drawn, the depth before it is not */
}

/* ---- The same on every processor, for any number of threads, from any compiler ----------------------------------- */

TEST(same_levels) {
    tally t = {.name = "levels"};
    rng r = rng_make("levels");
    const uint64_t cases = test_cases(30, 200, 6000);
    for (uint64_t n = 0; n < cases; n++) {
        const dp_setup setup = random_setup(&r, n % 4 == 0);
        census_request q = {.setup = &setup, .threads = 1};
        static census_result first, other;
        char text[256];
        random_range(&r, &setup, 9000.0, &q.lo, &q.hi);
        if (census_count(q.lo, q.hi) == 0)
            continue;
        describe(text, &q);
        for (size_t i = 0; i < census_level_count; i++) {
            if (!dp_path_available(census_levels[i].path))
                continue;
            q.level = &census_levels[i];
            assert_int_equal(census_run(&q, i == 0 ? &first : &other), CENSUS_DONE);
            TALLY(&t, i == 0 || same_result(&first, &other), "%s: %s", q.level->name, text);
        }
    }
    tally_end(&t);
}

/* FNV-1a over the codes of every arithmetic, mapping, projection and kind of format. */
static uint64_t digest(const census_level *level) {
    static const char *const formats[] = {"fp32", "fp16", "unorm16", "unorm24", "unorm28", "float6.14"};
    uint64_t hash = UINT64_C(0xCBF29CE484222325);
    for (size_t f = 0; f < sizeof formats / sizeof formats[0]; f++)
        for (size_t a = 0; a < dp_arith_count(); a++)
            for (int m = 0; m < 8; m++) {
                dp_setup setup = setup_of(0.3, 1000.0, formats[f], (dp_mapping)(m % 4), dp_arith_get(a)->name);
                dp_spec spec = setup.spec;
                spec.ortho = m >= 4;
                spec.rounding = (dp_rounding)(a % DP_ROUNDING_COUNT);
                dp_pipeline p;
                float z[CENSUS_BLOCK];
                int32_t key[CENSUS_BLOCK];
                assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
                assert_int_equal(dp_pipeline_init(&p, &setup), DP_OK);
                const census_plan plan = census_plan_make(&p);
                for (uint32_t i = 0; i < CENSUS_BLOCK; i++)
                    z[i] = dp_float32(dp_bits32(0.3f) + i * 95800U);
                level->keys(&plan, z, CENSUS_BLOCK, key);
                for (size_t i = 0; i < CENSUS_BLOCK; i++) {
                    assert_true(key[i] == census_key(&plan, z[i]));
                    hash = (hash ^ (uint32_t)key[i]) * UINT64_C(0x100000001B3);
                }
            }
    return hash;
}

TEST(same_codes) {
    for (size_t i = 0; i < census_level_count; i++)
        if (dp_path_available(census_levels[i].path)) {
            const uint64_t hash = digest(&census_levels[i]);
            printf("# %s: digest of the codes %016llx\n", census_levels[i].name, (unsigned long long)hash);
            assert_true(hash == UINT64_C(0x86057F3E9D7DC583));
        }
}

TEST(same_threads) {
    static census_result one, more;
    const dp_setup setup = setup_of(0.1, 100.0, "unorm24", DP_MAPPING_GL, "mesa");
    census_request q = {.setup = &setup, .lo = 60.0, .hi = 100.0, .threads = 1, .bound = toy_bound};
    assert_int_equal(census_run(&q, &one), CENSUS_DONE);
    for (q.threads = 2; q.threads <= 5; q.threads++) {
        assert_int_equal(census_run(&q, &more), CENSUS_DONE);
        assert_memory_equal(&one, &more, sizeof one);
    }
}

/* ---- Sampling ---------------------------------------------------------------------------------------------------- */

TEST(sampled) {
    static census_result all, some, again;
    const dp_setup setup = setup_of(0.1, 100.0, "fp32", DP_MAPPING_D3D, "ieee");
    census_sample_request q = {.common = {.setup = &setup, .lo = 32.0, .hi = 64.0}, .count = 100000, .seed = 7};
    assert_int_equal(census_run(&q.common, &all), CENSUS_DONE);
    assert_int_equal(census_sample(&q, &some), CENSUS_DONE);
    const double share = (double)all.all.ties / (double)all.all.pairs;
    const double seen = (double)some.all.ties / (double)some.all.pairs;
    assert_scene(seen, share, 5.0 * sqrt(share * (1.0 - share) / 1e5)); /* five standard deviations */
    assert_true(some.all.longest <= all.all.longest && some.all.longest > 0.5 * all.all.longest);
    q.common.threads = 1;
    assert_int_equal(census_sample(&q, &again), CENSUS_DONE);
    assert_memory_equal(&some, &again, sizeof some);
    q.seed = 8;
    assert_int_equal(census_sample(&q, &again), CENSUS_DONE);
    assert_true(again.all.ties != some.all.ties);
}

TEST(gaps) {
    static census_result got;
    const dp_setup setup = setup_of(0.1, 100.0, "unorm24", DP_MAPPING_GL, "ieee");
    census_sample_request q = {.common = {.setup = &setup, .lo = 50.0, .hi = 50.5}, .gap = 0.001};
    dp_pipeline p;
    uint64_t pairs = 0, ties = 0, swaps = 0;
    double first = NAN, last_apart = NAN;
    assert_int_equal(dp_pipeline_init(&p, &setup), DP_OK);
    for (float z = 50.0f; z <= 50.5f; z = nextafterf(z, 100.0f)) {
        const float other = (float)((double)z + 0.001);
        if (other > 50.5f)
            continue;
        const uint32_t a = dp_pipeline_code(&p, z), b = dp_pipeline_code(&p, other);
        pairs++;
        ties += a == b;
        swaps += a > b;
        first = a >= b && isnan(first) ? (double)z : first;
        last_apart = a < b ? (double)z : last_apart;
    }
    assert_int_equal(census_sample(&q, &got), CENSUS_DONE);
    assert_true(got.all.pairs == pairs && got.all.ties == ties && got.all.swaps == swaps && ties > 0);
    assert_true(got.all.first == first && got.all.last_apart == last_apart && first < last_apart);
    q.gap = 0.02; /* beyond the longest interval */
    assert_int_equal(census_sample(&q, &got), CENSUS_DONE);
    assert_true(got.all.ties == 0 && got.all.swaps == 0 && got.all.pairs > 0 && isnan(got.all.first));
}

/* ---- Errors and interruption ------------------------------------------------------------------------------------- */

static int stop_at_once(void *context, uint64_t done) {
    ++*(int *)context;
    return done > 0;
}

TEST(stops) {
    static census_result got;
    int calls = 0;
    const dp_setup setup = setup_of(0.1, 1000.0, "fp32", DP_MAPPING_D3D, "ieee");
    census_request q = {
        .setup = &setup, .lo = 0.1, .hi = 1000.0, .threads = 2, .progress = stop_at_once, .context = &calls};
    assert_int_equal(census_run(&q, &got), CENSUS_STOPPED);
    assert_in_range(calls, 1, 3);
    const census_sample_request s = {.common = q, .count = 10000000};
    calls = 0;
    assert_int_equal(census_sample(&s, &got), CENSUS_STOPPED);
    assert_in_range(calls, 1, 3);
}

TEST(refuses) {
    static census_result got;
    dp_spec spec = dp_spec_default();
    dp_setup setup;
    spec.zfar = (double)INFINITY;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    census_request q = {.setup = &setup, .lo = 0.1, .hi = (double)INFINITY};
    assert_int_equal(census_run(&q, &got), CENSUS_RANGE);
    q.hi = 0.05;
    assert_int_equal(census_run(&q, &got), CENSUS_RANGE);
    q.lo = -(double)INFINITY;
    assert_int_equal(census_run(&q, &got), CENSUS_RANGE);
    q.lo = 1.00000001; /* no binary32 value between these two */
    q.hi = 1.00000002;
    assert_int_equal(census_run(&q, &got), CENSUS_RANGE);
    q.lo = q.hi = 1.0;
    assert_int_equal(census_run(&q, &got), CENSUS_DONE);
    assert_true(got.all.pairs == 0 && got.all.longest <= 0.0 && got.band_count == 1);
    spec.zfar = 1000.0;
    spec.mapping = DP_MAPPING_LOG;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    q.hi = 2.0;
    assert_int_equal(census_run(&q, &got), CENSUS_MODEL);
}
