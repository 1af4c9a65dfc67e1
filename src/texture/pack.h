/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file pack.h  Depth and normals in the channels of a texture: encodings, a row each, with their errors.
 */
#ifndef TEXTURE_PACK_H
#define TEXTURE_PACK_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef enum pack_kind { PACK_DEPTH = 0, PACK_NORMAL, PACK_DEPTH_NORMAL, PACK_KINDS } pack_kind;

typedef struct pack_row {
    const char *name; /**< "rg-depth", "stereo-8", "oct-8", "xyz-8", "depth-normal", ... */
    const char *note;
    pack_kind kind;
    int channels, bits;           /**< of each channel */
    bool sphere;                  /**< normals: of the whole sphere, else of the hemisphere n.z >= 0 */
    double claim_mean, claim_max; /**< depth: shares of the range; normals: degrees, uniform on the domain */
    const char *source;
    /** Codes of the channels. Depth: linear in [0, 1). Normals: unit vectors. */
    void (*encode)(const struct pack_row *row, const double *in, uint32_t codes[4]);
    void (*decode)(const struct pack_row *row, const uint32_t codes[4], double *out);
} pack_row;

const pack_row *pack_get(size_t index);
const pack_row *pack_find(const char *name);

/** The error over the whole domain. */
typedef struct pack_error {
    double mean, max; /**< as the claims */
    double bias;      /**< depth: mean of decoded - given */
    double at[3];     /**< an input that reaches max */
    uint64_t codes;   /**< different codes that are used */
} pack_error;

/** Exhaustive over the codes: the maximum and mean are those of the whole continuous domain, within 1e-3 of them. */
bool pack_measure(const pack_row *row, pack_error *out);

#endif
