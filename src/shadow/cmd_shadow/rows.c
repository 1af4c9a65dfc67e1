/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "shadow/cmd_shadow/rows.h"
#include "shadow/cmd_shadow/request.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "core/append.h"
#include "core/elementary.h"

enum { DIGITS = 4 };

static double signed_or_none(double magnitude, int sign) {
    return isfinite(magnitude) ? magnitude * sign + 0.0 : (double)NAN; /* no -0 */
}

static shadow_set set_of(const shadow_light *light, const shadow_need *need, int k, const bias_api *api) {
    const shadow_bias *b = &need->bias[k];
    const shadow_state state = shadow_state_of(light, b, api);
    const int sign = shadow_sign(light);
    const bool none = !isfinite(b->factor) || !isfinite(state.units);
    return (shadow_set){.window = b->window,
                        .units = none ? (double)NAN : signed_or_none(state.units, sign),
                        .factor = signed_or_none(b->factor, sign),
                        .offset = b->offset,
                        .texels = b->offset / need->per_offset,
                        .gap = none ? (double)NAN : state.gap_light,
                        .gap_normal = none ? (double)NAN : state.gap_normal,
                        .gap_facing = none ? (double)NAN : state.gap_facing,
                        .share = isfinite(b->factor) ? b->share : (double)NAN};
}

/* The number farther from 0; none where either is none. */
static double wider(double a, double b) {
    return isnan(a) || isnan(b) ? (double)NAN : fabs(a) >= fabs(b) ? a : b;
}

static shadow_set widest(const shadow_set *a, const shadow_set *b) {
    return (shadow_set){.window = wider(a->window, b->window),
                        .units = wider(a->units, b->units),
                        .factor = wider(a->factor, b->factor),
                        .offset = wider(a->offset, b->offset),
                        .texels = wider(a->texels, b->texels),
                        .gap = wider(a->gap, b->gap),
                        .gap_normal = wider(a->gap_normal, b->gap_normal),
                        .gap_facing = wider(a->gap_facing, b->gap_facing),
                        .share = isnan(a->share) || isnan(b->share) ? (double)NAN : fmin(a->share, b->share)};
}

/* Four digits that are enough, or all of a whole number. */
static void write_enough(double value, bool all_digits, char out[UNITS_SIZE]) {
    const number_text text = all_digits ? number_full(fabs(value)) : number_brief(number_up(fabs(value), DIGITS));
    snprintf(out, UNITS_SIZE, "%s%s", value < 0.0 ? "-" : "", isnan(value) ? "-" : text.text);
}

/* "2.5 texels" is a length that each cascade has in scene units of its own. */
static void write_set(shadow_set *w, int k, const bias_api *api) {
    write_enough(w->units, w->units == nearbyint(w->units) && fabs(w->units) < 1e9, w->units_text);
    write_enough(w->factor, false, w->factor_text);
    w->call[0] = '\0';
    if (isnan(w->units))
        return;
    if (k == SHADOW_NORMAL)
        snprintf(w->call, sizeof w->call, "%s texels, ", number_brief(number_up(w->texels, DIGITS)).text);
    append(w->call, sizeof w->call, "%s", bias_call(api, w->units, strtod(w->factor_text, NULL)).text);
}

/* Columns that a shader that writes distances adds to them. */
static void write_added(shadow_set *w, int k, const shadow_light *light) {
    write_set(w, k, bias_api_find("vulkan-float"));
    w->call[0] = '\0';
    if (isnan(w->units))
        return;
    if (k == SHADOW_NORMAL)
        snprintf(w->call, sizeof w->call, "%s texels, ", number_brief(number_up(w->texels, DIGITS)).text);
    append(w->call, sizeof w->call, "add %s, %s along the ray, to what is written", w->units_text,
           number_brief(number_up(w->window * light->setup.kappa, DIGITS)).text);
}

/* Rows of one depth of a light that has a place. */
static void place_row(const shadow_maps *maps, const shadow_light *light, const bias_api *api, shadow_row *r) {
    const dp_format *format = &light->setup.spec.format;
    const double angle = light->triangles.slant_hi * DP_DEGREE;
    const bool distance = shadow_holds_distance(light);
    shadow_need need, here;
    shadow_need_of(&maps->whole, &need);
    shadow_need_of(light, &here);
    r->z = light->receiver_lo;
    r->from = r->width = r->height = r->depth = (double)NAN;
    r->axis = light->kernel * here.texel * dp_tan(angle) / (distance ? 1.0 : r->z * r->z) / light->setup.kappa;
    r->axis_codes = format->kind == DP_FORMAT_UNORM ? r->axis * (double)format->code_max : (double)NAN;
    for (int k = 0; k < SHADOW_WAY_COUNT; k++) {
        shadow_state state = shadow_state_of(&maps->whole, &need.bias[k], api);
        shadow_set *w = &r->way[k];
        state.gap_light = state.gap_normal = state.gap_facing = 0.0;
        shadow_state_widen(light, &need.bias[k], api, &state);
        w->gap = isnan(w->units) || !isfinite(state.units) ? (double)NAN : state.gap_light;
        w->gap_normal = isnan(w->gap) ? (double)NAN : state.gap_normal;
        w->gap_facing = isnan(w->gap) ? (double)NAN : state.gap_facing;
    }
}

shadow_row shadow_row_of(const shadow_maps *maps, size_t i, const bias_api *api) {
    const shadow_cascade *c = &maps->items[i];
    const shadow_light *light = &c->light;
    const bool split = maps->view.count > 0;
    const double depth = light->setup.spec.zfar - light->setup.spec.znear;
    const bool perspective = maps->whole.kind != SHADOW_SUN && !shadow_holds_distance(light);
    const double along = perspective ? light->receiver_lo * light->receiver_lo * light->setup.kappa : depth;
    shadow_need need;
    shadow_need_of(light, &need);
    shadow_row r = {.cascade = (int)i + 1,
                    .from = split ? c->from : (double)NAN,
                    .to = split ? c->to : (double)NAN,
                    .radius = split ? c->radius : (double)NAN,
                    .width = light->width,
                    .height = light->height,
                    .depth = depth,
                    .texel = need.texel,
                    .z = (double)NAN,
                    .axis = (double)NAN,
                    .axis_codes = (double)NAN,
                    .api = shadow_holds_distance(light) ? NULL : api->name};
    for (int k = 0; k < SHADOW_CAUSE_COUNT; k++)
        r.cause[k] = shadow_part_at(light, &need.part[k], light->triangles.slant_hi) * along;
    for (int k = 0; k < SHADOW_WAY_COUNT; k++) {
        r.way[k] = set_of(light, &need, k, api);
        write_set(&r.way[k], k, api);
        r.limited = r.limited || need.bias[k].limited ||
                    light->receiver_hi + r.way[k].gap > light->setup.spec.zfar; /* units may be worth more */
    }
    if (maps->whole.kind != SHADOW_SUN)
        place_row(maps, light, api, &r);
    return r;
}

shadow_whole shadow_whole_of(const shadow_maps *maps, const bias_api *api) {
    shadow_whole w = {.api = api->name};
    if (maps->whole.kind != SHADOW_SUN) {
        shadow_need need;
        shadow_need_of(&maps->whole, &need);
        w.api = shadow_holds_distance(&maps->whole) ? NULL : api->name;
        for (int k = 0; k < SHADOW_WAY_COUNT; k++) {
            w.way[k] = set_of(&maps->whole, &need, k, api);
            (w.api == NULL ? write_added(&w.way[k], k, &maps->whole) : write_set(&w.way[k], k, api));
            w.limited = w.limited || !(maps->whole.receiver_hi + w.way[k].gap <= maps->whole.setup.spec.zfar);
            w.hidden = w.hidden || isinf(w.way[k].gap);
        }
        return w;
    }
    for (size_t i = 0; i < maps->count; i++) {
        const shadow_row r = shadow_row_of(maps, i, api);
        w.limited = w.limited || r.limited;
        for (int k = 0; k < SHADOW_WAY_COUNT; k++) {
            w.way[k] = i == 0 ? r.way[k] : widest(&w.way[k], &r.way[k]);
            w.hidden = w.hidden || r.way[k].gap >= r.depth || r.way[k].window >= 1.0; /* no units, no gap */
        }
    }
    for (int k = 0; k < SHADOW_WAY_COUNT; k++)
        write_set(&w.way[k], k, api);
    return w;
}
