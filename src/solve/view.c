/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A requirement file's words on the view, and of the triangles in it. */
#include <math.h>
#include <string.h>

#include "solve/reader.h"

/* Two numbers, [A, B], each from `least` to `most`. */
static bool read_pair(reader *r, setting *s, double least, double most, const char *form, double out[2]) {
    bool good = (s->kind == SETTING_ARRAY || s->kind == SETTING_LIST) && s->count == 2;
    for (setting *end = s->first; good && end != NULL; end = end->next)
        good = reader_number_within(end, least, most, out++);
    return good || reader_fail(r, s, "%s: must be %s, got %s", s->name, form, reader_shown(r, s));
}

bool reader_viewport(reader *r, setting *s, camera_said *c) {
    static const char form[] = "[WIDTH, HEIGHT], each a whole number from 1 to 32768 pixels";
    double sides[2];
    if (!read_pair(r, s, 1, CAMERA_SIDE_MOST, form, sides))
        return false;
    if (sides[0] != floor(sides[0]) || sides[1] != floor(sides[1]))
        return reader_fail(r, s, "viewport: must be %s, got %g and %g", form, sides[0], sides[1]);
    c->triangles.width = (int)sides[0];
    c->triangles.height = (int)sides[1];
    return true;
}

bool reader_slant(reader *r, setting *s, camera_said *c) {
    static const char form[] = "[LO, HI], from 0 to 90 degrees";
    double ends[2];
    if (!read_pair(r, s, 0, 90, form, ends))
        return false;
    if (ends[0] > ends[1])
        return reader_fail(r, s, "slant: must be %s, got %g and %g", form, ends[0], ends[1]);
    c->triangles.slant_lo = ends[0];
    c->triangles.slant_hi = ends[1];
    return true;
}

bool reader_depth_range(reader *r, setting *s, camera_said *c) {
    static const char form[] = "(LO, HI), two window depths from 0 to 1";
    return read_pair(r, s, 0, 1, form, c->depth_range) &&
           (c->depth_range[0] != c->depth_range[1] ||
            reader_fail(r, s, "depth_range: must be %s, got %g twice", form, c->depth_range[0]));
}

/* Degrees, as the options take them. */
bool reader_angle(reader *r, setting *s, camera_said *c) {
    return reader_number_within(s, CAMERA_FOV_LEAST, CAMERA_FOV_MOST,
                                strcmp(s->name, "hfov") == 0 ? &c->fov_x : &c->triangles.fov_y) ||
           reader_fail(r, s, "%s: must be a number from %g to %g degrees, got %s", s->name, CAMERA_FOV_LEAST,
                       CAMERA_FOV_MOST, reader_shown(r, s));
}

bool reader_subpixel(reader *r, setting *s, camera_said *c) {
    double bits;
    if (!reader_number_within(s, 1, CAMERA_SUBPIXEL_MOST, &bits) || bits != floor(bits))
        return reader_fail(r, s, "subpixel: must be a whole number from 1 to %d bits, got %s", CAMERA_SUBPIXEL_MOST,
                           reader_shown(r, s));
    c->triangles.subpixel = (int)bits;
    return true;
}

bool reader_class(reader *r, setting *group, camera_said *c) {
    dp_triangles *t = &c->triangles;
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
