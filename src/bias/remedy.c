/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bias/remedy.h"

#include <math.h>

#include "core/bits.h"
#include "core/elementary.h"
#include "core/search.h"

/* ---- The means --------------------------------------------------------------------------------------------------- */

/* Window depth of a step towards the camera: from z to z - step, without cancellation. */
static double window_of_step(const dp_setup *setup, double step, double z) {
    const double c = setup->log_c, left = z - step;
    if (setup->curve != DP_CURVE_LOG)
        return setup->curve == DP_CURVE_LINEAR ? step / setup->kappa
               : left > 0.0                    ? step / (setup->kappa * z * left)
                                               : (double)INFINITY;
    const double share = c * step / (c * (z - setup->anchor) + 1.0);
    return share < 1.0 ? -dp_log1p(-share) / setup->kappa : (double)INFINITY;
}

static double ndc(const dp_setup *setup, double amount, double z) {
    (void)z;
    return dp_mapping_get(setup->spec.mapping)->ndc_signed ? 0.5 * amount : amount;
}

static double ray(const dp_setup *setup, double amount, double z) {
    return isinf(z) ? 0.0 : window_of_step(setup, amount * fabs(z), z);
}

static double normal(const dp_setup *setup, double amount, double z) {
    return window_of_step(setup, amount, z);
}

/* With near k n in place of n the same z has the depth that 1/z + (k - 1)(1/z - 1/f)/(1 - k n/f) has with n. */
static double second_near(const dp_setup *setup, double k, double z) {
    const double n = setup->spec.znear, far = 1.0 / setup->spec.zfar;
    return (k - 1.0) * (1.0 / z - far) / (1.0 - k * n * far) / setup->kappa;
}

static double depth_range(const dp_setup *setup, double a, double z) {
    const double d = dp_window(setup, z);
    return (1.0 - a) * (setup->reversed ? 1.0 - d : d);
}

/* clang-format off */
static const remedy rows[] = {
    {"ndc", "clip pull epsilon", "NDC z - e, or clip z - e w",
     "a constant of window depth, as --api vulkan-float has it",
     "e, NDC depth", "z z' e (1/n - 1/f), about e z^2/n: what is .5 at 20 is 195 at 500", "+ e",
     "no state; the layer is clipped where it comes before the near plane", 0.0, 2.0, true, true, false, false, ndc},
    {"ray", "eye-ray scale", "z (1 - e), along the ray to the eye", NULL, "e, a share of the distance", "e z",
     "nothing", "nothing shifts on the screen, and the gap grows with the distance",
     0.0, 0.5, true, false, true, false, ray},
    {"normal", "offset lift", "moved along the normal by s", NULL, "s, scene units", "s, wherever the camera is",
     "nothing", "seen from the side the gap shows", 0.0, 1e12, true, false, false, true, normal},
    {"near", "second-near", "drawn with the near plane k n, and the same far plane", NULL, "k, above 1",
     "about (k - 1) z", "nothing", "clipped before k n; a second projection matrix",
     1.0, 1e6, true, true, true, false, second_near},
    {"range", "depth-range glDepthRange slices", "glDepthRange(0, a), all else (0, 1)", "MapLibre's slices",
     "a, below 1", "(1 - a) d of window depth: what is less before the layer is hidden by it",
     "glDepthRange(1 - a, 1)", "far off it shows through what is before it",
     0.0, 1.0, false, true, false, false, depth_range},
    {"stencil", NULL, "drawn where its wall has just been marked, without a depth test", NULL, "",
     "the order of drawing",
     "nothing", "a stencil buffer, and an order of drawing for each wall", 0.0, 0.0, true, false, false, false, NULL},
};
/* clang-format on */

NAMED_TABLE(remedy, rows);

bool remedy_suits(const remedy *row, const dp_setup *setup) {
    const bool matrix = dp_mapping_get(setup->spec.mapping)->written == DP_WRITTEN_BY_MATRIX;
    return (matrix || !row->of_matrix) && !(setup->spec.ortho && row->of_eye);
}

/* ---- What they do ------------------------------------------------------------------------------------------------ */

static double nearer_by(const dp_setup *setup, const remedy *row, double amount, double z) {
    return row->window != NULL ? row->window(setup, amount, z) : 0.0;
}

/* The exact window depth of the layer: below 0, or reversed above 1, it is clipped. */
static double depth_with(const dp_setup *setup, const remedy *row, double amount, double z) {
    return dp_window(setup, z) + nearer_by(setup, row, amount, z) * bias_sign(setup);
}

static bool is_clipped(const dp_setup *setup, const remedy *row, double amount, double z) {
    const double d = dp_window(setup, z);
    const bool behind = row->window == second_near && !(z >= amount * setup->spec.znear);
    return behind || !(nearer_by(setup, row, amount, z) <= (setup->reversed ? 1.0 - d : d));
}

/* How much nearer the depth of z is that is nearer by t in the window. */
static double step_of_window(const dp_setup *setup, double t, double z) {
    const double c = setup->log_c;
    return setup->curve == DP_CURVE_PERSPECTIVE ? t * setup->kappa * z * (z / (1.0 + t * setup->kappa * z))
           : setup->curve == DP_CURVE_LINEAR    ? t * setup->kappa
                                                : -(c * (z - setup->anchor) + 1.0) / c * dp_expm1(-t * setup->kappa);
}

bias_effect remedy_at(const dp_setup *setup, const remedy *row, double amount, double z) {
    const double none = (double)NAN, t = nearer_by(setup, row, amount, z);
    bias_effect e = {.z = z, .r = {none, none}, .offset = t * bias_sign(setup), .code = dp_code(setup, z)};
    e.depth = fmin(fmax(depth_with(setup, row, amount, z), 0.0), 1.0);
    e.moved = t == 0.0 ? e.code : dp_format_encode(&setup->spec.format, setup->spec.rounding, e.depth);
    e.limited = is_clipped(setup, row, amount, z);
    e.shift = -step_of_window(setup, fmin(t, 2.0), z) + 0.0;
    e.to = z + e.shift;
    return e;
}

/* The shift by a second near plane grows, and falls to 0 at the far plane: z - z' is greatest at f s/(s + 1), s^2 being
 * what 1/z - 1/f is multiplied by. The others' grows, or is the same everywhere. */
bias_push remedy_push(const dp_setup *setup, const remedy *row, double amount, double lo, double hi) {
    const double far = setup->spec.zfar, s = sqrt(1.0 + (amount - 1.0) / (1.0 - amount * setup->spec.znear / far));
    const double turn = row->window == second_near && isfinite(far) ? far * (s / (s + 1.0)) : hi;
    const double tried[3] = {lo, hi, fmin(fmax(turn, lo), hi)};
    bias_push most = {.shift = 0.0, .z = lo};
    for (int i = 0; i < 3; i++) {
        const double shift = -remedy_at(setup, row, amount, tried[i]).shift;
        most = shift > most.shift ? (bias_push){shift, tried[i]} : most;
    }
    return most;
}

/* ---- Whether it is enough ---------------------------------------------------------------------------------------- */

typedef struct question {
    const dp_setup *setup;
    const remedy *row;
    double amount, gap, slope, lo, hi;
} question;

/* The depth of the layer where it is sampled a pixel farther than its wall at z, at most far. */
static double sampled_at(const question *q, double z) {
    const double m = bias_window_slope(q->setup, z, q->slope), far = q->setup->spec.zfar;
    const double there = m > 0.0 ? z - step_of_window(q->setup, -m, z) : z;
    return there >= z && there <= far ? there : far;
}

/* A layer whose depth is rounded by itself needs, beyond a bias, half a step of binary32; with a slope, m besides. */
static double needed_over(const question *q, double a, double b) {
    const bias_goal goal = {.api = bias_api_find("vulkan-float"), .gap = q->gap, .slope = q->slope};
    double worst;
    const double needed = a < b ? bias_needed_over(q->setup, &goal, a, b, &worst) : bias_needed(q->setup, &goal, a);
    const double d = fmax(dp_window(q->setup, a), dp_window(q->setup, b));
    return needed + fmin(0x1p-25, 0x1p-24 * d * (1.0 + needed)) + 0x1p-149;
}

static bool enough_at_once(const question *q, double a, double b) {
    const double outward = 1.0 - DP_ROUNDINGS_30, last = fmax(sampled_at(q, a), sampled_at(q, b));
    const double t = fmin(q->row->window(q->setup, q->amount, a), q->row->window(q->setup, q->amount, last));
    return !is_clipped(q->setup, q->row, q->amount, a) && !is_clipped(q->setup, q->row, q->amount, b) &&
           t * outward >= needed_over(q, a, b);
}

/* t is monotone: its least is at an end of the depths where the layer is sampled, and those of [a, b] are farthest off
 * at a or b. What is needed follows binades, so a range is halved until both agree. */
static bool enough_over(const question *q, double a, double b, int halvings) {
    if (q->row->window == NULL || enough_at_once(q, a, b))
        return true;
    if (halvings == 0 || !(a < b) || !enough_at_once(q, a, a) || !enough_at_once(q, b, b))
        return false;
    const double middle = a > 0.0 ? sqrt(a) * sqrt(b) : 0.5 * a + 0.5 * b;
    return middle > a && middle < b && enough_over(q, a, middle, halvings - 1) &&
           enough_over(q, middle, b, halvings - 1);
}

enum { HALVINGS = 16 };

/* The depth farthest from `start` towards `end` up to which it is enough. */
static double enough_towards(const question *q, double start, double end) {
    dp_edge e = {.holds = start, .fails = end, .apart = 0x1p-48};
    if (start == end || enough_over(q, fmin(start, end), fmax(start, end), HALVINGS))
        return end;
    for (double x; dp_edge_between(&e, &x);)
        *(enough_over(q, fmin(start, x), fmax(start, x), HALVINGS) ? &e.holds : &e.fails) = x;
    return e.holds;
}

static void find_part(const question *q, double lo, double hi, bias_verdict *v) {
    if (enough_over(q, lo, lo, 0)) {
        v->from = lo;
        v->to = enough_towards(q, lo, hi);
    } else if (enough_over(q, hi, hi, 0)) {
        v->to = hi;
        v->from = enough_towards(q, hi, lo);
    }
}

static bool fails_at(const question *q, double z, bias_verdict *v) {
    const dp_setup *setup = q->setup;
    const dp_format *format = &setup->spec.format;
    const double d = (double)(float)dp_window(setup, z), there = sampled_at(q, z);
    const double moved = (double)(float)fmin(fmax(depth_with(setup, q->row, q->amount, there), 0.0), 1.0);
    const uint32_t code = dp_format_encode(format, setup->spec.rounding, d);
    const uint32_t layer = dp_format_encode(format, setup->spec.rounding, moved);
    if (q->slope > 0.0 && !(there < setup->spec.zfar)) /* nothing is drawn there */
        return false;
    const bool apart = setup->reversed ? layer > code : layer < code;
    const bool short_of = apart && !(-remedy_at(setup, q->row, q->amount, z).shift >= q->gap * (1.0 - 0x1p-40));
    v->clipped = is_clipped(setup, q->row, q->amount, z);
    if (apart && !short_of && !v->clipped)
        return false;
    v->z = z;
    v->code = code;
    v->moved = layer;
    v->short_of_gap = short_of;
    return true;
}

/* Any depth of a code may be the one: many are tried. */
static bool find_witness(const question *q, double lo, double hi, bias_verdict *v) {
    enum { TRIED = 4096 };
    for (int i = 0; i <= TRIED; i++) {
        const double part = (double)i / TRIED;
        const double z = i == TRIED ? hi : lo > 0.0 ? lo * dp_pow(hi / lo, part) : lo + (hi - lo) * part;
        if (fails_at(q, fmin(fmax(z, lo), hi), v))
            return true;
    }
    return false;
}

/* Where it turns from enough to not: the number, or the slope, at `field` is so much from the base. */
static double turn_of(question *q, double *field, double base, double way, dp_edge e) {
    e.apart = 0x1p-20;
    for (double x; dp_edge_between(&e, &x);) {
        *field = base + way * x;
        *(enough_over(q, q->lo, q->hi, HALVINGS) ? &e.holds : &e.fails) = x;
    }
    return base + way * e.holds;
}

/* The least number that is enough all over the range: NaN where none is. */
static double least_of(question q) {
    const remedy *row = q.row;
    const double base = row->grows ? row->least : row->most, way = row->grows ? 1.0 : -1.0;
    for (int e = 0; e <= 160; e++) { /* from next to nothing, in powers of 2 */
        const double more = ldexp(1.0, e - 120);
        q.amount = base + way * more;
        if (!(q.amount <= row->most && q.amount >= row->least))
            break;
        if (enough_over(&q, q.lo, q.hi, HALVINGS))
            return turn_of(&q, &q.amount, base, way, (dp_edge){.holds = more, .fails = 0.5 * more});
    }
    return (double)NAN;
}

bias_verdict remedy_judge(const dp_setup *setup, const remedy *row, double amount, const bias_goal *goal, double lo,
                          double hi) {
    const double none = (double)NAN;
    const question q = {setup, row, amount, goal->gap, goal->slope, lo, hi};
    bias_verdict v = {.lo = lo, .hi = hi, .from = none, .to = none, .z = none, .code = none, .moved = none};
    v.factor = none;
    v.units = row->window != NULL ? least_of(q) : none;
    find_part(&q, lo, hi, &v);
    v.answer = v.from == lo && v.to == hi     ? BIAS_ENOUGH
               : find_witness(&q, lo, hi, &v) ? BIAS_NOT_ENOUGH
                                              : BIAS_NOT_PROVEN;
    return v;
}

double remedy_steepest(const dp_setup *setup, const remedy *row, double amount, double gap, double lo, double hi) {
    question q = {setup, row, amount, gap, 0.0, lo, hi};
    if (row->parallel || row->window == NULL || !enough_over(&q, lo, hi, HALVINGS))
        return (double)NAN;
    q.slope = 0x1p-60 * hi;
    if (!enough_over(&q, lo, hi, HALVINGS))
        return 0.0;
    return turn_of(&q, &q.slope, 0.0, 1.0, (dp_edge){.holds = q.slope, .fails = 2.0 * hi});
}
