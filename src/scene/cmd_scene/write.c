/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Files of `scene` for machines: verdicts as JUnit XML, and requirements that `check` reads. */
#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cli/junit.h"
#include "core/append.h"
#include "report/number.h"
#include "scene/cmd_scene/request.h"
#include "scene/cmd_scene/scene.h"
#include "solve/cmd/written.h"

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

static void put_camera(output *out, const scene *s, const dp_triangles *t) {
    dp_spec spec = s->setup.spec;
    spec.triangles = *t;
    need_write_camera(out, &spec, dp_model_name(s->setup.shader ? DP_MODEL_FLOAT : spec.model), s->o.camera.raster);
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
    output_format(out, "  %s =\n", name);
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
        need_write_separation(&out, camera, lo, hi, f->gap_min);
    }
    output_text(&out, "  # all others are at least this far apart\n  others =\n");
    need_write_separation(&out, "scene", s->setup.spec.znear, s->within, s->gap);
    output_text(&out, "};\n");
    return output_close(&out);
}
