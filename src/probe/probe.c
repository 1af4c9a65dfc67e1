/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "probe/probe.h"

#include <errno.h>
#include <string.h>

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

/* What the child wrote is checked as a file is: its driver may have written anything. */
static bool read_machine(const job *j, FILE *in) {
    shot_machine *m = j->machine;
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
    for (size_t i = 0; i < j->plan->count; i++) {
        shot *s = &j->plan->shot[i];
        uint64_t head[2];
        if (fread(head, sizeof head, 1, in) != 1 || fread(s->code, sizeof *s->code, SHOT_PIXELS, in) != SHOT_PIXELS)
            return false;
        s->drawn = head[0] != 0;
        s->passed = head[1];
    }
    return m->error[0] != '\0' || m->chosen < m->count;
}

static bool fail(char error[SHOT_ERROR_SIZE], const char *text, const char *why) {
    snprintf(error, SHOT_ERROR_SIZE, "%s%s", text, why);
    return false;
}

bool probe_run(const char *device, uint64_t seed, probe_result *r, char error[SHOT_ERROR_SIZE]) {
    FILE *made = NULL;
    *r = (probe_result){0};
    job j = {device, &r->plan, &r->machine};
    if (!plan_make(&r->plan, seed))
        return fail(error, "there is no memory for it", "");
    const sandbox_end end = sandbox_run(work, &j, (sandbox_limits){.wall = PROBE_SECONDS}, &made);
    bool good = false;
    if (end == SANDBOX_NO_FILE)
        fail(error, "needs a file for a while, which cannot be made: ", strerror(errno));
    else if (end == SANDBOX_NO_PROCESS)
        fail(error, "needs a process of its own, which cannot be made: ", strerror(errno));
    else if (end == SANDBOX_ENDLESS)
        snprintf(error, SHOT_ERROR_SIZE, "the driver does not come to an end in %d s", PROBE_SECONDS);
    else if (end == SANDBOX_BROKEN)
        fail(error, "the driver broke down", "");
    else if (!read_machine(&j, made))
        fail(error, "what the driver made is damaged", "");
    else if (r->machine.error[0] != '\0')
        fail(error, r->machine.error, "");
    else
        good = true;
    sandbox_close(made);
    if (good)
        probe_judge(r);
    return good;
}

void probe_free(probe_result *r) {
    if (r != NULL)
        plan_free(&r->plan);
}
