/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Distances along the rays of metric images: with --radial eye depth is within what the error map says of the depth
 * whose distance was rounded, on any lattice, by --intrinsics as by --fov; places lie on their rays; and the distance
 * comes back. All rays by formulas in long double.
 */
#include <jansson.h>

#include "support.h"
#include "truth.h"

/* The options that say the rays: focal lengths and the middle, pixels from the left and upper edge. */
typedef struct rays {
    const char *option, *value;
    long double fx, fy, cx, cy;
} rays;

static const rays cameras[] = {
    {"--intrinsics", "20,21,12,5", 20, 21, 12, 5},
    {"--intrinsics", "13.5,17.25,9.75,7.125", 13.5L, 17.25L, 9.75L, 7.125L},
    {"--intrinsics", "585,585,320,240", 585, 585, 320, 240}, /* far off the middle */
    {"--intrinsics", "1,1,-1000000,1000000", 1, 1, -1e6L, 1e6L},
    {"--intrinsics", "1e9,5e8,0,0", 1e9L, 5e8L, 0, 0},
    {"--fov", "90", 5, 5, 12, 5},
    {"--hfov", "90", 12, 12, 12, 5},
};
enum { CAMERAS = sizeof cameras / sizeof cameras[0], FIRST_FOV = 5 };

static void slopes(const rays *k, int i, long double out[2]) {
    out[0] = (i % WIDTH + 0.5L - k->cx) / k->fx;
    out[1] = (k->cy - i / WIDTH - 0.5L) / k->fy;
}

static long double ray(const rays *k, int i) {
    long double s[2];
    slopes(k, i, s);
    return sqrtl(1 + s[0] * s[0] + s[1] * s[1]);
}

/* The distance after what was done to it. */
typedef struct storing {
    const char *name;
    image_type type;
    double scale, most, step; /* samples, the longest, and the lattice before them; 0: none */
    bool inverse;
} storing;

/* Nanometres are so fine that what doubles lose of a ray shows. */
static const storing storings[] = {
    {"millimetres", IMAGE_U16, 0.001, 6, 0, false},
    {"metres", IMAGE_F32, 1, 6, 0, false},
    {"doubles", IMAGE_F64, 1, 6, 0, false},
    {"nanometres", IMAGE_U32, 1e-9, 2.1, 0, false},
    {"disparity in millimetres", IMAGE_U16, 0.001, 6, 0.02, true},
    {"time of flight in metres", IMAGE_F32, 1, 6, 0.0437, false},
};
enum { STORINGS = sizeof storings / sizeof storings[0] };

static double stored(const storing *s, double r, bool nearest) {
    const double more = nearest ? 0.5 : 0;
    if (s->step > 0)
        r = s->inverse ? 1 / (s->step * floor(1 / r / s->step + more)) : s->step * floor(r / s->step + more);
    return s->type < IMAGE_F16 ? floor(r / s->scale + more) : r;
}

/* Distances at random, whose depths in long double; NaN for holes. */
static void picture(rng *r, const storing *s, const rays *k, long double z[PIXELS]) {
    static double data[PIXELS];
    const bool nearest = rng_below(r, 2) != 0;
    for (int i = 0; i < PIXELS; i++) {
        const bool hole = rng_below(r, 9) == 0;
        const double distance = rng_log(r, 0.5, s->most);
        z[i] = hole ? (long double)NAN : (long double)distance / ray(k, i);
        truth_store(data, s->type, (size_t)i, hole ? 0 : stored(s, distance, nearest));
    }
    truth_write(truth_path("in.npy"), IMAGE_NPY, s->type, data);
}

static command reading(const storing *s, const rays *k) {
    command c = {.count = 0};
    truth_add(&c, truth_path("in.npy"));
    truth_add_number(&c, 0, "--metric", s->scale);
    truth_add(&c, "--radial");
    truth_add(&c, k->option);
    truth_add(&c, k->value);
    return c;
}

/* A number lies in the command. */
#define READING(c, s, k)                                                                                               \
    command c = reading(s, k);                                                                                         \
    c.arguments[2] = c.text[0]

static double number_in(const json_t *object, const char *name) {
    const json_t *found = json_object_get(object, name);
    assert_true(json_is_number(found));
    return json_number_value(found);
}

static double check_depths(tally *t, const storing *s, const rays *k, const command *c, const long double *z) {
    float eye[PIXELS], map[PIXELS];
    double used = 0;
    truth_product(c, "eye.npy", "eye", NULL, false);
    truth_product(c, "map.npy", "eye", NULL, true);
    truth_floats("eye.npy", 1, eye);
    truth_floats("map.npy", 1, map);
    for (int i = 0; i < PIXELS; i++) {
        const double off = (double)fabsl((long double)eye[i] - z[i]);
        TALLY(t, isnan(z[i]) ? isnan(eye[i]) && isnan(map[i]) : off <= (double)map[i],
              "%s, %s: %.9Lg reads %.9g, not within %g", s->name, k->value, z[i], (double)eye[i], (double)map[i]);
        if (isnan(z[i]))
            continue;
        used = fmax(used, off / (double)map[i]);
        /* a level and a sample of the distance, times the cosine; what binary32 and doubles add */
        const double r = (double)(eye[i] * ray(k, i)), sample = s->type < IMAGE_F16 ? s->scale : 3e-7 * r;
        const double level = s->step == 0 ? 0 : s->inverse ? 1 / (1 / (r + sample) - s->step) - r : s->step;
        const double most = 1.1 * (level + sample) / (double)ray(k, i) + 2e-7 * (double)z[i];
        TALLY(t, (double)map[i] <= most || (s->inverse && 1 / (r + sample) <= 1.02 * s->step),
              "%s, %s: %.9Lg may be %g off, %g is enough", s->name, k->value, z[i], (double)map[i], most);
    }
    return used;
}

static void check_places(tally *t, const storing *s, const rays *k, const command *c, const long double *z) {
    static float place[3 * PIXELS], map[PIXELS], back[PIXELS];
    truth_product(c, "place.npy", "position", "exact", false);
    truth_product(c, "map.npy", "position", "exact", true);
    truth_floats("place.npy", 3, place);
    truth_floats("map.npy", 1, map);
    for (int i = 0; i < PIXELS; i++) {
        long double d[3], at[2];
        slopes(k, i, at);
        for (int n = 0; n < 3; n++)
            d[n] = (long double)place[3 * i + n] - z[i] * (n < 2 ? at[n] : 1);
        TALLY(t, isnan(z[i]) ? isnan(map[i]) : sqrtl(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]) <= (long double)map[i],
              "%s, %s: a place at %.9Lg", s->name, k->value, z[i]);
    }
    truth_product(c, "effect.npy", "radial", NULL, false);
    truth_product(c, "map.npy", "radial", NULL, true);
    truth_floats("effect.npy", 1, back);
    truth_floats("map.npy", 1, map);
    for (int i = 0; i < PIXELS; i++)
        TALLY(t, isnan(z[i]) ? isnan(back[i]) : fabsl((long double)back[i] - z[i] * ray(k, i)) <= (long double)map[i],
              "%s, %s: a distance at %.9Lg", s->name, k->value, z[i]);
}

/* Pixels are counted by their distances; one near the end of a band may be in either. */
static void check_bands(const json_t *bands, const storing *s, const rays *k, const long double *z) {
    size_t all = 0, holes = 0;
    for (int i = 0; i < PIXELS; i++)
        holes += isnan(z[i]) ? 1 : 0;
    for (size_t b = 0; b < json_array_size(bands); b++) {
        const double lo = number_in(json_array_get(bands, b), "lo"), hi = number_in(json_array_get(bands, b), "hi");
        const size_t pixels = (size_t)number_in(json_array_get(bands, b), "pixels");
        size_t least = 0, most = 0;
        for (int i = 0; i < PIXELS; i++) {
            const double r = (double)(z[i] * ray(k, i));
            const double off = s->step > 0 ? r : s->type < IMAGE_F16 ? 2 * s->scale : 1e-6 * r;
            least += r - off >= lo && r + off < hi;
            most += r + off >= lo && r - off < hi;
        }
        assert_true(least <= pixels && pixels <= most);
        all += pixels;
    }
    assert_int_equal(all, PIXELS - holes);
}

/* The lattice is that of the distances, as bands are; the range is that of the depths. */
static void check_statistics(const storing *s, const rays *k, const command *c, const long double *z) {
    json_t *root = truth_statistics(c);
    const json_t *lattice = json_object_get(root, "lattice");
    long double longest = 0, least = INFINITY;
    for (int i = 0; i < PIXELS; i++) {
        longest = fmaxl(longest, ray(k, i));
        least = fminl(least, isnan(z[i]) ? INFINITY : z[i]);
    }
    assert_relative(number_in(root, "radial"), (double)longest, 1e-9);
    assert_relative(number_in(root, "lo"), (double)least, 0.1);
    check_bands(json_object_get(root, "bands"), s, k, z);
    assert_string_equal(json_string_value(json_object_get(lattice, "name")), s->step == 0 ? "file"
                                                                             : s->inverse ? "inverse"
                                                                                          : "even");
    if (s->step > 0)
        assert_scene(number_in(lattice, "step"), s->step, number_in(lattice, "step_error"));
    json_decref(root);
}

TEST(depth_of_distances_is_within_what_is_said) {
    const uint64_t rounds = test_cases(1, 1, 60);
    tally t = {.name = "radial"};
    rng r = rng_make("radial");
    for (size_t s = 0; s < STORINGS; s++) {
        double used = 0;
        for (size_t k = 0; k < CAMERAS; k++)
            for (uint64_t i = 0; i < rounds; i++) {
                long double z[PIXELS];
                picture(&r, &storings[s], &cameras[k], z);
                READING(c, &storings[s], &cameras[k]);
                used = fmax(used, check_depths(&t, &storings[s], &cameras[k], &c, z));
                check_places(&t, &storings[s], &cameras[k], &c, z);
                check_statistics(&storings[s], &cameras[k], &c, z);
            }
        print_message("# %s: %.3f of the bound is used\n", storings[s].name, used);
        assert_true(used > 0.4);
    }
    tally_end(&t);
}

/* The normal of planes is within the bound. */
TEST(normals_of_distances) {
    tally t = {.name = "normals"};
    rng r = rng_make("planes");
    static double data[PIXELS];
    static float normal[3 * PIXELS], map[PIXELS];
    double used = 0;
    for (int round = 0; round < 6; round++) {
        const rays *k = &cameras[round % 2];
        const double n[3] = {rng_uniform(&r, -0.5, 0.5), rng_uniform(&r, -0.5, 0.5), 1};
        const double length = sqrt(n[0] * n[0] + n[1] * n[1] + 1);
        for (int i = 0; i < PIXELS; i++) {
            long double s[2];
            slopes(k, i, s);
            const double z = 2 / ((double)s[0] * n[0] + (double)s[1] * n[1] + 1);
            truth_store(data, IMAGE_U16, (size_t)i, rint(1000 * z * (double)ray(k, i)));
        }
        truth_write(truth_path("in.npy"), IMAGE_NPY, IMAGE_U16, data);
        READING(c, &storings[0], k);
        truth_product(&c, "eye.npy", "normal", "high", false);
        truth_product(&c, "map.npy", "normal", "high", true);
        truth_floats("eye.npy", 3, normal);
        truth_floats("map.npy", 1, map);
        for (int i = 0; i < PIXELS; i++) {
            double across[3], far = 0;
            for (int j = 0; j < 3; j++)
                across[j] = (double)normal[3 * i + (j + 1) % 3] * n[(j + 2) % 3] -
                            (double)normal[3 * i + (j + 2) % 3] * n[(j + 1) % 3];
            for (int j = 0; j < 3; j++)
                far += across[j] * across[j];
            const double off = asin(fmin(sqrt(far) / length, 1)) * 180 / 3.14159265358979323846;
            TALLY(&t, off <= (double)map[i], "a normal is off by %g, not within %g", off, (double)map[i]);
            used = fmax(used, off / (double)map[i]);
        }
    }
    print_message("# normals: %.3f of the bound is used\n", used);
    assert_true(used > 0.1 && used <= 1);
    tally_end(&t);
}

/* Effects of a depth at a height, or of two pixels at either end of both diagonals, with far at 8. */
static double clamped(double x) {
    return fmin(fmax(x, 0), 1);
}

static double across(const double *z, int i, int aside) {
    const int x = i % WIDTH, y = i / WIDTH, left = x > 0 ? x - 1 : 0, right = x + 1 < WIDTH ? x + 1 : x;
    const int above = y > 0 ? y - 1 : 0, below = y + 1 < HEIGHT ? y + 1 : y;
    return fabs(z[above * WIDTH + (aside ? right : left)] - z[below * WIDTH + (aside ? left : right)]) / 8;
}

static const struct {
    const char *effect, *parameters[2];
} effects[] = {{"effect:fog", {"density=3"}},
               {"effect:soft-particles", {"fade-distance=4", "reference=1.5"}},
               {"effect:water-line", {"band=0.7", "level=0.1"}},
               {"effect:edge", {"threshold=0.01"}}};
enum { EFFECTS = sizeof effects / sizeof effects[0], HEIGHTS = 2, EDGES = 3 };

static double output_of(int effect, const rays *k, const double *z, int i) {
    long double s[2];
    slopes(k, i, s);
    return effect == 0         ? clamped(z[i] / 8 * 3)
           : effect == 1       ? clamped((z[i] - 1.5) / 4)
           : effect == HEIGHTS ? clamped((0.1 - (double)s[1] * z[i]) / 0.7)
                               : across(z, i, 0) > 0.01 || across(z, i, 1) > 0.01;
}

/* The change that a millimetre along the ray makes there: a sample may be cut or rounded to one. */
static double change_of(int effect, const rays *k, int i) {
    long double s[2];
    slopes(k, i, s);
    return 0.001 / (double)ray(k, i) * (effect == 0 ? 3.0 / 8 : effect == 1 ? 1.0 / 4 : fabs((double)s[1]) / 0.7);
}

TEST(effects_of_distances) {
    tally t = {.name = "effects"};
    rng r = rng_make("effects of distances");
    static double data[PIXELS];
    double z[PIXELS], used[EFFECTS] = {0};
    float seen[PIXELS], map[PIXELS];
    for (int round = 0; round < 4 * EFFECTS; round++) {
        const int e = round % EFFECTS;
        const rays *k = &cameras[e == HEIGHTS ? 0 : round / EFFECTS % 2]; /* a height needs a frustum that is centred */
        const double slope = rng_uniform(&r, 0.1, 0.6);
        for (int i = 0; i < PIXELS; i++) {
            long double s[2];
            slopes(k, i, s);
            z[i] = 2 / ((double)s[0] * slope + 1);
            truth_store(data, IMAGE_U16, (size_t)i, rint(1000 * z[i] * (double)ray(k, i)));
        }
        truth_write(truth_path("in.npy"), IMAGE_NPY, IMAGE_U16, data);
        READING(c, &storings[0], k);
        truth_add(&c, "--far");
        truth_add(&c, "8");
        for (int p = 0; p < 2 && effects[e].parameters[p] != NULL; p++) {
            truth_add(&c, "--parameter");
            truth_add(&c, effects[e].parameters[p]);
        }
        truth_product(&c, "effect.npy", effects[e].effect, NULL, false);
        truth_product(&c, "map.npy", effects[e].effect, NULL, true);
        truth_floats("effect.npy", 1, seen);
        truth_floats("map.npy", 1, map);
        for (int i = 0; i < PIXELS; i++) {
            const double off = 255 * fabs((double)seen[i] - output_of(e, k, z, i));
            TALLY(&t, off <= (double)map[i], "%s, pixel %d: off by %g, not within %g", effects[e].effect, i, off,
                  (double)map[i]);
            /* of a depth that is read wrong the map says how wrong */
            TALLY(&t, e == EDGES || (double)map[i] <= 255 * change_of(e, k, i) + 1e-3,
                  "%s, pixel %d: off by %g, not %g", effects[e].effect, i, (double)map[i], 255 * change_of(e, k, i));
            used[e] = fmax(used[e], map[i] > 0 ? off / (double)map[i] : 0);
        }
    }
    print_message("# effects: %.3f, %.3f, %.3f and %.3f of the bound is used\n", used[0], used[1], used[2], used[3]);
    assert_true(used[0] > 0.4 && used[1] > 0.4 && used[HEIGHTS] > 0.4);
    tally_end(&t);
}

/* A pixel: its depth, its range and its place. */
TEST(pixels_say_depth) {
    const rays *k = &cameras[1];
    static double data[PIXELS];
    for (int i = 0; i < PIXELS; i++)
        truth_store(data, IMAGE_U16, (size_t)i, 1000 + i);
    truth_write(truth_path("in.npy"), IMAGE_NPY, IMAGE_U16, data);
    READING(c, &storings[0], k);
    truth_add(&c, "--pixel");
    truth_add(&c, "3,2");
    json_t *root = truth_statistics(&c);
    const json_t *at = json_array_get(json_object_get(root, "pixels"), 0);
    const int i = 2 * WIDTH + 3;
    long double s[2];
    slopes(k, i, s);
    const double along = (double)ray(k, i), z = (1 + 0.001 * i) / along;
    assert_relative(number_in(at, "z"), z, 1e-12);
    assert_relative(number_in(at, "distance"), 1 + 0.001 * i, 1e-12);
    assert_relative(number_in(at, "interval"), 0.0015 / along, 1e-5);
    assert_relative(number_in(json_object_get(at, "position"), "x"), z * (double)s[0], 1e-12);
    assert_relative(number_in(json_object_get(at, "position"), "y"), z * (double)s[1], 1e-12);
    json_decref(root);
}

/* Without --radial the intrinsics say where places are, and nothing of depth. */
TEST(intrinsics_say_places) {
    const rays *k = &cameras[1];
    static double data[PIXELS];
    static float place[3 * PIXELS];
    command c = {.count = 0};
    for (int i = 0; i < PIXELS; i++)
        truth_store(data, IMAGE_F32, (size_t)i, 1 + i / 128.0);
    truth_write(truth_path("in.npy"), IMAGE_NPY, IMAGE_F32, data);
    truth_add(&c, truth_path("in.npy"));
    truth_add_number(&c, 0, "--metric", 1);
    truth_add(&c, k->option);
    truth_add(&c, k->value);
    truth_product(&c, "place.npy", "position", "exact", false);
    truth_floats("place.npy", 3, place);
    for (int i = 0; i < PIXELS; i++) {
        long double s[2];
        slopes(k, i, s);
        for (int n = 0; n < 3; n++)
            assert_relative((double)place[3 * i + n], (double)((1 + i / 128.0L) * (n < 2 ? s[n] : 1)), 1e-7);
    }
    json_t *root = truth_statistics(&c);
    assert_true(json_is_null(json_object_get(root, "radial")));
    const double up = (double)(atanl(k->cy / k->fy) + atanl((HEIGHT - k->cy) / k->fy)) * 180 / 3.14159265358979323846;
    assert_relative(number_in(root, "fov"), up, 1e-9);
    json_decref(root);
}

TEST(what_has_no_rays_is_refused) {
    static const struct {
        const char *arguments[6], *words;
    } bad[] = {
        {{"--radial"}, "--radial: needs --metric"},
        {{"--metric", "1", "--radial"},
         "--radial: needs the rays: --fov, --hfov, --intrinsics or four tangents as --matrix"},
        {{"--metric", "1", "--radial", "--ortho", "--fov", "60"}, "conflicts with --ortho"},
        {{"--metric", "1", "--intrinsics", "9,9,1,1", "--fov", "60"}, "--intrinsics: conflicts with --fov"},
        {{"--ortho", "--intrinsics", "9,9,1,1"}, "--intrinsics: conflicts with --ortho"},
        {{"--intrinsics", "0,9,1,1"}, "--intrinsics: must be FX,FY,CX,CY, the first two from 1 to 1e9"},
        {{"--intrinsics", "9,-9,1,1"}, "got '9,-9,1,1'"},
        {{"--intrinsics", "9,nan,1,1"}, "got '9,nan,1,1'"},
        {{"--intrinsics", "9,9,inf,1"}, "got '9,9,inf,1'"},
        {{"--intrinsics", "9,9,1,1e7"}, "got '9,9,1,1e7'"},
        {{"--intrinsics", "9,9,1"}, "got '9,9,1'"},
        {{"--intrinsics", "9,9,1,1,1"}, "got '9,9,1,1,1'"},
        {{"--intrinsics", "9,9,1,"}, "got '9,9,1,'"},
        {{"--intrinsics", ""}, "got ''"},
        {{"--intrinsics", "9,9,1px,1"}, "got '9,9,1px,1'"},
    };
    static double data[PIXELS];
    for (int i = 0; i < PIXELS; i++)
        truth_store(data, IMAGE_F32, (size_t)i, 2);
    truth_write(truth_path("in.npy"), IMAGE_NPY, IMAGE_F32, data);
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        command c = {.count = 0};
        truth_add(&c, truth_path("in.npy"));
        for (size_t k = 0; k < 6 && bad[i].arguments[k] != NULL; k++)
            truth_add(&c, bad[i].arguments[k]);
        assert_int_equal(truth_run(c.arguments, c.count), 2);
        assert_true(truth_said(bad[i].words));
    }
}

/* A table over codes that all pixels share is not made of distances. */
TEST(products_of_shared_depths_are_refused) {
    static const struct {
        const char *option, *value, *words;
    } bad[] = {{"--product", "effect:water-line", "this effect is for a frustum that is centred"},
               {"--product", "position:view", "this method is for a frustum that is centred"},
               {"--product", "pack:rgba", "which --radial does not have; --product eye writes a file of depths"}};
    static double data[PIXELS];
    for (int i = 0; i < PIXELS; i++)
        truth_store(data, IMAGE_F32, (size_t)i, 2 + i % 7);
    truth_write(truth_path("in.npy"), IMAGE_NPY, IMAGE_F32, data);
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        READING(c, &storings[1], &cameras[1]);
        truth_add(&c, bad[i].option);
        truth_add(&c, bad[i].value);
        truth_add(&c, "-o");
        truth_add(&c, truth_path(strncmp(bad[i].value, "pack", 4) == 0 ? "out.png" : "out.npy"));
        assert_int_equal(truth_run(c.arguments, c.count), 2);
        assert_true(truth_said(bad[i].words));
    }
}

int main(void) {
    return run_listed(truth_folder, truth_folder_end);
}
