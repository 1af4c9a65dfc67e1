/* SPDX-License-Identifier: GPL-3.0-or-later */
/* zfight: what fights in the binary32 pipeline, by visiting every depth or, where asked, by a seeded sample. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "camera/cmd/each_setup.h"
#include "camera/cmd/slant.h"
#include "cli/stop.h"
#include "core/engine.h"
#include "quantity/quantity.h"
#include "report/message.h"
#include "report/sentence.h"
#include "zfight/census.h"
#include "zfight/cmd_zfight/request.h"
#include "zfight/cmd_zfight/zfight_triangles.h"

/* A band, or all of them together, and what of it does not exist as NaN. */
typedef struct band {
    census_band counts;
    double ties, swaps; /* percent of the pairs */
    double longest, used, clipped;
    double slanted;         /* what is guaranteed at any slant that is asked for */
    bool certain;           /* anything behind the band's nearest depth is */
    char from[NUMBER_SIZE]; /* of text: "all" below the bands */
} band;

/* A census, which walks over set-ups alone; below `before`, what belongs to the one at hand. */
typedef struct zfight {
    each_setup each;
    const zfight_request *o;
    census_result *results; /* one a set-up */
    const char *method;
    uint64_t seed;
    double gap, lo, hi;
    double always;   /* of the result: from there on every pair fights; NaN: from nowhere on */
    uint64_t before; /* depths of the set-ups that are finished */
    const census_result *result;
    band whole, band;
    double there; /* guaranteed at its longest interval; NaN without one */
    bool certain; /* something behind that is */
    const char *surfaces, *chosen;
    int band_index;
} zfight;

/* ---- Work, and how it is interrupted ----------------------------------------------------------------------------- */

static int tick(void *context, uint64_t done) {
    zfight *z = context;
    progress_step(&z->each.progress, z->before + done);
    return stop_asked();
}

static uint64_t visits(const zfight *z) {
    return z->o->sample > 0 ? z->o->sample : census_count(z->lo, z->hi);
}

static census_status work(zfight *z, const dp_setup *setup, census_result *result) {
    census_sample_request q = {.common = census_of_guarantee(setup, z->lo, z->hi),
                               .count = z->o->sample,
                               .seed = z->o->seed,
                               .gap = z->o->separation};
    q.common.threads = z->o->out.threads;
    q.common.progress = tick;
    q.common.context = z;
    if (z->o->sample > 0 || z->o->separation > 0.0)
        return census_sample(&q, result);
    return census_run(&q.common, result);
}

static int work_all(zfight *z) {
    for (size_t i = 0; i < z->each.all.count; i++) {
        const dp_setup facing = dp_setup_facing(&z->each.all.items[i]);
        const census_status status = work(z, &facing, &z->results[i]);
        if (status == CENSUS_NO_MEMORY)
            return usage_error("no memory for the census");
        if (status != CENSUS_DONE) /* interrupted: what else there is was refused before */
            return EXIT_FAILED;
        z->before += visits(z);
    }
    return EXIT_FINE;
}

/* ---- What is reported -------------------------------------------------------------------------------------------- */

enum { DIGITS = 6, PLANE_DIGITS = 9 };

static double percent(uint64_t part, uint64_t whole) {
    return whole > 0 ? 100.0 * (double)part / (double)whole : 0.0;
}

/* A range that ends on a power of two leaves its last depth alone in a band, and a sample may miss a band. */
static bool is_empty(const census_band *b) {
    return b->pairs == 0;
}

static double slanted_over(const zfight *z, double lo, double hi) {
    return z->each.triangles != NULL
               ? quantity_bound(QUANTITY_SEPARATION, z->each.setup, fmax(lo, z->lo), fmin(hi, z->hi))
               : (double)NAN;
}

static band band_of(const zfight *z, const census_band *b) {
    band out = {.counts = *b,
                .ties = percent(b->ties, b->pairs),
                .swaps = percent(b->swaps, b->pairs),
                .longest = b->longest,
                .used = b->slack,
                .clipped = (double)b->clipped,
                .slanted = slanted_over(z, b->lo, b->hi),
                .certain = each_setup_guarantee(&z->each, b->lo).certain};
    if (z->o->separation > 0.0)
        out.longest = out.used = (double)NAN;
    if (z->o->separation > 0.0 || z->o->sample > 0) /* a sample would only count those that it drew */
        out.clipped = (double)NAN;
    return out;
}

/* The bands that hold a pair, and in text all of them together below. */
static void *next_band(void *of, size_t index) {
    zfight *z = of;
    if (index == 0)
        z->band_index = 0;
    while (z->band_index < z->result->band_count && is_empty(&z->result->bands[z->band_index]))
        z->band_index++;
    const int at = z->band_index++;
    if (at > z->result->band_count || (at == z->result->band_count && z->o->out.form != FORM_TEXT))
        return NULL;
    z->band = band_of(z, at < z->result->band_count ? &z->result->bands[at] : &z->result->all);
    snprintf(z->band.from, sizeof z->band.from, "%s",
             at < z->result->band_count ? number_of(z->band.counts.lo, DIGITS).text : "all");
    return &z->band;
}

/* From where on every pair fights: the depth behind the last that is in order, unless no pair begins there. */
static double always_from(const zfight *z) {
    const double last = z->result->all.last_apart;
    const float from = isnan(last) ? (float)z->lo : nextafterf((float)last, HUGE_VALF);
    return z->gap > 0.0 && (double)(float)((double)from + z->gap) <= z->hi ? (double)from : (double)NAN;
}

static void *next_setup(void *of, size_t i) {
    zfight *z = of;
    if (!each_setup_go(&z->each, i))
        return NULL;
    z->result = &z->results[i];
    z->whole = band_of(z, &z->result->all);
    z->always = always_from(z);
    const guarantee there = each_setup_guarantee(&z->each, z->result->all.longest_z);
    z->there = z->result->all.longest > 0.0 ? there.facing : (double)NAN;
    z->certain = there.certain;
    z->surfaces = z->o->sample > 0 ? "Of the pairs tested, surfaces" : "Surfaces";
    z->chosen = z->o->sample > 0 ? ", chosen at random" : "";
    return z;
}

enum {
    WITH_INTERVALS = 1,
    WITH_CLIPPED = 2,
    WITH_SAMPLE = 4,
    WITH_GAP = 8,
    WITH_TRIANGLES = 16,
    WITH_RANGE = 32,
    CERTAIN = 64 /* of sentences: something behind the longest interval is */
};

static unsigned conditions(const zfight_request *o) {
    return (o->separation > 0.0 ? WITH_GAP : WITH_INTERVALS) | (o->sample > 0 ? WITH_SAMPLE : 0) |
           (o->sample == 0 && o->separation <= 0.0 ? WITH_CLIPPED : 0) |
           (o->camera.triangles.width > 0 ? WITH_TRIANGLES : 0) | (option_given(o->line, "range") ? WITH_RANGE : 0);
}

static const column count_columns[] = {
    {FIELD(band, counts.pairs, "pairs", ""), SHOWN("pairs", 11, 0), .spare = 2},
    {FIELD(band, counts.ties, "ties", "")},
    {FIELD(band, counts.swaps, "swaps", "")},
    {TEXT_FIELD(band, ties, "ties %", 9, 4), .fixed = true},
    {TEXT_FIELD(band, swaps, "swaps %", 9, 4), .fixed = true},
    {FIELD(band, ties, "tie_percent", ""), .digits = 3, .only = AS_TEXT},
    {FIELD(band, swaps, "swap_percent", ""), .digits = 3, .only = AS_TEXT},
    {FIELD(band, longest, "longest", "scene"), .digits = DIGITS},
    {FIELD(band, counts.longest_z, "longest_z", "scene"), .digits = DIGITS},
    {TEXT_FIELD(band, longest, "longest", 12, DIGITS), .when = WITH_INTERVALS},
    {TEXT_FIELD(band, counts.longest_z, "at", 10, DIGITS), .when = WITH_INTERVALS, .spare = 1},
    {FIELD(band, counts.bound, "bound", "scene"), SHOWN("guaranteed", 12, DIGITS), .upward = true},
    GUARANTEES(band, counts.bound, slanted, 12, DIGITS, WITH_TRIANGLES),
    {FIELD(band, used, "used", "")},
    {TEXT_FIELD(band, used, "used", 8, 3), .fixed = true, .when = WITH_INTERVALS, .spare = 1},
    {.kind = COLUMN_END}};

static const column band_columns[] = {{FIELD(band, counts.lo, "lo", "scene")},
                                      {TEXT_FIELD(band, from, "from", 10, 0)},
                                      {FIELD(band, counts.hi, "hi", "scene"), SHOWN("to", 10, DIGITS)},
                                      {GROUP(NULL, count_columns)},
                                      {FIELD(band, clipped, "clipped", ""), .only = AS_CSV},
                                      {FIELD(band, certain, "certain", "")},
                                      {.kind = COLUMN_END}};

static const column plane_columns[] = {
    {FIELD(census_result, near_effective, "near_effective", "scene"), .digits = PLANE_DIGITS, .upward = true},
    {FIELD(census_result, far_effective, "far_effective", "scene"), .digits = PLANE_DIGITS, .downward = true},
    {.kind = COLUMN_END}};

static const column clipped_columns[] = {{FIELD(census_result, all.clipped, "clipped", "")},
                                         {FIELD(census_result, holes, "holes", "")},
                                         {.kind = COLUMN_END}};

/* CSV has a line a band. */
static const column setup_report[] = {
    {PART(zfight, each.fields, NULL, setup_columns)},
    {FIELD(zfight, each.fields.arith, "arith", ""), .only = AS_CSV},
    {FIELD(zfight, method, "method", "")},
    {FIELD(zfight, seed, "seed", ""), .only = AS_CSV},
    {FIELD(zfight, gap, "gap", "scene"), .given = true, .only = AS_CSV},
    {FIELD(zfight, seed, "seed", ""), .only = AS_JSON, .when = WITH_SAMPLE},
    {FIELD(zfight, gap, "gap", "scene"), .only = AS_JSON, .when = WITH_GAP},
    {FIELD(zfight, lo, "lo", "scene"), .given = true, .only = AS_JSON},
    {FIELD(zfight, hi, "hi", "scene"), .given = true, .only = AS_JSON},
    {PART(zfight, whole, NULL, count_columns), .only = AS_JSON},
    {FIELD(zfight, whole.counts.first, "first", "scene"), .digits = DIGITS, .downward = true, .only = AS_JSON,
     .when = WITH_GAP},
    {FIELD(zfight, always, "always_from", "scene"), .digits = DIGITS, .upward = true, .only = AS_JSON,
     .when = WITH_GAP},
    {FIELD(zfight, there, "there", "scene"), .digits = DIGITS, .upward = true, .only = AS_TEXT},
    {PART(zfight, result, NULL, clipped_columns), .only = AS_JSON, .pointed = true, .when = WITH_CLIPPED},
    {PART(zfight, result, NULL, plane_columns), .only = AS_JSON, .pointed = true},
    {LIST("bands", band_columns, next_band)},
    {PART(zfight, result, NULL, plane_columns), .only = AS_CSV, .pointed = true},
    {FIELD(zfight, surfaces, "surfaces", ""), .only = AS_TEXT},
    {FIELD(zfight, chosen, "chosen", ""), .only = AS_TEXT},
    {.kind = COLUMN_END}};

#define LONGEST "longest interval {longest} at z = {longest_z}, guaranteed there {there}"
static const sentence answer_words[] = {
    PROSE("{surfaces} {gap} apart first z-fight at z = {first}, and always from z = {always_from} on.", WITH_GAP),
    ELSE("{surfaces} {gap} apart first z-fight at z = {first}, and at no depth do all of them.", WITH_GAP),
    ELSE("{surfaces} {gap} apart never z-fight from {lo} to {hi}.", WITH_GAP),
    ELSE("Neighbouring binary32 depths{chosen}: {tie_percent} % tie, {swap_percent} % swap. "
         "--separation asks about surfaces.",
         0),
    LINE("(z-fight: they are stored as one code, or in the wrong order)", WITH_GAP),
    LINE(LONGEST, WITH_INTERVALS | CERTAIN),
    ELSE(LONGEST ": nothing behind is certain", WITH_INTERVALS),
    SENTENCE_END};
static const sentence plane_words[] = {
    LINE("the pairs face the camera; --rasterize draws slanted ones", WITH_TRIANGLES),
    LINE("effective clip range within --range: {near_effective} to {far_effective}", WITH_RANGE),
    ELSE("effective clip range: {near_effective} to {far_effective}", 0), ELSE("clipping removes everything", 0),
    SENTENCE_END};

static void say_answer(page *p, void *item) {
    zfight *z = item;
    each_setup_title(p, item);
    slant_say(p, page_title, &z->o->camera, z->each.setup);
    page_say(p, answer_words, setup_report, z, conditions(z->o) | (z->certain ? CERTAIN : 0));
}

static void say_planes(page *p, void *item) {
    const zfight *z = item;
    page_say(p, plane_words, setup_report, item, conditions(z->o));
}

static const column columns[] = {
    {PART(zfight, each.triangles, "triangles", slant_columns), .only = AS_JSON, .pointed = true, .optional = true},
    {LIST("setups", setup_report, next_setup), .head = say_answer, .notes = say_planes, .verdict = true},
    {.kind = COLUMN_END}};

/* ---- The command ------------------------------------------------------------------------------------------------- */

/* Geometry that the user asked about and the hardware would not draw: worth a line, whatever the form of the data. */
static void warn(const zfight *z) {
    for (size_t i = 0; i < z->each.all.count && !z->o->out.quiet; i++) {
        const census_result *r = &z->results[i];
        const double from = r->near_effective, to = r->far_effective;
        char label[SETUP_LABEL_SIZE];
        if (isnan(from) || census_count(from, to) < census_count(z->lo, z->hi))
            clipping_say(&z->each.all.items[i], from, to, r->holes > 0 ? ", with holes" : "");
        else if (r->holes > 0)
            message("depthprec: warning: %s: clipping in binary32 removes %llu depths between %s and %s",
                    setup_label(&z->each.all.items[i], false, label), (unsigned long long)r->holes,
                    number_up(from, PLANE_DIGITS).text, number_down(to, PLANE_DIGITS).text);
    }
}

static int check(zfight *z) {
    const zfight_request *o = z->o;
    int status = setups_make_float(&o->camera, &z->each.all);
    if (status == EXIT_FINE)
        status = range_resolve(&o->camera, &z->lo, &z->hi);
    if (status == EXIT_FINE && isinf(z->hi))
        status = option_error("range", "must be given when far is inf: there are too many depths up to infinity");
    if (status == EXIT_FINE && isinf((float)z->hi))
        status = option_error("range", "must end at 3.4028235e+38, the largest binary32 number, at most, got %s",
                              number_full(z->hi).text);
    if (status == EXIT_FINE && census_count(z->lo, z->hi) < 2)
        status = option_error("range", "must hold at least two binary32 depths");
    if (status == EXIT_FINE && o->separation >= z->hi - z->lo)
        status = option_error("separation", "must be less than the range is wide");
    return status;
}

static int run(zfight *z) {
    stop_watch();
    z->each.progress = progress_start("depths", z->each.all.count * visits(z), z->o->out.quiet);
    int status = work_all(z);
    progress_end(&z->each.progress);
    stop_end(&z->each.out);
    if (status != EXIT_FINE) {
        output_abandon(&z->each.out);
        return status;
    }
    report_write(&(report_spec){"zfight", columns, z, .when = conditions(z->o)}, &z->each.out, z->o->out.form);
    warn(z);
    return output_close(&z->each.out);
}

int cmd_zfight(void *request) {
    const zfight_request *o = request;
    if (o->drawn)
        return zfight_triangles(o);
    if (!isnan(o->camera.azimuth))
        return option_error("slant", "must be LO:HI without --rasterize, got '%s'", option_text(o->line, "slant"));
    zfight z = {.o = o,
                .each = {.camera = &o->camera, .how = &o->out},
                .method = o->sample > 0 ? "sample" : "census",
                .seed = o->seed,
                .gap = o->separation};
    z.each.triangles = slant_fields_of(&o->camera, &z.each.slant);
    int status = check(&z);
    if (status == EXIT_FINE) {
        z.results = calloc(z.each.all.count, sizeof *z.results);
        if (z.results == NULL)
            status = usage_error("no memory for %zu set-ups", z.each.all.count);
    }
    if (status == EXIT_FINE)
        status = output_start(&o->out, &o->camera, &z.each.out);
    if (status == EXIT_FINE)
        status = run(&z);
    free(z.results);
    setups_release(&z.each.all);
    return status;
}
