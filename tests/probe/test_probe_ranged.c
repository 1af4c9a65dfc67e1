/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Depth ranges of viewports as drivers draw them: random triangles in random ranges, every pixel's stored code against
 * the models of src/raster. A driver that is not here is left out, and so is a processor without FMA, whose operations
 * are others than those that were recorded.
 */
#include <glob.h>
#include <stdlib.h>
#include <string.h>

#include "core/bits.h"
#include "predicted.h"
#include "probe/plan.h"
#include "probe/probe.h"
#include "system/sandbox.h"

enum { RANGES = 12, SHOTS = RANGES * SHOT_FORMATS, SECONDS = 300 };

/* The driver of a rasterizer, and what chooses it. */
typedef struct driver {
    const char *raster, *file, *variable;
    const char *value; /* null: the file */
    bool opengl;
} driver;

static const driver drivers[] = {
    {"llvmpipe", "/usr/lib/*/libEGL_mesa.so.0", "GALLIUM_DRIVER", "llvmpipe", true},
    {"softpipe", "/usr/lib/*/libEGL_mesa.so.0", "GALLIUM_DRIVER", "softpipe", true},
    {"lavapipe", "/usr/share/vulkan/icd.d/lvp_icd*.json", "VK_ICD_FILENAMES", NULL, false},
    {"swiftshader", "/usr/lib/chromium/vk_swiftshader_icd.json", "VK_ICD_FILENAMES", NULL, false},
};

typedef struct job {
    const driver *by;
    char path[256];
    shot_plan plan;
    shot_machine machine;
} job;

static bool draw(void *of, FILE *out) {
    job *j = of;
    setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
    setenv(j->by->variable, j->by->value != NULL ? j->by->value : j->path, 1);
    j->machine = (shot_machine){0};
    if (j->by->opengl)
        shot_opengl(&j->plan, &j->machine);
    else
        shot_vulkan(NULL, &j->plan, &j->machine);
    fwrite(&j->machine, sizeof j->machine, 1, out);
    for (size_t i = 0; i < j->plan.count; i++) {
        fwrite(&j->plan.shot[i].drawn, sizeof j->plan.shot[i].drawn, 1, out);
        fwrite(j->plan.shot[i].code, sizeof(uint32_t), SHOT_PIXELS, out);
    }
    return true;
}

/* Why nothing was drawn; null where all was. */
static const char *take(job *j) {
    FILE *made = NULL;
    if (sandbox_run(draw, j, (sandbox_limits){.wall = SECONDS}, &made) != SANDBOX_DONE)
        return "the driver broke down";
    if (fread(&j->machine, sizeof j->machine, 1, made) != 1)
        return "damaged";
    for (size_t i = 0; i < j->plan.count; i++) {
        shot *s = &j->plan.shot[i];
        assert_int_equal(fread(&s->drawn, sizeof s->drawn, 1, made), 1);
        assert_int_equal(fread(s->code, sizeof(uint32_t), SHOT_PIXELS, made), SHOT_PIXELS);
    }
    sandbox_close(made);
    return j->machine.error[0] != '\0' ? j->machine.error : NULL;
}

static void compare(const job *j, tally *t) {
    static uint32_t code[SHOT_PIXELS];
    for (size_t i = 0; i < j->plan.count; i++) {
        const shot *s = &j->plan.shot[i];
        if (!s->drawn)
            continue;
        predict(j->by->raster, s, code);
        for (int k = 0; k < SHOT_PIXELS; k++)
            TALLY(t, code[k] == s->code[k], "%s %s, %a to %a: pixel %d %d is %08x, drawn %08x", j->by->raster,
                  probe_format_name(s->format), (double)s->range[0], (double)s->range[1], k % SHOT_SIZE, k / SHOT_SIZE,
                  code[k], s->code[k]);
    }
}

/* The same triangles in each range, another one in each shot; whole and clipped ones, on all sides. */
static void make_shots(job *j, const shot_plan *all, rng *r) {
    static shot shots[SHOTS];
    static uint32_t code[SHOTS][SHOT_PIXELS];
    j->plan = (shot_plan){(size_t)test_cases(4, RANGES, RANGES) * SHOT_FORMATS, shots};
    for (size_t i = 0; i < j->plan.count; i++) {
        double range[2];
        rng_range(r, range);
        shots[i] = *plan_find(all, PLAN_PREDICTED, (shot_format)(i % SHOT_FORMATS));
        shots[i].range[0] = (float)range[0];
        shots[i].range[1] = (float)range[1];
        shots[i].code = code[i];
    }
}

static bool is_recorded(void) {
#if defined(__x86_64__) && defined(__GNUC__)
    return __builtin_cpu_supports("fma");
#else
    return false;
#endif
}

static void judge(const driver *by, rng *r) {
    job j = {.by = by};
    shot_plan all;
    glob_t found;
    tally t = {.name = by->raster};
    const bool here = glob(by->file, 0, NULL, &found) == 0;
    if (!here || !is_recorded()) {
        print_message("# %s: its driver, or FMA, is not here\n", by->raster);
        if (here)
            globfree(&found);
        return;
    }
    snprintf(j.path, sizeof j.path, "%s", found.gl_pathv[0]);
    globfree(&found);
    assert_true(plan_make(&all, rng_below(r, UINT32_MAX)));
    make_shots(&j, &all, r);
    const char *wrong = take(&j);
    if (wrong != NULL) {
        print_message("# %s: %s\n", by->raster, wrong);
    } else {
        compare(&j, &t);
        print_message("# %s, %s: %llu pixels\n", by->raster, j.machine.device[j.machine.chosen].driver,
                      (unsigned long long)t.cases);
        tally_end(&t);
    }
    plan_free(&all);
}

TEST(drivers_draw_so) {
    rng r = rng_make("ranges of drivers");
    for (size_t i = 0; i < sizeof drivers / sizeof drivers[0]; i++)
        judge(&drivers[i], &r);
}
