/* SPDX-License-Identifier: GPL-3.0-or-later */
/* plot: a figure, drawn (SVG, PDF, PNG by the ending of -o) or as its numbers (--csv, --json). */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "camera/unit.h"
#include "core/append.h"
#include "draw/notes.h"
#include "plot/cmd_plot/figure_data.h"
#include "plot/cmd_plot/figure_file.h"
#include "plot/cmd_plot/plotting.h"
#include "report/message.h"

/* Which curves, or how many fields of a map, were computed by other methods than the exact engine. */
static void say_methods(const chart_panel *panel) {
    const chart_map *m = &panel->map;
    if (m->by_way > 0)
        message("depthprec: %zu of %d fields by a method that is cheaper than the exact cell", m->by_way,
                m->columns * m->rows);
    for (size_t s = 0; s < panel->series_count; s++)
        if (panel->series[s].method != NULL)
            message("depthprec: %s: by %s between the cells that the planes cut", panel->series[s].name,
                    panel->series[s].method);
}

/* How much was computed for the picture, against a value for each pixel column and curve. */
static void say_evaluations(const figure_row *row, const chart *c) {
    size_t fields = 0;
    for (size_t p = 0; p < c->panel_count; p++) {
        say_methods(&c->panels[p]);
        fields += (size_t)c->panels[p].map.columns * (size_t)c->panels[p].map.rows;
    }
    if (fields > 0)
        message("depthprec: %s: %zu evaluations, one per field", row->name, fields);
    else if (c->curves > 0)
        message("depthprec: %s: %zu evaluations for %zu curve%s (one per pixel column would be %zu)", row->name,
                c->evaluations, c->curves, c->curves == 1 ? "" : "s", c->places);
}

/* ---- The command ------------------------------------------------------------------------------------------------- */

/* Reads and searches the model, which may take long. */
static int look_at_model(plotting *p, output *out) {
    const int status = scene_look(&p->model, out);
    p->request.fights = &p->fights;
    if (status == EXIT_FINE && !scene_figure_take(&p->model, &p->fights, p->chart))
        return usage_error("plot: no memory");
    return status;
}

static int height_of(const plotting *p) {
    enum { ABOVE = 180, ROW = 17 };
    if (p->o->figure.height > 0)
        return p->request.rows;
    return p->request.fights != NULL            ? scene_figure_height(p->chart, p->request.columns)
           : (p->row->takes & FIGURE_COST) != 0 ? ABOVE + ROW * (int)p->request.count
                                                : p->request.rows;
}

/* The figure, with the curves of the other camera where there is one: they stay in `room`. */
static const char *build(plotting *p, bool every, chart *out, chart *room) {
    const unit_row *own = p->o->camera.lengths.unit,
                   *other = p->beside != NULL ? p->beside->o->camera.lengths.unit : NULL;
    p->request.every = p->request.every || every;
    const char *wrong = p->row->build(&p->request, out);
    if (p->beside == NULL || wrong != NULL)
        return wrong;
    p->beside->request.every = p->request.every;
    wrong = p->row->build(&p->beside->request, room);
    if (chart_failed(room))
        chart_fail(out);
    if (wrong != NULL || chart_failed(out))
        return wrong;
    return chart_join(out, room, (int)p->request.count, own != NULL && other != NULL ? unit_convert(1, other, own) : 1)
               ? NULL
               : "--beside: must be a camera of which the figure shows the same";
}

/* To stdout, where the file is that of the figure. As CSV curves share their places, of which a picture needs few. */
static int write_numbers(plotting *p) {
    plot_request beside = *p->o;
    output out;
    beside.out.file = NULL;
    int status = output_start(&beside.out, &beside.camera, &out);
    if (status != EXIT_FINE)
        return status;
    const bool again = beside.out.form == FORM_CSV && p->chart->curves > 0;
    chart *every = again ? chart_new() : NULL, *room = again ? chart_new() : NULL;
    if (every != NULL && (build(p, true, every, room) != NULL || chart_failed(every)))
        status = EXIT_IO;
    else
        figure_data_write(&out, beside.out.form, "plot", p->row->name, every != NULL ? every : p->chart);
    chart_free(every);
    chart_free(room);
    if (status == EXIT_FINE)
        return output_close(&out);
    output_abandon(&out);
    return usage_error("plot: no memory");
}

static const char *set_axes(const double ends[4], chart *c) {
    for (size_t i = 0; i < 2 * c->panel_count; i++) {
        chart_panel *panel = &c->panels[i / 2];
        chart_axis *axis = i % 2 == 0 ? &panel->x : &panel->y;
        axis->lo = ends[i % 2 * 2];
        axis->hi = ends[i % 2 * 2 + 1];
        if (axis->scale == CHART_LOG && !(axis->lo > 0))
            return "--axes: LO must be greater than 0 on a logarithmic axis";
    }
    return NULL;
}

static int write_figure(plotting *p) {
    const plot_request *o = p->o;
    const bool drawn = figure_file_wanted(o->line, &o->out);
    chart *c = p->chart;
    output out;
    int status = drawn ? output_open(&out, o->out.file) : output_start(&o->out, &o->camera, &out);
    if (status != EXIT_FINE)
        return status;
    if ((p->row->takes & FIGURE_MODEL) != 0)
        status = look_at_model(p, &out);
    if (status != EXIT_FINE) {
        output_abandon(&out);
        return status;
    }
    const char *wrong = build(p, false, c, p->beside != NULL ? p->beside->chart : NULL);
    if (wrong == NULL && option_given(o->line, "axes"))
        wrong = set_axes(o->figure.axes, c);
    status = wrong != NULL ? usage_error("%s", wrong) : p->mine != NULL ? p->mine->status : EXIT_FINE;
    if (status != EXIT_FINE) {
        output_abandon(&out);
        return status;
    }
    if (p->mine != NULL && p->row->build == stability_build)
        append(c->subtitle, sizeof c->subtitle, "; yours ran on %s, hatched where not", mine_device(p->mine));
    if (c->title[0] == '\0')
        snprintf(c->title, sizeof c->title, "%s", p->row->title);
    bool good = !chart_failed(c);
    if (good && drawn)
        good = figure_file_write(o->line, &o->figure, o->out.file, c, p->request.columns, height_of(p), &out);
    else if (good)
        figure_data_write(&out, o->out.form, "plot", p->row->name, c);
    if (good && o->out.full)
        say_evaluations(p->row, c);
    if (good && drawn && o->out.form != FORM_TEXT)
        status = write_numbers(p);
    if (good && status == EXIT_FINE)
        return output_close(&out);
    output_abandon(&out);
    if (good)
        return status;
    message("depthprec: no memory for the figure");
    return EXIT_IO;
}

static int check_output(const plot_request *o) {
    if (o->out.form == FORM_TEXT && o->out.file == NULL)
        return usage_error("plot: needs -o FILE that ends in .svg, .pdf or .png, or --csv or --json for the numbers");
    canvas_format type;
    return figure_file_wanted(o->line, &o->out) ? figure_file_type(o->line, &o->figure, "output", o->out.file, &type)
                                                : EXIT_FINE;
}

int cmd_plot(void *request) {
    const plot_request *o = request;
    plotting p = plotting_of(o), q = {.chart = NULL};
    asked_line other = {.request = NULL};
    p.request.names = p.names;
    char *text = strdup(o->figure.beside != NULL ? o->figure.beside : "");
    int status = check_output(o);
    if (status == EXIT_FINE)
        status = plotting_check(&p);
    if (status == EXIT_FINE && (p.chart == NULL || text == NULL))
        status = usage_error("plot: no memory");
    if (status == EXIT_FINE) {
        notes_clean(p.chart->title, sizeof p.chart->title, o->figure.title != NULL ? o->figure.title : "");
        status = plotting_resolve(&p);
    }
    if (status == EXIT_FINE && o->figure.beside != NULL)
        status = plotting_beside(&p, text, &other, &q);
    if (status == EXIT_FINE)
        status = write_figure(&p);
    chart_free(p.chart);
    scene_end(&p.model);
    setups_release(&p.all);
    need_release(&p.file);
    mine_close(p.mine);
    chart_free(q.chart);
    setups_release(&q.all);
    options_release(&other);
    free(text);
    return status;
}
