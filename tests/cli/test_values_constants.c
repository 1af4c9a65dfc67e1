/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The output of table --constants: Unity's formulas in long double, rounded to binary32 after each operation. The traps
 * are the library's, which test_constants does step by step; a few are done here again as the text has them. */
#include "printed.h"
#include "shader/constants.h"
#include "views.h"

enum { DEPTHS = 3, LINES = 8, CAMERAS = 2 };

static const char *const lines[LINES] = {
    "table --constants -n 0.3 -f 1000 -m d3d,gl --unit m --at 0.3,10,1000 --viewport 1920x1080",
    "table --constants -n 0.3 -f 1000 -m reversed,gl-reversed --at 0.3,10,1000 --viewport 640x480 --fov 35",
    "table --constants -n 0.2 -f inf -m d3d,reversed --unit cm --at 0.25,7,1e5 --viewport 300x900 --fov 90",
    "table --constants -n 1e-3 -f 1e5 -m d3d,reversed --at 0.001,3,1e5 --viewport 100x200 --fov 100",
    "table --constants -n 0.5 -f 80 -m d3d,gl --ortho --at 0.5,7.3,80",
    "table --constants -n 0.5 -f 80 -m reversed,gl-reversed --ortho --at 0.5,7.3,80",
    "table --constants -n 0 -f 80 -m d3d,reversed --ortho --at 0,7.3,80",
    "table --constants -n -3 -f 80.7 -m gl,reversed --ortho --unit km --at -2,7.3,80",
};

typedef struct camera {
    double n, f, fov, width, height, z[DEPTHS];
    bool ortho, ndc_signed, reversed, infinite;
    const char *mapping;
} camera;

static camera camera_of(const char *line, size_t i) {
    camera c = {.n = number_behind(line, "-n", NAN), .fov = number_behind(line, "--fov", 60), .width = 1, .height = 1};
    const char *far = word_behind(line, "-f"), *names = word_behind(line, "-m");
    char mapping[32];
    const char *second = strchr(names, ',');
    snprintf(mapping, sizeof mapping, "%.*s", i == 0 ? (int)(second - names) : 31, i == 0 ? names : second + 1);
    c.infinite = strcmp(far, "inf") == 0;
    c.f = c.infinite ? INFINITY : strtod(far, NULL);
    c.ortho = strstr(line, "--ortho") != NULL;
    c.ndc_signed = strncmp(mapping, "gl", 2) == 0;
    c.reversed = strstr(mapping, "reversed") != NULL;
    c.mapping = c.ndc_signed ? (c.reversed ? "gl-reversed" : "gl") : c.reversed ? "reversed" : "d3d";
    if (!c.ortho)
        assert_int_equal(sscanf(word_behind(line, "--viewport"), "%lfx%lf", &c.width, &c.height), 2);
    assert_int_equal(numbers_behind(line, "--at", c.z, DEPTHS), DEPTHS);
    return c;
}

/* One operation of a shader. */
static double fl(long double x) {
    return (double)(float)x;
}

/* ---- Both vectors ------------------------------------------------------------------------------------------------ */

static void zbuffer_of(const camera *c, double out[4]) {
    const long double n = c->n, f = c->f;
    const long double ratio = n == 0 ? INFINITY : f / n, by_near = n == 0 ? INFINITY : 1 / n;
    const long double standard[] = {1 - ratio, ratio, n == 0 ? -INFINITY : 1 / f - 1 / n, by_near};
    const long double reversed[] = {ratio - 1, 1, n == 0 ? INFINITY : 1 / n - 1 / f, 1 / f};
    for (int i = 0; i < 4; i++)
        out[i] = fl(c->reversed ? reversed[i] : standard[i]);
}

/* ---- A depth ----------------------------------------------------------------------------------------------------- */

/* A and B of the third row of the matrix, Direct3D's, then by NDC 2 d - 1 and the other way round. */
static void matrix_of(const camera *c, double *a, double *b) {
    const long double n = c->n, f = c->f, span = f - n;
    long double scale = c->ortho ? 1 / span : c->infinite ? 1 : f / span;
    long double shift = c->ortho ? -n / span : c->infinite ? -n : -f * n / span;
    if (c->reversed && c->ortho) {
        scale = -1 / span;
        shift = f / span;
    } else if (c->reversed) {
        scale = c->infinite ? 0 : -n / span;
        shift = c->infinite ? n : f * n / span;
    }
    if (c->ndc_signed) { /* 2 d - 1, times w */
        scale = c->ortho ? 2 * scale : c->reversed ? -(f + n) / span : (f + n) / span;
        shift = !c->ortho ? 2 * shift : c->reversed ? (f + n) / span : -(f + n) / span;
    }
    *a = fl(scale);
    *b = fl(shift);
}

typedef struct made {
    double clip_z, clip_w, ndc, window, eye, linear01, from_near, d16, d24, depth_normals;
} made;

/* LinearEyeDepth or LinearDepthToEyeDepth of a depth. */
static double eye_of(const camera *c, double d) {
    double v[4];
    const double span = fl((long double)c->f - c->n);
    zbuffer_of(c, v);
    if (c->ortho)
        return c->reversed ? fl(fl((long double)-span * d) + fl(c->f)) : fl(fl((long double)span * d) + fl(c->n));
    return fl(1 / (long double)fl(fl((long double)v[2] * d) + (long double)v[3]));
}

/* A share of `steps` whole numbers, the nearest. */
static double rounded(double share, double steps) {
    return fl(floorl((long double)share * steps + 0.5L) / steps);
}

static made made_of(const camera *c, double depth) {
    double a, b, v[4];
    const double z = fl(depth);
    made m = {.clip_w = c->ortho ? 1 : z, .linear01 = NAN, .from_near = NAN};
    matrix_of(c, &a, &b);
    zbuffer_of(c, v);
    m.clip_z = fl(fl((long double)a * z) + (long double)b);
    m.ndc = fl((long double)m.clip_z / m.clip_w);
    m.window = c->ndc_signed ? fl(fl(m.ndc * 0.5L) + 0.5L) : m.ndc;
    m.window = fmin(fmax(m.window, 0), 1);
    const double d = m.window, share = fl((long double)z * fl(1 / (long double)c->f));
    m.eye = eye_of(c, d);
    m.d16 = eye_of(c, rounded(d, 65535));
    m.d24 = eye_of(c, rounded(d, 16777215));
    m.depth_normals = share >= 1 ? 0 : fl(rounded(fmax(share, 0), 65025) * (long double)fl(c->f));
    if (c->infinite)
        m.depth_normals = NAN;
    if (!c->infinite && !c->ortho) {
        const double under = fl(fl((long double)v[0] * d) + (long double)v[1]);
        m.linear01 = fl(1 / (long double)under);
        m.from_near = fl((c->reversed ? fl(1 - (long double)d) : d) / (long double)under);
    }
    return m;
}

/* ---- What is printed --------------------------------------------------------------------------------------------- */

static void want_camera(values *v, const camera *c, const char *under) {
    double p[4];
    zbuffer_of(c, p);
    values_under(v, "%s", under);
    want(v, "near=%f far=%f projection=%s", c->n, c->f, c->ortho ? "orthographic" : "perspective");
    want(v, "mapping=%s unit=%s near_clip_value=%f", c->mapping, v->unit[0] != '\0' ? v->unit : NULL,
         c->reversed     ? 1.0
         : c->ndc_signed ? -1.0
                         : 0.0);
    values_under(v, "%szbuffer_params.", under);
    want(v, "x=%f y=%f z=%f w=%f", p[0], p[1], p[2], p[3]);
    values_under(v, "%sprojection_params.", under);
    want(v, "x=%f y=%f z=%f w=%f", 1.0, fl(c->n), fl(c->f), fl(1 / (long double)c->f));
}

/* The frustum at depth 1 and at near, by the camera of the library, whose half extents have an oracle of their own. */
static void want_corners(values *v, const camera *c, const char *under) {
    static const char *const names[] = {"top left", "top right", "bottom left", "bottom right"};
    values_under(v, "%s", under);
    if (c->ortho) {
        want(v, "fov=%f aspect=%f to_right=%f to_top=%f", NAN, NAN, NAN, NAN);
        return;
    }
    const texture_camera t =
        view_camera("fp32", DP_MAPPING_D3D, c->n, c->f, false, (uint32_t)c->width, (uint32_t)c->height, c->fov);
    assert_relative(t.half[1], tan(c->fov * 3.14159265358979323846 / 360), 1e-15);
    want(v, "fov=%f aspect=%f", c->fov, c->width / c->height);
    want(v, "to_right=%f to_top=%f", t.half[0] * c->n, t.half[1] * c->n);
    for (int i = 0; i < 4; i++) {
        values_under(v, "%scorners[%d].", under, i);
        want(v, "name=%s", names[i]);
        want(v, "x=%f y=%f z=%f", i % 2 == 0 ? -t.half[0] : t.half[0], i < 2 ? t.half[1] : -t.half[1], 1.0);
    }
}

static dp_setup setup_for(const camera *c) {
    dp_spec spec = dp_spec_default();
    dp_setup setup;
    spec.znear = c->n;
    spec.zfar = c->f;
    spec.ortho = c->ortho;
    assert_int_equal(dp_mapping_parse(c->mapping, &spec.mapping), DP_OK);
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    return setup;
}

/* @return how many traps there are */
static size_t want_traps(values *v, const camera *c, const char *under) {
    const dp_setup setup = setup_for(c);
    const double half = c->ortho ? 5 : tan(c->fov * 3.14159265358979323846 / 360);
    size_t count = 0;
    for (size_t i = 0; trap_get(i) != NULL; i++) {
        const trap_row *t = trap_get(i);
        if (isnan(trap_reads(t, &setup, half, c->z[0])))
            continue;
        values_under(v, "%straps[%zu].", under, count);
        want(v, "name=%s formula=%s right=%s source=%s", t->name, t->note, t->right, t->source);
        for (int k = 0; k < DEPTHS; k++) {
            const double reads = trap_reads(t, &setup, half, c->z[k]);
            values_under(v, "%straps[%zu].rows[%d].", under, count, k);
            want(v, "z=%f reads=%f relative=%f", c->z[k], reads, (reads - c->z[k]) / c->z[k]);
        }
        count++;
    }
    return count;
}

static void want_rows(values *v, const camera *c, const char *under) {
    for (int k = 0; k < DEPTHS; k++) {
        const made m = made_of(c, c->z[k]);
        values_under(v, "%srows[%d].", under, k);
        want(v, "z=%f clip_z=%f clip_w=%f", c->z[k], m.clip_z, m.clip_w);
        want(v, "ndc=%f window=%f eye=%f", m.ndc, m.window, m.eye);
        want(v, "linear01=%f from_near=%f", m.linear01, m.from_near);
        want(v, "d16=%f d24=%f depth_normals=%f", m.d16, m.d24, m.depth_normals);
    }
}

TEST(each_number) {
    for (size_t i = 0; i < LINES; i++) {
        values v = values_of(lines[i]);
        for (size_t k = 0; k < CAMERAS; k++) {
            const camera c = camera_of(lines[i], k);
            char under[PATH_SIZE];
            snprintf(under, sizeof under, "setups[%zu].", k);
            want_camera(&v, &c, under);
            want_corners(&v, &c, under);
            want_rows(&v, &c, under);
            const size_t traps = want_traps(&v, &c, under);
            assert_int_equal(traps, c.n <= 0     ? 0
                                    : c.ortho    ? 1
                                    : c.infinite ? (c.reversed ? 3 : 5)
                                    : c.reversed ? 6
                                                 : 9 + c.ndc_signed);
        }
        check_forms(&v, 0, lines[i], "setups[].rows[]",
                    "near [scene] = ^near, far [scene] = ^far, projection = ^projection, mapping = ^mapping, "
                    "z [scene], clip_z [scene], clip_w [scene], ndc, window, eye [scene], linear01, from_near, "
                    "d16 [scene], d24 [scene], depth_normals [scene]");
        values_free(&v);
    }
}

/* ---- Text -------------------------------------------------------------------------------------------------------- */

/* The rows below a line, columns with their digits. @return what follows */
static const char *check_rows(const json_t *setup, const char *at, const char *columns) {
    assert_non_null(at);
    for (int d = 0; d < DEPTHS; d++) {
        int used = 0, digits;
        char name[32], word[32];
        at = strchr(at, '\n') + 1;
        for (const char *c = columns; sscanf(c, " %31[^:]:%d%n", name, &digits, &used) == 2; c += used) {
            const double want = number_at(setup, "rows[%d].%s", d, name);
            int length = 0;
            assert_int_equal(sscanf(at, " %31s%n", word, &length), 1);
            at += length;
            if (isnan(want)) /* null: undefined or infinite */
                assert_true(strcmp(word, "-") == 0 || strcmp(word, "inf") == 0);
            else
                assert_true(fabs(strtod(word, NULL) - want) <= 5.001 * pow(10, -digits) * fabs(want));
        }
    }
    return at;
}

/* Each row of depths, and of traps, by the numbers that JSON has. */
TEST(text_is_the_same) {
    for (size_t i = 0; i < LINES; i++) {
        json_t *root = json_printed(0, "%s", lines[i]);
        char *text = output_of(0, lines[i], "--full");
        const char *at = text;
        for (size_t k = 0; k < CAMERAS; k++) {
            const json_t *setup = node_at(root, "setups[%zu]", k);
            at = check_rows(setup, strstr(at, "from near\n"),
                            "z:6 clip_z:6 clip_w:6 ndc:6 window:6 eye:6 linear01:5 "
                            "from_near:5");
            at = check_rows(setup, strstr(at, "DepthNormals\n"), "z:6 d16:7 d24:7 eye:7 depth_normals:7");
            for (size_t t = 0; t < json_array_size(node_at(setup, "traps")); t++) {
                at = strstr(at, text_at(setup, "traps[%zu].name", t));
                assert_non_null(at);
                assert_non_null(strstr(at, text_at(setup, "traps[%zu].right", t)));
                at = strstr(at, "off by %\n");
                assert_non_null(at);
                for (int d = 0; d < DEPTHS; d++) {
                    double z, reads, percent;
                    at = strchr(at, '\n') + 1;
                    assert_int_equal(sscanf(at, "%lf %lf %lf", &z, &reads, &percent), 3);
                    const double want[] = {number_at(setup, "traps[%zu].rows[%d].reads", t, d),
                                           number_at(setup, "traps[%zu].rows[%d].relative", t, d)};
                    assert_relative(z, number_at(setup, "rows[%d].z", d), 1e-9);
                    assert_true(isnan(want[0]) ? isinf(reads) : fabs(reads - want[0]) <= 0.5001e-5 * fabs(want[0]));
                    assert_true(isnan(want[1]) ? isinf(percent)
                                               : fabs(percent / 100 - want[1]) <= 0.5001e-2 * fabs(want[1]));
                }
            }
        }
        free(text);
        json_decref(root);
    }
}

/* Both vectors to nine digits, and the half extents to six. */
TEST(text_of_the_camera) {
    check_says_all(0, "table --constants -n 0.3 -f 1000 -m gl --at 10 --viewport 1920x1080",
                   SAID("_ZBufferParams          -3332.33325, 3333.33325, -3.33233333, 3.33333325\n",
                        "_ProjectionParams       1, 0.300000012, 1000, 0.00100000005\n", "UNITY_NEAR_CLIP_VALUE   -1\n",
                        "corner rays             1.0264 to the left and right, 0.57735 down and up",
                        "toRight 0.30792, toTop 0.173205", "!Without", "!orthographic", "!inf"));
}

/* Only the far plane wraps: a 0 near the camera is rounded. */
TEST(wraps_are_told) {
    check_says_all(0, "table --constants -m d3d --at 1,1000",
                   SAID("0: EncodeFloatRG makes the camera of the far plane"));
    check_says_all(0, "table --constants -n 1e-3 -f 1e5 -m d3d --at 0.001,99000", SAID("!EncodeFloatRG"));
}

/* Nothing infinite or not defined is there without a word, and no text holds a NaN. */
TEST(infinities_are_told) {
    check_says_all(0, "table --constants -f inf -m d3d --at 1,1e7",
                   SAID("-inf, inf, ", "x and y are infinite, and a shader", "gets NaN.",
                        "inf: what is divided by is 0 in binary32", "!nan"));
    check_says_all(0, "table --constants -f inf -m reversed --at 1,1e3",
                   SAID("x is infinite, and a shader gets 0", "!x and y", "!inf: ", "!nan"));
    check_says_all(0, "table --constants -n 1e-3 -f 1e5 -m d3d --at 1e5", SAID("inf: what is divided by", "!Without"));
    check_says_all(0, "table --constants --ortho -n 0 -m d3d",
                   SAID("LinearDepthToEyeDepth", "near 0 makes its constants infinite", "!corner", "!perspective-of"));
    check_says_all(0, "table --constants --ortho -n -1 -m d3d", SAID("near must be above 0", "!perspective-of"));
    check_says_all(0, "table --constants --ortho -m d3d", SAID("perspective-of-ortho", "!above 0", "!near 0 "));
    printed p = print_of("table --constants -n 1e-3 -f 1e5 -m d3d,reversed --at 1e5"); /* each of its own alone */
    assert_non_null(strstr(p.out, "inf: "));
    assert_null(strstr(strstr(p.out, "\nreversed, "), "inf: "));
    printed_free(&p);
}

/* The field of view and the shape of the view: given, a preset's, each its own. */
TEST(views) {
    json_t *root = json_printed(0, "table --constants --hfov 90 --viewport 100x200 -m d3d");
    assert_relative(number_at(root, "setups[0].corners[3].x"), 1, 1e-14);
    assert_relative(number_at(root, "setups[0].corners[3].y"), -2, 1e-14);
    json_decref(root);
    root = json_printed(0, "table --constants --preset unity,godot-forward,three --at 10m --viewport 1000x1000");
    static const double fovs[] = {60, 75, 50}; /* in a view as wide as high */
    assert_int_equal(json_array_size(node_at(root, "setups")), 3);
    for (int i = 0; i < 3; i++) {
        assert_relative(number_at(root, "setups[%d].fov", i), fovs[i], 1e-12);
        assert_relative(number_at(root, "setups[%d].aspect", i), 1, 1e-12);
    }
    json_decref(root);
    root = json_printed(0, "table --constants --preset unity,three --at 10m --fov 40");
    assert_relative(number_at(root, "setups[1].fov"), 40, 1e-12);
    assert_relative(number_at(root, "setups[1].aspect"), 1920.0 / 1080, 1e-12);
    json_decref(root);
    root = json_printed(0, "table --constants -n 0.1 -f 1000"); /* five depths of either mapping, not one a format */
    assert_int_equal(json_array_size(node_at(root, "setups")), 2);
    assert_int_equal(json_array_size(node_at(root, "setups[1].rows")), 5);
    json_decref(root);
}

TEST(refusals) {
    static const refused_row rows[] = {
        {"-m log", "--mapping: must be one of d3d, gl, reversed, gl-reversed with --constants, got log", 0},
        {"-m d3d,linear", "got linear, whose depth no projection matrix makes", 0},
        {"-F d24", "--format: does not apply with --constants", 0},
        {"--depth 0.5", "--depth: does not apply with --constants", 0},
        {"--range 1:2", "--range: does not apply with --constants, only to the table of depths", 0},
        {"--ortho --fov 50", "--fov: conflicts with --ortho", 0},
        {"--ortho --viewport 5x5", "--viewport: conflicts with --ortho", 0},
        {"--fov 50 --hfov 50", "--hfov: conflicts with --fov", 0},
        {"--hfov 0.01 --viewport 9000x10", "must be from 0.001 to 179.9", 0},
        {"--hfov 0.05 --viewport 100x10", "table: the vertical field of view must be from 0.01", 0},
        {"-f inf --at 1e39", "depths in binary32 must be at most 3.4028235e+38", 0},
        {"--at 5000", "--at: depths must lie in [near, far]", 0},
    };
    CHECK_REFUSED("table --constants", rows);
}

/* The words of shaders lead there. */
TEST(words_lead_there) {
    static const char *const words[] = {"_ZBufferParams", "_ProjectionParams", "lineareyedepth"};
    static const char *const used[] = {"_ZBufferParams.z", "_ZBufferParams[2]", "LinearEyeDepth(d)"};
    for (size_t i = 0; i < sizeof used / sizeof used[0]; i++)
        check_says(0, "depthprec table --constants", "help '%s'", used[i]);
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        check_says(0, "depthprec table --constants", "help %s", words[i]);
        check_says(0, "depthprec table --constants", "list %s", words[i]);
    }
    check_says(2, "lists the commands", "LinearEyeDepth"); /* no command, and no slip of one */
    printed p = print_of("list constants --full");
    for (size_t i = 0; constant_get(i) != NULL; i++) {
        assert_non_null(strstr(p.out, constant_get(i)->name));
        assert_non_null(strstr(p.out, constant_get(i)->note));
    }
    printed_free(&p);
}

LIST_TEST(check_apart)
