/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * DDS: "DDS ", a header of 124 bytes, one of 20 more where the first says DX10, and the pixels as they lie in memory.
 * D3D9 names formats from the highest bits down, so D24X8 has its depth above the 8 bits; DXGI from the lowest up, so
 * R24_UNORM_X8 has it below them.
 * Source: Programming Guide for DDS, DXGI_FORMAT and D3DFORMAT in Microsoft's documentation of Direct3D
 */
#include <string.h>

#include "image/kind.h"

enum { HEADER_SIZE = 128, MORE_SIZE = 20 };
enum { HAS_FOURCC = 0x4, HAS_RGB = 0x40, HAS_LUMINANCE = 0x20000 };

/* The fields of the header that tell a format. */
typedef enum told { BY_DXGI = 0, BY_D3D9, BY_LUMINANCE, BY_RGB, BY_BGR, BY_NOTHING } told;

/* How the samples read are changed, if not shifted by 24 bits. */
enum { AS_IT_IS = -1, BLUE_FIRST = -2 };

typedef struct pixels {
    told by;
    uint32_t code; /* DXGI_FORMAT, D3DFORMAT, or the bits of a pixel */
    image_type type;
    uint32_t channels;
    const char *says; /* the depth format, where the name is that of one */
    int shift;        /* of u4: the code is 24 bits from here; or one of the above */
} pixels;

static const pixels formats[] = {
    {BY_DXGI, 20, IMAGE_F32, 2, "fp32", AS_IT_IS},    /* D32_FLOAT_S8X24_UINT: the second half is no number */
    {BY_DXGI, 19, IMAGE_F32, 2, "fp32", AS_IT_IS},    /* R32G8X24_TYPELESS */
    {BY_DXGI, 21, IMAGE_F32, 2, "fp32", AS_IT_IS},    /* R32_FLOAT_X8X24_TYPELESS */
    {BY_DXGI, 40, IMAGE_F32, 1, "fp32", AS_IT_IS},    /* D32_FLOAT */
    {BY_DXGI, 39, IMAGE_F32, 1, NULL, AS_IT_IS},      /* R32_TYPELESS */
    {BY_DXGI, 41, IMAGE_F32, 1, NULL, AS_IT_IS},      /* R32_FLOAT */
    {BY_DXGI, 42, IMAGE_U32, 1, NULL, AS_IT_IS},      /* R32_UINT */
    {BY_DXGI, 44, IMAGE_U32, 1, "unorm24", 0},        /* R24G8_TYPELESS */
    {BY_DXGI, 45, IMAGE_U32, 1, "unorm24", 0},        /* D24_UNORM_S8_UINT */
    {BY_DXGI, 46, IMAGE_U32, 1, "unorm24", 0},        /* R24_UNORM_X8_TYPELESS */
    {BY_DXGI, 55, IMAGE_U16, 1, "unorm16", AS_IT_IS}, /* D16_UNORM */
    {BY_DXGI, 53, IMAGE_U16, 1, NULL, AS_IT_IS},      /* R16_TYPELESS */
    {BY_DXGI, 56, IMAGE_U16, 1, NULL, AS_IT_IS},      /* R16_UNORM */
    {BY_DXGI, 57, IMAGE_U16, 1, NULL, AS_IT_IS},      /* R16_UINT */
    {BY_DXGI, 54, IMAGE_F16, 1, NULL, AS_IT_IS},      /* R16_FLOAT */
    {BY_DXGI, 61, IMAGE_U8, 1, NULL, AS_IT_IS},       /* R8_UNORM */
    {BY_DXGI, 49, IMAGE_U8, 2, NULL, AS_IT_IS},       /* R8G8_UNORM */
    {BY_DXGI, 28, IMAGE_U8, 4, NULL, AS_IT_IS},       /* R8G8B8A8_UNORM */
    {BY_DXGI, 31, IMAGE_U8, 4, NULL, AS_IT_IS},       /* R8G8B8A8_SNORM: for --packing camera-normals */
    {BY_D3D9, 114, IMAGE_F32, 1, NULL, AS_IT_IS},     /* R32F */
    {BY_D3D9, 111, IMAGE_F16, 1, NULL, AS_IT_IS},     /* R16F */
    {BY_D3D9, 82, IMAGE_F32, 1, "fp32", AS_IT_IS},    /* D32F_LOCKABLE */
    {BY_D3D9, 77, IMAGE_U32, 1, "unorm24", 8},        /* D24X8 */
    {BY_D3D9, 75, IMAGE_U32, 1, "unorm24", 8},        /* D24S8 */
    {BY_D3D9, 70, IMAGE_U16, 1, "unorm16", AS_IT_IS}, /* D16_LOCKABLE */
    {BY_D3D9, 80, IMAGE_U16, 1, "unorm16", AS_IT_IS}, /* D16 */
    {BY_D3D9, 81, IMAGE_U16, 1, NULL, AS_IT_IS},      /* L16 */
    {BY_LUMINANCE, 16, IMAGE_U16, 1, NULL, AS_IT_IS}, /* L16 by its mask */
    {BY_LUMINANCE, 8, IMAGE_U8, 1, NULL, AS_IT_IS},   /* L8 */
    {BY_RGB, 32, IMAGE_U8, 4, NULL, AS_IT_IS},        /* A8B8G8R8: red in the lowest byte */
    {BY_BGR, 32, IMAGE_U8, 4, NULL, BLUE_FIRST},      /* A8R8G8B8 */
    {BY_BGR, 24, IMAGE_U8, 3, NULL, BLUE_FIRST},      /* R8G8B8 */
    {BY_DXGI, 87, IMAGE_U8, 4, NULL, BLUE_FIRST},     /* B8G8R8A8_UNORM */
};

static uint32_t word_at(const unsigned char *header, size_t index) {
    const unsigned char *at = header + 4 * index;
    return at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24;
}

/* The words of the header, counted from the magic. */
enum {
    SIZE = 1,
    FLAGS,
    HEIGHT,
    WIDTH,
    DEPTH = 6,
    MIPS,
    FORMAT_FLAGS = 20,
    FOURCC,
    BITS,
    RED,
    GREEN,
    BLUE,
    ALPHA,
    CAPS2 = 28
};

static bool find_format(image_source *source, const unsigned char *header, const unsigned char *more,
                        const pixels **out) {
    const uint32_t flags = word_at(header, FORMAT_FLAGS), fourcc = word_at(header, FOURCC);
    const bool rgb = (flags & HAS_RGB) != 0 && word_at(header, GREEN) == 0xFF00;
    const bool red_low = rgb && word_at(header, RED) == 0xFF && word_at(header, BLUE) == 0xFF0000;
    const bool blue_low = rgb && word_at(header, BLUE) == 0xFF && word_at(header, RED) == 0xFF0000;
    const told by = more != NULL                   ? BY_DXGI
                    : (flags & HAS_FOURCC) != 0    ? BY_D3D9
                    : (flags & HAS_LUMINANCE) != 0 ? BY_LUMINANCE
                    : red_low                      ? BY_RGB
                    : blue_low                     ? BY_BGR
                                                   : BY_NOTHING;
    const uint32_t code = more != NULL ? word_at(more, 0) : by == BY_D3D9 ? fourcc : word_at(header, BITS);
    for (size_t i = 0; i < sizeof formats / sizeof formats[0]; i++)
        if (formats[i].by == by && formats[i].code == code) {
            *out = &formats[i];
            return true;
        }
    static const char advice[] = "save R32F, R16 or R24X8, or its pixels as .npy";
    if (by == BY_DXGI)
        return source_fail(source, "DDS: no depth is read from DXGI format %u: %s", code, advice);
    if (by == BY_D3D9 && code > 0xFFFFFF)
        return source_fail(source, "DDS: no depth is read from format %.4s: %s", (const char *)header + 4 * FOURCC,
                           advice);
    if (by == BY_D3D9)
        return source_fail(source, "DDS: no depth is read from D3D format %u: %s", code, advice);
    return source_fail(source, "DDS: no depth is read from pixels of %u bits with these masks: %s", code, advice);
}

static bool check_shape(image_source *source, const unsigned char *header, const unsigned char *more) {
    enum { HAS_MIPS = 0x20000, HAS_DEPTH = 0x800000, IS_CUBE = 0x200, IS_VOLUME = 0x200000, PLANE = 3 };
    const uint32_t flags = word_at(header, FLAGS), caps = word_at(header, CAPS2);
    const uint32_t mips = (flags & HAS_MIPS) != 0 ? word_at(header, MIPS) : 1;
    if (mips > 1)
        return source_fail(source, "DDS: it has %u mip levels: save the largest alone", mips);
    if ((caps & (IS_CUBE | IS_VOLUME)) != 0 || ((flags & HAS_DEPTH) != 0 && word_at(header, DEPTH) > 1) ||
        (more != NULL && (word_at(more, 1) != PLANE || word_at(more, 3) > 1)))
        return source_fail(source, "DDS: it has several images, a cube, volume or array: save one slice");
    return true;
}

static void unpack(image *img, int shift) {
    uint32_t *codes = img->data;
    const size_t count = (size_t)img->width * img->height;
    for (size_t i = 0; i < count; i++)
        codes[i] = codes[i] >> shift & 0xFFFFFF;
}

static void swap_red(image *img) {
    uint8_t *samples = img->data;
    const size_t count = (size_t)img->width * img->height, channels = img->channels;
    for (size_t i = 0; i < count; i++) {
        const uint8_t blue = samples[i * channels];
        samples[i * channels] = samples[i * channels + 2];
        samples[i * channels + 2] = blue;
    }
}

static bool read_dds(image_source *source, image *out) {
    unsigned char header[HEADER_SIZE], more[MORE_SIZE];
    const pixels *format = NULL;
    if (!source_header(source, header, sizeof header))
        return false;
    if (word_at(header, SIZE) != HEADER_SIZE - 4)
        return source_fail(source, "DDS: its header must have 124 bytes, got %u", word_at(header, SIZE));
    const bool dx10 = (word_at(header, FORMAT_FLAGS) & HAS_FOURCC) != 0 && memcmp(header + 4 * FOURCC, "DX10", 4) == 0;
    if (dx10 && !source_header(source, more, sizeof more))
        return false;
    if (!find_format(source, header, dx10 ? more : NULL, &format) || !check_shape(source, header, dx10 ? more : NULL) ||
        !source_shape(source, out, word_at(header, WIDTH), word_at(header, HEIGHT), format->channels, format->type) ||
        !source_samples(source, out, true))
        return false;
    out->says = format->says;
    if (format->shift == BLUE_FIRST)
        swap_red(out);
    else if (format->shift != AS_IT_IS)
        unpack(out, format->shift);
    return true;
}

const image_kind image_kind_dds = {
    .name = "DDS",
    .ending = ".dds",
    .magic = {"DDS ", NULL},
    .magic_size = 4,
    .types = 1U << IMAGE_U8 | 1U << IMAGE_U16 | 1U << IMAGE_U32 | 1U << IMAGE_F16 | 1U << IMAGE_F32,
    .channels = 1U << 1 | 1U << 2 | 1U << 3 | 1U << 4,
    .read = read_dds,
};
