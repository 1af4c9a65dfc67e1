/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A floor under the guarantee of a request over many depths, so that it need not be asked for each block. */
#ifndef ZFIGHT_GROUND_H
#define ZFIGHT_GROUND_H

#include "zfight/census.h"

typedef struct census_ground {
    const census_request *request;
    uint32_t first, last;   /* depths by rank, all of one step */
    uint32_t near, far;     /* the ends of the part at hand */
    double at_near, at_far; /* the guarantee there */
    double least;           /* what it is not below between them */
} census_ground;

/* The guarantee at a depth; INFINITY where there is none. */
double census_bound_at(const census_request *request, uint32_t rank);

/* A floor under the guarantee over `width` depths from the rank `first` on; `bound` is the least of it at both ends. */
double census_least(const census_request *request, double bound, uint32_t first, uint32_t width);

census_ground census_ground_make(const census_request *request, uint32_t first, uint32_t last);

/* The floor at a depth and the others of its part; 0 where nothing is known. */
double census_ground_at(census_ground *ground, uint32_t rank);

#endif
