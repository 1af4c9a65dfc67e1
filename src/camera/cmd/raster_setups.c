/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "camera/cmd/raster_setups.h"

#include "raster/draw.h"

static int check(const camera_asked *c) {
    static const char *const others[] = {"arith", "rounding"};
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++)
        if (option_given(c->line, others[i]))
            return option_error(others[i], "does not apply: %s has its own arithmetic", c->raster->name);
    if (c->triangles.width > RASTER_SIZE_MAX || c->triangles.height > RASTER_SIZE_MAX)
        return option_error("viewport", "must be at most %dx%d to draw in, got %dx%d", RASTER_SIZE_MAX, RASTER_SIZE_MAX,
                            c->triangles.width, c->triangles.height);
    return EXIT_FINE;
}

int raster_setups(const camera_asked *c, setups *out) {
    int status = check(c);
    if (status == EXIT_FINE)
        status = setups_make_float(c, out);
    for (size_t i = 0; status == EXIT_FINE && i < out->count; i++) {
        dp_spec spec = out->items[i].spec;
        const dp_mapping_row *mapping = dp_mapping_get(spec.mapping);
        if (!raster_arith(c->raster, mapping->ndc_signed, &spec.arith)) {
            setups_release(out);
            return option_error("mapping", "must be d3d or reversed with --raster %s, got %s", c->raster->name,
                                mapping->name);
        }
        dp_setup_init(&out->items[i], &spec);
    }
    return status;
}
