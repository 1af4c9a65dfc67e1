/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file sensor_choice.h  Which row explains the depths of an image, and what they were rounded to before the file did.
 */
#ifndef TEXTURE_SENSOR_CHOICE_H
#define TEXTURE_SENSOR_CHOICE_H

#include "texture/sensor_sample.h"

/** The chosen row, and the next one where it explains the values nearly as well. */
typedef struct sensor_choice {
    const sensor_row *row, *other; /**< null: none does */
    fit fit;
    double next;  /**< bits of the next one */
    bool unclear; /**< what explains them is more than one lattice */
} sensor_choice;

sensor sensor_of_fit(const sensor_row *row, const fit *f);

/** Integers: what all of the values that are not rare are multiples of. @param bits  -log2 of the chance that they are
 */
double sensor_common_step(const sensor_depths *d, double *bits);

/** The step of multiples that the samples lie on, which levels may have been rounded to; 0: they lie on none. */
double sensor_multiples(const sensor_row *row, double step, double offset, double offset_off);

/** How many roundings are tried before that of the file, from fine to coarse. */
enum { SENSOR_BEFORE = 3 };
double sensor_before(const sensor_file *file, size_t i, double farthest);

/** Samples that fit may have been rounded as coarsely as all that both roundings explain. */
double sensor_most_before(const sensor_file *as);

/**
 * Chooses a lattice, or one that was rounded to it, or to what all samples are multiples of but for rare ones: the
 * coarser one is meant.
 * @param file  gets what was rounded to before
 */
void sensor_search(const sensor_depths *d, sensor_file *file, sensor_choice *c);

/** Other roundings before the file's, until one explains the samples. @return whether none does */
bool sensor_explain(const sensor_depths *d, const sensor_file *file, sensor_file *tried, sensor_choice *c);

#endif
