/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "solve/cmd/written.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "camera/make.h"
#include "report/number.h"

/* A number with a point or an exponent: the file's lists want one kind. */
static const char *real(double value, char out[NUMBER_SIZE + 2]) {
    const number_text text = number_full(value);
    snprintf(out, NUMBER_SIZE + 2, "%s%s", text.text, strpbrk(text.text, ".e") != NULL ? "" : ".0");
    return out;
}

static void put_number(output *out, const char *key, double value) {
    char text[NUMBER_SIZE + 2];
    output_format(out, " %s = %s;", key, isinf(value) ? "\"inf\"" : real(value, text));
}

static void put_word(output *out, const char *key, const char *word) {
    output_format(out, " %s = \"%s\";", key, word);
}

static void put_pair(output *out, const char *key, double lo, double hi) {
    char one[NUMBER_SIZE + 2], other[NUMBER_SIZE + 2];
    output_format(out, " %s = [%s, %s];", key, real(lo, one), real(hi, other));
}

/* The view, and how triangles are drawn. */
static void put_view(output *out, const dp_triangles *t, const raster_row *raster) {
    output_format(out, "\n            viewport = [%d, %d];", t->width, t->height);
    put_number(out, "fov", t->fov_y);
    if (raster != NULL)
        put_word(out, "raster", raster->name);
    if (raster == NULL || raster->at_least)
        output_format(out, " subpixel = %d;", t->subpixel);
    output_text(out, "\n           ");
    put_pair(out, "slant", t->slant_lo + 0.0, t->slant_hi + 0.0);
    output_text(out, "\n            triangle = {");
    put_number(out, "depth", t->depth);
    put_number(out, "pixels", t->pixels);
    put_number(out, "slim", t->slim);
    output_text(out, " };");
}

void need_write_camera(output *out, const dp_spec *spec, const char *model, const raster_row *raster) {
    const dp_mapping_row *mapping = dp_mapping_get(spec->mapping);
    output_text(out, " = {");
    put_number(out, "near", spec->znear);
    put_number(out, "far", spec->zfar);
    put_word(out, "mapping", mapping->name);
    put_word(out, "format", spec->format.name);
    output_text(out, spec->ortho ? " ortho = true;\n           " : "\n           ");
    put_word(out, "model", model);
    if (camera_has(spec, CAMERA_ARITH))
        put_word(out, "arith", dp_arith_get(spec->arith)->name);
    put_word(out, "rounding", dp_rounding_name(spec->rounding));
    if (camera_has(spec, CAMERA_LOG_C))
        put_number(out, "log_c", spec->log_c);
    if (spec->triangles.width > 0 && spec->model == DP_MODEL_FLOAT)
        put_view(out, &spec->triangles, raster);
    output_text(out, " };\n");
}

void need_write_separation(output *out, const char *camera, double lo, double hi, double separation) {
    output_text(out, "    {");
    put_word(out, "camera", camera);
    if (lo < hi)
        put_pair(out, "range", lo, hi);
    else
        put_number(out, "at", lo);
    put_number(out, "separation", separation);
    output_text(out, " };\n");
}
