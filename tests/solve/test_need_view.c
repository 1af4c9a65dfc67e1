/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Slanted triangles in requirement files: what a camera says of them, mistakes, and what is judged by them. */
#include "solve/check.h"
#include "support.h"

static const char *const plain = "near = 0.5; far = 3000; mapping = \"reversed\"; format = \"fp32\";";

/* A camera that says `view`, on line 2, and a requirement. */
static bool parse(const char *camera, const char *view, const char *wanted, need_file *file, need_error *error) {
    static char text[2048];
    snprintf(text, sizeof text, "cameras = { a = { %s\n%s }; };\nrequirements = { r = { camera = \"a\"; %s }; };\n",
             camera, view, wanted);
    return need_parse("x.need", text, strlen(text), file, error);
}

/* ---- What is read ------------------------------------------------------------------------------------------------ */

static const struct {
    const char *view, *raster;
    dp_anchor anchor; /* DP_ANCHOR_COUNT: each term as where it is largest */
    dp_triangles triangles;
} views[] = {
    {"viewport = [1920, 1080]; fov = 40.5; subpixel = 6;",
     NULL,
     DP_ANCHOR_VERTEX,
     {1920, 1080, 40.5, 6, {0, 0, 0, 0}, 0, 90, 2, 512, 16}},
    {"viewport = (32768, 1.0); fov = 60; subpixel = 1; slant = [10, 45]; triangle = { depth = 1.5; };",
     NULL,
     DP_ANCHOR_VERTEX,
     {32768, 1, 60, 1, {0, 0, 0, 0}, 10, 45, 1.5, 512, 16}},
    {"viewport = [640, 480]; fov = 90; raster = \"LLVMpipe\"; slant = (0, 0.5);",
     "llvmpipe",
     DP_ANCHOR_ORIGIN,
     {640, 480, 90, 0, {0, 0, 0, 0}, 0, 0.5, 2, 512, 16}},
    {"viewport = [640, 480]; fov = 90; raster = \"spec-vulkan\"; triangle = { slim = 4; pixels = 20.5; };",
     "spec-vulkan",
     DP_ANCHOR_COUNT,
     {640, 480, 90, 4, {0, 0, 0, 0}, 0, 90, 2, 20.5, 4}},
    {"viewport = [640, 480]; fov = 90; raster = \"spec-gl\"; subpixel = 4;",
     "spec-gl",
     DP_ANCHOR_COUNT,
     {640, 480, 90, 4, {0, 0, 0, 0}, 0, 90, 2, 512, 16}},
    {"viewport = [640, 480]; fov = 90; raster = \"spec-gl\"; subpixel = 8;",
     "spec-gl",
     DP_ANCHOR_COUNT,
     {640, 480, 90, 8, {0, 0, 0, 0}, 0, 90, 2, 512, 16}},
};

static bool same(const dp_triangles *a, const dp_triangles *b, dp_anchor anchor) {
    dp_plane_error q = {0};
    for (int i = 0; i < DP_ANCHOR_COUNT; i++) {
        const dp_plane_error *row = &dp_anchor_get((dp_anchor)i)->plane;
        if (anchor == DP_ANCHOR_COUNT || anchor == (dp_anchor)i)
            q = (dp_plane_error){fmax(q.value, row->value), fmax(q.box, row->box), fmax(q.range, row->range),
                                 fmax(q.origin, row->origin)};
    }
    const dp_plane_error *p = &a->plane;
    return a->width == b->width && a->height == b->height && a->fov_y == b->fov_y && a->subpixel == b->subpixel &&
           p->value == q.value && p->box == q.box && p->range == q.range && p->origin == q.origin &&
           a->slant_lo == b->slant_lo && a->slant_hi == b->slant_hi && a->depth == b->depth && a->pixels == b->pixels &&
           a->slim == b->slim;
}

TEST(test_read) {
    tally t = {.name = "views are read"};
    need_file f;
    need_error e;
    for (size_t i = 0; i < sizeof views / sizeof views[0]; i++) {
        if (!parse(plain, views[i].view, "at = 1; separation = 1;", &f, &e))
            fail_msg("%s: %s", views[i].view, e.text);
        const raster_row *raster = f.cameras[0].raster;
        TALLY(&t, same(&f.cameras[0].setups[0].spec.triangles, &views[i].triangles, views[i].anchor), "%s",
              views[i].view);
        TALLY(&t, views[i].raster == NULL ? raster == NULL : strcmp(raster->name, views[i].raster) == 0, "%s",
              views[i].view);
        need_release(&f);
    }
    assert_true(parse(plain, "viewport = [1600, 900]; hfov = 90; subpixel = 8;", "at = 1; separation = 1;", &f, &e));
    assert_relative(f.cameras[0].setups[0].spec.triangles.fov_y, 2.0 * atan(0.5625) * 180.0 / acos(-1.0), 1e-14);
    need_release(&f);
    /* A preset says what is not given: unreal has 90 degrees horizontally and what Vulkan promises. */
    assert_true(parse("preset = \"unreal\";", "viewport = [1600, 900];", "at = 99; separation = 1;", &f, &e));
    const dp_triangles *of_preset = &f.cameras[0].setups[0].spec.triangles;
    assert_relative(of_preset->fov_y, 2.0 * atan(0.5625) * 180.0 / acos(-1.0), 1e-14);
    assert_true(of_preset->subpixel == 4 && strcmp(f.cameras[0].raster->name, "spec-vulkan") == 0);
    need_release(&f);
    assert_true(parse("preset = \"unreal\";", "viewport = [1600, 900]; fov = 30; subpixel = 6;",
                      "at = 99; separation = 1;", &f, &e));
    of_preset = &f.cameras[0].setups[0].spec.triangles;
    assert_true(of_preset->fov_y == 30 && of_preset->subpixel == 6 && f.cameras[0].raster == NULL);
    need_release(&f);
    assert_true(parse(plain, "", "at = 1; separation = 1;", &f, &e));
    assert_int_equal(f.cameras[0].setups[0].spec.triangles.width, 0);
    need_release(&f);
    tally_end(&t);
}

/* ---- What is refused --------------------------------------------------------------------------------------------- */

#define VIEW "viewport = [640, 480]; fov = 60; subpixel = 8; "
#define BAD  "viewport: must be [WIDTH, HEIGHT], each a whole number from 1 to 32768 pixels, got "
#define HALF "triangle: must have depth from 1 to 1e6, pixels from 1 to 65536 and slim from 2 to 1024, got "

static const struct {
    const char *camera, *view, *says; /* the camera null: a plain one */
} mistakes[] = {
    {NULL, "viewport = [640, 480]; subpixel = 8;", "viewport: needs fov, hfov or matrix"},
    {NULL, "viewport = [640, 480]; fov = 60;", "viewport: needs raster or subpixel"},
    {NULL, VIEW "hfov = 60;", "hfov: conflicts with fov"},
    {NULL, "fov = 60;", "fov: needs viewport: surfaces face the camera"},
    {NULL, "slant = [0, 60];", "slant: needs viewport"},
    {NULL, "triangle = { };", "triangle: needs viewport"},
    {NULL, "viewport = \"640x480\"; fov = 60; subpixel = 8;", BAD "'640x480'"},
    {NULL, "viewport = [640]; fov = 60; subpixel = 8;", BAD "1 values"},
    {NULL, "viewport = [640, 0]; fov = 60; subpixel = 8;", BAD "2 values"},
    {NULL, "viewport = [32769, 480]; fov = 60; subpixel = 8;", BAD "2 values"},
    {NULL, "viewport = [640.5, 480.0]; fov = 60; subpixel = 8;", BAD "640.5 and 480"},
    {NULL, "viewport = (640, 480.5); fov = 60; subpixel = 8;", BAD "640 and 480.5"},
    {NULL, "viewport = [640, 480]; fov = \"wide\"; subpixel = 8;", "fov: must be a number from 0.01 to 179 degrees"},
    {NULL, "viewport = [640, 480]; fov = 180; subpixel = 8;",
     "fov: must be a number from 0.01 to 179 degrees, got 180"},
    {NULL, "viewport = [640, 480]; hfov = 0; subpixel = 8;", "hfov: must be a number from 0.01 to 179 degrees, got 0"},
    {NULL, "viewport = [3, 30000]; hfov = 170; subpixel = 8;", "hfov: makes a vertical angle of 179.999 degrees"},
    {NULL, "viewport = [640, 480]; fov = 60; subpixel = 9;",
     "subpixel: must be a whole number from 1 to 8 bits, got 9"},
    {NULL, "viewport = [640, 480]; fov = 60; subpixel = 2.5;", "subpixel: must be a whole number from 1 to 8 bits"},
    {NULL, VIEW "raster = \"llvmpipe\";", "subpixel: does not apply: llvmpipe has its own grid"},
    {NULL, "viewport = [640, 480]; fov = 60; subpixel = 3; raster = \"spec-gl\";",
     "subpixel: must be at least 4 with the rasterizer spec-gl, got 3"},
    {NULL, "viewport = [640, 480]; fov = 60; raster = \"gpu\";", "raster: must be a rasterizer as 'depthprec list"},
    {NULL, "viewport = [640, 480]; fov = 60; raster = 3;", "raster: must be a word in quotes, got 3"},
    {NULL, VIEW "slant = 60;", "slant: must be [LO, HI], from 0 to 90 degrees, got 60"},
    {NULL, VIEW "slant = [0, 91];", "slant: must be [LO, HI], from 0 to 90 degrees, got 2 values"},
    {NULL, VIEW "slant = [60, 50];", "slant: must be [LO, HI], from 0 to 90 degrees, got 60 and 50"},
    {NULL, VIEW "triangle = 2;", "triangle: must be a group { depth = 2; pixels = 512; slim = 16; }, got 2"},
    {NULL, VIEW "triangle = { width = 2; };", "triangle: has no key 'width'"},
    {NULL, VIEW "triangle = { depth = 0.5; };", HALF "depth = 0.5"},
    {NULL, VIEW "triangle = { pixels = 65537; };", HALF "pixels = 65537"},
    {NULL, VIEW "triangle = { slim = \"2\"; };", HALF "slim = '2'"},
    {"near = 1; far = 2; mapping = \"log\"; format = \"fp32\";", VIEW, "viewport: needs one of the mappings"},
    {"near = 1; far = 2; mapping = \"d3d\"; format = \"fp32\"; ortho = true;", VIEW, "viewport: conflicts with ortho"},
    {"near = 1; far = 2; mapping = \"d3d\"; format = \"fp32\"; model = \"staged\";", VIEW,
     "viewport: needs the model float or auto, got staged"},
    {"near = 1; far = 2; mapping = \"d3d\"; format = \"unorm16\";",
     "viewport = [640, 480]; fov = 60; raster = \"softpipe\";", "raster: softpipe steps the codes of unorm16"},
};

TEST(test_mistakes) {
    tally t = {.name = "mistakes are told with their line"};
    for (size_t i = 0; i < sizeof mistakes / sizeof mistakes[0]; i++) {
        need_file f;
        need_error e;
        const char *camera = mistakes[i].camera != NULL ? mistakes[i].camera : plain;
        const bool good = parse(camera, mistakes[i].view, "at = 1; separation = 1;", &f, &e);
        TALLY(&t, !good && e.line == 2 && strncmp(e.text, mistakes[i].says, strlen(mistakes[i].says)) == 0,
              "%s: line %d: %s", mistakes[i].view, good ? -1 : e.line, good ? "read" : e.text);
        if (good)
            need_release(&f);
    }
    tally_end(&t);
}

/* ---- What is judged ---------------------------------------------------------------------------------------------- */

static bool no_counter(void *context, const dp_setup *setup, double lo, double hi, bool sample, double *share,
                       double *z) {
    (void)context, (void)lo, (void)sample;
    *share = setup->spec.triangles.width > 0 ? 1.0 : 0.0; /* ties are of depths at a point */
    *z = hi;
    return true;
}

static check_verdict judge_one(const char *camera, const char *view, const char *wanted) {
    need_file f;
    need_error e;
    check_verdict v;
    if (!parse(camera, view, wanted, &f, &e))
        fail_msg("%s: %s", view, e.text);
    const check_request request = {.file = &f, .count = no_counter};
    assert_int_equal(check_count(&f), 1);
    const long failed = check_all(&request, &v);
    assert_true(failed == !v.passed);
    const bool slanted = check_is_slanted(&v);
    assert_true(slanted == (*view != '\0' && v.asked->kind == QUANTITY_SEPARATION));
    need_release(&f);
    return v;
}

/* Snapping alone asks this edge-on, 2 sqrt(2) tau D z, fails a limit below it that facing surfaces meet. */
TEST(test_verdicts) {
    const char *view = "viewport = [1920, 1080]; hfov = 90; subpixel = 4;";
    const double snapping = 9.2e-5 * 1000;
    char wanted[64], ranged[64];
    snprintf(wanted, sizeof wanted, "at = 1000; separation = %.6f;", 0.99 * snapping);
    snprintf(ranged, sizeof ranged, "range = (5, 1000); separation = %.6f;", 0.99 * snapping);
    assert_true(judge_one(plain, "", wanted).passed && judge_one(plain, "", ranged).passed);
    assert_false(judge_one(plain, view, wanted).passed || judge_one(plain, view, ranged).passed);
    snprintf(wanted, sizeof wanted, "at = 1000; separation = %.6f;", 3 * snapping);
    snprintf(ranged, sizeof ranged, "range = (5, 1000); separation = %.6f;", 3 * snapping);
    const check_verdict at = judge_one(plain, view, wanted), over = judge_one(plain, view, ranged);
    assert_true(at.passed && over.passed && at.value > snapping && over.value >= at.value);
    assert_true(at.setup.spec.model == DP_MODEL_FLOAT && at.method == CHECK_GUARANTEE);
    assert_relative(over.value, at.value, 0x1p-10);
    assert_true(judge_one(plain, "viewport = [1920, 1080]; hfov = 90; subpixel = 4; slant = [0, 0];", wanted).value ==
                judge_one(plain, "", wanted).value);
    assert_true(judge_one(plain, view, "at = 1000; error = 0.01;").value ==
                judge_one(plain, "", "at = 1000; error = 0.01;").value);
    assert_true(judge_one(plain, view, "range = (1, 2); ties = 0.0;").passed);
}
