/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "drawn_truth.h"

#include "support.h"

cameras cameras_of(dp_spec spec, const char *formats, const char *mappings) {
    cameras c = {0};
    char f[64], m[64], *rest = NULL;
    snprintf(f, sizeof f, "%s", formats);
    for (char *format = strtok_r(f, ",", &rest); format != NULL; format = strtok_r(NULL, ",", &rest)) {
        char *more = NULL;
        snprintf(m, sizeof m, "%s", mappings);
        for (char *mapping = strtok_r(m, ",", &more); mapping != NULL; mapping = strtok_r(NULL, ",", &more)) {
            dp_format found[2];
            assert_int_equal(dp_format_parse(format, found), 1);
            spec.format = found[0];
            for (int k = 0; k < DP_MAPPING_COUNT; k++)
                if (strcmp(dp_mapping_get((dp_mapping)k)->name, mapping) == 0)
                    spec.mapping = (dp_mapping)k;
            assert_int_equal(dp_setup_init(&c.setups[c.count], &spec), DP_OK);
            snprintf(c.names[c.count++], sizeof c.names[0], "%s %s", format, mapping);
        }
    }
    return c;
}

dp_spec drawn_camera(double znear, double zfar) {
    dp_spec spec = dp_spec_default();
    spec.ortho = znear <= 0;
    spec.znear = znear;
    spec.zfar = zfar;
    return spec;
}

/* ---- Truths, each of the library --------------------------------------------------------------------------------- */

static bool in_range(const dp_setup *s, double *from, double *to) {
    *from = fmax(*from, s->spec.znear);
    *to = fmin(*to, s->spec.zfar);
    return *from < *to;
}

/* Cells count whole. */
static bool worst_cells(const dp_setup *s, double from, double to, dp_worst *out) {
    if (!in_range(s, &from, &to))
        return false;
    const dp_cell first = dp_cell_of(s, dp_code(s, from)), last = dp_cell_of(s, dp_code(s, to));
    const double within = 1e-9; /* of a cell: at its very end the next one begins */
    return dp_worst_over(s, fmin(first.lo + within * first.width, from), fmax(last.hi - within * last.width, to),
                         out) == DP_OK;
}

bool true_error(const void *setup, double from, double to, double *lo, double *hi) {
    dp_worst w;
    *lo = *hi = NAN;
    if (!worst_cells(setup, from, to, &w))
        return false;
    *lo = *hi = w.error;
    return isfinite(w.error);
}

bool true_interval(const void *setup, double from, double to, double *lo, double *hi) {
    dp_worst w;
    *lo = *hi = NAN;
    if (!in_range(setup, &from, &to) || dp_worst_over(setup, from, to, &w) != DP_OK)
        return false;
    *lo = *hi = w.interval;
    return isfinite(w.interval);
}

bool true_density(const void *setup, double from, double to, double *lo, double *hi) {
    const bool good = true_interval(setup, from, to, lo, hi);
    *lo = 1 / *lo;
    *hi = *lo;
    return good;
}

/* A picture may have columns finer than its pixels: the least of four parts is the least that a curve may show. */
bool true_separation(const void *setup, double from, double to, double *lo, double *hi) {
    enum { PARTS = 4 };
    *lo = INFINITY;
    *hi = -INFINITY;
    if (!in_range(setup, &from, &to))
        return false;
    for (int i = 0; i < PARTS; i++) {
        dp_separation_worst w;
        const double a = from + (to - from) * i / PARTS, b = i + 1 < PARTS ? from + (to - from) * (i + 1) / PARTS : to;
        if (dp_separation_over(setup, a, b, 0, &w) != DP_OK)
            return false;
        *lo = fmin(*lo, w.bound);
        *hi = fmax(*hi, w.bound);
    }
    return isfinite(*hi);
}

/* Codes before the far plane's, of those between both planes. */
bool true_share(const void *setup, double from, double to, double *lo, double *hi) {
    const dp_setup *s = setup;
    *lo = *hi = NAN;
    if (!in_range(s, &from, &to))
        return false;
    const double first = dp_code(s, s->spec.znear), last = dp_code(s, s->spec.zfar);
    *lo = 100 * (last - dp_code(s, to)) / (last - first);
    *hi = 100 * (last - dp_code(s, from)) / (last - first);
    return *lo > 0; /* on a logarithmic axis */
}

bool true_window(const void *setup, double from, double to, double *lo, double *hi) {
    const dp_setup *s = setup;
    *lo = *hi = NAN;
    if (!in_range(s, &from, &to))
        return false;
    const double a = dp_window(s, from), b = dp_window(s, to);
    *lo = fmin(a, b);
    *hi = fmax(a, b);
    return true;
}
