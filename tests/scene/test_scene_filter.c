/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * What src/scene leaves out, and why; what it makes of pairs: findings, their order, place and box; what it refuses,
 * and what becomes of models all in one place. Each scene is made by hand, and so is what must come out.
 */
#include "scene/find.h"
#include "scene_made.h"
#include "support.h"

static scene_made made;

static const double origin[3] = {0, 0, 0};
static const double east[3] = {8, 0, 0};
static const double north[3] = {0, 8, 0};

static finder_found find(finder_asked asked) {
    finder_found f;
    asked.angle = asked.angle > 0.0 ? asked.angle : FINDER_ANGLE;
    asked.threads = 2;
    assert_int_equal(finder_find(&made.m, &asked, &f), FINDER_DONE);
    return f;
}

/* How many findings there are, and how many pairs the filter left out. */
static void expect(finder_asked asked, size_t findings, finder_filter filter, size_t left_out) {
    finder_found f = find(asked);
    assert_int_equal(f.findings, findings);
    for (int k = 0; k < FINDER_FILTERS; k++)
        assert_int_equal(f.left_out[k], k == (int)filter ? left_out : 0);
    finder_free(&f);
}

/* A quad of 8 x 8 that faces up. */
static void floor_at(const char *node, double z) {
    scene_made_surface(&made, node, "");
    scene_made_quad(&made, (const double[3]){0, 0, z}, east, north);
}

/* ---- Each filter ----------------------------------------------------------------------------------------------------
 */

/* Two quads in one plane, of which the second looks away: four pairs of triangles, of which all overlap. */
static void back_to_back(void) {
    scene_made_begin(&made);
    floor_at("floor", 0.0);
    scene_made_surface(&made, "ceiling", "");
    scene_made_quad(&made, (const double[3]){2, 0, 0}, north, east);
}

TEST(test_facing) {
    back_to_back();
    expect((finder_asked){0}, 0, FINDER_FACING, 3);
    expect((finder_asked){.off = 1U << FINDER_FACING}, 1, FINDER_FACING, 0);
    for (int k = 0; k < 2; k++) {
        back_to_back();
        made.surface[k].two_sided = true;
        expect((finder_asked){0}, 1, FINDER_FACING, 0);
    }
}

TEST(test_blended) {
    for (int k = 0; k < 2; k++) {
        scene_made_begin(&made);
        floor_at("floor", 0.0);
        floor_at("glass", 0.25);
        made.surface[k].blended = true;
        expect((finder_asked){.gap = 1.0}, 0, FINDER_BLENDED, 2);
        expect((finder_asked){.gap = 1.0, .off = 1U << FINDER_BLENDED}, 1, FINDER_BLENDED, 0);
    }
}

/* A quad that is turned about the first one's edge by nearly the angle asked for, in any place of space: it counts
 * below that angle, however near to it. */
TEST(test_angle) {
    tally t = {.name = "angles"};
    rng r = rng_make("angles of planes");
    for (uint64_t i = test_cases(2000, 10000, 200000); i > 0; i--) {
        const double angle = rng_log(&r, 0.1, FINDER_ANGLE_MAX), off = rng_log(&r, i % 2 == 0 ? 1e-9 : 1e-6, 1e-3);
        const double turn = angle * (i % 2 == 0 ? 1 - off : 1 + off) * 3.14159265358979323846 / 180;
        double x[3], y[3], z[3], length = 0, turned[3];
        for (int k = 0; k < 3; k++)
            x[k] = rng_uniform(&r, -1, 1);
        const double across[3] = {rng_uniform(&r, -1, 1), 1, rng_uniform(&r, -1, 1)};
        for (int k = 0; k < 3; k++)
            z[k] = x[(k + 1) % 3] * across[(k + 2) % 3] - x[(k + 2) % 3] * across[(k + 1) % 3];
        for (int k = 0; k < 3; k++)
            y[k] = z[(k + 1) % 3] * x[(k + 2) % 3] - z[(k + 2) % 3] * x[(k + 1) % 3];
        length = sqrt((y[0] * y[0] + y[1] * y[1] + y[2] * y[2]) / (z[0] * z[0] + z[1] * z[1] + z[2] * z[2]));
        for (int k = 0; k < 3; k++)
            turned[k] = cos(turn) * y[k] + sin(turn) * length * z[k];
        scene_made_begin(&made);
        scene_made_surface(&made, "first", "");
        scene_made_quad(&made, origin, x, y);
        scene_made_surface(&made, "second", "");
        scene_made_quad(&made, origin, x, turned);
        finder_found f = find((finder_asked){.gap = 1e-3, .angle = angle});
        TALLY(&t, (f.findings == 1) == (i % 2 == 0), "%.17g of %.17g degrees: %zu found", turn * 57.29577951308232,
              angle, f.findings);
        finder_free(&f);
    }
    tally_end(&t);
}

/* The second floor begins 2^-10 before the first one's end: an overlap 8 long, and 2^-10 wide in all. */
TEST(test_thin) {
    scene_made_begin(&made);
    floor_at("floor", 0.0);
    scene_made_surface(&made, "next", "");
    scene_made_quad(&made, (const double[3]){8 - 0x1p-10, 0, 0}, east, north);
    finder_found f = find((finder_asked){0});
    const size_t pairs = f.pairs;
    assert_int_equal(f.findings, 1);
    assert_scene(f.finding[0].area, 8 * 0x1p-10, 1e-12);
    finder_free(&f);
    expect((finder_asked){.width = 0x1.1p-10}, 0, FINDER_THIN, pairs);
    expect((finder_asked){.width = 0x1.1p-10, .off = 1U << FINDER_THIN}, 1, FINDER_THIN, 0);
    expect((finder_asked){.width = 0x1p-13}, 1, FINDER_THIN, 0);
}

/* A floor, and on it a rug of 1 x 1 in the same plane: the large floor triangle below the diagonal has all of it. */
static void rug_at(double x) {
    scene_made_begin(&made);
    floor_at("floor", 0.0);
    scene_made_surface(&made, "rug", "");
    scene_made_quad(&made, (const double[3]){x, 1, 0}, (const double[3]){1, 0, 0}, (const double[3]){0, 1, 0});
}

static void chest(double x, double z) {
    scene_made_surface(&made, "chest", "wood");
    scene_made_box(&made, (const double[3]){x, 0.5, z}, (const double[3]){x + 2, 2.5, z + 1});
}

TEST(test_hidden) {
    const finder_asked exactly = {.gap = 0.0};
    rug_at(5);
    expect(exactly, 1, FINDER_HIDDEN, 0);
    chest(4.5, -0.5); /* around it */
    expect(exactly, 0, FINDER_HIDDEN, 2);
    expect((finder_asked){.off = 1U << FINDER_HIDDEN}, 1, FINDER_HIDDEN, 0);
    rug_at(5);
    chest(4.5, 0.001); /* above it, within the gap and without */
    expect((finder_asked){.gap = 0.01, .off = 1U << FINDER_FACING}, 2, FINDER_HIDDEN, 2);
    expect(exactly, 1, FINDER_HIDDEN, 0);
    rug_at(5);
    chest(4.5, 0.25); /* within the gap, but one sees below it */
    finder_found f = find((finder_asked){.gap = 0.5});
    assert_int_equal(f.findings, 1);
    finder_free(&f);
    rug_at(5);
    chest(5.5, -0.5); /* half of it looks out */
    expect(exactly, 1, FINDER_HIDDEN, 0);
}

static void turn_round(size_t from) {
    for (size_t t = from; t < made.m.triangles; t++) {
        const uint32_t kept = made.triangle[t][0];
        made.triangle[t][0] = made.triangle[t][1];
        made.triangle[t][1] = kept;
    }
}

/* Shapes that are no body, or none that hides. */
TEST(test_not_hidden) {
    const finder_asked exactly = {.gap = 0.0};
    rug_at(5);
    chest(4.5, -0.5);
    made.m.triangles--; /* a hole */
    expect(exactly, 1, FINDER_HIDDEN, 0);
    for (int k = 0; k < 2; k++) {
        rug_at(5);
        chest(4.5, -0.5);
        made.surface[2].two_sided = k == 0;
        made.surface[2].blended = k == 1;
        expect(exactly, 1, FINDER_HIDDEN, 0);
    }
    rug_at(5);
    chest(4.5, -0.5);
    turn_round(4); /* a room, seen from within */
    expect(exactly, 1, FINDER_HIDDEN, 0);
    scene_made_surface(&made, "box", ""); /* in the room */
    scene_made_box(&made, (const double[3]){4.75, 0.75, -0.25}, (const double[3]){6.25, 2.25, 0.25});
    expect(exactly, 0, FINDER_HIDDEN, 2);
    rug_at(5);
    chest(4.5, 0.25);
    turn_round(4); /* a room above: its walls look away, and one sees the rug through them */
    expect(exactly, 1, FINDER_HIDDEN, 0);
}

/* A body has one node and one mesh, of whatever materials: its last face is another's where either differs. */
TEST(test_hidden_by_parts) {
    static const struct {
        const char *node, *mesh, *material;
        size_t hidden;
    } rows[] = {{"chest", "box", "iron", 2}, {"chest", "lid", "wood", 0}, {"lid", "box", "wood", 0}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        rug_at(5);
        chest(4.5, -0.5);
        made.surface[2].mesh = "box";
        const uint32_t last = scene_made_surface(&made, rows[i].node, rows[i].material);
        made.surface[last].mesh = rows[i].mesh;
        made.of[made.m.triangles - 1] = made.of[made.m.triangles - 2] = last;
        expect((finder_asked){.gap = 0.0}, rows[i].hidden == 0, FINDER_HIDDEN, rows[i].hidden);
    }
}

/* Floor and rug are seen from both sides: a body in front hides them where another one stands behind. */
TEST(test_hidden_behind) {
    enum { CHEST = 1, CELLAR = 2 };
    for (int bodies = 1; bodies <= 3; bodies++) {
        rug_at(5);
        made.surface[0].two_sided = made.surface[1].two_sided = true;
        if (bodies & CHEST)
            chest(4.5, 0.0);
        if (bodies & CELLAR) {
            chest(4.5, -1.0);
            made.surface[made.m.surfaces - 1].node = "cellar";
        }
        finder_found f = find((finder_asked){0});
        /* floor and rug, and either with the body's face in their plane */
        assert_int_equal(f.findings, bodies == (CHEST | CELLAR) ? 0 : 3);
        assert_true((f.left_out[FINDER_HIDDEN] > 0) == (f.findings == 0));
        finder_free(&f);
    }
}

/* ---- Findings -------------------------------------------------------------------------------------------------------
 */

TEST(test_findings) {
    static const double small[2][3] = {{2, 0, 0}, {0, 2, 0}};
    scene_made_begin(&made);
    floor_at("floor", 0.0);
    floor_at("low", 0.125);
    scene_made_surface(&made, "rug", "");
    scene_made_quad(&made, (const double[3]){5, 1, 0}, small[0], small[1]);
    scene_made_surface(&made, "tilted", "");
    scene_made_quad(&made, (const double[3]){1, 5, -0.015625}, (const double[3]){2, 0, 0.03125},
                    (const double[3]){0, 1, 0});
    finder_found f = find((finder_asked){.gap = 0.1});
    /* floor and rug; floor and tilted, which lies across it; from low all are too far */
    assert_int_equal(f.findings, 2);
    const finder_finding *rug = &f.finding[0];
    const finder_finding *tilted = &f.finding[1];
    assert_int_equal(rug->a, 0);
    assert_int_equal(rug->b, 2);
    assert_true(rug->gap_min == 0.0 && rug->gap_max == 0.0);
    assert_scene(rug->area, 4.0, 1e-12);
    assert_int_equal(rug->pairs, 2);
    assert_true(rug->place[2] == 0.0 && rug->place[0] > 5 && rug->place[0] < 7 && rug->place[1] > 1 &&
                rug->place[1] < 3);
    assert_true(rug->normal[0] == 0.0 && rug->normal[1] == 0.0 && rug->normal[2] == 1.0);
    const double box[2][3] = {{5, 1, 0}, {7, 3, 0}};
    for (int k = 0; k < 3; k++) {
        assert_scene(rug->lo[k], box[0][k], 1e-12);
        assert_scene(rug->hi[k], box[1][k], 1e-12);
    }
    assert_int_equal(tilted->b, 3);
    assert_true(tilted->gap_min == 0.0);
    assert_scene(tilted->gap_max, 0.015625, 1e-4); /* along a normal that is turned by less than 1 degree */
    assert_true(f.pair[tilted->first].gap_lo < 0.0 || f.pair[tilted->first].gap_hi > 0.0);
    for (size_t i = 0; i < f.findings; i++)
        for (size_t p = f.finding[i].first; p < f.finding[i].first + f.finding[i].pairs; p++) {
            double corner[FINDER_CORNERS][3];
            const int corners = finder_corners(&made.m, f.pair[p].triangle, 0.1, corner);
            assert_true(corners >= 3);
            assert_true(p == f.finding[i].first || f.pair[p].area <= f.pair[p - 1].area);
            for (int c = 0; c < corners; c++)
                for (int k = 0; k < 3; k++)
                    assert_true(corner[c][k] >= f.finding[i].lo[k] && corner[c][k] <= f.finding[i].hi[k]);
        }
    finder_free(&f);
}

/* The second surface's distance is positive in front of the first, and the smallest gap comes first. */
TEST(test_order) {
    scene_made_begin(&made);
    floor_at("floor", 0.0);
    floor_at("above", 0.25);
    floor_at("below", -0.125);
    finder_found f = find((finder_asked){.gap = 0.3});
    assert_int_equal(f.findings, 2);
    assert_int_equal(f.finding[0].b, 2);
    assert_scene(f.finding[0].gap_min, 0.125, 1e-12);
    assert_scene(f.pair[f.finding[0].first].gap_lo, -0.125, 1e-12);
    assert_scene(f.pair[f.finding[1].first].gap_hi, 0.25, 1e-12);
    assert_scene(f.extent, sqrt(64 + 64 + 0.375 * 0.375), 1e-12);
    finder_free(&f);
}

/* The lesser surface is a, whose triangles come first in a pair, wherever they are in the model. */
TEST(test_surfaces) {
    scene_made_begin(&made);
    floor_at("above", 0.25);
    floor_at("floor", 0.0);
    for (int t = 0; t < 4; t++)
        made.of[t] = t < 2;
    finder_found f = find((finder_asked){.gap = 0.3});
    assert_int_equal(f.findings, 1);
    assert_int_equal(f.finding[0].a, 0);
    assert_int_equal(f.finding[0].b, 1);
    assert_int_equal(f.pairs, 2);
    for (size_t i = 0; i < f.pairs; i++) {
        assert_true(f.pair[i].triangle[0] >= 2 && f.pair[i].triangle[1] < 2);
        assert_scene(f.pair[i].gap_lo, 0.25, 1e-12);
        assert_scene(f.pair[i].place[2], 0.0, 1e-12);
    }
    finder_free(&f);
}

/* ---- Bounds ------------------------------------------------------------------------------------------------------ */

TEST(test_refused) {
    const finder_asked wrong[] = {{.gap = -1},     {.gap = NAN},   {.gap = INFINITY}, {.angle = 90},
                                  {.angle = -0.1}, {.width = NAN}, {.width = -1}};
    finder_found f;
    scene_made_begin(&made);
    floor_at("floor", 0.0);
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++)
        assert_int_equal(finder_find(&made.m, &wrong[i], &f), FINDER_RANGE);
    made.position[0][1] = 1e51;
    assert_int_equal(finder_find(&made.m, &(finder_asked){0}, &f), FINDER_RANGE);
    assert_null(f.finding);
    scene_made_begin(&made);
    expect((finder_asked){0}, 0, FINDER_FACING, 0);
}

TEST(test_degenerate) {
    scene_made_begin(&made);
    scene_made_surface(&made, "", "");
    scene_made_triangle(&made, origin, east, east);
    scene_made_triangle(&made, origin, (const double[3]){0.1, 0.2, 0.3}, (const double[3]){0.2, 0.4, 0.6});
    finder_found f = find((finder_asked){.gap = 1.0});
    assert_int_equal(f.degenerate, 2);
    assert_int_equal(f.pairs, 0);
    finder_free(&f);
    scene_made_triangle(&made, origin, (const double[3]){0.1, 0.2, 0.3},
                        (const double[3]){0.2, 0.4, 0x1.3333333333334p-1});
    f = find((finder_asked){.gap = 1.0});
    assert_int_equal(f.degenerate, 2);
    finder_free(&f);
}

/* All triangles in one place: as many pairs as are wanted, and a word that there are more. */
TEST(test_cut) {
    enum { COPIES = 64, PAIRS = COPIES * (COPIES - 1) / 2 };
    static const struct {
        size_t most, pairs;
        bool cut;
    } rows[] = {{0, PAIRS, false}, {PAIRS, PAIRS, false}, {PAIRS - 1, PAIRS - 1, true}, {7, 7, true}};
    scene_made_begin(&made);
    scene_made_surface(&made, "", "");
    for (int i = 0; i < COPIES; i++)
        scene_made_triangle(&made, origin, east, north);
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        finder_found f = find((finder_asked){.pairs_max = rows[i].most});
        assert_int_equal(f.pairs, rows[i].pairs);
        assert_int_equal(f.cut, rows[i].cut);
        assert_int_equal(f.findings, 1);
        assert_true(f.finding[0].a == 0 && f.finding[0].b == 0);
        finder_free(&f);
    }
}

/* Two floors of 2 x 40 x 40 triangles in one place, each pair of equal ones once, which takes several chunks of work.
 */
TEST(test_threads) {
    enum { SIDE = 40, PAIRS = 2 * SIDE * SIDE };
    static const size_t most[] = {0, 1000};
    scene_made_begin(&made);
    for (int layer = 0; layer < 2; layer++)
        for (int i = 0; i < SIDE; i++) {
            scene_made_surface(&made, "row", "");
            for (int j = 0; j < SIDE; j++)
                scene_made_quad(&made, (const double[3]){i, j, 0}, (const double[3]){1, 0, 0},
                                (const double[3]){0, 1, 0});
        }
    for (int k = 0; k < 2; k++) {
        finder_found f[2];
        for (int t = 0; t < 2; t++) {
            const finder_asked asked = {.angle = 1.0, .threads = 1 + t, .pairs_max = most[k]};
            assert_int_equal(finder_find(&made.m, &asked, &f[t]), FINDER_DONE);
        }
        assert_int_equal(f[0].cut, k == 1);
        assert_int_equal(f[0].pairs, k == 0 ? PAIRS : 1000);
        assert_true(k == 1 || f[0].findings == SIDE);
        assert_int_equal(f[0].findings, f[1].findings);
        assert_memory_equal(f[0].pair, f[1].pair, f[0].pairs * sizeof *f[0].pair);
        assert_memory_equal(f[0].finding, f[1].finding, f[0].findings * sizeof *f[0].finding);
        for (size_t i = 0; i < f[0].pairs; i++)
            assert_int_equal(f[0].pair[i].triangle[1] - f[0].pair[i].triangle[0], PAIRS);
        for (int t = 0; t < 2; t++)
            finder_free(&f[t]);
    }
}

static int stop(void *context, double share) {
    assert_true(share >= 0.0 && share <= 1.0);
    return --*(int *)context < 0;
}

TEST(test_progress) {
    finder_found f;
    int times = 0;
    scene_made_begin(&made);
    floor_at("floor", 0.0);
    floor_at("above", 0.25);
    finder_asked asked = {.gap = 1.0, .angle = 1.0, .progress = stop, .context = &times};
    for (int k = 0; k < 2; k++) { /* after the pairs, and after what bodies hide */
        times = k;
        assert_int_equal(finder_find(&made.m, &asked, &f), FINDER_STOPPED);
        assert_null(f.pair);
    }
    times = 100;
    assert_int_equal(finder_find(&made.m, &asked, &f), FINDER_DONE);
    finder_free(&f);
}
