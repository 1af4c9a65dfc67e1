/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "camera/matrix.h"

#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/append.h"
#include "core/elementary.h"
#include "system/input.h"

enum { FILE_MOST = 1 << 16, DIGITS_ROUNDED = 6, WORD_MOST = 64, WORD_SHOWN = 24 };

static const double SQUARE = 1e-5; /* how far pixels may be from squares */

/* ---- Its numbers ------------------------------------------------------------------------------------------------- */

/* Entries with their significant digits, and the worth of the last; 0: exact. */
typedef struct entries {
    size_t count;
    double m[MATRIX_ENTRIES], last[MATRIX_ENTRIES];
    int digits[MATRIX_ENTRIES];
} entries;

static bool is_between(char c) {
    return c != '\0' && strchr(", ;()[]{}\t\n\v\f\r", c) != NULL;
}

static void count_digits(const char *text, entries *e, size_t i) {
    const char *at = text;
    int digits = 0, decimals = 0;
    bool point = false;
    for (; *at != '\0' && *at != 'e' && *at != 'E'; at++) {
        const bool digit = *at >= '0' && *at <= '9';
        if (!digit && strchr("+-.", *at) == NULL)
            return; /* hexadecimal: exact */
        point = point || *at == '.';
        decimals += digit && point;
        digits += digit && (digits > 0 || *at != '0');
    }
    e->digits[i] = digits;
    char worth[32];
    snprintf(worth, sizeof worth, "1e%ld", (*at != '\0' ? strtol(at + 1, NULL, 10) : 0) - decimals);
    e->last[i] = strtod(worth, NULL);
}

/* Takes a word for a number, with or without C's f behind it. */
static bool take_word(char word[WORD_MOST], entries *e) {
    const size_t length = strlen(word);
    char *end;
    if (length > 1 && (word[length - 1] == 'f' || word[length - 1] == 'F') && strpbrk(word, "xX") == NULL)
        word[length - 1] = '\0';
    const double value = strtod(word, &end);
    if (end == word || *end != '\0' || !isfinite(value) ||
        (value == 0 && strcspn(word, "123456789eE") < strcspn(word, "eExX")))
        return false;
    if (e->count < MATRIX_ENTRIES) {
        e->m[e->count] = value;
        count_digits(word, e, e->count);
    }
    e->count++;
    return true;
}

static int refuse_word(const char *place, const char *word, size_t length, char error[MATRIX_ERROR_SIZE]) {
    char shown[WORD_SHOWN + 1];
    const size_t most = length < WORD_SHOWN ? length : WORD_SHOWN;
    for (size_t i = 0; i < most; i++)
        shown[i] = (char)(word[i] > ' ' && word[i] < 0x7f ? word[i] : '?');
    shown[most] = '\0';
    snprintf(error, MATRIX_ERROR_SIZE, "%smust be a finite number, got '%s%s'", place, shown,
             length > most ? "..." : "");
    return -1;
}

/* Numbers and what may stand between them; of a file, the line of a word that is none. */
static int parse(const char *text, size_t size, bool lines, entries *e, char error[MATRIX_ERROR_SIZE]) {
    size_t line = 1;
    for (size_t at = 0, length; at < size; at += length) {
        char place[32] = "", word[WORD_MOST] = "";
        length = 1;
        if (text[at] == '#')
            for (; at + length < size && text[at + length] != '\n'; length++)
                ;
        line += text[at] == '\n';
        if (text[at] == '#' || is_between(text[at]))
            continue;
        while (at + length < size && !is_between(text[at + length]) && text[at + length] != '#')
            length++;
        if (isalpha((unsigned char)text[at]) && at + length < size && strchr("({[", text[at + length]) != NULL)
            continue; /* mat4( */
        snprintf(word, sizeof word, "%.*s", (int)(length < WORD_MOST ? length : 0), text + at);
        if (lines)
            snprintf(place, sizeof place, "line %zu: ", line);
        if (!take_word(word, e))
            return refuse_word(place, text + at, length, error);
    }
    if (e->count == MATRIX_ENTRIES || e->count == MATRIX_TANGENTS)
        return 0;
    snprintf(error, MATRIX_ERROR_SIZE, "must hold 16 numbers, or the 4 tangents of a view's edges, got %zu", e->count);
    return -1;
}

static int read_file(const char *path, entries *e, char error[MATRIX_ERROR_SIZE]) {
    char text[FILE_MOST + 1], inside[MATRIX_ERROR_SIZE] = "";
    errno = 0;
    FILE *in = input_open(path);
    const size_t size = in != NULL ? fread(text, 1, sizeof text, in) : 0;
    const int fault = errno;
    const bool failed = in == NULL || ferror(in) != 0;
    input_close(in);
    if (failed)
        return fault;
    text[size < FILE_MOST ? size : FILE_MOST] = '\0';
    int status = -1;
    if (size > FILE_MOST)
        snprintf(inside, sizeof inside, "must have at most %d bytes: 16 numbers", FILE_MOST);
    else
        status = parse(text, size, true, e, inside);
    snprintf(error, MATRIX_ERROR_SIZE, "%.100s: %.140s", path, inside);
    return status;
}

/* The first number, behind brackets or "mat4(", and something behind it. */
bool camera_matrix_is_typed(const char *said) {
    const size_t word = isalpha((unsigned char)*said) ? strcspn(said, "([{") : 0;
    const size_t from = word + strspn(said + word, "([{ \t\n"), first = from + strcspn(said + from, ", ;\t\n");
    return said[from] != '\0' && strchr("+-.0123456789", said[from]) != NULL && said[first] != '\0';
}

/* ---- What its digits leave open ---------------------------------------------------------------------------------- */

/* Where entries of many digits are all numbers of binary32, to their digits, as programs print them: such they are. */
static bool are_single(const entries *e) {
    bool long_one = false;
    for (size_t i = 0; i < MATRIX_ENTRIES; i++) {
        if (!(fabs((double)(float)e->m[i] - e->m[i]) <= 0.5 * e->last[i] * (1 + 1e-9)))
            return false;
        long_one = long_one || e->digits[i] >= DIGITS_ROUNDED;
    }
    return long_one;
}

/* The worth of an entry's last digit; 0: exact. Few digits were typed, not rounded. Where others have more, a fraction
 * has lost the zeros at its end, as programs print it, and a whole number is one. */
static double worth_of(const entries *e, size_t i) {
    int most = 0;
    for (size_t k = 0; k < MATRIX_ENTRIES; k++)
        most = e->digits[k] > most ? e->digits[k] : most;
    if (most < DIGITS_ROUNDED || (e->digits[i] < DIGITS_ROUNDED && !(e->last[i] < 1)))
        return 0;
    double worth = e->last[i];
    for (int digits = e->digits[i]; digits < most && e->last[i] < 1; digits++)
        worth /= 10;
    return worth;
}

/* The ends between which the number behind an entry lies. */
static void ends_of(const entries *e, size_t i, bool single, double *least, double *most) {
    const double m = e->m[i], half = 0.5 * worth_of(e, i);
    const double own = half > 0 ? fmax(half, 0x1p-53 * fabs(m)) : 0;
    const float f = (float)m;
    *least = m - own;
    *most = m + own;
    if (single && m != 0) {
        *least = fmin(*least, 0.5 * ((double)f + (double)nextafterf(f, -INFINITY)));
        *most = fmax(*most, 0.5 * ((double)f + (double)nextafterf(f, INFINITY)));
    }
}

static int take_tangents(camera_matrix *m, const double t[MATRIX_TANGENTS], char error[MATRIX_ERROR_SIZE]) {
    const double ends[2][2] = {{t[0], t[1]}, {fmin(t[2], t[3]), fmax(t[2], t[3])}};
    for (int k = 0; k < 2; k++) {
        const double wide = ends[k][1] - ends[k][0];
        if (!(wide >= 1e-9 && fmax(fabs(ends[k][0]), fabs(ends[k][1])) <= 1000)) {
            snprintf(error, MATRIX_ERROR_SIZE,
                     "tangents must be left,right,up,down, right above left, none beyond 1000, got %.6g,%.6g,%.6g,%.6g",
                     t[0], t[1], t[2], t[3]);
            return -1;
        }
        m->taken.half[k] = 0.5 * wide;
        m->taken.scale[k] = 1 / m->taken.half[k];
        m->taken.centre[k] = -(ends[k][0] + ends[k][1]) / wide;
    }
    return 0;
}

int camera_matrix_read(camera_matrix *out, const char *said, char error[MATRIX_ERROR_SIZE]) {
    entries e = {.count = 0};
    int status =
        camera_matrix_is_typed(said) ? parse(said, strlen(said), false, &e, error) : read_file(said, &e, error);
    *out = (camera_matrix){.count = 0};
    if (status == 0 && e.count == MATRIX_TANGENTS)
        status = take_tangents(out, e.m, error);
    if (status != 0)
        return status;
    const bool single = are_single(&e);
    out->count = e.count;
    for (size_t i = 0; i < MATRIX_ENTRIES; i++) {
        out->m[i] = e.m[i];
        ends_of(&e, i, single, &out->least[i], &out->most[i]);
    }
    return 0;
}

/* ---- Its convention ---------------------------------------------------------------------------------------------- */

static void turn(double m[MATRIX_ENTRIES]) {
    for (int i = 0; i < 4; i++)
        for (int j = i + 1; j < 4; j++) {
            const double kept = m[4 * i + j];
            m[4 * i + j] = m[4 * j + i];
            m[4 * j + i] = kept;
        }
}

/* Each camera that the matrix is; false where it is none. */
static bool name_all(const camera_matrix *m, const char *must, camera_fault *fault) {
    char all[256] = "";
    for (dp_mapping k = 0; k < DP_MAPPING_COUNT; k++) {
        dp_projection p;
        if (dp_projection_find(&p, m->m, DP_LAYOUT_FOUND, k, NULL) == DP_OK)
            append(all, sizeof all, "%s near %.6g, far %.6g as %s", *all != '\0' ? ";" : "", p.znear, p.zfar,
                   dp_mapping_get(k)->name);
    }
    camera_fails(fault, "mapping", "must %s this @matrix:%s", must, all);
    return *all != '\0';
}

/* Near and far that differ from pixel to pixel, by rows, else by columns. */
static dp_status take_oblique(camera_matrix *m, dp_mapping like, dp_matrix_fault *why) {
    const dp_mapping_row *row = dp_mapping_get(like);
    dp_status status = dp_projection_init(&m->taken, m->m, row->ndc_signed, row->reversed, why);
    if (status == DP_OK || !(fabs(m->m[11]) == 1 && m->m[15] == 0))
        return status;
    turn(m->m);
    turn(m->least);
    turn(m->most);
    return dp_projection_init(&m->taken, m->m, row->ndc_signed, row->reversed, why);
}

bool camera_matrix_take(camera_matrix *m, dp_mapping asked, dp_mapping like, bool oblique, camera_fault *fault) {
    dp_matrix_fault why = {.rule = ""};
    dp_status status = dp_projection_find(&m->taken, m->m, DP_LAYOUT_FOUND, asked, &why);
    const dp_mapping_row *const range = dp_mapping_get(asked != DP_MAPPING_COUNT ? asked : like);
    m->assumed = status == DP_ERROR_CONVENTION;
    for (dp_mapping k = 0; k < DP_MAPPING_COUNT && status == DP_ERROR_CONVENTION && range != NULL; k++)
        if (dp_mapping_get(k)->curve == DP_CURVE_PERSPECTIVE && dp_mapping_get(k)->ndc_signed == range->ndc_signed &&
            dp_projection_find(&m->taken, m->m, DP_LAYOUT_FOUND, k, &why) == DP_OK)
            status = DP_OK;
    if (status == DP_ERROR_CONVENTION)
        return !name_all(m, "be given with", fault);
    if (status != DP_OK && asked != DP_MAPPING_COUNT && !oblique && name_all(m, "fit", fault))
        return false;
    if (status != DP_OK && oblique && range != NULL) {
        m->assumed = asked == DP_MAPPING_COUNT;
        status = take_oblique(m, asked != DP_MAPPING_COUNT ? asked : like, &why);
        if (status == DP_OK && asked != DP_MAPPING_COUNT && m->taken.mapping != asked)
            return camera_fails(fault, "mapping", "must be %s: window depth %s with distance in this @matrix, got %s",
                                dp_mapping_get(m->taken.mapping)->name, m->taken.reversed ? "falls" : "grows",
                                range->name);
    }
    if (status != DP_OK)
        return camera_fails(fault, "matrix", "%s, got %.9g %.9g %.9g %.9g", why.rule, why.got[0], why.got[1],
                            why.got[2], why.got[3]);
    dp_projection_planes(&m->planes, &m->taken, m->m, m->least, m->most);
    return true;
}

const dp_planes *camera_matrix_left_open(const camera_matrix *m) {
    const dp_planes *at = &m->planes;
    return at->near_least < at->near_most || at->far_least < at->far_most ? at : NULL;
}

/* ---- Its view ---------------------------------------------------------------------------------------------------- */

static bool is_plain(const camera_matrix *m, int width, int height) {
    const double *half = m->taken.half, *centre = m->taken.centre;
    return centre[0] == 0 && centre[1] == 0 && fabs(half[0] / half[1] * height / width - 1) <= SQUARE;
}

bool camera_matrix_angle(const camera_matrix *m, int width, int height, double *fov_y, camera_fault *fault) {
    const dp_projection *p = &m->taken;
    if (!p->ortho && !is_plain(m, width, height))
        return camera_fails(
            fault, "matrix",
            "must have a centred view of square pixels here, and in %d x %d its slopes run from %.6g to "
            "%.6g and %.6g to %.6g: a @viewport as wide and high as it is mends the pixels",
            width, height, (-1 - p->centre[0]) * p->half[0], (1 - p->centre[0]) * p->half[0],
            (-1 - p->centre[1]) * p->half[1], (1 - p->centre[1]) * p->half[1]);
    *fov_y = p->ortho ? *fov_y : 2 * dp_atan(p->half[1]) / DP_DEGREE;
    return true;
}

bool camera_matrix_cover(camera_matrix *m, dp_triangles *t, camera_fault *fault) {
    const dp_projection *p = &m->taken;
    if (is_plain(m, t->width, t->height))
        return camera_matrix_angle(m, t->width, t->height, &t->fov_y, fault);
    const double across = 2 * p->half[0] / t->width, up = 2 * p->half[1] / t->height, pixel = fmax(across, up);
    const double width = ceil(2 * p->half[0] * (1 + fabs(p->centre[0])) / pixel);
    const double height = ceil(2 * p->half[1] * (1 + fabs(p->centre[1])) / pixel);
    dp_triangles held = *t;
    held.width = (int)fmin(width, 1e6);
    held.height = (int)fmin(height, 1e6);
    held.fov_y = 2 * dp_atan(0.5 * height * pixel) / DP_DEGREE;
    held.slim = t->slim * pixel / fmin(across, up); /* in pixels of which one side has grown */
    if (dp_triangles_check(&held) != DP_OK)
        return camera_fails(fault, "matrix", "has a view that no centred one of square pixels holds: %s",
                            dp_triangles_fault(&held));
    *t = held;
    m->covered = true;
    return true;
}
