/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Metric depth, as sensors and simulators write it: read with --metric it is within what the error map says of the
 * depth that was rounded or truncated, for eye depth, places and effects; holes are counted and never averaged.
 */
#include <jansson.h>

#include "support.h"
#include "truth.h"

typedef struct metric_kind {
    const char *name;
    image_type type;
    double scale, most; /**< scene units a unit, and the farthest depth */
    double step;        /**< in units, that depths are rounded to before they are stored; 0: none */
} metric_kind;

static const metric_kind kinds[] = {
    {"millimetres", IMAGE_U16, 0.001, 60, 1},
    {"5000 a metre", IMAGE_U16, 1.0 / 5000, 13, 1},
    {"bytes", IMAGE_U8, 0.04, 10, 1},
    {"micrometres", IMAGE_U32, 1e-6, 300, 1},
    {"metres", IMAGE_F32, 1, 500, 0},
    {"centimetres", IMAGE_F32, 0.01, 90, 0},
    {"halves", IMAGE_F16, 1, 100, 0},
    {"doubles", IMAGE_F64, 1, 1000, 0},
    {"millimetres in metres", IMAGE_F32, 1, 9, 0.001},
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

static double sample_of(const metric_kind *k, double z, int mode) {
    const double x = z / k->scale;
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
        z[i] = hole ? NAN : rng_log(r, k->most / 50, k->most);
        count += hole;
        const size_t which = k->type == IMAGE_F32 || k->type == IMAGE_F64 ? rng_below(r, 4) : 0;
        truth_store(data, k->type, (size_t)i, hole ? holes[which] : sample_of(k, z[i], mode));
    }
    truth_write(truth_path("in.npy"), IMAGE_NPY, k->type, data);
    return count;
}

static double number_in(const json_t *object, const char *name) {
    const json_t *found = json_object_get(object, name);
    assert_true(json_is_number(found));
    return json_number_value(found);
}

static void check_statistics(const metric_kind *k, const command *base, size_t holes, double worst) {
    json_t *root = truth_statistics(base);
    const json_t *eye = json_array_get(json_object_get(root, "errors"), 0);
    assert_true(number_in(root, "metric") == k->scale);
    assert_true(number_in(root, "invalid") == (double)holes);
    assert_true(number_in(json_object_get(root, "sky"), "pixels") == 0);
    assert_true(number_in(eye, "masked") == (double)holes && number_in(eye, "pixels") == (double)(PIXELS - holes));
    assert_true(number_in(eye, "max") >= worst);
    assert_string_equal(json_string_value(json_object_get(root, "format_from")), "given");
    assert_string_equal(json_string_value(json_object_get(root, "direction_from")), "given");
    double pixels = 0;
    for (size_t i = 0; i < json_array_size(json_object_get(root, "bands")); i++)
        pixels += number_in(json_array_get(json_object_get(root, "bands"), i), "pixels");
    assert_true(pixels == (double)(PIXELS - holes));
    if (k->step > 0)
        assert_relative(number_in(json_object_get(root, "samples"), "step"), k->step * k->scale, 1e-12);
    json_decref(root);
}

static double one_picture(tally *t, rng *r, const metric_kind *k) {
    double z[PIXELS], worst = 0, used = 0;
    float eye[PIXELS], map[PIXELS], place[3 * PIXELS], fog[PIXELS];
    command base = {.count = 0};
    const size_t holes = picture(r, k, z);
    truth_add(&base, truth_path("in.npy"));
    truth_add_number(&base, 0, "--metric", k->scale);
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
        TALLY(t, (double)map[i] <= 1.01 * step + 4e-7 * z[i], "%s: %.9g may be %g off", k->name, z[i], (double)map[i]);
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
    const uint64_t rounds = test_cases(2, 6, 400);
    tally t = {.name = "metric"};
    rng r = rng_make("metric");
    double used[KINDS] = {0};
    for (uint64_t i = 0; i < rounds; i++)
        for (size_t k = 0; k < KINDS; k++)
            used[k] = fmax(used[k], one_picture(&t, &r, &kinds[k]));
    for (size_t k = 0; k < KINDS; k++) {
        print_message("# %s: %.3f of the bound is used\n", kinds[k].name, used[k]);
        assert_true(used[k] > 0.4);
    }
    tally_end(&t);
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
    assert_true(truth_said("--metric"));
    picture(&r, &(metric_kind){"millimetres", IMAGE_U16, 0.001, 20, 1}, z);
    json_t *root = truth_statistics(&c);
    assert_string_equal(json_string_value(json_object_get(root, "direction_from")), "assumed"); /* no sky, but holes */
    json_decref(root);
    command quiet = c;
    truth_add(&quiet, "--product");
    truth_add(&quiet, "eye");
    truth_add(&quiet, "-o");
    truth_add(&quiet, truth_path("eye.npy"));
    assert_int_equal(truth_run(quiet.arguments, quiet.count), 0);
    assert_true(truth_said("--metric 0.001"));
    truth_add(&quiet, "-q");
    assert_int_equal(truth_run(quiet.arguments, quiet.count), 0);
    assert_false(truth_said("metric"));
    truth_write(truth_path("in.npy"), IMAGE_NPY, IMAGE_U16, zeros);
    truth_add_number(&c, 0, "--metric", 0.001);
    assert_int_equal(truth_run(c.arguments, c.count), 2);
    assert_true(truth_said("no sample is a depth"));
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
    json_t *root = truth_statistics(&c);
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
