/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The guaranteed separation of slanted triangles against rasterizers of our own, at a pixel: vertices rounded to
 * binary32, transformed, moved to a subpixel grid, set up and evaluated operation by operation, in the orders that were
 * measured of four rasterizers. Nothing at the guarantee or beyond may be out of order; how near wrong pairs come to it
 * is the share of it that is used. Random roundings seldom agree, so wrong pairs are searched for by climbing, and with
 * the models of src/raster too. test_triangles_drawn.c has the guarantee at length.
 *
 * Most vertices are placed where the grid moves them the wrong way: random ones hardly use what snapping takes.
 */
#include "plane_order.h"
#include "slanted.h"

/* ---- A rasterizer ------------------------------------------------------------------------------------------------ */

static float window_of(const slanted_camera *c, float clip, float w, int size) {
    const float half = 0.5F * (float)size;
    const float inverse = 1.0F / w;
    const float ndc = c->reciprocal ? clip * inverse : clip / w;
    const float scaled = ndc * half;
    return scaled + half;
}

static float snapped(float x, int bits) {
    return bits < 0 ? x : (float)ldexp(rint(ldexp((double)x, bits)), -bits);
}

/* The plane set up of clip coordinates. */
static corner projected(const slanted_camera *c, const double range[2], raster_vertex v) {
    const float inverse = 1.0F / v.w, lo = (float)range[0], span = (float)range[1] - lo;
    const float scaled = (c->reciprocal ? v.z * inverse : v.z / v.w) * span;
    return (corner){snapped(window_of(c, v.x, v.w, c->width), c->bits),
                    snapped(window_of(c, v.y, v.w, c->height), c->bits), scaled + lo, v.w};
}

static const struct {
    slanted_kind of;
    plane_order *value; /* null: the model of src/raster of that name */
    double used;        /* the least share of the guarantee that wrong pairs of fp32 come to */
} kinds[] = {{{"vertex", DP_ANCHOR_VERTEX, {4, 8}, "mesa"}, plane_at_vertex, 0.9},
             {{"origin", DP_ANCHOR_ORIGIN, {-1, -1}, "mesa"}, plane_at_origin, 0.3},
             {{"origin-unfused", DP_ANCHOR_ORIGIN_UNFUSED, {-1, -1}, "ieee"}, plane_unfused, 0.3},
             {{"origin-stepped", DP_ANCHOR_ORIGIN_STEPPED, {-1, -1}, "softpipe"}, plane_stepped, 0.3},
             {{"exact", DP_ANCHOR_COUNT, {-1, -1}, "ieee"}, plane_exact, 0.3},
             {{"llvmpipe", DP_ANCHOR_ORIGIN, {-1, -1}, "mesa"}, NULL, 0.3},
             {{"lavapipe", DP_ANCHOR_ORIGIN, {-1, -1}, "mesa"}, NULL, 0.3},
             {{"softpipe", DP_ANCHOR_ORIGIN_STEPPED, {-1, -1}, "softpipe"}, NULL, 0.3},
             {{"swiftshader", DP_ANCHOR_VERTEX, {4, 4}, "mesa"}, NULL, 0.9}};

enum { KINDS = sizeof kinds / sizeof kinds[0] };

/* 24 and 16 bits: the binary32 product to even, or truncated; ties of an exact one go up. */
static double code_of(const dp_setup *setup, float value) {
    const float d = value < 0.0F ? 0.0F : value > 1.0F ? 1.0F : value;
    const dp_conversion conversion = dp_arith_get(setup->spec.arith)->conversion;
    if (setup->spec.format.kind == DP_FORMAT_FLOAT)
        return (double)d;
    const float product = d * (float)setup->spec.format.code_max;
    if (conversion == DP_CONVERT_EXACT)
        return floor((double)d * (double)setup->spec.format.code_max + 0.5);
    return conversion == DP_CONVERT_PRODUCT_ZERO ? trunc((double)product) : rint((double)product);
}

/* ---- A pair of planes -------------------------------------------------------------------------------------------- */

static bool holds(const corner v[3], double px, double py) {
    int positive = 0, negative = 0;
    for (int i = 0; i < 3; i++) {
        const corner *a = &v[i], *b = &v[(i + 1) % 3];
        const double side =
            ((double)b->x - (double)a->x) * (py - (double)a->y) - ((double)b->y - (double)a->y) * (px - (double)a->x);
        positive += side >= 0.0;
        negative += side <= 0.0;
    }
    return positive == 3 || negative == 3;
}

/* The depth of a model of src/raster; false where it does not draw the pixel, or clips. */
static bool modelled(const slanted *s, const raster_vertex v[3], double *depth) {
    raster_target target;
    raster_triangle drawn;
    size_t row = 0;
    int from, to;
    float value;
    const int x = (int)s->px, y = (int)s->py;
    while (strcmp(raster_get(row)->name, s->kind->name) != 0)
        row++;
    if (!slanted_inside(v) || raster_target_init(&target, row, s->camera.width, s->camera.height, &s->setup.spec.format,
                                                 dp_path_best()) != RASTER_OK)
        return false;
    raster_target_range(&target, (float)s->setup.spec.depth_range[0], (float)s->setup.spec.depth_range[1]);
    if (raster_set_up(&target, v, &drawn) != RASTER_OK || drawn.count != 1 ||
        !raster_span(&target, &drawn.piece[0], y, &from, &to) || x < from || x >= to)
        return false;
    raster_depths(&target, &drawn.piece[0], y, x, x + 1, &value);
    *depth = (double)value;
    return true;
}

/* The code that is stored of one of the planes; false where that is nothing. */
static bool stored(const slanted *s, plane_order *value, int which, double c, double *code) {
    raster_vertex clip[3];
    corner v[3];
    if (!slanted_clip(s, which, c, clip))
        return false;
    double at[3][2];
    for (int i = 0; i < 3; i++) {
        v[i] = projected(&s->camera, s->setup.spec.depth_range, clip[i]);
        at[i][0] = (double)v[i].x;
        at[i][1] = (double)v[i].y;
    }
    if (!holds(v, s->px, s->py) || (slanted_is_moved(s) && !slanted_in_class(s, at)))
        return false;
    if (value == NULL)
        return modelled(s, clip, code);
    *code = code_of(&s->setup, value(v, (float)s->px, (float)s->py));
    return true;
}

static bool ordered(const slanted *s, const double code[2]) {
    return s->setup.reversed ? code[0] > code[1] : code[0] < code[1];
}

/* The nearer plane lies a share of the guarantee before the farther one, that of their own class; false: no pixel. */
static bool judge(slanted *s, plane_order *value, double share, bool *right) {
    double code[2], nearer;
    dp_budget b;
    if (!slanted_apart(s, share, &b, &nearer) || !stored(s, value, 0, nearer, &code[0]) ||
        !stored(s, value, 1, s->c, &code[1]))
        return false;
    *right = ordered(s, code);
    return true;
}

TEST(test_guarantee) {
    static const char *const formats[] = {"fp32", "unorm24", "unorm16"};
    tally t = {.name = "at the guarantee and beyond"};
    rng r = rng_make("triangles");
    for (int kind = 0; kind < KINDS && kinds[kind].value != NULL; kind++)
        for (size_t f = 0; f < sizeof formats / sizeof formats[0]; f++) {
            double used = 0.0;
            uint64_t judged = 0;
            for (uint64_t i = test_cases(2000, 30000, 5000000); i > 0; i--) {
                slanted s;
                bool right;
                assert_true(slanted_draw_camera(&r, &s, &kinds[kind].of, formats[f]));
                const bool beyond = rng_below(&r, 2) == 0;
                const double share =
                    beyond ? (rng_below(&r, 2) == 0 ? 1.0 : rng_log(&r, 1.0, 10.0)) : rng_log(&r, 0.02, 1.0);
                if (!slanted_draw_planes(&r, &s) || !judge(&s, kinds[kind].value, share, &right))
                    continue;
                judged++;
                if (!right && !beyond)
                    used = fmax(used, share);
                if (beyond)
                    TALLY(&t, right, "%s %s: share %.17g at z %.17g, slant %g, %d x %d, fov %g, %d bits", formats[f],
                          kinds[kind].of.name, share, s.z, s.class.slant_hi, s.camera.width, s.camera.height,
                          s.class.fov_y, s.camera.bits);
            }
            print_message("# %s %s: %llu pairs, %.2f of the guarantee used\n", kinds[kind].of.name, formats[f],
                          (unsigned long long)judged, used);
        }
    tally_end(&t);
}

/* ---- How much of it is used -------------------------------------------------------------------------------------- */

/*
 * Moves the vertices of one triangle by little, one at a time, and keeps what does not lead away from a wrong order.
 * The pixel and the plane stay, so what changes is what roundings add. False where the pixel is not drawn at first.
 */
static bool climb(rng *r, slanted *s, plane_order *value, int which, double c, double *code) {
    const double way = (which == 0) == (s->setup.reversed != 0) ? -1.0 : 1.0;
    if (!stored(s, value, which, c, code))
        return false;
    for (int i = 0; i < 300; i++) {
        double *at = s->at[which][rng_below(r, 3)], moved;
        const double kept[2] = {at[0], at[1]};
        const double reach = rng_log(r, 1e-4, 1.0);
        at[0] += rng_uniform(r, -reach, reach);
        at[1] += rng_uniform(r, -reach, reach);
        if (stored(s, value, which, c, &moved) && way * moved >= way * *code)
            *code = moved;
        else
            memcpy(at, kept, sizeof kept);
    }
    return true;
}

/* From a share on that is to be beaten: the largest at which the two are not in order, of those that were tried. */
static double wrong_share(rng *r, slanted *s, plane_order *value, double beaten) {
    double largest = 0.0, nearer, code[2];
    dp_budget b, now;
    for (double share = beaten * 1.02; slanted_apart(s, share, &b, &nearer); share = fmax(share, largest) * 1.05) {
        if (!climb(r, s, value, 0, nearer, &code[0]) || !climb(r, s, value, 1, s->c, &code[1]) || ordered(s, code))
            break;
        if (!slanted_fit(s, (const double[2]){nearer, s->c}) || !slanted_budget(s, &s->class, &now))
            break;
        largest = (s->c - nearer) / now.separation;
    }
    return largest;
}

/* How much longer the separation of the default class is, any slant, than that of the triangles' own. */
static double class_factor(slanted *s) {
    const dp_triangles standard = dp_triangles_default();
    dp_budget own, wide;
    double nearer;
    if (!slanted_apart(s, 1.0, &own, &nearer))
        return 1.0;
    dp_triangles any = s->class;
    any.slant_lo = 0.0;
    any.slant_hi = 90.0;
    any.depth = fmax(any.depth, standard.depth);
    any.pixels = fmax(any.pixels, standard.pixels);
    any.slim = fmax(any.slim, standard.slim);
    return slanted_budget(s, &any, &wide) && isfinite(wide.separation) ? wide.separation / own.separation : 1.0;
}

/* Each pair in a depth range of its own, or all in 0 to 1. */
static void judge_used(bool ranged, uint64_t cases, tally *t) {
    for (int kind = 0; kind < KINDS; kind++) {
        rng r = rng_make(kinds[kind].of.name);
        const double least = ranged ? 0.25 : kinds[kind].used;
        double used = 0.1, class = 0.0;
        uint64_t pairs = 0;
        for (uint64_t i = cases; i > 0; i--) {
            slanted s;
            assert_true(slanted_draw_camera(&r, &s, &kinds[kind].of, "fp32"));
            if (ranged)
                slanted_draw_range(&r, &s);
            if (!slanted_draw_planes(&r, &s))
                continue;
            class += log(class_factor(&s));
            pairs++;
            used = fmax(used, wrong_share(&r, &s, kinds[kind].value, used));
        }
        print_message("# %s: wrong pairs up to %.3f of the guarantee; the default class takes %.1f times as much\n",
                      kinds[kind].of.name, used, exp(class / (double)pairs));
        TALLY(t, used <= 1.0, "%s: wrong at %.3f", kinds[kind].of.name, used);
        if (test_effort() != EFFORT_QUICK)
            TALLY(t, used >= least, "%s: only %.3f is used", kinds[kind].of.name, used);
    }
}

TEST(test_used) {
    tally t = {.name = "share that is used"};
    judge_used(false, test_cases(100, 1000, 100000), &t);
    tally_end(&t);
}

TEST(test_used_in_ranges) {
    tally t = {.name = "share that is used in depth ranges"};
    judge_used(true, test_cases(100, 1000, 100000), &t);
    tally_end(&t);
}

/* ---- World positions --------------------------------------------------------------------------------------------- */

/* Whether the composition takes most of the guarantee. */
static bool is_composed(slanted *s) {
    dp_budget b;
    double nearer;
    return slanted_apart(s, 1.0, &b, &nearer) && b.cause[DP_CAUSE_COMPOSITION] > 0.5 * b.separation;
}

/*
 * The same with vertices somewhere in a world, through matrices that are rounded: both random and climbing. What is
 * used of it is that of pairs whose guarantee the composition takes most of.
 */
TEST(test_world) {
    tally t = {.name = "world positions"};
    for (int kind = 0; kind < KINDS && kinds[kind].value != NULL; kind++) {
        rng r = rng_make(kinds[kind].of.name);
        double used[DP_COMPOSITION_COUNT] = {0.01, 0.01, 0.01};
        uint64_t judged = 0;
        for (uint64_t i = test_cases(1000, 8000, 1000000); i > 0; i--) {
            slanted s;
            bool right;
            assert_true(slanted_draw_camera(&r, &s, &kinds[kind].of, rng_below(&r, 2) == 0 ? "fp32" : "unorm24"));
            const double share = rng_below(&r, 2) == 0 ? 1.0 : rng_log(&r, 1.0, 10.0);
            if (!slanted_draw_planes(&r, &s))
                continue;
            slanted_draw_world(&r, &s);
            double *most = &used[s.world.terms.composition];
            if (i % 10 == 0 && s.setup.spec.format.kind == DP_FORMAT_FLOAT && is_composed(&s))
                *most = fmax(*most, wrong_share(&r, &s, kinds[kind].value, *most));
            if (!judge(&s, kinds[kind].value, share, &right))
                continue;
            judged++;
            TALLY(&t, right, "%s: share %.17g at z %.17g, world %g", kinds[kind].of.name, share, s.z,
                  s.world.terms.world);
        }
        print_message("# %s: %llu pairs; wrong ones up to %.3f, %.3f and %.3f of the guarantee\n", kinds[kind].of.name,
                      (unsigned long long)judged, used[0], used[1], used[2]);
        for (int k = 0; k < DP_COMPOSITION_COUNT; k++)
            TALLY(&t, used[k] <= 1.0, "%s: wrong at %.3f", kinds[kind].of.name, used[k]);
    }
    tally_end(&t);
}

/* The same through the schemes for large worlds; where they are seen is off by up to as much as they are far away. */
TEST(test_schemes) {
    tally t = {.name = "schemes"};
    for (int kind = 0; kind < KINDS && kinds[kind].value != NULL; kind++)
        for (size_t row = 0; row < WORLD_ROWS; row++) {
            const world_scheme scheme = {world_get(row), world_get(row)->standard};
            rng r = rng_make(kinds[kind].of.name);
            double used = 0.0;
            uint64_t judged = 0;
            for (uint64_t i = test_cases(500, 4000, 500000); i > 0; i--) {
                slanted s;
                bool right;
                assert_true(slanted_draw_camera(&r, &s, &kinds[kind].of, rng_below(&r, 2) == 0 ? "fp32" : "unorm24"));
                const double share = rng_below(&r, 2) == 0 ? 1.0 : rng_log(&r, 0.2, 1.0);
                if (!slanted_draw_planes(&r, &s) || !slanted_draw_scheme(&r, &s, &scheme))
                    continue;
                if (i % 10 == 0 && s.setup.spec.format.kind == DP_FORMAT_FLOAT)
                    used = fmax(used, wrong_share(&r, &s, kinds[kind].value, fmax(used, 0.1)));
                if (!judge(&s, kinds[kind].value, share, &right))
                    continue;
                judged++;
                if (!right)
                    used = fmax(used, share);
                TALLY(&t, right || share < 1.0, "%s, %s: z %.17g, seen %.17g farther away, distance %g",
                      kinds[kind].of.name, scheme.row->name, s.z - s.world.shift[2], s.world.shift[2],
                      s.world.distance);
            }
            print_message("# %s, %s: %llu pairs; wrong ones up to %.3f of the guarantee\n", kinds[kind].of.name,
                          scheme.row->name, (unsigned long long)judged, used);
            TALLY(&t, used < 1.0, "%s, %s: wrong at %.3f", kinds[kind].of.name, scheme.row->name, used);
        }
    tally_end(&t);
}

/*
 * Both surfaces of meshes about one origin are seen farther away than they are, by a share of their depth that their
 * guarantee must count, where the grid takes most of it.
 */
TEST(test_seen_farther) {
    tally t = {.name = "seen farther away"};
    rng r = rng_make("seen farther away");
    const world_scheme scheme = {world_get(1), 0.0};
    double used = 0.0;
    assert_string_equal(scheme.row->name, "local");
    for (uint64_t i = test_cases(20000, 200000, 5000000); i > 0; i--) {
        slanted s;
        dp_budget b;
        double nearer;
        assert_true(slanted_draw_camera(&r, &s, &kinds[0].of, "fp32"));
        if (!slanted_draw_planes(&r, &s) || !slanted_draw_scheme(&r, &s, &scheme) || !s.world.shared_origin ||
            s.world.shift[2] < 0.01 * s.z || !slanted_apart(&s, 1.0, &b, &nearer) ||
            b.cause[DP_CAUSE_SNAPPING] < 0.75 * b.separation)
            continue;
        used = fmax(used, wrong_share(&r, &s, kinds[0].value, fmax(used, 0.5)));
    }
    print_message("# wrong pairs up to %.3f of the guarantee\n", used);
    TALLY(&t, used <= 1.0 && (used > 0.75 || test_effort() == EFFORT_QUICK), "wrong at %.3f", used);
    tally_end(&t);
}

/* ---- Snapping alone ---------------------------------------------------------------------------------------------- */

/* 1/z at the pixel of the plane through vertices that were moved, without rounding. */
static bool moved_inverse(const slanted *s, double c, int which, double *inverse) {
    double x[3], y[3], of[3];
    for (int i = 0; i < 3; i++) {
        const double *at = s->at[which][i];
        x[i] = ldexp(rint(ldexp(at[0], s->camera.bits)), -s->camera.bits);
        y[i] = ldexp(rint(ldexp(at[1], s->camera.bits)), -s->camera.bits);
        of[i] = slanted_along(s, at[0], at[1]) / c;
    }
    const double area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
    const double u = ((s->px - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (s->py - y[0])) / area;
    const double v = ((x[1] - x[0]) * (s->py - y[0]) - (s->px - x[0]) * (y[1] - y[0])) / area;
    *inverse = (1.0 - u - v) * of[0] + u * of[1] + v * of[2];
    return u >= 0.0 && v >= 0.0 && u + v <= 1.0;
}

TEST(test_snapping) {
    tally t = {.name = "snapping alone"};
    rng r = rng_make("snapping");
    double used = 0.0;
    for (uint64_t i = test_cases(20000, 400000, 20000000); i > 0; i--) {
        slanted s;
        dp_budget b;
        assert_true(slanted_draw_camera(&r, &s, &kinds[0].of, "fp32"));
        const double share = rng_below(&r, 2) == 0 ? 1.0 + 1e-6 : rng_uniform(&r, 0.5, 1.0);
        if (!slanted_draw_planes(&r, &s))
            continue;
        s.class.depth = 1.0;
        assert_true(slanted_budget(&s, &s.class, &b));
        const double c = s.c, nearer = c - share * b.cause[DP_CAUSE_SNAPPING];
        double first, second;
        if (b.cause[DP_CAUSE_SNAPPING] == 0.0 || !(nearer > 0.0) || !moved_inverse(&s, nearer, 0, &first) ||
            !moved_inverse(&s, c, 1, &second))
            continue;
        if (share > 1.0)
            TALLY(&t, first > second, "slant %g, %d bits at %.17g", s.class.slant_hi, s.camera.bits, s.z);
        else if (first <= second)
            used = fmax(used, share);
    }
    print_message("# %.3f of it used\n", used);
    TALLY(&t, used >= 0.95, "only %.3f of what snapping takes is used", used);
    tally_end(&t);
}
