/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/table_text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/setups.h"
#include "report/number.h"

/* Beyond fifteen digits a decimal shows its own rounding (0.10000000000000001). */
enum { DIGITS_FEW = 6, DIGITS_USUAL = 9, DIGITS_DEPTH = 7, DIGITS_DEPTH_MOST = 10, DIGITS_MOST = 15 };

/* The columns, left to right; the last two are shown with --verbose only. */
enum {
    COLUMN_Z,
    COLUMN_CODE,
    COLUMN_DEPTH,
    COLUMN_STORED,
    COLUMN_ERROR,
    COLUMN_INTERVAL,
    COLUMN_SEPARATION,
    COLUMN_BINARY32,
    COLUMN_LO,
    COLUMN_HI,
    COLUMN_COUNT
};

static const struct {
    const char *title;
    int width;
} columns[COLUMN_COUNT] = {
    [COLUMN_Z] = {"z", 12},
    [COLUMN_CODE] = {"code", 11},
    [COLUMN_DEPTH] = {"depth", 13},
    [COLUMN_STORED] = {"stored", 15},
    [COLUMN_ERROR] = {"error", 13},
    [COLUMN_INTERVAL] = {"interval", 12},
    [COLUMN_SEPARATION] = {"separation", 12},
    [COLUMN_BINARY32] = {"in binary32", 12},
    [COLUMN_LO] = {"cell from", 19},
    [COLUMN_HI] = {"to", 19},
};

static int column_count(const table_style *style) {
    return style->cells ? COLUMN_COUNT : COLUMN_LO;
}

/* Right-aligned; something wider than its column pushes the rest, but is never cut or glued to its neighbour. */
static void put(output *out, int column, const char *text, size_t length) {
    int width = columns[column].width;
    do
        output_char(out, ' ');
    while (--width > (int)length);
    output_bytes(out, text, length);
}

/* What a model does not have is not a number: a dash. */
static void put_number(output *out, int column, double value, int digits) {
    char text[NUMBER_SIZE] = "-";
    put(out, column, text, isnan(value) ? 1 : number_digits(value, digits, text));
}

/* A guarantee holds as it is printed: rounded up. */
static void put_guarantee(output *out, int column, double value, int digits) {
    char text[NUMBER_SIZE] = "-";
    put(out, column, text, isnan(value) ? 1 : number_bound(value, digits, true, text));
}

/* The digits that it takes to see that a value near `at` is off by `step`, with two digits of the step. */
static int digits_within(double at, double step, int least, int most) {
    if (!isfinite(at) || !isfinite(step) || at == 0.0 || step == 0.0)
        return least;
    double digits = floor(log10(fabs(at))) - floor(log10(fabs(step))) + 2.0;
    return (int)fmin(fmax(digits, least), most);
}

static int digits_to_see(double at, double step) {
    return digits_within(at, step, DIGITS_USUAL, DIGITS_MOST);
}

table_style table_style_of(const options *o, const output *out) {
    const char *term = getenv("TERM");
    bool colour = o->form == FORM_TEXT && getenv("NO_COLOR") == NULL && term != NULL && strcmp(term, "dumb") != 0 &&
                  isatty(out->fd);
    return (table_style){.strong = colour ? "\033[1m" : "",
                         .soft = colour ? "\033[2m" : "",
                         .plain = colour ? "\033[0m" : "",
                         .cells = o->verbose};
}

void table_text_head(output *out, const table_style *style, const dp_setup *setup) {
    char label[SETUP_LABEL_SIZE];
    output_format(out, "%s%s%s\n%s", style->strong, setup_label(setup, true, label), style->plain, style->soft);
    for (int i = 0; i < column_count(style); i++)
        put(out, i, columns[i].title, strlen(columns[i].title));
    output_format(out, "%s\n", style->plain);
}

void table_text_row(output *out, const table_style *style, const dp_sample *s, double binary32) {
    char code[NUMBER_SIZE];
    put_number(out, COLUMN_Z, s->z, DIGITS_USUAL);
    put(out, COLUMN_CODE, code, number_shortest((double)s->code, code));
    /* A depth just short of 1 should not look like the far plane's. */
    put_number(out, COLUMN_DEPTH, s->depth, digits_within(s->depth, 1.0 - s->depth, DIGITS_DEPTH, DIGITS_DEPTH_MOST));
    put_number(out, COLUMN_STORED, s->stored, digits_to_see(s->z, s->error));
    put_number(out, COLUMN_ERROR, s->error, DIGITS_FEW);
    put_number(out, COLUMN_INTERVAL, s->interval, DIGITS_FEW);
    put_guarantee(out, COLUMN_SEPARATION, s->separation, DIGITS_FEW);
    put_guarantee(out, COLUMN_BINARY32, binary32, DIGITS_FEW);
    if (style->cells) {
        put_number(out, COLUMN_LO, s->lo, digits_to_see(s->lo, s->interval));
        put_number(out, COLUMN_HI, s->hi, digits_to_see(s->lo, s->interval));
    }
    output_char(out, '\n');
}

void table_text_worst(output *out, const table_style *style, const dp_worst *w) {
    char value[NUMBER_SIZE];
    char lo[NUMBER_SIZE];
    char hi[NUMBER_SIZE];
    if (isnan(w->error))
        return;
    number_digits(w->error, DIGITS_FEW, value);
    number_digits(w->error_z, DIGITS_USUAL, lo);
    output_format(out, "  %sworst error%s     ", style->strong, style->plain);
    if (isinf(w->error))
        output_format(out, "unbounded, code %u\n", w->error_code);
    else
        output_format(out, "%s at z = %s, code %u\n", value, lo, w->error_code);
    int digits = digits_to_see(w->interval_lo, w->interval);
    number_digits(w->interval, DIGITS_FEW, value);
    number_digits(w->interval_lo, digits, lo);
    number_digits(w->interval_hi, digits, hi);
    output_format(out, "  %sworst interval%s  ", style->strong, style->plain);
    if (isinf(w->interval))
        output_format(out, "unbounded, from %s on, code %u\n", lo, w->interval_code);
    else
        output_format(out, "%s from %s to %s, code %u\n", value, lo, hi, w->interval_code);
    if (isnan(w->blind_from))
        return;
    number_digits(w->blind_from, DIGITS_USUAL, value);
    output_format(out, "  %sblind%s           from z = %s: behind it nothing is told apart\n", style->strong,
                  style->plain, value);
}

void table_text_separation(output *out, const table_style *style, dp_model model, const dp_separation_worst *w) {
    char value[NUMBER_SIZE];
    char z[NUMBER_SIZE];
    number_bound(w->bound, DIGITS_FEW, true, value);
    number_digits(w->z, DIGITS_USUAL, z);
    output_format(out, "  %sworst separation%s %s at z = %s, %s\n", style->strong, style->plain, value, z,
                  model == DP_MODEL_FP32 ? "guaranteed in binary32 (model fp32)" : "in the model staged");
}

void table_text_clipping(output *out, const table_style *style, const clipping *c) {
    char znear[NUMBER_SIZE];
    char zfar[NUMBER_SIZE];
    if (isnan(c->znear) && !c->loses)
        return;
    number_digits(c->znear, DIGITS_USUAL, znear);
    number_digits(c->zfar, DIGITS_USUAL, zfar);
    output_format(out, "  %sdrawn%s           ", style->strong, style->plain);
    if (isnan(c->znear))
        output_text(out, "nothing: clipping loses all depths\n");
    else
        output_format(out, "from %s to %s%s\n", znear, zfar, c->loses ? ": clipping loses the rest" : "");
}

void table_text_way(output *out, const char *name, double claim, double tolerance) {
    char claimed[NUMBER_SIZE], allowed[NUMBER_SIZE];
    number_digits(claim, 3, claimed);
    number_digits(tolerance, 3, allowed);
    if (name == NULL)
        output_format(out, "  interval: no method claims to be within %s of it in this set-up\n", allowed);
    else if (claim == 0)
        output_format(out, "  interval by %s, exact\n", name);
    else
        output_format(out, "  interval by %s, the cheapest within %s of it: claims %s\n", name, allowed, claimed);
}
