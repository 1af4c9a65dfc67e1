/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "texture/sensor_find.h"

#include <math.h>

#include "texture/image_depths.h"
#include "texture/sensor_choice.h"
#include "texture/sensor_sample.h"
#include "texture/sensor_surface.h"

/* How many pixels are on no level, and how far the others are from theirs. @return whether they are few */
static bool count_all(const image *img, const sensor_file *file, sensor *s) {
    double least = (double)INFINITY, most = 0, below = (double)INFINITY, above = -(double)INFINITY;
    double on = 0;
    s->off_pixels = 0;
    for (size_t i = 0; i < (size_t)img->width * img->height; i++) {
        const double x = image_sample(img, i), z = x * file->scale;
        if (!sensor_is_depth(x))
            continue;
        if (!sensor_holds(s, file, x)) {
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
static double residual_of(const sensor_depths *d, const sensor_file *file, const sensor *s) {
    double below = (double)INFINITY, above = -(double)INFINITY;
    for (size_t i = 0; i < d->count; i++)
        if (sensor_holds(s, file, d->samples[i])) {
            const double z = d->samples[i] * file->scale, off = z - sensor_round(s, z);
            below = fmin(below, off);
            above = fmax(above, off);
        }
    return above >= below ? 0.5 * (above - below) : s->residual;
}

/* The lattice of the file: the samples' own step, or a multiple of it that they share by more than chance. */
static sensor of_file(const image *img, const sensor_file *file, const sensor_depths *d) {
    double bits = 0;
    const double divisor = file->digits == 0 && d->count > 0 ? sensor_common_step(d, &bits) : 0;
    const bool coarser = bits >= FIT_BITS && d->count >= FIT_LEVELS;
    const fit own = {.step = coarser ? divisor * file->unit : file->step > 0 ? file->step : (double)NAN, .bits = bits};
    sensor s = sensor_of_fit(sensor_row_of(coarser ? GRAIN_EVEN : GRAIN_FINE), &own);
    s.file_step = file->step;
    if (!coarser)
        return s;
    s.found = true;
    s.file_step = file->unit;
    s.step_off = file->unit * divisor / d->samples[d->count - 1];
    const sensor_file units = {.step = file->unit, .scale = file->scale};
    return count_all(img, &units, &s) && !sensor_is_surface(img, &s, file->scale)
               ? s
               : of_file(img, file, &(sensor_depths){0});
}

/* Multiples of a step may have been rounded to it, or be the levels that are looked for. */
void sensor_find(const image *img, const sensor_file *file, sensor *out) {
    sensor_depths d;
    sensor_choice c = {0};
    sensor_file tried = *file;
    const bool good = sensor_gather(img, &d);
    if (good)
        sensor_search(&d, &tried, &c);
    if (good && c.row == NULL && file->unit < file->step) {
        tried.step = file->unit;
        sensor_search(&d, &tried, &c);
        if (file->unit == 0 && !(c.fit.step > 1.5 * file->step))
            c.row = NULL; /* the step itself: millimetres in metres */
    }
    const bool again_seen = tried.again > 0, blurred = good && d.count > 0 && sensor_explain(&d, file, &tried, &c);
    *out = of_file(img, file, &d);
    out->found = out->found && !c.unclear;
    if (c.row != NULL) {
        sensor s = sensor_of_fit(c.row, &c.fit);
        s.other = c.other;
        s.found = c.other == NULL && !blurred;
        s.file_step = tried.step;
        s.again = tried.again;
        s.again_seen = again_seen;
        if (count_all(img, &tried, &s) && !sensor_is_surface(img, &s, file->scale) &&
            !sensor_is_put_together(img, &tried, &s))
            *out = s, out->residual = residual_of(&d, &tried, &s);
    }
    sensor_depths_free(&d);
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

/* Whether the samples that tell are on levels: others are within a coarse rounding of any. */
static bool is_told(const image *img, const sensor_file *as, const sensor *s) {
    size_t told = 0, held = 0;
    for (size_t i = 0; i < (size_t)img->width * img->height; i++) {
        const double x = image_sample(img, i);
        if (s->row->levels == GRAIN_HALF || !sensor_is_depth(x) ||
            !(sensor_value_of(s->row->levels, sensor_interval_of(as, x)).off < s->step / 6))
            continue;
        told++;
        held += sensor_holds(s, as, x);
    }
    return told >= FIT_LEVELS && (double)held >= SENSOR_SHARE * (double)told;
}

/* Fills in the rest for one rounding. @return whether few pixels are on no level */
static bool complete_as(const image *img, const sensor_file *as, const sensor *known, sensor *s) {
    s->again = s->again_seen ? as->again : sensor_most_before(as);
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
    *s = sensor_of_fit(known.row, &(fit){.step = known.step, .offset = known.offset, .bits = NAN});
    s->given = true;
    s->file_step = as.step;
    s->offset_off = s->step_off = known.row->levels == GRAIN_HALF ? (double)NAN : 0;
    if (known.row->levels == GRAIN_FINE) {
        s->step = file->step > 0 ? file->step : (double)NAN;
        s->offset = 0;
        return;
    }
    const double shown =
        seen->again > 0 ? seen->again : sensor_multiples(seen->row, seen->step, seen->offset, seen->offset_off);
    const double steps[] = {
        isnan(known.again) ? 0 : known.again, shown < known.step || known.row->levels != GRAIN_EVEN ? shown : 0,
        sensor_before(&as, 0, ends[1]),       sensor_before(&as, 1, ends[1]),
        sensor_before(&as, 2, ends[1]),       0}; /* it is of another lattice */
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
