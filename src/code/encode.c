/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Encoders by the rounding that is asked for: those that are measured round to nearest; others are printed alone. */
#include "code/code.h"
#include "method/bound.h"

#define ANY (METHOD_INFINITE | METHOD_ORTHO)

static const bound_steps even_steps = {.constants = {"M = most", "M = most"},
                                       .steps = {"k = whole(even(d*M))", "k = whole(even(d*M))"}};
static const bound_steps cut_steps = {.constants = {"M = most", "M = most"},
                                      .steps = {"k = whole(d*M)", "k = whole(d*M)"}};
static const bound_steps cut_double_steps = {
    .wide = true, .constants = {"M = most", "M = most"}, .steps = {"k = whole(d*M)", "k = whole(d*M)"}};

/* The claims are those of rint and floor-double where a truncated code is off by up to a step, not half of one. */
/* clang-format off */
static const method_row evens[] = {
    {METHOD_ENCODE, "rint", "UNORM: fl(d M) in binary32, ties to even",
     {NOWHERE, FULL(0.5 + 0x1p-9), FULL(0.75)}, ANY, 0.4, "1", 0, "", .bound = &even_steps}};
static const method_row cuts[] = {
    {METHOD_ENCODE, "truncate", "UNORM: fl(d M) in binary32, truncated",
     {NOWHERE, FULL(1 + 0x1p-9), FULL(1.25)}, ANY, 0.25, "1", 0, "", .bound = &cut_steps},
    {METHOD_ENCODE, "truncate-double", "UNORM: d M in double, which is exact, truncated: the right code",
     {NOWHERE, FULL(1), FULL(1)}, ANY, 0.6, "1", 0, "", .bound = &cut_double_steps}};
/* clang-format on */
static const size_t even_count = sizeof evens / sizeof evens[0], cut_count = sizeof cuts / sizeof cuts[0];

static const method_family_row families[] = {
    [DP_ROUND_EVEN] = {.name = "encode", .methods = evens, .method_count = &even_count},
    [DP_ROUND_ZERO] = {.name = "encode", .methods = cuts, .method_count = &cut_count},
};

const method_family_row *code_encoders(dp_rounding rounding) {
    return rounding == DP_ROUND_EVEN || rounding == DP_ROUND_ZERO ? &families[rounding] : &encode_family;
}
