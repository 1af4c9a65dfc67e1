/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "probe/plan.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/bits.h"
#include "core/elementary.h"

enum { ACROSS = SHOT_SIZE / PLAN_TILE, SCENE_TRIANGLES = 400 };

double plan_scale(shot_format format) {
    static const double scales[SHOT_FORMATS] = {[SHOT_D16] = 0xFFFF, [SHOT_D24] = 0xFFFFFF, [SHOT_D32F] = 0.0};
    return scales[format];
}

/* ---- Random numbers: the same in every run ----------------------------------------------------------------------- */

typedef struct draws {
    uint64_t seed, next;
} draws;

static uint64_t drawn(draws *d) {
    return dp_draw64(d->seed, d->next++);
}

static double uniform(draws *d, double lo, double hi) {
    return lo + (hi - lo) * dp_uniform(drawn(d));
}

static double spread(draws *d, double lo, double hi) {
    return dp_exp2(uniform(d, dp_log2(lo), dp_log2(hi)));
}

/* ---- Points: one in each pixel ----------------------------------------------------------------------------------- */

/* Clip coordinates of the centre of a pixel, in exact steps of 1/256 times w. */
static void put_point(float v[4], int pixel, float z, float w) {
    const float x = (float)(2 * (pixel % SHOT_SIZE) + 1 - SHOT_SIZE) / SHOT_SIZE;
    const float y = (float)(2 * (pixel / SHOT_SIZE) + 1 - SHOT_SIZE) / SHOT_SIZE;
    v[0] = x * w;
    v[1] = y * w;
    v[2] = z;
    v[3] = w;
}

/* Below 1/8 binary32 has at least eight numbers in each code of 24 bits: two of them, of one code whether it is
 * rounded or truncated. Of fp32 two neighbours. */
static void point_stored(const shot *s, draws *d, int i, float *z, float *w) {
    const double scale = plan_scale(s->format);
    const double k = floor(uniform(d, 1.0, (scale > 0.0 ? scale : 0x1p24) / 8.0));
    *w = 1.0F;
    *z = scale > 0.0 ? (float)((k + 0.2) / scale) : (float)(k * 0x1p-24);
    put_point(s->second[i], i, scale > 0.0 ? (float)((k + 0.4) / scale) : nextafterf(*z, 1.0F), 1.0F);
}

/* Around each tie and each code, where truncation steps; 1/2 is the only tie that binary32 has. */
static void point_rounding(const shot *s, draws *d, int i, float *z, float *w) {
    static const double fractions[8] = {0.5, 0.5, 0.5, 0.25, 0.75, 0.0, 0.0, 0.0};
    const double scale = plan_scale(s->format);
    const double k = floor(uniform(d, 0.0, scale));
    *w = 1.0F;
    *z = (float)((k + fractions[drawn(d) % 8]) / scale);
    for (uint64_t left = drawn(d) % 5; left > 0; left--)
        *z = nextafterf(*z, (drawn(d) & 1) != 0 ? 2.0F : -1.0F);
    *z = i < 16 ? 0.5F : i < 32 ? 1.0F : i < 48 ? 0.0F : fminf(fmaxf(*z, 0.0F), 1.0F);
}

static void point_division(const shot *s, draws *d, int i, float *z, float *w) {
    (void)s;
    (void)i;
    *w = (float)spread(d, 0x1p-10, 0x1p20);
    *z = *w * (float)spread(d, 0x1p-20, 0.999);
}

/* Eye depths that both planes keep, however a z + b is rounded. */
static void point_projection(const shot *s, draws *d, int i, float *z, float *w) {
    (void)s;
    *w = *z = (float)spread(d, 0.11, 99.0);
    if (s->again)
        put_point(s->second[i], i, *z, *w);
}

/* Inside, on and beside the planes, and subnormal. */
static void point_planes(const shot *s, draws *d, int i, float *z, float *w) {
    (void)s;
    *w = (drawn(d) & 1) != 0 ? 1.0F : (float)spread(d, 0.5, 2.0);
    switch (i % 8) {
    case 0:
        *z = 0.0F;
        break;
    case 1:
        *z = -0.0F;
        break;
    case 2:
        *z = *w;
        break;
    case 3:
        *z = nextafterf(*w, 4.0F);
        break;
    case 4:
        *z = nextafterf(*w, 0.0F);
        break;
    case 5:
        *z = (float)-spread(d, 0x1p-125, 1.0);
        break;
    case 6:
        *z = *w * (float)uniform(d, 1.0, 1.0 + 0x1p-20);
        break;
    default:
        *w = 1.0F;
        *z = dp_float32(1U + (uint32_t)(drawn(d) % 0x7FFFFFU));
    }
}

/* Where the logarithm lies in [0, 1] an absolute error is allowed, above it a relative one. */
static void point_log2(const shot *s, draws *d, int i, float *z, float *w) {
    (void)s;
    *w = 1.0F;
    *z = i % 2 == 0 ? (float)uniform(d, 1.0, 2.0) : (float)spread(d, 2.0, 0x1.fp63);
}

static void point_quotient(const shot *s, draws *d, int i, float *z, float *w) {
    (void)s;
    (void)i;
    *w = (float)spread(d, 0x1p-20, 0x1p20);
    *z = *w * (float)spread(d, 0x1p-10, 0.999);
}

/* ---- Triangles --------------------------------------------------------------------------------------------------- */

/* Window coordinates, which clip coordinates of w = 1 hold exactly in steps of 1/2048 pixel. */
static void put_corner(float v[4], float x, float y, float z) {
    v[0] = x / (SHOT_SIZE / 2) - 1.0F;
    v[1] = y / (SHOT_SIZE / 2) - 1.0F;
    v[2] = z;
    v[3] = 1.0F;
}

/* Corners about the middle of a tile, (8.5, 8.5): the middle inside, and on an upright edge to the right. */
static const float wide[3][2] = {{-6.0F, -6.0F}, {6.0F, -6.0F}, {0.0F, 6.0F}};
static const float beside[3][2] = {{-6.0F, 0.0F}, {0.0F, -6.0F}, {0.0F, 6.0F}};

static void put_tile(float (*v)[4], int tile, const float corner[3][2], float dx, const plan_tile *depth) {
    const float x0 = (float)(tile % ACROSS * PLAN_TILE) + 8.5F, y0 = (float)(tile / ACROSS * PLAN_TILE) + 8.5F;
    for (int i = 0; i < 3; i++) {
        const float x = corner[i][0], y = corner[i][1];
        put_corner(v[i], x0 + x + dx, y0 + y, depth->z + depth->slope_x * x + depth->slope_y * y);
    }
}

plan_tile plan_tile_of(shot_format format, int tile) {
    draws d = {0xB1A5, (uint64_t)tile * 8};
    const double scale = plan_scale(format);
    if (tile % 4 < PLAN_FLAT && scale > 0.0) /* a quarter above a code, which 1/2 more moves to the next one */
        return (plan_tile){(float)((floor(uniform(&d, 0.1, 0.9) * scale) + 0.25) / scale), 0.0F, 0.0F};
    if (tile % 4 < PLAN_FLAT) { /* the first numbers of a binade, and others of it */
        const double binade = ldexp(1.0, -1 - (int)(drawn(&d) % 20));
        const double whole = tile % 4 == 0 ? 1.0 : tile % 4 == 1 ? 1.0 + 0x1p-23 : uniform(&d, 1.1, 1.9);
        return (plan_tile){(float)(whole * binade), 0.0F, 0.0F};
    }
    return (plan_tile){0.5F, (float)uniform(&d, -0.03, 0.03), (float)uniform(&d, -0.03, 0.03)};
}

double plan_edge(int tile) {
    const double k = tile - PLAN_TILES / 2;
    return rint(k * fabs(k) / 32.0) / 8192.0;
}

static void tiles(shot *s, plan_shot kind) {
    for (int i = 0; i < PLAN_TILES; i++) {
        const plan_tile steep = {0.5F, PLAN_STEEP, 0.0F}, flat = {0.5F, 0.0F, 0.0F};
        const plan_tile own = plan_tile_of(s->format, i);
        if (kind == PLAN_PLANE)
            put_tile(&s->vertex[3 * i], i, wide, (float)i / PLAN_STEPS, &steep);
        else if (kind == PLAN_COVERAGE)
            put_tile(&s->vertex[3 * i], i, beside, (float)plan_edge(i), &flat);
        else
            put_tile(&s->vertex[3 * i], i, wide, 0.0F, &own);
    }
}

/* Small and large triangles, slanted by a perspective of near 0.1 and far 100; some are cut by the screen's edges. */
static void scene(shot *s, uint64_t seed) {
    draws d = {seed, 0};
    const float a = 100.0F / 99.9F, b = -10.0F / 99.9F;
    for (int i = 0; i < SCENE_TRIANGLES; i++) {
        const double x0 = uniform(&d, -1.1, 1.1), y0 = uniform(&d, -1.1, 1.1), size = spread(&d, 0.02, 1.0);
        for (int k = 0; k < 3; k++) {
            float *v = s->vertex[3 * i + k];
            const float w = (float)spread(&d, 0.15, 90.0);
            v[0] = (float)(x0 + uniform(&d, -size, size)) * w;
            v[1] = (float)(y0 + uniform(&d, -size, size)) * w;
            v[2] = a * w + b;
            v[3] = w;
        }
    }
}

/* ---- The plan ---------------------------------------------------------------------------------------------------- */

enum { D16 = 1 << SHOT_D16, D24 = 1 << SHOT_D24, D32F = 1 << SHOT_D32F, EACH = D16 | D24 | D32F };

static const struct {
    const char *name;
    unsigned formats;
    shot_program program;
    float a, b;
    void (*point)(const shot *, draws *, int, float *, float *); /* null: triangles */
    uint32_t count;                                              /* of triangles */
    float constant, slope;
    bool again;
    shot_program other;
} kinds[PLAN_SHOTS] = {
    [PLAN_STORED] = {"stored", EACH, .point = point_stored, .again = true},
    [PLAN_ROUNDING] = {"rounding", D16 | D24, .point = point_rounding},
    [PLAN_DIVISION] = {"division", D32F, .point = point_division},
    [PLAN_PROJECTION] = {"projection", D32F, SHOT_PROJECT, 100.0F / 99.9F, -10.0F / 99.9F, .point = point_projection},
    [PLAN_PLANE] = {"plane", D32F, .count = PLAN_TILES},
    [PLAN_COVERAGE] = {"coverage", D32F, .count = PLAN_TILES},
    [PLAN_UNBIASED] = {"unbiased", EACH, .count = PLAN_TILES},
    [PLAN_CONSTANT] = {"constant", EACH, .count = PLAN_TILES, .constant = PLAN_BIAS},
    [PLAN_FRACTION] = {"fraction", D16 | D24, .count = PLAN_TILES, .constant = PLAN_BIAS + 0.5F},
    [PLAN_SLOPED] = {"sloped", D32F, .count = PLAN_TILES, .slope = 1.0F},
    [PLAN_PLANES] = {"planes", D32F, .point = point_planes},
    [PLAN_INVARIANCE] = {"invariance", D32F, SHOT_PROJECT, 100.0F / 99.9F, -10.0F / 99.9F, point_projection,
                         .again = true, .other = SHOT_PROJECT_MORE},
    [PLAN_LOG2] = {"log2", D32F, SHOT_LOG2, PLAN_LOG2_SCALE, .point = point_log2},
    [PLAN_QUOTIENT] = {"quotient", D32F, SHOT_QUOTIENT, .point = point_quotient},
    [PLAN_SCENE] = {"scene", EACH, .count = SCENE_TRIANGLES},
    [PLAN_PREDICTED] = {"predicted", EACH, .count = SCENE_TRIANGLES},
};

static void fill_points(shot *s, plan_shot kind) {
    draws d = {0x5EED + (uint64_t)kind, 0};
    for (int i = 0; i < SHOT_PIXELS; i++) {
        float z, w;
        kinds[kind].point(s, &d, i, &z, &w);
        put_point(s->vertex[i], i, z, w);
        if (s->program >= SHOT_LOG2) /* whose clip w is 1 */
            put_point(s->vertex[i], i, z, 1.0F), s->vertex[i][3] = w;
    }
}

static bool fill(shot *s, plan_shot kind, shot_format format, uint64_t seed) {
    const bool points = kinds[kind].point != NULL;
    *s = (shot){.name = kinds[kind].name,
                .format = format,
                .program = kinds[kind].program,
                .a = kinds[kind].a,
                .b = kinds[kind].b,
                .triangles = !points,
                .constant = kinds[kind].constant,
                .slope = kinds[kind].slope,
                .count = points ? SHOT_PIXELS : 3 * kinds[kind].count,
                .again = kinds[kind].again,
                .other = kinds[kind].other};
    s->vertex = calloc(s->count, sizeof *s->vertex);
    s->second = s->again ? calloc(s->count, sizeof *s->second) : NULL;
    s->code = calloc(SHOT_PIXELS, sizeof *s->code);
    if (s->vertex == NULL || s->code == NULL || (s->again && s->second == NULL))
        return false;
    if (points)
        fill_points(s, kind);
    else if (kind == PLAN_SCENE || kind == PLAN_PREDICTED)
        scene(s, kind == PLAN_SCENE ? 0x5CE4E : ~seed);
    else
        tiles(s, kind);
    return true;
}

bool plan_make(shot_plan *plan, uint64_t seed) {
    *plan = (shot_plan){.shot = calloc((size_t)PLAN_SHOTS * SHOT_FORMATS, sizeof *plan->shot)};
    for (int kind = 0; plan->shot != NULL && kind < PLAN_SHOTS; kind++)
        for (int format = 0; format < SHOT_FORMATS; format++)
            if ((kinds[kind].formats >> format & 1U) != 0 &&
                !fill(&plan->shot[plan->count++], (plan_shot)kind, (shot_format)format, seed))
                return false;
    return plan->shot != NULL;
}

void plan_free(shot_plan *plan) {
    for (size_t i = 0; i < plan->count; i++) {
        free(plan->shot[i].vertex);
        free(plan->shot[i].second);
        free(plan->shot[i].code);
    }
    free(plan->shot);
    *plan = (shot_plan){0};
}

shot *plan_find(const shot_plan *plan, plan_shot kind, shot_format format) {
    for (size_t i = 0; i < plan->count; i++)
        if (plan->shot[i].name == kinds[kind].name && plan->shot[i].format == format)
            return &plan->shot[i];
    return NULL;
}
