/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The figure of large worlds, as drawn, against the room world: the gap and the jitter of each scheme. */
#include "drawn.h"
#include "printed.h"
#include "support.h"
#include "world/reach.h"

typedef struct curve {
    world_scheme scheme;
    const world_asked *asked;
    world_loss *loss;
} curve;

/* The arithmetic of a scheme changes where its size, or a part of it, is passed: there a curve jumps. */
static bool true_loss(const void *context, double from, double to, double *lo, double *hi) {
    const curve *c = context;
    *lo = INFINITY;
    *hi = 0.0;
    for (int i = 0; i <= 8; i++) {
        const double value = c->loss(&c->scheme, c->asked, from * pow(to / from, i / 8.0));
        *lo = fmin(*lo, value);
        *hi = fmax(*hi, value);
    }
    return *hi < 1e4; /* the top of the panel */
}

static void check_panel(const drawn *d, const drawn_panel *p, const world_asked *a, world_loss *loss, double metre) {
    assert_true(p->x.log && p->y.log);
    assert_px(drawn_px(&p->x, 1e2), p->frame.x0, 1);
    assert_px(drawn_px(&p->x, 1e8), p->frame.x1, 1);
    assert_px(drawn_px(&p->y, 1e-6), p->frame.y1, 1);
    assert_px(drawn_px(&p->y, 1e4), p->frame.y0, 1);
    for (size_t k = 0; k < WORLD_ROWS; k++) {
        const world_row *row = world_get(k);
        const double size = row->metres ? row->standard * metre : row->standard;
        const curve c = {{row, size}, a, loss};
        char name[64];
        snprintf(name, sizeof name, row->size != NULL ? "%s:%.7g" : "%s", row->name, size);
        const drawn_entry *e = drawn_legend(d, name);
        drawn_follows(p, &p->y, drawn_curve(d, p, e), true_loss, &c, 80, 4);
        drawn_style_is(d, e, (int)(k % 4), 2 * (int)(k / 4), DRAWN_NONE, false);
    }
}

/* Each point is what is lost at its distance, or the most up to the next. */
static void check_points(const char *options, const world_asked *a, double metre) {
    static world_loss *const losses[] = {world_separation, world_jitter};
    json_t *root = json_printed(0, "plot world %s", options);
    size_t i, points = 0;
    for (int p = 0; p < 2; p++)
        for (size_t k = 0; k < WORLD_ROWS; k++) {
            const world_row *row = world_get(k);
            const world_scheme scheme = {row, row->metres ? row->standard * metre : row->standard};
            const json_t *point, *list = node_at(root, "panels[%d].series[%zu].points", p, k);
            assert_int_equal(strncmp(text_at(root, "panels[%d].series[%zu].name", p, k), row->name, strlen(row->name)),
                             0);
            json_array_foreach(list, i, point) {
                const double z = number_at(point, "distance"), is = losses[p](&scheme, a, z);
                if (!json_is_number(node_at(point, "most")))
                    continue;
                assert_true(number_at(point, "most") >= is * (1 - 1e-9));
                points++;
            }
        }
    assert_true(points > 100);
    json_decref(root);
}

static void check_figure(const char *options, const char *format, const char *mapping, double zfar, double z,
                         double metre, const char *title, const char *camera) {
    dp_spec spec = dp_spec_default();
    dp_setup setup;
    dp_format found[2];
    const double half = tan(30.0 * 3.14159265358979323846 / 180.0);
    assert_int_equal(dp_format_parse(format, found), 1);
    spec.format = found[0];
    assert_int_equal(dp_mapping_parse(mapping, &spec.mapping), DP_OK);
    spec.zfar = zfar;
    spec.model = DP_MODEL_FLOAT;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    const world_asked a = {
        .setup = &setup, .z = z, .ray_ratio = hypot(1.0, half * hypot(1.0, 1920.0 / 1080.0)), .pixels = 540.0 / half};
    drawn *d = drawn_run(&drawn_light, "plot world %s", options);
    assert_int_equal(d->panel_count, 2);
    char said[256];
    snprintf(said, sizeof said, "%s; 1920x1080, fov 60, meshes with origins of their own", camera);
    assert_string_equal(d->subtitle, said);
    assert_string_equal(d->panels[0].heading, title);
    assert_string_equal(d->panels[1].heading, "Jitter, pixels");
    check_panel(d, &d->panels[0], &a, world_separation, metre);
    check_panel(d, &d->panels[1], &a, world_jitter, metre);
    drawn_close(d);
    check_points(options, &a, metre);
}

TEST(test_figure) {
    check_figure("-F fp32 -m reversed -f inf", "fp32", "reversed", INFINITY, 10, 1,
                 "Separation that is safe, scene units",
                 "fp32 reversed, near 0.1, far inf, perspective, nearest, float ieee, 10 ahead");
    check_figure("-F d24 -m d3d -f 5000 --at 300", "unorm24", "d3d", 5000, 300, 1,
                 "Separation that is safe, scene units",
                 "unorm24 d3d, near 0.1, far 5000, perspective, nearest, float ieee, at depth 300");
    check_figure("-F fp32 -m reversed -f inf --unit cm", "fp32", "reversed", INFINITY, 1000, 100,
                 "Separation that is safe, cm",
                 "fp32 reversed, near 0.1, far inf, perspective, nearest, float ieee, lengths in cm, 1000 ahead");
}

/* The legend says from where on one curve hides another in both panels: where neither parts them by half a stroke,
 * which is 1/300 of an axis of ten decades. */
TEST(hidden_in_both_panels) {
    drawn *d = drawn_run(&drawn_light, "plot world -F fp32 -m reversed -f inf --unit m");
    json_t *root = json_printed(0, "plot world -F fp32 -m reversed -f inf --unit m");
    double said, parted = 0, next = 0;
    assert_int_equal(sscanf(drawn_legend(d, "absolute")->text, "absolute, hidden by local from %lf", &said), 1);
    for (int p = 0; p < 2; p++) {
        const json_t *absolute = node_at(root, "panels[%d].series[0].points", p);
        const json_t *local = node_at(root, "panels[%d].series[1].points", p);
        for (size_t i = 0; i + 1 < json_array_size(local); i++) {
            const double a = number_at(absolute, "[%zu].most", i), b = number_at(local, "[%zu].most", i);
            const double at = number_at(local, "[%zu].distance", i);
            if (fabs(log10(a / b)) > 10.0 / 300 && at > parted) {
                parted = at;
                next = number_at(local, "[%zu].distance", i + 1);
            }
        }
    }
    assert_true(parted > 100 && said >= parted * (1 - 5e-3) && said <= next * (1 + 5e-3));
    assert_string_equal(drawn_legend(d, "camera-float")->text, "camera-float");
    json_decref(root);
    drawn_close(d);
}
