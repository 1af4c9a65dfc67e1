/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "probe/hypotheses.h"

#include <stdio.h>

#include "raster/raster.h"

enum { WORDS_MAX = 12 };

#define N_OF(what) ", 2^n the power of two at or below " what
#define DIFFERENT  "r = 2^(n-23)" N_OF("the anchor's depth and the others' differences from it")

/* A profile in a link is written by the places of these: a further hypothesis comes last. */
static const struct {
    const char *name, *words[WORDS_MAX];
} keys[PROBE_KEYS] = {
    [KEY_STORED] = {"stored",
                    {"every bit of binary32", "codes of that many bits, nothing finer",
                     "finer than its codes: depths of one code are distinguished",
                     "neither its codes nor finer ones throughout"}},
    [KEY_ROUNDING] = {"rounding",
                      {"the exact d (2^N - 1), to nearest", "the binary32 product d (2^N - 1), to nearest even",
                       "the binary32 product d (2^N - 1), truncated", "2^N d less d, both cut to sixteenths",
                       "the exact d (2^N - 1), truncated", "the binary32 product d (2^N - 1) plus 1/2, truncated"}},
    [KEY_DIVISION] = {"division",
                      {"clip z / w, rounded once", "clip z times the rounded 1 / w",
                       "clip z times NVIDIA's 1 / w", [DIVISION_SIGNED] = "(clip z + w)/2 / w, each rounded",
                       "(clip z + w)/2 times the rounded 1 / w", "(clip z + w)/2 times NVIDIA's 1 / w",
                       "clip z / w, rounded once, then times 1/2, plus 1/2",
                       "clip z times the rounded 1 / w, then times 1/2, plus 1/2",
                       "clip z times NVIDIA's 1 / w, then times 1/2, plus 1/2"}},
    [KEY_PROJECTION] = {"projection", {"A z, then + B, each rounded", "A z + B fused, rounded once"}},
    [KEY_CLIPPING] = {"clipping",
                      {"drawn where 0 <= z <= w, exactly", "drawn where 0 < z <= w", "drawn where 0 <= z < w",
                       "drawn everywhere, clamped"}},
    [KEY_SUBNORMAL] = {"subnormal", {"kept", "flushed to zero", "not drawn"}},
    [KEY_INVARIANCE] = {"invariance",
                        {"two pipelines of one expression store the same depths",
                         "two pipelines of one expression store other depths",
                         "the device does not count how many depths are the same"}},
    [KEY_LOG2] = {"log2",
                  {"x in [1, 2], absolute; Vulkan allows 2^-21 = 4.8e-07", "x in [2, 2^64]; Vulkan allows 3 ulp"}},
    [KEY_QUOTIENT] = {"quotient", {"x / y in a shader; Vulkan allows 2.5 ulp"}},
    [KEY_COVERAGE] = {"coverage",
                      {"unsnapped edges", "edges on 1/16 pixel", "edges on 1/32 pixel", "edges on 1/64 pixel",
                       "edges on 1/128 pixel", "edges on 1/256 pixel", "edges on 1/512 pixel",
                       "edges on 1/1024 pixel"}},
    [KEY_PLANE] = {"plane",
                   {"unsnapped vertices", "vertices on 1/16 pixel", "vertices on 1/32 pixel", "vertices on 1/64 pixel",
                    "vertices on 1/128 pixel", "vertices on 1/256 pixel", "vertices on 1/512 pixel",
                    "vertices on 1/1024 pixel"}},
    [KEY_RASTERIZER] = {.name = "rasterizer"},
    [KEY_PREDICTION] = {.name = "prediction"},
    [KEY_BIAS] = {"bias",
                  {"r = one code", "r = two codes",
                   "r = half a code", [BIAS_REAL] = "r = 2^(n-23)" N_OF("the largest depth of the triangle"),
                   "r = 2^(n-22)" N_OF("the largest depth of the triangle"),
                   "r = 2^(n-24)" N_OF("the largest depth of the triangle"),
                   "r = 2^(n-23)" N_OF("the depth of the pixel"), "r = 2^(n-22)" N_OF("the depth of the pixel"),
                   "r = 2^(n-24)" N_OF("the depth of the pixel"), DIFFERENT, DIFFERENT, DIFFERENT}},
    [KEY_FRACTION] = {"fraction", {"fractions of a constant count", "fractions of a constant are cut"}},
    [KEY_SLOPE] = {"slope", {"m = max(|dz/dx|, |dz/dy|)", "m = sqrt((dz/dx)^2 + (dz/dy)^2)", "m = |dz/dx| + |dz/dy|"}},
};

const char *probe_key_name(probe_key key) {
    return key < PROBE_KEYS ? keys[key].name : NULL;
}

/* The name of a row that draws. */
static const char *drawing_row(size_t i) {
    for (size_t row = 0; raster_get(row) != NULL; row++)
        if (raster_get(row)->model != NULL && i-- == 0)
            return raster_get(row)->name;
    return NULL;
}

const char *probe_hypothesis(probe_key key, size_t i) {
    static char sentence[PROBE_WORDS_SIZE];
    const char *row = key == KEY_RASTERIZER || key == KEY_PREDICTION ? drawing_row(i) : NULL;
    if (row == NULL || key == KEY_RASTERIZER)
        return row != NULL || i >= WORDS_MAX ? row : keys[key].words[i];
    snprintf(sentence, sizeof sentence, "another random scene as row %s predicts it", row);
    return sentence;
}

const char *probe_unit(probe_key key, size_t i) {
    return key == KEY_LOG2 && i == 0 ? "" : "ulp";
}

bool probe_key_counts(probe_key key) {
    return key != KEY_STORED && key != KEY_INVARIANCE && key != KEY_PREDICTION && key != KEY_LOG2 &&
           key != KEY_QUOTIENT;
}
