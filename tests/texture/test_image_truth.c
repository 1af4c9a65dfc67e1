/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Images of known depths, through the program and back: what it says a pixel can be off by is never less than what the
 * pixel is off by. The depths become codes by the definitions of depthprec(7) in long double, written here once more,
 * and files of all kinds as tools write them: rounded, cut off, shifted, repeated, multiplied by a reciprocal.
 */
#include "support.h"
#include "truth.h"

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

/* The depth that the buffer holds, as a number. */
static real stored(const camera *c, real z) {
    const real d = window(c, z), most = quantum(c->format);
    return most > 0 ? rounded(d * most, 0) / most : to_float(d, 24, -149, 0);
}

/* ---- Files ---- */

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
static double byte_up(real v, real d, int mode) {
    return byte_of(v, d, mode) * 256; /* k/255, shifted up */
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
    {"8 bits times 256", IMAGE_U16, IMAGE_PNG, NULL, false, byte_up},
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
    {"halves in f4", IMAGE_F32, IMAGE_NPY, NULL, false, half},
    {"halves in f8", IMAGE_F64, IMAGE_NPY, "unorm16", false, half},
};
enum { KINDS = sizeof kinds / sizeof kinds[0] };

/* ---- Depths ---- */

static const char *const pictures[] = {"near", "far", "single", "ramp", "all"};
enum { PICTURES = sizeof pictures / sizeof pictures[0] };

static void draw(rng *r, const camera *c, int picture, double z[PIXELS]) {
    const double n = (double)c->n, f = isinf((double)c->f) ? n * 1e5 : (double)c->f;
    const double one = n > 0 ? rng_log(r, n, f) : rng_depth(r, n, f);
    for (int i = 0; i < PIXELS; i++) {
        if (n <= 0) {
            z[i] = picture == 2 ? one : rng_depth(r, n, f);
            continue;
        }
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

static void base_command(command *b, const camera *c, const char *path, bool given, bool says_near) {
    b->count = 0;
    truth_add(b, path);
    truth_add_number(b, 0, "-f", (double)c->f);
    /* Nothing but what somebody says tells near of linear and logarithmic depth. */
    truth_add_number(b, 1, "-n", (double)(says_near ? c->n : c->n * 1.2L));
    truth_add(b, "-m");
    truth_add(b, c->mapping);
    if (c->ortho)
        truth_add(b, "--ortho");
    if (given) {
        truth_add(b, "-F");
        truth_add(b, c->format);
    }
}

/* ---- Eye depth is never farther off than is said ---- */

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

/* An orthographic camera that begins at its place or behind it. */
static camera draw_camera_signed(rng *r, const char *format) {
    camera c = draw_camera(r, format);
    double n, f;
    rng_planes(r, &n, &f);
    c.n = (real)n;
    c.f = (real)f;
    c.ortho = 1;
    c.mapping = rng_below(r, 2) ? "d3d" : "reversed";
    return c;
}

static void one_image(tally *t, rng *r, const file_kind *k, bool either_sign, used *u) {
    const camera c = either_sign ? draw_camera_signed(r, k->buffer) : draw_camera(r, k->buffer);
    const int picture = (int)rng_below(r, PICTURES), mode = (int)rng_below(r, 2);
    const bool given = rng_below(r, 2) == 0 || k->whole;
    const bool curved = strcmp(c.mapping, "linear") == 0 || strcmp(c.mapping, "log") == 0;
    double z[PIXELS], got[PIXELS], bound[PIXELS];
    float eye[PIXELS], map[PIXELS];
    static double data[PIXELS];
    draw(r, &c, picture, z);
    for (int i = 0; i < PIXELS; i++)
        truth_store(data, k->type, (size_t)i, k->sample(stored(&c, (real)z[i]), window(&c, (real)z[i]), mode));
    const char *path = truth_path(k->file == IMAGE_PNG ? "in.png" : "in.npy");
    truth_write(path, k->file, k->type, data);
    command base;
    base_command(&base, &c, path, given, !curved);
    truth_product(&base, "eye.npy", "eye", NULL, false);
    truth_product(&base, "map.npy", "eye", NULL, true);
    truth_floats("eye.npy", 1, eye);
    truth_floats("map.npy", 1, map);
    widen(eye, got);
    widen(map, bound);
    judge(t, k, &c, pictures[picture], z, got, bound, u);
    /* The statistics of fp32 touch a bit for each of its codes. */
    const double most = rng_below(r, strcmp(c.format, "fp32") == 0 ? 64 : 8) == 0 ? truth_maximum(&base) : NAN;
    for (int i = 0; i < PIXELS; i++)
        TALLY(t, isnan(most) || isnan(got[i]) || fabs(got[i] - z[i]) <= most, "%s: the statistics say %g", k->name,
              most);
    if (rng_below(r, 4) == 0) {
        truth_product(&base, "eye.png", "eye", NULL, false);
        truth_greys("eye.png", got);
        truth_product(&base, "map.png", "eye", NULL, true);
        truth_greys("map.png", bound);
        used other = {0};
        double lo = INFINITY, hi = -INFINITY;
        for (int i = 0; i < PIXELS; i++) {
            const double depth = (double)eye[i]; /* fmin and fmax here crash gcc 12 when it compiles for aarch64 */
            lo = depth < lo ? depth : lo;
            hi = depth > hi ? depth : hi;
        }
        /* Half a grey of the product, of 65535 from 0 or of 65534 from lo, on top of the map, and rounded up. */
        const double half = lo > 0 ? hi / 131070 : (hi - lo) / 131068;
        for (int i = 0; i < PIXELS; i++)
            TALLY(t, isnan(bound[i]) || bound[i] >= (double)map[i] + half, "%s: %.9g in a PNG of %.9g", k->name,
                  bound[i], (double)map[i]);
        for (int i = 0; i < PIXELS; i++)
            got[i] = isnan(bound[i]) ? NAN : got[i];
        judge(t, k, &c, pictures[picture], z, got, bound, &other);
    }
}

TEST(eye_depth_is_within_what_is_said) {
    const uint64_t rounds = test_cases(6, 12, 2000);
    tally t = {.name = "eye depth"};
    rng r = rng_make("image truth");
    used all[KINDS] = {{0}};
    for (uint64_t i = 0; i < rounds; i++)
        for (size_t k = 0; k < KINDS; k++)
            one_image(&t, &r, &kinds[k], false, &all[k]);
    for (size_t k = 0; k < KINDS; k++) {
        print_message("# %s: %.3f of the bound is used, %llu pixels, %llu masked\n", kinds[k].name, all[k].most,
                      (unsigned long long)all[k].pixels, (unsigned long long)all[k].masked);
        if (rounds >= 12 && !(all[k].most > 0.4))
            fail_msg("%s: the bound is loose", kinds[k].name);
    }
    tally_end(&t);
}

TEST(depths_of_either_sign_too) {
    tally t = {.name = "eye depth of either sign"};
    rng r = rng_make("image truth, either sign");
    used all = {0};
    for (uint64_t i = test_cases(1, 4, 400); i > 0; i--)
        for (size_t k = 0; k < KINDS; k++)
            one_image(&t, &r, &kinds[k], true, &all);
    assert_true(all.pixels > 0 && all.most > 0.4);
    tally_end(&t);
}

/* ---- Places and effects ---- */

static const double HALF_HEIGHT = 5, PI = 3.14159265358979323846;

/* The tangent of half the field of view. */
static const real TANGENT = 0.577350269189625764509L;

/* How far a place is from the one that pixel i sees at depth z: the camera is at the origin and looks along z. */
static double away(const camera *c, int i, real z, const float got[3]) {
    const real half = c->ortho ? (real)HALF_HEIGHT : TANGENT, along = c->ortho ? 1 : z;
    const real x = (2.0L * (i % WIDTH) + 1 - WIDTH) / WIDTH * half * WIDTH / HEIGHT * along - (real)got[0];
    const real y = (HEIGHT - 2.0L * (i / WIDTH) - 1) / HEIGHT * half * along - (real)got[1], rest = z - (real)got[2];
    return (double)sqrtl(x * x + y * y + rest * rest);
}

static double clamp01(double x) {
    return fmin(fmax(x, 0), 1);
}

/* The default parameters' formulas. */
static double fog(const camera *c, double z, double reference) {
    (void)reference;
    return clamp01(z / (double)c->f);
}
static double intersection(const camera *c, double z, double reference) {
    (void)c;
    return clamp01(fabs(reference - z) / 0.1);
}
static double scan_line(const camera *c, double z, double reference) {
    return clamp01(fabs(reference - z) / (double)c->f / 0.01);
}
static double motion_blur(const camera *c, double z, double reference) {
    (void)reference;
    const double half = c->ortho ? HALF_HEIGHT : tan(60 * PI / 360);
    return 0.1 / (half * WIDTH / HEIGHT) / 2 / (c->ortho ? 1 : z);
}
static double depth_of_field(const camera *c, double z, double reference) {
    return clamp01(fabs(z - reference) / (double)c->f * 10);
}

static const struct {
    const char *name;
    bool compares, finite;
    double (*of)(const camera *c, double z, double reference);
} effects[] = {{"fog", false, true, fog},
               {"intersection", true, false, intersection},
               {"scan-line", true, true, scan_line},
               {"motion-blur", false, false, motion_blur},
               {"depth-of-field", true, true, depth_of_field}};
enum { EFFECTS = sizeof effects / sizeof effects[0] };

/* A picture of a file of some kind. */
static void random_image(rng *r, const file_kind *k, camera *c, command *base, double z[PIXELS]) {
    static double data[PIXELS];
    *c = draw_camera(r, k->buffer);
    const int mode = (int)rng_below(r, 2);
    const bool curved = strcmp(c->mapping, "linear") == 0 || strcmp(c->mapping, "log") == 0;
    draw(r, c, (int)rng_below(r, PICTURES), z);
    for (int i = 0; i < PIXELS; i++)
        truth_store(data, k->type, (size_t)i, k->sample(stored(c, (real)z[i]), window(c, (real)z[i]), mode));
    const char *path = truth_path(k->file == IMAGE_PNG ? "in.png" : "in.npy");
    truth_write(path, k->file, k->type, data);
    base_command(base, c, path, true, !curved);
}

static double one_place(tally *t, rng *r, const file_kind *k) {
    camera c;
    command base;
    double z[PIXELS], most = 0;
    float got[3 * PIXELS], bound[PIXELS];
    random_image(r, k, &c, &base, z);
    const char *method = rng_below(r, 2) == 0 ? "exact" : "view";
    truth_product(&base, "place.npy", "position", method, false);
    truth_product(&base, "map.npy", "position", method, true);
    truth_floats("place.npy", 3, got);
    truth_floats("map.npy", 1, bound);
    for (int i = 0; i < PIXELS; i++) {
        const double off = away(&c, i, (real)z[i], got + 3 * i);
        if (isnan(got[3 * i])) {
            TALLY(t, isnan(bound[i]), "a bound %g of no place by %s in %s %s z %g", (double)bound[i], method, k->name,
                  c.mapping, z[i]);
            continue;
        }
        TALLY(t, off <= (double)bound[i], "%s of %s %s by %s: z %.17g is %.9g off, not %.9g", k->name, c.format,
              c.mapping, method, z[i], off, (double)bound[i]);
        if (bound[i] > 0 && !isinf(bound[i]))
            most = fmax(most, off / (double)bound[i]);
    }
    return most;
}

static double one_effect(tally *t, rng *r, const file_kind *k) {
    camera c;
    command base, compared;
    double z[PIXELS], most = 0;
    float got[PIXELS], bound[PIXELS];
    char reference[40];
    random_image(r, k, &c, &base, z);
    const size_t e = rng_below(r, EFFECTS);
    if (effects[e].finite && isinf((double)c.f))
        return 0;
    const double at = z[rng_below(r, PIXELS)];
    if (effects[e].of == motion_blur) {
        truth_add(&base, "--last-eye");
        truth_add(&base, "0.1,0,0");
    }
    compared = base;
    if (effects[e].compares) {
        snprintf(reference, sizeof reference, "reference=%.17g", at);
        truth_add(&compared, "--parameter");
        truth_add(&compared, reference);
    }
    truth_product(&compared, "effect.npy", "effect", effects[e].name, false);
    truth_product(&base, "map.npy", "effect", effects[e].name, true);
    truth_floats("effect.npy", 1, got);
    truth_floats("map.npy", 1, bound);
    for (int i = 0; i < PIXELS; i++) {
        if (isnan(got[i])) {
            TALLY(t, isnan(bound[i]), "a bound of no effect");
            continue;
        }
        const double off = fmin(255 * fabs((double)got[i] - effects[e].of(&c, z[i], at)), 255);
        TALLY(t, off <= (double)bound[i], "%s of %s %s: %s at z %.17g is %.9g levels off, not %.9g", k->name, c.format,
              c.mapping, effects[e].name, z[i], off, (double)bound[i]);
        if (bound[i] > 0)
            most = fmax(most, off / (double)bound[i]);
    }
    return most;
}

TEST(products_are_within_what_is_said) {
    const uint64_t rounds = test_cases(2, 5, 1000);
    tally t = {.name = "products"};
    rng r = rng_make("image products");
    double places = 0, levels = 0;
    for (uint64_t i = 0; i < rounds; i++)
        for (size_t k = 0; k < KINDS; k++) {
            places = fmax(places, one_place(&t, &r, &kinds[k]));
            levels = fmax(levels, one_effect(&t, &r, &kinds[k]));
        }
    print_message("# of the bounds of places %.3f is used, of effects %.3f\n", places, levels);
    assert_true(places > 0.9 && levels > 0.9);
    tally_end(&t);
}

/* Beside the near plane a cell of binary32 is finer than what doubles lose on the way to a map. */
TEST(doubles_lose_too) {
    tally t = {.name = "next to near"};
    rng r = rng_make("next to near");
    static const char *const products[] = {"eye", "linear01", "position"};
    for (uint64_t i = test_cases(20, 100, 4000); i > 0; i--) {
        camera c = {(real)rng_log(&r, 0.01, 10), 1000, 0, "d3d", "fp32"};
        float d[PIXELS], got[3 * PIXELS], bound[PIXELS];
        const size_t kind = rng_below(&r, 3);
        command base;
        for (int k = 0; k < PIXELS; k++)
            d[k] = (float)ldexp(1 + rng_unit(&r), -40 + (int)rng_below(&r, 24));
        truth_write(truth_path("in.npy"), IMAGE_NPY, IMAGE_F32, d);
        base_command(&base, &c, truth_path("in.npy"), true, true);
        truth_product(&base, "eye.npy", products[kind], NULL, false);
        truth_product(&base, "map.npy", products[kind], NULL, true);
        truth_floats("eye.npy", kind == 2 ? 3 : 1, got);
        truth_floats("map.npy", 1, bound);
        for (int k = 0; k < PIXELS; k++) {
            const real z = c.n * c.f / (c.f - (real)d[k] * (c.f - c.n));
            const double off =
                kind == 2 ? away(&c, k, z, got + 3 * k) : (double)fabsl(z / (kind == 1 ? c.f : 1) - (real)got[k]);
            TALLY(&t, off <= (double)bound[k], "%s at %.17g: %.12g off, not %.12g", products[kind], (double)z, off,
                  (double)bound[k]);
        }
    }
    tally_end(&t);
}

int main(void) {
    return run_listed(truth_folder, truth_folder_end);
}
