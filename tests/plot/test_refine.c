/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The lines that figures draw, against one certified value for each pixel column; and how little it took. */
#include "depthprec/depthprec.h"
#include "named.h"
#include "plot/envelope.h"
#include "plot/figure.h"
#include "support.h"

enum { COLUMNS = 480, ROWS = 320, PARTS = 8, BANDS = 4 };

static const char *const names[] = {"curve"};
static const char *const formats[] = {"fp16", "fp32", "unorm16", "unorm24", "unorm8", "float3.3b5", "float5.10"};

typedef struct asked {
    dp_setup setup;
    figure_request request;
} asked;

static void random_request(rng *r, asked *a, dp_model model) {
    const bool infinite = rng_below(r, 4) == 0;
    dp_spec spec = dp_spec_default();
    dp_format format[2];
    assert_true(dp_format_parse(formats[rng_below(r, 7)], format) == 1);
    spec.format = format[0];
    spec.znear = rng_log(r, 1e-3, 10);
    spec.zfar = infinite ? (double)INFINITY : spec.znear * rng_log(r, 2, 1e7);
    spec.mapping = (dp_mapping)rng_below(r, infinite || model == DP_MODEL_FLOAT ? 4 : DP_MAPPING_COUNT);
    spec.ortho = !infinite && spec.mapping < DP_MAPPING_LINEAR && rng_below(r, 4) == 0;
    spec.model = model;
    assert_int_equal(dp_setup_init(&a->setup, &spec), DP_OK);
    a->request = (figure_request){.setups = &a->setup,
                                  .count = 1,
                                  .names = names,
                                  .lo = NAN,
                                  .hi = NAN,
                                  .at = NAN,
                                  .columns = COLUMNS,
                                  .rows = ROWS};
}

static const char *label(const asked *a) {
    static char text[160];
    const dp_spec *s = &a->setup.spec;
    snprintf(text, sizeof text, "%s %s %s %s near %a far %a", s->format.name, dp_mapping_get(s->mapping)->name,
             dp_model_name(s->model), s->ortho ? "ortho" : "persp", s->znear, s->zfar);
    return text;
}

static chart *build(const asked *a, const char *figure) {
    chart *c = chart_new();
    assert_non_null(c);
    assert_null(figure_find(figure)->build(&a->request, c));
    assert_false(chart_failed(c));
    return c;
}

/* The value that a line shows at x, on its axes; INFINITY where it has left through the top, NaN in a gap. */
static double line_at(const chart_axis *x_axis, const chart_axis *y_axis, const chart_series *s, double x) {
    const double at = chart_axis_share(x_axis, x);
    size_t before = 0; /* a point that is not right of x */
    for (size_t step = s->count; step > 0; step /= 2)
        while (before + step < s->count && s->x[before + step] <= x)
            before += step;
    for (size_t i = before > 0 ? before - 1 : 0; i + 1 < s->count; i++) {
        const double a = chart_axis_share(x_axis, s->x[i]), b = chart_axis_share(x_axis, s->x[i + 1]);
        if (!(at <= b + 1e-12))
            continue;
        const double y = chart_axis_share(y_axis, s->y[i]), to = chart_axis_share(y_axis, s->y[i + 1]);
        if (fabs(at - a) < 1e-9)
            return y;
        if (fabs(at - b) < 1e-9)
            return to;
        return y == to ? y : y + (to - y) * (at - a) / (b - a);
    }
    return chart_axis_share(y_axis, s->y[s->count - 1]);
}

/* In pixels of the figure; 0 where both are infinite or missing alike. */
static double pixels_off(const chart_axis *y_axis, double drawn, double want) {
    const double share = chart_axis_share(y_axis, want);
    if (drawn == share || (isnan(drawn) && isnan(share)))
        return 0;
    return fabs(drawn - share) * ROWS;
}

/* The greatest interval, and error over whole cells, of a column, from parts of it that know nothing of each other. */
static void column_truth(const dp_setup *setup, double from, double to, double *interval, double *error) {
    /* Knowledge of staged cells is a bound, and of a column a coarser one than of its parts. */
    const int parts = setup->spec.model == DP_MODEL_EXACT ? PARTS : 1;
    *interval = *error = 0;
    double left = from;
    for (int part = 1; part <= parts; part++) {
        const double right = refine_edge(CHART_LOG, from, to, part, parts);
        const double ends[2] = {from, to};
        dp_worst w;
        assert_int_equal(dp_worst_over(setup, left, right, &w), DP_OK);
        *interval = fmax(*interval, w.interval);
        *error = fmax(*error, w.error);
        for (int k = 0; k < 2; k++) { /* the cells at the ends count whole */
            const dp_cell cell = dp_cell_of(setup, dp_code(setup, ends[k]));
            *error = isinf(cell.hi) ? (double)INFINITY
                                    : fmax(*error, fmax(fabs(dp_error(setup, cell.code, cell.lo)),
                                                        fabs(dp_error(setup, cell.code, cell.hi))));
        }
        left = right;
    }
}

static void envelopes(rng *r, tally *t, dp_model model, size_t *spent, size_t *full) {
    asked a;
    random_request(r, &a, model);
    chart *c[2] = {build(&a, "interval"), build(&a, "error")};
    double lo, hi;
    figure_range(&a.request, &lo, &hi);
    for (int k = 0; k < COLUMNS; k++) {
        const double from = refine_edge(CHART_LOG, lo, hi, k, COLUMNS),
                     to = refine_edge(CHART_LOG, lo, hi, k + 1, COLUMNS);
        double want[2];
        column_truth(&a.setup, from, to, &want[0], &want[1]);
        for (int f = 0; f < 2; f++) {
            const chart_panel *panel = &c[f]->panels[0];
            const double drawn = line_at(&panel->x, &panel->y, &panel->series[0], sqrt(from) * sqrt(to));
            const double off = pixels_off(&panel->y, drawn, want[f]);
            TALLY(t, off <= 0.5 + 1e-6, "%s, %s, column %d: %g px off", label(&a), f == 0 ? "interval" : "error", k,
                  off);
        }
    }
    for (int f = 0; f < 2; f++) {
        *spent += c[f]->evaluations;
        *full += c[f]->places;
        chart_free(c[f]);
    }
}

TEST(envelopes_are_drawn_to_half_a_pixel) {
    rng r = rng_make("envelopes");
    tally t = {.name = "envelopes"};
    size_t spent = 0, full = 0;
    for (uint64_t n = test_cases(40, 200, 4000); n > 0; n--)
        envelopes(&r, &t, n % 3 == 0 ? DP_MODEL_STAGED : DP_MODEL_EXACT, &spent, &full);
    print_message("# %zu evaluations, %zu with one a column\n", spent, full);
    tally_end(&t);
}

typedef double (*point_value)(const asked *a, int series, double z);

static double share_of(const asked *a, int series, double z) {
    const dp_setup *s = &a->setup;
    const double first = dp_code(s, s->spec.znear), last = dp_code(s, s->spec.zfar);
    (void)series;
    return last == first ? 0 : 100 * fabs(dp_code(s, z) - last) / fabs(last - first);
}

/* The upper rim of a band: its share and those of the bands below; behind the bands the separation. */
static double rim_of(const asked *a, int series, double z) {
    static const dp_cause order[BANDS] = {DP_CAUSE_FORMAT, DP_CAUSE_EYE, DP_CAUSE_NDC, DP_CAUSE_PROJECTION};
    dp_budget b;
    assert_int_equal(dp_budget_at(&a->setup, z, NULL, &b), DP_OK);
    double sum = 0;
    for (int k = 0; k <= series && k < BANDS; k++)
        sum += b.cause[order[k]];
    return series == BANDS ? b.separation : isfinite(b.separation) ? 100 * sum / b.separation : (double)NAN;
}

/* Points of a curve on the edges of the columns; bands are added up as they are drawn. */
static void check_points(tally *t, const asked *a, const char *figure, int series, point_value value) {
    chart *c = build(a, figure);
    const chart_panel *panel = &c->panels[0];
    const chart_series *shown = &panel->series[series];
    const chart_axis *y = shown->second ? &panel->second : &panel->y;
    chart_series rim = *shown;
    rim.y = chart_memory(c, rim.count, sizeof *rim.y);
    for (size_t i = 0; i < rim.count; i++) {
        rim.y[i] = shown->y[i];
        for (int k = 0; k < series && shown->kind == CHART_AREA; k++)
            rim.y[i] += panel->series[k].y[i];
    }
    double lo, hi;
    figure_range(&a->request, &lo, &hi);
    for (int k = 0; k <= COLUMNS; k++) {
        const double z = refine_edge(CHART_LOG, lo, hi, k, COLUMNS);
        const double want =
            z > shown->certain_to ? (double)NAN : value(a, series, z); /* where it ends: test_figure_ends.c */
        const double off = pixels_off(y, line_at(&panel->x, y, &rim, z), want);
        TALLY(t, off <= 0.5 + 1e-6, "%s, %s %d at %a: %g px off", label(a), figure, series, z, off);
    }
    TALLY(t, c->evaluations <= c->places, "%s, %s: %zu evaluations", label(a), figure, c->evaluations);
    chart_free(c);
}

TEST(points_are_drawn_to_half_a_pixel) {
    rng r = rng_make("points");
    tally t = {.name = "points"};
    for (uint64_t n = test_cases(40, 150, 4000); n > 0; n--) {
        asked a;
        random_request(&r, &a, DP_MODEL_EXACT);
        check_points(&t, &a, "share", 0, share_of);
        random_request(&r, &a, DP_MODEL_FLOAT);
        for (int k = 0; k <= BANDS; k++)
            check_points(&t, &a, "budget", k, rim_of);
    }
    tally_end(&t);
}

/* Where nothing jumps a curve takes a handful of points; where a float's step does, a few for each power of two. */
TEST(smooth_curves_take_few_evaluations) {
    static const struct {
        const char *format;
        dp_mapping mapping;
        size_t most;
    } known[] = {{"unorm24", DP_MAPPING_D3D, 20},    {"unorm24", DP_MAPPING_REVERSED, 20},
                 {"unorm24", DP_MAPPING_LINEAR, 20}, {"unorm24", DP_MAPPING_LOG, 60},
                 {"fp32", DP_MAPPING_D3D, 60},       {"fp32", DP_MAPPING_REVERSED, 160}};
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        rng r = rng_make("smooth");
        asked a;
        dp_format format[2];
        random_request(&r, &a, DP_MODEL_EXACT);
        dp_spec spec = dp_spec_default();
        dp_format_parse(known[i].format, format);
        spec.format = format[0];
        spec.mapping = known[i].mapping;
        assert_int_equal(dp_setup_init(&a.setup, &spec), DP_OK);
        chart *c = build(&a, "interval");
        if (c->evaluations > known[i].most)
            fail_msg("%s: %zu evaluations", label(&a), c->evaluations);
        assert_int_equal(c->places, COLUMNS);
        chart_free(c);
    }
}

/* The guarantee of a column is certified, and no depth in it has a larger separation. */
static void check_separations(tally *t, rng *r, const asked *a) {
    chart *c = build(a, "interval");
    const chart_panel *panel = &c->panels[0];
    double lo, hi;
    figure_range(&a->request, &lo, &hi);
    for (int k = 0; k < COLUMNS; k++) {
        const double from = refine_edge(CHART_LOG, lo, hi, k, COLUMNS);
        const double to = refine_edge(CHART_LOG, lo, hi, k + 1, COLUMNS), z = rng_uniform(r, from, to);
        const chart_series *shown = &panel->series[1];
        const double drawn = line_at(&panel->x, &panel->y, shown, sqrt(from) * sqrt(to));
        const double end = shown->certain_to < to ? shown->certain_to : to;
        dp_separation_worst w = {.bound = (double)NAN};
        if (!(from > end))
            assert_int_equal(dp_separation_over(&a->setup, from, end, 0, &w), DP_OK);
        const double off = pixels_off(&panel->y, drawn, w.bound);
        TALLY(t, off <= 0.5 + 1e-6, "%s, column %d: %g px off", label(a), k, off);
        const double above = chart_axis_share(&panel->y, dp_separation(&a->setup, z)) - drawn;
        TALLY(t, z > end || !(above * ROWS > 0.5 + 1e-6), "%s at %a: %g px above", label(a), z, above * ROWS);
    }
    chart_free(c);
}

TEST(separations_are_drawn_to_half_a_pixel) {
    rng r = rng_make("separations");
    tally t = {.name = "separations"};
    for (uint64_t n = test_cases(20, 100, 2000); n > 0; n--) {
        asked a;
        random_request(&r, &a, DP_MODEL_FLOAT);
        check_separations(&t, &r, &a);
    }
    tally_end(&t);
}

/* Checks a random request, with this camera in place of its own. */
static void check_camera(tally *t, rng *r, dp_mapping mapping, double znear, double zfar) {
    asked a;
    random_request(r, &a, DP_MODEL_FLOAT);
    dp_spec spec = dp_spec_default();
    spec.format = a.setup.spec.format;
    spec.mapping = mapping;
    spec.model = DP_MODEL_FLOAT;
    spec.znear = znear;
    spec.zfar = zfar;
    assert_int_equal(dp_setup_init(&a.setup, &spec), DP_OK);
    check_separations(t, r, &a);
}

/* With near at +1 of [-1, 1] it steps where the eye depth has a power of two. */
TEST(separations_of_signed_reversed_cameras) {
    rng r = rng_make("signed reversed separations");
    tally t = {.name = "signed, reversed"};
    for (uint64_t n = test_cases(40, 80, 1000); n > 0; n--)
        check_camera(&t, &r, DP_MAPPING_GL_REVERSED, rng_log(&r, 0.05, 2.0), INFINITY);
    tally_end(&t);
}

/* Far behind near a separation is wider than a column. */
TEST(separations_wider_than_columns) {
    rng r = rng_make("wide separations");
    tally t = {.name = "wide"};
    for (uint64_t n = test_cases(40, 80, 1000); n > 0; n--) {
        const dp_mapping mapping = rng_below(&r, 2) ? DP_MAPPING_GL : DP_MAPPING_D3D;
        const double znear = rng_log(&r, 0.001, 10.0), share = rng_log(&r, 5e5, 8e6);
        check_camera(&t, &r, mapping, znear, znear * share);
    }
    tally_end(&t);
}

/* ---- Refinement itself, on curves that are known ---- */

typedef struct known_curve {
    double jump; /* 0 before, 1 behind */
    double bend;
    int calls;
} known_curve;

static void sample_known(const void *context, double from, double to, refine_sample *out) {
    const known_curve *k = context;
    ((known_curve *)context)->calls++;
    *out = (refine_sample){.y = {k->bend * from * from + (to >= k->jump)}};
}

static refine_request known_request(const known_curve *k) {
    return (refine_request){.lo = 0,
                            .hi = 1,
                            .columns = COLUMNS,
                            .rows = ROWS,
                            .values = 1,
                            .axis = {{.lo = 0, .hi = 2}},
                            .sample = sample_known,
                            .context = k};
}

/* A jump is between neighbours, known to be there or not; a straight line takes five points and both its ends' next. */
TEST(jumps_are_found) {
    rng r = rng_make("jumps");
    tally t = {.name = "jumps"};
    for (int n = 0; n < 500; n++) {
        known_curve k = {.jump = rng_uniform(&r, 0, 1), .bend = n % 2 == 0 ? 0 : rng_uniform(&r, -1, 1)};
        refine_request q = known_request(&k);
        double x[COLUMNS + 1], y[COLUMNS + 1];
        chart *c = chart_new();
        refine curve;
        if (n % 4 < 2) {
            q.knots = &k.jump;
            q.knot_count = 1;
        }
        assert_true(refine_begin(&curve, &q, c));
        refine_finish(&curve);
        refine_take(&curve, 0, x, y);
        for (size_t i = 1; i < curve.points; i++)
            TALLY(&t, (x[i] >= k.jump) == (x[i - 1] >= k.jump) || x[i] - x[i - 1] < 1.5 / COLUMNS, "jump at %a: %a %a",
                  k.jump, x[i - 1], x[i]);
        TALLY(&t, (size_t)k.calls == c->evaluations && curve.points <= 80, "%d calls, %zu evaluations", k.calls,
              c->evaluations);
        chart_free(c);
    }
    tally_end(&t);
}

TEST(a_straight_line_takes_seven_points) {
    known_curve k = {.jump = 2};
    refine_request q = known_request(&k);
    chart *c = chart_new();
    refine curve;
    assert_true(refine_begin(&curve, &q, c));
    refine_finish(&curve);
    assert_int_equal(curve.points, 7);
    chart_free(c);
}
