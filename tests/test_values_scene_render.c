/* SPDX-License-Identifier: GPL-3.0-or-later */
/* scene --render: the picture as libpng reads it, and what is printed of it. */
#include <jansson.h>
#include <png.h>

#include "printed.h"

#define STREET "tests/models/street.obj"
#define DRAWN  " --separation 0.02 -F unorm16 -m d3d -f 100"

typedef struct picture {
    png_image head;
    unsigned char *rgb;
    size_t red;
} picture;

static picture read_png(const char *path) {
    picture p = {.head = {.version = PNG_IMAGE_VERSION}};
    assert_true(png_image_begin_read_from_file(&p.head, path));
    p.head.format = PNG_FORMAT_RGB;
    p.rgb = malloc(PNG_IMAGE_SIZE(p.head));
    assert_non_null(p.rgb);
    assert_true(png_image_finish_read(&p.head, NULL, p.rgb, 0, NULL));
    for (size_t i = 0; i < (size_t)p.head.width * p.head.height; i++)
        p.red += p.rgb[3 * i] == 255 && p.rgb[3 * i + 1] == 0 && p.rgb[3 * i + 2] == 0;
    return p;
}

static double number(const json_t *object, const char *key) {
    const json_t *value = json_object_get(object, key);
    assert_true(json_is_number(value));
    return json_number_value(value);
}

/* The red pixels are counted, in all and by finding; text says the same. */
TEST(counts) {
    static const struct {
        const char *options, *raster;
        unsigned width, height;
        double fov;
    } rows[] = {{"--viewport 320x200", "llvmpipe", 320, 200, 60},
                {"--viewport 300x200 --raster swiftshader --fov 40", "swiftshader", 300, 200, 40},
                {"--fov 30", "llvmpipe", 1920, 1080, 30}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        char path[512];
        snprintf(path, sizeof path, "%s", scratch_file("street.png"));
        printed p = print_of("scene %s%s %s --render %s --json", STREET, DRAWN, rows[i].options, path);
        json_t *root = json_loads(p.out, 0, NULL);
        char want[64];
        double sum = 0.0;
        assert_int_equal(p.status, 0);
        assert_non_null(root);
        printed_free(&p);
        picture seen = read_png(path);
        const json_t *render = json_object_get(root, "render"), *list = json_object_get(root, "findings");
        assert_int_equal(seen.head.width, rows[i].width);
        assert_int_equal(seen.head.height, rows[i].height);
        assert_true(number(render, "width") == rows[i].width && number(render, "height") == rows[i].height);
        assert_relative(number(render, "fov"), rows[i].fov, 1e-12);
        assert_string_equal(json_string_value(json_object_get(render, "raster")), rows[i].raster);
        assert_string_equal(json_string_value(json_object_get(render, "file")), path);
        assert_true(seen.red > 50 && number(render, "wrong_pixels") == (double)seen.red);
        for (size_t n = 0; n < json_array_size(list); n++)
            sum += number(json_array_get(list, n), "wrong_pixels");
        assert_true(json_array_size(list) == 2 && sum == (double)seen.red); /* nothing else overlaps there */
        assert_true(number(render, "wrong_found") == (double)seen.red);
        p = print_of("scene %s%s %s --render %s", STREET, DRAWN, rows[i].options, path);
        for (size_t n = 0; n < 2; n++) {
            snprintf(want, sizeof want, "      %.0f pixels wrong\n", number(json_array_get(list, n), "wrong_pixels"));
            assert_non_null(strstr(p.out, want));
        }
        snprintf(want, sizeof want, "%zu wrong", seen.red);
        assert_non_null(strstr(p.out, want));
        printed_free(&p);
        free(seen.rgb);
        json_decref(root);
    }
}

TEST(refused) {
    static const struct {
        const char *options;
        int status;
        const char *said;
    } rows[] = {
        {"--render ''", 2, "--render: must be a file name, got ''"},
        {"--render x.jpg", 2, "--render: must end in .png, got 'x.jpg'"},
        {"--render -", 2, "--render: must end in .png, got '-'"},
        {"--render none/x.png", 3, "cannot write 'none/x.png': No such file or directory"},
        {"--render x.png -F fp16", 2, "--format: must be one that llvmpipe has and that can be bounded, got fp16"},
        {"--render x.png -m gl --raster softpipe", 2, "--mapping: must be d3d or reversed with --raster softpipe"},
        {"--render x.png --raster spec-d3d", 2, "--raster: must be one that draws"},
        {"--render x.png --viewport 16384x16384", 2, "--viewport: must be of at most 33554432 pixels with --render"},
        {"--render x.png --slant 0:10", 2, "--slant: needs --viewport"},
        {"--render x.png --path x.txt", 2, "--render: cannot be combined with --path: a picture has one eye"},
        {"--render x.png -o x.png", 2, "--render: must not be the file of --output, got 'x.png'"},
        {"--fov 40", 2, "--fov: needs --viewport"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        printed p = print_of("scene %s %s", STREET, rows[i].options);
        if (p.status != rows[i].status || strstr(p.errors, rows[i].said) == NULL)
            fail_msg("%s: %d: %s", rows[i].options, p.status, p.errors);
        assert_int_equal(strlen(p.out), 0);
        printed_free(&p);
    }
}
