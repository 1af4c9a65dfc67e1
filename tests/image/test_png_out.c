/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The numbers in a PNG mean something: by convention, by the JSON beside it, and by what the file says of itself. */
#include <unistd.h>

#include "image/image.h"
#include "printed.h"

/* A sphere that stands before the sky, turned away from the axes. */
#define SCENE                                                                                                          \
    "texture --synthetic sphere --size 48x30 -n 0.5 -f 90 -F fp32 -m d3d --fov 50 "                                    \
    "--look 710.09566913054,-267.39748443426,5052.5932241276"

/* Reads both files; as many samples as there are. */
static size_t pair_of(const char *png, const char *npy, image *codes, image *numbers) {
    image_error error;
    assert_true(image_read(scratch_file(png), codes, &error));
    assert_true(image_read(scratch_file(npy), numbers, &error));
    assert_int_equal(codes->type, IMAGE_U16);
    assert_int_equal(codes->file, IMAGE_PNG);
    assert_int_equal(numbers->type, IMAGE_F32);
    assert_int_equal(codes->channels, numbers->channels);
    return (size_t)codes->width * codes->height * codes->channels;
}

static printed made(const char *options, const char *file, const char *more) {
    char path[256];
    snprintf(path, sizeof path, "%s", scratch_file(file)); /* which is static */
    printed p = print_of("%s %s -o %s %s", SCENE, options, path, more);
    if (p.status != 0)
        fail_msg("%s: %s", options, p.errors);
    return p;
}

static void make(const char *options, const char *file, const char *more) {
    printed p = made(options, file, more);
    printed_free(&p);
}

/* Normals of engines: 0.5 n + 0.5, y up or down, z towards the camera; the numbers look along the view axis. */
TEST(normals) {
    static const char *const formats[] = {"", "--normal-format opengl", "--normal-format directx"};
    make("--product normal:high", "n.npy", "");
    for (int f = 0; f < 3; f++) {
        image codes, numbers;
        tally t = {.name = formats[f]};
        uint64_t none = 0, blue = 0;
        make("--product normal:high", "n.png", formats[f]);
        const size_t count = pair_of("n.png", "n.npy", &codes, &numbers);
        for (size_t i = 0; i < count; i++) {
            const double n = (double)((const float *)numbers.data)[i];
            const double sign = i % 3 == 2 || (i % 3 == 1 && f == 2) ? -1 : 1;
            const uint16_t code = ((const uint16_t *)codes.data)[i];
            none += isnan(n) ? 1 : 0;
            TALLY(&t, isnan(n) ? code == 0 : fabs(code / 65535.0 - (0.5 * sign * n + 0.5)) <= 0.5000001 / 65535,
                  "sample %zu: %u of %.9g", i, code, n);
            blue += i % 3 == 2 && !isnan(n) && code > 32768;
        }
        assert_true(none > 0 && 3 * blue == count - none); /* all face the camera, and are blue */
        assert_string_equal(strstr(codes.note, " y="), f == 2 ? " y=down" : " y=up");
        tally_end(&t);
        image_free(&codes);
        image_free(&numbers);
    }
}

/* A sample of any product means offset + scale x sample; the JSON has both, and the file itself. */
TEST(meanings) {
    static const struct {
        const char *options, *product, *unit, *says;
        bool up; /* an error, which is rounded up */
    } rows[] = {
        {"--product eye", "eye depth", "scene units", "product=depth", false},
        {"--product radial", "distance from the camera", "scene units", "product=distances", false},
        {"--product eye --error-map", "eye depth, error", "scene units", "product=eye-depths,-the-error", true},
        {"--product linear01", "eye depth over far", NULL, "product=eye-depths-over-far", false},
        {"--product raw", "window depth", NULL, "product=window-depths", false},
        {"--product raw --error-map", "window depth, error", NULL, "product=window-depths,-the-error", true},
        {"--product position:rays", "positions by rays", "scene units", "product=positions", false},
        {"--product normal:high", "normals by high", NULL, "product=normals", false},
        {"--product normal:high --error-map", "normals by high, error", "degrees", "product=normals,-the-error", true},
        {"--product effect:fog --parameter density=3", "fog", NULL, "product=an-effect", false},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        image codes, numbers;
        tally t = {.name = rows[i].options};
        make(rows[i].options, "p.npy", "");
        printed p = made(rows[i].options, "p.png", "--json");
        json_t *root = json_of(p.out);
        const double offset = json_number_value(json_object_get(root, "offset"));
        const double scale = json_number_value(json_object_get(root, "scale"));
        const size_t count = pair_of("p.png", "p.npy", &codes, &numbers);
        assert_string_equal(json_string_value(json_object_get(root, "file")), scratch_file("p.png"));
        assert_string_equal(json_string_value(json_object_get(root, "product")), rows[i].product);
        assert_string_equal(json_string_value(json_object_get(root, "type")), "u2");
        assert_int_equal(json_integer_value(json_object_get(root, "channels")), codes.channels);
        if (rows[i].unit != NULL)
            assert_string_equal(json_string_value(json_object_get(root, "unit")), rows[i].unit);
        else
            assert_true(json_is_null(json_object_get(root, "unit")));
        assert_int_equal(strncmp(codes.note, rows[i].says, strlen(rows[i].says)), 0);
        const char *said = strstr(codes.note, "scale=");
        if (said != NULL) {
            assert_true(strtod(said + 6, NULL) == scale);
            assert_true(strtod(strstr(codes.note, "offset=") + 7, NULL) == offset);
        } else {
            assert_true(strtod(strstr(codes.note, "metric=") + 7, NULL) == scale && offset == 0);
        }
        for (size_t k = 0; k < count; k++) {
            const double want = (double)((const float *)numbers.data)[k];
            const double flip =
                strncmp(rows[i].options, "--product normal", 16) == 0 && !rows[i].up && k % 3 == 2 ? -1 : 1;
            const uint16_t code = ((const uint16_t *)codes.data)[k];
            const double got = flip * (offset + scale * code), slack = 0.5 * scale * (1 + 1e-6) + 1e-12;
            if (isnan(want))
                TALLY(&t, code == 0, "sample %zu of none: %u", k, code);
            else if (rows[i].up)
                TALLY(&t, got >= want * (1 - 1e-12), "sample %zu: %.9g of %.9g", k, got, want);
            else
                TALLY(&t, fabs(got - want) <= slack, "sample %zu: %.9g of %.9g", k, got, want);
        }
        tally_end(&t);
        image_free(&codes);
        image_free(&numbers);
        json_decref(root);
        printed_free(&p);
    }
}

/* Normals that a texture holds are written as those that are made of depth. */
TEST(packed_normals) {
    static const char *const formats[] = {"", "--normal-format directx"};
    make("--product pack:depth-normals -q", "held.png", "");
    for (int f = 0; f < 2; f++) {
        image codes, numbers;
        char held[256], path[256];
        uint64_t none = 0;
        tally t = {.name = "normals that are held"};
        snprintf(held, sizeof held, "%s", scratch_file("held.png"));
        for (int png = 0; png < 2; png++) {
            snprintf(path, sizeof path, "%s", scratch_file(png ? "n.png" : "n.npy"));
            printed p = print_of("texture %s -n 0.5 -f 90 --packing depth-normals --product packed-normal -o %s %s",
                                 held, path, png ? formats[f] : "");
            assert_true(p.status == 0 && (!png || strstr(p.errors, f == 0 ? "x right, y up" : "x right, y down")));
            printed_free(&p);
        }
        const size_t count = pair_of("n.png", "n.npy", &codes, &numbers);
        for (size_t i = 0; i < count; i++) {
            const double n = (double)((const float *)numbers.data)[i];
            const double sign = i % 3 == 2 || (i % 3 == 1 && f == 1) ? -1 : 1;
            const uint16_t code = ((const uint16_t *)codes.data)[i];
            none += isnan(n) ? 1 : 0;
            TALLY(&t, isnan(n) ? code == 0 : fabs(code / 65535.0 - (0.5 * sign * n + 0.5)) <= 0.5000001 / 65535,
                  "sample %zu: %u of %.9g", i, code, n);
        }
        assert_true(none > 0 && none < count);
        assert_int_equal(strncmp(codes.note, "product=normals offset=-1 ", 26), 0);
        assert_string_equal(strstr(codes.note, " y="), f == 1 ? " y=down" : " y=up");
        tally_end(&t);
        image_free(&codes);
        image_free(&numbers);
    }
}

/* An effect is from 0 to 1 whatever there is of it, a vector from -1 to 1, or as is asked; beyond that it is clipped.
 */
TEST(effects_are_not_stretched) {
    static const struct {
        const char *options;
        double lo, hi;
    } rows[] = {
        {"--product effect:fog --parameter density=0.1", 0, 1},
        {"--product effect:fog --parameter density=40 --range 0.2:3", 0.2, 3},
        {"--product effect:force-field --parameter reference=4 --parameter power=2", 0, 1},
        {"--product effect:motion-vector --last-eye 1,0,0", -1, 1},
        {"--product effect:motion-vector --last-eye 1,0,0 --range -0.01:0.02", -0.01, 0.02},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const double lo = rows[i].lo, hi = rows[i].hi;
        char plain[256];
        image codes, numbers;
        tally t = {.name = rows[i].options};
        snprintf(plain, sizeof plain, "%.*s", (int)(strstr(rows[i].options, " --range") - rows[i].options),
                 rows[i].options);
        make(strstr(rows[i].options, " --range") != NULL ? plain : rows[i].options, "p.npy", "");
        make(rows[i].options, "p.png", "");
        const size_t count = pair_of("p.png", "p.npy", &codes, &numbers);
        for (size_t k = 0; k < count; k++) {
            const double value = (double)((const float *)numbers.data)[k];
            const double share = fmin(fmax((value - lo) / (hi - lo), 0), 1);
            const uint16_t code = ((const uint16_t *)codes.data)[k];
            TALLY(&t, isnan(value) ? code == 0 : fabs(share * 65534 - (code - 1.0)) <= 0.5000001,
                  "sample %zu: %u of %.9g", k, code, value);
        }
        tally_end(&t);
        image_free(&codes);
        image_free(&numbers);
    }
}

/* A file of numbers has no scale. */
TEST(numbers_as_they_are) {
    printed p = made("--product position:exact", "p.npy", "--json");
    json_t *root = json_of(p.out);
    assert_string_equal(json_string_value(json_object_get(root, "type")), "f4");
    assert_true(json_number_value(json_object_get(root, "offset")) == 0);
    assert_true(json_number_value(json_object_get(root, "scale")) == 1);
    assert_true(json_is_null(json_object_get(root, "axes")));
    json_decref(root);
    printed_free(&p);
}

/* Beside the product's meaning stands that of its error map. */
TEST(maps_beside) {
    for (int normals = 0; normals < 2; normals++) {
        char map[256];
        image codes;
        image_error error;
        snprintf(map, sizeof map, "%s", scratch_file("map.png"));
        printed p = print_of("%s %s --error-map=%s -o %s --json", SCENE,
                             normals ? "--product normal:high" : "--product eye", map, scratch_file("p.png"));
        assert_int_equal(p.status, 0);
        assert_string_equal(p.errors, "");
        json_t *root = json_of(p.out);
        const json_t *beside = json_object_get(root, "error_map");
        assert_string_equal(json_string_value(json_object_get(root, "product")),
                            normals ? "normals by high" : "eye depth");
        assert_string_equal(json_string_value(json_object_get(beside, "file")), map);
        assert_string_equal(json_string_value(json_object_get(beside, "product")),
                            normals ? "normals by high, error" : "eye depth, error");
        assert_string_equal(json_string_value(json_object_get(beside, "unit")), normals ? "degrees" : "scene units");
        assert_string_equal(json_string_value(json_object_get(beside, "type")), "u2");
        assert_int_equal(json_integer_value(json_object_get(beside, "channels")), 1);
        assert_true(image_read(map, &codes, &error));
        assert_true(strtod(strstr(codes.note, "scale=") + 6, NULL) ==
                    json_number_value(json_object_get(beside, "scale")));
        assert_true(strtod(strstr(codes.note, "offset=") + 7, NULL) ==
                    json_number_value(json_object_get(beside, "offset")));
        image_free(&codes);
        json_decref(root);
        printed_free(&p);
    }
    printed p = made("--product eye", "p.png", "--json");
    json_t *root = json_of(p.out);
    assert_true(json_is_null(json_object_get(root, "error_map")));
    json_decref(root);
    printed_free(&p);
}

/* Eye depths come back without an option, as depths of the same planes, and to the same file. */
TEST(eye_depths_come_back) {
    image codes, numbers;
    tally t = {.name = "eye depths"};
    const char *first = scratch_file("e.png");
    const char *again = scratch_file("again.png");
    const char *back = scratch_file("back.npy");
    make("--product eye", "e.png", "");
    make("--product eye", "e.npy", "");
    printed p = print_of("texture %s --product eye -o %s", first, back);
    if (p.status != 0)
        fail_msg("%s", p.errors);
    printed_free(&p);
    p = print_of("texture %s --product eye -o %s", first, again);
    assert_int_equal(p.status, 0);
    printed_free(&p);
    p = print_of("texture %s -q --product eye --error-map -o %s", first, scratch_file("map.npy"));
    assert_int_equal(p.status, 0);
    printed_free(&p);
    image map, depths;
    image_error error;
    const size_t count = pair_of("e.png", "e.npy", &codes, &numbers);
    assert_true(image_read(back, &depths, &error));
    assert_true(image_read(scratch_file("map.npy"), &map, &error));
    for (size_t i = 0; i < count; i++) {
        const float z = ((const float *)numbers.data)[i], got = ((const float *)depths.data)[i];
        const float most = ((const float *)map.data)[i];
        TALLY(&t, isnan(z) ? isnan(got) && isnan(most) : fabsf(got - z) <= most && most < 1e-3F * z,
              "pixel %zu: %.9g of %.9g", i, (double)got, (double)z);
    }
    tally_end(&t);
    image other;
    assert_true(image_read(again, &other, &error));
    assert_memory_equal(other.data, codes.data, count * 2);
    assert_string_equal(other.note, codes.note);
    image *const all[] = {&codes, &numbers, &map, &depths, &other};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        image_free(all[i]);
}

/* A picture that is no depth says so, unless somebody insists. */
TEST(no_depths) {
    static const char *const products[][2] = {{"--product position:exact", "positions"},
                                              {"--product normal:low", "normals"},
                                              {"--product radial", "distances"},
                                              {"--product effect:fog", "an-effect"}};
    for (size_t i = 0; i < sizeof products / sizeof products[0]; i++) {
        char want[128];
        make(products[i][0], "x.png", "-q");
        printed p = print_of("texture %s", scratch_file("x.png"));
        snprintf(want, sizeof want,
                 "holds %s, as depthprec wrote them, and no depth; --format NAME%s reads it all the same",
                 products[i][1], i < 2 ? " with --channel R" : "");
        assert_int_equal(p.status, 2);
        assert_non_null(strstr(p.errors, want));
        printed_free(&p);
        p = print_of("texture %s -F unorm16 -m d3d%s", scratch_file("x.png"), i < 2 ? " --channel R" : "");
        assert_int_equal(p.status, 0);
        printed_free(&p);
    }
    check_says(2, "--normal-format: needs --product normal or packed-normal",
               "%s --product eye -o %s --normal-format directx", SCENE, scratch_file("x.png"));
    check_says(2, "--normal-format: is for the normals in a PNG",
               "%s --product normal:low -o %s --normal-format directx", SCENE, scratch_file("x.npy"));
}

/* Depths that were written are read back, to the code; a kind of file that cannot hold a format is refused, and then
 * nothing is written. */
TEST(what_is_written_comes_back) {
    static const int widths[] = {1, 7, 8, 9, 15, 16, 17, 23, 24, 25, 30, 31};
    static const char *const files[] = {"depth.png", "depth.npy", "depth.pfm"};
    tally t = {.name = "written and read"};
    for (size_t i = 0; i < sizeof widths / sizeof widths[0]; i++)
        for (int kind = 0; kind < 6; kind++) { /* a unorm or a float, in each file */
            const char *scene = "--synthetic sphere --parameter wall=20 --size 9x7 -m d3d";
            const char *path = scratch_file(files[kind / 2]);
            const int bits = widths[i], file = kind / 2;
            const bool unorm = kind % 2 == 0;
            const bool held = file == 1 || (file == 0 ? unorm && (bits == 8 || bits == 16) : !unorm || bits <= 24);
            char format[32];
            if (unorm)
                snprintf(format, sizeof format, "unorm%d", bits);
            else
                snprintf(format, sizeof format, "float%d.%d", 2 + bits % 7, 1 + bits % 23);
            remove(path);
            printed p = print_of("texture %s -F %s -q -o %s", scene, format, path);
            TALLY(&t, p.status == (held ? 0 : 2) && (access(path, F_OK) == 0) == held, "%s in %s: %s", format, path,
                  p.errors);
            for (int k = 0; k < 2 && held && p.status == 0; k++) {
                json_t *made =
                    json_printed(0, "texture %s -F %s --pixel %d,%d --json", scene, format, 7 * k, 2 * k + 1);
                json_t *read =
                    json_printed(0, "texture %s -m d3d -F %s --pixel %d,%d --json", path, format, 7 * k, 2 * k + 1);
                TALLY(&t, number_at(made, "pixels[0].code") == number_at(read, "pixels[0].code"), "%s in %s, %d",
                      format, path, k);
                json_decref(made);
                json_decref(read);
            }
            printed_free(&p);
        }
    tally_end(&t);
}
