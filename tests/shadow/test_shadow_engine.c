/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Biases in engines' own numbers. What a number does is written down for each engine again; points of random planes are
 * moved by it and compared with each corner of their filter, in long double: up to the angle that is said to be free
 * none is in shadow, and on the axis some is where acne is said to begin. The least number that is said to be enough
 * is, and a little less is not. Numbers of another engine do the same.
 */
#include "shadow/engine.h"
#include "support.h"

static const long double pi = 3.14159265358979323846L;

static shadow_light random_light(rng *r) {
    static const char *const formats[] = {"fp32", "unorm24", "unorm16"};
    shadow_light light = shadow_light_default();
    dp_spec spec = dp_spec_default();
    dp_format found[2];
    light.kind = (shadow_kind)rng_below(r, 3);
    assert_int_equal(dp_format_parse(formats[rng_below(r, 3)], found), 1);
    spec.format = found[0];
    spec.ortho = light.kind == SHADOW_SUN;
    spec.znear = light.kind == SHADOW_SUN ? 0.0 : rng_log(r, 0.01, 1.0);
    spec.zfar = rng_log(r, 10.0, 100.0);
    spec.mapping = rng_below(r, 2) ? DP_MAPPING_REVERSED : DP_MAPPING_D3D;
    assert_int_equal(dp_setup_init(&light.setup, &spec), DP_OK);
    light.fov = light.kind == SHADOW_POINT ? 90.0 : rng_uniform(r, 20.0, 140.0);
    light.width = light.height = rng_log(r, 1.0, 100.0);
    light.triangles.width = light.triangles.height = (int)rng_log(r, 256, 4096);
    light.triangles.slant_hi = rng_uniform(r, 10.0, 80.0);
    light.kernel = 0.5 * (double)(1 + rng_below(r, 5));
    light.receiver_lo = rng_uniform(r, 2.0, 9.0);
    light.receiver_hi = light.receiver_lo * (rng_below(r, 2) ? 1.0 : rng_uniform(r, 1.0, 1.09)); /* an eighth octave */
    assert_int_equal(shadow_light_check(&light), SHADOW_OK);
    return light;
}

/* The numbers at work, by the engines' own shaders: window depth taken off, a length towards the light, a slope factor,
 * a length along the normal at an angle, and one of which only what is square to the ray counts. */
typedef struct done {
    long double window, ray, factor, normal, aside;
    bool whole; /* the factor is of the change along the slope, as OpenGL has it; else of that on either axis */
} done;

static const char *const told[] = {"three", "unity-urp", "bevy", "babylon", "playcanvas", "filament", "godot"};

static done by_engine(const char *name, const shadow_light *l, double unit, double bias, double normal,
                      long double angle, long double length) {
    const long double z = l->receiver_lo, tangent = tanl((long double)l->fov * pi / 360);
    const bool sun = l->kind == SHADOW_SUN;
    const long double texel = sun ? l->width / l->triangles.width : 2 * tangent * z / l->triangles.width;
    const long double half_far = sun ? texel : tangent * l->setup.spec.zfar / l->triangles.width;
    const long double soft = l->kernel > 1 ? l->kernel : 1;
    if (strcmp(name, "three") == 0)
        return (done){-bias, 0, 0, normal, 0, false};
    if (strcmp(name, "unity-urp") == 0)
        return (done){unit, bias * half_far * soft, 2.5L, normal * half_far * soft * (1 - cosl(angle)), 0, false};
    if (strcmp(name, "bevy") == 0)
        return (done){0, bias, 0, normal * texel * sqrtl(2), 0, false};
    if (strcmp(name, "babylon") == 0)
        return (done){0.5L * bias, 0, 0, normal * sinl(angle), 0, false};
    if (strcmp(name, "playcanvas") == 0)
        return (done){10 * bias * unit, 0, 10 * bias, 0, 0, false};
    const long double share = 10 * normal * z * length / l->triangles.width * (1 - cosl(angle));
    if (strcmp(name, "godot") == 0)
        return sun ? (done){0, bias / 100, 0, 0, normal * texel * (1 - cosl(angle)), false}
               : l->kind == SHADOW_POINT
                   ? (done){0, bias, 0, 0, share, false}
                   : (done){bias / 100 * l->setup.spec.zfar / (z * z * length), 0, 0, share, 0, false};
    assert_string_equal(name, "filament");
    return (done){0.5L * unit, bias, 2, normal * texel * sqrtl(0.5L) * sinl(angle), 0, false};
}

/* 1 over the depth, or less the depth of the sun: what the map is linear in, and falls away from the light. */
static long double nearness(const shadow_light *l, long double z) {
    return l->kind == SHADOW_SUN ? -z : 1 / z;
}

/* Whether each corner of the filter leaves the point lit. The ray is u, v (the sun's rays do not lean), the normal at
 * that angle to it, turned by the azimuth. */
static bool is_lit(const shadow_light *l, const done *d, long double angle, long double azimuth, long double u,
                   long double v) {
    const bool sun = l->kind == SHADOW_SUN;
    const long double z = l->receiver_lo, kappa = l->setup.kappa, length = sqrtl(u * u + v * v + 1);
    const long double pitch =
        sun ? l->width / l->triangles.width : 2 * tanl((long double)l->fov * pi / 360) / l->triangles.width;
    const long double ray[3] = {u / length, v / length, 1 / length}, q = sqrtl(1 - ray[1] * ray[1]);
    const long double a[3] = {ray[2] / q, 0, -ray[0] / q}, b[3] = {-ray[0] * ray[1] / q, q, -ray[1] * ray[2] / q};
    long double n[3], at[3] = {u * z, v * z, z}, plane = 0;
    for (int i = 0; i < 3; i++) {
        n[i] = cosl(angle) * ray[i] + sinl(angle) * (cosl(azimuth) * a[i] + sinl(azimuth) * b[i]);
        plane += n[i] * at[i];
    }
    for (int i = 0; i < 3; i++)
        at[i] -= d->normal * n[i] + d->aside * (n[i] - cosl(angle) * ray[i]) + d->ray * ray[i];
    if (!(at[2] > 0))
        return true;
    const long double x = sun ? at[0] : at[0] / at[2], y = sun ? at[1] : at[1] / at[2];
    const long double gx = sun ? n[0] / n[2] : n[0] / plane, gy = sun ? n[1] / n[2] : n[1] / plane;
    const long double slope = (d->whole ? hypotl(gx, gy) : fmaxl(fabsl(gx), fabsl(gy))) * pitch;
    const long double off = l->kernel * pitch;
    for (int k = 0; k < 4; k++) {
        const long double tx = x + ((k & 1) != 0 ? off : -off), ty = y + ((k & 2) != 0 ? off : -off);
        const long double there = sun ? (plane - n[0] * tx - n[1] * ty) / n[2] : plane / (n[0] * tx + n[1] * ty + n[2]);
        if (!sun && !(there > 0))
            continue;
        const long double ahead = nearness(l, at[2]) - nearness(l, there);
        if (ahead + d->factor * slope + d->window * kappa < 0)
            return false;
    }
    return true;
}

/* Numbers about those that are needed. */
static void numbers_of(rng *r, const shadow_light *light, const shadow_engine *engine, double *bias, double *normal) {
    shadow_need need;
    shadow_need_of(light, &need);
    const double window = need.bias[SHADOW_CONSTANT].window, texel = need.texel;
    const double ray =
        window * light->setup.kappa * (light->kind == SHADOW_SUN ? 1.0 : light->receiver_lo * light->receiver_lo);
    const double clip = 100.0 * window * light->receiver_lo * light->receiver_lo / light->setup.spec.zfar; /* Godot's */
    const double one = engine->bias_in[light->kind] == SHADOW_IN_WINDOW  ? window
                       : engine->bias_in[light->kind] == SHADOW_IN_CLIP  ? clip
                       : engine->bias_in[light->kind] == SHADOW_IN_SCENE ? ray
                       : engine->bias_in[light->kind] == SHADOW_IN_UNITS ? 1.0
                                                                         : ray / texel;
    *bias =
        (engine->bias_scale[light->kind] < 0.0 ? -1.0 : 1.0) * one * (rng_below(r, 4) ? rng_log(r, 0.01, 3.0) : 0.0);
    *normal =
        engine->normal_in[light->kind] == SHADOW_IN_SCENE ? texel * rng_uniform(r, 0.0, 4.0) : rng_uniform(r, 0.0, 3.0);
    *normal = rng_below(r, 3) && engine->normal_in[light->kind] != SHADOW_IN_NOTHING ? *normal : 0.0;
}

TEST(verdicts) {
    rng r = rng_make("engines");
    tally t[2] = {{.name = "free up to there"}, {.name = "acne there"}};
    uint64_t seen[2] = {0};
    const bias_api *api = bias_api_find("vulkan-unorm"); /* a unit is worth the same at any depth */
    for (uint64_t n = test_cases(600, 6000, 100000); n > 0; n--) {
        shadow_light light = random_light(&r);
        light.receiver_hi *= rng_below(&r, 3) ? 1.0 : rng_uniform(&r, 1.0, 3.0);
        if (shadow_light_check(&light) != SHADOW_OK)
            continue;
        const dp_format *format = &light.setup.spec.format;
        const shadow_engine *engine = shadow_engine_get(n % shadow_engine_table.count);
        if (engine->instead[0] != '\0')
            continue;
        double bias, normal;
        numbers_of(&r, &light, engine, &bias, &normal);
        const double unit = bias_unit_at(api, &light.setup.spec.format, 1.0).least;
        const shadow_given given = shadow_engine_gives(engine, &light, api, bias, normal);
        const shadow_verdict v = shadow_judge(&light, &given);
        const double h = light.kind == SHADOW_SUN ? 0.0 : tan(light.fov * (double)pi / 360.0);
        seen[0] += v.free > 0.0;
        for (int i = 0; i < 20 && v.free > 0.0; i++) {
            const long double angle = (i % 2 ? v.free : rng_uniform(&r, 0.0, v.free)) * pi / 180;
            const long double azimuth = i % 3 ? pi / 4 * (long double)rng_below(&r, 8) : rng_uniform(&r, -3.0, 3.0);
            const double u = rng_uniform(&r, -h, h), v2 = i % 4 ? u : rng_uniform(&r, -h, h);
            const long double length = light.kind == SHADOW_SUN ? 1 : sqrtl(u * u + v2 * v2 + 1);
            shadow_light there = light;
            there.receiver_lo = i % 5 ? rng_uniform(&r, light.receiver_lo, light.receiver_hi) : light.receiver_hi;
            done d = by_engine(engine->name, &there, unit, bias, normal, angle, length);
            d.window -= format->kind == DP_FORMAT_UNORM ? 0.5L / format->code_max : 0; /* what is stored is nearer */
            TALLY(&t[0], is_lit(&there, &d, angle, azimuth, u, v2), "%s %g, %g: kind %d, %g degrees of %g",
                  engine->name, bias, normal, light.kind, (double)(angle * 180 / pi), v.free);
        }
        if (isnan(v.acne))
            continue;
        done d = by_engine(engine->name, &light, unit, bias, normal, v.acne * pi / 180, 1);
        d.whole = rng_below(&r, 2) == 0;
        TALLY(&t[1], !is_lit(&light, &d, v.acne * pi / 180, pi / 4, 0, 0), "%s %g, %g: kind %d, %g degrees",
              engine->name, bias, normal, light.kind, v.acne);
        TALLY(&t[1], v.acne > v.free, "%s: free up to %g, acne from %g", engine->name, v.free, v.acne);
        seen[1]++;
    }
    print_message("# %llu free up to an angle, %llu with acne\n", (unsigned long long)seen[0],
                  (unsigned long long)seen[1]);
    assert_true(seen[0] > 100 && seen[1] > 100);
    for (int i = 0; i < 2; i++)
        tally_end(&t[i]);
}

/* How far a point moves along its normal is what the engine's own code moves it; of what it moves aside of the ray, the
 * part along the normal. */
TEST(offset_along_the_normal) {
    rng r = rng_make("offsets");
    tally t = {.name = "offsets"};
    size_t moved[3] = {0}, aside = 0;
    const bias_api *api = bias_api_find("vulkan-unorm");
    for (uint64_t n = test_cases(300, 3000, 30000); n > 0; n--) {
        const shadow_light light = random_light(&r);
        const shadow_engine *engine = shadow_engine_find(told[n % 7]);
        double bias, normal;
        numbers_of(&r, &light, engine, &bias, &normal);
        const shadow_given given = shadow_engine_gives(engine, &light, api, bias, normal);
        const double angle = rng_uniform(&r, 1.0, light.triangles.slant_hi); /* 1 - cos of less has few digits */
        const long double radians = angle * pi / 180, sine = sinl(radians);
        const done d = by_engine(engine->name, &light, 0, bias, normal, radians, 1);
        const double want = (double)(d.normal + d.aside * sine * sine), got = shadow_given_offset(&given, angle);
        TALLY(&t, fabs(got - want) <= 1e-9 * want, "%s: kind %d at %g: %g, not %g", engine->name, light.kind, angle,
              got, want);
        moved[light.kind] += want > 0;
        aside += d.aside > 0;
    }
    assert_true(moved[0] > 5 && moved[1] > 5 && moved[2] > 5 && aside > 5);
    tally_end(&t);
}

TEST(least) {
    rng r = rng_make("least of engines");
    tally t[2] = {{.name = "enough"}, {.name = "no less is"}};
    const bias_api *api = bias_api_find("vulkan-unorm");
    for (uint64_t n = test_cases(60, 600, 5000); n > 0; n--) {
        const shadow_light light = random_light(&r);
        const shadow_engine *engine = shadow_engine_get(n % shadow_engine_table.count);
        if (engine->instead[0] != '\0')
            continue;
        const double most = light.triangles.slant_hi;
        double bias, normal;
        numbers_of(&r, &light, engine, &bias, &normal);
        const double b = shadow_least_bias(engine, &light, api, normal);
        const double l = shadow_least_normal(engine, &light, api, bias);
        if (!isnan(b))
            TALLY(&t[0], shadow_judge_all(engine, &light, api, b, normal).free == most, "%s: bias %g", engine->name, b);
        if (!isnan(b) && b != 0.0)
            TALLY(&t[1], shadow_judge_all(engine, &light, api, 0.999 * b, normal).free < most, "%s: bias %g",
                  engine->name, b);
        if (!isnan(l))
            TALLY(&t[0], shadow_judge_all(engine, &light, api, bias, l).free == most, "%s: normal %g", engine->name, l);
        if (!isnan(l) && l != 0.0)
            TALLY(&t[1], shadow_judge_all(engine, &light, api, bias, 0.999 * l).free < most, "%s: normal %g",
                  engine->name, l);
    }
    for (int i = 0; i < 2; i++)
        tally_end(&t[i]);
}

/* A number that is a window depth is enough where the constant bias of that light is: the least of either is the same.
 */
TEST(beside_the_constant) {
    rng r = rng_make("beside the constant");
    tally t = {.name = "the same"};
    const bias_api *api = bias_api_find("vulkan-unorm");
    for (uint64_t n = test_cases(60, 300, 3000); n > 0;) {
        shadow_light light = random_light(&r);
        light.receiver_hi = light.receiver_lo * rng_uniform(&r, 1.0, 5.0);
        if (light.kind == SHADOW_POINT || shadow_light_check(&light) != SHADOW_OK)
            continue; /* of a cube the constant covers seams */
        n--;
        shadow_need need;
        shadow_need_of(&light, &need);
        const double least = -shadow_least_bias(shadow_engine_find("three"), &light, api, 0.0);
        const double share = least / need.bias[SHADOW_CONSTANT].window;
        TALLY(&t, share > 0.999 && share < 1.01, "kind %d, %g degrees, up to %g: %g", light.kind, light.fov,
              light.triangles.slant_hi, share);
    }
    tally_end(&t);
}

/* A point that is moved towards the light by a length has that for a gap: along the axis just that, along rays that
 * lean no more than their length over their depth, and rounding. */
TEST(gap_of_a_length) {
    rng r = rng_make("gap of a length");
    tally t = {.name = "gap"};
    const bias_api *api = bias_api_find("vulkan-unorm");
    for (uint64_t n = test_cases(100, 500, 5000); n > 0; n--) {
        const shadow_light light = random_light(&r);
        const double length = light.receiver_lo * rng_log(&r, 1e-3, 3.0);
        const double tangent = light.kind == SHADOW_SUN ? 0.0 : tan(light.fov * (double)pi / 360.0);
        const shadow_given given = shadow_engine_gives(shadow_engine_find("bevy"), &light, api, length, 0.0);
        const double gap = shadow_judge(&light, &given).gap;
        TALLY(&t, gap >= length * (1.0 - 1e-12) && gap <= length * sqrt(1.0 + 2.0 * tangent * tangent) * (1.0 + 1e-9),
              "kind %d, %g degrees: %g of %g at %g", light.kind, light.fov, gap, length, light.receiver_hi);
    }
    tally_end(&t);
}

/* Defaults of a new light in each engine, written a second time, so that a slip in either shows: of suns, spot and
 * point lights.
 */
TEST(defaults) {
    static const struct {
        const char *engine;
        double bias[3], normal[3];
    } rows[] = {{"three", {0, 0, 0}, {0, 0, 0}},
                {"unity-urp", {1, 1, 1}, {1, 1, 0}},
                {"bevy", {0.02, 0.02, 0.08}, {1.8, 1.8, 0.6}},
                {"babylon", {0.00005, 0.00005, 0.00005}, {0, 0, 0}},
                {"playcanvas", {0.05, 0.05, 0.05}, {0, 0, 0}},
                {"filament", {0.001, 0.001, 0.001}, {1, 1, 1}},
                {"unreal", {0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}},
                {"godot", {0.1, 0.03, 0.1}, {2, 1, 1}}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const shadow_engine *engine = shadow_engine_find(rows[i].engine);
        assert_non_null(engine);
        for (int kind = 0; kind < 3; kind++) {
            assert_true(engine->standard[kind][0] == rows[i].bias[kind]);
            assert_true(engine->standard[kind][1] == rows[i].normal[kind]);
        }
    }
    assert_int_equal(shadow_engine_table.count, sizeof rows / sizeof rows[0]);
}

/* The numbers for another engine do the same at the nearest receivers. */
TEST(same_elsewhere) {
    rng r = rng_make("engines to engines");
    tally t = {.name = "the same"};
    const bias_api *api = bias_api_find("vulkan-unorm");
    for (uint64_t n = test_cases(300, 3000, 30000); n > 0; n--) {
        const shadow_light light = random_light(&r);
        const shadow_engine *from = shadow_engine_find(told[rng_below(&r, 7)]),
                            *to = shadow_engine_find(told[rng_below(&r, 7)]);
        const double most = light.triangles.slant_hi;
        double bias, normal;
        numbers_of(&r, &light, from, &bias, &normal);
        const shadow_given given = shadow_engine_gives(from, &light, api, bias, normal);
        const double offset = shadow_given_offset(&given, most);
        const double b = shadow_bias_as(to, &light, api, given.window_most);
        const double l = shadow_normal_as(to, &light, offset);
        const shadow_given there = shadow_engine_gives(to, &light, api, b, isnan(l) ? 0.0 : l);
        if (isfinite(given.window_most))
            TALLY(&t, fabs(there.window_most - given.window_most) <= 1e-9 * given.window_most + 1e-15,
                  "%s to %s: %g, %g", from->name, to->name, there.window_most, given.window_most);
        TALLY(&t, isnan(l) || fabs(shadow_given_offset(&there, most) - offset) <= 1e-9 * offset, "%s to %s: %g",
              from->name, to->name, l);
    }
    tally_end(&t);
}
