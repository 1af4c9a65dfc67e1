/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "shadow/engine.h"

#include <math.h>

#include "core/elementary.h"
#include "shadow/ground.h"

#define SAME(x)                                                                                                        \
    { x, x, x }

/* clang-format off */
static const shadow_engine rows[] = {
    {"three", "threejs three.js", "added to the compared depth, of point lights to (distance - near)/(far - near)",
     "three.js, src/lights/LightShadow.js, shadowmap_pars_fragment.glsl.js, shadowmap_vertex.glsl.js",
     "bias", "normalBias", SAME(SHADOW_IN_WINDOW), SAME(SHADOW_IN_SCENE), SAME(-1.0), SAME(1.0),
     SAME(SHADOW_AT_ANY_ANGLE), {{0.0, 0.0}, {0.0, 0.0}, {0.0, 0.0}}, false, 0.0, 0.0, "", ""},
    {"unity-urp", "unity urp", "casters move; units 1 and slope factor 2.5 besides; no normal bias of point lights",
     "Universal RP, ShadowUtils.cs (GetShadowBias, RenderShadowSlice), Shadows.hlsl (ApplyShadowBias)",
     "depthBias", "normalBias", SAME(SHADOW_IN_FAR_TEXELS), SAME(SHADOW_IN_FAR_TEXELS), SAME(1.0), SAME(1.0),
     SAME(SHADOW_BY_VERSINE), {{1.0, 1.0}, {1.0, 1.0}, {1.0, 0.0}}, true, 1.0, 2.5, "defaults", ""},
    {"bevy", NULL, "the point is moved towards the light, and along its normal by sqrt(2) texels for each 1",
     "Bevy, bevy_light/src/directional_light.rs, spot_light.rs, point_light.rs, bevy_pbr/src/render/shadows.wgsl, "
     "light.rs",
     "shadow_depth_bias", "shadow_normal_bias", SAME(SHADOW_IN_SCENE), SAME(SHADOW_IN_TEXELS), SAME(1.0),
     SAME(1.4142135623730951), SAME(SHADOW_AT_ANY_ANGLE), {{0.02, 1.8}, {0.02, 1.8}, {0.08, 0.6}}, false, 0.0, 0.0, "",
     ""},
    {"babylon", "babylonjs babylon.js", "half of it is window depth; casters are moved along their normal",
     "Babylon.js, shadowGenerator.ts, shadowMapVertexMetric, shadowMapVertexNormalBias",
     "bias", "normalBias", SAME(SHADOW_IN_WINDOW), SAME(SHADOW_IN_SCENE), SAME(0.5), SAME(1.0), SAME(SHADOW_BY_SINE),
     {{0.00005, 0.0}, {0.00005, 0.0}, {0.00005, 0.0}}, false, 0.0, 0.0, "the metric of point lights", ""},
    {"playcanvas", NULL, "10 times as many units, and as large a slope factor",
     "PlayCanvas, light component (shadowBias), shadow-renderer.js (setDepthBiasValues)",
     "shadowBias", NULL, SAME(SHADOW_IN_UNITS), SAME(SHADOW_IN_NOTHING), SAME(10.0), SAME(0.0),
     SAME(SHADOW_AT_ANY_ANGLE), {{0.05, 0.0}, {0.05, 0.0}, {0.05, 0.0}}, false, 0.0, 0.0,
     "point lights, normalOffsetBias", ""},
    {"filament", NULL, "half a diagonal of a texel for each 1 along the normal; units 0.5 and slope factor 2 besides",
     "Filament, LightManager.h (ShadowOptions)",
     "constantBias", "normalBias", SAME(SHADOW_IN_SCENE), SAME(SHADOW_IN_TEXELS), SAME(1.0), SAME(0.7071067811865476),
     SAME(SHADOW_BY_SINE), {{0.001, 1.0}, {0.001, 1.0}, {0.001, 1.0}}, false, 0.5, 2.0, "the scale of normalBias", ""},
    {"unreal", "ue ue4 ue5", "numbers of a light, beside console variables, r.Shadow.CSMDepthBias and others",
     "Unreal Engine, API reference of ULightComponent, ShadowBias, ShadowSlopeBias",
     "Shadow Bias", "Shadow Slope Bias", SAME(SHADOW_IN_NOTHING), SAME(SHADOW_IN_NOTHING), SAME(1.0), SAME(1.0),
     SAME(SHADOW_AT_ANY_ANGLE), {{0.5, 0.5}, {0.5, 0.5}, {0.5, 0.5}}, false, 0.0, 0.0,
     "defaults",
     "Shadow Bias and Shadow Slope Bias, 0.5 each, run from 0 to 1, and its reference does not say of what: no bias in "
     "depth follows"},
    {"godot", "godot4", "1/100 of it is a length of the sun's, or clip z of spot lights; all of it a length of omni's",
     "Godot 4, light_3d.cpp, light_storage.cpp, scene_forward_lights_inc.glsl, "
     "scene_forward_clustered.glsl (BIAS_FUNC)",
     "shadow_bias", "shadow_normal_bias", {SHADOW_IN_SCENE, SHADOW_IN_CLIP, SHADOW_IN_SCENE},
     {SHADOW_IN_TEXELS, SHADOW_IN_SHARES, SHADOW_IN_SHARES}, {0.01, 0.01, 1.0}, {1.0, 10.0, 10.0},
     {SHADOW_ASIDE, SHADOW_BY_VERSINE, SHADOW_ASIDE}, {{0.1, 2.0}, {0.03, 1.0}, {0.1, 1.0}}, false, 0.0, 0.0,
     "bias_scale of cascades, taken to be 1", ""},
};
/* clang-format on */

#undef SAME

NAMED_TABLE(shadow_engine, rows);

/* ---- What is given ----------------------------------------------------------------------------------------------- */

static double soft_by(const shadow_engine *engine, const shadow_light *light) {
    return engine->soft && light->kernel > 1.0 ? light->kernel : 1.0;
}

/* A length that a number means, scene units. */
static double length_of(shadow_measure in, const shadow_light *light, const ground *g) {
    const bool sun = light->kind == SHADOW_SUN;
    const double texel = fmax(g->texel_x, g->texel_y);
    return in == SHADOW_IN_SCENE                                           ? 1.0
           : in == SHADOW_IN_TEXELS || (in == SHADOW_IN_FAR_TEXELS && sun) ? texel
           : in == SHADOW_IN_FAR_TEXELS                                    ? 0.5 * g->pitch * light->setup.spec.zfar
           : in == SHADOW_IN_SHARES                                        ? g->z / light->triangles.width
                                                                           : 0.0;
}

/* Window depth of a length along the axis to the light. */
static double along_axis(const shadow_light *light, const ground *g, double length) {
    const bool depth = light->kind != SHADOW_SUN && !shadow_holds_distance(light);
    const double z = g->z, left = z - length;
    return !depth ? length / g->depth : left > 0.0 ? length * z / left / g->depth : (double)INFINITY;
}

/* A length along the ray that its bias is, where the ground is; 0 of one in window depth or units. */
static double ray_of(const shadow_engine *engine, const shadow_light *light, const ground *g, double value) {
    if (engine->bias_in[light->kind] == SHADOW_IN_CLIP && !shadow_holds_distance(light))
        return value * light->setup.spec.zfar * light->setup.kappa;
    return value * length_of(engine->bias_in[light->kind], light, g);
}

/* The share of the depth of a point that is given is least at an end of the range. */
static void share(const shadow_engine *engine, const shadow_light *light, double value, double normal,
                  shadow_given *out) {
    const bool sun = light->kind == SHADOW_SUN;
    const double ends[2] = {light->receiver_lo, light->receiver_hi};
    out->ray_share = out->offset_share = (double)INFINITY;
    for (int i = 0; i < 2; i++) {
        const ground g = shadow_ground_at(light, ends[i]);
        const double offset = normal * length_of(engine->normal_in[light->kind], light, &g);
        out->ray_share = fmin(out->ray_share, ray_of(engine, light, &g, value) / (sun ? 1.0 : g.z));
        out->ray_most = fmax(out->ray_most, ray_of(engine, light, &g, value));
        out->offset_share = fmin(out->offset_share, sun ? offset : offset / (g.z + offset));
    }
}

shadow_given shadow_engine_gives(const shadow_engine *engine, const shadow_light *light, const bias_api *api,
                                 double bias, double normal) {
    const dp_setup *setup = &light->setup;
    const ground g = shadow_ground_at(light, light->receiver_lo);
    const shadow_kind kind = light->kind;
    const double by = soft_by(engine, light), value = bias * engine->bias_scale[kind] * by;
    const bool counted = engine->bias_in[kind] == SHADOW_IN_UNITS && !shadow_holds_distance(light);
    const double lo = dp_window(setup, light->receiver_lo), hi = dp_window(setup, light->receiver_hi);
    const bias_unit low = bias_unit_at(api, &setup->spec.format, fmin(lo, hi));
    const bias_unit high = bias_unit_at(api, &setup->spec.format, fmax(lo, hi));
    const double units = shadow_holds_distance(light) ? 0.0 : engine->units + (counted ? value : 0.0);
    shadow_given given = {.units = units,
                          .api = api,
                          .factor = shadow_holds_distance(light) ? 0.0 : engine->factor + (counted ? value : 0.0),
                          .offset =
                              normal * engine->normal_scale[kind] * by * length_of(engine->normal_in[kind], light, &g),
                          .growth = engine->growth[kind]};
    const bool leans = engine->normal_in[kind] == SHADOW_IN_SHARES && !shadow_holds_distance(light);
    given.offset_most = given.offset / (leans ? dp_cos(g.corner) : 1.0); /* the distance of a point in the corner */
    given.added = engine->bias_in[kind] == SHADOW_IN_WINDOW ? value : 0.0;
    given.level = units * low.least + given.added;
    share(engine, light, value, normal * engine->normal_scale[kind] * by, &given);
    given.window_most = given.added + units * (isfinite(high.most) ? high.most : high.least);
    if (engine->bias_in[kind] == SHADOW_IN_CLIP && !shadow_holds_distance(light))
        given.window_most += value * setup->spec.zfar / (g.z * g.z);
    else
        given.window_most += along_axis(light, &g, value * length_of(engine->bias_in[kind], light, &g));
    return given;
}

static double grown(shadow_growth growth, double angle) {
    const double sine = dp_sin(angle), versine = 1.0 - dp_cos(angle);
    return growth == SHADOW_BY_SINE      ? sine
           : growth == SHADOW_BY_VERSINE ? versine
           : growth == SHADOW_ASIDE      ? versine * sine * sine
                                         : 1.0;
}

/* ---- The verdict ------------------------------------------------------------------------------------------------- */

enum { STEPS = 10 }; /* a degree */

/* The bias that is needed and given, lengths over the depth of the point, or of the sun scene units. */
typedef struct balance {
    double across; /* texels that have to be covered, over a diagonal */
    double along;  /* depth that is given beyond rounding, the same along all rays */
    double ray;    /* along the ray */
    double offset; /* along the normal */
    double corner; /* radians: rays lean by up to that */
    shadow_growth growth;
} balance;

/* across sin(to + a) - along cos(to)/cos a, and what it changes by with a. */
typedef struct leaning {
    double value, slope;
} leaning;

static leaning leaning_at(const balance *b, double to, double a) {
    const double seen = fmin(to + a, 0.5 * SHADOW_HALF_TURN), level = b->along * dp_cos(to) / dp_cos(a);
    return (leaning){b->across * dp_sin(seen) - level, b->across * dp_cos(seen) - level * dp_tan(a)};
}

/* The most of it over all rays, or a little more: it is concave, so it lies below the tangents at the ends of a part in
 * which it turns. */
static double most_leaning(const balance *b, double to) {
    double from = 0.0, end = b->corner;
    leaning left = leaning_at(b, to, from), right = leaning_at(b, to, end);
    if (left.slope <= 0.0 || right.slope >= 0.0)
        return left.slope <= 0.0 ? left.value : right.value;
    for (int i = 0; i < 5; i++) {
        const double middle = 0.5 * (from + end);
        const leaning there = leaning_at(b, to, middle);
        *(there.slope > 0.0 ? &from : &end) = middle;
        *(there.slope > 0.0 ? &left : &right) = there;
    }
    const double meet = (left.value - right.value + right.slope * (end - from)) / (right.slope - left.slope);
    return left.value + left.slope * meet;
}

/* The most that rays which lean by up to the corner lack at angles from `from` to `to`. */
static double lacks(const balance *b, double from, double to) {
    const double seen = fmin(to + b->corner, 0.5 * SHADOW_HALF_TURN);
    const double given = b->offset * grown(b->growth, from) + b->ray * dp_cos(to);
    if (b->along < 0.0)
        return b->across * dp_sin(seen) - b->along * dp_cos(from) / dp_cos(b->corner) - given;
    return most_leaning(b, to) - given;
}

/* The greatest angle up to which nothing lacks. */
static double free_up_to(const balance *b, double most) {
    if (lacks(b, 0.0, 0.0) > 0.0)
        return -1.0;
    const int count = (int)ceil(most * STEPS - 1e-9);
    for (int i = 0; i < count; i++)
        if (lacks(b, shadow_radians((double)i / STEPS), shadow_radians(fmin((double)(i + 1) / STEPS, most))) > 0.0)
            return (double)i / STEPS;
    return most;
}

/* On the axis, at a diagonal, with the filter alone and rounding that favours it: the least angle in tenths where a
 * texel is nearer than the point. No API takes m for more than sqrt(1/2) of the change over a diagonal. */
static double acne_from(const shadow_light *light, const ground *g, const shadow_need *need,
                        const shadow_given *given) {
    const double texels = fmax(light->kernel - 0.7072 * given->factor, 0.0), most = light->triangles.slant_hi;
    const double inverse = light->kind == SHADOW_SUN ? 0.0 : 1.0 / g->z;
    const double along = (given->window_most + need->window) * g->depth;
    for (int i = 1; i <= (int)floor(most * STEPS + 1e-9); i++) {
        const double angle = shadow_radians((double)i / STEPS), moved = given->offset * grown(given->growth, angle);
        const double across = texels * g->diagonal * dp_sin(angle), facing = inverse / dp_cos(angle);
        const double left = 1.0 - moved * facing;
        const double lacking = across / (shadow_holds_distance(light) ? 1.0 + across * facing : 1.0);
        /* Nearer by what it moved along the normal, the point gains a little more along the ray. */
        if (left > 0.5 && lacking > moved / left + along * dp_cos(angle) / (left * (2.0 * left - 1.0)))
            return (double)i / STEPS;
    }
    return (double)NAN;
}

static balance balance_of(const shadow_light *light, const shadow_given *given, const shadow_need *need) {
    const ground near = shadow_ground_at(light, light->receiver_lo), far = shadow_ground_at(light, light->receiver_hi);
    /* The slope of a texel is at least what makes 1 of the factor worth so many texels on each axis. */
    const shadow_bias *slope = &need->bias[SHADOW_SLOPE];
    const double worth = slope->factor > 0.0 && isfinite(slope->factor) ? need->texels / slope->factor : 0.0;
    const bool covered = given->factor >= slope->factor;
    const double rest = given->factor > 0.0 ? slope->window : need->window;
    const bool placed = light->kind != SHADOW_SUN;
    const double other = placed ? far.z : 1.0, first = near.depth / (placed ? near.z : 1.0), last = far.depth / other;
    return (balance){.across = covered ? 0.0 : fmax(need->texels - given->factor * worth, 0.0) * far.diagonal / other,
                     .along = (given->level - rest) * (given->level > rest ? fmin(first, last) : fmax(first, last)),
                     .ray = given->ray_share,
                     .offset = given->offset_share,
                     .corner = !placed || shadow_holds_distance(light)
                                   ? 0.0
                                   : near.corner + need->texels * near.pitch, /* lookups leave a face */
                     .growth = given->growth};
}

double shadow_lacking(const shadow_light *light, const shadow_given *given, double angle) {
    shadow_need need;
    shadow_need_of(light, &need);
    const balance b = balance_of(light, given, &need);
    const double slant = shadow_radians(angle);
    return lacks(&b, slant, slant) / dp_cos(slant) * (light->kind == SHADOW_SUN ? 1.0 : light->receiver_hi);
}

shadow_verdict shadow_judge(const shadow_light *light, const shadow_given *given) {
    const ground near = shadow_ground_at(light, light->receiver_lo), far = shadow_ground_at(light, light->receiver_hi);
    const double most = light->triangles.slant_hi;
    const bool placed = light->kind != SHADOW_SUN;
    shadow_need need;
    shadow_need_of(light, &need);
    const balance b = balance_of(light, given, &need);
    shadow_verdict v = {.free = free_up_to(&b, most), .acne = acne_from(light, &near, &need, given)};
    const double turned = grown(given->growth, shadow_radians(most));
    const bool sines = light->kind == SHADOW_SUN || shadow_holds_distance(light);
    const double sine = dp_sin(shadow_radians(most));
    /* A point that is moved by a length has a gap of that to its caster, whose depth is the smaller one. */
    const double length = given->ray_most,
                 depths = placed && !shadow_holds_distance(light) ? 1.0 + length / far.z : 1.0;
    shadow_bias set = {.window = given->added + length / (far.depth * depths),
                       .factor = given->factor,
                       .offset = given->offset_most == 0.0
                                     ? 0.0
                                     : given->offset_most * turned / (sines ? fmax(sine, 1e-9) : 1.0) /
                                           (light->kind == SHADOW_SUN ? 1.0 : far.z)};
    double normal;
    if (given->units > 0.0)
        set.window += shadow_casters_window(light, &set, given->api, given->units);
    shadow_gap_at(light, &set, most, &v.gap, &normal);
    return v;
}

/* The next of the parts that are judged one by one, of a sun all at once; false behind the last. */
static bool next_part(const shadow_light *light, double *z, shadow_light *part) {
    static const double step = 1.0905077326652577; /* eight in an octave */
    if (!(*z <= light->receiver_hi))
        return false;
    *part = *light;
    if (light->kind == SHADOW_SUN) {
        *z = (double)INFINITY;
        return true;
    }
    part->receiver_lo = *z;
    *z *= step;
    part->receiver_hi = fmin(*z, light->receiver_hi);
    return true;
}

shadow_verdict shadow_judge_all(const shadow_engine *engine, const shadow_light *light, const bias_api *api,
                                double bias, double normal) {
    shadow_verdict worst = {.free = light->triangles.slant_hi, .acne = (double)NAN};
    shadow_light part;
    for (double z = light->receiver_lo; next_part(light, &z, &part);) {
        const shadow_given given = shadow_engine_gives(engine, &part, api, bias, normal);
        const shadow_verdict v = shadow_judge(&part, &given);
        worst.free = fmin(worst.free, v.free);
        worst.acne = fmin(worst.acne, v.acne); /* of a number and none the number */
        worst.gap = fmax(worst.gap, v.gap);
    }
    return worst;
}

/* ---- The same in another engine ---------------------------------------------------------------------------------- */

double shadow_bias_as(const shadow_engine *engine, const shadow_light *light, const bias_api *api, double window) {
    const ground g = shadow_ground_at(light, light->receiver_lo);
    const shadow_given none = shadow_engine_gives(engine, light, api, 0.0, 0.0);
    const shadow_given one = shadow_engine_gives(engine, light, api, 1.0, 0.0);
    const shadow_measure in = engine->bias_in[light->kind];
    const double scale = engine->bias_scale[light->kind] * soft_by(engine, light), wanted = window - none.window_most;
    const double length = scale * length_of(in, light, &g), ray = wanted * g.depth;
    if (in == SHADOW_IN_NOTHING || one.window_most == none.window_most)
        return (double)NAN;
    if (in == SHADOW_IN_WINDOW || in == SHADOW_IN_UNITS || in == SHADOW_IN_CLIP)
        return wanted / (one.window_most - none.window_most);
    return (light->kind == SHADOW_SUN || shadow_holds_distance(light) ? ray : ray * g.z / (g.z + ray)) / length;
}

double shadow_normal_as(const shadow_engine *engine, const shadow_light *light, double offset) {
    const ground g = shadow_ground_at(light, light->receiver_lo);
    const shadow_measure in = engine->normal_in[light->kind];
    const double one = engine->normal_scale[light->kind] * soft_by(engine, light) * length_of(in, light, &g) *
                       grown(engine->growth[light->kind], shadow_radians(light->triangles.slant_hi));
    return in == SHADOW_IN_NOTHING || one == 0.0 ? (double)NAN : offset / one;
}

double shadow_given_offset(const shadow_given *given, double angle) {
    return given->offset * grown(given->growth, shadow_radians(angle));
}

/* ---- The least that is enough ------------------------------------------------------------------------------------ */

/* A number of an engine that is sought, beside the other one. */
typedef struct sought {
    const shadow_engine *engine;
    const bias_api *api;
    double other, sign;
    bool of_normal;
} sought;

static bool is_enough(const sought *s, const shadow_light *part, double magnitude) {
    const double x = s->sign * magnitude;
    const shadow_given given =
        shadow_engine_gives(s->engine, part, s->api, s->of_normal ? s->other : x, s->of_normal ? x : s->other);
    return shadow_judge(part, &given).free >= part->triangles.slant_hi;
}

/* The least in one part that is above `lo`, which is not enough there; infinite beyond `bound`. */
static double least_in(const sought *s, const shadow_light *part, double lo, double first, double bound) {
    double hi = fmax(2.0 * lo, first);
    for (; !is_enough(s, part, hi); lo = hi, hi *= 2.0)
        if (!(hi <= bound))
            return (double)INFINITY;
    while (hi - lo > 1e-6 * hi) {
        const double mid = 0.5 * (lo + hi);
        *(is_enough(s, part, mid) ? &hi : &lo) = mid;
    }
    return hi;
}

/* All parts are asked: what is enough so far is tried in the next, and grows where it is not. At one of the ends it is
 * largest as a rule, so both come first. */
static double least(const shadow_engine *engine, const shadow_light *light, const bias_api *api, double other,
                    bool of_normal) {
    const double scale = (of_normal ? engine->normal_scale : engine->bias_scale)[light->kind];
    const double first = 1e-9 / fabs(scale);
    const double bound = 1e6 * fmax(fmin(light->setup.spec.zfar, light->receiver_hi), 1.0) / fabs(scale);
    const sought s = {engine, api, other, scale < 0.0 ? -1.0 : 1.0, of_normal};
    shadow_light part;
    double found = 0.0;
    if ((of_normal ? engine->normal_in : engine->bias_in)[light->kind] == SHADOW_IN_NOTHING)
        return (double)NAN;
    for (double z = light->receiver_lo; next_part(light, &z, &part);)
        continue; /* to the last */
    if (!is_enough(&s, &part, found))
        found = least_in(&s, &part, found, first, bound);
    for (double z = light->receiver_lo; isfinite(found) && next_part(light, &z, &part);)
        if (!is_enough(&s, &part, found))
            found = least_in(&s, &part, found, first, bound);
    return isinf(found) ? (double)NAN : s.sign * found + 0.0; /* no -0 */
}

double shadow_least_bias(const shadow_engine *engine, const shadow_light *light, const bias_api *api, double normal) {
    return least(engine, light, api, normal, false);
}

double shadow_least_normal(const shadow_engine *engine, const shadow_light *light, const bias_api *api, double bias) {
    return least(engine, light, api, bias, true);
}
