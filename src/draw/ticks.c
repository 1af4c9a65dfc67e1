/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "draw/ticks.h"

#include <math.h>
#include <stdio.h>

#include "core/append.h"
#include "core/elementary.h"

/* Plain decades lie in [10^PLAIN_LO, 10^PLAIN_HI]; of shares they are decimals down to 10^PERCENT_LO. */
enum { PLAIN_LO = -3, PLAIN_HI = 4, PERCENT_LO = -6 };

static void add_tick(ticks *out, const chart_axis *axis, double at, const char *text) {
    double share = chart_axis_share(axis, at);
    if (out->count == TICKS_MAX || !(share >= -1e-9 && share <= 1 + 1e-9))
        return;
    tick *t = &out->items[out->count++];
    t->at = at;
    snprintf(t->text, sizeof t->text, "%s", text);
}

static void superscript(char *out, size_t size, int power) {
    static const char *const digits[] = {"\u2070", "\u00b9", "\u00b2", "\u00b3", "\u2074",
                                         "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
    char plain[16];
    snprintf(plain, sizeof plain, "%d", power < 0 ? -power : power);
    snprintf(out, size, "%s", power < 0 ? "\u207b" : "");
    for (const char *p = plain; *p != '\0'; p++)
        append(out, size, "%s", digits[*p - '0']);
}

void ticks_label(double value, bool powers, char out[TICKS_TEXT]) {
    if (!powers || value == 0 || !isfinite(value)) { /* three digits of 999.7 would be 1e+03 */
        snprintf(out, TICKS_TEXT, fabs(value) >= 999.5 && fabs(value) < 1e6 ? "%.6g" : "%.3g", value);
        return;
    }
    int power = (int)floor(dp_log10(fabs(value)) + 1e-9);
    double factor = value / dp_pow(10, power);
    char raised[16];
    superscript(raised, sizeof raised, power);
    if (fabs(factor - 1) < 1e-6)
        snprintf(out, TICKS_TEXT, "10%s", raised);
    else
        snprintf(out, TICKS_TEXT, "%.3g\u00b710%s", factor, raised);
}

void ticks_about(double value, char out[TICKS_TEXT]) {
    const double unit = value != 0 ? dp_pow(10, floor(dp_log10(fabs(value))) - 2) : 1;
    ticks_label(rint(value / unit) * unit, fabs(value) >= 1e6, out);
}

static void linear(const chart_axis *axis, int room, ticks *out) {
    double span = axis->hi - axis->lo, step = dp_pow(10, floor(dp_log10(span / room)));
    static const double factors[] = {1, 2, 5, 10, 20};
    double more = 0;
    for (size_t i = 0; i < sizeof factors / sizeof *factors; i++) {
        double finer = i > 0 ? factors[i - 1] : 1, next = step * factors[i];
        double count = floor(axis->hi / next) - ceil(axis->lo / next) + 1;
        if (count <= room) {
            step *= count < 2 && more < room + 2 ? finer : factors[i]; /* rather too many than a single one */
            break;
        }
        more = count;
    }
    double first = ceil(axis->lo / step - 1e-9);
    for (int i = 0; i < TICKS_MAX && (first + i) * step <= axis->hi + 1e-9 * span; i++) {
        double at = (first + i) * step;
        double largest = fmax(fabs(axis->lo), fabs(axis->hi));
        int digits = (int)fmin(17, fmax(3, floor(dp_log10(largest / step)) + 2));
        char text[TICKS_TEXT];
        if (fabs(at) < step * 1e-6)
            at = 0;
        /* Plain numbers from 1000 to 999999 too: 20000 reads better than 2e+04. */
        snprintf(text, sizeof text, "%.*g", largest >= 1e3 && largest < 1e6 && step >= 1 ? 6 : digits, at);
        add_tick(out, axis, at, text);
    }
}

static void decades(const chart_axis *axis, int room, ticks *out) {
    int first = (int)ceil(dp_log10(axis->lo) - 1e-9), last = (int)floor(dp_log10(axis->hi) + 1e-9);
    const bool percent = axis->unit != NULL && axis->unit[0] == '%'; /* 100 %, not 10^2 % */
    const bool powers = first < (percent ? PERCENT_LO : PLAIN_LO) || last > PLAIN_HI;
    int stride = 1;
    while ((last - first) / stride + 1 > room)
        stride++;
    /* By the power itself, so that 1 is labelled and two axes agree; from the first where that leaves fewer than two.
     */
    int origin = floor((double)last / stride) - ceil((double)first / stride) < 1 ? first : 0;
    for (int power = first - 1; power <= last; power++) {
        const double decade = dp_pow(10, power);
        char text[TICKS_TEXT] = "";
        if ((power - origin) % stride == 0 && power < PLAIN_LO && !powers)
            snprintf(text, sizeof text, "%.*f", -power, decade);
        else if ((power - origin) % stride == 0)
            ticks_label(decade, powers, text);
        add_tick(out, axis, decade, text);
        for (int factor = 2; stride == 1 && factor < 10; factor++) {
            text[0] = '\0';
            if ((factor == 2 || factor == 5) && last - first < 2 && 3 * (last - first + 1) <= room)
                ticks_label(factor * decade, powers, text);
            add_tick(out, axis, factor * decade, text);
        }
    }
}

static size_t labelled(const ticks *t) {
    size_t count = 0;
    for (size_t i = 0; i < t->count; i++)
        count += t->items[i].text[0] != '\0';
    return count;
}

void ticks_make(const chart_axis *axis, int room, ticks *out) {
    out->count = 0;
    if (axis->names != NULL) {
        for (int i = 0; i < axis->hi; i++)
            add_tick(out, axis, i + 0.5, axis->names[i]);
        return;
    }
    if (room < 2)
        room = 2;
    if (axis->scale == CHART_LOG) {
        decades(axis, room, out);
        if (labelled(out) >= 2)
            return;
        out->count = 0;
    }
    linear(axis, room, out);
}
