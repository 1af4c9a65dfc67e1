/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A row a set-up: the separation that is guaranteed at a few depths, and the depth up to which three separations are.
 * The set-up that takes the middle one farthest comes first; sentences below say what follows.
 */
#include "cli/compare.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "api/cost.h"
#include "cli/reach.h"
#include "core/append.h"
#include "report/number.h"

enum { DEPTHS = 5, LIMITS = REACH_LIMITS, MIDDLE = REACH_MIDDLE, NAMED = 3, DIGITS_BOUND = 2, DIGITS_Z = 6 };

typedef struct compared {
    const dp_setup *setup;
    cost cost;
    char name[SETUP_LABEL_SIZE];
    double separation[DEPTHS]; /* NaN where the depth is not in the range of the set-up */
    double up_to[LIMITS];      /* NaN: not even at near */
    uint64_t bytes;
} compared;

typedef struct comparison {
    walk *walk;
    compared *rows;
    double depths[DEPTHS];
    size_t depth_count;
    char titles[DEPTHS + LIMITS][NUMBER_SIZE];
} comparison;

/* ---- What is measured -------------------------------------------------------------------------------------------- */

static void measure(const comparison *c, compared *r) {
    const dp_setup full = reach_model(r->setup);
    dp_sample sample;
    for (size_t i = 0; i < c->depth_count; i++)
        r->separation[i] = dp_sample_at(&full, c->depths[i], &sample) == DP_OK ? sample.separation : (double)NAN;
    for (size_t i = 0; i < LIMITS; i++)
        r->up_to[i] = reach_of(&full, reach_limits[i]);
}

/* As far as it goes, then as close as it comes, then as cheap as it is. */
static int better(const void *a, const void *b) {
    const compared *first = a, *second = b;
    for (size_t i = 0; i < LIMITS; i++) {
        const size_t limit = (MIDDLE + i) % LIMITS;
        const double x = fmax(first->up_to[limit], 0.0), y = fmax(second->up_to[limit], 0.0);
        if (x != y)
            return x < y ? 1 : -1;
    }
    const int cheaper = cost_compare(&first->cost, &second->cost);
    return cheaper != 0 ? cheaper : first->setup < second->setup ? -1 : 1;
}

/* At most five of the depths asked about, else powers of ten: those that a reader looks for. */
static void choose_depths(comparison *c) {
    const options *o = c->walk->o;
    const double far = isinf(o->zfar) ? 1e6 * o->znear : o->zfar;
    if (option_given(o, OPTION_AT)) {
        for (c->depth_count = 0; c->depth_count < c->walk->at.count; c->depth_count++)
            c->depths[c->depth_count] = depths_get(&c->walk->at, c->depth_count);
        return;
    }
    const int first = (int)ceil(log10(o->znear) - 1e-9), last = (int)floor(log10(far) + 1e-9);
    const int step = (last - first) / DEPTHS + 1;
    for (int e = last - (last - first) / step * step; e <= last && c->depth_count < DEPTHS; e += step)
        c->depths[c->depth_count++] = fmin(fmax(pow(10.0, e), o->znear), o->zfar);
    if (c->depth_count == 0)
        c->depths[c->depth_count++] = far;
}

/* ---- Text -------------------------------------------------------------------------------------------------------- */

static bool to_the_end(const compared *r) {
    return r->up_to[MIDDLE] >= r->setup->spec.zfar;
}

static void say_farthest(page *p, const comparison *c, const char *limit) {
    const compared *best = c->rows;
    char names[256] = "", text[REACH_TEXT_SIZE];
    size_t all = 0;
    while (all < c->walk->all.count && to_the_end(&c->rows[all]))
        all++;
    for (size_t i = 0; i < all && i < NAMED; i++)
        append(names, sizeof names, "%s%s", i == 0 ? "" : i + 1 == all ? " and " : ", ", c->rows[i].name);
    if (all > NAMED)
        append(names, sizeof names, " and %zu others", all - NAMED);
    if (isnan(best->up_to[MIDDLE]))
        page_text(p, "None of these is sure to tell surfaces %s apart, not even at the near plane.", limit);
    else if (all == 0)
        page_text(p, "%s goes farthest: it tells surfaces %s apart up to z = %s.", best->name, limit,
                  reach_text(best->setup, best->up_to[MIDDLE], text));
    else
        page_text(p, "%s tell%s surfaces %s apart all the way to the far plane.", names, all == 1 ? "s" : "", limit);
}

/* The row of the same format, reversed with the same range of NDC depth; null where there is none. */
static const compared *reversed_of(const comparison *c, const compared *r) {
    const dp_mapping_row *here = dp_mapping_get(r->setup->spec.mapping);
    for (size_t i = 0; i < c->walk->all.count; i++) {
        const dp_spec *other = &c->rows[i].setup->spec;
        const dp_mapping_row *there = dp_mapping_get(other->mapping);
        if (!here->reversed && there->reversed && here->ndc_signed == there->ndc_signed &&
            here->curve == DP_CURVE_PERSPECTIVE && strcmp(other->format.name, r->setup->spec.format.name) == 0)
            return &c->rows[i];
    }
    return NULL;
}

static void say_reversing(page *p, const comparison *c, const char *limit) {
    char gains[512] = "", before[REACH_TEXT_SIZE], after[REACH_TEXT_SIZE];
    for (size_t i = 0; i < c->walk->all.count; i++) {
        const compared *r = &c->rows[i], *other = reversed_of(c, r);
        if (other == NULL || r->cost.buffer == 0 || isnan(r->up_to[MIDDLE]))
            continue;
        reach_text(r->setup, r->up_to[MIDDLE], before);
        reach_text(other->setup, other->up_to[MIDDLE], after);
        append(gains, sizeof gains, "%s %s", *gains != '\0' ? "," : "", r->name);
        append(gains, sizeof gains, strcmp(before, after) == 0 ? " no farther" : " from %s to %s", before, after);
    }
    if (*gains != '\0')
        page_text(p, "Reversing takes %s:%s.", limit, gains);
}

static void say_notes(page *p, void *item) {
    const comparison *c = item;
    const number_text limit = number_full(reach_limits[MIDDLE]);
    bool staged = false;
    output_char(p->out, '\n');
    say_farthest(p, c, limit.text);
    say_reversing(p, c, limit.text);
    for (size_t i = 0; i < c->walk->all.count; i++)
        staged = staged || dp_mapping_get(c->rows[i].setup->spec.mapping)->curve != DP_CURVE_PERSPECTIVE;
    if (staged)
        page_text(p, "linear and log are judged without the arithmetic of their shader (model staged).");
    for (size_t i = 0; i < c->walk->all.count; i++)
        if (c->rows[i].cost.buffer == 0) {
            page_text(p, "No API has %s as a depth buffer.", c->rows[i].setup->spec.format.name);
            break;
        }
    page_text(p, "--full prints the tables: codes, errors, intervals, worst cases.");
}

static void say_head(page *p, void *item) {
    const comparison *c = item;
    const options *o = c->walk->o;
    page_title(p, "near %s, far %s, %s", number_full(o->znear).text, number_full(o->zfar).text,
               o->ortho ? "orthographic" : "perspective");
    const int width = 7 * (int)c->depth_count;
    output_format(p->out, "%s%-20s%*s%*s%s\n", p->soft, "", width,
                  width > 27   ? "guaranteed separation at z"
                  : width > 20 ? "guaranteed at z"
                               : "at z",
                  7 * LIMITS, "told apart up to z", p->plain);
}

static void *next_row(void *of, size_t i) {
    comparison *c = of;
    return i < c->walk->all.count ? &c->rows[i] : NULL;
}

static void write(comparison *c) {
    column rows[1 + DEPTHS + LIMITS + 2] = {{TEXT_FIELD(compared, name, "", -20, 0)}};
    size_t n = 1;
    for (size_t i = 0; i < c->depth_count; i++) {
        snprintf(c->titles[i], NUMBER_SIZE, "%s", number_of(c->depths[i], DIGITS_Z).text);
        rows[n++] =
            (column){TEXT_FIELD(compared, separation[0], c->titles[i], 7, DIGITS_BOUND), .upward = true, .brief = true};
        rows[n - 1].offset = offsetof(compared, separation[i]);
    }
    for (size_t i = 0; i < LIMITS; i++) {
        char *title = c->titles[DEPTHS + i];
        snprintf(title, NUMBER_SIZE, "%s", number_full(reach_limits[i]).text);
        rows[n++] = (column){TEXT_FIELD(compared, up_to[0], title, 7, REACH_DIGITS), .downward = true, .brief = true};
        rows[n - 1].offset = offsetof(compared, up_to[i]);
    }
    rows[n++] = (column){TEXT_FIELD(compared, bytes, "B", 3, 0)};
    rows[n] = (column){.kind = COLUMN_END};
    const column columns[] = {{LIST(NULL, rows, next_row), .head = say_head, .notes = say_notes}, {.kind = COLUMN_END}};
    report_write(&(report_spec){"table", columns, c, .label = 16}, &c->walk->out, FORM_TEXT);
}

/* ---- The command ------------------------------------------------------------------------------------------------- */

bool compare_suits(const walk *w) {
    const options *o = w->o;
    return o->form == FORM_TEXT && w->all.count > 1 && !o->full && !o->verbose && !option_given(o, OPTION_MODEL) &&
           !option_given(o, OPTION_RANGE) && !option_given(o, OPTION_TOLERANCE) &&
           (!option_given(o, OPTION_AT) || w->at.count <= DEPTHS);
}

int compare_write(walk *w) {
    comparison c = {.walk = w, .rows = calloc(w->all.count, sizeof(compared))};
    int status = c.rows != NULL ? options_open(w->o, &w->out) : usage_error("table: no memory");
    if (status == EXIT_FINE) {
        choose_depths(&c);
        for (size_t i = 0; i < w->all.count; i++) {
            compared *r = &c.rows[i];
            r->setup = &w->all.items[i];
            r->cost = cost_of(&r->setup->spec.format, r->setup->spec.mapping);
            r->bytes = (uint64_t)r->cost.bytes;
            setup_label(r->setup, false, r->name);
            measure(&c, r);
        }
        qsort(c.rows, w->all.count, sizeof *c.rows, better);
        write(&c);
        status = output_close(&w->out);
    }
    free(c.rows);
    setups_release(&w->all);
    return status;
}
