/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Files of `scene` for machines: verdicts as JUnit XML, and requirements that `check` reads. */
#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "camera/make.h"
#include "cli/junit.h"
#include "core/append.h"
#include "report/number.h"
#include "scene/cmd_scene/request.h"
#include "scene/cmd_scene/scene.h"

enum { NAME_MOST = 64, TEXT_SIZE = 512, CAMERA_SIZE = 32 };

/* ---- JUnit ------------------------------------------------------------------------------------------------------- */

void scene_junit(const scene *s, output *out) {
    const size_t count = s->found.findings;
    char label[SETUP_LABEL_SIZE], full[SETUP_LABEL_SIZE], text[TEXT_SIZE], name[TEXT_SIZE];
    size_t failures = 0;
    for (size_t i = 0; i < count; i++)
        failures += s->findings[i].fights;
    setup_label(&s->setup, false, label);
    setup_label(&s->setup, true, full);
    junit_begin(out, "depthprec scene");
    junit_suite(out, s->file, count > 0 ? count : 1, failures);
    for (size_t i = 0; i < count; i++) {
        const scene_finding *f = &s->findings[i];
        junit_case(out, &(junit_row){.classname = label,
                                     .name = scene_surfaces(f, name, sizeof name),
                                     .file = s->file,
                                     .type = f->fights ? "fights" : NULL,
                                     .message = scene_message(s, f, text, sizeof text),
                                     .detail = full});
    }
    if (count == 0) {
        snprintf(name, sizeof name, "no surfaces within %s of each other", camera_length(&s->o.camera, s->gap, 0).text);
        junit_case(out, &(junit_row){.classname = label, .name = name, .file = s->file});
    }
    junit_suite_end(out);
    junit_end(out);
}

/* ---- Requirements ------------------------------------------------------------------------------------------------ */

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

/* The view, and how triangles are drawn; of a mapping that is not affine on the screen, none is judged. */
static void put_view(output *out, const scene *s, const dp_triangles *t) {
    if (t->width == 0 || s->setup.spec.model != DP_MODEL_FLOAT)
        return;
    output_format(out, "\n            viewport = [%d, %d];", t->width, t->height);
    put_number(out, "fov", t->fov_y);
    if (s->o.camera.raster != NULL)
        put_word(out, "raster", s->o.camera.raster->name);
    if (s->o.camera.raster == NULL || s->o.camera.raster->at_least)
        output_format(out, " subpixel = %d;", t->subpixel);
    output_text(out, "\n           ");
    put_pair(out, "slant", t->slant_lo + 0.0, t->slant_hi + 0.0);
    output_text(out, "\n            triangle = {");
    put_number(out, "depth", t->depth);
    put_number(out, "pixels", t->pixels);
    put_number(out, "slim", t->slim);
    output_text(out, " };");
}

static void put_camera(output *out, const scene *s, const dp_triangles *t) {
    const dp_spec *spec = &s->setup.spec;
    output_text(out, " = {");
    put_number(out, "near", spec->znear);
    put_number(out, "far", spec->zfar);
    put_word(out, "mapping", dp_mapping_get(spec->mapping)->name);
    put_word(out, "format", spec->format.name);
    output_text(out, "\n           ");
    put_word(out, "model", option_word("model", s->setup.shader ? DP_MODEL_FLOAT : spec->model));
    if (camera_has(spec, CAMERA_ARITH))
        put_word(out, "arith", dp_arith_get(spec->arith)->name);
    put_word(out, "rounding", dp_rounding_name(spec->rounding));
    if (camera_has(spec, CAMERA_LOG_C))
        put_number(out, "log_c", spec->log_c);
    put_view(out, s, t);
    output_text(out, " };\n");
}

/* From eyes, a pair is judged by the class of its own triangles, and so has a camera of its own. */
static bool has_camera(const scene *s, const scene_finding *f) {
    dp_spec spec = s->setup.spec;
    dp_setup setup;
    spec.triangles = f->sight.triangles;
    return s->eyes.count > 0 && spec.triangles.width > 0 && dp_setup_init(&setup, &spec) == DP_OK;
}

/* The eye depths at which a pair is looked at: from one eye where it is seen. @return false where at none */
static bool looked_at(const scene *s, const scene_finding *f, double *lo, double *hi) {
    *lo = s->setup.spec.znear;
    *hi = s->within;
    if (s->eyes.count == 0)
        return true;
    if (isnan(f->sight.seen_from))
        return false;
    if (s->eyes.count == 1) {
        *lo = fmax(*lo, f->sight.seen_from);
        *hi = fmin(*hi, f->sight.seen_to);
    }
    return *lo <= *hi;
}

static bool is_touching(const scene *s, const scene_finding *f) {
    return !(f->gap_min > SCENE_NO_GAP * s->extent);
}

static void put_cameras(output *out, const scene *s) {
    output_text(out, "cameras = {\n  scene");
    put_camera(out, s, &s->setup.spec.triangles);
    for (size_t i = 0; i < s->found.findings; i++) {
        const scene_finding *f = &s->findings[i];
        double lo, hi;
        if (!looked_at(s, f, &lo, &hi) || is_touching(s, f) || !has_camera(s, f))
            continue;
        output_format(out, "  scene_p%zu", i + 1);
        put_camera(out, s, &f->sight.triangles);
    }
    output_text(out, "};\n\n");
}

/* "p3_front_wall_poster": a name that is one word, from those of both nodes. */
static void put_name(output *out, const scene_finding *f, size_t i) {
    char name[NAME_MOST / 2 + 16];
    snprintf(name, sizeof name, "p%zu", i + 1);
    const scene_named *both[] = {&f->a, &f->b};
    for (int k = 0; k < 2; k++) {
        const char *of = both[k]->node != NULL ? both[k]->node : both[k]->mesh != NULL ? both[k]->mesh : "";
        append(name, sizeof name, "%s", *of != '\0' ? "_" : "");
        for (size_t n = 0; n < NAME_MOST / 4 && of[n] != '\0'; n++)
            append(name, sizeof name, "%c", isascii(of[n]) && isalnum((unsigned char)of[n]) ? of[n] : '_');
    }
    output_format(out, "  %s =\n    {", name);
}

/* A comment ends with its line. */
static void put_comment(output *out, const scene_finding *f, const char *what) {
    char name[TEXT_SIZE];
    scene_surfaces(f, name, sizeof name);
    for (char *c = name; *c != '\0'; c++)
        if ((unsigned char)*c < ' ')
            *c = ' ';
    output_format(out, "  # %s%s\n", name, what);
}

static void put_need(output *out, const char *camera, double lo, double hi, double separation) {
    put_word(out, "camera", camera);
    if (lo < hi)
        put_pair(out, "range", lo, hi);
    else
        put_number(out, "at", lo);
    put_number(out, "separation", separation);
    output_text(out, " };\n");
}

int scene_need(scene *s) {
    output out;
    const int status = output_open(&out, s->o.scene.emit_need);
    if (status != EXIT_FINE)
        return status;
    output_text(&out, "# What a camera must resolve in a model: run `depthprec check` on this file.\n");
    if (s->unit != NULL)
        output_format(&out, "unit = \"%s\";\n\n", s->unit);
    put_cameras(&out, s);
    output_text(&out, "requirements = {\n");
    for (size_t i = 0; i < s->found.findings; i++) {
        const scene_finding *f = &s->findings[i];
        char camera[CAMERA_SIZE];
        double lo, hi;
        if (!looked_at(s, f, &lo, &hi))
            continue;
        if (is_touching(s, f)) {
            put_comment(&out, f, " touch: no camera resolves them there");
            continue;
        }
        put_comment(&out, f, "");
        put_name(&out, f, i);
        snprintf(camera, sizeof camera, has_camera(s, f) ? "scene_p%zu" : "scene", i + 1);
        put_need(&out, camera, lo, hi, f->gap_min);
    }
    output_text(&out, "  # all others are at least this far apart\n  others =\n    {");
    put_need(&out, "scene", s->setup.spec.znear, s->within, s->gap);
    output_text(&out, "};\n");
    return output_close(&out);
}
