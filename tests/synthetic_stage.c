/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "synthetic_stage.h"

#include "named.h"
#include "support.h"

void synthetic_stage_between(synthetic_stage *s, const char *synthetic, const char *format, const char *mapping,
                             double znear, double zfar, bool ortho, uint32_t width, uint32_t height) {
    dp_format formats[2];
    dp_spec spec = dp_spec_default();
    dp_setup setup;
    camera_spec view = camera_spec_default();
    assert_true(dp_format_parse(format, formats) >= 1);
    assert_int_equal(dp_mapping_parse(mapping, &spec.mapping), DP_OK);
    spec.format = formats[0];
    spec.ortho = ortho;
    spec.znear = znear;
    spec.zfar = zfar;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    view.width = width;
    view.height = height;
    view.yaw = 30;
    view.pitch = -10;
    view.origin[0] = 100;
    view.origin[2] = -7;
    assert_null(camera_init(&s->camera, &setup, &view));
    parameter_defaults(synthetic_find(synthetic)->parameters, s->parameters);
    s->frame = (frame){.camera = &s->camera,
                       .synthetic = synthetic_find(synthetic),
                       .parameters = s->parameters,
                       .sky = FRAME_SKY,
                       .threads = 1};
}

void synthetic_stage_set(synthetic_stage *s, const char *synthetic, const char *format, const char *mapping,
                         double zfar, bool ortho, uint32_t width, uint32_t height) {
    synthetic_stage_between(s, synthetic, format, mapping, 0.1, zfar, ortho, width, height);
}

bool whole_take(void *context, uint32_t row, uint32_t count, const float *values) {
    whole *w = context;
    memcpy(w->values + row * w->row_values, values, count * w->row_values * sizeof *values);
    if (w->strips++ == 0)
        w->first = row;
    w->rows += count;
    return true;
}

float *frame_made(const frame *f, const frame_product *p, bool bottom_up) {
    whole w = {.row_values = (size_t)f->camera->width * (size_t)frame_channels(p)};
    w.values = calloc(w.row_values * f->camera->height, sizeof *w.values);
    assert_non_null(w.values);
    assert_null(frame_refuses(f, p));
    assert_true(frame_run(f, p, bottom_up, whole_take, &w));
    assert_int_equal(w.rows, f->camera->height);
    assert_true((w.first == 0) == (!bottom_up || w.strips == 1));
    return w.values;
}

image synthetic_stage_image(const synthetic_stage *s) {
    const texture_camera *c = &s->camera;
    image out = {.width = c->width, .height = c->height, .channels = 1, .type = IMAGE_U32, .file = IMAGE_NPY};
    out.data = malloc((size_t)c->width * c->height * sizeof(uint32_t));
    assert_non_null(out.data);
    for (uint32_t y = 0; y < c->height; y++)
        frame_codes(&s->frame, y, (uint32_t *)out.data + (size_t)y * c->width);
    return out;
}
