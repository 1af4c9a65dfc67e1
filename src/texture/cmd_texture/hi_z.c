/* SPDX-License-Identifier: GPL-3.0-or-later */
/* --hi-z: a level of the conservative pyramid of an image's depths. */
#include <math.h>
#include <stdlib.h>

#include "report/message.h"
#include "report/number.h"
#include "texture/cmd_texture/request.h"
#include "texture/cmd_texture/texture.h"
#include "texture/pyramid.h"

int texture_hi_z_check(const texture_request *o) {
    return o->out.file != NULL ? EXIT_FINE : option_error("hi-z", "needs -o FILE");
}

/* A level in words for JSON and messages. */
typedef struct hi_z {
    pyramid p;
    const char *file, *depth, *operation, *mapping;
} hi_z;

static const column columns[] = {{FIELD(hi_z, file, "file", "")},
                                 {FIELD(hi_z, p.level, "level", "")},
                                 {FIELD(hi_z, p.levels, "levels", "")},
                                 {FIELD(hi_z, p.width, "width", "")},
                                 {FIELD(hi_z, p.height, "height", "")},
                                 {FIELD(hi_z, depth, "depth", "")},
                                 {FIELD(hi_z, operation, "operation", "")},
                                 {FIELD(hi_z, p.format.name, "format", "")},
                                 {FIELD(hi_z, mapping, "mapping", "")},
                                 {FIELD(hi_z, p.holes, "holes", "")},
                                 {FIELD(hi_z, p.codes_off, "codes_off", "")},
                                 {FIELD(hi_z, p.off, "off", "scene")},
                                 {FIELD(hi_z, p.off_z, "off_z", "scene")},
                                 {.kind = COLUMN_END}};

static int say(const texture_request *o, const texture_source *s, hi_z *h) {
    const pyramid *p = &h->p;
    output out;
    if (o->out.form == FORM_JSON) {
        const int status = output_open(&out, NULL);
        if (status != EXIT_FINE)
            return status;
        report_write(&(report_spec){"texture", columns, h, .label = 14}, &out, FORM_JSON);
        return output_close(&out);
    }
    if (o->out.quiet)
        return EXIT_FINE;
    message("depthprec: %s: level %u of %u, %u x %u texels, each the %s of the window depths below it: the %s", h->file,
            p->level, p->levels, p->width, p->height, h->operation, h->depth);
    if (p->holes > 0)
        message("depthprec: %s: %llu pixels hold no depth and count as the %s plane", h->file,
                (unsigned long long)p->holes, p->nearest ? "near" : "far");
    if (p->off > 0)
        message("depthprec: %s: rounding to %s makes them up to %s scene units %s, from z = %s, %llu codes of %s",
                h->file, p->format.name, number_up(p->off, 4).text, p->nearest ? "nearer" : "farther",
                number_of(p->off_z, 6).text, (unsigned long long)p->codes_off, s->setup.spec.format.name);
    return EXIT_FINE;
}

int texture_hi_z_write(const texture_request *o, texture_source *s) {
    const bool largest = s->setup.reversed == o->image.hi_z_nearest;
    hi_z h = {.p = {.level = o->image.hi_z,
                    .nearest = o->image.hi_z_nearest,
                    .format = o->image.hi_z_format.bits > 0 ? o->image.hi_z_format : s->setup.spec.format},
              .file = o->out.file,
              .depth = o->image.hi_z_nearest ? "nearest" : "farthest",
              .operation = largest ? "maximum" : "minimum",
              .mapping = dp_mapping_get(s->setup.spec.mapping)->name};
    const uint32_t levels = pyramid_levels(s->camera.width, s->camera.height);
    if (!camera_is_shared(&s->camera))
        return option_error("hi-z", "needs planes that all pixels share, which %s does not have", s->matrix.path);
    if (h.p.level > levels)
        return option_error("hi-z", "must be at most level %u in an image of %u x %u, got %u", levels, s->camera.width,
                            s->camera.height, h.p.level);
    if (!pyramid_make(&s->frame, &h.p))
        return usage_error("texture: no memory for the pyramid");
    s->camera.width = h.p.width; /* of what is written */
    s->camera.height = h.p.height;
    int status = texture_depth_write(o, s, &h.p.format, h.p.codes);
    free(h.p.codes);
    return status == EXIT_FINE ? say(o, s, &h) : status;
}
