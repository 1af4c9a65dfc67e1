/* SPDX-License-Identifier: GPL-3.0-or-later */
/* PNG as anybody might mangle it, alone and behind the header of compressedDepth, and the same with its checksums put
 * right, so that more than they are tried. */
#include "image_input.h"

static uint32_t crc(const uint8_t *at, size_t size) {
    uint32_t sum = UINT32_MAX;
    for (size_t i = 0; i < size; i++) {
        sum ^= at[i];
        for (int bit = 0; bit < 8; bit++)
            sum = sum >> 1 ^ (0xEDB88320U & -(sum & 1U));
    }
    return ~sum;
}

static void put_right(uint8_t *data, size_t size) {
    for (size_t at = 8; size - at >= 12;) {
        const uint32_t length =
            (uint32_t)data[at] << 24 | (uint32_t)data[at + 1] << 16 | (uint32_t)data[at + 2] << 8 | data[at + 3];
        if (length > size - at - 12)
            return;
        const uint32_t sum = crc(data + at + 4, length + 4);
        at += 8 + (size_t)length;
        for (int i = 0; i < 4; i++)
            data[at++] = (uint8_t)(sum >> (24 - 8 * i));
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    enum { HEADER = 12 };
    const size_t at = size > HEADER && memcmp(data, "\x89PNG", 4) != 0 ? HEADER : 0;
    const image_file file = at > 0 ? IMAGE_ROS : IMAGE_PNG;
    if (size < at + 8 || memcmp(data + at, "\x89PNG\r\n\x1a\n", 8) != 0)
        return 0;
    use_image(data, size, file);
    uint8_t *copy = malloc(size);
    if (copy == NULL)
        return 0;
    memcpy(copy, data, size);
    put_right(copy + at, size - at);
    use_image(copy, size, file);
    free(copy);
    return 0;
}
