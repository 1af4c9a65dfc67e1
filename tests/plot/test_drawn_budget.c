/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The figure of causes, as drawn, against dp_budget_at(): bands that stand on each other, and the separation. */
#include "drawn.h"
#include "drawn_truth.h"
#include "support.h"

/* The bands up to one of them, from the axis upwards. */
typedef struct stacked {
    const dp_setup *setup;
    dp_budget_terms terms;
    int count;
    dp_cause causes[DP_CAUSE_COUNT];
} stacked;

enum { SAMPLES = 8 };

static bool sampled(const stacked *s, double from, double to, bool separation, double *lo, double *hi) {
    *lo = INFINITY;
    *hi = -INFINITY;
    const double power = exp2(ceil(log2(fmax(from, 1e-12)))); /* where causes step */
    for (int i = -1; i <= SAMPLES; i++) {
        const double at = i < 0 ? fmin(power, to) : from + (to - from) * i / SAMPLES;
        const double z = fmin(fmax(at, s->setup->spec.znear), s->setup->spec.zfar);
        dp_budget b;
        double value = 0;
        assert_int_equal(dp_budget_at(s->setup, z, &s->terms, &b), DP_OK);
        for (int k = 0; k < s->count; k++)
            value += 100 * b.cause[s->causes[k]] / b.separation;
        *lo = fmin(*lo, separation ? b.separation : value);
        *hi = fmax(*hi, separation ? b.separation : value);
    }
    return isfinite(*hi);
}

static bool true_rim(const void *context, double from, double to, double *lo, double *hi) {
    return sampled(context, from, to, false, lo, hi);
}

/* Where nothing behind is certain there is nothing. */
static bool true_guarantee(const void *context, double from, double to, double *lo, double *hi) {
    const stacked *s = context;
    return sampled(s, from, to, true, lo, hi) && *lo < s->setup->spec.zfar - from;
}

static dp_cause cause_of(const char *name) {
    for (int k = 0; k < DP_CAUSE_COUNT; k++)
        if (strcmp(dp_cause_name((dp_cause)k), name) == 0)
            return (dp_cause)k;
    fail_msg("'%s' is no cause", name);
    return DP_CAUSE_COUNT;
}

/* The colour of a band is one of the palette, softened by the paper; which one. */
static int tint_of(const drawn *d, svg_colour c) {
    const uint32_t rgb = svg_rgb(c), paper = d->theme->background;
    for (int k = 0; k < 8; k++) {
        int off = 0;
        for (int shift = 0; shift <= 16; shift += 8) {
            const double own = d->theme->palette[k] >> shift & 255, under = paper >> shift & 255;
            off += fabs((rgb >> shift & 255) - (under + 0.45 * (own - under))) > 1;
        }
        if (off == 0)
            return k;
    }
    fail_msg("a band in %06x, no tint of the palette", rgb);
    return -1;
}

/* Nothing is drawn of a band that is nowhere as thick as a pixel. */
static bool is_thin(const drawn_panel *p, const stacked *s) {
    const stacked last = {s->setup, s->terms, 1, {s->causes[s->count - 1]}};
    for (int i = 0; i < 200; i++) {
        double lo, hi;
        const double z = drawn_at(&p->x, p->frame.x0 + (p->frame.x1 - p->frame.x0) * i / 200);
        if (true_rim(&last, z, z, &lo, &hi) && hi > 1)
            return false;
    }
    return true;
}

/* The band in a panel that looks as the swatch: its upper rim, without the two corners on the axis; empty for none. */
static svg_mark band_of(const drawn *d, const drawn_panel *p, const drawn_entry *e, size_t *order) {
    svg_mark rim = {.count = 0};
    for (size_t i = 0; i < d->svg->count; i++) {
        const svg_mark *m = &d->svg->marks[i];
        if (m->kind != SVG_PATH || m->used != DRAWN_NEW || m->fill.a < 1 || svg_rgb(m->fill) != svg_rgb(e->area->fill))
            continue;
        if (!svg_inside(m->box, p->frame, 1))
            continue;
        assert_int_equal(rim.count, 0);
        rim = *m;
        *order = i;
    }
    if (rim.count == 0)
        return rim;
    for (int k = 0; k < 2 && rim.count > 1; k++) { /* the corners below both ends; an end on the axis has none */
        const svg_point corner = rim.points[rim.count - 1];
        const double end = rim.points[k == 0 ? 0 : rim.count - 2].x;
        rim.count -= fabs(corner.y - p->frame.y1) < 1 && fabs(corner.x - end) < 0.01;
    }
    assert_true(rim.count >= 2);
    return rim;
}

/* A name stands within its band, clear of the line. Returns whether it is there. */
static bool named(const drawn *d, const drawn_panel *p, const drawn_entry *e, const svg_mark *rim,
                  const svg_mark *below, const svg_mark *line) {
    const svg_mark *words = drawn_words(d, p->frame, e->text);
    double top, bottom, least = p->frame.y1;
    if (words == NULL)
        return false;
    assert_int_equal(svg_rgb(words->fill), d->theme->text);
    const svg_box b = words->box;
    assert_true(drawn_reach(rim, b.x0, b.x1, &top, &bottom));
    assert_true(b.y0 > bottom - 0.5);
    if (below != NULL && drawn_reach(below, b.x0, b.x1, &top, &bottom))
        least = top;
    assert_true(b.y1 < least + 0.5);
    if (drawn_reach(line, b.x0, b.x1, &top, &bottom))
        assert_true(b.y1 < top || b.y0 > bottom);
    return true;
}

/* The entry of the separation, behind those of the bands. */
static size_t line_of(const drawn *d) {
    size_t i = 0;
    while (i + 1 < d->entry_count && strcmp(d->entries[i].text, "separation, right axis") != 0)
        i++;
    return i;
}

static void check_line(const drawn *d, const drawn_panel *p, const stacked *s, const svg_mark *line) {
    const svg_mark *under[2];
    svg_mark rim = *line;
    rim.width *= 2.5;
    rim.stroke = d->svg->marks[0].fill;
    drawn_follows(p, &p->second, line, true_guarantee, s, 100, 2);
    assert_int_equal(drawn_strokes(d, p, &rim, under, 2), 1); /* it stands out from the bands */
    assert_true(under[0] < line);
}

/* @return how many bands are named */
static int check_panel(const drawn *d, const drawn_panel *p, const dp_setup *setup, const dp_budget_terms *terms) {
    stacked s = {.setup = setup, .terms = *terms};
    const drawn_entry *last = &d->entries[line_of(d)];
    const svg_mark *line = drawn_curve(d, p, last);
    svg_mark rim = {.count = 0}, below = rim;
    size_t order = SIZE_MAX, next = 0;
    int names = 0;
    assert_px(drawn_px(&p->x, setup->spec.znear), p->frame.x0, 1.5);
    assert_px(drawn_px(&p->x, setup->spec.zfar), p->frame.x1, 2);
    assert_px(drawn_px(&p->y, 0), p->frame.y1, 1);
    assert_px(drawn_px(&p->y, 100), p->frame.y0, 1);
    assert_true(p->x.log && !p->y.log && p->second.log);
    for (size_t i = 0; i < line_of(d); i++) {
        const drawn_entry *e = &d->entries[i];
        s.causes[s.count++] = cause_of(e->text);
        rim = band_of(d, p, e, &next);
        if (rim.count == 0 && is_thin(p, &s)) {
            rim = below;
            continue;
        }
        if (rim.count == 0)
            fail_msg("no band looks as the legend shows '%s'", e->text);
        assert_true(next < order); /* each over those above it */
        order = next;
        drawn_follows(p, &p->y, &rim, true_rim, &s, 100, 2);
        names += named(d, p, e, &rim, below.count > 0 ? &below : NULL, line);
        below = rim;
    }
    assert_px(rim.box.y0, p->frame.y0, 1); /* together they are all of it */
    check_line(d, p, &s, line);
    return names;
}

static bool is_logarithmic(const char *mapping) {
    return strcmp(mapping, "log") == 0 || strcmp(mapping, "osgearth") == 0;
}

/* Every cause that is asked for, and no other, has its place and a colour of its own. */
static void check_legend(const drawn *d, const char *mapping, const dp_budget_terms *terms, bool slanted) {
    static const char *const upwards[] = {"format",      "eye",           "ndc",           "projection",
                                          "composition", "interpolation", "linearization", "snapping",
                                          "set-up",      "scale",         "log2",          "argument"};
    const bool logs = is_logarithmic(mapping), ndc = !logs || strcmp(mapping, "osgearth") == 0; /* of clip z */
    const bool wanted[] = {
        true,    true, ndc,  !logs, terms->world > 0, terms->interpolation > 0, terms->linearize != 0, slanted,
        slanted, logs, logs, logs};
    double last_at = -1;
    unsigned colours = 0;
    for (size_t i = 0; i < line_of(d); i++) {
        assert_non_null(d->entries[i].area);
        const int tint = tint_of(d, d->entries[i].area->fill);
        assert_int_equal(colours >> tint & 1, 0);
        colours |= 1u << tint;
    }
    for (size_t k = 0; k < sizeof upwards / sizeof upwards[0]; k++) {
        double at = -1;
        for (size_t i = 0; i < line_of(d); i++)
            if (strcmp(d->entries[i].text, upwards[k]) == 0)
                at = (double)i;
        assert_int_equal(at >= 0, wanted[k]);
        if (wanted[k]) {
            assert_true(at > last_at);
            last_at = at;
        }
    }
    const drawn_entry *last = &d->entries[line_of(d)];
    assert_string_equal(last->text, "separation, right axis");
    drawn_style_is(d, last, -1, 0, DRAWN_NONE, false);
}

static void check_figure(const drawn_theme *look, const char *formats, const char *mappings, const char *arguments,
                         const dp_budget_terms *terms, bool slanted) {
    dp_spec spec = drawn_camera(0.1, 1000);
    spec.model = is_logarithmic(mappings) ? DP_MODEL_EXACT : DP_MODEL_FLOAT;
    if (slanted)
        spec.triangles = dp_triangles_default();
    cameras c = cameras_of(spec, formats, mappings);
    char shown[2048] = "";
    int names = 0;
    drawn *d = drawn_run(look, "plot budget -F %s -m %s %s", formats, mappings, arguments);
    assert_string_equal(d->title, "Guaranteed separation by cause");
    assert_non_null(strstr(d->subtitle, "near 0.1, far 1000, perspective, nearest, float ieee"));
    assert_string_equal(d->x_caption->text, "eye depth z (scene units)");
    assert_string_equal(d->y_caption->text, "share of the separation (%)");
    assert_string_equal(d->right_caption->text, "guaranteed separation (scene units)");
    assert_int_equal(d->panel_count, c.count);
    check_legend(d, mappings, terms, slanted);
    for (size_t i = 0; i < c.count; i++) {
        const size_t before = strlen(shown);
        assert_string_equal(d->panels[i].heading, c.count > 1 ? c.names[i] : "");
        if (c.count > 1)
            snprintf(shown + before, sizeof shown - before, " %s.", c.names[i]);
        for (size_t k = 0; k <= line_of(d); k++)
            snprintf(shown + strlen(shown), sizeof shown - strlen(shown), "%s %s", k == 0 ? " Shown:" : ";",
                     d->entries[k].text);
        snprintf(shown + strlen(shown), sizeof shown - strlen(shown), ".");
        names += check_panel(d, &d->panels[i], &c.setups[i], terms);
    }
    drawn_description_is(d, shown);
    assert_true(names >= (int)c.count);
    drawn_close(d);
}

TEST(bands_are_the_causes) {
    const dp_budget_terms none = {0}, all = {.world = 10, .interpolation = 2, .linearize = 1};
    const dp_budget_terms world = {.world = 10}, interpolation = {.interpolation = 2}, linearize = {.linearize = 1};
    const dp_budget_terms read_back = {.interpolation = 2, .linearize = 1};
    check_figure(&drawn_light, "unorm24,fp32", "d3d,reversed", "", &none, false);
    check_figure(&drawn_dark, "unorm16", "gl", "--theme dark", &none, false);
    check_figure(&drawn_light, "unorm24", "gl", "--from-origin 10 --interpolation 2 --linearize", &all, false);
    check_figure(&drawn_light, "unorm16", "gl", "--from-origin 10", &world, false);
    check_figure(&drawn_light, "unorm16", "gl", "--interpolation 2", &interpolation, false);
    check_figure(&drawn_light, "unorm16", "gl", "--linearize", &linearize, false);
    check_figure(&drawn_light, "unorm24,fp32", "log", "", &none, false);
    check_figure(&drawn_light, "unorm24,unorm16", "osgearth", "", &none, false);
    check_figure(&drawn_light, "fp32", "reversed", "--viewport 1920x1080", &none, true);
    check_figure(&drawn_light, "fp32", "reversed", "--viewport 1920x1080 --interpolation 2 --linearize", &read_back,
                 true);
}

/* A line through the middle of a band: the name goes to the wider side of it. */
TEST(names_keep_clear_of_lines) {
    enum { POINTS = 200 };
    for (int above = 0; above < 2; above++) {
        chart *c = drawn_sketch(1, 100);
        chart_panel *p = c->panels;
        p->second = (chart_axis){CHART_LINEAR, 0, 100, "z", "z", "", NULL};
        for (int s = 0; s < 3; s++) {
            chart_series *series = chart_add_series(c, p, s < 2 ? CHART_AREA : CHART_LINE, POINTS);
            assert_non_null(series);
            series->style.colour = s < 2 ? s : -1;
            series->second = s == 2;
            snprintf(series->name, sizeof series->name, "%s", s == 0 ? "lower" : s == 1 ? "upper" : "line");
            for (int i = 0; i < POINTS; i++) {
                series->x[i] = i / (POINTS - 1.0);
                series->y[i] = s == 0 ? 60 : s == 1 ? 40 : above ? 33 : 27;
            }
        }
        drawn *d = drawn_chart(&drawn_light, c, 800, 500);
        const drawn_panel *q = &d->panels[0];
        const svg_mark *lower = drawn_words(d, q->frame, "lower"), *upper = drawn_words(d, q->frame, "upper");
        assert_true(lower != NULL && upper != NULL);
        assert_px(svg_middle_y(lower->box), drawn_px(&q->y, above ? 16 : 44), 8);
        assert_px(svg_middle_y(upper->box), drawn_px(&q->y, 80), 4);
        drawn_close(d);
    }
}

/* Where there is no number there is no band. */
TEST(gaps_stay_open) {
    chart *c = drawn_sketch(10, 100);
    chart_panel *p = c->panels;
    chart_series *s = chart_add_series(c, p, CHART_AREA, 11);
    assert_non_null(s);
    snprintf(s->name, sizeof s->name, "band");
    for (int i = 0; i < 11; i++) {
        s->x[i] = i;
        s->y[i] = i == 5 ? NAN : 50;
    }
    drawn *d = drawn_chart(&drawn_light, c, 800, 500);
    const drawn_panel *q = &d->panels[0];
    size_t bands = 0;
    for (size_t i = 0; i < d->svg->count; i++) {
        const svg_mark *m = &d->svg->marks[i];
        if (m->kind != SVG_PATH || m->used != DRAWN_NEW || m->fill.a < 1 || !svg_inside(m->box, q->frame, 1))
            continue;
        bands++;
        assert_true(m->box.x1 < drawn_px(&q->x, 4) + 1 || m->box.x0 > drawn_px(&q->x, 6) - 1);
        assert_px(m->box.y0, drawn_px(&q->y, 50), 1);
        assert_px(m->box.y1, q->frame.y1, 1);
    }
    assert_int_equal(bands, 2);
    drawn_words(d, q->frame, "band");
    drawn_close(d);
}
