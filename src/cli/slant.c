/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/slant.h"

#include "report/number.h"

enum { DIGITS = 4 };

void slant_title(page *p, const dp_triangles *t) {
    if (t == NULL)
        return;
    page_title(p, "viewport %dx%d, fov %s, %d subpixel bits, slant %s to %s degrees", t->width, t->height,
               number_of(t->fov_y, DIGITS).text, t->subpixel, number_of(t->slant_lo, DIGITS).text,
               number_of(t->slant_hi, DIGITS).text);
    page_title(p, "triangles from z/%s to %s z, at most %s pixels, no slimmer than 1:%s",
               number_of(t->depth, DIGITS).text, number_of(t->depth, DIGITS).text, number_of(t->pixels, DIGITS).text,
               number_of(t->slim, DIGITS).text);
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
