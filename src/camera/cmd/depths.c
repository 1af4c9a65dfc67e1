/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "camera/cmd/depths.h"

#include <math.h>

#include "camera/cmd/camera.h"
#include "core/elementary.h"
#include "report/number.h"

static const double infinite_far_ratio = 1e6; /* the default depths end at this many nears when far is infinite */

double depths_get(const depths *d, size_t i) {
    if (d->kind == DEPTHS_LIST && d->from != NULL && d->to != NULL)
        return unit_convert(d->list[i], d->from, d->to);
    if (d->kind == DEPTHS_LIST)
        return d->list[i];
    if (i == 0)
        return d->lo;
    if (i + 1 >= d->count)
        return d->hi;
    double share = (double)i / (double)(d->count - 1);
    double z = d->kind == DEPTHS_LOG ? d->lo * dp_pow(d->hi / d->lo, share) : d->lo + (d->hi - d->lo) * share;
    return fmin(fmax(z, d->lo), d->hi);
}

static int check_within(const camera_asked *c, const char *id, double lo, double hi) {
    if (lo >= c->znear && hi <= c->zfar)
        return EXIT_FINE;
    return option_error(id, "depths must lie in [near, far] = [%s, %s%c, got %s", camera_length(c, c->znear, 0).text,
                        camera_length(c, c->zfar, 0).text, isinf(c->zfar) ? ')' : ']',
                        camera_length(c, lo < c->znear ? lo : hi, 0).text);
}

int depths_resolve(const camera_asked *c, size_t count, depths *out) {
    const double end = isinf(c->zfar) ? c->znear * infinite_far_ratio : c->zfar;
    const depths_kind kind = c->znear > 0.0 ? DEPTHS_LOG : DEPTHS_LIN;
    *out = c->at.count > 0 ? c->at : (depths){.kind = kind, .lo = c->znear, .hi = end, .count = count};
    const int status = check_within(c, "at", out->lo, out->hi);
    if (status == EXIT_FINE && out->kind == DEPTHS_LOG && out->lo <= 0.0)
        return option_error("at", "log spacing needs LO greater than 0, got %s: lin has equal steps",
                            number_full(out->lo).text);
    return status;
}

int depths_in_binary32(const depths *d) {
    if (!isinf((float)d->hi))
        return EXIT_FINE;
    return option_error("at", "depths in binary32 must be at most 3.4028235e+38, its largest number, got %s",
                        number_full(d->hi).text);
}

int range_resolve(const camera_asked *c, double *lo, double *hi) {
    bool asked = option_given(c->line, "range");
    *lo = asked ? c->range_lo : c->znear;
    *hi = asked ? c->range_hi : c->zfar;
    return check_within(c, "range", *lo, *hi);
}
