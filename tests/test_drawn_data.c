/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The numbers that `plot --json` writes are those that the figure shows: axes, names and every point. */
#include <jansson.h>

#include "drawn.h"
#include "drawn_truth.h"
#include "support.h"

static const char *text_of(const json_t *object, const char *key) {
    const char *text = json_string_value(json_object_get(object, key));
    if (text == NULL)
        fail_msg("no text '%s'", key);
    return text;
}

/* A number, or infinity as it is written; NaN for null. */
static double number_of(const json_t *object, const char *key) {
    const json_t *v = json_object_get(object, key);
    if (v == NULL)
        fail_msg("no number '%s'", key);
    if (json_is_string(v))
        return strtod(json_string_value(v), NULL);
    return json_is_number(v) ? json_number_value(v) : NAN;
}

/* The words of a caption and the kind of its scale. */
static void check_axis(const json_t *axis, const svg_mark *caption, const drawn_scale *scale) {
    char words[256];
    const char *unit = text_of(axis, "unit");
    snprintf(words, sizeof words, unit[0] != '\0' ? "%s (%s)" : "%s", text_of(axis, "label"), unit);
    assert_string_equal(caption->text, words);
    if (scale->b != 0)
        assert_string_equal(text_of(axis, "scale"), scale->log ? "log" : "linear");
}

static bool on_line(const svg_mark *line, double x, double y) {
    double top, bottom;
    return drawn_reach(line, x - 1, x + 1, &top, &bottom) && y > top - 1.5 && y < bottom + 1.5;
}

/* Each point of a listed curve lies on it. */
static int check_points(const drawn *d, const drawn_panel *p, const json_t *root, const json_t *series) {
    const char *x_key = text_of(json_object_get(root, "x"), "key"), *y_key = text_of(json_object_get(root, "y"), "key");
    const drawn_entry *e = NULL;
    const drawn_scale *y = &p->y;
    int seen = 0;
    size_t i;
    const json_t *point;
    const char *name = text_of(series, "name");
    for (size_t k = 0; k < d->entry_count; k++) {
        const char *text = d->entries[k].text, *rest = text + strlen(name);
        if (strncmp(text, name, strlen(name)) == 0 && (*rest == '\0' || strncmp(rest, " = ", 3) == 0))
            e = &d->entries[k];
    }
    if (e == NULL || e->lines != 1)
        return 0;
    if (strstr(e->text, "right axis") != NULL) {
        y_key = text_of(json_object_get(root, "second"), "key");
        y = &p->second;
    }
    const svg_mark *curve = drawn_curve(d, p, e);
    json_array_foreach(json_object_get(series, "points"), i, point) {
        const double at = number_of(point, x_key), value = number_of(point, y_key);
        if (!isfinite(value) || (y->log && value == 0))
            continue;
        if (!on_line(curve, drawn_px(&p->x, at), drawn_px(y, value)))
            fail_msg("%s: the point %g, %g is not on the curve", e->text, at, value);
        seen++;
    }
    return seen;
}

/* A map's points against the library: near, far, and the worst interval. */
static int check_map(const json_t *series, const dp_setup *like) {
    size_t i;
    const json_t *point;
    int seen = 0;
    json_array_foreach(json_object_get(series, "points"), i, point) {
        dp_spec spec = like->spec;
        dp_setup setup;
        dp_worst worst;
        if (i % 97 != 0)
            continue;
        spec.znear = number_of(point, "near");
        spec.zfar = number_of(point, "far");
        if (dp_setup_init(&setup, &spec) != DP_OK)
            continue;
        assert_int_equal(dp_worst_over(&setup, spec.znear, spec.zfar, &worst), DP_OK);
        assert_ulp(number_of(point, "interval"), worst.interval, 0);
        seen++;
    }
    return seen;
}

/* The codes that a real format of so many bits of mantissa has from NDC up to `last`: from every binary32 NDC >= -1 up
 * to -1/4 one by one, and all of them above, where half of a step of NDC is no wider than one of the format. */
static double codes_up_to(float last, int mantissa) {
    double count = 0;
    float before = -1;
    for (float ndc = -1.0f; ndc <= fminf(last, -0.25f); ndc = nextafterf(ndc, 1.0f)) {
        const float depth = 0.5f * ndc + 0.5f;
        const float step = ldexpf(1.0f, (depth > 0 ? ilogbf(depth) : -126) - mantissa);
        const float code = mantissa < 23 ? step * nearbyintf(depth / step) : depth;
        count += code != before;
        before = code;
    }
    for (double to = 0.5 + 0.5 * (double)last, from = 0.375; from < to; from = from < 0.5 ? 0.5 : to) {
        const double end = from < 0.5 ? fmin(0.5, to) : to;
        count += (end - from) * ldexp(1.0, mantissa + (from < 0.5 ? 2 : 1));
    }
    return count;
}

/* In binary32 a share is of the codes that [-1, 1] reaches, which is a few of those of reversed depth near 0. */
TEST(share_counts_what_is_reached) {
    static const struct {
        const char *format, *model;
        int mantissa;
    } cases[] = {{"fp32", "float", 23}, {"fp32", "staged", 23}, {"float8.18", "staged", 18}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char *text = drawn_output("plot share -n 0.1 -f 1000 -F %s -m gl-reversed --model %s --csv", cases[i].format,
                                  cases[i].model);
        const double all = codes_up_to(1.0f, cases[i].mantissa);
        size_t seen = 0;
        for (char *line = strtok(strchr(text, '\n') + 1, "\n"); line != NULL; line = strtok(NULL, "\n")) {
            double z, share;
            if (sscanf(line, ",%*[^,],%lf,%lf", &z, &share) != 2 || z < 1 || z > 999)
                continue;
            const double depth = 0.1 * (1000 - z) / (z * 999.9);
            const double expected = 100 * codes_up_to((float)(2 * depth - 1), cases[i].mantissa) / all;
            assert_relative(share, expected, z < 900 ? 0.01 : 0.1);
            seen++;
        }
        assert_true(seen > 20);
        free(text);
    }
}

typedef struct data_case {
    const char *arguments;
    bool curves, map, second;
} data_case;

TEST(numbers_are_those_shown) {
    static const data_case cases[] = {
        {"error -F unorm24,fp16 -m d3d,reversed", true, false, false},
        {"share -F unorm16 -m d3d,reversed", true, false, false},
        {"distribution -F unorm4 -m d3d,reversed -n 1 -f 20", true, false, false},
        {"budget -F unorm24,fp32 -m d3d", true, false, true},
        {"map -F unorm24 -m d3d,reversed", false, true, false},
        {"stability linearize", false, false, false},
    };
    for (size_t c = 0; c < sizeof cases / sizeof cases[0]; c++) {
        const data_case *q = &cases[c];
        cameras like = cameras_of(drawn_camera(0.1, 1000), "unorm24", "d3d,reversed");
        char *text = drawn_output("plot %s --json", q->arguments);
        drawn *d = drawn_run(&drawn_light, "plot %s", q->arguments);
        json_t *root = json_loads(text, JSON_REJECT_DUPLICATES, NULL);
        const json_t *panel, *series;
        size_t p, s;
        assert_non_null(root);
        assert_string_equal(text_of(root, "title"), d->title);
        assert_string_equal(text_of(root, "subtitle"), d->subtitle);
        assert_non_null(strstr(d->svg->metadata, text_of(root, "data")));
        assert_int_equal(strncmp(q->arguments, text_of(root, "figure"), strlen(text_of(root, "figure"))), 0);
        check_axis(json_object_get(root, "x"), d->x_caption, &d->panels[d->panel_count - 1].x);
        check_axis(json_object_get(root, "y"), d->y_caption, &d->panels[0].y);
        if (json_object_get(root, "second") != NULL)
            check_axis(json_object_get(root, "second"), d->right_caption, &d->panels[0].second);
        if (json_object_get(root, "value") != NULL)
            check_axis(json_object_get(root, "value"), d->right_caption, &d->value);
        assert_int_equal(json_object_get(root, "second") != NULL, q->second);
        assert_int_equal(json_object_get(root, "value") != NULL, d->bar != NULL);
        assert_int_equal(json_array_size(json_object_get(root, "panels")), d->panel_count);
        json_array_foreach(json_object_get(root, "panels"), p, panel) {
            int points = 0, fields = 0;
            assert_string_equal(text_of(panel, "title"), d->panels[p].heading);
            json_array_foreach(json_object_get(panel, "series"), s, series) {
                points += check_points(d, &d->panels[p], root, series);
                if (q->map && strcmp(text_of(series, "name"), "map") == 0)
                    fields += check_map(series, &like.setups[p]);
            }
            assert_int_equal(points > 0, q->curves);
            assert_int_equal(fields > 100, q->map);
        }
        json_decref(root);
        free(text);
        svg_free(d->svg); /* its words are looked at elsewhere */
        free(d);
    }
}
