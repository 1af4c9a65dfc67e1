/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every value that texture --pixel prints, of scenes and of an image. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "frame/frame.h"
#include "frame/image_depths.h"
#include "named.h"
#include "views.h"

enum { WIDTH = 40, HEIGHT = 24, PIXELS = 4 };

typedef struct pixel_case {
    camera_case camera;
    const char *synthetic, *options; /* null: an image */
    const char *direction_from;      /* null: given as all else; else the mapping is assumed, and --fov not given */
    double fov, half_height, yaw, pitch, origin[3], sky;
    uint32_t at[PIXELS][2];
} pixel_case;

static const pixel_case cases[] = {
    {{0.3, 1000, {"unorm16"}, {"d3d"}, .ortho = 0},
     "decals",
     "--fov 40 --eye 1,-2,3 --look 107.73322205178,-55.775093275305,608.31418177148",
     NULL,
     40,
     NAN,
     10,
     -5,
     {1, -2, 3},
     1e-4,
     {{20, 12}, {0, 0}, {39, 23}, {3, 11}}},
    {{1, 60, {"fp16"}, {"gl"}, .ortho = 1, .half = 3},
     "sphere",
     "--look=-16833.119889,0,46248.616794",
     NULL,
     NAN,
     3,
     -20,
     0,
     {0, 0, 0},
     1e-4,
     {{20, 12}, {0, 0}, {26, 10}, {17, 15}}},
    {{0.2, 500, {"unorm16"}, {"reversed"}, .ortho = 0},
     NULL,
     "--fov 70 --look 0,1,1.7320508075688772 --sky 0.01",
     NULL,
     70,
     NAN,
     0,
     30.000000000000004,
     {0, 0, 0},
     0.01,
     {{5, 5}, {0, 15}, {10, 10}, {21, 22}}},
    {{0.2, 500, {"unorm16"}, {"reversed"}, .ortho = 0},
     NULL,
     "-n 0.2 -f 500 -F unorm16",
     "found",
     NAN,
     NAN,
     0,
     0,
     {0, 0, 0},
     1e-4,
     {{6, 5}, {39, 0}, {10, 10}, {21, 22}}},
};

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
    double view[3], world[3];
    if (c->direction_from != NULL)
        return;
    camera_view(f->camera, at[0], at[1], z, view);
    camera_turn(f->camera, view, world);
    normals_of(f, false, normals);
    normals_of(f, true, errors);
    for (int k = 0; k < 3; k++) {
        const char *const axis = &"x\0y\0z"[2 * k];
        values_under(v, "pixels[%zu].position.", i);
        want_number(v, axis, seen ? c->origin[k] + world[k] : NAN);
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
    want_number(v, "distance", seen ? z * along : NAN);
    want_number(v, "position_error", off * along);
    values_under(v, "pixels[%zu].", i);
    want_number(v, "normal_error", (double)errors[index]);
}

static void want_pixel(values *v, const pixel_case *c, const frame *f, size_t i) {
    static const char *const sides[] = {"left", "right", "above", "below"};
    static const int steps[][2] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};
    const uint32_t *at = c->at[i];
    const dp_setup *setup = &f->camera->setup;
    uint32_t code, other;
    const double z = eye_at(f, (int)at[0], (int)at[1], &code);
    const bool hole = code == UINT32_MAX, sky = !hole && frame_rank(setup, code) >= frame_sky_rank(f);
    const grain_range r = hole ? (grain_range){NAN, NAN, NAN} : grain_range_of(setup, f->grain, code);
    values_under(v, "pixels[%zu].", i);
    want_count(v, "column", at[0]);
    want_count(v, "row", at[1]);
    want_text(v, "state", hole ? "hole" : sky ? "sky" : "depth");
    want_number(v, "code", hole ? NAN : code);
    want_number(v, "z", z);
    want_number(v, "lo", r.lo);
    want_number(v, "hi", r.hi);
    want_number(v, "interval", r.hi - r.lo);
    want_number(v, "linear01", z / setup->spec.zfar);
    if (f->synthetic != NULL) {
        synthetic_hit hit;
        f->synthetic->hit(f->camera, f->parameters, at[0], at[1], &hit);
        assert_int_equal(code, dp_code(setup, fmin(hit.z, setup->spec.zfar)));
        want_number(v, "depth", dp_format_value(&setup->spec.format, code));
        want_number(v, "truth", isinf(hit.z) ? NAN : hit.z);
        want_number(v, "error", isinf(hit.z) ? NAN : dp_error(setup, code, hit.z));
    } else {
        want_number(v, "depth", (double)sample_at(at[0], at[1]));
    }
    for (int k = 0; k < 4; k++)
        want_number(v, sides[k], eye_at(f, (int)at[0] + steps[k][0], (int)at[1] + steps[k][1], &other));
    want_place(v, c, f, at, z, !hole && !sky, i);
}

static void check_text(const values *v, const char *arguments, const pixel_case *c) {
    printed p = print_of("%s", arguments);
    assert_int_equal(p.status, 0);
    for (size_t i = 0; i < PIXELS; i++) {
        static const struct {
            const char *label;
            int digits;
            const char *fields[5];
        } lines[] = {{"code  ", 9, {"code", "depth"}},
                     {"linear01  ", 9, {"linear01"}},
                     {"may be  ", 5, {"lo", "hi", "interval"}},
                     {"truth  ", 6, {"truth", "error"}},
                     {"position  ", 9, {"position.x", "position.y", "position.z"}},
                     {"distance  ", 6, {"distance", "position_error"}},
                     {"normal  ", 6, {"normal.x", "normal.y", "normal.z"}},
                     {"off by", 6, {"normal_error"}}};
        char title[32];
        snprintf(title, sizeof title, "pixel %u,%u:", c->at[i][0], c->at[i][1]);
        char *section = strstr(p.out, title);
        assert_non_null(section);
        char *end = strstr(section, "\n\n");
        section = strndup(section, end != NULL ? (size_t)(end - section) + 1 : strlen(section));
        for (size_t k = 0; k < sizeof lines / sizeof lines[0]; k++) {
            char paths[5][PATH_SIZE];
            const char *all[6] = {NULL};
            for (size_t n = 0; n < 5 && lines[k].fields[n] != NULL; n++) {
                snprintf(paths[n], PATH_SIZE, "pixels[%zu].%s", i, lines[k].fields[n]);
                all[n] = paths[n];
            }
            const wanted *first = value_find(v, paths[0]);
            const bool sky =
                strcmp(value_at(v, (snprintf(title, sizeof title, "pixels[%zu].state", i), title))->text, "depth") != 0;
            if (first != NULL && !isnan(first->number) && !(k >= 4 && sky))
                check_text_numbers(v, section, lines[k].label, lines[k].digits, all);
        }
        free(section);
    }
    printed_free(&p);
}

/* The scene or image of a case, and the words that ask for it, up to its pixels. */
static size_t prepare(const pixel_case *c, frame *f, image *shot, double *parameters, char arguments[2048]) {
    static const grain floats = {.kind = GRAIN_FLOATS, .buffer = true, .bits = 24, .least = 0x1p-149};
    const char *const path = scratch_file("pixel.npy");
    char options[512];
    size_t used;
    if (c->synthetic != NULL) {
        f->synthetic = synthetic_find(c->synthetic);
        parameter_defaults(f->synthetic->parameters, parameters);
        f->parameters = parameters;
        used = (size_t)snprintf(arguments, 2048, "texture --synthetic %s --size %dx%d", c->synthetic, WIDTH, HEIGHT);
    } else {
        write_image(path, shot);
        f->image = shot;
        f->grain = &floats;
        used = (size_t)snprintf(arguments, 2048, "texture %s", path);
    }
    return used + (size_t)snprintf(arguments + used, 2048 - used, " %s %s --pixel '",
                                   c->direction_from == NULL ? camera_options(&c->camera, options) : "", c->options);
}

static void want_all(values *v, const pixel_case *c, const frame *f, char *arguments, size_t used, line_places *lines) {
    const bool given = c->direction_from == NULL;
    want_text(v, "file", c->synthetic != NULL ? NULL : scratch_file("pixel.npy"));
    want_text(v, "synthetic", c->synthetic);
    want_setup(v, &f->camera->setup);
    want_text(v, "format_from", "given");
    want_text(v, "mapping_from", given ? "given" : "assumed");
    want_text(v, "direction_from", given ? "given" : c->direction_from);
    for (size_t k = 0; k < PIXELS; k++) {
        want_pixel(v, c, f, k);
        used += (size_t)snprintf(arguments + used, 2048 - used, "%s%u,%u", k > 0 ? ";" : "", c->at[k][0], c->at[k][1]);
        place_add(lines, "", "pixels[%zu].", k);
        lines->items[k].outer[0] = '\0'; /* the set-up stands at the top */
    }
    snprintf(arguments + used, 2048 - used, "'");
}

static void check_columns(const values *v, const pixel_case *c, const char *arguments, const line_places *lines) {
    static const csv_column columns[] = {SETUP_COLUMNS,
                                         {"column", "column"},
                                         {"row", "row"},
                                         {"state", "state"},
                                         {"code", "code"},
                                         {"depth", "depth"},
                                         {"z [scene]", "z"},
                                         {"lo [scene]", "lo"},
                                         {"hi [scene]", "hi"},
                                         {"interval [scene]", "interval"},
                                         {"linear01", "linear01"},
                                         {"truth [scene]", "truth"},
                                         {"error [scene]", "error"},
                                         {"left [scene]", "left"},
                                         {"right [scene]", "right"},
                                         {"above [scene]", "above"},
                                         {"below [scene]", "below"},
                                         {"position_x [scene]", "position.x"},
                                         {"position_y [scene]", "position.y"},
                                         {"position_z [scene]", "position.z"},
                                         {"position_error [scene]", "position_error"},
                                         {"distance [scene]", "distance"},
                                         {"normal_x", "normal.x"},
                                         {"normal_y", "normal.y"},
                                         {"normal_z", "normal.z"},
                                         {"normal_error [degrees]", "normal_error"}};
    csv_column present[sizeof columns / sizeof columns[0]];
    size_t count = 0;
    for (size_t k = 0; k < sizeof columns / sizeof columns[0]; k++) {
        const bool truth = k == 17 || k == 18, place = k >= 23;
        if ((!truth || c->synthetic != NULL) && (!place || c->direction_from == NULL))
            present[count++] = columns[k];
    }
    check_csv(v, 0, arguments, present, count, lines);
}

static void test_pixels(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const pixel_case *c = &cases[i];
        texture_camera camera;
        image shot = {0};
        double parameters[PARAMETERS_MAX];
        frame f = {.camera = &camera, .sky = c->sky};
        char arguments[2048];
        line_places lines = {0};
        values v = values_of("texture");
        camera = view_placed(&c->camera, WIDTH, HEIGHT, c->fov, c->half_height, c->yaw, c->pitch, c->origin);
        const size_t used = prepare(c, &f, &shot, parameters, arguments);
        want_all(&v, c, &f, arguments, used, &lines);
        check_json(&v, 0, arguments);
        check_columns(&v, c, arguments, &lines);
        check_text(&v, arguments, c);
        values_free(&v);
        places_free(&lines);
        free(shot.data);
    }
}

/* Outlines have a bound by normals of any method; the normal has none where pixels have planes of their own. */
static void test_bounds(void **state) {
    (void)state;
    char path[512], matrix[512];
    image shot;
    snprintf(path, sizeof path, "%s", scratch_file("slope.npy"));
    snprintf(matrix, sizeof matrix, "%s", scratch_file("oblique.txt"));
    write_image(path, &shot);
    FILE *file = fopen(matrix, "w");
    assert_non_null(file);
    fputs("1 0 0 0  0 1 0 0  0.1 0 -0.0001 0.1  0 0 -1 0\n", file);
    assert_int_equal(fclose(file), 0);
    printed p = print_of("texture %s -F fp32 -m reversed -q --product effect:outline:low "
                         "--pixel 6,5",
                         path);
    assert_non_null(strstr(p.out, " levels\n"));
    printed_free(&p);
    p = print_of("texture %s -F fp32 -m reversed -q --matrix %s --pixel 6,5", path, matrix);
    assert_non_null(strstr(p.out, " in view space\n"));
    assert_null(strstr(p.out, " degrees"));
    printed_free(&p);
    free(shot.data);
}

/* Orthographic rays start in a plane. */
static void test_distance(void **state) {
    static const char *const rows[][2] = {
        {"", "distance      12.2899012 from the camera, off by "},
        {"--ortho -n 0", "distance      9.99999046 from the camera's plane, off by "}};
    (void)state;
    for (int i = 0; i < 2; i++) {
        /* 10 sqrt(1 + 2 (7/8 tan 30)^2) = 12.289901, and a code that is off by 1.57e-7 */
        printed p = print_of("texture --synthetic plane --size 8x8 -F fp32 -m reversed %s --pixel 0,0", rows[i][0]);
        if (strstr(p.out, rows[i][1]) == NULL)
            fail_msg("not said: %s\n%s", rows[i][1], p.out);
        printed_free(&p);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_pixels), cmocka_unit_test(test_bounds),
                                       cmocka_unit_test(test_distance), cmocka_unit_test(check_apart)};
    return run_tap(tests);
}
