/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cells, stored depths, errors, intervals and separations against exact arithmetic (log: 384 bits). */
#include "oracle.h"
#include "support.h"

static const double bound = 1e-12;

/*
 * The logarithmic mapping is decided within 2^-90 relative, so a cell of its that is thinner than that fraction of z
 * (the cell of code_max that holds far alone, when truncating) has no width to be relative to.
 */
static double log_haze(int is_log, double z) {
    return is_log ? 0x1p-90 * z : 0;
}

/* ---- set-ups ---- */

static dp_format random_format(rng *r) {
    switch (rng_below(r, 10)) {
    case 0:
    case 1:
        return oracle_float(5, 10, 15);
    case 2:
    case 3:
    case 4:
        return oracle_float(8, 23, 127);
    case 5:
    case 6:
        return oracle_unorm(16);
    case 7:
        return oracle_unorm(24);
    case 8:
        return oracle_unorm(1 + (int)rng_below(r, 32));
    default: {
        int e = 2 + (int)rng_below(r, 7);
        return oracle_float(e, 1 + (int)rng_below(r, 23), 1 + (int)rng_below(r, (1u << e) - 1));
    }
    }
}

static void random_spec(rng *r, dp_spec *spec) {
    *spec = dp_spec_default();
    int kind = (int)rng_below(r, 13); /* 6 mappings, 4 orthographic, 3 infinite */
    spec->mapping = (dp_mapping)(kind < 6 ? kind : kind < 10 ? kind - 6 : kind - 10);
    spec->ortho = kind >= 6 && kind < 10;
    spec->format = random_format(r);
    spec->rounding = (dp_rounding)rng_below(r, DP_ROUNDING_COUNT);
    switch (rng_below(r, 4)) {
    case 0:
        spec->znear = rng_log(r, 0.01, 10);
        spec->zfar = spec->znear * rng_log(r, 2, 1e6);
        break;
    case 1: /* f/n = 1e9 */
        spec->znear = rng_log(r, 1e-3, 10);
        spec->zfar = spec->znear * 1e9;
        break;
    default:
        spec->znear = rng_log(r, 1e-12, 1e12);
        spec->zfar = spec->znear * (1 + rng_log(r, 1.0001e-6, 1e30));
    }
    if (kind >= 10)
        spec->zfar = INFINITY;
    if (spec->ortho && rng_below(r, 2))
        rng_planes(r, &spec->znear, &spec->zfar);
    spec->log_c = rng_below(r, 2) ? 1 : rng_log(r, 1e-6, 1e6);
    if (!isinf(spec->zfar))
        spec->zfar = fmin(spec->zfar, most_far(spec));
}

static double random_depth(rng *r, const dp_spec *spec) {
    double zfar = isinf(spec->zfar) ? spec->znear * 1e12 : spec->zfar;
    if (spec->znear <= 0)
        return rng_depth(r, spec->znear, spec->zfar);
    switch (rng_below(r, 8)) {
    case 0:
        return spec->znear;
    case 1:
        return zfar;
    case 2:
        return fmin(zfar, spec->znear * (1 + rng_log(r, 1e-16, 1)));
    case 3:
        return fmax(spec->znear, zfar * (1 - rng_log(r, 1e-16, 1)));
    case 4:
        return rng_uniform(r, spec->znear, zfar);
    default:
        return rng_log(r, spec->znear, zfar);
    }
}

typedef struct scene {
    dp_spec spec;
    dp_setup setup;
    oracle o;
    oracle_cell cell;
    char text[256];
} scene;

static void open_scene(scene *s) {
    oracle_describe(&s->spec, s->text, sizeof s->text);
    dp_status status = dp_setup_init(&s->setup, &s->spec);
    if (status != DP_OK)
        fail_msg("refused: %s: %s", dp_status_text(status), s->text);
    oracle_init(&s->o, &s->spec);
    oracle_cell_init(&s->cell);
}

static void close_scene(scene *s) {
    oracle_clear(&s->o);
    oracle_cell_clear(&s->cell);
}

/* ---- cells ---- */

static double log_bound(const scene *s) {
    return s->o.log ? 0x1p-45 : 0x1p-50;
}

static void check_number(tally *t, const scene *s, const char *what, uint32_t code, double got, int infinite,
                         const mpq_t want, double allowed) {
    double off = infinite ? (got > 0 && isinf(got) ? 0 : HUGE_VAL) : oracle_relative(got, want);
    if (!infinite && oracle_distance(got, want) < log_haze(s->o.log, fmax(s->spec.znear, oracle_double(s->cell.hi))))
        off = 0;
    TALLY(t, off <= allowed, "%s: %s of code %u is %.17g (%a), should be %.17g: off by %.3g relative", s->text, what,
          code, got, got, infinite ? HUGE_VAL : oracle_double(want), off);
}

static void check_cell(scene *s, uint32_t code, tally *t, tally *planes) {
    mpq_t width;
    mpq_init(width);
    dp_cell got = dp_cell_of(&s->setup, code);
    oracle_cell *want = &s->cell;
    oracle_cell_of(&s->o, want, code);
    TALLY(t, got.code == code, "%s: cell of %u names %u", s->text, code, got.code);
    check_number(t, s, "lo", code, got.lo, want->lo_infinite, want->lo, bound);
    check_number(t, s, "hi", code, got.hi, want->hi_infinite, want->hi, bound);
    check_number(t, s, "stored", code, got.stored, want->stored_infinite, want->stored, log_bound(s));
    double stored = dp_stored(&s->setup, code);
    TALLY(t, stored == got.stored, "%s: stored(%u) = %a but the cell says %a", s->text, code, stored, got.stored);
    TALLY(planes, got.lo >= s->spec.znear && got.hi <= s->spec.zfar && got.lo <= got.hi,
          "%s: cell of %u leaves the planes: %a .. %a", s->text, code, got.lo, got.hi);
    if (want->hi_infinite) {
        TALLY(t, isinf(got.width), "%s: width of code %u is %g, should be infinite", s->text, code, got.width);
    } else {
        mpq_sub(width, want->hi, want->lo);
        check_number(t, s, "width", code, got.width, 0, width, bound);
    }
    mpq_clear(width);
}

TEST(cells) {
    rng r = rng_make("cells");
    tally t = {.name = "cells"}, planes = {.name = "cells stay between the planes"};
    uint64_t cameras = test_cases(100, 4000, 20000);
    for (uint64_t i = 0; i < cameras; i++) {
        scene s;
        random_spec(&r, &s.spec);
        open_scene(&s);
        uint32_t max = s.spec.format.code_max, first = oracle_code(&s.o, s.spec.znear);
        uint32_t last = oracle_code(&s.o, s.spec.zfar);
        const uint32_t ends[] = {0, max,    first, last, first < max ? first + 1 : max, last > 0 ? last - 1 : 0,
                                 1, max - 1};
        for (int k = 0; k < 8; k++)
            check_cell(&s, ends[k], &t, &planes);
        for (int k = 0; k < 12; k++)
            check_cell(&s, (uint32_t)rng_below(&r, (uint64_t)max + 1), &t, &planes);
        for (int k = 0; k < 12; k++)
            check_cell(&s, oracle_code(&s.o, random_depth(&r, &s.spec)), &t, &planes);
        if (s.spec.format.kind == DP_FORMAT_FLOAT) { /* binade ends */
            for (int k = 0; k < 6; k++) {
                uint32_t step = 1u << s.spec.format.mantissa_bits;
                uint32_t end = step * (1 + (uint32_t)rng_below(&r, (uint64_t)s.spec.format.bias));
                check_cell(&s, end, &t, &planes);
                check_cell(&s, end - 1, &t, &planes);
                check_cell(&s, end < max ? end + 1 : max, &t, &planes);
            }
        }
        close_scene(&s);
    }
    tally_end(&t);
    tally_end(&planes);
}

/* Planes placed a hair from a cell's end, so that clipping leaves a sliver. */
TEST(slivers) {
    rng r = rng_make("slivers");
    tally t = {.name = "slivers"}, planes = {.name = "slivers stay between the planes"};
    mpq_t boundary, z;
    mpq_inits(boundary, z, NULL);
    uint64_t cameras = test_cases(100, 4000, 40000);
    for (uint64_t i = 0; i < cameras; i++) {
        scene s;
        random_spec(&r, &s.spec);
        s.spec.mapping = rng_below(&r, 2) ? DP_MAPPING_LINEAR : DP_MAPPING_LOG;
        s.spec.ortho = 0;
        if (s.spec.znear <= 0)
            s.spec.znear = rng_log(&r, 1e-12, 1e6);
        if (isinf(s.spec.zfar) || !(s.spec.zfar > 1.1 * s.spec.znear))
            s.spec.zfar = s.spec.znear * 1000;
        s.spec.zfar = fmin(s.spec.zfar, most_far(&s.spec));
        open_scene(&s);
        uint32_t code = oracle_code(&s.o, rng_log(&r, s.spec.znear, s.spec.zfar));
        if (code > 0) {
            oracle_boundary(boundary, &s.spec.format, s.spec.rounding, code);
            oracle_eye(&s.o, z, boundary);
            double znear = oracle_double(z) * (1 + (rng_unit(&r) - 0.5) * rng_log(&r, 1e-16, 1e-8));
            close_scene(&s);
            if (s.spec.zfar > 1e18 && znear * s.spec.zfar > 1e30)
                continue;
            if (!(znear >= 1e-12 && znear <= 1e12 && (s.spec.zfar - znear) / znear > 2e-6))
                continue;
            s.spec.znear = znear;
            open_scene(&s);
            check_cell(&s, code, &t, &planes);
            check_cell(&s, code - 1, &t, &planes);
        }
        close_scene(&s);
    }
    mpq_clears(boundary, z, NULL);
    tally_end(&t);
    tally_end(&planes);
}

/* ---- samples: errors and intervals ---- */

static void check_error(scene *s, uint32_t code, double z, double got, tally *t) {
    mpq_t want, at;
    mpq_inits(want, at, NULL);
    mpq_set_d(at, z);
    oracle_cell_of(&s->o, &s->cell, code);
    if (s->cell.stored_infinite) {
        TALLY(t, isinf(got) && got > 0, "%s: error of code %u at %a is %g, should be infinite", s->text, code, z, got);
    } else {
        mpq_sub(want, s->cell.stored, at);
        /* z outside the code's cell, or an unbounded cell: of the error itself */
        int unbounded = s->cell.hi_infinite || s->cell.lo_infinite;
        double interval = fmax(unbounded ? 0 : oracle_double(s->cell.whole), fabs(oracle_double(want)));
        double off = oracle_distance(got, want) / interval;
        if (oracle_distance(got, want) <= log_haze(s->o.log, z))
            off = 0;
        TALLY(t, off <= bound, "%s: error of code %u at %a is %.17g, should be %.17g: off by %.3g of the interval %g",
              s->text, code, z, got, oracle_double(want), off, interval);
        TALLY(t, mpq_sgn(want) != 0 || got == 0, "%s: error of code %u at %a is %g, which it stores exactly", s->text,
              code, z, got);
    }
    mpq_clears(want, at, NULL);
}

static void check_sample(scene *s, double z, tally *t) {
    mpq_t d, width;
    mpq_inits(d, width, NULL);
    dp_sample got;
    dp_status status = dp_sample_at(&s->setup, z, &got);
    TALLY(t, status == DP_OK, "%s: sample at %a: %s", s->text, z, dp_status_text(status));
    uint32_t code = oracle_code(&s->o, z);
    oracle_window(&s->o, d, z);
    TALLY(t, got.z == z && got.code == code, "%s: sample at %a has code %u, should be %u", s->text, z, got.code, code);
    TALLY(t, oracle_relative(got.depth, d) <= 0x1p-50, "%s: window depth at %a is %a", s->text, z, got.depth);
    check_error(s, code, z, got.error, t); /* leaves the cell of the code in s->cell */
    oracle_cell *want = &s->cell;
    check_number(t, s, "stored", code, got.stored, want->stored_infinite, want->stored, log_bound(s));
    check_number(t, s, "lo", code, got.lo, want->lo_infinite, want->lo, bound);
    check_number(t, s, "hi", code, got.hi, want->hi_infinite, want->hi, bound);
    mpq_sub(width, want->hi, want->lo);
    check_number(t, s, "interval", code, got.interval, want->hi_infinite, width, bound);

    /* the functions say the same, bit for bit */
    dp_cell cell = dp_cell_of(&s->setup, code);
    TALLY(t, got.lo == cell.lo && got.hi == cell.hi && got.interval == cell.width && got.stored == cell.stored,
          "%s: sample at %a and cell of %u differ", s->text, z, code);
    TALLY(t,
          got.depth == dp_window(&s->setup, z) && got.error == dp_error(&s->setup, code, z) &&
              got.separation == dp_separation(&s->setup, z),
          "%s: sample at %a differs from the functions", s->text, z);

    /* a neighbouring code's error too */
    if (code > 0)
        check_error(s, code - 1, z, dp_error(&s->setup, code - 1, z), t);
    mpq_clears(d, width, NULL);
}

/* What is stored less infinity: the far plane's own code is not off, any other is too near without end. */
static void check_infinity(const scene *s, uint32_t code, tally *t) {
    const dp_format *f = &s->spec.format;
    const uint32_t far = dp_mapping_get(s->spec.mapping)->reversed ? 0 : f->code_max;
    const double got = dp_error(&s->setup, code, INFINITY), want = code == far ? 0 : -INFINITY;
    TALLY(t, got == want, "%s: error of code %u at infinity is %g, should be %g", s->text, code, got, want);
}

TEST(samples) {
    rng r = rng_make("samples");
    tally t = {.name = "samples"};
    uint64_t cameras = test_cases(100, 4000, 20000);
    for (uint64_t i = 0; i < cameras; i++) {
        scene s;
        random_spec(&r, &s.spec);
        open_scene(&s);
        check_sample(&s, s.spec.znear, &t);
        if (!s.o.infinite)
            check_sample(&s, s.spec.zfar, &t);
        for (int k = 0; k < 3 && s.o.infinite; k++) {
            const uint32_t most = s.spec.format.code_max;
            check_infinity(&s, k == 0 ? 0 : k == 1 ? most : (uint32_t)rng_below(&r, most), &t);
        }
        for (int k = 0; k < 12; k++)
            check_sample(&s, random_depth(&r, &s.spec), &t);
        close_scene(&s);
    }
    tally_end(&t);
}

/* ---- stored depths come back ---- */

/*
 * The code of the stored depth is the code, for every code whose stored depth lies in [near, far]. The stored depth is
 * rounded to a double, so this is asked where half a cell is wider than that rounding; the others are counted.
 */
TEST(round_trips) {
    rng r = rng_make("round trips");
    tally t = {.name = "code(stored(code))"};
    uint64_t cameras = test_cases(4, 40, 60);
    for (uint64_t i = 0; i < cameras; i++) {
        scene s;
        do
            random_spec(&r, &s.spec);
        while (s.spec.format.bits > 24 && i % 4); /* three of four small enough for all codes */
        s.spec.rounding = i % 3 ? DP_ROUND_NEAREST : DP_ROUND_EVEN;
        if (i < 2) {
            s.spec = dp_spec_default();
            s.spec.format = oracle_unorm(24);
            s.spec.mapping = i ? DP_MAPPING_REVERSED : DP_MAPPING_D3D;
        }
        open_scene(&s);
        uint32_t max = s.spec.format.code_max;
        uint32_t stride = 1 + max / (uint32_t)test_cases(5000, i < 2 ? 20000000 : 200000, 20000000);
        for (uint64_t c = 0; c <= max; c += stride) {
            uint32_t code = (uint32_t)c;
            double z = dp_stored(&s.setup, code);
            if (!(z >= s.spec.znear && z <= s.spec.zfar))
                continue;
            double ulp = nextafter(z, INFINITY) - z;
            double err_lo, err_hi; /* how far the cell reaches to either side */
            dp_cell cell = dp_cell_of(&s.setup, code);
            err_lo = z - cell.lo;
            err_hi = cell.hi - z;
            int at_plane = z <= s.spec.znear + 64 * ulp || z >= s.spec.zfar - 64 * ulp;
            if (!at_plane && !(fmin(err_lo, err_hi) > 64 * ulp) && !isinf(z)) {
                t.skipped++;
                continue;
            }
            uint32_t got = dp_code(&s.setup, z);
            if (at_plane && cell.width <= 128 * ulp) {
                t.skipped++;
                continue;
            }
            TALLY(&t, got == code, "%s: code(stored(%u) = %a) = %u", s.text, code, z, got);
        }
        close_scene(&s);
    }
    tally_end(&t);
}

/* ---- separations ---- */

static void check_separation(scene *s, double z, tally *t) {
    mpq_t least, most;
    mpq_inits(least, most, NULL);
    int most_infinite;
    oracle_separation_kind kind = oracle_separation(&s->o, z, least, most, &most_infinite);
    double got = dp_separation(&s->setup, z);
    int right;
    if (kind == ORACLE_SEPARATION_NONE) {
        right = isinf(got) && got > 0;
    } else {
        right = oracle_relative(got, least) <= bound;
        if (right) {
            mpq_t x;
            mpq_init(x);
            mpq_set_d(x, got);
            right = mpq_cmp(x, least) >= 0;
            mpq_clear(x);
        } else if (kind == ORACLE_SEPARATION_EITHER) {
            right = most_infinite ? isinf(got) && got > 0 : oracle_relative(got, most) <= bound;
        }
    }
    TALLY(t, right, "%s: separation(%a = %.17g) = %.17g, should be %.17g (kind %d, or %.17g): off by %.3g relative",
          s->text, z, z, got, kind == ORACLE_SEPARATION_NONE ? HUGE_VAL : oracle_double(least), kind,
          most_infinite ? HUGE_VAL : oracle_double(most), (got - oracle_double(least)) / oracle_double(least));
    mpq_clears(least, most, NULL);
}

TEST(separations) {
    rng r = rng_make("separations");
    tally t = {.name = "separations"};
    mpq_t value;
    mpq_init(value);
    uint64_t cameras = test_cases(100, 6000, 30000);
    for (uint64_t i = 0; i < cameras; i++) {
        scene s;
        random_spec(&r, &s.spec);
        open_scene(&s);
        check_separation(&s, s.spec.znear, &t);
        if (!s.o.infinite)
            check_separation(&s, s.spec.zfar, &t);
        for (int k = 0; k < 16; k++)
            check_separation(&s, random_depth(&r, &s.spec), &t);
        for (int k = 0; k < 8; k++) { /* near the ends of binades */
            uint32_t code = oracle_code(&s.o, random_depth(&r, &s.spec));
            if (s.spec.format.kind == DP_FORMAT_FLOAT)
                code &= ~((1u << s.spec.format.mantissa_bits) - 1);
            code -= code > 0 && (k & 1);
            double z = dp_stored(&s.setup, code);
            if (z >= s.spec.znear && z <= s.spec.zfar && !isinf(z)) {
                check_separation(&s, z, &t);
                z *= 1 + (rng_unit(&r) - 0.5) * rng_log(&r, 1e-10, 1e-2);
                if (z >= s.spec.znear && z <= s.spec.zfar)
                    check_separation(&s, z, &t);
            }
        }
        close_scene(&s);
    }
    mpq_clear(value);
    tally_end(&t);
}

/* Behind: a larger code, or a smaller one when reversed. */
static int is_behind(const scene *s, uint32_t code, uint32_t than) {
    return s->o.reversed ? code < than : code > than;
}

/*
 * The guarantee: a surface a hair beyond z + s(z) has a code behind z's. And it is not slack: the depth just behind a
 * rounding boundary shares its code with depths up to almost s behind it (a step), never less than half of s.
 */
TEST(guarantee) {
    rng r = rng_make("guarantee");
    tally behind = {.name = "behind z + s is a code behind"}, tight = {.name = "s is needed"};
    mpq_t boundary, z, at, hair;
    mpq_inits(boundary, z, at, hair, NULL);
    uint64_t cameras = test_cases(100, 6000, 30000);
    for (uint64_t i = 0; i < cameras; i++) {
        scene s;
        random_spec(&r, &s.spec);
        open_scene(&s);
        for (int k = 0; k < 16; k++) {
            double depth = random_depth(&r, &s.spec);
            uint32_t code = oracle_code(&s.o, depth);
            int aimed = code > 0 && (k & 1); /* just behind a boundary, where the most of s is needed */
            if (aimed) {
                oracle_boundary(boundary, &s.spec.format, s.spec.rounding, code);
                double aim = oracle_eye_below(&s.o, mpq_numref(boundary), mpq_denref(boundary));
                aimed = aim >= s.spec.znear && nextafter(aim, INFINITY) <= s.spec.zfar;
                if (aimed) {
                    depth = nextafter(aim, INFINITY);
                    code = oracle_code(&s.o, depth);
                }
            }
            double separation = dp_separation(&s.setup, depth);
            if (isinf(separation))
                continue;
            mpq_set_d(at, depth);
            mpq_set_d(z, separation);
            mpq_set_ui(hair, 1, 1);
            mpq_div_2exp(hair, hair, 200);
            mpq_mul(hair, hair, z);
            mpq_add(z, z, at);
            mpq_add(z, z, hair);
            if (s.o.infinite || mpq_cmp(z, s.o.zfar) <= 0) {
                uint32_t other = oracle_code_q(&s.o, z);
                TALLY(&behind, is_behind(&s, other, code), "%s: codes %u and %u at %a and %g behind it", s.text, code,
                      other, depth, separation);
            }
            /*
             * 0.49 s behind a boundary is the same code, as long as doubles are much finer than s, and the step so
             * fine that half of it in d is about half of s in z: half is what truncation needs before a binade end
             */
            int fine = s.spec.format.kind == DP_FORMAT_UNORM || s.spec.format.mantissa_bits >= 10;
            if (aimed && fine && separation > 4096 * (nextafter(fabs(depth), HUGE_VAL) - fabs(depth))) {
                mpq_set_d(z, (s.spec.format.kind == DP_FORMAT_UNORM ? 0.99 : 0.49) * separation);
                mpq_add(z, z, at);
                if (!s.o.infinite && mpq_cmp(z, s.o.zfar) > 0)
                    continue;
                uint32_t other = oracle_code_q(&s.o, z);
                TALLY(&tight, other == code, "%s: codes %u and %u at %a and 0.49 of %g behind it", s.text, code, other,
                      depth, separation);
            }
        }
        close_scene(&s);
    }
    mpq_clears(boundary, z, at, hair, NULL);
    tally_end(&behind);
    tally_end(&tight);
}
