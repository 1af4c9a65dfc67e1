/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * texture --product raw and --product linear01: what codes stand for, worked out here in long double, and how far that
 * can be off: of an image half a cell and what binary32 loses, of a scene the distance from its known depth.
 */
#include "image/image.h"
#include "printed.h"

typedef long double real;

enum { COLUMNS = 23, ROWS = 7, PIXELS = COLUMNS * ROWS };

typedef struct buffer {
    const char *format, *mapping;
    image_type type;
    int bits; /* of UNORM; 0: binary32 */
    real n, f;
    bool ortho, truncated;
} buffer;

static const buffer buffers[] = {
    {"unorm16", "d3d", IMAGE_U16, 16, 0.25L, 700, false, false},
    {"unorm16", "reversed", IMAGE_U16, 16, 0.25L, 700, false, true},
    {"unorm24", "gl", IMAGE_U32, 24, 1, 50, false, false},
    {"unorm24", "linear", IMAGE_U32, 24, 2, 900, false, false},
    {"unorm24", "d3d", IMAGE_U32, 24, -3, 80, true, false},
    {"unorm16", "reversed", IMAGE_U16, 16, 0.5L, 40, true, false},
    {"fp32", "reversed", IMAGE_F32, 0, 0.25L, 2000, false, false},
    {"fp32", "d3d", IMAGE_F32, 0, 0.25L, 2000, false, false},
};
enum { BUFFERS = sizeof buffers / sizeof buffers[0] };

static bool reversed(const buffer *b) {
    return strcmp(b->mapping, "reversed") == 0;
}

/* The eye depth of a window depth. */
static real eye_of(const buffer *b, real d) {
    const real far = reversed(b) ? 1 - d : d;
    if (strcmp(b->mapping, "linear") == 0)
        return b->f * d;
    return b->ortho ? b->n + (b->f - b->n) * far : b->n * b->f / (b->f - (b->f - b->n) * far);
}

static real window_of(const buffer *b, real z) {
    const real share = strcmp(b->mapping, "linear") == 0 ? z / b->f
                       : b->ortho                        ? (z - b->n) / (b->f - b->n)
                                                         : b->f * (z - b->n) / (z * (b->f - b->n));
    return reversed(b) ? 1 - share : share;
}

/* Window depths that became a sample: from, stored, to. */
static void cell_of(const buffer *b, double sample, real out[3]) {
    const real most = b->bits > 0 ? (real)((1UL << b->bits) - 1) : 1;
    const real below = b->bits > 0 ? 1 : (real)((float)sample - nextafterf((float)sample, -1));
    const real above = b->bits > 0 ? 1 : (real)(nextafterf((float)sample, 2) - (float)sample);
    out[1] = (real)sample / most;
    out[0] = fmaxl(0, ((real)sample - (b->truncated ? 0 : below / 2)) / most);
    out[2] = fminl(1, ((real)sample + (b->truncated ? above : above / 2)) / most);
}

static const float *product_of(const char *source, const char *options, image *out) {
    image_error error;
    printed p = print_of("texture %s %s -q -o %s", source, options, scratch_file("product.npy"));
    if (p.status != 0)
        fail_msg("%s %s: %s", source, options, p.errors);
    printed_free(&p);
    assert_true(image_read(scratch_file("product.npy"), out, &error));
    return out->data;
}

static void options_of(const buffer *b, char out[256]) {
    snprintf(out, 256, "-F %s -m %s -n %.9Lg -f %.9Lg%s%s", b->format, b->mapping, b->n, b->f,
             b->ortho ? " --ortho" : "", b->truncated ? " --rounding zero" : "");
}

/* Samples at random, and the ends. */
static void write_samples(const buffer *b, rng *r, double samples[PIXELS], const char *path) {
    static union {
        uint16_t u2[PIXELS];
        uint32_t u4[PIXELS];
        float f4[PIXELS];
    } data;
    for (int i = 0; i < PIXELS; i++) {
        const double most = b->bits > 0 ? (double)((1UL << b->bits) - 1) : 1;
        samples[i] = i == 0 ? 0 : i == 1 ? most : b->bits > 0 ? (double)rng_below(r, (uint64_t)most) : 0;
        if (i > 1 && b->bits == 0) /* all through the binades, and a hole */
            samples[i] = i == 2 ? NAN : (double)(float)(reversed(b) ? rng_log(r, 2e-4, 1) : 1 - rng_log(r, 2e-4, 0.9));
        if (b->type == IMAGE_U16)
            data.u2[i] = (uint16_t)samples[i];
        else if (b->type == IMAGE_U32)
            data.u4[i] = (uint32_t)samples[i];
        else
            data.f4[i] = (float)samples[i];
    }
    FILE *stream = fopen(path, "wb");
    assert_non_null(stream);
    image_writer *w = image_writer_open(stream, IMAGE_NPY, b->type, COLUMNS, ROWS, 1, NULL);
    assert_non_null(w);
    assert_true(image_writer_rows(w, &data, ROWS));
    assert_true(image_writer_close(w));
    assert_int_equal(fclose(stream), 0);
}

/* The map holds what the product is off by, and hardly more. */
static void judge_map(tally *t, const char *what, int i, double map, real least) {
    TALLY(t, (real)map >= least && (real)map <= least * (1 + 0x1p-18L) + 1e-35L, "%s %d: map %.12g, not %.12Lg", what,
          i, map, least);
}

TEST(images_are_off_by_half_a_cell) {
    tally t = {.name = "images"};
    rng r = rng_make("raw");
    for (size_t k = 0; k < BUFFERS; k++) {
        const buffer *b = &buffers[k];
        char source[768], path[512];
        double samples[PIXELS];
        image made[4];
        snprintf(path, sizeof path, "%s", scratch_file("in.npy"));
        write_samples(b, &r, samples, path);
        snprintf(source, sizeof source, "%s ", path);
        options_of(b, source + strlen(source));
        const float *raw = product_of(source, "--product raw", &made[0]);
        const float *raw_map = product_of(source, "--product raw --error-map", &made[1]);
        const float *share = product_of(source, "--product linear01", &made[2]);
        const float *share_map = product_of(source, "--product linear01 --error-map", &made[3]);
        for (int i = 0; i < PIXELS; i++) {
            real d[3], z[3];
            if (isnan(samples[i])) {
                TALLY(&t, isnan(raw[i]) && isnan(raw_map[i]) && isnan(share[i]), "%d: a hole", i);
                continue;
            }
            cell_of(b, samples[i], d);
            TALLY(&t, raw[i] == (float)d[1], "%s %d: %.12g, not %.12Lg", b->format, i, (double)raw[i], d[1]);
            judge_map(&t, b->format, i, (double)raw_map[i],
                      fabsl((real)raw[i] - d[1]) + fmaxl(d[1] - d[0], d[2] - d[1]));
            if (fabsl(d[1] - (reversed(b) ? 0 : 1)) <= 1e-4L) {
                TALLY(&t, isnan(share[i]) && isnan(share_map[i]), "%s %d: sky", b->format, i);
                continue;
            }
            for (int j = 0; j < 3; j++)
                z[j] = eye_of(b, d[j]) / b->f;
            TALLY(&t, fabsl((real)share[i] - z[1]) <= 0x1p-22L * fabsl(z[1]), "%s %d: %.12g, not %.12Lg", b->format, i,
                  (double)share[i], z[1]);
            judge_map(&t, b->mapping, i, (double)share_map[i],
                      fabsl((real)share[i] - z[1]) + fmaxl(fabsl(z[1] - z[0]), fabsl(z[2] - z[1])));
        }
        for (int i = 0; i < 4; i++)
            image_free(&made[i]);
    }
    tally_end(&t);
}

/* Bytes of a finer buffer: v in [min(k - 1/2, k 255/256)/255, (k + 1)/255), and half a cell of that. */
TEST(samples_coarser_than_the_buffer_count) {
    char source[768], path[512];
    uint8_t bytes[PIXELS];
    image map;
    tally t = {.name = "bytes"};
    snprintf(path, sizeof path, "%s", scratch_file("bytes.npy"));
    for (int i = 0; i < PIXELS; i++)
        bytes[i] = (uint8_t)(i * 37 % 256);
    FILE *stream = fopen(path, "wb");
    assert_non_null(stream);
    image_writer *w = image_writer_open(stream, IMAGE_NPY, IMAGE_U8, COLUMNS, ROWS, 1, NULL);
    assert_true(w != NULL && image_writer_rows(w, bytes, ROWS) && image_writer_close(w));
    fclose(stream);
    snprintf(source, sizeof source, "%s -F unorm24 -m d3d", path);
    const float *got = product_of(source, "--product raw --error-map", &map);
    for (int i = 0; i < PIXELS; i++) {
        const double up = bytes[i] < 255 ? 1.0 / 255 : 0, down = fmin(bytes[i], fmax(0.5, bytes[i] / 256.0)) / 255;
        const double want = fmax(up, down), got_here = (double)got[i];
        TALLY(&t, got_here >= want - 0x1p-24 && got_here <= want + 0x1p-23, "%d: %.9g, not %.9g", bytes[i], got_here,
              want);
    }
    image_free(&map);
    tally_end(&t);
}

/* A wall across the view, whose depth is known; and one behind the far plane, which is cleared to. */
TEST(scenes_are_off_by_what_they_are) {
    tally t = {.name = "scenes"};
    rng r = rng_make("raw scenes");
    for (size_t k = 0; k < BUFFERS; k++)
        for (int i = 0; i < 12; i++) {
            const buffer *b = &buffers[k];
            const double lo = fmax((double)b->n, 0.25), z = i == 0 ? 2 * (double)b->f : rng_log(&r, lo, (double)b->f);
            const real d = window_of(b, fminl((real)z, b->f));
            char source[512];
            image raw, raw_map, share, share_map;
            snprintf(source, sizeof source, "--synthetic plane --size 2x1 --parameter distance=%.17g ", z);
            options_of(b, source + strlen(source));
            const real stored = (real)product_of(source, "--product raw", &raw)[0];
            const real off = (real)product_of(source, "--product raw --error-map", &raw_map)[0];
            const real want = fabsl(stored - d);
            TALLY(&t, off >= want && off <= want * (1 + 0x1p-22L) + 0x1p-49L * d, "%s %s at %.9g: %.9Lg, not %.9Lg",
                  b->format, b->mapping, z, off, want);
            const real over_far = (real)product_of(source, "--product linear01", &share)[0];
            const real off_far = (real)product_of(source, "--product linear01 --error-map", &share_map)[0];
            const bool sky = isnan((double)over_far);
            TALLY(&t, sky == (fabsl(stored - (reversed(b) ? 0 : 1)) <= 1e-4L), "%s at %.9g: sky", b->format, z);
            TALLY(&t, sky || fabsl(fabsl(over_far - (real)z / b->f) - off_far) <= 0x1p-22L * over_far,
                  "%s %s at %.9g: %.9Lg off %.9Lg", b->format, b->mapping, z, over_far, off_far);
            image_free(&raw);
            image_free(&raw_map);
            image_free(&share);
            image_free(&share_map);
        }
    tally_end(&t);
}

/* Metric depth over a far plane that is given. */
TEST(metric_depth_over_far) {
    char source[600], path[512];
    double samples[PIXELS];
    image share;
    tally t = {.name = "metric"};
    rng r = rng_make("metric");
    snprintf(path, sizeof path, "%s", scratch_file("in.npy"));
    write_samples(&buffers[0], &r, samples, path);
    snprintf(source, sizeof source, "%s --metric 0.01 -f 800", path);
    const float *got = product_of(source, "--product linear01", &share);
    for (int i = 1; i < PIXELS; i++)
        TALLY(&t, fabs((double)got[i] - samples[i] / 80000) <= 0x1p-22 * (double)got[i], "%d: %.9g", i, (double)got[i]);
    image_free(&share);
    tally_end(&t);
}

TEST(refusals) {
    static const char *const rows[][2] = {
        {"--metric 0.01 --product raw",
         "depthprec: --product: raw does not apply with --metric, which is not window depth\n"},
        {"--metric 0.01 --product linear01",
         "depthprec: --product: linear01 needs --far with --metric and --stereo, which have none\n"},
        {"--packing depth-normals --product raw",
         "depthprec: --product: raw does not apply with --packing depth-normals, which is not window depth\n"},
        {"-m d3d -f inf --product linear01", "depthprec: texture: eye depth over far: this needs a finite far plane\n"},
        {"-m d3d --ortho -n -3 -f 0 --product linear01",
         "depthprec: texture: eye depth over far: this needs far greater than 0\n"},
        {"-m d3d --product raw --product linear01",
         "depthprec: --product: must not be given twice, got 'linear01' too\n"},
        {"-m d3d --product pack:rg --product raw", "depthprec: --product: must not be given twice, got 'raw' too\n"}};
    char path[512];
    double samples[PIXELS];
    rng r = rng_make("refusals");
    snprintf(path, sizeof path, "%s", scratch_file("in.npy"));
    write_samples(&buffers[0], &r, samples, path);
    printed pixel = print_of("texture %s -m d3d --ortho -n -3 -f 0 -q --pixel 3,3", path);
    assert_non_null(strstr(pixel.out, "window depth"));
    assert_null(strstr(pixel.out, "linear01"));
    printed_free(&pixel);
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        printed p = print_of("texture %s %s -q -o %s", path, rows[i][0], scratch_file("out.npy"));
        assert_int_equal(p.status, 2);
        assert_string_equal(p.errors, rows[i][1]);
        printed_free(&p);
    }
}
