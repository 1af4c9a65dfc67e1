/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Copies of depths: each code's way by MPFR at 24 bits and rationals of the test, counts by walking all codes one by
 * one, and numbers that were found in programs or by hand.
 */
#include "convert/convert.h"
#include "oracle.h"
#include "printed.h"
#include "support.h"

typedef struct copy {
    convert_chain chain;
    mpq_t value, half;
    mpfr_t x, y;
} copy;

static void copy_init(copy *c) {
    mpq_inits(c->value, c->half, NULL);
    mpq_set_ui(c->half, 1, 2);
    mpfr_inits2(24, c->x, c->y, NULL);
}

static void copy_clear(copy *c) {
    mpq_clears(c->value, c->half, NULL);
    mpfr_clears(c->x, c->y, NULL);
}

static bool is_binary32(const dp_format *f) {
    return strcmp(f->name, "fp32") == 0;
}

/* ---- The way of a code ------------------------------------------------------------------------------------------- */

static void read_to(copy *c, const dp_format *f, uint32_t code) {
    const convert_rule *rule = &c->chain.read;
    const double factor = rule->factor > 0 ? rule->factor : (double)f->code_max;
    if (f->kind == DP_FORMAT_FLOAT || strcmp(rule->way->name, "exact") == 0) {
        oracle_value(c->value, f, code);
        if (c->chain.flush && f->kind == DP_FORMAT_FLOAT && code < 1U << f->mantissa_bits)
            mpq_set_ui(c->value, 0, 1);
        return;
    }
    mpfr_set_ui(c->x, code, MPFR_RNDN);
    mpfr_set_d(c->y, factor, MPFR_RNDN);
    if (strcmp(rule->way->name, "divide") == 0) {
        mpfr_div(c->x, c->x, c->y, MPFR_RNDN);
    } else {
        mpfr_ui_div(c->y, 1, c->y, MPFR_RNDN);
        mpfr_mul(c->x, c->x, c->y, MPFR_RNDN);
    }
    mpfr_get_q(c->value, c->x);
}

static void compute(copy *c, const dp_format *f, mpz_t whole) {
    const convert_rule *rule = &c->chain.write;
    const double factor = rule->factor > 0 ? rule->factor : (double)f->code_max;
    mpfr_set_q(c->x, c->value, MPFR_RNDN);
    mpfr_mul_d(c->x, c->x, factor, MPFR_RNDN);
    if (strcmp(rule->way->name, "half") == 0)
        mpfr_add_d(c->x, c->x, 0.5, MPFR_RNDN);
    if (strcmp(rule->way->name, "round") == 0)
        mpfr_rint(c->x, c->x, MPFR_RNDN);
    else
        mpfr_floor(c->x, c->x);
    mpfr_get_z(whole, c->x, MPFR_RNDN);
}

static uint32_t rounded(copy *c, const dp_format *f, dp_rounding rounding) {
    if (mpq_cmp_ui(c->value, 1, 1) >= 0)
        return f->code_max;
    return oracle_round(f, rounding, mpq_numref(c->value), mpq_denref(c->value));
}

static uint32_t write_from(copy *c, const dp_format *f) {
    const char *way = c->chain.write.way->name;
    const bool moves = strcmp(way, "shift") == 0 || strcmp(way, "replicate") == 0;
    if (f->kind == DP_FORMAT_UNORM && strcmp(way, "nearest") != 0 && !moves) {
        mpz_t whole;
        mpz_init(whole);
        compute(c, f, whole);
        const bool beyond = mpz_cmp_ui(whole, f->code_max) > 0;
        mpz_fdiv_r_2exp(whole, whole, (mp_bitcnt_t)f->bits);
        const uint32_t code = beyond && c->chain.saturate ? f->code_max : (uint32_t)mpz_get_ui(whole);
        mpz_clear(whole);
        return code;
    }
    const bool cut = strcmp(way, "cut") == 0 && !is_binary32(f);
    const uint32_t code = rounded(c, f, cut ? DP_ROUND_ZERO : DP_ROUND_NEAREST);
    return c->chain.flush && f->kind == DP_FORMAT_FLOAT && code < 1U << f->mantissa_bits ? 0 : code;
}

/* Written as a text of bits, highest first. */
static uint32_t moved(bool fills, int from, int to, uint32_t code) {
    uint32_t out = 0;
    for (int i = 0; i < to; i++) {
        const int at = i < from ? i : fills ? i % from : -1;
        out = 2 * out + (at >= 0 ? code >> (from - 1 - at) & 1U : 0);
    }
    return out;
}

static uint32_t step(copy *c, const dp_format *from, const dp_format *to, uint32_t code) {
    const char *way = c->chain.write.way->name;
    const bool fills = strcmp(way, "replicate") == 0;
    if ((fills || strcmp(way, "shift") == 0) && from->kind == DP_FORMAT_UNORM && to->kind == DP_FORMAT_UNORM)
        return moved(fills, from->bits, to->bits, code);
    read_to(c, from, code);
    return write_from(c, to);
}

static dp_format some_format(rng *r) {
    static const char *const names[] = {"fp16", "fp32", "unorm16", "unorm24", "float4.20b15", "unorm32", "unorm8"};
    dp_format f[2];
    const uint64_t i = rng_below(r, 10);
    if (i < sizeof names / sizeof names[0]) {
        assert_int_equal(dp_format_parse(names[i], f), 1);
        return f[0];
    }
    if (rng_below(r, 2) == 0)
        return oracle_unorm(1 + (int)rng_below(r, 32));
    const int e = 2 + (int)rng_below(r, 7);
    return oracle_float(e, 1 + (int)rng_below(r, 23), 1 + (int)rng_below(r, e == 8 ? 140 : (1U << e) - 1));
}

static convert_rule some_rule(rng *r, const named_table *table) {
    static const double factors[] = {0, 0, 0x1p24, 65536, 16777215, 1, 3, 0x1p32, 255};
    const convert_way *way = named_at(table, rng_below(r, table->count));
    return (convert_rule){way, way->scales ? factors[rng_below(r, sizeof factors / sizeof factors[0])] : 0};
}

static convert_chain some_chain(rng *r) {
    convert_chain c = {.count = 2 + (int)rng_below(r, 2),
                       .read = some_rule(r, &convert_read_table),
                       .write = some_rule(r, &convert_write_table),
                       .saturate = rng_below(r, 2) == 0,
                       .flush = rng_below(r, 4) == 0};
    for (int i = 0; i < c.count; i++)
        c.format[i] = some_format(r);
    if (c.count > 2 && rng_below(r, 2) == 0)
        c.format[2] = c.format[0];
    return c;
}

static uint32_t some_code(rng *r, const dp_format *f) {
    const uint32_t most = f->code_max;
    switch (rng_below(r, 6)) {
    case 0:
        return (uint32_t)rng_below(r, (most < 8 ? most : 8U) + 1U);
    case 1:
        return most - (uint32_t)rng_below(r, (most < 8 ? most : 8U) + 1U);
    case 2:
        return most / 2 + (uint32_t)rng_below(r, 2 + most / 8) % (most - most / 2 + 1);
    default:
        return (uint32_t)rng_below(r, (uint64_t)most + 1);
    }
}

TEST(each_way_of_each_code) {
    rng r = rng_make("convert");
    tally t = {.name = "codes on their way"};
    uint64_t ways[2][8] = {{0}}, changes = 0, beyond = 0;
    copy c;
    copy_init(&c);
    for (uint64_t i = test_cases(20000, 200000, 800000); i > 0; i--) {
        c.chain = some_chain(&r);
        const uint32_t code = some_code(&r, &c.chain.format[0]);
        const convert_path p = convert_code(&c.chain, code);
        uint32_t want = code;
        bool same = p.code[0] == code;
        for (int k = 1; k < c.chain.count; k++) {
            want = step(&c, &c.chain.format[k - 1], &c.chain.format[k], want);
            same = same && p.code[k] == want;
        }
        TALLY(&t, same, "%s %s %s, read %s:%g, write %s:%g, code %u: %u %u, last %u", c.chain.format[0].name,
              c.chain.format[1].name, c.chain.count > 2 ? c.chain.format[2].name : "-", c.chain.read.way->name,
              c.chain.read.factor, c.chain.write.way->name, c.chain.write.factor, code, p.code[1], p.code[2], want);
        mpq_t last;
        mpq_init(last);
        oracle_value(c.value, &c.chain.format[0], code);
        oracle_value(last, &c.chain.format[c.chain.count - 1], want);
        TALLY(&t, p.changed == !mpq_equal(c.value, last), "%s to %s: %u changed", c.chain.format[0].name,
              c.chain.format[c.chain.count - 1].name, code);
        mpq_clear(last);
        ways[0][c.chain.read.way - convert_read_get(0)]++;
        ways[1][c.chain.write.way - convert_write_get(0)]++;
        changes += p.changed;
        beyond += isnan(p.beyond[1]) && isnan(p.beyond[2]) ? 0 : 1;
    }
    copy_clear(&c);
    for (size_t i = 0; i < convert_read_table.count; i++)
        assert_true(ways[0][i] > 0);
    for (size_t i = 0; i < convert_write_table.count; i++)
        assert_true(ways[1][i] > 0);
    assert_true(changes > 0 && beyond > 0);
    tally_end(&t);
}

/* ---- Counts ------------------------------------------------------------------------------------------------------ */

static bool same_number(const convert_chain *c, uint32_t a, uint32_t b) {
    mpq_t x, y;
    mpq_inits(x, y, NULL);
    oracle_value(x, &c->format[0], a);
    oracle_value(y, &c->format[c->count - 1], b);
    const bool same = mpq_equal(x, y) != 0;
    mpq_clears(x, y, NULL);
    return same;
}

TEST(all_codes_are_counted) {
    rng r = rng_make("counted");
    tally t = {.name = "counts"};
    for (uint64_t i = test_cases(200, 1500, 6000); i > 0; i--) {
        convert_chain c = some_chain(&r);
        do {
            c.format[0] = some_format(&r);
        } while (c.format[0].code_max > 1U << 12);
        const bool back = rng_below(&r, 2) == 0;
        if (back)
            c.format[c.count - 1] = c.format[0];
        const convert_found got = convert_all(&c, 1 + (int)rng_below(&r, 3));
        convert_found want = {0};
        uint32_t before = 0;
        for (uint32_t code = 0; code <= c.format[0].code_max; code++) {
            const convert_path p = convert_code(&c, code);
            const uint32_t to = p.code[c.count - 1], by = to > code ? to - code : code - to;
            const bool changed = !same_number(&c, code, to);
            if (changed && want.changed == 0)
                want.first = p;
            if (back && by > want.by)
                want.by = by, want.most = p;
            want.codes++;
            want.changed += changed;
            want.beyond += isnan(p.beyond[1]) && isnan(p.beyond[2]) ? 0 : 1;
            want.merged += code > 0 && to == before;
            want.swapped += code > 0 && to < before;
            before = to;
        }
        TALLY(&t,
              got.codes == want.codes && got.changed == want.changed && got.beyond == want.beyond &&
                  got.merged == want.merged && got.swapped == want.swapped &&
                  (want.changed == 0 || got.first.code[0] == want.first.code[0]) &&
                  (!back || (got.by == want.by && (got.by == 0 || got.most.code[0] == want.most.code[0]))),
              "%s %s %s, %s:%g, %s:%g: changed %llu %llu, merged %llu %llu, swapped %llu %llu, beyond %llu %llu, by %u "
              "%u at %u %u",
              c.format[0].name, c.format[1].name, c.count > 2 ? c.format[2].name : "-", c.read.way->name, c.read.factor,
              c.write.way->name, c.write.factor, (unsigned long long)got.changed, (unsigned long long)want.changed,
              (unsigned long long)got.merged, (unsigned long long)want.merged, (unsigned long long)got.swapped,
              (unsigned long long)want.swapped, (unsigned long long)got.beyond, (unsigned long long)want.beyond, got.by,
              want.by, got.most.code[0], want.most.code[0]);
    }
    tally_end(&t);
}

static convert_chain chain_of(const char *const names[3], const char *write, double factor, bool saturate, bool flush) {
    convert_chain c = {.read = {convert_read_find("exact"), 0},
                       .write = {convert_write_find(write), factor},
                       .saturate = saturate,
                       .flush = flush};
    dp_format f[2];
    for (int i = 0; i < 3 && names[i] != NULL; i++) {
        assert_int_equal(dp_format_parse(names[i], f), 1);
        c.format[c.count++] = f[0];
    }
    return c;
}

static convert_found found(const char *const names[3], const char *write, double factor, bool saturate, bool flush) {
    const convert_chain c = chain_of(names, write, factor, saturate, flush);
    return convert_all(&c, 0);
}

/*
 * By hand. c/(2^24 - 1) times 2^24 is c + c/(2^24 - 1). From 2^23 on floats are 2^-24 apart, and the sum is rounded up
 * to c + 1; below, it is cut or stays c and a half. With 1/2 added, floats of 2^23 and more have no halves: c + 1/2
 * goes to the even one of c and c + 1, so that odd codes change.
 */
TEST(factors_of_programs) {
    const char *const names[3] = {"unorm24", "fp32", "unorm24"};
    convert_found f = found(names, "cut", 0x1p24, false, false);
    assert_int_equal(f.codes, 1U << 24);
    assert_int_equal(f.changed, 8388608);
    assert_int_equal(f.first.code[0], 8388608);
    assert_int_equal(f.first.code[2], 8388609);
    assert_int_equal(f.beyond, 1);
    assert_int_equal(f.swapped, 1);
    f = found(names, "cut", 0x1p24, true, false);
    assert_int_equal(f.changed, 8388607);
    assert_int_equal(f.swapped, 0);
    assert_int_equal(f.by, 1);
    assert_int_equal(found(names, "nearest", 0, false, false).changed, 0);
    assert_int_equal(found(names, "round", 0, false, false).changed, 0);
    f = found(names, "half", 0, true, false);
    assert_int_equal(f.changed, 4194303); /* the last, which is odd, is kept */
    assert_int_equal(f.first.code[0], 8388609);
}

/* Each way back that takes a factor is tried by 2^24, too, and told with what comes of that. */
TEST(ways_side_by_side) {
    static const char *const scaled[] = {"cut", "half", "round"};
    json_t *root = json_printed(0, "convert d24 fp32 d24");
    json_t *ways = json_object_get(root, "ways");
    for (size_t i = 0; i < 3; i++) {
        char name[32];
        size_t seen = 0;
        snprintf(name, sizeof name, "%s:16777216", scaled[i]);
        for (size_t k = 0; k < json_array_size(ways); k++) {
            json_t *const way = json_array_get(ways, k);
            if (strcmp(text_at(way, "write"), name) != 0)
                continue;
            const char *const names[3] = {"unorm24", "fp32", "unorm24"};
            assert_true(number_at(way, "changed") == (double)found(names, scaled[i], 0x1p24, false, false).changed);
            assert_true(i > 0 || number_at(way, "first") == 8388608);
            seen++;
        }
        assert_int_equal(seen, 1);
    }
    json_decref(root);
}

/*
 * A quotient just below the middle between two floats, which binary64 rounds to it: 21 ones, three bits, 01111111, and
 * over 2^32 - 1 the same again. The nearest float has the first 24 bits, also where they are odd.
 */
TEST(rounded_twice) {
    for (uint32_t bits = 4; bits < 8; bits++) {
        const uint32_t code = 0xFFFFF800 | bits << 8 | 0x7F;
        printed p = print_of("convert unorm32 fp32 --code %u --json", code);
        json_t *root = json_of(p.out);
        assert_int_equal(p.status, 0);
        assert_true(number_at(root, "codes[0].becomes") == 0x3F000000 + (0x7FFFF8 | bits));
        json_decref(root);
        printed_free(&p);
    }
}

/* 16 bits in 24: c 2^8 is the largest whose high bits are c. */
TEST(bits_that_are_moved) {
    const char *const names[3] = {"unorm16", "unorm24", "unorm16"}, *const up[3] = {"unorm16", "unorm24", NULL};
    assert_int_equal(found(names, "shift", 0, false, false).changed, 0);
    assert_int_equal(found(names, "replicate", 0, false, false).changed, 0);
    /* 2^16 - 1 and 2^24 - 1 have 255 in common, so that 256 numbers of the one are of the other: 0xABAB is 0xABABAB. */
    assert_int_equal(found(up, "shift", 0, false, false).changed, 65535);
    assert_int_equal(found(up, "replicate", 0, false, false).changed, 65280);
    assert_int_equal(found(up, "nearest", 0, false, false).changed, 65280);
}

/* Floats without subnormals: of 12 bits all below 0x1000 are 0. */
TEST(subnormals_that_are_flushed) {
    const char *const names[3] = {"float4.12b7", "fp32", "float4.12b7"};
    const convert_found f = found(names, "nearest", 0, false, true);
    assert_int_equal(f.changed, 4095);
    assert_int_equal(f.first.code[0], 1);
    assert_int_equal(found(names, "nearest", 0, false, false).changed, 0);
}

/* ---- The command ------------------------------------------------------------------------------------------------- */

/* The outcome of a way: `whole` that which was asked for, which has more fields. */
static void want_way(values *v, const convert_chain *c, bool whole) {
    const convert_found f = convert_all(c, 0);
    char name[32];
    snprintf(name, sizeof name, c->write.factor > 0 ? "%s:%.0f" : "%s", c->write.way->name, c->write.factor);
    want(v, "write=%s changed=%lu", name, f.changed);
    want(v, "first=%f becomes=%f", f.changed > 0 ? f.first.code[0] : (double)NAN,
         f.changed > 0 ? f.first.code[c->count - 1] : (double)NAN);
    want(v, "beyond=%lu", f.beyond);
    if (whole)
        want(v, "codes=%lu most=%f most_at=%f equal=%d merged=%lu swapped=%lu", f.codes, f.by > 0 ? f.by : (double)NAN,
             f.by > 0 ? f.most.code[0] : (double)NAN, f.changed == 0, f.merged, f.swapped);
}

typedef struct row {
    const char *line, *names[3], *write;
    double factor;
    bool saturate;
    size_t codes;
    uint32_t code[3];
} row;

static const row rows[] = {
    {"convert d16 fp16 d16 --code 0,1,65535", {"unorm16", "fp16", "unorm16"}, "nearest", 0, false, 3, {0, 1, 65535}},
    {"convert fp32 d16 --write cut:65536 --code 1065353216,1000",
     {"fp32", "unorm16"},
     "cut",
     65536,
     false,
     2,
     {1065353216, 1000}},
    {"convert d24 d16 d24 --write cut:16777216 --code 16777215,77",
     {"unorm24", "unorm16", "unorm24"},
     "cut",
     16777216,
     false,
     2,
     {16777215, 77}},
    {"convert unorm10 fp32 unorm10 --write cut:1500", {"unorm10", "fp32", "unorm10"}, "cut", 1500, false, 0, {0}},
    {"convert unorm12 fp16 unorm12 --write half --saturate", {"unorm12", "fp16", "unorm12"}, "half", 0, true, 0, {0}},
    {"convert unorm12 unorm8 unorm12", {"unorm12", "unorm8", "unorm12"}, "nearest", 0, false, 0, {0}},
    {"convert float4.6 unorm8", {"float4.6", "unorm8"}, "nearest", 0, false, 0, {0}},
    {"convert unorm8 unorm10", {"unorm8", "unorm10"}, "nearest", 0, false, 0, {0}},
    {"convert unorm10 fp32 unorm10", {"unorm10", "fp32", "unorm10"}, "nearest", 0, false, 0, {0}},
    {"convert unorm10 fp32 unorm10 --write cut:2000", {"unorm10", "fp32", "unorm10"}, "cut", 2000, false, 0, {0}},
    {"convert unorm4 unorm3 unorm4", {"unorm4", "unorm3", "unorm4"}, "nearest", 0, false, 0, {0}},
    {"convert unorm6 unorm4 unorm6", {"unorm6", "unorm4", "unorm6"}, "nearest", 0, false, 0, {0}},
    {"convert unorm8 unorm10 --write cut:2000", {"unorm8", "unorm10"}, "cut", 2000, false, 0, {0}},
};

static void want_codes(values *v, const row *r, const convert_chain *c) {
    char name[32];
    snprintf(name, sizeof name, r->factor > 0 ? "%s:%.0f" : "%s", r->write, r->factor);
    want_text(v, "write", name);
    for (size_t k = 0; k < r->codes; k++) {
        const convert_path p = convert_code(c, r->code[k]);
        values_under(v, "codes[%zu].", k);
        want(v, "code=%u number=%f through=%f", p.code[0], p.number, c->count > 2 ? p.code[1] : (double)NAN);
        want(v, "becomes=%u beyond=%f changed=%d", p.code[c->count - 1], isnan(p.beyond[1]) ? p.beyond[2] : p.beyond[1],
             p.changed);
    }
}

/* Beside what was asked for each way, by the largest code and by the number of codes. */
static void want_ways(values *v, const convert_chain *c) {
    const dp_format *from = &c->format[0], *to = &c->format[c->count - 1];
    const bool moved = from->kind == DP_FORMAT_UNORM && c->format[1].kind == DP_FORMAT_UNORM;
    size_t n = 0;
    want_way(v, c, true);
    for (size_t k = 0; from->code_max == to->code_max && convert_write_get(k) != NULL; k++) {
        convert_chain other = *c;
        other.write = (convert_rule){convert_write_get(k), 0};
        if (other.write.way->moves && !moved)
            continue;
        values_under(v, "ways[%zu].", n++);
        want_way(v, &other, false);
        if (!other.write.way->scales || moved)
            continue;
        other.write.factor = (double)to->code_max + 1;
        values_under(v, "ways[%zu].", n++);
        want_way(v, &other, false);
    }
}

static void check_note(char *text, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* A note of the page, whose lines may be broken. */
static void check_note(char *text, const char *format, ...) {
    char note[256];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(note, sizeof note, format, arguments);
    va_end(arguments);
    if (strstr(text, note) == NULL)
        fail_msg("no '%s' in %s", note, text);
}

/* What the page says of all codes. */
static void check_page(const row *r, const convert_chain *c) {
    const convert_found f = convert_all(c, 0);
    const int last = c->count - 1;
    const bool back = strcmp(r->names[0], r->names[last]) == 0;
    char *text = output_of(0, r->line, ""), beyond[64];
    for (char *at = text; (at = strstr(at, "\n            ")) != NULL;)
        memmove(at + 1, at + 13, strlen(at + 13) + 1), *at = ' ';
    check_note(text, "\n  %s   %llu of %llu %s\n", back ? "changed" : "rounded", (unsigned long long)f.changed,
               (unsigned long long)f.codes, back ? "codes" : "numbers");
    if (f.changed > 0)
        check_note(text, "\n  first     %s%u becomes %u\n", back ? "" : "code ", f.first.code[0], f.first.code[last]);
    if (f.by > 1)
        check_note(text, "\n  most      by %u codes, at %u\n", f.by, f.most.code[0]);
    assert_int_equal(strstr(text, "\n  most ") != NULL, f.by > 1);
    assert_int_equal(strstr(text, "\n  EQUAL     holds") != NULL, back && f.changed == 0);
    assert_int_equal(strstr(text, "\n  EQUAL     fails") != NULL, back && f.changed > 0);
    assert_int_equal(strstr(text, "\n  order     kept;") != NULL, f.swapped == 0);
    assert_int_equal(strstr(text, "no two codes become one") != NULL, f.merged == 0);
    if (f.merged > 0)
        check_note(text, "%llu pair%s of neighbours", (unsigned long long)f.merged, f.merged == 1 ? "" : "s");
    snprintf(beyond, sizeof beyond, "\n  beyond    %llu number%s no code of %s: %s", (unsigned long long)f.beyond,
             f.beyond == 1 ? " has" : "s have", r->names[last], r->saturate ? "stored as the last" : "the low bits");
    assert_int_equal(strstr(text, beyond) != NULL, f.beyond > 0);
    assert_int_equal(strstr(text, "\n  beyond ") != NULL, f.beyond > 0);
    free(text);
}

TEST(each_number) {
    static const char heads[] = "from = /from, through = /through, to = /to, read = /read, write = /write";
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const row *r = &rows[i];
        const convert_chain c = chain_of(r->names, r->write, r->factor, r->saturate, false);
        char columns[256];
        values v = values_of(r->line);
        line_places one = {NULL, 0};
        want(&v, "from=%s through=%s to=%s read=%s", c.format[0].name, c.count > 2 ? c.format[1].name : NULL,
             c.format[c.count - 1].name, "exact");
        (r->codes > 0 ? want_codes(&v, r, &c) : want_ways(&v, &c));
        snprintf(columns, sizeof columns, "%s, %s", heads,
                 r->codes > 0 ? "code, number, through, becomes, beyond, changed"
                              : "codes, changed, first, becomes, most, most_at, equal, merged, swapped, beyond");
        if (r->codes > 0) {
            check_forms(&v, 0, r->line, "codes[]", columns);
        } else {
            check_json(&v, 0, r->line);
            check_page(r, &c);
            place_add(&one, "", "%s", "");
            check_csv(&v, 0, r->line, columns, &one);
        }
        places_free(&one);
        values_free(&v);
    }
}

LIST_TEST(check_apart)
