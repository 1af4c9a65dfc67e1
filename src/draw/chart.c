/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "draw/chart.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/elementary.h"
#include "system/pages.h"

/* A chain of blocks: the link, then the caller's bytes. */
typedef union block {
    union block *next;
    max_align_t align;
} block;

/* A chart with the private fields that follow it. */
typedef struct whole {
    chart shown;
    block *memory;
    bool failed;
} whole;

chart *chart_new(void) {
    return calloc(1, sizeof(whole));
}

void chart_free(chart *c) {
    for (block *b = c != NULL ? ((whole *)c)->memory : NULL; b != NULL;) {
        block *next = b->next;
        free(b);
        b = next;
    }
    free(c);
}

void chart_fail(chart *c) {
    ((whole *)c)->failed = true;
}

bool chart_failed(const chart *c) {
    return c == NULL || ((const whole *)c)->failed;
}

void *chart_memory(chart *c, size_t count, size_t size) {
    whole *w = (whole *)c;
    block *b = count < SIZE_MAX / 2 / size ? calloc(1, sizeof *b + count * size) : NULL;
    if (b == NULL) {
        chart_fail(c);
        return NULL;
    }
    pages_large(b, sizeof *b + count * size);
    b->next = w->memory;
    w->memory = b;
    return b + 1;
}

chart_panel *chart_add_panel(chart *c) {
    return &c->panels[c->panel_count++];
}

chart_series *chart_add_series(chart *c, chart_panel *panel, chart_kind kind, size_t count) {
    if (panel->series_count == CHART_SERIES) {
        chart_fail(c);
        return NULL;
    }
    chart_series *s = &panel->series[panel->series_count];
    *s = (chart_series){.kind = kind, .style = {.marker = -1}, .count = count, .certain_to = (double)NAN};
    s->x = chart_memory(c, count, sizeof *s->x);
    s->y = chart_memory(c, count, sizeof *s->y);
    if (s->x == NULL || s->y == NULL)
        return NULL;
    panel->series_count++;
    return s;
}

bool chart_add_rows(chart *c, chart_panel *panel, int columns, int rows, chart_rows values) {
    chart_map m = {.columns = columns, .rows = rows, .values = values};
    m.x = chart_memory(c, (size_t)columns, sizeof *m.x);
    m.y = chart_memory(c, (size_t)rows, sizeof *m.y);
    m.room = chart_memory(c, (size_t)columns, sizeof *m.room);
    if (m.x == NULL || m.y == NULL || m.room == NULL)
        return false;
    for (int i = 0; i < columns; i++)
        m.x[i] = chart_axis_at(&panel->x, (i + 0.5) / columns);
    for (int i = 0; i < rows; i++)
        m.y[i] = chart_axis_at(&panel->y, (i + 0.5) / rows);
    panel->map = m;
    return true;
}

bool chart_add_map(chart *c, chart_panel *panel, int columns, int rows) {
    if (!chart_add_rows(c, panel, columns, rows, (chart_rows){.make = NULL}))
        return false;
    panel->map.value = chart_memory(c, (size_t)columns * (size_t)rows, sizeof *panel->map.value);
    return panel->map.value != NULL;
}

static const double *row_of(const double *held, const chart_rows *made, int columns, int row, double *room) {
    if (held != NULL)
        return held + (size_t)row * (size_t)columns;
    if (made->make == NULL)
        return NULL;
    made->make(made->of, made->channel, row, room);
    return room;
}

const double *chart_value_row(const chart_map *m, int row, double *room) {
    return row_of(m->value, &m->values, m->columns, row, room);
}

const double *chart_under_row(const chart_map *m, int row, double *room) {
    return row_of(m->under, &m->grounds, m->columns, row, room);
}

double chart_axis_at(const chart_axis *axis, double t) {
    if (axis->scale == CHART_DOWN)
        return axis->hi + t * (axis->lo - axis->hi);
    if (axis->scale == CHART_LOG)
        return dp_exp(dp_log(axis->lo) + t * (dp_log(axis->hi) - dp_log(axis->lo)));
    return axis->lo + t * (axis->hi - axis->lo);
}

double chart_axis_share(const chart_axis *axis, double value) {
    if (axis->scale == CHART_LOG)
        return value > 0 ? (dp_log(value) - dp_log(axis->lo)) / (dp_log(axis->hi) - dp_log(axis->lo))
                         : (double)-INFINITY;
    const double share = (value - axis->lo) / (axis->hi - axis->lo);
    return axis->scale == CHART_DOWN ? 1 - share : share;
}

static void widen(chart_extent *e, const double *values, size_t count, chart_scale scale) {
    for (size_t i = 0; i < count; i++)
        if (isfinite(values[i]) && (scale == CHART_LINEAR || values[i] > 0)) {
            e->lo = fmin(e->lo, values[i]);
            e->hi = fmax(e->hi, values[i]);
        }
}

/* A little air at both ends, so that no curve runs along the frame. */
static void fit(chart_axis *axis, chart_extent e, bool air) {
    if (axis->lo != axis->hi)
        return;
    if (!(e.lo <= e.hi))
        e = (chart_extent){axis->scale == CHART_LOG ? 0.1 : 0, 1};
    if (axis->scale == CHART_LOG) {
        double step = air ? fmax(dp_pow(e.hi / e.lo, 0.04), 1.05) : e.lo < e.hi ? 1 : 1.05;
        axis->lo = fmax(e.lo / step, 1e-300);
        axis->hi = fmin(e.hi * step, 1e300);
    } else {
        double step = e.hi > e.lo ? (e.hi - e.lo) * (air ? 0.04 : 0) : fmax(fabs(e.hi), 1) * 0.05;
        axis->lo = e.lo - step;
        axis->hi = e.hi + step;
    }
}

/* Bands stand on each other: what they reach is their sum. */
static void widen_y(chart_extent *e, const chart_panel *panel, bool second, chart_scale scale) {
    for (size_t s = 0; s < panel->series_count; s++)
        if (panel->series[s].kind != CHART_AREA && panel->series[s].second == second)
            widen(e, panel->series[s].y, panel->series[s].count, scale);
}

void chart_fit(chart *c) {
    chart_extent x = {INFINITY, -INFINITY}, y = x, second = x, value = x;
    for (size_t p = 0; p < c->panel_count; p++) {
        const chart_panel *panel = &c->panels[p];
        for (size_t s = 0; s < panel->series_count; s++)
            widen(&x, panel->series[s].x, panel->series[s].count, panel->x.scale);
        widen_y(&y, panel, false, panel->y.scale);
        widen_y(&second, panel, true, panel->second.scale);
        if (panel->map.value != NULL)
            widen(&value, panel->map.value, (size_t)panel->map.columns * (size_t)panel->map.rows, c->value.scale);
    }
    for (size_t p = 0; p < c->panel_count; p++) {
        fit(&c->panels[p].x, x, false);
        fit(&c->panels[p].y, y, true);
        fit(&c->panels[p].second, second, true);
    }
    fit(&c->value, value, false);
}

static void letter(chart_series *s, char which) {
    char name[CHART_TEXT];
    snprintf(name, sizeof name, "%c %.180s", which, s->name);
    memcpy(s->name, name, sizeof name);
}

static void join_axis(chart_axis *axis, const chart_axis *other, double unit) {
    axis->scale = axis->scale == CHART_LOG ? other->scale : axis->scale;
    axis->lo = fmin(axis->lo, other->lo * unit);
    axis->hi = fmax(axis->hi, other->hi * unit);
}

static void rescale(chart_series *s, double x, double y) {
    for (size_t i = 0; i < s->count; i++) {
        s->x[i] *= x;
        s->y[i] *= y;
    }
    s->certain_to *= x;
    if (x != 1)
        s->note[0] = '\0'; /* it has lengths */
}

/* Joins subtitles: the sentence of each, then those of both. */
static void join_subtitle(chart *c, const chart *other) {
    char text[sizeof c->subtitle];
    const char *rest = strstr(c->subtitle, ". "), *end = strstr(other->subtitle, ". ");
    const size_t own = rest != NULL ? (size_t)(rest - c->subtitle) : strlen(c->subtitle);
    const size_t others = end != NULL ? (size_t)(end - other->subtitle) : strlen(other->subtitle);
    snprintf(text, sizeof text, "A: %.*s. B: %.*s%s", (int)own, c->subtitle, (int)others, other->subtitle,
             c->subtitle + own);
    memcpy(c->subtitle, text, sizeof text);
}

bool chart_join(chart *c, const chart *other, int styles, double unit) {
    chart_panel *to = &c->panels[0];
    const chart_panel *from = &other->panels[0];
    if (c->panel_count * other->panel_count != 1 || strcmp(to->y.key, from->y.key) != 0)
        return false;
    const char *measured = strstr(to->y.unit, "scene unit");
    const double unit_y = measured == NULL ? 1 : measured == to->y.unit ? unit : 1 / unit;
    for (size_t s = 0; s < to->series_count; s++)
        letter(&to->series[s], 'A');
    for (size_t s = 0; s < from->series_count && to->series_count < CHART_SERIES; s++) {
        chart_series *added = &to->series[to->series_count++];
        *added = from->series[s];
        rescale(added, unit, unit_y);
        letter(added, 'B');
        added->style.colour += styles;
        added->style.stroke += styles;
        added->style.marker += added->style.marker < 0 ? 0 : styles;
    }
    join_axis(&to->x, &from->x, unit);
    join_axis(&to->y, &from->y, unit_y);
    join_subtitle(c, other);
    return true;
}

const char *chart_unit(const chart *c, const chart_axis *axis, char out[CHART_TEXT]) {
    static const char named[] = "scene unit";
    const char *at = c->unit != NULL ? strstr(axis->unit, named) : NULL;
    if (at == NULL)
        return axis->unit;
    const char *rest = at + strlen(named);
    snprintf(out, CHART_TEXT, "%.*s%s%s", (int)(at - axis->unit), axis->unit, c->unit, rest + (*rest == 's'));
    return out;
}

static void mix(uint64_t *h, const char *text) {
    do {
        *h = (*h ^ (unsigned char)*text) * UINT64_C(0x100000001B3);
    } while (*text++ != '\0');
}

/* Rounded to 30 bits, so that what differs in the last bits has one digest; each NaN is one, and so are the zeros. */
static uint64_t rounded(double value) {
    uint64_t bits;
    value = isnan(value) ? (double)NAN : value + 0.0;
    memcpy(&bits, &value, sizeof bits);
    return (bits + (UINT64_C(1) << 22)) >> 23;
}

/* A picture of 8 million pixels waits for this: a number is one product, whose upper half is folded into the lower. */
static void mix_numbers(uint64_t *h, const double *values, size_t count) {
    for (size_t i = 0; i < count; i++) {
        *h = (*h ^ rounded(values[i])) * UINT64_C(0x9E3779B97F4A7C15);
        *h ^= *h >> 32;
    }
}

/* Values, then what is under them. */
static void mix_map(uint64_t *h, const chart_map *m) {
    for (int row = 0; row < m->rows; row++)
        mix_numbers(h, chart_value_row(m, row, m->room), (size_t)m->columns);
    for (int row = 0; row < m->rows && (m->under != NULL || m->grounds.make != NULL); row++)
        mix_numbers(h, chart_under_row(m, row, m->room), (size_t)m->columns);
}

static void mix_axis(uint64_t *h, const chart_axis *axis) {
    mix(h, axis->key != NULL ? axis->key : "");
    mix(h, axis->unit != NULL ? axis->unit : "");
}

void chart_digest(const chart *c, char out[17]) {
    uint64_t h = UINT64_C(0xCBF29CE484222325);
    mix_axis(&h, &c->value);
    if (c->unit != NULL)
        mix(&h, c->unit);
    for (size_t p = 0; p < c->panel_count; p++) {
        const chart_panel *panel = &c->panels[p];
        mix(&h, panel->title);
        mix_axis(&h, &panel->x);
        mix_axis(&h, &panel->y);
        if (panel->second.label != NULL)
            mix_axis(&h, &panel->second);
        for (size_t s = 0; s < panel->series_count; s++) {
            mix(&h, panel->series[s].name);
            mix_numbers(&h, panel->series[s].x, panel->series[s].count);
            mix_numbers(&h, panel->series[s].y, panel->series[s].count);
            mix_numbers(&h, &panel->series[s].certain_to, isnan(panel->series[s].certain_to) ? 0U : 1U);
        }
        for (int k = 0; k < panel->map.columns && panel->map.names != NULL; k++)
            mix(&h, panel->map.names[k]);
        mix_numbers(&h, panel->map.x, (size_t)panel->map.columns);
        mix_numbers(&h, panel->map.y, (size_t)panel->map.rows);
        mix_map(&h, &panel->map);
    }
    snprintf(out, 17, "%016" PRIx64, h);
}
