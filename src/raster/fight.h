/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file fight.h  How near two slanted planes come before a rasterizer draws a pixel wrong, against what is guaranteed.
 *
 * Two parallel planes are drawn about a random pixel, each as a mesh of its own random triangles of the class, the
 * farther one first. A pixel that both cover is wrong where the farther one is seen. The separation is walked down
 * from the guarantee, a fifth at a time, as long as that finds a wrong pixel nearer to it. What is found is drawn: a
 * lower bound of what the rasterizer needs.
 */
#ifndef RASTER_FIGHT_H
#define RASTER_FIGHT_H

#include "raster/draw.h"

enum { DRAW_BANDS_MAX = 128 };

/** A binade of eye depth of the farther plane, cut to the range. */
typedef struct draw_fight_band {
    double lo, hi;
    uint64_t pixels;   /**< that both planes covered, those of each drawing counted */
    double separation; /**< that of the wrong pixel which comes nearest to its guarantee, along the normal, scene units;
                            this and the rest are NaN where no pixel is wrong */
    double z, slant;   /**< where that is: eye depth of the farther plane, the normal's angle to the view axis */
    double guaranteed; /**< there and at that slant */
    double used;       /**< separation / guaranteed */
} draw_fight_band;

typedef struct draw_fight_result {
    int band_count;
    draw_fight_band bands[DRAW_BANDS_MAX]; /**< nearest first */
} draw_fight_result;

typedef enum draw_fight_status { DRAW_FIGHT_DONE = 0, DRAW_FIGHT_STOPPED, DRAW_FIGHT_NO_MEMORY } draw_fight_status;

typedef struct draw_fight_request {
    const draw_camera *camera;
    const dp_setup *setup; /**< that of the camera: its triangles have the rasterizer's grid and plane, their class, and
                              the slants that are drawn */
    double azimuth;        /**< of the normal on the screen, degrees from right to up; NaN: any */
    double lo, hi;         /**< eye depths within [near, far], 0 < lo < hi, hi finite */
    uint64_t count;        /**< pairs of meshes; each band has the same number, at least one */
    uint64_t seed;
    int threads; /**< 0: as many as OpenMP would take */
    /** Told now and then, by one thread at a time, how many pairs are done; nonzero stops it. May be null. */
    int (*progress)(void *context, uint64_t done);
    void *context;
} draw_fight_request;

/** The separation guaranteed for planes at a slant, degrees, the farther one z away; INFINITY where none is. */
double draw_guaranteed(const dp_setup *setup, double slant, double z);

/** All bands as one. */
draw_fight_band draw_fight_worst(const draw_fight_result *result);

/** How many pairs will be drawn: of the request lo, hi and count are read. */
uint64_t draw_fight_count(const draw_fight_request *request);

/** Runs it: the same result for any number of threads. On anything but DRAW_FIGHT_DONE *result holds nothing of use. */
draw_fight_status draw_fight(const draw_fight_request *request, draw_fight_result *result);

#endif
