/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file survey.h  Statistics of the depths of a frame: what is sky, which codes are used, how near two depths come. */
#ifndef TEXTURE_SURVEY_H
#define TEXTURE_SURVEY_H

#include "texture/frame.h"

enum { SURVEY_BANDS = 40 };

/** Depths from lo up to hi, without hi. */
typedef struct survey_band {
    double lo, hi;
    uint64_t pixels;
    uint64_t codes;     /**< different ones among them */
    uint64_t available; /**< codes whose depths lie in the band; levels where the frame's sensor has some,
 else numbers of the file where these are fewer */
    double gap;         /**< between the two nearest different depths; NaN where there are not two */
    double gap_z;       /**< the nearer of the two */
    uint64_t steps;     /**< how many codes, or levels, apart they are: 0 within one level */
    double interval;    /**< the cell of the nearer one: what the format can tell apart there */
} survey_band;

typedef struct survey {
    uint64_t pixels, sky, invalid; /**< all; counting as sky; with no depth. In a synthetic image nothing is invalid */
    uint64_t true_sky; /**< where nothing is hit in a synthetic image; the rest of `sky` is hidden geometry */
    double sky_from;   /**< depths from here on count as sky */
    uint64_t codes;    /**< different ones, without sky */
    double lo, hi;     /**< nearest and farthest depth, without sky; NaN when there is none */
    size_t band_count; /**< bands from the one that holds lo to the one that holds hi */
    survey_band bands[SURVEY_BANDS];
} survey;

/**
 * Visits all pixels. Where planes are oblique there are no bands, and `sky_from` is NaN; what lies beyond infinity is
 * invalid. Bands end at 1, 2 and 5 times powers of ten, or at powers of ten where those would be too many; they are of
 * distances where the camera is radial.
 *
 * Memory: a bit for each code of the format, of which only what is used is touched (fp32: 127 MiB of addresses).
 * @return false when out of memory
 */
bool survey_make(const frame *f, survey *out);

/** Pairs of surfaces of a synthetic image that ought to be told apart. */
typedef struct survey_pairs {
    uint64_t pairs;    /**< those that lie in [near, far] as a whole */
    uint64_t ties;     /**< stored as one code: they fight */
    uint64_t possible; /**< nearer to each other than dp_separation(): a tie cannot be ruled out */
    double first_tie;  /**< the nearest front surface of a tie; NaN when there is none */
    double certain_to; /**< the farthest front surface up to which no pair is `possible`; NaN when there is none */
} survey_pairs;

/** @return false when the synthetic image has no pairs */
bool survey_pairs_make(const frame *f, survey_pairs *out);

/** Where the first `most` ties lie in the image, px from its left and upper edge. @return how many ties there are */
size_t survey_ties(const frame *f, size_t most, double (*at)[2]);

#endif
