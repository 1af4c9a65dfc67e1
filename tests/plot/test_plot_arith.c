/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The figures about binary32 arithmetic show the library's numbers; bands stop where there are none. */
#include "depthprec/depthprec.h"
#include "draw/area.h"
#include "draw/draw.h"
#include "named.h"
#include "plot/figure.h"
#include "setups.h"
#include "support.h"

enum { COLUMNS = 200 };

static dp_setup make(const char *format, dp_mapping mapping, dp_model model) {
    return SETUP(format, .mapping = mapping, .model = model);
}

static chart *build(const char *figure, const figure_request *request) {
    chart *c = chart_new();
    assert_non_null(c);
    assert_null(figure_find(figure)->build(request, c));
    assert_false(chart_failed(c));
    return c;
}

static const chart_series *find(const chart_panel *panel, const char *name) {
    for (size_t i = 0; i < panel->series_count; i++)
        if (strcmp(panel->series[i].name, name) == 0)
            return &panel->series[i];
    return NULL;
}

TEST(budget_shows_the_library) {
    const dp_setup setups[] = {make("unorm24", DP_MAPPING_GL, DP_MODEL_FLOAT),
                               make("fp16", DP_MAPPING_D3D, DP_MODEL_FLOAT)};
    const char *names[] = {"one", "two"};
    const figure_request request = {.setups = setups,
                                    .count = 2,
                                    .names = names,
                                    .lo = NAN,
                                    .hi = NAN,
                                    .at = NAN,
                                    .terms = {.world = 10.0, .linearize = 1},
                                    .columns = COLUMNS};
    chart *c = build("budget", &request);
    assert_int_equal(c->panel_count, 2);
    for (size_t p = 0; p < 2; p++) {
        const chart_series *line = find(&c->panels[p], "separation, right axis");
        assert_non_null(line);
        assert_null(find(&c->panels[p], "interpolation")); /* was not asked for */
        size_t unbounded = 0;
        for (size_t k = 0; k < line->count; k++) {
            dp_budget b;
            double sum = 0;
            assert_int_equal(dp_budget_at(&setups[p], line->x[k], &request.terms, &b), DP_OK);
            assert_true(line->x[k] > line->certain_to ? isnan(line->y[k]) : line->y[k] == b.separation);
            for (int cause = 0; cause < DP_CAUSE_COUNT; cause++) {
                const chart_series *band = find(&c->panels[p], dp_cause_name((dp_cause)cause));
                if (band == NULL)
                    continue;
                assert_true(band->kind == CHART_AREA && band->x[k] == line->x[k]);
                /* a thickness is the difference of two rims of at most 100 %, each a few roundings off */
                assert_true(isinf(b.separation) || fabs(band->y[k] - 100 * b.cause[cause] / b.separation) <= 1e-12);
                sum += band->y[k];
            }
            assert_true(isinf(b.separation) ? isnan(sum) : fabs(sum - 100) < 1e-9);
            unbounded += isinf(b.separation) ? 1 : 0;
        }
        assert_true(p == 0 ? unbounded == 0 : unbounded > 0);
    }
    chart_free(c);
}

TEST(interval_shows_both) {
    const dp_setup setups[] = {make("unorm24", DP_MAPPING_D3D, DP_MODEL_FLOAT),
                               make("unorm24", DP_MAPPING_LOG, DP_MODEL_STAGED)};
    const dp_setup exact[] = {make("unorm24", DP_MAPPING_D3D, DP_MODEL_EXACT), setups[1]};
    const char *names[] = {"a", "b"};
    figure_request request = {
        .setups = setups, .count = 2, .names = names, .lo = NAN, .hi = NAN, .at = NAN, .columns = COLUMNS};
    chart *c = build("interval", &request);
    request.setups = exact;
    chart *lattice = build("interval", &request);
    const chart_series *bound = find(&c->panels[0], "a"), *behind = find(&c->panels[0], "a, lattice");
    assert_non_null(bound);
    assert_non_null(behind);
    assert_true(behind->style.thin && behind->unlisted && !bound->style.thin && !bound->unlisted);
    /* The line shows the certified largest separation of a column: no less than that of the depth itself, which is
     * refined to 3 %, and no more than that of the columns around it. */
    const double znear = setups[0].spec.znear, zfar = setups[0].spec.zfar, column = pow(zfar / znear, 2.0 / COLUMNS);
    for (size_t k = 0; k < bound->count; k++) {
        const double x = bound->x[k];
        dp_separation_worst over;
        assert_int_equal(dp_separation_over(&setups[0], fmax(x / column, znear), fmin(x * column, zfar), 0, &over),
                         DP_OK);
        assert_true(bound->y[k] >= dp_separation(&setups[0], x) / 1.03);
        assert_true(bound->y[k] <= over.bound * (1 + 0x1p-9));
    }
    const chart_series *staged = find(&c->panels[0], "b"), *exactly = lattice->panels[0].series;
    assert_true(behind->count == exactly[0].count && staged->count == exactly[1].count);
    for (size_t k = 0; k < behind->count; k++)
        assert_true(behind->x[k] == exactly[0].x[k] && behind->y[k] == exactly[0].y[k]);
    for (size_t k = 0; k < staged->count; k++)
        assert_true(staged->x[k] == exactly[1].x[k] && staged->y[k] == exactly[1].y[k]);
    assert_non_null(strstr(c->subtitle, "Thin: the lattice of codes alone"));
    assert_null(strstr(lattice->subtitle, "Thin"));
    chart_free(c);
    chart_free(lattice);
}

/* Both axes fit their own series alone. */
TEST(axes_are_fitted_apart) {
    const dp_setup setup = make("unorm24", DP_MAPPING_D3D, DP_MODEL_FLOAT);
    const char *name = "a";
    const figure_request request = {
        .setups = &setup, .count = 1, .names = &name, .lo = 1, .hi = 100, .at = NAN, .columns = COLUMNS};
    chart *c = build("budget", &request);
    const chart_panel *panel = &c->panels[0];
    const chart_series *line = find(panel, "separation, right axis");
    assert_true(panel->y.lo == 0 && panel->y.hi == 100);
    assert_true(panel->second.lo < line->y[0] && panel->second.lo > line->y[0] / 2);
    assert_true(panel->second.hi > line->y[line->count - 1] && panel->second.hi < 2 * line->y[line->count - 1]);
    chart_free(c);
}

/* Where a band has no value it is not drawn: each is two shapes, and a third in the legend. */
TEST(a_gap_parts_a_band) {
    chart *c = chart_new();
    assert_non_null(c);
    chart_panel *panel = chart_add_panel(c);
    panel->x = (chart_axis){CHART_LINEAR, 0, 100, "x", "x", "", NULL};
    panel->y = (chart_axis){CHART_LINEAR, 0, 100, "y", "y", "", NULL};
    for (int band = 0; band < 2; band++) {
        chart_series *s = chart_add_series(c, panel, CHART_AREA, 101);
        assert_non_null(s);
        s->style.colour = band;
        snprintf(s->name, sizeof s->name, "band %d", band);
        for (int i = 0; i <= 100; i++) {
            s->x[i] = i;
            s->y[i] = i > 50 && i < 76 ? (double)NAN : band == 0 ? 60 : 40;
        }
    }
    canvas_bytes bytes;
    const theme *t = theme_get(0);
    assert_true(draw_chart(c, t, CANVAS_SVG, 800, 500, "test", &bytes));
    char *svg = calloc(bytes.size + 1, 1), tint[64];
    assert_non_null(svg);
    memcpy(svg, bytes.at, bytes.size);
    for (int band = 0; band < 2; band++) {
        int found = 0;
        snprintf(tint, sizeof tint, "fill:rgb(%d", (int)(100 * area_tint(t, band).r));
        for (char *at = strstr(svg, tint); at != NULL; at = strstr(at + 1, tint))
            found++;
        assert_int_equal(found, 3);
    }
    free(svg);
    free(bytes.at);
    chart_free(c);
}
