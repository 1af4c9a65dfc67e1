/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "texture/effect.h"

#include <math.h>
#include <string.h>

/* ---- Quantities and outputs -------------------------------------------------------------------------------------- */

static double saturate(double x) {
    return fmin(fmax(x, 0), 1); /* 0 for NaN */
}

/* Of two depths beyond all bounds neither is behind the other. */
static double minus(double a, double b) {
    return a == b ? 0 : a - b;
}

static double times(double a, double b) {
    return a == 0 || b == 0 ? 0 : a * b;
}

static double eye(const dp_setup *setup, const double *p, double z) {
    (void)setup, (void)p;
    return z;
}

static double eye01(const dp_setup *setup, const double *p, double z) {
    (void)p;
    return z / setup->spec.zfar;
}

static double intersection(const dp_setup *setup, const double *p, double z, double reference) {
    (void)setup;
    return saturate(fabs(minus(reference, z)) / p[0]);
}

static double force_field(const dp_setup *setup, const double *p, double z, double reference) {
    (void)setup;
    return (1 - minus(z, reference)) * p[0];
}

static double fog(const dp_setup *setup, const double *p, double z, double reference) {
    (void)reference;
    return saturate(eye01(setup, p, z) * p[0]);
}

static double scan_line(const dp_setup *setup, const double *p, double z, double reference) {
    return saturate(fabs(eye01(setup, p, reference) - eye01(setup, p, z)) / p[0]);
}

enum { WATER_BAND = 0, WATER_RISE };

static double water_height(const dp_setup *setup, const double *p, double z) {
    (void)setup;
    return times(p[WATER_RISE], z);
}

static double water_line(const dp_setup *setup, const double *p, double z, double reference) {
    (void)setup;
    const double below = times(p[WATER_RISE], minus(reference, z));
    return p[WATER_BAND] > 0 ? saturate(below / p[WATER_BAND]) : below > 0;
}

enum { HEIGHT_DENSITY = 0, HEIGHT_START, HEIGHT_END, HEIGHT_RISE };

/* Where end is start, all is before or behind it. */
static double height_share(const dp_setup *setup, const double *p, double z) {
    (void)setup;
    const double above = minus(times(p[HEIGHT_RISE], z), p[HEIGHT_START]);
    return above == 0 ? 0 : above / (p[HEIGHT_END] - p[HEIGHT_START]);
}

static double height_fog(const dp_setup *setup, const double *p, double z, double reference) {
    (void)reference;
    return saturate(height_share(setup, p, z) * p[HEIGHT_DENSITY]);
}

enum { EDGE_THRESHOLD = 0, EDGE_SLOPE };

static double edge(const dp_setup *setup, const double *p, double z, double reference) {
    return fabs(z - reference) / setup->spec.zfar > p[EDGE_THRESHOLD];
}

enum { BLUR_MOVE = 0, BLUR_FOCAL };

/* World position minus the move, seen again: NDC changes by focal move/z, and the velocity is half of that. */
static double velocity(const dp_setup *setup, const double *p, double z) {
    return p[BLUR_FOCAL] / 2 / (setup->spec.ortho ? 1 : z);
}

static double motion_blur(const dp_setup *setup, const double *p, double z, double reference) {
    (void)reference;
    return velocity(setup, p, z) * p[BLUR_MOVE];
}

static double depth_of_field(const dp_setup *setup, const double *p, double z, double reference) {
    return saturate(fabs(eye01(setup, p, z) - eye01(setup, p, reference)) * p[0]);
}

/* ---- Rows -------------------------------------------------------------------------------------------------------- */

#define RISE                                                                                                           \
    { "rise", "how much the pixel's ray rises per unit of eye depth", "scene per scene", -1e6, 1e6, -0.25, false }
#define DEPTH_TEXTURE "shaders on Unity's _CameraDepthTexture"

/* clang-format off */
static const effect_row rows[] = {
    {"intersection", "saturate(|eye - scene|/half-width)",
     {{"half-width", "distance from the surface over which the highlight fades", "scene", 1e-12, 1e12, 0.1, false}},
     0, true, false, "the eye depth of the surface",
     DEPTH_TEXTURE "; Lorach 2007, Soft particles", EFFECT_FADE, eye, intersection},
    {"force-field", "(1 - (scene - eye)) power",
     {{"power", "how fast the glow falls behind the surface", "1/scene", 1e-12, 1e12, 1, false}},
     0, false, false, "the eye depth of the surface", DEPTH_TEXTURE, EFFECT_GAIN, eye, force_field},
    {"fog", "saturate(eye01 density)",
     {{"density", "how thick the fog is at the far plane", "1", 1e-12, 1e12, 1, false}},
     0, false, true, NULL, DEPTH_TEXTURE, EFFECT_CLAMPED, eye01, fog},
    {"scan-line", "saturate(|cur - eye01|/half-width)",
     {{"half-width", "depth over which the line fades, of far", "eye01", 1e-15, 1, 0.01, false}},
     0, true, true, "the depth cur of the line", DEPTH_TEXTURE, EFFECT_FADE, eye01, scan_line},
    {"water-line", "world y < level; with a band, saturate((level - y)/band)",
     {{"band", "height over which the edge is softened, 0 for a hard one", "scene", 0, 1e12, 0, false}, RISE},
     WATER_BAND, true, false, "the level of the water", DEPTH_TEXTURE, EFFECT_FADE, water_height, water_line},
    {"height-fog", "saturate((y - start)/(end - start) density)",
     {{"density", "how thick the fog is at the height end", "1", 1e-12, 1e12, 1, false},
      {"start", "height over the camera where fog begins", "scene", -1e12, 1e12, 0, false},
      {"end", "height over the camera where density is reached", "scene", -1e12, 1e12, -100, false}, RISE},
     HEIGHT_DENSITY, false, false, NULL, DEPTH_TEXTURE, EFFECT_CLAMPED, height_share, height_fog},
    {"edge", "|s1 - s4| > threshold, |s2 - s3| > threshold: Roberts' diagonals of eye01",
     {{"threshold", "difference of two pixels that makes an edge, of far", "eye01", 0, 1, 0.001, false},
      {"slope", "a plane's change of eye depth from one pixel of a diagonal to the other", "scene", 0, 1e12, 0.1,
       false}},
     EDGE_THRESHOLD, true, true, "the first pixel's place in its cell", DEPTH_TEXTURE "; Roberts 1963", EFFECT_STEP,
     eye01, edge},
    {"motion-blur", "(current - last NDC)/2 = move focal/(2 z), the world position taken from the depth",
     {{"move", "sideways motion of the camera since the last frame", "scene", 1e-12, 1e12, 0.1, false},
      {"focal", "NDC per unit of slope: 1/tan(fov/2), orthographic 1/half height", "1", 1e-12, 1e12,
       1.7320508075688772, false}},
     BLUR_MOVE, false, false, NULL, DEPTH_TEXTURE "; Rosado 2007, GPU Gems 3, chapter 27", EFFECT_GAIN, velocity,
     motion_blur},
    {"depth-of-field", "saturate(|eye01 - focus| level)",
     {{"level", "how fast the picture blurs away from the focus", "1", 1e-12, 1e15, 10, false}},
     0, false, true, "the focus", DEPTH_TEXTURE, EFFECT_GAIN, eye01, depth_of_field},
};
/* clang-format on */

const effect_row *effect_get(size_t index) {
    return index < sizeof rows / sizeof rows[0] ? &rows[index] : NULL;
}

bool effect_applies(const effect_row *row, const dp_setup *setup) {
    return !row->eye01 || !isinf(setup->spec.zfar);
}

/* ---- A ramp of the depth ----------------------------------------------------------------------------------------- */

/* The effect at one cell: what errors and limits are taken of. */
typedef struct cell_case {
    const effect_row *row;
    const dp_setup *setup;
    dp_cell cell;
    double first, last; /* the outermost depths that are stored as the cell's code */
} cell_case;

/* Of the quantity, from the stored depth to the farther end. Errors are made of it, as outputs would cancel. */
static double change(const cell_case *at, const double *p) {
    const double seen = at->row->quantity(at->setup, p, at->cell.stored);
    return fmax(fabs(minus(at->row->quantity(at->setup, p, at->cell.lo), seen)),
                fabs(minus(at->row->quantity(at->setup, p, at->cell.hi), seen)));
}

static double fade_error(const cell_case *at, const double *p) {
    const double c = change(at, p), wanted = p[at->row->wanted];
    return wanted > 0 ? fmin(c / wanted, 1) : c > 0;
}

static double fade_limit(const cell_case *at, const double *p, double share) {
    return change(at, p) / share;
}

static double gain_error(const cell_case *at, const double *p) {
    return fmin(change(at, p) * p[at->row->wanted], 1);
}

static double gain_limit(const cell_case *at, const double *p, double share) {
    return share / change(at, p);
}

/*
 * |saturate(p a) - saturate(p b)| of the quantities of the stored depth and of an end; with a > b, a > 0 and c the
 * positive part of b: it grows as p (a - c) up to p = 1/a, where it is 1 - c/a, and falls from there.
 */
typedef struct pair {
    double most, least;
} pair;

static pair pair_at(const cell_case *at, const double *p, double end) {
    const double a = at->row->quantity(at->setup, p, at->cell.stored);
    const double b = at->row->quantity(at->setup, p, end);
    return (pair){fmax(fmax(a, b), 0), fmax(fmin(a, b), 0)};
}

static double clamped_error_of(pair q, double p) {
    return p * q.most <= 1 ? p * minus(q.most, q.least) : fmax(1 - p * q.least, 0);
}

static double clamped_limit_of(pair q, double share) {
    if (isinf(q.most))
        return isinf(q.least) ? HUGE_VAL : 0;
    return q.most - q.least <= share * q.most ? HUGE_VAL : share / (q.most - q.least);
}

static double clamped_error(const cell_case *at, const double *p) {
    const double wanted = p[at->row->wanted];
    return fmax(clamped_error_of(pair_at(at, p, at->cell.lo), wanted),
                clamped_error_of(pair_at(at, p, at->cell.hi), wanted));
}

static double clamped_limit(const cell_case *at, const double *p, double share) {
    return fmin(clamped_limit_of(pair_at(at, p, at->cell.lo), share),
                clamped_limit_of(pair_at(at, p, at->cell.hi), share));
}

/* ---- A step ------------------------------------------------------------------------------------------------------ */

/*
 * The difference of two stored depths over all places of the first in its cell, the second `slope` behind it: stored
 * depths are monotone, so its ends belong to the ends of the cell. False where the plane leaves the far plane.
 */
static bool differences(const cell_case *at, double slope, double out[2]) {
    const double zfar = at->setup->spec.zfar;
    if (at->first + slope > zfar)
        return false;
    const double last = fmin(at->last + slope, zfar);
    out[0] = (dp_stored(at->setup, dp_code(at->setup, at->first + slope)) - at->cell.stored) / zfar;
    out[1] = (dp_stored(at->setup, dp_code(at->setup, last)) - at->cell.stored) / zfar;
    return true;
}

static double step_error(const cell_case *at, const double *p) {
    const double plane = p[EDGE_SLOPE] / at->setup->spec.zfar;
    double d[2];
    if (!differences(at, p[EDGE_SLOPE], d))
        return 0;
    return plane > p[EDGE_THRESHOLD] ? d[0] <= p[EDGE_THRESHOLD] : d[1] > p[EDGE_THRESHOLD];
}

/* Wrong are the thresholds from d[0] to the plane's own difference, and from there to d[1]. */
static double step_limit(const cell_case *at, const double *p, double share) {
    const double plane = p[EDGE_SLOPE] / at->setup->spec.zfar;
    double d[2];
    (void)share;
    if (!differences(at, p[EDGE_SLOPE], d) || (d[0] >= plane && d[1] <= plane))
        return 0;
    return fmax(plane, d[1]);
}

/* ---- Errors and limits ------------------------------------------------------------------------------------------- */

static const struct {
    double (*error)(const cell_case *, const double *);
    double (*limit)(const cell_case *, const double *, double share);
} kinds[] = {
    [EFFECT_FADE] = {fade_error, fade_limit},
    [EFFECT_GAIN] = {gain_error, gain_limit},
    [EFFECT_CLAMPED] = {clamped_error, clamped_limit},
    [EFFECT_STEP] = {step_error, step_limit},
};

static const double LEVELS = 255;
enum { CELL_ULPS = 16 };

/* An end of a cell is rounded, so it may lie a little outside. */
static double inside(const dp_setup *setup, uint32_t code, double end, double z) {
    for (int i = 0; i < CELL_ULPS; i++, end = nextafter(end, z))
        if (dp_code(setup, end) == code)
            return end;
    return z;
}

static cell_case case_at(const effect_row *row, const dp_setup *setup, double z) {
    cell_case at = {.row = row, .setup = setup};
    const uint32_t code = dp_code(setup, z);
    at.cell = dp_cell_of(setup, code);
    if (row->kind == EFFECT_STEP) {
        at.first = inside(setup, code, at.cell.lo, z);
        at.last = inside(setup, code, at.cell.hi, z);
    }
    return at;
}

static bool has_error(const cell_case *at) {
    return effect_applies(at->row, at->setup) && at->setup->spec.model != DP_MODEL_FP32;
}

static double error_in(const cell_case *at, const double *parameters) {
    return LEVELS * kinds[at->row->kind].error(at, parameters);
}

double effect_error(const effect_row *row, const dp_setup *setup, const double *parameters, double z) {
    const cell_case at = case_at(row, setup, z);
    return has_error(&at) ? error_in(&at, parameters) : (double)NAN;
}

double effect_error_within(const effect_row *row, const dp_setup *setup, const double *parameters,
                           const effect_depths *depths) {
    const cell_case at = {.row = row,
                          .setup = setup,
                          .cell = {.stored = depths->seen, .lo = depths->lo, .hi = depths->hi},
                          .first = depths->lo,
                          .last = depths->hi};
    if (!has_error(&at))
        return NAN;
    if (row->kind != EFFECT_STEP)
        return error_in(&at, parameters);
    const double off = depths->beside + fmax(depths->seen - depths->lo, depths->hi - depths->seen);
    return fabs(parameters[EDGE_SLOPE] - parameters[EDGE_THRESHOLD] * setup->spec.zfar) <= off * (1 + 0x1p-40) ? LEVELS
                                                                                                               : 0;
}

/* The closed form is off by its rounding: goes to the last value that is usable, as effect_error() sees it. */
static void to_last_usable(const cell_case *at, double *p, double levels) {
    enum { STEPS = 64 };
    double *wanted = &p[at->row->wanted];
    const double usable = at->row->smallest ? HUGE_VAL : 0, beyond = at->row->smallest ? 0 : HUGE_VAL;
    for (int i = 0; i < STEPS && error_in(at, p) > levels; i++)
        *wanted = nextafter(*wanted, usable);
    for (int i = 0; i < STEPS; i++) {
        const double kept = *wanted;
        *wanted = nextafter(kept, beyond);
        if (!(*wanted > 0 && error_in(at, p) <= levels)) {
            *wanted = kept;
            return;
        }
    }
}

double effect_usable(const effect_row *row, const dp_setup *setup, const double *parameters, double z, double levels) {
    const cell_case at = case_at(row, setup, z);
    const texture_parameter *range = &row->parameters[row->wanted];
    double p[TEXTURE_PARAMETERS];
    if (!has_error(&at))
        return (double)NAN;
    memcpy(p, parameters, sizeof p);
    double *wanted = &p[row->wanted];
    *wanted = kinds[row->kind].limit(&at, p, levels / LEVELS);
    if (*wanted > 0 && isfinite(*wanted))
        to_last_usable(&at, p, levels);
    if (row->smallest)
        return *wanted <= range->hi ? fmax(*wanted, range->lo) : (double)NAN;
    return *wanted >= range->lo ? fmin(*wanted, range->hi) : (double)NAN;
}
