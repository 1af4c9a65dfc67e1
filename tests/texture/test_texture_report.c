/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Numbers and names of the statistics of scenes, and of figures, against plain formulas: what the sky hides, the gap of
 * two depths in CSV, what an error map is called.
 */
#include <jansson.h>

#include "support.h"
#include "truth.h"

static void run(const char *words) {
    static char copy[512];
    command c = {.count = 0};
    snprintf(copy, sizeof copy, "%s", words);
    for (char *at = strtok(copy, " "); at != NULL; at = strtok(NULL, " "))
        truth_add(&c, at);
    assert_int_equal(truth_run(c.arguments, c.count), 0);
}

static const double HALF = 0.57735026918962576451; /* tan 30 degrees */

/* A ray meets the sphere where the line through the camera comes within its radius. */
static bool meets(int column, int row, double distance, double radius) {
    const double x = (2.0 * column + 1 - WIDTH) / HEIGHT * HALF, y = (HEIGHT - 2.0 * row - 1) / HEIGHT * HALF;
    const double sine2 = (x * x + y * y) / (x * x + y * y + 1);
    return distance * distance * sine2 < radius * radius;
}

/* Every pixel of a sphere wholly beyond where the sky begins is hidden, and only these: what is no sphere is sky. */
TEST(what_the_sky_hides_is_counted) {
    char words[256];
    long long hidden = 0;
    for (int i = 0; i < PIXELS; i++)
        hidden += meets(i % WIDTH, i / WIDTH, 900, 300);
    assert_true(hidden > 4 && hidden < PIXELS / 2);
    snprintf(words, sizeof words,
             "--synthetic sphere --parameter distance=900 --parameter radius=300 --size %dx%d -F unorm24 -m d3d --json "
             "-o %s",
             WIDTH, HEIGHT, truth_path("said.json"));
    run(words);
    json_t *root = json_load_file(truth_path("said.json"), JSON_REJECT_DUPLICATES, NULL);
    assert_non_null(root);
    const json_t *sky = json_object_get(root, "sky");
    assert_int_equal(json_integer_value(json_object_get(sky, "hidden")), hidden);
    assert_int_equal(json_integer_value(json_object_get(sky, "pixels")), PIXELS);
    json_decref(root);
}

/* The depth that unorm16 d3d with near 0.1 and far 1000 gives back. */
static double stored16(double z) {
    const double code = floor(65535 * 1000 * (z - 0.1) / (z * 999.9) + 0.5), d = code / 65535;
    return 1 / ((1 - d) / 0.1 + d / 1000);
}

/* Two stairs in one band: the gap is that of what the codes give back, at the nearer of them. */
TEST(gaps_are_those_of_two_depths) {
    char words[256], line[512];
    snprintf(
        words, sizeof words,
        "--synthetic steps --parameter from=21 --parameter to=34 --parameter count=2 --size %dx%d -F unorm16 -m d3d "
        "--csv -o %s",
        WIDTH, HEIGHT, truth_path("said.csv"));
    run(words);
    FILE *csv = fopen(truth_path("said.csv"), "r");
    double n[9] = {0};
    assert_non_null(csv);
    assert_non_null(fgets(line, sizeof line, csv));
    assert_non_null(
        strstr(line, "from [scene],to [scene],pixels,codes,available,gap [scene],gap_z [scene],steps,interval"));
    assert_non_null(fgets(line, sizeof line, csv));
    assert_int_equal(sscanf(line,
                            "%*[^,],%*[^,],%*[^,],%*[^,],%*[^,],%*[^,],%*[^,],%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf",
                            &n[0], &n[1], &n[2], &n[3], &n[4], &n[5], &n[6], &n[7], &n[8]),
                     9);
    assert_true(fgets(line, sizeof line, csv) == NULL);
    fclose(csv);
    const double z = stored16(21), gap = stored16(34) - z, window = 65535 * 1000 / 999.9;
    assert_true(n[0] == 20 && n[1] == 50 && n[2] == PIXELS && n[3] == 2);
    assert_relative(n[5], gap, 1e-9);
    assert_relative(n[6], z, 1e-12);
    /* 1/z falls by the same with each code. */
    assert_relative(n[7], (0.1 / z - 0.1 / (z + gap)) * window, 1e-9);
    const double step = 1 / (0.1 * window), w = 1 / z;
    assert_relative(n[8], 1 / (w - step / 2) - 1 / (w + step / 2), 1e-9);
}

static bool holds(const char *name, const char *words) {
    static char text[1 << 20];
    FILE *file = fopen(truth_path(name), "rb");
    assert_non_null(file);
    text[fread(text, 1, sizeof text - 1, file)] = '\0';
    fclose(file);
    return strstr(text, words) != NULL;
}

/* A scene knows its errors, an image has bounds; pixels without a value are counted. */
TEST(error_maps_are_called_what_they_are) {
    char words[256];
    snprintf(words, sizeof words,
             "--synthetic sphere --size %dx%d -F unorm24 -m d3d --product normal:projective --error-map "
             "--figure %s",
             WIDTH, HEIGHT, truth_path("synthetic.svg"));
    run(words);
    assert_true(holds("synthetic.svg", "Error of normals, method projective"));
    assert_false(holds("synthetic.svg", "bound of the error"));
    snprintf(words, sizeof words, "--synthetic sphere --size %dx%d -F unorm24 -m d3d -o %s", WIDTH, HEIGHT,
             truth_path("in.npy"));
    run(words);
    snprintf(words, sizeof words, "%s -F unorm24 -m d3d --product normal:projective --error-map --figure %s",
             truth_path("in.npy"), truth_path("image.svg"));
    run(words);
    assert_true(holds("image.svg", "Bound of the error on planes of normals, method projective"));
    snprintf(words, sizeof words, "%s -F unorm24 -m d3d --figure %s", truth_path("in.npy"), truth_path("image.svg"));
    run(words);
    long long missing = 0;
    for (int i = 0; i < PIXELS; i++)
        missing += !meets(i % WIDTH, i / WIDTH, 10, 3);
    snprintf(words, sizeof words, "hatched: no value, %lld pixels", missing);
    assert_true(holds("image.svg", words));
}

int main(void) {
    return run_listed(truth_folder, truth_folder_end);
}
