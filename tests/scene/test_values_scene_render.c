/* SPDX-License-Identifier: GPL-3.0-or-later */
/* scene --render: the picture as libpng reads it, and what is printed of it. */
#include <jansson.h>
#include <png.h>

#include "printed.h"

#define STREET    "tests/models/street.obj"
#define NEAR_TIES " --separation 0.02 -F unorm24 -m d3d -n 0.1 -f 100"
#define DRAWN     " --separation 0.02 -F unorm16 -m d3d -f 100"

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
        const char *path = scratch_file("street.png");
        json_t *root = json_printed(0, "scene %s%s %s --render %s", STREET, DRAWN, rows[i].options, path);
        const json_t *list = node_at(root, "findings");
        char want[64];
        double sum = 0.0;
        picture seen = read_png(path);
        assert_int_equal(seen.head.width, rows[i].width);
        assert_int_equal(seen.head.height, rows[i].height);
        assert_true(number_at(root, "render.width") == rows[i].width &&
                    number_at(root, "render.height") == rows[i].height);
        assert_relative(number_at(root, "render.fov"), rows[i].fov, 1e-12);
        assert_string_equal(text_at(root, "render.raster"), rows[i].raster);
        assert_string_equal(text_at(root, "render.file"), path);
        assert_true(seen.red > 50 && number_at(root, "render.wrong_pixels") == (double)seen.red);
        for (size_t n = 0; n < json_array_size(list); n++)
            sum += number_at(list, "[%zu].wrong_pixels", n);
        assert_true(json_array_size(list) == 2 && sum == (double)seen.red); /* nothing else overlaps there */
        assert_true(number_at(root, "render.wrong_found") == (double)seen.red);
        printed p = print_of("scene %s%s %s --render %s", STREET, DRAWN, rows[i].options, path);
        for (size_t n = 0; n < 2; n++) {
            snprintf(want, sizeof want, "      %.0f pixels wrong\n", number_at(list, "[%zu].wrong_pixels", n));
            assert_non_null(strstr(p.out, want));
        }
        snprintf(want, sizeof want, "%zu wrong", seen.red);
        assert_non_null(strstr(p.out, want));
        printed_free(&p);
        free(seen.rgb);
        json_decref(root);
    }
}

/* Pixels of a pair are counted whichever of its surfaces comes first in the file, the nearer one or the other: where
 * depths are swapped, not only where they tie, which the first one wins. */
TEST(either_order) {
    static const char *const parts[] = {"o road\nv -8 0 -8\nv 8 0 -8\nv 8 0 8\nv -8 0 8\nf -1 -2 -3 -4\n",
                                        "o paint\nv -1 0.00001 -4\nv 1 0.00001 -4\nv 1 0.00001 4\n"
                                        "v -1 0.00001 4\nf -1 -2 -3 -4\n"};
    for (int first = 0; first < 2; first++) {
        const char *path = scratch_file("order.obj"), *png = scratch_file("order.png");
        FILE *out = fopen(path, "w");
        fprintf(out, "%s%s", parts[first], parts[1 - first]);
        fclose(out);
        json_t *root = json_printed(0, "scene %s%s --viewport 320x200 --render %s", path, NEAR_TIES, png);
        const double found = number_at(root, "render.wrong_found");
        assert_true(found > 50 && number_at(root, "render.wrong_pixels") == found);
        assert_true(number_at(root, "findings[0].wrong_pixels") == found);
        json_decref(root);
    }
}

TEST(refused) {
    static const refused_row rows[] = {
        {"--render ''", "--render: must be a file name, got ''", 2},
        {"--render x.jpg", "--render: must end in .png, got 'x.jpg'", 2},
        {"--render -", "--render: must end in .png, got '-'", 2},
        {"--render none/x.png", "cannot write 'none/x.png': No such file or directory", 3},
        {"--render x.png -F fp16", "--format: must be one that llvmpipe has and that can be bounded, got fp16", 2},
        {"--render x.png -m gl --raster softpipe", "--mapping: must be d3d or reversed with --raster softpipe", 2},
        {"--render x.png --raster spec-d3d", "--raster: must be one that draws", 2},
        {"--render x.png --viewport 16384x16384", "--viewport: must be of at most 33554432 pixels with --render", 2},
        {"--render x.png --slant 0:10", "--slant: needs --viewport", 2},
        {"--render x.png --path x.txt", "--render: conflicts with --path: a picture has one eye", 2},
        {"--render x.png -o x.png", "--render: must not be the file of --output, got 'x.png'", 2},
        {"--fov 40", "--fov: needs --viewport", 2},
    };
    CHECK_REFUSED("scene " STREET, rows);
}

/* A back is drawn where it is judged as well: --also of it, and of nothing else. */
TEST(backs_are_drawn_where_they_are_judged) {
    static const char *const faces[] = {"1 2 3", "1 3 2"}, *const also[] = {"", "--also facing", "--also hidden"};
    size_t drawn[2][3] = {{0}}; /* pixels unlike that in the corner */
    for (int back = 0; back < 2; back++)
        for (int k = 0; k < 3; k++) {
            char path[256], line[1024];
            snprintf(path, sizeof path, "%s",
                     scratch_text("face.obj", "v -1 0 0\nv 1 0 0\nv 0 2 0\nf %s\n", faces[back]));
            const char *seen = scratch_file("face.png");
            snprintf(line, sizeof line,
                     "scene %s %s -F d24 -m d3d --eye 0,1,5 --look 0,1,0 --viewport 64x48 --render %s -q", path,
                     also[k], seen);
            free(output_of(0, line, ""));
            const picture p = read_png(seen);
            for (size_t i = 0; i < (size_t)p.head.width * p.head.height; i++)
                drawn[back][k] += memcmp(p.rgb, p.rgb + 3 * i, 3) != 0;
            free(p.rgb);
        }
    assert_true(drawn[0][0] > 100 && drawn[0][1] == drawn[0][0] && drawn[0][2] == drawn[0][0]);
    assert_true(drawn[1][0] == 0 && drawn[1][1] == drawn[0][0] && drawn[1][2] == 0);
}
