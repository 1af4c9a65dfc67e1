/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * OBJ: what triangles and surfaces a file holds, from files put together here; polygons by their area; each damage has
 * its sentence.
 */
#include "model/model.h"
#include "printed.h"

typedef struct text {
    char at[1 << 16];
} text;

__attribute__((format(printf, 2, 3))) static void add(text *t, const char *format, ...) {
    const size_t used = strlen(t->at);
    va_list arguments;
    va_start(arguments, format);
    const int size = vsnprintf(t->at + used, sizeof t->at - used, format, arguments);
    va_end(arguments);
    assert_true(size >= 0 && (size_t)size < sizeof t->at - used);
}

static bool read_text(const char *from, bool obj, model_transforms kind, model *m, model_error *error) {
    const model_asked asked = {.transforms = kind};
    return model_parse(from, strlen(from), obj, NULL, &asked, m, error);
}

static void must_read(const char *from, bool obj, model *m) {
    model_error error;
    if (!read_text(from, obj, MODEL_EXACT, m, &error))
        fail_msg("%s", error.text);
}

static void must_refuse(const char *from, bool obj, const char *sentence) {
    model m;
    model_error error;
    assert_false(read_text(from, obj, MODEL_EXACT, &m, &error));
    assert_string_equal(error.text, sentence);
    assert_false(error.unreadable);
}

/* ---- OBJ --------------------------------------------------------------------------------------------------------- */

#define SQUARE "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"

TEST(obj_faces) {
    static const struct {
        const char *text;
        uint32_t count, corner[4][3];
    } rows[] = {
        {SQUARE "f 1 2 3\n", 1, {{0, 1, 2}}},
        {SQUARE "f 1/7 2//8 3/7/8 4\n", 2, {{0, 1, 2}, {0, 2, 3}}},
        {SQUARE "f -4 -3 -1\nv 5 5 5\nf -1 1 2", 2, {{0, 1, 3}, {4, 0, 1}}},
        {"\tv 0 0 0 \r\nv 1e0 .0 -0 # a comment\r\n#f 1 1 1\nv 1 1 \\\n 0\nf 1 2 \\\n 3 #", 1, {{0, 1, 2}}},
        {"v 0 0 0 0.5 0.5 0.5\nv 1 0 0\nv 1 1 0\nvn 0 0 1\nvt 0 0\ns off\nf 3 2 1", 1, {{2, 1, 0}}},
        /* an arrow whose third corner points inwards */
        {"v 0 0 2\nv 4 -4 2\nv 1 0 2\nv 4 4 2\nf 1 2 3 4", 2, {{3, 0, 2}, {0, 1, 2}}},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        model m;
        must_read(rows[i].text, true, &m);
        assert_int_equal(m.triangles, rows[i].count);
        for (size_t k = 0; k < m.triangles; k++) {
            bool found = false; /* from whichever corner on */
            for (size_t j = 0; j < rows[i].count; j++)
                for (int turn = 0; turn < 3; turn++)
                    found = found || (m.triangle[k][0] == rows[i].corner[j][turn] &&
                                      m.triangle[k][1] == rows[i].corner[j][(turn + 1) % 3] &&
                                      m.triangle[k][2] == rows[i].corner[j][(turn + 2) % 3]);
            assert_true(found);
        }
        model_free(&m);
    }
}

/* The box is that of the corners, wherever it lies; a vertex of no face is not in it. */
TEST(obj_box) {
    static const char corners[] = "v %g %g %g\nv %g %g %g\nv %g %g %g\nv 99 99 99\nv -99 -99 -99\nf 1 2 3\n";
    static const double x[3][3] = {{1, 2, 3}, {4, 7, 3.5}, {2, 5, 9}};
    for (int sign = 0; sign < 8; sign++) {
        double s[3];
        text t = {""};
        model m;
        for (int k = 0; k < 3; k++)
            s[k] = sign >> k & 1 ? -1 : 1;
        add(&t, corners, s[0] * x[0][0], s[1] * x[0][1], s[2] * x[0][2], s[0] * x[1][0], s[1] * x[1][1], s[2] * x[1][2],
            s[0] * x[2][0], s[1] * x[2][1], s[2] * x[2][2]);
        must_read(t.at, true, &m);
        const model_box box = model_box_of(&m);
        static const double least[] = {1, 2, 3}, most[] = {4, 7, 9};
        for (int k = 0; k < 3; k++) {
            assert_true((double)box.lo[k] == (s[k] > 0 ? least[k] : -most[k]));
            assert_true((double)box.hi[k] == (s[k] > 0 ? most[k] : -least[k]));
        }
        assert_true(fabs(model_box_diagonal(&box) - sqrt(9 + 25 + 36)) < 1e-12);
        model_free(&m);
    }
}

TEST(obj_numbers) {
    model m;
    must_read("v 0.1 -2.5e-3 1e22\nv 0 0 0\nv 16777217 4.9e-324 -0\nf 1 2 3", true, &m);
    assert_true(m.position[0][0] == 0.1 && m.position[0][1] == -2.5e-3 && m.position[0][2] == 1e22);
    assert_true(m.position[2][0] == 16777217.0 && m.position[2][1] == 4.9e-324 && m.position[2][2] == 0.0);
    model_free(&m);
}

TEST(obj_surfaces) {
    model m;
    must_read(SQUARE "f 1 2 3\no house\nusemtl brick wall \nf 1 2 4\ng roof\nf 1 3 4\nusemtl glass\nf 2 3 4\n"
                     "usemtl brick wall\nf 1 2 3\nl 1 2\np 1\n",
              true, &m);
    assert_int_equal(m.triangles, 5);
    assert_int_equal(m.surfaces, 4);
    assert_int_equal(m.notes.lines, 2);
    assert_int_equal(m.of[4], m.of[2]);
    const model_surface *s = &m.surface[m.of[1]];
    assert_string_equal(s->node, "house");
    assert_string_equal(s->mesh, "");
    assert_string_equal(s->material, "brick wall");
    s = &m.surface[m.of[2]];
    assert_string_equal(s->mesh, "roof");
    assert_false(s->two_sided || s->blended);
    model_free(&m);
}

/* A surface of no object stands at the node of its group. */
TEST(obj_groups) {
    static const char *const rows[][3] = {
        {"", "", ""}, {"o house\n", "house", ""}, {"g roof\n", "roof", "roof"}, {"g roof\no house\n", "house", "roof"}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        char file[256];
        model m;
        snprintf(file, sizeof file, SQUARE "%sf 1 2 3\n", rows[i][0]);
        must_read(file, true, &m);
        assert_string_equal(m.surface[0].node, rows[i][1]);
        assert_string_equal(m.surface[0].mesh, rows[i][2]);
        model_free(&m);
    }
}

/* Names are UTF-8: of a Latin-1 umlaut, a cut off character and a control character a question mark is left. */
TEST(obj_names) {
    model m;
    must_read(SQUARE "o T\xc3\xbcr \xe6\x88\xb8\ng T\xfcr\nusemtl a\x01\xe6\x88\nf 1 2 3\n", true, &m);
    assert_string_equal(m.surface[0].node, "T\xc3\xbcr \xe6\x88\xb8");
    assert_string_equal(m.surface[0].mesh, "T?r");
    assert_string_equal(m.surface[0].material, "a???");
    model_free(&m);
}

TEST(obj_materials) {
    const model_asked asked = {0};
    model m;
    model_error error;
    char path[512];
    snprintf(path, sizeof path, "%s", scratch_file("m.mtl"));
    FILE *out = fopen(path, "w");
    assert_non_null(out);
    fputs("newmtl solid\nd 1.0\nnewmtl glass\nd 0.5\nnewmtl smoke\nTr 0.2\nnewmtl wall\nTr 0\nmtllib m.mtl\nv 1 2\n",
          out);
    assert_int_equal(fclose(out), 0);
    snprintf(path, sizeof path, "%s", scratch_file("m.obj"));
    out = fopen(path, "w");
    assert_non_null(out);
    fputs("mtllib m.mtl\nmtllib gone.mtl\n" SQUARE
          "usemtl solid\nf 1 2 3\nusemtl glass\nf 1 2 3\nusemtl smoke\nf 1 2 3\n"
          "usemtl wall\nf 1 2 3\n",
          out);
    assert_int_equal(fclose(out), 0);
    assert_true(model_read(path, &asked, &m, &error));
    assert_int_equal(m.surfaces, 4);
    for (uint32_t i = 0; i < 4; i++)
        assert_int_equal(m.surface[i].blended, i == 1 || i == 2);
    model_free(&m);
}

TEST(obj_refused) {
    static const struct {
        const char *text, *sentence;
    } rows[] = {
        {"", "is not OBJ, or has no triangles"},
        {SQUARE "\nf 1 2\n", "line 6: a face needs three corners"},
        {SQUARE "f 1 2 5\n", "line 5: a face names a vertex that is not there"},
        {SQUARE "f 1 2 0\n", "line 5: a face names a vertex that is not there"},
        {SQUARE "f 1 2 -5\n", "line 5: a face names a vertex that is not there"},
        {SQUARE "f 1 2 99999999999999999999\n", "line 5: a face names a vertex that is not there"},
        {SQUARE "f 1 2 -9223372036854775808\n", "line 5: a face names a vertex that is not there"},
        {"v 1 2\n", "line 1: a vertex needs three finite numbers"},
        {"v 1 2 nan\n", "line 1: a vertex needs three finite numbers"},
        {"v 1 2 1e999\n", "line 1: a vertex needs three finite numbers"},
        {"v 1 2 3.1+e2\n", "line 1: a vertex needs three finite numbers"},
        {"v 1 2 0,5\n", "line 1: a vertex needs three finite numbers"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        must_refuse(rows[i].text, true, rows[i].sentence);
}

/* Any polygon seen whole from its middle, in any plane: the triangles turn as it does and cover its area. */
TEST(polygons) {
    rng r = rng_make("polygons");
    for (int run = 0; run < (int)test_cases(200, 5000, 100000); run++) {
        static text t;
        const int corners = 5 + (int)rng_below(&r, 20);
        double area = 0.0, x[32], y[32];
        t.at[0] = '\0';
        for (int i = 0; i < corners; i++) {
            const double angle = (i + 0.8 * rng_unit(&r)) * 6.283185307179586 / corners;
            const double radius = rng_uniform(&r, 0.2, 1.0);
            x[i] = radius * cos(angle);
            y[i] = radius * sin(angle);
            const double p[3] = {x[i], y[i], 0.25 * x[i] - 0.5 * y[i]};
            const uint64_t axis = (uint64_t)run % 3;
            add(&t, "v %.17g %.17g %.17g\n", p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3]);
        }
        add(&t, "f");
        for (int i = 0; i < corners; i++) {
            add(&t, " %d", i + 1);
            area += 0.5 * (x[i] * y[(i + 1) % corners] - y[i] * x[(i + 1) % corners]);
        }
        model m;
        must_read(t.at, true, &m);
        assert_int_equal(m.triangles, corners - 2);
        for (size_t k = 0; k < m.triangles; k++) {
            const uint32_t *c = m.triangle[k];
            const double of =
                0.5 * ((x[c[1]] - x[c[0]]) * (y[c[2]] - y[c[0]]) - (y[c[1]] - y[c[0]]) * (x[c[2]] - x[c[0]]));
            assert_true(of >= 0.0);
            area -= of;
        }
        assert_true(fabs(area) < 1e-14);
        model_free(&m);
    }
}

/* A square whose sides are of many pieces, in one face: its corners in line are more than are cut off as ears. */
TEST(polygon_of_many) {
    enum { PIECES = 700 };
    static text t;
    t.at[0] = '\0';
    for (int side = 0; side < 4; side++)
        for (int i = 0; i < PIECES; i++) {
            const int along[4] = {i, PIECES, PIECES - i, 0};
            add(&t, "v %d %d 0\n", along[side], along[(side + 3) % 4]);
        }
    add(&t, "f");
    for (int i = 0; i < 4 * PIECES; i++)
        add(&t, " %d", i + 1);
    model m;
    must_read(t.at, true, &m);
    assert_int_equal(m.triangles, 4 * PIECES - 2);
    model_free(&m);
}

/* How often a ring of corners goes around a place; exact for small whole numbers. */
static int times_around(const int (*ring)[2], int corners, double x, double y) {
    int times = 0;
    for (int i = 0; i < corners; i++) {
        const double a[2] = {ring[i][0], ring[i][1]};
        const double b[2] = {ring[(i + 1) % corners][0], ring[(i + 1) % corners][1]};
        const double side = (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]);
        if ((a[1] <= y) != (b[1] <= y))
            times += a[1] <= y && side > 0.0 ? 1 : a[1] > y && side < 0.0 ? -1 : 0;
    }
    return times;
}

static int turn_of(const int a[2], const int b[2], const int c[2]) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/* Whether a corner lies in a triangle or on its edge, and is none of it: a crack where they are drawn. */
static bool is_upon(const int (*ring)[2], const uint32_t c[3], int corner) {
    const int *p = ring[corner];
    bool within = (uint32_t)corner != c[0] && (uint32_t)corner != c[1] && (uint32_t)corner != c[2];
    for (int i = 0; i < 3; i++)
        within = within && turn_of(ring[c[i]], ring[c[(i + 1) % 3]], p) >= 0;
    return within && turn_of(ring[c[0]], ring[c[1]], ring[c[2]]) > 0;
}

/* A skyline above a skyline upside down, on whole numbers: corners lie on the edges of ears and in line with others.
 * Every place inside is covered once, and none outside. */
TEST(polygons_of_a_grid) {
    enum { COLUMNS = 6, HEIGHT = 3, CORNERS = 4 * COLUMNS };
    rng r = rng_make("grid");
    tally t = {.name = "grid"};
    for (uint64_t run = 0; run < test_cases(300, 3000, 30000); run++) {
        static text file;
        int ring[CORNERS][2], corners = 0;
        const int columns = 2 + (int)rng_below(&r, COLUMNS - 1);
        for (int half = 0; half < 2; half++)
            for (int i = 0, y = 1; i < columns; i++) {
                const int x = half == 0 ? i : columns - i, step = half == 0 ? 1 : -1, before = y;
                y = (half == 0 ? -1 : 1) * (1 + (int)rng_below(&r, HEIGHT));
                if (i == 0 || y != before) {
                    ring[corners][0] = x;
                    ring[corners++][1] = y;
                }
                ring[corners][0] = x + step;
                ring[corners++][1] = y;
            }
        file.at[0] = '\0';
        const uint64_t axis = run % 3;
        for (int i = 0; i < corners; i++) {
            const int at[3] = {ring[i][0], ring[i][1], 7};
            add(&file, "v %d %d %d\n", at[(3 - axis) % 3], at[(4 - axis) % 3], at[(5 - axis) % 3]);
        }
        add(&file, "f");
        for (int i = 0; i < corners; i++)
            add(&file, " %d", i + 1);
        model m;
        must_read(file.at, true, &m);
        for (size_t k = 0; k < m.triangles; k++)
            for (int i = 0; i < corners; i++)
                TALLY(&t, !is_upon(ring, m.triangle[k], i), "%s: corner %d lies on a triangle", file.at, i + 1);
        for (int y = -8 * HEIGHT - 5; y < 8 * HEIGHT + 8; y += 2)
            for (int x = -5; x < 8 * columns + 8; x += 2) {
                const double px = x / 8.0, py = y / 8.0 + 0x1p-10; /* on no edge */
                int covered = 0;
                for (size_t k = 0; k < m.triangles; k++) {
                    const uint32_t *c = m.triangle[k];
                    const int three[3][2] = {
                        {ring[c[0]][0], ring[c[0]][1]}, {ring[c[1]][0], ring[c[1]][1]}, {ring[c[2]][0], ring[c[2]][1]}};
                    covered += times_around((const int(*)[2])three, 3, px, py);
                }
                TALLY(&t, covered == times_around((const int(*)[2])ring, corners, px, py), "%s: %g, %g lies in %d",
                      file.at, px, py, covered);
            }
        model_free(&m);
    }
    tally_end(&t);
}
