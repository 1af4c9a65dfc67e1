/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * What an eye sees of two triangles, by points of both in long double; from where on they fight, by the guarantee of
 * the very triangles, whose class is put together here; and by what a rasterizer draws of them.
 */
#include "depthprec/depthprec.h"
#include "raster/draw.h"
#include "scene/render.h"
#include "scene/sight.h"
#include "scene_made.h"
#include "support.h"

enum { WIDTH = 320, HEIGHT = 180, POINTS = 96 };

static const double degree = 3.14159265358979323846 / 180.0;

static scene_made made;

static dp_setup setup_of(const char *raster, const char *format, dp_mapping mapping, double zfar) {
    dp_spec spec = dp_spec_default();
    dp_format found[2];
    dp_setup setup;
    const raster_row *row = raster_find(raster);
    assert_int_equal(dp_format_parse(format, found), 1);
    spec.triangles = dp_triangles_default();
    raster_describe(row, &spec.triangles);
    spec.triangles.width = WIDTH;
    spec.triangles.height = HEIGHT;
    spec.format = found[0];
    spec.mapping = mapping;
    spec.model = DP_MODEL_FLOAT;
    spec.zfar = zfar;
    assert_true(raster_arith(row, false, &spec.arith));
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    return setup;
}

/* ---- Scenes ------------------------------------------------------------------------------------------------------ */

static void random_direction(rng *r, double out[3]) {
    double length;
    do {
        for (int k = 0; k < 3; k++)
            out[k] = rng_uniform(r, -1, 1);
        length = hypot(hypot(out[0], out[1]), out[2]);
    } while (!(length > 0.1 && length <= 1));
    for (int k = 0; k < 3; k++)
        out[k] /= length;
}

static void cross(const double a[3], const double b[3], double out[3]) {
    for (int k = 0; k < 3; k++)
        out[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

/* Two triangles, about `size` large, round the origin, each faces either way: in parallel planes, `gap` apart; or,
 * `tilted`, the second half as large, above the first, its corners at 1, 2 and 3 times the gap. */
static void make_triangles(rng *r, double size, double gap, bool tilted) {
    double n[3], other[3], u[3], v[3], at[3] = {0}, far[3] = {0};
    random_direction(r, n);
    random_direction(r, other);
    cross(n, other, u);
    const double length = hypot(hypot(u[0], u[1]), u[2]);
    for (int k = 0; k < 3; k++)
        u[k] /= length;
    cross(n, u, v);
    scene_made_begin(&made);
    for (int t = 0; t < 2; t++) {
        double corner[3][3];
        const double turn = rng_uniform(r, 0, 6.28);
        const bool back = rng_below(r, 4) == 0;
        for (int i = 0; i < 3; i++) {
            if (t == 0 || !tilted) {
                at[i] = turn + (i + rng_uniform(r, -0.2, 0.2)) * 2.0943951;
                far[i] = size * rng_uniform(r, 0.5, 1);
            }
            const double part = t == 1 && tilted ? 0.5 * far[i] : far[i], above = t * gap * (tilted ? 1 + i : 1);
            const double x = part * cos(at[i]), y = part * sin(at[i]);
            for (int k = 0; k < 3; k++)
                corner[back ? 2 - i : i][k] = x * u[k] + y * v[k] + above * n[k];
        }
        scene_made_surface(&made, t == 0 ? "a" : "b", "");
        made.surface[t].two_sided = rng_below(r, 3) > 0;
        scene_made_triangle(&made, corner[0], corner[1], corner[2]);
    }
}

static void make_pair(rng *r, double size, double gap) {
    make_triangles(r, size, gap, false);
}

static scene_eye random_eye(rng *r, double size) {
    double from[3], at[3];
    scene_eye eye;
    random_direction(r, from);
    random_direction(r, at);
    const double distance = size * rng_log(r, 0.3, 30);
    for (int k = 0; k < 3; k++) {
        from[k] *= distance;
        at[k] *= 0.7 * size;
    }
    assert_true(scene_eye_look(from, at, (const double[]){0, 1, 0}, &eye));
    return eye;
}

static bool find(double gap, finder_found *found) {
    const finder_asked asked = {.gap = 2 * gap, .angle = 10, .threads = 1};
    assert_int_equal(finder_find(&made.m, &asked, found), FINDER_DONE);
    return found->findings == 1;
}

static sight_asked asked_of(const dp_setup *setup, const finder_found *found, double gap, const scene_eye *eye,
                            size_t eyes) {
    return (sight_asked){.m = &made.m, .found = found, .setup = setup, .gap = 2 * gap, .eye = eye, .eyes = eyes};
}

/* ---- The truth --------------------------------------------------------------------------------------------------- */

static long double dot(const long double a[3], const double b[3]) {
    return a[0] * (long double)b[0] + a[1] * (long double)b[1] + a[2] * (long double)b[2];
}

/* Whether a point lies above triangle t, seen along its normal, by `inside` of its barycentric coordinates. */
static bool above(const long double p[3], int t, long double inside) {
    long double e[3][3], n[3], sum[3];
    const double *c[3];
    for (int i = 0; i < 3; i++)
        c[i] = made.position[made.triangle[t][i]];
    for (int k = 0; k < 3; k++) {
        e[0][k] = (long double)c[1][k] - (long double)c[0][k];
        e[1][k] = (long double)c[2][k] - (long double)c[0][k];
        e[2][k] = p[k] - (long double)c[0][k];
    }
    for (int k = 0; k < 3; k++)
        n[k] = e[0][(k + 1) % 3] * e[1][(k + 2) % 3] - e[0][(k + 2) % 3] * e[1][(k + 1) % 3];
    long double size = 0, b[3] = {0};
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        size += n[k] * n[k];
        b[1] += n[k] * (e[2][i] * e[1][j] - e[2][j] * e[1][i]);
        b[2] += n[k] * (e[0][i] * e[2][j] - e[0][j] * e[2][i]);
    }
    sum[0] = 1 - b[1] / size - b[2] / size;
    return sum[0] >= inside && b[1] / size >= inside && b[2] / size >= inside;
}

typedef struct truth {
    long double lo, hi; /* eye depths of points in view */
} truth;

/* Points of triangle t that lie above the other one, in a view that is `wider` times as wide. */
static void add_points(truth *seen, int t, const scene_eye *eye, const dp_setup *setup, long double wider,
                       long double inside) {
    const dp_triangles *of = &setup->spec.triangles;
    const long double up = tanl(0.5L * (long double)of->fov_y * (long double)degree) * wider;
    const long double across = up * of->width / of->height;
    const double *c[3];
    for (int i = 0; i < 3; i++)
        c[i] = made.position[made.triangle[t][i]];
    for (int i = 0; i <= POINTS; i++)
        for (int j = 0; i + j <= POINTS; j++) {
            const long double b = (long double)i / POINTS, d = (long double)j / POINTS;
            long double p[3], from[3];
            for (int k = 0; k < 3; k++) {
                p[k] = (1 - b - d) * (long double)c[0][k] + b * (long double)c[1][k] + d * (long double)c[2][k];
                from[k] = p[k] - (long double)eye->place[k];
            }
            const long double z = dot(from, eye->ahead);
            if (z * wider < (long double)setup->spec.znear || z > (long double)setup->spec.zfar * wider ||
                fabsl(dot(from, eye->right)) > across * fabsl(z) || fabsl(dot(from, eye->up)) > up * fabsl(z) ||
                !above(p, 1 - t, inside))
                continue;
            seen->lo = fminl(seen->lo, z);
            seen->hi = fmaxl(seen->hi, z);
        }
}

static truth truth_of(const scene_eye *eye, const dp_setup *setup, long double wider, long double inside) {
    truth seen = {HUGE_VALL, -HUGE_VALL};
    for (int t = 0; t < 2; t++)
        add_points(&seen, t, eye, setup, wider, inside);
    return seen;
}

/* The sine of the angle at which the eye sees a triangle's front: the least and the most over its corners. */
static void fronts(int t, const scene_eye *eye, double sine[2]) {
    double u[3], v[3], n[3];
    const double *c[3];
    for (int i = 0; i < 3; i++)
        c[i] = made.position[made.triangle[t][i]];
    for (int k = 0; k < 3; k++) {
        u[k] = c[1][k] - c[0][k];
        v[k] = c[2][k] - c[0][k];
    }
    cross(u, v, n);
    sine[0] = HUGE_VAL;
    sine[1] = -HUGE_VAL;
    for (int i = 0; i < 3; i++) {
        double towards = 0, length = 0, size = 0;
        for (int k = 0; k < 3; k++) {
            const double from = eye->place[k] - c[i][k];
            towards += from * n[k];
            length += from * from;
            size += n[k] * n[k];
        }
        const double s = towards / sqrt(length * size);
        sine[0] = fmin(sine[0], s);
        sine[1] = fmax(sine[1], s);
    }
}

/* ---- What is seen ------------------------------------------------------------------------------------------------ */

TEST(what_is_seen) {
    const dp_setup setup = setup_of("swiftshader", "fp32", DP_MAPPING_REVERSED, 60);
    tally t = {.name = "depths that are seen"}, hidden = {.name = "not seen"}, turned = {.name = "turned away"};
    rng r = rng_make("sight");
    for (uint64_t run = 0; run < test_cases(60, 400, 20000); run++) {
        const double size = rng_log(&r, 0.5, 20), gap = size * rng_log(&r, 1e-5, 1e-3);
        finder_found found;
        scene_sight room;
        make_pair(&r, size, gap);
        const scene_eye eye = random_eye(&r, size);
        if (!find(gap, &found)) {
            finder_free(&found);
            continue;
        }
        const sight_asked asked = asked_of(&setup, &found, gap, &eye, 1);
        const scene_sight got = scene_sight_worst(&asked, found.finding, &room);
        bool back = false, edge = false;
        for (int i = 0; i < 2; i++) {
            double sine[2];
            fronts(i, &eye, sine);
            back = back || (!made.surface[i].two_sided && sine[1] < -0.006);
            edge = edge || (!made.surface[i].two_sided && sine[0] < 0.0 && sine[1] > -0.006);
        }
        const truth least = truth_of(&eye, &setup, 1.0L - 1e-9L, 1e-9L);
        const truth most = truth_of(&eye, &setup, 1.1L, -3.0L / POINTS);
        if (back) {
            TALLY(&turned, isnan(got.seen_from) && isnan(got.fights_from) && got.covered, "%g", got.seen_from);
        } else if (isnan(got.seen_from)) {
            TALLY(&hidden, edge || least.lo > least.hi, "seen from %Lg to %Lg", least.lo, least.hi);
        } else {
            const long double step = 3.0L * (long double)size / POINTS;
            TALLY(&t,
                  least.lo > least.hi ||
                      ((long double)got.seen_from <= least.lo && (long double)got.seen_to >= least.hi),
                  "%g to %g, but %Lg to %Lg", got.seen_from, got.seen_to, least.lo, least.hi);
            TALLY(&t, (long double)got.seen_from >= most.lo - step && (long double)got.seen_to <= most.hi + step,
                  "%g to %g, beyond %Lg to %Lg", got.seen_from, got.seen_to, most.lo, most.hi);
        }
        finder_free(&found);
    }
    tally_end(&t);
    tally_end(&hidden);
    tally_end(&turned);
}

/* An eye just behind a surface, by less than 2^-8 of its distance, whose depths a grid may turn to the front: it is
 * drawn. By more it is not. */
TEST(just_behind) {
    const dp_setup setup = setup_of("swiftshader", "fp32", DP_MAPPING_REVERSED, 60);
    tally t = {.name = "just behind"}, beyond = {.name = "behind"};
    rng r = rng_make("behind");
    for (uint64_t run = 0; run < test_cases(400, 3000, 30000); run++) {
        const double size = rng_log(&r, 0.5, 5), gap = size * 1e-7, steep = rng_uniform(&r, 0.001, 0.008);
        double u[3], n[3], from[3], middle[3], sine[2][2];
        finder_found found;
        scene_sight room;
        scene_eye eye;
        make_pair(&r, size, gap);
        made.surface[0].two_sided = made.surface[1].two_sided = false;
        const double *c[3];
        for (int i = 0; i < 3; i++)
            c[i] = made.position[made.triangle[0][i]];
        for (int k = 0; k < 3; k++) {
            middle[k] = (c[0][k] + c[1][k] + c[2][k]) / 3;
            u[k] = c[1][k] - c[0][k];
            from[k] = c[2][k] - c[0][k];
        }
        cross(u, from, n);
        const double length = hypot(hypot(n[0], n[1]), n[2]), along = hypot(hypot(u[0], u[1]), u[2]);
        for (int k = 0; k < 3; k++)
            from[k] = middle[k] + 20 * size * (u[k] / along - steep * n[k] / length);
        if (!scene_eye_look(from, middle, (const double[]){0, 1, 0}, &eye) || !find(gap, &found)) {
            finder_free(&found);
            continue;
        }
        const sight_asked asked = asked_of(&setup, &found, gap, &eye, 1);
        const scene_sight got = scene_sight_worst(&asked, found.finding, &room);
        for (int i = 0; i < 2; i++)
            fronts(i, &eye, sine[i]);
        const truth least = truth_of(&eye, &setup, 1.0L - 1e-9L, 1e-9L);
        if (sine[0][1] > -0x1.fp-9 && sine[1][1] > -0x1.fp-9 && least.lo <= least.hi)
            TALLY(&t, !isnan(got.seen_from), "sine %g, %g", sine[0][1], sine[1][1]);
        if (sine[0][1] < -0x1.1p-8)
            TALLY(&beyond, isnan(got.seen_from), "sine %g", sine[0][1]);
        finder_free(&found);
    }
    tally_end(&t);
    tally_end(&beyond);
}

/* However vertices are snapped to 1/16 pixel, triangles stay in the class by which they are judged, slim and tiny ones,
 * too. */
TEST(classes_hold_what_is_snapped) {
    const dp_setup setup = setup_of("swiftshader", "fp32", DP_MAPPING_REVERSED, 60);
    const double up = tan(0.5 * setup.spec.triangles.fov_y * degree), half = 1.0 / 32;
    tally t = {.name = "classes"};
    rng r = rng_make("classes");
    double most = 0; /* of the class, used */
    for (uint64_t run = 0; run < test_cases(400, 3000, 30000); run++) {
        const double size = rng_log(&r, 0.01, 1), gap = size * 1e-3;
        finder_found found;
        scene_sight room;
        make_pair(&r, size, gap);
        const scene_eye eye = random_eye(&r, fmax(size, 0.5));
        const bool one = find(gap, &found);
        const sight_asked asked = asked_of(&setup, &found, gap, &eye, 1);
        const scene_sight got = one ? scene_sight_worst(&asked, found.finding, &room) : (scene_sight){.covered = false};
        finder_free(&found);
        if (!one || isnan(got.seen_from) || !got.covered ||
            memcmp(&got.triangles, &setup.spec.triangles, sizeof got.triangles) == 0) /* none of its own */
            continue;
        for (int i = 0; i < 2; i++)
            for (int move = 0; move < 64; move++) {
                double w[3][2], longest = 0, widest = 0, at[3];
                for (int c = 0; c < 3; c++) {
                    scene_eye_sees(&eye, made.position[made.triangle[i][c]], at);
                    for (int k = 0; k < 2; k++)
                        w[c][k] = at[k] / at[2] / up * HEIGHT / 2 + (move >> (2 * c + k) & 1 ? half : -half);
                }
                for (int c = 0; c < 3; c++) {
                    const double x = fabs(w[(c + 1) % 3][0] - w[c][0]), y = fabs(w[(c + 1) % 3][1] - w[c][1]);
                    longest = fmax(longest, hypot(x, y));
                    widest = fmax(widest, fmax(x, y));
                }
                const double area =
                    fabs((w[1][0] - w[0][0]) * (w[2][1] - w[0][1]) - (w[2][0] - w[0][0]) * (w[1][1] - w[0][1]));
                const double slim = longest * longest / area;
                TALLY(&t, slim <= got.triangles.slim && widest <= got.triangles.pixels,
                      "slim %g, of %g at most; %g pixels, of %g", slim, got.triangles.slim, widest,
                      got.triangles.pixels);
                most = fmax(most, slim / got.triangles.slim);
            }
    }
    print_message("# %.3f of a class\n", most);
    assert_true(most > 0.9);
    tally_end(&t);
}

/* ---- From where on they fight ------------------------------------------------------------------------------------ */

/* The class of both triangles at depths from lo to hi, `by` times as large as it is; false where there is none. */
static bool class_of(const dp_setup *setup, const scene_eye *eye, double lo, double hi, double by, dp_setup *out) {
    dp_spec spec = setup->spec;
    dp_triangles *t = &spec.triangles;
    const double up = tan(0.5 * t->fov_y * degree), across = up * t->width / t->height;
    double depth = 1, pixels = 1, slim = 2, slant[2] = {90, 0};
    for (int i = 0; i < 2; i++) {
        double at[3][3], edge[3], n[3], u[3], v[3], window[3][2], most = 0, around = 0;
        for (int c = 0; c < 3; c++) {
            scene_eye_sees(eye, made.position[made.triangle[i][c]], at[c]);
            if (at[c][2] < spec.znear || at[c][2] > spec.zfar)
                return false;
            depth = fmax(depth, fmax(at[c][2] / lo, hi / at[c][2]));
            window[c][0] = at[c][0] / at[c][2] / across * t->width / 2;
            window[c][1] = at[c][1] / at[c][2] / up * t->height / 2;
            if (t->plane.origin > 0 && (fabs(window[c][0]) >= WIDTH / 2.0 || fabs(window[c][1]) >= HEIGHT / 2.0))
                return false;
        }
        for (int c = 0; c < 3; c++) {
            const double *p = window[c], *q = window[(c + 1) % 3];
            edge[c] = hypot(p[0] - q[0], p[1] - q[1]);
            most = fmax(most, edge[c]);
            around += fabs(p[0] - q[0]) + fabs(p[1] - q[1]);
            pixels = fmax(pixels, fmax(fabs(p[0] - q[0]), fabs(p[1] - q[1])));
            u[c] = at[1][c] - at[0][c];
            v[c] = at[2][c] - at[0][c];
        }
        const double half = (edge[0] + edge[1] + edge[2]) / 2;
        const double area = sqrt(fmax(half * (half - edge[0]) * (half - edge[1]) * (half - edge[2]), 0));
        const double grid = by > 1 ? 0.0625 : 0, left = 2 * area - grid * around - 4 * grid * grid;
        slim = left > 0 ? fmax(slim, pow(most + 3 * grid, 2) / left) : INFINITY;
        cross(u, v, n);
        const double angle = acos(fabs(n[2]) / hypot(hypot(n[0], n[1]), n[2])) / degree;
        slant[0] = fmin(slant[0], angle);
        slant[1] = fmax(slant[1], angle);
    }
    t->depth = 1 + (depth - 1) * by;
    t->pixels = fmax(pixels * by + (by > 1 ? 1 : 0), 1);
    t->slim = fmax(slim * (by > 1 ? by * by * by : 1), 2);
    t->slant_lo = fmax(slant[0] - (by > 1 ? 0.1 : 0), 0);
    t->slant_hi = fmin(slant[1] + (by > 1 ? 0.1 : 0), 90);
    return dp_setup_init(out, &spec) == DP_OK;
}

/* The least distance from either plane: of the lowest corner of the second, and of the place below it, along the sum of
 * both normals, each as long as its triangle is large. */
static double least_of(double gap) {
    double n[2][3], sum[3], of[2] = {0};
    for (int t = 0; t < 2; t++) {
        double u[3], v[3];
        for (int k = 0; k < 3; k++) {
            u[k] = made.position[made.triangle[t][1]][k] - made.position[made.triangle[t][0]][k];
            v[k] = made.position[made.triangle[t][2]][k] - made.position[made.triangle[t][0]][k];
        }
        cross(u, v, n[t]);
    }
    const double sign = n[0][0] * n[1][0] + n[0][1] * n[1][1] + n[0][2] * n[1][2] < 0 ? -1 : 1;
    for (int k = 0; k < 3; k++)
        sum[k] = n[0][k] + sign * n[1][k];
    for (int t = 0; t < 2; t++)
        of[t] = fabs(sum[0] * n[t][0] + sum[1] * n[t][1] + sum[2] * n[t][2]) / hypot(hypot(n[t][0], n[t][1]), n[t][2]);
    return gap * fmin(1, of[1] / of[0]);
}

/* Guaranteed at all depths of what is seen before the one named; behind it not, of triangles a little larger. */
TEST(from_where_on) {
    static const struct {
        const char *format;
        dp_mapping mapping;
    } rows[] = {{"fp32", DP_MAPPING_REVERSED}, {"unorm24", DP_MAPPING_D3D}, {"unorm16", DP_MAPPING_D3D}};
    static const char *const rasters[] = {"swiftshader", "llvmpipe"};
    tally t = {.name = "from where on"}, bare = {.name = "not covered"}, before = {.name = "in part"};
    rng r = rng_make("fights from");
    for (uint64_t run = 0; run < test_cases(100, 1000, 50000); run++) {
        const dp_setup setup = setup_of(rasters[run % 2], rows[run % 3].format, rows[run % 3].mapping, 1000);
        const bool tilted = rng_below(&r, 3) == 0;
        const double size = rng_log(&r, 0.5, 20), gap = size * rng_log(&r, 1e-6, tilted ? 2e-2 : 1e-1);
        finder_found found;
        scene_sight room;
        dp_setup exact, larger;
        dp_separation_worst worst;
        make_triangles(&r, size, gap, tilted);
        const scene_eye eye = random_eye(&r, size);
        if (find(tilted ? 2 * gap : gap, &found)) {
            const sight_asked asked = asked_of(&setup, &found, tilted ? 2 * gap : gap, &eye, 1);
            const scene_sight got = scene_sight_worst(&asked, found.finding, &room);
            const double lo = got.seen_from, hi = got.seen_to, from = got.fights_from;
            if (isnan(lo)) {
                finder_free(&found);
                continue;
            }
            const bool has = class_of(&setup, &eye, lo, hi, 1.0, &exact);
            const bool has_larger = class_of(&setup, &eye, lo, hi, 1.1, &larger);
            if (!has) {
                TALLY(&bare, got.covered == !isnan(from), "covered from %g to %g", lo, hi);
                exact = larger = setup;
            } else if (!has_larger || !got.covered) {
                TALLY(&bare, !has_larger || got.covered, "not covered from %g to %g", lo, hi);
                finder_free(&found);
                continue;
            }
            const double end = isnan(from) ? hi : from, least = least_of(gap), limit = least * (1 + 1e-9);
            dp_separation_over(&exact, lo, end, limit, &worst); /* as it stops where that is decided */
            TALLY(&t, from == lo || worst.bound <= limit, "%.12g apart to %.12g: %.12g", least, end, worst.bound);
            if (!isnan(from)) {
                dp_separation_over(&larger, lo, fmin(from * (1 + 2e-5), hi), least, &worst);
                TALLY(&t, worst.bound > least, "%g apart, and beyond %g not more than %g", least, from, worst.bound);
                TALLY(&before, from >= lo && from < hi, "from %g, seen from %g to %g", from, lo, hi);
            }
        }
        finder_free(&found);
    }
    tally_end(&t);
    tally_end(&bare);
    tally_end(&before);
}

/* ---- Drawn ------------------------------------------------------------------------------------------------------- */

/* Where all is told apart no pixel that a rasterizer draws is wrong; where not, some are. */
TEST(drawn) {
    static const struct {
        const char *raster, *format;
        dp_mapping mapping;
    } rows[] = {{"swiftshader", "fp32", DP_MAPPING_REVERSED},
                {"swiftshader", "unorm16", DP_MAPPING_D3D},
                {"llvmpipe", "unorm24", DP_MAPPING_D3D},
                {"llvmpipe", "fp32", DP_MAPPING_REVERSED}};
    tally t = {.name = "pairs that are told apart"};
    rng r = rng_make("sight drawn");
    size_t wrong = 0;
    for (uint64_t run = 0; run < test_cases(60, 600, 20000); run++) {
        const dp_setup setup = setup_of(rows[run % 4].raster, rows[run % 4].format, rows[run % 4].mapping, 1000);
        const double size = rng_log(&r, 0.5, 20), gap = size * rng_log(&r, 1e-6, 1e-2);
        finder_found found;
        scene_sight room;
        draw_camera camera;
        render_picture p;
        make_pair(&r, size, gap);
        const scene_eye eye = random_eye(&r, size);
        if (find(gap, &found)) {
            const sight_asked asked = asked_of(&setup, &found, gap, &eye, 1);
            const scene_sight got = scene_sight_worst(&asked, found.finding, &room);
            assert_int_equal(draw_camera_init(&camera, raster_find(rows[run % 4].raster), &setup), RASTER_OK);
            const render_asked all = {.m = &made.m, .camera = &camera, .eye = eye};
            assert_int_equal(render_draw(&all, &p), RENDER_DONE);
            if (!isnan(got.seen_from) && isnan(got.fights_from) && got.covered)
                TALLY(&t, p.wrong == 0, "%zu pixels wrong, %g apart from %g to %g", p.wrong, gap, got.seen_from,
                      got.seen_to);
            else
                wrong += p.wrong;
            render_free(&p);
        }
        finder_free(&found);
    }
    tally_end(&t);
    assert_true(wrong > test_cases(100, 1000, 1000));
}

/* ---- Of several eyes, and eyes by hand --------------------------------------------------------------------------- */

/* A poster before a wall, eyes straight before it, one that sees the back, one that looks away. */
TEST(worst_eye) {
    static const double wall[3][3] = {{-4, -4, 0}, {8, 0, 0}, {0, 8, 0}},
                        sheet[3][3] = {{-1, -1, 0.01}, {2, 0, 0}, {0, 2, 0}};
    static const struct {
        double z, look;
        double from, to;
    } rows[] = {{30, 0, 29.99, 30}, {12, 0, 11.99, 12}, {-9, 0, NAN, NAN}, {5, 6, NAN, NAN}};
    const dp_setup setup = setup_of("swiftshader", "unorm16", DP_MAPPING_D3D, 1000);
    scene_eye eye[4];
    scene_sight room[4];
    finder_found found;
    scene_made_begin(&made);
    scene_made_surface(&made, "wall", "");
    scene_made_quad(&made, wall[0], wall[1], wall[2]);
    scene_made_surface(&made, "sheet", "");
    scene_made_quad(&made, sheet[0], sheet[1], sheet[2]);
    assert_true(find(0.01, &found));
    double lift = 0;
    for (size_t i = 0; i < 4; i++) {
        const double from[3] = {0, 0, rows[i].z}, at[3] = {0, 0, rows[i].look};
        assert_true(scene_eye_look(from, at, (const double[]){0, 1, 0}, &eye[i]));
        const sight_asked one = asked_of(&setup, &found, 0.01, &eye[i], 1);
        const scene_sight got = scene_sight_worst(&one, found.finding, room);
        assert_true(isnan(rows[i].from)
                        ? isnan(got.seen_from) && isnan(got.seen_to)
                        : fabs(got.seen_from - rows[i].from) < 1e-9 && fabs(got.seen_to - rows[i].to) < 1e-9);
        assert_true(got.covered);
        lift = i == 1 ? got.lift : lift;
    }
    const sight_asked four = asked_of(&setup, &found, 0.01, eye, 4), last = asked_of(&setup, &found, 0.01, eye + 2, 2);
    const scene_sight got = scene_sight_worst(&four, found.finding, room);
    assert_true(got.eye == 1 && got.fights_from == got.seen_from && fabs(got.seen_to - 12) < 1e-9);
    assert_true(got.lift > 0 && got.lift == lift);
    assert_true(isnan(scene_sight_worst(&last, found.finding, room).seen_from));
    /* of two-sided surfaces the back is seen, too, and so it is when sides do not count */
    sight_asked behind = asked_of(&setup, &found, 0.01, eye + 2, 1);
    made.surface[0].two_sided = made.surface[1].two_sided = true;
    assert_true(fabs(scene_sight_worst(&behind, found.finding, room).seen_from - 9) < 1e-9);
    made.surface[0].two_sided = false;
    assert_true(isnan(scene_sight_worst(&behind, found.finding, room).seen_from));
    behind.any_side = true;
    assert_true(fabs(scene_sight_worst(&behind, found.finding, room).seen_from - 9) < 1e-9);
    finder_free(&found);
}

/* Nothing fights; from the one eye a corner of the wall lies behind it, from the other, which is nearer, none does. */
TEST(not_covered) {
    static const double wall[3][3] = {{-4, -4, 0}, {8, 0, 0}, {0, 8, 0}},
                        sheet[3][3] = {{-1, -1, 0.25}, {2, 0, 0}, {0, 2, 0}};
    static const double from[2][3] = {{-3, 0, 1}, {0, 0, 1.5}}, at[2][3] = {{0, 0, 0.5}, {0, 0, 0}};
    const dp_setup setup = setup_of("swiftshader", "fp32", DP_MAPPING_REVERSED, 1000);
    scene_eye eye[2];
    scene_sight room[2];
    finder_found found;
    scene_made_begin(&made);
    scene_made_surface(&made, "wall", "");
    scene_made_quad(&made, wall[0], wall[1], wall[2]);
    scene_made_surface(&made, "sheet", "");
    scene_made_quad(&made, sheet[0], sheet[1], sheet[2]);
    assert_true(find(0.25, &found));
    for (int i = 0; i < 2; i++)
        assert_true(scene_eye_look(from[i], at[i], (const double[]){0, 1, 0}, &eye[i]));
    for (size_t i = 0; i < 2; i++) {
        const sight_asked one = asked_of(&setup, &found, 0.25, &eye[i], 1);
        const scene_sight got = scene_sight_worst(&one, found.finding, room);
        assert_true(isnan(got.fights_from) && got.covered == (i == 1) && (i == 0 || got.seen_from < 1.26));
    }
    for (size_t first = 0; first < 2; first++) {
        const scene_eye swapped[2] = {eye[first], eye[1 - first]};
        const sight_asked both = asked_of(&setup, &found, 0.25, swapped, 2);
        assert_int_equal(scene_sight_worst(&both, found.finding, room).eye, first == 0 ? 0 : 1);
    }
    finder_free(&found);
}

TEST(eyes) {
    static const double up[3] = {0, 1, 0}, down[3] = {0, -1, 0};
    const double o[3] = {1, 2, 3}, east[3] = {4, 2, 3}, below[3] = {1, -5, 3};
    scene_eye eye = {.line = 77};
    double seen[3];
    assert_false(scene_eye_look(o, o, up, &eye));
    assert_int_equal(eye.line, 77);
    assert_true(scene_eye_look(o, east, up, &eye));
    assert_int_equal(eye.line, 0);
    scene_eye_sees(&eye, (const double[]){5, 4, 10}, seen); /* to the east south is at the right */
    assert_true(fabs(seen[0] - 7) < 1e-12 && fabs(seen[1] - 2) < 1e-12 && fabs(seen[2] - 4) < 1e-12);
    assert_true(scene_eye_look(o, below, up, &eye));
    scene_eye_sees(&eye, (const double[]){1, 0, 3}, seen);
    assert_true(seen[0] == 0 && seen[1] == 0 && fabs(seen[2] - 2) < 1e-12);
    for (int k = 0; k < 3; k++)
        assert_true(isfinite(eye.right[k]) && isfinite(eye.up[k]));
    model_camera camera = {.eye = {1, 2, 3}, .ahead = {0, 0, -1}, .up = {0, -1, 0}};
    assert_true(scene_eye_of(&camera, &eye));
    scene_eye_sees(&eye, (const double[]){2, 4, 0}, seen); /* it stands on its head */
    assert_true(seen[0] == -1 && seen[1] == -2 && seen[2] == 3 && eye.up[1] == down[1]);
    camera.ahead[2] = 0;
    assert_false(scene_eye_of(&camera, &eye));
}
