/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Triangles: the grids of coverage and depth, the rows of src/raster, and whether one of them predicts a scene. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/bits.h"
#include "probe/judge.h"
#include "raster/raster.h"

enum {
    ACROSS = SHOT_SIZE / PLAN_TILE,
    BITS_LEAST = 4,
    BITS_MOST = 10,
    GRIDS = BITS_MOST - BITS_LEAST + 2,
    ROWS_MAX = 16
};

/* Depths of a tile differ by the rounding of its plane, a few 2^-24, which is this much of a pixel where it is steep.
 */
static const double shift_error = 0x1p-13;

static int middle_of(int tile) {
    const int half = PLAN_TILE / 2;
    return (tile / ACROSS * PLAN_TILE + half) * SHOT_SIZE + tile % ACROSS * PLAN_TILE + half;
}

/* Whether moving by `at` shows as moved by `seen`, where nothing is snapped, or on the grids of 4 bits and more;
 * halfway between two points of the grid either will do. */
static bool moved(int grid, double at, double seen) {
    if (grid == 0)
        return fabs(seen - at) <= shift_error;
    const double steps = ldexp(at, BITS_LEAST + grid - 1), shown = ldexp(seen, BITS_LEAST + grid - 1);
    const double error = ldexp(shift_error, BITS_LEAST + grid - 1);
    return fabs(shown - rint(shown)) <= error && fabs(rint(shown) - steps) <= 0.5;
}

static void judge_plane(probe_result *r) {
    const shot *s = judge_shot(r, PLAN_PLANE, SHOT_D32F);
    guess all[GRIDS];
    if (s == NULL)
        return;
    judge_words(all, KEY_PLANE, 0, GRIDS);
    for (int g = 0; g < GRIDS; g++) {
        for (int i = 0; i < PLAN_TILES; i++) {
            const double depth = (double)dp_float32(s->code[middle_of(i)]);
            all[g].hits += moved(g, (double)i / PLAN_STEPS, (0.5 - depth) / (double)PLAN_STEEP);
        }
    }
    judge_guesses(r, KEY_PLANE, NULL, all, GRIDS, PLAN_TILES);
}

/* An edge covers the centre to its left once it is snapped to the right of it. */
static void judge_coverage(probe_result *r) {
    const shot *s = judge_shot(r, PLAN_COVERAGE, SHOT_D32F);
    guess all[GRIDS];
    if (s == NULL)
        return;
    judge_words(all, KEY_COVERAGE, 0, GRIDS);
    for (int g = 0; g < GRIDS; g++) {
        for (int i = 0; i < PLAN_TILES; i++) {
            const double at = plan_edge(i);
            const double half = g == 0 ? 0.0 : ldexp(0.5, -(BITS_LEAST + g - 1));
            const bool covered = s->code[middle_of(i)] != dp_bits32(SHOT_CLEAR);
            all[g].hits += at == half || covered == (at > half);
        }
    }
    judge_guesses(r, KEY_COVERAGE, NULL, all, GRIDS, PLAN_TILES);
}

/* ---- The rows ---------------------------------------------------------------------------------------------------- */

static bool predict(size_t row, const shot *s, uint32_t *code) {
    raster_target target;
    dp_format format[2];
    if (dp_format_parse(probe_format_name(s->format), format) != 1 ||
        raster_target_init(&target, row, SHOT_SIZE, SHOT_SIZE, &format[0], dp_path_best()) != RASTER_OK)
        return false;
    const uint32_t clear = dp_format_encode(&format[0], DP_ROUND_NEAREST, (double)SHOT_CLEAR);
    for (int i = 0; i < SHOT_PIXELS; i++)
        code[i] = clear;
    for (uint32_t i = 0; i + 2 < s->count; i += 3) {
        raster_vertex v[3];
        raster_triangle drawn;
        memcpy(v, s->vertex[i], sizeof v);
        for (int k = 0; k < 3; k++)
            v[k].z = judge_clip(s, s->vertex[i + (uint32_t)k]);
        if (raster_set_up(&target, v, &drawn) != RASTER_OK)
            continue;
        for (int p = 0; p < drawn.count; p++)
            for (int y = drawn.piece[p].y0, x0, x1; y < drawn.piece[p].y1; y++)
                if (raster_span(&target, &drawn.piece[p], y, &x0, &x1))
                    raster_codes(&target, &drawn.piece[p], y, x0, x1, &code[y * SHOT_SIZE + x0]);
    }
    return true;
}

/* Pixels as the row predicts them; none where it has not the format. */
static uint64_t hits_of(size_t row, const shot *s) {
    uint32_t *code = calloc(SHOT_PIXELS, sizeof *code);
    uint64_t hits = 0;
    if (code != NULL && predict(row, s, code))
        for (int i = 0; i < SHOT_PIXELS; i++)
            hits += code[i] == s->code[i];
    free(code);
    return hits;
}

/* The row that draws the scene in every format; null where none does. */
static const char *judge_rows(probe_result *r) {
    const char *found = NULL;
    bool one = true;
    for (int f = 0; f < SHOT_FORMATS; f++) {
        const shot *s = judge_shot(r, PLAN_SCENE, (shot_format)f);
        guess all[ROWS_MAX];
        size_t count = 0;
        for (size_t i = 0; s != NULL && raster_get(i) != NULL && count < ROWS_MAX; i++)
            if (raster_get(i)->model != NULL)
                all[count++] = (guess){raster_get(i)->name, hits_of(i, s)};
        if (s == NULL)
            continue;
        const int sure = judge_guesses(r, KEY_RASTERIZER, probe_format_name((shot_format)f), all, count, SHOT_PIXELS);
        const char *here = sure == JUDGE_NONE ? NULL : all[sure].words;
        one = one && here != NULL && (found == NULL || found == here);
        found = here;
    }
    return one ? found : NULL;
}

static void judge_prediction(probe_result *r, const char *row) {
    size_t index = 0, drawing = 0;
    while (raster_get(index) != NULL && raster_get(index)->name != row)
        drawing += raster_get(index++)->model != NULL;
    for (int f = 0; f < SHOT_FORMATS; f++) {
        const shot *s = judge_shot(r, PLAN_PREDICTED, (shot_format)f);
        if (s == NULL)
            continue;
        const uint64_t hits = hits_of(index, s);
        probe_finding *found =
            judge_say(r, KEY_PREDICTION, probe_format_name((shot_format)f),
                      hits == SHOT_PIXELS ? PROBE_SURE : PROBE_NO_ROW, "%s", probe_hypothesis(KEY_PREDICTION, drawing));
        found->cases = SHOT_PIXELS;
        found->hits = hits;
        if (hits != SHOT_PIXELS)
            r->raster = NULL;
    }
}

void judge_triangles(probe_result *r) {
    judge_coverage(r);
    judge_plane(r);
    r->raster = judge_rows(r);
    if (r->raster != NULL)
        judge_prediction(r, r->raster);
}
