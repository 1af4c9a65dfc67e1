/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Profiles of GPUs in requirement files: what is taken from files written by hand, and that damaged ones are refused.
 */
#include <sys/stat.h>
#include <unistd.h>

#include "named.h"
#include "printed.h"
#include "solve/check.h"

#define GPU(name, arith, raster, findings)                                                                             \
    "{\"command\": \"probe\", \"device\": {\"name\": \"" name "\", \"driver\": \"D 1\"}, \"arith\": " arith            \
    ", \"raster\": " raster ", \"findings\": [" findings "]}"
#define STORED(format) "{\"key\": \"stored\", \"format\": \"" format "\"}"

/* The files beside the requirement file, and where it is: a folder of the scratch one. */
static const struct {
    const char *name, *text;
} files[] = {
    {"needs/one.json", GPU("One", "\"reciprocal\"", "\"llvmpipe\"", STORED("d16") ", " STORED("d32f"))},
    {"two.json", GPU("Two", "\"fused\"", "\"spec-d3d\"", STORED("d24") ", " STORED("d32f"))},
    {"needs/no_row.json", GPU("None", "null", "null", STORED("d32f"))},
    {"needs/half.json", GPU("Half", "null", "\"llvmpipe\"", STORED("d32f"))},
    {"needs/strange.json", GPU("Odd", "\"made-up\"", "\"made-up\"", STORED("d32f"))},
    {"needs/nothing.json", GPU("Bare", "\"ieee\"", "\"llvmpipe\"", "")},
    {"needs/rude.json", GPU("a\\nb\\u001b", "\"ieee\"", "\"llvmpipe\"", STORED("d32f"))},
    {"needs/table.json", "{\"command\": \"table\"}"},
    {"needs/cut.json", "{\"command\": \"probe\", "},
    {"needs/list.json", "[1, 2]"},
};

static void write_text(const char *name, const char *text) {
    FILE *out = fopen(scratch_file(name), "w");
    assert_non_null(out);
    fputs(text, out);
    assert_int_equal(fclose(out), 0);
}

static int setup(void **state) {
    (void)state;
    mkdir(scratch_file("needs"), 0700);
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++)
        write_text(files[i].name, files[i].text);
    return 0;
}

#define CAMERA(name, format, more)                                                                                     \
    name " = { near = 0.1; far = 1000; mapping = \"reversed\"; format = \"" format "\";\n" more " };\n"
#define VIEW "viewport = [640, 480]; fov = 60; "
#define NEED "requirements = { r = { camera = \"a\"; at = 7; separation = 0.001; }; };\n"

/* On line 1 "cameras", on line 2 the keys of a camera, on 3 what is added. */
static bool parse(const char *cameras, need_file *file, need_error *error) {
    char text[2048], path[512];
    snprintf(path, sizeof path, "%s", scratch_file("needs/x.need"));
    snprintf(text, sizeof text, "cameras = {\n%s};\n" NEED, cameras);
    const bool good = need_parse(path, text, strlen(text), file, error);
    file->path = "x.need";
    return good;
}

static void must_parse(const char *cameras, need_file *file) {
    need_error e;
    if (!parse(cameras, file, &e))
        fail_msg("%s\nline %d: %s", cameras, e.line, e.text);
}

/* A profile's names, and the same said by name: set-ups alike, and only the first is measured. */
TEST(test_same_as_rows) {
    need_file f;
    must_parse(CAMERA("a", "fp32", "arith = \"one.json\"; raster = \"one.json\"; " VIEW)
                   CAMERA("b", "fp32", "arith = \"reciprocal\"; raster = \"llvmpipe\"; " VIEW)
                       CAMERA("c", "unorm16", ""),
               &f);
    const need_camera *a = &f.cameras[0], *b = &f.cameras[1];
    assert_string_equal(dp_arith_get(a->setups[0].spec.arith)->name, "reciprocal");
    assert_string_equal(a->raster->name, "llvmpipe");
    assert_string_equal(a->gpu.measured, "One, driver D 1");
    assert_true(a->raster == b->raster && a->setups[0].spec.arith == b->setups[0].spec.arith);
    assert_int_equal(a->setups[0].spec.triangles.subpixel, b->setups[0].spec.triangles.subpixel);
    assert_string_equal(b->gpu.measured, "");
    assert_string_equal(f.cameras[2].gpu.measured, "");
    need_release(&f);
}

/* Beside the requirement file, wherever the program runs; a folder up; and an absolute path. */
TEST(test_paths) {
    char text[1200];
    need_file f;
    const char *absolute = scratch_file("two.json");
    const char *const paths[] = {"../two.json", "./../two.json", absolute};
    for (size_t i = 0; i < 3; i++) {
        snprintf(text, sizeof text, CAMERA("a", "unorm24", "arith = \"%s\";"), paths[i]);
        must_parse(text, &f);
        assert_string_equal(f.cameras[0].gpu.measured, "Two, driver D 1");
        assert_string_equal(dp_arith_get(f.cameras[0].setups[0].spec.arith)->name, "fused");
        need_release(&f);
    }
}

/* Two GPUs: the promise is for both, so for the formats that both store. */
TEST(test_two) {
    need_file f;
    must_parse(CAMERA("a", "fp32", "arith = \"one.json\"; raster = \"../two.json\"; " VIEW), &f);
    assert_string_equal(f.cameras[0].gpu.measured, "One, driver D 1; Two, driver D 1");
    assert_string_equal(f.cameras[0].raster->name, "spec-d3d");
    need_release(&f);
    must_parse(CAMERA("a", "fp32", "arith = \"rude.json\";"), &f);
    assert_string_equal(f.cameras[0].gpu.measured, "a?b?, driver D 1");
    need_release(&f);
}

TEST(test_mistakes) {
    static const struct {
        const char *camera;
        int line;
        const char *says;
    } mistakes[] = {
        {CAMERA("a", "fp32", "arith = \"none.json\";"), 3, "none.json' cannot be read: "},
        {CAMERA("a", "fp32", "raster = \"none.json\";" VIEW), 3, "none.json' cannot be read: "},
        {CAMERA("a", "fp32", "arith = \"two.json\";"), 3, "two.json' cannot be read: "},
        {CAMERA("a", "fp32", "arith = \"cut.json\";"), 3, "cut.json' cannot be read: "},
        {CAMERA("a", "fp32", "arith = \"./\";"), 3, "arith: '"},
        {CAMERA("a", "fp32", "arith = \"table.json\";"), 3, "arith: must be a profile that 'depthprec probe --json'"},
        {CAMERA("a", "fp32", "arith = \"list.json\";"), 3, "arith: must be a profile that 'depthprec probe --json'"},
        {CAMERA("a", "fp32", "\nraster = \"no_row.json\";" VIEW), 4, "no row predicts all its codes"},
        {CAMERA("a", "fp32", "arith = \"strange.json\";"), 3, "names what is not known here, 'made-up'"},
        {CAMERA("a", "fp32", "raster = \"strange.json\";" VIEW), 3, "names what is not known here, 'made-up'"},
        {CAMERA("a", "fp32", "raster = \"half.json\";" VIEW), 2,
         "arith: must be given: the profile of raster names none that is known"},
        {CAMERA("a", "unorm24", "arith = \"one.json\";"), 2,
         "format: must be fp32 or unorm16 with a profile of a GPU that stores no other depth, got unorm24"},
        {CAMERA("a", "unorm24", "raster = \"one.json\";" VIEW), 2, "format: must be fp32 or unorm16 with"},
        {CAMERA("a", "depth24plus", "arith = \"one.json\";"), 2, "got unorm24"},
        {CAMERA("a", "unorm16", "arith = \"one.json\"; raster = \"../two.json\"; " VIEW), 2,
         "format: must be fp32 with a profile"},
        {CAMERA("a", "fp32", "arith = \"nothing.json\";"), 2, "format: must be nothing with a profile"},
        {"a = { preset = \"three\"; arith = \"one.json\"; };\n", 2,
         "no other depth, got unorm24; preset three chose it"},
        {"a = { preset = \"maplibre:zoom=4\"; };\n", 2,
         "preset: needs height: maplibre:zoom=4,height=800, or the height"},
        {"a = { preset = \"maplibre:zum=4\"; };\n", 2, "preset: maplibre is computed from zoom, pitch"},
        {"a = { preset = \"maplibr:zoom=4\"; };\n", 2, "preset: must be a preset as"},
        {CAMERA("a", "fp32", "arith = \"ieeee\";"), 3, "arith: must be one of ieee, "},
    };
    tally told = {.name = "each profile that cannot be used is told with its line"};
    for (size_t i = 0; i < sizeof mistakes / sizeof mistakes[0]; i++) {
        need_file f;
        need_error e;
        const bool good = parse(mistakes[i].camera, &f, &e);
        const bool away = strstr(e.text, " directory") != NULL; /* there is no such file, or it is a directory */
        TALLY(&told,
              !good && e.line == mistakes[i].line && strstr(e.text, mistakes[i].says) != NULL && e.unreadable == away,
              "%s\n-> line %d: %s (expected line %d: %s)", mistakes[i].camera, good ? -1 : e.line, good ? "" : e.text,
              mistakes[i].line, mistakes[i].says);
        if (good)
            need_release(&f);
    }
    tally_end(&told);
}

/* The program says which camera's promise is for which GPU, in every form but CSV, and none of a camera without. */
TEST(test_told) {
    char path[512];
    write_text("needs/told.need",
               "cameras = {\n" CAMERA("a", "fp32", "arith = \"one.json\";")
                   CAMERA("b", "fp32", "") "};\n"
                                           "requirements = { r = { camera = \"a\"; at = 7; separation = 1e-9; };\n"
                                           "s = { camera = \"b\"; at = 7; separation = 1e-9; }; };\n");
    snprintf(path, sizeof path, "%s", scratch_file("needs/told.need"));
    printed text = print_of("check --full %s", path), json = print_of("check --json %s", path);
    printed junit = print_of("check --report junit %s", path), quiet = print_of("check -q %s", path);
    assert_int_equal(text.status, 1);
    assert_non_null(strstr(text.out, "told.need: camera a: measured on One, driver D 1\n"));
    assert_null(strstr(text.out, "camera b: measured"));
    assert_null(strstr(quiet.out, "measured"));
    const char *once = strstr(junit.out, "measured on One, driver D 1</failure>");
    assert_non_null(once);
    assert_null(strstr(once + 1, "measured"));
    json_t *root = json_of(json.out), *list = json_object_get(root, "requirements");
    const char *said = json_string_value(json_object_get(json_array_get(list, 0), "measured"));
    assert_non_null(said);
    assert_string_equal(said, "One, driver D 1");
    assert_null(json_object_get(json_array_get(list, 1), "measured"));
    json_decref(root);
    printed_free(&text);
    printed_free(&json);
    printed_free(&junit);
    printed_free(&quiet);
    write_text("needs/bad.need", "cameras = {\n" CAMERA("a", "fp32", "arith = \"none.json\";") "};\n" NEED);
    snprintf(path, sizeof path, "%s", scratch_file("needs/bad.need"));
    printed bad = print_of("check %s", path);
    assert_int_equal(bad.status, 3);
    assert_non_null(strstr(bad.errors, "bad.need:3: arith: '"));
    printed_free(&bad);
}

/* ---- Bias -------------------------------------------------------------------------------------------------------- */
#define BIAS(format, found, sure)                                                                                      \
    ", {\"key\": \"bias\", \"format\": \"" format "\", \"found\": \"" found "\", \"sure\": \"" sure "\"}"
#define N_OF(m, what) "r = 2^(n-" m "), 2^n the power of two at or below " what
#define LARGEST       "the largest depth of the triangle"
#define PIXEL         "the depth of the pixel"
#define ANCHOR        "the anchor's depth and the others' differences from it"

/* The findings, and r by each: times 2^(n - 23), n the exponent of the pixel, or codes. */
static const struct {
    const char *found32, *found16, *sure, *device;
    double least32, most32, codes;
} found_of[] = {
    {N_OF("23", LARGEST), "r = one code", "sure", "Vulkan 1.3", 1, 1, 1},
    {N_OF("22", LARGEST), "r = two codes", "sure", "Vulkan 1.3", 2, 2, 2},
    {N_OF("24", LARGEST), "r = half a code", "sure", "WebGL 2", 0.5, 0.5, 0.5},
    {N_OF("23", PIXEL), "r = one code", "sure", "OpenGL 4.5", 1, 1, 1},
    {N_OF("22", PIXEL), "r = two codes", "sure", "Vulkan 1.3", 2, 2, 2},
    {N_OF("24", PIXEL), "r = one code", "sure", "Vulkan 1.3", 0.5, 0.5, 1},
    {N_OF("23", ANCHOR), "r = one code", "sure", "Vulkan 1.3", 0.5, 1, 1},
    {N_OF("23", LARGEST), "r = two codes", "open", "Vulkan 1.3", 0, 0, 0},
    {N_OF("23", LARGEST), "r = two codes", "no row", "OpenGL 4.5", 0, 0, 0},
    {"r = 2^(n-21)", "r = ten codes", "sure", "Vulkan 1.3", 0, 0, 0},
    {N_OF("22", LARGEST), "r = two codes", "sure", "Metal 3", 0, 0, 0},
};

static void write_bias(const char *file, size_t i, const char *more) {
    char text[2048];
    snprintf(text, sizeof text,
             "{\"command\": \"probe\", \"device\": {\"name\": \"B\", \"driver\": \"D\", \"api\": \"%s\"}, \"arith\": "
             "\"ieee\", \"raster\": \"llvmpipe\", \"findings\": [" STORED("d16") ", " STORED("d32f")
                 BIAS("d32f", "%s", "%s") BIAS("d16", "%s", "%s") "%s]}",
             found_of[i].device, found_of[i].found32, found_of[i].sure, found_of[i].found16, found_of[i].sure, more);
    write_text(file, text);
}

/* The only row of the only set-up. */
static json_t *row_of(json_t *root) {
    return json_array_get(json_object_get(json_array_get(json_object_get(root, "setups"), 0), "rows"), 0);
}

static double number_in(const json_t *object, const char *key) {
    const json_t *value = json_object_get(object, key);
    assert_true(json_is_number(value));
    return json_number_value(value);
}

static json_t *bias_json(const char *raster, const char *api, const char *more, double r[2]) {
    printed p = print_of("bias --api %s -n 0.1 -f inf -m reversed --at 10 %s --json%s%s", api, more,
                         raster != NULL ? " --raster " : "", raster != NULL ? raster : "");
    if (p.status != 0)
        fail_msg("%s", p.errors);
    json_t *root = json_of(p.out), *most = json_object_get(row_of(root), "r_most");
    r[0] = number_in(row_of(root), "r");
    r[1] = json_is_number(most) ? json_number_value(most) : INFINITY;
    printed_free(&p);
    return root;
}

/* r as it was found, of the API by which it was drawn and of no other; where it was not found for sure, nothing. */
TEST(test_bias_measured) {
    double r[2], by_api[2];
    const char *path = scratch_file("bias.json");
    for (size_t i = 0; i < sizeof found_of / sizeof found_of[0]; i++)
        for (int api = 0; api < 3; api++) {
            const char *const name = (const char *const[]){"vulkan", "gl", "d3d11"}[api];
            const char *const drawn = (const char *const[]){"Vulkan", "GL", "none"}[api];
            const bool known = found_of[i].codes > 0 && strstr(found_of[i].device, drawn) != NULL;
            write_bias("bias.json", i, "");
            for (int is_float = 0; is_float < 2; is_float++) {
                const char *const format = is_float ? "-F fp32 --separation 0.01" : "-F unorm16 --separation 0.01";
                json_t *open = bias_json(NULL, name, format, by_api), *root = bias_json(path, name, format, r);
                assert_string_equal(json_string_value(json_object_get(root, "measured")), "B, driver D");
                /* depth 0.01 = 1.28 x 2^-7 */
                const double least = is_float ? ldexp(found_of[i].least32, -30) : ldexp(found_of[i].codes, -16);
                const double most = is_float ? ldexp(found_of[i].most32, -30) : found_of[i].codes / 65535;
                if (r[0] != (known ? least : by_api[0]) || (known ? fabs(r[1] / most - 1) > 1e-15 : r[1] != by_api[1]))
                    fail_msg("%s, %s, row %zu: r from %a to %a", name, format, i, r[0], r[1]);
                const long double gap = 0.1L / 9.99L - 0.01L;
                const json_t *range = json_object_get(json_array_get(json_object_get(root, "setups"), 0), "range");
                if (known && is_float) /* 32 bits have finer steps than the gap */
                    assert_true(number_in(row_of(root), "units_gap") == ceil((double)(gap / (long double)least)));
                if (known)
                    assert_true(json_is_null(json_object_get(range, "units_apart_next")));
                json_decref(open);
                json_decref(root);
            }
        }
}

/* A further finding of a profile. */
static const char cuts[] =
    ", {\"key\": \"fraction\", \"found\": \"fractions of a constant are cut\", \"sure\": \"sure\"}";

/* A platform's scale comes on top; fractions are cut where that was found. Words say so. */
TEST(test_bias_beside) {
    double r[2];
    const char *path = scratch_file("bias.json");
    write_bias("bias.json", 1, cuts); /* 2^(n-22) */
    printed p =
        print_of("bias --platform webgl-vulkan -F fp32 -n 0.1 -f inf -m reversed --at 10 --raster %s --json", path);
    assert_int_equal(p.status, 0);
    json_t *root = json_of(p.out);
    assert_true(number_in(row_of(root), "r") == 0x1p-29 && number_in(row_of(root), "r_most") == 0x1p-28);
    json_decref(root);
    printed_free(&p);
    write_bias("bias.json", 3, ""); /* 2^(n-23), OpenGL */
    p = print_of("bias --platform webgl-gl -F fp32 -n 0.1 -f inf -m reversed --at 10 --raster %s --json", path);
    root = json_of(p.out);
    assert_true(number_in(row_of(root), "r") == 0x1p-31 && number_in(row_of(root), "r_most") == 0x1p-31);
    json_decref(root);
    printed_free(&p);
    write_bias("bias.json", 1, cuts);
    root = bias_json(path, "vulkan", "-F fp32 --units 2.75", r);
    assert_true(number_in(row_of(root), "bias") == 2 * 0x1p-29);
    json_decref(root);
    root = bias_json(path, "gl", "-F fp32 --units 2.75", r);
    assert_true(number_in(row_of(root), "bias") == 2.75 * 0x1p-30);
    json_decref(root);
    p = print_of("bias --api vulkan -F fp32 -n 0.1 -f inf -m reversed --at 10 --full --raster %s", path);
    assert_non_null(
        strstr(p.out, "on this GPU r is 2 times 2^(n-23), for a depth in [2^n, 2^(n+1)); fractional units"));
    assert_null(strstr(p.out, "drivers take"));
    assert_non_null(strstr(p.out, "Measured on B, driver D."));
    printed_free(&p);
    p = print_of("bias --api gl -F fp32 -n 0.1 -f inf -m reversed --at 10 --full --raster %s", path);
    assert_non_null(strstr(p.out, "r was not measured on this GPU for gl\n"));
    assert_non_null(strstr(p.out, "drivers take"));
    printed_free(&p);
    p = print_of("bias --api all -F fp32,d16 -n 0.1 -f inf -m reversed --at 10 --full --raster %s", path);
    assert_non_null(strstr(p.out, "vulkan: on this GPU r is 2 times 2^(n-23)"));
    assert_non_null(strstr(p.out, "vulkan: on this GPU r is 2 codes\n"));
    assert_non_null(strstr(p.out, "\n  gl: r is the implementation's choice, 2^-16"));
    printed_free(&p);
}

/* Words of two GPUs tell both ends. */
TEST(test_bias_of_two_said) {
    char path[2][256];
    for (size_t i = 0; i < 2; i++) {
        const char *const name = i == 0 ? "bias.json" : "other.json";
        write_bias(name, i, "");
        snprintf(path[i], sizeof path[i], "%s", scratch_file(name));
    }
    printed p = print_of("bias --api vulkan -F fp32 -n 0.1 -f inf -m reversed --at 10 --full --raster %s --arith %s",
                         path[0], path[1]);
    assert_non_null(strstr(p.out, "on this GPU r is 1 to 2 times 2^(n-23)"));
    printed_free(&p);
}

/* Two GPUs: the least and the greatest r of both, or none where one is not known; fractions are cut where one of them
 * cuts. */
TEST(test_bias_of_two) {
    static const struct {
        size_t a, b;
        double least, most;
        bool cut[2];
    } two[] = {{0, 1, 1, 2, {false, false}}, {1, 6, 0.5, 2, {false, true}}, {0, 7, 0, 0, {true, true}},
               {7, 0, 0, 0, {false, false}}, {0, 2, 0, 0, {false, false}},  {0, 1, 1, 2, {true, false}},
               {0, 1, 1, 2, {true, true}}};
    char name[PROFILE_NAME_SIZE], error[PROFILE_ERROR_SIZE];
    dp_format fp32[2];
    assert_int_equal(dp_format_parse("fp32", fp32), 1);
    for (size_t i = 0; i < sizeof two / sizeof two[0]; i++) {
        profile gpus = {.measured = ""};
        write_bias("bias.json", two[i].a, two[i].cut[0] ? cuts : "");
        assert_int_equal(profile_add(&gpus, scratch_file("bias.json"), "arith", name, error), 0);
        assert_int_equal(profile_add(&gpus, scratch_file("bias.json"), "raster", name, error), 0); /* the same again */
        assert_string_equal(gpus.measured, "B, driver D");
        write_bias("bias.json", two[i].b, two[i].cut[1] ? cuts : "");
        assert_int_equal(profile_add(&gpus, scratch_file("bias.json"), "raster", name, error), 0);
        const profile_format *of = profile_biased(&gpus, NULL, bias_api_find("vulkan"), &fp32[0]);
        assert_int_equal(of != NULL, two[i].least > 0);
        assert_true(of == NULL || (of->least == two[i].least && of->most == two[i].most &&
                                   of->cuts == (two[i].cut[0] || two[i].cut[1])));
    }
}

/* What the tree's profiles found of r is known, each of it. */
TEST(test_bias_of_tree) {
    static const struct {
        const char *driver, *api;
        double least32, codes16;
    } drivers[] = {{"lavapipe", "vulkan", 1, 2},
                   {"llvmpipe", "gl", 1, 2},
                   {"softpipe", "gl", 1, 2},
                   {"swiftshader", "vulkan", 0.5, 1}};
    char path[128], name[PROFILE_NAME_SIZE], error[PROFILE_ERROR_SIZE];
    dp_format fp32[2], unorm16[2];
    dp_format_parse("fp32", fp32);
    dp_format_parse("unorm16", unorm16);
    for (size_t i = 0; i < sizeof drivers / sizeof drivers[0]; i++) {
        profile gpu = {.measured = ""};
        const bias_api *api = bias_api_find(drivers[i].api);
        snprintf(path, sizeof path, "tests/profiles/%s.json", drivers[i].driver);
        assert_int_equal(profile_add(&gpu, path, "raster", name, error), 0);
        assert_string_equal(name, drivers[i].driver);
        assert_true(profile_biased(&gpu, NULL, api, &fp32[0])->least == drivers[i].least32);
        assert_true(profile_biased(&gpu, NULL, api, &unorm16[0])->least == drivers[i].codes16);
    }
}

/* The anchor's depth and the differences from it have at least the exponent of the largest of three depths less 1. */
TEST(test_anchor) {
    rng r = rng_make("anchor");
    int less = 0;
    for (int i = 0; i < 100000; i++) {
        double z[3];
        for (int k = 0; k < 3; k++)
            z[k] = (double)(float)ldexp(rng_unit(&r), -(int)(rng_unit(&r) * 4));
        const double largest = fmax(z[0], fmax(z[1], z[2]));
        const double taken = fmax(z[1], fmax(fabs(z[0] - z[1]), fabs(z[2] - z[1])));
        assert_true(ilogb(taken) >= ilogb(largest) - 1 && ilogb(taken) <= ilogb(largest));
        less += ilogb(taken) < ilogb(largest);
    }
    assert_true(less > 0);
}

int main(void) {
    return run_listed(setup, NULL);
}
