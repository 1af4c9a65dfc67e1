/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The figure of shadow maps, as drawn, against the room shadow: gaps and causes of each map at each angle. */
#include "drawn.h"
#include "printed.h"
#include "shadow/shadow.h"
#include "support.h"

/* In the order of the legend; which causes stand together is written down here. */
static const struct {
    const char *name;
    bool gap;
    int which[4]; /* the way; or the causes, up to -1 */
} curves[] = {
    {"gap, constant", true, {SHADOW_CONSTANT}},
    {"gap, slope-scaled", true, {SHADOW_SLOPE}},
    {"gap, normal offset", true, {SHADOW_NORMAL}},
    {"texel, kernel, lookup", false, {SHADOW_CAUSE_TEXEL, SHADOW_CAUSE_KERNEL, SHADOW_CAUSE_LOOKUP, -1}},
    {"snapping, set-up", false, {SHADOW_CAUSE_SNAPPING, SHADOW_CAUSE_SETUP, -1}},
    {"position", false, {SHADOW_CAUSE_POSITION, SHADOW_CAUSE_RECEIVER, -1}},
    {"format", false, {SHADOW_CAUSE_FORMAT, -1}},
};

enum { CURVES = sizeof curves / sizeof curves[0] };

typedef struct curve {
    shadow_light light;
    int index;
} curve;

static double length_at(const curve *c, double angle) {
    const double depth = c->light.setup.spec.zfar - c->light.setup.spec.znear;
    double along_light, along_normal, sum = 0;
    shadow_need need;
    shadow_need_of(&c->light, &need);
    if (curves[c->index].gap) {
        shadow_gap_at(&c->light, &need.bias[curves[c->index].which[0]], angle, &along_light, &along_normal);
        return along_light;
    }
    for (const int *cause = curves[c->index].which; *cause >= 0; cause++)
        sum += shadow_part_at(&c->light, &need.part[*cause], angle) * depth;
    return sum;
}

static bool true_length(const void *context, double from, double to, double *lo, double *hi) {
    const double a = length_at(context, fmax(from, 0)), b = length_at(context, to);
    *lo = fmin(a, b);
    *hi = fmax(a, b);
    return from >= 1; /* at 0 some are 0, which a log axis has not */
}

static shadow_light light_of(const char *format, int side, double kernel, double angle) {
    shadow_light light = shadow_light_default();
    dp_spec spec = light.setup.spec;
    dp_format found[2];
    assert_int_equal(dp_format_parse(format, found), 1);
    spec.format = found[0];
    spec.zfar = 80;
    assert_int_equal(dp_setup_init(&light.setup, &spec), DP_OK);
    light.width = 30;
    light.height = 20;
    light.triangles.width = light.triangles.height = side;
    light.triangles.slant_hi = angle;
    light.kernel = kernel;
    light.receiver_hi = 80;
    return light;
}

static void check_panel(const drawn *d, const drawn_panel *p, const shadow_light *light) {
    assert_true(!p->x.log && p->y.log);
    assert_px(drawn_px(&p->x, 0), p->frame.x0, 1);
    assert_px(drawn_px(&p->x, light->triangles.slant_hi), p->frame.x1, 1);
    for (int k = 0; k < CURVES; k++) {
        const drawn_entry *e = drawn_legend(d, curves[k].name);
        const curve c = {*light, k};
        const svg_mark *line = drawn_curve(d, p, e);
        drawn_follows(p, &p->y, line, true_length, &c, 60, 2);
        assert_px(line->box.x1, p->frame.x1, 1);
        drawn_style_is(d, e, k < SHADOW_WAY_COUNT ? -1 : k - SHADOW_WAY_COUNT, k < SHADOW_WAY_COUNT ? 2 * k : 0,
                       k < SHADOW_WAY_COUNT ? DRAWN_NONE : (drawn_shape)(DRAWN_DISC + k - SHADOW_WAY_COUNT), false);
    }
}

TEST(one_box) {
    const drawn_theme *const looks[] = {&drawn_light, &drawn_dark};
    const shadow_light light = light_of("unorm16", 1024, 2.5, 70);
    for (size_t i = 0; i < 2; i++) {
        drawn *d = drawn_run(looks[i],
                             "plot shadow --light-box 30mx20mx80m -F d16 --size 1024 --kernel 5 --angle 70 --theme %s",
                             looks[i]->name);
        assert_int_equal(d->panel_count, 1);
        assert_string_equal(d->subtitle, "unorm16 d3d, 1024 x 1024 texels, filter of 5 x 5; box 30 x 20 x 80");
        assert_int_equal(d->entry_count, CURVES);
        check_panel(d, &d->panels[0], &light);
        drawn_close(d);
    }
}

TEST(cascades) {
    const shadow_split split = {0.5, 60, 40, 2, 3, 0.25, 30, true, NULL};
    const shadow_light model = light_of("fp32", 512, 1.5, 75);
    drawn *d = drawn_run(&drawn_light, "plot shadow -n 0.5 -f 60 --fov 40 --viewport 640x320 --cascades 3:0.25 "
                                       "--casters 30 --size 512");
    assert_int_equal(d->panel_count, 2); /* the first and the last, whose texels are the least and the most */
    assert_string_equal(d->subtitle,
                        "fp32 d3d, 512 x 512 texels, filter of 3 x 3; view near 0.5, far 60; of 3 cascades "
                        "the finest and the coarsest");
    for (int i = 0; i < 2; i++) {
        shadow_cascade c;
        char heading[96];
        assert_int_equal(shadow_cascade_of(&split, &model, 2 * i, &c), SHADOW_OK);
        snprintf(heading, sizeof heading, "Cascade %d: %.3g to %.3g, texel %.3g", 2 * i + 1, c.from, c.to,
                 c.light.width / 512);
        assert_string_equal(d->panels[i].heading, heading);
        check_panel(d, &d->panels[i], &c.light);
    }
    drawn_close(d);
}

/* The first angle at which less is given than needed; most where there is none. */
static double crossing(json_t *needed, json_t *given, double most) {
    for (size_t i = 0; i < json_array_size(needed); i++) {
        const double need = number_at(json_array_get(needed, i), "length");
        const double have = number_at(json_array_get(given, i), "length");
        if (!isnan(need) && !(have >= need))
            return number_at(json_array_get(needed, i), "angle");
    }
    return most;
}

/* With an engine the curves cross at the angle up to which its verdict of the same receivers is free of acne. */
TEST(where_an_engine_fails) {
    static const char *const engines[] = {"three", "bevy", "godot", "unity-urp", "babylon", "playcanvas", "filament"};
    static const char *const lights[] = {"--spot 90", "--spot 40", "--point", "--point --distance",
                                         "--light-box 20x20x50"};
    static const char *const formats[] = {"fp32 -m d3d", "fp32 -m reversed", "d16", "fp16 -m reversed"};
    tally t = {.name = "crossings"};
    rng r = rng_make("shadow crossings");
    uint64_t between = 0;
    for (uint64_t n = test_cases(40, 60, 600); n > 0; n--) {
        char line[256];
        const double z = rng_log(&r, 1, 20);
        const uint64_t light = rng_below(&r, 5);
        const char *engine = engines[rng_below(&r, 7)], *format = formats[rng_below(&r, 4)];
        const double bias = rng_log(&r, 1e-4, 1), normal = rng_below(&r, 2) ? 0 : rng_uniform(&r, 0, 2);
        snprintf(line, sizeof line,
                 "shadow --engine %s %s %s -F %s --range %.17g:%.17g --bias %.17g --normal-bias %.3g", engine,
                 lights[light], light < 4 ? "-n 0.5 -f 30" : "", format, z, z * (1 + 1e-6), bias, normal);
        printed p = print_of("%s --json", line);
        if (p.status == 0) { /* some engines have no such bias, or take only so much */
            json_t *root = json_of(p.out), *figure = json_printed(0, "plot %s", line);
            const double told = number_at(root, "setups[0].engines[0].free_to"), most = 75;
            json_t *series = json_object_get(json_array_get(json_object_get(figure, "panels"), 0), "series");
            const double at = crossing(json_object_get(json_array_get(series, 0), "points"),
                                       json_object_get(json_array_get(series, 1), "points"), most);
            between += at > 0 && at < most;
            /* the verdict takes tenths of a degree at their worst, the curves have a point in each 0.42 degrees */
            const double more = at - (isnan(told) ? 0 : told);
            TALLY(&t, more >= -1e-9 && more < 2, "%s: free to %g, drawn %g", line, told, at);
            json_decref(figure);
            json_decref(root);
        }
        printed_free(&p);
    }
    assert_true(between > 0);
    tally_end(&t);
}

TEST(data_of_an_engine) {
    check_says(0, "needed [scene units],\"given, three", "plot shadow --engine three --spot 90 -n 0.1 -f 30 --csv");
}
