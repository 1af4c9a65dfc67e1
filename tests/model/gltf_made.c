/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "gltf_made.h"

#include <stdio.h>
#include <string.h>

void add(made *f, const char *format, ...) {
    const size_t used = strlen(f->json);
    va_list arguments;
    va_start(arguments, format);
    const int size = vsnprintf(f->json + used, sizeof f->json - used, format, arguments);
    va_end(arguments);
    assert_true(size >= 0 && (size_t)size < sizeof f->json - used);
}

void put(made *f, uint32_t bits, int bytes) {
    for (int i = 0; i < bytes; i++)
        f->bytes[f->used++] = (unsigned char)(bits >> 8 * i);
}

void put_float(made *f, double x) {
    const float single = (float)x;
    uint32_t bits;
    memcpy(&bits, &single, sizeof bits);
    put(f, bits, 4);
}

void add_buffer(made *f) {
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    add(f, "\"buffers\":[{\"byteLength\":%zu,\"uri\":\"data:application/octet-stream;base64,", f->used);
    for (size_t i = 0; i < f->used; i += 3) {
        const size_t left = f->used - i;
        const uint32_t word = (uint32_t)f->bytes[i] << 16 | (left > 1 ? (uint32_t)f->bytes[i + 1] << 8 : 0) |
                              (left > 2 ? f->bytes[i + 2] : 0U);
        add(f, "%c%c%c%c", digits[word >> 18], digits[word >> 12 & 63], left > 1 ? digits[word >> 6 & 63] : '=',
            left > 2 ? digits[word & 63] : '=');
    }
    add(f, "\"}]");
}

bool read_made(const made *f, model_transforms kind, model *m, model_error *error) {
    const model_asked asked = {.transforms = kind};
    return model_parse(f->json, strlen(f->json), false, NULL, &asked, m, error);
}

void must_read(const made *f, model *m) {
    model_error error;
    if (!read_made(f, MODEL_EXACT, m, &error))
        fail_msg("%s", error.text);
}

void put_five(made *f) {
    for (int i = 0; i < 5; i++) {
        put_float(f, i);
        put_float(f, i * i);
        put_float(f, 0);
    }
}
