/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/texture_report.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/progress.h"
#include "cli/setups.h"
#include "report/csv.h"
#include "report/json.h"
#include "report/number.h"

static const char *number(double value, int digits, char out[NUMBER_SIZE]) {
    if (isnan(value))
        strcpy(out, "-");
    else
        number_digits(value, digits, out);
    return out;
}

static double share(uint64_t part, uint64_t all) {
    return all > 0 ? 100.0 * (double)part / (double)all : 0;
}

/* How the samples were rounded, where they are coarser than the buffer's codes. */
static void write_grain(const texture_report *r, output *out) {
    const grain *g = &r->source->grain;
    char steps[NUMBER_SIZE];
    const char *by = g->rounding == GRAIN_ANY       ? "rounded or cut off"
                     : g->rounding == GRAIN_NEAREST ? "rounded to nearest"
                                                    : "cut off";
    if (g->kind == GRAIN_STEPS)
        output_format(out, "  samples       steps of 1/%s%s, %s: counted in what depths can be off by\n",
                      number(g->steps, 9, steps),
                      texture_coarser(r->source)               ? ", coarser than the format"
                      : r->source->format_from == ORIGIN_GIVEN ? ""
                                                               : ", of a buffer that may be finer",
                      by);
    else if (g->kind == GRAIN_FLOATS && g->bits == 11)
        output_format(out, "  samples       of %d significant bits, %s: counted in what depths can be off by\n",
                      g->bits, by);
}

static void write_readings(const texture_source *s, output *out) {
    char z[NUMBER_SIZE];
    for (size_t i = 0; i < s->reading_count; i++) {
        const texture_reading *reading = &s->readings[i];
        if (i > 0 && strcmp(s->readings[i - 1].what, reading->what) == 0)
            output_format(out, ", %s as %s", number(reading->z, 6, z), reading->name);
        else
            output_format(out, "%s  pixel         %u,%u is at z = %s as %s", i > 0 ? "\n" : "", s->column, s->row,
                          number(reading->z, 6, z), reading->name);
    }
    if (s->reading_count > 0)
        output_char(out, '\n');
}

static void write_origins(const texture_report *r, output *out) {
    const texture_source *s = r->source;
    const char *tells = s->path != NULL ? ": --mapping tells" : "";
    if (s->path != NULL)
        output_format(out, "  recognised    %s\n", s->found.why);
    output_format(out, "  format        %s %s", s->setup.spec.format.name, texture_origin_name(s->format_from));
    if (s->path != NULL && s->found.depth && strcmp(s->found.format.name, s->setup.spec.format.name) != 0)
        output_format(out, ": the nearest codes are taken of what looks like %s", s->found.format.name);
    output_char(out, '\n');
    if (s->path != NULL)
        write_grain(r, out);
    output_format(out, "  mapping       %s %s%s\n", dp_mapping_get(s->setup.spec.mapping)->name,
                  texture_origin_name(s->mapping_from), s->mapping_from == ORIGIN_ASSUMED ? tells : "");
    if (s->path != NULL && s->direction_from != ORIGIN_GIVEN)
        output_format(out, "  direction     %s %s\n", s->setup.reversed ? "reversed" : "not reversed",
                      texture_origin_name(s->direction_from));
    write_readings(s, out);
}

static void write_metric(const texture_report *r, output *out) {
    const texture_source *s = r->source;
    char scale[NUMBER_SIZE], step[NUMBER_SIZE], far[NUMBER_SIZE];
    output_format(out, "metric depth, %s scene units a unit, up to %s\n", number(r->o->metric, 6, scale),
                  number(s->metric.zfar, 6, far));
    if (s->metric.step > 0)
        output_format(out, "  samples       steps of %s scene units, rounded or cut off\n",
                      number(s->metric.step, 6, step));
    else
        output_format(out, "  samples       numbers of %d significant bits, rounded or cut off\n", s->grain.bits);
}

static void write_head(const texture_report *r, output *out) {
    const texture_source *s = r->source;
    char label[SETUP_LABEL_SIZE], value[NUMBER_SIZE];
    if (s->path != NULL) {
        output_format(out, "%s: %u x %u pixels, %s of %s, %u channel%s\n", s->path, s->camera.width, s->camera.height,
                      image_file_name(s->picture.file), image_type_name(s->type), s->channels,
                      s->channels == 1 ? "" : "s, the first is read");
    } else {
        output_format(out, "scene %s: %u x %u pixels", s->frame.scene->name, s->camera.width, s->camera.height);
        for (size_t i = 0; i < SCENE_PARAMETERS && s->frame.scene->parameters[i].name != NULL; i++)
            output_format(out, "%s%s %s", i > 0 ? ", " : "; ", s->frame.scene->parameters[i].name,
                          number(s->parameters[i], 6, value));
        output_char(out, '\n');
    }
    if (r->o->metric > 0) {
        write_metric(r, out);
    } else {
        output_format(out, "%s\n", setup_label(&s->setup, true, label));
        write_origins(r, out);
    }
}

static void write_sky(const texture_report *r, output *out) {
    const survey *v = &r->survey;
    const uint64_t hidden = v->sky - v->true_sky;
    char from[NUMBER_SIZE], limit[NUMBER_SIZE], percent[NUMBER_SIZE];
    if (r->o->metric == 0)
        output_format(out,
                      "  sky           %llu pixels, %s %%; depths from %s on are within %s of far and count as sky\n",
                      (unsigned long long)v->sky, number(share(v->sky, v->pixels), 3, percent),
                      number(v->sky_from, 6, from), number(r->o->sky, 3, limit));
    if (r->source->path == NULL && hidden > 0)
        output_format(out, "  hidden        %llu pixels of the scene count as sky\n", (unsigned long long)hidden);
    if (v->invalid > 0)
        output_format(out, "  holes         %llu pixels, %s %%, hold no depth\n", (unsigned long long)v->invalid,
                      number(share(v->invalid, v->pixels), 3, percent));
}

static void write_bands(const survey *v, output *out) {
    char lo[NUMBER_SIZE], hi[NUMBER_SIZE], gap[NUMBER_SIZE], z[NUMBER_SIZE], interval[NUMBER_SIZE];
    if (v->band_count == 0) {
        output_text(out, "  depths        none\n");
        return;
    }
    output_format(out, "  depths        %s to %s, %llu different codes\n", number(v->lo, 8, lo), number(v->hi, 8, hi),
                  (unsigned long long)v->codes);
    output_format(out, "%12s%12s%11s%10s%11s%13s%10s%12s%13s\n", "from", "to", "pixels", "codes", "available",
                  "nearest gap", "at z", "steps", "interval");
    for (size_t i = 0; i < v->band_count; i++) {
        const survey_band *b = &v->bands[i];
        char steps[24] = "-";
        if (b->steps > 0)
            snprintf(steps, sizeof steps, "%llu", (unsigned long long)b->steps);
        output_format(out, "%12s%12s%11llu%10llu%11llu%13s%10s%12s%13s\n", number(b->lo, 6, lo), number(b->hi, 6, hi),
                      (unsigned long long)b->pixels, (unsigned long long)b->codes, (unsigned long long)b->available,
                      number(b->gap, 6, gap), number(b->gap_z, 6, z), steps, number(b->interval, 6, interval));
    }
}

static void write_pairs(const survey_pairs *p, output *out) {
    char first[NUMBER_SIZE], certain[NUMBER_SIZE];
    output_format(out, "  pairs         %llu of surfaces that ought to be told apart: %llu fight, stored as one code",
                  (unsigned long long)p->pairs, (unsigned long long)p->ties);
    if (p->ties > 0)
        output_format(out, ", the first at z = %s", number(p->first_tie, 6, first));
    output_format(out, "\n                %llu are nearer than the separation", (unsigned long long)p->possible);
    if (!isnan(p->certain_to))
        output_format(out, "; certain of two codes up to z = %s", number(p->certain_to, 6, certain));
    output_char(out, '\n');
}

static void write_condition(const texture_report *r, output *out) {
    char value[NUMBER_SIZE];
    if (!isnan(r->condition))
        output_format(out, "  condition     %s, of the view-projection matrix\n", number(r->condition, 4, value));
}

static void write_errors(const texture_report *r, output *out) {
    char mean[NUMBER_SIZE], p99[NUMBER_SIZE], most[NUMBER_SIZE];
    if (r->error_count > 0)
        output_format(out, "  %-24s%12s%12s%12s  %s\n", r->source->path != NULL ? "can be off by" : "is off by", "mean",
                      "99 %", "at most", "at pixel");
    for (size_t i = 0; i < r->error_count; i++) {
        const texture_errors *e = &r->errors[i];
        output_format(out, "  %-24s%12s%12s%12s  %u,%u (%s)\n", e->name, number(e->sum.mean, 4, mean),
                      number(e->sum.p99, 4, p99), number(e->sum.hi, 4, most), e->sum.hi_column, e->sum.hi_row, e->unit);
    }
}

static void write_text(const texture_report *r, output *out) {
    write_head(r, out);
    write_sky(r, out);
    write_bands(&r->survey, out);
    if (r->has_pairs)
        write_pairs(&r->pairs, out);
    write_condition(r, out);
    write_errors(r, out);
}

/* The window depth between two samples, in steps to 1, or their significant bits. */
static void json_grain(const texture_report *r, json *j) {
    const texture_source *s = r->source;
    const bool eyes = r->o->metric > 0;
    json_number(j, "metric", eyes ? r->o->metric : (double)NAN);
    json_object(j, "samples");
    json_number(j, "step", eyes && s->metric.step > 0 ? s->metric.step : (double)NAN);
    json_number(j, "steps", !eyes && s->grain.kind == GRAIN_STEPS ? s->grain.steps : (double)NAN);
    if (s->grain.kind == GRAIN_FLOATS)
        json_integer(j, "bits", (uint64_t)s->grain.bits);
    else
        json_null(j, "bits");
    json_bool(j, "coarser", !eyes && texture_coarser(s));
    json_string(j, "rounded", s->grain.kind == GRAIN_CODES ? NULL : grain_rounding_name(s->grain.rounding));
    json_end(j);
}

static void json_source(const texture_report *r, json *j) {
    const texture_source *s = r->source;
    json_string(j, "file", s->path);
    json_string(j, "scene", s->path == NULL ? s->frame.scene->name : NULL);
    json_array(j, "parameters");
    for (size_t i = 0; i < SCENE_PARAMETERS && s->path == NULL && s->frame.scene->parameters[i].name != NULL; i++) {
        json_object(j, NULL);
        json_string(j, "name", s->frame.scene->parameters[i].name);
        json_number(j, "value", s->parameters[i]);
        json_end(j);
    }
    json_end(j);
    json_integer(j, "width", s->camera.width);
    json_integer(j, "height", s->camera.height);
    if (s->path != NULL) {
        json_string(j, "type", image_type_name(s->type));
        json_integer(j, "channels", s->channels);
        json_grain(r, j);
    }
    if (s->path != NULL && r->o->metric == 0) {
        json_object(j, "recognised");
        json_string(j, "format", s->found.depth ? s->found.format.name : NULL);
        json_bool(j, "certain", s->found.certain);
        if (s->found.direction)
            json_bool(j, "reversed", s->found.reversed == 1);
        else
            json_null(j, "reversed");
        json_string(j, "why", s->found.why);
        json_end(j);
    }
    setup_json(j, &s->setup);
    json_string(j, "format_from", texture_origin_name(s->format_from));
    json_string(j, "mapping_from", texture_origin_name(s->mapping_from));
    json_string(j, "direction_from", texture_origin_name(s->direction_from));
    json_array(j, "readings");
    for (size_t i = 0; i < s->reading_count; i++) {
        json_object(j, NULL);
        json_string(j, "what", s->readings[i].what);
        json_string(j, "name", s->readings[i].name);
        json_integer(j, "column", s->column);
        json_integer(j, "row", s->row);
        json_number(j, "z", s->readings[i].z);
        json_end(j);
    }
    json_end(j);
    json_number(j, "fov", s->camera.ortho ? (double)NAN : r->o->camera.fov_y);
    json_number(j, "half_height", s->camera.ortho ? r->o->camera.half_height : (double)NAN);
}

static void json_survey(const texture_report *r, json *j) {
    const survey *v = &r->survey;
    json_integer(j, "pixels", v->pixels);
    json_integer(j, "invalid", v->invalid);
    json_object(j, "sky");
    json_integer(j, "pixels", v->sky);
    json_number(j, "limit", r->o->sky);
    json_number(j, "from", v->sky_from);
    if (r->source->path == NULL)
        json_integer(j, "hidden", v->sky - v->true_sky);
    json_end(j);
    json_number(j, "lo", v->lo);
    json_number(j, "hi", v->hi);
    json_integer(j, "codes", v->codes);
    json_array(j, "bands");
    for (size_t i = 0; i < v->band_count; i++) {
        const survey_band *b = &v->bands[i];
        json_object(j, NULL);
        json_number(j, "lo", b->lo);
        json_number(j, "hi", b->hi);
        json_integer(j, "pixels", b->pixels);
        json_integer(j, "codes", b->codes);
        json_integer(j, "available", b->available);
        json_number(j, "gap", b->gap);
        json_number(j, "gap_z", b->gap_z);
        json_integer(j, "steps", b->steps);
        json_number(j, "interval", b->interval);
        json_end(j);
    }
    json_end(j);
}

static void write_json(const texture_report *r, output *out) {
    json j = json_start(out, "texture");
    json_source(r, &j);
    json_survey(r, &j);
    if (r->has_pairs) {
        json_object(&j, "pairs");
        json_integer(&j, "count", r->pairs.pairs);
        json_integer(&j, "ties", r->pairs.ties);
        json_integer(&j, "possible", r->pairs.possible);
        json_number(&j, "first_tie", r->pairs.first_tie);
        json_number(&j, "certain_to", r->pairs.certain_to);
        json_end(&j);
    } else {
        json_null(&j, "pairs");
    }
    json_number(&j, "condition", r->condition);
    json_string(&j, "truth", r->source->path == NULL ? "scene" : NULL);
    json_array(&j, "errors");
    for (size_t i = 0; i < r->error_count; i++) {
        const texture_errors *e = &r->errors[i];
        json_object(&j, NULL);
        json_string(&j, "name", e->name);
        json_string(&j, "unit", e->unit);
        json_integer(&j, "pixels", e->sum.count);
        json_integer(&j, "unbounded", e->sum.infinite);
        json_integer(&j, "masked", r->survey.pixels - e->sum.count - e->sum.infinite);
        json_number(&j, "mean", e->sum.mean);
        json_number(&j, "p99", e->sum.p99);
        json_number(&j, "max", e->sum.count > 0 ? e->sum.hi : (double)NAN);
        json_integer(&j, "column", e->sum.hi_column);
        json_integer(&j, "row", e->sum.hi_row);
        json_end(&j);
    }
    json_finish(&j);
}

static void write_csv(const texture_report *r, output *out) {
    static const char *const heads[] = {"from [scene]", "to [scene]",    "pixels", "codes",           "available",
                                        "gap [scene]",  "gap_z [scene]", "steps",  "interval [scene]"};
    csv c = csv_start(out);
    setup_csv_head(&c);
    for (size_t i = 0; i < sizeof heads / sizeof heads[0]; i++)
        csv_string(&c, heads[i]);
    csv_end(&c);
    for (size_t i = 0; i < r->survey.band_count; i++) {
        const survey_band *b = &r->survey.bands[i];
        setup_csv(&c, &r->source->setup);
        csv_number(&c, b->lo);
        csv_number(&c, b->hi);
        csv_integer(&c, b->pixels);
        csv_integer(&c, b->codes);
        csv_integer(&c, b->available);
        csv_number(&c, b->gap);
        csv_number(&c, b->gap_z);
        csv_integer(&c, b->steps);
        csv_number(&c, b->interval);
        csv_end(&c);
    }
}

static bool add_error(texture_report *r, const char *what, const char *method, const char *unit,
                      const frame_product *product) {
    if (r->error_count == REPORT_ERRORS_MAX || frame_refuses(&r->source->frame, product) != NULL)
        return true;
    texture_errors *e = &r->errors[r->error_count++];
    snprintf(e->name, sizeof e->name, "%s%s%s", what, *method != '\0' ? " " : "", method);
    e->unit = unit;
    return frame_summarise(&r->source->frame, product, &e->sum);
}

/* What a decoding in binary32 adds to what is stored: relative, over the pixels that are not sky. */
static bool add_decoding(texture_report *r, const decode_row *row) {
    const frame *f = &r->source->frame;
    const dp_setup *setup = &r->source->setup;
    const uint32_t width = f->camera->width, sky = frame_sky_rank(f);
    if (r->error_count == REPORT_ERRORS_MAX || f->metric || !decode_applies(row, setup))
        return true;
    uint32_t *codes = calloc(width, sizeof *codes);
    float *d = calloc(width, sizeof *d), *got = calloc(width, sizeof *got);
    const bool good = codes != NULL && d != NULL && got != NULL;
    texture_errors *e = &r->errors[r->error_count++];
    snprintf(e->name, sizeof e->name, "decode %s", row->name);
    e->unit = "relative";
    e->sum = (frame_summary){.lo = INFINITY, .p99 = NAN};
    for (uint32_t y = 0; good && y < f->camera->height; y++) {
        frame_codes(f, y, codes);
        for (uint32_t x = 0; x < width; x++)
            d[x] = codes[x] == UINT32_MAX ? NAN : (float)dp_format_value(&setup->spec.format, codes[x]);
        decode_run(row, setup, d, got, width);
        for (uint32_t x = 0; x < width; x++) {
            if (codes[x] == UINT32_MAX || frame_rank(setup, codes[x]) >= sky)
                continue;
            const double want = decode_exact(setup, row->quantity, (double)d[x]);
            const double off = want == (double)got[x] ? 0 : fabs((double)got[x] - want) / fabs(want);
            if (!isfinite(off)) {
                e->sum.infinite++;
                continue;
            }
            e->sum.count++;
            e->sum.mean += off;
            e->sum.lo = fmin(e->sum.lo, off);
            if (off > e->sum.hi || e->sum.count == 1) {
                e->sum.hi = off;
                e->sum.hi_column = x;
                e->sum.hi_row = y;
            }
        }
    }
    e->sum.mean = e->sum.count > 0 ? e->sum.mean / (double)e->sum.count : (double)NAN;
    e->sum.hi = e->sum.count > 0 ? e->sum.hi : (double)NAN;
    free(codes);
    free(d);
    free(got);
    return good;
}

/* How often the pixels are visited: once for the survey, and once for each product that is measured. */
static uint64_t passes(const texture_report *r) {
    uint64_t count = 2;
    for (size_t i = 0; r->source->path == NULL && position_get(i) != NULL; i++)
        count++;
    for (size_t i = 0; r->source->path == NULL && normal_get(i) != NULL; i++)
        count++;
    return count;
}

/* Of an image what is certain without looking any further; a scene tells the truth about everything. */
static bool measure(texture_report *r, progress *bar) {
    frame_product p = {.kind = FRAME_EYE, .error = true};
    uint64_t done = 1;
    progress_step(bar, done);
    bool good = add_error(r, "eye depth", "", "scene units", &p);
    progress_step(bar, ++done);
    for (size_t i = 0; good && decode_get(i) != NULL; i++)
        good = add_decoding(r, decode_get(i));
    if (r->source->path != NULL)
        return good;
    p.kind = FRAME_POSITION;
    for (size_t i = 0; good && (p.position = position_get(i)) != NULL; i++) {
        good = add_error(r, "position", p.position->name, "scene units", &p);
        progress_step(bar, ++done);
    }
    p.kind = FRAME_NORMAL;
    for (size_t i = 0; good && (p.normal = normal_get(i)) != NULL; i++) {
        good = add_error(r, "normal", p.normal->name, "degrees", &p);
        progress_step(bar, ++done);
    }
    return good;
}

int texture_report_write(const options *o, const texture_source *source) {
    static void (*const writers[])(const texture_report *, output *) = {
        [FORM_TEXT] = write_text, [FORM_JSON] = write_json, [FORM_CSV] = write_csv};
    output out;
    texture_report *r = calloc(1, sizeof *r);
    int status = r == NULL ? usage_error("texture: no memory") : output_open(&out, o->output);
    if (status == EXIT_FINE) {
        r->o = o;
        r->source = source;
        r->condition = position_condition(&source->camera);
        progress bar = progress_start("passes", passes(r), o->quiet);
        const bool good = survey_make(&source->frame, &r->survey) && measure(r, &bar);
        progress_end(&bar);
        if (good) {
            r->has_pairs = survey_pairs_make(&source->frame, &r->pairs);
            writers[o->form](r, &out);
            status = output_close(&out);
        } else {
            output_abandon(&out);
            status = usage_error("texture: no memory for the statistics");
        }
    }
    free(r);
    return status;
}
