/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "zfight/cmd_zfight/zfight_triangles.h"
#include "zfight/cmd_zfight/request.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "camera/cmd/each_setup.h"
#include "camera/cmd/raster_setups.h"
#include "camera/cmd/slant.h"
#include "cli/stop.h"
#include "raster/fight.h"
#include "report/sentence.h"

enum { DIGITS = 4, SHARE_DIGITS = 3, PAIRS = 500 };

/* Walks over set-ups alone; below `before`, what belongs to the one at hand. */
typedef struct drawn {
    each_setup each;
    const zfight_request *o;
    draw_fight_result *results; /* one a set-up */
    const char *method;
    uint64_t pairs, seed; /* pairs: of a set-up */
    double azimuth, lo, hi;
    uint64_t before; /* pairs of the set-ups that are finished */
    const draw_fight_result *result;
    draw_fight_band whole, band;
    int band_index;
} drawn;

/* ---- Work -------------------------------------------------------------------------------------------------------- */

static int tick(void *context, uint64_t done) {
    drawn *d = context;
    progress_step(&d->each.progress, d->before + done);
    return stop_asked();
}

static draw_fight_request request_of(drawn *d, const dp_setup *setup, const draw_camera *camera) {
    const zfight_request *o = d->o;
    return (draw_fight_request){.camera = camera,
                                .setup = setup,
                                .azimuth = o->camera.azimuth,
                                .lo = d->lo,
                                .hi = d->hi,
                                .count = o->sample > 0 ? o->sample : PAIRS,
                                .seed = o->seed,
                                .threads = o->out.threads,
                                .progress = tick,
                                .context = d};
}

static int work(drawn *d) {
    for (size_t i = 0; i < d->each.all.count; i++) {
        const dp_setup *setup = &d->each.all.items[i];
        draw_camera camera;
        const raster_status status = draw_camera_init(&camera, d->o->camera.raster, setup);
        if (status != RASTER_OK)
            return option_error("viewport", "%s", raster_status_text(status));
        const draw_fight_request request = request_of(d, setup, &camera);
        const draw_fight_status end = draw_fight(&request, &d->results[i]);
        if (end == DRAW_FIGHT_NO_MEMORY)
            return usage_error("no memory to draw in");
        if (end != DRAW_FIGHT_DONE)
            return EXIT_FAILED;
        d->before += draw_fight_count(&request);
    }
    return EXIT_FINE;
}

/* ---- What is reported -------------------------------------------------------------------------------------------- */

static void *next_band(void *of, size_t index) {
    drawn *d = of;
    d->band_index = index == 0 ? 0 : d->band_index;
    while (d->band_index < d->result->band_count && d->result->bands[d->band_index].pixels == 0)
        d->band_index++;
    if (d->band_index == d->result->band_count)
        return NULL;
    d->band = d->result->bands[d->band_index++];
    return &d->band;
}

static void *next_setup(void *of, size_t i) {
    drawn *d = of;
    if (!each_setup_go(&d->each, i))
        return NULL;
    d->result = &d->results[i];
    d->whole = draw_fight_worst(d->result);
    return d;
}

static const column found_columns[] = {
    {FIELD(draw_fight_band, pixels, "pixels", ""), SHOWN("pixels", 11, 0), .spare = 1},
    {FIELD(draw_fight_band, separation, "separation", "scene"), SHOWN("separation", 11, DIGITS)},
    {FIELD(draw_fight_band, z, "z", "scene"), SHOWN("at", 9, DIGITS)},
    {FIELD(draw_fight_band, slant, "slant", "degrees"), SHOWN("slant", 7, 3)},
    {FIELD(draw_fight_band, guaranteed, "bound", "scene"), SHOWN("guaranteed", 12, DIGITS), .upward = true},
    {FIELD(draw_fight_band, used, "used", ""), .digits = DIGITS},
    {TEXT_FIELD(draw_fight_band, used, "used", 7, SHARE_DIGITS), .fixed = true},
    {.kind = COLUMN_END}};

static const column band_columns[] = {{FIELD(draw_fight_band, lo, "lo", "scene"), SHOWN("from", 9, DIGITS)},
                                      {FIELD(draw_fight_band, hi, "hi", "scene"), SHOWN("to", 9, DIGITS)},
                                      {GROUP(NULL, found_columns)},
                                      {.kind = COLUMN_END}};

/* CSV has a line a band. */
static const column setup_report[] = {{PART(drawn, each.fields, NULL, setup_columns)},
                                      {FIELD(drawn, each.fields.arith, "arith", ""), .only = AS_CSV},
                                      {FIELD(drawn, method, "method", "")},
                                      {FIELD(drawn, each.slant.raster, "raster", ""), .only = AS_CSV},
                                      {FIELD(drawn, seed, "seed", "")},
                                      {FIELD(drawn, pairs, "pairs", "")},
                                      {FIELD(drawn, azimuth, "azimuth", "degrees"), .only = AS_JSON},
                                      {FIELD(drawn, lo, "lo", "scene"), .only = AS_JSON},
                                      {FIELD(drawn, hi, "hi", "scene"), .only = AS_JSON},
                                      {PART(drawn, whole, NULL, found_columns), .only = AS_JSON},
                                      {LIST("bands", band_columns, next_band)},
                                      {.kind = COLUMN_END}};

enum { NOTHING_DRAWN = 1 };

static const sentence words[] = {
    PROSE("Nothing was drawn: no separation is guaranteed in this range, or no triangle fits.", NOTHING_DRAWN),
    ELSE("A pixel was wrong up to {used} of the guarantee.", 0),
    ELSE("No pixel was wrong.", 0),
    LINE("there, at z = {z}: planes {separation} apart, guaranteed {bound}", 0),
    LINE("(wrong: the farther plane is seen; {pairs} pairs of planes drawn, seed {seed})", 0),
    SENTENCE_END};

static void say_answer(page *p, void *item) {
    const drawn *d = item;
    each_setup_title(p, item);
    slant_say(p, page_title, &d->o->camera, d->each.setup);
    page_say(p, words, setup_report, item, d->whole.pixels == 0 ? NOTHING_DRAWN : 0);
}

static const column columns[] = {{PART(drawn, each.slant, "triangles", slant_columns), .only = AS_JSON},
                                 {LIST("setups", setup_report, next_setup), .head = say_answer, .verdict = true},
                                 {.kind = COLUMN_END}};

/* ---- The command ------------------------------------------------------------------------------------------------- */

static int check(drawn *d) {
    const zfight_request *o = d->o;
    int status = raster_setups(&o->camera, &d->each.all);
    if (status == EXIT_FINE)
        status = range_resolve(&o->camera, &d->lo, &d->hi);
    if (status == EXIT_FINE && isinf(d->hi))
        status = option_error("range", "must be given when far is inf");
    if (status == EXIT_FINE && isinf((float)d->hi))
        status = option_error("range", "must end at 3.4028235e+38, the largest binary32 number, at most, got %s",
                              number_full(d->hi).text);
    return status;
}

static int run(drawn *d) {
    const draw_fight_request request = request_of(d, NULL, NULL);
    d->pairs = draw_fight_count(&request);
    stop_watch();
    d->each.progress = progress_start("pairs", d->each.all.count * d->pairs, d->o->out.quiet);
    const int status = work(d);
    progress_end(&d->each.progress);
    stop_end(&d->each.out);
    if (status != EXIT_FINE) {
        output_abandon(&d->each.out);
        return status;
    }
    report_write(&(report_spec){"zfight", columns, d, .when = 0}, &d->each.out, d->o->out.form);
    return output_close(&d->each.out);
}

int zfight_triangles(const zfight_request *o) {
    drawn d = {.o = o,
               .each = {.camera = &o->camera, .how = &o->out},
               .method = "triangles",
               .seed = o->seed,
               .azimuth = o->camera.azimuth};
    int status = check(&d);
    slant_fields_of(&o->camera, &d.each.slant);
    if (status == EXIT_FINE) {
        d.results = calloc(d.each.all.count, sizeof *d.results);
        if (d.results == NULL)
            status = usage_error("no memory for %zu set-ups", d.each.all.count);
    }
    if (status == EXIT_FINE)
        status = output_start(&o->out, &o->camera, &d.each.out);
    if (status == EXIT_FINE)
        status = run(&d);
    free(d.results);
    setups_release(&d.each.all);
    return status;
}
