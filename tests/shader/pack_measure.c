/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The error of packings: of depths in doubles by the intervals of all codes, in binary32 by its numbers; of normals at
 * the corners of all codes. */
#include "pack_measure.h"

#include "core/bits.h"
#include "shader/pack_rg.h"
#include "support.h"

typedef struct sums {
    double sum, bias, weight, max, at;
    uint64_t codes;
} sums;

static void sums_end(const sums *t, pack_error *out) {
    out->depth = (pack_bound){t->sum / t->weight, t->max};
    out->depth_bias = t->bias / t->weight;
    out->depth_at = t->at;
    out->depth_codes = t->codes;
}

/* ---- Depths in exact arithmetic
 * -------------------------------------------------------------------------------------------- */

static uint32_t code_of(const pack_row *row, double v, double *decoded) {
    uint32_t codes[PACK_CHANNELS_MAX];
    row->encode(row, &v, codes);
    row->decode(row, codes, decoded);
    return codes[0] << row->bits | codes[1];
}

/* The greatest number that is stored as `from` is: intervals are shorter than `span`, and codes never come back. */
static double last_alike(const pack_row *row, double from, uint32_t code, double span) {
    double in = from, out = fmin(from + span, 1), decoded;
    for (double mid = (in + out) / 2; mid > in && mid < out; mid = (in + out) / 2)
        *(code_of(row, mid, &decoded) == code ? &in : &out) = mid;
    return in;
}

/* Inside an interval the error is linear, so its ends and the integral of |x| and x say all. */
static void add_interval(sums *t, double from, double to, double decoded) {
    const double a = decoded - from, b = decoded - to;
    const double width = to - from;
    t->weight += width;
    t->bias += width * (a + b) / 2;
    t->sum += a > 0 && b < 0 ? (a * a + b * b) / 2 : width * fabs(a + b) / 2;
    if (fmax(fabs(a), fabs(b)) > t->max) {
        t->max = fmax(fabs(a), fabs(b));
        t->at = fabs(a) > fabs(b) ? from : to;
    }
    t->codes++;
}

static void measure_exact(const pack_row *row, pack_error *out) {
    const double span = 1.5 / (double)(((1U << row->bits) - 1) * ((1U << row->bits) - 1));
    sums t = {0};
    for (double from = 0; from < 1;) {
        double decoded;
        const uint32_t code = code_of(row, from, &decoded);
        const double to = last_alike(row, from, code, span);
        const double next = nextafter(to, 1);
        add_interval(&t, from, next, decoded);
        if (next >= 1)
            break;
        from = next;
    }
    sums_end(&t, out);
}

/* ---- Depths in binary32
 * ---------------------------------------------------------------------------------------------------- */

/*
 * A number stands for the reals from it to the next, so each binade has its weight. From 2^-9 up all are visited;
 * below, where the coarse channel is 0, every 61st, down to 2^-24, under which all decode to 0 or nearly.
 */
enum { EXPONENT_ALL = -9, EXPONENT_LAST = -24, STRIDE = 61 };

/* The errors of a block, in loops that a compiler can make vectors of: the reduction has LANES sums of its own. */
enum { BLOCK = 512, LANES = 8 };

typedef struct lanes {
    double sum[LANES], bias[LANES];
    float max[LANES];
} lanes;

static void add_block(const pack_row *row, uint32_t first, uint32_t stride, uint8_t used[], lanes *l) {
    const double half = row->truncates ? 0 : 0.5;
    uint32_t code[BLOCK];
    float error[BLOCK];
    for (uint32_t i = 0; i < BLOCK; i++) {
        const float v = dp_float32(first + i * stride);
        code[i] = pack_rg_code(v, half);
        error[i] = pack_rg_depth(code[i]) - v;
    }
    for (uint32_t i = 0; i < BLOCK; i += LANES)
        for (uint32_t k = 0; k < LANES; k++) {
            const float e = error[i + k], size = fabsf(e);
            l->sum[k] += (double)size;
            l->bias[k] += (double)e;
            l->max[k] = size > l->max[k] ? size : l->max[k];
        }
    for (uint32_t i = 0; i < BLOCK; i++)
        used[code[i]] = 1;
}

/* A number that reaches the largest error of its binade, which is known to be there. */
static double find(const pack_row *row, uint32_t first, uint32_t stride, float max) {
    const double half = row->truncates ? 0 : 0.5;
    for (;; first += stride) {
        const float v = dp_float32(first);
        if (fabsf(pack_rg_depth(pack_rg_code(v, half)) - v) == max)
            return (double)v;
    }
}

static void add_binade(const pack_row *row, int exponent, uint8_t used[], sums *t) {
    const uint32_t stride = exponent < EXPONENT_ALL ? STRIDE : 1;
    const uint32_t first = (uint32_t)(exponent + 127) << 23;
    const uint32_t blocks = (1U << 23) / (BLOCK * stride);
    lanes l = {.max = {0}};
    for (uint32_t b = 0; b < blocks; b++)
        add_block(row, first + b * BLOCK * stride, stride, used, &l);
    const double weight = ldexp(1, exponent), share = weight / ((double)blocks * BLOCK);
    float max = 0;
    for (int k = 0; k < LANES; k++) {
        t->sum += l.sum[k] * share;
        t->bias += l.bias[k] * share;
        max = l.max[k] > max ? l.max[k] : max;
    }
    t->weight += weight;
    if ((double)max > t->max) {
        t->max = (double)max;
        t->at = find(row, first, stride, max);
    }
}

static void measure_binary32(const pack_row *row, pack_error *out) {
    uint8_t used[1 << 16];
    sums t = {0};
    memset(used, 0, sizeof used);
    for (int exponent = -1; exponent >= EXPONENT_LAST; exponent--)
        add_binade(row, exponent, used, &t);
    for (uint32_t i = 0; i < 1U << 16; i++)
        t.codes += used[i];
    sums_end(&t, out);
}

static void measure_depth(const pack_row *row, pack_error *out) {
    if (row->binary32)
        measure_binary32(row, out);
    else
        measure_exact(row, out);
}

/*
 * The error of normal packings.
 *
 * Largest angle: a code's vectors fill a region of the sphere, and the largest angle to the vector that the code gives
 * back is reached at a corner of it. xyz: the region is cut out by the sides of a cube, so it is bounded by arcs of
 * circles, along each of which the angle grows away from one point of it. oct: on each face of the octahedron the
 * direction is linear in the plane of the codes, so vectors within an angle are a convex set there. stereo: circles
 * are mapped to circles, so they are a disc. Where all corners of a convex polygon lie in a convex set, so does it all.
 *
 * Signs and the order of the axes change nothing, so one part of the sphere is enough.
 */

/* ---- The largest angle ------------------------------------------------------------------------------------------- */

typedef struct search {
    const pack_row *row;
    double most;    /* the greatest code */
    double back[3]; /* the vector that the code gives back, any length */
    double sine2;   /* squared sine of the largest angle yet */
    double at[3];   /* ... and where */
    uint64_t codes;
} search;

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void offer(search *s, const double n[3]) {
    const double *b = s->back;
    const double cross[3] = {n[1] * b[2] - n[2] * b[1], n[2] * b[0] - n[0] * b[2], n[0] * b[1] - n[1] * b[0]};
    const double sine2 = dot(cross, cross) / (dot(n, n) * dot(b, b));
    if (!(sine2 > s->sine2))
        return;
    s->sine2 = sine2;
    for (int i = 0; i < 3; i++)
        s->at[i] = n[i];
}

static bool between(double x, double lo, double hi) {
    return x >= lo && x <= hi;
}

/* The part of a code's interval that is not negative, in units of the greatest code. */
static void interval(double code, double most, double out[2]) {
    out[0] = fmax(code - 0.5, 0) / most;
    out[1] = fmin(code + 0.5, most) / most;
}

/* Points of the sphere on the twelve edges of a cube. */
static void xyz_corners(search *s, double side[3][2]) {
    for (int axis = 0; axis < 3; axis++) {
        const int i = (axis + 1) % 3, j = (axis + 2) % 3;
        for (int k = 0; k < 4; k++) {
            const double u = side[i][k & 1], v = side[j][k >> 1];
            const double w2 = 1 - u * u - v * v;
            if (!between(w2, side[axis][0] * side[axis][0], side[axis][1] * side[axis][1]))
                continue;
            double n[3];
            n[axis] = sqrt(w2);
            n[i] = u;
            n[j] = v;
            offer(s, n);
        }
    }
}

static uint64_t with_signs(uint64_t count, int code) {
    return code > 0 ? 2 * count : count;
}

static void xyz_search(search *s) {
    const int most = (int)s->most;
    double side[3][2];
    for (int a = 0; a <= most; a++)
        for (int b = 0; b <= a; b++) {
            interval(a, most, side[0]);
            interval(b, most, side[1]);
            const double near2 = side[0][0] * side[0][0] + side[1][0] * side[1][0];
            const double far2 = side[0][1] * side[0][1] + side[1][1] * side[1][1];
            if (near2 > 1)
                break;
            const int lo = far2 < 1 ? (int)floor(sqrt(1 - far2) * most + 0.5) : 0;
            const int hi = (int)floor(sqrt(1 - near2) * most + 0.5);
            for (int c = lo; c <= hi && c <= b; c++) {
                interval(c, most, side[2]);
                s->back[0] = a;
                s->back[1] = b;
                s->back[2] = c;
                xyz_corners(s, side);
                const uint64_t orders = a == b && b == c ? 1 : a == b || b == c ? 3 : 6;
                s->codes += with_signs(with_signs(with_signs(orders, a), b), c);
            }
        }
}

static void oct_direction(double x, double y, double out[3]) {
    const double z = 1 - x - y;
    out[0] = z < 0 ? 1 - y : x;
    out[1] = z < 0 ? 1 - x : y;
    out[2] = z;
}

static void oct_offer(search *s, double x, double y) {
    double n[3];
    oct_direction(x, y, n);
    offer(s, n);
}

/* Corners of a cell, and where its sides meet the fold. */
static void oct_search(search *s) {
    double x[2], y[2];
    for (double a = 0; a <= s->most; a++)
        for (double b = 0; b <= a; b++) {
            interval(a, s->most, x);
            interval(b, s->most, y);
            oct_direction(a / s->most, b / s->most, s->back);
            for (int i = 0; i < 2; i++) {
                oct_offer(s, x[i], y[0]);
                oct_offer(s, x[i], y[1]);
                if (between(1 - x[i], y[0], y[1]))
                    oct_offer(s, x[i], 1 - x[i]);
                if (between(1 - y[i], x[0], x[1]))
                    oct_offer(s, 1 - y[i], y[i]);
            }
        }
    s->codes = (uint64_t)((2 * s->most + 1) * (2 * s->most + 1));
}

/* The same where codes begin at whole numbers of 4095.5ths and are given back as 4095ths: no sign is like another. */
static void oct_888_offer(search *s, double x, double y) {
    const double size = fabs(x) + fabs(y);
    const double lower[3] = {copysign(1 - fabs(y), x), copysign(1 - fabs(x), y), 1 - size};
    offer(s, size > 1 ? lower : (const double[]){x, y, 1 - size});
}

static void oct_888_search(search *s) {
    enum { MOST = 4095 };
    for (int a = 0; a <= MOST; a++)
        for (int b = 0; b <= a; b++) {
            const double x[2] = {a / 4095.5 * 2 - 1, fmin((a + 1) / 4095.5 * 2 - 1, 1)};
            const double y[2] = {b / 4095.5 * 2 - 1, fmin((b + 1) / 4095.5 * 2 - 1, 1)};
            const double u = a / 4095.0 * 2 - 1, v = b / 4095.0 * 2 - 1, size = fabs(u) + fabs(v);
            s->back[0] = size > 1 ? copysign(1 - fabs(v), u) : u;
            s->back[1] = size > 1 ? copysign(1 - fabs(u), v) : v;
            s->back[2] = 1 - size;
            for (int i = 0; i < 2; i++) {
                oct_888_offer(s, x[i], y[0]);
                oct_888_offer(s, x[i], y[1]);
                for (int fold = -1; fold <= 1; fold++) {
                    const double at_y = fold * (1 - fabs(x[i])), at_x = fold * (1 - fabs(y[i]));
                    if (between(at_y, y[0], y[1]))
                        oct_888_offer(s, x[i], at_y);
                    if (between(at_x, x[0], x[1]))
                        oct_888_offer(s, at_x, y[i]);
                }
            }
        }
    s->codes = (MOST + 1) * (MOST + 1);
}

static void stereo_offer(search *s, double x, double y) {
    const double r2 = x * x + y * y;
    if (r2 <= 1 + 0x1p-50)
        offer(s, (const double[]){2 * x, 2 * y, 1 - r2});
}

/* Corners of a cell in the disc of the hemisphere, and where its sides meet the rim. Codes have no middle one. */
static void stereo_search(search *s) {
    const double scale = 2 * 1.7777 / s->most;
    for (double a = 0.5; a < s->most / 2; a++)
        for (double b = 0.5; b <= a; b++) {
            const double x[2] = {scale * (a - 0.5), scale * (a + 0.5)};
            const double y[2] = {scale * (b - 0.5), scale * (b + 0.5)};
            if (x[0] * x[0] + y[0] * y[0] >= 1)
                break;
            const double u = scale * a, v = scale * b;
            s->back[0] = 2 * u;
            s->back[1] = 2 * v;
            s->back[2] = 1 - u * u - v * v;
            for (int i = 0; i < 2; i++) {
                stereo_offer(s, x[i], y[0]);
                stereo_offer(s, x[i], y[1]);
                const double rim_y = sqrt(fmax(1 - x[i] * x[i], 0)), rim_x = sqrt(fmax(1 - y[i] * y[i], 0));
                if (between(rim_y, y[0], y[1]))
                    stereo_offer(s, x[i], rim_y);
                if (between(rim_x, x[0], x[1]))
                    stereo_offer(s, rim_x, y[i]);
            }
            s->codes += a == b ? 4 : 8;
        }
}

static double angle(const double a[3], const double b[3]) {
    const double cross[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    return atan2(sqrt(dot(cross, cross)), dot(a, b)) * 180 / M_PI;
}

static double error_of(const pack_row *row, const double n[3]) {
    const double in[PACK_INPUTS_MAX] = {n[0], n[1], n[2], 0};
    uint32_t codes[PACK_CHANNELS_MAX];
    double back[PACK_INPUTS_MAX];
    row->encode(row, in, codes);
    row->decode(row, codes, back);
    return angle(n, back);
}

/* A corner belongs to several codes: of the vectors a hair beside it, the one whose code is that of the search. */
static void beside_corner(const search *s, double out[3]) {
    double worst = -1;
    for (int k = 0; k < 8; k++) {
        double n[3], length = 0;
        for (int i = 0; i < 3; i++)
            n[i] = s->at[i] + ((k >> i & 1) != 0 ? 1e-12 : -1e-12);
        n[2] = s->row->sphere ? n[2] : fmax(n[2], 0);
        length = sqrt(dot(n, n));
        for (int i = 0; i < 3; i++)
            n[i] /= length;
        if (error_of(s->row, n) <= worst)
            continue;
        worst = error_of(s->row, n);
        for (int i = 0; i < 3; i++)
            out[i] = n[i];
    }
}

/* ---- The mean ---------------------------------------------------------------------------------------------------- */

/* Vectors of the additive sequence of the plastic number (Roberts 2018), which fills a square evenly. */
static void mean(const pack_row *row, pack_error *out) {
    enum { COUNT = 1 << 20 };
    double sum = 0, squares = 0, u = 0, v = 0;
    for (int i = 0; i < COUNT; i++) {
        u += 0.75487766624669276;
        v += 0.56984029099805327;
        u -= u >= 1;
        v -= v >= 1;
        const double z = row->sphere ? 2 * v - 1 : v, r = sqrt(1 - z * z);
        const double error = error_of(row, (const double[]){r * cos(2 * M_PI * u), r * sin(2 * M_PI * u), z});
        sum += error;
        squares += error * error;
    }
    out->normal.mean = sum / COUNT;
    out->normal_spread = sqrt((squares / COUNT - out->normal.mean * out->normal.mean) / COUNT);
}

static void measure_normal(const pack_row *row, pack_error *out) {
    static void (*const searches[])(search *) = {[PACK_STEREO] = stereo_search,
                                                 [PACK_OCT] = oct_search,
                                                 [PACK_OCT_888] = oct_888_search,
                                                 [PACK_XYZ] = xyz_search};
    const uint32_t codes = 1U << (row->layout == PACK_STEREO ? row->bits : row->bits - 1);
    search s = {.row = row, .most = codes - 1};
    searches[row->layout](&s);
    beside_corner(&s, out->normal_at);
    out->normal.max = asin(sqrt(s.sine2)) * 180 / M_PI;
    out->codes = s.codes;
    mean(row, out);
}

pack_error pack_measure(const pack_row *row) {
    pack_error out = {.codes = 0};
    if (row->kind != PACK_NORMAL)
        measure_depth(row->kind == PACK_DEPTH ? row : pack_get(0), &out);
    if (row->kind != PACK_DEPTH)
        measure_normal(row, &out);
    return out;
}

size_t pack_count(void) {
    size_t rows = 0;
    while (pack_get(rows) != NULL)
        rows++;
    return rows;
}

const pack_error *pack_error_of(const char *name) {
    static pack_error errors[64];
    static bool done[64];
    for (size_t i = 0; i < pack_count() && i < 64; i++)
        if (strcmp(pack_get(i)->name, name) == 0) {
            if (!done[i])
                errors[i] = pack_measure(pack_get(i));
            done[i] = true;
            return &errors[i];
        }
    fail_msg("no row %s", name);
    return NULL;
}
