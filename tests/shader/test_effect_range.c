/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The range check of ambient occlusion on a plane: every difference that two stored depths of it can have is written
 * down, and bias and radius are held to that list.
 */
#include "named.h"
#include "support.h"

typedef struct camera {
    int bits;
    dp_mapping mapping;
    long double n, f;
    dp_setup setup;
} camera;

static camera any_camera(rng *r) {
    static const dp_mapping mappings[] = {DP_MAPPING_D3D, DP_MAPPING_REVERSED, DP_MAPPING_LINEAR};
    camera c = {.bits = 6 + (int)rng_below(r, 15), .mapping = mappings[rng_below(r, 3)]};
    char name[16];
    dp_format formats[2];
    dp_spec spec = dp_spec_default();
    snprintf(name, sizeof name, "unorm%d", c.bits);
    assert_true(dp_format_parse(name, formats) >= 1);
    spec.format = formats[0];
    spec.mapping = c.mapping;
    spec.znear = rng_log(r, 0.1, 2);
    spec.zfar = spec.znear * rng_log(r, 10, 1000);
    assert_int_equal(dp_setup_init(&c.setup, &spec), DP_OK);
    c.n = (long double)spec.znear;
    c.f = (long double)spec.zfar;
    return c;
}

static long double codes_of(const camera *c) {
    return ldexpl(1, c->bits) - 1;
}

/* From near, so that they grow with the depth whichever way the buffer runs. */
static long double eye_of(const camera *c, long double steps) {
    const long double d = steps / codes_of(c);
    return c->mapping == DP_MAPPING_LINEAR ? c->f * d : 1 / ((1 - d) / c->n + d / c->f);
}

static long double steps_of(const camera *c, long double z) {
    const long double d = c->mapping == DP_MAPPING_LINEAR ? z / c->f : c->f / (c->f - c->n) * (z - c->n) / z;
    return d * codes_of(c);
}

enum { MOST = 4000 };

/* Takes a pixel in the cell of `steps` and another `slope` behind it. @return how many; 0 where that is too many, or
 * where rounding would decide which */
static int differences_of(const camera *c, long double steps, long double slope, long double out[MOST]) {
    const long double ends[2] = {steps_of(c, eye_of(c, steps - 0.5L) + slope),
                                 steps_of(c, eye_of(c, steps + 0.5L) + slope)};
    const long double first = floorl(ends[0] + 0.5L), last = floorl(ends[1] + 0.5L);
    for (int i = 0; i < 2; i++)
        if (fabsl(ends[i] - floorl(ends[i]) - 0.5L) < 1e-5L)
            return 0;
    if (last - first >= MOST || last > codes_of(c) - 1)
        return 0;
    int count = 0;
    for (long double k = first; k <= last; k++)
        out[count++] = eye_of(c, k) - eye_of(c, steps);
    return count;
}

static bool occluded(const long double *apart, int count, long double bias, long double radius) {
    bool any = false;
    for (int i = 0; i < count; i++)
        any = any || (apart[i] > bias && apart[i] < radius);
    return any;
}

/* As large as was said it has no error, a larger one has; and a bias that is a difference itself lets that one pass,
 * not the next. @return whether it is all of the range */
static bool check_ceiling(tally *t, const effect_row *row, const effect_view *view, const double *given, double z,
                          double ceiling) {
    const int bias = parameter_find(row->parameters, "bias"), radius = parameter_find(row->parameters, "radius");
    const bool all = ceiling == row->parameters[radius].hi;
    double p[PARAMETERS_MAX];
    memcpy(p, given, sizeof p);
    p[radius] = ceiling;
    TALLY(t, effect_error(row, view, p, z) == 0, "z %a bias %a: not up to %a", z, p[bias], ceiling);
    p[radius] = nextafter(ceiling, INFINITY);
    TALLY(t, all || effect_error(row, view, p, z) == 255, "z %a bias %a: beyond %a, too", z, p[bias], ceiling);
    p[bias] = ceiling;
    TALLY(t, all || effect_ceiling(row, view, p, z) > ceiling, "z %a bias %a: no larger radius", z, ceiling);
    return all;
}

TEST(test_range) {
    static long double apart[MOST];
    const effect_row *row = effect_find("ambient-occlusion");
    const int bias_at = parameter_find(row->parameters, "bias"), radius_at = parameter_find(row->parameters, "radius");
    rng r = rng_make("range checks");
    tally t = {.name = "range checks"};
    uint64_t every = 0, between = 0, some = 0;
    for (uint64_t i = 0; i < test_cases(8000, 40000, 400000); i++) {
        const camera c = any_camera(&r);
        const effect_view view = {.setup = &c.setup};
        const long double steps =
            floorl(steps_of(&c, (long double)rng_log(&r, c.setup.spec.znear * 1.2, c.setup.spec.zfar * 0.99)));
        const long double width = eye_of(&c, steps + 0.5L) - eye_of(&c, steps - 0.5L);
        const double slope = rng_below(&r, 6) == 0 ? 0 : (double)width * rng_log(&r, 0.05, 30);
        const double z = (double)eye_of(&c, steps);
        double p[PARAMETERS_MAX];
        const int count = differences_of(&c, steps, (long double)slope, apart);
        if (count == 0 || eye_of(&c, steps - 0.5L) < c.n) {
            t.skipped++;
            continue;
        }
        const double around = fmax((double)apart[rng_below(&r, (uint64_t)count)], (double)width / 8);
        parameter_defaults(row->parameters, p);
        p[parameter_find(row->parameters, "slope")] = slope;
        p[bias_at] = around * rng_uniform(&r, 0.2, 1.2);
        p[radius_at] = p[bias_at] + (double)width * rng_log(&r, 0.05, 20);
        long double bias = 0, radius = (long double)row->parameters[radius_at].hi;
        bool close = false;
        for (int k = count - 1; k >= 0; k--) {
            radius = apart[k] > (long double)p[bias_at] ? apart[k] : radius;
            close = close || fabsl(apart[k] - (long double)p[bias_at]) < 1e-9L * eye_of(&c, steps) ||
                    fabsl(apart[k] - (long double)p[radius_at]) < 1e-9L * eye_of(&c, steps);
        }
        for (int k = 0; k < count; k++)
            bias = apart[k] < (long double)p[radius_at] ? fmaxl(apart[k], bias) : bias;
        if (close) {
            t.skipped++;
            continue;
        }
        const bool wrong = occluded(apart, count, (long double)p[bias_at], (long double)p[radius_at]);
        const double usable = effect_usable(row, &view, p, z, 1), ceiling = effect_ceiling(row, &view, p, z);
        const double slack = 1e-11 * z;
        TALLY(&t, effect_error(row, &view, p, z) == (wrong ? 255.0 : 0.0), "%s z %a slope %a: %a to %a", row->name, z,
              slope, p[bias_at], p[radius_at]);
        TALLY(&t, fabsl((long double)usable - bias) <= (long double)slack, "z %a slope %a radius %a: bias %a, not %La",
              z, slope, p[radius_at], usable, bias);
        TALLY(&t, fabsl((long double)ceiling - radius) <= (long double)slack,
              "z %a slope %a bias %a: radius %a, not %La", z, slope, p[bias_at], ceiling, radius);
        const bool all = check_ceiling(&t, row, &view, p, z, ceiling);
        every += all;
        some += wrong;
        between += !wrong && !all && bias > 0;
    }
    print_message("# %llu with any radius, %llu between two differences, %llu wrong\n", (unsigned long long)every,
                  (unsigned long long)between, (unsigned long long)some);
    assert_true(every > 100 && between > 100 && some > 100);
    tally_end(&t);
}

/* Who has none; and a plane that leaves the far plane, which is not seen. */
TEST(test_without) {
    dp_spec spec = dp_spec_default();
    dp_setup setup;
    const effect_row *row = effect_find("ambient-occlusion");
    const effect_view view = {.setup = &setup};
    double p[PARAMETERS_MAX];
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    parameter_defaults(effect_find("edge")->parameters, p);
    assert_true(isnan(effect_ceiling(effect_find("edge"), &view, p, 10)));
    parameter_defaults(row->parameters, p);
    p[parameter_find(row->parameters, "slope")] = 5;
    assert_true(effect_ceiling(row, &view, p, 999) == 1e12);
    assert_true(effect_ceiling(row, &view, p, 10) < 5.001);
    /* Behind an infinite far plane lies no last difference. */
    spec.zfar = INFINITY;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    p[0] = 6;
    for (double z = 1; z < 1e30; z *= 10) {
        const double ceiling = effect_ceiling(row, &view, p, z);
        p[1] = ceiling;
        assert_true(effect_error(row, &view, p, z) == 0);
        p[1] = nextafter(ceiling, INFINITY);
        assert_true(ceiling == 1e12 || effect_error(row, &view, p, z) == 255);
    }
}
