/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The options of slanted triangles taken together: view, rasterizer, and that they are asked about at all. */
#include "camera/cmd/camera.h"
#include "report/number.h"
#include "report/output.h"

static int status_of(bool good, const camera_fault *fault) {
    return good ? EXIT_FINE : camera_refuse(fault);
}

int view_vertical(const camera_asked *c, int width, int height, double *fov_y) {
    camera_fault fault = {.key = NULL};
    return status_of(camera_angle(&c->said, c->spec.fov_y, width, height, fov_y, &fault), &fault);
}

/* Takes a rasterizer whose arithmetic is known, and of the formats those that it has. */
static int take_drawn(camera_asked *c) {
    camera_fault fault = {.key = NULL};
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
    return status_of(camera_grid(&c->said, &fault), &fault);
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
    camera_fault fault = {.key = NULL};
    if (c->triangles.width > 0)
        c->triangles.fov_y = c->spec.fov_y;
    return status_of(camera_viewed(&c->said, &fault), &fault);
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
    const option_taken viewport = taken(c, "viewport");
    const bool viewed = viewport.row != NULL || taken(c, "raster").row != NULL;
    c->use.angled = c->use.shape || !viewed;
    for (int k = CAMERA_VIEWPORT; k < CAMERA_KEYS && c->use.angled; k++)
        if (k != CAMERA_FOV && k != CAMERA_HFOV)
            c->words[k] = NULL; /* of another meaning to this command */
    if (c->use.shape)
        return take_shape(c);
    if (viewport.row == NULL || !is_slanted(c, &viewport))
        c->triangles.width = 0;
    if (c->triangles.width > 0)
        c->triangles.fov_y = c->spec.fov_y;
    return c->use.drawn && viewed ? take_drawn(c) : EXIT_FINE;
}
