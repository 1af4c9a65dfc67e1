/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * disocclusion: how far apart two samples have to be, that they are surely of two surfaces: the guarantee at any slant
 * of each format and mapping, beside the constants that temporal upscalers ship.
 */
#include <math.h>

#include "api/disocclusion.h"
#include "cli/reach.h"
#include "cli/slant.h"
#include "cli/walk.h"
#include "core/elementary.h"
#include "report/number.h"

enum { DIGITS = 4, DIGITS_Z = 9, DIGITS_TIMES = 3 };

static const double degree = 0.017453292519943295;

/* A shipped constant at the depth at hand, and beside the set-up at hand. */
typedef struct constant {
    const char *name;
    double share, separation;
    double times; /* ours; NaN where there is none */
} constant;

typedef struct row {
    char label[SETUP_LABEL_SIZE];
    double z;
    double separation, share; /* INFINITY: none is certain */
    constant shipped[DISOCCLUSION_ROWS];
} row;

/* Text goes by depths, so that formats and mappings stand below each other; data by set-ups, as elsewhere. */
typedef struct disocclusion {
    walk walk;
    slant_fields slant;
    const slant_fields *triangles;
    double grid;  /* the share of z that the vertex grid alone takes */
    size_t depth; /* of text, the one at hand */
    row row;
} disocclusion;

/* ---- What is reported -------------------------------------------------------------------------------------------- */

static constant shipped_at(const disocclusion *d, size_t i, double z) {
    const dp_triangles *t = &d->slant.triangles;
    const disocclusion_view view = {t->width, t->height, t->fov_y};
    const double share = disocclusion_get(i)->share(&view);
    return (constant){disocclusion_get(i)->name, share, share * z, (double)NAN};
}

/* Edge-on and along the diagonal, where no slant pays more for it, whatever format, mapping and depth: depthprec(7). */
static double grid_of(const dp_triangles *t) {
    const double tau = 2.0 * dp_tan(0.5 * t->fov_y * degree) / t->height;
    return t->subpixel > 0 ? 2.0 * sqrt(2.0) * tau * ldexp(0.5, -t->subpixel) : 0.0;
}

/* Those of --at, or the one in the middle of near and far. */
static bool depth_of(const disocclusion *d, size_t i, double *z) {
    const bool given = option_given(d->walk.o, OPTION_AT);
    if (i == (given ? d->walk.at.count : 1) || output_failed(&d->walk.out))
        return false;
    *z = depths_get(&d->walk.at, given ? i : d->walk.at.count / 2);
    return true;
}

static void measure(disocclusion *d, double z) {
    row *r = &d->row;
    const dp_setup full = dp_setup_guaranteed(d->walk.setup);
    setup_label(d->walk.setup, false, r->label);
    r->z = z;
    r->separation = dp_separation(&full, z);
    r->share = r->separation / z;
    for (size_t i = 0; i < DISOCCLUSION_ROWS; i++) {
        r->shipped[i] = shipped_at(d, i, z);
        r->shipped[i].times = isinf(r->share) ? (double)NAN : r->shipped[i].share / r->share;
    }
}

static void *next_setup(void *of, size_t i) {
    disocclusion *d = of;
    if (!walk_setup(&d->walk, i))
        return NULL;
    d->triangles = slant_fields_of(&d->walk.here, &d->slant);
    return d;
}

static void *next_row(void *of, size_t i) {
    disocclusion *d = of;
    double z;
    if (!depth_of(d, i, &z))
        return NULL;
    measure(d, z);
    return &d->row;
}

static void *next_constant(void *of, size_t i) {
    row *r = of;
    return i < DISOCCLUSION_ROWS ? &r->shipped[i] : NULL;
}

static void *next_depth(void *of, size_t i) {
    disocclusion *d = of;
    d->depth = i;
    return depth_of(d, i, &d->row.z) ? d : NULL;
}

static void *next_beside(void *of, size_t i) {
    disocclusion *d = next_setup(of, i);
    return d != NULL ? next_row(d, d->depth) : NULL;
}

/* ---- Text -------------------------------------------------------------------------------------------------------- */

static void say_grid(page *p, const disocclusion *d) {
    const double grid = d->grid;
    if (!(grid > 0.0))
        return;
    page_line(p, "the vertex grid alone takes %s %% of z: %s is %s times that, %s %s times",
              number_of(100.0 * grid, DIGITS_TIMES).text, disocclusion_get(0)->name,
              number_of(shipped_at(d, 0, 1.0).share / grid, DIGITS).text, disocclusion_get(1)->name,
              number_of(shipped_at(d, 1, 1.0).share / grid, DIGITS).text);
}

static void say_view(page *p, void *item) {
    const disocclusion *d = item;
    const options *o = d->walk.o;
    p->unit = options_unit(o);
    page_title(p, "near %s, far %s", number_in(number_full(o->znear), p->unit).text,
               number_in(number_full(o->zfar), p->unit).text);
    slant_say(p, page_title, o, &d->walk.all.items[0]);
    page_text(
        p, "Two samples of one surface may be as far apart as is guaranteed at any slant; farther apart, along the "
           "normal, they are two surfaces. Beside it what temporal upscalers ship, as a multiple of it: below 1, one "
           "surface may be taken for two.");
    for (size_t i = 0; i < DISOCCLUSION_ROWS; i++)
        page_note(p, disocclusion_get(i)->name, "%s = %s %% of z; %s", disocclusion_get(i)->formula,
                  number_of(100.0 * shipped_at(d, i, 1.0).share, DIGITS_TIMES).text, disocclusion_get(i)->source);
    say_grid(p, d);
    output_char(p->out, '\n');
}

static void say_depth(page *p, void *item) {
    const disocclusion *d = item;
    page_title(p, "z = %s", number_in(number_of(d->row.z, DIGITS_Z), p->unit).text);
}

/* ---- Columns ----------------------------------------------------------------------------------------------------- */

static const column constant_columns[] = {{FIELD(constant, name, "constant", "")},
                                          {FIELD(constant, share, "shipped_share", "")},
                                          {FIELD(constant, separation, "shipped", "scene")},
                                          {FIELD(constant, times, "times", "")},
                                          {.kind = COLUMN_END}};

static const column row_columns[] = {{FIELD(row, z, "z", "scene")},
                                     {FIELD(row, separation, "separation", "scene")},
                                     {FIELD(row, share, "share", "")},
                                     {LIST("constants", constant_columns, next_constant)},
                                     {.kind = COLUMN_END}};

static const column setup_report[] = {{PART(disocclusion, walk.fields, NULL, setup_columns)},
                                      {FIELD(disocclusion, walk.fields.arith, "arith", ""), .only = AS_CSV},
                                      {LIST("rows", row_columns, next_row)},
                                      {.kind = COLUMN_END}};

static const column columns[] = {
    {PART(disocclusion, triangles, "triangles", slant_columns), .only = AS_JSON, .pointed = true},
    {FIELD(disocclusion, grid, "grid_share", ""), .only = AS_JSON},
    {LIST("setups", setup_report, next_setup)},
    {.kind = COLUMN_END}};

/* The titles of the last two are the names of the rows. */
_Static_assert(DISOCCLUSION_ROWS == 2, "a column each");
static const column beside_columns[] = {
    {TEXT_FIELD(row, label, "", -22, 0)},
    {TEXT_FIELD(row, separation, "any slant", 12, DIGITS), .upward = true},
    {TEXT_FIELD(row, share, "of z", 12, DIGITS), .upward = true},
    {TEXT_FIELD(row, shipped[0].times, "tangent x", 11, DIGITS_TIMES), .brief = true},
    {TEXT_FIELD(row, shipped[1].times, "diagonal x", 11, DIGITS_TIMES), .brief = true},
    {.kind = COLUMN_END}};

static const column depth_columns[] = {{LIST(NULL, beside_columns, next_beside), .indent = 2}, {.kind = COLUMN_END}};

static const column text_columns[] = {{LIST(NULL, depth_columns, next_depth), .head = say_depth}, {.kind = COLUMN_END}};

/* ---- The command ------------------------------------------------------------------------------------------------- */

int cmd_disocclusion(const options *o) {
    disocclusion d = {0};
    options in_binary32 = *o;
    in_binary32.model = DP_MODEL_FLOAT;
    d.triangles = slant_fields_of(o, &d.slant);
    d.grid = grid_of(&d.slant.triangles);
    const bool text = o->form == FORM_TEXT;
    int status = walk_start(&d.walk, &in_binary32);
    if (status == EXIT_FINE)
        status = depths_in_binary32(&d.walk.at);
    const report_spec spec = {"disocclusion", text ? text_columns : columns, &d, .label = 10,
                              .head = text ? say_view : NULL};
    return walk_write(&d.walk, &spec, status);
}
