/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "camera/upscaler.h"

#include <math.h>

#include "core/elementary.h"

static const double factor = 1.37e-5;

/* Tangents of the half angles. */
static double half_height(const upscaler_view *v) {
    return dp_half_tangent(v->fov_y);
}

static double half_width(const upscaler_view *v) {
    return half_height(v) * v->width / v->height;
}

static double by_tangent(const upscaler_view *v) {
    return factor * half_width(v) * 0.5 * v->width;
}

static double by_diagonal(const upscaler_view *v) {
    const double corner = dp_hypot(1.0, dp_hypot(half_width(v), half_height(v))); /* over the ray in the middle */
    return factor * corner * dp_hypot(v->width, v->height);
}

/* clang-format off */
static const upscaler_row rows[UPSCALER_ROWS] = {
    {"tangent", NULL, "1.37e-5 z tan(hfov/2) W/2",
     "FidelityFX Super Resolution 2, first releases, depth clip, marked as for reversed infinite depth alone; "
     "attributed there to Akeley and Su 2006", by_tangent},
    {"diagonal", NULL, "1.37e-5 z |corner|/|centre| length(W, H)",
     "FidelityFX Super Resolution 2, later releases, and 3, depth clip", by_diagonal},
};
/* clang-format on */

NAMED_TABLE(upscaler, rows);
