/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "quantity/cmd_table/reach.h"

#include <math.h>

#include "core/append.h"

void reach_find(const dp_setup *full, const dp_setup *any_slant, const unit_row *unit, const in_preset *p,
                reached *out) {
    double facing[RESOLVED_LIMITS], slanted[RESOLVED_LIMITS] = {(double)NAN, (double)NAN, (double)NAN};
    resolved_up_to(full, unit, facing);
    if (any_slant != NULL)
        resolved_up_to(any_slant, unit, slanted);
    *out = (reached){.zfar = full->spec.zfar, .unit = unit};
    for (size_t i = 0; i < RESOLVED_LIMITS; i++)
        out->of[i] = (reach){resolved_limit(i, unit), facing[i], slanted[i], p->from[i], p->to[i]};
}

/* "1 mm up to z = 31.9 m, 1 cm up to the far plane"; a separation wider than one that holds everywhere goes without
 * saying. @return out, "" where nothing is guaranteed */
static const char *reach_text(const reached *r, bool facing, char out[RESOLVED_TEXT_SIZE]) {
    char text[RESOLVED_TEXT_SIZE];
    double up_to = (double)NAN;
    *out = '\0';
    for (size_t i = 0; i < RESOLVED_LIMITS && !(up_to >= r->zfar); i++) {
        up_to = facing ? r->of[i].facing : r->of[i].any_slant;
        if (!isnan(up_to))
            append(out, RESOLVED_TEXT_SIZE, "%s %s up to %s%s", *out != '\0' ? "," : "",
                   resolved_limit_text(i, r->unit).text, up_to < r->zfar ? "z = " : "",
                   resolved_text(r->zfar, up_to, r->unit, text));
    }
    return out;
}

void reach_say(page *p, const reached *r, bool facing, const char *which, const char *begin) {
    char said[RESOLVED_TEXT_SIZE];
    if (*reach_text(r, facing, said) != '\0')
        page_text(p, "%s%s:%s.", begin != NULL ? "" : "Guaranteed to be resolved ", begin != NULL ? begin : which,
                  said);
    else
        page_text(p, "%s is not guaranteed to be resolved %s, even at the near plane.",
                  resolved_limit_text(RESOLVED_LIMITS - 1, r->unit).text, which);
}
