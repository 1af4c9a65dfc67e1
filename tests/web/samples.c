/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * What the library gives at random depths of random cameras, in every mapping, format and arithmetic, as digests of the
 * bits: one line for each. Built for this processor and for WebAssembly they print the same; see web.sh.
 *
 *     samples BLOCKS [WHICH]    DEPTHS depths for each camera; WHICH prints what block WHICH gives instead, in full
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "core/bits.h"
#include "depthprec/depthprec.h"

enum { DEPTHS = 50, ARITHS = 16, FORMATS = 6 };

static const char *const formats[FORMATS] = {"fp16", "fp32", "unorm16", "unorm24", "unorm32", "float3.3b5"};

typedef struct digest {
    uint64_t sum;
    int shown;
} digest;

/* Every NaN is one: their signs are the processor's. */
static void add(digest *d, double x) {
    const uint64_t bits = isnan(x) ? UINT64_MAX : dp_bits64(x);
    d->sum = dp_mixed64(d->sum ^ bits);
    if (d->shown)
        printf("%a\n", x);
}

static double unit(uint64_t *draws) {
    return dp_uniform(dp_draw64(1, (*draws)++));
}

/* A power of two times 1 to 2, exact in any library */
static double scale(uint64_t *draws, double lo, double hi) {
    const double exponent = floor(lo + (hi - lo) * unit(draws));
    return ldexp(1.0 + unit(draws), (int)exponent);
}

static dp_spec camera(uint64_t *draws, uint64_t block, size_t *arith) {
    dp_spec spec = dp_spec_default();
    spec.mapping = (dp_mapping)(block % DP_MAPPING_COUNT);
    block /= DP_MAPPING_COUNT;
    dp_format found[2];
    if (dp_format_parse(formats[block % FORMATS], found) > 0)
        spec.format = found[0];
    block /= FORMATS;
    *arith = block % (dp_arith_count() + 2); /* exact, staged, and each arithmetic of fp32 */
    spec.model = *arith < 2 ? (dp_model)*arith : DP_MODEL_FLOAT;
    spec.arith = *arith < 2 ? 0 : *arith - 2;
    spec.rounding = (dp_rounding)((int)(unit(draws) * DP_ROUNDING_COUNT));
    spec.znear = scale(draws, -10.0, 3.0);
    spec.zfar = spec.znear * (1.0 + scale(draws, -3.0, 20.0));
    spec.log_c = scale(draws, -10.0, 10.0);
    spec.ortho = unit(draws) < 0.2;
    if (spec.ortho && unit(draws) < 0.5)
        spec.znear = -spec.znear;
    if (unit(draws) < 0.3) {
        spec.triangles = dp_triangles_default();
        spec.triangles.fov_y = 10.0 + 150.0 * unit(draws);
        spec.triangles.slant_hi = 90.0 * unit(draws);
    }
    return spec;
}

static void add_depth(digest *d, const dp_setup *setup, double z) {
    dp_sample s;
    if (dp_sample_at(setup, z, &s) == DP_OK) {
        const double values[] = {s.depth, s.stored, s.error, s.lo, s.hi, s.interval, s.separation, (double)s.code};
        for (size_t i = 0; i < sizeof values / sizeof values[0]; i++)
            add(d, values[i]);
        add(d, dp_eye(setup, s.depth, 1.0 - s.depth));
    }
    dp_budget b;
    if (dp_budget_at(setup, z, NULL, &b) == DP_OK)
        for (int i = 0; i < DP_CAUSE_COUNT; i++)
            add(d, b.cause[i]);
    dp_vertex_error e;
    if (dp_vertex_error_at(setup, z, 2.0, &e) == DP_OK) {
        add(d, e.eye);
        add(d, e.window);
    }
}

static void add_block(digest *d, uint64_t block, size_t *row) {
    uint64_t draws = block << 20;
    size_t arith;
    const dp_spec spec = camera(&draws, block, &arith);
    *row = ((size_t)spec.mapping * FORMATS + block / DP_MAPPING_COUNT % FORMATS) * ARITHS + arith;
    dp_setup setup;
    const dp_status status = dp_setup_init(&setup, &spec);
    add(d, (double)status);
    if (status != DP_OK)
        return;
    for (int i = 0; i < DEPTHS; i++) {
        const double share = unit(&draws);
        const double z =
            i % 2 ? spec.znear + (spec.zfar - spec.znear) * share * share * share : dp_eye(&setup, share, 1.0 - share);
        add_depth(d, &setup, fmin(fmax(z, spec.znear), spec.zfar));
    }
    dp_worst w;
    if (dp_worst_over(&setup, spec.znear, spec.zfar, &w) == DP_OK) {
        add(d, w.error);
        add(d, w.interval_lo);
        add(d, w.interval);
    }
}

int main(int argc, char **argv) {
    static digest rows[DP_MAPPING_COUNT * FORMATS * ARITHS];
    size_t row;
    if (argc > 2) {
        digest d = {0, 1};
        add_block(&d, strtoull(argv[2], NULL, 10), &row);
        return 0;
    }
    if (dp_arith_count() + 2 > ARITHS)
        return 1;
    const uint64_t blocks = argc > 1 ? strtoull(argv[1], NULL, 10) : 1;
    for (uint64_t i = 0; i < blocks; i++) {
        digest d = {0, 0};
        add_block(&d, i, &row);
        rows[row].sum = dp_mixed64(rows[row].sum ^ d.sum);
        rows[row].shown = 1;
    }
    for (row = 0; row < sizeof rows / sizeof rows[0]; row++)
        if (rows[row].shown)
            printf("%s %s %s %016llx\n", dp_mapping_get((dp_mapping)(row / ARITHS / FORMATS))->name,
                   formats[row / ARITHS % FORMATS],
                   row % ARITHS < 2 ? dp_model_name((dp_model)(row % ARITHS)) : dp_arith_get(row % ARITHS - 2)->name,
                   (unsigned long long)rows[row].sum);
    return 0;
}
