/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "probe/probe.h"

#include <errno.h>
#include <string.h>

#include "probe/compute.h"
#include "probe/judge.h"
#include "system/sandbox.h"

typedef struct job {
    const char *device;
    shot_plan *plan;
    shot_machine *machine;
} job;

/* ---- The child --------------------------------------------------------------------------------------------------- */

static bool work(void *of, FILE *out) {
    const job *j = of;
    j->machine->error[0] = '\0';
    if (j->device != NULL && strcmp(j->device, PROBE_OPENGL) == 0)
        shot_opengl(j->plan, j->machine);
    else
        shot_vulkan(j->device, j->plan, j->machine);
    fwrite(j->machine, sizeof *j->machine, 1, out);
    for (size_t i = 0; i < j->plan->count; i++) {
        const shot *s = &j->plan->shot[i];
        const uint64_t head[2] = {s->drawn, s->passed};
        fwrite(head, sizeof head, 1, out);
        fwrite(s->code, sizeof *s->code, SHOT_PIXELS, out);
    }
    return true;
}

/* ---- The parent -------------------------------------------------------------------------------------------------- */

static void end_text(char *text, size_t size) {
    text[size - 1] = '\0';
}

/* Reads the child's answer, checked as a file is: its driver may have written anything. */
static bool read_machine(shot_machine *m, FILE *in) {
    if (fread(m, sizeof *m, 1, in) != 1 || m->count > SHOT_DEVICES_MAX || m->chosen > m->count)
        return false;
    end_text(m->error, sizeof m->error);
    for (size_t i = 0; i < m->count; i++) {
        shot_device *d = &m->device[i];
        end_text(d->name, sizeof d->name);
        end_text(d->driver, sizeof d->driver);
        end_text(d->api, sizeof d->api);
        for (int f = 0; f < SHOT_FORMATS; f++)
            end_text(d->format[f], sizeof d->format[f]);
    }
    return m->error[0] != '\0' || m->chosen < m->count;
}

static bool read_shots(shot_plan *plan, FILE *in) {
    for (size_t i = 0; i < plan->count; i++) {
        shot *s = &plan->shot[i];
        uint64_t head[2];
        if (fread(head, sizeof head, 1, in) != 1 || fread(s->code, sizeof *s->code, SHOT_PIXELS, in) != SHOT_PIXELS)
            return false;
        s->drawn = head[0] != 0;
        s->passed = head[1];
    }
    return true;
}

static bool fail(char *error, size_t size, const char *text, const char *why) {
    snprintf(error, size, "%s%s", text, why);
    return false;
}

/* Whether the child ended well, and its driver, too. */
static bool ended(sandbox_end end, const char *what, int seconds, shot_machine *m, FILE *made, char *error,
                  size_t size) {
    char hangs[SHOT_ERROR_SIZE];
    if (end == SANDBOX_NO_FILE)
        return fail(error, size, "needs a file for a while, which cannot be made: ", strerror(errno));
    if (end == SANDBOX_NO_PROCESS)
        return fail(error, size, "needs a process of its own, which cannot be made: ", strerror(errno));
    snprintf(hangs, sizeof hangs, "the %s in %d s%s", what, seconds, seconds == PROBE_SECONDS ? "" : " of work");
    if (end == SANDBOX_ENDLESS)
        return fail(error, size, hangs, "");
    if (end == SANDBOX_BROKEN)
        return fail(error, size, "the driver broke down", "");
    if (!read_machine(m, made))
        return fail(error, size, "what the driver made is damaged", "");
    return m->error[0] == '\0' || fail(error, size, m->error, "");
}

bool probe_run(const char *device, uint64_t seed, probe_result *r, char error[SHOT_ERROR_SIZE]) {
    FILE *made = NULL;
    *r = (probe_result){0};
    job j = {device, &r->plan, &r->machine};
    if (!plan_make(&r->plan, seed))
        return fail(error, SHOT_ERROR_SIZE, "there is no memory for it", "");
    const sandbox_end end = sandbox_run(work, &j, (sandbox_limits){.wall = PROBE_SECONDS}, &made);
    bool good = ended(end, "driver does not come to an end", PROBE_SECONDS, &r->machine, made, error, SHOT_ERROR_SIZE);
    if (good && !read_shots(&r->plan, made))
        good = fail(error, SHOT_ERROR_SIZE, "what the driver made is damaged", "");
    sandbox_close(made);
    if (good)
        probe_judge(r);
    return good;
}

void probe_free(probe_result *r) {
    if (r != NULL)
        plan_free(&r->plan);
}

/* ---- A shader of somebody's -------------------------------------------------------------------------------------- */

typedef struct computing {
    const char *device;
    const compute_run *run;
    size_t runs;
    shot_machine *machine;
} computing;

/* The machine stands first, and is known last. */
static bool work_compute(void *of, FILE *out) {
    const computing *c = of;
    *c->machine = (shot_machine){0};
    fwrite(c->machine, sizeof *c->machine, 1, out);
    shot_compute(c->device, c->run, c->runs, c->machine, out);
    rewind(out);
    fwrite(c->machine, sizeof *c->machine, 1, out);
    return true;
}

bool compute_values(const char *device, const compute_run *run, size_t runs, shot_machine *machine, FILE **values,
                    bool *endless, char error[COMPUTE_ERROR_SIZE]) {
    computing c = {device, run, runs, machine};
    const unsigned seconds = runs > 0 || run->count > COMPUTE_FEW ? COMPUTE_ALL_SECONDS : COMPUTE_SECONDS;
    const sandbox_end end = sandbox_run(work_compute, &c, (sandbox_limits){seconds, COMPUTE_WAIT_SECONDS}, values);
    *endless = end == SANDBOX_ENDLESS;
    if (ended(end, "function did not end", (int)seconds, machine, *values, error, COMPUTE_ERROR_SIZE))
        return true;
    sandbox_close(*values);
    *values = NULL;
    return false;
}
