/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file metric.h  Images of metric depth: the samples are eye depths in some unit, as sensors and simulators write
 * them.
 *
 * Such an image is brought onto the lattice of a linear mapping that ends at `zfar`, without loss: an integer k is the
 * code k of unormN, with zfar = (2^N - 1) scale, and a number x is the window depth x/2^e of fp32, with zfar = 2^e
 * scale. Numbers of f8 are rounded to binary32. From there on it goes the way of all depth images.
 */
#ifndef TEXTURE_METRIC_H
#define TEXTURE_METRIC_H

#include "image/image.h"
#include "texture/sensor.h"

/** Scene units of 1 in a sample, at least and at most. */
#define METRIC_SCALE_MIN 1e-9
#define METRIC_SCALE_MAX 1e6

typedef struct metric {
    dp_format format;
    dp_mapping mapping; /**< linear; of disparity reversed */
    double znear, zfar; /**< half the nearest depth or less; the end of the lattice, scene units: beyond what the
                             farthest depth may have been, where that has an end */
    double sample_from, sample_per; /**< codes of disparity: the sample of 0, and what a code more adds; else 0 */
    double step;   /**< scene units, or pixels of disparity, between neighbouring samples: integers, or numbers that all
                      are multiples of   it; 0: numbers of their own precision */
    sensor sensor; /**< what it was rounded to before: as given, else as seen */
    sensor seen;   /**< as the samples show it */
    double depths; /**< pixels that hold one */
    double top;    /**< a sample that is no depth: 65535 of 16 bits where no other is above 30000, and a number a
                        hundred times as large as the next one; NaN where there is none */
    grain grain;   /**< how far the depth can be beside its sample, with both roundings */
} metric;

/**
 * Converts the image, which becomes one channel of u4 or f4; holes become UINT32_MAX or NaN.
 * @param scale  from METRIC_SCALE_MIN to METRIC_SCALE_MAX
 * @param zfar  where nothing was drawn simulators leave their far plane: samples there are holes; INFINITY: none are
 * @param given  what sensor_given() takes, or null
 * @return null, or why not: one sentence; the image is then as it was, but for such holes
 */
const char *metric_convert(image *img, double scale, double zfar, const sensor *given, metric *out);

/** Numbers: the part of a metre, of those in which files are written, that all are multiples of; 0: none. */
double metric_step(const image *img);

/** A sample that is no depth, metric.top; with _clear_ it becomes 0. */
double metric_find_top(const image *img);
double metric_clear_top(image *img);

#endif
