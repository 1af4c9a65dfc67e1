/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Requirement files: what is read, and that every mistake is refused with its line and what was expected. */
#include "solve/requirement.h"
#include "support.h"

#define CAMERA   "cameras = { a = { near = 0.1; far = 1000; mapping = \"d3d\"; format = \"unorm24\"; }; };\n"
#define NEEDS(x) "requirements = { r = { camera = \"a\"; " x " }; };\n"

static bool parse(const char *text, need_file *file, need_error *error) {
    return need_parse("x.need", text, strlen(text), file, error);
}

TEST(example_is_read) {
    need_file f;
    need_error e;
    if (!need_read("tests/needs/engine.need", &f, &e))
        fail_msg("line %d: %s", e.line, e.text);
    need_release(&f);
    assert_true(parse(
        "cameras = { a = { preset = \"unity\"; model = \"float\"; }; };\n" NEEDS("separation = 1; at = 5;"), &f, &e));
    assert_int_equal(f.cameras[0].setups[0].spec.model, DP_MODEL_FLOAT);
    need_release(&f);
    assert_true(need_read("tests/needs/engine.need", &f, &e));
    assert_string_equal(f.unit, "m");
    assert_int_equal(f.camera_count, 4);
    assert_int_equal(f.count, 6);
    assert_string_equal(f.cameras[1].name, "web");
    assert_int_equal(f.cameras[1].count, 2); /* depth24plus */
    assert_true(f.cameras[1].setups[0].spec.znear == 0.5 && f.cameras[1].setups[0].spec.zfar == 2000.0);
    assert_true(isinf(f.cameras[0].setups[0].spec.zfar));
    assert_int_equal(f.cameras[0].setups[0].spec.model, DP_MODEL_FLOAT);
    assert_true(f.cameras[2].setups[0].spec.znear == 0.2 && f.cameras[2].setups[0].spec.zfar == 4000.0);
    assert_true(f.cameras[3].setups[0].spec.ortho);
    assert_string_equal(f.needs[0].name, "decals");
    assert_int_equal(f.needs[0].line, 14);
    assert_true(f.needs[0].kind == QUANTITY_SEPARATION && f.needs[0].lo == 0.5 && f.needs[0].hi == 50.0);
    assert_true(f.needs[0].limit == 0.1 / 1000.0);
    assert_true(f.needs[1].lo == 2000.0 && f.needs[1].hi == 2000.0);
    assert_true(f.needs[2].kind == QUANTITY_TIES && f.needs[2].limit == 0.4);
    need_release(&f);
}

/* A whole number is read as such whatever its size; libconfig 1.5 kept its lower 32 bits. */
TEST(large_whole_numbers_are_read) {
    need_file f;
    need_error e;
    assert_true(parse(
        "cameras = { a = { near = 4294967297; far = 5000000000; mapping = \"d3d\"; format = \"fp32\"; }; };" NEEDS(
            "at = 4500000000; error = 3000000000;"),
        &f, &e));
    assert_true(f.cameras[0].setups[0].spec.znear == 4294967297.0 && f.cameras[0].setups[0].spec.zfar == 5e9);
    assert_true(f.needs[0].lo == 4.5e9 && f.needs[0].limit == 3e9);
    need_release(&f);
}

/* Each length in scene units of each unit. */
TEST(units_are_converted) {
    static const char *const names[] = {"mm", "cm", "m", "km"};
    static const double mm[] = {1, 10, 1000, 1e6};
    for (int scene = 0; scene < 4; scene++)
        for (int unit = 0; unit < 4; unit++) {
            char text[512];
            need_file f;
            need_error e;
            snprintf(
                text, sizeof text,
                "unit = \"%s\"; cameras = { a = { near = 1e-6; far = 1e9; mapping = \"d3d\"; format = \"fp32\"; }; };"
                "requirements = { r = { camera = \"a\"; at = \"7.5 %s\"; error = 3; }; };",
                names[scene], names[unit]);
            assert_true(parse(text, &f, &e));
            assert_true(f.needs[0].lo == 7.5 * mm[unit] / mm[scene] && f.needs[0].limit == 3.0);
            need_release(&f);
        }
}

/* A preset in metres or centimetres is brought into the unit of the file; what is given beside it wins. */
TEST(presets_are_converted) {
    static const struct {
        const char *head;
        double znear;
    } cases[] = {{"unit = \"m\";", 0.1}, {"unit = \"cm\";", 10.0}, {"unit = \"mm\";", 100.0}, {"", 10.0}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char text[512];
        need_file f;
        need_error e;
        snprintf(text, sizeof text,
                 "%s cameras = { a = { preset = \"unreal\"; format = \"unorm24\"; }; };"
                 "requirements = { r = { camera = \"a\"; at = 200; error = 3; }; };",
                 cases[i].head);
        if (!parse(text, &f, &e))
            fail_msg("line %d: %s", e.line, e.text);
        assert_true(f.cameras[0].setups[0].spec.znear == cases[i].znear);
        assert_true(isinf(f.cameras[0].setups[0].spec.zfar));
        assert_string_equal(f.cameras[0].setups[0].spec.format.name, "unorm24");
        need_release(&f);
    }
}

/* C is 1 for a depth in the preset's own unit, metres, as on the command line: 0.001 for one in millimetres. */
TEST(logarithms_of_presets_are_converted) {
    static const struct {
        const char *head, *own;
        double log_c;
    } cases[] = {{"", "", 1.0},
                 {"unit = \"m\";", "", 1.0},
                 {"unit = \"mm\";", "", 0.001},
                 {"unit = \"km\";", "", 1000.0},
                 {"unit = \"km\";", "log_c = 2;", 2.0}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char text[512];
        need_file f;
        need_error e;
        snprintf(text, sizeof text,
                 "%s cameras = { a = { preset = \"cesium\"; near = 1; far = 2000; mapping = \"log\"; %s }; };"
                 "requirements = { r = { camera = \"a\"; at = 2; error = 3; }; };",
                 cases[i].head, cases[i].own);
        if (!parse(text, &f, &e))
            fail_msg("line %d: %s", e.line, e.text);
        assert_relative(f.cameras[0].setups[0].spec.log_c, cases[i].log_c, 1e-15);
        need_release(&f);
    }
}

TEST(lists_are_read) {
    need_file f;
    need_error e;
    assert_true(parse(CAMERA "requirements = ( { name = \"x\"; camera = \"a\"; at = 1; error = 1; },\n"
                             "{ name = \"y\"; camera = \"a\"; range = (1, 2.5); separation = 1L; } );",
                      &f, &e));
    assert_int_equal(f.count, 2);
    assert_string_equal(f.needs[1].name, "y");
    assert_int_equal(f.needs[1].line, 3);
    assert_true(f.needs[1].hi == 2.5);
    need_release(&f);
}

/* An orthographic camera may begin at or behind its place, and so may its depths, with units too. */
TEST(orthographic_depths_have_either_sign) {
    need_file f;
    need_error e;
    if (!parse("unit = \"m\"; cameras = { a = { near = \"-25 cm\"; far = 0; mapping = \"d3d\"; format = \"fp32\"; "
               "ortho = true; }; };"
               "requirements = { x = { camera = \"a\"; at = \"-10 cm\"; separation = 1; };"
               "y = { camera = \"a\"; range = (\"-20 cm\", 0); error = 1; }; };",
               &f, &e))
        fail_msg("line %d: %s", e.line, e.text);
    assert_true(f.cameras[0].setups[0].spec.znear == -0.25 && f.cameras[0].setups[0].spec.zfar == 0);
    assert_true(f.needs[0].lo == -0.1 && f.needs[0].hi == -0.1);
    assert_true(f.needs[1].lo == -0.2 && f.needs[1].hi == 0);
    need_release(&f);
}

#define SUN                                                                                                            \
    "cameras = { a = { near = -1; far = 2; mapping = \"d3d\"; format = \"fp32\"; model = \"float\"; ortho = true; }; " \
    "};\n"

/* The fault, on which line, and a piece of what is said. */
static const struct {
    const char *text;
    int line;
    const char *says;
} mistakes[] = {
    {"", 0, "needs a group 'cameras'"},
    {CAMERA, 0, "needs a group 'requirements'"},
    {CAMERA "requirements = { };", 2, "at least one"},
    {"cameras = { };", 1, "at least one camera"},
    {CAMERA "requirements = 3;", 2, "must be a group"},
    {CAMERA "requirements = { r = 3; };", 2, "must be a group { ... }, got 3"},
    {CAMERA NEEDS("at = 1; separation = 1;") "colour = 3;", 3, "has no key 'colour'"},
    {"cameras = { a = { neer = 0.1; }; };", 1, "has no key 'neer'"},
    {"cameras = { a = { near = 0.1; }; };", 1, "needs far"},
    {"cameras = { a = { near = 0.1; far = 9; format = \"fp32\"; }; };", 1, "needs mapping"},
    {"cameras = { a = { near = 0.1;\n far = \"soon\"; mapping = \"d3d\"; format = \"fp32\"; }; };" NEEDS(""), 2,
     "far: must be a length"},
    {"cameras = { a = { near = 5; far = 1; mapping = \"d3d\"; format = \"fp32\"; }; };" NEEDS(""), 1,
     "far: must be greater than near and at most 1e18, or 1e28 with near x far and C x far at most 1e30, or inf, got "
     "near 5, far 1"},
    {"cameras = { a = { near = 0; far = 1; mapping = \"d3d\"; format = \"fp32\"; }; };" NEEDS(""), 1, "near: must be"},
    {"cameras = { a = { near = -1; far = 1; mapping = \"d3d\"; format = \"fp32\"; }; };" NEEDS(""), 1, "near: must be"},
    {"cameras = { a = { near = 1; far = 2; mapping = \"zap\"; format = \"fp32\"; }; };" NEEDS(""), 1,
     "mapping: must be"},
    {"cameras = { a = { near = 1; far = 2; mapping = \"d3d\"; format = \"fp31\"; }; };" NEEDS(""), 1,
     "format: must be"},
    {"cameras = { a = { near = 1; far = 2; mapping = \"linear\"; format = \"fp32\"; model = \"float\"; }; };" NEEDS(""),
     1, "model: float is a pipeline's arithmetic, and a shader writes the depth of linear: leave it out, or take one"},
    {"cameras = { a = { near = 1; far = 2; mapping = \"d3d\"; format = \"fp32\"; log_c = 1.0; }; };" NEEDS(""), 1,
     "log_c: needs one of the mappings with a constant C: log, three-webgl, cesium, osgearth"},
    {"cameras = { a = { near = 1; far = 2; mapping = \"d3d\"; format = \"fp32\"; model = \"real\"; }; };" NEEDS(""), 1,
     "model: must be one of exact, staged, float, auto"},
    {"cameras = { a = { near = 1; far = 2; mapping = \"d3d\"; format = \"fp32\"; arith = 3; }; };" NEEDS(""), 1,
     "arith: must be a word"},
    {"cameras = { a = { near = 1; far = 2; mapping = \"d3d\"; format = \"fp32\"; ortho = 1; }; };" NEEDS(""), 1,
     "ortho: must be true or false"},
    {"cameras = { a = { near = 1; far = 2; mapping = \"linear\"; format = \"fp32\"; arith = \"fused\"; }; };" NEEDS(""),
     1, "arith: has no effect with linear alone"},
    {"cameras = { a = { near = 1; far = 2; mapping = \"linear\"; format = \"rg\"; }; };" NEEDS(""), 1,
     "format: rg is no depth buffer"},
    {"cameras = { a = { preset = \"unitee\"; }; };" NEEDS(""), 1, "preset: must be a preset as"},
    {CAMERA NEEDS("at = 1;"), 2, "one of separation, error, ties and bias"},
    {CAMERA NEEDS("at = 1; bias = 2;"), 2, "bias: must be a group"},
    {CAMERA NEEDS("at = 1; bias = { units = 2; };"), 2, "bias: needs api and units"},
    {CAMERA NEEDS("at = 1; bias = { api = \"gl\"; };"), 2, "bias: needs api and units"},
    {CAMERA NEEDS("at = 1; bias = { api = \"glide\"; units = 2; };"), 2, "bias: api must be one of"},
    {CAMERA NEEDS("at = 1; bias = { api = \"gl\"; units = \"2\"; };"), 2, "bias: units must be a number"},
    {CAMERA NEEDS("at = 1; bias = { api = \"gl\"; units = 2e12; };"), 2, "bias: units must be a number from -1e12"},
    {CAMERA NEEDS("at = 1; bias = { api = \"d3d11\"; units = 1.5; };"), 2, "must be a whole number of 32 bits"},
    {CAMERA NEEDS("at = 1; bias = { api = \"d3d9\"; units = 1; clamp = 1; };"), 2, "clamp must not be given for d3d9"},
    {CAMERA NEEDS("at = 1; bias = { api = \"gl\"; units = 1; slant = 1; };"), 2, "slant"},
    {CAMERA NEEDS("at = 1; separation = 1; bias = { api = \"gl\"; units = 1; };"), 2, "must not both be given"},
    {"cameras = { a = { near = 1; far = \"inf\"; mapping = \"reversed\"; format = \"fp32\"; }; };\n" NEEDS(
         "range = (1, \"inf\"); bias = { api = \"gl\"; units = 1; };"),
     2, "bias: needs a range with a finite far end"},
    {CAMERA NEEDS("separation = 1;"), 2, "needs at = DEPTH or range"},
    {CAMERA NEEDS("at = 1; range = [1.0, 2.0]; separation = 1;"), 2, "must not both be given"},
    {CAMERA NEEDS("at = 1; error = 1; separation = 1;"), 2, "must not both be given"},
    {CAMERA NEEDS("at = 0.01; separation = 1;"), 2, "must lie within near and far of the camera 'a'"},
    {CAMERA NEEDS("range = [1, 2000]; separation = 1;"), 2, "must lie within near and far"},
    {CAMERA NEEDS("range = [2, 1]; separation = 1;"), 2, "its near end must be below"},
    {CAMERA NEEDS("range = [1, 2, 3]; separation = 1;"), 2, "range: must be two depths"},
    {CAMERA NEEDS("range = 1; separation = 1;"), 2, "range: must be two depths"},
    {SUN NEEDS("at = -1.5; separation = 1;"), 2, "within near and far of the camera 'a', -1 and 2, got -1.5"},
    {SUN NEEDS("at = 1; separation = -1;"), 2, "separation: must be a finite length above 0"},
    {CAMERA NEEDS("at = -1; separation = 1;"), 2, "at: must be a finite length above 0"},
    {CAMERA NEEDS("at = 1; separation = 0;"), 2, "separation: must be a finite length above 0"},
    {CAMERA NEEDS("at = 1; separation = 1e999;"), 2, "separation: must be a finite length"},
    {CAMERA NEEDS("at = 1; separation = \"1 mm\";"), 2, "does not say what a scene unit is"},
    {"unit = \"m\";\n" CAMERA NEEDS("at = 1; separation = \"1 furlong\";"), 3,
     "the unit must be nm, um, mm, cm, m, km, in or ft"},
    {"unit = \"m\";\n" CAMERA NEEDS("at = 1; separation = \"0x1p3 m\";"), 3, "must be a length"},
    {"unit = \"m\";\n" CAMERA NEEDS("at = 1; separation = \"nan m\";"), 3, "must be a length"},
    {"unit = \"parsec\";", 1, "unit: must be nm, um, mm, cm, m, km, in or ft"},
    {CAMERA NEEDS("at = 1; ties = 0.1;"), 2, "ties: needs a range"},
    {"cameras = { a = { near = 1; far = \"inf\"; mapping = \"reversed\"; format = \"fp32\"; model = \"float\"; }; "
     "};\n" NEEDS("range = (2, 1.0e39); ties = 0.5;"),
     2, "ties: needs a range up to 3.4028235e+38, the largest binary32 number, got 1e+39"},
    {"cameras = { a = { near = 1; far = 9; mapping = \"d3d\"; format = \"fp32\"; model = \"exact\"; }; };\n" NEEDS(
         "at = 1; ties = 0.1;"),
     2, "ties: needs the model float or auto"},
    {"cameras = { a = { near = 1; far = 9; mapping = \"d3d\"; format = \"fp32\"; model = \"float\"; }; };\n" NEEDS(
         "at = 1; error = 0.1;"),
     2, "error: needs the model exact, staged or auto"},
    {"cameras = { a = { near = 1; far = 9; mapping = \"d3d\"; format = \"fp32\"; model = \"float\"; }; };\n" NEEDS(
         "at = 1; ties = 0.1;"),
     2, "ties: needs a range"},
    {"cameras = { a = { near = 1; far = 9; mapping = \"d3d\"; format = \"fp32\"; model = \"float\"; }; };\n" NEEDS(
         "range = [1, 2]; ties = 1.5;"),
     2, "must be a share from 0 to 1"},
    {CAMERA "requirements = { r = { camera = \"b\"; at = 1; error = 1; }; };", 2, "camera: must be one of those"},
    {CAMERA "requirements = { r = { at = 1; error = 1; }; };", 2, "needs a camera"},
    {CAMERA "requirements = ( { camera = \"a\"; at = 1; error = 1; } );", 2, "needs a name"},
    {CAMERA "requirements = ( { name = \"x\"; camera = \"a\"; at = 1; error = 1; },\n"
            "{ name = \"x\"; camera = \"a\"; at = 1; error = 1; } );",
     3, "is already on line 2"},
    {CAMERA NEEDS("at = 1; error = 1; at = 2;"), 2, "duplicate"},
    {CAMERA NEEDS("name = \"q\"; at = 1; error = 1;"), 2, "has no key 'name'"},
    {CAMERA "requirements = {", 2, "syntax error"},
    {CAMERA NEEDS("range = [0.5, 50]; error = 1;"), 2, "two numbers of one kind"},
    {"@include \"/etc/passwd\"\n", 1, "@include is not allowed"},
    {"\n  @include \"x\"\n", 2, "@include is not allowed"},
};

TEST(mistakes_are_refused) {
    tally told = {.name = "each mistake is told with its line"};
    for (size_t i = 0; i < sizeof mistakes / sizeof mistakes[0]; i++) {
        need_file f;
        need_error e;
        const bool good = parse(mistakes[i].text, &f, &e);
        TALLY(&told, !good && e.line == mistakes[i].line && strstr(e.text, mistakes[i].says) != NULL && !e.unreadable,
              "%s\n-> line %d: %s (expected line %d: %s)", mistakes[i].text, good ? -1 : e.line, good ? "" : e.text,
              mistakes[i].line, mistakes[i].says);
        if (good)
            need_release(&f);
    }
    tally_end(&told);
}

TEST(names_come_with_the_known_ones) {
    need_file f;
    need_error e;
    assert_false(parse("cameras = { a = { neer = 0.1; }; };", &f, &e));
    assert_string_equal(e.given, "neer");
    assert_non_null(strstr(e.known, "near far"));
    assert_false(need_read("tests/needs/nothing.need", &f, &e));
    assert_true(e.unreadable);
    assert_false(need_read("tests/needs", &f, &e)); /* a folder */
    assert_true(e.unreadable);
    const char nul[] = "unit = \"m\";\n\0x";
    assert_false(need_parse("x", nul, sizeof nul - 1, &f, &e));
    assert_int_equal(e.line, 2);
}

/* Cut anywhere, the example is refused, or it is whole: nothing crashes and nothing is half a file. */
TEST(every_prefix_is_safe) {
    char text[4096];
    FILE *in = fopen("tests/needs/engine.need", "rb");
    assert_non_null(in);
    const size_t size = fread(text, 1, sizeof text - 1, in);
    fclose(in);
    tally whole = {.name = "a file cut short is refused"};
    for (size_t cut = 0; cut < size; cut++) {
        need_file f;
        need_error e;
        const char keep = text[cut];
        text[cut] = '\0';
        const bool good = need_parse("x", text, cut, &f, &e);
        TALLY(&whole, !good || f.count == 6, "cut at %zu: %zu requirements", cut, f.count);
        if (good)
            need_release(&f);
        text[cut] = keep;
    }
    tally_end(&whole);
}
