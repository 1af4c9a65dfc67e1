/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Figures of curves, as drawn, against the library: distribution, share, error, interval. */
#include "depthprec/depthprec.h"
#include "drawn.h"
#include "drawn_parts.h"
#include "drawn_truth.h"
#include "support.h"

static const drawn_shape shapes[] = {DRAWN_DISC,     DRAWN_SQUARE,        DRAWN_DIAMOND,
                                     DRAWN_TRIANGLE, DRAWN_TRIANGLE_DOWN, DRAWN_HEXAGON};

/* How far apart two curves run between two x, px: the greater distance of their upper or lower reaches. */
static double apart(const svg_mark *a, const svg_mark *b, double from, double to) {
    double worst = 0;
    for (double x = from; x + 1 <= to; x += 1) {
        double top[2], bottom[2];
        const bool in_a = drawn_reach(a, x, x + 1, &top[0], &bottom[0]);
        const bool in_b = drawn_reach(b, x, x + 1, &top[1], &bottom[1]);
        if (in_a != in_b)
            return INFINITY;
        if (in_a)
            worst = fmax(worst, fmax(fabs(top[0] - top[1]), fabs(bottom[0] - bottom[1])));
    }
    return worst;
}

/* The name of set-up k beside that of i: without the format or the mapping that both have. */
static const char *told_apart(const cameras *c, size_t i, size_t k, char out[48]) {
    const char *mapping = strchr(c->names[k], ' '), *own = strchr(c->names[i], ' ');
    const int format = (int)(mapping - c->names[k]);
    const bool same_format = strncmp(c->names[k], c->names[i], (size_t)format + 1) == 0;
    snprintf(out, 48, "%.*s%s", same_format ? 0 : format, c->names[k],
             same_format                 ? mapping + 1
             : strcmp(mapping, own) == 0 ? ""
                                         : mapping);
    return out;
}

/* What the legend says of curve i beside its name: which curve drawn later hides it, everywhere or from or up to where.
 * What it says is so, and it says so of each that another lies on. Returns whether it says something. */
static bool check_alike(const drawn *d, const cameras *c, size_t i) {
    const drawn_panel *p = &d->panels[0];
    const svg_mark *own = drawn_curve(d, p, &d->entries[i]);
    const char *said = strstr(d->entries[i].text, ", hidden by "), *from = NULL, *to = NULL;
    const double left = p->frame.x0 + 1, right = p->frame.x1 - 1, seen = 2, width = p->frame.x1 - p->frame.x0;
    for (size_t k = i + 1; k < c->count; k++) {
        const svg_mark *other = drawn_curve(d, p, &d->entries[k]);
        char name[48];
        const size_t length = strlen(told_apart(c, i, k, name));
        if (said == NULL) /* each pair parts on both halves */
            assert_true(apart(own, other, left, left + 0.55 * width) > 0.6 &&
                        apart(own, other, right - 0.55 * width, right) > 0.6);
        if (said == NULL || strncmp(said + 12, name, length) != 0 || strchr(" ", said[12 + length]) == NULL)
            continue;
        from = strstr(said, " from ");
        to = strstr(said, " up to ");
        const double begin = from != NULL ? drawn_px(&p->x, drawn_number(from + 6)) + 3 : left;
        const double end = to != NULL ? drawn_px(&p->x, drawn_number(to + 7)) - 3 : right;
        assert_true(apart(own, other, begin, end) <= seen && end - begin > 0.45 * width);
        if (from != NULL || to != NULL)
            assert_true(apart(own, other, left, right) > 0.6);
        return true;
    }
    assert_null(said);
    return false;
}

static size_t legend_names(const drawn *d, const cameras *c) {
    size_t alike = 0;
    assert_int_equal(d->entry_count, c->count);
    for (size_t i = 0; i < c->count; i++) {
        const char *text = d->entries[i].text;
        assert_int_equal(strncmp(text, c->names[i], strlen(c->names[i])), 0);
        assert_true(text[strlen(c->names[i])] == '\0' || strncmp(text + strlen(c->names[i]), ", hidden by ", 12) == 0);
        alike += check_alike(d, c, i);
    }
    return alike;
}

/* The words behind title and subtitle: the names, in order. */
static void described(const drawn *d, const cameras *c) {
    char shown[1024] = " Shown:";
    for (size_t i = 0; i < c->count; i++)
        snprintf(shown + strlen(shown), sizeof shown - strlen(shown), "%s %s", i > 0 ? ";" : "", c->names[i]);
    snprintf(shown + strlen(shown), sizeof shown - strlen(shown), ".");
    drawn_description_is(d, shown);
}

static void captions(const drawn *d, const char *title, const char *subtitle, const char *y) {
    assert_string_equal(d->title, title);
    assert_string_equal(d->subtitle, subtitle);
    assert_string_equal(d->x_caption->text, "eye depth z (scene units)");
    assert_string_equal(d->y_caption->text, y);
    assert_null(d->right_caption);
}

/* From one end of the frame to the other. */
static void spans(const drawn_panel *p, bool log, double lo, double hi) {
    assert_int_equal(p->x.log, log);
    assert_px(drawn_px(&p->x, lo), p->frame.x0, 1.5);
    assert_px(drawn_px(&p->x, hi), p->frame.x1, 1.5);
}

/* The axis is no longer than its curves need, and no shorter. */
static void fits(const drawn *d, const drawn_panel *p) {
    double top = INFINITY, bottom = -INFINITY;
    const double height = p->frame.y1 - p->frame.y0;
    for (size_t i = 0; i < d->entry_count; i++)
        if (d->entries[i].line != NULL) {
            const svg_mark *curve = drawn_curve(d, p, &d->entries[i]);
            top = fmin(top, curve->box.y0);
            bottom = fmax(bottom, curve->box.y1);
        }
    assert_true(top > p->frame.y0 + 0.02 * height && top < p->frame.y0 + 0.06 * height);
    assert_true(bottom < p->frame.y1 - 0.02 * height && bottom > p->frame.y1 - 0.06 * height);
}

/* ---- One panel, a curve for each set-up -------------------------------------------------------------------------- */

typedef struct curves_case {
    const char *figure, *arguments, *title, *y;
    drawn_truth truth;
    bool log, fitted;
} curves_case;

static const curves_case curve_cases[] = {
    {"error", "--model exact", "Worst error of the decoded depth", "worst |decoded depth \u2212 z| (scene units)",
     true_error, true, true},
    {"interval", "--model exact --tolerance 0", "Z-fighting interval", "z-fighting interval (scene units)",
     true_interval, true, true},
    {"interval", "--model exact", "Z-fighting interval", "z-fighting interval (scene units)", true_interval, true,
     true},
    {"distribution", "", "Codes along z", "codes, fewest (per scene unit of depth)", true_density, true, true},
    {"share", "", "Share of the codes between z and far", "codes between z and far (% of all between the planes)",
     true_share, true, false},
};

/* Formats decide colour and marker, mappings the stroke; markers of different curves do not hide each other. */
static void check_curves(const drawn *d, const cameras *c, size_t mappings, const curves_case *q) {
    const drawn_panel *p = &d->panels[0];
    const size_t formats = c->count / mappings;
    for (size_t i = 0; i < c->count; i++) {
        const drawn_entry *e = drawn_legend(d, c->names[i]);
        const bool both = formats > 1 && mappings > 1;
        const int format = (int)(both ? i / mappings : i), mapping = (int)(both ? i % mappings : mappings > 1 ? i : 0);
        drawn_style_is(d, e, format, mapping, shapes[format], false);
        const svg_mark *curve = drawn_curve(d, p, e);
        drawn_follows(p, &p->y, curve, q->truth, &c->setups[i], 150, 1.3);
        drawn_markers_on(d, p, e, curve);
    }
}

/* Curves that lie on each other still show: no marker hides that of another, and none lies on the frame. */
static void staggered(const drawn *d, const drawn_panel *p) {
    drawn_marker all[256];
    const size_t count = drawn_markers(d, p, all, 256);
    for (size_t i = 0; i < count; i++) {
        assert_true(all[i].shape == DRAWN_ARROW || all[i].x > p->frame.x0 + 1);
        for (size_t k = 0; k < i; k++)
            assert_true(fabs(all[i].x - all[k].x) > 5 || all[i].shape == DRAWN_ARROW || all[k].shape == DRAWN_ARROW);
    }
}

static size_t one_panel(const curves_case *q, const drawn_theme *look, double znear, double zfar, const char *formats,
                        const char *mappings) {
    cameras c = cameras_of(drawn_camera(znear, zfar), formats, mappings);
    char subtitle[128];
    drawn *d = drawn_run(look, "plot %s %s%s -n %g -f %g -F %s -m %s --theme %s", q->figure, q->arguments,
                         znear > 0 ? "" : " --ortho", znear, zfar, formats, mappings, look->name);
    snprintf(subtitle, sizeof subtitle, "near %g, far %g, %s, nearest, exact (lattice of codes)", znear, zfar,
             znear > 0 ? "perspective" : "orthographic");
    assert_int_equal(d->panel_count, 1);
    captions(d, q->title, subtitle, q->y);
    const size_t alike = legend_names(d, &c);
    described(d, &c);
    spans(&d->panels[0], znear > 0, znear, zfar);
    assert_int_equal(d->panels[0].y.log, q->log);
    staggered(d, &d->panels[0]);
    check_curves(d, &c, strchr(mappings, ',') != NULL ? 2 : 1, q);
    if (q->fitted)
        fits(d, &d->panels[0]);
    else
        assert_true(drawn_at(&d->panels[0].y, d->panels[0].frame.y0) > 101); /* 100 stays clear of the frame */
    drawn_close(d);
    return alike;
}

TEST(curves_show_the_library) {
    for (size_t i = 0; i < sizeof curve_cases / sizeof curve_cases[0]; i++) {
        assert_true(one_panel(&curve_cases[i], &drawn_light, 0.1, 1000, "unorm16,unorm24,fp32,fp16", "d3d,reversed") >
                    1);
        one_panel(&curve_cases[i], i % 2 == 0 ? &drawn_dark : &drawn_print, 0.5, 3000, "unorm16,unorm24,fp16", "log");
        one_panel(&curve_cases[i], &drawn_light, -100, 500, "unorm16,fp16", "d3d");
        one_panel(&curve_cases[i], &drawn_light, 0, 500, "fp16,unorm8", "reversed");
    }
}

/* A share is read in percent: 100 and 0.01, not powers of ten. */
TEST(shares_are_percent) {
    static const char *const labels[] = {"100", "10", "1", "0.1", "0.01", "0.001", "0.0001", "0.00001"};
    drawn *d = drawn_run(&drawn_light, "plot share -F fp32,unorm24 -m d3d");
    const drawn_scale *y = &d->panels[0].y;
    size_t found = 0;
    for (int i = 0; i < y->labels; i++)
        for (size_t k = 0; k < sizeof labels / sizeof labels[0]; k++)
            found += strcmp(y->at[i]->text, labels[k]) == 0;
    assert_int_equal(found, sizeof labels / sizeof labels[0]);
    drawn_close(d);
}

/* ---- Unbounded cells --------------------------------------------------------------------------------------------- */

TEST(blind_ends_in_an_arrow) {
    cameras c = cameras_of(drawn_camera(0.1, INFINITY), "unorm16,fp32", "d3d,reversed");
    drawn *d = drawn_run(&drawn_light, "plot interval --model exact -f inf -F unorm16,fp32 -m d3d,reversed");
    const drawn_panel *p = &d->panels[0];
    drawn_marker all[256];
    const size_t count = drawn_markers(d, p, all, 256);
    size_t arrows = 0, blind = 0;
    assert_string_equal(d->subtitle, "near 0.1, far inf, perspective, nearest, exact (lattice of codes)");
    spans(p, true, 0.1, 1e5);
    for (size_t i = 0; i < count; i++)
        arrows += all[i].shape == DRAWN_ARROW;
    for (size_t i = 0; i < c.count; i++) {
        const drawn_entry *e = drawn_legend(d, c.names[i]);
        const svg_mark *curve = drawn_curve(d, p, e);
        dp_worst w;
        double top, bottom;
        char words[80];
        assert_int_equal(dp_worst_over(&c.setups[i], 0.1, 1e5, &w), DP_OK);
        drawn_follows(p, &p->y, curve, true_interval, &c.setups[i], 100, 1.3);
        if (isnan(w.blind_from)) {
            assert_string_equal(e->text, c.names[i]);
            assert_true(drawn_reach(curve, p->frame.x1 - 2, p->frame.x1, &top, &bottom));
            continue;
        }
        blind++;
        snprintf(words, sizeof words, "%s (blind from %.5g)", c.names[i], w.blind_from);
        assert_int_equal(strncmp(e->text, words, strlen(words)), 0); /* behind it, on which curve it lies */
        const double x = drawn_px(&p->x, w.blind_from);
        assert_false(drawn_reach(curve, x + 2, p->frame.x1, &top, &bottom));
        assert_true(drawn_reach(curve, x - 2, x + 2, &top, &bottom));
        assert_px(top, p->frame.y0, 1.5);
        bool pointed = false;
        for (size_t k = 0; k < count; k++)
            pointed = pointed || (all[k].shape == DRAWN_ARROW && all[k].inside == svg_rgb(curve->stroke) &&
                                  fabs(all[k].x - x) < 2 && fabs(all[k].y - p->frame.y0) < 1);
        assert_true(pointed);
    }
    assert_int_equal(arrows, blind);
    assert_int_equal(blind, 2);
    assert_int_equal(d->entry_count, c.count + 1);
    const drawn_entry *e = drawn_legend(d, "unbounded from here: nothing beyond is resolved");
    assert_int_equal(e->marker.shape, DRAWN_ARROW);
    assert_int_equal(e->marker.inside, d->theme->faint);
    drawn_close(d);
}

/* ---- Guarantee, lattice and census ------------------------------------------------------------------------------- */

/* The pen of a background line: as the swatch, at half the width. */
static svg_mark thinned(const svg_mark *pen) {
    svg_mark out = *pen;
    out.width /= 2;
    for (int i = 0; i < out.dash_count; i++)
        out.dash[i] /= 2;
    return out;
}

/* What of the guarantee rises to a point is drawn over it. */
static void check_points_behind(const drawn *d, const drawn_entry *e, const svg_mark *line) {
    size_t behind = 0;
    for (const svg_mark *m = d->svg->marks; m < line; m++) {
        const drawn_marker marker = drawn_marker_of(d, (size_t)(m - d->svg->marks));
        behind += m->used == DRAWN_NEW && drawn_alike(&marker, &e->marker) && drawn_px(&d->panels[0].x, 1) <= marker.x;
    }
    assert_true(behind >= 6);
}

/* The intervals that `zfight` prints of each power of two, as points. */
static void check_census(const drawn *d, const drawn_entry *e, const char *format, const char *mapping) {
    drawn_marker all[256];
    const drawn_panel *p = &d->panels[0];
    const size_t count = drawn_markers(d, p, all, 256);
    char *text = drawn_output("zfight -n 0.1 -f 1000 -F %s -m %s --range 1:100 --csv", format, mapping), *rest = NULL;
    size_t bands = 0, points = 0;
    assert_int_equal(e->lines, 0);
    for (size_t i = 0; i < count; i++)
        points += drawn_alike(&all[i], &e->marker) && fabs(all[i].width - e->marker.width) < 0.02;
    strtok_r(text, "\n", &rest);
    for (char *line = strtok_r(NULL, "\n", &rest); line != NULL; line = strtok_r(NULL, "\n", &rest)) {
        double longest, z;
        char *at = line;
        for (int comma = 0; comma < 16; comma++)
            at = strchr(at, ',') + 1;
        assert_int_equal(sscanf(at, "%lf,%lf", &longest, &z), 2);
        bool found = false;
        for (size_t i = 0; i < count; i++)
            found = found || (drawn_alike(&all[i], &e->marker) &&
                              hypot(all[i].x - drawn_px(&p->x, z), all[i].y - drawn_px(&p->y, longest)) < 1.5);
        if (!found)
            fail_msg("no point of %s at %g, %g", e->text, z, longest);
        bands++;
    }
    free(text);
    assert_int_equal(points, bands);
    assert_true(bands >= 6);
}

TEST(guarantee_over_lattice) {
    static const char *const texts[] = {"unorm24 gl", "fp32 reversed"};
    for (int k = 0; k < 2; k++) {
        dp_spec spec = drawn_camera(0.1, 1000);
        const char *format = k == 0 ? "unorm24" : "fp32", *mapping = k == 0 ? "gl" : "reversed";
        char census[48], shown[160];
        cameras exact = cameras_of(spec, format, mapping);
        spec.model = DP_MODEL_FLOAT;
        cameras fp32 = cameras_of(spec, format, mapping);
        drawn *d = drawn_run(&drawn_light, "plot interval --model float --range 1:100 -F %s -m %s", format, mapping);
        const drawn_panel *p = &d->panels[0];
        snprintf(census, sizeof census, "%s, census", texts[k]);
        drawn_legend_is(d, 2, (const char *const[]){texts[k], census});
        snprintf(shown, sizeof shown, " Shown: %s, lattice; %s; %s.", texts[k], texts[k], census);
        char want[256];
        snprintf(want, sizeof want,
                 "%s, near 0.1, far 1000, perspective, nearest, float ieee, depths 1 to 100. Thick: guaranteed in "
                 "binary32 arithmetic. Thin: the lattice of codes alone. Points: the longest interval that there is in "
                 "each power of two",
                 texts[k]);
        captions(d, "Guaranteed separation", want, "separation, interval (scene units)");
        drawn_description_is(d, shown);
        spans(p, true, 1, 100);
        const drawn_entry *e = drawn_legend(d, texts[k]);
        drawn_style_is(d, e, 0, 0, DRAWN_NONE, false);
        drawn_follows(p, &p->y, drawn_curve(d, p, e), true_separation, &fp32.setups[0], 100, 1.5);
        const svg_mark pen = thinned(e->line), *thin[2];
        assert_int_equal(drawn_strokes(d, p, &pen, thin, 2), 1);
        drawn_follows(p, &p->y, thin[0], true_interval, &exact.setups[0], 100, 1.5);
        assert_int_equal(drawn_legend(d, census)->marker.inside, svg_rgb(e->line->stroke));
        check_points_behind(d, drawn_legend(d, census), drawn_curve(d, p, e));
        check_census(d, drawn_legend(d, census), format, mapping);
        drawn_close(d);
    }
}

/* So it is where no model is given, without a census; the legend says where a curve ends. */
TEST(guaranteed_by_default) {
    dp_spec spec = drawn_camera(0.1, 1000);
    cameras exact = cameras_of(spec, "fp16,unorm24", "d3d,reversed");
    spec.model = DP_MODEL_FLOAT;
    cameras fp32 = cameras_of(spec, "fp16,unorm24", "d3d,reversed");
    drawn *d = drawn_run(&drawn_light, "plot interval -F fp16,unorm24 -m d3d,reversed");
    const drawn_panel *p = &d->panels[0];
    captions(
        d, "Guaranteed separation",
        "near 0.1, far 1000, perspective, nearest, float ieee. Thick: guaranteed in binary32 arithmetic. Thin: the "
        "lattice of codes alone",
        "separation, interval (scene units)");
    assert_int_equal(d->entry_count, fp32.count + 1);
    for (size_t i = 0; i < fp32.count; i++) {
        const drawn_entry *e = drawn_legend(d, fp32.names[i]);
        const svg_mark pen = thinned(e->line), *thin[2];
        const char *const ends = strstr(e->text, " (ends at ");
        drawn_follows(p, &p->y, drawn_curve(d, p, e), true_separation, &fp32.setups[i], 100, 1.5);
        assert_int_equal(drawn_strokes(d, p, &pen, thin, 2), 1);
        drawn_follows(p, &p->y, thin[0], true_interval, &exact.setups[i], 100, 1.5);
        assert_int_equal(ends != NULL, i == 0);
        const double z = ends != NULL ? strtod(ends + 10, NULL) : 500;
        assert_int_equal(dp_separation(&fp32.setups[i], z * 1.005) > 1000 - z * 1.005, i == 0);
        assert_true(dp_separation(&fp32.setups[i], z * 0.995) < 1000 - z * 0.995);
    }
    drawn_close(d);
}

/* The census of one set-up hides that of another behind equal points; the legend says so. */
TEST(hidden_points) {
    drawn *d = drawn_run(&drawn_light, "plot interval --model float --range 1:1000 -F unorm24,fp32 -m d3d,reversed");
    const drawn_panel *p = &d->panels[0];
    drawn_marker all[256];
    const size_t count = drawn_markers(d, p, all, 256);
    const drawn_entry *under = drawn_legend(d, "unorm24 d3d, census"), *over = drawn_legend(d, "fp32 d3d, census");
    size_t hidden = 0, points = 0;
    for (size_t i = 0; i < count; i++)
        if (drawn_alike(&all[i], &under->marker)) {
            bool found = false;
            for (size_t k = 0; k < count; k++)
                found = found ||
                        (drawn_alike(&all[k], &over->marker) && hypot(all[i].x - all[k].x, all[i].y - all[k].y) < 1);
            points++;
            hidden += found;
        }
    assert_true(points > 6 && hidden == points);
    assert_string_equal(under->text, "unorm24 d3d, census, hidden by fp32");
    assert_string_equal(drawn_legend(d, "unorm24 reversed, census")->text, "unorm24 reversed, census");
    drawn_close(d);
}

/* Each of many set-ups has two curves, one of them with markers. */
TEST(guarantees_of_many) {
    drawn *d = drawn_run(&drawn_light, "plot interval --model float --figure-size 800x900 "
                                       "-F unorm16,unorm20,unorm24,fp16,fp32,"
                                       "unorm12 -m d3d,gl,reversed");
    drawn_marker all[256];
    assert_int_equal(d->entry_count, 18 + 1); /* one says what an arrow means */
    assert_true(drawn_markers(d, &d->panels[0], all, 256) > 90);
    staggered(d, &d->panels[0]);
    drawn_close(d);
}

/* ---- Staircases -------------------------------------------------------------------------------------------------- */

/* A piece of a path from the left axis over to (x, y) on the curve, and down to the bottom axis. */
static bool has_step(const svg_mark *m, const drawn_panel *p, double x, double y) {
    for (size_t i = 0, end; i < m->count; i = end) {
        bool corner = false;
        for (end = i; end < m->count && (end == i || !m->points[end].starts); end++)
            corner = corner || hypot(m->points[end].x - x, m->points[end].y - y) < 1.2;
        const svg_point first = m->points[i], last = m->points[end - 1];
        if (corner && fabs(first.x - p->frame.x0) < 1 && fabs(first.y - y) < 1.2 && fabs(last.x - x) < 1.2 &&
            fabs(last.y - p->frame.y1) < 1)
            return true;
    }
    return false;
}

/* A short piece inwards from both axes. */
static bool has_rug(const svg_mark *m, const drawn_panel *p, double x, double y) {
    bool at_left = false, at_bottom = false;
    for (size_t i = 0; i + 1 < m->count; i += 2) {
        const svg_point from = m->points[i], to = m->points[i + 1];
        at_left = at_left || (from.y == to.y && to.x > from.x && to.x < from.x + 10 && fabs(from.y - y) < 1.2 &&
                              fabs(from.x - p->frame.x0) < 1);
        at_bottom = at_bottom || (from.x == to.x && to.y < from.y && to.y > from.y - 10 && fabs(from.x - x) < 1.2 &&
                                  fabs(from.y - p->frame.y1) < 1);
    }
    return at_left && at_bottom;
}

static size_t pieces(const svg_mark *m) {
    size_t count = 0;
    for (size_t i = 0; i < m->count; i++)
        count += m->points[i].starts;
    return count;
}

/* Whether a code is stored behind some NDC of [-1, 1] in the format itself, each of which is tried: the window depth is
 * half of it and a half. */
static bool from_signed(const dp_format *f, uint32_t code) {
    for (uint32_t ndc = 0; ndc <= f->code_max; ndc++)
        for (int sign = -1; sign <= 1; sign += 2)
            if (dp_format_encode(f, DP_ROUND_NEAREST, 0.5 + 0.5 * sign * dp_format_value(f, ndc)) == code)
                return true;
    return false;
}

static size_t check_codes(const drawn *d, const drawn_panel *p, const dp_setup *s, uint32_t colour) {
    const bool ndc_signed = dp_mapping_get(s->spec.mapping)->ndc_signed;
    const svg_mark *thin = NULL, *thick = NULL;
    size_t codes = 0;
    for (size_t i = 0; i < d->svg->count; i++) {
        const svg_mark *m = &d->svg->marks[i];
        if (m->kind != SVG_PATH || m->used != DRAWN_NEW || svg_rgb(m->stroke) != colour || m->dash_count > 0 ||
            !svg_inside(m->box, p->frame, 1))
            continue;
        assert_true(m->stroke.a < 1 ? thin == NULL : thick == NULL);
        *(m->stroke.a < 1 ? &thin : &thick) = m;
    }
    assert_true(thin != NULL && thick != NULL && thick->width > thin->width);
    for (uint32_t code = 0; code <= s->spec.format.code_max; code++) {
        const double z = dp_stored(s, code), x = drawn_px(&p->x, z);
        const double y = drawn_px(&p->y, dp_format_value(&s->spec.format, code));
        if (!(z >= s->spec.znear && z <= s->spec.zfar) || (ndc_signed && !from_signed(&s->spec.format, code)))
            continue;
        if (!has_step(thin, p, x, y) || !has_rug(thick, p, x, y))
            fail_msg("code %u is not drawn where it is in '%s'", code, p->heading);
        codes++;
    }
    assert_int_equal(pieces(thin), codes);
    assert_int_equal(pieces(thick), 2 * codes);
    return codes;
}

TEST(staircases) {
    static const char *const texts[] = {"codes and their decoded depths", "window depth d(z)"};
    cameras c = cameras_of(drawn_camera(1, 20), "unorm4,float3.3b5", "d3d,reversed");
    drawn *d = drawn_run(&drawn_light, "plot distribution -n 1 -f 20 -F unorm4,float3.3b5 -m d3d,reversed");
    captions(d, "Codes along z", "near 1, far 20, perspective, nearest, exact (lattice of codes)", "window depth d");
    drawn_legend_is(d, 2, texts);
    assert_int_equal(d->panel_count, c.count);
    char shown[1024] = "";
    for (size_t i = 0; i < c.count; i++) {
        const drawn_panel *p = &d->panels[i];
        const drawn_entry *codes = drawn_legend(d, texts[0]), *window = drawn_legend(d, texts[1]);
        char heading[64];
        snprintf(heading, sizeof heading, "%s, %u codes", c.names[i], c.setups[i].spec.format.code_max + 1);
        assert_string_equal(p->heading, heading);
        snprintf(shown + strlen(shown), sizeof shown - strlen(shown), " %s. Shown: %s; %s.", heading, texts[0],
                 texts[1]);
        spans(p, false, 1, 20);
        assert_px(drawn_px(&p->y, 0), p->frame.y1, 1);
        assert_px(drawn_px(&p->y, 1), p->frame.y0, 1);
        drawn_style_is(d, window, 0, 0, DRAWN_NONE, false);
        drawn_follows(p, &p->y, drawn_curve(d, p, window), true_window, &c.setups[i], 100, 1.2);
        assert_int_equal(codes->lines, 3);
        assert_int_equal(svg_rgb(codes->line->stroke), d->theme->palette[1]);
        check_codes(d, p, &c.setups[i], d->theme->palette[1]);
    }
    drawn_description_is(d, shown);
    drawn_close(d);
}

/* Eight have room. */
TEST(staircases_of_many) {
    drawn *d = drawn_run(&drawn_light, "plot distribution -n 1 -f 20 -F unorm4,unorm5,unorm6,unorm7 -m d3d,reversed");
    assert_int_equal(d->panel_count, 8);
    drawn_close(d);
}

/* Whatever way depth runs, [-1, 1] reaches 25 of 41 codes; the other mapping, and the model exact, have all. */
TEST(staircases_behind_signed_ndc) {
    static const struct {
        const char *format, *mapping, *model;
        size_t codes;
    } cases[] = {{"float3.3b5", "gl-reversed", "", 25},      {"float3.3b5", "gl", " --model staged", 25},
                 {"float3.3b5", "reversed", "", 41},         {"float3.2b2", "gl", "", 9},
                 {"float2.4", "gl-reversed", "", 17},        {"unorm4", "gl", "", 16},
                 {"float3.3b5", "d3d", " --model exact", 41}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        cameras c = cameras_of(drawn_camera(1, 20), cases[i].format, cases[i].mapping);
        drawn *d = drawn_run(&drawn_light, "plot distribution -n 1 -f 20 -F %s -m %s,linear%s", cases[i].format,
                             cases[i].mapping, cases[i].model);
        char heading[96];
        const uint32_t all = c.setups[0].spec.format.code_max + 1;
        const size_t seen = check_codes(d, &d->panels[0], &c.setups[0], d->theme->palette[1]);
        assert_int_equal(seen, cases[i].codes);
        snprintf(heading, sizeof heading, seen < all ? "%s, %zu of %u codes" : "%s, %zu codes", c.names[0], seen, all);
        assert_string_equal(d->panels[0].heading, heading);
        drawn_close(d);
    }
}

/* With an infinite far plane the picture ends a little behind the depth from which nothing is told apart. */
TEST(staircase_without_end) {
    static const char *const formats[] = {"unorm4", "unorm6"};
    for (int i = 0; i < 2; i++) {
        cameras c = cameras_of(drawn_camera(2, INFINITY), formats[i], "d3d");
        dp_worst w;
        drawn *d = drawn_run(&drawn_light, "plot distribution -n 2 -f inf -F %s -m d3d", formats[i]);
        assert_int_equal(dp_worst_over(&c.setups[0], 2, INFINITY, &w), DP_OK);
        const bool linear = 1.15 * w.blind_from <= 200;
        spans(&d->panels[0], !linear, 2, w.blind_from * (linear ? 1.15 : 2));
        assert_int_equal(linear, i == 0);
        drawn_close(d);
    }
}
