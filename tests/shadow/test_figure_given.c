/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The figures of shadow maps with an engine: what it gives by hand, what is needed as the sum of the causes that the
 * figure without it shows; against the angle and against the distance; what has no place on the axis.
 */
#include "printed.h"

/* A series of the figure by its name, and the number of its points. */
static const json_t *series_of(const json_t *root, const char *name) {
    const json_t *all = node_at(root, "panels[0].series");
    for (size_t i = 0; i < json_array_size(all); i++)
        if (strcmp(text_at(json_array_get(all, i), "name"), name) == 0)
            return json_array_get(all, i);
    return NULL;
}

static double at(const json_t *series, size_t i, const char *key) {
    return number_at(series, "points[%zu].%s", i, key);
}

TEST(against_the_angle) {
    static const char line[] = "plot shadow --light-box 20x20x50 --size 1024";
    static const char *const causes[] = {"texel, kernel, lookup", "snapping, set-up", "position", "format"};
    const double texel = 20.0 / 1024, pi = acos(-1.0);
    json_t *root = json_printed(0, "%s --engine bevy --bias 0.03 --normal-bias 1.5", line);
    json_t *plain = json_printed(0, "%s", line), *three = json_printed(0, "%s --engine three --bias=-0.002", line);
    const json_t *given = series_of(root, "given, bevy"), *needed = series_of(root, "needed");
    const size_t count = json_array_size(json_object_get(given, "points"));
    assert_true(count > 100 && series_of(root, causes[0]) == NULL && series_of(root, "gap, constant") != NULL);
    for (size_t i = 1; i < count; i++) {
        const double angle = at(given, i, "angle") * pi / 180;
        double sum = 0;
        for (size_t k = 0; k < 4; k++)
            sum += at(series_of(plain, causes[k]), i, "length");
        assert_relative(at(given, i, "length"), 0.03 + 1.5 * sqrt(2) * texel / cos(angle), 1e-9);
        assert_relative(at(needed, i, "length"), sum, 1e-9);
        assert_relative(at(series_of(three, "given, three"), i, "length"), 0.002 * 50, 1e-9);
    }
    json_decref(root);
    json_decref(plain);
    json_decref(three);
}

TEST(against_the_distance) {
    const double near = 0.1, far = 30.0, kappa = 1 / near - 1 / far;
    json_t *root = json_printed(0, "plot shadow-distance --spot 70 -n 0.1 -f 30 --size 1024 -F d24 --engine three "
                                   "--bias=-0.001 --normal-bias 0.02 --angle 60");
    const json_t *given = series_of(root, "given, three"), *needed = series_of(root, "needed");
    const size_t count = json_array_size(json_object_get(given, "points"));
    assert_string_equal(text_at(root, "x.key"), "z");
    assert_true(count > 50 && series_of(root, "gap, constant") != NULL);
    assert_relative(at(given, 0, "z"), near, 1e-9);
    assert_relative(at(given, count - 1, "z"), far, 1e-9);
    for (size_t i = 0; i < count; i++) {
        const double z = at(given, i, "z");
        /* a window depth is kappa z^2, and .02 along the normal is twice as much along the ray at 60 degrees */
        assert_relative(at(given, i, "length"), 0.001 * kappa * z * z + 0.04, 1e-9);
        /* the filter's radius is a texel and a half, which is proportional to z */
        assert_true(at(needed, i, "length") > 1.5 * 2 * tan(35 * acos(-1.0) / 180) / 1024 * z * sqrt(3.0));
    }
    json_decref(root);
    check_says(2, "--spot or --point", "plot shadow-distance --csv");
    check_says(2, "--engine", "plot shadow --bias 3 --csv");
}

/* A log axis has no 0 and nothing below: the legend says so, and the data have the curve without a point. */
static void check_hidden(const char *name, const char *line) {
    json_t *root = json_printed(0, "%s", line);
    const json_t *given = series_of(root, name);
    if (given == NULL)
        fail_msg("%s: no curve is named '%s'", line, name);
    for (size_t i = 0; i < json_array_size(json_object_get(given, "points")); i++)
        assert_true(json_is_null(node_at(given, "points[%zu].length", i)));
    json_decref(root);
}

TEST(what_a_log_axis_has_no_place_for) {
    check_hidden("given, three: 0, not drawn", "plot shadow --light-box 20x20x50 --engine three");
    check_hidden("given, three: below 0, not drawn", "plot shadow --light-box 20x20x50 --engine three --bias 0.01");
    check_hidden("given, three: 0, not drawn", "plot shadow-distance --spot 70 -n 0.1 -f 30 --engine three");
    check_hidden("given, three: below 0, not drawn",
                 "plot shadow-distance --spot 70 -n 0.1 -f 30 --engine three --bias 0.01");
}
