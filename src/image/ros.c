/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The data of a message of ROS's compressedDepth: twelve bytes, an integer and the binary32 numbers A and B, the lowest
 * byte first, and a PNG of 16 bits. Of 32FC1 a sample v is A/z + B cut off, in metres, and 0 is a hole. Of 16UC1 nobody
 * sets A and B, and the samples are what the sensor gave, which is millimetres but for few.
 */
#include <math.h>
#include <stdlib.h>

#include "core/bits.h"
#include "image/kind.h"

enum { HEADER = 12, AT_A = 4, AT_B = 8 };

static double number_at(const unsigned char *at) {
    return (double)dp_float32((uint32_t)at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24);
}

/* A = q (q + 1) and B = 1 - A/most: of a quantization and a largest depth that somebody may have asked for. */
static bool are_set(double a, double b) {
    const double most = a / (1 - b);
    return a >= 1 && a <= 1e9 && b < 1 && most >= 1e-3 && most <= 1e6;
}

static bool to_metres(image_source *source, image *out, double a, double b) {
    const size_t count = (size_t)out->width * out->height;
    const uint16_t *samples = out->data;
    float *metres = malloc(count * sizeof *metres);
    if (metres == NULL)
        return source_fail(source, "out of memory");
    for (size_t i = 0; i < count; i++)
        metres[i] = samples[i] > 0 ? (float)(a / (samples[i] - b)) : NAN;
    free(out->data);
    out->data = metres;
    out->type = IMAGE_F32;
    snprintf(out->note, sizeof out->note, "product=depth metric=1m lattice=inverse:%.9g,%.9g", a, b);
    return true;
}

static bool read_ros(image_source *source, image *out) {
    unsigned char header[HEADER];
    if (!source_header(source, header, sizeof header) || !image_kind_png.read(source, out))
        return false;
    if (out->type != IMAGE_U16 || out->channels != 1)
        return source_fail(source, "compressedDepth must have one channel of u2, got %u of %s", out->channels,
                           image_type_name(out->type));
    const double a = number_at(header + AT_A), b = number_at(header + AT_B);
    if (are_set(a, b))
        return to_metres(source, out, a, b);
    snprintf(out->note, sizeof out->note, "product=depth metric=1mm");
    return true;
}

const image_kind image_kind_ros = {
    .name = "compressedDepth",
    .ending = "",
    .magic = {"\x89PNG\r\n\x1a\n"},
    .magic_at = HEADER,
    .magic_size = 8,
    .types = 1U << IMAGE_U16 | 1U << IMAGE_F32,
    .channels = 1U << 1,
    .read = read_ros,
};
