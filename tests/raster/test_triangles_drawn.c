/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The guaranteed separation of slanted triangles at length: random cameras, formats and parallel planes, a triangle of
 * each, drawn by the models of src/raster, which recorded codes guard. At the guarantee and beyond every pixel that
 * both cover has to be in order.
 *
 * The guarantee is that at the farthest depth that the overlap may have: what vertices and set-up are off by holds for
 * whole triangles, and what that costs rises with depth.
 */
#include "raster_named.h"
#include "slanted.h"

enum { ROWS = 4096, PARTS = 32 };

/* Whole triangles; those that sides of the screen cut; both, each pair in a depth range of its own. */
typedef enum kind { DRAWN, CUT, RANGED } kind;
static const char *const words[] = {[DRAWN] = "drawn", [CUT] = "cut", [RANGED] = "ranged"};

static const char *const stored_as[] = {"fp32", "unorm24", "unorm16"};

/* Their arithmetic: what becomes of a vertex, and of a depth that is stored. */
static const struct {
    const char *name, *arith;
} drawn_by[] = {{"llvmpipe", "mesa"}, {"lavapipe", "mesa"}, {"softpipe", "softpipe"}, {"swiftshader", "mesa"}};

/* Tallies of the pixels of one rasterizer and format. */
typedef struct outcome {
    tally pixels;
    uint64_t pairs, cut;
    double wrong; /* the largest share of the guarantee at which a pixel was out of order */
} outcome;

/* One triangle on the screen: the pixels of each row, of each piece. */
typedef struct spans {
    raster_triangle drawn;
    bool cut; /* by a side of the screen */
    int from[RASTER_PIECES][ROWS], to[RASTER_PIECES][ROWS];
} spans;

static bool rasterized(const slanted *s, const raster_target *target, const raster_vertex v[3], spans *out) {
    const bool seen = s->cut == RASTER_CLIP_ANY ? slanted_inside(v) : slanted_in_depth(v);
    out->cut = !slanted_inside(v);
    if (!seen || raster_set_up(target, v, &out->drawn) != RASTER_OK)
        return false;
    for (int i = 0; i < out->drawn.count; i++) {
        const raster_piece *piece = &out->drawn.piece[i];
        for (int y = piece->y0; y < piece->y1; y++)
            if (!raster_span(target, piece, y, &out->from[i][y], &out->to[i][y]))
                out->from[i][y] = out->to[i][y] = 0;
    }
    return true;
}

/* The farthest depth of the farther plane in pixels that the nearer triangle may cover too; 0 where there is none. */
static double farthest(const slanted *s, const spans *of) {
    double lo[2] = {INFINITY, INFINITY}, hi[2] = {-INFINITY, -INFINITY}, least = INFINITY;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 2; k++) {
            lo[k] = fmin(lo[k], s->at[0][i][k] - 1.0);
            hi[k] = fmax(hi[k], s->at[0][i][k] + 1.0);
        }
    for (int i = 0; i < of->drawn.count; i++)
        for (int y = of->drawn.piece[i].y0; y < of->drawn.piece[i].y1; y++) {
            const double left = fmax(of->from[i][y] + 0.5, lo[0]), right = fmin(of->to[i][y] - 0.5, hi[0]);
            if (left <= right && y + 0.5 >= lo[1] && y + 0.5 <= hi[1])
                least = fmin(least, fmin(slanted_along(s, left, y + 0.5), slanted_along(s, right, y + 0.5)));
        }
    return least > 0.0 && isfinite(least) ? s->c / least : 0.0;
}

/* How many pixels are not in order. Codes of fp32 are bits of depths that are hardly below 0: as integers in order. */
static int disordered(const uint32_t *less, const uint32_t *more, int count) {
    int wrong = 0;
    for (int i = 0; i < count; i++)
        wrong += (int32_t)less[i] >= (int32_t)more[i];
    return wrong;
}

static void judge_row(const slanted *s, const raster_target *target, const raster_piece *piece[2], int y, int from,
                      int to, double share, outcome *out) {
    static _Thread_local uint32_t code[2][ROWS];
    for (int k = 0; k < 2; k++)
        raster_codes(target, piece[k], y, from, to, code[k]);
    const int far_is_more = !s->setup.reversed;
    const int wrong = disordered(code[1 - far_is_more], code[far_is_more], to - from);
    if (share < 1.0) {
        out->wrong = wrong > 0 ? fmax(out->wrong, share) : out->wrong;
        return;
    }
    out->pixels.cases += (uint64_t)(to - from);
    if (wrong > 0)
        tally_fail(&out->pixels, "%s %s: %d of row %d, %d to %d, share %.17g, z %.17g, slant %g, %d x %d, fov %g",
                   s->kind->name, s->setup.spec.format.name, wrong, y, from, to, share, s->z, s->class.slant_hi,
                   target->width, target->height, s->class.fov_y);
}

static int most(int a, int b) {
    return a > b ? a : b;
}

/* All pixels that piece i of the nearer triangle and piece j of the farther one cover. */
static void judge_pieces(const slanted *s, const raster_target *target, const spans of[2], int i, int j, double share,
                         outcome *out) {
    const raster_piece *piece[2] = {&of[0].drawn.piece[i], &of[1].drawn.piece[j]};
    const int y1 = -most(-piece[0]->y1, -piece[1]->y1);
    for (int y = most(piece[0]->y0, piece[1]->y0); y < y1; y++) {
        const int from = most(of[0].from[i][y], of[1].from[j][y]), to = -most(-of[0].to[i][y], -of[1].to[j][y]);
        if (from < to)
            judge_row(s, target, piece, y, from, to, share, out);
    }
}

static void judge(slanted *s, size_t row, double share, outcome *out) {
    static _Thread_local spans of[2];
    raster_target target;
    raster_vertex clip[3];
    dp_budget b;
    double nearer;
    if (raster_target_init(&target, row, s->camera.width, s->camera.height, &s->setup.spec.format, dp_path_best()) !=
            RASTER_OK ||
        !slanted_clip(s, 1, s->c, clip))
        return;
    raster_target_range(&target, (float)s->setup.spec.depth_range[0], (float)s->setup.spec.depth_range[1]);
    if (!rasterized(s, &target, clip, &of[1]))
        return;
    s->z = farthest(s, &of[1]);
    if (s->z == 0.0 || !slanted_apart(s, share, &b, &nearer) || !slanted_clip(s, 0, nearer, clip) ||
        !rasterized(s, &target, clip, &of[0]))
        return;
    for (int i = 0; i < of[0].drawn.count; i++)
        for (int j = 0; j < of[1].drawn.count; j++)
            judge_pieces(s, &target, of, i, j, share, out);
    out->pairs++;
    out->cut += of[0].cut || of[1].cut;
}

/* Until so many pixels have been judged at the guarantee or beyond. */
static void judge_part(size_t row, const char *format, kind drawn, int part, uint64_t pixels, outcome *out) {
    const raster_row *of = raster_get(row);
    const int bits = of->plane_bits > 0 ? of->plane_bits : -1;
    const slanted_kind by = {of->name, of->anchor, {bits, bits}, drawn_by[row].arith};
    char name[64];
    snprintf(name, sizeof name, "%s %s %s %d", words[drawn], of->name, format, part);
    rng r = rng_make(name);
    slanted s;
    while (out->pixels.cases < pixels && slanted_draw_camera(&r, &s, &by, format)) {
        const double share = rng_below(&r, 8) == 0   ? rng_log(&r, 0.02, 1.0)
                             : rng_below(&r, 2) == 0 ? 1.0
                                                     : rng_log(&r, 1.0, 10.0);
        s.cut = drawn == CUT || (drawn == RANGED && rng_below(&r, 4) == 0) ? of->clipping : RASTER_CLIP_ANY;
        if (drawn == RANGED)
            slanted_draw_range(&r, &s);
        if (slanted_draw_planes(&r, &s))
            judge(&s, row, share, out);
    }
}

/* SwiftShader has no D24; the 16-bit codes of softpipe are stepped, and promise nothing. */
static bool has_format(const char *name, const char *format) {
    return !(strcmp(name, "swiftshader") == 0 && strcmp(format, "unorm24") == 0) &&
           !(strcmp(name, "softpipe") == 0 && strcmp(format, "unorm16") == 0);
}

/* One rasterizer and format, in parts that may run at once. */
static outcome judge_all(size_t row, const char *format, kind drawn, uint64_t pixels) {
    outcome part[PARTS], all = {.pixels = {.name = drawn_by[row].name}};
    assert_string_equal(raster_get(row)->name, drawn_by[row].name);
#pragma omp parallel for schedule(dynamic)
    for (int i = 0; i < PARTS; i++) {
        part[i] = (outcome){.pixels = {.name = drawn_by[row].name}};
        judge_part(row, format, drawn, i, pixels / PARTS, &part[i]);
    }
    for (int i = 0; i < PARTS; i++) {
        all.pixels.cases += part[i].pixels.cases;
        if (part[i].pixels.failures > 0 && all.pixels.failures == 0)
            memcpy(all.pixels.first, part[i].pixels.first, sizeof all.pixels.first);
        all.pixels.failures += part[i].pixels.failures;
        all.pairs += part[i].pairs;
        all.cut += part[i].cut;
        all.wrong = fmax(all.wrong, part[i].wrong);
    }
    print_message("# %s %s: %llu pixels of %llu pairs, %llu of them cut; wrong ones up to %.2f of the guarantee\n",
                  drawn_by[row].name, format, (unsigned long long)all.pixels.cases, (unsigned long long)all.pairs,
                  (unsigned long long)all.cut, all.wrong);
    tally_end(&all.pixels);
    assert_true(all.wrong > 0.02);
    return all;
}

TEST(test_drawn) {
    const uint64_t wanted = test_cases(100000, 10000000, 100000000);
    uint64_t pixels = 0;
    for (size_t row = 0; row < sizeof drawn_by / sizeof drawn_by[0]; row++)
        for (size_t f = 0; f < sizeof stored_as / sizeof stored_as[0]; f++)
            if (has_format(drawn_by[row].name, stored_as[f]))
                pixels += judge_all(row, stored_as[f], DRAWN, wanted).pixels.cases;
    print_message("# %llu pixels\n", (unsigned long long)pixels);
    if (test_effort() != EFFORT_QUICK)
        assert_true(pixels >= 100000000);
}

/* Clipped triangles: the sides of the screen cut most of them, and where that makes vertices it adds to their errors.
 */
TEST(test_cut) {
    for (size_t row = 0; row < sizeof drawn_by / sizeof drawn_by[0]; row++)
        for (size_t f = 0; f < sizeof stored_as / sizeof stored_as[0]; f++)
            if (has_format(drawn_by[row].name, stored_as[f])) {
                const outcome o = judge_all(row, stored_as[f], CUT, test_cases(100000, 2000000, 50000000));
                assert_true(o.cut > o.pairs / 4);
            }
}

/* Thousands of depth ranges, also narrow ones and ones that fall. How much of the guarantee they need is climbed to in
 * test_triangles.c. */
TEST(test_ranged) {
    uint64_t pairs = 0;
    for (size_t row = 0; row < sizeof drawn_by / sizeof drawn_by[0]; row++)
        for (size_t f = 0; f < sizeof stored_as / sizeof stored_as[0]; f++)
            if (has_format(drawn_by[row].name, stored_as[f])) {
                const outcome o = judge_all(row, stored_as[f], RANGED, test_cases(100000, 2000000, 50000000));
                assert_true(o.cut > o.pairs / 16);
                pairs += o.pairs;
            }
    print_message("# %llu depth ranges\n", (unsigned long long)pairs);
    assert_true(pairs >= 1000);
}
