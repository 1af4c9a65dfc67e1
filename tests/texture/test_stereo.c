/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Raw disparity, as cameras and data sets store it: with --stereo its depth is focal x baseline / disparity, each true
 * depth lies within the error map and within what --pixel says, however the disparity was rounded, and holes stay. The
 * step of depth, the detour by a depth buffer, and the rows of data sheets are compared with formulas of this test.
 */
#include <jansson.h>

#include "support.h"
#include "truth.h"

typedef struct stereo_kind {
    const char *name, *words; /* of --stereo */
    image_type type;
    double constant;     /* focal x baseline */
    double offset, step; /* pixels, of 1 in a sample */
    double grid;         /* samples are multiples of it; 0: binary32 */
    double least, most;  /* depths */
    double hole;
} stereo_kind;

/* OpenNI's shift k is at 1200 mm x 75 mm / (75 mm - .1042 mm x 10 ((k - 800)/4 - .375)), its tables have cm. */
static double openni(double k) {
    return 0.01 * 120 * 7.5 / (7.5 - 0.1042 * ((k - 800) / 4 - 0.375));
}

static const stereo_kind kinds[] = {
    {"8 bits", "412.5,16cm", IMAGE_U8, 66, 0, 1, 1, 0.3, 30, 0},
    {"8 bits, times 4", "focal=412.5,baseline=0.16m,step=1/4", IMAGE_U8, 66, 0, 0.25, 4, 1.1, 30, 0},
    {"8 bits, times 3", "focal=412.5,baseline=0.16m,step=1/3", IMAGE_U8, 66, 0, 1.0 / 3, 3, 0.85, 20, 0},
    {"KITTI", "baseline=540mm,focal=721.5377,step=1/256", IMAGE_U16, 721.5377 * 0.54, 0, 1.0 / 256, 1, 2, 90, 0},
    {"Cityscapes", "cityscapes", IMAGE_U16, 2262.52 * 0.209313, -1.0 / 256, 1.0 / 256, 1, 4, 300, 0},
    {"RealSense", "d435", IMAGE_U16, 674.419 * 0.05, 0, 1.0 / 32, 1, 0.2, 10, 0},
    {"OpenNI", "kinect1", IMAGE_U16, 575.815739 * 0.075, 136.175984, -0.125, 1, 0.5, 9, 2047},
    {"OpenNI in numbers", "kinect1", IMAGE_F32, 575.815739 * 0.075, 136.175984, -0.125, 1, 0.5, 9, 2047},
    {"OpenCV", "700,120mm", IMAGE_F32, 84, 0, 1, 1.0 / 16, 0.7, 40, -1},
    {"OpenCV in integers", "700,0.12,0,1/16", IMAGE_U16, 84, 0, 1.0 / 16, 1, 0.7, 40, 0},
    {"doubles", "700,0.12,-3.3,0.1", IMAGE_F64, 84, -3.3, 0.1, 1, 0.7, 40, NAN},
    {"below 0", "focal=1050,baseline=1,step=-1", IMAGE_F32, 1050, 0, -1, 0, 5, 900, 0},
    {"Middlebury", "middlebury", IMAGE_F32, 3979.911 * 0.193001, 124.343, 1, 0, 2, 5.8, INFINITY},
    {"binary16", "400,0.1", IMAGE_F16, 40, 0, 1, 0, 0.5, 30, 0},
    {"binary16 of small numbers", "0.04,0.1", IMAGE_F16, 0.004, 0, 1, 0, 5, 900, 0},
};
enum { KINDS = sizeof kinds / sizeof kinds[0] };

static double depth_of(const stereo_kind *k, double sample) {
    return k->constant / (k->offset + k->step * sample);
}

static double half_of(double x) {
    int e;
    frexp(x, &e);
    e = e > -13 ? e : -13; /* below 2^-14 in steps of 2^-24 */
    return ldexp(rint(ldexp(x, 11 - e)), e - 11);
}

/* The sample that is stored of a depth: to nearest, or cut off. */
static double sample_of(const stereo_kind *k, double z, bool cut) {
    const double x = (k->constant / z - k->offset) / k->step;
    return k->grid > 0            ? k->grid * (cut ? floor(x / k->grid) : rint(x / k->grid))
           : k->type == IMAGE_F16 ? half_of(x)
                                  : (double)(float)x;
}

/* How far a depth can be off that is stored so: half a step farther and one nearer, or as is said. */
static double off_of(const stereo_kind *k, double sample, const char *rounding) {
    const double here = depth_of(k, sample);
    const double down = *rounding == 'z' ? 0 : 0.5, up = *rounding == 'n' ? 0.5 : 1;
    return fmax(fabs(depth_of(k, sample - down * k->grid) - here), fabs(depth_of(k, sample + up * k->grid) - here));
}

static size_t picture(rng *r, const stereo_kind *k, bool cut, double z[PIXELS], double samples[PIXELS]) {
    static double data[PIXELS];
    size_t holes = 0;
    for (int i = 0; i < PIXELS; i++) {
        const bool hole = rng_below(r, 8) == 0;
        z[i] = hole ? NAN : rng_log(r, k->least, k->most);
        samples[i] = hole ? k->hole : sample_of(k, z[i], cut);
        holes += hole;
        truth_store(data, k->type, (size_t)i, samples[i]);
    }
    truth_write(truth_path("in.npy"), IMAGE_NPY, k->type, data);
    return holes;
}

static double number_in(const json_t *object, const char *name) {
    const json_t *found = json_object_get(object, name);
    assert_true(json_is_number(found));
    return json_number_value(found);
}

/* `levels`: from the least sample to the greatest, both of them. */
static void check_statistics(const stereo_kind *k, const command *base, size_t holes, double levels) {
    json_t *root = truth_statistics(base);
    const json_t *lattice = json_object_get(root, "lattice"), *gaps = json_object_get(lattice, "gaps");
    assert_true(number_in(root, "invalid") == (double)holes);
    assert_true(json_is_null(json_object_get(root, "metric")));
    assert_relative(number_in(json_object_get(root, "stereo"), "focal") *
                        number_in(json_object_get(root, "stereo"), "baseline"),
                    k->constant, 1e-14);
    assert_relative(number_in(json_object_get(root, "stereo"), "step"), k->step, 1e-15);
    assert_string_equal(json_string_value(json_object_get(lattice, "name")), k->grid > 0 ? "inverse" : "file");
    if (k->grid > 0)
        assert_true(number_in(lattice, "levels") == levels);
    for (size_t i = 0; k->grid > 0 && i < 4; i++) {
        static const double at[] = {1, 2, 5, 10};
        const double pixels = fabs(k->step) * k->grid, behind = k->constant / at[i] - pixels;
        const json_t *gap = json_object_get(json_array_get(gaps, i), "gap");
        assert_true(behind > 0 ? json_is_number(gap) : json_is_null(gap));
        if (behind > 0)
            assert_relative(json_number_value(gap), k->constant / behind - at[i], 1e-9);
    }
    double pixels = 0;
    for (size_t i = 0; i < json_array_size(json_object_get(root, "bands")); i++)
        pixels += number_in(json_array_get(json_object_get(root, "bands"), i), "pixels") +
                  0 * number_in(json_array_get(json_object_get(root, "bands"), i), "hi"); /* which is not infinite */
    assert_true(pixels == (double)(PIXELS - holes));
    json_decref(root);
}

static void check_pixel(const stereo_kind *k, const command *base, int i, const double *z, const double *samples,
                        const char *rounding) {
    char text[24];
    command c = *base;
    snprintf(text, sizeof text, "%d,%d", i % WIDTH, i / WIDTH);
    truth_add(&c, "--pixel");
    truth_add(&c, text);
    json_t *root = truth_statistics(&c);
    const json_t *pixel = json_array_get(json_object_get(root, "pixels"), 0);
    assert_string_equal(json_string_value(json_object_get(pixel, "state")), isnan(z[i]) ? "hole" : "depth");
    if (!isnan(z[i])) {
        assert_relative(number_in(pixel, "z"), depth_of(k, samples[i]), k->type == IMAGE_F64 ? 1e-7 : 1e-12);
        assert_true(number_in(pixel, "lo") <= z[i] && z[i] <= number_in(pixel, "hi"));
        const double down = *rounding == 'z' ? 0 : 0.5, up = *rounding == 'n' ? 0.5 : 1;
        const double a = depth_of(k, samples[i] - down * k->grid), b = depth_of(k, samples[i] + up * k->grid);
        if (k->grid > 0) {
            assert_relative(number_in(pixel, "code"), samples[i], 1e-12);
            assert_relative(number_in(pixel, "lo"), fmin(a, b), 1e-9);
            assert_relative(number_in(pixel, "hi"), fmax(a, b), 1e-9);
        }
    }
    json_decref(root);
}

/* @return the share of the bound that is used */
static double one_picture(tally *t, rng *r, const stereo_kind *k) {
    static const char *const roundings[] = {"any", "nearest", "zero"};
    const size_t said = rng_below(r, 3);
    const bool cut = said == 0 ? rng_below(r, 2) == 0 : said == 2;
    double z[PIXELS], samples[PIXELS], used = 0;
    float eye[PIXELS], map[PIXELS];
    command base = {.count = 0};
    const size_t holes = picture(r, k, cut && k->grid > 0, z, samples);
    truth_add(&base, truth_path("in.npy"));
    truth_add(&base, "--stereo");
    truth_add(&base, k->words);
    if (said > 0 && k->grid > 0) {
        truth_add(&base, "--rounding");
        truth_add(&base, roundings[said]);
    }
    truth_product(&base, "eye.npy", "eye", NULL, false);
    truth_product(&base, "map.npy", "eye", NULL, true);
    truth_floats("eye.npy", 1, eye);
    truth_floats("map.npy", 1, map);
    for (int i = 0; i < PIXELS; i++) {
        const double off = fabs((double)eye[i] - z[i]), is = depth_of(k, samples[i]);
        TALLY(t, isnan(z[i]) ? isnan(eye[i]) && isnan(map[i]) : off <= (double)map[i],
              "%s: %.9g reads %.9g, %g off, not %g", k->name, z[i], (double)eye[i], off, (double)map[i]);
        if (isnan(z[i]))
            continue;
        TALLY(t, fabs((double)eye[i] - is) <= 2e-7 * is, "%s: sample %.9g reads %.9g, is %.9g", k->name, samples[i],
              (double)eye[i], is);
        const double most = k->grid > 0 ? off_of(k, samples[i], roundings[said]) : 4 * is * is / k->constant;
        TALLY(t, k->grid == 0 || (double)map[i] <= most * (1 + 1e-5) + 2e-7 * is, "%s: %.9g may be %g off, not %g",
              k->name, z[i], (double)map[i], most);
        used = fmax(used, off / (double)map[i]);
    }
    double least = INFINITY, most = -INFINITY;
    for (int i = 0; i < PIXELS; i++) {
        least = isnan(z[i]) ? least : fmin(least, samples[i]);
        most = isnan(z[i]) ? most : fmax(most, samples[i]);
    }
    check_statistics(k, &base, holes, (most - least) / k->grid + 1);
    for (int i = 0; i < 3; i++)
        check_pixel(k, &base, (int)rng_below(r, PIXELS), z, samples, roundings[said]);
    return used;
}

TEST(disparity_is_within_what_is_said) {
    const uint64_t rounds = test_cases(2, 8, 300);
    tally t = {.name = "stereo"};
    rng r = rng_make("stereo");
    double used[KINDS] = {0};
    for (uint64_t i = 0; i < rounds; i++)
        for (size_t k = 0; k < KINDS; k++)
            used[k] = fmax(used[k], one_picture(&t, &r, &kinds[k]));
    for (size_t k = 0; k < KINDS; k++) {
        print_message("# %s: %.3f of the bound is used\n", kinds[k].name, used[k]);
        assert_true(used[k] > (kinds[k].grid > 0 ? 0.9 : 0.3));
    }
    tally_end(&t);
}

/* OpenNI's own table of depths, whose shifts the row of kinect1 turns into disparity. */
TEST(shifts_of_openni) {
    for (int k = 300; k < 1080; k++)
        assert_relative(depth_of(&kinds[6], k), openni(k), 2e-6);
}

/* People had to type this: a reversed buffer of 8 bits whose near plane has the largest disparity. */
TEST(the_detour_has_the_same_numbers) {
    rng r = rng_make("detour");
    double z[PIXELS], samples[PIXELS];
    float eye[PIXELS], other[PIXELS];
    const stereo_kind k = {"detour", NULL, IMAGE_U8, 1.6153 * 255, 0, 1, 1, 1.7, 200, 0};
    command c = {.count = 0}, detour = {.count = 0};
    picture(&r, &k, false, z, samples);
    truth_add(&c, truth_path("in.npy"));
    truth_add(&c, "--stereo");
    truth_add(&c, "focal=823.803,baseline=0.5");
    truth_product(&c, "eye.npy", "eye", NULL, false);
    truth_floats("eye.npy", 1, eye);
    static const char *const words[] = {"-n", "1.6153", "-f", "inf", "-F", "unorm8", "-m", "reversed", "--sky", "0"};
    truth_add(&detour, truth_path("in.npy"));
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++)
        truth_add(&detour, words[i]);
    truth_product(&detour, "map.npy", "eye", NULL, false);
    truth_floats("map.npy", 1, other);
    for (int i = 0; i < PIXELS; i++)
        assert_true(isnan(z[i]) ? isnan(eye[i]) && isnan(other[i])
                                : fabs((double)eye[i] / (double)other[i] - 1) < 4e-7);
}

/* The focal length is the camera's: places without --fov, the centre from --intrinsics. */
TEST(places_by_the_focal_length) {
    rng r = rng_make("places");
    const stereo_kind *k = &kinds[3];
    double z[PIXELS], samples[PIXELS];
    float place[3 * PIXELS];
    for (int with = 0; with < 2; with++) {
        const double cx = with ? 5.25 : WIDTH / 2.0, cy = with ? 2 : HEIGHT / 2.0, f = 721.5377;
        command c = {.count = 0};
        picture(&r, k, false, z, samples);
        truth_add(&c, truth_path("in.npy"));
        truth_add(&c, "--stereo");
        truth_add(&c, k->words);
        if (with) {
            truth_add(&c, "--intrinsics");
            truth_add(&c, "721.5377,721.5377,5.25,2");
        }
        truth_product(&c, "place.npy", "position", NULL, false);
        truth_floats("place.npy", 3, place);
        for (int i = 0; i < PIXELS; i++) {
            const double is = depth_of(k, samples[i]);
            if (isnan(z[i]))
                continue;
            assert_true(fabs((double)place[3 * i] - (i % WIDTH + 0.5 - cx) / f * is) < 1e-6 * is);
            assert_true(fabs((double)place[3 * i + 1] + (i / WIDTH + 0.5 - cy) / f * is) < 1e-6 * is);
            assert_true(fabs((double)place[3 * i + 2] - is) < 1e-6 * is);
        }
    }
}

/* Depths of disparities have no planes: these are taken where something is made or said of a pixel that has a use for
 * them, and else refused by their name, whatever else is asked for. */
TEST(planes_without_a_use) {
    static const char *const planes[][3] = {{"--near", "0.25", "--near:"},
                                            {"--far", "200", "--far:"},
                                            {"--preset", "unity", "--preset:"},
                                            {"--platform", "chrome-d3d", "--platform:"}};
    static const struct {
        const char *words[2], *file;
        bool of_use;
    } asked[] = {{{NULL}, "said.csv", false},
                 {{"--histogram", "image.svg"}, NULL, false},
                 {{"--json", "--full"}, "said.json", false},
                 {{"--pixel", "1,1"}, "said.csv", true},
                 {{"--product", "eye"}, "eye.npy", true}};
    tally t = {.name = "planes"};
    rng r = rng_make("planes without a use");
    double z[PIXELS], samples[PIXELS];
    picture(&r, &kinds[3], false, z, samples);
    for (size_t i = 0; i < sizeof planes / sizeof planes[0]; i++)
        for (size_t k = 0; k < sizeof asked / sizeof asked[0]; k++) {
            command c = {.count = 0};
            truth_add(&c, truth_path("in.npy"));
            truth_add(&c, "--stereo");
            truth_add(&c, kinds[3].words);
            truth_add(&c, planes[i][0]);
            truth_add(&c, planes[i][1]);
            for (int w = 0; w < 2 && asked[k].words[w] != NULL; w++)
                truth_add(&c, w == 1 && asked[k].file == NULL ? truth_path(asked[k].words[w]) : asked[k].words[w]);
            if (asked[k].file != NULL) {
                truth_add(&c, "-o");
                truth_add(&c, truth_path(asked[k].file));
            }
            const int status = truth_run(c.arguments, c.count);
            TALLY(&t, asked[k].of_use ? status == 0 : status == 2 && truth_said(planes[i][2]), "%s %s: %d",
                  planes[i][0], asked[k].words[0] != NULL ? asked[k].words[0] : "alone", status);
        }
    tally_end(&t);
}

static json_t *run_json(const char *words) {
    char line[512];
    snprintf(line, sizeof line, "%s %s --json >%s 2>%s", getenv("DEPTHPREC"), words, truth_path("said.json"),
             truth_path("said"));
    json_t *root = system(line) == 0 ? json_load_file(truth_path("said.json"), 0, NULL) : NULL;
    return root;
}

/* Each row: its levels by a formula of what it lists, or a refusal; its disparities are read where it has any. */
TEST(rows_of_data_sheets) {
    static const struct sheet { /* what the sheets say, by hand: metres of 1/z, or of z, a level */
        const char *name;
        double inverse, even;
    } sheets[] = {
        {"kinect1", 0.1042 * 0.25 / (1.2 * 7.5), 0}, /* a shift is 1/4 of a pixel of .1042 mm */
        {"xtion", 0.1042 * 0.25 / (1.2 * 7.5), 0},
        {"tum", 0.1042 * 0.25 / (1.2 * 7.5), 0},
        {"nyu", 0.1042 * 0.25 / (1.2 * 7.5), 0},
        {"scannet", 0.1042 * 0.25 / (1.2 * 7.5), 0},
        {"kinect2", 0, 0.001},
        {"azure-kinect", 0, 0.001},
        {"d415", 1 / (32 * 0.055 * 640 / 0.637070260807493), 0}, /* tan 32.5 degrees */
        {"d435", 1 / (32 * 0.05 * 640 / 0.948964938616687), 0},  /* tan 43.5 */
        {"d455", 1 / (32 * 0.095 * 640 / 0.948964938616687), 0},
        {"oak-d", 1 / (882.5 * 0.075), 0},
        {"kitti", 0, 1.0 / 256},
        {"kitti-stereo", 1 / (256 * (339.5242 + 44.85728)), 0},
        {"cityscapes", 1 / (256 * 2262.52 * 0.209313), 0},
    };
    json_t *list = run_json("list sensors");
    const json_t *items = json_object_get(list, "items");
    size_t with = 0, focal_lengths = 0;
    assert_true(json_array_size(items) >= 22);
    for (size_t i = 0; i < json_array_size(items); i++) {
        const char *name = json_string_value(json_object_get(json_array_get(items, i), "name"));
        const struct sheet *sheet = NULL;
        char words[160];
        for (size_t k = 0; k < sizeof sheets / sizeof sheets[0]; k++)
            sheet = strcmp(sheets[k].name, name) == 0 ? &sheets[k] : sheet;
        snprintf(words, sizeof words, "table --lattice %s --at 1m,2m,4m,9.5m", name);
        json_t *root = run_json(words);
        const bool half = strcmp(name, "hypersim") == 0;
        assert_true((sheet != NULL || half) == (root != NULL));
        if (root == NULL)
            assert_true(truth_said("has no lattice that is published"));
        for (size_t k = 0; sheet != NULL && k < 4; k++) {
            static const double at[] = {1, 2, 4, 9.5};
            const json_t *row = json_array_get(json_object_get(root, "rows"), k);
            const double s = sheet->inverse, z = at[k];
            assert_relative(number_in(row, "step"), s > 0 ? z / (1 - z * s) - z : sheet->even, 1e-5);
            assert_relative(number_in(row, "error"), s > 0 ? z / (1 - z * s / 2) - z : sheet->even / 2, 1e-5);
        }
        const char *text = json_string_value(json_object_get(json_array_get(items, i), "sheet"));
        const char *part = text != NULL ? strstr(text, " pixel, focal length ") : NULL;
        double pixel, focal, millimetres;
        if (sheet != NULL && sheet->inverse > 0) { /* a level is that part of a pixel's disparity */
            assert_non_null(part);
            while (part > text && part[-1] != ' ')
                part--;
            assert_int_equal(sscanf(part, "%lf pixel, focal length %lf, baseline %lf mm", &pixel, &focal, &millimetres),
                             3);
            assert_relative(pixel / (focal * millimetres / 1000), sheet->inverse, 1e-5);
            focal_lengths++;
        }
        with += sheet != NULL;
        json_decref(root);
    }
    assert_true(focal_lengths == 11 && with == sizeof sheets / sizeof sheets[0]);
    json_decref(list);
}

/* Depths as the sheets have them, or said to be in none; of RealSense what 126 pixels see, the least there is. */
TEST(depths_of_data_sheets) {
    static const struct range {
        const char *name;
        double nearest, farthest;
    } ranges[] = {{"kinect2", 0.5, 8},
                  {"azure-kinect", 0.25, 5.46},
                  {"zed2", 0.3, 20},
                  {"astra", 0.6, 8},
                  {"oak-d", 882.5 * 0.075 / 190, 15}, /* extended disparity ends there */
                  {"diode", 0.6, 350},
                  {"d415", 640 / 0.637070260807493 * 0.055 / 126, 10},
                  {"d435", 640 / 0.948964938616687 * 0.05 / 126, 10},
                  {"d455", 640 / 0.948964938616687 * 0.095 / 126, 10}};
    json_t *list = run_json("list sensors");
    const json_t *items = json_object_get(list, "items");
    for (size_t i = 0; i < json_array_size(items); i++) {
        const json_t *item = json_array_get(items, i);
        const char *sheet = json_string_value(json_object_get(item, "sheet")), *semicolon = strchr(sheet, ';');
        assert_non_null(semicolon);
        const bool usual = strncmp(semicolon, "; not published, usual ", 23) == 0;
        for (size_t k = 0; k < sizeof ranges / sizeof ranges[0]; k++) {
            double nearest = 0, farthest = 0;
            if (strcmp(json_string_value(json_object_get(item, "name")), ranges[k].name) != 0)
                continue;
            assert_false(usual);
            assert_int_equal(sscanf(semicolon, "; %lf to %lf m", &nearest, &farthest), 2);
            assert_true(fabs(nearest - ranges[k].nearest) < 0.005);
            assert_true(farthest == ranges[k].farthest);
        }
        const char *name = json_string_value(json_object_get(item, "name"));
        assert_true(strcmp(name, "hypersim") != 0 || usual);
        assert_non_null(json_string_value(json_object_get(item, "source")));
    }
    json_decref(list);
}

/* Without a word of what 1 in a sample is: the unit where levels or parts of a metre tell it, else two at least. */
TEST(what_is_a_unit) {
    static double data[PIXELS];
    static const struct guessed {
        double scale, least, most; /* samples a metre, and depths */
        image_type type;
    } all[] = {{1000, 0.6, 6, IMAGE_U16}, {5000, 0.6, 6, IMAGE_U16}, {5000, 0.6, 11, IMAGE_U16},
               {1, 0.7, 9, IMAGE_F32},    {1000, 0.3, 4, IMAGE_F32}, {100, 400, 680, IMAGE_F32}};
    static const struct told {
        double scale; /* samples a metre */
        const char *said;
    } told[] = {{1000, "--metric mm is assumed: its levels"}, {5000, "--metric tum is assumed: its levels"}};
    rng r = rng_make("units");
    for (size_t k = 0; k < sizeof all / sizeof all[0]; k++) {
        for (int i = 0; i < PIXELS; i++) {
            const double x = all[k].scale * rng_uniform(&r, all[k].least, all[k].most);
            truth_store(data, all[k].type, (size_t)i, i % 9 == 0 ? 0 : all[k].type == IMAGE_F32 ? x : rint(x));
        }
        truth_write(truth_path("in.npy"), IMAGE_NPY, all[k].type, data);
        const char *const words[] = {truth_path("in.npy"), "-o", truth_path("said.csv")};
        truth_run(words, 3);
        assert_true(truth_said("--metric ") && truth_said(" or --"));
    }
    /* The levels of PrimeSense's cameras, in the one unit in which they are these. */
    for (size_t k = 0; k < sizeof told / sizeof told[0]; k++) {
        for (int i = 0; i < PIXELS; i++) {
            const double level = 100 + floor(rng_uniform(&r, 0, 500));
            const double z = 1 / (0.1042 * 0.25 / (1.2 * 7.5) * level);
            truth_store(data, IMAGE_U16, (size_t)i, i % 9 == 0 ? 0 : rint(told[k].scale * z));
        }
        truth_write(truth_path("in.npy"), IMAGE_NPY, IMAGE_U16, data);
        const char *const words[] = {truth_path("in.npy"), "-o", truth_path("said.csv")};
        assert_int_equal(truth_run(words, 3), 0);
        assert_true(truth_said(told[k].said));
    }
    /* Metres that were written as millimetres are nothing else; shares of a pixel are not that. */
    for (int binary = 0; binary < 2; binary++) {
        for (int i = 0; i < PIXELS; i++) {
            const double x = rng_uniform(&r, 0.7, 9);
            truth_store(data, IMAGE_F32, (size_t)i, binary ? rint(16 * x) / 16 : rint(1000 * x) / 1000);
        }
        truth_write(truth_path("in.npy"), IMAGE_NPY, IMAGE_F32, data);
        const char *const words[] = {truth_path("in.npy"), "-o", truth_path("said.csv")};
        assert_true((truth_run(words, 3) == 0) == !binary);
        assert_true(truth_said("--metric 1m is assumed") == !binary);
    }
}

/* Frames as data sets have them: what they are is among the readings, with the depths of its formula; Cityscapes' 1 is
 * no disparity, so nearly every frame has it; a laser leaves most pixels empty; what is rendered has no holes. */
TEST(what_data_sets_hold) {
    static const struct frame_of {
        const char *option;
        double least, most, holes; /* samples, and the share of pixels at 0 */
        double ones;               /* at 1 */
        const char *said;
    } all[] = {{"--stereo cityscapes", 300, 28000, 0.2, 0.1, " 0 for holes: --stereo cityscapes reads"},
               {"--metric kitti", 256 * 5, 256 * 80, 0.8, 0, "--metric kitti"},
               {"--metric tum", 8215, 17160, 0, 0, "whole numbers without holes: "}};
    static double data[PIXELS];
    rng r = rng_make("data sets");
    for (size_t k = 0; k < sizeof all / sizeof all[0]; k++) {
        char text[128];
        double least = (double)INFINITY, most = 0;
        for (int i = 0; i < PIXELS; i++) {
            const double share = (i + 0.5) / PIXELS;
            const double x = share < all[k].holes                 ? 0
                             : share < all[k].holes + all[k].ones ? 1
                                                                  : rint(rng_uniform(&r, all[k].least, all[k].most));
            least = x > 1 ? fmin(least, x) : least;
            most = fmax(most, x);
            truth_store(data, IMAGE_U16, (size_t)i, x);
        }
        truth_write(truth_path("in.npy"), IMAGE_NPY, IMAGE_U16, data);
        const char *const words[] = {truth_path("in.npy"), "-o", truth_path("said.csv")};
        assert_int_equal(truth_run(words, 3), 0);
        if (!truth_said(all[k].said))
            fail_msg("not said: %s", all[k].said);
        const double unit = k == 1 ? 1.0 / 256 : 0.0002, view = 2262.52 * 0.209313 * 256;
        snprintf(text, sizeof text, "%s%s %.3g to %.3g m", all[k].option, k == 0 ? " reads" : "",
                 k == 0 ? view / (most - 1) : least * unit, k == 0 ? view / (least - 1) : most * unit);
        if (!truth_said(text))
            fail_msg("not said: %s", text);
    }
}

int main(void) {
    return run_listed(truth_folder, truth_folder_end);
}
