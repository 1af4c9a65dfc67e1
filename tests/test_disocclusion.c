/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What upscalers ship, by hand; ours as the library guarantees it; every value that the command prints of both. */
#include <stdio.h>
#include <string.h>

#include "api/disocclusion.h"
#include "printed.h"

static const double pi = 3.14159265358979323846;

/* By the horizontal angle, in long double. */
static double shipped_by_hand(size_t i, double hfov, int width, int height) {
    const long double half = tanl((long double)hfov * pi / 360);
    const long double high = half * height / width, corner = sqrtl(1 + half * half + high * high);
    const long double w = width, h = height;
    return (double)(1.37e-5L * (i == 0 ? half * w / 2 : corner * sqrtl(w * w + h * h)));
}

static void test_shipped(void **state) {
    static const struct {
        double hfov;
        int width, height;
    } views[] = {{90, 1920, 1080}, {60, 3840, 2160}, {120, 1280, 1024}, {1, 100, 300}, {45, 640, 640}};
    (void)state;
    for (size_t i = 0; i < sizeof views / sizeof views[0]; i++)
        for (size_t k = 0; k < DISOCCLUSION_ROWS; k++) {
            const disocclusion_view v = {views[i].width, views[i].height,
                                         2 * atan(tan(views[i].hfov * pi / 360) * views[i].height / views[i].width) *
                                             180 / pi};
            assert_relative(disocclusion_get(k)->share(&v),
                            shipped_by_hand(k, views[i].hfov, views[i].width, views[i].height), 1e-12);
        }
    assert_null(disocclusion_get(DISOCCLUSION_ROWS));
    /* 1.3 % and 4.6 % of z at 1080p and 90 degrees */
    assert_scene(shipped_by_hand(0, 90, 1920, 1080), 0.013, 0.0005);
    assert_scene(shipped_by_hand(1, 90, 1920, 1080), 0.046, 0.0005);
}

typedef struct disocclusion_case {
    camera_case camera;
    dp_triangles triangles;
    const char *options, *raster; /* of the view */
    double depths[4];             /* 0: no more; the first 0: not written */
    size_t count;
    double middle; /* the depth where none is written */
} disocclusion_case;

static const disocclusion_case cases[] = {
    {{0.1, 1000, {"fp32", "unorm24", "fp16"}, {"d3d", "reversed"}, .implied = true, .model = DP_MODEL_FLOAT},
     {1920, 1080, 60, 8, {2, 11, 2, 0}, 0, 90, 2, 512, 16},
     "",
     NULL,
     {0},
     0,
     10},
    {{0.25, 400, {"unorm24"}, {"gl"}, .implied = true, .model = DP_MODEL_FLOAT, .arith = "mesa", .unit = "ft"},
     {800, 600, 35, 5, {2, 11, 2, 0}, 20, 70, 1.5, 90, 4},
     "--viewport 800x600 --fov 35 --subpixel 5 --slant 20:70 --triangle depth=1.5,pixels=90,slim=4",
     NULL,
     {0.5, 30, 390},
     3,
     0},
    {{0.1, 1e6, {"unorm16"}, {"d3d"}, .implied = true, .model = DP_MODEL_FLOAT},
     {1920, 1080, 60, 8, {2, 11, 2, 0}, 0, 90, 2, 512, 16},
     "",
     NULL,
     {1, 1e5},
     2,
     0},
};

/* The vertex grid edge-on, by depthprec(7). */
static double grid_by_hand(const dp_triangles *t) {
    return 2 * sqrt(2) * (2 * tan(t->fov_y * pi / 360) / t->height) * pow(2, -(t->subpixel + 1));
}

static void want_row(values *v, const disocclusion_case *c, const dp_setup *setup, double z, size_t i, size_t j,
                     line_places *lines) {
    dp_spec spec = setup->spec;
    dp_setup slanted;
    spec.triangles = c->triangles;
    assert_int_equal(dp_setup_init(&slanted, &spec), DP_OK);
    const double separation = dp_separation(&slanted, z);
    values_under(v, "setups[%zu].rows[%zu].", i, j);
    want_number(v, "z", z);
    want_number(v, "separation", separation);
    want_number(v, "share", separation / z);
    for (size_t k = 0; k < DISOCCLUSION_ROWS; k++) {
        const disocclusion_view view = {c->triangles.width, c->triangles.height, c->triangles.fov_y};
        const double share = disocclusion_get(k)->share(&view);
        char inner[48];
        values_under(v, "setups[%zu].rows[%zu].constants[%zu].", i, j, k);
        want_derived(v, "z", z); /* a line of CSV has them too */
        want_derived(v, "separation", separation);
        want_derived(v, "share", separation / z);
        want_text(v, "constant", disocclusion_get(k)->name);
        want_number(v, "shipped_share", share);
        want_number(v, "shipped", share * z);
        want_number(v, "times", isinf(separation) ? NAN : share / (separation / z));
        snprintf(inner, sizeof inner, "rows[%zu].constants[%zu].", j, k);
        place_add(lines, inner, "setups[%zu].", i);
    }
}

static void want_triangles(values *v, const dp_triangles *t, const char *arith) {
    values_under(v, "triangles.");
    want_number(v, "width", t->width);
    want_number(v, "height", t->height);
    want_number(v, "fov", t->fov_y);
    want_text(v, "raster", NULL);
    want_text(v, "arith", arith);
    want_number(v, "subpixel", t->subpixel);
    want_number(v, "slant_lo", t->slant_lo);
    want_number(v, "slant_hi", t->slant_hi);
    want_number(v, "depth", t->depth);
    want_number(v, "pixels", t->pixels);
    want_number(v, "slim", t->slim);
    values_under(v, "%s", "");
    want_number(v, "grid_share", grid_by_hand(t));
}

/* A line of text a set-up, below the depth. */
static void check_page(values *v, const disocclusion_case *c, const dp_setup *setups, size_t n, const char *text) {
    const size_t depths = c->count > 0 ? c->count : 1;
    const char *at = text;
    for (size_t j = 0; j < depths; j++) {
        at = strstr(at, "\nz = ");
        assert_non_null(at);
        at++;
        for (size_t i = 0; i < n; i++) {
            char label[64], path[4][96];
            snprintf(label, sizeof label, "%s %s ", setups[i].spec.format.name,
                     dp_mapping_get(setups[i].spec.mapping)->name);
            snprintf(path[0], sizeof path[0], "setups[%zu].rows[%zu].separation", i, j);
            snprintf(path[1], sizeof path[1], "setups[%zu].rows[%zu].share", i, j);
            snprintf(path[2], sizeof path[2], "setups[%zu].rows[%zu].constants[0].times", i, j);
            snprintf(path[3], sizeof path[3], "setups[%zu].rows[%zu].constants[1].times", i, j);
            const bool none = isinf(value_at(v, path[0])->number);
            if (none)
                assert_non_null(strstr(at, "inf"));
            else
                check_text_numbers(v, at, label, 3, (const char *const[]){path[0], path[1], path[2], path[3], NULL});
        }
    }
}

static void test_printed(void **state) {
    static const csv_column columns[] = {SETUP_COLUMNS,
                                         {"arith", "^arith"},
                                         {"z [scene]", "z"},
                                         {"separation [scene]", "separation"},
                                         {"share", "share"},
                                         {"constant", "constant"},
                                         {"shipped_share", "shipped_share"},
                                         {"shipped [scene]", "shipped"},
                                         {"times", "times"}};
    (void)state;
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
        const disocclusion_case *c = &cases[k];
        values v = values_of("disocclusion");
        line_places lines = {0};
        dp_setup setups[CAMERA_SETUPS];
        char camera[512], arguments[1024];
        v.unit = c->camera.unit;
        size_t used = (size_t)snprintf(arguments, sizeof arguments, "disocclusion %s %s",
                                       camera_options(&c->camera, camera), c->options);
        for (size_t j = 0; j < c->count; j++)
            used += (size_t)snprintf(arguments + used, sizeof arguments - used, "%s%g", j == 0 ? " --at " : ",",
                                     c->depths[j]);
        const size_t n = camera_setups(&c->camera, setups);
        want_triangles(&v, &c->triangles, c->camera.arith != NULL ? c->camera.arith : "ieee");
        for (size_t i = 0; i < n; i++) {
            values_under(&v, "setups[%zu].", i);
            want_setup(&v, &setups[i]);
            for (size_t j = 0; j < (c->count > 0 ? c->count : 1); j++)
                want_row(&v, c, &setups[i], c->count > 0 ? c->depths[j] : c->middle, i, j, &lines);
        }
        check_json(&v, 0, arguments);
        check_csv(&v, 0, arguments, columns, sizeof columns / sizeof columns[0], &lines);
        printed p = print_of("%s", arguments);
        check_page(&v, c, setups, n, p.out);
        printed_free(&p);
        values_free(&v);
        places_free(&lines);
    }
}

/* At 1080p and 90 degrees what is shipped is some 2300 and 8000 times what the vertex grid takes, 5.75e-6 of z. */
static void test_known(void **state) {
    static const char *const numbers[] = {"grid", NULL};
    (void)state;
    printed p = print_of("disocclusion -n 0.1 -f inf -F fp32 -m reversed --hfov 90 --at 5");
    values v = values_of("disocclusion");
    double tangent, diagonal;
    want_number(&v, "grid", 5.754e-4); /* percent */
    check_text_numbers(&v, p.out, "the vertex grid alone takes", 3, numbers);
    const char *at = strstr(p.out, "tangent is");
    assert_non_null(at);
    assert_int_equal(sscanf(at, "tangent is %lf", &tangent), 1);
    assert_int_equal(sscanf(strstr(at, "diagonal"), "diagonal %lf", &diagonal), 1);
    assert_scene(tangent, 2300, 50);
    assert_scene(diagonal, 8000, 50);
    assert_relative(tangent, shipped_by_hand(0, 90, 1920, 1080) / 5.7536e-6, 1e-3);
    assert_relative(diagonal, shipped_by_hand(1, 90, 1920, 1080) / 5.7536e-6, 1e-3);
    printed_free(&p);
    values_free(&v);
    p = print_of("disocclusion -F fp32 -m reversed --raster llvmpipe --at 5"); /* its depths are not snapped */
    assert_null(strstr(p.out, "vertex grid"));
    printed_free(&p);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_shipped), cmocka_unit_test(test_printed),
                                       cmocka_unit_test(test_known), cmocka_unit_test(check_apart)};
    return run_tap(tests);
}
