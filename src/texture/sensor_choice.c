/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "texture/sensor_choice.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>

#include "core/elementary.h"
#include "core/recognise_lattice.h"

enum { INTEGER_BITS = 31 };

static int binade_of(const sensor_file *file, double x) {
    int exponent;
    frexp(x * file->scale, &exponent);
    return exponent;
}

/* No constant is looked for, so nothing is lost to other lattices. @param without  a binade whose values do not count
 */
static bool find_halves(const sensor_depths *d, const sensor_file *file, int without, fit *out) {
    double *chances = malloc((d->count + 1) * sizeof *chances);
    double all = 0, on_pixels = 0;
    size_t told = 0, on = 0;
    *out = (fit){.step = NAN, .step_off = NAN, .offset = NAN, .offset_off = NAN};
    for (size_t i = 0; i < d->count && chances != NULL; i++) {
        const sensor_interval z = sensor_interval_of(file, d->samples[i]);
        const double chance = (z.hi - z.lo) / sensor_half_gap(z.hi);
        const bool held = sensor_holds_half(z);
        all += d->pixels[i];
        on_pixels += held ? d->pixels[i] : 0;
        if (chance < 0.5 && binade_of(file, d->samples[i]) != without) { /* others tell hardly anything */
            chances[told++] = chance;
            on += held;
        }
    }
    out->levels = on;
    out->whole = FIT_WHOLE; /* nothing is halved */
    out->pixels = all > 0 ? on_pixels / all : 0;
    out->bits = told > 0 ? fit_chance(chances, told, on) : 0;
    free(chances);
    return out->bits > 0;
}

/* Within a binade numbers of binary16 are even: that they are not must show in all binades but any one. */
static bool halves_change(const sensor_depths *d, const sensor_file *file) {
    fit f;
    for (int e = binade_of(file, d->samples[0]); e <= binade_of(file, d->samples[d->count - 1]); e++)
        if (!find_halves(d, file, e, &f) || f.bits < FIT_WHOLE)
            return false;
    return true;
}

/* @return null without memory */
static fit_value *values_of(const sensor_depths *d, const sensor_file *file, grain_levels levels) {
    fit_value *values = malloc((d->count + 1) * sizeof *values);
    for (size_t i = 0; i < d->count && values != NULL; i++) {
        const size_t to = levels == GRAIN_INVERSE ? d->count - 1 - i : i;
        values[to] = sensor_value_of(levels, sensor_interval_of(file, d->samples[i]));
        values[to].pixels = d->pixels[i];
    }
    return values;
}

static bool find_even(const sensor_depths *d, const sensor_file *file, grain_levels levels, fit *out) {
    fit_value *values = values_of(d, file, levels);
    const bool found = values != NULL && fit_find(values, d->count, out);
    free(values);
    return found;
}

sensor sensor_of_fit(const sensor_row *row, const fit *f) {
    const double none = (double)NAN;
    return (sensor){.row = row,
                    .step = f->step,
                    .step_off = f->step_off,
                    .offset = f->offset,
                    .offset_off = f->offset_off,
                    .bits = f->bits,
                    .levels = none,
                    .off_pixels = none,
                    .residual = none};
}

double sensor_common_step(const sensor_depths *d, double *bits) {
    uint32_t divisor = 0;
    for (size_t i = 0; i < d->count; i++)
        divisor = (uint32_t)dp_common_divisor(divisor, (uint32_t)d->samples[i]);
    *bits = divisor > 1 ? (double)d->count * dp_log2(divisor) - INTEGER_BITS : 0;
    return divisor;
}

static void consider(sensor_choice *c, const sensor_row *row, const fit *f) {
    const bool better = c->row == NULL || f->bits > c->fit.bits;
    if (better ? c->row != NULL : f->bits > c->next) {
        c->other = better ? c->row : row;
        c->next = better ? c->fit.bits : f->bits;
    }
    if (better) {
        c->row = row;
        c->fit = *f;
    }
}

static void choose(const sensor_depths *d, const sensor_file *file, sensor_choice *c) {
    const sensor_row *row;
    for (size_t i = 0; (row = sensor_get(i)) != NULL && row->levels != GRAIN_FINE; i++) {
        fit f = {0};
        const bool half = row->levels == GRAIN_HALF;
        if (half && file->digits == 11)
            continue; /* they are so by themselves */
        const bool found = half ? find_halves(d, file, INT_MAX, &f) : find_even(d, file, row->levels, &f);
        if (found && fit_explains(&f))
            consider(c, row, &f);
        if (found && half && fit_explains(&f) && !halves_change(d, file))
            consider(c, sensor_row_of(GRAIN_EVEN), &f);
        c->unclear = c->unclear || (!found && fit_explains(&f));
    }
    if (c->next <= c->fit.bits - FIT_BITS)
        c->other = NULL;
}

/* A step too fine to show as multiples may be so many of the file's, nearly its own where depths were scaled, or
 * of numbers 2^-14 of the farthest depth. */
static const double before[SENSOR_BEFORE] = {1.25, 2.5, 5};

double sensor_before(const sensor_file *file, size_t i, double farthest) {
    return before[i] * (file->step > 0 ? file->step : 0x1p-14 * farthest);
}

double sensor_most_before(const sensor_file *as) {
    return as->again > 0 ? 1.5 * (as->again + as->step) : 0;
}

/* How many numbers lie outside of an interval of such a width that has most of them. Sorts them. */
static size_t outside(double *x, size_t count, double width) {
    size_t most = 0;
    qsort(x, count, sizeof *x, sensor_compare);
    for (size_t first = 0, end = 0; end < count; end++) {
        while (x[end] - x[first] > width)
            first++;
        most = end + 1 - first > most ? end + 1 - first : most;
    }
    return count - most;
}

/* One rounding leaves depths within its step of each other beside their levels, but for averages that lie there by
 * chance, as they lie elsewhere: more of them show that there was another rounding. A few at a time, as the fit is a
 * little off from one end to the other. */
static bool is_blurred(const sensor_depths *d, const sensor_file *as, const sensor_choice *c) {
    enum { GROUP = 32 };
    static const double slack = 0.0625, beyond = 0.4375 / 1.5; /* of a step, and of what both ways to round explain */
    const sensor s = sensor_of_fit(c->row, &c->fit);
    const double step = as->step + as->again, width = step * (1 + slack);
    double beside[GROUP], chance = 0, out = 0;
    size_t held = 0;
    for (size_t i = 0; i < d->count && step > 0 && c->row->levels != GRAIN_HALF; i++) {
        const double z = d->samples[i] * as->scale,
                     off = sensor_value_of(c->row->levels, sensor_interval_of(as, d->samples[i])).off;
        if (off < c->fit.step / 6 && sensor_holds(&s, as, d->samples[i]))
            beside[held++] = z - sensor_round(&s, z);
        else if (off < c->fit.step / 6)
            chance += beyond * 2 * off / (c->fit.step - 2 * off);
        if (held == GROUP || i + 1 == d->count) {
            out += (double)outside(beside, held, width);
            held = 0;
        }
    }
    return out > chance + 4 * sqrt(chance) + 2;
}

/* A rounding that is not seen may have been as coarse as all that explains the samples: so are the bounds. */
static void widen(const sensor_depths *d, sensor_file *as, sensor_choice *c) {
    as->again = sensor_most_before(as);
    fit_value *values = values_of(d, as, c->row->levels);
    if (values != NULL && c->row->levels != GRAIN_HALF)
        fit_bound(values, d->count, &c->fit);
    free(values);
}

double sensor_multiples(const sensor_row *row, double step, double offset, double offset_off) {
    return row != NULL && row->levels == GRAIN_EVEN && fabs(offset) <= offset_off ? step : 0;
}

void sensor_search(const sensor_depths *d, sensor_file *file, sensor_choice *c) {
    double bits = 0;
    choose(d, file, c);
    sensor_file again = *file;
    again.again = sensor_multiples(c->row, c->fit.step, c->fit.offset, c->fit.offset_off);
    const double multiple = c->row == NULL && file->digits == 0 ? sensor_common_step(d, &bits) * file->unit : 0;
    if (bits >= FIT_BITS && multiple > 1.5 * file->step)
        again.again = multiple;
    sensor_choice coarser = {0};
    if (again.again > 0)
        choose(d, &again, &coarser);
    if (coarser.row != NULL) {
        *file = again;
        *c = coarser;
    }
}

bool sensor_explain(const sensor_depths *d, const sensor_file *file, sensor_file *tried, sensor_choice *c) {
    const double farthest = d->samples[d->count - 1] * file->scale;
    const bool seen = tried->again > 0;
    bool blurred = c->row != NULL && is_blurred(d, tried, c);
    for (size_t i = 0; i < SENSOR_BEFORE && !seen && !c->unclear && (c->row == NULL || blurred); i++) {
        sensor_file coarser = *file;
        sensor_choice other = {0};
        coarser.again = sensor_before(file, i, farthest);
        choose(d, &coarser, &other);
        if (other.unclear)
            break;
        if (other.row == NULL)
            continue;
        *tried = coarser;
        *c = other;
        blurred = is_blurred(d, tried, c);
    }
    if (blurred && !seen)
        tried->again = fmax(tried->again, sensor_before(file, 0, farthest));
    if (c->row != NULL && !seen && tried->again > 0)
        widen(d, tried, c);
    return blurred;
}
