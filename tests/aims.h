/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file aims.h  What is aimed at in speed, a row each in aims.c. A missed aim is a word in a table and a name in the
 * last line of `make bench` (bench.sh), never a failure.
 */
#ifndef TESTS_AIMS_H
#define TESTS_AIMS_H

typedef enum aim_id {
    AIM_TABLE,
    AIM_TABLE_SLANTED,
    AIM_MAP,
    AIM_JUDGE,
    AIM_CERTIFIED,
    AIM_PIPELINE_CODE,
    AIM_CENSUS,
    AIM_ZFIGHT,
    AIM_CAMERA,
    AIM_HALVES,
    AIM_UNORM,
    AIM_CODE,
    AIM_EYE,
    AIM_WIDTH,
    AIM_SEPARATIONS,
    AIM_PLACES,
    AIM_NORMALS,
    AIM_PLACES_HALF,
    AIM_NORMALS_HALF,
    AIM_NORMALS_EXACT,
    AIM_EYE_MAP,
    AIM_PLACES_MAP,
    AIM_NORMALS_MAP,
    AIM_STATISTICS,
    AIM_FIGURE,
    AIM_FIGURE_MEMORY,
    AIM_LOADED,
    AIM_SMALL_TRIANGLES,
    AIM_TRIANGLES,
    AIM_TRIANGLES_BASELINE,
    AIM_COUNT
} aim_id;

/**
 * Prints the aim and whether it is met, and notes it for the last line in the file that DEPTHPREC_AIMS names. What was
 * not measured, NaN, is missed.
 */
void aim_judge(aim_id id, const char *what, double value);

/** In its place: prints, and notes, why it was not measured; one line. */
void aim_missing(aim_id id, const char *what, const char *why);

#endif
