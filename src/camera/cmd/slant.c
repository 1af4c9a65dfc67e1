/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "camera/cmd/slant.h"

#include <stdio.h>

#include "core/append.h"

enum { DIGITS = 4 };

/* Its grid, how it sets up depth, and the arithmetic of its vertices and conversions. */
static void say_rasterizer(page *p, slant_line *line, const raster_row *row, int bits, const char *arith) {
    const dp_anchor_row *anchor = dp_anchor_get(row->anchor);
    char grid[64];
    if (bits == 0)
        snprintf(grid, sizeof grid, "depth from unsnapped vertices");
    else
        snprintf(grid, sizeof grid, "%s%d subpixel bits", row->at_least ? "at least " : "", bits);
    line(p, "%s: %s, %s%s, arithmetic %s", row->name, grid,
         anchor != NULL ? "anchor " : "any anchor: the worst is counted", anchor != NULL ? anchor->name : "", arith);
}

void slant_say(page *p, slant_line *line, const camera_asked *c, const dp_setup *setup) {
    const dp_triangles *t = &c->triangles;
    const bool theirs = setup == NULL && c->preset_count > 1; /* each has its own view and rasterizer */
    const char *const arith = dp_arith_get(setup != NULL ? setup->spec.arith : c->arith)->name;
    char view[128] = "";
    if (t->width == 0)
        return;
    if (setup != NULL && setup->spec.model != DP_MODEL_FLOAT) {
        line(p, "%s is not affine on the screen: no guarantee at a slant", dp_mapping_get(setup->spec.mapping)->name);
        return;
    }
    if (!theirs)
        append(view, sizeof view, " fov %s,", number_of(t->fov_y, DIGITS).text);
    if (!theirs && c->raster == NULL)
        append(view, sizeof view, " %d subpixel bits,", t->subpixel);
    append(view, sizeof view, " slant %s", number_full(t->slant_lo).text);
    if (t->slant_lo < t->slant_hi)
        append(view, sizeof view, " to %s", number_full(t->slant_hi).text);
    line(p, "viewport %dx%d,%s degrees%s%s", t->width, t->height, view, c->raster == NULL ? ", " : "",
         c->raster == NULL ? arith : "");
    if (!theirs && c->raster != NULL)
        say_rasterizer(p, line, c->raster, t->subpixel, arith);
    if (c->matrix.covered)
        line(p, "that view of square pixels holds the one of --matrix, which is not centred, or has none");
    line(p, "triangles from z/%s to %s z, at most %s pixels, aspect ratio at most %s:1", number_full(t->depth).text,
         number_full(t->depth).text, number_full(t->pixels).text, number_up(t->slim, DIGITS).text);
}

const char *slant_assumed(const dp_triangles *t, char out[SLANT_ASSUMED_SIZE]) {
    snprintf(out, SLANT_ASSUMED_SIZE, "%dx%d, fov %s", t->width, t->height, number_of(t->fov_y, DIGITS).text);
    if (t->subpixel > 0)
        append(out, SLANT_ASSUMED_SIZE, ", %d subpixel bits", t->subpixel);
    return out;
}

const slant_fields *slant_fields_of(const camera_asked *c, slant_fields *out) {
    if (c->triangles.width == 0)
        return NULL;
    *out = (slant_fields){c->triangles, c->raster != NULL ? c->raster->name : NULL, dp_arith_get(c->arith)->name};
    return out;
}

const column slant_columns[] = {{FIELD(slant_fields, triangles.width, "width", "")},
                                {FIELD(slant_fields, triangles.height, "height", "")},
                                {FIELD(slant_fields, triangles.fov_y, "fov", "degrees")},
                                {FIELD(slant_fields, raster, "raster", "")},
                                {FIELD(slant_fields, arith, "arith", "")},
                                {FIELD(slant_fields, triangles.subpixel, "subpixel", "")},
                                {FIELD(slant_fields, triangles.slant_lo, "slant_lo", "degrees")},
                                {FIELD(slant_fields, triangles.slant_hi, "slant_hi", "degrees")},
                                {FIELD(slant_fields, triangles.depth, "depth", "")},
                                {FIELD(slant_fields, triangles.pixels, "pixels", "")},
                                {FIELD(slant_fields, triangles.slim, "slim", "")},
                                {.kind = COLUMN_END}};

const column slant_view_columns[] = {{FIELD(dp_triangles, width, "width", "")},
                                     {FIELD(dp_triangles, height, "height", "")},
                                     {FIELD(dp_triangles, fov_y, "fov", "degrees")},
                                     {FIELD(dp_triangles, subpixel, "subpixel", "")},
                                     {.kind = COLUMN_END}};
