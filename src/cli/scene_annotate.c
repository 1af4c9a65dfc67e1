/* SPDX-License-Identifier: GPL-3.0-or-later */
/* scene --annotate: the model as .glb, its triangles that fight in materials of their own. */
#include <math.h>
#include <stdlib.h>

#include "cli/errors.h"
#include "cli/scene.h"
#include "cli/stop.h"
#include "model/gltf_write.h"

enum { NEARER = 1, FARTHER };

static const gltf_mark marks[] = {[NEARER - 1] = {"depthprec: fights", {0.8, 0.0, 0.0}},
                                  [FARTHER - 1] = {"depthprec: fights farther off", {0.9, 0.4, 0.0}}};

/* At any distance. */
static bool can_fight(const scene *s, const scene_finding *f) {
    return s->eyes.count > 0 ? !isnan(f->sight.fights_from) : !(f->verdict.certain_to >= s->setup.spec.zfar);
}

/* The findings come with the nearest fight first, so the first mark of a triangle stands. */
static void mark_triangles(const scene *s, unsigned char *mark) {
    for (size_t i = 0; i < s->found.findings && can_fight(s, &s->findings[i]); i++) {
        const scene_finding *f = &s->findings[i];
        for (size_t k = f->of->first; k < f->of->first + f->of->pairs; k++)
            for (int side = 0; side < 2; side++) {
                unsigned char *at = &mark[s->found.pair[k].triangle[side]];
                if (*at == 0)
                    *at = f->fights ? NEARER : FARTHER;
            }
    }
}

static bool take(void *context, const void *bytes, size_t size) {
    output_bytes(context, bytes, size);
    return !output_failed(context) && !stop_asked();
}

int scene_annotate(scene *s) {
    output out;
    int status = output_open(&out, s->o.annotate);
    if (status != EXIT_FINE)
        return status;
    unsigned char *mark = calloc(s->model.triangles + 1, 1);
    const gltf_written written = {
        .marks = marks, .count = sizeof marks / sizeof *marks, .mark = mark, .write = take, .context = &out};
    if (mark != NULL)
        mark_triangles(s, mark);
    const gltf_status done = mark != NULL ? gltf_write(&s->model, &written) : GLTF_NO_MEMORY;
    free(mark);
    if (done == GLTF_RANGE || done == GLTF_NO_MEMORY)
        status = usage_error(done == GLTF_RANGE ? "%s: too large for a .glb: 4 GiB, and coordinates of binary32"
                                                : "%s: no memory to annotate it",
                             s->file);
    stop_end(&out); /* which removes the file */
    if (status == EXIT_FINE)
        return output_close(&out);
    output_abandon(&out);
    return status;
}
