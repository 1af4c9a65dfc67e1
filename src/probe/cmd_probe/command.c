/* SPDX-License-Identifier: GPL-3.0-or-later */
/* probe: what the GPU of this machine does to depth, drawn and read back. */
#include "core/append.h"
#include "probe/cmd_probe/report.h"
#include "probe/cmd_probe/request.h"
#include "probe/probe.h"

/* ---- The raw codes ----------------------------------------------------------------------------------------------- */

static void keep_point(output *out, const shot *s, int pixel) {
    const float *v = s->vertex[pixel];
    output_format(out, ",%a,%a", (double)v[2], (double)v[3]);
}

static int keep(const probe_result *r, const char *path) {
    output out;
    int status = output_open(&out, path);
    if (status != EXIT_FINE)
        return status;
    output_text(&out, "shot,format,x,y,z,w,code\r\n");
    for (size_t i = 0; i < r->plan.count && !output_failed(&out); i++) {
        const shot *s = &r->plan.shot[i];
        for (int pixel = 0; s->drawn && pixel < SHOT_PIXELS; pixel++) {
            output_format(&out, "%s,%s,%d,%d", s->name, probe_format_name(s->format), pixel % SHOT_SIZE,
                          pixel / SHOT_SIZE);
            if (s->triangles)
                output_text(&out, ",,");
            else
                keep_point(&out, s, pixel);
            output_format(&out, ",%08x\r\n", s->code[pixel]);
        }
    }
    return output_close(&out);
}

/* ---- The command ------------------------------------------------------------------------------------------------- */

/* A device that is not there is the user's to put right; the rest is the machine's. */
static int refuse(const probe_request *o, probe_result *r, const char *error) {
    const shot_machine *m = &r->machine;
    char names[4 * SHOT_NAME_SIZE] = "";
    probe_free(r);
    for (size_t i = 0; i < m->count; i++)
        append(names, sizeof names, "%s%zu (%s)", i > 0 ? ", " : "", i, m->device[i].name);
    if (o->device != NULL && m->count > 0 && m->chosen == m->count)
        return option_error("device", "must be a number or a part of a name of %s, got '%s'", names, o->device);
    usage_error("probe: %s", error);
    return EXIT_IO;
}

int cmd_probe(void *request) {
    const probe_request *o = request;
    static probe_result result; /* too large for a stack */
    char error[SHOT_ERROR_SIZE];
    output out;
    int status = output_start(&o->out, NULL, &out);
    if (status == EXIT_FINE && o->keep != NULL && (status = output_check(o->keep)) != EXIT_FINE)
        output_abandon(&out);
    if (status != EXIT_FINE)
        return status;
    if (!probe_run(o->device, o->seed, &result, error)) {
        output_abandon(&out);
        return refuse(o, &result, error);
    }
    probe_report(&result, &out, o->out.form);
    status = output_close(&out);
    if (status == EXIT_FINE && o->keep != NULL)
        status = keep(&result, o->keep);
    probe_free(&result);
    return status;
}
