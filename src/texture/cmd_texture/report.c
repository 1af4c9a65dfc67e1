/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdio.h>

#include "cli/progress.h"
#include "report/number.h"
#include "report/report.h"
#include "texture/cmd_texture/request.h"
#include "texture/cmd_texture/statistics.h"

/* ---- Columns ----------------------------------------------------------------------------------------------------- */

static void *next_reading(void *of, size_t i) {
    statistics *r = of;
    if (i == r->source.reading_count)
        return NULL;
    r->reading = r->source.readings[i];
    return r;
}

static void *next_band(void *of, size_t i) {
    statistics *r = of;
    if (i == r->survey.band_count)
        return NULL;
    r->band = r->survey.bands[i];
    r->band_steps = r->band.steps > 0 ? (double)r->band.steps : (double)NAN;
    return r;
}

static void *next_error(void *of, size_t i) {
    statistics *r = of;
    error_line *e = &r->errors[i];
    if (i == r->error_count)
        return NULL;
    e->masked = r->survey.pixels - e->sum.count - e->sum.infinite;
    e->most = e->sum.infinite > 0 ? (double)INFINITY : e->sum.hi;
    if (e->sum.infinite > 0)
        snprintf(e->at, sizeof e->at, "%llu pixels (%s)", (unsigned long long)e->sum.infinite, e->unit);
    else if (e->sum.count > 0)
        snprintf(e->at, sizeof e->at, "%u,%u (%s)", e->sum.hi_column, e->sum.hi_row, e->unit);
    else
        snprintf(e->at, sizeof e->at, "- (%s)", e->unit);
    return e;
}

/* Conditions of columns; an image has window depth without --metric, and levels with it or --stereo. */
enum { OF_SYNTHETIC = 1, OF_IMAGE = 2, OF_WINDOW = 4, OF_MATRIX = 8, OF_METRIC = 16, OF_STEREO = 32 };

static unsigned conditions(const statistics *r) {
    const unsigned source = !statistics_of_image(r)   ? OF_SYNTHETIC
                            : r->o->image.metric == 0 ? OF_IMAGE | OF_WINDOW
                                                      : OF_IMAGE | OF_METRIC;
    return source | (r->source.matrix.path != NULL ? OF_MATRIX : 0) | (r->stereo.focal > 0 ? OF_STEREO : 0);
}

static const column parameter_columns[] = {{FIELD(statistics, parameter, "name", "")},
                                           {FIELD(statistics, parameter_value, "value", "")},
                                           {.kind = COLUMN_END}};

static const column sample_columns[] = {{FIELD(statistics, named.step, "step", "scene")},
                                        {FIELD(statistics, named.steps, "steps", "")},
                                        {FIELD(statistics, named.steps_or, "steps_or", "")},
                                        {FIELD(statistics, named.bits, "bits", "")},
                                        {FIELD(statistics, named.coarser, "coarser", "")},
                                        {FIELD(statistics, named.rounded, "rounded", "")},
                                        {.kind = COLUMN_END}};

static void *next_unit(void *of, size_t i) {
    statistics *r = of;
    unit_reading all[UNITS_MAX];
    if (!texture_may_be_metric(&r->source) || i >= units_find(&r->source.picture, all))
        return NULL;
    r->unit = all[i];
    return r;
}

static const column unit_columns[] = {{FIELD(statistics, unit.option, "option", "")},
                                      {FIELD(statistics, unit.lo, "lo", "m")},
                                      {FIELD(statistics, unit.hi, "hi", "m")},
                                      {.kind = COLUMN_END}};

static const column recognised_columns[] = {{FIELD(statistics, named.format, "format", "")},
                                            {FIELD(statistics, named.certain, "certain", "")},
                                            {FIELD(statistics, named.reversed, "reversed", "")},
                                            {FIELD(statistics, source.why, "why", "")},
                                            {LIST("units", unit_columns, next_unit)},
                                            {.kind = COLUMN_END}};

static const column gap_columns[] = {
    {FIELD(statistics, gap.z, "z", "scene")}, {FIELD(statistics, gap.gap, "gap", "scene")}, {.kind = COLUMN_END}};

static const column buffer_columns[] = {{FIELD(sensor_buffer, bits, "bits", "")},
                                        {FIELD(sensor_buffer, znear, "near", "scene")},
                                        {FIELD(sensor_buffer, znear_off, "near_error", "scene")},
                                        {FIELD(sensor_buffer, zfar, "far", "scene")},
                                        {FIELD(sensor_buffer, zfar_off, "far_error", "scene")},
                                        {.kind = COLUMN_END}};

static const column lattice_columns[] = {{FIELD(statistics, lattice.name, "name", "")},
                                         {FIELD(statistics, lattice.from, "from", "")},
                                         {FIELD(statistics, lattice.other, "other", "")},
                                         {FIELD(statistics, lattice.like, "like", "")},
                                         {FIELD(statistics, lattice.step, "step", "")},
                                         {FIELD(statistics, lattice.step_error, "step_error", "")},
                                         {FIELD(statistics, lattice.offset, "offset", "")},
                                         {FIELD(statistics, lattice.offset_error, "offset_error", "")},
                                         {FIELD(statistics, lattice.before, "before", "scene")},
                                         {FIELD(statistics, lattice.constant, "constant", "scene")},
                                         {FIELD(statistics, lattice.levels, "levels", "")},
                                         {FIELD(statistics, lattice.bits, "bits", "")},
                                         {FIELD(statistics, lattice.off_pixels, "off_pixels", "")},
                                         {FIELD(statistics, lattice.residual, "residual", "scene")},
                                         {PART(statistics, named.buffer, "buffer", buffer_columns), .pointed = true},
                                         {LIST("gaps", gap_columns, statistics_next_gap)},
                                         {.kind = COLUMN_END}};

static const column stereo_columns[] = {{FIELD(statistics, stereo.focal, "focal", "pixels")},
                                        {FIELD(statistics, stereo.baseline, "baseline", "scene")},
                                        {FIELD(statistics, stereo.offset, "offset", "pixels")},
                                        {FIELD(statistics, stereo.step, "step", "pixels")},
                                        {FIELD(statistics, named.pixels, "resolution", "pixels")},
                                        {.kind = COLUMN_END}};

static const column source_columns[] = {{FIELD(statistics, source.path, "file", "")},
                                        {FIELD(statistics, named.synthetic, "synthetic", "")},
                                        {LIST("parameters", parameter_columns, statistics_next_parameter)},
                                        {FIELD(statistics, source.camera.width, "width", "")},
                                        {FIELD(statistics, source.camera.height, "height", "")},
                                        {FIELD(statistics, named.type, "type", ""), .when = OF_IMAGE},
                                        {FIELD(statistics, source.channels, "channels", ""), .when = OF_IMAGE},
                                        {FIELD(statistics, named.channel, "channel", ""), .when = OF_IMAGE},
                                        {FIELD(statistics, named.metric, "metric", "scene"), .when = OF_IMAGE},
                                        {FIELD(statistics, named.metric_from, "metric_from", ""), .when = OF_IMAGE},
                                        {GROUP("stereo", stereo_columns), .when = OF_STEREO},
                                        {FIELD(statistics, named.radial, "radial", ""), .when = OF_IMAGE},
                                        {FIELD(statistics, named.packing, "packing", ""), .when = OF_IMAGE},
                                        {FIELD(statistics, source.picture.lossy, "lossy", ""), .when = OF_IMAGE},
                                        {FIELD(statistics, named.moved, "moved", ""), .when = OF_IMAGE},
                                        {FIELD(statistics, named.moved_from, "moved_from", ""), .when = OF_IMAGE},
                                        {GROUP("samples", sample_columns), .when = OF_IMAGE},
                                        {GROUP("lattice", lattice_columns), .when = OF_METRIC},
                                        {GROUP("recognised", recognised_columns), .when = OF_WINDOW},
                                        {.kind = COLUMN_END}};

static const column reading_columns[] = {
    {FIELD(statistics, reading.what, "what", "")},    {FIELD(statistics, reading.name, "name", "")},
    {FIELD(statistics, source.column, "column", "")}, {FIELD(statistics, source.row, "row", "")},
    {FIELD(statistics, reading.z, "z", "scene")},     {.kind = COLUMN_END}};

static const column sky_columns[] = {{FIELD(statistics, survey.sky, "pixels", "")},
                                     {FIELD(statistics, source.frame.sky, "limit", "")},
                                     {FIELD(statistics, survey.sky_from, "from", "scene")},
                                     {FIELD(statistics, named.hidden, "hidden", ""), .when = OF_SYNTHETIC},
                                     {FIELD(statistics, source.unpacked.zeros, "zeros", ""), .when = OF_IMAGE},
                                     {.kind = COLUMN_END}};

static const column found_columns[] = {
    {FIELD(statistics, named.format_from, "format_from", "")},
    {FIELD(statistics, named.mapping_from, "mapping_from", "")},
    {FIELD(statistics, named.direction_from, "direction_from", "")},
    {LIST("readings", reading_columns, next_reading)},
    {FIELD(statistics, named.fov, "fov", "degrees")},
    {FIELD(statistics, named.half_height, "half_height", "scene")},
    {PART(statistics, source.matrix, "matrix", texture_matrix_columns), .when = OF_MATRIX},
    {FIELD(statistics, survey.pixels, "pixels", "")},
    {FIELD(statistics, survey.invalid, "invalid", "")},
    {GROUP("sky", sky_columns)},
    {FIELD(statistics, survey.lo, "lo", "scene")},
    {FIELD(statistics, survey.hi, "hi", "scene")},
    {FIELD(statistics, survey.codes, "codes", "")},
    {.kind = COLUMN_END}};

/* CSV calls the ends of a band otherwise. */
static const column band_columns[] = {
    {FIELD(statistics, band.lo, "lo", "scene"), SHOWN("from", 8, 6), .only = AS_JSON | AS_TEXT},
    {FIELD(statistics, band.hi, "hi", "scene"), SHOWN("to", 8, 6), .only = AS_JSON | AS_TEXT},
    {FIELD(statistics, band.lo, "from", "scene"), .only = AS_CSV},
    {FIELD(statistics, band.hi, "to", "scene"), .only = AS_CSV},
    {FIELD(statistics, band.pixels, "pixels", ""), SHOWN("pixels", 10, 0)},
    {FIELD(statistics, band.codes, "codes", ""), SHOWN("codes", 8, 0)},
    {FIELD(statistics, band.available, "available", ""), SHOWN("available", 11, 0)},
    {FIELD(statistics, band.gap, "gap", "scene"), SHOWN("nearest gap", 12, 6)},
    {FIELD(statistics, band.gap_z, "gap_z", "scene"), SHOWN("at z", 10, 6)},
    {FIELD(statistics, band.steps, "steps", "")},
    {TEXT_FIELD(statistics, band_steps, "steps", 12, 17), .spare = 1},
    {FIELD(statistics, band.interval, "interval", "scene"), SHOWN("interval", 11, 6)},
    {.kind = COLUMN_END}};

static const column pair_columns[] = {{FIELD(survey_pairs, pairs, "count", "")},
                                      {FIELD(survey_pairs, ties, "ties", "")},
                                      {FIELD(survey_pairs, possible, "possible", "")},
                                      {FIELD(survey_pairs, first_tie, "first_tie", "scene")},
                                      {FIELD(survey_pairs, certain_to, "certain_to", "scene")},
                                      {.kind = COLUMN_END}};

static const column error_columns[] = {{FIELD(error_line, name, "name", "")},
                                       {TEXT_FIELD(error_line, name, "error bound", -22, 0), .when = OF_IMAGE},
                                       {TEXT_FIELD(error_line, name, "error", -22, 0), .when = OF_SYNTHETIC},
                                       {FIELD(error_line, unit, "unit", "")},
                                       {FIELD(error_line, sum.count, "pixels", "")},
                                       {FIELD(error_line, sum.infinite, "unbounded", "")},
                                       {FIELD(error_line, masked, "masked", "")},
                                       {FIELD(error_line, sum.mean, "mean", ""), SHOWN("mean", 11, 4)},
                                       {FIELD(error_line, sum.p99, "p99", ""), SHOWN("99 %", 10, 4), .upward = true},
                                       {FIELD(error_line, sum.hi, "max", "")},
                                       {TEXT_FIELD(error_line, most, "at most", 10, 4), .upward = true},
                                       {FIELD(error_line, sum.hi_column, "column", "")},
                                       {FIELD(error_line, sum.hi_row, "row", "")},
                                       {TEXT_FIELD(error_line, at, "at pixel", -1, 0)},
                                       {.kind = COLUMN_END}};

static const column columns[] = {
    {GROUP(NULL, source_columns), .only = AS_JSON},
    {PART(statistics, setup, NULL, setup_columns)},
    {GROUP(NULL, found_columns), .only = AS_JSON},
    {LIST("bands", band_columns, next_band), .notes = statistics_say_geometry},
    {PART(statistics, named.pairs, "pairs", pair_columns), .only = AS_JSON, .pointed = true},
    {FIELD(statistics, condition, "condition", ""), .only = AS_JSON},
    {FIELD(statistics, named.truth, "truth", ""), .only = AS_JSON},
    {LIST("errors", error_columns, next_error), .only = AS_JSON | AS_TEXT, .indent = 2},
    {.kind = COLUMN_END}};

/* The longest ray, that of a corner. */
static double longest_ray(const texture_camera *c) {
    const uint32_t right = c->width - 1, bottom = c->height - 1;
    return fmax(fmax(camera_radial(c, 0, 0), camera_radial(c, right, 0)),
                fmax(camera_radial(c, 0, bottom), camera_radial(c, right, bottom)));
}

/* Names the source's properties and its options. */
static void name_all(statistics *r) {
    static const bool answers[] = {false, true};
    const texture_source *s = &r->source;
    const grain *g = &s->grain;
    const bool is_metric = r->o->image.metric > 0, has_steps = g->kind == GRAIN_STEPS;
    const double none = (double)NAN;
    r->setup = setup_fields_asked(&s->setup, &r->o->camera);
    r->named.synthetic = statistics_of_image(r) ? NULL : s->frame.synthetic->name;
    r->named.truth = statistics_of_image(r) ? NULL : "synthetic";
    r->named.packing = r->o->image.packing != NULL ? r->o->image.packing->name : NULL;
    r->named.type = image_type_name(s->type);
    r->named.channel = s->picture.channel[0] != '\0' ? s->picture.channel : NULL;
    r->named.rounded = g->kind == GRAIN_CODES ? NULL : grain_rounding_name(g->rounding);
    r->named.format = s->found.depth ? s->found.format.name : NULL;
    r->named.certain = s->found.certain != 0;
    r->named.format_from = texture_origin_name(s->format_from);
    r->named.mapping_from = texture_origin_name(s->mapping_from);
    r->named.direction_from = texture_origin_name(s->direction_from);
    const bool disparity = r->stereo.focal > 0;
    r->named.metric = is_metric && !disparity ? r->o->image.metric : none;
    r->named.metric_from = is_metric && !disparity ? texture_origin_name(s->metric_from) : NULL;
    const moved_row *row = r->o->image.moved != NULL ? r->o->image.moved : s->moved.row;
    r->named.moved = row != NULL ? row->name : NULL;
    r->named.moved_from = row == NULL ? NULL
                          : r->o->image.moved != NULL
                              ? texture_origin_name(ORIGIN_GIVEN)
                              : texture_origin_name(s->moved.certain ? ORIGIN_FOUND : ORIGIN_ASSUMED);
    r->named.radial = s->camera.radial ? longest_ray(&s->camera) : none;
    r->named.step = is_metric && !disparity && s->metric.step > 0 ? s->metric.step : none;
    r->named.pixels = disparity && s->metric.step > 0 ? s->metric.step : none;
    r->named.steps = !is_metric && has_steps ? g->steps : none;
    r->named.steps_or = !is_metric && has_steps && g->whole > 0 ? g->whole : none;
    r->named.bits = g->kind == GRAIN_FLOATS ? g->bits : none;
    r->named.fov = s->camera.ortho ? none : s->fov_y;
    r->named.half_height = s->camera.ortho ? s->camera.half[1] : none;
    r->named.coarser = !is_metric && texture_coarser(s);
    r->named.reversed = s->found.direction ? &answers[s->found.reversed == 1] : NULL;
    if (is_metric)
        statistics_name_lattice(r);
    r->named.hidden = r->survey.sky - r->survey.true_sky;
}

/* ---- What is measured -------------------------------------------------------------------------------------------- */

static bool add_error(statistics *r, const frame_product *product) {
    static const char *const words[FRAME_KINDS][2] = {[FRAME_EYE] = {"eye depth", "scene units"},
                                                      [FRAME_POSITION] = {"position ", "scene units"},
                                                      [FRAME_NORMAL] = {"normal ", "degrees"}};
    if (r->error_count == ERRORS_MAX || frame_refuses(&r->source.frame, product) != NULL)
        return true;
    error_line *e = &r->errors[r->error_count++];
    snprintf(e->name, sizeof e->name, "%s%s", words[product->kind][0],
             product->position != NULL ? product->position->name
             : product->normal != NULL ? product->normal->name
                                       : "");
    e->unit = words[product->kind][1];
    return frame_summarise(&r->source.frame, product, &e->sum);
}

/* In a depth range it is judged twice: for the depth as it is stored, and for the depth brought to 0 to 1.
 */
static bool add_decoding(statistics *r, const decode_row *row, bool undone) {
    if (r->error_count == ERRORS_MAX || r->source.frame.metric || r->source.camera.oblique.on ||
        !decode_applies(row, &r->source.setup) || (undone && !r->source.setup.ranged))
        return true;
    error_line *e = &r->errors[r->error_count++];
    snprintf(e->name, sizeof e->name, "%s %s", undone ? "undone" : "decode", row->name);
    e->unit = "relative";
    return frame_summarise_decoding(&r->source.frame, row, undone, &e->sum);
}

/* The products whose errors are shown: a synthetic image knows all, an image those certain at once. */
static size_t products_of(const statistics *r, frame_product out[ERRORS_MAX]) {
    size_t count = 0;
    out[count++] = (frame_product){.kind = FRAME_EYE, .error = true};
    for (size_t i = 0; !statistics_of_image(r) && !r->source.setup.ranged && position_get(i) != NULL; i++)
        out[count++] = (frame_product){.kind = FRAME_POSITION, .error = true, .position = position_get(i)};
    for (size_t i = 0; !statistics_of_image(r) && normal_get(i) != NULL; i++)
        out[count++] = (frame_product){.kind = FRAME_NORMAL, .error = true, .normal = normal_get(i)};
    return count;
}

static bool gather_statistics(statistics *r) {
    frame_product products[ERRORS_MAX];
    const size_t count = products_of(r, products);
    const bool decoded = r->o->out.form != FORM_TEXT || r->o->out.full;
    progress bar = progress_start("passes", count + 1, r->o->out.quiet);
    bool good = survey_make(&r->source.frame, &r->survey);
    for (size_t k = 0; good && k < count; k++) {
        progress_step(&bar, k + 1);
        good = add_error(r, &products[k]);
        for (size_t i = 0; good && decoded && k == 0 && decode_get(i) != NULL; i++)
            good = add_decoding(r, decode_get(i), false) && add_decoding(r, decode_get(i), true);
    }
    progress_end(&bar);
    return good;
}

int texture_report_write(const texture_request *o, const texture_source *source) {
    output out;
    statistics r = {.o = o,
                    .source = *source,
                    .stereo = o->image.stereo,
                    .condition =
                        camera_is_centred(&source->camera) ? position_condition(&source->camera) : (double)NAN};
    const int status = output_start(&o->out, &o->camera, &out);
    if (status != EXIT_FINE)
        return status;
    if (!gather_statistics(&r)) {
        output_abandon(&out);
        return usage_error("texture: no memory for the statistics");
    }
    r.named.pairs = survey_pairs_make(&source->frame, &r.pairs) ? &r.pairs : NULL;
    name_all(&r);
    report_write(
        &(report_spec){"texture", columns, &r, .when = conditions(&r), .label = 14, .head = statistics_say_head}, &out,
        o->out.form);
    return output_close(&out);
}
