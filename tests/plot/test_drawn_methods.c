/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Figures of methods, as drawn: Pareto and stability, with methods of the test's own and with those of the program. */
#include "drawn.h"
#include "drawn_map.h"
#include "named.h"
#include "plot/figure.h"
#include "support.h"

enum { METHODS = 9, STEPS = 4 };

/* Two groups; one method without error, one without a time, one that is wrong without bound; the last three crowd. */
static const char *const names[METHODS] = {"alpha", "beta",    "gamma", "delta",  "no-time",
                                           "wrong", "crowded", "close", "closest"};
static const double ns[METHODS] = {2, 300, 40, 5000, NAN, 70, 900, 930, 960};
static const double errors[METHODS] = {1e-2, 1e-9, 0.3, 0, 1e-5, INFINITY, 1e-6, 1.1e-6, 1.05e-6};
static const double bounds[METHODS] = {4e-2, NAN, NAN, NAN, 1e-5, 1, NAN, 3.3e-6, NAN};
static const bool front[METHODS] = {true, true, false, true, false, false, true, false, true};
static const int group[METHODS] = {0, 0, 0, 0, 0, 0, 1, 1, 1};
static const double ratios[STEPS] = {10, 100, 1000, 10000};
static const double walked[METHODS * STEPS] = {
    1e-7,  1e-6, 1e-5, 1e-4, /**/ 1e-3, 1e-2,     0.1,  1,    /**/ 0,    0,    0,    1e-15,
    1e-1,  1e-2, 1e-3, 1e-4, /**/ 3,    INFINITY, 1e-8, 1e-9, /**/ 1e-5, 1e-5, 1e-2, 1e-2,
    1e-12, 1e-2, 1e-9, 1e-1, /**/ 1e-4, 1e-3,     1e-2, 1e-1, /**/ 1e-6, 1e-5, 1e-4, 1e-3};
static const double claimed[METHODS] = {10000, 10, NAN, 1000, 100, 100, 10, NAN, 1000};
static const double breaks[METHODS] = {INFINITY, 100, INFINITY, 10000, NAN, 1000, INFINITY, INFINITY, 100};
static const double exact = 1e-17, top = 1; /* where what has no error is drawn, and what is unbounded */

/* The methods as rows of a family with one case; those of group 1 are judged by the pipeline. */
static method_row own[METHODS];
static method_family_row family = {
    .name = "own", .measure = "relative error", .cases = {{.name = "case"}}, .case_count = 1};

static void name_rows(void) {
    for (size_t i = 0; i < METHODS; i++) {
        own[i].name = names[i];
        own[i].domain = group[i] == 1 ? METHOD_PIPELINE : 0;
        own[i].claims[0].ratio_hi = isnan(claimed[i]) ? 1000 : claimed[i]; /* claims nothing so far */
        own[i].claims[0].worst = isnan(claimed[i]) ? (double)NAN : 1;
    }
}

static drawn *draw_own(const char *figure, const drawn_theme *look) {
    chart *c = chart_new();
    assert_non_null(c);
    snprintf(c->title, sizeof c->title, "%s", figure_find(figure)->title);
    snprintf(c->subtitle, sizeof c->subtitle, "of the test");
    name_rows();
    if (strcmp(figure, "pareto") == 0) {
        bench_result results[METHODS] = {0};
        for (size_t i = 0; i < METHODS; i++)
            results[i] = (bench_result){.row = &own[i],
                                        .ns = ns[i],
                                        .measured = {.worst = {.relative = errors[i]}},
                                        .bound = bounds[i],
                                        .front = front[i]};
        assert_null(pareto_draw(&family, results, METHODS, c));
    } else {
        static stability_result results[METHODS];
        for (size_t i = 0; i < METHODS; i++) {
            results[i] = (stability_result){.row = &own[i],
                                            .steps = STEPS,
                                            .claim_to = claimed[i],
                                            .breaks = breaks[i],
                                            .cause = i % 3 == 1 ? "rust" : NULL,
                                            .infinite = NAN,
                                            .ortho = NAN,
                                            .oblique = NAN,
                                            .log = NAN,
                                            .subnormal = NAN};
            memcpy(results[i].ratio, ratios, sizeof ratios);
            memcpy(results[i].error, &walked[i * STEPS], STEPS * sizeof walked[0]);
        }
        assert_null(stability_draw(&family, results, METHODS, c));
    }
    return drawn_chart(look, c, 800, 500);
}

/* ---- Pareto ------------------------------------------------------------------------------------------------------ */

static bool is_shown(size_t i) {
    return isfinite(ns[i]);
}

static svg_point place_of(const drawn_panel *p, double time, double error) {
    return (svg_point){drawn_px(&p->x, time), drawn_px(&p->y, fmin(fmax(error, exact), top)), false};
}

static bool overlap(svg_box a, svg_box b) {
    return a.x0 < b.x1 && b.x0 < a.x1 && a.y0 < b.y1 && b.y0 < a.y1;
}

static bool marked(const drawn_marker *all, size_t count, const drawn_marker *as, svg_point at) {
    for (size_t i = 0; i < count; i++)
        if (drawn_alike(&all[i], as) && fabs(all[i].width - as->width) < 0.02 &&
            hypot(all[i].x - at.x, all[i].y - at.y) < 1.3)
            return true;
    return false;
}

/* Each group's front is one thin line through its methods, the fastest first. */
static void check_fronts(const drawn *d, const drawn_panel *p) {
    static const size_t ways[2][3] = {{0, 1, 3}, {6, 8, 0}};
    static const size_t corners[2] = {3, 2};
    svg_mark pen = {.stroke = {0, 0x72 / 255.0, 0xB2 / 255.0, 1}, .width = d->scale};
    const svg_mark *lines[4];
    assert_int_equal(drawn_strokes(d, p, &pen, lines, 4), 2);
    for (int g = 0; g < 2; g++) {
        assert_int_equal(lines[g]->count, corners[g]);
        for (size_t i = 0; i < corners[g]; i++) {
            const svg_point at = place_of(p, ns[ways[g][i]], errors[ways[g][i]]);
            assert_px(lines[g]->points[i].x, at.x, 1.2);
            assert_px(lines[g]->points[i].y, at.y, 1.2);
        }
    }
}

/* A bar from each worst error to its bound, which has a stroke across. */
static void check_bars(const drawn *d, const drawn_panel *p) {
    static const size_t barred[] = {0, 7};
    svg_mark pen = {.stroke = {0, 0x9E / 255.0, 0x73 / 255.0, 1}, .width = 2.0 * d->scale};
    const svg_mark *lines[4];
    assert_int_equal(drawn_strokes(d, p, &pen, lines, 4), 1);
    assert_int_equal(lines[0]->count, 4 * 2);
    for (size_t i = 0; i < 2; i++) {
        const svg_point *bar = &lines[0]->points[4 * i];
        const svg_point from = place_of(p, ns[barred[i]], errors[barred[i]]);
        const svg_point to = place_of(p, ns[barred[i]], bounds[barred[i]]);
        assert_px(bar[0].x, from.x, 1.2);
        assert_px(bar[0].y, from.y, 1.2);
        for (int k = 1; k < 4; k++)
            assert_px(bar[k].y, to.y, 1.2);
        assert_true(bar[1].x == bar[0].x && bar[2].x < to.x - 5 * d->scale && bar[3].x > to.x + 5 * d->scale);
    }
}

static void check_pareto_words(const drawn *d) {
    static const char *const texts[] = {"from the worst found to the bound", "dominated (unbounded: at the top)",
                                        "on the Pareto front (without error: at 10\u207b\u00b9\u2077)"};
    assert_string_equal(d->title, "Time and worst error of methods");
    assert_string_equal(d->x_caption->text, "time per element (ns)");
    assert_string_equal(d->y_caption->text, "worst error (relative error)");
    assert_null(d->right_caption);
    drawn_legend_is(d, 3, texts);
    const drawn_marker *behind = &d->entries[1].marker, *on = &d->entries[2].marker;
    assert_true(behind->shape == DRAWN_SQUARE && on->shape == DRAWN_DISC);
    assert_int_equal(on->inside, d->theme->palette[0]); /* filled */
    assert_int_equal(behind->inside, d->theme->background);
    assert_int_equal(behind->rim, d->theme->palette[1]);
}

TEST(pareto_of_the_test) {
    drawn *d = draw_own("pareto", &drawn_light);
    const drawn_panel *p = &d->panels[0];
    drawn_marker all[32];
    const size_t count = drawn_markers(d, p, all, 32);
    const svg_mark *words[METHODS] = {NULL};
    size_t shown = 0;
    check_pareto_words(d);
    assert_true(p->x.log && p->y.log);
    assert_px(drawn_px(&p->x, 1), p->frame.x0, 1.5); /* whole decades round the data */
    assert_px(drawn_px(&p->x, 1e4), p->frame.x1, 1.5);
    assert_px(drawn_px(&p->y, 1e-18), p->frame.y1, 1.5);
    assert_px(drawn_px(&p->y, 1), p->frame.y0, 1.5);
    for (size_t i = 0; i < METHODS; i++) {
        if (!is_shown(i))
            continue;
        const svg_point at = place_of(p, ns[i], errors[i]);
        if (!marked(all, count, &d->entries[1 + front[i]].marker, at))
            fail_msg("'%s' is not marked as it should be", names[i]);
        char name[64];
        snprintf(name, sizeof name, "%s%s", names[i], group[i] == 1 ? " (pipeline)" : "");
        words[i] = drawn_label(d, p, at, name);
        for (size_t k = 0; k < i; k++)
            assert_false(words[k] != NULL && overlap(words[k]->box, words[i]->box));
        shown++;
    }
    assert_int_equal(count, shown);
    check_fronts(d, p);
    check_bars(d, p);
    drawn_description_is(d, " Shown: front; front; from the worst found to the bound; dominated; on the Pareto front.");
    drawn_close(d);
}

/* One row of `methods --csv`: name and error; group 1 runs the whole pipeline. Returns where the next row begins. */
static char *bench_row(char *row, char name[64], double *error) {
    char *end = strchr(row, '\n'), *at = row;
    if (end == NULL)
        return NULL;
    *end = '\0';
    assert_int_equal(sscanf(row, "interval,%63[^,]", name), 1);
    for (int comma = 0; comma < 6; comma++)
        at = strchr(at, ',') + 1;
    *error = strtod(at, NULL);
    return end + 1;
}

/* Where a label would touch the frame it is moved back to its side. */
static bool at_the_frame(const drawn_panel *p, svg_box label) {
    assert_true(label.x0 > p->frame.x0 + 3 && label.x1 < p->frame.x1 - 3);
    return label.x1 > p->frame.x1 - 6 || label.x0 < p->frame.x0 + 6;
}

/* Times change from run to run, errors do not: each name has its point at its error, marked as its place deserves. */
TEST(pareto_of_the_program) {
    drawn *d = drawn_run(&drawn_light, "plot pareto interval -F unorm24");
    const drawn_panel *p = &d->panels[0];
    drawn_marker all[32];
    const size_t count = drawn_markers(d, p, all, 32);
    char *text = drawn_output("methods interval --csv"), *row = strchr(text, '\n') + 1;
    assert_string_equal(d->title, "Time and worst error of methods");
    assert_non_null(
        strstr(d->subtitle, "interval: z-fighting interval at an eye depth; unorm24 d3d, near 0.1, far 1000; "));
    assert_string_equal(d->y_caption->text, "worst error (relative error)");
    size_t methods = 0;
    while (row != NULL && *row != '\0') {
        char name[64];
        double error;
        row = bench_row(row, name, &error);
        if (row == NULL)
            break;
        const svg_mark *words = NULL;
        const svg_box page = {0, 0, d->svg->width, d->svg->height};
        const char *kinds[2] = {"", " (pipeline)"};
        char full[80];
        for (int k = 0; k < 2 && words == NULL; k++) {
            snprintf(full, sizeof full, "%s%s", name, kinds[k]);
            words = drawn_words(d, page, full);
        }
        if (words == NULL)
            fail_msg("no point is named '%s'", name);
        bool found = false;
        for (size_t i = 0; i < count; i++) {
            const double gap = words->at.x > all[i].x ? words->at.x - all[i].x : all[i].x - words->box.x1;
            const bool beside = fabs(gap - 8) < 1.8 || at_the_frame(p, words->box);
            found = found || (beside && fabs(all[i].y - drawn_px(&p->y, fmax(error, exact))) < 1.5);
        }
        if (!found)
            fail_msg("'%s' stands at no point with the error %g", name, error);
        methods++;
    }
    free(text);
    assert_int_equal(methods, count);
    drawn_close(d);
}

/* ---- Stability --------------------------------------------------------------------------------------------------- */

static double digits(double error) {
    return error == 0 ? 16 : isfinite(error) ? fmin(fmax(-log10(error), 0), 16) : 0;
}

/* The field painted last over a place. */
static uint32_t field_at(const drawn *d, const drawn_panel *p, double x, double y) {
    uint32_t found = 0;
    for (size_t i = 1; i < d->svg->count; i++) {
        const svg_mark *m = &d->svg->marks[i];
        if (m->kind == SVG_PATH && m->fill.a == 1 && m->count == 4 && m->stroke.a == 0 &&
            svg_rgb(m->fill) != d->theme->background && x > m->box.x0 && x < m->box.x1 && y > m->box.y0 &&
            y < m->box.y1 && svg_inside(m->box, p->frame, 2))
            found = 0xFF000000u | svg_rgb(m->fill);
    }
    return found;
}

/* The first method on top, as in a table, and its name at its row. */
static double row_of(const drawn_panel *p, size_t i, size_t count) {
    return p->frame.y0 + (p->frame.y1 - p->frame.y0) * ((double)i + 0.5) / (double)count;
}

static void check_ends(const drawn *d, const drawn_panel *p, const double *ends, const char *text, size_t others) {
    drawn_marker all[64];
    const size_t count = drawn_markers(d, p, all, 64);
    size_t wanted = 0;
    for (size_t i = 0; i < METHODS; i++) {
        if (!isfinite(ends[i]))
            continue;
        wanted++;
        if (!marked(all, count, &drawn_legend(d, text)->marker,
                    (svg_point){drawn_px(&p->x, ends[i]), row_of(p, i, METHODS), false}))
            fail_msg("'%s' is not marked at %g of %s", text, ends[i], names[i]);
    }
    assert_int_equal(count, wanted + others);
}

TEST(stability_of_the_test) {
    static const char *const texts[] = {"a digit is claimed up to here", "the claim breaks here"};
    for (int dark = 0; dark < 2; dark++) {
        drawn *d = draw_own("stability", dark ? &drawn_dark : &drawn_light);
        const drawn_panel *p = &d->panels[0];
        assert_string_equal(d->title, "Correct digits of methods");
        assert_string_equal(d->x_caption->text, "far/near");
        assert_string_equal(d->y_caption->text, "method");
        assert_string_equal(d->right_caption->text, "digits left");
        drawn_legend_is(d, 2, texts);
        assert_int_equal(d->entries[0].marker.inside, d->theme->text);
        assert_int_equal(d->entries[0].marker.shape, DRAWN_DISC);
        assert_int_equal(d->entries[1].marker.inside, d->theme->background);
        assert_int_equal(d->entries[1].marker.rim, d->theme->palette[0]);
        drawn_bar_is_viridis(d);
        assert_true(p->x.log && !d->value.log);
        assert_px(drawn_px(&d->value, 0), d->bar->box.y1, 1.5);
        assert_px(drawn_px(&d->value, 16), d->bar->box.y0, 1.5);
        assert_px(drawn_px(&p->x, sqrt(10)), p->frame.x0, 1.5);
        assert_px(drawn_px(&p->x, sqrt(1e9)), p->frame.x1, 1.5);
        assert_int_equal(p->y.labels, METHODS);
        for (size_t i = 0; i < METHODS; i++) {
            char name[64];
            snprintf(name, sizeof name, "%s%s", names[i], i % 3 == 1 ? " (rust)" : "");
            assert_string_equal(p->y.at[METHODS - 1 - i]->text, name);
            assert_px(p->y.px[METHODS - 1 - i], row_of(p, i, METHODS), 1);
            for (size_t k = 0; k < STEPS; k++) { /* below the marks */
                const uint32_t colour = field_at(d, p, drawn_px(&p->x, ratios[k] * 1.5), row_of(p, i, METHODS) + 12);
                assert_px(drawn_bar_px(d, colour), drawn_px(&d->value, digits(walked[i * STEPS + k])), 2);
            }
        }
        check_ends(d, p, claimed, texts[0], 4);
        check_ends(d, p, breaks, texts[1], 7);
        drawn_description_is(d, " case. Shown: a digit is claimed up to here; the claim breaks here.");
        drawn_close(d);
    }
}

/* The significant bits of the formats whose steps are counted. */
static double digits_of(const char *which) {
    static const struct {
        const char *name;
        int bits;
    } rows[] = {{"fp16", 11}, {"unorm16", 16}, {"unorm24", 24}, {"fp32", 24}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        if (strcmp(which, rows[i].name) == 0)
            return rows[i].bits * log10(2);
    fail_msg("whose steps are those of %s?", which);
    return NAN;
}

/* "textbook (cancellation)": a name, and a word where it loses digits. */
static bool is_called(const char *text, const char *name) {
    const size_t length = strlen(name);
    return strncmp(text, name, length) == 0 && (text[length] == '\0' || strncmp(text + length, " (", 2) == 0);
}

/* The digits that the walk of a method in a case found, in the panel of the case and the row of the method. */
static void check_field(const drawn *d, const method_family_row *of, const stability_result *r,
                        bool seen[DRAWN_PANELS][DRAWN_LABELS]) {
    drawn_marker all[64];
    size_t panel = 0;
    int label = 0;
    const char *which = of->cases[r->which].name;
    while (panel < d->panel_count && strcmp(d->panels[panel].heading, which) != 0)
        panel++;
    if (panel == d->panel_count && strcmp(which, "fp32 log") == 0)
        return; /* few methods: they stand among the other cameras alone */
    while (label < d->panels[0].y.labels && !is_called(d->panels[0].y.at[label]->text, r->row->name))
        label++;
    if (panel == d->panel_count || label == d->panels[0].y.labels)
        fail_msg("no row shows %s of %s", r->row->name, which);
    const drawn_panel *p = &d->panels[panel];
    const double y = d->panels[0].y.px[label] - d->panels[0].frame.y0 + p->frame.y0;
    for (int k = 0; k < r->steps; k++) {
        const double error = r->error[k];
        const double left = of->steps ? fmax(digits_of(which) - log10(fmax(error, 0.5)), 0) : digits(error);
        const uint32_t colour = field_at(d, p, drawn_px(&p->x, r->ratio[k]) - 2, y + 6);
        assert_px(drawn_bar_px(d, colour), drawn_px(&d->value, left), 2);
    }
    if (!isnan(r->claim_to))
        assert_true(marked(all, drawn_markers(d, p, all, 64), &drawn_legend(d, "a digit is claimed up to here")->marker,
                           (svg_point){drawn_px(&p->x, r->claim_to), y, false}));
    seen[panel][label] = true;
}

/* Where a case has no method there is a hatch; names of rows can be read, and marks stand within the frame. */
static void check_panels(const drawn *d, bool seen[DRAWN_PANELS][DRAWN_LABELS]) {
    const drawn_scale *y = &d->panels[0].y;
    bool hatched = false;
    for (int label = 1; label < y->labels; label++)
        assert_true(fabs(y->px[label] - y->px[label - 1]) > 13 * d->scale);
    for (size_t i = 0; i < d->panel_count; i++) {
        const drawn_panel *p = &d->panels[i];
        drawn_marker all[64];
        const size_t count = drawn_markers(d, p, all, 64);
        for (size_t k = 0; k < count; k++)
            assert_true(all[k].x + 2 < p->frame.x1 && all[k].x - 2 > p->frame.x0);
        for (int label = 0; i + 1 < d->panel_count && label < y->labels; label++) {
            const double place = y->px[label] - d->panels[0].frame.y0 + p->frame.y0;
            const uint32_t colour = field_at(d, p, (p->frame.x0 + p->frame.x1) / 2, place + 5) & 0xFFFFFF;
            hatched = hatched || !seen[i][label];
            assert_int_equal(colour == d->theme->empty, !seen[i][label]);
        }
    }
    assert_true(hatched);
}

/* The field of a column of other cameras in the row of a method: the fewest digits over the cases, or a hatch. */
static void check_other(const drawn *d, int column, int columns, int label, double left) {
    const drawn_panel *p = &d->panels[d->panel_count - 1];
    const double x = p->frame.x0 + (p->frame.x1 - p->frame.x0) * (column + 0.5) / columns;
    const double y = d->panels[0].y.px[label] - d->panels[0].frame.y0 + p->frame.y0;
    const uint32_t colour = field_at(d, p, x, y);
    if (isnan(left))
        assert_int_equal(colour & 0xFFFFFF, d->theme->empty);
    else
        assert_px(drawn_bar_px(d, colour), drawn_px(&d->value, fmin(left, 8)), 2);
}

static void check_others(const drawn *d, const method_family_row *of, const stability_result *results, size_t count) {
    static const char *const ticks[] = {"inf", "rev. inf", "ortho", "oblique", "log"};
    const int columns = of->magnitudes ? 1 : 5;
    const drawn_panel *p = &d->panels[d->panel_count - 1];
    assert_string_equal(p->heading, of->magnitudes ? "other depths" : "other cameras");
    assert_int_equal(p->x.labels, columns); /* on two lines where they would touch */
    for (int k = 0; k < columns && columns > 1; k++)
        assert_string_equal(p->x.at[k]->text, ticks[k]);
    for (int label = 0; label < d->panels[0].y.labels; label++) {
        double left[5] = {NAN, NAN, NAN, NAN, NAN};
        for (size_t i = 0; i < count; i++) {
            const stability_result *r = &results[i];
            const bool turned = of->cases[r->which].mapping == DP_MAPPING_REVERSED;
            const double found[5] = {of->magnitudes ? r->subnormal
                                     : turned       ? NAN
                                                    : r->infinite,
                                     turned ? r->infinite : NAN, r->ortho, r->oblique, r->log};
            if (is_called(d->panels[0].y.at[label]->text, r->row->name))
                for (int k = 0; k < columns; k++)
                    if (!isnan(found[k]))
                        left[k] = fmin(left[k],
                                       of->steps ? digits_of(of->cases[r->which].name) + log10(2) : digits(found[k]));
        }
        for (int k = 0; k < columns; k++)
            check_other(d, k, columns, label, left[k]);
    }
}

/* Names, colours and ends of the program's methods against the walk. */
TEST(stability_of_the_program) {
    static const struct {
        const char *family, *subtitle;
        size_t cases;
        bool steps;
    } figures[] = {
        {"linearize",
         "linearize: eye depth of a binary32 window depth; worst relative error over four near "
         "planes. In parentheses: what takes the fourth digit. Hatched: not of this case",
         3, false},
        {"encode",
         "encode: code of a binary32 window depth; worst steps of the format, as digits of the code. "
         "In parentheses: what makes codes wrong. Hatched: not of this case",
         5, true},
    };
    for (size_t i = 0; i < sizeof figures / sizeof figures[0]; i++) {
        drawn *d = drawn_run(&drawn_light, "plot stability %s", figures[i].family);
        static stability_result results[STABILITY_MAX];
        const method_family_row *of = method_family_find(figures[i].family);
        const size_t count = stability_run(of, STABILITY_ALL, results);
        bool seen[DRAWN_PANELS][DRAWN_LABELS] = {{false}};
        assert_string_equal(d->subtitle, figures[i].subtitle);
        assert_int_equal(d->panel_count, figures[i].cases);
        for (size_t k = 0; k < count; k++)
            check_field(d, of, &results[k], seen);
        check_others(d, of, results, count);
        assert_true(count > 10);
        check_panels(d, seen);
        drawn_close(d);
    }
}
