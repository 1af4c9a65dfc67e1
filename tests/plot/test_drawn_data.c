/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The numbers that `plot --json` and `--csv` write are those that the figure shows: axes, names and every point. */
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
        if (strncmp(text, name, strlen(name)) == 0 &&
            (*rest == '\0' || strncmp(rest, ", hidden by ", 12) == 0 || strncmp(rest, " (ends at ", 10) == 0))
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

/* The next field of a line of CSV, without its quotes. */
static char *field(char **at) {
    char *start = *at, *end;
    if (*start == '"') {
        start++;
        end = strchr(start, '"');
        assert_non_null(end);
        *end++ = '\0';
    } else {
        end = start + strcspn(start, ",\r\n");
    }
    *at = end + (*end != '\0');
    *end = '\0';
    return start;
}

static void check_cell(const char *text, double want) {
    if (isnan(want))
        assert_true(text[0] == '\0' || strcmp(text, "nan") == 0 || strcmp(text, "inf") == 0);
    else
        assert_ulp(strtod(text, NULL), want, 0);
}

/* Lines of CSV are the points of JSON, a column for each axis. */
static void check_csv(const json_t *root, char *csv) {
    static const char *const axes[] = {"x", "y", "second", "value"};
    size_t p, s, i, columns = 0;
    const json_t *panel, *series, *point, *own[4];
    char *rest = NULL, *line = strtok_r(csv, "\n", &rest);
    assert_string_equal(field(&line), "panel");
    assert_string_equal(field(&line), "series");
    for (size_t k = 0; k < 4; k++) {
        const json_t *axis = json_object_get(root, axes[k]);
        char head[128];
        if (axis == NULL)
            continue;
        const char *unit = text_of(axis, "unit");
        snprintf(head, sizeof head, unit[0] != '\0' ? "%s [%s]" : "%s", text_of(axis, "key"), unit);
        assert_string_equal(field(&line), head);
        own[columns++] = axis;
    }
    json_array_foreach(json_object_get(root, "panels"), p, panel) {
        json_array_foreach(json_object_get(panel, "series"), s, series) {
            json_array_foreach(json_object_get(series, "points"), i, point) {
                line = strtok_r(NULL, "\n", &rest);
                assert_non_null(line);
                if (i % 16 != 0 && json_array_size(json_object_get(series, "points")) > 1000)
                    continue;
                assert_string_equal(field(&line), text_of(panel, "title"));
                assert_string_equal(field(&line), text_of(series, "name"));
                for (size_t k = 0; k < columns; k++) {
                    const char *key = text_of(own[k], "key"), *text = field(&line);
                    check_cell(text, json_object_get(point, key) != NULL ? number_of(point, key) : NAN);
                }
            }
        }
    }
    assert_null(strtok_r(NULL, "\n", &rest));
}

enum { SHEET_COLUMNS = 40, SHEET_ROWS = 8192 };

/* Lines of CSV with a column for each curve; what is empty is NaN. */
typedef struct sheet {
    char heads[SHEET_COLUMNS][96];
    size_t columns, rows, places; /* the column of x: with several panels the second */
    char panels[SHEET_ROWS][96];
    double cells[SHEET_ROWS][SHEET_COLUMNS];
} sheet;

static void read_sheet(char *csv, sheet *out) {
    char *rest = NULL, *line = strtok_r(csv, "\n", &rest);
    out->columns = out->rows = 0;
    while (*line != '\0' && *line != '\r')
        snprintf(out->heads[out->columns++], sizeof out->heads[0], "%s", field(&line));
    out->places = strcmp(out->heads[0], "panel") == 0;
    for (line = strtok_r(NULL, "\n", &rest); line != NULL; line = strtok_r(NULL, "\n", &rest)) {
        for (size_t k = 0; k < out->columns; k++) {
            const char *text = field(&line);
            out->cells[out->rows][k] = *text != '\0' ? strtod(text, NULL) : NAN;
            if (k == 0 && out->places == 1)
                snprintf(out->panels[out->rows], sizeof out->panels[0], "%s", text);
        }
        out->rows++;
        assert_true(out->rows < SHEET_ROWS);
    }
}

/* The value of a series, in its axis' unit, at a place of a panel, which has one line. */
static double sheet_cell(const sheet *s, const char *panel, double x, const char *series, const char *unit) {
    char head[128];
    size_t column = s->places + 1, found = SHEET_ROWS;
    snprintf(head, sizeof head, unit[0] != '\0' ? "%s [%s]" : "%s", series, unit);
    while (column < s->columns && strcmp(s->heads[column], head) != 0)
        column++;
    assert_true(column < s->columns);
    for (size_t i = 0; i < s->rows; i++)
        if (s->cells[i][s->places] == x && strcmp(s->panels[i], panel) == 0) {
            assert_int_equal(found, SHEET_ROWS);
            found = i;
        }
    assert_true(found < SHEET_ROWS);
    return s->cells[found][column];
}

/* Each point of JSON is in the line of its place, in the column of its curve; curves have a value in every line, but
 * those of the points of a census. */
static void check_sheet(const json_t *root, char *csv) {
    static sheet s;
    size_t p, k, i, shown = 0;
    const json_t *panel, *series, *point;
    const char *x = text_of(json_object_get(root, "x"), "key"), *unit = text_of(json_object_get(root, "x"), "unit");
    char head[128];
    memset(&s, 0, sizeof s);
    read_sheet(csv, &s);
    snprintf(head, sizeof head, "%s [%s]", x, unit);
    assert_string_equal(s.heads[s.places], head);
    json_array_foreach(json_object_get(root, "panels"), p, panel) {
        json_array_foreach(json_object_get(panel, "series"), k, series) {
            json_array_foreach(json_object_get(series, "points"), i, point) {
                const char *const y_key = text_of(json_object_get(root, "y"), "key");
                const json_t *const axis =
                    json_object_get(root, json_object_get(point, y_key) != NULL ? "y" : "second");
                const char *const key = text_of(axis, "key");
                const json_t *value = json_object_get(point, key);
                const double got = sheet_cell(&s, s.places == 1 ? text_of(panel, "title") : "", number_of(point, x),
                                              text_of(series, "name"), text_of(axis, "unit"));
                assert_true(json_is_null(value) ? isinf(got) : got == number_of(point, key));
                shown++;
            }
        }
    }
    assert_true(shown > 10);
    for (i = 0; i < s.rows; i++) {
        bool census = false, curves = true;
        for (k = s.places + 1; k < s.columns; k++)
            if (strstr(s.heads[k], ", census") != NULL)
                census = census || !isnan(s.cells[i][k]);
            else
                curves = curves && !isnan(s.cells[i][k]);
        assert_true(curves || census);
        assert_true(i == 0 || strcmp(s.panels[i], s.panels[i - 1]) != 0 ||
                    s.cells[i][s.places] > s.cells[i - 1][s.places]);
    }
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

/* A walk over NDC from -1 up: where it goes on, the code before, and how many there were. */
typedef struct ndc_walk {
    float ndc, before;
    double count;
} ndc_walk;

/* The codes that a real format of so many bits of mantissa has from NDC up to `last`: from every binary32 NDC >= -1 up
 * to -1/4 one by one, and all of them above, where half of a step of NDC is no wider than one of the format. A walk
 * that has been is kept at places APART, and the next one goes on from there. */
static double codes_up_to(float last, int mantissa) {
    enum { APART = 4096, KEPT = (1 << 24) / APART + 1 };
    static ndc_walk kept[KEPT];
    static size_t kept_count;
    static int kept_of;
    if (kept_of != mantissa) {
        kept[0] = (ndc_walk){-1, -1, 0};
        kept_count = 1;
        kept_of = mantissa;
    }
    size_t at = kept_count - 1;
    while (at > 0 && kept[at].ndc > last)
        at--;
    ndc_walk walk = kept[at];
    for (size_t i = 1; walk.ndc <= fminf(last, -0.25f); i++) {
        const float depth = 0.5f * walk.ndc + 0.5f;
        const float step = ldexpf(1.0f, (depth > 0 ? ilogbf(depth) : -126) - mantissa);
        const float code = mantissa < 23 ? step * nearbyintf(depth / step) : depth;
        walk.count += code != walk.before;
        walk.before = code;
        walk.ndc = nextafterf(walk.ndc, 1.0f);
        if (i % APART == 0 && at + i / APART == kept_count && kept_count < KEPT)
            kept[kept_count++] = walk;
    }
    double count = walk.count;
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
            if (sscanf(line, "%lf,%lf", &z, &share) != 2 || z < 1 || z > 999)
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

/* Unless another model is asked for, [-1, 1] is rounded: 1.3 % of the codes are left beyond 10, not 94.7 %. */
TEST(share_of_signed_ndc) {
    static const char *const models[] = {"", "--model staged", "--model float", "--model exact"};
    const double depth = 0.1 * 990 / (10 * 999.9), left = codes_up_to((float)(2 * depth - 1), 23);
    for (size_t i = 0; i < sizeof models / sizeof models[0]; i++) {
        char *text = drawn_output("plot share -F fp32 -m reversed,gl-reversed --range 10:1000 %s --csv", models[i]);
        double share[2];
        assert_int_equal(sscanf(strchr(text, '\n'), "\n10,%lf,%lf", &share[0], &share[1]), 2);
        assert_relative(share[0], 94.69868, 1e-6);
        assert_relative(share[1], i == 3 ? share[0] : 100 * left / codes_up_to(1.0f, 23), 1e-4);
        free(text);
    }
}

/* [-1, 1] reaches 25 of 41 codes, if NDC has as few bits: whole 24ths of them are left behind a depth, those of all NDC
 * that are rounded to be as far or farther. */
TEST(share_of_a_small_float) {
    double ndc[81];
    dp_format f[2];
    size_t seen = 0;
    assert_int_equal(dp_format_parse("float3.3b5", f), 1);
    for (uint32_t code = 0; code <= 40; code++) {
        ndc[40 + code] = dp_format_value(&f[0], code);
        ndc[40 - code] = -ndc[40 + code];
    }
    char *text = drawn_output("plot share -n 1 -f 20 -F float3.3b5 -m gl-reversed --csv");
    for (char *line = strtok(strchr(text, '\n') + 1, "\n"); line != NULL; line = strtok(NULL, "\n")) {
        double z, share, last = 0;
        int left = 0;
        assert_int_equal(sscanf(line, "%lf,%lf", &z, &share), 2);
        const double real = 2 * (20 - z) / (z * 19) - 1;
        for (int i = 0; i < 80 && real >= (ndc[i] + ndc[i + 1]) / 2; i++) {
            const double d = dp_format_value(&f[0], dp_format_encode(&f[0], DP_ROUND_NEAREST, 0.5 + 0.5 * ndc[i + 1]));
            left += d != last;
            last = d;
        }
        assert_relative(share, 100 * left / 24.0, 1e-9);
        seen++;
    }
    assert_true(seen > 40);
    free(text);
}

typedef struct data_case {
    const char *arguments;
    bool curves, map, second, sheet;
} data_case;

TEST(numbers_are_those_shown) {
    static const data_case cases[] = {
        {"error -F unorm24,fp16 -m d3d,reversed", true, false, false, true},
        {"interval -F unorm24,fp16,fp32 -m d3d,reversed -f inf", true, false, false, true},
        {"interval --model float -F unorm16 -m d3d -n 1 -f 4", true, false, false, true},
        {"error -F unorm24,fp16 -m log,linear", true, false, false, true},
        {"share -F unorm16 -m d3d,reversed", true, false, false, true},
        {"distribution -F fp16,unorm24 -m d3d,reversed", true, false, false, true},
        {"distribution -F unorm4 -m d3d,reversed -n 1 -f 20", true, false, false, false},
        {"linear01 -n 1 -f 20", true, false, false, true},
        {"linear01 -n 1 -f 10,20,50 -m d3d", true, false, false, false},
        {"budget -F unorm24,fp32 -m d3d", true, false, true, true},
        {"map -F unorm24 -m d3d,reversed", false, true, false, false},
        {"stability linearize", false, false, false, false},
    };
    for (size_t c = 0; c < sizeof cases / sizeof cases[0]; c++) {
        const data_case *q = &cases[c];
        cameras like = cameras_of(drawn_camera(0.1, 1000), "unorm24", "d3d,reversed");
        char *text = drawn_output("plot %s --json", q->arguments), *csv = drawn_output("plot %s --csv", q->arguments);
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
        (q->sheet ? check_sheet : check_csv)(root, csv);
        json_decref(root);
        free(text);
        free(csv);
        svg_free(d->svg); /* its words are looked at elsewhere */
        free(d);
    }
}

/* Curves of CSV share their places: beside a picture, which needs few, there are as many as without one. */
TEST(numbers_beside_a_picture) {
    static const char *const figures[] = {"error -F d24 -m d3d", "interval -F fp32,d16 -m reversed",
                                          "share -F d16 -m d3d"};
    for (size_t i = 0; i < sizeof figures / sizeof figures[0]; i++) {
        char *alone = drawn_output("plot %s -n 0.1 -f 1000 --csv", figures[i]);
        char *beside = drawn_output("plot %s -n 0.1 -f 1000 --csv -o %s/beside.svg", figures[i], drawn_folder());
        assert_string_equal(beside, alone);
        free(alone);
        free(beside);
    }
}
