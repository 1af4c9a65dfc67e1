/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The numbers that a word gives a shader: by its name, or as engines document it (CesiumJS, UniformState.js; Unity;
 * PlayCanvas; Unreal). No driver is needed. */
#include "judge/given.h"
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

/* Whatever fits is listed: what is named, the same function by another name, and what fits, too. */
TEST(test_all_that_fit) {
    char bytes[512] = "";
    for (int k = 0; k < 4; k++) { /* 252.2 and its like of 255 beside far, in bytes: from near the share is the same */
        const double share = fmin((252.2 + k) / 255, 1);
        const size_t used = strlen(bytes);
        snprintf(bytes + used, sizeof bytes - used, "%.17g,%.17g\n", (1 - 1 / (share * 10)) / (1 - 0.1),
                 (252 + k) / 255.0);
    }
    const struct {
        const char *pairs, *options, *said, *computes[3], *mapping[3];
    } rows[] = {{"0,0.1\n0.25,2.575\n0.5,5.05\n0.75,7.525\n1,10\n",
                 "-n 0.1 -f 10 -m d3d",
                 "the same  reciprocal of eye depth from window depth: reversed",
                 {"eye depth", "reciprocal of eye depth"},
                 {"d3d", "reversed"}},
                {bytes,
                 "-n 1 -f 10 -m d3d",
                 "fits, too the way from near to far",
                 {"eye depth over far", "the way from near to far"},
                 {"d3d", "d3d"}},
                {"0,0.5\n0.25,5.375\n0.5,10.25\n0.75,15.125\n1,20\n",
                 "-n 0.5 -f 20 -m gl --ortho",
                 "right: eye depth",
                 {"eye depth"},
                 {"gl"}}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const char *path = scratch_text("fits.csv", "%s", rows[i].pairs);
        check_says(0, rows[i].said, "judge --pairs %s %s", path, rows[i].options);
        json_t *root = json_printed(0, "judge --pairs %s %s --json", path, rows[i].options);
        size_t count = 0;
        for (; rows[i].computes[count] != NULL; count++) {
            assert_string_equal(text_at(root, "fits[%zu].computes", count), rows[i].computes[count]);
            assert_string_equal(text_at(root, "fits[%zu].mapping", count), rows[i].mapping[count]);
        }
        assert_int_equal(json_array_size(node_at(root, "fits")), count);
        json_decref(root);
    }
}

/* The language of a file is that of its name; what is wrong in it is said before a driver is asked. */
TEST(test_languages_by_name) {
    static const struct {
        const char *name, *said;
    } rows[] = {{"f.glsl", "undeclared identifier (--define"},
                {"f.frag", "undeclared identifier (--define"},
                {"hlsl", "undeclared identifier (--define"},
                {"f.hlsl", "unknown variable"},
                {"f.hlsli", "unknown variable"},
                {"f.fx", "unknown variable"},
                {"f.cginc", "unknown variable"},
                {"f.usf", "unknown variable"},
                {"f.ush", "unknown variable"}};
    if (system("command -v glslangValidator >/dev/null 2>&1") != 0)
        skip();
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        char said[64];
        snprintf(said, sizeof said, ":1: 'mystery' : %s", rows[i].said);
        check_says(2, said, "judge %s:f", scratch_text(rows[i].name, "float f(float d) { return d * mystery; }\n"));
    }
}

/* Ends of lines change nothing, within a directive that goes on, too: the shader that is made is the same but for them.
 */
TEST(test_ends_of_lines) {
    static const char file[] =
        "#version 330 core\n"
        "uniform float uNear, uFar; // of the camera\n"
        "#define SPAN \\\n    (uFar \\\n     - uNear)\n"
        "#if defined(OTHER) \\\n    && OTHER > 1\n#define NDC(d) (d)\n"
        "#else\n#define NDC(d) ((d) * \\\n                2.0 - 1.0)\n#endif\n"
        "/* float f(float d)\n   { return d; } */\n"
        "float f(float d) {\n    return 2.0 * uNear * uFar / (uFar + uNear - NDC(d) * SPAN);\n}\n"
        "void main() { gl_FragDepth = f(0.5); }\n";
    const dp_spec spec = dp_spec_default();
    dp_setup setup;
    char other[2 * sizeof file], error[WRITTEN_TEXT_SIZE] = "", *to = other;
    static written plain, ended;
    for (const char *c = file; *c != '\0'; *to++ = *c++)
        if (*c == '\n')
            *to++ = '\r';
    *to = '\0';
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    if (!written_make(file, "f", false, &setup, NULL, 0, 0, &plain, error) ||
        !written_make(other, "f", false, &setup, NULL, 0, 0, &ended, error))
        fail_msg("%s", error);
    to = ended.text;
    for (const char *c = ended.text; *c != '\0'; c++)
        if (*c != '\r')
            *to++ = *c;
    *to = '\0';
    assert_string_equal(ended.text, plain.text);
    assert_string_equal(ended.defines, plain.defines);
    assert_non_null(strstr(plain.text, "- uNear)"));
    assert_null(strstr(plain.text, "gl_FragDepth"));
    free(plain.text);
    free(ended.text);
}
/* The numbers of a word in a set-up. */
static const double *given_in(const char *word, const dp_setup *setup) {
    static double numbers[GIVEN_FLOATS];
    const given_row *row = given_find(word);
    assert_non_null(row);
    given_fill(row, setup, numbers);
    return numbers;
}

/* NDC depth, or z, as a matrix by rows makes it of (0, 0, x, 1). */
static double through(const double m[GIVEN_FLOATS], double x) {
    return (m[10] * x + m[11]) / (m[14] * x + m[15]);
}

/* Engines' formulas do with the numbers that shaders are given of a camera what they are for: a depth is read back, and
 * z and NDC depth are each made of the other. */
TEST(numbers_that_are_given) {
    rng r = rng_make("given");
    for (int i = 0; i < 2000; i++) {
        dp_setup s;
        dp_spec spec = dp_spec_default();
        spec.mapping = (dp_mapping)(i % 4);
        spec.ortho = rng_below(&r, 2) == 0;
        spec.znear = rng_log(&r, 1e-2, 10);
        spec.zfar = !spec.ortho && rng_below(&r, 4) == 0 ? (double)INFINITY : spec.znear * rng_log(&r, 2, 1e3);
        assert_int_equal(dp_setup_init(&s, &spec), DP_OK);
        const double n = spec.znear, f = spec.zfar, z = rng_log(&r, n, isinf(f) ? 1e3 * n : f), d = dp_window(&s, z);
        const double ndc = dp_mapping_get(spec.mapping)->ndc_signed ? 2 * d - 1 : d, slack = 1e-9 * (isinf(f) ? z : f);
        const double *g = given_in("inv_device_z", &s);
        assert_true(fabs(g[0] * d + g[1] + 1 / (g[2] * d - g[3]) - z) <= slack * z / n);
        for (int lh = 0; lh < 2; lh++) {
            const double eye = lh ? z : -z;
            g = given_in(lh ? "projection_lh" : "projection", &s);
            assert_true(fabs(through(g, eye) - ndc) <= 1e-9);
            g = given_in(lh ? "inverse_projection_lh" : "inverse_projection", &s);
            assert_true(fabs(through(g, ndc) - eye) <= slack * z / n);
        }
        assert_true(given_in("camera_params", &s)[3] == (spec.ortho != 0));
    }
}
