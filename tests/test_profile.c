/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Profiles of GPUs in requirement files: what is taken from files written by hand, and that damaged ones are refused.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "named.h"
#include "need/check.h"
#include "printed.h"

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

/* What a profile names, and the same said by name: set-ups alike, and only the first is measured. */
static void test_same_as_rows(void **state) {
    need_file f;
    (void)state;
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
static void test_paths(void **state) {
    char absolute[1024], text[1200];
    need_file f;
    (void)state;
    snprintf(absolute, sizeof absolute, "%s", scratch_file("two.json"));
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
static void test_two(void **state) {
    need_file f;
    (void)state;
    must_parse(CAMERA("a", "fp32", "arith = \"one.json\"; raster = \"../two.json\"; " VIEW), &f);
    assert_string_equal(f.cameras[0].gpu.measured, "One, driver D 1; Two, driver D 1");
    assert_string_equal(f.cameras[0].raster->name, "spec-d3d");
    need_release(&f);
    must_parse(CAMERA("a", "fp32", "arith = \"rude.json\";"), &f);
    assert_string_equal(f.cameras[0].gpu.measured, "a?b?, driver D 1");
    need_release(&f);
}

static void test_mistakes(void **state) {
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
        {CAMERA("a", "unorm24", "arith = \"one.json\";"), 2,
         "format: must be fp32 or unorm16 with a profile of a GPU that stores no other depth, got unorm24"},
        {CAMERA("a", "unorm24", "raster = \"one.json\";" VIEW), 2, "format: must be fp32 or unorm16 with"},
        {CAMERA("a", "depth24plus", "arith = \"one.json\";"), 2, "got unorm24"},
        {CAMERA("a", "unorm16", "arith = \"one.json\"; raster = \"../two.json\"; " VIEW), 2,
         "format: must be fp32 with a profile"},
        {CAMERA("a", "fp32", "arith = \"nothing.json\";"), 2, "format: must be nothing with a profile"},
        {"a = { preset = \"three\"; arith = \"one.json\"; };\n", 2, "format: must be fp32 or unorm16 with a profile"},
        {CAMERA("a", "fp32", "arith = \"ieeee\";"), 3, "arith: must be one of ieee, "},
    };
    tally told = {.name = "each profile that cannot be used is told with its line"};
    (void)state;
    for (size_t i = 0; i < sizeof mistakes / sizeof mistakes[0]; i++) {
        need_file f;
        need_error e;
        const bool good = parse(mistakes[i].camera, &f, &e);
        TALLY(&told, !good && e.line == mistakes[i].line && strstr(e.text, mistakes[i].says) != NULL && !e.unreadable,
              "%s\n-> line %d: %s (expected line %d: %s)", mistakes[i].camera, good ? -1 : e.line, good ? "" : e.text,
              mistakes[i].line, mistakes[i].says);
        if (good)
            need_release(&f);
    }
    tally_end(&told);
}

/* The program says which camera's promise is for which GPU, in every form but CSV, and none of a camera without. */
static void test_told(void **state) {
    char path[512];
    (void)state;
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
    assert_int_equal(bad.status, 2);
    assert_non_null(strstr(bad.errors, "bad.need:3: arith: '"));
    printed_free(&bad);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_same_as_rows), cmocka_unit_test(test_paths),
                                       cmocka_unit_test(test_two), cmocka_unit_test(test_mistakes),
                                       cmocka_unit_test(test_told)};
    cmocka_set_message_output(CM_OUTPUT_TAP);
    return cmocka_run_group_tests(tests, setup, NULL);
}
