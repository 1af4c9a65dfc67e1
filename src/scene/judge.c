/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scene/judge.h"

#include <math.h>

#include "core/engine.h"
#include "quantity/quantity.h"
#include "solve/distance.h"

enum { DIGITS = 6 };

/* ---- Ties -------------------------------------------------------------------------------------------------------- */

/* Codes whose cells get wider with depth: all of a UNORM, one binade of a float. */
typedef struct piece {
    uint32_t nearest, farthest;
} piece;

static uint32_t towards(uint32_t from, uint32_t to, uint32_t by) {
    return from < to ? from + by : from - by;
}

/* The last cell of a piece that is not wider than `most`; its nearest one is not. */
static dp_cell last_narrow(const dp_setup *setup, const piece *p, double most) {
    uint32_t narrow = 0, wide = p->nearest < p->farthest ? p->farthest - p->nearest : p->nearest - p->farthest;
    if (!(dp_cell_of(setup, p->farthest).width > most))
        return dp_cell_of(setup, p->farthest);
    while (wide - narrow > 1) {
        const uint32_t middle = narrow + (wide - narrow) / 2;
        if (dp_cell_of(setup, towards(p->nearest, p->farthest, middle)).width > most)
            wide = middle;
        else
            narrow = middle;
    }
    return dp_cell_of(setup, towards(p->nearest, p->farthest, narrow));
}

/* The piece that ends at code `farthest`; the cells of the planes, which are cut off there, are not among them. */
static piece piece_to(const dp_setup *setup, uint32_t farthest, uint32_t first) {
    const dp_format *f = &setup->spec.format;
    piece p = {first, farthest};
    if (f->kind == DP_FORMAT_FLOAT) {
        const uint32_t binade = farthest >> f->mantissa_bits;
        const uint32_t low = binade << f->mantissa_bits, high = low + ((1U << f->mantissa_bits) - 1U);
        if (first < farthest)
            p.nearest = low > first ? low : first;
        else
            p.nearest = high < first ? high : first;
    }
    return p;
}

static double ties_from(const dp_setup *setup, double most, double within) {
    dp_setup exact;
    if (!dp_setup_in(setup, DP_MODEL_EXACT, &exact))
        return (double)NAN;
    const uint32_t near_end = exact.code_near, far_end = dp_code(&exact, within);
    if ((near_end > far_end ? near_end - far_end : far_end - near_end) < 3)
        return (double)NAN;
    const uint32_t first = towards(near_end, far_end, 1), last = towards(far_end, near_end, 1);
    if (!(dp_cell_of(&exact, last).width > most))
        return (double)NAN;
    for (uint32_t farthest = last;;) {
        const piece p = piece_to(&exact, farthest, first);
        if (!(dp_cell_of(&exact, p.nearest).width > most))
            return last_narrow(&exact, &p, most).hi;
        if (p.nearest == first)
            return setup->spec.znear;
        farthest = towards(p.nearest, near_end, 1);
    }
}

/* ---- Both -------------------------------------------------------------------------------------------------------- */

scene_verdict scene_judge(const dp_setup *setup, double least, double most, double within) {
    const double znear = setup->spec.znear, zfar = setup->spec.zfar;
    scene_verdict v = {.certain_to = (double)NAN, .ties_from = ties_from(setup, most, within)};
    if (least > 0.0)
        v.certain_to = distance_about(setup, znear, zfar, least, DIGITS);
    v.lift = fmax(quantity_bound(QUANTITY_SEPARATION, setup, znear, within) - least, 0.0);
    return v;
}
