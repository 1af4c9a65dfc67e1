/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "texture/frame.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#ifdef _OPENMP
#include <omp.h>
#endif

#include "texture/frame_rows.h"
#include "texture/image_depths.h"

enum { STRIP_PIXELS = 1 << 18, STRIP_ROWS_MIN = 8, AROUND = 2 * NORMAL_REACH };

uint32_t frame_sky_rank(const frame *f) {
    const dp_setup *setup = &f->camera->setup;
    const dp_format *format = &setup->spec.format;
    if (f->metric)
        return format->code_max + 1;
    const double edge = setup->reversed ? f->sky : 1 - f->sky;
    uint32_t rank = frame_rank(setup, dp_format_encode(format, DP_ROUND_NEAREST, edge));
    const uint32_t far = frame_rank(setup, setup->code_far);
    for (;; rank++) { /* two steps at most either way: the nearest code is a neighbour of the edge */
        const double value = dp_format_value(format, frame_code(setup, rank));
        if (rank >= far || (setup->reversed ? value : 1 - value) <= f->sky)
            break;
    }
    while (rank > 0) {
        const double value = dp_format_value(format, frame_code(setup, rank - 1));
        if ((setup->reversed ? value : 1 - value) > f->sky)
            break;
        rank--;
    }
    return rank < far ? rank : far;
}

void frame_codes(const frame *f, uint32_t row, uint32_t *codes) {
    if (f->scene != NULL)
        scene_codes(f->scene, f->camera, f->parameters, row, codes);
    else
        image_codes(f->image, &f->camera->setup.spec.format, row, 0, f->camera->width, codes);
}

int frame_channels(const frame_product *product) {
    const bool vector = product->kind == FRAME_POSITION || product->kind == FRAME_NORMAL;
    return vector && !product->error ? 3 : 1;
}

const char *frame_refuses(const frame *f, const frame_product *product) {
    if (product->kind == FRAME_POSITION && product->position != NULL && !position_applies(product->position, f->camera))
        return "this method does not support this projection and mapping";
    if (product->kind == FRAME_EFFECT && !effect_applies(product->effect, frame_planes(f)))
        return "this effect needs a finite far plane";
    if (product->kind == FRAME_EFFECT && f->scene == NULL && (product->effect->needs & EFFECT_NORMALS) != 0)
        return "this effect needs normals, which an image of depths does not have, but a scene";
    if (product->kind == FRAME_NORMAL && product->error && f->scene == NULL &&
        strcmp(product->normal->name, "projective") != 0)
        return "the error of this method is known in a scene only; that of 'projective' has a bound";
    return NULL;
}

/* Everything of a run. Strips hold AROUND/2 rows more on either side. */
typedef struct run {
    const frame *f;
    const frame_product *product;
    int threads;
    uint32_t width, height, stride, sky, strip;
    dp_batch eye, depth;
    position_state position;
    uint32_t *codes;
    float *eyes, *out, *slope_x, *scratch; /* scratch: four rows a thread */
} run;

int frame_threads(const frame *f) {
#ifdef _OPENMP
    return f->threads > 0 ? f->threads : omp_get_max_threads();
#else
    (void)f;
    return 1;
#endif
}

static int thread_now(void) {
#ifdef _OPENMP
    return omp_get_thread_num();
#else
    return 0;
#endif
}

static void run_free(run *r) {
    free(r->codes);
    free(r->eyes);
    free(r->out);
    free(r->slope_x);
    free(r->scratch);
}

static bool run_start(run *r, const frame *f, const frame_product *product) {
    const texture_camera *c = f->camera;
    *r = (run){.f = f,
               .product = product,
               .threads = frame_threads(f),
               .width = c->width,
               .height = c->height,
               .stride = c->width + AROUND,
               .sky = frame_sky_rank(f)};
    const uint32_t wanted = STRIP_PIXELS / c->width;
    r->strip = wanted < STRIP_ROWS_MIN ? STRIP_ROWS_MIN : wanted;
    if (r->strip > c->height)
        r->strip = c->height;
    const size_t rows = (size_t)r->strip + AROUND, channels = (size_t)frame_channels(product);
    r->codes = malloc(rows * r->width * sizeof *r->codes);
    r->eyes = malloc(rows * r->stride * sizeof *r->eyes);
    r->out = malloc((size_t)r->strip * r->width * channels * sizeof *r->out);
    r->slope_x = malloc(r->stride * sizeof *r->slope_x);
    r->scratch = malloc((size_t)r->threads * 4 * r->width * sizeof *r->scratch);
    if (r->codes == NULL || r->eyes == NULL || r->out == NULL || r->slope_x == NULL || r->scratch == NULL)
        return false;
    for (uint32_t i = 0; i < r->stride; i++)
        r->slope_x[i] = (float)camera_slope_x(c, (double)i - NORMAL_REACH);
    if ((product->kind == FRAME_POSITION && product->position != NULL) || product->kind == FRAME_EFFECT)
        position_prepare(&r->position, c);
    const dp_path path = dp_path_best();
    return dp_batch_init(&r->eye, &c->setup, DP_TASK_EYE, DP_REAL_FLOAT, DP_WORD_32, path) == DP_OK &&
           dp_batch_init(&r->depth, &c->setup, DP_TASK_DECODE, DP_REAL_FLOAT, DP_WORD_32, path) == DP_OK;
}

/* Row i of the strip that begins at row `first`, margins counted: its codes and eye depths. Beyond the image is NaN. */
static void decode_row_of(const run *r, uint32_t first, uint32_t i) {
    const int64_t row = (int64_t)first + i - NORMAL_REACH;
    uint32_t *codes = r->codes + (size_t)i * r->width;
    float *eyes = r->eyes + (size_t)i * r->stride + NORMAL_REACH;
    const dp_setup *setup = &r->f->camera->setup;
    const uint32_t flip = setup->reversed ? setup->spec.format.code_max : 0, sky = r->sky;
    const bool inside = row >= 0 && row < r->height;
    if (inside) {
        frame_codes(r->f, (uint32_t)row, codes);
        dp_batch_run(&r->eye, codes, eyes, r->width);
    }
    for (uint32_t x = 0; x < r->width; x++) {
        const uint32_t rank = flip != 0 ? flip - codes[x] : codes[x];
        eyes[x] = !inside || codes[x] == UINT32_MAX || rank >= sky ? NAN : eyes[x];
    }
    for (int k = 0; k < NORMAL_REACH; k++)
        eyes[-1 - k] = eyes[(int64_t)r->width + k] = NAN;
}

static void make_row(const run *r, uint32_t first, uint32_t i) {
    float *scratch = r->scratch + (size_t)thread_now() * 4 * r->width;
    const size_t middle = (size_t)i + NORMAL_REACH;
    frame_row in = {.frame = r->f,
                    .product = r->product,
                    .position = &r->position,
                    .slope_x = r->slope_x + NORMAL_REACH,
                    .row = first + i,
                    .codes = r->codes + middle * r->width,
                    .planes = {scratch + r->width, scratch + 2 * (size_t)r->width, scratch + 3 * (size_t)r->width},
                    .out = r->out + (size_t)i * r->width * (size_t)frame_channels(r->product)};
    for (int k = -NORMAL_REACH; k <= NORMAL_REACH; k++)
        in.eyes[k + NORMAL_REACH] = r->eyes + (middle + (size_t)k) * r->stride + NORMAL_REACH;
    if (r->product->kind == FRAME_POSITION || r->product->kind == FRAME_EFFECT) {
        dp_batch_run(&r->depth, in.codes, scratch, r->width);
        in.depth = scratch;
    }
    frame_makers[r->product->kind][r->product->error](&in);
}

bool frame_run(const frame *f, const frame_product *product, bool bottom_up, frame_take *take, void *context) {
    run r;
    bool good = run_start(&r, f, product);
    const uint32_t strips = (r.height + r.strip - 1) / (r.strip > 0 ? r.strip : 1);
    const bool neighbours = product->kind == FRAME_NORMAL || product->kind == FRAME_EFFECT;
    const uint32_t margin = neighbours ? 0 : NORMAL_REACH;
    for (uint32_t s = 0; s < strips && good; s++) {
        const uint32_t first = (bottom_up ? strips - 1 - s : s) * r.strip;
        const uint32_t count = r.height - first < r.strip ? r.height - first : r.strip;
#pragma omp parallel num_threads(r.threads)
        {
#pragma omp for schedule(dynamic, 2)
            for (uint32_t i = margin; i < count + AROUND - margin; i++)
                decode_row_of(&r, first, i);
#pragma omp for schedule(dynamic, 2)
            for (uint32_t i = 0; i < count; i++)
                make_row(&r, first, i);
        }
        good = take(context, first, count, r.out);
    }
    run_free(&r);
    return good;
}
