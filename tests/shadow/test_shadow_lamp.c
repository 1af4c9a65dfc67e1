/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Lights that have a place. The need of a filter by hand; as rationals of GMP over random planes, lights and texels it
 * is never above what is said, and climbing finds planes that need 0.9 of it or more; the same of distances by MPFR. A
 * point that is moved along the normal by the offset said is in front of every texel of its filter, and by 0.9 of it
 * not always; across the seams of a cube, too. Gaps are not exceeded. What is refused.
 */
#include <gmp.h>
#include <mpfr.h>

#include "shadow/shadow.h"
#include "support.h"

static const double pi = 3.14159265358979323846;
enum { BITS = 256 };

static shadow_light lamp_of(double fov, double znear, double zfar, int size, const char *format, bool distance) {
    shadow_light light = shadow_light_default();
    dp_spec spec = dp_spec_default();
    dp_format found[2];
    assert_int_equal(dp_format_parse(format, found), 1);
    light.kind = SHADOW_SPOT;
    light.fov = fov;
    spec.znear = znear;
    spec.zfar = zfar;
    spec.ortho = distance;
    spec.format = found[0];
    assert_int_equal(dp_setup_init(&light.setup, &spec), DP_OK);
    light.triangles.width = light.triangles.height = size;
    light.receiver_lo = znear;
    light.receiver_hi = isinf(zfar) ? 1e3 * znear : zfar;
    return light;
}

/* D16, near .1, far 3, 90 degrees, 512 texels, nearest: half a texel of a plane at 45 degrees on the axis, steepest
 * along a row of texels, is z/512, and a step of the format at z is z^2 (1/n - 1/f)/65535. */
TEST(by_hand) {
    static const double rows[][2] = {{1.0, 13.2}, {0.5, 26.5}, {3.0, 4.4}};
    shadow_light light = lamp_of(90.0, 0.1, 3.0, 512, "unorm16", false);
    tally t = {.name = "codes"};
    light.triangles.slant_hi = 45.0;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const double z = rows[i][0], normal[3] = {sqrt(0.5), 0.0, sqrt(0.5)};
        const double codes = 65535.0 * shadow_plane_needs(&light, normal, z * sqrt(0.5));
        shadow_need need;
        light.receiver_lo = light.receiver_hi = z;
        assert_int_equal(shadow_light_check(&light), SHADOW_OK);
        shadow_need_of(&light, &need);
        const double any = 65535.0 * shadow_part_at(&light, &need.part[SHADOW_CAUSE_TEXEL], 45.0);
        TALLY(&t, fabs(codes - rows[i][1]) < 0.05, "at %g: %g", z, codes);
        /* At any place and azimuth (tan 45 + 1/cos 45)/sqrt 2 as much. */
        TALLY(&t, fabs(any / codes - (1.0 + sqrt(2.0)) / sqrt(2.0)) < 1e-4, "at %g: any plane %g", z, any);
        TALLY(&t, need.part[SHADOW_CAUSE_KERNEL].texels == 0.0, "at %g: one texel is read", z);
        const double format = 65535.0 * need.part[SHADOW_CAUSE_FORMAT].window;
        TALLY(&t, format >= 0.5 && format <= 1.0, "at %g: %g codes for the format", z, format);
    }
    tally_end(&t);
}

/* ---- Planes in rationals ----------------------------------------------------------------------------------------- */

/* A plane normal . X = distance, and a point on it that is looked up at u, v; all are doubles, taken as they are. */
typedef struct place {
    double normal[3], u, v;
} place;

static shadow_light random_lamp(rng *r, bool distance) {
    static const double kernels[] = {0.5, 1.0, 1.5, 2.5};
    const double znear = rng_log(r, 1e-3, 10.0);
    shadow_light light =
        lamp_of(rng_below(r, 3) ? rng_uniform(r, 10.0, 150.0) : 90.0, znear, znear * rng_log(r, 2.0, 1e4),
                (int)rng_log(r, 128, 4096), rng_below(r, 2) ? "fp32" : "unorm16", distance);
    if (light.fov == 90.0)
        light.kind = SHADOW_POINT;
    light.kernel = kernels[rng_below(r, 4)];
    light.triangles.slant_hi = rng_below(r, 2) ? rng_uniform(r, 0.0, 85.0) : rng_uniform(r, 60.0, 80.0);
    light.receiver_lo = light.receiver_hi = znear * rng_log(r, 1.0, 2.0);
    return light;
}

/* The angle of a plane's normal to the ray, degrees, at most. */
static double slant_of(const place *p) {
    const double ray[3] = {p->u, p->v, 1.0}, *n = p->normal;
    double cross[3], across = 0.0, along = 0.0;
    for (int i = 0; i < 3; i++) {
        const int k = (i + 1) % 3, m = (i + 2) % 3;
        cross[i] = n[k] * ray[m] - n[m] * ray[k];
        across += cross[i] * cross[i];
        along += n[i] * ray[i];
    }
    return atan2(sqrt(across), along) * 180.0 / pi * (1.0 + 1e-12) + 1e-12;
}

/* A plane at that slant to a ray of the map, its azimuth, and the ray. */
static place place_of(double slant, double azimuth, double u, double v) {
    const double length = sqrt(u * u + v * v + 1.0), c = cos(slant * pi / 180.0), s = sin(slant * pi / 180.0);
    const double ray[3] = {u / length, v / length, 1.0 / length};
    /* Two directions across the ray. */
    const double q = sqrt(1.0 - ray[1] * ray[1]);
    const double a[3] = {ray[2] / q, 0.0, -ray[0] / q};
    const double b[3] = {-ray[0] * ray[1] / q, q, -ray[1] * ray[2] / q};
    place p = {.u = u, .v = v};
    for (int i = 0; i < 3; i++)
        p.normal[i] = c * ray[i] + s * (cos(azimuth) * a[i] + sin(azimuth) * b[i]);
    return p;
}

static void dot(mpq_t out, const place *p, mpq_srcptr u, mpq_srcptr v) {
    mpq_t n, term;
    mpq_inits(n, term, NULL);
    mpq_set_d(out, p->normal[2]);
    mpq_set_d(n, p->normal[0]);
    mpq_mul(term, n, u);
    mpq_add(out, out, term);
    mpq_set_d(n, p->normal[1]);
    mpq_mul(term, n, v);
    mpq_add(out, out, term);
    mpq_clears(n, term, NULL);
}

/* Window depth by which the point lies deeper than the plane where a texel is, off by du, dv: exactly, rounded once.
 * The point is at z. The sign is that of d3d. */
static double deeper(const shadow_light *light, const place *p, double du, double dv) {
    mpq_t u, v, off, at, there, scale, f;
    mpq_inits(u, v, off, at, there, scale, f, NULL);
    mpq_set_d(u, p->u);
    mpq_set_d(v, p->v);
    dot(at, p, u, v);
    mpq_set_d(off, du);
    mpq_add(u, u, off);
    mpq_set_d(off, dv);
    mpq_add(v, v, off);
    dot(there, p, u, v);
    /* 1/z there = 1/z at * there/at; d = (1/n - 1/z)/(1/n - 1/f). */
    mpq_sub(there, there, at);
    mpq_div(there, there, at);
    mpq_set_d(off, light->receiver_lo);
    mpq_div(there, there, off);
    mpq_set_d(scale, light->setup.spec.znear);
    mpq_inv(scale, scale);
    mpq_set_d(f, light->setup.spec.zfar);
    mpq_inv(f, f);
    mpq_sub(scale, scale, f);
    mpq_div(there, there, scale);
    const double out = mpq_get_d(there);
    mpq_clears(u, v, off, at, there, scale, f, NULL);
    return out;
}

/* The same of distances: |X| of the point less that of the plane's where the texel is, over far - near. */
static double farther(const shadow_light *light, const place *p, double du, double dv) {
    mpfr_t far[2], along, x, term;
    mpfr_inits2(BITS, far[0], far[1], along, x, term, NULL);
    for (int k = 0; k < 2; k++) {
        mpfr_set_d(along, p->normal[2], MPFR_RNDN);
        mpfr_set_d(far[k], 1.0, MPFR_RNDN);
        for (int i = 0; i < 2; i++) {
            mpfr_set_d(x, i == 0 ? p->u : p->v, MPFR_RNDN);
            mpfr_set_d(term, k == 0 ? 0.0 : i == 0 ? du : dv, MPFR_RNDN);
            mpfr_add(x, x, term, MPFR_RNDN);
            mpfr_set_d(term, p->normal[i], MPFR_RNDN);
            mpfr_fma(along, x, term, along, MPFR_RNDN);
            mpfr_fma(far[k], x, x, far[k], MPFR_RNDN);
        }
        mpfr_sqrt(far[k], far[k], MPFR_RNDN);
        mpfr_div(far[k], far[k], along, MPFR_RNDN);
    }
    /* The point is at the receiver's distance, the other in proportion. */
    mpfr_div(x, far[1], far[0], MPFR_RNDN);
    mpfr_d_sub(x, 1.0, x, MPFR_RNDN);
    mpfr_mul_d(x, x, light->receiver_lo, MPFR_RNDN);
    const double out = mpfr_get_d(x, MPFR_RNDN) / (light->setup.spec.zfar - light->setup.spec.znear);
    mpfr_clears(far[0], far[1], along, x, term, (mpfr_ptr)NULL);
    return out;
}

static double most_of(const shadow_light *light, const place *p) {
    const double off = light->kernel * 2.0 * tan(light->fov * pi / 360.0) / light->triangles.width;
    double most = 0.0;
    for (int i = 0; i < 4; i++) {
        const double du = (i & 1) != 0 ? off : -off, dv = (i & 2) != 0 ? off : -off;
        most = fmax(most, shadow_holds_distance(light) ? farther(light, p, du, dv) : deeper(light, p, du, dv));
    }
    return most;
}

/* The filter's radius at the plane's own slant. */
static double said_of(shadow_light light, const place *p) {
    shadow_need need;
    light.triangles.slant_hi = fmin(slant_of(p), SHADOW_SLANT_MAX);
    shadow_need_of(&light, &need);
    const shadow_part filter = {need.part[SHADOW_CAUSE_TEXEL].texels + need.part[SHADOW_CAUSE_KERNEL].texels, 0.0};
    return shadow_part_at(&light, &filter, light.triangles.slant_hi);
}

/* From the best of random planes at the greatest slant, in steps that shrink. */
static double climb(rng *r, const shadow_light *light) {
    const double h = tan(light->fov * pi / 360.0);
    double best = 0.0, at[3] = {0, 0, 0}, step = 1.0;
    for (int i = 0; i < 120; i++) {
        double next[3] = {rng_uniform(r, -pi, pi), rng_uniform(r, -h, h), rng_uniform(r, -h, h)};
        if (i >= 40) {
            for (int k = 0; k < 3; k++)
                next[k] = at[k] + step * next[k];
            step *= 0.95;
        }
        next[1] = fmax(-h, fmin(h, next[1]));
        next[2] = fmax(-h, fmin(h, next[2]));
        const place p = place_of(light->triangles.slant_hi, next[0], next[1], next[2]);
        const double needs = most_of(light, &p);
        if (needs > best) {
            best = needs;
            memcpy(at, next, sizeof at);
        }
    }
    return best;
}

static void check_filter(bool distance) {
    rng r = rng_make(distance ? "filters and distances" : "filters and depths");
    tally t[2] = {{.name = "never exceeded"}, {.name = "reached"}};
    double least = 1.0;
    for (uint64_t n = test_cases(60, 1000, 50000); n > 0; n--) {
        const shadow_light light = random_lamp(&r, distance);
        const double h = tan(light.fov * pi / 360.0), slant = light.triangles.slant_hi;
        assert_int_equal(shadow_light_check(&light), SHADOW_OK);
        for (int i = 0; i < 10; i++) {
            const place p = place_of(rng_uniform(&r, 0.0, slant), rng_uniform(&r, -pi, pi), rng_uniform(&r, -h, h),
                                     rng_uniform(&r, -h, h));
            const double needs = most_of(&light, &p), said = said_of(light, &p);
            TALLY(&t[0], needs <= said, "fov %g, %d texels, %g: %.17g of %.17g", light.fov, light.triangles.width,
                  light.kernel, needs, said);
        }
        /* Planes that nearly face the ray are nearest within the filter. */
        if (distance && tan(slant * pi / 180.0) < 20.0 * light.kernel * h / light.triangles.width * 2.0)
            continue;
        const place steep = {.normal = {sin(slant * pi / 180.0), 0.0, cos(slant * pi / 180.0)}};
        const double part = climb(&r, &light) / said_of(light, &steep);
        least = fmin(least, part);
        TALLY(&t[1], part >= 0.9 && part <= 1.0, "fov %g, %d texels, radius %g, slant %g: %.17g", light.fov,
              light.triangles.width, light.kernel, slant, part);
    }
    print_message("# climbed to %.3f at least\n", least);
    tally_end(&t[0]);
    tally_end(&t[1]);
}

TEST(filter_of_depths) {
    check_filter(false);
}

TEST(filter_of_distances) {
    check_filter(true);
}

/* ---- The normal offset ------------------------------------------------------------------------------------------- */

/* The least multiple of its depth (or, times the sine, of its distance) by which a point of the plane has to be moved
 * along the normal to be in front of the plane as each corner of the filter's texels has it: bisected, in long double.
 * The point lies on the ray u, v. `most` where that is not enough. */
static double offset_of(const shadow_light *light, const place *p, double most) {
    const double off = light->kernel * 2.0 * tan(light->fov * pi / 360.0) / light->triangles.width;
    const bool distance = shadow_holds_distance(light);
    const long double sine = sinl((long double)slant_of(p) * 3.14159265358979323846L / 180.0L);
    long double lo = 0.0L, hi = most;
    for (int i = 0; i < 60; i++) {
        const long double by = 0.5L * (lo + hi);
        const long double far = distance ? sqrtl((long double)p->u * p->u + (long double)p->v * p->v + 1.0L) : 1.0L;
        const long double l = by * far * (distance ? sine : 1.0L);
        const long double x = p->u - l * p->normal[0], y = p->v - l * p->normal[1], z = 1.0L - l * p->normal[2];
        const long double plane = (long double)p->normal[0] * p->u + (long double)p->normal[1] * p->v + p->normal[2];
        bool lit = z > 0.0L;
        for (int k = 0; k < 4 && lit; k++) {
            const long double u = x / z + ((k & 1) != 0 ? off : -off), v = y / z + ((k & 2) != 0 ? off : -off);
            const long double facing = p->normal[0] * u + p->normal[1] * v + p->normal[2];
            const long double there = plane / facing * (distance ? sqrtl(u * u + v * v + 1.0L) : 1.0L);
            lit = facing <= 0.0L || (distance ? sqrtl(x * x + y * y + z * z) : z) <= there * (1.0L + 1e-17L);
        }
        *(lit ? &hi : &lo) = by;
    }
    return (double)lo;
}

static double offset_said(shadow_light light, double slant) {
    shadow_need need;
    light.triangles.slant_hi = slant;
    shadow_need_of(&light, &need);
    return need.bias[SHADOW_NORMAL].offset;
}

TEST(normal_offset) {
    rng r = rng_make("offsets of lamps");
    tally t[2] = {{.name = "in front at the offset"}, {.name = "not in front of some texel below it"}};
    for (uint64_t n = test_cases(100, 2000, 50000); n > 0; n--) {
        shadow_light light = random_lamp(&r, n % 2);
        const double h = tan(light.fov * pi / 360.0), slant = fmax(light.triangles.slant_hi, 5.0);
        light.triangles.slant_hi = slant;
        if (shadow_light_check(&light) != SHADOW_OK)
            continue;
        shadow_need need;
        shadow_need_of(&light, &need);
        const double said = need.bias[SHADOW_NORMAL].offset, filter = light.kernel / need.texels;
        double most = 0.0;
        for (int i = 0; i < 400; i++) {
            const double lean = i % 2 ? slant : rng_uniform(&r, 0.0, slant),
                         corner = rng_below(&r, 2) ? 1.0 : rng_unit(&r);
            const double azimuth = i % 4 < 2 ? pi / 4.0 * (double)rng_below(&r, 8) : rng_uniform(&r, -pi, pi);
            const double u = corner * (i % 3 == 0 ? rng_uniform(&r, -h, h) : h),
                         v = i % 3 < 2 ? u : rng_uniform(&r, -h, h);
            const place p = place_of(lean, azimuth, u, v);
            const double needs = offset_of(&light, &p, 2.0 * said);
            most = fmax(most, needs);
            TALLY(&t[0], needs <= said && needs <= offset_said(light, fmin(slant_of(&p), SHADOW_SLANT_MAX)),
                  "fov %g, %d texels, radius %g, %g: %.17g of %.17g", light.fov, light.triangles.width, light.kernel,
                  slant_of(&p), needs, said);
        }
        if (shadow_holds_distance(&light) && tan(slant * pi / 180.0) < 40.0 * light.kernel * h / light.triangles.width)
            continue; /* nearest within the filter */
        if (said > 0.1)
            continue; /* so few texels that one is no small step */
        /* Rounding needs the rest. */
        TALLY(&t[1], most >= 0.82 * filter * said, "fov %g, %d texels, radius %g, slant %g: %.17g of %.17g", light.fov,
              light.triangles.width, light.kernel, slant, most, filter * said);
    }
    tally_end(&t[0]);
    tally_end(&t[1]);
}

/* ---- Seams ------------------------------------------------------------------------------------------------------- */

/* Lookups whose filter reaches into the next face of a cube, whose depths are along its own axis: the constant bias
 * covers them, and is needed up to 0.9. */
TEST(seams) {
    rng r = rng_make("seams");
    tally t = {.name = "never exceeded across the seam"};
    double best = 0.0;
    for (uint64_t n = test_cases(20000, 200000, 5000000); n > 0; n--) {
        shadow_light light = random_lamp(&r, false);
        light.kind = SHADOW_POINT;
        light.fov = 90.0;
        light.kernel = 0.5 * (double)(1 + rng_below(&r, 5));
        if (shadow_light_check(&light) != SHADOW_OK)
            continue;
        shadow_need need;
        const double pitch = 2.0 / light.triangles.width, slant = light.triangles.slant_hi,
                     reach = light.kernel * pitch;
        /* The point is so far within the edge u = 1, the texel's centre so far beyond it in the other face. */
        const double inside = reach * rng_unit(&r), beyond = rng_below(&r, 4) ? reach - inside : 0.0;
        const double along = rng_below(&r, 2) ? reach : -reach, v = rng_uniform(&r, -1.0, 1.0);
        const place p = place_of(slant, rng_uniform(&r, -pi, pi), 1.0 - inside, v);
        shadow_need_of(&light, &need);
        /* In the frame of the other face: 1, v, w = 1 - beyond. */
        const long double at = (long double)p.normal[0] * p.u + (long double)p.normal[1] * p.v + p.normal[2];
        const long double there = (long double)p.normal[0] + (long double)p.normal[1] * (v + along) +
                                  (long double)p.normal[2] * (1.0L - beyond);
        const shadow_part filter = {need.texels, 0.0};
        const double needs = (double)((there - at) / at) / light.receiver_lo / light.setup.kappa;
        const double said = shadow_part_at(&light, &filter, slant);
        best = fmax(best, needs / said * need.texels / light.kernel);
        TALLY(&t, needs <= said, "%d texels, radius %g, slant %g: %.17g of %.17g", light.triangles.width, light.kernel,
              slant, needs, said);
    }
    print_message("# %.3f of the filter's part\n", best);
    assert_true(best >= 0.9);
    tally_end(&t);
}

/* ---- Gaps -------------------------------------------------------------------------------------------------------- */

/* How far before the surface, along its ray, a caster ends to be seen: of one plane, by what each bias adds there. */
static double gap_of(const shadow_light *light, const shadow_bias *b, const place *p) {
    const double z = light->receiver_hi, kappa = light->setup.kappa, ray = sqrt(p->u * p->u + p->v * p->v + 1.0);
    const double pitch = 2.0 * tan(light->fov * pi / 360.0) / light->triangles.width, slant = slant_of(p) * pi / 180.0;
    if (shadow_holds_distance(light)) /* the receiver is at the distance z */
        return b->window * kappa + b->offset * sin(slant) * z / cos(slant);
    const double facing = p->normal[0] * p->u + p->normal[1] * p->v + p->normal[2];
    const double m = hypot(p->normal[0], p->normal[1]) * pitch / (facing * z * kappa);
    const double less = (b->window + b->factor * m) * kappa;
    return (1.0 / (1.0 / z - less) - z) * ray + b->offset * z / cos(slant);
}

TEST(gaps) {
    rng r = rng_make("gaps of lamps");
    tally t = {.name = "never wider"};
    double widest[SHADOW_WAY_COUNT] = {0};
    for (uint64_t n = test_cases(300, 3000, 100000); n > 0; n--) {
        shadow_light light = random_lamp(&r, n % 4 == 0);
        const double h = tan(light.fov * pi / 360.0);
        shadow_need need;
        if (shadow_light_check(&light) != SHADOW_OK)
            continue;
        shadow_need_of(&light, &need);
        for (int i = 0; i < 100; i++) {
            const int way = i % 3;
            const shadow_bias *b = &need.bias[way];
            const double slant = light.triangles.slant_hi, v = rng_below(&r, 2) ? h : rng_uniform(&r, -h, h);
            const place p = place_of(i % 2 ? slant : rng_uniform(&r, 0, slant), rng_uniform(&r, -pi, pi),
                                     rng_below(&r, 2) ? h : rng_uniform(&r, -h, h), v);
            if (!isfinite(b->factor) || !isfinite(b->gap_light))
                continue;
            const double gap = gap_of(&light, b, &p);
            TALLY(&t, gap <= b->gap_light * (1.0 + 1e-9), "%s fov %g, %d texels, %g: %.17g of %.17g",
                  shadow_way_name((shadow_way)way), light.fov, light.triangles.width, slant, gap, b->gap_light);
            widest[way] = fmax(widest[way], gap / b->gap_light);
        }
    }
    print_message("# widest %.3f, %.3f, %.3f\n", widest[0], widest[1], widest[2]);
    for (int way = 0; way < SHADOW_WAY_COUNT; way++)
        assert_true(widest[way] >= 0.9);
    tally_end(&t);
}

/* ---- As programs set it ------------------------------------------------------------------------------------------ */

/* At each depth the units are worth what is needed there, whatever the format's units follow. */
TEST(units) {
    static const char *const formats[] = {"unorm16", "unorm24", "fp32"};
    rng r = rng_make("units of lamps");
    tally t = {.name = "enough"};
    for (uint64_t n = test_cases(300, 3000, 100000); n > 0; n--) {
        shadow_light light =
            lamp_of(90.0, 0.1, rng_below(&r, 2) ? 100.0 : (double)INFINITY, 1024, formats[n % 3], false);
        dp_spec spec = light.setup.spec;
        const bias_api *api = bias_api_get(rng_below(&r, 11));
        spec.mapping = rng_below(&r, 2) ? DP_MAPPING_REVERSED : DP_MAPPING_D3D;
        assert_int_equal(dp_setup_init(&light.setup, &spec), DP_OK);
        light.triangles.slant_hi = rng_uniform(&r, 0.0, 80.0);
        light.receiver_lo = rng_log(&r, 0.2, 10.0);
        light.receiver_hi = light.receiver_lo * rng_log(&r, 1.0, 9.0);
        assert_int_equal(shadow_light_check(&light), SHADOW_OK);
        shadow_need need, here;
        shadow_need_of(&light, &need);
        for (int way = 0; way < SHADOW_WAY_COUNT; way++) {
            const shadow_state set = shadow_state_of(&light, &need.bias[way], api);
            for (int i = 0; i < 8 && isfinite(set.units); i++) {
                shadow_light one = light;
                one.receiver_lo = one.receiver_hi =
                    fmin(light.receiver_lo * pow(light.receiver_hi / light.receiver_lo, i / 7.0), light.receiver_hi);
                shadow_need_of(&one, &here);
                const double d = dp_window(&one.setup, one.receiver_lo) - here.bias[SHADOW_CONSTANT].window;
                const double worth = bias_unit_at(api, &spec.format, fmax(d, 0.0)).least * set.units;
                TALLY(&t, worth >= here.bias[way].window * (1.0 - 1e-12), "%s %s %s at %g: %.17g of %.17g", api->name,
                      formats[n % 3], shadow_way_name((shadow_way)way), one.receiver_lo, worth, here.bias[way].window);
            }
        }
    }
    tally_end(&t);
}

/*
 * A light in a world: the places of the nearest vertices are up to sqrt(3) times the world from the origin, and so is
 * the light itself. Roundings of both, 16 x 2^-24 of that distance each, may take off as much of the depth as leaves
 * its cube half of what it is, and no more; beyond, however far, the light is refused for it, whatever else is wrong.
 */
TEST(refused_from_where_on) {
    rng r = rng_make("refused from where on");
    tally t = {.name = "worlds"};
    int refused = 0, others = 0;
    for (uint64_t n = test_cases(500, 5000, 100000); n > 0; n--) {
        const double fov = rng_uniform(&r, 5.0, 160.0);
        const double znear = rng_log(&r, 1e-3, 10.0);
        const double zfar = znear * rng_log(&r, 2.0, 1e4);
        const int size = 1 << (6 + rng_below(&r, 6));
        shadow_light l = lamp_of(fov, znear, zfar, size, "unorm24", rng_below(&r, 4) == 0);
        l.receiver_lo = znear * rng_log(&r, 1.0, zfar / znear);
        l.receiver_lo = fmin(fmax(l.receiver_lo, znear), zfar);
        l.triangles.depth = rng_log(&r, 1.0, 100.0);
        const double nearest = fmax(l.receiver_lo / l.triangles.depth, znear);
        const double most = (1.0 - 1.0 / cbrt(2.0)) * nearest / (2.0 * 16.0 * 0x1p-24 * sqrt(3.0));
        const double widest = rng_below(&r, 2) == 0 ? 1.0 : 1e9;
        const double by = rng_log(&r, 1e-9, widest);
        l.world = rng_below(&r, 2) == 0 ? most * (1.0 + by) : most / (1.0 + by);
        const shadow_status status = shadow_light_check(&l);
        const bool is = l.world > most;
        is ? refused++ : others++;
        TALLY(&t, (status == SHADOW_POSITION) == is, "%g degrees, at %g, a world of %.17g, not above %.17g: status %d",
              fov, nearest, l.world, most, (int)status);
    }
    assert_true(refused > 100 && others > 100);
    tally_end(&t);
}

TEST(refused) {
    const shadow_light good = lamp_of(60.0, 0.1, 10.0, 512, "unorm16", false);
    shadow_light l = good;
    assert_int_equal(shadow_light_check(&good), SHADOW_OK);
    l.fov = 170.5;
    assert_int_equal(shadow_light_check(&l), SHADOW_CONE);
    l = good;
    l.kind = SHADOW_POINT;
    assert_int_equal(shadow_light_check(&l), SHADOW_CONE);
    l = good;
    l.triangles.height = 511;
    assert_int_equal(shadow_light_check(&l), SHADOW_CONE);
    l = good;
    l.radius = 5.0;
    assert_int_equal(shadow_light_check(&l), SHADOW_CONE);
    l = good;
    l.receiver_lo = 0.05;
    assert_int_equal(shadow_light_check(&l), SHADOW_RECEIVERS);
    l = lamp_of(60.0, 0.1, INFINITY, 512, "unorm16", false);
    assert_int_equal(shadow_light_check(&l), SHADOW_OK);
    l.receiver_hi = 1e13;
    assert_int_equal(shadow_light_check(&l), SHADOW_RECEIVERS);
    l = good;
    l.world = 1e5;
    assert_int_equal(shadow_light_check(&l), SHADOW_POSITION);
    l = good;
    l.triangles.width = l.triangles.height = 4;
    l.kernel = 2.0;
    assert_int_equal(shadow_light_check(&l), SHADOW_COARSE);
    l = good;
    l.kind = SHADOW_SUN;
    assert_int_equal(shadow_light_check(&l), SHADOW_SETUP);
    for (int i = 0; i < SHADOW_STATUS_COUNT; i++)
        assert_true(strlen(shadow_status_text((shadow_status)i)) > 3);
}
