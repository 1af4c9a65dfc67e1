/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Effects on a picture of colours: each sample by the mixing formulas of shaders, written here, of what the same effect
 * is without a picture; alpha stays as it is, and pixels that have no value or hide the surface. */
#include "image/image.h"
#include "printed.h"

enum { WIDTH = 40, HEIGHT = 24, PIXELS = WIDTH * HEIGHT };

typedef enum how { TINTS, SPARES, BLURS, SMEARS } how;

static double sample(const image *p, int64_t x, int64_t y, uint32_t k) {
    x = x < 0 ? 0 : x < WIDTH ? x : WIDTH - 1;
    y = y < 0 ? 0 : y < HEIGHT ? y : HEIGHT - 1;
    const size_t at = (size_t)(y * WIDTH + x) * p->channels + k;
    return p->type == IMAGE_U8 ? ((const uint8_t *)p->data)[at] / 255.0 : ((const uint16_t *)p->data)[at] / 65535.0;
}

/* Weighted by how near the four pixels around are. */
static double between(const image *p, double x, double y, uint32_t k) {
    double sum = 0;
    for (int64_t j = (int64_t)floor(y); j <= (int64_t)floor(y) + 1; j++)
        for (int64_t i = (int64_t)floor(x); i <= (int64_t)floor(x) + 1; i++)
            sum += (1 - fabs(x - (double)i)) * (1 - fabs(y - (double)j)) * sample(p, i, j, k);
    return sum;
}

static double by_hand(how mix, const double *tint, const image *p, int x, int y, uint32_t k, const float *value) {
    const double own = sample(p, x, y, k), v = fmin(fmax((double)value[0], 0), 1);
    double sum = 0;
    if (mix == SMEARS) /* three steps, the picture's height is down */
        for (int i = 0; i < 3; i++)
            sum += between(p, x + i * (double)value[0] * WIDTH, y - i * (double)value[1] * HEIGHT, k) / 3;
    for (int i = -1; i <= 1 && mix == BLURS; i++)
        for (int j = -1; j <= 1; j++)
            sum += between(p, x + 1.5 * i, y + 1.5 * j, k) / 9;
    return mix == SMEARS  ? sum
           : mix == BLURS ? own * (1 - v) + sum * v
                          : own + (mix == TINTS ? v : 1 - v) * tint[3] * (tint[k] - own);
}

/* Noise of 8 bits in three channels, or of 16 in four. */
static void make_picture(bool deep, char path[256]) {
    rng r = rng_make("picture");
    uint16_t row[4 * WIDTH];
    snprintf(path, 256, "%s", scratch_file(deep ? "deep.png" : "picture.png"));
    FILE *f = fopen(path, "wb");
    assert_non_null(f);
    image_writer *w = image_writer_open(f, IMAGE_PNG, deep ? IMAGE_U16 : IMAGE_U8, WIDTH, HEIGHT, deep ? 4 : 3, NULL);
    for (int y = 0; y < HEIGHT; y++) {
        for (int i = 0; i < 4 * WIDTH; i++)
            row[i] = (uint16_t)rng_below(&r, 65536);
        assert_true(image_writer_rows(w, row, 1));
    }
    assert_true(image_writer_close(w));
    assert_int_equal(fclose(f), 0);
}

static void read(const char *path, image *out) {
    image_error error;
    if (!image_read(path, out, &error))
        fail_msg("%s: %s", path, error.text);
}

static const struct {
    const char *options, *of_picture; /* for the product alone, too; or not */
    how mix;
    double tint[4];
} rows[] = {
    {"--product effect:fog --parameter density=1.3", "", TINTS, {0.5, 0.5, 0.5, 1}},
    {"--product effect:fog --parameter density=1.3", "--tint 1,0.2,0,0.6", TINTS, {1, 0.2, 0, 0.6}},
    {"--product effect:fog --sky 0", "--tint 0,0,1", TINTS, {0, 0, 1, 1}},
    {"--product effect:intersection --parameter reference=9 --parameter half-width=3", "", SPARES, {1, 1, 1, 1}},
    {"--product effect:force-field --parameter reference=9", "", TINTS, {0.25, 0.5, 1, 1}},
    {"--product effect:ScanLine --parameter _CurValue=0.2 --parameter half-width=0.1", "", SPARES, {1, 1, 1, 1}},
    {"--product effect:water-line --parameter band=2", "", TINTS, {0, 0.25, 0.5, 0.5}},
    {"--product effect:height-fog --parameter start=-3 --parameter end=4", "", SPARES, {0.5, 0.5, 0.5, 1}},
    {"--product effect:edge --parameter threshold=0.01", "", TINTS, {0, 0, 0, 1}},
    {"--product effect:shadow --parameter reference=8", "", SPARES, {0, 0, 0, 1}},
    {"--product effect:depth-of-field --parameter _FocusDistance=0.2", "--parameter _BlurLevel=1.5", BLURS, {0}},
    {"--product effect:motion-vector --last-eye 0.7,-0.4,0.3", "", SMEARS, {0}},
};

TEST(mixed_as_shaders_do) {
    for (size_t i = 0; i < 2 * sizeof rows / sizeof rows[0]; i++) {
        const size_t at = i / 2;
        const char *const sky = strstr(rows[at].options, "--sky") != NULL ? "" : "--sky none"; /* with a picture, too */
        static const char scene[] = "texture --synthetic sphere --size 40x24 -f 30 --fov 70 -q";
        char path[256], made[256], out[256];
        image picture, numbers, got, eyes;
        const bool surface = strstr(rows[at].options, "intersection") || strstr(rows[at].options, "force-field");
        int hidden = 0;
        tally t = {.name = rows[at].options};
        make_picture(i % 2 == 1, path);
        snprintf(made, sizeof made, "%s", scratch_file("made.npy"));
        snprintf(out, sizeof out, "%s", scratch_file("out.png"));
        printed p = print_of("%s %s %s -o %s", scene, rows[at].options, sky, made);
        printed_free(&p);
        p = print_of("%s %s --product eye -o %s", scene, sky, scratch_file("eyes.npy"));
        printed_free(&p);
        read(scratch_file("eyes.npy"), &eyes);
        p = print_of("%s %s %s --picture %s -o %s", scene, rows[at].options, rows[at].of_picture, path, out);
        assert_string_equal(p.errors, "");
        read(path, &picture);
        read(made, &numbers);
        read(out, &got);
        const uint32_t channels = picture.channels;
        const double most = picture.type == IMAGE_U8 ? 255 : 65535;
        assert_true(got.type == picture.type && got.channels == channels && got.width == WIDTH);
        assert_int_equal(strncmp(got.note, "product=colours", 15), 0);
        assert_true(strtod(strstr(got.note, "scale=") + 6, NULL) == 1 / most);
        for (int k = 0; k < (int)(PIXELS * channels); k++) {
            const int pixel = k / (int)channels, x = pixel % WIDTH, y = pixel / WIDTH;
            const uint32_t channel = (uint32_t)k % channels;
            const float *value = (const float *)numbers.data + (size_t)pixel * numbers.channels;
            const bool before = surface && ((const float *)eyes.data)[pixel] < 9;
            const bool kept = isnan(*value) || channel == 3 || before;
            hidden += before;
            const double want = kept ? sample(&picture, x, y, channel)
                                     : by_hand(rows[at].mix, rows[at].tint, &picture, x, y, channel, value);
            TALLY(&t, fabs(sample(&got, x, y, channel) - want) * most <= (kept ? 0 : 0.5 + 1e-6),
                  "%d,%d channel %u: %.9g, not %.9g", x, y, channel, most * sample(&got, x, y, channel), most * want);
        }
        tally_end(&t);
        assert_true((hidden > 20) == surface);
        printed_free(&p);
        image_free(&eyes);
        image_free(&picture);
        image_free(&numbers);
        image_free(&got);
    }
}

/* The walk of motion blur is that of its vectors. */
TEST(walked_as_the_vector_says) {
    char path[256], outs[2][256];
    image got[2];
    make_picture(false, path);
    for (int i = 0; i < 2; i++) {
        snprintf(outs[i], sizeof outs[i], "%s", scratch_file(i == 0 ? "blur.png" : "vector.png"));
        printed p = print_of("texture --synthetic sphere --size 40x24 --product effect:%s --parameter strength=2 "
                             "--last-eye 1,0,0 --picture %s -o %s",
                             i == 0 ? "MotionBlur" : "velocity", path, outs[i]);
        assert_int_equal(p.status, 0);
        printed_free(&p);
        read(outs[i], &got[i]);
    }
    assert_memory_equal(got[0].data, got[1].data, (size_t)PIXELS * 3);
    image_free(&got[0]);
    image_free(&got[1]);
}
