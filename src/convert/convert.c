/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every operation that is called binary32 is one: the build forbids that two are contracted into one. */
#include "convert/convert.h"

#include <math.h>
#include <omp.h>

#include "core/bits.h"
#include "core/engine.h"

/* ---- Ways -------------------------------------------------------------------------------------------------------- */

static double read_quotient(float code, float factor) {
    return (double)(code / factor);
}

static double read_product(float code, float factor) {
    const float by = 1.0f / factor;
    return (double)(code * by);
}

static double write_cut(float number, float factor) {
    const float product = factor * number;
    return floor((double)product);
}

static double write_half(float number, float factor) {
    const float product = factor * number;
    const float sum = product + 0.5f;
    return floor((double)sum);
}

static double write_round(float number, float factor) {
    const float product = factor * number;
    return rint((double)product);
}

/* clang-format off */
static const convert_way reads[] = {
    {.name = "exact", .note = "c/F, F the largest code, rounded once: what hardware reads",
     .source = "D3D 11.3 functional specification 3.2.3.5"},
    {.name = "divide", .note = "c/F in binary32", .scales = true, .read = read_quotient},
    {.name = "product", .note = "c times 1/F in binary32, 1/F rounded before", .scales = true, .read = read_product},
};
static const convert_way writes[] = {
    {.name = "nearest",
     .note = "F d, F the largest code, to the nearest, ties up; of floats to even: what hardware writes",
     .source = "D3D 11.3 functional specification 3.2.3.6, 3.2.2"},
    {.name = "cut", .aliases = "floor trunc", .note = "floor(F d), F d in binary32; of floats towards 0",
     .scales = true, .write = write_cut, .cuts = true},
    {.name = "half", .note = "floor(F d + 0.5), each operation in binary32", .scales = true, .write = write_half},
    {.name = "round", .aliases = "rint", .note = "F d in binary32, to the nearest, ties to even", .scales = true,
     .write = write_round},
    {.name = "shift", .note = "an integer's bits, shifted into those of another; new ones are 0", .moves = true},
    {.name = "replicate", .note = "the same, new ones repeat the highest", .moves = true, .fills = true},
};
/* clang-format on */
_Static_assert(sizeof writes / sizeof writes[0] == CONVERT_WAYS, "one more way");
NAMED_TABLE(convert_read, reads);
NAMED_TABLE(convert_write, writes);

/* ---- Numbers ----------------------------------------------------------------------------------------------------- */

/* The number that a code is read as: a quotient of two doubles, exactly. */
typedef struct quotient {
    double num, den;
} quotient;

/* The sign of p - q for positive denominators: products of 33 bits by 53 are two doubles each, exactly, and their
 * rounding keeps the order. */
static int compare(quotient p, quotient q) {
    const double a = p.num * q.den, b = q.num * p.den;
    if (a != b || (p.den == 1 && q.den == 1))
        return (a > b) - (a < b);
    const double low = fma(p.num, q.den, -a) - fma(q.num, p.den, -b);
    return (low > 0) - (low < 0);
}

static double factor_of(const convert_rule *rule, const dp_format *f) {
    return rule->factor > 0 ? rule->factor : (double)f->code_max;
}

static bool is_subnormal(const dp_format *f, uint32_t code) {
    return f->kind == DP_FORMAT_FLOAT && code >> f->mantissa_bits == 0;
}

static quotient read_code(const convert_chain *chain, const dp_format *f, uint32_t code) {
    if (f->kind == DP_FORMAT_FLOAT)
        return (quotient){chain->flush && is_subnormal(f, code) ? 0 : dp_format_value(f, code), 1};
    if (chain->read.way->read == NULL)
        return (quotient){code, f->code_max};
    return (quotient){chain->read.way->read((float)code, (float)factor_of(&chain->read, f)), 1};
}

static quotient value_of(const dp_format *f, uint32_t code) {
    return f->kind == DP_FORMAT_FLOAT ? (quotient){dp_format_value(f, code), 1} : (quotient){code, f->code_max};
}

/* The largest code whose number is at most d; 1 and more is the last. */
static uint32_t code_below(const dp_format *f, quotient d) {
    uint32_t code = dp_format_encode(f, DP_ROUND_ZERO, d.num / d.den);
    while (code > 0 && compare(value_of(f, code), d) > 0)
        code--;
    while (code < f->code_max && compare(value_of(f, code + 1), d) <= 0)
        code++;
    return code;
}

/* Floats to even, integers up. The boundary is the mean of two codes: a whole number of 33 bits over an even one, or
 * one bit more than a float has. */
static uint32_t nearest_code(const dp_format *f, quotient d) {
    if (d.den == 1)
        return dp_format_encode(f, DP_ROUND_NEAREST, d.num);
    /* A quotient that is rounded twice goes wrong only where the first gave the middle between two floats. */
    const double once = d.num / d.den;
    if (dp_format_is_fp32(f) && (dp_bits64(once) & 0x1FFFFFFFU) != 0x10000000U)
        return dp_bits32((float)once);
    const uint32_t code = code_below(f, d);
    if (code == f->code_max)
        return code;
    const bool whole = f->kind == DP_FORMAT_UNORM;
    const quotient lo = value_of(f, code), hi = value_of(f, code + 1);
    const quotient middle = {whole ? 2.0 * (double)code + 1 : 0.5 * (lo.num + hi.num), whole ? 2 * lo.den : 1};
    const int above = compare(d, middle);
    return code + (above > 0 || (above == 0 && (whole || code % 2 != 0)));
}

static float binary32_of(quotient d) {
    static const dp_format fp32 = {"fp32", DP_FORMAT_FLOAT, 31, 8, 23, 127, 127U << 23};
    if (d.den == 1)
        return (float)d.num; /* it is one, or a code of as many bits */
    return d.num <= d.den ? (float)dp_format_value(&fp32, nearest_code(&fp32, d)) : (float)(d.num / d.den);
}

static uint32_t fit_code(const convert_chain *chain, const dp_format *f, double whole, double *beyond) {
    if (whole <= (double)f->code_max)
        return (uint32_t)whole;
    *beyond = whole;
    return chain->saturate ? f->code_max : (uint32_t)fmod(whole, (double)f->code_max + 1);
}

static uint32_t write_code(const convert_chain *chain, const dp_format *f, quotient d, double *beyond) {
    const convert_way *way = chain->write.way;
    const bool computed = f->kind == DP_FORMAT_UNORM && way->write != NULL;
    if (computed)
        return fit_code(chain, f, way->write(binary32_of(d), (float)factor_of(&chain->write, f)), beyond);
    const uint32_t code = way->cuts && !dp_format_is_fp32(f) ? code_below(f, d) : nearest_code(f, d);
    return chain->flush && is_subnormal(f, code) ? 0 : code;
}

static uint32_t move_bits(const convert_way *way, const dp_format *from, const dp_format *to, uint32_t code) {
    const int up = to->bits - from->bits;
    if (up <= 0)
        return code >> -up;
    uint64_t bits = (uint64_t)code << up;
    for (int have = from->bits; way->fills && have < to->bits; have += from->bits)
        bits |= have + from->bits <= to->bits ? (uint64_t)code << (to->bits - have - from->bits)
                                              : (uint64_t)code >> (have + from->bits - to->bits);
    return (uint32_t)bits;
}

static bool comes_back(const convert_chain *chain) {
    const dp_format *a = &chain->format[0], *b = &chain->format[chain->count - 1];
    return a->kind == b->kind && a->code_max == b->code_max && a->mantissa_bits == b->mantissa_bits &&
           a->bias == b->bias;
}

convert_path convert_code(const convert_chain *chain, uint32_t code) {
    const dp_format *f = chain->format;
    const double none = (double)NAN;
    const quotient first = read_code(chain, &f[0], code);
    convert_path p = {.code = {code}, .number = first.num / first.den, .beyond = {none, none, none}};
    for (int i = 1; i < chain->count; i++) {
        const bool integers = f[i - 1].kind == DP_FORMAT_UNORM && f[i].kind == DP_FORMAT_UNORM;
        p.code[i] = chain->write.way->moves && integers
                        ? move_bits(chain->write.way, &f[i - 1], &f[i], p.code[i - 1])
                        : write_code(chain, &f[i], read_code(chain, &f[i - 1], p.code[i - 1]), &p.beyond[i]);
    }
    const dp_format *last = &f[chain->count - 1];
    const uint32_t to = p.code[chain->count - 1];
    p.changed = comes_back(chain) ? to != code : compare(value_of(&f[0], code), value_of(last, to)) != 0;
    return p;
}

/* ---- All codes --------------------------------------------------------------------------------------------------- */

static uint32_t last_of(const convert_chain *chain, const convert_path *p) {
    return p->code[chain->count - 1];
}

/* Codes lo to hi that the first copy makes the same, and what becomes of them; hi may be lo. */
typedef struct run {
    uint32_t lo, hi;
    convert_path path; /* of lo */
} run;

static bool is_same(const convert_path *p, const convert_path *q) {
    const double a = p->beyond[1], b = q->beyond[1];
    return p->code[1] == q->code[1] && (a == b || (isnan(a) && isnan(b)));
}

static bool is_beyond(const convert_path *p) {
    return !isnan(p->beyond[1]) || !isnan(p->beyond[2]);
}

/* Every way is monotone, so where both ends become the same so does all between. `next` is the path behind the run. */
static void extend(const convert_chain *chain, run *r, uint32_t last, convert_path *next) {
    uint64_t fails = (uint64_t)last + 1;
    for (uint64_t step = 1; r->hi + step <= last; step *= 2) {
        const convert_path p = convert_code(chain, (uint32_t)(r->hi + step));
        if (!is_same(&r->path, &p)) {
            fails = r->hi + step;
            *next = p;
            break;
        }
        r->hi += (uint32_t)step;
    }
    while (fails - r->hi > 1) {
        const uint32_t middle = r->hi + (uint32_t)((fails - r->hi) / 2);
        const convert_path p = convert_code(chain, middle);
        if (is_same(&r->path, &p)) {
            r->hi = middle;
        } else {
            fails = middle;
            *next = p;
        }
    }
}

/* How far a code of a run is from what it becomes. */
static void note_most(const convert_chain *chain, uint32_t code, uint32_t to, convert_found *out) {
    const uint32_t by = to > code ? to - code : code - to;
    if (by > out->by) {
        out->by = by;
        out->most = convert_code(chain, code);
    }
}

/* At most one code of a run is the number that it becomes. */
static void count_run(const convert_chain *chain, bool back, const run *r, convert_found *out) {
    const dp_format *f = chain->format;
    const uint32_t to = last_of(chain, &r->path);
    const quotient number = value_of(&f[chain->count - 1], to);
    const uint32_t like = back ? to : code_below(&f[0], number);
    const bool kept = like >= r->lo && like <= r->hi && (back || compare(value_of(&f[0], like), number) == 0);
    const uint64_t all = (uint64_t)r->hi - r->lo + 1;
    out->codes += all;
    out->beyond += is_beyond(&r->path) ? all : 0;
    out->merged += all - 1;
    if (out->changed == 0) /* of a run that keeps all the next one takes it back */
        out->first = convert_code(chain, r->lo + (kept && like == r->lo));
    out->changed += all - kept;
    if (back) {
        note_most(chain, r->lo, to, out);
        note_most(chain, r->hi, to, out);
    }
}

/* Counts codes lo to hi; a code's neighbour is the one below it, which may be another part's. */
static convert_found count_part(const convert_chain *chain, uint32_t lo, uint32_t hi) {
    convert_found found = {0};
    const bool back = comes_back(chain);
    convert_path path = convert_code(chain, lo), before = lo > 0 ? convert_code(chain, lo - 1) : path;
    for (uint64_t code = lo; code <= hi;) {
        run r = {(uint32_t)code, (uint32_t)code, path};
        found.merged += code > 0 && last_of(chain, &path) == last_of(chain, &before);
        found.swapped += code > 0 && last_of(chain, &path) < last_of(chain, &before);
        before = path;
        extend(chain, &r, hi, &path);
        count_run(chain, back, &r, &found);
        code = (uint64_t)r.hi + 1;
    }
    return found;
}

/* `more` is of higher codes. */
static void add(convert_found *to, const convert_found *more) {
    if (to->changed == 0)
        to->first = more->first;
    if (more->by > to->by) {
        to->by = more->by;
        to->most = more->most;
    }
    to->codes += more->codes;
    to->changed += more->changed;
    to->beyond += more->beyond;
    to->merged += more->merged;
    to->swapped += more->swapped;
}

convert_found convert_all(const convert_chain *chain, int threads) {
    enum { PARTS = 64 };
    const uint64_t codes = (uint64_t)chain->format[0].code_max + 1;
    convert_found found[PARTS] = {{0}};
#pragma omp parallel for schedule(dynamic) num_threads(threads > 0 ? threads : omp_get_max_threads())
    for (uint64_t i = 0; i < PARTS; i++) {
        const uint64_t lo = codes * i / PARTS, end = codes * (i + 1) / PARTS;
        if (lo < end)
            found[i] = count_part(chain, (uint32_t)lo, (uint32_t)(end - 1));
    }
    for (int i = 1; i < PARTS; i++)
        add(&found[0], &found[i]);
    return found[0];
}
