/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every value that prepass prints, against a comparison of the same vertices. */
#include <stdio.h>
#include <string.h>

#include "cli/bias_all.h"
#include "named.h"
#include "printed.h"
#include "raster/vertex_compare.h"

typedef struct against_case {
    camera_case camera;
    const char *program; /* null: once, and then not written */
    const char *against; /* as it is written */
    const char *others[VERTEX_OTHERS];
    const char *vertices; /* null: eye-log, and then not written */
    double lo, hi, world; /* 0: not written, and 100 */
    uint64_t sample, seed;
} against_case;

static const against_case cases[] = {
    {{0.1, 1000, {"fp32", "unorm24"}, {"d3d", "reversed"}, .implied = true, .model = DP_MODEL_FLOAT},
     NULL,
     "separate,fma",
     {"separate", "fma"},
     NULL,
     0.3,
     800,
     0,
     40000,
     5},
    {{0.1, 1000, {"unorm16"}, {"gl-reversed"}, .implied = true, .model = DP_MODEL_FLOAT, .arith = "mesa", .unit = "cm"},
     "fma-right",
     "ALL",
     {"once", "products", "separate", "right", "pairs", "fma", "fma-right", "fma-pairs", "separate-fma"},
     "box",
     1,
     500,
     300,
     30000,
     0},
    {{-5, 60, {"fp32"}, {"gl"}, .implied = true, .model = DP_MODEL_FLOAT, .ortho = 1},
     "pairs",
     "right",
     {"right"},
     "box",
     -5,
     60,
     20,
     7000,
     UINT64_C(8589934597)},
};

static const vertex_program *program_of(const char *name) {
    size_t i = 0;
    while (strcmp(vertex_program_get(i)->name, name) != 0)
        i++;
    return vertex_program_get(i);
}

static vertex_request request_of(const against_case *c, const dp_setup *setup) {
    vertex_request r = {.setup = setup,
                        .spread = c->vertices != NULL ? VERTEX_BOX : VERTEX_EYE_LOG,
                        .lo = c->lo,
                        .hi = c->hi,
                        .world = c->world > 0 ? c->world : 100,
                        .count = c->sample,
                        .seed = c->seed,
                        .base = program_of(c->program != NULL ? c->program : "once")};
    while (c->others[r.others] != NULL) {
        r.other[r.others] = program_of(c->others[r.others]);
        r.others++;
    }
    return r;
}

static double units_of(const dp_setup *setup, const bias_api *api, const vertex_difference *d) {
    const double units = fmax(bias_units(api, &setup->spec.format, d->widest.depth, d->widest.bias),
                              bias_units(api, &setup->spec.format, d->steepest.depth, d->steepest.bias));
    return isinf(units) ? NAN : setup->reversed ? units : -units;
}

static void want_difference(values *v, const dp_setup *setup, const char *name, const vertex_difference *d, size_t i,
                            size_t k) {
    values_under(v, "setups[%zu].programs[%zu].", i, k);
    want_text(v, "against", name);
    want_count(v, "vertices", d->vertices);
    want_count(v, "differ", d->differ);
    want_derived(v, "share", rint(1e6 * (double)d->differ / (double)d->vertices) / 1e4); /* as it is shown */
    want_count(v, "percentile_99", d->percentile);
    want_count(v, "most", d->most);
    want_number(v, "most_z", d->most_z);
    want_number(v, "bias", d->widest.bias);
    for (size_t n = 0; bias_api_get(n) != NULL; n++) {
        values_under(v, "setups[%zu].programs[%zu].bias_units[%zu].", i, k, n);
        want_text(v, "api", bias_api_get(n)->name);
        want_number(v, "units", units_of(setup, bias_api_get(n), d));
    }
}

static void want_comparison(values *v, const against_case *c, const dp_setup *setup, size_t i, line_places *lines) {
    vertex_difference found[VERTEX_OTHERS];
    const vertex_request r = request_of(c, setup);
    assert_true(vertex_compare(&r, found));
    for (size_t k = 0; k < r.others; k++) {
        char inner[32];
        snprintf(inner, sizeof inner, "programs[%zu].", k);
        place_add(lines, inner, "setups[%zu].", i);
        want_difference(v, setup, c->others[k], &found[k], i, k);
    }
    values_under(v, "setups[%zu].", i);
    want_setup(v, setup);
    want_text(v, "program", r.base->name);
    want_text(v, "distribution", vertex_spread_name(r.spread));
    want_number(v, "lo", r.lo);
    want_number(v, "hi", r.hi);
    want_number(v, "from_origin", r.world);
    want_count(v, "drawn", r.count);
    want_count(v, "seed", r.seed);
}

/* The first set-up's table, and the calls below it: those of the program that needs most. */
static void check_page(const values *v, const against_case *c, const dp_setup *setup, const char *text) {
    vertex_difference found[VERTEX_OTHERS];
    const vertex_request r = request_of(c, setup);
    char path[5][64], label[64], line[256];
    assert_true(vertex_compare(&r, found));
    for (size_t k = 0; k < r.others; k++) {
        static const char *const fields[] = {"share", "percentile_99", "most", "most_z", "bias"};
        const char *const paths[] = {path[0], path[1], path[2], path[3], path[4], NULL};
        for (int i = 0; i < 5; i++)
            snprintf(path[i], sizeof path[i], "setups[0].programs[%zu].%s", k, fields[i]);
        snprintf(label, sizeof label, "%s ", c->others[k]);
        check_text_numbers(v, text, label, 6, paths);
    }
    for (size_t n = 0; bias_api_get(n) != NULL; n++) {
        const bias_api *api = bias_api_get(n);
        double most = 0;
        for (size_t k = 0; k < r.others; k++)
            if (!(fabs(units_of(setup, api, &found[k])) <= fabs(most)))
                most = units_of(setup, api, &found[k]);
        snprintf(line, sizeof line, "  %-14s%s\n", api->name,
                 isnan(most) ? "no bias is enough" : bias_call(api, most, 0).text);
        if (strstr(text, line) == NULL)
            fail_msg("no line '%s' in %s", line, text);
    }
    assert_non_null(strstr(text, setup->reversed ? "GEQUAL is safe" : "LEQUAL is safe"));
}

static void test_against(void **state) {
    static const csv_column columns[] = {SETUP_COLUMNS,
                                         {"arith", "^arith"},
                                         {"program", "^program"},
                                         {"distribution", "^distribution"},
                                         {"lo [scene]", "^lo"},
                                         {"hi [scene]", "^hi"},
                                         {"from_origin [scene]", "^from_origin"},
                                         {"drawn", "^drawn"},
                                         {"seed", "^seed"},
                                         {"against", "against"},
                                         {"vertices", "vertices"},
                                         {"differ", "differ"},
                                         {"percentile_99", "percentile_99"},
                                         {"most", "most"},
                                         {"most_z [scene]", "most_z"},
                                         {"bias", "bias"}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const against_case *c = &cases[i];
        values v = values_of("prepass");
        v.unit = c->camera.unit;
        line_places lines = {0};
        dp_setup setups[CAMERA_SETUPS];
        char camera[512], arguments[1024];
        size_t used = (size_t)snprintf(arguments, sizeof arguments,
                                       "prepass %s -q --range %.17g:%.17g --against %s --sample %llu --seed %llu",
                                       camera_options(&c->camera, camera), c->lo, c->hi, c->against,
                                       (unsigned long long)c->sample, (unsigned long long)c->seed);
        if (c->program != NULL)
            used += (size_t)snprintf(arguments + used, sizeof arguments - used, " --program %s", c->program);
        if (c->vertices != NULL)
            used += (size_t)snprintf(arguments + used, sizeof arguments - used, " --vertices %s", c->vertices);
        if (c->world > 0)
            snprintf(arguments + used, sizeof arguments - used, " --from-origin %g", c->world);
        const size_t n = camera_setups(&c->camera, setups);
        for (size_t k = 0; k < n; k++)
            want_comparison(&v, c, &setups[k], k, &lines);
        check_json(&v, 0, arguments);
        check_csv(&v, 0, arguments, columns, sizeof columns / sizeof columns[0], &lines);
        printed p = print_of("%s", arguments);
        check_page(&v, c, setups, p.out);
        printed_free(&p);
        values_free(&v);
        places_free(&lines);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_against), cmocka_unit_test(check_apart)};
    return run_tap(tests);
}
