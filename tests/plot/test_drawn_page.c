/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What all figures share: words that may be too long, sizes, themes, legends of many set-ups, axes of every length. */
#include <cairo.h>
#include <unistd.h>

#include "core/append.h"
#include "drawn.h"
#include "drawn_truth.h"
#include "printed.h"
#include "support.h"

/* ---- Words ------------------------------------------------------------------------------------------------------- */

TEST(titles) {
    drawn *d = drawn_run(&drawn_light, "plot share -F fp16 -m d3d --title 'a < b & \"c\" > d'");
    assert_string_equal(d->title, "a < b & \"c\" > d");
    drawn_description_is(d, " Shown: fp16 d3d.");
    drawn_close(d);
    d = drawn_run(&drawn_light, "plot share -F fp16 -m d3d --title 'One long title after all %s'",
                  "that needs more than a single line of the page, as it goes on and on, for a while");
    assert_string_equal(d->title, "One long title after all that needs more than a single line of the page, as it goes "
                                  "on and on, for a while");
    drawn_close(d);
    d = drawn_run(&drawn_light, "plot share -F fp16 -m d3d --figure-size 320x240 --title 'One long title %s'",
                  "that needs more than two lines of the page, as it goes on and on, until it cannot be shown at all");
    const char *cut = strstr(d->title, "\u2026");
    assert_true(cut != NULL && cut[strlen("\u2026")] == '\0' && cut > d->title + 40 && cut[-1] != ' ');
    drawn_close(d);
}

TEST(metadata) {
    char first[SVG_NOTE], before[SVG_NOTE];
    static const char *const drawn_as[] = {"-n 0.2 --theme dark", "-n 0.2 --theme dark", "-n 0.3 --theme dark"};
    for (int i = 0; i < 3; i++) {
        drawn *d = drawn_run(&drawn_dark, "plot share -F fp16 -m d3d %s", drawn_as[i]);
        const char *data = strstr(d->svg->metadata, "\ndata: ");
        char want[128];
        snprintf(want, sizeof want, "\ncommand: depthprec plot share -F fp16 -m d3d -n %s --theme dark",
                 i < 2 ? "0.2" : "0.3");
        assert_non_null(strstr(d->svg->metadata, want));
        assert_non_null(data);
        assert_int_equal(strspn(data + 7, "0123456789abcdef"), 16);
        snprintf(first, sizeof first, "%.16s", data + 7);
        if (i > 0)
            assert_int_equal(strcmp(first, before) == 0, i == 1);
        snprintf(before, sizeof before, "%s", first);
        drawn_close(d);
    }
}

/* The points of a series as JSON has them, up to those of the next. */
static char *points_of(const char *line, const char *name) {
    char *json = drawn_output("plot interval %s --json", line), key[64];
    snprintf(key, sizeof key, "{\"name\":\"%s\"", name);
    const char *at = strstr(strstr(json, key), "\"points\":");
    char *points = strndup(at, strcspn(at, "]"));
    free(json);
    return points;
}

static double number_after(const char *points, const char *key) {
    return strtod(strstr(points, key) + strlen(key), NULL);
}

/* Curves are those that each has alone, in units of the first; the axes are those that are given, and the metadata tell
 * them. */
TEST(beside) {
    static const char a[] = "-n 0.1 -f 1000 -F unorm24 -m d3d --unit m",
                      b[] = "-n 5 -f 1e6 -F fp32 -m reversed --unit ";
    static const char *const keys[] = {"\"z\":", "\"interval\":"}, *const units[] = {"m", "cm"};
    char both[256], alone[128];
    for (int i = 0; i < 2; i++) {
        snprintf(alone, sizeof alone, "%s%s", b, units[i]);
        snprintf(both, sizeof both, "%s --beside '%s'", a, alone);
        char *own = points_of(alone, "fp32 reversed"), *joined = points_of(both, "B fp32 reversed");
        assert_int_equal(strcmp(own, joined) == 0, i == 0);
        for (int k = 0; k < 2; k++)
            assert_true(fabs(number_after(joined, keys[k]) / number_after(own, keys[k]) - (i == 0 ? 1 : 0.01)) < 1e-12);
        free(own);
        free(joined);
    }
    drawn *d = drawn_run(&drawn_light, "plot interval %s", both);
    const drawn_panel *p = &d->panels[0];
    drawn_legend_is(d, 2, (const char *const[]){"A unorm24 d3d", "B fp32 reversed"});
    drawn_style_is(d, drawn_legend(d, "B"), 1, 1, DRAWN_SQUARE, false);
    assert_px(drawn_px(&p->x, 0.05), p->frame.x0, 0.6);
    assert_px(drawn_px(&p->x, 1e4), p->frame.x1, 0.6);
    drawn_close(d);
    d = drawn_run(&drawn_light, "plot interval %s --axes 1:2000,1e-6:4", both);
    p = &d->panels[0];
    assert_px(drawn_px(&p->x, 1), p->frame.x0, 0.6);
    assert_px(drawn_px(&p->x, 2000), p->frame.x1, 0.6);
    assert_px(drawn_px(&p->y, 1e-6), p->frame.y1, 0.6);
    assert_px(drawn_px(&p->y, 4), p->frame.y0, 0.6);
    assert_non_null(strstr(d->svg->metadata, "\naxes: z log 1 2000, interval log 1e-06 4\n"));
    drawn_close(d);
}

/* Headings of one, two and three lines, the longest first, last or between: each ends above its own frame, and none
 * reaches up to the words above the charts. */
TEST(headings) {
    double frames = 0;
    for (int longest = 0; longest < 3; longest++) {
        chart *c = drawn_sketch(10, 10);
        snprintf(c->subtitle, sizeof c->subtitle, "underneath the title");
        for (int i = 1; i < 3; i++)
            *chart_add_panel(c) = c->panels[0];
        for (int i = 0; i < 3; i++)
            for (int n = i == longest ? 14 : 1; n > 0; n--)
                append(c->panels[i].title, sizeof c->panels[i].title, "heading%d ", i);
        drawn *d = drawn_chart(&drawn_light, c, 640, 480);
        double above = 0;
        int lines[3] = {0};
        for (size_t k = 0; k < d->svg->count; k++)
            if (d->svg->marks[k].kind == SVG_WORDS && strstr(d->svg->marks[k].text, "underneath") != NULL)
                above = d->svg->marks[k].box.y1;
        assert_true(above > 0);
        for (size_t k = 0; k < d->svg->count; k++) {
            const svg_mark *m = &d->svg->marks[k];
            if (m->kind != SVG_WORDS || strncmp(m->text, "heading", 7) != 0)
                continue;
            const int panel = m->text[7] - '0';
            lines[panel]++;
            assert_true(m->box.y0 > above && m->box.y1 < d->panels[panel].frame.y0);
            for (int i = 0; i < 3; i++) /* nor into another panel */
                assert_true(m->box.y0 >= d->panels[i].frame.y1 || m->box.y1 <= d->panels[i].frame.y0 ||
                            m->box.x0 >= d->panels[i].frame.x1 || m->box.x1 <= d->panels[i].frame.x0);
        }
        for (int i = 0; i < 3; i++)
            assert_true(i == longest ? lines[i] > 1 : lines[i] == 1);
        if (longest > 0)
            assert_px(d->panels[0].frame.y0, frames, 0.01); /* all frames leave room for the longest */
        frames = d->panels[0].frame.y0;
        drawn_close(d);
    }
}

/* ---- Sizes ------------------------------------------------------------------------------------------------------- */

TEST(sizes) {
    static const int all[][2] = {{1600, 1000}, {400, 300}, {320, 200}, {2000, 500}, {500, 900}};
    cameras c = cameras_of(drawn_camera(0.1, 1000), "unorm24,fp16", "d3d,reversed");
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        drawn *d =
            drawn_run(&drawn_light, "plot interval --model exact -F unorm24,fp16 -m d3d,reversed --figure-size %dx%d",
                      all[i][0], all[i][1]);
        for (size_t k = 0; k < c.count; k++) {
            const drawn_entry *e = drawn_legend(d, c.names[k]);
            drawn_style_is(d, e, (int)k / 2, (int)k % 2, k < 2 ? DRAWN_DISC : DRAWN_SQUARE, false);
            assert_px(e->marker.width,
                      k < 2 ? 2 * d->scale * (k % 2 == 0 ? 3.6 : 3.2) : 1.8 * d->scale * (k % 2 == 0 ? 3.6 : 3.2),
                      0.02);
            drawn_follows(&d->panels[0], &d->panels[0].y, drawn_curve(d, &d->panels[0], e), true_interval, &c.setups[k],
                          60, 1.5);
        }
        drawn_close(d);
    }
}

/* ---- Many set-ups ------------------------------------------------------------------------------------------------ */

/* Dashes and hollow markers are of reversed mappings, whatever comes first, and of nothing else. */
TEST(dashed_is_reversed) {
    static const struct {
        const char *setups, *names[4];
        int strokes[4];
    } cases[] = {
        {"-F unorm24,fp32 -m reversed,d3d",
         {"unorm24 reversed", "unorm24 d3d", "fp32 reversed", "fp32 d3d"},
         {1, 0, 1, 0}},
        {"-F rg,d16,d24,d32f -m d3d", {"rg linear", "unorm16 d3d", "unorm24 d3d", "fp32 d3d"}, {0}},
        {"-F fp32 -m gl-reversed,log,reversed,d3d",
         {"fp32 gl-reversed", "fp32 log", "fp32 reversed", "fp32 d3d"},
         {1, 0, 3, 2}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        drawn *d = drawn_run(&drawn_light, "plot share %s", cases[i].setups);
        for (size_t k = 0; k < 4; k++) {
            const drawn_entry *e = drawn_legend(d, cases[i].names[k]);
            const bool hollow = e->marker.inside == d->theme->background;
            assert_int_equal(hollow, cases[i].strokes[k] % 2);
            assert_int_equal(e->line->dash_count > 0, cases[i].strokes[k] > 0);
        }
        drawn_close(d);
    }
}

TEST(many) {
    static const char *const mappings = "d3d,gl,reversed,log";
    static const int strokes[] = {0, 2, 1, 4}; /* odd: reversed */
    static const drawn_shape shapes[] = {DRAWN_DISC,     DRAWN_SQUARE,        DRAWN_DIAMOND,
                                         DRAWN_TRIANGLE, DRAWN_TRIANGLE_DOWN, DRAWN_HEXAGON};
    cameras c = cameras_of(drawn_camera(0.1, 1000), "unorm16,unorm20,unorm24,fp16", mappings);
    drawn *d =
        drawn_run(&drawn_light, "plot share -F unorm16,unorm20,unorm24,fp16 -m %s --figure-size 800x700", mappings);
    assert_int_equal(d->entry_count, c.count);
    for (size_t i = 0; i < c.count; i++) {
        const drawn_entry *e = &d->entries[i];
        assert_ptr_equal(drawn_legend(d, c.names[i]), e);
        drawn_style_is(d, e, (int)i / 4, strokes[i % 4], shapes[i / 4], false);
        if (i % 4 > 0) /* those of a format stand together */
            assert_px(e->x, d->entries[i - 1].x, 0.1);
        drawn_follows(&d->panels[0], &d->panels[0].y, drawn_curve(d, &d->panels[0], e), true_share, &c.setups[i], 60,
                      1.5);
    }
    drawn_close(d);
    d = drawn_run(&drawn_light, "plot share -F unorm16,fp16 -m d3d,gl,reversed"); /* 2 lines would do */
    assert_int_equal(d->entry_count, 6);
    for (size_t i = 1; i < 6; i++)
        assert_int_equal(fabs(d->entries[i].x - d->entries[i - 1].x) < 1, i != 3);
    drawn_close(d);
    c = cameras_of(drawn_camera(0.1, 1000), "unorm16,unorm20,unorm24,fp16,fp32,unorm12", "reversed");
    d = drawn_run(&drawn_light, "plot error -F unorm16,unorm20,unorm24,fp16,fp32,unorm12 -m reversed");
    for (size_t i = 0; i < c.count; i++)
        drawn_style_is(d, drawn_legend(d, c.names[i]), (int)i, 0, shapes[i], false);
    drawn_close(d);
}

/* Guarantee and interval in one figure, each with its own name. */
TEST(models) {
    drawn *d = drawn_run(&drawn_light, "plot interval --model auto -F unorm16,unorm24 -m d3d,log --range 100:1000");
    assert_string_equal(d->title, "Z-fighting interval; in the model float, guaranteed separation");
    assert_string_equal(d->y_caption->text, "separation, interval (scene units)");
    assert_non_null(strstr(d->subtitle,
                           "near 0.1, far 1000, perspective, nearest, depths 100 to 1000. Thick: guaranteed in "
                           "binary32 arithmetic. Thin: the lattice of codes alone. Points: "));
    drawn_legend_is(d, 5,
                    (const char *const[]){"unorm16 d3d, exact", "unorm16 log, exact", "unorm24 log, staged",
                                          "unorm24 d3d, float", "unorm24 d3d, float, census"});
    drawn_close(d);
}

/* ---- Axes -------------------------------------------------------------------------------------------------------- */

typedef struct axis_case {
    const char *arguments, *first, *last; /* labels of the depth axis */
    bool log;
    int labels;
} axis_case;

/* Decades by their name, a few decades in between, small ranges in even steps, large numbers in full. */
TEST(axes_of_every_length) {
    static const axis_case cases[] = {
        {"error -F unorm16 -m d3d", "0.1", "1000", true, 5},
        {"error -F unorm16 -m d3d -f 1e6", "10\u207b\u00b9", "10\u2076", true, 8},
        {"error -F fp32 -m reversed -n 1e-6 -f 1e12", "10\u207b\u2076", "10\u00b9\u00b2", true, 10},
        {"error -F unorm16 -m d3d --range 1:30", "1", "20", true, 5},
        {"error -F unorm16 -m d3d --range 100:150", "100", "150", true, 11},
        {"error -F unorm16 -m d3d --range 0.11:0.14", "0.11", "0.14", true, 7},
        {"error -F unorm16 -m d3d --range 0.1100001:0.1100002", "0.1100001", "0.1100002", false, 6},
        {"distribution -F unorm4 -m d3d -n 1000 -f 90000", "10000", "90000", false, 9},
        {"distribution -F unorm4 -m d3d -n 1 -f 20", "2", "20", false, 10},
        {"distribution -F unorm4 -m d3d -n 0.01 -f 0.5", "0.05", "0.5", false, 10},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        drawn *d = drawn_run(&drawn_light, "plot %s", cases[i].arguments);
        const drawn_scale *x = &d->panels[0].x;
        assert_int_equal(x->log, cases[i].log);
        assert_true(x->labels >= 2);
        assert_string_equal(x->at[0]->text, cases[i].first);
        assert_string_equal(x->at[x->labels - 1]->text, cases[i].last);
        assert_int_equal(x->labels, cases[i].labels);
        drawn_close(d);
    }
}

/* An axis without ends of its own is as long as its data, a vertical one a little longer. */
TEST(fitted) {
    chart *c = chart_new();
    assert_non_null(c);
    snprintf(c->title, sizeof c->title, "t");
    snprintf(c->subtitle, sizeof c->subtitle, "s");
    chart_panel *p = chart_add_panel(c);
    p->x = (chart_axis){.label = "x", .key = "x", .unit = ""};
    p->y = (chart_axis){.label = "y", .key = "y", .unit = "m"};
    chart_series *line = chart_add_series(c, p, CHART_LINE, 3);
    snprintf(line->name, sizeof line->name, "line");
    for (int i = 0; i < 3; i++) {
        line->x[i] = 3.5 * i;
        line->y[i] = i == 0 ? 5 : i == 1 ? -3 : 13;
    }
    chart_fit(c);
    drawn *d = drawn_chart(&drawn_dark, c, 800, 500);
    const drawn_panel *q = &d->panels[0];
    assert_px(drawn_px(&q->x, 0), q->frame.x0, 1.5);
    assert_px(drawn_px(&q->x, 7), q->frame.x1, 1.5);
    assert_px(drawn_px(&q->y, 13 + 0.04 * 16), q->frame.y0, 1.5);
    assert_px(drawn_px(&q->y, -3 - 0.04 * 16), q->frame.y1, 1.5);
    const svg_mark *curve = drawn_curve(d, q, &d->entries[0]);
    assert_int_equal(curve->count, 3);
    assert_px(curve->points[1].x, drawn_px(&q->x, 3.5), 1);
    assert_px(curve->points[1].y, drawn_px(&q->y, -3), 1);
    assert_string_equal(d->x_caption->text, "x");
    assert_string_equal(d->y_caption->text, "y (m)");
    drawn_close(d);
}

/* A label stands to the right of its point, to the left where it would leave the frame, and never above the frame. */
TEST(labels_of_points) {
    static const char *const texts[] = {"first", "second", "third", "fourth"};
    static const double at[][2] = {{0.02, 0.5}, {0.5, 0.2}, {0.99, 0.7}, {0.3, 1}};
    chart *c = drawn_sketch(1, 1);
    chart_panel *p = c->panels;
    chart_series *s = chart_add_series(c, p, CHART_POINTS, 4);
    snprintf(s->name, sizeof s->name, "points");
    s->labels = chart_memory(c, 4, sizeof *s->labels);
    for (int i = 0; i < 4; i++) {
        s->x[i] = at[i][0];
        s->y[i] = at[i][1];
        snprintf(s->labels[i], sizeof s->labels[i], "%s", texts[i]);
    }
    drawn *d = drawn_chart(&drawn_light, c, 800, 500);
    const drawn_panel *q = &d->panels[0];
    for (int i = 0; i < 4; i++) {
        const double x = drawn_px(&q->x, at[i][0]), y = drawn_px(&q->y, at[i][1]);
        const svg_mark *words = drawn_words(d, q->frame, texts[i]);
        assert_non_null(words);
        assert_px(i == 2 ? x - words->box.x1 : words->at.x - x, 9, 2);
        if (i < 3)
            assert_px(words->at.y - 0.36 * words->size, y, 1);
        assert_true(words[-1].curved && svg_rgb(words[-1].stroke) == d->theme->background); /* it stands out */
    }
    drawn_close(d);
}

/* ---- Other surfaces ---------------------------------------------------------------------------------------------- */

static uint32_t pixel_of(cairo_surface_t *image, double x, double y) {
    uint32_t pixel;
    const unsigned char *data = cairo_image_surface_get_data(image);
    memcpy(&pixel, data + (ptrdiff_t)floor(y) * cairo_image_surface_get_stride(image) + 4 * (ptrdiff_t)floor(x), 4);
    return pixel & 0xFFFFFF;
}

/* What is drawn is what the name ends in, or else what --type says; a name and a type that part are refused, and so is
 * a name that says nothing alone. */
TEST(types_and_names) {
    static const char *const types[] = {"svg", "pdf", "png"}, *const begins[] = {"<?xml", "%PDF", "\x89PNG"};
    static const char *const names[] = {"a.svg", "a.pdf", "a.png", "a", "a.txt", "-"};
    for (int type = -1; type < 3; type++)
        for (int name = 0; name < (type < 1 ? 6 : 5); name++) { /* what print_of() takes is text */
            const int want = name < 3 ? name : type;
            const char *path = strcmp(names[name], "-") == 0 ? "-" : scratch_file(names[name]);
            remove(path);
            printed p = print_of("plot error -F d16 -m d3d -o %s%s%s", path, type < 0 ? "" : " --type ",
                                 type < 0 ? "" : types[type]);
            if (want < 0 ? name == 5 : type < 0 || type == want) {
                char first[8] = "";
                FILE *in = name == 5 ? fmemopen(p.out, strlen(p.out) + 1, "rb") : fopen(path, "rb");
                if (in == NULL)
                    fail_msg("%s, type %d: %d, %s", path, type, p.status, p.errors);
                assert_true(fread(first, 1, 5, in) > 0 && fclose(in) == 0);
                const char *begin = begins[want < 0 ? 0 : want];
                if (p.status != 0 || strncmp(first, begin, strlen(begin)) != 0)
                    fail_msg("%s, type %d: %d, %s%s", names[name], type, p.status, first, p.errors);
            } else if (p.status != 2 || access(path, F_OK) == 0) {
                fail_msg("%s, type %d: %d, %s", names[name], type, p.status, p.errors);
            }
            printed_free(&p);
        }
}

/* Letters beside an axis are a little wider or narrower there, and what is right of them lies so much farther. */
static bool shows(cairo_surface_t *image, double x, double y, uint32_t colour) {
    bool found = false;
    for (int k = 0; k < 9 * 5; k++)
        found = found || pixel_of(image, x + k % 9 - 4, y + k / 9 - 2) == colour;
    return found;
}

/* The PNG shows what the SVG shows, where it shows it; a PDF is as large, in points. */
TEST(the_same_in_png_and_pdf) {
    char path[2][320], command[400], head[64];
    drawn_marker all[256];
    drawn *d = drawn_run(&drawn_light, "plot share -F unorm24,fp32 -m d3d,reversed");
    for (int i = 0; i < 2; i++) {
        snprintf(path[i], sizeof path[i], "%s/drawn.%s", drawn_folder(), i == 0 ? "png" : "pdf");
        free(drawn_output("plot share -F unorm24,fp32 -m d3d,reversed -o %s", path[i]));
    }
    cairo_surface_t *image = cairo_image_surface_create_from_png(path[0]);
    assert_int_equal(cairo_surface_status(image), CAIRO_STATUS_SUCCESS);
    assert_int_equal(cairo_image_surface_get_width(image), 800);
    assert_int_equal(cairo_image_surface_get_height(image), 500);
    assert_int_equal(pixel_of(image, 1, 1), d->theme->background);
    const size_t count = drawn_markers(d, &d->panels[0], all, 256);
    for (size_t i = 0; i < count; i++) {
        bool hidden = all[i].y < d->panels[0].frame.y0 + 5 || all[i].y > d->panels[0].frame.y1 - 5;
        for (size_t k = i + 1; k < count; k++)
            hidden = hidden || hypot(all[i].x - all[k].x, all[i].y - all[k].y) < 8;
        if (!hidden)
            assert_true(shows(image, all[i].x, all[i].y, all[i].inside));
    }
    assert_true(shows(image, d->panels[0].frame.x0, d->panels[0].frame.y0 + 3, d->theme->frame));
    cairo_surface_destroy(image);
    snprintf(command, sizeof command, "grep -a -o '/MediaBox \\[ [0-9 ]*\\]' %s", path[1]);
    FILE *pipe = popen(command, "r");
    assert_non_null(pipe);
    assert_non_null(fgets(head, sizeof head, pipe));
    assert_int_equal(pclose(pipe), 0);
    assert_string_equal(head, "/MediaBox [ 0 0 600 375 ]\n");
    drawn_close(d);
}

/* ---- Units ------------------------------------------------------------------------------------------------------- */

typedef struct unit_case {
    const char *arguments, *x, *y, *right, *unit; /* right, unit: null without */
} unit_case;

/* Where something says what a scene unit is, the axes and the subtitle say it, and JSON beside its own words. */
TEST(units_of_lengths) {
    static const unit_case cases[] = {
        {"plot error -F unorm24 -m d3d", "eye depth z (scene units)", "worst |decoded depth \u2212 z| (scene units)",
         NULL, NULL},
        {"plot error --preset unreal -F unorm24", "eye depth z (cm)", "worst |decoded depth \u2212 z| (cm)", NULL,
         "cm"},
        {"plot interval -n 10cm -f 1km -F unorm24 -m d3d", "eye depth z (m)", "separation, interval (m)", NULL, "m"},
        {"plot distribution --unit ft -F unorm24 -m d3d", "eye depth z (ft)", "codes, fewest (per ft of depth)", NULL,
         "ft"},
        {"plot share --unit km -F unorm24 -m d3d", "eye depth z (km)",
         "codes between z and far (% of all between the planes)", NULL, "km"},
        {"plot budget --preset unity -F unorm24", "eye depth z (m)", "share of the separation (%)",
         "guaranteed separation (m)", "m"},
        {"plot map --preset unity -F unorm24", "near plane (m)", "far plane (m)", "worst z-fighting interval (m)", "m"},
        {"plot normals --unit in -F unorm24 -m d3d", "eye depth z (in)", "angular error (degrees)", NULL, "in"},
        {"texture --synthetic steps -F unorm16 -m d3d --product eye --unit m", "column (px)", "row (px)",
         "eye depth (m)", "m"},
        {"texture --synthetic sphere -F unorm16 -m d3d --product position:rays --unit cm", "column (px)", "row (px)",
         "coordinate (cm)", "cm"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const unit_case *q = &cases[i];
        char ending[32];
        drawn *d = drawn_run(&drawn_light, "%s", q->arguments);
        assert_string_equal(d->x_caption->text, q->x);
        assert_string_equal(d->y_caption->text, q->y);
        if (q->right != NULL)
            assert_string_equal(d->right_caption->text, q->right);
        snprintf(ending, sizeof ending, ", lengths in %s", q->unit != NULL ? q->unit : "");
        assert_int_equal(strstr(d->subtitle, ending) != NULL, q->unit != NULL);
        svg_free(d->svg);
        free(d);
        if (strncmp(q->arguments, "plot", 4) != 0)
            continue;
        char *text = drawn_output("%s --json", q->arguments), said[32];
        snprintf(said, sizeof said, q->unit != NULL ? "\"unit\":\"%s\",\"data\"" : "\"unit\":null,\"data\"", q->unit);
        assert_non_null(strstr(text, said));
        free(text);
    }
    /* The same numbers, of another unit, are another figure. */
    char *metres = drawn_output("plot share -F unorm16 --unit m --json");
    char *feet = drawn_output("plot share -F unorm16 --unit ft --json");
    assert_int_not_equal(strncmp(strstr(metres, "\"data\""), strstr(feet, "\"data\""), 25), 0);
    free(metres);
    free(feet);
}
