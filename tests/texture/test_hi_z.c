/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * texture --hi-z: levels of images of any size, even and odd, in both directions, with holes, rounded to other formats.
 * Each texel is the farthest (nearest) of the depths that its place touches in the level below, found by fractions; it
 * is on the safe side of every pixel of the image that it touches; and rounding goes one code at most, to that side.
 */
#include "printed.h"
#include "support.h"
#include "truth.h"

enum { SIDE = 40 };

typedef struct depths {
    int width, height;
    double at[SIDE * SIDE];
} depths;

/* Which texels of n a texel of m touches: from i n/m to (i + 1) n/m. */
static int first_of(int i, int n, int m) {
    return i * n / m;
}
static int end_of(int i, int n, int m) {
    return ((i + 1) * n + m - 1) / m;
}

static void below(const depths *from, bool most, depths *to) {
    to->width = from->width > 1 ? from->width / 2 : 1;
    to->height = from->height > 1 ? from->height / 2 : 1;
    for (int j = 0; j < to->height; j++)
        for (int i = 0; i < to->width; i++) {
            double found = most ? -1 : 2;
            for (int y = first_of(j, from->height, to->height); y < end_of(j, from->height, to->height); y++)
                for (int x = first_of(i, from->width, to->width); x < end_of(i, from->width, to->width); x++)
                    found =
                        most ? fmax(found, from->at[y * from->width + x]) : fmin(found, from->at[y * from->width + x]);
            to->at[j * to->width + i] = found;
        }
}

/* Depths in binary32 or as codes of 16 bits, some of them holes, in "in.npy". */
static void write_image(rng *r, bool codes, int holes, depths *out) {
    float numbers[SIDE * SIDE];
    uint16_t integers[SIDE * SIDE];
    const int count = out->width * out->height;
    for (int i = 0; i < count; i++) {
        const double share = rng_unit(r);
        numbers[i] = (float)(rng_below(r, 2) ? share : 1 - share * share * share);
        integers[i] = (uint16_t)rint((double)numbers[i] * 65535);
        out->at[i] = codes ? integers[i] / 65535.0 : (double)numbers[i];
    }
    for (int i = 0; i < holes && !codes; i++)
        numbers[rng_below(r, (uint64_t)count)] = NAN;
    for (int i = 0; i < count; i++)
        out->at[i] = codes || !isnan(numbers[i]) ? out->at[i] : (double)NAN;
    FILE *f = fopen(truth_path("in.npy"), "wb");
    assert_non_null(f);
    image_writer *w = image_writer_open(f, IMAGE_NPY, codes ? IMAGE_U16 : IMAGE_F32, (uint32_t)out->width,
                                        (uint32_t)out->height, 1, NULL);
    assert_true(w != NULL && image_writer_rows(w, codes ? (const void *)integers : numbers, (uint32_t)out->height) &&
                image_writer_close(w));
    assert_int_equal(fclose(f), 0);
}

/* The level in the file, as window depths. */
static void read_level(const char *format, depths *out) {
    image img;
    image_error error;
    assert_true(image_read(truth_path("map.npy"), &img, &error));
    out->width = (int)img.width;
    out->height = (int)img.height;
    const bool real = strcmp(format, "fp32") == 0;
    assert_int_equal(img.type, real ? IMAGE_F32 : strcmp(format, "unorm8") == 0 ? IMAGE_U8 : IMAGE_U16);
    for (int i = 0; i < out->width * out->height; i++)
        out->at[i] = real                   ? (double)((const float *)img.data)[i]
                     : img.type == IMAGE_U8 ? ((const uint8_t *)img.data)[i] / 255.0
                                            : ((const uint16_t *)img.data)[i] / 65535.0;
    image_free(&img);
}

/* How far apart neighbouring numbers are, window depth. */
static double step_of(const char *format, double d) {
    return strcmp(format, "fp32") == 0     ? ldexp(1, ilogb(fmax(d, 0x1p-126)) - 23)
           : strcmp(format, "unorm8") == 0 ? 1 / 255.0
                                           : 1 / 65535.0;
}

/* How far two depths are apart, without the difference of two that are nearly the same. */
static double apart(double a, double b, bool reversed) {
    const double n = 0.1, f = 100, above = reversed ? n : f, rise = reversed ? f - n : n - f;
    return n * f * (f - n) * fabs(a - b) / ((above + a * rise) * (above + b * rise));
}

/* Whether a texel that is farthest off lay at the eye depth that is said. */
static bool is_worst_at(const depths *level, const depths *got, double off, const json_t *said, bool reversed) {
    const double n = 0.1, f = 100, z = json_number_value(json_object_get(said, "off_z"));
    for (int i = 0; i < got->width * got->height; i++) {
        const double d = reversed ? 1 - level->at[i] : level->at[i];
        if (apart(got->at[i], level->at[i], reversed) >= off * (1 - 1e-9) &&
            fabs(n * f / (f - d * (f - n)) / z - 1) < 1e-9)
            return true;
    }
    return false;
}

static void one_level(rng *r, tally *t) {
    static const char *const formats[] = {"unorm8", "unorm16", "fp32"};
    const bool nearest = rng_below(r, 2), reversed = rng_below(r, 2), most = nearest == reversed,
               codes = rng_below(r, 2);
    const char *own = codes ? "unorm16" : "fp32", *format = rng_below(r, 2) ? own : formats[rng_below(r, 3)];
    depths picture = {.width = 1 + (int)rng_below(r, SIDE), .height = 1 + (int)rng_below(r, SIDE)}, level, got;
    const int last = ilogb(picture.width > picture.height ? picture.width : picture.height);
    const int asked = (int)rng_below(r, (uint64_t)last + 1);
    char words[64];
    uint64_t holes = 0;
    double off = 0, share = 0;
    write_image(r, codes, (int)rng_below(r, 4), &picture);
    for (int i = 0; i < picture.width * picture.height; i++)
        if (isnan(picture.at[i])) { /* could be anywhere */
            picture.at[i] = most ? 1 : 0;
            holes++;
        }
    snprintf(words, sizeof words, "%d%s%s%s", asked, nearest ? ":nearest" : "", format != own ? ":" : "",
             format != own ? format : "");
    printed p = print_of("texture %s -F %s -m %s -n 0.1 -f 100 --hi-z %s --json -o %s", truth_path("in.npy"), own,
                         reversed ? "reversed" : "d3d", words, truth_path("map.npy"));
    assert_int_equal(p.status, 0);
    level = picture;
    for (int i = 0; i < asked; i++) {
        const depths under = level;
        below(&under, most, &level);
    }
    read_level(format, &got);
    TALLY(t, got.width == level.width && got.height == level.height, "%s: %d x %d", words, got.width, got.height);
    for (int i = 0; i < got.width * got.height; i++) {
        const double towards = (got.at[i] - level.at[i]) * (most ? 1 : -1);
        TALLY(t, towards >= 0 && towards < step_of(format, level.at[i]) * (format == own ? 0x1p-40 : 1),
              "%s of %d x %d: texel %d is %.9g, not %.9g", words, picture.width, picture.height, i, got.at[i],
              level.at[i]);
        const double change = apart(got.at[i], level.at[i], reversed);
        if (change > off) { /* quotients of codes are off by 2^-53 each */
            off = change;
            share = 1e-12 + 0x1p-52 * fmax(got.at[i], level.at[i]) / fabs(got.at[i] - level.at[i]);
        }
        const int x0 = first_of(i % got.width, picture.width, got.width),
                  y0 = first_of(i / got.width, picture.height, got.height);
        for (int y = y0; y < end_of(i / got.width, picture.height, got.height); y++)
            for (int x = x0; x < end_of(i % got.width, picture.width, got.width); x++)
                TALLY(t, (got.at[i] - picture.at[y * picture.width + x]) * (most ? 1 : -1) >= 0,
                      "%s of %d x %d: texel %d is on the wrong side of %d,%d", words, picture.width, picture.height, i,
                      x, y);
    }
    json_t *said = json_loads(p.out, 0, NULL);
    assert_non_null(said);
    const double told = json_number_value(json_object_get(said, "off"));
    TALLY(t, fabs(told - off) <= share * off, "%s: %.15g is said, %.15g is lost", words, told, off);
    TALLY(t, told == 0 || is_worst_at(&level, &got, off * (1 - share), said, reversed),
          "%s: nothing is off by %g there", words, told);
    TALLY(t, (uint64_t)json_integer_value(json_object_get(said, "holes")) == holes, "%s: %llu holes", words,
          (unsigned long long)holes);
    TALLY(t, json_integer_value(json_object_get(said, "levels")) == last, "%s: levels", words);
    assert_string_equal(json_string_value(json_object_get(said, "operation")), most ? "maximum" : "minimum");
    assert_string_equal(json_string_value(json_object_get(said, "depth")), nearest ? "nearest" : "farthest");
    assert_string_equal(json_string_value(json_object_get(said, "format")), format);
    json_decref(said);
    printed_free(&p);
}

TEST(levels) {
    rng r = rng_make("hi-z");
    tally t = {.name = "hi-z"};
    for (uint64_t i = test_cases(60, 400, 4000); i > 0; i--)
        one_level(&r, &t);
    tally_end(&t);
}

static void refused(const char *level, const char *option, const char *said) {
    depths picture = {.width = 9, .height = 5};
    rng r = rng_make("hi-z refused");
    write_image(&r, true, 0, &picture);
    const char *const run[] = {truth_path("in.npy"), "-F", "d16", "-m", "d3d", "--hi-z", level, option, "-o",
                               truth_path("map.npy")};
    assert_int_equal(truth_run(run, sizeof run / sizeof run[0]), 2);
    if (!truth_said(said))
        fail_msg("not said: %s", said);
}

TEST(refusals) {
    refused("4", "-q", "--hi-z: must be at most level 3 in an image of 9 x 5, got 4");
    refused("17", "-q", "--hi-z: must be LEVEL, 0 to 16");
    refused("1:middle", "-q", "--hi-z: must be LEVEL, 0 to 16");
    refused("1", "--radial", "--radial: conflicts with --hi-z");
    refused("1", "--csv", "--csv: conflicts with --hi-z");
}

int main(void) {
    return run_listed(truth_folder, truth_folder_end);
}
