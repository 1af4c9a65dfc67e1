/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the options of slanted triangles say together: view, rasterizer, and that they are asked about at all. */
#include "cli/option_rows.h"
#include "report/number.h"

/* The rasterizer's grid and set-up; --subpixel is instead of it, or says how fine a grid is that has no fixed bits. */
static int take_raster(options *o) {
    const raster_row *row = o->raster;
    dp_triangles *t = &o->triangles;
    const int asked = t->subpixel;
    const bool given = option_given(o, OPTION_SUBPIXEL);
    if (row == NULL)
        return EXIT_FINE;
    if (given && !row->at_least)
        return option_refuse(&option_rows[OPTION_SUBPIXEL], "cannot be combined with --raster %s", row->name);
    if (given && asked < row->plane_bits)
        return option_refuse(&option_rows[OPTION_SUBPIXEL], "must be at least %d with --raster %s, got %d",
                             row->plane_bits, row->name, asked);
    for (size_t i = 0; i < o->format_count; i++)
        if (!raster_bounded(row, &o->formats[i]))
            return option_refuse(&option_rows[OPTION_RASTER],
                                 "%s steps the codes of %s from pixel to pixel, which has no bound: name other formats "
                                 "with --format",
                                 row->name, o->formats[i].name);
    raster_describe(row, t);
    if (given)
        t->subpixel = asked;
    return EXIT_FINE;
}

/* The vertical field of view. */
static int take_view(options *o) {
    dp_triangles *t = &o->triangles;
    if (option_given(o, OPTION_FOV) && option_given(o, OPTION_HFOV))
        return option_refuse(&option_rows[OPTION_HFOV], "cannot be combined with --fov");
    t->fov_y = option_given(o, OPTION_HFOV) ? dp_fov_vertical(o->fov_x, t->width, t->height) : o->camera.fov_y;
    if (dp_triangles_check(t) != DP_OK) /* all else is in its range */
        return option_refuse(&option_rows[OPTION_HFOV],
                             "makes a vertical angle of %s degrees, which must be from 0.001 to 179.9",
                             number_of(t->fov_y, 6).text);
    return EXIT_FINE;
}

int slant_complete(options *o) {
    static const option_id beside[] = {OPTION_FOV,      OPTION_HFOV,  OPTION_RASTER,
                                       OPTION_SUBPIXEL, OPTION_SLANT, OPTION_TRIANGLE};
    if (!option_given(o, OPTION_VIEWPORT))
        o->triangles.width = 0;
    if ((o->verb->bit & option_rows[OPTION_VIEWPORT].commands) == 0)
        return EXIT_FINE;
    for (size_t i = 0; i < sizeof beside / sizeof beside[0]; i++)
        if (option_given(o, beside[i]) && !option_given(o, OPTION_VIEWPORT))
            return option_refuse(&option_rows[beside[i]], "needs --viewport: surfaces face the camera");
    if (!option_given(o, OPTION_VIEWPORT))
        return EXIT_FINE;
    if (o->ortho)
        return option_refuse(&option_rows[OPTION_VIEWPORT], "does not apply with --ortho");
    if (o->terms.world > 0.0)
        return option_refuse(&option_rows[OPTION_VIEWPORT], "cannot be combined with --world");
    const int status = take_view(o);
    return status == EXIT_FINE ? take_raster(o) : status;
}
