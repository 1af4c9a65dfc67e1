/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A curve of what is guaranteed ends where nothing behind is certain: there it is as high as what is left up to far.
 * Of a UNORM or float whose last codes are u apart the lattice knows where: 1 - d(z) = u, which for d3d is
 * z = n f/(n + (f - n) u). What is computed in binary32 ends before that, by no more than its roundings.
 */
#include <jansson.h>

#include "drawn.h"
#include "printed.h"
#include "support.h"

#define NEAR 0.1
#define FAR  1000.0

typedef struct ending {
    const char *format;
    double last; /* of window depth, from the last but one code to that of far */
    bool seen;   /* a pixel before the axis ends */
} ending;

static const ending endings[] = {
    {"unorm2", 1.0 / 3, true},      {"unorm8", 1.0 / 255, true},        {"fp16", 0x1p-11, true},
    {"unorm16", 1.0 / 65535, true}, {"unorm24", 1.0 / 0xFFFFFF, false}, {"fp32", 0x1p-24, false},
};
enum { ENDINGS = sizeof endings / sizeof endings[0] };

static double end_of(const ending *e) {
    return NEAR * FAR / (NEAR + (FAR - NEAR) * e->last);
}

/* The window depth itself is off by three roundings, as a share of the last step. */
static double slack_of(const ending *e) {
    return 0x1p-22 / e->last + 1e-6;
}

/* ---- Its numbers ------------------------------------------------------------------------------------------------- */

static double number_in(const json_t *object, const char *key) {
    const json_t *v = json_object_get(object, key);
    return json_is_number(v) ? json_number_value(v) : NAN;
}

/* Points of a curve up to its end, and none behind it. @return how many */
static size_t points_end(const json_t *series, const char *key, double end) {
    size_t i, count = 0, before = 0;
    const json_t *point;
    json_array_foreach(json_object_get(series, "points"), i, point) {
        const double z = number_in(point, "z"), value = number_in(point, key);
        if (z > end * 1.01)
            assert_true(isnan(value));
        else if (z < end * 0.99)
            assert_true(value > 0 && value < FAR - z);
        before += z < end * 0.99;
        count++;
    }
    assert_true(before > 10);
    return count - before;
}

/* The series of that name in the first panel of a figure. */
static const json_t *series_of(const json_t *root, const char *name) {
    const json_t *panel = json_array_get(json_object_get(root, "panels"), 0), *series;
    size_t i;
    json_array_foreach(json_object_get(panel, "series"), i, series) {
        if (strcmp(json_string_value(json_object_get(series, "name")), name) == 0)
            return series;
    }
    fail_msg("no series '%s'", name);
    return NULL;
}

static void check_series(const json_t *series, const char *key, const ending *e) {
    const double end = end_of(e), certain_to = number_in(series, "certain_to");
    if (!e->seen) {
        assert_null(json_object_get(series, "certain_to"));
        return;
    }
    if (!(certain_to <= end && certain_to >= end * (1 - slack_of(e))))
        fail_msg("%s: certain to %.9g, by the formula to %.9g", e->format, certain_to, end);
    assert_true(points_end(series, key, end) > 0);
}

TEST(numbers_end_where_nothing_is_certain) {
    static const char *const figures[][3] = {{"interval", "interval", ""},
                                             {"budget", "separation", "separation, right axis"}};
    for (size_t k = 0; k < ENDINGS; k++)
        for (size_t f = 0; f < 2; f++) {
            char name[32];
            char *json =
                drawn_output("plot %s -n %g -f %g -F %s -m d3d --json", figures[f][0], NEAR, FAR, endings[k].format);
            json_t *root = json_of(json);
            snprintf(name, sizeof name, "%s d3d", endings[k].format);
            check_series(series_of(root, f == 0 ? name : figures[f][2]), figures[f][1], &endings[k]);
            json_decref(root);
            free(json);
        }
}

/* The table says the same of the depths on either side. */
TEST(the_table_agrees) {
    for (size_t k = 0; k < ENDINGS; k++) {
        if (!endings[k].seen)
            continue;
        char *json = drawn_output("plot interval -n %g -f %g -F %s -m d3d --json", NEAR, FAR, endings[k].format);
        json_t *root = json_of(json);
        char name[32];
        snprintf(name, sizeof name, "%s d3d", endings[k].format);
        const double end = number_in(series_of(root, name), "certain_to");
        char *rows = drawn_output("table -n %g -f %g -F %s -m d3d --csv --at %.17g,%.17g", NEAR, FAR, endings[k].format,
                                  end, end * (1 + 1e-6));
        const char *first = strchr(rows, '\n') + 1, *second = strchr(first, '\n');
        const char *truth = strstr(first, "true"), *lie = strstr(first, "false");
        assert_true(truth != NULL && lie != NULL && truth < second && lie > second);
        json_decref(root);
        free(json);
        free(rows);
    }
}

/* Cells of CSV are empty behind the end, and there alone. */
TEST(csv_ends) {
    char *csv = drawn_output("plot interval -n %g -f %g -F fp16 -m d3d --csv", NEAR, FAR);
    const double end = end_of(&endings[2]);
    size_t rows = 0, empty = 0;
    assert_int_equal(endings[2].last == 0x1p-11, 1);
    for (char *line = strchr(csv, '\n'); line != NULL && line[1] != '\0'; line = strchr(line + 1, '\n'), rows++) {
        char *rest;
        const double z = strtod(line + 1, &rest);
        const bool without = rest[1] == ',' || rest[1] == '\n' || rest[1] == '\r';
        assert_int_equal(*rest, ',');
        assert_true(fabs(z / end - 1) < 0.01 || without == (z > end));
        empty += without;
    }
    assert_true(rows > 100 && empty > 10);
    free(csv);
}

/* ---- Its picture ------------------------------------------------------------------------------------------------- */

/* A short upright stroke in a colour, across a place. */
static bool has_bar(const drawn *d, uint32_t colour, double x, double y) {
    for (size_t i = 0; i < d->svg->count; i++) {
        const svg_mark *m = &d->svg->marks[i];
        if (m->count == 2 && m->stroke.a > 0 && svg_rgb(m->stroke) == colour && m->points[0].x == m->points[1].x &&
            fabs(m->points[0].x - x) < 2 && fabs((m->points[0].y + m->points[1].y) / 2 - y) < 4 &&
            fabs(m->points[0].y - m->points[1].y) > 8)
            return true;
    }
    return false;
}

TEST(pictures_end_in_a_bar) {
    for (size_t k = 0; k < ENDINGS; k++) {
        drawn *d = drawn_run(&drawn_light, "plot interval -n %g -f %g -F %s -m d3d", NEAR, FAR, endings[k].format);
        const drawn_panel *p = &d->panels[0];
        const drawn_entry *e = drawn_legend(d, endings[k].format);
        const svg_mark *curve = drawn_curve(d, p, e);
        const double end = endings[k].seen ? end_of(&endings[k]) : FAR, x = drawn_px(&p->x, end);
        const char *said = strstr(e->text, " (ends at ");
        assert_px(curve->box.x1, x, 2);
        assert_int_equal(said != NULL, endings[k].seen);
        assert_int_equal(d->entry_count, endings[k].seen ? 2 : 1);
        if (endings[k].seen) {
            assert_true(fabs(strtod(said + 10, NULL) / end - 1) < 0.01);
            assert_px(curve->box.y0, drawn_px(&p->y, FAR - end), 6);
            assert_true(has_bar(d, svg_rgb(e->line->stroke), x, curve->box.y0));
            drawn_legend(d, "ends here: nothing behind it up to far is certain");
        }
        drawn_close(d);
    }
}

/* With an infinite far plane it is z u/n that reaches 1: nothing has an end that could be too near. */
TEST(unbounded_ends_are_named) {
    drawn *d = drawn_run(&drawn_light, "plot interval -n %g -f inf -F fp16,unorm16 -m d3d", NEAR);
    for (size_t k = 2; k < 4; k++) {
        const char *said = strstr(drawn_legend(d, endings[k].format)->text, " (ends at ");
        assert_non_null(said);
        assert_true(fabs(strtod(said + 10, NULL) / (NEAR / endings[k].last) - 1) < 0.015);
    }
    drawn_legend(d, "unbounded from here: nothing beyond is resolved");
    assert_int_equal(d->entry_count, 3);
    drawn_close(d);
}

/* Behind the end of a requirement's curve nothing is drawn either. */
TEST(requirements_end) {
    char path[256];
    snprintf(path, sizeof path, "%s/half.need", drawn_folder());
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file,
            "cameras = { half = { near = %g; far = %g; mapping = \"d3d\"; format = \"fp16\"; model = \"float\"; }; };\n"
            "requirements = { all = { camera = \"half\"; range = [1, 900]; separation = 1; }; };\n",
            NEAR, FAR);
    assert_int_equal(fclose(file), 0);
    char *json = drawn_output("plot needs %s --json", path);
    json_t *root = json_of(json);
    check_series(series_of(root, "separation given"), "length", &endings[2]);
    json_decref(root);
    free(json);
}

/* However far from the origin: what is safe 15 ahead is never more than the 5 that are left, and it ends once. */
TEST(worlds_end) {
    char *json = drawn_output("plot world -n 0.1 -f 20 -F fp16 -m d3d --at 15 --json");
    json_t *root = json_of(json);
    const json_t *series, *panel = json_array_get(json_object_get(root, "panels"), 0), *point;
    size_t k, i, ended = 0;
    json_array_foreach(json_object_get(panel, "series"), k, series) {
        const double certain_to = number_in(series, "certain_to");
        json_array_foreach(json_object_get(series, "points"), i, point) {
            const double distance = number_in(point, "distance"), value = number_in(point, "most");
            assert_true(isnan(certain_to) || (distance > certain_to) == isnan(value));
            assert_true(isnan(value) || value <= 5);
        }
        ended += isnan(certain_to) ? 0 : 1;
    }
    assert_true(ended >= 2 && ended < k);
    json_decref(root);
    free(json);
}
