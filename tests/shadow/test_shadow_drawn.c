/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The biases of src/shadow on shadow maps that the models of src/raster draw: random lights, maps, filters, positions
 * in the world; planes at random slants, and spheres made of triangles. A point of the surface is put where a texel is
 * read that was drawn as far away as can be; its place is rounded, moved along the normal, transformed and looked up in
 * binary32. With the bias said to be enough it is lit. With 95 % of it (spheres 90 %) some point is not, wherever slope
 * times filter radius is 90 % of the bias or more; elsewhere the share of it that is used is printed. Behind a caster
 * beyond the gap and what is needed it is dark.
 */
#include "raster_named.h"
#include "shadow_stage.h"

static const double pi = 3.14159265358979323846;

/* ---- Surfaces ---------------------------------------------------------------------------------------------------- */

/* The surface of one light: a plane at a slope, or a sphere, a ring of which has it. Steepest at the azimuth. */
typedef struct plan {
    double slope, azimuth, z;             /* of the surface */
    double size, thin, turned, slants[3]; /* of a plane's triangles */
    bool sphere;
    double radius, step; /* of the sphere, and between rings and meridians, radians */
    int ring;
} plan;

/* The plane's depth at x, y when it is z at x0, y0. */
static double plane_at(const plan *p, const double at[3], double x, double y) {
    return at[2] + p->slope * (cos(p->azimuth) * (x - at[0]) + sin(p->azimuth) * (y - at[1]));
}

/* A triangle of the plane about the texel; its vertices where the grid moves them away from the light's depth. */
static void place_plane(rng *r, shadow_stage *s, const plan *p, const double centre[3]) {
    const int bits = s->light.triangles.subpixel;
    const bool badly = bits > 0 && rng_below(r, 4) != 0;
    const double du = rng_uniform(r, -0.2, 0.2) * p->size, dv = rng_uniform(r, -0.2, 0.2) * p->size;
    for (int i = 0; i < 3; i++) {
        const double angle = 2.0 * pi / 3.0 * i + p->slants[i];
        const double a = p->size * cos(angle), b = p->size * p->thin * sin(angle);
        double at[2] = {s->px + 0.5 + du + a * cos(p->turned) - b * sin(p->turned),
                        s->py + 0.5 + dv + a * sin(p->turned) + b * cos(p->turned)};
        const double way[2] = {cos(p->azimuth), sin(p->azimuth)};
        if (badly)
            for (int k = 0; k < 2; k++)
                at[k] = ldexp(rint(ldexp(at[k], bits)) + (way[k] > 0 ? -0.48 : 0.48), -bits);
        shadow_stage_place(s, at[0], at[1], &s->caster[i][0], &s->caster[i][1]);
        s->caster[i][2] = plane_at(p, centre, s->caster[i][0], s->caster[i][1]);
    }
}

/* A vertex of the sphere, which looks at the light with its pole. */
static void sphere_vertex(const plan *p, const double centre[3], int ring, int meridian, double out[3]) {
    const double polar = ring * p->step, around = p->azimuth + (meridian - 0.5) * p->step;
    out[0] = centre[0] + p->radius * sin(polar) * cos(around);
    out[1] = centre[1] + p->radius * sin(polar) * sin(around);
    out[2] = centre[2] - p->radius * cos(polar);
}

static bool facet_normal(const double v[3][3], double n[3]) {
    double a[3], b[3];
    for (int i = 0; i < 3; i++) {
        a[i] = v[1][i] - v[0][i];
        b[i] = v[2][i] - v[0][i];
    }
    for (int i = 0; i < 3; i++)
        n[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
    const double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]) * (n[2] > 0 ? -1.0 : 1.0);
    for (int i = 0; i < 3; i++)
        n[i] /= length;
    return n[2] != 0.0;
}

/* The weights of a place seen from the light; whether it lies in the triangle. */
static bool weights(const double v[3][3], double x, double y, double w[3]) {
    const double ax = v[1][0] - v[0][0], ay = v[1][1] - v[0][1], bx = v[2][0] - v[0][0], by = v[2][1] - v[0][1];
    const double area = ax * by - ay * bx;
    w[1] = ((x - v[0][0]) * by - (y - v[0][1]) * bx) / area;
    w[2] = (ax * (y - v[0][1]) - ay * (x - v[0][0])) / area;
    w[0] = 1.0 - w[1] - w[2];
    return w[0] >= 0.0 && w[1] >= 0.0 && w[2] >= 0.0;
}

static void facet(const plan *p, const double centre[3], int ring, int meridian, int half, double v[3][3]) {
    sphere_vertex(p, centre, ring, meridian, v[0]);
    sphere_vertex(p, centre, ring + 1, meridian + 1, v[1]);
    sphere_vertex(p, centre, ring + half, meridian + 1 - half, v[2]);
}

/* The facet of the sphere that is seen at x, y; false at the pole and beyond the steepest ring. */
static bool find_facet(const plan *p, const double centre[3], double x, double y, double v[3][3]) {
    const double from = hypot(x - centre[0], y - centre[1]) / p->radius;
    if (!(from < 1.0))
        return false;
    const int ring = (int)floor(asin(from) / p->step);
    const double around = remainder(atan2(y - centre[1], x - centre[0]) - p->azimuth, 2.0 * pi);
    const int meridian = (int)floor(around / p->step + 0.5);
    for (int i = -1; i <= 1; i++)
        for (int k = -1; k <= 1; k++)
            for (int half = 0; half < 2; half++) {
                double w[3];
                if (ring + i < 2 || ring + i > p->ring)
                    continue;
                facet(p, centre, ring + i, meridian + k, half, v);
                if (weights((const double(*)[3])v, x, y, w))
                    return true;
            }
    return false;
}

/* ---- A light at random ------------------------------------------------------------------------------------------- */

static const struct {
    const char *name, *arith;
    dp_anchor anchor;
} kinds[] = {{"llvmpipe", "mesa", DP_ANCHOR_ORIGIN},
             {"lavapipe", "mesa", DP_ANCHOR_ORIGIN},
             {"softpipe", "softpipe", DP_ANCHOR_ORIGIN_STEPPED},
             {"swiftshader", "mesa", DP_ANCHOR_VERTEX}};
static const char *const format_names[] = {"fp32", "unorm24", "unorm16"};

enum {
    KINDS = sizeof kinds / sizeof kinds[0],
    FORMATS = sizeof format_names / sizeof format_names[0],
    TRIED = 24,
    MOST = 600
};

/* SwiftShader has no D24; the 16-bit codes of softpipe are stepped, and promise nothing. */
static bool has_format(int kind, int format) {
    return !(format == 1 && strcmp(kinds[kind].name, "swiftshader") == 0) &&
           !(format == 2 && strcmp(kinds[kind].name, "softpipe") == 0);
}

static void draw_light(rng *r, shadow_stage *s, int kind, int format, bool wide) {
    static const double kernels[] = {0.5, 0.5, 1.0, 1.5, 2.0, 3.5};
    dp_spec spec = dp_spec_default();
    dp_format found[2];
    const int size = (int)rng_log(r, 64.0, 4096.0);
    assert_int_equal(dp_format_parse(format_names[format], found), 1);
    assert_int_equal(dp_arith_parse(kinds[kind].arith, &spec.arith), DP_OK);
    s->name = kinds[kind].name;
    s->light = shadow_light_default();
    s->target = target_of(s->name, format_names[format], size, size, dp_path_best());
    s->light.width = s->light.height = rng_log(r, 0.1, 1000.0);
    spec.format = found[0];
    spec.mapping = rng_below(r, 2) ? DP_MAPPING_REVERSED : DP_MAPPING_D3D;
    spec.ortho = 1;
    spec.znear = rng_below(r, 2) ? 0.0 : rng_uniform(r, -10.0, 10.0);
    spec.zfar = spec.znear + s->light.width * rng_log(r, 0.3, 30.0);
    assert_int_equal(dp_setup_init(&s->light.setup, &spec), DP_OK);
    s->n = spec.znear;
    s->f = spec.zfar;
    s->light.kernel = kernels[rng_below(r, 6)];
    s->light.subtexel = rng_below(r, 4) == 0 ? 0 : rng_below(r, 4) == 0 ? 4 : 8;
    s->light.triangles.width = s->light.triangles.height = size;
    s->light.triangles.plane = dp_anchor_get(kinds[kind].anchor)->plane;
    s->light.triangles.subpixel = s->target.row->plane_bits;
    s->light.receiver_lo = s->n;
    s->light.receiver_hi = s->f;
    s->fused = rng_below(r, 2);
    s->in_shader = rng_below(r, 3) == 0;
    shadow_stage_turn(r, s->axis);
    const double half = 0.5 * hypot(hypot(s->light.width, s->light.height), s->f - s->n);
    const double world = wide ? s->light.width * rng_log(r, 1.0, 300.0) : 0.0;
    for (int i = 0; i < 3; i++) {
        s->middle[i] = rng_uniform(r, -world, world);
        if (wide)
            s->light.world = fmax(s->light.world, fabs(s->middle[i]) + half);
    }
    shadow_stage_matrix(s);
}

/* The class is that of the triangle, as the grid moves it. False where there is none. */
static bool fit_class(shadow_stage *s) {
    dp_triangles *t = &s->light.triangles;
    double at[3][2], lo[2] = {INFINITY, INFINITY}, hi[2] = {-INFINITY, -INFINITY}, longest = 0.0;
    for (int i = 0; i < 3; i++) {
        at[i][0] = (s->caster[i][0] / s->light.width + 0.5) * s->target.width;
        at[i][1] = (s->caster[i][1] / s->light.height + 0.5) * s->target.height;
        for (int k = 0; k < 2; k++) {
            if (t->subpixel > 0)
                at[i][k] = ldexp(rint(ldexp(at[i][k], t->subpixel)), -t->subpixel);
            lo[k] = fmin(lo[k], at[i][k]);
            hi[k] = fmax(hi[k], at[i][k]);
        }
    }
    for (int i = 0; i < 3; i++)
        longest = fmax(longest, hypot(at[(i + 1) % 3][0] - at[i][0], at[(i + 1) % 3][1] - at[i][1]));
    const double area =
        fabs((at[1][0] - at[0][0]) * (at[2][1] - at[0][1]) - (at[2][0] - at[0][0]) * (at[1][1] - at[0][1]));
    t->pixels = fmax(fmax(t->pixels, 1.0), fmax(hi[0] - lo[0], hi[1] - lo[1]) * (1.0 + 1e-3));
    t->slim = fmax(fmax(t->slim, 2.0), longest * longest / area * (1.0 + 1e-3));
    s->light.small = fmin(s->light.small, area / longest * (1.0 - 1e-3));
    return t->slim <= 1024.0 && s->light.small >= 0x1p-8;
}

static void draw_plan(rng *r, shadow_stage *s, plan *p, bool sphere) {
    *p = (plan){.sphere = sphere};
    const uint64_t which = rng_below(r, 6); /* steep; so flat that positions decide how it is drawn; any */
    p->slope = tan((which < 2               ? rng_uniform(r, 60.0, 85.0)
                    : which == 2 && !sphere ? rng_log(r, 0.01, 1.0)
                                            : rng_uniform(r, 1.0, 80.0)) *
                   pi / 180.0);
    p->azimuth = rng_below(r, 4) != 0 ? pi / 4.0 * (double)(2 * rng_below(r, 4) + 1) : rng_uniform(r, -pi, pi);
    p->size = rng_log(r, 2.0, 0.25 * s->target.width);
    p->thin = rng_below(r, 2) ? 1.0 : rng_log(r, 0.1, 1.0);
    p->turned = rng_uniform(r, 0.0, 2.0 * pi);
    for (int i = 0; i < 3; i++)
        p->slants[i] = rng_uniform(r, -0.5, 0.5);
    s->px = (int)(s->target.width * rng_uniform(r, 0.3, 0.7));
    s->py = (int)(s->target.height * rng_uniform(r, 0.3, 0.7));
    p->z = s->n + (s->f - s->n) * rng_uniform(r, 0.2, 0.6);
    if (!sphere)
        return;
    p->step = 0.5 * pi / rng_log(r, 10.0, 3000.0);
    p->ring = (int)(rng_uniform(r, 0.2, 0.92) * 0.5 * pi / p->step);
    p->radius = s->light.width / s->target.width * rng_log(r, 10.0, 10000.0);
}

/* ---- Trials ------------------------------------------------------------------------------------------------------ */

/* Where the point is looked up, texels from the texel's centre: at the side where it lies deepest, or anywhere. */
static void aim(rng *r, const shadow_stage *s, const double down[2], double off[2]) {
    const double step = s->light.subtexel > 0 ? ldexp(1.0, -s->light.subtexel) : 0.0;
    const bool edge = rng_below(r, 8) != 0;
    const double inside = rng_below(r, 2) ? 0.0 : rng_unit(r) * 0.03;
    for (int k = 0; k < 2; k++) {
        const double reach = s->light.kernel + 0.59 * step;
        off[k] = edge ? (down[k] < 0 ? -1.0 : 1.0) * (reach - inside) : rng_uniform(r, -reach, reach);
    }
}

/* The surface at the texel and at the point that is looked up there with an offset of `moved` along the normal. */
static bool set(rng *r, shadow_stage *s, const plan *p, const double off[2], double moved, shadow_spot *point) {
    double x, y, w[3], v[3][3];
    const double z = p->z + rng_unit(r) * 1e-3 * (s->f - s->n); /* anywhere between two codes */
    shadow_stage_place(s, s->px + 0.5 + off[0], s->py + 0.5 + off[1], &x, &y);
    if (!p->sphere) {
        const double q = hypot(1.0, p->slope);
        const double normal[3] = {p->slope * cos(p->azimuth) / q, p->slope * sin(p->azimuth) / q, -1.0 / q};
        double centre[3] = {0, 0, z};
        shadow_stage_place(s, s->px + 0.5, s->py + 0.5, &centre[0], &centre[1]);
        memcpy(point->normal, normal, sizeof normal);
        point->at[0] = x - moved * normal[0];
        point->at[1] = y - moved * normal[1];
        point->at[2] = plane_at(p, centre, point->at[0], point->at[1]);
        place_plane(r, s, p, centre);
        return true;
    }
    /* The point lies on the ring; the sphere's centre follows. */
    double at[3] = {0}, centre[3];
    const double mix[3] = {rng_unit(r), rng_unit(r), rng_unit(r)}, sum = mix[0] + mix[1] + mix[2];
    facet(p, at, p->ring, 0, (int)rng_below(r, 2), v);
    for (int i = 0; i < 3; i++)
        point->at[i] = (mix[0] * v[0][i] + mix[1] * v[1][i] + mix[2] * v[2][i]) / sum;
    if (!facet_normal((const double(*)[3])v, point->normal))
        return false;
    centre[0] = x - moved * point->normal[0] - point->at[0];
    centre[1] = y - moved * point->normal[1] - point->at[1];
    centre[2] = z - point->at[2];
    for (int i = 0; i < 3; i++)
        point->at[i] += centre[i];
    shadow_stage_place(s, s->px + 0.5, s->py + 0.5, &x, &y);
    return find_facet(p, centre, x, y, s->caster) && weights((const double(*)[3])s->caster, x, y, w);
}

/* The steepest slant of what was drawn, degrees; of a sphere its ring's. */
static double slant_of(const plan *p) {
    double v[3][3], n[3], at[3] = {0};
    if (!p->sphere)
        return atan(p->slope) * 180.0 / pi;
    facet(p, at, p->ring, 0, 0, v);
    (void)facet_normal((const double(*)[3])v, n);
    return acos(-n[2]) * 180.0 / pi;
}

typedef struct outcome {
    double used[SHADOW_WAY_COUNT]; /* the largest share of the bias with which a point was dark */
    uint64_t judged[SHADOW_WAY_COUNT], points;
} outcome;

static bool lit_at(const rng *r, shadow_stage *s, const plan *p, const double off[2], shadow_way way, double share,
                   const bias_api *api, bool *judged) {
    const double sine = sin(s->light.triangles.slant_hi * pi / 180.0);
    rng same = *r;
    shadow_spot point;
    float depth, slope;
    *judged =
        set(&same, s, p, off, share * s->need.bias[way].offset * sine, &point) && shadow_stage_draw(s, &depth, &slope);
    return *judged && shadow_stage_lit(s, way, share, api, &point, depth, slope, judged);
}

/* Beyond the gap and what is needed, a parallel caster's shadow is certain: texels are read at the far side here. */
static void judge_caster(const rng *r, shadow_stage *s, const plan *p, const double off[2], shadow_way way, tally *t) {
    const double away[2] = {-off[0], -off[1]};
    bool judged;
    s->raised = (s->need.bias[way].gap_light + s->need.bias[SHADOW_CONSTANT].window * (s->f - s->n)) * (1.0 + 1e-6);
    const bool light = lit_at(r, s, p, away, way, 1.0, NULL, &judged);
    s->raised = 0.0;
    if (judged)
        TALLY(t, !light, "%s %s %s: %d texels, kernel %g, slant %.17g", s->name, s->light.setup.spec.format.name,
              shadow_way_name(way), s->target.width, s->light.kernel, s->light.triangles.slant_hi);
}

/* One point: lit with the bias itself; and the largest share with which it is dark. */
static void judge(rng *r, shadow_stage *s, const plan *p, double least, tally t[2], outcome *o) {
    const double down[2] = {cos(p->azimuth), sin(p->azimuth)};
    for (shadow_way way = 0; way < SHADOW_WAY_COUNT; way++) {
        double off[2], lo = 0.0, hi = 1.0;
        bool judged;
        if (!isfinite(s->need.bias[way].factor))
            continue;
        const bias_api *api = bias_api_get(rng_below(r, 13)); /* or none */
        aim(r, s, down, off);
        const bool light = lit_at(r, s, p, off, way, 1.0, api, &judged);
        if (judged)
            TALLY(t, light, "%s %s %s %s: %d texels, kernel %g, %d bits, slant %.17g, box %g x %g, share %g", s->name,
                  s->light.setup.spec.format.name, shadow_way_name(way), api != NULL ? api->name : "", s->target.width,
                  s->light.kernel, s->light.subtexel, s->light.triangles.slant_hi, s->light.width, s->f - s->n,
                  s->need.bias[way].share);
        if (!p->sphere)
            judge_caster(r, s, p, off, way, &t[1]);
        for (int i = 0; judged && i < 8; i++) {
            const double share = i == 0 ? least : 0.5 * (lo + hi);
            *(lit_at(r, s, p, off, way, share, NULL, &judged) ? &hi : &lo) = share;
        }
        if (judged) {
            o->judged[way]++;
            o->used[way] = fmax(o->used[way], lo);
        }
        (void)rng_next(r);
    }
}

/* The class is that of the triangles drawn; false where the light's box is too small for the bias. */
static bool fits(rng *r, shadow_stage *s, const plan *p) {
    s->light.triangles.pixels = 1.0;
    s->light.triangles.slim = 2.0;
    s->light.small = 65536.0;
    for (int i = 0; i < TRIED; i++) {
        const double down[2] = {cos(p->azimuth), sin(p->azimuth)};
        double off[2];
        shadow_spot point;
        aim(r, s, down, off);
        if (set(r, s, p, off, 0.0, &point) && !fit_class(s))
            return false;
    }
    s->light.triangles.slim *= 1.1;
    s->light.triangles.pixels *= 1.1;
    s->light.small /= 1.1;
    s->light.triangles.slant_hi = slant_of(p) + 1e-7;
    if (p->sphere) {
        s->light.radius = p->radius;
        s->light.facet = p->radius * p->step; /* more than half the diagonal of a cell */
    }
    if (shadow_light_check(&s->light) != SHADOW_OK)
        return false;
    shadow_need_of(&s->light, &s->need);
    for (int way = 0; way < SHADOW_WAY_COUNT; way++)
        if (isfinite(s->need.bias[way].factor) && !(p->z + 2.0 * s->need.bias[way].gap_light <= s->f))
            return false;
    s->light.receiver_lo = fmax(p->z - s->need.bias[SHADOW_CONSTANT].gap_light, s->n);
    s->light.receiver_hi = p->z + 1e-3 * (s->f - s->n) + s->need.bias[SHADOW_CONSTANT].gap_light;
    return true;
}

/*
 * Whether the bias has to be within some percent of the least one: slope times filter radius is 90 % of it, and what
 * random points can hardly reach, worst roundings of positions, planes and sines, and triangles worst for their slope,
 * 3 %. With a constant bias a sphere falls behind its tangent: little, too.
 */
static bool is_tight(const shadow_stage *s, const plan *p, shadow_way way) {
    const shadow_need *need = &s->need;
    const double slant = s->light.triangles.slant_hi, slope = need->slope;
    const double across = s->light.kernel * hypot(need->texel_x, need->texel_y);
    const double loose = shadow_part_at(&s->light, &need->part[SHADOW_CAUSE_POSITION], slant) +
                         shadow_part_at(&s->light, &need->part[SHADOW_CAUSE_SETUP], slant);
    const double small = way == SHADOW_SLOPE ? need->bias[way].factor / (2.0 * need->texels) - 1.0 : 0.0;
    const double beside = way == SHADOW_CONSTANT ? 0.0 : need->bias[way].window - need->window;
    const double falls = p->sphere ? across * pow(1.0 + slope * slope, 1.5) / (p->radius * slope) : 0.0;
    const bool diagonal = fabs(fabs(cos(p->azimuth)) - fabs(sin(p->azimuth))) < 1e-6;
    return diagonal && need->bias[way].share >= 0.9 && falls <= 0.06 &&
           (loose + beside) * (s->f - s->n) / (across * slope) + small <= 0.03;
}

static bool is_used(const shadow_stage *s, const plan *p, const outcome *o, shadow_way way, double least) {
    return o->used[way] >= least || !is_tight(s, p, way);
}

/* One light: points on its surface, and more of them until some is dark with `least` of each bias that is tight. */
static outcome judge_light(rng *r, shadow_stage *s, const plan *p, double least, tally t[2]) {
    outcome o = {0};
    for (int i = 0; i < MOST; i++) {
        bool all = i >= TRIED;
        for (shadow_way way = 0; way < SHADOW_WAY_COUNT; way++)
            all = all && is_used(s, p, &o, way, least);
        if (all)
            break;
        judge(r, s, p, least, t, &o);
        o.points++;
    }
    return o;
}

static void test_surfaces(bool sphere) {
    const double least = sphere ? 0.9 : 0.95;
    tally t[] = {{.name = "points lit at the bias"}, {.name = "points dark beyond the gap"}};
    tally tight = {.name = "points dark just below the bias"};
    rng r = rng_make(sphere ? "shadows on spheres" : "shadows on planes");
    for (int kind = 0; kind < KINDS; kind++)
        for (int format = 0; format < FORMATS; format++) {
            double used[SHADOW_WAY_COUNT] = {0};
            uint64_t lights = 0, points = 0;
            for (uint64_t n = has_format(kind, format) ? test_cases(6, 100, 20000) : 0; n > 0; n--) {
                shadow_stage s = {0};
                plan p;
                draw_light(&r, &s, kind, format, rng_below(&r, 2));
                draw_plan(&r, &s, &p, sphere);
                if (!fits(&r, &s, &p))
                    continue;
                const outcome o = judge_light(&r, &s, &p, least, t);
                if (o.judged[SHADOW_CONSTANT] < TRIED / 2)
                    continue;
                lights++;
                for (shadow_way way = 0; way < SHADOW_WAY_COUNT; way++) {
                    points += o.judged[way];
                    used[way] += o.used[way];
                    if (o.judged[way] >= o.points / 2 && is_tight(&s, &p, way))
                        TALLY(&tight, is_used(&s, &p, &o, way, least),
                              "%s %s %s: used %.3f, share %.3f; %d texels, kernel %g, %d bits, slant %.17g", s.name,
                              format_names[format], shadow_way_name(way), o.used[way], s.need.bias[way].share,
                              s.target.width, s.light.kernel, s.light.subtexel, s.light.triangles.slant_hi);
                }
            }
            if (lights > 0)
                print_message("# %s %s: %llu lights, %llu points; of the bias is used, constant %.2f, slope-scaled "
                              "%.2f, normal offset %.2f\n",
                              kinds[kind].name, format_names[format], (unsigned long long)lights,
                              (unsigned long long)points, used[0] / (double)lights, used[1] / (double)lights,
                              used[2] / (double)lights);
        }
    print_message("# %llu biases within %.0f %%\n", (unsigned long long)tight.cases, 100.0 * (1.0 - least));
    tally_end(&t[0]);
    if (!sphere)
        tally_end(&t[1]);
    tally_end(&tight);
}

TEST(test_planes) {
    test_surfaces(false);
}

TEST(test_spheres) {
    test_surfaces(true);
}
