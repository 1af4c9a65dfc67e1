/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Statistics of depth images against plain counts over sorted codes, and against what the rational oracle stores: the
 * sky, the codes in use, the nearest depths, the decals that fight.
 */
#include "named.h"
#include "oracle.h"
#include "support.h"
#include "synthetic_stage.h"
#include "texture/survey.h"

enum { WIDTH = 640, HEIGHT = 360, PIXELS = WIDTH * HEIGHT };

static void stage_set(synthetic_stage *s, const char *synthetic, const char *format, const char *mapping, double znear,
                      double zfar) {
    synthetic_stage_between(s, synthetic, format, mapping, znear, zfar, znear <= 0, WIDTH, HEIGHT);
    s->frame.threads = 2;
}

static const struct {
    const char *format, *mapping;
    double znear, zfar; /* near <= 0: orthographic */
} setups[] = {{"unorm16", "d3d", 0.1, 1000},    {"unorm24", "d3d", 0.1, 1000}, {"unorm24", "reversed", 0.1, INFINITY},
              {"fp16", "reversed", 0.1, 500},   {"fp32", "d3d", 0.1, 1000},    {"fp32", "reversed", 0.1, INFINITY},
              {"fp32", "linear", 0.1, 1000},    {"unorm24", "log", 0.1, 1000}, {"unorm16", "d3d", 0, 500},
              {"unorm16", "reversed", -3, 500}, {"fp32", "gl", -400, 500}};
enum { SETUPS = sizeof setups / sizeof setups[0] };

/* ---- The sky ---- */

static double distance_to_far(const dp_setup *setup, uint32_t code) {
    const double d = dp_format_value(&setup->spec.format, code);
    return setup->reversed ? d : 1 - d;
}

TEST(sky_begins_where_the_threshold_is) {
    static const double limits[] = {0, 1e-9, 1e-5, 1e-4, 0.01, 0.5};
    for (size_t k = 0; k < SETUPS; k += test_cases(3, 1, 1))
        for (size_t i = 0; i < 6; i++) {
            synthetic_stage s;
            stage_set(&s, "plane", setups[k].format, setups[k].mapping, setups[k].znear, setups[k].zfar);
            s.frame.sky = limits[i];
            const dp_setup *setup = &s.camera.setup;
            const uint32_t rank = frame_sky_rank(&s.frame);
            assert_true(distance_to_far(setup, frame_code(setup, rank)) <= limits[i]);
            assert_true(rank == 0 || distance_to_far(setup, frame_code(setup, rank - 1)) > limits[i]);
            /* Depths on either side of what the survey says, as the oracle stores them. */
            survey v;
            assert_true(survey_make(&s.frame, &v));
            oracle o;
            oracle_init(&o, &setup->spec);
            if (v.sky_from > setup->spec.znear)
                assert_true(distance_to_far(setup, oracle_code(&o, v.sky_from * (1 - 1e-9))) > limits[i]);
            if (v.sky_from * (1 + 1e-9) <= setup->spec.zfar)
                assert_true(distance_to_far(setup, oracle_code(&o, v.sky_from * (1 + 1e-9))) <= limits[i]);
            oracle_clear(&o);
        }
}

/* ---- Counts ---- */

static int ascending(const void *a, const void *b) {
    const uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return (x > y) - (x < y);
}

/* The eye depth of a rank, exactly as far as the oracle goes, and the difference of two. */
static double gap_of(oracle *o, const dp_setup *setup, uint32_t near, uint32_t far) {
    mpq_t a, b, d;
    mpq_inits(a, b, d, NULL);
    oracle_value(d, &setup->spec.format, frame_code(setup, near));
    assert_true(oracle_eye(o, a, d));
    oracle_value(d, &setup->spec.format, frame_code(setup, far));
    assert_true(oracle_eye(o, b, d));
    mpq_sub(d, b, a);
    const double gap = oracle_double(d);
    mpq_clears(a, b, d, NULL);
    return gap;
}

/* The codes that a band can have, one by one; of a format with too many, those that were counted. */
static uint64_t there(const synthetic_stage *s, const survey_band *band) {
    const dp_setup *setup = &s->camera.setup;
    const bool first = band->lo == setup->spec.znear; /* with what is stored nearer than the near plane */
    uint64_t codes = 0;
    if (setup->spec.format.code_max > 0xFFFF)
        return band->available;
    for (uint32_t rank = frame_sky_rank(&s->frame); rank-- > 0;) {
        const double z = dp_stored(setup, frame_code(setup, rank));
        codes += (first || z >= band->lo) && z < band->hi;
    }
    return codes;
}

static void check_bands(const synthetic_stage *s, const survey *v, const uint32_t *ranks, size_t count) {
    const dp_setup *setup = &s->camera.setup;
    oracle o;
    uint64_t pixels = 0, codes = 0;
    oracle_init(&o, &setup->spec);
    for (size_t b = 0; b < v->band_count; b++) {
        const survey_band *band = &v->bands[b];
        uint64_t here = 0, different = 0, steps = 0;
        double gap = NAN;
        assert_true(b == 0 || band->lo == v->bands[b - 1].hi);
        for (size_t i = 0; i < count; i++) {
            const double z = dp_stored(setup, frame_code(setup, ranks[i]));
            const bool first = b == 0 && z < band->lo;
            if (!(z >= band->lo || first) || !(z < band->hi))
                continue;
            here++;
            const bool fresh = i == 0 || ranks[i] != ranks[i - 1];
            if (fresh && different++ > 0) {
                const double found = gap_of(&o, setup, ranks[i - 1], ranks[i]);
                if (!(found >= gap)) {
                    gap = found;
                    steps = ranks[i] - ranks[i - 1];
                }
            }
        }
        assert_int_equal(band->pixels, here);
        assert_int_equal(band->codes, different);
        assert_true(band->available >= different && band->available == there(s, band));
        assert_int_equal(isnan(band->gap), different < 2);
        if (different >= 2) {
            const double tolerance = setup->spec.mapping == DP_MAPPING_LOG ? 1e-9 : 1e-12;
            assert_relative(band->gap, gap, tolerance);
            assert_int_equal(band->steps, steps);
            assert_true(band->interval > 0 && band->gap > 0.49 * band->interval * (double)steps);
        }
        pixels += here;
        codes += different;
    }
    assert_int_equal(pixels, count);
    assert_int_equal(codes, v->codes);
    oracle_clear(&o);
}

TEST(counts_are_those_of_sorted_codes) {
    static const char *const scenes[] = {"plane", "sphere", "decals"};
    uint32_t *codes = malloc(PIXELS * sizeof *codes);
    assert_non_null(codes);
    for (size_t k = 0; k < SETUPS; k += test_cases(3, 1, 1))
        for (size_t c = 0; c < 3; c++) {
            synthetic_stage s;
            survey v, alone;
            size_t count = 0, true_sky = 0;
            stage_set(&s, scenes[c], setups[k].format, setups[k].mapping, setups[k].znear, setups[k].zfar);
            if (c == 0)
                s.parameters[1] = 55;
            const uint32_t sky = frame_sky_rank(&s.frame);
            for (uint32_t y = 0; y < HEIGHT; y++)
                for (uint32_t x = 0; x < WIDTH; x++) {
                    synthetic_hit h;
                    s.frame.synthetic->hit(&s.camera, s.parameters, x, y, &h);
                    const uint32_t rank = frame_rank(&s.camera.setup, dp_code(&s.camera.setup, h.z));
                    true_sky += h.surface == 0;
                    if (rank < sky)
                        codes[count++] = rank;
                }
            qsort(codes, count, sizeof *codes, ascending);
            assert_true(survey_make(&s.frame, &v));
            s.frame.threads = 1;
            memset(&alone, 0, sizeof alone);
            assert_true(survey_make(&s.frame, &alone));
            assert_int_equal(alone.codes, v.codes);
            assert_int_equal(alone.band_count, v.band_count);
            assert_int_equal(v.pixels, PIXELS);
            assert_int_equal(v.sky, PIXELS - count);
            assert_int_equal(v.true_sky, true_sky);
            assert_int_equal(v.invalid, 0);
            if (count == 0) {
                assert_true(isnan(v.lo) && v.band_count == 0);
                continue;
            }
            assert_true(v.lo == dp_stored(&s.camera.setup, frame_code(&s.camera.setup, codes[0])));
            assert_true(v.hi == dp_stored(&s.camera.setup, frame_code(&s.camera.setup, codes[count - 1])));
            check_bands(&s, &v, codes, count);
        }
    free(codes);
}

/* ---- Decals ---- */

TEST(decals_fight_as_the_oracle_says) {
    static const double gaps[] = {1e-5, 1e-3, 0.01, 0.1, 1};
    tally t = {.name = "decals"};
    uint64_t fought = 0, stood = 0;
    for (size_t k = 0; k < SETUPS; k += test_cases(3, 1, 1))
        for (size_t g = 0; g < 5; g++) {
            synthetic_stage s;
            survey_pairs found;
            uint64_t ties = 0, seen = 0, tiles = 0;
            double first = NAN;
            oracle o;
            stage_set(&s, "decals", setups[k].format, setups[k].mapping, setups[k].znear, setups[k].zfar);
            s.parameters[0] = gaps[g];
            s.parameters[1] = 1.5;
            s.parameters[2] = 450;
            oracle_init(&o, &s.camera.setup.spec);
            assert_true(survey_pairs_make(&s.frame, &found));
            for (int tile = 0; tile < 64; tile++) {
                /* The depths as the image has them: the middle of the tile, and its corner. */
                const uint32_t x = (uint32_t)(tile % 8) * 80, y = (uint32_t)(tile / 8) * 45;
                synthetic_hit front, back;
                uint32_t row[WIDTH], corner[WIDTH];
                s.frame.synthetic->hit(&s.camera, s.parameters, x + 40, y + 22, &front);
                s.frame.synthetic->hit(&s.camera, s.parameters, x, y, &back);
                frame_codes(&s.frame, y + 22, row);
                frame_codes(&s.frame, y, corner);
                const bool tie = oracle_code(&o, front.z) == oracle_code(&o, back.z);
                TALLY(&t, fabs(front.z + gaps[g] - back.z) <= 0x1p-52 * back.z, "the gap is %g", back.z - front.z);
                TALLY(&t, tie == (row[x + 40] == corner[x]), "%s: tile %d", setups[k].format, tile);
                /* A tie is no surprise: the separation says where there may be one. */
                TALLY(&t, !tie || back.z - front.z < dp_separation(&s.camera.setup, front.z), "%s %s: a tie at %g",
                      setups[k].format, setups[k].mapping, front.z);
                TALLY(&t, !(front.z <= found.certain_to) || !tie, "a tie where none can be");
                if (tie && !(front.z >= first))
                    first = front.z;
                ties += tie;
                tiles++;
                seen += back.z - front.z < dp_separation(&s.camera.setup, front.z);
            }
            TALLY(&t, found.pairs == tiles && found.ties == ties && found.possible == seen && seen >= ties,
                  "%s %s gap %g: %llu ties of %llu, not %llu", setups[k].format, setups[k].mapping, gaps[g],
                  (unsigned long long)found.ties, (unsigned long long)found.pairs, (unsigned long long)ties);
            TALLY(&t, found.first_tie == first || (isnan(first) && isnan(found.first_tie)), "the first tie");
            fought += ties;
            stood += tiles - ties;
            oracle_clear(&o);
        }
    assert_true(fought > 200 && stood > 200);
    tally_end(&t);
}

TEST(scenes_without_pairs_say_so) {
    synthetic_stage s;
    survey_pairs found;
    stage_set(&s, "sphere", "fp32", "d3d", 0.1, 1000);
    assert_false(survey_pairs_make(&s.frame, &found));
    stage_set(&s, "steps", "fp32", "d3d", 0.1, 1000);
    assert_true(survey_pairs_make(&s.frame, &found));
    assert_int_equal(found.pairs, 15);
}
