/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * What computes a depth is prepared once: for all codes of a set-up, and for all depths of a search. The linker hands
 * the calls that prepare it to this file, which counts them.
 */
#include "core/engine.h"
#include "core/log_shader.h"
#include "depthprec/depthprec.h"
#include "solve/distance.h"
#include "support.h"

static int matrices, chains, shaders, slants;

/* The names that the linker makes of those that it wraps. */
void __real_dp_pipeline_prepare(dp_setup *setup);
void __wrap_dp_pipeline_prepare(dp_setup *setup);
dp_chain __real_dp_chain_make(const dp_setup *setup, const dp_pipeline *pipeline);
dp_chain __wrap_dp_chain_make(const dp_setup *setup, const dp_pipeline *pipeline);
dp_log_shader __real_dp_log_shader_make(const dp_setup *setup, const dp_log2_row *log2);
dp_log_shader __wrap_dp_log_shader_make(const dp_setup *setup, const dp_log2_row *log2);

dp_slant __real_dp_slant_make(const dp_triangles *t);
dp_slant __wrap_dp_slant_make(const dp_triangles *t);

dp_slant __wrap_dp_slant_make(const dp_triangles *t) {
    slants++;
    return __real_dp_slant_make(t);
}

void __wrap_dp_pipeline_prepare(dp_setup *setup) {
    matrices++;
    __real_dp_pipeline_prepare(setup);
}

dp_chain __wrap_dp_chain_make(const dp_setup *setup, const dp_pipeline *pipeline) {
    chains++;
    return __real_dp_chain_make(setup, pipeline);
}

dp_log_shader __wrap_dp_log_shader_make(const dp_setup *setup, const dp_log2_row *log2) {
    shaders++;
    return __real_dp_log_shader_make(setup, log2);
}

static dp_setup make(dp_mapping mapping, dp_model model) {
    dp_spec spec = dp_spec_default();
    dp_setup setup;
    spec.mapping = mapping;
    spec.model = model;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    return setup;
}

TEST(test_codes) {
    matrices = 0;
    const dp_setup setup = make(DP_MAPPING_D3D, DP_MODEL_FLOAT);
    assert_int_equal(matrices, 1); /* this file sees the calls */
    for (int i = 0; i < 1000; i++)
        dp_code(&setup, 0.1 + i);
    dp_pipeline pipeline;
    assert_int_equal(dp_pipeline_init(&pipeline, &setup), DP_OK);
    assert_int_equal(matrices, 1);
}

/* A search over the camera, with a limit so tight that it has to go on. */
static void search(const dp_setup *setup, int limited) {
    dp_separation_worst w, free;
    assert_int_equal(dp_separation_over(setup, 0.1, 1000, 0.0, &free), DP_OK);
    matrices = chains = shaders = slants = 0;
    assert_int_equal(dp_separation_over(setup, 0.1, 1000, limited ? free.separation : 0.0, &w), DP_OK);
}

TEST(test_matrix) {
    static const dp_mapping mappings[] = {DP_MAPPING_D3D, DP_MAPPING_GL, DP_MAPPING_REVERSED};
    for (int i = 0; i < 3; i++)
        for (int limited = 0; limited < 2; limited++) {
            const dp_setup setup = make(mappings[i], DP_MODEL_FLOAT);
            search(&setup, limited);
            assert_int_equal(chains, 1);
            assert_int_equal(matrices, 0);
        }
}

static dp_setup make_slanted(void) {
    dp_spec spec = dp_spec_default();
    dp_setup setup;
    spec.model = DP_MODEL_FLOAT;
    spec.triangles = dp_triangles_default();
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    return setup;
}

TEST(test_slanted) {
    const dp_setup setup = make_slanted();
    search(&setup, 1);
    assert_int_equal(chains, 1);
    assert_int_equal(slants, 1);
}

/* How far a separation is kept: depths one by one, and a search now and then. */
TEST(test_distance) {
    const dp_setup setup = make_slanted();
    chains = slants = 0;
    assert_true(distance_about(&setup, 0.1, 1000, 0.01, 3) > 1);
    assert_true(chains <= 6 && slants == chains);
}

TEST(test_shader) {
    const dp_setup lattice = make(DP_MAPPING_LOG, DP_MODEL_STAGED), setup = dp_setup_guaranteed(&lattice);
    search(&setup, 1);
    assert_int_equal(shaders, 1);
    assert_int_equal(chains, 0);
}
