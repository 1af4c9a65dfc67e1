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
        judge_say(r, KEY_STORED, probe_format_name(real ? SHOT_D32F : format), all ? PROBE_SURE : PROBE_NO_ROW,
                  "%s: %s", r->machine.device[r->machine.chosen].format[format],
                  probe_hypothesis(KEY_STORED, real                 ? 0
                                               : all                ? 1
                                               : whole && hits == 0 ? 2
                                                                    : 3));
    f->cases = s->count;
    f->hits = hits;
}

/* ---- Rounding ---------------------------------------------------------------------------------------------------- */

/* The conversions that rows of core/arith.c have, then others. The only tie, d = 1/2, goes to 2^(N-1), which is both up
 * and even. */
enum { EXACT, PRODUCT_EVEN, PRODUCT_ZERO, SIXTEENTHS, EXACT_ZERO, PRODUCT_HALF, CONVERSIONS };

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
    judge_words(all, KEY_ROUNDING, 0, CONVERSIONS);
    for (int c = 0; c < CONVERSIONS; c++) {
        for (uint32_t i = 0; i < s->count; i++)
            all[c].hits += converted(&f[0], c, judge_clip(s, s->vertex[i])) == s->code[i];
        perfect |= all[c].hits == s->count ? 1U << c : 0U;
    }
    judge_guesses(r, KEY_ROUNDING, probe_format_name(format), all, CONVERSIONS, s->count);
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
    guess all[DIVISIONS];
    if (s == NULL)
        return JUDGE_NONE;
    const int count = s->ndc_signed ? DIVISIONS : KINDS;
    judge_words(all, KEY_DIVISION, s->ndc_signed ? DIVISION_SIGNED : 0, (size_t)count);
    for (int d = 0; d < count; d++)
        for (uint32_t i = 0; i < s->count; i++)
            all[d].hits += dp_bits32(window(s, d, s->vertex[i][2], s->vertex[i][3])) == s->code[i];
    return judge_guesses(r, KEY_DIVISION, NULL, all, (size_t)count, s->count);
}

static int judge_projection(probe_result *r, int division) {
    const shot *s = judge_shot(r, PLAN_PROJECTION, SHOT_D32F);
    guess all[2];
    if (s == NULL || division == JUDGE_NONE)
        return JUDGE_NONE;
    judge_words(all, KEY_PROJECTION, 0, 2);
    for (uint32_t i = 0; i < s->count; i++) {
        const float z = s->vertex[i][2], w = s->vertex[i][3], product = s->a * z;
        all[0].hits += dp_bits32(window(s, division, product + s->b, w)) == s->code[i];
        all[1].hits += dp_bits32(window(s, division, fmaf(s->a, z, s->b), w)) == s->code[i];
    }
    return judge_guesses(r, KEY_PROJECTION, NULL, all, 2, s->count);
}

/* ---- Planes ------------------------------------------------------------------------------------------------------ */

static bool is_drawn(const shot *s, uint32_t i) {
    return s->code[i] != dp_bits32(SHOT_CLEAR);
}

static void judge_planes(probe_result *r) {
    const shot *s = judge_shot(r, PLAN_PLANES, SHOT_D32F);
    guess clip[4], tiny[3];
    uint64_t normal = 0, subnormal = 0;
    if (s == NULL)
        return;
    judge_words(clip, KEY_CLIPPING, 0, 4);
    judge_words(tiny, KEY_SUBNORMAL, 0, 3);
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
    judge_guesses(r, KEY_CLIPPING, NULL, clip, 4, normal);
    judge_guesses(r, KEY_SUBNORMAL, NULL, tiny, 3, subnormal);
}

/* ---- Two pipelines, and functions of the language ---------------------------------------------------------------- */

static void judge_invariance(probe_result *r) {
    const shot *s = judge_shot(r, PLAN_INVARIANCE, SHOT_D32F);
    if (s == NULL)
        return;
    const bool same = s->passed == s->count;
    const bool counts = r->machine.counts;
    probe_finding *f = judge_say(r, KEY_INVARIANCE, NULL,
                                 same     ? PROBE_SURE
                                 : counts ? PROBE_NO_ROW
                                          : PROBE_OPEN,
                                 "%s",
                                 probe_hypothesis(KEY_INVARIANCE, same     ? 0
                                                                  : counts ? 1
                                                                           : 2));
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
        probe_key key;
        size_t words;
        double (*truth)(const float *);
        bool (*taken)(const float *);
        double scale;
    } all[] = {
        {PLAN_LOG2, KEY_LOG2, 0, log2_of, is_small, (double)PLAN_LOG2_SCALE},
        {PLAN_LOG2, KEY_LOG2, 1, log2_of, is_large, (double)PLAN_LOG2_SCALE},
        {PLAN_QUOTIENT, KEY_QUOTIENT, 0, quotient_of, is_any, 1.0},
    };
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        const shot *s = judge_shot(r, all[i].shot, SHOT_D32F);
        if (s == NULL)
            continue;
        probe_finding *f =
            judge_say(r, all[i].key, NULL, PROBE_MEASURED, "%s", probe_hypothesis(all[i].key, all[i].words));
        f->unit = probe_unit(all[i].key, all[i].words);
        f->value = worst(s, all[i].truth, all[i].scale, all[i].taken, f->unit[0] == '\0', &f->cases);
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
