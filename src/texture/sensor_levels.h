/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file sensor_levels.h  For sensor_fit.c: whether values lie on a lattice as they would on their own. */
#ifndef TEXTURE_SENSOR_LEVELS_H
#define TEXTURE_SENSOR_LEVELS_H

#include <stdbool.h>
#include <stddef.h>

/** Numbers of levels, different ones, and how many pixels each has. */
typedef struct level_set {
    double *k, *pixels;
    size_t count;
} level_set;

/**
 * Whether the levels are more likely those of another lattice, or of two: some residues are avoided, few pixels lie
 * between levels of a coarser one, or all lie on every q-th and every p-th. depthprec(7) has the chances.
 * @param room  for as many numbers as there are levels
 */
bool levels_are_mixed(const level_set *levels, double *room);

#endif
