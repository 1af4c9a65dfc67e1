/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The options of slanted triangles taken together: view, rasterizer, and that they are asked about at all. */
#include "camera/cmd/camera.h"
#include "report/number.h"
#include "report/output.h"

/* The rasterizer's grid and set-up; --subpixel is instead of it, or says how fine a grid is that has no fixed bits. */
static int take_raster(camera_asked *c) {
    const int asked = option_given(c->line, "subpixel") ? c->triangles.subpixel : 0;
    camera_fault fault = {.key = NULL};
    return c->raster == NULL || camera_take_raster(c->raster, asked, &c->triangles, &fault) ? EXIT_FINE
                                                                                            : camera_refuse(&fault);
}

int view_vertical(const camera_asked *c, int width, int height, double *fov_y) {
    camera_fault fault = {.key = NULL};
    *fov_y = c->spec.fov_y;
    return !option_given(c->line, "hfov") || camera_vertical(c->fov_x, width, height, fov_y, &fault)
               ? EXIT_FINE
               : camera_refuse(&fault);
}

/* Takes a rasterizer whose arithmetic is known, and of the formats those that it has. */
static int take_drawn(camera_asked *c) {
    size_t kept = 0;
    if (c->raster == NULL)
        c->raster = raster_find("llvmpipe");
    if (c->raster->model == NULL)
        return option_error("raster", "must be one that draws: llvmpipe, lavapipe, softpipe or swiftshader, got '%s'",
                            c->raster->name);
    for (size_t i = 0; i < c->format_count; i++)
        if (raster_draws(c->raster, &c->formats[i]))
            c->formats[kept++] = c->formats[i];
        else if (option_given(c->line, "format"))
            return option_error("format", "must be one that %s has and that can be bounded, got %s", c->raster->name,
                                c->formats[i].name);
    c->format_count = kept;
    return take_raster(c);
}

int view_drawn(camera_asked *c) {
    if (c->ortho)
        return option_error("ortho", "does not apply to what is drawn");
    if (!option_given(c->line, "viewport")) {
        const dp_triangles standard = dp_triangles_default();
        c->triangles.width = standard.width;
        c->triangles.height = standard.height;
    }
    const int status = view_vertical(c, c->triangles.width, c->triangles.height, &c->triangles.fov_y);
    return status == EXIT_FINE ? take_drawn(c) : status;
}

int slant_view(camera_asked *c) {
    static const char *const beside[] = {"fov", "hfov", "raster", "subpixel", "slant", "triangle-class"};
    enum { OF_RASTER = 2, OF_PICTURES = 3 }; /* the first of them, which a picture takes, too: see view_drawn() */
    const bool slanted = c->triangles.width > 0;
    const bool measured = c->use.measured && c->gpu.measured[0] != '\0'; /* of r, at any slant */
    const bool by_preset = c->preset_count == 1 && !option_given(c->line, "fov") && !option_given(c->line, "hfov");
    for (size_t i = c->use.pictured ? OF_PICTURES : 0; i < sizeof beside / sizeof beside[0]; i++)
        if (option_given(c->line, beside[i]) && !slanted && !(i == OF_RASTER && measured))
            return option_error(beside[i], "needs --viewport: surfaces face the camera");
    if (!slanted)
        return EXIT_FINE;
    if (c->ortho)
        return option_error(c->use.drawn ? "rasterize" : "viewport", "conflicts with --ortho");
    return by_preset ? EXIT_FINE : view_vertical(c, c->triangles.width, c->triangles.height, &c->triangles.fov_y);
}

/* How the part of the command that is asked for takes an option; from an eye in a model surfaces slant. */
static option_taken taken(const camera_asked *c, const char *name) {
    return option_used(c->line->command, c->line->parts, option_find(c->line->command, name));
}

static bool is_slanted(const camera_asked *c, const option_taken *viewport) {
    return option_given(c->line, "viewport") || c->use.drawn || c->use.seen || viewport->own.standard != NULL;
}

/* Takes the viewport of constants and code as the shape of the view alone: nothing slants. */
static int take_shape(camera_asked *c) {
    c->spec.width = (uint32_t)c->triangles.width;
    c->spec.height = (uint32_t)c->triangles.height;
    c->triangles.width = 0;
    return EXIT_FINE;
}

int slant_complete(camera_asked *c) {
    if (c->use.shape)
        return take_shape(c);
    const option_taken viewport = taken(c, "viewport");
    if (viewport.row == NULL || !is_slanted(c, &viewport))
        c->triangles.width = 0;
    if (viewport.row == NULL && taken(c, "raster").row == NULL)
        return EXIT_FINE;
    if (c->use.mapped)
        return take_raster(c);
    const int status = slant_view(c);
    if (status != EXIT_FINE)
        return status;
    return c->use.drawn ? take_drawn(c) : take_raster(c);
}

void slant_take_raster(camera_asked *c, const char *name) {
    if (c->triangles.width == 0 || c->use.drawn || option_given(c->line, "raster") || option_given(c->line, "subpixel"))
        return;
    c->raster = raster_find(name);
    raster_describe(c->raster, &c->triangles);
}

void slant_take_preset(camera_asked *c, const preset *p) {
    dp_triangles *t = &c->triangles;
    if (t->width == 0)
        return;
    if (!option_given(c->line, "fov") && !option_given(c->line, "hfov"))
        t->fov_y = preset_fov_y(p, t->width, t->height);
    slant_take_raster(c, p->raster);
}
