/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "slanted.h"

#include "world/reach.h"

static const double pi = 3.14159265358979323846;

/* ---- What they are seen with ------------------------------------------------------------------------------------- */

bool slanted_draw_camera(rng *r, slanted *s, const slanted_kind *kind, const char *format) {
    dp_spec spec = dp_spec_default();
    dp_format found[2];
    const bool reversed = rng_below(r, 2) == 0, infinite = rng_below(r, 2) == 0;
    if (dp_format_parse(format, found) != 1 || dp_arith_parse(kind->arith, &spec.arith) != DP_OK)
        return false;
    s->kind = kind;
    s->cut = RASTER_CLIP_ANY;
    s->world = (slanted_world){0};
    spec.format = found[0];
    spec.mapping = reversed ? DP_MAPPING_REVERSED : DP_MAPPING_D3D;
    spec.znear = rng_log(r, 0.01, 10.0);
    spec.zfar = infinite ? INFINITY : spec.znear * rng_log(r, 10.0, 1e6);
    spec.model = DP_MODEL_FLOAT;
    if (dp_setup_init(&s->setup, &spec) != DP_OK)
        return false;
    const double n = spec.znear, f = spec.zfar;
    s->camera.reciprocal = dp_arith_get(spec.arith)->reciprocal;
    s->camera.a = (float)(reversed ? (infinite ? 0.0 : -n / (f - n)) : (infinite ? 1.0 : f / (f - n)));
    s->camera.b = (float)(reversed ? (infinite ? n : n * f / (f - n)) : (infinite ? -n : -n * f / (f - n)));
    dp_triangles *t = &s->class;
    *t = dp_triangles_default();
    t->width = s->camera.width = (int)rng_log(r, 64.0, 4096.0);
    t->height = s->camera.height = (int)rng_log(r, 64.0, 4096.0);
    t->fov_y = rng_uniform(r, 5.0, 110.0);
    const double y = tan(t->fov_y * pi / 360.0);
    s->camera.p11 = (float)(1.0 / y);
    s->camera.p00 = (float)(t->height / (y * t->width));
    s->camera.bits = kind->bits[rng_below(r, 2)];
    t->subpixel = s->camera.bits < 0 ? 0 : s->camera.bits;
    const dp_anchor_row *anchor = dp_anchor_get(kind->anchor);
    t->plane = anchor != NULL ? anchor->plane : (dp_plane_error){.value = 1.0};
    return true;
}

void slanted_draw_range(rng *r, slanted *s) {
    dp_spec spec = s->setup.spec;
    rng_range(r, spec.depth_range);
    assert_int_equal(dp_setup_init(&s->setup, &spec), DP_OK);
}

/* The ray of a place on the screen, of depth 1. */
static void ray_of(const slanted *s, double x, double y, double ray[3]) {
    ray[0] = (2.0 * x / s->camera.width - 1.0) / (double)s->camera.p00;
    ray[1] = (2.0 * y / s->camera.height - 1.0) / (double)s->camera.p11;
    ray[2] = 1.0;
}

double slanted_along(const slanted *s, double x, double y) {
    double ray[3];
    ray_of(s, x, y, ray);
    return s->n[0] * ray[0] + s->n[1] * ray[1] + s->n[2];
}

/* ---- Planes and triangles ---------------------------------------------------------------------------------------- */

/* A triangle about the pixel: width and height of its box, and how slim it is. */
static void draw_triangle(rng *r, slanted *s, int which) {
    const double size = rng_log(r, 2.0, 400.0), turn = rng_uniform(r, 0.0, 2.0 * pi);
    const double thin = rng_unit(r) < 0.5 ? 1.0 : rng_log(r, 0.05, 1.0);
    for (int i = 0; i < 3; i++) {
        const double angle = 2.0 * pi / 3.0 * i + rng_uniform(r, -0.5, 0.5);
        const double u = size * cos(angle), v = size * thin * sin(angle);
        s->at[which][i][0] = s->px + u * cos(turn) - v * sin(turn);
        s->at[which][i][1] = s->py + u * sin(turn) + v * cos(turn);
    }
}

/* Half a step of the grid off, so that the vertex is moved towards the other plane. */
static void place_badly(slanted *s, int which) {
    const double step = ldexp(1.0, -s->camera.bits);
    const double rise = which == 0 ? -1.0 : 1.0; /* the nearer plane seems farther */
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 2; k++) {
            const double grid = rint(s->at[which][i][k] / step) * step;
            const double way = s->n[k] > 0.0 ? rise : -rise;
            s->at[which][i][k] = grid + 0.499 * way * step;
        }
}

bool slanted_draw_planes(rng *r, slanted *s) {
    const double slant = (rng_below(r, 3) == 0 ? rng_uniform(r, 80.0, 90.0) : rng_uniform(r, 0.5, 90.0)) * pi / 180.0;
    const double turn = rng_below(r, 2) == 0 ? pi / 4.0 * (double)(2 * rng_below(r, 4) + 1) : rng_uniform(r, 0, 2 * pi);
    const double last = fmin(s->setup.spec.zfar, s->setup.spec.znear * 1e6);
    s->n[0] = sin(slant) * cos(turn);
    s->n[1] = sin(slant) * sin(turn);
    s->n[2] = cos(slant);
    s->z = rng_log(r, s->setup.spec.znear, last);
    s->px = 0.5 + (double)rng_below(r, (uint64_t)s->camera.width);
    s->py = 0.5 + (double)rng_below(r, (uint64_t)s->camera.height);
    s->class.slant_lo = fmax(slant * 180.0 / pi - 1e-6, 0.0);
    s->class.slant_hi = fmin(slant * 180.0 / pi + 1e-6, 90.0);
    for (int k = 0; k < 2; k++) {
        draw_triangle(r, s, k);
        if (s->camera.bits >= 0 && rng_below(r, 4) != 0)
            place_badly(s, k);
    }
    s->c = s->z * slanted_along(s, s->px, s->py);
    return s->c > 1e-6 * s->z;
}

/* ---- Their class, and how far they are apart --------------------------------------------------------------------- */

typedef struct spot {
    double x, y;
} spot;

/* Cuts a polygon at a side of the screen: where `keep` less `along` times a spot is negative. */
static int cut_at(spot along, double keep, const spot *in, int count, spot *out) {
    int made = 0;
    for (int i = 0; i < count; i++) {
        const spot a = in[i], b = in[(i + 1) % count];
        const double inside = keep - along.x * a.x - along.y * a.y, next = keep - along.x * b.x - along.y * b.y;
        const double t = inside / (inside - next);
        if (inside >= 0.0)
            out[made++] = a;
        if ((inside >= 0.0) != (next >= 0.0))
            out[made++] = (spot){a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
    }
    return made;
}

/* The polygon that is left of a triangle on the screen, in Mesa's order; *sides is how many cut it. */
static int left_of(const slanted *s, int which, spot polygon[RASTER_CORNERS], int *sides) {
    const double width = s->camera.width, height = s->camera.height;
    const struct {
        spot along;
        double keep;
    } side[] = {{{1, 0}, width}, {{-1, 0}, 0}, {{0, 1}, height}, {{0, -1}, 0}};
    int count = 3;
    *sides = 0;
    for (int i = 0; i < 3; i++)
        polygon[i] = (spot){s->at[which][i][0], s->at[which][i][1]};
    for (int k = 0; k < 4 && s->cut == RASTER_CLIP_PIECES; k++) {
        spot before[RASTER_CORNERS];
        bool outside = false;
        for (int i = 0; i < count; i++) {
            before[i] = polygon[i];
            outside = outside || side[k].along.x * before[i].x + side[k].along.y * before[i].y > side[k].keep;
        }
        count = outside ? cut_at(side[k].along, side[k].keep, before, count, polygon) : count;
        *sides += outside;
    }
    return count;
}

/* The class of one triangle of the screen: its box and how slim it is. */
static void fit_piece(dp_triangles *t, const spot v[3]) {
    const double area = fabs((v[1].x - v[0].x) * (v[2].y - v[0].y) - (v[2].x - v[0].x) * (v[1].y - v[0].y));
    const double wide = fmax(fmax(v[0].x, v[1].x), v[2].x) - fmin(fmin(v[0].x, v[1].x), v[2].x);
    const double high = fmax(fmax(v[0].y, v[1].y), v[2].y) - fmin(fmin(v[0].y, v[1].y), v[2].y);
    double longest = 0.0;
    for (int i = 0; i < 3; i++) {
        const spot *next = &v[(i + 1) % 3];
        longest = fmax(longest, hypot(next->x - v[i].x, next->y - v[i].y));
    }
    /* a grid step more on each side: what counts is where the vertices are moved to */
    t->pixels = fmax(t->pixels, fmax(wide, high) + 0.25);
    const bool narrow = t->plane.origin > 0.0 && (wide < 1.0 || high < 1.0);
    t->slim = narrow || !(area > 0.0) ? INFINITY : fmax(t->slim, longest * longest / area * (1.0 + 0.5 / sqrt(area)));
}

static void fit_one(slanted *s, int which, double c) {
    dp_triangles *t = &s->class;
    spot polygon[RASTER_CORNERS];
    int sides;
    const int count = left_of(s, which, polygon, &sides);
    for (int i = 0; i < 3; i++) {
        const double z = c / slanted_along(s, s->at[which][i][0], s->at[which][i][1]) - s->world.shift[2];
        const double at = s->z - s->world.shift[2];
        t->depth = fmax(t->depth, z > 0.0 ? fmax(z / at, at / z) : INFINITY);
    }
    for (int i = 2; i < count; i++)
        fit_piece(t, (const spot[3]){polygon[0], polygon[i - 1], polygon[i]});
    if (sides == 0)
        return;
    /* vertices beside the screen, of a triangle that is this wide */
    const dp_plane_error *e = &dp_anchor_get(s->kind->anchor)->plane;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            for (int axis = 0; axis < 2; axis++)
                t->pixels = fmax(t->pixels, fabs(s->at[which][i][axis] - s->at[which][k][axis]) + 0.25);
    t->plane.value = fmax(t->plane.value, e->value + 6.0 * sides);
    t->plane.origin = fmax(t->plane.origin, e->origin + 3.0 * sides);
}

bool slanted_in_class(const slanted *s, const double at[3][2]) {
    dp_triangles drawn = s->class;
    fit_piece(&drawn, (const spot[3]){{at[0][0], at[0][1]}, {at[1][0], at[1][1]}, {at[2][0], at[2][1]}});
    return drawn.pixels == s->class.pixels && drawn.slim == s->class.slim;
}

bool slanted_fit(slanted *s, const double c[2]) {
    dp_triangles *t = &s->class;
    t->pixels = 1.0;
    t->slim = 2.0;
    t->depth = 1.0;
    if (s->cut == RASTER_CLIP_PIECES)
        t->plane = dp_anchor_get(s->kind->anchor)->plane;
    for (int k = 0; k < 2; k++)
        fit_one(s, k, c[k]);
    t->depth *= 1.0 + 1e-6;
    if (slanted_is_moved(s)) { /* where it is drawn its vertices are elsewhere: see slanted_in_class() */
        t->pixels *= 1.2;
        t->slim = fmin(1.5 * t->slim, 1024.0);
    }
    return t->depth < 1e3 && dp_triangles_check(t) == DP_OK;
}

bool slanted_budget(const slanted *s, const dp_triangles *class, dp_budget *out) {
    dp_spec spec = s->setup.spec;
    dp_setup setup;
    spec.triangles = *class;
    if (s->world.scheme != NULL && dp_setup_init(&setup, &spec) == DP_OK) {
        const world_asked a = {.setup = &setup,
                               .z = s->z - s->world.shift[2],
                               .ray_ratio = s->world.ray_ratio,
                               .shared_origin = s->world.shared_origin};
        dp_budget_terms terms = {0};
        return world_budget(s->world.scheme, &a, s->world.distance, &terms, out) == DP_OK;
    }
    return dp_setup_init(&setup, &spec) == DP_OK && dp_budget_at(&setup, s->z, &s->world.terms, out) == DP_OK;
}

bool slanted_apart(slanted *s, double share, dp_budget *guarantee, double *nearer) {
    double c[2] = {s->c, s->c};
    if (!slanted_fit(s, c))
        return false;
    const double class = s->class.depth *= 1.05;
    if (!slanted_budget(s, &s->class, guarantee))
        return false;
    *nearer = c[0] = s->c - share * guarantee->separation;
    if (!(c[0] > 0.0) || !slanted_fit(s, c) || s->class.depth > class)
        return false;
    s->class.depth = class;
    return true;
}

/* ---- Where they are in the world --------------------------------------------------------------------------------- */

/* The rows of a rotation, the last one along the view axis. */
static void draw_rotation(rng *r, double v[3][3]) {
    double length;
    do {
        length = 0.0;
        for (int k = 0; k < 6; k++)
            v[1 + k / 3][k % 3] = rng_uniform(r, -1.0, 1.0);
        for (int k = 0; k < 3; k++)
            length += v[2][k] * v[2][k];
        const double dot = v[1][0] * v[2][0] + v[1][1] * v[2][1] + v[1][2] * v[2][2];
        for (int k = 0; k < 3; k++)
            v[1][k] -= dot / length * v[2][k];
        for (int k = 0; k < 3; k++)
            v[0][k] = v[1][(k + 1) % 3] * v[2][(k + 2) % 3] - v[1][(k + 2) % 3] * v[2][(k + 1) % 3];
    } while (length < 0.1 || v[0][0] * v[0][0] + v[0][1] * v[0][1] + v[0][2] * v[0][2] < 0.01);
    for (int i = 0; i < 3; i++) {
        const double by = 1.0 / sqrt(v[i][0] * v[i][0] + v[i][1] * v[i][1] + v[i][2] * v[i][2]);
        for (int k = 0; k < 3; k++)
            v[i][k] *= by;
    }
}

/* Entry k of the row of an axis: its direction, or what the camera's place makes of it. */
static void compose(slanted *s, const double v[3][3]) {
    const slanted_camera *c = &s->camera;
    slanted_world *w = &s->world;
    const float scale[2] = {c->p00, c->p11};
    const dp_composition how = w->terms.composition;
    const double n = s->setup.spec.znear, f = s->setup.spec.zfar;
    const double a = s->setup.reversed ? (isinf(f) ? 0.0 : -n / (f - n)) : isinf(f) ? 1.0 : f / (f - n);
    const double b = (s->setup.reversed ? 1.0 : -1.0) * (isinf(f) ? n : n * f / (f - n));
    for (int axis = 0; axis < 3; axis++) {
        double view[4] = {v[axis][0], v[axis][1], v[axis][2], 0.0};
        for (int k = 0; k < 3 && how != DP_COMPOSITION_RELATIVE; k++)
            view[3] -= v[axis][k] * w->eye[k];
        for (int k = 0; k < 4; k++) {
            const float entry = (float)view[k], product = c->a * entry;
            if (axis < 2)
                w->row[axis][k] =
                    how == DP_COMPOSITION_PRODUCTS ? scale[axis] * entry : (float)((double)scale[axis] * view[k]);
            else if (how == DP_COMPOSITION_PRODUCTS)
                w->row[2][k] = k < 3 ? product : product + c->b;
            else
                w->row[2][k] = (float)(a * view[k] + (k < 3 ? 0.0 : b));
            if (axis == 2)
                w->row[3][k] = entry;
        }
    }
}

void slanted_draw_world(rng *r, slanted *s) {
    slanted_world *w = &s->world;
    double v[3][3];
    w->terms.world = s->z * rng_log(r, 1.0, 1e5);
    w->terms.composition = (dp_composition)rng_below(r, DP_COMPOSITION_COUNT);
    w->paired = rng_below(r, 2) == 0;
    w->fused = dp_arith_get(s->setup.spec.arith)->fused;
    for (int k = 0; k < 4; k++)
        w->order[k] = k;
    for (int k = 3; k > 0; k--) {
        const int other = (int)rng_below(r, (uint64_t)k + 1), kept = w->order[k];
        w->order[k] = w->order[other];
        w->order[other] = kept;
    }
    for (int k = 0; k < 3; k++)
        w->eye[k] = rng_uniform(r, -1.0, 1.0) * w->terms.world;
    draw_rotation(r, v);
    compose(s, (const double(*)[3])v);
}

bool slanted_is_moved(const slanted *s) {
    return s->world.terms.world > 0.0 || s->world.scheme != NULL;
}

/* The place in the world that is seen there but for what it is moved by. */
static world_place place_seen_at(const slanted *s, int which, const double seen[3]) {
    const slanted_world *w = &s->world;
    world_place place;
    memcpy(place.origin, w->origin[which], sizeof place.origin);
    for (int i = 0; i < 3; i++) {
        long double at = (long double)w->seen_by.eye[i] - (long double)place.origin[i];
        for (int k = 0; k < 3; k++)
            at += (long double)w->seen_by.axis[k][i] * ((long double)seen[k] - (long double)w->shift[k]);
        place.local[i] = (double)at;
    }
    return place;
}

bool slanted_draw_scheme(rng *r, slanted *s, const world_scheme *scheme) {
    slanted_world *w = &s->world;
    const double part = (rng_below(r, 2) == 0 ? rng_log(r, 1e2, 1e7) : rng_log(r, 2e5, 2e6)) * s->z / sqrt(3.0);
    double ray[3], seen[3];
    float got[3];
    long double want[3];
    ray_of(s, s->px, s->py, ray);
    *w = (slanted_world){.scheme = scheme, .distance = part * sqrt(3.0), .shared_origin = rng_below(r, 2) == 0};
    w->seen_by.order = (unsigned)rng_below(r, WORLD_ORDERS);
    w->seen_by.fused = rng_below(r, 2) == 0;
    draw_rotation(r, w->seen_by.axis);
    for (int i = 0; i < 3; i++) {
        w->seen_by.eye[i] = rng_uniform(r, -part, part);
        seen[i] = ray[i] * s->z;
    }
    for (int i = 0; i < 6; i++)
        w->origin[i / 3][i % 3] = w->seen_by.eye[i % 3] + 0.2 * s->z * rng_uniform(r, -1.0, 1.0);
    if (w->shared_origin)
        memcpy(w->origin[0], w->origin[1], sizeof w->origin[0]);
    const world_place place = place_seen_at(s, 1, seen);
    world_view(scheme, &w->seen_by, &place, got);
    world_exact(&w->seen_by, &place, want);
    for (int k = 0; k < 3; k++)
        w->shift[k] = (double)((long double)got[k] - want[k]);
    const double z = s->z - w->shift[2], tangent = tan(s->class.fov_y * pi / 360.0) / s->camera.height;
    w->ray_ratio = fmax(2.0, hypot(1.0, tangent * hypot(s->camera.width + 800.0, s->camera.height + 800.0)));
    return z > s->setup.spec.znear && z < s->setup.spec.zfar;
}

static float multiply_add(bool fused, float x, float y, float sum) {
    const float product = x * y;
    return fused ? fmaf(x, y, sum) : product + sum;
}

static float row_times(const slanted_world *w, int row, const float p[4]) {
    const int *o = w->order;
    const float *m = w->row[row];
    const float first = multiply_add(w->fused, m[o[1]], p[o[1]], m[o[0]] * p[o[0]]);
    if (w->paired)
        return first + multiply_add(w->fused, m[o[3]], p[o[3]], m[o[2]] * p[o[2]]);
    return multiply_add(w->fused, m[o[3]], p[o[3]], multiply_add(w->fused, m[o[2]], p[o[2]], first));
}

/* The place that the rounded rows of clip x, y and w send to these: by Cramer's rule. False: outside the world. */
static bool place_of(const slanted_world *w, const double at[3], float place[4]) {
    static const int rows[] = {0, 1, 3};
    long double m[3][3], rest[3], p[3];
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++)
            m[i][k] = (long double)w->row[rows[i]][k];
        rest[i] = (long double)at[i] - (long double)w->row[rows[i]][3];
    }
    long double all = 0.0L;
    for (int k = 0; k < 3; k++)
        all += m[0][k] * (m[1][(k + 1) % 3] * m[2][(k + 2) % 3] - m[1][(k + 2) % 3] * m[2][(k + 1) % 3]);
    for (int k = 0; k < 3; k++) {
        const int x = (k + 1) % 3, y = (k + 2) % 3;
        p[k] = (rest[0] * (m[1][x] * m[2][y] - m[1][y] * m[2][x]) - rest[1] * (m[0][x] * m[2][y] - m[0][y] * m[2][x]) +
                rest[2] * (m[0][x] * m[1][y] - m[0][y] * m[1][x])) /
               all;
        const bool relative = w->terms.composition == DP_COMPOSITION_RELATIVE;
        if (!(fabs((double)p[k] + (relative ? w->eye[k] : 0.0)) <= w->terms.world))
            return false;
        place[k] = (float)p[k];
    }
    place[3] = 1.0F;
    return true;
}

/* ---- What is drawn of them --------------------------------------------------------------------------------------- */

/* Real places, rounded to binary32 and transformed. */
bool slanted_clip(const slanted *s, int which, double c, raster_vertex clip[3]) {
    const slanted_camera *of = &s->camera;
    for (int i = 0; i < 3; i++) {
        const double *at = s->at[which][i];
        const double z = c / slanted_along(s, at[0], at[1]);
        double ray[3];
        if (!(z >= s->setup.spec.znear && z <= s->setup.spec.zfar))
            return false;
        ray_of(s, at[0], at[1], ray);
        if (s->world.terms.world > 0.0) {
            const double to[3] = {ray[0] * z * (double)of->p00, ray[1] * z * (double)of->p11, z};
            float p[4];
            if (!place_of(&s->world, to, p))
                return false;
            clip[i] = (raster_vertex){row_times(&s->world, 0, p), row_times(&s->world, 1, p),
                                      row_times(&s->world, 2, p), row_times(&s->world, 3, p)};
            if (!(clip[i].w > 0.0F))
                return false;
            continue;
        }
        float place[3] = {(float)(ray[0] * z), (float)(ray[1] * z), (float)z};
        if (s->world.scheme != NULL) {
            const world_place in_world = place_seen_at(s, which, (const double[3]){ray[0] * z, ray[1] * z, z});
            const double *shift = s->world.shift, real = z - shift[2];
            if (!(hypot(hypot(ray[0] * z - shift[0], ray[1] * z - shift[1]), real) <= s->world.ray_ratio * real))
                return false;
            world_view(s->world.scheme, &s->world.seen_by, &in_world, place);
            if (!(place[2] > 0.0F))
                return false;
        }
        const float product = of->a * place[2];
        clip[i] = (raster_vertex){of->p00 * place[0], of->p11 * place[1], product + of->b, place[2]};
    }
    return true;
}

bool slanted_inside(const raster_vertex v[3]) {
    bool inside = slanted_in_depth(v);
    for (int i = 0; i < 3; i++)
        inside = inside && fabsf(v[i].x) <= v[i].w && fabsf(v[i].y) <= v[i].w;
    return inside;
}

bool slanted_in_depth(const raster_vertex v[3]) {
    bool inside = true;
    for (int i = 0; i < 3; i++)
        inside = inside && v[i].z >= 0.0F && v[i].z <= v[i].w;
    return inside;
}

double slanted_height(const double v[3][2]) {
    const double area = fabs((v[1][0] - v[0][0]) * (v[2][1] - v[0][1]) - (v[2][0] - v[0][0]) * (v[1][1] - v[0][1]));
    double longest = 0.0;
    for (int i = 0; i < 3; i++)
        longest = fmax(longest, hypot(v[(i + 1) % 3][0] - v[i][0], v[(i + 1) % 3][1] - v[i][1]));
    return area / longest;
}
