/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Every figure of a camera, of every kind of camera: it is drawn, with numbers at its points and labels at its ticks
 * that tell them apart, or refused in a sentence. No kind crashes.
 */
#include "drawn.h"
#include "plot/figure.h"
#include "printed.h"

typedef struct camera_kind {
    const char *words;
    bool drawn; /* its ticks are looked at, too */
} camera_kind;

static const camera_kind kinds[] = {
    {"-n 0.1 -f 1000 -m reversed", false},
    {"-n 0.1 -f inf", true},
    {"-n 0.1 -f inf -m d3d", false},
    {"-n 0.1 -f inf -m gl-reversed", false},
    {"-n 1e12 -f inf", true},
    {"-n 1e-12 -f inf", false},
    {"-n 1e-12 -f 1e18", true},
    {"-n 1e12 -f 1e18 -m d3d", false},
    {"-n 1 -f 1.00001 -m d3d", true},
    {"-n 1e12 -f 1.00001e12", true},
    {"-n 1e-12 -f 1.00001e-12", true},
    {"--ortho -n 0.1 -f 100", false},
    {"--ortho -n 0 -f 1e18", true},
    {"--ortho -n -50 -f 50 -m d3d", true},
    {"--ortho -n -1000 -f -1", false},
    {"--ortho -n -1e18 -f 1e18", false},
    {"-m log -f 1e9", false},
    {"-m log -n 0.1 -f inf", false},
    {"-n 1 -f 1e25", true},
    {"-n 1e-6 -f 1e24 -m three-webgl", true},
    {"-n 100 -f 1e28 -m reversed", false},
    {"-m linear", false},
    {"-m cesium -f 1e9", false},
    {"-m three-webgpu -n 1e-3", false},
    {"-m osgearth -n 1 -f 1.001", false},
};

/* Figures of the camera that options describe; the others have one of their own. */
static bool is_of_camera(const figure_row *figure) {
    return (figure->takes & (FIGURE_SETUPS | FIGURE_FARS)) != 0 && figure->family == NULL;
}

/* A figure that takes long is looked at in one format, and the slowest of some kinds. */
static bool is_slow(const char *figure) {
    return strcmp(figure, "normals") == 0 || strcmp(figure, "map") == 0;
}

static const char *few(const char *figure) {
    return is_slow(figure) ? " -F unorm24" : "";
}

static bool holds_nan(const char *csv) {
    for (const char *at = csv; (at = strstr(at, "nan")) != NULL; at++)
        if ((at == csv || strchr(",-\n", at[-1]) != NULL) && strchr(",\n", at[3]) != NULL)
            return true;
    return false;
}

/* Numbers or one sentence. @return whether it has any */
static bool check_data(const char *figure, const camera_kind *kind, const char *form) {
    printed p = print_of("plot %s %s%s %s", figure, kind->words, few(figure), form);
    const bool good = p.status == 0;
    const bool bare = strcmp(form, "--json") == 0 ? strstr(p.out, "\"error\":{") != NULL : p.out[0] == '\0';
    if (!good && (p.status != 2 || !bare || strchr(p.errors, '\n') != strrchr(p.errors, '\n')))
        fail_msg("plot %s %s %s ends with %d: %s", figure, kind->words, form, p.status, p.errors);
    if (good && strcmp(form, "--csv") == 0 && (holds_nan(p.out) || strchr(p.out, '\n') == strrchr(p.out, '\n')))
        fail_msg("plot %s %s %s: no numbers", figure, kind->words, form);
    if (good && strcmp(form, "--json") == 0)
        json_decref(json_of(p.out));
    printed_free(&p);
    return good;
}

/* Panels above others have no labels below them. No two ticks of an axis say the same, and what they say grows with
 * their place. */
static void check_labels(const drawn_scale *s, const char *what, const char *figure, const camera_kind *kind) {
    for (int i = 0; i < s->labels; i++)
        for (int k = 0; k < i; k++) {
            const double one = drawn_number(s->at[i]->text), other = drawn_number(s->at[k]->text);
            const bool grows = s->px[i] == s->px[k] ? one == other : (one - other) * (s->px[i] - s->px[k]) * s->b > 0;
            if (!grows)
                fail_msg("plot %s %s: on %s '%s' and '%s'", figure, kind->words, what, s->at[i]->text, s->at[k]->text);
        }
    if (s->labels == 1)
        fail_msg("plot %s %s: one label on %s", figure, kind->words, what);
}

static void check_ticks(const char *figure, const camera_kind *kind) {
    drawn *d = drawn_run(&drawn_light, "plot %s %s%s", figure, kind->words, few(figure));
    for (size_t i = 0; i < d->panel_count; i++) {
        check_labels(&d->panels[i].x, "x", figure, kind);
        check_labels(&d->panels[i].y, "y", figure, kind);
    }
    svg_free(d->svg); /* its words are looked at elsewhere */
    free(d);
}

TEST(every_figure_of_every_kind_of_camera) {
    size_t written = 0, looked = 0;
    for (size_t i = 0; figure_get(i) != NULL; i++)
        for (size_t k = 0; is_of_camera(figure_get(i)) && k < sizeof kinds / sizeof kinds[0]; k++) {
            const char *figure = figure_get(i)->name;
            const bool slowest = strcmp(figure, "normals") == 0;
            if (is_slow(figure) ? k % test_cases(slowest ? 18 : 6, 2, 1) != 0 : (i + k) % test_cases(3, 1, 1) != 0)
                continue;
            const bool has = check_data(figure, &kinds[k], "--csv");
            if (k % test_cases(4, 3, 1) == 0 && !is_slow(figure) && check_data(figure, &kinds[k], "--json") != has)
                fail_msg("plot %s %s: CSV or JSON alone", figure, kinds[k].words);
            written += has;
            if (has && kinds[k].drawn && !slowest && strcmp(figure, "cost") != 0 /* names for ticks */ &&
                k % test_cases(2, 1, 1) == 0) {
                check_ticks(figure, &kinds[k]);
                looked++;
            }
        }
    assert_true(written > test_cases(30, 110, 110) && looked > test_cases(5, 30, 30));
}

/* Reed's two formats, one word away: the figure that all options would draw. */
TEST(staircases_need_no_options) {
    json_t *one = json_printed(0, "plot staircase --json");
    json_t *other = json_printed(0, "plot distribution -n 1 -f 20 -F unorm4,float3.3b5 -m d3d,reversed --json");
    assert_string_equal(text_at(one, "data"), text_at(other, "data"));
    assert_int_equal(json_array_size(node_at(one, "panels")), 4);
    json_decref(one);
    json_decref(other);
    one = json_printed(0, "plot staircase -F unorm3 -m gl -f 9 --json");
    other = json_printed(0, "plot distribution -n 1 -f 9 -F unorm3 -m gl --json");
    assert_string_equal(text_at(one, "data"), text_at(other, "data"));
    json_decref(one);
    json_decref(other);
    one = json_printed(0, "plot staircase -F unorm2,unorm3,unorm4,unorm5 -m d3d,reversed --json");
    assert_int_equal(json_array_size(node_at(one, "panels")), 8);
    json_decref(one);
    check_says(2, "must make at most 8 set-ups", "plot staircase -F unorm2,unorm3,unorm4 -m d3d,gl,reversed --json");
}

/* By default from 1 to 20, where a picture shows what the curves are; a preset has planes of its own. */
TEST(linear01_shows_a_short_range) {
    static const struct {
        const char *options;
        double znear, zfar;
    } cases[] = {{"", 1, 20}, {"-n 2", 2, 20}, {"-f 40", 1, 40}, {"--preset unity", 0.3, 1000}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const double n = cases[i].znear, f = cases[i].zfar;
        printed p = print_of("plot linear01 %s --csv", cases[i].options);
        size_t rows = 0;
        assert_int_equal(p.status, 0);
        for (char *line = strchr(p.out, '\n'); line != NULL && line[1] != '\0'; line = strchr(line + 1, '\n')) {
            char *rest = line;
            double at[8] = {0};
            size_t columns = 0;
            do
                at[columns++] = strtod(rest + 1, &rest);
            while (*rest == ',' && columns < 8);
            assert_true(fabs(at[columns - 2] - at[0] / f) < 1e-12);
            assert_true(fabs(at[columns - 1] - (at[0] - n) / (f - n)) < 1e-12);
            assert_true(rows > 0 || at[0] == n);
            rows += 1;
            assert_true(strchr(line + 1, '\n')[1] != '\0' || at[0] == f);
        }
        assert_true(rows > 100);
        printed_free(&p);
    }
}

/* The farthest of several far planes ends what may be shown, in whatever order they stand. */
TEST(linear01_of_several_far_planes) {
    static const char *const orders[] = {"10,20", "20,10", "20,10,15"};
    for (size_t i = 0; i < sizeof orders / sizeof orders[0]; i++) {
        json_decref(json_printed(0, "plot linear01 -f %s --range 1:15 --json", orders[i]));
        check_says(2, "= [1, 20], got 21", "plot linear01 -f %s --range 1:21 --json", orders[i]);
    }
}

/* Each curve is what it is called, up to its own far plane. */
TEST(linear01_is_what_it_says) {
    static const struct {
        const char *mapping;
        bool reversed;
    } mappings[] = {{"d3d", false}, {"reversed", true}, {"gl", false}};
    static const double fars[] = {10, 20};
    for (size_t i = 0; i < sizeof mappings / sizeof mappings[0]; i++) {
        json_t *root = json_printed(0, "plot linear01 -n 1 -f 10,20 -m %s --json", mappings[i].mapping);
        const json_t *all = node_at(root, "panels[0].series"), *series, *point;
        size_t k, at, seen = 0;
        json_array_foreach(all, k, series) {
            const char *name = text_at(series, "name"), *of = strstr(name, ": ");
            const double n = 1, f = atof(name + 4);
            assert_true(of != NULL && strncmp(name, "far ", 4) == 0 && (f == fars[0] || f == fars[1]));
            const bool window = strncmp(of + 2, "window depth, ", 14) == 0;
            const bool from_near = strcmp(of + 2, "Linear01DepthFromNear") == 0;
            assert_true(window ? strcmp(of + 16, mappings[i].mapping) == 0
                               : from_near || strcmp(of + 2, "Linear01Depth, z/far") == 0);
            json_array_foreach(json_object_get(series, "points"), at, point) {
                const double z = number_at(point, "z"), d = f * (z - n) / ((f - n) * z);
                const double is = window ? mappings[i].reversed ? 1 - d : d : from_near ? (z - n) / (f - n) : z / f;
                assert_true(fabs(number_at(point, "share") - is) < 1e-12);
                seen += z == f;
            }
        }
        assert_true(json_array_size(all) == 6 && seen == 6);
        json_decref(root);
    }
}

/* The share of what has no end would be 0 everywhere. */
TEST(linear01_has_a_finite_far_plane) {
    static const refused_row rows[] = {{"-f inf -o /dev/null --type svg", "must be finite in the figure linear01", 2},
                                       {"-f 100,inf --json", "must be finite in the figure linear01", 2},
                                       {"-f inf --csv", "must be finite in the figure linear01", 2}};
    CHECK_REFUSED("plot linear01", rows);
}
