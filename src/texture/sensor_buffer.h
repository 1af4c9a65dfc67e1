/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file sensor_buffer.h  Whether levels that are even in 1/z are those of a depth buffer that was decoded: (1/near -
 * 1/far) is then 2^N - 1 steps, and a level is at 1/far. Any far at a level would do, so planes are named only where
 * both are numbers of few digits, as people choose them, and where that is not chance.
 */
#ifndef TEXTURE_SENSOR_BUFFER_H
#define TEXTURE_SENSOR_BUFFER_H

#include "texture/sensor.h"

typedef struct sensor_buffer {
    int bits; /**< of unormN; 0: nothing is named */
    double znear, zfar;
    double znear_off, zfar_off; /**< how far the planes of the lattice may be from these; zfar_off NaN where zfar is
                                     INFINITY */
} sensor_buffer;

/** @param lo, hi  the nearest and the farthest depth @return out->bits > 0 */
bool sensor_buffer_find(const sensor *s, double lo, double hi, sensor_buffer *out);

#endif
