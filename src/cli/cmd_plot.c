/* SPDX-License-Identifier: GPL-3.0-or-later */
/* plot: a figure, drawn (SVG, PDF, PNG by the ending of -o) or as its numbers (--csv, --json). */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cli/check_report.h"
#include "cli/choice.h"
#include "cli/figure_data.h"
#include "cli/figure_file.h"
#include "cli/list.h"
#include "cli/methods.h"
#include "cli/raster_setups.h"
#include "cli/scene/figure.h"
#include "cli/shadow/maps.h"
#include "core/append.h"
#include "plot/figure.h"
#include "plot/notes.h"
#include "report/number.h"

enum { WIDTH = 800, HEIGHT = 500 };

/* Of the plane that is drawn, degrees. */
static const double standard_slant = 60.0, standard_azimuth = 45.0;

/* Depths that a figure waits for, about a quarter of a second a set-up. */
static const uint64_t census_depths = UINT64_C(1) << 28;

typedef struct plotting {
    const options *o;
    const figure_row *row;
    figure_request request;
    setups all;
    const char *names[CHART_SETUPS];
    char text[CHART_SETUPS][SETUP_LABEL_SIZE];
    methods_asked asked;
    char where[256]; /* of what is timed */
    need_file file;
    shadow_maps maps;
    scene model;
    fights_asked fights;
    chart *chart;
} plotting;

/* The depth and range of the request; what this figure has no use for is refused rather than ignored. */
static int resolve_depths(plotting *p) {
    const options *o = p->o;
    if (option_given(o, OPTION_AT)) {
        if ((p->row->takes & FIGURE_AT) == 0)
            return option_error(OPTION_AT, "does not apply to the figure %s; --range limits its axis", p->row->name);
        if (o->at.count != 1)
            return option_error(OPTION_AT, "must be one depth in the figure %s, got %zu", p->row->name, o->at.count);
        if (option_given(o, OPTION_RANGE))
            return option_error(OPTION_AT, "cannot be combined with --range");
        p->request.at = o->at.lo;
    }
    if (!option_given(o, OPTION_RANGE))
        return EXIT_FINE;
    p->request.lo = o->range_lo;
    p->request.hi = o->range_hi;
    return p->all.count > 0 ? range_resolve(o, &p->request.lo, &p->request.hi) : EXIT_FINE;
}

/* A file is for the figure that shows requirements, and brings all that makes a set-up. */
static int check_file_given(const options *o, const figure_row *row) {
    static const option_id camera[] = {OPTION_NEAR,  OPTION_FAR,   OPTION_FORMAT, OPTION_MAPPING,  OPTION_ORTHO,
                                       OPTION_MODEL, OPTION_ARITH, OPTION_LOG_C,  OPTION_ROUNDING, OPTION_PRESET};
    if ((row->takes & FIGURE_MODEL) != 0)
        return o->operand_count > 1 ? EXIT_FINE : usage_error("plot %s: needs MODEL, a file as of scene", row->name);
    if ((row->takes & FIGURE_FILE) == 0)
        return o->operand_count == 1 || row->family != NULL
                   ? EXIT_FINE
                   : usage_error("plot %s: takes no file, got '%s'", row->name, o->operands[1]);
    if (o->operand_count < 2)
        return usage_error("plot %s: needs FILE, a requirement file, see depthprec(5)", row->name);
    for (size_t i = 0; i < sizeof camera / sizeof camera[0]; i++)
        if (option_given(o, camera[i]))
            return option_error(camera[i], "does not apply to the figure %s: the file has it", row->name);
    return EXIT_FINE;
}

#define SLANTED        (FIGURE_SLANTED | FIGURE_MODEL)
#define VIEWED         (SLANTED | FIGURE_DRAWN | FIGURE_SHADOW)
#define VIEWED_FIGURES "budget, fight, interval, scene and shadow"

/* Options of some figures alone. */
static const struct {
    option_id id;
    unsigned takes;
    const char *figure;
} only[] = {{OPTION_INTERPOLATION, FIGURE_TERMS, "budget"},
            {OPTION_FROM_ORIGIN, FIGURE_TERMS | FIGURE_SHADOW, "budget and shadow"},
            {OPTION_COMPOSITION, FIGURE_TERMS, "budget"},
            {OPTION_LINEARIZE, FIGURE_TERMS, "budget"},
            {OPTION_LOG2, FIGURE_TERMS, "budget"},
            {OPTION_FOV, VIEWED, VIEWED_FIGURES},
            {OPTION_HFOV, VIEWED, VIEWED_FIGURES},
            {OPTION_VIEWPORT, VIEWED, VIEWED_FIGURES},
            {OPTION_RASTER, VIEWED, VIEWED_FIGURES},
            {OPTION_TRIANGLE_CLASS, VIEWED, VIEWED_FIGURES},
            {OPTION_SUBPIXEL, SLANTED | FIGURE_SHADOW, "budget, interval, scene and shadow"},
            {OPTION_SLANT, SLANTED, "budget, interval and scene"},
            {OPTION_PLANE, FIGURE_DRAWN, "fight"},
            {OPTION_CASCADES, FIGURE_SHADOW, "shadow"},
            {OPTION_LAMBDA, FIGURE_SHADOW, "shadow"},
            {OPTION_LIGHT_BOX, FIGURE_SHADOW, "shadow"},
            {OPTION_KERNEL, FIGURE_SHADOW, "shadow"},
            {OPTION_ANGLE, FIGURE_SHADOW | FIGURE_MODEL, "scene and shadow"},
            {OPTION_SEPARATION, FIGURE_MODEL, "scene"},
            {OPTION_WITHIN, FIGURE_MODEL, "scene"},
            {OPTION_ALSO, FIGURE_MODEL, "scene"},
            {OPTION_TRANSFORMS, FIGURE_MODEL, "scene"},
            {OPTION_EYE, FIGURE_MODEL, "scene"},
            {OPTION_LOOK, FIGURE_MODEL, "scene"},
            {OPTION_PATH, FIGURE_MODEL, "scene"},
            {OPTION_CAMERA, FIGURE_MODEL, "scene"},
            {OPTION_THREADS, FIGURE_MODEL, "scene"},
            {OPTION_SIZE, FIGURE_SHADOW, "shadow"}};

static int check_only(const options *o, const figure_row *row) {
    for (size_t i = 0; i < sizeof only / sizeof only[0]; i++)
        if (option_given(o, only[i].id) && (row->takes & only[i].takes) == 0)
            return option_error(only[i].id, "does not apply to the figure %s, only to %s%s", row->name, only[i].figure,
                                only[i].id == OPTION_SIZE ? "; a figure's size is --width and --height" : "");
    return EXIT_FINE;
}

/* Options that this figure has no use for. */
static int check_options(const options *o, const figure_row *row) {
    if (o->znear <= 0.0 && (row->takes & FIGURE_SIGNED) == 0)
        return option_error(OPTION_NEAR, "must be greater than 0 in the figure %s, got '%s'", row->name,
                            number_full(o->znear).text);
    if (option_given(o, OPTION_COMPOSITION) && !(o->terms.world > 0.0))
        return option_error(OPTION_COMPOSITION, "needs --from-origin: eye depth is given");
    if (option_given(o, OPTION_MODEL) && (row->takes & FIGURE_BINARY32) != 0 && o->model != DP_MODEL_FLOAT)
        return option_error(OPTION_MODEL, "must be float in the figure %s, got '%s'", row->name,
                            option_word(OPTION_MODEL, o->model_auto ? DP_MODEL_COUNT : o->model));
    if (option_given(o, OPTION_VIEWPORT) && (row->takes & FIGURE_SLANTED) != 0 && (row->takes & FIGURE_BINARY32) == 0 &&
        o->model != DP_MODEL_FLOAT)
        return option_error(OPTION_VIEWPORT, "needs --model float in the figure %s", row->name);
    if (option_given(o, OPTION_TOLERANCE) && !o->model_auto && (row->takes & FIGURE_TOLERANCE) == 0)
        return option_error(OPTION_TOLERANCE, "needs --model auto in the figure %s", row->name);
    return EXIT_FINE;
}

/* --model auto: what is enough over the whole range that the figure shows. Then curves of a quantity that only cells
 * have are refused where there are none. */
static int choose_models(plotting *p) {
    enum { CHOICE_DEPTHS = 257 };
    double lo, hi;
    figure_range(&p->request, &lo, &hi);
    const depths at = {.kind = DEPTHS_LOG, .lo = lo, .hi = hi, .count = CHOICE_DEPTHS};
    for (size_t i = 0; i < p->all.count; i++)
        setup_choose(p->o, &at, &p->all.items[i]);
    for (size_t i = 0; i < p->all.count && (p->row->takes & FIGURE_FLOAT) == 0; i++)
        if (p->all.items[i].spec.model == DP_MODEL_FLOAT)
            return option_error(
                OPTION_MODEL,
                "float has no cells for the figure %s to show, staged has; interval and budget draw its "
                "separation",
                p->row->name);
    return EXIT_FINE;
}

/* Set-ups differ by format and mapping and, where they were chosen one by one, by model. */
static void name_setups(plotting *p) {
    for (size_t i = 0; i < p->all.count; i++) {
        char *name = p->text[i];
        p->names[i] = setup_label(&p->all.items[i], false, name);
        if (p->o->model_auto)
            append(name, SETUP_LABEL_SIZE, ", %s", option_word(OPTION_MODEL, p->all.items[i].spec.model));
    }
}

/* What holds for all set-ups: the full label without the name in front. */
static void subtitle_of(const options *o, const figure_request *request, bool budgeted, char *out, size_t size) {
    char full[SETUP_LABEL_SIZE];
    setup_fields fields = setup_fields_of(&request->setups[0], NULL);
    if (budgeted)
        setup_fields_budget(&request->setups[0], &fields);
    setup_label_as(&request->setups[0], &fields, full);
    char *last = strrchr(full, ',');
    if (o->model_auto && request->count > 1 && last != NULL)
        *last = '\0'; /* the names say it */
    const char *rest = strstr(full, ", ");
    const char *one = request->count == 1 ? full : rest != NULL ? rest + 2 : "";
    const char *unit = options_unit(o);
    if (!isnan(request->at))
        snprintf(out, size, "%s, at depth %s", one, number_full(request->at).text);
    else if (!isnan(request->lo))
        snprintf(out, size, "%s, depths %s to %s", one, number_full(request->lo).text, number_full(request->hi).text);
    else
        snprintf(out, size, "%s", one);
    const dp_triangles *t = &request->setups[0].spec.triangles;
    if (t->width > 0 && request->raster == NULL) /* a figure that draws says it itself */
        append(out, size, ", %dx%d, fov %s, %d subpixel bits, slant %s to %s", t->width, t->height,
               number_of(t->fov_y, 4).text, t->subpixel, number_full(t->slant_lo).text, number_full(t->slant_hi).text);
    append(out, size, "%s%s", unit != NULL ? ", lengths in " : "", unit != NULL ? unit : "");
}

/* Which family and, where it is timed, in which case; the figure measures that and not the set-ups. */
static int resolve_methods(plotting *p) {
    const options *o = p->o;
    char machine[192];
    const char *family = o->operand_count > 1 ? o->operands[1] : p->row->family;
    const name_list families = {.get = list_family};
    list_item item;
    int status = check_operand(o->command, "FAMILY", &families, family, &item);
    if (status == EXIT_FINE)
        status = methods_resolve(o, item.row, &p->asked);
    snprintf(p->where, sizeof p->where, "near %s, far %s; %s", number_in(number_full(o->znear), options_unit(o)).text,
             number_in(number_full(o->zfar), options_unit(o)).text, methods_machine(machine, sizeof machine));
    p->request.setups = &p->asked.setup;
    p->request.count = 1;
    p->request.family = p->asked.family;
    p->request.which = p->asked.which;
    p->request.where = p->where;
    return status;
}

/* Where none are named and all would be too many: those that the figure shows then, and of a single set-up the first
 * mapping. */
static void choose_setups(options *o, const figure_row *row) {
    const size_t all = o->format_count;
    if (row->formats == NULL)
        return;
    if (!option_given(o, OPTION_FORMAT) && all * o->mapping_count > row->setups_max) {
        o->format_count = 0;
        for (size_t i = 0; i < all; i++)
            if (strstr(row->formats, o->formats[i].name) != NULL)
                o->formats[o->format_count++] = o->formats[i];
        o->format_count += o->format_count == 0; /* a rasterizer that has none of them */
    }
    if (row->setups_max == 1 && !option_given(o, OPTION_MAPPING))
        o->mapping_count = 1;
}

/* What a rasterizer draws is at one depth between the planes. */
static int resolve_drawn(const plotting *p, options *o) {
    depths at;
    int status = view_drawn(o);
    if (status == EXIT_FINE && option_given(o, OPTION_AT))
        status = depths_resolve(p->o, 1, &at);
    if (status == EXIT_FINE && option_given(o, OPTION_RANGE))
        status = option_error(OPTION_RANGE, "does not apply to the figure %s; --at says its depth", p->row->name);
    return status;
}

static int resolve_setups(plotting *p) {
    options in_model = *p->o;
    const bool drawn = (p->row->takes & FIGURE_DRAWN) != 0;
    int status = check_options(p->o, p->row);
    if (status == EXIT_FINE && drawn)
        status = resolve_drawn(p, &in_model);
    choose_setups(&in_model, p->row);
    if ((p->row->takes & FIGURE_BINARY32) != 0)
        in_model.model = DP_MODEL_FLOAT;
    for (size_t i = 0; (p->row->takes & FIGURE_STAGED) != 0 && i < in_model.mapping_count; i++)
        if (!option_given(p->o, OPTION_MODEL) && dp_mapping_get(in_model.mappings[i])->ndc_signed)
            in_model.model = DP_MODEL_STAGED;
    in_model.budgeted = (p->row->takes & FIGURE_TERMS) != 0;
    if (status == EXIT_FINE)
        status = (p->row->takes & FIGURE_SLANTED) != 0 ? slant_view(&in_model) : EXIT_FINE;
    if (status == EXIT_FINE)
        status = (drawn ? raster_setups : setups_make)(&in_model, &p->all);
    if (status == EXIT_FINE)
        status = resolve_depths(p);
    if (status == EXIT_FINE && p->all.count > p->row->setups_max)
        status = usage_error("plot %s: shows at most %zu set-up%s, got %zu: name fewer with --format or --mapping",
                             p->row->name, p->row->setups_max, p->row->setups_max == 1 ? "" : "s", p->all.count);
    if (status != EXIT_FINE)
        return status;
    p->request.setups = p->all.items;
    p->request.count = p->all.count;
    p->request.raster = drawn ? in_model.raster : NULL;
    p->request.slant = option_given(p->o, OPTION_PLANE) ? p->o->triangles.slant_lo : standard_slant;
    p->request.azimuth = option_given(p->o, OPTION_PLANE) ? p->o->azimuth : standard_azimuth;
    status = choose_models(p);
    name_setups(p);
    p->chart->unit = options_unit(p->o);
    subtitle_of(p->o, &p->request, in_model.budgeted, p->chart->subtitle, sizeof p->chart->subtitle);
    return status == EXIT_FINE && p->row->family != NULL ? resolve_methods(p) : status;
}

static int resolve_file(plotting *p) {
    const int status = resolve_depths(p);
    p->request.file = &p->file;
    return status == EXIT_FINE ? check_read(p->o->operands[1], &p->file) : status;
}

/* Shadow maps bring their own cameras. */
static int resolve_shadow(plotting *p) {
    static const option_id others[] = {OPTION_ORTHO, OPTION_PRESET, OPTION_ROUNDING,  OPTION_MODEL,
                                       OPTION_ARITH, OPTION_LOG_C,  OPTION_TOLERANCE, OPTION_AT};
    const options o = shadow_options(p->o);
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++)
        if (option_given(&o, others[i]))
            return option_error(others[i], "does not apply to the figure %s", p->row->name);
    if (o.format_count * o.mapping_count != 1)
        return usage_error("plot %s: shows one format in one mapping, got %zu: name one with --format and --mapping",
                           p->row->name, o.format_count * o.mapping_count);
    const int status = shadow_maps_make(&o, &o.formats[0], o.mappings[0], &p->maps);
    p->request.maps = p->maps.items;
    p->request.map_count = p->maps.count;
    p->chart->unit = options_unit(&o);
    char *const subtitle = p->chart->subtitle;
    const size_t size = sizeof p->chart->subtitle;
    snprintf(subtitle, size, "%s %s, %u x %u texels, filter of %u x %u; ", o.formats[0].name,
             dp_mapping_get(o.mappings[0])->name, o.camera.width, o.camera.height, o.kernel, o.kernel);
    if (p->maps.view.count > 0)
        append(subtitle, size, "view near %s, far %s", number_full(o.znear).text, number_full(o.zfar).text);
    else
        append(subtitle, size, "box %s x %s x %s", number_full(o.light_box[0]).text, number_full(o.light_box[1]).text,
               number_full(o.light_box[2]).text);
    return status;
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
    for (size_t p = 0; p < c->panel_count; p++) {
        say_methods(&c->panels[p]);
        fields += (size_t)c->panels[p].map.columns * (size_t)c->panels[p].map.rows;
    }
    if (fields > 0)
        fprintf(stderr, "depthprec: %s: %zu evaluations, one per field\n", row->name, fields);
    else if (c->curves > 0)
        fprintf(stderr, "depthprec: %s: %zu evaluations for %zu curve%s (one per pixel column would be %zu)\n",
                row->name, c->evaluations, c->curves, c->curves == 1 ? "" : "s", c->places);
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
    const bool own = p->request.fights != NULL && p->o->height == 0;
    return own ? scene_figure_height(p->chart, p->request.columns) : p->request.rows;
}

/* To stdout, where the file is that of the figure. */
static int write_numbers(const plotting *p) {
    options beside = *p->o;
    output out;
    beside.output = NULL;
    const int status = options_open(&beside, &out);
    if (status != EXIT_FINE)
        return status;
    figure_data_write(&out, beside.form, "plot", p->row->name, p->chart);
    return output_close(&out);
}

static int write_figure(plotting *p) {
    const options *o = p->o;
    const bool drawn = figure_file_wanted(o);
    chart *c = p->chart;
    output out;
    int status = drawn ? output_open(&out, o->output) : options_open(o, &out);
    if (status != EXIT_FINE)
        return status;
    if ((p->row->takes & FIGURE_MODEL) != 0)
        status = look_at_model(p, &out);
    if (status != EXIT_FINE) {
        output_abandon(&out);
        return status;
    }
    const char *wrong = p->row->build(&p->request, c);
    if (wrong != NULL) {
        output_abandon(&out);
        return usage_error("%s", wrong);
    }
    if (c->title[0] == '\0')
        snprintf(c->title, sizeof c->title, "%s", p->row->title);
    bool good = !chart_failed(c);
    if (good && drawn)
        good = figure_file_write(o, o->output, c, p->request.columns, height_of(p), &out);
    else if (good)
        figure_data_write(&out, o->form, "plot", p->row->name, c);
    if (good && o->verbose)
        say_evaluations(p->row, c);
    if (good && drawn && o->form != FORM_TEXT)
        status = write_numbers(p);
    if (good && status == EXIT_FINE)
        return output_close(&out);
    output_abandon(&out);
    if (good)
        return status;
    fprintf(stderr, "depthprec: no memory for the figure\n");
    return EXIT_IO;
}

static int check_output(const options *o) {
    if (o->form == FORM_TEXT && o->output == NULL)
        return usage_error("plot: needs -o FILE that ends in .svg, .pdf or .png, or --csv or --json for the numbers");
    canvas_format type;
    return figure_file_wanted(o) ? figure_file_type(o, OPTION_OUTPUT, o->output, &type) : EXIT_FINE;
}

int cmd_plot(const options *o) {
    plotting p = {.o = o, .row = o->operand_row};
    p.request = (figure_request){.names = p.names,
                                 .lo = NAN,
                                 .hi = NAN,
                                 .at = NAN,
                                 .terms = o->terms,
                                 .tolerance = option_given(o, OPTION_TOLERANCE) ? o->tolerance : (double)NAN,
                                 .census = census_depths,
                                 .columns = o->width > 0 ? o->width : WIDTH,
                                 .rows = o->height > 0 ? o->height : HEIGHT};
    int status = check_output(o);
    if (status == EXIT_FINE)
        status = check_file_given(o, p.row);
    if (status == EXIT_FINE)
        status = check_only(o, p.row);
    if (status != EXIT_FINE)
        return status;
    p.chart = chart_new();
    if (p.chart == NULL)
        return usage_error("plot: no memory");
    notes_clean(p.chart->title, sizeof p.chart->title, o->title != NULL ? o->title : "");
    status = (p.row->takes & FIGURE_FILE) != 0     ? resolve_file(&p)
             : (p.row->takes & FIGURE_MODEL) != 0  ? scene_figure_begin(&p.model, o)
             : (p.row->takes & FIGURE_SHADOW) != 0 ? resolve_shadow(&p)
                                                   : resolve_setups(&p);
    if (status == EXIT_FINE)
        status = write_figure(&p);
    chart_free(p.chart);
    scene_end(&p.model);
    setups_release(&p.all);
    need_release(&p.file);
    return status;
}
