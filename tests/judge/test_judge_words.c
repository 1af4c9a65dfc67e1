/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The numbers that a word gives a shader: by its name, or as engines document it (CesiumJS, UniformState.js; Unity;
 * PlayCanvas; Unreal). No driver is needed. */
#include "judge/written.h"
#include "printed.h"
#include "support.h"

/* The numbers that each word gives a shader, by its name or as engines document it: CesiumJS, UniformState.js; Unity;
 * PlayCanvas. */
TEST(test_words) {
    const double n = 0.75, f = 20;
    const struct {
        const char *word;
        int count;
        double value[4];
    } words[] = {{"near", 1, {n}},
                 {"far", 1, {f}},
                 {"near_far", 2, {n, f}},
                 {"projection_params", 4, {1, n, f, 1 / f}},
                 {"camera_params", 4, {1 / f, f, n, 0}},
                 {"log2_far_from_near", 1, {log2(f - n + 1)}},
                 {"far_from_near", 1, {f - n + 1}},
                 {"one_over_log2_far_from_near", 1, {1 / log2(f - n + 1)}},
                 {"viewport", 4, {0, 0, 1, 1}},
                 {"inv_device_z", 4, {0, 0, 1 / f - 1 / n, -1 / n}}};
    static const char *const types[] = {"float", "vec2", "vec3", "vec4"};
    dp_spec spec = dp_spec_default();
    dp_setup setup;
    spec.znear = n;
    spec.zfar = f;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        char file[256], define[64], error[WRITTEN_TEXT_SIZE] = "";
        const char *const defines[] = {define};
        const int count = words[i].count;
        static written w;
        snprintf(file, sizeof file, "uniform %s given;\nfloat f(float d) { return d*given%s; }\n", types[count - 1],
                 count > 1 ? ".x" : "");
        snprintf(define, sizeof define, "given=%s", words[i].word);
        w = (written){.text = NULL};
        if (!written_make(file, "f", false, &setup, defines, 1, 0, &w, error))
            fail_msg("%s: %s", words[i].word, error);
        assert_int_equal(w.used, count);
        for (int k = 0; k < count; k++)
            assert_ulp((double)w.constants[k], (double)(float)words[i].value[k], 0x1p29); /* of binary32 */
        free(w.text);
    }
}

/* The depths to be judged at are numbers of binary32, the same ones in every form. */
TEST(test_depths_to_judge) {
    json_t *root = json_printed(0, "judge --pairs-for 500 --json");
    printed p = print_of("judge --pairs-for 500");
    const json_t *depths = node_at(root, "depths");
    const char *at = strchr(p.out, '\n');
    for (size_t i = 0; i < json_array_size(depths); i++) {
        const double exact = number_at(depths, "[%zu].depth", i);
        assert_true((double)(float)exact == exact && (double)strtof(at + 1, NULL) == exact);
        at = strchr(at + 1, '\n');
    }
    assert_true(json_array_size(depths) == 500 && at[1] == '\0');
    json_decref(root);
    printed_free(&p);
}
