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

void clipping_say(const dp_setup *setup, double znear, double zfar, const char *rest) {
    char label[SETUP_LABEL_SIZE];
    setup_label(setup, false, label);
    if (isnan(znear))
        fprintf(stderr, "depthprec: warning: %s: clipping in binary32 loses everything\n", label);
    else
        fprintf(stderr, "depthprec: warning: %s: clipping in binary32 keeps only %s to %s%s\n", label,
                number_of(znear, 9).text, number_of(zfar, 9).text, rest);
}

void clipping_warn(const setups *all) {
    for (size_t i = 0; i < all->count; i++) {
        const clipping c = clipping_of(&all->items[i]);
        if (c.loses)
            clipping_say(&all->items[i], c.znear, c.zfar, "");
    }
}
