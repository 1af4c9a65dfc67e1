/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file predicted.h  What a model of src/raster makes of the triangles of a shot. */
#ifndef TESTS_PREDICTED_H
#define TESTS_PREDICTED_H

#include "probe/probe.h"
#include "raster_named.h"

/** The codes of a shot as that rasterizer draws it, with the shot's range of depth. */
static inline void predict(const char *rasterizer, const shot *s, uint32_t *code) {
    raster_target target = target_of(rasterizer, probe_format_name(s->format), SHOT_SIZE, SHOT_SIZE, dp_path_best());
    const uint32_t clear = dp_format_encode(&target.format, DP_ROUND_NEAREST, (double)SHOT_CLEAR);
    raster_target_range(&target, s->range[0], shot_range_end(s));
    for (int i = 0; i < SHOT_PIXELS; i++)
        code[i] = clear;
    for (uint32_t i = 0; i + 2 < s->count; i += 3) {
        raster_vertex v[3];
        raster_triangle drawn;
        memcpy(v, s->vertex[i], sizeof v);
        if (raster_set_up(&target, v, &drawn) != RASTER_OK)
            continue;
        for (int p = 0; p < drawn.count; p++)
            for (int y = drawn.piece[p].y0, x0, x1; y < drawn.piece[p].y1; y++)
                if (raster_span(&target, &drawn.piece[p], y, &x0, &x1))
                    raster_codes(&target, &drawn.piece[p], y, x0, x1, &code[y * SHOT_SIZE + x0]);
    }
}

#endif
