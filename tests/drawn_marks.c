/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Curves and markers of a drawn figure. */

#include "drawn_parts.h"
#include "support.h"

static bool same_pen(const svg_mark *a, const svg_mark *b) {
    if (svg_rgb(a->stroke) != svg_rgb(b->stroke) || fabs(a->stroke.a - b->stroke.a) > 1e-6 ||
        fabs(a->width - b->width) > 1e-6 || a->dash_count != b->dash_count)
        return false;
    for (int i = 0; i < a->dash_count; i++)
        if (fabs(a->dash[i] - b->dash[i]) > 1e-4)
            return false;
    return true;
}

/* The part of a mark that shows lies on the panel; where nothing would be cut off, cairo writes no clip. */
static bool shows_on(const svg_mark *m, const drawn_panel *p) {
    const svg_box shown = {fmax(m->box.x0, m->clip.x0), fmax(m->box.y0, m->clip.y0), fmin(m->box.x1, m->clip.x1),
                           fmin(m->box.y1, m->clip.y1)};
    return svg_inside(shown, p->frame, 1);
}

size_t drawn_strokes(const drawn *d, const drawn_panel *p, const svg_mark *pen, const svg_mark **out, size_t room) {
    size_t count = 0;
    for (size_t i = 0; i < d->svg->count; i++) {
        const svg_mark *m = &d->svg->marks[i];
        if (m->kind == SVG_PATH && m->used == DRAWN_NEW && m->fill.a == 0 && !m->curved && m->count > 1 &&
            same_pen(m, pen) && shows_on(m, p)) {
            assert_true(count < room);
            out[count++] = m;
        }
    }
    return count;
}

const svg_mark *drawn_curve(const drawn *d, const drawn_panel *p, const drawn_entry *e) {
    const svg_mark *found[2];
    assert_non_null(e->line);
    const size_t count = drawn_strokes(d, p, e->line, found, 2);
    if (count != 1)
        fail_msg("%zu curves look as the legend shows '%s'", count, e->text);
    return found[0];
}

bool drawn_reach(const svg_mark *line, double x0, double x1, double *top, double *bottom) {
    *top = INFINITY;
    *bottom = -INFINITY;
    for (size_t i = 0; i + 1 < line->count; i++) {
        const svg_point a = line->points[i], b = line->points[i + 1];
        const double from = fmax(fmin(a.x, b.x), x0), to = fmin(fmax(a.x, b.x), x1);
        if (b.starts || from > to)
            continue;
        const double ends[2] = {from, to};
        for (int k = 0; k < 2; k++) {
            const double y = b.x != a.x ? a.y + (b.y - a.y) * (ends[k] - a.x) / (b.x - a.x) : k == 0 ? a.y : b.y;
            *top = fmin(*top, y);
            *bottom = fmax(*bottom, y);
        }
    }
    return *top <= *bottom;
}

void drawn_follows(const drawn_panel *p, const drawn_scale *y, const svg_mark *line, drawn_truth truth,
                   const void *context, int places, double slack) {
    const double left = p->frame.x0, width = p->frame.x1 - p->frame.x0;
    int seen = 0;
    for (int i = 1; i < places; i++) {
        const double x = left + width * i / places;
        double top, bottom, lo = INFINITY, hi = -INFINITY;
        bool expected = true;
        for (int k = -2; k < 2; k++) {
            double least, greatest;
            const double from = drawn_at(&p->x, x + k), to = drawn_at(&p->x, x + k + 1);
            expected = truth(context, from, to, &least, &greatest) && expected;
            lo = fmin(lo, least);
            hi = fmax(hi, greatest);
        }
        if (!expected)
            continue;
        if (!drawn_reach(line, x - 0.25, x + 0.25, &top, &bottom))
            fail_msg("the curve is not there at %.6g", drawn_at(&p->x, x));
        if (bottom < p->frame.y0 - 1 || top > p->frame.y1 + 1)
            fail_msg("the curve leaves the frame at %.6g", drawn_at(&p->x, x));
        if (!(top >= drawn_px(y, hi) - slack && bottom <= drawn_px(y, lo) + slack))
            fail_msg("at %.6g the curve shows %.6g to %.6g, should %.6g to %.6g", drawn_at(&p->x, x),
                     drawn_at(y, bottom), drawn_at(y, top), lo, hi);
        seen++;
    }
    if (seen < places / 4)
        fail_msg("only %d of %d places of the curve could be judged", seen, places);
}

/* ---- Names of points --------------------------------------------------------------------------------------------- */

/* A thin line from the point to the end of its words. */
static bool is_led(const drawn *d, svg_point from, double x, double y) {
    for (size_t i = 0; i < d->svg->count; i++) {
        const svg_mark *m = &d->svg->marks[i];
        if (m->kind == SVG_PATH && m->count == 2 && svg_rgb(m->stroke) == d->theme->faint && m->width < d->scale &&
            hypot(m->points[0].x - from.x, m->points[0].y - from.y) < 1.5 &&
            hypot(m->points[1].x - x, m->points[1].y - y) < 3)
            return true;
    }
    return false;
}

const svg_mark *drawn_label(const drawn *d, const drawn_panel *p, svg_point at, const char *name) {
    const svg_box near = {p->frame.x0 - 2, p->frame.y0 - 20, d->svg->width, p->frame.y1 + 20};
    const svg_mark *words = drawn_words(d, near, name);
    if (words == NULL)
        fail_msg("no point is named '%s'", name);
    const double middle = words->at.y - 0.36 * words->size;
    const bool right = svg_middle_x(words->box) > at.x;
    const double gap = right ? words->at.x - at.x : at.x - words->box.x1;
    assert_int_equal(svg_rgb(words->fill), d->theme->text);
    if (gap < 4 * d->scale) { /* where the frame ends, above the point or below it */
        assert_true(fmin(fabs(words->box.x1 - p->frame.x1), fabs(words->box.x0 - p->frame.x0)) < 6 * d->scale);
        assert_true(is_led(d, at, fmin(fmax(at.x, words->box.x0), words->box.x1),
                           middle + (middle < at.y ? 0.625 : -0.625) * words->size));
        return words;
    }
    if (fabs(gap - 8 * d->scale) > 1.8 || fabs(middle - at.y) > 4 * 0.75 * 1.25 * words->size + 1)
        fail_msg("'%s' stands %.1f, %.1f px from its point", name, gap, middle - at.y);
    if (fabs(middle - at.y) > 0.625 * words->size + 1)
        assert_true(is_led(d, at, right ? words->at.x : words->box.x1, middle));
    return words;
}

/* ---- Markers ----------------------------------------------------------------------------------------------------- */

static drawn_shape triangle(const svg_mark *m) {
    int upper = 0;
    for (size_t i = 0; i < 3; i++)
        upper += m->points[i].y < svg_middle_y(m->box);
    return upper == 1 ? DRAWN_TRIANGLE : DRAWN_TRIANGLE_DOWN;
}

static drawn_shape polygon(const svg_mark *m) {
    bool axis_parallel = true;
    if (m->count == 3)
        return triangle(m);
    if (m->count == 6)
        return DRAWN_HEXAGON;
    if (m->count != 4)
        return DRAWN_NONE;
    for (size_t i = 0; i < 4; i++) {
        const svg_point a = m->points[i], b = m->points[(i + 1) % 4];
        axis_parallel = axis_parallel && (a.x == b.x || a.y == b.y);
    }
    return axis_parallel ? DRAWN_SQUARE : DRAWN_DIAMOND;
}

/* A rim is a line round the same corners. */
static bool is_rim(const svg_mark *rim, const svg_mark *inside) {
    return rim->kind == SVG_PATH && rim->fill.a == 0 && rim->curved == inside->curved &&
           rim->count == inside->count + !inside->curved && svg_inside(rim->box, inside->box, 0.01) &&
           svg_inside(inside->box, rim->box, 0.01);
}

drawn_marker drawn_marker_of(const drawn *d, size_t i) {
    const svg_mark *m = &d->svg->marks[i];
    const double w = m->box.x1 - m->box.x0, h = m->box.y1 - m->box.y0;
    drawn_marker out = {.shape = DRAWN_NONE, .x = svg_middle_x(m->box), .y = svg_middle_y(m->box), .width = w};
    if (m->kind != SVG_PATH || m->fill.a == 0 || w > 20 * d->scale || h > 20 * d->scale)
        return out;
    out.inside = svg_rgb(m->fill);
    const bool rimmed = i + 1 < d->svg->count && is_rim(m + 1, m); /* what is cut has its rim apart */
    if (m->curved && (m->stroke.a > 0 || rimmed)) {
        out.shape = DRAWN_DISC;
        out.rim = svg_rgb(m->stroke.a > 0 ? m->stroke : m[1].stroke);
    } else if (rimmed) {
        out.shape = polygon(m);
        out.rim = svg_rgb(m[1].stroke);
        if (out.shape == DRAWN_TRIANGLE) /* its centre is not that of its box */
            out.y = m->box.y0 + 1.25 / 2.15 * h;
        else if (out.shape == DRAWN_TRIANGLE_DOWN)
            out.y = m->box.y0 + 0.9 / 2.15 * h;
    } else if (m->count == 3 && triangle(m) == DRAWN_TRIANGLE) {
        out.shape = DRAWN_ARROW;
        out.y = m->box.y0;
    }
    return out;
}

size_t drawn_markers(const drawn *d, const drawn_panel *p, drawn_marker *out, size_t room) {
    size_t count = 0;
    for (size_t i = 0; i < d->svg->count; i++) {
        if (d->svg->marks[i].used != DRAWN_NEW || !svg_inside(d->svg->marks[i].box, p->frame, 10 * d->scale))
            continue;
        const drawn_marker m = drawn_marker_of(d, i);
        if (m.shape == DRAWN_NONE)
            continue;
        assert_true(count < room);
        out[count++] = m;
    }
    return count;
}

bool drawn_alike(const drawn_marker *a, const drawn_marker *b) {
    return a->shape == b->shape && a->inside == b->inside && a->rim == b->rim;
}

void drawn_markers_on(const drawn *d, const drawn_panel *p, const drawn_entry *e, const svg_mark *curve) {
    drawn_marker all[256];
    const size_t count = drawn_markers(d, p, all, 256);
    const double spacing = fmin(120 * d->scale, (p->frame.x1 - p->frame.x0) / 3);
    double before = NAN;
    int seen = 0;
    for (size_t i = 0; i < count; i++) {
        double top, bottom;
        if (!drawn_alike(&all[i], &e->marker))
            continue;
        if (!drawn_reach(curve, all[i].x - 1, all[i].x + 1, &top, &bottom) || all[i].y < top - 1 ||
            all[i].y > bottom + 1)
            fail_msg("a marker of '%s' at %.1f,%.1f is off its curve", e->text, all[i].x, all[i].y);
        assert_px(all[i].width, e->marker.width, 0.02);
        if (seen++ > 0)
            assert_px(fmod(all[i].x - before + 0.25, spacing), 0.25, 0.25);
        before = all[i].x;
    }
    const double width = curve->box.x1 - curve->box.x0;
    if (seen < (int)(width / spacing) - 1 || seen == 0)
        fail_msg("%d markers of %d on the curve of '%s' of '%s'", seen, (int)(width / spacing), e->text, d->title);
}

/* ---- What figures promise about their looks ---------------------------------------------------------------------- */

/* In widths of the line. */
static const struct {
    int count;
    double dash[6];
} strokes[] = {
    {0, {0}}, {2, {4, 2.2}}, {2, {1.2, 1.8}}, {4, {5, 2, 1.2, 2}}, {2, {1.2, 4.5}}, {2, {8, 3}},
};

void drawn_style_is(const drawn *d, const drawn_entry *e, int colour, int stroke, drawn_shape marker, bool thin) {
    const uint32_t own = colour < 0 ? d->theme->text : d->theme->palette[colour], paper = d->theme->background;
    const svg_mark *m = e->line;
    assert_non_null(m);
    assert_int_equal(e->lines, 1);
    assert_int_equal(svg_rgb(m->stroke), own);
    assert_px(m->width, d->scale * d->theme->line * (thin ? 0.5 : 1), 1e-6);
    assert_int_equal(m->dash_count, strokes[stroke].count);
    for (int i = 0; i < m->dash_count; i++)
        assert_px(m->dash[i], strokes[stroke].dash[i] * m->width, 1e-4);
    assert_px(m->box.x1 - m->box.x0, 42 * d->scale, 0.01);
    assert_int_equal(e->marker.shape, marker);
    if (marker == DRAWN_NONE)
        return;
    assert_int_equal(e->marker.inside, stroke % 2 == 1 ? paper : own);
    assert_int_equal(e->marker.rim, stroke % 2 == 1 ? own : paper);
}

void drawn_description_is(const drawn *d, const char *shown) {
    char want[SVG_NOTE];
    snprintf(want, sizeof want, "%s. %s.%s", d->title, d->subtitle, shown);
    assert_string_equal(d->svg->description, want);
}
