/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * World positions through view and projection: no separation is below what a search finds, and none is far above; and
 * each of the errors that it is made of alone.
 */
#include "composed.h"
#include "core/composition.h"

/* ---- Tests ------------------------------------------------------------------------------------------------------- */

static const double worlds[] = {1e2, 1e4, 1e6};
static const double nears[] = {0.1, 0.05};
static const double fars[] = {1000, 10000, HUGE_VAL};
static const char *const formats[] = {"fp32", "unorm24"};

/* Where no separation is promised, surfaces many times as far away must be found tied or swapped. */
TEST(within_four_times) {
    rng r = rng_make("composition");
    tally never = {.name = "never below"};
    tally tight = {.name = "within 4 times"};
    tally none = {.name = "no separation"};
    for (int k = 0; k < DP_COMPOSITION_COUNT; k++) {
        double least = 1.0, sum = 0.0, count = 0.0;
        for (int i = 0; i < 3 * 2 * 3 * 2 * 2 * 4; i++) {
            const double z = (const double[]){1.0, 7.0, 60.0, 300.0}[i / 72];
            const double world = worlds[i % 3], n = nears[i / 3 % 2], f = fars[i / 6 % 3];
            const dp_mapping mapping = i / 36 % 2 ? DP_MAPPING_REVERSED : DP_MAPPING_D3D;
            set_up s;
            assert_true(composed_make(&s, n, f, mapping, formats[i / 18 % 2], rng_below(&r, 2), false,
                                      (dp_budget_terms){.world = world, .composition = (dp_composition)k}));
            if (z > world)
                continue;
            const double bound = composed_separation_at(&s, z);
            const found most = composed_search(&r, &s, z, isinf(bound) ? 0.0 : 0.26, test_cases(1, 4, 100));
            char text[160];
            snprintf(text, sizeof text, "%s: %s %s, near %g, far %g, world %g",
                     dp_composition_get((dp_composition)k)->name, dp_mapping_get(mapping)->name, formats[i / 18 % 2], n,
                     f, world);
            if (isinf(bound)) {
                TALLY(&none, most.gap > fmin(10.0 * z, 0.5 * (f - z)) || test_effort() == EFFORT_QUICK,
                      "%s: z = %g: %g found", text, z, most.gap);
                continue;
            }
            TALLY(&never, most.ratio < 1.0, "%s: z = %a: %g of %g", text, most.z, most.gap, most.bound);
            TALLY(&tight, most.ratio > 0.25 || test_effort() == EFFORT_QUICK, "%s: z = %g: %g of %g", text, z, most.gap,
                  most.bound);
            sum += 1.0 / most.ratio;
            count += 1.0;
            least = fmin(least, most.ratio);
        }
        printf("# %s: bound/found at most %.2f, %.2f in the mean of %g\n", dp_composition_get((dp_composition)k)->name,
               1.0 / least, sum / count, count);
    }
    tally_end(&never);
    tally_end(&tight);
    tally_end(&none);
}

/* Every mapping, arithmetic, composition and projection. */
TEST(random_set_ups) {
    rng r = rng_make("composed set-ups");
    tally never = {.name = "random set-ups"};
    found worst = {0};
    for (uint64_t i = test_cases(100, 3000, 300000); i > 0; i--) {
        const double n = rng_log(&r, 0.01, 10.0);
        const bool ortho = rng_below(&r, 4) == 0;
        const double f = !ortho && rng_below(&r, 4) == 0 ? HUGE_VAL : n * rng_log(&r, 1.5, 1e5);
        const dp_composition composition = (dp_composition)rng_below(&r, DP_COMPOSITION_COUNT);
        const double largest = composition == DP_COMPOSITION_RELATIVE ? 1e16 : 1e7;
        const dp_budget_terms terms = {.world = n * rng_log(&r, 4.0, largest), .composition = composition};
        const double end = fmin(f, 0.7 * terms.world);
        set_up s;
        if (!composed_make(&s, n, f, (dp_mapping)rng_below(&r, 4),
                           (const char *[]){"fp32", "unorm24", "unorm16"}[rng_below(&r, 3)],
                           rng_below(&r, dp_arith_count()), ortho, terms))
            continue;
        const double z = rng_below(&r, 8) ? rng_log(&r, n, end) : rng_below(&r, 2) ? n : end * (1.0 - 1e-6);
        const double bound = composed_separation_at(&s, z);
        const found most = composed_search(&r, &s, z, 0.0, 1);
        TALLY(&never, isinf(bound) || most.ratio < 1.0,
              "%s %s %s %s%s, near %.17g, far %.17g, world %.17g: z = %a: %g of %g",
              dp_composition_get(terms.composition)->name, dp_mapping_get(s.setup.spec.mapping)->name,
              s.setup.spec.format.name, s.arith->name, ortho ? " ortho" : "", n, f, terms.world, most.z, most.gap,
              most.bound);
        if (isfinite(bound) && most.ratio > worst.ratio)
            worst = most;
    }
    printf("# random set-ups: at most %.3f of a bound used\n", worst.ratio);
    tally_end(&never);
}

/* Orthographic cameras with depths of 0 and less. */
TEST(depths_of_either_sign) {
    rng r = rng_make("composed depths of either sign");
    tally never = {.name = "depths of either sign"};
    tally certain = {.name = "a separation there is"};
    double worst = 0.0;
    for (uint64_t i = test_cases(100, 2000, 100000); i > 0; i--) {
        double n, f;
        set_up s;
        rng_planes(&r, &n, &f);
        const double size = fmax(fabs(n), fabs(f));
        const dp_composition composition = (dp_composition)rng_below(&r, DP_COMPOSITION_COUNT);
        const double largest = composition == DP_COMPOSITION_RELATIVE ? 1e12 : 1e5;
        const dp_budget_terms terms = {.world = fmin(size * rng_log(&r, 4.0, largest), 1e18),
                                       .composition = composition};
        if (!composed_make(&s, n, f, (dp_mapping)rng_below(&r, 4),
                           (const char *[]){"fp32", "unorm24", "unorm16"}[rng_below(&r, 3)],
                           rng_below(&r, dp_arith_count()), true, terms))
            continue;
        const double z = rng_depth(&r, n, f);
        const double bound = composed_separation_at(&s, z);
        TALLY(&certain, isfinite(bound), "near %.17g, far %.17g, world %.17g: z = %a", n, f, terms.world, z);
        if (isinf(bound))
            continue;
        const found most = composed_search(&r, &s, z, 0.0, 1);
        TALLY(&never, most.ratio < 1.0, "%s %s %s %s, near %.17g, far %.17g, world %.17g: z = %a: %g of %g",
              dp_composition_get(terms.composition)->name, dp_mapping_get(s.setup.spec.mapping)->name,
              s.setup.spec.format.name, s.arith->name, n, f, terms.world, most.z, most.gap, most.bound);
        worst = fmax(worst, most.ratio);
    }
    printf("# depths of either sign: at most %.3f of a bound used\n", worst);
    tally_end(&never);
    tally_end(&certain);
    assert_true(worst > 0.5);
}

/* ---- Each cause alone -------------------------------------------------------------------------------------------- */

enum { POSITION, PRODUCTS, SUMS, MATRIX, TURN, CAUSES };
static const char *const causes[CAUSES] = {"position", "products", "sums", "matrix", "turn"};

static void claims(const dp_row_off *row, double out[CAUSES]) {
    const double each[CAUSES] = {row->position, row->products, row->sums, row->entries + row->constant, row->turn};
    memcpy(out, each, sizeof each);
}

/* The error of a row at a point, cause by cause. scale and b: its real value is scale z + b. */
static void row_off(const set_up *s, const camera *c, const float row[4], double scale, double b, double z,
                    double out[CAUSES]) {
    const bool relative = s->terms.composition == DP_COMPOSITION_RELATIVE;
    const bool products = s->terms.composition == DP_COMPOSITION_PRODUCTS && b != 0.0;
    float p[4] = {0};
    long double matrix = 0.0L, turn = 0.0L, rounded = 0.0L, exact = 0.0L, position = 0.0L, t = 0.0L;
    composed_place(s, c, z, p);
    for (int k = 0; k < 3; k++) {
        const long double entry = products ? (long double)(float)c->axis[k] : (long double)c->axis[k];
        const long double at = (long double)c->from[k] + (long double)z * (long double)c->ray[k];
        const long double off = (long double)row[k] - (long double)scale * entry;
        const float product = row[k] * p[k];
        position += (long double)scale * (long double)c->axis[k] *
                    ((long double)p[k] - at + (relative ? (long double)c->eye[k] : 0.0L));
        matrix += off * (long double)p[k];
        turn += off * (long double)c->ray[k];
        exact += (long double)row[k] * (long double)p[k];
        rounded += (long double)product;
        t -= relative ? 0.0L : (long double)c->axis[k] * (long double)c->eye[k];
    }
    t = products ? (long double)(float)t : t;
    matrix += (long double)row[3] - ((long double)scale * t + (long double)b);
    const long double result = (long double)composed_dot(c, row, p, false);
    const long double each[CAUSES] = {position, rounded - exact, result - rounded - (long double)row[3], matrix, turn};
    for (int k = 0; k < CAUSES; k++)
        out[k] = (double)each[k];
}

enum { OWN, SHARED, OWN_TILT, SHARED_TILT, TOTALS };
static const char *const totals[TOTALS] = {"own", "shared", "own tilt", "shared tilt"};

/* The error of the eye depth of the point, from the rows of w and clip z. */
static void eye_off(const dp_composing *in, const double w[CAUSES], const double clip[CAUSES], double out[TOTALS]) {
    /* in `products` clip z is off its product with w's rounded entries, whose own errors cancel */
    const double shared = in->composition == DP_COMPOSITION_PRODUCTS ? 0.0 : in->a * w[MATRIX];
    out[OWN] = w[POSITION] + w[PRODUCTS] + w[SUMS];
    out[SHARED] = w[MATRIX];
    out[OWN_TILT] = (clip[PRODUCTS] + clip[SUMS] - in->a * (w[PRODUCTS] + w[SUMS])) / in->b;
    out[SHARED_TILT] = (clip[MATRIX] - shared) / in->b;
}

static void judge(tally *within, const char *what, double off, double claim, double *most) {
    TALLY(within, fabs(off) <= claim * (1.0 + 0x1p-20), "%s: %g of %g", what, off, claim);
    *most = fmax(*most, fabs(off) / claim);
}

static void report(const char *composition, const char *row, const char *what, double most) {
    printf("# %s, %s %s: at most %.3f\n", composition, row, what, most);
    assert_true(most > 0.5 || test_effort() == EFFORT_QUICK); /* few cases come near */
}

/* No cause is more than its claim, and each somewhere more than half of it: with one halved this fails. */
TEST(each_cause) {
    rng r = rng_make("composition causes");
    tally within = {.name = "causes"};
    for (int k = 0; k < DP_COMPOSITION_COUNT; k++) {
        double most[2][CAUSES] = {{0}}, most_eye[TOTALS] = {0};
        const double world = 1e4, n = 0.1, z = 7.0;
        set_up s;
        composed_make(&s, n, 1000.0, DP_MAPPING_D3D, "fp32", 0, false,
                      (dp_budget_terms){.world = world, .composition = (dp_composition)k});
        const dp_composing in = {.composition = (dp_composition)k,
                                 .ray_ratio = 2.0,
                                 .world = world,
                                 .a = (double)(float)s.a,
                                 .b = (double)(float)s.b,
                                 .zfar = 1000.0,
                                 .reach = 1000.0};
        const dp_composed m = dp_composition_at(&in, z, z);
        const double eye_claim[TOTALS] = {m.own, m.shared, m.own_tilt, m.shared_tilt};
        for (uint64_t i = test_cases(30000, 300000, 10000000); i > 0; i--) {
            const pose p = composed_pose(&r);
            double claim[2][CAUSES], off[2][CAUSES], eye[TOTALS];
            camera c;
            composed_aim(&s, z, &p, &c);
            claims(&m.w, claim[0]);
            claims(&m.clip, claim[1]);
            row_off(&s, &c, c.w, 1.0, 0.0, z, off[0]);
            row_off(&s, &c, c.clip, in.a, in.b, z, off[1]);
            eye_off(&in, off[0], off[1], eye);
            for (int cause = 0; cause < 2 * CAUSES; cause++)
                judge(&within, causes[cause / 2], off[cause % 2][cause / 2], claim[cause % 2][cause / 2],
                      &most[cause % 2][cause / 2]);
            for (int total = 0; total < TOTALS; total++)
                judge(&within, totals[total], eye[total], eye_claim[total], &most_eye[total]);
        }
        const char *name = dp_composition_get((dp_composition)k)->name;
        for (int cause = 0; cause < 2 * CAUSES; cause++)
            report(name, cause % 2 == 0 ? "w" : "z", causes[cause / 2], most[cause % 2][cause / 2]);
        for (int total = 0; total < TOTALS; total++)
            report(name, "eye depth,", totals[total], most_eye[total]);
    }
    tally_end(&within);
}
