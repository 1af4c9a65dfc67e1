/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "quantity/cmd_table/levels.h"

#include <math.h>

#include "report/number.h"
#include "report/report.h"
#include "texture/cmd_texture/texture.h"

/* The lattice, and a depth of --at. */
typedef struct levels {
    const table_request *o;
    const char *given, *name;
    sensor sensor;
    depths at;
    double z, gap, error;
} levels;

/* The boundary between two levels lies half a step of 1/z, or of z, from both. */
static double error_at(const sensor *s, double z) {
    sensor half = *s;
    half.step *= 0.5;
    return s->row->levels == GRAIN_INVERSE ? sensor_gap(&half, z) : 0.5 * sensor_gap(s, z);
}

static void *next_depth(void *of, size_t i) {
    levels *l = of;
    if (i == l->at.count)
        return NULL;
    l->z = depths_get(&l->at, i);
    l->gap = sensor_gap(&l->sensor, l->z);
    l->error = error_at(&l->sensor, l->z);
    return l;
}

static void say_head(page *p, void *of) {
    const levels *l = of;
    const sensor *s = &l->sensor;
    p->unit = camera_unit(&l->o->camera);
    page_title(p, "%s: levels %s%s%s", l->given, s->row->name, p->unit != NULL ? ", lengths in " : "",
               p->unit != NULL ? p->unit : "");
    if (s->row->levels == GRAIN_INVERSE)
        page_note(p, "", "1/z in steps of %s; baseline times focal length over a step %s", number_of(s->step, 6).text,
                  number_in(number_of(1 / s->step, 6), p->unit).text);
    page_note(p, "", "step: to the next farther level; error: of a depth there, rounded to the nearest level, at most");
}

static const column row_columns[] = {{FIELD(levels, z, "z", "scene"), SHOWN("z", 11, 8)},
                                     {FIELD(levels, gap, "step", "scene"), SHOWN("step", 12, 6)},
                                     {FIELD(levels, error, "error", "scene"), SHOWN("error", 12, 6), .upward = true},
                                     {.kind = COLUMN_END}};

static const column columns[] = {{FIELD(levels, given, "lattice", ""), .only = AS_JSON},
                                 {FIELD(levels, name, "levels", ""), .only = AS_JSON},
                                 {FIELD(levels, sensor.step, "step", ""), .only = AS_JSON},
                                 {LIST("rows", row_columns, next_depth)},
                                 {.kind = COLUMN_END}};

bool levels_wanted(const table_request *o) {
    return o->lattice != NULL;
}

int levels_write(const table_request *o) {
    static double usual[] = {1, 2, 5, 10};
    levels l = {.o = o, .given = o->lattice, .at = o->camera.at};
    output out;
    int status = texture_lattice(o->camera.lengths.unit, "lattice", o->lattice, &l.sensor);
    if (status != EXIT_FINE)
        return status;
    if (l.at.count == 0)
        l.at = (depths){.kind = DEPTHS_LIST, .lo = usual[0], .hi = usual[3], .count = 4, .list = usual};
    if (l.sensor.row->levels != GRAIN_HALF && isnan(l.sensor.step))
        return option_error("lattice", "without a file needs a step, which '%s' does not say", l.given);
    if (!isnan(l.sensor.again))
        return option_error("lattice", "@STEP is of a file, which this table has none of, got '%s'", l.given);
    if (!(l.at.lo > 0))
        return option_error("at", "must be above 0 with --lattice, got %s", number_full(l.at.lo).text);
    l.name = l.sensor.row->name;
    status = output_start(&o->out, &o->camera, &out);
    if (status != EXIT_FINE)
        return status;
    report_write(&(report_spec){"table", columns, &l, .label = 2, .head = say_head}, &out, o->out.form);
    return output_close(&out);
}
