/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A camera said by its projection matrix, to commands and requirement files. Matrices are put together here from the
 * planes that they then have to say: in both layouts, for both ways to look, both ranges of NDC and both directions,
 * with a finite and an infinite far plane, rounded to so many digits or to binary32, written as programs write them.
 */
#include "camera/matrix.h"
#include "core/append.h"
#include "printed.h"

typedef struct written {
    double m[16], znear, zfar, half[2], centre[2];
    bool is_signed, reversed, ortho;
    const char *mapping;
    char text[1024]; /* as it is typed */
} written;

/* By rows, for a camera that looks along z. */
static void make(rng *r, written *w) {
    const bool infinite = !w->ortho && rng_below(r, 4) == 0;
    w->is_signed = rng_below(r, 2) == 0;
    w->reversed = rng_below(r, 2) == 0;
    w->mapping = w->is_signed ? (w->reversed ? "gl-reversed" : "gl") : w->reversed ? "reversed" : "d3d";
    w->znear = rng_log(r, 0.01, 2);
    w->zfar = infinite ? INFINITY : w->znear * rng_log(r, 3, 1e4);
    const double n = w->znear, f = w->zfar, low = w->is_signed ? -1 : 0;
    const double at_near = w->reversed ? 1 : low, at_far = w->reversed ? low : 1;
    const double slope = (at_far - at_near) / (f - n), s = infinite ? at_far : (f * at_far - n * at_near) / (f - n);
    for (int k = 0; k < 2; k++)
        w->half[k] = rng_log(r, 0.2, 2);
    const double perspective[16] = {
        1 / w->half[0], 0, w->centre[0], 0, 0, 1 / w->half[1], w->centre[1], 0, 0, 0, s, (at_near - s) * n, 0, 0, 1, 0};
    const double ortho[16] = {1 / w->half[0],      0, 0, 0, 0, 1 / w->half[1], 0, 0, 0, 0, slope,
                              at_near - slope * n, 0, 0, 0, 1};
    memcpy(w->m, w->ortho ? ortho : perspective, sizeof w->m);
}

/* As numpy, glm, JSON and C write it: by columns or rows, along -z where that is so. */
static void type(rng *r, written *w, int digits) {
    static const char *const open[] = {"", "[[", "mat4x4((", "{"}, *const row[] = {" ", "], [", "), (", ", "};
    static const char *const between[] = {" ", ", ", ", ", "f, "}, *const close[] = {"", "]]", "))", "f}"};
    const int style = (int)rng_below(r, 4);
    const bool columns = rng_below(r, 2) == 0, backwards = rng_below(r, 2) == 0, single = rng_below(r, 3) == 0;
    w->text[0] = '\0';
    append(w->text, sizeof w->text, "%s", open[style]);
    for (int i = 0; i < 16; i++) {
        const int at = columns ? i % 4 * 4 + i / 4 : i;
        const double m = backwards && at % 4 == 2 ? -w->m[at] : w->m[at];
        append(w->text, sizeof w->text, "%.*g", single ? 9 : digits, single ? (double)(float)m : m);
        append(w->text, sizeof w->text, "%s", i == 15 ? close[style] : i % 4 == 3 ? row[style] : between[style]);
    }
}

static double end_at(const json_t *setup, const char *plane, const char *end) {
    const json_t *planes = json_object_get(setup, "planes");
    const double number = planes != NULL ? number_at(planes, "%s", end) : number_at(setup, "%s", plane);
    return isnan(number) ? INFINITY : number;
}

/* Near and far lie where the entries say, and these say no more than their digits. */
static void check_planes(tally *t, const written *w, const json_t *setup, double worth) {
    const double near[2] = {end_at(setup, "near", "near_least"), end_at(setup, "near", "near_most")};
    const double far[2] = {end_at(setup, "far", "far_least"), end_at(setup, "far", "far_most")};
    const double slack = 1e-14; /* what this test itself rounds */
    const double apart = slack * (w->ortho ? fmax(fabs(w->znear), w->zfar - w->znear) : w->znear);
    TALLY(t, near[0] <= w->znear + apart && near[1] >= w->znear - apart, "near %.17g in %.17g to %.17g: %s", w->znear,
          near[0], near[1], w->text);
    TALLY(t,
          far[0] <= w->zfar * (1 + slack * w->zfar / w->znear) && far[1] >= w->zfar * (1 - slack * w->zfar / w->znear),
          "far %.17g in %.17g to %.17g: %s", w->zfar, far[0], far[1], w->text);
    TALLY(t, w->ortho || isinf(w->zfar) || near[1] - near[0] <= 40 * worth * w->znear * w->zfar / (w->zfar - w->znear),
          "near %.17g to %.17g is too wide: %s", near[0], near[1], w->text);
    TALLY(t, strcmp(json_string_value(json_object_get(setup, "mapping")), w->mapping) == 0, "%s: %s", w->mapping,
          w->text);
}

TEST(every_convention) {
    tally t = {.name = "matrices"};
    rng r = rng_make(__func__);
    for (int i = 0; i < (int)test_cases(40, 150, 600); i++) {
        written w = {.ortho = rng_below(&r, 5) == 0};
        const int digits = 7 + (int)rng_below(&r, 11);
        make(&r, &w);
        type(&r, &w, digits);
        printed p = print_of("table -F d24 -m %s --json --matrix '%s'", w.mapping, w.text);
        if (p.status != 0)
            fail_msg("%s: %s", w.text, p.errors);
        json_t *root = json_of(p.out);
        const json_t *setup = json_array_get(json_object_get(root, "setups"), 0);
        check_planes(&t, &w, setup, fmax(pow(10, 1 - digits), 0x1p-23));
        TALLY(&t, (strcmp(json_string_value(json_object_get(setup, "projection")), "orthographic") == 0) == w.ortho,
              "%s", w.text);
        json_decref(root);
        printed_free(&p);
    }
    tally_end(&t);
}

/* A requirement file takes it, too, from a file beside it: the same planes. */
TEST(in_a_file) {
    tally t = {.name = "files"};
    rng r = rng_make(__func__);
    for (int i = 0; i < (int)test_cases(10, 30, 100); i++) {
        written w = {.ortho = false};
        char path[256];
        make(&r, &w);
        type(&r, &w, 9);
        snprintf(path, sizeof path, "%s", scratch_file("camera.txt"));
        FILE *f = fopen(path, "w");
        assert_non_null(f);
        fprintf(f, "# of an engine\r\n%s\n", w.text);
        fclose(f);
        snprintf(path, sizeof path, "%s", scratch_file("camera.need"));
        f = fopen(path, "w");
        assert_non_null(f);
        fprintf(f,
                "cameras = { c = { matrix = \"camera.txt\"; mapping = \"%s\"; format = \"d24\"; }; };\n"
                "requirements = { a = { camera = \"c\"; at = %.17g; separation = 1e9; }; };\n",
                w.mapping, w.znear * 2);
        fclose(f);
        json_t *one = json_printed(0, "table -F d24 -m %s --matrix %s", w.mapping, scratch_file("camera.txt"));
        json_t *other = json_printed(0, "check %s", path);
        static const char *const ends[] = {"near", "far", "planes"};
        for (int k = 0; k < 3; k++)
            TALLY(&t,
                  json_equal(node_at(one, "setups[0].%s", ends[k]),
                             node_at(other, "requirements[0].setup.%s", ends[k])) ||
                      (node_at(one, "setups[0].%s", ends[k]) == NULL &&
                       node_at(other, "requirements[0].setup.%s", ends[k]) == NULL),
                  "%s: %s", ends[k], w.text);
        json_decref(one);
        json_decref(other);
    }
    tally_end(&t);
}

/* For a view that is not centred, or whose pixels are no squares, the centred one with square pixels is judged that
 * holds it: none of its pixels is smaller, no edge lies outside, and triangles are at least as slim. */
TEST(views_that_are_not_centred) {
    tally t = {.name = "views"};
    rng r = rng_make(__func__);
    for (int i = 0; i < (int)test_cases(30, 100, 400); i++) {
        const int width = 16 + (int)rng_below(&r, 3000), height = 16 + (int)rng_below(&r, 3000);
        const double left = -rng_log(&r, 0.3, 2), right = rng_log(&r, 0.3, 2);
        const double down = -rng_log(&r, 0.3, 2), up = rng_log(&r, 0.3, 2);
        const double across = (right - left) / width, high = (up - down) / height, pixel = fmax(across, high);
        printed p =
            print_of("table -F fp32 -m reversed --at 1 --viewport %dx%d --json --matrix=%.17g,%.17g,%.17g,%.17g", width,
                     height, left, right, up, down);
        const bool fits = 16 * pixel / fmin(across, high) <= 1024;
        TALLY(&t, (p.status == 0) == fits, "%dx%d: %s", width, height, p.errors);
        if (p.status == 0) {
            json_t *root = json_of(p.out);
            const double w = number_at(root, "triangles.width"), h = number_at(root, "triangles.height");
            const double top = tan(number_at(root, "triangles.fov") * acos(-1) / 360);
            TALLY(&t, 2 * top / h >= pixel * (1 - 1e-12) && 2 * top / h <= pixel * (1 + 1e-12), "pixels of %g", pixel);
            TALLY(&t, top >= fmax(up, -down) * (1 - 1e-12) && top * w / h >= fmax(right, -left) * (1 - 1e-12), "edges");
            TALLY(&t, w <= 2 * fmax(right, -left) / pixel + 2 && h <= 2 * fmax(up, -down) / pixel + 2, "%g x %g", w, h);
            TALLY(&t, number_at(root, "triangles.slim") >= 16 * pixel / fmin(across, high) * (1 - 1e-12), "slim");
            json_decref(root);
        }
        printed_free(&p);
    }
    tally_end(&t);
}

/* Four tangents are where NDC -1 and 1 lie, up and down in either order. */
TEST(edges_of_tangents) {
    tally t = {.name = "tangents"};
    rng r = rng_make(__func__);
    for (int i = 0; i < 1000; i++) {
        const double left = rng_uniform(&r, -2, 1), right = left + rng_log(&r, 0.01, 2);
        const double down = rng_uniform(&r, -2, 1), up = down + rng_log(&r, 0.01, 2);
        const bool down_first = rng_below(&r, 2) == 0;
        char text[128], error[MATRIX_ERROR_SIZE];
        camera_matrix m;
        snprintf(text, sizeof text, "%.17g,%.17g,%.17g,%.17g", left, right, down_first ? down : up,
                 down_first ? up : down);
        assert_int_equal(camera_matrix_read(&m, text, error), 0);
        const double ends[2][2] = {{left, right}, {down, up}};
        for (int k = 0; k < 2; k++)
            for (int end = 0; end < 2; end++)
                TALLY(&t, fabs(((end ? 1 : -1) - m.taken.centre[k]) * m.taken.half[k] - ends[k][end]) <= 1e-12,
                      "%s: axis %d ends at %.17g", text, k, ((end ? 1 : -1) - m.taken.centre[k]) * m.taken.half[k]);
    }
    tally_end(&t);
}
