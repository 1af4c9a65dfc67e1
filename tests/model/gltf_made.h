/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file gltf_made.h  glTF files put together by a test: JSON, and one buffer in a data URI. */
#ifndef TESTS_GLTF_MADE_H
#define TESTS_GLTF_MADE_H

#include "model/model.h"
#include "support.h"

enum { TEXT_SIZE = 1 << 16, BYTES_SIZE = 1 << 12 };

/** The binary data that grows, and the JSON beside it. */
typedef struct made {
    unsigned char bytes[BYTES_SIZE];
    size_t used;
    char json[TEXT_SIZE];
} made;

#define ASSET "{\"asset\":{\"version\":\"2.0\"},"

__attribute__((format(printf, 2, 3))) void add(made *f, const char *format, ...);
void put(made *f, uint32_t bits, int bytes);
void put_float(made *f, double x);

/** Five vertices (i, i i, 0) in binary32, 60 bytes. */
void put_five(made *f);

/** The buffer as it is now. */
void add_buffer(made *f);

bool read_made(const made *f, model_transforms kind, model *m, model_error *error);
void must_read(const made *f, model *m);

#endif
