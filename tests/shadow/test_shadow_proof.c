/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * What src/shadow draws to prove a bias. With the bias said to be enough, in each of the three ways, no point of a
 * plane has acne and none is lit behind the caster beyond the gap: random suns, spot lights and faces of point lights,
 * maps, filters, formats and rasterizers. Without a bias acne is where a formula of the plane, in long double, has a
 * texel of the filter nearer than the point by more than all that is rounded, and nowhere else; with a quarter of the
 * bias a steep plane has some. What the command tells of them.
 */
#include <png.h>

#include "printed.h"
#include "raster_named.h"
#include "shadow/drawn.h"
#include "support.h"

static const long double pi = 3.14159265358979323846L;

static const struct {
    const char *name, *arith;
} kinds[] = {{"llvmpipe", "mesa"}, {"lavapipe", "mesa"}, {"softpipe", "softpipe"}, {"swiftshader", "mesa"}};
static const char *const formats[] = {"fp32", "unorm24", "unorm16"};

enum { KINDS = 4, FORMATS = 3 };

static bool draws(int kind, int format) {
    return !(format == 1 && kind == 3) && !(format == 2 && kind == 2);
}

/* A light in the class of the rasterizer; false where none fits. */
static bool random_light(rng *r, int kind, int format, shadow_light *out) {
    static const double kernels[] = {0.5, 0.5, 1.0, 1.5, 2.0, 2.5};
    dp_spec spec = dp_spec_default();
    dp_format found[2];
    shadow_light l = shadow_light_default();
    const int size = (int)rng_log(r, 64.0, 4096.0);
    assert_int_equal(dp_format_parse(formats[format], found), 1);
    assert_int_equal(dp_arith_parse(kinds[kind].arith, &spec.arith), DP_OK);
    l.kind = (shadow_kind)rng_below(r, 3);
    spec.format = found[0];
    spec.mapping = rng_below(r, 2) ? DP_MAPPING_REVERSED : DP_MAPPING_D3D;
    spec.ortho = l.kind == SHADOW_SUN;
    l.width = l.height = rng_log(r, 0.1, 1000.0);
    l.fov = l.kind == SHADOW_POINT ? 90.0 : rng_uniform(r, 10.0, 140.0);
    spec.znear = spec.ortho ? 0.0 : rng_log(r, 0.01, 1.0);
    spec.zfar = spec.ortho ? l.width * rng_log(r, 0.3, 30.0) : spec.znear * rng_log(r, 5.0, 500.0);
    if (dp_setup_init(&l.setup, &spec) != DP_OK)
        return false;
    l.kernel = kernels[rng_below(r, 6)];
    l.triangles.width = l.triangles.height = size;
    raster_describe(raster_find(kinds[kind].name), &l.triangles);
    l.triangles.slant_lo = 0.0;
    l.triangles.slant_hi = rng_uniform(r, 20.0, 85.0);
    l.triangles.pixels = rng_log(r, 8.0, 512.0);
    l.small = 1.0;
    l.receiver_lo = spec.ortho ? 0.1 * spec.zfar : spec.znear * 1.5;
    l.receiver_hi = spec.ortho ? 0.9 * spec.zfar : spec.zfar * 0.8;
    *out = l;
    return shadow_light_check(&l) == SHADOW_OK;
}

/* The binary32 number that is as far from 0, or the next farther. */
static double outward(double x) {
    const float near = (float)x;
    return fabs((double)near) < fabs(x) ? (double)nextafterf(near, x < 0 ? -1e30F : 1e30F) : (double)near;
}

/* The bias of one way, a share of it, as window depth. */
static shadow_worn worn_of(const shadow_light *l, const shadow_bias *b, double share) {
    const double sign = share * shadow_sign(l);
    return (shadow_worn){
        .state = {bias_api_find("vulkan-float"), outward(sign * b->window), outward(sign * b->factor), 0.0},
        .offset = share * b->offset};
}

static shadow_drawn seen_with(shadow_drawing *d, const shadow_scene *scene, shadow_worn worn) {
    shadow_drawn out = {{0}};
    shadow_scene_draw(d, scene, &worn);
    shadow_scene_count(d, scene, &out);
    return out;
}

/* ---- By formula -------------------------------------------------------------------------------------------------- */

/* Window depth of the plane where the light sees it at u, v, away from the light; by the plane alone. */
static long double depth_at(const shadow_light *l, const shadow_scene *s, long double u, long double v) {
    const double *n = s->plane.normal;
    const long double kappa = l->setup.kappa, size = l->triangles.width;
    const long double x = 2 * u / size - 1, y = 2 * v / size - 1;
    if (l->kind == SHADOW_SUN)
        return ((long double)s->plane.distance - n[0] * x * l->width / 2 - n[1] * y * l->height / 2) / n[2] / kappa;
    const long double h = tanl((long double)l->fov * pi / 360);
    return -((n[0] * x + n[1] * y) * h + n[2]) / ((long double)s->plane.distance * kappa);
}

/* By how much the nearest texel that the filter reads is nearer than the point: of those that it reads for certain, and
 * with those at its rim. */
static void nearest_texel(const shadow_light *l, const shadow_scene *s, double u, double v, long double by[2]) {
    const long double here = depth_at(l, s, u, v);
    by[0] = by[1] = -1e30L;
    for (int y = (int)v - 4; y <= (int)v + 4; y++)
        for (int x = (int)u - 4; x <= (int)u + 4; x++) {
            const double off = fmax(fabs(x + 0.5 - u), fabs(y + 0.5 - v));
            if (off > l->kernel + 0.01)
                continue;
            const long double nearer = here - depth_at(l, s, x + 0.5L, y + 0.5L);
            by[1] = fmaxl(by[1], nearer);
            if (off <= l->kernel - 0.01)
                by[0] = fmaxl(by[0], nearer);
        }
}

/* Points without a bias, but those where roundings may decide. */
static void check_bare(shadow_drawing *d, const shadow_scene *s, tally *t, uint64_t seen[2]) {
    const shadow_light *l = d->light;
    const dp_format *format = &l->setup.spec.format;
    const long double code = format->kind == DP_FORMAT_UNORM ? 1.0L / (long double)format->code_max : 0x1p-24L;
    d->beyond = d->within = 0.0;
    seen_with(d, s, (shadow_worn){.state = {bias_api_find("vulkan-float"), 0.0, 0.0, 0.0}});
    for (int k = 0; k < s->area.height * 3; k++)
        for (int i = 0; i < s->area.width * 3; i++) {
            const double u = s->area.x + (i + 0.5) / 3, v = s->area.y + (k + 0.5) / 3;
            const shadow_seen found = shadow_point_at(d, s, u, v).seen;
            const long double here = depth_at(l, s, u, v);
            const long double slope =
                fabsl(depth_at(l, s, u + 1.0L, v) - here) + fabsl(depth_at(l, s, u, v + 1.0L) - here);
            const long double rounded = 0.03L * slope + 2 * code + 2e-6L;
            long double by[2];
            if (found == SHADOW_SEEN_NONE)
                continue;
            nearest_texel(l, s, u, v, by);
            if (by[0] > rounded)
                TALLY(t, found == SHADOW_SEEN_ACNE, "no acne at %g, %g: %Lg nearer", u, v, by[0]);
            else if (by[1] < -rounded)
                TALLY(t, found == SHADOW_SEEN_LIT, "acne at %g, %g: %Lg", u, v, by[1]);
            seen[0] += by[0] > rounded;
            seen[1] += by[1] < -rounded;
        }
}

/* A plane that faces the sun at a depth which binary32 holds is as far as its own map everywhere, and that is lit. */
TEST(as_far_is_lit) {
    rng r = rng_make("as far");
    uint64_t lit = 0;
    for (int k = 0; k < 12; k++) {
        shadow_light l = shadow_light_default();
        dp_spec spec = dp_spec_default();
        shadow_drawing d;
        shadow_scene scene;
        uint64_t seed = rng_next(&r);
        spec.mapping = k % 2 ? DP_MAPPING_REVERSED : DP_MAPPING_D3D;
        spec.ortho = true;
        spec.znear = 0.0;
        spec.zfar = l.width = l.height = 64.0;
        assert_int_equal(dp_arith_parse("mesa", &spec.arith), DP_OK);
        assert_int_equal(dp_setup_init(&l.setup, &spec), DP_OK);
        l.triangles.width = l.triangles.height = 256;
        raster_describe(raster_find("llvmpipe"), &l.triangles);
        l.triangles.slant_lo = 0.0;
        l.triangles.slant_hi = 60.0;
        l.triangles.pixels = 64.0;
        l.small = 1.0;
        l.receiver_lo = 8.0;
        l.receiver_hi = 56.0;
        assert_int_equal(shadow_drawing_open(&d, raster_find("llvmpipe"), &l), RASTER_OK);
        assert_true(shadow_scene_random(&d, &seed, &scene));
        scene.plane = (draw_plane){.normal = {0.0, 0.0, 1.0}, .distance = 16.0 * (k / 4) - 16.0};
        d.beyond = d.within = 0.0;
        const shadow_drawn bare =
            seen_with(&d, &scene, (shadow_worn){.state = {bias_api_find("vulkan-float"), 0.0, 0.0, 0.0}});
        assert_true(bare.of[SHADOW_SEEN_ACNE] == 0);
        lit += bare.of[SHADOW_SEEN_LIT];
        shadow_drawing_close(&d);
    }
    assert_true(lit > 10000);
}

/* ---- Lights at random -------------------------------------------------------------------------------------------- */

/* Whether a quarter of the constant bias is less than the points that are asked about need. */
static bool is_steep(const shadow_light *l, const shadow_scene *s, const shadow_need *need) {
    const double *n = s->plane.normal;
    return l->kind == SHADOW_SUN && s->slant >= 0.95 * l->triangles.slant_hi && fabs(fabs(n[0]) - fabs(n[1])) < 1e-6 &&
           need->bias[SHADOW_CONSTANT].share >= 0.9;
}

static void check_enough(shadow_drawing *d, const shadow_scene *s, const shadow_need *need, const char *name,
                         tally t[2], uint64_t counted[2]) {
    const shadow_light *l = d->light;
    for (int way = 0; way < SHADOW_WAY_COUNT; way++) {
        const shadow_bias *b = &need->bias[way];
        if (!isfinite(b->factor) || !isfinite(b->offset))
            continue;
        shadow_scene_stand(d, s, need);
        const shadow_drawn with = seen_with(d, s, worn_of(l, b, 1.0));
        TALLY(&t[0], with.of[SHADOW_SEEN_ACNE] == 0, "%s %s %s, light %d: %llu of %llu at %g of %g degrees, kernel %g",
              name, l->setup.spec.format.name, shadow_way_name((shadow_way)way), l->kind,
              (unsigned long long)with.of[SHADOW_SEEN_ACNE], (unsigned long long)with.of[SHADOW_SEEN_LIT], s->slant,
              l->triangles.slant_hi, l->kernel);
        TALLY(&t[1], with.of[SHADOW_SEEN_LEAK] == 0, "%s %s %s, light %d: %llu of %llu at %g degrees, kernel %g", name,
              l->setup.spec.format.name, shadow_way_name((shadow_way)way), l->kind,
              (unsigned long long)with.of[SHADOW_SEEN_LEAK], (unsigned long long)with.of[SHADOW_SEEN_DARK], s->slant,
              l->kernel);
        if (way == SHADOW_CONSTANT) /* half of what it covers is not covered by a caster */
            TALLY(&t[1], with.of[SHADOW_SEEN_SHORT] == 0 || s->slant > 5.0, "a caster within the gap casts a shadow");
        counted[0] += with.of[SHADOW_SEEN_LIT];
        counted[1] += with.of[SHADOW_SEEN_DARK];
    }
}

TEST(random_lights) {
    rng r = rng_make("shadows drawn");
    tally enough[2] = {{.name = "no acne"}, {.name = "dark behind the caster"}};
    tally bare = {.name = "acne by formula"}, less = {.name = "acne with a quarter"};
    uint64_t points[2] = {0}, by_formula[2] = {0}, kind_of[3] = {0};
    for (uint64_t n = test_cases(40, 400, 20000); n > 0; n--) {
        const int kind = (int)rng_below(&r, KINDS), format = (int)rng_below(&r, FORMATS);
        shadow_light l;
        shadow_drawing d;
        shadow_need need;
        if (!draws(kind, format) || !random_light(&r, kind, format, &l))
            continue;
        assert_int_equal(shadow_drawing_open(&d, raster_find(kinds[kind].name), &l), RASTER_OK);
        d.api = bias_api_find("vulkan-float");
        shadow_need_of(&l, &need);
        kind_of[l.kind]++;
        for (int k = 0; k < 4; k++) {
            shadow_scene scene;
            uint64_t seed = rng_next(&r);
            if (!shadow_scene_random(&d, &seed, &scene))
                continue;
            check_enough(&d, &scene, &need, kinds[kind].name, enough, points);
            check_bare(&d, &scene, &bare, by_formula);
            d.beyond = d.within = 0.0;
            const shadow_drawn with = seen_with(&d, &scene, worn_of(&l, &need.bias[SHADOW_CONSTANT], 0.25));
            if (is_steep(&l, &scene, &need) && with.of[SHADOW_SEEN_LIT] + with.of[SHADOW_SEEN_ACNE] > 100)
                TALLY(&less, with.of[SHADOW_SEEN_ACNE] > 0, "kernel %g, slant %g", l.kernel, scene.slant);
        }
        shadow_drawing_close(&d);
    }
    print_message("# %llu points lit, %llu dark; by formula %llu with acne, %llu without\n",
                  (unsigned long long)points[0], (unsigned long long)points[1], (unsigned long long)by_formula[0],
                  (unsigned long long)by_formula[1]);
    assert_true(points[0] > 10000 && points[1] > 1000 && by_formula[0] > 1000 && by_formula[1] > 100);
    assert_true(kind_of[0] > 0 && kind_of[1] > 0 && kind_of[2] > 0);
    tally_end(&enough[0]);
    tally_end(&enough[1]);
    tally_end(&bare);
    tally_end(&less);
}

/* ---- Casters anywhere ---------------------------------------------------------------------------------------------
 */

/* Where window depth of a reversed map falls short of a power of two by a part of it. */
static double behind_octave(rng *r, const dp_spec *spec) {
    const double d = ldexp(1.0 - rng_log(r, 1e-4, 0.05), -1 - (int)rng_below(r, 6));
    return spec->ortho ? spec->zfar * (1.0 - d) : 1.0 / (d / spec->znear + (1.0 - d) / spec->zfar);
}

/* A float map whose receivers lie within half an octave: of many a unit is worth more just before the nearest. */
static bool narrow_light(rng *r, int kind, shadow_light *l) {
    if (!random_light(r, kind, 0, l))
        return false;
    const double lo = l->receiver_lo, hi = l->receiver_hi;
    l->receiver_lo = l->kind == SHADOW_SUN ? rng_uniform(r, lo, hi) : rng_log(r, lo, hi);
    if (l->setup.reversed && rng_below(r, 4) > 0)
        l->receiver_lo = behind_octave(r, &l->setup.spec);
    l->receiver_hi = fmin(l->receiver_lo * rng_log(r, 1.0005, 1.5), hi);
    return shadow_light_check(l) == SHADOW_OK;
}

/* Whether triangles of a map that is not reversed may reach from receivers into the next binade: it is not promised. */
static bool reaches_behind(const shadow_light *l) {
    const double z = l->receiver_hi, slope = tan(l->triangles.slant_hi * M_PI / 180.0);
    const double texel = l->width / l->triangles.width;
    const double farthest =
        l->kind == SHADOW_SUN ? z + l->triangles.pixels * sqrt(2.0) * texel * slope : z * l->triangles.depth;
    const double to = 1.00001 * farthest;
    return !l->setup.reversed &&
           (!(to < l->setup.spec.zfar) || ilogb(dp_window(&l->setup, to)) != ilogb(dp_window(&l->setup, z)));
}

/* The casters of a plane stand farther off than the gap that is told and the constant bias, by any factor. */
static bool stand_beyond(rng *r, shadow_drawing *d, const shadow_scene *s, double told, double covered) {
    const shadow_light *l = d->light;
    const double hi = l->receiver_hi, depth = l->setup.kappa * (l->kind == SHADOW_SUN ? 1.0 : hi * hi);
    const double least = (told + covered * depth) * (l->kind == SHADOW_SUN ? 1.0 : s->z / l->receiver_lo) * 1.000001;
    const double most = 0.95 * (s->z - l->setup.spec.znear);
    if (!(least < most))
        return false;
    d->within = 0.0;
    d->beyond = rng_below(r, 2) ? least : rng_log(r, least, most);
    return true;
}

static void check_told_gap(rng *r, shadow_drawing *d, const shadow_need *need, const bias_api *api, tally t[2],
                           uint64_t counted[2]) {
    const shadow_light *l = d->light;
    const bias_api next = bias_next(api);
    const bool open = bias_is_open(api, &l->setup.spec.format) && rng_below(r, 2);
    const int way = rng_below(r, 2) ? SHADOW_CONSTANT : (int)rng_below(r, SHADOW_WAY_COUNT);
    const shadow_bias *b = &need->bias[way];
    const shadow_state told = shadow_state_of(l, b, api);
    shadow_scene s;
    uint64_t seed = rng_next(r);
    if (!isfinite(told.units) || !isfinite(b->factor) || !isfinite(b->offset) || !shadow_scene_random(d, &seed, &s) ||
        !stand_beyond(r, d, &s, told.gap_light, need->bias[SHADOW_CONSTANT].window))
        return;
    const double sign = shadow_sign(l);
    const shadow_worn worn = {.state = {open ? &next : api, sign * told.units, outward(sign * told.factor), 0.0},
                              .offset = b->offset};
    const shadow_drawn with = seen_with(d, &s, worn);
    TALLY(&t[0], with.of[SHADOW_SEEN_ACNE] == 0, "%s %s, light %d: %llu at %g of %g degrees", api->name,
          shadow_way_name((shadow_way)way), l->kind, (unsigned long long)with.of[SHADOW_SEEN_ACNE], s.slant,
          l->triangles.slant_hi);
    TALLY(
        &t[1], with.of[SHADOW_SEEN_LEAK] == 0, "%s %s %s%s, light %d: %llu of %llu at %g, %g to %g of %g to %g, gap %g",
        dp_mapping_get(l->setup.spec.mapping)->name, api->name, shadow_way_name((shadow_way)way), open ? ", open" : "",
        l->kind, (unsigned long long)with.of[SHADOW_SEEN_LEAK], (unsigned long long)with.of[SHADOW_SEEN_DARK], s.z,
        l->receiver_lo, l->receiver_hi, l->setup.spec.znear, l->setup.spec.zfar, told.gap_light);
    counted[l->setup.reversed != 0] += with.of[SHADOW_SEEN_DARK];
}

TEST(casters_anywhere) {
    static const char *const apis[] = {"d3d12", "gl", "vulkan", "metal"};
    rng r = rng_make("casters anywhere");
    tally t[2] = {{.name = "no acne by units"}, {.name = "dark beyond the gap that is told"}};
    uint64_t dark[2] = {0};
    for (uint64_t n = test_cases(150, 600, 60000); n > 0; n--) {
        const int kind = (int)rng_below(&r, KINDS);
        const bias_api *api = bias_api_find(apis[rng_below(&r, 4)]);
        shadow_light l;
        shadow_drawing d;
        shadow_need need;
        if (!narrow_light(&r, kind, &l) || reaches_behind(&l))
            continue;
        assert_int_equal(shadow_drawing_open(&d, raster_find(kinds[kind].name), &l), RASTER_OK);
        d.api = api;
        shadow_need_of(&l, &need);
        for (int k = 0; k < 6; k++)
            check_told_gap(&r, &d, &need, api, t, dark);
        shadow_drawing_close(&d);
    }
    print_message("# %llu points dark, %llu of reversed maps\n", (unsigned long long)(dark[0] + dark[1]),
                  (unsigned long long)dark[1]);
    assert_true(dark[0] > 1000 && dark[1] > 1000);
    tally_end(&t[0]);
    tally_end(&t[1]);
}

/* ---- The command ------------------------------------------------------------------------------------------------- */

/* The plane as each bias has it, side by side: acne, a grey as warm as what is lit and at most 3/4 of it, in the first
 * alone. */
static void check_picture(const char *path, size_t count, bool acne_before) {
    enum { BETWEEN = 8 };
    png_image head = {.version = PNG_IMAGE_VERSION};
    assert_true(png_image_begin_read_from_file(&head, path));
    head.format = PNG_FORMAT_RGB;
    const size_t width = head.width, each = (width + BETWEEN) / count;
    unsigned char *rgb = malloc(PNG_IMAGE_SIZE(head));
    assert_true(rgb != NULL && png_image_finish_read(&head, NULL, rgb, 0, NULL) && each * count == width + BETWEEN);
    size_t acne[2] = {0}, seen[2] = {0};
    for (size_t i = 0; i < width * head.height; i++) {
        const unsigned char *p = &rgb[3 * i];
        const bool later = i % width >= each;
        acne[later] += p[0] < 170 && p[0] >= p[1] && p[1] >= p[2];
        seen[later] += p[0] != p[1] || p[1] != p[2];
    }
    free(rgb);
    if ((acne[0] > 0) != acne_before || acne[1] > 0 || seen[0] == 0 || seen[1] == 0)
        fail_msg("%s: %zu and %zu pixels of acne, of %zu and %zu", path, acne[0], acne[1], seen[0], seen[1]);
}

/* What is told of each bias, and the picture of it. */
static void check_told(const char *line, bool acne_before) {
    const char *path = scratch_file("proof.png");
    json_t *root = json_printed(0, "shadow %s --rasterize --render %s", line, path);
    const json_t *rows = node_at(root, "setups[0].drawn");
    const size_t count = json_array_size(rows);
    assert_true(count >= 3);
    assert_true((number_at(rows, "[0].acne") > 0) == acne_before);
    for (size_t i = 0; i < count; i++) {
        assert_true(number_at(rows, "[%zu].points", i) > 5000 && number_at(rows, "[%zu].within", i) > 500);
        assert_true(number_at(rows, "[%zu].behind_lit", i) <= number_at(rows, "[%zu].behind", i));
        /* The same planes, points and casters, whatever is lit of them; an offset moves some across an edge. */
        static const char *const counted[] = {"points", "behind", "within"};
        for (int k = 0; k < 3; k++) {
            const double first = number_at(rows, "[0].%s", counted[k]),
                         now = number_at(rows, "[%zu].%s", i, counted[k]);
            assert_true(fabs(now - first) <= 0.05 * first);
        }
        if (i > 0 && (number_at(rows, "[%zu].acne", i) != 0 || number_at(rows, "[%zu].behind_lit", i) != 0))
            fail_msg("%s: %s has acne, or loses a shadow", line, text_at(rows, "[%zu].bias", i));
    }
    assert_true(number_at(rows, "[1].within_lit") > 0);
    json_decref(root);
    check_picture(path, count, acne_before);
}

TEST(told) {
    check_told("--light-box 20x20x50 --range 20:40 -m reversed -F fp32 --api d3d12 --angle 30", true);
    check_told("--spot 50 -n 1 -f 30 --range 2:20 -m reversed -F fp32 --api gl --angle 50", true);
    check_told("--light-box 20x20x50 --size 1024 -F d24", true);
    check_told("--light-box 20x20x50 --size 1024 -F d24 --kernel 15 --angle 30", true); /* a tenth less has acne */
    check_told("--spot 60 -n 0.5 -f 40 -F d24 --size 1024 --engine three --bias=-0.0005", true);
    check_told("--spot 60 -n 0.5 -f 40 -F d24 --size 1024 --engine three --bias=-0.02", false);
    check_told("--point -n 0.1 -f 25 -F d16 --size 512 --raster swiftshader", true);
    check_told("-f 100 --cascades 2 -m reversed --raster softpipe --size 512 --kernel 1", true);
    static const struct {
        const char *line, *said;
    } rows[] = {{"--distance --spot 40", "which a fragment shader writes"},
                {"--raster spec-gl", "one that draws"},
                {"--raster spec-d3d", "one that draws"},
                {"-F fp16", "that llvmpipe has"},
                {"--api gl,vulkan", "must be one"},
                {"--curvature 2", "it draws planes"},
                {"--arith mesa", "the rasterizer has its own"},
                {"--kernel 40", "at most 32x32"},
                {"--render x.svg", "must end in .png"},
                {"-F d16,d24 --render x.png", "one format"},
                {"-F d16 -m d3d,reversed --render x.png", "one format"}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        check_says(2, rows[i].said, "shadow --rasterize %s", rows[i].line);
    check_says(2, "--rasterize", "shadow --render x.png");
}
