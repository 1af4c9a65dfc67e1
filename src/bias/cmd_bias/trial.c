/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bias/cmd_bias/trial.h"

#include <math.h>
#include <stdlib.h>

#include "bias/drawn.h"
#include "cli/errors.h"
#include "cli/option/option.h"
#include "cli/output/picture.h"

enum { PAIRS = 500, ENLARGED = 5, DIGITS_Z = 9, DIGITS_ANGLE = 3 };

/* ---- The picture ------------------------------------------------------------------------------------------------- */

/* After Okabe and Ito's palette for all kinds of colour vision (2008), told apart by lightness, too. */
static uint32_t colour_of(const bias_drawing *d, const bias_pair *pair, int x, int y) {
    static const uint32_t wall = 0xFFD9CFC1, layer = 0xFF004E80, fights = 0xFFF0E442, alone = 0xFFE9E9E9;
    const bias_pixel p = bias_pixel_at(d, pair, x, y);
    const size_t at = (size_t)(y - pair->area.y) * (size_t)pair->area.width + (size_t)(x - pair->area.x);
    return p.fights ? fights : p.covered ? layer : d->layer[0].seen[at] != 0 ? wall : alone;
}

/* The pair again, each pixel a square; the one that is named has a black frame. */
static int write_picture(bias_drawing *d, const bias_drawn *drawn, const char *path) {
    static const uint32_t frame = 0xFF000000;
    const draw_area *a = &drawn->pair.area;
    const int width = a->width * ENLARGED, height = a->height * ENLARGED;
    uint32_t *pixel = malloc((size_t)width * (size_t)height * sizeof *pixel);
    bias_draw_pair(d, &drawn->pair);
    for (int i = 0; pixel != NULL && i < width * height; i++) {
        const int across = i % width / ENLARGED, row = i / width / ENLARGED;
        const int u = i % width % ENLARGED, v = i / width % ENLARGED;
        const int x = a->x + across, y = a->y + a->height - 1 - row;
        const bool named = drawn->fights > 0 && x == drawn->x && y == drawn->y;
        const bool edge = u == 0 || v == 0 || u == ENLARGED - 1 || v == ENLARGED - 1;
        pixel[i] = named && edge ? frame : colour_of(d, &drawn->pair, x, y);
    }
    const int status = picture_write(path, pixel, width, height);
    free(pixel);
    return status;
}

/* ---- The trial --------------------------------------------------------------------------------------------------- */

static bias_trial told(const raster_row *row, const bias_drawn *drawn, const char *file) {
    const double none = (double)NAN;
    bias_trial t = {.raster = row->name,
                    .pixels = (double)drawn->pixels,
                    .fights = (double)drawn->fights,
                    .x = none,
                    .y = none,
                    .slant = none,
                    .z = none,
                    .code = none,
                    .moved = none,
                    .file = file};
    if (drawn->fights == 0)
        return t;
    t.x = drawn->x;
    t.y = drawn->y;
    t.slant = drawn->pair.slant;
    t.z = drawn->pixel.z;
    t.code = (double)drawn->pixel.code;
    t.moved = (double)drawn->pixel.moved;
    return t;
}

int bias_try(const raster_row *row, const dp_setup *setup, const bias_state *state, double slope, double lo, double hi,
             const char *render, bias_judged *judged, bias_trial *out) {
    draw_camera camera;
    const raster_status drawable = draw_camera_init(&camera, row, setup);
    if (drawable != RASTER_OK)
        return option_error("rasterize", "%s", raster_status_text(drawable));
    bias_drawing d = {.camera = &camera, .setup = setup, .state = state, .lo = lo, .hi = hi, .slope = slope};
    int status = bias_drawing_open(&d) ? EXIT_FINE : usage_error("no memory to draw in");
    if (status == EXIT_FINE) {
        const bias_drawn drawn = bias_draw(&d, PAIRS, 0);
        *out = told(row, &drawn, render);
        if (drawn.fights > 0 && judged->v.answer == BIAS_NOT_PROVEN)
            bias_judged_by(judged, out->z, out->code, out->moved);
        if (render != NULL)
            status = write_picture(&d, &drawn, render);
    }
    bias_drawing_close(&d);
    return status;
}

/* ---- Words ------------------------------------------------------------------------------------------------------- */

/* clang-format off */
const column bias_trial_columns[] = {
    {FIELD(bias_trial, raster, "raster", "")},
    {FIELD(bias_trial, pixels, "pixels", "")},
    {FIELD(bias_trial, fights, "fights", "")},
    {FIELD(bias_trial, x, "x", "")},
    {FIELD(bias_trial, y, "y", "")},
    {FIELD(bias_trial, slant, "slant", "degrees"), .digits = DIGITS_ANGLE},
    {FIELD(bias_trial, z, "z", "scene"), .digits = DIGITS_Z},
    {FIELD(bias_trial, code, "code", "")},
    {FIELD(bias_trial, moved, "code_moved", "")},
    {FIELD(bias_trial, file, "file", "")},
    {.kind = COLUMN_END}};
/* clang-format on */

enum { FIGHTS = 1, PICTURED = 2, SOME = 4 };

static const sentence words[] = {
    NOTE("drawn", "{fights} of {pixels} pixels show the layer below, by {raster}", FIGHTS),
    ELSE("none of {pixels} pixels shows the layer below, by {raster}", SOME),
    ELSE("no triangle fits: nothing was drawn", 0),
    NOTE("", "pixel {x}, {y} from the lower left, a plane at {slant} degrees: {code_moved} at z = {z}, below it {code}",
         FIGHTS),
    NOTE("", "{file} shows that plane", PICTURED | FIGHTS),
    SENTENCE_END};

void bias_say_trial(page *p, bias_trial *t) {
    page_say(p, words, bias_trial_columns, t,
             (t->fights > 0.0 ? FIGHTS : 0) | (t->file != NULL ? PICTURED : 0) | (t->pixels > 0.0 ? SOME : 0));
}
