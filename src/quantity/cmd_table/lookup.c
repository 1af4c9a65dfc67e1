/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "quantity/cmd_table/lookup.h"
#include "quantity/cmd_table/request.h"

#include <math.h>

#include "camera/cmd/each_setup.h"
#include "report/number.h"
#include "shader/decode.h"

enum { DIGITS_DEPTH = 7, DEPTH_MOST = 10, DIGITS_Z = 8, DIGITS_CELL = 9, DIGITS_MOST = 15, DIGITS_INTERVAL = 3 };

/* A window depth or a code, and the eye depths that are stored as that code. */
typedef struct found {
    double depth, z; /* as asked, or what the code stands for; and its eye depth */
    dp_cell cell;
    int depth_digits, cell_digits;
} found;

typedef struct lookup {
    each_setup each;
    const table_request *o;
    bool by_code;
    found row;
    bool empty; /* some code is that of no depth in the range */
} lookup;

static void *next_row(void *of, size_t i) {
    lookup *l = of;
    found *r = &l->row;
    const dp_setup *setup = l->each.setup;
    const dp_format *format = &setup->spec.format;
    double asked;
    if (!each_setup_depth(&l->each, i, &asked))
        return NULL;
    const uint32_t code =
        l->by_code ? (uint32_t)floor(asked + 0.5) : dp_format_encode(format, setup->spec.rounding, asked);
    r->depth = l->by_code ? dp_format_value(format, code) : asked;
    r->cell = dp_cell_of(setup, code);
    r->z = l->by_code ? r->cell.stored : decode_exact(setup, DECODE_EYE, asked);
    r->depth_digits = number_digits_within(r->depth, 1.0 - r->depth, DIGITS_DEPTH, DEPTH_MOST);
    r->cell_digits = number_digits_within(r->cell.lo, r->cell.width, DIGITS_CELL, DIGITS_MOST);
    l->empty = l->empty || r->cell.width == 0.0;
    return r;
}

static void *next_setup(void *of, size_t i) {
    lookup *l = of;
    l->empty = false;
    if (!each_setup_go(&l->each, i))
        return NULL;
    l->each.at = l->o->looked_up;
    return l;
}

static void say_notes(page *p, void *item) {
    const lookup *l = item;
    if (l->empty)
        page_line(p, "an interval of 0: no depth from near to far is stored as that code");
    if (isnan(l->row.cell.width))
        page_line(p, "this model has no cells: depths that share a code need not be contiguous");
}

static const column row_columns[] = {
    {FIELD(found, depth, "depth", ""), SHOWN("depth", 13, 0), .digits_at = offsetof(found, depth_digits)},
    {FIELD(found, cell.code, "code", ""), SHOWN("code", 11, 0)},
    {FIELD(found, z, "z", "scene"), SHOWN("eye depth", 12, DIGITS_Z)},
    {FIELD(found, cell.stored, "z_stored", "scene"), SHOWN("stored", 15, DIGITS_CELL), .spare = 1},
    {FIELD(found, cell.lo, "cell_lo", "scene"), SHOWN("cell from", 17, 0), .digits_at = offsetof(found, cell_digits),
     .downward = true},
    {FIELD(found, cell.hi, "cell_hi", "scene"), SHOWN("to", 17, 0), .digits_at = offsetof(found, cell_digits),
     .upward = true},
    {FIELD(found, cell.width, "interval", "scene"), SHOWN("interval", 9, DIGITS_INTERVAL)},
    {.kind = COLUMN_END}};

static const column setup_report[] = {{PART(lookup, each.fields, NULL, setup_columns)},
                                      EACH_RANGE_COLUMNS(lookup),
                                      {LIST("rows", row_columns, next_row)},
                                      EACH_PRESET_COLUMNS(lookup),
                                      {.kind = COLUMN_END}};

static const column columns[] = {
    {LIST("setups", setup_report, next_setup), .head = each_setup_title, .notes = say_notes}, {.kind = COLUMN_END}};

bool lookup_wanted(const table_request *o) {
    return o->looked_up.count > 0;
}

/* The value looked up need be no depth of the scene, but a code must be one of each format. */
static int check(const table_request *o, const setups *all) {
    if (o->camera.model != DP_MODEL_FLOAT && camera_names_arith(&o->camera))
        return option_error("arith", "needs --model float with --depth or --code: other models have none");
    for (size_t i = 0; i < all->count && option_given(o->line, "code"); i++) {
        const dp_format *format = &all->items[i].spec.format;
        if (o->looked_up.hi > (double)format->code_max)
            return option_error("code", "must be from 0 to %u in %s, got %s", format->code_max, format->name,
                                number_full(o->looked_up.hi).text);
    }
    return EXIT_FINE;
}

int lookup_write(const table_request *o) {
    lookup l = {.o = o, .by_code = option_given(o->line, "code")};
    int status = each_setup_start(&l.each, &o->camera, &o->out);
    if (status == EXIT_FINE)
        status = check(o, &l.each.all);
    const report_spec spec = {"table", columns, &l, .label = 16};
    return each_setup_write(&l.each, &spec, status);
}
