/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Frames: strips on several threads give the bits of one pixel after the other, errors of scenes stay within what an
 * image's error map predicts, and the statistics are those of a plain count.
 */
#include <stdlib.h>
#include <string.h>

#include "named.h"
#include "oracle.h"
#include "support.h"
#include "texture/frame.h"
#include "texture/normal_measure.h"
#include "texture/survey.h"

/* Three strips, the last one shorter. */
enum { WIDTH = 2100, HEIGHT = 260, PIXELS = WIDTH * HEIGHT };

typedef struct stage {
    texture_camera camera;
    double parameters[TEXTURE_PARAMETERS];
    frame frame;
} stage;

static void stage_between(stage *s, const char *scene, const char *format, const char *mapping, double znear,
                          double zfar, bool ortho, uint32_t width, uint32_t height) {
    dp_format formats[2];
    dp_spec spec = dp_spec_default();
    dp_setup setup;
    camera_spec view = camera_spec_default();
    assert_true(dp_format_parse(format, formats) >= 1);
    assert_int_equal(dp_mapping_parse(mapping, &spec.mapping), DP_OK);
    spec.format = formats[0];
    spec.ortho = ortho;
    spec.znear = znear;
    spec.zfar = zfar;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    view.width = width;
    view.height = height;
    view.yaw = 30;
    view.pitch = -10;
    view.origin[0] = 100;
    view.origin[2] = -7;
    assert_null(camera_init(&s->camera, &setup, &view));
    parameter_defaults(scene_find(scene)->parameters, s->parameters);
    s->frame = (frame){
        .camera = &s->camera, .scene = scene_find(scene), .parameters = s->parameters, .sky = FRAME_SKY, .threads = 1};
}

static void stage_set(stage *s, const char *scene, const char *format, const char *mapping, double zfar, bool ortho,
                      uint32_t width, uint32_t height) {
    stage_between(s, scene, format, mapping, 0.1, zfar, ortho, width, height);
}

/* A product as a whole image, rows from the top, and the order in which the strips came. */
typedef struct whole {
    float *values;
    size_t row_values;
    uint32_t strips, rows, first;
} whole;

static bool collect(void *context, uint32_t row, uint32_t count, const float *values) {
    whole *w = context;
    memcpy(w->values + row * w->row_values, values, count * w->row_values * sizeof *values);
    if (w->strips++ == 0)
        w->first = row;
    w->rows += count;
    return true;
}

static float *make(const frame *f, const frame_product *p, bool bottom_up) {
    whole w = {.row_values = (size_t)f->camera->width * (size_t)frame_channels(p)};
    w.values = calloc(w.row_values * f->camera->height, sizeof *w.values);
    assert_non_null(w.values);
    assert_null(frame_refuses(f, p));
    assert_true(frame_run(f, p, bottom_up, collect, &w));
    assert_int_equal(w.rows, f->camera->height);
    assert_true((w.first == 0) == (!bottom_up || w.strips == 1));
    return w.values;
}

/* One of each. */
enum { PRODUCTS = 14 };
static double settings[TEXTURE_PARAMETERS];

static size_t products(frame_product out[PRODUCTS]) {
    const effect_row *effect = effect_find("intersection");
    parameter_defaults(effect->parameters, settings);
    const frame_product all[] = {
        {.kind = FRAME_EYE},
        {.kind = FRAME_EYE, .radial = true},
        {.kind = FRAME_EYE, .error = true},
        {.kind = FRAME_LINEAR01},
        {.kind = FRAME_LINEAR01, .error = true},
        {.kind = FRAME_RAW},
        {.kind = FRAME_RAW, .error = true},
        {.kind = FRAME_POSITION},
        {.kind = FRAME_POSITION, .position = position_find("matrix")},
        {.kind = FRAME_POSITION, .position = position_find("view"), .error = true},
        {.kind = FRAME_NORMAL, .normal = normal_find("high")},
        {.kind = FRAME_NORMAL, .normal = normal_find("projective"), .error = true},
        {.kind = FRAME_EFFECT, .effect = effect, .effect_settings = settings, .reference = 10},
        {.kind = FRAME_EFFECT, .effect = effect, .effect_settings = settings, .error = true},
    };
    memcpy(out, all, sizeof all);
    return sizeof all / sizeof all[0];
}

static void bits_do_not_depend_on_threads_or_direction(void **state) {
    (void)state;
    frame_product all[PRODUCTS];
    stage s;
    stage_set(&s, "sphere", "unorm24", "d3d", 1000, false, WIDTH, HEIGHT);
    const size_t count = products(all);
    for (size_t i = 0; i < count; i++) {
        const size_t size = (size_t)PIXELS * (size_t)frame_channels(&all[i]) * sizeof(float);
        frame_summary one, many;
        s.frame.threads = 1;
        float *want = make(&s.frame, &all[i], false);
        assert_true(frame_summarise(&s.frame, &all[i], &one));
        assert_true(one.count > PIXELS / 50);
        for (int threads = 2; threads <= 5; threads += 3) {
            s.frame.threads = threads;
            float *got = make(&s.frame, &all[i], threads == 5);
            assert_memory_equal(got, want, size);
            assert_true(frame_summarise(&s.frame, &all[i], &many));
            assert_memory_equal(&many, &one, sizeof one);
            free(got);
        }
        free(want);
    }
}

typedef struct wholes {
    whole each[PRODUCTS];
    size_t count;
} wholes;

static bool collect_all(void *context, uint32_t row, uint32_t count, const float *const *values) {
    wholes *w = context;
    for (size_t i = 0; i < w->count; i++)
        collect(&w->each[i], row, count, values[i]);
    return true;
}

static void products_of_one_pass_are_those_of_many(void **state) {
    (void)state;
    frame_product all[PRODUCTS];
    wholes w = {.count = products(all)};
    stage s;
    stage_set(&s, "sphere", "unorm24", "d3d", 1000, false, WIDTH, HEIGHT);
    for (size_t i = 0; i < w.count; i++) {
        w.each[i].row_values = (size_t)WIDTH * (size_t)frame_channels(&all[i]);
        w.each[i].values = calloc(w.each[i].row_values * HEIGHT, sizeof(float));
        assert_non_null(w.each[i].values);
    }
    for (int threads = 1; threads <= 3; threads++) {
        s.frame.threads = threads;
        for (size_t i = 0; i < w.count; i++)
            memset(w.each[i].values, 0, w.each[i].row_values * HEIGHT * sizeof(float));
        assert_true(frame_run_all(&s.frame, all, w.count, threads == 2, collect_all, &w));
        for (size_t i = 0; i < w.count; i++) {
            float *want = make(&s.frame, &all[i], false);
            assert_memory_equal(w.each[i].values, want, w.each[i].row_values * HEIGHT * sizeof(float));
            free(want);
        }
    }
    for (size_t i = 0; i < w.count; i++)
        free(w.each[i].values);
}

/* What a pixel of the frame is, one by one, from the scalar functions alone. */
static bool is_sky(const dp_setup *setup, uint32_t code) {
    const double d = dp_format_value(&setup->spec.format, code);
    return (setup->reversed ? d : 1 - d) <= FRAME_SKY;
}

static bool same_bits(float a, float b) {
    return memcmp(&a, &b, sizeof a) == 0 || (isnan(a) && isnan(b));
}

/* Long: every product of a pixel, and how each is made by hand. */
static void frames_equal_plain_pixels(void **state) {
    static const struct {
        const char *scene, *format, *mapping;
        double znear, zfar;
        bool ortho;
    } cases[] = {{"plane", "unorm24", "d3d", 0.1, 1000, false},  {"sphere", "fp32", "reversed", 0.1, INFINITY, false},
                 {"steps", "unorm16", "d3d", 0.1, 1000, true},   {"decals", "fp16", "reversed", 0.1, 1000, false},
                 {"plane", "fp32", "linear", 0.1, 1000, false},  {"sphere", "fp32", "log", 0.1, 1000, false},
                 {"plane", "fp32", "d3d", -100, 1000, true},     {"plane", "unorm16", "gl-reversed", -20, 20, true},
                 {"steps", "unorm16", "reversed", 0, 1000, true}};
    (void)state;
    tally t = {.name = "plain"};
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
        stage s;
        stage_between(&s, cases[k].scene, cases[k].format, cases[k].mapping, cases[k].znear, cases[k].zfar,
                      cases[k].ortho, 97, 61);
        if (k == 0)
            s.parameters[1] = 62;
        if (cases[k].znear < 0) { /* through depth 0, in the middle of the image */
            s.parameters[0] = 1e-9;
            s.parameters[1] = 62;
        }
        const texture_camera *c = &s.camera;
        s.frame.threads = 3;
        const frame_product eyes = {.kind = FRAME_EYE}, far = {.kind = FRAME_EYE, .radial = true},
                            off = {.kind = FRAME_EYE, .error = true}, exact = {.kind = FRAME_POSITION},
                            view = {.kind = FRAME_POSITION, .position = position_find("view")};
        const bool placed = frame_refuses(&s.frame, &view) == NULL;
        position_state state_of;
        if (placed)
            position_prepare(&state_of, c);
        float *eye = make(&s.frame, &eyes, false), *radial = make(&s.frame, &far, true),
              *error = make(&s.frame, &off, false), *place = make(&s.frame, &exact, false),
              *method = placed ? make(&s.frame, &view, false) : NULL;
        for (uint32_t y = 0; y < 61; y++)
            for (uint32_t x = 0; x < 97; x++) {
                const size_t i = (size_t)y * 97 + x;
                scene_hit h;
                s.frame.scene->hit(c, s.parameters, x, y, &h);
                const uint32_t code = dp_code(&c->setup, h.z);
                if (is_sky(&c->setup, code)) {
                    TALLY(&t,
                          isnan(eye[i]) && isnan(radial[i]) && isnan(error[i]) && isnan(place[3 * i]) &&
                              (!placed || isnan(method[3 * i])),
                          "%zu: %u, %u is sky", k, x, y);
                    continue;
                }
                const double z = dp_stored(&c->setup, code);
                double world[3], v[3];
                camera_view(c, x, y, z, v);
                camera_turn(c, v, world);
                for (int axis = 0; axis < 3; axis++)
                    world[axis] += c->origin[axis];
                TALLY(&t, fabs((double)eye[i] - z) <= DP_BATCH_EYE_ERROR * fabs(z), "%zu: eye %g, not %g", k,
                      (double)eye[i], z);
                TALLY(&t, same_bits(radial[i], (float)((double)eye[i] * camera_radial(c, x, y))), "%zu: radial", k);
                const double wrong = fabs(dp_error(&c->setup, code, h.z));
                TALLY(&t, (double)error[i] >= wrong && (double)error[i] <= wrong * (1 + 0x1p-22) + 0x1p-148,
                      "%zu: error", k);
                for (int a = 0; a < 3; a++)
                    TALLY(&t, fabs((double)place[3 * i + (size_t)a] - world[a]) <= 1.01 * 0x1p-24 * fabs(world[a]),
                          "%zu: place %g, not %g", k, (double)place[3 * i + (size_t)a], world[a]);
                const float d = (float)dp_format_value(&c->setup.spec.format, code);
                float p[3];
                if (!placed)
                    continue;
                view.position->run(&state_of, y, x, &d, 1, &p[0], &p[1], &p[2]);
                TALLY(&t,
                      same_bits(p[0], method[3 * i]) && same_bits(p[1], method[3 * i + 1]) &&
                          same_bits(p[2], method[3 * i + 2]),
                      "%zu: method at %u, %u: %g, not %g", k, x, y, (double)method[3 * i], (double)p[0]);
            }
        free(eye);
        free(radial);
        free(error);
        free(place);
        free(method);
    }
    tally_end(&t);
}

/* ---- Normals: the same as over the whole image at once, with the borders where they are ---- */

typedef struct source {
    const float *eye;
    float *normal;
    uint32_t width;
} source;

static void give(void *context, uint32_t row, float *eye) {
    const source *s = context;
    memcpy(eye, s->eye + (size_t)row * s->width, s->width * sizeof *eye);
}

static void keep(void *context, const normal_rows *in, const float *const normal[3]) {
    source *s = context;
    for (uint32_t x = 0; x < s->width; x++)
        for (size_t k = 0; k < 3; k++)
            s->normal[3 * ((size_t)in->row * s->width + x) + k] = normal[k][x];
}

static void normals_do_not_know_of_strips(void **state) {
    (void)state;
    stage s;
    stage_set(&s, "sphere", "unorm16", "d3d", 1000, false, WIDTH, HEIGHT);
    s.frame.threads = 2;
    const frame_product eyes = {.kind = FRAME_EYE};
    float *eye = make(&s.frame, &eyes, false);
    for (size_t m = 0; normal_get(m) != NULL; m++) {
        const frame_product p = {.kind = FRAME_NORMAL, .normal = normal_get(m)};
        float *got = make(&s.frame, &p, false), *want = calloc(3 * PIXELS, sizeof *want);
        source all = {eye, want, WIDTH};
        assert_true(normal_run(normal_get(m), &s.camera, 0, HEIGHT, give, keep, &all));
        size_t numbers = 0;
        for (size_t i = 0; i < 3 * PIXELS; i++) {
            assert_true(same_bits(got[i], want[i]));
            numbers += isnan(got[i]) ? 0 : 1;
        }
        assert_true(numbers > 3 * PIXELS / 50);
        free(got);
        free(want);
    }
    free(eye);
}

/* ---- What an image cannot know a scene does: its true errors stay within the image's ---- */

static image image_of(const stage *s) {
    const texture_camera *c = &s->camera;
    image out = {.width = c->width, .height = c->height, .channels = 1, .type = IMAGE_U32, .file = IMAGE_NPY};
    out.data = malloc((size_t)c->width * c->height * sizeof(uint32_t));
    assert_non_null(out.data);
    for (uint32_t y = 0; y < c->height; y++)
        frame_codes(&s->frame, y, (uint32_t *)out.data + (size_t)y * c->width);
    return out;
}

static void true_errors_are_within_the_predicted(void **state) {
    static const char *const formats[][2] = {
        {"unorm24", "d3d"}, {"unorm24", "reversed"}, {"unorm16", "d3d"}, {"fp16", "reversed"}, {"fp32", "reversed"}};
    (void)state;
    tally t = {.name = "predicted"};
    double nearest[3] = {0, 0, 0};
    for (size_t k = 0; k < sizeof formats / sizeof formats[0]; k++)
        for (int turn = 0; turn < 4; turn++) {
            stage s;
            stage_set(&s, "plane", formats[k][0], formats[k][1], 1000, turn == 3, 320, 180);
            s.parameters[1] = 20 * turn + 7;
            s.parameters[2] = 13 * turn - 20;
            image depths = image_of(&s);
            frame seen = s.frame;
            seen.image = &depths;
            seen.scene = NULL;
            const frame_product wanted[] = {
                {.kind = FRAME_EYE, .error = true},
                {.kind = FRAME_POSITION, .position = position_find(turn == 3 ? "view" : "rays"), .error = true},
                {.kind = FRAME_NORMAL, .normal = normal_find("projective"), .error = true}};
            for (size_t i = 0; i < 3; i++) {
                float *truth = make(&s.frame, &wanted[i], false), *bound = make(&seen, &wanted[i], false);
                for (size_t x = 0; x < (size_t)320 * 180; x++) {
                    if (isnan(truth[x]) || isnan(bound[x]))
                        continue;
                    const double slack = 1;
                    TALLY(&t, (double)truth[x] <= (double)bound[x] * slack,
                          "%zu, turn %d, product %zu at %zu: %g above %g", k, turn, i, x, (double)truth[x],
                          (double)bound[x]);
                    nearest[i] = fmax(nearest[i], (double)(truth[x] / bound[x]));
                }
                free(truth);
                free(bound);
            }
            free(depths.data);
        }
    print_message("# largest share of the predicted error: eye depth %.3f, positions %.3f, normals %.3f\n", nearest[0],
                  nearest[1], nearest[2]);
    for (size_t i = 0; i < 3; i++)
        assert_true(nearest[i] > 0.3);
    assert_true(nearest[0] > 0.99);
    tally_end(&t);
}

/* What the errors of an image are made of: what binary32 lost, and how far the sample's range reaches along the ray. */
static void errors_of_images_equal_plain_pixels(void **state) {
    enum { ACROSS = 97, DOWN = 61, EYE = 0, RADIAL, PLACE, THINGS };
    (void)state;
    tally t = {.name = "plain errors"};
    for (int k = 0; k < 4; k++) {
        stage s;
        stage_set(&s, "plane", "unorm16", k < 2 ? "d3d" : "reversed", 100, k % 2 == 1, ACROSS, DOWN);
        s.parameters[1] = 20;
        const texture_camera *c = &s.camera;
        image depths = image_of(&s);
        frame seen = s.frame;
        seen.image = &depths;
        seen.scene = NULL;
        float *made[THINGS], *error[THINGS];
        for (int i = 0; i < THINGS; i++) {
            frame_product p = {.kind = i == PLACE ? FRAME_POSITION : FRAME_EYE, .radial = i == RADIAL};
            p.position = i == PLACE ? position_find("view") : NULL;
            made[i] = make(&seen, &p, false);
            p.error = true;
            error[i] = make(&seen, &p, false);
        }
        for (uint32_t i = 0; i < ACROSS * DOWN; i++) {
            const uint32_t x = i % ACROSS, y = i / ACROSS, code = ((const uint32_t *)depths.data)[i];
            if (isnan(made[EYE][i]))
                continue;
            const double z = dp_stored(&c->setup, code), along = camera_radial(c, x, y);
            const double reach = grain_range_of(&c->setup, NULL, code).reach;
            double view[3], relative[3];
            camera_view(c, x, y, z, view);
            camera_turn(c, view, relative);
            const double want[THINGS] = {fabs((double)made[EYE][i] - z) + reach,
                                         fabs((double)made[RADIAL][i] - z * along) + reach * along,
                                         position_off(c, relative, made[PLACE] + 3 * i) + reach * along};
            for (int p = 0; p < THINGS; p++)
                TALLY(&t, (double)error[p][i] >= want[p] && (double)error[p][i] <= want[p] * (1 + 0x1p-22),
                      "camera %d, product %d at %u, %u: %.9g, not %.9g", k, p, x, y, (double)error[p][i], want[p]);
        }
        for (int i = 0; i < THINGS; i++) {
            free(made[i]);
            free(error[i]);
        }
        free(depths.data);
    }
    assert_true(t.cases > 10000);
    tally_end(&t);
}

/* The same where the image has 8 or 12 bits, cut off or rounded: its normals are those of the samples alone. */
static void normals_of_coarse_images_are_within_the_predicted(void **state) {
    (void)state;
    tally t = {.name = "coarse normals"};
    rng r = rng_make("coarse normals");
    double nearest = 0;
    for (int k = 0; k < 24; k++) {
        enum { ACROSS = 96, DOWN = 54 };
        stage s;
        stage_set(&s, "plane", "unorm24", k % 2 ? "reversed" : "d3d", 12, k % 6 == 5, ACROSS, DOWN);
        s.parameters[0] = rng_uniform(&r, 0.3, 3);
        s.parameters[1] = rng_uniform(&r, -60, 60);
        s.parameters[2] = rng_uniform(&r, -60, 60);
        const double steps = k % 3 ? 4095 : 255;
        static uint32_t codes[ACROSS * DOWN];
        static scene_hit hits[ACROSS * DOWN];
        const dp_setup *setup = &s.camera.setup;
        for (uint32_t i = 0; i < ACROSS * DOWN; i++) {
            s.frame.scene->hit(&s.camera, s.parameters, i % ACROSS, i / ACROSS, &hits[i]);
            const double v = dp_format_value(&setup->spec.format, dp_code(setup, hits[i].z));
            const double sample = floor(v * steps + (k % 4 < 2 ? 0.5 : 0));
            codes[i] = (uint32_t)floor(sample / steps * setup->spec.format.code_max + 0.5);
        }
        const image depths = {.width = ACROSS, .height = DOWN, .channels = 1, .type = IMAGE_U32, .data = codes};
        const grain g = {.kind = GRAIN_STEPS, .steps = steps, .buffer = true};
        frame seen = s.frame;
        seen.image = &depths;
        seen.scene = NULL;
        seen.grain = &g;
        const frame_product normal = {.kind = FRAME_NORMAL, .normal = normal_find("projective")};
        const frame_product error = {.kind = FRAME_NORMAL, .normal = normal.normal, .error = true};
        float *got = make(&seen, &normal, false), *bound = make(&seen, &error, false);
        for (size_t i = 0; i < ACROSS * DOWN; i++) {
            const double found[3] = {(double)got[3 * i], (double)got[3 * i + 1], (double)got[3 * i + 2]};
            if (isnan(found[0]) || isnan((double)bound[i]) || isinf(hits[i].z))
                continue;
            const double off = normal_angle(found, hits[i].normal) * 180 / 3.14159265358979323846;
            TALLY(&t, off <= (double)bound[i], "%g steps, picture %d at %zu: %g degrees, not %g", steps, k, i, off,
                  (double)bound[i]);
            nearest = fmax(nearest, off / (double)bound[i]);
        }
        free(got);
        free(bound);
    }
    print_message("# largest share of the predicted error of coarse normals: %.3f\n", nearest);
    assert_true(nearest > 0.3);
    tally_end(&t);
}

static void an_image_gives_the_same_as_its_scene(void **state) {
    (void)state;
    frame_product all[PRODUCTS];
    stage s;
    stage_set(&s, "decals", "unorm24", "reversed", 1000, false, 320, 180);
    image depths = image_of(&s);
    frame seen = s.frame;
    seen.image = &depths;
    seen.scene = NULL;
    const size_t count = products(all);
    for (size_t i = 0; i < count; i++) {
        if (all[i].error)
            continue;
        float *want = make(&s.frame, &all[i], false), *got = make(&seen, &all[i], false);
        assert_memory_equal(got, want, (size_t)320 * 180 * (size_t)frame_channels(&all[i]) * sizeof *got);
        free(want);
        free(got);
    }
    /* Of a scene the error is that of the cell; of an image that of what binary32 has made of the depth. */
    const frame_product effect = all[PRODUCTS - 1];
    assert_true(effect.kind == FRAME_EFFECT && effect.error);
    float *least = make(&s.frame, &effect, false), *bound = make(&seen, &effect, false);
    for (size_t i = 0; i < (size_t)320 * 180; i++)
        assert_true(isnan(least[i]) ? isnan(bound[i]) : fabsf(bound[i] - least[i]) <= 0.2F);
    free(least);
    free(bound);
    /* Normals have a bound on planes, which here is kept nearly everywhere: but where decals begin. */
    const frame_product angles = {.kind = FRAME_NORMAL, .normal = normal_find("high"), .error = true};
    assert_null(frame_refuses(&seen, &angles));
    float *truly = make(&s.frame, &angles, false), *most = make(&seen, &angles, false);
    size_t kept = 0;
    for (size_t i = 0; i < (size_t)320 * 180; i++)
        kept += (isnan(truly[i]) ? isnan(most[i]) : truly[i] <= most[i]) ? 1 : 0;
    assert_true(kept > (size_t)320 * 180 * 95 / 100);
    free(truly);
    free(most);
    free(depths.data);
}

/* Roberts' detector sees an edge on either diagonal of a quad: here |s1 - s4| and |s2 - s3| of four depths, by hand. */
static void an_edge_on_either_diagonal_is_one(void **state) {
    static const struct {
        double corner[2][2];
        float edge;
    } quads[] = {{{{10, 10}, {10, 10}}, 0}, {{{10, 10}, {10, 60}}, 1}, {{{10, 60}, {10, 10}}, 1},
                 {{{10, 10}, {60, 10}}, 1}, {{{60, 10}, {10, 10}}, 1}, {{{10, 10}, {60, 60}}, 1}};
    (void)state;
    const effect_row *edge = effect_find("edge");
    double at[TEXTURE_PARAMETERS];
    parameter_defaults(edge->parameters, at);
    at[0] = 0.03; /* of far, 1000: 30 */
    for (size_t k = 0; k < sizeof quads / sizeof quads[0]; k++) {
        stage s;
        uint32_t codes[4];
        stage_set(&s, "plane", "fp32", "reversed", 1000, false, 2, 2);
        for (int i = 0; i < 4; i++)
            codes[i] = dp_code(&s.camera.setup, quads[k].corner[i / 2][i % 2]);
        const image depths = {
            .width = 2, .height = 2, .channels = 1, .type = IMAGE_U32, .file = IMAGE_NPY, .data = codes};
        s.frame.image = &depths;
        s.frame.scene = NULL;
        const frame_product p = {.kind = FRAME_EFFECT, .effect = edge, .effect_settings = at};
        float *got = make(&s.frame, &p, false);
        assert_true(got[0] == quads[k].edge);
        free(got);
    }
}

static int by_value(const void *a, const void *b) {
    const float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

static void summaries_are_those_of_sorted_numbers(void **state) {
    (void)state;
    stage s;
    stage_set(&s, "plane", "unorm16", "d3d", 1000, false, 700, 400);
    s.parameters[1] = 60;
    const frame_product p = {.kind = FRAME_EYE, .error = true};
    frame_summary sum;
    float *values = make(&s.frame, &p, false);
    size_t count = 0, greatest = 0;
    long double total = 0;
    for (size_t i = 0; i < 700 * 400; i++)
        if (!isnan(values[i]) && !(values[i] <= values[greatest]))
            greatest = i;
    const uint32_t greatest_column = (uint32_t)(greatest % 700), greatest_row = (uint32_t)(greatest / 700);
    for (size_t i = 0; i < 700 * 400; i++)
        if (!isnan(values[i])) {
            total += (long double)values[i];
            values[count++] = values[i];
        }
    qsort(values, count, sizeof *values, by_value);
    assert_true(frame_summarise(&s.frame, &p, &sum));
    assert_int_equal(sum.count, count);
    assert_true(count > 100000 && count < 700 * 400); /* some is sky */
    assert_true(sum.lo == (double)values[0] && sum.hi == (double)values[count - 1]);
    assert_relative(sum.mean, (double)(total / count), 1e-12);
    assert_true(sum.hi_column == greatest_column && sum.hi_row == greatest_row && greatest_row % 8 != 0);
    const double p99 = (double)values[(size_t)ceil(0.99 * (double)count) - 1];
    assert_true(sum.p99 >= p99 && sum.p99 <= p99 * (1 + 0x1p-11));
    free(values);
}

static bool stop(void *context, uint32_t row, uint32_t count, const float *values) {
    (void)row, (void)count, (void)values;
    return ++*(int *)context < 2;
}

static void the_smallest_images_and_a_stop(void **state) {
    static const uint32_t sizes[][2] = {{1, 1}, {1, 5}, {7, 1}, {2, 2}};
    frame_product all[PRODUCTS];
    (void)state;
    const size_t count = products(all);
    stage s;
    for (size_t k = 0; k < 4; k++)
        for (size_t i = 0; i < count; i++) {
            stage_set(&s, "plane", "unorm24", "d3d", 1000, false, sizes[k][0], sizes[k][1]);
            free(make(&s.frame, &all[i], true));
        }
    int strips = 0;
    stage_set(&s, "plane", "unorm24", "d3d", 1000, false, WIDTH, HEIGHT);
    assert_false(frame_run(&s.frame, &all[0], false, stop, &strips));
    assert_int_equal(strips, 2);
}

/* Samples of binary16 that are off by 2^-24: one is the far plane's own, one may be infinitely far, one is near. */
static void summaries_leave_out_sky_and_what_has_no_bound(void **state) {
    static uint32_t codes[] = {0, 1, 0x3800};
    const image depths = {.width = 3, .height = 1, .channels = 1, .type = IMAGE_U32, .data = codes};
    const grain g = {.kind = GRAIN_FLOATS, .bits = 11, .margin = 0x1p-24, .least = 0x1p-24};
    const frame_product error = {.kind = FRAME_EYE, .error = true};
    frame_summary sum;
    stage s;
    (void)state;
    stage_set(&s, "plane", "fp16", "reversed", INFINITY, false, 3, 1);
    s.frame.scene = NULL;
    s.frame.image = &depths;
    s.frame.grain = &g;
    s.frame.sky = 0;
    assert_true(frame_summarise(&s.frame, &error, &sum));
    assert_int_equal(sum.count, 1);
    assert_int_equal(sum.infinite, 1);
    assert_int_equal(sum.hi_column, 2);
    assert_true(frame_summarise_decoding(&s.frame, decode_find("linear-eye"), &sum));
    assert_int_equal(sum.count, 2);
    assert_int_equal(sum.infinite, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bits_do_not_depend_on_threads_or_direction),
        cmocka_unit_test(products_of_one_pass_are_those_of_many),
        cmocka_unit_test(frames_equal_plain_pixels),
        cmocka_unit_test(normals_do_not_know_of_strips),
        cmocka_unit_test(true_errors_are_within_the_predicted),
        cmocka_unit_test(errors_of_images_equal_plain_pixels),
        cmocka_unit_test(normals_of_coarse_images_are_within_the_predicted),
        cmocka_unit_test(an_image_gives_the_same_as_its_scene),
        cmocka_unit_test(an_edge_on_either_diagonal_is_one),
        cmocka_unit_test(the_smallest_images_and_a_stop),
        cmocka_unit_test(summaries_are_those_of_sorted_numbers),
        cmocka_unit_test(summaries_leave_out_sky_and_what_has_no_bound),
    };
    return run_tap(tests);
}
