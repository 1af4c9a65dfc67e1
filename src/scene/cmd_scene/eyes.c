/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The eyes of `scene`: --eye and --look, a file of them, or a camera of the model. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/errors.h"
#include "cli/progress.h"
#include "cli/stop.h"
#include "report/number.h"
#include "scene/cmd_scene/request.h"
#include "scene/cmd_scene/scene.h"
#include "system/input.h"
#include "texture/strips.h"

enum {
    FILE_MOST = 1 << 23, /* bytes */
    EYES_MOST = 1 << 16,
    NUMBERS = 6
};

static const double upwards[3] = {0.0, 1.0, 0.0};

/* ---- One eye ----------------------------------------------------------------------------------------------------- */

static int take_look(scene *s) {
    s->eyes.eye = malloc(sizeof *s->eyes.eye);
    if (s->eyes.eye == NULL)
        return usage_error("%s: no memory for an eye", s->file);
    if (!scene_eye_look(s->o.scene.eye, s->o.scene.look, upwards, s->eyes.eye))
        return option_error("look", "must differ from --eye; both are %s,%s,%s", number_full(s->o.scene.eye[0]).text,
                            number_full(s->o.scene.eye[1]).text, number_full(s->o.scene.eye[2]).text);
    s->eyes.count = 1;
    return EXIT_FINE;
}

/* ---- A camera of the model --------------------------------------------------------------------------------------- */

/* Takes the view from the model's camera, where none was given. */
static int take_view(scene *s, const model_camera *camera) {
    scene_request *o = &s->o;
    const char *name = o->scene.camera;
    const bool by_preset = camera_says_planes(&o->camera.said);
    if (camera->ortho)
        return option_error("camera", "must be a perspective one, and '%s' is orthographic", name);
    if (!option_given(o->line, "near") && !by_preset)
        o->camera.znear = camera->znear;
    if (!option_given(o->line, "far") && !by_preset)
        o->camera.zfar = camera->zfar;
    if (!(o->camera.znear >= CAMERA_NEAR_LEAST && o->camera.znear <= CAMERA_NEAR_MOST))
        return option_error("camera", "'%s' has its near plane at %s, which must be from %g to %g", name,
                            number_full(o->camera.znear).text, CAMERA_NEAR_LEAST, CAMERA_NEAR_MOST);
    if (!option_given(o->line, "fov") && !option_given(o->line, "hfov") && !by_preset) {
        if (!(camera->fov_y >= CAMERA_FOV_LEAST && camera->fov_y <= CAMERA_FOV_MOST))
            return option_error("camera",
                                "'%s' has a vertical field of view of %s degrees, which must be from %g to %g", name,
                                number_of(camera->fov_y, 6).text, CAMERA_FOV_LEAST, CAMERA_FOV_MOST);
        o->camera.spec.fov_y = o->camera.triangles.fov_y = camera->fov_y;
    }
    return EXIT_FINE;
}

/* One without a name is called by its number, from 1. */
typedef struct camera_name {
    char text[24];
} camera_name;

/* The index of the camera that was asked for. */
static int find_camera(const scene *s, const char **names, camera_name *numbered, size_t *found) {
    const model *m = &s->model;
    const name_list all = {.words = names};
    char text[NAMES_SIZE];
    for (size_t i = 0; i < m->cameras; i++) {
        snprintf(numbered[i].text, sizeof numbered[i].text, "%zu", i + 1);
        names[i] = *m->camera[i].name != '\0' ? m->camera[i].name : numbered[i].text;
    }
    names[m->cameras] = NULL;
    for (*found = 0; *found < m->cameras; ++*found)
        if (strcmp(names[*found], s->o.scene.camera) == 0)
            return EXIT_FINE;
    if (m->cameras == 0)
        return option_error("camera", "%s has no camera, got '%s'", s->file, s->o.scene.camera);
    return option_error("camera", "%s", names_refuse(&all, s->o.scene.camera, text));
}

static int take_camera(scene *s) {
    const model *m = &s->model;
    size_t found = 0;
    const char **names = malloc((m->cameras + 1) * sizeof *names);
    camera_name *numbered = malloc((m->cameras + 1) * sizeof *numbered);
    s->eyes.eye = malloc(sizeof *s->eyes.eye);
    const bool room = names != NULL && numbered != NULL && s->eyes.eye != NULL;
    int status = room ? find_camera(s, names, numbered, &found) : usage_error("%s: no memory for an eye", s->file);
    free(names);
    free(numbered);
    if (status == EXIT_FINE && !scene_eye_of(&m->camera[found], s->eyes.eye))
        status = option_error("camera", "'%s' looks nowhere: its node has no extent along z", s->o.scene.camera);
    if (status != EXIT_FINE)
        return status;
    s->eyes.count = 1;
    return take_view(s, &m->camera[found]);
}

/* ---- A file of eyes ---------------------------------------------------------------------------------------------- */

static bool is_between(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == ',';
}

/* The eye of a line, if it has any; # begins a comment. */
static int read_line(scene *s, const char *text, size_t length, size_t line) {
    double number[NUMBERS];
    size_t count = 0;
    for (size_t at = 0; at < length && text[at] != '#';) {
        size_t word = 0;
        char shown[ERROR_WORD_SIZE];
        double extra = 0.0;
        if (is_between(text[at])) {
            at++;
            continue;
        }
        while (at + word < length && !is_between(text[at + word]) && text[at + word] != '#')
            word++;
        double *const to = count < NUMBERS ? &number[count] : &extra;
        if (!number_parse_part(text + at, word, NUMBER_FINITE, to) || !(fabs(*to) <= 1e12))
            return option_error("path", "%s: line %zu: must be numbers from -1e12 to 1e12, got '%s'", s->o.scene.path,
                                line, error_word(text + at, word, shown));
        count++;
        at += word;
    }
    if (count == 0)
        return EXIT_FINE;
    if (count != NUMBERS)
        return option_error("path", "%s: line %zu: must be six numbers, the eye and the point it looks at, got %zu",
                            s->o.scene.path, line, count);
    if (s->eyes.count == EYES_MOST)
        return option_error("path", "%s: line %zu: must be at most %d eyes", s->o.scene.path, line, EYES_MOST);
    scene_eye *eye = &s->eyes.eye[s->eyes.count];
    if (!scene_eye_look(number, number + 3, upwards, eye))
        return option_error("path", "%s: line %zu: must look at a point other than the eye", s->o.scene.path, line);
    eye->line = line;
    s->eyes.count++;
    return EXIT_FINE;
}

static int read_lines(scene *s, const char *text, size_t size) {
    size_t lines = 1, line = 1;
    int status = EXIT_FINE;
    for (size_t i = 0; i < size; i++)
        lines += text[i] == '\n';
    s->eyes.eye = malloc((lines < EYES_MOST ? lines : EYES_MOST) * sizeof *s->eyes.eye);
    if (s->eyes.eye == NULL)
        return usage_error("%s: no memory for %zu eyes", s->o.scene.path, lines);
    for (size_t at = 0; at < size && status == EXIT_FINE; line++) {
        const char *end = memchr(text + at, '\n', size - at);
        const size_t length = end != NULL ? (size_t)(end - text) - at : size - at;
        status = read_line(s, text + at, length, line);
        at += length + 1;
    }
    if (status == EXIT_FINE && s->eyes.count == 0)
        status = option_error("path", "%s: has no line of six numbers", s->o.scene.path);
    return status;
}

static int take_path(scene *s) {
    char *text = malloc(FILE_MOST + 1);
    if (text == NULL)
        return usage_error("%s: no memory to read it", s->o.scene.path);
    FILE *in = input_open(s->o.scene.path);
    const size_t size = in != NULL ? fread(text, 1, FILE_MOST + 1, in) : 0;
    const int error = errno;
    int status = EXIT_FINE;
    if (in == NULL || ferror(in))
        status = option_unreadable("path", s->o.scene.path, error);
    else if (size > FILE_MOST)
        status = option_error("path", "%s: must be at most %d bytes", s->o.scene.path, FILE_MOST);
    input_close(in);
    if (status == EXIT_FINE)
        status = read_lines(s, text, size);
    free(text);
    return status;
}

/* ---- All ways ---------------------------------------------------------------------------------------------------- */

int scene_eyes_check(const scene_request *o) {
    if (scene_is_seen(o->line) && option_given(o->line, "slant"))
        return option_error("slant", "does not apply from an eye: the model says how its surfaces slant");
    return EXIT_FINE;
}

/* For the report. */
static void describe(scene *s) {
    const double nan = (double)NAN;
    scene_eyes *e = &s->eyes;
    e->places = e->count;
    e->path = s->o.scene.path;
    e->camera = s->o.scene.camera;
    e->from = e->ahead = (scene_place){nan, nan, nan};
    if (e->count != 1)
        return;
    e->from = (scene_place){e->eye->place[0], e->eye->place[1], e->eye->place[2]};
    e->ahead = (scene_place){e->eye->ahead[0], e->eye->ahead[1], e->eye->ahead[2]};
}

int scene_eyes_take(scene *s) {
    const int status = option_given(s->o.line, "eye")    ? take_look(s)
                       : option_given(s->o.line, "path") ? take_path(s)
                       : s->o.scene.camera != NULL       ? take_camera(s)
                                                         : EXIT_FINE;
    if (status == EXIT_FINE)
        describe(s);
    return status;
}

/* ---- Judging ----------------------------------------------------------------------------------------------------- */

int scene_eyes_judge(scene *s) {
    const sight_asked asked = {.m = &s->model,
                               .found = &s->found,
                               .setup = &s->setup,
                               .within = s->within,
                               .gap = s->gap,
                               .any_side = (s->o.scene.filters_off >> FINDER_FACING & 1U) != 0,
                               .classes = s->o.scene.emit_need != NULL,
                               .eye = s->eyes.eye,
                               .eyes = s->eyes.count,
                               .stop = stop_asked};
    const double nearer_than = option_given(s->o.line, "within") ? s->within : HUGE_VAL;
    const int threads = strips_threads(s->o.out.threads);
    scene_sight *room = malloc((size_t)threads * s->eyes.count * sizeof *room), *next = room;
    if (room == NULL)
        return usage_error("%s: no memory to judge it from %zu eyes", s->file, s->eyes.count);
    progress bar = progress_start("findings judged", s->found.findings, s->o.out.quiet);
    uint64_t done = 0;
#pragma omp parallel num_threads(threads)
    {
        scene_sight *own;
#pragma omp critical(scene_room)
        {
            own = next;
            next += s->eyes.count;
        }
#pragma omp for schedule(dynamic)
        for (size_t i = 0; i < s->found.findings; i++) {
            scene_finding *f = &s->findings[i];
            f->sight = scene_sight_worst(&asked, f->of, own);
            f->fights = f->sight.fights_from < nearer_than;
            f->verdict.lift = f->sight.lift;
            f->line = s->o.scene.path != NULL && !isnan(f->sight.seen_from) ? (double)s->eyes.eye[f->sight.eye].line
                                                                            : (double)NAN;
#pragma omp critical(scene_progress)
            progress_step(&bar, ++done);
        }
    }
    progress_end(&bar);
    free(room);
    return EXIT_FINE;
}
