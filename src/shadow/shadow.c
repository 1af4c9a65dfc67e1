/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The door of the room: words, defaults, and what is let in. */
#include "shadow/shadow.h"

#include <math.h>

#include "shadow/ground.h"

const char *shadow_status_text(shadow_status status) {
    static const char *const texts[SHADOW_STATUS_COUNT] = {
        [SHADOW_OK] = "fine",
        [SHADOW_SETUP] = "a directional light's projection must be orthographic, a spot light's a perspective",
        [SHADOW_BOX] = "the light's box must be from 1e-12 to 1e12 wide and high, and a map larger than its filter",
        [SHADOW_CONE] = "the angle of a map must be from 0.001 to 170 degrees, and its sides as long as each other",
        [SHADOW_TRIANGLES] = "triangles out of range, or a slant that is not from 0 to 89.9 degrees",
        [SHADOW_KERNEL] = "the filter's radius must be from 0.5 to 64 texels, subtexel bits from 0 to 24",
        [SHADOW_SMALL] = "the least height of triangles must be from 1/256 to 65536 texels",
        [SHADOW_POSITION] = "the world and the error of positions must be from 0 to 1e18",
        [SHADOW_ROUND] = "the radius of curvature must be positive, the size of facets from 0 to 1e18",
        [SHADOW_RECEIVERS] = "lit surfaces must lie between the light's planes, the nearer first",
        [SHADOW_COARSE] = "the filter and all that is rounded must reach over less than a quarter of the map",
        [SHADOW_CASCADES] =
            ("near must be from 1e-12 to below far, far at most 1e12, the vertical angle from 0.001 to 179.9 degrees, "
             "width over height from 0.001 to 1000, cascades 1 to 16, lambda 0 to 1, casters from 0 to 1e12"),
    };
    return (unsigned)status < SHADOW_STATUS_COUNT ? texts[status] : "not a status";
}

const char *shadow_cause_name(shadow_cause cause) {
    static const char *const names[SHADOW_CAUSE_COUNT] = {
        [SHADOW_CAUSE_TEXEL] = "texel",       [SHADOW_CAUSE_KERNEL] = "kernel", [SHADOW_CAUSE_LOOKUP] = "lookup",
        [SHADOW_CAUSE_SNAPPING] = "snapping", [SHADOW_CAUSE_SETUP] = "set-up",  [SHADOW_CAUSE_POSITION] = "position",
        [SHADOW_CAUSE_RECEIVER] = "receiver", [SHADOW_CAUSE_FORMAT] = "format",
    };
    return (unsigned)cause < SHADOW_CAUSE_COUNT ? names[cause] : NULL;
}

const char *shadow_way_name(shadow_way way) {
    static const char *const names[SHADOW_WAY_COUNT] = {
        [SHADOW_CONSTANT] = "constant",
        [SHADOW_SLOPE] = "slope-scaled",
        [SHADOW_NORMAL] = "normal offset",
    };
    return (unsigned)way < SHADOW_WAY_COUNT ? names[way] : NULL;
}

shadow_light shadow_light_default(void) {
    shadow_light light = {.width = 20.0,
                          .height = 20.0,
                          .triangles = dp_triangles_default(),
                          .small = 1.0,
                          .kernel = 0.5,
                          .subtexel = 8,
                          .fov = 90.0,
                          .radius = (double)INFINITY,
                          .receiver_lo = 0.0,
                          .receiver_hi = 100.0};
    dp_spec spec = dp_spec_default();
    spec.ortho = 1;
    spec.znear = 0.0;
    spec.zfar = 100.0;
    (void)dp_setup_init(&light.setup, &spec);
    light.triangles.width = light.triangles.height = 2048;
    light.triangles.slant_hi = 75.0;
    return light;
}

static bool within(double x, double lo, double hi) {
    return x >= lo && x <= hi;
}

static shadow_status check_shape(const shadow_light *light) {
    const dp_spec *spec = &light->setup.spec;
    const bool ortho = light->setup.curve == DP_CURVE_LINEAR && spec->ortho != 0;
    if (light->kind == SHADOW_SUN && !ortho)
        return SHADOW_SETUP;
    if (light->kind == SHADOW_SUN)
        return within(light->width, 1e-12, 1e12) && within(light->height, 1e-12, 1e12) ? SHADOW_OK : SHADOW_BOX;
    if (!(ortho || light->setup.curve == DP_CURVE_PERSPECTIVE) || !(spec->znear > 0.0))
        return SHADOW_SETUP;
    if (!within(light->fov, 0.001, 170.0) || (light->kind == SHADOW_POINT && light->fov != 90.0) ||
        light->triangles.width != light->triangles.height || !isinf(light->radius))
        return SHADOW_CONE;
    return SHADOW_OK;
}

/* For a light that has a place: what is far, and what is off by much, is no longer linear. */
static shadow_status check_extent(const shadow_light *light) {
    if (light->kind == SHADOW_SUN)
        return SHADOW_OK;
    if (!(light->receiver_hi <= fmin(1e12, light->receiver_lo * 0x1p60)))
        return SHADOW_RECEIVERS;
    const ground g = shadow_ground_at(light, light->receiver_lo);
    if (!(g.second >= 1.0 && g.second <= 2.0))
        return SHADOW_POSITION;
    shadow_part part[SHADOW_CAUSE_COUNT];
    const double texels = shadow_texels(light, &g, part);
    return texels > 0.0 && texels * g.pitch < 0.25 ? SHADOW_OK : SHADOW_COARSE;
}

shadow_status shadow_light_check(const shadow_light *light) {
    static const double most = 1e18;
    const dp_spec *spec = &light->setup.spec;
    const shadow_status shape = check_shape(light);
    if (shape != SHADOW_OK)
        return shape;
    if (dp_triangles_check(&light->triangles) != DP_OK || light->triangles.slant_hi > SHADOW_SLANT_MAX)
        return SHADOW_TRIANGLES;
    if (!within(light->kernel, 0.5, 64.0) || !within(light->subtexel, 0, 24))
        return SHADOW_KERNEL;
    if (!within(light->small, 0x1p-8, 65536.0))
        return SHADOW_SMALL;
    if (!within(light->world, 0.0, most) || !within(light->position, 0.0, most))
        return SHADOW_POSITION;
    if (!(light->radius > 0.0) || !within(light->facet, 0.0, most))
        return SHADOW_ROUND;
    if (!(light->receiver_lo >= spec->znear && light->receiver_lo <= light->receiver_hi &&
          light->receiver_hi <= spec->zfar))
        return SHADOW_RECEIVERS;
    return check_extent(light);
}
