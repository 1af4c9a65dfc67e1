/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "solve/biased.h"

#include <math.h>

#include "bias/limits.h"
#include "camera/depth_range.h"
#include "core/engine.h"

enum { API, UNITS, FACTOR, CLAMP, SLOPE, GAP, KEYS };

static const char *const keys[] = {"api", "units", "factor", "clamp", "slope", "separation", NULL};

static bool read_number(reader *r, setting *s, const char *key, double *out) {
    static const double most = 1e12;
    return s == NULL || reader_number_within(s, -most, most, out) ||
           reader_fail(r, s, "bias: %s must be a number from -1e12 to 1e12, got %s", key, reader_shown(r, s));
}

static bool read_api(reader *r, const setting *s, need *n) {
    const char *name;
    if (!reader_string(r, s, &name))
        return false;
    n->bias.api = n->goal.api = bias_api_find(name);
    for (size_t i = 0; bias_api_get(i) != NULL && n->bias.api == NULL; i++)
        reader_known(r, name, bias_api_get(i)->name);
    return n->bias.api != NULL || reader_fail(r, s, "bias: api must be one of 'list apis', got '%s'", name);
}

static bool suits(reader *r, setting *const *found, const setting *group, const need *n) {
    const need_camera *camera = &r->file->cameras[n->camera];
    const bias_api *api = n->bias.api;
    if (camera->world > 0.0)
        return reader_fail(r, group, "bias: is of eye depths, and the camera '%s' has from_origin", camera->name);
    if (isinf(n->hi))
        return reader_fail(r, group, "bias: needs a range with a finite far end");
    if (api->whole && !(n->bias.units == nearbyint(n->bias.units) && fabs(n->bias.units) <= 2147483647.0))
        return reader_fail(r, found[UNITS], "bias: units must be a whole number of 32 bits for %s, got %s", api->name,
                           reader_shown(r, found[UNITS]));
    if (found[CLAMP] != NULL && !api->clamps)
        return reader_fail(r, found[CLAMP], "bias: clamp must not be given for %s, which has none", api->name);
    camera_fault fault = {.key = NULL};
    if (!camera_range_suits(api, camera->setups[0].spec.depth_range, &fault))
        return reader_fault(r, group, NULL, &fault);
    if (camera->setups[0].spec.triangles.width > 0 && camera->setups[0].curve != DP_CURVE_PERSPECTIVE)
        return reader_fail(r, group,
                           "bias: needs one of the mappings " DP_MAPPING_NAMES_PERSPECTIVE
                           " with a viewport, and the camera '%s' has %s",
                           camera->name, dp_mapping_get(camera->setups[0].spec.mapping)->name);
    return true;
}

bool reader_bias(reader *r, setting *group, need *n) {
    setting *found[KEYS] = {NULL};
    if (group->kind != SETTING_GROUP)
        return reader_fail(r, group, "bias: must be a group { api = NAME; units = U; ... }, got %s",
                           reader_shown(r, group));
    if (!reader_keys(r, group, "bias", keys, found))
        return false;
    if (found[API] == NULL || found[UNITS] == NULL)
        return reader_fail(r, group, "bias: needs api and units");
    const bool good =
        read_api(r, found[API], n) && read_number(r, found[UNITS], "units", &n->bias.units) &&
        read_number(r, found[FACTOR], "factor", &n->bias.factor) &&
        read_number(r, found[CLAMP], "clamp", &n->bias.clamp) &&
        (found[SLOPE] == NULL || reader_length(r, found[SLOPE], "slope", READER_POSITIVE, &n->goal.slope)) &&
        (found[GAP] == NULL || reader_length(r, found[GAP], "separation", READER_POSITIVE, &n->goal.gap)) &&
        suits(r, found, group, n);
    n->limit = n->bias.units;
    return good;
}

bias_verdict need_bias(const need *n, const dp_setup *asked, dp_setup *setup, bool *sloped) {
    dp_setup exact = *asked;
    bias_goal goal = n->goal;
    dp_setup_in(asked, DP_MODEL_EXACT, &exact); /* which every mapping has */
    *setup = dp_setup_facing(&exact);
    goal.slope = 0.0;
    const bool lost = bias_is_missed(setup); /* no API biases what a fragment shader writes */
    const bias_state none = {.api = n->bias.api}, state = lost ? none : n->bias;
    bias_verdict facing = bias_judge(setup, &state, &goal, n->lo, n->hi);
    facing.units = lost ? (double)NAN : facing.units;
    *sloped = false;
    goal.slope = n->goal.slope;
    if (facing.answer != BIAS_ENOUGH || (exact.spec.triangles.width == 0 && goal.slope == 0.0))
        return facing;
    *setup = exact;
    *sloped = goal.slope > 0.0;
    return bias_judge(setup, &state, &goal, n->lo, n->hi);
}
