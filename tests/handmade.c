/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "handmade.h"

#include "support.h"

void handmade_bytes(handmade *h, const void *bytes, size_t size) {
    assert_true(size <= HANDMADE_SIZE - h->size);
    if (size > 0)
        memcpy(h->at + h->size, bytes, size);
    h->size += size;
}

void handmade_text(handmade *h, const char *text) {
    handmade_bytes(h, text, strlen(text));
}

void handmade_number(handmade *h, uint64_t number, int size, int little) {
    for (int i = 0; i < size; i++) {
        const unsigned char byte = (unsigned char)(number >> 8 * (little ? i : size - 1 - i));
        handmade_bytes(h, &byte, 1);
    }
}

void handmade_npy(handmade *h, int version, const char *header) {
    handmade_bytes(h, "\x93NUMPY", 6);
    handmade_number(h, (uint64_t)version, 2, 1);
    handmade_number(h, strlen(header) + 1, version == 1 ? 2 : 4, 1);
    handmade_text(h, header);
    handmade_text(h, "\n");
}

void handmade_dds(handmade *h, uint32_t width, uint32_t height, const handmade_dds_of *of) {
    const uint32_t words[31] = {[0] = 124,
                                [1] = 0x1007,
                                [2] = height,
                                [3] = width,
                                [18] = 32,
                                [19] = of->dxgi != 0 ? 4 : of->flags,
                                [20] = of->dxgi != 0 ? 0x30315844 : of->fourcc,
                                [21] = of->bits,
                                [22] = of->masks[0],
                                [23] = of->masks[1],
                                [24] = of->masks[2],
                                [25] = of->masks[3],
                                [26] = 0x1000};
    const uint32_t more[5] = {of->dxgi, 3, 0, 1, 0};
    handmade_text(h, "DDS ");
    for (int i = 0; i < 31; i++)
        handmade_number(h, words[i], 4, 1);
    for (int i = 0; i < 5 && of->dxgi != 0; i++)
        handmade_number(h, more[i], 4, 1);
}

/* ISO 3309, the polynomial 0xEDB88320 bit by bit. */
static uint32_t crc(const unsigned char *at, size_t size) {
    uint32_t sum = UINT32_MAX;
    for (size_t i = 0; i < size; i++) {
        sum ^= at[i];
        for (int bit = 0; bit < 8; bit++)
            sum = sum >> 1 ^ (0xEDB88320U & -(sum & 1U));
    }
    return ~sum;
}

/* RFC 1950. */
static uint32_t adler(const unsigned char *at, size_t size) {
    uint32_t a = 1, b = 0;
    for (size_t i = 0; i < size; i++) {
        a = (a + at[i]) % 65521;
        b = (b + a) % 65521;
    }
    return b << 16 | a;
}

void handmade_chunk(handmade *h, const char *type, const void *data, size_t size) {
    handmade_number(h, size, 4, 0);
    const size_t from = h->size;
    handmade_text(h, type);
    handmade_bytes(h, data, size);
    handmade_number(h, crc(h->at + from, h->size - from), 4, 0);
}

void handmade_ihdr(handmade *h, uint32_t width, uint32_t height, int bits, int colour, int interlace) {
    handmade header = {.size = 0};
    handmade_number(&header, width, 4, 0);
    handmade_number(&header, height, 4, 0);
    handmade_number(&header, (uint64_t)bits, 1, 0);
    handmade_number(&header, (uint64_t)colour, 1, 0);
    handmade_number(&header, (uint64_t)interlace, 3, 0); /* compression and filter are 0 */
    handmade_bytes(h, "\x89PNG\r\n\x1a\n", 8);
    handmade_chunk(h, "IHDR", header.at, header.size);
}

void handmade_zlib(handmade *h, const handmade *bytes) {
    handmade_number(h, 0x7801, 2, 0);
    handmade_number(h, 1, 1, 0); /* the last block, stored */
    handmade_number(h, bytes->size, 2, 1);
    handmade_number(h, ~(uint64_t)bytes->size, 2, 1);
    handmade_bytes(h, bytes->at, bytes->size);
    handmade_number(h, adler(bytes->at, bytes->size), 4, 0);
}

void handmade_idat(handmade *h, const handmade *rows) {
    handmade data = {.size = 0};
    handmade_zlib(&data, rows);
    handmade_chunk(h, "IDAT", data.at, data.size);
}

void handmade_png(handmade *h, uint32_t width, uint32_t height, int bits, int colour, int interlace, size_t pixel,
                  const unsigned char *pixels) {
    static const struct {
        uint32_t x, y, dx, dy;
    } plain = {0, 0, 1, 1},
      adam[7] = {{0, 0, 8, 8}, {4, 0, 8, 8}, {0, 4, 4, 8}, {2, 0, 4, 4}, {0, 2, 2, 4}, {1, 0, 2, 2}, {0, 1, 1, 2}};
    handmade rows = {.size = 0};
    for (int pass = 0; pass < (interlace ? 7 : 1); pass++) {
        const __typeof__(plain) p = interlace ? adam[pass] : plain;
        for (uint32_t y = p.y; y < height && p.x < width; y += p.dy) {
            handmade_number(&rows, 0, 1, 0);
            for (uint32_t x = p.x; x < width; x += p.dx)
                handmade_bytes(&rows, pixels + (y * width + x) * pixel, pixel);
        }
    }
    handmade_ihdr(h, width, height, bits, colour, interlace);
    handmade_idat(h, &rows);
    handmade_chunk(h, "IEND", NULL, 0);
}
