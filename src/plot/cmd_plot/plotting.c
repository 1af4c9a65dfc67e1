/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "plot/cmd_plot/plotting.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "camera/cmd/raster_setups.h"
#include "cli/list.h"
#include "core/append.h"
#include "plot/cmd_plot/figure_file.h"
#include "quantity/cmd/choice.h"
#include "report/number.h"
#include "shadow/engine.h"
#include "solve/cmd_check/check_report.h"

enum { WIDTH = 800, HEIGHT = 500 };

/* Depths that a figure waits for, about a quarter of a second a set-up. */
static const uint64_t census_depths = UINT64_C(1) << 28;

plotting plotting_of(const plot_request *o) {
    const figure_request request = {.lo = NAN,
                                    .hi = NAN,
                                    .at = NAN,
                                    .terms = o->origin.terms,
                                    .tolerance = option_given(o->line, "tolerance") ? o->camera.tolerance : (double)NAN,
                                    .every = o->out.form == FORM_CSV && !figure_file_wanted(o->line, &o->out),
                                    .census = census_depths,
                                    .columns = o->figure.width > 0 ? o->figure.width : WIDTH,
                                    .rows = o->figure.height > 0 ? o->figure.height : HEIGHT,
                                    .far_count = option_given(o->line, "far") ? o->camera.far_count : 0,
                                    .fars = o->camera.fars};
    scene_asked scene_of = o->scene;
    scene_of.angle = o->shadow.angle; /* as this is */
    return (plotting){
        .o = o,
        .row = o->line->operand_row,
        .request = request,
        .judge = {.line = o->line, .camera = o->camera, .out = o->out, .judge = o->judge},
        .scene = {.line = o->line, .camera = o->camera, .out = o->out, .scene = scene_of, .bias = o->bias},
        .shadow = {.line = o->line, .camera = o->camera, .out = o->out, .shadow = o->shadow, .bias = o->bias},
        .chart = chart_new()};
}

/* The depth and range of the request; what this figure has no use for is refused rather than ignored. */
static int resolve_depths(plotting *p) {
    const plot_request *o = p->o;
    if (option_given(o->line, "at")) {
        if (o->camera.at.count != 1)
            return option_error("at", "must be one depth in the figure %s, got %zu", p->row->name, o->camera.at.count);
        p->request.at = o->camera.at.lo;
    }
    if (!option_given(o->line, "range"))
        return EXIT_FINE;
    p->request.lo = o->camera.range_lo;
    p->request.hi = o->camera.range_hi;
    return p->all.count > 0 ? range_resolve(&o->camera, &p->request.lo, &p->request.hi) : EXIT_FINE;
}

/* A file is for the figures that show requirements or a model. */
static int check_file_given(const plot_request *o, const figure_row *row) {
    if ((row->takes & FIGURE_MODEL) != 0)
        return o->line->operand_count > 1 ? EXIT_FINE
                                          : usage_error("plot %s: needs MODEL, a file as of scene", row->name);
    if ((row->takes & FIGURE_FILE) == 0)
        return o->line->operand_count == 1 || row->family != NULL
                   ? EXIT_FINE
                   : usage_error("plot %s: takes no file, got '%s'", row->name, o->line->operands[1]);
    return o->line->operand_count == 2
               ? EXIT_FINE
               : usage_error("plot %s: needs FILE, a requirement file, see depthprec(5)", row->name);
}

/* A named arithmetic counts where binary32 depths are shown. */
static int check_arith(const plot_request *o, const figure_row *row) {
    const bool guaranteed = (row->takes & FIGURE_GUARANTEED) != 0 && !option_given(o->line, "model");
    const bool computed = o->camera.model_auto || o->camera.model == DP_MODEL_FLOAT || guaranteed;
    if ((row->takes & FIGURE_BINARY32) != 0 || computed || !camera_names_arith(&o->camera))
        return EXIT_FINE;
    return (row->takes & FIGURE_FLOAT) != 0
               ? option_error("arith", "needs --model float in the figure %s", row->name)
               : option_error("arith", "has no effect in the figure %s, which shows no binary32 arithmetic", row->name);
}

/* Options that this figure has no use for. */
static int check_options(const plot_request *o, const figure_row *row) {
    if (o->camera.znear <= 0.0 && (row->takes & FIGURE_SIGNED) == 0)
        return option_error("near", "must be greater than 0 in the figure %s, got '%s'", row->name,
                            number_full(o->camera.znear).text);
    if (option_given(o->line, "composition") && !(o->origin.terms.world > 0.0))
        return option_error("composition", "needs --from-origin: eye depth is given");
    if (option_given(o->line, "model") && (row->takes & FIGURE_BINARY32) != 0 && o->camera.model != DP_MODEL_FLOAT)
        return option_error("model", "must be float in the figure %s, got '%s'", row->name,
                            option_word("model", o->camera.model_auto ? DP_MODEL_COUNT : o->camera.model));
    if (option_given(o->line, "viewport") && (row->takes & FIGURE_SLANTED) != 0 && option_given(o->line, "model") &&
        o->camera.model != DP_MODEL_FLOAT)
        return option_error("viewport", "needs --model float in the figure %s", row->name);
    if (!isnan(o->camera.azimuth) && (row->takes & FIGURE_DRAWN) == 0)
        return option_error("slant", "must be LO:HI in the figure %s, got '%s'", row->name,
                            option_text(o->line, "slant"));
    if (option_given(o->line, "tolerance") && !o->camera.model_auto && (row->takes & FIGURE_TOLERANCE) == 0)
        return option_error("tolerance", "needs --model auto in the figure %s", row->name);
    if (option_given(o->line, "tolerance") && !o->camera.model_auto && (row->takes & FIGURE_AT) != 0 &&
        !option_given(o->line, "at"))
        return option_error("tolerance", "needs --at in the figure %s: the worst of a range is exact", row->name);
    return check_arith(o, row);
}

/* --model auto: what is enough over the whole range that the figure shows. Then curves of a quantity that only cells
 * have are refused where there are none. */
static int choose_models(plotting *p) {
    enum { CHOICE_DEPTHS = 257 };
    double lo, hi;
    figure_range(&p->request, &lo, &hi);
    const depths at = {.kind = DEPTHS_LOG, .lo = lo, .hi = hi, .count = CHOICE_DEPTHS};
    for (size_t i = 0; i < p->all.count; i++)
        setup_choose(&p->o->camera, &at, &p->all.items[i]);
    for (size_t i = 0; i < p->all.count && (p->row->takes & FIGURE_FLOAT) == 0 && !p->request.guaranteed; i++)
        if (p->all.items[i].spec.model == DP_MODEL_FLOAT)
            return option_error(
                "model",
                "float has no cells for the figure %s to show, staged has; interval, error and budget draw what it "
                "guarantees",
                p->row->name);
    return EXIT_FINE;
}

/* Set-ups differ by format and mapping and, where they were chosen one by one, by model. */
static void name_setups(plotting *p) {
    for (size_t i = 0; i < p->all.count; i++) {
        char *name = p->text[i];
        p->names[i] = setup_label(&p->all.items[i], false, name);
        if (p->o->camera.model_auto)
            append(name, SETUP_LABEL_SIZE, ", %s", option_word("model", p->all.items[i].spec.model));
    }
}

/* The subtitle, which holds for all set-ups: the full label without the name in front. */
static void subtitle_of(const plot_request *o, const figure_request *request, bool budgeted, char *out, size_t size) {
    char full[SETUP_LABEL_SIZE];
    setup_fields fields = setup_fields_asked(&request->setups[0], &o->camera);
    if (budgeted)
        setup_fields_budget(&request->setups[0], &fields);
    setup_label_as(&request->setups[0], &fields, full);
    char *last = strrchr(full, ',');
    bool one_model = true;
    for (size_t i = 0; i < request->count; i++)
        one_model = one_model && (!request->guaranteed || request->setups[i].spec.model == DP_MODEL_FLOAT);
    if ((!one_model || (o->camera.model_auto && request->count > 1)) && last != NULL)
        *last = '\0'; /* the names say it, or what is guaranteed */
    else if (request->setups[0].spec.model == DP_MODEL_EXACT)
        append(full, sizeof full, " (lattice of codes)");
    const char *rest = strstr(full, ", ");
    const char *one = request->count == 1 ? full : rest != NULL ? rest + 2 : "";
    const char *unit = camera_unit(&o->camera);
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

/* Each family in a case of its own. */
static int resolve_all(plotting *p) {
    static const char *const of_one[] = {"format", "mapping", "ortho", "mine", "device"};
    for (size_t i = 0; i < sizeof of_one / sizeof of_one[0]; i++)
        if (option_given(p->o->line, of_one[i]))
            return option_error(of_one[i], "needs one family: plot %s FAMILY", p->row->name);
    p->asked.setup = p->all.items[0];
    return EXIT_FINE;
}

/* Without a function of somebody's the figure of stability shows all cases of a family. */
static int check_case(const plotting *p) {
    static const char *const of_one[] = {"format", "mapping", "device"};
    for (size_t i = 0; i < sizeof of_one / sizeof of_one[0]; i++)
        if (p->row->build == stability_build && p->o->judge.mine_count == 0 && option_given(p->o->line, of_one[i]))
            return option_error(of_one[i], "needs --mine in the figure %s, which shows all cases", p->row->name);
    return EXIT_FINE;
}

/* Which family and, where it is timed, in which case; the figure measures that and not the set-ups. */
static int resolve_methods(plotting *p) {
    const plot_request *o = p->o;
    char machine[192];
    const bool on_device = o->judge.mine_count > 0 || o->judge.device != NULL;
    const char *family = o->line->operand_count > 1 ? o->line->operands[1]
                         : on_device                ? linearize_family.name
                                                    : p->row->family;
    static const char *const all[] = {"all", NULL};
    const name_list families = {.words = p->row->build == pareto_build ? all : NULL, .get = list_family};
    list_item item;
    int status = check_operand(o->line->command, "FAMILY", &families, family, &item);
    if (status == EXIT_FINE)
        status = check_case(p);
    if (status == EXIT_FINE)
        status = item.row == NULL ? resolve_all(p) : methods_resolve(&p->judge, item.row, &p->asked);
    if (status == EXIT_FINE && on_device)
        status = methods_single(&p->judge, &p->asked);
    if (status == EXIT_FINE && on_device)
        status = mine_open(&p->judge, &p->asked, p->row->build == pareto_build, &p->mine);
    if (status != EXIT_FINE)
        return status;
    snprintf(p->where, sizeof p->where, "%snear %s, far %s; %s", o->camera.ortho ? "orthographic, " : "",
             number_in(number_full(o->camera.znear), camera_unit(&o->camera)).text,
             number_in(number_full(o->camera.zfar), camera_unit(&o->camera)).text,
             p->mine != NULL ? mine_device(p->mine) : methods_machine(machine, sizeof machine));
    p->request.setups = &p->asked.setup;
    p->request.count = 1;
    p->request.family = p->asked.family;
    p->request.cases = p->asked.cases;
    p->request.where = p->where;
    return status;
}

/* Those that the projection and the far plane allow; an engine's own come behind them. */
static void choose_mappings(camera_asked *c) {
    c->mapping_count = 0;
    for (int m = 0; m <= DP_MAPPING_LOG; m++) {
        const dp_mapping_row *row = dp_mapping_get((dp_mapping)m);
        if ((row->ortho || !c->ortho) && (row->far_infinite || !isinf(c->zfar)))
            c->mappings[c->mapping_count++] = (dp_mapping)m;
    }
}

/* Where none are named and all would be too many: those that the figure shows then, and of a single set-up the first
 * mapping. */
static void choose_setups(plot_request *o, const figure_row *row) {
    const size_t all = o->camera.format_count;
    if ((row->takes & FIGURE_COST) != 0 && !option_given(o->line, "mapping") && o->camera.preset_count == 0 &&
        o->camera.platform == NULL)
        choose_mappings(&o->camera);
    if (row->formats == NULL)
        return;
    if (!option_given(o->line, "format") && all * o->camera.mapping_count > row->setups_max) {
        o->camera.format_count = 0;
        for (size_t i = 0; i < all; i++)
            if (strstr(row->formats, o->camera.formats[i].name) != NULL)
                o->camera.formats[o->camera.format_count++] = o->camera.formats[i];
        o->camera.format_count += o->camera.format_count == 0; /* a rasterizer that has none of them */
    }
    if (row->setups_max == 1 && !option_given(o->line, "mapping"))
        o->camera.mapping_count = 1;
}

/* Resolves the depth at which a rasterizer draws: one between the planes. */
static int resolve_drawn(const plotting *p, plot_request *o) {
    depths at;
    int status = view_drawn(&o->camera);
    if (status == EXIT_FINE && option_given(o->line, "at"))
        status = depths_resolve(&p->o->camera, 1, &at);
    if (status == EXIT_FINE && option_given(o->line, "range"))
        status = option_error("range", "does not apply to the figure %s; --at says its depth", p->row->name);
    if (status == EXIT_FINE && isnan(o->camera.azimuth))
        status = option_error("slant", "must be SLANT,AZIMUTH in the figure %s, got '%s'", p->row->name,
                              option_text(o->line, "slant"));
    return status;
}

static int resolve_setups(plotting *p) {
    plot_request in_model = *p->o;
    const bool drawn = (p->row->takes & FIGURE_DRAWN) != 0;
    int status = check_options(p->o, p->row);
    if (status == EXIT_FINE && drawn)
        status = resolve_drawn(p, &in_model);
    choose_setups(&in_model, p->row);
    if ((p->row->takes & FIGURE_BINARY32) != 0)
        in_model.camera.model = DP_MODEL_FLOAT;
    const bool staged = (p->row->takes & FIGURE_STAGED) != 0 && !dp_range_moves(in_model.camera.depth_range);
    for (size_t i = 0; staged && i < in_model.camera.mapping_count; i++)
        if (!option_given(p->o->line, "model") && dp_mapping_get(in_model.camera.mappings[i])->ndc_signed)
            in_model.camera.model = DP_MODEL_STAGED;
    in_model.camera.budgeted = (p->row->takes & FIGURE_TERMS) != 0;
    if (status == EXIT_FINE)
        status = (p->row->takes & FIGURE_SLANTED) != 0 ? slant_view(&in_model.camera) : EXIT_FINE;
    if (status == EXIT_FINE)
        status = (drawn ? raster_setups : setups_make)(&in_model.camera, &p->all);
    if (status == EXIT_FINE)
        status = resolve_depths(p);
    if (status == EXIT_FINE && p->all.count > p->row->setups_max)
        status = usage_error("plot %s: shows at most %zu set-up%s, got %zu: name fewer with --format or --mapping",
                             p->row->name, p->row->setups_max, p->row->setups_max == 1 ? "" : "s", p->all.count);
    if (status != EXIT_FINE)
        return status;
    p->request.setups = p->all.items;
    p->request.count = p->all.count;
    p->request.guaranteed = (p->row->takes & FIGURE_GUARANTEED) != 0 && !option_given(p->o->line, "model");
    for (size_t i = 0; p->request.guaranteed && i < p->all.count; i++)
        p->all.items[i] = dp_setup_guaranteed(&p->all.items[i]);
    if (p->request.guaranteed)
        p->request.census = 0;
    p->request.raster = drawn ? in_model.camera.raster : NULL;
    p->request.slant = p->o->camera.triangles.slant_lo;
    p->request.azimuth = p->o->camera.azimuth;
    status = choose_models(p);
    name_setups(p);
    p->chart->unit = camera_unit(&p->o->camera);
    subtitle_of(p->o, &p->request, in_model.camera.budgeted, p->chart->subtitle, sizeof p->chart->subtitle);
    return status == EXIT_FINE && p->row->family != NULL ? resolve_methods(p) : status;
}

/* Neither of a picture nor of the output. */
static bool is_of_camera(const asked_line *line, const char *name) {
    static const option_table *const others[] = {&figure_options, &output_options};
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++)
        for (const option_row *row = others[i]->rows; row->name != NULL; row++)
            if (option_find(line->command, name) == row)
                return false;
    return true;
}

/* The camera of --beside, whose options are words of one word; it has no figure of its own. */
static int parse_beside(const plotting *p, char *text, asked_line *out) {
    enum { WORDS = 64 };
    char *words[WORDS + 1] = {p->o->line->argv[0], "plot", (char *)p->row->name};
    int count = 3;
    for (char *word = strtok(text, " "); word != NULL && count < WORDS; word = strtok(NULL, " "))
        words[count++] = word;
    int status = options_parse(out, count, words);
    for (size_t i = 0; i < out->given_count && status == EXIT_FINE; i++)
        if (!is_of_camera(out, out->given[i].name))
            status = option_error("beside", "must be options of a camera, got '%s'", p->o->figure.beside);
    if (status == EXIT_FINE && out->operand_count != 1)
        status = usage_error("plot %s: --beside takes options, got '%s'", p->row->name, out->operands[1]);
    return status;
}

int plotting_beside(plotting *p, char *text, asked_line *line, plotting *q) {
    const int status = parse_beside(p, text, line);
    if (status != EXIT_FINE)
        return status;
    *q = plotting_of(line->request);
    q->request.columns = p->request.columns;
    q->request.rows = p->request.rows;
    q->request.names = q->names;
    p->beside = q;
    return q->chart == NULL ? usage_error("plot: no memory") : resolve_setups(q);
}

static int resolve_file(plotting *p) {
    const int status = resolve_depths(p);
    p->request.file = &p->file;
    return status == EXIT_FINE ? check_read(p->o->line->operands[1], &p->file) : status;
}

/* Shadow maps bring their own cameras. */
static int resolve_shadow(plotting *p) {
    const plot_request o = *p->o;
    p->shadow.shadow.world = o.origin.terms.world; /* the row of that name is one for all figures */
    if (o.camera.format_count * o.camera.mapping_count != 1)
        return usage_error("plot %s: shows one format in one mapping, got %zu: name one with --format and --mapping",
                           p->row->name, o.camera.format_count * o.camera.mapping_count);
    const int status = shadow_maps_make(&p->shadow, &o.camera.formats[0], o.camera.mappings[0], &p->maps);
    p->request.maps = p->maps.items;
    p->request.map_count = p->maps.count;
    if (p->maps.whole.kind != SHADOW_SUN) { /* one map, at all its depths */
        p->maps.items[0].light = p->maps.whole;
        p->request.map_count = 1;
    }
    if ((p->request.engine = o.shadow.engine) != NULL) {
        const double *standard = o.shadow.engine->standard[p->maps.whole.kind];
        p->request.bias = isnan(o.shadow.bias) ? standard[0] : o.shadow.bias;
        p->request.normal_bias = isnan(o.shadow.normal_bias) ? standard[1] : o.shadow.normal_bias;
        p->request.api = shadow_asked_api(&p->shadow, 0);
    }
    p->chart->unit = camera_unit(&o.camera);
    char *const subtitle = p->chart->subtitle;
    const size_t size = sizeof p->chart->subtitle;
    snprintf(subtitle, size, "%s %s, %u x %u texels, filter of %u x %u; ", o.camera.formats[0].name,
             dp_mapping_get(o.camera.mappings[0])->name, o.shadow.size[0], o.shadow.size[1], o.shadow.kernel,
             o.shadow.kernel);
    if (p->maps.whole.kind != SHADOW_SUN)
        append(subtitle, size, "%s light, near %s, far %s", o.shadow.point ? "point" : "spot",
               number_full(o.camera.znear).text, number_full(o.camera.zfar).text);
    else if (p->maps.view.count > 0)
        append(subtitle, size, "view near %s, far %s", number_full(o.camera.znear).text,
               number_full(o.camera.zfar).text);
    else
        append(subtitle, size, "box %s x %s x %s", number_full(o.shadow.light_box[0]).text,
               number_full(o.shadow.light_box[1]).text, number_full(o.shadow.light_box[2]).text);
    return status;
}

int plotting_check(const plotting *p) {
    if (p->request.far_count > 1 && (p->row->takes & FIGURE_FARS) == 0)
        return option_error("far", "must be one far plane in the figure %s, got '%s'", p->row->name,
                            option_text(p->o->line, "far"));
    return check_file_given(p->o, p->row);
}

int plotting_resolve(plotting *p) {
    return (p->row->takes & FIGURE_FILE) != 0     ? resolve_file(p)
           : (p->row->takes & FIGURE_MODEL) != 0  ? scene_figure_begin(&p->model, &p->scene)
           : (p->row->takes & FIGURE_SHADOW) != 0 ? resolve_shadow(p)
                                                  : resolve_setups(p);
}
