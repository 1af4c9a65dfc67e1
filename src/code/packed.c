/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Packed depths and normals as code. The texts of a packing are made of its weights: whole numbers of binary32, which
 * every language computes exactly, but for one product or quotient; see depthprec-code(1).
 */
#include <math.h>
#include <string.h>

#include "code/code.h"
#include "core/append.h"
#include "core/bits.h"
#include "core/elementary.h"
#include "report/number.h"

enum { BYTE = 255 };

/* ---- Depth ------------------------------------------------------------------------------------------------------- */

/* The channels that hold the depth, the coarsest first; all but the last one of more than 24 bits are digits of a whole
 * number of at most `most`, and that is the rest of it in `rest` parts. */
typedef struct digits {
    int channel[IMAGE_CHANNELS_MAX], count;
    double weight[IMAGE_CHANNELS_MAX], most, rest; /* rest: 0 where there is none */
} digits;

static digits digits_of(const packing *p) {
    digits d = {.count = 0};
    const bool upwards = p->weight[0] == 1;
    for (uint32_t k = 0; k < p->channels; k++) {
        const uint32_t at = upwards ? p->channels - 1 - k : k;
        if (p->weight[at] == 0)
            continue;
        d.channel[d.count] = (int)at;
        d.weight[d.count++] = p->weight[at];
    }
    d.rest = p->steps > 0x1p24 ? d.weight[d.count - 2] : 0;
    d.most = p->steps / fmax(d.rest, 1);
    for (int i = 0; i < d.count; i++)
        d.weight[i] /= fmax(d.rest, 1);
    return d;
}

static const char letters[] = "rgba", digit_names[] = "RGBA", rests[] = "klmo";

/* A quotient, as the product that is exact where it can be. */
static void divided(char *out, const char *what, double by) {
    int exponent;
    if (by == 1)
        append(out, CODE_TEXT_SIZE, "%s", what);
    else if (frexp(by, &exponent) == 0.5)
        append(out, CODE_TEXT_SIZE, "%s*%.17g", what, 1 / by);
    else
        append(out, CODE_TEXT_SIZE, "(%s + 0.5)/%.17g", what, by);
}

static void weighted(char *out, double weight) {
    if (weight > 1)
        append(out, CODE_TEXT_SIZE, "*%.17g", weight);
}

static void pack_text(const packing *p, const digits *d, char *out) {
    char member[IMAGE_CHANNELS_MAX];
    append(out, CODE_TEXT_SIZE, d->rest > 0 ? "k = min(max(d, 0), 1)*%.17g" : "k = even(min(max(d, 0), 1)*%.17g)",
           d->most);
    for (int i = 0; i + 1 < d->count; i++) {
        const char name = digit_names[d->channel[i]], rest[] = {rests[i], '\0'};
        append(out, CODE_TEXT_SIZE, d->rest > 0 ? "; %c = min(floor(" : "; %c = floor(", name);
        divided(out, rest, d->weight[i]);
        append(out, CODE_TEXT_SIZE, d->rest > 0 ? "), 255); %c = %s - %c" : "); %c = %s - %c", rests[i + 1], rest,
               name);
        weighted(out, d->weight[i]);
        member[d->channel[i]] = name;
    }
    const int last = d->channel[d->count - 1];
    const char rest = rests[d->count - 1];
    member[last] = d->rest > 0 ? digit_names[last] : rest;
    if (d->rest > 0)
        append(out, CODE_TEXT_SIZE, d->rest > BYTE ? "; %c = min(even(%c*%.17g), 255)" : "; %c = even(%c*%.17g)",
               member[last], rest, d->rest);
    for (uint32_t k = 0; k < p->channels; k++)
        if (p->weight[k] > 0)
            append(out, CODE_TEXT_SIZE, "; %c = %c/255", letters[k], member[k]);
}

static void unpack_text(const packing *p, const digits *d, char *out) {
    const int whole = d->count - (d->rest > 0);
    double most = 0;
    for (int i = 0; i < d->count; i++)
        append(out, CODE_TEXT_SIZE, "%c = even(%c*255); ", digit_names[d->channel[i]], letters[d->channel[i]]);
    for (int i = 0; i < whole; i++) {
        append(out, CODE_TEXT_SIZE, i > 0 ? " + %c" : "k = %c", digit_names[d->channel[i]]);
        weighted(out, d->weight[i]);
        most += d->weight[i] * BYTE;
    }
    if (d->rest > 0)
        append(out, CODE_TEXT_SIZE, "; l = %c%c%.17g; d = (k + l)*%.17g", digit_names[d->channel[whole]],
               d->rest > BYTE ? '*' : '/', d->rest > BYTE ? 1 / d->rest : d->rest, 1 / d->most);
    else
        append(out, CODE_TEXT_SIZE, most > p->steps ? "; d = min(k/%.17g, 1)" : "; d = k/%.17g", p->steps);
}

double code_pack_bound(const packing *p, const bound_arithmetic *how) {
    const digits d = digits_of(p);
    const int top = ilogb(p->steps);
    return d.rest > 0 ? fmax(0.5 + how->rounding * 0x1p-17, d.rest - BYTE)
                      : 0.5 + how->rounding * (top == 23 ? 0.25 : ldexp(1, top - 24));
}

double code_unpack_bound(const packing *p, const bound_arithmetic *how) {
    const digits d = digits_of(p);
    const double part = d.rest > BYTE ? 0 : how->division;
    return (d.rest > 0 ? fmax(part, part / 2 + how->rounding) : how->division) * DP_UNIT * (1 + DP_ROUNDINGS32_14);
}

/* Two functions, there and back, of those inputs. */
static void write_both(output *out, const code_language *l, const char *const names[2], const char *const inputs[2],
                       const char *const text[2]) {
    char type[CODE_TEXT_SIZE], count[2] = "", own[CODE_INPUTS][2] = {"", "", "", ""};
    if (l->advice != NULL)
        code_say(out, l, "%s", l->advice);
    for (int i = 0; i < 2; i++) {
        const int results = (int)strlen(inputs[1 - i]);
        code_body f = {.l = l, .name = names[i], .type = results > 1 ? CODE_VECTOR : CODE_REAL};
        count[0] = (char)('0' + results);
        f.results = results > 1 ? results : 0;
        for (int k = 0; inputs[i][k] != '\0'; k++) {
            own[k][0] = inputs[i][k];
            f.inputs[k] = own[k];
        }
        if (i > 0)
            code_part(out, l);
        if (l->define != NULL && results > 1 && (i == 0 || strlen(inputs[0]) != strlen(inputs[1])))
            code_put(out, l->define, count, "", code_type_name(l, CODE_VECTOR, results, type));
        steps_read(text[i], &f.steps);
        code_infix(out, &f);
    }
}

code_said code_packing(output *out, const code_language *l, const packing *p) {
    const digits d = digits_of(p);
    const double off = code_pack_bound(p, &l->how), more = code_unpack_bound(p, &l->how);
    char there[CODE_TEXT_SIZE] = "", back[CODE_TEXT_SIZE] = "", used[IMAGE_CHANNELS_MAX + 1] = "";
    for (uint32_t k = 0; k < p->channels; k++)
        if (p->weight[k] > 0)
            append(used, sizeof used, "%c", letters[k]);
    pack_text(p, &d, there);
    unpack_text(p, &d, back);
    code_import(out, l);
    code_say(out, l, "%s in the channels %s of 8 bits: %s", p->linear ? "Eye depth over far" : "Window depth", used,
             p->name);
    code_say(out, l, "%s: %s%s", p->name, p->note, p->wraps ? "; here 1 stays 1" : "");
    code_say_rules(out, l, false);
    code_say(out, l,
             "So a texel is off by at most %s of its steps of %s for any d, outside 0 to 1 as at its nearer end, where "
             "channels are stored to nearest, and unpack_depth by at most %s of what the texel says, where they are "
             "read within 1 ulp.",
             number_up(off, 6).text, number_of(1 / p->steps, 6).text, number_up(more, 3).text);
    write_both(out, l, (const char *const[]){"pack_depth", "unpack_depth"}, (const char *const[]){"d", used},
               (const char *const[]){there, back});
    return (code_said){.count = 2,
                       .claims = {{"pack_depth", off, code_pack_bound(p, &bound_nearest), "steps"},
                                  {"unpack_depth", more, code_unpack_bound(p, &bound_nearest), "depth"}}};
}

/* ---- Normals ----------------------------------------------------------------------------------------------------- */

#define PLACE "s = abs(x) + abs(y) + abs(z); a = x/s; c = y/s; t = max(-z/s, 0); "
#define FOLD(i, j)                                                                                                     \
    "c = 1 - abs(" i ") - abs(" j "); t = max(-c, 0); u = " i " - signed(t, " i "); v = " j " - signed(t, " j "); "
#define UNIT(a, b, c) "w = sqrt(" a "*" a " + " b "*" b " + " c "*" c "); x = " a "/w; y = " b "/w; z = " c "/w"

/* clang-format off */
static const struct {
    const char *channels, *there, *back;
} normals[PACK_LAYOUTS] = {
    [PACK_STEREO] = {"rg", "w = z + 1; r = x/w*0.28126230522585363 + 0.5; g = y/w*0.28126230522585363 + 0.5",
        "u = r*3.5554 - 1.7777; v = g*3.5554 - 1.7777; w = 2/(u*u + v*v + 1); x = w*u; y = w*v; z = w - 1"},
    [PACK_OCT] = {"rg", PLACE "r = a + signed(t, a); g = c + signed(t, c)", FOLD("r", "g") UNIT("u", "v", "c")},
    [PACK_OCT_888] = {"rgb",
        PLACE "u = a + signed(t, a); v = c + signed(t, c); i = floor(max(u*0.5 + 0.5, 0)*4095.5); "
        "j = floor(max(v*0.5 + 0.5, 0)*4095.5); p = floor(i*0.00390625); q = floor(j*0.00390625); "
        "r = (i - p*256)/255; g = (j - q*256)/255; b = (p + q*16)/255",
        "h = even(b*255); q = floor(h*0.0625); p = h - q*16; k = even(r*255) + p*256; i = k/4095*2 - 1; "
        "l = even(g*255) + q*256; j = l/4095*2 - 1; " FOLD("i", "j") UNIT("u", "v", "c")},
    [PACK_XYZ] = {"rgb", "r = x; g = y; b = z", UNIT("r", "g", "b")},
};
/* clang-format on */

/* Units of 2^-24 by which roundings turn what comes back, in radians: r and q of depthprec-code(1). */
static double turned(pack_layout layout, const bound_arithmetic *how) {
    const double r = how->rounding, q = how->division;
    return layout == PACK_OCT       ? 4.25 * (3 * r + q) + 8.13 * (2 + r) + q
           : layout == PACK_OCT_888 ? 4.25 * (7 * r + q) + 16.25 * (q + r) + q
           : layout == PACK_XYZ     ? 6 + q
                                    : 2.83 * (1.01 * (2 * r + q + 1) + 6.63 * r + 14.21) + 7 * r + 2 * q;
}

/* Vectors of binary32 have no length of exactly 1: of xyz all places of the cube of a code. */
double code_normal_bound(const pack_row *row, const bound_arithmetic *how) {
    const double half = sqrt(3) / 2 / (double)((1 << (row->bits - 1)) - 1), degree = DP_DEGREE;
    const double exact = row->layout == PACK_XYZ ? dp_atan2(half, sqrt(1 - half * half)) : row->normal.max * degree;
    return (exact * (1 + DP_ROUNDINGS32_14) + turned(row->layout, how) * DP_UNIT * (1 + 0x1p-10)) / degree;
}

code_said code_normal(output *out, const code_language *l, const pack_row *row) {
    const double bound = code_normal_bound(row, &l->how);
    const bool either = row->layout == PACK_OCT || row->layout == PACK_XYZ;
    code_import(out, l);
    code_say(out, l, "Normal in %s channels of %d bits: %s", either ? "SNORM" : "UNORM", row->bits, row->name);
    code_say(out, l, "%s: %s", row->name, row->note);
    code_say_rules(out, l, false);
    code_say(out, l,
             "So a vector of length 1%s comes back within %s degrees, where channels are stored to nearest and read "
             "within 1 ulp.",
             row->sphere ? "" : " with z from 0 to 1", number_up(bound, 4).text);
    write_both(out, l, (const char *const[]){"pack_normal", "unpack_normal"},
               (const char *const[]){"xyz", normals[row->layout].channels},
               (const char *const[]){normals[row->layout].there, normals[row->layout].back});
    return (code_said){.count = 1,
                       .claims = {{"unpack_normal", bound, code_normal_bound(row, &bound_nearest), "degrees"}}};
}
