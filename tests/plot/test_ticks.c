/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Ticks of an axis: at even steps of 1, 2 or 5 times a power of ten, or at powers of ten; inside the axis, named as
 * what they stand at, as many as there is room for, and two of them wherever steps allow it.
 */
#include "draw/ticks.h"
#include "support.h"

/* What a label says; a power of ten is written with superscripts. */
static double said(const char *text) {
    static const char *const raised[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    const char *ten = strstr(text, "10"), *at = ten != NULL ? ten + 2 : "";
    const char *dot = strstr(text, "\u00b7");
    if (ten == NULL || (unsigned char)*at < 0x80 || (ten != text && dot == NULL))
        return strtod(text, NULL);
    const bool below = strncmp(at, "⁻", strlen("⁻")) == 0;
    int power = 0;
    for (at += below ? strlen("⁻") : 0; *at != '\0';) {
        int digit = 0;
        while (digit < 10 && strncmp(at, raised[digit], strlen(raised[digit])) != 0)
            digit++;
        assert_true(digit < 10);
        power = 10 * power + digit;
        at += strlen(raised[digit]);
    }
    return (dot != NULL ? strtod(text, NULL) : 1.0) * pow(10.0, below ? -power : power);
}

/* Labels in their order; each stands at what it says, to the three digits that it has at least. */
static size_t labels_of(const ticks *t, const chart_axis *axis, double at[TICKS_MAX]) {
    const double span = axis->hi - axis->lo;
    size_t count = 0;
    for (size_t i = 0; i < t->count; i++) {
        const tick *one = &t->items[i];
        assert_true(one->at >= axis->lo - 1e-6 * span && one->at <= axis->hi + 1e-6 * span);
        assert_true(i == 0 || one->at > t->items[i - 1].at);
        if (one->text[0] == '\0')
            continue;
        if (!(fabs(said(one->text) - one->at) <= 5.1e-3 * fabs(one->at) + 1e-9 * span))
            fail_msg("'%s' at %.17g, from %.17g to %.17g", one->text, one->at, axis->lo, axis->hi);
        assert_true(count == 0 || said(one->text) > said(t->items[i - 1].text) || t->items[i - 1].text[0] == '\0');
        at[count++] = one->at;
    }
    return count;
}

/* Whether some step of 1, 2 or 5 times a power of ten has at least two ticks there, and at most so many. */
static bool has_step(const chart_axis *axis, double most) {
    const int power = (int)floor(log10(axis->hi - axis->lo));
    for (int e = power - 3; e <= power + 2; e++)
        for (int k = 0; k < 3; k++) {
            const double step = (double[]){1, 2, 5}[k] * pow(10, e);
            const double count = floor(axis->hi / step) - ceil(axis->lo / step) + 1;
            if (count >= 2 && count <= most)
                return true;
        }
    return false;
}

/* Makes them, and judges how many have labels; @return that. */
static size_t make(tally t[2], const chart_axis *axis, int room, ticks *got, double at[TICKS_MAX]) {
    ticks_make(axis, room, got);
    const size_t count = labels_of(got, axis, at);
    TALLY(&t[0], count <= (size_t)room + 2, "%zu labels from %.17g to %.17g for %d", count, axis->lo, axis->hi, room);
    TALLY(&t[1], count >= 2 || !has_step(axis, room + 1), "%zu labels from %.17g to %.17g for %d", count, axis->lo,
          axis->hi, room);
    return count;
}

TEST(even_steps) {
    rng r = rng_make("even steps");
    tally t[] = {{.name = "never too many"}, {.name = "two where a step allows it"}, {.name = "steps of 1, 2 or 5"}};
    for (uint64_t n = test_cases(2000, 20000, 1000000); n > 0; n--) {
        const double span = rng_log(&r, 1e-15, 1e18), size = rng_below(&r, 3) ? span : span * rng_log(&r, 1, 1000);
        const double lo = rng_below(&r, 4) == 0 ? 0 : size * rng_uniform(&r, -1, 1);
        const chart_axis axis = {.lo = lo, .hi = lo + span};
        const int room = 2 + (int)rng_below(&r, 12);
        double at[TICKS_MAX];
        ticks got;
        const size_t count = make(t, &axis, room, &got, at);
        if (count < 2)
            continue;
        const double step = at[1] - at[0], digit = step / pow(10, floor(log10(step * (1 + 1e-6))));
        TALLY(&t[2], fabs(digit - 1) < 1e-3 || fabs(digit - 2) < 1e-3 || fabs(digit - 5) < 1e-3, "a step of %.17g",
              step);
        for (size_t i = 1; i < count; i++)
            TALLY(&t[2], fabs(at[i] - at[i - 1] - step) <= 1e-6 * step, "%.17g, then %.17g", step, at[i] - at[i - 1]);
    }
    for (size_t i = 0; i < sizeof t / sizeof t[0]; i++)
        tally_end(&t[i]);
}

TEST(decades) {
    rng r = rng_make("decades");
    tally t[] = {{.name = "never too many"}, {.name = "two of them"}, {.name = "plain up to 10000"}};
    for (uint64_t n = test_cases(2000, 20000, 1000000); n > 0; n--) {
        const double lo = n % 2 ? pow(10, -(double)rng_below(&r, 5)) : rng_log(&r, 1e-18, 1e12);
        const double hi = n % 4 == 1 ? pow(10, 1 + (double)rng_below(&r, 5)) : lo * rng_log(&r, 1.5, 1e15);
        const chart_axis axis = {.scale = CHART_LOG, .lo = lo, .hi = hi};
        const int room = 2 + (int)rng_below(&r, 12);
        double at[TICKS_MAX];
        ticks got;
        make(t, &axis, room, &got, at);
        /* From 0.001 to 10000 as numbers, beyond them all powers as such: 10 with what is raised. */
        const bool powers = ceil(log10(lo) - 1e-6) < -3 || floor(log10(hi) + 1e-6) > 4;
        for (size_t i = 0; i < got.count && floor(log10(hi) + 1e-6) > ceil(log10(lo) - 1e-6); i++)
            if (got.items[i].text[0] != '\0' && fabs(log10(got.items[i].at) - rint(log10(got.items[i].at))) < 1e-6)
                TALLY(&t[2], (strspn(got.items[i].text, "0123456789.") < strlen(got.items[i].text)) == powers,
                      "%s from %.17g to %.17g", got.items[i].text, lo, hi);
    }
    for (size_t i = 0; i < sizeof t / sizeof t[0]; i++)
        tally_end(&t[i]);
}
