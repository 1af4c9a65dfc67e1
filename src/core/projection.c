/* SPDX-License-Identifier: MIT */
#include "depthprec/projection.h"

#include <math.h>
#include <stddef.h>

#include "core/expansion.h"

/* Slopes of the picture's edges: 89.9 degrees off the axis; and half the width of a tile of a large picture. */
static const double EDGE_MOST = 1000, HALF_LEAST = 1e-9;
static const double ORTHO_MOST = 1e12;

enum { X = 0, Y = 4, Z = 8, W = 12 };

static dp_status refuse(dp_matrix_fault *why, const char *rule, const double got[4]) {
    *why = (dp_matrix_fault){rule, {got[0], got[1], got[2], got[3]}};
    return DP_ERROR_MATRIX;
}

/* Zeros where no perspective and no orthographic matrix has anything else, and none where neither has one. */
static dp_status check_form(const double m[16], dp_matrix_fault *why) {
    const int ortho = m[W + 2] == 0 && m[W + 3] == 1;
    for (int i = 0; i < 16; i++)
        if (!isfinite(m[i]))
            return refuse(why, "entries must be finite numbers", m + i / 4 * 4);
    if (m[W] != 0 || m[W + 1] != 0 || !(ortho || (fabs(m[W + 2]) == 1 && m[W + 3] == 0)))
        return refuse(why,
                      m[X + 3] == 0 && m[Y + 3] == 0 && fabs(m[Z + 3]) + fabs(m[W + 3]) == 1
                          ? "the fourth row must be 0 0 1 0, 0 0 -1 0 or 0 0 0 1, as the fourth column is: transpose it"
                          : "the fourth row must be 0 0 1 0, 0 0 -1 0 or, orthographic, 0 0 0 1",
                      m + W);
    const struct {
        int row, column;
        const char *wrong;
    } entries[] = {{X, 0, "is singular: x of the first row must not be 0"},
                   {Y, 1, "is singular: y of the second row must not be 0"},
                   {Z, 2, "is singular: z of the third row must not be 0, or depth is constant"},
                   {Z, 3, "is singular: the last of the third row must not be 0, or depth does not depend on z"}};
    for (int i = 0; i < 4; i++)
        if (m[entries[i].row + entries[i].column] == 0 && entries[i].column != (ortho ? 3 : 2))
            return refuse(why, entries[i].wrong, m + entries[i].row);
    if (m[X] < 0)
        return refuse(why, "x of the first row must be positive: a mirrored picture has another handedness", m + X);
    if (m[X + 1] != 0 || m[X + (ortho ? 2 : 3)] != 0)
        return refuse(why, ortho ? "the first row must be x 0 0 t" : "the first row must be x 0 z 0", m + X);
    if (m[Y] != 0 || m[Y + (ortho ? 2 : 3)] != 0)
        return refuse(why, ortho ? "the second row must be 0 y 0 t" : "the second row must be 0 y z 0", m + Y);
    if (ortho && (m[Z] != 0 || m[Z + 1] != 0))
        return refuse(why, "an orthographic third row must be 0 0 z t: oblique planes need a perspective", m + Z);
    return DP_OK;
}

/* How wide the picture is, and where its axis lies. */
static dp_status take_frustum(dp_projection *p, const double m[16], dp_matrix_fault *why) {
    const double sides[2] = {m[X], m[Y + 1]}, most = p->ortho ? ORTHO_MOST : EDGE_MOST;
    for (int k = 0; k < 2; k++) {
        const double *row = m + 4 * k, moved = p->ortho ? row[3] : p->backwards ? -row[2] : row[2];
        p->scale[k] = fabs(sides[k]);
        p->half[k] = 1 / p->scale[k];
        p->centre[k] = sides[k] < 0 ? -moved : moved;
        if (!(p->half[k] * (1 + fabs(p->centre[k])) <= most && p->half[k] >= (p->ortho ? 1e-12 : HALF_LEAST)))
            return refuse(why,
                          p->ortho ? "half a side must be from 1e-12 to 1e12 scene units, its edges within 1e12"
                                   : "the picture's edges must lie within slopes of 1000, half of it from 1e-9 on",
                          row);
    }
    return DP_OK;
}

/* ---- Depth ------------------------------------------------------------------------------------------------------- */

/* Eye depth where window depth ends, at 0 or at 1; `least` is NDC depth there at 0. */
static double end_of(double c, double e, double end) {
    const double apart = end - c;
    return apart == 0 ? (double)INFINITY : e / apart;
}

static dp_status take_ortho(dp_projection *p, const double row[4], double least, int reversed, dp_matrix_fault *why) {
    p->reversed = reversed;
    p->backwards = (row[2] > 0) == reversed;
    const double c = p->backwards ? -row[2] : row[2], at_0 = (least - row[3]) / c, at_1 = (1 - row[3]) / c;
    p->znear = reversed ? at_1 : at_0;
    p->zfar = reversed ? at_0 : at_1;
    return isfinite(p->znear) && isfinite(p->zfar) ? DP_OK : refuse(why, "the planes must be finite", row);
}

/* The planes of one ray, whose third row is c and e: nearest and farthest so far; beyond infinity is infinite. */
static int add_ray(dp_projection *p, double c, double e, double least, int *beyond) {
    const double at_0 = end_of(c, e, least), at_1 = end_of(c, e, 1);
    const double near = p->reversed ? at_1 : at_0, far = p->reversed ? at_0 : at_1;
    const int seen = near > 0 && near < (double)INFINITY;
    *beyond = *beyond || far < 0;
    if (seen)
        p->znear = fmin(p->znear, near);
    p->zfar = far < 0 ? (double)INFINITY : fmax(p->zfar, far);
    return seen;
}

/* The depths of the planes change linearly over the picture, so their extremes lie in its corners. */
static dp_status take_perspective(dp_projection *p, const double row[4], double least, dp_matrix_fault *why) {
    const double c = p->backwards ? -row[2] : row[2], share = (1 - least) == 2 ? 0.5 : 1;
    const dp_pair moved = dp_two_sum(c, -least);
    int seen = 0, beyond = 0;
    p->reversed = row[3] > 0;
    p->tilt[0] = row[0] * share;
    p->tilt[1] = row[1] * share;
    p->base[0] = moved.hi * share;
    p->base[1] = moved.lo * share;
    p->pull = row[3] * share;
    p->znear = (double)INFINITY;
    p->zfar = 0;
    for (int i = 0; i < 4; i++) {
        const double u = ((i & 1 ? 1 : -1) - p->centre[0]) * p->half[0];
        const double v = ((i & 2 ? 1 : -1) - p->centre[1]) * p->half[1];
        seen = add_ray(p, c + (row[0] * u + row[1] * v), row[3], least, &beyond) || seen;
    }
    p->oblique = row[0] != 0 || row[1] != 0 || beyond;
    return seen ? DP_OK : refuse(why, "nothing ahead of the camera has a window depth in [0, 1] by the third row", row);
}

dp_status dp_projection_init(dp_projection *out, const double m[16], int ndc_signed, int reversed,
                             dp_matrix_fault *fault) {
    dp_matrix_fault own = {NULL, {0}}, *why = fault != NULL ? fault : &own;
    if (out == NULL || m == NULL)
        return DP_ERROR_NULL;
    const double least = ndc_signed ? -1 : 0;
    dp_projection p = {.ortho = m[W + 2] == 0, .backwards = m[W + 2] < 0};
    dp_status status = check_form(m, why);
    if (status == DP_OK)
        status = take_frustum(&p, m, why);
    if (status == DP_OK)
        status = p.ortho ? take_ortho(&p, m + Z, least, reversed, why) : take_perspective(&p, m + Z, least, why);
    if (status != DP_OK)
        return status;
    p.mapping = ndc_signed ? (p.reversed ? DP_MAPPING_GL_REVERSED : DP_MAPPING_GL)
                           : (p.reversed ? DP_MAPPING_REVERSED : DP_MAPPING_D3D);
    *out = p;
    return DP_OK;
}

/* ---- What rounding left of the planes -----------------------------------------------------------------------------
 */

enum { ENTRIES = 16, BITS_TYPED = 20, DIGITS_MOST = 17 };

/* A number of so many bits was hardly typed. */
static int is_long(double x) {
    int exponent;
    const double bits = ldexp(frexp(x, &exponent), BITS_TYPED);
    return bits != floor(bits);
}

/* Entries were rounded to binary32 if all are such numbers and one is long, else only the long ones, to doubles. */
static void ends_by_bits(const double m[ENTRIES], double least[ENTRIES], double most[ENTRIES]) {
    int single = 1, any = 0;
    for (int i = 0; i < ENTRIES; i++) {
        single = single && (double)(float)m[i] == m[i];
        any = any || is_long(m[i]);
    }
    single = single && any;
    for (int i = 0; i < ENTRIES; i++) {
        const float f = (float)m[i];
        const int rounded = single ? m[i] != 0 : is_long(m[i]);
        least[i] = single ? 0.5 * (m[i] + (double)nextafterf(f, -INFINITY)) : nextafter(m[i], (double)-INFINITY);
        most[i] = single ? 0.5 * (m[i] + (double)nextafterf(f, INFINITY)) : nextafter(m[i], (double)INFINITY);
        if (!rounded)
            least[i] = most[i] = m[i];
    }
}

static void turn(double turned[ENTRIES], const double m[ENTRIES]) {
    for (int i = 0; i < ENTRIES; i++)
        turned[i] = m[i % 4 * 4 + i / 4];
}

static dp_status take_as(dp_projection *out, const dp_projection *p, const double m[ENTRIES]) {
    const dp_mapping_row *row = dp_mapping_get(p->mapping);
    return row == NULL ? DP_ERROR_MATRIX : dp_projection_init(out, m, row->ndc_signed, p->reversed, NULL);
}

static int is_of(const dp_projection *p, const double m[ENTRIES]) {
    dp_projection q;
    return take_as(&q, p, m) == DP_OK && q.znear == p->znear && q.zfar == p->zfar;
}

static void widen(dp_planes *out, double near, double far) {
    out->near_least = fmin(out->near_least, near);
    out->near_most = fmax(out->near_most, near);
    out->far_least = fmin(out->far_least, far);
    out->far_most = fmax(out->far_most, far);
}

/* The most by which c + a u + b v is rounded. */
static double lost_of(const dp_projection *p, const double row[4]) {
    const double across = fabs(row[0]) * p->half[0] * (1 + fabs(p->centre[0]));
    const double up = fabs(row[1]) * p->half[1] * (1 + fabs(p->centre[1]));
    return across + up == 0 ? 0 : 0x1p-50 * (fabs(row[2]) + across + up);
}

/* Planes are monotone in each entry that they depend on, so their extremes are where each is at an end. */
static void visit_corners(dp_planes *out, const dp_projection *p, const double m[ENTRIES],
                          const double *const ends[2]) {
    static const int shaping[] = {Z + 2, Z + 3, Z, Z + 1, X, X + 2, Y + 1, Y + 2};
    const double lost = lost_of(p, m + Z);
    const int count = lost > 0 ? 8 : 2;
    double at[ENTRIES];
    int rounded = 0;
    for (int i = 0; i < ENTRIES; i++)
        at[i] = m[i];
    for (int i = 0; i < count; i++)
        rounded = rounded || ends[0][shaping[i]] < ends[1][shaping[i]];
    for (int corner = 0; rounded && corner < 1 << count; corner++) {
        dp_projection q;
        for (int i = 0; i < count; i++)
            at[shaping[i]] = ends[corner >> i & 1][shaping[i]];
        at[Z + 2] += corner & 1 ? lost : -lost;
        if (take_as(&q, p, at) == DP_OK)
            widen(out, q.znear, q.zfar);
    }
}

/* The fewest digits to which the number is rounded and still in the range. */
static int digits_of(double value, double least, double most) {
    double unit = 1;
    if (!isfinite(value) || value == 0 || least == most)
        return DIGITS_MOST;
    while (unit * 10 <= fabs(value))
        unit *= 10;
    while (unit > fabs(value))
        unit /= 10;
    for (int digits = 1; digits < DIGITS_MOST; digits++, unit /= 10) {
        const double rounded = floor(value / unit + 0.5) * unit;
        if (least <= rounded && rounded <= most)
            return digits;
    }
    return DIGITS_MOST;
}

dp_status dp_projection_planes(dp_planes *out, const dp_projection *p, const double m[16], const double least[16],
                               const double most[16]) {
    double by_bits[2][ENTRIES], turned[3][ENTRIES];
    if (out == NULL || p == NULL || m == NULL || (least == NULL) != (most == NULL))
        return DP_ERROR_NULL;
    if (least == NULL)
        ends_by_bits(m, by_bits[0], by_bits[1]);
    const double *rows = m, *ends[2] = {least != NULL ? least : by_bits[0], most != NULL ? most : by_bits[1]};
    if (!is_of(p, m)) {
        turn(turned[0], ends[0]);
        turn(turned[1], ends[1]);
        turn(turned[2], m);
        ends[0] = turned[0];
        ends[1] = turned[1];
        rows = turned[2];
        if (!is_of(p, rows))
            return DP_ERROR_MATRIX;
    }
    dp_planes made = {p->znear, p->znear, p->zfar, p->zfar, 0, 0};
    visit_corners(&made, p, rows, ends);
    made.near_digits = digits_of(p->znear, made.near_least, made.near_most);
    made.far_digits = digits_of(p->zfar, made.far_least, made.far_most);
    *out = made;
    return DP_OK;
}

/* ---- The convention ---------------------------------------------------------------------------------------------- */

/* A search for the cameras of a matrix: those that fit, of which the first is kept, and what was wrong last. */
typedef struct search {
    dp_mapping mapping; /* asked for, or DP_MAPPING_COUNT */
    int count;
    dp_projection found;
    dp_matrix_fault *why;
} search;

static void try_one(search *s, const double m[16], const dp_mapping_row *row) {
    dp_projection p;
    if (dp_projection_init(&p, m, row->ndc_signed, row->reversed, s->why) != DP_OK)
        return;
    if (p.reversed != row->reversed) {
        if (s->mapping != DP_MAPPING_COUNT)
            refuse(s->why,
                   p.reversed ? "window depth falls with distance: the mapping must be reversed or gl-reversed"
                              : "window depth grows with distance: the mapping must be d3d or gl",
                   m + Z);
    } else if (p.oblique) {
        refuse(s->why, "the planes must be the same for every pixel, and far not beyond infinity", m + Z);
    } else if (s->count++ == 0) {
        s->found = p;
    }
}

static void try_layout(search *s, const double m[16]) {
    for (int mapping = 0; mapping < DP_MAPPING_COUNT; mapping++) {
        const dp_mapping_row *row = dp_mapping_get((dp_mapping)mapping);
        const int asked = s->mapping == DP_MAPPING_COUNT || s->mapping == (dp_mapping)mapping;
        if (row->curve == DP_CURVE_PERSPECTIVE && asked)
            try_one(s, m, row);
    }
}

/* Is it the row of w of some projection. */
static int is_last_row(double x, double y, double z, double w) {
    return x == 0 && y == 0 && ((fabs(z) == 1 && w == 0) || (z == 0 && w == 1));
}

dp_status dp_projection_find(dp_projection *out, const double m[16], dp_layout layout, dp_mapping mapping,
                             dp_matrix_fault *fault) {
    dp_matrix_fault own = {NULL, {0}};
    search s = {.mapping = mapping, .why = fault != NULL ? fault : &own};
    double turned[ENTRIES];
    if (out == NULL || m == NULL)
        return DP_ERROR_NULL;
    if (mapping != DP_MAPPING_COUNT &&
        (dp_mapping_get(mapping) == NULL || dp_mapping_get(mapping)->curve != DP_CURVE_PERSPECTIVE))
        return DP_ERROR_MAPPING;
    int same = 1;
    turn(turned, m);
    for (int i = 0; i < ENTRIES; i++)
        same = same && turned[i] == m[i];
    const int by_columns = is_last_row(turned[W], turned[W + 1], turned[W + 2], turned[W + 3]);
    const int by_rows = is_last_row(m[W], m[W + 1], m[W + 2], m[W + 3]) || !by_columns;
    if (layout == DP_LAYOUT_ROWS || (layout != DP_LAYOUT_COLUMNS && by_rows))
        try_layout(&s, m);
    if (layout == DP_LAYOUT_COLUMNS || (layout != DP_LAYOUT_ROWS && by_columns && !same))
        try_layout(&s, turned);
    if (s.count == 0)
        return DP_ERROR_MATRIX;
    if (s.count > 1)
        return DP_ERROR_CONVENTION;
    *out = s.found;
    return DP_OK;
}
