/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The picture whose decals flicker: none does from the guarantee on, over whole loops of the camera; below it they do.
 * Of mappings and formats that no rasterizer of src/raster draws, too: they are drawn as the class has it.
 * Which surface is nearer is judged by the planes of the triangles in double, who covers a pixel by src/draw's keys.
 */
#include <time.h>

#include "raster/picture.h"
#include "support.h"

enum { W = DRAW_PICTURE_WIDTH, H = DRAW_PICTURE_HEIGHT, SURFACES = 6, TRIANGLES = 64 };

static const double pi = 3.14159265358979323846;

static dp_spec spec_of(const char *format, dp_mapping mapping, double znear, double zfar) {
    dp_spec spec = dp_spec_default();
    dp_format found[2];
    assert_int_equal(dp_format_parse(format, found), 1);
    spec.format = found[0];
    spec.mapping = mapping;
    spec.znear = znear;
    spec.zfar = zfar;
    return spec;
}

static void open_standard(draw_picture *p) {
    const dp_spec spec = spec_of("unorm24", DP_MAPPING_D3D, 0.1, 1000.0);
    assert_null(draw_picture_open(p, &spec, NULL, 16.1));
}

/* Half the height of the view at depth 1. */
static double half_of(const draw_picture *p) {
    return tan(p->setup.spec.triangles.fov_y * pi / 360.0);
}

/* ---- The triangles of a frame ------------------------------------------------------------------------------------ */

typedef struct triangles {
    int count;
    unsigned who[TRIANGLES];
    double place[TRIANGLES][3][3], normal[TRIANGLES][3], distance[TRIANGLES]; /* normal . X = distance > 0 */
} triangles;

static void note(void *context, const double place[3][3], unsigned who) {
    triangles *t = context;
    double side[2][3], *n = t->normal[t->count];
    assert_in_range(t->count, 0, TRIANGLES - 1);
    assert_in_range(who, 1, SURFACES);
    memcpy(t->place[t->count], place, sizeof t->place[0]);
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 3; k++)
            side[i][k] = place[i + 1][k] - place[0][k];
    for (int k = 0; k < 3; k++)
        n[k] = side[0][(k + 1) % 3] * side[1][(k + 2) % 3] - side[0][(k + 2) % 3] * side[1][(k + 1) % 3];
    const double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    const double towards = n[0] * place[0][0] + n[1] * place[0][1] + n[2] * place[0][2];
    for (int k = 0; k < 3; k++)
        n[k] /= towards > 0.0 ? length : -length;
    t->distance[t->count] = fabs(towards) / length;
    t->who[t->count++] = who;
}

static triangles triangles_of(const draw_picture *p, double gap, unsigned frame) {
    triangles t = {0};
    draw_picture_triangles(p, gap, frame, note, &t);
    return t;
}

/* The class of dp_triangles_default(), in pixels of the picture, with an eighth of a pixel to spare. */
static void judge_class(tally *y, const draw_picture *p, const triangles *t, int i) {
    const double half = half_of(p), spare = 0.125, z = p->z, high = p->setup.spec.triangles.height;
    double x[3][2], lo = INFINITY, hi = 0.0, longest = 0.0, widest = 0.0;
    for (int c = 0; c < 3; c++) {
        const double *at = t->place[i][c];
        x[c][0] = W / 2.0 + at[0] / at[2] / half * high / 2.0;
        x[c][1] = H / 2.0 + at[1] / at[2] / half * high / 2.0;
        lo = fmin(lo, at[2]);
        hi = fmax(hi, at[2]);
        TALLY(y, x[c][0] > spare && x[c][0] < W - spare && x[c][1] > spare && x[c][1] < H - spare,
              "a vertex of %u at %g, %g", t->who[i], x[c][0], x[c][1]);
    }
    for (int c = 0; c < 3; c++) {
        const double dx = x[(c + 1) % 3][0] - x[c][0], dy = x[(c + 1) % 3][1] - x[c][1];
        longest = fmax(longest, hypot(dx, dy));
        widest = fmax(widest, fmax(fabs(dx), fabs(dy)));
    }
    const double area = fabs((x[1][0] - x[0][0]) * (x[2][1] - x[0][1]) - (x[2][0] - x[0][0]) * (x[1][1] - x[0][1]));
    TALLY(y, lo > 0.54 * z && hi < 1.61 * z && hi < 1.98 * lo, "%u lies from %g to %g", t->who[i], lo / z, hi / z);
    TALLY(y, widest < 512.0 - spare, "%u is %g pixels wide", t->who[i], widest);
    TALLY(y, longest * longest / area < 14.0, "%u is as slim as 1:%g", t->who[i], longest * longest / area);
}

TEST(within_the_class) {
    tally y = {.name = "triangles in the class"};
    static const struct {
        int width, height;
        double fov;
    } views[] = {{1920, 1080, 60.0}, {640, 360, 45.0}, {640, 360, 100.0}, {7680, 4320, 40.0}, {2000, 2001, 5.0}};
    for (size_t v = 0; v < sizeof views / sizeof views[0]; v++) {
        dp_spec spec = spec_of("unorm24", DP_MAPPING_D3D, 0.1, 1000.0);
        draw_picture p;
        spec.triangles = dp_triangles_default();
        spec.triangles.width = views[v].width;
        spec.triangles.height = views[v].height;
        spec.triangles.fov_y = views[v].fov;
        assert_null(draw_picture_open(&p, &spec, NULL, 100.0));
        for (unsigned frame = 0; frame < DRAW_PICTURE_FRAMES; frame += 5)
            for (int g = 0; g <= 4; g++) {
                const triangles t = triangles_of(&p, g / 4.0 * draw_picture_widest(&p), frame);
                for (int i = 0; i < t.count; i++)
                    judge_class(&y, &p, &t, i);
            }
        draw_picture_close(&p);
    }
    tally_end(&y);
}

/* All triangles of a surface lie in one plane, and what lies upon it in one that is the gap nearer. */
TEST(a_gap_apart) {
    static const double slants[] = {0.0, 45.0, 45.0, 30.0, 30.0, 90.0, 90.0};
    tally y = {.name = "planes"};
    draw_picture p;
    rng r = rng_make("a gap apart");
    open_standard(&p);
    for (unsigned frame = 0; frame < DRAW_PICTURE_FRAMES; frame += 7) {
        const double gap = rng_log(&r, 1e-4, 1.0) * draw_picture_widest(&p);
        const triangles t = triangles_of(&p, gap, frame);
        double plane[SURFACES + 1] = {0};
        for (int i = 0; i < t.count; i++) {
            const unsigned who = t.who[i];
            plane[who] = plane[who] > 0.0 ? plane[who] : t.distance[i];
            TALLY(&y, fabs(t.distance[i] - plane[who]) < 1e-13 * p.z, "%u: %g off", who, t.distance[i] - plane[who]);
            TALLY(&y, fabs(acos(fmin(t.normal[i][2], 1.0)) * 180.0 / pi - slants[who]) < 1e-6, "slant of %u", who);
        }
        for (int below = 1; below <= SURFACES; below += 2)
            TALLY(&y, fabs(plane[below] - plane[below + 1] - gap) < 1e-13 * p.z, "gap %.17g, drawn %.17g", gap,
                  plane[below] - plane[below + 1]);
    }
    draw_picture_close(&p);
    tally_end(&y);
}

/* ---- A frame, pixel by pixel ------------------------------------------------------------------------------------- */

typedef struct truth {
    const draw_picture *p;
    const triangles *t;
    int at; /* the triangle that is drawn */
    uint32_t key[W * H];
    int shown[W * H]; /* triangle, or -1 */
    double depth[SURFACES + 1][W * H];
} truth;

static void take(void *context, int x, int y, int count, const uint32_t *key) {
    truth *s = context;
    for (int i = 0; i < count; i++) {
        const draw_area *area = &s->p->buffer.area;
        const int at = (y - area->y) * W + x - area->x + i;
        const double window[2] = {x + i + 0.5, y + 0.5}, *n = s->t->normal[s->at];
        double ray[3];
        draw_ray(&s->p->camera, window, ray);
        s->depth[s->t->who[s->at]][at] = s->t->distance[s->at] / (n[0] * ray[0] + n[1] * ray[1] + n[2] * ray[2]);
        if (key[i] < s->key[at]) {
            s->key[at] = key[i];
            s->shown[at] = s->at;
        }
    }
}

static void draw_truth(truth *s, const draw_picture *p, const triangles *t) {
    const draw_area all = p->buffer.area;
    memset(s->key, 0xFF, sizeof s->key);
    memset(s->depth, 0, sizeof s->depth);
    s->p = p;
    s->t = t;
    for (int i = 0; i < W * H; i++)
        s->shown[i] = -1;
    for (s->at = 0; s->at < t->count; s->at++)
        draw_keys(&p->camera, &all, (const double(*)[3])t->place[s->at], take, s);
}

/* The surface that should be seen where `who` is: what lies upon it, if that is there and nearer. */
static bool is_wrong(const truth *s, int at) {
    const unsigned who = s->shown[at] >= 0 ? s->t->who[s->shown[at]] : 0;
    if (who % 2 == 0)
        return false;
    const double upper = s->depth[who + 1][at];
    return upper > 0.0 && upper < s->depth[who][at];
}

TEST(each_pixel) {
    static const char *const names[] = {"llvmpipe", "softpipe", "swiftshader", "none"};
    static uint32_t plain[W * H], marked[W * H];
    truth *s = malloc(sizeof *s);
    tally y = {.name = "pixels"};
    assert_non_null(s);
    for (int i = 0; i < 4; i++) {
        const dp_spec spec =
            spec_of(i == 1 ? "unorm24" : "fp32", i == 1 ? DP_MAPPING_REVERSED : DP_MAPPING_D3D, 0.1, 1000.0);
        draw_picture p;
        uint32_t colour[SURFACES + 1] = {0};
        size_t wrong = 0, covered = 0;
        assert_null(draw_picture_open(&p, &spec, raster_find(names[i]), 16.1));
        const double gap = 0.03 * p.guaranteed;
        const unsigned frame = 77U * (unsigned)i + 20U;
        const triangles t = triangles_of(&p, gap, frame);
        const draw_picture_count count = draw_picture_frame(&p, gap, frame, false, plain);
        draw_picture_frame(&p, gap, frame, true, marked);
        draw_truth(s, &p, &t);
        for (int at = 0; at < W * H; at++) {
            const int seen = (H - 1 - at / W) * W + at % W;
            const unsigned who = s->shown[at] >= 0 ? t.who[s->shown[at]] : 0;
            const bool is = is_wrong(s, at);
            wrong += is;
            covered += s->depth[2][at] > 0.0 || s->depth[4][at] > 0.0 || s->depth[6][at] > 0.0;
            if (who != 0 && colour[who] == 0)
                colour[who] = plain[seen];
            TALLY(&y, who == 0 || plain[seen] == colour[who], "%s: pixel %d of %u has another colour", names[i], at,
                  who);
            TALLY(&y, is == (plain[seen] != marked[seen]), "%s: pixel %d is %s", names[i], at, is ? "wrong" : "right");
        }
        print_message("# %s: %zu of %zu wrong\n", names[i], wrong, covered);
        assert_true(wrong > 100 && covered > 20000);
        assert_int_equal(count.wrong, wrong);
        assert_int_equal(count.covered, covered);
        for (int a = 1; a <= SURFACES; a++)
            for (int b = 1; b < a; b++)
                assert_true(colour[a] != 0 && colour[a] != colour[b]);
        draw_picture_close(&p);
    }
    free(s);
    tally_end(&y);
}

/* ---- The guarantee ----------------------------------------------------------------------------------------------- */

/* The guarantee of what is drawn, by the budget, over the depths of the scene and nearer ones. */
static double by_budget(const draw_picture *p) {
    const dp_setup *both[] = {&p->asked, &p->setup};
    double worst = 0.0;
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 400; k++) {
            const double z = p->reach * pow(p->setup.spec.znear / p->reach, k / 400.0);
            dp_budget budget;
            assert_int_equal(dp_budget_at(both[i], z, NULL, &budget), DP_OK);
            worst = fmax(worst, budget.separation);
        }
    return worst;
}

typedef struct camera {
    double znear, zfar, z;
} camera;

static void judge_loop(tally *y, draw_picture *p, double gap, unsigned step, const char *name) {
    for (unsigned frame = 0; frame < DRAW_PICTURE_FRAMES; frame += step) {
        const draw_picture_count count = draw_picture_frame(p, gap, frame, false, NULL);
        TALLY(y, count.wrong == 0 && count.covered > 20000, "%s: gap %.17g of %.17g, frame %u: %zu of %zu pixels wrong",
              name, gap, p->guaranteed, frame, count.wrong, count.covered);
    }
}

TEST(none_from_the_guarantee_on) {
    static const char *const names[] = {"llvmpipe", "lavapipe", "softpipe", "swiftshader", "none"};
    static const char *const formats[] = {"fp32", "unorm24", "unorm16", "fp16"};
    static const camera cameras[] = {{0.1, 1000.0, 16.0}, {1.0, 30.0, 9.0}, {0.01, INFINITY, 80.0}};
    tally y = {.name = "from the guarantee on"};
    for (size_t i = 0; i < sizeof names / sizeof names[0] * 4; i++)
        for (dp_mapping m = DP_MAPPING_D3D; m <= DP_MAPPING_GL_REVERSED; m++)
            for (int c = 0; c < 3; c++) {
                dp_spec spec = spec_of(formats[i % 4], m, cameras[c].znear, cameras[c].zfar);
                draw_picture p;
                char name[80];
                spec.triangles = dp_triangles_default(); /* of rasterizers the row says it */
                spec.triangles.subpixel = (const int[]){8, 0, 4}[c];
                if (draw_picture_open(&p, &spec, raster_find(names[i / 4]), cameras[c].z) != NULL)
                    continue;
                snprintf(name, sizeof name, "%s %s %s %d", names[i / 4], formats[i % 4], dp_mapping_get(m)->name, c);
                if (p.guaranteed <= draw_picture_widest(&p)) {
                    const double budget = by_budget(&p);
                    TALLY(&y, p.guaranteed >= budget && p.guaranteed <= 1.06 * budget, "%s: %.17g, budget %.17g", name,
                          p.guaranteed, budget);
                    judge_loop(&y, &p, p.guaranteed, (unsigned)test_cases(100, 12, 1), name);
                    judge_loop(&y, &p, fmin(3.0 * p.guaranteed, draw_picture_widest(&p)), 75, name);
                } else
                    y.skipped++;
                draw_picture_close(&p);
            }
    tally_end(&y);
}

/* The standard one, every frame; how far below the guarantee the last wrong pixel is. */
TEST(below_they_fight) {
    draw_picture p;
    double highest = 0.0;
    tally y = {.name = "every frame"};
    open_standard(&p);
    judge_loop(&y, &p, p.guaranteed, 1, "standard");
    for (double share = 0.9; share > 1e-3 && highest == 0.0; share *= 0.9)
        for (unsigned frame = 0; frame < DRAW_PICTURE_FRAMES && highest == 0.0; frame += 20)
            if (draw_picture_frame(&p, share * p.guaranteed, frame, false, NULL).wrong > 0)
                highest = share;
    print_message("# guaranteed %g at depth %g; wrong up to %g of it\n", p.guaranteed, p.z, highest);
    assert_true(highest > 0.05); /* triangles of the class are slimmer */
    for (unsigned frame = 0; frame < DRAW_PICTURE_FRAMES; frame += 50) {
        const draw_picture_count none = draw_picture_frame(&p, 0.0, frame, false, NULL);
        const draw_picture_count little = draw_picture_frame(&p, 0.005 * p.guaranteed, frame, false, NULL);
        TALLY(&y, none.wrong > none.covered / 10, "gap 0: %zu of %zu wrong", none.wrong, none.covered);
        TALLY(&y, little.wrong > little.covered / 100, "%zu of %zu wrong", little.wrong, little.covered);
    }
    draw_picture_close(&p);
    tally_end(&y);
}

TEST(flickers) {
    static uint32_t one[W * H], next[W * H];
    draw_picture p;
    open_standard(&p);
    const double gap = 0.02 * p.guaranteed;
    draw_picture_frame(&p, gap, 100, false, one);
    const draw_picture_count count = draw_picture_frame(&p, gap, 101, false, next);
    size_t changed = 0;
    for (int i = 0; i < W * H; i++)
        changed += one[i] != next[i];
    print_message("# from a frame to the next %zu pixels change, %zu are wrong\n", changed, count.wrong);
    assert_true(changed > count.wrong / 10);
    draw_picture_close(&p);
}

TEST(the_same_again) {
    static uint32_t one[W * H], again[W * H];
    draw_picture p, q;
    open_standard(&p);
    open_standard(&q);
    for (unsigned frame = 0; frame < DRAW_PICTURE_FRAMES; frame += 97) {
        const draw_picture_count a = draw_picture_frame(&p, 1e-4, frame, frame % 2 != 0, one);
        draw_picture_frame(&q, 1e-3, frame + 5, false, again);
        const draw_picture_count b = draw_picture_frame(&q, 1e-4, frame + DRAW_PICTURE_FRAMES, frame % 2 != 0, again);
        assert_true(a.wrong == b.wrong && a.covered == b.covered);
        assert_memory_equal(one, again, sizeof one);
    }
    draw_picture_close(&p);
    draw_picture_close(&q);
}

/* ---- What is refused --------------------------------------------------------------------------------------------- */

TEST(refused) {
    static const struct {
        const char *raster, *format;
        dp_mapping mapping;
        camera view;
        int ortho;
        const char *says;
    } cases[] = {
        {"llvmpipe", "fp16", DP_MAPPING_D3D, {0.1, 1000, 100}, 0, "format"},
        {"swiftshader", "unorm24", DP_MAPPING_D3D, {0.1, 1000, 100}, 0, "format"},
        {"softpipe", "unorm16", DP_MAPPING_D3D, {0.1, 1000, 100}, 0, "format"},
        {"softpipe", "fp32", DP_MAPPING_GL, {0.1, 1000, 100}, 0, "d3d"},
        {"none", "fp32", DP_MAPPING_LOG, {0.1, 1000, 100}, 1, "orthographic"},
        {"none", "fp32", DP_MAPPING_D3D, {1, 2.5, 2.4}, 0, "near plane"},
        {"none", "fp32", DP_MAPPING_D3D, {0.1, 1000, 0.29}, 0, "near plane"},
        {"none", "fp32", DP_MAPPING_D3D, {0.1, 1000, 1002}, 0, "far plane"},
        {"none", "fp32", DP_MAPPING_D3D, {0.1, 1000, -5}, 0, "near plane"},
        {"none", "fp32", DP_MAPPING_D3D, {0.1, 1000, INFINITY}, 0, "far plane"},
        {"none", "fp32", DP_MAPPING_D3D, {0.1, 1000, NAN}, 0, "near plane"},
        {"none", "fp32", DP_MAPPING_D3D, {NAN, 1000, 100}, 0, ""},
        {"none", "fp32", DP_MAPPING_D3D, {1000, 0.1, 100}, 0, ""},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        dp_spec spec = spec_of(cases[i].format, cases[i].mapping, cases[i].view.znear, cases[i].view.zfar);
        draw_picture p;
        spec.ortho = cases[i].ortho;
        const char *wrong = draw_picture_open(&p, &spec, raster_find(cases[i].raster), cases[i].view.z);
        assert_non_null(wrong);
        print_message("# %s\n", wrong);
        assert_non_null(strstr(wrong, cases[i].says));
        draw_picture_close(&p);
    }
}

/* The farthest thing may lie on the far plane. */
TEST(up_to_far) {
    for (dp_mapping m = DP_MAPPING_D3D; m <= DP_MAPPING_GL_REVERSED; m++) {
        const dp_spec spec = spec_of("fp32", m, 0.1, 1000.0);
        draw_picture p;
        assert_null(draw_picture_open(&p, &spec, NULL, 1000.0));
        assert_true(draw_picture_frame(&p, 0.0, 0, false, NULL).covered > 20000);
        draw_picture_close(&p);
    }
}

/* ---- Every mapping and format -------------------------------------------------------------------------------------
 */

/* The depth that a pixel stores, by the library alone: near/z between vertices is off by a few units in the last place,
 * so that of an ideal depth the code is one of its neighbours at most, as far as binary32 tells depths apart. */
typedef struct stored {
    const draw_picture *p;
    const triangles *t;
    int at;
    tally *y;
    const char *name;
} stored;

/* The depth that the vertices' depths make of a place, by the plane through them on the screen: d and how much it
 * changes over a pixel. */
static double interpolated(const stored *s, const dp_setup *exact, const double window[2], double side, double *slope) {
    double v[3][3];
    for (int i = 0; i < 3; i++) {
        const double *place = s->t->place[s->at][i];
        v[i][0] = s->p->camera.target.width / 2.0 + place[0] / place[2] / side;
        v[i][1] = s->p->camera.target.height / 2.0 + place[1] / place[2] / side;
        v[i][2] = dp_window(exact, place[2]);
    }
    const double x1 = v[1][0] - v[0][0], y1 = v[1][1] - v[0][1], z1 = v[1][2] - v[0][2];
    const double x2 = v[2][0] - v[0][0], y2 = v[2][1] - v[0][1], z2 = v[2][2] - v[0][2], area = x1 * y2 - x2 * y1;
    const double a = (z1 * y2 - z2 * y1) / area, b = (x1 * z2 - x2 * z1) / area;
    *slope = fabs(a) + fabs(b);
    return v[0][2] + a * (window[0] - v[0][0]) + b * (window[1] - v[0][1]);
}

static void judge_codes(void *context, int x, int y, int count, const uint32_t *key) {
    stored *s = context;
    const double *n = s->t->normal[s->at], off = 16.0 * 0x1p-24;
    const dp_setup *setup = &s->p->setup;
    for (int i = 0; i < count; i += 7) {
        const double window[2] = {x + i + 0.5, y + 0.5}, half = half_of(s->p),
                     side = 2.0 * half / s->p->camera.target.height;
        const double ray[2] = {(window[0] - s->p->camera.target.width / 2.0) * side,
                               (window[1] - s->p->camera.target.height / 2.0) * side};
        const double z = setup->spec.ortho ? (s->t->distance[s->at] - s->p->z * (n[0] * ray[0] + n[1] * ray[1])) / n[2]
                                           : s->t->distance[s->at] / (n[0] * ray[0] + n[1] * ray[1] + n[2]);
        const double slope = fabs(n[2]) > 0.1 ? 4.0 : 40.0, grid = slope * side * z / 256.0;
        if (fabs(n[2]) < 1e-9 && setup->spec.ortho) /* edge-on */
            continue;
        dp_setup exact = *setup;
        dp_spec spec = setup->spec;
        spec.model = DP_MODEL_EXACT;
        spec.triangles.width = 0;
        assert_int_equal(dp_setup_init(&exact, &spec), DP_OK);
        const uint32_t top = setup->spec.format.code_max;
        const double lo = z * (1.0 - off) - grid, hi = z * (1.0 + off) + grid;
        const bool turned = dp_mapping_get(spec.mapping)->reversed != 0;
        uint32_t a = dp_code(&exact, lo), b = dp_code(&exact, hi);
        a = turned ? top - a : a;
        b = turned ? top - b : b;
        if (spec.mapping == DP_MAPPING_OSGEARTH) { /* which its vertices have */
            double change;
            const double d = interpolated(s, &exact, window, side, &change), reach = change / 16.0;
            a = dp_format_encode(&spec.format, spec.rounding, fmin(fmax(d - reach, 0.0), 1.0));
            b = dp_format_encode(&spec.format, spec.rounding, fmin(fmax(d + reach, 0.0), 1.0));
        }
        const double spare = 4.0 + 0x1p-20 * (spec.format.kind == DP_FORMAT_FLOAT ? 0.0 : (double)top);
        TALLY(s->y,
              spec.format.bits > 24 || ((double)key[i] >= (double)a - spare && (double)key[i] <= (double)b + spare),
              "%s: at %d, %d, z %.9g: key %u, not from %u to %u", s->name, x + i, y, z, key[i], a, b);
    }
}

TEST(every_mapping) {
    static const char *const formats[] = {"unorm16", "fp16", "unorm24", "rg", "float3.4", "unorm8"};
    tally y = {.name = "every mapping"};
    int drawn = 0;
    for (size_t f = 0; f < sizeof formats / sizeof formats[0]; f++)
        for (dp_mapping m = 0; m < DP_MAPPING_COUNT; m++)
            for (int ortho = 0; ortho < 2; ortho++) {
                dp_spec spec = spec_of(formats[f], m, 0.1, 1000.0);
                draw_picture p;
                dp_setup setup;
                char name[80];
                spec.ortho = ortho;
                snprintf(name, sizeof name, "%s %s %d", formats[f], dp_mapping_get(m)->name, ortho);
                const bool is = dp_setup_init(&setup, &spec) == DP_OK;
                TALLY(&y, (draw_picture_open(&p, &spec, NULL, 100.0) == NULL) == is, "%s: is it drawn?", name);
                if (!is)
                    continue;
                const triangles t = triangles_of(&p, 0.01, 100);
                stored s = {&p, &t, 0, &y, name};
                const draw_picture_count count = draw_picture_frame(&p, 0.01, 100, false, NULL);
                TALLY(&y, count.covered > 20000, "%s: %zu pixels", name, count.covered);
                for (; s.at < t.count; s.at++)
                    draw_keys(&p.camera, &p.buffer.area, (const double(*)[3])t.place[s.at], judge_codes, &s);
                TALLY(&y, isfinite(p.guaranteed) == (!ortho && m <= DP_MAPPING_GL_REVERSED && f < 3),
                      "%s: guaranteed %g", name, p.guaranteed);
                drawn++;
                draw_picture_close(&p);
            }
    assert_true(drawn > 50);
    tally_end(&y);
}

/* Any planes at all: refused or drawn, the scene between them. */
TEST(any_planes) {
    rng r = rng_make("any planes");
    tally y = {.name = "planes"};
    for (uint64_t i = 0; i < test_cases(50, 400, 4000); i++) {
        const double znear = rng_log(&r, 1e-12, 1e12), zfar = znear * rng_log(&r, 1.00001, 1e20);
        dp_spec spec = spec_of("fp32", (dp_mapping)(DP_MAPPING_D3D + rng_below(&r, 4)), znear, zfar);
        draw_picture p;
        if (draw_picture_open(&p, &spec, raster_find("llvmpipe"), fmin(sqrt(znear * zfar), 1e3 * znear)) != NULL)
            continue;
        const bool promised = p.guaranteed <= draw_picture_widest(&p);
        const double gap = promised ? p.guaranteed : draw_picture_widest(&p);
        TALLY(&y, fabs(draw_picture_widest(&p) / (p.z * p.scale) - 0.1) < 1e-12, "near %g, far %g: widest gap %g",
              znear, zfar, draw_picture_widest(&p));
        const draw_picture_count count = draw_picture_frame(&p, gap, (unsigned)i, false, NULL);
        TALLY(&y, 0.54 * p.z >= znear && 1.6 * p.z <= zfar && count.covered > 20000,
              "near %g, far %g: at %g, %zu pixels", znear, zfar, p.z, count.covered);
        TALLY(&y, !promised || count.wrong == 0, "near %g, far %g: %zu wrong", znear, zfar, count.wrong);
        draw_picture_close(&p);
    }
    tally_end(&y);
}

TEST(fast) {
    static uint32_t pixel[W * H];
    struct timespec from, to;
    draw_picture p;
    open_standard(&p);
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &from);
    for (unsigned frame = 0; frame < DRAW_PICTURE_FRAMES; frame++)
        draw_picture_frame(&p, 0.02 * p.guaranteed, frame, false, pixel);
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &to);
    const double ms = 1e3 * (double)(to.tv_sec - from.tv_sec) + 1e-6 * (double)(to.tv_nsec - from.tv_nsec);
    print_message("# %.3f ms a frame, %.2f ns a pixel\n", ms / DRAW_PICTURE_FRAMES,
                  1e6 * ms / DRAW_PICTURE_FRAMES / (W * H));
    draw_picture_close(&p);
}
