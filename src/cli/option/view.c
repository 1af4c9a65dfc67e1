/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the options of slanted triangles say together: view, rasterizer, and that they are asked about at all. */
#include "cli/option/uses.h"
#include "report/number.h"

/* The rasterizer's grid and set-up; --subpixel is instead of it, or says how fine a grid is that has no fixed bits. */
static int take_raster(options *o) {
    const raster_row *row = o->camera.raster;
    dp_triangles *t = &o->camera.triangles;
    const int asked = t->subpixel;
    const bool given = option_given(o, OPTION_SUBPIXEL);
    if (row == NULL)
        return EXIT_FINE;
    if (given && !row->at_least)
        return option_refuse(&option_rows[OPTION_SUBPIXEL], "does not apply: %s has its own grid", row->name);
    if (given && asked < row->plane_bits)
        return option_refuse(&option_rows[OPTION_SUBPIXEL], "must be at least %d with --raster %s, got %d",
                             row->plane_bits, row->name, asked);
    raster_describe(row, t);
    if (given)
        t->subpixel = asked;
    return EXIT_FINE;
}

int view_vertical(const options *o, int width, int height, double *fov_y) {
    const option_row *row = &option_rows[OPTION_HFOV];
    *fov_y = o->view.spec.fov_y;
    if (!option_given(o, OPTION_HFOV))
        return EXIT_FINE;
    if (option_given(o, OPTION_FOV))
        return option_refuse(row, "conflicts with --fov");
    *fov_y = dp_fov_vertical(o->camera.fov_x, width, height);
    if (!(*fov_y >= 0.001 && *fov_y <= 179.9)) /* as dp_triangles has it */
        return option_refuse(row, "makes a vertical angle of %s degrees, which must be from 0.001 to 179.9",
                             number_of(*fov_y, 6).text);
    return EXIT_FINE;
}

/* What draws: a rasterizer whose arithmetic is known, and of the formats those that it has. */
static int take_drawn(options *o) {
    size_t kept = 0;
    if (o->camera.raster == NULL)
        o->camera.raster = raster_find("llvmpipe");
    if (o->camera.raster->model == NULL)
        return option_refuse(&option_rows[OPTION_RASTER],
                             "must be one that draws: llvmpipe, lavapipe, softpipe or swiftshader, got '%s'",
                             o->camera.raster->name);
    for (size_t i = 0; i < o->camera.format_count; i++)
        if (raster_draws(o->camera.raster, &o->camera.formats[i]))
            o->camera.formats[kept++] = o->camera.formats[i];
        else if (option_given(o, OPTION_FORMAT))
            return option_refuse(&option_rows[OPTION_FORMAT], "must be one that %s has and that can be bounded, got %s",
                                 o->camera.raster->name, o->camera.formats[i].name);
    o->camera.format_count = kept;
    return take_raster(o);
}

int view_drawn(options *o) {
    if (o->camera.ortho)
        return option_refuse(&option_rows[OPTION_ORTHO], "does not apply to what is drawn");
    if (!option_given(o, OPTION_VIEWPORT)) {
        const dp_triangles standard = dp_triangles_default();
        o->camera.triangles.width = standard.width;
        o->camera.triangles.height = standard.height;
    }
    const int status =
        view_vertical(o, o->camera.triangles.width, o->camera.triangles.height, &o->camera.triangles.fov_y);
    return status == EXIT_FINE ? take_drawn(o) : status;
}

int slant_view(options *o) {
    static const option_id beside[] = {OPTION_FOV,      OPTION_HFOV,  OPTION_RASTER,
                                       OPTION_SUBPIXEL, OPTION_SLANT, OPTION_TRIANGLE_CLASS};
    enum { OF_PICTURES = 3 }; /* the first of them, which a picture takes, too: see view_drawn() */
    const bool slanted = o->camera.triangles.width > 0;
    const bool measured = o->command->id == CMD_BIAS && o->camera.gpu.measured[0] != '\0'; /* of r, at any slant */
    const bool by_preset = o->camera.preset_count == 1 && !option_given(o, OPTION_FOV) && !option_given(o, OPTION_HFOV);
    for (size_t i = o->scene.render != NULL ? OF_PICTURES : 0; i < sizeof beside / sizeof beside[0]; i++)
        if (option_given(o, beside[i]) && !slanted && !(beside[i] == OPTION_RASTER && measured))
            return option_refuse(&option_rows[beside[i]], "needs --viewport: surfaces face the camera");
    if (!slanted)
        return EXIT_FINE;
    if (o->camera.ortho)
        return option_refuse(&option_rows[o->census.drawn ? OPTION_RASTERIZE : OPTION_VIEWPORT],
                             "conflicts with --ortho");
    return by_preset
               ? EXIT_FINE
               : view_vertical(o, o->camera.triangles.width, o->camera.triangles.height, &o->camera.triangles.fov_y);
}

/* From an eye in a model surfaces slant. */
static bool is_slanted(const options *o, const option_use *viewport) {
    return option_given(o, OPTION_VIEWPORT) || o->census.drawn || viewport->own->standard != NULL ||
           option_given(o, OPTION_EYE) || option_given(o, OPTION_PATH) || option_given(o, OPTION_CAMERA);
}

/* Of constants and code the viewport is the shape of the view alone: nothing slants. */
static int take_shape(options *o) {
    o->view.spec.width = (uint32_t)o->camera.triangles.width;
    o->view.spec.height = (uint32_t)o->camera.triangles.height;
    o->camera.triangles.width = 0;
    return EXIT_FINE;
}

int slant_complete(options *o) {
    if (o->wanted.constants || o->command->id == CMD_CODE)
        return take_shape(o);
    const option_use *viewport = option_used(o->command, o->parts, OPTION_VIEWPORT);
    if (viewport == NULL || !is_slanted(o, viewport))
        o->camera.triangles.width = 0;
    if (viewport == NULL && option_used(o->command, o->parts, OPTION_RASTER) == NULL)
        return EXIT_FINE;
    const bool mapped = o->command->id == CMD_SHADOW || o->command->id == CMD_PLOT;
    if (mapped) /* the viewport of a shadow map says how wide the view is */
        return take_raster(o);
    const int status = slant_view(o);
    if (status != EXIT_FINE)
        return status;
    return o->census.drawn ? take_drawn(o) : take_raster(o);
}

void slant_take_raster(options *o, const char *name) {
    if (o->camera.triangles.width == 0 || o->census.drawn || option_given(o, OPTION_RASTER) ||
        option_given(o, OPTION_SUBPIXEL))
        return;
    o->camera.raster = raster_find(name);
    raster_describe(o->camera.raster, &o->camera.triangles);
}

void slant_take_preset(options *o, const preset *p) {
    dp_triangles *t = &o->camera.triangles;
    if (t->width == 0)
        return;
    if (!option_given(o, OPTION_FOV) && !option_given(o, OPTION_HFOV))
        t->fov_y = preset_fov_y(p, t->width, t->height);
    slant_take_raster(o, p->raster);
}
