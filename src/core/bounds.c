/* SPDX-License-Identifier: MIT */
#include "depthprec/bounds.h"

#include "core/boundary.h"
#include "core/curve.h"
#include "core/engine.h"
#include "core/extremes.h"
#include "depthprec/depth.h"

/* The codes from the nearest to the farthest of a range, as steps: rank 0 is the code at lo. */
typedef struct search {
    const dp_setup *setup;
    dp_worst *worst;
    uint32_t code_lo; /* the code stored at the range's near end */
    uint32_t count;   /* codes beyond it, towards far */
    double outward;   /* a factor above all rounding errors */
} search;

static uint32_t code_of_rank(const search *s, uint32_t rank) {
    return s->setup->reversed ? s->code_lo - rank : s->code_lo + rank;
}

static void offer_error(dp_worst *worst, double error, double z, uint32_t code) {
    if (error > worst->error || (error == worst->error && z < worst->error_z)) {
        worst->error = error;
        worst->error_z = z;
        worst->error_code = code;
    }
}

/* The error at one end of a cell that is a boundary of the lattice: closed form, nothing cancels. */
static double error_at_boundary(const dp_setup *setup, uint32_t code, int far_end) {
    const uint32_t upper = far_end != setup->reversed ? code + 1 : code;
    const dp_point boundary = dp_boundary_below(setup, upper).point;
    const dp_point centre = dp_point_of_code(&setup->spec.format, code);
    return far_end ? dp_curve_span(setup, centre, boundary) : dp_curve_span(setup, boundary, centre);
}

/* The error at a depth where a plane or the range cuts the cell. */
static double error_at_cut(const dp_setup *setup, uint32_t code, double z) {
    return isinf(z) ? HUGE_VAL : fabs(dp_error(setup, code, z));
}

static void visit(const search *s, uint32_t rank) {
    dp_worst *worst = s->worst;
    const dp_setup *setup = s->setup;
    const uint32_t code = code_of_rank(s, rank);
    const dp_cell cell = dp_cell_of(setup, code);
    const int cut_lo = code == setup->code_near || (rank == 0 && worst->lo >= cell.lo);
    const int cut_hi = code == setup->code_far || (rank == s->count && worst->hi <= cell.hi);
    const double lo = cut_lo && worst->lo > cell.lo ? worst->lo : cell.lo;
    const double hi = cut_hi && worst->hi < cell.hi ? worst->hi : cell.hi;
    offer_error(worst, cut_lo ? error_at_cut(setup, code, lo) : error_at_boundary(setup, code, 0), lo, code);
    offer_error(worst, cut_hi ? error_at_cut(setup, code, hi) : error_at_boundary(setup, code, 1), hi, code);
    if (cell.width > worst->interval || (cell.width == worst->interval && cell.lo < worst->interval_lo)) {
        worst->interval = cell.width;
        worst->interval_lo = cell.lo;
        worst->interval_hi = cell.hi;
        worst->interval_code = code;
    }
    if (isinf(cell.width) && !isinf(cell.lo)) /* truncated d3d stores infinity itself as a code of its own */
        worst->blind_from = cell.lo;
}

/*
 * Whether no cell with a code of the piece up to rank `last` can be as bad as the worst so far. No such cell spans
 * more than two of the piece's steps, nor reaches beyond the depth of the code behind it.
 */
static int dismissed(const search *s, uint32_t last, double step) {
    const dp_setup *setup = s->setup;
    const uint32_t code = code_of_rank(s, last);
    const double z =
        code == setup->code_far ? setup->spec.zfar : dp_stored(setup, setup->reversed ? code - 1 : code + 1);
    const double width = dp_curve_reach(setup, z, 2.0 * step) * s->outward;
    const double error = setup->spec.rounding == DP_ROUND_ZERO ? width : dp_curve_reach(setup, z, step) * s->outward;
    return width < s->worst->interval && error < s->worst->error;
}

/*
 * A piece of equal steps, between two ranks. Error and width are monotone over its inner codes; its two end codes
 * have half a cell in the neighbouring piece or are cut, so they and their neighbours are all that can be worst.
 */
static void visit_piece(const search *s, uint32_t first, uint32_t last, double step) {
    if (dismissed(s, last, step))
        return;
    for (uint32_t rank = first; rank <= last && rank - first < 2; rank++)
        visit(s, rank);
    for (uint32_t back = last - first < 2 ? 0 : last - first < 3 ? 1 : 2; back > 0; back--)
        visit(s, last - back + 1);
}

/*
 * staged: a piece has one step of the format, one of the window depth and one of the NDC depth, and the codes at its
 * ends are visited. A float's steps are powers of two, so what binary32 does to its cells repeats with every second
 * code: the last two inner codes stand for all. Those of a unorm format differ by whole binary32 steps, and the rest is
 * bounded by the widest, as if it stood at the far end.
 */
typedef struct stage {
    double code;   /* step of the format, in d */
    double window; /* step of the window depth */
    double ndc;    /* step of the NDC depth, in d */
    int twice;     /* both count */
} stage;

/*
 * unorm: the width of the widest cell of codes low..high in d. Cells hold a whole number of steps of the coarser
 * binary32 lattice; where x is the finer one, its ties to even give or take one of its steps.
 */
static double staged_width(const dp_setup *setup, const stage *g, uint32_t low, uint32_t high) {
    const double coarse = larger(g->window, g->ndc);
    const int odd = dp_format_is_rg(&setup->spec.format); /* its window steps are those of 255 w, here over 255 */
    const double tie = (g->ndc < g->window ? g->ndc : 0.0) + (odd ? g->window : 0.0);
    /* Boundaries at equal distances, rounded up to a lattice: cells hold the average, rounded down or up. */
    const float first = dp_staged_window(setup, low);
    const float last = dp_staged_window(setup, high + 1U); /* where the cell of high ends */
    const double span = g->window >= g->ndc
                            ? (double)last - (double)first
                            : 0.5 * ((double)dp_staged_ndc(setup, last) - (double)dp_staged_ndc(setup, first));
    const double total = span / coarse;
    const double cells = (double)(high - low) + 1.0;
    const double steps = ceil(total / cells);
    /* Cells of one even number of steps all begin alike, and their ties cancel. */
    const int alike = steps * cells == total && fmod(steps, 2.0) == 0.0;
    return steps * coarse + (alike ? 0.0 : tie);
}

static double staged_error(const dp_setup *setup, const stage *g) {
    const double format = g->code > g->window ? (setup->spec.rounding == DP_ROUND_ZERO ? g->code : 0.5 * g->code) : 0.0;
    return format + 0.5 * g->ndc + (g->twice && g->window > g->ndc ? 0.5 * g->window : 0.0);
}

static uint32_t rank_of_code(const search *s, uint32_t code) {
    return s->setup->reversed ? s->code_lo - code : code - s->code_lo;
}

static void visit_staged(const search *s, const stage *g, uint32_t low, uint32_t high) {
    const dp_setup *setup = s->setup;
    const double wide = g->code + g->ndc + (g->twice ? g->window : 0.0);
    const double error = staged_error(setup, g);
    const double z_end = dp_cell_of(setup, setup->reversed ? low : high).hi;
    if (dp_curve_reach(setup, z_end, wide) * s->outward < s->worst->interval &&
        dp_curve_reach(setup, z_end, error) * s->outward < s->worst->error)
        return;
    for (int i = 0; i < 3 && low < high; i++) {
        visit(s, rank_of_code(s, low));
        low = dp_boundary_below(setup, low + 1).above;
    }
    for (int i = 0; i < 3 && low < high; i++) {
        visit(s, rank_of_code(s, high));
        high = dp_boundary_below(setup, high).below;
    }
    if (low == high)
        visit(s, rank_of_code(s, low));
    if (low >= high || setup->spec.format.kind == DP_FORMAT_FLOAT)
        return;
    const double z = dp_cell_of(setup, setup->reversed ? low : high).hi;
    s->worst->interval = larger(s->worst->interval, dp_curve_reach(setup, z, staged_width(setup, g, low, high)));
    s->worst->error = larger(s->worst->error, dp_curve_reach(setup, z, error));
}

/* The ends of the staged pieces, from 1 down to 0: powers of two in w and, with signed NDC, in x = 2w - 1. */
static double staged_end(int ndc_signed, int index) {
    if (!ndc_signed)
        return index < 150 ? dp_power2(-index) : 0.0;
    if (index < 25)
        return 0.5 + dp_power2(-index - 1);
    if (index < 50)
        return 0.5 - dp_power2(index - 51);
    return index < 75 ? dp_power2(47 - index) : 0.0;
}

static void search_staged(const search *s, uint32_t bottom, uint32_t top) {
    const dp_setup *setup = s->setup;
    const dp_format *format = &setup->spec.format;
    const int ndc_signed = dp_mapping_get(setup->spec.mapping)->ndc_signed;
    visit(s, 0);
    visit(s, s->count);
    double end = staged_end(ndc_signed, 0);
    for (int i = 1; end > 0.0; i++) {
        const double begin = staged_end(ndc_signed, i);
        const uint32_t low = dp_staged_code(setup, begin);
        const uint32_t high = dp_staged_code(setup, end);
        const double middle = 0.5 * (begin + end);
        const stage g = {.code = dp_step_num(format, dp_binade(format, middle)) / setup->den,
                         .window = dp_staged_window_step(setup, middle),
                         .ndc = dp_staged_ndc_step(setup, middle),
                         .twice = dp_staged_twice(setup)};
        end = begin;
        if (low <= top && high >= bottom)
            visit_staged(s, &g, low > bottom ? low : bottom, high < top ? high : top);
    }
}

static void search_exact(const search *s, uint32_t bottom, uint32_t top) {
    const dp_setup *setup = s->setup;
    const dp_format *format = &setup->spec.format;
    /* Pieces from the coarsest step to the finest, so that most of the fine ones are dismissed at sight; in a reversed
       perspective cells are widest halfway to far, with which it begins. */
    const int shift = format->kind == DP_FORMAT_UNORM ? 32 : format->mantissa_bits;
    const double widest = fmax(s->worst->lo, fmin(s->worst->hi, 0.5 * setup->spec.zfar));
    const uint32_t begin_at = setup->reversed && setup->curve == DP_CURVE_PERSPECTIVE ? dp_code(setup, widest) : top;
    const int64_t lowest = (int64_t)((uint64_t)bottom >> shift), highest = (int64_t)((uint64_t)top >> shift);
    const int64_t start = (int64_t)((uint64_t)begin_at >> shift);
    for (int64_t i = 0; i <= highest - lowest; i++) {
        const int64_t piece = start - i >= lowest ? start - i : lowest + i;
        const uint64_t begin = (uint64_t)piece << shift;
        const uint64_t end = (uint64_t)(piece + 1) << shift;
        const uint32_t low = begin > bottom ? (uint32_t)begin : bottom;
        const uint32_t high = end < top ? (uint32_t)end : top;
        const int e = (int)(piece > 1 ? piece : 1) - format->bias;
        visit_piece(s, rank_of_code(s, setup->reversed ? high : low), rank_of_code(s, setup->reversed ? low : high),
                    dp_step_num(format, e) / setup->den);
    }
}

dp_status dp_worst_over(const dp_setup *setup, double lo, double hi, dp_worst *out) {
    if (setup == NULL || out == NULL)
        return DP_ERROR_NULL;
    if (!(lo >= setup->spec.znear && lo <= hi && hi <= setup->spec.zfar) || isinf(lo))
        return DP_ERROR_RANGE;
    const double none = (double)NAN;
    if (setup->spec.model == DP_MODEL_FLOAT) {
        *out = (dp_worst){lo, hi, none, none, 0, none, none, none, 0, none};
        return DP_OK;
    }
    *out = (dp_worst){.lo = lo, .hi = hi, .error = -1.0, .interval = -1.0, .blind_from = none};
    const uint32_t code_lo = dp_code(setup, lo);
    const uint32_t code_hi = dp_code(setup, hi);
    const uint32_t bottom = setup->reversed ? code_hi : code_lo;
    const uint32_t top = setup->reversed ? code_lo : code_hi;
    const search s = {setup, out, code_lo, top - bottom, dp_curve_outward(setup)};
    if (setup->spec.model == DP_MODEL_EXACT || dp_staged_is_exact(setup))
        search_exact(&s, bottom, top);
    else
        search_staged(&s, bottom, top);
    out->error *= s.outward;
    out->interval *= s.outward;
    return DP_OK;
}
