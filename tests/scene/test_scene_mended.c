/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * What `scene` proposes, done to the model and judged again: the distance that is enough is; and a file of requirements
 * fails where two surfaces may z-fight. Two triangles a model, in random planes, also tilted to each other, through
 * each other and slim, seen by an eye or from everywhere.
 */
#include "printed.h"

typedef struct two {
    double at[2][3][3], normal[3];
    bool halved; /* each of two triangles, the first along another line than the second */
    bool hinged; /* they cross in the line along which both are halved */
} two;

static void random_unit(rng *r, double v[3]) {
    double length;
    do {
        for (int k = 0; k < 3; k++)
            v[k] = rng_uniform(r, -1, 1);
        length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    } while (!(length > 0.1 && length <= 1));
    for (int k = 0; k < 3; k++)
        v[k] /= length;
}

static void cross(const double a[3], const double b[3], double out[3]) {
    for (int k = 0; k < 3; k++)
        out[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

/* The second lies above the first, its corners at distances of their own. */
static void make_two(rng *r, double size, double gap, double slimmest, bool hinged, two *out) {
    double other[3], u[3], v[3];
    const double slim = rng_below(r, 2) == 0 ? 1.0 : rng_log(r, slimmest, 1), turn = rng_uniform(r, 0, 6.28);
    const uint64_t kind = rng_below(r, 4); /* parallel twice, tilted, through each other */
    out->hinged = hinged;
    random_unit(r, out->normal);
    random_unit(r, other);
    cross(out->normal, other, u);
    const double length = sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
    for (int k = 0; k < 3; k++)
        u[k] /= length;
    cross(out->normal, u, v);
    for (int c = 0; c < 3; c++) {
        const double angle = turn + (c + rng_uniform(r, -0.2, 0.2)) * 2.0943951, far = size * rng_uniform(r, 0.6, 1);
        const double x = far * cos(angle), y = slim * far * sin(angle);
        const double uneven = rng_uniform(r, 0.3, 2), hinge[3] = {0, gap, -gap};
        const double above = out->hinged ? hinge[c] : kind < 2 ? gap : (kind == 3 && c == 1 ? -gap : gap) * uneven;
        for (int k = 0; k < 3; k++) {
            out->at[0][c][k] = x * u[k] + y * v[k];
            out->at[1][c][k] = x * u[k] + y * v[k] + above * out->normal[k];
        }
    }
}

static void write_two(const two *t, const double lift[2], const char *path) {
    FILE *out = fopen(path, "w");
    assert_non_null(out);
    for (int i = 0; i < 2; i++) {
        const int cut = t->hinged ? 1 : i;
        const double *from = t->at[i][cut], *to = t->at[i][cut + 1];
        double middle[3];
        for (int k = 0; k < 3; k++)
            middle[k] = 0.5 * (from[k] + to[k]);
        fprintf(out, "o %s\n", i == 0 ? "below" : "above");
        for (int c = 0; c < 4; c++) {
            const double *at = c < 3 ? t->at[i][c] : middle;
            fprintf(out, "v %.17g %.17g %.17g\n", at[0] + lift[i] * t->normal[0], at[1] + lift[i] * t->normal[1],
                    at[2] + lift[i] * t->normal[2]);
        }
        const int first = 4 * i + 1, a = first + cut, b = a + 1, c = first + (cut + 2) % 3, half = first + 3;
        if (t->halved)
            fprintf(out, "f %d %d %d\nf %d %d %d\n", a, half, c, half, b, c);
        else
            fprintf(out, "f %d %d %d\n", first, first + 1, first + 2);
    }
    assert_int_equal(fclose(out), 0);
}

typedef struct said {
    bool is_seen, fights;
    double lift, within; /* NaN: none */
    bool touches;
} said;

static double number_or_nan(const json_t *object, const char *key) {
    const json_t *value = json_object_get(object, key);
    return json_is_number(value) ? json_number_value(value) : (double)NAN;
}

/* The answer of the one finding; nothing where there is none. */
static said ask(const char *path, const char *options) {
    said s = {.lift = (double)NAN};
    printed p = print_of("scene %s --also facing,blended,hidden --json -q %s", path, options);
    if (p.status > 1)
        fail_msg("scene %s: %s", options, p.errors);
    json_t *root = json_of(p.out);
    const json_t *f = json_array_get(json_object_get(root, "findings"), 0);
    s.within = number_or_nan(root, "within");
    if (f != NULL) {
        const bool eye = strstr(options, "--eye") != NULL;
        const double from = eye ? number_or_nan(f, "fights_from") : (double)NAN;
        s.is_seen = !eye || !isnan(number_or_nan(f, "seen_from"));
        s.fights = eye ? from < s.within : json_is_true(json_object_get(f, "fights"));
        s.lift = number_or_nan(f, "lift");
        s.touches = !(number_or_nan(f, "gap_min") > 1e-12);
    }
    json_decref(root);
    printed_free(&p);
    return s;
}

/* A set-up, and an eye about the model or none. */
static void random_options(rng *r, double size, bool eye, char out[512]) {
    static const char *const cameras[] = {"-F fp32 -m reversed", "-F d24 -m d3d", "-F d16 -m d3d",
                                          "-F d24 -m reversed"};
    static const char *const rasters[] = {"", "--raster llvmpipe", "--raster swiftshader", "--raster spec-vulkan"};
    size_t used = (size_t)snprintf(out, 512, "%s -n 0.1 -f 1000", cameras[rng_below(r, 4)]);
    if (eye || rng_below(r, 2) == 0)
        used += (size_t)snprintf(out + used, 512 - used, " --viewport 1280x720 --fov %.4g %s", rng_uniform(r, 20, 90),
                                 rasters[rng_below(r, 4)]);
    if (!eye)
        return;
    double from[3];
    const double away = size * rng_log(r, 1.2, 40);
    random_unit(r, from);
    snprintf(out + used, 512 - used, " --eye=%.9g,%.9g,%.9g --look 0,0,0", away * from[0], away * from[1],
             away * from[2]);
}

/* Either is moved; where they touch, either way. */
TEST(lifts) {
    rng r = rng_make("mended models");
    tally t = {.name = "enough"}, said_some = {.name = "said"};
    for (uint64_t run = 0; run < test_cases(30, 80, 4000); run++) {
        const bool eye = run % 4 != 0;
        const double size = rng_log(&r, 0.3, 10), gap = rng_below(&r, 5) == 0 ? 0 : size * rng_log(&r, 1e-6, 1e-3);
        char options[512];
        const char *path = scratch_file("two.obj");
        two made = {0};
        make_two(&r, size, gap, 0.05, run % 3 == 0, &made);
        made.halved = made.hinged || run % 2 != 0;
        random_options(&r, size, eye, options);
        write_two(&made, (const double[2]){0, 0}, path);
        const said before = ask(path, options);
        if (!before.fights || !(before.lift > 0))
            continue;
        TALLY(&said_some, isfinite(before.lift), "%s: no distance is enough", options);
        const double by = before.lift * (1 + 1e-9);
        char again[640];
        snprintf(again, sizeof again, "%s --separation %.17g --within %.17g", options, 4 * by + 4 * gap, before.within);
        const double ways[4][2] = {{0, by}, {-by, 0}, {0, -by}, {by, 0}};
        for (int way = 0; way < (before.touches ? 4 : 2); way++) { /* touching, also the other way */
            write_two(&made, ways[way], path);
            const said after = ask(path, again);
            TALLY(&t, !after.fights || after.lift == 0, "%s, %g apart, moved by %g and %g: lacks %g", options, gap,
                  ways[way][0], ways[way][1], after.lift);
        }
    }
    tally_end(&said_some);
    tally_end(&t);
}

/* A pair that crosses fights along a line wherever it is moved to: no distance is promised, from everywhere and from an
 * eye. */
TEST(crossing) {
    static const char *const eyes[] = {"", "--eye 0,0,3 --look 0,0,0"};
    static const char obj[] = "o below\nv -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n"
                              "o above\nv -1 -1 %g\nv 1 -1 %g\nv 0 1 %g\nf 4 5 6\n";
    for (int k = 0; k < 4; k++) {
        const char *path = scratch_file("crossed.obj");
        const double below = k < 2 ? 1e-5 : -1e-5; /* else above as a whole */
        FILE *out = fopen(path, "w");
        assert_non_null(out);
        fprintf(out, obj, -below, 1e-5, 1e-5);
        assert_int_equal(fclose(out), 0);
        char options[128];
        snprintf(options, sizeof options, "-F d24 -m d3d -n 0.1 -f 1000 --separation 1mm --within 50 %s", eyes[k % 2]);
        const said s = ask(path, options);
        assert_true(s.fights);
        assert_true(k < 2 ? isnan(s.lift) : s.lift > 0 && isfinite(s.lift));
    }
}

/* Tilted by 60 degrees: what is added along one normal counts for less along the other, and yet it is found. */
TEST(steep) {
    const char *path = scratch_file("steep.obj");
    FILE *out = fopen(path, "w");
    assert_non_null(out);
    fputs("o below\nv -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n"
          "o above\nv -0.1 -0.1 1e-4\nv 0.1 -0.1 1e-4\nv 0 0.1 0.3465\nf 4 5 6\n",
          out);
    assert_int_equal(fclose(out), 0);
    const said s = ask(path, "-F d16 -m d3d -n 0.1 -f 1000 --viewport 1280x720 --fov 60 --separation 1 --within 20 "
                             "--angle 80 --eye 0,0,3 --look 0,0,0");
    assert_true(s.fights && s.lift > 1e-4 && s.lift < 0.01);
}

/* A camera of the file has the class of the very triangles: of a sliver 4 long and 1/1000 of that high, seen from 3. */
TEST(class_of_a_sliver) {
    static const double seen = 4 * 360 / (3 * 0.57735026918962576); /* pixels of 720 in 60 degrees */
    char line[1280], text[4096];
    const char *path = scratch_file("sliver.obj");
    const char *need = scratch_file("sliver.need");
    FILE *out = fopen(path, "w");
    assert_non_null(out);
    fputs("o below\nv -2 0 0\nv 2 0 0\nv 2 0.004 0\nf 1 2 3\n"
          "o above\nv -2 0 1e-4\nv 2 0 1e-4\nv 2 0.004 1e-4\nf 4 5 6\n",
          out);
    assert_int_equal(fclose(out), 0);
    snprintf(line, sizeof line,
             "-F d24 -m d3d --viewport 1280x720 --fov 60 --eye 0,0,3 --look 0,0,0 --separation 1mm --within 20 "
             "--emit-need %s",
             need);
    assert_true(ask(path, line).is_seen);
    FILE *in = fopen(need, "r");
    assert_non_null(in);
    text[fread(text, 1, sizeof text - 1, in)] = '\0';
    assert_int_equal(fclose(in), 0);
    const char *camera = strstr(text, "scene_p1 =");
    double depth = 0, pixels = 0, slim = 0;
    assert_non_null(camera);
    assert_int_equal(sscanf(strstr(camera, "triangle ="), "triangle = { depth = %lf; pixels = %lf; slim = %lf;", &depth,
                            &pixels, &slim),
                     3);
    assert_true(depth >= 1 && depth < 1.01);
    assert_true(pixels >= seen && pixels < 1.01 * seen); /* each vertex is snapped */
    assert_true(slim >= 1000 && slim < 1050);
}

/* A pair that can fight fails, by the same camera in the file. */
TEST(requirements) {
    rng r = rng_make("requirements of models");
    tally t = {.name = "fails"};
    for (uint64_t run = 0; run < test_cases(50, 150, 10000); run++) {
        const double size = rng_log(&r, 0.3, 10), gap = size * rng_log(&r, 1e-4, 1e-1);
        char options[512], line[1280];
        const char *path = scratch_file("asked.obj");
        two made = {0};
        make_two(&r, size, gap, 0.0005, false, &made);
        random_options(&r, size, run % 4 != 0, options);
        const char *need = scratch_file("asked.need");
        snprintf(line, sizeof line, "%s --emit-need %s", options, need);
        write_two(&made, (const double[2]){0, 0}, path);
        const said s = ask(path, line);
        printed p = print_of("check %s", need);
        assert_true(p.status == 0 || p.status == 1);
        if (s.is_seen && s.fights && !s.touches)
            TALLY(&t, p.status == 1, "%s, %g apart: check passes", options, gap);
        printed_free(&p);
    }
    tally_end(&t);
}
