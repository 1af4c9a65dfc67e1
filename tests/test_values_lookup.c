/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every value that table prints the other way round: the eye depths behind window depths and codes. */
#include <stdio.h>
#include <stdlib.h>

#include "printed.h"
#include "shader/decode.h"

enum { ASKED = 5 };

typedef struct lookup_case {
    camera_case camera;
    const char *option;
    double asked[ASKED];
} lookup_case;

static const lookup_case lookups[] = {
    {{0.3, 1000, {"unorm16", "fp16"}, {"d3d", "reversed"}, .rounding = DP_ROUND_ZERO},
     "depth",
     {0, 0.25, 0.5000077, 0.9987, 1}},
    {{0.1, INFINITY, {"unorm24", "fp32"}, {"reversed", "gl"}, .rounding = DP_ROUND_EVEN},
     "depth",
     {1e-9, 0.1, 0.7, 0.99999997, 1}},
    {{0.1, 1000, {"unorm24", "fp32"}, {"d3d"}, .model = DP_MODEL_STAGED}, "depth", {0.125, 0.9, 0.99, 0.9999, 1}},
    {{1, 200, {"unorm16", "fp32"}, {"log", "linear"}, .log_c = 3}, "depth", {0.001, 0.02, 0.3, 0.9, 1}},
    {{2, 60, {"unorm16"}, {"d3d"}, .ortho = 1}, "depth", {0, 0.1, 0.2, 0.5, 1}},
    {{0.7, 5000, {"unorm24"}, {"gl"}, .model = DP_MODEL_FLOAT}, "depth", {0, 0.1, 0.2, 0.5, 0.9}},
    {{0.3, 1000, {"unorm16", "unorm24", "fp32"}, {"d3d", "reversed"}, .ortho = 0}, "code", {0, 1, 2, 40000, 65535}},
    {{0.1, INFINITY, {"fp32"}, {"reversed"}, .ortho = 0}, "code", {0, 1, 12345678, 1000000000, 1065353216}},
    {{1, 200, {"unorm16"}, {"linear"}, .ortho = 0}, "code", {0, 300, 328, 9000, 65535}},
};

static const char *arguments_of(const lookup_case *c, char out[1024]) {
    char options[512];
    size_t used = (size_t)snprintf(out, 1024, "table %s --%s ", camera_options(&c->camera, options), c->option);
    for (int k = 0; k < ASKED; k++)
        used += (size_t)snprintf(out + used, 1024 - used, "%s%.17g", k > 0 ? "," : "", c->asked[k]);
    return out;
}

/* What is stored as the code of a cell begins and ends with it. */
static void check_cell(const dp_setup *setup, const dp_cell *cell) {
    const uint32_t code = cell->code;
    const double inside = isinf(cell->hi) ? 2 * cell->lo : 0.5 * (cell->lo + cell->hi);
    if (setup->spec.model != DP_MODEL_EXACT || cell->width == 0 || !(cell->width > 1e-12 * cell->lo))
        return;
    assert_int_equal(dp_code(setup, inside), code);
    if (cell->lo * (1 - 1e-13) > setup->spec.znear)
        assert_int_not_equal(dp_code(setup, cell->lo * (1 - 1e-13)), code);
    if (cell->hi * (1 + 1e-13) < setup->spec.zfar)
        assert_int_not_equal(dp_code(setup, cell->hi * (1 + 1e-13)), code);
}

static void want_row(values *v, const lookup_case *c, const dp_setup *setup, double asked) {
    const dp_format *format = &setup->spec.format;
    const bool by_code = c->option[0] == 'c';
    const uint32_t code = by_code ? (uint32_t)asked : dp_format_encode(format, setup->spec.rounding, asked);
    const dp_cell cell = dp_cell_of(setup, code);
    check_cell(setup, &cell);
    want_number(v, "depth", by_code ? dp_format_value(format, code) : asked);
    want_count(v, "code", code);
    want_number(v, "z", by_code ? dp_stored(setup, code) : decode_exact(setup, DECODE_EYE, asked));
    want_number(v, "z_stored", dp_stored(setup, code));
    want_number(v, "cell_lo", cell.lo);
    want_number(v, "cell_hi", cell.hi);
    want_number(v, "interval", cell.width);
}

static void test_lookup(void **state) {
    static const csv_column columns[] = {SETUP_COLUMNS,
                                         {"depth", "depth"},
                                         {"code", "code"},
                                         {"z [scene]", "z"},
                                         {"z_stored [scene]", "z_stored"},
                                         {"cell_lo [scene]", "cell_lo"},
                                         {"cell_hi [scene]", "cell_hi"},
                                         {"interval [scene]", "interval"}};
    static const text_column shown[] = {{"depth", 7},   {"code", 10},   {"z", 8},
                                        {"cell_lo", 9}, {"cell_hi", 9}, {"interval", 3}};
    (void)state;
    for (size_t i = 0; i < sizeof lookups / sizeof lookups[0]; i++) {
        const lookup_case *c = &lookups[i];
        values v = values_of("table");
        line_places lines = {0};
        dp_setup setups[CAMERA_SETUPS];
        char arguments[1024];
        const size_t n = camera_setups(&c->camera, setups);
        for (size_t k = 0; k < n; k++) {
            values_under(&v, "setups[%zu].", k);
            want_setup(&v, &setups[k]);
            for (int a = 0; a < ASKED; a++) {
                char inner[32];
                values_under(&v, "setups[%zu].rows[%d].", k, a);
                want_row(&v, c, &setups[k], c->asked[a]);
                snprintf(inner, sizeof inner, "rows[%d].", a);
                place_add(&lines, inner, "setups[%zu].", k);
            }
        }
        check_json(&v, 0, arguments_of(c, arguments));
        check_csv(&v, 0, arguments, columns, sizeof columns / sizeof columns[0], &lines);
        printed p = print_of("%s", arguments);
        assert_int_equal(p.status, 0);
        check_text_table(&v, p.out, shown, sizeof shown / sizeof shown[0], &lines);
        printed_free(&p);
        values_free(&v);
        places_free(&lines);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_lookup), cmocka_unit_test(check_apart)};
    return run_tap(tests);
}
