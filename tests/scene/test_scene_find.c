/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The pairs of triangles that src/scene finds, against exact rationals (scene_truth.c) over all pairs of small random
 * models: the same pairs, their distances to 1e-12 of the model's extent, their areas to 1e-12 of its square.
 */
#include "scene/find.h"
#include "scene/overlap.h"
#include "scene_made.h"
#include "scene_truth.h"
#include "support.h"

static const unsigned all_off = (1U << FINDER_FILTERS) - 1;

/* ---- Random models, on a lattice where much is exactly in one plane ------------------------------------------------
 */

static double lattice(rng *r, int count) {
    return 0.25 * (double)rng_below(r, (uint64_t)count);
}

static void any_triangle(scene_made *made, rng *r) {
    double p[3][3];
    const bool flat = rng_below(r, 4) != 0;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            p[i][k] = k == 2 && flat ? 0.25 * (double)(i == 0 ? 1 : 0) * (double)rng_below(r, 2) : lattice(r, 9);
    scene_made_triangle(made, p[0], p[1], p[2]);
}

static void any_decal(scene_made *made, rng *r) {
    static const double lifts[] = {0.0, 0.0, 0.25, 0.001, 0x1p-40};
    const double lift = lifts[rng_below(r, 5)];
    const double at[3] = {lattice(r, 5), lattice(r, 5), lift};
    const double u[3] = {0.25 + lattice(r, 4), lattice(r, 2), 0.0};
    const double v[3] = {0.0, 0.25 + lattice(r, 4), rng_below(r, 3) == 0 ? 0x1p-7 : 0.0};
    scene_made_quad(made, at, u, v);
}

static void any_box(scene_made *made, rng *r) {
    const double lo[3] = {lattice(r, 4), lattice(r, 4), lattice(r, 2)};
    const double hi[3] = {lo[0] + 0.25 + lattice(r, 4), lo[1] + 0.25 + lattice(r, 4), lo[2] + 0.25};
    scene_made_box(made, lo, hi);
}

/* One long edge beside two short ones: they touch, and overlap nowhere. */
static void any_junction(scene_made *made, rng *r) {
    const double z = lattice(r, 2);
    const double p[6][3] = {{0, 0, z}, {2, 0, z}, {1, 1, z}, {1, 0, z}, {0, -1, z}, {2, -1, z}};
    scene_made_triangle(made, p[0], p[1], p[2]);
    scene_made_triangle(made, p[4], p[3], p[0]);
    scene_made_triangle(made, p[5], p[1], p[3]);
}

/* All that is there a second time: moved, or mirrored, which turns the triangles round. */
static void any_copy(scene_made *made, rng *r) {
    const model *m = &made->m;
    const size_t triangles = m->triangles;
    const double shift = lattice(r, 3);
    const bool mirrored = rng_below(r, 2) != 0;
    scene_made_surface(made, "copy", "");
    for (size_t t = 0; t < triangles; t++) {
        double p[3][3];
        for (int i = 0; i < 3; i++) {
            memcpy(p[i], m->position[m->triangle[t][i]], sizeof p[i]);
            p[i][0] = (mirrored ? 2.0 - p[i][0] : p[i][0]) + shift;
        }
        scene_made_triangle(made, p[0], p[1], p[2]);
    }
}

/* Orthogonal matrices of whole numbers keep what is in one plane there, exactly; the last one rounds. */
static const double maps[][3][3] = {
    {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
    {{2, -1, 2}, {2, 2, -1}, {-1, 2, 2}},
    {{0, -1, 0}, {0, 0, 1000003}, {7, 0, 0}},
    {{1, 1000, 0}, {-1000, 1, 1}, {1, 0, 1000}},
    {{0.36, 0.48, -0.8}, {-0.8, 0.6, 0.0}, {0.48, 0.64, 0.6}},
};
enum { MAPS = sizeof maps / sizeof maps[0] };

static void transform(scene_made *made, rng *r, size_t map) {
    const double far = rng_below(r, 3) == 0 ? 0x1p20 : 0.0;
    for (size_t i = 0; i < made->m.vertices; i++) {
        double p[3];
        memcpy(p, made->position[i], sizeof p);
        for (int k = 0; k < 3; k++)
            made->position[i][k] = maps[map][k][0] * p[0] + maps[map][k][1] * p[1] + maps[map][k][2] * p[2] + far;
    }
}

static void random_model(scene_made *made, rng *r, size_t map) {
    static void (*const pieces[])(scene_made *, rng *) = {any_triangle, any_triangle, any_triangle,
                                                          any_decal,    any_box,      any_junction};
    scene_made_begin(made);
    for (size_t i = 0; i < 6; i++) {
        if (i % 2 == 0)
            scene_made_surface(made, i == 0 ? "a" : "b", "");
        pieces[rng_below(r, sizeof pieces / sizeof pieces[0])](made, r);
    }
    scene_made_triangle(made, made->position[0], made->position[1], made->position[1]);
    if (rng_below(r, 3) == 0 && made->m.triangles < 20)
        any_copy(made, r);
    transform(made, r, map);
}

/* ---- Every pair ----------------------------------------------------------------------------------------------------
 */

typedef struct counts {
    uint64_t pairs, plane, touch, apart, thin, degenerate;
} counts;

static void corners(const model *m, uint32_t triangle, double out[3][3]) {
    for (int k = 0; k < 3; k++)
        memcpy(out[k], m->position[m->triangle[triangle][k]], sizeof out[k]);
}

static const finder_pair *found_pair(const finder_found *f, uint32_t a, uint32_t b) {
    for (size_t i = 0; i < f->pairs; i++)
        if (f->pair[i].triangle[0] == a && f->pair[i].triangle[1] == b)
            return &f->pair[i];
    return NULL;
}

/* Planes that cross are a gap apart where their slope says, and that is the less certain the smaller it is. Nor is it
 * certain where a sliver has its corners. */
static void same_pair(tally *t, const scene_truth *want, const finder_pair *got, double extent) {
    const double length = 1e-12 * extent;
    const double edge = want->plane ? 0.0 : extent * 1e-15 * extent / (want->hi - want->lo + length);
    const double sliver = 1e-15 * extent * extent / want->area;
    const double height = length + sliver * (want->hi - want->lo);
    TALLY(t, fabs(got->gap_lo - want->lo) <= height && fabs(got->gap_hi - want->hi) <= height,
          "gap [%.17g, %.17g], want [%.17g, %.17g], extent %g", got->gap_lo, got->gap_hi, want->lo, want->hi, extent);
    TALLY(t, fabs(got->area - want->area) <= (length + edge) * extent, "area %.17g, want %.17g, gap [%g, %g]",
          got->area, want->area, want->lo, want->hi);
    TALLY(t, !want->plane || (got->gap_lo == 0.0 && got->gap_hi == 0.0), "in one plane, but gap [%g, %g]", got->gap_lo,
          got->gap_hi);
    for (int k = 0; k < 3; k++) {
        const double rounded = 0x1p-51 * fabs(want->place[k]);
        TALLY(t, fabs(got->place[k] - want->place[k]) <= (1e-10 + sliver) * extent + 1e3 * edge + rounded,
              "place[%d] %.17g, want %.17g", k, got->place[k], want->place[k]);
    }
}

static void same_pairs(tally *t, const scene_made *made, const finder_asked *asked, double cosine2, counts *seen) {
    const model *m = &made->m;
    finder_found f;
    size_t pairs = 0;
    size_t thins = 0;
    size_t maybe_thin = 0;
    assert_int_equal(finder_find(m, asked, &f), FINDER_DONE);
    for (uint32_t i = 0; i < m->triangles; i++)
        for (uint32_t j = i + 1; j < m->triangles; j++) {
            double a[3][3];
            double b[3][3];
            corners(m, i, a);
            corners(m, j, b);
            const scene_truth want = scene_truth_of(a, b, asked->gap, cosine2);
            const finder_pair *got = found_pair(&f, i, j);
            /* what rounding left of edges that met */
            const bool thin = got == NULL && want.pair && want.area <= 0x1p-45 * f.extent * f.extent;
            TALLY(t, thin || (got != NULL) == want.pair, "triangles %u and %u of %zu, gap %g: %s, area %g", (unsigned)i,
                  (unsigned)j, m->triangles, asked->gap, got != NULL ? "found, but none" : "not found", want.area);
            thins += thin;
            /* too far apart, or not: nobody can tell in double */
            maybe_thin += want.overlap && !want.pair && want.whole <= 0x1p-45 * f.extent * f.extent;
            if (got != NULL && want.pair)
                same_pair(t, &want, got, f.extent);
            pairs += want.pair;
            seen->pairs += want.pair;
            seen->plane += want.pair && want.plane;
            seen->touch += want.touch;
            seen->apart += want.overlap && !want.pair;
            seen->degenerate += want.degenerate;
        }
    TALLY(t, f.pairs + thins == pairs && !f.cut, "%zu pairs, want %zu", f.pairs, pairs - thins);
    /* of a sliver it is as uncertain whether it is nearer than next to nothing */
    const size_t thin = f.left_out[FINDER_THIN];
    const bool unsure = asked->gap > 0.0 && asked->gap < 1e-9;
    TALLY(t, (thin >= thins || unsure) && thin <= thins + maybe_thin, "%zu thin, want %zu", thin, thins);
    seen->thin += thins;
    finder_free(&f);
}

TEST(test_all_pairs) {
    /* 45 degrees are on the lattice, and within, where nothing rounds; the others are not */
    static const double angles[][2] = {{1.0, 0.99969541350954785}, {47.0, 0.46512176312793729}, {45.0, 0.5}};
    static const double gaps[] = {0.0, 1e-12, 0.0007, 0.1, 1.3};
    rng r = rng_make("scene pairs");
    tally t = {.name = "pairs of triangles"};
    counts seen = {0};
    const uint64_t models = test_cases(30, 150, 3000);
    scene_made *made = malloc(sizeof *made);
    assert_non_null(made);
    for (uint64_t i = 0; i < models; i++) {
        random_model(made, &r, i % MAPS);
        const double *angle = angles[rng_below(&r, i % MAPS == MAPS - 1 ? 2 : 3)];
        const finder_asked asked = {.gap = gaps[i / MAPS % 5], .angle = angle[0], .off = all_off, .threads = 2};
        same_pairs(&t, made, &asked, angle[1], &seen);
    }
    free(made);
    tally_end(&t);
    printf("# %llu pairs, %llu in one plane, %llu touch, %llu too far apart, %llu thin, %llu without area\n",
           (unsigned long long)seen.pairs, (unsigned long long)seen.plane, (unsigned long long)seen.touch,
           (unsigned long long)seen.apart, (unsigned long long)seen.thin, (unsigned long long)seen.degenerate);
    assert_true(seen.plane > 3 * models && seen.pairs > seen.plane + models);
    assert_true(seen.touch > 3 * models && seen.apart > models && seen.degenerate > models);
}

/* The width of an overlap is its area over the longest of all lines between its corners, sides among them; corners and
 * area are each other's. */
TEST(widths_of_overlaps) {
    tally t = {.name = "widths of overlaps"};
    rng r = rng_make("widths of overlaps");
    int of[OVERLAP_CORNERS + 1] = {0};
    for (uint64_t n = test_cases(2000, 5000, 50000); n > 0; n--) {
        double p[6][3];
        const double *a[3], *b[3];
        overlap o;
        for (int i = 0; i < 6; i++) {
            p[i][0] = rng_uniform(&r, -1, 1);
            p[i][1] = rng_uniform(&r, -1, 1);
            p[i][2] = i < 3 ? 0.0 : 0.01;
            *(i < 3 ? &a[i] : &b[i - 3]) = p[i];
        }
        if (!overlap_find(a, b, 0.1, 0.01, &o) || !(o.area > 1e-6))
            continue;
        double longest = 0, area = 0;
        for (int i = 0; i < o.corners; i++) {
            const double *u = o.corner[i], *v = o.corner[(i + 1) % o.corners];
            area += (u[0] * v[1] - u[1] * v[0]) / 2;
            for (int j = 0; j < o.corners; j++)
                longest = fmax(longest, hypot(o.corner[j][0] - u[0], o.corner[j][1] - u[1]));
        }
        of[o.corners]++;
        TALLY(&t, fabs(fabs(area) - o.area) <= 1e-12, "%d corners: area %.17g, not %.17g", o.corners, o.area, area);
        TALLY(&t, fabs(o.width - o.area / longest) <= 1e-12 * o.width, "%d corners: width %.17g, not %.17g", o.corners,
              o.width, o.area / longest);
    }
    assert_true(of[3] > 20 && of[4] > 20 && of[5] > 20 && of[6] > 0);
    tally_end(&t);
}
