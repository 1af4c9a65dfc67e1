/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "shadow/cmd_shadow/trial.h"

#include <math.h>
#include <stdlib.h>

#include "cli/errors.h"
#include "cli/output/picture.h"
#include "draw/canvas.h"
#include "shadow/cmd_shadow/given.h"
#include "shadow/drawn.h"

enum { PLANES = 48, ENLARGED = 2, BETWEEN = 8, KERNEL_MOST = 32 };

/* ---- What is asked ----------------------------------------------------------------------------------------------- */

int shadow_check_trial(const shadow_request *o) {
    const size_t setups = o->camera.format_count * o->camera.mapping_count;
    if (!o->shadow.drawn)
        return EXIT_FINE;
    if (o->camera.raster == NULL || o->camera.raster->model == NULL)
        return option_error("raster", "must be one that draws: llvmpipe, lavapipe, softpipe or swiftshader, got '%s'",
                            option_text(o->line, "raster"));
    for (size_t i = 0; i < o->camera.format_count; i++)
        if (!raster_draws(o->camera.raster, &o->camera.formats[i]) ||
            !raster_bounded(o->camera.raster, &o->camera.formats[i]))
            return option_error("format", "must be one that %s has and that can be bounded, got %s",
                                o->camera.raster->name, o->camera.formats[i].name);
    if (bias_asked_api(&o->bias, 1) != NULL)
        return option_error("api", "must be one, whose bias is drawn, got '%s'", option_text(o->line, "api"));
    if (o->shadow.kernel > KERNEL_MOST)
        return option_error("rasterize", "draws filters of at most %dx%d texels, got %ux%u", KERNEL_MOST, KERNEL_MOST,
                            o->shadow.kernel, o->shadow.kernel);
    if (o->shadow.size[0] > RASTER_SIZE_MAX || o->shadow.size[1] > RASTER_SIZE_MAX)
        return option_error("size", "must be at most %dx%d to draw in, got '%ux%u'", RASTER_SIZE_MAX, RASTER_SIZE_MAX,
                            o->shadow.size[0], o->shadow.size[1]);
    if (o->shadow.render == NULL)
        return EXIT_FINE;
    if (canvas_format_of(o->shadow.render) != CANVAS_PNG)
        return option_error("render", "must end in .png, got '%s'", o->shadow.render);
    if (setups > 1)
        return option_error("render", "shows one format and mapping, got %zu", setups);
    return output_check(o->shadow.render);
}

/* ---- The picture ------------------------------------------------------------------------------------------------- */

/* After Okabe and Ito's palette for all kinds of colour vision (2008), told apart by lightness, too. */
static const uint32_t lit = 0xFFD9CFC1, dark = 0xFF004E80, lost = 0xFFF0E442, leak = 0xFFD55E00, outside = 0xFFE9E9E9;

static uint32_t mixed(uint32_t a, uint32_t b, double share) {
    uint32_t out = 0xFF000000;
    for (int shift = 0; shift < 24; shift += 8) {
        const double x = (a >> shift & 0xFFU) * (1.0 - share) + (b >> shift & 0xFFU) * share;
        out |= (uint32_t)nearbyint(x) << shift;
    }
    return out;
}

/* The darker acne is, the more texels have it. */
static uint32_t colour_of(shadow_point point) {
    static const uint32_t black = 0xFF000000;
    return point.seen == SHADOW_SEEN_ACNE   ? mixed(black, lit, 0.75 * point.lit)
           : point.seen == SHADOW_SEEN_LEAK ? leak
           : point.seen == SHADOW_SEEN_LOST ? mixed(dark, lost, point.lit)
           : point.seen == SHADOW_SEEN_NONE ? outside
                                            : mixed(dark, lit, point.lit);
}

/* One bias: each point a square. */
static void paint(shadow_drawing *d, const shadow_scene *scene, uint32_t *pixel, int stride) {
    const int each = SHADOW_DRAWN_POINTS * ENLARGED, width = scene->area.width * each;
    const int height = scene->area.height * each;
    for (int row = 0; row < height; row++)
        for (int i = 0; i < width; i++) {
            const double u = (i / ENLARGED + 0.5) / SHADOW_DRAWN_POINTS;
            const double v = ((height - 1 - row) / ENLARGED + 0.5) / SHADOW_DRAWN_POINTS;
            pixel[(size_t)row * (size_t)stride + (size_t)i] =
                colour_of(shadow_point_at(d, scene, scene->area.x + u, scene->area.y + v));
        }
}

static int write_picture(shadow_drawing *d, const shadow_scene *scene, const shadow_worn *worn, size_t count,
                         const char *path) {
    const int each = SHADOW_DRAWN_POINTS * ENLARGED, wide = scene->area.width * each + BETWEEN;
    const int width = (int)count * wide - BETWEEN, height = scene->area.height * each;
    uint32_t *pixel = malloc((size_t)width * (size_t)height * sizeof *pixel);
    for (int i = 0; pixel != NULL && i < width * height; i++)
        pixel[i] = 0xFFFFFFFF;
    for (size_t k = 0; pixel != NULL && k < count; k++) {
        shadow_scene_draw(d, scene, &worn[k]);
        paint(d, scene, pixel + k * (size_t)wide, width);
    }
    const int status = picture_write(path, pixel, width, height);
    free(pixel);
    return status;
}

/* ---- The trial --------------------------------------------------------------------------------------------------- */

/* The biases that are drawn, the call's own numbers, and what a set-up has of each. */
typedef struct trying {
    const shadow_request *o;
    const bias_api *api;
    size_t count;
    shadow_worn worn[SHADOW_TRIALS];
    shadow_drawn drawn[SHADOW_TRIALS];
    double planes;
    size_t map; /* of the plane with most points that have acne or lie behind the farther caster */
    shadow_scene scene;
    uint64_t most;
    bool any;
} trying;

static void take_biases(trying *t, const shadow_maps *maps, shadow_trial out[SHADOW_TRIALS]) {
    const shadow_asked *asked = &t->o->shadow;
    const shadow_whole whole = shadow_whole_of(maps, t->api);
    const bias_state none = {t->api, 0.0, 0.0, 0.0};
    shadow_engine_row row;
    t->worn[0] = (shadow_worn){.state = none};
    out[0].bias = "none";
    if (shadow_engine_row_of(t->o, maps, 0, &row)) {
        t->worn[0].engine = asked->engine;
        t->worn[0].bias = isnan(row.bias) ? 0.0 : row.bias;
        t->worn[0].normal = isnan(row.normal) ? 0.0 : row.normal;
        out[0].bias = row.engine;
    }
    t->count = 1;
    for (int k = 0; k < SHADOW_WAY_COUNT; k++) {
        const shadow_set *w = &whole.way[k];
        if (isnan(w->units))
            continue;
        t->worn[t->count] = (shadow_worn){
            .state = {t->api, strtod(w->units_text, NULL), strtod(w->factor_text, NULL), 0.0}, .offset = w->offset};
        out[t->count++].bias = shadow_way_name((shadow_way)k);
    }
}

static void try_plane(trying *t, shadow_drawing *d, const shadow_need *need, size_t map, uint64_t state) {
    shadow_scene scene;
    if (!shadow_scene_random(d, &state, &scene))
        return;
    t->planes++;
    shadow_scene_stand(d, &scene, need);
    for (size_t k = 0; k < t->count; k++) {
        shadow_drawn *drawn = &t->drawn[k];
        const uint64_t before = drawn->of[SHADOW_SEEN_ACNE] + drawn->of[SHADOW_SEEN_DARK];
        shadow_scene_draw(d, &scene, &t->worn[k]);
        shadow_scene_count(d, &scene, drawn);
        const uint64_t found = drawn->of[SHADOW_SEEN_ACNE] + drawn->of[SHADOW_SEEN_DARK] - before;
        if (k > 0 || (t->any && found <= t->most))
            continue;
        t->any = true;
        t->most = found;
        t->map = map;
        t->scene = scene;
    }
}

static int try_map(trying *t, const shadow_maps *maps, size_t map, bool picture) {
    const shadow_light *light = shadow_map_of(maps, map);
    shadow_drawing d;
    shadow_need need;
    const raster_status drawable = shadow_drawing_open(&d, t->o->camera.raster, light);
    int status = drawable == RASTER_OK ? EXIT_FINE : option_error("rasterize", "%s", raster_status_text(drawable));
    d.api = t->api;
    shadow_need_of(light, &need);
    const size_t planes = PLANES / shadow_map_count(maps);
    for (size_t i = 0; i < planes && status == EXIT_FINE && !picture; i++) {
        uint64_t seed = (uint64_t)map << 32 ^ (uint64_t)i << 20;
        try_plane(t, &d, &need, map, draw_random(&seed));
    }
    if (status == EXIT_FINE && picture) {
        shadow_scene_stand(&d, &t->scene, &need);
        status = write_picture(&d, &t->scene, t->worn, t->count, t->o->shadow.render);
    }
    shadow_drawing_close(&d);
    return status;
}

static double sum(const shadow_drawn *drawn, shadow_seen good, shadow_seen bad) {
    return (double)(drawn->of[good] + drawn->of[bad]);
}

int shadow_try(const shadow_request *o, const shadow_maps *maps, shadow_trial out[SHADOW_TRIALS], size_t *count) {
    trying t = {.o = o, .api = shadow_asked_api(o, 0)};
    int status = EXIT_FINE;
    take_biases(&t, maps, out);
    for (size_t i = 0; i < shadow_map_count(maps) && status == EXIT_FINE; i++)
        status = try_map(&t, maps, i, false);
    if (status == EXIT_FINE && o->shadow.render != NULL && t.any)
        status = try_map(&t, maps, t.map, true);
    for (size_t k = 0; k < t.count; k++) {
        const shadow_drawn *d = &t.drawn[k];
        out[k] = (shadow_trial){.bias = out[k].bias,
                                .raster = o->camera.raster->name,
                                .file = t.any ? o->shadow.render : NULL,
                                .planes = t.planes,
                                .points = sum(d, SHADOW_SEEN_LIT, SHADOW_SEEN_ACNE),
                                .acne = (double)d->of[SHADOW_SEEN_ACNE],
                                .behind = sum(d, SHADOW_SEEN_DARK, SHADOW_SEEN_LEAK),
                                .lit = (double)d->of[SHADOW_SEEN_LEAK],
                                .within = sum(d, SHADOW_SEEN_SHORT, SHADOW_SEEN_LOST),
                                .lost = (double)d->of[SHADOW_SEEN_LOST]};
    }
    *count = t.count;
    return status;
}

/* ---- Words ------------------------------------------------------------------------------------------------------- */

/* clang-format off */
const column shadow_trial_columns[] = {
    {FIELD(shadow_trial, bias, "bias", ""), SHOWN("drawn with", -14, 0)},
    {FIELD(shadow_trial, raster, "raster", "")},
    {FIELD(shadow_trial, planes, "planes", "")},
    {FIELD(shadow_trial, points, "points", ""), SHOWN("points", 10, 0)},
    {FIELD(shadow_trial, acne, "acne", ""), SHOWN("acne", 9, 0)},
    {FIELD(shadow_trial, behind, "behind", ""), SHOWN("behind", 10, 0)},
    {FIELD(shadow_trial, lit, "behind_lit", ""), SHOWN("lit", 8, 0)},
    {FIELD(shadow_trial, within, "within", ""), SHOWN("within", 10, 0)},
    {FIELD(shadow_trial, lost, "within_lit", ""), SHOWN("lit", 8, 0)},
    {FIELD(shadow_trial, file, "file", "")},
    {.kind = COLUMN_END}};
/* clang-format on */

void shadow_say_trial(page *p, const shadow_trial *first) {
    page_note(p, "drawn", "%.0f planes at random slants and depths, by %s, %d x %d points a texel", first->planes,
              first->raster, SHADOW_DRAWN_POINTS, SHADOW_DRAWN_POINTS);
    page_note(p, "behind", "points whose caster is farther than gap and constant bias: lit should none be");
    page_note(p, "within", "points whose caster is nearer than half of the constant bias's gap");
    if (first->file != NULL)
        page_note(p, "", "%s: one plane with each bias in turn; acne is black, lost shadow yellow", first->file);
}
