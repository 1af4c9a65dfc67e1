/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "probe/cmd_probe/known.h"

#include <string.h>

#include "core/append.h"
#include "probe/brief.h"
#include "report/number.h"

enum { DIGITS = 3 };

/* Those of tests/profiles, which were recorded. */
static const char *const known[] = {
    "llvmpipe (LLVM 15.0.6, 256 bits)~Mesa/X.org, 4.5 (Core Profile) Mesa 22.3.6~OpenGL~8~mesa~llvmpipe~"
    "a0s1_a1s1_a2s0_b0s1_b1s1_c-s1_d-s0_e-s0_f-s1_g-s0_h-m0*1.81159e-07_h-m1*1.78122_i-m0*0.499987_j-s5_"
    "k-s0_l0s0_l1s0_l2s0_m0s0_m1s0_m2s0_n0s1_n1s1_n2s3_o0s0_p-s0",
    "llvmpipe (LLVM 15.0.6, 256 bits)~llvmpipe, Mesa 22.3.6 (LLVM 15.0.6)~Vulkan 1.3.230~8~mesa~lavapipe~"
    "a0s1_a1s1_a2s0_b0s1_b1s1_c-s1_d-s0_e-s0_f-s1_g-s0_h-m0*1.81159e-07_h-m1*1.78122_i-m0*0.499987_j-s5_"
    "k-s0_l0s1_l1s1_l2s1_m0s1_m1s1_m2s1_n0s1_n1s1_n2s3_o0s0_p-s0",
    "softpipe~Mesa/X.org, 3.3 (Core Profile) Mesa 22.3.6~OpenGL~4~softpipe~softpipe~"
    "a0s1_a1s1_a2s0_b0s2_b1o24*65536*65536_c-s1_d-s0_e-s0_f-s1_g-s0_h-m0*8.33465e-08_h-m1*1.41984_"
    "i-m0*0.499987_j-s0_k-s0_l0s2_l1s2_l2s2_m0s2_m1s2_m2s2_n0s1_n1s1_n2s3_o0s0_p-s0",
    "SwiftShader Device (Subzero)~SwiftShader driver, 5.0.0~Vulkan 1.3.0~4~mesa~swiftshader~"
    "a0s1_a2s0_b0s1_c-s1_d-s0_e-s0_f-s1_g-s0_h-m0*2.15515e-07_h-m1*1.78122_i-m0*0.499987_j-s1_k-s1_l0s3_"
    "l2s3_m0s3_m2s3_n0s0_n2s9_o0s0_p-s0",
    "NVIDIA H100 80GB HBM3~NVIDIA, 580.159.04~Vulkan 1.4.312~8~nvidia~~"
    "a0s1_a1s1_a2s0_b0s3_b1s3_c-s2_d-s1_e-s0_f-s1_g-s0_h-m0*1.49686e-07_h-m1*1.16922_i-m0*1.81976_j-s5_"
    "k-s5_l0n1*55206*65536_l1n2*6652*65536_l2n2*6652*65536_n0s1_n1s1_n2s3_o0s0_p-s0",
    "NVIDIA H100 80GB HBM3/PCIe/SSE2~NVIDIA Corporation, 3.3.0 NVIDIA 580.159.04~OpenGL~8~nvidia~~"
    "a0s1_a1s1_a2s0_b0s3_b1s3_c-s2_d-s1_e-s0_f-s1_g-s0_h-m0*1.49686e-07_h-m1*1.16922_i-m0*1.81976_j-s5_"
    "k-s5_l0n1*55206*65536_l1n2*6652*65536_l2n2*6652*65536_n0s1_n1s1_n2s4_o0s0_p-s0",
};

const char *known_get(size_t i) {
    return i < sizeof known / sizeof known[0] ? known[i] : NULL;
}

static void say(const probe_finding *f, char out[KNOWN_TEXT_SIZE]) {
    const char *unit = f->unit != NULL && f->unit[0] != '\0' ? " " : "";
    if (f->sure == PROBE_MEASURED)
        snprintf(out, KNOWN_TEXT_SIZE, "at most %s%s%s off, %s", number_up(f->value, DIGITS).text, unit, f->unit,
                 f->words);
    else
        snprintf(out, KNOWN_TEXT_SIZE, "%s", f->words);
}

static bool same_subject(const probe_finding *a, const probe_finding *b) {
    const bool format =
        a->format != NULL && b->format != NULL ? strcmp(a->format, b->format) == 0 : a->format == b->format;
    return format && strcmp(a->key, b->key) == 0;
}

/* The finding of `in` that stands as `f` does, the nth of its subject; of what is measured, of its words. */
static const probe_finding *counterpart(const probe_result *of, size_t at, const probe_result *in) {
    const probe_finding *f = &of->finding[at];
    size_t before = 0;
    for (size_t i = 0; i < at; i++)
        before += same_subject(&of->finding[i], f);
    for (size_t i = 0; i < in->count; i++)
        if (same_subject(&in->finding[i], f) && before-- == 0)
            return &in->finding[i];
    return NULL;
}

static void compare(const probe_result *expected, const probe_result *got, known_comparison *out) {
    for (size_t i = 0; i < expected->count; i++) {
        const probe_finding *f = &expected->finding[i], *other = counterpart(expected, i, got);
        known_difference *d = &out->difference[out->differ];
        if (other == NULL)
            continue;
        out->compared++;
        snprintf(d->finding, sizeof d->finding, "%s%s%s", f->key, f->format != NULL ? " " : "",
                 f->format != NULL ? f->format : "");
        say(f, d->expected);
        say(other, d->got);
        out->differ += strcmp(d->expected, d->got) != 0;
    }
}

bool known_compare(size_t i, const probe_result *r, known_comparison *out) {
    static probe_result expected, got; /* too large for a stack */
    char text[BRIEF_SIZE], error[SHOT_ERROR_SIZE];
    *out = (known_comparison){.compared = 0};
    if (known_get(i) == NULL)
        return false;
    brief_write(r, text); /* without what a device calls its formats */
    if (brief_read(text, NULL, &got, error)) {
        if (brief_read(known_get(i), NULL, &expected, error)) {
            const shot_device *d = &expected.machine.device[0];
            snprintf(out->name, sizeof out->name, "%s, %s", d->name, d->api);
            compare(&expected, &got, out);
        }
        probe_free(&expected);
    }
    probe_free(&got);
    return true;
}
