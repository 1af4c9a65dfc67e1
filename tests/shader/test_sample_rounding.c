/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * What many codes say of the depth is what each says by itself, bit for bit: all formats, mappings and roundings of an
 * image, at random codes and at both ends.
 */
#include "shader/sample_rounding.h"
#include "support.h"

enum { COUNT = 700, GRAINS = 9 };

static const grain grains[GRAINS] = {
    {.kind = GRAIN_CODES},
    {.kind = GRAIN_FLOATS, .buffer = true, .bits = 24, .least = 0x1p-149},
    {.kind = GRAIN_FLOATS, .buffer = true, .bits = 11, .least = 0x1p-24},
    {.kind = GRAIN_FLOATS, .buffer = true, .bits = 53, .least = 0x1p-149},
    {.kind = GRAIN_FLOATS, .bits = 11, .margin = 0x1p-24, .least = 0x1p-24},
    {.kind = GRAIN_STEPS, .steps = 255, .buffer = true},
    {.kind = GRAIN_STEPS, .steps = 65535, .margin = 0x1p-24, .rounding = GRAIN_NEAREST},
    {.kind = GRAIN_STEPS, .steps = 65535 / 256.0, .own = 65535, .whole = 255, .margin = 0x1p-24},
    {.kind = GRAIN_STEPS, .steps = 1023, .own = 65535, .margin = 0x1p-24, .bits = 24, .least = 0x1p-149},
};

static void fill_codes(rng *r, uint32_t code_max, uint32_t codes[COUNT]) {
    for (size_t i = 0; i < COUNT; i++)
        codes[i] = (uint32_t)rng_below(r, (uint64_t)code_max + 1);
    codes[1] = codes[0] = 0;
    codes[2] = code_max;
    codes[3] = code_max - 1;
    codes[4] = 1;
    codes[5] = UINT32_MAX; /* no depth: anything, but nothing beyond the arrays */
}

static void compare(const dp_setup *setup, const grain *g, const uint32_t codes[COUNT]) {
    static double stored[COUNT], lo[COUNT], hi[COUNT], reach[COUNT];
    const grain_rows got = {stored, lo, hi, reach};
    grain_ranges_of(setup, g, codes, COUNT, &got);
    for (size_t i = 0; i < COUNT; i++) {
        const uint32_t code = codes[i] <= setup->spec.format.code_max ? codes[i] : 0;
        const grain_range want = grain_range_of(setup, g, code);
        const double wanted[4] = {dp_stored(setup, code), want.lo, want.hi, want.reach};
        const double found[4] = {stored[i], lo[i], hi[i], reach[i]};
        if (memcmp(wanted, found, sizeof found) != 0)
            fail_msg("%s %s, code %u: %.17g in %.17g to %.17g, reach %.17g; alone %.17g in %.17g to %.17g, %.17g",
                     setup->spec.format.name, dp_mapping_get(setup->spec.mapping)->name, code, found[0], found[1],
                     found[2], found[3], wanted[0], wanted[1], wanted[2], wanted[3]);
    }
}

/* Where codes change their minds: on cells' ends, as rounded, and next to them; in the middle; anywhere. */
static void fill_depths(rng *r, const dp_setup *setup, const uint32_t codes[COUNT], double z[COUNT]) {
    const dp_spec *spec = &setup->spec;
    const double most = isinf(spec->zfar) ? 1e9 : spec->zfar;
    for (size_t i = 0; i < COUNT; i++) {
        const uint32_t code = codes[i] <= spec->format.code_max ? codes[i] : 0;
        const grain_range range = grain_range_of(setup, NULL, code);
        const double at[6] = {range.lo,
                              range.hi,
                              dp_stored(setup, code),
                              nextafter(range.lo, 0),
                              nextafter(range.hi, INFINITY),
                              rng_uniform(r, spec->znear, most)};
        z[i] = fmin(fmax(at[i % 6], spec->znear), most);
    }
}

static void compare_errors(const dp_setup *setup, const grain *g, const double z[COUNT]) {
    static double got[COUNT];
    grain_memo *memo = calloc(1, sizeof *memo);
    grain_errors_of(setup, g, z, COUNT, 0x1p-23, memo, got);
    free(memo);
    for (size_t i = 0; i < COUNT; i++) {
        const double want = grain_error_of(setup, g, z[i], 0x1p-23);
        if (memcmp(&want, &got[i], sizeof want) != 0)
            fail_msg("%s %s at %.17g: %.17g, alone %.17g", setup->spec.format.name,
                     dp_mapping_get(setup->spec.mapping)->name, z[i], got[i], want);
    }
}

/* The cell of a depth by itself: half of it in 1/z or z, and what reading adds; differences of quotients lose 2^-50. */
static void compare_closed_form(const dp_setup *setup, const grain *g, const double z[COUNT], size_t *exact) {
    const dp_spec *spec = &setup->spec;
    grain_bound bound;
    if (!grain_bound_init(&bound, setup, g, 0x1p-23))
        return;
    for (size_t i = 0; i < COUNT; i++) {
        const uint32_t code = dp_code(setup, z[i]);
        const grain_range range = grain_range_of(setup, g, code);
        const double own = grain_range_error(setup, dp_stored(setup, code), range.lo, range.hi, 0x1p-23);
        const double at = spec->ortho ? z[i] : 1 / z[i], got = grain_bound_of(&bound, at, at);
        /* A range at the end of window depth is cut off there; one beside a power of 2 counts as of the wider side. */
        if (!(got >= own - 0x1p-50 * fabs(at)) ||
            (code > 8 && spec->format.code_max - code > 8 && !(got <= 3.01 * own)))
            fail_msg("%s %s at %.17g: at most %.17g, its cell %.17g", spec->format.name,
                     dp_mapping_get(spec->mapping)->name, z[i], got, own);
        *exact += got <= own * (1 + 0x1p-18);
        exact[1]++;
    }
    const double least = spec->ortho ? spec->znear : 1 / spec->zfar, most = spec->ortho ? spec->zfar : 1 / spec->znear;
    assert_true(isinf(grain_bound_of(&bound, least, most * 1.001)));
    assert_true(isinf(grain_bound_of(&bound, least - 0.001 * most, most)));
    assert_true(isfinite(grain_bound_of(&bound, least, most)));
    assert_true(isinf(grain_bound_of(&bound, least, (double)NAN)) && isinf(grain_bound_of(&bound, (double)NAN, most)));
}

/* Between two depths at least as much as at each of them and halfway. */
static void compare_between(const dp_setup *setup, const grain *g, rng *r) {
    const dp_spec *spec = &setup->spec;
    const double least = spec->ortho ? spec->znear : 1 / spec->zfar, most = spec->ortho ? spec->zfar : 1 / spec->znear;
    grain_bound bound;
    for (int i = 0; i < 200 && grain_bound_init(&bound, setup, g, 0x1p-23); i++) {
        const double a = rng_uniform(r, least, most), b = rng_uniform(r, least, most);
        const double lo = fmin(a, b), hi = fmax(a, b), all = grain_bound_of(&bound, lo, hi);
        for (int k = 0; k <= 2; k++) {
            const double at = fmin(lo + (hi - lo) * k / 2, hi);
            assert_true(all >= grain_bound_of(&bound, at, at));
        }
    }
}

TEST(the_closed_form_has_each_cell) {
    rng r = rng_make("closed form");
    size_t exact[2] = {0, 0}; /* of all */
    uint32_t codes[COUNT];
    double z[COUNT];
    for (size_t f = 0; f < dp_format_count(); f++)
        for (int m = 0; m < DP_MAPPING_COUNT; m++)
            for (int variant = 0; variant < 8; variant++) {
                dp_spec spec = dp_spec_default();
                dp_setup setup;
                spec.format = dp_format_get(f)->format;
                spec.mapping = (dp_mapping)m;
                spec.ortho = variant & 1;
                spec.znear = variant & 4 ? 0.1 : spec.ortho ? -20 : 3;
                spec.zfar = variant & 2 ? (double)INFINITY : 1000;
                spec.rounding = variant & 4 ? DP_ROUND_ZERO : DP_ROUND_NEAREST;
                if (dp_setup_init(&setup, &spec) != DP_OK)
                    continue;
                fill_codes(&r, spec.format.code_max, codes);
                fill_depths(&r, &setup, codes, z);
                for (size_t g = 0; g <= GRAINS; g++) {
                    compare_closed_form(&setup, g < GRAINS ? &grains[g] : NULL, z, exact);
                    compare_between(&setup, g < GRAINS ? &grains[g] : NULL, &r);
                }
            }
    print_message("# %zu of %zu are the cell's own\n", exact[0], exact[1]);
    assert_true(exact[1] > 100000 && exact[0] * 20 > exact[1] * 17);
}

/* Bits shifted up may have been k/256 as well as k/255: half a step before the one to half a step behind the other. */
TEST(shifted_up) {
    const grain g = {.kind = GRAIN_STEPS, .steps = 65535 / 256.0, .whole = 255, .rounding = GRAIN_NEAREST};
    dp_spec spec = dp_spec_default();
    dp_format format[2];
    dp_setup setup;
    assert_true(dp_format_parse("unorm16", format) >= 1);
    spec.format = format[0];
    spec.mapping = DP_MAPPING_LINEAR; /* z = 1000 d */
    spec.zfar = 1000;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    for (unsigned k = 1; k <= 128; k++) {
        const grain_range range = grain_range_of(&setup, &g, 256 * k);
        assert_relative(range.lo, 1000 * (k - 0.5) / 256, 1e-12);
        assert_relative(range.hi, 1000 * (k + 0.5) / 255, 1e-12);
    }
}

TEST(many_codes_say_what_each_says) {
    rng r = rng_make("grain");
    uint32_t codes[COUNT];
    double z[COUNT];
    dp_format wide[2];
    assert_int_equal(dp_format_parse("unorm28", wide), 1); /* more bits than a float: many codes are one number */
    for (size_t f = 0; f <= dp_format_count(); f++)
        for (int m = 0; m < DP_MAPPING_COUNT; m++)
            for (int variant = 0; variant < 3; variant++) {
                dp_spec spec = dp_spec_default();
                dp_setup setup;
                spec.format = f < dp_format_count() ? dp_format_get(f)->format : wide[0];
                spec.mapping = (dp_mapping)m;
                spec.zfar = variant == 1 ? (double)INFINITY : 1000;
                spec.rounding = variant == 2 ? DP_ROUND_ZERO : DP_ROUND_NEAREST;
                if (spec.format.bits > 31 || dp_setup_init(&setup, &spec) != DP_OK)
                    continue;
                fill_codes(&r, spec.format.code_max, codes);
                compare(&setup, NULL, codes);
                fill_depths(&r, &setup, codes, z);
                compare_errors(&setup, NULL, z);
                for (size_t g = 0; g < GRAINS; g++) {
                    compare(&setup, &grains[g], codes);
                    compare_errors(&setup, &grains[g], z);
                }
            }
}
