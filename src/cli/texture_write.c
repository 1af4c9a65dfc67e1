/* SPDX-License-Identifier: GPL-3.0-or-later */
#define _GNU_SOURCE /* fopencookie */

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/progress.h"
#include "cli/texture.h"
#include "report/number.h"
#include "texture/image_depths.h"

enum { GREYS = 65535, STREAM_BUFFER = 1 << 16 };

/* An image on its way into an output, under whose name it appears when it is complete. */
typedef struct writing {
    output out;
    FILE *stream;
    image_writer *writer;
    image_file file;
    size_t row_values;
    const texture_source *source;
    void *row;        /* room for a row of the file's samples */
    double lo, scale; /* of the 16 bits of a PNG */
    bool upwards;     /* an error must not come back smaller, */
    double more;      /* and has to hold for the product in 16 bits, which is rounded, too */
    image_type type;  /* depth images: */
    uint32_t *codes;
    progress bar;
    uint64_t done;
} writing;

static ssize_t stream_write(void *cookie, const char *bytes, size_t size) {
    output *out = cookie;
    output_bytes(out, bytes, size);
    return output_failed(out) ? 0 : (ssize_t)size; /* what a cookie reports as an error */
}

static int writing_open(const options *o, writing *w, const texture_source *s, image_type type, uint32_t channels,
                        const char *note) {
    int status = options_open(o, &w->out);
    if (status != EXIT_FINE)
        return status;
    w->source = s;
    w->type = type;
    w->row_values = (size_t)s->camera.width * channels;
    w->row = malloc(w->row_values * image_type_size(type));
    w->codes = malloc(s->camera.width * sizeof *w->codes);
    w->stream = fopencookie(&w->out, "w", (cookie_io_functions_t){.write = stream_write});
    if (w->row != NULL && w->codes != NULL && w->stream != NULL) {
        setvbuf(w->stream, NULL, _IOFBF, STREAM_BUFFER);
        w->writer = image_writer_open(w->stream, w->file, type, s->camera.width, s->camera.height, channels, note);
    }
    w->bar = progress_start("rows", s->camera.height, o->quiet);
    return EXIT_FINE;
}

/* A file appears only when all of it is there. */
static int writing_close(writing *w, bool good) {
    progress_end(&w->bar);
    if (w->writer != NULL && !image_writer_close(w->writer))
        good = false;
    if (w->stream != NULL && fclose(w->stream) != 0)
        good = false;
    free(w->row);
    free(w->codes);
    if (good || output_failed(&w->out))
        return output_close(&w->out); /* which says what failed */
    output_abandon(&w->out);
    return usage_error("texture: no memory");
}

static bool bottom_up(const writing *w) {
    return w->writer != NULL && image_writer_bottom_up(w->writer);
}

/* 0 is kept for pixels that have no value, and for errors without a bound. */
static void to_greys(const writing *w, const float *values) {
    uint16_t *out = w->row;
    for (size_t i = 0; i < w->row_values; i++) {
        const double share = fmin(fmax(((double)values[i] + w->more - w->lo) * w->scale, 0), 1) * (GREYS - 1);
        const double grey = w->upwards ? fmin(ceil(share * (1 + 0x1p-48)), GREYS - 1) : rint(share);
        out[i] = !isfinite(values[i]) ? 0 : (uint16_t)(1 + grey);
    }
}

static bool take(void *context, uint32_t row, uint32_t count, const float *values) {
    writing *w = context;
    (void)row;
    for (uint32_t i = 0; i < count; i++) {
        const float *one = values + (bottom_up(w) ? count - 1 - i : i) * w->row_values;
        if (w->type == IMAGE_U16)
            to_greys(w, one);
        if (!image_writer_rows(w->writer, w->type == IMAGE_U16 ? w->row : one, 1))
            return false;
    }
    progress_step(&w->bar, w->done += count);
    return true;
}

/*
 * The product in 16 bits is off by half a grey more; a place in all three coordinates, and a normal by the angle that
 * three such differences of a unit vector can make.
 */
static bool rounding_of_product(const texture_source *s, const texture_product *p, double *more) {
    static const double factors[FRAME_KINDS] = {[FRAME_EYE] = 1,
                                                [FRAME_POSITION] = 1.7320508075688774,
                                                [FRAME_NORMAL] = 1.74 * 57.29577951308233,
                                                [FRAME_EFFECT] = 255};
    frame_product plain = p->made;
    frame_summary sum = {.lo = -1, .hi = 1, .count = 1};
    plain.error = false;
    /* Without what it compares with an effect has no product yet; it will be from 0 to 1. */
    const bool open = p->made.kind == FRAME_EFFECT && p->made.effect->reference != NULL;
    *more = 0;
    if (open)
        sum.lo = 0;
    else if (p->made.kind != FRAME_NORMAL && !frame_summarise(&s->frame, &plain, &sum))
        return false;
    if (sum.count > 0)
        *more = factors[p->made.kind] * (sum.hi - sum.lo) / (2.0 * (GREYS - 1)) * (1 + 0x1p-20);
    return true;
}

/* What the samples of a PNG mean; normals have their range by nature, all else that of what was found. */
static bool scale_of(const texture_source *s, const texture_product *p, writing *w, double *hi) {
    frame_summary sum = {.lo = -1, .hi = 1, .count = 1};
    if ((p->made.kind != FRAME_NORMAL || p->made.error) && !frame_summarise(&s->frame, &p->made, &sum))
        return false;
    w->upwards = p->made.error;
    if (p->made.error && !rounding_of_product(s, p, &w->more))
        return false;
    w->lo = sum.count == 0 ? 0 : p->made.error ? 0 : sum.lo;
    *hi = (sum.count == 0 ? 1 : sum.hi) + w->more;
    w->scale = *hi > w->lo ? 1 / (*hi - w->lo) : 0;
    return true;
}

int texture_product_write(const options *o, const texture_source *s, const texture_product *p) {
    writing w = {0};
    double hi = 0;
    image_file_of(o->output, &w.file);
    const bool png = w.file == IMAGE_PNG;
    int status = writing_open(o, &w, s, png ? IMAGE_U16 : IMAGE_F32, (uint32_t)frame_channels(&p->made), NULL);
    if (status != EXIT_FINE)
        return status;
    const bool good = w.writer != NULL && (!png || scale_of(s, p, &w, &hi)) &&
                      frame_run(&s->frame, &p->made, bottom_up(&w), take, &w);
    status = writing_close(&w, good);
    if (status == EXIT_FINE && png && !o->quiet)
        fprintf(stderr, "depthprec: %s: 1 is %s, 65535 is %s%s%s, 0 where there is no %s\n", o->output,
                number_full(w.lo).text, number_full(hi).text, *p->unit != '\0' ? " " : "", p->unit,
                p->made.error ? "bound" : "value");
    return status;
}

/* The samples that hold a format without loss, the first that the kind of file has. */
static bool depth_type(const dp_format *format, image_file file, image_type *out) {
    const bool unorm = format->kind == DP_FORMAT_UNORM;
    const bool half = strcmp(format->name, "fp16") == 0, single = strcmp(format->name, "fp32") == 0;
    *out = half                                         ? IMAGE_F16
           : single                                     ? IMAGE_F32
           : unorm && format->bits == 16                ? IMAGE_U16
           : unorm && format->bits == 8                 ? IMAGE_U8
           : unorm                                      ? IMAGE_U32
           : format->bias + format->mantissa_bits > 150 ? IMAGE_F64 /* below the least binary32 number */
                                                        : IMAGE_F32;
    if (file == IMAGE_PFM && (half || (unorm && format->bits <= 24)))
        *out = IMAGE_F32; /* fractions of up to 24 bits are told apart in binary32 */
    return image_holds(file, *out, 1);
}

static void depth_row(const writing *w, uint32_t row) {
    const dp_format *format = &w->source->setup.spec.format;
    frame_codes(&w->source->frame, row, w->codes);
    const bool values = w->type == IMAGE_F32;
    for (size_t i = 0; i < w->row_values; i++)
        if (values)
            ((float *)w->row)[i] = (float)dp_format_value(format, w->codes[i]);
        else if (w->type == IMAGE_F64)
            ((double *)w->row)[i] = dp_format_value(format, w->codes[i]);
        else if (w->type == IMAGE_U32)
            ((uint32_t *)w->row)[i] = w->codes[i];
        else if (w->type == IMAGE_U8)
            ((uint8_t *)w->row)[i] = (uint8_t)w->codes[i];
        else
            ((uint16_t *)w->row)[i] = (uint16_t)w->codes[i]; /* of fp16 the code is the bits */
}

int texture_depth_write(const options *o, const texture_source *s) {
    image_type type;
    writing w = {0};
    if (!image_file_of(o->output, &w.file))
        return option_error(OPTION_OUTPUT,
                            "must end in .png, .pfm or .npy for the scene's depths, got '%s'; --json or --csv writes "
                            "statistics",
                            o->output);
    if (!depth_type(&s->setup.spec.format, w.file, &type))
        return option_error(OPTION_OUTPUT, "%s does not hold %s: .npy does, got '%s'", image_file_name(w.file),
                            s->setup.spec.format.name, o->output);
    const int status = writing_open(o, &w, s, type, 1, NULL);
    if (status != EXIT_FINE)
        return status;
    bool good = w.writer != NULL;
    for (uint32_t i = 0; i < s->camera.height && good; i++) {
        depth_row(&w, bottom_up(&w) ? s->camera.height - 1 - i : i);
        good = image_writer_rows(w.writer, w.row, 1);
        progress_step(&w.bar, i + 1);
    }
    return writing_close(&w, good);
}

/* ---- Packed textures --------------------------------------------------------------------------------------------- */

int texture_pack_check(const options *o) {
    static const option_id others[] = {OPTION_EYE,       OPTION_RADIAL, OPTION_POSITION,  OPTION_EFFECT,
                                       OPTION_ERROR_MAP, OPTION_FIGURE, OPTION_PIXEL,     OPTION_AT,
                                       OPTION_JSON,      OPTION_CSV,    OPTION_PARAMETER, OPTION_TYPE,
                                       OPTION_THEME,     OPTION_WIDTH,  OPTION_HEIGHT,    OPTION_TITLE};
    const char *name = option_name(o->pack != NULL ? OPTION_PACK : OPTION_PACKED_NORMAL);
    image_file file;
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++)
        if (option_given(o, others[i]) && (others[i] != OPTION_PARAMETER || o->scene == NULL))
            return option_error(others[i], "has no meaning with --%s", name);
    if (o->pack != NULL && o->packed_normal)
        return option_error(OPTION_PACKED_NORMAL, "must not be given together with --pack");
    if (o->normal != NULL && (o->pack == NULL || !o->pack->normals))
        return option_error(OPTION_NORMAL, "has no meaning with --%s%s%s", name, o->pack != NULL ? " " : "",
                            o->pack != NULL ? o->pack->name : "");
    if (o->output == NULL)
        return usage_error("texture: --%s needs -o FILE", name);
    if (!image_file_of(o->output, &file) || (o->pack != NULL && file == IMAGE_PFM))
        return option_error(OPTION_OUTPUT, "must end in .png%s or .npy for --%s, got '%s'",
                            o->pack != NULL ? "" : ", .pfm", name, o->output);
    return EXIT_FINE;
}

/* A packed texture on its way; rows of depths and of texels. */
typedef struct packing_on {
    writing w;
    const packing *p;
    double *depths;
    uint8_t *texels;
    uint64_t holes;
    bool kept; /* the normals that the image has */
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
            const float *n = values + 3 * ((size_t)i * width + x);
            if (p->normals && on->w.source->unpacked.normals != NULL && on->kept) {
                memcpy(texel, on->w.source->unpacked.normals + 2 * ((size_t)(row + i) * width + x), 2);
            } else if (p->normals) {
                const bool drawn = !isnan(n[0]);
                packing_normal_texel(drawn ? (const double[]){n[0], n[1], -n[2]} : (const double[]){0, 0, 1}, texel);
            }
            packing_texel(p, packing_nearest(p, packed_depth(on, on->depths[x])), texel);
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
    snprintf(note, IMAGE_NOTE_SIZE, "product=depth packing=%s near=%s far=%s%s%s%s", o->pack->name,
             number_full(planes->znear).text, number_full(planes->zfar).text,
             o->pack->linear ? "" : " mapping=", o->pack->linear ? "" : dp_mapping_get(planes->mapping)->name,
             planes->ortho && !o->pack->linear ? " ortho" : "");
}

int texture_pack_write(const options *o, const texture_source *s) {
    packing_on on = {.p = o->pack, .kept = o->normal == NULL};
    frame_product product = {.kind = o->pack->normals ? FRAME_NORMAL : FRAME_EYE,
                             .normal = o->normal != NULL ? o->normal : normal_get(NORMAL_PROJECTIVE)};
    char note[IMAGE_NOTE_SIZE];
    if (!o->pack->linear && !texture_is_window(o))
        return option_error(OPTION_PACK, "%s holds window depth, which %s is not", o->pack->name, s->path);
    if (o->pack->linear && isinf(frame_planes(&s->frame)->spec.zfar))
        return option_error(OPTION_PACK, "%s holds eye depth over far: it needs a finite far plane", o->pack->name);
    note_of_packing(o, s, note);
    image_file_of(o->output, &on.w.file);
    const int status = writing_open(o, &on.w, s, IMAGE_U8, o->pack->channels, note);
    if (status != EXIT_FINE)
        return status;
    on.depths = malloc(s->camera.width * sizeof *on.depths);
    on.texels = malloc((size_t)s->camera.width * o->pack->channels);
    const bool good = on.w.writer != NULL && on.depths != NULL && on.texels != NULL &&
                      frame_run(&s->frame, &product, false, take_packed, &on);
    free(on.depths);
    free(on.texels);
    if (good && on.holes > 0 && !o->quiet)
        fprintf(stderr, "depthprec: %s: %llu pixels hold no depth and are written as the far plane\n", o->output,
                (unsigned long long)on.holes);
    return writing_close(&on.w, good);
}

int texture_packed_normal_write(const options *o, const texture_source *s) {
    const uint32_t width = s->camera.width, height = s->camera.height;
    writing w = {0};
    if (s->unpacked.normals == NULL)
        return option_error(OPTION_PACKED_NORMAL, "needs FILE with --packing depth-normals");
    image_file_of(o->output, &w.file);
    const bool png = w.file == IMAGE_PNG;
    if (png)
        w.lo = -1, w.scale = 0.5;
    const int status = writing_open(o, &w, s, png ? IMAGE_U16 : IMAGE_F32, 3, NULL);
    if (status != EXIT_FINE)
        return status;
    float *row = malloc(3 * (size_t)width * sizeof *row);
    bool good = w.writer != NULL && row != NULL;
    for (uint32_t i = 0; i < height && good; i++) {
        const uint32_t y = bottom_up(&w) ? height - 1 - i : i;
        for (uint32_t x = 0; x < width; x++) {
            double n[3];
            packing_normal(s->unpacked.normals + 2 * ((size_t)y * width + x), n);
            for (int k = 0; k < 3; k++)
                row[3 * (size_t)x + (size_t)k] =
                    (float)(k == 2 ? -n[k] : n[k]); /* away from the camera, as view space has it */
        }
        good = take(&w, y, 1, row);
    }
    free(row);
    return writing_close(&w, good);
}
