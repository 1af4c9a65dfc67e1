/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The numbers of each figure against the library, and what drawing may not change about them. */
#include "depthprec/depthprec.h"
#include "draw/draw.h"
#include "draw/notes.h"
#include "draw/ticks.h"
#include "draw/trace.h"
#include "draw/words.h"
#include "named.h"
#include "plot/figure.h"
#include "scene/figure.h"
#include "scene_made.h"
#include "shadow/shadow.h"
#include "solve/requirement.h"
#include "support.h"

/* For the leak sanitizer: what fontconfig read stays in memory until the program ends. */
const char *__lsan_default_suppressions(void);
const char *__lsan_default_suppressions(void) {
    return "leak:libfontconfig\n";
}

/* A request about some set-ups, with the room it points to. */
typedef struct asked {
    dp_setup setups[CHART_SERIES];
    const char *names[CHART_SERIES];
    figure_request request;
} asked;

static void ask(asked *a, double znear, double zfar) {
    *a = (asked){.request = {.lo = NAN, .hi = NAN, .at = NAN, .where = "here", .columns = 300, .rows = 200}};
    a->request.setups = a->setups;
    a->request.names = a->names;
    a->setups[0].spec = dp_spec_default();
    a->setups[0].spec.znear = znear;
    a->setups[0].spec.zfar = zfar;
}

static void ask_add(asked *a, const char *format, dp_mapping mapping) {
    dp_format found[2];
    dp_spec spec = a->setups[0].spec;
    assert_true(dp_format_parse(format, found) > 0);
    spec.format = found[0];
    spec.mapping = mapping;
    assert_int_equal(dp_setup_init(&a->setups[a->request.count], &spec), DP_OK);
    a->names[a->request.count++] = format;
}

static chart *build(const asked *a, const char *figure) {
    chart *c = chart_new();
    assert_non_null(c);
    snprintf(c->title, sizeof c->title, "%s", figure);
    assert_null(figure_find(figure)->build(&a->request, c));
    assert_false(chart_failed(c));
    return c;
}

/* ---- each figure shows what the library says ---- */

TEST(test_staircase) {
    static const char *const formats[] = {"unorm4", "float3.3b5"};
    for (int f = 0; f < 2; f++)
        for (int m = 0; m < DP_MAPPING_COUNT; m++) {
            asked a;
            ask(&a, 1, 20);
            ask_add(&a, formats[f], (dp_mapping)m);
            chart *c = build(&a, "distribution");
            const chart_series *codes = &c->panels[0].series[0], *curve = &c->panels[0].series[1];
            const dp_setup *setup = &a.setups[0];
            size_t expected = 0;
            for (uint32_t code = 0; code <= setup->spec.format.code_max; code++) {
                double z = dp_stored(setup, code);
                if (z < 1 || z > 20)
                    continue;
                assert_true(expected < codes->count);
                assert_ulp(codes->x[expected], z, 0);
                assert_ulp(codes->y[expected], dp_format_value(&setup->spec.format, code), 0);
                expected++;
            }
            assert_int_equal(codes->count, expected);
            assert_true(expected > 5);
            for (size_t i = 0; i < curve->count; i++)
                assert_ulp(curve->y[i], dp_window(setup, curve->x[i]), 0);
            assert_ulp(curve->x[0], 1, 0);
            assert_ulp(curve->x[curve->count - 1], 20, 0);
            chart_free(c);
        }
}

/* The published count: float3.3b5 has 40 values in [0, 1), so 41 with 1, and the staircase of the whole range shows
 * each that a depth in [near, far] gives back. */
TEST(test_published_count) {
    asked a;
    ask(&a, 1, 1000);
    ask_add(&a, "float3.3b5", DP_MAPPING_REVERSED);
    chart *c = build(&a, "distribution");
    assert_int_equal(c->panels[0].series[0].count, 41);
    chart_free(c);
}

static const char *const formats[] = {"fp16", "fp32", "unorm16", "unorm24", "float3.3b5"};

static dp_setup random_camera(rng *r, asked *a) {
    double znear = rng_log(r, 1e-3, 10);
    bool infinite = rng_below(r, 4) == 0;
    dp_mapping mapping = (dp_mapping)rng_below(r, infinite ? 4 : DP_MAPPING_COUNT);
    ask(a, znear, infinite ? (double)INFINITY : znear * rng_log(r, 2, 1e7));
    ask_add(a, formats[rng_below(r, 5)], mapping);
    return a->setups[0];
}

/* Over the whole range the curve reaches the certified worst case, and nothing above. */
TEST(test_envelope_top) {
    asked a;
    ask(&a, 0.1, 1000);
    for (int f = 0; f < 4; f++) {
        ask_add(&a, formats[f], DP_MAPPING_D3D);
        ask_add(&a, formats[f], DP_MAPPING_REVERSED);
    }
    chart *error = build(&a, "error"), *interval = build(&a, "interval");
    for (size_t i = 0; i < a.request.count; i++) {
        double top[2] = {0, 0};
        dp_worst worst;
        assert_int_equal(dp_worst_over(&a.setups[i], 0.1, 1000, &worst), DP_OK);
        for (size_t k = 0; k < error->panels[0].series[i].count; k++)
            top[0] = fmax(top[0], error->panels[0].series[i].y[k]);
        for (size_t k = 0; k < interval->panels[0].series[i].count; k++)
            top[1] = fmax(top[1], interval->panels[0].series[i].y[k]);
        assert_relative(top[0], worst.error, 1e-11);
        assert_relative(top[1], worst.interval, 1e-11);
    }
    chart_free(error);
    chart_free(interval);
}

TEST(test_blind) {
    asked a;
    ask(&a, 0.1, INFINITY);
    ask_add(&a, "unorm16", DP_MAPPING_D3D);
    chart *c = build(&a, "interval");
    const chart_series *s = &c->panels[0].series[0];
    dp_worst worst;
    assert_int_equal(dp_worst_over(&a.setups[0], 0.1, INFINITY, &worst), DP_OK);
    assert_true(isinf(s->y[s->count - 1]));
    for (size_t i = 1; i < s->count; i++) {
        assert_true(isinf(s->y[i]) || s->x[i] < worst.blind_from * 1.05);
        assert_false(isinf(s->y[i]) && s->x[i] < worst.blind_from / 1.05);
    }
    assert_non_null(strstr(s->note, "13107"));
    chart_free(c);
}

TEST(test_share) {
    rng r = rng_make("share");
    for (int n = 0; n < 30; n++) {
        asked a;
        dp_setup setup = random_camera(&r, &a);
        chart *c = build(&a, "share");
        const chart_series *s = &c->panels[0].series[0];
        double first = dp_code(&setup, setup.spec.znear), last = dp_code(&setup, setup.spec.zfar);
        assert_ulp(s->y[0], 100, 0);
        if (!isinf(setup.spec.zfar))
            assert_ulp(s->y[s->count - 1], 0, 0);
        for (size_t i = 1; i < s->count; i++) {
            assert_true(s->y[i] <= s->y[i - 1]);
            assert_ulp(s->y[i], 100 * fabs(dp_code(&setup, s->x[i]) - last) / fabs(last - first), 2);
        }
        chart_free(c);
    }
}

static void check_map(const asked *a) {
    chart *c = build(a, "map");
    const chart_map *m = &c->panels[0].map;
    rng r = rng_make("map");
    assert_int_equal(m->columns * m->rows, 400 * 300);
    int empty = 0;
    for (int n = 0; n < 2000; n++) {
        int column = (int)rng_below(&r, (uint64_t)m->columns), row = (int)rng_below(&r, (uint64_t)m->rows);
        double got = m->value[row * m->columns + column], want = (double)NAN;
        dp_spec spec = a->setups[0].spec;
        dp_setup setup;
        dp_sample s;
        dp_worst worst;
        spec.znear = m->x[column];
        spec.zfar = m->y[row];
        if (dp_setup_init(&setup, &spec) == DP_OK) {
            if (!isnan(a->request.at))
                want = dp_sample_at(&setup, a->request.at, &s) == DP_OK ? s.interval : (double)NAN;
            else
                want = dp_worst_over(&setup, spec.znear, spec.zfar, &worst) == DP_OK ? worst.interval : (double)NAN;
        }
        empty += isnan(want);
        assert_true(isnan(want) ? isnan(got) : got == want);
    }
    assert_true(isnan(a->request.at) ? empty == 0 : empty > 0);
    chart_free(c);
}

TEST(test_map) {
    asked a;
    ask(&a, 0.1, 1000);
    ask_add(&a, "fp32", DP_MAPPING_REVERSED);
    check_map(&a);
    a.request.at = 100;
    check_map(&a);
}

/* ---- every row of the table, in every theme and format, large and small: the same bytes twice ---- */

/* One requirement of two cameras is met, one missed and one about the error. */
static const char needs[] =
    "cameras = { a = { near = 0.1; far = 1000.0; mapping = \"d3d\"; format = \"unorm24\"; };"
    "            b = { near = 1.0; far = 100.0; mapping = \"reversed\"; format = \"fp32\"; model = \"float\"; }; };"
    "requirements = { x = { camera = \"a\"; range = [1.0, 500.0]; separation = 0.01; };"
    "                 y = { camera = \"a\"; at = 5.0; error = 0.01; };"
    "                 z = { camera = \"b\"; range = [2.0, 50.0]; separation = 0.01; }; };";

/* A light that has a place, with the rest of a map of the sun. */
static shadow_cascade lamp_of(const shadow_cascade *map) {
    shadow_cascade lamp = *map;
    const dp_spec lit = dp_spec_default();
    lamp.light.kind = SHADOW_SPOT;
    lamp.light.fov = 60;
    lamp.light.receiver_lo = 1;
    lamp.light.receiver_hi = 20;
    assert_int_equal(dp_setup_init(&lamp.light.setup, &lit), DP_OK);
    return lamp;
}

TEST(test_every_figure_draws) {
    static const int sizes[][2] = {{800, 500}, {DRAW_WIDTH_MIN, DRAW_HEIGHT_MIN}, {1700, 300}};
    need_file file;
    need_error error;
    const shadow_split split = shadow_split_default();
    const shadow_light light = shadow_light_default();
    shadow_cascade maps[2];
    static scene_made made;
    finder_found found;
    for (int i = 0; i < 2; i++)
        assert_int_equal(shadow_cascade_of(&split, &light, i, &maps[i]), SHADOW_OK);
    const shadow_cascade lamp = lamp_of(&maps[0]);
    scene_made_begin(&made);
    scene_made_surface(&made, "floor", "");
    for (int i = 0; i < 2; i++)
        scene_made_quad(&made, (const double[3]){0, 0, 0}, (const double[3]){8 - 4 * i, 0, 0},
                        (const double[3]){0, 0, 8});
    assert_int_equal(finder_find(&made.m, &(finder_asked){.gap = 1}, &found), FINDER_DONE);
    const fights_item item = {found.finding, 10};
    const fights_asked fights = {.m = &made.m, .found = &found, .item = &item, .count = 1, .gap = 1};
    method_start();
    assert_true(need_parse("needs", needs, sizeof needs - 1, &file, &error));
    for (size_t i = 0; figure_get(i) != NULL; i++) {
        const char *family = figure_get(i)->family;
        asked a;
        ask(&a, 0.1, i % 2 == 0 || (figure_get(i)->takes & FIGURE_FARS) != 0 ? 1000 : (double)INFINITY);
        if ((figure_get(i)->takes & FIGURE_DRAWN) != 0)
            a.setups[0].spec.triangles = dp_triangles_default();
        a.request.raster = raster_find("llvmpipe");
        a.request.slant = 60;
        a.request.azimuth = 45;
        ask_add(&a, "unorm24", DP_MAPPING_D3D);
        ask_add(&a, "unorm24", DP_MAPPING_REVERSED);
        a.request.file = &file;
        const bool placed = strcmp(figure_get(i)->name, "shadow-distance") == 0;
        a.request.maps = placed ? &lamp : maps;
        a.request.map_count = placed ? 1 : 2;
        a.request.fights = &fights;
        a.request.family = family != NULL ? method_family_find(family) : NULL;
        chart *c = build(&a, figure_get(i)->name);
        for (size_t t = 0; theme_get(t) != NULL; t++)
            for (int format = 0; format < CANVAS_FORMAT_COUNT; format++) {
                canvas_bytes one, two;
                const int *size = sizes[(t + i) % 3];
                assert_true(draw_chart(c, theme_get(t), (canvas_format)format, size[0], size[1], "command", &one));
                assert_true(draw_chart(c, theme_get(t), (canvas_format)format, size[0], size[1], "command", &two));
                assert_true(one.size > 1000 && two.size > 1000);
                /* cairo numbers the parts of an SVG through the life of a program; tests/plots.sh compares those. */
                if (format != CANVAS_SVG)
                    assert_true(one.size == two.size && memcmp(one.at, two.at, one.size) == 0);
                free(one.at);
                free(two.at);
            }
        chart_free(c);
    }
    finder_free(&found);
    need_release(&file);
}

/* Where the format may be either of two, each has its panel, drawn in the fullest model that the camera asks for. */
static void check_two_formats(const char *word) {
    static const char *const either[] = {"unorm24", "fp32"};
    char text[256];
    need_file file;
    need_error error;
    asked a;
    ask(&a, 1, 100);
    a.setups[0].spec.model = DP_MODEL_FLOAT;
    ask_add(&a, either[0], DP_MAPPING_D3D);
    ask_add(&a, either[1], DP_MAPPING_D3D);
    a.request.file = &file;
    snprintf(text, sizeof text,
             "cameras = { a = { near = 1.0; far = 100.0; mapping = \"d3d\"; format = \"depth24plus\"; model = \"%s\"; "
             "}; }; requirements = { x = { camera = \"a\"; range = [1.0, 50.0]; separation = 0.01; }; };",
             word);
    assert_true(need_parse("needs", text, strlen(text), &file, &error));
    chart *c = build(&a, "needs");
    assert_int_equal(c->panel_count, 2);
    for (size_t i = 0; i < 2; i++) {
        char title[80];
        const chart_series *s = &c->panels[i].series[0];
        snprintf(title, sizeof title, "a: %s d3d, float", either[i]);
        assert_string_equal(c->panels[i].title, title);
        assert_true(s->count > 2);
        for (size_t k = 0; k < s->count; k++) /* the worst of a column; a power of two may double it */
            assert_true(s->y[k] >= dp_separation(&a.setups[i], s->x[k]) / 1.03 &&
                        s->y[k] <= dp_separation(&a.setups[i], s->x[k]) * 2.5);
    }
    chart_free(c);
    need_release(&file);
}

TEST(test_needs_of_two_formats) {
    check_two_formats("auto");
    check_two_formats("float");
}

TEST(test_digest) {
    asked a;
    ask(&a, 0.1, 1000);
    ask_add(&a, "fp32", DP_MAPPING_D3D);
    chart *c = build(&a, "error");
    char before[17], after[17];
    chart_digest(c, before);
    double *y = &c->panels[0].series[0].y[2], kept = *y;
    *y = kept * (1 + 1e-14);
    chart_digest(c, after);
    assert_string_equal(after, before); /* not the last bits */
    *y = kept * (1 + 1e-6);
    chart_digest(c, after);
    assert_string_not_equal(after, before);
    *y = kept;
    c->panels[0].series[0].name[0]++;
    chart_digest(c, after);
    assert_string_not_equal(after, before);
    chart_free(c);
}

/* A grey curve is drawn, too. */
TEST(test_digest_under) {
    double under[4] = {1, 2, 3, 4};
    char before[17], after[17];
    chart *c = chart_new();
    chart_panel *panel = chart_add_panel(c);
    panel->x = panel->y = (chart_axis){.hi = 2};
    assert_true(chart_add_map(c, panel, 2, 2));
    panel->map.under = under;
    chart_digest(c, before);
    under[3] = 5;
    chart_digest(c, after);
    assert_string_not_equal(after, before);
    /* Each NaN is one, and so are the zeros, as makers of processors differ in them. */
    under[1] = 0;
    under[2] = NAN;
    chart_digest(c, before);
    under[1] = -0.0;
    under[2] = -(double)NAN;
    chart_digest(c, after);
    assert_string_equal(after, before);
    chart_free(c);
}

/* ---- the parts ---- */

TEST(test_ticks) {
    rng r = rng_make("ticks");
    tally t = {.name = "ticks"};
    for (uint64_t n = test_cases(2000, 20000, 200000); n > 0; n--) {
        chart_axis axis = {.scale = (chart_scale)rng_below(&r, 2)};
        double spread = rng_log(&r, 1e-5, 1e20);
        axis.lo = rng_log(&r, 1e-12, 1e12);
        axis.hi = axis.lo * (1 + spread);
        int room = 2 + (int)rng_below(&r, 20), labels = 0;
        ticks out;
        ticks_make(&axis, room, &out);
        bool sorted = true, inside = true;
        for (size_t i = 0; i < out.count; i++) {
            labels += out.items[i].text[0] != '\0';
            sorted = sorted && (i == 0 || out.items[i].at > out.items[i - 1].at);
            double share = chart_axis_share(&axis, out.items[i].at);
            inside = inside && share >= -1e-8 && share <= 1 + 1e-8;
        }
        TALLY(&t, sorted && inside, "order in %a..%a scale %d", axis.lo, axis.hi, (int)axis.scale);
        TALLY(&t, labels <= room + 2, "%d labels for %d in %a..%a", labels, room, axis.lo, axis.hi);
        TALLY(&t, labels >= (room >= 4 ? 2 : 1), "%d labels in %a..%a room %d", labels, axis.lo, axis.hi, room);
    }
    tally_end(&t);
}

TEST(test_tick_words) {
    static const struct {
        double value;
        bool powers;
        const char *text;
    } rows[] = {{1000, false, "1000"},
                {0.001, false, "0.001"},
                {999.7, false, "999.7"},
                {999.4, false, "999"},
                {250000, false, "250000"},
                {1.5e6, false, "1.5e+06"},
                {-123456, false, "-123456"},
                {1e-10, true, "10\u207b\u00b9\u2070"},
                {3.3554432e6, true, "3.36\u00b710\u2076"}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        char text[TICKS_TEXT];
        ticks_label(rows[i].value, rows[i].powers, text);
        assert_string_equal(text, rows[i].text);
    }
}

static double distance(const double p[2], const double a[2], const double b[2]) {
    double ux = b[0] - a[0], uy = b[1] - a[1], along = ux * ux + uy * uy;
    double t = along > 0 ? fmin(fmax(((p[0] - a[0]) * ux + (p[1] - a[1]) * uy) / along, 0), 1) : 0;
    return hypot(p[0] - a[0] - t * ux, p[1] - a[1] - t * uy);
}

/* Thinned curves stay within a pixel column of every point, in the SVG itself. */
TEST(test_trace) {
    enum { POINTS = 20000, CORNERS = 5000 };
    static double points[POINTS][2], corners[CORNERS][2];
    const notes none = {"", "", "", "", ""};
    rng r = rng_make("trace");
    for (int shape = 0; shape < 3; shape++) {
        canvas *c = canvas_new(CANVAS_SVG, 500, 500, &none);
        trace t = {.c = c};
        for (int i = 0; i < POINTS; i++) {
            points[i][0] = 500.0 * i / POINTS;
            points[i][1] = shape == 0   ? 250 + 200 * sin(points[i][0] / 30)
                           : shape == 1 ? rng_uniform(&r, 0, 500)
                                        : points[i][0];
            trace_point(&t, points[i][0], points[i][1]);
        }
        trace_finish(&t, &(canvas_pen){.colour = {0, 0, 0, 1}, .width = 1});
        canvas_bytes bytes;
        assert_true(canvas_finish(c, &bytes));
        const char *path = strstr(bytes.at, " d=\"M ");
        assert_non_null(path);
        int count = 0, used;
        path += 4;
        while (count < CORNERS &&
               sscanf(path, "%*[ ML]%lf %lf%n", &corners[count][0], &corners[count][1], &used) == 2) {
            path += used;
            count++;
        }
        assert_true(count >= 2 && count <= (shape == 0 ? 400 : shape == 1 ? 2001 : 3));
        free(bytes.at);
        double worst = 0;
        for (int i = 0; i < POINTS; i += 7) {
            double least = INFINITY;
            for (int k = 0; k + 1 < count; k++)
                if (corners[k][0] <= points[i][0] + 2 && corners[k + 1][0] >= points[i][0] - 2)
                    least = fmin(least, distance(points[i], corners[k], corners[k + 1]));
            worst = fmax(worst, least);
        }
        assert_true(worst <= 1.0);
    }
}

TEST(test_words) {
    const notes none = {"", "", "", "", ""};
    canvas *c = canvas_new(CANVAS_PNG, 100, 100, &none);
    pencil p = pencil_make(c, theme_get(0), 1);
    rng r = rng_make("words");
    for (int n = 0; n < 300; n++) {
        char text[400] = "";
        for (uint64_t left = rng_below(&r, 60); left > 0; left--)
            strcat(text, rng_below(&r, 4) == 0 ? " " : rng_below(&r, 5) == 0 ? "\u00fc" : "Mi");
        double width = rng_uniform(&r, 40, 400);
        words w = words_break(&p, text, &p.text, width, 1 + rng_below(&r, 3));
        for (size_t i = 0; i < w.count; i++) {
            char clean[WORDS_TEXT];
            assert_true(canvas_text_width(c, w.lines[i], &p.text) <= width);
            assert_string_equal(w.lines[i], notes_clean(clean, sizeof clean, w.lines[i])); /* no half characters */
        }
    }
    canvas_bytes bytes;
    assert_true(canvas_finish(c, &bytes));
    free(bytes.at);
}

TEST(test_clean) {
    char out[16];
    assert_string_equal(notes_clean(out, sizeof out, "a\xffz\x01\xc3\xbc\xc3"), "a?z?\xc3\xbc?");
    assert_string_equal(notes_clean(out, sizeof out, "\xed\xa0\x80"), "???"); /* a surrogate */
    assert_string_equal(notes_clean(out, 4, "ab\xe2\x82\xac"), "ab");         /* no half a character at the end */
}

TEST(test_format_of) {
    assert_int_equal(canvas_format_of("a.svg"), CANVAS_SVG);
    assert_int_equal(canvas_format_of("folder/a.b.PDF"), CANVAS_PDF);
    assert_int_equal(canvas_format_of("a.png"), CANVAS_PNG);
    assert_int_equal(canvas_format_of(".png"), CANVAS_FORMAT_COUNT);
    assert_int_equal(canvas_format_of("png"), CANVAS_FORMAT_COUNT);
    assert_int_equal(canvas_format_of("a.svgz"), CANVAS_FORMAT_COUNT);
}

TEST(test_palettes) {
    assert_int_equal(theme_pixel(theme_viridis(0)), 0xFF440154);
    assert_int_equal(theme_pixel(theme_viridis(1)), 0xFFFDE725);
    assert_int_equal(theme_pixel(theme_viridis(0.5)), 0xFF21908C);
    double last = -1;
    for (int i = 0; i <= 100; i++) { /* lighter all the way: it survives a grey printer */
        canvas_colour c = theme_viridis(i / 100.0);
        double light = 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b;
        assert_true(light > last);
        last = light;
    }
    for (size_t t = 0; theme_get(t) != NULL; t++) /* what is written can be read */
        assert_true(fabs(theme_get(t)->text.g - theme_get(t)->background.g) > 0.6 &&
                    fabs(theme_get(t)->faint.g - theme_get(t)->background.g) > 0.5);
}
