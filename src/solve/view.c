/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The triangles of a camera in a requirement file; without a viewport surfaces face it. */
#include <math.h>
#include <stddef.h>
#include <string.h>

#include "raster/raster.h"
#include "solve/reader.h"

/* Two numbers, [A, B], each from `least` to `most`. */
static bool read_pair(reader *r, setting *s, double least, double most, const char *form, double out[2]) {
    bool good = (s->kind == SETTING_ARRAY || s->kind == SETTING_LIST) && s->count == 2;
    for (setting *end = s->first; good && end != NULL; end = end->next)
        good = reader_number_within(end, least, most, out++);
    return good || reader_fail(r, s, "%s: must be %s, got %s", s->name, form, reader_shown(r, s));
}

static bool read_viewport(reader *r, setting *s, dp_triangles *t) {
    static const char form[] = "[WIDTH, HEIGHT], each a whole number from 1 to 32768 pixels";
    double sides[2];
    if (!read_pair(r, s, 1, CAMERA_SIDE_MOST, form, sides))
        return false;
    if (sides[0] != floor(sides[0]) || sides[1] != floor(sides[1]))
        return reader_fail(r, s, "viewport: must be %s, got %g and %g", form, sides[0], sides[1]);
    t->width = (int)sides[0];
    t->height = (int)sides[1];
    return true;
}

static bool read_slant(reader *r, setting *s, dp_triangles *t) {
    static const char form[] = "[LO, HI], from 0 to 90 degrees";
    double ends[2];
    if (!read_pair(r, s, 0, 90, form, ends))
        return false;
    if (ends[0] > ends[1])
        return reader_fail(r, s, "slant: must be %s, got %g and %g", form, ends[0], ends[1]);
    t->slant_lo = ends[0];
    t->slant_hi = ends[1];
    return true;
}

/* Degrees, as the options take them. */
static bool read_angle(reader *r, setting *s, double *out) {
    return reader_number_within(s, CAMERA_FOV_LEAST, CAMERA_FOV_MOST, out) ||
           reader_fail(r, s, "%s: must be a number from %g to %g degrees, got %s", s->name, CAMERA_FOV_LEAST,
                       CAMERA_FOV_MOST, reader_shown(r, s));
}

static bool read_fov(reader *r, setting *s, dp_triangles *t) {
    return read_angle(r, s, &t->fov_y);
}

static bool read_subpixel(reader *r, setting *s, dp_triangles *t) {
    double bits;
    if (!reader_number_within(s, 1, CAMERA_SUBPIXEL_MOST, &bits) || bits != floor(bits))
        return reader_fail(r, s, "subpixel: must be a whole number from 1 to %d bits, got %s", CAMERA_SUBPIXEL_MOST,
                           reader_shown(r, s));
    t->subpixel = (int)bits;
    return true;
}

static bool read_class(reader *r, setting *group, dp_triangles *t) {
    static const char *const names[] = {"depth", "pixels", "slim", NULL};
    double *const fields[] = {&t->depth, &t->pixels, &t->slim};
    setting *found[3];
    if (group->kind != SETTING_GROUP)
        return reader_fail(r, group, "triangle: must be a group { depth = 2; pixels = 512; slim = 16; }, got %s",
                           reader_shown(r, group));
    if (!reader_keys(r, group, "triangle", names, found))
        return false;
    for (int k = 0; k < 3; k++)
        if (found[k] != NULL && (!reader_number_within(found[k], 0, 1e6, fields[k]) || dp_triangles_check(t) != DP_OK))
            return reader_fail(r, found[k],
                               "triangle: must have depth from 1 to 1e6, pixels from 1 to 65536 and slim from 2 to "
                               "1024, got %s = %s",
                               names[k], reader_shown(r, found[k]));
    return true;
}

static bool has_raster(const char *name) {
    return raster_find(name) != NULL;
}

static bool read_raster(reader *r, setting *s, need_camera *out) {
    char name[PROFILE_NAME_SIZE];
    if (!reader_row(r, s, "raster", has_raster, out, name))
        return false;
    out->raster = raster_find(name);
    if (out->raster == NULL) {
        for (size_t i = 0; i < raster_table.count; i++)
            reader_known(r, name, raster_get(i)->name);
        return reader_fail(r, s, "raster: must be a rasterizer as 'depthprec list rasterizers' names them, got '%.40s'",
                           name);
    }
    return true;
}

/* Decides by several keys at once: the field of view of a horizontal one, the grid of a rasterizer. */
static bool relate(reader *r, const setting *group, setting *const found[VIEW_COUNT], need_camera *out,
                   dp_triangles *t) {
    const int asked = found[VIEW_SUBPIXEL] != NULL ? t->subpixel : 0;
    camera_fault fault = {.key = NULL};
    if ((found[VIEW_HFOV] != NULL && !camera_vertical(t->fov_y, t->width, t->height, &t->fov_y, &fault)) ||
        (out->raster != NULL && !camera_take_raster(out->raster, asked, t, &fault)))
        return reader_fault(r, group, NULL, &fault);
    return true;
}

/* Triangles must be drawn by a pipeline that interpolates linearly, and judged by its guarantee. */
static bool suits(reader *r, const setting *s, const need_camera *camera, const dp_spec *spec) {
    if (spec->ortho)
        return reader_fail(r, s, "viewport: does not apply to an orthographic camera");
    if (dp_mapping_get(spec->mapping)->curve != DP_CURVE_PERSPECTIVE)
        return reader_fail(r, s, "viewport: needs one of the mappings " DP_MAPPING_NAMES_PERSPECTIVE ", got %s",
                           dp_mapping_get(spec->mapping)->name);
    if (spec->model != DP_MODEL_FLOAT && !camera->automatic)
        return reader_fail(r, s, "viewport: needs the model float or auto, got %s", dp_model_name(spec->model));
    return true;
}

/* The view and the rasterizer that a preset has, where nothing else is said. */
static bool complete(reader *r, setting *const found[VIEW_COUNT], const preset *of, need_camera *out, dp_triangles *t) {
    const bool angle = found[VIEW_FOV] != NULL || found[VIEW_HFOV] != NULL;
    const bool grid = found[VIEW_RASTER] != NULL || found[VIEW_SUBPIXEL] != NULL;
    if (of == NULL && !angle)
        return reader_fail(r, found[VIEW_VIEWPORT], "viewport: needs fov or hfov");
    if (of == NULL && !grid)
        return reader_fail(r, found[VIEW_VIEWPORT], "viewport: needs raster or subpixel");
    if (!angle)
        t->fov_y = preset_fov_y(of, t->width, t->height);
    if (!grid) {
        out->raster = raster_find(of->raster);
        raster_describe(out->raster, t);
    }
    return true;
}

bool reader_view(reader *r, const setting *group, setting *const found[VIEW_COUNT], const preset *of, need_camera *out,
                 dp_spec *spec) {
    static const char *const names[VIEW_COUNT + 1] = {VIEW_KEYS, NULL};
    static bool (*const readers[VIEW_COUNT])(reader *, setting *, dp_triangles *) = {
        [VIEW_VIEWPORT] = read_viewport, [VIEW_FOV] = read_fov,           [VIEW_HFOV] = read_fov,
        [VIEW_SLANT] = read_slant,       [VIEW_SUBPIXEL] = read_subpixel, [VIEW_TRIANGLE] = read_class};
    dp_triangles *t = &spec->triangles;
    for (int k = 0; k < VIEW_COUNT && found[VIEW_VIEWPORT] == NULL; k++)
        if (found[k] != NULL)
            return reader_fail(r, found[k], "%s: needs a viewport: surfaces face the camera", names[k]);
    if (found[VIEW_VIEWPORT] == NULL)
        return true;
    if (found[VIEW_FOV] != NULL && found[VIEW_HFOV] != NULL)
        return reader_fail(r, found[VIEW_HFOV], "hfov: conflicts with fov");
    *t = dp_triangles_default();
    for (int k = 0; k < VIEW_COUNT; k++)
        if (found[k] != NULL && readers[k] != NULL && !readers[k](r, found[k], t))
            return false;
    if (found[VIEW_RASTER] != NULL && !read_raster(r, found[VIEW_RASTER], out))
        return false;
    return relate(r, group, found, out, t) && complete(r, found, of, out, t) &&
           suits(r, found[VIEW_VIEWPORT], out, spec);
}
