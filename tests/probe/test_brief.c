/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Profiles in a few hundred characters: the recorded ones, which the rows of known GPUs are, and damaged ones. */
#include <jansson.h>
#include <math.h>

#include "probe/brief.h"
#include "probe/cmd_probe/known.h"
#include "support.h"

static const char *const recorded[] = {"llvmpipe",    "lavapipe",    "softpipe",
                                       "swiftshader", "nvidia-h100", "nvidia-h100-gl"};
enum { RECORDED = sizeof recorded / sizeof recorded[0] };
static const char *const formats[SHOT_FORMATS] = {"D16", "D24", "D32"};

static json_t *profile_of(size_t i) {
    char path[64];
    snprintf(path, sizeof path, "tests/profiles/%s.json", recorded[i]);
    json_t *root = json_load_file(path, 0, NULL);
    assert_non_null(root);
    return root;
}

static const char *word(const json_t *object, const char *key) {
    return json_string_value(json_object_get(object, key));
}

static double number(const json_t *object, const char *key) {
    const json_t *value = json_object_get(object, key);
    return json_is_number(value) ? json_number_value(value) : NAN;
}

/* What the probe had found when it wrote the file. */
static void result_of(const json_t *root, probe_result *r) {
    static shot shots[1];
    static const char *const sure[] = {"sure", "open", "no row", "measured"};
    const json_t *device = json_object_get(root, "device");
    *r = (probe_result){
        .machine = {.count = 1}, .plan = {0, shots}, .arith = word(root, "arith"), .raster = word(root, "raster")};
    shot_device *d = &r->machine.device[0];
    snprintf(d->name, sizeof d->name, "%s", word(device, "name"));
    snprintf(d->driver, sizeof d->driver, "%s", word(device, "driver"));
    snprintf(d->api, sizeof d->api, "%s", word(device, "api"));
    d->subpixel_bits = (int)json_integer_value(json_object_get(root, "subpixel_reported"));
    size_t i;
    json_t *of;
    json_array_foreach(json_object_get(root, "findings"), i, of) {
        probe_finding *f = &r->finding[r->count++];
        *f = (probe_finding){.key = word(of, "key"), .format = word(of, "format"), .value = number(of, "value")};
        snprintf(f->words, sizeof f->words, "%s", word(of, "found"));
        while (strcmp(sure[f->sure], word(of, "sure")) != 0)
            f->sure++;
        f->cases = (uint64_t)number(of, "cases");
        f->hits = f->sure == PROBE_MEASURED ? 0 : (uint64_t)number(of, "hits");
        f->unit = word(of, "value_unit");
    }
}

/* The words without what the device calls the format. */
static const char *said(const probe_finding *f) {
    const char *colon = strcmp(f->key, "stored") == 0 ? strstr(f->words, ": ") : NULL;
    return colon != NULL && colon < f->words + 24 && strchr(f->words, ' ') > colon ? colon + 2 : f->words;
}

static void same(const probe_result *a, const probe_result *b) {
    assert_string_equal(a->machine.device[0].name, b->machine.device[0].name);
    assert_string_equal(a->machine.device[0].api, b->machine.device[0].api);
    assert_int_equal(a->machine.device[0].subpixel_bits, b->machine.device[0].subpixel_bits);
    assert_true((a->arith == NULL) == (b->arith == NULL) && (a->arith == NULL || strcmp(a->arith, b->arith) == 0));
    assert_true((a->raster == NULL) == (b->raster == NULL) && (a->raster == NULL || strcmp(a->raster, b->raster) == 0));
    assert_int_equal(a->count, b->count);
    for (size_t i = 0; i < a->count; i++) {
        const probe_finding *f = &a->finding[i], *g = &b->finding[i];
        assert_string_equal(f->key, g->key);
        assert_true((f->format == NULL) == (g->format == NULL) &&
                    (f->format == NULL || strcmp(f->format, g->format) == 0));
        assert_string_equal(said(f), said(g));
        assert_int_equal(f->sure, g->sure);
        if (f->sure == PROBE_MEASURED) {
            assert_string_equal(f->unit, g->unit);
            assert_true(fabs(f->value - g->value) <= 1e-5 * f->value);
        } else if (f->sure != PROBE_SURE) {
            assert_true(f->hits == g->hits && f->cases == g->cases);
        }
    }
}

/* Each recorded profile is a row of the known ones, and is read again as it was. */
TEST(test_recorded) {
    for (size_t i = 0; i < RECORDED; i++) {
        probe_result was, now;
        char text[BRIEF_SIZE], error[SHOT_ERROR_SIZE];
        json_t *root = profile_of(i);
        result_of(root, &was);
        brief_write(&was, text);
        if (known_get(i) == NULL || strcmp(text, known_get(i)) != 0)
            fail_msg("the row of %s must be\n\"%s\",", recorded[i], text);
        if (!brief_read(text, formats, &now, error))
            fail_msg("%s: %s", recorded[i], error);
        assert_true(strncmp(now.finding[0].words, "D16: ", 5) == 0);
        same(&was, &now);
        probe_free(&now);
        json_decref(root);
    }
    assert_null(known_get(RECORDED));
}

/* Where two recorded profiles differ, counted in the files themselves. */
static size_t differences(const json_t *a, const json_t *b, size_t *both) {
    size_t i, k, differ = 0;
    json_t *f, *g;
    *both = 0;
    json_array_foreach(json_object_get(a, "findings"), i, f) json_array_foreach(json_object_get(b, "findings"), k, g) {
        const char *as = word(f, "format"), *bs = word(g, "format"), *said = word(f, "found"),
                   *other = word(g, "found");
        const bool measured = strcmp(word(f, "sure"), "measured") == 0, stored = strcmp(word(f, "key"), "stored") == 0;
        if (strcmp(word(f, "key"), word(g, "key")) != 0 || strcmp(as != NULL ? as : "", bs != NULL ? bs : "") != 0 ||
            (measured && strcmp(said, other) != 0))
            continue;
        ++*both;
        said += stored ? strcspn(said, " ") : 0; /* behind what the device calls the format */
        other += stored ? strcspn(other, " ") : 0;
        differ += measured ? fabs(number(f, "value") - number(g, "value")) > 0.005 * number(f, "value")
                           : strcmp(said, other) != 0;
    }
    return differ;
}

TEST(test_compared) {
    static known_comparison out;
    for (size_t i = 0; i < RECORDED; i++)
        for (size_t k = 0; k < RECORDED; k++) {
            probe_result got;
            json_t *a = profile_of(i), *b = profile_of(k);
            size_t both;
            const size_t differ = differences(a, b, &both);
            result_of(b, &got);
            assert_true(known_compare(i, &got, &out));
            if (out.compared != both || out.differ != differ)
                fail_msg("%s, %s: %zu of %zu differ, in the files %zu of %zu", recorded[i], recorded[k], out.differ,
                         out.compared, differ, both);
            assert_true(strncmp(out.name, word(json_object_get(a, "device"), "name"),
                                strlen(word(json_object_get(a, "device"), "name"))) == 0);
            for (size_t d = 0; d < out.differ; d++)
                assert_string_not_equal(out.difference[d].expected, out.difference[d].got);
            json_decref(a);
            json_decref(b);
        }
    assert_false(known_compare(RECORDED, &(probe_result){.plan = {0, &(shot){0}}}, &out));
}

/* What somebody has cut, or changed a letter of, is read as what it then says, or refused in a sentence. */
TEST(test_damaged) {
    rng random = rng_make("brief");
    size_t refused = 0, read = 0;
    for (int i = 0; i < 20000; i++) {
        const char *whole = known_get((size_t)(i % RECORDED));
        char text[BRIEF_SIZE], again[BRIEF_SIZE], error[SHOT_ERROR_SIZE] = "";
        probe_result r, back;
        snprintf(text, sizeof text, "%s", whole);
        const size_t at = (size_t)rng_below(&random, strlen(text));
        const size_t from = (size_t)rng_below(&random, strlen(text));
        const int letter = (int)rng_below(&random, 256);
        text[at] = (char)(i % 12 < RECORDED ? letter : whole[from]);
        if (brief_read(text, formats, &r, error)) {
            read++;
            brief_write(&r, again);
            if (!brief_read(again, formats, &back, error))
                fail_msg("'%s' is written as '%s', which is refused: %s", text, again, error);
            same(&r, &back);
            probe_free(&back);
        } else {
            refused++;
            assert_true(strstr(error, "the profile of a GPU is damaged: ") == error);
        }
        probe_free(&r);
    }
    if (refused < 2000 || read < 2000)
        fail_msg("%zu refused, %zu read", refused, read);
    char filled[2 * BRIEF_SIZE], error[SHOT_ERROR_SIZE];
    probe_result r;
    assert_true(brief_read("A~B~C~8~~~l0n1*9*10", formats, &r, error));
    probe_free(&r);
    static const char *const none[] = {
        "A~B~C~8~~~l0n1*9*10x",
        "A~B~C~8~~~l0n1*11*10",
        "A~B~C~8~~~l0n1*9",
        "A~B~C~8~~~a0s1x",
        "A~B~C~8~~~a0m1*2",
        "A~B~C~8~~~h-m0*1e999",
        "A~B~C~8~~~h-m0*-1",
        "A~B~C~8~~~a3s1",
        "A~B~C~8x~~~a0s1",
        "A~B~C~8~~~",
        "~B~C~8~~~a0s1",
        "A~B~C~8~~a0s1",
        "A~B~C~8~ieee~spec-d3d~a0s1",
    };
    for (size_t i = 0; i < sizeof none / sizeof none[0]; i++) {
        if (brief_read(none[i], formats, &r, error))
            fail_msg("'%s' is read", none[i]);
        probe_free(&r);
    }
    memset(filled, 'a', sizeof filled - 1);
    filled[sizeof filled - 1] = '\0';
    assert_false(brief_read(filled, formats, &r, error));
    probe_free(&r);
}
