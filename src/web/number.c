/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers of a figure as the page shows them, and places on its axes. */
#include <stdio.h>
#include <stdlib.h>

#include "core/elementary.h"
#include "report/number.h"
#include "web/page.h"

/** Prints a number of a figure: rounded up (1), down (-1) or to the nearest (0). */
PAGE_EXPORT("number") void number_say(double value, int way) {
    enum { SHOWN = 4 };
    printf("%s", (way > 0   ? number_up(value, SHOWN)
                  : way < 0 ? number_down(value, SHOWN)
                            : number_of(value, SHOWN))
                     .text);
    fflush(NULL);
}

/** Prints a number of three digits, as near to a share of an axis as they allow, on it. */
PAGE_EXPORT("number_at") void number_at(double lo, double hi, int logarithmic, double share) {
    const double at = logarithmic != 0 ? lo * dp_pow(hi / lo, share) : lo + share * (hi - lo);
    const number_text near = number_brief(number_of(at, 3));
    const double value = strtod(near.text, NULL);
    printf("%s", value < lo ? number_full(lo).text : value > hi ? number_full(hi).text : near.text);
    fflush(NULL);
}
