/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "sweep.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { BLOCK = 2048, CAP = 3000 };

void sweep_init(sweep *s) {
    memset(s, 0, sizeof *s);
    mpq_inits(s->error.value, s->error.z, s->interval.value, s->interval.z, s->interval_hi, s->blind_from, NULL);
}

void sweep_clear(sweep *s) {
    mpq_clears(s->error.value, s->error.z, s->interval.value, s->interval.z, s->interval_hi, s->blind_from, NULL);
}

/* ---- exact ---- */

/* @return whether the new value is the better one: larger, or equal and nearer */
static int improve(sweep_best *best, const mpq_t value, const mpq_t z, uint32_t code) {
    int order = best->infinite ? -1 : mpq_cmp(value, best->value);
    int nearer = mpq_cmp(z, best->z);
    if (order == 0 && nearer == 0)
        best->other = code;
    if (order < 0 || (order == 0 && nearer >= 0))
        return 0;
    mpq_set(best->value, value);
    mpq_set(best->z, z);
    best->code = best->other = code;
    return 1;
}

static void improve_infinite(sweep_best *best, const mpq_t z, uint32_t code) {
    if (best->infinite && mpq_cmp(z, best->z) >= 0)
        return;
    best->infinite = 1;
    mpq_set(best->z, z);
    best->code = best->other = code;
}

typedef struct range {
    mpq_t lo, hi;
    int hi_infinite;
} range;

static void consider(sweep *s, oracle *o, const range *r, uint32_t code) {
    oracle_cell cell;
    oracle_cell_init(&cell);
    oracle_cell_of(o, &cell, code);
    mpq_t from, to, value;
    mpq_inits(from, to, value, NULL);
    s->candidates++;
    if (cell.hi_infinite) {
        if (!cell.lo_infinite) {
            if (!s->blind || mpq_cmp(cell.lo, s->blind_from) < 0)
                mpq_set(s->blind_from, cell.lo);
            s->blind = 1;
            improve_infinite(&s->interval, cell.lo, code);
        }
    } else {
        mpq_sub(value, cell.hi, cell.lo);
        if (improve(&s->interval, value, cell.lo, code))
            mpq_set(s->interval_hi, cell.hi);
    }
    mpq_set(from, !cell.lo_infinite && mpq_cmp(cell.lo, r->lo) > 0 ? cell.lo : r->lo);
    int endless = cell.hi_infinite && r->hi_infinite;
    if (cell.stored_infinite || endless) {
        if (!cell.lo_infinite)
            improve_infinite(&s->error, from, code);
    } else {
        mpq_sub(value, cell.stored, from);
        mpq_abs(value, value);
        improve(&s->error, value, from, code);
        mpq_set(to, r->hi_infinite || (!cell.hi_infinite && mpq_cmp(cell.hi, r->hi) < 0) ? cell.hi : r->hi);
        mpq_sub(value, cell.stored, to);
        mpq_abs(value, value);
        improve(&s->error, value, to, code);
    }
    mpq_clears(from, to, value, NULL);
    oracle_cell_clear(&cell);
}

/* ---- fast ---- */

typedef struct fast {
    const dp_format *format;
    int zero, reversed, log, perspective;
    double phi, reach, scale;          /* reach: n (1 - phi), or f - anchor; scale: log(C f + 1) */
    double below[BLOCK], above[BLOCK]; /* errors at the two ends of each cell of a block, in d's direction */
} fast;

static double float_value(const dp_format *format, uint32_t code) {
    int m = format->mantissa_bits;
    uint64_t fraction = code & ((1u << m) - 1), exponent = code >> m;
    uint64_t bits = ((exponent + (uint64_t)(1023 - format->bias)) << 52) | (fraction << (52 - m));
    double normal;
    memcpy(&normal, &bits, sizeof normal);
    uint64_t unit_bits = (uint64_t)(1023 + 1 - format->bias - m) << 52;
    double unit;
    memcpy(&unit, &unit_bits, sizeof unit);
    return exponent ? normal : (double)fraction * unit;
}

/* The values v of `count` codes from `first`, the boundaries around them, and their complements. */
static void lattice(const fast *x, uint32_t first, int count, double *v, double *q, double *edge, double *edge_q) {
    if (x->format->kind == DP_FORMAT_UNORM) {
        double m = x->format->code_max, half = x->zero ? 0 : 0.5;
        for (int i = 0; i < count; i++) {
            double c = first + (double)i;
            v[i] = c / m;
            q[i] = (m - c) / m;
        }
        for (int i = 0; i <= count; i++) {
            double c = first + (double)i - half;
            edge[i] = c / m;
            edge_q[i] = (m - c) / m;
        }
        return;
    }
    double before = float_value(x->format, first - 1);
    for (int i = 0; i < count; i++)
        v[i] = float_value(x->format, first + (uint32_t)i);
    double after = float_value(x->format, first + (uint32_t)count);
    for (int i = 0; i <= count; i++) {
        double here = i < count ? v[i] : after, less = i > 0 ? v[i - 1] : before;
        edge[i] = x->zero ? here : 0.5 * (here + less);
        edge_q[i] = 1 - edge[i];
    }
    for (int i = 0; i < count; i++)
        q[i] = 1 - v[i];
}

/* Fills below[] and above[] for codes that have a neighbour on either side. */
static void errors(fast *x, uint32_t first, int count) {
    double v[BLOCK], q[BLOCK], edge[BLOCK + 1], edge_q[BLOCK + 1];
    lattice(x, first, count, v, q, edge, edge_q);
    double down[BLOCK], up[BLOCK];
    double step = 1.0 / x->format->code_max;
    for (int i = 0; i < count; i++) { /* gaps: differences of floats are exact, those of UNORM are constant */
        int unorm = x->format->kind == DP_FORMAT_UNORM;
        down[i] = unorm ? (x->zero ? 0 : 0.5 * step) : v[i] - edge[i];
        up[i] = unorm ? (x->zero ? step : 0.5 * step) : edge[i + 1] - v[i];
    }
    if (x->log) {
        double gap_down = -1, gap_up = -1, part_down = 0, part_up = 0;
        for (int i = 0; i < count; i++) {
            if (down[i] != gap_down || up[i] != gap_up) {
                gap_down = down[i];
                gap_up = up[i];
                part_down = -expm1(-x->scale * gap_down) * x->reach;
                part_up = expm1(x->scale * gap_up) * x->reach;
            }
            double e = exp(x->scale * v[i]);
            x->below[i] = e * part_down;
            x->above[i] = e * part_up;
        }
    } else if (x->perspective) {
        double at_edge[BLOCK + 1], of_d = x->reversed ? 1 : x->phi, of_q = x->reversed ? x->phi : 1;
        for (int i = 0; i <= count; i++)
            at_edge[i] = 1 / (of_d * edge[i] + of_q * edge_q[i]);
        for (int i = 0; i < count; i++) {
            double at = x->reach / (of_d * v[i] + of_q * q[i]);
            x->below[i] = down[i] * at * at_edge[i];
            x->above[i] = up[i] * at * at_edge[i + 1];
        }
    } else {
        for (int i = 0; i < count; i++) {
            x->below[i] = down[i] * x->reach;
            x->above[i] = up[i] * x->reach;
        }
    }
}

static fast prepare(const oracle *o) {
    const dp_spec *spec = &o->spec;
    fast x = {.format = &spec->format, .zero = spec->rounding == DP_ROUND_ZERO, .reversed = o->reversed, .log = o->log};
    x.perspective = o->perspective;
    x.phi = o->infinite ? 0 : spec->znear / spec->zfar;
    if (o->log) {
        x.scale = mpfr_get_d(o->log_far, MPFR_RNDN);
        x.reach = o->over_near ? spec->znear : 1 / spec->log_c;
    } else if (o->perspective) {
        x.reach = o->infinite ? spec->znear : spec->znear * ((spec->zfar - spec->znear) / spec->zfar);
    } else {
        x.reach = spec->ortho ? spec->zfar - spec->znear : spec->zfar;
    }
    return x;
}

typedef struct peak {
    double error, width;
} peak;

static peak peak_of(fast *x, uint32_t first, int count) {
    errors(x, first, count);
    peak p = {0, 0};
    for (int i = 0; i < count; i++) {
        double worse = x->below[i] > x->above[i] ? x->below[i] : x->above[i], width = x->below[i] + x->above[i];
        p.error = worse > p.error ? worse : p.error;
        p.width = width > p.width ? width : p.width;
    }
    return p;
}

/* Considers exactly the codes near the peak: in one direction, up to CAP of each kind. */
static void pick(sweep *s, oracle *o, const range *r, fast *x, const peak *blocks, peak top, uint32_t low,
                 uint32_t high, int downwards) {
    uint64_t count = (uint64_t)high - low + 1, block_count = (count + BLOCK - 1) / BLOCK;
    double error = top.error * (1 - 1e-13), width = top.width * (1 - 1e-13);
    int errors_left = CAP, widths_left = CAP;
    for (uint64_t k = 0; k < block_count && errors_left + widths_left > 0; k++) {
        uint64_t b = downwards ? block_count - 1 - k : k;
        if (!((blocks[b].error >= error && errors_left) || (blocks[b].width >= width && widths_left)))
            continue;
        uint32_t first = low + (uint32_t)(b * BLOCK);
        uint64_t left = high - (uint64_t)first + 1;
        int size = left < BLOCK ? (int)left : BLOCK;
        errors(x, first, size);
        for (int j = 0; j < size; j++) {
            int i = downwards ? size - 1 - j : j;
            int is_error = errors_left && fmax(x->below[i], x->above[i]) >= error;
            int is_width = widths_left && x->below[i] + x->above[i] >= width;
            if (is_error || is_width)
                consider(s, o, r, first + (uint32_t)i);
            errors_left -= is_error;
            widths_left -= is_width;
        }
    }
}

void sweep_over(sweep *s, oracle *o, double lo, double hi) {
    range r;
    mpq_inits(r.lo, r.hi, NULL);
    mpq_set_d(r.lo, lo);
    r.hi_infinite = isinf(hi);
    if (!r.hi_infinite)
        mpq_set_d(r.hi, hi);
    uint32_t a = oracle_code(o, lo), b = oracle_code(o, hi);
    uint32_t low = a < b ? a : b, high = a < b ? b : a;
    s->codes = (uint64_t)high - low + 1;
    enum { ENDS = 16, FEW = 1000 };
    if (s->codes <= FEW) {
        for (uint64_t c = low; c <= high; c++)
            consider(s, o, &r, (uint32_t)c);
    } else { /* the ends may be cut by the range or the planes, or unbounded: exactly; between them fast */
        for (uint32_t i = 0; i < ENDS; i++) {
            consider(s, o, &r, low + i);
            consider(s, o, &r, high - i);
        }
        low += ENDS;
        high -= ENDS;
        uint64_t count = (uint64_t)high - low + 1, block_count = (count + BLOCK - 1) / BLOCK;
        peak *blocks = malloc(block_count * sizeof *blocks), top = {0, 0};
        if (!blocks)
            abort();
        fast x = prepare(o);
        for (uint64_t k = 0; k < block_count; k++) {
            uint64_t left = count - k * BLOCK;
            blocks[k] = peak_of(&x, low + (uint32_t)(k * BLOCK), left < BLOCK ? (int)left : BLOCK);
            top.error = fmax(top.error, blocks[k].error);
            top.width = fmax(top.width, blocks[k].width);
        }
        pick(s, o, &r, &x, blocks, top, low, high, 0);
        pick(s, o, &r, &x, blocks, top, low, high, 1);
        free(blocks);
    }
    mpq_clears(r.lo, r.hi, NULL);
}
