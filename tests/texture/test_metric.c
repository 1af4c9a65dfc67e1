/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Metric depth, as sensors and simulators write it: read with --metric it is within what the error map says of the
 * depth that was rounded or truncated, for eye depth, places and effects; holes are counted and never averaged. So it
 * is where a sensor rounded the depth before, on a lattice that the file does not name.
 */
#include <jansson.h>

#include "support.h"
#include "texture/units.h"
#include "truth.h"

typedef struct metric_kind {
    const char *name;
    image_type type;
    double scale, most;  /**< scene units a unit, and the farthest depth */
    double step;         /**< in units, that depths are rounded to before they are stored; 0: none */
    const char *lattice; /**< what they were rounded to before that; null: nothing */
    double level;        /**< its step, of z or 1/z */
    double first;        /**< scene units that it was rounded to multiples of before the file's steps; 0: not so */
} metric_kind;

static const metric_kind kinds[] = {
    {"millimetres", IMAGE_U16, 0.001, 60, 1, NULL, 0, 0},
    {"5000 a metre", IMAGE_U16, 1.0 / 5000, 13, 1, NULL, 0, 0},
    {"bytes", IMAGE_U8, 0.04, 10, 1, NULL, 0, 0},
    {"micrometres", IMAGE_U32, 1e-6, 300, 1, NULL, 0, 0},
    {"metres", IMAGE_F32, 1, 500, 0, NULL, 0, 0},
    {"centimetres", IMAGE_F32, 0.01, 90, 0, NULL, 0, 0},
    {"halves", IMAGE_F16, 1, 100, 0, NULL, 0, 0},
    {"doubles", IMAGE_F64, 1, 1000, 0, NULL, 0, 0},
    {"millimetres in metres", IMAGE_F32, 1, 9, 0.001, NULL, 0, 0},
    {"5000 a metre in metres", IMAGE_F32, 1, 9, 0.0002, NULL, 0, 0},
    {"tenths of a millimetre in metres", IMAGE_F32, 1, 5, 0.0001, NULL, 0, 0},
    {"centimetres in metres", IMAGE_F64, 1, 90, 0.01, NULL, 0, 0},
    {"decimetres in metres", IMAGE_F32, 1, 300, 0.1, NULL, 0, 0},
    {"256 a metre in metres", IMAGE_F32, 1, 100, 1.0 / 256, NULL, 0, 0},
    {"disparity in millimetres", IMAGE_U16, 0.001, 6, 1, "inverse", 0.02, 0},
    {"disparity in metres", IMAGE_F32, 1, 6, 0, "inverse", 0.03, 0},
    {"the last disparity", IMAGE_F32, 1, 118, 0, "inverse", 0.01666, 0},
    {"time of flight", IMAGE_U16, 0.001, 6, 1, "even", 0.0437, 0},
    {"time of flight in metres", IMAGE_F64, 1, 6, 0, "even", 0.0437, 0},
    {"halves in metres", IMAGE_F32, 1, 100, 0, "binary16", 0, 0},
    {"halves in millimetres", IMAGE_U16, 0.001, 60, 1, "binary16", 0, 0},
    {"millimetres of disparity at 5000", IMAGE_U16, 1.0 / 5000, 6, 1, "inverse", 0.02, 0.001},
    {"... scaled by 1.035", IMAGE_U16, 1.0 / 5000, 6, 1, "inverse", 0.02, 0.001035},
    {"... and in millimetres", IMAGE_U16, 0.001, 6, 1, "inverse", 0.03, 0.001076},
    {"... at 400 a metre", IMAGE_U16, 0.0025, 20, 1, "inverse", 0.02, 0.0025 * 1.1},
    {"... of numbers", IMAGE_F32, 1, 6, 0, "inverse", 0.02, 0.001035},
    {"millimetres of time of flight at 5000", IMAGE_U16, 1.0 / 5000, 6, 1, "even", 0.0437, 0.001},
    {"... in numbers", IMAGE_F64, 1, 6, 0, "even", 0.0437, 0.001031},
};
enum { KINDS = sizeof kinds / sizeof kinds[0] };

static double cut(double x, int mode) {
    return mode == 0 ? floor(x + 0.5) : floor(x);
}

static double half_of(double x, int mode) {
    int e;
    frexp(x, &e);
    const int shift = (e - 11 > -24 ? e - 11 : -24);
    return ldexp(mode == 0 ? rint(ldexp(x, -shift)) : floor(ldexp(x, -shift)), shift);
}

/* The level that the sensor makes of a depth. */
static double level_of(const metric_kind *k, double z, int mode) {
    return k->lattice == NULL                ? z
           : *k->lattice == 'b'              ? half_of(z, mode)
           : strcmp(k->lattice, "even") == 0 ? k->level * cut(z / k->level + 0.3, mode) - 0.3 * k->level
                                             : 1 / (k->level * cut(1 / z / k->level, mode));
}

/* How far the next level is at most. */
static double gap_of(const metric_kind *k, double z) {
    const double w = 1 / z - k->level;
    return k->lattice == NULL   ? 0
           : *k->lattice == 'b' ? z * 0x1p-10
           : *k->lattice == 'e' ? k->level
           : w > 0              ? 1 / w - z
                                : INFINITY;
}

static double sample_of(const metric_kind *k, double z, int mode) {
    const double level = level_of(k, z, mode);
    const double x = (k->first > 0 ? k->first * cut(level / k->first, mode) : level) / k->scale;
    if (k->step > 0)
        return k->type < IMAGE_F16 ? cut(x / k->step, mode) : cut(x / k->step, mode) * k->step;
    return k->type == IMAGE_F16 ? half_of(x, mode) : x;
}

/* Depths at random, with holes as the type has them; NaN for a hole. */
static size_t picture(rng *r, const metric_kind *k, double z[PIXELS]) {
    static const double holes[] = {0, NAN, INFINITY, -1};
    static double data[PIXELS];
    const int mode = (int)rng_below(r, 2);
    size_t count = 0;
    for (int i = 0; i < PIXELS; i++) {
        const bool hole = rng_below(r, 8) == 0;
        do
            z[i] = hole ? NAN : rng_log(r, k->most / (k->level > 0 && k->most > 60 ? 150 : 50), k->most);
        while (!hole && isinf(level_of(k, z[i], mode))); /* nearer than none of a disparity */
        count += hole;
        const size_t which = k->type == IMAGE_F32 || k->type == IMAGE_F64 ? rng_below(r, 4) : 0;
        truth_store(data, k->type, (size_t)i, hole ? holes[which] : sample_of(k, z[i], mode));
    }
    truth_write(truth_path("in.npy"), IMAGE_NPY, k->type, data);
    return count;
}

static json_t *statistics(const command *base) {
    command c = *base;
    truth_add(&c, "--json");
    truth_add(&c, "-o");
    truth_add(&c, truth_path("said.json"));
    assert_int_equal(truth_run(c.arguments, c.count), 0);
    json_t *root = json_load_file(truth_path("said.json"), JSON_REJECT_DUPLICATES, NULL);
    assert_non_null(root);
    return root;
}

static double number_in(const json_t *object, const char *name) {
    const json_t *found = json_object_get(object, name);
    assert_true(json_is_number(found));
    return json_number_value(found);
}

static void check_statistics(const metric_kind *k, const command *base, size_t holes, double worst) {
    json_t *root = statistics(base);
    const json_t *eye = json_array_get(json_object_get(root, "errors"), 0);
    const double unbounded = number_in(eye, "unbounded");
    assert_true(number_in(root, "metric") == k->scale);
    assert_true(number_in(root, "invalid") == (double)holes);
    assert_true(number_in(json_object_get(root, "sky"), "pixels") == 0);
    assert_true(number_in(eye, "masked") == (double)holes &&
                number_in(eye, "pixels") + unbounded == (double)(PIXELS - holes));
    if (unbounded == 0 && number_in(eye, "max") < worst)
        fail_msg("%s: off by %g, at most %g", k->name, worst, number_in(eye, "max"));
    assert_string_equal(json_string_value(json_object_get(root, "format_from")), "given");
    assert_string_equal(json_string_value(json_object_get(root, "direction_from")), "given");
    double pixels = 0;
    for (size_t i = 0; i < json_array_size(json_object_get(root, "bands")); i++)
        pixels += number_in(json_array_get(json_object_get(root, "bands"), i), "pixels");
    assert_true(pixels == (double)(PIXELS - holes));
    if (k->step > 0 && k->first == 0) /* that of a first rounding may be all that the samples show */
        assert_relative(number_in(json_object_get(root, "samples"), "step"), k->step * k->scale, 1e-12);
    const json_t *lattice = json_object_get(root, "lattice");
    assert_string_equal(json_string_value(json_object_get(lattice, "name")), k->lattice != NULL ? k->lattice : "file");
    if (k->first == 0) /* of so few pixels a first rounding may be too little to tell */
        assert_string_equal(json_string_value(json_object_get(lattice, "from")),
                            k->lattice != NULL ? "found" : "assumed");
    json_decref(root);
}

/* In so few pixels two roundings one on the other may leave nothing to tell: then the samples are taken as they are, it
 * is said that a sensor may resolve less, and nothing is promised of it. */
static bool left_open(const metric_kind *k, const command *base) {
    if (k->first == 0)
        return false;
    json_t *root = statistics(base);
    const json_t *lattice = json_object_get(root, "lattice");
    const bool open = strcmp(json_string_value(json_object_get(lattice, "name")), "file") == 0 &&
                      strcmp(json_string_value(json_object_get(lattice, "from")), "assumed") == 0;
    json_decref(root);
    return open;
}

static double one_picture(tally *t, rng *r, const metric_kind *k) {
    double z[PIXELS], worst = 0, used = 0;
    float eye[PIXELS], map[PIXELS], place[3 * PIXELS], fog[PIXELS];
    command base = {.count = 0};
    const size_t holes = picture(r, k, z);
    truth_add(&base, truth_path("in.npy"));
    truth_add_number(&base, 0, "--metric", k->scale);
    if (left_open(k, &base))
        return (double)NAN;
    truth_product(&base, "eye.npy", "eye", NULL, false);
    truth_product(&base, "map.npy", "eye", NULL, true);
    truth_floats("eye.npy", 1, eye);
    truth_floats("map.npy", 1, map);
    for (int i = 0; i < PIXELS; i++) {
        const double off = fabs((double)eye[i] - z[i]);
        TALLY(t, isnan(z[i]) ? isnan(eye[i]) && isnan(map[i]) : off <= (double)map[i],
              "%s: %.9g reads %.9g, %g off, not %g", k->name, z[i], (double)eye[i], off, (double)map[i]);
        if (isnan(z[i]))
            continue;
        worst = fmax(worst, off);
        used = fmax(used, off / (double)map[i]);
        /* A whole step where it is not known how depths were rounded, and what binary32 adds. */
        const double step = k->step > 0 ? k->step * k->scale : k->type == IMAGE_F16 ? z[i] * 0x1p-10 : z[i] * 0x1p-23;
        const double most = 1.1 * gap_of(k, (double)eye[i] + 2 * (step + k->first)) + 3 * (step + k->first);
        TALLY(t, (double)map[i] <= (k->lattice != NULL ? most : 1.01 * step) + 4e-7 * z[i], "%s: %.9g may be %g off",
              k->name, z[i], (double)map[i]);
    }
    check_statistics(k, &base, holes, worst);
    truth_product(&base, "place.npy", "position", "view", false);
    truth_product(&base, "map.npy", "position", "view", true);
    truth_floats("place.npy", 3, place);
    truth_floats("map.npy", 1, map);
    for (int i = 0; i < PIXELS; i++) {
        const double half = tan(3.14159265358979323846 / 6);
        const double x = (2.0 * (i % WIDTH) + 1 - WIDTH) / HEIGHT * half * z[i];
        const double y = (HEIGHT - 2.0 * (i / WIDTH) - 1) / HEIGHT * half * z[i];
        const double dx = (double)place[3 * i] - x, dy = (double)place[3 * i + 1] - y,
                     dz = (double)place[3 * i + 2] - z[i];
        TALLY(t,
              isnan(z[i]) ? isnan(place[3 * i]) && isnan(map[i]) : sqrt(dx * dx + dy * dy + dz * dz) <= (double)map[i],
              "%s: a place at %.9g", k->name, z[i]);
    }
    truth_product(&base, "effect.npy", "effect", "fog", false);
    truth_product(&base, "map.npy", "effect", "fog", true);
    truth_floats("effect.npy", 1, fog);
    truth_floats("map.npy", 1, map);
    for (int i = 0; i < PIXELS; i++)
        TALLY(t,
              isnan(z[i]) ? isnan(fog[i]) && isnan(map[i]) : 255 * fabs((double)fog[i] - z[i] / 1000) <= (double)map[i],
              "%s: fog at %.9g: %g, not within %g levels", k->name, z[i], (double)fog[i], (double)map[i]);
    return used;
}

TEST(metric_depth_is_within_what_is_said) {
    const uint64_t rounds = test_cases(2, 3, 200);
    tally t = {.name = "metric"};
    rng r = rng_make("metric");
    double used[KINDS] = {0};
    uint64_t open = 0;
    for (uint64_t i = 0; i < rounds; i++)
        for (size_t k = 0; k < KINDS; k++) {
            const double share = one_picture(&t, &r, &kinds[k]);
            used[k] = fmax(used[k], share);
            if (isnan(share))
                open++;
        }
    print_message("# %llu of %llu left open\n", (unsigned long long)open, (unsigned long long)(rounds * KINDS));
    assert_true(open * 20 <= rounds * KINDS);
    for (size_t k = 0; k < KINDS; k++) {
        print_message("# %s: %.3f of the bound is used\n", kinds[k].name, used[k]);
        assert_true(used[k] > 0.4);
    }
    tally_end(&t);
}

static bool was_said(const char *words) {
    char line[512];
    bool found = false;
    FILE *said = fopen(truth_path("said"), "r");
    assert_non_null(said);
    while (fgets(line, sizeof line, said) != NULL)
        found = found || strstr(line, words) != NULL;
    fclose(said);
    return found;
}

/* The near end of what the first pixel may be: what was cut off lies above the file's numbers, and those of binary16.
 */
static void check_near_end(const command *base, const char *words, bool inverse, bool half, double step, double z) {
    const char *const again = strchr(words, '@');
    const double end = z - 0.5 * (0.001 + (again != NULL ? atof(again + 1) : 0));
    const double near = inverse ? 1 / (1 / end + step) : end - (half ? 0.5 * ldexp(1, ilogb(end) - 10) : step);
    command c = *base;
    truth_add(&c, "--pixel");
    truth_add(&c, "0,0");
    json_t *root = statistics(&c);
    const json_t *pixel = json_array_get(json_object_get(root, "pixels"), 0);
    assert_scene(number_in(pixel, "lo"), near, 1e-5 * z);
    assert_true(number_in(pixel, "lo") <= near * (1 + 1e-14) && number_in(pixel, "hi") > z);
    json_decref(root);
}

/* The last level but 0 has no end: 200 m, which is 1 of 1/200 a metre; 100 m, which is 2, ends there. */
TEST(the_last_level_has_no_end) {
    static const char *const words[] = {"--metric", "0.01", "--lattice", "inverse:200"};
    static double data[PIXELS];
    float map[PIXELS];
    command base = {.count = 0};
    for (int i = 0; i < PIXELS; i++)
        truth_store(data, IMAGE_U16, (size_t)i, i == 0 ? 20000 : i == 1 ? 10000 : 1000);
    truth_write(truth_path("in.npy"), IMAGE_NPY, IMAGE_U16, data);
    truth_add(&base, truth_path("in.npy"));
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++)
        truth_add(&base, words[i]);
    truth_product(&base, "map.npy", "eye", NULL, true);
    truth_floats("map.npy", 1, map);
    assert_true(isinf(map[0]) && map[1] >= 100 && map[1] < 101 && map[2] < 1);
    json_t *root = statistics(&base);
    assert_true(number_in(json_array_get(json_object_get(root, "errors"), 0), "unbounded") == 1);
    json_decref(root);
}

/* The lattice given by --lattice is taken: its step, and the error of each pixel by a formula. */
TEST(a_lattice_is_said) {
    static const struct said {
        const char *words;
        bool inverse, half;
        double step; /* 0: as many from the nearest to the farthest depth */
        double levels;
    } said[] = {
        {"stereo:600,0.08,0.125", true, false, 0.125 / 48, 0},
        {"stereo:500,0.1", true, false, 0.02, 0},
        {"inverse:200", true, false, 0.005, 0},
        {"inverse:200,0.3", true, false, 0.005, 0},
        {"even:0.025", false, false, 0.025, 0},
        {"even:0.025,0.01", false, false, 0.025, 0},
        {"levels:256", false, false, 0, 256},
        {"inverse-levels:1024", true, false, 0, 1024},
        {"inverse:200@0.002", true, false, 0.005, 0},
        {"even:0.025,0.01@0.003", false, false, 0.025, 0},
        {"binary16", false, true, 0, 0},
        {"file", false, false, 0, 0},
    };
    rng r = rng_make("said");
    static double data[PIXELS];
    double z[PIXELS], least = INFINITY, most = 0;
    float map[PIXELS];
    for (int i = 0; i < PIXELS; i++) {
        z[i] = 0.001 * floor(1000 * rng_log(&r, 0.5, 9));
        truth_store(data, IMAGE_U16, (size_t)i, rint(1000 * z[i]));
        least = fmin(least, z[i]);
        most = fmax(most, z[i]);
    }
    truth_write(truth_path("in.npy"), IMAGE_NPY, IMAGE_U16, data);
    for (size_t k = 0; k < sizeof said / sizeof said[0]; k++) {
        command c = {.count = 0};
        truth_add(&c, truth_path("in.npy"));
        truth_add_number(&c, 0, "--metric", 0.001);
        truth_add(&c, "--lattice");
        truth_add(&c, said[k].words);
        json_t *root = statistics(&c), *lattice = json_object_get(root, "lattice");
        const double step = said[k].levels == 0 ? said[k].step
                            : said[k].inverse   ? (1 / least - 1 / most) / (said[k].levels - 1)
                                                : (most - least) / (said[k].levels - 1);
        assert_string_equal(json_string_value(json_object_get(lattice, "from")), "given");
        if (step > 0)
            assert_relative(number_in(lattice, "step"), step, 1e-9);
        json_decref(root);
        truth_product(&c, "map.npy", "eye", NULL, true);
        truth_floats("map.npy", 1, map);
        for (int i = 0; i < PIXELS; i++) {
            const char *const again = strchr(said[k].words, '@');
            const double end = z[i] + 0.001 + (again != NULL ? atof(again + 1) : 0), half = ldexp(1, ilogb(end) - 10);
            const double far =
                said[k].inverse ? 1 / (1 / end - step) - z[i] : end - z[i] + (said[k].half ? half : step);
            assert_scene((double)map[i], far, 1e-5 * far + 2e-7 * z[i]);
            assert_true((double)map[i] >= far);
        }
        check_near_end(&c, said[k].words, said[k].inverse, said[k].half, step, z[0]);
    }
}

/* Multiples of a centimetre in millimetres: a centimetre for what was rounded to it, a millimetre for the file. */
TEST(multiples_are_levels) {
    rng r = rng_make("multiples");
    static double data[PIXELS];
    float map[PIXELS];
    command c = {.count = 0};
    for (int i = 0; i < PIXELS; i++)
        truth_store(data, IMAGE_U16, (size_t)i, 10 * floor(rng_uniform(&r, 100, 400)));
    truth_write(truth_path("in.npy"), IMAGE_NPY, IMAGE_U16, data);
    truth_add(&c, truth_path("in.npy"));
    truth_add_number(&c, 0, "--metric", 0.001);
    json_t *root = statistics(&c);
    const json_t *lattice = json_object_get(root, "lattice");
    assert_string_equal(json_string_value(json_object_get(lattice, "name")), "even");
    assert_string_equal(json_string_value(json_object_get(lattice, "from")), "found");
    assert_scene(number_in(lattice, "step"), 0.01, number_in(lattice, "step_error"));
    json_decref(root);
    truth_product(&c, "map.npy", "eye", NULL, true);
    truth_floats("map.npy", 1, map);
    for (int i = 0; i < PIXELS; i++)
        assert_scene((double)map[i], 0.011, 3e-5);
}

/* The levels of each band, counted, and how far the nearest in use is from the next. */
TEST(bands_count_levels) {
    static const char *const said[] = {"inverse:200,0.3", "even:0.025,0.01", "binary16"};
    rng r = rng_make("bands");
    static double data[PIXELS];
    for (int i = 0; i < PIXELS; i++)
        truth_store(data, IMAGE_U16, (size_t)i, rint(rng_log(&r, 500, 9000)));
    truth_write(truth_path("in.npy"), IMAGE_NPY, IMAGE_U16, data);
    for (size_t kind = 0; kind < 3; kind++) {
        command c = {.count = 0};
        truth_add(&c, truth_path("in.npy"));
        truth_add_number(&c, 0, "--metric", 0.001);
        truth_add(&c, "--lattice");
        truth_add(&c, said[kind]);
        json_t *root = statistics(&c);
        for (size_t i = 0; i < json_array_size(json_object_get(root, "bands")); i++) {
            const json_t *band = json_array_get(json_object_get(root, "bands"), i);
            const double lo = number_in(band, "lo"), hi = number_in(band, "hi"), at = number_in(band, "gap_z");
            double count = 0;
            for (int k = 0; k < 40000; k++) {
                const double z = kind == 0   ? 200 / (k - 0.3)
                                 : kind == 1 ? 0.01 + 0.025 * k
                                             : ldexp(1024 + k % 1024, k / 1024 - 24);
                count += z >= lo && z < hi;
            }
            const double gap = kind == 0 ? 1 / (1 / at - 0.005) - at : kind == 1 ? 0.025 : ldexp(1, ilogb(at) - 10);
            assert_true(number_in(band, "available") == count);
            assert_relative(number_in(band, "interval"), gap, 1e-9);
        }
        json_decref(root);
    }
}

/* The numbers that a file has, where it has fewer than its lattice: halves in any unit, and steps of millimetres. */
TEST(bands_count_numbers_of_the_file) {
    static const struct {
        image_type type;
        double scale, step;
    } kinds_of[] = {{IMAGE_F16, 1, 0}, {IMAGE_F16, 0.01, 0}, {IMAGE_F16, 1e-4, 0}, {IMAGE_F32, 1, 0.01}};
    rng r = rng_make("numbers of the file");
    static double data[PIXELS];
    for (size_t kind = 0; kind < sizeof kinds_of / sizeof kinds_of[0]; kind++) {
        const double scale = kinds_of[kind].scale, step = kinds_of[kind].step;
        command c = {.count = 0};
        for (int i = 0; i < PIXELS; i++) {
            const double x = rng_log(&r, 0.3, 9) * (scale < 1e-3 ? 1e-5 / scale : 1 / scale);
            truth_store(data, kinds_of[kind].type, (size_t)i, step > 0 ? rint(x / step) * step : half_of(x, 0));
        }
        truth_write(truth_path("in.npy"), IMAGE_NPY, kinds_of[kind].type, data);
        truth_add(&c, truth_path("in.npy"));
        truth_add_number(&c, 0, "--metric", scale);
        truth_add(&c, "--lattice");
        truth_add(&c, "file");
        json_t *root = statistics(&c);
        assert_true(json_array_size(json_object_get(root, "bands")) > 3);
        for (size_t i = 0; i < json_array_size(json_object_get(root, "bands")); i++) {
            const json_t *band = json_array_get(json_object_get(root, "bands"), i);
            const double lo = number_in(band, "lo") * (1 - 1e-9), hi = number_in(band, "hi") * (1 - 1e-9),
                         at = number_in(band, "gap_z") / scale * (1 + 1e-9);
            double count = 0;
            for (int k = 1; k < 31 * 1024; k++) {
                const double half = k < 1024 ? ldexp(k, -24) : ldexp(1024 + k % 1024, k / 1024 - 25);
                const double z = step > 0 ? k * step : half * scale;
                count += z >= lo && z < hi;
            }
            const double gap = step > 0 ? step : fmax(ldexp(1, ilogb(at) - 10), 0x1p-24) * scale;
            if (number_in(band, "available") != count)
                fail_msg("kind %zu, from %g: %g instead of %g", kind, lo, number_in(band, "available"), count);
            assert_relative(number_in(band, "interval"), gap, 1e-6);
        }
        json_decref(root);
    }
}

/* Depths in steps as others read them, from 1 to 65534; what reaches further is refused, and nothing is written. */
TEST(a_png_counts_the_steps_of_as) {
    static double data[PIXELS];
    rng r = rng_make("steps");
    for (int k = 0; k < 12; k++) {
        const double step = k % 2 != 0 ? 0.001 : 1.0 / 256, farthest = step * (65534.4 + 0.2 * (k % 4 == 3));
        double z[PIXELS];
        for (int i = 0; i < PIXELS; i++) {
            z[i] = (double)(float)(i == 0 ? farthest : i == 1 ? 0.4 * step : rng_log(&r, 0.6 * step, farthest));
            truth_store(data, IMAGE_F32, (size_t)i, z[i]);
        }
        truth_write(truth_path("in.npy"), IMAGE_NPY, IMAGE_F32, data);
        remove(truth_path("out.png"));
        command c = {.count = 0};
        char words[32];
        snprintf(words, sizeof words, "even:%.9g", step);
        const char *const path = truth_path("out.png");
        for (const char *const *word = (const char *[]){truth_path("in.npy"), "--metric", "1", "--as", words,
                                                        "--product", "eye", "-q", "-o", path, NULL};
             *word != NULL; word++)
            truth_add(&c, *word);
        assert_int_equal(truth_run(c.arguments, c.count), k % 4 == 3 ? 2 : 0);
        image img;
        image_error error;
        assert_int_equal(image_read(path, &img, &error), k % 4 != 3);
        if (k % 4 == 3) {
            assert_true(was_said("of which a PNG holds 65534, up to 65.534, and the farthest depth is 65.535"));
            continue;
        }
        assert_int_equal(img.type, IMAGE_U16);
        for (int i = 0; i < PIXELS; i++) {
            const double exact = z[i] / step, got = ((const uint16_t *)img.data)[i];
            assert_true(fabs(got - exact) <= 0.5 + 0x1p-22 * exact);
        }
        image_free(&img);
    }
}

TEST(what_is_no_lattice_is_refused) {
    static const char *const bad[] = {"",         "stereo",  "stereo:500", "stereo:500,0.1,1,2",
                                      "even:0",   "even:-1", "even:",      "even:1,",
                                      "levels:1", "file:1",  "halves"};
    command c = {.count = 0};
    truth_add(&c, truth_path("in.npy"));
    truth_add_number(&c, 0, "--metric", 0.001);
    truth_add(&c, "--lattice");
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        command d = c;
        truth_add(&d, bad[i]);
        assert_int_equal(truth_run(d.arguments, d.count), 2);
        assert_true(was_said("--lattice: must be a name of"));
    }
}

/* --as rounds to levels: those of the formula, with an error map that holds, and they are found again. */
TEST(levels_are_written_and_found) {
    static const struct {
        const char *words, *name;
        double step, offset; /* 0: of 200 levels between the ends */
    } cases[] = {{"stereo:400,0.1,0.5", "inverse", 0.0125, 0},
                 {"inverse:200,0.4", "inverse", 0.005, -0.002},
                 {"even:0.03,0.01", "even", 0.03, 0.01},
                 {"inverse-levels:200", "inverse", 0, 0},
                 {"levels:200", "even", 0, 0},
                 {"binary16", "binary16", 0, 0}};
    rng r = rng_make("as");
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
        static double data[PIXELS];
        double z[PIXELS], least = INFINITY, most = 0;
        float out[PIXELS], map[PIXELS];
        for (int i = 0; i < PIXELS; i++) {
            z[i] = (double)(float)rng_log(&r, 0.5, 9);
            least = fmin(least, z[i]);
            most = fmax(most, z[i]);
            truth_store(data, IMAGE_F32, (size_t)i, z[i]);
        }
        const bool inverse = *cases[k].name == 'i', half = *cases[k].name == 'b';
        const double range = inverse ? 1 / least - 1 / most : most - least;
        const double step = cases[k].step > 0 ? cases[k].step : range / 199;
        const double offset = cases[k].step > 0 ? cases[k].offset : inverse ? 1 / most : least;
        truth_write(truth_path("in.npy"), IMAGE_NPY, IMAGE_F32, data);
        command c = {.count = 0};
        truth_add(&c, truth_path("in.npy"));
        truth_add_number(&c, 0, "--metric", 1);
        truth_add(&c, "--as");
        truth_add(&c, cases[k].words);
        truth_product(&c, "eye.npy", "eye", NULL, false);
        truth_product(&c, "map.npy", "eye", NULL, true);
        truth_floats("eye.npy", 1, out);
        truth_floats("map.npy", 1, map);
        for (int i = 0; i < PIXELS; i++) {
            const double at = inverse ? 1 / z[i] : z[i], level = offset + step * floor((at - offset) / step + 0.5);
            const double expected = half ? half_of(z[i], 0) : inverse ? 1 / level : level;
            assert_relative((double)out[i], expected, 1e-6);
            assert_true((double)map[i] >= fabs((double)out[i] - z[i]));
            assert_true((double)map[i] <= fabs((double)out[i] - z[i]) + 1e-6 * z[i]);
        }
        command back = {.count = 0};
        truth_add(&back, truth_path("eye.npy"));
        truth_add_number(&back, 0, "--metric", 1);
        json_t *root = statistics(&back);
        const json_t *lattice = json_object_get(root, "lattice");
        assert_string_equal(json_string_value(json_object_get(lattice, "name")), cases[k].name);
        assert_string_equal(json_string_value(json_object_get(lattice, "from")), "found");
        if (!half)
            assert_scene(number_in(lattice, "step"), step, number_in(lattice, "step_error"));
        json_decref(root);
    }
}

/* 65535 is what some sensors write where they saw nothing: a hole, if nothing else is far. */
TEST(the_largest_word_may_be_a_hole) {
    rng r = rng_make("top");
    for (int far = 0; far < 2; far++) {
        static double data[PIXELS];
        size_t holes = 0;
        command c = {.count = 0};
        for (int i = 0; i < PIXELS; i++) {
            const double top = far ? 65534 : 30000;
            const double x = i == 0 ? top : i == 1 || rng_below(&r, 9) == 0 ? 65535 : floor(rng_log(&r, 500, top));
            truth_store(data, IMAGE_U16, (size_t)i, x);
            holes += x == 65535;
        }
        truth_write(truth_path("in.npy"), IMAGE_NPY, IMAGE_U16, data);
        truth_add(&c, truth_path("in.npy"));
        truth_add_number(&c, 0, "--metric", 0.001);
        json_t *root = statistics(&c);
        assert_true(number_in(root, "invalid") == (far ? 0 : (double)holes));
        assert_relative(number_in(root, "hi"), far ? 65.535 : 30, 1e-9);
        json_decref(root);
    }
}

/* So is what stands a hundred times as far as all else in numbers, whichever it is, or where --far is. */
TEST(the_largest_number_may_be_a_hole) {
    static const struct {
        image_type type;
        double top;
        bool hole;
        const char *far;
    } cases[] = {
        {IMAGE_F32, 1e10, true, NULL},     {IMAGE_F64, 3.4e38, true, NULL},     {IMAGE_F16, 65504, true, NULL},
        {IMAGE_F32, 900.5, true, NULL},    {IMAGE_F32, 899.5, false, NULL},     {IMAGE_U32, 4294967295, true, NULL},
        {IMAGE_U32, 899, false, NULL},     {IMAGE_F32, 65.504, true, "65.504"}, {IMAGE_F32, 20, false, "20.1"},
        {IMAGE_F16, 65.5, true, "65.504"}, {IMAGE_U32, 20, true, "20"},         {IMAGE_F64, 20, false, "inf"}};
    rng r = rng_make("numbers");
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
        static double data[PIXELS];
        float eye[PIXELS];
        size_t holes = 0;
        command c = {.count = 0};
        for (int i = 0; i < PIXELS; i++) {
            const bool top = i > 0 && rng_below(&r, 9) == 0;
            truth_store(data, cases[k].type, (size_t)i, top ? cases[k].top : i == 0 ? 9 : 1 + (double)rng_below(&r, 8));
            holes += top;
        }
        truth_write(truth_path("in.npy"), IMAGE_NPY, cases[k].type, data);
        truth_add(&c, truth_path("in.npy"));
        truth_add_number(&c, 0, "--metric", 1);
        if (cases[k].far != NULL) {
            truth_add(&c, "--far");
            truth_add(&c, cases[k].far);
        }
        json_t *root = statistics(&c);
        assert_true(number_in(root, "invalid") == (cases[k].hole ? (double)holes : 0));
        assert_true(cases[k].hole == (number_in(root, "hi") < 9.1));
        json_decref(root);
        truth_product(&c, "eye.npy", "eye", NULL, false);
        truth_floats("eye.npy", 1, eye);
        size_t missing = 0;
        for (int i = 0; i < PIXELS; i++)
            missing += isnan(eye[i]) ? 1 : 0;
        assert_true(missing == (cases[k].hole ? holes : 0));
    }
}

/* Where the image shows another, or is on no level of it, that is named. */
TEST(contradictions_are_named) {
    rng r = rng_make("contradictions");
    double z[PIXELS];
    const metric_kind seen = {"disparity", IMAGE_U16, 0.001, 6, 1, "inverse", 0.02, 0},
                      none = {"none", IMAGE_U16, 0.001, 6, 1, NULL, 0, 0};
    static const struct {
        bool seen;
        const char *lattice, *words;
    } cases[] = {{true, "inverse:50", NULL},
                 {true, "inverse:51", "the samples lie on another: inverse, in steps of 0.0"},
                 {true, "even:0.01", "the samples lie on another: inverse"},
                 {false, "even:0.02", "pixels are on none of its levels"},
                 {false, "file", NULL}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        command c = {.count = 0};
        picture(&r, cases[i].seen ? &seen : &none, z);
        truth_add(&c, truth_path("in.npy"));
        truth_add_number(&c, 0, "--metric", 0.001);
        truth_add(&c, "--lattice");
        truth_add(&c, cases[i].lattice);
        json_decref(statistics(&c));
        assert_true(was_said(cases[i].words != NULL ? cases[i].words : "--lattice") == (cases[i].words != NULL));
    }
}

/* Without --metric: numbers above 1 are refused, integers with holes are doubted; and what has no depth is refused. */
TEST(it_is_suspected) {
    rng r = rng_make("suspected");
    double z[PIXELS];
    static double zeros[PIXELS];
    command c = {.count = 0};
    truth_add(&c, truth_path("in.npy"));
    picture(&r, &kinds[4], z);
    assert_int_equal(truth_run(c.arguments, c.count), 2);
    assert_true(was_said("--metric"));
    picture(&r, &(metric_kind){"millimetres", IMAGE_U16, 0.001, 20, 1, NULL, 0, 0}, z);
    json_t *root = statistics(&c);
    assert_string_equal(json_string_value(json_object_get(root, "direction_from")), "assumed"); /* no sky, but holes */
    json_decref(root);
    command quiet = c;
    truth_add(&quiet, "--product");
    truth_add(&quiet, "eye");
    truth_add(&quiet, "-o");
    truth_add(&quiet, truth_path("eye.npy"));
    assert_int_equal(truth_run(quiet.arguments, quiet.count), 0);
    assert_true(was_said("may be metric depth, whole numbers with 0 for holes: --metric mm reads "));
    truth_add(&quiet, "-q");
    assert_int_equal(truth_run(quiet.arguments, quiet.count), 0);
    assert_false(was_said("metric"));
    truth_write(truth_path("in.npy"), IMAGE_NPY, IMAGE_U16, zeros);
    truth_add_number(&c, 0, "--metric", 0.001);
    assert_int_equal(truth_run(c.arguments, c.count), 2);
    assert_true(was_said("no sample is a depth"));
}

/* Holes in a window depth are no reason to refuse it, and no depth either. */
TEST(holes_are_counted) {
    rng r = rng_make("holes");
    static double data[PIXELS];
    float eye[PIXELS];
    size_t holes = 0;
    command c = {.count = 0};
    for (int i = 0; i < PIXELS; i++) {
        const bool hole = rng_below(&r, 5) == 0;
        truth_store(data, IMAGE_F32, (size_t)i, hole ? NAN : rng_uniform(&r, 0.5, 0.9));
        holes += hole;
    }
    truth_write(truth_path("in.npy"), IMAGE_NPY, IMAGE_F32, data);
    truth_add(&c, truth_path("in.npy"));
    truth_product(&c, "eye.npy", "eye", NULL, false);
    truth_floats("eye.npy", 1, eye);
    for (int i = 0; i < PIXELS; i++)
        assert_true(!isnan(((float *)(void *)data)[i]) == !isnan(eye[i]));
    json_t *root = statistics(&c);
    assert_true(number_in(root, "invalid") == (double)holes);
    assert_true(number_in(json_object_get(root, "sky"), "pixels") == 0);
    assert_string_equal(json_string_value(json_object_get(root, "mapping_from")), "assumed");
    for (size_t i = 0; i < json_array_size(json_object_get(root, "errors")); i++)
        assert_true(number_in(json_array_get(json_object_get(root, "errors"), i), "masked") == (double)holes);
    json_decref(root);
}

int main(void) {
    return run_listed(truth_folder, truth_folder_end);
}

/* The unit of cameras that see most of a picture is likely where at least half of it has depth, and not below. */
TEST(units_of_sparse_depth) {
    enum { SIDE = 40, ALL = SIDE * SIDE };
    static uint16_t samples[ALL];
    const image img = {.width = SIDE, .height = SIDE, .channels = 1, .type = IMAGE_U16, .data = samples};
    for (int filled = ALL / 4; filled <= ALL; filled += ALL / 20) {
        unit_reading all[UNITS_MAX];
        bool tum = false;
        for (int i = 0; i < ALL; i++) /* 1 to 4 m in the units of TUM, 20 to 78 m in those of KITTI */
            samples[i] = i < filled ? (uint16_t)(5000 + i * 9) : 0;
        for (size_t i = units_find(&img, all); i > 0; i--)
            tum = tum || strcmp(all[i - 1].option, "--metric tum") == 0;
        assert_int_equal(tum, 2 * filled >= ALL);
    }
}
