/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "quantity/cmd_table/slices.h"

#include <math.h>

#include "core/append.h"
#include "core/engine.h"
#include "report/number.h"

enum { PAIRS_SAID = 4, DIGITS_Z = 6, DIGITS_Z_MOST = 15 };

/* The codes of near and far in the lattice, the lesser first. */
static void ends_of(const dp_setup *setup, double out[2]) {
    dp_setup exact;
    dp_setup_in(setup, DP_MODEL_EXACT, &exact); /* which all mappings have */
    const double near = dp_code(&exact, setup->spec.znear), far = dp_code(&exact, setup->spec.zfar);
    out[0] = fmin(near, far);
    out[1] = fmax(near, far);
}

double slice_codes(const dp_setup *setup) {
    double ends[2];
    ends_of(setup, ends);
    return ends[1] - ends[0] + 1.0;
}

double slice_share(const dp_setup *setup) {
    return slice_codes(setup) / ((double)setup->spec.format.code_max + 1.0);
}

static slice_span span_of(const dp_setup *setup, uint32_t from, uint32_t to) {
    dp_setup exact;
    dp_setup_in(setup, DP_MODEL_EXACT, &exact);
    const dp_cell a = dp_cell_of(&exact, from), b = dp_cell_of(&exact, to);
    const double *range = setup->spec.depth_range;
    return (slice_span){range[0], range[1], a.lo < b.lo ? a.lo : b.lo, a.hi > b.hi ? a.hi : b.hi};
}

static bool share(const dp_setup *a, const dp_setup *b, slice_pair *out) {
    double ends[2], others[2];
    ends_of(a, ends);
    ends_of(b, others);
    const double from = fmax(ends[0], others[0]), to = fmin(ends[1], others[1]);
    if (from > to)
        return false;
    *out = (slice_pair){.mapping = dp_mapping_get(a->spec.mapping)->name,
                        .format = a->spec.format.name,
                        .first = span_of(a, (uint32_t)from, (uint32_t)to),
                        .second = span_of(b, (uint32_t)from, (uint32_t)to),
                        .codes = to - from + 1.0,
                        .from = (uint32_t)from,
                        .to = (uint32_t)to};
    return true;
}

bool slices_shared(const setups *all, size_t index, slice_pair *out) {
    for (size_t i = 0; i < all->count; i++)
        for (size_t k = i + 1; k < all->count && setup_repeats(all, k); k++)
            if (share(&all->items[i], &all->items[k], out) && index-- == 0)
                return true;
    return false;
}

static const column span_columns[] = {{FIELD(slice_span, lo, "lo", "")},
                                      {FIELD(slice_span, hi, "hi", "")},
                                      {FIELD(slice_span, z_lo, "z_lo", "scene")},
                                      {FIELD(slice_span, z_hi, "z_hi", "scene")},
                                      {.kind = COLUMN_END}};

const column slice_columns[] = {
    {FIELD(slice_pair, mapping, "mapping", "")},      {FIELD(slice_pair, format, "format", "")},
    {PART(slice_pair, first, "first", span_columns)}, {PART(slice_pair, second, "second", span_columns)},
    {FIELD(slice_pair, codes, "codes", "")},          {FIELD(slice_pair, from, "code_from", "")},
    {FIELD(slice_pair, to, "code_to", "")},           {.kind = COLUMN_END}};

/* " from z = 993.93 to 1000 of 0.1:1", outwards. */
static void append_span(char *out, size_t size, const slice_span *s) {
    const int digits = number_digits_within(s->z_lo, fmin(s->z_hi - s->z_lo, s->z_lo), DIGITS_Z, DIGITS_Z_MOST);
    append(out, size, "z = %s to %s of %s:%s", number_down(s->z_lo, digits).text, number_up(s->z_hi, digits).text,
           number_full(s->lo).text, number_full(s->hi).text);
}

static void say_pair(page *p, const slice_pair *pair) {
    char text[512] = "";
    append_span(text, sizeof text, &pair->first);
    append(text, sizeof text, " and ");
    append_span(text, sizeof text, &pair->second);
    if (pair->codes == 1.0)
        page_text(p, "Of %s %s code %u is stored for %s.", pair->format, pair->mapping, pair->from, text);
    else
        page_text(p, "Of %s %s %.0f codes, %u to %u, are stored for %s.", pair->format, pair->mapping, pair->codes,
                  pair->from, pair->to, text);
}

void slices_say(page *p, const camera_asked *c, const setups *all) {
    slice_pair pair;
    size_t count = 0;
    if (c->range_count < 2)
        return;
    for (; slices_shared(all, count, &pair); count++)
        if (count < PAIRS_SAID)
            say_pair(p, &pair);
    if (count > PAIRS_SAID)
        page_text(p, "%zu other pair%s codes: --json has %s.", count - PAIRS_SAID,
                  count - PAIRS_SAID == 1 ? " of ranges shares" : "s of ranges share",
                  count - PAIRS_SAID == 1 ? "it" : "them");
    page_text(p, count == 0 ? "No two of these ranges share a code."
                            : "There the ranges do not part two layers: depth or the order of drawing decides.");
}
