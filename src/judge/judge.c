/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Candidates are tried from the least loss to the greatest, and at each from what is asked about to what is known to be
 * wrong; other planes come last, because nearly every wrong formula is right for some.
 */
#include "judge/judge.h"

#include <math.h>

#include "judge/candidate.h"
#include "judge/planes.h"

enum { DIGITS = 9 };

const char *judge_verdict_name(judge_verdict verdict) {
    static const char *const names[] = {"right", "another set-up", "wrong", "unknown"};
    return names[verdict];
}

const char *judge_precision_name(judge_precision precision) {
    static const char *const names[] = {"binary32", "binary32 after a difference", "binary16", "8 bits", "8 bits, cut"};
    return precision == JUDGE_PRINTED  ? "the digits that are printed"
           : precision >= JUDGE_QUICK  ? "a reciprocal from the bits of a number and Newton steps"
           : precision >= JUDGE_DIGITS ? stored_digits_name((int)precision - JUDGE_DIGITS)
                                       : names[precision];
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
    judge_open open;
} search;

/* One that fits is the answer where there is none yet; else whatever differs from the answer fits besides. */
static void try(search *s, const judge_candidate *c) {
    judgement *out = s->out;
    if (out->also || !judge_fits(c, s->pairs, s->precision))
        return;
    if (!out->named) {
        out->named = true;
        out->found = *c;
        out->verdict = s->as;
        return;
    }
    const double at = judge_parts(&out->found, c, s->pairs, s->precision);
    if (isnan(at)) {
        bool another = out->same_count < JUDGE_SAME && judge_is_another(&out->found, c, s->pairs);
        for (size_t i = 0; i < out->same_count && another; i++)
            another = judge_is_another(&out->same[i], c, s->pairs);
        if (another)
            out->same[out->same_count++] = *c;
        return;
    }
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

/* Calls `of` with every set-up of the same planes and format, the mappings that were asked about first. */
static void each_set_up(search *s, void (*of)(search *s, const dp_setup *setup)) {
    for (int k = 0; k < 4 * DP_MAPPING_COUNT; k++) {
        dp_spec spec = s->setups[0].spec;
        dp_setup setup;
        bool asked = false;
        spec.mapping = (dp_mapping)(k % DP_MAPPING_COUNT);
        for (size_t i = 0; i < s->count; i++)
            asked = asked || s->setups[i].spec.mapping == spec.mapping;
        spec.ortho = k / DP_MAPPING_COUNT % 2 != s->setups[0].spec.ortho;
        if (asked == (k < 2 * DP_MAPPING_COUNT) && dp_setup_init(&setup, &spec) == DP_OK)
            of(s, &setup);
    }
}

static void try_other(search *s, const dp_setup *setup) {
    if (!is_asked(s, setup))
        try_functions(s, setup);
}

/* A plane that was given stays; where their ratio alone is told, the other one moves with it. */
static bool keep_given(const search *s, judge_candidate *c) {
    const dp_spec *given = &s->setups[0].spec;
    dp_spec spec = c->setup.spec;
    if (s->as != JUDGE_RIGHT || s->open == JUDGE_OPEN)
        return true;
    const bool ratio = c->output->planes == JUDGE_PLANES_RATIO, near_open = s->open == JUDGE_OPEN_NEAR;
    const double scale = !ratio ? 1 : near_open ? given->zfar / spec.zfar : given->znear / spec.znear;
    spec.znear = near_open ? spec.znear * scale : given->znear;
    spec.zfar = near_open ? given->zfar : spec.zfar * scale;
    return dp_setup_init(&c->setup, &spec) == DP_OK;
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
            if (c.output->planes == JUDGE_PLANES_RATIO && as == JUDGE_RIGHT && s->open == JUDGE_OPEN_FAR) {
                zfar *= setup->spec.znear / znear;
                znear = setup->spec.znear;
            }
            const bool fit_far = zfar > 0 && zfar < 1e6 * znear;
            for (int n = 0; n < 2 * DIGITS; n++) {
                c.setup = *setup;
                if (!judge_planes_set(&c.setup, znear, zfar, 1 + n % DIGITS, fit_far != (n < DIGITS)) ||
                    !keep_given(s, &c) || !judge_fits(&c, s->pairs, s->precision))
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
            for (size_t in = 0; (c.input = judge_input_get(in)) != NULL && !c.trap->coarse; in++)
                for (size_t o = 0; (c.output = judge_output_get(o)) != NULL; o++) {
                    c.setup = s->setups[i];
                    const bool reads = c.input->window != NULL && c.output->eye != NULL;
                    if (reads || (c.input->metric != 0 && c.output->window != NULL && c.trap->writes != NULL))
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
    double least = (double)INFINITY, most = -(double)INFINITY;
    for (size_t i = 0; i < p->count; i++) {
        least = fmin(least, p->pairs[i].out);
        most = fmax(most, p->pairs[i].out);
    }
    const double size = isfinite(most - least) ? fmax(fabs(least), fabs(most)) : 0;
    const double lost = p->bytes ? 1.001 / 255 : (p->half ? 0x1p-10 : JUDGE_STEPS * 0x1p-23) * size;
    if (p->distinct < JUDGE_LEAST)
        return "too few pairs: three different ones are the least";
    if (most == least)
        return "the value is the same whatever goes in";
    if (most - least <= lost + 2 * (p->out_digits.absolute + p->out_digits.relative * size))
        return "the values differ by no more than their last bits lose";
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

/* Measures the errors of the values, and where they are largest. */
static void measure(const judge_pairs *p, judgement *out) {
    const judge_candidate *c = &out->found;
    for (size_t i = 0; i < p->count; i++) {
        const double x = p->pairs[i].in, v = judge_value(c, x), error = fabs(p->pairs[i].out - v);
        const double z = c->input->depth(&c->setup, x).z, h = 0x1p-20 * fabs(z);
        if (!isfinite(v) || !isfinite(error) || !isfinite(z) ||
            judge_clamps(c, v, v, p->pairs[i].out)) /* which loses nothing */
            continue;
        out->off = fmax(out->off, error);
        if (v != 0 && error > out->error * fabs(v)) {
            out->error = error / fabs(v);
            out->at = x;
        }
        if (c->trap != NULL || c->output->whole || !(z - h >= c->setup.spec.znear && z + h <= c->setup.spec.zfar))
            continue;
        const double slope = (judge_value_at(c, judge_depth_of(&c->setup, z + h)) -
                              judge_value_at(c, judge_depth_of(&c->setup, z - h))) /
                             (2 * h);
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

static void try_right(search *s) {
    s->as = JUDGE_RIGHT;
    for (size_t i = 0; i < s->count; i++)
        try_functions(s, &s->setups[i]);
}

static void try_rest(search *s) {
    s->as = JUDGE_OTHER;
    each_set_up(s, try_other);
    if (!s->out->named)
        try_factor(s);
    s->as = JUDGE_WRONG;
    try_traps(s);
    for (int other = s->open == JUDGE_OPEN_NONE; other < 2; other++) {
        s->as = other ? JUDGE_OTHER : JUDGE_RIGHT;
        if (!s->out->named && s->pairs->distinct >= JUDGE_FITTED_LEAST)
            each_set_up(s, try_planes);
    }
}

/* Where few digits are printed nothing tells how values were stored in bytes. */
static bool is_possible(const judge_pairs *p, judge_precision precision) {
    const bool fine = p->out_digits.absolute <= 0x1p-17 && p->out_digits.relative <= 0x1p-17;
    return precision == JUDGE_BINARY16 ? p->half
           : precision < JUDGE_BYTES   ? true
           : precision < JUDGE_DIGITS  ? p->bytes
           : precision < JUDGE_QUICK   ? fine && p->shares && stored_digits_lose((int)precision - JUDGE_DIGITS)
                                       : fine;
}

/* The right function may lose more than another that meets the values more closely: where both are the same at its
 * loss, and where all values are as they are stored, it is right. */
static void excuse(search *s) {
    judgement *out = s->out, right = *out;
    right.named = right.also = false;
    right.same_count = 0;
    right.decides = (double)NAN;
    s->out = &right;
    for (int k = (int)out->precision + 1; k < JUDGE_PRINTED && !right.named; k++) {
        s->precision = right.precision = (judge_precision)k;
        if (is_possible(s->pairs, s->precision))
            try_right(s);
    }
    if (right.named &&
        (right.precision > JUDGE_DIFFERENCE || isnan(judge_parts(&right.found, &out->found, s->pairs, s->precision))))
        *out = right;
    s->out = out;
}

/* Tries the right function, whatever it loses, before all but one met as closely as binary32 can. */
static void judge_given(search *s) {
    judgement *out = s->out;
    s->precision = out->precision = JUDGE_BINARY32;
    try_right(s);
    try_rest(s);
    if (out->named && out->verdict != JUDGE_RIGHT)
        excuse(s);
    for (int k = JUDGE_DIFFERENCE; k < JUDGE_PRINTED && !out->named; k++) {
        s->precision = out->precision = (judge_precision)k;
        if (!is_possible(s->pairs, s->precision))
            continue;
        try_right(s);
        if (out->named)
            try_rest(s);
    }
    for (int k = JUDGE_DIFFERENCE; k < JUDGE_DIGITS && !out->named; k++) {
        s->precision = out->precision = (judge_precision)k;
        if (is_possible(s->pairs, s->precision))
            try_rest(s);
    }
}

/* Tries functions of window depths alone, which need no planes. */
static void try_windows(search *s) {
    for (size_t i = 0; i < s->count; i++) {
        judge_candidate c = {.setup = s->setups[i], .factor = 1};
        for (size_t in = 0; (c.input = judge_input_get(in)) != NULL && c.input->window != NULL; in++)
            for (size_t k = 0; (c.output = judge_output_get(k)) != NULL; k++)
                if (c.output->window != NULL || c.output->of_windows || c.output->whole)
                    try(s, &c);
    }
}

static void judge_any_planes(search *s) {
    s->as = JUDGE_RIGHT;
    for (int k = 0; k < 2 * JUDGE_DIGITS && !s->out->named; k++) {
        s->precision = s->out->precision = (judge_precision)(k % JUDGE_DIGITS);
        s->others = k >= JUDGE_DIGITS;
        if (!is_possible(s->pairs, s->precision))
            continue;
        try_windows(s);
        if (!s->out->named)
            each_set_up(s, try_planes);
    }
}

void judge_function(const judge_pairs *pairs, const dp_setup *setups, size_t count, judge_open open, judgement *out) {
    *out = (judgement){.verdict = JUDGE_UNKNOWN,
                       .decides = (double)NAN,
                       .error = (double)NAN,
                       .off = (double)NAN,
                       .at = (double)NAN,
                       .intervals = (double)NAN,
                       .z = (double)NAN,
                       .stray = (double)NAN,
                       .because = cannot(pairs)};
    if (out->because == NULL && open == JUDGE_OPEN && pairs->distinct < JUDGE_FITTED_LEAST)
        out->because = "too few pairs where near and far are not given: five different ones are the least";
    search s = {.pairs = pairs, .setups = setups, .count = count, .out = out, .open = open};
    if (out->because == NULL)
        (open == JUDGE_OPEN ? judge_any_planes : judge_given)(&s);
    if (out->precision == JUDGE_BINARY32 && is_printed(pairs))
        out->precision = JUDGE_PRINTED;
    out->error = out->off = out->named ? 0 : (double)NAN;
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
        judge_fits_pair(c, p, j->precision, pair))
        return false;
    j->precision = more;
    return !judge_fits_pair(c, p, more, pair);
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
    out->off = fmax(out->off, of->off);
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
