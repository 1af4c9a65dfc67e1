/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "shader/effect.h"

#include <math.h>
#include <string.h>

#include "core/elementary.h"
#include "core/search.h"

/* ---- The pixel --------------------------------------------------------------------------------------------------- */

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

effect_view effect_view_of(const texture_camera *camera, const texture_camera *last, double column, double row) {
    const texture_camera *then = last != NULL ? last : camera;
    const double x = camera_slope_x(camera, column), y = camera_slope_y(camera, row);
    const double across[3] = {x, y, 0}, ray[3] = {camera->ortho ? 0 : x, camera->ortho ? 0 : y, 1};
    effect_view view = {.setup = &camera->setup,
                        .stretch = camera_radial(camera, column, row),
                        .ndc = {x / camera->half[0], y / camera->half[1]}};
    double place[3] = {0}, moved[3];
    camera_turn(camera, ray, view.along);
    if (camera->ortho)
        camera_turn(camera, across, place);
    for (int k = 0; k < 3; k++) {
        moved[k] = place[k] + (camera->origin[k] - then->origin[k]);
        view.base[k] = place[k] + camera->origin[k];
    }
    for (int k = 0; k < 2; k++) {
        view.last.from[k] = dot(then->axis[k], moved) / then->half[k];
        view.last.per[k] = dot(then->axis[k], view.along) / then->half[k];
    }
    view.last.w = then->ortho ? 1 : dot(then->axis[2], moved);
    view.last.w_per = then->ortho ? 0 : dot(then->axis[2], view.along);
    return view;
}

/* ---- A ramp of the depth ----------------------------------------------------------------------------------------- */

/* The effect at one cell: what errors and limits are taken of. */
typedef struct cell_case {
    const effect_row *row;
    const effect_view *view;
    dp_cell cell;
    double first, last; /* the outermost depths that are stored as the cell's code */
    dp_cell behind;     /* of the other depth that is stored */
} cell_case;

static double off(double end, double stored) {
    return end == stored ? 0 : end - stored;
}

/* The change of the quantity from the stored depth to the farther end, or between two stored depths, which may be off
 * either way. Errors are made of it, as outputs would cancel. */
static double change(const cell_case *at, const double *p) {
    const dp_cell *own = &at->cell, *other = &at->behind;
    if (at->row->behind > 0)
        return fmax(off(other->hi, other->stored) - off(own->lo, own->stored),
                    off(own->hi, own->stored) - off(other->lo, other->stored));
    return fmax(at->row->apart(at->view, p, own->lo, own->stored), at->row->apart(at->view, p, own->hi, own->stored));
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

static double decay_error(const cell_case *at, const double *p) {
    return -dp_expm1(-change(at, p) * p[at->row->wanted]);
}

static double decay_limit(const cell_case *at, const double *p, double share) {
    return -dp_log1p(-share) / change(at, p);
}

/*
 * |saturate(p a) - saturate(p b)| of the quantities of the stored depth and of an end; with a > b, a > 0 and c the
 * positive part of b: it grows as p (a - c) up to p = 1/a, where it is 1 - c/a, and falls from there.
 */
typedef struct pair {
    double most, least;
} pair;

static pair pair_at(const cell_case *at, const double *p, double end) {
    const double a = at->row->quantity(at->view, p, at->cell.stored);
    const double b = at->row->quantity(at->view, p, end);
    return (pair){fmax(fmax(a, b), 0), fmax(fmin(a, b), 0)};
}

static double clamped_error_of(pair q, double p) {
    return p * q.most <= 1 ? p * (q.most == q.least ? 0 : q.most - q.least) : fmax(1 - p * q.least, 0);
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
 * Between which differences: of a depth of the cell and the stored one; or of two stored depths over all places of the
 * first in its cell, the second `slope` behind it. Stored depths are monotone, so its ends belong to the ends of the
 * cell. False where the plane leaves the far plane.
 */
static bool differences(const cell_case *at, double slope, double out[2]) {
    const dp_setup *setup = at->view->setup;
    if (at->row->alone) {
        out[0] = at->first - at->cell.stored;
        out[1] = at->last - at->cell.stored;
        return true;
    }
    if (at->first + slope > setup->spec.zfar)
        return false;
    const double last = fmin(at->last + slope, setup->spec.zfar);
    out[0] = dp_stored(setup, dp_code(setup, at->first + slope)) - at->cell.stored;
    out[1] = dp_stored(setup, dp_code(setup, last)) - at->cell.stored;
    return true;
}

static double difference_at(const cell_case *at, double z) {
    return dp_stored(at->view->setup, dp_code(at->view->setup, z)) - at->cell.stored;
}

/* The differences on either side of a value: the last below it, or up to it where that is `included`, and the first
 * beyond. NaN where there is none. */
static void differences_beside(const cell_case *at, double slope, double value, bool included, double out[2]) {
    const double past = included ? nextafter(value, HUGE_VAL) : value;
    const double lo = at->first + slope, hi = fmin(at->last + slope, at->view->setup->spec.zfar);
    out[0] = difference_at(at, hi) < past ? difference_at(at, hi) : (double)NAN;
    out[1] = difference_at(at, lo) < past ? (double)NAN : difference_at(at, lo);
    if (!isnan(out[0]) || !isnan(out[1]))
        return;
    dp_edge below = {.holds = lo, .fails = hi};
    for (double z; dp_edge_between(&below, &z);)
        *(difference_at(at, z) < past ? &below.holds : &below.fails) = z;
    out[0] = difference_at(at, below.holds);
    out[1] = difference_at(at, below.fails);
}

/* Below which values of the wanted parameter the output is 1: as it should be, and at least and at most. */
typedef struct critical_values {
    double plane, least, most;
} critical_values;

static double slope_of(const cell_case *at, const double *p) {
    const int index = parameter_find(at->row->parameters, "slope");
    return index >= 0 ? p[index] : 0;
}

static bool critical_of(const cell_case *at, const double *p, critical_values *out) {
    const double slope = slope_of(at, p), plane[2] = {slope, slope};
    double apart[2], some[2], below[2];
    if (!differences(at, slope, apart))
        return false;
    if (at->row->ceiling > 0) {
        differences_beside(at, slope, p[at->row->ceiling], false, below);
        apart[1] = below[0]; /* NaN where the first is beyond the ceiling, too */
    }
    at->row->critical(at->view, p, at->cell.stored, plane, some);
    out->plane = at->row->quiet ? 0 : some[0];
    at->row->critical(at->view, p, at->cell.stored, apart, some);
    out->least = some[0];
    out->most = some[1];
    return true;
}

static double step_error(const cell_case *at, const double *p) {
    const double wanted = p[at->row->wanted];
    critical_values c;
    if (!critical_of(at, p, &c))
        return 0;
    return wanted < c.plane ? wanted >= c.least : wanted < c.most;
}

/* Wrong are the values from `least` to the plane's own, and from there to `most`. */
static double step_limit(const cell_case *at, const double *p, double share) {
    critical_values c;
    (void)share;
    if (!critical_of(at, p, &c) || (c.least >= c.plane && c.most <= c.plane))
        return at->row->smallest ? 0 : HUGE_VAL;
    return at->row->smallest ? fmax(c.plane, c.most) : fmin(c.plane, c.least);
}

/* The integral of a ramp from 0 to 1. */
static double ramp_area(double x) {
    return x <= 0 ? 0 : x < 1 ? x * x / 2 : x - 0.5;
}

/* The share with u + slope t > bias, of depths u in the cell and places t in [-1/2, 1/2] of the texel. */
double effect_share(const effect_row *row, const effect_view *view, const double *parameters, double z) {
    const int index = parameter_find(row->parameters, "slope");
    if (row->kind != EFFECT_STEP || !row->alone || view->setup->spec.model == DP_MODEL_FLOAT)
        return (double)NAN;
    const dp_cell cell = dp_cell_of(view->setup, dp_code(view->setup, z));
    const double width = cell.hi - cell.lo, slope = index >= 0 ? parameters[index] : 0;
    const double above = cell.hi - cell.stored - parameters[row->wanted];
    if (!(width > 0) || isinf(width))
        return above > 0;
    const double k = slope / width, c = above / width;
    return k > 0x1p-20 ? (ramp_area(c + k / 2) - ramp_area(c - k / 2)) / k : fmin(fmax(c, 0), 1);
}

/* ---- Errors and limits ------------------------------------------------------------------------------------------- */

static const struct {
    double (*error)(const cell_case *, const double *);
    double (*limit)(const cell_case *, const double *, double share);
} kinds[] = {
    [EFFECT_FADE] = {fade_error, fade_limit},          [EFFECT_GAIN] = {gain_error, gain_limit},
    [EFFECT_CLAMPED] = {clamped_error, clamped_limit}, [EFFECT_DECAY] = {decay_error, decay_limit},
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

static cell_case case_at(const effect_row *row, const effect_view *view, const double *p, double z) {
    const dp_setup *setup = view->setup;
    cell_case at = {.row = row, .view = view};
    const uint32_t code = dp_code(setup, z);
    at.cell = dp_cell_of(setup, code);
    if (row->behind > 0)
        at.behind = dp_cell_of(setup, dp_code(setup, fmin(z + p[row->behind], setup->spec.zfar)));
    if (row->kind == EFFECT_STEP) {
        at.first = inside(setup, code, at.cell.lo, z);
        at.last = inside(setup, code, at.cell.hi, z);
    }
    return at;
}

static bool has_error(const cell_case *at) {
    return effect_applies(at->row, at->view->setup) && at->view->setup->spec.model != DP_MODEL_FLOAT;
}

static double error_in(const cell_case *at, const double *parameters) {
    return LEVELS * kinds[at->row->kind].error(at, parameters);
}

/* The step from the stored depth of z to that of the next depths beyond its cell. */
static cell_case step_at(const effect_row *row, const effect_view *view, double z) {
    const dp_setup *setup = view->setup;
    const uint32_t code = dp_code(setup, z), last = setup->reversed ? 0 : setup->spec.format.code_max;
    const uint32_t next = code == last ? code : setup->reversed ? code - 1 : code + 1;
    const double stored = dp_stored(setup, code);
    return (cell_case){row, view, {.stored = stored, .lo = stored, .hi = dp_stored(setup, next)}, .first = stored};
}

static bool has_step(const cell_case *at) {
    return has_error(at) && at->row->kind != EFFECT_STEP && at->row->behind == 0;
}

double effect_error(const effect_row *row, const effect_view *view, const double *parameters, double z) {
    const cell_case at = case_at(row, view, parameters, z);
    return has_error(&at) ? error_in(&at, parameters) : (double)NAN;
}

double effect_step(const effect_row *row, const effect_view *view, const double *parameters, double z) {
    const cell_case at = step_at(row, view, z);
    return has_step(&at) ? error_in(&at, parameters) : (double)NAN;
}

double effect_error_within(const effect_row *row, const effect_view *view, const double *parameters,
                           const effect_depths *depths) {
    const cell_case at = {.row = row,
                          .view = view,
                          .cell = {.stored = depths->seen, .lo = depths->lo, .hi = depths->hi},
                          .first = depths->lo,
                          .last = depths->hi};
    const bool pairs = row->kind == EFFECT_STEP && !row->alone;
    return has_error(&at) && !pairs ? error_in(&at, parameters) : (double)NAN;
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

static double usable_in(const cell_case *at, const double *parameters, double levels) {
    const effect_row *row = at->row;
    const texture_parameter *range = &row->parameters[row->wanted];
    double p[PARAMETERS_MAX];
    memcpy(p, parameters, sizeof p);
    double *wanted = &p[row->wanted];
    *wanted = kinds[row->kind].limit(at, p, levels / LEVELS);
    if (*wanted > 0 && isfinite(*wanted))
        to_last_usable(at, p, levels);
    if (row->smallest)
        return *wanted <= range->hi ? fmax(*wanted, range->lo) : (double)NAN;
    return *wanted >= range->lo ? fmin(*wanted, range->hi) : (double)NAN;
}

double effect_usable(const effect_row *row, const effect_view *view, const double *parameters, double z,
                     double levels) {
    const cell_case at = case_at(row, view, parameters, z);
    return has_error(&at) ? usable_in(&at, parameters, levels) : (double)NAN;
}

double effect_step_usable(const effect_row *row, const effect_view *view, const double *parameters, double z,
                          double levels) {
    const cell_case at = step_at(row, view, z);
    return has_step(&at) ? usable_in(&at, parameters, levels) : (double)NAN;
}

/* The critical value `which` of a plane of that slope: its own, the least or the most. */
static double critical_at(const cell_case *at, const double *parameters, double slope, int which) {
    double p[PARAMETERS_MAX];
    critical_values c;
    memcpy(p, parameters, sizeof p);
    p[parameter_find(at->row->parameters, "slope")] = slope;
    if (!critical_of(at, p, &c))
        return 0;
    return which == 0 ? c.plane : which == 1 ? c.most : c.least;
}

effect_slopes effect_slopes_at(const effect_row *row, const effect_view *view, const double *parameters, double z) {
    const cell_case at = case_at(row, view, parameters, z);
    double found[3] = {(double)NAN, (double)NAN, (double)NAN};
    const bool asked = row->kind == EFFECT_STEP && row->smallest && !row->quiet && !row->alone && has_error(&at) &&
                       parameter_find(row->parameters, "slope") >= 0;
    const double most = view->setup->spec.zfar - at.first, wanted = parameters[row->wanted];
    for (int i = 0; i < 3 && asked; i++) {
        dp_edge e = {.holds = 0, .fails = most};
        if (critical_at(&at, parameters, 0, i) > wanted)
            found[i] = 0;
        if (found[i] == 0 || !(critical_at(&at, parameters, most, i) > wanted))
            continue;
        for (double s; dp_edge_between(&e, &s);)
            *(critical_at(&at, parameters, s, i) > wanted ? &e.fails : &e.holds) = s;
        found[i] = e.fails;
    }
    return (effect_slopes){found[0], found[1], found[2]};
}

double effect_ceiling(const effect_row *row, const effect_view *view, const double *parameters, double z) {
    const cell_case at = case_at(row, view, parameters, z);
    const texture_parameter *range = &row->parameters[row->ceiling];
    const double slope = slope_of(&at, parameters);
    double apart[2];
    if (row->ceiling == 0 || !has_error(&at))
        return (double)NAN;
    if (!differences(&at, slope, apart))
        return range->hi;
    differences_beside(&at, slope, parameters[row->wanted], true, apart);
    if (isnan(apart[1]))
        return range->hi;
    return apart[1] >= range->lo ? fmin(apart[1], range->hi) : (double)NAN;
}
