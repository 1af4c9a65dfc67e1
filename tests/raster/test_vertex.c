/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Vertex programs: each operation against MPFR of 24 bits; how vertices are drawn; what two programs part, counted one
 * by one; the bias that makes up for it; and numbers that were published. */

#include <mpfr.h>

#include "named.h"
#include "raster/vertex_compare.h"
#include "setups.h"
#include "support.h"

static dp_setup setup_of(dp_mapping mapping, const char *format, double n, double f, int ortho) {
    return SETUP(format, .mapping = mapping, .znear = n, .zfar = f, .ortho = ortho);
}

/* ---- Operations -------------------------------------------------------------------------------------------------- */

/* The meaning of each name, written down again: F fused. */
static const struct {
    const char *name;
    char matrices, order;
    bool fused;
} meant[] = {{"once", '1', 'l', false},     {"products", 'p', 'l', false}, {"separate", '2', 'l', false},
             {"right", '1', 'r', false},    {"pairs", '1', 'p', false},    {"fma", '1', 'l', true},
             {"fma-right", '1', 'r', true}, {"fma-pairs", '1', 'p', true}, {"separate-fma", '2', 'l', true}};

/* a x + sum, rounded to 24 bits once or twice. */
static float step(bool fused, float a, float x, float sum) {
    mpfr_t m, n;
    mpfr_inits2(24, m, n, (mpfr_ptr)NULL);
    mpfr_set_flt(n, a, MPFR_RNDN);
    if (fused) {
        mpfr_t y, s;
        mpfr_inits2(24, y, s, (mpfr_ptr)NULL);
        mpfr_set_flt(y, x, MPFR_RNDN);
        mpfr_set_flt(s, sum, MPFR_RNDN);
        mpfr_fma(m, n, y, s, MPFR_RNDN);
        mpfr_clears(y, s, (mpfr_ptr)NULL);
    } else {
        mpfr_mul_d(m, n, (double)x, MPFR_RNDN);
        mpfr_add_d(m, m, (double)sum, MPFR_RNDN);
    }
    const float out = mpfr_get_flt(m, MPFR_RNDN);
    mpfr_clears(m, n, (mpfr_ptr)NULL);
    return out;
}

static float row_of(char order, bool fused, const float r[4], const float x[3]) {
    if (order == 'r')
        return step(fused, r[0], x[0], step(fused, r[1], x[1], step(fused, r[2], x[2], r[3])));
    const float two = step(fused, r[1], x[1], step(false, r[0], x[0], 0.0f));
    if (order == 'p')
        return step(false, 1.0f, two, step(fused, r[2], x[2], r[3]));
    return step(false, 1.0f, step(fused, r[2], x[2], two), r[3]);
}

static bool is_rounded(float got, long double exact) {
    const float other = nextafterf(got, (long double)got < exact ? HUGE_VALF : -HUGE_VALF);
    const long double ulp = fabsl((long double)other - (long double)got);
    return fabsl((long double)got - exact) <= 0.500001L * ulp;
}

/* Clip z over NDC depth, from the definition of each mapping in depthprec(7). */
static void entries(const dp_setup *s, long double *a, long double *b) {
    const long double n = s->spec.znear, f = s->spec.zfar;
    const dp_mapping m = s->spec.mapping;
    const long double k = s->spec.ortho ? 1.0L / (f - n) : f / (f - n), l = s->spec.ortho ? -n * k : -n * k;
    const bool reversed = m == DP_MAPPING_REVERSED || m == DP_MAPPING_GL_REVERSED;
    const bool is_signed = m == DP_MAPPING_GL || m == DP_MAPPING_GL_REVERSED;
    /* d3d, k z + l over w; reversed, w less that; [-1, 1], twice that less w */
    *a = reversed ? (s->spec.ortho ? -k : 1.0L - k) : k;
    *b = reversed ? (s->spec.ortho ? 1.0L - l : -l) : l;
    if (is_signed) {
        *a = 2.0L * *a - (s->spec.ortho ? 0.0L : 1.0L);
        *b = 2.0L * *b - (s->spec.ortho ? 1.0L : 0.0L);
    }
}

static void check_camera(tally *t, const dp_setup *s, const vertex_camera *c, const vertex_drawn *v) {
    long double a, b, constant = 0;
    entries(s, &a, &b);
    for (int i = 0; i < 3; i++)
        constant -= (long double)v->axis[i] * (long double)v->place[i];
    for (int i = 0; i < 4; i++) {
        const long double view = i < 3 ? (long double)v->axis[i] : constant;
        const long double once = a * view + (i < 3 ? 0.0L : b);
        const float products = step(false, c->a, c->view[i], i < 3 ? 0.0f : c->b);
        TALLY(t, is_rounded(c->view[i], view), "view %d: %a", i, (double)c->view[i]);
        TALLY(t, fabsl(a) < 1e-6L || is_rounded(c->once[i], once), "once %d: %a", i, (double)c->once[i]);
        TALLY(t, c->products[i] == products, "products %d: %a", i, (double)c->products[i]);
    }
    TALLY(t, is_rounded(c->a, a) && is_rounded(c->b, b), "entries %a %a", (double)c->a, (double)c->b);
}

TEST(test_operations) {
    tally t = {.name = "operations"};
    size_t count = 0;
    while (vertex_program_get(count) != NULL)
        count++;
    assert_int_equal(count, sizeof meant / sizeof meant[0]);
    for (int k = 0; k < 8; k++) {
        const dp_setup setup = setup_of((dp_mapping)(k / 2), "unorm24", 0.3, 700.0, k % 2);
        dp_pipeline p;
        assert_int_equal(dp_pipeline_init(&p, &setup), DP_OK);
        const vertex_request r = {.setup = &setup, .lo = 0.3, .hi = 700, .world = 50, .seed = 9};
        for (uint64_t i = 0; i < test_cases(50, 500, 5000); i++) {
            vertex_drawn v;
            assert_true(vertex_draw(&r, i, &v));
            const vertex_camera c = vertex_camera_of(&setup, &p, v.axis, v.place);
            check_camera(&t, &setup, &c, &v);
            for (size_t m = 0; m < count; m++) {
                const vertex_clip got = vertex_run(vertex_program_find(meant[m].name), &c, v.position);
                const bool fused = meant[m].fused;
                const float eye = row_of(meant[m].order, fused, c.view, v.position);
                const float *row = meant[m].matrices == '1' ? c.once : c.products;
                const float z = meant[m].matrices == '2' ? step(fused, c.a, eye, c.b)
                                                         : row_of(meant[m].order, fused, row, v.position);
                TALLY(&t, got.z == z && got.w == (k % 2 != 0 ? 1.0f : eye), "%s: %a / %a, not %a", meant[m].name,
                      (double)got.z, (double)got.w, (double)z);
            }
        }
    }
    tally_end(&t);
}

/* ---- How vertices are drawn -------------------------------------------------------------------------------------- */

enum { PARTS = 8, QUANTITIES = 9 };

/* Each of these is uniform in [0, 1): how often it falls into each eighth. */
static void count_parts(const vertex_request *r, const vertex_drawn *v, uint64_t parts[QUANTITIES][PARTS]) {
    double along = 0, beside = 0;
    double q[QUANTITIES];
    for (int k = 0; k < 3; k++) {
        const double off = (double)v->position[k] - v->place[k];
        along += off * v->axis[k];
        beside += off * off;
        q[k] = 0.5 + 0.5 * v->place[k] / r->world;
        q[3 + k] = 0.5 + 0.5 * v->axis[k]; /* a coordinate of a point of the sphere is uniform */
        q[6 + k] = 0.5 + 0.5 * (double)v->position[k] / r->world;
    }
    if (r->spread == VERTEX_EYE_LOG) {
        q[6] = log(v->z / r->lo) / log(r->hi / r->lo);
        q[7] = (beside - along * along) / (along * along); /* square of the distance from the axis at z = 1 */
        q[8] = q[0];
    }
    for (int k = 0; k < QUANTITIES; k++)
        parts[k][(int)(fmin(fmax(q[k], 0.0), 0.999999) * PARTS)]++;
}

TEST(test_draws) {
    const dp_setup setup = setup_of(DP_MAPPING_D3D, "fp32", 0.1, 1000, 0);
    for (int s = 0; s < VERTEX_SPREAD_COUNT; s++) {
        const vertex_request r = {
            .setup = &setup, .spread = (vertex_spread)s, .lo = 5, .hi = 500, .world = 1, .seed = 3};
        tally t = {.name = vertex_spread_name(r.spread)};
        uint64_t parts[QUANTITIES][PARTS] = {{0}};
        const uint64_t draws = 40000;
        uint64_t kept = 0;
        for (uint64_t i = 0; i < draws; i++) {
            vertex_drawn v;
            double along = 0, length = 0;
            const bool counted = vertex_draw(&r, i, &v);
            for (int k = 0; k < 3; k++) {
                along += ((double)v.position[k] - v.place[k]) * v.axis[k];
                length += v.axis[k] * v.axis[k];
            }
            TALLY(&t, fabs(length - 1) < 1e-12 && fabs(along - v.z) <= 1e-4, "vertex %llu: axis %g, depth %g, not %g",
                  (unsigned long long)i, length, along, v.z);
            TALLY(&t, counted == (v.z >= r.lo && v.z <= r.hi), "vertex %llu at %g", (unsigned long long)i, v.z);
            kept += counted;
            count_parts(&r, &v, parts);
        }
        assert_true(s == VERTEX_BOX ? kept == 0 : kept == draws); /* no corner of that box is so far away */
        for (int k = 0; k < QUANTITIES; k++)
            for (int i = 0; i < PARTS; i++) /* 5 standard deviations */
                TALLY(&t, fabs((double)parts[k][i] - (double)draws / PARTS) < 5.0 * sqrt((double)draws / PARTS),
                      "quantity %d, part %d: %llu", k, i, (unsigned long long)parts[k][i]);
        tally_end(&t);
    }
}

/* ---- Differences ------------------------------------------------------------------------------------------------- */

static int by_size(const void *a, const void *b) {
    const uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return (x > y) - (x < y);
}

/* Stored by a test's own viewport and conversion: [0, 1], ieee, fp32 or unorm. */
static float depth_of(vertex_clip c) {
    const float d = c.z / c.w;
    return d >= 1.0f ? 1.0f : d > 0.0f ? d : 0.0f;
}

static uint32_t code_of(const dp_format *format, float d) {
    uint32_t bits;
    memcpy(&bits, &d, sizeof bits);
    return format->kind == DP_FORMAT_FLOAT ? bits : (uint32_t)floor((double)d * (double)format->code_max + 0.5);
}

typedef struct passes {
    float first, second; /* window depths */
} passes;

/* Is a pass, moved towards the camera, still behind the other one? */
static bool is_lost(const dp_setup *setup, const bias_api *api, double units, float moved, float other) {
    const dp_format *format = &setup->spec.format;
    const bias_state state = {.api = api, .units = setup->reversed ? units : -units};
    const double offset = bias_offset(&state, bias_unit_at(api, format, (double)moved).least, 0.0);
    const uint32_t code = code_of(format, fminf(fmaxf((float)((double)moved + offset), 0.0f), 1.0f));
    return setup->reversed ? code < code_of(format, other) : code > code_of(format, other);
}

/* The bias of either pass is enough for each vertex, and a fiftieth less is not for all. */
static void check_bias(tally *t, const dp_setup *setup, const vertex_difference *d, const passes *all, uint64_t count) {
    const dp_format *format = &setup->spec.format;
    for (size_t i = 0; bias_api_get(i) != NULL; i++) {
        const bias_api *api = bias_api_get(i);
        const double units = fmax(bias_units(api, format, d->widest.depth, d->widest.bias),
                                  bias_units(api, format, d->steepest.depth, d->steepest.bias));
        const double less = 0.98 * units;
        uint64_t lost = 0, lost_below = 0;
        for (uint64_t k = 0; k < count && isfinite(units); k++) {
            const float one = all[k].first, two = all[k].second;
            lost += is_lost(setup, api, units, one, two) || is_lost(setup, api, units, two, one);
            lost_below += is_lost(setup, api, less, one, two) || is_lost(setup, api, less, two, one);
        }
        TALLY(t, lost == 0, "%s: %g units lose %llu vertices", api->name, units, (unsigned long long)lost);
        TALLY(t, d->most < 100 || !isfinite(units) || lost_below > 0, "%s: %g units are too many", api->name, units);
    }
}

/* The codes to be found, vertex by vertex; `codes` and `all` have room for each. */
static vertex_difference count_by_one(const vertex_request *r, const vertex_program *other, uint32_t *codes,
                                      passes *all) {
    const dp_format *format = &r->setup->spec.format;
    vertex_difference d = {.most_z = NAN};
    dp_pipeline p;
    dp_pipeline_init(&p, r->setup);
    for (uint64_t i = 0; i < r->count; i++) {
        vertex_drawn v;
        if (!vertex_draw(r, i, &v))
            continue;
        const vertex_camera c = vertex_camera_of(r->setup, &p, v.axis, v.place);
        const passes two = {depth_of(vertex_run(r->base, &c, v.position)), depth_of(vertex_run(other, &c, v.position))};
        const int64_t apart = (int64_t)code_of(format, two.first) - (int64_t)code_of(format, two.second);
        const uint32_t size = (uint32_t)llabs(apart);
        if (size > d.most || (size == d.most && size > 0 && v.z < d.most_z)) {
            d.most = size;
            d.most_z = v.z;
        }
        d.differ += size > 0;
        if (size > 0)
            d.widest.bias = fmax(d.widest.bias, fabs((double)two.first - (double)two.second));
        all[d.vertices] = two;
        codes[d.vertices++] = size;
    }
    qsort(codes, d.vertices, sizeof *codes, by_size);
    d.percentile = codes[d.vertices - 1 - d.vertices / 100]; /* a hundredth of all lies above */
    return d;
}

static bool alike(const vertex_difference *a, const vertex_difference *b) {
    return a->vertices == b->vertices && a->differ == b->differ && a->percentile == b->percentile &&
           a->most == b->most && (a->most_z == b->most_z || (isnan(a->most_z) && isnan(b->most_z))) &&
           a->widest.bias == b->widest.bias;
}

TEST(test_differences) {
    static const struct {
        dp_mapping mapping;
        const char *format, *base, *other;
        vertex_spread spread;
        double world;
    } rows[] = {
        {DP_MAPPING_D3D, "fp32", "once", "separate", VERTEX_EYE_LOG, 100},
        {DP_MAPPING_REVERSED, "fp32", "once", "fma", VERTEX_EYE_LOG, 100},
        {DP_MAPPING_D3D, "unorm24", "fma", "separate-fma", VERTEX_EYE_LOG, 100},
        {DP_MAPPING_REVERSED, "unorm24", "products", "right", VERTEX_BOX, 700},
        {DP_MAPPING_D3D, "unorm16", "separate", "pairs", VERTEX_BOX, 5000},
        {DP_MAPPING_D3D, "unorm16", "once", "fma", VERTEX_EYE_LOG, 0},
        {DP_MAPPING_D3D, "fp32", "right", "right", VERTEX_EYE_LOG, 100},
    };
    tally t = {.name = "differences"};
    const uint64_t draws = test_cases(6000, 30000, 300000);
    uint32_t *codes = malloc(draws * sizeof *codes);
    passes *all = malloc(draws * sizeof *all);
    for (size_t k = 0; k < sizeof rows / sizeof rows[0]; k++) {
        const dp_setup setup = setup_of(rows[k].mapping, rows[k].format, 0.1, 1000, 0);
        vertex_request r = {.setup = &setup,
                            .spread = rows[k].spread,
                            .lo = 0.1,
                            .hi = 900,
                            .world = rows[k].world,
                            .count = draws,
                            .seed = 11,
                            .base = vertex_program_find(rows[k].base),
                            .other = {vertex_program_find("fma-pairs"), vertex_program_find(rows[k].other)},
                            .others = 2,
                            .threads = 1};
        vertex_difference found[VERTEX_OTHERS], again[VERTEX_OTHERS];
        assert_true(vertex_compare(&r, found));
        r.threads = 3;
        assert_true(vertex_compare(&r, again));
        const vertex_difference *d = &found[1], is = count_by_one(&r, r.other[1], codes, all);
        assert_true(is.vertices > draws / 50);
        TALLY(&t, alike(&found[0], &again[0]) && alike(&found[1], &again[1]), "row %zu: threads", k);
        TALLY(&t, d->vertices == is.vertices && d->differ == is.differ, "row %zu: %llu of %llu differ, not %llu", k,
              (unsigned long long)d->differ, (unsigned long long)d->vertices, (unsigned long long)is.differ);
        TALLY(&t, d->most == is.most && (d->most_z == is.most_z || is.most == 0) && isnan(d->most_z) == (is.most == 0),
              "row %zu: most %u at %g", k, d->most, d->most_z);
        TALLY(&t, d->percentile >= is.percentile && d->percentile <= is.percentile * (1.0 + 0x1p-11),
              "row %zu: 99 %% within %u, not %u", k, d->percentile, is.percentile);
        TALLY(&t, d->widest.bias == is.widest.bias, "row %zu: bias %g, not %g", k, d->widest.bias, is.widest.bias);
        TALLY(&t, (is.differ == 0) == (r.base == r.other[1]), "row %zu: none differs", k);
        check_bias(&t, &setup, d, all, is.vertices);
    }
    free(codes);
    free(all);
    tally_end(&t);
}

/* ---- Published numbers ------------------------------------------------------------------------------------------- */

/* Percent that differ, within 5, and the 99th percentile, within a quarter; near 0.1, far 1000, camera within 100. */
TEST(test_published) {
    static const struct {
        dp_mapping mapping;
        const char *format, *other;
        vertex_spread spread;
        double percent, lo, hi; /* codes; box: any */
    } rows[] = {
        {DP_MAPPING_D3D, "fp32", "separate", VERTEX_EYE_LOG, 82, 3000, 5000},
        {DP_MAPPING_REVERSED, "fp32", "separate", VERTEX_EYE_LOG, 28, 5, 6},
        {DP_MAPPING_REVERSED, "unorm24", "separate", VERTEX_EYE_LOG, 3.6, 1, 1},
        {DP_MAPPING_D3D, "fp32", "separate", VERTEX_BOX, 62, 0, HUGE_VAL},
        {DP_MAPPING_REVERSED, "fp32", "separate", VERTEX_BOX, 25, 0, HUGE_VAL},
        {DP_MAPPING_REVERSED, "unorm24", "separate", VERTEX_BOX, 0.1, 0, HUGE_VAL},
        {DP_MAPPING_REVERSED, "fp32", "fma", VERTEX_EYE_LOG, 30, 300, 500},
        {DP_MAPPING_REVERSED, "fp32", "fma-right", VERTEX_EYE_LOG, 76, 300, 500},
    };
    tally t = {.name = "published"};
    for (size_t k = 0; k < sizeof rows / sizeof rows[0]; k++) {
        const dp_setup setup = setup_of(rows[k].mapping, rows[k].format, 0.1, 1000, 0);
        const vertex_request r = {.setup = &setup,
                                  .spread = rows[k].spread,
                                  .lo = 0.1,
                                  .hi = 1000,
                                  .world = 100,
                                  .count = 100000,
                                  .base = vertex_program_find("once"),
                                  .other = {vertex_program_find(rows[k].other)},
                                  .others = 1};
        vertex_difference d[VERTEX_OTHERS];
        assert_true(vertex_compare(&r, d));
        const double percent = 100.0 * (double)d->differ / (double)d->vertices;
        TALLY(&t, fabs(percent - rows[k].percent) <= 5.0, "row %zu: %g %% differ", k, percent);
        TALLY(&t, d->percentile >= rows[k].lo && d->percentile <= rows[k].hi, "row %zu: 99 %% within %u", k,
              d->percentile);
    }
    tally_end(&t);
}
