/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Places from depth, over random cameras, pixels and depths: no row is farther off than its bound, from a camera at the
 * world's origin or 10^8 near distances away, and bounds are not idle. The exact place is formed here, in long double.
 */

#include <gmp.h>

#include "named.h"
#include "shader/position.h"
#include "support.h"

static const dp_mapping mappings[] = {DP_MAPPING_D3D,         DP_MAPPING_GL,     DP_MAPPING_REVERSED,
                                      DP_MAPPING_GL_REVERSED, DP_MAPPING_LINEAR, DP_MAPPING_LOG};

typedef struct view {
    texture_camera camera;
    camera_spec spec;
} view;

static bool make(rng *r, view *out) {
    dp_spec spec = dp_spec_default();
    dp_setup setup;
    spec.mapping = mappings[rng_below(r, 6)];
    spec.znear = rng_log(r, 1e-3, 100);
    spec.zfar = rng_below(r, 7) == 0 ? INFINITY : spec.znear * rng_log(r, 3, 1e7);
    spec.ortho = rng_below(r, 5) == 0;
    const double size = spec.znear;
    if (spec.ortho && rng_below(r, 2))
        rng_planes(r, &spec.znear, &spec.zfar);
    if (dp_setup_init(&setup, &spec) != DP_OK)
        return false;
    out->spec = camera_spec_default();
    out->spec.width = 1 + (uint32_t)rng_below(r, 4000);
    out->spec.height = 1 + (uint32_t)rng_below(r, 3000);
    out->spec.fov_y = rng_uniform(r, 1, 150);
    out->spec.half_height = rng_log(r, 0.1, 1e4) * size;
    out->spec.yaw = rng_below(r, 8) == 0 ? 0 : rng_uniform(r, -180, 180);
    out->spec.pitch = rng_below(r, 8) == 0 ? 0 : rng_uniform(r, -90, 90);
    const bool moved = rng_below(r, 3) > 0;
    for (int k = 0; k < 3 && moved; k++)
        out->spec.origin[k] = size * rng_log(r, 0.1, 1e8) * (rng_below(r, 2) == 0 ? 1 : -1);
    assert_null(camera_init(&out->camera, &setup, &out->spec));
    return true;
}

static long double eye_of(const dp_spec *s, float d) {
    const long double n = (long double)s->znear, f = (long double)s->zfar, t = (long double)d;
    const bool reversed = s->mapping == DP_MAPPING_REVERSED || s->mapping == DP_MAPPING_GL_REVERSED;
    const long double toward_near = reversed ? t : 1 - t, toward_far = reversed ? 1 - t : t;
    if (s->mapping == DP_MAPPING_LINEAR && !s->ortho)
        return f * t;
    if (s->mapping == DP_MAPPING_LOG)
        return expm1l(t * log1pl((long double)s->log_c * f)) / (long double)s->log_c;
    if (s->ortho)
        return n * toward_near + f * toward_far;
    return 1 / (toward_near / n + (isinf(s->zfar) ? 0 : toward_far / f));
}

/* The distance of a place from where it should be. */
static double off_by(const view *v, uint32_t column, uint32_t row, float d, const float place[3]) {
    const long double degree = 3.14159265358979323846264L / 180, yaw = (long double)v->spec.yaw * degree,
                      pitch = (long double)v->spec.pitch * degree;
    const dp_spec *s = &v->camera.setup.spec;
    const long double hy = s->ortho ? (long double)v->spec.half_height : tanl((long double)v->spec.fov_y * degree / 2);
    const long double hx = hy * v->spec.width / v->spec.height, z = eye_of(s, d), scale = s->ortho ? 1 : z;
    const long double x = (2 * (column + 0.5L) / v->spec.width - 1) * hx * scale;
    const long double y = (1 - 2 * (row + 0.5L) / v->spec.height) * hy * scale;
    const long double right[3] = {cosl(yaw), 0, -sinl(yaw)};
    const long double up[3] = {-sinl(yaw) * sinl(pitch), cosl(pitch), -cosl(yaw) * sinl(pitch)};
    const long double ahead[3] = {sinl(yaw) * cosl(pitch), sinl(pitch), cosl(yaw) * cosl(pitch)};
    long double sum = 0;
    for (int k = 0; k < 3; k++) {
        const long double off =
            ((long double)place[k] - (long double)v->spec.origin[k]) - (x * right[k] + y * up[k] + z * ahead[k]);
        sum += off * off;
    }
    return isnan((double)sum) ? INFINITY : (double)sqrtl(sum);
}

static float depth_of(rng *r, const dp_setup *setup, uint64_t kind) {
    const double n = setup->spec.znear, f = isinf(setup->spec.zfar) ? n * 1e6 : setup->spec.zfar;
    if (kind < 2 && !isinf(setup->spec.zfar))
        return (float)kind;
    return kind % 4 == 0 ? (float)rng_unit(r) : (float)dp_window(setup, n > 0 ? rng_log(r, n, f) : rng_depth(r, n, f));
}

TEST(bounds_hold_and_are_not_idle) {
    rng r = rng_make("position bound");
    for (size_t i = 0; position_get(i) != NULL; i++) {
        const position_row *row = position_get(i);
        tally t = {.name = row->name};
        double most = 0;
        uint64_t near_bound = 0, promised = 0;
        for (uint64_t k = test_cases(400, 8000, 400000); k > 0; k--) {
            view v;
            position_state s;
            if (!make(&r, &v) || !position_applies(row, &v.camera))
                continue;
            position_prepare(&s, &v.camera);
            for (uint64_t q = 0; q < 8; q++) {
                const uint32_t column = (uint32_t)rng_below(&r, v.spec.width),
                               line = (uint32_t)rng_below(&r, v.spec.height);
                const float d = depth_of(&r, &v.camera.setup, q);
                float place[3];
                row->run(&s, line, column, &d, 1, &place[0], &place[1], &place[2]);
                const double off = off_by(&v, column, line, d, place);
                const double bound = position_bound(row, &v.camera, column, line, d);
                const dp_spec *c = &v.camera.setup.spec;
                TALLY(&t, off <= bound, "mapping %d, ortho %d, near %g, far %g, pixel %u %u, d %.9g: %g above %g",
                      (int)c->mapping, (int)c->ortho, c->znear, c->zfar, column, line, (double)d, off, bound);
                if (isinf(bound))
                    continue;
                promised++;
                near_bound += off >= bound / 32;
                most = fmax(most, off / bound);
            }
        }
        TALLY(&t, most >= 0.25, "the worst takes %g of its bound", most);
        TALLY(&t, near_bound >= promised / 2, "%llu of %llu within a factor of 32 of the bound",
              (unsigned long long)near_bound, (unsigned long long)promised);
        tally_end(&t);
        print_message("# %s: %llu places, at most %.2g of the bound, %.3g %% within a factor of 32\n", row->name,
                      (unsigned long long)promised, most, 100.0 * (double)near_bound / (double)promised);
    }
}

/* The hardest places known: no term of a bound is too small by half, nor too large. Where the bound is far above, the
 * share says that it is what it was. */
static void check_hard(const vector_row *row, void *context) {
    tally *t = context;
    const position_row *way = position_find(vector_text(row, 0));
    dp_spec spec = dp_spec_default();
    dp_setup setup;
    view v = {.spec = camera_spec_default()};
    position_state s;
    float place[3];
    spec.mapping = (dp_mapping)vector_number(row, 1);
    spec.ortho = vector_number(row, 2) != 0;
    spec.znear = vector_number(row, 3);
    spec.zfar = vector_number(row, 4);
    v.spec.width = (uint32_t)vector_number(row, 5);
    v.spec.height = (uint32_t)vector_number(row, 6);
    v.spec.fov_y = vector_number(row, 7);
    v.spec.half_height = vector_number(row, 8);
    v.spec.yaw = vector_number(row, 9);
    v.spec.pitch = vector_number(row, 10);
    for (int k = 0; k < 3; k++)
        v.spec.origin[k] = vector_number(row, 11 + k);
    const uint32_t column = (uint32_t)vector_number(row, 14), line = (uint32_t)vector_number(row, 15);
    const float d = (float)vector_number(row, 16);
    assert_non_null(way);
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    assert_null(camera_init(&v.camera, &setup, &v.spec));
    position_prepare(&s, &v.camera);
    way->run(&s, line, column, &d, 1, &place[0], &place[1], &place[2]);
    const double off = off_by(&v, column, line, d, place), bound = position_bound(way, &v.camera, column, line, d);
    TALLY(t, off <= bound, "%s, line %d: %g above %g", way->name, row->line, off, bound);
    TALLY(t, fabs(off / bound / vector_number(row, 17) - 1) <= 0.03, "%s, line %d: %g is %g of %g", way->name,
          row->line, off, off / bound, bound);
}

TEST(the_hardest_places_need_each_term) {
    tally t = {.name = "hardest"};
    vectors_read("position.txt", check_hard, &t);
    tally_end(&t);
}

/* The bound of depthprec(7) for a matrix at the world's origin: units of z/n, at far and over all directions of
 * view. */
TEST(a_matrix_loses_what_is_said) {
    static const struct {
        dp_mapping mapping;
        double least, most;
    } said[] = {{DP_MAPPING_D3D, 6, 7.1}, {DP_MAPPING_GL, 3, 3.8}, {DP_MAPPING_GL_REVERSED, 3, 3.8}};
    enum { STEP = 5, TURNS = 180 / STEP + 1, WIDTH = 64, HEIGHT = 36, PIXELS = 5 };
    const double ratio = 1e4;
    for (int i = 0; i < 3; i++) {
        double least = INFINITY, most = 0;
        for (int k = 0; k < TURNS * TURNS * PIXELS; k++) {
            const int turn = k / PIXELS;
            const uint32_t column = (uint32_t)(k % PIXELS) * (WIDTH - 1) / (PIXELS - 1), row = column * HEIGHT / WIDTH;
            dp_spec spec = dp_spec_default();
            dp_setup setup;
            view v = {.spec = camera_spec_default()};
            double place[3];
            spec.mapping = said[i].mapping;
            spec.zfar = ratio * spec.znear;
            v.spec.width = WIDTH;
            v.spec.height = HEIGHT;
            v.spec.yaw = STEP * (turn % TURNS);
            v.spec.pitch = STEP * (turn / TURNS) - 90;
            assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
            assert_null(camera_init(&v.camera, &setup, &v.spec));
            const float d = setup.reversed ? 0 : 1;
            position_exact(&v.camera, row, column, (double)d, place, NULL);
            const double distance = sqrt(place[0] * place[0] + place[1] * place[1] + place[2] * place[2]);
            const double units =
                position_bound(position_find("matrix"), &v.camera, column, row, d) / distance / ratio * 0x1p24;
            least = fmin(least, units);
            most = fmax(most, units);
        }
        print_message("# mapping %d: %.3g to %.3g\n", (int)said[i].mapping, least, most);
        assert_true(least >= said[i].least && least <= 1.1 * said[i].least);
        assert_true(most <= said[i].most && most >= 0.9 * said[i].most);
    }
}

/* ---- The inverse matrix ------------------------------------------------------------------------------------------ */

/* Elimination in rationals: the right half, 1, becomes the inverse of the left. */
static void eliminate(mpq_t m[4][8]) {
    mpq_t factor;
    mpq_init(factor);
    for (int c = 0; c < 4; c++) {
        int pivot = c;
        while (mpq_sgn(m[pivot][c]) == 0)
            assert_in_range(++pivot, 0, 3);
        for (int k = 0; k < 8; k++)
            mpq_swap(m[c][k], m[pivot][k]);
        mpq_inv(factor, m[c][c]);
        for (int k = 0; k < 8; k++)
            mpq_mul(m[c][k], m[c][k], factor);
        for (int r = 0; r < 4; r++)
            for (int k = 7; k >= c && r != c; k--) {
                mpq_mul(factor, m[r][c], m[c][k]);
                mpq_sub(m[r][k], m[r][k], factor);
            }
    }
    mpq_clear(factor);
}

/* What elimination makes a column of the inverse of `m` of, in a row: |m| |inverse| of the column, times the row's
 * largest entry. */
static double terms_of(const double m[16], const double inverse[16], int row, int column) {
    double largest = 0, sum = 0;
    for (int i = 0; i < 4; i++) {
        largest = fmax(largest, fabs(inverse[4 * row + i]));
        for (int k = 0; k < 4; k++)
            sum += fabs(m[4 * i + k] * inverse[4 * k + column]);
    }
    return largest * sum;
}

/* How far an inverse is off in its worst entry, in units of 2^-24 of the entry and 2^-74 of its terms. */
static double inverse_off(const texture_camera *camera, const float inverse[16]) {
    double forth[16], exact[16], worst = 0;
    mpq_t m[4][8], got;
    mpq_init(got);
    position_matrix(camera, forth);
    for (int r = 0; r < 4; r++)
        for (int k = 0; k < 8; k++) {
            mpq_init(m[r][k]);
            mpq_set_d(m[r][k], k < 4 ? (double)(float)forth[4 * r + k] : k - 4 == r);
        }
    eliminate(m);
    for (int i = 0; i < 16; i++)
        exact[i] = mpq_get_d(m[i / 4][4 + i % 4]);
    for (int i = 0; i < 16; i++) {
        mpq_set_d(got, (double)inverse[i]);
        mpq_sub(got, got, m[i / 4][4 + i % 4]);
        const double off = fabs(mpq_get_d(got));
        if (off > 0x1p-150) /* half a step of the smallest numbers */
            worst = fmax(worst, off / (fabs(exact[i]) * 0x1p-24 + terms_of(forth, exact, i / 4, i % 4) * 0x1p-74));
    }
    for (int i = 0; i < 32; i++)
        mpq_clear(m[i / 8][i % 8]);
    mpq_clear(got);
    return worst;
}

/* The bound counts one rounding of an entry, and nothing of the elimination before it. */
TEST(inverses_are_rounded_once) {
    rng r = rng_make("inverse");
    tally t = {.name = "inverse"};
    for (uint64_t k = test_cases(1000, 4000, 40000); k > 0; k--) {
        view v;
        position_state s;
        if (!make(&r, &v) || !position_applies(position_find("matrix"), &v.camera))
            continue;
        const float d = depth_of(&r, &v.camera.setup, 2);
        if (isinf(position_bound(position_find("matrix"), &v.camera, 0, 0, d)))
            continue;
        position_prepare(&s, &v.camera);
        const double off = inverse_off(&v.camera, s.inverse);
        TALLY(&t, off <= 1 + 1e-3, "near %g, far %g, origin %g: an entry is off by %g units", v.camera.setup.spec.znear,
              v.camera.setup.spec.zfar, v.spec.origin[0], off);
    }
    tally_end(&t);
}
