/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The bias of one plane that is drawn twice, as different triangles: with the factor and the units that are said to be
 * enough at any slant, or for a slope, the biased one is in front in every pixel that both cover. Drawn by the models
 * of src/raster, which recorded codes guard, biased as Direct3D 11 says. With a small share of the bias it is not.
 */
#include "bias/bias.h"
#include "raster_named.h"
#include "slanted.h"

enum { ROWS = 4096 };

typedef struct layer {
    raster_triangle drawn;
    int from[ROWS], to[ROWS];
    double highest; /* of the vertices */
    double m;       /* the change of depth from pixel to pixel that it was drawn with */
} layer;

typedef struct outcome {
    tally pixels;
    uint64_t judged, failed; /* with a share of the bias */
} outcome;

static bool draw(const slanted *s, const raster_target *target, int which, layer *out) {
    raster_vertex v[3];
    if (!slanted_clip(s, which, s->c, v) || !slanted_inside(v) || raster_set_up(target, v, &out->drawn) != RASTER_OK)
        return false;
    const raster_piece *piece = &out->drawn.piece[0];
    for (int y = piece->y0; y < piece->y1; y++)
        if (!raster_span(target, piece, y, &out->from[y], &out->to[y]))
            out->from[y] = out->to[y] = 0;
    out->m = fmax(fabs((double)piece->plane.a), fabs((double)piece->plane.b));
    out->highest = 0.0;
    for (int i = 0; i < 3; i++)
        out->highest = fmax(out->highest, (double)(v[i].z / v[i].w * target->span + target->lo));
    return true;
}

/* Direct3D 11.3, 15.10: in binary32, on the depth before it is stored. */
static float biased(const slanted *s, const layer *of, float depth, double units, double factor) {
    const bool is_float = s->setup.spec.format.kind == DP_FORMAT_FLOAT;
    int e = -125;
    if (of->highest > 0.0)
        (void)frexp((double)(float)of->highest, &e);
    const double r = is_float ? ldexp(1.0, (e - 1 < -126 ? -126 : e - 1) - 23) : ldexp(1.0, -s->setup.spec.format.bits);
    const float constant = (float)(units * r), sloped = (float)(factor * (double)(float)of->m);
    return depth + (constant + sloped);
}

static uint32_t stored(const slanted *s, float depth) {
    const dp_format *format = &s->setup.spec.format;
    if (format->kind == DP_FORMAT_UNORM)
        return (uint32_t)lrint((double)depth * (double)format->code_max);
    uint32_t code;
    memcpy(&code, &depth, sizeof code);
    return code;
}

/* Scene units of eye depth from a pixel to the next, the greater of both axes. */
static double slope_at(const slanted *s, double x, double y, double z) {
    const double here = slanted_along(s, x, y), right = slanted_along(s, x + 1, y) - here,
                 up = slanted_along(s, x, y + 1) - here;
    return fmax(fabs(right), fabs(up)) * z / here;
}

static void judge_pixel(const slanted *s, const dp_setup *setup, const layer of[2], int x, int y, const float depth[2],
                        double share, double more, bool sloped, outcome *out) {
    const double z = s->c / slanted_along(s, x + 0.5, y + 0.5), sign = bias_sign(setup);
    bias_goal goal = {.api = bias_api_get(0)};
    for (size_t i = 0; strcmp(goal.api->name, "d3d11") != 0; i++)
        goal.api = bias_api_get(i);
    if (!(z >= setup->spec.znear && z <= setup->spec.zfar))
        return;
    if (sloped)
        goal.slope = slope_at(s, x + 0.5, y + 0.5, z) * (1.0 + 1e-9);
    if (sloped && more > 1.0) {
        goal.factor = 0.02 * more;
        goal.slope *= more; /* and enough for planes that are less steep */
    } else if (!sloped)
        goal.factor = bias_factor_least(setup) * more; /* what is more than the least needs no more units */
    const double units = bias_needed(setup, &goal, z);
    const float moved = biased(s, &of[0], depth[0], sign * floor(units * share), sign * goal.factor * share);
    if (!isfinite(units) || moved < 0.0F || moved > 1.0F || depth[1] < 0.0F || depth[1] > 1.0F)
        return;
    const uint32_t front = stored(s, moved), back = stored(s, depth[1]);
    const bool ordered = setup->reversed ? front > back : front < back;
    if (share < 1.0) {
        out->judged++;
        out->failed += !ordered;
        return;
    }
    TALLY(&out->pixels, ordered, "%s %s %d: z %.17g, slope %g, units %g, factor %g, m %g: %08x behind %08x",
          s->kind->name, setup->spec.format.name, setup->reversed, z, goal.slope, units, goal.factor, of[0].m, front,
          back);
}

static void judge(slanted *s, size_t row, double share, double more, bool sloped, outcome *out) {
    static layer of[2];
    static float depth[2][ROWS];
    const double c[2] = {s->c, s->c};
    raster_target target;
    dp_setup setup;
    if (!slanted_fit(s, c) || raster_target_init(&target, row, s->camera.width, s->camera.height, &s->setup.spec.format,
                                                 dp_path_best()) != RASTER_OK)
        return;
    raster_target_range(&target, (float)s->setup.spec.depth_range[0], (float)s->setup.spec.depth_range[1]);
    dp_spec spec = s->setup.spec;
    spec.model = DP_MODEL_EXACT;
    spec.triangles = s->class;
    if (dp_setup_init(&setup, &spec) != DP_OK || !draw(s, &target, 0, &of[0]) || !draw(s, &target, 1, &of[1]) ||
        slanted_height((const double(*)[2])s->at[0]) < 1.25 || slanted_height((const double(*)[2])s->at[1]) < 1.25)
        return;
    const raster_piece *first = &of[0].drawn.piece[0], *second = &of[1].drawn.piece[0];
    const int y0 = first->y0 > second->y0 ? first->y0 : second->y0;
    const int y1 = first->y1 < second->y1 ? first->y1 : second->y1;
    for (int y = y0; y < y1; y++) {
        const int from = of[0].from[y] > of[1].from[y] ? of[0].from[y] : of[1].from[y];
        const int to = of[0].to[y] < of[1].to[y] ? of[0].to[y] : of[1].to[y];
        if (from >= to)
            continue;
        for (int k = 0; k < 2; k++)
            raster_depths(&target, &of[k].drawn.piece[0], y, from, to, depth[k]);
        for (int x = from; x < to; x += 1 + (to - from) / 8)
            judge_pixel(s, &setup, of, x, y, (const float[2]){depth[0][x - from], depth[1][x - from]}, share, more,
                        sloped, out);
    }
}

TEST(test_drawn_twice) {
    static const struct {
        const char *name, *arith, *format;
        double share; /* of the bias, with which some pixels are wrong */
    } drawn[] = {{"llvmpipe", "mesa", "fp32", 0.1},
                 {"softpipe", "softpipe", "fp32", 0.1},
                 {"swiftshader", "mesa", "fp32", 0.5},
                 {"swiftshader", "mesa", "unorm16", 0.5},
                 {"llvmpipe", "mesa", "unorm24", 0.1}};
    for (size_t i = 0; i < sizeof drawn / sizeof drawn[0]; i++) {
        size_t row = 0;
        while (strcmp(raster_get(row)->name, drawn[i].name) != 0)
            row++;
        const int bits = raster_get(row)->plane_bits > 0 ? raster_get(row)->plane_bits : -1;
        const slanted_kind kind = {drawn[i].name, raster_get(row)->anchor, {bits, bits}, drawn[i].arith};
        char name[64];
        snprintf(name, sizeof name, "drawn twice %s %s", drawn[i].name, drawn[i].format);
        outcome out = {.pixels = {.name = name}};
        rng r = rng_make(name);
        const uint64_t wanted = test_cases(2000, 60000, 4000000);
        slanted s;
        while (out.pixels.cases < wanted && slanted_draw_camera(&r, &s, &kind, drawn[i].format)) {
            const double share = rng_below(&r, 4) == 0 ? drawn[i].share : 1.0;
            const bool sloped = rng_below(&r, 3) == 0;
            const double more = rng_below(&r, 2) == 0 || share < 1.0 ? 1.0 : rng_log(&r, 1.0, 100.0);
            if (share == 1.0 && rng_below(&r, 2) == 0)
                slanted_draw_range(&r, &s);
            if (slanted_draw_planes(&r, &s))
                judge(&s, row, share, more, sloped, &out);
        }
        tally_end(&out.pixels);
        print_message("# %s: %llu pixels, of %llu at %g of the bias %llu wrong\n", name,
                      (unsigned long long)out.pixels.cases, (unsigned long long)out.judged, drawn[i].share,
                      (unsigned long long)out.failed);
        assert_true(out.failed > 0 || test_effort() == EFFORT_QUICK);
    }
}

/* depthprec(7), by hand; a reversed camera without far plane loses one rounding of the divide alone. */
TEST(test_terms) {
    const double eps = 0x1p-24, z = 40;
    dp_spec spec = dp_spec_default();
    dp_setup setup;
    dp_coplanar got, wide;
    spec.znear = 0.25;
    spec.zfar = INFINITY;
    spec.mapping = DP_MAPPING_REVERSED;
    spec.triangles = (dp_triangles){1920, 1080, 60, 8, {2, 11, 2, 0}, 0, 90, 2, 512, 16};
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    assert_int_equal(dp_coplanar_over(&setup, z, z, &got), DP_OK);
    const double box = 0.5 + 0.5 * sqrt(257.0), d = spec.znear / z;
    const double axes = 3 * 1920 + 6 * 512 + 3 * 1080 + 6 * 512 + 2 * (11 * box + 2) * 512;
    const double moved = 2.0 / 512 + eps * (axes + 1920 + 1080 + 2 * 512);
    assert_relative(got.pixels, 2 * moved, 0.004);
    assert_relative(got.lost, 2 * moved + eps * (6 * box * 16 + 2 * box + 2), 0.004);
    assert_true(got.window >= 2 * eps * d * (0.5 * 2 + 2 * 2 + 1) &&
                got.window <= 2 * eps * d * (2 + 2 * 2 + 1) * 1.001);
    assert_true(got.lost_window == got.window);
    assert_true(bias_factor_least(&setup) >= got.pixels / (1 - got.lost));
    assert_true(bias_factor_least(&setup) <= got.pixels / (1 - got.lost) * 1.002 + 0x1p-12);
    /* In slim triangles the arithmetic of the gradients takes more than the grid. */
    dp_coplanar slim;
    spec.triangles.slim = 1000;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    assert_int_equal(dp_coplanar_over(&setup, z, z, &slim), DP_OK);
    const double long_box = 0.5 + 0.5 * hypot(1000, 1);
    assert_relative(slim.lost - slim.pixels, eps * (6 * long_box * 1000 + 2 * long_box + 2), 0.004);
    spec.triangles.slim = 16;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    /* Over a range it holds at each depth. */
    assert_int_equal(dp_coplanar_over(&setup, 7, INFINITY, &wide), DP_OK);
    assert_true(wide.window > 5 * got.window && wide.window < 7 * got.window && wide.pixels == got.pixels);
    assert_int_equal(dp_coplanar_over(&setup, 0.1, z, &got), DP_ERROR_DEPTH);
    assert_int_equal(dp_coplanar_over(&setup, z, 7, &got), DP_ERROR_DEPTH);
    assert_int_equal(dp_coplanar_over(NULL, z, z, &got), DP_ERROR_NULL);
    setup = dp_setup_facing(&setup);
    assert_int_equal(dp_coplanar_over(&setup, z, z, &got), DP_ERROR_TRIANGLES);
    assert_true(bias_factor_least(&setup) == 0);
    spec.mapping = DP_MAPPING_LOG;
    spec.zfar = 1000;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    assert_int_equal(dp_coplanar_over(&setup, z, z, &got), DP_ERROR_MODEL);
    /* The coarsest grid, and triangles a pixel high, turn slopes by too much for any factor. */
    spec.mapping = DP_MAPPING_D3D;
    spec.triangles.subpixel = 1;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    assert_true(isinf(bias_factor_least(&setup)));
    for (size_t i = 0; bias_api_get(i) != NULL; i++) {
        const bias_goal goal = {.api = bias_api_get(i), .factor = bias_factor_least(&setup)};
        double worst = -1;
        assert_true(isinf(bias_needed(&setup, &goal, z)));
        assert_true(isinf(bias_needed_over(&setup, &goal, z, 2 * z, &worst)));
        assert_true(worst >= z && worst <= 2 * z);
    }
}

/* A bias that is enough over a range is enough at each depth of it, and not many times what some depth needs. */
TEST(test_range) {
    static const char *const formats[] = {"fp32", "unorm24", "fp16"};
    tally t = {.name = "range"};
    rng r = rng_make("bias range");
    for (uint64_t i = 0; i < test_cases(20, 100, 2000); i++) {
        dp_spec spec = dp_spec_default();
        dp_format found[2];
        dp_setup setup;
        double worst, most = 0;
        dp_format_parse(formats[rng_below(&r, 3)], found);
        spec.format = found[0];
        spec.znear = rng_log(&r, 0.01, 1);
        spec.zfar = rng_below(&r, 2) == 0 ? INFINITY : spec.znear * rng_log(&r, 100, 1e6);
        spec.mapping = rng_below(&r, 2) == 0 ? DP_MAPPING_REVERSED : DP_MAPPING_D3D;
        spec.triangles = dp_triangles_default();
        assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
        const double lo = spec.znear * rng_log(&r, 2, 5), hi = lo * rng_log(&r, 1.1, 10);
        bias_goal goal = {.api = bias_api_get(rng_below(&r, 3)), .factor = bias_factor_least(&setup)};
        if (rng_below(&r, 2) == 0)
            goal = (bias_goal){.api = goal.api, .slope = lo * rng_log(&r, 1e-4, 1)};
        const double all = bias_needed_over(&setup, &goal, lo, hi, &worst);
        for (int k = 0; k < 200; k++) {
            const double z = k == 0 ? lo : k == 1 ? hi : rng_log(&r, lo, hi), here = bias_needed(&setup, &goal, z);
            TALLY(&t, here <= all, "%s %d: %g at z %.17g, %g over %.17g to %.17g", spec.format.name, spec.mapping, here,
                  z, all, lo, hi);
            most = fmax(most, here);
        }
        TALLY(&t, worst >= lo && worst <= hi && all <= 2.5 * most + 2, "%s %d: %g over %g to %g, but %g at most",
              spec.format.name, spec.mapping, all, lo, hi, most);
    }
    tally_end(&t);
}
