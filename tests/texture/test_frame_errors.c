/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A scene does what an image cannot know: its true errors stay within the image's, which are those of plain pixels. */
#include "named.h"
#include "support.h"
#include "synthetic_stage.h"

TEST(true_errors_are_within_the_predicted) {
    static const char *const formats[][2] = {
        {"unorm24", "d3d"}, {"unorm24", "reversed"}, {"unorm16", "d3d"}, {"fp16", "reversed"}, {"fp32", "reversed"}};
    tally t = {.name = "predicted"};
    double nearest[3] = {0, 0, 0};
    for (size_t k = 0; k < sizeof formats / sizeof formats[0]; k++)
        for (int turn = 0; turn < 4; turn++) {
            synthetic_stage s;
            synthetic_stage_set(&s, "plane", formats[k][0], formats[k][1], 1000, turn == 3, 320, 180);
            s.parameters[1] = 20 * turn + 7;
            s.parameters[2] = 13 * turn - 20;
            image depths = synthetic_stage_image(&s);
            frame seen = s.frame;
            seen.image = &depths;
            seen.synthetic = NULL;
            const frame_product wanted[] = {
                {.kind = FRAME_EYE, .error = true},
                {.kind = FRAME_POSITION, .position = position_find(turn == 3 ? "view" : "rays"), .error = true},
                {.kind = FRAME_NORMAL, .normal = normal_find("projective"), .error = true}};
            for (size_t i = 0; i < 3; i++) {
                float *truth = frame_made(&s.frame, &wanted[i], false), *bound = frame_made(&seen, &wanted[i], false);
                for (size_t x = 0; x < (size_t)320 * 180; x++) {
                    if (isnan(truth[x]) || isnan(bound[x]))
                        continue;
                    const double slack = 1;
                    TALLY(&t, (double)truth[x] <= (double)bound[x] * slack,
                          "%zu, turn %d, product %zu at %zu: %g above %g", k, turn, i, x, (double)truth[x],
                          (double)bound[x]);
                    nearest[i] = fmax(nearest[i], (double)(truth[x] / bound[x]));
                }
                free(truth);
                free(bound);
            }
            free(depths.data);
        }
    print_message("# largest share of the predicted error: eye depth %.3f, positions %.3f, normals %.3f\n", nearest[0],
                  nearest[1], nearest[2]);
    for (size_t i = 0; i < 3; i++)
        assert_true(nearest[i] > 0.3);
    assert_true(nearest[0] > 0.99);
    tally_end(&t);
}

/* The parts of an image's errors: what binary32 lost, and how far the sample's range reaches along the ray. */
TEST(errors_of_images_equal_plain_pixels) {
    enum { ACROSS = 97, DOWN = 61, EYE = 0, RADIAL, PLACE, THINGS };
    tally t = {.name = "plain errors"};
    for (int k = 0; k < 4; k++) {
        synthetic_stage s;
        synthetic_stage_set(&s, "plane", "unorm16", k < 2 ? "d3d" : "reversed", 100, k % 2 == 1, ACROSS, DOWN);
        s.parameters[1] = 20;
        const texture_camera *c = &s.camera;
        image depths = synthetic_stage_image(&s);
        frame seen = s.frame;
        seen.image = &depths;
        seen.synthetic = NULL;
        float *made[THINGS], *error[THINGS];
        for (int i = 0; i < THINGS; i++) {
            frame_product p = {.kind = i == PLACE ? FRAME_POSITION : FRAME_EYE, .radial = i == RADIAL};
            p.position = i == PLACE ? position_find("view") : NULL;
            made[i] = frame_made(&seen, &p, false);
            p.error = true;
            error[i] = frame_made(&seen, &p, false);
        }
        for (uint32_t i = 0; i < ACROSS * DOWN; i++) {
            const uint32_t x = i % ACROSS, y = i / ACROSS, code = ((const uint32_t *)depths.data)[i];
            if (isnan(made[EYE][i]))
                continue;
            const double z = dp_stored(&c->setup, code), along = camera_radial(c, x, y);
            const double reach = grain_range_of(&c->setup, NULL, code).reach;
            double view[3], relative[3];
            camera_view(c, x, y, z, view);
            camera_turn(c, view, relative);
            const double want[THINGS] = {fabs((double)made[EYE][i] - z) + reach,
                                         fabs((double)made[RADIAL][i] - z * along) + reach * along,
                                         position_off(c, relative, made[PLACE] + 3 * i) + reach * along};
            for (int p = 0; p < THINGS; p++)
                TALLY(&t, (double)error[p][i] >= want[p] && (double)error[p][i] <= want[p] * (1 + 0x1p-22),
                      "camera %d, product %d at %u, %u: %.9g, not %.9g", k, p, x, y, (double)error[p][i], want[p]);
        }
        for (int i = 0; i < THINGS; i++) {
            free(made[i]);
            free(error[i]);
        }
        free(depths.data);
    }
    assert_true(t.cases > 10000);
    tally_end(&t);
}

/* The same where the image has 8 or 12 bits, cut off or rounded: its normals are those of the samples alone. */
TEST(normals_of_coarse_images_are_within_the_predicted) {
    tally t = {.name = "coarse normals"};
    rng r = rng_make("coarse normals");
    double nearest = 0;
    for (int k = 0; k < 24; k++) {
        enum { ACROSS = 96, DOWN = 54 };
        synthetic_stage s;
        synthetic_stage_set(&s, "plane", "unorm24", k % 2 ? "reversed" : "d3d", 12, k % 6 == 5, ACROSS, DOWN);
        s.parameters[0] = rng_uniform(&r, 0.3, 3);
        s.parameters[1] = rng_uniform(&r, -60, 60);
        s.parameters[2] = rng_uniform(&r, -60, 60);
        const double steps = k % 3 ? 4095 : 255;
        static uint32_t codes[ACROSS * DOWN];
        static synthetic_hit hits[ACROSS * DOWN];
        const dp_setup *setup = &s.camera.setup;
        for (uint32_t i = 0; i < ACROSS * DOWN; i++) {
            s.frame.synthetic->hit(&s.camera, s.parameters, i % ACROSS, i / ACROSS, &hits[i]);
            const double v = dp_format_value(&setup->spec.format, dp_code(setup, hits[i].z));
            const double sample = floor(v * steps + (k % 4 < 2 ? 0.5 : 0));
            codes[i] = (uint32_t)floor(sample / steps * setup->spec.format.code_max + 0.5);
        }
        const image depths = {.width = ACROSS, .height = DOWN, .channels = 1, .type = IMAGE_U32, .data = codes};
        const grain g = {.kind = GRAIN_STEPS, .steps = steps, .buffer = true};
        frame seen = s.frame;
        seen.image = &depths;
        seen.synthetic = NULL;
        seen.grain = &g;
        const frame_product normal = {.kind = FRAME_NORMAL, .normal = normal_find("projective")};
        const frame_product error = {.kind = FRAME_NORMAL, .normal = normal.normal, .error = true};
        float *got = frame_made(&seen, &normal, false), *bound = frame_made(&seen, &error, false);
        for (size_t i = 0; i < ACROSS * DOWN; i++) {
            const double found[3] = {(double)got[3 * i], (double)got[3 * i + 1], (double)got[3 * i + 2]};
            if (isnan(found[0]) || isnan((double)bound[i]) || isinf(hits[i].z))
                continue;
            const double off = normal_angle(found, hits[i].normal) * 180 / 3.14159265358979323846;
            TALLY(&t, off <= (double)bound[i], "%g steps, picture %d at %zu: %g degrees, not %g", steps, k, i, off,
                  (double)bound[i]);
            nearest = fmax(nearest, off / (double)bound[i]);
        }
        free(got);
        free(bound);
    }
    print_message("# largest share of the predicted error of coarse normals: %.3f\n", nearest);
    assert_true(nearest > 0.3);
    tally_end(&t);
}

/* The method low looks at its quad alone: what lies in the quads above and below changes neither normal nor bound. */
TEST(the_bound_of_low_is_of_its_quad) {
    enum { SIDE = 6, COUNT = SIDE * SIDE };
    synthetic_stage s;
    synthetic_stage_set(&s, "plane", "unorm16", "d3d", 1000, false, SIDE, SIDE);
    const frame_product error = {.kind = FRAME_NORMAL, .normal = normal_find("low"), .error = true};
    float *bounds[3];
    s.frame.synthetic = NULL;
    for (int k = 0; k < 3; k++) {
        uint16_t codes[COUNT];
        const double rows[SIDE / 2] = {10, k == 0 ? 10 : 90, k == 2 ? 60 : 10};
        for (int i = 0; i < COUNT; i++)
            codes[i] = (uint16_t)dp_code(&s.camera.setup, rows[i / SIDE / 2]);
        const image depths = {
            .width = SIDE, .height = SIDE, .channels = 1, .type = IMAGE_U16, .file = IMAGE_NPY, .data = codes};
        s.frame.image = &depths;
        bounds[k] = frame_made(&s.frame, &error, false);
    }
    for (int i = 0; i < COUNT; i++) {
        const int quad = i / SIDE / 2;
        assert_true(bounds[0][i] > 0 && bounds[0][i] < 90);
        assert_true((bounds[1][i] == bounds[0][i]) == (quad != 1));
        assert_true((bounds[2][i] == bounds[1][i]) == (quad != 2));
    }
    for (int k = 0; k < 3; k++)
        free(bounds[k]);
}
