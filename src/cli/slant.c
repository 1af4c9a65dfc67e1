/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/slant.h"

#include "report/number.h"

enum { DIGITS = 4 };

void slant_title(page *p, const dp_triangles *t, const dp_setup *setup) {
    if (t == NULL)
        return;
    if (setup->spec.model != DP_MODEL_FP32) {
        page_title(p, "%s is not affine on the screen: no guarantee at a slant",
                   dp_mapping_get(setup->spec.mapping)->name);
        return;
    }
    page_title(p, "viewport %dx%d, fov %s, %d subpixel bits, slant %s to %s degrees", t->width, t->height,
               number_of(t->fov_y, DIGITS).text, t->subpixel, number_full(t->slant_lo).text,
               number_full(t->slant_hi).text);
    page_title(p, "triangles from z/%s to %s z, at most %s pixels, no slimmer than 1:%s", number_full(t->depth).text,
               number_full(t->depth).text, number_full(t->pixels).text, number_full(t->slim).text);
}

const column slant_columns[] = {{FIELD(dp_triangles, width, "width", "")},
                                {FIELD(dp_triangles, height, "height", "")},
                                {FIELD(dp_triangles, fov_y, "fov", "degrees")},
                                {FIELD(dp_triangles, subpixel, "subpixel", "")},
                                {FIELD(dp_triangles, slant_lo, "slant_lo", "degrees")},
                                {FIELD(dp_triangles, slant_hi, "slant_hi", "degrees")},
                                {FIELD(dp_triangles, depth, "depth", "")},
                                {FIELD(dp_triangles, pixels, "pixels", "")},
                                {FIELD(dp_triangles, slim, "slim", "")},
                                {.kind = COLUMN_END}};
