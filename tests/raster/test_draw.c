/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The depth buffer of src/draw: who wins each pixel, against every pixel by itself; meshes, against their triangles. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "raster/draw_class.h"
#include "raster/mesh.h"
#include "raster_named.h"

static const double pi = 3.14159265358979323846;

enum { WIDTH = 160, HEIGHT = 90, SURFACES = 3, TRIANGLES = 6 };

typedef struct scene {
    dp_setup setup;
    draw_camera camera;
    float p00, p11, a, b; /* of the test's own matrix */
    bool remap;
} scene;

/* The entries as depthprec(7) has them. */
static void own_matrix(scene *s) {
    const double n = s->setup.spec.znear, f = s->setup.spec.zfar, y = tan(s->setup.spec.triangles.fov_y * pi / 360.0);
    const dp_mapping m = s->setup.spec.mapping;
    const bool reversed = m == DP_MAPPING_REVERSED || m == DP_MAPPING_GL_REVERSED;
    s->remap = m == DP_MAPPING_GL || m == DP_MAPPING_GL_REVERSED;
    s->p11 = (float)(1.0 / y);
    s->p00 = (float)(s->setup.spec.triangles.height / (y * s->setup.spec.triangles.width));
    if (s->remap) {
        s->a = (float)((reversed ? -1.0 : 1.0) * (f + n) / (f - n));
        s->b = (float)((reversed ? 2.0 : -2.0) * n * f / (f - n));
    } else {
        s->a = (float)(reversed ? n / (n - f) : f / (f - n));
        s->b = (float)(reversed ? n * f / (f - n) : -n * f / (f - n));
    }
}

static raster_status try_scene(scene *s, const char *raster, const char *format, dp_mapping mapping) {
    dp_spec spec = dp_spec_default();
    dp_format found[2];
    const raster_row *row = raster_find(raster);
    *s = (scene){.remap = false};
    spec.triangles = dp_triangles_default();
    spec.triangles.width = WIDTH;
    spec.triangles.height = HEIGHT;
    assert_int_equal(dp_format_parse(format, found), 1);
    spec.format = found[0];
    spec.mapping = mapping;
    spec.model = DP_MODEL_FLOAT;
    spec.zfar = 50.0;
    if (!raster_arith(row, dp_mapping_get(mapping)->ndc_signed, &spec.arith))
        return RASTER_MODEL;
    assert_int_equal(dp_setup_init(&s->setup, &spec), DP_OK);
    own_matrix(s);
    return draw_camera_init(&s->camera, row, &s->setup);
}

/* An arithmetic that cannot bring clip depth from -1 to 1 into the buffer's is refused, in either direction. */
TEST(depths_that_need_the_remap) {
    scene s;
    for (int k = 0; k < DP_MAPPING_COUNT; k++) {
        const dp_mapping_row *mapping = dp_mapping_get((dp_mapping)k);
        if (mapping->curve != DP_CURVE_PERSPECTIVE)
            continue;
        assert_int_equal(try_scene(&s, "llvmpipe", "unorm24", (dp_mapping)k), RASTER_OK);
        assert_int_equal(dp_arith_parse("mesa", &s.setup.spec.arith), DP_OK);
        assert_int_equal(draw_camera_init(&s.camera, raster_find("llvmpipe"), &s.setup),
                         mapping->ndc_signed ? RASTER_MODEL : RASTER_OK);
    }
}

/* Without a rasterizer a vertex is rounded to the nearest place of the grid, whichever side that is on. */
TEST(vertices_on_the_grid) {
    tally t = {.name = "places on the grid"};
    rng r = rng_make("places on the grid");
    double most[2] = {0};
    for (uint64_t n = test_cases(300, 3000, 30000); n > 0; n--) {
        scene s;
        raster_triangle drawn;
        double place[3][3];
        assert_int_equal(try_scene(&s, "llvmpipe", "unorm24", DP_MAPPING_REVERSED), RASTER_OK);
        s.setup.spec.triangles.subpixel = 4 + (int)rng_below(&r, 5);
        assert_int_equal(draw_class_init(&s.camera, &s.setup), RASTER_OK);
        for (int i = 0; i < 3; i++) {
            place[i][2] = rng_log(&r, 0.2, 40.0);
            place[i][0] = rng_uniform(&r, -0.9, 0.9) * place[i][2] / (double)s.p00;
            place[i][1] = rng_uniform(&r, -0.9, 0.9) * place[i][2] / (double)s.p11;
        }
        if (draw_class_set_up(&s.camera, (const double(*)[3])place, &drawn) != RASTER_OK)
            continue;
        const raster_piece *piece = &drawn.piece[0];
        const double step = ldexp(1.0, -piece->bits);
        TALLY(&t, piece->bits == s.setup.spec.triangles.subpixel, "%d bits", piece->bits);
        for (int i = 0; i < 3; i++) {
            const double x = 0.5 * WIDTH * (1.0 + (double)s.p00 * place[i][0] / place[i][2]) - 0.5;
            const double y = 0.5 * HEIGHT * (1.0 + (double)s.p11 * place[i][1] / place[i][2]) - 0.5;
            const double off[2] = {(piece->x[i] * step - x) / step, (piece->y[i] * step - y) / step};
            for (int k = 0; k < 2; k++) {
                TALLY(&t, fabs(off[k]) <= 0.5 + 3e-5 / step, "off by %g of %d bits", off[k], piece->bits);
                most[off[k] < 0.0] = fmax(most[off[k] < 0.0], fabs(off[k]));
            }
        }
    }
    assert_true(most[0] > 0.45 && most[1] > 0.45);
    tally_end(&t);
}

/* ---- Every pixel by itself --------------------------------------------------------------------------------------- */

/* The bias of a triangle, and what it is told of each piece of it. */
typedef struct biasing {
    float bias;
    int pieces;
    float most[RASTER_PIECES], slope[RASTER_PIECES];
} biasing;

static biasing told;

static float offset_of(const void *of, float most, float slope) {
    (void)of;
    told.most[told.pieces] = most;
    told.slope[told.pieces++] = slope;
    return told.bias;
}

/* The greatest window depth of three vertices, from 0 to 1. */
static double greatest(const scene *s, const double place[3][3]) {
    double most = 0.0;
    for (int i = 0; i < 3; i++) {
        const double ndc = (double)s->a + (double)s->b / place[i][2];
        most = fmax(most, s->remap ? 0.5 * (ndc + 1.0) : ndc);
    }
    return fmin(most, 1.0);
}

static void check_told(const scene *s, const double place[3][3], const raster_triangle *drawn, tally *t) {
    const double most = greatest(s, place);
    TALLY(t, told.pieces == drawn->count, "%d pieces, not %d", told.pieces, drawn->count);
    for (int i = 0; i < drawn->count && i < told.pieces; i++) {
        const raster_plane *p = &drawn->piece[i].plane;
        TALLY(t, fabs((double)told.most[i] - most) < 1e-5 && told.slope[i] == fmaxf(fabsf(p->a), fabsf(p->b)),
              "%s: told of depth %.9g and slope %.9g, not %.9g and %.9g or %.9g", s->camera.target.row->name,
              (double)told.most[i], (double)told.slope[i], most, (double)fabsf(p->a), (double)fabsf(p->b));
    }
}

/* Depth, and code as a number that grows with it, of each pixel that a triangle covers; NaN elsewhere. */
static void stored(const scene *s, const double place[3][3], double (*depth)[WIDTH], raster_triangle *pieces) {
    raster_vertex v[3];
    pieces->count = 0;
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++)
            depth[y][x] = NAN;
    for (int i = 0; i < 3; i++) {
        const float x = (float)place[i][0], y = (float)place[i][1], z = (float)place[i][2];
        const float product = s->a * z, clip = product + s->b, sum = clip + z;
        v[i] = (raster_vertex){s->p00 * x, s->p11 * y, s->remap ? sum * 0.5F : clip, z};
    }
    if (raster_set_up(&s->camera.target, v, pieces) != RASTER_OK)
        return;
    for (int i = 0; i < pieces->count; i++)
        for (int y = 0; y < HEIGHT; y++) {
            int from, to;
            if (!raster_span(&s->camera.target, &pieces->piece[i], y, &from, &to))
                continue;
            for (int x = from; x < to; x++) {
                uint32_t code;
                float value;
                raster_codes(&s->camera.target, &pieces->piece[i], y, x, x + 1, &code);
                if (s->camera.bias != NULL) {
                    raster_depths(&s->camera.target, &pieces->piece[i], y, x, x + 1, &value);
                    value = value + told.bias < 0.0F ? 0.0F : value + told.bias < 1.0F ? value + told.bias : 1.0F;
                    raster_convert(&s->camera.target, &value, 1, &code);
                }
                memcpy(&value, &code, sizeof value);
                depth[y][x] = s->setup.spec.format.kind == DP_FORMAT_FLOAT ? (double)value : (double)code;
            }
        }
}

static void random_triangle(rng *r, const scene *s, double place[3][3]) {
    const double size = rng_log(r, 2.0, 400.0);
    const double x = rng_uniform(r, 0.0, WIDTH), y = rng_uniform(r, 0.0, HEIGHT);
    const bool faces = rng_below(r, 3) == 0; /* of one code then, wherever it is */
    for (int i = 0; i < 3; i++) {
        const double window[2] = {x + rng_uniform(r, -size, size), y + rng_uniform(r, -size, size)};
        const double z = faces || rng_below(r, 8) == 0 ? 5.0 : rng_log(r, 0.08, 60.0);
        draw_ray(&s->camera, window, place[i]);
        for (int axis = 0; axis < 3; axis++)
            place[i][axis] *= z;
    }
}

/* Draws surfaces into a part of the target, some of them biased, and each pixel of it by itself. */
static void compare(rng *r, scene *s, draw_buffer *b, tally *t) {
    static double depth[HEIGHT][WIDTH], best[HEIGHT][WIDTH];
    static unsigned winner[HEIGHT][WIDTH], seen[HEIGHT][WIDTH];
    const draw_area area = {(int)rng_below(r, WIDTH / 2), (int)rng_below(r, HEIGHT / 2),
                            1 + (int)rng_below(r, WIDTH / 2), 1 + (int)rng_below(r, HEIGHT / 2)};
    draw_buffer_clear(b, area);
    memset(winner, 0, sizeof winner);
    memset(seen, 0, sizeof seen);
    for (int i = 0; i < TRIANGLES; i++) {
        const unsigned who = 1 + (unsigned)rng_below(r, SURFACES);
        double place[3][3];
        raster_triangle pieces;
        bool any = false;
        random_triangle(r, s, place);
        s->camera.bias = rng_below(r, 2) == 0 ? offset_of : NULL;
        told = (biasing){.bias = (float)rng_log(r, 1e-7, 2.0) * (rng_below(r, 2) == 0 ? 1.0F : -1.0F)};
        stored(s, (const double(*)[3])place, depth, &pieces);
        const bool drawn = draw_triangle(b, &s->camera, (const double(*)[3])place, who);
        for (int y = 0; y < HEIGHT; y++)
            for (int x = 0; x < WIDTH; x++) {
                const bool first = winner[y][x] == 0;
                if (isnan(depth[y][x]))
                    continue;
                any = true;
                seen[y][x] |= 1U << (who - 1);
                if (!first && !(s->setup.reversed ? depth[y][x] > best[y][x] : depth[y][x] < best[y][x]))
                    continue;
                best[y][x] = depth[y][x];
                winner[y][x] = who;
            }
        TALLY(t, drawn || !any, "%s: nothing is said to be drawn", s->camera.target.row->name);
        if (s->camera.bias != NULL)
            check_told(s, (const double(*)[3])place, &pieces, t);
    }
    for (int y = 0; y < area.height; y++)
        for (int x = 0; x < area.width; x++) {
            const int at = y * area.width + x, row = area.y + y, column = area.x + x;
            TALLY(t, b->winner[at] == winner[row][column] && b->seen[at] == seen[row][column],
                  "%s %s %s: pixel %d, %d shows %d of %d, not %u of %u", s->camera.target.row->name,
                  s->setup.spec.format.name, dp_mapping_get(s->setup.spec.mapping)->name, column, row, b->winner[at],
                  b->seen[at], winner[row][column], seen[row][column]);
        }
}

TEST(who_wins) {
    static const char *const names[] = {"llvmpipe", "lavapipe", "softpipe", "swiftshader"};
    static const char *const formats[] = {"fp32", "unorm24", "unorm16"};
    tally t = {.name = "winners"};
    rng r = rng_make("draw");
    int cameras = 0;
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        for (size_t f = 0; f < sizeof formats / sizeof formats[0]; f++)
            for (dp_mapping m = DP_MAPPING_D3D; m <= DP_MAPPING_GL_REVERSED; m++) {
                scene s;
                draw_buffer b;
                if (try_scene(&s, names[i], formats[f], m) != RASTER_OK)
                    continue;
                cameras++;
                assert_true(draw_buffer_open(&b, WIDTH * HEIGHT));
                for (uint64_t n = test_cases(3, 15, 300); n > 0; n--)
                    compare(&r, &s, &b, &t);
                draw_buffer_close(&b);
            }
    assert_int_equal(cameras, 12 + 12 + 6 + 8); /* softpipe without gl, SwiftShader without D24 */
    tally_end(&t);
}

/* ---- Planes and meshes ------------------------------------------------------------------------------------------- */

/* A place of the window is seen along its ray, as the viewport transform says. */
TEST(rays) {
    rng r = rng_make("rays");
    scene s;
    assert_int_equal(try_scene(&s, "llvmpipe", "fp32", DP_MAPPING_D3D), RASTER_OK);
    for (int i = 0; i < 1000; i++) {
        const double window[2] = {rng_uniform(&r, 0.0, WIDTH), rng_uniform(&r, 0.0, HEIGHT)};
        const draw_plane plane = {{rng_uniform(&r, -1, 1), rng_uniform(&r, -1, 1), rng_uniform(&r, -1, 1)}, 1.0};
        const double y = tan(s.setup.spec.triangles.fov_y * pi / 360.0);
        const double x = y * WIDTH / HEIGHT;
        const double want[3] = {x * (window[0] / (WIDTH / 2.0) - 1.0), y * (window[1] / (HEIGHT / 2.0) - 1.0), 1.0};
        double ray[3], sum = 0.0;
        draw_ray(&s.camera, window, ray);
        for (int axis = 0; axis < 3; axis++) {
            assert_scene(ray[axis], want[axis], 0x1p-22);
            sum += plane.normal[axis] * want[axis];
        }
        assert_scene(draw_facing(&s.camera, &plane, window), sum, 0x1p-20);
    }
}

static double area_of(const double v[3][2]) {
    return 0.5 * fabs((v[1][0] - v[0][0]) * (v[2][1] - v[0][1]) - (v[2][0] - v[0][0]) * (v[1][1] - v[0][1]));
}

/*
 * Whether the triangle belongs to the class, and whether it may be either: next to its ends, or where it belongs or not
 * as its vertices move by a sixteenth of a pixel, as they do to the grid. On a steep plane that moves a depth far.
 */
static bool belongs(const scene *s, const draw_plane *plane, const double v[3][2], const dp_triangles *class,
                    bool *either) {
    double longest = 0.0, widest = 0.0, facing[2] = {INFINITY, -INFINITY}, moved[2] = {INFINITY, -INFINITY};
    *either = false;
    for (int i = 0; i < 3; i++) {
        const double *next = v[(i + 1) % 3], at = draw_facing(&s->camera, plane, v[i]);
        longest = fmax(longest, hypot(next[0] - v[i][0], next[1] - v[i][1]));
        widest = fmax(widest, fmax(fabs(next[0] - v[i][0]), fabs(next[1] - v[i][1])));
        if (!(at > 0.0) || v[i][0] < 0.0 || v[i][0] > WIDTH || v[i][1] < 0.0 || v[i][1] > HEIGHT)
            return false;
        facing[0] = fmin(facing[0], at);
        facing[1] = fmax(facing[1], at);
        for (int k = 0; k < 4; k++) {
            const double beside[2] = {v[i][0] + (k & 1 ? 0.0625 : -0.0625), v[i][1] + (k & 2 ? 0.0625 : -0.0625)};
            moved[0] = fmin(moved[0], draw_facing(&s->camera, plane, beside));
            moved[1] = fmax(moved[1], draw_facing(&s->camera, plane, beside));
        }
    }
    const double slim = longest * longest / (2.0 * area_of(v)), depth = facing[1] / facing[0];
    const double lo = plane->distance / facing[1], hi = plane->distance / facing[0];
    const bool in = widest <= class->pixels && slim <= class->slim && depth <= class->depth &&
                    lo >= s->setup.spec.znear && hi <= s->setup.spec.zfar;
    *either = fabs(widest / class->pixels - 1.0) < 0.1 || fabs(slim / class->slim - 1.0) < 0.3 ||
              (depth <= class->depth && !(moved[0] * class->depth * (1.0 - 1e-4) > moved[1])) ||
              lo < s->setup.spec.znear * 1.001 || hi > s->setup.spec.zfar * 0.999;
    for (int i = 0; i < 3; i++)
        *either |= fabs(fabs(v[i][0] - WIDTH / 2.0) - WIDTH / 2.0) < 0.1 ||
                   fabs(fabs(v[i][1] - HEIGHT / 2.0) - HEIGHT / 2.0) < 0.1;
    return in;
}

/* How high a triangle is that lies on its longest edge. */
static double height_upon_longest(const double v[3][2]) {
    double longest = 0.0;
    for (int i = 0; i < 3; i++)
        longest = fmax(longest, hypot(v[(i + 1) % 3][0] - v[i][0], v[(i + 1) % 3][1] - v[i][1]));
    return 2.0 * area_of(v) / longest;
}

/* Without a class every triangle of the view is drawn, with one those that belong to it. */
TEST(meshes) {
    tally t = {.name = "triangles of meshes"};
    rng r = rng_make("meshes");
    uint64_t kept = 0, dropped = 0;
    scene s;
    draw_buffer b;
    assert_int_equal(try_scene(&s, "llvmpipe", "fp32", DP_MAPPING_REVERSED), RASTER_OK);
    assert_true(draw_buffer_open(&b, WIDTH * HEIGHT));
    for (uint64_t n = test_cases(300, 3000, 100000); n > 0; n--) {
        const double slant = rng_uniform(&r, 0.0, 1.5), turn = rng_uniform(&r, 0.0, 2.0 * pi);
        const double wide = rng_log(&r, 3.0, 40.0), high = wide / rng_log(&r, 1.0, 12.0);
        draw_plane plane = {{sin(slant) * cos(turn), sin(slant) * sin(turn), cos(slant)}, rng_log(&r, 0.1, 30.0)};
        draw_mesh mesh = {{rng_uniform(&r, 0.0, WIDTH), rng_uniform(&r, 0.0, HEIGHT)},
                          {{wide, rng_uniform(&r, -1, 1)}, {rng_uniform(&r, -1, 1), high}},
                          {4, 4},
                          rng_next(&r),
                          rng_below(&r, 2) == 0 ? 0.0 : high * rng_uniform(&r, 0.5, 1.1)};
        dp_triangles class = s.setup.spec.triangles;
        class.pixels = rng_log(&r, 3.0, 60.0);
        class.slim = rng_log(&r, 2.0, 30.0);
        class.depth = 1.0 + rng_log(&r, 0.01, 10.0);
        int least = 0, most = 0;
        double area = 0.0;
        for (int i = 0; i < 4 * 4 * 2; i++) {
            double v[3][2];
            bool either;
            draw_mesh_corners(&mesh, i / 8, i / 2 % 4, i % 2, v);
            const double upon = height_upon_longest((const double(*)[2])v);
            const bool in = belongs(&s, &plane, (const double(*)[2])v, &class, &either) && upon >= mesh.lowest;
            either = (either && upon >= mesh.lowest) || fabs(upon - mesh.lowest) < 1e-9 * upon;
            least += in && !either && area_of((const double(*)[2])v) > 8.0;
            most += in || either;
            area += area_of((const double(*)[2])v);
        }
        draw_buffer_clear(&b, (draw_area){0, 0, WIDTH, HEIGHT});
        const int drawn = draw_mesh_plane(&b, &s.camera, &plane, &mesh, &class, 1);
        TALLY(&t, drawn >= least && drawn <= most, "%d triangles are drawn, not %d to %d", drawn, least, most);
        TALLY(&t, area > 0.5 * 16.0 * (wide * high - 1.0), "the cells have %g pixels, which cover %g", area,
              16.0 * wide * high);
        kept += (uint64_t)drawn;
        dropped += 32U - (uint64_t)drawn;
    }
    draw_buffer_close(&b);
    print_message("# %lu triangles drawn, %lu left out\n", (unsigned long)kept, (unsigned long)dropped);
    assert_true(kept > 500 && dropped > 500);
    tally_end(&t);
}

/* No pixel between the triangles of a mesh is left out. */
TEST(closed) {
    rng r = rng_make("closed");
    scene s;
    draw_buffer b;
    assert_int_equal(try_scene(&s, "llvmpipe", "unorm24", DP_MAPPING_D3D), RASTER_OK);
    assert_true(draw_buffer_open(&b, 40 * 30));
    for (uint64_t n = test_cases(20, 100, 2000); n > 0; n--) {
        const draw_plane plane = {{0.0, 0.6, 0.8}, 5.0};
        const double cell = rng_uniform(&r, 3.0, 8.0), cells = ceil(46.0 / cell) + 1.0;
        const draw_mesh mesh = {
            {57.0 - cell, 27.0 - cell}, {{cell, 0}, {0, cell}}, {(int)cells, (int)cells}, rng_next(&r), 0.0};
        draw_buffer_clear(&b, (draw_area){60, 30, 40, 30});
        draw_mesh_plane(&b, &s.camera, &plane, &mesh, NULL, 3);
        for (int i = 0; i < 40 * 30; i++)
            if (b.winner[i] != 3 || b.seen[i] != 4)
                fail_msg("cells of %g pixels: pixel %d, %d shows %d", cell, i % 40, i / 40, b.winner[i]);
    }
    draw_buffer_close(&b);
}
