/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every value that texture --pixel prints, of scenes and of an image. */
#include "named.h"
#include "texture/frame.h"
#include "texture/image_depths.h"
#include "views.h"

enum { WIDTH = 40, HEIGHT = 24, PIXELS = 4 };

typedef struct pixel_case {
    const char *line;
    const char *written; /* of an image, behind its name: what is not found or assumed */
    bool assumed;        /* its mapping and field of view are not given */
    double yaw, pitch;
} pixel_case;

static const pixel_case cases[] = {
    {"texture --synthetic decals --size 40x24 -n 0.3 -f 1000 -F unorm16 -m d3d --fov 40 --eye 1,-2,3 "
     "--look 107.73322205178,-55.775093275305,608.31418177148 --pixel '20,12;0,0;39,23;3,11'",
     NULL, false, 10, -5},
    {"texture --synthetic sphere --size 40x24 -n 1 -f 60 -F fp16 -m gl --ortho=3 "
     "--look=-16833.119889,0,46248.616794 --pixel '20,12;0,0;26,10;17,15'",
     NULL, false, -20, 0},
    {"texture -n 0.2 -f 500 -F unorm16 -m reversed --fov 70 --sky 0.01 --pixel '5,5;0,15;10,10;21,22'",
     "-n 0.2 -f 500 -F unorm16 -m reversed --fov 70 --look 0,1,1.7320508075688772 --sky 0.01 "
     "--pixel '5,5;0,15;10,10;21,22'",
     false, 0, 30.000000000000004},
    {"texture -n 0.2 -f 500 -F unorm16 -m reversed --pixel '6,5;39,0;10,10;21,22'",
     "-n 0.2 -f 500 -F unorm16 --pixel '6,5;39,0;10,10;21,22'", true, 0, 0},
};

static void pixels_of(const pixel_case *c, uint32_t at[PIXELS][2]) {
    assert_int_equal(sscanf(strstr(c->line, "--pixel '"), "--pixel '%u,%u;%u,%u;%u,%u;%u,%u'", &at[0][0], &at[0][1],
                            &at[1][0], &at[1][1], &at[2][0], &at[2][1], &at[3][0], &at[3][1]),
                     2 * PIXELS);
}

/* A window depth that falls to the right and downwards, with a hole at 10,10 and sky below row 15. */
static float sample_at(uint32_t x, uint32_t y) {
    return x == 10 && y == 10 ? (float)NAN
           : y >= 16          ? 0.0f
                              : 0.2412345f / (1 + 0.0371f * (float)x + 0.0113f * (float)(y * y));
}

static void write_image(const char *path, image *out) {
    char header[128];
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    snprintf(header, sizeof header, "{'descr': '<f4', 'fortran_order': False, 'shape': (%d, %d), }", HEIGHT, WIDTH);
    fwrite("\x93NUMPY\x01\x00\x76\x00", 1, 10, file);
    fprintf(file, "%-117s\n", header);
    float *samples = malloc(WIDTH * HEIGHT * sizeof *samples);
    assert_non_null(samples);
    for (uint32_t y = 0; y < HEIGHT; y++)
        for (uint32_t x = 0; x < WIDTH; x++)
            samples[y * WIDTH + x] = sample_at(x, y);
    fwrite(samples, sizeof *samples, WIDTH * HEIGHT, file);
    assert_int_equal(fclose(file), 0);
    *out = (image){.width = WIDTH, .height = HEIGHT, .channels = 1, .type = IMAGE_F32, .data = samples};
}

static bool keep(void *context, uint32_t row, uint32_t count, const float *made) {
    const frame_product *p = ((void **)context)[0];
    float *all = ((void **)context)[1];
    const size_t channels = (size_t)frame_channels(p);
    memcpy(all + row * WIDTH * channels, made, count * WIDTH * channels * sizeof *all);
    return true;
}

/* The normals of all pixels, or by how much they are off. */
static void normals_of(const frame *f, bool error, float *out) {
    const frame_product p = {.kind = FRAME_NORMAL, .error = error, .normal = normal_find("projective")};
    void *context[] = {(void *)(uintptr_t)&p, out};
    assert_true(frame_run(f, &p, false, keep, context));
}

/* The eye depth of a pixel; NaN outside and in holes. */
static double eye_at(const frame *f, int x, int y, uint32_t *code) {
    uint32_t codes[WIDTH];
    *code = UINT32_MAX;
    if (x < 0 || x >= WIDTH || y < 0 || y >= HEIGHT)
        return NAN;
    frame_codes(f, (uint32_t)y, codes);
    *code = codes[x];
    return codes[x] == UINT32_MAX ? NAN : dp_stored(&f->camera->setup, codes[x]);
}

static void want_place(values *v, const pixel_case *c, const frame *f, const uint32_t at[2], double z, bool seen,
                       size_t i) {
    static float normals[3 * WIDTH * HEIGHT], errors[WIDTH * HEIGHT];
    const size_t index = at[1] * WIDTH + at[0];
    double view[3], world[3], eye[3] = {0, 0, 0};
    numbers_behind(c->line, "--eye", eye, 3);
    if (c->assumed)
        return;
    camera_view(f->camera, at[0], at[1], z, view);
    camera_turn(f->camera, view, world);
    normals_of(f, false, normals);
    normals_of(f, true, errors);
    for (int k = 0; k < 3; k++) {
        const char *const axis = &"x\0y\0z"[2 * k];
        values_under(v, "pixels[%zu].position.", i);
        want_number(v, axis, seen ? eye[k] + world[k] : NAN);
        values_under(v, "pixels[%zu].normal.", i);
        want_number(v, axis, (double)normals[3 * index + (size_t)k]);
    }
    /* The ray's length for a unit of eye depth; the depth's error lies along it. */
    const double along = camera_radial(f->camera, at[0], at[1]);
    if (seen && !f->camera->ortho)
        assert_relative(z * along, sqrt(view[0] * view[0] + view[1] * view[1] + z * z), 1e-12);
    uint32_t code;
    eye_at(f, (int)at[0], (int)at[1], &code);
    synthetic_hit hit = {.z = NAN};
    if (f->synthetic != NULL)
        f->synthetic->hit(f->camera, f->parameters, at[0], at[1], &hit);
    const double off = !seen                  ? NAN
                       : f->synthetic != NULL ? fabs(dp_error(&f->camera->setup, code, hit.z))
                                              : grain_range_of(&f->camera->setup, f->grain, code).reach;
    values_under(v, "pixels[%zu].", i);
    want(v, "distance=%f position_error=%f", seen ? z * along : NAN, off * along);
    want(v, "normal_error=%f", (double)errors[index]);
}

static void want_pixel(values *v, const pixel_case *c, const frame *f, const uint32_t at[2], size_t i) {
    static const char *const sides[] = {"left", "right", "above", "below"};
    static const int steps[][2] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};
    const dp_setup *setup = &f->camera->setup;
    uint32_t code, other;
    const double z = eye_at(f, (int)at[0], (int)at[1], &code);
    const bool hole = code == UINT32_MAX, sky = !hole && frame_rank(setup, code) >= frame_sky_rank(f);
    const grain_range r = hole ? (grain_range){NAN, NAN, NAN} : grain_range_of(setup, f->grain, code);
    values_under(v, "pixels[%zu].", i);
    want(v, "column=%u row=%u state=%s", at[0], at[1], hole ? "hole" : sky ? "sky" : "depth");
    want(v, "code=%f z=%f lo=%f hi=%f", hole ? NAN : code, z, r.lo, r.hi);
    want(v, "interval=%f linear01=%f", r.hi - r.lo, z / setup->spec.zfar);
    if (f->synthetic != NULL) {
        synthetic_hit hit;
        f->synthetic->hit(f->camera, f->parameters, at[0], at[1], &hit);
        assert_int_equal(code, dp_code(setup, fmin(hit.z, setup->spec.zfar)));
        want(v, "depth=%f truth=%f", dp_format_value(&setup->spec.format, code), isinf(hit.z) ? NAN : hit.z);
        want(v, "error=%f", isinf(hit.z) ? NAN : dp_error(setup, code, hit.z));
    } else {
        want(v, "depth=%f", (double)sample_at(at[0], at[1]));
    }
    for (int k = 0; k < 4; k++)
        want_number(v, sides[k], eye_at(f, (int)at[0] + steps[k][0], (int)at[1] + steps[k][1], &other));
    want_place(v, c, f, at, z, !hole && !sky, i);
}

static void check_text(values *v, const char *arguments, const pixel_case *c) {
    static const char *const lines[][2] = {{"code  ", "code:9, depth:9"},
                                           {"linear01  ", "linear01:9"},
                                           {"may be  ", "lo:5, hi:5, interval:5"},
                                           {"truth  ", "truth:6, error:6"},
                                           {"position  ", "position.x:9, position.y:9, position.z:9"},
                                           {"distance  ", "distance:6, position_error:6"},
                                           {"normal  ", "normal.x:6, normal.y:6, normal.z:6"},
                                           {"off by", "normal_error:6"}};
    uint32_t pixels[PIXELS][2];
    char *text = output_of(0, arguments, "");
    pixels_of(c, pixels);
    for (size_t i = 0; i < PIXELS; i++) {
        char at[2 * PATH_SIZE];
        snprintf(at, sizeof at, "pixel %u,%u:", pixels[i][0], pixels[i][1]);
        char *section = strstr(text, at);
        assert_non_null(section);
        char *end = strstr(section, "\n\n");
        section = strndup(section, end != NULL ? (size_t)(end - section) + 1 : strlen(section));
        values_under(v, "pixels[%zu].", i);
        snprintf(at, sizeof at, "%sstate", v->prefix);
        const bool seen = strcmp(value_at(v, at)->text, "depth") == 0;
        for (size_t k = 0; k < sizeof lines / sizeof lines[0]; k++) {
            snprintf(at, sizeof at, "%s%.*s", v->prefix, (int)strcspn(lines[k][1], ":"), lines[k][1]);
            const wanted *first = value_find(v, at);
            if (first != NULL && !isnan(first->number) && (k < 4 || seen))
                check_line(v, section, lines[k][0], lines[k][1]);
        }
        free(section);
    }
    free(text);
}

TEST(each_number) {
    static const grain floats = {.kind = GRAIN_FLOATS, .buffer = true, .bits = 24, .least = 0x1p-149};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const pixel_case *c = &cases[i];
        const texture_camera camera = view_placed(c->line, WIDTH, HEIGHT, c->yaw, c->pitch);
        const char *synthetic = word_behind(c->line, "--synthetic"), *path = scratch_file("pixel.npy");
        double parameters[PARAMETERS_MAX];
        uint32_t pixels[PIXELS][2];
        image shot = {0};
        frame f = {.camera = &camera, .sky = number_behind(c->line, "--sky", 1e-4)};
        char line[1024];
        values v = values_of(c->line);
        snprintf(line, sizeof line, "%s", c->line);
        if (synthetic != NULL) {
            f.synthetic = synthetic_find(synthetic);
            parameter_defaults(f.synthetic->parameters, parameters);
            f.parameters = parameters;
        } else {
            write_image(path, &shot);
            f.image = &shot;
            f.grain = &floats;
            snprintf(line, sizeof line, "texture %s %s", path, c->written);
        }
        want_text(&v, "file", synthetic != NULL ? NULL : path);
        want_text(&v, "synthetic", synthetic);
        want_setup(&v, &camera.setup);
        want(&v, "format_from=%s mapping_from=%s", "given", c->assumed ? "assumed" : "given");
        want(&v, "direction_from=%s", c->assumed ? "found" : "given");
        pixels_of(c, pixels);
        for (size_t k = 0; k < PIXELS; k++)
            want_pixel(&v, c, &f, pixels[k], k);
        check_forms(&v, 0, line, "pixels[]",
                    SETUP_CSV "column, row, state, code, depth, z [scene], lo [scene], hi [scene], interval [scene], "
                              "linear01, ?truth [scene], ?error [scene], left [scene], right [scene], above [scene], "
                              "below [scene], ?position_x [scene] = position.x, ?position_y [scene] = position.y, "
                              "?position_z [scene] = position.z, ?position_error [scene], ?distance [scene], "
                              "?normal_x = normal.x, ?normal_y = normal.y, ?normal_z = normal.z, "
                              "?normal_error [degrees]");
        check_text(&v, line, c);
        values_free(&v);
        free(shot.data);
    }
}

/* Outlines have a bound by normals of any method; the normal has none where pixels have planes of their own. */
TEST(without_a_bound) {
    const char *path = scratch_file("slope.npy");
    const char *matrix = scratch_text("oblique.txt", "1 0 0 0  0 1 0 0  0.1 0 -0.0001 0.1  0 0 -1 0\n");
    image shot;
    write_image(path, &shot);
    check_says(0, " levels\n", "texture %s -F fp32 -m reversed -q --product effect:outline:low --pixel 6,5", path);
    check_says(0, " in view space\n", "texture %s -F fp32 -m reversed -q --matrix %s --pixel 6,5", path, matrix);
    check_says(0, "! degrees", "texture %s -F fp32 -m reversed -q --matrix %s --pixel 6,5", path, matrix);
    free(shot.data);
}

/* What is usual in perspective pictures tells the mapping of these alone; of an orthographic one d3d is assumed. */
TEST(mapping_of_what_is_seen) {
    const char *path = scratch_file("sphere.npy");
    printed p = print_of("texture --synthetic sphere -F d24 -m reversed -n 0.1 -f 1000 --size 64x48 -q -o %s", path);
    assert_int_equal(p.status, 0);
    printed_free(&p);
    for (int ortho = 0; ortho < 2; ortho++) {
        json_t *root = json_printed(0, "texture %s -F d24 -n 0.1 -f 1000%s", path, ortho ? " --ortho" : "");
        assert_true(flag_at(root, "recognised.reversed"));
        assert_string_equal(text_at(root, "mapping"), ortho ? "d3d" : "reversed");
        assert_string_equal(text_at(root, "mapping_from"), "assumed");
        json_decref(root);
    }
}

/* A grey of a PNG is offset + scale grey of what the same product has in an npy file; 0 stands for no value. */
TEST(greys_mean_what_is_said) {
    static const char *const products[] = {"linear01",
                                           "eye",
                                           "radial",
                                           "normal:projective",

                                           "eye --parameter distance=5",
                                           "effect:fog"};
    for (size_t i = 0; i < sizeof products / sizeof products[0]; i++) {
        static const char line[] =
            "texture --synthetic plane --parameter tilt=20 -F d24 -m d3d -n 0.5 -f 40 --size 24x16 "
            "-q --product %s -o %s%s";
        char path[2][256];
        image grey, number;
        image_error error;
        for (int k = 0; k < 2; k++)
            snprintf(path[k], sizeof path[k], "%s", scratch_file(k == 0 ? "product.png" : "product.npy"));
        json_t *root = json_printed(0, line, products[i], path[0], "");
        printed p = print_of(line, products[i], path[1], "");
        assert_int_equal(p.status, 0);
        assert_true(image_read(path[0], &grey, &error) && image_read(path[1], &number, &error));
        const double offset = number_at(root, "offset"), scale = number_at(root, "scale");
        const size_t count = (size_t)grey.width * grey.height * grey.channels;
        assert_true(count == (size_t)number.width * number.height * number.channels);
        size_t seen = 0;
        for (size_t at = 0; at < count; at++) {
            const double g = ((const uint16_t *)grey.data)[at], value = (double)((const float *)number.data)[at];
            const double x = i == 3 && at % 3 == 2 ? -value : value; /* towards the camera */
            const bool none = isnan(x);
            seen += !none;
            if (none ? g != 0 : fabs(offset + scale * g - x) > 0.5000001 * scale + 1e-6 * fabs(x))
                fail_msg("%s, sample %zu: %g is %g, and not %g", products[i], at, g, offset + scale * g, x);
        }
        assert_true(seen > count / 4);
        image_free(&grey);
        image_free(&number);
        printed_free(&p);
        json_decref(root);
    }
}

/* Orthographic rays start in a plane. 10 sqrt(1 + 2 (7/8 tan 30)^2) = 12.289901, and a code that is off by 1.57e-7. */
TEST(distance) {
    static const char line[] = "texture --synthetic plane --size 8x8 -F fp32 -m reversed --pixel 0,0";
    check_says(0, "distance      12.2899012 from the camera, off by ", "%s", line);
    check_says(0, "distance      9.99999046 from the camera's plane, off by ", "%s --ortho -n 0", line);
}

LIST_TEST(check_apart)
