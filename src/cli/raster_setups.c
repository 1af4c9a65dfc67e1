/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/raster_setups.h"

#include "raster/draw.h"

static int check(const options *o) {
    static const option_id others[] = {OPTION_ARITH, OPTION_ROUNDING};
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++)
        if (option_given(o, others[i]))
            return option_error(others[i], "does not apply: %s has its own arithmetic", o->camera.raster->name);
    if (o->camera.triangles.width > RASTER_SIZE_MAX || o->camera.triangles.height > RASTER_SIZE_MAX)
        return option_error(OPTION_VIEWPORT, "must be at most %dx%d to draw in, got %dx%d", RASTER_SIZE_MAX,
                            RASTER_SIZE_MAX, o->camera.triangles.width, o->camera.triangles.height);
    return EXIT_FINE;
}

int raster_setups(const options *o, setups *out) {
    int status = check(o);
    if (status == EXIT_FINE)
        status = setups_make_float(o, out);
    for (size_t i = 0; status == EXIT_FINE && i < out->count; i++) {
        dp_spec spec = out->items[i].spec;
        const dp_mapping_row *mapping = dp_mapping_get(spec.mapping);
        if (!raster_arith(o->camera.raster, mapping->ndc_signed, &spec.arith)) {
            setups_release(out);
            return option_error(OPTION_MAPPING, "must be d3d or reversed with --raster %s, got %s",
                                o->camera.raster->name, mapping->name);
        }
        dp_setup_init(&out->items[i], &spec);
    }
    return status;
}
