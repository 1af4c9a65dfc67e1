/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "truth.h"

#include <jansson.h>
#include <unistd.h>

#include "cli/option/option.h"
#include "support.h"

int cmd_texture(void *request);

static uint16_t half_bits(double x) {
    int e;
    if (x < 0x1p-14)
        return (uint16_t)(x * 0x1p24);
    const double m = frexp(x, &e);
    return (uint16_t)((e + 14) << 10 | (int)(m * 2048 - 1024));
}

void truth_store(void *data, image_type type, size_t i, double x) {
    if (type == IMAGE_U8)
        ((uint8_t *)data)[i] = (uint8_t)x;
    else if (type == IMAGE_U16)
        ((uint16_t *)data)[i] = (uint16_t)x;
    else if (type == IMAGE_U32)
        ((uint32_t *)data)[i] = (uint32_t)x;
    else if (type == IMAGE_F16)
        ((uint16_t *)data)[i] = half_bits(x);
    else if (type == IMAGE_F32)
        ((float *)data)[i] = (float)x;
    else
        ((double *)data)[i] = x;
}

void truth_write(const char *path, image_file file, image_type type, const void *data) {
    FILE *stream = fopen(path, "wb");
    assert_non_null(stream);
    image_writer *w = image_writer_open(stream, file, type, WIDTH, HEIGHT, 1, NULL);
    assert_non_null(w);
    assert_true(image_writer_rows(w, data, HEIGHT));
    assert_true(image_writer_close(w));
    assert_int_equal(fclose(stream), 0);
}

/* ---- The program ---- */

static char folder[] = "/tmp/depthprec-truth-XXXXXX";

const char *truth_path(const char *name) {
    static struct {
        const char *name;
        char path[64];
    } known[32];
    size_t i = 0;
    while (known[i].name != NULL && strcmp(known[i].name, name) != 0)
        assert_true(++i < sizeof known / sizeof known[0]);
    known[i].name = name;
    snprintf(known[i].path, sizeof known[i].path, "%s/%s", folder, name);
    return known[i].path;
}

int truth_run(const char *const *arguments, size_t count) {
    char *argv[ARGUMENTS + 3] = {(char *)(uintptr_t) "depthprec", (char *)(uintptr_t) "texture"};
    asked_line o;
    assert_true(count <= ARGUMENTS);
    for (size_t i = 0; i < count; i++)
        argv[i + 2] = (char *)(uintptr_t)arguments[i];
    fflush(stderr);
    const int kept = dup(STDERR_FILENO);
    assert_non_null(freopen(truth_path("said"), "w", stderr));
    int status = options_parse(&o, (int)count + 2, argv);
    if (status == EXIT_FINE)
        status = cmd_texture(o.request);
    options_release(&o);
    fflush(stderr);
    assert_true(dup2(kept, STDERR_FILENO) >= 0);
    close(kept);
    if (status != 0) {
        char line[512] = "";
        FILE *said = fopen(truth_path("said"), "r");
        if (said != NULL && fgets(line, sizeof line, said) != NULL)
            print_message("# %s", line);
        fclose(said);
    }
    return status;
}

void truth_add(command *c, const char *argument) {
    assert_true(c->count < ARGUMENTS);
    c->arguments[c->count++] = argument;
}

void truth_add_number(command *c, int slot, const char *name, double value) {
    snprintf(c->text[slot], sizeof c->text[slot], "%.17g", value);
    truth_add(c, name);
    truth_add(c, isinf(value) ? "inf" : c->text[slot]);
}

void truth_floats(const char *name, size_t channels, float *out) {
    image img;
    image_error error;
    if (!image_read(truth_path(name), &img, &error))
        fail_msg("%s: %s", name, error.text);
    assert_int_equal(img.type, IMAGE_F32);
    assert_int_equal(img.channels, channels);
    memcpy(out, img.data, PIXELS * channels * sizeof *out);
    image_free(&img);
}

void truth_greys(const char *name, double out[PIXELS]) {
    image img;
    image_error error;
    char line[256], *at = NULL;
    double lo = NAN, hi = NAN;
    FILE *said = fopen(truth_path("said"), "r");
    assert_non_null(said);
    while (fgets(line, sizeof line, said) != NULL)
        if ((at = strstr(line, ": 1 is ")) != NULL)
            assert_int_equal(sscanf(at, ": 1 is %lf, 65535 is %lf", &lo, &hi), 2);
    fclose(said);
    assert_true(lo <= hi);
    assert_true(image_read(truth_path(name), &img, &error));
    for (size_t i = 0; i < PIXELS; i++) {
        const int grey = ((const uint16_t *)img.data)[i];
        out[i] = grey == 0 ? NAN : lo + (grey - 1) * (hi - lo) / 65534;
    }
    image_free(&img);
}

json_t *truth_statistics(const command *base) {
    command c = *base;
    truth_add(&c, "--json");
    truth_add(&c, "-o");
    truth_add(&c, truth_path("said.json"));
    assert_int_equal(truth_run(c.arguments, c.count), 0);
    json_t *root = json_load_file(truth_path("said.json"), JSON_REJECT_DUPLICATES, NULL);
    assert_non_null(root);
    return root;
}

bool truth_said(const char *words) {
    char line[512];
    bool found = false;
    FILE *said = fopen(truth_path("said"), "r");
    assert_non_null(said);
    while (fgets(line, sizeof line, said) != NULL)
        found = found || strstr(line, words) != NULL;
    fclose(said);
    return found;
}

double truth_maximum(const command *base) {
    json_t *root = truth_statistics(base);
    const json_t *eye = json_array_get(json_object_get(root, "errors"), 0);
    assert_string_equal(json_string_value(json_object_get(eye, "name")), "eye depth");
    const json_t *most = json_object_get(eye, "max");
    const bool endless = json_integer_value(json_object_get(eye, "unbounded")) > 0;
    const double value = endless ? INFINITY : json_is_number(most) ? json_number_value(most) : NAN;
    json_decref(root);
    return value;
}

int truth_folder(void **state) {
    (void)state;
    return mkdtemp(folder) == NULL;
}

int truth_folder_end(void **state) {
    static const char *const names[] = {"in.png",   "in.npy",        "eye.npy",   "map.npy",   "eye.png",
                                        "map.png",  "said",          "said.json", "place.npy", "effect.npy",
                                        "said.csv", "synthetic.svg", "image.svg"};
    (void)state;
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        unlink(truth_path(names[i]));
    return rmdir(folder);
}

void truth_product(const command *base, const char *file, const char *what, const char *method, bool error) {
    command c = *base;
    char product[64];
    snprintf(product, sizeof product, "%s%s%s", what, method != NULL ? ":" : "", method != NULL ? method : "");
    truth_add(&c, "--product");
    truth_add(&c, product);
    truth_add(&c, "-o");
    truth_add(&c, truth_path(file));
    if (error)
        truth_add(&c, "--error-map");
    assert_int_equal(truth_run(c.arguments, c.count), 0);
}
