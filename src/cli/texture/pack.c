/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Packed textures: depths in several channels of 8 bits, and the normals that lie beside them. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/texture/writing.h"
#include "frame/image_depths.h"
#include "report/message.h"
#include "report/number.h"

int texture_pack_check(const options *o) {
    static const option_id others[] = {OPTION_AS,          OPTION_ERROR_MAP, OPTION_FIGURE, OPTION_OVERLAY,
                                       OPTION_HISTOGRAM,   OPTION_PIXEL,     OPTION_AT,     OPTION_JSON,
                                       OPTION_CSV,         OPTION_PARAMETER, OPTION_TYPE,   OPTION_THEME,
                                       OPTION_FIGURE_SIZE, OPTION_TITLE};
    const char *name = o->image.pack != NULL ? "pack" : "packed-normal";
    image_file file;
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++)
        if (option_given(o, others[i]) && (others[i] != OPTION_PARAMETER || o->image.synthetic == NULL))
            return option_error(others[i], "conflicts with --product %s", name);
    if (o->out.file == NULL)
        return usage_error("texture: --product %s needs -o FILE", name);
    if (!image_file_of(o->out.file, &file) || (o->image.pack != NULL && file == IMAGE_PFM))
        return option_error(OPTION_OUTPUT, "must end in .png%s or .npy for --product %s, got '%s'",
                            o->image.pack != NULL ? "" : ", .pfm", name, o->out.file);
    return EXIT_FINE;
}

/* A packed texture on its way; rows of depths and of texels. */
typedef struct packing_on {
    writing w;
    const packing *p;
    double *depths;
    uint8_t *texels;
    uint64_t holes, far;
    const uint8_t *normals; /* those that the image has, to be written as they are; else null */
} packing_on;

static void depths_of(const texture_source *s, uint32_t row, uint32_t *codes, double *d) {
    const dp_format *format = &s->setup.spec.format;
    if (s->path != NULL) {
        image_depths(&s->picture, format, row, 0, s->camera.width, d);
        return;
    }
    frame_codes(&s->frame, row, codes);
    for (uint32_t x = 0; x < s->camera.width; x++)
        d[x] = codes[x] == UINT32_MAX ? (double)NAN : dp_format_value(format, codes[x]);
}

/* Where nothing is drawn lies the far plane. */
static double packed_depth(packing_on *on, double d) {
    const texture_source *s = on->w.source;
    on->holes += isnan(d) ? 1 : 0;
    if (isnan(d))
        return on->p->linear || !s->setup.reversed ? 1 : 0;
    return on->p->linear ? dp_eye(&s->setup, d, 1 - d) / frame_planes(&s->frame)->spec.zfar : d;
}

static bool take_packed(void *context, uint32_t row, uint32_t count, const float *values) {
    packing_on *on = context;
    const packing *p = on->p;
    const uint32_t width = on->w.source->camera.width;
    for (uint32_t i = 0; i < count; i++) {
        depths_of(on->w.source, row + i, on->w.codes, on->depths);
        for (uint32_t x = 0; x < width; x++) {
            uint8_t *texel = on->texels + (size_t)x * p->channels;
            if (p->normals && on->normals != NULL) {
                memcpy(texel, on->normals + 2 * ((size_t)(row + i) * width + x), 2);
            } else if (p->normals) {
                const float *n = values + 3 * ((size_t)i * width + x);
                const bool drawn = !isnan(n[0]);
                packing_normal_texel(drawn ? (const double[]){n[0], n[1], -n[2]} : (const double[]){0, 0, 1}, texel);
            }
            const double depth = packed_depth(on, on->depths[x]);
            on->far += depth == 1;
            packing_texel(p, packing_nearest(p, depth), texel);
        }
        if (!image_writer_rows(on->w.writer, on->texels, 1))
            return false;
    }
    progress_step(&on->w.bar, on->w.done += count);
    return true;
}

/* What reading it back takes. */
static void note_of_packing(const options *o, const texture_source *s, char note[IMAGE_NOTE_SIZE]) {
    const dp_spec *planes = &frame_planes(&s->frame)->spec;
    snprintf(note, IMAGE_NOTE_SIZE, "product=depth packing=%s near=%s far=%s%s%s%s", o->image.pack->name,
             number_full(planes->znear).text, number_full(planes->zfar).text, o->image.pack->linear ? "" : " mapping=",
             o->image.pack->linear ? "" : dp_mapping_get(planes->mapping)->name,
             planes->ortho && !o->image.pack->linear ? " ortho" : "");
}

int texture_pack_write(const options *o, const texture_source *s) {
    packing_on on = {.p = o->image.pack, .normals = o->image.normals_by == NULL ? s->unpacked.normals : NULL};
    frame_product product = {.kind = o->image.pack->normals ? FRAME_NORMAL : FRAME_EYE,
                             .normal =
                                 o->image.normals_by != NULL ? o->image.normals_by : normal_get(NORMAL_PROJECTIVE)};
    const dp_spec *planes = &frame_planes(&s->frame)->spec;
    char note[IMAGE_NOTE_SIZE];
    if (!camera_is_shared(&s->camera))
        return option_error(OPTION_PRODUCT, "pack needs planes that all pixels share, which %s does not have%s",
                            s->camera.radial ? "--radial" : s->matrix.path,
                            s->camera.radial ? "; --product eye writes a file of depths that has them" : "");
    if (!o->image.pack->linear && !texture_is_window(o))
        return option_error(OPTION_PRODUCT, "%s holds window depth, which %s is not", o->image.pack->name, s->path);
    if (o->image.pack->linear && (isinf(planes->zfar) || planes->znear < 0))
        return option_error(OPTION_PRODUCT, "%s holds eye depth over far: it needs %s", o->image.pack->name,
                            planes->znear < 0 ? "near not less than 0" : "a finite far plane");
    note_of_packing(o, s, note);
    image_file_of(o->out.file, &on.w.file);
    const int status = writing_open(o, &on.w, o->out.file, s, IMAGE_U8, o->image.pack->channels);
    if (status != EXIT_FINE)
        return status;
    on.depths = malloc(s->camera.width * sizeof *on.depths);
    on.texels = malloc((size_t)s->camera.width * o->image.pack->channels);
    const bool good = writing_begin(&on.w, note) && on.depths != NULL && on.texels != NULL &&
                      frame_run(&s->frame, &product, false, take_packed, &on);
    free(on.depths);
    free(on.texels);
    if (good && on.holes > 0 && !o->out.quiet)
        message("depthprec: %s: %llu pixels hold no depth and are written as the far plane", o->out.file,
                (unsigned long long)on.holes);
    if (good && on.p->wraps && on.far > 0 && !o->out.quiet)
        message("depthprec: %s: %llu pixels at the far plane are written as 255, 0, which shaders read as 1; "
                "EncodeFloatRG writes 0, 0, which they read as 0, the camera",
                o->out.file, (unsigned long long)on.far);
    return writing_close(&on.w, 1, good);
}

int texture_packed_normal_write(const options *o, const texture_source *s) {
    const uint32_t width = s->camera.width, height = s->camera.height;
    const texture_product p = {.made = {.kind = FRAME_NORMAL}, .name = "normals, packed", .unit = ""};
    writing w = {.down = o->image.normal_format != 0};
    char note[IMAGE_NOTE_SIZE];
    if (s->unpacked.normals == NULL)
        return option_error(OPTION_PRODUCT, "packed-normal needs FILE with --packing depth-normals");
    image_file_of(o->out.file, &w.file);
    const bool png = w.file == IMAGE_PNG;
    w.directions = png;
    int status = writing_open(o, &w, o->out.file, s, png ? IMAGE_U16 : IMAGE_F32, 3);
    if (status != EXIT_FINE)
        return status;
    float *row = malloc(3 * (size_t)width * sizeof *row);
    meaning m = writing_meaning(o, &p, &w);
    writing_note(&w, &p, &m, note);
    bool good = writing_begin(&w, note) && row != NULL;
    for (uint32_t i = 0; i < height && good; i++) {
        const uint32_t y = writing_bottom_up(&w) ? height - 1 - i : i;
        for (uint32_t x = 0; x < width; x++) {
            double n[3];
            packing_normal(s->unpacked.normals + 2 * ((size_t)y * width + x), n);
            for (int k = 0; k < 3; k++)
                row[3 * (size_t)x + (size_t)k] =
                    (float)(k == 2 ? -n[k] : n[k]); /* away from the camera, as view space has it */
        }
        good = writing_take(&w, y, 1, row);
    }
    free(row);
    status = writing_close(&w, 1, good);
    return status == EXIT_FINE ? writing_say(o, &p, &w, &m) : status;
}
