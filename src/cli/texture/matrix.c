/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The projection matrix of --matrix: its file, and what it says in place of other options. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cli/errors.h"
#include "cli/texture/texture.h"
#include "core/elementary.h"
#include "report/number.h"
#include "system/input.h"

enum { ENTRIES = 16, FILE_MOST = 1 << 16 };

static const double DEGREE = M_PI / 180;

/* ---- The file ---------------------------------------------------------------------------------------------------- */

static bool is_between(char c) {
    return c == ',' || c == ' ' || (c >= '\t' && c <= '\r');
}

/* Sixteen numbers between white space and commas; # begins a comment. */
static int parse_entries(const char *path, const char *text, size_t size, double m[ENTRIES]) {
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
        if (!number_parse_part(text + at, length, NUMBER_FINITE, count < ENTRIES ? &m[count] : &extra))
            return option_error(OPTION_MATRIX, "%s: line %zu: must be a finite number, got '%s'", path, line,
                                error_word(text + at, length, shown));
        count++;
        at += length;
    }
    return count == ENTRIES ? EXIT_FINE
                            : option_error(OPTION_MATRIX, "%s: must hold 16 numbers, row by row, got %zu", path, count);
}

static int read_entries(const char *path, double m[ENTRIES]) {
    char text[FILE_MOST + 1];
    FILE *in = input_open(path);
    const size_t size = in != NULL ? fread(text, 1, sizeof text, in) : 0;
    const int error = errno;
    const bool failed = in == NULL || ferror(in) != 0;
    input_close(in);
    if (failed) {
        option_error(OPTION_MATRIX, "%s: %s", path, strerror(error));
        return EXIT_IO;
    }
    if (size > FILE_MOST)
        return option_error(OPTION_MATRIX, "%s: must have at most %d bytes: 16 numbers, row by row", path, FILE_MOST);
    return parse_entries(path, text, size, m);
}

/* ---- What it says ------------------------------------------------------------------------------------------------ */

/* It says what these would, or is of window depth. */
static int check_others(const options *o) {
    static const option_id others[] = {OPTION_NEAR, OPTION_FAR,   OPTION_ORTHO,  OPTION_FOV,
                                       OPTION_HFOV, OPTION_LOG_C, OPTION_PRESET, OPTION_METRIC};
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++)
        if (option_given(o, others[i]))
            return option_error(OPTION_MATRIX, "conflicts with --%s", option_name(others[i]));
    return EXIT_FINE;
}

static int check_mapping(const options *o, dp_mapping given) {
    const dp_mapping_row *row = dp_mapping_get(given);
    if (option_given(o, OPTION_MAPPING) && (o->camera.mapping_count > 1 || row->curve != DP_CURVE_PERSPECTIVE))
        return option_error(OPTION_MAPPING, "must be one of " DP_MAPPING_NAMES_PERSPECTIVE " with --matrix, got %s",
                            o->camera.mapping_count > 1 ? "several" : row->name);
    return EXIT_FINE;
}

static void name_edges(texture_matrix *t) {
    const projection *p = &t->taken;
    t->looks = p->backwards ? "-z" : "+z";
    for (int i = 0; i < 4; i++)
        t->edges[i] = ((i % 2 != 0 ? 1 : -1) - p->centre[i / 2]) * p->half[i / 2];
    for (int k = 0; k < 2; k++)
        t->fov[k] = p->ortho ? (double)NAN : (dp_atan(t->edges[2 * k + 1]) - dp_atan(t->edges[2 * k])) / DEGREE;
}

int texture_matrix_open(const options *o, texture_source *s, options *with) {
    const bool given = option_given(o, OPTION_MAPPING);
    const dp_mapping asked = given ? o->camera.mappings[0] : DP_MAPPING_D3D;
    const dp_mapping_row *row = dp_mapping_get(asked);
    double m[ENTRIES];
    char why[PROJECTION_WHY];
    int status = check_others(o);
    if (status == EXIT_FINE)
        status = check_mapping(o, asked);
    if (status == EXIT_FINE)
        status = read_entries(o->image.matrix, m);
    if (status != EXIT_FINE)
        return status;
    projection *p = &s->matrix.taken;
    if (!projection_init(p, m, row->ndc_signed != 0, row->reversed != 0, why))
        return option_error(OPTION_MATRIX, "%s: %s", o->image.matrix, why);
    if (given && p->reversed != (row->reversed != 0))
        return option_error(OPTION_MAPPING, "must be %s: window depth %s with distance in %s, got %s",
                            row->ndc_signed ? (p->reversed ? "gl-reversed" : "gl")
                            : p->reversed   ? "reversed"
                                            : "d3d",
                            p->reversed ? "falls" : "grows", o->image.matrix, row->name);
    if (p->oblique && o->image.synthetic != NULL)
        return option_error(OPTION_MATRIX,
                            "%s: has planes that differ from pixel to pixel, which --synthetic cannot draw",
                            o->image.matrix);
    s->matrix.path = o->image.matrix;
    name_edges(&s->matrix);
    s->mapping_from = given ? ORIGIN_GIVEN : ORIGIN_ASSUMED;
    s->direction_from = p->ortho && !given ? ORIGIN_ASSUMED : given ? ORIGIN_GIVEN : ORIGIN_FOUND;
    with->camera.mappings[0] = given ? asked : p->reversed ? DP_MAPPING_REVERSED : DP_MAPPING_D3D;
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
        return option_error(OPTION_MATRIX, "%s: its near plane is %s and its far plane %s: %s", o->image.matrix,
                            number_full(p->znear).text, number_full(p->zfar).text, dp_status_text(planes));
    return EXIT_FINE;
}

void texture_matrix_say(const texture_matrix *t, page *p) {
    const projection *x = &t->taken;
    const bool centred = x->centre[0] == 0 && x->centre[1] == 0;
    page_note(p, "matrix", "%s: looks along %s%s%s", t->path, t->looks, centred ? "" : ", not centred",
              x->oblique ? ", planes of each pixel's own: near is the nearest, far the farthest" : "");
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
                                         {FIELD(texture_matrix, taken.oblique, "oblique", "")},
                                         {FIELD(texture_matrix, edges[0], "left", "")},
                                         {FIELD(texture_matrix, edges[1], "right", "")},
                                         {FIELD(texture_matrix, edges[2], "bottom", "")},
                                         {FIELD(texture_matrix, edges[3], "top", "")},
                                         {FIELD(texture_matrix, fov[0], "fov_x", "degrees")},
                                         {FIELD(texture_matrix, fov[1], "fov_y", "degrees")},
                                         {.kind = COLUMN_END}};
