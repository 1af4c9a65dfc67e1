/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "method/method.h"

#include <math.h>
#include <stdlib.h>

#include "core/elementary.h"
#include "core/outward.h"

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

const char *method_lacks(const method_row *row, size_t which, const dp_setup *setup) {
    return !method_speaks(row, which)  ? "of other formats or mappings"
           : !method_suits(row, setup) ? setup->spec.ortho ? "of perspective cameras" : "of orthographic cameras"
           : !method_available(row)    ? "not on this processor"
                                       : NULL;
}

bool method_arrays(size_t count, method_inputs *in, method_outputs *out) {
    *in = (method_inputs){count,
                          calloc(count, sizeof *in->z),
                          calloc(count, sizeof *in->hi),
                          calloc(count, sizeof *in->d),
                          calloc(3 * count, sizeof *in->place),
                          calloc((count + METHOD_STRIP - 1) / METHOD_STRIP * METHOD_STRIP_EYES, sizeof *in->eye),
                          NULL,
                          0};
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

void method_depths(const dp_setup *setup, method_inputs *in) {
    enum { STEPS = 16 };
    double *z = in->z;
    const size_t count = in->count;
    double n = setup->spec.znear;
    double f = isinf(setup->spec.zfar) ? n * METHOD_INFINITE_FAR : setup->spec.zfar;
    size_t used = 0;
    double stress[8 * STEPS] = {n, nextafter(n, f), f, nextafter(f, n), sqrt(n) * sqrt(f)};
    size_t stressed = 5;
    for (int i = 1; i <= STEPS; i++) {
        stress[stressed++] = dp_eye(setup, ldexp(1.0, -i), 1 - ldexp(1.0, -i)); /* the binades of a float end there */
        stress[stressed++] = n * (1 + ldexp(1.0, -3 * i));
        stress[stressed++] = f * (1 - ldexp(1.0, -3 * i));
        stress[stressed++] = n * dp_pow(f / n, (double)i / (STEPS + 1));
    }
    /* Few inputs: the planes and depths over the whole of the view, not only the planes' neighbourhood. */
    size_t step = count < stressed ? (stressed + count - 1) / count : 1;
    for (size_t i = 0; i < stressed && used < count; i += step)
        z[used++] = fmin(fmax(stress[i], n), f);
    for (; used < count; used++)
        z[used] = fmin(fmax(n * dp_pow(f / n, method_unit(5, used)), n), f);
}

/* Both ends and their neighbours, subnormals, powers of two from either end; then depths spread evenly over z, over d,
 * and over the codes at either end. */
void method_windows(const dp_setup *setup, method_inputs *in) {
    float *d = in->d;
    const size_t count = in->count;
    static const float ends[] = {0.0f, 0x1p-149f, 0x1p-130f, 0x1.8p-127f, 0x1p-126f, 1.0f, 0.5f, 0x1.fffffep-2f};
    size_t used = 0;
    double phi = isinf(setup->spec.zfar) ? 1 / METHOD_INFINITE_FAR : setup->spec.znear / setup->spec.zfar;
    for (size_t i = 0; i < sizeof ends / sizeof ends[0] && used < count; i++)
        d[used++] = ends[i];
    for (int i = 1; i <= 64 && used < count; i++)
        d[used++] = 1.0f - (float)i * 0x1p-24f;
    for (int i = 1; i <= 60 && used + 1 < count; i++) {
        d[used++] = ldexpf(1.0f, -i);
        d[used++] = 1.0f - ldexpf(1.0f, i < 24 ? -i : -24);
    }
    for (; used < count; used++) {
        double u = method_unit(3, used), t = dp_pow(phi, u); /* t = n/z */
        double away = (t - phi) / (1 - phi);
        const double kinds[4] = {u, away, 1 - away, t * t};
        d[used] = (float)fmin(fmax(kinds[used % 4], 0), 1);
    }
}

double method_cancelled(double ratio, double a, double b) {
    const double e = (a * ratio + b) * DP_UNIT * (1 + DP_ROUNDINGS32_14);
    return e < 1 ? e / (1 - e) : (double)INFINITY;
}
