/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "texture/sensor_fit.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

#include "core/clones.h"
#include "core/elementary.h"
#include "texture/sensor_levels.h"

enum {
    WINDOW = 48,         /* values that a comb is laid on, */
    NEIGHBOURS = 96,     /* the commonest of so many */
    WINDOWS = 6,         /* windows and, in each, values that may be the comb's origin */
    ORIGINS = 3,         /* ... as one may be off */
    TEETH_MAX = 1 << 16, /* frequencies, */
    BLOCK = 256,         /* ... so many at a time */
    PEAKS = 12,
    TELLING = 6, /* of a step, the share that a value may be off by to count, or to be fitted */
    FITTING = 5,
    WEIGHT_MOST = 16, /* of a value, in pixels */
    ENDS = 64,        /* values at either end that bound the step */
    SIGMAS = 4,       /* of how many may be astray */
    TOLD = 4096,      /* values that the chance is of, at most: any choice of them proves it */
    EXPONENTS = 48,   /* of Chernoff's base */
    FACTORS = 16,     /* of a product: 48 bits each at most, so that it is finite */
    EXTENSIONS = 64,
    ROUNDS = 64
};

/* The share of an `off` that a cover of all lattices may shift step and offset by; log2 of the octaves of steps. */
static const double COVER = 0.25, OCTAVES = 6;

/* ---- The chance -------------------------------------------------------------------------------------------------- */

double fit_chance(const double *probabilities, size_t count, size_t on) {
    double most = 0;
    for (int e = 1; e <= EXPONENTS; e++) {
        const double base = ldexp(1, e);
        double bits = (double)on * e;
        for (size_t i = 0; i < count; i += FACTORS) {
            double product = 1;
            for (size_t k = i; k < count && k < i + FACTORS; k++)
                product *= 1 + fmin(probabilities[k], 1) * (base - 1);
            bits -= dp_log2(product);
        }
        if (!(bits > most))
            break; /* it is concave in the base's logarithm */
        most = bits;
    }
    return most;
}

/* The distance of a value from the nearest level. */
static double residual_of(const fit *f, double at) {
    const double k = (at - f->offset) / f->step;
    return (k - rint(k)) * f->step;
}

static double residual(const fit *f, double at) {
    return fabs(residual_of(f, at));
}

bool fit_holds(const fit *f, const fit_value *value) {
    return residual(f, value->at) <= value->off * (1 + 0x1p-20);
}

/* Values that can tell: a comb of random phase meets them with a chance of half or less; somewhat more for a fit. */
static bool can_tell(const fit *f, const fit_value *value, double telling) {
    return value->off < f->step / telling;
}

static void weigh(const fit_value *values, size_t count, double telling, fit *f) {
    double chances[TOLD], halves[TOLD], least = (double)INFINITY, last = (double)NAN, pixels = 0, all = 0;
    const size_t stride = 1 + (count - 1) / TOLD;
    size_t told = 0, on = 0;
    f->levels = 0;
    for (size_t i = 0; i < count; i++) {
        const bool held = fit_holds(f, &values[i]), tells = can_tell(f, &values[i], telling);
        const double k = rint((values[i].at - f->offset) / f->step);
        pixels += held ? values[i].pixels : 0;
        all += values[i].pixels;
        if (!tells)
            continue;
        const bool alone = held && k != last; /* a level becomes one sample: a second one is on none */
        least = fmin(least, values[i].off);
        last = held ? k : last;
        f->levels += alone;
        if (i % stride == 0) {
            halves[told] = 0.5;
            chances[told++] = 2 * (1 + 2 * COVER) * values[i].off / f->step;
            on += alone;
        }
    }
    const double span = values[count - 1].at - values[0].at, unit = COVER * least;
    const double lattices = dp_log2(fmax(span / unit, 1)) + dp_log2(fmax(f->step / unit, 1)) + OCTAVES;
    f->pixels = pixels / all;
    f->bits = told > 0 ? fit_chance(chances, told, on) - lattices : 0;
    f->whole = told > 0 ? fit_chance(halves, told, on) : 0;
}

bool fit_explains(const fit *f) {
    return f->bits >= FIT_BITS && f->whole >= FIT_WHOLE && f->levels >= FIT_LEVELS;
}

/* A half or a third of a step holds values, too, and averages of neighbours besides: the coarsest that explains them is
 * meant. */
static bool is_better(const fit *f, const fit *than) {
    const bool explains = fit_explains(f);
    if (explains != fit_explains(than))
        return explains;
    return explains && fmax(f->step, than->step) > 1.5 * fmin(f->step, than->step) ? f->step > than->step
                                                                                   : f->bits > than->bits;
}

/* ---- From a step that is nearly right to all values -------------------------------------------------------------- */

/* Least squares over values from a to b that lie within their own rounding and `slack` steps. @return false where the
 * lattice does not hold them */
static bool regress(const fit_value *values, size_t a, size_t b, double slack, fit *f) {
    const double origin = values[a + (b - a) / 2].at, first = rint((origin - f->offset) / f->step);
    double sum = 0, sk = 0, su = 0, skk = 0, sku = 0, pixels = 0, all = 0;
    for (size_t i = a; i < b; i++) {
        const fit_value *v = &values[i];
        if (!can_tell(f, v, FITTING))
            continue;
        all += v->pixels;
        if (residual(f, v->at) > fmin(v->off + slack * f->step, 0.375 * f->step))
            continue;
        pixels += v->pixels;
        const double k = rint((v->at - f->offset) / f->step) - first, u = v->at - origin;
        const double weight = fmin(v->pixels, WEIGHT_MOST) / (v->off * v->off) * (f->step * f->step);
        sum += weight;
        sk += weight * k;
        su += weight * u;
        skk += weight * k * k;
        sku += weight * k * u;
    }
    const double spread = sum * skk - sk * sk;
    if (!(pixels >= 0.625 * all && spread > 1e-9 * sum * skk))
        return false;
    const double step = (sum * sku - sk * su) / spread;
    if (!(step > 0.5 * f->step && step < 2 * f->step))
        return false;
    f->offset = origin + (su - step * sk) / sum - step * first;
    f->step = step;
    return true;
}

static bool extend(const fit_value *values, size_t count, size_t a, size_t b, fit *f) {
    for (int i = 0; i < EXTENSIONS; i++) {
        if (!regress(values, a, b, 0.125, f) || !regress(values, a, b, 0.0625, f))
            return false;
        if (a == 0 && b == count)
            return regress(values, 0, count, 0.03125, f) && regress(values, 0, count, 0, f);
        const double lo = values[a].at, hi = values[b - 1].at, more = 0.5 * (hi - lo);
        while (a > 0 && values[a - 1].at >= lo - more)
            a--;
        while (b < count && values[b].at <= hi + more)
            b++;
        if (a > 0 && values[a].at == lo)
            a--; /* over a gap */
        if (b < count && values[b - 1].at == hi)
            b++;
    }
    return false;
}

/* ---- Where a comb stands out -------------------------------------------------------------------------------------*/

typedef struct comb {
    double at[WINDOW], distance[WINDOW];
    size_t count, first, end; /* of the values */
    double lo, spacing;       /* frequencies */
    size_t teeth;
    double *scores; /* room for TEETH_MAX */
} comb;

/* The commonest values of a window; of equals the first. */
static void lay(const fit_value *values, size_t count, size_t first, comb *c) {
    const size_t end = first + NEIGHBOURS < count ? first + NEIGHBOURS : count;
    bool taken[NEIGHBOURS] = {false};
    c->first = first;
    c->end = end;
    c->count = 0;
    while (c->count < WINDOW && c->count < end - first) {
        size_t best = end;
        for (size_t i = first; i < end; i++)
            if (!taken[i - first] && (best == end || values[i].pixels > values[best].pixels))
                best = i;
        taken[best - first] = true;
        c->at[c->count++] = values[best].at;
    }
}

static int compare_doubles(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return x < y ? -1 : x > y;
}

/* Tries teeth from a quarter of the window up to sixteen steps in the usual gap, or to what rounding leaves. */
static bool choose_teeth(const fit_value *values, comb *c) {
    double sorted[WINDOW] = {0}, gaps[WINDOW] = {0}, off = 0;
    for (size_t i = 0; i < c->count; i++)
        sorted[i] = c->at[i];
    qsort(sorted, c->count, sizeof *sorted, compare_doubles);
    for (size_t i = 0; i + 1 < c->count; i++)
        gaps[i] = sorted[i + 1] - sorted[i];
    qsort(gaps, c->count - 1, sizeof *gaps, compare_doubles);
    for (size_t i = c->first; i < c->end; i++)
        off += values[i].off / (double)(c->end - c->first);
    const double range = sorted[c->count - 1] - sorted[0];
    const double hi = fmin(1 / (3 * off), 16 / gaps[c->count / 4]);
    c->lo = 4 / range;
    c->spacing = 0.25 / range;
    if (!(hi > c->lo))
        return false;
    c->teeth = (size_t)fmin((hi - c->lo) / c->spacing, TEETH_MAX);
    return c->teeth > 2;
}

/* 1 - 12 x^2 of how far values are from a tooth: of values at random it is 0 on average, on the teeth 1. */
CLONES static void comb_scores(const double *restrict distance, size_t count, double lo, double spacing, size_t teeth,
                               double *restrict scores) {
    for (size_t first = 0; first < teeth; first += BLOCK) {
        double sums[BLOCK];
        for (size_t i = 0; i < BLOCK; i++)
            sums[i] = 0;
        for (size_t k = 0; k < count; k++)
            for (size_t i = 0; i < BLOCK; i++) {
                const double x = distance[k] * (lo + spacing * (double)(int32_t)(first + i)), off = x - rint(x);
                sums[i] += 1 - 12 * off * off;
            }
        for (size_t i = 0; i < BLOCK && first + i < teeth; i++)
            scores[first + i] = sums[i];
    }
}

/* The coarsest of those that stand out, extended; what says most is kept. */
static bool try_origin(const fit_value *values, size_t count, comb *c, double origin, fit *best) {
    bool found = false;
    double most = 0;
    for (size_t k = 0; k < c->count; k++)
        c->distance[k] = c->at[k] - origin;
    comb_scores(c->distance, c->count, c->lo, c->spacing, c->teeth, c->scores);
    for (size_t i = 0; i < c->teeth; i++)
        most = fmax(most, c->scores[i]);
    const double least = fmax(0.85 * most, 0.3 * (double)c->count);
    int peaks = 0;
    for (size_t i = 1; i + 1 < c->teeth && peaks < PEAKS; i++) {
        if (!(c->scores[i] >= least && c->scores[i] > c->scores[i - 1] && c->scores[i] >= c->scores[i + 1]))
            continue;
        peaks++;
        fit f = {.step = 1 / (c->lo + c->spacing * (double)i), .offset = origin};
        if (!extend(values, count, c->first, c->end, &f))
            continue;
        weigh(values, count, TELLING, &f);
        if (is_better(&f, best)) {
            *best = f;
            found = true;
        }
    }
    return found;
}

static size_t held_of(const fit_value *values, size_t count, const fit *f) {
    size_t held = 0;
    for (size_t i = 0; i < count; i++)
        held += fit_holds(f, &values[i]);
    return held;
}

/* Least squares leave a value that is at the end of its rounding off the lattice: those that are farthest off, as a
 * share of their rounding, weigh more each time (Lawson's way to the least maximum), while that holds more of them. */
static void polish(const fit_value *values, size_t count, fit *best) {
    fit_value *near = malloc(count * sizeof *near);
    fit f = *best;
    size_t some = 0, most;
    for (size_t i = 0; i < count && near != NULL; i++)
        if (can_tell(best, &values[i], FITTING) &&
            residual(best, values[i].at) <= values[i].off + 0.0625 * best->step) {
            near[some] = values[i];
            near[some++].pixels = 1;
        }
    most = held_of(near, some, best);
    for (int round = 0; round < ROUNDS && most < some && regress(near, 0, some, 0.0625, &f); round++) {
        double heaviest = 0;
        const size_t held = held_of(near, some, &f);
        if (held > most) {
            most = held;
            weigh(values, count, TELLING, &f);
            if (is_better(&f, best))
                *best = f;
        }
        for (size_t i = 0; i < some; i++) {
            near[i].pixels *= residual(&f, near[i].at) / near[i].off;
            heaviest = fmax(heaviest, near[i].pixels);
        }
        for (size_t i = 0; i < some; i++)
            near[i].pixels /= heaviest;
    }
    free(near);
}

/* Over a gap a level may have been skipped, or been counted twice. @return whether another number of levels fits nearly
 * as well, so that the values do not tell */
static bool may_have_slipped(const fit_value *values, size_t count, const fit *best) {
    enum { MOST = 16, QUARTERS = 4, ANCHORS = 8 };
    size_t first = 0, last = count - 1; /* those that tell */
    while (first < last && !can_tell(best, &values[first], FITTING))
        first++;
    while (last > first && !can_tell(best, &values[last], FITTING))
        last--;
    const double range = values[last].at - values[first].at, levels = range / best->step;
    for (int quarters = -MOST; quarters <= MOST; quarters++)
        for (size_t i = 0; i < ANCHORS && levels > MOST; i++) {
            fit f = {.step = range / (levels + (double)quarters / QUARTERS),
                     .offset = values[first + (last - first) * i / (ANCHORS - 1)].at};
            f.offset -= residual_of(best, f.offset);
            if (quarters == 0 || !regress(values, 0, count, 0.125, &f) || !regress(values, 0, count, 0.03125, &f) ||
                !regress(values, 0, count, 0, &f) || fabs(range / f.step - levels) < 0.5)
                continue;
            weigh(values, count, FITTING, &f);
            if (f.bits > best->bits - FIT_BITS)
                return true;
        }
    return false;
}

/* ---- What it leaves open ------------------------------------------------------------------------------------------*/

/* Values at one end that bound the lattice, and how many among them are seen off it: averages of neighbours, of which
 * as many lie on it. */
typedef struct end_values {
    const fit_value *at[ENDS];
    size_t count;
    double astray;
} end_values;

static void take_end(const fit_value *values, size_t count, const fit *f, bool last, end_values *e) {
    *e = (end_values){.count = 0};
    for (size_t i = 0; i < count && e->count < ENDS; i++) {
        const fit_value *v = &values[last ? count - 1 - i : i];
        if (can_tell(f, v, FITTING) && fit_holds(f, v))
            e->at[e->count++] = v;
        else
            e->astray += can_tell(f, v, FITTING);
    }
}

/* Inserts into the least `size` numbers, upwards. */
static void keep_least(double *least, size_t size, double x) {
    for (size_t i = 0; i < size; i++)
        if (x < least[i]) {
            const double next = least[i];
            least[i] = x;
            x = next;
        }
}

/*
 * Any other lattice that holds the same values by the same k: (k_j - k_i) step lies within off_i + off_j of their
 * difference. Of pairs that share no value as many are wrong at most as averages are on a level, and the next strictest
 * holds.
 */
void fit_bound(const fit_value *values, size_t count, fit *f) {
    end_values e[2];
    double above = (double)INFINITY, below = (double)INFINITY, offs[2 * ENDS + 1];
    f->offset -= f->step * rint(f->offset / f->step);
    for (int side = 0; side < 2; side++)
        take_end(values, count, f, side == 1, &e[side]);
    const double mean = e[0].astray + e[1].astray;
    const size_t size = 1 + (size_t)fmin(ceil(mean + SIGMAS * sqrt(mean)), 2 * ENDS);
    for (size_t shift = 0; shift < e[1].count; shift++) {
        double up[2 * ENDS + 1], down[2 * ENDS + 1];
        for (size_t i = 0; i < size; i++)
            up[i] = down[i] = (double)INFINITY;
        for (size_t i = 0; i < e[0].count && i < e[1].count; i++) {
            const fit_value *a = e[0].at[i], *b = e[1].at[(i + shift) % e[1].count];
            const double apart = rint((b->at - a->at) / f->step), off = a->off + b->off, difference = b->at - a->at;
            if (apart < 1)
                continue;
            keep_least(up, size, (difference + off) / apart - f->step);
            keep_least(down, size, f->step - (difference - off) / apart);
        }
        above = fmin(above, up[size - 1]);
        below = fmin(below, down[size - 1]);
    }
    f->step_off = fmax(fmax(above, below), 0);
    for (size_t i = 0; i < size; i++)
        offs[i] = (double)INFINITY;
    for (int side = 0; side < 2; side++)
        for (size_t i = 0; i < e[side].count; i++) {
            const fit_value *v = e[side].at[i];
            const double k = rint((v->at - f->offset) / f->step);
            keep_least(offs, size, fabs(k) * f->step_off + v->off + residual(f, v->at));
        }
    f->offset_off = offs[size - 1];
}

static bool is_mixed(const fit_value *values, size_t count, const fit *f) {
    double *room = malloc(3 * count * sizeof *room);
    if (room == NULL)
        return true; /* without memory nothing is found */
    level_set levels = {room, room + count, 0};
    for (size_t i = 0; i < count; i++) {
        const double k = rint((values[i].at - f->offset) / f->step);
        if (!can_tell(f, &values[i], FITTING) || !fit_holds(f, &values[i]) ||
            (levels.count > 0 && k == levels.k[levels.count - 1]))
            continue;
        levels.k[levels.count] = k;
        levels.pixels[levels.count++] = fmin(values[i].pixels, WEIGHT_MOST);
    }
    const bool mixed = levels_are_mixed(&levels, room + 2 * count);
    free(room);
    return mixed;
}

bool fit_find(const fit_value *values, size_t count, fit *out) {
    comb c = {.scores = malloc(TEETH_MAX * sizeof(double))};
    bool found = false;
    *out = (fit){0};
    const size_t last = count > NEIGHBOURS ? count - NEIGHBOURS : 0;
    for (size_t w = 0; w < WINDOWS && !(fit_explains(out) && out->pixels == 1) && c.scores != NULL && count >= 4; w++) {
        if (w > 0 && last == 0)
            break;
        lay(values, count, last * w / (WINDOWS - 1), &c);
        for (size_t k = 0; k < ORIGINS && choose_teeth(values, &c); k++)
            found = try_origin(values, count, &c, c.at[k], out) || found;
    }
    free(c.scores);
    if (found)
        polish(values, count, out);
    if (!found || may_have_slipped(values, count, out) || is_mixed(values, count, out))
        return false;
    fit_bound(values, count, out);
    return isfinite(out->step_off);
}
