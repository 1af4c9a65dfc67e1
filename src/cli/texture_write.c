/* SPDX-License-Identifier: GPL-3.0-or-later */
#define _GNU_SOURCE /* fopencookie */

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/progress.h"
#include "cli/texture.h"
#include "report/number.h"

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
    bool levels; /* the error of an effect, and its pixels: all, and those more than one level off */
    uint64_t pixels, beyond;
} writing;

static ssize_t stream_write(void *cookie, const char *bytes, size_t size) {
    output *out = cookie;
    output_bytes(out, bytes, size);
    return output_failed(out) ? 0 : (ssize_t)size; /* what a cookie reports as an error */
}

static int writing_open(const options *o, writing *w, const texture_source *s, image_type type, uint32_t channels) {
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
        w->writer = image_writer_open(w->stream, w->file, type, s->camera.width, s->camera.height, channels);
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
    for (size_t i = 0; i < count * w->row_values && w->levels; i++) {
        w->pixels += isnan(values[i]) ? 0 : 1;
        w->beyond += values[i] > 1 ? 1 : 0;
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
    const bool open = p->made.kind == FRAME_EFFECT && p->made.effect->given && !(p->made.reference > 0);
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
    writing w = {.levels = p->made.kind == FRAME_EFFECT && p->made.error};
    double hi = 0;
    image_file_of(o->output, &w.file);
    const bool png = w.file == IMAGE_PNG;
    int status = writing_open(o, &w, s, png ? IMAGE_U16 : IMAGE_F32, (uint32_t)frame_channels(&p->made));
    if (status != EXIT_FINE)
        return status;
    const bool good = w.writer != NULL && (!png || scale_of(s, p, &w, &hi)) &&
                      frame_run(&s->frame, &p->made, bottom_up(&w), take, &w);
    status = writing_close(&w, good);
    if (status == EXIT_FINE && png && !o->quiet)
        fprintf(stderr, "depthprec: %s: 1 is %s, 65535 is %s%s%s, 0 where there is no %s\n", o->output,
                number_full(w.lo).text, number_full(hi).text, *p->unit != '\0' ? " " : "", p->unit,
                p->made.error ? "bound" : "value");
    if (status == EXIT_FINE && w.levels && w.pixels > 0 && !o->quiet)
        fprintf(stderr, "depthprec: %s: %s %% of the pixels %s off by more than one level\n", o->output,
                number_of(100.0 * (double)w.beyond / (double)w.pixels, 3).text,
                s->path != NULL || (p->made.effect->given && !(p->made.reference > 0)) ? "can be" : "are");
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
    const int status = writing_open(o, &w, s, type, 1);
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
