/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/append.h"
#include "core/elementary.h"
#include "core/outward.h"
#include "report/message.h"
#include "report/number.h"
#include "report/report.h"
#include "texture/cmd_texture/request.h"
#include "texture/cmd_texture/writing.h"

enum { STREAM_BUFFER = 1 << 16 };

int writing_open(const texture_request *o, writing *w, const char *path, const texture_source *s, image_type type,
                 uint32_t channels) {
    int status = output_open(&w->out, path);
    if (status != EXIT_FINE)
        return status;
    w->source = s;
    w->type = type;
    w->row_values = w->made_values = (size_t)s->camera.width * channels;
    w->row = malloc(w->row_values * image_type_size(type));
    w->codes = malloc(s->camera.width * sizeof *w->codes);
    w->stream = output_stream(&w->out);
    w->channels = channels;
    w->bar = progress_start("rows", s->camera.height, o->out.quiet || path == o->image.error_file); /* one bar */
    return EXIT_FINE;
}

bool writing_begin(writing *w, const char *note) {
    if (w->row == NULL || w->codes == NULL || w->stream == NULL)
        return false;
    setvbuf(w->stream, NULL, _IOFBF, STREAM_BUFFER);
    w->writer = image_writer_open(w->stream, w->file, w->type, w->source->camera.width, w->source->camera.height,
                                  w->channels, note);
    return w->writer != NULL;
}

/* Whether all of it could be given to the output. */
static bool writing_end(writing *w, bool good) {
    progress_end(&w->bar);
    if (w->writer != NULL && !image_writer_close(w->writer))
        good = false;
    if (w->stream != NULL && !output_stream_close(&w->out, w->stream))
        good = false;
    free(w->row);
    free(w->codes);
    return good;
}

int writing_close(writing *w, int count, bool good) {
    int status = EXIT_FINE;
    bool said = false;
    for (int i = 0; i < count; i++)
        good = writing_end(&w[i], good);
    for (int i = 0; i < count; i++) {
        const bool failed = output_failed(&w[i].out);
        if (!good && !failed)
            output_abandon(&w[i].out);
        else if (output_close(&w[i].out) != EXIT_FINE) /* which says what failed */
            status = EXIT_IO;
        said = said || failed;
    }
    return good || said ? status : usage_error("texture: no memory");
}

bool writing_bottom_up(const writing *w) {
    return w->writer != NULL && image_writer_bottom_up(w->writer);
}

/* 0.5 n + 0.5 with x to the right, y up or down, and z towards the camera, which view space has the other way. */
static void to_colours(const writing *w, const float *values) {
    const double signs[3] = {1, w->down ? -1 : 1, -1};
    uint16_t *out = w->row;
    for (size_t i = 0; i < w->row_values; i++) {
        const double share = 0.5 * signs[i % 3] * (double)values[i] + 0.5;
        out[i] = isnan(values[i]) ? 0 : (uint16_t)rint(fmin(fmax(share, 0), 1) * GREYS);
    }
}

/* 0 is kept for pixels that have no value, and for errors without a bound. */
static void to_greys(const writing *w, const float *values) {
    uint16_t *out = w->row;
    for (size_t i = 0; i < w->row_values; i++) {
        const double share = fmin(fmax(((double)values[i] + w->more - w->lo) * w->scale, 0), 1) * (GREYS - 1);
        const double grey = w->upwards ? fmin(ceil(share * (1 + DP_ROUNDINGS_30)), GREYS - 1) : rint(share);
        out[i] = !isfinite(values[i]) ? 0 : (uint16_t)(1 + grey);
    }
}

bool writing_take(void *context, uint32_t row, uint32_t count, const float *values) {
    writing *w = context;
    const bool drawn = w->on.picture != NULL;
    for (uint32_t i = 0; i < count; i++) {
        const float *one = values + (writing_bottom_up(w) ? count - 1 - i : i) * w->made_values;
        if (drawn)
            compose_row(&w->on, row + i, one, w->row);
        else if (w->directions)
            to_colours(w, one);
        else if (w->type == IMAGE_U16)
            to_greys(w, one);
        if (!image_writer_rows(w->writer, drawn || w->type == IMAGE_U16 ? w->row : one, 1)) {
            w->out.error = ferror(w->stream) != 0 ? errno : w->out.error;
            return false;
        }
    }
    for (size_t i = 0; i < count * w->row_values && w->levels; i++) {
        w->pixels += isnan(values[i]) ? 0 : 1;
        w->beyond += values[i] > 1 ? 1 : 0;
    }
    progress_step(&w->bar, w->done += count);
    return true;
}

/* Eye depth is a multiple of its unit, as sensors and simulators write it; what is nearer than that becomes 1. */
static bool in_units(const frame_product *made, const frame_summary *sum) {
    return made->kind == FRAME_EYE && !made->error && !made->radial && sum->count > 0 && sum->lo > 0;
}

double writing_step(const frame_product *made) {
    const bool even = made->as != NULL && made->as->row->levels == GRAIN_EVEN && !made->error;
    return even && fabs(made->as->offset) < made->as->step / GREYS ? made->as->step : 0;
}

/* The range that a PNG spreads over its samples: of an effect that asked for or of a colour; else that found. */
static bool range_of(const texture_request *o, const texture_source *s, const frame_product *made, frame_summary *sum) {
    const bool asked = option_given(o->line, "range"), wide = made->kind == FRAME_NORMAL || made->vector;
    *sum = (frame_summary){.lo = asked  ? o->camera.range_lo
                                 : wide ? -1
                                        : 0,
                           .hi = asked ? o->camera.range_hi : 1,
                           .count = 1};
    return !made->error && made->kind >= FRAME_NORMAL ? true : frame_summarise(&s->frame, made, sum);
}

/*
 * The product in 16 bits is off by half a grey more; a place in all three coordinates, and a normal by the angle that
 * three such differences of a unit vector can make.
 */
static bool rounding_of_product(const texture_request *o, const texture_source *s, const frame_product *made,
                                double *more) {
    static const double factors[FRAME_KINDS] = {[FRAME_EYE] = 1,
                                                [FRAME_LINEAR01] = 1,
                                                [FRAME_RAW] = 1,
                                                [FRAME_POSITION] = 1.7320508075688774,
                                                [FRAME_NORMAL] = 1.74 / DP_DEGREE,
                                                [FRAME_EFFECT] = 255};
    frame_product plain = *made;
    frame_summary sum;
    plain.error = false;
    *more = 0;
    if (!range_of(o, s, &plain, &sum))
        return false;
    const double step = writing_step(&plain);
    const double unit = step > 0 ? step : in_units(&plain, &sum) ? sum.hi / GREYS : (sum.hi - sum.lo) / (GREYS - 1);
    if (sum.count > 0)
        *more = factors[made->kind] * (made->vector ? M_SQRT2 : 1) * unit / 2 * (1 + 0x1p-20);
    if (in_units(&plain, &sum))
        *more = fmax(*more, (unit - sum.lo) * (1 + 0x1p-20));
    return true;
}

/* Chooses the scale of a PNG's samples. */
static bool scale_of(const texture_request *o, const texture_source *s, const frame_product *made, writing *w) {
    frame_summary sum;
    if (w->type != IMAGE_U16 || w->on.picture != NULL)
        return true;
    w->directions = made->kind == FRAME_NORMAL && !made->error;
    if (!range_of(o, s, made, &sum))
        return false;
    w->upwards = made->error;
    if (made->error && !rounding_of_product(o, s, made, &w->more))
        return false;
    const double step = writing_step(made);
    w->units = step > 0 || in_units(made, &sum);
    w->hi = step > 0 ? step * GREYS : (sum.count == 0 ? 1 : sum.hi) + w->more;
    w->lo = w->units ? w->hi / GREYS : sum.count == 0 || made->error ? 0 : sum.lo;
    w->scale = w->hi > w->lo ? 1 / (w->hi - w->lo) : 0;
    return true;
}

static const char *const axes[] = {"x right, y up, z towards the camera", "x right, y down, z towards the camera"};

meaning writing_meaning(const texture_request *o, const texture_product *p, const writing *w) {
    meaning m = {.file = o->out.file,
                 .product = p->name,
                 .unit = *p->unit != '\0' ? p->unit : NULL,
                 .type = image_type_name(w->type),
                 .axes = w->directions ? axes[w->down] : NULL,
                 .channels = w->channels,
                 .scale = 1};
    if (w->on.picture != NULL) {
        m.scale = w->type == IMAGE_U8 ? 1.0 / 255 : 1.0 / GREYS;
    } else if (w->file == IMAGE_PNG) {
        m.scale = w->directions ? 2.0 / GREYS : w->units ? w->lo : (w->hi - w->lo) / (GREYS - 1);
        m.offset = w->directions ? -1 : w->units ? 0 : w->lo - m.scale;
    }
    return m;
}

void writing_note(const writing *w, const texture_product *p, const meaning *m, char note[IMAGE_NOTE_SIZE]) {
    static const char *const names[FRAME_KINDS] = {
        [FRAME_EYE] = "eye-depths",    [FRAME_LINEAR01] = "eye-depths-over-far",
        [FRAME_RAW] = "window-depths", [FRAME_POSITION] = "positions",
        [FRAME_NORMAL] = "normals",    [FRAME_EFFECT] = "an-effect"};
    const dp_spec *planes = &frame_planes(&w->source->frame)->spec;
    if (w->units && m->scale >= METRIC_SCALE_MIN && m->scale <= METRIC_SCALE_MAX)
        snprintf(note, IMAGE_NOTE_SIZE, "product=depth metric=%s near=%s far=%s%s", number_full(m->scale).text,
                 number_full(planes->znear).text, number_full(planes->zfar).text, planes->ortho ? " ortho" : "");
    else
        snprintf(note, IMAGE_NOTE_SIZE, "product=%s%s offset=%s scale=%s%s",
                 w->on.picture != NULL ? "colours"
                 : p->made.radial      ? "distances"
                                       : names[p->made.kind],
                 p->made.error ? ",-the-error" : "", number_full(m->offset).text, number_full(m->scale).text,
                 m->axes == NULL      ? ""
                 : m->axes == axes[0] ? " y=up"
                                      : " y=down");
}

static const column map_columns[] = {
    {FIELD(meaning, file, "file", "")},         {FIELD(meaning, product, "product", "")},
    {FIELD(meaning, unit, "unit", "")},         {FIELD(meaning, type, "type", "")},
    {FIELD(meaning, channels, "channels", "")}, {FIELD(meaning, offset, "offset", "")},
    {FIELD(meaning, scale, "scale", "")},       {.kind = COLUMN_END}};

static const column meaning_columns[] = {{FIELD(meaning, file, "file", "")},
                                         {FIELD(meaning, product, "product", "")},
                                         {FIELD(meaning, unit, "unit", "")},
                                         {FIELD(meaning, type, "type", "")},
                                         {FIELD(meaning, channels, "channels", "")},
                                         {FIELD(meaning, offset, "offset", "")},
                                         {FIELD(meaning, scale, "scale", "")},
                                         {FIELD(meaning, axes, "axes", "")},
                                         {PART(meaning, error_map, "error_map", map_columns), .pointed = true},
                                         {.kind = COLUMN_END}};

int writing_say(const texture_request *o, const texture_product *p, const writing *w, meaning *m) {
    output out;
    if (o->out.form == FORM_JSON) {
        const int status = output_open(&out, NULL);
        if (status != EXIT_FINE)
            return status;
        report_write(&(report_spec){"texture", meaning_columns, m, .label = 14}, &out, FORM_JSON);
        return output_close(&out);
    }
    if (w->file != IMAGE_PNG || w->on.picture != NULL || o->out.quiet)
        return EXIT_FINE;
    if (w->directions)
        message("depthprec: %s: 0 is -1, 65535 is 1, %s; 0 in all three where there is no value", o->out.file, m->axes);
    else
        message("depthprec: %s: 1 is %s, 65535 is %s%s%s, 0 where there is no %s", o->out.file, number_full(w->lo).text,
                number_full(w->hi).text, *p->unit != '\0' ? " " : "", p->unit, p->made.error ? "bound" : "value");
    return EXIT_FINE;
}

static bool take_both(void *context, uint32_t row, uint32_t count, const float *const *values) {
    writing *w = context;
    return writing_take(&w[0], row, count, values[0]) && writing_take(&w[1], row, count, values[1]);
}

/* In one pass, but where one file begins with the bottom row and the other does not. */
static bool make_all(const texture_source *s, const texture_product *p, writing *w, int count) {
    const frame_product made[2] = {p[0].made, p[1].made};
    if (count == 2 && writing_bottom_up(&w[0]) == writing_bottom_up(&w[1]))
        return frame_run_all(&s->frame, made, 2, writing_bottom_up(&w[0]), take_both, w);
    return frame_run(&s->frame, &made[0], writing_bottom_up(&w[0]), writing_take, &w[0]) &&
           (count < 2 || frame_run(&s->frame, &made[1], writing_bottom_up(&w[1]), writing_take, &w[1]));
}

static void say_levels(const texture_request *o, const texture_source *s, const texture_product *p, const writing *w) {
    if (w->levels && w->pixels > 0 && !o->out.quiet)
        message("depthprec: %s: %s %% of the pixels %s off by more than one level", o->out.file,
                number_of(100.0 * (double)w->beyond / (double)w->pixels, 3).text,
                s->path != NULL || (p->made.effect->given && isnan(effect_reference(p->made.effect, p->settings, 1)))
                    ? "can be"
                    : "are");
}

static void take_picture(const texture_request *o, const texture_source *s, const frame_product *made, compose *on) {
    const double *tint = option_given(o->line, "tint") ? o->image.tint : made->effect->tint;
    *on = (compose){.row = made->effect, .parameters = made->effect_settings, .picture = &s->colours};
    memcpy(on->tint, tint, sizeof on->tint);
}

/* The product, and beside it the error as a product of its own. */
int texture_product_write(const texture_request *o, const texture_source *s, const texture_product *p) {
    texture_request each[2] = {*o, *o};
    texture_product product[2] = {*p, *p};
    writing w[2] = {{.down = o->image.normal_format != 0}, {.down = false}};
    meaning m[2];
    const int count = o->image.error_file != NULL ? 2 : 1;
    int status = EXIT_FINE, opened = 0;
    bool good = true;
    each[1].out.file = o->image.error_file;
    product[1].made = p->error;
    product[1].unit = p->unit_of_error;
    append(product[1].name, sizeof product[1].name, ", error");
    for (; opened < count && status == EXIT_FINE; opened++) {
        writing *one = &w[opened];
        const frame_product *made = &product[opened].made;
        one->levels = made->kind == FRAME_EFFECT && made->error;
        image_file_of(each[opened].out.file, &one->file);
        const bool drawn = opened == 0 && o->image.picture != NULL;
        status = writing_open(o, one, each[opened].out.file, s,
                              drawn                    ? s->colours.type
                              : one->file == IMAGE_PNG ? IMAGE_U16
                                                       : IMAGE_F32,
                              drawn ? s->colours.channels : (uint32_t)frame_channels(made));
        one->made_values = (size_t)s->camera.width * (size_t)frame_channels(made);
        if (drawn)
            take_picture(o, s, made, &one->on);
    }
    if (status != EXIT_FINE && opened == 2) {
        writing_end(&w[0], false);
        output_abandon(&w[0].out);
    }
    if (status != EXIT_FINE)
        return status;
    for (int i = 0; i < count; i++) {
        char note[IMAGE_NOTE_SIZE];
        good = good && scale_of(o, s, &product[i].made, &w[i]);
        m[i] = writing_meaning(&each[i], &product[i], &w[i]);
        writing_note(&w[i], &product[i], &m[i], note);
        good = good && writing_begin(&w[i], note);
    }
    good = good && make_all(s, product, w, count);
    status = writing_close(w, count, good);
    m[0].error_map = count > 1 ? &m[1] : NULL;
    for (int i = 0; i < count && status == EXIT_FINE; i++) {
        if (i == 0 || o->out.form != FORM_JSON) /* one object of JSON */
            status = writing_say(&each[i], &product[i], &w[i], &m[i]);
        if (status == EXIT_FINE)
            say_levels(&each[i], s, &product[i], &w[i]);
    }
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

static void depth_row(const writing *w, const dp_format *format, const uint32_t *codes) {
    for (size_t i = 0; i < w->row_values; i++)
        if (w->type == IMAGE_F32)
            ((float *)w->row)[i] = (float)dp_format_value(format, codes[i]);
        else if (w->type == IMAGE_F64)
            ((double *)w->row)[i] = dp_format_value(format, codes[i]);
        else if (w->type == IMAGE_U32)
            ((uint32_t *)w->row)[i] = codes[i];
        else if (w->type == IMAGE_U8)
            ((uint8_t *)w->row)[i] = (uint8_t)codes[i];
        else
            ((uint16_t *)w->row)[i] = (uint16_t)codes[i]; /* of fp16 the code is the bits */
}

int texture_depth_write(const texture_request *o, const texture_source *s, const dp_format *format,
                        const uint32_t *codes) {
    image_type type;
    writing w = {0};
    if (!image_file_of(o->out.file, &w.file))
        return option_error("output",
                            "must end in .png, .pfm or .npy for the depths, got '%s'; --json or --csv writes "
                            "statistics",
                            o->out.file);
    if (!depth_type(format, w.file, &type))
        return option_error("output", "%s does not hold %s: .npy does, got '%s'", image_file_name(w.file), format->name,
                            o->out.file);
    const int status = writing_open(o, &w, o->out.file, s, type, 1);
    if (status != EXIT_FINE)
        return status;
    bool good = writing_begin(&w, NULL);
    for (uint32_t i = 0; i < s->camera.height && good; i++) {
        const uint32_t row = writing_bottom_up(&w) ? s->camera.height - 1 - i : i;
        if (codes == NULL)
            frame_codes(&s->frame, row, w.codes);
        depth_row(&w, format, codes == NULL ? w.codes : codes + (size_t)row * s->camera.width);
        good = image_writer_rows(w.writer, w.row, 1);
        progress_step(&w.bar, i + 1);
    }
    return writing_close(&w, 1, good);
}
