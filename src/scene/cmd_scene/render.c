/* SPDX-License-Identifier: GPL-3.0-or-later */
/* scene --render: what the camera sees as a PNG, and how many of its pixels each finding makes wrong. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "camera/cmd/raster_setups.h"
#include "cli/output/picture.h"
#include "cli/progress.h"
#include "cli/stop.h"
#include "draw/canvas.h"
#include "report/number.h"
#include "scene/cmd_scene/request.h"
#include "scene/cmd_scene/scene.h"
#include "scene/render.h"

enum { STEPS = 1000 };

static int advance(void *context, double share) {
    progress_step(context, (uint64_t)(share * STEPS));
    return stop_asked();
}

/* ---- The camera -------------------------------------------------------------------------------------------------- */

static int take_camera(scene *s, draw_camera *camera) {
    scene_request o = s->o;
    setups all;
    int status = view_drawn(&o.camera);
    if (status == EXIT_FINE)
        status = raster_setups(&o.camera, &all);
    if (status != EXIT_FINE)
        return status;
    if ((double)o.camera.triangles.width * o.camera.triangles.height > RENDER_PIXELS_MAX)
        status = option_error("viewport", "must be of at most %d pixels with --render, got %dx%d", RENDER_PIXELS_MAX,
                              o.camera.triangles.width, o.camera.triangles.height);
    if (status == EXIT_FINE && draw_camera_init(camera, o.camera.raster, &all.items[0]) != RASTER_OK)
        status =
            option_error("render", "cannot be drawn by %s in %s", o.camera.raster->name, all.items[0].spec.format.name);
    s->rendered = (scene_rendered){.file = s->o.scene.render,
                                   .raster = o.camera.raster->name,
                                   .width = o.camera.triangles.width,
                                   .height = o.camera.triangles.height,
                                   .fov_y = all.items[0].spec.triangles.fov_y};
    setups_release(&all);
    return status;
}

int scene_render_check(scene *s) {
    draw_camera camera;
    if (s->o.scene.render == NULL)
        return EXIT_FINE;
    if (canvas_format_of(s->o.scene.render) != CANVAS_PNG)
        return option_error("render", "must end in .png, got '%s'", s->o.scene.render);
    return take_camera(s, &camera);
}

/* The eye that was asked for; else all of the model, from where the worst of the findings are seen. */
static bool take_eye(const scene *s, const draw_camera *camera, scene_eye *eye) {
    if (s->eyes.count > 0) {
        *eye = s->eyes.eye[0];
        return true;
    }
    const size_t count = s->found.findings;
    double(*towards)[3] = malloc((count + 1) * sizeof *towards);
    if (towards == NULL)
        return false;
    for (size_t i = 0; i < count; i++)
        for (int k = 0; k < 3; k++)
            towards[i][k] = s->findings[i].of->normal[k] * s->findings[i].area;
    *eye = render_overview(&s->model, camera, count, (const double(*)[3])towards);
    free(towards);
    return true;
}

/* ---- What is wrong ----------------------------------------------------------------------------------------------- */

static int by_surfaces(const void *one, const void *other) {
    const finder_finding *a = (*(scene_finding *const *)one)->of, *b = (*(scene_finding *const *)other)->of;
    if (a->a != b->a)
        return a->a < b->a ? -1 : 1;
    return (a->b > b->b) - (a->b < b->b);
}

/* Wrong pixels belong to the finding of their two surfaces; some to none, where bodies cross. */
static bool count_wrong(scene *s, const render_picture *p) {
    const size_t count = s->found.findings;
    scene_finding **sorted = malloc((count + 1) * sizeof *sorted);
    if (sorted == NULL)
        return false;
    for (size_t i = 0; i < count; i++) {
        sorted[i] = &s->findings[i];
        s->findings[i].wrong_pixels = 0;
    }
    qsort(sorted, count, sizeof *sorted, by_surfaces);
    for (size_t i = 0; i < (size_t)p->width * (size_t)p->height; i++) {
        if (p->nearer[i] == RENDER_NOTHING)
            continue;
        const uint32_t a = s->model.of[p->shown[i]], b = s->model.of[p->nearer[i]];
        const finder_finding pair = {.a = a < b ? a : b, .b = a < b ? b : a};
        scene_finding wanted = {.of = &pair}, *key = &wanted;
        scene_finding **found = bsearch(&key, sorted, count, sizeof *sorted, by_surfaces);
        if (found != NULL) {
            (*found)->wrong_pixels++;
            s->rendered.wrong_found++;
        }
    }
    s->rendered.wrong_pixels = p->wrong;
    free(sorted);
    return true;
}

/* ---- The picture ------------------------------------------------------------------------------------------------- */

static int write_picture(const scene *s, const render_asked *asked, const render_picture *p) {
    uint32_t *pixel = malloc((size_t)p->width * (size_t)p->height * sizeof *pixel);
    if (pixel != NULL)
        render_colours(asked, p, pixel);
    const int status = picture_write(s->o.scene.render, pixel, p->width, p->height);
    free(pixel);
    return status;
}

int scene_render(scene *s) {
    draw_camera camera;
    render_picture p;
    int status = take_camera(s, &camera);
    if (status != EXIT_FINE)
        return status;
    progress bar = progress_start("of the picture", STEPS, s->o.out.quiet);
    render_asked asked = {.m = &s->model,
                          .camera = &camera,
                          .progress = advance,
                          .context = &bar,
                          .any_side = (s->o.scene.filters_off & 1U << FINDER_FACING) != 0,
                          .blended = (s->o.scene.filters_off & 1U << FINDER_BLENDED) != 0};
    const bool good = take_eye(s, &camera, &asked.eye);
    s->rendered.eye = (scene_place){asked.eye.place[0], asked.eye.place[1], asked.eye.place[2]};
    s->rendered.ahead = (scene_place){asked.eye.ahead[0], asked.eye.ahead[1], asked.eye.ahead[2]};
    const render_status drawn = good ? render_draw(&asked, &p) : RENDER_NO_MEMORY;
    progress_end(&bar);
    if (drawn == RENDER_STOPPED)
        return EXIT_FINE; /* which stop_end() sees */
    if (drawn == RENDER_RANGE)
        return usage_error("%s: its coordinates are beyond 1e30: too far to be drawn", s->file);
    if (drawn == RENDER_NO_MEMORY || !count_wrong(s, &p)) {
        status = usage_error("%s: no memory for the picture", s->o.scene.render);
    } else {
        status = write_picture(s, &asked, &p);
    }
    if (drawn == RENDER_DONE)
        render_free(&p);
    return status;
}
