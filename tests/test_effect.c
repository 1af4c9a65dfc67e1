/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Effects: errors and usable parameters against formulas written out by hand in long double, and against outputs
 * compared at many depths of a cell; cells are computed here too, from the codes' window depths.
 */
#include <ctype.h>
#include <string.h>

#include "named.h"
#include "support.h"
#include "texture/effect.h"

static size_t count(void) {
    size_t rows = 0;
    while (effect_get(rows) != NULL)
        rows++;
    return rows;
}

static dp_setup setup_of(double znear, double zfar, dp_mapping mapping, const char *format) {
    dp_spec spec = dp_spec_default();
    dp_format found[2];
    dp_setup setup;
    assert_true(dp_format_parse(format, found) >= 1);
    spec.znear = znear;
    spec.zfar = zfar;
    spec.mapping = mapping;
    spec.format = found[0];
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    return setup;
}

/* ---- Cells of UNORM by hand -------------------------------------------------------------------------------------- */

typedef struct cell {
    long double lo, hi, stored;
} cell;

typedef struct camera {
    long double n, f;
    dp_mapping mapping;
    long double most; /* the greatest code */
} camera;

static camera camera_of(const dp_setup *setup) {
    return (camera){setup->spec.znear, setup->spec.zfar, setup->spec.mapping, setup->spec.format.code_max};
}

static long double eye_of(const camera *c, long double code) {
    const long double d = code / c->most, q = (c->most - code) / c->most;
    if (c->mapping == DP_MAPPING_LINEAR)
        return d * c->f;
    const long double s = c->mapping == DP_MAPPING_REVERSED ? d : q, t = c->mapping == DP_MAPPING_REVERSED ? q : d;
    return 1 / (s / c->n + t / c->f);
}

static long double code_of(const camera *c, long double z) {
    long double d = z / c->f;
    if (c->mapping == DP_MAPPING_D3D)
        d = (z - c->n) / z * c->f / (c->f - c->n);
    else if (c->mapping == DP_MAPPING_REVERSED)
        d = (c->f - z) / z * c->n / (c->f - c->n);
    return floorl(d * c->most + 0.5L);
}

static cell cell_of(const camera *c, uint32_t code) {
    const bool reversed = c->mapping == DP_MAPPING_REVERSED;
    const long double near_end = reversed ? code + 0.5L : code - 0.5L, far_end = reversed ? code - 0.5L : code + 0.5L;
    cell out = {.stored = eye_of(c, code)};
    out.lo = near_end < 0 || near_end > c->most ? c->n : eye_of(c, near_end);
    out.hi = far_end < 0 || far_end > c->most ? c->f : eye_of(c, far_end);
    out.lo = fmaxl(out.lo, c->n);
    return out;
}

/* How far the stored depth is from the depths that are stored as it. */
static long double reach(cell c) {
    return fmaxl(c.hi - c.stored, c.stored - c.lo);
}

static long double unit(long double x) {
    return x < 0 ? 0 : x > 1 ? 1 : x;
}

/* ---- By hand: error in shares of 1, and the end of the usable values --------------------------------------------- */

static const double RISE = -0.4, FOCAL = 1.25, START = 2, END = -60;

typedef struct hand {
    const char *name;
    long double (*error)(const camera *, cell, long double p);
    long double (*usable)(const camera *, cell, long double share);
} hand;

static long double intersection_error(const camera *c, cell k, long double p) {
    (void)c;
    return unit(reach(k) / p);
}

static long double intersection_usable(const camera *c, cell k, long double share) {
    (void)c;
    return reach(k) / share;
}

static long double force_error(const camera *c, cell k, long double p) {
    (void)c;
    return unit(reach(k) * p);
}

static long double force_usable(const camera *c, cell k, long double share) {
    (void)c;
    return share / reach(k);
}

static long double scan_error(const camera *c, cell k, long double p) {
    return unit(reach(k) / c->f / p);
}

static long double scan_usable(const camera *c, cell k, long double share) {
    return reach(k) / c->f / share;
}

static long double water_error(const camera *c, cell k, long double p) {
    (void)c;
    return p == 0 ? 1 : unit(reach(k) * fabsl((long double)RISE) / p);
}

static long double water_usable(const camera *c, cell k, long double share) {
    (void)c;
    return reach(k) * fabsl((long double)RISE) / share;
}

static long double focus_error(const camera *c, cell k, long double p) {
    return unit(reach(k) / c->f * p);
}

static long double focus_usable(const camera *c, cell k, long double share) {
    return share * c->f / reach(k);
}

/* 1/z changes by more at the near end of a cell. */
static long double blur_reach(cell k) {
    return (long double)FOCAL / 2 * fmaxl((k.stored - k.lo) / (k.stored * k.lo), (k.hi - k.stored) / (k.stored * k.hi));
}

static long double blur_error(const camera *c, cell k, long double p) {
    (void)c;
    return unit(blur_reach(k) * p);
}

static long double blur_usable(const camera *c, cell k, long double share) {
    (void)c;
    return share / blur_reach(k);
}

static long double ramp_error(long double lo, long double stored, long double hi, long double p) {
    return fmaxl(fabsl(unit(lo * p) - unit(stored * p)), fabsl(unit(hi * p) - unit(stored * p)));
}

/* Grows with p until the larger of the two saturates, so a first crossing lies there or nowhere. */
static long double ramp_usable(long double a, long double b, long double share) {
    const long double most = fmaxl(a, b), least = fmaxl(fminl(a, b), 0);
    if (most <= 0 || 1 - least / most <= share)
        return (long double)INFINITY;
    return share / (most - least);
}

static long double fog_error(const camera *c, cell k, long double p) {
    return ramp_error(k.lo / c->f, k.stored / c->f, k.hi / c->f, p);
}

static long double fog_usable(const camera *c, cell k, long double share) {
    return fminl(ramp_usable(k.lo / c->f, k.stored / c->f, share), ramp_usable(k.hi / c->f, k.stored / c->f, share));
}

static long double height(long double z) {
    return ((long double)RISE * z - (long double)START) / ((long double)END - (long double)START);
}

static long double height_error(const camera *c, cell k, long double p) {
    (void)c;
    return ramp_error(height(k.lo), height(k.stored), height(k.hi), p);
}

static long double height_usable(const camera *c, cell k, long double share) {
    (void)c;
    return fminl(ramp_usable(height(k.lo), height(k.stored), share),
                 ramp_usable(height(k.hi), height(k.stored), share));
}

static const hand hands[] = {
    {"intersection", intersection_error, intersection_usable},
    {"force-field", force_error, force_usable},
    {"fog", fog_error, fog_usable},
    {"scan-line", scan_error, scan_usable},
    {"water-line", water_error, water_usable},
    {"height-fog", height_error, height_usable},
    {"motion-blur", blur_error, blur_usable},
    {"depth-of-field", focus_error, focus_usable},
};
enum { HAND_COUNT = sizeof hands / sizeof hands[0] };

static void parameters_of(const effect_row *row, double *p) {
    static const struct {
        const char *name;
        double value;
    } given[] = {{"rise", RISE}, {"focal", FOCAL}, {"start", START}, {"end", END}};
    parameter_defaults(row->parameters, p);
    for (size_t i = 0; i < sizeof given / sizeof given[0]; i++) {
        const int index = parameter_find(row->parameters, given[i].name);
        if (index >= 0)
            p[index] = given[i].value;
    }
}

static dp_setup any_setup(rng *r) {
    static const dp_mapping mappings[] = {DP_MAPPING_D3D, DP_MAPPING_REVERSED, DP_MAPPING_LINEAR};
    static const char *const formats[] = {"unorm16", "unorm24", "unorm10"};
    const double znear = rng_log(r, 0.01, 1);
    return setup_of(znear, znear * rng_log(r, 50, 1e4), mappings[rng_below(r, 3)], formats[rng_below(r, 3)]);
}

static double log_depth(rng *r, const dp_setup *setup) {
    return rng_log(r, setup->spec.znear, setup->spec.zfar);
}

/* Cells are ends of depths in double, so what is left of them after a subtraction has their rounding. */
static long double slack(cell k) {
    return 1e-11L + 0x1p-46L * k.hi / reach(k);
}

static void test_by_hand(void **state) {
    rng r = rng_make("effects by hand");
    tally t = {.name = "by hand"};
    (void)state;
    for (uint64_t i = 0; i < test_cases(2000, 60000, 1000000); i++) {
        const dp_setup setup = any_setup(&r);
        const camera c = camera_of(&setup);
        const double z = log_depth(&r, &setup);
        const cell k = cell_of(&c, dp_code(&setup, z));
        const hand *h = &hands[rng_below(&r, HAND_COUNT)];
        const effect_row *row = effect_find(h->name);
        const texture_parameter *wanted = &row->parameters[row->wanted];
        double p[TEXTURE_PARAMETERS];
        parameters_of(row, p);
        const double levels = rng_log(&r, 0.01, 100);
        const long double usable = h->usable(&c, k, (long double)levels / 255);
        if (reach(k) < 1e-9L * k.hi) {
            t.skipped++;
            continue;
        }
        const double got = effect_usable(row, &setup, p, z, levels);
        const bool outside = row->smallest ? usable > (long double)wanted->hi : usable < (long double)wanted->lo;
        if (outside)
            TALLY(&t, isnan(got), "%s z %a: %a usable", row->name, z, got);
        else
            TALLY(&t,
                  fabsl((long double)got - fminl(fmaxl(usable, wanted->lo), wanted->hi)) <= slack(k) * (long double)got,
                  "%s %s %s z %a, %a levels: %a, %La", row->name, setup.spec.format.name,
                  dp_mapping_get(setup.spec.mapping)->name, z, levels, got, usable);
        p[row->wanted] = (double)fminl(fmaxl(usable * (long double)rng_log(&r, 1e-4, 1e4), wanted->lo), wanted->hi);
        if (h->usable == water_usable && rng_below(&r, 8) == 0)
            p[row->wanted] = 0;
        const long double error = 255 * h->error(&c, k, p[row->wanted]);
        TALLY(&t, fabsl((long double)effect_error(row, &setup, p, z) - error) <= slack(k) * fmaxl(error, 1e-3L),
              "%s %s z %a, parameter %a: %a levels, %La", row->name, setup.spec.format.name, z, p[row->wanted],
              effect_error(row, &setup, p, z), error);
    }
    tally_end(&t);
}

/* From the value found on, all are usable; the next double before it is not. By errors of our own. */
static void test_sharp(void **state) {
    rng r = rng_make("effects sharp");
    tally t = {.name = "sharp"};
    (void)state;
    for (uint64_t i = 0; i < test_cases(2000, 40000, 1000000); i++) {
        const dp_setup setup = any_setup(&r);
        const camera c = camera_of(&setup);
        const double z = log_depth(&r, &setup);
        const cell k = cell_of(&c, dp_code(&setup, z));
        const hand *h = &hands[rng_below(&r, HAND_COUNT)];
        const effect_row *row = effect_find(h->name);
        const texture_parameter *wanted = &row->parameters[row->wanted];
        double p[TEXTURE_PARAMETERS];
        parameters_of(row, p);
        const double levels = rng_log(&r, 0.01, 100);
        const double usable = effect_usable(row, &setup, p, z, levels);
        if (isnan(usable) || usable == wanted->lo || usable == wanted->hi || reach(k) < 1e-9L * k.hi) {
            t.skipped++;
            continue;
        }
        p[row->wanted] = usable;
        TALLY(&t, effect_error(row, &setup, p, z) <= levels, "%s z %a at %a", row->name, z, usable);
        p[row->wanted] = nextafter(usable, row->smallest ? 0 : INFINITY);
        TALLY(&t, effect_error(row, &setup, p, z) > levels, "%s z %a beside %a", row->name, z, usable);
        const long double off = 2 * slack(k);
        const long double good = (long double)usable * (row->smallest ? 1 + off : 1 - off);
        const long double bad = (long double)usable * (row->smallest ? 1 - off : 1 + off);
        TALLY(&t, 255 * h->error(&c, k, good) <= (long double)levels, "%s z %a: %a is too much", row->name, z, usable);
        TALLY(&t, 255 * h->error(&c, k, bad) > (long double)levels, "%s z %a: %a is not all", row->name, z, usable);
        const long double inner = good * (long double)(row->smallest ? rng_log(&r, 1, 1e6) : rng_log(&r, 1e-6, 1));
        TALLY(&t, 255 * h->error(&c, k, inner) <= (long double)levels, "%s z %a: not %La", row->name, z, inner);
    }
    tally_end(&t);
}

/*
 * Every code of unorm16 over a range of them: the row's output at many depths of the cell, compared with that at the
 * stored depth, for many places of the reference. Nothing is above the error, and something comes close.
 */
static void test_outputs(void **state) {
    enum { DEPTHS = 16, REFERENCES = 8 };
    const dp_setup setup = setup_of(0.1, 1000, DP_MAPPING_D3D, "unorm16");
    const camera c = camera_of(&setup);
    rng r = rng_make("effects outputs");
    tally t = {.name = "outputs"};
    (void)state;
    const uint32_t first = test_effort() == EFFORT_QUICK ? 65400 : 63000;
    for (uint32_t code = first; code <= 65535; code++)
        for (size_t i = 0; i < count(); i++) {
            const effect_row *row = effect_get(i);
            const cell k = cell_of(&c, code);
            double p[TEXTURE_PARAMETERS], worst = 0;
            if (row->kind == EFFECT_STEP)
                continue;
            parameters_of(row, p);
            const double usable = effect_usable(row, &setup, p, (double)k.stored, 1);
            p[row->wanted] = isnan(usable) ? 1 : fmin(usable * rng_log(&r, 0.1, 10), row->parameters[row->wanted].hi);
            const double error = effect_error(row, &setup, p, (double)k.stored);
            for (int a = 0; a < REFERENCES; a++)
                for (int b = 0; b <= DEPTHS; b++) {
                    const double z = (double)(k.lo + (k.hi - k.lo) * b / DEPTHS);
                    const double at = a == 0   ? (double)k.stored
                                      : a == 1 ? (double)k.lo
                                      : a == 2 ? (double)k.hi
                                               : (double)k.stored * rng_uniform(&r, 0.9, 1.1);
                    const double seen = row->output(&setup, p, (double)k.stored, at);
                    worst = fmax(worst, 255 * fabs(row->output(&setup, p, z, at) - seen));
                }
            TALLY(&t, fmin(worst, 255) <= error * (1 + 1e-6) + 1e-9, "%s code %u: %a levels, %a stated", row->name,
                  code, worst, error);
            TALLY(&t, worst >= error * (1 - 1e-6) - 1e-9, "%s code %u: %a levels only, %a stated", row->name, code,
                  worst, error);
        }
    tally_end(&t);
}

/* ---- Edges ------------------------------------------------------------------------------------------------------- */

/* The differences of stored depths of a plane, first pixels all over the cell. */
static void test_edge(void **state) {
    enum { PLACES = 200 };
    const effect_row *row = effect_find("edge");
    rng r = rng_make("edges");
    tally t = {.name = "edges"};
    (void)state;
    for (uint64_t i = 0; i < test_cases(300, 6000, 100000); i++) {
        const dp_setup setup = any_setup(&r);
        const camera c = camera_of(&setup);
        const double z = rng_log(&r, setup.spec.znear, setup.spec.zfar / 1.5);
        const cell k = cell_of(&c, dp_code(&setup, z));
        const double slope = rng_below(&r, 8) == 0 ? 0 : (double)(k.hi - k.lo) * rng_log(&r, 0.05, 20);
        double p[TEXTURE_PARAMETERS] = {0, slope};
        if (reach(k) < 1e-9L * k.hi || k.hi + (long double)slope > c.f) {
            t.skipped++;
            continue;
        }
        long double least = (long double)INFINITY, most = 0;
        for (int a = 0; a <= PLACES; a++) { /* just inside the cell, and all over it */
            const long double share = fminl(fmaxl((long double)a / PLACES, 1e-7L), 1 - 1e-7L);
            const long double z1 = k.lo + (k.hi - k.lo) * share;
            const long double seen = eye_of(&c, code_of(&c, z1 + (long double)slope)) - k.stored;
            least = fminl(least, seen / c.f);
            most = fmaxl(most, seen / c.f);
        }
        const long double plane = (long double)slope / c.f;
        const bool exact = least >= plane && most <= plane;
        const double usable = effect_usable(row, &setup, p, z, 1);
        const long double want = exact ? 0 : fmaxl(plane, most);
        TALLY(&t, want > 1 ? isnan(usable) : fabsl((long double)usable - want) <= 1e-12L + slack(k) * want,
              "%s %s z %a slope %a: from %a, %La", setup.spec.format.name, dp_mapping_get(setup.spec.mapping)->name, z,
              slope, usable, want);
        /* Thresholds on all sides of the three that matter. */
        const long double marks[] = {least, plane, most};
        for (int a = 0; a < 6; a++) {
            const long double threshold = marks[a % 3] * (a < 3 ? 0.999L : 1.001L);
            if (!(threshold >= 0 && threshold <= 1) || fabsl(threshold - least) < 1e-6L * least ||
                fabsl(threshold - most) < 1e-6L * most || fabsl(threshold - plane) < 1e-6L * plane)
                continue;
            p[0] = (double)threshold;
            const bool wrong = plane > threshold ? least <= threshold : most > threshold;
            TALLY(&t, effect_error(row, &setup, p, z) == (wrong ? 255.0 : 0.0), "z %a slope %a threshold %a: %g", z,
                  slope, p[0], effect_error(row, &setup, p, z));
        }
    }
    tally_end(&t);
}

/* ---- Rows and limits --------------------------------------------------------------------------------------------- */

static void test_rows(void **state) {
    static const char *const names[] = {"intersection", "force-field", "fog",         "scan-line",     "water-line",
                                        "height-fog",   "edge",        "motion-blur", "depth-of-field"};
    /* As depthprec(1) documents them: a command without --parameter is read with these in mind. */
    static const double wanted[] = {0.1, 1, 1, 0.01, 0, 1, 0.001, 0.1, 10};
    (void)state;
    assert_int_equal(count(), sizeof names / sizeof names[0]);
    for (size_t i = 0; i < count(); i++) {
        const effect_row *row = effect_get(i);
        assert_non_null(effect_find(names[i]));
        assert_true(effect_find(row->name) == row);
        assert_true(row->note[0] != '\0' && row->source[0] != '\0');
        int parameters = 0;
        for (; row->parameters[parameters].name != NULL; parameters++) {
            const texture_parameter *p = &row->parameters[parameters];
            assert_true(p->lo <= p->value && p->value <= p->hi && p->unit[0] != '\0' && p->note[0] != '\0');
            assert_int_equal(parameter_find(row->parameters, p->name), parameters);
        }
        assert_true(parameters >= 1 && parameters <= TEXTURE_PARAMETERS && row->wanted < parameters);
        assert_true(effect_find(names[i])->parameters[effect_find(names[i])->wanted].value == wanted[i]);
        /* What needs z/far says so. */
        const dp_setup infinite = setup_of(0.1, INFINITY, DP_MAPPING_REVERSED, "fp32");
        double p[TEXTURE_PARAMETERS];
        parameter_defaults(row->parameters, p);
        assert_true(effect_applies(row, &infinite) != row->eye01);
        assert_true((isnan(effect_error(row, &infinite, p, 10)) != 0) == row->eye01);
        assert_true(!row->eye01 || isnan(effect_usable(row, &infinite, p, 10, 1)));
    }
    assert_null(effect_find("bloom"));
    assert_null(effect_get(count()));
    assert_int_equal(parameter_find(effect_get(0)->parameters, "nothing"), -1);
}

static void test_limits(void **state) {
    const dp_setup infinite = setup_of(0.1, INFINITY, DP_MAPPING_D3D, "unorm24");
    const dp_setup finite = setup_of(0.1, 1000, DP_MAPPING_D3D, "unorm16");
    dp_setup pipeline = finite;
    double p[TEXTURE_PARAMETERS];
    (void)state;
    /* The last cell of an infinite far plane has no end: no distance is enough, but 1/z stays where it is. */
    parameter_defaults(effect_find("intersection")->parameters, p);
    assert_true(effect_error(effect_find("intersection"), &infinite, p, 1e9) == 255);
    assert_true(isnan(effect_usable(effect_find("intersection"), &infinite, p, 1e9, 1)));
    parameter_defaults(effect_find("force-field")->parameters, p);
    assert_true(isnan(effect_usable(effect_find("force-field"), &infinite, p, 1e9, 1)));
    parameter_defaults(effect_find("motion-blur")->parameters, p);
    assert_true(effect_error(effect_find("motion-blur"), &infinite, p, 1e9) < 1e-4);
    /* Level ground: the height does not depend on the depth. */
    const effect_row *water = effect_find("water-line");
    parameter_defaults(water->parameters, p);
    assert_true(effect_error(water, &finite, p, 10) == 255);
    p[parameter_find(water->parameters, "rise")] = 0;
    assert_true(effect_error(water, &finite, p, 10) == 0 && effect_usable(water, &finite, p, 10, 1) == 0);
    assert_true(effect_error(water, &infinite, p, 1e9) == 0);
    /* Where fog has saturated no depth shows. */
    const effect_row *fog = effect_find("fog");
    parameter_defaults(fog->parameters, p);
    p[0] = 100;
    assert_true(effect_error(fog, &finite, p, 500) == 0);
    assert_true(effect_usable(fog, &finite, p, 500, 1) < 1);
    /* An orthographic camera that moves moves all alike. */
    dp_spec spec = finite.spec;
    dp_setup ortho;
    spec.ortho = 1;
    assert_int_equal(dp_setup_init(&ortho, &spec), DP_OK);
    parameter_defaults(effect_find("motion-blur")->parameters, p);
    assert_true(effect_error(effect_find("motion-blur"), &ortho, p, 10) == 0);
    /* Behind an orthographic camera a cell is as wide as before it: 65535 steps of 60/65535. */
    dp_format found[2];
    dp_format_parse("unorm16", found);
    spec.format = found[0];
    spec.znear = -10;
    spec.zfar = 50;
    assert_int_equal(dp_setup_init(&ortho, &spec), DP_OK);
    for (double z = -9.5; z < 50; z += 1.25) {
        const double half = 30.0 / 65535;
        parameter_defaults(effect_find("intersection")->parameters, p);
        assert_relative(effect_error(effect_find("intersection"), &ortho, p, z), 255 * half / 0.1, 1e-9);
        assert_relative(effect_usable(effect_find("intersection"), &ortho, p, z, 1), 255 * half, 1e-9);
        parameter_defaults(effect_find("force-field")->parameters, p);
        assert_relative(effect_error(effect_find("force-field"), &ortho, p, z), 255 * half, 1e-9);
    }
    /* No cells, no error. */
    pipeline.spec.model = DP_MODEL_FP32;
    parameter_defaults(fog->parameters, p);
    assert_true(isnan(effect_error(fog, &pipeline, p, 10)) && isnan(effect_usable(fog, &pipeline, p, 10, 1)));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rows),    cmocka_unit_test(test_by_hand), cmocka_unit_test(test_sharp),
        cmocka_unit_test(test_outputs), cmocka_unit_test(test_edge),    cmocka_unit_test(test_limits),
    };
    return run_tap(tests);
}
