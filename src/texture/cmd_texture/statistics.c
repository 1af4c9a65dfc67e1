/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An image in text. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "core/append.h"
#include "report/number.h"
#include "texture/cmd_texture/request.h"
#include "texture/cmd_texture/statistics.h"

void *statistics_next_parameter(void *of, size_t i) {
    statistics *r = of;
    const synthetic_row *synthetic = r->source.frame.synthetic;
    if (statistics_of_image(r) || synthetic->parameters[i].name == NULL)
        return NULL;
    r->parameter = synthetic->parameters[i].name;
    r->parameter_value = r->source.parameters[i];
    return r;
}

/* How the samples were rounded, where they are coarser than the buffer's codes. */
static void say_grain(const statistics *r, page *p) {
    const grain *g = &r->source.grain;
    const char *by = g->rounding == GRAIN_ANY       ? "rounded or truncated"
                     : g->rounding == GRAIN_NEAREST ? "rounded to nearest"
                                                    : "truncated";
    char other[64] = "";
    if (g->whole > 0)
        snprintf(other, sizeof other, ", or of 1/%s shifted up", number_of(g->whole, 9).text);
    if (g->kind == GRAIN_STEPS)
        page_note(p, "samples", "steps of 1/%s%s%s, %s: included in the error bounds", number_of(g->steps, 9).text,
                  other,
                  r->named.coarser                        ? ", coarser than the format"
                  : r->source.format_from == ORIGIN_GIVEN ? ""
                                                          : ", of a buffer that may be finer",
                  by);
    else if (g->kind == GRAIN_FLOATS && g->bits == 11)
        page_note(p, "samples", "of %d significant bits, %s: included in the error bounds", g->bits, by);
}

static void say_origins(const statistics *r, page *p) {
    const texture_source *s = &r->source;
    const char *name = s->setup.spec.format.name;
    char readings[READINGS_SIZE];
    const bool other = statistics_of_image(r) && s->found.depth && strcmp(s->found.format.name, name) != 0;
    if (statistics_of_image(r))
        page_note(p, "recognised", "%s", s->why);
    if (statistics_of_image(r) && s->picture.lossy != NULL)
        page_note(p, "compression", "%s, which may have changed the depths: no error here counts that",
                  s->picture.lossy);
    page_note(p, "format", "%s %s%s%s", name, r->named.format_from,
              other ? ": the nearest codes are taken of what looks like " : "", other ? s->found.format.name : "");
    if (statistics_of_image(r))
        say_grain(r, p);
    page_note(p, "mapping", "%s %s%s", r->setup.mapping, r->named.mapping_from,
              statistics_of_image(r) && s->mapping_from == ORIGIN_ASSUMED ? ": --mapping sets it" : "");
    if (statistics_of_image(r) && s->direction_from != ORIGIN_GIVEN)
        page_note(p, "direction", "%s %s%s", s->setup.reversed ? "reversed" : "not reversed", r->named.direction_from,
                  s->found.reversed >= 0 && s->setup.spec.ortho ? ": orthographic images do not show it" : "");
    for (const char *const *what = (const char *const[]){"mapping", "format", NULL}; *what != NULL; what++)
        if (*texture_readings_of(s, *what, readings) != '\0')
            page_note(p, "pixel", "%s", readings);
}

static number_text in_scene(const page *p, double length) {
    return number_in(number_of(length, 6), p->unit != NULL ? p->unit : "scene units");
}

static const char *origin_of(const sensor *s) {
    return texture_origin_name(s->given ? ORIGIN_GIVEN : s->found ? ORIGIN_FOUND : ORIGIN_ASSUMED);
}

void statistics_name_lattice(statistics *r) {
    const sensor *s = &r->source.metric.sensor;
    r->lattice = (lattice_fields){.name = s->row->name,
                                  .from = origin_of(s),
                                  .other = s->other != NULL ? s->other->name : NULL,
                                  .like = s->like,
                                  .step = s->step,
                                  .step_error = s->step_off,
                                  .offset = s->offset,
                                  .offset_error = s->offset_off,
                                  .before = s->again > 0 ? s->again : (double)NAN,
                                  .constant = s->row->levels == GRAIN_INVERSE ? 1 / s->step : (double)NAN,
                                  .levels = s->levels,
                                  .bits = s->bits,
                                  .off_pixels = s->off_pixels,
                                  .residual = s->residual};
    if (!r->source.camera.radial && sensor_buffer_find(s, r->survey.lo, r->survey.hi, &r->buffer))
        r->named.buffer = &r->buffer;
}

void *statistics_next_gap(void *of, size_t i) {
    static const double at[] = {1, 2, 5, 10};
    statistics *r = of;
    if (i == sizeof at / sizeof at[0])
        return NULL;
    r->gap = (lattice_gap){at[i], sensor_gap(&r->source.metric.sensor, at[i])};
    return r;
}

/* The levels: how far apart, with what that is off by, and what else is known of them. */
static void say_levels(statistics *r, page *p) {
    const sensor *s = &r->source.metric.sensor;
    const sensor_buffer *b = r->named.buffer;
    char gaps[256] = "";
    char off[64] = "";
    if (s->step_off > 0)
        snprintf(off, sizeof off, ", off by at most %s", number_up(s->step_off, 2).text);
    if (s->row->levels == GRAIN_INVERSE)
        page_note(p, "", "1/z in steps of %s%s; baseline times focal length over a step %s", number_of(s->step, 6).text,
                  off, number_of(1 / s->step, 6).text);
    else if (s->row->levels == GRAIN_EVEN)
        page_note(p, "", "z in steps of %s%s", in_scene(p, s->step).text, off);
    for (size_t i = 0; statistics_next_gap(r, i) != NULL; i++)
        append(gaps, sizeof gaps, "%s%s at %s", i > 0 ? ", " : "", number_of(r->gap.gap, 4).text,
               number_of(r->gap.z, 4).text);
    page_note(p, "", "%s levels, apart by %s", number_of(s->levels, 9).text, gaps);
    if (s->off_pixels > 0)
        page_note(p, "", "%s pixels are on none: interpolated, or of something else", number_of(s->off_pixels, 9).text);
    if (s->like != NULL)
        page_note(p, "", "such as %s", s->like);
    if (b != NULL)
        page_note(p, "", "such as a depth buffer of %d bits, near %s, far %s", b->bits,
                  number_in(number_of(b->znear, 6), p->unit).text, number_in(number_of(b->zfar, 6), p->unit).text);
}

/* Says how samples become depths. */
static void say_stereo(const statistics *r, page *p) {
    const stereo_spec *s = &r->stereo;
    char offset[NUMBER_SIZE + 8] = "";
    if (s->offset != 0)
        snprintf(offset, sizeof offset, "%s %c ", number_of(s->offset, 9).text, s->step < 0 ? '-' : '+');
    page_text(p, "disparity: %s%s x sample pixels; focal length %s pixels, baseline %s", offset,
              number_of(s->offset != 0 ? fabs(s->step) : s->step, 9).text, number_of(s->focal, 9).text,
              in_scene(p, s->baseline).text);
}

static void say_units(const statistics *r, page *p) {
    const metric *m = &r->source.metric;
    page_text(p, "metric depth%s, samples in units of %s, up to %s",
              r->source.metric_from == ORIGIN_ASSUMED ? " assumed" : "", in_scene(p, r->o->image.metric).text,
              in_scene(p, m->zfar).text);
}

static void say_metric(statistics *r, page *p) {
    const metric *m = &r->source.metric;
    const sensor *s = &m->sensor;
    (r->stereo.focal > 0 ? say_stereo : say_units)(r, p);
    if (m->step > 0)
        page_note(p, "samples", "steps of %s, rounded or truncated",
                  r->stereo.focal > 0 ? number_in(number_of(m->step, 9), m->step == 1 ? "pixel" : "pixels").text
                                      : in_scene(p, m->step).text);
    else
        page_note(p, "samples", "numbers of %d significant bits, rounded or truncated", r->source.grain.bits);
    const moved_row *const undone = r->o->image.moved, *const shown = r->source.moved.row;
    if (undone != NULL || shown != NULL)
        page_note(p, "bits", "%s%s", shown == NULL || r->source.moved.certain ? "" : "it may be that ",
                  undone != NULL ? undone->note : shown->note);
    if (s->again > 0)
        page_note(p, "before", "the levels were rounded to steps of %s%s, which every error counts",
                  number_in(number_of(s->again, 4), p->unit != NULL ? p->unit : "scene units").text,
                  s->again_seen ? "" : " at most");
    page_note(p, "lattice", "%s %s%s%s%s%s", s->row->name, origin_of(s), s->given ? "" : ": ",
              s->given ? "" : s->row->note, s->other != NULL ? "; as well explained by " : "",
              s->other != NULL ? s->other->name : "");
    if (s->row->levels != GRAIN_FINE)
        say_levels(r, p);
    if (r->source.camera.radial)
        page_note(p, "radial", "lattice and bands are of distances along the rays, up to %s z; all else is of z",
                  number_of(r->named.radial, 6).text);
}

static void say_source(statistics *r, page *p) {
    const texture_source *s = &r->source;
    char parameters[512] = "";
    char packed[48] = "";
    char channels[IMAGE_NAMES_SIZE + 16];
    p->unit = camera_unit(&r->o->camera);
    if (r->o->image.packing != NULL)
        snprintf(packed, sizeof packed, ", packed as %s", r->o->image.packing->name);
    else if (s->channels > 1 && r->named.channel == NULL)
        snprintf(packed, sizeof packed, ", the first is read");
    if (r->named.channel != NULL)
        snprintf(channels, sizeof channels, "channel %s", r->named.channel);
    else
        snprintf(channels, sizeof channels, "%u channel%s", s->channels, s->channels == 1 ? "" : "s");
    for (size_t i = 0; statistics_next_parameter(r, i) != NULL; i++)
        append(parameters, sizeof parameters, "%s %s %s", i > 0 ? "," : ";", r->parameter,
               number_of(r->parameter_value, 6).text);
    if (statistics_of_image(r))
        page_text(p, "%s: %u x %u pixels, %s of %s, %s%s", s->path, s->camera.width, s->camera.height,
                  image_file_name(s->picture.file), r->named.type, channels, packed);
    else
        page_text(p, "synthetic %s: %u x %u pixels%s", r->named.synthetic, s->camera.width, s->camera.height,
                  parameters);
    if (r->o->image.metric > 0) {
        say_metric(r, p);
    } else {
        setup_title(p, &s->setup, &r->setup);
        if (s->matrix.path != NULL)
            texture_matrix_say(&s->matrix, p);
        say_origins(r, p);
    }
}

static number_text share(uint64_t part, uint64_t all) {
    return number_of(all > 0 ? 100.0 * (double)part / (double)all : 0, 3);
}

void statistics_say_head(page *p, void *item) {
    statistics *r = item;
    const survey *v = &r->survey;
    const texture_camera *s = &r->source.camera;
    const double top = r->source.metric.top;
    char zeros[READINGS_SIZE];
    say_source(r, p);
    if (s->oblique.on)
        page_note(p, "sky", "%llu pixels, %s %%, within %s of the far end of window depth", (unsigned long long)v->sky,
                  share(v->sky, v->pixels).text, number_of(r->o->image.sky, 3).text);
    else if (r->o->image.metric == 0)
        page_note(p, "sky", "%llu pixels, %s %%; depths from %s on are within %s of far and count as sky",
                  (unsigned long long)v->sky, share(v->sky, v->pixels).text,
                  number_in(number_of(v->sky_from, 6), p->unit).text, number_of(r->o->image.sky, 3).text);
    if (!statistics_of_image(r) && r->named.hidden > 0)
        page_note(p, "hidden", "%llu pixels of the synthetic image count as sky", (unsigned long long)r->named.hidden);
    if (r->source.unpacked.zeros > 0)
        page_note(p, "zeros", "%s", texture_zeros_of(r->o, &r->source, zeros));
    if (v->invalid > 0)
        page_note(p, "holes", "%llu pixels, %s %%, hold no depth%s%s%s", (unsigned long long)v->invalid,
                  share(v->invalid, v->pixels).text, top > 0 ? "; " : "", top > 0 ? number_of(top, 9).text : "",
                  top > 0 ? " counts as none, far beyond all others" : "");
    if (isnan(v->lo))
        page_note(p, "depths", "none");
    else
        page_note(p, "depths", "%s to %s, %llu distinct code%s", number_in(number_of(v->lo, 8), p->unit).text,
                  number_in(number_of(v->hi, 8), p->unit).text, (unsigned long long)v->codes, v->codes == 1 ? "" : "s");
}

static void say_pairs(const survey_pairs *s, page *p) {
    char first[NUMBER_SIZE + 32] = "", certain[NUMBER_SIZE + 48] = "";
    if (s->ties > 0)
        snprintf(first, sizeof first, ", the first at z = %s", number_in(number_down(s->first_tie, 6), p->unit).text);
    if (!isnan(s->certain_to))
        snprintf(certain, sizeof certain, "; none z-fight up to z = %s",
                 number_in(number_down(s->certain_to, 6), p->unit).text);
    page_note(p, "pairs", "%llu to be resolved: %llu z-fight, stored as one code%s", (unsigned long long)s->pairs,
              (unsigned long long)s->ties, first);
    page_note(p, "", "%llu are closer than the separation%s", (unsigned long long)s->possible, certain);
}

void statistics_say_geometry(page *p, void *item) {
    const statistics *r = item;
    if (r->named.pairs != NULL)
        say_pairs(&r->pairs, p);
    if (!isnan(r->condition) && r->o->out.full)
        page_note(p, "condition", "%s, of the view-projection matrix", number_of(r->condition, 4).text);
}
