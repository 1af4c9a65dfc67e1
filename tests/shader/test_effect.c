/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Effects: errors and usable parameters against formulas written out by hand in long double, and against outputs
 * compared at many depths of a cell; cells are computed here too, from the codes' window depths.
 */
#include <ctype.h>

#include "named.h"
#include "setups.h"
#include "shader/effect.h"
#include "support.h"

static size_t count(void) {
    size_t rows = 0;
    while (effect_get(rows) != NULL)
        rows++;
    return rows;
}

static dp_setup setup_of(double znear, double zfar, dp_mapping mapping, const char *format) {
    return SETUP(format, .znear = znear, .zfar = zfar, .mapping = mapping);
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

/* A picture of one pixel, whose ray falls by 0.4 in a scene unit; the camera stands at a height of 5, and moved. */
static const double RISE = -0.4, MOVE = 0.3, HALF = 0.8, START = 7, END = -60, HEIGHT = 5;

static const long double AHEAD = 0.916515138991168L; /* sqrt(1 - RISE^2): how fast a ray goes to a facing wall */

static effect_view view_of(const dp_setup *setup) {
    const double degree = 3.14159265358979323846 / 180;
    camera_spec spec = camera_spec_default();
    texture_camera now, last;
    spec.width = spec.height = 1;
    spec.fov_y = 2 * atan(HALF) / degree;
    spec.half_height = HALF;
    spec.pitch = asin(RISE) / degree;
    spec.origin[1] = HEIGHT;
    assert_null(camera_init(&now, setup, &spec));
    spec.origin[0] = MOVE;
    assert_null(camera_init(&last, setup, &spec));
    effect_view view = effect_view_of(&now, &last, 0, 0);
    view.setup = setup;
    return view;
}

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
    return (long double)MOVE / (long double)HALF / 2 *
           fmaxl((k.stored - k.lo) / (k.stored * k.lo), (k.hi - k.stored) / (k.stored * k.hi));
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
    return ((long double)HEIGHT + (long double)RISE * z - (long double)START) / ((long double)END - (long double)START);
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

static long double decal_error(const camera *c, cell k, long double p) {
    (void)c;
    return p == 0 ? 1 : unit(reach(k) * AHEAD / p);
}

static long double decal_usable(const camera *c, cell k, long double share) {
    (void)c;
    return reach(k) * AHEAD / share;
}

static long double decay_error(const camera *c, cell k, long double p) {
    (void)c;
    return 1 - expl(-reach(k) * p);
}

static long double decay_usable(const camera *c, cell k, long double share) {
    (void)c;
    return -logl(1 - share) / reach(k);
}

static const hand hands[] = {
    {"soft-particles", intersection_error, intersection_usable},
    {"decal", decal_error, decal_usable},
    {"water-depth", decay_error, decay_usable},
    {"intersection", intersection_error, intersection_usable},
    {"force-field", force_error, force_usable},
    {"fog", fog_error, fog_usable},
    {"radial-fog", fog_error, fog_usable}, /* the same along the view axis */
    {"scan-line", scan_error, scan_usable},
    {"water-line", water_error, water_usable},
    {"height-fog", height_error, height_usable},
    {"motion-blur", blur_error, blur_usable},
    {"motion-vector", blur_error, blur_usable},
    {"ray-march", intersection_error, intersection_usable},
    {"depth-of-field", focus_error, focus_usable},
};
enum { HAND_COUNT = sizeof hands / sizeof hands[0] };

static void parameters_of(const effect_row *row, double *p) {
    static const struct {
        const char *name;
        double value;
    } given[] = {{"start", START}, {"end", END}};
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

/* A depth of some set-up, and its cell. */
typedef struct place {
    dp_setup setup;
    camera c;
    effect_view view;
    double z;
    cell k;
} place;

static void any_place(rng *r, double before_far, place *out) {
    out->setup = any_setup(r);
    out->c = camera_of(&out->setup);
    out->view = view_of(&out->setup);
    out->z = rng_log(r, out->setup.spec.znear, out->setup.spec.zfar / before_far);
    out->k = cell_of(&out->c, dp_code(&out->setup, out->z));
    assert_true(reach(out->k) > 1e-8L * out->k.hi); /* so that its ends in double say much of it */
}

/* Cells are ends of depths in double, so what is left of them after a subtraction has their rounding. */
static long double slack(cell k) {
    return 1e-11L + 0x1p-46L * k.hi / reach(k);
}

TEST(test_by_hand) {
    rng r = rng_make("effects by hand");
    tally t = {.name = "by hand"};
    for (uint64_t i = 0; i < test_cases(2000, 60000, 1000000); i++) {
        place at;
        any_place(&r, 1, &at);
        const hand *h = &hands[rng_below(&r, HAND_COUNT)];
        const effect_row *row = effect_find(h->name);
        const texture_parameter *wanted = &row->parameters[row->wanted];
        double p[PARAMETERS_MAX];
        parameters_of(row, p);
        const double levels = rng_log(&r, 0.01, 100);
        const long double usable = h->usable(&at.c, at.k, (long double)levels / 255);
        const double got = effect_usable(row, &at.view, p, at.z, levels);
        const bool outside = row->smallest ? usable > (long double)wanted->hi : usable < (long double)wanted->lo;
        if (outside)
            TALLY(&t, isnan(got), "%s z %a: %a usable", row->name, at.z, got);
        else
            TALLY(&t,
                  fabsl((long double)got - fminl(fmaxl(usable, wanted->lo), wanted->hi)) <=
                      slack(at.k) * (long double)got,
                  "%s %s %s z %a, %a levels: %a, %La", row->name, at.setup.spec.format.name,
                  dp_mapping_get(at.setup.spec.mapping)->name, at.z, levels, got, usable);
        p[row->wanted] = (double)fminl(fmaxl(usable * (long double)rng_log(&r, 1e-4, 1e4), wanted->lo), wanted->hi);
        if ((h->usable == water_usable || h->usable == decal_usable) && rng_below(&r, 8) == 0)
            p[row->wanted] = 0;
        const long double error = 255 * h->error(&at.c, at.k, p[row->wanted]);
        TALLY(&t, fabsl((long double)effect_error(row, &at.view, p, at.z) - error) <= slack(at.k) * fmaxl(error, 1e-3L),
              "%s %s z %a, parameter %a: %a levels, %La", row->name, at.setup.spec.format.name, at.z, p[row->wanted],
              effect_error(row, &at.view, p, at.z), error);
    }
    tally_end(&t);
}

/* From the value found on, all are usable; the next double before it is not. By errors of our own. */
TEST(test_sharp) {
    rng r = rng_make("effects sharp");
    tally t = {.name = "sharp"};
    for (uint64_t i = 0; i < test_cases(2000, 40000, 1000000); i++) {
        place at;
        any_place(&r, 1, &at);
        const hand *h = &hands[rng_below(&r, HAND_COUNT)];
        const effect_row *row = effect_find(h->name);
        const texture_parameter *wanted = &row->parameters[row->wanted];
        double p[PARAMETERS_MAX];
        parameters_of(row, p);
        const double levels = rng_log(&r, 0.01, 100);
        const double usable = effect_usable(row, &at.view, p, at.z, levels);
        if (isnan(usable) || usable == wanted->lo || usable == wanted->hi) {
            t.skipped++;
            continue;
        }
        p[row->wanted] = usable;
        TALLY(&t, effect_error(row, &at.view, p, at.z) <= levels, "%s z %a at %a", row->name, at.z, usable);
        p[row->wanted] = nextafter(usable, row->smallest ? 0 : INFINITY);
        TALLY(&t, effect_error(row, &at.view, p, at.z) > levels, "%s z %a beside %a", row->name, at.z, usable);
        const long double off = 2 * slack(at.k);
        const long double good = (long double)usable * (row->smallest ? 1 + off : 1 - off);
        const long double bad = (long double)usable * (row->smallest ? 1 - off : 1 + off);
        TALLY(&t, 255 * h->error(&at.c, at.k, good) <= (long double)levels, "%s z %a: %a is too much", row->name, at.z,
              usable);
        TALLY(&t, 255 * h->error(&at.c, at.k, bad) > (long double)levels, "%s z %a: %a is not all", row->name, at.z,
              usable);
        const long double inner = good * (long double)(row->smallest ? rng_log(&r, 1, 1e6) : rng_log(&r, 1e-6, 1));
        TALLY(&t, 255 * h->error(&at.c, at.k, inner) <= (long double)levels, "%s z %a: not %La", row->name, at.z,
              inner);
    }
    tally_end(&t);
}

/* A decal that goes on for ever from a depth of the world on. */
static void wall_of(const effect_row *row, double from, double *p) {
    const double size = 1 << 20;
    p[parameter_find(row->parameters, "width")] = p[parameter_find(row->parameters, "height")] = size;
    p[parameter_find(row->parameters, "depth")] = size;
    p[parameter_find(row->parameters, "z")] = from + size / 2;
}

/*
 * Every code of unorm16 over a range of them: the row's output at many depths of the cell, compared with that at the
 * stored depth, for many places of the reference. Nothing is above the error, and something comes close.
 */
TEST(test_outputs) {
    enum { DEPTHS = 16, REFERENCES = 8 };
    const dp_setup setup = setup_of(0.1, 1000, DP_MAPPING_D3D, "unorm16");
    const camera c = camera_of(&setup);
    const effect_view view = view_of(&setup);
    rng r = rng_make("effects outputs");
    tally t = {.name = "outputs"};
    const uint32_t first = test_effort() == EFFORT_QUICK ? 65400 : 63000;
    for (uint32_t code = first; code <= 65535; code++)
        for (size_t i = 0; i < count(); i++) {
            const effect_row *row = effect_get(i);
            const cell k = cell_of(&c, code);
            double p[PARAMETERS_MAX], worst = 0;
            if (row->kind == EFFECT_STEP || row->behind > 0) /* test_thickness */
                continue;
            parameters_of(row, p);
            const double usable = effect_usable(row, &view, p, (double)k.stored, 1);
            p[row->wanted] = isnan(usable) ? 1 : fmin(usable * rng_log(&r, 0.1, 10), row->parameters[row->wanted].hi);
            const double error = effect_error(row, &view, p, (double)k.stored);
            for (int a = 0; a < REFERENCES; a++)
                for (int b = 0; b <= DEPTHS; b++) {
                    const double z = (double)(k.lo + (k.hi - k.lo) * b / DEPTHS);
                    const double at = a == 0   ? (double)k.stored
                                      : a == 1 ? (double)k.lo
                                      : a == 2 ? (double)k.hi
                                               : (double)k.stored * rng_uniform(&r, 0.9, 1.1);
                    const int level = parameter_find(row->parameters, "level");
                    if (strcmp(row->name, "water-line") == 0) /* the water, or a face of the decal, is at that depth */
                        p[level] = HEIGHT + RISE * at;
                    if (strcmp(row->name, "decal") == 0)
                        wall_of(row, (double)AHEAD * at, p);
                    const double seen = row->output(&view, p, (double)k.stored, at);
                    worst = fmax(worst, 255 * fabs(row->output(&view, p, z, at) - seen));
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
TEST(test_edge) {
    enum { PLACES = 200 };
    const effect_row *row = effect_find("edge");
    rng r = rng_make("edges");
    tally t = {.name = "edges"};
    for (uint64_t i = 0; i < test_cases(300, 6000, 100000); i++) {
        place at;
        any_place(&r, 1.5, &at);
        const double slope = rng_below(&r, 8) == 0 ? 0 : (double)(at.k.hi - at.k.lo) * rng_log(&r, 0.05, 20);
        double p[PARAMETERS_MAX] = {0, slope};
        if (at.k.hi + (long double)slope > at.c.f) {
            t.skipped++;
            continue;
        }
        long double least = (long double)INFINITY, most = 0;
        for (int a = 0; a <= PLACES; a++) { /* just inside the cell, and all over it */
            const long double share = fminl(fmaxl((long double)a / PLACES, 1e-7L), 1 - 1e-7L);
            const long double z1 = at.k.lo + (at.k.hi - at.k.lo) * share;
            const long double seen = eye_of(&at.c, code_of(&at.c, z1 + (long double)slope)) - at.k.stored;
            least = fminl(least, seen / at.c.f);
            most = fmaxl(most, seen / at.c.f);
        }
        const long double plane = (long double)slope / at.c.f;
        const bool exact = least >= plane && most <= plane;
        const double usable = effect_usable(row, &at.view, p, at.z, 1);
        const long double want = exact ? 0 : fmaxl(plane, most);
        TALLY(&t, want > 1 ? isnan(usable) : fabsl((long double)usable - want) <= 1e-12L + slack(at.k) * want,
              "%s %s z %a slope %a: from %a, %La", at.setup.spec.format.name,
              dp_mapping_get(at.setup.spec.mapping)->name, at.z, slope, usable, want);
        /* Thresholds on all sides of the three that matter. */
        const long double marks[] = {least, plane, most};
        for (int a = 0; a < 6; a++) {
            const long double threshold = marks[a % 3] * (a < 3 ? 0.999L : 1.001L);
            if (!(threshold >= 0 && threshold <= 1) || fabsl(threshold - least) < 1e-6L * least ||
                fabsl(threshold - most) < 1e-6L * most || fabsl(threshold - plane) < 1e-6L * plane)
                continue;
            p[0] = (double)threshold;
            const bool wrong = plane > threshold ? least <= threshold : most > threshold;
            TALLY(&t, effect_error(row, &at.view, p, at.z) == (wrong ? 255.0 : 0.0), "z %a slope %a threshold %a: %g",
                  at.z, slope, p[0], effect_error(row, &at.view, p, at.z));
        }
    }
    tally_end(&t);
}

/* From which slopes on a plane shows, at some places and at all: of slopes a little below and above. */
TEST(test_slopes) {
    const effect_row *row = effect_find("edge");
    rng r = rng_make("slopes of edges");
    tally t = {.name = "slopes"};
    for (uint64_t i = 0; i < test_cases(300, 6000, 100000); i++) {
        place at;
        any_place(&r, 1.5, &at);
        const double wanted = (double)(at.k.hi - at.k.lo) * rng_log(&r, 0.05, 20);
        double p[PARAMETERS_MAX] = {(double)(wanted / at.c.f), 0.1};
        const effect_slopes found = effect_slopes_at(row, &at.view, p, at.z);
        const double slopes[3] = {found.plane, found.first, found.last};
        if (!(p[0] > 0 && p[0] < 1) || isnan(found.plane) || isnan(found.first) || isnan(found.last)) {
            t.skipped++;
            continue;
        }
        TALLY(&t, fabs(found.plane - wanted) <= 1e-9 * wanted, "plane: %a, not %a", found.plane, wanted);
        for (int a = 0; a < 4; a++) { /* the ends of the cell are its extremes: stored depths grow with the slope */
            const bool last = a / 2 == 1, beyond = a % 2 == 1;
            const long double slope = (long double)slopes[1 + last] + (beyond ? 1 : -1) * 1e-6L * (at.k.hi - at.k.lo);
            const long double z1 = at.k.lo + (at.k.hi - at.k.lo) * (last ? 1e-7L : 1 - 1e-7L);
            if (slope < 0 || z1 + slope > at.c.f)
                continue;
            const long double seen = eye_of(&at.c, code_of(&at.c, z1 + slope)) - at.k.stored;
            TALLY(&t, (seen / at.c.f > p[0]) == beyond, "%s z %a threshold %a slope %La: %La", last ? "last" : "first",
                  at.z, p[0], slope, seen);
        }
    }
    tally_end(&t);
}

/* ---- Other steps ------------------------------------------------------------------------------------------------- */

/* Whether the output on a plane is 1: of two stored depths, `seen` and `apart` behind it; or, of a shadow map, of a
 * computed depth that lies `apart` behind the stored one. */
typedef struct step {
    const char *name, *parameters[2]; /* others than the wanted one and the slope */
    bool alone, quiet;                /* as in the row */
    bool (*on)(const camera *c, long double seen, long double apart, long double wanted, const long double *other);
} step;

static bool outline_on(const camera *c, long double seen, long double apart, long double wanted,
                       const long double *other) {
    (void)c, (void)other;
    return apart / c->f * wanted >= 0.1L * (seen / c->f);
}

static bool occlusion_on(const camera *c, long double seen, long double apart, long double wanted,
                         const long double *other) {
    (void)c, (void)seen;
    return apart > wanted && apart < other[0];
}

/* The ray is a step, and what the surface came nearer, behind the surface: is it lost? */
static bool contact_on(const camera *c, long double seen, long double apart, long double wanted,
                       const long double *other) {
    (void)c, (void)seen;
    return apart + other[0] > wanted;
}

static const step steps[] = {
    {"outline", {NULL}, false, false, outline_on},
    {"ambient-occlusion", {"radius"}, false, true, occlusion_on},
    {"contact-shadow", {"step"}, false, false, contact_on},
};
enum { STEPS = sizeof steps / sizeof steps[0] };

/* At the end of the usable values, a little before and behind it, the answers of first pixels all over the cell. */
TEST(test_steps) {
    enum { PLACES = 300 };
    rng r = rng_make("steps");
    tally t = {.name = "steps"};
    for (uint64_t i = 0; i < test_cases(600, 9000, 200000); i++) {
        place at;
        any_place(&r, 1.5, &at);
        const step *s = &steps[rng_below(&r, STEPS)];
        const effect_row *row = effect_find(s->name);
        const double slope = (double)(at.k.hi - at.k.lo) * rng_log(&r, 0.05, 20);
        long double other[1] = {(long double)(slope * rng_log(&r, 0.01, 0.2))};
        double p[PARAMETERS_MAX];
        if (at.k.hi + (long double)slope > at.c.f) {
            t.skipped++;
            continue;
        }
        if (s->on == occlusion_on) /* a radius that no difference comes near */
            other[0] = 100 * (at.k.hi - at.k.lo) + 100 * (long double)slope;
        parameter_defaults(row->parameters, p);
        p[parameter_find(row->parameters, "slope")] = slope;
        if (s->parameters[0] != NULL)
            p[parameter_find(row->parameters, s->parameters[0])] = (double)other[0];
        assert_true(row->quiet == s->quiet && row->alone == s->alone);
        const double usable = effect_usable(row, &at.view, p, at.z, 1);
        const texture_parameter *range = &row->parameters[row->wanted];
        const double marks[] = {usable, usable * (1 - 1e-6), usable * (1 + 1e-6), usable * 0.5, usable * 2};
        for (int m = 0; m < 5; m++) {
            p[row->wanted] = marks[m];
            if (isnan(usable) || marks[m] < range->lo || marks[m] > range->hi)
                continue;
            const bool good = row->smallest ? marks[m] >= usable : marks[m] <= usable;
            bool wrong = false, near = false;
            for (int a = 0; a <= PLACES; a++) {
                const long double share = fminl(fmaxl((long double)a / PLACES, 1e-7L), 1 - 1e-7L);
                const long double seen =
                    eye_of(&at.c, code_of(&at.c, at.k.lo + (at.k.hi - at.k.lo) * share + (long double)slope));
                const bool should = !s->quiet && s->on(&at.c, at.k.stored, slope, marks[m], other);
                for (int e = -1; e <= 1; e++) { /* answers that rounding in double decides are no answers */
                    const bool on =
                        s->on(&at.c, at.k.stored, (seen - at.k.stored) * (1 + e * slack(at.k)) + e * 1e-12L * other[0],
                              marks[m], other);
                    wrong = wrong || (e == 0 && on != should);
                    near = near || s->on(&at.c, at.k.stored, slope + e * 1e-12L * (slope + other[0]), marks[m],
                                         other) != s->on(&at.c, at.k.stored, slope, marks[m], other);
                    near = near || on != s->on(&at.c, at.k.stored, seen - at.k.stored, marks[m], other);
                }
            }
            TALLY(&t, near || (effect_error(row, &at.view, p, at.z) == 255) == wrong,
                  "%s z %a slope %a at %a: %g, %d %d %d %s", s->name, at.z, slope, marks[m],
                  effect_error(row, &at.view, p, at.z), wrong, m, good, at.setup.spec.format.name);
            TALLY(&t, near || !good || !wrong, "%s z %a slope %a: %a is not usable", s->name, at.z, slope, marks[m]);
            TALLY(&t, near || good || m == 0 || marks[m] < usable * 0.99 || marks[m] > usable * 1.01 || wrong,
                  "%s z %a slope %a: %a is usable, not only from %a", s->name, at.z, slope, marks[m], usable);
        }
    }
    tally_end(&t);
}

/* An occluder beyond the radius hides nothing: of two differences the smaller one asks for a bias. */
TEST(test_range_check) {
    const dp_setup setup = setup_of(0.1, 1000, DP_MAPPING_D3D, "unorm16");
    const effect_view view = view_of(&setup);
    const effect_row *row = effect_find("ambient-occlusion");
    double p[PARAMETERS_MAX];
    parameter_defaults(row->parameters, p);
    const int radius = parameter_find(row->parameters, "radius"), slope = parameter_find(row->parameters, "slope");
    p[slope] = 0.2;
    p[radius] = 0.01;
    assert_true(effect_usable(row, &view, p, 30, 1) == 0);
    p[radius] = 40;
    const double bias = effect_usable(row, &view, p, 30, 1);
    assert_true(bias > 0.2 && bias < 0.35);
    p[radius] = bias - 1e-6; /* some differences reach over it, others do not */
    const double smaller = effect_usable(row, &view, p, 30, 1);
    assert_true(smaller > 0.1 && smaller < bias - 0.1);
}

/* A shadow map's texel saw the middle; the plane's places beside it lie before or behind that. Acne by counting. */
TEST(test_shadow) {
    enum { PLACES = 400 };
    const effect_row *row = effect_find("shadow");
    rng r = rng_make("shadows");
    tally t = {.name = "shadows"};
    for (uint64_t i = 0; i < test_cases(100, 1500, 20000); i++) {
        place at;
        any_place(&r, 1, &at);
        const double slope = rng_below(&r, 6) == 0 ? 0 : (double)(at.k.hi - at.k.lo) * rng_log(&r, 0.1, 10);
        double p[PARAMETERS_MAX];
        parameter_defaults(row->parameters, p);
        p[parameter_find(row->parameters, "slope")] = slope;
        const long double want = at.k.hi - at.k.stored + (long double)slope / 2;
        const double usable = effect_usable(row, &at.view, p, at.z, 1);
        TALLY(&t, fabsl((long double)usable - want) <= slack(at.k) * fmaxl(want, reach(at.k)),
              "z %a slope %a: from %a, not %La", at.z, slope, usable, want);
        p[row->wanted] = (double)want * rng_uniform(&r, 0, 1.2);
        if (want < 1e-9L * reach(at.k) || fabs(p[row->wanted] / (double)want - 1) < 1e-6) {
            t.skipped++;
            continue;
        }
        uint64_t shadowed = 0;
        for (int a = 0; a < PLACES; a++)
            for (int b = 0; b < PLACES; b++) {
                const long double u = at.k.lo + (at.k.hi - at.k.lo) * (a + 0.5L) / PLACES,
                                  side = (b + 0.5L) / PLACES - 0.5L;
                shadowed += u + (long double)slope * side - (long double)p[row->wanted] > at.k.stored;
            }
        const double share = (double)shadowed / PLACES / PLACES, got = effect_share(row, &at.view, p, at.z);
        TALLY(&t, fabs(got - share) <= 0.01, "z %a slope %a bias %a: %g, counted %g", at.z, slope, p[row->wanted], got,
              share);
        TALLY(&t, (effect_error(row, &at.view, p, at.z) == 255) == (p[row->wanted] < (double)want), "z %a bias %a: %g",
              at.z, p[row->wanted], effect_error(row, &at.view, p, at.z));
        TALLY(&t, (got > 0) == (p[row->wanted] < (double)want), "z %a bias %a of %La: %g", at.z, p[row->wanted], want,
              got);
    }
    assert_true(isnan(effect_share(effect_find("edge"), NULL, NULL, 1)));
    tally_end(&t);
}

/* ---- Two stored depths ---------------------------------------------------------------------------------------------
 */

/* A front and a back: what both cells allow of the difference, found by trying their ends. */
TEST(test_thickness) {
    const effect_row *row = effect_find("thickness");
    const int behind = parameter_find(row->parameters, "thickness");
    rng r = rng_make("thickness");
    tally t = {.name = "thickness"};
    for (uint64_t i = 0; i < test_cases(2000, 60000, 1000000); i++) {
        place at;
        any_place(&r, 1, &at);
        double p[PARAMETERS_MAX];
        parameter_defaults(row->parameters, p);
        p[behind] = rng_log(&r, 1e-3, 1) * at.z;
        const long double back = fminl((long double)at.z + (long double)p[behind], at.c.f);
        const uint32_t code = dp_code(&at.setup, (double)back);
        const cell k = cell_of(&at.c, code);
        long double most = 0;
        for (int e = 0; e < 4; e++)
            most =
                fmaxl(most, fabsl((e % 2 == 0 ? k.lo : k.hi) - (e < 2 ? at.k.lo : at.k.hi) - (k.stored - at.k.stored)));
        const long double slack_of_ends = 0x1p-46L * k.hi / most + 1e-11L;
        const double levels = effect_error(row, &at.view, p, at.z), usable = effect_usable(row, &at.view, p, at.z, 1);
        TALLY(&t, fabsl((long double)levels - 255 * fminl(most, 1)) <= 255 * fminl(most, 1) * slack_of_ends,
              "z %a, %a thick: %.12g levels, not %.12Lg", at.z, p[behind], levels, 255 * most);
        TALLY(&t, fabsl((long double)usable - 255 * most) <= 255 * most * slack_of_ends, "z %a: from %.12g, not %.12Lg",
              at.z, usable, 255 * most);
    }
    tally_end(&t);
}

/* ---- Rows and limits --------------------------------------------------------------------------------------------- */

TEST(test_rows) {
    static const char *const names[] = {"intersection",   "force-field",    "fog",         "scan-line",
                                        "water-line",     "height-fog",     "edge",        "motion-blur",
                                        "depth-of-field", "soft-particles", "decal",       "ambient-occlusion",
                                        "contact-shadow", "shadow",         "water-depth", "outline",
                                        "motion-vector",  "thickness",      "ray-march",   "radial-fog"};
    /* As depthprec-texture(1) documents them: a command without --parameter is read with these in mind. */
    static const double wanted[] = {0.1, 1, 1, 0.01, 0, 1, 0.001, 1, 10, 1, 0, 0.01, 0.1, 0.01, 0.5, 1, 1, 1, 0.1, 1};
    assert_int_equal(count(), sizeof names / sizeof names[0]);
    for (size_t i = 0; i < count(); i++) {
        const effect_row *row = effect_get(i);
        assert_non_null(effect_find(names[i]));
        assert_true(effect_find(row->name) == row);
        assert_true(row->note[0] != '\0' && row->source[0] != '\0');
        int parameters = 0;
        for (; row->parameters[parameters].name != NULL; parameters++) {
            const texture_parameter *p = &row->parameters[parameters];
            const bool given = strncmp(p->name, "reference", 9) == 0; /* has no default */
            assert_true(given ? isnan(p->value) : p->lo <= p->value && p->value <= p->hi);
            assert_true(p->lo < p->hi && p->unit[0] != '\0' && p->note[0] != '\0');
            assert_int_equal(parameter_find(row->parameters, p->name), parameters);
        }
        assert_true(parameters >= 1 && parameters <= PARAMETERS_MAX && row->wanted < parameters);
        assert_true(effect_find(names[i])->parameters[effect_find(names[i])->wanted].value == wanted[i]);
        /* An effect that needs z/far says so. */
        const dp_setup infinite = setup_of(0.1, INFINITY, DP_MAPPING_REVERSED, "fp32");
        const effect_view view = view_of(&infinite);
        double p[PARAMETERS_MAX];
        parameter_defaults(row->parameters, p);
        assert_true(effect_applies(row, &infinite) != row->eye01);
        assert_true((isnan(effect_error(row, &view, p, 10)) != 0) == row->eye01);
        assert_true(!row->eye01 || isnan(effect_usable(row, &view, p, 10, 1)));
    }
    assert_null(effect_find("bloom"));
    assert_null(effect_get(count()));
    assert_int_equal(parameter_find(effect_get(0)->parameters, "nothing"), -1);
}

TEST(test_limits) {
    const dp_setup infinite = setup_of(0.1, INFINITY, DP_MAPPING_D3D, "unorm24");
    const dp_setup finite = setup_of(0.1, 1000, DP_MAPPING_D3D, "unorm16");
    dp_setup pipeline = finite;
    effect_view at = view_of(&infinite), near = view_of(&finite), level = view_of(&finite);
    double p[PARAMETERS_MAX];
    /* The last cell of an infinite far plane has no end: no distance is enough, but 1/z stays where it is. */
    parameter_defaults(effect_find("intersection")->parameters, p);
    assert_true(effect_error(effect_find("intersection"), &at, p, 1e9) == 255);
    assert_true(isnan(effect_usable(effect_find("intersection"), &at, p, 1e9, 1)));
    parameter_defaults(effect_find("force-field")->parameters, p);
    assert_true(isnan(effect_usable(effect_find("force-field"), &at, p, 1e9, 1)));
    parameter_defaults(effect_find("motion-blur")->parameters, p);
    assert_true(effect_error(effect_find("motion-blur"), &at, p, 1e9) < 1e-4);
    /* Level ground: the height does not depend on the depth. */
    const effect_row *water = effect_find("water-line");
    parameter_defaults(water->parameters, p);
    assert_true(effect_error(water, &near, p, 10) == 255);
    level.along[1] = 0;
    assert_true(effect_error(water, &level, p, 10) == 0 && effect_usable(water, &level, p, 10, 1) == 0);
    level.setup = &infinite;
    assert_true(effect_error(water, &level, p, 1e9) == 0);
    /* Where fog has saturated no depth shows. */
    const effect_row *fog = effect_find("fog");
    parameter_defaults(fog->parameters, p);
    p[0] = 100;
    assert_true(effect_error(fog, &near, p, 500) == 0);
    assert_true(effect_usable(fog, &near, p, 500, 1) < 1);
    /* An orthographic camera that moves moves all alike. */
    dp_spec spec = finite.spec;
    dp_setup ortho;
    spec.ortho = 1;
    assert_int_equal(dp_setup_init(&ortho, &spec), DP_OK);
    const effect_view moved = view_of(&ortho);
    parameter_defaults(effect_find("motion-blur")->parameters, p);
    assert_true(effect_error(effect_find("motion-blur"), &moved, p, 10) == 0);
    /* Behind an orthographic camera a cell is as wide as before it: 65535 steps of 60/65535. */
    dp_format found[2];
    dp_format_parse("unorm16", found);
    spec.format = found[0];
    spec.znear = -10;
    spec.zfar = 50;
    assert_int_equal(dp_setup_init(&ortho, &spec), DP_OK);
    const effect_view behind = view_of(&ortho);
    for (double z = -9.5; z < 50; z += 1.25) {
        const double half = 30.0 / 65535;
        parameter_defaults(effect_find("intersection")->parameters, p);
        assert_relative(effect_error(effect_find("intersection"), &behind, p, z), 255 * half / 0.1, 1e-9);
        assert_relative(effect_usable(effect_find("intersection"), &behind, p, z, 1), 255 * half, 1e-9);
        parameter_defaults(effect_find("force-field")->parameters, p);
        assert_relative(effect_error(effect_find("force-field"), &behind, p, z), 255 * half, 1e-9);
    }
    /* No cells, no error. */
    pipeline.spec.model = DP_MODEL_FLOAT;
    const effect_view none = view_of(&pipeline);
    parameter_defaults(fog->parameters, p);
    assert_true(isnan(effect_error(fog, &none, p, 10)) && isnan(effect_usable(fog, &none, p, 10, 1)));
}

TEST(test_step_limits) {
    const dp_setup finite = setup_of(0.1, 1000, DP_MAPPING_D3D, "unorm16");
    const effect_view near = view_of(&finite);
    const effect_row *edge = effect_find("edge"), *shadow = effect_find("shadow");
    double p[PARAMETERS_MAX];
    /* A plane whose second pixel lies beyond the far plane is not seen there. */
    parameter_defaults(edge->parameters, p);
    p[edge->wanted] = 0.15;
    p[parameter_find(edge->parameters, "slope")] = 200;
    assert_true(effect_error(edge, &near, p, 900) == 0 && effect_usable(edge, &near, p, 900, 1) == 0);
    /* As many places are in the shadow of a plane that hardly leans as of one that faces the light. */
    parameter_defaults(shadow->parameters, p);
    const double facing = effect_share(shadow, &near, p, 30);
    p[parameter_find(shadow->parameters, "slope")] = 1e-14;
    assert_true(facing > 0.1 && facing < 0.9);
    assert_relative(effect_share(shadow, &near, p, 30), facing, 1e-9);
}

/* ---- Steps, from code to code ------------------------------------------------------------------------------------ */

/* The window depth of a code: a share of the greatest, or bits of a float of 16 or 32. */
static long double window_of(const dp_format *f, uint32_t code) {
    const int mantissa = f->code_max > 0xffff ? 23 : 10, bias = f->code_max > 0xffff ? 127 : 15;
    const int exponent = (int)(code >> mantissa);
    const long double rest = code & ((1U << mantissa) - 1);
    return f->kind == DP_FORMAT_UNORM ? (long double)code / f->code_max
           : exponent == 0            ? ldexpl(rest, 1 - bias - mantissa)
                                      : ldexpl(ldexpl(1, mantissa) + rest, exponent - bias - mantissa);
}

static long double eye_of_window(const dp_setup *s, long double d) {
    const long double n = s->spec.znear, f = s->spec.zfar;
    if (s->spec.mapping == DP_MAPPING_LINEAR)
        return d * f;
    if (s->spec.mapping == DP_MAPPING_LOG)
        return exp2l(d * log2l(f + 1)) - 1;
    return s->spec.mapping == DP_MAPPING_REVERSED ? 1 / (d / n + (1 - d) / f) : 1 / ((1 - d) / n + d / f);
}

/* By how many levels the outputs of a code and of the next one, farther away, differ; both depths. */
static long double step_by_hand(const hand *h, const dp_setup *s, uint32_t code, double p, long double z[2]) {
    const camera c = camera_of(s);
    const uint32_t next = s->spec.mapping == DP_MAPPING_REVERSED ? code - 1 : code + 1;
    z[0] = eye_of_window(s, window_of(&s->spec.format, code));
    z[1] = eye_of_window(s, window_of(&s->spec.format, next));
    return 255 * h->error(&c, (cell){.stored = z[0], .lo = z[0], .hi = z[1]}, p);
}

/* Codes near the one that ends it, and by chance. */
static void check_steps(tally *t, rng *r, const hand *h, const dp_setup *s, size_t *ended) {
    enum { CODES = 3000, BESIDE = 1000 };
    const effect_row *row = effect_find(h->name);
    const effect_view view = view_of(s);
    const bool reversed = s->spec.mapping == DP_MAPPING_REVERSED;
    const double near = s->spec.znear, far = s->spec.zfar, factor = rng_log(r, 0.03, 30);
    double p[PARAMETERS_MAX];
    parameters_of(row, p);
    p[row->wanted] = p[row->wanted] == 0 ? factor : p[row->wanted] * factor;
    const double reach_of = effect_reach(row, &view, p, true, near, far, 1);
    const uint32_t at = dp_code(s, isnan(reach_of) ? near : reach_of), first = dp_code(s, near), last = dp_code(s, far);
    const uint32_t least = (reversed ? last : first) + reversed, most = (reversed ? first : last) - !reversed;
    bool beyond = false;
    for (int i = 0; i < CODES; i++) {
        const int64_t beside = (int64_t)at + i - BESIDE / 2;
        const int64_t code = i < BESIDE ? beside : least + (int64_t)rng_below(r, (uint64_t)most - least + 1);
        if (code < (int64_t)least || code > (int64_t)most)
            continue;
        long double z[2];
        const long double levels = step_by_hand(h, s, (uint32_t)code, p[row->wanted], z);
        const double got = effect_step(row, &view, p, dp_stored(s, (uint32_t)code));
        const long double off = 1e-9L + 0x1p-40L * z[1] / (z[1] - z[0]);
        TALLY(t, z[0] < near || z[1] > far || fabsl(got - levels) <= off * fmaxl(levels, 1e-3L) * 2,
              "%s %s %s code %lld: %g levels, %Lg", h->name, s->spec.format.name, dp_mapping_get(s->spec.mapping)->name,
              (long long)code, got, levels);
        TALLY(t, !(z[1] <= reach_of) || z[0] < near || levels <= 1 + off,
              "%s %s %s: up to %.9g, but %Lg to %Lg are %Lg levels", h->name, s->spec.format.name,
              dp_mapping_get(s->spec.mapping)->name, reach_of, z[0], z[1], levels);
        beyond = beyond || (llabs(code - (int64_t)at) <= 2 && levels > 1 - off);
    }
    TALLY(t, reach_of >= far || beyond, "%s %s %s: ends at %.9g, where no step is a level", h->name,
          s->spec.format.name, dp_mapping_get(s->spec.mapping)->name, reach_of);
    *ended += reach_of < far;
}

TEST(test_steps_of_codes) {
    static const char *const formats[] = {"unorm16", "unorm24", "unorm10", "fp16", "fp32"};
    static const dp_mapping mappings[] = {DP_MAPPING_D3D, DP_MAPPING_GL, DP_MAPPING_REVERSED, DP_MAPPING_LINEAR,
                                          DP_MAPPING_LOG};
    rng r = rng_make("effects steps");
    tally t = {.name = "steps"};
    size_t ended = 0;
    for (size_t k = 0; k < HAND_COUNT; k++)
        for (size_t i = 0; effect_is_steady(effect_find(hands[k].name)) && i < 25; i++) {
            const dp_setup s = setup_of(i % 2 ? 0.1 : 0.3, i % 2 ? 1000 : 200, mappings[i % 5], formats[i / 5]);
            check_steps(&t, &r, &hands[k], &s, &ended);
        }
    assert_true(ended > 50);
    tally_end(&t);
}

/* 16 bits of a buffer from .3 to 200: codes 63391 and 63392 differ by 1.998 levels, one is passed 2.6 m before. */
TEST(test_step_of_soft_particles) {
    const dp_setup s = setup_of(0.3, 200, DP_MAPPING_D3D, "unorm16");
    const effect_view view = view_of(&s);
    const effect_row *row = effect_find("soft-particles");
    double p[PARAMETERS_MAX];
    parameter_defaults(row->parameters, p);
    p[row->wanted] = 0.5;
    assert_relative(effect_step(row, &view, p, dp_stored(&s, 63391)), 1.998, 1e-3);
    assert_relative(effect_reach(row, &view, p, true, 0.3, 200, 1), 6.21, 1e-3);
    assert_relative(effect_reach(row, &view, p, false, 0.3, 200, 1), 8.786, 1e-4);
    assert_true(isnan(effect_step(effect_find("shadow"), &view, p, 5)));
}

/* How far an effect stays within a level, and what does so everywhere: at as many depths as it takes to see. */
TEST(test_reach) {
    static const struct {
        const char *format;
        dp_mapping mapping;
        double zfar;
    } rows[] = {{"unorm16", DP_MAPPING_D3D, 1000},    {"unorm24", DP_MAPPING_REVERSED, 300},
                {"fp16", DP_MAPPING_D3D, 90},         {"fp16", DP_MAPPING_REVERSED, 1000},
                {"fp32", DP_MAPPING_D3D, 1e5},        {"fp32", DP_MAPPING_GL, 700},
                {"fp32", DP_MAPPING_REVERSED, 3.3e4}, {"unorm16", DP_MAPPING_LINEAR, 50}};
    enum { DEPTHS = 4000 };
    tally t = {.name = "reach"};
    rng r = rng_make("effects reach");
    size_t bounded = 0, everywhere = 0;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        for (size_t k = 0; effect_get(k) != NULL; k++) {
            const effect_row *row = effect_get(k);
            const double near = 0.1, far = rows[i].zfar;
            const dp_setup setup = setup_of(near, far, rows[i].mapping, rows[i].format);
            const effect_view view = {.setup = &setup, .base = {0, HEIGHT, 0}, .along = {0, RISE, 1}, .stretch = 1.3};
            double p[PARAMETERS_MAX], limited[PARAMETERS_MAX], most = 0;
            if (!effect_is_steady(row))
                continue;
            parameter_defaults(row->parameters, p);
            const double reach = effect_reach(row, &view, p, false, near, far, 1);
            const double usable = effect_usable_over(row, &view, p, false, near, far, 1);
            const texture_parameter *range = &row->parameters[row->wanted];
            const bool inside = usable > range->lo && usable < range->hi;
            memcpy(limited, p, sizeof p);
            TALLY(&t, isnan(reach) ? effect_error(row, &view, p, near) > 1 : reach >= near && reach <= far, "%s: %g",
                  row->name, reach);
            if (reach < far && reach > near * (1 + 1e-6)) /* at near, the steps of fp32 in d3d are next to none */
                TALLY(&t, effect_error(row, &view, p, reach * (1 + 1e-9)) > 1, "%s %s %d: within a level beyond %.17g",
                      row->name, rows[i].format, rows[i].mapping, reach);
            bounded += reach < far;
            everywhere += inside;
            for (int n = 0; n < DEPTHS; n++) {
                const double z = n % 2 == 0 ? rng_log(&r, near, far) : far - (far - near) * rng_log(&r, 1e-6, 1);
                TALLY(&t, !(z <= reach) || effect_error(row, &view, p, z) <= 1, "%s %s %d: at %.17g before %.17g",
                      row->name, rows[i].format, rows[i].mapping, z, reach);
                limited[row->wanted] = row->smallest ? usable * (1 + 1e-9) : usable * (1 - 1e-9);
                TALLY(&t, isnan(usable) || effect_error(row, &view, limited, z) <= 1,
                      "%s %s %d: %.17g is not enough at %.17g", row->name, rows[i].format, rows[i].mapping, usable, z);
                limited[row->wanted] = row->smallest ? 0.9 * usable : usable / 0.9;
                most = fmax(most, effect_error(row, &view, limited, z));
            }
            TALLY(&t, !inside || most > 1, "%s %s %d: less than %.17g is enough", row->name, rows[i].format,
                  rows[i].mapping, usable);
        }
    assert_true(bounded >= 20 && everywhere >= 20);
    tally_end(&t);
}
