/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "judge/candidate.h"

#include <math.h>

enum { LOG_STEPS = 64, PROBES = 512 };

double judge_value_at(const judge_candidate *c, judge_depth at) {
    if (c->trap != NULL) {
        const trap_depth depth = {at.z, judge_behind(&c->setup, &at), judge_left(&c->setup, &at), 1};
        const bool writes = c->output->window != NULL;
        const double z = (writes ? trap_writes_at : trap_reads_at)(c->trap, &c->setup, &depth);
        if (isnan(z))
            return z; /* it is no trap of the set-up */
        at = judge_depth_of(&c->setup, z);
    }
    return c->factor * c->output->of(&c->setup, &at);
}

double judge_value(const judge_candidate *c, double x) {
    return judge_value_at(c, c->input->depth(&c->setup, x));
}

/* Whether x can go in: all window depths, since some curves begin before the near plane, and eye depths up to the far
 * plane, as a formula goes on. They may be off by the rounding of binary32. */
static bool goes_in(const judge_candidate *c, double x) {
    const dp_spec *s = &c->setup.spec;
    const double spare = 0x1p-22, z = c->input->metric * x;
    if (c->input->window != NULL)
        return c->input->window(x) >= -spare && c->input->window(x) <= 1 + spare;
    if (c->input->metric == 0)
        return !isnan(c->input->depth(&c->setup, x).z);
    return z <= s->zfar + spare * fabs(s->zfar) && (z >= 0 || s->ortho);
}

/* All that a value may be. */
typedef struct span {
    double lo, hi;
    bool inverse; /* they are reciprocals: between them lies infinity */
} span;

/* The loss of a logarithm: roundings of its argument, which is about 1 where it begins. */
static double logarithm_from(const judge_candidate *c) {
    return c->setup.curve == DP_CURVE_LOG ? fmax(1, 1 / c->setup.kappa) : 1;
}

static void store(judge_precision precision, span *s) {
    if (precision == JUDGE_BINARY16)
        stored_half(&s->lo, &s->hi);
    else if (precision == JUDGE_BYTES || precision == JUDGE_CUT_BYTES)
        stored_bytes(precision == JUDGE_CUT_BYTES, &s->lo, &s->hi);
    else if (precision >= JUDGE_DIGITS && precision < JUDGE_QUICK)
        stored_digits((int)precision - JUDGE_DIGITS, &s->lo, &s->hi);
    else if (precision >= JUDGE_QUICK && precision < JUDGE_PRINTED)
        stored_quotient((int)precision - JUDGE_QUICK + 1, &s->lo, &s->hi);
}

static double share_of(const judge_candidate *c) {
    return (c->setup.curve == DP_CURVE_LOG ? LOG_STEPS : JUDGE_STEPS) * 0x1p-24;
}

/* The span of an input, which may be off by roundings of a difference, as large as those of what it is from. */
static span span_of(const judge_candidate *c, const judge_pairs *p, judge_precision precision, double x) {
    const bool differs = precision > JUDGE_BINARY32, depth = c->input->window != NULL;
    const double share = share_of(c), most = logarithm_from(c);
    const double from = depth ? most : c->input->metric != 0 ? fabs(c->setup.anchor) : 0;
    const double off =
        share * (differs ? fmax(fabs(x), from) : fabs(x)) + p->in_digits.absolute + p->in_digits.relative * fabs(x);
    span s = {(double)INFINITY, -(double)INFINITY, false};
    judge_depth at[3];
    for (int i = 0; i < 3; i++) {
        at[i] = c->input->depth(&c->setup, x + (i - 1) * off);
        s.inverse = s.inverse || (depth && c->output->unbounded && c->trap == NULL &&
                                  c->setup.curve == DP_CURVE_PERSPECTIVE && !(at[i].z > 0 && isfinite(at[i].z)));
    }
    for (int i = 0; i < 3; i++) {
        const double v = s.inverse ? 1 / judge_value_at(c, at[i]) : judge_value_at(c, at[i]),
                     size = isfinite(v) ? fabs(v) : 0;
        const double spare = share * (differs && c->output->window != NULL ? fmax(size, most) : size);
        s.lo = fmin(s.lo, v - spare);
        s.hi = fmax(s.hi, v + spare);
    }
    if (!s.inverse && s.lo <= s.hi)
        store(precision, &s);
    else if (s.inverse && precision == JUDGE_BINARY16) { /* what is too large for it may be cut to the largest */
        s.lo = s.lo < 0 ? fmin(s.lo * (1 + 0x1p-10), -1 / 65504.0) : s.lo;
        s.hi = s.hi > 0 ? fmax(s.hi * (1 + 0x1p-10), 1 / 65504.0) : s.hi;
    }
    s.lo -= p->out_digits.absolute * !s.inverse + p->out_digits.relative * fabs(isfinite(s.lo) ? s.lo : 0);
    s.hi += p->out_digits.absolute * !s.inverse + p->out_digits.relative * fabs(isfinite(s.hi) ? s.hi : 0);
    return s;
}

bool judge_clamps(const judge_candidate *c, double lo, double hi, double out) {
    return c->output->window != NULL && c->output->window(out) == (hi < 1 ? 0 : 1) &&
           (c->output->window(hi) <= 0 || c->output->window(lo) >= 1);
}

bool judge_fits_pair(const judge_candidate *c, const judge_pairs *p, judge_precision precision,
                     const judge_pair *pair) {
    if (!goes_in(c, pair->in))
        return false;
    const span s = span_of(c, p, precision, pair->in);
    const double v = s.inverse ? 1 / pair->out : pair->out;
    return (v >= s.lo && v <= s.hi) || judge_clamps(c, s.lo, s.hi, v);
}

bool judge_fits(const judge_candidate *c, const judge_pairs *p, judge_precision precision) {
    if (c->input == judge_input_get(JUDGE_CODES) && p->pairs[p->count - 1].in <= 1)
        return false; /* as good as any depth */
    if (c->output->whole && (c->input == judge_input_get(JUDGE_CODES) || !p->whole))
        return false;
    bool tells = precision < JUDGE_DIGITS || precision >= JUDGE_QUICK; /* digits that lose nothing are a guess */
    for (size_t i = 0; i < p->count; i++) {
        const judge_pair *pair = &p->pairs[i];
        if (!judge_fits_pair(c, p, precision, pair))
            return false;
        tells = tells || (pair->out > 0 && fabs(pair->out - judge_value(c, pair->in)) > 0x1p-18);
    }
    return tells;
}

/* Number i of the inputs that are tried: window depths to either end, eye depths by their logarithm. */
static double probe(const judge_candidate *c, int i) {
    const dp_spec *s = &c->setup.spec;
    const int half = PROBES / 2, power = 2 + (i - half) / 8; /* to 2^-33 */
    const double t = i < half ? (double)i / half : i % 2 == 0 ? ldexp(1, -power) : 1 - ldexp(1, -power);
    if (c->input->window != NULL)
        return c->input->window(0) == 0 ? t : 2 * t - 1;
    if (c->input == judge_input_get(JUDGE_CODES))
        return floor(t * s->format.code_max);
    const double far = fmin(s->zfar, 1e6 * fabs(s->znear));
    return c->input->metric * (s->znear + (far - s->znear) * t * t * t);
}

double judge_parts(const judge_candidate *a, const judge_candidate *b, const judge_pairs *p,
                   judge_precision precision) {
    double best = 0, at = (double)NAN;
    for (int i = 0; i < PROBES; i++) {
        const double x = probe(a, i);
        if (!goes_in(a, x) || !goes_in(b, x))
            continue;
        const span s = span_of(a, p, precision, x), t = span_of(b, p, precision, x);
        const double gap = fmax(t.lo - s.hi, s.lo - t.hi), size = fmax(fabs(s.hi), fabs(t.hi));
        if (s.inverse || t.inverse || !isfinite(gap) || !(gap > best * size))
            continue;
        best = gap / size;
        at = x;
    }
    return at;
}

bool judge_is_another(const judge_candidate *a, const judge_candidate *b, const judge_pairs *p) {
    judge_candidate one = *a, other = *b;
    const bool planes = a->setup.spec.znear == b->setup.spec.znear && a->setup.spec.zfar == b->setup.spec.zfar;
    const bool mapping = a->setup.spec.mapping == b->setup.spec.mapping && a->setup.spec.ortho == b->setup.spec.ortho;
    if (b->trap != NULL)
        return a->trap == NULL && a->factor != 1 && b->output == a->output && b->input == a->input;
    if (!planes || a->trap != NULL || !isnan(judge_parts(a, b, p, JUDGE_BINARY32)))
        return false;
    if (mapping && a->input == b->input)
        return a->output != b->output;
    dp_spec spec = a->setup.spec;
    spec.znear += 0.3 * fabs(spec.znear) + (spec.znear == 0);
    spec.zfar += 3 * fabs(spec.zfar) + 4 * fabs(spec.znear);
    if (dp_setup_init(&one.setup, &spec) != DP_OK)
        return false;
    spec.mapping = b->setup.spec.mapping;
    spec.ortho = b->setup.spec.ortho;
    return dp_setup_init(&other.setup, &spec) == DP_OK && !isnan(judge_parts(&one, &other, p, JUDGE_BINARY32));
}
