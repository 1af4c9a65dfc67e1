/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Constants of a camera and depths as shaders have them, against their definitions in long double; the traps by doing
 * what each of them does. */
#include "shader/constants.h"
#include "support.h"
#include "views.h"

static dp_setup setup_of(dp_mapping mapping, bool ortho, double znear, double zfar) {
    dp_spec spec = dp_spec_default();
    dp_setup setup;
    spec.mapping = mapping;
    spec.ortho = ortho;
    spec.znear = znear;
    spec.zfar = zfar;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    return setup;
}

static const dp_mapping mappings[] = {DP_MAPPING_D3D, DP_MAPPING_GL, DP_MAPPING_REVERSED, DP_MAPPING_GL_REVERSED};
static const float near_clips[] = {0, -1, 1, 1};

/* (1 - f/n, f/n, x/f, y/f), reversed (f/n - 1, 1, x/f, 1/f), and the limits of an infinite far plane. */
TEST(constants_are_as_documented) {
    rng r = rng_make("constants");
    for (int i = 0; i < 4000; i++) {
        const double n = rng_log(&r, 1e-3, 10), f = i % 5 == 0 ? INFINITY : n * (1 + rng_log(&r, 1e-3, 1e6));
        const dp_setup setup = setup_of(mappings[i % 4], false, n, f);
        const shader_constants c = shader_constants_of(&setup);
        const long double ratio = (long double)f / n, per_far = 1 / (long double)f, per_near = 1 / (long double)n;
        const bool reversed = i % 4 >= 2;
        const long double want[4] = {reversed ? ratio - 1 : 1 - ratio, reversed ? 1 : ratio,
                                     reversed ? per_near - per_far : per_far - per_near, reversed ? per_far : per_near};
        const float got[4] = {c.zbuffer.x, c.zbuffer.y, c.zbuffer.z, c.zbuffer.w};
        for (int k = 0; k < 4; k++)
            assert_true(isinf(want[k]) ? (long double)got[k] == want[k]
                                       : fabsl(got[k] - want[k]) <= 0x1.000002p-24L * fabsl(want[k]) + 0x1p-150L);
        assert_true(c.projection.flip == 1 && c.projection.znear == (float)n && c.projection.zfar == (float)f &&
                    c.projection.per_far == (float)(1 / f) && c.near_clip == near_clips[i % 4]);
    }
}

/* Clip z of the projection matrix as documented, and what LinearEyeDepth and its kin are of a depth. */
TEST(depths_are_as_documented) {
    rng r = rng_make("depths");
    tally t = {.name = "depths"};
    for (int i = 0; i < 20000; i++) {
        const bool ortho = i % 3 == 0, reversed = i % 4 >= 2, ndc_signed = i % 2 == 1;
        const double n = rng_log(&r, 0.01, 10), f = n * rng_log(&r, 10, 1e4),
                     z = (double)(float)rng_log(&r, n * 1.01, f);
        const dp_setup setup = setup_of(mappings[i % 4], ortho, n, f);
        const long double share = ((long double)z - n) / ((long double)f - n), ln = n, lf = f, lz = z;
        const long double standard = ortho ? share : lf * share / lz, d = reversed ? 1 - standard : standard;
        const long double ndc = ndc_signed ? 2 * d - 1 : d, w = ortho ? 1 : lz;
        /* A z and B are rounded before they cancel, and so is the window depth */
        const long double lost = 0x1p-21L * (ortho ? (lz + ln + lf) / (lf - ln) : 1 + ln / lz);
        const long double back = ortho ? lf : lz * lz / ln; /* of eye depth, a unit of d */
        shader_depth got;
        assert_true(shader_depth_of(&setup, z, &got));
        TALLY(&t, got.clip_w == (float)w && fabsl(got.clip_z - ndc * w) <= lost * w, "clip %g, %g", (double)got.clip_z,
              (double)(ndc * w));
        TALLY(&t, fabsl(got.ndc - ndc) <= lost && fabsl(got.window - d) <= lost, "NDC %g, window %g of %g",
              (double)got.ndc, (double)got.window, (double)d);
        TALLY(&t, fabsl(got.eye - lz) <= lost * back * 2 + 0x1p-20L * lz, "eye %.9g of %.9g", (double)got.eye, z);
        TALLY(&t, ortho == isnan(got.linear01) && ortho == isnan(got.from_near), "01 of an orthographic depth");
        TALLY(&t,
              ortho || (fabsl(got.linear01 - lz / lf) <= (lost * back * 2 + 0x1p-20L * lz) / lf &&
                        fabsl(got.from_near - share) <= (lost * back * 2 + 0x1p-20L * lz) / (lf - ln)),
              "01 %g, from near %g, z %g", (double)got.linear01, (double)got.from_near, z);
    }
    tally_end(&t);
    shader_depth none;
    const dp_setup log = setup_of(DP_MAPPING_LOG, false, 0.1, 1000);
    assert_false(shader_depth_of(&log, 10, &none));
}

/* A corner's ray, times a depth, is where the corner of the picture is at it: half a pixel beyond the last ones. */
TEST(corners_are_those_of_the_picture) {
    for (int ortho = 0; ortho < 2; ortho++) {
        const texture_camera c = view_camera("fp32", DP_MAPPING_D3D, 0.5, 100, ortho != 0, 320, 180, ortho ? 5 : 60);
        const shader_corners got = shader_corners_of(&c);
        const double top = ortho ? 5 : tan(60 * 3.14159265358979323846 / 360), right = top * 320 / 180;
        assert_relative(got.to_top, ortho ? top : 0.5 * top, 1e-14);
        assert_relative(got.to_right, ortho ? right : 0.5 * right, 1e-14);
        for (int i = 0; i < 4; i++) {
            assert_relative(got.ray[i][0], i % 2 == 0 ? -right : right, 1e-14);
            assert_relative(got.ray[i][1], i < 2 ? top : -top, 1e-14);
            assert_true(got.ray[i][2] == (ortho ? 0.5 : 1));
        }
    }
}

/* ---- Traps ------------------------------------------------------------------------------------------------------- */

/* The depth that is stored of z, and LinearEyeDepth, both of the direction that is asked for. */
static long double stored(long double n, long double f, long double z, bool ortho, bool reversed) {
    const long double d = ortho ? (z - n) / (f - n) : (1 - n / z) / (1 - n / f);
    return reversed ? 1 - d : d;
}
static long double linear_eye(long double n, long double f, long double d, bool reversed) {
    return reversed ? 1 / ((1 / n - 1 / f) * d + 1 / f) : 1 / ((1 / f - 1 / n) * d + 1 / n);
}

/* The depth of (0, 0, z) where a plane C through (0, 0, n), 45 degrees to the axis, takes the near plane's place: the
 * row of the matrix is C scaled so that the frustum's corner that is farthest along C has depth 1. */
static long double clipped(long double n, long double f, long double half, long double z) {
    const long double c[4] = {0, sqrtl(0.5L), sqrtl(0.5L), -n * sqrtl(0.5L)};
    const long double corner = isinf(f) ? c[1] * half + c[2] : c[1] * half * f + c[2] * f + c[3];
    return (c[2] * z + c[3]) * (isinf(f) ? 1 : f) / corner / z;
}

/* The steps of each of them. */
static long double trapped(const char *name, long double n, long double f, long double half, long double z, bool ortho,
                           bool reversed) {
    const long double d = stored(n, f, z, ortho, reversed);
    const bool infinite = isinf(f);
    if (strcmp(name, "inverted-x") == 0)
        return f / ((1 - n / f) * d + f / n);
    if (strcmp(name, "doubled-product") == 0) /* solved for z */
        return infinite ? 2 * n / (1 - d) : 2 * f * n / ((f - n) * (f / (f - n) - d));
    if (strcmp(name, "near-is-one") == 0) /* taken for a reversed depth */
        return 1 / ((1 / n - 1 / f) * d + 1 / f);
    if (strcmp(name, "shrunk-by-far") == 0)
        return n + f * ((z - n) / (f - n));
    if (strcmp(name, "four-bits") == 0) {
        const long double code = floorl(d * 15 + 0.5L) / 15;
        return 1 / (reversed ? code / n + (1 - code) / f : (1 - code) / n + code / f);
    }
    if (strcmp(name, "ndc-as-depth") == 0)
        return linear_eye(n, f, -1 + (1 - -1) * d, reversed);
    if (strcmp(name, "other-direction") == 0)
        return linear_eye(n, f, 1 - d, reversed);
    if (strcmp(name, "perspective-of-ortho") == 0)
        return linear_eye(n, f, d, reversed);
    if (strcmp(name, "normal-as-depth") == 0) /* EncodeViewNormalStereo of (0, 0, 1) is 0.5 in both channels */
        return (0.5L + 0.5L / 255) * f;
    if (strcmp(name, "perspective-of-oblique") == 0)
        return linear_eye(n, f, reversed ? 1 - clipped(n, f, half, z) : clipped(n, f, half, z), reversed);
    assert_string_equal(name, "linear-of-perspective");
    return reversed ? f - (f - n) * d : n + (f - n) * d;
}

TEST(traps_read_what_they_read) {
    rng r = rng_make("traps");
    tally t = {.name = "traps"};
    size_t seen[16] = {0}, count = 0;
    for (int k = 0; k < 40000; k++) {
        const dp_mapping mapping = mappings[k % 4];
        const bool ortho = k % 7 == 0, reversed = k % 4 >= 2;
        const double n = rng_log(&r, 0.01, 10), f = k % 5 == 0 && !ortho ? INFINITY : n * rng_log(&r, 2, 1e4);
        const double z = rng_log(&r, n * 1.001, isinf(f) ? n * 1e4 : f);
        const double half = tan(rng_log(&r, 0.01, 1.5));
        const dp_setup setup = setup_of(mapping, ortho, n, f);
        for (count = 0; trap_get(count) != NULL; count++) {
            const trap_row *row = trap_get(count);
            const double got = trap_reads(row, &setup, half, z);
            if (isnan(got))
                continue;
            const long double codes = stored(n, f, z, ortho, reversed) * 15;
            if (strcmp(row->name, "four-bits") == 0 && fabsl(codes - floorl(codes) - 0.5L) < 1e-9L)
                continue; /* a tie but for rounding */
            const long double want = trapped(row->name, n, f, half, z, ortho, reversed);
            TALLY(&t, isinf(got) ? isinf(want) : fabsl(got - want) <= 1e-9L * fabsl(want),
                  "%s at %g between %g and %g: %.12g, not %.12Lg", row->name, z, n, f, got, want);
            TALLY(&t, ortho == row->ortho && (!row->ndc_signed || k % 4 == 1), "%s is no trap here", row->name);
            seen[count]++;
        }
    }
    for (size_t i = 0; i < count; i++)
        assert_true(trap_get(i)->reads != NULL ? seen[i] > 1000 : seen[i] == 0);
    tally_end(&t);
}

/* As the right formula writes half the depth. */
TEST(a_doubled_product_writes_half_the_depth) {
    const trap_row *row = trap_find("doubled-product");
    for (int k = 0; k < 8; k++) {
        const double n = 0.3, f = k % 2 ? INFINITY : 1000, z = 0.3 * pow(3, k);
        const dp_setup setup = setup_of(DP_MAPPING_D3D, false, n, f),
                       reversed = setup_of(DP_MAPPING_REVERSED, false, n, f);
        const trap_depth at = {z, z - n, f - z, 1};
        const double scale = k % 2 ? 1 : f / (f - n), half = trap_writes_at(row, &setup, &at);
        assert_relative(scale * (1 - n / half), scale - 2 * scale * n / z, 1e-12);
        assert_true(isnan(trap_writes_at(row, &reversed, &at)));
        assert_true(isnan(trap_writes_at(trap_find("inverted-x"), &setup, &at)));
    }
}

/* EncodeViewNormalStereo and back of a normal that is cos(apart/2) long, step by step. */
TEST(a_short_normal_is_turned) {
    const trap_row *row = trap_find("unnormalized-normal");
    const long double degree = 3.14159265358979323846L / 180;
    for (int off = 0; off <= 90; off += 15)
        for (int apart = 0; apart <= 120; apart += 20) {
            const long double length = cosl(apart * degree / 2), scale = 1.7777L;
            const long double x = length * sinl(off * degree) / (length * cosl(off * degree) + 1) / scale;
            const long double encoded = x * 0.5L + 0.5L, nn = (encoded * 2 - 1) * scale, g = 2 / (nn * nn + 1);
            const long double back = atan2l(g * nn, g - 1) / degree;
            assert_true(fabsl((long double)row->turns(off, apart) - (off - back)) < 1e-10L);
        }
    assert_true(row->turns(45, 60) > 3.4 && row->turns(45, 60) < 3.42);
}

/* The numbers of the articles' cameras. */
TEST(known_traps) {
    const dp_setup gl = setup_of(DP_MAPPING_GL, false, 0.1, 1000), d3d = setup_of(DP_MAPPING_D3D, false, 0.3, 1000);
    assert_scene(trap_reads(trap_find("ndc-as-depth"), &gl, 1, 10), 5.0251256, 1e-6);
    assert_scene(trap_reads(trap_find("inverted-x"), &d3d, 1, 10), 0.2999127, 1e-6);
    assert_scene(trap_reads(trap_find("doubled-product"), &d3d, 1, 10), 20, 1e-12);
    assert_true(isnan(trap_reads(trap_find("ndc-as-depth"), &d3d, 1, 10)));
}

/* Each with its formula, and what it reads of a depth of 10. */
TEST(traps_are_listed) {
    printed p = print_of("list traps --full");
    const char *at = p.out;
    for (size_t i = 0; trap_get(i) != NULL; i++) {
        const trap_row *row = trap_get(i);
        double reads = NAN;
        at = strstr(at, row->name);
        assert_non_null(at);
        assert_non_null(strstr(at, row->note));
        at = strstr(at, "  reads       ");
        assert_non_null(at);
        if (row->turns != NULL) {
            assert_non_null(strstr(at, "turned by 3.41 degrees"));
            continue;
        }
        assert_true(at != NULL && sscanf(at, " reads %lf", &reads) == 1);
        assert_relative(reads, (double)trapped(row->name, 0.3L, 1000, sqrtl(3) / 3, 10, row->ortho, false), 1e-5);
    }
    printed_free(&p);
}
