/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Images of known depths, through the program and back: what it says a pixel can be off by is never less than what the
 * pixel is off by. The depths become codes by the definitions of depthprec(7) in long double, written here once more,
 * and files of all kinds as tools write them: rounded, cut off, shifted, repeated, multiplied by a reciprocal.
 */
#include <jansson.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/options.h"
#include "support.h"
#include "texture/image.h"

int cmd_texture(const options *o);

enum { WIDTH = 24, HEIGHT = 10, PIXELS = WIDTH * HEIGHT, ARGUMENTS = 24 };

typedef long double real;

/* ---- From depth to code, by the definitions -----------------------------------------------------------------------
 */

typedef struct camera {
    real n, f;
    int ortho;
    const char *mapping, *format;
} camera;

static real window(const camera *c, real z) {
    const real n = c->n, f = c->f;
    const bool reversed = strstr(c->mapping, "reversed") != NULL;
    if (strcmp(c->mapping, "linear") == 0)
        return z / f;
    if (strcmp(c->mapping, "log") == 0)
        return log1pl(z) / log1pl(f);
    const real to_far = c->ortho ? (z - n) / (f - n) : isinf((double)f) ? (z - n) / z : f * (z - n) / (z * (f - n));
    const real to_near = c->ortho ? (f - z) / (f - n) : isinf((double)f) ? n / z : n * (f - z) / (z * (f - n));
    return reversed ? to_near : to_far;
}

static real rounded(real x, int mode) { /* 0 nearest, 1 cut off */
    return mode == 1 ? floorl(x) : floorl(x + 0.5L);
}

/* To so many significant bits, no subnormals of binary32 among what is drawn here. */
static real to_float(real x, int bits, int least, int mode) {
    int e;
    if (x == 0)
        return 0;
    frexpl(x, &e);
    const int shift = (e - bits > least ? e - bits : least);
    return ldexpl(mode == 1 ? floorl(ldexpl(x, -shift)) : rintl(ldexpl(x, -shift)), shift);
}

static real quantum(const char *format) {
    return strcmp(format, "unorm16") == 0 ? 65535 : strcmp(format, "unorm24") == 0 ? 16777215 : 0;
}

/* What the buffer holds, as a number. */
static real stored(const camera *c, real z) {
    const real d = window(c, z), most = quantum(c->format);
    return most > 0 ? rounded(d * most, 0) / most : to_float(d, 24, -149, 0);
}

/* ---- Files
 * ---------------------------------------------------------------------------------------------------------*/

typedef struct file_kind {
    const char *name;
    image_type type;
    image_file file;
    const char *buffer; /**< of which format only; null: of any */
    bool whole;         /**< samples are codes of the buffer, so its format may be asked for */
    double (*sample)(real v, real d, int mode);
} file_kind;

static double byte_of(real v, real d, int mode) {
    (void)d;
    return (double)rounded(v * 255, mode);
}
static double word_of(real v, real d, int mode) {
    (void)d;
    return (double)rounded(v * 65535, mode);
}
static double shifted(real v, real d, int mode) {
    (void)d, (void)mode;
    return floor((double)(v * 16777215 + 0.25L) / 256);
}
static double repeated(real v, real d, int mode) {
    return byte_of(v, d, mode) * 257;
}
static double high_byte(real v, real d, int mode) {
    (void)d, (void)mode;
    return floor((double)(v * 65535 + 0.25L) / 256) * 256;
}
static double ten_bits(real v, real d, int mode) {
    (void)d;
    return floor((double)(rounded(v * 1023, mode) * 65535 / 1023 + 0.5L));
}
static double code24(real v, real d, int mode) {
    (void)d, (void)mode;
    return (double)rounded(v * 16777215, 0);
}
static double divided(real v, real d, int mode) {
    (void)d, (void)mode;
    return (double)(float)(double)v;
}
static double multiplied(real v, real d, int mode) {
    (void)d, (void)mode;
    const float product = (float)(double)rounded(v * 16777215, 0) * (1.0F / 16777215.0F);
    return product < 1 ? (double)product : 1;
}
static double byte_share(real v, real d, int mode) {
    return (double)(float)(byte_of(v, d, mode) / 255);
}
static double unrounded(real v, real d, int mode) {
    (void)v, (void)mode;
    return (double)d;
}
static double half(real v, real d, int mode) {
    (void)d;
    return (double)to_float(v, 11, -24, mode);
}

static const file_kind kinds[] = {
    {"8 bits", IMAGE_U8, IMAGE_PNG, NULL, false, byte_of},
    {"16 bits", IMAGE_U16, IMAGE_PNG, NULL, false, word_of},
    {"16 of 24 bits", IMAGE_U16, IMAGE_PNG, "unorm24", false, shifted},
    {"8 bits twice", IMAGE_U16, IMAGE_PNG, NULL, false, repeated},
    {"8 of 16 bits", IMAGE_U16, IMAGE_PNG, "unorm16", false, high_byte},
    {"10 bits in 16", IMAGE_U16, IMAGE_PNG, NULL, false, ten_bits},
    {"codes of 16 bits", IMAGE_U16, IMAGE_PNG, "unorm16", true, word_of},
    {"codes of 24 bits", IMAGE_U32, IMAGE_NPY, "unorm24", true, code24},
    {"numbers", IMAGE_F32, IMAGE_NPY, NULL, true, divided},
    {"products", IMAGE_F32, IMAGE_NPY, "unorm24", true, multiplied},
    {"shares of bytes", IMAGE_F32, IMAGE_NPY, NULL, false, byte_share},
    {"unrounded", IMAGE_F64, IMAGE_NPY, "fp32", true, unrounded},
    {"halves", IMAGE_F16, IMAGE_NPY, NULL, false, half},
};
enum { KINDS = sizeof kinds / sizeof kinds[0] };

static uint16_t half_bits(double x) {
    int e;
    if (x < 0x1p-14)
        return (uint16_t)(x * 0x1p24);
    const double m = frexp(x, &e);
    return (uint16_t)((e + 14) << 10 | (int)(m * 2048 - 1024));
}

static void store(void *data, image_type type, size_t i, double x) {
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

static void write_file(const char *path, image_file file, image_type type, const void *data) {
    FILE *stream = fopen(path, "wb");
    assert_non_null(stream);
    image_writer *w = image_writer_open(stream, file, type, WIDTH, HEIGHT, 1);
    assert_non_null(w);
    assert_true(image_writer_rows(w, data, HEIGHT));
    assert_true(image_writer_close(w));
    assert_int_equal(fclose(stream), 0);
}

/* ---- The program
 * ---------------------------------------------------------------------------------------------------*/

static char folder[] = "/tmp/depthprec-truth-XXXXXX";

/* A path for each name, which stays. */
static const char *in_folder(const char *name) {
    static struct {
        const char *name;
        char path[64];
    } known[16];
    size_t i = 0;
    while (known[i].name != NULL && strcmp(known[i].name, name) != 0)
        assert_true(++i < sizeof known / sizeof known[0]);
    known[i].name = name;
    snprintf(known[i].path, sizeof known[i].path, "%s/%s", folder, name);
    return known[i].path;
}

/* Runs `depthprec texture ...`; what it says on stderr is in the file "said". */
static int texture(const char *const *arguments, size_t count) {
    char *argv[ARGUMENTS + 3] = {(char *)(uintptr_t) "depthprec", (char *)(uintptr_t) "texture"};
    options o;
    assert_true(count <= ARGUMENTS);
    for (size_t i = 0; i < count; i++)
        argv[i + 2] = (char *)(uintptr_t)arguments[i];
    fflush(stderr);
    const int kept = dup(STDERR_FILENO);
    assert_non_null(freopen(in_folder("said"), "w", stderr));
    int status = options_parse(&o, (int)count + 2, argv);
    if (status < 0)
        status = cmd_texture(&o);
    options_release(&o);
    fflush(stderr);
    assert_true(dup2(kept, STDERR_FILENO) >= 0);
    close(kept);
    if (status != 0) {
        char line[256] = "";
        FILE *said = fopen(in_folder("said"), "r");
        if (said != NULL && fgets(line, sizeof line, said) != NULL)
            print_message("# %s", line);
        fclose(said);
    }
    return status;
}

typedef struct command {
    char text[8][40];
    const char *arguments[ARGUMENTS];
    size_t count;
} command;

static void add(command *c, const char *argument) {
    assert_true(c->count < ARGUMENTS);
    c->arguments[c->count++] = argument;
}

static void add_number(command *c, int slot, const char *name, double value) {
    snprintf(c->text[slot], sizeof c->text[slot], "%.17g", value);
    add(c, name);
    add(c, isinf(value) ? "inf" : c->text[slot]);
}

static void read_floats(const char *name, float out[PIXELS]) {
    image img;
    image_error error;
    if (!image_read(in_folder(name), &img, &error))
        fail_msg("%s: %s", name, error.text);
    assert_int_equal(img.type, IMAGE_F32);
    memcpy(out, img.data, PIXELS * sizeof *out);
    image_free(&img);
}

/* A PNG of 16 bits, by what was said of it; NaN where there is no value. */
static void read_greys(const char *name, double out[PIXELS]) {
    image img;
    image_error error;
    char line[256], *at = NULL;
    double lo = NAN, hi = NAN;
    FILE *said = fopen(in_folder("said"), "r");
    assert_non_null(said);
    while (fgets(line, sizeof line, said) != NULL)
        if ((at = strstr(line, ": 1 is ")) != NULL)
            assert_int_equal(sscanf(at, ": 1 is %lf, 65535 is %lf", &lo, &hi), 2);
    fclose(said);
    assert_true(lo <= hi);
    assert_true(image_read(in_folder(name), &img, &error));
    for (size_t i = 0; i < PIXELS; i++) {
        const int grey = ((const uint16_t *)img.data)[i];
        out[i] = grey == 0 ? NAN : lo + (grey - 1) * (hi - lo) / 65534;
    }
    image_free(&img);
}

static double said_maximum(const command *base) {
    command c = *base;
    add(&c, "--json");
    add(&c, "-o");
    add(&c, in_folder("said.json"));
    assert_int_equal(texture(c.arguments, c.count), 0);
    json_t *root = json_load_file(in_folder("said.json"), JSON_REJECT_DUPLICATES, NULL);
    assert_non_null(root);
    const json_t *eye = json_array_get(json_object_get(root, "errors"), 0);
    assert_string_equal(json_string_value(json_object_get(eye, "name")), "eye depth");
    const json_t *most = json_object_get(eye, "max");
    const bool endless = json_integer_value(json_object_get(eye, "unbounded")) > 0;
    const double value = endless ? INFINITY : json_is_number(most) ? json_number_value(most) : NAN;
    json_decref(root);
    return value;
}

/* ---- Depths
 * --------------------------------------------------------------------------------------------------------*/

static const char *const pictures[] = {"near", "far", "single", "ramp", "all"};
enum { PICTURES = sizeof pictures / sizeof pictures[0] };

static void draw(rng *r, const camera *c, int picture, double z[PIXELS]) {
    const double n = (double)c->n, f = isinf((double)c->f) ? n * 1e5 : (double)c->f;
    const double one = rng_log(r, n, f);
    for (int i = 0; i < PIXELS; i++) {
        const double ramp = n + (f - n) * (i % WIDTH) / (WIDTH - 1);
        z[i] = picture == 0   ? rng_log(r, n, fmin(1.3 * n, f))
               : picture == 1 ? rng_uniform(r, n + 0.3 * (f - n), f)
               : picture == 2 ? one
               : picture == 3 ? ramp
                              : rng_log(r, n, f);
        z[i] = fmin(fmax(z[i], n), f);
    }
}

static camera draw_camera(rng *r, const char *format) {
    static const struct {
        const char *mapping;
        int ortho;
        bool endless;
    } all[] = {{"d3d", 0, true},     {"gl", 0, true},   {"reversed", 0, true}, {"gl-reversed", 0, true},
               {"linear", 0, false}, {"log", 0, false}, {"d3d", 1, false},     {"reversed", 1, false}};
    static const char *const formats[] = {"unorm16", "unorm24", "fp32"};
    const size_t k = rng_below(r, sizeof all / sizeof all[0]);
    camera c = {.ortho = all[k].ortho, .mapping = all[k].mapping};
    const double n = rng_log(r, 0.01, 10), f = n * rng_log(r, 1.5, 1e5);
    c.n = (real)n;
    c.f = all[k].endless && rng_below(r, 4) == 0 ? (real)INFINITY : (real)f;
    c.format = format != NULL ? format : formats[rng_below(r, 3)];
    return c;
}

/* Arguments point into it, so it must stay where it is; copies may be added to. */
static void base_command(command *b, const camera *c, const char *path, bool given, bool says_near) {
    b->count = 0;
    add(b, path);
    add_number(b, 0, "-f", (double)c->f);
    /* Of linear and logarithmic depth near is no more than what somebody says. */
    add_number(b, 1, "-n", (double)(says_near ? c->n : c->n * 1.2L));
    add(b, "-m");
    add(b, c->mapping);
    if (c->ortho)
        add(b, "--ortho");
    if (given) {
        add(b, "-F");
        add(b, c->format);
    }
}

static void product(const command *base, const char *file, const char *what, bool error) {
    command c = *base;
    add(&c, what);
    add(&c, "-o");
    add(&c, in_folder(file));
    if (error)
        add(&c, "--error-map");
    assert_int_equal(texture(c.arguments, c.count), 0);
}

/* ---- Eye depth is never farther off than is said
 * --------------------------------------------------------------------*/

typedef struct used {
    double most;
    uint64_t pixels, masked;
} used;

static void judge(tally *t, const file_kind *k, const camera *c, const char *picture, const double *z,
                  const double *got, const double *bound, used *u) {
    for (int i = 0; i < PIXELS; i++) {
        if (isnan(got[i])) {
            TALLY(t, isnan(bound[i]), "%s: a bound of nothing", k->name);
            u->masked++;
            continue;
        }
        const double off = fabs(got[i] - z[i]);
        if (isnan(bound[i])) /* a PNG has no infinity */
            continue;
        TALLY(t, off <= bound[i], "%s of %s %s%s, near %.17g, far %.17g, %s: z %.17g reads %.17g, off %.9g, not %.9g",
              k->name, c->format, c->mapping, c->ortho ? " ortho" : "", (double)c->n, (double)c->f, picture, z[i],
              got[i], off, bound[i]);
        u->pixels++;
        if (bound[i] > 0 && isfinite(bound[i]))
            u->most = fmax(u->most, off / bound[i]);
    }
}

static void widen(const float *from, double *to) {
    for (int i = 0; i < PIXELS; i++)
        to[i] = (double)from[i];
}

static void one_image(tally *t, rng *r, const file_kind *k, used *u) {
    const camera c = draw_camera(r, k->buffer);
    const int picture = (int)rng_below(r, PICTURES), mode = (int)rng_below(r, 2);
    /* What is not said is taken to be finer than the file: binary16 of 16 bits is not. */
    const bool given = rng_below(r, 2) == 0 || k->whole || (k->type == IMAGE_F16 && quantum(c.format) == 65535);
    const bool curved = strcmp(c.mapping, "linear") == 0 || strcmp(c.mapping, "log") == 0;
    double z[PIXELS], got[PIXELS], bound[PIXELS];
    float eye[PIXELS], map[PIXELS];
    static double data[PIXELS];
    draw(r, &c, picture, z);
    for (int i = 0; i < PIXELS; i++)
        store(data, k->type, (size_t)i, k->sample(stored(&c, (real)z[i]), window(&c, (real)z[i]), mode));
    const char *path = in_folder(k->file == IMAGE_PNG ? "in.png" : "in.npy");
    write_file(path, k->file, k->type, data);
    command base;
    base_command(&base, &c, path, given, !curved);
    product(&base, "eye.npy", "--eye", false);
    product(&base, "map.npy", "--eye", true);
    read_floats("eye.npy", eye);
    read_floats("map.npy", map);
    widen(eye, got);
    widen(map, bound);
    judge(t, k, &c, pictures[picture], z, got, bound, u);
    /* The statistics of fp32 touch a bit for each of its codes. */
    const double most = rng_below(r, strcmp(c.format, "fp32") == 0 ? 64 : 8) == 0 ? said_maximum(&base) : NAN;
    for (int i = 0; i < PIXELS; i++)
        TALLY(t, isnan(most) || isnan(got[i]) || fabs(got[i] - z[i]) <= most, "%s: the statistics say %g", k->name,
              most);
    if (rng_below(r, 4) == 0) {
        product(&base, "eye.png", "--eye", false);
        read_greys("eye.png", got);
        product(&base, "map.png", "--eye", true);
        read_greys("map.png", bound);
        used other = {0};
        for (int i = 0; i < PIXELS; i++)
            got[i] = isnan(bound[i]) ? NAN : got[i];
        judge(t, k, &c, pictures[picture], z, got, bound, &other);
    }
}

static void eye_depth_is_within_what_is_said(void **state) {
    (void)state;
    const uint64_t rounds = test_cases(10, 60, 2000);
    tally t = {.name = "eye depth"};
    rng r = rng_make("image truth");
    used all[KINDS] = {{0}};
    for (uint64_t i = 0; i < rounds; i++)
        for (size_t k = 0; k < KINDS; k++)
            one_image(&t, &r, &kinds[k], &all[k]);
    for (size_t k = 0; k < KINDS; k++) {
        print_message("# %s: %.3f of the bound is used, %llu pixels, %llu masked\n", kinds[k].name, all[k].most,
                      (unsigned long long)all[k].pixels, (unsigned long long)all[k].masked);
        if (rounds >= 60 && !(all[k].most > 0.4))
            fail_msg("%s: the bound is loose", kinds[k].name);
    }
    tally_end(&t);
}

static int make_folder(void **state) {
    (void)state;
    return mkdtemp(folder) == NULL;
}

static int remove_folder(void **state) {
    static const char *const names[] = {"in.png",  "in.npy", "eye.npy",   "map.npy", "eye.png",
                                        "map.png", "said",   "said.json", "b.npy"};
    (void)state;
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        unlink(in_folder(names[i]));
    return rmdir(folder);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(eye_depth_is_within_what_is_said, make_folder, remove_folder),
    };
    return run_tap(tests);
}
