/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every value that zfight prints, against a census of the same depths. */
#include "printed.h"
#include "zfight/census.h"

static const char *const lines[] = {
    /* A fraction of the depths is clipped before far, none between the planes that are left. */
    "zfight -n 0.1 -f 16.1 -F unorm24,fp16 -m d3d,gl-reversed --arith mesa-remap --range 15.99:16.1 -q",
    /* Far is drawn, the depth before it is not: a hole. */
    "zfight -n 1 -f 10 -F fp32 -m d3d --unit in --range 9.99:10 -q",
    "zfight -n 0.3 -f 900 -F unorm16 -m gl,reversed --rounding zero --range 7.98:8.03 -q --separation 2.5e-3",
    "zfight -n 0.3 -f 900 -F fp32 -m reversed --rounding even --range 5:300 -q --sample 5000 --seed 8589934597",
    "zfight -n 2 -f 60 -F unorm24 -m d3d --ortho --range 3:50 -q --separation 4e-6 --sample 3000 --seed 7",
    /* Behind the camera. */
    "zfight -n -100 -f 60 -F unorm24 -m d3d --ortho --range -8.01:-7.99 -q",
    "zfight -n -100 -f 60 -F unorm24 -m d3d --ortho --range -8.01:-7.99 -q --separation 8e-6",
    "zfight -n -100 -f 60 -F unorm16 -m reversed --ortho --range -100:60 -q --separation 1e-3 --sample 900 --seed 3",
};

typedef struct zfight_case {
    double range[2], gap;
    uint64_t sample, seed;
} zfight_case;

static zfight_case case_of(const char *line) {
    zfight_case c = {.gap = number_behind(line, "--separation", 0),
                     .sample = (uint64_t)number_behind(line, "--sample", 0),
                     .seed = (uint64_t)number_behind(line, "--seed", 0)};
    assert_int_equal(numbers_behind(line, "--range", c.range, 2), 2);
    return c;
}

static void census_of(const zfight_case *c, const dp_setup *setup, census_result *out) {
    const census_sample_request q = {
        .common = {.setup = setup, .lo = c->range[0], .hi = c->range[1], .bound = dp_separation},
        .count = c->sample,
        .seed = c->seed,
        .gap = c->gap};
    assert_int_equal(c->sample > 0 || c->gap > 0 ? census_sample(&q, out) : census_run(&q.common, out), CENSUS_DONE);
}

/* With a gap there are no intervals, and no share of the bound that they take. */
static void want_counts(values *v, const zfight_case *c, const census_band *b) {
    const bool intervals = c->gap <= 0;
    want(v, "lo=%f hi=%f pairs=%lu ties=%lu swaps=%lu", b->lo, b->hi, b->pairs, b->ties, b->swaps);
    want(v, "longest=%f longest_z=%f bound=%f", intervals ? b->longest : NAN, b->longest_z, b->bound);
    want(v, "used=%f", intervals ? b->slack : NAN);
    want(v, "~ties_share=%f", 100 * (double)b->ties / (double)b->pairs);
    want(v, "~swaps_share=%f", 100 * (double)b->swaps / (double)b->pairs);
}

/* The depth behind the last pair in order; none where no pair of the range begins there. */
static double always_from(const zfight_case *c, double last) {
    float z = nextafterf((float)last, HUGE_VALF);
    if (isnan(last))
        for (z = (float)c->range[0]; (double)z < c->range[0];)
            z = nextafterf(z, HUGE_VALF);
    return (double)(float)((double)z + c->gap) <= c->range[1] ? (double)z : NAN;
}

static void want_census(values *v, const zfight_case *c, const dp_setup *setup, size_t i) {
    static census_result r;
    const bool counted = c->sample == 0 && c->gap <= 0;
    int kept = 0;
    census_of(c, setup, &r);
    for (int b = 0; b < r.band_count; b++) {
        if (r.bands[b].pairs == 0)
            continue;
        values_under(v, "setups[%zu].bands[%d].", i, kept++);
        want_counts(v, c, &r.bands[b]);
        want(v, "~clipped=%f", counted ? (double)r.bands[b].clipped : NAN);
        const double nearest = r.bands[b].lo;
        want_bool(v, "certain", (long double)nearest + dp_separation(setup, nearest) <= setup->spec.zfar);
    }
    values_under(v, "setups[%zu].", i);
    want_setup(v, setup);
    want(v, "method=%s", c->sample > 0 ? "sample" : "census");
    want(v, c->sample > 0 ? "seed=%f" : "~seed=%f", (double)c->seed);
    want(v, c->gap > 0 ? "gap=%f" : "~gap=%f", c->gap);
    want_counts(v, c, &r.all);
    want(v, "~guaranteed_there=%f", dp_separation(setup, r.all.longest_z));
    if (counted)
        want(v, "clipped=%lu holes=%lu", r.all.clipped, r.holes);
    if (c->gap > 0)
        want(v, "first=%f always_from=%f", r.all.first, always_from(c, r.all.last_apart));
    want(v, "near_effective=%f far_effective=%f", r.near_effective, r.far_effective);
}

/* The sentence above the first set-up's table. */
static void check_answer(values *v, const zfight_case *c, const char *text) {
    char label[128];
    values_under(v, "setups[0].");
    check_line(v, text, "effective clip range", "near_effective:9, far_effective:9");
    if (c->gap <= 0) {
        check_line(v, text, "Neighbouring binary32 depths", "ties_share:3, swaps_share:3");
        check_line(v, text, "longest interval", "longest:6, longest_z:6, guaranteed_there:6");
        return;
    }
    const bool never = isnan(value_at(v, "setups[0].first")->number);
    const bool nowhere = isnan(value_at(v, "setups[0].always_from")->number);
    snprintf(label, sizeof label, "%s %g apart %s",
             strstr(text, "Of the pairs tested") != NULL ? "Of the pairs tested, surfaces" : "Surfaces", c->gap,
             never ? "never z-fight" : "first z-fight at z =");
    if (never)
        assert_non_null(strstr(text, label));
    else
        check_line(v, text, label, nowhere ? "first:6" : "first:6, always_from:6");
    assert_true(never || (strstr(text, "at no depth do all") != NULL) == nowhere);
}

TEST(each_number) {
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++) {
        const zfight_case c = case_of(lines[i]);
        values v = values_of(lines[i]);
        dp_setup setups[SETUPS_MAX];
        const size_t n = setups_of(lines[i], DP_MODEL_FLOAT, setups);
        for (size_t k = 0; k < n; k++)
            want_census(&v, &c, &setups[k], k);
        check_forms(&v, 0, lines[i], "setups[].bands[]",
                    SETUP_CSV "arith = ^arith, method = ^method, seed = ^seed, gap [scene] = ^gap, lo [scene], "
                              "hi [scene], pairs, ties, swaps, longest [scene], longest_z [scene], bound [scene], "
                              "used, clipped, certain, near_effective [scene] = ^near_effective, "
                              "far_effective [scene] = ^far_effective");
        char *text = output_of(0, lines[i], "--full");
        check_table(&v, text, "setups[].bands[]+",
                    c.gap > 0 ? "lo:6, hi:6, pairs:10, ties_share:-4, swaps_share:-4, bound:6"
                              : "lo:6, hi:6, pairs:10, ties_share:-4, swaps_share:-4, longest:6, longest_z:6, bound:6, "
                                "used:-3");
        check_answer(&v, &c, text);
        free(text);
        values_free(&v);
    }
}

/* The last pair may end with the range: behind the last depth that is stored nearer than another all fight, be it one.
 */
TEST(always_up_to_the_end) {
    static const char line[] = "zfight -n 1 -f 16 -F unorm8 -m d3d --separation 0.0009765625 --range 8:%.17g";
    json_t *root = json_printed(0, line, 15.875);
    const double from = number_at(root, "setups[0].always_from"), end = from + 0x1p-10;
    assert_true(from > 15 && from < 15.8);
    json_decref(root);
    root = json_printed(0, line, end);
    assert_true(number_at(root, "setups[0].always_from") == from);
    json_decref(root);
    root = json_printed(0, line, end - 0x1p-20);
    assert_true(isnan(number_at(root, "setups[0].always_from")));
    json_decref(root);
}

/* The warning about geometry that is not drawn: how many holes, between which planes. */
TEST(warnings) {
    static const char *const said[][2] = {
        {"depthprec: warning: unorm24 d3d: clipping in binary32 keeps only", "near_effective:9, far_effective:9"},
        {"depthprec: warning: fp32 d3d: clipping in binary32 removes", "holes:9, near_effective:9, far_effective:9"}};
    static census_result r;
    for (int i = 0; i < 2; i++) {
        const zfight_case c = case_of(lines[i]);
        dp_setup setups[SETUPS_MAX];
        values v = values_of(lines[i]);
        setups_of(lines[i], DP_MODEL_FLOAT, setups);
        census_of(&c, setups, &r);
        want(&v, "holes=%lu near_effective=%f far_effective=%f", r.holes, r.near_effective, r.far_effective);
        printed p = print_of("%.*s", (int)(strstr(lines[i], " -q") - lines[i]), lines[i]);
        check_line(&v, p.errors, said[i][0], said[i][1]);
        printed_free(&p);
        values_free(&v);
    }
}

/* ---- The bound of a band ----------------------------------------------------------------------------------------- */

static double peak_z, peak;

/* 1 everywhere but at one depth. */
static double peaked(const dp_setup *setup, double z) {
    (void)setup;
    return z == peak_z ? peak : 1;
}

/* The guarantee is looked at where the longest interval is, and at both ends of the band; the sum of the bands has the
 * greatest. */
TEST(bound_of_a_band) {
    static census_result r;
    dp_setup setups[SETUPS_MAX];
    census_request q = {.setup = setups, .lo = 3.99, .hi = 4.01, .bound = peaked};
    setups_of(lines[1], DP_MODEL_FLOAT, setups);
    peak = 1;
    assert_int_equal(census_run(&q, &r), CENSUS_DONE);
    assert_int_equal(r.band_count, 2);
    for (int i = 0; i < 2; i++) /* inside, where the looks from one end to the other miss it */
        assert_true(r.bands[i].longest_z > r.bands[i].lo && r.bands[i].longest_z < r.bands[i].hi);
    const double places[] = {r.bands[1].longest_z, r.bands[1].lo, r.bands[1].hi};
    peak = 5;
    for (int i = 0; i < 3; i++) {
        peak_z = places[i];
        assert_int_equal(census_run(&q, &r), CENSUS_DONE);
        assert_true(r.bands[0].bound == 1 && r.bands[1].bound == 5 && r.all.bound == 5);
    }
    peak_z = r.bands[0].longest_z;
    assert_int_equal(census_run(&q, &r), CENSUS_DONE);
    assert_true(r.bands[0].bound == 5 && r.bands[1].bound == 1 && r.all.bound == 5);
}

/* 1 everywhere, by hand: no two surfaces are farther apart than what is left up to far, 10. */
TEST(bound_ends_at_far) {
    static const struct {
        double lo, hi, bound;
    } rows[] = {{9.25, 10, 0.75}, {9.5, 9.75, 0.5}, {8.5, 10, 1}, {8.5, 8.75, 1}};
    static census_result r;
    dp_setup setups[SETUPS_MAX];
    setups_of(lines[1], DP_MODEL_FLOAT, setups);
    peak = 1;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const census_request q = {.setup = setups, .lo = rows[i].lo, .hi = rows[i].hi, .bound = peaked};
        assert_int_equal(census_run(&q, &r), CENSUS_DONE);
        assert_true(r.band_count == 1 && r.bands[0].bound == rows[i].bound && r.all.bound == rows[i].bound);
    }
}

LIST_TEST(check_apart)
