/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every value that prepass prints, against a comparison of the same vertices. */
#include "bias/cmd_bias/call.h"
#include "named.h"
#include "printed.h"
#include "raster/vertex_compare.h"

static const char *const lines[] = {
    "prepass -n 0.1 -f 1000 -F fp32,unorm24 -m d3d,reversed -q --range 0.3:800 --against separate,fma "
    "--sample 40000 --seed 5",
    "prepass -n 0.1 -f 1000 -F unorm16 -m gl-reversed --arith mesa --unit cm -q --range 1:500 --against ALL "
    "--sample 30000 --seed 0 --program fma-right --vertices box --from-origin 300",
    "prepass -n -5 -f 60 -F fp32 -m gl --ortho -q --range -5:60 --against right --sample 7000 --seed 8589934597 "
    "--program pairs --vertices box --from-origin 20",
};

/* "ALL" are all of them, in their order. */
static vertex_request request_of(const char *line, const dp_setup *setup) {
    static const char all[] = "once,products,separate,right,pairs,fma,fma-right,fma-pairs,separate-fma";
    const char *program = word_behind(line, "--program"), *against = word_behind(line, "--against");
    double range[2];
    char names[128];
    numbers_behind(line, "--range", range, 2);
    vertex_request r = {.setup = setup,
                        .spread = is_given(line, "--vertices") ? VERTEX_BOX : VERTEX_EYE_LOG,
                        .lo = range[0],
                        .hi = range[1],
                        .world = number_behind(line, "--from-origin", 100),
                        .count = (uint64_t)number_behind(line, "--sample", 0),
                        .seed = (uint64_t)number_behind(line, "--seed", 0),
                        .base = vertex_program_find(program != NULL ? program : "once")};
    snprintf(names, sizeof names, "%s", strcmp(against, "ALL") == 0 ? all : against);
    for (char *name = strtok(names, ","); name != NULL; name = strtok(NULL, ","))
        r.other[r.others++] = vertex_program_find(name);
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
    want(v, "against=%s vertices=%lu differ=%lu", name, d->vertices, d->differ);
    want(v, "~share=%f", rint(1e6 * (double)d->differ / (double)d->vertices) / 1e4); /* as it is shown */
    want_count(v, "percentile_99", d->percentile);
    want_count(v, "most", d->most);
    want(v, "most_z=%f bias=%f", d->most_z, d->widest.bias);
    for (size_t n = 0; bias_api_get(n) != NULL; n++) {
        values_under(v, "setups[%zu].programs[%zu].bias_units[%zu].", i, k, n);
        want(v, "api=%s units=%f", bias_api_get(n)->name, units_of(setup, bias_api_get(n), d));
    }
}

static void want_comparison(values *v, const char *line, const dp_setup *setup, size_t i) {
    vertex_difference found[VERTEX_OTHERS];
    const vertex_request r = request_of(line, setup);
    assert_true(vertex_compare(&r, found));
    for (size_t k = 0; k < r.others; k++)
        want_difference(v, setup, r.other[k]->name, &found[k], i, k);
    values_under(v, "setups[%zu].", i);
    want_setup(v, setup);
    want(v, "program=%s distribution=%s lo=%f hi=%f", r.base->name, vertex_spread_name(r.spread), r.lo, r.hi);
    want(v, "from_origin=%f drawn=%lu seed=%lu", r.world, r.count, r.seed);
}

/* The first set-up's table, and the calls below it: those of the program that needs most. */
static void check_page(values *v, const char *line, const dp_setup *setup) {
    vertex_difference found[VERTEX_OTHERS];
    const vertex_request r = request_of(line, setup);
    char label[64], call[256];
    char *text = output_of(0, line, "");
    assert_true(vertex_compare(&r, found));
    for (size_t k = 0; k < r.others; k++) {
        values_under(v, "setups[0].programs[%zu].", k);
        snprintf(label, sizeof label, "%s ", r.other[k]->name);
        check_line(v, text, label, "share:6, percentile_99:6, most:6, most_z:6, bias:6");
    }
    for (size_t n = 0; bias_api_get(n) != NULL; n++) {
        const bias_api *api = bias_api_get(n);
        double most = 0;
        for (size_t k = 0; k < r.others; k++)
            if (!(fabs(units_of(setup, api, &found[k])) <= fabs(most)))
                most = units_of(setup, api, &found[k]);
        snprintf(call, sizeof call, "  %-14s%s\n", api->name,
                 isnan(most) ? "no bias suffices" : bias_call(api, most, 0).text);
        if (strstr(text, call) == NULL)
            fail_msg("no line '%s' in %s", call, text);
    }
    const char *safe = strstr(text, setup->reversed ? "GEQUAL is safe" : "LEQUAL is safe");
    const char *codes = safe != NULL ? strstr(safe, "depth,") : NULL, *by = safe != NULL ? strstr(safe, " by ") : NULL;
    double bias = 0, shown = 0;
    unsigned most = 0, told = 0;
    for (size_t k = 0; k < r.others; k++) {
        most = found[k].most > most ? found[k].most : most;
        bias = fmax(bias, found[k].widest.bias);
    }
    assert_true(codes != NULL && sscanf(codes, "depth, %u code", &told) == 1 && told == most);
    assert_true(by != NULL && sscanf(by, " by %lf", &shown) == 1 && shown >= bias && shown <= 1.01 * bias);
    free(text);
}

TEST(each_number) {
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++) {
        values v = values_of(lines[i]);
        dp_setup setups[SETUPS_MAX];
        const size_t n = setups_of(lines[i], DP_MODEL_FLOAT, setups);
        for (size_t k = 0; k < n; k++)
            want_comparison(&v, lines[i], &setups[k], k);
        check_forms(&v, 0, lines[i], "setups[].programs[]",
                    SETUP_CSV "arith = ^arith, program = ^program, distribution = ^distribution, lo [scene] = ^lo, "
                              "hi [scene] = ^hi, from_origin [scene] = ^from_origin, drawn = ^drawn, seed = ^seed, "
                              "against, vertices, differ, percentile_99, most, most_z [scene], bias");
        check_page(&v, lines[i], setups);
        values_free(&v);
    }
}

LIST_TEST(check_apart)
