/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fog by height over a whole image, by hand: each row of pixels has rays that rise in their own way. */
#include "named.h"
#include "support.h"
#include "texture/frame.h"

enum { ACROSS = 5, DOWN = 9, PIXELS = ACROSS * DOWN, CODE = 62000, CODE_MAX = 65535 };

static const double NEAR = 1, FAR = 100, DENSITY = 0.7, START = -5, END = -40, PITCH = -20, RADIAN = M_PI / 180;

static double eye_of(bool ortho, double code) {
    const double d = code / CODE_MAX;
    return ortho ? NEAR + d * (FAR - NEAR) : 1 / ((1 - d) / NEAR + d / FAR);
}

/* Of the ray through the middle of a pixel, per unit of eye depth: 60 degrees from bottom to top. */
static double rise_of(bool ortho, uint32_t row) {
    const double up = ortho ? 0 : tan(30 * RADIAN) * (1 - 2 * (row + 0.5) / DOWN);
    return sin(PITCH * RADIAN) + up * cos(PITCH * RADIAN);
}

static double fog_of(double height) {
    return fmin(fmax((height - START) / (END - START) * DENSITY, 0), 1);
}

static bool keep(void *context, uint32_t row, uint32_t count, const float *values) {
    float *out = context;
    for (size_t i = 0; i < (size_t)count * ACROSS; i++)
        out[(size_t)row * ACROSS + i] = values[i];
    return true;
}

static void camera_of(texture_camera *camera, bool ortho) {
    dp_format formats[2];
    dp_spec spec = dp_spec_default();
    dp_setup setup;
    camera_spec view = camera_spec_default();
    assert_true(dp_format_parse("unorm16", formats) >= 1);
    spec.format = formats[0];
    spec.mapping = DP_MAPPING_D3D;
    spec.ortho = ortho;
    spec.znear = NEAR;
    spec.zfar = FAR;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    view.width = ACROSS;
    view.height = DOWN;
    view.yaw = 50;
    view.pitch = PITCH;
    assert_null(camera_init(camera, &setup, &view));
}

/* The same code everywhere. Binary32 eye depths and outputs are within a few units of 2^-24. */
static void test_height(void **state) {
    static uint32_t codes[PIXELS];
    static float got[PIXELS];
    const image depths = {
        .width = ACROSS, .height = DOWN, .channels = 1, .type = IMAGE_U32, .file = IMAGE_NPY, .data = codes};
    const effect_row *effect = effect_find("height-fog");
    double at[TEXTURE_PARAMETERS];
    (void)state;
    parameter_defaults(effect->parameters, at);
    at[parameter_find(effect->parameters, "density")] = DENSITY;
    at[parameter_find(effect->parameters, "start")] = START;
    at[parameter_find(effect->parameters, "end")] = END;
    for (size_t i = 0; i < PIXELS; i++)
        codes[i] = CODE;
    for (int k = 0; k < 4; k++) {
        const bool ortho = k % 2 == 1, error = k >= 2;
        texture_camera camera;
        camera_of(&camera, ortho);
        const frame f = {.camera = &camera, .image = &depths, .sky = FRAME_SKY, .threads = 1};
        const frame_product p = {.kind = FRAME_EFFECT, .effect = effect, .effect_settings = at, .error = error};
        assert_null(frame_refuses(&f, &p));
        assert_true(frame_run(&f, &p, false, keep, got));
        for (uint32_t i = 0; i < PIXELS; i++) {
            const double rise = rise_of(ortho, i / ACROSS), seen = fog_of(rise * eye_of(ortho, CODE));
            const double nearer = fabs(fog_of(rise * eye_of(ortho, CODE - 0.5)) - seen);
            const double farther = fabs(fog_of(rise * eye_of(ortho, CODE + 0.5)) - seen);
            assert_scene((double)got[i], error ? 255 * fmax(nearer, farther) : seen, error ? 1e-4 : 1e-6);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_height)};
    return run_tap(tests);
}
