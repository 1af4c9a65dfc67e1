/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "texture/sensor.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>

#include "core/elementary.h"
#include "core/recognise_lattice.h"
#include "texture/image_depths.h"
#include "texture/sensor_fit.h"

enum {
    LOOKED_AT = 1 << 19, /* pixels that lattices are looked for in; on the one that is found all are counted */
    DIGITS_MOST = 40,    /* of a number: the fit itself is made of doubles */
    INTEGER_BITS = 31,
    RUN = 5, /* neighbours that tell a surface from a lattice */
    RUNS_LEAST = 16
};

static const double RARE = 0.1, RARER = 0.125;

static const sensor_row rows[] = {
    {"inverse", "even in 1/z: disparity, structured light, compressedDepth of ROS, a decoded depth buffer",
     "grows as z^2: z^2 step / (1 - z step)",
     "Khoshelham and Elberink, Accuracy and resolution of Kinect depth data for indoor mapping applications, "
     "Sensors 12(2), 2012, doi:10.3390/s120201437; compressed_depth_image_transport of ROS, codec.cpp",
     GRAIN_INVERSE},
    {"even", "even in z: time of flight, bits between two planes, an orthographic depth buffer", "the step",
     "depthprec(7)", GRAIN_EVEN},
    {"binary16", "eleven significant bits, rounded or cut, in numbers that hold more",
     "doubles at powers of two, 2^-10 of them", "OpenEXR, Technical Introduction, HALF; IEEE Std 754-2019, 3.6",
     GRAIN_HALF},
    {"file", "the file's own samples; a sensor may resolve less", "the file's own step", "depthprec(7)", GRAIN_FINE},
};
enum { ROWS = sizeof rows / sizeof rows[0], FITTED = ROWS - 1 };

const sensor_row *sensor_get(size_t index) {
    return index < ROWS ? &rows[index] : NULL;
}

/* ---- Depths and what the file leaves open of them ---------------------------------------------------------------- */

typedef struct interval {
    double lo, hi;
} interval;

static interval stored_of(const sensor_file *file, double x) {
    int exponent;
    const double z = x * file->scale;
    if (file->step > 0)
        return (interval){z - 0.5 * file->step, z + file->step};
    frexp(z, &exponent);
    const double unit = ldexp(1, exponent - (file->digits < DIGITS_MOST ? file->digits : DIGITS_MOST));
    /* a product, a sum and a quotient in numbers of so many bits; of binary16 itself it was only stored */
    return file->digits == 11 ? (interval){z - 0.5 * unit, z + unit} : (interval){z - 3 * unit, z + 3 * unit};
}

/* Before it was stored it was rounded to multiples, or cut off. */
static interval interval_of(const sensor_file *file, double x) {
    const interval z = stored_of(file, x);
    return (interval){z.lo - 0.5 * file->again, z.hi + file->again};
}

static fit_value value_of(grain_levels levels, interval z) {
    if (levels == GRAIN_INVERSE)
        z = (interval){1 / z.hi, 1 / z.lo};
    return (fit_value){0.5 * (z.lo + z.hi), 0.5 * (z.hi - z.lo), 1};
}

/* The depths of an image, each once, upwards. */
typedef struct depths {
    double *samples, *pixels;
    size_t count;
} depths;

static bool is_depth(double x) {
    return x > 0 && isfinite(x);
}

static int compare_doubles(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return x < y ? -1 : x > y;
}

static size_t keep(depths *d, size_t to, size_t i) {
    d->samples[to] = d->samples[i];
    d->pixels[to] = d->pixels[i];
    return to + 1;
}

/* Averages of neighbours lie between levels, and few pixels have them: the rarest values say nothing, as long as no
 * more than a tenth of the pixels has them, nor do those that are much rarer than the values on both sides. */
static void drop_rare(depths *d, size_t pixels) {
    enum { MOST = 256 };
    double with[MOST] = {0}, dropped = 0, before = 0;
    size_t count = 0, rare = 1;
    for (size_t i = 0; i < d->count; i++)
        if (d->pixels[i] < MOST)
            with[(size_t)d->pixels[i]] += d->pixels[i];
    while (rare < MOST && dropped + with[rare] <= RARE * (double)pixels)
        dropped += with[rare++];
    for (size_t i = 0; i < d->count; i++)
        if (d->pixels[i] >= (double)rare)
            count = keep(d, count, i);
    d->count = count;
    count = 0;
    for (size_t i = 0; i < d->count; i++) {
        const double own = d->pixels[i], after = i + 1 < d->count ? d->pixels[i + 1] : 0;
        if (own >= RARER * fmin(before, after))
            count = keep(d, count, i);
        before = own;
    }
    d->count = count;
}

static bool gather(const image *img, depths *d) {
    const size_t all = (size_t)img->width * img->height;
    const size_t stride = (1 + (all - 1) / LOOKED_AT) | 1U, some = (all - 1) / stride + 1;
    *d = (depths){malloc(some * sizeof(double)), malloc(some * sizeof(double)), 0};
    if (d->samples == NULL || d->pixels == NULL)
        return false;
    size_t count = 0;
    for (size_t i = 0; i < all; i += stride)
        if (is_depth(image_sample(img, i)))
            d->samples[count++] = image_sample(img, i);
    qsort(d->samples, count, sizeof *d->samples, compare_doubles);
    for (size_t i = 0; i < count; i++) {
        if (d->count == 0 || d->samples[d->count - 1] != d->samples[i]) {
            d->samples[d->count] = d->samples[i];
            d->pixels[d->count++] = 0;
        }
        d->pixels[d->count - 1]++;
    }
    drop_rare(d, count);
    return true;
}

static void depths_free(depths *d) {
    free(d->samples);
    free(d->pixels);
}

/* ---- Each row ---------------------------------------------------------------------------------------------------- */

static double half_gap(double z) {
    return grain_level_gap(&(grain){.levels = GRAIN_HALF, .level = 1}, z);
}

/* Whether a number of binary16 lies in it. */
static bool holds_half(interval z) {
    const double gap = half_gap(z.hi);
    return floor(z.hi / gap) * gap >= z.lo;
}

static int binade_of(const sensor_file *file, double x) {
    int exponent;
    frexp(x * file->scale, &exponent);
    return exponent;
}

/* No constant is looked for, so nothing is lost to other lattices. @param without  a binade whose values do not count
 */
static bool find_halves(const depths *d, const sensor_file *file, int without, fit *out) {
    double *chances = malloc((d->count + 1) * sizeof *chances);
    double all = 0, on_pixels = 0;
    size_t told = 0, on = 0;
    *out = (fit){.step = NAN, .step_off = NAN, .offset = NAN, .offset_off = NAN};
    for (size_t i = 0; i < d->count && chances != NULL; i++) {
        const interval z = interval_of(file, d->samples[i]);
        const double chance = (z.hi - z.lo) / half_gap(z.hi);
        const bool held = holds_half(z);
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
static bool halves_change(const depths *d, const sensor_file *file) {
    fit f;
    for (int e = binade_of(file, d->samples[0]); e <= binade_of(file, d->samples[d->count - 1]); e++)
        if (!find_halves(d, file, e, &f) || f.bits < FIT_WHOLE)
            return false;
    return true;
}

/* @return null without memory */
static fit_value *values_of(const depths *d, const sensor_file *file, grain_levels levels) {
    fit_value *values = malloc((d->count + 1) * sizeof *values);
    for (size_t i = 0; i < d->count && values != NULL; i++) {
        const size_t to = levels == GRAIN_INVERSE ? d->count - 1 - i : i;
        values[to] = value_of(levels, interval_of(file, d->samples[i]));
        values[to].pixels = d->pixels[i];
    }
    return values;
}

static bool find_even(const depths *d, const sensor_file *file, grain_levels levels, fit *out) {
    fit_value *values = values_of(d, file, levels);
    const bool found = values != NULL && fit_find(values, d->count, out);
    free(values);
    return found;
}

/* ---- What the lattice says of a depth ---------------------------------------------------------------------------- */

static double level_of(const sensor *s, double z) {
    return ((s->row->levels == GRAIN_INVERSE ? 1 / z : z) - s->offset) / s->step;
}

static double depth_of(const sensor *s, double k) {
    const double at = s->offset + k * s->step;
    return s->row->levels == GRAIN_INVERSE ? 1 / at : at;
}

static bool holds(const sensor *s, const sensor_file *file, double x) {
    const interval z = interval_of(file, x);
    if (s->row->levels == GRAIN_HALF)
        return holds_half(z);
    const fit f = {.step = s->step, .offset = s->offset};
    const fit_value v = value_of(s->row->levels, z);
    return fit_holds(&f, &v);
}

/* Which level it is on. */
static bool tells(const sensor *s, const sensor_file *file, double x) {
    return is_depth(x) && holds(s, file, x) && value_of(s->row->levels, interval_of(file, x)).off < 0.5 * s->step;
}

double sensor_round(const sensor *s, double z) {
    const double gap = s->row->levels == GRAIN_HALF ? half_gap(z) : 0;
    const double level = gap > 0 ? rint(z / gap) * gap : depth_of(s, rint(level_of(s, z)));
    return s->row->levels == GRAIN_FINE ? z : level > 0 && isfinite(level) ? level : (double)NAN;
}

double sensor_gap(const sensor *s, double z) {
    switch (s->row->levels) {
    case GRAIN_INVERSE:
        return z * s->step < 1 ? z * z * s->step / (1 - z * s->step) : (double)INFINITY;
    case GRAIN_HALF:
        return half_gap(z);
    default:
        return s->step;
    }
}

double sensor_end(const sensor *s, double z) {
    const double step = s->step + s->step_off;
    switch (s->row->levels) {
    case GRAIN_INVERSE:
        return z * step < 1 ? z / (1 - z * step) * (1 + 0x1p-20) : z;
    case GRAIN_HALF:
        return z * (1 + 0x1p-9);
    case GRAIN_EVEN:
        return z + 2 * step;
    default:
        return z;
    }
}

/* Numbers of binary16 below z. */
static double halves_below(double z) {
    int exponent;
    frexp(z, &exponent);
    return ceil(z / half_gap(z)) + 1024 * fmax(exponent + 13, 0);
}

double sensor_levels(const sensor *s, double lo, double hi) {
    switch (s->row->levels) {
    case GRAIN_INVERSE:
        return floor(level_of(s, lo)) - floor(level_of(s, hi));
    case GRAIN_HALF:
        return halves_below(hi) - halves_below(lo);
    default:
        return ceil(level_of(s, hi)) - ceil(level_of(s, lo));
    }
}

void sensor_into(const sensor *s, double zfar, grain *g) {
    const double step = s->step + s->step_off;
    g->levels = s->row->levels;
    g->level = s->row->levels == GRAIN_INVERSE ? step * zfar : s->row->levels == GRAIN_HALF ? 1 / zfar : step / zfar;
    g->between = s->again / zfar;
}

/* ---- Surfaces ---------------------------------------------------------------------------------------------------- */

/*
 * Depths that were never rounded may be even, too: of a level plane 1/z is, from row to row. But what was rounded
 * jumps, and so its fourth differences are not 0, where those of a smooth surface are.
 */
static void run_of(const image *img, const sensor *s, size_t pixel, size_t step, size_t counts[2]) {
    double k[RUN];
    bool flat = true;
    for (size_t i = 0; i < RUN; i++) {
        const double x = image_sample(img, pixel + i * step);
        if (!is_depth(x))
            return;
        k[i] = rint(level_of(s, x));
        flat = flat && k[i] == k[0];
    }
    if (!flat)
        counts[k[0] - 4 * k[1] + 6 * k[2] - 4 * k[3] + k[4] == 0]++;
}

void sensor_scale(sensor *s, double scale) {
    const double by = s->row->levels == GRAIN_INVERSE ? 1 / scale : scale;
    s->step *= by;
    s->offset *= by;
}

static bool is_surface(const image *img, const sensor *s, double scale) {
    const size_t all = (size_t)img->width * img->height, stride = (1 + (all - 1) / LOOKED_AT) | 1U;
    sensor in_samples = *s;
    size_t counts[2] = {0, 0};
    sensor_scale(&in_samples, 1 / scale);
    for (size_t i = 0; i < all && s->row->levels != GRAIN_HALF; i += stride) {
        if (i % img->width + RUN <= img->width)
            run_of(img, &in_samples, i, 1, counts);
        if (i / img->width + RUN <= img->height)
            run_of(img, &in_samples, i, img->width, counts);
    }
    return counts[1] >= RUNS_LEAST && counts[1] >= counts[0];
}

/*
 * Pictures of several lattices that were put together lie on a finer one. But most neighbours are of the same picture,
 * and so the same number of its levels, or a multiple of that, lies between them.
 */
static bool is_put_together(const image *img, const sensor_file *file, const sensor *s) {
    enum { MOST = 8 };
    const size_t all = (size_t)img->width * img->height, stride = (1 + (all - 1) / LOOKED_AT) | 1U;
    size_t apart = 0, multiples[MOST + 1] = {0};
    for (size_t i = 0; i + 1 < all && s->row->levels != GRAIN_HALF; i += stride) {
        const double x = image_sample(img, i), next = image_sample(img, i + 1);
        if (!tells(s, file, x) || !tells(s, file, next))
            continue;
        const double between = rint(level_of(s, x * file->scale)) - rint(level_of(s, next * file->scale));
        apart += between != 0;
        for (int q = 2; q <= MOST; q++)
            multiples[q] += between != 0 && fmod(between, q) == 0;
    }
    for (int q = 2; q <= MOST; q++)
        if (apart >= RUNS_LEAST && (double)multiples[q] >= SENSOR_SHARE * (double)apart)
            return true;
    return false;
}

/* ---- Together ---------------------------------------------------------------------------------------------------- */

static sensor of_fit(const sensor_row *row, const fit *f) {
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

/* How many pixels are on no level, and how far the others are from theirs. @return whether they are few */
static bool count_all(const image *img, const sensor_file *file, sensor *s) {
    double least = (double)INFINITY, most = 0, below = (double)INFINITY, above = -(double)INFINITY;
    double on = 0;
    s->off_pixels = 0;
    for (size_t i = 0; i < (size_t)img->width * img->height; i++) {
        const double x = image_sample(img, i), z = x * file->scale;
        if (!is_depth(x))
            continue;
        if (!holds(s, file, x)) {
            s->off_pixels++;
            continue;
        }
        on++;
        least = fmin(least, z);
        most = fmax(most, z);
        const double level = sensor_round(s, z);
        below = fmin(below, z - level);
        above = fmax(above, z - level);
    }
    s->residual = most > 0 ? 0.5 * (above - below) : 0;
    s->levels = most > 0 ? 1 + rint(sensor_levels(s, least, most)) : 0;
    return on >= SENSOR_SHARE * (on + s->off_pixels);
}

/* Averages that lie near a level by chance are not counted: each value that tells lies on one. */
static double residual_of(const depths *d, const sensor_file *file, const sensor *s) {
    double below = (double)INFINITY, above = -(double)INFINITY;
    for (size_t i = 0; i < d->count; i++)
        if (holds(s, file, d->samples[i])) {
            const double z = d->samples[i] * file->scale, off = z - sensor_round(s, z);
            below = fmin(below, off);
            above = fmax(above, off);
        }
    return above >= below ? 0.5 * (above - below) : s->residual;
}

/* Integers: what all of the values that are not rare are multiples of, and -log2 of the chance that they are. */
static double common_step(const depths *d, double *bits) {
    uint32_t divisor = 0;
    for (size_t i = 0; i < d->count; i++)
        divisor = (uint32_t)dp_common_divisor(divisor, (uint32_t)d->samples[i]);
    *bits = divisor > 1 ? (double)d->count * dp_log2(divisor) - INTEGER_BITS : 0;
    return divisor;
}

/* The lattice of the file: the samples' own step, or a multiple of it that they share by more than chance. */
static sensor of_file(const image *img, const sensor_file *file, const depths *d) {
    double bits = 0;
    const double divisor = file->digits == 0 && d->count > 0 ? common_step(d, &bits) : 0;
    const bool coarser = bits >= FIT_BITS && d->count >= FIT_LEVELS;
    const fit own = {.step = coarser ? divisor * file->unit : file->step > 0 ? file->step : (double)NAN, .bits = bits};
    sensor s = of_fit(&rows[coarser ? ROWS - 3 : ROWS - 1], &own);
    s.file_step = file->step;
    if (!coarser)
        return s;
    s.found = true;
    s.file_step = file->unit;
    s.step_off = file->unit * divisor / d->samples[d->count - 1];
    const sensor_file units = {.step = file->unit, .scale = file->scale};
    return count_all(img, &units, &s) && !is_surface(img, &s, file->scale) ? s : of_file(img, file, &(depths){0});
}

/* The chosen row, and the next one where it explains the values nearly as well. */
typedef struct choice {
    const sensor_row *row, *other; /* null: none does */
    fit fit;
    double next;  /* bits of the next one */
    bool unclear; /* what explains them is more than one lattice */
} choice;

static void consider(choice *c, const sensor_row *row, const fit *f) {
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

static void choose(const depths *d, const sensor_file *file, choice *c) {
    for (const sensor_row *row = rows; row < rows + FITTED; row++) {
        fit f = {0};
        const bool half = row->levels == GRAIN_HALF;
        if (half && file->digits == 11)
            continue; /* they are so by themselves */
        const bool found = half ? find_halves(d, file, INT_MAX, &f) : find_even(d, file, row->levels, &f);
        if (found && fit_explains(&f))
            consider(c, row, &f);
        if (found && half && fit_explains(&f) && !halves_change(d, file))
            consider(c, row - 1, &f);
        c->unclear = c->unclear || (!found && fit_explains(&f));
    }
    if (c->next <= c->fit.bits - FIT_BITS)
        c->other = NULL;
}

/* A step too fine to show as multiples may be so many of the file's, nearly its own where depths were scaled, or
 * of numbers 2^-14 of the farthest depth. */
static const double before[] = {1.25, 2.5, 5};
enum { BEFORE = sizeof before / sizeof before[0] };

static double before_of(const sensor_file *file, size_t i, double farthest) {
    return before[i] * (file->step > 0 ? file->step : 0x1p-14 * farthest);
}

/* Samples that fit may have been rounded as coarsely as all that both roundings explain. */
static double most_before(const sensor_file *as) {
    return as->again > 0 ? 1.5 * (as->again + as->step) : 0;
}

/* How many numbers lie outside of an interval of such a width that has most of them. Sorts them. */
static size_t outside(double *x, size_t count, double width) {
    size_t most = 0;
    qsort(x, count, sizeof *x, compare_doubles);
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
static bool is_blurred(const depths *d, const sensor_file *as, const choice *c) {
    enum { GROUP = 32 };
    static const double slack = 0.0625, beyond = 0.4375 / 1.5; /* of a step, and of what both ways to round explain */
    const sensor s = of_fit(c->row, &c->fit);
    const double step = as->step + as->again, width = step * (1 + slack);
    double beside[GROUP], chance = 0, out = 0;
    size_t held = 0;
    for (size_t i = 0; i < d->count && step > 0 && c->row->levels != GRAIN_HALF; i++) {
        const double z = d->samples[i] * as->scale, off = value_of(c->row->levels, interval_of(as, d->samples[i])).off;
        if (off < c->fit.step / 6 && holds(&s, as, d->samples[i]))
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
static void widen(const depths *d, sensor_file *as, choice *c) {
    as->again = most_before(as);
    fit_value *values = values_of(d, as, c->row->levels);
    if (values != NULL && c->row->levels != GRAIN_HALF)
        fit_bound(values, d->count, &c->fit);
    free(values);
}

/* The step of multiples that the samples lie on, which levels may have been rounded to; 0: they lie on none. */
static double multiples_of(const sensor_row *row, double step, double offset, double offset_off) {
    return row != NULL && row->levels == GRAIN_EVEN && fabs(offset) <= offset_off ? step : 0;
}

/* A lattice, or one that was rounded to it, or to what all samples are multiples of but for rare ones: the coarser one
 * is meant. */
static void search(const depths *d, sensor_file *file, choice *c) {
    double bits = 0;
    choose(d, file, c);
    sensor_file again = *file;
    again.again = multiples_of(c->row, c->fit.step, c->fit.offset, c->fit.offset_off);
    const double multiple = c->row == NULL && file->digits == 0 ? common_step(d, &bits) * file->unit : 0;
    if (bits >= FIT_BITS && multiple > 1.5 * file->step)
        again.again = multiple;
    choice coarser = {0};
    if (again.again > 0)
        choose(d, &again, &coarser);
    if (coarser.row != NULL) {
        *file = again;
        *c = coarser;
    }
}

/* Other roundings, from fine to coarse, until one explains the samples. @return whether none does */
static bool explain(const depths *d, const sensor_file *file, sensor_file *tried, choice *c) {
    const double farthest = d->samples[d->count - 1] * file->scale;
    const bool seen = tried->again > 0;
    bool blurred = c->row != NULL && is_blurred(d, tried, c);
    for (size_t i = 0; i < BEFORE && !seen && !c->unclear && (c->row == NULL || blurred); i++) {
        sensor_file coarser = *file;
        choice other = {0};
        coarser.again = before_of(file, i, farthest);
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
        tried->again = fmax(tried->again, before_of(file, 0, farthest));
    if (c->row != NULL && !seen && tried->again > 0)
        widen(d, tried, c);
    return blurred;
}

/* Multiples of a step may have been rounded to it, or be the levels that are looked for. */
void sensor_find(const image *img, const sensor_file *file, sensor *out) {
    depths d;
    choice c = {0};
    sensor_file tried = *file;
    const bool good = gather(img, &d);
    if (good)
        search(&d, &tried, &c);
    if (good && c.row == NULL && file->unit < file->step) {
        tried.step = file->unit;
        search(&d, &tried, &c);
        if (file->unit == 0 && !(c.fit.step > 1.5 * file->step))
            c.row = NULL; /* the step itself: millimetres in metres */
    }
    const bool again_seen = tried.again > 0, blurred = good && d.count > 0 && explain(&d, file, &tried, &c);
    *out = of_file(img, file, &d);
    out->found = out->found && !c.unclear;
    if (c.row != NULL) {
        sensor s = of_fit(c.row, &c.fit);
        s.other = c.other;
        s.found = c.other == NULL && !blurred;
        s.file_step = tried.step;
        s.again = tried.again;
        s.again_seen = again_seen;
        if (count_all(img, &tried, &s) && !is_surface(img, &s, file->scale) && !is_put_together(img, &tried, &s))
            *out = s, out->residual = residual_of(&d, &tried, &s);
    }
    depths_free(&d);
}

/* The offset that most pixels are on, to a 4096th of the step: far levels are coarse. */
static double best_offset(const image *img, const sensor_file *file, sensor *s) {
    enum { TRIED = 64 };
    double best = 0.5 * s->step, fewest = (double)INFINITY;
    for (int round = 0; round < 2; round++) {
        const double first = best - 0.5 * s->step / (round > 0 ? TRIED : 1);
        for (int i = 0; i < TRIED; i++) {
            s->offset = first + s->step * i / (round > 0 ? TRIED * TRIED : TRIED);
            count_all(img, file, s);
            if (s->off_pixels < fewest) {
                fewest = s->off_pixels;
                best = s->offset;
            }
        }
    }
    return best;
}

void sensor_between(double lo, double hi, sensor *s) {
    const bool inverse = s->row->levels == GRAIN_INVERSE;
    if (isnan(s->levels))
        return;
    s->offset = inverse ? 1 / hi : lo;
    s->step = (inverse ? 1 / lo - 1 / hi : hi - lo) / (s->levels - 1);
}

/* Whether the samples that tell are on levels: others are within a coarse rounding of any. */
static bool is_told(const image *img, const sensor_file *as, const sensor *s) {
    size_t told = 0, held = 0;
    for (size_t i = 0; i < (size_t)img->width * img->height; i++) {
        const double x = image_sample(img, i);
        if (s->row->levels == GRAIN_HALF || !is_depth(x) ||
            !(value_of(s->row->levels, interval_of(as, x)).off < s->step / 6))
            continue;
        told++;
        held += holds(s, as, x);
    }
    return told >= FIT_LEVELS && (double)held >= SENSOR_SHARE * (double)told;
}

/* Fills in the rest for one rounding. @return whether few pixels are on no level */
static bool complete_as(const image *img, const sensor_file *as, const sensor *known, sensor *s) {
    s->again = s->again_seen ? as->again : most_before(as);
    s->offset = known->offset;
    if (s->row->levels != GRAIN_HALF && isnan(s->offset))
        s->offset = best_offset(img, as, s);
    const bool few = count_all(img, as, s);
    return as->again > 0 ? few && is_told(img, as, s) : few;
}

void sensor_complete(const image *img, const sensor_file *file, const double ends[2], const sensor *seen, sensor *s) {
    sensor_between(ends[0], ends[1], s);
    const sensor known = *s;
    sensor_file as = *file;
    if (known.row->levels != GRAIN_FINE && known.step < 4 * file->step)
        as.step = file->unit; /* the levels themselves are the multiples */
    *s = of_fit(known.row, &(fit){.step = known.step, .offset = known.offset, .bits = NAN});
    s->given = true;
    s->file_step = as.step;
    s->offset_off = s->step_off = known.row->levels == GRAIN_HALF ? (double)NAN : 0;
    if (known.row->levels == GRAIN_FINE) {
        s->step = file->step > 0 ? file->step : (double)NAN;
        s->offset = 0;
        return;
    }
    const double shown =
        seen->again > 0 ? seen->again : multiples_of(seen->row, seen->step, seen->offset, seen->offset_off);
    const double steps[] = {
        isnan(known.again) ? 0 : known.again, shown < known.step || known.row->levels != GRAIN_EVEN ? shown : 0,
        before_of(&as, 0, ends[1]),           before_of(&as, 1, ends[1]),
        before_of(&as, 2, ends[1]),           0}; /* it is of another lattice */
    bool good = false;
    for (size_t i = 0; i < sizeof steps / sizeof steps[0] && !good; i++) {
        as.again = steps[i];
        s->again_seen = i < 2;
        good = complete_as(img, &as, &known, s) || !isnan(known.again);
    }
    if (!good && seen->row == known.row && isnan(known.offset) &&
        fabs(seen->step - known.step) < 0x1p-10 * known.step) {
        *s = *seen; /* the same to three digits */
        s->given = true;
    }
}
