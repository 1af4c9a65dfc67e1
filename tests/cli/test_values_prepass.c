/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every value that prepass prints, against a comparison of the same vertices, or of what is stored. */
#include "bias/cmd_bias/call.h"
#include "convert/again.h"
#include "named.h"
#include "printed.h"
#include "raster/resolve.h"
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

/* The answer above the table is that of the numbers below it. */
TEST(verdicts) {
    static const char none[] = "\nNone of the random vertices lies within the range.",
                      safe[] = "\nEQUAL is safe on these";
    static const char unsafe[] = "\nEQUAL is not safe";
    static const struct {
        const char *line, *says;
    } rows[] = {
        {"prepass --against fma -F fp32 -m d3d --vertices box --from-origin 1 --range 10:20 --sample 1000", none},
        {"prepass --against once -F unorm16 -m d3d --sample 1000 --range 1:1.001", safe},
        {"prepass --against once,fma -F fp32 -m reversed --sample 1000 --from-origin 1000", unsafe},
        {"prepass --against fma,once -F fp32 -m reversed --sample 1000 --from-origin 1000", unsafe}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        json_t *root = json_printed(0, "%s", rows[i].line);
        char *text = output_of(0, rows[i].line, "");
        double vertices = 0, differ = 0;
        for (size_t k = 0; k < json_array_size(node_at(root, "setups[0].programs")); k++) {
            vertices = fmax(vertices, number_at(root, "setups[0].programs[%zu].vertices", k));
            differ += number_at(root, "setups[0].programs[%zu].differ", k);
        }
        assert_ptr_equal(rows[i].says, vertices == 0 ? none : differ == 0 ? safe : unsafe);
        static const char *const all[] = {none, safe, unsafe};
        for (size_t k = 0; k < 3; k++)
            assert_int_equal(strstr(text, all[k]) != NULL, all[k] == rows[i].says);
        assert_int_equal(strstr(text, "is safe on these vertices if the main pass is moved") != NULL, differ > 0);
        free(text);
        json_decref(root);
    }
}

/* ---- What else is stored ----------------------------------------------------------------------------------------- */

/* A line, and the cases that it names. */
static const struct {
    const char *line;
    const char *cases[6];
    int samples; /* 0: half the size, or formats */
} stored[] = {
    {"prepass -n 0.1 -f 1000 -F fp32,unorm16 -m d3d,reversed -q --range 0.3:800 --prepass-format unorm16,fp16,fp32",
     {"unorm16", "fp16", "fp32"},
     0},
    {"prepass -n 1 -f 50 -F unorm16 -m gl --rounding zero -q --range 1:50 --unit cm --prepass-format unorm10,d16",
     {"unorm10", "unorm16"},
     0},
    {"prepass -n 0.1 -f 1000 -F fp32,unorm24,fp16 -m d3d,reversed -q --range 0.1:1000 --resolve all:8",
     {"min:8", "max:8", "average:8", "sample0:8"},
     8},
    {"prepass -n -5 -f 60 -F unorm16 -m gl-reversed --ortho -q --range -5:60 --half one,CENTRE,min,point",
     {"one", "centre", "min"},
     0},
};

typedef struct stored_need {
    again_found found;
    double pixels;
    bool counted;
} stored_need;

static stored_need need_of(const dp_setup *setup, const char *name, int samples, const double range[2]) {
    const double a = dp_window(setup, range[0]), b = dp_window(setup, range[1]), lo = fmin(a, b), hi = fmax(a, b);
    char way[32];
    dp_format f[2];
    snprintf(way, sizeof way, "%.*s", (int)strcspn(name, ":"), name);
    const resolve_way *of = samples > 0 ? resolve_sampled_find(way) : resolve_halved_find(way);
    if (of == NULL) {
        assert_true(dp_format_parse(name, f) == 1);
        again_request q = {.stored = f[0],
                           .drawn = setup->spec.format,
                           .rounding = setup->spec.rounding,
                           .lo = (float)lo,
                           .hi = (float)hi,
                           .reversed = setup->reversed};
        q.lo = (double)q.lo > lo ? nextafterf(q.lo, 0) : q.lo;
        q.hi = (double)q.hi < hi ? nextafterf(q.hi, 1) : q.hi;
        return (stored_need){again_all(&q), 0, true};
    }
    stored_need out = {.counted = false};
    for (int i = 0; i < 2; i++) {
        const double depth = fmax(i == 0 ? lo : hi, 0x1p-102);
        const resolve_need n =
            resolve_needs(of, samples, &setup->spec.format, setup->spec.rounding, setup->reversed, depth);
        again_take(&setup->spec.format, (again_gap){n.window, depth}, &out.found);
        out.pixels = n.pixels;
    }
    return out;
}

static double units_needed(const dp_setup *setup, const bias_api *api, const again_found *f) {
    const double units = fmax(bias_units(api, &setup->spec.format, f->widest.depth, f->widest.bias),
                              bias_units(api, &setup->spec.format, f->steepest.depth, f->steepest.bias));
    return isinf(units) ? NAN : setup->reversed ? units : -units;
}

static double counted(const stored_need *n, double x) {
    return n->counted ? x : NAN;
}

static void want_stored(values *v, const dp_setup *setup, const char *name, const stored_need *n, double hi, size_t i,
                        size_t k) {
    const again_found *f = &n->found;
    const bias_state state = {.api = bias_api_find("d3d9"), .units = f->widest.bias * (setup->reversed ? 1 : -1)};
    values_under(v, "setups[%zu].cases[%zu].", i, k);
    want(v, "stored=%s equal=%d passes=%d", name, n->counted && f->unequal == 0, f->widest.bias == 0 && n->pixels == 0);
    want(v, "codes=%f unequal=%f failing=%f most=%f", counted(n, (double)f->codes), counted(n, (double)f->unequal),
         counted(n, (double)f->fails), counted(n, f->most));
    want(v, "most_z=%f", n->counted && f->most > 0 ? dp_eye(setup, f->most_at, 1 - f->most_at) : NAN);
    want(v, "pixels=%f bias=%f moves=%f", n->pixels, f->widest.bias, fabs(bias_at(setup, &state, 0, hi).shift));
    for (size_t a = 0; bias_api_get(a) != NULL; a++) {
        const double units = units_needed(setup, bias_api_get(a), f);
        values_under(v, "setups[%zu].cases[%zu].bias_units[%zu].", i, k, a);
        want(v, "api=%s units=%f factor=%f", bias_api_get(a)->name, units,
             isnan(units)      ? NAN
             : setup->reversed ? n->pixels
                               : -n->pixels);
    }
}

/* The calls below the first table suffice for each of its lines. */
static void check_calls(const char *text, const dp_setup *setup, const stored_need *needs, size_t count) {
    for (size_t a = 0; bias_api_get(a) != NULL; a++) {
        double units = 0, factor = 0;
        char call[256];
        for (size_t k = 0; k < count; k++) {
            const double one = units_needed(setup, bias_api_get(a), &needs[k].found);
            units = !(fabs(one) <= fabs(units)) ? one : units;
            factor = fmax(factor, needs[k].pixels);
        }
        factor *= setup->reversed ? 1 : -1;
        snprintf(call, sizeof call, "  %-14s%s", bias_api_get(a)->name,
                 isnan(units) ? "no bias suffices" : bias_call(bias_api_get(a), units, factor + 0.0).text);
        call[strcspn(call, ",")] = '\0'; /* the line may break behind that */
        if (strstr(text, call) == NULL)
            fail_msg("no line '%s' in %s", call, text);
    }
}

TEST(each_number_of_what_is_stored) {
    for (size_t i = 0; i < sizeof stored / sizeof stored[0]; i++) {
        const char *line = stored[i].line;
        values v = values_of(line);
        dp_setup setups[SETUPS_MAX];
        const size_t n = setups_of(line, DP_MODEL_FLOAT, setups);
        double range[2];
        numbers_behind(line, "--range", range, 2);
        stored_need needs[SETUPS_MAX][6];
        size_t cases = 0;
        for (size_t s = 0; s < n; s++) {
            for (cases = 0; cases < 6 && stored[i].cases[cases] != NULL; cases++) {
                needs[s][cases] = need_of(&setups[s], stored[i].cases[cases], stored[i].samples, range);
                want_stored(&v, &setups[s], stored[i].cases[cases], &needs[s][cases], range[1], s, cases);
            }
            values_under(&v, "setups[%zu].", s);
            want_setup(&v, &setups[s]);
            want(&v, "lo=%f hi=%f test=%s", range[0], range[1], setups[s].reversed ? "GEQUAL" : "LEQUAL");
        }
        check_forms(&v, 0, line, "setups[].cases[]",
                    SETUP_CSV
                    "lo [scene] = ^lo, hi [scene] = ^hi, test = ^test, stored, equal, passes, codes, unequal, "
                    "failing, most, most_z [scene], pixels, bias, moves [scene]");
        char *text = output_of(0, line, "");
        for (size_t k = 0; k < cases; k++) {
            char label[64]; /* with the verdicts */
            values_under(&v, "setups[0].cases[%zu].", k);
            const stored_need *need = &needs[0][k];
            snprintf(label, sizeof label, "%-14s%7s%7s ", stored[i].cases[k],
                     need->counted && need->found.unequal == 0 ? "holds" : "fails",
                     need->found.widest.bias == 0 && need->pixels == 0 ? "holds" : "fails");
            check_line(&v, text, label, "failing:6, most:6, pixels:6, bias:6, moves:6");
        }
        check_calls(text, &setups[0], needs[0], cases);
        free(text);
        values_free(&v);
    }
}

LIST_TEST(check_apart)
