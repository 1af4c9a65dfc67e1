/* SPDX-License-Identifier: GPL-3.0-or-later */
/* scene from an eye: what is printed, against formulas of the test and the library; what cannot be an eye. */
#include "printed.h"

#define STREET "tests/models/street.obj --separation 0.02"

static const json_t *finding_of(const json_t *root, const char *node) {
    const json_t *list = node_at(root, "findings");
    for (size_t i = 0; i < json_array_size(list); i++) {
        const json_t *f = json_array_get(list, i);
        if (strcmp(text_at(f, "a.node"), node) == 0)
            return f;
    }
    fail_msg("no finding of %s", node);
    return NULL;
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

/* How far apart surfaces must be, all slants, in triangles of the default class and larger. */
static double bound_of(const char *format, double lo, double hi, double zfar, bool facing) {
    dp_triangles t = dp_triangles_default();
    dp_separation_worst worst = {0};
    t.depth = facing ? 1 : 8;
    t.slim = facing ? 2 : 200;
    t.slant_hi = facing ? 0 : 90;
    const dp_setup setup = SETUP(format, .zfar = zfar, .model = DP_MODEL_FLOAT, .triangles = t);
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
        json_t *root = json_of(p.out);
        const bool passed =
            !flag_at(finding_of(root, "road"), "fights") && !flag_at(finding_of(root, "wall"), "fights");
        assert_int_equal(node_at(root, "passed") != NULL, rows[i].within > 0);
        assert_true(rows[i].within == 0 || flag_at(root, "passed") == passed);
        assert_int_equal(p.status, rows[i].within > 0 && !passed);
        printed_free(&p);
        const json_t *f = finding_of(root, "road"), *from = node_at(f, "fights_from");
        assert_relative(number_at(f, "seen_from"), depth[0], 1e-9);
        assert_relative(number_at(f, "seen_to"), depth[1], 1e-9);
        assert_int_equal(json_is_number(from), must);
        told[must]++;
        if (must) {
            const double to = fmin(depth[1], nearer_than), lift = number_at(f, "lift");
            assert_true(json_number_value(from) >= number_at(f, "seen_from") &&
                        json_number_value(from) < number_at(f, "seen_to"));
            if (to < depth[0])
                assert_true(lift == 0);
            else
                assert_true(lift + 0x1p-6 >= bound_of(rows[i].format, depth[0], to, 1000, true));
        }
        assert_true(json_is_true(node_at(f, "covered")) && json_is_null(node_at(f, "line")));
        assert_int_equal(json_is_true(node_at(f, "fights")), must && json_number_value(from) < nearer_than);
        for (int k = 0; k < 3; k++) {
            static const char *const axes[] = {"x", "y", "z"};
            const double length = sqrt(pow(at[0] - e[0], 2) + pow(at[1] - e[1], 2) + pow(at[2] - e[2], 2));
            const json_t *eyes = node_at(root, "eyes");
            assert_true(number_at(eyes, "from.%s", axes[k]) == e[k]);
            assert_true(fabs(number_at(eyes, "ahead.%s", axes[k]) - (at[k] - e[k]) / length) < 1e-15);
        }
        assert_true(number_at(root, "eyes.places") == 1 && number_at(root, "triangles.width") == 1920);
        json_decref(root);
    }
    assert_true(told[0] > 0 && told[1] > 0);
}

/* A pair that only a cut road would tell apart comes before what is told apart, however close that is; and is
 * counted. */
TEST(what_comes_first) {
    const char *eye = "--separation 0.02 --eye 0,1.7,2 --look 0,0,-10";
    char line[256];
    const char *path =
        scratch_text("order.obj", "%s",
                     "o road\nv -8 0 -8\nv 8 0 -8\nv 8 0 8\nv -8 0 8\nf 4 3 2 1\n" /* also behind the eye */
                     "o paint\nv -1 0.002 -4\nv 1 0.002 -4\nv 1 0.002 4\nv -1 0.002 4\nf 8 7 6 5\n"
                     "o wall\nv -1 0.5 -7\nv 1 0.5 -7\nv 1 1.5 -7\nv -1 1.5 -7\nf 9 10 11 12\n"
                     "o sign\nv -0.5 0.7 -6.999\nv 0.5 0.7 -6.999\nv 0.5 1.2 -6.999\nf 13 14 15\n");
    snprintf(line, sizeof line, "scene %s %s", path, eye);
    json_t *root = json_printed(0, "%s", line);
    const json_t *list = node_at(root, "findings");
    assert_int_equal(json_array_size(list), 2);
    assert_ptr_equal(json_array_get(list, 0), finding_of(root, "road"));
    assert_true(json_is_false(json_object_get(json_array_get(list, 0), "covered")));
    assert_true(json_is_true(json_object_get(json_array_get(list, 1), "covered")));
    assert_true(json_is_number(json_object_get(json_array_get(list, 1), "seen_from")));
    assert_true(number_at(json_array_get(list, 1), "certain_to") < number_at(json_array_get(list, 0), "certain_to"));
    json_decref(root);
    check_says_all(
        0, line,
        SAID("2 visible, none may z-fight.\n1 more is resolved only", "  1   'road' and 'paint'\n", "!'wall'"));
}

/* Two parts of one surface, the nearer one first or last: the distance that mends it is that of the farther one. */
TEST(lift_of_parts) {
    static const char *const parts[] = {"v -1 1 -190\nv 1 1 -190\nv 0 2 -190\nf -3 -2 -1\n",
                                        "v -1 -2 -9\nv 1 -2 -9\nv 0 -1 -9\nf -3 -2 -1\n"};
    for (int first = 0; first < 2; first++) {
        char text[512], line[256];
        snprintf(text, sizeof text,
                 "o far\nv -2 0 -190.0625\nv 2 0 -190.0625\nv 0 4 -190.0625\nf -3 -2 -1\n"
                 "v -2 -3 -9.0625\nv 2 -3 -9.0625\nv 0 1 -9.0625\nf -3 -2 -1\no near\n%s%s",
                 parts[first], parts[1 - first]);
        const char *path = scratch_text("parts.obj", "%s", text);
        snprintf(line, sizeof line, "scene %s --separation 0.1 -F d16 -m d3d --eye 0,0,0 --look 0,0,-1", path);
        json_t *root = json_printed(0, "%s", line);
        const json_t *f = node_at(root, "findings[0]");
        assert_int_equal(json_array_size(node_at(root, "findings")), 1);
        assert_relative(number_at(f, "seen_from"), 9, 1e-9);
        assert_true(number_at(f, "lift") + 0x1p-4 >= bound_of("unorm16", 190, 190.0625, 1000, true));
        json_decref(root);
    }
}

/* The sign, not in view; what hides behind the eye; text and CSV. */
TEST(forms) {
    char want[128];
    json_t *root = json_printed(0, "scene " STREET " -m d3d -F d16 --eye 0,4,20 --look 0,0,0");
    const json_t *sign = finding_of(root, "wall"), *paint = finding_of(root, "road");
    assert_ptr_equal(node_at(root, "findings[0]"), paint); /* what is seen comes first */
    assert_true(json_is_null(node_at(sign, "seen_from")) && json_is_null(node_at(sign, "seen_to")));
    assert_true(json_is_false(node_at(sign, "fights")) && json_is_true(node_at(paint, "fights")));
    assert_true(json_is_true(node_at(sign, "covered")) && node_at(root, "passed") == NULL);
    printed p = print_of("scene " STREET " -m d3d -F d16 --eye 0,4,20 --look 0,0,0");
    assert_int_equal(p.status, 0);
    assert_non_null(strstr(p.out, "from 0 4 20, looking along 0 -0.1961 -0.9806\n"));
    assert_non_null(strstr(p.out, "within 0.02 of each other: 1 visible, 1 may z-fight.\n"));
    snprintf(want, sizeof want, "      seen from %.2f to %.2f: may z-fight; ",
             floor(number_at(paint, "seen_from") * 100) / 100, ceil(number_at(paint, "seen_to") * 100) / 100);
    if (strstr(p.out, want) == NULL)
        fail_msg("no '%s' in %s", want, p.out);
    assert_null(strstr(p.out, "'wall'"));
    printed_free(&p);
    p = print_of("scene " STREET " -m d3d -F d16 --eye 0,4,20 --look 0,0,0 --csv");
    snprintf(want, sizeof want, ",true,%.17g,%.17g,", number_at(paint, "seen_from"), number_at(paint, "seen_to"));
    char *line = strstr(p.out, "\nroad,");
    assert_non_null(line);
    line = strstr(line, ",true,");
    double a, b, c;
    assert_non_null(line);
    assert_int_equal(sscanf(line, ",true,%lf,%lf,%lf,true", &a, &b, &c), 3);
    assert_true(a == number_at(paint, "seen_from") && b == number_at(paint, "seen_to") &&
                c == number_at(paint, "fights_from"));
    assert_non_null(strstr(p.out, ",fights,seen_from [scene],seen_to [scene],fights_from [scene],covered,line"));
    printed_free(&p);
    json_decref(root);
    /* above the road, whose corners lie behind the eye */
    check_says_all(0, "scene " STREET " --eye 0,1.7,2 --look 0,0,-10",
                   SAID("1 visible, none may z-fight.\n1 more is resolved only if cut into the triangles above.\n",
                        ": resolved only if cut into the triangles"));
    check_says(0, "1 visible, none may z-fight.\n1 more is resolved only facing the camera.\n",
               "scene " STREET " --eye 0,4,20 --look 0,0,0 -m log");
}

/* ---- Several ----------------------------------------------------------------------------------------------------- */

TEST(path) {
    const char *name =
        scratch_text("walk.txt", "# a walk\n0 4 90 0 0 0\r\n\n0,4,20, 0,0,0 # near\n 21.5 2 9 21.5 2 0\n0 4 40 0 0 0");
    char line[1024];
    snprintf(line, sizeof line, "scene " STREET " -m d3d -F d16 --within 25 --path %s", name);
    json_t *root = json_printed(1, "%s", line);
    const json_t *paint = finding_of(root, "road"), *sign = finding_of(root, "wall");
    double depth[2];
    paint_depths((const double[]){0, 4, 20}, (const double[]){0, 0, 0}, depth);
    assert_true(number_at(paint, "line") == 4 && number_at(sign, "line") == 5);
    assert_relative(number_at(paint, "seen_from"), depth[0], 1e-9);
    assert_relative(number_at(sign, "seen_to"), 9, 1e-9);
    assert_relative(number_at(sign, "seen_from"), 9 - 0x1p-10, 1e-9);
    assert_true(number_at(root, "eyes.places") == 4);
    assert_string_equal(text_at(root, "eyes.path"), name);
    json_decref(root);
    check_says_all(1, line, SAID("from the worst of the 4 eyes of ", ": may z-fight, worst at line 5; "));
}

TEST(damaged_paths) {
    static const struct {
        const char *text, *said;
    } rows[] = {{"", "has no line of six numbers"},
                {"# nothing\n\n", "has no line of six numbers"},
                {"1 2 3 4 5 6\n1 2 3 4 5\n", "line 2: must be six numbers, the eye and the point it looks at, got 5"},
                {"1 2 3 4 5 6 7\n", "line 1: must be six numbers, the eye and the point it looks at, got 7"},
                {"\n\n1 2 x\033 4 5 6\n", "line 3: must be numbers from -1e12 to 1e12, got 'x?'"},
                {"1 2 3 4 5 nan\n", "line 1: must be numbers from -1e12 to 1e12, got 'nan'"},
                {"1 2 3 4 5 2e12\n", "line 1: must be numbers from -1e12 to 1e12, got '2e12'"},
                {"1 2 3 1 2 3\n", "line 1: must look at a point other than the eye"}};
    const char *name = scratch_file("bad.txt");
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        char line[640];
        scratch_text("bad.txt", "%s", rows[i].text);
        snprintf(line, sizeof line, "scene " STREET " --path %s", name);
        check_says_all(2, line, SAID("--path: ", rows[i].said));
    }
    FILE *out = fopen(name, "w");
    assert_non_null(out);
    for (int i = 0; i <= 1 << 16; i++)
        fputs("0 0 1 0 0 0\n", out);
    assert_int_equal(fclose(out), 0);
    check_says(2, "line 65537: must be at most 65536 eyes", "scene " STREET " --path %s", name);
    check_says(2, "must be at most 8388608 bytes", "scene " STREET " --path /dev/zero");
    check_says(3, "No such file", "scene " STREET " --path %s.none", name);
    scratch_text("bad.txt", "-1e12 1e12 0 1e12 0 -1e12\n");
    check_says(0, "from -1e+12 1e+12 0, looking along", "scene " STREET " --path %s", name);
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
                {"--camera Door --hfov 90 --viewport 900x900", 0.25, 500, 90}, /* as wide as high */
                {"--camera Door --preset three", 0.1, 2000, 50},
                {"--camera Odd --fov 70 -f 99", 0.25, 99, 70}};
    static const refused_row wrong[] = {
        {"--camera door", "--camera: must be Door, Plan, 3 or Odd, got 'door'; did you mean 'Door'?", 2},
        {"--camera Plan", "--camera: must be a perspective one, and 'Plan' is orthographic", 2},
        {"--camera Odd", "--camera: 'Odd' has a vertical field of view of 180 degrees", 2},
        {"--camera Door --near 0.1 --eye 1,2,3 --look 0,0,0", "--camera: conflicts with --eye", 2}};
    const char *name = scratch_text("cameras.gltf", "%s", cameras);
    char line[1024];
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        snprintf(line, sizeof line, "scene %s %s", name, rows[i].options);
        json_t *root = json_printed(0, "%s", line);
        assert_true(number_at(root, "setup.near") == rows[i].znear && number_at(root, "setup.far") == rows[i].zfar);
        assert_relative(number_at(root, "triangles.fov"), rows[i].fov, 1e-14);
        const json_t *eyes = node_at(root, "eyes");
        if (strstr(line, "Door") != NULL) {
            assert_true(number_at(eyes, "from.x") == 1 && number_at(eyes, "from.y") == 2 &&
                        number_at(eyes, "from.z") == 3);
            assert_true(fabs(number_at(eyes, "ahead.x") + 1) < 1e-15);
            assert_string_equal(text_at(eyes, "camera"), "Door");
        }
        json_decref(root);
    }
    snprintf(line, sizeof line, "scene %s", name);
    CHECK_REFUSED(line, wrong);
    check_says(0, "near 0.25, far 500,", "%s --camera Door", line);
    check_says(0, "from camera 'Door' at 1 2 3, looking along -1 ", "%s --camera Door", line);
}

TEST(refused) {
    static const refused_row rows[] = {
        {"--eye 1,2,3", "--eye: needs --look", 2},
        {"--look 1,2,3", "--look: needs --eye", 2},
        {"--eye 1,2,3 --look 1,2,3", "--look: must differ from --eye; both are 1,2,3", 2},
        {"--eye 1,2 --look 1,2,3", "--eye: must be X,Y,Z, each from -1e12 to 1e12, got '1,2'", 2},
        {"--eye 1,2,3 --look 0,0,0 --path x", "--path: conflicts with --eye", 2},
        {"--camera A --path x", "--path: conflicts with --camera", 2},
        {"--camera A", "--camera: tests/models/street.obj has no camera, got 'A'", 2},
        {"--eye 1,2,3 --look 0,0,0 --slant 0:40", "--slant: does not apply from an eye", 2}};
    CHECK_REFUSED("scene " STREET, rows);
}
