/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "texture/sensor.h"

#include <math.h>

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
enum { ROWS = sizeof rows / sizeof rows[0] };

const sensor_row *sensor_get(size_t index) {
    return index < ROWS ? &rows[index] : NULL;
}

const sensor_row *sensor_row_of(grain_levels levels) {
    const sensor_row *row = rows;
    while (row->levels != levels)
        row++;
    return row;
}

double sensor_half_gap(double z) {
    return grain_level_gap(&(grain){.levels = GRAIN_HALF, .level = 1}, z);
}

double sensor_level(const sensor *s, double z) {
    return ((s->row->levels == GRAIN_INVERSE ? 1 / z : z) - s->offset) / s->step;
}

static double depth_of(const sensor *s, double k) {
    const double at = s->offset + k * s->step;
    return s->row->levels == GRAIN_INVERSE ? 1 / at : at;
}

double sensor_round(const sensor *s, double z) {
    const double gap = s->row->levels == GRAIN_HALF ? sensor_half_gap(z) : 0;
    const double level = gap > 0 ? rint(z / gap) * gap : depth_of(s, rint(sensor_level(s, z)));
    return s->row->levels == GRAIN_FINE ? z : level > 0 && isfinite(level) ? level : (double)NAN;
}

double sensor_gap(const sensor *s, double z) {
    switch (s->row->levels) {
    case GRAIN_INVERSE:
        return z * s->step < 1 ? z * z * s->step / (1 - z * s->step) : (double)INFINITY;
    case GRAIN_HALF:
        return sensor_half_gap(z);
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
    return ceil(z / sensor_half_gap(z)) + 1024 * fmax(exponent + 13, 0);
}

double sensor_levels(const sensor *s, double lo, double hi) {
    switch (s->row->levels) {
    case GRAIN_INVERSE:
        return floor(sensor_level(s, lo)) - floor(sensor_level(s, hi));
    case GRAIN_HALF:
        return halves_below(hi) - halves_below(lo);
    default:
        return ceil(sensor_level(s, hi)) - ceil(sensor_level(s, lo));
    }
}

void sensor_into(const sensor *s, double zfar, grain *g) {
    const double step = s->step + s->step_off;
    g->levels = s->row->levels;
    g->level = s->row->levels == GRAIN_INVERSE ? step * zfar : s->row->levels == GRAIN_HALF ? 1 / zfar : step / zfar;
    g->between = s->again / zfar;
}

void sensor_scale(sensor *s, double scale) {
    const double by = s->row->levels == GRAIN_INVERSE ? 1 / scale : scale;
    s->step *= by;
    s->offset *= by;
}

void sensor_between(double lo, double hi, sensor *s) {
    const bool inverse = s->row->levels == GRAIN_INVERSE;
    if (isnan(s->levels))
        return;
    s->offset = inverse ? 1 / hi : lo;
    s->step = (inverse ? 1 / lo - 1 / hi : hi - lo) / (s->levels - 1);
}
