/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The projection matrix of --matrix: its file, and what it says in place of other options. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/errors.h"
#include "core/elementary.h"
#include "report/number.h"
#include "system/input.h"
#include "texture/cmd_texture/request.h"
#include "texture/cmd_texture/texture.h"

enum { ENTRIES = 16, FILE_MOST = 1 << 16, DIGITS_ROUNDED = 6 };

static const double DEGREE = M_PI / 180;

/* ---- The file ---------------------------------------------------------------------------------------------------- */

static bool is_between(char c) {
    return c == ',' || c == ' ' || (c >= '\t' && c <= '\r');
}

/* A matrix as it is given: its entries, their significant digits, and the worth of the last; 0: exact. */
typedef struct entries {
    double m[ENTRIES], last[ENTRIES];
    int digits[ENTRIES];
} entries;

static void count_digits(const char *text, size_t length, entries *e, size_t i) {
    int digits = 0, decimals = 0;
    size_t at = 0;
    bool point = false;
    for (; at < length && text[at] != 'e' && text[at] != 'E'; at++) {
        const bool digit = text[at] >= '0' && text[at] <= '9';
        if (!digit && strchr("+-.", text[at]) == NULL)
            return; /* hexadecimal: exact */
        point = point || text[at] == '.';
        decimals += digit && point;
        digits += digit && (digits > 0 || text[at] != '0');
    }
    e->digits[i] = digits;
    char worth[32];
    snprintf(worth, sizeof worth, "1e%ld", (at < length ? strtol(text + at + 1, NULL, 10) : 0) - decimals);
    e->last[i] = strtod(worth, NULL);
}

/* Sixteen numbers between white space and commas; # begins a comment. */
static int parse_entries(const char *path, const char *text, size_t size, entries *e) {
    size_t count = 0, line = 1;
    for (size_t at = 0; at < size;) {
        size_t length = 0;
        char shown[ERROR_WORD_SIZE];
        double extra;
        if (text[at] == '#')
            while (at < size && text[at] != '\n')
                at++;
        if (at == size || is_between(text[at])) {
            line += at < size && text[at] == '\n';
            at++;
            continue;
        }
        while (at + length < size && !is_between(text[at + length]) && text[at + length] != '#')
            length++;
        if (!number_parse_part(text + at, length, NUMBER_FINITE, count < ENTRIES ? &e->m[count] : &extra))
            return option_error("matrix", "%s: line %zu: must be a finite number, got '%s'", path, line,
                                error_word(text + at, length, shown));
        if (count < ENTRIES)
            count_digits(text + at, length, e, count);
        count++;
        at += length;
    }
    return count == ENTRIES ? EXIT_FINE
                            : option_error("matrix", "%s: must hold 16 numbers, row by row, got %zu", path, count);
}

static int read_entries(const char *path, entries *e) {
    char text[FILE_MOST + 1];
    FILE *in = input_open(path);
    const size_t size = in != NULL ? fread(text, 1, sizeof text, in) : 0;
    const int error = errno;
    const bool failed = in == NULL || ferror(in) != 0;
    input_close(in);
    if (failed) {
        option_error("matrix", "%s: %s", path, strerror(error));
        return EXIT_IO;
    }
    if (size > FILE_MOST)
        return option_error("matrix", "%s: must have at most %d bytes: 16 numbers, row by row", path, FILE_MOST);
    text[size] = '\0';
    return parse_entries(path, text, size, e);
}

/* ---- What its digits say of the planes --------------------------------------------------------------------------- */

/* Where entries of many digits are all numbers of binary32, to their digits, as programs print them: such they are. */
static bool are_single(const entries *e) {
    bool long_one = false;
    for (size_t i = 0; i < ENTRIES; i++) {
        if (!(fabs((double)(float)e->m[i] - e->m[i]) <= 0.5 * e->last[i] * (1 + 1e-9)))
            return false;
        long_one = long_one || e->digits[i] >= DIGITS_ROUNDED;
    }
    return long_one;
}

/* The ends between which the number behind an entry lies. Few digits were not rounded, but typed. */
static void ends_of(const entries *e, size_t i, bool single, double *least, double *most) {
    const double m = e->m[i], half = e->digits[i] >= DIGITS_ROUNDED ? 0.5 * e->last[i] : 0;
    const double own = half > 0 ? fmax(half, 0x1p-53 * fabs(m)) : 0;
    const float f = (float)m;
    *least = m - own;
    *most = m + own;
    if (single && m != 0) {
        *least = fmin(*least, 0.5 * ((double)f + (double)nextafterf(f, -INFINITY)));
        *most = fmax(*most, 0.5 * ((double)f + (double)nextafterf(f, INFINITY)));
    }
}

static void find_planes(const entries *e, texture_matrix *t) {
    const bool single = are_single(e);
    double least[ENTRIES], most[ENTRIES];
    for (size_t i = 0; i < ENTRIES; i++)
        ends_of(e, i, single, &least[i], &most[i]);
    dp_projection_planes(&t->planes, &t->taken, e->m, least, most);
}

static double number_at(double value, int digits) {
    return strtod(number_of(value, digits).text, NULL);
}

dp_setup texture_matrix_shown(const texture_matrix *t, const dp_setup *setup) {
    dp_setup shown = *setup;
    if (t->path != NULL) {
        shown.spec.znear = number_at(setup->spec.znear, t->planes.near_digits);
        shown.spec.zfar = number_at(setup->spec.zfar, t->planes.far_digits);
    }
    return shown;
}

void texture_matrix_say_planes(const texture_matrix *t, page *p) {
    const dp_planes *at = &t->planes;
    if (t->path != NULL && (at->near_least < at->near_most || at->far_least < at->far_most))
        page_note(p, "planes",
                  "near may be %s to %s, far %s to %s, by the digits of the entries; all below is of the "
                  "entries as they are",
                  number_down(at->near_least, 9).text, number_up(at->near_most, 9).text,
                  number_down(at->far_least, 6).text, number_up(at->far_most, 6).text);
}

/* ---- What it says ------------------------------------------------------------------------------------------------ */

static int check_mapping(const texture_request *o, dp_mapping given) {
    const dp_mapping_row *row = dp_mapping_get(given);
    if (option_given(o->line, "mapping") && (o->camera.mapping_count > 1 || row->curve != DP_CURVE_PERSPECTIVE))
        return option_error("mapping", "must be one of " DP_MAPPING_NAMES_PERSPECTIVE " with --matrix, got %s",
                            o->camera.mapping_count > 1 ? "several" : row->name);
    return EXIT_FINE;
}

static void name_edges(texture_matrix *t) {
    const dp_projection *p = &t->taken;
    t->oblique = p->oblique != 0;
    t->looks = p->backwards ? "-z" : "+z";
    for (int i = 0; i < 4; i++)
        t->edges[i] = ((i % 2 != 0 ? 1 : -1) - p->centre[i / 2]) * p->half[i / 2];
    for (int k = 0; k < 2; k++)
        t->fov[k] = p->ortho ? (double)NAN : (dp_atan(t->edges[2 * k + 1]) - dp_atan(t->edges[2 * k])) / DEGREE;
}

void texture_intrinsics_take(const double intrinsics[4], const double size[2], texture_matrix *t) {
    dp_projection *p = &t->taken;
    for (int k = 0; k < 2; k++) {
        p->half[k] = size[k] / (2 * intrinsics[k]);
        p->scale[k] = 1 / p->half[k];
        p->centre[k] = (k == 0 ? 1 : -1) * (2 * intrinsics[2 + k] - size[k]) / size[k];
    }
    name_edges(t);
}

int texture_matrix_open(const texture_request *o, texture_source *s, texture_request *with) {
    const bool given = option_given(o->line, "mapping");
    const dp_mapping asked = given ? o->camera.mappings[0] : DP_MAPPING_D3D;
    const dp_mapping_row *row = dp_mapping_get(asked);
    entries e = {.m = {0}};
    dp_matrix_fault why;
    int status = check_mapping(o, asked);
    if (status == EXIT_FINE)
        status = read_entries(o->image.matrix, &e);
    if (status != EXIT_FINE)
        return status;
    dp_projection *p = &s->matrix.taken;
    if (dp_projection_init(p, e.m, row->ndc_signed, row->reversed, &why) != DP_OK)
        return option_error("matrix", "%s: %s, got %.9g %.9g %.9g %.9g", o->image.matrix, why.rule, why.got[0],
                            why.got[1], why.got[2], why.got[3]);
    if (given && p->mapping != asked)
        return option_error("mapping", "must be %s: window depth %s with distance in %s, got %s",
                            dp_mapping_get(p->mapping)->name, p->reversed ? "falls" : "grows", o->image.matrix,
                            row->name);
    if (p->oblique && o->image.synthetic != NULL)
        return option_error("matrix", "%s: has planes that differ from pixel to pixel, which --synthetic cannot draw",
                            o->image.matrix);
    s->matrix.path = o->image.matrix;
    name_edges(&s->matrix);
    find_planes(&e, &s->matrix);
    s->mapping_from = given ? ORIGIN_GIVEN : ORIGIN_ASSUMED;
    s->direction_from = p->ortho && !given ? ORIGIN_ASSUMED : given ? ORIGIN_GIVEN : ORIGIN_FOUND;
    with->camera.mappings[0] = p->mapping;
    with->camera.ortho = p->ortho;
    with->camera.znear = p->znear;
    with->camera.zfar = p->zfar;
    const dp_spec spec = {.znear = p->znear,
                          .zfar = p->zfar,
                          .ortho = p->ortho,
                          .mapping = with->camera.mappings[0],
                          .format = with->camera.formats[0]};
    const dp_status planes = dp_setup_init(&s->setup, &spec);
    if (planes != DP_OK)
        return option_error("matrix", "%s: its near plane is %s and its far plane %s: %s", o->image.matrix,
                            number_full(p->znear).text, number_full(p->zfar).text, dp_status_text(planes));
    return EXIT_FINE;
}

void texture_matrix_say(const texture_matrix *t, page *p) {
    const dp_projection *x = &t->taken;
    const bool centred = x->centre[0] == 0 && x->centre[1] == 0;
    texture_matrix_say_planes(t, p);
    page_note(p, "matrix", "%s: looks along %s%s%s", t->path, t->looks, centred ? "" : ", not centred",
              t->oblique ? ", planes of each pixel's own: near is the nearest, far the farthest" : "");
    if (x->ortho)
        page_note(p, "picture", "from %s to %s, %s to %s scene units", number_of(t->edges[0], 6).text,
                  number_of(t->edges[1], 6).text, number_of(t->edges[2], 6).text, number_of(t->edges[3], 6).text);
    else
        page_note(p, "field of view", "%s x %s degrees; slopes from %s to %s, %s to %s", number_of(t->fov[0], 6).text,
                  number_of(t->fov[1], 6).text, number_of(t->edges[0], 6).text, number_of(t->edges[1], 6).text,
                  number_of(t->edges[2], 6).text, number_of(t->edges[3], 6).text);
}

const column texture_matrix_columns[] = {{FIELD(texture_matrix, path, "file", "")},
                                         {FIELD(texture_matrix, looks, "looks_along", "")},
                                         {FIELD(texture_matrix, oblique, "oblique", "")},
                                         {FIELD(texture_matrix, edges[0], "left", "")},
                                         {FIELD(texture_matrix, edges[1], "right", "")},
                                         {FIELD(texture_matrix, edges[2], "bottom", "")},
                                         {FIELD(texture_matrix, edges[3], "top", "")},
                                         {FIELD(texture_matrix, fov[0], "fov_x", "degrees")},
                                         {FIELD(texture_matrix, fov[1], "fov_y", "degrees")},
                                         {FIELD(texture_matrix, planes.near_least, "near_least", "scene")},
                                         {FIELD(texture_matrix, planes.near_most, "near_most", "scene")},
                                         {FIELD(texture_matrix, planes.far_least, "far_least", "scene")},
                                         {FIELD(texture_matrix, planes.far_most, "far_most", "scene")},
                                         {.kind = COLUMN_END}};
