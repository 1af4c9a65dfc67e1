/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * --matrix: depth images whose projection is any matrix. Matrices are put together here, oblique near planes by the
 * formula for clip planes, written to files, and every pixel is judged in rationals by what the file says: eye depth,
 * range, place, and the map of errors.
 */
#include "image/image.h"
#include "oracle.h"
#include "printed.h"

enum { ACROSS = 7, DOWN = 5, ALL = ACROSS * DOWN };

typedef struct view_case {
    double m[16];
    bool is_signed, reversed, backwards, down, oblique; /* down: NDC has y down */
    double znear, zfar;                                 /* of the frustum before its near plane was moved */
    double half[2], centre[2];
    double range[2]; /* of the viewport */
    dp_format format;
    const char *mapping;
    uint32_t codes[ALL];
    char path[256], shot[256];
} view_case;

/* ---- Matrices ---------------------------------------------------------------------------------------------------- */

static bool is_ranged(const view_case *c) {
    return c->range[0] != 0 || c->range[1] != 1;
}

/* Whether what is farther has a smaller code. */
static bool falls(const view_case *c) {
    return c->reversed != (c->range[1] < c->range[0]);
}

/* In view space with z ahead; the columns of z change their sign for a camera that looks along -z. */
static void make_frustum(rng *r, view_case *c) {
    const bool infinite = rng_below(r, 4) == 0, centred = rng_below(r, 3) == 0;
    c->is_signed = rng_below(r, 2) == 0;
    c->reversed = rng_below(r, 2) == 0;
    c->backwards = rng_below(r, 2) == 0;
    c->down = rng_below(r, 3) == 0;
    c->znear = rng_log(r, 0.01, 2);
    c->zfar = infinite ? INFINITY : c->znear * rng_log(r, 3, 1e5);
    c->oblique = infinite && rng_below(r, 2) == 0;
    c->mapping = c->is_signed ? (c->reversed ? "gl-reversed" : "gl") : c->reversed ? "reversed" : "d3d";
    for (int k = 0; k < 2; k++) {
        c->half[k] = rng_log(r, 0.1, 3);
        c->centre[k] = centred ? 0 : rng_uniform(r, -1.5, 1.5);
    }
    const double n = c->znear, f = c->zfar, low = c->is_signed ? -1 : 0;
    const double at_near = c->reversed ? 1 : low, at_end = c->reversed ? low : 1;
    /* a share short of that, the far plane lies beyond infinity */
    const double at_far = c->oblique ? at_end + 1e-3 * (at_near - at_end) : at_end;
    /* NDC depth s + t/z from its ends */
    const double s = infinite ? at_far : (f * at_far - n * at_near) / (f - n), t = (at_near - s) * n;
    const double m[16] = {
        1 / c->half[0], 0, c->centre[0], 0, 0, 1 / c->half[1], c->centre[1], 0, 0, 0, s, t, 0, 0, 1, 0};
    memcpy(c->m, m, sizeof m);
}

/* The row of z that puts the near plane at p . (x, y, z, 1) = 0 and the far plane through the farthest corner. */
static void make_oblique(rng *r, view_case *c) {
    const double lean[2] = {rng_uniform(r, -0.6, 0.6), rng_uniform(r, -0.6, 0.6)};
    const double at = c->znear * rng_log(r, 1, 20), far = fmin(c->zfar, 1e4 * c->znear);
    const double plane[4] = {lean[0] / c->half[0], lean[1] / c->half[1], 1, -at};
    double corner[4] = {0, 0, far, 1}, on_plane = 0;
    for (int k = 0; k < 2; k++)
        corner[k] = ((plane[k] > 0 ? 1 : -1) - c->centre[k]) * c->half[k] * far;
    for (int k = 0; k < 4; k++)
        on_plane += plane[k] * corner[k];
    /* near: NDC `low`, or 1 where reversed; far: the other; NDC w = from w + scale plane */
    if (!(on_plane > 0.01 * far)) /* the frustum's far corner lies before the plane */
        return;
    const double low = c->is_signed ? -1 : 0, from = c->reversed ? 1 : low, to = c->reversed ? low : 1;
    const double scale = (to - from) * far / on_plane;
    for (int k = 0; k < 4; k++)
        c->m[8 + k] = scale * plane[k] + (k == 2 ? from : 0);
    c->oblique = true;
}

static void write_matrix(rng *r, view_case *c) {
    static const char *const between[] = {" ", ", ", "\t", " ,\n", "\n# said of it: 1 2 3\n"};
    for (int i = 0; i < 4 && c->backwards; i++)
        c->m[4 * i + 2] = -c->m[4 * i + 2];
    for (int i = 4; i < 8 && c->down; i++)
        c->m[i] = -c->m[i];
    snprintf(c->path, sizeof c->path, "%s", scratch_file("matrix.txt"));
    FILE *out = fopen(c->path, "w");
    assert_non_null(out);
    fprintf(out, "# a projection\r\n");
    const bool by_columns = rng_below(r, 2) == 0;
    for (int i = 0; i < 16; i++)
        fprintf(out, "%.17g%s", c->m[by_columns ? 4 * (i % 4) + i / 4 : i],
                between[rng_below(r, sizeof between / sizeof between[0])]);
    fclose(out);
}

/* ---- In rationals ------------------------------------------------------------------------------------------------ */

typedef struct ray {
    mpq_t slope[2], k, e; /* window depth is k + e/z */
    double most;          /* the largest term of k */
} ray;

static void ray_init(ray *out, const view_case *c, int column, int row) {
    mpq_t x, y;
    mpq_inits(out->slope[0], out->slope[1], out->k, out->e, x, y, NULL);
    mpq_set_d(out->k, c->backwards ? -c->m[10] : c->m[10]);
    out->most = fabs(c->m[10]) + c->is_signed;
    for (int k = 0; k < 2; k++) { /* the slope that becomes the NDC of the pixel's middle */
        mpq_set_si(out->slope[k], k == 0 ? 2 * column + 1 - ACROSS : DOWN - 1 - 2 * row, k == 0 ? ACROSS : DOWN);
        mpq_canonicalize(out->slope[k]);
        if (k == 1 && c->down)
            mpq_neg(out->slope[k], out->slope[k]);
        mpq_set_d(x, c->backwards ? -c->m[4 * k + 2] : c->m[4 * k + 2]);
        mpq_sub(out->slope[k], out->slope[k], x);
        mpq_set_d(x, c->m[4 * k + k]);
        mpq_div(out->slope[k], out->slope[k], x);
        mpq_set_d(y, c->m[8 + k]);
        mpq_mul(y, y, out->slope[k]);
        mpq_add(out->k, out->k, y);
        out->most = fmax(out->most, fabs(c->m[8 + k] / c->m[4 * k + k]) * (1 + fabs(c->m[4 * k + 2])));
    }
    mpq_set_d(out->e, c->m[11]);
    if (c->is_signed) {
        mpq_set_si(x, 1, 1);
        mpq_add(out->k, out->k, x);
        mpq_div_2exp(out->k, out->k, 1);
        mpq_div_2exp(out->e, out->e, 1);
    }
    mpq_set_d(x, c->range[0]);
    mpq_set_d(y, c->range[1] - c->range[0]); /* of binary32 numbers, so that nothing is lost */
    mpq_mul(out->e, out->e, y);
    mpq_mul(out->k, out->k, y);
    mpq_add(out->k, out->k, x);
    mpq_clears(x, y, NULL);
}

static void ray_clear(ray *r) {
    mpq_clears(r->slope[0], r->slope[1], r->k, r->e, NULL);
}

/* @return false where nothing lies at that window depth */
static bool ray_eye(const ray *r, mpq_t z, const mpq_t d) {
    mpq_sub(z, d, r->k);
    if (mpq_sgn(z) == 0 || mpq_sgn(z) != mpq_sgn(r->e))
        return false;
    mpq_div(z, r->e, z);
    return true;
}

/* ---- Images ------------------------------------------------------------------------------------------------------ */

/* A code that somebody sees, mostly, or any in the range whose cell lies in it, too. */
static uint32_t code_for(rng *r, const view_case *c, const ray *at) {
    const double z = c->znear * rng_log(r, 1, 1e4), d = mpq_get_d(at->k) + mpq_get_d(at->e) / z;
    const double least = fmin(c->range[0], c->range[1]), most = fmax(c->range[0], c->range[1]);
    const uint32_t edge = is_ranged(c) ? 2 : 0, first = oracle_encode(&c->format, DP_ROUND_NEAREST, least) + edge,
                   last = oracle_encode(&c->format, DP_ROUND_NEAREST, most) - edge;
    const bool seen = d > least && d < most && rng_below(r, 8) != 0;
    const uint32_t code = seen ? oracle_encode(&c->format, DP_ROUND_NEAREST, d) : 0;
    return seen && code >= first && code <= last ? code : first + 1 + (uint32_t)rng_below(r, last - first - 1);
}

static void save_shot(view_case *c) {
    char header[128];
    const bool single = c->format.kind == DP_FORMAT_FLOAT;
    snprintf(c->shot, sizeof c->shot, "%s", scratch_file("shot.npy"));
    FILE *out = fopen(c->shot, "wb");
    assert_non_null(out);
    snprintf(header, sizeof header, "{'descr': '%s', 'fortran_order': False, 'shape': (%d, %d), }",
             single ? "<f4" : "<u4", DOWN, ACROSS);
    fwrite("\x93NUMPY\x01\x00\x76\x00", 1, 10, out);
    fprintf(out, "%-117s\n", header);
    for (int i = 0; i < 4 * ALL; i++) /* bits of binary32 are its codes */
        fputc((int)(c->codes[i / 4] >> (8 * (i % 4)) & 255), out);
    fclose(out);
}

static void write_shot(rng *r, view_case *c) {
    for (int i = 0; i < ALL; i++) {
        ray one;
        ray_init(&one, c, i % ACROSS, i / ACROSS);
        c->codes[i] = code_for(r, c, &one);
        ray_clear(&one);
    }
    save_shot(c);
}

static void make_case(rng *r, view_case *c) {
    *c = (view_case){.range = {0, 1}};
    make_frustum(r, c);
    if (rng_below(r, 4) != 0)
        make_oblique(r, c);
    write_matrix(r, c);
    c->format = rng_below(r, 2) == 0 ? oracle_unorm(24) : oracle_float(8, 23, 127);
    c->format.name[0] = '\0';
    strcpy(c->format.name, c->format.kind == DP_FORMAT_UNORM ? "unorm24" : "fp32");
    write_shot(r, c);
}

/* Half of them in a depth range of enough codes. */
static void make_ranged(rng *r, view_case *c) {
    double range[2];
    make_case(r, c);
    rng_range(r, range);
    if (rng_below(r, 2) == 0 || !(fabs(range[1] - range[0]) > 1e-5))
        return;
    for (int i = 0; i < 2; i++)
        c->range[i] = (double)(float)range[i];
    write_shot(r, c);
}

/* ---- What is printed --------------------------------------------------------------------------------------------- */

/* No end is null. */
static double endless_at(const json_t *object, const char *field) {
    const double number = number_at(object, "%s", field);
    return isnan(number) ? INFINITY : number;
}

/* Where no range is said, the plane itself is both ends. */
static double plane_end(const json_t *root, const char *plane, const char *end) {
    const json_t *planes = json_object_get(root, "planes");
    return planes != NULL ? endless_at(planes, end) : endless_at(root, plane);
}

typedef struct eyes {
    mpq_t own, lo, hi;
    bool has_own, has_lo, has_hi;
} eyes;

static void eyes_of(const view_case *c, const ray *r, uint32_t code, eyes *e) {
    mpq_t d;
    mpq_inits(d, e->own, e->lo, e->hi, NULL);
    oracle_value(d, &c->format, code);
    e->has_own = ray_eye(r, e->own, d);
    oracle_boundary(d, &c->format, DP_ROUND_NEAREST, falls(c) ? code + 1 : code);
    e->has_lo = ray_eye(r, e->lo, d);
    oracle_boundary(d, &c->format, DP_ROUND_NEAREST, falls(c) ? code : code + 1);
    e->has_hi = ray_eye(r, e->hi, d);
    mpq_clear(d);
}

static void eyes_clear(eyes *e) {
    mpq_clears(e->own, e->lo, e->hi, NULL);
}

/* The bound is promised where k leaves digits. */
static bool is_clear(const ray *r, const mpq_t z) {
    return fabs(mpq_get_d(r->e) / mpq_get_d(z)) > 0x1p-44 * r->most;
}

static void judge(tally *t, const view_case *c, const ray *r, const mpq_t z, bool is, double got, double bound,
                  const char *what) {
    if (is && !is_clear(r, z))
        t->skipped++;
    else
        TALLY(t, is ? oracle_relative(got, z) <= bound : isinf(got), "%s by %s: %.17g, not %.17g", what, c->mapping,
              got, is ? mpq_get_d(z) : INFINITY);
}

static void judge_place(tally *t, const ray *r, json_t *pixel, const mpq_t z) {
    static const char *const names[] = {"x", "y"};
    json_t *place = json_object_get(pixel, "position");
    const double far = mpq_get_d(z) * hypot(hypot(mpq_get_d(r->slope[0]), mpq_get_d(r->slope[1])), 1);
    mpq_t x;
    mpq_init(x);
    for (int k = 0; k < 2; k++) {
        mpq_mul(x, r->slope[k], z);
        const double got = endless_at(place, names[k]);
        TALLY(t, oracle_distance(got, x) <= 1e-14 * far, "%s: %.17g, not %.17g", names[k], got, mpq_get_d(x));
    }
    mpq_clear(x);
}

static void judge_pixels(tally *t, const view_case *c, json_t *root) {
    json_t *pixels = json_object_get(root, "pixels");
    assert_int_equal(json_array_size(pixels), ALL);
    for (int i = 0; i < ALL; i++) {
        json_t *pixel = json_array_get(pixels, (size_t)i);
        ray r;
        eyes e;
        ray_init(&r, c, i % ACROSS, i / ACROSS);
        eyes_of(c, &r, c->codes[i], &e);
        judge(t, c, &r, e.own, e.has_own, endless_at(pixel, "z"), 0x1p-50, "z");
        judge(t, c, &r, e.lo, e.has_lo, endless_at(pixel, "lo"), 0x1p-44, "lo");
        judge(t, c, &r, e.hi, e.has_hi, endless_at(pixel, "hi"), 0x1p-44, "hi");
        if (e.has_own)
            judge_place(t, &r, pixel, e.own);
        eyes_clear(&e);
        ray_clear(&r);
    }
}

TEST(pixels) {
    rng r = rng_make("matrix pixels");
    tally t = {.name = "pixels of matrices"};
    uint64_t ranged = 0;
    char list[ALL * 4 + 1] = "";
    for (int i = 0; i < ALL; i++)
        snprintf(list + strlen(list), sizeof list - strlen(list), "%s%d,%d", i > 0 ? ";" : "", i % ACROSS, i / ACROSS);
    for (uint64_t n = test_cases(10, 150, 2000); n > 0; n--) {
        view_case c;
        char arguments[4096];
        make_ranged(&r, &c);
        snprintf(arguments, sizeof arguments,
                 "texture '%s' -q --sky 0 --matrix '%s' -F %s -m %s --depth-range %.17g:%.17g --pixel '%s'", c.shot,
                 c.path, c.format.name, c.mapping, c.range[0], c.range[1], list);
        ranged += is_ranged(&c);
        char *out = output_of(0, arguments, "--json");
        json_t *root = json_of(out);
        judge_pixels(&t, &c, root);
        json_decref(root);
        free(out);
    }
    assert_true(t.skipped < t.cases / 10);
    assert_true(ranged > 0);
    tally_end(&t);
}

/* ---- Products ---------------------------------------------------------------------------------------------------- */

static image numbers_of(const view_case *c, const char *product) {
    image_error error;
    image out;
    const char *path = scratch_file("product.npy");
    printed p = print_of("texture '%s' -q --sky 0 --matrix '%s' -F %s -m %s --depth-range %.17g:%.17g %s -o '%s'",
                         c->shot, c->path, c->format.name, c->mapping, c->range[0], c->range[1], product, path);
    if (p.status != 0)
        fail_msg("%s: %s", product, p.errors);
    printed_free(&p);
    assert_true(image_read(path, &out, &error));
    return out;
}

/* The largest error that is possible, from the product: in eye depth. */
static double farthest(const eyes *e, double got) {
    return !e->has_hi ? INFINITY : fmax(oracle_distance(got, e->lo), oracle_distance(got, e->hi));
}

static void judge_products(tally *t, const view_case *c) {
    image eye = numbers_of(c, "--product eye"), eye_off = numbers_of(c, "--product eye --error-map");
    image place = numbers_of(c, "--product position:exact"),
          place_off = numbers_of(c, "--product position:exact --error-map");
    for (size_t i = 0; i < ALL; i++) {
        ray r;
        eyes e;
        ray_init(&r, c, (int)i % ACROSS, (int)i / ACROSS);
        eyes_of(c, &r, c->codes[i], &e);
        const double got = (double)((float *)eye.data)[i], off = (double)((float *)eye_off.data)[i];
        const double ahead = (double)((float *)place.data)[3 * i + 2], by = (double)((float *)place_off.data)[i];
        const double stretch = hypot(hypot(mpq_get_d(r.slope[0]), mpq_get_d(r.slope[1])), 1);
        if (!e.has_own) {
            TALLY(t, isnan(got) && isnan(off) && isnan(ahead) && isnan(by), "eye depth %g beyond infinity", got);
        } else if (!is_clear(&r, e.own) || (e.has_hi && !is_clear(&r, e.hi))) {
            t->skipped++;
        } else {
            const double z = mpq_get_d(e.own), most = farthest(&e, got);
            TALLY(t, oracle_distance(got, e.own) <= z * (c->oblique ? 0x1.0001p-24 : DP_BATCH_EYE_ERROR),
                  "eye depth %.9g, not %.17g", got, z);
            TALLY(t, oracle_distance(ahead, e.own) <= z * 0x1.0001p-24, "z %.9g, not %.17g", ahead, z);
            /* planes that were rounded to double, where cells are finer than that */
            const double lost = c->oblique ? 0 : z * 0x1p-50;
            TALLY(t, off >= most - lost && off <= (most + z * 0x1p-22) * (1 + 0x1p-18), "off by %.9g, not %.9g", off,
                  most);
            TALLY(t, by >= (most - z * 0x1p-22) * stretch && by <= (most + z * 0x1p-21) * stretch * (1 + 0x1p-18),
                  "place off by %.9g, not %.9g", by, most * stretch);
        }
        eyes_clear(&e);
        ray_clear(&r);
    }
    image_free(&eye);
    image_free(&eye_off);
    image_free(&place);
    image_free(&place_off);
}

TEST(products) {
    rng r = rng_make("matrix products");
    tally t = {.name = "products of matrices"};
    for (uint64_t n = test_cases(5, 60, 500); n > 0; n--) {
        view_case c;
        make_ranged(&r, &c);
        judge_products(&t, &c);
    }
    tally_end(&t);
}

/* ---- Statistics -------------------------------------------------------------------------------------------------- */

TEST(statistics) {
    rng r = rng_make("matrix statistics");
    tally t = {.name = "statistics of matrices"};
    for (uint64_t n = test_cases(5, 60, 500); n > 0; n--) {
        view_case c;
        char arguments[1024];
        double least = INFINITY, most = 0, count = 0;
        make_case(&r, &c);
        snprintf(arguments, sizeof arguments, "texture '%s' -q --sky 0 --matrix '%s' -F %s -m %s", c.shot, c.path,
                 c.format.name, c.mapping);
        for (int i = 0; i < ALL; i++) {
            ray one;
            eyes e;
            ray_init(&one, &c, i % ACROSS, i / ACROSS);
            eyes_of(&c, &one, c.codes[i], &e);
            least = e.has_own ? fmin(least, mpq_get_d(e.own)) : least;
            most = e.has_own ? fmax(most, mpq_get_d(e.own)) : most;
            count += !e.has_own;
            eyes_clear(&e);
            ray_clear(&one);
        }
        char *out = output_of(0, arguments, "--json");
        json_t *root = json_of(out), *matrix = json_object_get(root, "matrix");
        const double edges[4] = {(-1 - c.centre[0]) * c.half[0], (1 - c.centre[0]) * c.half[0],
                                 (-1 - c.centre[1]) * c.half[1], (1 - c.centre[1]) * c.half[1]};
        static const char *const names[] = {"left", "right", "bottom", "top"};
        for (int i = 0; i < 4; i++)
            TALLY(&t, fabs(endless_at(matrix, names[i]) - edges[i]) <= 1e-14 * (1 + fabs(edges[i])), "%s", names[i]);
        const double degree = 3.14159265358979323846 / 180;
        for (int k = 0; k < 2; k++)
            TALLY(&t,
                  fabs(endless_at(matrix, k == 0 ? "fov_x" : "fov_y") -
                       (atan(edges[2 * k + 1]) - atan(edges[2 * k])) / degree) <= 1e-11,
                  "field of view %d", k);
        TALLY(&t, fabs(endless_at(root, "fov") - endless_at(matrix, "fov_y")) == 0, "fov");
        TALLY(&t, strcmp(json_string_value(json_object_get(matrix, "looks_along")), c.backwards ? "-z" : "+z") == 0,
              "which way it looks");
        if (!c.oblique) {
            TALLY(&t, fabs(endless_at(root, "near") / c.znear - 1) < 1e-9, "near %.9g", c.znear);
            TALLY(&t, isinf(c.zfar) || fabs(endless_at(root, "far") / c.zfar - 1) < 1e-5, "far %.9g", c.zfar);
        } else {
            TALLY(&t, json_is_true(json_object_get(matrix, "oblique")), "oblique");
            TALLY(&t, endless_at(root, "near") <= least * (1 + 1e-6), "near %.9g", endless_at(root, "near"));
            TALLY(&t, endless_at(root, "invalid") == count, "%g beyond infinity, not %g", endless_at(root, "invalid"),
                  count);
        }
        TALLY(&t, fabs(endless_at(root, "lo") / least - 1) < 1e-9 && fabs(endless_at(root, "hi") / most - 1) < 1e-5,
              "from %.9g to %.9g, not %.9g to %.9g", endless_at(root, "lo"), endless_at(root, "hi"), least, most);
        json_decref(root);
        free(out);
    }
    tally_end(&t);
}

/* ---- Normals ----------------------------------------------------------------------------------------------------- */

/* A plane seen through frustums that are not centred, and oblique ones. */
TEST(normals) {
    rng r = rng_make("matrix normals");
    uint64_t known = 0;
    tally t = {.name = "normals of matrices"};
    for (uint64_t n = test_cases(5, 60, 500); n > 0; n--) {
        view_case c;
        bool whole = true;
        const double lean[3] = {rng_uniform(&r, -0.3, 0.3), rng_uniform(&r, -0.3, 0.3), 1};
        make_case(&r, &c);
        const double at = c.znear * rng_log(&r, 2, 20);
        for (int i = 0; i < ALL; i++) {
            ray one;
            ray_init(&one, &c, i % ACROSS, i / ACROSS);
            const double z = at / (lean[0] * mpq_get_d(one.slope[0]) + lean[1] * mpq_get_d(one.slope[1]) + 1);
            const double d = mpq_get_d(one.k) + mpq_get_d(one.e) / z;
            whole = whole && z > 0 && d > 0.001 && d < 0.999;
            c.codes[i] = oracle_encode(&c.format, DP_ROUND_NEAREST, d);
            ray_clear(&one);
        }
        if (!whole)
            continue;
        save_shot(&c);
        /* that of projective is for the plane that was found, which is nearly this one */
        static const char *const methods[] = {"low", "medium-1", "high-half", "projective"};
        const size_t method = rng_below(&r, c.oblique ? 3 : 4);
        char product[64], map[128];
        snprintf(product, sizeof product, "--product normal:%s", methods[method]);
        snprintf(map, sizeof map, "%s --error-map", product);
        image found = numbers_of(&c, product), off = numbers_of(&c, map);
        for (size_t i = 0; i < ALL; i++) {
            const float *v = (float *)found.data + 3 * i;
            const double size = hypot(hypot(lean[0], lean[1]), 1), most = (double)((float *)off.data)[i];
            const double along = -((double)v[0] * lean[0] + (double)v[1] * lean[1] + (double)v[2]) / size /
                                 hypot(hypot((double)v[0], (double)v[1]), (double)v[2]);
            const double angle = along < 1 ? acos(along) * 57.29577951308232 : 0;
            TALLY(&t, isnan(v[0]) ? isnan(most) || method == 3 : angle <= most + (method == 3 ? 0.06 : 1e-5),
                  "%s off by %.9g degrees, not %.9g", methods[method], angle, most);
            TALLY(&t, isnan(v[0]) || method == 3 || most < 100 * (angle + 1), "%s: %.9g for %.9g", methods[method],
                  most, angle);
            known += method < 3 && most < 2;
        }
        image_free(&found);
        image_free(&off);
    }
    assert_true(known * 10 > t.cases);
    tally_end(&t);
}

/* ---- Beside the options that say the same -------------------------------------------------------------------------
 */

/* Entries and planes are exact here, so the bytes are the same; also of a view that looks down -z, or has y down. */
TEST(same_camera) {
    static const struct {
        const char *entries, *options, *mapping;
    } same[] = {
        {"1 0 0 0  0 2 0 0  0 0 2 -2  0 0 1 0", "-n 1 -f 2 --fov 53.13010235415598", "d3d"},
        {"1 0 0 0  0 2 0 0  0 0 2 -2  0 0 1 0", "-n 1 -f 2 --hfov 90", "d3d"},
        {"1 0 0 0  0 2 0 0  0 0 -1 2  0 0 1 0", "-n 1 -f 2 --fov 53.13010235415598", "reversed"},
        {"1 0 0 0  0 -2 0 0  0 0 0 0.5  0 0 -1 0", "-n 0.5 -f inf --fov 53.13010235415598", "reversed"},
        {"1 0 0 0  0 2 0 0  0 0 -3 -4  0 0 -1 0", "-n 1 -f 2 --fov 53.13010235415598", "gl"},
        {"1 0 0 0  0 2 0 0  0 0 0.125 0.25  0 0 0 1", "--ortho=0.5 -n -2 -f 6", "d3d"},
        {"1 0 0 0  0 2 0 0  0 0 -0.125 0.25  0 0 0 1", "--ortho=0.5 -n -2 -f 6", "d3d"},
        {"1 0 0 0  0 2 0 0  0 0 0.125 0.75  0 0 0 1", "--ortho=0.5 -n -2 -f 6", "reversed"},
        {"1 0 0 0  0 2 0 0  0 0 -0.25 -0.5  0 0 0 1", "--ortho=0.5 -n -2 -f 6", "gl"},
    };
    static const char *const products[] = {"--product eye",
                                           "--product eye --error-map",
                                           "--product position:exact",
                                           "--product position:matrix",
                                           "--product normal:projective",
                                           "--product normal:projective --error-map"};
    tally t = {.name = "matrices beside options"};
    const char *path = scratch_file("matrix.txt");
    const char *shot = scratch_file("shot.npy");
    const char *one = scratch_file("one.pfm");
    const char *other = scratch_file("other.pfm");
    for (size_t i = 0; i < sizeof same / sizeof same[0]; i++) {
        FILE *out = fopen(path, "w");
        assert_non_null(out);
        fputs(same[i].entries, out);
        fclose(out);
        printed made = print_of("texture --synthetic plane --parameter distance=1.5 --parameter tilt=20 --size 16x8 "
                                "-F unorm24 -m %s %s -o '%s'",
                                same[i].mapping, same[i].options, shot);
        TALLY(&t, made.status == 0, "%s", made.errors);
        printed_free(&made);
        for (size_t k = 0; k < sizeof products / sizeof products[0]; k++) {
            const char *const common = "texture '%s' -q -F unorm24 -m %s %s %s %s -o '%s'";
            printed a = print_of(common, shot, same[i].mapping, "--matrix", path, products[k], one);
            printed b = print_of(common, shot, same[i].mapping, same[i].options, "", products[k], other);
            TALLY(&t, a.status == 0 && b.status == 0, "%s %s: %s%s", same[i].entries, products[k], a.errors, b.errors);
            printed_free(&a);
            printed_free(&b);
            image p, q;
            image_error error;
            assert_true(image_read(one, &p, &error) && image_read(other, &q, &error));
            const size_t size = (size_t)p.width * p.height * p.channels * sizeof(float);
            bool near = p.channels == q.channels;
            for (size_t at = 0; at < size / sizeof(float) && near; at++) { /* half the height is a rounded tangent */
                const double x = (double)((float *)p.data)[at], y = (double)((float *)q.data)[at];
                near = (isnan(x) && isnan(y)) || fabs(x - y) <= 2e-7 * (1e-6 + fabs(y)) || x == y;
            }
            TALLY(&t, near, "%s: %s is not as by %s", same[i].entries, products[k], same[i].options);
            image_free(&p);
            image_free(&q);
        }
    }
    tally_end(&t);
}

/* Where NDC depth A + B/z has such a value: a distance, INFINITY, or less than 0. */
static double depth_where(double a, double b, double ndc) {
    const double z = ndc == a ? INFINITY : b / (ndc - a);
    return z < 0 ? -1 : z;
}

/* Entries fit a range of NDC depth where both of its ends are before the camera. Where they fit [0, 1] and [-1, 1] one
 * is assumed, where they fit one alone it is found. */
TEST(the_mapping_is_found_where_one_alone_fits) {
    tally t = {.name = "conventions"};
    rng r = rng_make("conventions");
    const char *path = scratch_file("matrix.txt"), *shot = scratch_file("shot.npy");
    int seen[2] = {0};
    printed made = print_of("texture --synthetic plane --size 8x6 -F unorm24 -m d3d -n 1 -f 9 -o '%s'", shot);
    assert_int_equal(made.status, 0);
    printed_free(&made);
    for (uint64_t n = test_cases(16, 40, 400); n > 0; n--) {
        const bool is_signed = rng_below(&r, 2) == 0, reversed = rng_below(&r, 2) == 0;
        const double near = rng_log(&r, 0.1, 10), far = rng_below(&r, 3) == 0 ? INFINITY : near * rng_log(&r, 2, 100);
        const double low = is_signed ? -1 : 0, at_near = reversed ? 1 : low, at_far = reversed ? low : 1;
        const double b = (at_near - at_far) / (1 / near - 1 / far), a = at_far - b / far;
        const double one = depth_where(a, b, 1), zero = depth_where(a, b, 0), minus = depth_where(a, b, -1);
        const bool open = one > 0 && (is_signed ? zero : minus) > 0;
        FILE *out = fopen(path, "w");
        assert_non_null(out);
        fprintf(out, "1 0 0 0  0 2 0 0  0 0 %.17g %.17g  0 0 1 0\n", a, b);
        fclose(out);
        json_t *root = json_printed(0, "texture '%s' -F unorm24 --matrix %s --pixel 1,1 --json", shot, path);
        const char *from = json_string_value(json_object_get(root, "mapping_from"));
        seen[open]++;
        TALLY(&t, from != NULL && strcmp(from, open ? "assumed" : "found") == 0, "%.17g %.17g: %s", a, b,
              from != NULL ? from : "nothing");
        json_decref(root);
    }
    assert_true(seen[0] > 0 && seen[1] > 0);
    tally_end(&t);
}

/* Planes from rounded entries: halves of steps of binary32 or of the last digit, by hand; near is e/(c + 1),
 * far e/(c - 1) of a row -c, -e of NDC depths from -1 on. Few digits are exact. */
TEST(planes_by_digits) {
    static const struct {
        const char *rest, *row; /* the first entry, of the others the digits */
        double c[2], e[2];
    } rows[] = {
        {"1.7320508", "-1.00000095 -0.10000005", {7.5 * 0x1p-23, 8.5 * 0x1p-23}, {0.100000045, 0.100000055}},
        {"1.7320508", "-1.0000200 -0.20000200", {0.00001995, 168.5 * 0x1p-23}, {0.20000199, 0.20000201}},
        {"1.5", "-1.000020 -0.2", {19.5e-6, 20.5e-6}, {0.2, 0.2}},
        {"1.7320508", "-1 -0.2", {-0x1p-25, 0x1p-24}, {0.2 - 1e-8, 0.2 + 1e-8}},
        {"1.5", "-1.05 -1.2", {0.05, 0.05}, {1.2, 1.2}},
        {"1.5", "-1 -1.2", {0, 0}, {1.2, 1.2}},
        {"1.7320508075688772",
         "-1.0000200002000020 -0.20000200002000020",
         {2.00002e-5, 2.00002e-5},
         {0.200002, 0.200002}},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        char arguments[512];
        const char *path = scratch_file("digits.txt");
        FILE *f = fopen(path, "w");
        assert_non_null(f);
        fprintf(f, "%s 0 0 0  0 %s 0 0  0 0 %s  0 0 -1 0\n", rows[i].rest, rows[i].rest, rows[i].row);
        fclose(f);
        snprintf(arguments, sizeof arguments, "texture --synthetic plane --size 8x8 -F unorm24 -m gl --matrix %s",
                 path);
        char *out = output_of(0, arguments, "--json");
        json_t *root = json_of(out);
        const double *c = rows[i].c, *e = rows[i].e;
        const double least = e[0] / c[1], most = c[0] > 0 ? e[1] / c[0] : INFINITY;
        const double got[2] = {plane_end(root, "far", "far_least"), plane_end(root, "far", "far_most")};
        if (!(fabs(got[0] / least - 1) < 1e-4 || (isinf(got[0]) && isinf(least))) ||
            !(fabs(got[1] / most - 1) < 1e-4 || (isinf(got[1]) && isinf(most))))
            fail_msg("%s: far %.9g to %.9g, not %.9g to %.9g", rows[i].row, got[0], got[1], least, most);
        assert_true(plane_end(root, "near", "near_least") <= e[1] / 2 &&
                    plane_end(root, "near", "near_most") >= e[0] / 2.06);
        if (c[0] == c[1] && strlen(rows[i].row) < 12)
            assert_true(json_object_get(root, "planes") == NULL);
        json_decref(root);
        free(out);
    }
}
