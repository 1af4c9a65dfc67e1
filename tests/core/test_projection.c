/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cameras of matrices whose convention is not known: put together here in long double, in each convention and layout.
 */
#include "depthprec/depthprec.h"
#include "support.h"

enum { ENTRIES = 16 };

static const dp_mapping mappings[] = {DP_MAPPING_D3D, DP_MAPPING_GL, DP_MAPPING_REVERSED, DP_MAPPING_GL_REVERSED};

typedef struct matrix_case {
    double znear, zfar;
    dp_mapping mapping;
    int ortho, backwards;
    double rows[ENTRIES], columns[ENTRIES];
} matrix_case;

/* Row of z: NDC depth is c z + e w of a camera that looks along +z; then each convention by its own rule. */
static void fill(matrix_case *m) {
    const long double n = (long double)m->znear, f = (long double)m->zfar;
    const int reversed = m->mapping == DP_MAPPING_REVERSED || m->mapping == DP_MAPPING_GL_REVERSED;
    const int wide = m->mapping == DP_MAPPING_GL || m->mapping == DP_MAPPING_GL_REVERSED;
    long double c = m->ortho ? 1 / (f - n) : isinf(m->zfar) ? 1 : f / (f - n);
    long double e = m->ortho ? -n / (f - n) : isinf(m->zfar) ? -n : -f * n / (f - n);
    const long double w[2] = {m->ortho ? 0 : 1, m->ortho ? 1 : 0};
    if (reversed) {
        c = w[0] - c;
        e = w[1] - e;
    }
    if (wide) {
        c = 2 * c - w[0];
        e = 2 * e - w[1];
    }
    const double sign = m->backwards ? -1 : 1;
    const double rows[ENTRIES] = {
        1.25, 0, 0, 0, 0, -2.5, 0, 0, 0, 0, sign * (double)c, (double)e, 0, 0, sign * (double)w[0], (double)w[1]};
    for (int i = 0; i < ENTRIES; i++) {
        m->rows[i] = rows[i];
        m->columns[i % 4 * 4 + i / 4] = rows[i];
    }
}

static matrix_case any_case(rng *r) {
    matrix_case m = {.znear = rng_log(r, 1e-3, 10), .mapping = mappings[rng_below(r, 4)]};
    m.ortho = rng_below(r, 5) == 0;
    m.backwards = (int)rng_below(r, 2);
    m.zfar = m.znear * rng_log(r, 2.1, 1e5);
    if (!m.ortho && rng_below(r, 4) == 0)
        m.zfar = INFINITY;
    fill(&m);
    return m;
}

static int near_to(double got, double want, double bound) {
    return got == want || fabs(got - want) <= bound * want;
}

/* The planes from rounded entries: in an orthographic matrix, and for far, what cancels is far over near. */
static int is_found(const matrix_case *m, const dp_projection *p) {
    const double cancelled = 4 * 0x1p-52 * (isinf(m->zfar) ? 1 : m->zfar / m->znear);
    return p->mapping == m->mapping && p->ortho == m->ortho && p->backwards == m->backwards && !p->oblique &&
           p->reversed == dp_mapping_get(m->mapping)->reversed &&
           near_to(p->znear, m->znear, m->ortho ? cancelled : 4 * 0x1p-52) && near_to(p->zfar, m->zfar, cancelled) &&
           p->scale[0] == 1.25 && p->scale[1] == 2.5;
}

TEST(test_found) {
    tally t = {.name = "found"};
    rng r = rng_make("projections");
    for (uint64_t k = test_cases(500, 20000, 1000000); k > 0; k--) {
        const matrix_case m = any_case(&r);
        const dp_mapping_row *row = dp_mapping_get(m.mapping);
        dp_projection p = {.znear = -5};
        dp_matrix_fault fault;
        for (int layout = 0; layout < DP_LAYOUT_COUNT; layout++) {
            const double *given = layout == DP_LAYOUT_COLUMNS ? m.columns : m.rows;
            const dp_status status = dp_projection_find(&p, given, (dp_layout)layout, m.mapping, &fault);
            TALLY(&t, status == DP_OK && is_found(&m, &p), "%s %g..%g: %s, %.17g..%.17g", row->name, m.znear, m.zfar,
                  dp_status_text(status), p.znear, p.zfar);
        }
        TALLY(&t, dp_projection_find(&p, m.columns, DP_LAYOUT_FOUND, m.mapping, NULL) == DP_OK && is_found(&m, &p),
              "%s by columns", row->name);
        const int told = m.mapping == DP_MAPPING_REVERSED && !m.ortho;
        p.znear = -5;
        const dp_status open = dp_projection_find(&p, m.rows, DP_LAYOUT_FOUND, DP_MAPPING_COUNT, NULL);
        TALLY(&t, told ? open == DP_OK && is_found(&m, &p) : open == DP_ERROR_CONVENTION && p.znear == -5,
              "%s%s %g..%g, not asked for: %s", row->name, m.ortho ? " ortho" : "", m.znear, m.zfar,
              dp_status_text(open));
        const dp_mapping other = mappings[(m.mapping - DP_MAPPING_D3D + 2) % 4];
        p.znear = -5;
        TALLY(&t,
              m.ortho ||
                  (dp_projection_find(&p, m.rows, DP_LAYOUT_FOUND, other, &fault) == DP_ERROR_MATRIX && p.znear == -5 &&
                   strstr(fault.rule, row->reversed ? "falls" : "grows") != NULL && fault.got[3] == m.rows[11]),
              "%s as %s", row->name, dp_mapping_get(other)->name);
    }
    tally_end(&t);
}

/* The transpose is a projection, too: near 1 and far infinite, or near 1/2 and far 1, reversed. */
TEST(test_either_layout) {
    matrix_case m = {.znear = 1, .zfar = INFINITY, .mapping = DP_MAPPING_D3D};
    dp_projection p;
    fill(&m);
    assert_int_equal(dp_projection_find(&p, m.rows, DP_LAYOUT_FOUND, DP_MAPPING_COUNT, NULL), DP_ERROR_CONVENTION);
    assert_int_equal(dp_projection_find(&p, m.rows, DP_LAYOUT_FOUND, DP_MAPPING_REVERSED, NULL), DP_OK);
    assert_true(p.znear == 0.5 && p.zfar == 1);
    assert_int_equal(dp_projection_find(&p, m.rows, DP_LAYOUT_ROWS, DP_MAPPING_REVERSED, NULL), DP_ERROR_MATRIX);
    assert_int_equal(dp_projection_find(&p, m.rows, DP_LAYOUT_ROWS, DP_MAPPING_D3D, NULL), DP_OK);
    assert_true(p.znear == 1 && isinf(p.zfar));
    /* its own transpose: one camera, not two */
    const double same[ENTRIES] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 1, 0};
    assert_int_equal(dp_projection_find(&p, same, DP_LAYOUT_FOUND, DP_MAPPING_COUNT, NULL), DP_OK);
    assert_true(p.znear == 1 && isinf(p.zfar) && p.mapping == DP_MAPPING_REVERSED);
}

TEST(test_refused) {
    matrix_case m = {.znear = 0.1, .zfar = 1000, .mapping = DP_MAPPING_D3D};
    dp_projection p = {.znear = -5};
    dp_matrix_fault fault = {NULL, {0}};
    fill(&m);
    assert_int_equal(dp_projection_find(NULL, m.rows, DP_LAYOUT_ROWS, DP_MAPPING_D3D, NULL), DP_ERROR_NULL);
    assert_int_equal(dp_projection_find(&p, NULL, DP_LAYOUT_ROWS, DP_MAPPING_D3D, NULL), DP_ERROR_NULL);
    assert_int_equal(dp_projection_init(NULL, m.rows, 0, 0, NULL), DP_ERROR_NULL);
    assert_int_equal(dp_projection_init(&p, NULL, 0, 0, NULL), DP_ERROR_NULL);
    assert_int_equal(dp_projection_find(&p, m.rows, DP_LAYOUT_ROWS, DP_MAPPING_LOG, NULL), DP_ERROR_MAPPING);
    assert_int_equal(dp_projection_find(&p, m.rows, DP_LAYOUT_ROWS, DP_MAPPING_COUNT + 1, NULL), DP_ERROR_MAPPING);
    assert_int_equal(dp_projection_find(&p, m.columns, DP_LAYOUT_ROWS, DP_MAPPING_D3D, &fault), DP_ERROR_MATRIX);
    assert_non_null(strstr(fault.rule, "transpose it"));
    m.rows[8] = 0.25; /* oblique: a camera of the command, but not one pair of planes */
    assert_int_equal(dp_projection_find(&p, m.rows, DP_LAYOUT_FOUND, DP_MAPPING_D3D, &fault), DP_ERROR_MATRIX);
    assert_non_null(strstr(fault.rule, "the same for every pixel"));
    assert_true(p.znear == -5 && fault.got[0] == 0.25);
    assert_int_equal(dp_projection_init(&p, m.rows, 0, 0, &fault), DP_OK);
    assert_true(p.oblique && p.mapping == DP_MAPPING_D3D);
    for (int i = 0; i < ENTRIES; i++) {
        fill(&m);
        m.rows[i] = i % 2 ? NAN : INFINITY;
        assert_int_equal(dp_projection_find(&p, m.rows, DP_LAYOUT_FOUND, DP_MAPPING_D3D, &fault), DP_ERROR_MATRIX);
        assert_non_null(fault.rule);
    }
}

/* Of the entries that are zeros a perspective may move its centre and tilt its planes, an orthographic projection may
 * move its centre; any other is refused by itself, and so is one that is a zero where none may be. */
TEST(test_each_entry) {
    for (int ortho = 0; ortho < 2; ortho++) {
        const double good[ENTRIES] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1.5, -1.5, 0, 0, !ortho, ortho};
        for (int i = 0; i < ENTRIES; i++) {
            const bool may = ortho ? i == 3 || i == 7 : i == 2 || i == 6 || i == 8 || i == 9;
            const bool must = good[i] != 0 && !(ortho && i == 11);
            double m[ENTRIES];
            dp_projection p;
            dp_matrix_fault fault = {NULL, {0}};
            memcpy(m, good, sizeof m);
            m[i] = good[i] == 0 ? 0.25 : 0;
            const dp_status status = dp_projection_init(&p, m, 0, 0, &fault);
            if ((status == DP_OK) != (good[i] == 0 ? may : !must) || (status != DP_OK && fault.rule == NULL))
                fail_msg("%s, entry %d: %s", ortho ? "orthographic" : "perspective", i, dp_status_text(status));
        }
    }
}

/* How wide a picture may be, and how far off its axis: on either axis, just within and just beyond. */
TEST(test_edges) {
    static const struct {
        int ortho, good;
        double half, centre; /* the centre in halves */
    } rows[] = {{0, 1, 999.9, 0},  {0, 0, 1000.1, 0}, {0, 1, 1.1e-9, 0},  {0, 0, 0.9e-9, 0},  {0, 1, 1, 998.9},
                {0, 0, 1, 999.1},  {0, 1, 1, -998.9}, {0, 0, 1, -999.1},  {0, 1, 250, 2.99},  {0, 0, 250, 3.01},
                {1, 1, 0.9e12, 0}, {1, 0, 1.1e12, 0}, {1, 1, 1.1e-12, 0}, {1, 0, 0.9e-12, 0}, {1, 1, 1e11, 8.9},
                {1, 0, 1e11, 9.1}, {1, 0, 1e11, -9.1}};
    for (size_t i = 0; i < 2 * sizeof rows / sizeof rows[0]; i++) {
        const int axis = (int)(i % 2), ortho = rows[i / 2].ortho;
        double m[ENTRIES] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1.25, -0.25, 0, 0, 1, 0};
        dp_matrix_fault fault = {NULL, {0}};
        dp_projection p;
        m[14] = !ortho;
        m[15] = ortho;
        m[5 * axis] = 1 / rows[i / 2].half;
        m[4 * axis + (ortho ? 3 : 2)] = rows[i / 2].centre;
        const dp_status got = dp_projection_init(&p, m, 0, 0, &fault);
        if (got != (rows[i / 2].good ? DP_OK : DP_ERROR_MATRIX))
            fail_msg("half %g, centre %g: %s", rows[i / 2].half, rows[i / 2].centre, fault.rule);
        assert_true(rows[i / 2].good || strstr(fault.rule, "edges") != NULL);
    }
}

/* ---- What rounding left of the planes ---- */

/* The planes of a third row c, e by hand: NDC depth is c + e/z, or c z + e, and ends at 0 or -1 and at 1. */
static void by_hand(const matrix_case *m, long double c, long double e, long double planes[2]) {
    const dp_mapping_row *row = dp_mapping_get(m->mapping);
    const long double ends[2] = {row->ndc_signed ? -1 : 0, 1};
    for (int k = 0; k < 2; k++) {
        const long double end = ends[k ^ (row->reversed != 0)];
        planes[k] = m->ortho ? (end - e) / c : end == c ? (long double)INFINITY : e / (end - c);
        if (!m->ortho && planes[k] < 0)
            planes[k] = INFINITY;
    }
}

static int as_wide(double got, long double want, long double width) {
    return got == want || fabsl(got - want) <= 1e-6L * width + 1e-15L * fabsl(want);
}

/* Entries to binary32: the planes that were, and no more than half a unit of each entry makes of them by hand. */
TEST(test_planes_of_floats) {
    tally t = {.name = "planes of entries of binary32"};
    rng r = rng_make("planes of floats");
    for (uint64_t k = test_cases(1000, 20000, 1000000); k > 0; k--) {
        const matrix_case m = any_case(&r);
        double rows[ENTRIES], columns[ENTRIES];
        dp_projection p;
        dp_planes at = {0}, turned = {0};
        for (int i = 0; i < ENTRIES; i++)
            rows[i] = (double)(float)m.rows[i];
        rows[0] = (double)1.1F; /* long, and of no matter to depth */
        for (int i = 0; i < ENTRIES; i++)
            columns[i % 4 * 4 + i / 4] = rows[i];
        const dp_mapping_row *row = dp_mapping_get(m.mapping);
        if (dp_projection_init(&p, rows, row->ndc_signed, row->reversed, NULL) != DP_OK || p.reversed != row->reversed)
            continue;
        const dp_status status = dp_projection_planes(&at, &p, rows, NULL, NULL);
        TALLY(&t,
              status == DP_OK && dp_projection_planes(&turned, &p, columns, NULL, NULL) == DP_OK &&
                  memcmp(&at, &turned, sizeof at) == 0,
              "%s by columns", row->name);
        TALLY(&t,
              at.near_least <= m.znear && m.znear <= at.near_most && at.far_least <= m.zfar && m.zfar <= at.far_most,
              "%s %.17g..%.17g: %.17g to %.17g, %.17g to %.17g", row->name, m.znear, m.zfar, at.near_least,
              at.near_most, at.far_least, at.far_most);
        long double least[2] = {INFINITY, INFINITY}, most[2] = {-INFINITY, -INFINITY};
        for (int i = 0; i < 4; i++) {
            const float c = (float)rows[10], e = (float)rows[11], way = i & 1 ? INFINITY : -INFINITY;
            const long double at_c = c == 0 ? 0 : ((long double)c + nextafterf(c, way)) / 2;
            const long double at_e = e == 0 ? 0 : ((long double)e + nextafterf(e, i & 2 ? INFINITY : -INFINITY)) / 2;
            long double planes[2];
            by_hand(&m, m.backwards ? -at_c : at_c, at_e, planes);
            for (int j = 0; j < 2; j++) {
                least[j] = fminl(least[j], planes[j]);
                most[j] = fmaxl(most[j], planes[j]);
            }
        }
        TALLY(&t,
              as_wide(at.near_least, least[0], most[0] - least[0]) &&
                  as_wide(at.near_most, most[0], most[0] - least[0]) &&
                  as_wide(at.far_least, least[1], isinf(most[1]) ? least[1] : most[1] - least[1]) &&
                  as_wide(at.far_most, most[1], most[1] - least[1]),
              "%s%s %.17g..%.17g: %.17g to %.17g, not %.17Lg to %.17Lg", row->name, m.ortho ? " ortho" : "", m.znear,
              m.zfar, at.far_least, at.far_most, least[1], most[1]);
        char shown[512];
        snprintf(shown, sizeof shown, "%.*g", at.far_digits, p.zfar);
        const double rounded = strtod(shown, NULL);
        TALLY(&t, rounded >= at.far_least && rounded <= at.far_most, "%s: %s is not in %.17g to %.17g", row->name,
              shown, at.far_least, at.far_most);
        snprintf(shown, sizeof shown, "%.*g", at.far_digits - 1, p.zfar);
        const double shorter = strtod(shown, NULL);
        TALLY(&t, at.far_digits == 1 || isinf(p.zfar) || shorter < at.far_least || shorter > at.far_most,
              "%s: %s lies in %.17g to %.17g, too", row->name, shown, at.far_least, at.far_most);
    }
    tally_end(&t);
}

/* The nearest near plane and the farthest far plane over the corners of a picture, of an oblique matrix for [0, 1]. */
static void oblique_by_hand(const long double m[ENTRIES], long double planes[2]) {
    planes[0] = INFINITY;
    planes[1] = 0;
    for (int i = 0; i < 4; i++) {
        const long double u = ((i & 1 ? 1 : -1) - m[2]) / m[0], v = ((i & 2 ? 1 : -1) - m[6]) / m[5];
        const long double c = m[10] + m[8] * u + m[9] * v;
        planes[0] = fminl(planes[0], m[11] / -c);
        planes[1] = fmaxl(planes[1], 1 - c < 0 ? m[11] / (1 - c) : (long double)INFINITY);
    }
}

static void any_oblique(rng *r, double m[ENTRIES]) {
    const double all[ENTRIES] = {rng_uniform(r, 0.5, 3),
                                 0,
                                 rng_uniform(r, -0.5, 0.5),
                                 0,
                                 0,
                                 rng_uniform(r, 0.5, 3),
                                 rng_uniform(r, -0.5, 0.5),
                                 0,
                                 rng_log(r, 1e-6, 0.05),
                                 -rng_log(r, 1e-6, 0.05),
                                 rng_uniform(r, 1.2, 2),
                                 -rng_uniform(r, 0.1, 2),
                                 0,
                                 0,
                                 1,
                                 0};
    memcpy(m, all, sizeof all);
}

/* An entry half a unit in the last place below or above, of binary32 or of binary64. */
static long double half_unit(double x, bool single, int side) {
    const double way = side == 0 ? (double)-INFINITY : (double)INFINITY;
    if (x == 0)
        return 0;
    return ((long double)x + (single ? (long double)nextafterf((float)x, (float)way) : nextafter(x, way))) / 2;
}

/*
 * Oblique near planes: no end within what half a unit of each entry makes by hand, whatever is rounded on the way; of
 * binary32 that is all.
 */
TEST(test_planes_of_oblique) {
    static const int shaping[] = {0, 2, 5, 6, 8, 9, 10, 11};
    tally t = {.name = "planes of oblique matrices"};
    rng r = rng_make("oblique planes");
    for (uint64_t k = test_cases(600, 4000, 100000); k > 0; k--) {
        const bool single = k % 2 == 0;
        double m[ENTRIES];
        long double least[2] = {INFINITY, INFINITY}, most[2] = {0, 0};
        dp_projection p;
        dp_planes at;
        any_oblique(&r, m);
        for (int i = 0; i < ENTRIES; i++)
            m[i] = single ? (double)(float)m[i] : m[i];
        if (dp_projection_init(&p, m, 0, 0, NULL) != DP_OK)
            continue;
        for (int corner = 0; corner < 256; corner++) {
            long double entries[ENTRIES], planes[2];
            for (int i = 0; i < ENTRIES; i++)
                entries[i] = (long double)m[i];
            for (int i = 0; i < 8; i++)
                entries[shaping[i]] = half_unit(m[shaping[i]], single, corner >> i & 1);
            oblique_by_hand(entries, planes);
            for (int j = 0; j < 2; j++) {
                least[j] = fminl(least[j], planes[j]);
                most[j] = fmaxl(most[j], planes[j]);
            }
        }
        assert_int_equal(dp_projection_planes(&at, &p, m, NULL, NULL), DP_OK);
        const double is[4] = {at.near_least, at.near_most, at.far_least, at.far_most};
        for (int i = 0; i < 4; i++) {
            const long double ends[2] = {least[i / 2], most[i / 2]}, width = ends[1] - ends[0];
            const long double beyond = i % 2 == 0 ? ends[0] - is[i] : is[i] - ends[1];
            TALLY(&t, is[i] == ends[i % 2] || (beyond >= 0 && (!single || beyond <= 1e-5L * width)),
                  "end %d: %.17g, not %.20Lg", i, is[i], ends[i % 2]);
        }
    }
    tally_end(&t);
}

/* Doubles by a unit in the last place, what was typed as it is; and what is refused. */
TEST(test_planes_of_doubles) {
    matrix_case m = {.znear = 0.1, .zfar = 1000, .mapping = DP_MAPPING_D3D};
    const double typed[ENTRIES] = {1.5, 0, 0, 0, 0, 2, 0, 0, 0, 0, -1.25, -0.5, 0, 0, -1, 0};
    dp_projection p;
    dp_planes at = {.near_digits = -5};
    fill(&m);
    assert_int_equal(dp_projection_init(&p, m.rows, 0, 0, NULL), DP_OK);
    assert_int_equal(dp_projection_planes(&at, &p, m.rows, NULL, NULL), DP_OK);
    assert_true(at.far_least <= 1000 && 1000 <= at.far_most && at.far_most - at.far_least < 1e-8 && at.far_digits == 1);
    assert_true(at.near_least <= 0.1 && 0.1 <= at.near_most && at.near_most - at.near_least < 1e-15);
    assert_int_equal(dp_projection_planes(&at, &p, m.rows, m.rows, m.rows), DP_OK);
    assert_true(at.far_least == p.zfar && at.far_most == p.zfar && at.far_digits == 17 && at.near_digits == 17);
    assert_int_equal(dp_projection_init(&p, typed, 0, 0, NULL), DP_OK);
    assert_int_equal(dp_projection_planes(&at, &p, typed, NULL, NULL), DP_OK);
    assert_true(at.far_least == 2 && at.far_most == 2 && at.near_least == 0.4 && at.near_most == 0.4);
    at.near_digits = -5;
    assert_int_equal(dp_projection_planes(&at, &p, m.rows, NULL, NULL), DP_ERROR_MATRIX);
    assert_int_equal(dp_projection_planes(NULL, &p, typed, NULL, NULL), DP_ERROR_NULL);
    assert_int_equal(dp_projection_planes(&at, NULL, typed, NULL, NULL), DP_ERROR_NULL);
    assert_int_equal(dp_projection_planes(&at, &p, NULL, NULL, NULL), DP_ERROR_NULL);
    assert_int_equal(dp_projection_planes(&at, &p, typed, typed, NULL), DP_ERROR_NULL);
    p.mapping = DP_MAPPING_COUNT;
    assert_int_equal(dp_projection_planes(&at, &p, typed, NULL, NULL), DP_ERROR_MATRIX);
    assert_true(at.near_digits == -5);
}
