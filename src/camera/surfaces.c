/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "camera/surfaces.h"

#include <stdio.h>

enum { DIGITS = 4 };

bool surfaces_any_slant(const dp_triangles *t) {
    return t->slant_lo == 0.0 && t->slant_hi == 90.0;
}

surfaces_text surfaces_words(const dp_triangles *t) {
    surfaces_text out = {"any slant"};
    if (t->width == 0)
        return (surfaces_text){"facing"};
    if (t->slant_lo == t->slant_hi)
        snprintf(out.text, sizeof out.text, "%.*g degrees", DIGITS, t->slant_lo);
    else if (!surfaces_any_slant(t))
        snprintf(out.text, sizeof out.text, "%.*g to %.*g degrees", DIGITS, t->slant_lo, DIGITS, t->slant_hi);
    return out;
}
