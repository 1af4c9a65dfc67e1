/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The rows of quantities: each at a depth against fractions, over a range against the depths in it, and the same number
 * under the same name through every door that shows it.
 */
#include "oracle.h"
#include "printed.h"
#include "quantity/quantity.h"

/* ---- Against fractions ------------------------------------------------------------------------------------------- */

static bool random_setup(rng *r, dp_model model, dp_setup *setup) {
    static const char *const formats[] = {"fp32", "unorm24", "unorm16", "fp16", "float3.3b5", "unorm5"};
    dp_spec spec = dp_spec_default();
    dp_format found[2];
    dp_format_parse(formats[rng_below(r, 6)], found);
    spec.format = found[0];
    spec.znear = rng_log(r, 1e-2, 1e2);
    spec.zfar = spec.znear * (1.0 + rng_log(r, 1e-2, 1e6));
    spec.mapping = (dp_mapping)rng_below(r, DP_MAPPING_COUNT);
    spec.ortho = rng_below(r, 6) == 0;
    spec.rounding = (dp_rounding)rng_below(r, DP_ROUNDING_COUNT);
    spec.model = model;
    spec.arith = (dp_arith)rng_below(r, dp_arith_count());
    return quantity_setup(&spec, setup) == DP_OK;
}

static double depth_within(rng *r, double lo, double hi) {
    return fmin(fmax(rng_log(r, lo, hi), lo), hi);
}

static void check_lattice(const dp_setup *s, double z, tally *t) {
    char text[512];
    oracle o;
    oracle_cell cell;
    mpq_t exact, least, most;
    int most_infinite;
    mpq_inits(exact, least, most, NULL);
    oracle_init(&o, &s->spec);
    oracle_cell_init(&cell);
    oracle_cell_of(&o, &cell, oracle_code(&o, z));
    const double whole = oracle_double(cell.whole);
    if (!cell.lo_infinite && !cell.hi_infinite) {
        mpq_sub(exact, cell.hi, cell.lo);
        const double width = quantity_get(QUANTITY_INTERVAL)->at(s, z);
        TALLY(t, oracle_distance(width, exact) <= 1e-9 * whole, "interval %.17g at %.17g: %s", width, z,
              oracle_describe(&s->spec, text, sizeof text));
    }
    if (!cell.stored_infinite) {
        mpq_set_d(exact, z);
        mpq_sub(exact, cell.stored, exact);
        mpq_abs(exact, exact);
        const double error = quantity_get(QUANTITY_ERROR)->at(s, z);
        TALLY(t, oracle_distance(error, exact) <= 1e-9 * whole + 0x1p-50 * z, "error %.17g at %.17g: %s", error, z,
              oracle_describe(&s->spec, text, sizeof text));
    }
    if (oracle_separation(&o, z, least, most, &most_infinite) == ORACLE_SEPARATION_ONE) {
        const double separation = quantity_get(QUANTITY_SEPARATION)->at(s, z);
        TALLY(t, oracle_relative(separation, least) <= 1e-9, "separation %.17g at %.17g: %s", separation, z,
              oracle_describe(&s->spec, text, sizeof text));
    }
    oracle_cell_clear(&cell);
    oracle_clear(&o);
    mpq_clears(exact, least, most, NULL);
}

TEST(each_at_a_depth_is_what_fractions_give) {
    rng r = rng_make("quantity lattice");
    tally t = {.name = "at a depth"};
    dp_setup s;
    for (uint64_t i = 0, n = test_cases(500, 5000, 20000); i < n; i++)
        if (random_setup(&r, DP_MODEL_EXACT, &s))
            check_lattice(&s, depth_within(&r, s.spec.znear, s.spec.zfar), &t);
    tally_end(&t);
}

/* ---- Over a range ------------------------------------------------------------------------------------------------ */

/* An error in float, of anything but a shader, is that of depths that a pipeline computes; there are no cells. */
static bool exists(quantity_kind q, const dp_setup *s) {
    return quantity_get(q)->over != NULL && (q != QUANTITY_INTERVAL || s->spec.model != DP_MODEL_FLOAT);
}

/* Whose worst depth and code are found. @return the greatest at a depth */
static double greatest_at(quantity_kind q, const dp_setup *s, double lo, double hi, const quantity_worst *w, rng *r) {
    double greatest = fmax(quantity_get(q)->at(s, lo), quantity_get(q)->at(s, hi));
    if (w->z >= lo && w->z <= hi)
        greatest = fmax(greatest, quantity_get(q)->at(s, w->z));
    for (int k = 0; k < 20; k++)
        greatest = fmax(greatest, quantity_get(q)->at(s, depth_within(r, lo, hi)));
    return greatest;
}

static void check_range(quantity_kind q, const dp_setup *s, rng *r, tally *t) {
    char text[512];
    const double lo = depth_within(r, s->spec.znear, s->spec.zfar);
    const double hi = depth_within(r, lo, s->spec.zfar);
    if (!(lo < hi))
        return;
    const quantity_row *row = quantity_get(q);
    const quantity_worst w = quantity_over(q, s, lo, hi, NAN), one = quantity_over(q, s, lo, lo, NAN);
    const double greatest = greatest_at(q, s, lo, hi, &w, r);
    TALLY(t, w.value >= greatest, "%s %.17g, at a depth %.17g, %.17g to %.17g: %s", row->name, w.value, greatest, lo,
          hi, oracle_describe(&s->spec, text, sizeof text));
    TALLY(t, w.value == quantity_bound(q, s, lo, hi) && !w.passed && one.value == row->at(s, lo) && one.z == lo,
          "%s: two answers", row->name);
    TALLY(t, isinf(w.value) || quantity_over(q, s, lo, hi, w.value * (1.0 + 0x1p-40)).passed,
          "%s %.17g fails its own bound: %s", row->name, w.value, oracle_describe(&s->spec, text, sizeof text));
    TALLY(t, isinf(greatest) || !quantity_over(q, s, lo, hi, greatest * (1.0 - 0x1p-20)).passed,
          "%s %.17g passes less: %s", row->name, greatest, oracle_describe(&s->spec, text, sizeof text));
    if (q == QUANTITY_ERROR && !s->shader && s->spec.model == DP_MODEL_EXACT && isfinite(w.value))
        TALLY(t, fabs(fabs(dp_error(s, w.code, w.z)) - w.value) <= 1e-9 * w.value + 0x1p-44 * hi,
              "%s is not that of the code %u at %.17g: %s", row->name, w.code, w.z,
              oracle_describe(&s->spec, text, sizeof text));
}

TEST(each_over_a_range_holds_at_every_depth) {
    rng r = rng_make("quantity range");
    tally t = {.name = "over a range"};
    dp_setup s;
    for (uint64_t i = 0, n = test_cases(200, 2000, 8000); i < n; i++)
        for (int m = 0; m < DP_MODEL_COUNT; m++)
            for (int q = 0; q < QUANTITY_COUNT && random_setup(&r, (dp_model)m, &s); q++)
                if (exists((quantity_kind)q, &s))
                    check_range((quantity_kind)q, &s, &r, &t);
    tally_end(&t);
}

TEST(outside_the_planes_there_is_none) {
    const dp_setup s = SETUP("unorm24", .znear = 1, .zfar = 100);
    assert_true(isnan(quantity_bound(QUANTITY_SEPARATION, &s, 0.5, 10)));
    assert_true(isnan(quantity_bound(QUANTITY_INTERVAL, &s, 1, 101)) &&
                isnan(quantity_get(QUANTITY_INTERVAL)->at(&s, 101)));
    assert_false(quantity_over(QUANTITY_SEPARATION, &s, 0.5, 10, 1e9).passed);
    assert_null(quantity_get(QUANTITY_COUNT));
}

/* ---- Through every door ------------------------------------------------------------------------------------------ */

typedef struct camera {
    const char *near, *far, *format, *mapping, *model;
    double z, lo, hi;
} camera;

static const camera cameras[] = {
    {"0.1", "1000", "unorm24", "d3d", "exact", 50, 10, 100},
    {"0.1", "1000", "fp32", "reversed", "staged", 321.5, 100, 900},
    {"0.25", "4000", "fp16", "gl-reversed", "exact", 7.75, 3, 30},
    {"1", "300", "unorm16", "log", "exact", 17, 2, 200},
};

/* Those that show a quantity of cells as a curve. */
static const char *const figures[QUANTITY_COUNT] = {
    [QUANTITY_ERROR] = "error", [QUANTITY_INTERVAL] = "interval", [QUANTITY_DENSITY] = "distribution"};

static const char *line_of(const camera *c) {
    static char line[160];
    snprintf(line, sizeof line, "-n %s -f %s -F %s -m %s --model %s", c->near, c->far, c->format, c->mapping, c->model);
    return line;
}

static void check_table_door(const camera *c, const dp_setup *s, quantity_kind q) {
    const quantity_row *row = quantity_get(q);
    const dp_setup full = dp_setup_guaranteed(s);
    char line[200], key[64];
    snprintf(line, sizeof line, "table %s --at %.17g --range %g:%g", line_of(c), c->z, c->lo, c->hi);
    snprintf(key, sizeof key, ",%s [scene]", row->name);
    json_t *root = json_printed(0, "%s", line);
    assert_true(fabs(number_at(root, "setups[0].rows[0].%s", row->name)) == row->at(s, c->z));
    if (q == QUANTITY_SEPARATION)
        assert_true(number_at(root, "setups[0].worst_separation.bound") == quantity_bound(q, &full, c->lo, c->hi));
    else
        assert_true(number_at(root, "setups[0].worst.%s", row->name) == quantity_bound(q, s, c->lo, c->hi));
    json_decref(root);
    char *csv = output_of(0, line, "--csv");
    assert_non_null(strstr(csv, key));
    free(csv);
}

static void check_lookup_door(const camera *c, const dp_setup *s) {
    const quantity_row *row = quantity_get(QUANTITY_INTERVAL);
    json_t *root = json_printed(0, "table %s --code %u", line_of(c), dp_code(s, c->z));
    assert_true(number_at(root, "setups[0].rows[0].%s", row->name) == row->at(s, c->z));
    json_decref(root);
}

/* Two digits, rounded up. */
static void check_compare_door(const camera *c, const dp_setup *s) {
    const dp_setup full = dp_setup_guaranteed(s);
    const double separation = quantity_get(QUANTITY_SEPARATION)->at(&full, c->z);
    char line[200], name[64];
    snprintf(line, sizeof line, "table -n %s -f %s -F %s,unorm8 -m %s --at %.17g", c->near, c->far, c->format,
             c->mapping, c->z);
    snprintf(name, sizeof name, "\n%s %s ", c->format, c->mapping);
    char *text = output_of(0, line, "");
    const char *found = strstr(text, name);
    assert_non_null(found);
    const double shown = strtod(found + strlen(name), NULL);
    assert_true(shown >= separation && shown < 1.11 * separation);
    free(text);
}

/* The quantities of a depth that requirements limit, there and over a range, and those that solve reaches. */
static void check_limited_doors(const camera *c, const dp_setup *s, quantity_kind q) {
    const quantity_row *row = quantity_get(q);
    const quantity_worst at = quantity_over(q, s, c->z, c->z, 1);
    const double limit = row->at(s, c->z); /* passes there, and not over the range */
    const quantity_worst over = quantity_over(q, s, c->lo, c->hi, limit);
    const char *file =
        scratch_text("one.need",
                     "cameras = { c = { near = %s; far = %s; mapping = \"%s\"; format = \"%s\"; model = "
                     "\"%s\"; }; };\nrequirements = { a = { camera = \"c\"; at = %.17g; %s = 1; };\n"
                     "b = { camera = \"c\"; range = [%g, %g]; %s = %.17g; }; };\n",
                     c->near, c->far, c->mapping, c->format, c->model, c->z, row->name, c->lo, c->hi, row->name, limit);
    json_t *root = json_printed(1, "check %s", file);
    for (int i = 0; i < 2; i++) {
        const quantity_worst *w = i == 0 ? &at : &over;
        assert_string_equal(text_at(root, "requirements[%d].kind", i), row->name);
        assert_true(number_at(root, "requirements[%d].value", i) == w->value);
        assert_true(number_at(root, "requirements[%d].z", i) == w->z);
        assert_true(flag_at(root, "requirements[%d].passed", i) == w->passed && w->passed == (i == 0));
    }
    json_decref(root);
    if (row->within == NULL)
        return;
    root = json_printed(0, "solve %s --at %.17g --%s 1 --for format", line_of(c), c->z, row->name);
    assert_string_equal(text_at(root, "measure"), row->name);
    assert_true(number_at(root, "answer.%s", row->name) == row->at(s, c->z));
    json_decref(root);
}

/* Each point stands for a slice: a curve is nowhere below what is so at the depth of its point. */
static void check_curve(const camera *c, const dp_setup *s, quantity_kind q, const char *figure) {
    const quantity_row *row = quantity_get(q), *interval = quantity_get(QUANTITY_INTERVAL);
    json_t *root = json_printed(0, "plot %s %s --range %g:%g", figure, line_of(c), c->lo, c->hi);
    assert_string_equal(text_at(root, "y.key"), row->name);
    assert_string_equal(text_at(root, "y.label"), row->axis);
    assert_string_equal(text_at(root, "y.unit"), row->unit);
    const size_t count = json_array_size(node_at(root, "panels[0].series[0].points"));
    assert_true(count > 1);
    for (size_t i = 0; i < count; i++) {
        const double z = number_at(root, "panels[0].series[0].points[%zu].z", i);
        const double y = number_at(root, "panels[0].series[0].points[%zu].%s", i, row->name);
        const double lo = fmax(z / 1.01, s->spec.znear), hi = fmin(z * 1.01, s->spec.zfar);
        if (q == QUANTITY_DENSITY)
            assert_true(y <= 1 / interval->at(s, z) && y >= 1 / quantity_bound(QUANTITY_INTERVAL, s, lo, hi));
        else
            assert_true(y >= row->at(s, z));
    }
    json_decref(root);
}

TEST(each_is_the_same_through_every_door) {
    dp_setup s[SETUPS_MAX];
    for (const camera *c = cameras; c < cameras + sizeof cameras / sizeof cameras[0]; c++) {
        assert_int_equal(setups_of(line_of(c), DP_MODEL_EXACT, s), 1);
        for (quantity_kind q = 0; q < QUANTITY_COUNT; q++) {
            if (quantity_get(q)->at != NULL)
                check_table_door(c, s, q);
            if (q < QUANTITY_LIMITED && quantity_get(q)->at != NULL)
                check_limited_doors(c, s, q);
            assert_true((figures[q] != NULL) == (quantity_get(q)->of_cells != NULL));
            if (figures[q] != NULL)
                check_curve(c, s, q, figures[q]);
        }
        check_lookup_door(c, s);
        check_compare_door(c, s);
    }
}
