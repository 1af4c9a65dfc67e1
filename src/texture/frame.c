/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "texture/frame.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "shader/oblique.h"
#include "texture/image_depths.h"
#include "texture/rows.h"
#include "texture/strips.h"

enum {
    STRIP_PIXELS = 1 << 17,
    STRIP_ROWS_MIN = 8,
    AROUND = 2 * NORMAL_REACH,
    SLOTS_A_THREAD = 4, /* so far the others get ahead of a thread that loses its core for a few milliseconds */
    ROOM = 40 << 20     /* bytes, for all strips at hand */
};

/* How far a code is from the window depth of far, as a share of the depth range. */
static double from_far(const dp_setup *setup, uint32_t rank) {
    const double value = dp_format_value(&setup->spec.format, frame_code(setup, rank));
    return fabs(value - setup->ends[1]) / setup->span;
}

uint32_t frame_sky_rank(const frame *f) {
    const dp_setup *setup = &f->camera->setup;
    const dp_format *format = &setup->spec.format;
    if (f->metric || f->sky < 0)
        return format->code_max + 1;
    const double edge = setup->ends[1] + (setup->reversed ? f->sky : -f->sky) * setup->span;
    uint32_t rank = frame_rank(setup, dp_format_encode(format, DP_ROUND_NEAREST, edge));
    const uint32_t far = frame_rank(setup, setup->code_far);
    /* two steps at most either way: the nearest code is a neighbour of the edge */
    while (rank < far && from_far(setup, rank) > f->sky)
        rank++;
    rank = rank < far ? rank : far;
    while (rank > 0 && from_far(setup, rank - 1) <= f->sky)
        rank--;
    return rank;
}

void frame_codes(const frame *f, uint32_t row, uint32_t *codes) {
    const dp_setup *setup = &f->camera->setup;
    if (f->synthetic != NULL)
        synthetic_codes(f->synthetic, f->camera, f->parameters, row, codes);
    else
        image_codes(f->image, &setup->spec.format, row, 0, f->camera->width, codes);
    for (uint32_t x = 0; x < f->camera->width && setup->ranged; x++) /* of a layer with a range before this one */
        if (frame_rank(setup, codes[x]) < frame_rank(setup, setup->code_near))
            codes[x] = UINT32_MAX;
}

frame frame_along(const frame *f, texture_camera *camera) {
    frame out = *f;
    *camera = *f->camera;
    camera->radial = false;
    out.camera = camera;
    return out;
}

int frame_channels(const frame_product *product) {
    const bool vector = product->kind == FRAME_POSITION || product->kind == FRAME_NORMAL || product->vector;
    return vector && !product->error ? 3 : 1;
}

/* Refuses products made from planes that all pixels share, or with the view axis in the middle of the picture. */
static const char *camera_refuses(const frame *f, const frame_product *product) {
    const bool oblique = f->camera->oblique.on, centred = camera_is_centred(f->camera);
    const bool shared = camera_is_shared(f->camera), aside = f->camera->centre[0] != 0 || f->camera->centre[1] != 0;
    if (product->kind == FRAME_POSITION && product->position != NULL && !centred)
        return "this method is for a frustum that is centred, without an oblique plane; 'exact' is for each";
    if (product->kind == FRAME_EFFECT && (oblique || (aside && (product->effect->needs & EFFECT_POSITION) != 0)))
        return "this effect is for a frustum that is centred, without an oblique plane";
    if (product->kind == FRAME_LINEAR01 && oblique)
        return "this is for a far plane that all pixels share";
    if (product->kind == FRAME_NORMAL && product->error && !shared && product->normal == normal_get(NORMAL_PROJECTIVE))
        return "its bound is for planes that all pixels share; the other methods have one";
    return NULL;
}

/* Effects and the quicker ways to a position are made of window depths, and read those from 0 to 1. */
static const char *range_refuses(const frame *f, const frame_product *product) {
    const bool reads = product->kind == FRAME_EFFECT || (product->kind == FRAME_POSITION && product->position != NULL);
    return f->camera->setup.ranged && reads
               ? "it reads depths of the depth range 0 to 1: undo the range, or take position:exact, eye, normal or raw"
               : NULL;
}

const char *frame_refuses(const frame *f, const frame_product *product) {
    const char *refused = range_refuses(f, product);
    if (refused != NULL)
        return refused;
    refused = camera_refuses(f, product);
    if (refused != NULL)
        return refused;
    if (product->kind == FRAME_POSITION && product->position != NULL &&
        (!position_applies(product->position, f->camera) || (f->metric && !product->position->curved)))
        return "this method does not support this projection and mapping";
    if (product->kind == FRAME_LINEAR01 && isinf(frame_planes(f)->spec.zfar))
        return "this needs a finite far plane";
    if (product->kind == FRAME_LINEAR01 && frame_planes(f)->spec.zfar <= 0)
        return "this needs far greater than 0";
    if (product->kind == FRAME_RAW && f->metric)
        return "metric depth is not window depth";
    if (product->kind == FRAME_EFFECT && !effect_applies(product->effect, frame_planes(f)))
        return "this effect needs a finite far plane";
    const bool normals = product->kind == FRAME_EFFECT && (product->effect->needs & EFFECT_NORMALS) != 0;
    if (normals && f->synthetic == NULL && f->normals == NULL)
        return "this effect needs normals, which an image of depths does not have, but a synthetic image";
    return NULL;
}

/* A thread's room: what a strip is made from. AROUND/2 rows more lie on either side. */
typedef struct desk {
    uint32_t *codes;
    float *eyes, *seen, *scratch; /* seen: with sky, for normals that see it; scratch: four rows */
    double *numbers;              /* of a row: see frame_row */
    grain_memo *memo;             /* of normals' error maps; else null */
} desk;

/* Everything of a run. */
typedef struct run {
    const frame *f;
    const frame_product *products;
    size_t product_count, values; /* of all products in a pixel */
    uint32_t width, height, stride, sky, strip, count, margin;
    bool bottom_up, depths, bounds, sees_sky; /* window depths; bounds of normals; normals that see sky */
    dp_batch eye, depth, stored;
    position_state position;
    float *slope_x, *out; /* out: a strip in each slot, product by product */
    desk *desks;
    int threads;
    size_t slots;
    frame_take_all *take;
    void *context;
} run;

int frame_threads(const frame *f) {
    return strips_threads(f->threads);
}

static void run_free(run *r) {
    for (int i = 0; i < r->threads && r->desks != NULL; i++) {
        free(r->desks[i].codes);
        free(r->desks[i].eyes);
        free(r->desks[i].seen);
        free(r->desks[i].scratch);
        free(r->desks[i].numbers);
        free(r->desks[i].memo);
    }
    free(r->desks);
    free(r->out);
    free(r->slope_x);
}

/* Long strips, so that they are seldom handed out; shorter where the rooms of many threads would be too large. */
static void plan(run *r, const frame *f) {
    const size_t pixel = 2 * sizeof(float) + SLOTS_A_THREAD * r->values * sizeof(float);
    r->threads = frame_threads(f);
    const size_t room = ROOM / (pixel * (size_t)r->threads), wanted = room < STRIP_PIXELS ? room : STRIP_PIXELS;
    const size_t rows = wanted / r->width;
    r->strip = rows < STRIP_ROWS_MIN ? STRIP_ROWS_MIN : (uint32_t)rows;
    if (r->strip > r->height)
        r->strip = r->height;
    r->count = (r->height + r->strip - 1) / r->strip;
    if ((uint32_t)r->threads > r->count)
        r->threads = (int)r->count;
    const size_t fit = ROOM / (r->strip * (size_t)r->width * r->values * sizeof *r->out);
    r->slots = SLOTS_A_THREAD * (size_t)r->threads;
    if (r->slots > fit)
        r->slots = fit > 1 ? fit : 2;
}

static bool make_room(run *r) {
    const size_t rows = (size_t)r->strip + AROUND, width = r->width;
    r->out = malloc(r->slots * r->strip * width * r->values * sizeof *r->out);
    r->slope_x = malloc(r->stride * sizeof *r->slope_x);
    r->desks = calloc((size_t)r->threads, sizeof *r->desks);
    bool good = r->out != NULL && r->slope_x != NULL && r->desks != NULL;
    for (int i = 0; i < r->threads && good; i++) {
        desk *d = &r->desks[i];
        d->codes = malloc(rows * width * sizeof *d->codes);
        d->eyes = malloc(rows * r->stride * sizeof *d->eyes);
        d->seen = r->sees_sky ? malloc(rows * r->stride * sizeof *d->seen) : NULL;
        d->scratch = malloc(4 * width * sizeof *d->scratch);
        d->numbers = malloc(FRAME_NUMBERS * width * sizeof *d->numbers);
        d->memo = r->bounds ? calloc(1, sizeof *d->memo) : NULL;
        good = (d->memo != NULL || !r->bounds) && (d->seen != NULL || !r->sees_sky) && d->codes != NULL &&
               d->eyes != NULL && d->scratch != NULL && d->numbers != NULL;
    }
    return good;
}

static bool looks_around(const frame_product *product) {
    return product->kind == FRAME_NORMAL || product->kind == FRAME_EFFECT;
}

static bool sees_window(frame_kind kind) {
    return kind == FRAME_RAW || kind == FRAME_POSITION || kind == FRAME_EFFECT;
}

static bool run_start(run *r, const frame *f) {
    const texture_camera *c = f->camera;
    r->f = f;
    r->width = c->width;
    r->height = c->height;
    r->stride = c->width + AROUND;
    r->sky = frame_sky_rank(f);
    r->margin = NORMAL_REACH;
    for (size_t i = 0; i < r->product_count; i++) {
        r->values += (size_t)frame_channels(&r->products[i]);
        r->depths = r->depths || sees_window(r->products[i].kind);
        r->bounds = r->bounds || (r->products[i].kind == FRAME_NORMAL && r->products[i].error);
        r->sees_sky = r->sees_sky || (r->products[i].kind == FRAME_NORMAL && r->products[i].normal->sees_sky);
        r->margin = looks_around(&r->products[i]) ? 0 : r->margin;
    }
    plan(r, f);
    if (!make_room(r))
        return false;
    for (uint32_t i = 0; i < r->stride; i++)
        r->slope_x[i] = (float)camera_slope_x(c, (double)i - NORMAL_REACH);
    if (r->depths)
        position_prepare(&r->position, c);
    const dp_path path = dp_path_best();
    return dp_batch_init(&r->eye, &c->setup, DP_TASK_EYE, DP_REAL_FLOAT, DP_WORD_32, path) == DP_OK &&
           dp_batch_init(&r->depth, &c->setup, DP_TASK_DECODE, DP_REAL_FLOAT, DP_WORD_32, path) == DP_OK &&
           dp_batch_init(&r->stored, &c->setup, DP_TASK_EYE, DP_REAL_DOUBLE, DP_WORD_32, path) == DP_OK;
}

static void decode_inside(const run *r, uint32_t row, uint32_t *codes, float *eyes) {
    frame_codes(r->f, row, codes);
    if (!camera_is_shared(r->f->camera))
        pixel_eyes(r->f->camera, row, codes, eyes);
    else
        dp_batch_run(&r->eye, codes, eyes, r->width);
    for (uint32_t x = 0; x < r->width; x++)
        eyes[x] = codes[x] == UINT32_MAX ? NAN : eyes[x];
}

/* Row i of the strip that begins at row `first`, margins counted: its codes and eye depths. Beyond the image is NaN,
 * and there are no codes. */
static void decode_row_of(const run *r, const desk *d, uint32_t first, uint32_t i) {
    const int64_t row = (int64_t)first + i - NORMAL_REACH;
    const uint32_t *codes = d->codes + (size_t)i * r->width;
    float *all = d->eyes + (size_t)i * r->stride, *eyes = all + NORMAL_REACH;
    const dp_setup *setup = &r->f->camera->setup;
    const uint32_t flip = setup->reversed ? setup->spec.format.code_max : 0, sky = r->sky;
    const bool inside = row >= 0 && row < r->height;
    for (uint32_t x = 0; x < r->stride; x++)
        all[x] = NAN;
    if (inside)
        decode_inside(r, (uint32_t)row, d->codes + (size_t)i * r->width, eyes);
    if (d->seen != NULL)
        memcpy(d->seen + (size_t)i * r->stride, all, r->stride * sizeof *all);
    for (uint32_t x = 0; inside && x < r->width; x++) {
        const uint32_t rank = flip != 0 ? flip - codes[x] : codes[x];
        eyes[x] = rank >= sky ? NAN : eyes[x];
    }
}

/* Where the rows of a product begin in a slot. */
static float *rows_of(const run *r, size_t slot, size_t product) {
    const size_t pixels = (size_t)r->strip * r->width;
    size_t before = 0;
    for (size_t i = 0; i < product; i++)
        before += (size_t)frame_channels(&r->products[i]);
    return r->out + (slot * r->values + before) * pixels;
}

/* Whether a product is the error of the last one: places and normals are kept until the next product is made. */
static bool is_error_of(const frame_product *product, const frame_product *last) {
    return product->error && !last->error && product->kind == last->kind &&
           (product->kind == FRAME_POSITION || product->kind == FRAME_NORMAL) && product->position == last->position &&
           product->normal == last->normal;
}

static void make_row(const run *r, const desk *d, uint32_t first, uint32_t i, size_t slot) {
    const size_t middle = (size_t)i + NORMAL_REACH, width = r->width;
    frame_row in = {.frame = r->f,
                    .position = &r->position,
                    .slope_x = r->slope_x + NORMAL_REACH,
                    .row = first + i,
                    .codes = d->codes + middle * width,
                    .planes = {d->scratch + width, d->scratch + 2 * width, d->scratch + 3 * width},
                    .stored = &r->stored,
                    .memo = d->memo,
                    .numbers = d->numbers};
    for (int k = -NORMAL_REACH; k <= NORMAL_REACH; k++) {
        const size_t at = (middle + (size_t)k) * r->stride + NORMAL_REACH;
        in.eyes[k + NORMAL_REACH] = d->eyes + at;
        in.seen[k + NORMAL_REACH] = r->sees_sky ? d->seen + at : NULL;
    }
    if (r->depths) {
        dp_batch_run(&r->depth, in.codes, d->scratch, width);
        in.depth = d->scratch;
    }
    for (size_t k = 0; k < r->product_count; k++) {
        const frame_product *product = &r->products[k];
        in.found = k > 0 && is_error_of(product, &r->products[k - 1]);
        in.product = product;
        in.out = rows_of(r, slot, k) + (size_t)i * width * (size_t)frame_channels(product);
        frame_makers[product->kind][product->error](&in);
    }
}

/* The first row of the strip that is made at turn number `turn`. */
static uint32_t first_row(const run *r, size_t turn) {
    return (uint32_t)(r->bottom_up ? r->count - 1 - turn : turn) * r->strip;
}

static uint32_t row_count(const run *r, uint32_t first) {
    return r->height - first < r->strip ? r->height - first : r->strip;
}

static void make(void *context, size_t turn, size_t slot, int thread) {
    const run *r = context;
    const desk *d = &r->desks[thread];
    const uint32_t first = first_row(r, turn), count = row_count(r, first);
    for (uint32_t i = r->margin; i < count + AROUND - r->margin; i++)
        decode_row_of(r, d, first, i);
    for (uint32_t i = 0; i < count; i++)
        make_row(r, d, first, i, slot);
}

static bool hand_over_strip(void *context, size_t turn, size_t slot) {
    const run *r = context;
    const uint32_t first = first_row(r, turn);
    const float *values[FRAME_PRODUCTS_MAX];
    for (size_t k = 0; k < r->product_count; k++)
        values[k] = rows_of(r, slot, k);
    return r->take(r->context, first, row_count(r, first), values);
}

bool frame_run_all(const frame *f, const frame_product *products, size_t count, bool bottom_up, frame_take_all *taker,
                   void *context) {
    run r = {.products = products, .product_count = count, .bottom_up = bottom_up, .take = taker, .context = context};
    const bool good = run_start(&r, f) && strips_run(&(strips){r.count, r.threads, r.slots, make, hand_over_strip, &r});
    run_free(&r);
    return good;
}

typedef struct single {
    frame_take *take;
    void *context;
} single;

static bool take_one(void *context, uint32_t row, uint32_t count, const float *const *values) {
    const single *s = context;
    return s->take(s->context, row, count, values[0]);
}

bool frame_run(const frame *f, const frame_product *product, bool bottom_up, frame_take *taker, void *context) {
    single s = {taker, context};
    return frame_run_all(f, product, 1, bottom_up, take_one, &s);
}
