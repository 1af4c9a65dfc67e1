/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Frames: strips on several threads give the bits of one pixel after the other, of scenes and of their images.
 */
#include "named.h"
#include "support.h"
#include "synthetic_stage.h"
#include "texture/normal_errors.h"
#include "texture/survey.h"

/* Three strips, the last one shorter. */
enum { WIDTH = 2100, HEIGHT = 260, PIXELS = WIDTH * HEIGHT };

/* One of each. */
enum { PRODUCTS = 14 };
static double settings[2][PARAMETERS_MAX];

static size_t products(frame_product out[PRODUCTS]) {
    const effect_row *effect = effect_find("intersection");
    for (int i = 0; i < 2; i++)
        parameter_defaults(effect->parameters, settings[i]);
    settings[0][parameter_find(effect->parameters, "reference")] = 10;
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
        {.kind = FRAME_EFFECT, .effect = effect, .effect_settings = settings[0]},
        {.kind = FRAME_EFFECT, .effect = effect, .effect_settings = settings[1], .error = true},
    };
    memcpy(out, all, sizeof all);
    return sizeof all / sizeof all[0];
}

TEST(bits_do_not_depend_on_threads_or_direction) {
    frame_product all[PRODUCTS];
    synthetic_stage s;
    synthetic_stage_set(&s, "sphere", "unorm24", "d3d", 1000, false, WIDTH, HEIGHT);
    const size_t count = products(all);
    for (size_t i = 0; i < count; i++) {
        const size_t size = (size_t)PIXELS * (size_t)frame_channels(&all[i]) * sizeof(float);
        frame_summary one, many;
        s.frame.threads = 1;
        float *want = frame_made(&s.frame, &all[i], false);
        assert_true(frame_summarise(&s.frame, &all[i], &one));
        assert_true(one.count > PIXELS / 50);
        for (int threads = 2; threads <= 5; threads += 3) {
            s.frame.threads = threads;
            float *got = frame_made(&s.frame, &all[i], threads == 5);
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
        whole_take(&w->each[i], row, count, values[i]);
    return true;
}

TEST(products_of_one_pass_are_those_of_many) {
    frame_product all[PRODUCTS];
    wholes w = {.count = products(all)};
    synthetic_stage s;
    synthetic_stage_set(&s, "sphere", "unorm24", "d3d", 1000, false, WIDTH, HEIGHT);
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
            float *want = frame_made(&s.frame, &all[i], false);
            assert_memory_equal(w.each[i].values, want, w.each[i].row_values * HEIGHT * sizeof(float));
            free(want);
        }
    }
    for (size_t i = 0; i < w.count; i++)
        free(w.each[i].values);
}

/* The pixels of the frame, one by one, from the scalar functions alone. */
static bool is_sky(const dp_setup *setup, uint32_t code) {
    const double d = dp_format_value(&setup->spec.format, code);
    return (setup->reversed ? d : 1 - d) <= FRAME_SKY;
}

static bool same_bits(float a, float b) {
    return memcmp(&a, &b, sizeof a) == 0 || (isnan(a) && isnan(b));
}

/* How far what is written is off from the truth, rounded up to binary32. */
static bool is_error(float error, float written, long double truth) {
    const long double off = fabsl((long double)written - truth), spare = 0x1p-49L * fabsl(truth);
    return (long double)error >= off - spare / 4 && (long double)error <= (off + spare) * (1 + 0x1p-22L) + 0x1p-148L;
}

/* Long: every product of a pixel, and how each is made by hand. */
TEST(frames_equal_plain_pixels) {
    static const struct {
        const char *synthetic, *format, *mapping;
        double znear, zfar;
        bool ortho;
    } cases[] = {{"plane", "unorm24", "d3d", 0.1, 1000, false},  {"sphere", "fp32", "reversed", 0.1, INFINITY, false},
                 {"steps", "unorm16", "d3d", 0.1, 1000, true},   {"decals", "fp16", "reversed", 0.1, 1000, false},
                 {"plane", "fp32", "linear", 0.1, 1000, false},  {"sphere", "fp32", "log", 0.1, 1000, false},
                 {"plane", "fp32", "d3d", -100, 1000, true},     {"plane", "unorm16", "gl-reversed", -20, 20, true},
                 {"steps", "unorm16", "reversed", 0, 1000, true}};
    tally t = {.name = "plain"};
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
        synthetic_stage s;
        synthetic_stage_between(&s, cases[k].synthetic, cases[k].format, cases[k].mapping, cases[k].znear,
                                cases[k].zfar, cases[k].ortho, 97, 61);
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
                            view = {.kind = FRAME_POSITION, .position = position_find("view")},
                            far_off = {.kind = FRAME_EYE, .radial = true, .error = true},
                            shares = {.kind = FRAME_LINEAR01}, shares_off = {.kind = FRAME_LINEAR01, .error = true};
        const bool placed = frame_refuses(&s.frame, &view) == NULL;
        position_state state_of;
        if (placed)
            position_prepare(&state_of, c);
        float *eye = frame_made(&s.frame, &eyes, false), *radial = frame_made(&s.frame, &far, true),
              *error = frame_made(&s.frame, &off, false), *radial_error = frame_made(&s.frame, &far_off, false),
              *share = isinf(c->setup.spec.zfar) ? NULL : frame_made(&s.frame, &shares, false),
              *share_error = isinf(c->setup.spec.zfar) ? NULL : frame_made(&s.frame, &shares_off, false),
              *place = frame_made(&s.frame, &exact, false),
              *method = placed ? frame_made(&s.frame, &view, false) : NULL;
        for (uint32_t y = 0; y < 61; y++)
            for (uint32_t x = 0; x < 97; x++) {
                const size_t i = (size_t)y * 97 + x;
                synthetic_hit h;
                s.frame.synthetic->hit(c, s.parameters, x, y, &h);
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
                const long double along = (long double)camera_radial(c, x, y), end = (long double)c->setup.spec.zfar;
                TALLY(&t, is_error(error[i], eye[i], (long double)h.z), "%zu: error", k);
                TALLY(&t, is_error(radial_error[i], radial[i], (long double)h.z * along), "%zu: radial error", k);
                TALLY(&t, isinf(c->setup.spec.zfar) || is_error(share_error[i], share[i], (long double)h.z / end),
                      "%zu: error of linear01", k);
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
        free(radial_error);
        free(share);
        free(share_error);
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

TEST(normals_do_not_know_of_strips) {
    synthetic_stage s;
    synthetic_stage_set(&s, "sphere", "unorm16", "d3d", 1000, false, WIDTH, HEIGHT);
    s.frame.threads = 2;
    const frame_product eyes = {.kind = FRAME_EYE};
    frame bare = s.frame;
    bare.sky = 0;
    float *eye = frame_made(&s.frame, &eyes, false), *seen = frame_made(&bare, &eyes, false);
    for (size_t i = 0; i < PIXELS; i++)
        seen[i] = isnan(seen[i]) ? 1000 : seen[i];
    for (size_t m = 0; normal_get(m) != NULL; m++) {
        const frame_product p = {.kind = FRAME_NORMAL, .normal = normal_get(m)};
        float *got = frame_made(&s.frame, &p, false), *want = calloc(3 * PIXELS, sizeof *want);
        source all = {p.normal->sees_sky ? seen : eye, want, WIDTH};
        assert_true(normal_run(normal_get(m), &s.camera, 0, HEIGHT, give, keep, &all));
        size_t numbers = 0;
        for (size_t i = 0; i < 3 * PIXELS; i++) {
            assert_true(same_bits(got[i], isnan(eye[i / 3]) ? (float)NAN : want[i]));
            numbers += isnan(got[i]) ? 0 : 1;
        }
        assert_true(numbers > 3 * PIXELS / 50);
        free(got);
        free(want);
    }
    free(eye);
    free(seen);
}

/* ---- Beside the sky: ReconstructNormal as it stands, in double, whose depth texture holds the far plane there ---- */

/* The place that the shader reads at a pixel: where it is, in view space. */
static double shader_place(const synthetic_stage *s, uint32_t column, uint32_t row, double place[3]) {
    uint32_t codes[96];
    frame_codes(&s->frame, row, codes);
    place[2] = dp_stored(&s->camera.setup, codes[column]);
    const double along = s->camera.ortho ? 1 : place[2];
    place[0] = (2 * (column + 0.5) / 96 - 1) * s->camera.half[0] * along;
    place[1] = (1 - 2 * (row + 0.5) / 64) * s->camera.half[1] * along;
    return place[2];
}

/* 1 towards larger columns or rows, else -1: of _SOURCE_DEPTH_LOW, MEDIUM and HIGH, for which `down` says that the
 * second of two sides is the one above. */
static int shader_side(const synthetic_stage *s, char method, uint32_t x, uint32_t y, bool down) {
    double at[5], unused[3];
    if (method == 'l')
        return (down ? y : x) % 2 == 0 ? 1 : -1;
    for (int k = -2; k <= 2; k++)
        at[2 + k] = down ? shader_place(s, x, (uint32_t)((int)y - 2 * k), unused)
                         : shader_place(s, (uint32_t)((int)x + 2 * k), y, unused);
    const bool first =
        method == 'm' ? at[1] > at[3] : fabs(2 * at[1] - at[0] - at[2]) < fabs(2 * at[3] - at[4] - at[2]);
    return first == down ? 1 : -1;
}

static void shader_normal(const synthetic_stage *s, char method, uint32_t x, uint32_t y, double n[3]) {
    const int step = method == 'l' ? 1 : 2;
    const int across = shader_side(s, method, x, y, false), down = shader_side(s, method, x, y, true);
    double p[3], a[3], b[3];
    shader_place(s, x, y, p);
    shader_place(s, (uint32_t)((int)x + step * across), y, a);
    shader_place(s, x, (uint32_t)((int)y + step * down), b);
    for (int k = 0; k < 3; k++) {
        a[k] -= p[k];
        b[k] -= p[k];
    }
    for (int k = 0; k < 3; k++)
        n[k] = across * down * (a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3]);
}

/* A wall with a window to the sky. Beside it low and medium look through it and are most of a right angle off; high is
 * not, but where the sky is on both sides. */
TEST(beside_the_sky_normals_are_the_shaders) {
    static const char *const names[] = {"low", "medium", "high"};
    for (int ortho = 0; ortho < 2; ortho++)
        for (size_t m = 0; m < 3; m++) {
            synthetic_stage s;
            synthetic_hit wall;
            synthetic_stage_set(&s, "plane", "fp32", "reversed", 1000, ortho != 0, 96, 64);
            image depths = synthetic_stage_image(&s);
            uint32_t *codes = depths.data;
            for (uint32_t i = 0; i < 96 * 64; i++)
                codes[i] = i % 96 >= 37 && i % 96 < 60 && i / 96 >= 21 && i / 96 < 40 ? 0 : codes[i];
            s.frame.synthetic->hit(&s.camera, s.parameters, 0, 0, &wall);
            s.frame.image = &depths;
            s.frame.synthetic = NULL;
            const frame_product p = {.kind = FRAME_NORMAL, .normal = normal_find(names[m])};
            float *got = frame_made(&s.frame, &p, false);
            tally t = {.name = names[m]};
            double worst = 0;
            for (uint32_t i = 0; i < 96 * 64; i++) {
                const double found[3] = {(double)got[3 * i], (double)got[3 * i + 1], (double)got[3 * i + 2]};
                const uint32_t x = i % 96, y = i / 96;
                double want[3];
                TALLY(&t, codes[i] != 0 || isnan(found[0]), "sky at %u, %u has a normal", x, y);
                if (codes[i] == 0 || x < 4 || x >= 92 || y < 4 || y >= 60)
                    continue;
                shader_normal(&s, *names[m], x, y, want);
                TALLY(&t, normal_angle(want, found) < 2e-3, "%s at %u, %u: %g", names[m], x, y,
                      normal_angle(want, found));
                worst = fmax(worst, normal_angle(wall.normal, found));
            }
            print_message("# %s: %.1f degrees off\n", names[m], worst * 180 / M_PI);
            assert_true(m < 2 ? worst > 1 : worst < 0.01);
            tally_end(&t);
            free(got);
            free(codes);
        }
}

TEST(an_image_gives_the_same_as_its_scene) {
    frame_product all[PRODUCTS];
    synthetic_stage s;
    synthetic_stage_set(&s, "decals", "unorm24", "reversed", 1000, false, 320, 180);
    image depths = synthetic_stage_image(&s);
    frame seen = s.frame;
    seen.image = &depths;
    seen.synthetic = NULL;
    const size_t count = products(all);
    for (size_t i = 0; i < count; i++) {
        if (all[i].error)
            continue;
        float *want = frame_made(&s.frame, &all[i], false), *got = frame_made(&seen, &all[i], false);
        assert_memory_equal(got, want, (size_t)320 * 180 * (size_t)frame_channels(&all[i]) * sizeof *got);
        free(want);
        free(got);
    }
    /* The error of a scene is that of the cell; of an image that of what binary32 has made of the depth. */
    const frame_product effect = all[PRODUCTS - 1];
    assert_true(effect.kind == FRAME_EFFECT && effect.error);
    float *least = frame_made(&s.frame, &effect, false), *bound = frame_made(&seen, &effect, false);
    for (size_t i = 0; i < (size_t)320 * 180; i++)
        assert_true(isnan(least[i]) ? isnan(bound[i]) : fabsf(bound[i] - least[i]) <= 0.2F);
    free(least);
    free(bound);
    /* Normals have a bound on planes, which here is kept nearly everywhere: but where decals begin. */
    const frame_product angles = {.kind = FRAME_NORMAL, .normal = normal_find("high"), .error = true};
    assert_null(frame_refuses(&seen, &angles));
    float *truly = frame_made(&s.frame, &angles, false), *most = frame_made(&seen, &angles, false);
    size_t kept = 0;
    for (size_t i = 0; i < (size_t)320 * 180; i++)
        kept += (isnan(truly[i]) ? isnan(most[i]) : truly[i] <= most[i]) ? 1 : 0;
    assert_true(kept > (size_t)320 * 180 * 95 / 100);
    free(truly);
    free(most);
    free(depths.data);
}

/* Roberts' detector sees an edge on either diagonal of a quad: here |s1 - s4| and |s2 - s3| of four depths, by hand. */
TEST(an_edge_on_either_diagonal_is_one) {
    static const struct {
        double corner[2][2];
        float edge;
    } quads[] = {{{{10, 10}, {10, 10}}, 0}, {{{10, 10}, {10, 60}}, 1}, {{{10, 60}, {10, 10}}, 1},
                 {{{10, 10}, {60, 10}}, 1}, {{{60, 10}, {10, 10}}, 1}, {{{10, 10}, {60, 60}}, 1}};
    const effect_row *edge = effect_find("edge");
    double at[PARAMETERS_MAX];
    parameter_defaults(edge->parameters, at);
    at[0] = 0.03; /* of far, 1000: 30 */
    for (size_t k = 0; k < sizeof quads / sizeof quads[0]; k++) {
        synthetic_stage s;
        uint32_t codes[4];
        synthetic_stage_set(&s, "plane", "fp32", "reversed", 1000, false, 2, 2);
        for (int i = 0; i < 4; i++)
            codes[i] = dp_code(&s.camera.setup, quads[k].corner[i / 2][i % 2]);
        const image depths = {
            .width = 2, .height = 2, .channels = 1, .type = IMAGE_U32, .file = IMAGE_NPY, .data = codes};
        s.frame.image = &depths;
        s.frame.synthetic = NULL;
        const frame_product p = {.kind = FRAME_EFFECT, .effect = edge, .effect_settings = at};
        float *got = frame_made(&s.frame, &p, false);
        assert_true(got[0] == quads[k].edge);
        free(got);
    }
}

static bool stop(void *context, uint32_t row, uint32_t count, const float *values) {
    (void)row, (void)count, (void)values;
    return ++*(int *)context < 2;
}

TEST(the_smallest_images_and_a_stop) {
    static const uint32_t sizes[][2] = {{1, 1}, {1, 5}, {7, 1}, {2, 2}};
    frame_product all[PRODUCTS];
    const size_t count = products(all);
    synthetic_stage s;
    for (size_t k = 0; k < 4; k++)
        for (size_t i = 0; i < count; i++) {
            synthetic_stage_set(&s, "plane", "unorm24", "d3d", 1000, false, sizes[k][0], sizes[k][1]);
            free(frame_made(&s.frame, &all[i], true));
        }
    int strips = 0;
    synthetic_stage_set(&s, "plane", "unorm24", "d3d", 1000, false, WIDTH, HEIGHT);
    assert_false(frame_run(&s.frame, &all[0], false, stop, &strips));
    assert_int_equal(strips, 2);
}
