/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Packed textures: depths in several channels of 8 bits, and the normals that lie beside them. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/bits.h"
#include "core/elementary.h"
#include "report/message.h"
#include "report/number.h"
#include "texture/cmd_texture/request.h"
#include "texture/cmd_texture/writing.h"
#include "texture/image_depths.h"

int texture_pack_check(const texture_request *o) {
    static const char *const others[] = {"error-map",   "as",    "figure",  "overlay",   "histogram", "pixel",
                                         "at",          "json",  "csv",     "parameter", "type",      "theme",
                                         "figure-size", "title", "picture", "tint",      "range"};
    const char *name = o->image.pack != NULL ? "pack" : "packed-normal";
    image_file file;
    for (size_t i = o->image.pack == NULL && o->image.error_map; i < sizeof others / sizeof others[0]; i++)
        if (option_given(o->line, others[i]) && (!option_is(others[i], "parameter") || o->image.synthetic == NULL))
            return option_error(others[i], "conflicts with --product %s", name);
    if (o->out.file == NULL)
        return usage_error("texture: --product %s needs -o FILE", name);
    if (!image_file_of(o->out.file, &file) || (o->image.pack != NULL && file == IMAGE_PFM))
        return option_error("output", "must end in .png%s or .npy for --product %s, got '%s'",
                            o->image.pack != NULL ? "" : ", .pfm", name, o->out.file);
    if (o->image.error_map && file == IMAGE_PNG)
        return option_error("output", "must end in .pfm or .npy for the bounds of packed normals, got '%s'",
                            o->out.file);
    return EXIT_FINE;
}

/* The normal that a pixel of the image holds, in view space, z along the axis. @return false where it holds none */
static bool held_normal(const texture_source *s, const packing *from, size_t pixel, double depth, uint32_t codes[3],
                        double n[3]) {
    const pack_row *row = packing_normals(from);
    const uint8_t *at = s->unpacked.normals + (size_t)row->channels * pixel;
    double held[3];
    if (packing_cleared(from, at, depth))
        return false;
    for (int k = 0; k < row->channels; k++)
        codes[k] = at[k];
    row->decode(row, codes, held);
    for (int k = 0; k < 3; k++) {
        const double *axis = s->camera.axis[k];
        n[k] = from->world ? axis[0] * held[0] + axis[1] * held[1] + axis[2] * held[2] : k < 2 ? held[k] : -held[k];
    }
    return true;
}

/* A packed texture on its way; rows of depths and of texels. */
typedef struct packing_on {
    writing w;
    const packing *p;
    double *depths;
    uint8_t *texels;
    uint64_t holes, far, lost;
    double worst;        /* of the normals that are lost: how far they come back off, degrees */
    const packing *from; /* whose normals the image has, to be written; else null */
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

/* Holes, whose depth is NaN, and sky have no normal beside the depth. */
static bool is_drawn(const texture_request *o, double depth) {
    return o->image.packing->steps == 0 || o->image.sky < 0 || 1 - depth > o->image.sky;
}

/* Where nothing is drawn lies the far plane. */
static double packed_depth(packing_on *on, double d) {
    const texture_source *s = on->w.source;
    on->holes += isnan(d) ? 1 : 0;
    if (isnan(d))
        return on->p->linear ? 1 : s->setup.ends[1];
    return on->p->linear ? dp_eye(&s->setup, d, 1 - d) / frame_planes(&s->frame)->spec.zfar : d;
}

/* Towards the camera where nothing is drawn, or cleared where there is no depth. What comes back farther off than all
 * that the encoding holds is lost. */
static void pack_normal(packing_on *on, size_t pixel, const float *found, uint8_t *texel) {
    const texture_source *s = on->w.source;
    const pack_row *row = packing_normals(on->p);
    double n[3] = {found[0], found[1], found[2]}, given[3], back[3];
    uint32_t codes[PACK_CHANNELS_MAX];
    if (on->from != NULL ? !held_normal(s, on->from, pixel, on->depths[pixel % s->camera.width], codes, n)
                         : isnan(n[0])) {
        memset(texel, 0, (size_t)row->channels);
        if (on->p->steps > 0)
            packing_normal_texel((const double[]){0, 0, 1}, texel);
        return;
    }
    if (on->p->world)
        camera_turn(&s->camera, n, given);
    else
        memcpy(given, (const double[]){n[0], n[1], -n[2]}, sizeof given);
    if (on->from != on->p)
        row->encode(row, given, codes);
    row->decode(row, codes, back);
    const double off = normal_angle(given, back) / DP_DEGREE;
    on->lost += off > row->normal.max;
    on->worst = fmax(on->worst, off);
    for (int k = 0; k < row->channels; k++)
        texel[k] = (uint8_t)codes[k];
}

static bool take_packed(void *context, uint32_t row, uint32_t count, const float *values) {
    packing_on *on = context;
    const packing *p = on->p;
    const uint32_t width = on->w.source->camera.width;
    for (uint32_t i = 0; i < count; i++) {
        depths_of(on->w.source, row + i, on->w.codes, on->depths);
        for (uint32_t x = 0; x < width; x++) {
            uint8_t *texel = on->texels + (size_t)x * p->channels;
            if (p->encoded != NULL)
                pack_normal(on, (size_t)(row + i) * width + x, values + 3 * ((size_t)i * width + x), texel);
            if (p->steps == 0)
                continue;
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

/* Notes the planes and packing with which a program reads the file back. */
static void note_of_packing(const texture_request *o, const texture_source *s, char note[IMAGE_NOTE_SIZE]) {
    const dp_spec *planes = &frame_planes(&s->frame)->spec;
    snprintf(note, IMAGE_NOTE_SIZE, "product=depth packing=%s near=%s far=%s%s%s%s", o->image.pack->name,
             number_full(planes->znear).text, number_full(planes->zfar).text, o->image.pack->linear ? "" : " mapping=",
             o->image.pack->linear ? "" : dp_mapping_get(planes->mapping)->name,
             planes->ortho && !o->image.pack->linear ? " ortho" : "");
}

int texture_pack_write(const texture_request *o, const texture_source *s) {
    const bool held = o->image.normals_by == NULL && s->unpacked.normals != NULL;
    packing_on on = {.p = o->image.pack, .from = held ? o->image.packing : NULL};
    frame_product product = {.kind = o->image.pack->encoded != NULL ? FRAME_NORMAL : FRAME_EYE,
                             .normal =
                                 o->image.normals_by != NULL ? o->image.normals_by : normal_get(NORMAL_PROJECTIVE)};
    const dp_spec *planes = &frame_planes(&s->frame)->spec;
    char note[IMAGE_NOTE_SIZE];
    if (!camera_is_shared(&s->camera))
        return option_error("product", "pack needs planes that all pixels share, which %s does not have%s",
                            s->camera.radial ? "--radial" : s->matrix.path,
                            s->camera.radial ? "; --product eye writes a file of depths that has them" : "");
    if (!o->image.pack->linear && !texture_is_window(o))
        return option_error("product", "%s holds window depth, which %s is not", o->image.pack->name, s->path);
    if (o->image.pack->linear && o->image.pack->steps > 0 && (isinf(planes->zfar) || planes->znear < 0))
        return option_error("product", "%s holds eye depth over far: it needs %s", o->image.pack->name,
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
    if (good && on.lost > 0 && !o->out.quiet)
        message("depthprec: %s: %llu pixels have normals that %s does not hold: they come back up to %s degrees off",
                o->out.file, (unsigned long long)on.lost, packing_normals(on.p)->name, number_up(on.worst, 4).text);
    return writing_close(&on.w, 1, good);
}

int texture_packed_normal_write(const texture_request *o, const texture_source *s) {
    const uint32_t width = s->camera.width, height = s->camera.height, values = o->image.error_map ? 1 : 3;
    const bool zero = s->unpacked.grain.rounding == GRAIN_ZERO;
    const texture_product p = {
        .made = {.kind = FRAME_NORMAL, .error = o->image.error_map}, .name = "normals, packed", .unit = ""};
    writing w = {.down = o->image.normal_format != 0};
    char note[IMAGE_NOTE_SIZE];
    if (s->unpacked.normals == NULL)
        return option_error("product", "packed-normal needs FILE with --packing depth-normals or camera-normals");
    image_file_of(o->out.file, &w.file);
    const bool png = w.file == IMAGE_PNG;
    w.directions = png;
    int status = writing_open(o, &w, o->out.file, s, png ? IMAGE_U16 : IMAGE_F32, values);
    if (status != EXIT_FINE)
        return status;
    float *row = malloc(values * (size_t)width * sizeof *row);
    double *d = malloc(width * sizeof *d);
    meaning m = writing_meaning(o, &p, &w);
    writing_note(&w, &p, &m, note);
    bool good = writing_begin(&w, note) && row != NULL && d != NULL;
    for (uint32_t i = 0; i < height && good; i++) {
        const uint32_t y = writing_bottom_up(&w) ? height - 1 - i : i;
        depths_of(s, y, NULL, d);
        for (uint32_t x = 0; x < width; x++) {
            uint32_t codes[3];
            double n[3] = {NAN, NAN, NAN};
            const bool drawn =
                is_drawn(o, d[x]) && held_normal(s, o->image.packing, (size_t)y * width + x, d[x], codes, n);
            if (o->image.error_map && drawn)
                n[0] = pack_reach(packing_normals(o->image.packing), codes, zero);
            for (uint32_t k = 0; k < values; k++)
                row[values * (size_t)x + k] = o->image.error_map ? dp_float_up(n[0]) : (float)n[k];
        }
        good = writing_take(&w, y, 1, row);
    }
    free(row);
    free(d);
    status = writing_close(&w, 1, good);
    return status == EXIT_FINE ? writing_say(o, &p, &w, &m) : status;
}
