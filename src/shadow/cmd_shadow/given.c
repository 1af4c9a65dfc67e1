/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "shadow/cmd_shadow/given.h"

#include <math.h>

#include "core/append.h"

enum { DIGITS = 4 };

static const shadow_engine *engine_at(const shadow_request *o, size_t index) {
    if (index == 0)
        return o->shadow.engine;
    for (size_t i = 0; shadow_engine_get(i) != NULL; i++)
        if (shadow_engine_get(i) != o->shadow.engine && (o->shadow.engines >> i & 1U) != 0 && --index == 0)
            return shadow_engine_get(i);
    return NULL;
}

/* The numbers of the first engine; of the others those that do the same in the first map. */
static void take_numbers(const shadow_request *o, const shadow_maps *maps, const shadow_engine *engine,
                         const bias_api *api, shadow_engine_row *out) {
    const shadow_engine *first = o->shadow.engine;
    const shadow_light *light = shadow_map_of(maps, 0);
    const double *standard = first->standard[light->kind];
    out->bias = isnan(o->shadow.bias) ? standard[0] : o->shadow.bias;
    out->normal = first->normal == NULL          ? (double)NAN
                  : isnan(o->shadow.normal_bias) ? standard[1]
                                                 : o->shadow.normal_bias;
    if (engine == first)
        return;
    const shadow_given given =
        shadow_engine_gives(first, light, api, out->bias, isnan(out->normal) ? 0.0 : out->normal);
    out->bias = shadow_bias_as(engine, light, api, given.window_most);
    out->normal = shadow_normal_as(engine, light, shadow_given_offset(&given, light->triangles.slant_hi));
}

/* The number that is enough in each map: the farthest from 0; none where one has none. */
static double farther(double a, double b) {
    return isnan(a) || isnan(b) ? (double)NAN : fabs(a) >= fabs(b) ? a : b;
}

bool shadow_engine_row_of(const shadow_request *o, const shadow_maps *maps, size_t index, shadow_engine_row *out) {
    const shadow_engine *engine = o->shadow.engine != NULL ? engine_at(o, index) : NULL;
    const bias_api *api = shadow_asked_api(o, 0);
    if (engine == NULL)
        return false;
    *out = (shadow_engine_row){.engine = engine->name,
                               .bias_name = engine->bias,
                               .normal_name = engine->normal,
                               .unconfirmed = engine->unconfirmed[0] != '\0' ? engine->unconfirmed : NULL,
                               .free = o->shadow.angle,
                               .acne = (double)NAN};
    take_numbers(o, maps, engine, api, out);
    const double bias = isnan(out->bias) ? 0.0 : out->bias, normal = isnan(out->normal) ? 0.0 : out->normal;
    for (size_t i = 0; i < shadow_map_count(maps); i++) {
        const shadow_light *light = shadow_map_of(maps, i);
        const shadow_verdict v = shadow_judge_all(engine, light, api, bias, normal);
        const double least_bias = shadow_least_bias(engine, light, api, normal);
        const double least_normal = shadow_least_normal(engine, light, api, bias);
        out->free = fmin(out->free, v.free);
        out->acne = fmin(out->acne, v.acne);
        out->gap = fmax(out->gap, v.gap);
        out->least_bias = i == 0 ? least_bias : farther(out->least_bias, least_bias);
        out->least_normal = i == 0 ? least_normal : farther(out->least_normal, least_normal);
    }
    out->enough = out->free >= o->shadow.angle;
    out->free = out->free < 0.0 ? (double)NAN : out->free;
    return true;
}

const column shadow_engine_columns[] = {
    {FIELD(shadow_engine_row, engine, "engine", ""), SHOWN("engine", -11, 0)},
    {FIELD(shadow_engine_row, bias_name, "bias_name", "")},
    {FIELD(shadow_engine_row, normal_name, "normal_name", "")},
    {FIELD(shadow_engine_row, bias, "bias", ""), SHOWN("bias", 10, DIGITS), .brief = true},
    {FIELD(shadow_engine_row, normal, "normal_bias", ""), SHOWN("normal", 9, DIGITS), .brief = true},
    {FIELD(shadow_engine_row, free, "free_to", "degrees"), SHOWN("free to", 8, 3), .downward = true},
    {FIELD(shadow_engine_row, acne, "acne_from", "degrees"), SHOWN("acne", 6, 3)},
    {FIELD(shadow_engine_row, gap, "gap", "scene"), SHOWN("gap", 8, 3), .upward = true, .brief = true},
    {FIELD(shadow_engine_row, least_bias, "least_bias", ""), SHOWN("least bias", 11, DIGITS), .brief = true,
     .outward = true},
    {FIELD(shadow_engine_row, least_normal, "least_normal", ""), SHOWN("normal", 9, DIGITS), .brief = true,
     .outward = true},
    {FIELD(shadow_engine_row, enough, "enough", "")},
    {FIELD(shadow_engine_row, unconfirmed, "unconfirmed", "")},
    {.kind = COLUMN_END}};

void shadow_say_given(page *p, const shadow_request *o, const shadow_maps *maps) {
    shadow_engine_row r;
    char text[256] = "";
    if (!shadow_engine_row_of(o, maps, 0, &r))
        return;
    append(text, sizeof text, "%s %s", r.bias_name, number_full(r.bias).text);
    if (r.normal_name != NULL)
        append(text, sizeof text, ", %s %s", r.normal_name, number_full(r.normal).text);
    if (r.enough)
        page_text(p, "%s, %s: enough up to %s degrees; the gap is up to %s", r.engine, text,
                  number_full(o->shadow.angle).text, number_up(r.gap, 3).text);
    else if (!isnan(r.acne))
        page_text(p, "%s, %s: not enough, acne from %s degrees on", r.engine, text, number_full(r.acne).text);
    else if (!isnan(r.free))
        page_text(p, "%s, %s: not enough, free of acne up to %s degrees", r.engine, text, number_full(r.free).text);
    else
        page_text(p, "%s, %s: not enough, not even where surfaces face the light", r.engine, text);
}
