/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Points: what becomes of one vertex. */
#include <math.h>
#include <stddef.h>

#include "core/bits.h"
#include "core/elementary.h"
#include "depthprec/arith.h"
#include "depthprec/format.h"
#include "depthprec/pipeline.h"
#include "probe/judge.h"

/* ---- The format that is stored ----------------------------------------------------------------------------------- */

/* Two depths of one code are equal in the buffer if it holds codes, and differ if it holds more. Where a browser reads
 * depths as a texture, what was asked for as codes may come back as the binary32 that was drawn: that is what is
 * stored. */
static void judge_stored(probe_result *r, shot_format format) {
    const shot *s = judge_shot(r, PLAN_STORED, format);
    const bool whole = plan_scale(format) > 0.0;
    uint64_t same = 0;
    if (s == NULL)
        return;
    for (uint32_t i = 0; i < s->count; i++)
        same += s->code[i] == dp_bits32(judge_clip(s, s->vertex[i]));
    const bool real = same == s->count && (whole || s->passed == 0);
    const uint64_t hits = real || !whole ? same : s->passed <= s->count ? s->passed : 0;
    const bool all = real || (whole && (hits == s->count || (hits > 0 && !r->machine.counts)));
    probe_finding *f =
        judge_say(r, "stored", probe_format_name(real ? SHOT_D32F : format), all ? PROBE_SURE : PROBE_NO_ROW, "%s: %s",
                  r->machine.device[r->machine.chosen].format[format],
                  real                 ? "every bit of binary32"
                  : all                ? "codes of that many bits, nothing finer"
                  : whole && hits == 0 ? "finer than its codes: depths of one code are distinguished"
                                       : "neither its codes nor finer ones throughout");
    f->cases = s->count;
    f->hits = hits;
}

/* ---- Rounding ---------------------------------------------------------------------------------------------------- */

/* The conversions that rows of core/arith.c have, then others. The only tie, d = 1/2, goes to 2^(N-1), which is both up
 * and even. */
enum { EXACT, PRODUCT_EVEN, PRODUCT_ZERO, SIXTEENTHS, EXACT_ZERO, PRODUCT_HALF, CONVERSIONS };

static const char *const conversion_words[CONVERSIONS] = {
    [EXACT] = "the exact d (2^N - 1), to nearest",
    [PRODUCT_EVEN] = "the binary32 product d (2^N - 1), to nearest even",
    [PRODUCT_ZERO] = "the binary32 product d (2^N - 1), truncated",
    [SIXTEENTHS] = "2^N d less d, both cut to sixteenths",
    [EXACT_ZERO] = "the exact d (2^N - 1), truncated",
    [PRODUCT_HALF] = "the binary32 product d (2^N - 1) plus 1/2, truncated",
};

static uint32_t converted(const dp_format *format, int conversion, float d) {
    const float product = d * (float)format->code_max, moved = product + 0.5F;
    const float whole =
        conversion == PRODUCT_EVEN ? rintf(product) : truncf(conversion == PRODUCT_HALF ? moved : product);
    switch (conversion) {
    case EXACT:
        return dp_format_encode(format, DP_ROUND_NEAREST, (double)d);
    case SIXTEENTHS: {
        const dp_arith_row row = {.conversion = DP_CONVERT_SIXTEENTHS};
        return dp_pipeline_convert(&(dp_pipeline){.format = *format, .arith = &row}, d);
    }
    case EXACT_ZERO:
        return dp_format_encode(format, DP_ROUND_ZERO, (double)d);
    default:
        return whole < (float)format->code_max ? (uint32_t)whole : format->code_max;
    }
}

/* The conversions that predict every code, a bit each; all of them where the device has not the format. In 24 bits the
 * two that truncate are one function: d (2^24 - 1) = 2^24 d - d never rounds up to a whole number. */
static unsigned judge_rounding(probe_result *r, shot_format format) {
    const shot *s = judge_shot(r, PLAN_ROUNDING, format);
    guess all[CONVERSIONS];
    dp_format f[2];
    unsigned perfect = 0;
    if (s == NULL || dp_format_parse(probe_format_name(format), f) != 1)
        return (1U << CONVERSIONS) - 1U;
    for (int c = 0; c < CONVERSIONS; c++) {
        all[c] = (guess){conversion_words[c], 0};
        for (uint32_t i = 0; i < s->count; i++)
            all[c].hits += converted(&f[0], c, judge_clip(s, s->vertex[i])) == s->code[i];
        perfect |= all[c].hits == s->count ? 1U << c : 0U;
    }
    judge_guesses(r, "rounding", probe_format_name(format), all, CONVERSIONS, s->count);
    return perfect;
}

/* ---- Division and projection ------------------------------------------------------------------------------------- */

/* The kinds of dp_reciprocal; and again, where clip z from -w to w is moved to [0, 1] after it, not before. */
enum { KINDS = DP_RECIPROCAL_UNIT + 1, DIVISIONS = 2 * KINDS };

static float window(const shot *s, int division, float z, float w) {
    const bool after = division >= KINDS;
    const dp_arith_row row = {.reciprocal = (dp_reciprocal)(division % KINDS)};
    const float clip = after ? z : judge_clip(s, (const float[]){0.0F, 0.0F, z, w});
    const float d = dp_pipeline_divide(&(dp_pipeline){.arith = &row}, clip, w);
    return after ? d * 0.5F + 0.5F : d;
}

static int judge_division(probe_result *r) {
    const shot *s = judge_shot(r, PLAN_DIVISION, SHOT_D32F);
    static const char *const words[2][DIVISIONS] = {
        {"clip z / w, rounded once", "clip z times the rounded 1 / w", "clip z times NVIDIA's 1 / w"},
        {"(clip z + w)/2 / w, each rounded", "(clip z + w)/2 times the rounded 1 / w",
         "(clip z + w)/2 times NVIDIA's 1 / w", "clip z / w, rounded once, then times 1/2, plus 1/2",
         "clip z times the rounded 1 / w, then times 1/2, plus 1/2",
         "clip z times NVIDIA's 1 / w, then times 1/2, plus 1/2"}};
    guess all[DIVISIONS];
    if (s == NULL)
        return JUDGE_NONE;
    const int count = s->ndc_signed ? DIVISIONS : KINDS;
    for (int d = 0; d < count; d++) {
        all[d] = (guess){words[s->ndc_signed][d], 0};
        for (uint32_t i = 0; i < s->count; i++)
            all[d].hits += dp_bits32(window(s, d, s->vertex[i][2], s->vertex[i][3])) == s->code[i];
    }
    return judge_guesses(r, "division", NULL, all, (size_t)count, s->count);
}

static int judge_projection(probe_result *r, int division) {
    const shot *s = judge_shot(r, PLAN_PROJECTION, SHOT_D32F);
    guess all[2] = {{"A z, then + B, each rounded", 0}, {"A z + B fused, rounded once", 0}};
    if (s == NULL || division == JUDGE_NONE)
        return JUDGE_NONE;
    for (uint32_t i = 0; i < s->count; i++) {
        const float z = s->vertex[i][2], w = s->vertex[i][3], product = s->a * z;
        all[0].hits += dp_bits32(window(s, division, product + s->b, w)) == s->code[i];
        all[1].hits += dp_bits32(window(s, division, fmaf(s->a, z, s->b), w)) == s->code[i];
    }
    return judge_guesses(r, "projection", NULL, all, 2, s->count);
}

/* ---- Planes ------------------------------------------------------------------------------------------------------ */

static bool is_drawn(const shot *s, uint32_t i) {
    return s->code[i] != dp_bits32(SHOT_CLEAR);
}

static void judge_planes(probe_result *r) {
    const shot *s = judge_shot(r, PLAN_PLANES, SHOT_D32F);
    guess clip[] = {{"drawn where 0 <= z <= w, exactly", 0},
                    {"drawn where 0 < z <= w", 0},
                    {"drawn where 0 <= z < w", 0},
                    {"drawn everywhere, clamped", 0}};
    guess tiny[] = {{"kept", 0}, {"flushed to zero", 0}, {"not drawn", 0}};
    uint64_t normal = 0, subnormal = 0;
    if (s == NULL)
        return;
    for (uint32_t i = 0; i < s->count; i++) {
        const float z = s->vertex[i][2], w = s->vertex[i][3];
        if (z > 0.0F && z < 0x1p-126F) {
            subnormal++;
            tiny[0].hits += s->code[i] == dp_bits32(z);
            tiny[1].hits += s->code[i] == 0;
            tiny[2].hits += !is_drawn(s, i);
            continue;
        }
        normal++;
        clip[0].hits += is_drawn(s, i) == (0.0F <= z && z <= w);
        clip[1].hits += is_drawn(s, i) == (0.0F < z && z <= w);
        clip[2].hits += is_drawn(s, i) == (0.0F <= z && z < w);
        clip[3].hits += is_drawn(s, i);
    }
    judge_guesses(r, "clipping", NULL, clip, sizeof clip / sizeof clip[0], normal);
    judge_guesses(r, "subnormal", NULL, tiny, sizeof tiny / sizeof tiny[0], subnormal);
}

/* ---- Two pipelines, and functions of the language ---------------------------------------------------------------- */

static void judge_invariance(probe_result *r) {
    const shot *s = judge_shot(r, PLAN_INVARIANCE, SHOT_D32F);
    if (s == NULL)
        return;
    const bool same = s->passed == s->count;
    probe_finding *f = judge_say(r, "invariance", NULL,
                                 same                ? PROBE_SURE
                                 : r->machine.counts ? PROBE_NO_ROW
                                                     : PROBE_OPEN,
                                 "%s",
                                 same                ? "two pipelines of one expression store the same depths"
                                 : r->machine.counts ? "two pipelines of one expression store other depths"
                                                     : "the device does not count how many depths are the same");
    f->cases = s->count;
    f->hits = s->passed;
}

/* The greatest error of what was stored, in units of the last place of the true value, or absolute. */
static double worst(const shot *s, double (*truth)(const float *v), double scale, bool (*taken)(const float *v),
                    bool absolute, uint64_t *cases) {
    double most = 0.0;
    *cases = 0;
    for (uint32_t i = 0; i < s->count; i++) {
        if (!taken(s->vertex[i]))
            continue;
        const double true_value = truth(s->vertex[i]);
        const double off = fabs((double)dp_float32(s->code[i]) / scale - true_value);
        ++*cases;
        most = fmax(most, absolute ? off : off / ldexp(1.0, ilogb(true_value) - 23));
    }
    return most;
}

static double log2_of(const float *v) {
    return dp_log2((double)v[2]);
}

static double quotient_of(const float *v) {
    return (double)v[2] / (double)v[3];
}

static bool is_small(const float *v) {
    return v[2] <= 2.0F;
}

static bool is_large(const float *v) {
    return v[2] > 2.0F;
}

static bool is_any(const float *v) {
    (void)v;
    return true;
}

static void judge_functions(probe_result *r) {
    static const struct {
        plan_shot shot;
        const char *key, *words, *unit;
        double (*truth)(const float *);
        bool (*taken)(const float *);
        double scale;
        bool absolute;
    } all[] = {
        {PLAN_LOG2, "log2", "x in [1, 2], absolute; Vulkan allows 2^-21 = 4.8e-07", "", log2_of, is_small,
         (double)PLAN_LOG2_SCALE, true},
        {PLAN_LOG2, "log2", "x in [2, 2^64]; Vulkan allows 3 ulp", "ulp", log2_of, is_large, (double)PLAN_LOG2_SCALE,
         false},
        {PLAN_QUOTIENT, "quotient", "x / y in a shader; Vulkan allows 2.5 ulp", "ulp", quotient_of, is_any, 1.0, false},
    };
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        const shot *s = judge_shot(r, all[i].shot, SHOT_D32F);
        if (s == NULL)
            continue;
        probe_finding *f = judge_say(r, all[i].key, NULL, PROBE_MEASURED, "%s", all[i].words);
        f->value = worst(s, all[i].truth, all[i].scale, all[i].taken, all[i].absolute, &f->cases);
        f->unit = all[i].unit;
    }
}

/* ---- The row ----------------------------------------------------------------------------------------------------- */

/* Where one conversion alone is right of every format. */
static const char *row_of(unsigned conversions, int division, int is_fused, bool remap) {
    static const dp_conversion known[] = {[EXACT] = DP_CONVERT_EXACT,
                                          [PRODUCT_EVEN] = DP_CONVERT_PRODUCT_EVEN,
                                          [PRODUCT_ZERO] = DP_CONVERT_PRODUCT_ZERO,
                                          [SIXTEENTHS] = DP_CONVERT_SIXTEENTHS};
    if (division == JUDGE_NONE || is_fused == JUDGE_NONE)
        return NULL;
    for (dp_arith i = 0; i < dp_arith_count(); i++) {
        const dp_arith_row *row = dp_arith_get(i);
        for (int c = EXACT; c <= SIXTEENTHS; c++)
            if (conversions == 1U << c && row->remap == (remap && division < KINDS) && row->fused == is_fused &&
                row->reciprocal == (dp_reciprocal)(division % KINDS) && row->conversion == known[c])
                return row->name;
    }
    return NULL;
}

void judge_points(probe_result *r) {
    for (int f = 0; f < SHOT_FORMATS; f++)
        judge_stored(r, (shot_format)f);
    const unsigned d16 = judge_rounding(r, SHOT_D16), d24 = judge_rounding(r, SHOT_D24);
    const int division = judge_division(r);
    const int is_fused = judge_projection(r, division);
    r->arith = row_of(d16 & d24, division, is_fused, r->plan.shot[0].ndc_signed);
    judge_planes(r);
    judge_invariance(r);
    judge_functions(r);
}
