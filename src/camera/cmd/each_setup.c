/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "camera/cmd/each_setup.h"

#include <math.h>
#include <unistd.h>

#include "core/engine.h"

enum { DEFAULT_ROWS = 9 };

/* The depths of set-up i. */
static int resolve(each_setup *w, size_t i) {
    w->here = camera_of(w->camera, w->all.cameras[i]);
    w->triangles = slant_fields_of(w->here, &w->slant);
    return depths_resolve(w->here, w->rows > 0 ? w->rows : DEFAULT_ROWS, &w->at);
}

int each_setup_start(each_setup *w, const camera_asked *camera, const output_asked *how) {
    w->camera = camera;
    w->how = how;
    int status = setups_make(camera, &w->all);
    for (size_t i = w->all.count; i-- > 0 && status == EXIT_FINE;)
        status = resolve(w, i);
    return status;
}

int each_setup_write(each_setup *w, const report_spec *spec, int status) {
    if (status == EXIT_FINE)
        status = output_start(w->how, w->camera, &w->out);
    if (status == EXIT_FINE) {
        const bool silent = w->how->quiet || isatty(w->out.fd); /* rows on the same terminal are progress enough */
        w->progress = progress_start("rows", (uint64_t)w->all.count * w->at.count, silent);
        report_spec of_all = *spec;
        of_all.when |= (w->camera->range_count > 1 ? (unsigned)EACH_OF_RANGES : 0) |
                       (w->camera->preset_count > 1 ? (unsigned)EACH_OF_PRESETS : 0);
        report_write(&of_all, &w->out, w->how->form);
        progress_end(&w->progress);
        status = output_close(&w->out);
        if (status == EXIT_FINE && !w->how->quiet)
            clipping_warn(&w->all);
    }
    setups_release(&w->all);
    return status;
}

/* Surfaces at any slant, where nobody asks about a slant. */
static dp_setup assumed_of(const each_setup *w) {
    dp_spec spec;
    dp_setup out = {.spec.triangles.width = 0};
    if (camera_assumed(&w->here->said, &w->setup->spec, &spec) && dp_setup_init(&out, &spec) == DP_OK)
        out = dp_setup_guaranteed(&out);
    return out;
}

bool each_setup_go(each_setup *w, size_t i) {
    if (i == w->all.count)
        return false;
    resolve(w, i);
    w->setup = &w->all.items[i];
    const dp_setup facing = dp_setup_facing(w->setup);
    w->full = dp_setup_guaranteed(&facing);
    w->slanted = dp_setup_guaranteed(w->setup);
    w->assumed = assumed_of(w);
    w->fields = setup_fields_asked(w->setup, w->here);
    w->fields.preset = w->camera->preset_count > 1 ? w->camera->values[w->all.cameras[i]].words : NULL;
    return true;
}

bool each_setup_depth(each_setup *w, size_t i, double *z) {
    if (i > 0)
        progress_step(&w->progress, ++w->done);
    if (i == w->at.count || output_failed(&w->out))
        return false;
    *z = depths_get(&w->at, i);
    return true;
}

bool each_setup_slanted(const each_setup *w) {
    return w->triangles != NULL && w->slanted.spec.model == DP_MODEL_FLOAT;
}

guarantee each_setup_guarantee(const each_setup *w, double z) {
    const double facing = dp_separation(&w->full, z);
    return (guarantee){facing, each_setup_slanted(w) ? dp_separation(&w->slanted, z) : (double)NAN,
                       dp_is_certain(&w->full, z, facing)};
}

void each_setup_title(page *p, void *item) {
    const each_setup *w = item;
    camera_page(p, w->here);
    setup_title(p, w->setup, &w->fields);
    camera_say_focus(p, w->here);
}
