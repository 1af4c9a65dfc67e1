/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "method/method.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "method/limit.h"
#include "method/normal.h"

static const double decades_infinite = 1e6; /* how far depths go where the far plane has no end, in units of near */

static void fill_depths(const dp_setup *setup, method_inputs *in) {
    method_depths(setup, in->z, in->count);
}

static void fill_windows(const dp_setup *setup, method_inputs *in) {
    method_windows(setup, in->d, in->count);
}

/* The whole of the view, its halves and its ends, then ranges between two depths. */
static void fill_ranges(const dp_setup *setup, method_inputs *in) {
    double n = setup->spec.znear;
    double f = isinf(setup->spec.zfar) ? n * decades_infinite : setup->spec.zfar;
    method_depths(setup, in->z, in->count);
    for (size_t i = 0; i < in->count; i++) {
        double other = n * pow(f / n, method_unit(11, i));
        double lo = i % 4 == 0 ? n : fmin(in->z[i], other), hi = i % 4 <= 1 ? f : fmax(in->z[i], other);
        in->z[i] = fmin(fmax(lo, n), f);
        in->hi[i] = fmin(fmax(hi, in->z[i]), f);
    }
}

static const method_family_row families[METHOD_FAMILY_COUNT] = {
    [METHOD_INTERVAL] = {.name = "interval",
                         .summary = "z-fighting interval at an eye depth",
                         .measure = "relative error",
                         .cases = {{"unorm24 d3d", "unorm24", DP_MAPPING_D3D},
                                   {"fp32 reversed", "fp32", DP_MAPPING_REVERSED}},
                         .case_count = 2,
                         .inputs = 4096,
                         .walked = 256,
                         .per_decade = 2,
                         .ortho = true,
                         .methods = interval_methods,
                         .method_count = &interval_method_count,
                         .fill = fill_depths,
                         .judge = interval_judge,
                         .limit = limit_depths},
    [METHOD_LINEARIZE] = {.name = "linearize",
                          .summary = "eye depth of a binary32 window depth",
                          .measure = "relative error",
                          .cases = {{"fp32 d3d", "fp32", DP_MAPPING_D3D},
                                    {"fp32 reversed", "fp32", DP_MAPPING_REVERSED}},
                          .case_count = 2,
                          .inputs = 65536,
                          .walked = 1024,
                          .per_decade = 2,
                          .windows = true,
                          .methods = linearize_methods,
                          .method_count = &linearize_method_count,
                          .fill = fill_windows,
                          .judge = linearize_judge,
                          .limit = limit_windows,
                          .timed = linearize_timed},
    [METHOD_ENCODE] = {.name = "encode",
                       .summary = "code of a binary32 window depth",
                       .measure = "steps of the format",
                       .steps = true,
                       .cases = {{"fp16 d3d", "fp16", DP_MAPPING_D3D},
                                 {"unorm16 d3d", "unorm16", DP_MAPPING_D3D},
                                 {"unorm24 d3d", "unorm24", DP_MAPPING_D3D}},
                       .case_count = 3,
                       .inputs = 65536,
                       .walked = 1024,
                       .per_decade = 2,
                       .windows = true,
                       .methods = encode_methods,
                       .method_count = &encode_method_count,
                       .fill = fill_windows,
                       .judge = encode_judge,
                       .limit = limit_codes},
    [METHOD_WORST] = {.name = "worst",
                      .summary = "worst z-fighting interval over a range of depths",
                      .measure = "relative error",
                      .cases = {{"unorm16 d3d", "unorm16", DP_MAPPING_D3D},
                                {"fp16 reversed", "fp16", DP_MAPPING_REVERSED}},
                      .case_count = 2,
                      .inputs = 16,
                      .walked = 8,
                      .per_decade = 1,
                      .ortho = true,
                      .methods = worst_methods,
                      .method_count = &worst_method_count,
                      .fill = fill_ranges,
                      .judge = worst_judge,
                      .limit = limit_ranges},
    [METHOD_NORMAL] = {.name = "normal",
                       .summary = "normal of a plane from the stored depths around a pixel",
                       .measure = "radians",
                       .cases = {{"unorm24 d3d", "unorm24", DP_MAPPING_D3D},
                                 {"fp32 reversed", "fp32", DP_MAPPING_REVERSED}},
                       .case_count = 2,
                       .inputs = 16384,
                       .walked = 2048,
                       .per_decade = 2,
                       .methods = normal_methods,
                       .method_count = &normal_method_count,
                       .fill = normal_fill,
                       .judge = normal_judge,
                       .limit = limit_eyes},
    [METHOD_POSITION] = {.name = "position",
                         .summary = "place of a pixel from its binary32 window depth; 60 degrees, 16:9",
                         .measure = "error over distance",
                         .cases = {{"fp32 d3d", "fp32", DP_MAPPING_D3D},
                                   {"fp32 reversed", "fp32", DP_MAPPING_REVERSED},
                                   {"fp32 gl", "fp32", DP_MAPPING_GL}},
                         .case_count = 3,
                         .inputs = 65536,
                         .walked = 4096,
                         .per_decade = 2,
                         .windows = true,
                         .ortho = true,
                         .methods = position_methods,
                         .method_count = &position_method_count,
                         .fill = position_fill,
                         .judge = position_judge,
                         .limit = limit_places},
};

const method_family_row *method_family_get(size_t index) {
    return index < METHOD_FAMILY_COUNT ? &families[index] : NULL;
}

const method_family_row *method_family_find(const char *name) {
    for (size_t i = 0; i < METHOD_FAMILY_COUNT; i++)
        if (strcmp(method_family_get(i)->name, name) == 0)
            return method_family_get(i);
    return NULL;
}

const method_row *method_get(size_t index) {
    for (size_t i = 0; i < METHOD_FAMILY_COUNT; i++) {
        const method_family_row *family = method_family_get(i);
        if (index < *family->method_count)
            return &family->methods[index];
        index -= *family->method_count;
    }
    return NULL;
}

method_run *method_timed(const method_row *row) {
    const method_family_row *family = method_family_get(row->family);
    return family->timed != NULL ? family->timed(row) : NULL;
}

dp_status method_setup(const method_family_row *family, size_t which, double znear, double zfar, bool ortho,
                       dp_setup *out) {
    dp_spec spec = dp_spec_default();
    dp_format format[2];
    dp_format_parse(family->cases[which].format, format);
    spec.format = format[0];
    spec.mapping = family->cases[which].mapping;
    spec.znear = znear;
    spec.zfar = zfar;
    spec.ortho = ortho;
    return dp_setup_init(out, &spec);
}

bool method_arrays(size_t count, method_inputs *in, method_outputs *out) {
    *in = (method_inputs){count,
                          calloc(count, sizeof *in->z),
                          calloc(count, sizeof *in->hi),
                          calloc(count, sizeof *in->d),
                          calloc(3 * count, sizeof *in->place),
                          calloc(normal_eyes(count), sizeof *in->eye)};
    *out = (method_outputs){calloc(count, sizeof *out->value),
                            calloc(count, sizeof *out->eye),
                            calloc(count, sizeof *out->code),
                            {NULL, NULL, NULL}};
    bool good = in->z != NULL && in->hi != NULL && in->d != NULL && in->place != NULL && in->eye != NULL &&
                out->value != NULL && out->eye != NULL && out->code != NULL;
    for (int k = 0; k < 3; k++)
        good = (out->place[k] = calloc(count, sizeof *out->place[k])) != NULL && good;
    if (!good)
        method_arrays_free(in, out);
    return good;
}

void method_arrays_free(method_inputs *in, method_outputs *out) {
    free(in->z);
    free(in->hi);
    free(in->d);
    free(in->place);
    free(in->eye);
    free(out->value);
    free(out->eye);
    free(out->code);
    for (int k = 0; k < 3; k++)
        free(out->place[k]);
    *in = (method_inputs){0};
    *out = (method_outputs){0};
}

/* splitmix64 of a counter. */
double method_unit(uint64_t seed, uint64_t i) {
    uint64_t x = (seed << 40) + (i + 1) * 0x9e3779b97f4a7c15u;
    x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9u;
    x = (x ^ x >> 27) * 0x94d049bb133111ebu;
    return (double)((x ^ x >> 31) >> 11) * 0x1p-53;
}

void method_depths(const dp_setup *setup, double *z, size_t count) {
    enum { STEPS = 16 };
    double n = setup->spec.znear;
    double f = isinf(setup->spec.zfar) ? n * decades_infinite : setup->spec.zfar;
    size_t used = 0;
    double stress[8 * STEPS] = {n, nextafter(n, f), f, nextafter(f, n), sqrt(n) * sqrt(f)};
    size_t stressed = 5;
    for (int i = 1; i <= STEPS; i++) {
        stress[stressed++] = dp_eye(setup, ldexp(1.0, -i), 1 - ldexp(1.0, -i)); /* the binades of a float end there */
        stress[stressed++] = n * (1 + ldexp(1.0, -3 * i));
        stress[stressed++] = f * (1 - ldexp(1.0, -3 * i));
        stress[stressed++] = n * pow(f / n, (double)i / (STEPS + 1));
    }
    /* Few inputs: the planes and depths over the whole of the view, not only the planes' neighbourhood. */
    size_t step = count < stressed ? (stressed + count - 1) / count : 1;
    for (size_t i = 0; i < stressed && used < count; i += step)
        z[used++] = fmin(fmax(stress[i], n), f);
    for (; used < count; used++)
        z[used] = fmin(fmax(n * pow(f / n, method_unit(5, used)), n), f);
}

/* Both ends and their neighbours, subnormals, powers of two from either end; then depths spread evenly over z, over d,
 * and over the codes at either end. */
void method_windows(const dp_setup *setup, float *d, size_t count) {
    static const float ends[] = {0.0f, 0x1p-149f, 0x1p-130f, 0x1.8p-127f, 0x1p-126f, 1.0f, 0.5f, 0x1.fffffep-2f};
    size_t used = 0;
    double phi = isinf(setup->spec.zfar) ? 1 / decades_infinite : setup->spec.znear / setup->spec.zfar;
    for (size_t i = 0; i < sizeof ends / sizeof ends[0] && used < count; i++)
        d[used++] = ends[i];
    for (int i = 1; i <= 64 && used < count; i++)
        d[used++] = 1.0f - (float)i * 0x1p-24f;
    for (int i = 1; i <= 60 && used + 1 < count; i++) {
        d[used++] = ldexpf(1.0f, -i);
        d[used++] = 1.0f - ldexpf(1.0f, i < 24 ? -i : -24);
    }
    for (; used < count; used++) {
        double u = method_unit(3, used), t = pow(phi, u); /* t = n/z */
        double away = (t - phi) / (1 - phi);
        const double kinds[4] = {u, away, 1 - away, t * t};
        d[used] = (float)fmin(fmax(kinds[used % 4], 0), 1);
    }
}
