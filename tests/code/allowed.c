/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "allowed.h"

#include <ctype.h>

/* ---- Operations -------------------------------------------------------------------------------------------------- */

const promise promises[PROMISES] = {{"glsl", 1, 2.5, false, true}, {"hlsl", 1, 1, false, true},
                                    {"wgsl", 1, 2.5, true, true},  {"msl", 1, 1, true, true},
                                    {"c", 0.5, 0.5, true, false},  {"numpy", 0.5, 0.5, false, false}};
enum { C = 4, NUMPY };

const promised_powers powers[POWERS] = {{3 * 0x1p-23, 0x1p-22, 3 * 0x1p-23, 0x1p-21},
                                        {0x1p-21, 0, 0x1p-21, 0x1p-21},
                                        {3 * 0x1p-23, 0x1p-22, 3 * 0x1p-23, 0x1p-21},
                                        {0x1p-21, 0, 0x1p-21, 0}};

device device_of(rng *r, size_t p, int i) {
    return (device){r,
                    promises[p].sums,
                    promises[p].quotients,
                    promises[p].fuses && i % 2 == 0,
                    promises[p].flushes,
                    i / 2 % 3 - 1};
}

/* How far, of what is allowed. */
static double share_of(const device *v) {
    return v->bias == 2 ? (rng_below(v->r, 2) == 0 ? -1 : 1) : v->bias != 0 ? v->bias : rng_uniform(v->r, -1, 1);
}

float flushed(const device *v, float x) {
    return v->flushes && fabsf(x) < 0x1p-126f && v->bias <= 0 ? 0.0f : x;
}

float rounded(const device *v, long double x, double ulps) {
    const float nearest = (float)x; /* of long double: rounded once */
    if (x == 0 || ulps < 1 || (ulps == 1 && (long double)nearest == x))
        return flushed(v, nearest);
    int exponent;
    frexpl(x, &exponent);
    const long double ulp = ldexpl(1, exponent - 24 > -149 ? exponent - 24 : -149), most = ulps * ulp;
    float y = (float)(x + share_of(v) * most);
    while (fabsl((long double)y - x) > most || (ulps <= 1 && fabsl((long double)y - x) >= ulp))
        y = nextafterf(y, (float)x);
    return flushed(v, y);
}

float within(const device *v, long double x, long double most) {
    float y = (float)(x + share_of(v) * most);
    while (fabsl(y - x) > most && y != (float)x)
        y = nextafterf(y, (float)x);
    return flushed(v, y);
}

/* ---- Reading what is printed ------------------------------------------------------------------------------------- */

/* A number; of a product what it is before it is rounded, too. A wide one is of binary64. */
typedef struct number {
    long double exact;
    double is;
    bool product, wide;
} number;

typedef struct reader {
    const char *at;
    const device *v;
    size_t p;
    struct {
        char name[8];
        number is;
    } known[64];
    size_t count;
} reader;

static void skip_blanks(reader *r) {
    while (*r->at == ' ')
        r->at++;
}

static size_t letters(const char *at) {
    size_t length = 0;
    while (isalnum((unsigned char)at[length]) || at[length] == '_')
        length++;
    return length;
}

static bool took(reader *r, const char *word) {
    skip_blanks(r);
    const bool is = *r->at == *word && strncmp(r->at, word, strlen(word)) == 0;
    r->at += is ? strlen(word) : 0;
    return is;
}

static void must(reader *r, const char *word) {
    if (!took(r, word))
        fail_msg("'%s' is missing before '%.40s'", word, r->at);
}

static number plain(double x, bool wide) {
    return (number){x, x, false, wide};
}

/* Wide operations are so much finer that they are taken to be to nearest. */
static number made(const reader *r, long double exact, double ulps, bool wide) {
    return (number){exact, wide ? (double)exact : (double)rounded(r->v, exact, ulps), false, wide};
}

static number known(const reader *r, const char *name, size_t length) {
    for (size_t i = r->count; i-- > 0;)
        if (r->known[i].name[0] == *name && strlen(r->known[i].name) == length &&
            strncmp(r->known[i].name, name, length) == 0)
            return r->known[i].is;
    fail_msg("'%.*s' is not known", (int)length, name);
    return plain(0, false);
}

static number sum_of(reader *r);

static float even(float x) {
    return rintf(x);
}

static number power_of(const reader *r, bool two, number x) {
    const promised_powers *of = &powers[r->p < POWERS ? r->p : 0];
    const long double exact = two ? exp2l((long double)x.is) : log2l((long double)x.is);
    const bool inside = !two && x.is >= 0.5 && x.is <= 2 && of->inside > 0;
    const long double most = two      ? exact * (of->exp2 + of->each * fabs(x.is))
                             : inside ? (long double)of->inside
                                      : fabsl(exact) * of->log2;
    return plain((double)within(r->v, exact, r->p < POWERS ? most : 0), false);
}

/* A function of one number or two, whatever the language puts around its name. */
static number call(reader *r, const char *name) {
    static const char *const evens[] = {"roundEven", "round", "rint"};
    number x = sum_of(r), y = plain(0, false);
    if (took(r, ","))
        y = sum_of(r);
    must(r, ")");
    for (size_t i = 0; i < sizeof evens / sizeof evens[0]; i++)
        if (strcmp(name, evens[i]) == 0)
            return plain((double)even((float)x.is), false);
    if (strcmp(name, "abs") == 0)
        return plain(fabs(x.is), x.wide);
    if (strcmp(name, "floor") == 0 || strcmp(name, "whole") == 0)
        return plain(floor(x.is), x.wide);
    if (strcmp(name, "sqrt") == 0)
        return made(r, sqrtl((long double)x.is), r->v->sums, x.wide);
    if (strcmp(name, "max") == 0 || strcmp(name, "min") == 0)
        return plain((*(name + 1) == 'a') == (x.is > y.is) ? x.is : y.is, x.wide);
    if (strcmp(name, "copysign") == 0)
        return plain(copysign(x.is, y.is), x.wide);
    if (strcmp(name, "step") == 0)
        return plain(y.is >= x.is, false);
    if (strcmp(name, "exp2") == 0 || strcmp(name, "log2") == 0)
        return power_of(r, *name == 'e', x);
    fail_msg("'%s' is no function", name);
    return x;
}

/* "np.fmax", "fmaxf" and "max" are "max"; behind it its parenthesis is taken. */
static void function_name(reader *r, char out[16]) {
    static const char *const names[][2] = {{"fabs", "abs"},   {"fmax", "max"},  {"fmin", "min"},
                                           {"uint", "whole"}, {"u32", "whole"}, {"uint32", "whole"}};
    size_t length = strcspn(r->at, "(");
    assert_true(length < 16);
    memcpy(out, r->at, length);
    r->at += length + 1;
    length -= r->p == C && length > 1 && out[length - 1] == 'f' ? 1 : 0;
    out[length] = '\0';
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        if (strcmp(out, names[i][0]) == 0)
            strcpy(out, names[i][1]);
}

/* The first estimate of 1/x, by its bits. */
static bool magic(reader *r, number *out) {
    static const char *const forms[] = {"uintBitsToFloat(0x7ef311c7u - floatBitsToUint(",
                                        "asfloat(0x7ef311c7u - asuint(",
                                        "bitcast<f32>(0x7ef311c7u - bitcast<u32>(",
                                        "as_type<float>(0x7ef311c7u - as_type<uint>(",
                                        ("((union { uint32_t u; float f; }){.u = 0x7ef311c7u - "
                                         "(union { float f; uint32_t u; }){"),
                                        "(np.uint32(0x7ef311c7) - "};
    if (!took(r, forms[r->p]))
        return false;
    const float x = (float)known(r, r->at, 1).is;
    uint32_t bits;
    float y;
    memcpy(&bits, &x, sizeof bits);
    bits = 0x7ef311c7u - bits;
    memcpy(&y, &bits, sizeof y);
    r->at += strcspn(r->at, ";\n");
    *out = plain((double)y, false);
    return true;
}

static number literal(reader *r) {
    char *end;
    const char *from = r->at;
    const double wide = strtod(from, &end), single = (double)strtof(from, &end);
    r->at = end;
    const bool is_wide = r->p == C && *end != 'f';
    r->at += *end == 'f';
    return plain(is_wide ? wide : single, is_wide);
}

static number fused(reader *r) {
    const number a = sum_of(r);
    must(r, ",");
    const number b = sum_of(r);
    must(r, ",");
    const number c = sum_of(r);
    must(r, ")");
    return made(r, (long double)a.is * b.is + c.is, r->v->sums, false);
}

static number factor(reader *r) {
    number x;
    char name[16];
    skip_blanks(r);
    if (magic(r, &x))
        return x;
    if (took(r, "np.float64(")) {
        x = plain(strtod(r->at, (char **)&r->at), true);
        must(r, ")");
        return x;
    }
    if (took(r, "np.float32(") || took(r, "(uint32_t)(")) {
        const bool whole = r->at[-2] == ')';
        x = sum_of(r);
        must(r, ")");
        return plain(whole ? floor(x.is) : (double)(float)x.is, false);
    }
    if (took(r, "(float)"))
        return plain((double)(float)factor(r).is, false);
    if (took(r, "fmaf(") || took(r, "fma("))
        return fused(r);
    took(r, "np.");
    if (took(r, "-")) {
        x = factor(r);
        return (number){-x.exact, -x.is, x.product, x.wide};
    }
    if (took(r, "(")) {
        x = sum_of(r);
        must(r, ")");
        x.product = x.product && r->v->fuses;
        return x;
    }
    if (isdigit((unsigned char)*r->at))
        return literal(r);
    const size_t length = letters(r->at);
    if (r->at[length] == '(') {
        function_name(r, name);
        return call(r, name);
    }
    x = known(r, r->at, length);
    r->at += length;
    return x;
}

static number product_of(reader *r) {
    number left = factor(r);
    for (;;) {
        if (took(r, "* ")) {
            const number right = factor(r);
            left = made(r, (long double)left.is * right.is, r->v->sums, left.wide || right.wide);
            left.product = true;
        } else if (took(r, "/ ")) {
            const number right = factor(r);
            left = made(r, (long double)left.is / right.is, r->v->quotients, left.wide || right.wide);
        } else {
            return left;
        }
    }
}

/* A product may enter as it was before it was rounded: one of the two. */
static number sum_of(reader *r) {
    number left = product_of(r);
    for (;;) {
        const bool plus = took(r, "+ ");
        if (!plus && !took(r, "- "))
            return left;
        const number right = product_of(r);
        const bool fuses = r->v->fuses && !left.wide && !right.wide;
        const long double a = fuses && left.product && !right.product ? left.exact : left.is,
                          b = fuses && right.product ? right.exact : right.is;
        left = made(r, plus ? a + b : a - b, r->v->sums, left.wide || right.wide);
    }
}

/* ---- Functions --------------------------------------------------------------------------------------------------- */

static void learn(reader *r, const char *name, size_t length, number is) {
    assert_true(length < sizeof r->known[0].name && r->count < sizeof r->known / sizeof r->known[0]);
    snprintf(r->known[r->count].name, sizeof r->known[0].name, "%.*s", (int)length, name);
    r->known[r->count++].is = is;
}

/* "float x, float y", "x: f32, y: f32", "x, y": behind the parenthesis. */
static void learn_parameters(reader *r, const float *given) {
    for (const char *end = r->at; *end != ')'; r->at = end + (*end == ',')) {
        skip_blanks(r);
        took(r, "float ");
        const size_t length = letters(r->at);
        learn(r, r->at, length, plain((double)flushed(r->v, *given++), false));
        end = r->at + strcspn(r->at, ",)");
    }
}

/* Members stand behind the last bracket that opens; else it is one number. */
static int results(reader *r, double out[4]) {
    char line[256];
    int count = 0;
    snprintf(line, sizeof line, "%.*s", (int)strcspn(r->at, "\n"), r->at);
    const char *last = line;
    for (const char *at = line; *at != '\0'; at++)
        last = strchr("([{", *at) != NULL ? at + 1 : last;
    if (last[letters(last)] == ',')
        for (;; last += 2) {
            out[count++] = known(r, last, letters(last)).is;
            last += letters(last);
            if (*last != ',' || !isalpha((unsigned char)last[2]))
                return count;
        }
    out[0] = sum_of(r).is;
    return 1;
}

static bool in_comment(const char *text, const char *at) {
    while (at > text && at[-1] != '\n')
        at--;
    return strncmp(at, "//", 2) == 0 || *at == '#';
}

int printed_compute(const char *text, const char *name, size_t p, const device *v, const float *given, double out[4]) {
    char head[32];
    reader r = {.v = v, .p = p};
    snprintf(head, sizeof head, " %s(", name);
    r.at = text;
    do {
        r.at = strstr(r.at, head);
        assert_non_null(r.at);
        r.at += strlen(head);
    } while (in_comment(text, r.at));
    learn_parameters(&r, given);
    for (;;) {
        r.at = strchr(r.at, '\n');
        assert_non_null(r.at);
        r.at++;
        if (took(&r, "return "))
            return results(&r, out);
        const char *is = strstr(r.at, " = ");
        const size_t length = strcspn(r.at, "\n");
        if (is == NULL || is > r.at + length)
            continue;
        const char *from = is;
        while (isalnum((unsigned char)from[-1]))
            from--;
        r.at = is + 3;
        if (strncmp(r.at, "np.asarray", 10) == 0) { /* the parameter itself */
            number own = known(&r, from, (size_t)(is - from));
            own.wide = strstr(r.at, "float64") != NULL && strstr(r.at, "float64") < strchr(r.at, '\n');
            learn(&r, from, (size_t)(is - from), own);
            continue;
        }
        const number value = sum_of(&r);
        learn(&r, from, (size_t)(is - from), plain(value.is, value.wide));
    }
}
