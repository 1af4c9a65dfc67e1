/* SPDX-License-Identifier: GPL-3.0-or-later */
/* texture --figure --overlay, as drawn: grey where the error map is not above the limit, its colour where it is. */
#include "drawn.h"
#include "drawn_map.h"
#include "image/image.h"
#include "support.h"

enum { FEW = 4096 }; /* below so many fields each is a rectangle */

static const struct {
    const char *arguments, *option; /* option: --overlay's argument */
    double above;                   /* in scene units */
    const char *title, *caption, *grey;
} cases[] = {
    {"--synthetic decals -F unorm16 -m d3d --size 160x90 --product eye", "5cm", 0.05,
     "Eye depth, in colour where eye depth is off by more than 0.05 m", "error of eye depth (m)", ", logarithmic"},
    {"--synthetic sphere -F unorm24 -m d3d --size 60x40 --product radial", "1e-5", 1e-5,
     "Distance from the camera, in colour where it is off by more than 1e-05 scene units",
     "error of the distance (scene units)", ""},
    {"--synthetic plane --parameter turn=40 --parameter tilt=60 -F unorm16 -m d3d --size 150x80 --product raw --theme "
     "dark",
     "0.1", 0.1, "Window depth, in colour where eye depth is off by more than 0.1 scene units",
     "error of eye depth (scene units)", ""},
    {"--synthetic steps -F unorm16 -m reversed --size 80x64 --product linear01", "100", 100,
     "Eye depth over far, in colour where eye depth is off by more than 100 scene units",
     "error of eye depth (scene units)", ", logarithmic"},
};

static image numbers_of(const char *arguments, const char *product) {
    char path[320];
    image out;
    image_error error;
    snprintf(path, sizeof path, "%s/numbers.npy", drawn_folder());
    free(drawn_output("texture %s %s -q -o %s", arguments, product, path));
    assert_true(image_read(path, &out, &error));
    return out;
}

/* From light to dark, over the depths of the picture. */
static void check_grey(const char *what, uint32_t pixel, double v, const double ends[2], bool is_log) {
    const double t = is_log ? log(v / ends[0]) / log(ends[1] / ends[0]) : (v - ends[0]) / (ends[1] - ends[0]);
    const int want = (int)lrint(255 * (0.95 - 0.6 * t));
    for (int shift = 0; shift <= 16; shift += 8)
        if (abs((int)(pixel >> shift & 255) - want) > 2)
            fail_msg("%s: %06x for %.6g, not grey %d", what, pixel, v, want);
}

static void check_overlay(size_t k) {
    char plain[320], subtitle[128];
    const drawn_theme *look = strstr(cases[k].arguments, "dark") != NULL ? &drawn_dark : &drawn_light;
    drawn *d = drawn_run(look, "texture %s --overlay %s", cases[k].arguments, cases[k].option);
    snprintf(plain, sizeof plain, "%s", cases[k].arguments);
    char *dark = strstr(plain, " --theme dark");
    if (dark != NULL)
        *dark = '\0';
    image shown = numbers_of(plain, "");
    char *product = strstr(plain, "--product ");
    const char *eye = strstr(product, "radial") != NULL ? "--product radial" : "--product eye";
    snprintf(product, sizeof plain - (size_t)(product - plain), "%s", eye);
    image error = numbers_of(plain, "--error-map");
    const float *value = shown.data, *off = error.data;
    const int width = (int)shown.width, height = (int)shown.height;
    double ends[2] = {INFINITY, -INFINITY}, most = 0, known = 0, beyond = 0;
    for (int i = 0; i < width * height; i++) {
        ends[0] = fmin(ends[0], isnan(value[i]) ? INFINITY : (double)value[i]);
        ends[1] = fmax(ends[1], isnan(value[i]) ? -INFINITY : (double)value[i]);
        most = fmax(most, isfinite(off[i]) ? (double)off[i] : 0);
        known += isnan(off[i]) ? 0 : 1;
        beyond += (double)off[i] > cases[k].above ? 1 : 0;
    }
    assert_string_equal(d->title, cases[k].title);
    assert_string_equal(d->right_caption->text, cases[k].caption);
    assert_non_null(strstr(d->subtitle, "; grey from "));
    double said[2];
    assert_int_equal(
        sscanf(strstr(d->subtitle, "; grey from "), "; grey from %lf, light, to %lf, dark", &said[0], &said[1]), 2);
    const char *last = strrchr(d->subtitle, ';');
    snprintf(subtitle, sizeof subtitle, "dark%s; ", cases[k].grey);
    assert_non_null(strstr(d->subtitle, subtitle));
    assert_relative(said[0], ends[0], 1e-3);
    assert_relative(said[1], ends[1], 1e-3);
    assert_relative(strtod(last + 1, NULL), 100 * beyond / known, 5.1e-3);
    assert_non_null(strstr(last, " % of the pixels with a depth are in colour"));
    drawn_bar_is_viridis(d);
    assert_px(drawn_px(&d->value, cases[k].above), d->bar->box.y1, 3);
    assert_px(drawn_px(&d->value, fmax(most, 2 * cases[k].above)), d->bar->box.y0, 3);
    const drawn_panel *p = &d->panels[0];
    const svg_box b = width * height < FEW ? p->frame : drawn_map_image(d, p)->box;
    int seen[3] = {0, 0, 0};
    for (int i = 0; i < width * height; i += 7) {
        const svg_point place = {b.x0 + (b.x1 - b.x0) * (i % width + 0.5) / width,
                                 b.y0 + (b.y1 - b.y0) * (i / width + 0.5) / height, false};
        const uint32_t pixel = drawn_map_shown(d, p, place);
        if (isnan(value[i])) {
            assert_int_equal(pixel >> 24, 0);
            seen[0]++;
        } else if ((double)off[i] > cases[k].above) {
            assert_px(drawn_bar_px(d, pixel), fmax(drawn_px(&d->value, (double)off[i]), d->bar->box.y0), 2.5);
            seen[1]++;
        } else {
            check_grey(cases[k].title, pixel, (double)value[i], ends, *cases[k].grey != '\0');
            seen[2]++;
        }
    }
    assert_true(seen[2] > 20 && (k == 3) == (seen[1] == 0) && (k == 1) == (seen[0] > 0));
    image_free(&shown);
    image_free(&error);
    drawn_close(d);
}

TEST(colours_are_errors_above_the_limit) {
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++)
        check_overlay(i);
}

/* For a file it is what the depth can be off by. */
TEST(a_file) {
    char path[320];
    snprintf(path, sizeof path, "%s/depth.npy", drawn_folder());
    free(drawn_output("texture --synthetic steps --size 80x64 -F unorm16 -m d3d -q -o %s", path));
    drawn *d = drawn_run(&drawn_light, "texture %s -F unorm16 -m d3d --overlay 0.5 --unit cm", path);
    assert_string_equal(d->title, "Eye depth, in colour where eye depth can be off by more than 0.5 cm");
    assert_string_equal(d->right_caption->text, "error of eye depth (cm)");
    drawn_close(d);
}

/* Then no depth is grey, and none of no pixels are in colour. */
TEST(nothing_but_sky) {
    drawn *d = drawn_run(&drawn_light, "texture --synthetic plane --parameter distance=2000 --size 8x8 --overlay 1");
    assert_null(strstr(d->subtitle, "grey"));
    assert_null(strstr(d->subtitle, "%"));
    drawn_close(d);
    d = drawn_run(&drawn_light,
                  "texture --synthetic plane --parameter distance=2000 --size 8x8 --product raw --overlay 1");
    assert_non_null(strstr(d->subtitle, "; grey from "));
    assert_null(strstr(d->subtitle, "%"));
    drawn_close(d);
}

/* A colour is then the largest of several, also where no two are side by side. */
TEST(more_pixels_than_points) {
    const char *const sizes[][2] = {
        {"--size 1600x20 --overlay 1", "; a colour is the largest error of 4 pixels"},
        {"--size 1x3200 --overlay 1", "; a colour is the largest error of 4 pixels"},
        {"--size 1x3200 --error-map --product eye", "; a point is the largest of 4 pixels"}};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        char *text = drawn_output("texture --synthetic plane %s -q --figure -", sizes[i][0]);
        if (strstr(text, sizes[i][1]) == NULL)
            fail_msg("%s: not said: %s", sizes[i][0], sizes[i][1]);
        free(text);
    }
}
