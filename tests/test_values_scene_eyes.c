/* SPDX-License-Identifier: GPL-3.0-or-later */
/* scene from an eye: what is printed, against formulas of the test and the library; what cannot be an eye. */
#include <jansson.h>

#include "depthprec/depthprec.h"
#include "printed.h"

#define STREET "tests/models/street.obj --separation 0.02"

static double number(const json_t *object, const char *key) {
    const json_t *value = json_object_get(object, key);
    assert_true(json_is_number(value));
    return json_number_value(value);
}

static double part(const json_t *object, const char *of, const char *key) {
    return number(json_object_get(object, of), key);
}

static json_t *object_of(int status, const char *arguments) {
    char *text = output_of(status, arguments, "--json");
    json_t *root = json_loads(text, 0, NULL);
    assert_non_null(root);
    free(text);
    return root;
}

static const json_t *finding_of(const json_t *root, const char *node) {
    const json_t *list = json_object_get(root, "findings");
    for (size_t i = 0; i < json_array_size(list); i++) {
        const json_t *f = json_array_get(list, i);
        if (strcmp(json_string_value(json_object_get(json_object_get(f, "a"), "node")), node) == 0)
            return f;
    }
    fail_msg("no finding of %s", node);
    return NULL;
}

static void write_file(const char *path, const char *text) {
    FILE *out = fopen(path, "w");
    assert_non_null(out);
    fputs(text, out);
    assert_int_equal(fclose(out), 0);
}

/* ---- One eye ----------------------------------------------------------------------------------------------------- */

/* Depths of the paint, all of which is in view: from the eye to corners of it and of the road below it. */
static void paint_depths(const double eye[3], const double at[3], double depth[2]) {
    double ahead[3], length = 0;
    for (int k = 0; k < 3; k++) {
        ahead[k] = at[k] - eye[k];
        length += ahead[k] * ahead[k];
    }
    depth[0] = HUGE_VAL;
    depth[1] = -HUGE_VAL;
    for (int c = 0; c < 8; c++) {
        const double corner[3] = {c & 1 ? 1 : -1, c & 2 ? 0x1p-6 : 0, c & 4 ? 4 : -4};
        double z = 0;
        for (int k = 0; k < 3; k++)
            z += (corner[k] - eye[k]) * ahead[k] / sqrt(length);
        depth[0] = fmin(depth[0], z);
        depth[1] = fmax(depth[1], z);
    }
}

/* Of triangles of the default class and larger: how far apart surfaces must be, all slants. */
static double bound_of(const char *format, double lo, double hi, double zfar, bool facing) {
    dp_spec spec = dp_spec_default();
    dp_format found[2];
    dp_setup setup;
    dp_separation_worst worst = {0};
    assert_int_equal(dp_format_parse(format, found), 1);
    spec.format = found[0];
    spec.model = DP_MODEL_FLOAT;
    spec.zfar = zfar;
    spec.triangles = dp_triangles_default();
    spec.triangles.depth = facing ? 1 : 8;
    spec.triangles.slim = facing ? 2 : 200;
    spec.triangles.slant_hi = facing ? 0 : 90;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    assert_int_equal(dp_separation_over(&setup, lo, hi, 0, &worst), DP_OK);
    return facing ? worst.separation : worst.bound;
}

TEST(one_eye) {
    static const struct {
        double eye[3], at[3];
        const char *more, *format;
        double within;
    } rows[] = {{{0, 4, 20}, {0, 0, 0}, "", "unorm24", 0},
                {{3, 8, 27}, {0, 0, 1}, " --within 30", "unorm24", 30},
                {{3, 9, 70}, {0, 0, 1}, " --within 300", "unorm16", 300},
                {{30, 40, -10}, {1, 0, 2}, " --within 20", "unorm16", 20}};
    size_t told[2] = {0};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const double *e = rows[i].eye, *at = rows[i].at;
        double depth[2];
        char line[256];
        paint_depths(e, at, depth);
        snprintf(line, sizeof line, "scene " STREET " -m d3d -F %s --eye %g,%g,%g --look %g,%g,%g%s", rows[i].format,
                 e[0], e[1], e[2], at[0], at[1], at[2], rows[i].more);
        const double nearer_than = rows[i].within > 0 ? rows[i].within : HUGE_VAL;
        const bool must = bound_of(rows[i].format, depth[0], depth[1], 1000, true) > 0x1p-6;
        const bool may = bound_of(rows[i].format, depth[0], depth[1], 1000, false) > 0x1p-6;
        assert_true(must == may); /* else nothing is known here */
        printed p = print_of("%s --json", line);
        json_t *root = json_loads(p.out, 0, NULL);
        assert_non_null(root);
        const bool passed = !json_is_true(json_object_get(finding_of(root, "road"), "fights")) &&
                            !json_is_true(json_object_get(finding_of(root, "wall"), "fights"));
        assert_int_equal(json_is_true(json_object_get(root, "passed")), passed && rows[i].within > 0);
        assert_int_equal(json_is_false(json_object_get(root, "passed")), !passed && rows[i].within > 0);
        assert_int_equal(p.status, rows[i].within > 0 && !passed);
        printed_free(&p);
        const json_t *f = finding_of(root, "road"), *from = json_object_get(f, "fights_from");
        assert_relative(number(f, "seen_from"), depth[0], 1e-9);
        assert_relative(number(f, "seen_to"), depth[1], 1e-9);
        assert_int_equal(json_is_number(from), must);
        told[must]++;
        if (must) {
            const double to = fmin(depth[1], nearer_than), lift = number(f, "lift");
            assert_true(json_number_value(from) >= number(f, "seen_from") &&
                        json_number_value(from) < number(f, "seen_to"));
            if (to < depth[0])
                assert_true(lift == 0);
            else
                assert_true(lift + 0x1p-6 >= bound_of(rows[i].format, depth[0], to, 1000, true));
        }
        assert_true(json_is_true(json_object_get(f, "covered")) && json_is_null(json_object_get(f, "line")));
        assert_int_equal(json_is_true(json_object_get(f, "fights")), must && json_number_value(from) < nearer_than);
        for (int k = 0; k < 3; k++) {
            static const char *const axes[] = {"x", "y", "z"};
            const double length = sqrt(pow(at[0] - e[0], 2) + pow(at[1] - e[1], 2) + pow(at[2] - e[2], 2));
            const json_t *eyes = json_object_get(root, "eyes");
            assert_true(part(eyes, "from", axes[k]) == e[k]);
            assert_true(fabs(part(eyes, "ahead", axes[k]) - (at[k] - e[k]) / length) < 1e-15);
        }
        assert_true(part(root, "eyes", "places") == 1 && part(root, "triangles", "width") == 1920);
        json_decref(root);
    }
    assert_true(told[0] > 0 && told[1] > 0);
}

/* What only a cut road would tell apart comes before what is told apart, however close that is; and is counted. */
TEST(what_comes_first) {
    const char *path = scratch_file("order.obj");
    const char *eye = "--separation 0.02 --eye 0,1.7,2 --look 0,0,-10";
    char line[256];
    write_file(path, "o road\nv -8 0 -8\nv 8 0 -8\nv 8 0 8\nv -8 0 8\nf 4 3 2 1\n" /* also behind the eye */
                     "o paint\nv -1 0.002 -4\nv 1 0.002 -4\nv 1 0.002 4\nv -1 0.002 4\nf 8 7 6 5\n"
                     "o wall\nv -1 0.5 -7\nv 1 0.5 -7\nv 1 1.5 -7\nv -1 1.5 -7\nf 9 10 11 12\n"
                     "o sign\nv -0.5 0.7 -6.999\nv 0.5 0.7 -6.999\nv 0.5 1.2 -6.999\nf 13 14 15\n");
    snprintf(line, sizeof line, "scene %s %s", path, eye);
    json_t *root = object_of(0, line);
    const json_t *list = json_object_get(root, "findings");
    assert_int_equal(json_array_size(list), 2);
    assert_ptr_equal(json_array_get(list, 0), finding_of(root, "road"));
    assert_true(json_is_false(json_object_get(json_array_get(list, 0), "covered")));
    assert_true(json_is_true(json_object_get(json_array_get(list, 1), "covered")));
    assert_true(json_is_number(json_object_get(json_array_get(list, 1), "seen_from")));
    assert_true(number(json_array_get(list, 1), "certain_to") < number(json_array_get(list, 0), "certain_to"));
    json_decref(root);
    printed p = print_of("%s", line);
    assert_non_null(strstr(p.out, "2 seen, 0 can fight.\n1 more is told apart only"));
    assert_non_null(strstr(p.out, "  1   'road' and 'paint'\n"));
    assert_null(strstr(p.out, "'wall'"));
    printed_free(&p);
}

/* Two parts of one surface, the nearer one first or last: the distance that mends it is that of the farther one. */
TEST(lift_of_parts) {
    static const char *const parts[] = {"v -1 1 -190\nv 1 1 -190\nv 0 2 -190\nf -3 -2 -1\n",
                                        "v -1 -2 -9\nv 1 -2 -9\nv 0 -1 -9\nf -3 -2 -1\n"};
    for (int first = 0; first < 2; first++) {
        const char *path = scratch_file("parts.obj"); /* which ends with the next one */
        char text[512], line[256];
        snprintf(text, sizeof text,
                 "o far\nv -2 0 -190.0625\nv 2 0 -190.0625\nv 0 4 -190.0625\nf -3 -2 -1\n"
                 "v -2 -3 -9.0625\nv 2 -3 -9.0625\nv 0 1 -9.0625\nf -3 -2 -1\no near\n%s%s",
                 parts[first], parts[1 - first]);
        write_file(path, text);
        snprintf(line, sizeof line, "scene %s --separation 0.1 -F d16 -m d3d --eye 0,0,0 --look 0,0,-1", path);
        json_t *root = object_of(0, line);
        const json_t *f = json_array_get(json_object_get(root, "findings"), 0);
        assert_int_equal(json_array_size(json_object_get(root, "findings")), 1);
        assert_relative(number(f, "seen_from"), 9, 1e-9);
        assert_true(number(f, "lift") + 0x1p-4 >= bound_of("unorm16", 190, 190.0625, 1000, true));
        json_decref(root);
    }
}

/* The sign, not in view; what hides behind the eye; text and CSV. */
TEST(forms) {
    char want[128];
    json_t *root = object_of(0, "scene " STREET " -m d3d -F d16 --eye 0,4,20 --look 0,0,0");
    const json_t *sign = finding_of(root, "wall"), *paint = finding_of(root, "road");
    assert_ptr_equal(json_array_get(json_object_get(root, "findings"), 0), paint); /* what is seen comes first */
    assert_true(json_is_null(json_object_get(sign, "seen_from")) && json_is_null(json_object_get(sign, "seen_to")));
    assert_true(json_is_false(json_object_get(sign, "fights")) && json_is_true(json_object_get(paint, "fights")));
    assert_true(json_is_true(json_object_get(sign, "covered")) && json_object_get(root, "passed") == NULL);
    printed p = print_of("scene " STREET " -m d3d -F d16 --eye 0,4,20 --look 0,0,0");
    assert_int_equal(p.status, 0);
    assert_non_null(strstr(p.out, "from 0 4 20, looking along 0 -0.1961 -0.9806\n"));
    assert_non_null(strstr(p.out, "within 0.02 of each other: 1 seen, 1 can fight.\n"));
    snprintf(want, sizeof want, "      seen from %.2f to %.2f: can fight; ",
             floor(number(paint, "seen_from") * 100) / 100, ceil(number(paint, "seen_to") * 100) / 100);
    if (strstr(p.out, want) == NULL)
        fail_msg("no '%s' in %s", want, p.out);
    assert_null(strstr(p.out, "'wall'"));
    printed_free(&p);
    p = print_of("scene " STREET " -m d3d -F d16 --eye 0,4,20 --look 0,0,0 --csv");
    snprintf(want, sizeof want, ",true,%.17g,%.17g,", number(paint, "seen_from"), number(paint, "seen_to"));
    char *line = strstr(p.out, "\nroad,");
    assert_non_null(line);
    line = strstr(line, ",true,");
    double a, b, c;
    assert_non_null(line);
    assert_int_equal(sscanf(line, ",true,%lf,%lf,%lf,true", &a, &b, &c), 3);
    assert_true(a == number(paint, "seen_from") && b == number(paint, "seen_to") && c == number(paint, "fights_from"));
    assert_non_null(strstr(p.out, ",fights,seen_from [scene],seen_to [scene],fights_from [scene],covered,line"));
    printed_free(&p);
    json_decref(root);
    /* above the road, whose corners lie behind the eye */
    p = print_of("scene " STREET " --eye 0,1.7,2 --look 0,0,-10");
    assert_non_null(
        strstr(p.out, "1 seen, 0 can fight.\n1 more is told apart only if cut into the triangles above.\n"));
    assert_non_null(strstr(p.out, ": told apart only if cut into the triangles"));
    printed_free(&p);
    p = print_of("scene " STREET " --eye 0,4,20 --look 0,0,0 -m log");
    assert_non_null(strstr(p.out, "1 seen, 0 can fight.\n1 more is told apart only facing the camera.\n"));
    printed_free(&p);
}

/* ---- Several ----------------------------------------------------------------------------------------------------- */

TEST(path) {
    char name[512], line[1024];
    snprintf(name, sizeof name, "%s", scratch_file("walk.txt"));
    write_file(name, "# a walk\n0 4 90 0 0 0\r\n\n0,4,20, 0,0,0 # near\n 21.5 2 9 21.5 2 0\n0 4 40 0 0 0");
    snprintf(line, sizeof line, "scene " STREET " -m d3d -F d16 --within 25 --path %s", name);
    json_t *root = object_of(1, line);
    const json_t *paint = finding_of(root, "road"), *sign = finding_of(root, "wall");
    double depth[2];
    paint_depths((const double[]){0, 4, 20}, (const double[]){0, 0, 0}, depth);
    assert_true(number(paint, "line") == 4 && number(sign, "line") == 5);
    assert_relative(number(paint, "seen_from"), depth[0], 1e-9);
    assert_relative(number(sign, "seen_to"), 9, 1e-9);
    assert_relative(number(sign, "seen_from"), 9 - 0x1p-10, 1e-9);
    assert_true(part(root, "eyes", "places") == 4);
    assert_string_equal(json_string_value(json_object_get(json_object_get(root, "eyes"), "path")), name);
    json_decref(root);
    printed p = print_of("%s", line);
    assert_non_null(strstr(p.out, "from the worst of the 4 eyes of "));
    assert_non_null(strstr(p.out, ": can fight, worst at line 5; "));
    printed_free(&p);
}

TEST(damaged_paths) {
    static const struct {
        const char *text, *said;
    } rows[] = {{"", "has no line of six numbers"},
                {"# nothing\n\n", "has no line of six numbers"},
                {"1 2 3 4 5 6\n1 2 3 4 5\n", "line 2: must be six numbers, a place and the place looked at, got 5"},
                {"1 2 3 4 5 6 7\n", "line 1: must be six numbers, a place and the place looked at, got 7"},
                {"\n\n1 2 x\033 4 5 6\n", "line 3: must be numbers from -1e12 to 1e12, got 'x?'"},
                {"1 2 3 4 5 nan\n", "line 1: must be numbers from -1e12 to 1e12, got 'nan'"},
                {"1 2 3 4 5 2e12\n", "line 1: must be numbers from -1e12 to 1e12, got '2e12'"},
                {"1 2 3 1 2 3\n", "line 1: must look at another place than its own"}};
    char name[512];
    snprintf(name, sizeof name, "%s", scratch_file("bad.txt"));
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        write_file(name, rows[i].text);
        printed p = print_of("scene " STREET " --path %s", name);
        if (p.status != 2 || strstr(p.errors, "--path: ") == NULL || strstr(p.errors, rows[i].said) == NULL)
            fail_msg("%s: %d: %s", rows[i].text, p.status, p.errors);
        printed_free(&p);
    }
    FILE *out = fopen(name, "w");
    assert_non_null(out);
    for (int i = 0; i <= 1 << 16; i++)
        fputs("0 0 1 0 0 0\n", out);
    assert_int_equal(fclose(out), 0);
    printed p = print_of("scene " STREET " --path %s", name);
    assert_int_equal(p.status, 2);
    assert_non_null(strstr(p.errors, "line 65537: must be at most 65536 eyes"));
    printed_free(&p);
    p = print_of("scene " STREET " --path /dev/zero");
    assert_int_equal(p.status, 2);
    assert_non_null(strstr(p.errors, "must be at most 8388608 bytes"));
    printed_free(&p);
    p = print_of("scene " STREET " --path %s.none", name);
    assert_int_equal(p.status, 3);
    printed_free(&p);
}

/* ---- Cameras of the model ---------------------------------------------------------------------------------------- */

static const char cameras[] =
    "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0,1,2,3,4]}],\"nodes\":[{\"mesh\":0},"
    "{\"name\":\"Door\",\"camera\":0,\"translation\":[1,2,3],\"rotation\":[0,0.7071067811865476,0,0.7071067811865476]},"
    "{\"name\":\"Plan\",\"camera\":1},{\"camera\":0},{\"name\":\"Odd\",\"camera\":2}],"
    "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],"
    "\"accessors\":[{\"componentType\":5126,\"type\":\"VEC3\",\"count\":3}],"
    "\"cameras\":[{\"type\":\"perspective\",\"perspective\":{\"yfov\":0.5,\"znear\":0.25,\"zfar\":500}},"
    "{\"type\":\"orthographic\",\"orthographic\":{\"xmag\":1,\"ymag\":1,\"znear\":0,\"zfar\":9}},"
    "{\"type\":\"perspective\",\"perspective\":{\"yfov\":3.14159,\"znear\":0.25}}]}";

TEST(model_cameras) {
    static const struct {
        const char *options;
        double znear, zfar, fov;
    } rows[] = {{"--camera Door", 0.25, 500, 90 / M_PI},
                {"--camera 3", 0.25, 500, 90 / M_PI},
                {"--camera Door -f 90 --fov 40", 0.25, 90, 40},
                {"--camera Door -n 1", 1, 500, 90 / M_PI},
                {"--camera Door -n 600 -f 2000", 600, 2000, 90 / M_PI},
                {"--camera Door -n 400", 400, 500, 90 / M_PI},
                {"--camera Odd --fov 70 -f 99", 0.25, 99, 70}};
    static const struct {
        const char *name, *said;
    } wrong[] = {{"door", "--camera: must be Door, Plan, 3 or Odd, got 'door'; did you mean 'Door'?"},
                 {"Plan", "--camera: must be a perspective one, and 'Plan' is orthographic"},
                 {"Odd", "--camera: 'Odd' has a vertical field of view of 180 degrees"},
                 {"Door --near 0.1 --eye 1,2,3 --look 0,0,0", "--camera: cannot be combined with --eye"}};
    char name[512], line[1024];
    snprintf(name, sizeof name, "%s", scratch_file("cameras.gltf"));
    write_file(name, cameras);
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        snprintf(line, sizeof line, "scene %s %s", name, rows[i].options);
        json_t *root = object_of(0, line);
        assert_true(part(root, "setup", "near") == rows[i].znear && part(root, "setup", "far") == rows[i].zfar);
        assert_relative(part(root, "triangles", "fov"), rows[i].fov, 1e-14);
        const json_t *eyes = json_object_get(root, "eyes");
        if (strstr(line, "Door") != NULL) {
            assert_true(part(eyes, "from", "x") == 1 && part(eyes, "from", "y") == 2 && part(eyes, "from", "z") == 3);
            assert_true(fabs(part(eyes, "ahead", "x") + 1) < 1e-15);
            assert_string_equal(json_string_value(json_object_get(eyes, "camera")), "Door");
        }
        json_decref(root);
    }
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        printed p = print_of("scene %s --camera %s", name, wrong[i].name);
        if (p.status != 2 || strstr(p.errors, wrong[i].said) == NULL)
            fail_msg("%s: %d: %s", wrong[i].name, p.status, p.errors);
        printed_free(&p);
    }
    printed p = print_of("scene %s --camera Door", name);
    assert_non_null(strstr(p.out, "near 0.25, far 500,"));
    assert_non_null(strstr(p.out, "from camera 'Door' at 1 2 3, looking along -1 "));
    printed_free(&p);
}

TEST(refused) {
    static const struct {
        const char *options, *said;
    } rows[] = {{"--eye 1,2,3", "--eye: needs --look"},
                {"--look 1,2,3", "--look: needs --eye"},
                {"--eye 1,2,3 --look 1,2,3", "--look: must be another place than --eye, which are both 1,2,3"},
                {"--eye 1,2 --look 1,2,3", "--eye: must be X,Y,Z, each from -1e12 to 1e12, got '1,2'"},
                {"--eye 1,2,3 --look 0,0,0 --path x", "--path: cannot be combined with --eye"},
                {"--camera A --path x", "--path: cannot be combined with --camera"},
                {"--camera A", "--camera: tests/models/street.obj has no camera, got 'A'"},
                {"--eye 1,2,3 --look 0,0,0 --slant 0:40", "--slant: does not apply from an eye"}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        printed p = print_of("scene " STREET " %s", rows[i].options);
        if (p.status != 2 || strstr(p.errors, rows[i].said) == NULL)
            fail_msg("%s: %d: %s", rows[i].options, p.status, p.errors);
        printed_free(&p);
    }
}
