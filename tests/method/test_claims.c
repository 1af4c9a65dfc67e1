/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Claims of methods from both sides. Of linearizations: the roundings of their operations, counted here by propagating
 * the worst error of each, first order. Of positions: the bound at the worst pixel, which has tests of its own.
 */
#include "method/bench.h"
#include "named.h"
#include "shader/position.h"
#include "support.h"

/* ---- Roundings --------------------------------------------------------------------------------------------------- */

/* A value and how far it may be off, in units of 2^-24 of the value's own measure. */
typedef struct term {
    long double v, off;
} term;

static term exact(long double v) {
    return (term){v, 0};
}
static term once(long double v) { /* a constant, rounded */
    return (term){v, fabsl(v)};
}
static term rounded(long double v, long double off) {
    return (term){v, off + fabsl(v)};
}
static term plus(term a, term b) {
    return rounded(a.v + b.v, a.off + b.off);
}
static term times(term a, term b) {
    return rounded(a.v * b.v, fabsl(a.v) * b.off + fabsl(b.v) * a.off);
}
static term over(term a, term b) {
    return rounded(a.v / b.v, a.off / fabsl(b.v) + fabsl(a.v / b.v / b.v) * b.off);
}

typedef struct view {
    long double n, f, d; /* d: window depth */
    bool reversed;
} view;

static term towards_near(const view *v) {
    return v->reversed ? exact(v->d) : rounded(1 - v->d, 0);
}
static term unity(const view *v) {
    const long double z = 1 / v->n - 1 / v->f;
    return over(exact(1),
                plus(times(once(v->reversed ? z : -z), exact(v->d)), once(v->reversed ? 1 / v->f : 1 / v->n)));
}
static term complement_unity(const view *v) {
    return over(exact(1), plus(times(once(1 / v->n - 1 / v->f), towards_near(v)), once(1 / v->f)));
}
static term textbook_slope(const view *v) {
    return once(v->reversed ? v->f - v->n : v->n - v->f);
}
static term textbook(const view *v) {
    return over(once(v->n * v->f), plus(once(v->reversed ? v->n : v->f), times(textbook_slope(v), exact(v->d))));
}
static term fused(const view *v) {
    term product = textbook_slope(v);
    product.v *= v->d;
    product.off *= v->d;
    return over(once(v->n * v->f), plus(once(v->reversed ? v->n : v->f), product));
}
static term complement_divisor(const view *v) {
    return plus(once(v->n), times(once(v->f - v->n), towards_near(v)));
}
static term complement(const view *v) {
    return over(once(v->n * v->f), complement_divisor(v));
}
/* The estimate's 1.5 2^-12 squared; x y and 2 - x y, one of which is below 1. */
static term newton(const view *v) {
    const term x = complement_divisor(v);
    const long double y = 1 / x.v;
    return times(once(v->n * v->f), rounded(y, y * (x.off / x.v + 2.25L + 1.5L)));
}
static term linear_01(const view *v) { /* reversed: X and Y = 1 do not cancel */
    const long double x = (v->f - v->n) / v->n;
    return times(once(v->f), over(exact(1), plus(times(once(x), exact(v->d)), exact(1))));
}

static const struct {
    const char *name;
    term (*count)(const view *);
    bool standard, reversed; /* which are counted so */
} counted[] = {
    {"unity", unity, true, true},           {"complement-unity", complement_unity, true, false},
    {"textbook", textbook, true, true},     {"fused", fused, true, true},
    {"complement", complement, true, true}, {"complement-newton", newton, true, true},
    {"linear-01", linear_01, false, true},
};

/* The most units that a depth of a set-up is off by: at the planes and in between. */
static double most_units(term (*count)(const view *), double ratio, bool reversed) {
    double most = 0;
    for (int k = 0; k <= 64; k++) {
        const long double z = powl((long double)ratio, k / 64.0L), phi = 1 / (long double)ratio;
        const long double near_share = (1 / z - phi) / (1 - phi);
        const view v = {1, (long double)ratio, reversed ? near_share : 1 - near_share, reversed};
        const term t = count(&v);
        most = fmax(most, (double)(t.off / fabsl(t.v)));
    }
    return most;
}

/* A claim is e/(1 - e) of what is counted where the divisor cancels, and what is counted where nothing does. */
TEST(linearize_claims_are_their_roundings) {
    const method_family_row *family = method_family_find("linearize");
    tally t = {.name = "roundings"};
    for (size_t i = 0; i < sizeof counted / sizeof counted[0]; i++)
        for (size_t m = 0; m < *family->method_count; m++)
            for (int reversed = 0; reversed < 2; reversed++) {
                const method_row *row = &family->methods[m];
                const method_claim *c = &row->claims[reversed];
                double least = (double)INFINITY;
                if (strcmp(row->name, counted[i].name) != 0 || !(reversed ? counted[i].reversed : counted[i].standard))
                    continue;
                for (double ratio = 10; ratio <= c->ratio_hi; ratio *= 10) {
                    const double units = most_units(counted[i].count, ratio, reversed != 0) * 0x1p-24;
                    const double want = c->formula != NULL ? units / (1 - units) : units;
                    const double claim = method_claim_at(c, ratio);
                    TALLY(&t, claim >= want * (1 - 1e-9), "%s %d, far/near %g: %g U claimed, %g U counted", row->name,
                          reversed, ratio, claim * 0x1p24, want * 0x1p24);
                    least = fmin(least, claim / want);
                    TALLY(&t, c->formula == NULL || claim <= want * 1.001, "%s %d, far/near %g: %g U, %g U counted",
                          row->name, reversed, ratio, claim * 0x1p24, want * 0x1p24);
                }
                TALLY(&t, least <= 1.001, "%s %d: %g times what is counted", row->name, reversed, least);
            }
    tally_end(&t);
}

/* ---- Intervals, of every code ------------------------------------------------------------------------------------ */

/* The depth of a window depth, as the pair (d, 1 - d), and the ends of a cell: half-way to the codes beside it. */
static long double eye_of(long double n, long double f, bool reversed, long double d, long double rest) {
    return n / (reversed ? d + n / f * rest : n / f * d + rest);
}

static void cell_of(const dp_setup *s, uint32_t code, long double z[2]) {
    const dp_format *f = &s->spec.format;
    const bool unorm = f->kind == DP_FORMAT_UNORM;
    for (int i = 0; i < 2; i++) {
        const uint32_t other = i == 0 ? code - 1 : code + 1;
        const long double one = unorm ? 2.0L * f->code_max : 2;
        const long double sum = unorm ? 2.0L * code + (i == 0 ? -1 : 1)
                                      : (long double)dp_format_value(f, code) + (long double)dp_format_value(f, other);
        z[i] = eye_of((long double)s->spec.znear, (long double)s->spec.zfar, s->reversed, sum / one, (one - sum) / one);
    }
    if (z[0] > z[1]) {
        const long double swap = z[0];
        z[0] = z[1];
        z[1] = swap;
    }
}

/* z1 z2 (1/n - 1/f) times the share of d, whose digits are all good. */
static long double width_of(const dp_setup *s, uint32_t code, const long double z[2]) {
    const dp_format *f = &s->spec.format;
    const long double share =
        f->kind == DP_FORMAT_UNORM
            ? 1 / (long double)f->code_max
            : ((long double)dp_format_value(f, code + 1) - (long double)dp_format_value(f, code - 1)) / 2;
    return z[0] * z[1] * (1 / (long double)s->spec.znear - 1 / (long double)s->spec.zfar) * share;
}

/* The worst error of a method over all codes but the two at the planes, at both ends of each cell and inside. */
static double worst_of_codes(const method_row *row, const dp_setup *s) {
    double worst = 0, z[3], value[3];
    const method_inputs in = {.count = 3, .z = z};
    const method_outputs out = {.value = value};
    for (uint32_t code = 1; code < s->spec.format.code_max; code++) {
        long double ends[2];
        cell_of(s, code, ends);
        const long double width = width_of(s, code, ends);
        for (int i = 0; i < 3; i++)
            z[i] = (double)(ends[0] + (ends[1] - ends[0]) * ((long double)i * 0.499L + 0.001L));
        row->run(&(method_call){row, s, NULL, &in, &out});
        for (int i = 0; i < 3; i++)
            if (dp_code(s, z[i]) == code)
                worst = fmax(worst, fabs((double)(((long double)value[i] - width) / width)));
    }
    return worst;
}

/* All codes of both formats of 16 bits, up to the greatest far/near that claims speak of. */
TEST(interval_claims_hold_for_every_code) {
    const method_family_row *family = method_family_find("interval");
    tally t = {.name = "codes"};
    for (size_t which = 2; which < 4; which++)
        for (double ratio = 1e12; ratio >= 9.9; ratio /= (double)test_cases(1000, 100, 10))
            for (size_t i = 0; i < *family->method_count; i++) {
                const method_row *row = &family->methods[i];
                const double znear = pow(10, 6 * method_unit(71, i + (size_t)log10(ratio) * 16) - 3);
                dp_setup s;
                if (!method_speaks(row, which))
                    continue;
                assert_int_equal(method_setup(family, which, znear, ratio * znear, false, &s), DP_OK);
                const double error = worst_of_codes(row, &s), claim = method_claimed(row, which, &s);
                TALLY(&t, error <= claim && error >= (strcmp(row->name, "cell") == 0 ? 0.1 : 0.4) * claim,
                      "%s, %s, near %a, far/near %g: %g, claimed %g", row->name, family->cases[which].name, znear,
                      ratio, error, claim);
            }
    tally_end(&t);
}

/* ---- Positions --------------------------------------------------------------------------------------------------- */

/* The worst of position_bound() over the image's border, middle and depths, over the distance from the camera. */
static double worst_place(const char *name, const dp_setup *setup, double yaw, double pitch) {
    const position_row *row = position_find(name);
    camera_spec spec = camera_spec_default();
    texture_camera camera;
    double worst = 0;
    spec.width = 1024;
    spec.height = 576;
    spec.yaw = yaw;
    spec.pitch = pitch;
    spec.half_height = setup->spec.znear;
    assert_null(camera_init(&camera, setup, &spec));
    for (uint32_t y = 0; y < 576; y += y < 544 ? 32 : 31)
        for (uint32_t x = 0; x < 1024; x += x < 992 ? 32 : 31)
            for (int k = 0; k <= 16; k++) {
                const double z = setup->spec.znear * pow(setup->spec.zfar / setup->spec.znear, k / 16.0);
                const float d = (float)dp_window(setup, z);
                double at[3];
                position_exact(&camera, y, x, (double)d, at, NULL);
                const double distance = sqrt(at[0] * at[0] + at[1] * at[1] + at[2] * at[2]);
                worst = fmax(worst, position_bound(row, &camera, x, y, d) / distance);
            }
    return worst;
}

/* In directions where they are worst, of a grid of 5 degrees. */
TEST(position_claims_are_their_bounds) {
    static const double hard[3][2] = {{25, 0}, {30, 25}, {35, 55}};
    const method_family_row *family = method_family_find("position");
    tally t = {.name = "bounds"};
    for (size_t m = 0; m < *family->method_count; m++) {
        const method_row *row = &family->methods[m];
        for (size_t which = 0; which < family->case_count; which++) {
            const method_claim *c = &row->claims[which];
            double least = (double)INFINITY;
            if ((row->domain & METHOD_HALF) != 0 || (strcmp(row->name, "matrix") == 0 && which != 1))
                continue; /* in steps of binary16; claimed as measured */
            for (double ratio = 10; ratio <= fmin(c->ratio_hi, 1e6); ratio *= 10) {
                dp_setup setup;
                assert_int_equal(method_setup(family, which, 0.1, 0.1 * ratio, false, &setup), DP_OK);
                const double claim = method_claim_at(c, ratio);
                double bound = 0;
                for (size_t k = 0; k < sizeof hard / sizeof hard[0]; k++)
                    bound = fmax(bound, worst_place(row->name, &setup, hard[k][0], hard[k][1]));
                TALLY(&t, claim >= 0.9999 * bound, "%s %zu, far/near %g: claim %g U, bound %g U", row->name, which,
                      ratio, claim * 0x1p24, bound * 0x1p24);
                least = fmin(least, claim / bound);
                TALLY(&t, c->formula == NULL || claim <= 1.1 * bound, "%s %zu, far/near %g: claim %g U, bound %g U",
                      row->name, which, ratio, claim * 0x1p24, bound * 0x1p24);
            }
            TALLY(&t, least <= 1.1, "%s %zu: %g times the bound", row->name, which, least);
        }
    }
    tally_end(&t);
}

/* ---- The hardest set-ups known ----------------------------------------------------------------------------------- */

static void check_hard(const vector_row *line, void *context) {
    tally *t = context;
    const method_family_row *family = method_family_find(vector_text(line, 0));
    const size_t which = (size_t)vector_number(line, 2);
    method_inputs in;
    method_outputs out;
    measured m;
    dp_setup setup;
    assert_non_null(family);
    assert_int_equal(method_setup(family, which, vector_number(line, 3), vector_number(line, 4), false, &setup), DP_OK);
    assert_true(method_arrays(2 * family->walked, &in, &out));
    family->fill(&setup, &in);
    for (size_t i = 0; i < *family->method_count; i++) {
        const method_row *row = &family->methods[i];
        if (strcmp(row->name, vector_text(line, 1)) != 0)
            continue;
        assert_true(method_measure(family, row, &setup, &in, &out, &m));
        const double error = measured_error(family, &m), claim = method_claimed(row, which, &setup);
        TALLY(t, error <= claim && error >= 0.97 * vector_number(line, 5) * claim, "%s, line %d: %g of the claim %g",
              row->name, line->line, error, claim);
    }
    method_arrays_free(&in, &out);
}

TEST(the_hardest_set_ups_need_the_claims) {
    tally t = {.name = "hardest"};
    vectors_read("claims.txt", check_hard, &t);
    tally_end(&t);
}
