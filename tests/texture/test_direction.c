/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * What is said to be found in an image is so, and what cannot be found is said to be assumed: the statistics of images
 * of known depths, whose mapping is not given, and how they say that a pixel would be read otherwise.
 */
#include <jansson.h>

#include "support.h"
#include "truth.h"

static const double NEAR = 0.2, FAR = 400;

static double window(double z, bool reversed, bool ortho) {
    const double d = ortho ? (z - NEAR) / (FAR - NEAR) : FAR * (z - NEAR) / (z * (FAR - NEAR));
    const double q = ortho ? (FAR - z) / (FAR - NEAR) : NEAR * (FAR - z) / (z * (FAR - NEAR));
    return reversed ? q : d;
}

/* How a pixel would be read: the inverses. */
static double read_as(const char *mapping, double d) {
    const double share = strcmp(mapping, "reversed") == 0 ? 1 - d : d;
    return strcmp(mapping, "linear") == 0 ? d * FAR
           : strcmp(mapping, "log") == 0  ? expm1(d * log1p(FAR))
                                          : 1 / ((1 - share) / NEAR + share / FAR);
}

typedef struct scene {
    const char *name;
    double lo, hi; /**< depths */
    int sky;       /**< of 16 pixels */
    bool ramp;
    bool tells; /**< in perspective */
} scene;

static const scene scenes[] = {
    {"near things", 0.2, 0.26, 0, false, false},
    {"near things and sky", 0.2, 0.26, 5, false, false},
    {"a ramp of near things", 0.2, 0.26, 0, true, false},
    {"far things", 50, 399, 0, false, false},
    {"far things and sky", 5, 300, 5, false, true},
    {"all of it", 0.2, 400, 0, true, false},
    {"one distance", 3, 3, 0, false, false},
    {"nothing but sky", 3, 3, 16, false, false},
    {"one distance and sky", 30, 30, 5, false, false},
    {"at the near plane", 0.2, 0.2, 0, false, false},
};

static double depth_of(const scene *s, rng *r, int i) {
    if (i * 16 / PIXELS < s->sky)
        return FAR;
    return s->ramp         ? s->lo + (s->hi - s->lo) * (i % WIDTH) / (WIDTH - 1)
           : s->lo < s->hi ? rng_log(r, s->lo, s->hi)
                           : s->lo;
}

static const struct {
    image_type type;
    image_file file;
    double most; /**< 0: numbers */
} files[] = {{IMAGE_U8, IMAGE_PNG, 255},
             {IMAGE_U16, IMAGE_PNG, 65535},
             {IMAGE_U32, IMAGE_NPY, 16777215},
             {IMAGE_F32, IMAGE_NPY, 0},
             {IMAGE_F64, IMAGE_NPY, 0}};
enum { SCENES = sizeof scenes / sizeof scenes[0], FILES = sizeof files / sizeof files[0] };

static const char *text_in(const json_t *object, const char *name) {
    const char *text = json_string_value(json_object_get(object, name));
    assert_non_null(text);
    return text;
}

static json_t *statistics_of(bool ortho, const char *path) {
    command c = {.count = 0};
    truth_add(&c, path);
    truth_add_number(&c, 0, "-n", NEAR);
    truth_add_number(&c, 1, "-f", FAR);
    if (ortho)
        truth_add(&c, "--ortho");
    return truth_statistics(&c);
}

static int check_readings(tally *t, const json_t *root, size_t file, const void *data) {
    const json_t *all = json_object_get(root, "readings");
    /* Small codes in 32 bits may be of 16 or of 24: which is assumed, is said. */
    const double most = strcmp(text_in(root, "format"), "unorm16") == 0 ? 65535 : 16777215;
    int mappings = 0;
    for (size_t i = 0; i < json_array_size(all); i++) {
        const json_t *one = json_array_get(all, i);
        const size_t at = (size_t)(json_integer_value(json_object_get(one, "row")) * WIDTH +
                                   json_integer_value(json_object_get(one, "column")));
        if (strcmp(text_in(one, "what"), "mapping") != 0)
            continue;
        const double d = files[file].type == IMAGE_U8    ? ((const uint8_t *)data)[at] / 255.0
                         : files[file].type == IMAGE_U16 ? ((const uint16_t *)data)[at] / 65535.0
                         : files[file].type == IMAGE_U32 ? ((const uint32_t *)data)[at] / most
                         : files[file].type == IMAGE_F32 ? (double)((const float *)data)[at]
                                                         : ((const double *)data)[at];
        const double want = read_as(text_in(one, "name"), d);
        const double got = json_number_value(json_object_get(one, "z"));
        TALLY(t, fabs(got - want) <= 1e-9 * want, "%s: %g, not %g", text_in(one, "name"), got, want);
        mappings++;
    }
    return mappings;
}

TEST(directions_are_found_only_where_they_are) {
    tally t = {.name = "directions"};
    rng r = rng_make("directions");
    static double data[PIXELS];
    int found = 0, readings = 0;
    for (size_t s = 0; s < SCENES; s++)
        for (size_t f = 0; f < FILES; f++)
            for (int which = 0; which < 4; which++) {
                const bool reversed = which % 2 == 1, ortho = which >= 2;
                for (int i = 0; i < PIXELS; i++) {
                    const double d = window(depth_of(&scenes[s], &r, i), reversed, ortho), most = files[f].most;
                    truth_store(data, files[f].type, (size_t)i, most > 0 ? floor(d * most + 0.5) : d);
                }
                const char *path = truth_path(files[f].file == IMAGE_PNG ? "in.png" : "in.npy");
                truth_write(path, files[f].file, files[f].type, data);
                json_t *root = statistics_of(ortho, path);
                const bool is_found = strcmp(text_in(root, "direction_from"), "found") == 0;
                const bool as_reversed = strcmp(text_in(root, "mapping"), "reversed") == 0;
                TALLY(&t, is_found || strcmp(text_in(root, "direction_from"), "assumed") == 0, "direction_from");
                TALLY(&t, strcmp(text_in(root, "mapping_from"), "assumed") == 0, "a curve cannot be found");
                /* 8 bits have so few values among far things that the sky need not stand out. */
                const bool tells = scenes[s].tells && !ortho;
                TALLY(&t, is_found == tells || (tells && files[f].type == IMAGE_U8), "%s%s%s in %s: %s", scenes[s].name,
                      reversed ? ", reversed" : "", ortho ? ", ortho" : "", image_type_name(files[f].type),
                      text_in(root, "direction_from"));
                TALLY(&t, !is_found || as_reversed == reversed, "%s: found the wrong way round", scenes[s].name);
                const json_t *recognised = json_object_get(root, "recognised");
                TALLY(&t, json_is_null(json_object_get(recognised, "reversed")) || is_found || ortho, "%s: recognised",
                      scenes[s].name);
                /* A step that the type of the file cannot tell from something finer is no finding. */
                if (files[f].type <= IMAGE_U16)
                    TALLY(&t,
                          strcmp(text_in(root, "format_from"), "assumed") == 0 &&
                              json_is_false(json_object_get(recognised, "certain")),
                          "a format of %s", image_type_name(files[f].type));
                TALLY(&t, truth_said("the mapping is assumed"), "%s: no warning", scenes[s].name);
                found += is_found;
                if (!ortho)
                    readings += check_readings(&t, root, f, data);
                json_decref(root);
            }
    tally_end(&t);
    print_message("# %d directions found, %d readings\n", found, readings);
    assert_true(found >= 2 * (FILES - 1) && readings > 200);
}

int main(void) {
    return run_listed(truth_folder, truth_folder_end);
}
