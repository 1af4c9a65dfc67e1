/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "solve/check.h"

#include <math.h>

#include "core/bits.h"
#include "core/engine.h"
#include "quantity/quantity.h"
#include "solve/biased.h"
#include "world/reach.h"

const char *check_method_name(check_method method) {
    static const char *const names[CHECK_METHOD_COUNT] = {
        [CHECK_LATTICE] = "lattice", [CHECK_STAGED] = "staged lattice", [CHECK_GUARANTEE] = "guarantee",
        [CHECK_CENSUS] = "census",   [CHECK_SAMPLED] = "sample",
    };
    return (unsigned)method < CHECK_METHOD_COUNT ? names[method] : NULL;
}

bool check_is_slanted(const check_verdict *v) {
    return quantity_get(v->asked->kind)->of_surfaces && v->setup.spec.triangles.width > 0;
}

/* The verdict that a set-up gives in its own model. */
static void judge_in(const need *n, const dp_setup *setup, check_verdict *v) {
    static const check_method methods[DP_MODEL_COUNT] = {
        [DP_MODEL_EXACT] = CHECK_LATTICE, [DP_MODEL_STAGED] = CHECK_STAGED, [DP_MODEL_FLOAT] = CHECK_GUARANTEE};
    const quantity_worst j = quantity_over(n->kind, setup, n->lo, n->hi, n->limit);
    v->setup = *setup;
    v->method = setup->shader ? CHECK_GUARANTEE : methods[setup->spec.model];
    v->passed = j.passed;
    v->value = j.value;
    v->z = j.z;
    v->code = j.code;
}

/* Judges places of a world: no farther from its origin than a corner of its box, within 60 degrees of the axis. */
static void judge_world(const need *n, const need_camera *camera, const dp_setup *asked, check_verdict *v) {
    static const double root3 = 1.7320508075688774;
    dp_setup_in(asked, DP_MODEL_FLOAT, &v->setup); /* need_read() has refused mappings that have none */
    const world_asked a = {.setup = &v->setup, .z = n->hi, .ray_ratio = 2.0};
    const double distance = root3 * camera->world;
    v->method = CHECK_GUARANTEE;
    v->z = n->hi;
    v->value = n->lo < n->hi ? world_separation_over(&camera->scheme, &a, distance, n->lo, n->hi)
                             : world_separation(&camera->scheme, &a, distance);
    v->passed = n->limit >= v->value;
}

/* Whether the lattice exceeds the limit at a depth: then so does every model's separation, which is never below it. */
static bool is_refused_by_lattice(const need *n, const dp_setup *asked, check_verdict *v) {
    dp_setup setup;
    if (!dp_setup_in(asked, DP_MODEL_EXACT, &setup))
        return false;
    judge_in(n, &setup, v);
    return !v->passed && !(dp_separation(&setup, v->z) <= n->limit);
}

static void judge_separation(const need *n, const need_camera *camera, const dp_setup *asked, check_verdict *v) {
    if (camera->world > 0.0) {
        judge_world(n, camera, asked, v);
        return;
    }
    if (camera->automatic && is_refused_by_lattice(n, asked, v))
        return;
    const dp_setup setup = camera->automatic || dp_is_computed(asked) ? dp_setup_guaranteed(asked) : *asked;
    judge_in(n, &setup, v);
}

/* In no model are cells, and errors in them, always below another's: rounded once more, a depth may come nearer to a
 * code. */
static void judge_cells(const need *n, const need_camera *camera, const dp_setup *asked, check_verdict *v) {
    dp_setup setup = dp_setup_guaranteed(asked);
    if (!camera->automatic || (!setup.shader && !dp_setup_in(asked, DP_MODEL_STAGED, &setup)))
        setup = *asked;
    judge_in(n, &setup, v);
}

/* Whether the guarantee holds between any two neighbours: then nothing ties. Binade by binade, as the step of z, which
 * next to 0 is less than any guarantee; depths below 0 are counted. */
static bool never_ties(const dp_setup *setup, double lo, double hi) {
    if (lo <= 0.0)
        return false;
    while (lo < hi) {
        const double power = ldexp(1.0, ilogb(lo));
        const double step = 0x1p-23 * power;
        const double next = fmin(2.0 * power, hi);
        dp_separation_worst worst;
        if (dp_separation_over(setup, lo, fmax(lo, fmin(next, 2.0 * power - step)), step, &worst) != DP_OK ||
            worst.bound >= step)
            return false;
        lo = next;
    }
    return true;
}

static bool judge_ties(const check_request *request, const need *n, const dp_setup *asked, check_verdict *v) {
    if (!dp_setup_in(asked, DP_MODEL_FLOAT, &v->setup))
        return false;                      /* need_read() has refused it */
    v->setup = dp_setup_facing(&v->setup); /* of depths at a point */
    v->method = CHECK_GUARANTEE;
    v->value = 0.0;
    v->z = (double)NAN;
    if (!never_ties(&v->setup, n->lo, n->hi)) {
        const double depths = (double)dp_rank32((float)n->hi) - (double)dp_rank32((float)n->lo);
        v->method = depths > CHECK_CENSUS_MAX ? CHECK_SAMPLED : CHECK_CENSUS;
        if (!request->count(request->context, &v->setup, n->lo, n->hi, v->method == CHECK_SAMPLED, &v->value, &v->z))
            return false;
    }
    v->passed = v->value <= n->limit;
    return true;
}

static void judge_bias(const need *n, const dp_setup *asked, check_verdict *v) {
    const bias_verdict b = need_bias(n, asked, &v->setup, &v->sloped);
    v->method = b.answer == BIAS_NOT_ENOUGH ? CHECK_LATTICE : CHECK_GUARANTEE;
    v->answer = b.answer;
    v->passed = b.answer == BIAS_ENOUGH;
    v->value = b.units;
    v->factor = b.factor;
    v->z = b.z;
    v->code = isfinite(b.code) ? (uint32_t)b.code : 0;
}

size_t check_count(const need_file *file) {
    size_t count = 0;
    for (size_t i = 0; i < file->count; i++)
        count += file->cameras[file->needs[i].camera].count;
    return count;
}

long check_all(const check_request *request, check_verdict *out) {
    const need_file *file = request->file;
    long failed = 0;
    for (size_t i = 0; i < file->count; i++) {
        const need *n = &file->needs[i];
        const need_camera *camera = &file->cameras[n->camera];
        for (size_t k = 0; k < camera->count; k++, out++) {
            *out = (check_verdict){.asked = n, .camera = camera};
            if (n->kind == QUANTITY_SEPARATION)
                judge_separation(n, camera, &camera->setups[k], out);
            else if (n->kind == QUANTITY_BIAS)
                judge_bias(n, &camera->setups[k], out);
            else if (n->kind != QUANTITY_TIES)
                judge_cells(n, camera, &camera->setups[k], out);
            else if (!judge_ties(request, n, &camera->setups[k], out))
                return -1;
            if ((n->kind == QUANTITY_SEPARATION || n->kind == QUANTITY_TIES) && isfinite(out->z))
                out->code = dp_code(&out->setup, out->z);
            failed += !out->passed;
        }
    }
    return failed;
}
