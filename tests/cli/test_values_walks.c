/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The numbers of the figures pareto and stability, where the measuring is replaced: see measured.h. */
#include "measured.h"
#include "named.h"
#include "plot/figure.h"

static void want_axis(values *v, const char *axis, const char *key, const char *label, const char *unit,
                      const char *scale) {
    values_under(v, "%s.", axis);
    want(v, "key=%s label=%s unit=%s scale=%s", key, label, unit, scale);
}

/* The digest and the subtitle are what they are; the first is tested with the drawing, the second is read here. */
static void want_head(values *v, const json_t *root, const char *figure, const char *title) {
    values_under(v, "%s", "");
    want(v, "figure=%s title=%s", figure, title);
    want_text(v, "unit", NULL);
    want(v, "data=%s subtitle=%s", text_at(root, "data"), text_at(root, "subtitle"));
}

static void want_point(values *v, size_t panel, size_t series, size_t point, const char *x, double at, const char *y,
                       double is) {
    values_under(v, "panels[%zu].series[%zu].points[%zu].", panel, series, point);
    want_number(v, x, at);
    want_number(v, y, is);
}

static size_t want_times(values *v, size_t series, const char *name, int front, const size_t *order, size_t count) {
    size_t n = 0;
    for (size_t i = 0; i < count; i++) {
        const bench_result *r = &timed[order != NULL ? order[i] : i];
        if (front >= 0 && r->front != (front == 1))
            continue;
        want_point(v, 0, series, n++, "time", r->ns, "error", r->measured.worst.relative);
        if (front >= 0)
            want_text(v, "label", r->row->name);
    }
    values_under(v, "panels[0].series[%zu].", series);
    want_text(v, "name", name);
    return series + 1;
}

/* Those that are proven are walked from the worst error found to the bound. */
static size_t want_bars(values *v, size_t series, size_t count) {
    size_t n = 0;
    for (size_t i = 0; i < count; i++) {
        const bench_result *r = &timed[i];
        if (isnan(r->bound))
            continue;
        want_point(v, 0, series, n++, "time", r->ns, "error", r->measured.worst.relative);
        want_point(v, 0, series, n++, "time", r->ns, "error", r->bound);
    }
    values_under(v, "panels[0].series[%zu].", series);
    want_text(v, "name", "from the worst found to the bound");
    return series + 1;
}

/* From the least time to that of a quarter of the turns; then the line of moving bytes, over the whole axis. */
static void want_spread(values *v, size_t series, size_t count) {
    for (size_t i = 0; i < count; i++) {
        const bench_result *r = &timed[i];
        const double error = r->measured.worst.relative;
        want_point(v, 0, series, 2 * i, "time", r->ns, "error", error);
        want_point(v, 0, series, 2 * i + 1, "time", r->ns * (1 + r->spread), "error", error);
    }
    values_under(v, "panels[0].series[%zu].", series);
    want_text(v, "name", "spread of the times");
    for (size_t k = 0; k < 2; k++) /* a time and no error */
        want_point(v, 0, series + 1, k, "time", timed[0].limit, "error", (double)NAN);
    values_under(v, "panels[0].series[%zu].", series + 1);
    want_text(v, "name", "moving the same bytes");
}

static int by_time(const void *a, const void *b) {
    const double x = timed[*(const size_t *)a].ns, y = timed[*(const size_t *)b].ns;
    return (x > y) - (x < y);
}

TEST(pareto) {
    const method_family_row *family = method_family_find("worst"); /* relative errors, no pipeline */
    values v = values_of("plot");
    char *text = command_output(cmd_plot, 0, "plot pareto worst --json -F d16 -n 0.2 -f 800 --title a\\\\b\"c\"d");
    json_t *root = json_of(text);
    size_t order[BENCH_METHODS_MAX], count = 0, fronts = 0;
    for (size_t i = 0; i < *family->method_count; i++)
        count += method_speaks(&family->methods[i], asked_which);
    for (size_t i = 0; i < count; i++)
        if (timed[i].front)
            order[fronts++] = i;
    qsort(order, fronts, sizeof order[0], by_time);
    want_head(&v, root, "pareto", "a\\\\b\"c\"d");
    values_under(&v, "panels[0].");
    want_text(&v, "title", "");
    assert_non_null(strstr(text_at(root, "subtitle"), "near 0.2, far 800"));
    want_axis(&v, "x", "time", "time per element", "ns", "log");
    want_axis(&v, "y", "error", "worst error", family->measure, "log");
    size_t series = want_times(&v, 0, "front", -1, order, fronts);
    series = want_bars(&v, series, count);
    series = want_times(&v, series, "dominated", 0, NULL, count);
    series = want_times(&v, series, "on the Pareto front", 1, NULL, count);
    want_spread(&v, series, count);
    check_json_text(&v, text);
    json_decref(root);
    free(text);
    values_free(&v);
}

/* A panel for each family, in its first case; in the last what was timed last. */
TEST(pareto_of_all) {
    char *text = command_output(cmd_plot, 0, "plot pareto --json -n 0.2 -f 800");
    json_t *root = json_of(text);
    assert_non_null(strstr(text_at(root, "subtitle"), "near 0.2, far 800"));
    assert_int_equal(json_array_size(json_object_get(root, "panels")), METHOD_FAMILY_COUNT);
    for (size_t i = 0; i < METHOD_FAMILY_COUNT; i++) {
        const method_family_row *family = method_family_get(i);
        char title[192];
        const bool relative = strcmp(family->measure, "relative error") == 0;
        snprintf(title, sizeof title, "%s, %s%s%s", family->name, family->cases[0].name, relative ? "" : ": ",
                 relative ? "" : family->measure);
        assert_string_equal(text_at(root, "panels[%zu].title", i), title);
    }
    assert_true(asked_which == 0 && asked.spec.znear == 0.2 && asked.spec.zfar == 800);
    for (size_t i = 0, k = 0; i < *normal_family.method_count; i++)
        if (timed[i].front)
            assert_true(number_at(root, "panels[%d].series[0].points[%zu].time", METHOD_FAMILY_COUNT - 1, k++) > 0);
    json_decref(root);
    free(text);
    for (size_t i = 0; i < 2; i++) {
        printed p = print_of("plot pareto --json %s", i == 0 ? "-F d24" : "-m gl");
        assert_true(p.status == EXIT_USAGE && strstr(p.errors, "needs one family: plot pareto FAMILY") != NULL);
        printed_free(&p);
    }
}

/* A panel for each format that has encoders, or those that are named, whatever the mapping; each method that it has
 * in it. */
TEST(pareto_of_a_family) {
    static const char *const formats[] = {"fp16", "unorm16", "unorm24", "fp32"};
    for (size_t all = 0; all < 2; all++) {
        char *text = command_output(cmd_plot, 0,
                                    all ? "plot pareto encode --json" : "plot pareto encode --json -F d24,d16 -m log");
        json_t *root = json_of(text);
        const size_t count = json_array_size(json_object_get(root, "panels"));
        assert_int_equal(count, all ? 4 : 2);
        for (size_t i = 0; i < count; i++) {
            const json_t *panel = json_array_get(json_object_get(root, "panels"), i), *series;
            assert_string_equal(text_at(root, "panels[%zu].title", i), formats[all ? i : i + 1]);
            size_t names = 0, at;
            json_array_foreach(json_object_get(panel, "series"), at, series) {
                const json_t *point;
                size_t k;
                json_array_foreach(json_object_get(series, "points"), k, point) {
                    const char *label = json_string_value(json_object_get(point, "label"));
                    names += label != NULL;
                }
            }
            size_t speak = 0;
            for (size_t k = 0; k < *encode_family.method_count; k++)
                speak += method_speaks(&encode_family.methods[k], all ? i : i + 1) &&
                         method_available(&encode_family.methods[k]);
            assert_int_equal(names, speak);
        }
        json_decref(root);
        free(text);
    }
}

/* Decimal digits that an error leaves. */
static double digits(double error) {
    return isinf(error) ? 0 : fmin(fmax((double)-log10l((long double)error), 0), 16);
}

/* Where a column of a map is drawn: at its far/near, but for the rounding of the logarithms. */
static double column_of(const json_t *root, size_t panel, size_t point, size_t k) {
    const double ratio = number_at(root, "panels[%zu].series[2].points[%zu].ratio", panel, point);
    assert_relative(ratio, 10 * pow(1000, (double)k), 1e-12);
    return ratio;
}

/* The columns of other cameras, each a series: the worst over the cases that have it. */
static void want_others(values *v, const method_family_row *family, size_t panel) {
    static const struct {
        const char *name;
        size_t offset;
        int reversed; /* 0 or 1: the cases of that depth; -1: the worst of all */
        double x;
    } columns[] = {
        {"far infinite", offsetof(stability_result, infinite), 0, INFINITY},
        {"far infinite, reversed", offsetof(stability_result, infinite), 1, INFINITY},
        {"orthographic", offsetof(stability_result, ortho), -1, 1e4},
        {"oblique near plane", offsetof(stability_result, oblique), -1, 1e4},
        {"logarithmic depth", offsetof(stability_result, log), -1, 1e4},
        {"0 and subnormal numbers", offsetof(stability_result, subnormal), -1, 0},
    };
    for (size_t k = 0; k < sizeof columns / sizeof columns[0]; k++) {
        for (size_t row = 0; row < *family->method_count; row++) {
            double least = NAN;
            for (size_t i = 0; i < walked_count; i++) {
                const stability_result *r = &walked[i];
                const double error = *(const double *)(const void *)((const char *)r + columns[k].offset);
                if (r->row == &family->methods[*family->method_count - 1 - row] && !isnan(error) &&
                    (columns[k].reversed < 0 ||
                     (strstr(family->cases[r->which].name, "reversed") != NULL) == columns[k].reversed))
                    least = fmin(least, digits(error));
            }
            want_point(v, panel, k, row, "ratio", columns[k].x, "method", (double)row + 0.5);
            want_number(v, "digits", least);
        }
        values_under(v, "panels[%zu].series[%zu].", panel, k);
        want_text(v, "name", columns[k].name);
    }
    values_under(v, "panels[%zu].", panel);
    want_text(v, "title", "other cameras");
}

/* A panel for each case, in it the methods from the last. */
TEST(stability) {
    const method_family_row *family = method_family_find("worst");
    static const char *const names[] = {"a digit is claimed up to here", "the claim breaks here", "map"};
    values v = values_of("plot");
    memset(verdicts, 0, sizeof verdicts);
    char *text = command_output(cmd_plot, 0, "plot stability worst --json");
    json_t *root = json_of(text);
    want_head(&v, root, "stability", figure_find("stability")->title);
    want_axis(&v, "x", "ratio", "far/near", "", "log");
    want_axis(&v, "y", "method", "method", "", "linear");
    want_axis(&v, "value", "digits", "digits left", "", "linear");
    const method_row *rows[BENCH_METHODS_MAX]; /* in each panel the same, whether they speak of its case or not */
    size_t count = 0;
    for (size_t i = 0; i < walked_count; i++)
        if (count == 0 || rows[count - 1] != walked[i].row)
            rows[count++] = walked[i].row;
    for (size_t which = 0; which < family->case_count; which++) {
        size_t claims = 0, breaks = 0;
        for (size_t row = 0; row < count; row++) {
            const stability_result *r = NULL; /* none where the method does not speak of the case */
            for (size_t i = 0; i < walked_count; i++)
                r = walked[i].which == which && walked[i].row == rows[row] ? &walked[i] : r;
            const double height = (double)(count - 1 - row) + 0.5;
            if (r != NULL && !isnan(r->claim_to))
                want_point(&v, which, 0, claims++, "ratio", r->claim_to, "method", height);
            if (r != NULL && isfinite(r->breaks))
                want_point(&v, which, 1, breaks++, "ratio", r->breaks, "method", height);
            for (size_t k = 0; k < 4; k++) {
                const size_t point = (count - 1 - row) * 4 + k;
                want_point(&v, which, 2, point, "ratio", column_of(root, which, point, k), "method", height);
                want_number(&v, "digits", r != NULL ? digits(r->error[k]) : (double)NAN);
            }
        }
        for (size_t s = 0; s < 3; s++) {
            values_under(&v, "panels[%zu].series[%zu].", which, s);
            want_text(&v, "name", names[s]);
        }
        values_under(&v, "panels[%zu].", which);
        want_text(&v, "title", family->cases[which].name);
    }
    want_others(&v, family, family->case_count);
    check_json_text(&v, text);
    json_decref(root);
    free(text);
    values_free(&v);
}

int main(void) {
    setenv("SOURCE_DATE_EPOCH", "1577923200", 1);
    return run_listed(NULL, NULL);
}
