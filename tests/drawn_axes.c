/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scales from what is drawn: ticks, and the labels that stand at them. */

#include "drawn_parts.h"
#include "support.h"

double drawn_px(const drawn_scale *s, double value) {
    return s->a + s->b * (s->log ? log10(value) : value);
}

double drawn_at(const drawn_scale *s, double px) {
    const double v = (px - s->a) / s->b;
    return s->log ? pow(10, v) : v;
}

/* The exponent that raised figures mean. */
static int raised(const char *text) {
    static const char *const digits[] = {"\u2070", "\u00b9", "\u00b2", "\u00b3", "\u2074",
                                         "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
    static const char minus[] = "\u207b";
    int sign = 1, value = 0;
    if (strncmp(text, minus, strlen(minus)) == 0) {
        sign = -1;
        text += strlen(minus);
    }
    while (*text != '\0') {
        int digit = 0;
        while (digit < 10 && strncmp(text, digits[digit], strlen(digits[digit])) != 0)
            digit++;
        if (digit == 10)
            fail_msg("'%s' is no exponent", text);
        value = 10 * value + digit;
        text += strlen(digits[digit]);
    }
    return sign * value;
}

double drawn_number(const char *text) {
    static const char dot[] = "\u00b7";
    const char *split = strstr(text, dot);
    char *end;
    const double plain = strtod(text, &end);
    if (split == NULL && (strncmp(text, "10", 2) != 0 || (unsigned char)text[2] < 0x80))
        return end > text && *end == '\0' ? plain : NAN;
    const char *power = split != NULL ? split + strlen(dot) : text;
    assert_true(strncmp(power, "10", 2) == 0);
    return (split != NULL ? plain : 1) * pow(10, raised(power + 2));
}

/* The straight line through the labels; returns how far the worst of them lies off it, px. */
static double fit(drawn_scale *s, bool log) {
    double n = 0, sv = 0, sp = 0, svv = 0, svp = 0, worst = 0;
    for (int i = 0; i < s->labels; i++) {
        const double value = drawn_number(s->at[i]->text), v = log ? log10(value) : value;
        n++;
        sv += v;
        sp += s->px[i];
        svv += v * v;
        svp += v * s->px[i];
    }
    s->log = log;
    s->b = (n * svp - sv * sp) / (n * svv - sv * sv);
    s->a = (sp - s->b * sv) / n;
    for (int i = 0; i < s->labels; i++)
        worst = fmax(worst, fabs(s->px[i] - drawn_px(s, drawn_number(s->at[i]->text))));
    return isnan(s->b) ? INFINITY : worst;
}

/* Every tick of a log axis stands at a decade or at 2, ..., 9 times one, unless it has a label that says otherwise. */
static bool ticks_are_decades(const drawn_scale *s) {
    for (int i = 0; i < s->ticks; i++) {
        const double value = drawn_at(s, s->tick[i]), decade = pow(10, floor(log10(value) + 0.01));
        const double nearest = decade * fmax(1, rint(value / decade));
        if (!s->major[i] && fabs(s->tick[i] - drawn_px(s, nearest)) > 1.1)
            return false;
    }
    return true;
}

static void find_scale(drawn_scale *s, const char *what) {
    bool numbers = s->labels >= 2, positive = true;
    int minor = 0;
    for (int i = 0; i < s->ticks; i++)
        minor += !s->major[i];
    for (int i = 0; i < s->labels; i++) {
        const double value = drawn_number(s->at[i]->text);
        numbers = numbers && !isnan(value);
        positive = positive && value > 0;
    }
    if (!numbers) {
        s->b = 0;
        return;
    }
    const double slack = 0.8;
    const double linear = fit(s, false);
    /* Even steps have no small ticks. */
    if (linear <= slack && minor == 0 && (s->labels > 2 || !positive))
        return;
    const double log = positive ? fit(s, true) : INFINITY;
    if (log <= slack && ticks_are_decades(s))
        return;
    if (linear > slack || minor > 0)
        fail_msg("the labels of the %s axis are on no scale: off by %.2f px if linear, %.2f if logarithmic", what,
                 linear, log);
    fit(s, false);
}

/* ---- Ticks ------------------------------------------------------------------------------------------------------- */

/* Pieces of two points in the colour of frames: ticks, each beginning at its axis. */
static bool is_ticks(const drawn *d, const svg_mark *m) {
    if (m->kind != SVG_PATH || m->used != DRAWN_NEW || m->fill.a > 0 || m->stroke.a != 1 || m->count < 2 ||
        m->dash_count > 0 || m->count % 2 != 0 || fabs(m->width - d->scale) > 1e-6 ||
        svg_rgb(m->stroke) != d->theme->frame)
        return false;
    for (size_t i = 0; i < m->count; i++)
        if (m->points[i].starts != (i % 2 == 0))
            return false;
    return true;
}

static void add_tick(const drawn *d, drawn_scale *s, double px, double length) {
    const bool major = fabs(length - 5 * d->scale) < 0.1;
    if (!major)
        assert_px(length, 3 * d->scale, 0.1);
    assert_true(s->ticks < 128);
    s->tick[s->ticks] = px;
    s->major[s->ticks++] = major;
}

/* Which axis a tick belongs to; null when to none. */
static drawn_scale *axis_of(drawn *d, svg_point from, svg_point to) {
    const double slack = 0.6;
    for (size_t i = 0; i < d->panel_count; i++) {
        drawn_panel *p = &d->panels[i];
        const bool across = from.x >= p->frame.x0 - slack && from.x <= p->frame.x1 + slack;
        const bool along = from.y >= p->frame.y0 - slack && from.y <= p->frame.y1 + slack;
        if (across && fabs(from.y - p->frame.y1) < 0.1 && from.x == to.x && to.y > from.y)
            return &p->x;
        if (along && fabs(from.x - p->frame.x0) < 0.1 && from.y == to.y && to.x < from.x)
            return &p->y;
        if (along && fabs(from.x - p->frame.x1) < 0.1 && from.y == to.y && to.x > from.x)
            return &p->second;
    }
    if (d->bar != NULL && fabs(from.x - d->bar->box.x1) < 1 && from.y == to.y && to.x > from.x)
        return &d->value;
    return NULL;
}

static void read_ticks(drawn *d, svg_mark *m) {
    for (size_t i = 0; i + 1 < m->count; i += 2) {
        const svg_point from = m->points[i], to = m->points[i + 1];
        drawn_scale *s = axis_of(d, from, to);
        if (s == NULL)
            fail_msg("a tick at %.1f,%.1f belongs to no axis", from.x, from.y);
        if (from.x == to.x)
            add_tick(d, s, from.x, to.y - from.y);
        else
            add_tick(d, s, from.y, fabs(to.x - from.x));
    }
    m->used = DRAWN_AXIS;
}

/* ---- Labels ------------------------------------------------------------------------------------------------------ */

typedef enum side { BELOW, LEFT, RIGHT } side;

/* The words at a tick; the axis lies at `edge`. Names below an axis may be on two lines. */
static svg_mark *label_at(const drawn *d, side where, double edge, double px) {
    const double s = d->scale;
    for (size_t i = 0; i < d->svg->count; i++) {
        svg_mark *m = &d->svg->marks[i];
        if (!drawn_is_small(d, m, d->theme->faint) || m->used != DRAWN_NEW)
            continue;
        const double gap = where == BELOW  ? m->at.y - 0.73 * m->size - edge
                           : where == LEFT ? edge - m->box.x1
                                           : m->box.x0 - edge;
        const double off = where == BELOW ? svg_middle_x(m->box) - px : m->at.y - 0.36 * m->size - px;
        const bool lower = where == BELOW && fabs(gap - 9 * s - 1.25 * m->size) < 2.5 * s;
        if (fabs(off) < (where == BELOW ? 2 : 0.6) * s && (lower || fabs(gap - 9 * s) < 2.5 * s))
            return m;
    }
    return NULL;
}

static void read_labels(const drawn *d, drawn_scale *s, side where, double edge, bool wanted) {
    s->labels = 0;
    for (int i = 0; i < s->ticks; i++) {
        svg_mark *m = s->major[i] ? label_at(d, where, edge, s->tick[i]) : NULL;
        if (s->major[i] && wanted && m == NULL)
            fail_msg("the tick at %.1f px has no label", s->tick[i]);
        if (m != NULL && !wanted)
            fail_msg("'%s' labels an axis within the figure", m->text);
        if (m == NULL)
            continue;
        assert_true(s->labels < DRAWN_LABELS);
        m->used = DRAWN_AXIS;
        s->at[s->labels] = m;
        s->px[s->labels++] = s->tick[i];
    }
}

static bool same_ticks(const drawn_scale *a, const drawn_scale *b) {
    bool same = a->ticks == b->ticks;
    for (int i = 0; i < a->ticks && same; i++)
        same = fabs(a->tick[i] - b->tick[i]) < 1;
    return same;
}

/* Is there a panel below that has the same axis? */
static bool has_below(const drawn *d, const drawn_panel *p) {
    for (size_t i = 0; i < d->panel_count; i++)
        if (d->panels[i].frame.y0 > p->frame.y1 && fabs(d->panels[i].frame.x0 - p->frame.x0) < 1)
            return same_ticks(&p->x, &d->panels[i].x);
    return false;
}

/* The panel farthest to one side in the line of another. */
static const drawn_panel *outermost(const drawn *d, const drawn_panel *p, bool right) {
    const drawn_panel *best = p;
    for (size_t i = 0; i < d->panel_count; i++) {
        const drawn_panel *q = &d->panels[i];
        if (fabs(q->frame.y0 - p->frame.y0) < 1 &&
            (right ? q->frame.x0 > best->frame.x0 : q->frame.x0 < best->frame.x0))
            best = q;
    }
    return best;
}

static bool is_ordered(const drawn_scale *s, double direction) {
    for (int i = 1; i < s->labels; i++)
        if (!((s->px[i] - s->px[i - 1]) * direction > 0))
            return false;
    return true;
}

/* A line across the panel at each named tick of both axes. */
static void check_grid(const drawn *d, const drawn_panel *p) {
    const svg_mark *grid = NULL;
    size_t lines = 0;
    for (size_t i = 0; i < d->svg->count; i++) {
        svg_mark *m = &d->svg->marks[i];
        if (m->kind == SVG_PATH && m->fill.a == 0 && svg_rgb(m->stroke) == d->theme->grid && m->stroke.a == 1 &&
            svg_inside(m->box, p->frame, 1)) {
            assert_null(grid);
            grid = m;
            m->used = DRAWN_AXIS;
        }
    }
    bool is_map = false; /* whose colours are the ground */
    for (size_t i = 0; i < d->svg->count; i++)
        is_map = is_map || d->svg->marks[i].kind == SVG_IMAGE;
    assert_int_equal(grid == NULL, is_map);
    if (grid == NULL)
        return;
    for (size_t i = 0; i + 1 < grid->count; i += 2) {
        const svg_point a = grid->points[i], b = grid->points[i + 1];
        const drawn_scale *s = a.x == b.x ? &p->x : &p->y;
        bool found = false;
        for (int k = 0; k < s->ticks; k++)
            found = found || (s->major[k] && fabs(s->tick[k] - (a.x == b.x ? a.x : a.y)) < 0.01);
        assert_true(found);
        assert_px(hypot(b.x - a.x, b.y - a.y), a.x == b.x ? p->frame.y1 - p->frame.y0 : p->frame.x1 - p->frame.x0, 1);
        lines++;
    }
    size_t majors = 0;
    for (int k = 0; k < p->x.ticks; k++)
        majors += p->x.major[k];
    for (int k = 0; k < p->y.ticks; k++)
        majors += p->y.major[k];
    assert_int_equal(lines, majors);
}

static void apart(const drawn_scale *s) {
    for (int i = 1; i < s->labels; i++)
        assert_true(s->at[i]->at.y != s->at[i - 1]->at.y || s->at[i]->box.x0 > s->at[i - 1]->box.x1 + 3);
}

void drawn_read_axes(drawn *d) {
    for (size_t i = 0; i < d->svg->count; i++)
        if (is_ticks(d, &d->svg->marks[i]))
            read_ticks(d, &d->svg->marks[i]);
    for (size_t i = 0; i < d->panel_count; i++) {
        drawn_panel *p = &d->panels[i];
        const bool lowest = !has_below(d, p);
        read_labels(d, &p->x, BELOW, p->frame.y1, lowest);
        read_labels(d, &p->y, LEFT, p->frame.x0, outermost(d, p, false) == p);
        read_labels(d, &p->second, RIGHT, p->frame.x1, outermost(d, p, true) == p);
        assert_true(is_ordered(&p->x, 1) && p->x.ticks > 0 && p->y.ticks > 0);
        find_scale(&p->x, "x");
        find_scale(&p->y, "y");
        find_scale(&p->second, "second");
        apart(&p->x);
        check_grid(d, p);
    }
    for (size_t i = 0; i < d->panel_count; i++) { /* panels within have the scales of those outside */
        drawn_panel *p = &d->panels[i];
        const drawn_panel *left = outermost(d, p, false), *right = outermost(d, p, true);
        p->y.log = left->y.log;
        p->y.a = left->y.a;
        p->y.b = left->y.b;
        p->second.log = right->second.log;
        p->second.a = right->second.a;
        p->second.b = right->second.b;
        for (size_t k = 0; k < d->panel_count && p->x.labels == 0; k++)
            if (d->panels[k].x.labels > 0 && fabs(d->panels[k].frame.x0 - p->frame.x0) < 1) {
                p->x.log = d->panels[k].x.log;
                p->x.a = d->panels[k].x.a;
                p->x.b = d->panels[k].x.b;
            }
    }
    if (d->bar != NULL) {
        assert_int_equal(d->value.labels, -1); /* its frame was seen */
        read_labels(d, &d->value, RIGHT, floor(d->bar->box.x1) + 0.5, true);
        find_scale(&d->value, "colour");
    }
}
