/* SPDX-License-Identifier: GPL-3.0-or-later */
/* texture --histogram, as drawn, against the eye depths that the program writes and the codes of the format. */
#include <jansson.h>

#include "drawn.h"
#include "image/image.h"
#include "support.h"

enum { BINS = 96 };

static const struct {
    const char *arguments, *subtitle; /* subtitle: how it ends */
    long double n, f;
    int bits; /* of UNORM d3d or reversed; 0: no line of codes is checked */
    bool reversed, log;
} cases[] = {
    {"--synthetic decals -F unorm16 -m d3d --size 160x90", "nearest, exact", 0.1L, 1000, 16, false, true},
    {"--synthetic plane --parameter turn=40 --parameter tilt=60 -F unorm24 -m reversed -n 0.5 -f 400 --size 150x80 "
     "--theme "
     "dark",
     " pixels of sky or holes are left out", 0.5L, 400, 24, true, true},
    {"--synthetic sphere -F unorm16 -m d3d --size 200x120", " pixels of sky or holes are left out", 0.1L, 1000, 16,
     false, false},
    {"--synthetic plane --parameter tilt=80 --parameter distance=50 -F unorm16 -m d3d --size 160x90",
     " pixels of sky or holes are left out", 0.1L, 1000, 16, false, false}, /* fewer codes than bins far away */
    {"--synthetic steps --parameter count=3 -F fp32 -m reversed -f inf --size 96x8", "nearest, exact", 0.1L, INFINITY,
     0, true, true},
};

static image depths_of(const char *arguments) {
    char path[320], plain[256];
    image out;
    image_error error;
    snprintf(plain, sizeof plain, "%s", arguments);
    char *dark = strstr(plain, " --theme dark");
    if (dark != NULL)
        *dark = '\0';
    snprintf(path, sizeof path, "%s/eye.npy", drawn_folder());
    free(drawn_output("texture %s --product eye -q -o %s", plain, path));
    assert_true(image_read(path, &out, &error));
    return out;
}

static long double edge_of(const double ends[2], bool is_log, int i) {
    const long double lo = (long double)ends[0], hi = (long double)ends[1], t = (long double)i / BINS;
    return is_log ? lo * powl(hi / lo, t) : lo + (hi - lo) * t;
}

static long double depth_of(size_t k, long double code) {
    const long double n = cases[k].n, f = cases[k].f, d = code / (long double)((1UL << cases[k].bits) - 1);
    return n * f / (f - (cases[k].reversed ? 1 - d : d) * (f - n));
}

/* Codes between the edges of each bin; the outermost edges are depths of pixels, in binary32. */
static void count_codes(size_t k, const double ends[2], double counts[BINS]) {
    long double edges[BINS + 1];
    for (int i = 0; i <= BINS; i++) {
        edges[i] = edge_of(ends, cases[k].log, i) * (i == 0 ? 1 - 4e-7L : i == BINS ? 1 + 4e-7L : 1);
        counts[i % BINS] = 0;
    }
    int bin = 0;
    for (unsigned long code = 0; code < 1UL << cases[k].bits; code++) {
        const long double z = depth_of(k, (long double)code);
        while (bin < BINS - 1 && z >= edges[bin + 1])
            bin++;
        while (bin > 0 && z < edges[bin])
            bin--;
        counts[bin] += z >= edges[bin] && z < edges[bin + 1];
    }
}

/* A flat piece of the line at the height of the count; none above the axis where that is 0. */
static void check_step(const drawn_panel *p, const svg_mark *line, double from, double to, double count) {
    const double x0 = drawn_px(&p->x, from), x1 = drawn_px(&p->x, to), third = (x1 - x0) / 3;
    double top, bottom;
    assert_true(drawn_reach(line, x0 + third, x1 - third, &top, &bottom));
    if (count == 0) {
        assert_true(top >= p->frame.y1 - 1);
        return;
    }
    assert_px(top, drawn_px(&p->y, count), 1);
    assert_px(bottom, drawn_px(&p->y, count), 1);
}

/* The numbers beside the figure: a step from one edge to the next for each bin. */
static void check_numbers(size_t k, const double ends[2], const double counts[BINS]) {
    char *text = drawn_output("texture %s -q --json --histogram %s/beside.svg", cases[k].arguments, drawn_folder());
    json_t *root = json_loads(text, JSON_REJECT_DUPLICATES, NULL);
    assert_non_null(root);
    assert_string_equal(json_string_value(json_object_get(root, "figure")), "histogram");
    const json_t *series = json_object_get(json_array_get(json_object_get(root, "panels"), 0), "series");
    const json_t *points = json_object_get(json_array_get(series, 0), "points");
    assert_int_equal(json_array_size(series), 2);
    assert_int_equal(json_array_size(points), 2 * BINS);
    for (int i = 0; i < 2 * BINS; i++) {
        const json_t *point = json_array_get(points, (size_t)i);
        assert_true(json_number_value(json_object_get(point, "count")) == counts[i / 2]);
        assert_relative(json_number_value(json_object_get(point, "z")),
                        (double)edge_of(ends, cases[k].log, (i + 1) / 2), 1e-12);
    }
    json_decref(root);
    free(text);
}

static void check_case(size_t k) {
    const drawn_theme *look = strstr(cases[k].arguments, "dark") != NULL ? &drawn_dark : &drawn_light;
    char end[80] = "";
    double counts[BINS] = {0}, available[BINS], ends[2] = {INFINITY, -INFINITY};
    const image depths = depths_of(cases[k].arguments);
    const float *z = depths.data;
    size_t without = 0;
    drawn *d = drawn_run(look, "texture %s -q --histogram", cases[k].arguments);
    for (size_t i = 0; i < (size_t)depths.width * depths.height; i++) {
        without += isnan(z[i]) ? 1 : 0;
        ends[0] = isnan(z[i]) ? ends[0] : fmin(ends[0], (double)z[i]);
        ends[1] = isnan(z[i]) ? ends[1] : fmax(ends[1], (double)z[i]);
    }
    for (size_t i = 0; i < (size_t)depths.width * depths.height; i++)
        if (!isnan(z[i])) {
            int bin = 0;
            while (bin + 1 < BINS && (long double)z[i] >= edge_of(ends, cases[k].log, bin + 1))
                bin++;
            counts[bin]++;
        }
    if (without > 0)
        snprintf(end, sizeof end, "; %zu", without);
    assert_string_equal(d->title, "Pixels over eye depth");
    const size_t tail = strlen(cases[k].subtitle) + strlen(end);
    assert_true(strlen(d->subtitle) > tail && strncmp(d->subtitle + strlen(d->subtitle) - tail, end, strlen(end)) == 0);
    assert_string_equal(d->subtitle + strlen(d->subtitle) - strlen(cases[k].subtitle), cases[k].subtitle);
    assert_string_equal(d->x_caption->text, "eye depth (scene units)");
    assert_string_equal(d->y_caption->text, "count in each of 96 bins");
    drawn_legend_is(d, 2, (const char *const[]){"pixels", "codes available"});
    const drawn_panel *p = &d->panels[0];
    const svg_mark *pixels = drawn_curve(d, p, &d->entries[0]), *codes = drawn_curve(d, p, &d->entries[1]);
    assert_int_equal(p->x.log, cases[k].log);
    assert_true(p->y.log);
    assert_px(drawn_px(&p->x, ends[0]), p->frame.x0, 1.5);
    assert_px(drawn_px(&p->x, ends[1]), p->frame.x1, 1.5);
    if (cases[k].bits > 0)
        count_codes(k, ends, available);
    for (int i = 0; i < BINS; i++) {
        const long double from = edge_of(ends, cases[k].log, i), to = edge_of(ends, cases[k].log, i + 1);
        check_step(p, pixels, (double)from, (double)to, counts[i]);
        if (cases[k].bits > 0)
            check_step(p, codes, (double)from, (double)to, available[i]);
    }
    check_numbers(k, ends, counts);
    free(depths.data);
    drawn_close(d);
}

TEST(steps_are_counts) {
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++)
        check_case(k);
}

/* Metric depth and packed eye depth hold no codes of a buffer. */
TEST(metric_depth) {
    char path[320];
    snprintf(path, sizeof path, "%s/metres.npy", drawn_folder());
    free(drawn_output("texture --synthetic steps --parameter to=290 --size 96x8 -F fp32 -m reversed --product eye -q "
                      "-o %s",
                      path));
    drawn *d = drawn_run(&drawn_light, "texture %s --metric 1 --unit m --title 'In metres' -q --histogram", path);
    assert_string_equal(d->title, "In metres");
    assert_string_equal(d->subtitle, "metres.npy, 96 x 8; metric depth, 1 m a unit");
    assert_string_equal(d->x_caption->text, "eye depth (m)");
    drawn_legend_is(d, 1, (const char *const[]){"pixels"});
    drawn_close(d);
    snprintf(path, sizeof path, "%s/packed.png", drawn_folder());
    free(drawn_output("texture --synthetic sphere --size 96x8 --product pack:rg -q -o %s", path));
    d = drawn_run(&drawn_light, "texture %s --packing rg -q --histogram", path);
    drawn_legend_is(d, 1, (const char *const[]){"pixels"});
    drawn_close(d);
}

/* The values that the file could hold from one depth up to another: binary32, or whole units. */
static double samples_between(double unit, double from, double to) {
    double count = 0;
    for (int e = -20; e < 20 && unit == 1; e++) { /* numbers from 2^e on are 2^(e - 23) apart */
        const double gap = ldexp(1, e - 23), lo = fmax(from, ldexp(1, e)), hi = fmin(to, ldexp(1, e + 1));
        count += lo < hi ? ceil(hi / gap) - ceil(lo / gap) : 0;
    }
    for (double k = floor(from / unit); k * unit < to && unit < 1; k++)
        count += k * unit >= from;
    return count;
}

/* Thousandths of 1 to 60. */
static void write_whole(const char *path) {
    enum { WIDTH = 96, HEIGHT = 8 };
    uint16_t samples[WIDTH * HEIGHT];
    rng r = rng_make("whole");
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        samples[i] = (uint16_t)rng_log(&r, 1000, 60000);
    FILE *out = fopen(path, "wb");
    assert_non_null(out);
    image_writer *w = image_writer_open(out, IMAGE_NPY, IMAGE_U16, WIDTH, HEIGHT, 1, NULL);
    assert_true(w != NULL && image_writer_rows(w, samples, HEIGHT) && image_writer_close(w) && fclose(out) == 0);
}

/* Where it was rounded before, its levels, on no edge of a bin; and beside them what the file could hold. */
static void check_levels(double unit) {
    char path[320], arguments[400];
    snprintf(path, sizeof path, "%s/metres.npy", drawn_folder());
    if (unit < 1)
        write_whole(path);
    else
        free(drawn_output("texture --synthetic steps --parameter to=290 --size 96x8 -F fp32 -m reversed --product eye "
                          "-q -o %s",
                          path));
    snprintf(arguments, sizeof arguments, "%s --metric %g --lattice inverse:500,0.3", path, unit);
    const image depths = depths_of(arguments);
    const float *z = depths.data;
    double ends[2] = {INFINITY, -INFINITY};
    for (size_t i = 0; i < (size_t)depths.width * depths.height; i++) {
        ends[0] = fmin(ends[0], (double)z[i]);
        ends[1] = fmax(ends[1], (double)z[i]);
    }
    drawn *d = drawn_run(&drawn_light, "texture %s -q --histogram", arguments);
    drawn_legend_is(d, 3, (const char *const[]){"pixels", "levels available", "samples of the file"});
    const drawn_panel *p = &d->panels[0];
    const svg_mark *levels = drawn_curve(d, p, &d->entries[1]), *samples = drawn_curve(d, p, &d->entries[2]);
    for (int i = 0; i < BINS; i++) {
        const double from = (double)edge_of(ends, p->x.log, i), to = (double)edge_of(ends, p->x.log, i + 1);
        double count = 0;
        for (int k = 1; k < 1000; k++)
            count += 500 / (k - 0.3) >= from && 500 / (k - 0.3) < to;
        check_step(p, levels, from, to, count);
        check_step(p, samples, from, to, samples_between(unit, from, to));
    }
    free(depths.data);
    drawn_close(d);
}

/* Along rays distances are shown, as depths would be that are these. */
TEST(distances) {
    static const char *const words[][2] = {{"", "eye depth"}, {"--radial --fov 60", "distance from the camera"}};
    char path[320];
    json_t *roots[2], *points[2];
    snprintf(path, sizeof path, "%s/whole.npy", drawn_folder());
    write_whole(path);
    for (int k = 0; k < 2; k++) {
        char *text = drawn_output("texture %s --metric mm %s -q --json --histogram %s/beside.svg", path, words[k][0],
                                  drawn_folder());
        roots[k] = json_loads(text, JSON_REJECT_DUPLICATES, NULL);
        const json_t *panel = json_array_get(json_object_get(roots[k], "panels"), 0);
        points[k] = json_object_get(json_array_get(json_object_get(panel, "series"), 0), "points");
        assert_string_equal(json_string_value(json_object_get(json_object_get(roots[k], "x"), "label")), words[k][1]);
        assert_int_equal(json_array_size(points[k]), 2 * BINS);
        free(text);
    }
    for (size_t i = 0; i < 2 * BINS; i++) {
        const json_t *depth = json_array_get(points[0], i), *distance = json_array_get(points[1], i);
        assert_true(json_equal(json_object_get(depth, "z"), json_object_get(distance, "distance")) &&
                    json_equal(json_object_get(depth, "count"), json_object_get(distance, "count")));
    }
    json_decref(roots[0]);
    json_decref(roots[1]);
}

TEST(metric_levels) {
    check_levels(1);
    check_levels(0.001);
}
