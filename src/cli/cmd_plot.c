/* SPDX-License-Identifier: GPL-3.0-or-later */
/* plot: a figure, drawn (SVG, PDF, PNG by the ending of -o) or as its numbers (--csv, --json). */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/choice.h"
#include "cli/command_line.h"
#include "cli/list.h"
#include "cli/methods.h"
#include "cli/options.h"
#include "cli/plot_census.h"
#include "cli/plot_data.h"
#include "cli/plot_normals.h"
#include "cli/plot_scene.h"
#include "cli/setups.h"
#include "cli/ways.h"
#include "plot/draw.h"
#include "plot/figure.h"
#include "plot/notes.h"
#include "report/number.h"

int cmd_plot(const options *o);

enum { WIDTH = 800, HEIGHT = 500 };

bool list_figure(size_t index, list_item *item) {
    const figure_row *row = figure_get(index);
    if (row == NULL)
        return false;
    *item = (list_item){.name = row->name, .note = row->summary, .row = row};
    return true;
}

/* The depth and range of the request; what this figure has no use for is refused rather than ignored. */
static int resolve_depths(const options *o, const figure_row *row, figure_request *request) {
    if (option_given(o, OPTION_AT)) {
        if ((row->takes & FIGURE_AT) == 0)
            return option_error(OPTION_AT, "has no meaning in the figure %s; --range cuts its axis", row->name);
        if (o->at.count != 1)
            return option_error(OPTION_AT, "must be one depth in the figure %s, got %zu", row->name, o->at.count);
        if (option_given(o, OPTION_RANGE))
            return option_error(OPTION_AT, "must not be given together with --range");
        request->at = o->at.lo;
    }
    if (option_given(o, OPTION_RANGE))
        return range_resolve(o, &request->lo, &request->hi);
    return EXIT_FINE;
}

/* A file is for the figure that shows requirements, and brings all that makes a set-up. */
static int check_file_given(const options *o, const figure_row *row) {
    static const option_id camera[] = {OPTION_NEAR,  OPTION_FAR,   OPTION_FORMAT, OPTION_MAPPING,  OPTION_ORTHO,
                                       OPTION_MODEL, OPTION_ARITH, OPTION_LOG_C,  OPTION_ROUNDING, OPTION_PRESET};
    if ((row->takes & FIGURE_NEEDS) == 0)
        return o->operand_count == 1 || (row->takes & FIGURE_METHODS) != 0
                   ? EXIT_FINE
                   : usage_error("plot %s: takes no file, got '%s'", row->name, o->operands[1]);
    if (o->operand_count < 2)
        return usage_error("plot %s: needs FILE, a requirement file, see depthprec(5)", row->name);
    for (size_t i = 0; i < sizeof camera / sizeof camera[0]; i++)
        if (option_given(o, camera[i]))
            return option_error(camera[i], "has no meaning in the figure %s: the file says it", row->name);
    return EXIT_FINE;
}

/* Options that this figure has no use for. */
static int check_options(const options *o, const figure_row *row) {
    static const option_id terms[] = {OPTION_INTERPOLATION, OPTION_WORLD, OPTION_COMPOSITION, OPTION_LINEARIZE};
    for (size_t i = 0; i < sizeof terms / sizeof terms[0]; i++)
        if (option_given(o, terms[i]) && (row->takes & FIGURE_TERMS) == 0)
            return option_error(terms[i], "has no meaning in the figure %s, but in budget", row->name);
    if (option_given(o, OPTION_COMPOSITION) && !(o->terms.world > 0.0))
        return option_error(OPTION_COMPOSITION, "needs --world: eye depth is given");
    if (option_given(o, OPTION_MODEL) && (row->takes & FIGURE_BINARY32) != 0 && o->model != DP_MODEL_FP32)
        return option_error(OPTION_MODEL, "must be fp32 in the figure %s, got '%s'", row->name,
                            o->model_auto ? "auto" : dp_model_name(o->model));
    if (option_given(o, OPTION_TOLERANCE) && !o->model_auto && (row->takes & FIGURE_WAYS) == 0)
        return option_error(OPTION_TOLERANCE, "needs --model auto in the figure %s", row->name);
    return EXIT_FINE;
}

/* --model auto: what is enough over the whole range that the figure shows. */
static void choose_models(const options *o, const figure_request *request, setups *all) {
    enum { CHOICE_DEPTHS = 257 };
    double lo, hi;
    figure_range(request, &lo, &hi);
    depths at = depths_spaced(DEPTHS_LOG, lo, hi, CHOICE_DEPTHS);
    setups_choose(o, &at, all);
}

/* Curves of a quantity that only cells have. */
static int check_cells(const figure_row *row, const setups *all) {
    for (size_t i = 0; i < all->count && (row->takes & FIGURE_FP32) == 0; i++)
        if (all->items[i].spec.model == DP_MODEL_FP32)
            return option_error(OPTION_MODEL,
                                "fp32 has no cells for the figure %s to show; interval and budget draw its separation",
                                row->name);
    return EXIT_FINE;
}

/* Set-ups differ by format and mapping and, where they were chosen one by one, by model. */
static const char *name_of(const options *o, const dp_setup *setup, char out[SETUP_LABEL_SIZE]) {
    setup_label(setup, false, out);
    if (o->model_auto)
        snprintf(out + strlen(out), SETUP_LABEL_SIZE - strlen(out), ", %s", dp_model_name(setup->spec.model));
    return out;
}

/* What holds for all set-ups: the full label without the name in front. */
static void subtitle_of(const options *o, const figure_request *request, char *out, size_t size) {
    char full[SETUP_LABEL_SIZE], lo[NUMBER_SIZE], hi[NUMBER_SIZE];
    setup_label(&request->setups[0], true, full);
    char *model = strrchr(full, ',');
    if (o->model_auto && request->count > 1 && model != NULL)
        *model = '\0'; /* the names say it */
    const char *rest = strstr(full, ", ");
    const char *one = request->count == 1 ? full : rest != NULL ? rest + 2 : "";
    number_shortest(isnan(request->at) ? request->lo : request->at, lo);
    number_shortest(request->hi, hi);
    if (!isnan(request->at))
        snprintf(out, size, "%s, at depth %s", one, lo);
    else if (!isnan(request->lo))
        snprintf(out, size, "%s, depths %s to %s", one, lo, hi);
    else
        snprintf(out, size, "%s", one);
}

static bool picture(const options *o, const chart *c, output *out) {
    char command[COMMAND_LINE_SIZE];
    canvas_bytes bytes;
    command_line(o, o->output, command);
    if (!draw_chart(c, theme_get(o->theme), canvas_format_of(o->output), o->width > 0 ? o->width : WIDTH,
                    o->height > 0 ? o->height : HEIGHT, command, &bytes))
        return false;
    output_bytes(out, bytes.at, bytes.size);
    free(bytes.at);
    return true;
}

/* Which curves, or how many fields of a map, were computed by other methods than the exact engine. */
static void say_methods(const chart_panel *panel) {
    const chart_map *m = &panel->map;
    if (m->by_way > 0)
        fprintf(stderr, "depthprec: %zu of %d fields by a method that is cheaper than the exact cell\n", m->by_way,
                m->columns * m->rows);
    for (size_t s = 0; s < panel->series_count; s++)
        if (panel->series[s].method != NULL)
            fprintf(stderr, "depthprec: %s: by %s between the cells that the planes cut\n", panel->series[s].name,
                    panel->series[s].method);
}

/* How much was computed for the picture, against a value for each pixel column and curve. */
static void say_evaluations(const figure_row *row, const chart *c) {
    size_t fields = 0;
    for (size_t p = 0; p < c->panel_count; p++)
        say_methods(&c->panels[p]);
    for (size_t p = 0; p < c->panel_count; p++)
        fields += (size_t)c->panels[p].map.columns * (size_t)c->panels[p].map.rows;
    if (fields > 0)
        fprintf(stderr, "depthprec: %s: %zu evaluations, one a field\n", row->name, fields);
    else if (c->curves > 0)
        fprintf(stderr, "depthprec: %s: %zu evaluations for %zu curve%s (one a pixel column would be %zu)\n", row->name,
                c->evaluations, c->curves, c->curves == 1 ? "" : "s", c->places);
}

static int write_figure(const options *o, const figure_row *row, const figure_request *request, chart *c) {
    output out;
    int status = output_open(&out, o->output);
    if (status != EXIT_FINE)
        return status;
    const char *wrong = row->build(request, c);
    if (wrong != NULL) {
        output_abandon(&out);
        return usage_error("%s", wrong);
    }
    if (c->title[0] == '\0')
        snprintf(c->title, sizeof c->title, "%s", row->title);
    bool good = !chart_failed(c);
    if (good && o->form == FORM_TEXT)
        good = picture(o, c, &out);
    else if (good)
        plot_data_write(&out, o->form, row->name, c);
    if (good && o->verbose)
        say_evaluations(row, c);
    if (good)
        return output_close(&out);
    output_abandon(&out);
    fprintf(stderr, "depthprec: no memory for the figure\n");
    return EXIT_IO;
}

static int check_output(const options *o) {
    if (o->form == FORM_TEXT && o->output == NULL)
        return usage_error("plot: needs -o FILE that ends in .svg, .pdf or .png, or --csv or --json for the numbers");
    if (o->form == FORM_TEXT && canvas_format_of(o->output) == CANVAS_FORMAT_COUNT)
        return option_error(OPTION_OUTPUT, "must end in .svg, .pdf or .png, got '%s'", o->output);
    return EXIT_FINE;
}

int cmd_plot(const options *o) {
    const figure_row *row = o->operand_row;
    setups all = {0};
    char text[CHART_SERIES][SETUP_LABEL_SIZE];
    const char *names[CHART_SERIES];
    figure_request request = {.names = names, .lo = NAN, .hi = NAN, .at = NAN, .terms = o->terms};
    options in_binary32 = *o;
    in_binary32.model = (row->takes & FIGURE_BINARY32) != 0 ? DP_MODEL_FP32 : o->model;
    request.columns = o->width > 0 ? o->width : WIDTH;
    request.rows = o->height > 0 ? o->height : HEIGHT;
    request.find_way = (row->takes & FIGURE_WAYS) != 0 ? way_for_figure : NULL;
    request.tolerance = option_given(o, OPTION_TOLERANCE) ? o->tolerance : (double)NAN;
    int status = check_output(o);
    if (status == EXIT_FINE)
        status = check_file_given(o, row);
    if (status == EXIT_FINE && (row->takes & FIGURE_NEEDS) != 0)
        return plot_scene(o, row, write_figure);
    if (status == EXIT_FINE)
        status = check_options(o, row);
    if (status == EXIT_FINE)
        status = setups_make(&in_binary32, &all);
    if (status == EXIT_FINE)
        status = resolve_depths(o, row, &request);
    if (status == EXIT_FINE && all.count > row->setups_max)
        status = usage_error("plot %s: shows at most %zu set-ups, got %zu: name fewer with --format or --mapping",
                             row->name, row->setups_max, all.count);
    request.setups = all.items;
    request.count = all.count;
    if (status == EXIT_FINE) {
        choose_models(o, &request, &all);
        status = check_cells(row, &all);
    }
    plot_census census = {0};
    if (status == EXIT_FINE && (row->takes & FIGURE_CENSUS) != 0)
        status = plot_census_make(&all, &request, &census);
    request.census = census.shown;
    methods_figure walked = {0};
    char of_methods[2 * CHART_TEXT];
    const char *family = o->operand_count > 1 ? o->operands[1] : NULL;
    bool methodical = (row->takes & FIGURE_METHODS) != 0;
    if (status == EXIT_FINE && methodical)
        status =
            methods_figure_make(o, (row->takes & FIGURE_PARETO) != 0, family, &walked, of_methods, sizeof of_methods);
    request.methods = &walked.shown;
    request.normals = &plot_normals;
    chart *c = status == EXIT_FINE ? chart_new() : NULL;
    if (c != NULL) {
        for (size_t i = 0; i < all.count; i++)
            names[i] = name_of(o, &all.items[i], text[i]);
        notes_clean(c->title, sizeof c->title, o->title != NULL ? o->title : "");
        subtitle_of(o, &request, c->subtitle, sizeof c->subtitle);
        if ((row->takes & FIGURE_NORMALS) != 0)
            snprintf(c->subtitle + strlen(c->subtitle), sizeof c->subtitle - strlen(c->subtitle), "; %s",
                     plot_normals_view(o->ortho));
        if (methodical)
            notes_clean(c->subtitle, sizeof c->subtitle, of_methods);
        status = write_figure(o, row, &request, c);
    } else if (status == EXIT_FINE) {
        status = usage_error("plot: no memory");
    }
    chart_free(c);
    plot_census_free(&census);
    methods_figure_free(&walked);
    setups_release(&all);
    return status;
}
