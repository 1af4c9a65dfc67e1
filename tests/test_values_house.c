/* SPDX-License-Identifier: GPL-3.0-or-later */
/* scene: the fights of a house whose fights are known, what only looks like one, and the house that is mended. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <jansson.h>

#include "printed.h"
#include "support.h"

#define CAMERA "-n 0.05 -F d24 -m d3d --viewport 1280x720 --fov 23 --within 60 --json"
#define HOUSE  "tests/models/house.gltf"

/* By the rows of house.sh: which node lies on which, how far above it, and how much of it. */
static const struct {
    const char *below, *above, *lifted; /* the last: null where another row's does it */
    double gap, area;                   /* m, m^2 */
} fights[] = {
    {"terrain street", "garden west", "garden west", 0.005, 40 * 1},
    {"terrain street", "garden east", "garden east", 0.005, 40 * 1},
    {"terrain street", "road", "road", 0.004, 80 * 6},
    {"terrain street", "marking", NULL, 0.006, 80 * 0.3},
    {"road", "marking", "marking", 0.002, 80 * 0.3},
    {"slab", "parquet", "parquet", 0.002, 11 * 7},
    {"front wall", "door", "door", 0, 1 * 2},
    {"front wall", "shutters", "shutters", 0.0015, 4 * 0.5 * 1.25},
    {"front wall", "poster", "poster", 0.001, 1 * 1.4},
    {"front wall", "frame", "frame", 0.002, 1.2 * 0.9},
    {"front wall", "picture", NULL, 0.003, 0.8 * 1.2 * 0.8 * 0.9},
    {"frame", "picture", "picture", 0.001, 0.8 * 1.2 * 0.8 * 0.9},
    {"roof front", "solar", "solar", 0.004, 0.4 * 13 * 0.5 * 6},
    {"terrace", "tiles", "tiles", 0.003, 5.5 * 3},
    {"terrace", "railing", "railing", 0, 5 * 0.1 * 0.1},
    {"wing body", "wing poster", "wing poster", 0.00125, 1.5 * 1},
    {"fence", "ivy", "ivy", 0.005, 0.5 * 6 * 0.9 * 1.2},
};
enum { FIGHTS = sizeof fights / sizeof fights[0] };

/* What is as near, and nobody sees: with the filter that knows it. Null: nothing finds it, asked for or not. */
static const struct {
    const char *filter, *a, *b;
} harmless[] = {
    {"facing", "skirt west", "skirt east"},  /* back to back */
    {"facing", "terrace", "handrail"},       /* not there at all: see below */
    {"facing", "slab", "front wall"},        /* stands on it */
    {"facing", "chimney", "chimney cap"},    /* lies on it */
    {"facing", "wing body", "wing roof"},    /* lies on it, mirrored */
    {"blended", "front wall", "windows"},    /* glass */
    {"hidden", "beam", "conduit"},           /* within the pillar */
    {NULL, "garden west", "garden east"},    /* an edge beside an edge */
    {NULL, "west wall", "west gable"},       /* an edge on an edge */
    {NULL, "railing", "railing"},            /* five posts */
};
