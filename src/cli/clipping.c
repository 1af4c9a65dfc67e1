/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/clipping.h"

#include <math.h>
#include <stdio.h>

#include "report/number.h"

clipping clipping_of(const dp_setup *setup) {
    dp_pipeline p;
    float znear;
    float zfar;
    if (setup->spec.model != DP_MODEL_FP32 || dp_pipeline_init(&p, setup) != DP_OK)
        return (clipping){(double)NAN, (double)NAN, false};
    dp_pipeline_planes(&p, &znear, &zfar);
    return (clipping){(double)znear, (double)zfar, !(znear == p.znear && zfar == p.zfar)};
}

static void warn(const dp_setup *setup, const clipping *c) {
    char label[SETUP_LABEL_SIZE];
    char from[NUMBER_SIZE];
    char to[NUMBER_SIZE];
    if (!c->loses)
        return;
    setup_label(setup, false, label);
    number_digits(c->znear, 9, from);
    number_digits(c->zfar, 9, to);
    if (isnan(c->znear))
        fprintf(stderr, "depthprec: warning: %s: clipping in binary32 loses everything\n", label);
    else
        fprintf(stderr, "depthprec: warning: %s: clipping in binary32 keeps only %s to %s\n", label, from, to);
}

void clipping_warn(const setups *all) {
    for (size_t i = 0; i < all->count; i++) {
        clipping c = clipping_of(&all->items[i]);
        warn(&all->items[i], &c);
    }
}
