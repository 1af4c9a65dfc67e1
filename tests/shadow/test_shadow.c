/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The numbers of src/shadow: each part of what is needed by the formulas of depthprec(7); that each bias covers what is
 * needed at every slant and azimuth, and no more than it must; units as APIs define them; cascades about the corners of
 * their frusta; what is refused. test_shadow_drawn.c has the promise itself.
 */
#include "shadow/shadow.h"
#include "support.h"

static const double pi = 3.14159265358979323846;
static const double eps = 1.0 / 16777216.0;

static shadow_light random_light(rng *r) {
    static const char *const formats[] = {"fp32", "unorm24", "unorm16", "unorm32", "fp16"};
    static const dp_mapping mappings[] = {DP_MAPPING_D3D, DP_MAPPING_GL, DP_MAPPING_REVERSED, DP_MAPPING_GL_REVERSED};
    shadow_light light = shadow_light_default();
    dp_triangles *t = &light.triangles;
    dp_spec spec = light.setup.spec;
    dp_format found[2];
    assert_int_equal(dp_format_parse(formats[rng_below(r, 5)], found), 1);
    spec.format = found[0];
    spec.mapping = mappings[rng_below(r, 4)];
    spec.rounding = (dp_rounding)rng_below(r, DP_ROUNDING_COUNT);
    spec.arith = rng_below(r, dp_arith_count());
    spec.znear = rng_uniform(r, -10.0, 10.0);
    spec.zfar = spec.znear + rng_log(r, 1.0, 1e4);
    assert_int_equal(dp_setup_init(&light.setup, &spec), DP_OK);
    light.width = rng_log(r, 0.1, 1e4);
    light.height = rng_below(r, 2) ? light.width : rng_log(r, 0.1, 1e4);
    t->width = (int)rng_log(r, 16, 16384);
    t->height = rng_below(r, 2) ? t->width : (int)rng_log(r, 16, 16384);
    t->subpixel = (int)rng_below(r, 9);
    t->plane = dp_anchor_get((dp_anchor)rng_below(r, DP_ANCHOR_COUNT))->plane;
    t->pixels = rng_log(r, 1, 4096);
    t->slim = rng_log(r, 2, 100);
    t->slant_hi = rng_uniform(r, 0.5, 85);
    light.small = rng_log(r, 0.5, 20);
    light.kernel = rng_uniform(r, 0.5, 8);
    light.subtexel = (int)rng_below(r, 9);
    light.world = rng_below(r, 2) ? rng_log(r, 1, 1e5) : 0.0;
    light.position = rng_below(r, 2) ? rng_log(r, 1e-6, 1e-2) : 0.0;
    light.radius = rng_below(r, 2) ? rng_log(r, 0.1, 1e3) : INFINITY;
    light.facet = rng_below(r, 2) ? rng_log(r, 1e-3, 1) : 0.0;
    light.receiver_lo = spec.znear;
    light.receiver_hi = spec.zfar;
    assert_int_equal(shadow_light_check(&light), SHADOW_OK);
    return light;
}

/* ---- Parts ------------------------------------------------------------------------------------------------------- */

/* The lengths that depthprec(7) names. */
typedef struct lengths {
    double depth, tx, ty, smaller, diagonal, size, reach, far_off, position, matrix, box, vertex;
} lengths;

static lengths lengths_of(const shadow_light *light) {
    const dp_triangles *t = &light->triangles;
    lengths l = {.depth = light->setup.spec.zfar - light->setup.spec.znear};
    l.tx = light->width / t->width;
    l.ty = light->height / t->height;
    l.smaller = fmin(l.tx, l.ty);
    l.diagonal = sqrt(l.tx * l.tx + l.ty * l.ty);
    l.size = t->width > t->height ? t->width : t->height;
    l.reach = t->pixels;
    l.far_off = l.size + l.reach;
    const double own = sqrt(light->width * light->width + light->height * light->height + l.depth * l.depth) / 2;
    l.position = light->world > 0 ? sqrt(3) * light->world : own;
    l.matrix = light->world > 0 ? 2 * l.position : own;
    l.box = (1 + sqrt(t->slim * t->slim + 1)) / 2;
    l.vertex = 4 * eps * l.matrix / l.smaller + eps * (2 * l.size + 4 * l.reach);
    return l;
}

static double format_part(const shadow_light *light) {
    const dp_format *f = &light->setup.spec.format;
    const dp_conversion c = dp_arith_get(light->setup.spec.arith)->conversion;
    const bool zero =
        c == DP_CONVERT_EXACT ? light->setup.spec.rounding == DP_ROUND_ZERO : c == DP_CONVERT_PRODUCT_ZERO;
    if (strcmp(f->name, "fp32") == 0)
        return eps;
    if (strcmp(f->name, "fp16") == 0) /* below 1 numbers are 2^-11 apart */
        return eps + (light->setup.spec.rounding == DP_ROUND_ZERO ? 0x1p-11 : 0x1p-12);
    const double codes = ldexp(1, f->bits) - 1;
    return eps +
           (zero                         ? 1
            : c == DP_CONVERT_SIXTEENTHS ? 9.0 / 16
                                         : 0.5) /
               codes +
           (c == DP_CONVERT_EXACT ? 1 : 2) * eps;
}

static void expected_parts(const shadow_light *light, const lengths *l, shadow_part part[SHADOW_CAUSE_COUNT]) {
    const dp_triangles *t = &light->triangles;
    const double moved = 3 * eps * l->position;
    const double c2 = t->plane.box * l->box * (1 + 2 * t->plane.origin * eps * l->far_off) + t->plane.range;
    part[SHADOW_CAUSE_TEXEL] = (shadow_part){0.5, 0};
    part[SHADOW_CAUSE_KERNEL] = (shadow_part){light->kernel - 0.5, 0};
    part[SHADOW_CAUSE_LOOKUP] =
        (shadow_part){(light->subtexel ? 0.6 * pow(2, -light->subtexel) : 0) + 2 * eps * l->size, 0};
    part[SHADOW_CAUSE_SNAPPING] = (shadow_part){t->subpixel ? pow(2, -t->subpixel) / 2 : 0, 0};
    part[SHADOW_CAUSE_SETUP] =
        (shadow_part){eps * (t->plane.origin * l->far_off + c2 * l->reach), eps * t->plane.value};
    part[SHADOW_CAUSE_POSITION] = (shadow_part){l->vertex + 4 * eps * l->matrix / l->smaller + moved / l->diagonal,
                                                8 * eps * l->matrix / l->depth + 6 * eps + moved / l->depth};
    part[SHADOW_CAUSE_RECEIVER] = (shadow_part){light->position / l->diagonal, light->position / l->depth};
    part[SHADOW_CAUSE_FORMAT] = (shadow_part){0, format_part(light)};
}

TEST(test_parts) {
    rng r = rng_make("shadow parts");
    for (uint64_t n = test_cases(50, 2000, 200000); n > 0; n--) {
        const shadow_light light = random_light(&r);
        const lengths l = lengths_of(&light);
        const double slope = tan(light.triangles.slant_hi * pi / 180);
        shadow_part want[SHADOW_CAUSE_COUNT];
        shadow_need need;
        shadow_need_of(&light, &need);
        expected_parts(&light, &l, want);
        double texels = 0, window = 0;
        for (int i = 0; i < SHADOW_CAUSE_COUNT; i++) {
            assert_relative(need.part[i].texels, want[i].texels, 1e-12);
            assert_relative(need.part[i].window, want[i].window, 1e-12);
            assert_relative(shadow_part_at(&light, &need.part[i], light.triangles.slant_hi),
                            want[i].texels * slope * l.diagonal / l.depth + want[i].window, 1e-12);
            texels += want[i].texels;
            window += want[i].window;
        }
        assert_relative(need.texels, texels, 1e-12);
        assert_relative(need.window, window, 1e-12);
        assert_relative(need.texel_x, l.tx, 1e-12);
        assert_relative(need.texel_y, l.ty, 1e-12);
        assert_relative(need.texel, fmax(l.tx, l.ty), 1e-12);
        assert_relative(need.slope, slope, 1e-12);
    }
}

/* ---- Biases ------------------------------------------------------------------------------------------------------ */

/* By how much a bias lifts a surface, window depth, of a slope and an azimuth; m is least where triangles are small. */
static double lifted(const lengths *l, const shadow_bias *b, double slant, double azimuth, double lost) {
    const double slope = tan(slant);
    const double gx = slope * fabs(cos(azimuth)) * l->tx / l->depth, gy = slope * fabs(sin(azimuth)) * l->ty / l->depth;
    const double m = fmax(gx, gy) - (gx + gy) * lost;
    return b->window + (b->factor > 0 ? b->factor * m : 0) + b->offset * slope / l->depth;
}

/* The error that a triangle's gradients may have: a part of both, and window depth, a texel, which vertices are off by.
 */
typedef struct drawn {
    double part, whole;
} drawn;

static drawn drawn_of(const shadow_light *light, const lengths *l) {
    const dp_triangles *t = &light->triangles;
    const double snap = t->subpixel ? pow(2, -t->subpixel) / 2 : 0, place = eps * l->position;
    const double vertex = 4 * eps * (l->matrix / l->depth + 0.5) + eps + place / l->depth;
    return (drawn){2 * (snap + l->vertex + place / l->smaller) / light->small +
                       eps * (6 * l->box * t->slim + 2 * l->box + 2),
                   2 * vertex / light->small};
}

TEST(test_biases) {
    rng r = rng_make("shadow biases");
    tally enough = {.name = "azimuths and slants"}, least = {.name = "least biases"};
    for (uint64_t n = test_cases(50, 1000, 50000); n > 0; n--) {
        const shadow_light light = random_light(&r);
        const dp_triangles *t = &light.triangles;
        const lengths l = lengths_of(&light);
        const double greatest = t->slant_hi * pi / 180, slope = tan(greatest);
        shadow_need need;
        shadow_need_of(&light, &need);
        const drawn d = drawn_of(&light, &l);
        const double lost = d.part;
        const double off = need.texels * l.diagonal;
        const double curved = isinf(light.radius) ? 0
                                                  : pow(1 + slope * slope, 1.5) / light.radius *
                                                        (off * off / 2 + 2 * off * light.facet) / l.depth;
        assert_relative(need.curvature, curved, 1e-6);
        assert_int_equal(isinf(need.bias[SHADOW_SLOPE].factor), lost >= 0.5);
        for (shadow_way way = 0; way < SHADOW_WAY_COUNT; way++) {
            const shadow_bias *b = &need.bias[way];
            double tightest = INFINITY;
            if (isinf(b->factor))
                continue;
            for (int i = 0; i <= 40; i++)
                for (int k = 0; k <= 41; k++) {
                    const double slant = greatest * i / 40;
                    const double turn = k == 41 ? atan2(l.ty, l.tx) : k == 40 ? atan2(l.tx, l.ty) : 0.5 * pi * k / 39;
                    const double turned = way == SHADOW_CONSTANT ? 4 * eps : 0;
                    const double across = tan(slant + turned) * (fabs(cos(turn)) * l.tx + fabs(sin(turn)) * l.ty);
                    const double most =
                        need.texels * l.diagonal * tan(greatest + 4 * eps) / l.depth; /* whatever m is */
                    const double wanted = need.texels * across / l.depth + need.window +
                                          (way == SHADOW_SLOPE ? fmin(curved + d.whole * b->factor, most) : 0) +
                                          (way == SHADOW_NORMAL ? off / 1024 / l.depth : 0);
                    const double has = lifted(&l, b, slant, turn, lost);
                    TALLY(&enough, has >= wanted, "%s: %.17g for %.17g", shadow_way_name(way), has, wanted);
                    tightest = fmin(tightest, has / wanted - 1);
                }
            TALLY(&least, tightest <= 2e-6, "%s: by %g too much", shadow_way_name(way), tightest);
        }
    }
    tally_end(&enough);
    tally_end(&least);
}

TEST(test_gaps) {
    rng r = rng_make("shadow gaps");
    for (uint64_t n = test_cases(50, 1000, 50000); n > 0; n--) {
        const shadow_light light = random_light(&r);
        const lengths l = lengths_of(&light);
        const double slant = light.triangles.slant_hi * pi / 180;
        const drawn d = drawn_of(&light, &l);
        shadow_need need;
        shadow_need_of(&light, &need);
        for (shadow_way way = 0; way < SHADOW_WAY_COUNT; way++) {
            const shadow_bias *b = &need.bias[way];
            double widest = 0;
            if (isinf(b->factor))
                continue;
            for (int k = 0; k < 2; k++) /* steepest along x or y: m is greatest */
                widest = fmax(widest, lifted(&l, b, slant, k * pi / 2, 0) * l.depth);
            const double flat = b->factor * sqrt(2) * d.whole * l.depth; /* either gradient too great by that */
            widest += flat + b->factor * sqrt(2) * d.part * tan(slant) * l.diagonal;
            assert_relative(b->gap_light, widest, 1e-9);
            assert_relative(b->gap_normal, widest * cos(slant), 1e-9);
            assert_relative(b->gap_facing, b->window * l.depth + flat, 1e-9);
            assert_int_equal(b->limited, light.receiver_hi + b->gap_light > light.setup.spec.zfar);
            /* Slope times radius, of the bias, where each axis needs as much as it is wide. */
            const double turn = atan2(l.ty, l.tx);
            const double bare = light.kernel * tan(slant) * (cos(turn) * l.tx + sin(turn) * l.ty) / l.depth;
            assert_relative(b->share, bare / lifted(&l, b, slant, turn, 0), 1e-9);
        }
        /* Flat: the offset that lifts enough at every slant by itself. */
        double most = 0;
        for (int i = 0; i <= 1000; i++) {
            const double at = slant * i / 1000;
            most = fmax(most, (need.texels * l.diagonal * tan(at) + need.window * l.depth) * cos(at));
        }
        assert_in_range((uint64_t)(1e6 * need.offset_only / most), 1000000, 1001200); /* and 2^-10 for the sine */
    }
}

/* ---- As programs set them ---------------------------------------------------------------------------------------- */

/* r by the definition of the rule. */
static double worth(const bias_api *api, const dp_format *format, double d) {
    int e;
    const bias_rule rule = format->kind == DP_FORMAT_FLOAT ? api->real : api->unorm;
    (void)frexp((double)(float)d, &e);
    return rule == BIAS_ONE        ? 1.0
           : rule == BIAS_EXPONENT ? ldexp(1.0, e - 1 - format->mantissa_bits)
           : rule == BIAS_MANTISSA ? ldexp(1.0, -format->mantissa_bits - 1)
           : rule == BIAS_CODE     ? (double)(float)(1.0 / (ldexp(1.0, format->bits) - 1.0))
                                   : ldexp(1.0, -format->bits);
}

/*
 * The greatest window depth in triangles of casters that may lack room: binade by binade from the light on, whether the
 * farthest caster that reaches into it lies within bias and constant bias of the nearest receiver. 0 where it is close.
 */
static double top_of_casters(const shadow_light *light, const lengths *l, const shadow_need *need, double rest,
                             double units, const bias_api *api, double factor) {
    const double deep = light->receiver_lo - light->setup.spec.znear, top = 1 - deep / l->depth;
    const double reach = light->triangles.pixels * l->diagonal * tan(light->triangles.slant_hi * pi / 180);
    if (!light->setup.reversed)
        return (light->receiver_hi - light->setup.spec.znear) / l->depth;
    for (double d = 1; d > top; d /= 2) {
        const double bias = units * worth(api, &light->setup.spec.format, d) * factor * l->depth + rest;
        const double spare = deep - (1 - d) * l->depth - reach - bias - need->bias[SHADOW_CONSTANT].window * l->depth;
        if (fabs(spare) < 1e-3 * l->depth)
            return 0;
        if (spare < 0)
            return d;
    }
    return top;
}

TEST(test_states) {
    rng r = rng_make("shadow states");
    tally enough = {.name = "units enough"}, least = {.name = "units least"}, gaps = {.name = "gaps of units"};
    for (uint64_t n = test_cases(50, 1000, 50000); n > 0; n--) {
        shadow_light light = random_light(&r);
        shadow_need need;
        const double n0 = light.setup.spec.znear, depth = light.setup.spec.zfar - n0;
        light.receiver_lo = n0 + depth * rng_uniform(&r, 0.2, 0.5);
        light.receiver_hi = n0 + depth * rng_uniform(&r, 0.5, 0.8);
        shadow_need_of(&light, &need);
        const int way = (int)rng_below(&r, SHADOW_WAY_COUNT);
        const shadow_bias *b = &need.bias[way];
        if (isinf(b->factor) || b->gap_light > 0.1 * depth)
            continue;
        for (size_t i = 0; bias_api_get(i) != NULL; i++) {
            const bias_api *api = bias_api_get(i);
            const dp_format *format = &light.setup.spec.format;
            const shadow_state s = shadow_state_of(&light, b, api);
            const bool counted = api->unorm != BIAS_ONE;
            double smallest = INFINITY;
            for (int k = 0; k <= 20; k++) {
                const double part =
                    (light.receiver_lo - n0) / depth + k * (light.receiver_hi - light.receiver_lo) / depth / 20;
                const double d = (light.setup.reversed ? 1 - part : part) - b->gap_light / depth;
                const double unit = worth(api, format, d);
                smallest = fmin(smallest, unit);
                TALLY(&enough, s.units * unit >= b->window, "%s %s: %.17g times %.17g for %.17g", api->name,
                      format->name, s.units, unit, b->window);
            }
            TALLY(&least,
                  counted ? (s.units - 1) * smallest <= b->window * (1 + 1e-6) && s.units == rint(s.units)
                          : s.units <= b->window * (1 + 1e-6),
                  "%s %s: %.17g times %.17g for %.17g", api->name, format->name, s.units, smallest, b->window);
            const bool is_float = format->kind == DP_FORMAT_FLOAT;
            const bool bound = is_float ? api->real == BIAS_EXPONENT && strchr("gvt", api->name[0]) != NULL /* n + 1 */
                                        : api->unorm == BIAS_BOUND;
            const lengths l = lengths_of(&light);
            const double rest = b->gap_light - b->window * depth, times = bound ? 2 : 1;
            const double top = top_of_casters(&light, &l, &need, rest, s.units, api, times);
            if (top == 0)
                continue;
            const double wide = s.units * worth(api, format, top) * times * depth + rest;
            TALLY(&gaps,
                  fabs(s.gap_light / wide - 1) < 1e-6 && s.factor >= b->factor && s.factor <= b->factor * (1 + 1e-6),
                  "%s: %g not %g", api->name, s.gap_light, wide);
            TALLY(&gaps, fabs(s.gap_facing - wide + (b->gap_light - b->gap_facing)) <= 1e-6 * wide, "%s facing: %g",
                  api->name, s.gap_facing);
            assert_relative(s.gap_normal, s.gap_light * cos(light.triangles.slant_hi * pi / 180), 1e-12);
        }
    }
    tally_end(&enough);
    tally_end(&least);
    tally_end(&gaps);
}

TEST(test_hopeless) {
    const shadow_light light = shadow_light_default(); /* lit from depth 0 on, where a unit of fp32 is worth nothing */
    shadow_need need;
    shadow_need_of(&light, &need);
    for (size_t i = 0; bias_api_get(i) != NULL; i++)
        assert_int_equal(isinf(shadow_state_of(&light, &need.bias[0], bias_api_get(i)).units),
                         bias_api_get(i)->real == BIAS_EXPONENT);
    assert_int_equal(shadow_sign(&light), 1);
    shadow_light reversed = light;
    dp_spec spec = light.setup.spec;
    spec.mapping = DP_MAPPING_REVERSED;
    assert_int_equal(dp_setup_init(&reversed.setup, &spec), DP_OK);
    assert_int_equal(shadow_sign(&reversed), -1);
}

/* ---- Cascades ---------------------------------------------------------------------------------------------------- */

/* How far the farthest of the eight corners lies from a place on the axis. */
static double farthest(const shadow_split *s, const shadow_cascade *c, double z) {
    double most = 0;
    for (int i = 0; i < 8; i++) {
        const double at = i & 1 ? c->from : c->to, y = at * tan(s->fov_y * pi / 360), x = y * s->aspect;
        most = fmax(most, sqrt(x * x + y * y + (at - z) * (at - z)));
    }
    return most;
}

TEST(test_cascades) {
    rng r = rng_make("cascades");
    for (uint64_t n = test_cases(50, 1000, 50000); n > 0; n--) {
        const shadow_light model = random_light(&r);
        shadow_split s = shadow_split_default();
        double before;
        s.znear = before = rng_log(&r, 0.01, 10);
        s.zfar = s.znear * rng_log(&r, 1.5, 1e5);
        s.fov_y = rng_uniform(&r, 10, 120);
        s.aspect = rng_log(&r, 0.5, 3);
        s.count = 1 + (int)rng_below(&r, SHADOW_CASCADES_MAX);
        s.lambda = rng_unit(&r);
        s.casters = rng_below(&r, 2) ? rng_log(&r, 1, 1e4) : 0;
        s.stable = rng_below(&r, 2);
        for (int i = 0; i < s.count; i++) {
            shadow_cascade c;
            const shadow_status status = shadow_cascade_of(&s, &model, i, &c);
            const double texels = fmin(model.triangles.width, model.triangles.height);
            const double margin = 2.5 * model.kernel + 1 + (s.stable ? 0.5 : 0);
            if (2 * margin >= texels) {
                assert_int_equal(status, SHADOW_BOX);
                continue;
            }
            assert_int_equal(status, SHADOW_OK);
            const double part = (i + 1.0) / s.count;
            assert_relative(c.from, before, 1e-12);
            before = c.to;
            assert_relative(c.to,
                            s.lambda * exp(log(s.znear) + part * log(s.zfar / s.znear)) +
                                (1 - s.lambda) * (s.znear + part * (s.zfar - s.znear)),
                            1e-12);
            /* The sphere has all corners, one of them on it, and none about another place is smaller. */
            assert_relative(farthest(&s, &c, c.centre), c.radius, 1e-9);
            for (int k = -20; k <= 20; k++)
                assert_true(farthest(&s, &c, c.centre + k * c.radius / 20) >= c.radius * (1 - 1e-9));
            /* The box has the sphere and what lookups reach beyond it. */
            const double texel = c.light.width / texels;
            assert_relative(c.light.width, 2 * (c.radius + margin * texel), 1e-9);
            assert_relative(c.light.height, c.light.width, 1e-12);
            assert_relative(c.light.receiver_lo, s.casters, 1e-12);
            assert_relative(c.light.receiver_hi, s.casters + 2 * c.radius, 1e-12);
            assert_true(c.light.setup.spec.znear == 0 && c.light.setup.spec.zfar >= c.light.receiver_hi);
            assert_int_equal(c.light.triangles.width, model.triangles.width);
            if (model.setup.spec.format.bits >= 24 && isinf(model.radius)) {
                shadow_need need;
                shadow_need_of(&c.light, &need);
                for (int way = 0; way < SHADOW_WAY_COUNT; way++)
                    assert_true(!need.bias[way].limited || need.bias[way].factor > 20 * need.texels);
            }
        }
    }
}

/* ---- At the door ------------------------------------------------------------------------------------------------- */

/* The ends of all ranges: numbers, or INFINITY where there is no such bias. */
TEST(test_extremes) {
    rng r = rng_make("shadow extremes");
    for (uint64_t n = test_cases(200, 5000, 100000); n > 0; n--) {
        shadow_light light = random_light(&r);
        shadow_need need;
        shadow_cascade c;
        const bool high[] = {rng_below(&r, 2), rng_below(&r, 2), rng_below(&r, 2), rng_below(&r, 2), rng_below(&r, 2)};
        light.width = high[0] ? 1e12 : 1e-12;
        light.height = high[1] ? 1e12 : 1e-12;
        light.small = high[2] ? 65536 : 0x1p-8;
        light.world = high[3] ? 1e18 : 0;
        light.facet = high[4] ? 1e18 : 0;
        light.kernel = high[rng_below(&r, 5)] ? 64 : 0.5;
        light.triangles.slant_hi = high[rng_below(&r, 5)] ? SHADOW_SLANT_MAX : 0;
        light.triangles.slim = high[rng_below(&r, 5)] ? 1024 : 2;
        assert_int_equal(shadow_light_check(&light), SHADOW_OK);
        const shadow_split s = {.znear = high[0] ? 1 : 1e-12,
                                .zfar = high[1] ? 1e12 : 1.001,
                                .fov_y = high[2] ? 179.9 : 0.001,
                                .aspect = high[3] ? 1000 : 0.001,
                                .count = SHADOW_CASCADES_MAX,
                                .lambda = high[4],
                                .casters = high[3] ? 1e12 : 0};
        if (shadow_cascade_of(&s, &light, (int)rng_below(&r, SHADOW_CASCADES_MAX), &c) == SHADOW_OK && rng_below(&r, 2))
            light = c.light;
        shadow_need_of(&light, &need);
        for (int way = 0; way < SHADOW_WAY_COUNT; way++) {
            const shadow_bias *b = &need.bias[way];
            assert_true(b->window >= 0 && b->factor >= 0 && b->offset >= 0 && b->share >= 0 && b->share <= 1);
            assert_true(b->gap_light >= b->gap_normal && b->gap_normal >= 0 && b->gap_facing >= 0);
            for (size_t i = 0; bias_api_get(i) != NULL; i++) {
                const shadow_state got = shadow_state_of(&light, b, bias_api_get(i));
                assert_true(got.units >= 0 && got.factor >= 0 && got.gap_light >= 0 && got.gap_facing >= 0);
            }
        }
    }
}

#define WRONG(what, field, value)                                                                                      \
    {                                                                                                                  \
        shadow_light light = shadow_light_default();                                                                   \
        light.field = (value);                                                                                         \
        assert_int_equal(shadow_light_check(&light), what);                                                            \
    }

TEST(test_refused) {
    static const double nothing[] = {0, -1, NAN, INFINITY};
    for (int i = 0; i < 4; i++) {
        WRONG(SHADOW_BOX, width, nothing[i])
        WRONG(SHADOW_BOX, height, nothing[i])
        WRONG(SHADOW_KERNEL, kernel, nothing[i])
        WRONG(SHADOW_SMALL, small, nothing[i])
        if (i > 0) {
            WRONG(SHADOW_POSITION, world, nothing[i])
            WRONG(SHADOW_POSITION, position, nothing[i])
            WRONG(SHADOW_ROUND, facet, nothing[i])
            WRONG(SHADOW_RECEIVERS, receiver_lo, nothing[i])
            WRONG(SHADOW_TRIANGLES, triangles.slant_hi, nothing[i])
        }
        if (i < 3)
            WRONG(SHADOW_ROUND, radius, nothing[i])
    }
    WRONG(SHADOW_KERNEL, kernel, 0.49)
    WRONG(SHADOW_KERNEL, kernel, 64.1)
    WRONG(SHADOW_KERNEL, subtexel, 25)
    WRONG(SHADOW_KERNEL, subtexel, -1)
    WRONG(SHADOW_SMALL, small, 0.0039)
    WRONG(SHADOW_RECEIVERS, receiver_hi, 100.1)
    WRONG(SHADOW_RECEIVERS, receiver_lo, -0.1)
    WRONG(SHADOW_TRIANGLES, triangles.slant_hi, 89.95)
    WRONG(SHADOW_TRIANGLES, triangles.width, 0)
    WRONG(SHADOW_SETUP, setup.spec.ortho, 0)
    shadow_light light = shadow_light_default();
    dp_spec spec = dp_spec_default();
    assert_int_equal(shadow_light_check(&light), SHADOW_OK);
    assert_int_equal(dp_setup_init(&light.setup, &spec), DP_OK);
    assert_int_equal(shadow_light_check(&light), SHADOW_SETUP);
    shadow_cascade c = {.from = -5};
    const shadow_split fine = shadow_split_default();
    light = shadow_light_default();
    assert_int_equal(shadow_cascade_of(&fine, &light, -1, &c), SHADOW_CASCADES);
    assert_int_equal(shadow_cascade_of(&fine, &light, fine.count, &c), SHADOW_CASCADES);
    light.kernel = 0;
    assert_int_equal(shadow_cascade_of(&fine, &light, 0, &c), SHADOW_KERNEL);
    assert_true(c.from == -5);
    for (int i = 0; i < 14; i++) {
        shadow_split s = fine;
        double *const field[] = {&s.znear, &s.zfar, &s.fov_y, &s.aspect, &s.lambda, &s.casters};
        if (i < 12)
            *field[i % 6] = i < 6 ? -1 : NAN;
        else
            s.count = i == 12 ? 0 : SHADOW_CASCADES_MAX + 1;
        assert_int_equal(shadow_split_check(&s), SHADOW_CASCADES);
    }
    for (int i = 0; i < SHADOW_STATUS_COUNT; i++)
        assert_true(strlen(shadow_status_text((shadow_status)i)) > 3);
    assert_string_equal(shadow_status_text((shadow_status)-1), "not a status");
    assert_null(shadow_way_name(SHADOW_WAY_COUNT));
    assert_null(shadow_cause_name(SHADOW_CAUSE_COUNT));
}
