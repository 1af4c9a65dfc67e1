/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Files as robots and simulators write them: ROS's compressedDepth, CARLA's RGB, the units that --metric knows by name.
 * Each depth is within its error map of the one that was stored, and what no header says is said to be assumed.
 */
#include <jansson.h>

#include "exr_made.h"
#include "support.h"
#include "texture/device.h"
#include "truth.h"

enum { HEADER = 12, FILE_MOST = 1 << 14 };

static size_t file_of(const char *path, uint8_t *bytes) {
    FILE *in = fopen(path, "rb");
    assert_non_null(in);
    const size_t size = fread(bytes, 1, FILE_MOST, in);
    fclose(in);
    assert_true(size > 0 && size < FILE_MOST);
    return size;
}

static void put_float(uint8_t *at, float x) {
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    for (int i = 0; i < 4; i++)
        at[i] = (uint8_t)(bits >> 8 * i);
}

/* The header, and a PNG of the samples. @return the size, of bytes that are also in the file */
static size_t message(const double *samples, float a, float b, uint8_t bytes[FILE_MOST]) {
    static double data[PIXELS];
    for (int i = 0; i < PIXELS; i++)
        truth_store(data, IMAGE_U16, (size_t)i, samples[i]);
    truth_write(truth_path("in.png"), IMAGE_PNG, IMAGE_U16, data);
    memset(bytes, 0, HEADER);
    put_float(bytes + 4, a);
    put_float(bytes + 8, b);
    const size_t size = HEADER + file_of(truth_path("in.png"), bytes + HEADER);
    FILE *out = fopen(truth_path("in.npy"), "wb");
    assert_true(out != NULL && fwrite(bytes, 1, size, out) == size && fclose(out) == 0);
    return size;
}

static double number_in(const json_t *object, const char *name) {
    const json_t *found = json_object_get(object, name);
    assert_true(json_is_number(found));
    return json_number_value(found);
}

/* Depths in metres against the product and its map, both in this file's own unit. @return the share that is used */
static double check_depths(tally *t, const char *name, const command *c, const double *z, double unit) {
    float eye[PIXELS], map[PIXELS];
    double used = 0;
    truth_product(c, "eye.npy", "eye", NULL, false);
    truth_product(c, "map.npy", "eye", NULL, true);
    truth_floats("eye.npy", 1, eye);
    truth_floats("map.npy", 1, map);
    for (int i = 0; i < PIXELS; i++) {
        const double off = fabs((double)eye[i] - z[i] / unit);
        TALLY(t, isnan(z[i]) ? isnan(eye[i]) : off <= (double)map[i], "%s: %.9g reads %.9g, not within %g", name, z[i],
              (double)eye[i], (double)map[i]);
        if (!isnan(z[i]))
            used = fmax(used, off / (double)map[i]);
    }
    return used;
}

/* As its codec quantizes: in binary32, cut off to 16 bits. */
static double quantized(float z, float q, float most, float *a, float *b) {
    *a = q * (q + 1);
    *b = 1 - *a / most;
    return z < most ? floor((double)(*a / z + *b)) : 0;
}

TEST(compressed_depth_of_numbers) {
    static uint8_t bytes[FILE_MOST];
    tally t = {.name = "compressedDepth"};
    rng r = rng_make("compressedDepth");
    static const struct {
        const char *unit;
        double in_metres;
    } units[] = {{"1", 1}, {"0.01", 0.01}, {"mm", 0.001}, {"1cm", 0.01}, {"tum", 0.0002}};
    enum { UNITS = sizeof units / sizeof units[0] };
    double used = 0, in_cm = 0, said[UNITS] = {0};
    for (uint64_t i = 0; i < test_cases(4, 12, 200); i++) {
        const float q = i == 0 ? 100 : (float)rng_log(&r, 20, 250), most = i == 0 ? 10 : (float)rng_log(&r, 4, 20);
        double z[PIXELS], samples[PIXELS], holes = 0;
        float a = 0, b = 0;
        for (int k = 0; k < PIXELS; k++) {
            const float x = (float)rng_uniform(&r, (double)q * (double)q / 60000, 1.1 * (double)most);
            samples[k] = quantized(x, q, most, &a, &b);
            holes += samples[k] == 0;
            z[k] = samples[k] == 0 ? NAN : (double)x;
        }
        message(samples, a, b, bytes);
        command c = {.count = 0};
        truth_add(&c, truth_path("in.npy"));
        used = fmax(used, check_depths(&t, "metres", &c, z, 1));
        json_t *root = truth_statistics(&c);
        const json_t *lattice = json_object_get(root, "lattice");
        assert_string_equal(json_string_value(json_object_get(lattice, "name")), "inverse");
        assert_string_equal(json_string_value(json_object_get(lattice, "from")), "given");
        assert_relative(number_in(lattice, "step"), 1 / (double)a, 1e-7);
        assert_true(number_in(root, "metric") == 1 && number_in(root, "invalid") == holes);
        json_decref(root);
        assert_false(truth_said("assumed"));
        command other = c;
        truth_add(&other, "--unit");
        truth_add(&other, "cm");
        in_cm = fmax(in_cm, check_depths(&t, "centimetres", &other, z, 0.01));
        root = truth_statistics(&other);
        lattice = json_object_get(root, "lattice");
        assert_string_equal(json_string_value(json_object_get(lattice, "from")), "given");
        assert_relative(number_in(lattice, "step"), 0.01 / (double)a, 1e-7);
        json_decref(root);
        for (size_t k = 0; k < UNITS; k++) { /* what names the unit leaves the lattice that the header gives */
            command named = c;
            truth_add(&named, "--metric");
            truth_add(&named, units[k].unit);
            said[k] = fmax(said[k], check_depths(&t, units[k].unit, &named, z, 1 / units[k].in_metres));
            root = truth_statistics(&named);
            lattice = json_object_get(root, "lattice");
            assert_string_equal(json_string_value(json_object_get(lattice, "from")), "given");
            assert_string_equal(json_string_value(json_object_get(root, "metric_from")), "given");
            assert_relative(number_in(lattice, "step"), 1 / (double)a / units[k].in_metres, 1e-7);
            assert_true(number_in(lattice, "off_pixels") == 0);
            json_decref(root);
        }
    }
    print_message("# compressedDepth: %.3f of the bound is used, %.3f in cm\n", used, in_cm);
    assert_true(used > 0.4 && in_cm > 0.4);
    for (size_t k = 0; k < UNITS; k++)
        assert_true(said[k] > 0.4);
    tally_end(&t);
}

/* 16UC1: nobody sets A and B, so anything may be there; what cannot be meant leaves millimetres, which is said. */
TEST(compressed_depth_of_integers) {
    static const float unset[][2] = {{0, 0},       {NAN, 1},          {1e-40F, 0}, {10100, NAN}, {10100, 2},
                                     {-5, -5},     {INFINITY, -1},    {1e20F, -1}, {0.5F, 0},    {4.59e-41F, 1e-30F},
                                     {1e9F, 0.5F}, {10100, -INFINITY}};
    static uint8_t bytes[FILE_MOST];
    tally t = {.name = "integers"};
    rng r = rng_make("integers");
    for (size_t i = 0; i < sizeof unset / sizeof unset[0]; i++) {
        double z[PIXELS], samples[PIXELS];
        for (int k = 0; k < PIXELS; k++) {
            samples[k] = floor(rng_uniform(&r, 0, 9000));
            z[k] = samples[k] > 0 ? 0.001 * samples[k] : NAN;
        }
        message(samples, unset[i][0], unset[i][1], bytes);
        command c = {.count = 0};
        truth_add(&c, truth_path("in.npy"));
        check_depths(&t, "millimetres", &c, z, 1);
        assert_true(truth_said("--metric mm is assumed"));
        json_t *root = truth_statistics(&c);
        assert_true(number_in(root, "metric") == 0.001);
        json_decref(root);
        truth_add(&c, "--metric");
        truth_add(&c, "tum");
        check_depths(&t, "given", &c, z, 5);
        assert_false(truth_said("assumed"));
    }
    tally_end(&t);
}

/* Cut anywhere, with any header, and of other PNGs: refused in words, or read. */
TEST(damaged_messages) {
    static uint8_t bytes[FILE_MOST];
    static const uint32_t others[][2] = {{IMAGE_U8, 1}, {IMAGE_U16, 2}, {IMAGE_U8, 4}};
    rng r = rng_make("damaged");
    double samples[PIXELS];
    image img;
    image_error error;
    for (int k = 0; k < PIXELS; k++)
        samples[k] = (double)rng_below(&r, 65536);
    const size_t size = message(samples, 10100, -1009, bytes);
    for (size_t k = 0; k < size; k++) {
        error.text[0] = '\0';
        assert_false(image_parse(bytes, k, &img, &error));
        assert_true(error.text[0] != '\0');
    }
    for (int k = 0; k < 200; k++) {
        for (int i = 0; i < HEADER; i++)
            bytes[i] = (uint8_t)rng_below(&r, 256);
        assert_true(image_parse(bytes, size, &img, &error));
        assert_true(img.file == IMAGE_ROS && (img.type == IMAGE_U16 || img.type == IMAGE_F32));
        image_free(&img);
    }
    for (size_t k = 0; k < sizeof others / sizeof others[0]; k++) {
        FILE *out = fopen(truth_path("in.png"), "wb");
        assert_non_null(out);
        static const uint8_t zeros[8 * WIDTH];
        image_writer *w = image_writer_open(out, IMAGE_PNG, others[k][0], WIDTH, 1, others[k][1], NULL);
        assert_true(w != NULL && image_writer_rows(w, zeros, 1) && image_writer_close(w) && fclose(out) == 0);
        const size_t all = HEADER + file_of(truth_path("in.png"), bytes + HEADER);
        assert_false(image_parse(bytes, all, &img, &error));
        assert_non_null(strstr(error.text, "compressedDepth must have one channel of u2, got"));
    }
}

/* Steps that are known, from what is published of each, with how far a device was found to be off. */
TEST(steps_that_are_known) {
    static const struct {
        const char *begins;
        double step, within;
    } rows[] = {{"Kinect 1", 0.125 / (575.815739 * 0.075), 0.004},   /* eighths of a pixel */
                {"OAK-D", 1 / 29.896, 0.002},                        /* whole pixels, measured */
                {"compressedDepth", 1 / (100.0 * (100 + 1)), 1e-4}}; /* depth_quantization (depth_quantization + 1) */
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        for (int way = -1; way <= 1; way++) {
            const double inside = rows[i].step * (1 + 0.9 * way * rows[i].within),
                         outside = rows[i].step * (1 + 1.1 * (way != 0 ? way : 9) * rows[i].within);
            const char *name = device_like(GRAIN_INVERSE, inside);
            if (name == NULL || strstr(name, rows[i].begins) != name)
                fail_msg("%g is like %s, not %s", inside, name != NULL ? name : "none", rows[i].begins);
            assert_null(device_like(GRAIN_INVERSE, outside));
            assert_null(device_like(GRAIN_EVEN, inside));
        }
}

/* The formula of its documentation, by the default far. */
TEST(carla) {
    tally t = {.name = "carla"};
    rng r = rng_make("carla");
    static uint8_t texels[3 * PIXELS];
    double z[PIXELS], used = 0;
    for (int nearest = 0; nearest < 2; nearest++) {
        for (int i = 0; i < PIXELS; i++) {
            z[i] = i == 0 ? 9.97000992 : rng_log(&r, 0.2, 900);
            const uint32_t code = (uint32_t)floor(z[i] / 1000 * (256 * 256 * 256 - 1) + 0.5 * nearest);
            texels[3 * i] = (uint8_t)(code % 256);
            texels[3 * i + 1] = (uint8_t)(code / 256 % 256);
            texels[3 * i + 2] = (uint8_t)(code / 65536);
        }
        FILE *out = fopen(truth_path("in.png"), "wb");
        image_writer *w = image_writer_open(out, IMAGE_PNG, IMAGE_U8, WIDTH, HEIGHT, 3, NULL);
        assert_true(w != NULL && image_writer_rows(w, texels, HEIGHT) && image_writer_close(w) && fclose(out) == 0);
        command c = {.count = 0};
        truth_add(&c, truth_path("in.png"));
        truth_add(&c, "--packing");
        truth_add(&c, "carla");
        used = fmax(used, check_depths(&t, nearest ? "nearest" : "cut off", &c, z, 1));
        assert_true(truth_maximum(&c) < 2e-4); /* of cells of 6e-5 */
    }
    print_message("# carla: %.3f of the bound is used\n", used);
    assert_true(used > 0.4);
    tally_end(&t);
}

/* PGM's lengths are those of PNG, whatever the largest that it may hold; codes are those of a format that ends there.
 */
static size_t pgm(const double *samples, unsigned most) {
    size_t largest = 0;
    FILE *out = fopen(truth_path("in.npy"), "wb");
    assert_non_null(out);
    fprintf(out, "P5\n%d %d\n%u\n", WIDTH, HEIGHT, most);
    for (int i = 0; i < PIXELS; i++) {
        fputc((int)samples[i] >> 8, out);
        fputc((int)samples[i] & 255, out);
        largest = samples[i] > samples[largest] ? (size_t)i : largest;
    }
    fclose(out);
    return largest;
}

TEST(greys) {
    static const unsigned most[] = {65535, 10000, 4095};
    tally t = {.name = "greys"};
    rng r = rng_make("greys");
    double z[PIXELS], samples[PIXELS];
    for (size_t k = 0; k < sizeof most / sizeof most[0]; k++) {
        command c = {.count = 0};
        for (int i = 0; i < PIXELS; i++) {
            samples[i] = i % 7 == 0 ? 0 : floor(rng_uniform(&r, 300, 4000));
            z[i] = i % 7 == 0 ? (double)NAN : 0.001 * samples[i];
        }
        const size_t largest = pgm(samples, most[k]);
        truth_add(&c, truth_path("in.npy"));
        command window = c;
        truth_add(&c, "--metric");
        truth_add(&c, "mm");
        check_depths(&t, "PGM", &c, z, 1);
        if (most[k] == 65535)
            continue;
        assert_int_equal(truth_run(window.arguments, window.count), 2);
        assert_true(truth_said("its samples are shares of"));
        truth_add(&window, "--format");
        truth_add(&window, most[k] == 4095 ? "unorm12" : "unorm16");
        truth_add(&window, "--mapping");
        truth_add(&window, "linear");
        if (most[k] == 10000) {
            assert_int_equal(truth_run(window.arguments, window.count), 2);
            continue;
        }
        json_t *root = truth_statistics(&window);
        assert_relative(number_in(root, "hi"), samples[largest] / 4095 * 1000, 1e-9);
        json_decref(root);
    }
    tally_end(&t);
}

/* Bits that are said to be moved are moved back: depths by formulas, and what the file shows is said where nobody says
 * it. */
TEST(moved_bits_by_name) {
    static double data[PIXELS];
    static const char *const names[] = {"sun3d", "mm,rotated", "0.1mm,rotated", "mm,swapped", "nyu-raw"};
    rng r = rng_make("moved");
    for (size_t k = 0; k < sizeof names / sizeof names[0]; k++) {
        double z[PIXELS];
        float eye[PIXELS];
        command c = {.count = 0};
        for (int i = 0; i < PIXELS; i++) {
            const unsigned v = k == 4 ? 400 + (unsigned)rng_below(&r, 650) : 600 + (unsigned)rng_below(&r, 9000);
            const unsigned swapped = v % 256 * 256 + v / 256, rotated = (v << 3 | v >> 13) & 65535;
            z[i] = k == 4 ? 351.3 / (1092.5 - v) : k == 2 ? 0.0001 * v : 0.001 * v;
            truth_store(data, IMAGE_U16, (size_t)i, k < 3 ? rotated : swapped);
        }
        truth_write(truth_path("in.png"), IMAGE_PNG, IMAGE_U16, data);
        truth_add(&c, truth_path("in.png"));
        truth_add(&c, "--metric");
        truth_add(&c, names[k]);
        truth_product(&c, "eye.npy", "eye", NULL, false);
        truth_floats("eye.npy", 1, eye);
        for (int i = 0; i < PIXELS; i++)
            assert_relative((double)eye[i], z[i], 1e-6);
        json_t *root = truth_statistics(&c);
        assert_string_equal(json_string_value(json_object_get(root, "moved_from")), "given");
        json_decref(root);
        assert_false(truth_said("may be no depths"));
    }
    command wrong = {.count = 0};
    truth_add(&wrong, truth_path("in.png"));
    truth_add(&wrong, "--metric");
    truth_add(&wrong, "mm,turned");
    assert_int_equal(truth_run(wrong.arguments, wrong.count), 2);
    assert_true(truth_said("must have one of rotated, swapped, halves behind the comma"));
}

/* Units by name are those lengths, in any scene unit. */
TEST(units_by_name) {
    static const struct {
        const char *name;
        double metres;
    } names[] = {{"mm", 0.001}, {"tum", 1 / 5000.0}, {"kitti", 1 / 256.0}};
    static double data[PIXELS];
    for (int i = 0; i < PIXELS; i++)
        truth_store(data, IMAGE_U16, (size_t)i, 1000 + 7 * i % 64);
    truth_write(truth_path("in.png"), IMAGE_PNG, IMAGE_U16, data);
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        command c = {.count = 0};
        truth_add(&c, truth_path("in.png"));
        truth_add(&c, "--metric");
        truth_add(&c, names[i].name);
        json_t *root = truth_statistics(&c);
        assert_relative(number_in(root, "metric"), names[i].metres, 1e-15);
        assert_relative(number_in(root, "lo"), 1000 * names[i].metres, 1e-12);
        json_decref(root);
        truth_add(&c, "--unit");
        truth_add(&c, "cm");
        root = truth_statistics(&c);
        assert_relative(number_in(root, "lo"), 100000 * names[i].metres, 1e-12);
        json_decref(root);
    }
}

/* Millimetres of a Kinect, with holes; of other steps; codes of a depth buffer, whose sky is 0; nothing of them but the
 * first is taken for metric depth. */
static void picture(rng *r, int kind, bool hole_is_top, double *samples) {
    const double step = kind == 0 ? 0.0028953 : 0.0021;
    for (int i = 0; i < PIXELS; i++) {
        const double z = rng_log(r, 0.8, 4.5), level = 1 / (step * floor(1 / z / step));
        samples[i] = i % 11 == 0 ? (hole_is_top ? 65535 : 0)
                     : kind < 2  ? rint(1000 * level)
                     : kind == 2 ? rint(65535 * 0.1 / z)
                     : kind == 3 ? floor(rng_uniform(r, 800, 4500))
                                 : rint(1000 * z);
    }
    for (int i = 0; i < PIXELS && kind == 5; i++)
        samples[i] = i % 11 == 0 ? 40000 : samples[i]; /* no holes, and something far */
}

TEST(millimetres_are_assumed) {
    rng r = rng_make("assumed");
    static double data[PIXELS];
    double samples[PIXELS];
    for (int kind = 0; kind < 6; kind++)
        for (int top = 0; top < 2; top++) {
            picture(&r, kind, top, samples);
            for (int i = 0; i < PIXELS; i++)
                truth_store(data, IMAGE_U16, (size_t)i, samples[i]);
            truth_write(truth_path("in.png"), IMAGE_PNG, IMAGE_U16, data);
            command c = {.count = 0};
            truth_add(&c, truth_path("in.png"));
            json_t *root = truth_statistics(&c);
            const char *from = json_string_value(json_object_get(root, "metric_from"));
            assert_true(kind == 0 ? strcmp(from, "assumed") == 0 : from == NULL);
            assert_true(truth_said("--metric mm is assumed: its levels are those of a sensor") == (kind == 0));
            assert_true(kind > 0 || number_in(root, "metric") == 0.001);
            json_decref(root);
            truth_add(&c, top ? "--near" : "--format"); /* whoever says so is believed */
            truth_add(&c, top ? "0.1" : "unorm16");
            root = truth_statistics(&c);
            assert_true(json_is_null(json_object_get(root, "metric_from")));
            json_decref(root);
            assert_false(truth_said("is assumed: its levels"));
        }
}

/* Z of an EXR above 1 is a distance; a colour is not, nor is what goes below 0. */
TEST(numbers_called_depth_are_assumed) {
    static const struct {
        const char *channel;
        float least, most;
        bool assumed;
    } cases[] = {{"Z", 2, 30, true},
                 {"view.depth", 0.25F, 3, true},
                 {"R", 2, 30, false},
                 {"Z", -2, 30, false},
                 {"Z", 0.25F, 0.75F, false}};
    rng r = rng_make("called");
    static float z[PIXELS];
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
        for (int i = 0; i < PIXELS; i++)
            z[i] = i % 9 == 0 ? (float)INFINITY : (float)rng_uniform(&r, (double)cases[k].least, (double)cases[k].most);
        const exr_made made = {
            .type = IMAGE_F32, .channel = cases[k].channel, .width = WIDTH, .height = HEIGHT, .samples = z};
        if (exr_make(truth_path("in.npy"), &made) != NULL)
            skip();
        command c = {.count = 0};
        truth_add(&c, truth_path("in.npy"));
        const bool window = cases[k].most < 1;
        if (!cases[k].assumed && !window) {
            assert_int_equal(truth_run(c.arguments, c.count), 2);
            continue;
        }
        json_t *root = truth_statistics(&c);
        const char *from = json_string_value(json_object_get(root, "metric_from"));
        assert_true(cases[k].assumed ? from != NULL && strcmp(from, "assumed") == 0 : from == NULL);
        assert_true(truth_said("--metric 1 is assumed: its channel is called depth") == cases[k].assumed);
        assert_true(number_in(root, "invalid") == 27);
        json_decref(root);
    }
}

int main(void) {
    return run_listed(truth_folder, truth_folder_end);
}
