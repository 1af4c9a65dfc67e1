/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file raster_named.h  Rasterizers by name, for the tests. */
#ifndef TESTS_RASTER_NAMED_H
#define TESTS_RASTER_NAMED_H

#include <string.h>

#include "raster/raster.h"
#include "support.h"

/** The target that a rasterizer draws into; fails the test when it cannot. */
static inline raster_target target_of(const char *name, const char *format, int width, int height, dp_path path) {
    raster_target target;
    dp_format formats[2];
    size_t row = 0;
    while (row < raster_table.count && strcmp(raster_get(row)->name, name) != 0)
        row++;
    assert_int_equal(dp_format_parse(format, formats), 1);
    assert_int_equal(raster_target_init(&target, row, width, height, formats, path), RASTER_OK);
    return target;
}

#endif
