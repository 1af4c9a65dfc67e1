/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Verdicts on random biases at any slant, against the rasterizers of src/raster, which recorded codes guard: what is
 * said to be enough fights in no pixel, with r of the APIs' specifications as it is written here; and a pixel that
 * bias_draw() says fights does so when its two triangles alone are drawn here, pixel by pixel.
 */
#include "bias/drawn.h"
#include "bias/verdict.h"
#include "image/image.h"
#include "printed.h"
#include "raster_named.h"
#include "slanted.h"

enum { ROWS = 4096 };

static const struct {
    const char *name, *arith, *format;
} rasters[] = {{"llvmpipe", "mesa", "fp32"},
               {"softpipe", "softpipe", "fp32"},
               {"swiftshader", "mesa", "fp32"},
               {"swiftshader", "mesa", "unorm16"},
               {"llvmpipe", "mesa", "unorm24"}};
enum { RASTERS = sizeof rasters / sizeof rasters[0] };

/* Those whose r is a number; that of vulkan and gl is what an implementation finds to be enough. */
static const char *const apis[] = {"d3d11", "metal", "vulkan-exact", "d3d9"};

/* Depth, biased by its API's rule in binary32, and held from 0 to 1. */
static float biased(const bias_state *s, const dp_format *format, double most, double m, float depth) {
    const bool is_float = format->kind == DP_FORMAT_FLOAT;
    int e = -125;
    if (most > 0.0)
        (void)frexp((double)(float)most, &e);
    const int exponent = e - 1 < -126 ? -126 : e - 1;
    const double r = strcmp(s->api->name, "d3d9") == 0         ? 1.0
                     : is_float                                ? ldexp(1.0, exponent - 23)
                     : strncmp(s->api->name, "vulkan", 6) == 0 ? ldexp(1.0, -format->bits)
                                                               : (double)(float)(1.0 / (double)format->code_max);
    const float constant = (float)((double)(float)s->units * r);
    const float sloped = (float)((double)(float)s->factor * (double)(float)m);
    return fminf(fmaxf(depth + (constant + sloped), 0.0F), 1.0F);
}

/* As llvmpipe stores it. */
static uint32_t stored(const dp_format *format, float depth) {
    uint32_t code;
    if (format->kind == DP_FORMAT_UNORM)
        return (uint32_t)lrint((double)(depth * (float)format->code_max));
    memcpy(&code, &depth, sizeof code);
    return code;
}

/* ---- Enough is enough -------------------------------------------------------------------------------------------- */

typedef struct outcome {
    tally pixels;
    uint64_t answers[3], fights; /* fights: of biases that are not said to be enough */
} outcome;

static double greatest(const raster_vertex v[3]) {
    return fmax(fmax((double)(v[0].z / v[0].w), (double)(v[1].z / v[1].w)), (double)(v[2].z / v[2].w));
}

/* About what is needed: a share of it, of either number. */
static bias_state draw_state(rng *r, const dp_setup *setup, const bias_api *api, double lo, double hi) {
    const double sign = bias_sign(setup), least = bias_factor_least(setup);
    const bias_goal goal = {.api = api, .factor = least};
    double worst, units = bias_needed_over(setup, &goal, lo, hi, &worst);
    units = isfinite(units) ? units * (rng_below(r, 2) == 0 ? 1.0 : rng_log(r, 0.05, 4.0)) : rng_log(r, 1.0, 1e4);
    const double factor = isfinite(least) ? least * (rng_below(r, 2) == 0 ? 1.0 : rng_log(r, 0.05, 50.0)) : 1.0;
    return (bias_state){api, sign * (api->whole ? ceil(units) : (double)(float)units), sign * (double)(float)factor, 0};
}

static void check_pixels(const slanted *s, const raster_target *target, const bias_state *state, const bias_verdict *v,
                         outcome *out) {
    static float depth[2][ROWS];
    raster_triangle drawn[2];
    raster_vertex clip[2][3];
    const dp_format *format = &s->setup.spec.format;
    for (int k = 0; k < 2; k++)
        if (!slanted_clip(s, k, s->c, clip[k]) || !slanted_inside((const raster_vertex *)clip[k]) ||
            raster_set_up(target, clip[k], &drawn[k]) != RASTER_OK)
            return;
    const raster_piece *a = &drawn[0].piece[0], *b = &drawn[1].piece[0];
    const double m = fmax(fabs((double)a->plane.a), fabs((double)a->plane.b));
    for (int y = a->y0 > b->y0 ? a->y0 : b->y0; y < (a->y1 < b->y1 ? a->y1 : b->y1); y++) {
        int from[2], to[2];
        if (!raster_span(target, a, y, &from[0], &to[0]) || !raster_span(target, b, y, &from[1], &to[1]))
            continue;
        const int x0 = from[0] > from[1] ? from[0] : from[1], x1 = to[0] < to[1] ? to[0] : to[1];
        for (int k = 0; k < 2 && x0 < x1; k++)
            raster_depths(target, &drawn[k].piece[0], y, x0, x1, depth[k]);
        for (int x = x0; x < x1; x += 1 + (x1 - x0) / 8) {
            const double z = s->c / slanted_along(s, x + 0.5, y + 0.5);
            const float back = depth[1][x - x0], front = biased(state, format, greatest(clip[0]), m, depth[0][x - x0]);
            if (!(z >= v->lo && z <= v->hi) || back < 0.0F || back > 1.0F)
                continue;
            uint32_t below, moved;
            raster_convert(target, &back, 1, &below);
            raster_convert(target, &front, 1, &moved);
            const bool apart = s->setup.reversed ? moved > below : moved < below;
            out->fights += !apart && v->answer != BIAS_ENOUGH;
            TALLY(&out->pixels, apart || v->answer != BIAS_ENOUGH,
                  "%s %s %s reversed %d: units %.17g factor %.17g, z %.17g in %g to %g: %08x over %08x", s->kind->name,
                  format->name, state->api->name, s->setup.reversed, state->units, state->factor, z, v->lo, v->hi,
                  moved, below);
        }
    }
}

static bool judge_one(rng *r, slanted *s, const char *raster, outcome *out) {
    const double c[2] = {s->c, s->c};
    dp_setup setup;
    if (!slanted_fit(s, c) || slanted_height((const double(*)[2])s->at[0]) < 1.25 ||
        slanted_height((const double(*)[2])s->at[1]) < 1.25)
        return false;
    dp_spec spec = s->setup.spec;
    spec.model = DP_MODEL_EXACT;
    spec.triangles = s->class;
    if (dp_setup_init(&setup, &spec) != DP_OK)
        return false;
    const raster_target target = target_of(raster, spec.format.name, s->camera.width, s->camera.height, dp_path_best());
    const double z = s->c / slanted_along(s, s->px, s->py);
    const double lo = fmax(z / rng_log(r, 1.001, 3.0), spec.znear), hi = fmin(z * rng_log(r, 1.001, 3.0), spec.zfar);
    const bias_api *api = bias_api_find(apis[rng_below(r, 4)]);
    if (!(lo < hi))
        return false;
    const bias_state state = draw_state(r, &setup, api, lo, hi);
    const bias_verdict v = bias_judge(&setup, &state, &(bias_goal){.api = api}, lo, hi);
    out->answers[v.answer]++;
    check_pixels(s, &target, &state, &v, out);
    return true;
}

TEST(enough_fights_nowhere) {
    rng r = rng_make("bias any slant");
    outcome out = {.pixels = {.name = "enough at any slant"}};
    const uint64_t count = test_cases(1000, 10000, 400000);
    for (uint64_t i = 0; i < count;) {
        const size_t which = (size_t)rng_below(&r, RASTERS);
        size_t row = 0;
        while (strcmp(raster_get(row)->name, rasters[which].name) != 0)
            row++;
        const int bits = raster_get(row)->plane_bits > 0 ? raster_get(row)->plane_bits : -1;
        const slanted_kind kind = {rasters[which].name, raster_get(row)->anchor, {bits, bits}, rasters[which].arith};
        slanted s;
        if (slanted_draw_camera(&r, &s, &kind, rasters[which].format) && slanted_draw_planes(&r, &s))
            i += judge_one(&r, &s, rasters[which].name, &out);
    }
    print_message("# %llu enough, %llu not, %llu not proven; %llu pixels, with the others %llu fight\n",
                  (unsigned long long)out.answers[BIAS_ENOUGH], (unsigned long long)out.answers[BIAS_NOT_ENOUGH],
                  (unsigned long long)out.answers[BIAS_NOT_PROVEN], (unsigned long long)out.pixels.cases,
                  (unsigned long long)out.fights);
    for (int i = 0; i < 3; i++)
        assert_true(out.answers[i] > count / 50);
    assert_true(out.fights > 0);
    tally_end(&out.pixels);
}

/* ---- A pixel that fights ----------------------------------------------------------------------------------------- */

/* The depth that a mesh has in a pixel, with the slope and the greatest depth of its triangle; false: none covers it.
 */
static bool drawn_at(const bias_drawing *d, const bias_pair *pair, int which, int x, int y, float *depth, double *m,
                     double *most) {
    const draw_mesh *mesh = &pair->mesh[which];
    bool found = false;
    for (int i = 0; i < 2 * mesh->cells[0] * mesh->cells[1]; i++) {
        double window[3][2], ray[3], facing;
        raster_vertex v[3];
        raster_triangle drawn;
        int from, to;
        draw_mesh_corners(mesh, i / 2 / mesh->cells[1], i / 2 % mesh->cells[1], i % 2, window);
        bool seen = slanted_height((const double(*)[2])window) >= BIAS_DRAWN_LOWEST;
        for (int k = 0; k < 3 && seen; k++) {
            draw_ray(d->camera, window[k], ray);
            facing = pair->plane.normal[0] * ray[0] + pair->plane.normal[1] * ray[1] + pair->plane.normal[2];
            const double z = pair->plane.distance / facing, place[3] = {ray[0] * z, ray[1] * z, z};
            seen = facing > 0.0;
            v[k] = draw_clip(d->camera, place);
        }
        if (!seen || raster_set_up(&d->camera->target, v, &drawn) != RASTER_OK || y < drawn.piece[0].y0 ||
            y >= drawn.piece[0].y1 || !raster_span(&d->camera->target, &drawn.piece[0], y, &from, &to) || x < from ||
            x >= to)
            continue;
        assert_false(found);
        found = true;
        raster_depths(&d->camera->target, &drawn.piece[0], y, x, x + 1, depth);
        *m = fmax(fabs((double)drawn.piece[0].plane.a), fabs((double)drawn.piece[0].plane.b));
        *most = greatest(v);
    }
    return found;
}

static void check_witness(const bias_drawing *d, const bias_drawn *drawn, tally *t) {
    const dp_format *format = &d->setup->spec.format;
    float below = 0, layer = 0;
    double m = 0, most = 0, other_m, other;
    const bool both = drawn_at(d, &drawn->pair, 0, drawn->x, drawn->y, &below, &other_m, &other) &&
                      drawn_at(d, &drawn->pair, 1, drawn->x, drawn->y, &layer, &m, &most);
    const uint32_t code = stored(format, below), moved = stored(format, biased(d->state, format, most, m, layer));
    TALLY(t,
          both && code == drawn->pixel.code && moved == drawn->pixel.moved &&
              (d->setup->reversed ? moved <= code : moved >= code),
          "%s %s pixel %d, %d: %08x and %08x, here %08x and %08x", format->name, d->state->api->name, drawn->x,
          drawn->y, drawn->pixel.moved, drawn->pixel.code, moved, code);
}

static void random_camera(rng *r, dp_setup *setup, draw_camera *camera) {
    static const char *const formats[] = {"fp32", "unorm24", "unorm16"};
    dp_spec spec = dp_spec_default();
    dp_format found[2];
    dp_format_parse(formats[rng_below(r, 3)], found);
    spec.format = found[0];
    spec.mapping = rng_below(r, 2) == 0 ? DP_MAPPING_REVERSED : DP_MAPPING_D3D;
    spec.znear = rng_log(r, 0.01, 1.0);
    spec.zfar = spec.znear * rng_log(r, 100.0, 1e5);
    spec.model = DP_MODEL_FLOAT;
    spec.triangles = dp_triangles_default();
    assert_int_equal(dp_arith_parse("mesa", &spec.arith), DP_OK);
    raster_describe(raster_find("llvmpipe"), &spec.triangles);
    assert_int_equal(dp_setup_init(setup, &spec), DP_OK);
    assert_int_equal(draw_camera_init(camera, raster_find("llvmpipe"), setup), RASTER_OK);
}

TEST(a_pixel_that_fights_does) {
    rng r = rng_make("bias drawn pixel");
    tally t = {.name = "pixels that fight"};
    for (uint64_t i = 0; i < test_cases(60, 400, 10000); i++) {
        dp_setup setup;
        draw_camera camera;
        random_camera(&r, &setup, &camera);
        const dp_spec spec = setup.spec;
        const double sign = bias_sign(&setup);
        static const char *const tried[] = {"d3d11", "metal", "vulkan"}; /* of the last the least r that may be */
        const bias_state given = {bias_api_find(tried[rng_below(&r, 3)]), sign * (double)rng_below(&r, 4),
                                  sign * (rng_below(&r, 2) == 0 ? 0.0 : rng_log(&r, 1e-3, 0.1)), 0.0};
        bias_drawing d = {
            .camera = &camera, .setup = &setup, .state = &given, .lo = 2.0 * spec.znear, .hi = spec.zfar / 2.0};
        assert_true(bias_drawing_open(&d));
        const bias_drawn drawn = bias_draw(&d, 20, i);
        assert_true(drawn.pixels > 0);
        if (drawn.fights > 0)
            check_witness(&d, &drawn, &t);
        bias_drawing_close(&d);
    }
    assert_true(t.cases > 20);
    tally_end(&t);
}

/* Where a plane has its depth at a place of the window. */
static double eye_at(const bias_drawing *d, const draw_plane *plane, double x, double y) {
    double ray[3];
    draw_ray(d->camera, (const double[2]){x, y}, ray);
    return plane->distance / (plane->normal[0] * ray[0] + plane->normal[1] * ray[1] + plane->normal[2] * ray[2]);
}

/* The greater rate at which its depth changes there, across or up, scene units a pixel: 1/z is straight. */
static double rate_at(const bias_drawing *d, const draw_plane *plane, double x, double y) {
    const double z = eye_at(d, plane, x, y);
    const double across = 1.0 / eye_at(d, plane, x + 8, y) - 1.0 / eye_at(d, plane, x - 8, y);
    const double up = 1.0 / eye_at(d, plane, x, y + 8) - 1.0 / eye_at(d, plane, x, y - 8);
    return fmax(fabs(across), fabs(up)) / 16.0 * z * z;
}

/* Each plane that is drawn at a slope has a pixel of just that, and none that is steeper counts. */
TEST(planes_of_a_slope) {
    rng r = rng_make("planes of a slope");
    tally t[] = {{.name = "a pixel of just that slope"}, {.name = "none that counts is steeper"}};
    uint64_t steeper = 0, counted = 0;
    for (uint64_t i = 0; i < test_cases(100, 600, 10000); i++) {
        dp_setup setup;
        draw_camera camera;
        random_camera(&r, &setup, &camera);
        const double n = setup.spec.znear, f = setup.spec.zfar, lo = rng_log(&r, 2.0 * n, 0.25 * f);
        const bias_state none = {bias_api_find(apis[0]), 0.0, 0.0, 0.0};
        bias_drawing d = {.camera = &camera,
                          .setup = &setup,
                          .state = &none,
                          .lo = lo,
                          .hi = 1.5 * lo,
                          .slope = lo * rng_log(&r, 1e-4, 0.1)};
        assert_true(bias_drawing_open(&d));
        const bias_drawn drawn = bias_draw(&d, 1, i);
        const bias_pair *pair = &drawn.pair;
        double nearest = HUGE_VAL;
        for (int y = pair->area.y; y < pair->area.y + pair->area.height; y++)
            for (int x = pair->area.x; x < pair->area.x + pair->area.width; x++) {
                const double rate = rate_at(&d, &pair->plane, x + 0.5, y + 0.5) / d.slope;
                const bool counts = bias_pixel_at(&d, pair, x, y).covered;
                nearest = fmin(nearest, fabs(rate - 1.0));
                TALLY(&t[1], !counts || rate <= 1.0 + 1e-6, "slope %g: %g of it", d.slope, rate);
                steeper += rate > 1.001;
                counted += counts;
            }
        TALLY(&t[0], drawn.pixels == 0 || nearest < 1e-6, "slope %g: off by %g of it", d.slope, nearest);
        bias_drawing_close(&d);
    }
    assert_true(steeper > 1000 && counted > 1000);
    for (size_t i = 0; i < 2; i++)
        tally_end(&t[i]);
}

/* ---- The command ------------------------------------------------------------------------------------------------- */

/* The frame of the pixel that is named: 16 black pixels, within 3 x 3 yellow ones. It is the first from the lower left,
 * by rows: none is below it, none in its row to the left. */
static void check_picture(const char *path) {
    image picture;
    image_error error;
    uint64_t black = 0, yellow = 0;
    size_t frame = 0, lowest = 0;
    assert_true(image_read(path, &picture, &error));
    assert_true(picture.width % 5 == 0 && picture.height % 5 == 0 && picture.width >= 10);
    const uint8_t *at = picture.data;
    for (size_t i = 0; i < (size_t)picture.width * picture.height; i++, at += picture.channels) {
        const bool is_black = at[0] == 0 && at[1] == 0 && at[2] == 0;
        const bool is_yellow = at[0] == 0xF0 && at[1] == 0xE4 && at[2] == 0x42;
        const size_t place = i / picture.width * picture.width + (picture.width - 1 - i % picture.width);
        frame = is_black && place > frame ? place : frame;
        lowest = (is_black || is_yellow) && place > lowest ? place : lowest;
        black += is_black;
        yellow += is_yellow;
    }
    assert_true(frame == lowest);
    assert_int_equal(black, 16);
    assert_int_equal((yellow + black) % 25, 0);
    image_free(&picture);
}

TEST(rasterized) {
    static const char line[] = "bias --api d3d11 -F fp32 -m reversed --range 1:100 --rasterize";
    const char *file = scratch_file("fights.png");
    json_t *root = json_printed(0, "%s --units 2 --render %s", line, file);
    assert_string_equal(text_at(root, "setups[0].sloped.answer"), "not enough");
    assert_true(number_at(root, "triangles.width") == 1920 && number_at(root, "triangles.height") == 1080);
    assert_true(number_at(root, "setups[0].drawn.fights") > 100);
    assert_true(number_at(root, "setups[0].drawn.pixels") > number_at(root, "setups[0].drawn.fights"));
    assert_true(number_at(root, "setups[0].drawn.code_moved") <= number_at(root, "setups[0].drawn.code"));
    json_decref(root);
    check_picture(file);
    check_says(1, "Enough facing the camera, not enough at any slant", "%s --units 2 --check", line);
    check_says(0, "not proven at any slant",
               "bias --api d3d11 -F fp32 -m reversed --range 1:100 --viewport 1920x1080 "
               "--raster llvmpipe --units 2");
    check_says(0, "none of", "%s --units 29 --factor 0.015380859375 --check", line);
    static const refused_row rows[] = {{"", "--units", 2},
                                       {"--units 2 --ortho", "--ortho", 2},
                                       {"--units 2 --raster spec-gl", "--raster", 2},
                                       {"--units 2 --render a.jpg", ".png", 2}};
    CHECK_REFUSED(line, rows);
    check_says(2, "--render", "bias -F fp32,d24 -m d3d --units -1 --rasterize --render a.png");
}

/* Planes of one slope: with the least that is told to be enough there none fights; with none of it many do. */
TEST(rasterized_at_a_slope) {
    static const char *const lines[] = {"-F fp32 -m reversed --api d3d11", "-F fp32 -m d3d --api metal",
                                        "-F d24 -m d3d --api vulkan-exact", "-F d16 -m reversed --api d3d11"};
    static const double slopes[] = {0.001, 0.01, 0.1};
    tally enough = {.name = "enough at a slope"}, less = {.name = "fights at a slope"};
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++)
        for (size_t k = 0; k < sizeof slopes / sizeof slopes[0]; k++) {
            char line[160];
            snprintf(line, sizeof line, "bias %s --range 1:60 --rasterize --slope %g", lines[i], slopes[k]);
            const double sign = strstr(line, "reversed") != NULL ? 1.0 : -1.0;
            json_t *bare = json_printed(0, "%s --units=%g", line, sign);
            const double units = number_at(bare, "setups[0].sloped.units");
            TALLY(&less, number_at(bare, "setups[0].drawn.fights") > 0, "%s", line);
            TALLY(&less, strcmp(text_at(bare, "setups[0].sloped.answer"), "not enough") == 0, "%s", line);
            json_t *told = json_printed(0, "%s --units=%.17g", line, units);
            TALLY(&enough, strcmp(text_at(told, "setups[0].sloped.answer"), "enough") == 0, "%s: %g", line, units);
            TALLY(&enough, number_at(told, "setups[0].drawn.fights") == 0, "%s: %g", line, units);
            TALLY(&enough, number_at(told, "setups[0].drawn.pixels") > 1000, "%s", line);
            json_decref(bare);
            json_decref(told);
        }
    tally_end(&enough);
    tally_end(&less);
}
