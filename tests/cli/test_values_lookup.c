/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every value that table prints the other way round: the eye depths behind window depths and codes. */
#include "printed.h"
#include "shader/decode.h"

enum { ASKED = 5 };

static const char *const lines[] = {
    "table -n 0.3 -f 1000 -F unorm16,fp16 -m d3d,reversed --rounding zero --depth 0,0.25,0.5000077,0.9987,1",
    "table -n 0.1 -f inf -F unorm24,fp32 -m reversed,gl --rounding even --depth 1e-9,0.1,0.7,0.99999997,1",
    "table -n 0.1 -f 1000 -F unorm24,fp32 -m d3d --model staged --depth 0.125,0.9,0.99,0.9999,1",
    "table -n 1 -f 200 -F unorm16,fp32 -m log,linear --log-c 3 --depth 0.001,0.02,0.3,0.9,1",
    "table -n 2 -f 60 -F unorm16 -m d3d --ortho --depth 0,0.1,0.2,0.5,1",
    "table -n 0.7 -f 5000 -F unorm24 -m gl --model float --depth 0,0.1,0.2,0.5,0.9",
    "table -n 0.3 -f 1000 -F unorm16,unorm24,fp32 -m d3d,reversed --code 0,1,2,40000,65535",
    "table -n 0.1 -f inf -F fp32 -m reversed --code 0,1,12345678,1000000000,1065353216",
    "table -n 1 -f 200 -F unorm16 -m linear --code 0,300,328,9000,65535",
    "table -n 1 -f 200 -F unorm16 -m linear --code 400,500,600,9000,65535",
};

/* Depths that are stored as the code of a cell begin and end with it. */
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

static void want_row(values *v, const dp_setup *setup, bool by_code, double asked) {
    const dp_format *format = &setup->spec.format;
    const uint32_t code = by_code ? (uint32_t)asked : dp_format_encode(format, setup->spec.rounding, asked);
    const dp_cell cell = dp_cell_of(setup, code);
    check_cell(setup, &cell);
    want(v, "depth=%f code=%u", by_code ? dp_format_value(format, code) : asked, code);
    want(v, "z=%f", by_code ? dp_stored(setup, code) : decode_exact(setup, DECODE_EYE, asked));
    want(v, "z_stored=%f cell_lo=%f cell_hi=%f", dp_stored(setup, code), cell.lo, cell.hi);
    want(v, "interval=%f", cell.width);
}

/* That an interval is 0 is said of whichever row has one. */
static void check_note(const char *text, const dp_setup *setup, const double asked[ASKED], bool by_code) {
    bool empty = false;
    for (int a = 0; a < ASKED; a++) {
        const uint32_t code =
            by_code ? (uint32_t)asked[a] : dp_format_encode(&setup->spec.format, setup->spec.rounding, asked[a]);
        empty = empty || dp_cell_of(setup, code).width == 0;
    }
    assert_int_equal(strstr(text, "an interval of 0:") != NULL, empty);
}

TEST(each_number) {
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++) {
        values v = values_of(lines[i]);
        dp_setup setups[SETUPS_MAX];
        double asked[ASKED];
        const size_t n = setups_of(lines[i], DP_MODEL_EXACT, setups);
        const bool by_code = numbers_behind(lines[i], "--code", asked, ASKED) == ASKED;
        assert_true(by_code || numbers_behind(lines[i], "--depth", asked, ASKED) == ASKED);
        for (size_t k = 0; k < n; k++) {
            values_under(&v, "setups[%zu].", k);
            want_setup(&v, &setups[k]);
            for (int a = 0; a < ASKED; a++) {
                values_under(&v, "setups[%zu].rows[%d].", k, a);
                want_row(&v, &setups[k], by_code, asked[a]);
            }
        }
        check_forms(&v, 0, lines[i], "setups[].rows[]",
                    SETUP_CSV "depth, code, z [scene], z_stored [scene], cell_lo [scene], cell_hi [scene], "
                              "interval [scene]");
        char *text = output_of(0, lines[i], "");
        check_table(&v, text, "setups[].rows[]", "depth:7, code:10, z:8, cell_lo:9, cell_hi:9, interval:3");
        if (n == 1)
            check_note(text, &setups[0], asked, by_code);
        values_free(&v);
        free(text);
    }
}

/* 525 pixels times 0.075 m is 39.375 m a pixel of disparity: 1/z in steps of 1/39.375. */
TEST(levels_of_stereo) {
    check_says_all(0, "table --lattice stereo:525,0.075 --at 4m",
                   SAID("1/z in steps of 0.0253968;", "over a step 39.375 m"));
    check_says(0, "over a step 78.75 m", "table --lattice stereo:525,0.075,0.5 --at 4m");
}

LIST_TEST(check_apart)
