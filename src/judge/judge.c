/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Candidates are tried from the least loss to the greatest, and at each from what is asked about to what is known to be
 * wrong; other planes come last, because nearly every wrong formula is right for some.
 */
#include "judge/judge.h"

#include <math.h>

#include "judge/planes.h"

enum { STEPS = 16, LOG_STEPS = 64, PROBES = 512, DIGITS = 9 };

const char *judge_verdict_name(judge_verdict verdict) {
    static const char *const names[] = {"right", "another set-up", "wrong", "unknown"};
    return names[verdict];
}

const char *judge_precision_name(judge_precision precision) {
    static const char *const names[] = {"binary32", "binary32 after a difference", "binary16", "8 bits",
                                        "the digits that are printed"};
    return names[precision];
}

/* ---- A candidate ------------------------------------------------------------------------------------------------- */

double judge_value(const judge_candidate *c, double x) {
    double z = c->input->eye(&c->setup, x);
    if (c->trap != NULL)
        z = trap_reads(c->trap, &c->setup, 1, z);
    return c->factor * c->output->of(&c->setup, z);
}

/* Whether x can go in. Eye depths may be off by the rounding of binary32. */
static bool goes_in(const judge_candidate *c, double x) {
    const dp_spec *s = &c->setup.spec;
    const double spare = 0x1p-22, d = c->input->window != NULL ? c->input->window(x) : 0;
    if (c->input == judge_input_get(JUDGE_CODES))
        return !isnan(c->input->eye(&c->setup, x));
    if (c->input->window != NULL && (d < -spare || d > 1 + spare || c->setup.curve == DP_CURVE_PERSPECTIVE))
        return d >= -spare && d <= 1 + spare;
    if (c->input->window != NULL) /* depths before the near plane have window depths, too */
        return c->input->eye(&c->setup, x) >= s->znear - spare * fabs(s->znear);
    const double z = c->input->metric * x;
    return z >= s->znear - spare * fabs(s->znear) && z <= s->zfar + spare * fabs(s->zfar);
}

/* All that a value may be where x went in. What is computed here is not exact either, where a logarithm or an NDC depth
 * is near 0. */
static void span_of(const judge_candidate *c, const judge_pairs *p, judge_precision precision, double x, double *lo,
                    double *hi) {
    const bool differs = precision > JUDGE_BINARY32, depth = c->input->window != NULL;
    const double share = (c->setup.curve == DP_CURVE_LOG ? LOG_STEPS : STEPS) * 0x1p-24;
    const double off = share * (differs && depth ? fmax(fabs(x), 1) : fabs(x)) + p->in_digits.absolute +
                       p->in_digits.relative * fabs(x);
    *lo = (double)INFINITY;
    *hi = -(double)INFINITY;
    for (int i = -1; i <= 1; i++) {
        const double v = judge_value(c, x + i * off), size = isfinite(v) ? fabs(v) : 0;
        double spare = share * (differs && c->output->window != NULL ? fmax(size, 1) : size) + p->out_digits.absolute +
                       p->out_digits.relative * size;
        spare += c->setup.curve == DP_CURVE_LOG ? 0x1p-36 : c->output->window != NULL ? 0x1p-48 : 0;
        spare += precision == JUDGE_BINARY16 ? 0x1p-11 * size : precision == JUDGE_BYTES ? 0.51 / 255 : 0;
        *lo = fmin(*lo, v - spare);
        *hi = fmax(*hi, v + spare);
    }
}

static bool fits_pair(const judge_candidate *c, const judge_pairs *p, judge_precision precision,
                      const judge_pair *pair) {
    double lo, hi;
    if (!goes_in(c, pair->in))
        return false;
    span_of(c, p, precision, pair->in, &lo, &hi);
    return pair->out >= lo && pair->out <= hi;
}

static bool fits(const judge_candidate *c, const judge_pairs *p, judge_precision precision) {
    if (c->input == judge_input_get(JUDGE_CODES) && p->pairs[p->count - 1].in <= 1)
        return false; /* as good as any depth */
    for (size_t i = 0; i < p->count; i++)
        if (!fits_pair(c, p, precision, &p->pairs[i]))
            return false;
    return true;
}

/* What goes in, of a share of all that can: window depths to either end, eye depths as their logarithm. */
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

/* What to put in so that two candidates part; NaN where they never do. */
static double parts(const judge_candidate *a, const judge_candidate *b, const judge_pairs *p,
                    judge_precision precision) {
    double best = 0, at = (double)NAN;
    for (int i = 0; i < PROBES; i++) {
        const double x = probe(a, i);
        double lo[2], hi[2];
        span_of(a, p, precision, x, &lo[0], &hi[0]);
        span_of(b, p, precision, x, &lo[1], &hi[1]);
        const double gap = fmax(lo[1] - hi[0], lo[0] - hi[1]), size = fmax(fabs(hi[0]), fabs(hi[1]));
        if (!goes_in(a, x) || !goes_in(b, x) || !isfinite(gap) || !(gap > best * size))
            continue;
        best = gap / size;
        at = x;
    }
    return at;
}

/* ---- All candidates ---------------------------------------------------------------------------------------------- */

typedef struct search {
    const judge_pairs *pairs;
    const dp_setup *setups;
    size_t count;
    judge_precision precision;
    judgement *out;
    judge_verdict as; /* what those are that are tried */
    bool others;      /* of set-ups whose planes are open: those that nobody asked about */
} search;

/* One that fits is the answer where there is none yet; else whatever differs from the answer fits besides. */
static void try(search *s, const judge_candidate *c) {
    judgement *out = s->out;
    if (out->also || !fits(c, s->pairs, s->precision))
        return;
    if (!out->named) {
        out->named = true;
        out->found = *c;
        out->verdict = s->as;
        return;
    }
    const double at = parts(&out->found, c, s->pairs, s->precision);
    if (isnan(at))
        return;
    out->also = true;
    out->other = *c;
    out->decides = at;
    if (s->as != out->verdict && out->verdict == JUDGE_RIGHT) {
        out->verdict = JUDGE_UNKNOWN;
        out->because = "what is right for this set-up and what is not fit alike";
    }
}

static void try_functions(search *s, const dp_setup *setup) {
    judge_candidate c = {.setup = *setup, .factor = 1};
    for (size_t i = 0; (c.input = judge_input_get(i)) != NULL; i++)
        for (size_t k = 0; (c.output = judge_output_get(k)) != NULL; k++)
            if (c.input->window != NULL || !c.output->of_windows)
                try(s, &c);
}

static bool is_asked(const search *s, const dp_setup *setup) {
    for (size_t i = 0; i < s->count; i++)
        if (s->setups[i].spec.mapping == setup->spec.mapping && s->setups[i].spec.ortho == setup->spec.ortho)
            return true;
    return false;
}

/* Calls `of` with every set-up of the same planes and format. */
static void each_set_up(search *s, void (*of)(search *s, const dp_setup *setup)) {
    for (int k = 0; k < 2 * DP_MAPPING_COUNT; k++) {
        dp_spec spec = s->setups[0].spec;
        dp_setup setup;
        spec.mapping = (dp_mapping)(k % DP_MAPPING_COUNT);
        spec.ortho = k / DP_MAPPING_COUNT != s->setups[0].spec.ortho;
        if (dp_setup_init(&setup, &spec) == DP_OK)
            of(s, &setup);
    }
}

static void try_other(search *s, const dp_setup *setup) {
    if (!is_asked(s, setup))
        try_functions(s, setup);
}

/* Planes that fit, with the fewest digits that do. */
static void try_planes(search *s, const dp_setup *setup) {
    judge_candidate c = {.setup = *setup, .factor = 1};
    const judge_verdict as = s->as;
    if (setup->spec.ortho != s->setups[0].spec.ortho || (as == JUDGE_RIGHT && is_asked(s, setup) == s->others))
        return;
    s->as = as == JUDGE_RIGHT && !is_asked(s, setup) ? JUDGE_OTHER : as;
    for (size_t i = 0; (c.input = judge_input_get(i)) != NULL; i++)
        for (size_t k = 0; (c.output = judge_output_get(k)) != NULL; k++) {
            double znear, zfar;
            if (!judge_planes_of(s->pairs, setup, c.input, c.output, s->precision > JUDGE_BINARY32, &znear, &zfar))
                continue;
            const bool fit_far = zfar > 0 && zfar < 1e6 * znear;
            for (int n = 0; n < 2 * DIGITS; n++) {
                c.setup = *setup;
                if (!judge_planes_set(&c.setup, znear, zfar, 1 + n % DIGITS, fit_far != (n < DIGITS)) ||
                    !fits(&c, s->pairs, s->precision))
                    continue;
                try(s, &c);
                break;
            }
        }
    s->as = as;
}

static void try_traps(search *s) {
    judge_candidate c = {.factor = 1};
    for (size_t i = 0; i < s->count; i++)
        for (size_t k = 0; (c.trap = trap_get(k)) != NULL; k++)
            for (size_t in = 0; (c.input = judge_input_get(in)) != NULL; in++)
                for (size_t o = 0; (c.output = judge_output_get(o)) != NULL && c.output->window == NULL; o++) {
                    c.setup = s->setups[i];
                    if (c.input->window != NULL)
                        try(s, &c);
                }
}

/* A unit, or a distance along one ray: eye depth times a number. */
static void try_factor(search *s) {
    const judge_pair *first = s->pairs->pairs, *last = first + s->pairs->count - 1;
    for (size_t i = 0; i < s->count; i++)
        for (size_t in = 0; judge_input_get(in) != NULL; in++) {
            judge_candidate c = {s->setups[i], judge_input_get(in), judge_output_get(0), NULL, 1};
            const judge_pair *nearer = judge_value(&c, first->in) < judge_value(&c, last->in) ? first : last;
            c.factor = nearer->out / judge_value(&c, nearer->in); /* few functions lose anything there */
            if (isfinite(c.factor) && c.factor != 0)
                try(s, &c);
        }
}

/* ---- The verdict ------------------------------------------------------------------------------------------------- */

static const char *cannot(const judge_pairs *p) {
    bool constant = true;
    for (size_t i = 1; i < p->count; i++)
        constant = constant && p->pairs[i].out == p->pairs[0].out;
    if (p->distinct < JUDGE_LEAST)
        return "too few pairs: three different ones are the least";
    if (constant)
        return "the value is the same whatever goes in";
    return NULL;
}

static const char *nothing(const judge_pairs *p) {
    bool rises = true, falls = true;
    for (size_t i = 1; i < p->count; i++) {
        rises = rises && p->pairs[i].out >= p->pairs[i - 1].out;
        falls = falls && p->pairs[i].out <= p->pairs[i - 1].out;
    }
    return rises || falls ? "no function that is known gives these values"
                          : "no function that is known gives these values, which neither rise nor fall throughout";
}

/* How far the values are off. */
static void measure(const judge_pairs *p, judgement *out) {
    const judge_candidate *c = &out->found;
    for (size_t i = 0; i < p->count; i++) {
        const double x = p->pairs[i].in, v = judge_value(c, x), error = fabs(p->pairs[i].out - v);
        const double z = c->input->eye(&c->setup, x), h = 0x1p-20 * fabs(z);
        if (!isfinite(v) || !isfinite(error) || !isfinite(z))
            continue;
        if (v != 0 && error > out->error * fabs(v)) {
            out->error = error / fabs(v);
            out->at = x;
        }
        if (c->trap != NULL || !(z - h >= c->setup.spec.znear && z + h <= c->setup.spec.zfar))
            continue;
        const double slope = (c->output->of(&c->setup, z + h) - c->output->of(&c->setup, z - h)) / (2 * h) * c->factor;
        const dp_cell cell = dp_cell_of(&c->setup, dp_code(&c->setup, z));
        const double intervals = error / (cell.width * fabs(slope));
        if (isfinite(intervals) && !(intervals <= out->intervals)) {
            out->intervals = intervals;
            out->z = z;
        }
    }
}

/* Whether some value has fewer digits than binary32. */
static bool is_printed(const judge_pairs *p) {
    for (size_t i = 0; i < p->count; i++)
        if (p->out_digits.absolute > (0x1p-22 - p->out_digits.relative) * fabs(p->pairs[i].out))
            return p->out_digits.absolute > 0;
    return false;
}

static void try_all(search *s, bool planes_open) {
    const bool fit = s->pairs->distinct >= JUDGE_FITTED_LEAST;
    s->as = JUDGE_RIGHT;
    for (size_t i = 0; i < s->count && !planes_open; i++)
        try_functions(s, &s->setups[i]);
    if (planes_open && fit)
        each_set_up(s, try_planes);
    if (planes_open)
        return;
    s->as = JUDGE_OTHER;
    each_set_up(s, try_other);
    if (!s->out->named)
        try_factor(s);
    s->as = JUDGE_WRONG;
    try_traps(s);
    s->as = JUDGE_OTHER;
    if (!s->out->named && fit)
        each_set_up(s, try_planes);
}

static bool is_possible(const judge_pairs *p, judge_precision precision) {
    return (precision != JUDGE_BINARY16 || p->half) && (precision != JUDGE_BYTES || p->bytes);
}

/* What is right and loses more may be met more closely by another factor or other planes: where both are the same at
 * what it loses, it is right. */
static void excuse(search *s) {
    judgement *out = s->out, right = *out;
    right.named = right.also = false;
    right.decides = (double)NAN;
    s->out = &right;
    s->as = JUDGE_RIGHT;
    for (int k = (int)out->precision + 1; k <= JUDGE_BYTES && !right.named; k++) {
        s->precision = right.precision = (judge_precision)k;
        for (size_t i = 0; i < s->count && is_possible(s->pairs, s->precision); i++)
            try_functions(s, &s->setups[i]);
    }
    if (right.named && isnan(parts(&right.found, &out->found, s->pairs, s->precision)))
        *out = right;
    s->out = out;
}

void judge_function(const judge_pairs *pairs, const dp_setup *setups, size_t count, bool planes_open, judgement *out) {
    *out = (judgement){.verdict = JUDGE_UNKNOWN,
                       .decides = (double)NAN,
                       .error = (double)NAN,
                       .at = (double)NAN,
                       .intervals = (double)NAN,
                       .z = (double)NAN,
                       .stray = (double)NAN,
                       .because = cannot(pairs)};
    if (out->because == NULL && planes_open && pairs->distinct < JUDGE_FITTED_LEAST)
        out->because = "too few pairs where near and far are not given: five different ones are the least";
    search s = {.pairs = pairs, .setups = setups, .count = count, .out = out};
    for (int k = 0; k <= 2 * JUDGE_BYTES + 1 && out->because == NULL && !out->named; k++) {
        s.precision = out->precision = (judge_precision)(k % (JUDGE_BYTES + 1));
        s.others = k > JUDGE_BYTES;
        if (is_possible(pairs, s.precision) && (planes_open || !s.others))
            try_all(&s, planes_open);
    }
    if (out->named && !planes_open && (out->verdict == JUDGE_OTHER || out->verdict == JUDGE_WRONG))
        excuse(&s);
    if (out->precision == JUDGE_BINARY32 && is_printed(pairs))
        out->precision = JUDGE_PRINTED;
    out->error = out->named ? 0 : (double)NAN;
    if (out->named)
        measure(pairs, out);
    else if (out->because == NULL)
        out->because = nothing(pairs);
}

/* Whether a pair does not fit, even after a difference. Numbers that a GPU may take for 0, or that binary32 has not,
 * are nobody's fault. */
static bool strays(judgement *j, const judge_pairs *p, const judge_pair *pair) {
    const judge_candidate *c = &j->found;
    const double v = judge_value(c, pair->in), x = fabs(pair->in);
    const judge_precision more = j->precision > JUDGE_DIFFERENCE ? j->precision : JUDGE_DIFFERENCE;
    if ((x > 0 && x < 0x1p-126) || !(fabs(v) < 0x1p127) || fabs(pair->out - v) <= 0x1p-22 * fabs(v) ||
        fits_pair(c, p, j->precision, pair))
        return false;
    j->precision = more;
    return !fits_pair(c, p, more, pair);
}

static void merge(judgement *out, const judgement *of) {
    if (of->error > out->error || (of->error == out->error && of->at < out->at)) {
        out->error = of->error;
        out->at = of->at;
    }
    if (of->intervals > out->intervals || isnan(out->intervals) ||
        (of->intervals == out->intervals && of->z < out->z)) {
        out->intervals = of->intervals;
        out->z = of->z;
    }
    if (of->strays > 0 && (out->strays == 0 || of->stray < out->stray))
        out->stray = of->stray;
    out->strays += of->strays;
    out->precision = of->precision > out->precision ? of->precision : out->precision;
}

void judge_more(const judge_pairs *pairs, judgement *out) {
    enum { PART = 4096 };
    const size_t parts = (pairs->count + PART - 1) / PART;
    const judgement before = *out;
#pragma omp parallel for schedule(dynamic)
    for (size_t i = 0; i < parts; i++) {
        judge_pairs part = *pairs;
        judgement of = before;
        part.pairs += i * PART;
        part.count = i + 1 < parts ? PART : pairs->count - i * PART;
        measure(&part, &of);
        of.strays = 0;
        for (size_t k = 0; k < part.count && before.found.trap == NULL; k++)
            if (strays(&of, &part, &part.pairs[k]) && of.strays++ == 0)
                of.stray = part.pairs[k].in;
#pragma omp critical
        merge(out, &of);
    }
}
