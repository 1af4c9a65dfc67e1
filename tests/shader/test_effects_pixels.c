/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Effects over images and scenes, each pixel against a formula in double: the camera's rays, the world position and
 * last frame's projection are those of this file. Images hold random codes; of a scene the truth is a plane's.
 */
#include "named.h"
#include "setups.h"
#include "support.h"
#include "synthetic_stage.h"
#include "texture/frame.h"

enum { ACROSS = 7, DOWN = 9, PIXELS = ACROSS * DOWN, CODE_MAX = 65535 };

static const double NEAR = 1, FAR = 100, RADIAN = 3.14159265358979323846 / 180;

/* ---- A camera ---------------------------------------------------------------------------------------------------- */

typedef struct eye_point {
    double fov, half_height, yaw, pitch, origin[3];
} eye_point;

typedef struct stage {
    bool ortho, reversed;
    eye_point now, last;
    double reference; /* of what compares */
    dp_setup setup;
    texture_camera camera, before;
} stage;

static void axes_of(const eye_point *e, double right[3], double up[3], double forward[3]) {
    const double y = e->yaw * RADIAN, p = e->pitch * RADIAN;
    const double all[3][3] = {
        {cos(y), 0, -sin(y)}, {-sin(p) * sin(y), cos(p), -sin(p) * cos(y)}, {cos(p) * sin(y), sin(p), cos(p) * cos(y)}};
    memcpy(right, all[0], sizeof all[0]);
    memcpy(up, all[1], sizeof all[1]);
    memcpy(forward, all[2], sizeof all[2]);
}

/* Half the picture's width and height: per unit of eye depth, or in scene units. */
static void half_of(const stage *s, const eye_point *e, double half[2]) {
    half[1] = s->ortho ? e->half_height : tan(e->fov / 2 * RADIAN);
    half[0] = half[1] * ACROSS / DOWN;
}

static double ndc_x(int pixel) {
    return 2 * (pixel % ACROSS + 0.5) / ACROSS - 1;
}

static double ndc_y(int pixel) {
    return 1 - 2 * (pixel / ACROSS + 0.5) / DOWN; /* the first row is on top */
}

static void world_of(const stage *s, int pixel, double z, double world[3]) {
    double right[3], up[3], forward[3], half[2];
    const double along = s->ortho ? 1 : z;
    axes_of(&s->now, right, up, forward);
    half_of(s, &s->now, half);
    for (int k = 0; k < 3; k++)
        world[k] = s->now.origin[k] + along * half[0] * ndc_x(pixel) * right[k] +
                   along * half[1] * ndc_y(pixel) * up[k] + z * forward[k];
}

static void last_ndc(const stage *s, const double world[3], double ndc[2]) {
    double right[3], up[3], forward[3], half[2], view[3] = {0, 0, 0};
    axes_of(&s->last, right, up, forward);
    half_of(s, &s->last, half);
    for (int k = 0; k < 3; k++) {
        const double from = world[k] - s->last.origin[k];
        view[0] += from * right[k];
        view[1] += from * up[k];
        view[2] += from * forward[k];
    }
    for (int k = 0; k < 2; k++)
        ndc[k] = view[k] / half[k] / (s->ortho ? 1 : view[2]);
}

/* ---- Effects ----------------------------------------------------------------------------------------------------- */

static double unit(double x) {
    return x < 0 ? 0 : x > 1 ? 1 : x;
}

typedef double formula(const stage *s, int pixel, double z);

static double intersection(const stage *s, int pixel, double z) {
    (void)pixel;
    return unit(fabs(s->reference - z) / 3);
}

static double force_field(const stage *s, int pixel, double z) {
    (void)pixel;
    return fmax(0, (1 - (z - s->reference)) * 0.3);
}

static double force_field_rim(const stage *s, int pixel, double z) {
    (void)pixel;
    return fmax(1 - 0.5 * 1.6, (1 - (z - s->reference)) * 0.3);
}

static double fog(const stage *s, int pixel, double z) {
    (void)s, (void)pixel;
    return unit(z / FAR * 1.7);
}

static double radial_fog(const stage *s, int pixel, double z) {
    double half[2];
    half_of(s, &s->now, half);
    const double x = half[0] * ndc_x(pixel), y = half[1] * ndc_y(pixel), along = s->ortho ? 1 : sqrt(x * x + y * y + 1);
    return unit(z * along / FAR * 1.3);
}

static double scan_line(const stage *s, int pixel, double z) {
    (void)pixel;
    return unit(fabs(s->reference / FAR - z / FAR) / 0.07);
}

static double depth_of_field(const stage *s, int pixel, double z) {
    (void)pixel;
    return unit(fabs(z / FAR - s->reference / FAR) * 4);
}

static double water_line(const stage *s, int pixel, double z) {
    double world[3];
    world_of(s, pixel, z, world);
    return unit((-1.5 - world[1]) / 2.5);
}

static double hard_line(const stage *s, int pixel, double z) {
    double world[3];
    world_of(s, pixel, z, world);
    return world[1] < -1.5;
}

static double height_fog(const stage *s, int pixel, double z) {
    double world[3];
    world_of(s, pixel, z, world);
    return unit((world[1] - 4) / (-30.0 - 4) * 0.8);
}

static double motion_blur(const stage *s, int pixel, double z) {
    double world[3], last[2];
    world_of(s, pixel, z, world);
    last_ndc(s, world, last);
    return 1.5 * hypot((ndc_x(pixel) - last[0]) / 2, (ndc_y(pixel) - last[1]) / 2);
}

static double soft_particles(const stage *s, int pixel, double z) {
    (void)pixel;
    return unit((z - s->reference) / 4);
}

/* As deep in the box as the nearest face is: 3 wide, 4 high and 30 deep, turned by 25 degrees. */
static double decal_inside(const stage *s, int pixel, double z) {
    const double turn = 25 * RADIAN, middle[3] = {1, -0.5, 18}, size[3] = {3, 4, 30};
    double world[3], from[3];
    world_of(s, pixel, z, world);
    for (int k = 0; k < 3; k++)
        from[k] = world[k] - middle[k];
    const double local[3] = {from[0] * cos(turn) - from[2] * sin(turn), from[1],
                             from[0] * sin(turn) + from[2] * cos(turn)};
    double inside = INFINITY;
    for (int k = 0; k < 3; k++)
        inside = fmin(inside, size[k] / 2 - fabs(local[k]));
    return inside;
}

static double decal(const stage *s, int pixel, double z) {
    return unit(decal_inside(s, pixel, z) / 0.7);
}

static double hard_decal(const stage *s, int pixel, double z) {
    return decal_inside(s, pixel, z) >= 0;
}

static double contact_shadow(const stage *s, int pixel, double z) {
    (void)pixel;
    return s->reference - z >= 0 && s->reference - z < 5;
}

static double shadow(const stage *s, int pixel, double z) {
    (void)pixel;
    return s->reference - 2 <= z;
}

/* Along the ray of the pixel, which is longer than the eye depth. */
static double water_depth(const stage *s, int pixel, double z) {
    double half[2];
    half_of(s, &s->now, half);
    const double x = half[0] * ndc_x(pixel), y = half[1] * ndc_y(pixel), along = s->ortho ? 1 : sqrt(x * x + y * y + 1);
    return z > s->reference ? 1 - exp(-0.08 * (z - s->reference) * along) : 0;
}

static const struct {
    const char *name, *parameters; /* NAME=VALUE, separated by blanks */
    formula *of;
    bool compares, hard; /* hard: 0 or 1 */
    double wide;         /* how much more than the largest difference of outputs an error may state */
} effects[] = {
    {"intersection", "half-width=3", intersection, true, false, 1},
    {"force-field", "power=0.3", force_field, true, false, 1},
    {"force-field", "power=0.3 rim-power=1.6 facing=0.5", force_field_rim, true, false, 1},
    {"fog", "density=1.7", fog, false, false, 1},
    {"radial-fog", "density=1.3", radial_fog, false, false, 1},
    {"scan-line", "half-width=0.07", scan_line, true, false, 1},
    {"depth-of-field", "level=4", depth_of_field, true, false, 1},
    {"water-line", "band=2.5 level=-1.5", water_line, false, false, 1},
    {"water-line", "band=0 level=-1.5", hard_line, false, true, 1},
    {"height-fog", "density=0.8 start=4 end=-30", height_fog, false, false, 1},
    {"soft-particles", "fade-distance=4", soft_particles, true, false, 1},
    {"ray-march", "step=4", soft_particles, true, false, 1},
    {"thickness", "scale=4", soft_particles, true, false, 1},
    {"decal", "feather=0.7 yaw=25 x=1 y=-0.5 z=18 width=3 height=4 depth=30", decal, false, false, 1},
    {"decal", "feather=0 yaw=25 x=1 y=-0.5 z=18 width=3 height=4 depth=30", hard_decal, false, true, 1},
    {"contact-shadow", "thickness=5", contact_shadow, true, true, 1},
    {"shadow", "bias=2", shadow, true, true, 1},
    {"water-depth", "density=0.08", water_depth, true, false, 1},
    {"motion-blur", "strength=1.5", motion_blur, false, false,
     50}, /* a difference of velocities, not of their lengths */
};
enum { EFFECTS = sizeof effects / sizeof effects[0] };

static void settings_of(const effect_row *row, const char *text, double out[PARAMETERS_MAX]) {
    char name[32];
    double value;
    int used;
    parameter_defaults(row->parameters, out);
    for (; sscanf(text, " %31[a-z0-9-]=%lf%n", name, &value, &used) == 2; text += used) {
        const int at = parameter_find(row->parameters, name);
        assert_true(at >= 0);
        out[at] = value;
    }
    assert_true(*text == '\0');
}

/* ---- Stages ------------------------------------------------------------------------------------------------------ */

static void camera_of(const stage *s, const eye_point *e, texture_camera *out) {
    camera_spec view = camera_spec_default();
    view.width = ACROSS;
    view.height = DOWN;
    view.fov_y = e->fov;
    view.half_height = e->half_height;
    view.yaw = e->yaw;
    view.pitch = e->pitch;
    memcpy(view.origin, e->origin, sizeof view.origin);
    assert_null(camera_init(out, &s->setup, &view));
}

static void stage_ready(stage *s) {
    dp_format formats[2];
    dp_spec spec = dp_spec_default();
    assert_true(dp_format_parse("unorm16", formats) >= 1);
    spec.format = formats[0];
    spec.mapping = s->reversed ? DP_MAPPING_REVERSED : DP_MAPPING_D3D;
    spec.ortho = s->ortho;
    spec.znear = NEAR;
    spec.zfar = FAR;
    assert_int_equal(dp_setup_init(&s->setup, &spec), DP_OK);
    camera_of(s, &s->now, &s->camera);
    camera_of(s, &s->last, &s->before);
}

static eye_point near_to(rng *r, const eye_point *e, double turn, double way) {
    eye_point out = *e;
    out.yaw += rng_uniform(r, -turn, turn);
    out.pitch += rng_uniform(r, -turn, turn);
    for (int k = 0; k < 3; k++)
        out.origin[k] += rng_uniform(r, -way, way);
    return out;
}

static void stage_any(rng *r, stage *s) {
    *s = (stage){.ortho = rng_below(r, 3) == 0, .reversed = rng_below(r, 2) == 0, .reference = rng_uniform(r, 3, 60)};
    s->now = (eye_point){.fov = rng_uniform(r, 20, 100), .half_height = rng_uniform(r, 2, 20)};
    s->now = near_to(r, &s->now, 60, 8);
    s->last = near_to(r, &s->now, 3, 0.3);
    if (!s->ortho)
        s->last.fov += rng_uniform(r, -2, 2);
    stage_ready(s);
}

static double eye_of(const stage *s, double code) {
    const double share = code / CODE_MAX, d = s->reversed ? 1 - share : share;
    return s->ortho ? NEAR + d * (FAR - NEAR) : 1 / ((1 - d) / NEAR + d / FAR);
}

static bool keep(void *context, uint32_t row, uint32_t count, const float *values) {
    memcpy((float *)context + (size_t)row * ACROSS, values, (size_t)count * ACROSS * sizeof *values);
    return true;
}

static void make(const stage *s, const frame *f, size_t effect, bool error, float out[PIXELS]) {
    const effect_row *row = effect_find(effects[effect].name);
    double at[PARAMETERS_MAX];
    settings_of(row, effects[effect].parameters, at);
    assert_true(row->given == effects[effect].compares);
    const int share = parameter_find(row->parameters, "reference01"); /* turn by turn in place of the depth itself */
    if (row->given && s->reference > 0 && share >= 0 && s->reversed)
        at[share] = s->reference / FAR;
    else if (row->given && s->reference > 0)
        at[parameter_find(row->parameters, "reference")] = s->reference;
    const frame_product p = {.kind = FRAME_EFFECT, .effect = row, .effect_settings = at, .error = error};
    assert_null(frame_refuses(f, &p));
    assert_true(frame_run(f, &p, false, keep, out));
}

/* ---- Images ------------------------------------------------------------------------------------------------------ */

/* Binary32 decodes eye depth within a few units of 2^-24 times far/near; outputs are at most as steep as this. */
static const double ROUNDED = 3e-5;

static double difference(formula *of, const stage *s, int pixel, double code, double other) {
    return fabs(of(s, pixel, eye_of(s, code)) - of(s, pixel, eye_of(s, other)));
}

/* Between two places that are looked at a ray may come nearest to the middle of a decal, or leave its nearest face for
 * another: by thirds. */
static double deepest(const stage *s, int pixel, double lo, double hi) {
    for (int i = 0; i < 100; i++) {
        const double third = (hi - lo) / 3;
        const bool rises = decal_inside(s, pixel, lo + third) < decal_inside(s, pixel, hi - third);
        *(rises ? &lo : &hi) = rises ? lo + third : hi - third;
    }
    return lo;
}

/* How deep in the box a ray comes between two depths: at an end, or where the nearest face changes. */
TEST(test_deepest) {
    const effect_row *row = effect_find("decal");
    rng r = rng_make("inside decals");
    tally t = {.name = "inside decals"};
    uint64_t within = 0;
    double p[PARAMETERS_MAX];
    for (size_t e = 0; e < EFFECTS; e++)
        if (effects[e].of == decal)
            settings_of(row, effects[e].parameters, p);
    for (uint64_t i = 0; i < test_cases(2000, 20000, 400000); i++) {
        stage s;
        stage_any(&r, &s);
        const int pixel = (int)rng_below(&r, PIXELS);
        const effect_view view = effect_view_of(&s.camera, NULL, pixel % ACROSS, pixel / ACROSS);
        const double lo = rng_uniform(&r, 1, 40), hi = lo + rng_log(&r, 0.01, 30);
        const double at = deepest(&s, pixel, lo, hi), got = row->most(&view, p, lo, hi);
        TALLY(&t, fabs(got - decal_inside(&s, pixel, at)) <= 1e-9, "pixel %d from %a to %a: %.17g, not %.17g", pixel,
              lo, hi, got, decal_inside(&s, pixel, at));
        within += at > lo * 1.001 && at < hi * 0.999;
    }
    assert_true(within > t.cases / 200);
    tally_end(&t);
}

/* The output is the formula's at the stored depth; the error what the cell's depths make of it, seen at 33 of them. */
TEST(test_images) {
    enum { PLACES = 32 };
    static uint32_t codes[PIXELS];
    static float got[PIXELS], bound[PIXELS];
    const image depths = {
        .width = ACROSS, .height = DOWN, .channels = 1, .type = IMAGE_U32, .file = IMAGE_NPY, .data = codes};
    rng r = rng_make("effects of images");
    tally t = {.name = "images"};
    for (uint64_t i = 0; i < test_cases(300, 3000, 100000); i++) {
        const size_t e = (size_t)(i % EFFECTS);
        stage s;
        stage_any(&r, &s);
        const frame f = {.camera = &s.camera, .last = &s.before, .image = &depths, .sky = 0, .threads = 1};
        for (size_t k = 0; k < PIXELS; k++)
            codes[k] = 600 + (uint32_t)rng_below(&r, 64000);
        make(&s, &f, e, false, got);
        make(&s, &f, e, true, bound);
        for (int k = 0; k < PIXELS; k++) {
            const double want = effects[e].of(&s, k, eye_of(&s, codes[k]));
            const bool hard = effects[e].hard;
            double error = 0;
            for (int a = 0; a <= PLACES; a++)
                error = fmax(error, difference(effects[e].of, &s, k, codes[k], codes[k] - 0.5 + (double)a / PLACES));
            const double ends[2] = {eye_of(&s, codes[k] - (s.reversed ? -0.5 : 0.5)),
                                    eye_of(&s, codes[k] + (s.reversed ? -0.5 : 0.5))};
            if (effects[e].of == decal || effects[e].of == hard_decal)
                error = fmax(error, fabs(effects[e].of(&s, k, deepest(&s, k, ends[0], ends[1])) - want));
            const double most = 255 * fmin(error * effects[e].wide + ROUNDED, 1);
            TALLY(&t, fabs((double)got[k] - want) <= (hard ? (double)bound[k] / 255 : ROUNDED),
                  "%s %s pixel %d code %u: %.9g, not %.9g", effects[e].name, s.ortho ? "ortho" : "", k, codes[k],
                  (double)got[k], want);
            TALLY(&t, (double)bound[k] >= 255 * fmin(error, 1) * (1 - 1e-9),
                  "%s pixel %d code %u: %.9g levels, not %.9g", effects[e].name, k, codes[k], (double)bound[k],
                  255 * error);
            TALLY(&t, hard ? bound[k] == 0 || bound[k] == 255 : (double)bound[k] <= most,
                  "%s pixel %d code %u: %.9g levels, at most %.9g", effects[e].name, k, codes[k], (double)bound[k],
                  most);
        }
    }
    tally_end(&t);
}

/* Where what an effect compares with is not given, the error holds for any place of it, the cell's ends among them, and
 * is no more than it takes. */
TEST(test_worst) {
    enum { PLACES = 32, REFERENCES = 3 };
    static uint32_t codes[PIXELS];
    static float got[PIXELS], worst[PIXELS];
    const image depths = {
        .width = ACROSS, .height = DOWN, .channels = 1, .type = IMAGE_U32, .file = IMAGE_NPY, .data = codes};
    rng r = rng_make("effects of images, at their worst");
    tally t = {.name = "worst"};
    for (uint64_t i = 0; i < test_cases(300, 3000, 100000); i++) {
        const size_t e = (size_t)(i % EFFECTS);
        double most[PIXELS] = {0};
        stage s;
        if (!effects[e].compares || effects[e].hard)
            continue;
        stage_any(&r, &s);
        const frame f = {.camera = &s.camera, .last = &s.before, .image = &depths, .sky = 0, .threads = 1};
        const uint32_t code = 600 + (uint32_t)rng_below(&r, 64000);
        for (size_t k = 0; k < PIXELS; k++)
            codes[k] = code;
        s.reference = 0;
        make(&s, &f, e, true, worst);
        for (int a = 0; a < REFERENCES; a++) {
            s.reference = eye_of(&s, code + (a - 1) * 0.5);
            make(&s, &f, e, false, got);
            for (int k = 0; k < PIXELS; k++)
                for (int b = 0; b <= PLACES; b++)
                    most[k] = fmax(most[k], fabs((double)got[k] -
                                                 effects[e].of(&s, k, eye_of(&s, code - 0.5 + (double)b / PLACES))));
        }
        for (int k = 0; k < PIXELS; k++) {
            const double least = 255 * fmin(most[k], 1);
            TALLY(&t, (double)worst[k] >= least && (double)worst[k] <= 255 * fmin(most[k] + ROUNDED, 1),
                  "%s %s pixel %d code %u: %.9g levels, not %.9g", effects[e].name, s.ortho ? "ortho" : "", k, code,
                  (double)worst[k], least);
        }
    }
    tally_end(&t);
}

/* ---- Steep effects ----------------------------------------------------------------------------------------------- */

/*
 * In a buffer of binary32 the roundings of the effect weigh as much as the cell. Where what it compares with is not
 * given none of it makes a larger error than is stated, over references beside the middles of two binary32 numbers, and
 * some makes most of it: eye depth is rounded once, of a reference that is just above a power of two.
 */
typedef struct steep {
    const char *effect, *parameter;
    bool gain, share; /* the output grows with the parameter; the depth is a share of far */
} steep;

static const steep steeps[] = {
    {"intersection", "half-width", false, false}, {"soft-particles", "fade-distance", false, false},
    {"ray-march", "step", false, false},          {"thickness", "scale", false, false},
    {"scan-line", "half-width", false, true},     {"depth-of-field", "level", true, true},
    {"force-field", "power", true, false},        {"water-depth", "density", true, false},
};

static double steep_output(const steep *of, double z, double reference, double p, double stretch) {
    const double behind = z - reference, scale = of->gain ? p : 1 / p;
    if (strcmp(of->effect, "force-field") == 0)
        return fmax(0, (1 - behind) * p);
    if (strcmp(of->effect, "water-depth") == 0)
        return behind > 0 ? -expm1(-p * stretch * behind) : 0;
    if (of->share)
        return unit(fabs(behind) / FAR * scale);
    return unit((strcmp(of->effect, "intersection") == 0 ? fabs(behind) : behind) * scale);
}

/* The largest error at one depth and the share of it that is found, over references at which rounding is worst. */
static double steep_share(tally *t, rng *r, const steep *of, const frame *f, uint32_t *codes) {
    static float got[PIXELS], stated[PIXELS];
    const dp_setup *s = &f->camera->setup;
    const double turn = ldexp(1, 1 + (int)rng_below(r, 5)) * (1 + rng_log(r, 0x1p-20, 0x1p-10));
    const uint32_t code = dp_code(s, turn);
    const double z = dp_stored(s, code), share = of->share ? FAR : 1, wide = z / share * rng_log(r, 0x1p-20, 0x1p-12);
    const effect_row *row = effect_find(of->effect);
    const dp_cell cell = dp_cell_of(s, code);
    const double before = strcmp(of->effect, "force-field") == 0 ? 1 : 0; /* its glow ends there */
    double at[PARAMETERS_MAX], most = 0;
    parameter_defaults(row->parameters, at);
    at[parameter_find(row->parameters, of->parameter)] = of->gain ? 1 / wide : wide;
    const double p = at[parameter_find(row->parameters, of->parameter)];
    for (size_t k = 0; k < PIXELS; k++)
        codes[k] = code;
    frame_product product = {.kind = FRAME_EFFECT, .effect = row, .effect_settings = at, .error = true};
    assert_null(frame_refuses(f, &product));
    assert_true(frame_run(f, &product, false, keep, stated));
    product.error = false;
    const effect_view view = effect_view_of(f->camera, NULL, 0, 0);
    for (int i = 0; i < 40; i++) {
        const double middle =
            (double)(float)((z - before + wide * share * rng_uniform(r, -1, 1)) / share) * (1 + 0x1p-53);
        const double reference = middle * (1 + (rng_below(r, 2) ? 0.99 : -0.99) * 0x1p-24) * share;
        at[parameter_find(row->parameters, "reference")] = reference;
        assert_true(frame_run(f, &product, false, keep, got));
        for (int k = 0; k <= 2; k++) {
            const double truth = k == 0 ? cell.lo : k == 1 ? cell.hi : z;
            const double want = steep_output(of, truth, reference, p, view.stretch);
            if (want <= 1 || !of->gain)
                most = fmax(most, fabs((double)got[0] - want));
        }
    }
    TALLY(t, 255 * most <= (double)stated[0], "%s, %s %a at %a: %.9g levels, not %.9g", of->effect, of->parameter, p, z,
          255 * most, (double)stated[0]);
    return stated[0] < 255 ? 255 * most / (double)stated[0] : 0;
}

TEST(test_steep) {
    static uint32_t codes[PIXELS];
    const image depths = {
        .width = ACROSS, .height = DOWN, .channels = 1, .type = IMAGE_U32, .file = IMAGE_NPY, .data = codes};
    rng r = rng_make("steep effects");
    tally t = {.name = "steep effects"};
    for (size_t i = 0; i < sizeof steeps / sizeof steeps[0]; i++) {
        double used = 0;
        for (uint64_t n = test_cases(200, 1000, 20000); n > 0; n--) {
            stage s = {.reversed = true, .now = {.fov = 50}, .last = {.fov = 50}};
            stage_ready(&s);
            s.setup = SETUP("fp32", .znear = NEAR, .zfar = FAR, .mapping = DP_MAPPING_REVERSED);
            camera_of(&s, &s.now, &s.camera);
            const frame f = {.camera = &s.camera, .last = &s.camera, .image = &depths, .sky = 0, .threads = 1};
            used = fmax(used, steep_share(&t, &r, &steeps[i], &f, codes));
        }
        print_message("# %s: %.3f of what is stated\n", steeps[i].effect, used);
        TALLY(&t, used > 0.7, "%s: only %.3f of what is stated is found", steeps[i].effect, used);
    }
    tally_end(&t);
}

/* ---- Scenes ------------------------------------------------------------------------------------------------------ */

/* A plane leaning back: its depths are known, and the error is that of the output to theirs. */
TEST(test_scenes) {
    static float got[PIXELS], off[PIXELS];
    const double distance = 12, tilt = 50;
    rng r = rng_make("effects of scenes");
    tally t = {.name = "scenes"};
    for (uint64_t i = 0; i < test_cases(200, 1000, 30000); i++) {
        const size_t e = (size_t)(i % EFFECTS);
        const double parameters[PARAMETERS_MAX] = {distance, tilt, 0};
        stage s;
        stage_any(&r, &s);
        const frame f = {.camera = &s.camera,
                         .last = &s.before,
                         .synthetic = synthetic_find("plane"),
                         .parameters = parameters,
                         .sky = 0,
                         .threads = 1};
        double half[2];
        half_of(&s, &s.now, half);
        make(&s, &f, e, false, got);
        make(&s, &f, e, true, off);
        for (int k = 0; k < PIXELS; k++) {
            const double up = half[1] * ndc_y(k), lean = tan(tilt * RADIAN);
            const double z = s.ortho ? distance + up * lean : distance / (1 - up * lean);
            if (!(z > 0) || z < NEAR || z >= FAR * 0.99) {
                t.skipped++;
                continue;
            }
            const double want = 255 * fmin(fabs((double)got[k] - effects[e].of(&s, k, z)), 1);
            TALLY(&t, fabs((double)off[k] - want) <= 1e-5 * fmax(want, 1e-3), "%s pixel %d at z %.9g: %.9g, not %.9g",
                  effects[e].name, k, z, (double)off[k], want);
        }
    }
    tally_end(&t);
}

/* ---- Numbers that are known by heart ----------------------------------------------------------------------------- */

/* A move of 0.5 sideways, seen at depth 10 with a field of view of 90 degrees: 0.5/10/2 of a square picture's width. */
TEST(test_velocity) {
    static const struct {
        uint32_t width, height;
        double velocity;
    } pictures[] = {{100, 100, 0.025}, {160, 90, 0.0140625}};
    for (size_t i = 0; i < 2; i++) {
        dp_spec spec = dp_spec_default();
        dp_setup setup;
        camera_spec view = camera_spec_default();
        texture_camera now, last;
        assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
        view.width = pictures[i].width;
        view.height = pictures[i].height;
        view.fov_y = 90;
        assert_null(camera_init(&now, &setup, &view));
        view.origin[0] = 0.5;
        assert_null(camera_init(&last, &setup, &view));
        const effect_view seen = effect_view_of(&now, &last, 17, 30);
        const effect_row *row = effect_find("motion-blur");
        const double strength[PARAMETERS_MAX] = {1};
        assert_relative(row->output(&seen, strength, 10, 0), pictures[i].velocity, 1e-12);
    }
}

/* The velocity itself: both parts, with their signs, and its length; off by no more than its error map says. */
TEST(test_vector) {
    enum { PARTS = 3 };
    static uint32_t codes[PIXELS];
    static float got[PARTS * PIXELS], bound[PIXELS];
    const image depths = {
        .width = ACROSS, .height = DOWN, .channels = 1, .type = IMAGE_U32, .file = IMAGE_NPY, .data = codes};
    const double strength[PARAMETERS_MAX] = {1.5};
    rng r = rng_make("vectors");
    tally t = {.name = "vectors"};
    for (uint64_t i = 0; i < test_cases(30, 300, 3000); i++) {
        stage s;
        stage_any(&r, &s);
        const frame f = {.camera = &s.camera, .last = &s.before, .image = &depths, .sky = 0, .threads = 1};
        frame_product p = {
            .kind = FRAME_EFFECT, .effect = effect_find("motion-vector"), .effect_settings = strength, .vector = true};
        for (size_t k = 0; k < PIXELS; k++)
            codes[k] = k == 11 ? s.reversed ? 0 : CODE_MAX : 600 + (uint32_t)rng_below(&r, 64000);
        assert_int_equal(frame_channels(&p), PARTS);
        float *all = frame_made(&f, &p, false);
        memcpy(got, all, sizeof got);
        free(all);
        p.error = true;
        assert_int_equal(frame_channels(&p), 1);
        assert_true(frame_run(&f, &p, false, keep, bound));
        for (int k = 0; k < PIXELS; k++) {
            double world[3], last[2], parts[2], most = 0;
            for (int at = -1; at <= 1; at++) {
                world_of(&s, k, eye_of(&s, codes[k] + at / 2.0), world);
                last_ndc(&s, world, last);
                parts[0] = 1.5 * (ndc_x(k) - last[0]) / 2;
                parts[1] = 1.5 * (ndc_y(k) - last[1]) / 2;
                most = fmax(most, hypot((double)got[PARTS * k] - parts[0], (double)got[PARTS * k + 1] - parts[1]));
                most = fmax(most, fabs((double)got[PARTS * k + 2] - hypot(parts[0], parts[1])));
                if (at == 0 && k != 11)
                    TALLY(&t,
                          fabs((double)got[PARTS * k] - parts[0]) < ROUNDED &&
                              fabs((double)got[PARTS * k + 1] - parts[1]) < ROUNDED &&
                              fabs((double)got[PARTS * k + 2] - hypot(parts[0], parts[1])) < ROUNDED,
                          "pixel %d: %.9g %.9g, not %.9g %.9g", k, (double)got[PARTS * k], (double)got[PARTS * k + 1],
                          parts[0], parts[1]);
            }
            TALLY(&t, k == 11 ? isnan(got[PARTS * k]) && isnan(got[PARTS * k + 2]) : 255 * most <= (double)bound[k],
                  "pixel %d: %.9g levels off, not %.9g", k, 255 * most, (double)bound[k]);
        }
    }
    tally_end(&t);
}

/* Fog over the ground is thicker the lower the camera stands. */
TEST(test_camera_height) {
    const effect_row *row = effect_find("height-fog");
    const double heights[] = {0, 50, 200};
    double p[PARAMETERS_MAX], seen[3];
    settings_of(row, "density=1 start=100 end=-100", p);
    for (size_t i = 0; i < 3; i++) {
        stage s = {.now = {.fov = 60, .pitch = -30, .origin = {0, heights[i], 0}}};
        s.last = s.now;
        stage_ready(&s);
        const effect_view view = effect_view_of(&s.camera, NULL, ACROSS / 2, DOWN / 2);
        seen[i] = row->output(&view, p, 10, 0);
        assert_relative(seen[i] + 1, unit((heights[i] - 5 - 100) / -200) + 1, 1e-12);
    }
    assert_true(seen[0] > seen[1] && seen[1] > seen[2] && seen[2] == 0);
}
