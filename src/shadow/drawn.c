/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "shadow/drawn.h"

#include <math.h>

#include "bias/drawn.h"
#include "core/bits.h"
#include "core/elementary.h"

enum { PLANE = 0, FARTHER, NEARER, LAYERS };

/* Planes nearer to edge-on than that have no depth. */
static const double least_facing = 1e-9;

/* ---- The map ----------------------------------------------------------------------------------------------------- */

/* The sun's positions are relative to the middle of its box, as the promise has them. */
static double middle_of(const shadow_light *light) {
    return light->kind == SHADOW_SUN ? 0.5 * (light->setup.spec.znear + light->setup.spec.zfar) : 0.0;
}

raster_status shadow_drawing_open(shadow_drawing *d, const raster_row *row, const shadow_light *light) {
    const dp_triangles *t = &light->triangles;
    const double middle = middle_of(light);
    dp_setup setup;
    dp_spec spec = light->setup.spec;
    bool room = true;
    *d = (shadow_drawing){.light = light};
    for (int k = 0; k < LAYERS; k++)
        room = draw_buffer_open(&d->layer[k], SHADOW_DRAWN_SIDE * SHADOW_DRAWN_SIDE) && room;
    spec.znear -= middle;
    spec.zfar -= middle;
    if (shadow_holds_distance(light) || !room ||
        !raster_arith(row, dp_mapping_get(spec.mapping)->ndc_signed != 0, &spec.arith) ||
        dp_setup_init(&setup, &spec) != DP_OK)
        return RASTER_MODEL;
    setup.spec.triangles = *t;
    setup.spec.triangles.fov_y = light->kind == SHADOW_SUN ? 90.0 : light->fov;
    const raster_status status = draw_camera_init(&d->camera, row, &setup);
    if (status == RASTER_OK && light->kind == SHADOW_SUN) {
        d->camera.p00 = (float)(2.0 / light->width);
        d->camera.p11 = (float)(2.0 / light->height);
    }
    return status;
}

void shadow_drawing_close(shadow_drawing *d) {
    for (int k = 0; k < LAYERS; k++)
        draw_buffer_close(&d->layer[k]);
}

static float offset_of(const void *of, float most, float slope) {
    const shadow_drawing *d = of;
    const bias_state *state = &d->state;
    const double r = bias_unit_at(state->api, &d->light->setup.spec.format, (double)most).least;
    return (float)bias_offset(state, r, (double)slope);
}

/* ---- A plane and its casters ------------------------------------------------------------------------------------- */

static double inner(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Two unit vectors square to a ray and to each other. */
static void across_ray(const double ray[3], double a[3], double b[3]) {
    const double length = dp_hypot(ray[2], ray[0]);
    a[0] = ray[2] / length;
    a[1] = 0.0;
    a[2] = -ray[0] / length;
    b[0] = ray[1] * a[2];
    b[1] = ray[2] * a[0] - ray[0] * a[2];
    b[2] = -ray[1] * a[0];
}

/* The direction in which the light goes at a place of the map, a unit vector. */
static void ray_at(const shadow_drawing *d, const double window[2], double ray[3]) {
    if (d->light->kind == SHADOW_SUN) {
        ray[0] = ray[1] = 0.0;
        ray[2] = 1.0;
        return;
    }
    draw_ray(&d->camera, window, ray);
    const double length = sqrt(inner(ray, ray));
    for (int i = 0; i < 3; i++)
        ray[i] /= length;
}

static int clamped(int x, int lo, int hi) {
    return x < lo ? lo : x > hi ? hi : x;
}

static draw_area area_about(const shadow_drawing *d, int x, int y) {
    const int half = SHADOW_DRAWN_SIDE / 2, width = d->camera.target.width, height = d->camera.target.height;
    const int left = clamped(x - half, 0, width), low = clamped(y - half, 0, height);
    return (draw_area){left, low, clamped(x + half, 0, width) - left, clamped(y + half, 0, height) - low};
}

bool shadow_scene_random(const shadow_drawing *d, uint64_t *state, shadow_scene *out) {
    const shadow_light *light = d->light;
    const dp_triangles *t = &light->triangles;
    const int x = (int)(draw_random(state) % (uint64_t)t->width), y = (int)(draw_random(state) % (uint64_t)t->height);
    const double window[2] = {x + 0.5, y + 0.5}, share = draw_uniform(state);
    const bool steep = draw_random(state) % 2 != 0, diagonal = draw_random(state) % 2 != 0;
    const double turn = draw_uniform(state), lo = light->receiver_lo, hi = light->receiver_hi;
    const double azimuth = diagonal ? M_PI * (0.5 * floor(4.0 * turn) + 0.25) : 2.0 * M_PI * turn;
    const double far_off = light->setup.spec.zfar, most = isfinite(hi) ? hi : fmin(far_off, 1e6 * lo);
    double ray[3], a[3], b[3], place[3];
    *out = (shadow_scene){.area = area_about(d, x, y)};
    out->slant = t->slant_hi * (steep ? 1.0 - 0.1 * share : share);
    out->z = light->kind == SHADOW_SUN ? lo + (most - lo) * draw_uniform(state) : draw_log_uniform(state, lo, most);
    const double angle = out->slant * DP_DEGREE;
    ray_at(d, window, ray);
    across_ray(ray, a, b);
    for (int i = 0; i < 3; i++)
        out->plane.normal[i] =
            dp_cos(angle) * ray[i] + dp_sin(angle) * (dp_cos(azimuth) * a[i] + dp_sin(azimuth) * b[i]);
    draw_at(&d->camera, window, out->z - middle_of(light), place);
    out->plane.distance = inner(out->plane.normal, place);
    out->mesh = draw_mesh_random(t, window, state);
    out->mesh.lowest = BIAS_DRAWN_LOWEST;
    return isfinite(draw_depth(&d->camera, &out->plane, window)) && inner(out->plane.normal, ray) > least_facing;
}

/* The plane, so much nearer to the light along its ray. */
static draw_plane raised(const shadow_drawing *d, const shadow_scene *scene, double by) {
    draw_plane plane = scene->plane;
    if (d->light->kind == SHADOW_SUN)
        plane.distance -= by * plane.normal[2];
    else
        plane.distance *= (scene->z - by) / scene->z;
    return plane;
}

/* The nearest and the farthest of its points that may be asked about. */
static void depths_of(const shadow_drawing *d, const shadow_scene *scene, double *lo, double *hi) {
    const shadow_light *light = d->light;
    const draw_area *a = &scene->area;
    *lo = *hi = scene->z;
    for (int k = 0; k < 4; k++) {
        const double window[2] = {a->x + (k % 2) * a->width, a->y + (k / 2) * a->height};
        const double z = draw_depth(&d->camera, &scene->plane, window) + middle_of(light);
        *lo = z > 0.0 ? fmin(*lo, z) : *lo;
        *hi = z > 0.0 ? fmax(*hi, z) : light->receiver_hi; /* turned away from the light in that corner */
    }
    *lo = fmax(*lo, light->receiver_lo);
    *hi = fmin(*hi, light->receiver_hi);
}

static double gap_of(const shadow_light *part, const shadow_bias *bias, const bias_api *api, double units) {
    shadow_state state = {.units = units, .factor = bias->factor};
    shadow_state_widen(part, bias, api, &state);
    return state.gap_light;
}

void shadow_scene_stand(shadow_drawing *d, const shadow_scene *scene, const shadow_need *need) {
    const bool sun = d->light->kind == SHADOW_SUN;
    const shadow_bias *constant = &need->bias[SHADOW_CONSTANT];
    shadow_light asked = *d->light;
    double lo, hi, most = 0.0;
    depths_of(d, scene, &lo, &hi);
    asked.receiver_lo = lo;
    asked.receiver_hi = hi;
    for (int k = 0; k < SHADOW_WAY_COUNT; k++) {
        const shadow_state state = shadow_state_of(d->light, &need->bias[k], d->api);
        if (isfinite(state.units) && isfinite(need->bias[k].factor) && isfinite(need->bias[k].offset))
            most = fmax(most, gap_of(&asked, &need->bias[k], d->api, state.units));
    }
    const double kappa = d->light->setup.kappa;
    d->beyond = (most + constant->window * kappa * (sun ? 1.0 : hi * hi)) * (1.0 + 1e-6);
    d->beyond *= sun ? 1.0 : scene->z / lo; /* they come nearer with the plane */
    d->within = 0.5 * constant->window * kappa * (sun ? 1.0 : lo * lo / (1.0 + constant->window * kappa * lo));
}

/* The bias that an engine's numbers give receivers at that depth. */
static shadow_given given_at(const shadow_drawing *d, double z) {
    shadow_light at = *d->light;
    at.receiver_lo = at.receiver_hi = z;
    return shadow_engine_gives(d->worn.engine, &at, d->api, d->worn.bias, d->worn.normal);
}

void shadow_scene_draw(shadow_drawing *d, const shadow_scene *scene, const shadow_worn *worn) {
    const double by[LAYERS] = {0.0, d->beyond, d->within};
    draw_camera camera = d->camera;
    d->worn = *worn;
    d->state = worn->state;
    if (worn->engine != NULL) /* its constant part is taken off the points */
        d->state = (bias_state){d->api, 0.0, shadow_sign(d->light) * given_at(d, scene->z).factor, 0.0};
    camera.bias = d->state.units != 0.0 || d->state.factor != 0.0 ? offset_of : NULL;
    camera.bias_of = d;
    for (int k = 0; k < LAYERS; k++) {
        const draw_plane plane = raised(d, scene, by[k]);
        draw_buffer_clear(&d->layer[k], scene->area);
        if (k == PLANE || (by[k] > 0.0 && (d->light->kind == SHADOW_SUN || by[k] < scene->z)))
            draw_mesh_plane(&d->layer[k], &camera, &plane, &scene->mesh, &d->light->triangles, 1);
    }
}

/* ---- Points ------------------------------------------------------------------------------------------------------ */

/* A point as the shader looks it up: place in the map, texels, and the depth that is compared. */
typedef struct looked_up {
    double at[2];
    float depth;
} looked_up;

static looked_up look_up(const shadow_drawing *d, const shadow_scene *scene, const double place[3], double cosine) {
    const shadow_light *light = d->light;
    const double z = place[2] + middle_of(light), sine = sqrt(fmax(1.0 - cosine * cosine, 0.0));
    double moved = d->worn.offset * (light->kind == SHADOW_SUN ? sine : z), window = 0.0, point[3];
    if (d->worn.engine != NULL) {
        const shadow_given given = given_at(d, z);
        const double most = given.offset != 0.0 ? given.offset_most / given.offset : 1.0;
        moved = shadow_given_offset(&given, dp_atan2(sine, cosine) / DP_DEGREE) * most;
        window = given.window_most;
    }
    for (int i = 0; i < 3; i++)
        point[i] = (double)((float)place[i] - (float)moved * (float)scene->plane.normal[i]);
    const raster_vertex clip = draw_clip(&d->camera, point);
    const float depth = dp_pipeline_window(&d->camera.pipeline, (float)point[2]);
    return (looked_up){{(double)((clip.x / clip.w * 0.5F + 0.5F) * (float)d->camera.target.width),
                        (double)((clip.y / clip.w * 0.5F + 0.5F) * (float)d->camera.target.height)},
                       depth - (float)(shadow_sign(light) * window)};
}

/* The texels that are read, by who stands before them: the plane alone, or a caster; and how many pass light. */
typedef struct texels_read {
    int count[LAYERS], lit[LAYERS];
} texels_read;

static bool passes(const shadow_drawing *d, uint32_t key, float depth) {
    const dp_format *format = &d->light->setup.spec.format;
    const uint32_t code = draw_code(&d->camera, key);
    const float stored =
        format->kind == DP_FORMAT_FLOAT ? dp_float32(code) : (float)((double)code / (double)format->code_max);
    return d->light->setup.reversed ? depth >= stored : depth <= stored;
}

/* False where a texel is not drawn. */
static bool read_texel(const shadow_drawing *d, const draw_area *area, int x, int y, float depth, texels_read *out) {
    const int right = x - area->x, up = y - area->y;
    if (right < 0 || right >= area->width || up < 0 || up >= area->height)
        return false;
    const size_t at = (size_t)up * (size_t)area->width + (size_t)right;
    const int before = 2 * right < area->width ? PLANE : 2 * up < area->height ? NEARER : FARTHER;
    const int who = before != PLANE && d->layer[before].seen[at] != 0 ? before : PLANE;
    const uint32_t plane = d->layer[PLANE].key[at], caster = d->layer[who].key[at];
    out->count[who]++;
    out->lit[who] += passes(d, caster < plane ? caster : plane, depth);
    return d->layer[PLANE].seen[at] != 0;
}

static int all_of(const int count[LAYERS]) {
    return count[PLANE] + count[FARTHER] + count[NEARER];
}

static shadow_seen seen_of(const texels_read *read) {
    const int all = all_of(read->count);
    return read->count[PLANE] == all     ? read->lit[PLANE] == all ? SHADOW_SEEN_LIT : SHADOW_SEEN_ACNE
           : read->count[FARTHER] == all ? read->lit[FARTHER] == 0 ? SHADOW_SEEN_DARK : SHADOW_SEEN_LEAK
           : read->count[NEARER] == all  ? read->lit[NEARER] == 0 ? SHADOW_SEEN_SHORT : SHADOW_SEEN_LOST
                                         : SHADOW_SEEN_EDGE;
}

shadow_point shadow_point_at(const shadow_drawing *d, const shadow_scene *scene, double u, double v) {
    const shadow_light *light = d->light;
    const double window[2] = {u, v}, depth = draw_depth(&d->camera, &scene->plane, window);
    const double z = depth + middle_of(light), kernel = light->kernel;
    const shadow_point none = {SHADOW_SEEN_NONE, 0.0};
    texels_read read = {{0}, {0}};
    double ray[3], place[3];
    if (!(z >= light->receiver_lo && z <= light->receiver_hi))
        return none;
    ray_at(d, window, ray);
    const double cosine = inner(scene->plane.normal, ray);
    if (!(cosine >= dp_cos(light->triangles.slant_hi * DP_DEGREE)))
        return none;
    draw_at(&d->camera, window, depth, place);
    const looked_up point = look_up(d, scene, place, fmin(cosine, 1.0));
    if (!(fabs(point.at[0]) < 1e6 && fabs(point.at[1]) < 1e6)) /* moved beyond the light */
        return none;
    const int left = (int)ceil(point.at[0] - 0.5 - kernel), right = (int)floor(point.at[0] - 0.5 + kernel);
    const int low = (int)ceil(point.at[1] - 0.5 - kernel), high = (int)floor(point.at[1] - 0.5 + kernel);
    for (int y = low; y <= high; y++)
        for (int x = left; x <= right; x++)
            if (!read_texel(d, &scene->area, x, y, point.depth, &read))
                return none;
    return (shadow_point){seen_of(&read), (double)all_of(read.lit) / all_of(read.count)};
}

void shadow_scene_count(const shadow_drawing *d, const shadow_scene *scene, shadow_drawn *out) {
    const draw_area *area = &scene->area;
    const double step = 1.0 / SHADOW_DRAWN_POINTS;
    for (int k = 0; k < area->height * SHADOW_DRAWN_POINTS; k++)
        for (int i = 0; i < area->width * SHADOW_DRAWN_POINTS; i++) {
            const double u = area->x + (i + 0.5) * step, v = area->y + (k + 0.5) * step;
            out->of[shadow_point_at(d, scene, u, v).seen]++;
        }
}
