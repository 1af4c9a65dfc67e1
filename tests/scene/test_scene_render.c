/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * What src/scene draws: who is seen in each pixel, by triangles drawn one by one with src/draw; which pixels are wrong,
 * by rays in long double through the world; decals at known distances; views of all of a model.
 */
#include "depthprec/depthprec.h"
#include "scene/judge.h"
#include "scene/render.h"
#include "scene_made.h"
#include "support.h"

enum { WIDTH = 160, HEIGHT = 90, TRIANGLES = 24 };

static scene_made made;

typedef struct stage {
    dp_setup setup;
    draw_camera camera;
} stage;

static stage stage_of(const char *raster, const char *format, dp_mapping mapping, double znear, double zfar) {
    stage s;
    dp_spec spec = dp_spec_default();
    dp_format found[2];
    const raster_row *row = raster_find(raster);
    assert_int_equal(dp_format_parse(format, found), 1);
    spec.triangles = dp_triangles_default();
    raster_describe(row, &spec.triangles);
    spec.triangles.width = WIDTH;
    spec.triangles.height = HEIGHT;
    spec.format = found[0];
    spec.mapping = mapping;
    spec.model = DP_MODEL_FLOAT;
    spec.znear = znear;
    spec.zfar = zfar;
    assert_true(raster_arith(row, false, &spec.arith));
    assert_int_equal(dp_setup_init(&s.setup, &spec), DP_OK);
    assert_int_equal(draw_camera_init(&s.camera, row, &s.setup), RASTER_OK);
    return s;
}

/* ---- The truth --------------------------------------------------------------------------------------------------- */

typedef struct hit {
    bool drawn;
    uint32_t key;
    long double depth, inside; /* the least of the barycentric coordinates */
    long double corner[4];     /* 1 over the depth of its plane at those of the pixel */
} hit;

static long double dot(const long double a[3], const long double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const long double a[3], const long double b[3], long double out[3]) {
    for (int k = 0; k < 3; k++)
        out[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

/* Where a ray of the world meets a triangle, by Moeller and Trumbore: its depth is the ray's parameter. */
static void meet(const double eye[3], const long double ray[3], const double (*corner)[3], hit *out) {
    long double u[3], v[3], from[3], p[3], q[3];
    for (int k = 0; k < 3; k++) {
        u[k] = (long double)corner[1][k] - (long double)corner[0][k];
        v[k] = (long double)corner[2][k] - (long double)corner[0][k];
        from[k] = (long double)eye[k] - (long double)corner[0][k];
    }
    cross(ray, v, p);
    cross(from, u, q);
    const long double det = dot(u, p), b = dot(from, p) / det, c = dot(ray, q) / det;
    out->depth = dot(v, q) / det;
    out->inside = fminl(fminl(b, c), 1.0L - b - c);
}

/* The view's axes as rows: right, up, ahead. */
static void axes_of(const scene_eye *v, long double axis[3][3]) {
    for (int k = 0; k < 3; k++) {
        axis[0][k] = (long double)v->right[k];
        axis[1][k] = (long double)v->up[k];
        axis[2][k] = (long double)v->ahead[k];
    }
}

/* Whether the triangle is drawn at all, by its front side in the world; then each pixel of it. */
static bool draw_one(const stage *s, const render_asked *asked, uint32_t t, draw_buffer *b) {
    const model *m = asked->m;
    long double axis[3][3], side[2][3], normal[3], from[3];
    double corner[3][3], place[3][3];
    axes_of(&asked->eye, axis);
    for (int i = 0; i < 3; i++) {
        memcpy(corner[i], m->position[m->triangle[t][i]], sizeof corner[i]);
        for (int k = 0; k < 3; k++)
            from[k] = (long double)corner[i][k] - (long double)asked->eye.place[k];
        for (int k = 0; k < 3; k++)
            place[i][k] = (double)dot(axis[k], from);
    }
    for (int k = 0; k < 3; k++) {
        side[0][k] = (long double)corner[1][k] - (long double)corner[0][k];
        side[1][k] = (long double)corner[2][k] - (long double)corner[0][k];
    }
    cross(side[0], side[1], normal);
    draw_buffer_clear(b, (draw_area){0, 0, WIDTH, HEIGHT});
    const model_surface *of = &m->surface[m->of[t]];
    if ((dot(normal, from) >= 0.0L && !of->two_sided) || (of->blended && !asked->blended))
        return false;
    draw_triangle(b, &s->camera, (const double(*)[3])place, 1);
    return true;
}

static hit hits[TRIANGLES][HEIGHT * WIDTH];

static void draw_truth(const stage *s, const render_asked *asked) {
    draw_buffer b;
    long double axis[3][3];
    axes_of(&asked->eye, axis);
    assert_true(draw_buffer_open(&b, (size_t)WIDTH * HEIGHT));
    for (uint32_t t = 0; t < asked->m->triangles; t++) {
        double corner[3][3];
        const bool drawn = draw_one(s, asked, t, &b);
        for (int i = 0; i < 3; i++)
            memcpy(corner[i], asked->m->position[asked->m->triangle[t][i]], sizeof corner[i]);
        for (int i = 0; i < HEIGHT * WIDTH; i++) {
            hit *h = &hits[t][i];
            const long double x = (2 * (i % WIDTH) + 1.0L - WIDTH) / WIDTH / (long double)s->camera.p00;
            const long double y = (2 * (i / WIDTH) + 1.0L - HEIGHT) / HEIGHT / (long double)s->camera.p11;
            long double ray[3];
            hit beside;
            *h = (hit){.drawn = drawn && b.seen[i] != 0, .key = b.key[i]};
            for (int k = 0; k < 3; k++)
                ray[k] = x * axis[0][k] + y * axis[1][k] + axis[2][k];
            if (h->drawn)
                meet(asked->eye.place, ray, (const double(*)[3])corner, h);
            for (int c = 0; c < 4 && h->drawn; c++) {
                const long double u = x + (c % 2 == 0 ? -1 : 1) / (long double)WIDTH / (long double)s->camera.p00;
                const long double v = y + (c / 2 == 0 ? -1 : 1) / (long double)HEIGHT / (long double)s->camera.p11;
                for (int k = 0; k < 3; k++)
                    ray[k] = u * axis[0][k] + v * axis[1][k] + axis[2][k];
                meet(asked->eye.place, ray, (const double(*)[3])corner, &beside);
                h->corner[c] = 1.0L / beside.depth;
            }
        }
    }
    draw_buffer_close(&b);
}

/* Two depths that differ by less than `same` are one, by more than `apart` two; between the two nothing is expected. */
static const long double unsure = 1e-11L, same = 1e-14L, apart = 1e-8L;

/* Whether plane s is before plane h at a corner of the pixel. *doubt: that is not to be told. */
static bool before_somewhere(const hit *s, const hit *h, bool *doubt) {
    bool before = false;
    for (int c = 0; c < 4; c++) {
        const long double more = s->corner[c] - h->corner[c], size = fabsl(s->corner[c]) + fabsl(h->corner[c]);
        *doubt = *doubt || (fabsl(more) > 4.0L * same * size && fabsl(more) < apart * size);
        before = before || more > 4.0L * same * size;
    }
    return before;
}

/* The triangle that is seen, and whether another triangle is as near and does not cross it there, RENDER_NOTHING where
 * that is not to be told. */
static uint32_t judge(int i, size_t triangles, bool *wrong, long double *nearest) {
    uint32_t shown = RENDER_NOTHING;
    bool edge = false;
    for (uint32_t k = 0; k < triangles; k++)
        if (hits[k][i].drawn && (shown == RENDER_NOTHING || hits[k][i].key < hits[shown][i].key))
            shown = k;
    *nearest = HUGE_VALL;
    for (uint32_t k = 0; k < triangles && shown != RENDER_NOTHING; k++) {
        const hit *h = &hits[k][i], *s = &hits[shown][i];
        if (!h->drawn)
            continue;
        const long double far_off = fabsl(h->depth - s->depth) / s->depth;
        edge = edge || fabsl(h->inside) < unsure || (far_off > same && far_off < apart);
        if (k != shown && h->inside > 0.0L && !before_somewhere(s, h, &edge))
            *nearest = fminl(*nearest, h->depth);
    }
    *wrong =
        shown != RENDER_NOTHING && hits[shown][i].inside > 0.0L && *nearest <= hits[shown][i].depth * (1.0L + same);
    return edge ? RENDER_NOTHING : shown;
}

static void compare(const render_picture *p, size_t triangles, tally *t, size_t *wrong) {
    size_t marked = 0;
    for (int i = 0; i < HEIGHT * WIDTH; i++) {
        long double nearest;
        bool expected;
        const uint32_t shown = judge(i, triangles, &expected, &nearest), nearer = p->nearer[i];
        marked += nearer != RENDER_NOTHING;
        if (shown == RENDER_NOTHING)
            continue;
        *wrong += expected;
        TALLY(t, p->shown[i] == shown, "pixel %d shows %u, not %u", i, p->shown[i], shown);
        TALLY(t, expected == (nearer != RENDER_NOTHING), "pixel %d: wrong %d; shown at %.12Lg, nearest %.12Lg", i,
              expected, hits[shown][i].depth, nearest);
        if (expected && nearer != RENDER_NOTHING)
            TALLY(t, hits[nearer][i].inside > 0.0L && hits[nearer][i].depth <= nearest * (1.0L + apart),
                  "pixel %d: not %.12Lg, but %.12Lg is nearest", i, hits[nearer][i].depth, nearest);
    }
    TALLY(t, marked == p->wrong, "%zu pixels are marked, %zu counted", marked, p->wrong);
}

/* ---- Random scenes ----------------------------------------------------------------------------------------------- */

static void turn(rng *r, double a[3], double b[3]) {
    double length = 0.0;
    for (int k = 0; k < 3; k++) {
        a[k] = rng_uniform(r, -1.0, 1.0);
        b[k] = rng_uniform(r, -1.0, 1.0);
        length += a[k] * a[k];
    }
    for (int k = 0; k < 3; k++)
        a[k] /= sqrt(length);
    const double along = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    for (int k = 0; k < 3; k++)
        b[k] -= along * a[k];
    length = sqrt(b[0] * b[0] + b[1] * b[1] + b[2] * b[2]);
    for (int k = 0; k < 3; k++)
        b[k] /= length;
}

/* Sheets that are nearly in one plane, exactly so, or cross; what is seen from one side, from both, and glass. */
static void fill(rng *r) {
    const int axis = (int)rng_below(r, 3);
    scene_made_begin(&made);
    for (int i = 0; i < TRIANGLES / 4; i++) {
        double at[3], u[3] = {0}, v[3] = {0};
        const uint32_t s = scene_made_surface(&made, "sheet", "");
        made.surface[s].two_sided = rng_below(r, 2) == 0;
        made.surface[s].blended = rng_below(r, 6) == 0;
        for (int k = 0; k < 3; k++)
            at[k] = rng_uniform(r, -8.0, 0.0);
        at[axis] = rng_below(r, 3) == 0 ? 0.0 : rng_log(r, 1e-7, 0.1);
        u[(axis + 1) % 3] = rng_uniform(r, 4.0, 12.0);
        v[(axis + 2) % 3] = rng_uniform(r, 4.0, 12.0);
        scene_made_quad(&made, at, u, v);
    }
    scene_made_surface(&made, "any", "");
    for (int i = 0; i < TRIANGLES / 2; i++) {
        double corner[3][3];
        for (int k = 0; k < 9; k++)
            corner[k / 3][k % 3] = rng_uniform(r, -9.0, 9.0);
        scene_made_triangle(&made, corner[0], corner[1], corner[2]);
    }
}

TEST(test_truth) {
    static const struct {
        const char *raster, *format;
        dp_mapping mapping;
        double znear, zfar;
    } rows[] = {{"llvmpipe", "unorm16", DP_MAPPING_D3D, 0.1, 100},
                {"llvmpipe", "unorm24", DP_MAPPING_D3D, 0.001, 1000},
                {"swiftshader", "fp32", DP_MAPPING_REVERSED, 0.1, 1000},
                {"softpipe", "unorm24", DP_MAPPING_D3D, 0.01, 100}};
    tally t = {.name = "pixels of random scenes"};
    rng r = rng_make("render");
    size_t wrong = 0;
    for (uint64_t i = 0; i < test_cases(4, 24, 400); i++) {
        const size_t k = i % (sizeof rows / sizeof rows[0]);
        const stage s = stage_of(rows[k].raster, rows[k].format, rows[k].mapping, rows[k].znear, rows[k].zfar);
        render_asked asked = {.m = &made.m, .camera = &s.camera, .blended = rng_below(&r, 2) == 0};
        render_picture p;
        fill(&r);
        turn(&r, asked.eye.ahead, asked.eye.up);
        for (int axis = 0; axis < 3; axis++)
            asked.eye.right[axis] = asked.eye.ahead[(axis + 1) % 3] * asked.eye.up[(axis + 2) % 3] -
                                    asked.eye.ahead[(axis + 2) % 3] * asked.eye.up[(axis + 1) % 3];
        for (int axis = 0; axis < 3; axis++)
            asked.eye.place[axis] = rng_uniform(&r, -3.0, 3.0) - rng_uniform(&r, 0.0, 20.0) * asked.eye.ahead[axis];
        assert_int_equal(render_draw(&asked, &p), RENDER_DONE);
        draw_truth(&s, &asked);
        compare(&p, made.m.triangles, &t, &wrong);
        render_free(&p);
    }
    TALLY(&t, wrong > 100, "only %zu pixels are wrong", wrong);
    tally_end(&t);
}

/* Two sheets in one plane, seen almost along it: the horizon lies inside pixels, some of whose corners see neither. */
TEST(test_horizon) {
    tally t = {.name = "pixels of a horizon"};
    rng r = rng_make("horizon");
    size_t wrong = 0;
    for (uint64_t i = 0; i < test_cases(4, 12, 400); i++) {
        const stage s = stage_of("llvmpipe", "unorm24", DP_MAPPING_D3D, 0.1, 100);
        const double place[3] = {rng_uniform(&r, -0.1, 0.1), rng_log(&r, 0.01, 0.1), 0}, tilt = rng_uniform(&r, -1, 1);
        const render_asked asked = {.m = &made.m,
                                    .camera = &s.camera,
                                    .eye = {.place = {place[0], place[1], place[2]},
                                            .right = {cos(tilt), sin(tilt), 0},
                                            .up = {-sin(tilt), cos(tilt), 0},
                                            .ahead = {0, 0, -1}}};
        render_picture p;
        scene_made_begin(&made);
        for (int k = 0; k < 2; k++) {
            made.surface[scene_made_surface(&made, "sheet", "")].two_sided = true;
            scene_made_quad(&made, (const double[3]){-3 - k, 0, -5}, (const double[3]){6, 0, 0},
                            (const double[3]){0, 0, -60 - k});
        }
        assert_int_equal(render_draw(&asked, &p), RENDER_DONE);
        draw_truth(&s, &asked);
        compare(&p, made.m.triangles, &t, &wrong);
        render_free(&p);
    }
    assert_true(wrong > 100);
    tally_end(&t);
}

/* ---- A decal ----------------------------------------------------------------------------------------------------- */

static scene_eye ahead_from(double z) {
    return (scene_eye){.place = {0, 0, z}, .right = {1, 0, 0}, .up = {0, 1, 0}, .ahead = {0, 0, -1}};
}

static size_t wrong_from(const stage *s, double z) {
    const render_asked asked = {.m = &made.m, .camera = &s->camera, .eye = ahead_from(z)};
    render_picture p;
    assert_int_equal(render_draw(&asked, &p), RENDER_DONE);
    const size_t wrong = p.wrong;
    render_free(&p);
    return wrong;
}

/* Nearer than is certain nothing is wrong, and where they tie what is drawn first is seen: the wall, or the decal. */
TEST(test_decal) {
    static const double gaps[] = {0, 0x1p-10, 0x1p-8, 0x1p-6};
    const stage s = stage_of("llvmpipe", "unorm24", DP_MAPPING_D3D, 0.01, 10000);
    for (int first = 0; first < 2; first++)
        for (size_t i = 0; i < sizeof gaps / sizeof gaps[0]; i++) {
            const scene_verdict v = scene_judge(&s.setup, gaps[i], gaps[i], 9000);
            scene_made_begin(&made);
            for (int k = 0; k < 2; k++) {
                const bool decal = k == first;
                scene_made_surface(&made, decal ? "decal" : "wall", "");
                scene_made_quad(&made, (const double[3]){-500, -400, decal ? gaps[i] : 0},
                                (const double[3]){1000, 0, 0}, (const double[3]){0, 1000, 0});
            }
            for (int k = 1; k <= 8 && v.certain_to > 0.0; k++)
                assert_int_equal(wrong_from(&s, v.certain_to * k / 8.0), 0);
            if (gaps[i] == 0.0)
                assert_int_equal(wrong_from(&s, 1.0), WIDTH * HEIGHT);
            size_t wrong = 0;
            for (int k = 1; k <= 8; k++)
                wrong += wrong_from(&s, v.ties_from * (2.0 + k / 8.0));
            assert_true(wrong > 0 || first == 0);
        }
}

/* ---- What is drawn, colours, views ------------------------------------------------------------------------------- */

/* A wall that fills the lower half, seen from its front, its back, as glass. */
static size_t shown_of(bool back, bool two_sided, bool any_side, bool blended, bool also, uint32_t *pixel) {
    const stage s = stage_of("llvmpipe", "fp32", DP_MAPPING_REVERSED, 0.1, 100);
    render_asked asked = {
        .m = &made.m, .camera = &s.camera, .eye = ahead_from(2.0), .any_side = any_side, .blended = also};
    render_picture p;
    size_t count = 0;
    scene_made_begin(&made);
    scene_made_surface(&made, "wall", "");
    made.surface[0].two_sided = two_sided;
    made.surface[0].blended = blended;
    scene_made_quad(&made, (const double[3]){back ? 50 : -50, -50, 0}, (const double[3]){back ? -100 : 100, 0, 0},
                    (const double[3]){0, 50, 0});
    assert_int_equal(render_draw(&asked, &p), RENDER_DONE);
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        count += p.shown[i] != RENDER_NOTHING;
    assert_int_equal(p.wrong, 0);
    if (pixel != NULL) {
        p.nearer[0] = 0; /* the lowest on the left */
        render_colours(&asked, &p, pixel);
    }
    render_free(&p);
    return count;
}

TEST(test_drawn) {
    static uint32_t pixel[HEIGHT * WIDTH];
    const size_t half = WIDTH * HEIGHT / 2;
    assert_int_equal(shown_of(false, false, false, false, false, NULL), half);
    assert_int_equal(shown_of(true, false, false, false, false, NULL), 0);
    assert_int_equal(shown_of(true, true, false, false, false, NULL), half);
    assert_int_equal(shown_of(true, false, true, false, false, NULL), half);
    assert_int_equal(shown_of(false, false, false, true, false, NULL), 0);
    assert_int_equal(shown_of(false, false, false, true, true, pixel), half);
    const uint32_t wall = pixel[HEIGHT * WIDTH - 1];
    for (int i = 0; i < HEIGHT * WIDTH; i++) {
        const bool red = i == (HEIGHT - 1) * WIDTH;
        assert_int_equal(pixel[i] >> 24, 0xFF);
        assert_int_equal(pixel[i], red ? 0xFFFF0000U : i / WIDTH < HEIGHT / 2 ? pixel[0] : wall);
    }
    assert_int_equal(wall >> 16 & 0xFF, wall & 0xFF);
    assert_int_not_equal(wall, pixel[0]);
}

/* All corners are in the picture, one nearly at its rim; the sheet that is asked for shows its front. */
TEST(test_overview) {
    rng r = rng_make("overview");
    for (int i = 0; i < 40; i++) {
        const stage s = stage_of("llvmpipe", "fp32", DP_MAPPING_REVERSED, 0.1, 100);
        const double towards[2][3] = {{rng_uniform(&r, -9, 9), 0.0, rng_uniform(&r, -9, 9)}, {0.1, 1.0, 0.1}};
        long double axis[3][3], most = 0.0L, from[3];
        fill(&r);
        const scene_eye v = render_overview(&made.m, &s.camera, 2, towards);
        axes_of(&v, axis);
        for (int a = 0; a < 3; a++)
            for (int b = 0; b < 3; b++)
                assert_true(fabsl(dot(axis[a], axis[b]) - (a == b)) < 1e-14L);
        assert_true(v.up[1] > 0.0 && v.ahead[1] < 0.0);
        assert_true(v.ahead[0] * towards[0][0] + v.ahead[2] * towards[0][2] < 0.0);
        for (size_t c = 0; c < made.m.vertices; c++) {
            for (int k = 0; k < 3; k++)
                from[k] = (long double)made.m.position[c][k] - (long double)v.place[k];
            const long double z = dot(axis[2], from);
            assert_true(z > 0.0L);
            most = fmaxl(most, fabsl(dot(axis[0], from)) / z * (long double)s.camera.p00);
            most = fmaxl(most, fabsl(dot(axis[1], from)) / z * (long double)s.camera.p11);
        }
        assert_true(most < 1.0L && most > 0.75L);
    }
}

static int after(void *context, double share) {
    int *left = context;
    assert_true(share >= 0.0 && share <= 1.0);
    return --*left < 0;
}

TEST(test_refused) {
    const stage s = stage_of("llvmpipe", "fp32", DP_MAPPING_REVERSED, 0.1, 100);
    int left = 0;
    render_asked asked = {
        .m = &made.m, .camera = &s.camera, .eye = ahead_from(2.0), .progress = after, .context = &left};
    render_picture p;
    scene_made_begin(&made);
    assert_int_equal(render_draw(&asked, &p), RENDER_DONE);
    render_free(&p);
    scene_made_surface(&made, "wall", "");
    scene_made_quad(&made, (const double[3]){0, 0, 0}, (const double[3]){1, 0, 0}, (const double[3]){0, 1, 0});
    for (left = 0; left < 2; left++) {
        int now = left;
        asked.context = &now;
        assert_int_equal(render_draw(&asked, &p), RENDER_STOPPED);
    }
    asked.progress = NULL;
    for (int k = 0; k < 2; k++) {
        made.m.position[1][0] = k == 0 ? 2e30 : 1.0;
        asked.eye.place[2] = k == 0 ? 2.0 : -2e30;
        assert_int_equal(render_draw(&asked, &p), RENDER_RANGE);
    }
}
