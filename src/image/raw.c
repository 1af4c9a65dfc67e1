/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Raw: the pixels as they lie in memory, the lowest byte first, rows without padding, and nothing else, as debuggers
 * of graphics save a resource. Its size is given, or that of the one usual picture that has as many bytes.
 *
 * Pixels of two bytes are codes of 16 bits. Of four bytes they are binary32 where all are in [0, 1] and one of them is
 * at least 2^-40, which depths are; else D24S8, the depth in the lower 24 bits, as DXGI and Vulkan have it. Of eight
 * bytes they are D32S8: binary32, and the stencil, which is left out.
 */
#include <stdlib.h>
#include <string.h>

#include "core/bits.h"
#include "image/kind.h"

static const unsigned usual[][2] = {
    {640, 480},   {1024, 768},  {1280, 720},  {1280, 800},  {1280, 1024}, {1366, 768},  {1440, 900},
    {1600, 900},  {1600, 1200}, {1680, 1050}, {1920, 1080}, {1920, 1200}, {2560, 1080}, {2560, 1440},
    {2560, 1600}, {2880, 1800}, {3440, 1440}, {3840, 1600}, {3840, 2160}, {5120, 2880}, {7680, 4320},
    {256, 256},   {512, 512},   {1024, 1024}, {2048, 2048}, {4096, 4096}, {8192, 8192},
};

/* Which usual picture has that many pixels; null: none. */
static const unsigned *find_usual(uint64_t pixels) {
    for (size_t i = 0; i < sizeof usual / sizeof usual[0]; i++)
        if ((uint64_t)usual[i][0] * usual[i][1] == pixels)
            return usual[i];
    return NULL;
}

/* The one usual picture that has that many bytes, in pixels of 2, 4 or 8. */
static bool assume_size(image_source *source, uint64_t bytes, uint64_t size[2]) {
    const unsigned *found = NULL;
    for (uint64_t pixel = 2; pixel <= 8; pixel *= 2) {
        const unsigned *other = bytes % pixel == 0 ? find_usual(bytes / pixel) : NULL;
        if (found != NULL && other != NULL)
            return source_fail(source, "raw: may be %u x %u or %u x %u pixels: --size says which", found[0], found[1],
                               other[0], other[1]);
        found = other != NULL ? other : found;
    }
    if (found == NULL)
        return source_fail(source, "raw: no usual picture has its %llu bytes: --size WxH says how many pixels it has",
                           (unsigned long long)bytes);
    size[0] = found[0];
    size[1] = found[1];
    return true;
}

static bool is_float_depth(const image *img) {
    const uint32_t *bits = img->data;
    const size_t count = (size_t)img->width * img->height * img->channels;
    bool any = false;
    for (size_t i = 0; i < count; i += img->channels) {
        if (!(dp_float32(bits[i]) >= 0 && dp_float32(bits[i]) <= 1))
            return false;
        any = any || dp_float32(bits[i]) >= 0x1p-40F;
    }
    return any;
}

static void drop_stencil(image *img) {
    uint32_t *codes = img->data;
    const size_t count = (size_t)img->width * img->height;
    for (size_t i = 0; i < count; i++)
        codes[i] &= 0xFFFFFF;
    img->type = IMAGE_U32;
    img->says = "unorm24";
}

static bool read_raw(image_source *source, image *out) {
    uint64_t size[2] = {source->asked.width, source->asked.height};
    const uint64_t bytes = source->left;
    const bool given = source->asked.width > 0;
    if (!source->sized)
        return source_fail(source, "raw: its length must be known: save it as a file");
    if (!given && !assume_size(source, bytes, size))
        return false;
    const uint64_t pixel = bytes % (size[0] * size[1]) == 0 ? bytes / (size[0] * size[1]) : 0;
    if (pixel != 2 && pixel != 4 && pixel != 8)
        return source_fail(source, "raw: %llu x %llu pixels take 2, 4 or 8 bytes each, and it has %llu bytes in all",
                           (unsigned long long)size[0], (unsigned long long)size[1], (unsigned long long)bytes);
    const image_type type = pixel == 2 ? IMAGE_U16 : IMAGE_F32;
    if (!source_shape(source, out, size[0], size[1], pixel == 8 ? 2 : 1, type) || !source_samples(source, out, true))
        return false;
    out->size_assumed = !given;
    if (pixel == 2)
        return true;
    if (is_float_depth(out))
        out->says = "fp32";
    else if (pixel == 4)
        drop_stencil(out);
    else
        return source_fail(source, "raw: pixels of 8 bytes must begin with a binary32 depth from 0 to 1");
    return true;
}

const image_kind image_kind_raw = {
    .name = "raw",
    .ending = ".raw",
    .types = 1U << IMAGE_U16 | 1U << IMAGE_U32 | 1U << IMAGE_F32,
    .channels = 1U << 1 | 1U << 2,
    .read = read_raw,
};
