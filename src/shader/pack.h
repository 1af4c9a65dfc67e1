/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file pack.h  Depth and normals in the channels of a texture: encodings, a row each, with their errors.
 *
 * Errors of a depth are shares of the range [0, 1): times far, they are scene units of a linear depth z/far. Errors of
 * a normal are angles in degrees, over unit vectors spread evenly on the row's domain. Claims are data: a test measures
 * what they speak of, and fails when it exceeds them or stays below them.
 */
#ifndef SHADER_PACK_H
#define SHADER_PACK_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "core/named.h"

typedef enum pack_kind { PACK_DEPTH = 0, PACK_NORMAL, PACK_DEPTH_NORMAL, PACK_KINDS } pack_kind;

/** kScale of EncodeViewNormalStereo: channels from 0 to 1 span this far to both sides of the pole. */
#define PACK_STEREO_SCALE 1.7777

/** How normals, or depths where there are none, are laid out. */
typedef enum pack_layout { PACK_RG = 0, PACK_STEREO, PACK_OCT, PACK_OCT_888, PACK_XYZ, PACK_LAYOUTS } pack_layout;

enum { PACK_CHANNELS_MAX = 4, PACK_INPUTS_MAX = 4 };

/** A mean and a maximum: of |decoded - given|, or of the angle between the two. 0 where there is nothing to claim. */
typedef struct pack_bound {
    double mean, max;
} pack_bound;

typedef struct pack_row {
    NAMED_FIELDS;
    pack_kind kind;
    pack_layout layout;
    int channels, bits; /**< bits of each channel */
    bool sphere;        /**< normals: of the whole sphere, else of the hemisphere n.z >= 0 */
    bool binary32;      /**< computed in binary32 as a shader does, and measured on binary32 inputs; else in doubles */
    bool truncates;     /**< channels are stored truncated, else to the nearest code */
    pack_bound depth;   /**< claims: shares of the range */
    pack_bound normal;  /**< claims: degrees */
    /**
     * The codes of the channels.
     * @param in  depth: a number in [0, 1); normal: a unit vector of the row's domain; both: the normal, then the depth
     * @param codes  `channels` codes; SNORM ones in two's complement of `bits` bits
     */
    void (*encode)(const struct pack_row *row, const double *in, uint32_t codes[]);
    /** The way back; a normal comes out with length 1. */
    void (*decode)(const struct pack_row *row, const uint32_t codes[], double *out);
} pack_row;

NAMED_ROWS(pack_row, pack);

/** The row "stereo-8". */
const pack_row *pack_stereo(void);

/**
 * For normals: the largest angle, degrees, between what the codes give back and a unit vector that a shader in binary32
 * stores as them; 180 where a channel may have been clipped, or no unit vector is stored so.
 * @param truncated  channels were cut off; else they are the nearest
 */
double pack_reach(const pack_row *row, const uint32_t codes[], bool truncated);

#endif
