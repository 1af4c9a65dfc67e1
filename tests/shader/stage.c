/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "stage.h"

#include "named.h"

double eye_of(double code) {
    const double d = code / CODE_MAX;
    return 1 / ((1 - d) / STAGE_NEAR + d / STAGE_FAR);
}

uint32_t code_of(double z) {
    return (uint32_t)((z - STAGE_NEAR) / z * STAGE_FAR / (STAGE_FAR - STAGE_NEAR) * CODE_MAX + 0.5);
}

void stage_slopes(int pixel, double out[2]) {
    const double half = tan(30 * M_PI / 180);
    out[0] = (2 * (pixel % ACROSS + 0.5) / ACROSS - 1) * half * ACROSS / DOWN;
    out[1] = (1 - 2 * (pixel / ACROSS + 0.5) / DOWN) * half;
}

void stage_make(stage *s) {
    dp_format formats[2];
    dp_spec spec = dp_spec_default();
    camera_spec view = camera_spec_default();
    memset(s, 0, sizeof *s);
    assert_true(dp_format_parse("unorm16", formats) >= 1);
    spec.format = formats[0];
    spec.mapping = DP_MAPPING_D3D;
    spec.znear = STAGE_NEAR;
    spec.zfar = STAGE_FAR;
    assert_int_equal(dp_setup_init(&s->setup, &spec), DP_OK);
    view.width = ACROSS;
    view.height = DOWN;
    assert_null(camera_init(&s->camera, &s->setup, &view));
    s->image =
        (image){.width = ACROSS, .height = DOWN, .channels = 1, .type = IMAGE_U32, .file = IMAGE_NPY, .data = s->codes};
    s->frame = (frame){.camera = &s->camera, .image = &s->image, .sky = FRAME_SKY, .threads = 1};
}

static bool keep(void *context, uint32_t row, uint32_t count, const float *values) {
    memcpy((float *)context + (size_t)row * ACROSS, values, (size_t)count * ACROSS * sizeof *values);
    return true;
}

void stage_effect(const stage *s, const char *effect, const double *at, double reference, bool error,
                  float out[PIXELS]) {
    double settings[PARAMETERS_MAX];
    memcpy(settings, at, sizeof settings);
    if (reference > 0)
        stage_set(effect, settings, "reference", reference);
    const frame_product p = {
        .kind = FRAME_EFFECT, .effect = effect_find(effect), .effect_settings = settings, .error = error};
    assert_null(frame_refuses(&s->frame, &p));
    assert_true(frame_run(&s->frame, &p, false, keep, out));
}

void stage_set(const char *effect, double *at, const char *name, double value) {
    const int index = parameter_find(effect_find(effect)->parameters, name);
    assert_true(index >= 0);
    at[index] = value;
}

int beside(int pixel, int columns, int rows) {
    const int x = pixel % ACROSS + columns, y = pixel / ACROSS + rows;
    return (y < 0 ? 0 : y < DOWN ? y : DOWN - 1) * ACROSS + (x < 0 ? 0 : x < ACROSS ? x : ACROSS - 1);
}

void corners_of(int pixel, int away, int out[4]) {
    out[0] = beside(pixel, -away, -away);
    out[1] = beside(pixel, away, -away);
    out[2] = beside(pixel, -away, away);
    out[3] = beside(pixel, away, away);
}

/* A few depths side by side, sky among them, and a hole. */
void stage_draw(rng *r, stage *s) {
    static const double depths[] = {10, 10.4, 30, 55};
    for (int k = 0; k < PIXELS; k++) {
        const uint64_t which = rng_below(r, 6);
        s->codes[k] = rng_below(r, 3) > 0 && k > 0 ? s->codes[k - 1]
                      : which == 0                 ? CODE_MAX
                                                   : code_of(depths[which % 4] + rng_uniform(r, 0, 0.3));
    }
    s->codes[200] = UINT32_MAX;
}
