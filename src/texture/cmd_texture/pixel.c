/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Single pixels: what is stored there, which depths that may be, and what the camera makes of it. */
#include <math.h>
#include <stddef.h>
#include <stdlib.h>

#include "camera/cmd/setups.h"
#include "report/number.h"
#include "report/report.h"
#include "shader/oblique.h"
#include "texture/cmd_texture/request.h"
#include "texture/cmd_texture/texture.h"
#include "texture/image_depths.h"

enum { DIGITS = 6, DIGITS_DEPTH = 10, DIGITS_Z = 9, DIGITS_MOST = 15, NEIGHBOURS = 4 };

/* A pixel and its numbers; those that do not exist are NaN. */
typedef struct pixel {
    uint32_t column, row;
    const char *state;  /* "depth", "sky", "hole" */
    double depth, code; /* window depth as the image has it, and the nearest code */
    double z;           /* what the code gives back */
    grain_range range;
    double interval;
    double linear01;           /* z over far */
    double distance;           /* from the camera, orthographic: from its plane */
    double truth, error;       /* of a synthetic image */
    double beside[NEIGHBOURS]; /* eye depths to the left, right, above, below */
    double position[3];        /* world, of what is stored */
    double position_off;       /* what that is off by, along the ray; of an image at most */
    double normal[3];          /* view space, by the method projective */
    double output, lost;       /* of an effect: in binary32, and what that adds to the exact one, for what is stored */
    double exact, levels;      /* output less lost; what the output is off by, or can be */
    double normal_off;         /* what that is off by at most, degrees; of a synthetic image truly */
} pixel;

typedef struct pixels {
    const texture_request *o;
    const texture_source *source;
    const frame_product *effect; /* null: none */
    const char *effect_name;
    setup_fields setup;
    const char *source_path, *synthetic, *format_from, *mapping_from, *direction_from;
    pixel *items, at; /* all, and the one at hand */
    size_t count;
} pixels;

/* ---- What is found ----------------------------------------------------------------------------------------------- */

/* The code of a pixel; UINT32_MAX where it has none, or lies outside. `codes` has room for a row. */
static uint32_t code_at(const frame *f, uint32_t *codes, int64_t x, int64_t y) {
    if (x < 0 || x >= f->camera->width || y < 0 || y >= f->camera->height)
        return UINT32_MAX;
    frame_codes(f, (uint32_t)y, codes);
    return codes[x];
}

static double depth_at(const frame *f, const pixel *p, uint32_t code) {
    double d = (double)NAN;
    if (f->image != NULL && !f->metric)
        image_depths(f->image, &f->camera->setup.spec.format, p->row, p->column, 1, &d);
    else if (!f->metric && code != UINT32_MAX)
        d = dp_format_value(&f->camera->setup.spec.format, code);
    return d;
}

static void describe_pixel(const texture_request *o, const texture_source *s, pixel *p, uint32_t *codes) {
    static const int steps[NEIGHBOURS][2] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};
    const frame *f = &s->frame;
    const dp_setup *setup = &s->camera.setup;
    const double none = (double)NAN;
    const uint32_t code = code_at(f, codes, p->column, p->row);
    const bool hole = code == UINT32_MAX, sky = !hole && frame_rank(setup, code) >= frame_sky_rank(f);
    double view[3], relative[3];
    synthetic_hit hit = {.z = (double)INFINITY};
    p->state = hole ? "hole" : sky ? "sky" : "depth";
    p->depth = depth_at(f, p, code);
    p->code = hole ? none : s->metric.sample_per != 0 ? s->metric.sample_from + s->metric.sample_per * code : code;
    p->z = hole ? none : pixel_stored(&s->camera, p->column, p->row, code);
    p->range = hole ? (grain_range){none, none, none} : pixel_range_of(&s->camera, f->grain, p->column, p->row, code);
    p->interval = p->range.hi - p->range.lo;
    if (f->synthetic != NULL)
        f->synthetic->hit(&s->camera, f->parameters, p->column, p->row, &hit);
    hit.z = f->synthetic != NULL && f->sky < 0 ? fmin(hit.z, setup->spec.zfar) : hit.z;
    const frame_product share = {.kind = FRAME_LINEAR01};
    const bool has_share = texture_far_known(o) && frame_refuses(f, &share) == NULL;
    const double along = camera_radial(&s->camera, p->column, p->row);
    p->linear01 = has_share ? p->z / frame_planes(f)->spec.zfar : none;
    p->distance = sky ? none : p->z * along;
    p->truth = isinf(hit.z) ? none : hit.z;
    p->error = isinf(hit.z) || hole ? none : dp_error(setup, code, hit.z);
    p->position_off = sky ? none : along * (f->synthetic != NULL ? fabs(p->error) : p->range.reach);
    camera_view(&s->camera, p->column, p->row, p->z, view);
    camera_turn(&s->camera, view, relative);
    for (int k = 0; k < 3; k++)
        p->position[k] = sky ? none : s->camera.origin[k] + relative[k];
    for (int k = 0; k < NEIGHBOURS; k++) {
        const int64_t x = (int64_t)p->column + steps[k][0], y = (int64_t)p->row + steps[k][1];
        const uint32_t beside = code_at(f, codes, x, y);
        p->beside[k] = beside == UINT32_MAX ? none : pixel_stored(&s->camera, (uint32_t)x, (uint32_t)y, beside);
    }
}

/* The numbers of a product to a field of each pixel. */
typedef struct taking {
    const pixels *all;
    size_t field, channels;
} taking;

static bool take_numbers(void *context, uint32_t row, uint32_t count, const float *values) {
    const taking *t = context;
    for (size_t i = 0; i < t->all->count; i++) {
        pixel *p = &t->all->items[i];
        double *numbers = (double *)(void *)((char *)p + t->field);
        if (p->row < row || p->row >= row + count)
            continue;
        const size_t at = (size_t)(p->row - row) * t->all->source->camera.width + p->column;
        for (size_t k = 0; k < t->channels; k++)
            numbers[k] = (double)values[at * t->channels + k];
    }
    return true;
}

static bool read_product(const pixels *all, frame_product product, size_t field) {
    taking t = {all, field, (size_t)frame_channels(&product)};
    return frame_run(&all->source->frame, &product, false, take_numbers, &t);
}

/* NaN where it is not known. */
static bool read_error(const pixels *all, frame_product product, size_t field) {
    product.error = true;
    if (frame_refuses(&all->source->frame, &product) == NULL)
        return read_product(all, product, field);
    for (size_t i = 0; i < all->count; i++)
        *(double *)(void *)((char *)&all->items[i] + field) = (double)NAN;
    return true;
}

/* Finds the effect's outputs at the pixels. */
static bool find_effect(pixels *all) {
    frame_product product = *all->effect;
    bool good = read_product(all, product, offsetof(pixel, output));
    product.lost = true;
    good = good && read_product(all, product, offsetof(pixel, lost));
    product.lost = false;
    good = good && read_error(all, product, offsetof(pixel, levels));
    for (size_t i = 0; i < all->count; i++)
        all->items[i].exact = all->items[i].output - all->items[i].lost;
    return good;
}

static bool find(pixels *all) {
    const frame_product normals = {.kind = FRAME_NORMAL, .normal = normal_get(NORMAL_PROJECTIVE)};
    uint32_t *codes = malloc(all->source->camera.width * sizeof *codes);
    for (size_t i = 0; codes != NULL && i < all->count; i++) {
        all->items[i].column = (uint32_t)depths_get(&all->o->image.pixels, 2 * i);
        all->items[i].row = (uint32_t)depths_get(&all->o->image.pixels, 2 * i + 1);
        describe_pixel(all->o, all->source, &all->items[i], codes);
    }
    const bool good = codes != NULL && read_product(all, normals, offsetof(pixel, normal)) &&
                      read_error(all, normals, offsetof(pixel, normal_off));
    free(codes);
    return good && (all->effect == NULL || find_effect(all));
}

/* ---- Text -------------------------------------------------------------------------------------------------------- */

/* Where the camera is known: of an image it is what the user says it was. */
static bool has_camera(const pixels *all) {
    return all->source->path == NULL || all->o->camera.matrix.count > 0 || option_given(all->o->line, "fov") ||
           option_given(all->o->line, "hfov") || option_given(all->o->line, "intrinsics") ||
           (option_given(all->o->line, "ortho") && *option_text(all->o->line, "ortho") != '\0');
}

/* Says an error: in a synthetic image as it is, in an image as a bound. */
static void say_off(page *p, const pixels *all, double by, const char *unit) {
    if (isnan(by))
        return;
    if (all->synthetic != NULL)
        page_note(p, "", "off by %s %s", number_of(by, DIGITS).text, unit);
    else
        page_note(p, "", "off by at most %s %s", number_up(by, DIGITS).text, unit);
}

static void say_normal(page *p, const pixels *all) {
    const pixel *x = &all->at;
    page_note(p, "normal", "%s, %s, %s in view space", number_of(x->normal[0], DIGITS).text,
              number_of(x->normal[1], DIGITS).text, number_of(x->normal[2], DIGITS).text);
    say_off(p, all, x->normal_off, all->synthetic != NULL ? "degrees" : "degrees where the surface is flat");
}

static void say_effect(page *p, const pixels *all) {
    const pixel *x = &all->at;
    page_note(p, all->effect_name, "%s in binary32, %s exactly", number_of(x->output, DIGITS_Z).text,
              number_of(x->exact, DIGITS_Z).text);
    say_off(p, all, x->levels, "levels");
}

static void say_pixel(page *p, void *item) {
    const pixels *all = item;
    const pixel *x = &all->at;
    const int digits = number_digits_within(x->z, x->interval, DIGITS_Z, DIGITS_MOST);
    const bool seen = *x->state == 'd';
    page_title(p, "pixel %u,%u: %s%s", x->column, x->row, seen ? "eye depth " : x->state,
               seen ? number_in(number_of(x->z, digits), p->unit).text : "");
    if (*x->state == 'h')
        return;
    page_note(p, "code", "%s%s%s", number_of(x->code, DIGITS_DEPTH).text, isnan(x->depth) ? "" : ", window depth ",
              isnan(x->depth) ? "" : number_of(x->depth, DIGITS_DEPTH).text);
    if (!isnan(x->linear01))
        page_note(p, "linear01", "%s, eye depth over far", number_of(x->linear01, DIGITS_Z).text);
    page_note(p, "may be", "%s to %s, an interval of %s", number_in(number_down(x->range.lo, digits), p->unit).text,
              number_in(number_up(x->range.hi, digits), p->unit).text,
              number_in(number_of(x->interval, DIGITS), p->unit).text);
    if (!isnan(x->truth))
        page_note(p, "truth", "%s, error %s", number_in(number_of(x->truth, digits), p->unit).text,
                  number_in(number_of(x->error, DIGITS), p->unit).text);
    page_note(p, "neighbours", "left %s, right %s, above %s, below %s",
              number_in(number_of(x->beside[0], digits), p->unit).text,
              number_in(number_of(x->beside[1], digits), p->unit).text,
              number_in(number_of(x->beside[2], digits), p->unit).text,
              number_in(number_of(x->beside[3], digits), p->unit).text);
    if (all->effect != NULL && !isnan(x->output))
        say_effect(p, all);
    if (!has_camera(all) || !seen)
        return;
    page_note(p, "position", "%s, %s, %s", number_in(number_of(x->position[0], DIGITS_Z), p->unit).text,
              number_in(number_of(x->position[1], DIGITS_Z), p->unit).text,
              number_in(number_of(x->position[2], DIGITS_Z), p->unit).text);
    page_note(p, "distance", "%s from the camera%s, off by%s %s along the ray",
              number_in(number_of(x->distance, DIGITS_Z), p->unit).text, all->source->camera.ortho ? "'s plane" : "",
              all->synthetic != NULL ? "" : " at most",
              number_in((all->synthetic != NULL ? number_of : number_up)(x->position_off, DIGITS), p->unit).text);
    if (!isnan(x->normal[0]))
        say_normal(p, all);
}

static void say_head(page *p, void *item) {
    const pixels *all = item;
    const texture_source *s = all->source;
    char label[SETUP_LABEL_SIZE];
    p->unit = camera_unit(&all->o->camera);
    page_text(p, "%s: %u x %u pixels, %s", all->synthetic != NULL ? all->synthetic : s->path, s->camera.width,
              s->camera.height,
              all->o->image.stereo.focal > 0 ? "disparity"
              : all->o->image.metric > 0     ? "metric depth"
                                             : setup_label_as(&s->setup, &all->setup, label));
    if (all->o->image.metric == 0)
        page_text(p, "format %s, mapping %s%s", all->format_from, all->mapping_from,
                  has_camera(all)   ? ""
                  : s->camera.ortho ? "; --ortho=H adds position and normal"
                                    : "; --fov adds position and normal");
    setup_say_planes(p, &all->setup);
    output_char(p->out, '\n');
}

/* ---- Columns ----------------------------------------------------------------------------------------------------- */

enum { OF_SYNTHETIC = 1, WITH_CAMERA = 2, WITH_EFFECT = 4 };

static void *next_pixel(void *of, size_t i) {
    pixels *all = of;
    if (i == all->count)
        return NULL;
    all->at = all->items[i];
    return all;
}

static const column vector_columns[][4] = {{{FIELD(pixels, at.position[0], "x", "scene")},
                                            {FIELD(pixels, at.position[1], "y", "scene")},
                                            {FIELD(pixels, at.position[2], "z", "scene")},
                                            {.kind = COLUMN_END}},
                                           {{FIELD(pixels, at.normal[0], "x", "")},
                                            {FIELD(pixels, at.normal[1], "y", "")},
                                            {FIELD(pixels, at.normal[2], "z", "")},
                                            {.kind = COLUMN_END}}};

static const column pixel_columns[] = {
    {FIELD(pixels, at.column, "column", "")},
    {FIELD(pixels, at.row, "row", "")},
    {FIELD(pixels, at.state, "state", "")},
    {FIELD(pixels, at.code, "code", "")},
    {FIELD(pixels, at.depth, "depth", "")},
    {FIELD(pixels, at.z, "z", "scene")},
    {FIELD(pixels, at.range.lo, "lo", "scene")},
    {FIELD(pixels, at.range.hi, "hi", "scene")},
    {FIELD(pixels, at.interval, "interval", "scene")},
    {FIELD(pixels, at.linear01, "linear01", "")},
    {FIELD(pixels, at.truth, "truth", "scene"), .when = OF_SYNTHETIC},
    {FIELD(pixels, at.error, "error", "scene"), .when = OF_SYNTHETIC},
    {FIELD(pixels, at.beside[0], "left", "scene")},
    {FIELD(pixels, at.beside[1], "right", "scene")},
    {FIELD(pixels, at.beside[2], "above", "scene")},
    {FIELD(pixels, at.beside[3], "below", "scene")},
    {GROUP("position", vector_columns[0]), .only = AS_JSON, .when = WITH_CAMERA},
    {FIELD(pixels, at.position_off, "position_error", "scene"), .only = AS_JSON, .when = WITH_CAMERA},
    {FIELD(pixels, at.distance, "distance", "scene"), .only = AS_JSON, .when = WITH_CAMERA},
    {GROUP("normal", vector_columns[1]), .only = AS_JSON, .when = WITH_CAMERA},
    {FIELD(pixels, at.position[0], "position_x", "scene"), .only = AS_CSV, .when = WITH_CAMERA},
    {FIELD(pixels, at.position[1], "position_y", "scene"), .only = AS_CSV, .when = WITH_CAMERA},
    {FIELD(pixels, at.position[2], "position_z", "scene"), .only = AS_CSV, .when = WITH_CAMERA},
    {FIELD(pixels, at.position_off, "position_error", "scene"), .only = AS_CSV, .when = WITH_CAMERA},
    {FIELD(pixels, at.distance, "distance", "scene"), .only = AS_CSV, .when = WITH_CAMERA},
    {FIELD(pixels, at.normal[0], "normal_x", ""), .only = AS_CSV, .when = WITH_CAMERA},
    {FIELD(pixels, at.normal[1], "normal_y", ""), .only = AS_CSV, .when = WITH_CAMERA},
    {FIELD(pixels, at.normal[2], "normal_z", ""), .only = AS_CSV, .when = WITH_CAMERA},
    {FIELD(pixels, at.normal_off, "normal_error", "degrees"), .when = WITH_CAMERA},
    {FIELD(pixels, at.output, "output", ""), .when = WITH_EFFECT},
    {FIELD(pixels, at.exact, "exact", ""), .when = WITH_EFFECT},
    {FIELD(pixels, at.levels, "levels", "1/255"), .when = WITH_EFFECT},
    {.kind = COLUMN_END}};

static const column columns[] = {{FIELD(pixels, source_path, "file", ""), .only = AS_JSON},
                                 {FIELD(pixels, synthetic, "synthetic", ""), .only = AS_JSON},
                                 {PART(pixels, setup, NULL, setup_columns)},
                                 {FIELD(pixels, format_from, "format_from", ""), .only = AS_JSON},
                                 {FIELD(pixels, mapping_from, "mapping_from", ""), .only = AS_JSON},
                                 {FIELD(pixels, direction_from, "direction_from", ""), .only = AS_JSON},
                                 {FIELD(pixels, effect_name, "effect", ""), .only = AS_JSON, .when = WITH_EFFECT},
                                 {LIST("pixels", pixel_columns, next_pixel), .head = say_pixel},
                                 {.kind = COLUMN_END}};

/* ---- The command ------------------------------------------------------------------------------------------------- */

int texture_pixels_check(const texture_request *o, uint32_t width, uint32_t height) {
    for (size_t i = 0; i < o->image.pixels.count; i += 2) {
        const double x = depths_get(&o->image.pixels, i), y = depths_get(&o->image.pixels, i + 1);
        if (x >= width || y >= height)
            return option_error("pixel", "must lie in the %u x %u pixels, from 0,0 to %u,%u, got %.0f,%.0f", width,
                                height, width - 1, height - 1, x, y);
    }
    return EXIT_FINE;
}

int texture_pixel_write(const texture_request *o, const texture_source *source, const frame_product *effect) {
    output out;
    pixels all = {.o = o,
                  .source = source,
                  .effect = effect,
                  .effect_name = effect != NULL ? effect->effect->name : NULL,
                  .setup = setup_fields_asked(&source->setup, &o->camera),
                  .source_path = source->path,
                  .synthetic = source->frame.synthetic != NULL ? source->frame.synthetic->name : NULL,
                  .format_from = texture_origin_name(source->format_from),
                  .mapping_from = texture_origin_name(source->mapping_from),
                  .direction_from = texture_origin_name(source->direction_from),
                  .count = o->image.pixels.count / 2};
    int status = texture_pixels_check(o, source->camera.width, source->camera.height);
    const char *wrong = effect != NULL ? frame_refuses(&source->frame, effect) : NULL;
    if (status == EXIT_FINE && wrong != NULL)
        status = usage_error("texture: %s: %s", effect->effect->name, wrong);
    if (status == EXIT_FINE)
        status = output_start(&o->out, &o->camera, &out);
    if (status != EXIT_FINE)
        return status;
    all.items = calloc(all.count, sizeof *all.items);
    if (all.items != NULL && find(&all)) {
        const unsigned when = (all.synthetic != NULL ? OF_SYNTHETIC : 0) | (has_camera(&all) ? WITH_CAMERA : 0) |
                              (effect != NULL ? WITH_EFFECT : 0);
        report_write(&(report_spec){"texture", columns, &all, .when = when, .label = 14, .head = say_head}, &out,
                     o->out.form);
        status = output_close(&out);
    } else {
        output_abandon(&out);
        status = usage_error("texture: no memory for the pixels");
    }
    free(all.items);
    return status;
}
