/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Projection matrices as anybody might mangle them: each is refused with a sentence, or its scales and slopes are
 * numbers that a camera can have; whether its planes are, the library's door says. Nine bytes an entry, for bytes alone
 * seldom make a row that says 0 0 1 0.
 */
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "depthprec/projection.h"

enum { ENTRIES = 16, BYTES = 9 };

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void demand(int truth) {
    if (!truth)
        abort();
}

static double entry(const uint8_t *from) {
    static const double common[] = {0, 1, -1, 0.1, -0.2, 1.002, -1.05, 1000};
    double any;
    memcpy(&any, from + 1, sizeof any);
    return from[0] < 8 * 16 ? common[from[0] % 8] : any;
}

static void use(const dp_projection *p) {
    for (int k = 0; k < 2; k++)
        demand(p->scale[k] > 0 && isfinite(p->half[k]) && isfinite(p->centre[k]) && isfinite(p->tilt[k]));
    demand(isfinite(p->znear) && (p->ortho ? isfinite(p->zfar) : p->znear > 0) && !(p->ortho && p->oblique));
    demand(p->oblique || (p->tilt[0] == 0 && p->tilt[1] == 0));
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    double m[ENTRIES];
    dp_matrix_fault why = {0};
    dp_projection p;
    if (size < (size_t)ENTRIES * BYTES + 1)
        return 0;
    for (int i = 0; i < ENTRIES; i++)
        m[i] = entry(data + 1 + (size_t)i * BYTES);
    if (dp_projection_init(&p, m, (data[0] & 1) != 0, (data[0] & 2) != 0, &why) == DP_OK)
        use(&p);
    else
        demand(why.rule != NULL && why.rule[0] != '\0');
    const dp_status found =
        dp_projection_find(&p, m, (dp_layout)(data[0] >> 2 & 3), (dp_mapping)(data[0] >> 4 & 7), &why);
    if (found == DP_OK)
        use(&p);
    demand(!(found == DP_OK && p.oblique));
    return 0;
}
