/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "shader/packing.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/elementary.h"
#include "shader/pack.h"

enum { BYTE = 255 };

/* ---- Rows -------------------------------------------------------------------------------------------------------- */

#define UNITY "UnityCG.cginc of Unity's built-in shaders, "
#define URP   "Unity's Universal RP, "
#define THREE "packing.glsl.js of three.js, packDepthToRGBA, "

/* clang-format off */
static const packing rows[] = {
    {.name = "depth-normals", .channels = 4, .weight = {0, 0, 255, 1}, .steps = 65025, .linear = true,
     .encoded = "stereo-8", .aliases = "_CameraDepthNormalsTexture DecodeDepthNormal EncodeDepthNormal",
     .wraps = true, .format = "fp32", .off = 0x1p-23, .cut = 1.0 / 255,
     .note = "eye depth over far in zw, as rg; the view-space normal in xy, stereographic",
     .source = UNITY "EncodeDepthNormal"},
    {.name = "camera-normals", .channels = 3, .linear = true, .encoded = "xyz-8", .world = true, .format = "fp32",
     .aliases = "_CameraNormalsTexture SampleSceneNormals",
     .note = "no depth: the world-space normal in xyz, R8G8B8A8_SNorm: bytes as in memory, or numbers from -1 to 1",
     .source = URP "pass DepthNormals of its shaders, forward"},
    {.name = "camera-normals-oct", .channels = 3, .linear = true, .encoded = "oct-888", .world = true, .format = "fp32",
     .aliases = "_GBUFFER_NORMALS_OCT PackNormalOctQuadEncode",
     .note = "no depth: the same octahedral, 12 bits each in three UNORM channels, with accurate G-buffer normals",
     .source = URP "pass DepthNormals of its shaders, with _GBUFFER_NORMALS_OCT"},
    {.name = "rg", .aliases = "EncodeFloatRG DecodeFloatRG", .channels = 2, .weight = {255, 1}, .steps = 65025,
     .linear = true, .wraps = true, .format = "fp32", .off = 0x1p-23, .cut = 1.0 / 255,
     .note = "eye depth over far, x + y/255: steps of 1/65025; frac makes 1 a 0, which reads as the camera",
     .source = UNITY "EncodeFloatRG"},
    {.name = "rgba", .channels = 4, .weight = {65536 * 255, 256 * 255, 255, 1}, .steps = 0x1p24 * 255,
     .format = "fp32", .cut = 0x1.0101p-8,
     .note = "window depth as three.js packs it from r167 on, red first: 24 bits in rgb, the rest in alpha",
     .source = THREE "r167"},
    {.name = "rgba-r166", .channels = 4, .weight = {1, 256, 65536, 16777216}, .steps = 0x1p32,
     .format = "fp32", .off = 0x1p-33, .cut = 0x1.0101p-8, /* the last half of red gets 255 */
     .note = "window depth as three.js packed it up to r166, alpha first: steps of 2^-32; 1 becomes 1 - 2^-32",
     .source = THREE "r166"},
    {.name = "rgb24", .channels = 3, .weight = {65536, 256, 1}, .steps = 16777215, .format = "unorm24",
     .note = "window depth as codes of 24 bits, red the highest byte",
     .source = "three bytes of a code, the highest first"},
    {.name = "rgb24-le", .channels = 3, .weight = {1, 256, 65536}, .steps = 16777215, .format = "unorm24",
     .note = "the same, red the lowest byte",
     .source = "three bytes of a code, the lowest first"},
    {.name = "carla", .channels = 3, .weight = {1, 256, 65536}, .steps = 16777215, .linear = true, .format = "unorm24",
     .off = 0.5 / 16777215, /* cut off, or rounded */
     .note = "eye depth over far in 24 bits, red the lowest byte, as CARLA's depth camera: far is 1000 m",
     .source = "CARLA, Sensors reference, Depth camera"},
    {.name = "linear01", .aliases = "r8-linear01 COMPUTE_DEPTH_01", .channels = 1, .weight = {1}, .steps = 255,
     .linear = true, .format = "fp32", .off = 0x1p-23,
     .note = "eye depth over far in one channel of 8 bits, which the bound is of, of 16, or of a float",
     .source = UNITY "COMPUTE_DEPTH_01 or Linear01Depth, written by a pass of one's own"},
};
/* clang-format on */

NAMED_TABLE(packing, rows);

/* ---- One texel --------------------------------------------------------------------------------------------------- */

uint64_t packing_number(const packing *p, const uint8_t *texel) {
    uint64_t number = 0;
    for (uint32_t k = 0; k < p->channels; k++)
        number += (uint64_t)p->weight[k] * texel[k];
    return number;
}

double packing_depth(const packing *p, uint64_t number) {
    return p->steps == 0 ? (double)NAN : fmin((double)number / p->steps, 1);
}

uint64_t packing_nearest(const packing *p, double depth) {
    uint64_t most = 0;
    for (uint32_t k = 0; k < p->channels; k++)
        most += (uint64_t)p->weight[k] * BYTE;
    const double number = rint(fmin(fmax(depth, 0), 1) * p->steps);
    return number < (double)most ? (uint64_t)number : most;
}

void packing_texel(const packing *p, uint64_t number, uint8_t *texel) {
    uint64_t above = UINT64_MAX;
    for (uint32_t done = 0; done < p->channels; done++) {
        uint32_t next = 0, weight = 0; /* the largest weight that is left */
        for (uint32_t k = 0; k < p->channels; k++)
            if (p->weight[k] > weight && p->weight[k] < above) {
                next = k;
                weight = p->weight[k];
            }
        if (weight == 0)
            return;
        const uint64_t share = number / weight < BYTE ? number / weight : BYTE;
        texel[next] = (uint8_t)share;
        number -= share * weight;
        above = weight;
    }
}

const pack_row *packing_normals(const packing *p) {
    return p->encoded != NULL ? pack_find(p->encoded) : NULL;
}

void packing_normal(const uint8_t *texel, double normal[3]) {
    const uint32_t codes[2] = {texel[0], texel[1]};
    pack_stereo()->decode(pack_stereo(), codes, normal);
}

void packing_normal_texel(const double normal[3], uint8_t *texel) {
    uint32_t codes[2];
    pack_stereo()->encode(pack_stereo(), normal, codes);
    for (int i = 0; i < 2; i++)
        texel[i] = (uint8_t)codes[i];
}

/* A texel holds a square of the stereographic plane. That map is conformal: 2/(1 + |v|^2) of a way there. */
double packing_normal_reach(const uint8_t *texel, bool truncated) {
    const double diagonal = M_SQRT2 * PACK_STEREO_SCALE / BYTE * (truncated ? 2 : 1);
    double normal[3];
    packing_normal(texel, normal);
    const double least = fmax(dp_hypot(normal[0], normal[1]) / (normal[2] + 1) - diagonal, 0);
    return M_SQRT2 * diagonal * 2 / (1 + least * least);
}

uint64_t packing_unwrap(const packing *p, image *depths, float zero) {
    uint64_t count = 0;
    float *const d = depths->data;
    for (size_t i = 0; p->wraps && i < (size_t)depths->width * depths->height; i++)
        if (d[i] == 0) {
            d[i] = zero;
            count++;
        }
    return count;
}

/* ---- Images ------------------------------------------------------------------------------------------------------ */

static bool refuse(unpacked *out, const char *format, ...) __attribute__((format(printf, 2, 3)));
static bool refuse(unpacked *out, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(out->wrong, sizeof out->wrong, format, arguments);
    va_end(arguments);
    return false;
}

/* The sample of 8 bits that a wider one stands for; -1 where it stands for none. Numbers are shares of `most`, and are
 * of either sign where that is 127. */
static int byte_of(const image *img, size_t sample, int most) {
    const uint16_t wide = img->type == IMAGE_U16 ? ((const uint16_t *)img->data)[sample] : 0;
    if (img->type == IMAGE_U8)
        return ((const uint8_t *)img->data)[sample];
    if (img->type == IMAGE_U16)
        return wide % 257 == 0 ? wide / 257 : -1;
    const double number =
        img->type == IMAGE_F32 ? (double)((const float *)img->data)[sample] : ((const double *)img->data)[sample];
    const double code = rint(number * most);
    const bool fits = code >= (most < BYTE ? -most : 0) && code <= most;
    return fits && fabs(number * most - code) <= most * 0x1p-22 ? (int)code & BYTE : -1;
}

static uint8_t *bytes_of(const packing *p, const image *img, unpacked *out) {
    const size_t count = (size_t)img->width * img->height, channels = img->channels, own = p->channels;
    const int most = p->encoded != NULL && packing_normals(p)->layout == PACK_XYZ ? 127 : BYTE;
    uint8_t *bytes = malloc(count * own);
    if (bytes == NULL)
        refuse(out, "no memory");
    for (size_t i = 0; bytes != NULL && i < count; i++)
        for (size_t k = 0; k < own; k++) {
            const int byte = byte_of(img, i * channels + k, most);
            if (byte < 0) {
                refuse(out, "pixel %zu,%zu lies between the codes of 8 bits: it was resampled, or is not of 8 bits",
                       i % img->width, i / img->width);
                free(bytes);
                return NULL;
            }
            bytes[i * own + k] = (uint8_t)byte;
        }
    return bytes;
}

/* The channels of the two largest weights, where the second lies below the first without a gap. */
static bool coarse_and_fine(const packing *p, uint32_t *coarse, uint32_t *fine) {
    *coarse = *fine = IMAGE_CHANNELS_MAX;
    for (uint32_t k = 0; k < p->channels; k++)
        if (p->weight[k] > 0 && (*coarse == IMAGE_CHANNELS_MAX || p->weight[k] > p->weight[*coarse]))
            *coarse = k;
    for (uint32_t k = 0; k < p->channels; k++)
        if (k != *coarse && p->weight[k] > 0 && (*fine == IMAGE_CHANNELS_MAX || p->weight[k] > p->weight[*fine]))
            *fine = k;
    return *fine < IMAGE_CHANNELS_MAX;
}

/*
 * Where a surface passes from one coarse code to the next, the fine channel jumps by nearly all of its range. Whoever
 * averages channels apart from each other makes numbers of that jump which no surface has: a quarter of a coarse step
 * or more beside both ends of a row of three or four pixels, whose ends are closer together than that; and each channel
 * lies between its neighbours. A fence or grass stands as far out where no coarse code steps.
 */
typedef struct row_counts {
    uint64_t even, out;
} row_counts;

static bool is_between(int k, int one, int other) {
    return k >= (one < other ? one : other) && k <= (one > other ? one : other);
}

/* By whether the coarse code steps from end to end. */
static void count_row(const packing *p, const uint8_t *at, size_t step, size_t length, const uint32_t channel[2],
                      row_counts seen[2]) {
    const uint32_t coarse = channel[0], fine = channel[1];
    const double unit = p->weight[coarse], part = p->weight[fine], quarter = unit / 4;
    const uint8_t *end = at + (length - 1) * step;
    const double first = unit * at[coarse] + part * at[fine];
    const double last = unit * end[coarse] + part * end[fine];
    const int steps = abs(end[coarse] - at[coarse]);
    if (steps > 1 || fabs(last - first) >= quarter)
        return;
    bool even = true, between = true;
    for (const uint8_t *within = at + step; within < end; within += step) {
        const double k = unit * within[coarse] + part * within[fine];
        even = even && k >= fmin(first, last) - quarter && k <= fmax(first, last) + quarter;
        between = between && is_between(within[coarse], at[coarse], end[coarse]) &&
                  is_between(within[fine], at[fine], end[fine]);
    }
    seen[steps].even += even ? 1 : 0;
    seen[steps].out += !even && (steps == 0 || between) ? 1 : 0;
}

/* Averages stand out where the coarse code steps far more often than surfaces do elsewhere. */
static bool was_resampled(const packing *p, const uint8_t *bytes, const image *img) {
    enum { LEAST = 8, OFTEN = 8, MORE = 4 };
    const size_t width = img->width, height = img->height, own = p->channels;
    uint32_t channel[2];
    row_counts seen[2] = {{0, 0}, {0, 0}};
    if (!coarse_and_fine(p, &channel[0], &channel[1]))
        return false;
    for (size_t y = 0; y < height; y++)
        for (size_t x = 0; x < width; x++) {
            const uint8_t *at = bytes + (y * width + x) * own;
            for (size_t length = 3; length <= 4; length++) {
                if (x + length <= width)
                    count_row(p, at, own, length, channel, seen);
                if (y + length <= height)
                    count_row(p, at, width * own, length, channel, seen);
            }
        }
    const row_counts *plain = &seen[0], *crossing = &seen[1];
    const double rough = (double)plain->out / fmax((double)(plain->even + plain->out), 1.0);
    const double torn = (double)crossing->out / fmax((double)(crossing->even + crossing->out), 1.0);
    return crossing->out >= LEAST && OFTEN * crossing->out > crossing->even && torn > MORE * rough;
}

/* With alpha premultiplied no channel is above it. By chance that is so in a share of less than a half of the pixels.
 */
static bool is_premultiplied(const uint8_t *bytes, size_t count) {
    enum { LEAST = 64 };
    size_t telling = 0;
    for (size_t i = 0; i < count; i++) {
        const uint8_t *at = bytes + 4 * i;
        if (at[0] > at[3] || at[1] > at[3] || at[2] > at[3])
            return false;
        telling += at[3] < BYTE && at[3] > 0;
    }
    return telling >= LEAST;
}

/* Rounded to SNORM a unit vector is as long as 127 codes, but for sqrt(3) of one; blending leaves a few others. */
static bool are_normals(const packing *p, const uint8_t *bytes, size_t count, unpacked *out) {
    enum { FEW = 8, LENGTH = 127, MOST = 2 };
    size_t drawn = 0, wrong = 0;
    if (packing_normals(p)->layout != PACK_XYZ)
        return true;
    for (size_t i = 0; i < count; i++) {
        const int8_t *at = (const int8_t *)bytes + i * p->channels;
        const double length = sqrt(at[0] * at[0] + at[1] * at[1] + at[2] * at[2]);
        drawn += length > 0;
        wrong += length > 0 && fabs(length - LENGTH) > MOST;
    }
    return FEW * wrong <= drawn ||
           refuse(out, "%zu of %zu texels hold no vector of length 1: no SNORM normals, or resampled", wrong, drawn);
}

static bool replace(const packing *p, const uint8_t *bytes, image *img, unpacked *out) {
    const size_t count = (size_t)img->width * img->height, own = p->channels;
    const size_t beside = p->encoded != NULL ? (size_t)packing_normals(p)->channels : 0;
    const image_type type = p->steps <= 0x1p24 ? IMAGE_F32 : IMAGE_F64;
    void *depths = malloc(count * image_type_size(type));
    out->normals = beside > 0 ? malloc(beside * count) : NULL;
    if (depths == NULL || (beside > 0 && out->normals == NULL)) {
        free(depths);
        free(out->normals);
        return refuse(out, "no memory");
    }
    for (size_t i = 0; i < count; i++) {
        const double depth = packing_depth(p, packing_number(p, bytes + own * i));
        if (type == IMAGE_F32)
            ((float *)depths)[i] = (float)depth;
        else
            ((double *)depths)[i] = depth;
        if (beside > 0)
            memcpy(out->normals + beside * i, bytes + own * i, beside);
    }
    free(img->data);
    img->data = depths;
    img->type = type;
    img->channels = 1;
    return true;
}

/* One channel of more than 8 bits is the depth itself: it stays as it is, in steps or numbers of its own. */
static bool keep_alone(const image *img, grain *out) {
    static const int bits[IMAGE_TYPE_COUNT] = {[IMAGE_F16] = 11, [IMAGE_F32] = 24, [IMAGE_F64] = 53};
    out->kind = img->type == IMAGE_U16 ? GRAIN_STEPS : GRAIN_FLOATS;
    out->steps = UINT16_MAX;
    out->bits = bits[img->type];
    out->least = img->type == IMAGE_F16 ? 0x1p-24 : 0x1p-149;
    return true;
}

static bool all_bytes(const image *img) {
    const size_t count = (size_t)img->width * img->height;
    size_t i = 0;
    while (i < count && byte_of(img, i * img->channels, BYTE) >= 0)
        i++;
    return i == count;
}

bool packing_convert(const packing *p, bool zero, image *img, unpacked *out) {
    *out = (unpacked){.grain = {.kind = GRAIN_STEPS,
                                .rounding = zero ? GRAIN_ZERO : GRAIN_NEAREST,
                                .steps = p->steps,
                                .margin = p->off + (zero ? p->cut : 0),
                                .bits = p->steps > 0x1p24 ? 24 : 0,
                                .least = 0x1p-149}};
    if (img->channels < p->channels)
        return refuse(out, "the packing %s takes %u channels, got %u", p->name, p->channels, img->channels);
    if (p->channels == 1 && img->type != IMAGE_U32 && (img->type == IMAGE_F16 || !all_bytes(img)))
        return keep_alone(img, &out->grain);
    if (img->type == IMAGE_U32 || img->type == IMAGE_F16)
        return refuse(out, "the packing %s takes samples of u1, or of u2, f4 or f8 that were of 8 bits, got %s",
                      p->name, image_type_name(img->type));
    uint8_t *bytes = bytes_of(p, img, out);
    if (bytes == NULL)
        return false;
    const bool may_tear = zero && p->cut > 0; /* truncation does to the fine channel what averages do */
    bool good = may_tear || !was_resampled(p, bytes, img) ||
                refuse(out, "was resampled: channels were averaged where the coarse one steps; take the texture as it "
                            "was rendered, or resize it by nearest neighbours");
    good = good && (p->steps > 0 || are_normals(p, bytes, (size_t)img->width * img->height, out));
    out->premultiplied = p->channels == 4 && is_premultiplied(bytes, (size_t)img->width * img->height);
    good = good && replace(p, bytes, img, out);
    free(bytes);
    return good;
}
