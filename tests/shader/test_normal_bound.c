/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * How wrong normals are: the bound of depthprec(7) on planes, and what is measured on synthetic images,
 * counted again here.
 */
#include "named.h"
#include "texture/normal_errors.h"
#include "views.h"

static const double PI = 3.14159265358979323846;

/* The bound: never passed on planes of any tilt in any format, and reached by some. Long: cases, loops and verdict. */
TEST(planes_are_within_the_bound) {
    static const char *const formats[] = {"unorm16", "unorm24", "fp16", "fp32"};
    static const dp_mapping mappings[] = {DP_MAPPING_D3D, DP_MAPPING_REVERSED};
    static const struct {
        uint32_t width, height;
        double extent;
    } sizes[] = {{64, 48, 60}, {1920, 1080, 60}, {7, 5, 100}, {3840, 2160, 30}, {65536, 4096, 5}};
    const normal_row *method = normal_find("projective");
    rng r = rng_make("normal bound");
    tally t = {.name = "plane bound"};
    for (int kind = 0; kind < 16; kind++) {
        double tight = 0;
        uint64_t certain = 0;
        for (uint64_t k = test_cases(2000, 4000, 100000); k > 0; k--) {
            const size_t size = rng_below(&r, 5);
            const double ratio = rng_log(&r, 20, 1e5), znear = rng_log(&r, 1e-3, 10);
            texture_camera c =
                view_camera(formats[kind % 4], mappings[kind / 4 % 2], znear, znear * ratio, kind / 8 == 1,
                            sizes[size].width, sizes[size].height, kind / 8 == 1 ? znear * 10 : sizes[size].extent);
            const uint32_t column = 1 + (uint32_t)rng_below(&r, c.width - 2);
            const uint32_t row = 1 + (uint32_t)rng_below(&r, c.height - 2);
            const double grazing = rng_log(&r, 1e-4, PI / 2), tilt = PI / 2 - grazing;
            const double z = rng_log(&r, znear * 1.01, znear * ratio * 0.99);
            double n[3];
            const double d = view_tilted(&r, &c, column, row, z, tilt, n);
            float eye[5][5];
            bool inside = true;
            for (int j = -2; j <= 2; j++)
                for (int i = -2; i <= 2; i++) {
                    const double there = view_plane(&c, n, d, (double)column + i, (double)row + j);
                    const bool near_by = abs(i) + abs(j) <= 1, in_view = there >= znear && there <= znear * ratio;
                    inside = inside && (in_view || !near_by);
                    eye[2 + j][2 + i] = in_view ? (float)dp_stored(&c.setup, dp_code(&c.setup, there)) : (float)NAN;
                }
            const normal_plane plane = {{n[0], n[1], n[2]}, d};
            const double error = normal_plane_error(&c, column, row, &plane, 0x1p-24);
            if (!inside) {
                TALLY(&t, error == INFINITY, "a plane that leaves the view has error %g", error);
                continue;
            }
            const double bound = normal_plane_bound(&c, column, row, &plane, error);
            normal_rows in = {.camera = &c, .row = row, .column = column, .count = 1};
            float slope[2 * NORMAL_REACH + 1], lines[2 * NORMAL_REACH + 1][2 * NORMAL_REACH + 1], normal[3];
            for (int i = -NORMAL_REACH; i <= NORMAL_REACH; i++)
                slope[NORMAL_REACH + i] = (float)camera_slope_x(&c, (double)column + i);
            for (int j = 0; j <= 2 * NORMAL_REACH; j++) {
                for (int i = 0; i <= 2 * NORMAL_REACH; i++)
                    lines[j][i] = abs(i - NORMAL_REACH) <= 2 && abs(j - NORMAL_REACH) <= 2
                                      ? eye[j - NORMAL_REACH + 2][i - NORMAL_REACH + 2]
                                      : (float)NAN;
                in.rows[j] = lines[j] + NORMAL_REACH;
            }
            in.slope_x = slope + NORMAL_REACH;
            method->run(&in, &normal[0], &normal[1], &normal[2]);
            const double got[3] = {(double)normal[0], (double)normal[1], (double)normal[2]};
            const double angle = normal_angle(n, got);
            TALLY(&t, angle <= bound, "%s %s %s, near %g ratio %g z %g, %g from grazing, %ux%u at %u, %u: %g > %g",
                  formats[kind % 4], kind / 4 % 2 ? "reversed" : "d3d", kind / 8 ? "ortho" : "perspective", znear,
                  ratio, z, grazing, c.width, c.height, column, row, angle, bound);
            if (bound < PI / 2) {
                certain++;
                if (bound > 1e-4)
                    tight = fmax(tight, angle / bound);
            }
        }
        TALLY(&t, certain > 20 && tight > 0.35, "%s %s %s: at most %g of a bound above 1e-4, in %u planes",
              formats[kind % 4], kind / 4 % 2 ? "reversed" : "d3d", kind / 8 ? "ortho" : "perspective", tight,
              (unsigned)certain);
    }
    tally_end(&t);
}

/* The corners of the cube of errors are the worst: no error within it does more, and some do nearly as much. */
TEST(the_bound_is_that_of_the_worst_errors) {
    rng r = rng_make("normal corners");
    tally t = {.name = "worst errors"};
    double used = 0;
    for (uint64_t k = test_cases(300, 3000, 30000); k > 0; k--) {
        const bool ortho = rng_below(&r, 2) == 0;
        texture_camera c = view_camera("unorm24", DP_MAPPING_D3D, 0.1, 1000, ortho, 640, 480, ortho ? 5 : 60);
        const double column = (double)rng_below(&r, 640), row = (double)rng_below(&r, 480);
        double n[3];
        const double d = view_tilted(&r, &c, column, row, 10, rng_uniform(&r, 0, 1.5), n);
        const normal_plane plane = {{n[0], n[1], n[2]}, d};
        const double step = ortho ? 2 * c.half[1] / 480 : 2 * c.half[1] / 480 / 10; /* of a slope of 45 degrees */
        const double error = step * rng_log(&r, 1e-3, 2);
        const double bound = normal_plane_bound(&c, (uint32_t)column, (uint32_t)row, &plane, error);
        for (int trial = 0; trial < 40; trial++) {
            double places[3][3];
            const int x = rng_below(&r, 2) ? 1 : -1, y = rng_below(&r, 2) ? 1 : -1;
            for (int i = 0; i < 3; i++) {
                const double at_column = column + (i == 1 ? x : 0), at_row = row + (i == 2 ? y : 0);
                const double z = view_plane(&c, n, d, at_column, at_row);
                const double off = trial % 2 ? rng_uniform(&r, -error, error) : rng_below(&r, 2) ? error : -error;
                const double wrong = ortho ? z + off : 1 / (1 / z + off);
                double sx, sy;
                view_slopes(&c, at_column, at_row, &sx, &sy);
                places[i][0] = sx * (ortho ? 1 : wrong);
                places[i][1] = sy * (ortho ? 1 : wrong);
                places[i][2] = wrong;
                if (!(wrong > 0))
                    goto next; /* behind the eye: not an eye depth */
            }
            double a[3], b[3], cross[3];
            for (int i = 0; i < 3; i++) {
                a[i] = places[1][i] - places[0][i];
                b[i] = places[2][i] - places[0][i];
            }
            const double sign = x * y > 0 ? 1 : -1; /* row numbers grow downwards */
            for (int i = 0; i < 3; i++)
                cross[i] = sign * (a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3]);
            const double angle = normal_angle(n, cross);
            TALLY(&t, angle <= bound, "%s: error %g turns it by %g, bound %g", ortho ? "ortho" : "perspective", error,
                  angle, bound);
            used = fmax(used, bound < PI / 2 ? angle / bound : 0);
        }
    next:;
    }
    tally_end(&t);
    assert_true(used > 0.999);
}

/* ---- The hardest known ------------------------------------------------------------------------------------------ */

/* Runs "projective" on the five depths of a row and the five of a column that meet in their middle. */
static void normal_of(const texture_camera *c, uint32_t column, uint32_t row, const float across[5],
                      const float downwards[5], double out[3]) {
    enum { SIDE = 2 * NORMAL_REACH + 1 };
    float slope[SIDE], lines[SIDE][SIDE], normal[3];
    normal_rows in = {.camera = c, .row = row, .column = column, .count = 1, .slope_x = slope + NORMAL_REACH};
    for (int j = 0; j < SIDE; j++) {
        slope[j] = (float)camera_slope_x(c, (double)column + j - NORMAL_REACH);
        in.rows[j] = lines[j] + NORMAL_REACH;
        for (int i = 0; i < SIDE; i++)
            lines[j][i] = (float)NAN;
    }
    for (int k = 0; k < 5; k++) {
        lines[NORMAL_REACH + k - 2][NORMAL_REACH] = downwards[k];
        lines[NORMAL_REACH][NORMAL_REACH + k - 2] = across[k];
    }
    normal_find("projective")->run(&in, &normal[0], &normal[1], &normal[2]);
    for (int k = 0; k < 3; k++)
        out[k] = (double)normal[k];
}

static void judge_hard(const vector_row *row, tally *t, double angle, double bound, double share) {
    TALLY(t, angle <= bound, "line %d: %g above %g", row->line, angle, bound);
    TALLY(t, angle >= 0.97 * share * bound, "line %d: %g is %g of %g", row->line, angle, angle / bound, bound);
}

/* Three depths that are binary32 numbers have a plane through them, so that all error is the method's rounding. */
static void check_rounding(const vector_row *row, tally *t) {
    const bool ortho = vector_number(row, 1) != 0;
    const uint32_t column = (uint32_t)vector_number(row, 5), line = (uint32_t)vector_number(row, 6);
    const int x = vector_number(row, 7) != 0 ? -1 : 1, y = vector_number(row, 8) != 0 ? 1 : -1;
    const texture_camera c = view_camera("fp32", DP_MAPPING_REVERSED, 0.1, 1000, ortho, (uint32_t)vector_number(row, 2),
                                         (uint32_t)vector_number(row, 3), vector_number(row, 4));
    float across[5], downwards[5];
    long double place[3][3], a[3], b[3];
    double n[3], got[3];
    for (int k = 0; k < 5; k++)
        across[k] = downwards[k] = (float)NAN;
    across[2] = downwards[2] = (float)vector_number(row, 9);
    across[2 + x] = (float)vector_number(row, 10);
    downwards[2 + y] = (float)vector_number(row, 11);
    for (int i = 0; i < 3; i++) {
        const long double z = (long double)(i == 0 ? across[2] : i == 1 ? across[2 + x] : downwards[2 + y]);
        const long double at_column = (long double)column + (i == 1 ? x : 0) + 0.5L;
        const long double at_row = (long double)line + (i == 2 ? y : 0) + 0.5L;
        place[i][0] = (2 * at_column / c.width - 1) * (long double)c.half[0] * (ortho ? 1 : z);
        place[i][1] = (1 - 2 * at_row / c.height) * (long double)c.half[1] * (ortho ? 1 : z);
        place[i][2] = z;
    }
    for (int i = 0; i < 3; i++) {
        a[i] = place[1][i] - place[0][i];
        b[i] = place[2][i] - place[0][i];
    }
    for (int i = 0; i < 3; i++) /* rows run downwards, and the normal towards the camera */
        n[i] = (double)((x * y > 0 ? 1 : -1) * (a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3]));
    const double offset = (double)(n[0] * place[0][0] + n[1] * place[0][1] + n[2] * place[0][2]);
    const normal_plane plane = {{n[0], n[1], n[2]}, offset};
    normal_of(&c, column, line, across, downwards, got);
    judge_hard(row, t, normal_angle(n, got), normal_plane_bound(&c, column, line, &plane, 0), vector_number(row, 12));
}

/* Stored depths of a plane: half a cell, or reading it back, is most of what they are off by. */
static void check_stored(const vector_row *row, tally *t) {
    const uint32_t column = (uint32_t)vector_number(row, 7), line = (uint32_t)vector_number(row, 8);
    const double n[3] = {vector_number(row, 11), vector_number(row, 12), vector_number(row, 13)};
    const texture_camera c =
        view_camera(vector_text(row, 1), (dp_mapping)vector_number(row, 2), vector_number(row, 9),
                    vector_number(row, 10), vector_number(row, 3) != 0, (uint32_t)vector_number(row, 4),
                    (uint32_t)vector_number(row, 5), vector_number(row, 6));
    const normal_plane plane = normal_plane_at(&c, column, line, vector_number(row, 14), n);
    float eye[2][5];
    double got[3];
    for (int k = 0; k < 10; k++) {
        const int away = k % 5 - 2;
        const double z =
            view_plane(&c, n, plane.offset, (double)column + (k < 5 ? away : 0), (double)line + (k < 5 ? 0 : away));
        const bool in_view = z >= c.setup.spec.znear && z <= c.setup.spec.zfar;
        eye[k / 5][k % 5] = in_view ? (float)dp_stored(&c.setup, dp_code(&c.setup, z)) : (float)NAN;
    }
    normal_of(&c, column, line, eye[0], eye[1], got);
    const double angle = normal_angle(n, got), error = normal_plane_error(&c, column, line, &plane, 0x1p-24);
    judge_hard(row, t, fmin(angle, PI - angle), normal_plane_bound(&c, column, line, &plane, error),
               vector_number(row, 15));
}

static void check_hard(const vector_row *row, void *context) {
    (strcmp(vector_text(row, 0), "rounding") == 0 ? check_rounding : check_stored)(row, context);
}

TEST(the_hardest_planes_need_each_term) {
    tally t = {.name = "hardest"};
    vectors_read("normal.txt", check_hard, &t);
    tally_end(&t);
}

/* ---- What is stated about synthetic images ----------------------------------------------------------------------- */

/* A slanted wall, its lower half nearer by a step: edges that a method can pass on either side. */
static void stepped(const texture_camera *c, const double *p, double column, double row, synthetic_hit *out) {
    double n[3] = {p[1], p[2], -1};
    const bool near_one = row >= c->height / 2 + 1 && column >= c->width / 3 + 1;
    view_unit(n);
    *out = (synthetic_hit){.z = view_plane(c, n, n[2] * (near_one ? p[0] * p[3] : p[0]), column, row),
                           .normal = {n[0], n[1], n[2]},
                           .surface = near_one ? 2 : 1};
}

/* Measured in plain words: every pixel from run() and sides(). */
TEST(measures_count_what_they_say) {
    const synthetic_row shown = {.name = "stepped", .hit = stepped};
    const double parameters[4] = {4, 1.0, 0.1, 0.9993};
    texture_camera c = view_camera("unorm24", DP_MAPPING_D3D, 0.3, 3000, false, 60, 40, 60);
    normal_measured by[NORMAL_METHODS];
    for (size_t m = 0; normal_get(m) != NULL; m++) {
        const normal_row *method = normal_get(m);
        normal_measured *got = &by[m];
        assert_true(normal_measure(method, &c, &shown, parameters, 0, 40, got));
        view_picture p = view_picture_of(&c);
        for (uint32_t i = 0; i < 60 * 40; i++) {
            synthetic_hit hit;
            stepped(&c, parameters, i % 60, i / 60, &hit);
            p.eye[i] = (float)dp_stored(&c.setup, dp_code(&c.setup, hit.z));
        }
        view_run(method, &c, &p);
        uint64_t missing = 0, above[2] = {0, 0}, count[2] = {0, 0};
        double sum[2] = {0, 0}, most[2] = {0, 0};
        for (uint32_t i = 0; i < 60 * 40; i++) {
            synthetic_hit hit, beside;
            double found[3];
            view_normal(&p, i % 60, i / 60, found);
            stepped(&c, parameters, i % 60, i / 60, &hit);
            bool edge = false;
            for (int k = method->step; k <= method->reach; k += method->step)
                for (int s = 0; s < 4; s++) {
                    const int x = (int)(i % 60) + (s == 0 ? k : s == 1 ? -k : 0);
                    const int y = (int)(i / 60) + (s == 2 ? k : s == 3 ? -k : 0);
                    stepped(&c, parameters, x, y, &beside);
                    const bool there = x >= 0 && y >= 0 && x < 60 && y < 40;
                    edge = edge || (there && beside.surface != hit.surface);
                }
            const double angle = normal_angle(hit.normal, found);
            if (isnan(angle)) {
                missing++;
                continue;
            }
            const normal_spread *s = edge ? &got->edges : &got->inside;
            count[edge]++;
            sum[edge] += angle;
            most[edge] = fmax(most[edge], angle);
            above[edge] += angle > s->p99 * (1 + 1e-6);
        }
        const normal_spread *spreads[2] = {&got->inside, &got->edges};
        assert_true(got->drawn == 2400 && got->sky == 0 && got->missing == missing);
        for (int e = 0; e < 2; e++) {
            assert_true(spreads[e]->count == count[e] && spreads[e]->max == most[e]);
            assert_relative(spreads[e]->mean, sum[e] / (double)count[e], 1e-12);
            assert_true(above[e] * 100 <= count[e] && spreads[e]->p99 <= spreads[e]->max);
        }
        view_picture_free(&p);
    }
    /* low and medium cannot help taking wrong sides; high does because z bends along a plane; 1/z does not. */
    assert_true(by[0].wrong > 50 && by[1].wrong > 50 && by[2].wrong > 30 && by[3].wrong > 30 && by[4].wrong > 10);
    assert_true(by[5].wrong == 0 && by[5].edges.max < 5e-5);
    for (size_t m = 0; m < 5; m++)
        assert_true(by[m].edges.max > 5e-3);
}

/* A sphere before a wall, the sphere's own normals as reference. */
static void ball(const texture_camera *c, const double *p, double column, double row, synthetic_hit *out) {
    double sx, sy;
    view_slopes(c, column, row, &sx, &sy);
    const double q = sx * sx + sy * sy + 1, e = p[0] * p[0] - p[1] * p[1], under = p[0] * p[0] - q * e;
    *out = (synthetic_hit){.z = p[2], .normal = {0, 0, -1}, .surface = 2};
    if (under < 0)
        return;
    const double z = e / (p[0] + sqrt(under));
    *out = (synthetic_hit){.z = z, .normal = {sx * z / p[1], sy * z / p[1], (z - p[0]) / p[1]}, .surface = 1};
}

TEST(spheres_and_their_outline) {
    const synthetic_row shown = {.name = "ball", .hit = ball};
    const double parameters[4] = {10, 3, 14};
    texture_camera c = view_camera("fp32", DP_MAPPING_REVERSED, 0.1, 1000, false, 256, 256, 45);
    normal_measured by[NORMAL_METHODS];
    for (size_t m = 0; normal_get(m) != NULL; m++)
        assert_true(normal_measure(normal_get(m), &c, &shown, parameters, 0, 256, &by[m]));
    for (size_t m = 0; normal_get(m) != NULL; m++)
        assert_true(by[m].inside.mean < (m < NORMAL_LOW_HALF ? 0.05 : 0.3) && by[m].inside.count > 55000);
    assert_true(by[0].wrong > 300 && by[1].wrong > 300 && by[3].wrong * 20 < by[2].wrong);
    assert_true(by[5].wrong * 20 < by[2].wrong && by[5].edges.mean * 5 < by[2].edges.mean);
    print_message("# wrong sides:");
    for (size_t m = 0; normal_get(m) != NULL; m++)
        print_message(" %s %u (edges: mean %.3g, of %u)", normal_get(m)->name, (unsigned)by[m].wrong, by[m].edges.mean,
                      (unsigned)by[m].edges.count);
    print_message("\n");
}

/* By itself, in closed form or from five depths; what samples that are codes have in closed form is what the cells of
 * the five depths say. Counts bounds. */
static void judge_row(const texture_camera *c, const grain *g, const normal_planes *in, const double *got,
                      size_t *finite) {
    for (uint32_t x = 0; x < c->width; x++) {
        const double n[3] = {(double)in->normal[0][x], (double)in->normal[1][x], (double)in->normal[2][x]};
        const normal_plane plane = normal_plane_at(c, x, in->row, in->z[x], n);
        const double error = normal_plane_error_of(c, g, x, in->row, &plane, 0x1p-24);
        const double cells = normal_plane_error(c, x, in->row, &plane, 0x1p-24);
        const double want = isinf(error) ? (double)NAN : normal_plane_bound(c, x, in->row, &plane, error);
        if (!(want == got[x] || (isnan(want) && isnan(got[x]))))
            fail_msg("pixel %u, %u of %u x %u: %.17g, alone %.17g", x, in->row, c->width, c->height, got[x], want);
        if (g == NULL && error != cells && !(cells <= error && error <= cells * (1 + 1e-5)))
            fail_msg("pixel %u, %u of %u x %u: error %.17g, of five cells %.17g", x, in->row, c->width, c->height,
                     error, cells);
        *finite += isnan(want) ? 0 : 1;
    }
}

/* Also at borders, where a neighbour beyond the image says nothing. */
TEST(bounds_of_a_row_are_those_of_its_pixels) {
    enum { MOST = 700 };
    static const uint32_t sizes[][2] = {{1, 1}, {7, 3}, {257, 2}, {MOST, 3}};
    static const grain coarse = {.kind = GRAIN_STEPS, .steps = 65535, .buffer = true};
    static float normal[3][MOST];
    static double z[MOST], got[MOST];
    rng r = rng_make("rows of planes");
    size_t finite[2] = {0, 0};
    for (size_t k = 0; k < 16; k++) {
        const bool ortho = k % 2 == 1;
        const texture_camera c = view_camera("unorm24", k % 4 < 2 ? DP_MAPPING_D3D : DP_MAPPING_REVERSED, 0.1, 100,
                                             ortho, sizes[k / 4][0], sizes[k / 4][1], ortho ? 5 : 60);
        for (uint32_t row = 0; row < c.height; row++) {
            for (uint32_t x = 0; x < c.width; x++) {
                z[x] = rng_log(&r, 0.1, 100);
                normal[0][x] = (float)rng_uniform(&r, -1, 1);
                normal[1][x] = (float)rng_uniform(&r, -1, 1);
                normal[2][x] = (float)-rng_log(&r, 1e-3, 1); /* some leave the view in a pixel, but not in the next */
            }
            for (int g = 0; g < 2; g++) {
                const normal_planes in = {&c, row, {normal[0], normal[1], normal[2]}, z, NULL};
                normal_planes_bounds(&in, g == 0 ? NULL : &coarse, 0x1p-24, got);
                judge_row(&c, g == 0 ? NULL : &coarse, &in, got, &finite[g]);
            }
        }
    }
    assert_true(finite[0] > 2000 && finite[1] > 2000);
}
