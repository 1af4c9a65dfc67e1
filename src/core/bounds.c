/* SPDX-License-Identifier: MIT */
#include "depthprec/bounds.h"

#include "core/curve.h"
#include "depthprec/depth.h"

/* Outward by more than the rounding errors of any width or error below. */
static const double outward = 1.0 + 0x1p-48;

/* The codes from the nearest to the farthest of a range, as steps: rank 0 is the code at lo. */
typedef struct search {
    const dp_setup *setup;
    dp_worst *worst;
    uint32_t code_lo; /* the code stored at the range's near end */
    uint32_t count;   /* codes beyond it, towards far */
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
    const dp_format *format = &setup->spec.format;
    const uint32_t upper = far_end != setup->reversed ? code + 1 : code;
    const dp_point boundary = dp_point_below(format, setup->spec.rounding, upper);
    const dp_point centre = dp_point_of_code(format, code);
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
    const int cut_lo = code == setup->code_near || (rank == 0 && worst->lo > cell.lo);
    const int cut_hi = code == setup->code_far || (rank == s->count && worst->hi < cell.hi);
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
    if (isinf(cell.width))
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
    const double width = dp_curve_reach(setup, z, 2.0 * step) * outward;
    const double error = setup->spec.rounding == DP_ROUND_ZERO ? width : dp_curve_reach(setup, z, step) * outward;
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

dp_status dp_worst_over(const dp_setup *setup, double lo, double hi, dp_worst *out) {
    if (setup == NULL || out == NULL)
        return DP_ERROR_NULL;
    if (!(lo >= setup->spec.znear && lo <= hi && hi <= setup->spec.zfar) || isinf(lo))
        return DP_ERROR_RANGE;
    *out = (dp_worst){.lo = lo, .hi = hi, .error = -1.0, .interval = -1.0, .blind_from = (double)NAN};
    const uint32_t code_lo = dp_code(setup, lo);
    const uint32_t code_hi = dp_code(setup, hi);
    const uint32_t bottom = setup->reversed ? code_hi : code_lo;
    const uint32_t top = setup->reversed ? code_lo : code_hi;
    const search s = {setup, out, code_lo, top - bottom};
    const dp_format *format = &setup->spec.format;
    /* Pieces from the coarsest step to the finest, so that most of the fine ones are dismissed at sight. */
    const int shift = format->kind == DP_FORMAT_UNORM ? 32 : format->mantissa_bits;
    for (int64_t piece = (int64_t)((uint64_t)top >> shift); piece >= (int64_t)((uint64_t)bottom >> shift); piece--) {
        const uint64_t begin = (uint64_t)piece << shift;
        const uint64_t end = (uint64_t)(piece + 1) << shift;
        const uint32_t low = begin > bottom ? (uint32_t)begin : bottom;
        const uint32_t high = end < top ? (uint32_t)end : top;
        const int e = (int)(piece > 1 ? piece : 1) - format->bias;
        visit_piece(&s, setup->reversed ? code_lo - high : low - code_lo,
                    setup->reversed ? code_lo - low : high - code_lo, dp_step_num(format, e) / setup->den);
    }
    out->error *= outward;
    out->interval *= outward;
    return DP_OK;
}
