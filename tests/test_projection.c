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
