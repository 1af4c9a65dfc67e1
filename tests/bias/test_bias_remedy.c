/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * What is written in place of a bias: verdicts and what it is worth, against window depths in long double of formulas
 * that are written here; what does not apply; and what a bias does not do, told where it applies.
 */
#include "bias/limits.h"
#include "bias/remedy.h"
#include "core/bits.h"
#include "printed.h"

/* ---- The formulas ------------------------------------------------------------------------------------------------ */

static long double window_of(const dp_spec *s, long double near, long double z) {
    const long double far = 1.0L / (long double)s->zfar;
    const bool reversed = dp_mapping_get(s->mapping)->reversed != 0;
    const long double d =
        s->ortho ? (z - near) / ((long double)s->zfar - near) : (1.0L - near / z) / (1.0L - near * far);
    return reversed ? (s->ortho ? ((long double)s->zfar - z) / ((long double)s->zfar - near)
                                : (near / z - near * far) / (1.0L - near * far))
                    : d;
}

/* The window depth that the layer has, exactly. */
static long double layer_of(const dp_spec *s, const char *what, long double x, long double z) {
    const bool reversed = dp_mapping_get(s->mapping)->reversed != 0;
    const long double near = s->znear, d = window_of(s, near, z);
    if (strcmp(what, "ndc") == 0)
        return d + (reversed ? x : -x) * (dp_mapping_get(s->mapping)->ndc_signed ? 0.5L : 1.0L);
    if (strcmp(what, "ray") == 0)
        return window_of(s, near, z - x * z);
    if (strcmp(what, "normal") == 0)
        return window_of(s, near, z - x);
    if (strcmp(what, "near") == 0)
        return window_of(s, x * near, z);
    return reversed ? (1.0L - x) + x * d : x * d;
}

static uint64_t code_of(const dp_format *f, long double d) {
    const double held = (double)(float)fminl(fmaxl(d, 0.0L), 1.0L);
    return f->kind == DP_FORMAT_UNORM ? (uint64_t)floorl((long double)held * f->code_max + 0.5L)
                                      : dp_bits32((float)held);
}

/* Where a plane whose eye depth changes by so much from a pixel to the next is so many of them farther: its window
 * depth is straight. */
static long double farther(const dp_spec *s, long double z, long double slope, long double pixels) {
    return slope == 0.0L ? z : s->ortho ? z + slope * pixels : 1.0L / (1.0L / z - slope * pixels / (z * z));
}

/* Whether the layer, sampled at `there`, is seen before its wall at z: not clipped, and stored nearer; nothing is drawn
 * beyond far. */
static bool is_seen(const dp_spec *s, const char *what, double x, double z, long double there) {
    const bool reversed = dp_mapping_get(s->mapping)->reversed != 0;
    if (!(there >= (long double)z && there <= (long double)s->zfar))
        return true;
    const long double layer = layer_of(s, what, x, there), d = window_of(s, s->znear, z);
    const uint64_t a = code_of(&s->format, layer), b = code_of(&s->format, d);
    return !(reversed ? layer > 1.0L + 1e-15L : layer < -1e-15L) && (reversed ? a > b : a < b);
}

/* ---- Random ones ------------------------------------------------------------------------------------------------- */

static bool draw_setup(rng *r, dp_setup *setup, double *lo, double *hi) {
    static const char *const formats[] = {"unorm16", "unorm24", "fp32"};
    dp_spec spec = dp_spec_default();
    dp_format found[2];
    dp_format_parse(formats[rng_below(r, 3)], found);
    spec.format = found[0];
    spec.mapping = (dp_mapping)rng_below(r, DP_MAPPING_GL_REVERSED + 1);
    spec.ortho = rng_below(r, 5) == 0;
    spec.znear = rng_log(r, 0.01, 10.0);
    spec.zfar = spec.znear * rng_log(r, 3.0, 1e5);
    *lo = spec.znear * rng_log(r, 1.0, sqrt(spec.zfar / spec.znear));
    *hi = *lo * rng_log(r, 1.0, spec.zfar / *lo);
    return dp_setup_init(setup, &spec) == DP_OK && *lo < *hi;
}

static double draw_amount(rng *r, const remedy *row, double least) {
    const double by = rng_below(r, 3) == 0 ? 1.0 : rng_log(r, 0.1, 10.0);
    const double zero = row->grows ? row->least : row->most;
    const double x =
        isnan(least) ? zero + (row->grows ? 1.0 : -1.0) * rng_log(r, 1e-7, 1e-2) : zero + (least - zero) * by;
    return fmin(fmax(x, row->least), row->most);
}

/* The largest push between two depths: it grows, or grows and falls. */
static double pushed_most(const dp_setup *setup, const remedy *row, double x, double lo, double hi) {
    double most = fmax(-remedy_at(setup, row, x, lo).shift, -remedy_at(setup, row, x, hi).shift);
    for (int i = 0; i < 100; i++) {
        const double a = lo + (hi - lo) / 3.0, b = hi - (hi - lo) / 3.0;
        const double at_a = -remedy_at(setup, row, x, a).shift, at_b = -remedy_at(setup, row, x, b).shift;
        most = fmax(most, fmax(at_a, at_b));
        *(at_a < at_b ? &lo : &hi) = at_a < at_b ? a : b;
    }
    return most;
}

TEST(random_remedies) {
    rng r = rng_make("bias remedies");
    tally enough = {.name = "enough"}, witness = {.name = "not enough"}, worth = {.name = "worth"};
    uint64_t answers[8][3] = {{0}}, sloped[3] = {0};
    const uint64_t count = test_cases(600, 4000, 100000);
    for (uint64_t i = 0; i < count;) {
        dp_setup setup;
        double lo, hi;
        const size_t which = (size_t)rng_below(&r, remedy_table.count - 1); /* the last compares no depth */
        const remedy *row = remedy_get(which);
        if (!draw_setup(&r, &setup, &lo, &hi) || !remedy_suits(row, &setup))
            continue;
        const dp_spec *s = &setup.spec;
        const double slope = row->parallel || rng_below(&r, 2) ? 0.0 : lo * rng_log(&r, 1e-6, 0.1);
        const bias_goal goal = {.slope = slope};
        const double least = remedy_judge(&setup, row, row->grows ? row->least : row->most, &goal, lo, hi).units;
        const double x = draw_amount(&r, row, least);
        const bias_verdict v = remedy_judge(&setup, row, x, &goal, lo, hi);
        i++;
        answers[which][v.answer]++;
        sloped[v.answer] += slope > 0.0;
        if (x == least)
            TALLY(&enough, v.answer == BIAS_ENOUGH, "%s %s: the least is not enough", row->name, s->format.name);
        for (int k = 0; k < 100 && v.answer == BIAS_ENOUGH; k++) {
            const double z = k == 0 ? lo : k == 1 ? hi : rng_log(&r, lo, hi);
            const long double there = farther(s, z, slope, k % 3 ? 1.0L : (long double)rng_uniform(&r, 0.0, 1.0));
            TALLY(&enough, is_seen(s, row->name, x, z, there),
                  "%s %s %s ortho %d near %.17g far %.17g: %.17g at %.17g, slope %g, is not enough", row->name,
                  s->format.name, dp_mapping_get(s->mapping)->name, s->ortho, s->znear, s->zfar, x, z, slope);
        }
        if (v.answer == BIAS_NOT_ENOUGH)
            TALLY(&witness,
                  !(is_seen(s, row->name, x, v.z, farther(s, v.z, slope, 1.0L)) &&
                    is_seen(s, row->name, x, v.z, v.z)) && /* by the layer a pixel off, or one that is clipped */
                      v.z >= lo &&
                      v.z <= hi,
                  "%s %s %s ortho %d near %.17g far %.17g: %.17g at %.17g, slope %g, is enough", row->name,
                  s->format.name, dp_mapping_get(s->mapping)->name, s->ortho, s->znear, s->zfar, x, v.z, slope);
        const double z = rng_log(&r, lo, hi), to = remedy_at(&setup, row, x, z).to;
        const long double there = to > 0.0 ? window_of(s, s->znear, to) : 0.0L, exact = layer_of(s, row->name, x, z);
        if (exact > 0.0L && exact < 1.0L)
            TALLY(&worth, fabsl(there - exact) <= 1e-13L * (1.0L + fabsl(exact)), "%s %.17g at %.17g: %.17g", row->name,
                  x, z, to);
        const bias_push push = remedy_push(&setup, row, x, lo, hi);
        TALLY(&worth, -remedy_at(&setup, row, x, z).shift <= push.shift * (1.0 + 1e-9) + 1e-300,
              "%s: %.17g at %.17g is more than %.17g", row->name, -remedy_at(&setup, row, x, z).shift, z, push.shift);
        const double most = i % 2 == 0 ? pushed_most(&setup, row, x, lo, hi) : push.shift;
        TALLY(&worth, most <= push.shift * (1.0 + 1e-9) + 1e-300 && most >= push.shift * (1.0 - 1e-9),
              "%s: at most %.17g, not %.17g", row->name, push.shift, most);
    }
    for (size_t i = 0; i + 1 < remedy_table.count; i++) {
        print_message("# %s: %llu enough, %llu not, %llu not proven\n", remedy_get(i)->name,
                      (unsigned long long)answers[i][BIAS_ENOUGH], (unsigned long long)answers[i][BIAS_NOT_ENOUGH],
                      (unsigned long long)answers[i][BIAS_NOT_PROVEN]);
        assert_true(answers[i][BIAS_ENOUGH] > 5 && answers[i][BIAS_NOT_ENOUGH] > 5);
    }
    assert_true(sloped[BIAS_ENOUGH] > 20 && sloped[BIAS_NOT_ENOUGH] > 20);
    tally_end(&enough);
    tally_end(&witness);
    tally_end(&worth);
}

/* The steepest slope is one at which it is enough, as is one below; not one a little above. */
TEST(steepest) {
    rng r = rng_make("steepest");
    tally t = {.name = "steepest"};
    for (uint64_t i = test_cases(100, 1000, 10000); i > 0;) {
        dp_setup setup;
        double lo, hi;
        const remedy *row = remedy_get((size_t)rng_below(&r, remedy_table.count - 1));
        if (!draw_setup(&r, &setup, &lo, &hi) || !remedy_suits(row, &setup))
            continue;
        i--;
        const bias_goal none = {.slope = 0.0};
        const double least = remedy_judge(&setup, row, row->grows ? row->least : row->most, &none, lo, hi).units;
        const double x = draw_amount(&r, row, least), found = remedy_steepest(&setup, row, x, 0.0, lo, hi);
        const bool facing = remedy_judge(&setup, row, x, &none, lo, hi).answer == BIAS_ENOUGH;
        TALLY(&t, isnan(found) == (row->parallel || !facing), "%s %g: %g", row->name, x, found);
        const double tried[3] = {found, found * rng_uniform(&r, 0.0, 1.0), found * 1.001};
        for (int k = 0; k < 3 && found > 1e-15 * hi && found < hi; k++) {
            const bias_goal goal = {.slope = tried[k]};
            TALLY(&t, (remedy_judge(&setup, row, x, &goal, lo, hi).answer == BIAS_ENOUGH) == (k < 2),
                  "%s %g: %g beside %g", row->name, x, tried[k], found);
        }
    }
    assert_true(isnan(remedy_steepest(&(dp_setup){.kappa = 1.0}, remedy_find("stencil"), 0.0, 0.0, 1.0, 2.0)));
    tally_end(&t);
}

/* ---- By hand ----------------------------------------------------------------------------------------------------- */

/* A constant pull of NDC that is .5 at 20 is 195 at 500: 1/z' = 1/z + c. */
TEST(by_hand) {
    const double near = 0.1, far = 1000.0, c = 1 / 19.5 - 1 / 20.0, e = 2 * c / (1 / near - 1 / far);
    json_t *root = json_printed(0, "bias -F d24 -m gl --remedy ndc:%.17g --at 20,500", e);
    assert_relative(number_at(root, "setups[0].rows[0].shift"), -0.5, 1e-12);
    assert_relative(number_at(root, "setups[0].rows[1].shift"), 500 / (1 + 500 * c) - 500, 1e-12);
    assert_true(fabs(number_at(root, "setups[0].rows[1].shift") + 195) < 0.5);
    json_decref(root);
    check_says(0, "Enough facing the camera", "bias -F d24 -m d3d --remedy normal:0.0597 --at 1,223 --check");
    check_says(1, "Not enough facing", "bias -F d24 -m d3d --remedy normal:0.01 --range 1:500 --check");
    check_says(1, "clips the layer", "bias -F d24 -m d3d --remedy ndc:0.5 --range .1:1 --check");
    check_says(0, "without a depth test", "bias -F d24 -m d3d --remedy stencil --range 1:500 --check");
    check_says(0, "Enough", "bias -F fp32 -m log --remedy ray:1e-3 --range 1:500 --check");
    static const refused_row rows[] = {{"--remedy ndc", "ndc:X", 2},
                                       {"--remedy ndc:3", "from 0 to 2", 2},
                                       {"--remedy stencil:1", "no number", 2},
                                       {"--remedy glue:1", "ndc", 2},
                                       {"--remedy ndc:1 --units 2", "--remedy", 2},
                                       {"--remedy ndc:1 --viewport 64x64", "--remedy", 2},
                                       {"--remedy normal:1 --slope 1", "'slanted' of table --viewport", 2}};
    CHECK_REFUSED("bias -F d24 -m d3d", rows);
    check_says(2, "has no effect with log", "bias -F d24 -m log --remedy ndc:1e-5");
    check_says(2, "orthographic", "bias -F d24 -m d3d --ortho --remedy ray:1e-5");
}

/* Just at the near plane a layer is not clipped, and before it, it is: near 1 and no far plane, of a wall at 2. */
TEST(clipped_before_near) {
    static const struct {
        const char *name;
        double amount;
    } rows[] = {{"ndc", 0.5}, {"ray", 0.5}, {"normal", 1.0}, {"near", 2.0}};
    for (size_t i = 0; i < 2 * sizeof rows / sizeof rows[0]; i++) {
        dp_spec spec = dp_spec_default();
        dp_setup setup;
        const remedy *row = remedy_find(rows[i / 2].name);
        spec.znear = 1.0;
        spec.zfar = INFINITY;
        spec.mapping = i % 2 == 0 ? DP_MAPPING_D3D : DP_MAPPING_REVERSED;
        assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
        const bias_effect at = remedy_at(&setup, row, rows[i / 2].amount, 2.0);
        assert_true(!at.limited && at.depth == (setup.reversed ? 1.0 : 0.0));
        assert_true(remedy_at(&setup, row, rows[i / 2].amount, 2.0 - 1e-9).limited);
        assert_true(!remedy_at(&setup, row, rows[i / 2].amount, 2.0 + 1e-9).limited);
        /* A near plane of its own that lies beyond far clips all of it. */
        spec.zfar = 10.0;
        assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
        for (double z = 1.0; z <= 10.0; z += 0.5)
            assert_true(remedy_at(&setup, remedy_find("near"), 20.0, z).limited);
    }
}

/* D24, near .1, far 1000: at z a slope of s is s n f/((f - n) z^2) of window depth, which the pull has to cover beside
 * a code and three halves of a step of binary32. */
TEST(by_hand_at_a_slant) {
    const double kappa = 1 / 0.1 - 1 / 1000.0, code = 1 / 16777215.0 + 3 * 0x1p-25 + 0x1p-26;
    json_t *root = json_printed(0, "bias -F d24 -m gl --remedy ndc:1e-4 --range 2:50");
    const double steepest = number_at(root, "setups[0].facing.steepest"), all = 5e-5 * kappa * 4;
    assert_true(steepest < all && steepest > (5e-5 - 2 * code) * kappa * 4);
    json_decref(root);
    check_says(0, "Enough facing the camera and at the slope",
               "bias -F d24 -m gl --remedy ndc:1e-4 --range 2:50 --slope %.17g --check", 0.99 * all);
    check_says(1, "not enough at the slope", "bias -F d24 -m gl --remedy ndc:1e-4 --range 2:50 --slope %.17g --check",
               1.001 * all);
    root = json_printed(0, "bias -F d24 -m gl --remedy ray:0.001 --range 1:2"); /* 1/(1/z - s/z^2) (1 - e) is z */
    const double of_ray = number_at(root, "setups[0].facing.steepest");
    assert_true(of_ray < 0.001 && of_ray > 0.001 - 2 * code * kappa);
    json_decref(root);
}

/* The least is told so that it is enough as it is printed. */
TEST(told_is_enough) {
    static const char *const names[] = {"ndc", "ray", "normal", "near", "range"};
    for (int i = 0; i < 5; i++) {
        json_t *root =
            json_printed(0, "bias -F d24 -m gl --remedy %s:%s --range 1:300", names[i], i == 3 || i == 4 ? "1" : "0");
        check_says(0, "Enough", "bias -F d24 -m gl %s --range 1:300 --check", text_at(root, "setups[0].facing.call"));
        json_decref(root);
    }
}

/* One is a unit, either way, and two are units. */
TEST(one_unit) {
    check_says_all(0, "bias -n 1 -f 10 --api metal -F fp32 -m reversed --range 2:3", SAID(" 1 unit from", "!1 units"));
    check_says_all(0, "bias -n 1 -f 10 --api metal -F fp32 -m d3d --range 2:3", SAID("-1 unit from", "!1 units"));
    check_says_all(0, "bias -n 1 -f 10 --api d3d11 -F d24 -m d3d --range 2:3", SAID("-2 units from"));
}

/* A limit of biases is said where it applies, and nowhere else. */
TEST(limits_where_they_apply) {
    check_says_all(0, "bias --api d3d11 -F fp32 -m reversed --units 2 --range 1:100",
                   SAID("r doubles", "!triangles alone", "!no infinity"));
    check_says_all(0, "bias --api d3d11 -F fp32 -m reversed --units 2 --range 1:1.01", SAID("!r doubles"));
    check_says_all(0, "bias --api d3d11 -F d24 -m d3d --units 2 --full",
                   SAID("triangles alone", "centroid", "!r doubles"));
    check_says_all(0, "bias --api d3d11 -F d24 -m d3d --units -inf", SAID("no infinity"));
    check_says_all(0, "bias --api vulkan -F d24 -m d3d --units -inf", SAID("!no infinity"));
    check_says_all(0, "bias --api vulkan -F d24 -m d3d --units -9 --clamp=-1 --viewport 640x480",
                   SAID("the clamp holds the sum"));
    check_says_all(0, "bias --api vulkan -F d24 -m d3d --units -9 --clamp=-1", SAID("!the clamp holds the sum"));
    /* Who writes the depth: osgEarth's vertices do, and it is interpolated. */
    for (unsigned m = 0; m < DP_MAPPING_COUNT; m++) {
        dp_spec spec = dp_spec_default();
        dp_setup setup;
        spec.mapping = (dp_mapping)m;
        assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
        assert_int_equal(bias_is_missed(&setup), m >= DP_MAPPING_LINEAR && m != DP_MAPPING_OSGEARTH);
    }
}
