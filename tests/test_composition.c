/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * World positions through view and projection: a search over random cameras, rays, orders of the sums and depths for
 * the farthest two surfaces of one ray that the codes tie or swap. No separation is below it, and none is far above.
 * The matrices, the transform, the divide and the conversion are made here, from their definitions.
 */
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/composition.h"
#include "depthprec/depthprec.h"
#include "support.h"

enum { SAMPLES = 160, BEHIND = 16 };

/* ---- A pipeline of its own --------------------------------------------------------------------------------------- */

typedef struct set_up {
    dp_setup setup;
    const dp_arith_row *arith;
    double a, b; /* the projection, in double */
    bool reversed, is_signed, ortho;
    dp_budget_terms terms;
} set_up;

typedef struct camera {
    double axis[3], eye[3];
    double from[3], ray[3]; /* the point at eye depth z is from + z ray */
    float clip[4], w[4];
    int order[4];
    bool paired;
} camera;

static void project(double n, double f, bool reversed, bool is_signed, bool ortho, double *a, double *b) {
    if (ortho) {
        *a = is_signed ? 2.0 / (f - n) : 1.0 / (f - n);
        *b = is_signed ? -(f + n) / (f - n) : -n / (f - n);
    } else if (isinf(f)) {
        *a = 1.0;
        *b = is_signed ? -2.0 * n : -n;
    } else {
        *a = is_signed ? (f + n) / (f - n) : f / (f - n);
        *b = is_signed ? -2.0 * n * f / (f - n) : -n * f / (f - n);
    }
    if (reversed && is_signed) {
        *a = -*a;
        *b = -*b;
    } else if (reversed) { /* w less clip z */
        *a = ortho ? -*a : isinf(f) ? 0.0 : -n / (f - n);
        *b = ortho ? f / (f - n) : -*b;
    }
}

static bool make(set_up *s, double n, double f, dp_mapping mapping, const char *format, dp_arith arith, bool ortho,
                 dp_budget_terms terms) {
    dp_format found[2];
    dp_format_parse(format, found);
    dp_spec spec = dp_spec_default();
    spec.znear = n;
    spec.zfar = f;
    spec.mapping = mapping;
    spec.format = found[0];
    spec.arith = arith;
    spec.ortho = ortho;
    spec.model = DP_MODEL_FP32;
    *s = (set_up){.arith = dp_arith_get(arith),
                  .reversed = mapping == DP_MAPPING_REVERSED || mapping == DP_MAPPING_GL_REVERSED,
                  .is_signed = mapping == DP_MAPPING_GL || mapping == DP_MAPPING_GL_REVERSED,
                  .ortho = ortho,
                  .terms = terms};
    project(n, f, s->reversed, s->is_signed, ortho, &s->a, &s->b);
    return dp_setup_init(&s->setup, &spec) == DP_OK;
}

/* The matrix of one camera. `relative` has no translation. */
static void compose(const set_up *s, camera *c) {
    const bool relative = s->terms.composition == DP_COMPOSITION_RELATIVE;
    double t = 0.0;
    for (int k = 0; k < 3; k++)
        t -= relative ? 0.0 : c->axis[k] * c->eye[k];
    const float a = (float)s->a;
    const float b = (float)s->b;
    for (int k = 0; k < 4; k++) {
        const double view = k < 3 ? c->axis[k] : t;
        const float entry = (float)view;
        const float product = a * entry;
        c->w[k] = s->ortho ? (k == 3 ? 1.0F : 0.0F) : entry;
        if (s->terms.composition == DP_COMPOSITION_PRODUCTS)
            c->clip[k] = k < 3 ? product : product + b;
        else
            c->clip[k] = (float)(s->a * view + (k < 3 ? 0.0 : s->b));
    }
}

static float multiply_add(bool fused, float x, float y, float sum) {
    const float product = x * y;
    return fused ? fmaf(x, y, sum) : product + sum;
}

static float dot(const camera *c, const float row[4], const float p[4], bool fused) {
    const int *o = c->order;
    const float first = multiply_add(fused, row[o[1]], p[o[1]], row[o[0]] * p[o[0]]);
    if (c->paired)
        return first + multiply_add(fused, row[o[3]], p[o[3]], row[o[2]] * p[o[2]]);
    return multiply_add(fused, row[o[3]], p[o[3]], multiply_add(fused, row[o[2]], p[o[2]], first));
}

/* The binary32 position that stands for the surface at z. False: outside the box. */
static bool place(const set_up *s, const camera *c, double z, float p[4]) {
    const bool relative = s->terms.composition == DP_COMPOSITION_RELATIVE;
    p[3] = 1.0F;
    for (int k = 0; k < 3; k++) {
        const double at = c->from[k] + z * c->ray[k];
        p[k] = (float)(relative ? at - c->eye[k] : at);
        if (!(fabs(at) <= s->terms.world))
            return false;
    }
    return true;
}

static float window_of(const set_up *s, float clip, float w) {
    if (s->is_signed && s->arith->remap)
        clip = (clip + w) * 0.5F;
    const float inverse = 1.0F / w;
    float d = s->arith->reciprocal ? clip * inverse : clip / w;
    if (s->is_signed && !s->arith->remap) {
        const float half = 0.5F * d;
        d = half + 0.5F;
    }
    return d > 0.0F ? (d < 1.0F ? d : 1.0F) : 0.0F;
}

/* The code as a number that rises with it. */
static double convert(const set_up *s, float d) {
    const double most = (double)s->setup.spec.format.code_max;
    if (s->setup.spec.format.kind == DP_FORMAT_FLOAT)
        return (double)d; /* fp32 alone is tested */
    const float product = d * (float)most;
    switch (s->arith->conversion) {
    case DP_CONVERT_PRODUCT_EVEN:
        return fmin(rint((double)product), most);
    case DP_CONVERT_PRODUCT_ZERO:
        return fmin(trunc((double)product), most);
    default:
        return floor((double)d * most + 0.5);
    }
}

/* The code of the surface at z, falling with z where all is well. False: outside the box, or not in front. */
static bool falling_code(const set_up *s, const camera *c, double z, double *code) {
    float p[4];
    if (!place(s, c, z, p))
        return false;
    const float w = dot(c, c->w, p, s->arith->fused);
    const double stored = convert(s, window_of(s, dot(c, c->clip, p, s->arith->fused), w));
    *code = s->reversed ? stored : -stored;
    return w > 0.0F;
}

/* ---- Cameras ----------------------------------------------------------------------------------------------------- */

static double sum_of_products(const double x[3], const double y[3]) {
    return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

/* What a camera is made of; each number in [-1, 1]. */
typedef struct pose {
    double axis[3], eye[3], side[3], wide;
    int order[4];
    bool paired;
} pose;

/*
 * Of axes every third points nearly along a diagonal, where sums are largest, every third mostly along a coordinate,
 * where single products are; of cameras every third stands in the corner before it, every third in some corner.
 */
static pose random_pose(rng *r) {
    pose p = {.order = {0, 1, 2, 3}, .paired = rng_below(r, 4) == 0};
    const uint64_t direction = rng_below(r, 3);
    const int mostly = (int)rng_below(r, 3);
    const uint64_t place_of_eye = rng_below(r, 3);
    for (int k = 0; k < 3; k++) {
        p.axis[k] = rng_uniform(r, -1.0, 1.0);
        p.eye[k] = rng_uniform(r, -1.0, 1.0);
        p.side[k] = rng_uniform(r, -1.0, 1.0);
        if (direction == 0)
            p.axis[k] = copysign(0.8 + 0.2 * fabs(p.axis[k]), p.axis[k]);
        else if (direction == 1 && k != mostly)
            p.axis[k] *= 0.3;
        if (place_of_eye < 2)
            p.eye[k] = copysign(0.8 + 0.2 * fabs(p.eye[k]), place_of_eye == 0 ? p.axis[k] : p.eye[k]);
    }
    p.wide = sqrt(rng_unit(r));
    for (int k = 3; k > 0; k--) {
        const int other = (int)rng_below(r, (uint64_t)k + 1);
        const int held = p.order[k];
        p.order[k] = p.order[other];
        p.order[other] = held;
    }
    return p;
}

/* Another one like it. */
static pose changed_pose(rng *r, const pose *from) {
    const double much = rng_log(r, 1e-6, 0.3);
    pose p = *from;
    for (int k = 0; k < 3; k++) {
        p.axis[k] += much * rng_uniform(r, -1.0, 1.0);
        p.eye[k] = fmin(fmax(p.eye[k] + much * rng_uniform(r, -1.0, 1.0), -1.0), 1.0);
        p.side[k] += much * rng_uniform(r, -1.0, 1.0);
    }
    p.wide = fmin(fmax(p.wide + much * rng_uniform(r, -1.0, 1.0), 0.0), 1.0);
    return p;
}

static void aim(const set_up *s, double z, const pose *p, camera *c) {
    const double world = s->terms.world;
    const double length = sqrt(sum_of_products(p->axis, p->axis));
    for (int k = 0; k < 3; k++)
        c->axis[k] = p->axis[k] / length;
    /* beside the axis: a vector across it, up to tan 60 degrees */
    double side[3];
    const double along = sum_of_products(p->side, c->axis);
    for (int k = 0; k < 3; k++)
        side[k] = p->side[k] - along * c->axis[k];
    const double across = sqrt(sum_of_products(side, side));
    const double wide = (s->ortho ? fmin(s->setup.spec.zfar, world) : sqrt(3.0)) * p->wide * (1.0 - 1e-9) / across;
    for (int k = 0; k < 3; k++) {
        c->ray[k] = c->axis[k] + (s->ortho ? 0.0 : wide * side[k]);
        const double ahead = z * c->ray[k] + (s->ortho ? wide * side[k] : 0.0);
        /* room for the point, and for those behind it */
        const double eye = p->eye[k] * world;
        const double moved = fmin(fmax(eye, -world - 1.1 * fmin(ahead, 0.0)), world - 1.1 * fmax(ahead, 0.0));
        c->eye[k] = fmin(fmax(moved, -world), world) * (1.0 - 1e-9);
        c->from[k] = c->eye[k] + (s->ortho ? wide * side[k] : 0.0);
    }
    memcpy(c->order, p->order, sizeof c->order);
    c->paired = p->paired;
    compose(s, c);
}

/* ---- The search -------------------------------------------------------------------------------------------------- */

typedef struct found {
    double ratio, z, gap, bound; /* the pair that takes most of its separation */
} found;

static double separation_at(const set_up *s, double z) {
    dp_budget b;
    assert_int_equal(dp_budget_at(&s->setup, z, &s->terms, &b), DP_OK);
    return b.separation;
}

/* The farthest two depths of one ray whose codes are not strictly in order, by a running extreme. */
static void search_ray(rng *r, const set_up *s, const camera *c, double z, double width, found *best) {
    double depth[SAMPLES], least[SAMPLES];
    const double end = fmin(s->setup.spec.zfar, 8.0 * s->terms.world);
    found longest = {0};
    int count = 0;
    for (int i = 0; i < SAMPLES; i++) {
        const double share = (i + rng_unit(r)) / (SAMPLES - BEHIND);
        const double at = i < SAMPLES - BEHIND ? z + width * share : z + width * pow(1e3, share - 1.0);
        double code;
        if (at > end || !falling_code(s, c, at, &code))
            break;
        int first = 0; /* of the depths before, whose codes' running minimum falls */
        for (int beyond = count; first < beyond;) {
            const int middle = (first + beyond) / 2;
            if (least[middle] <= code)
                beyond = middle;
            else
                first = middle + 1;
        }
        if (first < count && at - depth[first] > longest.gap)
            longest = (found){.z = depth[first], .gap = at - depth[first]};
        depth[count] = at;
        least[count] = count > 0 ? fmin(least[count - 1], code) : code;
        count++;
    }
    if (longest.gap > 0.8 * best->gap) {
        longest.bound = separation_at(s, longest.z);
        longest.ratio = longest.gap / (isinf(longest.bound) ? 1e9 * s->setup.spec.znear : longest.bound);
        if (longest.ratio > best->ratio)
            *best = longest;
    }
}

/*
 * Some times from anew: rays at random, then others like the best of them. More often where that has found less than
 * `wanted` of the bound.
 */
static found search(rng *r, const set_up *s, double z, double wanted, uint64_t times) {
    const uint64_t rays = 60;
    const uint64_t most = 1000 * times;
    found best = {0};
    const double bound = separation_at(s, z);
    const double width = isinf(bound) ? 20.0 * z : 1.05 * bound;
    for (uint64_t i = 0; i < times || (best.ratio < wanted && i < most); i++) {
        found here = {0};
        pose best_pose = random_pose(r);
        for (uint64_t k = 0; k < rays; k++) {
            const pose p = 3 * k < rays ? random_pose(r) : changed_pose(r, &best_pose);
            const double before = here.ratio;
            camera c;
            aim(s, z, &p, &c);
            search_ray(r, s, &c, z, width, &here);
            if (here.ratio > before)
                best_pose = p;
        }
        if (here.ratio > best.ratio)
            best = here;
    }
    return best;
}

/* ---- Tests ------------------------------------------------------------------------------------------------------- */

static const double worlds[] = {1e2, 1e4, 1e6};
static const double nears[] = {0.1, 0.05};
static const double fars[] = {1000, 10000, HUGE_VAL};
static const char *const formats[] = {"fp32", "unorm24"};

/* Where no separation is promised, surfaces many times as far away must be found tied or swapped. */
static void within_four_times(void **state) {
    (void)state;
    rng r = rng_make("composition");
    tally never = {.name = "never below"};
    tally tight = {.name = "within 4 times"};
    tally none = {.name = "no separation"};
    for (int k = 0; k < DP_COMPOSITION_COUNT; k++) {
        double least = 1.0, sum = 0.0, count = 0.0;
        for (int i = 0; i < 3 * 2 * 3 * 2 * 2 * 4; i++) {
            const double z = (const double[]){1.0, 7.0, 60.0, 300.0}[i / 72];
            const double world = worlds[i % 3], n = nears[i / 3 % 2], f = fars[i / 6 % 3];
            const dp_mapping mapping = i / 36 % 2 ? DP_MAPPING_REVERSED : DP_MAPPING_D3D;
            set_up s;
            assert_true(make(&s, n, f, mapping, formats[i / 18 % 2], rng_below(&r, 2), false,
                             (dp_budget_terms){.world = world, .composition = (dp_composition)k}));
            if (z > world)
                continue;
            const double bound = separation_at(&s, z);
            const found most = search(&r, &s, z, isinf(bound) ? 0.0 : 0.26, test_cases(1, 4, 100));
            char text[160];
            snprintf(text, sizeof text, "%s: %s %s, near %g, far %g, world %g",
                     dp_composition_get((dp_composition)k)->name, dp_mapping_get(mapping)->name, formats[i / 18 % 2], n,
                     f, world);
            if (isinf(bound)) {
                TALLY(&none, most.gap > fmin(10.0 * z, 0.5 * (f - z)), "%s: z = %g: %g found", text, z, most.gap);
                continue;
            }
            TALLY(&never, most.ratio < 1.0, "%s: z = %a: %g of %g", text, most.z, most.gap, most.bound);
            TALLY(&tight, most.ratio > 0.25 || test_effort() == EFFORT_QUICK, "%s: z = %g: %g of %g", text, z, most.gap,
                  most.bound);
            sum += 1.0 / most.ratio;
            count += 1.0;
            least = fmin(least, most.ratio);
        }
        printf("# %s: bound/found at most %.2f, %.2f in the mean of %g\n", dp_composition_get((dp_composition)k)->name,
               1.0 / least, sum / count, count);
    }
    tally_end(&never);
    tally_end(&tight);
    tally_end(&none);
}

/* Every mapping, arithmetic, composition and projection. */
static void random_set_ups(void **state) {
    (void)state;
    rng r = rng_make("composed set-ups");
    tally never = {.name = "random set-ups"};
    found worst = {0};
    for (uint64_t i = test_cases(100, 3000, 300000); i > 0; i--) {
        const double n = rng_log(&r, 0.01, 10.0);
        const bool ortho = rng_below(&r, 4) == 0;
        const double f = !ortho && rng_below(&r, 4) == 0 ? HUGE_VAL : n * rng_log(&r, 1.5, 1e5);
        const dp_composition composition = (dp_composition)rng_below(&r, DP_COMPOSITION_COUNT);
        const double largest = composition == DP_COMPOSITION_RELATIVE ? 1e16 : 1e7;
        const dp_budget_terms terms = {.world = n * rng_log(&r, 4.0, largest), .composition = composition};
        const double end = fmin(f, 0.7 * terms.world);
        set_up s;
        if (!make(&s, n, f, (dp_mapping)rng_below(&r, 4),
                  (const char *[]){"fp32", "unorm24", "unorm16"}[rng_below(&r, 3)], rng_below(&r, dp_arith_count()),
                  ortho, terms))
            continue;
        const double z = rng_below(&r, 8) ? rng_log(&r, n, end) : rng_below(&r, 2) ? n : end * (1.0 - 1e-6);
        const double bound = separation_at(&s, z);
        const found most = search(&r, &s, z, 0.0, 1);
        TALLY(&never, isinf(bound) || most.ratio < 1.0,
              "%s %s %s %s%s, near %.17g, far %.17g, world %.17g: z = %a: %g of %g",
              dp_composition_get(terms.composition)->name, dp_mapping_get(s.setup.spec.mapping)->name,
              s.setup.spec.format.name, s.arith->name, ortho ? " ortho" : "", n, f, terms.world, most.z, most.gap,
              most.bound);
        if (isfinite(bound) && most.ratio > worst.ratio)
            worst = most;
    }
    printf("# random set-ups: at most %.3f of a bound used\n", worst.ratio);
    tally_end(&never);
}

/* ---- Each cause alone -------------------------------------------------------------------------------------------- */

enum { POSITION, PRODUCTS, SUMS, MATRIX, TURN, CAUSES };
static const char *const causes[CAUSES] = {"position", "products", "sums", "matrix", "turn"};

static void claims(const dp_row_off *row, double out[CAUSES]) {
    const double each[CAUSES] = {row->position, row->products, row->sums, row->entries + row->constant, row->turn};
    memcpy(out, each, sizeof each);
}

/* What a row was off by at a point, cause by cause. scale and b: its real value is scale z + b. */
static void row_off(const set_up *s, const camera *c, const float row[4], double scale, double b, double z,
                    double out[CAUSES]) {
    const bool relative = s->terms.composition == DP_COMPOSITION_RELATIVE;
    const bool products = s->terms.composition == DP_COMPOSITION_PRODUCTS && b != 0.0;
    float p[4] = {0};
    long double matrix = 0.0L, turn = 0.0L, rounded = 0.0L, exact = 0.0L, position = 0.0L, t = 0.0L;
    place(s, c, z, p);
    for (int k = 0; k < 3; k++) {
        const long double entry = products ? (long double)(float)c->axis[k] : (long double)c->axis[k];
        const long double at = (long double)c->from[k] + (long double)z * (long double)c->ray[k];
        const long double off = (long double)row[k] - (long double)scale * entry;
        const float product = row[k] * p[k];
        position += (long double)scale * (long double)c->axis[k] *
                    ((long double)p[k] - at + (relative ? (long double)c->eye[k] : 0.0L));
        matrix += off * (long double)p[k];
        turn += off * (long double)c->ray[k];
        exact += (long double)row[k] * (long double)p[k];
        rounded += (long double)product;
        t -= relative ? 0.0L : (long double)c->axis[k] * (long double)c->eye[k];
    }
    t = products ? (long double)(float)t : t;
    matrix += (long double)row[3] - ((long double)scale * t + (long double)b);
    const long double result = (long double)dot(c, row, p, false);
    const long double each[CAUSES] = {position, rounded - exact, result - rounded - (long double)row[3], matrix, turn};
    for (int k = 0; k < CAUSES; k++)
        out[k] = (double)each[k];
}

enum { OWN, SHARED, OWN_TILT, SHARED_TILT, TOTALS };
static const char *const totals[TOTALS] = {"own", "shared", "own tilt", "shared tilt"};

/* What the eye depth of the point was off by, from the rows of w and clip z. */
static void eye_off(const dp_composing *in, const double w[CAUSES], const double clip[CAUSES], double out[TOTALS]) {
    /* in `products` clip z is off its product with w's rounded entries, whose own errors cancel */
    const double shared = in->composition == DP_COMPOSITION_PRODUCTS ? 0.0 : in->a * w[MATRIX];
    out[OWN] = w[POSITION] + w[PRODUCTS] + w[SUMS];
    out[SHARED] = w[MATRIX];
    out[OWN_TILT] = (clip[PRODUCTS] + clip[SUMS] - in->a * (w[PRODUCTS] + w[SUMS])) / in->b;
    out[SHARED_TILT] = (clip[MATRIX] - shared) / in->b;
}

static void judge(tally *within, const char *what, double off, double claim, double *most) {
    TALLY(within, fabs(off) <= claim * (1.0 + 0x1p-20), "%s: %g of %g", what, off, claim);
    *most = fmax(*most, fabs(off) / claim);
}

static void report(const char *composition, const char *row, const char *what, double most) {
    printf("# %s, %s %s: at most %.3f\n", composition, row, what, most);
    assert_true(most > 0.5);
}

/* No cause is more than its claim, and each somewhere more than half of it: with one halved this fails. */
static void each_cause(void **state) {
    (void)state;
    rng r = rng_make("composition causes");
    tally within = {.name = "causes"};
    for (int k = 0; k < DP_COMPOSITION_COUNT; k++) {
        double most[2][CAUSES] = {{0}}, most_eye[TOTALS] = {0};
        const double world = 1e4, n = 0.1, z = 7.0;
        set_up s;
        make(&s, n, 1000.0, DP_MAPPING_D3D, "fp32", 0, false,
             (dp_budget_terms){.world = world, .composition = (dp_composition)k});
        const dp_composing in = {.composition = (dp_composition)k,
                                 .world = world,
                                 .a = (double)(float)s.a,
                                 .b = (double)(float)s.b,
                                 .znear = n,
                                 .zfar = 1000.0};
        const dp_composed m = dp_composition_at(&in, z, z);
        const double eye_claim[TOTALS] = {m.own, m.shared, m.own_tilt, m.shared_tilt};
        for (uint64_t i = test_cases(30000, 300000, 10000000); i > 0; i--) {
            const pose p = random_pose(&r);
            double claim[2][CAUSES], off[2][CAUSES], eye[TOTALS];
            camera c;
            aim(&s, z, &p, &c);
            claims(&m.w, claim[0]);
            claims(&m.clip, claim[1]);
            row_off(&s, &c, c.w, 1.0, 0.0, z, off[0]);
            row_off(&s, &c, c.clip, in.a, in.b, z, off[1]);
            eye_off(&in, off[0], off[1], eye);
            for (int cause = 0; cause < 2 * CAUSES; cause++)
                judge(&within, causes[cause / 2], off[cause % 2][cause / 2], claim[cause % 2][cause / 2],
                      &most[cause % 2][cause / 2]);
            for (int total = 0; total < TOTALS; total++)
                judge(&within, totals[total], eye[total], eye_claim[total], &most_eye[total]);
        }
        const char *name = dp_composition_get((dp_composition)k)->name;
        for (int cause = 0; cause < 2 * CAUSES; cause++)
            report(name, cause % 2 == 0 ? "w" : "z", causes[cause / 2], most[cause % 2][cause / 2]);
        for (int total = 0; total < TOTALS; total++)
            report(name, "eye depth,", totals[total], most_eye[total]);
    }
    tally_end(&within);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(within_four_times),
        cmocka_unit_test(random_set_ups),
        cmocka_unit_test(each_cause),
    };
    return run_tap(tests);
}
