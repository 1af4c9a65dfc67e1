/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "texture/units.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/append.h"
#include "texture/device.h"
#include "texture/image_depths.h"
#include "texture/metric.h"
#include "texture/sensor_find.h"
#include "texture/stereo.h"

enum { UNITS_LEAST = 2 };

/* Nearer than a sensor sees some still write, and a unit that no sheet has is that of a renderer. */
static const double NEARER = 0.5, RENDERED_LEAST = 0.1, RENDERED_MOST = 700;

/* The likelier ones first. */
static const struct candidate {
    const char *option;
    double metres;      /* of 1 in a sample; 0: disparity */
    const char *device; /* of that */
    bool integers, numbers;
    bool dense; /* of what fills most of a picture */
} candidates[] = {
    {"--metric 1m", 1, NULL, false, true, false},
    {"--metric mm", 0.001, NULL, true, true, false},
    {"--stereo kitti-stereo", 0, "kitti-stereo", true, false, false},
    {"--metric tum", 0.0002, NULL, true, false, true},
    {"--metric kitti", 1.0 / 256, NULL, true, false, false},
    {"--stereo middlebury", 0, "middlebury", false, true, false},
    {"--metric 0.25mm", 0.00025, NULL, true, false, true},
    {"--metric 1cm", 0.01, NULL, true, true, true},
    {"--stereo cityscapes", 0, "cityscapes", true, false, true},
};

/* Samples above 0, of which the two least differ. */
typedef struct extent {
    double least, next, most;
    size_t count;
} extent;

static double depth_of(const device_row *d, double x) {
    return stereo_depth(&(stereo_spec){d->focal, d->baseline, d->offset, d->step}, x);
}

static unit_reading read_as(const struct candidate *c, const extent *e) {
    unit_reading out = {c->option, e->least * c->metres, e->most * c->metres};
    for (size_t i = 0; c->device != NULL && device_get(i) != NULL; i++) {
        const device_row *d = device_get(i);
        if (strcmp(d->name, c->device) != 0)
            continue;
        const double hi = depth_of(d, e->least);
        out = (unit_reading){c->option, depth_of(d, e->most), isfinite(hi) ? hi : depth_of(d, e->next)};
    }
    return out;
}

/* Whether a sheet of that unit has such depths. */
static bool fits(const struct candidate *c, const unit_reading *r) {
    bool known = false;
    for (size_t i = 0; device_get(i) != NULL; i++) {
        const device_row *d = device_get(i);
        if (c->device != NULL ? strcmp(d->name, c->device) != 0 : d->unit != c->metres)
            continue;
        known = true;
        if (r->lo >= NEARER * d->nearest && r->hi <= d->farthest)
            return true;
    }
    return !known && r->lo >= RENDERED_LEAST && r->hi <= RENDERED_MOST;
}

static extent extent_of(const image *img) {
    const double top = metric_find_top(img);
    extent e = {(double)INFINITY, (double)INFINITY, 0, 0};
    for (size_t i = 0; i < (size_t)img->width * img->height; i++) {
        const double x = image_sample(img, i);
        if (!(x > 0) || !isfinite(x) || x == top)
            continue;
        e.count++;
        if (x >= e.next && x <= e.most)
            continue; /* as nearly all of them */
        if (x != e.least)
            e.next = x < e.least ? e.least : fmin(e.next, x);
        e.least = fmin(e.least, x);
        e.most = fmax(e.most, x);
    }
    return e;
}

size_t units_find(const image *img, unit_reading out[UNITS_MAX]) {
    const extent e = extent_of(img);
    const bool sparse = 2 * e.count < (size_t)img->width * img->height;
    size_t count = 0;
    for (int fit = 1; fit >= 0 && e.count > 0; fit--) /* then others, so that none stands alone */
        for (const struct candidate *c = candidates; c < candidates + sizeof candidates / sizeof *candidates; c++) {
            const unit_reading r = read_as(c, &e);
            const bool likely = fits(c, &r) && !(sparse && c->dense);
            if ((img->type < IMAGE_F16 ? c->integers : c->numbers) && likely == (fit == 1) &&
                count < (fit == 1 ? UNITS_MAX : UNITS_LEAST))
                out[count++] = r;
        }
    return count;
}

const char *units_say(const image *img, char out[UNITS_TEXT_SIZE]) {
    unit_reading all[UNITS_MAX];
    const size_t count = units_find(img, all);
    out[0] = '\0';
    for (size_t i = 0; i < count; i++)
        append(out, UNITS_TEXT_SIZE, "%s%s%s %.3g to %.3g m",
               i == 0          ? ""
               : i + 1 < count ? ", "
                               : " or ",
               all[i].option, i == 0 ? " reads" : "", all[i].lo, all[i].hi);
    return out;
}

/* ---- What can be nothing else ------------------------------------------------------------------------------------ */

enum { GUESSED_FROM = 1 << 18, FAR = 30000, METRES_MOST = 500 };
static const double CENTIMETRE = 0.01;

static const char *guess_numbers(const image *img, const char **why) {
    bool beyond = false, binary = true; /* shares of a pixel are */
    for (size_t i = 0; i < (size_t)img->width * img->height; i++) {
        const double x = image_sample(img, i);
        if (x < 0)
            return NULL;
        beyond = beyond || (x > 1 && isfinite(x));
        binary = binary && (!isfinite(x) || rint(256 * x) == 256 * x);
    }
    *why = "its channel is called depth, and holds numbers above 1";
    if (!beyond || img->named_depth)
        return beyond ? "1" : NULL;
    *why = "all are multiples of a part of a metre that files are written in";
    return !binary && extent_of(img).most <= METRES_MOST && metric_step(img) > 0 && metric_step(img) < CENTIMETRE
               ? "1m"
               : NULL;
}

/* The one unit in which levels of that step, a sample's 1 being a metre, are a sensor's. */
static const char *unit_of_levels(const sensor *seen) {
    const char *found = NULL;
    for (const struct candidate *c = candidates; c < candidates + sizeof candidates / sizeof *candidates; c++) {
        const double scale = seen->row->levels == GRAIN_INVERSE ? 1 / c->metres : c->metres;
        if (!c->integers || c->metres == 0 || device_like(seen->row->levels, seen->step * scale) == NULL)
            continue;
        if (found != NULL)
            return NULL;
        found = strrchr(c->option, ' ') + 1;
    }
    return found;
}

/* Some of the rows tell. */
static const char *guess_integers(const image *img, const char **why) {
    const size_t width = img->width, step = 1 + width * img->height / GUESSED_FROM;
    const sensor_file whole = {.step = 1, .unit = 1, .scale = 1};
    image copy = *img;
    sensor seen = {.found = false};
    copy.height = (uint32_t)(1 + (img->height - 1) / step);
    copy.data = malloc(copy.height * width * sizeof(uint16_t));
    if (copy.data == NULL)
        return NULL;
    for (size_t i = 0; i < copy.height; i++)
        memcpy((uint16_t *)copy.data + i * width, (const uint16_t *)img->data + i * step * width,
               width * sizeof(uint16_t));
    metric_clear_top(&copy);
    const extent e = extent_of(&copy);
    if (e.count > 0 && e.count < copy.height * width && e.most <= FAR)
        sensor_find(&copy, &whole, &seen);
    free(copy.data);
    *why = "its levels are those of a sensor that is known";
    return seen.found ? unit_of_levels(&seen) : NULL;
}

const char *units_guess(const image *img, const char **why) {
    if (img->type >= IMAGE_F16)
        return guess_numbers(img, why);
    return img->type == IMAGE_U16 && img->channels == 1 ? guess_integers(img, why) : NULL;
}
