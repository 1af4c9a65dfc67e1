/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Depth ranges of viewports, surfaces that face the camera, drawn by the models of src/raster: of a thousand random
 * ranges every pair of some thousand depths is in order where the guarantee says so, and how much longer that is than
 * the longest pair that is not. test_triangles_drawn.c has slanted ones.
 */
#include "core/bits.h"
#include "raster/draw.h"
#include "support.h"

enum { DEPTHS = 4000, REACH = 6, STRETCHES = 256, VIEW = 64 };

/* A random camera of a rasterizer in a random range. */
typedef struct stage {
    const raster_row *row;
    dp_setup setup;
    draw_camera camera;
} stage;

static stage any_stage(rng *r) {
    static const char *const formats[] = {"fp32", "unorm24", "unorm16"};
    stage s;
    dp_format found[2];
    do {
        s.row = raster_get(rng_below(r, 4));
        assert_int_equal(dp_format_parse(formats[rng_below(r, 3)], found), 1);
    } while (!raster_draws(s.row, found));
    dp_spec spec = dp_spec_default();
    do
        spec.mapping = (dp_mapping)rng_below(r, DP_MAPPING_GL_REVERSED + 1);
    while (!raster_arith(s.row, dp_mapping_get(spec.mapping)->ndc_signed, &spec.arith));
    spec.format = found[0];
    spec.model = DP_MODEL_FLOAT;
    spec.znear = rng_log(r, 0.01, 10);
    spec.zfar = rng_below(r, 4) == 0 ? INFINITY : spec.znear * rng_log(r, 10, 1e6);
    spec.triangles = dp_triangles_default();
    spec.triangles.width = spec.triangles.height = VIEW;
    raster_describe(s.row, &spec.triangles);
    rng_range(r, spec.depth_range);
    assert_int_equal(dp_setup_init(&s.setup, &spec), DP_OK);
    assert_int_equal(draw_camera_init(&s.camera, s.row, &s.setup), RASTER_OK);
    s.setup = dp_setup_facing(&s.setup);
    return s;
}

static void take_first(void *key, int x, int y, int count, const uint32_t *keys) {
    (void)x, (void)y, (void)count;
    *(int64_t *)key = *keys;
}

/* What the depth test compares of a surface at z: the nearer, the less; -1 where a plane clips it. The sides of the
 * screen may have made all its vertices, which Mesa rounds otherwise than those that it is given. */
static int64_t key_of(const stage *s, float z, bool cut) {
    static const double whole[3][2] = {{10, 10}, {30, 10}, {10, 30}},
                        beyond[3][2] = {{-999, -999}, {999, -999}, {30, 999}};
    const double(*window)[2] = cut ? beyond : whole;
    const draw_area pixel = {14, 14, 1, 1};
    double place[3][3];
    int64_t key = -1;
    for (int i = 0; i < 3; i++)
        draw_at(&s->camera, window[i], (double)z, place[i]);
    return dp_pipeline_drawn(&s->camera.pipeline, z) &&
                   draw_keys(&s->camera, &pixel, (const double(*)[3])place, take_first, &key)
               ? key
               : -1;
}

/* From one depth to the next, in steps of binary32: so many that all reach as far as some guarantees. */
static uint32_t step_of(float z, double guaranteed) {
    const double ulp = (double)nextafterf(z, HUGE_VALF) - (double)z;
    return (uint32_t)fmax(1, ceil(REACH * guaranteed / DEPTHS / ulp));
}

/* The longest pair that is not in order, by the greatest key so far; each is judged. */
static double longest_wrong(const stage *s, float z, uint32_t step, tally *t) {
    static float at[DEPTHS];
    static int64_t most[DEPTHS];
    double longest = 0;
    int count = 0;
    for (; count < DEPTHS; count++) {
        const int64_t key[2] = {key_of(s, z, false), key_of(s, z, true)};
        const int64_t nearest = key[0] < key[1] ? key[0] : key[1], farthest = key[0] < key[1] ? key[1] : key[0];
        if (nearest < 0) /* beyond a plane */
            break;
        int first = count;
        for (int lo = 0; lo < first;) {
            const int middle = (lo + first) / 2;
            if (most[middle] >= nearest)
                first = middle;
            else
                lo = middle + 1;
        }
        at[count] = z;
        most[count] = count > 0 && most[count - 1] > farthest ? most[count - 1] : farthest;
        const double apart = (double)z - (double)at[first];
        TALLY(t, first == count || apart <= dp_separation(&s->setup, (double)at[first]),
              "%s, %s %s, %a to %a, %.17g to %.17g: %.9g and %.9g", s->row->name,
              dp_mapping_get(s->setup.spec.mapping)->name, s->setup.spec.format.name, s->setup.spec.depth_range[0],
              s->setup.spec.depth_range[1], s->setup.spec.znear, s->setup.spec.zfar, (double)at[first], (double)z);
        longest = fmax(longest, apart);
        z = dp_ranked32(dp_rank32(z) + step);
    }
    return longest;
}

/*
 * Where enough of it lies before far; else infinity is. Roundings seldom agree, so of a guarantee of few steps of
 * binary32 the longest pair of many stretches counts, all over the binade.
 */
static double slack_at(const stage *s, float z, tally *t) {
    const double guaranteed = dp_separation(&s->setup, (double)z), binade = ldexp(1, ilogbf(z));
    if (!(2 * binade + 2 * REACH * guaranteed < s->setup.spec.zfar))
        return (double)INFINITY;
    const uint32_t step = step_of(z, guaranteed);
    double longest = (double)dp_ranked32(dp_rank32(z) + step) - (double)z;
    for (int i = 0; i < STRETCHES && !(4 * longest >= guaranteed); i++) {
        const double at = (double)z + binade * i / STRETCHES;
        longest = fmax(longest, longest_wrong(s, (float)(at < 2 * binade ? at : at - binade), step, t));
    }
    return guaranteed / longest;
}

/* Of six steps of binary32 or fewer: that two depths of one binade need them all is rarer than depths are. */
static bool is_short(const stage *s, float z) {
    return dp_separation(&s->setup, (double)z) <= 6.001 * ((double)nextafterf(z, HUGE_VALF) - (double)z);
}

TEST(in_order) {
    rng r = rng_make("facing in ranges");
    tally t = {.name = "surfaces that face the camera"}, loose = {.name = "slack"};
    double most = 0;
    unsigned few = 0;
    for (const uint64_t ranges = test_cases(100, 1000, 10000); loose.cases < ranges;) {
        const stage s = any_stage(&r);
        const dp_spec *c = &s.setup.spec;
        const float z = (float)rng_log(&r, c->znear * 1.001, fmin(c->zfar, 1e5 * c->znear));
        const double slack = slack_at(&s, z, &t);
        if (isinf(slack))
            continue;
        if (slack > 4 && is_short(&s, z)) {
            few++;
            continue;
        }
        most = fmax(most, slack);
        TALLY(&loose, slack <= 4 * (1 + 1e-9), "%s, %s, %.9g:%.9g: %.3f at %.9g", s.row->name, c->format.name,
              c->depth_range[0], c->depth_range[1], slack, (double)z);
    }
    print_message("# %llu ranges: the guarantee is at most %.2f times the longest pair that is not in order\n",
                  (unsigned long long)loose.cases, most);
    print_message("# of %u guarantees of six steps of binary32 or fewer no such pair was found\n", few);
    assert_true(few <= loose.cases / 50);
    tally_end(&t);
    tally_end(&loose);
}
