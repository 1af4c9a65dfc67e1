/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Simpler models and the same findings: surfaces fight where less apart than the model asks for. */
#include <math.h>
#include <time.h>

#include "core/engine.h"
#include "quantity/quantity.h"
#include "scene/cmd_scene/scene.h"

/* Whether a finding may fight in a set-up: between the depths at which it is seen, or up to where the model is judged.
 */
static bool fights_in(const scene *s, const scene_finding *f, const dp_setup *setup, double bound) {
    const double from = fmax(f->sight.seen_from, setup->spec.znear), to = fmin(f->sight.seen_to, setup->spec.zfar);
    if (s->eyes.count > 0)
        bound = from <= to ? quantity_bound(QUANTITY_SEPARATION, setup, from, to) : (double)NAN;
    return f->gap_min < bound;
}

static bool decided_to_fight(const scene *s, const scene_finding *f) {
    return s->eyes.count > 0 ? !isnan(f->sight.fights_from) : f->fights;
}

static double now(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Counts the findings, of those that an eye sees, that it takes for what they were not decided to be. */
static void count(const scene *s, const dp_setup *setup, scene_simpler *m) {
    const double bound = quantity_bound(QUANTITY_SEPARATION, setup, setup->spec.znear, s->within);
    m->fights = m->differs = 0;
    for (size_t i = 0; i < s->found.findings; i++) {
        const scene_finding *f = &s->findings[i];
        if (s->eyes.count > 0 && isnan(f->sight.seen_from))
            continue;
        const bool fights = fights_in(s, f, setup, bound);
        m->fights += fights;
        m->differs += fights != decided_to_fight(s, f);
    }
}

/* A disturbed clock makes a turn slower, never faster: the least counts. */
static void compare(const scene *s, const dp_setup *setup, scene_simpler *m) {
    enum { TURNS = 5 };
    m->seconds = (double)NAN;
    for (int turn = 0; turn < (s->o.out.full ? TURNS : 1); turn++) {
        const double start = now();
        count(s, setup, m);
        if (s->o.out.full)
            m->seconds = fmin(m->seconds, now() - start);
    }
}

void scene_models_take(scene *s) {
    const dp_setup facing = dp_setup_facing(&s->setup);
    dp_setup setup;
    s->model_count = 0;
    s->decided = (scene_simpler){.model = dp_model_name(s->setup.spec.model),
                                 .surfaces = surfaces_words(&s->setup.spec.triangles)};
    if (s->o.out.full)
        compare(s, &s->setup, &s->decided);
    for (int k = 0; k < DP_MODEL_COUNT; k++) {
        const bool same = (dp_model)k == s->setup.spec.model && s->setup.spec.triangles.width == 0 && !s->setup.shader;
        if (same || !dp_setup_in(&facing, (dp_model)k, &setup))
            continue;
        scene_simpler *m = &s->models[s->model_count++];
        m->model = dp_model_name((dp_model)k);
        m->surfaces = surfaces_words(&facing.spec.triangles);
        compare(s, &setup, m);
    }
    dp_spec spec;
    if (s->eyes.count == 0 && camera_assumed(&s->o.camera.said, &s->setup.spec, &spec) &&
        dp_setup_init(&setup, &spec) == DP_OK) {
        s->slanted =
            (scene_simpler){.model = dp_model_name(DP_MODEL_FLOAT), .surfaces = surfaces_words(&spec.triangles)};
        s->view = spec.triangles;
        setup = dp_setup_guaranteed(&setup);
        compare(s, &setup, &s->slanted);
        s->assumed = &s->slanted;
    }
}
